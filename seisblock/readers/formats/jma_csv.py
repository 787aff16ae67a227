"""JMA's acceleration CSV: header in Shift-JIS, gal, JST, one column per component."""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import UTC, datetime, timedelta

from seisblock.errors import RecordFormatError, UnitError
from seisblock.readers.cells import columns_of, fail, turned_si
from seisblock.readers.decimals import doubts_of_decimals
from seisblock.readers.header import JST, number
from seisblock.readers.lines import lines_of
from seisblock.readers.naming import code_of, normal_unit
from seisblock.readers.source import Blob
from seisblock.records import Component, Doubt, Record
from seisblock.words import said

FORMAT = "JMA-CSV"
_HEADER_LINES = 40  # 7 in every file seen; old ones may carry more
_CODES = ("NS", "EW", "UD", "X", "Y")
_KEY = re.compile(r"\s*([A-Za-z. ]+?)\s*=\s*(.*)")


def is_jma_csv(head: bytes) -> bool:
    """Return whether a file's first bytes are those of a JMA CSV."""
    first = head.removeprefix(b"\xef\xbb\xbf").lstrip()[:9].upper()
    return first == b"SITE CODE"


def read_jma_csv(blob: Blob) -> Record:
    """Return the record in a JMA CSV file.

    Notes
    -----
    Header keys may be spelled with or without blanks around ``=``; columns are taken by name in any order; trailing commas, two-digit
    years and UTF-8 re-encodings are accepted. The level is left as published.
    """
    lines = lines_of(blob)
    header, last = _read_header(blob.name, lines)
    names = [cell.strip().strip('"') for cell in lines[last].split(",")]
    while names and not names[-1]:
        names.pop()
    columns = _columns(blob.name, last + 1, names)
    dt = 1.0 / _rate(blob.name, header)
    unit = _unit(blob.name, header)
    start = _start(blob.name, header)
    rows = columns_of(blob.name, lines[last + 1 :], last + 2, columns, len(names))
    components = tuple(Component(code, turned_si(row, unit)) for code, row in zip(columns, rows, strict=True))
    station, metadata = _site(_value(blob.name, header, "SITE CODE")[1])
    for key, label in (("LAT.", "station_latitude_deg"), ("LON.", "station_longitude_deg")):
        value = number(header[key][1].split(",")[0]) if key in header else None
        if value:  # 0.0000 means unknown
            metadata[label] = value
    metadata |= {"unit": unit, "clock": "JST"}
    return Record(
        components,
        dt,
        station=station,
        start=start,
        source=blob.name,
        format=FORMAT,
        metadata=metadata,
        doubts=_doubts(lines, rows[0].size, dt) + doubts_of_decimals(lines[last + 1 :], last + 2, ","),
    )


def _doubts(lines: Sequence[str], samples: int, dt: float) -> tuple[Doubt, ...]:
    """Return what speaks for a file that was cut: JMA ends its last line, and publishes whole seconds."""
    found = []
    if lines[-1].strip():
        found.append(Doubt("cut", said("the last line has no end: the file looks cut, and its last number with it")))
    seconds = samples * dt
    if abs(seconds - round(seconds)) > 0.25 * dt:
        text = said(
            "{samples} samples are no whole number of seconds ({seconds:.6g} s): lines are missing, or the file was cut",
            samples=samples,
            seconds=seconds,
        )
        found.append(Doubt("count", text))
    return tuple(found)


def _read_header(name: str, lines: Sequence[str]) -> tuple[dict[str, tuple[int, str]], int]:
    """Return the header's keys with line number and value, and the index of the line that names the components."""
    header: dict[str, tuple[int, str]] = {}
    for index, line in enumerate(lines[:_HEADER_LINES]):
        match = _KEY.match(line)
        if match:
            header[" ".join(match[1].upper().split())] = (index + 1, match[2].strip())
        elif len({code_of(cell) for cell in line.split(",")} & set(_CODES)) >= 2:
            return header, index
    count = sum(1 for line in lines[:_HEADER_LINES] if line.strip())
    raise RecordFormatError(
        "{name}: the JMA header is cut short: {count} lines, none of which names the components (NS,EW,UD)", name=name, count=count
    )


