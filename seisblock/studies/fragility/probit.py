"""Probit regression by maximum likelihood, many samples at once.

The log likelihood is concave, so Newton's method with step halving finds its single maximum; bootstrap samples share the levels,
differ in their counts, and iterate in parallel.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seisblock.core.typing import BoolArray, FloatArray

MAX_ITERATIONS = 60
MAX_HALVINGS = 12
TOLERANCE = 1e-10
"""Convergence tolerance: change of every coefficient, with a standardised first column."""

MAX_SCORE = 30.0
"""Clipping of the scores: beyond, a probability equals 0 or 1 in double precision."""


@dataclass(frozen=True, eq=False)
class ProbitFits:
    """Probit fits of several samples.

    Parameters
    ----------
    coefficients : (b, k) array
        Of the columns; NaN if the sample has no maximum.
    log_likelihood : (b,) array
        At the maximum, without the binomial coefficients.
    """

    coefficients: FloatArray
    log_likelihood: FloatArray


def fit_probit(columns: FloatArray, exceeding: FloatArray, runs: FloatArray, *, constants: int = 1) -> ProbitFits:
    """Return the maximum-likelihood coefficients c of counts with the probability Phi(columns c) ([Baker2015]_ eq. (11)).

    Parameters
    ----------
    columns : (n, k) array
        One row per group of runs; the probability must rise with the first column, then come the constants.
    exceeding, runs : (b, n) arrays
        Exceedances of each group, and its runs; one row per sample. Neither need be whole: groups may have weights.
    constants : int
        Number of constant columns after the first: one, or one for each of several kinds of groups, which add up to one.

    Returns
    -------
    ProbitFits
        NaN for a sample separated by the first column, or not rising with it.
    """
    middle, scale = float(columns[:, 0].mean()), float(columns[:, 0].std()) or 1.0
    # standardised for the condition of the Hessian; undone below
    x = np.column_stack([(columns[:, 0] - middle) / scale, columns[:, 1:]])
    y, n = np.broadcast_arrays(np.asarray(exceeding, dtype=np.float64), np.asarray(runs, dtype=np.float64))
    # the pooled samples give a start near every maximum
    start, _ = _maximize(x, np.zeros((1, columns.shape[1])), y.sum(axis=0, keepdims=True), n.sum(axis=0, keepdims=True))
    coefficients, value = _maximize(x, np.repeat(start, len(y), axis=0), y, n)
    coefficients[:, 0] /= scale
    coefficients[:, 1 : 1 + constants] -= middle * coefficients[:, :1]
    # a decreasing probability is no fragility curve
    good = coefficients[:, 0] > 0.0
    return ProbitFits(np.where(good[:, None], coefficients, np.nan), np.where(good, value, np.nan))


def is_separated(x: FloatArray, exceeding: FloatArray, runs: FloatArray) -> BoolArray:
    """Return True for samples separated by one level: no exceedance below, all above, so that no slope is too steep.

    Parameters
    ----------
    x : (n,) array
    exceeding, runs : (b, n) arrays

    Returns
    -------
    (b,) array of bool
        True also for samples without any exceedance, or with nothing else.
    """
    y, n = np.broadcast_arrays(exceeding, runs)
    # separated: the highest level with a survivor does not exceed the lowest with an exceedance
    highest_not = np.where(y < n, x, -np.inf).max(axis=1)
    lowest = np.where(y > 0.0, x, np.inf).min(axis=1)
    return np.asarray(highest_not <= lowest)


def _maximize(x: FloatArray, c: FloatArray, y: FloatArray, n: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the coefficients at the maxima, (b, k), and the log likelihoods there, (b,)."""
    value = _log_likelihood(c @ x.T, y, n)
    for _ in range(MAX_ITERATIONS):
        change, c, value = _line_search(x, c, _newton_step(x, c @ x.T, y, n), value, y, n)
        if change < TOLERANCE:
            break
    return c, value


def _log_likelihood(score: FloatArray, y: FloatArray, n: FloatArray) -> FloatArray:
    """Return the sum over the groups of y ln Phi + (n - y) ln(1 - Phi), (b,)."""
    from scipy.special import log_ndtr

    bounded = np.clip(score, -MAX_SCORE, MAX_SCORE)
    return np.asarray((y * log_ndtr(bounded) + (n - y) * log_ndtr(-bounded)).sum(axis=1))


def _newton_step(x: FloatArray, score: FloatArray, y: FloatArray, n: FloatArray) -> FloatArray:
    """Return Newton's step of each sample, (b, k)."""
    from scipy.special import log_ndtr

    bounded = np.clip(score, -MAX_SCORE, MAX_SCORE)
    # ratios of density and tail in logarithms: no 0/0 far in the tails
    density = -0.5 * bounded * bounded - 0.5 * np.log(2.0 * np.pi)
    rises, falls = np.exp(density - log_ndtr(bounded)), np.exp(density - log_ndtr(-bounded))
    slope = y * rises - (n - y) * falls
    curvature = y * rises * (rises + bounded) + (n - y) * falls * (falls - bounded)
    gradient = slope @ x
    hessian = np.einsum("bn,ni,nj->bij", curvature, x, x, optimize=True)
    # a ridge far below the curvature keeps a singular Hessian solvable
    ridge = 1e-12 * np.trace(hessian, axis1=1, axis2=2)[:, None, None] + 1e-300
    step = np.linalg.solve(hessian + ridge * np.eye(x.shape[1]), gradient[:, :, None])
    return np.asarray(step[:, :, 0])


def _line_search(
    x: FloatArray, c: FloatArray, step: FloatArray, value: FloatArray, y: FloatArray, n: FloatArray
) -> tuple[float, FloatArray, FloatArray]:
    """Return the largest change of a coefficient, the new coefficients, and their likelihoods; steps are halved until uphill."""
    length = np.ones(len(c))
    for _ in range(MAX_HALVINGS):
        trial = c + length[:, None] * step
        trial_value = _log_likelihood(trial @ x.T, y, n)
        # a tolerance of round-off: at the maximum no step improves the likelihood
        worse = trial_value < value - 1e-9 * np.abs(value)
        if not worse.any():
            break
        length = np.where(worse, 0.5 * length, length)
    trial = np.where(worse[:, None], c, trial)
    return float(np.abs(trial - c).max(initial=0.0)), trial, np.where(worse, value, trial_value)
