"""SMC (U.S. Geological Survey): one component in cm/s^2, corrected or uncorrected.

Layout found in files: 11 lines of text, 6 of eight integers, 10 of five reals, comments that begin with ``|``, then eight samples of ten
characters per line. Uncorrected files of film records (no rate, pairs of time and acceleration), velocities, displacements and spectra
raise an error that names them.
"""

from __future__ import annotations

import re
from datetime import datetime, timedelta

from seisblock.core.errors import RecordFormatError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.readers._fixed_width import parse_fixed_width, parse_sample_count
from seisblock.readers._header import drop_missing, search_group, utc_datetime
from seisblock.readers._header_check import flag_peak_mismatch
from seisblock.readers.channels import make_component, seed_file_set
from seisblock.readers.directions import Direction, direction_from_azimuth, parse_direction
from seisblock.readers.lines import DOS_EOF, line_error
from seisblock.readers.registry import FileSet, Format, register
from seisblock.readers.source import RawFile, decode_text
from seisblock.readers.table.parse import to_si
from seisblock.records import QCFlag, Record

_TITLE_LINE = re.compile(
    rb"[ ]*(?:[0-9][ ]+)?((?:UN)?CORRECTED ACCELEROGRAM|VELOCITY|DISPLACEMENT|RESPONSE SPECTR\w*|\*)[ ]*\r?\n", re.IGNORECASE
)
TEXT, INTEGERS, REALS = 11, 6, 10
"""Lines of text, integers and reals."""

_FILE_NAME = re.compile(r"(?P<before>.*\d)(?P<code>[A-Z])(?P<after>(?:_[ACPU])?\.SMC)\Z", re.IGNORECASE)
_INTEGER, _REAL, _SAMPLE = (8, 10), (5, 15), (8, 10)
YEAR, DAY, HOUR, MINUTE, SECOND, MILLISECOND, VERTICAL, AZIMUTH, COMMENTS, SAMPLES = 1, 2, 3, 4, 5, 6, 12, 13, 15, 16
FLOOR, NUMBER = 24, 29
"""Indices of the integers, from 0."""

RATE, MAGNITUDES, LARGEST, SMALLEST = 1, (5, 6, 7), 29, 31
REAL_INDICES = {
    "event_latitude_deg": 2,
    "event_longitude_deg": 3,
    "event_depth_km": 4,
    "station_latitude_deg": 10,
    "station_longitude_deg": 11,
    "station_height_m": 12,
    "epicentral_distance_km": 16,
}
"""Indices of the reals, from 0."""

MISSING = 1e38
"""Reals above this are missing."""

_SAMPLE_TOLERANCE = 6e-5
"""Half a unit of the fifth digit, the printed precision of samples, relative."""

_UNEVEN = N_("an uncorrected, unevenly sampled accelerogram: use the corrected file of the same record")

_UNSUPPORTED = {
    "VELOCITY": N_("velocity: use the corrected accelerogram of the same record"),
    "DISPLACEMENT": N_("displacement: use the corrected accelerogram of the same record"),
    "RESPONSE": N_("a response spectrum: use the corrected accelerogram of the same record"),
    "*": N_("samples of unknown quantity (for example raw counts): use the corrected accelerogram"),
}


def is_smc(head: bytes) -> bool:
    """Return whether bytes begin an SMC file: title, line with a star, fixed-width integers."""
    if _TITLE_LINE.match(head) is None:
        return False
    lines = head.decode("latin-1").splitlines()
    return len(lines) > TEXT and lines[1].strip() == "*" and re.fullmatch(r"(?:\s*-?\d+){8}\s*", lines[TEXT]) is not None


def _is_derived(head: bytes) -> bool:
    """Return whether an SMC file has velocities, displacements or spectra."""
    title = _TITLE_LINE.match(head)
    return title is not None and title[1].upper().startswith((b"VELOCITY", b"DISPLACEMENT", b"RESPONSE"))


def read_smc(blob: RawFile) -> Record:
    """Return the component in an SMC file.

    Notes
    -----
    Start and sampling rate are from the header; without seconds, the start is the full minute of the trigger. The largest and smallest
    sample in the header are checked against the samples.
    """
    lines = decode_text(blob).replace(DOS_EOF, "").split("\n")
    name = blob.name
    _check_title(name, lines[0])
    integer_values, _ = parse_fixed_width(name, lines, TEXT, 8 * INTEGERS, _INTEGER)
    integers = [int(value) for value in integer_values]
    # the first integer is the one that marks missing integers
    missing_value = integers[0]
    reals, _ = parse_fixed_width(name, lines, TEXT + INTEGERS, 5 * REALS, _REAL)
    first = TEXT + INTEGERS + REALS + max(integers[COMMENTS], 0)
    for index in range(TEXT + INTEGERS + REALS, first):
        if not lines[index : index + 1] or not lines[index].startswith("|"):
            raise line_error("expected one of {count} comment lines beginning with |", name, index + 1, count=integers[COMMENTS])
    rate, is_uncorrected = float(reals[RATE]), "UNCORRECTED" in lines[0].upper()
    if is_uncorrected and rate >= MISSING:
        raise RecordFormatError("{name}: the SMC file contains {what}", name=name, what=lazy_gettext(_UNEVEN))
    if not 0.0 < rate < MISSING:
        message = "expected the number of samples per second, found {rate:g}: samples may be uneven"
        raise line_error(message, name, TEXT + INTEGERS + 1, rate=rate)
    count = parse_sample_count(name, TEXT + 3, str(integers[SAMPLES]))
    gal, end_line = parse_fixed_width(name, lines, first, count, _SAMPLE)
    if any(line.strip() for line in lines[end_line:]):
        message = "expected the end of the file after {count} samples, found {text!r}"
        raise line_error(message, name, end_line + 1, count=count, text=lines[end_line].strip()[:40])
    direction, direction_name = _parse_direction(lines, integers, missing_value)
    component, history = make_component(direction, to_si(gal, "gal"), direction_name)
    code, start = _station_code(lines, integers, missing_value), _start_time(integers, missing_value)
    metadata, flags = _metadata(lines, reals, is_uncorrected=is_uncorrected), _qc_flags(direction.code, reals, gal)
    return Record((component,), 1.0 / rate, code, start, source=name, format=FORMAT.name, history=history, metadata=metadata, doubts=flags)


