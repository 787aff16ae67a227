"""COSMOS, volumes 1 and 2 (format v1.20): text, 100 integers, 100 reals, comments, then the samples of a channel, one or more in a file.

Each part of a header tells how many values follow in which Fortran format. Raw counts (volume 0), pairs of time and acceleration,
velocities and displacements are recognised by the first line, or by the integers, and refused by name.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import datetime
from typing import NamedTuple

from seisblock.errors import RecordFormatError, UnitError
from seisblock.readers.cells import fail, to_si
from seisblock.readers.channels import at_places, place_in, turned
from seisblock.readers.directions import Direction, direction_of, towards
from seisblock.readers.fields import DOS_END, count_in, fields_of, form_of, lines_for
from seisblock.readers.formats.csmip import magnitude_in
from seisblock.readers.peaks import doubts_of_peak, half_unit
from seisblock.readers.places import moment, moment_of
from seisblock.readers.source import Blob, decode
from seisblock.records import Doubt, Record
from seisblock.records.site import CLOCKS
from seisblock.typing import FloatArray
from seisblock.words import noted, said

FORMAT = "COSMOS"
_TITLE = re.compile(rb"[ ]*([A-Za-z][A-Za-z ]*?)\s*\(Format v[\d.]+ with\s+(\d+) text lines\)", re.IGNORECASE)
_HEAD = re.compile(r"\s*(\d+)\s+(Integer|Real)-header values follow on\s+(\d+)\s+lines", re.IGNORECASE)
_COMMENTS = re.compile(r"\s*(\d+)\s+Comment line\(s\) follow", re.IGNORECASE)
_DATA = re.compile(r"\s*(\d+)\s+([A-Za-z. ]+?)\s*pts,.*units\s*=\s*([^,(]*)\((\d+)\)", re.IGNORECASE)
_END = re.compile(r"(?:/&[\s-]*End of data for channel\s+\S+\s+-{10}|End-of-data for \S.*acceleration)\s*\Z", re.IGNORECASE)
TITLE, RECORD, HYPOCENTRE, ORIGIN, STATION, BEGUN, CHANNEL, PEAK = 0, 1, 2, 3, 4, 7, 8, 10
"""Lines of text."""

LEVEL, QUANTITY, UNIT, STRUCTURE, YEAR, MONTH, DAY, HOUR, MINUTE, AZIMUTH = 0, 1, 2, 18, 39, 41, 42, 43, 44, 53
"""Places of the integers, from 0."""

PLACES = {
    "station_latitude_deg": 0,
    "station_longitude_deg": 1,
    "station_height_m": 2,
    "event_latitude_deg": 9,
    "event_longitude_deg": 10,
    "event_depth_km": 11,
    "epicentral_distance_km": 16,
}
MAGNITUDES, SECOND, INTERVAL_MS, LENGTH = (12, 14, 13), 29, 61, 62
"""Places of the reals, from 0: moment, local and surface-wave magnitude."""

UNTOLD_BELOW = -998.0
"""Reals from here down say nothing: COSMOS writes -999."""

_UNITS = {2: ("g", 1.0), 4: ("gal", 1.0), 7: ("gal", 2.54), 10: ("gal", 1.0), 11: ("g", 1e-3), 12: ("g", 1e-6)}
"""Units of acceleration and their factor, by COSMOS's number; 7 is in/s^2, 11 mg, 12 micro-g."""

_DIRECTIONS = {400: "UP", 401: "DOWN", 402: "UP", 500: "R", 501: "TRANS", 600: "L", 601: "TRANS", 700: "H1", 701: "H2"}
_STRUCTURES = {10, 11, 12, 13, 15, 20}
"""Numbers of stations in a building, bridge, dam, wharf, or other structure."""

_REFUSED = {
    "raw": noted("raw counts (volume 0): take volume 1 or 2 of the same record"),
    "velocity": noted("a velocity: take the file of accelerations of the same record"),
    "displacement": noted("a displacement: take the file of accelerations of the same record"),
    "uneven": noted("uneven samples, pairs of time and acceleration: take volume 2 of the same record, whose samples are even"),
}


class _Block(NamedTuple):
    """One channel: its text, header, comments and samples, the line of its data, and where the next begins."""

    text: Sequence[str]
    integers: list[int]
    reals: FloatArray
    comments: str
    samples: FloatArray
    at: int
    end: int


def is_cosmos(head: bytes) -> bool:
    """Return whether a file's first line tells the format of COSMOS and how many lines of text follow."""
    return _TITLE.match(head) is not None


