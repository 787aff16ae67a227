"""Results of uplift runs as arrays, for single runs and batches alike."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from seisblock.bodies.spring_block import SpringBlock
from seisblock.core._display import DisplayMixin
from seisblock.core.typing import BoolArray, FloatArray, IntArray
from seisblock.dynamics import Ensemble, Trajectory
from seisblock.dynamics.buffers import TOTAL
from seisblock.models.uplift.constants import ALL_CORNERS, CHANGES, FIRST, TURN_X, TURN_Y, F, U

MAX_LEAN_RATIO = 0.1
"""Largest ratio of tilt to overturning angle at which neglecting the P-delta effect is acceptable."""

CHANGE_FACTOR = 1.0 + 2e-9
"""Factor on the motion of a second run, which shows whether the result depends on changes that no record resolves."""

CHANGE_TOLERANCE, COUNT_TOLERANCE = 1e-3, 1e-2
"""Relative differences of maxima, and of the number of contact changes, between the two runs above which a result is sensitive."""

ROUND_OFF = 1e-12
"""Rise of a corner over the static settlement below which the corner is at rest."""

CORNERS_IN_CONTACT = np.arange(ALL_CORNERS + 1)[:, None] >> np.arange(4) & 1
"""Corners in contact by contact state, (16, 4), 0 or 1."""


@dataclass(frozen=True, eq=False)
class UpliftEndStates:
    """Extrema, final states and contact times of m trajectories.

    Parameters
    ----------
    extrema, final : (m, n_tracked, 4), (m, n_states) arrays
    contact_times : (m, 16) array, s
        Total time in each contact state.
    first : (m,) array, s after sample 0
        Time of the first event, NaN without one.
    """

    extrema: FloatArray
    final: FloatArray
    contact_times: FloatArray
    first: FloatArray


@dataclass(frozen=True, eq=False, repr=False)
class UpliftBatchResult(DisplayMixin):
    """Results of m runs; arrays of shape (m,) unless noted.

    Quantities are defined in :class:`~seisblock.models.uplift.outcome.UpliftOutcome`.

    Parameters
    ----------
    uplifts : bool
    first_uplift_s : s
        After the motion's first sample; NaN without uplift.
    first_corners : (m, 4) array of bool
        Corners 1 to 4 that lift first.
    max_uplift_m, static_settlement_m : m
    uplift_duration_s : s
    time_on_corners_s : (m, 5) array, s
        On 4, 3, 2, 1 and 0 corners.
    max_contact_force_n, max_contact_force_ratio : N, 1
    contact_changes : int
    uplift_scale : 1
        NaN if no amplitude lifts a corner.
    max_rotation_rad, lean_ratio : rad, 1
    within_model : bool
    rise_m, changed_rise_m : m
        Highest position of any corner above the spring's natural length, under the motion and under the motion times 1 + 2e-9.
    sensitive : bool
        Whether that change of the motion changes the largest rise, force or rotation by more than 0.1 %, or the number of contact
        changes by more than 1 %.
    gave_up : bool
        Abandoned runs without a result: their other entries refer to the instant of abandonment.
    """

    uplifts: BoolArray
    first_uplift_s: FloatArray
    first_corners: BoolArray
    max_uplift_m: FloatArray
    static_settlement_m: FloatArray
    uplift_duration_s: FloatArray
    time_on_corners_s: FloatArray
    max_contact_force_n: FloatArray
    max_contact_force_ratio: FloatArray
    contact_changes: IntArray
    uplift_scale: FloatArray
    max_rotation_rad: FloatArray
    lean_ratio: FloatArray
    within_model: BoolArray
    rise_m: FloatArray
    changed_rise_m: FloatArray
    sensitive: BoolArray
    gave_up: BoolArray

    def row_dict(self, row: int, start_s: float) -> dict[str, Any]:
        """Return the scalars of one run by their field names in the outcome; None for missing values.

        Parameters
        ----------
        row : int
        start_s : float, s
            Time of the motion's first sample.

        Returns
        -------
        dict
            Keys are the fields of the outcome.
        """
        lifts, scale = bool(self.uplifts[row]), float(self.uplift_scale[row])
        return {
            "uplifts": lifts,
            "first_uplift_s": float(start_s + self.first_uplift_s[row]) if lifts else None,
            "max_uplift_m": float(self.max_uplift_m[row]),
            "corner": int(np.argmax(self.first_corners[row])) + 1 if lifts else None,
            "uplift_duration_s": float(self.uplift_duration_s[row]),
            "max_contact_force_n": float(self.max_contact_force_n[row]),
            "max_contact_force_ratio": float(self.max_contact_force_ratio[row]),
            "contact_changes": int(self.contact_changes[row]),
            "uplift_scale": None if np.isnan(scale) else scale,
            "max_rotation_rad": float(self.max_rotation_rad[row]),
            "lean_ratio": float(self.lean_ratio[row]),
            "within_model": bool(self.within_model[row]),
            "static_settlement_m": float(self.static_settlement_m[row]),
        }


def end_states(trajectory: Trajectory) -> UpliftEndStates:
    """Return the end states of a single trajectory as one row, bit by bit as :func:`batch_end_states`."""
    changes = trajectory.events
    edges = np.concatenate([[0.0], changes.time, [trajectory.end_time]])
    # bincount sums in chronological order, as the engine's loop does
    contact_times = np.bincount(np.append(ALL_CORNERS, changes.target), np.diff(edges), minlength=ALL_CORNERS + 1).astype(
        np.float64, copy=False
    )
    first = changes.time[0] if len(changes) else np.nan
    return UpliftEndStates(trajectory.extrema[np.newaxis], trajectory.final[np.newaxis], contact_times[np.newaxis], np.array([first]))


def batch_end_states(ensemble: Ensemble) -> UpliftEndStates:
    """Return the end states of an ensemble."""
    return UpliftEndStates(ensemble.extrema, ensemble.final, ensemble.dwell_times[:, : ALL_CORNERS + 1, TOTAL], ensemble.first_event_time)


def batch_result(
    bodies: Sequence[SpringBlock],
    ends: UpliftEndStates,
    linear_extrema: FloatArray,
    changed_extrema: FloatArray,
    changed_final: FloatArray,
    gravity: float,
    gave_up: BoolArray | None = None,
) -> UpliftBatchResult:
    """Return the results of many runs from their end states ([Okumura1987]_ section 2, extended to records).

    Parameters
    ----------
    bodies : sequence of SpringBlock
        One per row.
    ends : UpliftEndStates
    linear_extrema, changed_extrema : (m, n_tracked, 4) arrays
        Extrema of the linear system, and under the motion times 1 + 2e-9.
    changed_final : (m, n_states) array
        Final states under that motion.
    gravity : float, m/s^2
    gave_up : (m,) array of bool or None
        Abandoned runs; None: no run was abandoned.
    """
    settlement = np.array([body.static_settlement(gravity) for body in bodies])
    mass, width, depth, height = np.array([[body.mass, body.width, body.depth, body.height] for body in bodies]).T
    about_x, about_y = _max_rotations(ends.extrema, depth)
    lean = np.maximum(height / depth * about_x, height / width * about_y)
    rise, linear_rise = _max_corner_rise(ends.extrema), _max_corner_rise(linear_extrema) + settlement
    force = mass * _max_corner_force(ends.extrema)
    maxima, changed_maxima = (
        np.array([_max_corner_rise(extrema), _max_corner_force(extrema), _max_rotations(extrema, depth).max(axis=0)])
        for extrema in (ends.extrema, changed_extrema)
    )
    counts, changed_counts = ends.final[:, CHANGES], changed_final[:, CHANGES]
    sensitive = (np.abs(changed_maxima - maxima) > CHANGE_TOLERANCE * np.maximum(np.abs(maxima), np.abs(changed_maxima))).any(axis=0)
    sensitive |= np.abs(changed_counts - counts) > COUNT_TOLERANCE * np.maximum(counts, changed_counts)
    lifts = ends.final[:, FIRST] > 0.0
    is_moving = linear_rise > ROUND_OFF * settlement
    return UpliftBatchResult(
        uplifts=lifts,
        first_uplift_s=ends.first,
        first_corners=ends.final[:, FIRST].astype(np.int64)[:, None] >> np.arange(4) & 1 == 1,
        max_uplift_m=np.maximum(rise, 0.0),
        static_settlement_m=settlement,
        uplift_duration_s=ends.contact_times[:, :ALL_CORNERS].sum(axis=1),
        time_on_corners_s=np.stack(
            [ends.contact_times[:, CORNERS_IN_CONTACT.sum(axis=1) == n].sum(axis=1) for n in (4, 3, 2, 1, 0)], axis=1
        ),
        max_contact_force_n=force,
        max_contact_force_ratio=force / np.array([body.static_corner_force(gravity) for body in bodies]),
        contact_changes=ends.final[:, CHANGES].astype(np.int64),
        uplift_scale=np.where(is_moving, settlement / np.where(is_moving, linear_rise, 1.0), np.nan),
        max_rotation_rad=np.maximum(about_x, about_y),
        lean_ratio=lean,
        within_model=lean <= MAX_LEAN_RATIO,
        rise_m=rise,
        changed_rise_m=_max_corner_rise(changed_extrema),
        sensitive=sensitive,
        gave_up=np.zeros(len(settlement), dtype=np.bool_) if gave_up is None else gave_up,
    )


def _max_corner_rise(extrema: FloatArray) -> FloatArray:
    highest: FloatArray = extrema[:, U : U + 4, 0].max(axis=1)
    return highest


def _max_corner_force(extrema: FloatArray) -> FloatArray:
    largest: FloatArray = extrema[:, F : F + 4, 0].max(axis=1)
    return largest


def _max_rotations(extrema: FloatArray, depth: FloatArray) -> FloatArray:
    """Return the largest absolute rotations about x and y, (2, m), rad."""
    return np.array([np.maximum(extrema[:, state, 0], -extrema[:, state, 2]) + 0.0 for state in (TURN_X, TURN_Y)]) / depth
