"""ASCII of the Engineering Strong-Motion database (ESM): one component, 64 lines ``KEY: value``, then a sample in each line."""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import datetime

from seisblock.errors import RecordFormatError, UnitError
from seisblock.readers.cells import columns_of, fail, to_si
from seisblock.readers.channels import turned
from seisblock.readers.directions import Direction, direction_of
from seisblock.readers.fields import count_in
from seisblock.readers.header import number
from seisblock.readers.naming import normal_unit
from seisblock.readers.peaks import doubts_of_peak, half_unit
from seisblock.readers.places import moment
from seisblock.readers.source import Blob, decode
from seisblock.records import Doubt, Record
from seisblock.typing import FloatArray
from seisblock.words import said

FORMAT = "ESM"
_KEY = re.compile(r"([A-Z][A-Z0-9_/^]*):(?:\s(.*))?\Z")
_MOST = 100
"""Lines of a header, of which there are 64."""

_SECONDS = 1.5
"""How many intervals the header's duration may lie from the count."""

Header = dict[str, tuple[int, str]]
"""Of each key the number of its line, and its value."""


def is_esm(head: bytes) -> bool:
    """Return whether a file's first bytes are those of ESM's ASCII: the event's name, then its identifier, each behind its key."""
    return re.match(rb"(?:\xef\xbb\xbf)?EVENT_NAME:[^\n]*\r?\nEVENT_ID:", head) is not None


def read_esm(blob: Blob) -> Record:
    """Return the one component in an ASCII file of ESM.

    Notes
    -----
    Count, peak, time of the peak and duration are the header's own; where the samples differ it is doubted, and a file that ends before
    its count is refused. Velocities, displacements and spectra are refused by what they say they are.
    """
    lines = decode(blob).split("\n")
    header, body = _header(blob.name, lines)
    kind = _value(blob.name, header, "DATA_TYPE")[1]
    if kind.upper() != "ACCELERATION":
        raise RecordFormatError("{name} holds {what} by its own header: take the file of accelerations (ACC)", name=blob.name, what=kind)
    line, written = _value(blob.name, header, "UNITS")
    unit = normal_unit(written)
    if unit is None:
        raise UnitError("{name}, line {line}: unknown unit of acceleration {text!r}", name=blob.name, line=line, text=written)
    line, text = _value(blob.name, header, "SAMPLING_INTERVAL_S")
    dt = number(text)
    if not dt or dt < 0:
        fail(blob.name, line, said("expected a sampling interval above 0 s, found {text!r}", text=text))
    count = count_in(blob.name, *_value(blob.name, header, "NDATA"))
    (values,) = columns_of(blob.name, lines[body:], body + 1, {written: 0}, 1, None)
    if values.size != count:
        raise RecordFormatError(
            "{name}: its header promises {count} samples (NDATA), it holds {found}: it is cut or damaged",
            name=blob.name,
            count=count,
            found=values.size,
        )
    stream = _value(blob.name, header, "STREAM")[1]
    direction = direction_of(stream) or Direction(stream.upper() or "H1")
    component, history = turned(direction, to_si(values, unit), stream)
    return Record(
        (component,),
        dt,
        station=_value(blob.name, header, "STATION_CODE")[1],
        start=_time(_value(blob.name, header, "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS")[1]),
        source=blob.name,
        format=FORMAT,
        history=history,
        metadata={"unit": unit, **_metadata(header)},
        doubts=_doubts(direction.code, header, values, written, dt) + _doubts_of_end(lines),
    )


def _header(name: str, lines: Sequence[str]) -> tuple[Header, int]:
    """Return the keys of the header, and the index of the first sample."""
    header: Header = {}
    for index, line in enumerate(lines[:_MOST]):
        match = _KEY.match(line.strip("\ufeff\r "))
        if match is None:
            if number(line) is None:
                fail(name, index + 1, said("expected KEY: value, or the first sample, found {text!r}", text=line.strip()[:80]))
            return header, index
        if match[1] in header:
            fail(name, index + 1, said("the header tells {key} twice", key=match[1]))
        header[match[1]] = (index + 1, (match[2] or "").strip())
    raise RecordFormatError("{name}: no sample among the first {count} lines: it is cut or damaged", name=name, count=_MOST)


def _value(name: str, header: Header, key: str) -> tuple[int, str]:
    """Return the line and the value of a key."""
    if key not in header:
        raise RecordFormatError("{name}: its header has no {key}: it is cut or damaged", name=name, key=key)
    return header[key]


def _time(text: str) -> datetime | None:
    """Return the UTC time of ``20190728_160919.870``, None where it is none."""
    match = re.fullmatch(r"(\d{4})(\d\d)(\d\d)_?(\d\d)(\d\d)(\d\d(?:\.\d+)?)", text.strip())
    if match is None:
        return None
    year, month, day, hour, minute = (int(part) for part in match.groups()[:5])
    return moment(year, month, day, hour, minute, float(match[6]))


def _metadata(header: Header) -> dict[str, object]:
    """Return what the header says of station and earthquake."""

    def told(key: str) -> str:
        return header.get(key, (0, ""))[1]

    metadata: dict[str, object] = {}
    names = {"station_name": "STATION_NAME", "event_name": "EVENT_NAME", "network": "NETWORK"}
    metadata |= {key: told(label) for key, label in names.items() if told(label)}
    numbers = {
        "event_latitude_deg": "EVENT_LATITUDE_DEGREE",
        "event_longitude_deg": "EVENT_LONGITUDE_DEGREE",
        "event_depth_km": "EVENT_DEPTH_KM",
        "station_latitude_deg": "STATION_LATITUDE_DEGREE",
        "station_longitude_deg": "STATION_LONGITUDE_DEGREE",
        "station_height_m": "STATION_ELEVATION_M",
        "epicentral_distance_km": "EPICENTRAL_DISTANCE_KM",
    }
    metadata |= {key: value for key, label in numbers.items() if (value := number(told(label))) is not None}
    magnitude = next((value for key in ("MAGNITUDE_W", "MAGNITUDE_L") if (value := number(told(key))) is not None), None)
    origin = _time(told("EVENT_DATE_YYYYMMDD") + "_" + told("EVENT_TIME_HHMMSS"))
    metadata |= {"origin_time": origin} if origin else {}
    return metadata if magnitude is None else metadata | {"magnitude": magnitude}


def _doubts(code: str, header: Header, values: FloatArray, unit: str, dt: float) -> tuple[Doubt, ...]:
    """Return what the header says of the samples that is not so: the peak, and the duration."""
    key = next((key for key in header if key.startswith("PGA_")), "PGA_CM/S^2")
    told = header.get(key, (0, ""))[1]
    found = doubts_of_peak(code, told, values, unit, 2.0 * half_unit(told))
    text = header.get("DURATION_S", (0, ""))[1]
    duration = number(text)
    if duration is None or abs(duration - values.size * dt) > _SECONDS * dt + half_unit(text):
        found += (
            Doubt("count", said("the header tells a duration of {text} s, {count} samples take {seconds:g} s", text=text[:20] or "-",
                                count=values.size, seconds=values.size * dt)),
        )  # fmt: skip
    return found


def _doubts_of_end(lines: Sequence[str]) -> tuple[Doubt, ...]:
    """Return a doubt about a file whose last sample has fewer decimals than the one before and no end of line."""
    last = lines[-1].strip()
    if not last or len(last.partition(".")[2]) >= len(lines[-2].strip().partition(".")[2]):
        return ()
    return (Doubt("cut", said("the last line has no end: the file looks cut, and its last number with it")),)
