"""Places and times as English headers write them: degrees with the letter of the hemisphere, days in words, clocks of California."""

from __future__ import annotations

import re
from datetime import UTC, datetime, timedelta

from seisblock.records.site import CLOCKS

_SEXAGESIMAL = re.compile(r"(\d{1,3})\s+(\d{1,2})\s+(\d{1,2}(?:\.\d+)?)\s*([NSEW])(?![A-Z])", re.IGNORECASE)
_DECIMAL = re.compile(r"(\d{1,3}\.\d*)\s*([NSEW])(?![A-Z])", re.IGNORECASE)
_MOMENT = re.compile(r"(\d{1,4})/(\d{1,2})/(\d{1,4}),?\s*(\d{1,2}):\s?(\d{1,2})(?::\s?(\d{1,2}(?:\.\d+)?))?\s*([A-Z]{2,4})?", re.IGNORECASE)
CENTURY = 70
"""Years of two digits from here on are of the 20th century."""


def degrees_of(text: str) -> tuple[float | None, float | None]:
    """Return latitude and longitude in a text, degrees north and east, None where it has none.

    Examples
    --------
    >>> degrees_of("STATION NO. 36456   35.908N, 120.458W     SMA-1"), degrees_of("Site X  42 31 12S  172 49 48E"), degrees_of("none")
    ((35.908, -120.458), (-42.52, 172.83), (None, None))
    """
    found: dict[str, float] = {}
    for degrees, minutes, seconds, letter in _SEXAGESIMAL.findall(text):
        found.setdefault(letter.upper(), round(float(degrees) + float(minutes) / 60.0 + float(seconds) / 3600.0, 5))
    for degrees, letter in _DECIMAL.findall(_SEXAGESIMAL.sub("", text)):
        found.setdefault(letter.upper(), float(degrees))
    latitude = found["N"] if "N" in found else -found["S"] if "S" in found else None
    longitude = found["E"] if "E" in found else -found["W"] if "W" in found else None
    return latitude, longitude


def moment_of(text: str) -> tuple[datetime | None, str]:
    """Return the first moment in a text, UTC, and the clock that tells it; None without a day and an hour.

    Parameters
    ----------
    text : str
        ``05/02/83, 16:42:48.2 PDT``, ``7/06/19, 03:16: 8.0 UTC (GPS)``, ``2018/11/30 17:29:29 UTC``: month, day and year, or the year
        first where it has four digits. A clock that is not known, or not told, is taken for UTC.

    Examples
    --------
    >>> moment, clock = moment_of("TRIGGER TIME: 05/02/83, 16:42:48.2 PDT")
    >>> moment.isoformat(), clock
    ('1983-05-02T23:42:48.200000+00:00', 'PDT')
    """
    match = _MOMENT.search(text)
    if match is None:
        return None, "UTC"
    clock = (match[7] or "UTC").upper()
    clock = clock if clock in CLOCKS else "UTC"
    first, second, third = (int(part) for part in match.group(1, 2, 3))
    year, month, day = (first, second, third) if len(match[1]) == 4 else (third, first, second)
    year += 0 if year > 99 else 1900 if year >= CENTURY else 2000
    return moment(year, month, day, int(match[4]), int(match[5]), float(match[6] or 0.0), clock), clock


def moment(year: int, month: int, day: int, hour: int, minute: int, second: float, clock: str = "UTC") -> datetime | None:
    """Return a moment that a clock tells, UTC, or None where there is no such time.

    Examples
    --------
    >>> moment(1989, 10, 18, 0, 4, 15.2).isoformat(), moment(1989, 13, 1, 0, 0, 0.0)
    ('1989-10-18T00:04:15.200000+00:00', None)
    """
    try:
        told = datetime(year, month, day, hour, minute, tzinfo=UTC) + timedelta(seconds=round(second, 6))
        return told - CLOCKS.get(clock, timedelta(0)) if 0.0 <= second < 61.0 else None
    except (ValueError, OverflowError):
        return None
