"""Outcome of each stone (standing, slid, turned, fallen) and energy and momentum balance of a run."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.pile.stone import GROUND
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import SolverError
from seisblock.core.i18n import N_, Term
from seisblock.core.quaternions import inverse_rotation, rotate_vectors
from seisblock.core.results import Channel, Status
from seisblock.core.typing import FloatArray
from seisblock.models.stack.arrays import PileArrays
from seisblock.models.stack.buffers import PileOutput
from seisblock.models.stack.frames import BOX_CENTRE, MASS, V, X
from seisblock.models.stack.recorder import CREATED, DISSIPATED, FALL_TIME, FALL_X, FALL_Y, IMPULSE, MIN_COSINE, WORK


class StoneState(Term):
    """States of a stone, the most severe one last."""

    STANDING = N_("standing")
    TURNED = N_("turned")
    SLID = N_("slid")
    FALLEN = N_("fallen")


SLIP_LIMIT = 1e-3
"""Residual displacement, m, above which a stone has slid."""

TWIST_LIMIT = 0.01
"""Residual rotation about the vertical, rad, above which a stone has turned."""

MAX_CREATED_ENERGY = 1e-3
"""Largest energy created by the integration over the pile's weight times its height; more means that the step is too coarse."""


@dataclass(frozen=True)
class StoneOutcome:
    """Outcome of one stone; displacements, m, and rotations, rad, are relative to the stone below or the ground.

    Parameters
    ----------
    name, state : str
        State: ``standing``, ``slid``, ``turned`` or ``fallen``.
    max_tilt_rad, residual_tilt_rad : float
    residual_slip_m, residual_slip_x_m, residual_slip_y_m : float
        Residual displacement at the centre of the lower joint, in the axes of the stone below; the first is the distance.
    residual_turn_rad : float
        About the vertical, positive counter-clockwise seen from above.
    fell_at_s : float or None
    fell_towards_deg : float or None
        Direction of the fall from +x, counter-clockwise seen from above.
    fell_azimuth_deg : float or None
        The same clockwise from north; None if the azimuth of +x is unknown.
    fell_onto : str or None
        The ground, or the stone on which it came to rest.
    """

    name: str
    state: str
    max_tilt_rad: float
    residual_tilt_rad: float
    residual_slip_m: float
    residual_slip_x_m: float
    residual_slip_y_m: float
    residual_turn_rad: float
    fell_at_s: float | None
    fell_towards_deg: float | None
    fell_azimuth_deg: float | None
    fell_onto: str | None


@dataclass(frozen=True, repr=False)
class StackOutcome(DisplayMixin):
    """Response of a pile to a ground motion.

    Parameters
    ----------
    overturned : tuple of str
        Names of the stones that fell, from below upwards.
    overturned_any : bool
    time_s : float or None
        Time of the first fall.
    max_tilt_rad, residual_slip_m : dict
        By name of the stone.
    stones : tuple of StoneOutcome
    ground_work_j, lost_j, created_j : float
        Work of the ground motion; energy dissipated by impacts, friction and dashpots; energy created by the integration, ideally zero.
    momentum_error : float, 1
        Difference of momentum and impulse over weight times duration.
    step_s : float
    """

    overturned: tuple[str, ...]
    overturned_any: bool
    time_s: float | None
    max_tilt_rad: dict[str, float]
    residual_slip_m: dict[str, float]
    stones: tuple[StoneOutcome, ...]
    ground_work_j: float
    lost_j: float
    created_j: float
    momentum_error: float
    step_s: float


@dataclass(frozen=True, eq=False)
class Track:
    """Positions of the stones: times (rows,), centres (rows, stones, 3), quaternions (rows, stones, 4)."""

    time: FloatArray
    centres: FloatArray
    quaternions: FloatArray


@dataclass(frozen=True, eq=False)
class SimulationResult:
    """Result of an integration.

    Parameters
    ----------
    status : Status
    time : float, s
        Since the first sample of the motion.
    bodies : (m + 1, 31) array
    output : PileOutput
    rows : int
        Rows that were due to be stored.
    track : Track
        Positions in the stored rows: all of them, or the first and the last.
    """

    status: Status
    time: float
    bodies: FloatArray
    output: PileOutput
    rows: int
    track: Track


