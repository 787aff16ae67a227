"""Text report of ``seisblock paper``: list of items; table of an item and its differences from the paper."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any

from seisblock.core.i18n import N_, gettext
from seisblock.output.text.tables import DASH, Part, format_number, side_by_side, styled_line, table
from seisblock.paper import Answer, Item, Paper
from seisblock.paper.item import ItemColumn, Value
from seisblock.report.json.paper import difference, verdict
from seisblock.report.text.validate import format_short
from seisblock.validation.case import UNKNOWN, Case

VERDICTS = {"holds": N_("holds"), "differs": N_("differs"), "drawn": N_("no printed value")}

SHORT_ROWS = 12
"""Rows of the shortened table."""

ROUND_OFF = 1e-8
"""Share of a column's largest value below which a value is shown as 0: a displacement that returns to its start."""


def list_tables(papers: Sequence[Paper]) -> Iterator[Any]:
    """Yield the items of the papers."""
    for paper in papers:
        rows = [[f"{item.name:<6}  {gettext(item.title)}", gettext(VERDICTS[verdict(paper.cases(item))])] for item in paper.items]
        yield table(paper.key.lower(), [gettext("item"), gettext("agreement with the paper")], rows)


def tables(paper: Paper, item: Item, answer: Answer, *, own: bool) -> Iterator[Any]:
    """Yield the verdict, the table of an item, and its differences; `own` for the user's record or body, which the paper does not have."""
    cases = paper.cases(item)
    yield styled_line(headline(paper, item, cases, own=own), "bold")
    yield styled_line(gettext("data: {source}", source=gettext(answer.source)), "dim")
    headings = [gettext(column.heading) for column in answer.columns]
    smallest = [ROUND_OFF * max((abs(v) for v in values if isinstance(v, float)), default=0.0) for values in zip(*answer.rows, strict=True)]
    rows = [[format_cell(v, c, least) for v, c, least in zip(row, answer.columns, smallest, strict=True)] for row in answer.rows]
    full = side_by_side("", headings, rows)
    yield Part((full,), (side_by_side("", headings, _short(rows, answer)),)) if len(rows) > SHORT_ROWS else full
    if not own:
        yield from _differences(cases)


def _short(rows: Sequence[Sequence[str]], answer: Answer) -> Sequence[Sequence[str]]:
    """Return every nth row of a curve, else the first rows."""
    abscissae = [row[0] for row in answer.rows]
    if all(isinstance(low, float) and isinstance(high, float) and low < high for low, high in pairwise(abscissae)):
        return rows[:: -(-len(rows) // SHORT_ROWS)]
    return rows[:SHORT_ROWS]


def headline(paper: Paper, item: Item, cases: Sequence[Case], *, own: bool) -> str:
    """Return the first line: item, contents, and how many statements of the paper hold."""
    differing = sum(case.status == "differs" for case in cases)
    if own:
        text = N_("{paper} {item}: {title}, on own data.")
    elif not cases:
        text = N_("{paper} {item}: {title}. The paper prints no value to compare.")
    elif not differing:
        singular, plural = (
            N_("{paper} {item}: {title}. Holds (1 statement compared)."),
            N_("{paper} {item}: {title}. Holds ({count} statements compared)."),
        )
        text = singular if len(cases) == 1 else plural
    else:
        text = N_("{paper} {item}: {title}. {differing} of {count} statements differ, with cause.")
    return gettext(text, paper=paper.key, item=item.label, title=gettext(item.title), count=len(cases), differing=differing)


def format_cell(value: Value, column: ItemColumn, smallest: float = 0.0) -> str:
    """Return a cell in the unit of its column; values below `smallest` are round-off and shown as 0."""
    if value is None:
        return DASH
    if isinstance(value, str):
        return gettext(value)
    if isinstance(value, bool | int):
        return format_number(value)
    return format_short(value / column.size if abs(value) >= smallest else 0.0, 5)


def _differences(cases: Sequence[Case]) -> Iterator[Any]:
    """Yield the differing statements, by cause."""
    entries = [difference(case) for case in cases if case.status == "differs"]
    for cause in dict.fromkeys(entry.cause for entry in entries):
        part = [entry for entry in entries if entry.cause == cause]
        rows = [
            [
                gettext(e.quantity),
                "" if e.unit == "1" else e.unit,
                *(DASH if v is None else format_short(v) for v in (e.expected, e.computed)),
            ]
            for e in part
        ]
        yield styled_line(gettext(cause) if cause == UNKNOWN else gettext("cause: {reason}", reason=gettext(cause)))
        yield Part((table("", [gettext("quantity"), gettext("unit"), gettext("printed"), gettext("computed")], rows),))
