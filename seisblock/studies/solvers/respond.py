"""Studies of the full response."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import numpy as np

from seisblock.bodies.block import Block
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_
from seisblock.core.registry import SolverBody
from seisblock.core.typing import BoolArray, FloatArray
from seisblock.models.respond.batch import RespondBatchResult, no_answer, respond_many
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.solve import respond_params
from seisblock.models.rock.options import RockOptions
from seisblock.records import Motion
from seisblock.records._validation import validate_inputs, vertical_gain
from seisblock.studies.assessment import MAX_FACTOR, DirectionAssessment, make_assessment
from seisblock.studies.batch.directions import worst_direction
from seisblock.studies.fragility.damage_states import LEAN, OVERTURN, ROCK, SLIP, EndStates
from seisblock.studies.fragility.runners import VERSIONS, Draws
from seisblock.studies.model_comparison import ModelResult, compare_models
from seisblock.studies.predictability import respond_predictable_until
from seisblock.studies.respond.azimuths import respond_directions
from seisblock.studies.sampling import MOVED_M, Samples, Sampling, sample_gains, sample_respond_params
from seisblock.studies.solvers import SolverStudies, require_default

FULL_RESPONSE = N_("full response")
"""Name of this model among the models of an object."""

CHUNK_SIZE = 100
"""Samples between two progress reports."""

MIN_FACTOR, FACTOR_STEP, REFINEMENT = 0.02, 1.05, 16
"""Smallest factor of the search for the first overturning, ratio of consecutive factors, parts of the last step."""


def _sample(sampling: Sampling) -> Samples:
    """Solve the samples in chunks of rows."""
    block, motion, options, variation, draws = sampling.body, sampling.motion, sampling.options, sampling.variation, sampling.draws
    validate_inputs(block, Block, motion)
    require_default(options, "initial", "further_points")
    respond_params(block, options)  # validates the nominal values: samples are clipped into their ranges
    params, gains = sample_respond_params(block, variation, draws, options), sample_gains(motion, variation, draws, options.vertical)
    parts: list[RespondBatchResult] = []
    # chunks allow progress reports and cancellation; the rows are independent of each other
    for first in range(0, len(draws), CHUNK_SIZE):
        part = slice(first, first + CHUNK_SIZE)
        parts.append(respond_many(params[part], motion, gains=gains[part], settle_s=options.settle_s, workers=sampling.workers))
        if sampling.progress is not None:
            sampling.progress(min(first + CHUNK_SIZE, len(draws)), len(draws))
    stopped, fallen, shifts = (
        np.concatenate([getattr(result, name) for result in parts]) for name in ("gave_up", "overturned", "final_displacement_m")
    )
    if stopped.all():
        raise no_answer(len(stopped), len(stopped), min(int(result.impacts.min()) for result in parts))
    return sampling.results(fallen & ~stopped, shifts, stopped)


def assess_respond(
    block: Block, motion: Motion, options: RespondOptions, samples: Samples, *, moved_m: float = MOVED_M
) -> DirectionAssessment:
    """Return the assessment of a free-standing object in one direction.

    Parameters
    ----------
    block, motion, options
        As in :func:`~seisblock.models.respond.solve.solve_respond`.
    samples : Samples
        Of the same object, motion and options.
    moved_m : float, m
    """
    respond_result = full_response(block, motion, options)
    rocking = RockOptions(vertical=options.vertical, gravity=options.gravity)
    comparison = compare_models(block, motion, extra_results=() if respond_result is None else (respond_result,), options=rocking)
    until = respond_predictable_until(block, motion, options)
    return DirectionAssessment(samples, make_assessment(samples, comparison.opinions, until, motion.name, moved_m), comparison, moved_m)


def full_response(block: Block, motion: Motion, options: RespondOptions) -> ModelResult | None:
    """Return verdict and first overturning factor of the full response; None if the run itself has no result."""
    unit = np.array([1.0, 0.0, vertical_gain(motion, options.vertical)])
    params = respond_params(block, options)

    def falls(factors: FloatArray) -> tuple[BoolArray, BoolArray]:
        result = respond_many([params] * len(factors), motion, gains=factors[:, None] * unit, settle_s=options.settle_s)
        return result.overturned & ~result.gave_up, result.gave_up

    count = math.ceil(math.log(MAX_FACTOR / MIN_FACTOR) / math.log(FACTOR_STEP))
    factors = np.append(MAX_FACTOR * FACTOR_STEP ** -np.arange(count, -1.0, -1.0), 1.0)
    if not motion.horizontal.any():
        return ModelResult(FULL_RESPONSE, False, None)
    fallen, stopped = falls(factors)
    if stopped[-1]:
        return None
    verdict, fallen = bool(fallen[-1]), fallen[:-1]
    if not fallen.any():
        return ModelResult(FULL_RESPONSE, verdict, 1.0 if verdict else None)
    first = int(np.argmax(fallen))
    if first == 0:
        return ModelResult(FULL_RESPONSE, verdict, float(factors[0]))
    fine = np.linspace(factors[first - 1], factors[first], REFINEMENT + 1)[1:]
    return ModelResult(FULL_RESPONSE, verdict, float(fine[int(np.argmax(falls(fine)[0]))]))


def _end_states(solver_body: SolverBody, motion: Motion, factors: FloatArray, draws: Draws) -> EndStates:
    """Return the end states of a free-standing body; an overturned one has an infinite displacement."""
    options: RespondOptions = solver_body.options
    require_default(options, "initial", *(() if draws is None else ("further_points",)))
    unit = np.array([1.0, 0.0, vertical_gain(motion, options.vertical)])
    if draws is None:
        settings: Any = [respond_params(solver_body.body, options)] * factors.size
    else:
        if not isinstance(solver_body.body, Block):
            raise ParameterError("{name}: `perturb` requires a block: omit `perturb`", name=solver_body.name)
        run_draws = np.tile(draws, (factors.size, 1))
        settings = sample_respond_params(solver_body.body, VERSIONS, run_draws, options)
    gains = np.repeat(factors, 1 if draws is None else len(draws))[:, None] * unit
    results = respond_many(settings, motion, gains=gains, settle_s=options.settle_s)
    # beyond every slip limit
    slip = np.where(results.overturned, np.inf, np.abs(results.final_displacement_m))
    return EndStates(results.overturned, results.max_rotation_ratio, slip, results.gave_up)


STUDIES = SolverStudies(
    sample=_sample,
    assess=assess_respond,
    end_states=_end_states,
    limits=(ROCK, LEAN, SLIP, OVERTURN),
    samples_in_rows=True,
    directions=respond_directions,
    worst_azimuth=partial(worst_direction, "respond"),
    single_direction_options=("initial", "further_points", "sensitivity"),
)
