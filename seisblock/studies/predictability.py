"""Time until which a response is predictable: copies of a run whose input is changed by up to 2e-6 stay together.

Rocking amplifies differences: near an unstable equilibrium the rounding of a record file decides on which side a body comes down. Eight
copies under motions changed by up to 2e-6 are followed beside the run itself. Until the first of them departs from it, no change of the
input of this size alters the run; afterwards only its probability has a meaning.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.convex import convex_body
from seisblock.bodies.scan.polygon import min_width, nearest_edge
from seisblock.core.errors import SolverError
from seisblock.core.results import Response
from seisblock.core.typing import FloatArray
from seisblock.dynamics import Trajectory, integrate
from seisblock.models.respond import constants
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.outcome import run_end
from seisblock.models.respond.params import motion_gains
from seisblock.models.respond.run import Run, run
from seisblock.models.respond.solve import respond_params
from seisblock.models.rigid3d.outcome import Rigid3dOutcome
from seisblock.models.rigid3d.solve import solve_rigid3d
from seisblock.models.rock import model as rock_model
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.params import rock_params
from seisblock.models.rock.solve import initial_mode, outcome_after_record
from seisblock.records import Motion

if TYPE_CHECKING:
    from seisblock.models.stack.outcome import StackOutcome

INPUT_CHANGE = 2e-6
"""Largest relative change of the input."""

CHANGES = tuple(share * INPUT_CHANGE for share in (-1.0, -0.75, -0.5, -0.25, 0.25, 0.5, 0.75, 1.0))
"""Relative changes of the motion of the copies."""

PILE_CHANGES = (-INPUT_CHANGE, INPUT_CHANGE)
"""The same of a pile, whose runs are expensive."""

TOLERANCE = 0.01
"""Departure of a copy: difference of tilts over alpha, or of displacements over the width."""

FALLEN_TILT = 0.25 * math.pi
"""Tilt beyond which a body in three dimensions is not followed."""


@dataclass(frozen=True, eq=False)
class _Track:
    """Trajectories of one run with the time of the first sample of each, its end, s, and its verdict."""

    parts: tuple[tuple[float, Trajectory], ...]
    end_s: float
    verdict: Any


def respond_predictable_until(block: Block, motion: Motion, options: RespondOptions) -> float | None:
    """Return the time until which a full response is predictable, s from the record's first sample; None: to its end.

    Parameters
    ----------
    block, motion, options
        As in :func:`~seisblock.models.respond.solve.solve_respond`.

    Examples
    --------
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> respond_predictable_until(Block(0.24, 0.8), pulse, RespondOptions(mu=0.5)) is None
    True
    """
    params = respond_params(block, options)
    gains = motion_gains(motion, options.vertical)

    def track(factor: float) -> _Track:
        along, across, up = (factor * gain for gain in gains)
        result: Run = run(params, motion, (along, across, up), options.initial, options.settle_s)
        parts = [(0.0, result.record_part)]
        if result.free_part is not None:
            parts.append((result.duration_s, result.free_part))
        return _Track(tuple(parts), result.end_s, run_end(result, ()).verdict)

    right, left = params.rigid_body.slendernesses
    width = params.rigid_body.right + params.rigid_body.left

    def reduce(states: FloatArray) -> FloatArray:
        tilts = np.clip(states[:, constants.THETA], -left, right)
        return np.column_stack([tilts / min(left, right), states[:, constants.X] / width])

    return _first_departure(track, reduce, motion.start_s)


def rock_predictable_until(block: Block, motion: Motion, options: RockOptions = RockOptions()) -> float | None:
    """Return the time until which a rocking response is predictable, s from the record's first sample; None: to its end.

    Parameters
    ----------
    block, motion, options
        As in :func:`~seisblock.models.rock.solve.solve_rock`.
    """
    params = rock_params(block, motion, options)
    p, mode = rock_model.parameters(params, motion.dt), initial_mode(params, options.initial)

    def track(factor: float) -> _Track:
        trajectory = integrate(rock_model.ROCKING, motion, p, options.initial, mode, gains=params.gains(factor))
        ending = outcome_after_record(trajectory.final_mode, trajectory.final, params)
        fell = trajectory.final_mode == rock_model.OVERTURNED
        theta = float(trajectory.final[rock_model.THETA])
        direction = math.copysign(1.0, theta) if fell else 0 if ending is None else ending.direction
        return _Track(((0.0, trajectory),), trajectory.end_time, direction)

    right, left = params.alphas

    def reduce(states: FloatArray) -> FloatArray:
        return np.clip(states[:, rock_model.THETA, None], -left, right) / min(left, right)

    return _first_departure(track, reduce, motion.start_s)


def stack_predictable_until(response: Response[StackOutcome]) -> float | None:
    """Return the time until which the response of a pile is predictable, s from the record's first sample; None: to its end.

    Parameters
    ----------
    response : Response
        Of :func:`~seisblock.models.stack.solve.solve_stack`.
    """
    # other objects need no piles, which take 0.1 s to import
    from seisblock.models.stack.solve import solve_stack

    return _first_departure_of_copies(response, solve_stack, _pile_columns, PILE_CHANGES)


def rigid3d_predictable_until(response: Response[Rigid3dOutcome]) -> float | None:
    """Return the time until which the response of a body in three dimensions is predictable, s from the record's first sample.

    None: to its end. Departures of the body's axis are measured over the slenderness of its base, those of its place over the width.

    Parameters
    ----------
    response : Response
        Of :func:`~seisblock.models.rigid3d.solve.solve_rigid3d`.
    """
    solid = convex_body(response.body)
    polygon = solid.support_polygon - np.array(solid.centre[:2])
    width = min_width(polygon)
    alpha = math.atan2(nearest_edge(polygon, (0.0, 0.0))[0], solid.centre[2] - float(solid.points[:, 2].min()))

    def columns(run: Response[Rigid3dOutcome]) -> FloatArray:
        w, x, y, z = (run[name] for name in ("qw", "qx", "qy", "qz"))
        axis = np.column_stack([2.0 * (x * z + w * y), 2.0 * (y * z - w * x)])
        place = np.column_stack([run["x"], run["y"]])
        # where a body lies that has fallen decides nothing
        fallen = run["tilt"] > FALLEN_TILT
        return np.where(fallen[:, None], 0.0, np.column_stack([axis / alpha, place / width]))

    return _first_departure_of_copies(response, solve_rigid3d, columns, CHANGES)


def _first_departure_of_copies(
    response: Response[Any],
    solve: Callable[..., Response[Any]],
    columns: Callable[[Response[Any]], FloatArray],
    changes: Sequence[float],
) -> float | None:
    """Return the earliest sample at which a copy of a run departs from it, s, None without one."""
    motion, first = response.motion, math.inf
    nominal = columns(response)
    for change in changes:
        copy_motion = Motion((1.0 + change) * motion.acceleration, motion.dt, motion.name, motion.start_s, motion.record)
        try:
            copy = solve(response.body, copy_motion, **response.options.keywords())
        except SolverError:
            return motion.start_s
        copy_columns = columns(copy)
        rows = min(len(nominal), len(copy_columns))
        departs = np.flatnonzero((np.abs(nominal[:rows] - copy_columns[:rows]) > TOLERANCE).any(axis=1))
        if departs.size:
            first = min(first, float(response.time[departs[0]]))
        elif copy.outcome.overturned != response.outcome.overturned:
            first = min(first, float(response.time[rows - 1]))
    return first if math.isfinite(first) else None


def _pile_columns(response: Response[StackOutcome]) -> FloatArray:
    """Return the tilts over alpha and the slips over the width of all stones, (n, 2 stones)."""
    columns = []
    for stone in response.body.stones:
        width = min(stone.width, stone.depth)
        alpha = math.atan2(width, stone.height)
        fallen = np.minimum(response[f"{stone.name}_tilt"] / alpha, 1.0)
        # a fallen stone slides on: its place decides nothing
        columns += [fallen, np.where(fallen < 1.0, response[f"{stone.name}_slip"] / width, 0.0)]
    return np.column_stack(columns)


def _first_departure(track: Callable[[float], _Track], reduce: Callable[[FloatArray], FloatArray], start_s: float) -> float | None:
    """Return the earliest time at which a copy departs from the run, None without one."""
    nominal = track(1.0)
    times = (_departure(nominal, track(1.0 + change), reduce) for change in CHANGES)
    first = min((time for time in times if time is not None), default=None)
    return None if first is None else start_s + first


def _departure(nominal: _Track, copy: _Track, reduce: Callable[[FloatArray], FloatArray]) -> float | None:
    """Return the time, s after the first sample, at which a copy departs from the run."""
    for (offset, trajectory), (_, copy_trajectory) in zip(nominal.parts, copy.parts, strict=False):
        # piece by piece, since the path of a day fills the memory
        for piece, other_piece in zip(trajectory.iter_paths(), copy_trajectory.iter_paths(), strict=False):
            rows = min(len(piece.states), len(other_piece.states))
            difference = np.abs(reduce(piece.states[:rows]) - reduce(other_piece.states[:rows]))
            departs = np.flatnonzero((difference > TOLERANCE).any(axis=1))
            if departs.size:
                return offset + float(piece.dt * (piece.first + departs[0]))
    return None if nominal.verdict == copy.verdict else min(nominal.end_s, copy.end_s)
