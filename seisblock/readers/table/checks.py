"""Checks of the text of a table: lost decimal points, truncated ends, comments that contradict the numbers."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from seisblock.readers._header import parse_number
from seisblock.readers._header_check import qc_flag
from seisblock.readers.lines import iter_chunks
from seisblock.readers.table.columns import Column
from seisblock.readers.table.headers import TIME, normalize_unit
from seisblock.records import QCFlag

MIN_LINES = 10
"""Minimum number of lines to determine the printed decimals."""

MAX_MISSING_SHARE = 0.02
"""Largest ratio of lines without a decimal point in a column of decimals."""

TAIL_LINES = 100
"""Lines at the end used to determine the decimals of the last number."""

_DECIMALS = re.compile(r"[-+]?\d*\.(\d*)(?:[eEdD][-+]?\d+)?")
_INTEGER = re.compile(r"[-+]?(?!0+$)\d+")
"""Whole number, but for zero, which loses nothing with its decimal point."""


def flag_missing_points(lines: Sequence[str], first_line: int, separator: str | None) -> tuple[QCFlag, ...]:
    """Return a flag if numbers lack the decimal point while all others of the column have equal decimals.

    `first_line` is the number of ``lines[0]`` in the file, from 1; blank lines are skipped. A `separator` of None is any run of blanks.
    """
    count = sum(sum(map(bool, map(str.strip, piece))) for piece in iter_chunks(lines))
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

    A text with a final line end has an empty last line.
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
    # with k columns of decimals each row has k points: the total falls short of a multiple by the lost ones
    missing_count = -sum("\n".join(piece).count(".") for piece in iter_chunks(lines)) % row_count
    return 0 < missing_count <= max(1.0, MAX_MISSING_SHARE * row_count) * 8


_NUMBER = r"\s*[=:]\s*([\d.]++(?:e[-+]?\d++)?+)"
_COUNT = re.compile(r"\b(?:npts|(?:number|no\.?) of (?:samples|points))" + _NUMBER, re.IGNORECASE)
_INTERVAL = re.compile(r"\b(?:dt|(?:sampling|time) (?:interval|step))(?:\s*\(s\))?" + _NUMBER + r"(?!\s*ms)", re.IGNORECASE)
_RATE = re.compile(r"\b(?:fs|(?:sampling|sample) (?:rate|frequency))(?:\s*\(Hz\))?" + _NUMBER + r"(?!\s*kHz)", re.IGNORECASE)
_UNIT = re.compile(r"\bunits?\s*[=:]\s*([^\s,;]+)", re.IGNORECASE)
_INTERVAL_TOLERANCE = 1e-3
"""Relative tolerance of an interval against a comment, which is rounded."""


def flag_comment_mismatch(comments: Sequence[str], columns: Sequence[Column], samples: int, dt: float) -> tuple[QCFlag, ...]:
    """Return flags for `comments`, the lines above the numbers, that contradict columns, number of samples or sampling interval, s."""
    text = "\n".join(line for line in comments if line.lstrip("\ufeff ").startswith("#"))
    return (*_flag_count(text, samples), *_flag_interval(text, dt), *_flag_unit(text, columns))


def _flag_count(text: str, samples: int) -> Iterator[QCFlag]:
    for count in _COUNT.findall(text):
        if parse_number(count) not in (None, samples):
            yield qc_flag("{promised} samples stated in a comment, file contains {count}", "count", promised=count, count=samples)


def _flag_interval(text: str, dt: float) -> Iterator[QCFlag]:
    for pattern, actual, unit in ((_INTERVAL, dt, "s"), (_RATE, 1.0 / dt, "Hz")):
        for value_text in pattern.findall(text):
            value = parse_number(value_text)
            if value is not None and abs(value - actual) > _INTERVAL_TOLERANCE * actual:
                yield qc_flag(
                    "{comment_value} {unit} in a comment differs from the sampling interval, {dt:g} s",
                    "clock",
                    comment_value=value_text,
                    unit=unit,
                    dt=dt,
                )


def _flag_unit(text: str, columns: Sequence[Column]) -> Iterator[QCFlag]:
    units = {column.unit for column in columns if column.code != TIME}
    for unit_text in _UNIT.findall(text):
        unit = normalize_unit(unit_text.rstrip(".)"))
        if unit is not None and unit not in units:
            yield qc_flag(
                "unit {comment_unit} in a comment differs from the unit of the columns, {units}",
                "header",
                comment_unit=unit,
                units=sorted(units),
            )
