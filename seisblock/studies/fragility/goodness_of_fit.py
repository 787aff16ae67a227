"""Goodness of fit of a lognormal curve by parametric bootstrap: runs at several levels share their motions, so no table applies."""

from __future__ import annotations

import numpy as np

from seisblock.core.typing import FloatArray
from seisblock.studies.fragility.capacities import moments
from seisblock.studies.fragility.lognormal import Lognormal, fit_lognormals
from seisblock.studies.fragility.results import Goodness

SAMPLE_COUNT = 400
"""Samples of the fitted curve."""

SIGNIFICANCE = 0.05
"""Significance level of a misfit."""

KS, CUMULATED = "ks", "cumulated residuals"


def goodness_of_stripes(
    curve: Lognormal, levels: FloatArray, exceeding: FloatArray, runs: float, motions: int, rng: np.random.Generator
) -> Goodness:
    """Return the goodness of fit of a curve to shares at levels of the same scaled motions ([Lilliefors1967]_ method).

    Each sample consists of as many motions with random capacities; it is counted at the levels, fitted, and compared with its own
    curve. Motions count as independent.

    Parameters
    ----------
    curve : Lognormal
    levels, exceeding : (n,) arrays
    runs : float
        At each level.
    motions : int
        Capacities in a sample.
    rng : numpy.random.Generator
    """
    samples = curve.median * np.exp(curve.beta * rng.standard_normal((SAMPLE_COUNT, motions)))
    # one capacity decides a motion at all levels: counts at the levels are dependent, as in the data
    counts = (samples[:, :, None] <= levels).sum(axis=1).astype(np.float64)
    medians, betas = fit_lognormals(levels, counts, np.full((1, levels.size), float(motions)))
    good = np.isfinite(medians)
    sample_distances = _ks_distances(counts[good] / motions, levels, medians[good], betas[good])
    distance = float(_ks_distances(exceeding[None] / runs, levels, np.array([curve.median]), np.array([curve.beta]))[0])
    return _make_goodness(KS, distance, sample_distances, _deviance(curve.probability(levels), exceeding, np.full(levels.size, runs)))


def goodness_of_capacities(curve: Lognormal, log_capacities: FloatArray, top: float, rng: np.random.Generator) -> Goodness:
    """Return the goodness of fit of a curve to IDA capacities up to a highest level ([Lilliefors1967]_ method).

    Parameters
    ----------
    curve : Lognormal
    log_capacities : (m,) array
        Infinite without exceedance.
    top : float
        Logarithm of the highest level.
    rng : numpy.random.Generator
    """
    samples = np.log(curve.median) + curve.beta * rng.standard_normal((SAMPLE_COUNT, log_capacities.size))
    # censored at the highest level, as the data are
    samples = np.where(samples <= top, samples, np.inf)
    sample_distances = []
    for sample in samples:
        medians, betas = moments(sample, np.ones((1, sample.size)), top)
        if np.isfinite(medians[0]):
            sample_distances.append(_ks_distance(sample, float(medians[0]), float(betas[0])))
    distance = _ks_distance(log_capacities, curve.median, curve.beta)
    return _make_goodness(KS, distance, np.array(sample_distances), None)


def goodness_of_cloud(curve: Lognormal, intensities: FloatArray, exceeding: FloatArray, runs: float, rng: np.random.Generator) -> Goodness:
    """Return the goodness of fit of a curve to unscaled motions ([SuWei1991]_ method: cumulated residuals).

    Parameters
    ----------
    curve : Lognormal
    intensities, exceeding : (m,) arrays
    runs : float
        Of each motion.
    rng : numpy.random.Generator
    """
    order = np.argsort(intensities)
    x, y = intensities[order], exceeding[order]
    expected = curve.probability(x)
    samples = rng.binomial(int(runs), expected, (SAMPLE_COUNT, x.size)).astype(np.float64)
    medians, betas = fit_lognormals(x, samples, np.full((1, x.size), runs))
    good = np.isfinite(medians)
    sample_distances = _max_cumulative_residual(samples[good], x, medians[good], betas[good], runs)
    distance = float(_max_cumulative_residual(y[None], x, np.array([curve.median]), np.array([curve.beta]), runs)[0])
    return _make_goodness(CUMULATED, distance, sample_distances, _deviance(expected, y, np.full(x.size, runs)))


def _make_goodness(statistic: str, distance: float, sample_distances: FloatArray, deviance: float | None) -> Goodness:
    """Return the rank of a distance among those of the samples; +1 counts the data as one of them."""
    share = float((np.sum(sample_distances >= distance) + 1.0) / (sample_distances.size + 1.0))
    return Goodness(statistic, distance, share, deviance, share >= SIGNIFICANCE)


def _probabilities(levels: FloatArray, medians: FloatArray, betas: FloatArray) -> FloatArray:
    """Return the probabilities of several curves at given levels, (b, n)."""
    from scipy.special import ndtr

    return np.asarray(ndtr((np.log(levels) - np.log(medians)[:, None]) / betas[:, None]))


def _ks_distances(shares: FloatArray, levels: FloatArray, medians: FloatArray, betas: FloatArray) -> FloatArray:
    """Return the largest distance of shares at levels from each curve, (b,)."""
    return np.asarray(np.abs(shares - _probabilities(levels, medians, betas)).max(axis=1))


def _max_cumulative_residual(exceeding: FloatArray, x: FloatArray, medians: FloatArray, betas: FloatArray, runs: float) -> FloatArray:
    """Return the largest cumulated residual along x over the root of the number of runs, (b,)."""
    residuals = exceeding - runs * _probabilities(x, medians, betas)
    return np.asarray(np.abs(np.cumsum(residuals, axis=1)).max(axis=1) / np.sqrt(runs * x.size))


def _ks_distance(log_capacities: FloatArray, median: float, beta: float) -> float:
    """Return the Kolmogorov-Smirnov distance of a sample, censored at the top, from a curve."""
    from scipy.special import ndtr

    sorted_logs = np.sort(log_capacities)
    observed = np.isfinite(sorted_logs)
    expected = ndtr((sorted_logs[observed] - np.log(median)) / beta)
    steps = np.arange(1, int(observed.sum()) + 1) / sorted_logs.size
    # the empirical distribution jumps at each value: both sides of the step count
    return float(np.max([np.abs(steps - expected), np.abs(steps - 1.0 / sorted_logs.size - expected)], initial=0.0))


def _deviance(expected: FloatArray, exceeding: FloatArray, runs: FloatArray) -> float:
    """Return the deviance over the degrees of freedom: twice the log-likelihood deficit against the shares themselves."""
    from scipy.special import xlogy

    shortfall = xlogy(exceeding, exceeding / np.maximum(runs * expected, 1e-300))
    shortfall += xlogy(runs - exceeding, (runs - exceeding) / np.maximum(runs * (1.0 - expected), 1e-300))
    return float(2.0 * shortfall.sum() / max(expected.size - 2, 1))