def _check_title(name: str, title: str) -> None:
    """Raise unless the title is that of an accelerogram."""
    match = _TITLE_LINE.match(title.encode("latin-1", "replace") + b"\n")
    kind = match[1].decode("latin-1").upper() if match else "*"
    reason = next((reason_text for word, reason_text in _UNSUPPORTED.items() if kind.startswith(word)), None)
    if reason is not None:
        raise RecordFormatError("{name}: the SMC file contains {what}", name=name, what=lazy_gettext(reason))


def _parse_direction(lines: list[str], integers: list[int], missing_value: int) -> tuple[Direction, str]:
    """Return direction and name of the component; vertical sensors by their angle from the vertical."""
    direction_name = lines[5].partition("component")[2].lstrip("= ").strip()
    # angle from the vertical: 0 up, 180 down
    if integers[VERTICAL] in (0, 180):
        return Direction("UD", sign=1.0 if integers[VERTICAL] == 0 else -1.0), direction_name
    if integers[AZIMUTH] != missing_value and 0 <= integers[AZIMUTH] <= 360:
        return direction_from_azimuth(float(integers[AZIMUTH])), direction_name
    return parse_direction(direction_name) or Direction("H1"), direction_name


def _station_code(lines: list[str], integers: list[int], missing_value: int) -> str:
    """Return the station number, else the code in the text, with the floor in a building."""
    code = lines[2].strip("* \0") if integers[NUMBER] in (missing_value, 0) else str(integers[NUMBER])
    return code if integers[FLOOR] == missing_value else f"{code} floor {integers[FLOOR]}"


def _start_time(integers: list[int], missing_value: int) -> datetime | None:
    year, day, hour, minute = (integers[place] for place in (YEAR, DAY, HOUR, MINUTE))
    second, millisecond = (0 if integers[place] == missing_value else integers[place] for place in (SECOND, MILLISECOND))
    # the header counts the days of the year
    start = utc_datetime(year, 1, 1, hour, minute, second + millisecond / 1000.0)
    return start + timedelta(days=day - 1) if start is not None and 1 <= day <= 366 else None


def _metadata(lines: list[str], reals: FloatArray, *, is_uncorrected: bool) -> dict[str, object]:
    origin, event = None, re.match(r"\s*(\d{4})\s+(\d{1,2})\s+(\d{1,2})\s+(\d{2})(\d{2})\s*(.*)", lines[3])
    if event:
        year, month, day, hour, minute = (int(part) for part in event.groups()[:5])
        origin = utc_datetime(year, month, day, hour, minute, 0.0)
    return drop_missing(
        {
            "unit": "gal",
            "volume": "V1" if is_uncorrected else "V2",
            "station_name": search_group(r"station\s*=\s*(.*?)\s*(?:component\b|\Z)", lines[5]).rstrip(", "),
            "origin_time": origin,
            "event_name": event[6].strip() if event else "",
            **{key: float(reals[place]) for key, place in REAL_INDICES.items() if abs(reals[place]) < MISSING},
            "magnitude": next((float(reals[place]) for place in MAGNITUDES if abs(reals[place]) < MISSING), None),
        }
    )


def _qc_flags(code: str, reals: FloatArray, gal: FloatArray) -> tuple[QCFlag, ...]:
    """Return a flag if the peak differs from the header."""
    # a missing extreme ranks below any other
    peak = max((float(reals[place]) for place in (LARGEST, SMALLEST)), key=lambda value: abs(value) if abs(value) < MISSING else -1.0)
    peak_text = repr(peak) if abs(peak) < MISSING else ""
    return flag_peak_mismatch(code, peak_text, gal, "gal", _SAMPLE_TOLERANCE * min(abs(peak), MISSING))


def smc_file_set(basename: str) -> FileSet | None:
    """Return the file set of a station from a file name: the letter behind the number, or that of a SEED code, is the component.

    Examples
    --------
    >>> smc_file_set("0111a.smc"), smc_file_set("np01002p_4225b_a.smc").key, smc_file_set("CE36456.V2")
    (FileSet(key='0111?.smc', size=3, component='a', level=''), 'np01002p_4225?_a.smc', None)
    """
    match = _FILE_NAME.match(basename)
    return FileSet(f"{match['before']}?{match['after']}".lower(), 3, match["code"]) if match else seed_file_set(basename)


def _recording_key(head: bytes) -> object:
    lines = head.decode("latin-1").splitlines()
    if not is_smc(head):
        return None
    # title, event, station, and start among the integers
    return lines[0].strip(), lines[3].split(), lines[5].lower().partition("component")[0].split(), lines[TEXT].split()[1:7]


FORMAT = register(
    Format(
        name="SMC",
        parse=read_smc,
        matches=is_smc,
        is_derived=_is_derived,
        proves=("count", "peak", "unit", "sign", "instrument"),
        synchronous=True,
        file_set=smc_file_set,
        recording_key=_recording_key,
    )
)
