"""The lognormal curve, and its fit to counts at levels."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import Message, lazy_gettext
from seisblock.core.typing import ArrayLike, FloatArray
from seisblock.studies.fragility.probit import fit_probit, is_separated

NOT_INCREASING = lazy_gettext(
    "it does not happen more often at higher levels: no fragility follows; look at more records, or at another measure"
)
"""Why counts that do not rise with the level have no curve."""

MAX_LOG_MEDIAN = 100.0
"""Logarithm of a median beyond which there is no curve."""


@dataclass(frozen=True)
class Lognormal:
    """A probability that rises with the intensity x as Phi(ln(x/median)/beta) ([Baker2015]_ eq. (1)).

    Parameters
    ----------
    median : float, in `unit` of the intensity
        At which it is one half.
    beta : float, 1
        Standard deviation of the logarithm of the intensity at which it happens.

    Raises
    ------
    ParameterError
        If either is not positive.

    Examples
    --------
    >>> Lognormal(3.0, 0.4).probability([3.0, 6.0]).round(3).tolist()
    [0.5, 0.958]
    """

    median: float
    beta: float

    def __post_init__(self) -> None:
        checks.positive("the median of a fragility", self.median)
        checks.positive("beta, the dispersion of a fragility,", self.beta)

    def probability(self, intensity: ArrayLike) -> FloatArray:
        """Return the probability at some intensities, of the shape in which they come; zero at and below zero."""
        from scipy.special import ndtr

        x = checks.float_array("the intensities", intensity)
        with np.errstate(divide="ignore"):
            return np.asarray(ndtr(np.log(np.maximum(x, 0.0) / self.median) / self.beta))

    def quantile(self, probability: float) -> float:
        """Return the intensity at which it happens with a probability between 0 and 1."""
        from scipy.special import ndtri

        share = checks.in_interval("the probability", probability, "(0, 1)")
        return self.median * math.exp(self.beta * float(ndtri(share)))


def fit_fragility(levels: ArrayLike, exceeding: ArrayLike, runs: ArrayLike) -> Lognormal:
    """Return the lognormal curve that makes counts at some levels most likely ([Baker2015]_ eq. (11)).

    Parameters
    ----------
    levels : (n,) array, in `unit`
        Positive intensities; the median comes in the same.
    exceeding, runs : (n,) arrays, 1
        In how many runs at each level it happened, and how many there were; one number of runs for all levels will do.

    Raises
    ------
    ParameterError
        If the numbers make no sense, or no curve follows from them; the sentence says which levels would tell.

    Notes
    -----
    The counts are binomial with Phi(ln(x/median)/beta), which is probit regression on ln x: Phi(a + b ln x) with b = 1/beta and
    median = exp(-a/b) ([Baker2015]_ eq. (11)).

    Examples
    --------
    >>> found = fit_fragility([1.0, 2.0, 4.0, 8.0], [0, 3, 7, 10], 10)
    >>> round(found.median, 3), round(found.beta, 3)
    (2.828, 0.477)
    """
    x, y, n = (checks.float_array(name, values) for name, values in _labelled_inputs(levels, exceeding, runs))
    if x.ndim != 1 or x.size < 2 or y.shape != x.shape or n.size not in (1, x.size):
        raise ParameterError(
            "a fragility needs two levels or more, and as many counts; found {levels} levels and {counts} counts",
            levels=x.size,
            counts=y.size,
        )
    n = np.broadcast_to(n, x.shape)
    if not (np.isfinite(x).all() and (x > 0.0).all()):
        raise ParameterError("the levels of a fragility must be positive numbers")
    if not ((y >= 0.0) & (y <= n) & (n > 0.0) & np.isfinite(n)).all():
        raise ParameterError("a count of a fragility lies between 0 and the number of runs, which is positive")
    reason = no_curve_reason(x, y, n)
    if reason:
        raise ParameterError("{why}", why=reason)
    medians, betas = fit_lognormals(x, y[None], n[None])
    if not math.isfinite(float(medians[0])):
        raise ParameterError("{why}", why=NOT_INCREASING)
    return Lognormal(float(medians[0]), float(betas[0]))


def _labelled_inputs(levels: ArrayLike, exceeding: ArrayLike, runs: ArrayLike) -> tuple[tuple[str, ArrayLike], ...]:
    """Return what a fit is given, each with its name."""
    return ("the levels", np.atleast_1d(levels)), ("the counts", np.atleast_1d(exceeding)), ("the numbers of runs", np.atleast_1d(runs))


def no_curve_reason(
    levels: FloatArray,
    exceeding: FloatArray,
    runs: FloatArray,
    display_unit: tuple[float, str] = (1.0, ""),
    *,
    is_scaled: bool = True,
    first: bool = False,
) -> Message | None:
    """Return why no curve follows from counts, and what would tell; None where one does.

    Parameters
    ----------
    levels, exceeding, runs : (n,) arrays
    display_unit : (float, str)
        The unit in which levels are told, in that of the levels, and its name.
    is_scaled : bool
        Whether motions were scaled to the levels, so that other levels may be asked for.
    first : bool
        Whether the levels count at which each motion does it first: two that differ are enough.
    """
    happened, not_exceeded = exceeding > 0.0, exceeding < runs
    size, unit = display_unit
    ends = {"low": levels.min(), "top": levels.max()}
    if happened.any() and not_exceeded.any():
        ends |= {"held": levels[not_exceeded].max(), "passed": levels[happened].min()}
    level_texts = {name: f"{value / size:.4g} {unit}".strip() for name, value in ends.items()}
    if not happened.any():
        if not is_scaled:
            return lazy_gettext(
                "it happens under none of the motions, up to {top}: give stronger ones, or scale them (stripes)", **level_texts
            )
        return lazy_gettext("it happens at no level, up to {top}: ask for higher levels", **level_texts)
    if not not_exceeded.any():
        if not is_scaled:
            return lazy_gettext("it happens under all motions, from {low} on: give weaker ones, or scale them (stripes)", **level_texts)
        return lazy_gettext("it happens in all runs at all levels, from {low} on: ask for lower levels", **level_texts)
    if not is_separated(np.log(levels), exceeding[None], runs[None])[0] or (first and ends["held"] >= ends["passed"]):
        return None
    if not is_scaled:
        return lazy_gettext(
            "it happens under no motion up to {held} and under all from {passed} on: give more motions between them", **level_texts
        )
    if level_texts["held"] == level_texts["passed"]:
        return lazy_gettext("it never happens below {held} and always above: ask for levels nearer to it, on both sides", **level_texts)
    return lazy_gettext("it never happens up to {held} and always from {passed} on: ask for levels between them", **level_texts)


def fit_lognormals(levels: FloatArray, exceeding: FloatArray, runs: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return medians and betas of several samples of counts at the same levels, NaN where no curve follows ([Baker2015]_ eq. (11)).

    Parameters
    ----------
    levels : (n,) array
    exceeding, runs : (b, n) arrays
    """
    x = np.log(levels)
    y, n = np.broadcast_arrays(exceeding, runs)
    medians, betas = np.full(len(y), np.nan), np.full(len(y), np.nan)
    good = ~is_separated(x, y, n)
    if good.any():
        b, a = fit_probit(np.column_stack([x, np.ones_like(x)]), y[good], n[good]).coefficients.T
        medians[good], betas[good] = _medians_from_logs(-a / b), 1.0 / b
    return medians, betas


