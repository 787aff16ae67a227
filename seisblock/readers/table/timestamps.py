"""Clock times in a column: ``16:10:10.25``, ``2024-01-01T16:10:10Z``, ``2024/1/1 16:10:10.250``."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, date, datetime, timedelta

DAY_S = 86400
EPOCH = datetime(1000, 1, 1, tzinfo=UTC)
MAX_YEAR = 9000
"""Origin of the seconds and last accepted year; far enough from the calendar limits for any zone offset."""

_TIMESTAMP = re.compile(
    r"[\"']?(?:(\d{4})([-/])(\d{1,2})\2(\d{1,2})(?:[T ]|\s+))?"
    r"(\d{1,2}):(\d\d):(\d\d)(?:\.(\d*))?\s*(Z|UTC|GMT|JST|[-+]\d\d(?::?\d\d)?)?[\"']?",
    re.IGNORECASE,
)
_ZONES = {"Z": 0, "UTC": 0, "GMT": 0, "JST": 9 * 3600}


@dataclass(frozen=True)
class Timestamp:
    """Clock time of one cell.

    Parameters
    ----------
    seconds : int
        Seconds since midnight, or since the year 1000 if a date is given; in UTC if a zone is given.
    fraction : str
        Decimals of the second, as printed.
    has_date : bool
    utc_offset_s : int or None, s
        Offset ahead of UTC; None if not given.
    """

    seconds: int
    fraction: str
    has_date: bool
    utc_offset_s: int | None

    @property
    def utc(self) -> datetime | None:
        """Time in UTC, assumed if no zone is given; None without a date."""
        if not self.has_date:
            return None
        return EPOCH + timedelta(seconds=self.seconds, microseconds=int(f"{self.fraction:0<6}"[:6]))


def parse_timestamp(cell: str) -> Timestamp | None:
    """Return the clock time in a cell, or None.

    Examples
    --------
    >>> parse_timestamp("2024-01-01T16:10:10.25+09:00").utc.isoformat(), parse_timestamp("00:01:02.5").seconds, parse_timestamp("0.25")
    ('2024-01-01T07:10:10.250000+00:00', 62, None)
    """
    match = _TIMESTAMP.fullmatch(cell.strip())
    if match is None:
        return None
    hour, minute, second = (int(part) for part in match.group(5, 6, 7))
    if hour > 23 or minute > 59 or second > 59:
        return None
    zone = _parse_zone(match[9])
    # integer seconds: decimals stay in the printed digits of the fraction
    seconds = 3600 * hour + 60 * minute + second - (zone or 0)
    if match[1]:
        if not EPOCH.year < int(match[1]) < MAX_YEAR:
            return None
        try:
            seconds += DAY_S * (date(int(match[1]), int(match[3]), int(match[4])) - EPOCH.date()).days
        except ValueError:  # no such day
            return None
    return Timestamp(seconds, match[8] or "", bool(match[1]), zone)


def seconds_replacer(index: int, separator: str | None, first: Timestamp) -> Callable[[str], str]:
    """Return a function that replaces the clock times of a column by whole seconds since the first, in a line.

    The printed digits of the fraction are kept. Times without a date continue past midnight. A cell without a time is unchanged and fails
    later, with its line.

    Parameters
    ----------
    index : int
        Index of the column.
    separator : str or None
        Cell separator.
    first : Timestamp
        Time of the first line.
    """

    def replace_cell(line: str) -> str:
        cells = line.split(separator)
        timestamp = parse_timestamp(cells[index]) if index < len(cells) else None
        if timestamp is None or timestamp.has_date != first.has_date or (timestamp.utc_offset_s is None) != (first.utc_offset_s is None):
            return line
        # a time of day before the first one belongs to the next day
        elapsed_s = timestamp.seconds - first.seconds
        cells[index] = f"{elapsed_s if first.has_date else elapsed_s % DAY_S}.{timestamp.fraction}"
        return (separator or " ").join(cells)

    return replace_cell


def _parse_zone(text: str | None) -> int | None:
    if not text:
        return None
    if text.upper() in _ZONES:
        return _ZONES[text.upper()]
    digits = text[1:].replace(":", "").ljust(4, "0")
    return (-1 if text[0] == "-" else 1) * (3600 * int(digits[:2]) + 60 * int(digits[2:]))
