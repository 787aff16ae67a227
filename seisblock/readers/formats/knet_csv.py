"""NIED's K-NET CSV: comment lines that hold a header, gal, offset not removed."""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import datetime, timedelta
from itertools import pairwise

import numpy as np

from seisblock.errors import RecordFormatError, UnitError
from seisblock.readers.cells import columns_of, fail, to_si
from seisblock.readers.clock import even_dt
from seisblock.readers.decimals import doubts_of_decimals, doubts_of_end
from seisblock.readers.header import LARGEST_COUNT, number, time_in_japan
from seisblock.readers.naming import TIME, code_of, normal_unit, split_unit
from seisblock.readers.source import Blob, decode
from seisblock.records import Component, Doubt, Record
from seisblock.typing import FloatArray
from seisblock.words import said

FORMAT = "KNET-CSV"
_TIME_OF_DAY = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(?:\.\d{1,6})?")
_CHANNELS = {"1": ("NS", "borehole"), "2": ("EW", "borehole"), "3": ("UD", "borehole")}
_CHANNELS |= {"4": ("NS", "surface"), "5": ("EW", "surface"), "6": ("UD", "surface")}


def is_knet_csv(head: bytes) -> bool:
    """Return whether a file's first bytes are those of NIED's CSV of K-NET or KiK-net."""
    return re.match(rb"(?:\xef\xbb\xbf)?#\s*(?:K-NET|KiK-net)\s*CSV", head, re.IGNORECASE) is not None


def read_knet_csv(blob: Blob) -> list[Record]:
    """Return the record in a CSV of NIED; of KiK-net's ``1(gal)`` to ``6(gal)`` two, borehole and surface.

    Notes
    -----
    The time column is taken as the true time of the samples, JST: the trigger delay is already off. The offset is kept and told.
    """
    lines = decode(blob).split("\n")
    body = next((i for i, line in enumerate(lines) if line.strip() and not line.startswith("#")), len(lines))
    header = [line.lstrip("#").strip() for line in lines[:body]]
    names_at = next((i for i in range(body - 1, -1, -1) if ",RelativeTime" in header[i]), None)
    if names_at is None:
        raise RecordFormatError(
            "{name}: the K-NET CSV header is cut short: no line names the columns (#Time,RelativeTime(s),...)", name=blob.name
        )
    names = [cell.strip() for cell in header[names_at].split(",")]
    sensors = _sensors(blob.name, names)
    clock = next(i for i, name in enumerate(names) if name.startswith("RelativeTime"))
    labels = {names[clock]: clock, **{names[i]: i for codes in sensors.values() for i in codes.values()}}
    columns = dict(zip(labels.values(), columns_of(blob.name, lines[body:], body + 1, labels, len(names)), strict=True))
    dt = even_dt(blob.name, columns[clock])
    rate = number(_after(header, "SamplingFrequency(Hz)"))
    if rate and abs(1.0 / rate - dt) > 1e-6:
        raise RecordFormatError(
            "{name}: its header says {rate:g} Hz, its times are {dt:g} s apart: the file is damaged", name=blob.name, rate=rate, dt=dt
        )
    start = _start(blob.name, lines[body], body + 1, float(columns[clock][0]))
    doubts = _doubts(header, columns[clock].size, rate or 1.0 / dt) + _doubts_of_clock(lines[body:], columns[clock], dt)
    doubts += doubts_of_decimals(lines[body:], body + 1, ",") + doubts_of_end(lines[body:], ",")
    records = []
    for level, codes in sensors.items():
        rows = {code: columns[i] for code, i in codes.items()}
        records.append(
            Record(
                tuple(Component(code, to_si(row, "gal")) for code, row in rows.items()),
                1.0 / rate if rate else dt,
                station=_after(header, "Code,").split(",")[0],
                start=start,
                source=blob.name,
                format=FORMAT,
                metadata=_metadata(header, level) | {"offset_gal": {code: float(row.mean()) for code, row in rows.items()}},
                doubts=doubts,
            )
        )
    return records


