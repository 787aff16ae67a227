"""Scale factor on a record that explains the residual twist of an object, with or without its displacement.

Runs in three dimensions with factors drawn log-uniformly and bodies drawn around the given one are weighted by how well their residual
twist, and displacement, agree with the observed ones; an object that overturned has no weight. Rocking in three dimensions is chaotic, so
that one factor gives many twists: the answer is an interval, the quantiles of the weighted factors (importance sampling).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.limits import MAX_RUNS, check_limit
from seisblock.core.typing import FloatArray, Progress
from seisblock.measures.peaks import peak_acceleration
from seisblock.measures.summary import conventions_of, motion_peaks
from seisblock.models.rigid3d.options import Rigid3dOptions
from seisblock.models.rigid3d.outcome import Rigid3dOutcome
from seisblock.models.rigid3d.solve import Body, validate_motion_and_body
from seisblock.records import Motion
from seisblock.studies.intervals import effective_sample_size
from seisblock.studies.sampling import ParameterVariation, draw_samples, rigid3d_outcomes

RUNS = 600
"""Default number of runs per record."""

LEAST_FACTOR, MAX_FACTOR = 0.05, 3.0
"""Smallest and default largest factor."""

TWIST_ERROR, MIN_TWIST_ERROR_DEG = 0.2, 1.0
"""Standard deviation of an observed twist: a share of it, and its smallest value, degrees."""

DISPLACEMENT_ERROR, MIN_DISPLACEMENT_ERROR_M = 0.2, 0.005
"""The same for a displacement, m."""

PILOT_SHARE = 4
"""Runs over those of the pilot, which finds the range of factors between rest and certain overturning."""

RANGE_MARGIN = 1.25
"""Factor on both ends of the range of the pilot, whose runs have one body each: others move or overturn at other factors."""

VARIATION = ParameterVariation(amplitude=0.0)
"""Half widths of what is known; the amplitude does not vary beside the factor."""


@dataclass(frozen=True)
class FactorInterval:
    """Median and bounds of a quantity."""

    median: float
    low: float
    high: float


@dataclass(frozen=True)
class TwistRun:
    """One run at one factor; lengths in m, the weight is 1 for perfect agreement, up to 2 where both are near 0."""

    scale: float
    twist_deg: float
    displacement_m: float
    overturned: bool
    weight: float


@dataclass(frozen=True, repr=False)
class TwistEstimate(DisplayMixin):
    """Factors on one record that explain a residual twist; the fields are the keys of one result in the document of ``infer``.

    Parameters
    ----------
    component : str
    twist_deg : float
        Observed amount of twist.
    displacement_m : float or None
        Observed residual distance.
    scale : FactorInterval or None
        Factor on the record; None if too few runs agree.
    pga_m_s2, pgv_m_s : FactorInterval or None
        Larger PGA and PGV of the horizontals at these factors.
    effective_runs : float
        Number of equally weighted runs with the same information (Kish).
    runs : int
    largest_twist_deg : float
        Largest twist of a run that did not overturn.
    sample : tuple of TwistRun
        All runs, by factor.
    """

    component: str
    twist_deg: float
    displacement_m: float | None
    scale: FactorInterval | None
    pga_m_s2: FactorInterval | None
    pgv_m_s: FactorInterval | None
    effective_runs: float
    runs: int
    largest_twist_deg: float
    sample: tuple[TwistRun, ...]


def infer_twist(
    body: Body,
    motion: Motion,
    options: Rigid3dOptions,
    twist_deg: float,
    *,
    displacement_m: float | None = None,
    limit: float = MAX_FACTOR,
    runs: int = RUNS,
    level: float = 0.9,
    seed: int = 0,
    progress: Progress | None = None,
) -> TwistEstimate:
    """Return the factors on a motion that explain the residual twist of an object.

    Parameters
    ----------
    body : Block, Scan, ScannedBody or ConvexBody
        Median of the runs.
    motion : Motion
        All components act.
    options : Rigid3dOptions
    twist_deg : float, degrees
        Observed rotation about the vertical; its sign does not count.
    displacement_m : float or None, m
        Observed residual distance.
    limit : float
        Largest factor.
    runs : int
    level : float
        Probability of the interval.
    seed : int
    progress : callable
        Called with the number of finished runs and the total.

    Returns
    -------
    TwistEstimate

    Raises
    ------
    ParameterError
        If a number lies outside its range.

    Examples
    --------
    >>> from seisblock import Block, motion_of, read
    >>> motion = motion_of(read("synthetic_jma.csv"), "NS")
    >>> estimate = infer_twist(Block(0.24, 0.6, 0.3), motion, Rigid3dOptions(mu=0.5), 1.0, runs=60)
    >>> estimate.scale.low < estimate.scale.median < estimate.scale.high
    True
    """
    validate_motion_and_body(body, motion)
    observed = abs(checks.in_interval("the observed twist", twist_deg, "[-180, 180]", "degrees"))
    if displacement_m is not None:
        checks.non_negative("the observed displacement", displacement_m, "m")
    checks.in_interval("the largest factor", limit, f"({LEAST_FACTOR}, inf)")
    checks.in_interval("the confidence level", level, "(0, 1)")
    checks.integer("the number of runs", runs, minimum=1)
    check_limit("Monte Carlo samples", runs, MAX_RUNS)
    rng = np.random.default_rng(checks.seed(seed))

    def run(low: float, high: float, count: int, first_seed: int, advance: Progress | None) -> list[tuple[float, Rigid3dOutcome]]:
        # one factor per stratum of equal probability
        scales = low * (high / low) ** ((np.arange(count) + rng.uniform(size=count)) / count)
        draws = draw_samples(count, first_seed)
        outcomes = rigid3d_outcomes(body, motion, options, draws, VARIATION, scales=scales, progress=advance)
        return [(scale, outcome) for scale, outcome in zip(scales.tolist(), outcomes, strict=True) if outcome is not None]

    # most factors are either too small to move the object or overturn it; the pilot finds the range between
    pilot = run(LEAST_FACTOR, limit, max(runs // PILOT_SHARE, 10), seed + 1, None)
    low, high = _range(pilot, limit)
    results = run(low, high, runs, seed, progress)
    sample = []
    for scale, outcome in results:
        distance = math.hypot(*outcome.final_displacement_m)
        # the object still stands: runs that overturn it are excluded, however well they twist
        weight = 0.0 if outcome.overturned or not outcome.moved else _likelihood(abs(outcome.twist_deg), observed)
        if displacement_m is not None:
            misfit = (distance - displacement_m) / max(DISPLACEMENT_ERROR * displacement_m, MIN_DISPLACEMENT_ERROR_M)
            weight *= math.exp(-0.5 * misfit * misfit)
        sample.append(TwistRun(scale, outcome.twist_deg, distance, outcome.overturned, weight))
    weights = np.array([run.weight for run in sample])
    effective = effective_sample_size(weights)
    # few effective runs, whose extremes are no bounds of that level, or none near the observed twist give no interval
    enough = effective >= 2.0 / (1.0 - level) - 1.0 and weights.max() > math.exp(-2.0)
    factors = np.array([run.scale for run in sample])
    interval = _interval(factors, weights, level) if enough else None
    pga = max(peak_acceleration(row)[0] for row in (motion.horizontal, motion.transverse))
    return TwistEstimate(
        motion.name or "x",
        observed,
        displacement_m,
        interval,
        _scaled(interval, pga),
        _scaled(interval, _peak_velocity(motion)),
        effective,
        len(sample),
        max((abs(run.twist_deg) for run in sample if not run.overturned), default=0.0),
        tuple(sample),
    )


def _likelihood(twist: float, observed: float) -> float:
    """Return the likelihood of an observed amount of twist, degrees: a folded normal distribution, 1 for perfect agreement far from 0."""
    # the error of a reading grows with the twist, but has a smallest value; readings to either side have the same amount
    error = max(TWIST_ERROR * observed, MIN_TWIST_ERROR_DEG)
    return math.exp(-0.5 * ((twist - observed) / error) ** 2) + math.exp(-0.5 * ((twist + observed) / error) ** 2)


def _range(pilot: Sequence[tuple[float, Rigid3dOutcome]], limit: float) -> tuple[float, float]:
    """Return the range of factors that can matter: from below the last one without motion to above the one beyond which all overturn."""
    first = next((k for k, (_, outcome) in enumerate(pilot) if outcome.moved), len(pilot) - 1)
    last = max((k for k, (_, outcome) in enumerate(pilot) if not outcome.overturned), default=0)
    low = max(pilot[max(first - 1, 0)][0] / RANGE_MARGIN, LEAST_FACTOR)
    high = min(pilot[min(last + 1, len(pilot) - 1)][0] * RANGE_MARGIN, limit)
    return (low, high) if low < high else (LEAST_FACTOR, limit)


def pooled_pga(estimates: Sequence[TwistEstimate], level: float = 0.9) -> FactorInterval | None:
    """Return the PGA at a station of which several records are candidates, each as probable as the others; None without an interval."""
    parts = [estimate for estimate in estimates if estimate.scale is not None and estimate.pga_m_s2 is not None]
    if not parts:
        return None
    values, weights = [], []
    for part in parts:
        assert part.scale is not None and part.pga_m_s2 is not None
        run_weights = np.array([run.weight for run in part.sample])
        values.append(np.array([run.scale for run in part.sample]) * part.pga_m_s2.median / part.scale.median)
        weights.append(run_weights / run_weights.sum())
    return _interval(np.concatenate(values), np.concatenate(weights), level)


def _interval(values: FloatArray, weights: FloatArray, level: float) -> FactorInterval:
    """Return weighted median and bounds of equal tails, between which another value lies with the probability `level`."""
    order, shares = np.argsort(values), weights / weights.sum()
    # of n equal weights the k-th value has the position k / (n + 1): another value lies below it with this probability
    effective = effective_sample_size(weights)
    centred = np.cumsum(shares[order]) - 0.5 * shares[order] - 0.5
    positions = 0.5 + centred * effective / (effective + 1.0)
    low, median, high = np.interp([0.5 - 0.5 * level, 0.5, 0.5 + 0.5 * level], positions, values[order]).tolist()
    return FactorInterval(median, low, high)


def _scaled(interval: FactorInterval | None, factor: float) -> FactorInterval | None:
    return None if interval is None else FactorInterval(factor * interval.median, factor * interval.low, factor * interval.high)


def _peak_velocity(motion: Motion) -> float:
    """Return the larger PGV of the horizontals, m/s."""
    rules = conventions_of(motion.record)
    return max(motion_peaks(row, motion.dt, rules).pgv_m_s for row in (motion.horizontal, motion.transverse))
