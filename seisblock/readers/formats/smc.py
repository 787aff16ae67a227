"""SMC of the U.S. Geological Survey: one component in cm/s^2, corrected and even; integers and reals of the header at fixed places.

Seen in files: eleven lines of text, six of eight integers, ten of five reals, comments that begin with ``|``, then eight samples of ten
characters in a line. Uncorrected files hold pairs of time and acceleration; they, velocities, displacements and spectra are refused by
name.
"""

from __future__ import annotations

import re
from datetime import datetime, timedelta

from seisblock.errors import RecordFormatError
from seisblock.readers.cells import fail, to_si
from seisblock.readers.channels import turned
from seisblock.readers.directions import Direction, direction_of, towards
from seisblock.readers.fields import DOS_END, count_in, fields_of
from seisblock.readers.peaks import doubts_of_peak
from seisblock.readers.places import moment
from seisblock.readers.source import Blob, decode
from seisblock.records import Doubt, Record
from seisblock.typing import FloatArray
from seisblock.words import noted, said

FORMAT = "SMC"
_FIRST = re.compile(
    rb"[ ]*(?:[0-9][ ]+)?((?:UN)?CORRECTED ACCELEROGRAM|VELOCITY|DISPLACEMENT|RESPONSE SPECTR\w*|\*)[ ]*\r?\n", re.IGNORECASE
)
TEXT, INTEGERS, REALS = 11, 6, 10
"""Lines of each kind."""

_INTEGER, _REAL, _SAMPLE = (8, 10), (5, 15), (8, 10)
YEAR, DAY, HOUR, MINUTE, SECOND, MILLISECOND, VERTICAL, AZIMUTH, COMMENTS, SAMPLES = 1, 2, 3, 4, 5, 6, 12, 13, 15, 16
FLOOR, NUMBER = 24, 29
"""Places of the integers, from 0."""

RATE, EVENT_LATITUDE, EVENT_LONGITUDE, DEPTH, MAGNITUDES, LATITUDE, LONGITUDE, HEIGHT, DISTANCE, LARGEST, SMALLEST = (
    1,
    2,
    3,
    4,
    (5, 6, 7),
    10,
    11,
    12,
    16,
    29,
    31,
)
"""Places of the reals, from 0."""

UNTOLD = 1e38
"""Reals beyond this say nothing."""

_SLACK = 6e-5
"""Half a unit of the fifth digit, relatively: what samples are printed to."""

_REFUSED = {
    "UNCORRECTED ACCELEROGRAM": noted("an uncorrected accelerogram, whose samples are uneven: take the corrected file of the same record"),
    "VELOCITY": noted("a velocity: take the corrected accelerogram of the same record"),
    "DISPLACEMENT": noted("a displacement: take the corrected accelerogram of the same record"),
    "RESPONSE": noted("a response spectrum: take the corrected accelerogram of the same record"),
    "*": noted("a file that does not say what its samples are, as raw counts do: take the corrected accelerogram"),
}


def is_smc(head: bytes) -> bool:
    """Return whether a file's first bytes are those of an SMC file: its title, then a line with a star, then integers in columns."""
    if _FIRST.match(head) is None:
        return False
    lines = head.decode("latin-1").splitlines()
    return len(lines) > TEXT and lines[1].strip() == "*" and re.fullmatch(r"(?:\s*-?\d+){8}\s*", lines[TEXT]) is not None


