"""Accelerograms of GeoNet (GNS Science, New Zealand), volumes 1 and 2: three components in one file, mm/s^2.

Samples stand ten in a line, eight characters each. Each component has sixteen lines of text, four of ten integers and six of ten reals;
then its samples, and in volume 2 its velocities and displacements, which are passed over.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import datetime, timedelta
from typing import NamedTuple

from seisblock.readers.cells import fail, to_si
from seisblock.readers.channels import at_places, turned
from seisblock.readers.directions import Direction, direction_of
from seisblock.readers.fields import count_in, fields_of, lines_for
from seisblock.readers.header import number
from seisblock.readers.peaks import doubts_of_peak, half_unit
from seisblock.readers.places import degrees_of, moment
from seisblock.readers.source import Blob, decode
from seisblock.records import Doubt, Record
from seisblock.typing import FloatArray
from seisblock.words import said

FORMAT = "GEONET"
TEXT, INTEGERS, REALS = 16, 4, 6
"""Lines of each kind above the samples of a component."""

_FORM = (10, 8)
_UNIT = "mm/s2"
SITE, NAME, EVENT, DAY, EPICENTRE, COMPONENT, PEAK = 1, 2, 6, 7, 8, 12, 13
"""Lines of text."""

SAMPLES, VELOCITIES, DISPLACEMENTS = 33, 34, 35
BEGUN = (8, 9, 18, 19, 38, 39)
"""Places of the integers: counts; year, month, day, hour, minute and milliseconds of the first sample."""

INTERVAL = 25
"""Place of the interval of the samples among the reals."""

_MONTHS = ("january", "february", "march", "april", "may", "june", "july", "august", "september", "october", "november", "december")


class _Block(NamedTuple):
    """One component: its lines of text, the numbers below, and where the next begins."""

    text: Sequence[str]
    integers: list[int]
    reals: FloatArray
    samples: FloatArray
    first: int
    end: int


def is_geonet(head: bytes) -> bool:
    """Return whether a file's first line is that of an accelerogram of GNS Science."""
    return re.match(rb"[ ]*(?:Unc|C)orrected accelerogram [^\n]*GNS Science", head, re.IGNORECASE) is not None


def read_geonet(blob: Blob) -> list[Record]:
    """Return the components in a GeoNet file of volume 1 or 2, as records of one component each.

    Notes
    -----
    The azimuths are kept: N10E is called ``10``. The header's peak of each component, and its duration, are compared with the samples.
    """
    lines = decode(blob).split("\n")
    while lines and not lines[-1].strip():
        lines.pop()
    parts, begin = [], 0
    while begin < len(lines):
        block = _block(blob.name, lines, begin)
        parts.append(_record(blob.name, block))
        begin = block.end
    return at_places(parts)


def _block(name: str, lines: Sequence[str], begin: int) -> _Block:
    """Return the component that begins at a line."""
    text = lines[begin : begin + TEXT]
    if len(text) < TEXT or not is_geonet(text[0].encode("latin-1", "replace") + b"\n"):
        found = text[0].strip()[:60] if text else ""
        fail(name, begin + 1, said("expected the title of a component, found {text!r}", text=found))
    integers = fields_of(name, lines, begin + TEXT, 10 * INTEGERS, _FORM)
    whole = [int(value) for value in integers]
    reals = fields_of(name, lines, begin + TEXT + INTEGERS, 10 * REALS, _FORM)
    counts = [count_in(name, begin + TEXT + INTEGERS, str(whole[SAMPLES]))]
    counts += [max(whole[place], 0) for place in (VELOCITIES, DISPLACEMENTS)]
    first = begin + TEXT + INTEGERS + REALS
    samples = fields_of(name, lines, first, counts[0], _FORM)
    end = first + lines_for(counts[0], _FORM)
    for count in filter(None, counts[1:]):
        fields_of(name, lines, end, count, _FORM)
        end += lines_for(count, _FORM)
    return _Block(text, whole, reals, samples, begin + 1, end)


