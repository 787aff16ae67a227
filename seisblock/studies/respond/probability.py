"""Overturning probability of a free-standing object by Monte Carlo sampling of the object and its shaking.

Samples come from :mod:`seisblock.studies.sampling`. The share covers parameter variation only: in shaking-table runs of two
granite rocks, 3 % of those with 0 of 20 samples overturning did overturn, and 2 % of those with 20 of 20 did not.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.uncertainty import ParameterRanges
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.typing import FloatArray, Progress
from seisblock.models.respond.options import RespondOptions
from seisblock.models.rigid3d.outcome import Rigid3dOutcome
from seisblock.records import Motion
from seisblock.studies.sampling import MOVED_M, RUNS, ParameterVariation, Samples, sample

QUANTILES = (0.05, 0.25, 0.5, 0.75, 0.95)


@dataclass(frozen=True, repr=False)
class Probability(DisplayMixin):
    """Overturning probability, and probability of a residual displacement.

    Parameters
    ----------
    runs : int
        Samples with a result.
    overturned, moved : float
        Shares that overturn, and that end more than `moved_m` from their place or overturn.
    interval : (float, float), 1
        Clopper-Pearson, 95 %, of `overturned`: sampling interval only, model error not included.
    moved_m : float, m
    final_displacement_m : dict
        Quantiles of the signed residual displacement of samples that do not overturn, by their share; empty if all overturn.
    versions : ParameterVariation
        Half widths in use.
    seed : int
    ranges : ParameterRanges or None
        Priors of the body's kind (edge wear, friction) that replace the relative half widths.
    no_answer : tuple of int
        Numbers, from 1, of the samples that were stopped. They are not among `runs`: whether they overturn is unknown.
    """

    runs: int
    overturned: float
    moved: float
    interval: tuple[float, float]
    moved_m: float
    final_displacement_m: dict[str, float]
    versions: ParameterVariation
    seed: int
    ranges: ParameterRanges | None = None
    no_answer: tuple[int, ...] = ()


@dataclass(frozen=True, repr=False)
class SpatialProbability(DisplayMixin):
    """Overturning probability in three dimensions, with the spread of residual displacement and twist.

    Parameters
    ----------
    runs : int
        Samples with a result.
    overturned, moved : float
        Shares that overturn, and that end more than `moved_m` from their place or overturn.
    interval : (float, float), 1
        Clopper-Pearson, 95 %, of `overturned`: sampling interval only, model error not included.
    moved_m : float, m
    final_displacement_m, twist_deg, abs_twist_deg : dict
        Quantiles of residual distance, twist (counter-clockwise seen from above) and its amount, of samples that do not overturn, by
        their share; empty if all overturn.
    fell_azimuths_deg : tuple of float
        Azimuth of the fall of each sample that overturns, clockwise from north; from +x where its azimuth is unknown.
    versions : ParameterVariation
        Half widths in use; a restitution below 0 counts as 0.
    seed : int
    ranges : ParameterRanges or None
        Priors of the body's kind (edge wear, friction) that replace the relative half widths.
    no_answer : tuple of int
        Numbers, from 1, of the samples without a result.
    """

    runs: int
    overturned: float
    moved: float
    interval: tuple[float, float]
    moved_m: float
    final_displacement_m: dict[str, float]
    twist_deg: dict[str, float]
    abs_twist_deg: dict[str, float]
    fell_azimuths_deg: tuple[float, ...]
    versions: ParameterVariation
    seed: int
    ranges: ParameterRanges | None = None
    no_answer: tuple[int, ...] = ()


def respond_probability(
    block: Block,
    motion: Motion,
    options: RespondOptions,
    *,
    runs: int = RUNS,
    moved_m: float = MOVED_M,
    versions: ParameterVariation = ParameterVariation(),
    seed: int = 0,
    progress: Progress | None = None,
) -> Probability:
    """Compute the overturning probability of a body, and the probability that it moves, from samples of the body and its shaking.

    Parameters
    ----------
    block, motion, options
        As in :func:`~seisblock.models.respond.solve.solve_respond`; the median of the samples.
    runs : int
        Number of samples, at least 1.
    moved_m : float, m
        Residual displacement above which a body counts as moved.
    versions : ParameterVariation
    seed : int
        The same seed gives the same samples, on any number of threads.
    progress : callable
        Called with the number of finished runs and the total.

    Returns
    -------
    Probability

    Raises
    ------
    ParameterError
        If there are no runs, or a number lies outside its range.
    SolverError
        If every sample bounces without end.

    Examples
    --------
    >>> from seisblock.uncertainty import respond_probability
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(5.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> respond_probability(Block(0.24, 0.8), pulse, RespondOptions(mu=0.5), runs=20).overturned
    1.0
    """
    checks.positive("the residual displacement that counts as moved", moved_m, "m")
    samples = sample("respond", block, motion, options, runs, versions, seed=seed, progress=progress)
    return summarize(samples, block, moved_m)


def summarize(samples: Samples, block: Block, moved_m: float = MOVED_M) -> Probability:
    """Return the probability of samples of a free-standing body; stopped samples are excluded: their outcome is unknown, not stable.

    Parameters
    ----------
    samples : Samples
    block : Block
        Their median.
    moved_m : float, m
        Residual displacement above which a body counts as moved.
    """
    return Probability(
        samples.completed,
        samples.probability,
        samples.moved_probability(moved_m),
        samples.interval,
        moved_m,
        _quantiles(samples.displacement_m[~samples.overturned & ~samples.no_answer]),
        samples.variation,
        samples.seed,
        block.ranges and block.ranges.priors,
        samples.stopped,
    )


def summarize_spatial(samples: Samples, body: object, moved_m: float = MOVED_M) -> SpatialProbability:
    """Return the probability of samples in three dimensions.

    Parameters
    ----------
    samples : Samples
    body : Block, ScannedBody or ConvexBody
        Their median.
    moved_m : float, m
        Residual displacement above which a body counts as moved.
    """
    outcomes: tuple[Rigid3dOutcome, ...] = samples.outcomes
    twists = np.array([outcome.twist_deg for outcome in outcomes if not outcome.overturned])
    return SpatialProbability(
        samples.completed,
        samples.probability,
        samples.moved_probability(moved_m),
        samples.interval,
        moved_m,
        _quantiles(samples.displacement_m[~samples.overturned & ~samples.no_answer]),
        _quantiles(twists),
        _quantiles(np.abs(twists)),
        tuple(outcome.fell_azimuth_deg for outcome in outcomes if outcome.fell_azimuth_deg is not None),
        samples.variation,
        samples.seed,
        body.ranges.priors if isinstance(body, Block) and body.ranges is not None else None,
        samples.stopped,
    )


def _quantiles(values: FloatArray) -> dict[str, float]:
    """Return the quantiles of values by their share; empty without values."""
    numbers = np.quantile(values, QUANTILES) if values.size else ()
    return {f"q{round(100 * share):02d}": float(value) for share, value in zip(QUANTILES, numbers, strict=False)}
