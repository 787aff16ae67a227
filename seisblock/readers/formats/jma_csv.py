"""JMA acceleration CSV: Shift-JIS header, gal, JST, one column per component."""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import UTC, datetime, timedelta

from seisblock.core.errors import RecordFormatError, UnitError
from seisblock.core.i18n import N_
from seisblock.readers._header import JST, drop_missing, parse_number, search_group
from seisblock.readers._header_check import qc_flag
from seisblock.readers.lines import line_error, read_lines
from seisblock.readers.registry import Format, register
from seisblock.readers.source import RawFile
from seisblock.readers.table.checks import flag_missing_points
from seisblock.readers.table.headers import component_code, normalize_unit
from seisblock.readers.table.parse import parse_columns, to_si_in_place
from seisblock.records import Component, QCFlag, Record

_HEADER_LINES = 40  # 7 in all files examined
_CODES = ("NS", "EW", "UD", "X", "Y")
_KEY = re.compile(r"\s*([A-Za-z. ]+?)\s*=\s*(.*)")


def is_jma_csv(head: bytes) -> bool:
    """Return whether bytes begin a JMA CSV."""
    return re.match(rb"(?:\xef\xbb\xbf)?\s*SITE CODE\s*=", head, re.IGNORECASE) is not None


def read_jma_csv(blob: RawFile) -> Record:
    """Return the record in a JMA CSV file.

    Notes
    -----
    Blanks around ``=``, any column order, trailing commas, two-digit years and UTF-8 re-encodings are accepted. The mean is not removed.
    """
    lines = read_lines(blob)
    header, last = _parse_header(blob.name, lines)
    names = [cell.strip().strip('"') for cell in lines[last].split(",")]
    while names and not names[-1]:
        names.pop()
    columns = _component_columns(blob.name, last + 1, names)
    dt = 1.0 / _sampling_rate(blob.name, header)
    unit = _unit(blob.name, header)
    start = _start_time(blob.name, header)
    rows = parse_columns(blob.name, lines[last + 1 :], last + 2, columns, len(names))
    components = tuple(Component(code, to_si_in_place(row, unit)) for code, row in zip(columns, rows, strict=True))
    station, metadata = _parse_site(_get_value(blob.name, header, "SITE CODE")[1])
    for key, label in (("LAT.", "station_latitude_deg"), ("LON.", "station_longitude_deg")):
        metadata[label] = parse_number(header.get(key, (0, ""))[1].split(",")[0]) or None  # 0.0000: unknown
    metadata = drop_missing(metadata | {"unit": unit, "clock": "JST"})
    flags = _qc_flags(lines, rows[0].size, dt) + flag_missing_points(lines[last + 1 :], last + 2, ",")
    return Record(components, dt, station, start, source=blob.name, format=FORMAT.name, metadata=metadata, doubts=flags)


def _qc_flags(lines: Sequence[str], samples: int, dt: float) -> tuple[QCFlag, ...]:
    """Return flags for a truncated file: JMA files end with a line end and have whole seconds."""
    flags = []
    if lines[-1].strip():
        flags.append(qc_flag("no line end after the last line: file probably truncated, last number incomplete", "cut"))
    seconds = samples * dt
    if abs(seconds - round(seconds)) > 0.25 * dt:
        message = "{samples} samples are not a whole number of seconds ({seconds:.6g} s): lines missing or file truncated"
        flags.append(qc_flag(message, "count", samples=samples, seconds=seconds))
    return tuple(flags)


def _parse_header(name: str, lines: Sequence[str]) -> tuple[dict[str, tuple[int, str]], int]:
    """Return line number and value by header key, and the index of the line with component names."""
    header: dict[str, tuple[int, str]] = {}
    for index, line in enumerate(lines[:_HEADER_LINES]):
        match = _KEY.match(line)
        if match:
            header[" ".join(match[1].upper().split())] = (index + 1, match[2].strip())
        # the header ends at the line with at least two component names
        elif len({component_code(cell) for cell in line.split(",")} & set(_CODES)) >= 2:
            return header, index
    count = sum(1 for line in lines[:_HEADER_LINES] if line.strip())
    message = "{name}: JMA header incomplete: {count} lines, none with the component names (NS,EW,UD)"
    raise RecordFormatError(message, name=name, count=count)