def _record(name: str, block: _Block) -> Record:
    """Return one component."""
    dt = float(block.reals[INTERVAL])
    if not dt > 0.0:
        fail(name, block.first + TEXT + INTEGERS + 2, said("expected a sampling interval above 0 s, found {dt:g}", dt=dt))
    factor = re.search(r"units of\s+([\d.]+)\s*mm/s/s", " ".join(block.text), re.IGNORECASE)
    scale = number(factor[1]) if factor else 1.0
    if not scale:
        fail(name, block.first + 10, said("expected samples in units of mm/s/s, found {text!r}", text=block.text[10].strip()[:60]))
    words = block.text[COMPONENT].split()
    written = words[1] if len(words) > 1 and words[0].lower() == "component" else ""
    direction = direction_of(written)
    if direction is None:
        what = said("expected a component such as N10E or Up, found {text!r}", text=block.text[COMPONENT].strip()[:40])
        fail(name, block.first + COMPONENT, what)
    component, history = turned(direction, to_si(scale * block.samples, _UNIT), written)
    return Record(
        (component,),
        dt,
        station=block.text[SITE].split()[1] if len(block.text[SITE].split()) > 1 else "",
        start=_start(block.integers),
        source=name,
        format=FORMAT,
        history=history,
        metadata=_metadata(block),
        doubts=_doubts(direction, block, scale, dt),
    )


def _start(integers: Sequence[int]) -> datetime | None:
    """Return the time of the first sample, UTC."""
    year, month, day, hour, minute, milliseconds = (integers[place] for place in BEGUN)
    begun = moment(year, month, day, hour, minute, 0.0)
    return begun + timedelta(milliseconds=milliseconds) if begun is not None and 0 <= milliseconds < 3_600_000 else None


def _metadata(block: _Block) -> dict[str, object]:
    """Return what the text says of station and earthquake."""
    site, name, event, day, epicentre = (block.text[place] for place in (SITE, NAME, EVENT, DAY, EPICENTRE))
    metadata: dict[str, object] = {"unit": _UNIT, "network": "NZ"}
    metadata |= {"station_name": name.strip()} if name.strip() else {}
    metadata |= {"event_name": event.strip()} if event.strip() else {}
    places = dict(zip(("station_latitude_deg", "station_longitude_deg"), degrees_of(site), strict=True))
    places |= dict(zip(("event_latitude_deg", "event_longitude_deg"), degrees_of(epicentre), strict=True))
    metadata |= {key: value for key, value in places.items() if value is not None}
    for key, pattern in {
        "epicentral_distance_km": r"Dist\s+([\d.]+)\s*km",
        "event_depth_km": r"Depth\s+([\d.]+)\s*km",
        "magnitude": r"\bM[a-z]\w*\s+([\d.]+)",
    }.items():
        found = re.search(pattern, epicentre)
        value = number(found[1]) if found else None
        metadata |= {} if value is None else {key: value}
    told = re.match(r"\s*(\d{4})\s+([A-Za-z]+)\s+(\d{1,2})\s+(\d{1,2}):(\d\d):(\d\d)", day)
    if told and told[2].lower() in _MONTHS:
        month = _MONTHS.index(told[2].lower()) + 1
        origin = moment(int(told[1]), month, int(told[3]), int(told[4]), int(told[5]), float(told[6]))
        metadata |= {"origin_time": origin} if origin else {}
    return metadata


def _doubts(direction: Direction, block: _Block, scale: float, dt: float) -> tuple[Doubt, ...]:
    """Return what the text says of the samples that is not so: peak, count and duration."""
    peak = re.search(r"peak\s+(-?[\d.]+)\s*mm/s/s", block.text[PEAK], re.IGNORECASE)
    told = peak[1] if peak else block.text[PEAK].partition(":")[2].strip()
    found = doubts_of_peak(direction.code, told, scale * block.samples, "mm/s/s", 2.0 * half_unit(told))
    counted = re.search(r"points\s+(\d+)\s+Duration\s+([\d.]+)\s*s", block.text[9], re.IGNORECASE)
    count, text = (int(counted[1][:12]), counted[2]) if counted else (0, "")
    size, seconds = block.samples.size, number(text)
    if count != size:
        found += (Doubt("count", said("the header promises {promised} samples, the file holds {count}", promised=count, count=size)),)
    if seconds is None or abs(seconds - size * dt) > 1.5 * dt + half_unit(text):
        what = said("the header tells a duration of {text} s, {count} samples take {seconds:g} s", text=text[:20] or "-", count=size,
                    seconds=size * dt)  # fmt: skip
        found += (Doubt("count", what),)
    return found
