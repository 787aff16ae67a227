"""Outcome, contact states, events and warnings of an uplift run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from seisblock.bodies.spring_block import SpringBlock
from seisblock.core._display import DisplayMixin
from seisblock.core.i18n import Message, lazy_gettext
from seisblock.core.results import Event, LazySequence, Phase, make_phases
from seisblock.core.typing import BoolArray, FloatArray, IntArray
from seisblock.dynamics import EventLog, Trajectory
from seisblock.models.uplift.batch_results import CHANGE_TOLERANCE, MAX_LEAN_RATIO, UpliftBatchResult
from seisblock.models.uplift.constants import ALL_CORNERS, F, U
from seisblock.models.uplift.model import contact_name
from seisblock.models.uplift.modes import natural_modes
from seisblock.records.motion import Motion


@dataclass(frozen=True)
class CornerOutcome:
    """Result of one corner.

    Parameters
    ----------
    corner : int
        1 (+x, +y), 2 (+x, -y), 3 (-x, +y), 4 (-x, -y).
    uplifts : bool
    first_uplift_s : float or None
    uplift_duration_s, longest_uplift_s : float
        Total time, and longest continuous time, out of contact.
    max_uplift_m, max_uplift_time_s : float
        Highest position above the spring's natural length (negative: no uplift), and its time.
    max_contact_force_n, max_contact_force_time_s : float
        Largest force of the vertical spring and dashpot, and its time.
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


@dataclass(frozen=True, repr=False)
class UpliftOutcome(DisplayMixin):
    """Result of an uplift run ([Okumura1987]_ section 2, extended to records).

    Parameters
    ----------
    natural_frequencies_hz : tuple of 6 floats
        With all corners in contact, ascending.
    uplifts : bool
    first_uplift_s : float or None
        First uplift of a corner, s from the record's first sample.
    max_uplift_m : float
        Maximum height of a corner above its spring, 0 without uplift.
    corner : int or None
        Corner that lifts first, 1 to 4 as in :class:`CornerOutcome`; the lowest number of several simultaneous ones.
    first_corners : tuple of int
        All corners that lift at the first uplift.
    uplift_duration_s : float
        Time with at least one corner out of contact.
    max_contact_force_n, max_contact_force_ratio : float
        Largest force at a corner, and its ratio to the static force m g / 4.
    contact_changes : int
        Number of uplifts and landings of corners.
    share_on_corners : dict
        Share of the time on 4, 3, 2, 1 and 0 corners.
    uplift_scale : float or None
        Scale factor to uplift: below it the response is linear.
    max_rotation_rad : float
        Largest rotation about x or y, including the interior of samples.
    lean_ratio : float
        Largest ratio of rotation to the slenderness of the side.
    within_model : bool
        True if `lean_ratio` is at most 0.1, where neglecting the P-delta effect is acceptable; otherwise only the first uplift is a
        valid result.
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
    """Return the edges, (m + 1,), s after sample 0, and modes, (m,), of the contact states."""
    changes = trajectory.events
    return np.concatenate([[0.0], changes.time, [trajectory.end_time]]), np.append(ALL_CORNERS, changes.target)


def _contacts(trajectory: Trajectory) -> tuple[FloatArray, BoolArray]:
    """Return the durations of the contact states, (m,), s, and the corners out of contact in each, (m, 4)."""
    edges, modes = _contact_states(trajectory)
    return np.diff(edges), (modes[:, None] >> np.arange(4) & 1) == 0


def build_outcome(body: SpringBlock, motion: Motion, trajectory: Trajectory, results: UpliftBatchResult) -> UpliftOutcome:
    """Return the outcome of a trajectory."""
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
    """Return the result of corner `i`."""
    changes = trajectory.events
    lifts = changes.time[(changes.source & ~changes.target) >> i & 1 == 1]
    # contact changes of other corners split one uplift of this corner into several contact states
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
    """Return the contact states in chronological order."""
    edges, modes = _contact_states(trajectory)
    return make_phases(motion.start_s + edges, modes, contact_name)


def events(motion: Motion, changes: EventLog) -> Sequence[Event]:
    """Return the events, one for each uplift or landing of a corner."""
    indices, corner = _corner_changes(changes)
    return LazySequence(indices.size, partial(_events, motion.start_s, changes, indices, corner))


def _events(start_s: float, changes: EventLog, indices: IntArray, corner: IntArray, span: slice) -> list[Event]:
    """Return the events in `span`."""
    return [
        Event(f"corner {i + 1} {'lands' if c.target >> i & 1 else 'lifts'}", start_s + c.time, c.before, c.after)
        for c, i in zip(map(changes.__getitem__, indices[span].tolist()), corner[span].tolist(), strict=True)
    ]


def _corner_changes(changes: EventLog) -> tuple[IntArray, IntArray]:
    """Return event index and corner (0 to 3) of each uplift or landing; an event of several corners appears once per corner."""
    indices, corner = np.nonzero((changes.source ^ changes.target)[:, None] >> np.arange(4) & 1)
    return indices, corner


def warnings(motion: Motion, results: UpliftBatchResult, row: int) -> tuple[Message, ...]:
    """Return the warnings of one run."""
    lean = float(results.lean_ratio[row])
    messages = []
    if motion.record is not None and motion.record.vertical is None:
        messages.append(lazy_gettext("no vertical component in the record: vertical motion set to zero"))
    if motion.record is not None and len(motion.record.horizontals) < 2:
        messages.append(lazy_gettext("only one horizontal component in the record: motion across it set to zero"))
    if lean > 1.0:
        messages.append(
            lazy_gettext(
                "peak tilt exceeds the overturning angle; this model has no P-delta effect, cannot overturn and is not valid here: use "
                "'seisblock rock'"
            )
        )
    elif lean > MAX_LEAN_RATIO:
        messages.append(
            lazy_gettext(
                "peak tilt is {lean:.2f} of the overturning angle; this model has no P-delta effect and is valid up to {small}: use "
                "'seisblock rock'",
                lean=lean,
                small=MAX_LEAN_RATIO,
            )
        )
    if not results.sensitive[row]:
        return tuple(messages)
    rise, changed_rise = float(results.rise_m[row]), float(results.changed_rise_m[row])
    if lean > MAX_LEAN_RATIO:
        messages.append(
            lazy_gettext(
                "sensitive: after many contact changes the motion depends on changes of the record by 2e-9: only its beginning is reliable"
            )
        )
    elif abs(rise - changed_rise) > CHANGE_TOLERANCE * max(abs(rise), abs(changed_rise)):
        messages.append(
            lazy_gettext(
                "sensitive: maximum uplift {first:.4g} mm, or {second:.4g} mm if the record changes by 2e-9: after many contact changes "
                "only the beginning of the motion and the order of magnitude are reliable",
                first=rise * 1e3,
                second=changed_rise * 1e3,
            )
        )
    else:
        messages.append(
            lazy_gettext(
                "sensitive: contact forces, rotation or number of contact changes depend on changes of the record by 2e-9, the maximum "
                "uplift does not"
            )
        )
    return tuple(messages)
