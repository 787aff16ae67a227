"""Numbers that lost their decimal point, or at the end of a file decimals: a column that is printed to so many shows them in every line."""

from __future__ import annotations

import re
from collections.abc import Sequence

from seisblock.records import Doubt
from seisblock.words import said

LEAST_LINES = 10
"""Shortest table that shows how it is printed."""

MOST_LOST = 0.02
"""Share of its lines in which a column may lack the point and still be one of decimals."""

LOOKED_BACK = 100
"""Lines at the end that show how the last number would be printed."""

_DECIMALS = re.compile(r"[-+]?\d*\.(\d*)(?:[eEdD][-+]?\d+)?")
_WHOLE = re.compile(r"[-+]?\d+")


def doubts_of_decimals(lines: Sequence[str], first_line: int, separator: str | None) -> tuple[Doubt, ...]:
    """Return a doubt about a table in which a number has no decimal point though all others of its column have as many decimals.

    Parameters
    ----------
    lines : sequence of str
        The table; blank lines are passed over.
    first_line : int
        Number of ``lines[0]`` in the file, counted from 1.
    separator : str or None
        Between cells; None is any run of blanks.
    """
    count = sum(1 for line in lines if line.strip())
    if count < LEAST_LINES or not _some_are_lost(lines, count):
        return ()
    filled = [(first_line + i, line) for i, line in enumerate(lines) if line.strip()]
    found: list[tuple[int, str, int]] = []
    for cells in zip(*(line.split(separator) for _, line in filled), strict=False):
        tidy = [cell.strip() for cell in cells]
        decimals = {len(match[1]) for cell in tidy if (match := _DECIMALS.fullmatch(cell))}
        whole = [i for i, cell in enumerate(tidy) if _WHOLE.fullmatch(cell)]
        if len(decimals) == 1 and max(decimals) > 0 and 0 < len(whole) <= max(1.0, MOST_LOST * len(filled)):
            found += [(filled[i][0], tidy[i], max(decimals)) for i in whole]
    if not found:
        return ()
    line, cell, decimals_printed = min(found)
    text = said(
        "{count} number(s) have no decimal point (the first in line {line}: {cell}) where all others of the column have {decimals} "
        "decimals: the point may be lost",
        count=len(found),
        line=line,
        cell=cell[:40],
        decimals=decimals_printed,
    )
    return (Doubt("point", text),)


def doubts_of_end(lines: Sequence[str], separator: str | None) -> tuple[Doubt, ...]:
    """Return a doubt about a table that ends without an end of line, in a number of fewer decimals than its column has.

    Parameters
    ----------
    lines, separator
        As in :func:`doubts_of_decimals`; a text that ends with an end of line has an empty last one.
    """
    if not lines or not lines[-1].strip():
        return ()
    *others, last = [_decimals_of(line.split(separator)[-1]) for line in lines[-LOOKED_BACK:] if line.strip()]
    if len(others) < LEAST_LINES or len(set(others)) > 1 or last >= others[0]:
        return ()
    return (Doubt("cut", said("the last line has no end: the file looks cut, and its last number with it")),)


def _decimals_of(cell: str) -> int:
    """Return how many decimals a number is printed to."""
    match = _DECIMALS.fullmatch(cell.strip())
    return len(match[1]) if match else 0


def _some_are_lost(lines: Sequence[str], filled: int) -> bool:
    """Return whether the number of points in a table is a little short of a whole number of columns: counting costs next to nothing."""
    short = -sum(line.count(".") for line in lines) % filled
    return 0 < short <= max(1.0, MOST_LOST * filled) * 8
