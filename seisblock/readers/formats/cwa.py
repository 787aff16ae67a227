"""Free-field strong-motion text files of Taiwan's CWA (CWB until 2023): ``#`` header, then time, U, N, E.

The layout is known from headers quoted by public programs: ``#StationCode`` to ``#Data: 4F10.3`` of single files, and files of the data
centre that begin with ``#Earthquake Information`` and give times in ``(GMT+08)``. Times without that mark are UTC, as for Chi-Chi, 1999.
``#AmplitudeMAX. U: 4.094~ -4.353`` gives the largest and the smallest sample.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from datetime import datetime, timedelta
from typing import NamedTuple

from seisblock.core.errors import RecordFormatError
from seisblock.core.typing import FloatArray
from seisblock.readers._header import drop_missing, parse_datetime, parse_number
from seisblock.readers._header_check import flag_duration, half_last_digit, qc_flag
from seisblock.readers.directions import Direction, parse_direction
from seisblock.readers.lines import line_error
from seisblock.readers.registry import Format, register
from seisblock.readers.source import RawFile, decode_text
from seisblock.readers.table.checks import flag_missing_points, flag_truncated_end
from seisblock.readers.table.headers import normalize_unit
from seisblock.readers.table.parse import parse_columns, to_si
from seisblock.readers.table.sampling import sampling_interval
from seisblock.records import Component, QCFlag, Record
from seisblock.records.site import UTC_OFFSETS

TAIWAN_CLOCK = "GMT+08"
"""Name of the Taiwan time zone in headers."""

MAX_FIRST_TIME_S = 1e7
"""Largest plausible time of the first sample in the table, s."""

_KEY = re.compile(r"#\s*([^:(]+?)\s*(?:\(([^)]*)\))?\s*:\s*(.*?)\s*$")
_SEQUENCE = re.compile(r"Time\s+(?:[A-Z]+\(\+\)[;,\s]*){1,3}$", re.IGNORECASE)
_EXTREMES = re.compile(r"AmplitudeMAX\.?\s*(\S+)", re.IGNORECASE)
_NUMBERS = {
    "epicenterlatitude": "event_latitude_deg",
    "epicenterlongitude": "event_longitude_deg",
    "depth": "event_depth_km",
    "magnitude": "magnitude",
    "stationlatitude": "station_latitude_deg",
    "stationlongitude": "station_longitude_deg",
    "stationelevation": "station_height_m",
}


class _Entry(NamedTuple):
    """Header entry: qualifier in brackets, value, line number."""

    qualifier: str
    value: str
    line: int


_NO_ENTRY = _Entry("", "", 0)


def is_cwa(head: bytes) -> bool:
    """Return whether bytes begin the header of a CWA strong-motion text file."""
    begins = re.match(rb"(?:\xef\xbb\xbf)?\s*#\s*(?:StationCode|Earthquake Information)", head, re.IGNORECASE)
    return begins is not None and re.search(rb"^\s*#\s*DataSequence\s*:", head, re.IGNORECASE | re.MULTILINE) is not None


def read_cwa(blob: RawFile) -> Record:
    """Return the record in a CWA strong-motion text file.

    Raises
    ------
    RecordFormatError
        If the header lacks rate, unit or column sequence, contradicts the times, or a line of the table is malformed.
    """
    lines = decode_text(blob).split("\n")
    body = next((i for i, line in enumerate(lines) if line.strip() and not line.lstrip().startswith("#")), len(lines))
    header = _parse_header(lines[:body])
    directions = _parse_directions(blob.name, header)
    unit = normalize_unit(_require_entry(blob.name, header, "amplitudeunit").value.partition(" ")[0])
    if unit is None:
        entry = header["amplitudeunit"]
        raise line_error("expected an acceleration unit such as gal, found {text!r}", blob.name, entry.line, text=entry.value[:40])
    labels = {"Time": 0, **{code: i + 1 for i, code in enumerate(directions)}}
    rows = parse_columns(blob.name, lines[body:], body + 1, labels, len(labels), separator=None)
    dt = _sampling_interval(blob.name, header, rows[0], lines[body:])
    samples = dict(zip(directions, rows[1:], strict=True))
    start = _start_time(blob.name, header, float(rows[0][0]))
    components = tuple(Component(code, to_si(row, unit), directions[code].azimuth_deg) for code, row in samples.items())
    metadata = {"unit": unit, **_metadata(header)}
    flags = (*_flag_length(header, rows[0].size, dt), *_flag_extremes(header, samples, unit))
    flags += flag_missing_points(lines[body:], body + 1, None) + flag_truncated_end(lines[body:], None)
    station = header.get("stationcode", _NO_ENTRY).value
    return Record(components, dt, station, start, source=blob.name, format=FORMAT.name, metadata=metadata, doubts=flags)


def _parse_header(lines: Sequence[str]) -> dict[str, _Entry]:
    """Return the header entries by name in lower case without blanks; the first of duplicates."""
    entries: dict[str, _Entry] = {}
    for index, line in enumerate(lines):
        match = _KEY.match(line.lstrip("\ufeff "))
        if match:
            entries.setdefault(re.sub(r"\s", "", match[1]).lower(), _Entry(match[2] or "", match[3], index + 1))
    return entries


def _require_entry(name: str, header: Mapping[str, _Entry], key: str) -> _Entry:
    if key not in header:
        line_names = {"amplitudeunit": "#AmplitudeUnit", "samplerate": "#SampleRate(Hz)", "datasequence": "#DataSequence"}
        message = "{name}: CWA header line {line} missing: file truncated or damaged; download it again"
        raise RecordFormatError(message, name=name, line=line_names[key])
    return header[key]


def _parse_directions(name: str, header: Mapping[str, _Entry]) -> dict[str, Direction]:
    """Return the directions of the acceleration columns by code, in column order."""
    entry = _require_entry(name, header, "datasequence")
    letters = re.findall(r"([A-Z]+)\(\+\)", entry.value, re.IGNORECASE)
    parsed_directions = [parse_direction(letter) for letter in letters]
    directions = {direction.code: direction for direction in parsed_directions if direction is not None and direction.sign > 0.0}
    if not _SEQUENCE.match(entry.value) or len(directions) != len(letters):
        message = "expected the column sequence, as in 'Time U(+); N(+); E(+)', found {text!r}"
        raise line_error(message, name, entry.line, text=entry.value[:60])
    return directions


def _sampling_interval(name: str, header: Mapping[str, _Entry], times: FloatArray, body: Sequence[str]) -> float:
    """Return the sampling interval, s, on which header rate and times agree."""
    entry = _require_entry(name, header, "samplerate")
    rate = parse_number(entry.value)
    if rate is None or not rate > 0.0:
        raise line_error("expected the number of samples per second, found {text!r}", name, entry.line, text=entry.value[:40])
    dt = sampling_interval(name, times, lambda: [line.split()[0] for line in body if line.strip()])
    # the times have three decimals; the rate of the header is exact
    if abs(1.0 / rate - dt) > 1e-6:
        message = "{name}: header rate {rate:g} Hz contradicts the time column (interval {dt:g} s): file damaged"
        raise RecordFormatError(message, name=name, rate=rate, dt=dt)
    return 1.0 / rate


def _start_time(name: str, header: Mapping[str, _Entry], first_s: float) -> datetime | None:
    """Return the UTC time of the first sample, at table time `first_s`; None if not in the header."""
    entry = header.get("starttime")
    if entry is None or not entry.value:
        return None
    start = _parse_time(entry)
    if start is None:
        raise line_error("expected a time such as 1999/09/20-17:47:15.000, found {text!r}", name, entry.line, text=entry.value[:40])
    return start + timedelta(seconds=first_s) if abs(first_s) < MAX_FIRST_TIME_S else start


def _parse_time(entry: _Entry) -> datetime | None:
    # date and time are separated by a hyphen, or by a T as in ISO 8601
    day, _, time = re.sub(r"(?<=\d)[T-](?=\d\d?:)", " ", entry.value).partition(" ")
    local_time, _ = parse_datetime(f"{day.replace('-', '/')} {time}")
    return local_time - UTC_OFFSETS[TAIWAN_CLOCK] if local_time is not None and _is_local(entry) else local_time


def _is_local(entry: _Entry) -> bool:
    """Return whether a header time is in Taiwan time."""
    return re.fullmatch(r"(?:GMT|UTC)\s*\+\s*0?8(?::?00)?", entry.qualifier.strip(), re.IGNORECASE) is not None


def _flag_length(header: Mapping[str, _Entry], count: int, dt: float) -> tuple[QCFlag, ...]:
    """Return a flag if the header record length differs from the samples (n or n - 1 intervals)."""
    text = header.get("recordlength", _NO_ENTRY).value
    slack = min(half_last_digit(text), 0.1 * dt)
    return flag_duration(text, count, dt, slack, counts=(count, count - 1)) if "recordlength" in header else ()


def _flag_extremes(header: Mapping[str, _Entry], samples: Mapping[str, FloatArray], unit: str) -> Iterator[QCFlag]:
    """Yield flags for components whose extremes differ from the header."""
    for key, entry in header.items():
        match = _EXTREMES.fullmatch(key)
        direction = parse_direction(match[1]) if match else None
        if direction is None or direction.code not in samples:
            continue
        row, parts = samples[direction.code], [part.strip() for part in entry.value.split("~")]
        stated_extremes = sorted(value for part in parts if (value := parse_number(part)) is not None)
        sample_extremes = [float(row.min()), float(row.max())]
        # header and table are rounded separately
        slack = 2.0 * max(half_last_digit(part) for part in parts) * (1.0 + 1e-6)
        if len(stated_extremes) == 2 and all(abs(a - b) <= slack for a, b in zip(stated_extremes, sample_extremes, strict=True)):
            continue
        low, high = sample_extremes
        message = "{component}: header range {stated!r} differs from the range of the samples, {low:g} to {high:g} {unit}"
        yield qc_flag(message, "header", direction.code, stated=entry.value[:40], low=low, high=high, unit=unit)


def _metadata(header: Mapping[str, _Entry]) -> dict[str, object]:
    return drop_missing(
        {
            "network": "TW",
            "clock": TAIWAN_CLOCK if _is_local(header.get("starttime", _NO_ENTRY)) else None,
            "station_name": header.get("stationname", _NO_ENTRY).value,
            **{label: parse_number(header.get(key, _NO_ENTRY).value) for key, label in _NUMBERS.items()},
            "origin_time": _parse_time(header.get("origintime", _NO_ENTRY)),
        }
    )


FORMAT = register(
    Format(name="CWA", parse=read_cwa, matches=is_cwa, proves=("count", "peak", "clock", "unit", "sign", "instrument"), aliases=("CWB",))
)
