"""Rocking and overturning of one block: from a motion and a block to a response."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock import checks
from seisblock.bodies.block import Block, Restitution
from seisblock.dynamics import Trajectory, follow
from seisblock.errors import ParameterError
from seisblock.records import Motion
from seisblock.records.given import Factor, check_call, vertical_gain
from seisblock.results import Channel, Event, Response, Status
from seisblock.solvers.rock import model
from seisblock.solvers.rock.aftermath import Fate, fate, sides
from seisblock.solvers.rock.outcome import RockOutcome, event_name, gather, lean_ratio, phases, warnings
from seisblock.units import STANDARD_GRAVITY

CITATIONS = ("Housner1963", "Zhang2001", "Ishiyama1982")


def check_options(restitution: Restitution, gravity: float) -> None:
    """Refuse a restitution outside [0, 1] and a gravity that is not positive."""
    given = () if restitution is None else restitution if isinstance(restitution, tuple) else (restitution,)
    if not all(0.0 <= ratio <= 1.0 for ratio in given):
        raise ParameterError(
            f"the restitution, a ratio of angular velocities, must lie in [0, 1], found {restitution}; "
            "leave it out for 1 - 1.5 sin^2(alpha)"
        )
    checks.gravity(gravity)


def solve_rock(
    block: Block,
    motion: Motion,
    *,
    restitution: Restitution = None,
    linear: bool = False,
    vertical: Factor = False,
    gravity: float = STANDARD_GRAVITY,
    initial: tuple[float, float] = (0.0, 0.0),
) -> Response[RockOutcome]:
    """Return how a rigid block rocks under a motion, and whether it overturns.

    Plane rocking about the two lower corners without slip; see :mod:`seisblock.solvers.rock.model` for the equations, the rule of rest
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
    vertical : bool or float
        Whether the vertical ground motion acts, too, or a factor on it.
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
    check_call(block, Block, motion)
    check_options(restitution, gravity)
    p = model.parameters(block, motion.dt, gravity, restitution, linear)
    gains = np.array([1.0, 0.0, vertical_gain(motion, vertical)])
    trajectory = follow(model.ROCKING, motion, p, initial, start_mode(block, initial), gains=tuple(gains))
    after = afterwards(trajectory, block, gravity, restitution, linear)
    outcome = gather(block, motion, trajectory, after, gains=gains, gravity=gravity, restitution=restitution, linear=linear)
    time, states, _ = trajectory.table()
    channels = (
        Channel("rotation", "rad", states[:, model.THETA], "θ"),
        Channel("angular_velocity", "rad/s", states[:, model.OMEGA], "θ'"),
        Channel("ground_acceleration", "m/s^2", trajectory.sampled(motion.horizontal), "a"),
        Channel("vertical_acceleration", "m/s^2", gains[2] * trajectory.sampled(motion.vertical), "a_v"),
    )
    return Response(
        "rock",
        outcome,
        motion,
        block,
        motion.start_s + time,
        channels,
        phases(trajectory, motion.start_s),
        tuple(Event(event_name(c), motion.start_s + c.time, c.before, c.after) for c in trajectory.changes),
        {"restitution": restitution, "linear": linear, "vertical": float(gains[2]), "gravity_m_s2": gravity},
        Status(trajectory.status),
        warnings(block, outcome, gravity),
        CITATIONS,
    )


def start_mode(block: Block, initial: tuple[float, float]) -> int:
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
    right, left = block.slendernesses
    if theta > 0.0 or (theta == 0.0 and omega > 0.0):
        return model.BEYOND_RIGHT if theta > right else model.TO_RIGHT
    return model.BEYOND_LEFT if -theta > left else model.TO_LEFT


def afterwards(
    trajectory: Trajectory, block: Block, gravity: float, restitution: Restitution, linear: bool, *, timed: bool = True
) -> Fate | None:
    """Return what free rocking makes of the block after the record's end, None when at rest or overturned by then."""
    if trajectory.final_mode in (model.REST, model.OVERTURNED):
        return None
    theta, omega = trajectory.final
    return fate(sides(block, gravity, restitution, linear), float(theta), float(omega), timed=timed)


@dataclass(frozen=True)
class Verdict:
    """What an ensemble keeps of one run."""

    overturned: bool
    max_rotation_ratio: float


def rock_verdict(
    block: Block,
    motion: Motion,
    *,
    scale: float = 1.0,
    restitution: Restitution = None,
    linear: bool = False,
    vertical: Factor = False,
    gravity: float = STANDARD_GRAVITY,
) -> Verdict:
    """Return only whether a block overturns and its largest lean over alpha, as fast as possible ([Housner1963]_).

    Parameters
    ----------
    block, motion, restitution, linear, vertical, gravity
        As in :func:`solve_rock`.
    scale : float
        Factor on the ground acceleration.

    Returns
    -------
    Verdict
        The ratio is pi/2 over alpha when it overturns.
    """
    p = model.parameters(block, motion.dt, gravity, restitution, linear)
    gains = (scale, 0.0, scale * vertical)
    trajectory = follow(model.ROCKING, motion, p, (0.0, 0.0), model.REST, gains=gains, keep_path=False, keep_events=False)
    after = afterwards(trajectory, block, gravity, restitution, linear, timed=False)
    late = after.largest if after else (0.0, 0.0)
    high, _, low, _ = trajectory.extrema[model.THETA]
    overturned = trajectory.final_mode == model.OVERTURNED or (after is not None and after.overturns)
    return Verdict(overturned, lean_ratio(block, (max(high, late[0]), max(-low, late[1]))))
