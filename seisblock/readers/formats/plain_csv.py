"""Plain tables: columns by name, with units in the names, any common separator."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from datetime import datetime, timedelta
from functools import partial

import numpy as np

from seisblock.errors import InputError, ParameterError, RecordFormatError, UnitError
from seisblock.readers.cells import columns_of, turned_si
from seisblock.readers.clock import even_dt
from seisblock.readers.columns import Column, Columns, columns_of_header
from seisblock.readers.decimals import doubts_of_decimals, doubts_of_end
from seisblock.readers.formats.table_comments import doubts_of_comments
from seisblock.readers.formats.table_layout import FORTRAN, is_data, layout_of, preamble
from seisblock.readers.formats.table_names import CLIMBING, LOOKED_AT, name_of_first
from seisblock.readers.header import JST
from seisblock.readers.lines import lines_of, mapped
from seisblock.readers.moments import Moment, moment_in, seconds_instead
from seisblock.readers.naming import TIME, split_unit, zone_of
from seisblock.readers.source import Blob
from seisblock.records import Component, Doubt, Record
from seisblock.typing import FloatArray
from seisblock.words import noted, said

FORMAT = "CSV"
_QUOTED = re.compile(r'(?<![^\s,;])"([^"]*)"(?![^\s,;])')
_CLIMBS = noted("took the first column, which climbs evenly, as the time in s")


def read_plain_csv(blob: Blob, *, units: str | None = None, dt: float | None = None) -> Record:
    """Return the record in a plain table.

    Parameters
    ----------
    blob : Blob
        Cells are separated by commas, semicolons (then a decimal comma is allowed), tabs or blanks; ``#`` starts a comment. The first line
        may name the columns (:func:`seisblock.readers.columns.columns_of_header`), a unit may stand in a name: ``EW (gal)``, ``ew_gal``,
        ``NS[m/s^2]``, or in a line of units below the names. A time column gives the sampling interval and must be even within the digits
        printed; where a clock tells the times (``16:10:10.25``, ``2024-01-01T16:10:10Z``) the first with its date is the start. Without
        names, a first column that climbs evenly is the time.
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
    body = mapped(lines[layout.body :], lambda line: line if is_data(line) else "")
    if layout.decimal_comma:
        body = mapped(body, lambda line: line.replace(",", "."))
    if any('"' in line for line in body[:3]):
        body = mapped(body, partial(_QUOTED.sub, r"\1"))
    if any(FORTRAN.search(line) for line in body[:LOOKED_AT]):
        body = mapped(body, partial(FORTRAN.sub, "E"))
    named = any(layout.names)
    nameless = named and not layout.names[0].strip()
    if nameless:
        layout = replace(layout, names=(name_of_first(body[:LOOKED_AT], layout.separator), *layout.names[1:]))
    told = _told(blob.name, lines, layout.names, units) if named else _unnamed(len(layout.names))
    told = replace(told, remarks=(*told.remarks, said(_CLIMBS))) if nameless and layout.names[0] == CLIMBING else told
    if named and dt is None and not any(column.code == TIME for column in told.read):
        raise _without_interval(blob.name)  # before a day of numbers is read
    clock, body = _clock(told, body, layout.separator)
    labels = {c.label if layout.names.count(c.label) == 1 else f"number {c.index + 1}": c.index for c in told.read}
    rows = columns_of(blob.name, body, layout.body + 1, labels, len(layout.names), layout.separator)
    if not named:
        told = _guessed(blob.name, rows, units)
    pairs = list(zip(told.read, rows, strict=True))
    metadata: dict[str, object] = {}
    for column, row in pairs:
        if column.code == TIME:
            dt = _interval(blob.name, column, row, body, layout.separator, dt)
            if row[0] and clock is None:
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
    start, remarks = _start(clock, _zone(told))
    clocked = any(column.code == TIME for column in told.read)
    doubts = _doubts(lines, layout.body, clocked=clocked) + doubts_of_decimals(body, layout.body + 1, layout.separator)
    doubts += doubts_of_comments(lines[: layout.body], told.read, rows[0].size, dt)
    if not any(doubt.kind == "cut" for doubt in doubts):
        doubts += doubts_of_end(body, layout.separator)
    return Record(
        tuple(components),
        dt,
        start=start,
        source=blob.name,
        format=FORMAT,
        history=(*told.remarks, *remarks),
        metadata=metadata | ({"clock": "JST"} if start and clock and JST.total_seconds() in (clock.zone_s, _zone(told)) else {}),
        doubts=doubts,
    )


def _clock(told: Columns, body: Sequence[str], separator: str | None) -> tuple[Moment | None, Sequence[str]]:
    """Return the first moment of a column of times that a clock tells, None where it holds seconds, and the body with seconds in it."""
    column = next((c for c in told.read if c.code == TIME), None)
    cells = next((line for line in body if line.strip()), "").split(separator)
    first = moment_in(cells[column.index]) if column is not None and column.index < len(cells) else None
    if column is None or first is None:
        return None, body
    return first, mapped(body, seconds_instead(column.index, separator, first))


def _zone(told: Columns) -> int | None:
    """Return how far the clock that the name of the column of times tells is ahead of UTC, s: ``time (JST)``."""
    return next((zone_of(split_unit(column.label)[1]) for column in told.read if column.code == TIME), None)


def _start(clock: Moment | None, zone_s: int | None) -> tuple[datetime | None, tuple[str, ...]]:
    """Return the start that a clock tells, UTC, and what is to be said of it."""
    if clock is None or clock.utc is None:
        return None, ()
    if clock.zone_s is None and zone_s is not None:
        return clock.utc - timedelta(seconds=zone_s), ()
    return clock.utc, () if clock.zone_s is not None else (said("took the times of the file as UTC: no time zone stands beside them"),)


def _told(name: str, lines: Sequence[str], names: Sequence[str], units: str | None) -> Columns:
    """Return what the columns are by their names; where these are not understood and a table begins further down, that is said."""
    try:
        return columns_of_header(name, names, units)
    except InputError:
        below = preamble(name, lines)
        if below is None:
            raise
        raise below from None


def _without_interval(name: str) -> ParameterError:
    """Return the error of a table that does not say how far apart its samples are."""
    return ParameterError("{name} has no time column: give the sampling interval, `dt`, for example 0.01 s", name=name)


def _doubts(lines: Sequence[str], body: int, *, clocked: bool) -> tuple[Doubt, ...]:
    """Return what speaks for lines that were lost: one that is empty where nothing else counts them, and a last one cut short."""
    found = []
    last = max(i for i, line in enumerate(lines) if is_data(line))
    empty = [] if clocked else [body + i + 1 for i, line in enumerate(lines[body:last]) if not line.strip()]
    if empty:
        text = said(
            "{count} line(s) are empty (the first is line {line}) where each stands for a sample: if samples are missing there, all later "
            "ones come too early",
            count=len(empty),
            line=empty[0],
        )
        found.append(Doubt("line", text))
    if last == len(lines) - 1 and last > body + 2 and len(lines[last]) < min(len(line) for line in lines[body:last] if is_data(line)):
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
    return Columns(told.read, (said(_CLIMBS),) if clock else ())


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
