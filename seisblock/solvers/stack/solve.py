"""A pile of stones on a shaking base: three-dimensional distinct elements ([Furukawa2009]_ section 3)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, replace
from functools import partial
from typing import Any

import numpy as np

from seisblock import checks
from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.errors import ParameterError, SolverError
from seisblock.records.given import Factor, check_call, vertical_gain
from seisblock.records.motion import Motion
from seisblock.references import papers
from seisblock.results import Event, Histories, Phase, Response, Status
from seisblock.solvers.stack.arrays import PLASTIC, pile_arrays
from seisblock.solvers.stack.books import SOLVED, UNSETTLED
from seisblock.solvers.stack.course import Course
from seisblock.solvers.stack.outcome import End, StackOutcome, channels, stack_outcome
from seisblock.solvers.stack.rest import rigid_steps, steps_per_sample
from seisblock.typing import FloatArray
from seisblock.units import STANDARD_GRAVITY
from seisblock.words import Said, noted, said

RIGID, SPRINGS = "rigid", "springs"
"""Laws of contact."""

FINER = 5
"""How many times finer steps answer where rigid stones created energy."""

MOST_UNSETTLED, MANY_STEPS = 0.5, 100
"""Part of the steps whose sweeps may end before they come to rest, of so many at least."""

EDGES = 2
"""Points along each side of a joint that stands on its edges."""


def solve_stack(
    body: Pile,
    motion: Motion,
    *,
    law: str | None = None,
    points: int = 2,
    contact: PileContact | None = None,
    mu_kinetic: float | None = None,
    restitution: float | None = None,
    vertical: Factor | None = None,
    across: Factor = True,
    gravity: float = STANDARD_GRAVITY,
    step: float | None = None,
    stop_at_fall: bool = False,
    tilts: Mapping[str, float] | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Response[StackOutcome]:
    """Follow a pile of stones through a ground motion ([Furukawa2009]_ section 3(1)).

    Every stone is rigid, with quaternions for its turns. Stones meet at points of each joint, and at corners and edges once they have
    tilted or moved off it; there they are rigid too, with impulses that obey Signorini's condition and Coulomb's cone ([Jean1999]_,
    [Moreau1988]_), or press on each other through springs, dashpots and sliders ([Furukawa2009]_). Valid for any tilt and any fall.

    Parameters
    ----------
    body : Pile
    motion : Motion
        Ground acceleration; +x is its first row.
    law : str
        ``rigid`` or ``springs``; default: springs where `contact` is given, else rigid. Where rigid stones created energy at the default
        step, one five times finer answers, with a warning; where they do so there, too, springs, unless something was asked for that
        these do not know.
    points : int
        Contact points along each side of a joint: 2 stand at the corners, 5 at segment centres as in [Furukawa2009]_.
    contact : PileContact
        Of springs; default: [Furukawa2009]_ table 2.
    mu_kinetic : float, 1
        Friction of every joint that slides, at most that of the same joint when it clings; default: the body's own. Rigid stones only.
    restitution : float, 1
        Of the joints: with what part of the velocity of the edge that strikes the opposite edge leaves. Default: what angular momentum
        about the edge that strikes gives, Housner's ratio for one block. Rigid stones on edges only.
    vertical : bool, float or None
        Whether the vertical ground motion acts, or a factor on it; None: where the record has one.
    across : bool or float
        Whether the motion's transverse row acts, or a factor on it.
    gravity : float, m/s^2
    step : float, s
        Fixed step; default: 1/55 of the time in which the smallest stone swings; of springs, 0.7 of what the stiffest contact admits.
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
    checks.gravity(gravity)
    rigid = _is_rigid(law, contact)
    springs = None if rigid else PileContact() if contact is None else checks.instance(contact, PileContact)
    body = _sliding(body, rigid, mu_kinetic, restitution)
    pile = pile_arrays(body, springs, points, _rebound(points, restitution))
    steps = rigid_steps(pile, motion.dt, step, gravity) if rigid else steps_per_sample(pile, motion.dt, step)
    up = vertical_gain(motion, vertical)
    course = Course(pile, motion, (float(across), up), gravity, steps, rigid, stop_at_fall, tilts or {})
    end = course.follow(progress=progress)
    if end.status == Status.NOT_FINITE:
        raise SolverError(
            "the pile {name} left the finite numbers at {ended:.3f} s: give a finer time step", name=body.name, ended=end.time
        )
    try:
        outcome = stack_outcome(pile, end, start=motion.start_s, gravity=gravity, step=motion.dt / steps, azimuth=motion.azimuth_deg)
    except SolverError as error:
        if not rigid or step is not None:
            raise
        given: dict[str, Any] = {"law": law, "mu_kinetic": mu_kinetic, "restitution": restitution}
        rest: dict[str, Any] = {"points": points, "vertical": vertical, "across": across, "gravity": gravity}
        rest |= {"stop_at_fall": stop_at_fall, "tilts": tilts, "progress": progress}
        return _instead(error, body, motion, motion.dt / steps / FINER, given, rest)
    return Response(
        model="stack",
        outcome=outcome,
        motion=motion,
        body=body,
        make_histories=partial(_curves, course, end),
        phases=_phases(outcome, motion.start_s, motion.start_s + end.time),
        events=_events(outcome),
        options={
            "law": RIGID if rigid else SPRINGS,
            "points": points,
            "mu": body.mu,
            "mu_kinetic": body.friction()[1],
            "restitution": restitution,
            "vertical": up,
            "across": float(across),
            "gravity_m_s2": gravity,
            "step_s": motion.dt / steps,
            "contact": None if springs is None else asdict(springs),
        },
        status=end.status,
        citations=papers("rigid pile" if rigid else "pile"),
        warnings=_doubts(end.kept.books, motion),
    )


