"""BHRC (Iran), volume 1: channels L, V and T of one station, evenly sampled in g/10.

Layout found in files: five lines of file, instrument and origin; per channel seven lines of text, 7 of integers, 7 of reals, samples of 13
characters, and an end mark ``/&``. The interval is duration over count.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from seisblock.core.i18n import N_
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.readers._fixed_width import parse_fixed_width, parse_sample_count
from seisblock.readers._header import drop_missing, parse_datetime, parse_number, search_group
from seisblock.readers._header_check import qc_flag
from seisblock.readers.directions import Direction, direction_from_azimuth
from seisblock.readers.lines import line_error, read_trimmed_lines
from seisblock.readers.registry import Format, register
from seisblock.readers.source import RawFile
from seisblock.records import Component, QCFlag, Record

_TENTH_G = 0.1 * STANDARD_GRAVITY
_CHANNEL = re.compile(r"COMP\s+([LVT])\d*\s*$")
CHANNELS = 3
"""Channels of a file."""

_HEADER_LINES = 7 + 7 + 7
_FORM = (10, 13)
"""Samples per line and their width."""


def is_bhrc(head: bytes) -> bool:
    """Return whether bytes begin a volume 1 file of BHRC."""
    return re.match(rb"\*\s*VOL1DS FILE", head) is not None


def read_bhrc(blob: RawFile) -> Record:
    """Return the record in a volume 1 file; the count is checked against the samples."""
    lines = read_trimmed_lines(blob)
    name = blob.name
    begins = [index for index, line in enumerate(lines) if _CHANNEL.match(line)]
    if not begins:
        raise line_error("expected a channel such as COMP L1", name, 1)
    components, intervals = [], []
    complete = True
    for begin in begins:
        component, dt, end = _parse_channel(name, lines, begin)
        components.append(component)
        intervals.append(dt)
        complete = complete and [line.strip() for line in lines[end : end + 1]] == ["/&"]
    if len(set(intervals)) > 1:
        raise line_error("expected one sampling interval, found {found}", name, begins[-1] + 6, found=[f"{dt:g}" for dt in intervals])
    text = " ".join(lines[begins[0] : begins[0] + 4])
    # the origin stands in one of the first lines
    head = " ".join(lines[:6])
    flags: tuple[QCFlag, ...] = () if complete else (qc_flag("end mark of the last channel missing: file probably truncated", "cut"),)
    if len(components) < CHANNELS:
        flags += (qc_flag("{count} of {total} channels in the file: probably truncated", "cut", count=len(components), total=CHANNELS),)
    metadata = {
        "unit": "g/10",
        "station_name": search_group(r"^\s*COMP\s+\S+\s+(.*?)\s+Station\b", text),
        **_coordinates("station", search_group(r"Station\s+(.*?)\s+Altitude", text)),
        **_coordinates("event", search_group(r"Epicenter\s+(.*?)\s+FD", text)),
        "station_height_m": parse_number(search_group(r"Altitude\s+(\d+)m", text)),
        "event_depth_km": parse_number(search_group(r"\bFD\s+([\d.]+)\s*Km", text)),
        "magnitude": next(
            (m for kind in ("Mw", "ML", "Ms", "mb") if (m := parse_number(search_group(rf"\b{kind}\s*([\d.]+)", text)))), None
        ),
        "origin_time": parse_datetime(head.partition("Origin Time")[2])[0],
        "channels": {component.code: letter for component, letter in zip(components, _letters(lines, begins), strict=True)},
        "event": search_group(r"VOL1DS FILE:\s*(\S+)", lines[0]),
    }
    return Record(
        tuple(components),
        intervals[0],
        station=search_group(r"VOL1DS FILE:\s*(\d+)", lines[0]),
        source=name,
        format=FORMAT.name,
        metadata=drop_missing({key: value for key, value in metadata.items() if key != "unit"}),
        doubts=flags,
    )


def _letters(lines: Sequence[str], begins: Sequence[int]) -> list[str]:
    return [search_group(r"COMP\s+(\S+)", lines[begin]) for begin in begins]


def _parse_channel(name: str, lines: Sequence[str], begin: int) -> tuple[Component, float, int]:
    """Return the component, interval and index after the samples of the channel that begins at a line."""
    if len(lines) <= begin + _HEADER_LINES:
        raise line_error("expected {count} header lines of the channel, found the end of the file", name, begin + 1, count=_HEADER_LINES)
    text = " ".join(lines[begin : begin + 7])
    if "G/10" not in text.upper():
        raise line_error("expected samples in g/10, found {text!r}", name, begin + 6, text=lines[begin + 5].strip()[:40])
    count = parse_sample_count(name, begin + 5, search_group(r"NO\. OF POINTS\s*=\s*(\d+)", text))
    duration = parse_number(search_group(r"DURATION\s*=\s*([\d.]+)", text))
    if not duration:
        raise line_error("expected the duration, found {text!r}", name, begin + 5, text=lines[begin + 4].strip()[:40])
    values, end = parse_fixed_width(name, lines, begin + _HEADER_LINES, count, _FORM)
    letter = search_group(r"COMP\s+([LVT])", lines[begin])
    azimuth = parse_number(search_group(rf"\b{letter}\s+(\d{{1,3}})\b", search_group(r"Azimuth(.*)", lines[begin + 1])))
    direction = Direction("UD") if letter == "V" else Direction(letter) if azimuth is None else direction_from_azimuth(azimuth)
    dt = duration / count
    # durations are printed with a millisecond
    rounded = float(f"{dt:.6g}")
    return Component(direction.code, values * _TENTH_G, direction.azimuth_deg), rounded, end


def _coordinates(kind: str, text: str) -> dict[str, object]:
    """Return the coordinates of ``37.485 N 45.891 E`` as metadata."""
    match = re.fullmatch(r"([\d.]+)\s*([NS])\s+([\d.]+)\s*([EW])", text.strip())
    if match is None:
        return {}
    signs = (-1.0 if match[2] == "S" else 1.0, -1.0 if match[4] == "W" else 1.0)
    return {f"{kind}_latitude_deg": signs[0] * float(match[1]), f"{kind}_longitude_deg": signs[1] * float(match[3])}


FORMAT = register(
    Format(name="BHRC", title=N_("BHRC (Iran)"), parse=read_bhrc, matches=is_bhrc, proves=("count", "unit", "sign", "instrument"))
)
