"""Lost decimal points and truncated last numbers, detected from the printed decimals of a column."""

from __future__ import annotations

import re
from collections.abc import Sequence

from seisblock.readers._header import qc_flag
from seisblock.records import QCFlag

MIN_LINES = 10
"""Minimum number of lines to determine the printed decimals."""

MAX_MISSING_SHARE = 0.02
"""Largest ratio of lines without a decimal point in a column of decimals."""

TAIL_LINES = 100
"""Lines at the end used to determine the decimals of the last number."""

_DECIMALS = re.compile(r"[-+]?\d*\.(\d*)(?:[eEdD][-+]?\d+)?")
_INTEGER = re.compile(r"[-+]?\d+")


def flag_missing_points(lines: Sequence[str], first_line: int, separator: str | None) -> tuple[QCFlag, ...]:
    """Return a flag if numbers lack the decimal point while all others of the column have equal decimals.

    Parameters
    ----------
    lines : sequence of str
        Lines of the table; blank lines are skipped.
    first_line : int
        Number of ``lines[0]`` in the file, counted from 1.
    separator : str or None
        Cell separator; None for any run of blanks.
    """
    count = sum(1 for line in lines if line.strip())
    # the prefilter avoids splitting every line of a large table
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
    message = (
        "{count} number(s) without a decimal point (first: {cell} in line {line}), all others of the column have {decimals} "
        "decimals: decimal point probably lost"
    )
    return (qc_flag(message, "point", count=len(cells_without_point), line=line, cell=cell[:40], decimals=printed_decimals),)


def flag_truncated_end(lines: Sequence[str], separator: str | None) -> tuple[QCFlag, ...]:
    """Return a flag if the last line has no line end and its last number fewer decimals than its column.

    Parameters
    ----------
    lines, separator
        As in :func:`flag_missing_points`; a text with a final line end has an empty last line.
    """
    if not lines or not lines[-1].strip():
        return ()
    *decimal_counts, last = [_count_decimals(line.split(separator)[-1]) for line in lines[-TAIL_LINES:] if line.strip()]
    if len(decimal_counts) < MIN_LINES or len(set(decimal_counts)) > 1 or last >= decimal_counts[0]:
        return ()
    return (qc_flag("no line end after the last line: file probably truncated, last number incomplete", "cut"),)


def _count_decimals(cell: str) -> int:
    match = _DECIMALS.fullmatch(cell.strip())
    return len(match[1]) if match else 0


def _may_miss_points(lines: Sequence[str], row_count: int) -> bool:
    """Return whether the total of points is slightly below a multiple of the rows, a cheap prefilter."""
    missing_count = -sum(line.count(".") for line in lines) % row_count
    return 0 < missing_count <= max(1.0, MAX_MISSING_SHARE * row_count) * 8
