"""Values of headers: numbers, coordinates, times, magnitudes."""

from __future__ import annotations

import re
from collections.abc import Mapping
from datetime import UTC, datetime, timedelta
from math import isfinite

from seisblock.records.site import UTC_OFFSETS

JST = timedelta(hours=9)
"""Japan Standard Time ahead of UTC."""

MAX_COUNT = 2.0**53
"""Largest sample count or raw value accepted; beyond it float64 does not represent all integers."""

_SEXAGESIMAL = re.compile(r"(\d{1,3})\s+(\d{1,2})\s+(\d{1,2}(?:\.\d+)?)\s*([NSEW])(?![A-Z])", re.IGNORECASE)
_DECIMAL = re.compile(r"(\d{1,3}\.\d*)\s*([NSEW])(?![A-Z])", re.IGNORECASE)
_DATETIME = re.compile(
    r"(\d{1,4})/(\d{1,2})/(\d{1,4}),?\s*(\d{1,2}):\s?(\d{1,2})(?::\s?(\d{1,2}(?:\.\d+)?))?\s*([A-Z]{2,4})?", re.IGNORECASE
)
PIVOT_YEAR = 70
"""Two-digit years from here on are of the 20th century."""


def parse_number(text: str) -> float | None:
    """Return a finite number, or None if the text is not one."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if isfinite(value) else None


def parse_jst(text: str) -> datetime | None:
    """Return the UTC time of ``yyyy/mm/dd HH:MM:SS[.ff]`` JST, or None if the text is not a time."""
    for form in ("%Y/%m/%d %H:%M:%S.%f", "%Y/%m/%d %H:%M:%S"):
        try:
            return datetime.strptime(text.strip(), form).replace(tzinfo=UTC) - JST
        except ValueError:
            continue
    return None


def parse_coordinates(text: str) -> tuple[float | None, float | None]:
    """Return latitude and longitude in a text, degrees north and east; None where missing, or both if both are zero.

    Examples
    --------
    >>> parse_coordinates("STATION NO. 36456   35.908N, 120.458W     SMA-1"), parse_coordinates("none")
    ((35.908, -120.458), (None, None))
    >>> parse_coordinates("Site X  42 31 12S  172 49 48E"), parse_coordinates("STATION NO.  0.000N    0.000E  QDR")
    ((-42.52, 172.83), (None, None))
    """
    degrees_by_letter: dict[str, float] = {}
    for degrees, minutes, seconds, letter in _SEXAGESIMAL.findall(text):
        # 1e-5 degrees are about a metre
        degrees_by_letter.setdefault(letter.upper(), round(float(degrees) + float(minutes) / 60.0 + float(seconds) / 3600.0, 5))
    for degrees, letter in _DECIMAL.findall(_SEXAGESIMAL.sub("", text)):
        degrees_by_letter.setdefault(letter.upper(), float(degrees))
    latitude = degrees_by_letter["N"] if "N" in degrees_by_letter else -degrees_by_letter["S"] if "S" in degrees_by_letter else None
    longitude = degrees_by_letter["E"] if "E" in degrees_by_letter else -degrees_by_letter["W"] if "W" in degrees_by_letter else None
    # recorders without a position print zeros
    return (latitude, longitude) if latitude or longitude else (None, None)


def parse_datetime(text: str) -> tuple[datetime | None, str]:
    """Return the first time in a text, UTC, and the name of its clock; None without date and hour.

    Parameters
    ----------
    text : str
        ``05/02/83, 16:42:48.2 PDT``, ``7/06/19, 03:16: 8.0 UTC (GPS)``, ``2018/11/30 17:29:29 UTC``: month, day and year, or the year
        first if it has four digits. An unknown or missing clock is taken as UTC.

    Examples
    --------
    >>> moment, clock = parse_datetime("TRIGGER TIME: 05/02/83, 16:42:48.2 PDT")
    >>> moment.isoformat(), clock
    ('1983-05-02T23:42:48.200000+00:00', 'PDT')
    """
    match = _DATETIME.search(text)
    if match is None:
        return None, "UTC"
    clock = (match[7] or "UTC").upper()
    # unknown abbreviations cannot be converted
    clock = clock if clock in UTC_OFFSETS else "UTC"
    first, second, third = (int(part) for part in match.group(1, 2, 3))
    year, month, day = (first, second, third) if len(match[1]) == 4 else (third, first, second)
    year += 0 if year > 99 else 1900 if year >= PIVOT_YEAR else 2000
    return utc_datetime(year, month, day, int(match[4]), int(match[5]), float(match[6] or 0.0), clock), clock


def utc_datetime(year: int, month: int, day: int, hour: int, minute: int, second: float, clock: str = "UTC") -> datetime | None:
    """Return the UTC time of a clock reading, or None if the date or time is invalid.

    Examples
    --------
    >>> utc_datetime(1989, 10, 18, 0, 4, 15.2).isoformat(), utc_datetime(1989, 13, 1, 0, 0, 0.0)
    ('1989-10-18T00:04:15.200000+00:00', None)
    """
    try:
        local_time = datetime(year, month, day, hour, minute, tzinfo=UTC) + timedelta(seconds=round(second, 6))
        # seconds up to 61: leap seconds
        return local_time - UTC_OFFSETS.get(clock, timedelta(0)) if 0.0 <= second < 61.0 else None
    except (ValueError, OverflowError):
        return None


def parse_magnitude(text: str) -> dict[str, object]:
    """Return metadata with the magnitude in a text, Mw before ML before Ms.

    Examples
    --------
    >>> parse_magnitude("MS=6.6(NEIC), MW=6.4(CIT)"), parse_magnitude("ML:  To be determined.")
    ({'magnitude': 6.4}, {})
    """
    magnitudes = {
        kind.upper(): parse_number(value.rstrip(".")) for kind, value in re.findall(r"\b(M[WLS]?)\s*=\s*(\d[\d.]*)", text, re.IGNORECASE)
    }
    magnitude = next((magnitudes[kind] for kind in ("MW", "ML", "MS", "M") if magnitudes.get(kind)), None)
    return {} if magnitude is None else {"magnitude": magnitude}


def search_group(pattern: str, text: str) -> str:
    """Return the first group of a pattern found anywhere in a text, ignoring case; empty if there is none."""
    match = re.search(pattern, text, re.IGNORECASE)
    return match[1] if match else ""


def drop_missing(values: Mapping[str, object]) -> dict[str, object]:
    """Return header entries without those that are None or empty."""
    return {key: value for key, value in values.items() if value not in (None, "")}
