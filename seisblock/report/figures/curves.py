"""Curves against time: cut to what their panel shows, then thinned, so that what is seen is what was computed at any length."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from seisblock.core.typing import BoolArray, FloatArray, IntArray

MAX_POINTS = 4000
"""What is shown of a curve, if it is more than this, is reduced to the extrema of its bins, so that no peak is lost."""


def draw_curve(axis: Axes, time: FloatArray, values: FloatArray, *, longest_gap: float | None = None, **style: Any) -> None:
    """Draw a curve that holds every point in view, or every peak where there are too many, whenever the panel's limits change.

    Parameters
    ----------
    axis : Axes
    time, values : (n,) arrays
        In the order of time; the two sides of an event may share an instant.
    longest_gap : float, optional
        The curve is broken where two points are further apart.
    style
        Of the line.
    """
    if longest_gap is not None:
        gaps = np.flatnonzero(np.abs(np.diff(time)) > longest_gap) + 1
        time, values = np.insert(time, gaps, time[gaps]), np.insert(values, gaps, np.nan)
    # the whole curve first: the panel's own limits are those of all of it
    (line,) = axis.plot(time, values, **{"linewidth": 0.9, **style})

    def show(panel: Axes) -> None:
        line.set_data(*decimate(*in_view(time, values, *panel.get_xlim())))

    show(axis)
    axis.callbacks.connect("xlim_changed", show)


def refine(
    time: FloatArray, values: FloatArray, slopes: FloatArray, coarse: BoolArray, parts: int = 8
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return a curve whose slopes are known with more points, where it is coarse: on the cubic through both ends of a step.

    Parameters
    ----------
    time, values, slopes : (n,) arrays
        In the order of time; the slopes are the derivatives of the values.
    coarse : (n - 1,) array of bool
        Which steps are divided; those between the two sides of an event never are.
    parts : int
        Into how many.

    Returns
    -------
    time, values, slopes : (m,) arrays
        With all of the points that were given.

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
    # Hermite's cubic, as the chord and what bends it at either end
    first_off, last_off = long * first - rise, long * last - rise
    midpoints = values[index] + share * rise + share * left * (left * first_off - share * last_off)
    bent = (left * (left - 2.0 * share) * first_off + share * (share - 2.0 * left) * last_off) / long
    at = np.repeat(index[:, 0] + 1, share.size)
    inserted = (time[index] + share * long, midpoints, rise / long + bent)
    return tuple(np.insert(array, at, points.ravel()) for array, points in zip((time, values, slopes), inserted, strict=True))  # type: ignore[return-value]


def insert_crossings(time: FloatArray, values: FloatArray, level: float) -> tuple[FloatArray, FloatArray]:
    """Return a curve, (n,), with a point of its own wherever it passes a level.

    Parameters
    ----------
    time, values : (n,) arrays
        In the order of time.
    level : float

    Examples
    --------
    >>> time, values = insert_crossings(np.array([0.0, 1.0, 2.0]), np.array([0.0, 4.0, 4.0]), 1.0)
    >>> time.tolist(), values.tolist()
    ([0.0, 0.25, 1.0, 2.0], [0.0, 1.0, 4.0, 4.0])
    """
    difference = values - level
    index = np.flatnonzero(difference[:-1] * difference[1:] < 0.0)
    at = time[index] + (time[index + 1] - time[index]) * difference[index] / (difference[index] - difference[index + 1])
    return np.insert(time, index + 1, at), np.insert(values, index + 1, level)


def in_view(time: FloatArray, values: FloatArray, first: float, last: float) -> tuple[FloatArray, FloatArray]:
    """Return the points of a curve between two times, and the next one on each side, which the line runs to."""
    inside = (time >= min(first, last)) & (time <= max(first, last))
    if inside.all():
        return time, values
    mask = inside.copy()
    mask[1:] |= inside[:-1]
    mask[:-1] |= inside[1:]
    if not inside.any():
        # the view lies between two points, or beyond all
        index = int(np.searchsorted(time, first))
        mask[max(index - 1, 0) : index + 1] = True
    return time[mask], values[mask]


def decimate(time: FloatArray, values: FloatArray, max_points: int = MAX_POINTS) -> tuple[FloatArray, FloatArray]:
    """Return a curve of at most about so many points that keeps each bin's minimum and maximum, in their order of time.

    Parameters
    ----------
    time, values : (n,) arrays
        In the order of time. Where `values` is not a number the curve is broken, and stays so.
    max_points : int
    """
    index = bin_extremes(time, values, max_points)
    return time[index], values[index]


def bin_extremes(time: FloatArray, values: FloatArray, max_points: int = MAX_POINTS) -> IntArray:
    """Return which points of a curve stand for all of them: the lowest and the highest of each of its bins, about so many in all.

    Bins are of equal width in time. Of equal number they would leave a quiet minute few points where a second of ever smaller hops has
    ten thousand.

    Parameters
    ----------
    time, values : (n,) arrays
        In the order of time.
    max_points : int

    Examples
    --------
    >>> bin_extremes(np.arange(8.0), np.array([0.0, 1.0, 5.0, 2.0, -3.0, 0.0, 0.0, 1.0]), max_points=4).tolist()
    [0, 2, 4, 7]
    """
    n = values.size
    if n <= max_points:
        return np.arange(n)
    bins, duration = max_points // 2, time[-1] - time[0]
    bin_number = (
        np.minimum(bins * ((time - time[0]) / duration), bins - 1).astype(np.int64) if duration > 0.0 else np.zeros(n, dtype=np.int64)
    )
    starts = np.flatnonzero(np.diff(bin_number, prepend=-1))
    bin_index = np.repeat(np.arange(starts.size), np.diff(starts, append=n))
    broken = np.isnan(values)
    lowest = _first_extremes(np.minimum.reduceat, np.where(broken, np.inf, values), starts, bin_index)
    highest = _first_extremes(np.maximum.reduceat, np.where(broken, -np.inf, values), starts, bin_index)
    gaps = np.flatnonzero(broken[1:] & ~broken[:-1]) + 1
    return np.unique(np.concatenate([[0], lowest, highest, gaps, [n - 1]]))


def _first_extremes(extreme: Callable[..., FloatArray], values: FloatArray, starts: IntArray, bin_index: IntArray) -> IntArray:
    """Return where in each bin its extreme value stands first."""
    hits = np.flatnonzero(values == extreme(values, starts)[bin_index])
    return hits[np.unique(bin_index[hits], return_index=True)[1]]
