"""Probit regression by maximum likelihood, many samples at once: what every fit of a fragility comes down to.

The logarithm of the likelihood is concave, so that Newton's method with halved steps finds its one maximum; a bootstrap's samples share the
levels and differ in their counts, and move together.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seisblock.core.typing import BoolArray, FloatArray

MAX_ITERATIONS = 60
MAX_HALVINGS = 12
TOLERANCE = 1e-10
"""Change of every coefficient, of a standardised first column, at which a fit stands still."""

MAX_SCORE = 30.0
"""Scores beyond which a probability differs from 0 or 1 by nothing that a number can hold."""


@dataclass(frozen=True, eq=False)
class ProbitFits:
    """Fits of several samples.

    Parameters
    ----------
    coefficients : (b, k) array
        Of the columns; NaN where the sample has no maximum.
    log_likelihood : (b,) array
        At the maximum, without the binomial coefficients.
    """

    coefficients: FloatArray
    log_likelihood: FloatArray


def fit_probit(columns: FloatArray, happened: FloatArray, runs: FloatArray, *, constants: int = 1) -> ProbitFits:
    """Return the coefficients c that make counts most likely where the probability is Phi(columns c) ([Baker2015]_ eq. (11)).

    Parameters
    ----------
    columns : (n, k) array
        One row for each group of runs; the first column is what the probability must rise with, then come the constants.
    happened, runs : (b, n) arrays
        How often it happened in each group, of how many; one row for each sample. Neither need be whole: groups may have weights.
    constants : int
        How many of the columns after the first are constants: one, or one for each of several kinds of groups, which add up to one.

    Returns
    -------
    Probits
        NaN where a sample is separated by the first column, or does not rise with it.
    """
    middle, scale = float(columns[:, 0].mean()), float(columns[:, 0].std()) or 1.0
    x = np.column_stack([(columns[:, 0] - middle) / scale, columns[:, 1:]])
    y, n = np.broadcast_arrays(np.asarray(happened, dtype=np.float64), np.asarray(runs, dtype=np.float64))
    # all samples together are a good place to begin
    start, _ = _maximize(x, np.zeros((1, columns.shape[1])), y.sum(axis=0, keepdims=True), n.sum(axis=0, keepdims=True))
    coefficients, value = _maximize(x, np.repeat(start, len(y), axis=0), y, n)
    coefficients[:, 0] /= scale
    coefficients[:, 1 : 1 + constants] -= middle * coefficients[:, :1]
    good = coefficients[:, 0] > 0.0
    return ProbitFits(np.where(good[:, None], coefficients, np.nan), np.where(good, value, np.nan))


def is_separated(x: FloatArray, happened: FloatArray, runs: FloatArray) -> BoolArray:
    """Return where samples are told apart by one level: nothing happened below it, everything above, and no slope is too steep.

    Parameters
    ----------
    x : (n,) array
    happened, runs : (b, n) arrays

    Returns
    -------
    (b,) array of bool
        True also where it never happened, or always.
    """
    y, n = np.broadcast_arrays(happened, runs)
    highest_not = np.where(y < n, x, -np.inf).max(axis=1)
    lowest = np.where(y > 0.0, x, np.inf).min(axis=1)
    return np.asarray(highest_not <= lowest)


def _maximize(x: FloatArray, c: FloatArray, y: FloatArray, n: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the coefficients at the maxima, (b, k), and the logarithms of the likelihoods there, (b,)."""
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
    density = -0.5 * bounded * bounded - 0.5 * np.log(2.0 * np.pi)
    rises, falls = np.exp(density - log_ndtr(bounded)), np.exp(density - log_ndtr(-bounded))
    slope = y * rises - (n - y) * falls
    curvature = y * rises * (rises + bounded) + (n - y) * falls * (falls - bounded)
    gradient = slope @ x
    hessian = np.einsum("bn,ni,nj->bij", curvature, x, x, optimize=True)
    ridge = 1e-12 * np.trace(hessian, axis1=1, axis2=2)[:, None, None] + 1e-300
    step = np.linalg.solve(hessian + ridge * np.eye(x.shape[1]), gradient[:, :, None])
    return np.asarray(step[:, :, 0])


def _line_search(
    x: FloatArray, c: FloatArray, step: FloatArray, value: FloatArray, y: FloatArray, n: FloatArray
) -> tuple[float, FloatArray, FloatArray]:
    """Return how far the samples moved, where they are, and their likelihoods: each step as long as it leads uphill."""
    length = np.ones(len(c))
    for _ in range(MAX_HALVINGS):
        trial = c + length[:, None] * step
        trial_value = _log_likelihood(trial @ x.T, y, n)
        worse = trial_value < value - 1e-9 * np.abs(value)
        if not worse.any():
            break
        length = np.where(worse, 0.5 * length, length)
    trial = np.where(worse[:, None], c, trial)
    return float(np.abs(trial - c).max(initial=0.0)), trial, np.where(worse, value, trial_value)
