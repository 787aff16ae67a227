"""CSMIP (California), volumes 1 and 2: all channels of a station in one file.

Layout found in files: volume 1 has 13 lines of text, 7 of integers and 7 of reals, volume 2 has 25, 7 and 13; then a line with count,
interval, unit and format of the samples below it, in volume 2 also for velocities and displacements, which are skipped; then an end mark.
Volume 1 of film records is pairs of time and acceleration: read as they are if even, else interpolated at 1 ms. Volume 3 (spectra)
raises an error that names it.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from datetime import UTC, datetime
from typing import NamedTuple

from seisblock.core.errors import RecordFormatError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.readers._fixed_width import parse_fixed_width, parse_fortran_format, parse_sample_count
from seisblock.readers._header import drop_missing, parse_coordinates, parse_datetime, parse_magnitude, parse_number, search_group
from seisblock.readers._header_check import flag_count, flag_duration, flag_peak_mismatch, half_last_digit, qc_flag
from seisblock.readers.channels import make_component, parse_blocks, parse_location, split_by_location
from seisblock.readers.directions import Direction, parse_direction
from seisblock.readers.lines import line_error, read_trimmed_lines
from seisblock.readers.registry import Format, register
from seisblock.readers.source import RawFile
from seisblock.readers.table.headers import require_unit
from seisblock.readers.table.parse import to_si
from seisblock.readers.uneven import resample_pairs
from seisblock.records import Component, QCFlag, Record
from seisblock.records.qc import check_recorded
from seisblock.records.site import UTC_OFFSETS

_HEADERS = {1: 13 + 7 + 7, 2: 25 + 7 + 13}
"""Header lines above the samples of a channel, by volume."""

_FORMS = {1: (8, 9), 2: (8, 10)}
"""Default numbers per line and field width of the samples, by volume."""

EVENT, ORIGIN, TRIGGER, STATION, NAME, CHANNEL, HYPOCENTRE = 1, 2, 3, 4, 5, 6, 8
"""Text line numbers in volume 1; in volume 2 one more."""

_TITLE = re.compile(rb"[ ]*(UNCORRECTED ACCELEROGRAM DATA|CORRECTED ACCELEROGRAM\b|RESPONSE AND FOURIER)", re.IGNORECASE)
_VOLUMES = {"UNC": 1, "COR": 2}
_SECTION = re.compile(r"\s*(\d+)\s+(?:points of\s+)?(accel|veloc|displ)", re.IGNORECASE)
_INTERVAL = re.compile(r"\bat\s+([\d.]+)\s*(sec|pts/sec)", re.IGNORECASE)
_UNIT = re.compile(r"(?:units?\s*(?:of|:)|\bin(?! units))\s*([a-z][a-z0-9/]*)", re.IGNORECASE)
_PEAKS = {1: r"\bmax\s*=\s*(-?[\d.]+)", 2: r"\bpeak acceleration\s*=\s*(-?[\d.]+)"}
"""Patterns of the header peak, by volume."""

_FILM_SLACK_S = 0.05
"""Tolerance of the record length of uneven samples, s."""

_END_MARK = re.compile(r"/&[\s-]*END OF DATA FOR (?:STATION )?CHANNEL\s+\S+\s+-{10}", re.IGNORECASE)
_UNSUPPORTED = {
    "RES": N_("response spectra (volume 3): use volume 2 of the same record"),
}
_PAIRS_PER_LINE, _TIME_RESOLUTION_S = 5, 1e-3
"""Layout of pairs of time and acceleration."""


_UNSET_CLOCK = datetime(1980, 1, 1, tzinfo=UTC)
"""Zero of GPS clocks, in the headers of recorders without a time."""

_SENSOR_CHANNELS, _RECORDER_CHANNELS = 3, 4
"""Channels of a digital recorder of the free field (Etna, K2) and of its internal sensor; the last one is spare."""


class _Section(NamedTuple):
    """Samples of one quantity: quantity, interval, unit, values, index of the line after them, count in the file, history entries.

    `recorded` are uneven samples as recorded, `recorded_dt` is their mean interval.
    """

    quantity: str
    dt: float
    unit: str
    values: FloatArray
    end: int
    stated_count: int = 0
    history: tuple[str, ...] = ()
    recorded: FloatArray | None = None
    recorded_dt: float = 0.0


def is_csmip(head: bytes) -> bool:
    """Return whether bytes begin with the title of a CSMIP or USC file."""
    match = _TITLE.match(head)
    # USC files have a format of their own
    if re.match(rb"(?:[^\n]*\n)?[ ]*FILE\s+\d+ OF UNCORRECTED", head, re.IGNORECASE):
        return False
    # GeoNet titles begin alike
    if match is None or b"GNS SCIENCE" in head[:200].upper():
        return False
    return match[1][:3].upper() != b"COR" or b"UNCORRECTED ACCELEROGRAM DATA" in head[:400].upper()


def read_csmip(blob: RawFile) -> list[Record]:
    """Return the channels in a CSMIP file of volume 1 or 2, as single-component records.

    Notes
    -----
    Azimuths are kept. A file with more than three channels, or two in one direction, is that of a structure: each location becomes a
    station. Header peak, count and length are checked against the samples.
    """
    lines = read_trimmed_lines(blob)
    parts = parse_blocks(lines, lambda begin: _parse_channel(blob.name, lines, begin))
    if not _END_MARK.match(lines[-1].strip()):
        flag = qc_flag("end mark of the last channel missing: file probably truncated", "cut")
        parts = [replace(part, doubts=(*part.doubts, flag)) for part in parts]
    # a file that ends between two channels; files of one channel are whole
    total = int(search_group(r"\((\d{1,3})\s+CHNS OF", " ".join(lines[:12])) or 0)
    if len(parts) == _SENSOR_CHANNELS and total == _RECORDER_CHANNELS and [part.codes[0] for part in parts].count("UD") == 1:
        note = lazy_gettext(
            "{count} of {total} channels of the recorder in the file: the components of one sensor", count=len(parts), total=total
        )
        parts = [replace(part, history=(*part.history, note)) for part in parts]
    elif 1 < len(parts) < total:
        flag = qc_flag("{count} of {total} channels in the file: probably truncated", "cut", count=len(parts), total=total)
        parts = [replace(part, doubts=(*part.doubts, flag)) for part in parts]
    return split_by_location(parts)


def _parse_channel(name: str, lines: Sequence[str], begin: int) -> tuple[Record, int]:
    """Return the channel that begins at a line, and the index of the next."""
    title = _TITLE.match(lines[begin].encode("latin-1", "replace"))
    if title is None:
        raise line_error("expected the title of a channel, found {text!r}", name, begin + 1, text=lines[begin].strip()[:60])
    kind = title[1][:3].decode().upper()
    if kind in _UNSUPPORTED:
        raise RecordFormatError("{name} contains {what}", name=name, what=lazy_gettext(_UNSUPPORTED[kind]))
    volume = _VOLUMES[kind]
    line_index = begin + _HEADERS[volume]
    sections = [_parse_section(name, lines, line_index, volume)]
    while _SECTION.match((lines[sections[-1].end : sections[-1].end + 1] or [""])[0]):
        sections.append(_parse_section(name, lines, sections[-1].end, volume))
    end = sections[-1].end
    if end < len(lines) and not lines[end].startswith("/&"):
        raise line_error("expected the end of the channel, found {text!r}", name, end + 1, text=lines[end].strip()[:60])
    acceleration = next((section for section in sections if section.quantity == "accel"), None)
    if acceleration is None:
        raise RecordFormatError("{name}, line {line}: no acceleration in this channel", name=name, line=begin + 1)
    return _to_record(name, lines[begin:line_index], begin, volume, acceleration), end + 1


def _parse_section(name: str, lines: Sequence[str], line_index: int, volume: int) -> _Section:
    """Return the samples described by the line at `line_index`."""
    text = lines[line_index] if line_index < len(lines) else ""
    match, interval, unit = _SECTION.match(text), _INTERVAL.search(text), _UNIT.search(text)
    # bare numbers instead of the data line: volume 1 of film records
    if match is None and volume == 1 and re.fullmatch(r"[\s\d.+-]+", text):
        return _parse_pairs(name, lines, line_index)
    step = parse_number(interval[1]) if interval else None
    if match is None or interval is None or not step or unit is None:
        message = "expected a line with count, interval and unit of the samples, found {text!r}"
        raise line_error(message, name, line_index + 1, text=text.strip()[:80])
    # stated as an interval in seconds or as a rate
    dt = step if interval[2].lower() == "sec" else 1.0 / step
    count, layout = parse_sample_count(name, line_index + 1, match[1]), parse_fortran_format(text) or _FORMS[volume]
    return _Section(match[2].lower(), dt, unit[1], *parse_fixed_width(name, lines, line_index + 1, count, layout))


def _parse_pairs(name: str, lines: Sequence[str], line_index: int) -> _Section:
    """Return the samples of pairs of time and acceleration from `line_index` on; count and unit stand in the text above."""
    text = " ".join(lines[max(line_index - _HEADERS[1], 0) : line_index])
    count = parse_sample_count(name, line_index, search_group(r"no\. of points\s*=\s*(\d+)", text))
    unit = search_group(r"units of uncor accel are sec and\s+([a-z]+/?10)\b", text).lower()
    if unit != "g/10":
        raise line_error("expected samples in g/10, found {text!r}", name, line_index, text=unit)
    width = round(len(lines[line_index].rstrip()) / (2 * _PAIRS_PER_LINE))
    numbers, end = parse_fixed_width(name, lines, line_index, 2 * count, (2 * _PAIRS_PER_LINE, max(width, 1)))
    _, dt, (tenths,), history = resample_pairs(name, numbers[::2], [numbers[1::2]], _TIME_RESOLUTION_S)
    recorded = (numbers[1::2] / 10.0, float(numbers[-2] - numbers[0]) / (count - 1)) if history else ()
    return _Section("accel", dt, "g", tenths / 10.0, end, count, history, *recorded)


def _to_record(name: str, text: Sequence[str], begin: int, volume: int, section: _Section) -> Record:
    unit = require_unit(name, begin + len(text) + 1, section.unit)
    line_shift = volume - 1
    channel = re.match(r"\s*CHAN\s+(\S+?)\s*:\s*(\d{1,3}\s*deg\b|\S+)(.*)", text[CHANNEL + line_shift], re.IGNORECASE)
    station = re.match(r"\s*STATION\s+(?:NO|ID)\.?\s*(\S+)", text[STATION + line_shift], re.IGNORECASE)
    if channel is None or station is None:
        line = begin + 1 + line_shift + (STATION if station is None else CHANNEL)
        raise line_error("expected a station or a channel, found {text!r}", name, line, text=text[line - begin - 1].strip()[:60])
    direction = parse_direction(channel[2]) or Direction(channel[2].upper())
    # files without a number have the coordinates in its place
    code = "" if re.fullmatch(r"[\d.]+[NS],?", station[1]) else station[1]
    component, history = make_component(direction, to_si(section.values, unit), channel[2])
    start = _parse_clock(text[TRIGGER + line_shift])
    metadata = {"unit": unit, "volume": f"V{volume}", **_metadata(text, line_shift)}
    metadata |= {"channels": {direction.code: channel[1]}} | drop_missing({"place": parse_location(channel[3])})
    if section.history:
        metadata["interpolated"] = True
    # without a trigger time, event and origin text identify the recording
    if start is None:
        metadata["event"] = " ".join(f"{text[EVENT + line_shift]} {text[ORIGIN + line_shift]}".split())
    flags = _qc_flags(direction.code, " ".join(text), section, volume)
    if section.recorded is not None:
        flags += check_recorded(Component(direction.code, to_si(section.recorded, unit)), section.recorded_dt)
    return Record(
        (component,),
        section.dt,
        code,
        start,
        source=name,
        format=FORMAT.name,
        history=(*history, *section.history),
        metadata=metadata,
        doubts=flags,
    )


def _parse_clock(text: str) -> datetime | None:
    """Return the UTC time in a header line; None if missing, or the zero of a clock that was never set."""
    time = parse_datetime(text)[0]
    return None if time == _UNSET_CLOCK else time


def _metadata(text: Sequence[str], line_shift: int) -> dict[str, object]:
    event, origin, trigger, station, name, hypocentre = (
        text[line + line_shift] for line in (EVENT, ORIGIN, TRIGGER, STATION, NAME, HYPOCENTRE)
    )
    places = dict(zip(("station_latitude_deg", "station_longitude_deg"), parse_coordinates(station), strict=True))
    places |= dict(zip(("event_latitude_deg", "event_longitude_deg"), parse_coordinates(hypocentre), strict=True))
    depth = parse_number(search_group(r"\bH\s*=\s*([\d.]+)\s*KM", hypocentre).rstrip("."))
    # entries of one header line are separated by three blanks or more
    has_name = not re.match(r"\s*(?:record|rcrd) of", event, re.IGNORECASE)
    clocks = [word for word in re.findall(r"\b[A-Z]{3,4}\b", f"{event} {origin} {trigger}") if word in UTC_OFFSETS and word != "UTC"]
    return drop_missing(
        {
            "station_name": re.split(r"\s{3,}", name.strip())[0],
            "event_name": re.split(r"\s{3,}", event.strip())[0] if has_name else "",
            **places,
            # a depth of zero without a position is unknown
            "event_depth_km": depth if depth or places["event_latitude_deg"] is not None else None,
            **parse_magnitude(hypocentre),
            "origin_time": _parse_clock(origin),
            "clock": clocks[0] if clocks else "UTC",
        }
    )


def _qc_flags(code: str, text: str, section: _Section, volume: int) -> tuple[QCFlag, ...]:
    """Return flags for peak, count and record length that differ from the header."""
    size = section.stated_count or section.values.size
    peak_text = search_group(_PEAKS[volume], text)
    count = search_group(r"(?:no\. of points\s*=\s*|(?=\d+\s+points of instrument))(\d+)", text)
    # film records are longer or shorter by parts of an uneven interval
    slack = _FILM_SLACK_S if section.history else None
    return (
        *flag_peak_mismatch(code, peak_text, section.values, section.unit, half_last_digit(peak_text)),
        *flag_count(int(count[:12] or 0), size),
        *flag_duration(search_group(r"record length\s*=\s*([\d.]+)", text), section.values.size, section.dt, slack),
    )


def _is_spectra(head: bytes) -> bool:
    match = _TITLE.match(head)
    return match is not None and match[1][:3].upper() == b"RES"


FORMAT = register(
    Format(
        name="CSMIP",
        parse=read_csmip,
        is_derived=_is_spectra,
        matches=is_csmip,
        proves=("count", "peak", "clock", "unit", "sign", "instrument"),
        synchronous=True,
    )
)
