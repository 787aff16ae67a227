"""Batch runs of one body under many factors on one motion, for each solver of a fragility."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.sliding_base import SlidingBase
from seisblock.core.errors import ParameterError, SolverError
from seisblock.core.registry import Solver, SolverBody
from seisblock.core.typing import BoolArray, FloatArray
from seisblock.dynamics import integrate_many
from seisblock.models.respond.batch import respond_many
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.params import rigid_body
from seisblock.models.respond.solve import respond_params
from seisblock.models.rock.params import RockBatchParams, RockParams, rock_params
from seisblock.models.slide.final_slip import slip_at_rest
from seisblock.models.slide.model import SLIDE, STICK, UNDEFINED, parameters
from seisblock.models.slide.options import SlideOptions
from seisblock.models.slide.solve import motion_gains, raise_lift_off
from seisblock.records import Motion
from seisblock.records._validation import vertical_gain
from seisblock.studies.fragility.damage_states import OVERTURN, SLIP, EndStates
from seisblock.studies.parallel import map_batches, map_threads
from seisblock.studies.rocking.verdicts import parallel_verdicts
from seisblock.studies.sampling import ParameterVariation, draw_samples, sample_respond_params, sample_rock_params

Draws = FloatArray | None
"""Draws of the samples of a body, (v, 8), each uniform in [-1, 1]; None for the nominal body."""

Runner = Callable[[SolverBody, Motion, FloatArray, Draws], EndStates]
"""``runner(solver_body, motion, factors, draws)``: end states of all samples at the first factor, then at the next."""

VERSIONS = ParameterVariation(amplitude=0.0, azimuth_deg=0.0)
"""Half widths of a body as everywhere, without the shaking, whose intensity is the abscissa of the curve."""

BATCH_SIZE = 64
"""Sliding runs per thread and batch."""


def rock_end_states(solver_body: SolverBody, motion: Motion, factors: FloatArray, draws: Draws) -> EndStates:
    """Return the end states of a rocking block."""
    options = solver_body.options
    bodies: RockBatchParams | list[RockParams]
    if draws is None:
        bodies = [rock_params(solver_body.body, motion, options)]
    else:
        params = sample_rock_params(solver_body.body, motion, VERSIONS, draws, options)
        rows = np.tile(np.arange(len(draws)), factors.size)
        bodies = params[rows]
    unit = np.array(bodies.gains() if isinstance(bodies, RockBatchParams) else bodies[0].gains())
    gains = np.repeat(factors, 1 if draws is None else len(draws))[:, None] * unit
    verdicts = parallel_verdicts(bodies, motion, gains)
    return EndStates(overturned=verdicts.overturned, tilt_ratio=verdicts.max_rotation_ratio, gave_up=verdicts.gave_up)


def respond_end_states(solver_body: SolverBody, motion: Motion, factors: FloatArray, draws: Draws) -> EndStates:
    """Return the end states of a free-standing body; an overturned one has an infinite displacement."""
    options: RespondOptions = solver_body.options
    unit = np.array([1.0, 0.0, vertical_gain(motion, options.vertical)])
    alphas: float | FloatArray = min(rigid_body(solver_body.body).slendernesses)
    if draws is None:
        settings: Any = [respond_params(solver_body.body, options)] * factors.size
    else:
        if not isinstance(solver_body.body, Block):
            raise ParameterError("{name}: `perturb` requires a block: omit `perturb`", name=solver_body.name)
        run_draws = np.tile(draws, (factors.size, 1))
        settings = sample_respond_params(solver_body.body, VERSIONS, run_draws, options)
        alphas = settings.blocks.slendernesses.min(axis=1)
    gains = np.repeat(factors, 1 if draws is None else len(draws))[:, None] * unit
    results = respond_many(settings, motion, gains=gains, settle_s=options.settle_s)
    # beyond every slip limit
    slip = np.where(results.overturned, np.inf, np.abs(results.final_displacement_m))
    return EndStates(results.overturned, results.max_rotation_rad / alphas, slip, results.gave_up)


def slide_end_states(solver_body: SolverBody, motion: Motion, factors: FloatArray, draws: Draws) -> EndStates:
    """Return the end states of a sliding object: maximum slip, including that after the motion, on ground at rest."""
    base = solver_body.body if isinstance(solver_body.body, SlidingBase) else SlidingBase(solver_body.body)
    options: SlideOptions = solver_body.options
    unit = np.array(motion_gains(motion, options.vertical))
    p = parameters(base, options.gravity)

    def solve_batch(part: slice) -> tuple[FloatArray, BoolArray]:
        """Return the maximum slips of some runs, and the failed ones."""
        gains = factors[part][:, None] * unit
        runs = integrate_many(SLIDE, motion, [p] * len(gains), np.zeros(4), STICK, gains=gains, allow_failures=True)
        for row in np.flatnonzero(runs.final_mode == UNDEFINED)[:1]:
            raise_lift_off(motion, float(runs.end_time[row]))
        ends: list[float] = [
            math.nan if failed else abs(slip_at_rest(state, mode, p))
            for state, mode, failed in zip(runs.final.tolist(), runs.final_mode.tolist(), runs.failed.tolist(), strict=True)
        ]
        return np.maximum(np.maximum(runs.extrema[:, 0, 0], -runs.extrema[:, 0, 2]), ends), runs.failed

    slips, failed = zip(*map_batches(solve_batch, factors.size, size=BATCH_SIZE), strict=True)
    return EndStates(slip_m=np.concatenate(slips), gave_up=np.concatenate(failed))


def single_end_states(solver_body: SolverBody, motion: Motion, factors: FloatArray, draws: Draws, *, solver: Solver) -> EndStates:
    """Return the end states of a solver that solves run by run: overturning, and the largest displacement of its outcome."""

    def run_one(factor: float) -> tuple[bool, float]:
        """Return the end state of one run; NaN slip if stopped."""
        scaled_motion = Motion(motion.acceleration * factor, motion.dt, motion.name, motion.start_s, motion.record)
        try:
            outcome = solver.solve(solver_body.body, scaled_motion, **solver_body.options.keywords()).outcome
        except SolverError:
            return False, math.nan
        overturned = OVERTURN in solver.damage_states and bool(getattr(outcome, solver.damage_states[OVERTURN]))
        slip = getattr(outcome, solver.damage_states[SLIP]) if SLIP in solver.damage_states else 0.0
        return overturned, math.inf if overturned else max(map(abs, slip.values())) if isinstance(slip, Mapping) else abs(slip)

    ends = list(map_threads(run_one, factors.tolist()))
    slips = np.array([slip for _, slip in ends])
    return EndStates(overturned=np.array([fell for fell, _ in ends]), slip_m=slips, gave_up=np.isnan(slips))


def version_draws(runs: int, seed: int) -> Draws:
    """Return the draws of the samples of a body, the same for every motion and level; None for none."""
    return draw_samples(runs, seed) if runs else None
