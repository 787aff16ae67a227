"""How the evidence is told: what differs from a paper and why, first; then everything that holds."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from rich.constrain import Constrain
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from seisblock.validation.case import VERDICTS, CaseResult, counts

WIDTH = 110
"""Widest line, characters."""

_HEADINGS = {
    "fails": "What should agree and does not",
    "differs": "What differs from the papers, and why",
    "holds": "What holds",
}
_STYLES = {"fails": "bold red", "differs": "bold yellow", "holds": "bold green"}


def tables(results: Sequence[CaseResult]) -> Iterator[Any]:
    """Yield what is printed: for each verdict the cases paper by paper, explanations under what differs, and the count at the end."""
    for verdict in VERDICTS:
        chosen = [result for result in results if result.verdict == verdict]
        if chosen:
            yield Text(_HEADINGS[verdict], style=_STYLES[verdict])
            yield _grid(heading=True)
            for paper in dict.fromkeys(result.case.paper for result in chosen):
                yield Text(paper, style="italic")
                part = [result for result in chosen if result.case.paper == paper]
                yield from _explained(part) if verdict == "differs" else [_grid(part)]
            yield Text()
    yield _count(results)


def _explained(results: Sequence[CaseResult]) -> Iterator[Any]:
    """Yield the cases of each explanation, with the explanation below them."""
    for note in dict.fromkeys(result.case.note for result in results):
        yield _grid([result for result in results if result.case.note == note])
        yield Constrain(Padding(Text(f"why: {note}", style="dim"), (0, 2, 1, 4)), WIDTH)


def _grid(results: Sequence[CaseResult] = (), *, heading: bool = False) -> Any:
    """Return expected, computed, difference and tolerance, one row per case; columns align from one grid to the next."""
    made = Table(box=None, show_header=heading, pad_edge=False, width=None, expand=True)
    made.add_column("  where", width=12)
    made.add_column("quantity", ratio=1)
    for name, width in (("expected", 10), ("computed", 10), ("error", 8), ("tolerance", 9)):
        made.add_column(name, width=width, justify="right", overflow="fold")
    for r in results:
        numbers = (short(r.case.expected), short(r.computed), short(r.error, 2), short(r.case.tolerance, 2))
        made.add_row(Padding(Text(r.case.place, overflow="fold"), (0, 0, 0, 2)), Text(quantity(r), overflow="fold"), *numbers)
    return Constrain(made, WIDTH)


def quantity(result: CaseResult) -> str:
    """Return what is compared, with its unit."""
    return result.case.quantity + (f" ({result.case.unit})" if result.case.unit not in ("", "1") else "")


LONGEST = 10
"""Most characters of a number in a column."""


def short(value: float, digits: int = 5) -> str:
    """Return a number with so many significant digits, in as few characters as that takes."""
    if not math.isfinite(value):
        return "-" if math.isnan(value) else str(value)
    text = f"{value:.{digits}g}".replace("e-0", "e-").replace("e+0", "e")
    return text if len(text) <= LONGEST or digits <= 2 else short(value, digits - 1)


def _count(results: Sequence[CaseResult]) -> Text:
    """Return the last line."""
    counted = counts(results)
    told = Text(f"{len(results)} cases: ")
    told.append(f"{counted['holds']} hold", style="green" if counted["holds"] else "")
    told.append(f", {counted['differs']} differ as explained, ")
    return told.append(f"{counted['fails']} fail", style="bold red" if counted["fails"] else "").append(".")
