"""Rocking and overturning of one block: from a motion and a block to a response."""

from __future__ import annotations

import math
from functools import partial

from seisblock.bodies.block import Block, Restitution
from seisblock.core.errors import ParameterError
from seisblock.core.results import Channel, Histories, Response, Status, make_events
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.dynamics import Trajectory, integrate
from seisblock.models.rock import model
from seisblock.models.rock.free_rocking import FreeRockingOutcome, free_rocking_outcome
from seisblock.models.rock.outcome import RockOutcome, build_outcome, event_name, phases, warnings
from seisblock.models.rock.params import RockParams, rock_params
from seisblock.records import Motion
from seisblock.records._validation import Gain
from seisblock.references import papers


def solve_rock(
    block: Block,
    motion: Motion,
    *,
    restitution: Restitution = None,
    linear: bool = False,
    vertical: Gain | None = False,
    gravity: float = STANDARD_GRAVITY,
    initial: tuple[float, float] = (0.0, 0.0),
) -> Response[RockOutcome]:
    """Return how a rigid block rocks under a motion, and whether it overturns.

    Plane rocking about the two lower corners without slip; see :mod:`seisblock.models.rock.model` for the equations, the rule of rest
    and the signs (rotation is positive when the block leans to +x). After the record's last sample the fate is decided by energy.

    Parameters
    ----------
    block : Block
    motion : Motion
        Ground acceleration, m/s^2.
    restitution : float, or a pair
        Ratio of angular velocities at an impact, in [0, 1], or that onto the right and that onto the left corner; by default from
        the angular momentum about the corner that is struck, 1 - 1.5 sin^2(alpha) for a rectangle ([Housner1963]_).
    linear : bool
        Whether to use the linear equation of slender blocks ([Zhang2001]_ eqs. (4), (5)).
    vertical : bool, float or None
        Whether the vertical ground motion acts, too, or a factor on it; None: where the record has one.
    gravity : float, m/s^2
    initial : (float, float), rad, rad/s
        Lean and angular velocity at the first sample.

    Returns
    -------
    Response[RockOutcome]
        Channels ``rotation`` (rad), ``angular_velocity`` (rad/s), ``ground_acceleration`` and ``vertical_acceleration`` (m/s^2).

    Raises
    ------
    ParameterError
        If the restitution lies outside [0, 1] or gravity is not positive.
    ComponentError
        If the vertical motion is asked of a record without one.
    SolverError
        If a restitution of 1 makes it rock on in ever smaller hops.

    References
    ----------
    [Housner1963]_, [Zhang2001]_, [Ishiyama1982]_

    Examples
    --------
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> outcome = solve_rock(Block(0.24, 0.8), pulse).outcome
    >>> outcome.overturned, outcome.overturned_towards, outcome.decided_after_record
    (True, '-x', True)
    """
    params = rock_params(block, motion, restitution=restitution, linear=linear, vertical=vertical, gravity=gravity)
    p = model.parameters(params, motion.dt)
    trajectory = integrate(model.ROCKING, motion, p, initial, initial_mode(params, initial), gains=params.gains())
    outcome = build_outcome(params, motion, trajectory, outcome_after_record(trajectory, params))
    return Response(
        "rock",
        outcome,
        motion,
        block,
        partial(_curves, params, motion, trajectory),
        phases(trajectory, motion.start_s),
        make_events(trajectory.events, motion.start_s, event_name),
        {"restitution": restitution, "linear": linear, "vertical": params.vertical, "gravity_m_s2": gravity},
        Status(trajectory.status),
        warnings(params, outcome),
        papers("rocking"),
    )


def _curves(params: RockParams, motion: Motion, trajectory: Trajectory) -> Histories:
    """Return what the block and the ground did, on the trajectory's own time axis, both limits at each event."""
    time, states, _ = trajectory.table()
    channels = (
        Channel("rotation", "rad", states[:, model.THETA], "θ"),
        Channel("angular_velocity", "rad/s", states[:, model.OMEGA], "θ'"),
        Channel("ground_acceleration", "m/s^2", trajectory.interpolate(motion.horizontal), "a"),
        Channel("vertical_acceleration", "m/s^2", params.vertical * trajectory.interpolate(motion.vertical), "a_v"),
    )
    return Histories(motion.start_s + time, channels)


def initial_mode(params: RockParams, initial: tuple[float, float]) -> int:
    """Return the mode in which a block with this lean and angular velocity is."""
    theta, omega = initial
    if not (abs(theta) < math.pi / 2 and math.isfinite(omega)):
        raise ParameterError(
            "the initial lean must lie within pi/2 rad and its rate be finite, found {theta} rad and {omega} rad/s",
            theta=theta,
            omega=omega,
        )
    if theta == 0.0 and omega == 0.0:
        return model.REST
    right, left = params.alphas
    if theta > 0.0 or (theta == 0.0 and omega > 0.0):
        return model.BEYOND_RIGHT if theta > right else model.TO_RIGHT
    return model.BEYOND_LEFT if -theta > left else model.TO_LEFT


def outcome_after_record(trajectory: Trajectory, params: RockParams) -> FreeRockingOutcome | None:
    """Return what free rocking makes of the block after the record's end, None when at rest or overturned by then."""
    if trajectory.final_mode in (model.REST, model.OVERTURNED):
        return None
    theta, omega = trajectory.final
    return free_rocking_outcome(params, float(theta), float(omega))
