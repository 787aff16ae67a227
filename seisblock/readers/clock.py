"""Whether a column of times is even, and its step."""

from __future__ import annotations

import numpy as np

from seisblock.errors import RecordFormatError
from seisblock.typing import FloatArray

TOLERANCE = 1e-6
"""How far, in s, a time may lie from its place on an even clock."""


def even_dt(name: str, seconds: FloatArray) -> float:
    """Return the sampling interval of a column of times, s.

    Among the intervals that fit, one of six digits or a whole number of samples per second is preferred: 0.02, not 0.020000000000000004.

    Raises
    ------
    RecordFormatError
        If there are fewer than two times, or one lies more than 1e-6 s from its even place.
    """
    count = seconds.size
    if count < 2:
        raise RecordFormatError(f"{name}: a record needs at least 2 samples, found {count}")
    dt = float(seconds[-1] - seconds[0]) / (count - 1)
    # the interval that most rows have shows which row is wrong; the mean only that one is
    usual = float(np.median(np.diff(seconds)))
    if not usual > 0.0:
        raise RecordFormatError(f"{name}: its time does not increase (step {usual:g} s): expected an even time in s")
    off = np.abs(seconds - (seconds[0] + dt * np.arange(count)))
    if off.max() > TOLERANCE * (1.0 + 1e-3) + 4.0 * np.finfo(float).eps * abs(seconds).max():
        row = int(np.argmax(np.abs(np.diff(seconds) - usual)))
        raise RecordFormatError(
            f"{name}: its time is uneven: from {seconds[row]:.9g} to {seconds[row + 1]:.9g} s, where most steps are {usual:.9g} s; "
            "expected steps even to 1e-6 s: resample the record"
        )
    for candidate in (float(f"{dt:.6g}"), 1.0 / round(1.0 / dt) if dt < 0.5 else dt):
        if abs(candidate - dt) * (count - 1) <= TOLERANCE:
            return candidate
    return dt
