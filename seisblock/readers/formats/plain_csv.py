"""Plain tables: columns by name, with units in the names, any common separator."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from seisblock.errors import ParameterError, RecordFormatError, UnitError
from seisblock.readers.cells import columns_of, to_si
from seisblock.readers.clock import even_dt
from seisblock.readers.naming import TIME, code_of, normal_unit, split_unit, time_unit
from seisblock.readers.source import Blob, decode
from seisblock.records import Component, Record

FORMAT = "CSV"
_STANDARD = ("NS", "EW", "UD")
_WIDTH_TOLERANT = {",", ";", "\t"}


@dataclass(frozen=True)
class Layout:
    """Where the numbers of a table begin and what its columns are called."""

    names: tuple[str, ...]
    body: int
    separator: str | None
    decimal_comma: bool = False


def looks_like_csv(text: str) -> bool:
    """Return whether a text is a table of numbers, or at least has a header that names components or units."""
    lines = text.split("\n")
    body = next((i for i, line in enumerate(lines) if _is_data(line)), None)
    if body is None:
        return False
    separator = separator_of(lines[body])
    if _all_numbers(lines[body], separator):
        return True
    names = _split(lines[body], separator)
    if any(code_of(name) in (*_STANDARD, TIME) or normal_unit(split_unit(name)[1]) for name in names):
        return True
    following = next((line for line in lines[body + 1 :] if _is_data(line)), "")
    return _all_numbers(following, separator_of(following)) and len(_split(following, separator_of(following))) == len(names)


def read_plain_csv(blob: Blob, *, units: str | None = None, dt: float | None = None) -> Record:
    """Return the record in a plain table.

    Parameters
    ----------
    blob : Blob
        Cells are separated by commas, semicolons (then a decimal comma is allowed), tabs or blanks; ``#`` starts a comment. The first line
        may name the columns, a unit may stand in a name: ``EW (gal)``, ``ew_gal``, ``NS[m/s^2]``. A time column gives the sampling
        interval and must be even to 1e-6 s. Without names, a first column that climbs evenly is the time.
    units : str or None
        Unit of columns that name none.
    dt : float or None, s
        Sampling interval of a table without a time column.

    Raises
    ------
    RecordFormatError
        If a cell is no number, with its line.
    UnitError
        If a unit is unknown, or missing and not given.
    ParameterError
        If the sampling interval is missing, or contradicts the time column.
    """
    lines = decode(blob).split("\n")
    layout = layout_of(blob.name, lines)
    body = [line if _is_data(line) else "" for line in lines[layout.body :]]
    if layout.decimal_comma:
        body = [line.replace(",", ".") for line in body]
    if any('"' in line for line in body[:3]):
        body = [line.replace('"', "") for line in body]
    wanted = _wanted(blob.name, layout.names)
    labels = {layout.names[index] if layout.names.count(layout.names[index]) == 1 else f"number {index + 1}": index for index in wanted}
    rows = columns_of(blob.name, body, layout.body + 1, labels, len(layout.names), layout.separator)
    named = dict(zip(wanted, rows, strict=True))
    clock, history = _take_clock(layout.names, named)
    metadata: dict[str, object] = {}
    if clock is not None:
        seconds = named.pop(clock) * (time_unit(split_unit(layout.names[clock])[1]) or 1.0)
        from_time = even_dt(blob.name, seconds)
        if dt is not None and abs(dt - from_time) > 1e-6:
            raise ParameterError(f"{blob.name}: its time column says dt = {from_time:g} s, the option says {dt:g} s: leave the option out")
        dt = from_time
        if seconds[0]:
            metadata["first_time_s"] = float(seconds[0])
    if dt is None:
        raise ParameterError(f"{blob.name} has no time column: give the sampling interval, for example --dt 0.01")
    if not named:
        raise RecordFormatError(f"{blob.name} holds a time column and nothing else: expected at least one column of acceleration")
    components = [
        Component(code, to_si(named[index], unit))
        for code, index, unit in zip(_codes(layout.names, named), named, _units(blob.name, layout.names, named, units), strict=True)
    ]
    return Record(tuple(components), dt, source=blob.name, format=FORMAT, history=history, metadata=metadata)


def layout_of(name: str, lines: Sequence[str]) -> Layout:
    """Return where the numbers begin, the names of the columns and the separator."""
    first = next((i for i, line in enumerate(lines) if _is_data(line)), None)
    if first is None:
        raise RecordFormatError(f"{name} holds comments only: expected columns of numbers")
    separator = separator_of(lines[first])
    if not _all_numbers(lines[first], separator):
        names = tuple(_split(lines[first], separator))
        return _closed(lines, Layout(names, first + 1, separator))
    width = len(_split(lines[first], separator))
    comment = next((line for line in reversed(lines[:first]) if line.strip()), "").lstrip("\ufeff# ")
    names = tuple(_split(comment, separator if separator in _WIDTH_TOLERANT else separator_of(comment)))
    if comment and len(names) == width and any(code_of(n) in (*_STANDARD, TIME) or split_unit(n)[1] for n in names):
        return _closed(lines, Layout(names, first, separator))
    return _closed(lines, Layout(("",) * width, first, separator))


def _closed(lines: Sequence[str], layout: Layout) -> Layout:
    """Return the layout after a look at the first line of numbers: trailing empty names off, another separator, decimal commas."""
    names = list(layout.names)
    while len(names) > 1 and not names[-1].strip() and any(names):
        names.pop()
    sample = next((line for line in lines[layout.body :] if _is_data(line)), "")
    separator = layout.separator
    if sample and separator is not None and separator not in sample and len(names) > 1:
        separator = separator_of(sample)
    return Layout(tuple(names), layout.body, separator, decimal_comma=separator not in (",", None) and "," in sample and "." not in sample)


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
    return [cell.strip().strip('"').strip() for cell in line.strip().split(separator)]


def _all_numbers(line: str, separator: str | None) -> bool:
    """Return whether every filled cell of a line is a finite or infinite number."""
    cells = [cell for cell in _split(line, separator) if cell]
    try:
        return bool(cells) and all(float(cell.replace(",", ".")) is not None for cell in cells)
    except ValueError:
        return False


def _wanted(name: str, names: Sequence[str]) -> list[int]:
    """Return the columns to read: the time, and the standard components or those with a unit, else all."""
    codes = [code_of(n) for n in names]
    for code in {*_STANDARD, TIME}:
        if codes.count(code) > 1:
            found = ", ".join(repr(n) for n, c in zip(names, codes, strict=True) if c == code)
            raise RecordFormatError(f"{name}: several columns mean {code.lower() if code == TIME else code} ({found}): keep one of them")
    time = [i for i, code in enumerate(codes) if code == TIME]
    standard = [i for i, code in enumerate(codes) if code in _STANDARD]
    with_unit = [i for i, n in enumerate(names) if i not in time and split_unit(n)[1]]
    rest = [i for i in range(len(names)) if i not in time]
    return time + sorted(standard or with_unit or rest)


def _take_clock(names: Sequence[str], columns: dict[int, np.ndarray]) -> tuple[int | None, tuple[str, ...]]:
    """Return which column is the time, and what to say about it."""
    for index in columns:
        if code_of(names[index]) == TIME:
            return index, ()
    first = next(iter(columns))
    if any(names) or len(columns) < 2 or columns[first].size < 3:
        return None, ()
    steps = np.diff(columns[first])
    if steps[0] > 0 and np.allclose(steps, steps.mean(), rtol=0.05, atol=0.0):
        return first, ("took the first column, which climbs evenly, as the time in s",)
    return None, ()


def _codes(names: Sequence[str], columns: dict[int, np.ndarray]) -> list[str]:
    """Return the component codes; columns without names are called ACC, or C1, C2..."""
    codes = [code_of(names[index]) for index in columns]
    if all(codes):
        return codes
    return ["ACC"] if len(codes) == 1 else [code or f"C{i + 1}" for i, code in enumerate(codes)]


def _units(name: str, names: Sequence[str], columns: dict[int, np.ndarray], given: str | None) -> list[str]:
    """Return the unit of each column."""
    option = None if given is None else normal_unit(given)
    if given is not None and option is None:
        raise UnitError(f"unknown unit of acceleration {given!r}: give gal, m/s2 or g")
    units = []
    for index in columns:
        written = split_unit(names[index])[1]
        unit = normal_unit(written) if written else option
        if written and unit is None:
            raise UnitError(f"{name}: column {names[index]!r} has the unknown unit {written!r}: expected gal, m/s2 or g")
        if unit is None:
            label = repr(names[index]) if names[index] else f"{index + 1}"
            raise UnitError(f"{name}: column {label} has no unit: name it in the header, as in 'EW (gal)', or give --units gal|m/s2|g")
        if option is not None and unit != option:
            raise UnitError(f"{name}: column {names[index]!r} is in {unit}, the option says {given}: leave the option out")
        units.append(unit)
    return units
