"""USC (University of Southern California), volumes 1 and 2: one component per file.

Layout found in files: volume 1 has 13 lines of text, 7 of integers and 7 of reals, then pairs of time, s, and acceleration, g/10, in some
files behind a blank column. Volume 2
has 25, 7 and 13, then a line with count, interval and unit above the samples, also of velocities and displacements, which are skipped.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from datetime import datetime

from seisblock.core.typing import FloatArray
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.readers._fixed_width import parse_fixed_width, parse_sample_count
from seisblock.readers._header import drop_missing, parse_coordinates, parse_number, search_group, utc_datetime
from seisblock.readers._header_check import flag_count, flag_duration, flag_peak_mismatch, half_last_digit, qc_flag
from seisblock.readers.channels import make_component
from seisblock.readers.directions import Direction, parse_direction
from seisblock.readers.lines import line_error, read_trimmed_lines
from seisblock.readers.registry import FileSet, Format, register
from seisblock.readers.source import RawFile
from seisblock.readers.table.headers import require_unit
from seisblock.readers.table.parse import to_si
from seisblock.readers.uneven import resample_pairs
from seisblock.records import Component, QCFlag, Record
from seisblock.records.qc import check_recorded

_HEADERS = {1: 13 + 7 + 7, 2: 25 + 7 + 13}
_TITLES = {
    1: re.compile(rb"[ ]*FILE\s+\d+ OF UNCORRECTED", re.IGNORECASE),
    2: re.compile(rb"[ ]*CORRECTED ACCELEROGRAM[^\n]*\n[ ]*FILE\s+\d+ OF UNCORRECTED", re.IGNORECASE),
}
_SECTION = re.compile(r"\s*(\d+)\s+POINTS OF ACC\w* DATA EQUALLY SPACED AT\s+([\d.]+)\s*SEC\.?(?:\s+IN UNITS\s+(\S+))?", re.IGNORECASE)
_FURTHER_SECTION = re.compile(r"\s*(\d+)\s+POINTS OF ([A-Z]+)\w* DATA EQUALLY SPACED", re.IGNORECASE)
_SAMPLE_FORM = (8, 10)
PAIRS_PER_LINE = 5
TIME_RESOLUTION_S = 1e-3
_MONTHS = ("JAN", "FEB", "MAR", "APR", "MAY", "JUN", "JUL", "AUG", "SEP", "OCT", "NOV", "DEC")
_NAME = re.compile(r"(?P<before>.+\.[A-Z]\d)(?P<code>[A-C])\Z", re.IGNORECASE)


def is_usc(head: bytes) -> bool:
    """Return whether bytes begin a USC file of volume 1 or 2."""
    return any(title.match(head) for title in _TITLES.values())


def read_usc(blob: RawFile) -> Record:
    """Return the component in a USC file; count, duration and, in volume 2, the peak of the header are checked against the samples.

    Notes
    -----
    Uneven samples of volume 1 are interpolated linearly at 1 ms, the printed resolution of their times, which keeps every value.
    """
    lines = read_trimmed_lines(blob)
    volume = 1 if _TITLES[1].match(blob.content[:200]) else 2
    text = " \n".join(lines[: _HEADERS[volume]])
    read_samples = _read_pairs if volume == 1 else _read_even
    name = search_group(r"(?m)^COMP\s+(\S+)", "\n".join(lines[5:9])) or search_group(r"\bCOMP\s+(\S+)", text)
    direction = parse_direction(name) or Direction(name.upper() or "H1")
    start_s, dt, values, history, flags = read_samples(blob.name, lines, text, direction.code)
    component, notes = make_component(direction, values, name)
    latitude, longitude = parse_coordinates(search_group(r"STATION USC#[^\n]*?(\d.*)", text).partition(" ")[2])
    event_latitude, event_longitude = parse_coordinates(search_group(r"EPICENTER\s*-?([^\n]*)", text))
    number = search_group(r"STATION USC#\s*(\d+)", text)
    line = 5 if volume == 1 else 6
    metadata = {
        "volume": f"V{volume}",
        "station_name": re.sub(r"\s+\d+\s*$", "", lines[line]).strip(),
        "station_latitude_deg": latitude,
        "station_longitude_deg": longitude,
        "event_latitude_deg": event_latitude,
        "event_longitude_deg": event_longitude,
        "magnitude": parse_number(search_group(r"MAGNITUDE\s*=\s*([\d.]+)", text)),
        "event_name": re.sub(r"\s+\d+\s*$", "", lines[line - 4]).strip(),
        "origin_time": _origin(text),
        # the file has no start time
        "event": " ".join(f"{lines[line - 4]} {lines[line - 3]}".split()),
        "first_time_s": start_s or None,
        "interpolated": bool(history) or None,
    }
    return Record(
        (component,),
        dt,
        station=number,
        source=blob.name,
        format=FORMAT.name,
        history=(*history, *notes),
        metadata=drop_missing(metadata),
        doubts=flags,
    )


_Samples = tuple[float, float, FloatArray, tuple[str, ...], tuple[QCFlag, ...]]


def _read_pairs(name: str, lines: Sequence[str], text: str, code: str) -> _Samples:
    """Return start, interval, samples, history and flags of volume 1."""
    first = _HEADERS[1]
    if "G/10" not in text.upper():
        raise line_error("expected samples in g/10, found {text!r}", name, 12, text=lines[11].strip()[:40] if len(lines) > 11 else "")
    count = parse_sample_count(name, 11, search_group(r"NO\. OF POINTS\s*=\s*(\d+)", text))
    length = len(lines[first].rstrip()) if len(lines) > first else 0
    width = max(round(length / (2 * PAIRS_PER_LINE)), 1)
    if length == 2 * PAIRS_PER_LINE * width + 1:
        # a column for the control of printers
        lines = [*lines[:first], *(line[1:] if line.startswith(" ") else line for line in lines[first:])]
    numbers, _ = parse_fixed_width(name, lines, first, 2 * count, (2 * PAIRS_PER_LINE, width))
    start, dt, (tenths,), history = resample_pairs(name, numbers[::2], [numbers[1::2]], TIME_RESOLUTION_S)
    duration = search_group(r"DURATION\s*=\s*([\d.]+)", text)
    flags = flag_duration(duration, tenths.size, dt, 2.0 * TIME_RESOLUTION_S + 1.5 * float(numbers[2] - numbers[0]))
    if history:
        recorded = Component(code, numbers[1::2] * (0.1 * STANDARD_GRAVITY))
        flags += check_recorded(recorded, float(numbers[-2] - numbers[0]) / (count - 1))
    return start, dt, tenths * (0.1 * STANDARD_GRAVITY), history, flags


def _read_even(name: str, lines: Sequence[str], text: str, code: str) -> _Samples:
    """Return start, interval, samples, history and flags of volume 2."""
    first = _HEADERS[2]
    match = _SECTION.match(lines[first]) if len(lines) > first else None
    if match is None:
        line_text = lines[first].strip()[:80] if len(lines) > first else ""
        raise line_error("expected a line with count, interval and unit of the samples, found {text!r}", name, first + 1, text=line_text)
    count, dt, unit = parse_sample_count(name, first + 1, match[1]), parse_number(match[2]), _sample_unit(name, first + 1, match[3], text)
    if not dt:
        raise line_error("expected a sampling interval above 0 s, found {text!r}", name, first + 1, text=match[2])
    values, end = parse_fixed_width(name, lines, first + 1, count, _SAMPLE_FORM)
    peak = search_group(r"PEAK ACCELERATION\s*=\s*(-?[\d.]+)", text)
    slack = half_last_digit(f"{values[0]:.3f}") + half_last_digit(peak)
    # the sign of the header is not that of the samples in all files
    flags = flag_peak_mismatch(code, peak, values, unit, slack, signed=False)
    flags += flag_count(int(search_group(r"(\d+)\s+INSTRUMENT AND BASELINE", text) or count), count)
    return 0.0, dt, to_si(values, unit), (), (*flags, *_flag_sections(lines[end:]))


def _flag_sections(lines: Sequence[str]) -> Iterator[QCFlag]:
    """Yield a flag for each list of velocities or displacements whose length is not that of its count."""
    begins = [(index, match) for index, line in enumerate(lines) if (match := _FURTHER_SECTION.match(line))]
    # some files end with the accelerations
    ends = [*(index for index, _ in begins), len(lines)][1:]
    for (begin, match), end in zip(begins, ends, strict=True):
        count, length = int(match[1][:9]), sum(len(line.rstrip()) for line in lines[begin + 1 : end])
        if length != count * _SAMPLE_FORM[1]:
            message = "{quantity} data after the accelerations: {count} numbers stated, {found:.4g} found; file damaged or truncated"
            yield qc_flag(message, "count", quantity=match[2].upper(), count=count, found=length / _SAMPLE_FORM[1])


def _sample_unit(name: str, line: int, unit: str | None, text: str) -> str:
    """Return the unit of the samples, in older files only stated with the peak: ``CMS/SEC/SEC``."""
    peak_unit = search_group(r"PEAK ACCELERATION\s*=\s*-?[\d.]+\s+(\S+)", text).upper().replace("CMS/", "CM/")
    return require_unit(name, line, unit or peak_unit)


def _origin(text: str) -> datetime | None:
    match = re.search(r"\b([A-Z]{3})\s+(\d{1,2}),\s*(\d{4})\s*-?\s*(\d{2})(\d{2})\s*GMT", text)
    if match is None or match[1] not in _MONTHS:
        return None
    return utc_datetime(int(match[3]), _MONTHS.index(match[1]) + 1, int(match[2]), int(match[4]), int(match[5]), 0.0)


def usc_file_set(basename: str) -> FileSet | None:
    """Return the file set of a USC file, whose last letter is the component.

    Examples
    --------
    >>> usc_file_set("017m30bt.s0a").key, usc_file_set("record.csv")
    ('017m30bt.s0?', None)
    """
    match = _NAME.match(basename)
    return match and FileSet(f"{match['before']}?".lower(), 3, match["code"].lower())


def _recording_key(head: bytes) -> object:
    lines = head.decode("latin-1").splitlines()
    shift = 0 if _TITLES[1].match(head) else 1
    return is_usc(head) and [" ".join(line.split()[:6]) for line in lines[1 + shift : 6 + shift]]


FORMAT = register(
    Format(
        name="USC",
        title="USC",
        parse=read_usc,
        matches=is_usc,
        proves=("count", "peak", "unit", "sign", "instrument"),
        synchronous=True,
        file_set=usc_file_set,
        recording_key=_recording_key,
    )
)