def _doubts(header: Sequence[str], samples: int, rate: float) -> tuple[Doubt, ...]:
    """Return what speaks against the count of samples: the header's duration is another, or no number."""
    text = _after(header, "DurationTime(s)")
    duration = number(text)
    if duration is None or not 0 < duration * rate < LARGEST_COUNT:
        found = said("the header's DurationTime is no number ({text!r}): the count of samples cannot be checked", text=text[:20])
        return (Doubt("header", found),)
    promised = round(duration * rate)
    if samples != promised:
        return (Doubt("count", said("the header promises {promised} samples, the file holds {count}", promised=promised, count=samples)),)
    return ()


def _doubts_of_clock(lines: Sequence[str], relative: FloatArray, dt: float) -> tuple[Doubt, ...]:
    """Return what speaks against the times of the day, which the seconds beside them have to go with."""
    told = [line.partition(",")[0].strip().replace("/", "-").replace(" ", "T") for line in lines if line.strip(" \t,")]
    try:
        if not all(map(_TIME_OF_DAY.fullmatch, told)):
            raise ValueError
        since = (np.array(told, dtype="datetime64[us]") - np.datetime64(told[0], "us")) / np.timedelta64(1, "s")
    except ValueError:
        return (Doubt("clock", said("the times of the day in the first column cannot all be read")),)
    apart = np.flatnonzero(np.abs(since - (relative - relative[0])) > 0.5 * dt)
    if not apart.size:
        return ()
    text = said(
        "the time of the day and the seconds beside it differ in {count} line(s), first at {seconds:.2f} s",
        count=apart.size,
        seconds=float(relative[apart[0]]),
    )
    return (Doubt("clock", text),)


def _sensors(name: str, names: Sequence[str]) -> dict[str, dict[str, int]]:
    """Return, for each sensor (of K-NET one, without a level), which column holds which component."""
    sensors: dict[str, dict[str, int]] = {}
    for index, column in enumerate(names):
        code, level = _CHANNELS.get(column.split("(")[0], (code_of(column), ""))
        if code == TIME:
            continue
        unit = split_unit(column)[1]
        if unit and normal_unit(unit) != "gal":
            raise UnitError(
                "{name}: column {column!r} is in {unit}, and a K-NET CSV is in gal: the file is damaged",
                name=name,
                column=column,
                unit=unit,
            )
        if code not in ("NS", "EW", "UD") or code in sensors.get(level, {}):
            raise RecordFormatError(
                "{name}: column {column!r} is none of N-S, E-W, U-D (or 1 to 6), or stands twice: the file is damaged",
                name=name,
                column=column,
            )
        sensors.setdefault(level, {})[code] = index
    if not sensors:
        raise RecordFormatError("{name}: no column of acceleration among {names}", name=name, names=names)
    return sensors


def _after(header: Sequence[str], key: str) -> str:
    """Return the header line that follows the line beginning with a key."""
    for line, following in pairwise(header):
        if line.startswith(key):
            return following
    return ""


def _start(name: str, line: str, number_of_line: int, relative: float) -> datetime:
    """Return the time of the first sample, UTC."""
    text = line.split(",")[0]
    time = time_in_japan(text)
    if time is None:
        fail(name, number_of_line, said("expected a time such as 2019/01/02 17:47:27.00, found {text!r}", text=text))
    return time - timedelta(seconds=relative)


def _metadata(header: Sequence[str], level: str) -> dict[str, object]:
    """Return what the header says of event and station."""
    metadata: dict[str, object] = {"unit": "gal", "clock": "JST", "carries_offset": True}
    if level:
        metadata["level"] = level
    event, station = _after(header, "OriginTime").split(","), _after(header, "Code,").split(",")
    origin = time_in_japan(event[0])
    if origin is not None:
        metadata["origin_time"] = origin
    told = dict(zip(("event_latitude_deg", "event_longitude_deg", "event_depth_km", "magnitude"), event[1:], strict=False))
    told |= dict(zip(("station_latitude_deg", "station_longitude_deg"), station[1:], strict=False))
    return metadata | {label: value for label, text in told.items() if (value := number(text)) is not None}