def _doubts(books: FloatArray, motion: Motion) -> tuple[Said, ...]:
    """Return what there is to say against a run most of whose steps did not come to rest: slips are then too large."""
    share = books[UNSETTLED] / max(books[SOLVED], MANY_STEPS)
    if share <= MOST_UNSETTLED:
        return ()
    return (
        said(
            "{name}: the forces between the stones did not come to rest in {share:.0f} % of the steps, as where a stone bears one "
            "a hundred times as heavy: slips may be too large; give a finer `step`",
            name=motion.name or "x",
            share=100.0 * share,
        ),
    )


def _instead(
    error: SolverError, body: Pile, motion: Motion, finer: float, given: dict[str, Any], rest: dict[str, Any]
) -> Response[StackOutcome]:
    """Return what finer steps answer where rigid stones created energy, or springs where these do, too."""
    label = motion.name or "x"
    try:
        found = solve_stack(body, motion, step=finer, **given, **rest)
        why = said("{name}: steps of {step:.2g} s answer instead of coarser ones: {why}", name=label, step=finer, why=error.said)
    except SolverError as again:
        unknown = body.slides_easier or any(stone.is_round for stone in body.stones)
        if unknown or any(value is not None for value in given.values()):
            raise
        found = solve_stack(body, motion, law=SPRINGS, **rest)
        why = said("{name}: springs at the same points answer instead of rigid stones: {why}", name=label, why=again.said)
    return replace(found, warnings=(why, *found.warnings))


def _is_rigid(law: str | None, contact: PileContact | None) -> bool:
    """Return whether contacts are rigid."""
    if law not in (None, RIGID, SPRINGS):
        raise ParameterError("the law of contact must be {rigid!r} or {springs!r}, found {law!r}", rigid=RIGID, springs=SPRINGS, law=law)
    if law == RIGID and contact is not None:
        raise ParameterError("rigid stones have no springs: leave `contact` out, or choose the law {springs!r}", springs=SPRINGS)
    return contact is None if law is None else law == RIGID


def _sliding(body: Pile, rigid: bool, mu_kinetic: float | None, restitution: float | None) -> Pile:
    """Return the pile with the kinetic friction asked for, refusing springs what they do not know."""
    if not rigid and not (mu_kinetic is None and restitution is None):
        raise ParameterError("springs have one friction and their own dashpots: `mu_kinetic` and `restitution` go with rigid stones")
    if mu_kinetic is not None:
        body = body.sliding_at(mu_kinetic)
    if not rigid and body.slides_easier:
        raise ParameterError(
            "the pile {name} has a kinetic friction, and springs have one friction for all: say `mu`, which then holds for "
            "what slides, too, or choose rigid stones",
            name=body.name,
        )
    return body


def _rebound(points: int, restitution: float | None) -> float:
    """Return the rebound of the joints."""
    if restitution is not None:
        checks.fraction(noted("the restitution of the joints, a ratio of velocities,"), restitution)
        if points != EDGES:
            raise ParameterError(
                "a restitution is one of stones that stand on their edges: leave out {points} points a side", points=points
            )
    return PLASTIC if restitution is None else float(restitution)


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
