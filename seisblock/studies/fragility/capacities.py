"""IDA capacities: the intensities at which scaled motions first exceed a limit state, and their lognormal moments."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.core.typing import BoolArray, FloatArray


@dataclass(frozen=True, eq=False)
class Capacities:
    """First exceedance of a limit state by each motion.

    Parameters
    ----------
    log_factor : (m,) array
        Logarithm of the factor, midway between the level of the first exceedance and the one before; infinite without exceedance.
    monotone : (m,) array of bool
        True if the limit is exceeded at all higher levels, too.
    """

    log_factor: FloatArray
    monotone: BoolArray


def capacities(exceeded: BoolArray, log_levels: FloatArray, completed: BoolArray | None = None) -> Capacities:
    """Return the first exceedance of a limit in each row of runs, on rising levels ([Vamvatsikos2002]_ section 4).

    Parameters
    ----------
    exceeded : (m, n) array of bool
    log_levels : (m, n) or (n,) array
        Logarithms of the factors, or of the intensities.
    completed : (m, n) array of bool
        Runs with a result; the levels of the others are left out. Default: all.
    """
    grid = np.broadcast_to(log_levels, exceeded.shape)
    if completed is not None and not completed.all():
        # a level without a result is replaced by the next lower one with a result
        below = np.maximum.accumulate(np.where(completed, np.arange(exceeded.shape[1]), -1), axis=1)
        first = np.argmax(completed, axis=1)[:, None]
        below = np.where(below < 0, first, below)
        exceeded = np.take_along_axis(exceeded, below, axis=1) & completed.any(axis=1, keepdims=True)
        grid = np.take_along_axis(grid, below, axis=1)
    any_exceeded, first = exceeded.any(axis=1), exceeded.argmax(axis=1)
    rows = np.arange(len(exceeded))
    middle = 0.5 * (grid[rows, first] + grid[rows, np.maximum(first - 1, 0)])
    monotone = np.logical_or.accumulate(exceeded, axis=1) == exceeded
    return Capacities(np.where(any_exceeded, middle, np.inf), np.asarray(monotone.all(axis=1)))


def moments(log_capacities: FloatArray, weights: FloatArray, top: float) -> tuple[FloatArray, FloatArray]:
    """Return medians and betas of samples of capacities ([Baker2015]_ eqs. (2), (3); censored (4)-(7)).

    Mean and standard deviation of the logarithms; if some motions do not exceed the limit up to the highest level, the
    maximum-likelihood values of the censored sample.

    Parameters
    ----------
    log_capacities : (m,) array
        Infinite without exceedance.
    weights : (b, m) array
        Weight of each capacity in each sample.
    top : float
        Logarithm of the highest level.

    Returns
    -------
    (b,) arrays
        NaN with fewer than two exceedances, or with all at one level.
    """
    observed = np.isfinite(log_capacities)
    value = np.where(observed, log_capacities, 0.0)
    observed_weight = weights[:, observed].sum(axis=1)
    censored = weights[:, ~observed].sum(axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = (weights * value).sum(axis=1) / observed_weight
        spread = (weights * observed * (value - mean[:, None]) ** 2).sum(axis=1)
        deviation = np.sqrt(spread / (observed_weight - 1.0))
    # a spread of zero (all at one level) has no beta
    good = (observed_weight >= 2.0) & (spread > 1e-12)
    for row in np.flatnonzero(good & (censored > 0.0)):
        mean[row], deviation[row] = _censored(value[observed], weights[row, observed], float(censored[row]), top, mean[row], deviation[row])
    return np.where(good, np.exp(mean), np.nan), np.where(good, deviation, np.nan)


def _censored(value: FloatArray, weight: FloatArray, censored: float, top: float, mean: float, deviation: float) -> tuple[float, float]:
    """Return mean and standard deviation of a normal sample censored above `top`, by EM ([Baker2015]_ eqs. (4)-(7))."""
    from scipy.special import log_ndtr

    count = float(weight.sum())
    for _ in range(500):
        z = (top - mean) / deviation
        # hazard rate of the normal distribution in logarithms: stable far in the upper tail
        ratio = math.exp(-0.5 * z * z - 0.5 * math.log(2.0 * math.pi) - float(log_ndtr(-z)))
        # E step: moments of the values above `top`
        first = mean + deviation * ratio
        second = mean**2 + deviation**2 + deviation * (top + mean) * ratio
        # M step
        new_mean = (float(weight @ value) + censored * first) / (count + censored)
        total = float(weight @ value**2) + censored * second
        spread = math.sqrt(max(total / (count + censored) - new_mean * new_mean, 1e-24))
        converged = abs(new_mean - mean) + abs(spread - deviation) < 1e-10
        mean, deviation = new_mean, spread
        if converged:
            break
    return mean, deviation
