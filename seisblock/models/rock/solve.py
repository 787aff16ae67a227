"""Rocking solver of a single block: `solve_rock`."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

from seisblock.bodies.block import Block
from seisblock.core.errors import ParameterError
from seisblock.core.options import keywords_of
from seisblock.core.results import Channel, Histories, Response, Status, make_events
from seisblock.core.typing import FloatArray
from seisblock.dynamics import Trajectory, integrate
from seisblock.models.rock import model
from seisblock.models.rock.free_rocking import FreeRockingOutcome, free_rocking_outcome
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.outcome import RockOutcome, build_outcome, event_name, phases, summarize, warnings
from seisblock.models.rock.params import RockParams, rock_params
from seisblock.records import Motion
from seisblock.references import papers


@keywords_of(RockOptions)
def solve_rock(block: Block, motion: Motion, options: RockOptions) -> Response[RockOutcome]:
    """Solve rocking and overturning of a rigid block under a ground motion.

    Plane rocking about the two lower corners without slip; equations, rest condition and signs (rotation positive for a tilt to +x) are
    given in :mod:`seisblock.models.rock.model`. After the record's last sample the energy of free rocking decides.

    Parameters
    ----------
    block : Block
    motion : Motion
        Ground acceleration, m/s^2.
    options : keyword arguments
        Fields of :class:`~seisblock.models.rock.options.RockOptions`. Restitution: one ratio, or those onto the
        right and the left corner; default: from conservation of angular momentum about the struck corner, 1 - 1.5 sin^2(alpha) for a
        rectangle ([Housner1963]_). The linear equation is that of [Zhang2001]_ eqs. (4), (5).

    Returns
    -------
    Response[RockOutcome]
        Channels ``rotation`` (rad), ``angular_velocity`` (rad/s), ``ground_acceleration`` and ``vertical_acceleration`` (m/s^2).

    Raises
    ------
    ParameterError
        If the restitution lies outside [0, 1] or gravity is not positive.
    ComponentError
        If `vertical` is on for a record without a vertical component.
    SolverError
        If the block rocks without end (restitution of 1).

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
    params = rock_params(block, motion, options)
    p = model.parameters(params, motion.dt)
    trajectory = integrate(model.ROCKING, motion, p, options.initial, initial_mode(params, options.initial), gains=params.gains())
    free_outcome = outcome_after_record(trajectory.final_mode, trajectory.final, params)
    outcome = build_outcome(params, motion, summarize(params, motion, trajectory, free_outcome), free_outcome)
    return Response(
        "rock",
        outcome,
        motion,
        block,
        partial(_curves, params, motion, trajectory),
        phases(trajectory, motion.start_s),
        make_events(trajectory.events, motion.start_s, event_name),
        replace(options, vertical=params.vertical),
        Status(trajectory.status),
        warnings(params, outcome),
        papers("rocking"),
    )


def _curves(params: RockParams, motion: Motion, trajectory: Trajectory) -> Histories:
    """Return the time histories at samples and at both limits of each event."""
    time, states, _ = trajectory.table()
    channels = (
        Channel("rotation", "rad", states[:, model.THETA], "θ"),
        Channel("angular_velocity", "rad/s", states[:, model.OMEGA], "θ'"),
        Channel("ground_acceleration", "m/s^2", trajectory.interpolate(motion.horizontal), "a"),
        Channel("vertical_acceleration", "m/s^2", params.vertical * trajectory.interpolate(motion.vertical), "a_v"),
    )
    return Histories(motion.start_s + time, channels)


def initial_mode(params: RockParams, initial: tuple[float, float]) -> int:
    """Return the mode of a block with initial tilt, rad, and angular velocity, rad/s."""
    theta, omega = initial
    if not (abs(theta) < math.pi / 2 and math.isfinite(omega)):
        raise ParameterError(
            "the initial tilt must lie between -pi/2 and pi/2 rad and its rate must be finite, found {theta} rad and {omega} rad/s",
            theta=theta,
            omega=omega,
        )
    if theta == 0.0 and omega == 0.0:
        return model.REST
    right, left = params.alphas
    if theta > 0.0 or (theta == 0.0 and omega > 0.0):
        return model.BEYOND_RIGHT if theta > right else model.TO_RIGHT
    return model.BEYOND_LEFT if -theta > left else model.TO_LEFT


def outcome_after_record(mode: int, state: FloatArray, params: RockParams) -> FreeRockingOutcome | None:
    """Return the outcome of free rocking after the record, None for a block at rest or overturned at its end."""
    if mode in (model.REST, model.OVERTURNED):
        return None
    theta, omega = state
    return free_rocking_outcome(params, float(theta), float(omega))