def read_smc(blob: Blob) -> Record:
    """Return the one component in a corrected SMC file.

    Notes
    -----
    Start and sampling are those of the header; a file that tells no seconds begins at the full minute, and its times are those of the
    trigger. The header's largest and smallest sample are compared with the file's: a difference is a doubt.
    """
    lines = decode(blob).replace(DOS_END, "").split("\n")
    name = blob.name
    _refuse_others(name, lines[0])
    told = fields_of(name, lines, TEXT, 8 * INTEGERS, _INTEGER)
    integers = [int(value) for value in told]
    untold = integers[0]
    reals = fields_of(name, lines, TEXT + INTEGERS, 5 * REALS, _REAL)
    first = TEXT + INTEGERS + REALS + max(integers[COMMENTS], 0)
    for index in range(TEXT + INTEGERS + REALS, first):
        if not lines[index : index + 1] or not lines[index].startswith("|"):
            fail(name, index + 1, said("expected one of {count} comments that begin with |", count=integers[COMMENTS]))
    rate = float(reals[RATE])
    if not 0.0 < rate < UNTOLD:
        fail(name, TEXT + INTEGERS + 1, said("expected samples per second, found {rate:g}: the samples may be uneven", rate=rate))
    count = count_in(name, TEXT + 3, str(integers[SAMPLES]))
    gal = fields_of(name, lines, first, count, _SAMPLE)
    after = first + -(-count // 8)
    if any(line.strip() for line in lines[after:]):
        fail(name, after + 1, said("expected the end after {count} samples, found {text!r}", count=count, text=lines[after].strip()[:40]))
    direction, written = _direction(lines, integers, untold)
    component, history = turned(direction, to_si(gal, "gal"), written)
    return Record(
        (component,),
        1.0 / rate,
        station=_station(lines, integers, untold),
        start=_start(integers, untold),
        source=name,
        format=FORMAT,
        history=history,
        metadata=_metadata(lines, integers, reals),
        doubts=_doubts(direction.code, reals, gal),
    )


def _refuse_others(name: str, title: str) -> None:
    """Refuse what is no corrected accelerogram, by what its title says it is."""
    match = _FIRST.match(title.encode("latin-1", "replace") + b"\n")
    kind = match[1].decode("latin-1").upper() if match else "*"
    found = next((what for word, what in _REFUSED.items() if kind.startswith(word)), None)
    if found is not None:
        raise RecordFormatError("{name}: this SMC file holds {what}", name=name, what=said(found))


def _direction(lines: list[str], integers: list[int], untold: int) -> tuple[Direction, str]:
    """Return the direction of the component, and its name in the text: upright sensors by their angle from the vertical."""
    written = lines[5].partition("component")[2].lstrip("= ").strip()
    if integers[VERTICAL] in (0, 180):
        return Direction("UD", sign=1.0 if integers[VERTICAL] == 0 else -1.0), written
    if integers[AZIMUTH] != untold and 0 <= integers[AZIMUTH] <= 360:
        return towards(float(integers[AZIMUTH])), written
    return direction_of(written) or Direction("H1"), written


def _station(lines: list[str], integers: list[int], untold: int) -> str:
    """Return the number of the station, else the code in the text, and the floor of a building."""
    code = lines[2].strip("* \0") if integers[NUMBER] in (untold, 0) else str(integers[NUMBER])
    return code if integers[FLOOR] == untold else f"{code} floor {integers[FLOOR]}"


def _start(integers: list[int], untold: int) -> datetime | None:
    """Return the time of the first sample, UTC, as far as the integers tell it."""
    year, day, hour, minute = (integers[place] for place in (YEAR, DAY, HOUR, MINUTE))
    second, millisecond = (0 if integers[place] == untold else integers[place] for place in (SECOND, MILLISECOND))
    begun = moment(year, 1, 1, hour, minute, second + millisecond / 1000.0)
    return begun + timedelta(days=day - 1) if begun is not None and 1 <= day <= 366 else None


def _metadata(lines: list[str], integers: list[int], reals: FloatArray) -> dict[str, object]:
    """Return what the header says of station and earthquake."""
    metadata: dict[str, object] = {"unit": "gal"}
    station = re.search(r"station\s*=\s*(.*?)\s*(?:component\b|\Z)", lines[5], re.IGNORECASE)
    if station and station[1]:
        metadata["station_name"] = station[1].rstrip(", ")
    event = re.match(r"\s*(\d{4})\s+(\d{1,2})\s+(\d{1,2})\s+(\d{2})(\d{2})\s*(.*)", lines[3])
    if event:
        year, month, day, hour, minute = (int(part) for part in event.groups()[:5])
        origin = moment(year, month, day, hour, minute, 0.0)
        metadata |= {"origin_time": origin} if origin else {}
        metadata |= {"event_name": event[6].strip()} if event[6].strip() else {}
    told = {
        "event_latitude_deg": EVENT_LATITUDE,
        "event_longitude_deg": EVENT_LONGITUDE,
        "event_depth_km": DEPTH,
        "station_latitude_deg": LATITUDE,
        "station_longitude_deg": LONGITUDE,
        "station_height_m": HEIGHT,
        "epicentral_distance_km": DISTANCE,
    }
    metadata |= {key: float(reals[place]) for key, place in told.items() if abs(reals[place]) < UNTOLD}
    magnitude = next((float(reals[place]) for place in MAGNITUDES if abs(reals[place]) < UNTOLD), None)
    return metadata if magnitude is None else metadata | {"magnitude": magnitude}


def _doubts(code: str, reals: FloatArray, gal: FloatArray) -> tuple[Doubt, ...]:
    """Return what speaks against the samples: the header's own peak."""
    peak = max((float(reals[place]) for place in (LARGEST, SMALLEST)), key=lambda value: abs(value) if abs(value) < UNTOLD else -1.0)
    told = repr(peak) if abs(peak) < UNTOLD else ""
    return doubts_of_peak(code, told, gal, "gal", _SLACK * min(abs(peak), UNTOLD))
