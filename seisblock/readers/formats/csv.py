"""Plain tables: named columns with units and any common separator."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from datetime import timedelta
from functools import partial

import numpy as np

from seisblock.core.errors import InputError, ParameterError, RecordFormatError, UnitError
from seisblock.core.i18n import N_, Message, lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.readers._header import JST
from seisblock.readers._header_check import qc_flag
from seisblock.readers.lines import map_lines, read_lines
from seisblock.readers.registry import Format, register
from seisblock.readers.source import RawFile
from seisblock.readers.table.checks import flag_comment_mismatch, flag_missing_points, flag_truncated_end
from seisblock.readers.table.columns import Column, TableColumns, parse_header
from seisblock.readers.table.headers import TIME, split_unit, zone_offset_s
from seisblock.readers.table.layout import (
    FORTRAN_EXPONENT,
    INSPECTED_LINES,
    TIME_HEADING,
    TableLayout,
    find_layout,
    guess_first_name,
    is_data_line,
    looks_like_csv,
    preamble_error,
    without_comments,
)
from seisblock.readers.table.parse import parse_columns, to_si_in_place
from seisblock.readers.table.sampling import Timestamp, parse_timestamp, sampling_interval, seconds_replacer
from seisblock.records import Component, QCFlag, Record

_QUOTED = re.compile(r'(?<![^\s,;|])"([^"]*)"(?![^\s,;|])')
_SPLIT_DECIMALS = re.compile(r"(?:^|,)\s*(?:-0|[-+]?0\d+)\s*(?=,|$)")
"""Cell that is no whole number, but half of a number with a decimal comma."""

MIN_SERIES_LINES = 20
"""Fewest lines in which one series with several samples per line is recognised."""

SERIES_STEP_RATIO = 0.75
"""Largest mean step in the order of reading, in mean steps down a column, of one series with several samples per line."""

_TIME_GUESSED_NOTE = N_("first column (evenly increasing) used as the time in s")


def read_plain_csv(blob: RawFile, *, units: str | None = None, dt: float | None = None) -> Record:
    """Return the record in a plain table.

    Cells are separated by commas, semicolons (decimal comma allowed), tabs, vertical bars or blanks; ``#`` begins a comment. The first line
    may name the columns (:func:`seisblock.readers.table.columns.parse_header`) with units: ``EW (gal)``, ``ew_gal``, ``NS[m/s^2]``, or
    units in a line below the names. A time column gives the sampling interval and must be even within the printed digits; the first clock
    time with a date (``2024-01-01T16:10:10Z``) is the start. Without names, an evenly increasing first column is the time, and columns that
    continue each other line by line are one series. `units` is the unit of columns without one, `dt` the sampling interval, s, of a table
    without a time column.

    Raises
    ------
    RecordFormatError
        If a column is unknown or a cell is not a number; the message has its name or line.
    UnitError, ParameterError
        If a unit or the sampling interval is missing, or contradicts the file.
    """
    lines = read_lines(blob)
    layout = find_layout(blob.name, lines)
    body = without_comments(lines[layout.body :])
    if layout.decimal_comma:
        body = map_lines(body, lambda line: line.replace(",", "."))
    if any('"' in line for line in body[:3]):
        body = map_lines(body, partial(_QUOTED.sub, r"\1"))
    if any(FORTRAN_EXPONENT.search(line) for line in body[:INSPECTED_LINES]):
        body = map_lines(body, partial(FORTRAN_EXPONENT.sub, "E"))
    has_names = any(layout.names)
    first_unnamed = has_names and not layout.names[0].strip()
    if first_unnamed:
        layout = replace(layout, names=(guess_first_name(body[:INSPECTED_LINES], layout.separator), *layout.names[1:]))
    columns = _parse_columns(blob.name, lines, layout.names, units) if has_names else _unnamed_columns(len(layout.names))
    columns = (
        replace(columns, notes=(*columns.notes, lazy_gettext(_TIME_GUESSED_NOTE)))
        if first_unnamed and layout.names[0] == TIME_HEADING
        else columns
    )
    if has_names and dt is None and not any(column.code == TIME for column in columns.columns):
        raise _missing_interval_error(blob.name)  # before reading the numbers, which may take long
    first_timestamp, body = _replace_timestamps(columns, body, layout.separator)
    labels = {c.label if layout.names.count(c.label) == 1 else f"number {c.index + 1}": c.index for c in columns.columns}
    series_notes: tuple[Message, ...] = ()
    if has_names:
        rows = parse_columns(blob.name, body, layout.body + 1, labels, len(layout.names), layout.separator)
    else:
        rows, series_notes = _read_unnamed(blob.name, body, layout, labels)
        columns = _guess_columns(blob.name, rows, units)
        columns = replace(columns, notes=(*series_notes, *columns.notes))
    pairs = list(zip(columns.columns, rows, strict=True))
    metadata: dict[str, object] = {}
    for column, row in pairs:
        if column.code == TIME:
            dt = _column_interval(blob.name, column, row, body, layout.separator, dt)
            if row[0] and first_timestamp is None:
                metadata["first_time_s"] = float(row[0]) * column.seconds
    if dt is None:
        raise _missing_interval_error(blob.name)
    components = [Component(c.code, to_si_in_place(row, c.unit, c.sign), c.azimuth_deg) for c, row in pairs if c.code != TIME]
    if not components:
        raise RecordFormatError(
            "{name}: no acceleration column: expected at least one, found {columns}",
            name=blob.name,
            columns=[name.strip() for name in layout.names] if has_names else [lazy_gettext("time")],
        )
    zone_s, zone_note = _time_zone(columns, first_timestamp)
    start = None if first_timestamp is None or first_timestamp.utc is None else first_timestamp.utc - timedelta(seconds=zone_s)
    has_time = any(column.code == TIME for column in columns.columns)
    flags = _qc_flags(lines, layout.body, has_time=has_time, short_end=bool(series_notes)) + flag_missing_points(
        body, layout.body + 1, layout.separator
    )
    flags += flag_comment_mismatch(lines[: layout.body], columns.columns, rows[0].size, dt)
    # one flag for a truncated end is enough
    if not series_notes and not any(flag.kind == "cut" for flag in flags):
        flags += flag_truncated_end(body, layout.separator)
    return Record(
        tuple(components),
        dt,
        start=start,
        source=blob.name,
        format=FORMAT.name,
        history=(*columns.notes, *([zone_note] if start and zone_note else [])),
        metadata=metadata
        | ({"clock": "JST"} if start and first_timestamp and JST.total_seconds() in (first_timestamp.utc_offset_s, zone_s) else {}),
        doubts=flags,
    )


def _replace_timestamps(columns: TableColumns, body: Sequence[str], separator: str | None) -> tuple[Timestamp | None, Sequence[str]]:
    """Return the first clock time of the time column, None for seconds, and the body with seconds in its place."""
    column = next((c for c in columns.columns if c.code == TIME), None)
    cells = next((line for line in body if line.strip()), "").split(separator)
    first = parse_timestamp(cells[column.index]) if column is not None and column.index < len(cells) else None
    if column is None or first is None:
        return None, body
    return first, map_lines(body, seconds_replacer(column.index, separator, first))


def _time_zone(columns: TableColumns, first: Timestamp | None) -> tuple[int, Message | None]:
    """Return the UTC offset of the clock times, s, beyond the one in their cells, and a history note where it is assumed.

    It is that in the name of the time column, ``time (JST)``; without one, times below a Japanese name are in JST, others in UTC.
    """
    label = next((column.label for column in columns.columns if column.code == TIME), "")
    stated_s = zone_offset_s(split_unit(label)[1])
    if first is None or first.utc_offset_s is not None:
        return 0, None
    if stated_s is not None:
        return stated_s, None
    if label.isascii():
        return 0, lazy_gettext("times taken as UTC (no time zone in the file)")
    return int(JST.total_seconds()), lazy_gettext("times taken as JST (Japanese heading without a time zone)")


def _parse_columns(name: str, lines: Sequence[str], names: Sequence[str], units: str | None) -> TableColumns:
    """Return the columns by their names; an unknown header above a table further down raises its own error."""
    try:
        return parse_header(name, names, units)
    except InputError:
        error = preamble_error(name, lines)
        if error is None:
            raise
        raise error from None


def _missing_interval_error(name: str) -> ParameterError:
    return ParameterError("{name}: no time column: give the sampling interval with `dt`, for example 0.01 s", name=name)


def _qc_flags(lines: Sequence[str], body: int, *, has_time: bool, short_end: bool = False) -> tuple[QCFlag, ...]:
    """Return flags for empty lines in a table without times and for a truncated last line; with `short_end` that may be a short one."""
    flags = []
    last = next(i for i in reversed(range(len(lines))) if is_data_line(lines[i]))
    empty_lines = [] if has_time else [body + i + 1 for i, line in enumerate(lines[body:last]) if not line.strip()]
    if empty_lines:
        message = (
            "{count} empty line(s) among the samples (first: line {line}); if samples are missing there, all later samples are too early"
        )
        flags.append(qc_flag(message, "line", count=len(empty_lines), line=empty_lines[0]))
    is_last_open = last == len(lines) - 1 and last > body + 2 and not short_end
    if is_last_open and len(lines[last]) < min(len(line) for line in lines[body:last] if is_data_line(line)):
        flags.append(qc_flag("last line shortest and without line end: file probably truncated, last number incomplete", "cut"))
    return tuple(flags)


def _unnamed_columns(width: int) -> TableColumns:
    return TableColumns(tuple(Column(i, f"number {i + 1}", "") for i in range(width)))


def _guess_columns(name: str, rows: Sequence[FloatArray], units: str | None) -> TableColumns:
    """Return the columns of a table without names: an evenly increasing first column is time, others acceleration."""
    first_column = rows[0]
    steps = np.diff(first_column)
    # only a guess of the meaning: the interval itself is checked with its own tolerance
    has_time = len(rows) > 1 and first_column.size >= 3 and steps[0] > 0 and np.allclose(steps, steps.mean(), rtol=0.05, atol=0.0)
    names = ["time" if has_time and i == 0 else f"C{i + 1}" for i in range(len(rows))]
    # a single column is named ACC, several C1, C2, ...
    if len(rows) - has_time == 1:
        names[-1] = "ACC"
    if units is None:
        message = "{name}: column {column} has no unit: add a header such as 'EW (gal)' or give `units`, gal|m/s2|g"
        raise UnitError(message, name=name, column=1 + has_time)
    columns = parse_header(name, names, units)
    return TableColumns(columns.columns, (lazy_gettext(_TIME_GUESSED_NOTE),) if has_time else ())


def _read_unnamed(
    name: str, body: Sequence[str], layout: TableLayout, labels: Mapping[str, int]
) -> tuple[list[FloatArray], tuple[Message, ...]]:
    """Return the columns of a table without names, and history notes; one series with several samples per line becomes one column."""
    width, first_line = len(layout.names), layout.body + 1
    if layout.separator == "," and any(map(_SPLIT_DECIMALS.search, body[:INSPECTED_LINES])) and not any("." in line for line in body):
        raise RecordFormatError("{name}: decimal commas in a table separated by commas; write decimal points", name=name)
    last = next(i for i in reversed(range(len(body))) if body[i].strip())
    rest = body[last].rstrip(" \t" + (layout.separator or "")).split(layout.separator)
    full_lines = body[:last] if last > 0 and len(rest) < width else body
    rows = parse_columns(name, full_lines, first_line, labels, width, layout.separator)
    if _is_one_series(rows):
        indices = {str(i): i for i in range(len(rest))}
        end = [] if full_lines is body else parse_columns(name, body[last:], first_line + last, indices, len(rest), layout.separator)
        note = lazy_gettext("one series with {count} samples per line, read line by line", count=width)
        return [np.concatenate([np.stack(rows, axis=1).ravel(), *end])], (note,)
    return (rows if full_lines is body else parse_columns(name, body, first_line, labels, width, layout.separator)), ()


def _is_one_series(rows: Sequence[FloatArray]) -> bool:
    """Return whether columns are one series written line by line: steps along and across lines are alike, smaller than down the columns."""
    if len(rows) < 2 or rows[0].size < MIN_SERIES_LINES:
        return False
    table = np.stack(rows, axis=1)
    across = np.abs(table[1:, 0] - table[:-1, -1]).mean()
    steps = [across, *np.abs(np.diff(table, axis=1)).mean(axis=0)]
    down = np.abs(np.diff(table, axis=0)).mean()
    return bool(0.0 < max(steps) <= SERIES_STEP_RATIO * down and max(steps) <= 2.0 * min(steps))


def _column_interval(name: str, column: Column, row: FloatArray, body: Sequence[str], separator: str | None, dt: float | None) -> float:
    """Return the sampling interval of the time column, s; raise if `dt` contradicts it."""

    def printed_times() -> list[str]:
        return [line.split(separator)[column.index].strip() for line in body if line.strip()][: row.size]

    interval = sampling_interval(name, row, printed_times, unit=column.seconds)
    if dt is not None and abs(dt - interval) > 1e-6:
        message = "{name}: interval of the time column {found:g} s contradicts `dt` {dt:g} s; omit `dt`"
        raise ParameterError(message, name=name, found=interval, dt=dt)
    return interval


FORMAT = register(
    Format(
        name="CSV",
        title=N_("a plain table"),
        parse=read_plain_csv,
        matches_text=looks_like_csv,
        proves=("unit",),
        specificity=0,
        options=("units", "dt"),
        plugin=False,
    )
)
