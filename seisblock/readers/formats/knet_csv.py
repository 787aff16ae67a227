"""NIED K-NET CSV: header in comment lines, gal, offset not removed."""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import datetime, timedelta
from itertools import pairwise

import numpy as np

from seisblock.core.errors import RecordFormatError, UnitError
from seisblock.core.typing import FloatArray
from seisblock.readers._header import MAX_COUNT, drop_missing, parse_jst, parse_number
from seisblock.readers._header_check import flag_count, qc_flag
from seisblock.readers.lines import line_error
from seisblock.readers.registry import Format, register
from seisblock.readers.source import RawFile, decode_text
from seisblock.readers.table.checks import flag_missing_points, flag_truncated_end
from seisblock.readers.table.headers import TIME, component_code, normalize_unit, split_unit
from seisblock.readers.table.parse import parse_columns, to_si
from seisblock.readers.table.sampling import sampling_interval
from seisblock.records import Component, QCFlag, Record

_TIME_OF_DAY = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(?:\.\d{1,6})?")
_CHANNELS = {"1": ("NS", "borehole"), "2": ("EW", "borehole"), "3": ("UD", "borehole")}
_CHANNELS |= {"4": ("NS", "surface"), "5": ("EW", "surface"), "6": ("UD", "surface")}


def is_knet_csv(head: bytes) -> bool:
    """Return whether bytes begin a K-NET or KiK-net CSV of NIED."""
    return re.match(rb"(?:\xef\xbb\xbf)?#\s*(?:K-NET|KiK-net)\s*CSV", head, re.IGNORECASE) is not None


def read_knet_csv(blob: RawFile) -> list[Record]:
    """Return the record in a NIED CSV; for KiK-net (``1(gal)`` to ``6(gal)``) two, borehole and surface.

    Notes
    -----
    The time column is the true time of the samples, JST, without the trigger delay. The offset is kept and recorded in the metadata.
    """
    lines = decode_text(blob).split("\n")
    body = next((i for i, line in enumerate(lines) if line.strip() and not line.startswith("#")), len(lines))
    header = [line.lstrip("#").strip() for line in lines[:body]]
    names_line = next((i for i in range(body - 1, -1, -1) if ",RelativeTime" in header[i]), None)
    if names_line is None:
        message = "{name}: K-NET CSV header incomplete: no line with the column names (#Time,RelativeTime(s),...)"
        raise RecordFormatError(message, name=blob.name)
    names = [cell.strip() for cell in header[names_line].split(",")]
    sensors = _sensor_columns(blob.name, names)
    time_index = next(i for i, name in enumerate(names) if name.startswith("RelativeTime"))
    labels = {names[time_index]: time_index, **{names[i]: i for codes in sensors.values() for i in codes.values()}}
    columns = dict(zip(labels.values(), parse_columns(blob.name, lines[body:], body + 1, labels, len(names)), strict=True))
    dt = sampling_interval(blob.name, columns[time_index])
    rate = parse_number(_line_after(header, "SamplingFrequency(Hz)"))
    if rate and abs(1.0 / rate - dt) > 1e-6:
        message = "{name}: header rate {rate:g} Hz contradicts the time column (interval {dt:g} s): file damaged"
        raise RecordFormatError(message, name=blob.name, rate=rate, dt=dt)
    start = _start_time(blob.name, lines[body], body + 1, float(columns[time_index][0]))
    flags = _qc_flags(header, columns[time_index].size, rate or 1.0 / dt) + _flag_clock(lines[body:], columns[time_index], dt)
    flags += flag_missing_points(lines[body:], body + 1, ",") + flag_truncated_end(lines[body:], ",")
    dt, station, records = 1.0 / rate if rate else dt, _line_after(header, "Code,").split(",")[0], []
    for level, codes in sensors.items():
        components = tuple(Component(code, to_si(columns[i], "gal")) for code, i in codes.items())
        metadata = _metadata(header, level) | {"offset_gal": {code: float(columns[i].mean()) for code, i in codes.items()}}
        part = Record(components, dt, station, start, source=blob.name, format=FORMAT.name, metadata=metadata, doubts=flags)
        records.append(part)
    return records


