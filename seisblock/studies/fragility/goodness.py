"""How well a lognormal fits, judged against samples of itself: runs at several levels share their motions, so that no table applies."""

from __future__ import annotations

import numpy as np

from seisblock.studies.fragility.answer import Goodness
from seisblock.studies.fragility.capacities import moments
from seisblock.studies.fragility.lognormal import Lognormal, curves
from seisblock.typing import FloatArray

SAMPLES = 400
"""Samples of the fitted curve that it is judged against."""

LEAST = 0.05
"""A curve is doubted where fewer of them lie as far from theirs."""

KS, CUMULATED = "ks", "cumulated residuals"


def goodness_of_stripes(
    curve: Lognormal, levels: FloatArray, exceeding: FloatArray, runs: float, motions: int, dice: np.random.Generator
) -> Goodness:
    """Return how well a curve fits shares at levels that the same motions were scaled to ([Lilliefors1967]_ method).

    Each sample is of as many motions with their own intensities at which it happens; it is counted at the levels, fitted, and its
    distance taken from its own curve. Motions count as independent of each other.

    Parameters
    ----------
    curve : Lognormal
    levels, exceeding : (n,) arrays
    runs : float
        At each level.
    motions : int
        How many intensities a sample draws.
    dice : numpy.random.Generator
    """
    drawn = curve.median * np.exp(curve.beta * dice.standard_normal((SAMPLES, motions)))
    counts = (drawn[:, :, None] <= levels).sum(axis=1).astype(np.float64)
    medians, betas = curves(levels, counts, np.full((1, levels.size), float(motions)))
    good = np.isfinite(medians)
    far = _distances(counts[good] / motions, levels, medians[good], betas[good])
    found = float(_distances(exceeding[None] / runs, levels, np.array([curve.median]), np.array([curve.beta]))[0])
    return _judged(KS, found, far, _deviance(curve.probability(levels), exceeding, np.full(levels.size, runs)))


def goodness_of_capacities(curve: Lognormal, log_capacities: FloatArray, top: float, dice: np.random.Generator) -> Goodness:
    """Return how well a curve fits the intensities at which it happened first, up to a highest level ([Lilliefors1967]_ method).

    Parameters
    ----------
    curve : Lognormal
    log_capacities : (m,) array
        Infinite where it did not happen.
    top : float
        Logarithm of the highest level.
    dice : numpy.random.Generator
    """
    drawn = np.log(curve.median) + curve.beta * dice.standard_normal((SAMPLES, log_capacities.size))
    drawn = np.where(drawn <= top, drawn, np.inf)
    far = []
    for sample in drawn:
        medians, betas = moments(sample, np.ones((1, sample.size)), top)
        if np.isfinite(medians[0]):
            far.append(_steps_distance(sample, float(medians[0]), float(betas[0])))
    found = _steps_distance(log_capacities, curve.median, curve.beta)
    return _judged(KS, found, np.array(far), None)


def goodness_of_cloud(curve: Lognormal, intensities: FloatArray, happened: FloatArray, runs: float, dice: np.random.Generator) -> Goodness:
    """Return how well a curve fits what happened at intensities as they came ([SuWei1991]_ method: residuals summed along them).

    Parameters
    ----------
    curve : Lognormal
    intensities, happened : (m,) arrays
    runs : float
        Of each motion.
    dice : numpy.random.Generator
    """
    order = np.argsort(intensities)
    x, y = intensities[order], happened[order]
    expected = curve.probability(x)
    drawn = dice.binomial(int(runs), expected, (SAMPLES, x.size)).astype(np.float64)
    medians, betas = curves(x, drawn, np.full((1, x.size), runs))
    good = np.isfinite(medians)
    far = _summed(drawn[good], x, medians[good], betas[good], runs)
    found = float(_summed(y[None], x, np.array([curve.median]), np.array([curve.beta]), runs)[0])
    return _judged(CUMULATED, found, far, _deviance(expected, y, np.full(x.size, runs)))


def _judged(statistic: str, found: float, far: FloatArray, deviance: float | None) -> Goodness:
    """Return the judgement of a distance beside those of samples."""
    share = float((np.sum(far >= found) + 1.0) / (far.size + 1.0))
    return Goodness(statistic, found, share, deviance, share >= LEAST)


def _probabilities(levels: FloatArray, medians: FloatArray, betas: FloatArray) -> FloatArray:
    """Return the probabilities of several curves at some levels, (b, n)."""
    from scipy.special import ndtr

    return np.asarray(ndtr((np.log(levels) - np.log(medians)[:, None]) / betas[:, None]))


def _distances(shares: FloatArray, levels: FloatArray, medians: FloatArray, betas: FloatArray) -> FloatArray:
    """Return the largest distance of shares at levels from each curve, (b,)."""
    return np.asarray(np.abs(shares - _probabilities(levels, medians, betas)).max(axis=1))


def _summed(happened: FloatArray, x: FloatArray, medians: FloatArray, betas: FloatArray, runs: float) -> FloatArray:
    """Return the largest sum of what happened less what each curve expected, along x, over the root of the number of runs, (b,)."""
    left = happened - runs * _probabilities(x, medians, betas)
    return np.asarray(np.abs(np.cumsum(left, axis=1)).max(axis=1) / np.sqrt(runs * x.size))


def _steps_distance(log_capacities: FloatArray, median: float, beta: float) -> float:
    """Return the largest distance of the steps of a sample from a curve, as far as it happened."""
    from scipy.special import ndtr

    ordered = np.sort(log_capacities)
    seen = np.isfinite(ordered)
    expected = ndtr((ordered[seen] - np.log(median)) / beta)
    steps = np.arange(1, int(seen.sum()) + 1) / ordered.size
    return float(np.max([np.abs(steps - expected), np.abs(steps - 1.0 / ordered.size - expected)], initial=0.0))


def _deviance(expected: FloatArray, happened: FloatArray, runs: FloatArray) -> float:
    """Return twice what the likelihood falls short of that of the shares themselves, over the degrees of freedom."""
    from scipy.special import xlogy

    short = xlogy(happened, happened / np.maximum(runs * expected, 1e-300))
    short += xlogy(runs - happened, (runs - happened) / np.maximum(runs * (1.0 - expected), 1e-300))
    return float(2.0 * short.sum() / max(expected.size - 2, 1))
