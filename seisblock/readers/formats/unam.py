"""UNAM (Mexico), standard acceleration file 2.0: columns in gal below a header ``KEY : value``; channels by bearing (``/V/N00E/N90E``)."""

from __future__ import annotations

from datetime import datetime, timedelta

from seisblock.core.errors import RecordFormatError
from seisblock.core.i18n import N_
from seisblock.readers._header import drop_missing, parse_datetime, parse_number, search_group
from seisblock.readers._header_check import flag_count, flag_duration, flag_peak_mismatch, half_last_digit
from seisblock.readers.directions import Direction, parse_direction
from seisblock.readers.registry import Format, register
from seisblock.readers.source import RawFile
from seisblock.readers.table.checks import flag_truncated_end
from seisblock.readers.table.headers import require_unit
from seisblock.readers.table.parse import parse_columns, to_si
from seisblock.records import Component, Record

_END_OF_HEADER = "DATOS DE ACELERACION"
_MAX_HEADER_LINES = 200
_CHANNELS = ", C1-C6"
"""End of the keys with a value per channel."""


def is_unam(head: bytes) -> bool:
    """Return whether bytes begin a standard acceleration file of UNAM."""
    return b"ARCHIVO ESTANDAR DE ACELERACION" in head[:1500]


def read_unam(blob: RawFile) -> Record:
    """Return the record in a standard acceleration file; counts, durations and peaks of the header are checked against the samples."""
    lines = blob.data.decode("latin-1").replace("\r\n", "\n").split("\n")
    end = next((i for i, line in enumerate(lines[:_MAX_HEADER_LINES]) if line.startswith(_END_OF_HEADER)), None)
    if end is None:
        raise RecordFormatError("{name}: header entry {key} missing: file truncated or damaged", name=blob.name, key=_END_OF_HEADER)
    header, further = _parse_header(lines[:end])
    intervals = [parse_number(text) for text in _per_channel(blob.name, header, "INTERVALO DE MUESTREO")]
    dt = intervals[0]
    if not dt or dt < 0 or len(set(intervals)) > 1:
        raise RecordFormatError(
            "{name}: expected one sampling interval above 0 s, found {found}", name=blob.name, found=list(map(str, intervals))
        )
    unit = require_unit(blob.name, end, header.get("UNIDADES DE LOS DATOS", "").partition("(")[0])
    names = _per_channel(blob.name, header, "ORIENTACION")
    # the rule of dashes, two lines of names and another rule
    first = next(
        (i for i in range(end + 1, min(end + 12, len(lines))) if parse_number(lines[i].split()[0] if lines[i].split() else "") is not None),
        end + 1,
    )
    rows = parse_columns(blob.name, lines[first:], first + 1, {name: i for i, name in enumerate(names)}, len(names), None)
    directions = [parse_direction(name) or Direction(name.upper()) for name in names]
    counts = _per_channel(blob.name, header, "NUM. TOTAL DE MUESTRAS")
    peaks = _per_channel(blob.name, header, "ACEL. MAX.(Gal)")
    durations = _per_channel(blob.name, header, "DURACION DEL REGISTRO")
    flags = flag_truncated_end(lines[first:], None)
    for direction, row, count, peak, duration in zip(directions, rows, counts, peaks, durations, strict=True):
        flags += flag_count(int(parse_number(count) or 0), row.size)
        flags += flag_peak_mismatch(direction.code, peak, row, unit, 2.0 * half_last_digit(peak))
        flags += flag_duration(duration, row.size, dt)
    start = _time(header, "HORA DE LA PRIMERA MUESTRA")
    metadata = _metadata(header, further)
    origin = metadata.get("origin_time")
    # the header has only the date of the earthquake: records after midnight, or whose pre-event memory begins before it
    if start is not None and isinstance(origin, datetime):
        start += timedelta(days=round((origin - start) / timedelta(days=1)))
    return Record(
        tuple(Component(d.code, d.sign * to_si(row, unit), d.azimuth_deg) for d, row in zip(directions, rows, strict=True)),
        dt,
        station=header.get("CLAVE DE LA ESTACION", ""),
        start=start,
        source=blob.name,
        format=FORMAT.name,
        metadata={"unit": unit, **metadata},
        doubts=tuple(dict.fromkeys(flags)),
    )


def _parse_header(lines: list[str]) -> tuple[dict[str, str], dict[str, str]]:
    """Return the values by key, and those of the continuation lines below, where a key is blank."""
    header: dict[str, str] = {}
    further: dict[str, str] = {}
    key = ""
    for line in lines:
        name, colon, value = line.partition(": ")
        if not colon:
            continue
        if name.strip():
            key = " ".join(name.split())
            header.setdefault(key, value.strip())
        else:
            further[key] = f"{further.get(key, '')} {value.strip()}".strip()
    return header, further


def _first_value(header: dict[str, str], start: str) -> str:
    """Return the value of the first key that begins with a text; empty if there is none."""
    return next((value for key, value in header.items() if key.startswith(start)), "")


def _per_channel(name: str, header: dict[str, str], start: str) -> list[str]:
    """Return the values per channel, ``/a/b/c``, of the first key that begins with a text."""
    values = [text.strip() for text in _first_value(header, start).strip("/").split("/")]
    count = int(parse_number(header.get("NUMERO DE CANALES", "")) or 0)
    if not count or len(values) < count or not all(values[:count]):
        raise RecordFormatError("{name}: header entry {key} missing: file truncated or damaged", name=name, key=start)
    return values[:count]


def _time(header: dict[str, str], start: str) -> datetime | None:
    """Return the UTC time on the day of the earthquake that the first key with this beginning gives."""
    return parse_datetime(f"{header.get('FECHA DEL SISMO [GMT]', '')} {_first_value(header, start)}")[0]


def _coordinate(text: str, negative: str) -> float | None:
    """Return the degrees of ``99.85157 LONG. W``."""
    value = parse_number(search_group(r"^\s*([\d.]+)", text))
    return value if value is None or not text.rstrip().endswith(negative) else -value


def _metadata(header: dict[str, str], further: dict[str, str]) -> dict[str, object]:
    station, event = "COORDENADAS DE LA ESTACION", "COORDENADAS DEL EPICENTRO"
    return drop_missing(
        {
            "station_name": header.get("NOMBRE DE LA ESTACION"),
            "station_latitude_deg": _coordinate(header.get(station, ""), "S"),
            "station_longitude_deg": _coordinate(further.get(station, ""), "W"),
            "station_height_m": parse_number(header.get("ALTITUD (msnm)", "")),
            "event_latitude_deg": _coordinate(header.get(event, ""), "S"),
            "event_longitude_deg": _coordinate(further.get(event, ""), "W"),
            "event_depth_km": parse_number(_first_value(header, "PROFUNDIDAD FOCAL")),
            "magnitude": parse_number(search_group(r"=\s*([\d.]+)", header.get("MAGNITUD(ES)", ""))),
            "origin_time": _time(header, "HORA EPICENTRO"),
        }
    )


FORMAT = register(
    Format(
        name="UNAM",
        title=N_("UNAM (Mexico)"),
        parse=read_unam,
        matches=is_unam,
        proves=("count", "peak", "clock", "unit", "sign", "instrument"),
    )
)
