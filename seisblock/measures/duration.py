"""Duration above an acceleration threshold: total, longest interval, number of intervals."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.typing import FloatArray, IntArray
from seisblock.core.units import STANDARD_GRAVITY

Side = Literal["both", "positive", "negative"]


@dataclass(frozen=True, repr=False)
class Duration(DisplayMixin):
    """Time spent above a threshold.

    Parameters
    ----------
    threshold_m_s2 : float, m/s^2
        Threshold.
    total_s, longest_s : float, s
        Sum of all intervals, and the longest one.
    count : int
        Number of intervals.
    """

    threshold_m_s2: float
    total_s: float
    longest_s: float
    count: int


def block_threshold(width: float, height: float, *, gravity: float = STANDARD_GRAVITY) -> float:
    """Return the rocking threshold of a rectangular block, g B/H ([Furukawa2009]_ eq. (2)).

    Parameters
    ----------
    width, height : float, m
        B and H, positive.
    gravity : float, m/s^2

    Returns
    -------
    float, m/s^2

    Raises
    ------
    ParameterError
        If a size is not positive.

    Examples
    --------
    >>> from seisblock.measures import block_threshold
    >>> round(block_threshold(0.3, 0.9), 3)
    3.269
    """
    checks.positive("width of the block", width, "m")
    checks.positive("height of the block", height, "m")
    return gravity * width / height


def intervals_above(acceleration: FloatArray, dt: float, threshold: float, *, side: Side = "both") -> FloatArray:
    """Return the time intervals in which the acceleration exceeds a threshold, with interpolated crossings.

    Exact for linear interpolation between samples, which the solvers use, too. According to [Sugimoto2017]_ figs. 12, 13 and
    section 4.2, the duration above the rocking threshold has more influence on the jump of a block than the peak.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration.
    dt : float, s
        Sampling interval.
    threshold : float, m/s^2
        Positive.
    side : "both", "positive" or "negative"
        Compare the absolute value, the acceleration, or its negative.

    Returns
    -------
    (k, 2) array, s
        Start and end of each interval after the first sample, in chronological order.

    Raises
    ------
    ParameterError
        If the threshold is not positive.

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.measures import intervals_above
    >>> intervals_above(np.array([0.0, 2.0, 0.0, -2.0, 0.0]), 0.1, 1.0).round(3).tolist()
    [[0.05, 0.15], [0.25, 0.35]]
    """
    checks.positive("the threshold", threshold, "m/s^2")
    signs = {"both": (1.0, -1.0), "positive": (1.0,), "negative": (-1.0,)}.get(side)
    if signs is None:
        raise ParameterError("`side` must be both, positive or negative, found {side!r}", side=side)
    # intervals of opposite sign cannot overlap, because the threshold is positive
    intervals = np.concatenate([intervals_one_sided(acceleration, dt, np.array([threshold]), sign)[1] for sign in signs])
    result: FloatArray = intervals[intervals[:, 0].argsort()]
    return result


def duration_above(acceleration: FloatArray, dt: float, threshold: float, *, side: Side = "both") -> Duration:
    """Return total duration, longest interval and number of intervals above a threshold ([Sugimoto2017]_ section 4.2).

    Parameters
    ----------
    acceleration, dt, threshold, side
        As in :func:`intervals_above`.

    Returns
    -------
    Duration

    Raises
    ------
    ParameterError
        If the threshold is not positive.

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.measures import duration_above
    >>> duration_above(np.array([0.0, 2.0, 0.0, -2.0, 0.0]), 0.1, 1.0)
    Duration(threshold_m_s2=1.0, total_s=0.2, longest_s=0.1, count=2)
    """
    intervals = intervals_above(acceleration, dt, threshold, side=side)
    # differences of interpolated times carry round-off, which would show as 0.20000000000000007 s
    lengths = np.round(intervals[:, 1] - intervals[:, 0], 15)
    return Duration(float(threshold), float(lengths.sum()), float(lengths.max(initial=0.0)), int(lengths.size))


def intervals_one_sided(values: FloatArray, dt: float, thresholds: FloatArray, sign: float) -> tuple[IntArray, FloatArray]:
    """Return the intervals, s, in which piecewise linear values times a sign reach thresholds, without those of length zero.

    Parameters
    ----------
    values : (n,) array
    dt : float, s
    thresholds : (m,) array
        Positive; infinite ones are never reached.
    sign : float
        +1 or -1.

    Returns
    -------
    threshold : (k,) array of int
        Number of the threshold of each interval, ascending.
    intervals : (k, 2) array, s
        Start and end, in chronological order for each threshold.
    """
    order = np.argsort(thresholds)
    levels = thresholds[order]
    # number of thresholds reached at each sample; one threshold needs no temporary row of floats, for day-long records
    if levels.size == 1:
        reached = (values >= levels[0] if sign > 0.0 else values <= -levels[0]).view(np.int8)
    else:
        reached = np.searchsorted(levels, sign * values, side="right")
    changes = np.flatnonzero(reached[1:] != reached[:-1])
    before, after = reached[changes].astype(np.int64), reached[changes + 1].astype(np.int64)
    counts = np.abs(after - before)
    # a step over several thresholds crosses each of them
    first = np.cumsum(counts) - counts
    samples = np.repeat(changes, counts)
    crossed = np.arange(samples.size) + np.repeat(np.minimum(before, after) - first, counts)
    # zeros of the linear interpolant
    excess, next_excess = sign * values[samples] - levels[crossed], sign * values[samples + 1] - levels[crossed]
    times = dt * (samples + excess / (excess - next_excess))
    # intervals cut by the ends of the record
    at_start, at_end = int(reached[0]), int(reached[-1])
    times = np.concatenate((np.zeros(at_start), times, np.full(at_end, dt * (values.size - 1))))
    index = order[np.concatenate((np.arange(at_start), crossed, np.arange(at_end)))]
    # crossings of one threshold alternate between starts and ends
    by_threshold = np.argsort(index, kind="stable")
    intervals = times[by_threshold].reshape(-1, 2)
    is_longer = intervals[:, 1] > intervals[:, 0]
    return index[by_threshold][::2][is_longer], intervals[is_longer]