def _component_columns(name: str, line: int, names: list[str]) -> dict[str, int]:
    """Return column index by component; raise for unknown or duplicate columns."""
    columns: dict[str, int] = {}
    for index, heading in enumerate(names):
        code = component_code(heading)
        if code not in _CODES or code in columns:
            raise line_error("expected the components NS, EW and UD once each, found {names}", name, line, names=[repr(n) for n in names])
        columns[code] = index
    return columns


def _get_value(name: str, header: dict[str, tuple[int, str]], *keys: str) -> tuple[int, str]:
    """Return line number and value of the first key present."""
    for key in keys:
        if key in header:
            return header[key][0], header[key][1].rstrip(", ")
    raise RecordFormatError("{name}: JMA header line {key!r} missing: file truncated or not a JMA file", name=name, key=keys[0])


def _sampling_rate(name: str, header: dict[str, tuple[int, str]]) -> float:
    """Return the sampling rate, Hz."""
    line, text = _get_value(name, header, "SAMPLING RATE", "SAMPLING FREQ", "SAMPLING FREQ.")
    rate = parse_number(search_group(r"\A([\d.]+)\s*(?:Hz)?\s*\Z", text))
    if not rate:
        raise line_error("expected a sampling rate such as 100Hz, found {text!r}", name, line, text=text)
    return rate


def _unit(name: str, header: dict[str, tuple[int, str]]) -> str:
    line, text = _get_value(name, header, "UNIT")
    stated_units = {normalize_unit(part.rstrip(") ")) for part in text.split("(")} - {None}
    if len(stated_units) > 1:
        raise UnitError("{name}, line {line}: two units in {text!r}: expected gal(cm/s/s)", name=name, line=line, text=text)
    unit = next(iter(stated_units), None)
    if unit is None:
        raise UnitError("{name}, line {line}: unknown unit {text!r}: expected gal(cm/s/s)", name=name, line=line, text=text)
    return unit


def _start_time(name: str, header: dict[str, tuple[int, str]]) -> datetime:
    line, text = _get_value(name, header, "INITIAL TIME")
    parts = re.split(r"[\s/:]+", text)
    try:
        year, month, day, hour, minute = (int(part) for part in parts[:5])
        second = float(parts[5])
        # files of 1995 have years of two digits
        year += 0 if year > 99 else 1900 if year >= 70 else 2000
        return datetime(year, month, day, hour, minute, tzinfo=UTC) + timedelta(seconds=second) - JST
    except (ValueError, IndexError, OverflowError):
        raise line_error("expected a time such as 2016 04 16 01 25 00, found {text!r}", name, line, text=text) from None


def _parse_site(text: str) -> tuple[str, dict[str, object]]:
    """Return station code and the metadata of the first line: name, epicentre, origin and travel times."""
    site, *extra_fields = [part.strip() for part in text.split(",")]
    match = re.match(r"([0-9A-Za-z]*)\s*(.*)\Z", site)
    code, station_name = (match[1], match[2]) if match else ("", site)
    metadata: dict[str, object] = {"station_name": station_name} if station_name else {}
    numbers = [parse_number(part) for part in extra_fields]
    labels = ("event_latitude_deg", "event_longitude_deg", "event_depth_km", "magnitude")
    if len(numbers) >= 4 and any(numbers[:4]):
        metadata.update({label: value for label, value in zip(labels, numbers, strict=False) if value is not None})
    if len(numbers) >= 5 and numbers[4] and 0.0 < numbers[4] < 1e5:
        # Excel serial day number, JST
        metadata["origin_time"] = datetime(1899, 12, 30, tzinfo=UTC) + timedelta(days=numbers[4]) - JST
    if len(numbers) >= 7 and numbers[5] and numbers[6]:
        metadata["travel_time_p_s"], metadata["travel_time_s_s"] = numbers[5], numbers[6]
    return code or station_name, metadata


FORMAT = register(
    Format(
        name="JMA-CSV",
        title=N_("JMA CSV"),
        parse=read_jma_csv,
        matches=is_jma_csv,
        proves=("unit", "sign", "instrument"),
        aliases=("JMA", "JMACSV"),
    )
)
