"""What a free-standing body does under a motion, whichever comes: from a body, a motion and friction to a response."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from seisblock.bodies.block import Block
from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.core import checks
from seisblock.core.results import Channel, Histories, Response, make_events
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.models.respond import constants
from seisblock.models.respond.curves import curves
from seisblock.models.respond.describe import event_name, run_warnings
from seisblock.models.respond.outcome import RespondOutcome, build_outcome, motion_modes, phases, run_status
from seisblock.models.respond.params import Body, Initial, RespondParams, motion_gains, rigid_body
from seisblock.models.respond.run import Run, check_settling, run
from seisblock.records import Motion
from seisblock.records._validation import Gain, validate_inputs
from seisblock.references import papers

PERTURBATION = 1e-6
"""Change of the input, as a share, that must not change a verdict."""


def solve_respond(
    block: Body,
    motion: Motion,
    *,
    mu: float,
    mu_kinetic: float | None = None,
    restitution: float = 0.0,
    rocking_restitution: float | None = None,
    vertical: Gain | None = None,
    gravity: float = STANDARD_GRAVITY,
    initial: Initial = None,
    settle_s: float = 60.0,
    tenon: float = 0.0,
    further_points: Sequence[tuple[float, float]] = (),
    sensitivity: bool = True,
) -> Response[RespondOutcome]:
    """Return what a free-standing rigid body does under a motion: rests, slides, rocks, slides while rocking, flies, falls.

    Plane motion of a rigid body on rigid ground with Coulomb friction, every change of mode located exactly; see
    :mod:`seisblock.models.respond.model` for the model. After the record's last sample the ground is still, until the body rests.

    Parameters
    ----------
    block : Block or TwoLayerBlock
        The latter as one rigid body.
    motion : Motion
        Ground acceleration, m/s^2.
    mu : float
        Static friction coefficient, 0 or more.
    mu_kinetic : float or None
        Kinetic friction coefficient, 0 to `mu`, also inside impacts; None: as `mu`.
    restitution : float
        Poisson's, of an impact at one corner, in [0, 1).
    rocking_restitution : float or None
        Angular velocity after over before when the other corner comes down, in [0, 1], in place of the impact law, where energy allows
        it; landings keep `restitution`.
    vertical : bool, float or None
        Whether the vertical ground motion acts, or a factor on it; None: where the record has one.
    gravity : float, m/s^2
    initial : six floats or None
        x and y of the centre of gravity relative to the ground, m, lean, rad, and their rates at the first sample; None: upright, at rest.
    settle_s : float, s
        How long the body is followed after the record.
    tenon : float, m
        Depth to which tenons hold the feet against sliding, until in flight the lower one has risen by as much; 0: none. Ours. A tenon
        pressed aside binds: it keeps a foot down that the ground no longer presses, as long as that would not rise by itself.
    further_points : sequence of (float, float), m
        Points of the body, to +x of the centre of gravity and above it, that end the motion when they meet the ground.
    sensitivity : bool
        Whether to look, by two more runs, if a change of the input by 1e-6 changes the verdict.

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
        If body or motion is something else.
    ComponentError
        If the vertical motion is asked of a record without one.
    SolverError
        If the motion overflows.

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
    params = respond_params(
        block,
        mu=mu,
        mu_kinetic=mu_kinetic,
        restitution=restitution,
        rocking_restitution=rocking_restitution,
        gravity=gravity,
        tenon=tenon,
        further_points=further_points,
    )
    check_settling(settle_s)
    citations = papers("all modes", *(("two-layer body",) if isinstance(block, TwoLayerBlock) else ()))
    factors = motion_gains(motion, vertical)
    result = run(params, motion, factors, initial, settle_s)
    sensitive = is_sensitive(result, params, motion, factors, initial, settle_s) if sensitivity else None
    outcome = build_outcome(result, params, motion.start_s, sensitive)
    options = {
        "mu": params.mu,
        "mu_kinetic": params.mu_kinetic,
        "restitution": restitution,
        "rocking_restitution": rocking_restitution,
        "vertical": factors[2],
        "gravity_m_s2": gravity,
        "initial": None if initial is None else list(initial),
        "settle_s": settle_s,
        "tenon_m": tenon,
        "further_points_m": [list(point) for point in params.further_points],
    }
    return Response(
        "respond",
        outcome,
        motion,
        block,
        partial(_curves, result, params, motion, factors),
        phases(outcome.events, outcome.end_s),
        make_events(result.events, motion.start_s, event_name),
        options,
        run_status(result),
        run_warnings(result, params, outcome.end_s, settle_s),
        citations,
    )


def respond_params(
    block: Body,
    *,
    mu: float,
    mu_kinetic: float | None = None,
    restitution: float = 0.0,
    rocking_restitution: float | None = None,
    gravity: float = STANDARD_GRAVITY,
    tenon: float = 0.0,
    further_points: Sequence[tuple[float, float]] = (),
) -> RespondParams:
    """Return all that determines a run but the motion, checked, as :func:`respond_many` takes it.

    Parameters
    ----------
    block : Block or TwoLayerBlock
    mu, mu_kinetic, restitution, rocking_restitution, gravity, tenon, further_points
        As in :func:`solve_respond`.

    Raises
    ------
    ParameterError
        If a number lies outside its range.
    BodyError
        If the centre of gravity does not lie above the base.

    Examples
    --------
    >>> respond_params(Block(0.24, 0.8), mu=0.5).mu_kinetic
    0.5
    """
    checks.instance(block, TwoLayerBlock if isinstance(block, TwoLayerBlock) else Block)
    return RespondParams(
        rigid_body(block),
        mu,
        mu if mu_kinetic is None else mu_kinetic,
        restitution,
        rocking_restitution,
        gravity,
        tenon,
        tuple((float(point_x), float(point_y)) for point_x, point_y in further_points),
    )


def verdict(result: Run) -> tuple[bool, bool]:
    """Return whether the body has fallen, and whether to +x."""
    is_overturned = result.mode == constants.OVERTURNED
    return is_overturned, is_overturned and bool(result.final[constants.THETA] > 0.0)


def is_sensitive(
    result: Run, params: RespondParams, motion: Motion, factors: tuple[float, float, float], initial: Initial, settle_s: float
) -> bool:
    """Whether 1 - 1e-6 or 1 + 1e-6 times the motion leads to another verdict."""
    for factor in (1.0 - PERTURBATION, 1.0 + PERTURBATION):
        gain_along, gain_across, gain_up = (factor * gain for gain in factors)
        if verdict(run(params, motion, (gain_along, gain_across, gain_up), initial, settle_s, keep_path=False)) != verdict(result):
            return True
    return False


def _curves(result: Run, params: RespondParams, motion: Motion, factors: tuple[float, float, float]) -> Histories:
    """Return the curves on the run's own time axis, both limits at each event."""
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
