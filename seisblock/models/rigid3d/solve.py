"""Solver of one rigid body in three dimensions: `solve_rigid3d`."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.body_name import body_name
from seisblock.bodies.convex import ConvexBody, convex_body
from seisblock.bodies.scan.body import ScannedBody
from seisblock.bodies.scan.scan import Scan
from seisblock.core.arrays import readonly
from seisblock.core.errors import SolverError
from seisblock.core.i18n import Message, lazy_gettext
from seisblock.core.options import keywords_of
from seisblock.core.results import Channel, Histories, Response, Status
from seisblock.core.typing import FloatArray
from seisblock.dynamics.cancellation import check_cancelled, count_samples, report_progress
from seisblock.models.rigid3d import buffers
from seisblock.models.rigid3d.buffers import RigidHull, V, W, Workspace, X, make_workspace
from seisblock.models.rigid3d.options import Rigid3dOptions
from seisblock.models.rigid3d.outcome import Rigid3dOutcome, build_outcome
from seisblock.models.rigid3d.params import initial_state, return_barrier, rigid_body
from seisblock.models.rigid3d.run import run_rigid3d, start_run
from seisblock.records._validation import validate_inputs, validate_motion, vertical_gain
from seisblock.records.motion import Motion
from seisblock.references import papers

Body = Block | ScannedBody | Scan | ConvexBody

BUDGET = 500
"""Intervals of the record per call of the kernel, between which a run can be cancelled or end."""


@keywords_of(Rigid3dOptions)
def solve_rigid3d(body: Body, motion: Motion, options: Rigid3dOptions) -> Response[Rigid3dOutcome]:
    """Solve the motion in space of a rigid convex body on rigid ground under three components of ground motion.

    Contacts of the hull's vertices with Signorini's condition and Coulomb's cone; a midpoint rule that conserves energy and momentum, split
    at impacts; plastic impacts or Newton's coefficient of restitution, reduced where it would create energy. The model is described in
    :mod:`seisblock.models.rigid3d.step`. After the last sample the ground is at rest and the run continues until the body rests.

    Parameters
    ----------
    body : Block, Scan, ScannedBody or ConvexBody
        A block without a depth is square; +x of a scanned body has its azimuth `facing` where that of the motion is known, else that of the
        motion.
    motion : Motion
        Ground acceleration along, across and up, m/s^2; it may be zero throughout.
    options : keyword arguments
        Fields of :class:`~seisblock.models.rigid3d.options.Rigid3dOptions`.

    Returns
    -------
    Response[Rigid3dOutcome]
        Channels ``x``, ``y``, ``z`` of the centre of gravity relative to the ground, m, quaternion ``qw``, ``qx``, ``qy``, ``qz`` of the
        body, w first, body to ground, and ``tilt``, rad, at each sample of the motion.

    Raises
    ------
    ParameterError
        If a number lies outside its range.
    BodyError
        If a scanned body has no hull.
    ComponentError
        If `vertical` is on for a record without a vertical component.
    SolverError
        If the solution overflows.

    References
    ----------
    [Moreau1988]_, [Jean1999]_, [SimoWong1991]_, [AlartCurnier1991]_

    Examples
    --------
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> outcome = solve_rigid3d(Block(0.24, 0.8), pulse, mu=0.5).outcome
    >>> outcome.overturned, round(outcome.fell_azimuth_deg)
    (True, 180)
    """
    validate_motion_and_body(body, motion)
    gains = (1.0, float(options.across), vertical_gain(motion, options.vertical))
    solid = facing_body(body, motion)
    scratch, rows, status = run(solid, ground_acceleration(motion, gains), motion.dt, options, keep_rows=True)
    if status == Status.NOT_FINITE:
        raise SolverError("the motion of {name} diverged", name=solid.name)
    outcome = build_outcome(scratch, motion.start_s, motion.dt, motion.azimuth_deg)
    return Response(
        "rigid3d",
        outcome,
        motion,
        body if isinstance(body, Block) else solid,
        partial(_histories, motion, rows),
        (),
        (),
        replace(options, across=gains[1], vertical=gains[2]),
        Status(status),
        () if outcome.settled or options.settle_s == 0.0 else (_unsettled(solid, options),),
        papers("rigid body in space"),
    )


def _unsettled(body: ConvexBody, options: Rigid3dOptions) -> Message:
    """Return the warning of a body that still moves at the end."""
    text = "{name}: still in motion {time:g} s after the record; results refer to that instant"
    return lazy_gettext(text, name=body_name(body.name), time=options.settle_s)


def validate_motion_and_body(body: object, motion: object) -> None:
    """Raise `KindError` unless body and motion have types that the solver accepts."""
    if isinstance(body, (Scan, ScannedBody, ConvexBody)):
        validate_motion(motion)
    else:
        validate_inputs(body, Block, motion)


def facing_body(body: Body, motion: Motion) -> ConvexBody:
    """Return a body as a convex one in the axes of a motion: a scanned body is turned to the azimuth that it faces, where known."""
    scanned, solid = body.body if isinstance(body, Scan) else body, convex_body(body)
    if not isinstance(scanned, ScannedBody) or motion.azimuth_deg is None or motion.azimuth_deg == scanned.facing:
        return solid
    return solid.turned(math.radians(motion.azimuth_deg - scanned.facing))


def ground_acceleration(motion: Motion, gains: tuple[float, float, float]) -> FloatArray:
    """Return the accelerations of a motion along, across and up, (3, n), m/s^2, times the gains, for :func:`run`."""
    return readonly(np.ascontiguousarray(motion.acceleration * np.array(gains)[:, None]))


def run(
    body: ConvexBody,
    acceleration: FloatArray,
    dt: float,
    options: Rigid3dOptions,
    *,
    keep_rows: bool = False,
    until_decided: bool = False,
) -> tuple[Workspace, FloatArray, int]:
    """Run a body under ground accelerations, (3, n), m/s^2; return its state and ledger, rows at the samples, and the status.

    With `until_decided`, a run ends when the rest of the motion cannot return a body that has overturned to its base.
    """
    constants = rigid_body(body, options)
    samples = acceleration.shape[1]
    scratch = make_workspace(constants.vertices.shape[1])
    rows = np.zeros((samples if keep_rows else 0, 7))
    initial_state(constants, options.initial, scratch.state)
    scratch.ledger[[buffers.OVERTURNING_TIME, buffers.LIFT_TIME]] = math.nan
    scratch.ledger[[buffers.START_X, buffers.START_Y]] = scratch.state[X : X + 2]
    last = samples - 1 + math.ceil(options.settle_s / dt)
    start_run(constants, scratch)
    remaining, barrier = _remaining_speed(acceleration, dt) if until_decided else None, None
    status = int(Status.PAUSED)
    while status == Status.PAUSED:
        check_cancelled()
        status = run_rigid3d(acceleration, dt, last, BUDGET, constants, scratch, rows)
        if remaining is not None and math.isfinite(scratch.ledger[buffers.OVERTURNING_TIME]):
            barrier = barrier or return_barrier(body, constants)
            speed = remaining[min(int(scratch.counters[buffers.SAMPLE]), samples - 1)]
            if _cannot_return(constants, scratch, *barrier, speed):
                status = int(Status.STOPPED)
        report_progress(*count_samples(int(scratch.counters[buffers.SAMPLE]), samples - 1, last))
    return scratch, rows, status


def _remaining_speed(acceleration: FloatArray, dt: float) -> FloatArray:
    """Return the integral of the amount of an acceleration, (3, n), m/s^2, from each sample to the last, (n,), m/s."""
    amount = np.sqrt((acceleration**2).sum(axis=0))
    # the amount is convex between samples: the trapezoidal rule is an upper bound
    return np.append(np.cumsum(0.5 * dt * (amount[1:] + amount[:-1])[::-1])[::-1], 0.0)


def _cannot_return(constants: RigidHull, scratch: Workspace, lowest: float, barrier: float, speed: float) -> bool:
    """Return whether the rest of a motion, with its integral of the amount of the acceleration, m/s, is too weak for a body to return.

    The energy above the lowest position, E = m u^2/2, is no less than the kinetic one. Contacts only dissipate, so that
    dE/dt <= -m a . v <= m |a| u, and u grows by no more than the integral of |a| (derived here).
    """
    gravity, mass = constants.constants[[buffers.GRAVITY, buffers.MASS]].tolist()
    velocity, spin = scratch.state[V : V + 3], scratch.state[W : W + 3]
    kinetic = 0.5 * (velocity @ velocity + spin @ constants.inertia.reshape(3, 3) @ spin / mass)
    energy = float(kinetic + gravity * (scratch.state[X + 2] - lowest))
    return math.sqrt(2.0 * max(energy, 0.0)) + speed < math.sqrt(2.0 * gravity * max(barrier - lowest, 0.0))


def _histories(motion: Motion, rows: FloatArray) -> Histories:
    """Return the channels at the samples of the motion."""
    w, x, y, z = rows[:, 3:].T
    tilt = 2.0 * np.arctan2(np.hypot(x, y), np.hypot(w, z))
    names = (("x", "m"), ("y", "m"), ("z", "m"), ("qw", "1"), ("qx", "1"), ("qy", "1"), ("qz", "1"))
    channels = (*(Channel(name, unit, rows[:, k], name) for k, (name, unit) in enumerate(names)), Channel("tilt", "rad", tilt, "θ"))
    return Histories(motion.time, channels)