def read_cosmos(blob: Blob) -> list[Record]:
    """Return the channels in a COSMOS file of volume 1 or 2, as records of one component each.

    Notes
    -----
    Channels in a building, bridge or dam are stations of their own by the place that the header tells. The header's peak, and the length
    of the record, are compared with the samples.
    """
    lines = decode(blob).replace(DOS_END, "").split("\n")
    while lines and not lines[-1].strip():
        lines.pop()
    parts, begin, structure = [], 0, False
    whole = _END.match((lines or [""])[-1]) is not None
    while begin < len(lines):
        block = _block(blob.name, lines, begin)
        parts.append(_record(blob.name, block, whole=whole))
        structure = structure or block.integers[STRUCTURE] in _STRUCTURES
        begin = block.end
        while begin < len(lines) and not lines[begin].strip():
            begin += 1
    return at_places(parts, structure=structure)


def _block(name: str, lines: Sequence[str], begin: int) -> _Block:
    """Return the channel that begins at a line."""
    title = _TITLE.match(lines[begin].encode("latin-1", "replace"))
    if title is None:
        fail(name, begin + 1, said("expected the title of a channel, found {text!r}", text=lines[begin].strip()[:60]))
    _refuse(name, title[1].decode("latin-1"))
    at = begin + int(title[2][:3])
    integers, at = _values(name, lines, at, "Integer")
    reals, at = _values(name, lines, at, "Real")
    remarks = _COMMENTS.match(lines[at]) if at < len(lines) else None
    if remarks is None:
        fail(name, at + 1, said("expected the number of comments, found {text!r}", text=_line(lines, at)))
    count = int(remarks[1][:4])
    comments = lines[at + 1 : at + 1 + count]
    if len(comments) < count or not all(line.lstrip().startswith("|") for line in comments):
        fail(name, at + 1, said("expected {count} comments that begin with |", count=count))
    at += 1 + count
    data, form = _DATA.match(lines[at] if at < len(lines) else ""), form_of(_line(lines, at))
    if data is None or form is None:
        what = said("expected a line with count, unit and format of the samples below it, found {text!r}", text=_line(lines, at))
        fail(name, at + 1, what)
    _refuse(name, data[2])
    size = count_in(name, at + 1, data[1])
    whole = [int(value) for value in integers]
    if int(data[4]) == 3 or whole[UNIT] == 3:
        raise RecordFormatError("{name} holds {what}", name=name, what=said(_REFUSED["uneven"]))
    samples = fields_of(name, lines, at + 1, size, form)
    end = at + 1 + lines_for(size, form)
    if end < len(lines) and not re.match(r"/&|End-of-data", lines[end], re.IGNORECASE):
        fail(name, end + 1, said("expected the end of the channel, found {text!r}", text=_line(lines, end)))
    if int(data[4]) != whole[UNIT]:
        what = said("the unit of the samples is {one} here and {other} in the integers", one=data[3].strip(), other=whole[UNIT])
        fail(name, at + 1, what)
    text = [*lines[begin : begin + int(title[2][:3])], *[""] * (PEAK + 1)]
    return _Block(text, whole, reals, "\n".join(comments), samples, at, end + 1)


def _refuse(name: str, quantity: str) -> None:
    """Refuse what is no acceleration."""
    told = re.sub(r"^(?:un)?corrected\s+", "", quantity.strip().lower())
    found = next((what for word, what in _REFUSED.items() if told.startswith(word)), None)
    if found is not None:
        raise RecordFormatError("{name} holds {what}", name=name, what=said(found))


def _line(lines: Sequence[str], index: int) -> str:
    """Return what stands in a line, nothing behind the last."""
    return lines[index].strip()[:80] if index < len(lines) else ""


def _values(name: str, lines: Sequence[str], at: int, kind: str) -> tuple[FloatArray, int]:
    """Return the integers or reals of a header, and the index of the line behind them."""
    head, form = _HEAD.match(_line(lines, at)), form_of(_line(lines, at))
    if head is None or form is None or head[2].lower() != kind.lower() or int(head[1][:6]) < 100:
        what = said("expected the number, lines and format of {kind}-header values, found {text!r}", kind=kind, text=_line(lines, at))
        fail(name, at + 1, what)
    count = int(head[1][:6])
    return fields_of(name, lines, at + 1, count, form), at + 1 + lines_for(count, form)


