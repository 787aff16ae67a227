"""A column of times that are told by a clock: ``16:10:10.25``, ``2024-01-01T16:10:10Z``, ``2024/1/1 16:10:10.250``."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, date, datetime, timedelta

DAY_S = 86400
BEGINNING = datetime(1000, 1, 1, tzinfo=UTC)
LATEST = 9000
"""From when on, and up to which year, a clock is believed: a zone's hours lead out of neither end of the calendar."""

_MOMENT = re.compile(
    r"[\"']?(?:(\d{4})([-/])(\d{1,2})\2(\d{1,2})(?:[T ]|\s+))?"
    r"(\d{1,2}):(\d\d):(\d\d)(?:\.(\d*))?\s*(Z|UTC|GMT|JST|[-+]\d\d(?::?\d\d)?)?[\"']?",
    re.IGNORECASE,
)
_ZONES = {"Z": 0, "UTC": 0, "GMT": 0, "JST": 9 * 3600}


@dataclass(frozen=True)
class Moment:
    """What a clock tells.

    Parameters
    ----------
    seconds : int
        Since the beginning of the day, or, where the date is told, of the year 1000; of the hour at Greenwich where the zone is told.
    fraction : str
        Of a second, the digits as printed.
    dated : bool
    zone_s : int or None, s
        Ahead of UTC, None where it is not told.
    """

    seconds: int
    fraction: str
    dated: bool
    zone_s: int | None

    @property
    def utc(self) -> datetime | None:
        """The moment, taken for UTC where no zone is told; None without a date."""
        if not self.dated:
            return None
        return BEGINNING + timedelta(seconds=self.seconds, microseconds=int(f"{self.fraction:0<6}"[:6]))


def moment_in(cell: str) -> Moment | None:
    """Return what a clock tells in a cell, or None.

    Examples
    --------
    >>> moment_in("2024-01-01T16:10:10.25+09:00").utc.isoformat(), moment_in("00:01:02.5").seconds, moment_in("0.25")
    ('2024-01-01T07:10:10.250000+00:00', 62, None)
    """
    match = _MOMENT.fullmatch(cell.strip())
    if match is None:
        return None
    hour, minute, second = (int(part) for part in match.group(5, 6, 7))
    if hour > 23 or minute > 59 or second > 59:
        return None
    zone = _zone(match[9])
    seconds = 3600 * hour + 60 * minute + second - (zone or 0)
    if match[1]:
        if not BEGINNING.year < int(match[1]) < LATEST:
            return None
        try:
            seconds += DAY_S * (date(int(match[1]), int(match[3]), int(match[4])) - BEGINNING.date()).days
        except ValueError:  # no such day
            return None
    return Moment(seconds, match[8] or "", bool(match[1]), zone)


def seconds_instead(index: int, separator: str | None, first: Moment) -> Callable[[str], str]:
    """Return what puts seconds since the first moment, cut to whole ones, in the place of the moments of a column.

    The digits of the fraction stay as they are printed. Clocks without a date go on after midnight. A cell that tells no time stays, to be
    refused with its line.

    Parameters
    ----------
    index : int
        Of the column.
    separator : str or None
        Between cells.
    first : Moment
        That of the first line.
    """

    def changed(line: str) -> str:
        cells = line.split(separator)
        told = moment_in(cells[index]) if index < len(cells) else None
        if told is None or told.dated != first.dated or (told.zone_s is None) != (first.zone_s is None):
            return line
        since = told.seconds - first.seconds
        cells[index] = f"{since if first.dated else since % DAY_S}.{told.fraction}"
        return (separator or " ").join(cells)

    return changed


def _zone(text: str | None) -> int | None:
    """Return how far a zone is ahead of UTC, s."""
    if not text:
        return None
    if text.upper() in _ZONES:
        return _ZONES[text.upper()]
    digits = text[1:].replace(":", "").ljust(4, "0")
    return (-1 if text[0] == "-" else 1) * (3600 * int(digits[:2]) + 60 * int(digits[2:]))
