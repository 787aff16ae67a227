"""Studies of a pile."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from seisblock.bodies.pile.edge_wear import widest_wear
from seisblock.bodies.pile.pile import Pile
from seisblock.core.errors import SolverError
from seisblock.core.results import Response
from seisblock.core.typing import FloatArray
from seisblock.models.stack.options import EDGES, StackOptions
from seisblock.models.stack.outcome import StackOutcome
from seisblock.models.stack.solve import solve_stack
from seisblock.records import Motion
from seisblock.records._validation import validate_inputs
from seisblock.studies.assessment import DirectionAssessment, make_assessment, run_factor
from seisblock.studies.model_comparison import PILE, ModelResult, compare_pile_models
from seisblock.studies.parallel import map_threads
from seisblock.studies.predictability import stack_predictable_until
from seisblock.studies.sampling import MOVED_M, Samples, Sampling, sample_motion, sample_pile
from seisblock.studies.solvers import SolverStudies


def _sample(sampling: Sampling) -> Samples:
    """Solve the samples in threads; those without a result are counted apart."""
    body, motion, options, variation = sampling.body, sampling.motion, sampling.options, sampling.variation
    validate_inputs(body, Pile, motion)
    if options.mu_kinetic is not None:
        body, options = body.with_kinetic_friction(options.mu_kinetic), replace(options, mu_kinetic=None)
    # wear that would tip a stone at rest is excluded, so that every sample starts from rest; the restitution of joints does not vary
    inset = widest_wear(body, variation.inset) if options.points == EDGES else 0.0
    variation = replace(variation, inset=inset, restitution=0.0)

    def work(draw: FloatArray) -> StackOutcome | SolverError:
        try:
            return solve_stack(sample_pile(body, variation, draw), sample_motion(motion, variation, draw), **options.keywords()).outcome
        except SolverError as error:
            return error

    results = list(map_threads(work, list(sampling.draws), progress=sampling.progress, workers=sampling.workers))
    # samples without a result are counted apart, neither as fallen nor as standing
    outcomes = tuple(result for result in results if isinstance(result, StackOutcome))
    if not outcomes:
        raise next(result for result in results if isinstance(result, SolverError))
    shifts = [
        max(math.inf if stone.state == "fallen" else stone.residual_slip_m for stone in result.stones)
        if isinstance(result, StackOutcome)
        else math.nan
        for result in results
    ]
    fallen = np.array([isinstance(result, StackOutcome) and result.overturned_any for result in results])
    stopped = np.array([not isinstance(result, StackOutcome) for result in results])
    return replace(sampling, variation=variation).results(fallen, np.array(shifts), stopped, outcomes)


def assess_pile(response: Response[StackOutcome], samples: Samples, *, moved_m: float = MOVED_M) -> DirectionAssessment:
    """Return the assessment of a pile: a fall of any stone counts.

    Parameters
    ----------
    response : Response
        Of :func:`~seisblock.models.stack.solve.solve_stack`.
    samples : Samples
        Of the same pile, motion and options.
    moved_m : float, m
    """
    factor = run_factor(response, solve_stack, lambda run: run.overturned_any, stop_at_fall=True)
    pile_result = ModelResult(PILE, response.outcome.overturned_any, factor)
    comparison = compare_pile_models(response, pile_result)
    results = (pile_result,) if comparison is None else comparison.opinions
    until = stack_predictable_until(response)
    return DirectionAssessment(samples, make_assessment(samples, results, until, response.motion.name, moved_m), comparison, moved_m)


def _assess(body: Pile, motion: Motion, options: StackOptions, samples: Samples, *, moved_m: float) -> DirectionAssessment:
    return assess_pile(solve_stack(body, motion, **options.keywords()), samples, moved_m=moved_m)


STUDIES = SolverStudies(sample=_sample, assess=_assess)
