"""COSMOS format v1.20, volumes 1 and 2: text, integer and real header, comments and samples per channel.

Each header section states the number of values and their Fortran format. Raw counts (volume 0), pairs of time and acceleration,
velocities and displacements are identified by the first line or by the integers and raise an error that names them.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import datetime
from typing import NamedTuple

from seisblock.core.errors import RecordFormatError, UnitError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.readers._fixed_width import parse_fixed_width, parse_fortran_format, parse_sample_count
from seisblock.readers._header import drop_missing, parse_datetime, parse_magnitude, search_group, utc_datetime
from seisblock.readers._header_check import flag_duration, flag_peak_mismatch, half_last_digit, qc_flag
from seisblock.readers.channels import make_component, parse_blocks, parse_location, seed_file_set, split_by_location
from seisblock.readers.directions import Direction, direction_from_azimuth, parse_direction
from seisblock.readers.lines import line_error, read_trimmed_lines
from seisblock.readers.registry import Format, register
from seisblock.readers.source import RawFile
from seisblock.readers.table.parse import to_si
from seisblock.records import QCFlag, Record
from seisblock.records.site import UTC_OFFSETS

_TITLE_LINE = re.compile(rb"[ ]*([A-Za-z][A-Za-z ]*?)\s*\(Format v[\d.]+ with\s+(\d+) text lines\)", re.IGNORECASE)
_SECTION_HEAD = re.compile(r"\s*(\d+)\s+(Integer|Real)-header values follow on\s+(\d+)\s+lines", re.IGNORECASE)
_COMMENTS = re.compile(r"\s*(\d+)\s+Comment line\(s\) follow", re.IGNORECASE)
_DATA = re.compile(r"\s*(\d+)\s+([A-Za-z. ]+?)\s*pts,.*units\s*=\s*([^,(]*)\((\d+)\)", re.IGNORECASE)
_END_MARK = re.compile(r"(?:/&[\s-]*End of data for channel\s+\S+\s+-{10}|End-of-data for \S.*acceleration)\s*\Z", re.IGNORECASE)
TITLE, RECORD, HYPOCENTRE, ORIGIN, STATION, START_TIME, CHANNEL, PEAK = 0, 1, 2, 3, 4, 7, 8, 10
"""Text line numbers, from 0."""

LEVEL, QUANTITY, UNIT, STRUCTURE, YEAR, MONTH, DAY, HOUR, MINUTE, AZIMUTH = 0, 1, 2, 18, 39, 41, 42, 43, 44, 53
"""Indices of the integer header, from 0."""

REAL_INDICES = {
    "station_latitude_deg": 0,
    "station_longitude_deg": 1,
    "station_height_m": 2,
    "event_latitude_deg": 9,
    "event_longitude_deg": 10,
    "event_depth_km": 11,
    "epicentral_distance_km": 16,
}
MAGNITUDES, SECOND, INTERVAL_MS, LENGTH = (12, 14, 13), 29, 61, 62
"""Indices of the real header, from 0; magnitudes: moment, local, surface-wave."""

MISSING_BELOW = -998.0
"""Real values below this are missing; COSMOS writes -999."""

_UNITS = {2: ("g", 1.0), 4: ("gal", 1.0), 7: ("gal", 2.54), 10: ("gal", 1.0), 11: ("g", 1e-3), 12: ("g", 1e-6)}
"""Acceleration unit and factor by COSMOS unit code; 7 is in/s^2, 11 mg, 12 micro-g."""

_DIRECTIONS = {400: "UP", 401: "DOWN", 402: "UP", 500: "R", 501: "TRANS", 600: "L", 601: "TRANS", 700: "H1", 701: "H2"}
_STRUCTURES = {10, 11, 12, 13, 15, 20}
"""Station type codes of buildings, bridges, dams, wharves and other structures."""

_UNSUPPORTED = {
    "raw": N_("raw counts (volume 0): use volume 1 or 2 of the same record"),
    "velocity": N_("velocity: use the acceleration file of the same record"),
    "displacement": N_("displacement: use the acceleration file of the same record"),
    "uneven": N_("unevenly sampled pairs of time and acceleration: use volume 2 of the same record (evenly sampled)"),
}


class _ChannelBlock(NamedTuple):
    """One channel: text, headers, comments and samples, and line of its data."""

    text: Sequence[str]
    integers: list[int]
    reals: FloatArray
    comments: str
    samples: FloatArray
    data_line: int


MAX_INTEGER_LINES = 100
"""Most lines of an integer header."""


def is_cosmos(head: bytes) -> bool:
    """Return whether bytes begin with a COSMOS title line (format version, number of text lines)."""
    return _TITLE_LINE.match(head) is not None


def read_cosmos(blob: RawFile) -> list[Record]:
    """Return the channels in a COSMOS file of volume 1 or 2, as single-component records.

    Notes
    -----
    Channels in a building, bridge or dam become separate stations by their location. Header peak and record length are checked against
    the samples.
    """
    lines = read_trimmed_lines(blob)
    is_complete = _END_MARK.match(lines[-1]) is not None
    blocks = parse_blocks(lines, lambda begin: _parse_block(blob.name, lines, begin))
    parts = [_to_record(blob.name, block, is_complete=is_complete) for block in blocks]
    return split_by_location(parts, structure=any(block.integers[STRUCTURE] in _STRUCTURES for block in blocks))


def _parse_block(name: str, lines: Sequence[str], begin: int) -> tuple[_ChannelBlock, int]:
    """Return the channel that begins at a line, and the index of the line after it."""
    title = _TITLE_LINE.match(lines[begin].encode("latin-1", "replace"))
    if title is None:
        raise line_error("expected the title of a channel, found {text!r}", name, begin + 1, text=lines[begin].strip()[:60])
    _check_quantity(name, title[1].decode("latin-1"))
    # three digits at most: a damaged number must not become a huge one
    line_index = begin + int(title[2][:3])
    integers, line_index = _parse_values(name, lines, line_index, "Integer")
    reals, line_index = _parse_values(name, lines, line_index, "Real")
    comment_head = _COMMENTS.match(lines[line_index]) if line_index < len(lines) else None
    if comment_head is None:
        raise line_error("expected the number of comments, found {text!r}", name, line_index + 1, text=_line_text(lines, line_index))
    count = int(comment_head[1][:4])
    comments = lines[line_index + 1 : line_index + 1 + count]
    if len(comments) < count or not all(line.lstrip().startswith("|") for line in comments):
        raise line_error("expected {count} comment lines beginning with |", name, line_index + 1, count=count)
    line_index += 1 + count
    data, layout = _DATA.match(lines[line_index] if line_index < len(lines) else ""), parse_fortran_format(_line_text(lines, line_index))
    if data is None or layout is None:
        message = "expected a line with count, unit and format of the samples, found {text!r}"
        raise line_error(message, name, line_index + 1, text=_line_text(lines, line_index))
    _check_quantity(name, data[2])
    size = parse_sample_count(name, line_index + 1, data[1])
    integer_values = [int(value) for value in integers]
    # unit code 3 marks pairs of time and acceleration
    if int(data[4]) == 3 or integer_values[UNIT] == 3:
        raise RecordFormatError("{name} contains {what}", name=name, what=lazy_gettext(_UNSUPPORTED["uneven"]))
    samples, end = parse_fixed_width(name, lines, line_index + 1, size, layout)
    if end < len(lines) and not re.match(r"/&|End-of-data", lines[end], re.IGNORECASE):
        raise line_error("expected the end of the channel, found {text!r}", name, end + 1, text=_line_text(lines, end))
    if int(data[4]) != integer_values[UNIT]:
        message = "sample unit {one} contradicts unit code {other} in the integer header"
        raise line_error(message, name, line_index + 1, one=data[3].strip(), other=integer_values[UNIT])
    text = [*lines[begin : begin + int(title[2][:3])], *[""] * (PEAK + 1)]
    return _ChannelBlock(text, integer_values, reals, "\n".join(comments), samples, line_index), end + 1


def _check_quantity(name: str, quantity: str) -> None:
    """Raise if the quantity of a channel is not acceleration."""
    word = _unsupported_quantity(quantity)
    if word is not None:
        raise RecordFormatError("{name} contains {what}", name=name, what=lazy_gettext(_UNSUPPORTED[word]))


def _unsupported_quantity(quantity: str) -> str | None:
    stated_quantity = re.sub(r"^(?:un)?corrected\s+", "", quantity.strip().lower())
    return next((word for word in _UNSUPPORTED if stated_quantity.startswith(word)), None)


def _line_text(lines: Sequence[str], index: int) -> str:
    """Return a line for messages; empty past the end."""
    return lines[index].strip()[:80] if index < len(lines) else ""


def _parse_values(name: str, lines: Sequence[str], line_index: int, kind: str) -> tuple[FloatArray, int]:
    """Return the values of a header section, and the index of the line after them."""
    head, layout = _SECTION_HEAD.match(_line_text(lines, line_index)), parse_fortran_format(_line_text(lines, line_index))
    if head is None or layout is None or head[2].lower() != kind.lower() or int(head[1][:6]) < 100:
        message = "expected number, lines and format of {kind}-header values, found {text!r}"
        raise line_error(message, name, line_index + 1, kind=kind, text=_line_text(lines, line_index))
    if kind == "Integer":
        # files exist whose integers lack a blank: whole numbers are told apart without columns
        end = line_index + 1 + MAX_INTEGER_LINES
        lines = [*lines[: line_index + 1], *(_align_integers(line, layout) for line in lines[line_index + 1 : end])]
    return parse_fixed_width(name, lines, line_index + 1, int(head[1][:6]), layout)


def _align_integers(line: str, layout: tuple[int, int]) -> str:
    """Return a line of integers in columns if it has as many as it should, else the line as it is."""
    count, width = layout
    cells = line.split()
    is_shifted = len(line.rstrip()) != count * width and len(cells) == count and all(re.fullmatch(r"-?\d+", cell) for cell in cells)
    return "".join(cell.rjust(width) for cell in cells) if is_shifted else line


def _to_record(name: str, block: _ChannelBlock, *, is_complete: bool) -> Record:
    if block.integers[UNIT] not in _UNITS:
        unit_code = block.integers[UNIT]
        raise UnitError("{name}, line {line}: unknown acceleration unit {text!r}", name=name, line=block.data_line + 1, text=unit_code)
    unit, factor = _UNITS[block.integers[UNIT]]
    # the real header states the interval in ms
    dt = float(block.reals[INTERVAL_MS]) / 1000.0
    if not dt > 0.0:
        message = "expected a sampling interval above 0 ms in the real header, found {dt:g} ms"
        raise line_error(message, name, block.data_line + 1, dt=1000.0 * dt)
    direction, direction_name = _parse_direction(block)
    scaled_samples = block.samples if factor == 1.0 else factor * block.samples
    component, history = make_component(direction, to_si(scaled_samples, unit), direction_name)
    flags = _qc_flags(direction.code, block, dt)
    if not is_complete:
        flags += (qc_flag("end mark of the last channel missing: file probably truncated", "cut"),)
    code, start = _parse_station(block)[0], _start_time(block)
    metadata = {"unit": unit, "volume": f"V{block.integers[LEVEL]}", **_metadata(block)}
    return Record((component,), dt, code, start, source=name, format=FORMAT.name, history=history, metadata=metadata, doubts=flags)


def _parse_direction(block: _ChannelBlock) -> tuple[Direction, str]:
    """Return direction and name of a channel from the integers, else the text, else the SEED code in the comments."""
    azimuth = block.integers[AZIMUTH]
    # codes above 360 denote vertical, radial, transverse and other directions
    if 1 <= azimuth <= 360:
        return direction_from_azimuth(float(azimuth)), str(azimuth)
    channel_name = search_group(r"Chan?\s*\S*?:\s*(\d{1,3}\s*deg\b|[^\s(]+)", block.text[CHANNEL])
    seed_code = search_group(r"<SCNL>\s*[^.\s]*\.([^.\s]+)", block.comments)
    for word in (_DIRECTIONS.get(azimuth, ""), channel_name, seed_code):
        direction = parse_direction(word) if word else None
        if direction is not None:
            return direction, word
    return Direction("H1"), channel_name


def _parse_station(block: _ChannelBlock) -> tuple[str, str, str]:
    """Return code, network and name of the station."""
    text = block.text[STATION]
    code = re.search(r"Code:\s*([A-Z0-9_]{0,2})-(\S+)", text, re.IGNORECASE)
    return (code[2], code[1], text[40:].strip()) if code else (search_group(r"Statn No:\s*(\S+)", text), "", "")


def _start_time(block: _ChannelBlock) -> datetime | None:
    year, month, day, hour, minute = (block.integers[place] for place in (YEAR, MONTH, DAY, HOUR, MINUTE))
    return utc_datetime(year, month, day, hour, minute, float(block.reals[SECOND])) or parse_datetime(block.text[START_TIME])[0]


def _metadata(block: _ChannelBlock) -> dict[str, object]:
    _, network, name = _parse_station(block)
    magnitudes = [float(block.reals[place]) for place in MAGNITUDES if block.reals[place] > 0.0]
    channel = search_group(r"Cha\w*:?\s*(\S+?):", block.text[CHANNEL])
    return drop_missing(
        {
            "network": network,
            "station_name": name,
            **{key: float(block.reals[place]) for key, place in REAL_INDICES.items() if block.reals[place] > MISSING_BELOW},
            **({"magnitude": magnitudes[0]} if magnitudes else parse_magnitude(block.text[HYPOCENTRE])),
            "event_name": search_group(r"\A\s*Record of (.*?)\s+Earthquake of\b", block.text[RECORD]),
            "origin_time": parse_datetime(block.text[ORIGIN])[0],
            "channels": {_parse_direction(block)[0].code: channel} if channel else None,
            "place": parse_location(block.text[CHANNEL].partition("Location:")[2]),
            "clock": next((word for word in re.findall(r"\b[A-Z]{3,4}\b", block.text[RECORD]) if word in UTC_OFFSETS), "UTC"),
        }
    )


def _qc_flags(code: str, block: _ChannelBlock, dt: float) -> tuple[QCFlag, ...]:
    """Return flags for peak and record length that differ from the header."""
    peak_text = search_group(r"Max\s*=\s*(-?[\d.]+)", block.text[PEAK])
    flags = flag_peak_mismatch(code, peak_text, block.samples, _UNITS[block.integers[UNIT]][0], 2.0 * half_last_digit(peak_text))
    length = float(block.reals[LENGTH])
    # 1.5 intervals and the printed decimals
    return flags + flag_duration(f"{length:g}", block.samples.size, dt, 1.5 * dt + 0.05) if length > 0.0 else flags


def _is_derived(head: bytes) -> bool:
    """Return whether a COSMOS file has velocities or displacements."""
    title = _TITLE_LINE.match(head)
    return title is not None and _unsupported_quantity(title[1].decode("latin-1")) in ("velocity", "displacement")


def _recording_key(head: bytes) -> object:
    lines = [*head.decode("latin-1").splitlines(), *[""] * (CHANNEL + 1)]
    start_text = re.sub(r"\s*RcrdId.*", "", lines[START_TIME])
    return is_cosmos(head) and (lines[TITLE][:40], lines[STATION], start_text, lines[CHANNEL].partition("Location:")[2].strip())


FORMAT = register(
    Format(
        name="COSMOS",
        parse=read_cosmos,
        matches=is_cosmos,
        is_derived=_is_derived,
        proves=("count", "peak", "clock", "unit", "sign", "instrument"),
        synchronous=True,
        file_set=seed_file_set,
        recording_key=_recording_key,
    )
)
