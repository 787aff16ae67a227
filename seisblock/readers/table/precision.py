"""Numbers that lost their decimal point, or at the end of a file decimals: a column that is printed to so many shows them in every line."""

from __future__ import annotations

import re
from collections.abc import Sequence

from seisblock.core.i18n import lazy_gettext
from seisblock.records import QCFlag

MIN_LINES = 10
"""Shortest table that shows how it is printed."""

MAX_MISSING_SHARE = 0.02
"""Share of its lines in which a column may lack the point and still be one of decimals."""

TAIL_LINES = 100
"""Lines at the end that show how the last number would be printed."""

_DECIMALS = re.compile(r"[-+]?\d*\.(\d*)(?:[eEdD][-+]?\d+)?")
_INTEGER = re.compile(r"[-+]?\d+")


def flag_missing_points(lines: Sequence[str], first_line: int, separator: str | None) -> tuple[QCFlag, ...]:
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
    if count < MIN_LINES or not _may_miss_points(lines, count):
        return ()
    numbered_lines = [(first_line + i, line) for i, line in enumerate(lines) if line.strip()]
    cells_without_point: list[tuple[int, str, int]] = []
    for cells in zip(*(line.split(separator) for _, line in numbered_lines), strict=False):
        column_cells = [cell.strip() for cell in cells]
        decimals = {len(match[1]) for cell in column_cells if (match := _DECIMALS.fullmatch(cell))}
        integer_rows = [i for i, cell in enumerate(column_cells) if _INTEGER.fullmatch(cell)]
        if len(decimals) == 1 and max(decimals) > 0 and 0 < len(integer_rows) <= max(1.0, MAX_MISSING_SHARE * len(numbered_lines)):
            cells_without_point += [(numbered_lines[i][0], column_cells[i], max(decimals)) for i in integer_rows]
    if not cells_without_point:
        return ()
    line, cell, printed_decimals = min(cells_without_point)
    text = lazy_gettext(
        "{count} number(s) without a decimal point (first: {cell} in line {line}), all others of the column have {decimals} "
        "decimals: decimal point probably lost",
        count=len(cells_without_point),
        line=line,
        cell=cell[:40],
        decimals=printed_decimals,
    )
    return (QCFlag("point", text),)


def flag_truncated_end(lines: Sequence[str], separator: str | None) -> tuple[QCFlag, ...]:
    """Return a doubt about a table that ends without an end of line, in a number of fewer decimals than its column has.

    Parameters
    ----------
    lines, separator
        As in :func:`flag_missing_points`; a text that ends with an end of line has an empty last one.
    """
    if not lines or not lines[-1].strip():
        return ()
    *decimal_counts, last = [_count_decimals(line.split(separator)[-1]) for line in lines[-TAIL_LINES:] if line.strip()]
    if len(decimal_counts) < MIN_LINES or len(set(decimal_counts)) > 1 or last >= decimal_counts[0]:
        return ()
    return (QCFlag("cut", lazy_gettext("no line end after the last line: file probably truncated, last number incomplete")),)


def _count_decimals(cell: str) -> int:
    """Return how many decimals a number is printed to."""
    match = _DECIMALS.fullmatch(cell.strip())
    return len(match[1]) if match else 0


def _may_miss_points(lines: Sequence[str], row_count: int) -> bool:
    """Return whether the number of points in a table is a little short of a whole number of columns: counting costs next to nothing."""
    missing_count = -sum(line.count(".") for line in lines) % row_count
    return 0 < missing_count <= max(1.0, MAX_MISSING_SHARE * row_count) * 8