def fit_lognormals_shared_beta(levels: FloatArray, exceeding: FloatArray, runs: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return medians, (b, k), and the one beta, (b,), of k limits that are fitted together, so that their curves do not cross.

    The counts of a limit that is only passed with the one before it are never larger, and with one slope the medians then rise from limit
    to limit. The likelihood takes the limits as if they were independent: the estimate is consistent, and its interval is the bootstrap's.

    Parameters
    ----------
    levels : (n,) array
    exceeding : (b, k, n) array
        How often each limit was passed.
    runs : (b, n) array
    """
    samples, limits, _ = exceeding.shape
    x = np.log(levels)
    limit_columns = np.repeat(np.eye(limits), x.size, axis=0)
    columns = np.column_stack([np.tile(x, limits), limit_columns])
    y, n = exceeding.reshape(samples, -1), np.tile(runs, (1, limits))
    # one limit that is not separated gives the slope
    all_separated = np.stack([is_separated(x, exceeding[:, k], runs) for k in range(limits)]).all(axis=0)
    empty = ((exceeding.sum(axis=2) == 0.0) | (exceeding == runs[:, None]).all(axis=2)).any(axis=1)
    good = ~(all_separated | empty)
    medians, betas = np.full((samples, limits), np.nan), np.full(samples, np.nan)
    if good.any():
        coefficients = fit_probit(columns, y[good], n[good], constants=limits).coefficients
        medians[good], betas[good] = _medians_from_logs(-coefficients[:, 1:] / coefficients[:, :1]), 1.0 / coefficients[:, 0]
    return medians, betas


def _medians_from_logs(logs: FloatArray) -> FloatArray:
    """Return medians from their logarithms; where there is hardly a slope they lie beyond all numbers, and are none."""
    return np.asarray(np.exp(np.where(np.abs(logs) < MAX_LOG_MEDIAN, logs, np.nan)))