def _columns(name: str, line: int, names: list[str]) -> dict[str, int]:
    """Return which column holds which component; a column that is none, or stands twice, is refused."""
    columns: dict[str, int] = {}
    for index, written in enumerate(names):
        code = code_of(written)
        if code not in _CODES or code in columns:
            fail(name, line, said("expected the components NS, EW and UD once each, found {names}", names=[repr(n) for n in names]))
        columns[code] = index
    return columns


def _value(name: str, header: dict[str, tuple[int, str]], *keys: str) -> tuple[int, str]:
    """Return the line number and the value of the first of some keys that the header has."""
    for key in keys:
        if key in header:
            return header[key][0], header[key][1].rstrip(", ")
    raise RecordFormatError(
        "{name}: the JMA header has no {key!r} line: it is cut short, or this is not a JMA file", name=name, key=keys[0]
    )


def _rate(name: str, header: dict[str, tuple[int, str]]) -> float:
    """Return the sampling rate, Hz."""
    line, text = _value(name, header, "SAMPLING RATE", "SAMPLING FREQ", "SAMPLING FREQ.")
    match = re.match(r"([\d.]+)\s*(?:Hz)?\s*\Z", text, re.IGNORECASE)
    rate = number(match[1]) if match else None
    if not rate:
        fail(name, line, said("expected a sampling rate such as 100Hz, found {text!r}", text=text))
    return rate


def _unit(name: str, header: dict[str, tuple[int, str]]) -> str:
    """Return the unit the header states."""
    line, text = _value(name, header, "UNIT")
    stated = {normal_unit(part.rstrip(") ")) for part in text.split("(")} - {None}
    if len(stated) > 1:
        raise UnitError("{name}, line {line}: {text!r} states two units: expected gal(cm/s/s)", name=name, line=line, text=text)
    unit = next(iter(stated), None)
    if unit is None:
        raise UnitError("{name}, line {line}: unknown unit {text!r}: expected gal(cm/s/s)", name=name, line=line, text=text)
    return unit


def _start(name: str, header: dict[str, tuple[int, str]]) -> datetime:
    """Return the time of the first sample, UTC."""
    line, text = _value(name, header, "INITIAL TIME")
    parts = re.split(r"[\s/:]+", text)
    try:
        year, month, day, hour, minute = (int(part) for part in parts[:5])
        second = float(parts[5])
        year += 0 if year > 99 else 1900 if year >= 70 else 2000
        return datetime(year, month, day, hour, minute, tzinfo=UTC) + timedelta(seconds=second) - JST
    except (ValueError, IndexError, OverflowError):
        fail(name, line, said("expected a time such as 2016 04 16 01 25 00, found {text!r}", text=text))


def _site(text: str) -> tuple[str, dict[str, object]]:
    """Return the station code, and what else the first line says: name, epicentre, origin time, travel times of P and S."""
    site, *rest = [part.strip() for part in text.split(",")]
    match = re.match(r"([0-9A-Za-z]*)\s*(.*)\Z", site)
    code, station_name = (match[1], match[2]) if match else ("", site)
    metadata: dict[str, object] = {"station_name": station_name} if station_name else {}
    numbers = [number(part) for part in rest]
    labels = ("event_latitude_deg", "event_longitude_deg", "event_depth_km", "magnitude")
    if len(numbers) >= 4 and any(numbers[:4]):
        metadata.update({label: value for label, value in zip(labels, numbers, strict=False) if value is not None})
    if len(numbers) >= 5 and numbers[4] and 0.0 < numbers[4] < 1e5:
        # an Excel serial day, JST
        metadata["origin_time"] = datetime(1899, 12, 30, tzinfo=UTC) + timedelta(days=numbers[4]) - JST
    if len(numbers) >= 7 and numbers[5] and numbers[6]:
        metadata["travel_time_p_s"], metadata["travel_time_s_s"] = numbers[5], numbers[6]
    return code or station_name, metadata
