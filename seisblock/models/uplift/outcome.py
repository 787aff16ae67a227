"""What a record makes of a block on corner springs: the numbers, the contact states and the warnings of one trajectory."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from seisblock.bodies.spring_block import SpringBlock
from seisblock.core.i18n import Message, lazy_gettext
from seisblock.core.results import Event, LazySequence, Phase, make_phases
from seisblock.core.typing import BoolArray, FloatArray, IntArray
from seisblock.dynamics import EventLog, Trajectory
from seisblock.models.uplift.batch_results import MAX_LEAN_RATIO, UpliftBatchResult
from seisblock.models.uplift.model import ALL_CORNERS, F, U, contact_name
from seisblock.models.uplift.modes import natural_modes
from seisblock.records.motion import Motion

REPEAT_TOLERANCE = 1e-3
"""Largest share by which two integrations may differ in the largest uplift before that is said."""


@dataclass(frozen=True)
class CornerOutcome:
    """What one corner did.

    Parameters
    ----------
    corner : int
        1 (+x, +y), 2 (+x, -y), 3 (-x, +y), 4 (-x, -y).
    uplifts : bool
    first_uplift_s : float or None
    uplift_duration_s, longest_uplift_s : float
        Total time in the air, and longest stretch of it.
    max_uplift_m, max_uplift_time_s : float
        Highest position above the spring's natural length (negative: never lifted, and by this much), and when.
    max_contact_force_n, max_contact_force_time_s : float
        Largest force of its vertical spring and dashpot, and when.
    """

    corner: int
    uplifts: bool
    first_uplift_s: float | None
    uplift_duration_s: float
    longest_uplift_s: float
    max_uplift_m: float
    max_uplift_time_s: float
    max_contact_force_n: float
    max_contact_force_time_s: float


@dataclass(frozen=True)
class UpliftOutcome:
    """What a block on corner springs did under a record.

    Parameters
    ----------
    natural_frequencies_hz : tuple of 6 floats
        With all corners in contact, ascending.
    uplifts : bool
    first_uplift_s : float or None
        When a corner first leaves its spring, s from the record's first sample.
    max_uplift_m : float
        Largest height of a corner above its spring, 0 without uplift.
    corner : int or None
        The corner that lifts first, 1 to 4 as in :class:`CornerOutcome`; of several that lift together, the lowest number.
    first_corners : tuple of int
        All that lift first, at one instant.
    uplift_duration_s : float
        Time during which at least one corner is in the air.
    max_contact_force_n, max_contact_force_ratio : float
        Largest force at a corner, and over the static m g / 4.
    contact_changes : int
        How many times a corner lifted or landed.
    share_on_corners : dict
        Share of the time on 4, 3, 2, 1 and 0 corners.
    uplift_scale : float or None
        Factor on the record at which a corner just lifts: below it the response is linear.
    max_rotation_rad : float
        Largest rotation about x or y, between samples too.
    lean_ratio : float
        The same over the slenderness of that side.
    within_model : bool
        Whether that stays below 0.1, so that leaving out the weight's lever is defensible; where it does not, sizes and times of the
        motion are no answers, only the first uplift is.
    static_settlement_m : float
    corners : tuple of CornerOutcome
    """

    natural_frequencies_hz: tuple[float, ...]
    uplifts: bool
    first_uplift_s: float | None
    max_uplift_m: float
    corner: int | None
    first_corners: tuple[int, ...]
    uplift_duration_s: float
    max_contact_force_n: float
    max_contact_force_ratio: float
    contact_changes: int
    share_on_corners: dict[str, float]
    uplift_scale: float | None
    max_rotation_rad: float
    lean_ratio: float
    within_model: bool
    static_settlement_m: float
    corners: tuple[CornerOutcome, ...]


def _contact_states(trajectory: Trajectory) -> tuple[FloatArray, IntArray]:
    """Return when contact states begin, and the last one ends, (m + 1,), s after sample 0, and which they are, (m,)."""
    changes = trajectory.events
    return np.concatenate([[0.0], changes.time, [trajectory.end_time]]), np.append(ALL_CORNERS, changes.target)


def _contacts(trajectory: Trajectory) -> tuple[FloatArray, BoolArray]:
    """Return the lengths of the contact states, (m,), s, and which corners are in the air in each, (m, 4)."""
    edges, modes = _contact_states(trajectory)
    return np.diff(edges), (modes[:, None] >> np.arange(4) & 1) == 0


def build_outcome(body: SpringBlock, motion: Motion, trajectory: Trajectory, results: UpliftBatchResult) -> UpliftOutcome:
    """Return the numbers a user asks for."""
    lengths, in_air = _contacts(trajectory)
    (time,) = results.time_on_corners_s
    return UpliftOutcome(
        natural_frequencies_hz=natural_modes(body).frequencies_hz,
        first_corners=tuple((np.flatnonzero(results.first_corners[0]) + 1).tolist()),
        share_on_corners={str(n): float(share) for n, share in zip((4, 3, 2, 1, 0), time / time.sum(), strict=True)},
        corners=tuple(_corner(i, body, motion, trajectory, lengths, in_air[:, i]) for i in range(4)),
        **results.row_dict(0, motion.start_s),
    )


def _corner(i: int, body: SpringBlock, motion: Motion, trajectory: Trajectory, lengths: FloatArray, in_air: BoolArray) -> CornerOutcome:
    """Return what one corner did."""
    changes = trajectory.events
    lifts = changes.time[(changes.source & ~changes.target) >> i & 1 == 1]
    # one stretch in the air may hold many changes of the other corners
    airborne_index = np.cumsum(np.append(False, in_air[1:] & ~in_air[:-1]))
    airborne_durations = np.bincount(airborne_index[in_air], lengths[in_air]) if in_air.any() else np.zeros(1)
    highest, highest_at = trajectory.extrema[U + i, :2]
    force, force_at = trajectory.extrema[F + i, :2]
    return CornerOutcome(
        corner=i + 1,
        uplifts=bool(lifts.size),
        first_uplift_s=float(motion.start_s + lifts[0]) if lifts.size else None,
        uplift_duration_s=float(lengths[in_air].sum()),
        longest_uplift_s=float(airborne_durations.max()),
        max_uplift_m=float(highest),
        max_uplift_time_s=float(motion.start_s + highest_at),
        max_contact_force_n=float(body.mass * force),
        max_contact_force_time_s=float(motion.start_s + force_at),
    )


def phases(motion: Motion, trajectory: Trajectory) -> Sequence[Phase]:
    """Return the contact states in the order of time."""
    edges, modes = _contact_states(trajectory)
    return make_phases(motion.start_s + edges, modes, contact_name)


def events(motion: Motion, changes: EventLog) -> Sequence[Event]:
    """Return what each corner did, one event for each that lifts or lands."""
    indices, corner = _corner_changes(changes)
    return LazySequence(indices.size, partial(_events, motion.start_s, changes, indices, corner))


def _events(start_s: float, changes: EventLog, indices: IntArray, corner: IntArray, span: slice) -> list[Event]:
    """Return some of the events."""
    return [
        Event(f"corner {i + 1} {'lands' if c.target >> i & 1 else 'lifts'}", start_s + c.time, c.before, c.after)
        for c, i in zip(map(changes.__getitem__, indices[span].tolist()), corner[span].tolist(), strict=True)
    ]


def _corner_changes(changes: EventLog) -> tuple[IntArray, IntArray]:
    """Return the changes in which a corner lifts or lands, and which it is, from 0; one that several corners share stands once for each."""
    indices, corner = np.nonzero((changes.source ^ changes.target)[:, None] >> np.arange(4) & 1)
    return indices, corner


def warnings(motion: Motion, results: UpliftBatchResult, row: int) -> tuple[Message, ...]:
    """Return what the user should know before believing the numbers of one run."""
    lean, rise, repeat_rise = (float(column[row]) for column in (results.lean_ratio, results.rise_m, results.repeat_rise_m))
    messages = []
    if motion.record is not None and motion.record.vertical is None:
        messages.append(lazy_gettext("the record has no vertical component: solved with zero vertical motion"))
    if motion.record is not None and len(motion.record.horizontals) < 2:
        messages.append(lazy_gettext("the record has one horizontal component: solved with zero motion across it"))
    if lean > 1.0:
        messages.append(
            lazy_gettext(
                "the block leans beyond its slenderness, where it would fall and this model, which has no P-delta and never overturns, "
                "does not hold: use 'seisblock rock'"
            )
        )
    elif lean > MAX_LEAN_RATIO:
        messages.append(
            lazy_gettext(
                "the block leans to {lean:.2f} of its slenderness, beyond {small}, where this model, which has no P-delta and never "
                "overturns, no longer holds: use 'seisblock rock'",
                lean=lean,
                small=MAX_LEAN_RATIO,
            )
        )
    if lean > MAX_LEAN_RATIO and abs(rise - repeat_rise) > REPEAT_TOLERANCE * max(abs(rise), abs(repeat_rise)):
        messages.append(
            lazy_gettext(
                "by round-off alone, after so many contact changes, the motion no longer follows from the record: trust its beginning"
            )
        )
    elif abs(rise - repeat_rise) > REPEAT_TOLERANCE * max(abs(rise), abs(repeat_rise)):
        messages.append(
            lazy_gettext(
                "the largest uplift is {one:.4g} or {other:.4g} mm by round-off alone: after so many contact changes the motion no longer "
                "follows from the record; trust its beginning, and the order of magnitude",
                one=rise * 1e3,
                other=repeat_rise * 1e3,
            )
        )
    return tuple(messages)