def _record(name: str, block: _Block, *, whole: bool) -> Record:
    """Return one channel."""
    if block.integers[UNIT] not in _UNITS:
        found = block.integers[UNIT]
        raise UnitError("{name}, line {line}: unknown unit of acceleration {text!r}", name=name, line=block.at + 1, text=found)
    unit, factor = _UNITS[block.integers[UNIT]]
    dt = float(block.reals[INTERVAL_MS]) / 1000.0
    if not dt > 0.0:
        fail(name, block.at + 1, said("the reals above tell a sampling interval of {dt:g} ms: expected one above 0", dt=1000.0 * dt))
    direction, written = _direction(block)
    scaled = block.samples if factor == 1.0 else factor * block.samples
    component, history = turned(direction, to_si(scaled, unit), written)
    doubts = _doubts(direction.code, block, dt)
    if not whole:
        doubts += (Doubt("cut", said("the mark that ends the last channel is missing: the file looks cut")),)
    start = _start(block)
    return Record(
        (component,),
        dt,
        station=_station(block)[0],
        start=start,
        source=name,
        format=FORMAT,
        history=history,
        metadata={"unit": unit, "volume": f"V{block.integers[LEVEL]}", **_metadata(block)},
        doubts=doubts,
    )


def _direction(block: _Block) -> tuple[Direction, str]:
    """Return the direction of a channel and its name: by the integers, else by the text, else by the SEED code among the comments."""
    azimuth = block.integers[AZIMUTH]
    if 1 <= azimuth <= 360:
        return towards(float(azimuth)), str(azimuth)
    written = re.search(r"Chan?\s*\S*?:\s*(\d{1,3}\s*deg\b|[^\s(]+)", block.text[CHANNEL], re.IGNORECASE)
    seed = re.search(r"<SCNL>\s*[^.\s]*\.([^.\s]+)", block.comments)
    for word in (_DIRECTIONS.get(azimuth, ""), written[1] if written else "", seed[1] if seed else ""):
        found = direction_of(word) if word else None
        if found is not None:
            return found, word
    return Direction("H1"), written[1] if written else ""


def _station(block: _Block) -> tuple[str, str, str]:
    """Return code, network and name of the station."""
    text = block.text[STATION]
    code = re.search(r"Code:\s*([A-Z0-9_]{0,2})-(\S+)", text, re.IGNORECASE)
    known = re.search(r"Statn No:\s*(\S+)", text, re.IGNORECASE)
    name = text[40:].strip() if code else ""
    return (code[2], code[1], name) if code else (known[1] if known else "", "", name)


def _start(block: _Block) -> datetime | None:
    """Return the time of the first sample, UTC."""
    year, month, day, hour, minute = (block.integers[place] for place in (YEAR, MONTH, DAY, HOUR, MINUTE))
    return moment(year, month, day, hour, minute, float(block.reals[SECOND])) or moment_of(block.text[BEGUN])[0]


def _metadata(block: _Block) -> dict[str, object]:
    """Return what the header says of station and earthquake."""
    _, network, name = _station(block)
    metadata: dict[str, object] = {key: value for key, value in (("network", network), ("station_name", name)) if value}
    metadata |= {key: float(block.reals[place]) for key, place in PLACES.items() if block.reals[place] > UNTOLD_BELOW}
    magnitude = next((float(block.reals[place]) for place in MAGNITUDES if block.reals[place] > 0.0), None)
    metadata |= magnitude_in(block.text[HYPOCENTRE]) if magnitude is None else {"magnitude": magnitude}
    event = re.match(r"\s*Record of (.*?)\s+Earthquake of\b", block.text[RECORD], re.IGNORECASE)
    metadata |= {"event_name": event[1]} if event else {}
    origin, _ = moment_of(block.text[ORIGIN])
    metadata |= {"origin_time": origin} if origin else {}
    channel = re.search(r"Cha\w*:?\s*(\S+?):", block.text[CHANNEL])
    place = place_in(block.text[CHANNEL].partition("Location:")[2])
    metadata |= {"channels": {_direction(block)[0].code: channel[1]}} if channel else {}
    metadata |= {"place": place} if place else {}
    clock = next((word for word in re.findall(r"\b[A-Z]{3,4}\b", block.text[RECORD]) if word in CLOCKS), "UTC")
    return metadata | {"clock": clock}


def _doubts(code: str, block: _Block, dt: float) -> tuple[Doubt, ...]:
    """Return what the header says of the samples that is not so: peak and length of the record."""
    peak = re.search(r"Max\s*=\s*(-?[\d.]+)", block.text[PEAK], re.IGNORECASE)
    told = peak[1] if peak else ""
    found = doubts_of_peak(code, told, block.samples, _UNITS[block.integers[UNIT]][0], 2.0 * half_unit(told))
    size, length = block.samples.size, float(block.reals[LENGTH])
    if length > 0.0 and abs(length - size * dt) > 1.5 * dt + 0.05:
        what = said("the header tells a duration of {text} s, {count} samples take {seconds:g} s", text=f"{length:g}", count=size,
                    seconds=size * dt)  # fmt: skip
        found += (Doubt("count", what),)
    return found
