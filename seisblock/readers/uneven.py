"""Pairs of time and acceleration as evenly spaced samples, of film records and of telephones."""

from __future__ import annotations

import numpy as np

from seisblock.core.errors import RecordFormatError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.readers.limits import MAX_RESAMPLED

_EVEN_SLACK = 0.51
"""Deviation from even times due to printing, units of the last digit."""


def resample_pairs(
    name: str, times: FloatArray, rows: list[FloatArray], resolution: float, *, dt: float | None = None
) -> tuple[float, float, list[FloatArray], tuple[str, ...]]:
    """Return start, s, sampling interval, s, samples, and history entries of pairs of time and acceleration.

    Parameters
    ----------
    name : str
        File in messages.
    times : (n,) array, s
        Printed with `resolution`; must not decrease.
    rows : list of (n,) array
        Values of each component.
    resolution : float, s
        Unit of the last digit of the times.
    dt : float or None, s
        Interval of uneven samples; by default `resolution`, which keeps every value: the motion is linear in between.

    Raises
    ------
    RecordFormatError
        If times decrease, do not increase at all, or give too many samples.
    """
    steps = np.diff(times)
    if steps.size == 0 or steps.min() < -0.5 * resolution or times[-1] <= times[0]:
        place = int(np.argmin(steps)) if steps.size else 0
        message = "{name}: time {time:g} s is followed by an earlier time; expected increasing times"
        raise RecordFormatError(message, name=name, time=float(times[place]))
    # a mean interval is known better than a single step; simple ratios are tried first
    mean = float(times[-1] - times[0]) / steps.size
    for interval in (1.0 / round(1.0 / mean) if mean < 0.5 else mean, float(f"{mean:.4g}"), mean):
        if np.abs(times - times[0] - interval * np.arange(times.size)).max() <= _EVEN_SLACK * resolution:
            return float(times[0]), interval, rows, ()
    interval = resolution if dt is None else dt
    count = round((times[-1] - times[0]) / interval) + 1
    if count > MAX_RESAMPLED:
        raise RecordFormatError("{name}: {count} samples after resampling, too many; check the times", name=name, count=count)
    # of equal times, the last value
    # film records hold vertical strokes, two values at one time
    unique_times, places = np.unique(times[::-1], return_index=True)
    grid = times[0] + interval * np.arange(count)
    samples = [np.interp(grid, unique_times, row[::-1][places]) for row in rows]
    largest = float(steps.max())
    entry = lazy_gettext(
        "uneven samples (largest interval {largest:.3g} s) interpolated linearly at {dt:g} s; not resolved above {band:.3g} Hz",
        largest=largest,
        dt=interval,
        band=0.5 / largest,
    )
    return float(times[0]), interval, samples, (entry,)
