"""CSMNC (China Strong Motion Network Center): one component in cm/s^2 below 16 lines of header.

Layout found in files: record number, event with time and place, ``STATION: 65JZC 39.700N 77.599E``, ``COMP. EW``, quantity and unit, count
and interval, peak and duration, pre-event time with or without ``RECORDER TIME``, the word CSMNC; then numbers between blanks. Clocks are
Beijing time (BTM). The files of a station are numbered one after another, ``ua0001.dat`` to ``ua0003.dat``.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import datetime

import numpy as np

from seisblock.core.errors import RecordFormatError
from seisblock.core.i18n import N_
from seisblock.readers._header import drop_missing, parse_coordinates, parse_number, search_group, utc_datetime
from seisblock.readers._header_check import flag_count, flag_duration, flag_peak_mismatch, half_last_digit, qc_flag
from seisblock.readers.channels import make_component
from seisblock.readers.directions import parse_direction
from seisblock.readers.lines import line_error, read_trimmed_lines
from seisblock.readers.registry import FileSet, Format, register
from seisblock.readers.source import RawFile
from seisblock.readers.table.headers import normalize_unit
from seisblock.readers.table.parse import to_si
from seisblock.records import Record

_HEADER_LINES = 20
"""Number of lines searched for the end of the header."""

_END_LINE = 14
"""Line of the word CSMNC, from 0."""

_QUANTITY = re.compile(r"^(?:UN)?CORRECTED (ACCELERATION|VELOCITY|DISPLACEMENT)\s+UNIT:\s*(\S+)", re.IGNORECASE)
_SAMPLING = re.compile(r"^NO\. OF POINTS:\s*(\d+)\s+EQUALLY SPACED INTERVALS OF:\s*([\d.]+)\s*SEC", re.IGNORECASE)
_TIME = re.compile(r"(\d{4})-(\d{1,2})-(\d{1,2})\s+(\d{1,2}):(\d{1,2}):(\d{1,2}(?:\.\d+)?)\s+BTM", re.IGNORECASE)
_FILE_NAME = re.compile(r"(?P<before>.*\D)(?P<number>\d{4})\.dat\Z", re.IGNORECASE)

BEIJING_CLOCK = "GMT+08"
"""Clock of the times in the header."""


def is_csmnc(head: bytes) -> bool:
    """Return whether bytes begin a CSMNC file."""
    lines = [line.strip() for line in head.decode("latin-1").splitlines()[:_HEADER_LINES]]
    return "CSMNC" in lines and any(line.startswith("STATION:") for line in lines) and any(map(_SAMPLING.match, lines))


def _is_derived(head: bytes) -> bool:
    """Return whether a CSMNC file has velocities or displacements."""
    quantities = re.search(rb"^(?:UN)?CORRECTED (VELOCITY|DISPLACEMENT)\s+UNIT:", head, re.MULTILINE)
    return quantities is not None and is_csmnc(head)


def read_csmnc(blob: RawFile) -> Record:
    """Return the component in a CSMNC file; header count, peak and duration are checked against the samples.

    Notes
    -----
    The recorder time is the time of the first sample, before the origin of the earthquake in files that state both; without one, `start`
    is None.
    """
    lines = read_trimmed_lines(blob)
    end = next(i for i, line in enumerate(lines) if line.strip() == "CSMNC")
    header = "\n".join(lines[:end])
    quantity = next((match for line in lines[:end] if (match := _QUANTITY.match(line))), None)
    unit = normalize_unit(quantity[2]) if quantity is not None and quantity[1].upper() == "ACCELERATION" else None
    if quantity is None or unit is None:
        found = "-" if quantity is None else quantity[0][:60]
        raise RecordFormatError("{name}: header states {found!r}: expected acceleration and its unit", name=blob.name, found=found)
    sampling_line, sampling = next((i, match) for i, line in enumerate(lines) if (match := _SAMPLING.match(line)))
    count, dt = int(sampling[1][:20]), parse_number(sampling[2])
    if not dt:
        raise line_error("expected a sampling interval above 0 s, found {text!r}", blob.name, sampling_line + 1, text=sampling[2][:20])
    cells = [(i + 1, cell) for i, line in enumerate(lines[end + 1 :], end + 1) for cell in line.split()]
    values = np.array([value for _, cell in cells if (value := parse_number(cell)) is not None])
    if values.size < len(cells):
        line, cell = next((line, cell) for line, cell in cells if parse_number(cell) is None)
        raise line_error("expected a number, found {cell!r}", blob.name, line, cell=cell[:40])
    if values.size < 2:
        raise RecordFormatError("{name}: no samples after the header (line {line})", name=blob.name, line=end + 1)
    direction_name = _entry(lines[:end], "COMP.")
    direction = parse_direction(direction_name)
    if direction is None:
        raise RecordFormatError("{name}: expected a component such as EW, found {text!r}", name=blob.name, text=direction_name[:40])
    component, history = make_component(direction, to_si(values, unit), direction_name)
    peak = search_group(r"PEAK VALUE:\s*(-?[\d.]+)", header)
    flags = (
        *(() if end == _END_LINE else (qc_flag("header of {count} lines, expected {expected}", "header", count=end, expected=_END_LINE),)),
        *flag_count(count, values.size),
        *flag_peak_mismatch(direction.code, peak, values, unit, half_last_digit(peak)),
        *flag_duration(search_group(r"DURATION:\s*([\d.]+)", header), values.size, dt),
    )
    station = _entry(lines[:end], "STATION:").split()
    return Record(
        (component,),
        dt,
        station=station[0] if station else "",
        start=_parse_time(search_group(r"RECORDER TIME:\s*(.*)", header)),
        source=blob.name,
        format=FORMAT.name,
        history=history,
        metadata={"unit": unit, **_metadata(lines[:end], header)},
        doubts=flags,
    )


def _entry(lines: Sequence[str], key: str) -> str:
    """Return the text behind a key that begins a header line; empty if there is none."""
    return next((line.strip()[len(key) :].strip() for line in lines if line.strip().startswith(key)), "")


def _parse_time(text: str) -> datetime | None:
    """Return the UTC time of ``2012-01-3 15:39:44.000 BTM``, or None if the text is not a time."""
    match = _TIME.search(text)
    if match is None:
        return None
    year, month, day, hour, minute = (int(part) for part in match.groups()[:5])
    return utc_datetime(year, month, day, hour, minute, float(match[6]), BEIJING_CLOCK)


def _metadata(lines: Sequence[str], header: str) -> dict[str, object]:
    latitude, longitude = parse_coordinates(_entry(lines, "STATION:"))
    event_latitude, event_longitude = parse_coordinates(_entry(lines, "EPICENTER"))
    return drop_missing(
        {
            "clock": BEIJING_CLOCK,
            "station_latitude_deg": latitude,
            "station_longitude_deg": longitude,
            "event_latitude_deg": event_latitude,
            "event_longitude_deg": event_longitude,
            "event_depth_km": parse_number(search_group(r"DEPTH\s+([\d.]+)", header)),
            "magnitude": parse_number(search_group(r"MAGNITUDE\s+([\d.]+)", header)),
            "event_name": lines[2].strip() if len(lines) > 2 else "",
            "origin_time": _parse_time(lines[1]) if len(lines) > 1 else None,
        }
    )


def csmnc_file_set(basename: str) -> FileSet | None:
    """Return the file set of a station: three files numbered one after another.

    Examples
    --------
    >>> csmnc_file_set("ua0003.dat"), csmnc_file_set("ua0004.dat").key, csmnc_file_set("record.dat")
    (FileSet(key='ua0', size=3, component='2', level=''), 'ua1', None)
    """
    match = _FILE_NAME.match(basename)
    if match is None:
        return None
    group, place = divmod(int(match["number"]) - 1, 3)
    return FileSet(f"{match['before']}{group}".lower(), 3, str(place))


def _recording_key(head: bytes) -> object:
    """Return the record number without that of the component."""
    return head.split(b"\n", 1)[0].strip()[:-2]


FORMAT = register(
    Format(
        name="CSMNC",
        title=N_("CSMNC (China)"),
        parse=read_csmnc,
        matches=is_csmnc,
        is_derived=_is_derived,
        proves=("count", "peak", "unit", "sign", "instrument"),
        synchronous=True,
        file_set=csmnc_file_set,
        recording_key=_recording_key,
    )
)