def stone_track(pile: PileArrays, rows: FloatArray) -> Track:
    """Return the positions of the stones from the stored rows; stones of one body move together, fixed stones stay."""
    stones = len(pile.body.stones)
    centres = np.empty((len(rows), stones, 3))
    quaternions = np.zeros((len(rows), stones, 4))
    quaternions[:, :, 0] = 1.0
    for i in range(stones):
        b = int(pile.owner[i])
        if b == len(pile.members):
            centres[:, i] = pile.boxes[i, BOX_CENTRE:]
            continue
        state = rows[:, 1 + 7 * b : 8 + 7 * b]
        quaternions[:, i] = state[:, 3:]
        centres[:, i] = state[:, :3] + rotate_vectors(state[:, 3:], pile.boxes[i, BOX_CENTRE:])
    return Track(rows[:, 0], centres, quaternions)


def _supporting_stone(pile: PileArrays, i: int) -> int:
    """Return the index of the stone below stone `i`, -1 for the ground."""
    support_name = pile.body.stones[i].on
    return -1 if support_name == GROUND else pile.body.names.index(support_name)


def _joint_centre(pile: PileArrays, i: int, support: int) -> FloatArray:
    """Return the centre of the joint between a stone and its support, from the stone's centre, (3,), m."""
    joint_centre = np.array([0.0, 0.0, -pile.boxes[i, 2]])
    if support >= 0:
        centre, support_centre = (pile.bodies[pile.owner[k], X : X + 2] + pile.boxes[k, BOX_CENTRE : BOX_CENTRE + 2] for k in (i, support))
        half, support_half = pile.boxes[i, :2], pile.boxes[support, :2]
        # middle of the rectangle that both faces share
        joint_centre[:2] = (
            0.5 * (np.maximum(centre - half, support_centre - support_half) + np.minimum(centre + half, support_centre + support_half))
            - centre
        )
    return joint_centre


def _slip(pile: PileArrays, track: Track, i: int) -> FloatArray:
    """Return the displacement of a stone against its support at the centre of their joint, (rows, 3), m, in the support's axes."""
    support = _supporting_stone(pile, i)
    # the centre of the joint follows the upper stone, so that rotation of the lower stone alone is no slip
    foot = track.centres[:, i] + rotate_vectors(track.quaternions[:, i], _joint_centre(pile, i, support))
    if support >= 0:
        foot = rotate_vectors(inverse_rotation(track.quaternions[:, support]), foot - track.centres[:, support])
    return foot - foot[0]


def tilt_angle(track: Track, i: int) -> FloatArray:
    """Return the angle between a stone's axis and the vertical, (rows,), rad."""
    q = track.quaternions[:, i]
    # from the half angle, which stays accurate near zero, unlike the arc cosine of the axis
    return 2.0 * np.arctan2(np.hypot(q[:, 1], q[:, 2]), np.hypot(q[:, 0], q[:, 3]))


def twist_angle(track: Track, i: int) -> FloatArray:
    """Return a stone's rotation about the vertical, (rows,), rad."""
    q = track.quaternions[:, i]
    # twist of the swing-twist decomposition; undefined for a stone upside down
    return 2.0 * np.arctan2(q[:, 3], q[:, 0]) * np.where(np.hypot(q[:, 0], q[:, 3]) > 0.0, 1.0, np.nan)


def stone_channels(pile: PileArrays, track: Track) -> tuple[Channel, ...]:
    """Return tilt, slip, centre and quaternion of every stone as channels."""
    result = []
    for i, name in enumerate(pile.body.names):
        slip = _slip(pile, track, i)
        result += [
            Channel(f"{name}_tilt", "rad", tilt_angle(track, i), "θ"),
            Channel(f"{name}_slip", "m", np.hypot(slip[:, 0], slip[:, 1]), "s"),
            *(Channel(f"{name}_{axis}", "m", track.centres[:, i, k], axis) for k, axis in enumerate("xyz")),
            *(Channel(f"{name}_q{axis}", "1", track.quaternions[:, i, k], f"q{axis}") for k, axis in enumerate("wxyz")),
        ]
    return tuple(result)


