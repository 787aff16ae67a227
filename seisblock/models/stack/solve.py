"""Solver of a pile of stones on a shaking base: three-dimensional discrete elements ([Furukawa2009]_ section 3)."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.core import checks
from seisblock.core.errors import ParameterError, SolverError
from seisblock.core.i18n import N_, Message, lazy_gettext
from seisblock.core.options import keywords_of
from seisblock.core.results import Event, Histories, Phase, Response, Status
from seisblock.core.typing import FloatArray
from seisblock.models.stack.arrays import PLASTIC_RESTITUTION, pile_arrays
from seisblock.models.stack.options import EDGES, RIGID, SPRINGS, StackOptions
from seisblock.models.stack.outcome import SimulationResult, StackOutcome, StoneState, stack_outcome, stone_channels
from seisblock.models.stack.recorder import SOLVED, UNCONVERGED
from seisblock.models.stack.simulation import Simulation
from seisblock.models.stack.static_equilibrium import rigid_steps_per_sample, steps_per_sample
from seisblock.records._validation import validate_inputs, vertical_gain
from seisblock.records.motion import Motion
from seisblock.references import papers

REFINEMENT_FACTOR = 5
"""Refinement of the step after a run with rigid contacts that created energy."""

MAX_UNCONVERGED_SHARE, MIN_STEPS_FOR_WARNING = 0.5, 100
"""Share of unconverged steps, and smallest number of steps, above which a warning is issued."""


@keywords_of(StackOptions)
def solve_stack(body: Pile, motion: Motion, options: StackOptions) -> Response[StackOutcome]:
    """Solve the response of a pile of stones to a ground motion ([Furukawa2009]_ section 3(1)).

    Stones are rigid, with quaternions for rotations. They touch at the points of each joint, and at corners and edges once they have tilted
    or moved off it. Contacts are rigid, with impulses that obey Signorini's condition and Coulomb's cone ([Jean1999]_, [Moreau1988]_), or
    act through springs, dashpots and sliders ([Furukawa2009]_). Valid for any tilt and any fall.

    Parameters
    ----------
    body : Pile
    motion : Motion
        Ground acceleration; +x is its first row.
    options : keyword arguments
        Fields of :class:`~seisblock.models.stack.options.StackOptions`. Default law: springs if `contact` is given,
        else rigid. If rigid contacts create energy at the default step, the run is repeated with a step five times finer, with a
        warning; if that fails too, with springs, unless an option excludes them. Kinetic friction and restitution: rigid contacts
        only, restitution also on edges only; its default, conservation of angular momentum about the striking edge, is Housner's for
        one block.

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
        If `step` is unstable or needlessly fine, or an option is out of range.
    SolverError
        If the run created energy or diverged.

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.bodies.pile.toml import load_pile
    >>> pulse = Motion.from_arrays(2.0 * np.sin(np.linspace(0.0, np.pi, 11)), 0.01)
    >>> solve_stack(load_pile("wagata"), pulse, points=2).outcome.overturned
    ()
    """
    validate_inputs(body, Pile, motion)
    points, contact, restitution, gravity, step = options.points, options.contact, options.restitution, options.gravity, options.step
    rigid = _is_rigid(options.law, contact)
    springs = None if rigid else PileContact() if contact is None else checks.instance(contact, PileContact)
    body = _with_kinetic_friction(body, rigid, options.mu_kinetic, restitution)
    pile = pile_arrays(body, springs, points, _joint_restitution(points, restitution))
    steps = rigid_steps_per_sample(pile, motion.dt, step, gravity) if rigid else steps_per_sample(pile, motion.dt, step)
    gains = (float(options.across), vertical_gain(motion, options.vertical))
    simulation = Simulation(pile, motion, gains, gravity, steps, rigid, options.stop_at_fall, options.tilts or {})
    end = simulation.run(progress=options.progress)
    if end.status == Status.NOT_FINITE:
        raise SolverError(
            "the integration of the pile {name} diverged at {ended:.3f} s: give a finer `step`", name=body.name, ended=end.time
        )
    try:
        outcome = stack_outcome(pile, end, start=motion.start_s, gravity=gravity, step=motion.dt / steps, azimuth=motion.azimuth_deg)
    except SolverError as error:
        # a step chosen by the caller is not changed silently
        if not rigid or step is not None:
            raise
        return _retry_finer(error, body, motion, options, motion.dt / steps / REFINEMENT_FACTOR)
    return Response(
        model="stack",
        outcome=outcome,
        motion=motion,
        body=body,
        make_histories=partial(_curves, simulation, end),
        phases=_phases(outcome, motion.start_s, motion.start_s + end.time),
        events=_events(outcome),
        options=replace(
            options,
            law=RIGID if rigid else SPRINGS,
            contact=springs,
            across=gains[0],
            vertical=gains[1],
            step=motion.dt / steps,
            progress=None,
        ),
        status=end.status,
        citations=papers("rigid pile" if rigid else "pile"),
        warnings=_convergence_warnings(end.output.energy_ledger, motion),
    )


def _convergence_warnings(ledger: FloatArray, motion: Motion) -> tuple[Message, ...]:
    """Return a warning if most steps did not converge: displacements are then overestimated."""
    share = ledger[UNCONVERGED] / max(ledger[SOLVED], MIN_STEPS_FOR_WARNING)
    if share <= MAX_UNCONVERGED_SHARE:
        return ()
    return (
        lazy_gettext(
            "{name}: contact forces did not converge in {share:.0f} % of the steps (large mass ratios?); displacements may be "
            "overestimated; give a finer `step`",
            name=motion.name or "x",
            share=100.0 * share,
        ),
    )


def _retry_finer(error: SolverError, body: Pile, motion: Motion, options: StackOptions, step: float) -> Response[StackOutcome]:
    """Return the response with finer steps after rigid contacts created energy, or with springs if these steps fail too."""
    label = motion.name or "x"
    try:
        response = solve_stack(body, motion, **replace(options, step=step).keywords())
        message = lazy_gettext(
            "{name}: solved with a finer step of {step:.2g} s, since the default step failed: {why}",
            name=label,
            step=step,
            why=error.message,
        )
    except SolverError as second_error:
        # springs have one friction coefficient and no cylinders
        needs_rigid = body.has_lower_kinetic_friction or any(stone.is_round for stone in body.stones)
        if needs_rigid or any(value is not None for value in (options.law, options.mu_kinetic, options.restitution)):
            raise
        response = solve_stack(body, motion, **replace(options, law=SPRINGS).keywords())
        message = lazy_gettext(
            "{name}: solved with contact springs, since rigid contact failed: {why}", name=label, why=second_error.message
        )
    return replace(response, warnings=(message, *response.warnings))


def _is_rigid(law: str | None, contact: PileContact | None) -> bool:
    if law not in (None, RIGID, SPRINGS):
        raise ParameterError("`law` must be {rigid!r} or {springs!r}, found {law!r}", rigid=RIGID, springs=SPRINGS, law=law)
    if law == RIGID and contact is not None:
        raise ParameterError("`contact` has no effect with rigid contact: omit it, or give the law {springs!r}", springs=SPRINGS)
    return contact is None if law is None else law == RIGID


def _with_kinetic_friction(body: Pile, rigid: bool, mu_kinetic: float | None, restitution: float | None) -> Pile:
    """Return the pile with the given kinetic friction; raise ParameterError for options that springs do not support."""
    if not rigid and not (mu_kinetic is None and restitution is None):
        raise ParameterError("`mu_kinetic` and `restitution` have no effect with contact springs: omit them, or give the law 'rigid'")
    if mu_kinetic is not None:
        body = body.with_kinetic_friction(mu_kinetic)
    if not rigid and body.has_lower_kinetic_friction:
        raise ParameterError(
            "the pile {name} has a kinetic friction coefficient, but contact springs use a single one: give `mu` for both, or "
            "the law 'rigid'",
            name=body.name,
        )
    return body


def _joint_restitution(points: int, restitution: float | None) -> float:
    """Return the restitution of the joints, negative for plastic impacts."""
    if restitution is not None:
        checks.fraction(N_("the restitution of the joints"), restitution)
        if points != EDGES:
            raise ParameterError(
                "`restitution` requires contact at the edges: omit `points` ({points} along each side of a joint)", points=points
            )
    return PLASTIC_RESTITUTION if restitution is None else float(restitution)


def _curves(simulation: Simulation, end: SimulationResult) -> Histories:
    """Return tilt, slip, centre and quaternion of every stone against time."""
    track = simulation.full_track(end)
    return Histories(simulation.motion.start_s + track.time, stone_channels(simulation.pile, track))


def _events(outcome: StackOutcome) -> tuple[Event, ...]:
    """Return the falls in order of time."""
    falls = sorted((stone.fell_at_s, stone.name) for stone in outcome.stones if stone.fell_at_s is not None)
    return tuple(Event(f"{name} falls", at, np.zeros(0), np.zeros(0)) for at, name in falls)


def _phases(outcome: StackOutcome, start: float, end: float) -> tuple[Phase, ...]:
    """Return the phases before and after the first fall."""
    if outcome.time_s is None:
        return (Phase(StoneState.STANDING, start, end),)
    return (Phase(StoneState.STANDING, start, outcome.time_s), Phase(StoneState.FALLEN, outcome.time_s, end))
