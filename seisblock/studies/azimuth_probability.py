"""Overturning probability of a body in every azimuth of a record, and of one of unknown orientation."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeVar

from seisblock.bodies.block import Block
from seisblock.bodies.convex import convex_body
from seisblock.bodies.scan.body import ScannedBody
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import SolverError
from seisblock.core.typing import Progress
from seisblock.models.rigid3d.options import Rigid3dOptions
from seisblock.models.rigid3d.outcome import Rigid3dOutcome
from seisblock.models.rigid3d.solve import Body
from seisblock.records import Record
from seisblock.records.motion import motion_toward
from seisblock.studies.assessment import classify
from seisblock.studies.parallel import map_threads
from seisblock.studies.respond.azimuths import RespondAzimuth
from seisblock.studies.rocking.azimuths import RockAzimuth
from seisblock.studies.sampling import MOVED_M, ParameterVariation, draw_samples, rigid3d_outcomes, rigid3d_samples, sample
from seisblock.studies.solvers import solver_studies

AZIMUTH_RUNS = 40
"""Samples of each azimuth, at most."""

Azimuth = TypeVar("Azimuth", RespondAzimuth, RockAzimuth)


@dataclass(frozen=True, repr=False)
class AzimuthAverage(DisplayMixin):
    """Assessment of a body of unknown orientation: all azimuths are equally likely.

    Parameters
    ----------
    overturning_probability : float, 1
        Mean over the azimuths.
    runs : int
        Samples with a result, of all azimuths together.
    class_ : str
        ``likely overturns``, ``may overturn``, ``moves`` or ``stays``; the key ``class`` in documents.
    """

    overturning_probability: float
    runs: int
    class_: str


def average_azimuths(directions: Sequence[RespondAzimuth] | Sequence[RockAzimuth], runs: int) -> AzimuthAverage:
    """Return the mean of a ranked sweep; azimuths without a result are excluded.

    Parameters
    ----------
    directions : sequence of RespondAzimuth or RockAzimuth
        From :func:`rank_by_probability`; of a body that moves in no azimuth without samples.
    runs : int
        Samples of an azimuth, as requested.
    """
    shares = [direction.overturning_probability or 0.0 for direction in directions if not direction.gave_up]
    mean = sum(shares) / max(len(shares), 1)
    verdict = classify(mean, float(any(direction.moves for direction in directions)))
    return AzimuthAverage(mean, len(shares) * min(runs, AZIMUTH_RUNS), verdict)


def sample_orientations(
    body: Body,
    record: Record,
    options: Rigid3dOptions,
    runs: int,
    priors: ParameterVariation = ParameterVariation(),
    *,
    moved_m: float = MOVED_M,
    seed: int = 0,
    progress: Progress | None = None,
) -> AzimuthAverage:
    """Return the assessment in three dimensions of a body of unknown orientation: each sample stands in an azimuth of its own.

    Parameters
    ----------
    body : Block, Scan, ScannedBody or ConvexBody
        A scan is turned, too.
    record, options
    runs : int
        Samples, in equal steps over the full circle.
    priors, seed, progress
        As in :func:`~seisblock.studies.sampling.sample`.
    moved_m : float, m
    """
    standing = body if isinstance(body, Block) else convex_body(body)
    draws = draw_samples(runs, seed)

    def work(index: int) -> Rigid3dOutcome | None:
        motion = motion_toward(record, 360.0 * index / runs)
        return rigid3d_outcomes(standing, motion, options, draws[index : index + 1], priors, workers=1)[0]

    samples = rigid3d_samples(list(map_threads(work, range(runs), progress=progress)), standing, priors, seed)
    return AzimuthAverage(samples.probability, samples.completed, classify(samples.probability, samples.moved_probability(moved_m)))


def solve_azimuths(solver: str, body: Block | ScannedBody, record: Record, options: Any, runs: int, **sampling: Any) -> Sequence[Any]:
    """Return the results of a body in all azimuths of a record, the worst first: with samples of a body that moves the most probable one.

    Parameters
    ----------
    solver, body, record, options, runs
        As for :func:`rank_by_probability`; no samples with 0 runs.
    sampling
        Its further arguments.
    """
    directions = solver_studies(solver).directions
    assert directions is not None
    results = directions(body, record, options)
    if not runs or not any(result.moves for result in results):
        return results
    return rank_by_probability(solver, body, record, results, options, runs, **sampling)


def rank_by_probability(
    solver: str,
    body: Block | ScannedBody,
    record: Record,
    directions: Sequence[Azimuth],
    options: Any,
    runs: int,
    priors: ParameterVariation = ParameterVariation(),
    *,
    seed: int = 0,
    known: Sequence[str] = (),
    progress: Progress | None = None,
) -> list[Azimuth]:
    """Return the directions of a sweep with their overturning probability, the most probable first.

    The single run of an azimuth is chaotic: the worst of many tries is not the worst azimuth. Directions of equal probability keep their
    order.

    Parameters
    ----------
    solver : str
        ``respond`` or ``rock``.
    body, record
    directions : sequence of RespondAzimuth or RockAzimuth
        Of the same body and record; none of a body that does not move is sampled.
    options : options of the solver
    runs : int
        Samples of an azimuth; at most :data:`AZIMUTH_RUNS` are solved.
    priors : ParameterVariation
    seed : int
    known : sequence of str
        Parameters of the body that are not drawn from the prior of its kind.
    progress : callable
    """
    ranked = []
    for count, direction in enumerate(directions, start=1):
        block = body.block_toward(direction.azimuth_deg).without_ranges(*known)
        motion = motion_toward(record, direction.azimuth_deg)
        try:
            samples = sample(solver, block, motion, options, min(runs, AZIMUTH_RUNS), priors, seed=seed)
        except SolverError:
            ranked.append(replace(direction, gave_up=True))
        else:
            ranked.append(replace(direction, overturning_probability=samples.probability))
        if progress is not None:
            progress(count, len(directions))
    return sorted(ranked, key=lambda direction: -1.0 if direction.gave_up else direction.overturning_probability or 0.0, reverse=True)