def _qc_flags(header: Sequence[str], samples: int, rate: float) -> tuple[QCFlag, ...]:
    """Return a flag if the header duration differs from the samples or is unreadable."""
    text = _line_after(header, "DurationTime(s)")
    duration = parse_number(text)
    if duration is None or not 0 < duration * rate < MAX_COUNT:
        return (qc_flag("header DurationTime {text!r} is not a number; number of samples not checked", "header", text=text[:20]),)
    return flag_count(round(duration * rate), samples)


def _flag_clock(lines: Sequence[str], relative_times: FloatArray, dt: float) -> tuple[QCFlag, ...]:
    """Return a flag if the time of day disagrees with the relative time."""
    time_texts = [line.partition(",")[0].strip().replace("/", "-").replace(" ", "T") for line in lines if line.strip(" \t,")]
    try:
        if not all(map(_TIME_OF_DAY.fullmatch, time_texts)):
            raise ValueError
        elapsed_s = (np.array(time_texts, dtype="datetime64[us]") - np.datetime64(time_texts[0], "us")) / np.timedelta64(1, "s")
    except ValueError:
        return (qc_flag("unreadable time of day in the first column", "clock"),)
    # half an interval: larger differences are a shifted or missing line
    mismatches = np.flatnonzero(np.abs(elapsed_s - (relative_times - relative_times[0])) > 0.5 * dt)
    if not mismatches.size:
        return ()
    message = "time of day and relative time disagree in {count} line(s), first at {seconds:.2f} s"
    return (qc_flag(message, "clock", count=mismatches.size, seconds=float(relative_times[mismatches[0]])),)


def _sensor_columns(name: str, names: Sequence[str]) -> dict[str, dict[str, int]]:
    """Return column index by component for each sensor level (empty for K-NET)."""
    sensors: dict[str, dict[str, int]] = {}
    for index, column in enumerate(names):
        code, level = _CHANNELS.get(column.split("(")[0], (component_code(column), ""))
        if code == TIME:
            continue
        unit = split_unit(column)[1]
        if unit and normalize_unit(unit) != "gal":
            message = "{name}: unit {unit} in column {column!r}: expected gal in a K-NET CSV; file damaged"
            raise UnitError(message, name=name, column=column, unit=unit)
        if code not in ("NS", "EW", "UD") or code in sensors.get(level, {}):
            message = "{name}: column {column!r} unknown or duplicate: expected N-S, E-W, U-D (or 1 to 6) once each; file damaged"
            raise RecordFormatError(message, name=name, column=column)
        sensors.setdefault(level, {})[code] = index
    if not sensors:
        raise RecordFormatError("{name}: no acceleration column among {names}", name=name, names=names)
    return sensors


def _line_after(header: Sequence[str], key: str) -> str:
    """Return the header line after the line that begins with a key."""
    for line, next_line in pairwise(header):
        if line.startswith(key):
            return next_line
    return ""


def _start_time(name: str, line: str, line_number: int, relative_time: float) -> datetime:
    text = line.split(",")[0]
    time = parse_jst(text)
    if time is None:
        raise line_error("expected a time such as 2019/01/02 17:47:27.00, found {text!r}", name, line_number, text=text)
    # the first row need not be at relative time zero
    return time - timedelta(seconds=relative_time)


def _metadata(header: Sequence[str], level: str) -> dict[str, object]:
    event, station = _line_after(header, "OriginTime").split(","), _line_after(header, "Code,").split(",")
    numbers = dict(zip(("event_latitude_deg", "event_longitude_deg", "event_depth_km", "magnitude"), event[1:], strict=False))
    numbers |= dict(zip(("station_latitude_deg", "station_longitude_deg"), station[1:], strict=False))
    constants = {"unit": "gal", "clock": "JST", "carries_offset": True, "level": level, "origin_time": parse_jst(event[0])}
    return drop_missing(constants | {label: parse_number(text) for label, text in numbers.items()})


FORMAT = register(
    Format(
        name="KNET-CSV",
        title="K-NET CSV",
        parse=read_knet_csv,
        matches=is_knet_csv,
        proves=("count", "clock", "unit", "sign", "instrument"),
        aliases=("KNETCSV",),
    )
)
