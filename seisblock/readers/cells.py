"""From lines of text to exact numbers, and to the line number when they are none."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from math import isfinite
from typing import NoReturn

import numpy as np

from seisblock.errors import RecordFormatError
from seisblock.limits import AT_A_TIME
from seisblock.readers.lines import pieces_of
from seisblock.records.record import sealed
from seisblock.typing import FloatArray
from seisblock.units import ACCELERATION_UNITS
from seisblock.words import said

_SHIFTS = {0.01: 2, 1e-3: 3}
"""Decimal places between a unit and m/s^2."""


def to_si(values: FloatArray, unit: str) -> FloatArray:
    """Return accelerations in m/s^2; for gal and mm/s^2 the decimal point moves, so that 306.21 gal is 3.0621 m/s^2 to the last bit."""
    return values if ACCELERATION_UNITS[unit] == 1.0 else _converted(values, unit, np.empty_like(values))


def turned_si(values: FloatArray, unit: str, sign: float = 1.0) -> FloatArray:
    """Return accelerations, (n,), that nobody else holds in m/s^2, in their own place, times a sign; read-only from now on."""
    _converted(values, unit, values)
    values *= sign
    return sealed(values)


def _converted(values: FloatArray, unit: str, into: FloatArray) -> FloatArray:
    """Write accelerations in m/s^2 into a row, which may be their own, and return it."""
    factor = ACCELERATION_UNITS[unit]
    if factor not in _SHIFTS:
        return np.multiply(values, factor, out=into)
    for places in (3, 6):  # decimals that files are written with
        if all(_has_decimals(values[begin : begin + AT_A_TIME], places) for begin in range(0, values.size, AT_A_TIME)):
            np.multiply(values, 10.0**places, out=into)
            np.rint(into, out=into)
            return np.divide(into, 10.0 ** (places + _SHIFTS[factor]), out=into)
    return np.divide(values, 10.0 ** _SHIFTS[factor], out=into)


def _has_decimals(values: FloatArray, places: int) -> bool:
    """Return whether numbers are those of so many decimals."""
    with np.errstate(over="ignore"):
        whole = np.rint(values * 10.0**places)
    return bool(np.abs(whole).max() < 2**53 and np.array_equal(whole / 10.0**places, values))


def columns_of(
    name: str, lines: Sequence[str], first_line: int, columns: Mapping[str, int], width: int, separator: str | None = ","
) -> list[FloatArray]:
    """Return chosen columns of a table, each an array of its own, (lines,), that nobody else holds.

    Parameters
    ----------
    name : str
        Of the file, for messages.
    lines : sequence of str
        The table; blank lines are skipped.
    first_line : int
        Number of ``lines[0]`` in the file, counted from 1.
    columns : mapping of str to int
        Label (for messages) and index of each column wanted.
    width : int
        Number of columns the header announces; further cells must be blank.
    separator : str or None
        Between cells; None is any run of blanks.

    Raises
    ------
    RecordFormatError
        If there is no line, or a cell is missing, is text or is not finite; the message names the line.
    """
    if not any(line.strip() for line in lines):
        raise RecordFormatError("{name} ends after its header (line {line}): there are no samples in it", name=name, line=first_line - 1)
    filled = _filled(lines, separator)
    table = None if filled is None else _fast(lines, columns, separator, filled)
    if table is None or not all(np.isfinite(column).all() for column in table):
        table = list(np.ascontiguousarray(_careful(name, lines, first_line, columns, width, separator).T))
    if not table or not table[0].size:
        raise RecordFormatError("{name}: the lines after its header (line {line}) hold no samples", name=name, line=first_line - 1)
    return table


def _filled(lines: Sequence[str], separator: str | None) -> int | None:
    """Return how many lines are not blank; None where one has not as many separators as the first, so that a cell may have slipped."""
    filled = separators = written = 0
    for piece in pieces_of(lines):
        filled += sum(1 for line in piece if line.strip())
        if separator is not None:
            separators += "\n".join(piece).count(separator)
            written += sum(1 for line in piece if line)
    # without a separator the width of the table tells
    even = separator is None or separators == lines[0].count(separator) * written
    return filled if even else None


def _fast(lines: Sequence[str], columns: Mapping[str, int], separator: str | None, filled: int) -> list[FloatArray] | None:
    """Return the columns through numpy's own parser, or None when it stumbles."""
    indices = list(columns.values())
    found = [np.empty(filled) for _ in indices]
    begin, widths = 0, set()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            for piece in pieces_of(lines):
                if separator is None:
                    rows = np.loadtxt(piece, comments=None, ndmin=2)
                    widths.add(rows.shape[1])
                    rows = rows[:, indices]
                else:
                    rows = np.loadtxt(piece, delimiter=separator, comments=None, usecols=indices, ndmin=2)
                for column, values in zip(found, rows.T, strict=True):
                    column[begin : begin + values.size] = values
                begin += len(rows)
        except (ValueError, IndexError):
            return None
    return found if begin == filled and len(widths) < 2 else None


def _careful(name: str, lines: Sequence[str], first_line: int, columns: Mapping[str, int], width: int, separator: str | None) -> FloatArray:
    """Return the table cell by cell, naming the first line that is wrong."""
    rows: list[list[float]] = []
    last = len(lines)
    while last and not lines[last - 1].strip(" \t" + (separator or "")):
        last -= 1  # a spreadsheet's empty rows at the end
    for offset, line in enumerate(lines[:last]):
        if not line.strip():
            continue
        cells = line.split(separator)
        if any(cell.strip() for cell in cells[width:]):
            fail(name, first_line + offset, said("expected {width} cells, found {count}", width=width, count=len(cells)))
        rows.append([_number(name, first_line + offset, label, cells, index) for label, index in columns.items()])
    return np.array(rows, dtype=np.float64)


def _number(name: str, line: int, label: str, cells: Sequence[str], index: int) -> float:
    """Return the number in one cell."""
    cell = cells[index].strip() if index < len(cells) else ""
    try:
        value = float(cell)
    except ValueError:
        value = float("nan")
        if cell:
            fail(name, line, said("expected a number in column {label}, found {cell!r}", label=label, cell=cell))
    if not cell:
        fail(name, line, said("the cell of column {label} is empty", label=label))
    if not isfinite(value):
        fail(name, line, said("column {label} holds {cell!r}, which is no acceleration", label=label, cell=cell))
    return value


def fail(name: str, line: int, what: str) -> NoReturn:
    """Raise the error that a line of a file deserves."""
    raise RecordFormatError("{name}, line {line}: {what}; correct the file or cut it before that line", name=name, line=line, what=what)
