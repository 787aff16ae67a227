"""A pile of stones on a shaking base: three-dimensional distinct elements ([Furukawa2009]_ section 3)."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import asdict

import numpy as np

from seisblock import checks
from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.dynamics.halt import heed
from seisblock.errors import ParameterError, SolverError
from seisblock.records.given import Factor, check_call, vertical_gain
from seisblock.records.motion import ACROSS, UP, Motion
from seisblock.references import papers
from seisblock.results import Event, Histories, Phase, Response, Status
from seisblock.solvers.stack.arguments import KEPT_ROWS, PLACE, SAMPLE, STEPS_LEFT, PileCursor, PileKept, PileMemory, PileSettings
from seisblock.solvers.stack.arrays import PileArrays, pile_arrays
from seisblock.solvers.stack.frames import Q, X, orient
from seisblock.solvers.stack.outcome import StackOutcome, channels, stack_outcome, stone_track
from seisblock.solvers.stack.rest import sink, steps_per_sample
from seisblock.solvers.stack.run import BOOKS, FALL_TIME, FATE, FLOOR, LEAN, LEAST_COSINE, run
from seisblock.typing import FloatArray
from seisblock.units import STANDARD_GRAVITY

FALLEN_TILT = math.radians(60.0)
"""A stone that leans more than this, and more than its own critical angle, has fallen."""

FALLEN_DROP = 0.5
"""A stone whose centre has sunk by this part of its smallest size has fallen."""

AFTERWARDS = 10.0
"""Seconds that the ground may stand still after the record, until every stone is still."""

MOVED = 1e-5
LONGEST_GAP = 0.1

POINTS_AT_ONCE = 2_500_000
"""Contact points that are looked at before Python may be interrupted: 0.05 s or so."""


def solve_stack(
    body: Pile,
    motion: Motion,
    *,
    points: int = 5,
    contact: PileContact | None = None,
    vertical: Factor | None = None,
    across: Factor = True,
    gravity: float = STANDARD_GRAVITY,
    step: float | None = None,
    stop_at_fall: bool = False,
    tilts: Mapping[str, float] | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Response[StackOutcome]:
    """Follow a pile of stones through a ground motion ([Furukawa2009]_ section 3(1)).

    Every stone is rigid, with quaternions for its turns; stones press on each other through springs, dashpots and Coulomb sliders at n x n
    points of each joint, and at corners and edges once they have tilted or moved off it. Valid for any tilt and any fall.

    Parameters
    ----------
    body : Pile
    motion : Motion
        Ground acceleration; +x is its first row.
    points : int
        Contact points along each side of a joint: 2 stand at the corners, 5 at segment centres as in [Furukawa2009]_.
    contact : PileContact
        Default: [Furukawa2009]_ table 2.
    vertical : bool, float or None
        Whether the vertical ground motion acts, or a factor on it; None: where the record has one.
    across : bool or float
        Whether the motion's transverse row acts, or a factor on it.
    gravity : float, m/s^2
    step : float, s
        Fixed step; default: 0.7 of the stable step of the stiffest contact.
    stop_at_fall : bool
        Whether to end at the first fall.
    tilts : mapping of str to float, rad
        Stones let go from a lean about y, turned about the point on which they then stand.
    progress : callable
        Told now and then how many samples are done, and how many there are.

    Returns
    -------
    Response
        Channels ``NAME_tilt``, ``NAME_slip``, centre ``NAME_x`` ... relative to the ground, quaternion ``NAME_qw`` ...;
        rows where something moved.

    Raises
    ------
    BodyError
        If the pile cannot rest on its joints.
    ParameterError
        If `step` is too coarse to be stable or finer than does any good, or an option is out of range.
    SolverError
        If the run created energy or left the finite numbers.

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.bodies.pile.toml import load_pile
    >>> pulse = Motion.from_arrays(2.0 * np.sin(np.linspace(0.0, np.pi, 11)), 0.01)
    >>> solve_stack(load_pile("wagata"), pulse, points=2).outcome.overturned
    ()
    """
    check_call(body, Pile, motion)
    contact = PileContact() if contact is None else checks.instance(contact, PileContact)
    checks.gravity(gravity)
    pile = pile_arrays(body, contact, points)
    steps = steps_per_sample(pile, motion.dt, step)
    quiet = math.ceil(AFTERWARDS / motion.dt)
    shaking = np.zeros((3, motion.samples + quiet))
    shaking[:, : motion.samples] = motion.acceleration
    up = vertical_gain(motion, vertical)
    shaking[[ACROSS, UP]] *= np.array([[float(across)], [up]])
    memory = pile.memory()
    cursor = PileCursor(np.zeros(PLACE, dtype=np.int64), pile.bodies.copy())
    sink(pile, gravity, cursor.bodies, memory.stretches)
    kept = PileKept(
        fates=_fates(pile, cursor.bodies),
        rows=np.zeros((shaking.shape[1], 1 + 7 * len(pile.members))),
        last_touch=np.full((len(cursor.bodies), len(cursor.bodies)), -1.0),
        books=np.zeros(BOOKS),
    )
    for name, angle in (tilts or {}).items():
        _lean(pile, cursor.bodies, name, angle)
    gap = max(1, round(LONGEST_GAP / motion.dt))
    settings = PileSettings(gravity, motion.dt, steps, stop_at_fall, MOVED, gap, motion.samples - 1)
    status = _run(shaking, settings, pile, memory, cursor, kept, progress)
    ended = float(cursor.place[SAMPLE]) * motion.dt
    if status == Status.NOT_FINITE:
        raise SolverError("the pile {name} left the finite numbers at {ended:.3f} s: give a finer time step", name=body.name, ended=ended)
    track = stone_track(pile, kept.rows[: cursor.place[KEPT_ROWS]])
    outcome = stack_outcome(pile, track, kept, cursor.bodies, start=motion.start_s, ended=ended, gravity=gravity, step=motion.dt / steps)
    return Response(
        model="stack",
        outcome=outcome,
        motion=motion,
        body=body,
        make_histories=lambda: Histories(motion.start_s + track.time, channels(pile, track)),
        phases=_phases(outcome, motion.start_s, motion.start_s + ended),
        events=_events(outcome),
        options={
            "points": points,
            "mu": body.mu,
            "vertical": up,
            "across": float(across),
            "gravity_m_s2": gravity,
            "step_s": motion.dt / steps,
            "contact": asdict(contact),
        },
        status=status,
        citations=papers("pile"),
    )


def _run(
    shaking: FloatArray,
    settings: PileSettings,
    pile: PileArrays,
    memory: PileMemory,
    cursor: PileCursor,
    kept: PileKept,
    progress: Callable[[int, int], None] | None,
) -> Status:
    """Follow the pile to the end, in slices between which Python may be interrupted."""
    slice_ = max(1, POINTS_AT_ONCE // (pile.grids.shape[0] * pile.points**2 + pile.pairs.shape[0]))
    layout = pile.layout
    shaking.flags.writeable = False
    while True:
        heed()
        cursor.place[STEPS_LEFT] = slice_
        status = Status(run(shaking, settings, layout, memory, cursor, kept))
        if status != Status.PAUSED:
            return status
        if progress is not None:
            progress(min(int(cursor.place[SAMPLE]), settings.quiet), settings.quiet)


def _fates(pile: PileArrays, bodies: FloatArray) -> FloatArray:
    """Return the rows in which the kernel notes the fate of each body."""
    fates = np.zeros((len(pile.members), FATE))
    fates[:, LEAST_COSINE] = 1.0
    fates[:, FALL_TIME] = -1.0
    for b, group in enumerate(pile.members):
        boxes = pile.boxes[list(group), :3]
        foot, rise = boxes[0, :2].max(), bodies[b, X + 2] - (pile.boxes[group[0], 5] + bodies[b, X + 2] - boxes[0, 2])
        fates[b, LEAN] = math.cos(max(FALLEN_TILT, math.atan2(foot, rise) + 0.1))
        fates[b, FLOOR] = bodies[b, X + 2] - FALLEN_DROP * 2.0 * boxes.min()
    return fates


def _lean(pile: PileArrays, bodies: FloatArray, name: str, angle: float) -> None:
    """Lean a body about y, over the outermost point of its lower joint."""
    if name not in pile.body.names or pile.owner[pile.body.names.index(name)] == len(pile.members):
        raise ParameterError("no free stone is called {name!r}; there are {names}", name=name, names=list(pile.body.names))
    b = int(pile.owner[pile.body.names.index(name)])
    box = pile.boxes[pile.members[b][0]]
    inset = 0.0 if pile.points == 2 else 1.0 / pile.points
    pivot = np.array([math.copysign(box[0] * (1.0 - inset), angle), 0.0, -box[2]]) + box[3:]
    turned = np.array([math.cos(angle), math.sin(angle)])
    moved = np.array([turned[0] * pivot[0] + turned[1] * pivot[2], 0.0, -turned[1] * pivot[0] + turned[0] * pivot[2]])
    bodies[b, X : X + 3] += pivot - moved
    bodies[b, Q : Q + 4] = (math.cos(0.5 * angle), 0.0, math.sin(0.5 * angle), 0.0)
    orient(bodies[b])


def _events(outcome: StackOutcome) -> tuple[Event, ...]:
    """Return the falls, in the order of time."""
    falls = sorted((stone.fell_at_s, stone.name) for stone in outcome.stones if stone.fell_at_s is not None)
    return tuple(Event(f"{name} falls", at, np.zeros(0), np.zeros(0)) for at, name in falls)


def _phases(outcome: StackOutcome, start: float, end: float) -> tuple[Phase, ...]:
    """Return the stretch before and the stretch after the first fall."""
    if outcome.time_s is None:
        return (Phase("standing", start, end),)
    return (Phase("standing", start, outcome.time_s), Phase("fallen", outcome.time_s, end))
