"""Conversion of table text to numbers, with the line number in errors."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from math import isfinite

import numpy as np

from seisblock.core.arrays import readonly
from seisblock.core.errors import RecordFormatError
from seisblock.core.limits import CHUNK_SIZE
from seisblock.core.typing import FloatArray
from seisblock.core.units import ACCELERATION_UNITS
from seisblock.readers.lines import iter_chunks, line_error

_DECIMAL_SHIFTS = {0.01: 2, 1e-3: 3}
"""Decimal places between a unit and m/s^2."""


def to_si(values: FloatArray, unit: str) -> FloatArray:
    """Return accelerations in m/s^2; gal and mm/s^2 are shifted by decimal places without rounding error."""
    return values if ACCELERATION_UNITS[unit] == 1.0 else _convert(values, unit, np.empty_like(values))


def to_si_in_place(values: FloatArray, unit: str, sign: float = 1.0) -> FloatArray:
    """Convert accelerations, (n,), to m/s^2 times a sign in place; return them read-only."""
    _convert(values, unit, values)
    values *= sign
    return readonly(values)


def _convert(values: FloatArray, unit: str, target: FloatArray) -> FloatArray:
    """Write accelerations in m/s^2 into `target`, which may be `values`, and return it."""
    factor = ACCELERATION_UNITS[unit]
    # 306.21 * 0.01 differs from 3.0621 in the last bit; rounding to an integer and one division gives the nearest float
    if factor not in _DECIMAL_SHIFTS:
        return np.multiply(values, factor, out=target)
    for places in (3, 6):  # decimals common in files
        if all(_has_decimals(values[begin : begin + CHUNK_SIZE], places) for begin in range(0, values.size, CHUNK_SIZE)):
            np.multiply(values, 10.0**places, out=target)
            np.rint(target, out=target)
            return np.divide(target, 10.0 ** (places + _DECIMAL_SHIFTS[factor]), out=target)
    return np.divide(values, 10.0 ** _DECIMAL_SHIFTS[factor], out=target)


def _has_decimals(values: FloatArray, places: int) -> bool:
    """Return whether all values have at most `places` decimals."""
    with np.errstate(over="ignore"):
        scaled_integers = np.rint(values * 10.0**places)
    return bool(np.abs(scaled_integers).max() < 2**53 and np.array_equal(scaled_integers / 10.0**places, values))


def parse_columns(
    name: str, lines: Sequence[str], first_line: int, columns: Mapping[str, int], width: int, separator: str | None = ","
) -> list[FloatArray]:
    """Return selected columns of a table, one array of shape (lines,) each.

    `first_line` is the number of ``lines[0]`` in the file, from 1; blank lines are skipped. `columns` are labels (for messages) and
    indices, `width` is the number of columns in the header: further cells must be blank. A `separator` of None is any run of blanks.

    Raises
    ------
    RecordFormatError
        If there are no lines, or a cell is missing, not a number, or not finite; the message names the line.
    """
    if not any(line.strip() for line in lines):
        raise RecordFormatError("{name}: no samples after the header (line {line})", name=name, line=first_line - 1)
    row_count = _count_rows(lines, width, separator)
    table = None if row_count is None else _parse_with_numpy(lines, columns, width, separator, row_count)
    # slow path: locates the first invalid cell
    if table is None or not all(np.isfinite(column).all() for column in table):
        table = list(np.ascontiguousarray(_parse_cell_by_cell(name, lines, first_line, columns, width, separator).T))
    if not table or not table[0].size:
        raise RecordFormatError("{name}: no samples in the lines after the header (line {line})", name=name, line=first_line - 1)
    for label, values in zip(columns, table, strict=True):
        _check_thousands(name, label, values)
    return table


def _check_thousands(name: str, label: str, values: FloatArray) -> None:
    """Raise if separators of thousands were read as decimal points: 998, 999, 1.001.

    Whole numbers then reach 500 but not 1000, and all others lie between 1 and 100 and have three decimals or fewer.
    """
    magnitudes = np.abs(values)
    if not 500.0 <= magnitudes.max() < 1000.0:
        return
    others = magnitudes[magnitudes != np.floor(magnitudes)]
    if others.size and others.min() > 1.0 and others.max() < 100.0 and _has_decimals(others, 3):
        message = (
            "{name}: column {label} mixes whole numbers up to {whole:g} with {other:.3f}: separators of thousands? write numbers without"
        )
        raise RecordFormatError(message, name=name, label=label, whole=magnitudes.max(), other=others[0])


def _count_rows(lines: Sequence[str], width: int, separator: str | None) -> int | None:
    """Return the number of nonblank lines; None if lines differ in their number of separators or have more than `width` nonblank cells."""
    row_count = separators = nonempty_count = 0
    for piece in iter_chunks(lines):
        row_count += sum(map(bool, map(str.strip, piece)))
        if separator is not None:
            separators += "\n".join(piece).count(separator)
            nonempty_count += sum(map(bool, piece))
    # blank-separated tables are checked by the number of parsed columns instead
    if separator is None:
        return row_count
    excess = lines[0].count(separator) + 1 - width
    is_regular = separators == lines[0].count(separator) * nonempty_count
    if is_regular and excess > 0:
        is_regular = not any(cell.strip() for line in lines for cell in line.rsplit(separator, excess)[1:])
    return row_count if is_regular else None


def _parse_with_numpy(
    lines: Sequence[str], columns: Mapping[str, int], width: int, separator: str | None, row_count: int
) -> list[FloatArray] | None:
    """Return the columns parsed by numpy, or None on failure."""
    indices = list(columns.values())
    arrays = [np.empty(row_count) for _ in indices]
    begin, widths = 0, set()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            for piece in iter_chunks(lines):
                if separator is None:
                    # all columns, to check that every line has the same width
                    rows = np.loadtxt(piece, comments=None, ndmin=2)
                    widths.add(rows.shape[1])
                    rows = rows[:, indices]
                else:
                    rows = np.loadtxt(piece, delimiter=separator, comments=None, usecols=indices, ndmin=2)
                for column, values in zip(arrays, rows.T, strict=True):
                    column[begin : begin + values.size] = values
                begin += len(rows)
        except (ValueError, IndexError):
            return None
    return arrays if begin == row_count and widths <= {width} else None


def _parse_cell_by_cell(
    name: str, lines: Sequence[str], first_line: int, columns: Mapping[str, int], width: int, separator: str | None
) -> FloatArray:
    """Return the table parsed cell by cell; raise with the first invalid line."""
    rows: list[list[float]] = []
    last = len(lines)
    while last and not lines[last - 1].strip(" \t" + (separator or "")):
        last -= 1  # empty rows at the end of a spreadsheet
    for offset, line in enumerate(lines[:last]):
        if not line.strip():
            continue
        cells = line.split(separator)
        if any(cell.strip() for cell in cells[width:]):
            message = "expected {width} cells, found {count}"
            if separator == ",":
                message = (
                    "expected {width} cells, found {count} (commas in the numbers? write decimal points and no separators of thousands)"
                )
            raise line_error(message, name, first_line + offset, width=width, count=len(cells))
        rows.append([_parse_cell(name, first_line + offset, label, cells, index) for label, index in columns.items()])
    return np.array(rows, dtype=np.float64)


def _parse_cell(name: str, line: int, label: str, cells: Sequence[str], index: int) -> float:
    cell = cells[index].strip() if index < len(cells) else ""
    try:
        value = float(cell)
    except ValueError:
        value = float("nan")
        if cell:
            raise line_error("expected a number in column {label}, found {cell!r}", name, line, label=label, cell=cell) from None
    if not cell:
        raise line_error("empty cell in column {label}", name, line, label=label)
    if not isfinite(value):
        raise line_error("expected a finite number in column {label}, found {cell!r}", name, line, label=label, cell=cell)
    return value
