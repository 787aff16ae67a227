"""Studies of one rigid body in three dimensions."""

from __future__ import annotations

import numpy as np

from seisblock.bodies.convex import convex_body
from seisblock.bodies.scan.body import EAST, ScannedBody
from seisblock.core.i18n import N_
from seisblock.core.results import Response
from seisblock.models.respond.options import RespondOptions
from seisblock.models.rigid3d.options import Rigid3dOptions
from seisblock.models.rigid3d.outcome import Rigid3dOutcome
from seisblock.models.rigid3d.solve import Body, solve_rigid3d, validate_motion_and_body
from seisblock.records import Motion
from seisblock.studies.assessment import DirectionAssessment, make_assessment, run_factor
from seisblock.studies.model_comparison import ModelResult
from seisblock.studies.predictability import rigid3d_predictable_until
from seisblock.studies.sampling import MOVED_M, Samples, Sampling, rigid3d_outcomes, rigid3d_samples
from seisblock.studies.solvers import SolverStudies
from seisblock.studies.solvers.respond import FULL_RESPONSE, full_response

THREE_DIMENSIONS = N_("three dimensions")
"""Name of this model among the models of an object."""


def _sample(sampling: Sampling) -> Samples:
    """Solve the samples in threads."""
    validate_motion_and_body(sampling.body, sampling.motion)
    results = rigid3d_outcomes(
        sampling.body,
        sampling.motion,
        sampling.options,
        sampling.draws,
        sampling.variation,
        progress=sampling.progress,
        workers=sampling.workers,
    )
    return rigid3d_samples(results, sampling.body, sampling.variation, sampling.seed)


def assess_rigid3d(response: Response[Rigid3dOutcome], samples: Samples, *, moved_m: float = MOVED_M) -> DirectionAssessment:
    """Return the assessment of an object in three dimensions, beside the full response in the plane of either horizontal.

    Parameters
    ----------
    response : Response
        Of :func:`~seisblock.models.rigid3d.solve.solve_rigid3d`.
    samples : Samples
        Of the same body, motion and options.
    moved_m : float, m
    """
    result = ModelResult(THREE_DIMENSIONS, response.outcome.overturned, run_factor(response, solve_rigid3d, lambda run: run.overturned))
    planar = _planar_result(response)
    results = (result,) if planar is None else (result, planar)
    until = rigid3d_predictable_until(response)
    return DirectionAssessment(samples, make_assessment(samples, results, until, response.motion.name, moved_m), None, moved_m)


def _planar_result(response: Response[Rigid3dOutcome]) -> ModelResult | None:
    """Return the full response of the object in the vertical planes of both horizontals; None without a result."""
    solid, motion, options = convex_body(response.body), response.motion, response.options
    low = float(solid.points[:, 2].min())
    base = tuple((x, y) for x, y in solid.support_polygon.tolist())
    centre = (*solid.centre[:2], solid.centre[2] - low)
    standing = ScannedBody(solid.name, solid.mass, float(np.ptp(solid.points[:, 2])), centre, solid.inertia, base, facing=EAST)
    rotated = (motion.transverse, -motion.horizontal, motion.vertical)
    cases = [(standing.block_toward(EAST), motion)]
    if options.across and motion.transverse.any():
        cases.append((standing.block_toward(EAST - 90.0), Motion(rotated, motion.dt, motion.name, motion.start_s, motion.record)))
    planar = RespondOptions(
        mu=options.mu, restitution=options.restitution, vertical=options.vertical, gravity=options.gravity, settle_s=options.settle_s
    )
    results = [result for block, rows in cases if (result := full_response(block, rows, planar)) is not None]
    factors = [result.factor for result in results if result.factor is not None]
    return ModelResult(FULL_RESPONSE, any(result.falls for result in results), min(factors, default=None)) if results else None


def _assess(body: Body, motion: Motion, options: Rigid3dOptions, samples: Samples, *, moved_m: float) -> DirectionAssessment:
    return assess_rigid3d(solve_rigid3d(body, motion, **options.keywords()), samples, moved_m=moved_m)


STUDIES = SolverStudies(sample=_sample, assess=_assess)
