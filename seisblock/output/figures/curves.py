"""Drawing of long time histories: clipping to the view and decimation that keeps extrema."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from seisblock.core.typing import BoolArray, FloatArray, IntArray

MAX_POINTS = 4000
"""Points of a drawn curve, at most; longer curves are reduced to the extrema of bins."""


def draw_curve(axis: Axes, time: FloatArray, values: FloatArray, *, longest_gap: float | None = None, **style: Any) -> None:
    """Draw a curve, decimated with its extrema kept whenever the limits of the panel change.

    The vertical scale is that of the points between the limits of time, of all points where none were set: a rock that rolls on after
    the interval shown has a twist of thousands of degrees.

    Parameters
    ----------
    axis : Axes
    time, values : (n,) arrays
        Sorted by time; both sides of an event may share an instant.
    longest_gap : float, optional
        Gaps longer than this break the curve.
    style
        Properties of the line.
    """
    if longest_gap is not None:
        gaps = np.flatnonzero(np.abs(np.diff(time)) > longest_gap) + 1
        time, values = np.insert(time, gaps, time[gaps]), np.insert(values, gaps, np.nan)
    points = (time, values) if axis.get_autoscalex_on() else in_view(time, values, *axis.get_xlim())
    (line,) = axis.plot(*points, **{"linewidth": 0.9, **style})

    def show(panel: Axes) -> None:
        line.set_data(*decimate(*in_view(time, values, *panel.get_xlim())))

    show(axis)
    axis.callbacks.connect("xlim_changed", show)


def refine(
    time: FloatArray, values: FloatArray, slopes: FloatArray, coarse: BoolArray, parts: int = 8
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Refine a curve with known slopes at its coarse steps by cubic Hermite interpolation.

    Parameters
    ----------
    time, values, slopes : (n,) arrays
        Sorted by time; the slopes are the derivatives of the values.
    coarse : (n - 1,) array of bool
        Steps to be divided; steps of zero length (events) never are.
    parts : int
        Number of parts per step.

    Returns
    -------
    time, values, slopes : (m,) arrays
        Includes all original points.

    Examples
    --------
    >>> time, values, slopes = refine(np.array([0.0, 1.0]), np.array([0.0, 1.0]), np.array([0.0, 3.0]), np.array([True]), parts=2)
    >>> values.tolist(), slopes.tolist()  # t cubed
    ([0.0, 0.125, 1.0], [0.0, 0.75, 3.0])
    """
    step = np.diff(time)
    index = np.flatnonzero(coarse & (step > 0.0))[:, None]
    share = np.arange(1, parts) / parts
    left = 1.0 - share
    long, rise, first, last = step[index], np.diff(values)[index], slopes[index], slopes[index + 1]
    # cubic Hermite polynomial as chord plus deviation of the slopes at both ends
    first_off, last_off = long * first - rise, long * last - rise
    midpoints = values[index] + share * rise + share * left * (left * first_off - share * last_off)
    bent = (left * (left - 2.0 * share) * first_off + share * (share - 2.0 * left) * last_off) / long
    at = np.repeat(index[:, 0] + 1, share.size)
    inserted = (time[index] + share * long, midpoints, rise / long + bent)
    return tuple(np.insert(array, at, points.ravel()) for array, points in zip((time, values, slopes), inserted, strict=True))  # type: ignore[return-value]


def insert_crossings(time: FloatArray, values: FloatArray, level: float) -> tuple[FloatArray, FloatArray]:
    """Insert a point at every crossing of a level into a curve.

    Parameters
    ----------
    time, values : (n,) arrays
        Sorted by time.
    level : float

    Examples
    --------
    >>> time, values = insert_crossings(np.array([0.0, 1.0, 2.0]), np.array([0.0, 4.0, 4.0]), 1.0)
    >>> time.tolist(), values.tolist()
    ([0.0, 0.25, 1.0, 2.0], [0.0, 1.0, 4.0, 4.0])
    """
    difference = values - level
    # strict sign change: points exactly on the level need no crossing
    index = np.flatnonzero(difference[:-1] * difference[1:] < 0.0)
    at = time[index] + (time[index + 1] - time[index]) * difference[index] / (difference[index] - difference[index + 1])
    return np.insert(time, index + 1, at), np.insert(values, index + 1, level)


def in_view(time: FloatArray, values: FloatArray, first: float, last: float) -> tuple[FloatArray, FloatArray]:
    """Return the points of a curve between two times, and the adjacent point on each side."""
    inside = (time >= min(first, last)) & (time <= max(first, last))
    if inside.all():
        return time, values
    mask = inside.copy()
    mask[1:] |= inside[:-1]
    mask[:-1] |= inside[1:]
    if not inside.any():
        # view between two points, or outside all
        index = int(np.searchsorted(time, first))
        mask[max(index - 1, 0) : index + 1] = True
    return time[mask], values[mask]


def decimate(time: FloatArray, values: FloatArray, max_points: int = MAX_POINTS) -> tuple[FloatArray, FloatArray]:
    """Decimate a curve to about `max_points` points, keeping minimum and maximum of each bin.

    Parameters
    ----------
    time, values : (n,) arrays
        Sorted by time. Gaps (NaN in `values`) are kept.
    max_points : int
    """
    index = bin_extremes(time, values, max_points)
    return time[index], values[index]


def bin_extremes(time: FloatArray, values: FloatArray, max_points: int = MAX_POINTS) -> IntArray:
    """Return the indices of minimum and maximum of each bin of a curve, about `max_points` in all.

    Bins have equal width in time, not equal counts: a second of decaying impacts can have ten thousand rows, which would leave few
    points for the rest.

    Parameters
    ----------
    time, values : (n,) arrays
        Sorted by time.
    max_points : int

    Examples
    --------
    >>> bin_extremes(np.arange(8.0), np.array([0.0, 1.0, 5.0, 2.0, -3.0, 0.0, 0.0, 1.0]), max_points=4).tolist()
    [0, 2, 4, 7]
    """
    # two points per bin: minimum and maximum
    n = values.size
    if n <= max_points:
        return np.arange(n)
    bins, duration = max_points // 2, time[-1] - time[0]
    bin_number = (
        np.minimum(bins * ((time - time[0]) / duration), bins - 1).astype(np.int64) if duration > 0.0 else np.zeros(n, dtype=np.int64)
    )
    starts = np.flatnonzero(np.diff(bin_number, prepend=-1))
    bin_index = np.repeat(np.arange(starts.size), np.diff(starts, append=n))
    # NaN must win neither extreme; the first NaN of each gap is kept to break the line
    broken = np.isnan(values)
    lowest = _first_extremes(np.minimum.reduceat, np.where(broken, np.inf, values), starts, bin_index)
    highest = _first_extremes(np.maximum.reduceat, np.where(broken, -np.inf, values), starts, bin_index)
    gaps = np.flatnonzero(broken[1:] & ~broken[:-1]) + 1
    return np.unique(np.concatenate([[0], lowest, highest, gaps, [n - 1]]))


def _first_extremes(extreme: Callable[..., FloatArray], values: FloatArray, starts: IntArray, bin_index: IntArray) -> IntArray:
    """Return the index of the first extreme value in each bin."""
    # `hits` is sorted by bin, so that the first index of each unique bin is its first extreme
    hits = np.flatnonzero(values == extreme(values, starts)[bin_index])
    return hits[np.unique(bin_index[hits], return_index=True)[1]]
