"""GeoNet accelerograms (GNS Science, New Zealand), volumes 1 and 2: three components in mm/s^2 in one file.

Ten samples of eight characters per line. Each component has 16 lines of text, 4 of ten integers and 6 of ten reals, then its samples; in
volume 2 velocities and displacements follow and are skipped.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import datetime, timedelta
from typing import NamedTuple

from seisblock.core.typing import FloatArray
from seisblock.readers._fixed_width import count_lines, parse_fixed_width, parse_sample_count
from seisblock.readers._header import flag_peak_mismatch, half_last_digit, parse_coordinates, parse_number, qc_flag, utc_datetime
from seisblock.readers.channels import make_component, split_by_location
from seisblock.readers.directions import Direction, parse_direction
from seisblock.readers.lines import line_error
from seisblock.readers.registry import Format, register
from seisblock.readers.source import RawFile, decode_text
from seisblock.readers.table.parse import to_si
from seisblock.records import QCFlag, Record

TEXT, INTEGERS, REALS = 16, 4, 6
"""Lines of text, integers and reals above the samples of a component."""

_FORM = (10, 8)
_UNIT = "mm/s2"
SITE, NAME, EVENT, DAY, EPICENTRE, COMPONENT, PEAK = 1, 2, 6, 7, 8, 12, 13
"""Text line numbers, from 0."""

SAMPLES, VELOCITIES, DISPLACEMENTS = 33, 34, 35
START_TIME = (8, 9, 18, 19, 38, 39)
"""Indices of the integers: counts; year, month, day, hour, minute and milliseconds of the first sample."""

INTERVAL_INDEX = 25
"""Index of the sampling interval among the reals."""

_MONTHS = ("january", "february", "march", "april", "may", "june", "july", "august", "september", "october", "november", "december")


class _ComponentBlock(NamedTuple):
    """One component: text lines, header numbers, samples, first line number, and index of the next block."""

    text: Sequence[str]
    integers: list[int]
    reals: FloatArray
    samples: FloatArray
    first_line: int
    end: int


def is_geonet(head: bytes) -> bool:
    """Return whether bytes begin with the title of a GNS Science accelerogram."""
    return re.match(rb"[ ]*(?:Unc|C)orrected accelerogram [^\n]*GNS Science", head, re.IGNORECASE) is not None


def read_geonet(blob: RawFile) -> list[Record]:
    """Return the components in a GeoNet file of volume 1 or 2, as single-component records.

    Notes
    -----
    Azimuths are kept: the code of N10E is ``10``. Header peak and duration of each component are checked against the samples.
    """
    lines = decode_text(blob).split("\n")
    while lines and not lines[-1].strip():
        lines.pop()
    parts, begin = [], 0
    while begin < len(lines):
        block = _parse_block(blob.name, lines, begin)
        parts.append(_to_record(blob.name, block))
        begin = block.end
    return split_by_location(parts)


def _parse_block(name: str, lines: Sequence[str], begin: int) -> _ComponentBlock:
    """Return the component that begins at a line."""
    text = lines[begin : begin + TEXT]
    if len(text) < TEXT or not is_geonet(text[0].encode("latin-1", "replace") + b"\n"):
        title = text[0].strip()[:60] if text else ""
        raise line_error("expected the title of a component, found {text!r}", name, begin + 1, text=title)
    integers = parse_fixed_width(name, lines, begin + TEXT, 10 * INTEGERS, _FORM)
    integer_values = [int(value) for value in integers]
    reals = parse_fixed_width(name, lines, begin + TEXT + INTEGERS, 10 * REALS, _FORM)
    counts = [parse_sample_count(name, begin + TEXT + INTEGERS, str(integer_values[SAMPLES]))]
    counts += [max(integer_values[place], 0) for place in (VELOCITIES, DISPLACEMENTS)]
    first = begin + TEXT + INTEGERS + REALS
    samples = parse_fixed_width(name, lines, first, counts[0], _FORM)
    end = first + count_lines(counts[0], _FORM)
    # velocities and displacements are parsed for validity and skipped
    for count in filter(None, counts[1:]):
        parse_fixed_width(name, lines, end, count, _FORM)
        end += count_lines(count, _FORM)
    return _ComponentBlock(text, integer_values, reals, samples, begin + 1, end)


def _to_record(name: str, block: _ComponentBlock) -> Record:
    dt = float(block.reals[INTERVAL_INDEX])
    if not dt > 0.0:
        raise line_error("expected a sampling interval above 0 s, found {dt:g}", name, block.first_line + TEXT + INTEGERS + 2, dt=dt)
    factor = re.search(r"units of\s+([\d.]+)\s*mm/s/s", " ".join(block.text), re.IGNORECASE)
    scale = parse_number(factor[1]) if factor else 1.0
    if not scale:
        raise line_error(
            "expected samples in units of mm/s/s, found {text!r}", name, block.first_line + 10, text=block.text[10].strip()[:60]
        )
    words = block.text[COMPONENT].split()
    direction_name = words[1] if len(words) > 1 and words[0].lower() == "component" else ""
    direction = parse_direction(direction_name)
    if direction is None:
        message = "expected a component such as N10E or Up, found {text!r}"
        raise line_error(message, name, block.first_line + COMPONENT, text=block.text[COMPONENT].strip()[:40])
    component, history = make_component(direction, to_si(scale * block.samples, _UNIT), direction_name)
    return Record(
        (component,),
        dt,
        station=block.text[SITE].split()[1] if len(block.text[SITE].split()) > 1 else "",
        start=_start_time(block.integers),
        source=name,
        format=FORMAT.name,
        history=history,
        metadata=_metadata(block),
        doubts=_qc_flags(direction, block, scale, dt),
    )


def _start_time(integers: Sequence[int]) -> datetime | None:
    year, month, day, hour, minute, milliseconds = (integers[place] for place in START_TIME)
    start = utc_datetime(year, month, day, hour, minute, 0.0)
    return start + timedelta(milliseconds=milliseconds) if start is not None and 0 <= milliseconds < 3_600_000 else None


def _metadata(block: _ComponentBlock) -> dict[str, object]:
    site, name, event, day, epicentre = (block.text[place] for place in (SITE, NAME, EVENT, DAY, EPICENTRE))
    metadata: dict[str, object] = {"unit": _UNIT, "network": "NZ"}
    metadata |= {"station_name": name.strip()} if name.strip() else {}
    metadata |= {"event_name": event.strip()} if event.strip() else {}
    places = dict(zip(("station_latitude_deg", "station_longitude_deg"), parse_coordinates(site), strict=True))
    places |= dict(zip(("event_latitude_deg", "event_longitude_deg"), parse_coordinates(epicentre), strict=True))
    metadata |= {key: value for key, value in places.items() if value is not None}
    for key, pattern in {
        "epicentral_distance_km": r"Dist\s+([\d.]+)\s*km",
        "event_depth_km": r"Depth\s+([\d.]+)\s*km",
        "magnitude": r"\bM[a-z]\w*\s+([\d.]+)",
    }.items():
        match = re.search(pattern, epicentre)
        value = parse_number(match[1]) if match else None
        metadata |= {} if value is None else {key: value}
    date_match = re.match(r"\s*(\d{4})\s+([A-Za-z]+)\s+(\d{1,2})\s+(\d{1,2}):(\d\d):(\d\d)", day)
    if date_match and date_match[2].lower() in _MONTHS:
        month = _MONTHS.index(date_match[2].lower()) + 1
        origin = utc_datetime(int(date_match[1]), month, int(date_match[3]), int(date_match[4]), int(date_match[5]), float(date_match[6]))
        metadata |= {"origin_time": origin} if origin else {}
    return metadata


def _qc_flags(direction: Direction, block: _ComponentBlock, scale: float, dt: float) -> tuple[QCFlag, ...]:
    """Return flags for peak, count and duration that differ from the header."""
    peak = re.search(r"peak\s+(-?[\d.]+)\s*mm/s/s", block.text[PEAK], re.IGNORECASE)
    peak_text = peak[1] if peak else block.text[PEAK].partition(":")[2].strip()
    flags = flag_peak_mismatch(direction.code, peak_text, scale * block.samples, "mm/s/s", 2.0 * half_last_digit(peak_text))
    count_match = re.search(r"points\s+(\d+)\s+Duration\s+([\d.]+)\s*s", block.text[9], re.IGNORECASE)
    count, text = (int(count_match[1][:12]), count_match[2]) if count_match else (0, "")
    size, seconds = block.samples.size, parse_number(text)
    if count != size:
        flags += (qc_flag("header states {promised} samples, file contains {count}", "count", promised=count, count=size),)
    if seconds is None or abs(seconds - size * dt) > 1.5 * dt + half_last_digit(text):
        message = "header duration {text} s differs from the duration of {count} samples, {seconds:g} s"
        flags += (qc_flag(message, "count", text=text[:20] or "-", count=size, seconds=size * dt),)
    return flags


FORMAT = register(Format(name="GEONET", title="GeoNet", parse=read_geonet, matches=is_geonet, synchronous=True))
