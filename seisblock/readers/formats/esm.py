"""ESM (Engineering Strong-Motion database) ASCII: one component, 64 header lines ``KEY: value``, one sample per line.

AFAD (Turkey) writes the same layout since about 2020: dates with slashes, the year or the day first, a peak without its sign, the place of
the station as LOCATION.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import datetime

from seisblock.core.errors import RecordFormatError
from seisblock.core.typing import FloatArray
from seisblock.readers._fixed_width import parse_sample_count
from seisblock.readers._header import drop_missing, parse_number, utc_datetime
from seisblock.readers._header_check import flag_duration, flag_peak_mismatch, half_last_digit, qc_flag
from seisblock.readers.channels import make_component, seed_file_set
from seisblock.readers.directions import Direction, parse_direction
from seisblock.readers.lines import line_error
from seisblock.readers.registry import FileSet, Format, register
from seisblock.readers.source import RawFile, decode_text
from seisblock.readers.table.headers import require_unit
from seisblock.readers.table.parse import parse_columns, to_si
from seisblock.records import QCFlag, Record

_KEY = re.compile(r"([A-Z][A-Z0-9_/^]*):(?:\s(.*))?\Z")
# 20230206011734_4615_mp_RawAcc_E.asc
_AFAD_NAME = re.compile(r"(?P<before>.*_(?:Raw)?Acc_)(?P<code>[NEUZ])(?P<after>\.asc)\Z", re.IGNORECASE)
_MAX_HEADER_LINES = 100
"""Number of lines searched for the end of the header (64 lines)."""

_MAX_LOCATION_CODE = 2
"""Letters of a SEED location code; a longer LOCATION is the place of the station."""

_TEXTS = {"event_name": "EVENT_NAME", "network": "NETWORK"}
_NUMBERS = {
    "event_latitude_deg": "EVENT_LATITUDE_DEGREE",
    "event_longitude_deg": "EVENT_LONGITUDE_DEGREE",
    "event_depth_km": "EVENT_DEPTH_KM",
    "station_latitude_deg": "STATION_LATITUDE_DEGREE",
    "station_longitude_deg": "STATION_LONGITUDE_DEGREE",
    "station_height_m": "STATION_ELEVATION_M",
    "epicentral_distance_km": "EPICENTRAL_DISTANCE_KM",
}
Header = dict[str, tuple[int, str]]
"""Line number and value by key."""


def is_esm(head: bytes) -> bool:
    """Return whether bytes begin an ESM ASCII header (EVENT_NAME, EVENT_ID)."""
    return re.match(rb"(?:\xef\xbb\xbf)?EVENT_NAME:[^\n]*\r?\nEVENT_ID:", head) is not None


def read_esm(blob: RawFile) -> Record:
    """Return the component in an ESM ASCII file.

    Notes
    -----
    Header peak and duration are checked against the samples (quality flags); a count that differs is an error, as are velocities,
    displacements and spectra.
    """
    lines = decode_text(blob).split("\n")
    header, body = _parse_header(blob.name, lines)
    kind = _get_value(blob.name, header, "DATA_TYPE")[1]
    if kind.upper() != "ACCELERATION":
        raise RecordFormatError("{name}: header states {what}: use the acceleration file (ACC)", name=blob.name, what=kind)
    line, unit_text = _get_value(blob.name, header, "UNITS")
    unit = require_unit(blob.name, line, unit_text)
    line, text = _get_value(blob.name, header, "SAMPLING_INTERVAL_S")
    dt = parse_number(text)
    if not dt or dt < 0:
        raise line_error("expected a sampling interval above 0 s, found {text!r}", blob.name, line, text=text)
    count = parse_sample_count(blob.name, *_get_value(blob.name, header, "NDATA"))
    (values,) = parse_columns(blob.name, lines[body:], body + 1, {unit_text: 0}, 1, None)
    if values.size != count:
        message = "{name}: header states {count} samples (NDATA), file contains {found}: file truncated or damaged"
        raise RecordFormatError(message, name=blob.name, count=count, found=values.size)
    stream = _get_value(blob.name, header, "STREAM")[1]
    direction = parse_direction(stream) or Direction(stream.upper() or "H1")
    component, history = make_component(direction, to_si(values, unit), stream)
    code, start = (_get_value(blob.name, header, key)[1] for key in ("STATION_CODE", "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS"))
    metadata = {"unit": unit, **_metadata(header)}
    metadata |= {"channels": {direction.code: stream.upper()}} if stream else {}
    flags = _qc_flags(direction.code, header, values, unit_text, dt)
    # the last sample has fewer decimals than the previous one and no line end
    last, previous = lines[-1].strip(), lines[-2].strip()
    if last and len(last.partition(".")[2]) < len(previous.partition(".")[2]):
        flags += (qc_flag("no line end after the last line: file probably truncated, last number incomplete", "cut"),)
    return Record(
        (component,), dt, code, _parse_time(start), source=blob.name, format=FORMAT.name, history=history, metadata=metadata, doubts=flags
    )


def _parse_header(name: str, lines: Sequence[str]) -> tuple[Header, int]:
    """Return the header and the index of the first sample line."""
    header: Header = {}
    for index, line in enumerate(lines[:_MAX_HEADER_LINES]):
        match = _KEY.match(line.strip("\ufeff\r "))
        if match is None:
            if parse_number(line) is None:
                raise line_error("expected 'KEY: value' or the first sample, found {text!r}", name, index + 1, text=line.strip()[:80])
            return header, index
        if match[1] in header:
            raise line_error("duplicate header entry {key}", name, index + 1, key=match[1])
        header[match[1]] = (index + 1, (match[2] or "").strip())
    raise RecordFormatError("{name}: no sample in the first {count} lines: file truncated or damaged", name=name, count=_MAX_HEADER_LINES)


def _get_value(name: str, header: Header, key: str) -> tuple[int, str]:
    """Return line number and value of a required key."""
    if key not in header:
        raise RecordFormatError("{name}: header entry {key} missing: file truncated or damaged", name=name, key=key)
    return header[key]


def _parse_time(text: str) -> datetime | None:
    """Return the UTC time of ``20190728_160919.870``, ``2023/02/06 01:17:07.365`` or ``06/02/2023 01:17:07.365``, or None."""
    text = re.sub(r"^(\d\d)/(\d\d)/(\d{4})", r"\3/\2/\1", text.strip())
    match = re.fullmatch(r"(\d{4})/?(\d\d)/?(\d\d)[_ ]?(\d\d):?(\d\d):?(\d\d(?:\.\d+)?)", text)
    if match is None:
        return None
    year, month, day, hour, minute = (int(part) for part in match.groups()[:5])
    return utc_datetime(year, month, day, hour, minute, float(match[6]))


def _metadata(header: Header) -> dict[str, object]:
    entries = {key: value for key, (_, value) in header.items()}
    location, place = entries.get("LOCATION", ""), entries.get("STATION_NAME", "")
    if len(location) > _MAX_LOCATION_CODE:
        location, place = "", place or location.replace("_", " ")
    origin_text = entries.get("EVENT_DATE_YYYYMMDD", "") + "_" + entries.get("EVENT_TIME_HHMMSS", "")
    # moment magnitude before local magnitude
    magnitudes = [parse_number(entries.get(key, "")) for key in ("MAGNITUDE_W", "MAGNITUDE_L")]
    return {"location": location} | drop_missing(
        {
            **{key: entries.get(label) for key, label in _TEXTS.items()},
            **{key: parse_number(entries.get(label, "")) for key, label in _NUMBERS.items()},
            "station_name": place,
            "origin_time": _parse_time(origin_text),
            "magnitude": magnitudes[1] if magnitudes[0] is None else magnitudes[0],
        }
    )


def _qc_flags(code: str, header: Header, values: FloatArray, unit: str, dt: float) -> tuple[QCFlag, ...]:
    """Return flags for peak and duration that differ from the header."""
    key = next((key for key in header if key.startswith("PGA_")), "PGA_CM/S^2")
    peak_text, duration = header.get(key, (0, ""))[1], header.get("DURATION_S", (0, ""))[1]
    signed = header.get("DATA_CREATOR", (0, ""))[1] != "AFAD"
    flags = flag_peak_mismatch(code, peak_text, values, unit, 2.0 * half_last_digit(peak_text), signed=signed)
    # some files leave the duration empty
    return flags + (flag_duration(duration, values.size, dt) if duration else ())


def _is_derived(head: bytes) -> bool:
    """Return whether an ESM ASCII file has velocities, displacements or spectra."""
    kind = re.search(rb"^DATA_TYPE:\s*([^\r\n]*)", head, re.MULTILINE) if is_esm(head) else None
    return kind is not None and kind[1].strip().upper() != b"ACCELERATION"


def _recording_key(head: bytes) -> object:
    text = head.decode("latin-1")
    keys = ("STATION_CODE", "LOCATION", "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS", "UNITS", "DATA_TYPE")
    return is_esm(head) and [re.findall(rf"^{key}:(.*)$", text, re.MULTILINE) for key in keys]


def _file_set(basename: str) -> FileSet | None:
    match = _AFAD_NAME.match(basename)
    return FileSet(f"{match['before']}?{match['after']}".lower(), 3, match["code"].upper()) if match else seed_file_set(basename)


FORMAT = register(
    Format(
        name="ESM",
        parse=read_esm,
        matches=is_esm,
        proves=("count", "peak", "unit", "sign", "instrument"),
        synchronous=True,
        is_derived=_is_derived,
        file_set=_file_set,
        recording_key=_recording_key,
    )
)
