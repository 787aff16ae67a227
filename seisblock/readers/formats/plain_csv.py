"""Plain tables: columns by name, with units in the names, any common separator."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from seisblock.errors import ParameterError, RecordFormatError, UnitError
from seisblock.readers.cells import columns_of, turned_si
from seisblock.readers.clock import even_dt
from seisblock.readers.columns import Column, Columns, columns_of_header, means_something
from seisblock.readers.decimals import doubts_of_decimals, doubts_of_end
from seisblock.readers.formats.table_comments import doubts_of_comments
from seisblock.readers.lines import lines_of, mapped
from seisblock.readers.naming import TIME
from seisblock.readers.source import Blob
from seisblock.records import Component, Doubt, Record
from seisblock.typing import FloatArray
from seisblock.words import said

FORMAT = "CSV"
_QUOTED = re.compile(r'(?<![^\s,;])"([^"]*)"(?![^\s,;])')
_WIDTH_TOLERANT = {",", ";", "\t"}


@dataclass(frozen=True)
class TableLayout:
    """Where the numbers of a table begin and what its columns are called."""

    names: tuple[str, ...]
    body: int
    separator: str | None
    decimal_comma: bool = False


def looks_like_csv(lines: Sequence[str]) -> bool:
    """Return whether a text is a table of numbers, or at least has a header that names components or units."""
    body = next((i for i, line in enumerate(lines) if _is_data(line)), None)
    if body is None:
        return False
    separator = separator_of(lines[body])
    if _all_numbers(lines[body], separator):
        return True
    names = _split(lines[body], separator)
    if means_something(names):
        return True
    following = next((line for line in lines[body + 1 :] if _is_data(line)), "")
    return _all_numbers(following, separator_of(following)) and len(_split(following, separator_of(following))) == len(names)


def read_plain_csv(blob: Blob, *, units: str | None = None, dt: float | None = None) -> Record:
    """Return the record in a plain table.

    Parameters
    ----------
    blob : Blob
        Cells are separated by commas, semicolons (then a decimal comma is allowed), tabs or blanks; ``#`` starts a comment. The first line
        may name the columns (:func:`seisblock.readers.columns.columns_of_header`), a unit may stand in a name: ``EW (gal)``, ``ew_gal``,
        ``NS[m/s^2]``. A time column gives the sampling interval and must be even within the digits printed. Without names, a first
        column that climbs evenly is the time.
    units : str or None
        Unit of columns that name none.
    dt : float or None, s
        Sampling interval of a table without a time column.

    Raises
    ------
    RecordFormatError
        If a column is not understood or a cell is no number, with its name or line.
    UnitError
        If a unit is unknown, or missing and not given.
    ParameterError
        If the sampling interval is missing, or contradicts the time column.
    """
    lines = lines_of(blob)
    layout = layout_of(blob.name, lines)
    body = mapped(lines[layout.body :], lambda line: line if _is_data(line) else "")
    if layout.decimal_comma:
        body = mapped(body, lambda line: line.replace(",", "."))
    if any('"' in line for line in body[:3]):
        body = mapped(body, partial(_QUOTED.sub, r"\1"))
    named = any(layout.names)
    told = columns_of_header(blob.name, layout.names, units) if named else _unnamed(len(layout.names))
    if named and dt is None and not any(column.code == TIME for column in told.read):
        raise _without_interval(blob.name)  # before a day of numbers is read
    labels = {c.label if layout.names.count(c.label) == 1 else f"number {c.index + 1}": c.index for c in told.read}
    rows = columns_of(blob.name, body, layout.body + 1, labels, len(layout.names), layout.separator)
    if not named:
        told = _guessed(blob.name, rows, units)
    pairs = list(zip(told.read, rows, strict=True))
    metadata: dict[str, object] = {}
    for column, row in pairs:
        if column.code == TIME:
            dt = _interval(blob.name, column, row, body, layout.separator, dt)
            if row[0]:
                metadata["first_time_s"] = float(row[0]) * column.seconds
    if dt is None:
        raise _without_interval(blob.name)
    components = [Component(c.code, turned_si(row, c.unit, c.sign), c.azimuth_deg) for c, row in pairs if c.code != TIME]
    if not components:
        raise RecordFormatError(
            "{name} holds no acceleration: expected at least one such column, found {columns}",
            name=blob.name,
            columns=[name.strip() for name in layout.names] if named else [said("time")],
        )
    clocked = any(column.code == TIME for column in told.read)
    doubts = _doubts(lines, layout.body, clocked=clocked) + doubts_of_decimals(body, layout.body + 1, layout.separator)
    doubts += doubts_of_comments(lines[: layout.body], told.read, rows[0].size, dt)
    if not any(doubt.kind == "cut" for doubt in doubts):
        doubts += doubts_of_end(body, layout.separator)
    return Record(tuple(components), dt, source=blob.name, format=FORMAT, history=told.remarks, metadata=metadata, doubts=doubts)


def _without_interval(name: str) -> ParameterError:
    """Return the error of a table that does not say how far apart its samples are."""
    return ParameterError("{name} has no time column: give the sampling interval, `dt`, for example 0.01 s", name=name)


def _doubts(lines: Sequence[str], body: int, *, clocked: bool) -> tuple[Doubt, ...]:
    """Return what speaks for lines that were lost: one that is empty where nothing else counts them, and a last one cut short."""
    found = []
    last = max(i for i, line in enumerate(lines) if _is_data(line))
    empty = [] if clocked else [body + i + 1 for i, line in enumerate(lines[body:last]) if not line.strip()]
    if empty:
        text = said(
            "{count} line(s) are empty (the first is line {line}) where each stands for a sample: if samples are missing there, all later "
            "ones come too early",
            count=len(empty),
            line=empty[0],
        )
        found.append(Doubt("line", text))
    if last == len(lines) - 1 and last > body + 2 and len(lines[last]) < min(len(line) for line in lines[body:last] if _is_data(line)):
        found.append(Doubt("cut", said("the last line is the shortest and has no end: the file looks cut, and its last number with it")))
    return tuple(found)


def _unnamed(width: int) -> Columns:
    """Return the columns of a table without names, before anything is known of them."""
    return Columns(tuple(Column(i, f"number {i + 1}", "") for i in range(width)))


def _guessed(name: str, rows: Sequence[FloatArray], units: str | None) -> Columns:
    """Return what the columns of a table without names are: a first one that climbs evenly is the time, the others are accelerations."""
    first = rows[0]
    steps = np.diff(first)
    clock = len(rows) > 1 and first.size >= 3 and steps[0] > 0 and np.allclose(steps, steps.mean(), rtol=0.05, atol=0.0)
    names = ["time" if clock and i == 0 else f"C{i + 1}" for i in range(len(rows))]
    if len(rows) - clock == 1:
        names[-1] = "ACC"
    if units is None:
        raise UnitError(
            "{name}: column {column} has no unit: name it in a header, as in 'EW (gal)', or give `units`, gal|m/s2|g",
            name=name,
            column=1 + clock,
        )
    told = columns_of_header(name, names, units)
    return Columns(told.read, (said("took the first column, which climbs evenly, as the time in s"),) if clock else ())


def _interval(name: str, column: Column, row: FloatArray, body: Sequence[str], separator: str | None, dt: float | None) -> float:
    """Return the sampling interval that a column of times gives, s, which an interval given beside it must not contradict."""

    def written() -> list[str]:
        return [line.split(separator)[column.index].strip() for line in body if line.strip()][: row.size]

    found = even_dt(name, row, written, unit=column.seconds)
    if dt is not None and abs(dt - found) > 1e-6:
        raise ParameterError(
            "{name}: its time column says dt = {found:g} s, the option says {dt:g} s: leave the option out", name=name, found=found, dt=dt
        )
    return found


def layout_of(name: str, lines: Sequence[str]) -> TableLayout:
    """Return where the numbers begin, the names of the columns and the separator."""
    first = next((i for i, line in enumerate(lines) if _is_data(line)), None)
    if first is None:
        raise RecordFormatError("{name} holds comments only: expected columns of numbers", name=name)
    separator = separator_of(lines[first])
    if not _all_numbers(lines[first], separator):
        names = tuple(_split(lines[first], separator))
        return _closed(lines, TableLayout(names, first + 1, separator))
    width = len(_split(lines[first], separator))
    comment = next((line for line in reversed(lines[:first]) if line.strip()), "").lstrip("\ufeff# ")
    names = tuple(_split(comment, separator if separator in _WIDTH_TOLERANT else separator_of(comment)))
    if comment and len(names) == width and means_something(names):
        return _closed(lines, TableLayout(names, first, separator))
    return _closed(lines, TableLayout(("",) * width, first, separator))


def _closed(lines: Sequence[str], layout: TableLayout) -> TableLayout:
    """Return the layout after a look at the first line of numbers: trailing empty names off, another separator, decimal commas."""
    names = list(layout.names)
    while len(names) > 1 and not names[-1].strip() and any(names):
        names.pop()
    sample = next((line for line in lines[layout.body :] if _is_data(line)), "")
    separator = layout.separator
    if sample and separator is not None and separator not in sample and len(names) > 1:
        separator = separator_of(sample)
    return TableLayout(
        tuple(names), layout.body, separator, decimal_comma=separator not in (",", None) and "," in sample and "." not in sample
    )


def separator_of(line: str) -> str | None:
    """Return the separator of a line: semicolon, tab, comma, else blanks (None)."""
    return next((mark for mark in (";", "\t", ",") if mark in line), None)


def _is_data(line: str) -> bool:
    """Return whether a line is neither blank nor a comment."""
    return bool(line.strip(" \t,;\ufeff")) and not line.lstrip("\ufeff ").startswith("#")


def _split(line: str, separator: str | None) -> list[str]:
    """Return the cells of a header line; units in brackets may hold blanks."""
    if separator is None:
        return re.findall(r"\S+(?:\s*[(\[][^)\]]*[)\]])?", line)
    # a name in quotes may hold the separator
    cells = next(csv.reader([line.strip()], delimiter=separator)) if '"' in line else line.strip().split(separator)
    return [cell.strip().strip('"').strip() for cell in cells]


def _all_numbers(line: str, separator: str | None) -> bool:
    """Return whether every filled cell of a line is a finite or infinite number."""
    cells = [cell for cell in _split(line, separator) if cell]
    try:
        return bool(cells) and all(float(cell.replace(",", ".")) is not None for cell in cells)
    except ValueError:
        return False
