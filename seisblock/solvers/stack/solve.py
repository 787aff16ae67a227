"""A pile of stones on a shaking base: three-dimensional distinct elements ([Furukawa2009]_ section 3)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict
from functools import partial

import numpy as np

from seisblock import checks
from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.errors import SolverError
from seisblock.records.given import Factor, check_call, vertical_gain
from seisblock.records.motion import Motion
from seisblock.references import papers
from seisblock.results import Event, Histories, Phase, Response, Status
from seisblock.solvers.stack.arrays import pile_arrays
from seisblock.solvers.stack.course import Course
from seisblock.solvers.stack.outcome import End, StackOutcome, channels, stack_outcome
from seisblock.solvers.stack.rest import steps_per_sample
from seisblock.units import STANDARD_GRAVITY


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
    up = vertical_gain(motion, vertical)
    course = Course(pile, motion, (float(across), up), gravity, steps, stop_at_fall, tilts or {})
    end = course.follow(progress=progress)
    if end.status == Status.NOT_FINITE:
        raise SolverError(
            "the pile {name} left the finite numbers at {ended:.3f} s: give a finer time step", name=body.name, ended=end.time
        )
    outcome = stack_outcome(pile, end, start=motion.start_s, gravity=gravity, step=motion.dt / steps)
    return Response(
        model="stack",
        outcome=outcome,
        motion=motion,
        body=body,
        make_histories=partial(_curves, course, end),
        phases=_phases(outcome, motion.start_s, motion.start_s + end.time),
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
        status=end.status,
        citations=papers("pile"),
    )


def _curves(course: Course, end: End) -> Histories:
    """Return tilt, slip and place of every stone against time."""
    track = course.track(end)
    return Histories(course.motion.start_s + track.time, channels(course.pile, track))


def _events(outcome: StackOutcome) -> tuple[Event, ...]:
    """Return the falls, in the order of time."""
    falls = sorted((stone.fell_at_s, stone.name) for stone in outcome.stones if stone.fell_at_s is not None)
    return tuple(Event(f"{name} falls", at, np.zeros(0), np.zeros(0)) for at, name in falls)


def _phases(outcome: StackOutcome, start: float, end: float) -> tuple[Phase, ...]:
    """Return the stretch before and the stretch after the first fall."""
    if outcome.time_s is None:
        return (Phase("standing", start, end),)
    return (Phase("standing", start, outcome.time_s), Phase("fallen", outcome.time_s, end))