def stack_outcome(
    pile: PileArrays, end: SimulationResult, *, start: float, gravity: float, step: float, azimuth: float | None
) -> StackOutcome:
    """Return the outcome of a run; `azimuth` of +x in degrees clockwise from north.

    Raises
    ------
    SolverError
        If the integration created energy.
    """
    masses, ledger = pile.inertias[:, MASS], end.output.energy_ledger
    height = max(centre[2] + 0.5 * stone.height for centre, stone in zip(pile.body.centres(), pile.body.stones, strict=True))
    scale = float(masses.sum()) * gravity * height
    if ledger[CREATED] > MAX_CREATED_ENERGY * scale:
        raise SolverError(
            "the integration of the pile {name} created {energy:.3g} J of energy with steps of {step:.3g} s: give a finer `step`",
            step=step,
            name=pile.body.name,
            energy=ledger[CREATED],
        )
    momentum = masses @ end.bodies[:-1, V : V + 3] - ledger[IMPULSE : IMPULSE + 3]
    stones = tuple(_stone_outcome(pile, end, i, start, azimuth) for i in range(len(pile.body.stones)))
    fallen_stones = [stone for stone in stones if stone.state == StoneState.FALLEN]
    return StackOutcome(
        overturned=tuple(stone.name for stone in fallen_stones),
        overturned_any=bool(fallen_stones),
        time_s=min((stone.fell_at_s for stone in fallen_stones if stone.fell_at_s is not None), default=None),
        max_tilt_rad={stone.name: stone.max_tilt_rad for stone in stones},
        residual_slip_m={stone.name: stone.residual_slip_m for stone in stones},
        stones=stones,
        ground_work_j=float(ledger[WORK]),
        lost_j=float(ledger[DISSIPATED]),
        created_j=float(ledger[CREATED]),
        momentum_error=float(np.linalg.norm(momentum) / (masses.sum() * gravity * max(end.time, step))),
        step_s=step,
    )


def _stone_outcome(pile: PileArrays, end: SimulationResult, i: int, start: float, azimuth: float | None) -> StoneOutcome:
    slip, twists = _slip(pile, end.track, i)[-1], twist_angle(end.track, i)
    b = int(pile.owner[i])
    fall_states = end.output.fall_states
    twist = float(twists[-1] - twists[0])
    if b == len(pile.members):
        return StoneOutcome(pile.body.names[i], StoneState.STANDING, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, None, None, None, None)
    # the most severe state names the outcome
    has_fallen = fall_states[b, FALL_TIME] >= 0.0
    direction_deg = math.degrees(math.atan2(fall_states[b, FALL_Y], fall_states[b, FALL_X]))
    distance = float(math.hypot(slip[0], slip[1]))
    state = (
        StoneState.FALLEN
        if has_fallen
        else StoneState.SLID
        if distance > SLIP_LIMIT
        else StoneState.TURNED
        if abs(twist) > TWIST_LIMIT
        else StoneState.STANDING
    )
    return StoneOutcome(
        name=pile.body.names[i],
        state=state,
        max_tilt_rad=float(math.acos(min(1.0, max(-1.0, fall_states[b, MIN_COSINE])))),
        residual_tilt_rad=float(tilt_angle(end.track, i)[-1]),
        residual_slip_m=distance,
        residual_slip_x_m=float(slip[0]),
        residual_slip_y_m=float(slip[1]),
        residual_turn_rad=float(math.remainder(twist, 2.0 * math.pi)),
        fell_at_s=float(start + fall_states[b, FALL_TIME]) if has_fallen else None,
        fell_towards_deg=direction_deg if has_fallen else None,
        fell_azimuth_deg=(azimuth - direction_deg) % 360.0 if has_fallen and azimuth is not None else None,
        fell_onto=_supporting_object(pile, b, end.output.last_contact, end.time) if has_fallen else None,
    )


def _supporting_object(pile: PileArrays, b: int, last_touch: FloatArray, end_time: float) -> str | None:
    """Return the name of the object a fallen stone rests on: the ground before any stone, None in flight."""
    recent_contacts = [body for body in range(last_touch.shape[0]) if body != b and last_touch[b, body] >= end_time - 0.2]
    if len(pile.members) in recent_contacts:
        return GROUND
    return pile.body.names[pile.members[recent_contacts[0]][-1]] if recent_contacts else None
