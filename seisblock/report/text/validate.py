"""Text report of the evidence: failures, explained differences, agreements."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from rich.constrain import Constrain
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from seisblock.core.i18n import N_, gettext, lazy_gettext
from seisblock.output.text.tables import Part, details, styled_line, table, with_notes
from seisblock.validation.case import (
    EVIDENCE_KINDS,
    VERDICTS,
    Case,
    CaseResult,
    EvidenceKind,
    Verdict,
    count_verdicts,
    count_verdicts_by_kind,
)

WIDTH = 110
"""Widest line, characters."""

_HEADINGS: dict[Verdict, str] = {
    "fails": N_("Cases that fail"),
    "differs": N_("Differences from the papers, with causes"),
    "holds": N_("Cases that agree"),
}
_STYLES: dict[Verdict, str] = {"fails": "bold red", "differs": "bold yellow", "holds": "bold green"}

_HINT = N_("--all also lists the cases that agree.")
_COUNT_HEADINGS = N_("cases"), N_("agree"), N_("differ"), N_("fail")

KINDS: dict[EvidenceKind, str] = {
    "computed": N_("computed"),
    "rebuilt": N_("input rebuilt"),
    "derived": N_("derived here"),
    "print": N_("print check"),
}
"""Short names of the kinds of evidence."""


def tables(results: Sequence[CaseResult], *, all_cases: bool = True) -> Iterator[Any]:
    """Yield counts; failures and explained differences by paper; agreements if `all_cases`; counts by kind.

    In short the differences are counted by paper.

    Parameters
    ----------
    results : sequence of CaseResult
    all_cases : bool
        Whether the cases that hold are listed, too.
    """
    count_line = _count_line(results)
    yield count_line if all_cases else Part((_count_line(results).append(with_notes("", [gettext(_HINT)]), style="dim"),), (count_line,))
    for verdict in VERDICTS:
        selection = [result for result in results if result.verdict == verdict]
        if selection and (all_cases or verdict != "holds"):
            blocks = _verdict_tables(verdict, selection)
            yield from blocks if verdict == "fails" else map(details, blocks)
    yield Part((), (_paper_table(results),))
    yield _kind_table(results)


def _verdict_tables(verdict: Verdict, selection: Sequence[CaseResult]) -> Iterator[Any]:
    """Yield the cases with one verdict, by paper."""
    yield styled_line(gettext(_HEADINGS[verdict]), _STYLES[verdict])
    yield _case_table(heading=True)
    for paper in dict.fromkeys(result.case.paper for result in selection):
        yield styled_line(paper, "italic")
        part = [result for result in selection if result.case.paper == paper]
        yield from [_case_table(part)] if verdict == "holds" else _explained_cases(part)
    yield styled_line()


def _explained_cases(results: Sequence[CaseResult]) -> Iterator[Any]:
    """Yield the cases of each explanation, with the explanation below them."""
    for note in dict.fromkeys(map(explanation, results)):
        yield _case_table([result for result in results if explanation(result) == note])
        if note:
            yield Constrain(Padding(styled_line(gettext("cause: {reason}", reason=note), "dim"), (0, 2, 1, 4)), WIDTH)


def explanation(result: CaseResult) -> str:
    """Return the reason of a difference, or the broken claim of a failed case."""
    case = result.case
    if result.verdict != "fails":
        return gettext(case.note)
    if math.isnan(result.computed):
        return gettext("not computed")
    if case.status == "holds":
        return gettext("expected to agree, differs")
    if case.today is None or abs(result.error) <= case.tolerance:
        return gettext("expected to differ, agrees")
    return gettext("differs by another amount than explained (explained: {value:.6g})", value=case.today[0])


def _case_table(results: Sequence[CaseResult] = (), *, heading: bool = False) -> Any:
    """Return expected, computed, difference and tolerance, one row per case; columns align between grids."""
    grid = Table(box=None, show_header=heading, pad_edge=False, width=None, expand=True)
    grid.add_column("  " + gettext("place"), width=13)
    grid.add_column(gettext("quantity"), ratio=1)
    for name, width in ((gettext("expected"), 10), (gettext("computed"), 10), (gettext("error"), 8), (gettext("tolerance"), 9)):
        grid.add_column(name, width=width, justify="right", overflow="fold")
    for r in results:
        numbers = (format_short(r.expected), format_short(r.computed), format_short(r.error, 2), format_short(r.case.tolerance, 2))
        grid.add_row(Padding(styled_line(r.case.place), (0, 0, 0, 2)), styled_line(quantity_with_kind(r)), *numbers)
    return Constrain(grid, WIDTH)


def quantity_label(result: CaseResult) -> str:
    """Return the compared quantity with its unit."""
    unit_text = unit_label(result.case)
    return gettext(result.case.quantity) + (f" ({unit_text})" if unit_text else "")


def unit_label(case: Case) -> str:
    """Return the unit of a case; empty without one."""
    return "" if case.unit == "1" else case.unit.replace("^2", "²")


def quantity_with_kind(result: CaseResult) -> str:
    """Return the compared quantity, with the kind of evidence unless computed from the input of the paper."""
    kind = result.case.kind
    return quantity_label(result) if kind == "computed" else f"{quantity_label(result)} [{gettext(KINDS[kind])}]"


MAX_CHARACTERS = 10
"""Most characters of a number in a column."""

INTEGER_LIMIT, INTEGER_DIGITS = 1e5, 5
"""Numbers below this are printed without a power of ten."""


def format_short(value: float, digits: int = 5) -> str:
    """Return a number with `digits` significant digits in the fewest characters.

    Examples
    --------
    >>> format_short(909.6, 2), format_short(0.0123456), format_short(1e-12), format_short(12345678.0)
    ('910', '0.012346', '1e-12', '1.2346e7')
    """
    if not math.isfinite(value):
        return "-" if math.isnan(value) else str(value)
    if 10.0**digits <= abs(value) < INTEGER_LIMIT:
        value, digits = float(f"{value:.{digits}g}"), INTEGER_DIGITS
    text = f"{value:.{digits}g}".replace("e-0", "e-").replace("e+0", "e")
    return text if len(text) <= MAX_CHARACTERS or digits <= 2 else format_short(value, digits - 1)


def _kind_table(results: Sequence[CaseResult]) -> Any:
    """Return the number of cases by kind and verdict."""
    rows = [[gettext(EVIDENCE_KINDS[kind]), *_count_cells(counts)] for kind, counts in count_verdicts_by_kind(results).items()]
    return table(gettext("Evidence by kind"), [gettext("kind of evidence"), *map(gettext, _COUNT_HEADINGS)], rows)


def _paper_table(results: Sequence[CaseResult]) -> Any:
    """Return the number of cases by paper and verdict."""
    papers = dict.fromkeys(result.case.paper for result in results)
    counts = {paper: count_verdicts([result for result in results if result.case.paper == paper]) for paper in papers}
    header = [gettext("paper"), *map(gettext, _COUNT_HEADINGS)]
    return table(gettext("Evidence by paper"), header, [[paper, *_count_cells(counts[paper])] for paper in papers])


def _count_cells(counts: Mapping[Verdict, int]) -> list[int]:
    return [sum(counts.values()), counts["holds"], counts["differs"], counts["fails"]]


def _count_line(results: Sequence[CaseResult]) -> Text:
    verdict_counts = count_verdicts(results)
    singular, plural = N_("1 case: {verdicts}."), N_("{all} cases: {verdicts}.")
    return styled_line(
        gettext(singular if len(results) == 1 else plural, all=len(results), verdicts=verdict_counts_text(verdict_counts)),
        "bold red" * bool(verdict_counts["fails"]),
    )


def verdict_counts_text(verdict_counts: Mapping[Verdict, int]) -> str:
    """Return the number of cases by verdict.

    Examples
    --------
    >>> verdict_counts_text({"fails": 0, "differs": 1, "holds": 2})
    '2 agree, 1 differs as explained, 0 fail'
    """
    words = {
        "holds": (N_("1 agrees"), N_("{count} agree")),
        "differs": (N_("1 differs as explained"), N_("{count} differ as explained")),
        "fails": (N_("1 fails"), N_("{count} fail")),
    }
    parts = [
        lazy_gettext(words[verdict][0 if verdict_counts[verdict] == 1 else 1], count=verdict_counts[verdict])
        for verdict in reversed(VERDICTS)
    ]
    return gettext("{parts}", parts=parts)
