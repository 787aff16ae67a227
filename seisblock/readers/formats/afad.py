"""AFAD/NSMN (Turkey): three components in gal, in columns below a header ``KEY : value``.

Layout found in files: 17 header lines with place, event, station, record time, count, interval and peaks about the mean, then a line with
the names of the columns. Turkish letters are in Windows-1254.
"""

from __future__ import annotations

import re
from datetime import datetime

from seisblock.core.errors import RecordFormatError
from seisblock.core.i18n import N_
from seisblock.readers._header import drop_missing, parse_coordinates, parse_datetime, parse_number, search_group
from seisblock.readers._header_check import flag_count, flag_peak_mismatch, half_last_digit
from seisblock.readers.directions import Direction, parse_direction
from seisblock.readers.lines import line_error
from seisblock.readers.registry import Format, register
from seisblock.readers.source import RawFile
from seisblock.readers.table.checks import flag_truncated_end
from seisblock.readers.table.parse import parse_columns, to_si
from seisblock.records import Component, Record

_NAMES = re.compile(r"\s*[NEU]-[SWD](?:\s+[NEU]-[SWD])*\s*", re.IGNORECASE)


def is_afad(head: bytes) -> bool:
    """Return whether bytes begin an AFAD file."""
    return re.match(rb"\s*STRONG GROUND MOTION RECORDS OF T[^\n]{1,3}RK[^\n]{1,3}YE", head) is not None


def read_afad(blob: RawFile) -> Record:
    """Return the record in an AFAD file; header count and peaks are checked against the samples."""
    lines = blob.data.decode("cp1254", "replace").replace("\r\n", "\n").split("\n")
    index = next((i for i, line in enumerate(lines[:60]) if _NAMES.fullmatch(line) and line.strip()), None)
    if index is None:
        raise RecordFormatError("{name}: no line with column names (N-S E-W U-D) in the header", name=blob.name)
    header = {key.strip(): value.strip() for key, _, value in (line.partition(":") for line in lines[:index]) if value}
    interval = header.get("SAMPLING INTERVAL (sec)", "")
    dt = parse_number(interval)
    if not dt or dt < 0:
        raise RecordFormatError("{name}: expected a SAMPLING INTERVAL above 0 s, found {text!r}", name=blob.name, text=interval[:20])
    peak_key = next((key for key in header if "PGA VALUES" in key), "")
    if "(gal)" not in peak_key:
        raise line_error("expected PGA values in gal, found {text!r}", blob.name, index, text=peak_key)
    names = lines[index].split()
    rows = parse_columns(blob.name, lines[index + 1 :], index + 2, {name: i for i, name in enumerate(names)}, len(names), None)
    directions = [parse_direction(name) or Direction(name) for name in names]
    flags = flag_count(int(parse_number(header.get("NUMBER OF DATA", "")) or 0), rows[0].size)
    flags += flag_truncated_end(lines[index + 1 :], None)
    for name, direction, row in zip(names, directions, rows, strict=True):
        peak = search_group(rf"\({re.escape(name)}\)\s*([\d.]+)", header[peak_key])
        # printed digits of peak and samples
        flags += flag_peak_mismatch(direction.code, peak, row, "gal", 4.0 * half_last_digit(peak), signed=False, about_mean=True)
    latitude, longitude = _parse_place(header.get("STATION COORDINATES", ""))
    event_latitude, event_longitude = _parse_place(header.get("EPICENTER COORDINATES", ""))
    metadata = {
        "unit": "gal",
        "station_name": header.get("PLACE"),
        "station_latitude_deg": latitude,
        "station_longitude_deg": longitude,
        "station_height_m": parse_number(header.get("STATION ALTITUDE (m)", "")),
        "event_latitude_deg": event_latitude,
        "event_longitude_deg": event_longitude,
        "event_depth_km": parse_number(header.get("EARTHQUAKE DEPTH (km)", "")),
        "magnitude": parse_number(search_group(r"([\d.]+)", header.get("EARTHQUAKE MAGNITUDE", ""))),
        "origin_time": parse_datetime(header.get("EARTHQUAKE DATE", ""))[0],
    }
    return Record(
        tuple(Component(d.code, to_si(row, "gal"), d.azimuth_deg) for d, row in zip(directions, rows, strict=True)),
        dt,
        station=header.get("STATION ID", ""),
        start=_record_time(header.get("RECORD TIME", "")),
        source=blob.name,
        format=FORMAT.name,
        metadata=drop_missing(metadata),
        doubts=flags,
    )


def _parse_place(text: str) -> tuple[float | None, float | None]:
    """Return latitude and longitude, degrees; whole degrees have no decimal point."""
    return parse_coordinates(re.sub(r"(?<![\d.])(\d{1,3})(?=\s*[NSEW]\b)", r"\1.", text, flags=re.IGNORECASE))


def _record_time(text: str) -> datetime | None:
    """Return the UTC time of ``20/07/2017 22:30:58.000000 (GMT)``, day first."""
    return parse_datetime(re.sub(r"^(\d{1,2})/(\d{1,2})/(\d{4})", r"\3/\2/\1", text.strip()))[0]


FORMAT = register(
    Format(name="AFAD", title=N_("AFAD (Turkey)"), parse=read_afad, matches=is_afad, proves=("count", "peak", "unit", "sign", "instrument"))
)
