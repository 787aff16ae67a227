"""Full-response solver of a free-standing body: `solve_respond` and the validated parameters of a run."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.core import checks
from seisblock.core.options import keywords_of
from seisblock.core.results import Channel, Histories, Response, make_events
from seisblock.core.typing import FloatArray, IntArray
from seisblock.models.respond import constants
from seisblock.models.respond.names import event_name, run_warnings
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.outcome import RespondOutcome, RunEnd, build_outcome, motion_modes, phases, run_end, run_status
from seisblock.models.respond.params import Body, RespondParams, RigidBody, motion_gains, rigid_body
from seisblock.models.respond.run import Run, check_settling, run
from seisblock.records import Motion
from seisblock.records._validation import validate_inputs
from seisblock.references import papers


@dataclass(frozen=True, eq=False)
class Curves:
    """Motion of the body relative to the ground, (n,) arrays, SI.

    Parameters
    ----------
    rotation, angular_velocity : rad, rad/s
    displacement, velocity : m, m/s
        Centre of gravity, along +x.
    height, rise_rate : m, m/s
        Centre of gravity above the ground.
    lift : m
        Height of the lowest corner above the ground.
    slip_velocity : m/s
        Corners in contact; zero in flight.
    """

    rotation: FloatArray
    angular_velocity: FloatArray
    displacement: FloatArray
    velocity: FloatArray
    height: FloatArray
    rise_rate: FloatArray
    lift: FloatArray
    slip_velocity: FloatArray


def curves(body: RigidBody, states: FloatArray, modes: IntArray) -> Curves:
    """Return the kinematics of states (n, n_states) in modes (n,).

    Terminal (negative) modes must be replaced by the mode that they ended, see ``outcome.motion_modes``.
    """
    kind = modes % constants.TENON_OFFSET
    in_flight = (kind == constants.FLIGHT) | (kind == constants.START)
    about_left = np.isin(kind, (constants.ROCK_LEFT, constants.SLIDE_ROCK_LEFT_PLUS, constants.SLIDE_ROCK_LEFT_MINUS))
    xi = np.where(about_left, -body.left, body.right)
    theta, omega = states[:, constants.THETA], states[:, constants.OMEGA]
    rx = xi * np.cos(theta) - body.height * np.sin(theta)
    ry = -xi * np.sin(theta) - body.height * np.cos(theta)
    gap = np.where(in_flight, states[:, constants.GAP_RIGHT], 0.0)
    rate = np.where(in_flight, states[:, constants.RATE_RIGHT], 0.0)
    speed = states[:, constants.SPEED]
    return Curves(
        theta,
        omega,
        states[:, constants.X],
        np.where(in_flight, speed, speed - ry * omega),
        gap - ry,
        rate + rx * omega,
        np.where(in_flight, np.minimum(states[:, constants.GAP_LEFT], states[:, constants.GAP_RIGHT]), 0.0),
        np.where(in_flight, 0.0, speed),
    )


def energy(body: RigidBody, gravity: float, states: FloatArray, modes: IntArray) -> FloatArray:
    """Return the sum of kinetic and potential energy, (n,), J, of states (n, n_states) in modes (n,)."""
    motion = curves(body, states, modes)
    kinetic = 0.5 * (motion.velocity**2 + motion.rise_rate**2 + body.gyration_squared * motion.angular_velocity**2)
    return body.mass * (kinetic + gravity * motion.height)


@keywords_of(RespondOptions)
def solve_respond(block: Body, motion: Motion, options: RespondOptions) -> Response[RespondOutcome]:
    """Solve the full response of a free-standing rigid block: rest, sliding, rocking, slide-rocking, flight, overturning.

    Plane motion of a rigid body on rigid ground with Coulomb friction and exactly located mode changes; the model is described in
    :mod:`seisblock.models.respond.model`. After the record's last sample the ground is at rest and the solution continues until the
    body rests.

    Parameters
    ----------
    block : Block or TwoLayerBlock
        A two-layer block is treated as one rigid body.
    motion : Motion
        Ground acceleration, m/s^2.
    options : keyword arguments
        Fields of :class:`~seisblock.models.respond.options.RespondOptions`. Kinetic friction also acts inside
        impacts. A given rocking restitution replaces the impact law, reduced where it would create energy; landings use `restitution`.
        Tenons hold the feet against sliding until, in flight, the lower foot has risen by their depth (extension of this package); a
        tenon under lateral load also holds a foot down as long as the released foot would not rise.

    Returns
    -------
    Response[RespondOutcome]
        Channels ``rotation`` (rad), ``angular_velocity`` (rad/s), ``displacement`` and ``velocity`` of the centre of gravity, its
        ``height``, ``lift`` of the lowest corner, ``slip_velocity`` and ``slip_path`` of the foot, ``ground_acceleration`` and
        ``vertical_acceleration``; SI, relative to the ground, on to the end of the motion.

    Raises
    ------
    ParameterError
        If a number lies outside its range.
    BodyError
        If the centre of gravity does not lie above the base.
    KindError
        If `block` or `motion` has the wrong type.
    ComponentError
        If `vertical` is on for a record without a vertical component.
    SolverError
        If the solution overflows.

    References
    ----------
    [ShentonJones1991]_, [Shenton1996]_, [Housner1963]_, [WangMason1992]_, [Moreau1988]_, [GenotBrogliato1999]_, [Sugimoto2017]_

    Examples
    --------
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> for mu in (0.2, 0.5):
    ...     outcome = solve_respond(Block(0.24, 0.8), pulse, mu=mu).outcome
    ...     print(outcome.outcome, outcome.overturned_towards, f"{outcome.slip_path_m:.2f} m")
    slides None 0.58 m
    overturns -x 0.01 m
    """
    validate_inputs(block, TwoLayerBlock if isinstance(block, TwoLayerBlock) else Block, motion)
    params = respond_params(block, options)
    check_settling(options.settle_s)
    citations = papers("all modes", *(("two-layer body",) if isinstance(block, TwoLayerBlock) else ()))
    factors, initial, settle_s = motion_gains(motion, options.vertical), options.initial, options.settle_s
    result = run(params, motion, factors, initial, settle_s)

    def repeat(change: float) -> RunEnd:
        gain_along, gain_across, gain_up = ((1.0 + change) * gain for gain in factors)
        return run_end(run(params, motion, (gain_along, gain_across, gain_up), initial, settle_s, keep_path=False), ())

    outcome = build_outcome(result, params, motion.start_s, repeat if options.sensitivity else None)
    return Response(
        "respond",
        outcome,
        motion,
        block,
        partial(_curves, result, params, motion, factors),
        phases(outcome.events, outcome.end_s),
        make_events(result.events, motion.start_s, event_name),
        replace(options, mu_kinetic=params.mu_kinetic, vertical=factors[2], further_points=params.further_points),
        run_status(result),
        run_warnings(result.mode, result.final, params, outcome.end_s, settle_s),
        citations,
    )


def respond_params(block: Body, options: RespondOptions) -> RespondParams:
    """Return the validated parameters of a run, for :func:`~seisblock.models.respond.batch.respond_many`.

    Parameters
    ----------
    block : Block or TwoLayerBlock
    options : RespondOptions

    Returns
    -------
    RespondParams

    Raises
    ------
    ParameterError
        If a number lies outside its range.
    BodyError
        If the centre of gravity does not lie above the base.

    Examples
    --------
    >>> from seisblock.models import respond_params
    >>> respond_params(Block(0.24, 0.8), RespondOptions(mu=0.5)).mu_kinetic
    0.5
    """
    checks.instance(block, TwoLayerBlock if isinstance(block, TwoLayerBlock) else Block)
    return RespondParams(
        rigid_body(block),
        options.mu,
        options.mu if options.mu_kinetic is None else options.mu_kinetic,
        options.restitution,
        options.rocking_restitution,
        options.gravity,
        options.tenon,
        tuple((float(point_x), float(point_y)) for point_x, point_y in options.further_points),
    )


def _curves(result: Run, params: RespondParams, motion: Motion, factors: tuple[float, float, float]) -> Histories:
    """Return the time histories at samples and at both limits of each event."""
    time, states, modes = result.table()
    kinematics = curves(params.rigid_body, states, motion_modes(result, modes))
    speed, acceleration = "m/s", "m/s^2"
    channels = (
        Channel("rotation", "rad", kinematics.rotation, "θ"),
        Channel("angular_velocity", "rad/s", kinematics.angular_velocity, "θ'"),
        Channel("displacement", "m", kinematics.displacement, "x"),
        Channel("velocity", speed, kinematics.velocity, "x'"),
        Channel("height", "m", kinematics.height, "y"),
        Channel("lift", "m", kinematics.lift, ""),
        Channel("slip_velocity", speed, kinematics.slip_velocity, "v"),
        Channel("slip_path", "m", states[:, constants.PATH], ""),
        Channel("ground_acceleration", acceleration, result.interpolate(motion.horizontal), "a"),
        Channel("vertical_acceleration", acceleration, factors[2] * result.interpolate(motion.vertical), "a_v"),
    )
    return Histories(motion.start_s + time, channels)
