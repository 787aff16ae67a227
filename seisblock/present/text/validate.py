"""How the evidence is told: what differs from a paper and why, first; then everything that holds."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from rich.constrain import Constrain
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from seisblock.present.text.tables import line, table
from seisblock.validation.case import VERDICTS, WORTHS, Case, CaseResult, Verdict, Worth, counts, counts_by_kind
from seisblock.words import noted, said, strung, tell

WIDTH = 110
"""Widest line, characters."""

_HEADINGS: dict[Verdict, str] = {
    "fails": noted("What does not read as claimed"),
    "differs": noted("What differs from the papers, and why"),
    "holds": noted("What holds"),
}
_STYLES: dict[Verdict, str] = {"fails": "bold red", "differs": "bold yellow", "holds": "bold green"}

KINDS: dict[Worth, str] = {
    "computed": noted("computed"),
    "rebuilt": noted("input rebuilt"),
    "derived": noted("derived here"),
    "print": noted("print itself"),
}
"""Short names of what a case is worth."""


def tables(results: Sequence[CaseResult], *, every: bool = True) -> Iterator[Any]:
    """Yield what is printed: how many hold; what fails, what differs and why, paper by paper; what holds, if all is asked for; counts.

    Parameters
    ----------
    results : sequence of CaseResult
    every : bool
        Whether the cases that hold are listed, too.
    """
    yield _count(results, every=every)
    for verdict in VERDICTS:
        chosen = [result for result in results if result.verdict == verdict]
        if chosen and (every or verdict != "holds"):
            yield line(tell(_HEADINGS[verdict]), _STYLES[verdict])
            yield _grid(heading=True)
            for paper in dict.fromkeys(result.case.paper for result in chosen):
                yield line(paper, "italic")
                part = [result for result in chosen if result.case.paper == paper]
                yield from [_grid(part)] if verdict == "holds" else _explained(part)
            yield line()
    yield _kinds(results)


def _explained(results: Sequence[CaseResult]) -> Iterator[Any]:
    """Yield the cases of each explanation, with the explanation below them."""
    for note in dict.fromkeys(map(explanation, results)):
        yield _grid([result for result in results if explanation(result) == note])
        if note:
            yield Constrain(Padding(line(tell("why: {reason}", reason=note), "dim"), (0, 2, 1, 4)), WIDTH)


def explanation(result: CaseResult) -> str:
    """Return why a case differs; or, of one that fails, what was claimed of it."""
    case = result.case
    if result.verdict != "fails":
        return tell(case.note)
    if math.isnan(result.computed):
        return tell("it could not be computed")
    if case.status == "holds":
        return tell("should agree and does not")
    if case.today is None or abs(result.error) <= case.tolerance:
        return tell("is said to differ, and agrees")
    return tell("differs by another amount than was explained: {value:.6g} then", value=case.today[0])


def _grid(results: Sequence[CaseResult] = (), *, heading: bool = False) -> Any:
    """Return expected, computed, difference and tolerance, one row per case; columns align from one grid to the next."""
    made = Table(box=None, show_header=heading, pad_edge=False, width=None, expand=True)
    made.add_column("  " + tell("where"), width=13)
    made.add_column(tell("quantity"), ratio=1)
    for name, width in ((tell("expected"), 10), (tell("computed"), 10), (tell("error"), 8), (tell("tolerance"), 9)):
        made.add_column(name, width=width, justify="right", overflow="fold")
    for r in results:
        numbers = (short(r.expected), short(r.computed), short(r.error, 2), short(r.case.tolerance, 2))
        made.add_row(Padding(line(r.case.place), (0, 0, 0, 2)), line(labelled(r)), *numbers)
    return Constrain(made, WIDTH)


def quantity(result: CaseResult) -> str:
    """Return what is compared, with its unit."""
    named = unit(result.case)
    return tell(result.case.quantity) + (f" ({named})" if named else "")


def unit(case: Case) -> str:
    """Return the unit of a case as it is printed, nothing where it has none."""
    return "" if case.unit == "1" else case.unit.replace("^2", "²")


def labelled(result: CaseResult) -> str:
    """Return what is compared, and what the case is worth where the program is not compared with the paper itself."""
    kind = result.case.kind
    return quantity(result) if kind == "computed" else f"{quantity(result)} [{tell(KINDS[kind])}]"


LONGEST = 10
"""Most characters of a number in a column."""

WHOLE, WHOLE_DIGITS = 1e5, 5
"""Below this a number is told without a power of ten."""


def short(value: float, digits: int = 5) -> str:
    """Return a number with so many significant digits, in as few characters as that takes.

    Examples
    --------
    >>> short(909.6, 2), short(0.0123456), short(1e-12), short(12345678.0)
    ('910', '0.012346', '1e-12', '1.2346e7')
    """
    if not math.isfinite(value):
        return "-" if math.isnan(value) else str(value)
    if 10.0**digits <= abs(value) < WHOLE:
        value, digits = float(f"{value:.{digits}g}"), WHOLE_DIGITS
    text = f"{value:.{digits}g}".replace("e-0", "e-").replace("e+0", "e")
    return text if len(text) <= LONGEST or digits <= 2 else short(value, digits - 1)


def _kinds(results: Sequence[CaseResult]) -> Any:
    """Return how many cases of each kind got each verdict."""
    rows = [
        [tell(WORTHS[kind]), sum(counted.values()), counted["holds"], counted["differs"], counted["fails"]]
        for kind, counted in counts_by_kind(results).items()
    ]
    heads = [tell("what a case is worth"), tell("cases"), tell("hold"), tell("differ"), tell("fail")]
    return table(tell("The evidence"), heads, rows)


def _count(results: Sequence[CaseResult], *, every: bool) -> Text:
    """Return the first line."""
    counted = counts(results)
    one, more = noted("1 case: {verdicts}."), noted("{all} cases: {verdicts}.")
    told = line(tell(one if len(results) == 1 else more, all=len(results), verdicts=verdicts(counted)), "bold red" * bool(counted["fails"]))
    return told if every else told.append(strung(["", tell("--all lists those that hold.")]), style="dim")


def verdicts(counted: Mapping[Verdict, int]) -> str:
    """Return how many cases got each verdict, in words.

    Examples
    --------
    >>> verdicts({"fails": 0, "differs": 1, "holds": 2})
    '2 hold, 1 differs as explained, 0 fail'
    """
    words = {
        "holds": (noted("1 holds"), noted("{count} hold")),
        "differs": (noted("1 differs as explained"), noted("{count} differ as explained")),
        "fails": (noted("1 fails"), noted("{count} fail")),
    }
    parts = [said(words[verdict][0 if counted[verdict] == 1 else 1], count=counted[verdict]) for verdict in reversed(VERDICTS)]
    return tell("{parts}", parts=parts)
