"""Time columns of tables: clock times, and the sampling interval, even within the printed digits."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import UTC, date, datetime, timedelta

import numpy as np

from seisblock.core.errors import RecordFormatError
from seisblock.core.typing import FloatArray

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

    `seconds` count from midnight, or from the year 1000 if a date is given, in UTC if a zone is given; `fraction` has the decimals of the
    second, as printed; `utc_offset_s` is the offset ahead of UTC, s, None if not given.
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
    """Return a function that replaces the clock times in column `index` of a line by whole seconds since the first.

    The printed digits of the fraction are kept. Times without a date continue past midnight. A cell without a time is unchanged and fails
    later, with its line.
    """

    def replace_cell(line: str) -> str:
        cells = line.split(separator)
        timestamp = parse_timestamp(cells[index]) if index < len(cells) else None
        if timestamp is None or timestamp.has_date != first.has_date or (timestamp.utc_offset_s is None) != (first.utc_offset_s is None):
            return line
        # a time of day before the first one belongs to the next day
        elapsed_s = timestamp.seconds - first.seconds
        elapsed_s = elapsed_s if first.has_date else elapsed_s % DAY_S
        fraction = f".{timestamp.fraction}"
        cells[index] = f"{elapsed_s}{fraction}" if elapsed_s >= 0 else str(elapsed_s + float(f"0{fraction}"))
        return (separator or " ").join(cells)

    return replace_cell


def _parse_zone(text: str | None) -> int | None:
    if not text:
        return None
    if text.upper() in _ZONES:
        return _ZONES[text.upper()]
    digits = text[1:].replace(":", "").ljust(4, "0")
    return (-1 if text[0] == "-" else 1) * (3600 * int(digits[:2]) + 60 * int(digits[2:]))


TIME_TOLERANCE = 1e-6
"""Tolerance of sample times against an even spacing, s, where more digits are printed."""

MIN_ROUNDED_STEPS, MIN_ROUNDED_SHARE = 3, 0.05
"""Number and ratio of irregular steps required to attribute them to rounding of the printed times."""

_NUMBER = re.compile(r"[-+]?(\d*)\.?(\d*)(?:[eEdD]([-+]?\d+))?")


def sampling_interval(
    name: str, times: FloatArray, printed_times: Callable[[], Sequence[str]] | None = None, *, unit: float = 1.0
) -> float:
    """Return the sampling interval of a time column, s.

    Of the intervals that fit, one with six digits or a whole number of samples per second is preferred: 0.02, not 0.020000000000000004.
    Times printed with few digits (100.001, 100.002, 100.004 for steps of 0.00125 s) are even if such an interval explains each of them to
    half a unit of its last digit. `times`, (n,), are in `unit`, s; `printed_times` returns them as printed in the file and is called only
    if they are not even to 1e-6 s. Raise RecordFormatError if there are fewer than two times, or they are not evenly spaced.
    """
    seconds = times if unit == 1.0 else times * unit
    count = seconds.size
    if count < 2:
        raise RecordFormatError("{name}: a record needs at least 2 samples, found {count}", name=name, count=count)
    dt = float(seconds[-1] - seconds[0]) / (count - 1)
    # the median step locates an irregular row; the mean only shows that there is one
    median_step = float(np.median(np.diff(seconds), overwrite_input=True))
    deviations = np.arange(count, dtype=np.float64)
    deviations *= dt
    deviations += seconds[0]
    deviations -= seconds
    np.abs(deviations, out=deviations)
    # 4 eps of the largest time: rounding of times far from zero
    if median_step > 0.0 and deviations.max() <= TIME_TOLERANCE * (1.0 + 1e-3) + 4.0 * np.finfo(float).eps * max(
        seconds.max(), -seconds.min()
    ):
        return next((candidate for candidate in _round_intervals(dt) if abs(candidate - dt) * (count - 1) <= TIME_TOLERANCE), dt)
    if printed_times is not None and dt > 0.0:
        # second attempt: even within the rounding of the printed times
        slack = unit * half_last_digits(printed_times())
        for candidate in _round_intervals(dt, digits=4):
            if _is_even_within_rounding(candidate, seconds, slack):
                return candidate
    steps = np.diff(seconds)
    repeat_count = int(np.count_nonzero(steps == 0.0))
    if steps.min() >= 0.0 and repeat_count > max(MIN_ROUNDED_STEPS, MIN_ROUNDED_SHARE * steps.size):
        message = (
            "{name}: too few digits in the time column: {repeats} of {count} times repeat the previous line (first: {first:g} s); "
            "write more digits, or remove the column and give the sampling interval with `dt`, in s"
        )
        raise RecordFormatError(message, name=name, repeats=repeat_count, count=count, first=seconds[int(np.argmin(steps))])
    if not median_step > 0.0:
        raise RecordFormatError(
            "{name}: time column does not increase (usual step {usual:g} s): expected evenly increasing times", name=name, usual=median_step
        )
    row = int(np.argmax(np.abs(steps - median_step)))
    message = (
        "{name}: uneven time column: step from {first:.9g} to {second:.9g} s, usual step {usual:.9g} s (line missing or "
        "duplicate, or uneven sampling); expected equal steps within 1e-6 s or the printed digits"
    )
    raise RecordFormatError(message, name=name, first=seconds[row], second=seconds[row + 1], usual=median_step)


def half_last_digits(texts: Sequence[str]) -> FloatArray:
    """Return half a unit of the last printed digit of each number, (n,), in the unit of the numbers.

    A program prints a fixed number of decimals, or a fixed number of significant digits without trailing zeros: the maximum of either
    over all numbers is the printed precision.

    Examples
    --------
    >>> half_last_digits(["0.00125", "0.0025", "100.001"])
    array([5.e-06, 5.e-06, 5.e-04])
    """
    decimal_places, leading_exponents, significant_digits = [], [], []
    for text in texts:
        match = _NUMBER.fullmatch(text)
        integer_part, fraction, exponent = (match[1], match[2], int(match[3] or 0)) if match else ("", "", 0)
        digits = (integer_part + fraction).lstrip("0")
        decimal_places.append(len(fraction) - exponent)
        significant_digits.append(len(digits))
        leading_exponents.append(len(digits) - len(fraction) + exponent)  # first digit: 10**(exponent - 1)
    max_decimals, max_significant = max(decimal_places, default=0), max(significant_digits, default=1)
    return 0.5 * 10.0 ** np.maximum(-float(max_decimals), np.array(leading_exponents, dtype=np.float64) - max_significant)


def _round_intervals(dt: float, *, digits: int = 6) -> tuple[float, ...]:
    """Return plausible recorder intervals near a mean step: few digits, or a whole number of samples per second."""
    rounded = float(f"{dt:.{digits}g}")
    return (rounded, 1.0 / round(1.0 / dt)) if 0.0 < dt < 0.5 else (rounded,)


def _is_even_within_rounding(dt: float, seconds: FloatArray, slack: FloatArray) -> bool:
    """Return whether times are evenly spaced within half a unit of their last digit.

    Rounding affects many steps; one or two irregular steps are a missing or a repeated line. The start time may be rounded, too.
    """
    steps = np.diff(seconds)
    irregular = np.count_nonzero(np.abs(steps - np.median(steps)) > 1e-3 * dt)
    if irregular < max(MIN_ROUNDED_STEPS, MIN_ROUNDED_SHARE * steps.size):
        return False
    slack = slack + 1e-9 + 4.0 * np.finfo(float).eps * np.abs(seconds)
    start_offsets = seconds - dt * np.arange(seconds.size)
    # some start time lies within the rounding of every sample
    return bool((start_offsets - slack).max() <= (start_offsets + slack).min())
