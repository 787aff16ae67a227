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
from seisblock.readers._fixed_width import parse_fixed_width, parse_sample_count
from seisblock.readers._header import drop_missing, parse_coordinates, parse_number, search_group, utc_datetime
from seisblock.readers._header_check import flag_count, flag_duration, flag_peak_mismatch, half_last_digit
from seisblock.readers.channels import make_component, split_by_location
from seisblock.readers.directions import Direction, parse_direction
from seisblock.readers.lines import line_error, read_trimmed_lines
from seisblock.readers.registry import Format, register
from seisblock.readers.source import RawFile
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
    """One component: text lines, header numbers, samples, first line number."""

    text: Sequence[str]
    integers: list[int]
    reals: FloatArray
    samples: FloatArray
    first_line: int


def is_geonet(head: bytes) -> bool:
    """Return whether bytes begin with the title of a GNS Science accelerogram."""
    return re.match(rb"[ ]*(?:Unc|C)orrected accelerogram [^\n]*GNS Science", head, re.IGNORECASE) is not None


def read_geonet(blob: RawFile) -> list[Record]:
    """Return the components in a GeoNet file of volume 1 or 2, as single-component records.

    Notes
    -----
    Azimuths are kept: the code of N10E is ``10``. Header peak and duration of each component are checked against the samples.
    """
    lines = read_trimmed_lines(blob)
    parts, begin = [], 0
    while begin < len(lines):
        block, begin = _parse_block(blob.name, lines, begin)
        parts.append(_to_record(blob.name, block))
    return split_by_location(parts)


def _parse_block(name: str, lines: Sequence[str], begin: int) -> tuple[_ComponentBlock, int]:
    """Return the component that begins at a line, and the index of the next."""
    text = lines[begin : begin + TEXT]
    if len(text) < TEXT or not is_geonet(text[0].encode("latin-1", "replace") + b"\n"):
        title = text[0].strip()[:60] if text else ""
        raise line_error("expected the title of a component, found {text!r}", name, begin + 1, text=title)
    integer_values, _ = parse_fixed_width(name, lines, begin + TEXT, 10 * INTEGERS, _FORM)
    integers = [int(value) for value in integer_values]
    reals, first = parse_fixed_width(name, lines, begin + TEXT + INTEGERS, 10 * REALS, _FORM)
    count = parse_sample_count(name, begin + TEXT + INTEGERS, str(integers[SAMPLES]))
    samples, end = parse_fixed_width(name, lines, first, count, _FORM)
    # velocities and displacements are parsed for validity and skipped
    for place in (VELOCITIES, DISPLACEMENTS):
        if integers[place] > 0:
            _, end = parse_fixed_width(name, lines, end, integers[place], _FORM)
    return _ComponentBlock(text, integers, reals, samples, begin + 1), end


def _to_record(name: str, block: _ComponentBlock) -> Record:
    dt = float(block.reals[INTERVAL_INDEX])
    if not dt > 0.0:
        raise line_error("expected a sampling interval above 0 s, found {dt:g}", name, block.first_line + TEXT + INTEGERS + 2, dt=dt)
    scale = parse_number(search_group(r"units of\s+([\d.]+)\s*mm/s/s", " ".join(block.text)) or "1")
    if not scale:
        message = "expected samples in units of mm/s/s, found {text!r}"
        raise line_error(message, name, block.first_line + 10, text=block.text[10].strip()[:60])
    words = block.text[COMPONENT].split()
    direction_name = words[1] if len(words) > 1 and words[0].lower() == "component" else ""
    direction = parse_direction(direction_name)
    if direction is None:
        message = "expected a component such as N10E or Up, found {text!r}"
        raise line_error(message, name, block.first_line + COMPONENT, text=block.text[COMPONENT].strip()[:40])
    component, history = make_component(direction, to_si(scale * block.samples, _UNIT), direction_name)
    code, start = [*block.text[SITE].split(), "", ""][1], _start_time(block.integers)
    metadata, flags = _metadata(block), _qc_flags(direction, block, scale, dt)
    return Record((component,), dt, code, start, source=name, format=FORMAT.name, history=history, metadata=metadata, doubts=flags)


def _start_time(integers: Sequence[int]) -> datetime | None:
    year, month, day, hour, minute, milliseconds = (integers[place] for place in START_TIME)
    start = utc_datetime(year, month, day, hour, minute, 0.0)
    return start + timedelta(milliseconds=milliseconds) if start is not None and 0 <= milliseconds < 3_600_000 else None


def _metadata(block: _ComponentBlock) -> dict[str, object]:
    site, name, event, day, epicentre = (block.text[place] for place in (SITE, NAME, EVENT, DAY, EPICENTRE))
    places = dict(zip(("station_latitude_deg", "station_longitude_deg"), parse_coordinates(site), strict=True))
    places |= dict(zip(("event_latitude_deg", "event_longitude_deg"), parse_coordinates(epicentre), strict=True))
    origin, date_match = None, re.match(r"\s*(\d{4})\s+([A-Za-z]+)\s+(\d{1,2})\s+(\d{1,2}):(\d\d):(\d\d)", day)
    if date_match and date_match[2].lower() in _MONTHS:
        year, date, hour, minute, second = (int(number) for number in date_match.group(1, 3, 4, 5, 6))
        origin = utc_datetime(year, _MONTHS.index(date_match[2].lower()) + 1, date, hour, minute, float(second))
    return drop_missing(
        {
            "unit": _UNIT,
            "network": "NZ",
            "station_name": name.strip(),
            "event_name": event.strip(),
            **places,
            "epicentral_distance_km": parse_number(search_group(r"Dist\s+([\d.]+)\s*km", epicentre)),
            "event_depth_km": parse_number(search_group(r"Depth\s+([\d.]+)\s*km", epicentre)),
            "magnitude": parse_number(search_group(r"(?-i:\bM[a-z])\w*\s+([\d.]+)", epicentre)),
            "origin_time": origin,
        }
    )


def _qc_flags(direction: Direction, block: _ComponentBlock, scale: float, dt: float) -> tuple[QCFlag, ...]:
    """Return flags for peak, count and duration that differ from the header."""
    peak_text = search_group(r"peak\s+(-?[\d.]+)\s*mm/s/s", block.text[PEAK]) or block.text[PEAK].partition(":")[2].strip()
    count_match = re.search(r"points\s+(\d+)\s+Duration\s+([\d.]+)\s*s", block.text[9], re.IGNORECASE)
    count, duration = (int(count_match[1][:12]), count_match[2]) if count_match else (0, "")
    return (
        *flag_peak_mismatch(direction.code, peak_text, scale * block.samples, "mm/s/s", 2.0 * half_last_digit(peak_text)),
        *flag_count(count, block.samples.size),
        *flag_duration(duration, block.samples.size, dt),
    )


FORMAT = register(
    Format(
        name="GEONET",
        title="GeoNet",
        parse=read_geonet,
        matches=is_geonet,
        proves=("count", "peak", "unit", "sign", "instrument"),
        synchronous=True,
    )
)
