"""Shaking of a motion seen by one body: peaks, equivalent frequency, and the time above the acceleration at which the body moves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from seisblock.core.registry import get_solver
from seisblock.core.results import Response
from seisblock.core.typing import FloatArray
from seisblock.measures.duration import intervals_one_sided
from seisblock.measures.summary import MotionPeaks, conventions_of, motion_peaks
from seisblock.records.motion import Motion


class Thresholds(NamedTuple):
    """Accelerations, m/s^2, at which a body at rest starts to move to +x and to -x; infinite where it does not.

    Motion to +x starts when the acceleration of the ground to -x reaches `right`, motion to -x when that to +x reaches `left`.
    """

    right: float
    left: float


@dataclass(frozen=True)
class BodyShaking:
    """Shaking of one motion and the time above the threshold of one body ([Furukawa2009]_ section 3(5)e, [Sugimoto2017]_ section 4.2).

    Parameters
    ----------
    pga_m_s2, pgv_m_s : float
        Peak acceleration and velocity of the horizontal motion, as in ``seisblock measure``.
    equivalent_frequency_hz : float or None
        PGA/(2 pi PGV); null without motion.
    threshold_m_s2 : float or None
        Horizontal acceleration at which the body starts to move, without vertical motion: to rock, to slip, or to lift. The smaller one
        of the two directions; null if there is none.
    time_above_threshold_s, longest_above_threshold_s : float or None
        Total time above the threshold of the direction, and the longest interval, for linear interpolation between samples; null without
        a threshold.
    """

    pga_m_s2: float
    pgv_m_s: float
    equivalent_frequency_hz: float | None
    threshold_m_s2: float | None
    time_above_threshold_s: float | None
    longest_above_threshold_s: float | None


def shaking_of(motion: Motion, thresholds: tuple[float, float], *, peaks: MotionPeaks | None = None) -> BodyShaking:
    """Return the shaking of a motion for a body with given thresholds to +x and to -x.

    The vertical motion is not considered: the thresholds are those of the body under its static weight.

    Parameters
    ----------
    motion : Motion
    thresholds : two floats, m/s^2
        To +x and to -x, see :class:`Thresholds`; a threshold that is infinite or not positive is none.
    peaks : MotionPeaks, optional
        Peaks of the motion, if they are known.

    Examples
    --------
    >>> motion = Motion.from_arrays([0.0, 2.0, 0.0, -2.0, 0.0], 0.1)
    >>> shaking = shaking_of(motion, Thresholds(right=1.0, left=1.5))
    >>> shaking.threshold_m_s2, round(shaking.time_above_threshold_s, 12), round(shaking.longest_above_threshold_s, 12)
    (1.0, 0.15, 0.1)
    """
    return shakings_of(motion, [thresholds], peaks=peaks)[0]


def shakings_of(motion: Motion, thresholds: Sequence[tuple[float, float]], *, peaks: MotionPeaks | None = None) -> list[BodyShaking]:
    """Return the shaking of a motion for several bodies, bit by bit as :func:`shaking_of` for each.

    Examples
    --------
    >>> motion = Motion.from_arrays([0.0, 2.0, 0.0, -2.0, 0.0], 0.1)
    >>> [shaking.threshold_m_s2 for shaking in shakings_of(motion, [(1.0, 1.5), (3.0, 2.0)])]
    [1.0, 2.0]
    """
    if peaks is None:
        peaks = motion_peaks(motion.horizontal, motion.dt, conventions_of(motion.record))
    limits = np.array(thresholds, dtype=np.float64).reshape(-1, 2)
    limits[~(limits > 0.0)] = np.inf
    lowest = limits.min(axis=1, initial=np.inf)
    limits[lowest > peaks.pga_m_s2] = np.inf
    # a long motion has room for the work arrays of one threshold
    parts = np.array_split(limits, len(limits)) if motion.is_long else [limits]
    above = np.concatenate([_times_above(motion, part) for part in parts]) if len(limits) else limits
    return [
        BodyShaking(*peaks, threshold, total, longest) if threshold < math.inf else BodyShaking(*peaks, None, None, None)
        for threshold, (total, longest) in zip(lowest.tolist(), above.tolist(), strict=True)
    ]


def _times_above(motion: Motion, limits: FloatArray) -> FloatArray:
    """Return the total and the longest time above the thresholds to +x and to -x of each body, (m, 2), s."""
    sides = [intervals_one_sided(motion.horizontal, motion.dt, limits[:, side], sign) for side, sign in enumerate((-1.0, 1.0))]
    bodies, intervals = (np.concatenate(part) for part in zip(*sides, strict=True))
    order = np.argsort(bodies, kind="stable")
    # differences of interpolated times carry round-off
    lengths = np.round(intervals[order, 1] - intervals[order, 0], 15)
    result = np.zeros((len(limits), 2))
    rows, starts = np.unique(bodies[order], return_index=True)
    # a sum of each slice: `np.add.reduceat` rounds otherwise
    for row, first, last in zip(rows.tolist(), starts.tolist(), [*starts[1:].tolist(), lengths.size], strict=False):
        result[row] = lengths[first:last].sum(), lengths[first:last].max()
    return result


def response_shaking(response: Response[Any], *, peaks: MotionPeaks | None = None) -> BodyShaking:
    """Return the shaking of the motion of a response for its body, whose thresholds are those of the registered solver.

    Examples
    --------
    >>> from seisblock.bodies.block import Block
    >>> from seisblock.models.rock.solve import solve_rock
    >>> motion = Motion.from_arrays([0.0, 4.0, 0.0], 0.1)
    >>> round(response_shaking(solve_rock(Block(0.2, 0.8), motion, gravity=10.0)).threshold_m_s2, 12)
    2.5
    """
    return shaking_of(response.motion, body_thresholds(response.model, response.body, response.options), peaks=peaks)


def transverse_shaking(response: Response[Any]) -> BodyShaking | None:
    """Return the shaking along +y of the motion of a spatial response; None for a plane model and without transverse motion."""
    solver, motion = get_solver(response.model), response.motion
    if not solver.spatial or solver.threshold is None:
        return None
    across = motion.transverse
    if not across.any():
        return None
    return shaking_of(
        replace(motion, rows=(across, motion.horizontal, motion.vertical)), solver.threshold(response.body, response.options, axis=1)
    )


def body_thresholds(solver: str, body: Any, options: Any) -> tuple[float, float]:
    """Return the accelerations, m/s^2, at which a body starts to move to +x and to -x in a model; infinite where there are none."""
    threshold = get_solver(solver).threshold
    return Thresholds(math.inf, math.inf) if threshold is None else threshold(body, options)


__all__ = ["BodyShaking", "Thresholds", "body_thresholds", "response_shaking", "shaking_of", "shakings_of", "transverse_shaking"]
