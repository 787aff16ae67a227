"""Studies of rocking."""

from __future__ import annotations

from functools import partial

import numpy as np

from seisblock.bodies.block import Block
from seisblock.core.registry import SolverBody
from seisblock.core.typing import FloatArray
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.params import RockBatchParams, RockParams, rock_params
from seisblock.records import Motion
from seisblock.records._validation import validate_inputs
from seisblock.studies.assessment import DirectionAssessment, make_assessment
from seisblock.studies.batch.directions import worst_direction
from seisblock.studies.fragility.damage_states import LEAN, OVERTURN, ROCK, EndStates
from seisblock.studies.fragility.runners import VERSIONS, Draws
from seisblock.studies.model_comparison import ModelComparison, compare_models
from seisblock.studies.predictability import rock_predictable_until
from seisblock.studies.rocking.azimuths import rock_directions
from seisblock.studies.rocking.verdicts import parallel_verdicts
from seisblock.studies.sampling import MOVED_M, Samples, Sampling, sample_gains, sample_rock_params
from seisblock.studies.solvers import SolverStudies, require_default


def _sample(sampling: Sampling) -> Samples:
    """Solve the samples in rows."""
    motion, variation, draws = sampling.motion, sampling.variation, sampling.draws
    validate_inputs(sampling.body, Block, motion)
    require_default(sampling.options, "initial")
    params = sample_rock_params(sampling.body, motion, variation, draws, sampling.options)
    verdicts = parallel_verdicts(params, motion, sample_gains(motion, variation, draws, params.vertical), progress=sampling.progress)
    return sampling.results(verdicts.overturned, np.zeros(len(draws)), verdicts.gave_up)


def assess_rock(
    block: Block,
    motion: Motion,
    options: RockOptions,
    samples: Samples,
    *,
    moved_m: float = MOVED_M,
    comparison: ModelComparison | None = None,
) -> DirectionAssessment:
    """Return the assessment of a rocking block in one direction; it ends in its place unless it overturns.

    Parameters
    ----------
    block, motion, options
        As in :func:`~seisblock.models.rock.solve.solve_rock`.
    samples : Samples
        Of the same block, motion and options.
    moved_m : float, m
    comparison : ModelComparison or None
        Of the same block, if computed already.
    """
    comparison = comparison or compare_models(block, motion, options=options)
    until = rock_predictable_until(block, motion, options)
    return DirectionAssessment(samples, make_assessment(samples, comparison.opinions, until, motion.name, moved_m), comparison, moved_m)


def _end_states(solver_body: SolverBody, motion: Motion, factors: FloatArray, draws: Draws) -> EndStates:
    """Return the end states of a rocking block."""
    options = solver_body.options
    require_default(options, "initial")
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


STUDIES = SolverStudies(
    sample=_sample,
    assess=assess_rock,
    end_states=_end_states,
    limits=(ROCK, LEAN, OVERTURN),
    samples_in_rows=True,
    directions=rock_directions,
    worst_azimuth=partial(worst_direction, "rock"),
    single_direction_options=("initial",),
)
