"""Lognormal fit of a fragility curve: maximum likelihood from counts at levels."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import Message, lazy_gettext
from seisblock.core.typing import ArrayLike, FloatArray
from seisblock.studies.fragility.probit import fit_probit, is_separated

NOT_INCREASING = lazy_gettext(
    "exceedances do not increase with the level: no fragility curve; use more records, or another intensity measure"
)
"""Reason against a curve from counts that do not rise with the level."""

MAX_LOG_MEDIAN = 100.0
"""Logarithm of a median above which there is no curve."""


@dataclass(frozen=True, repr=False)
class Lognormal(DisplayMixin):
    """Probability that rises with the intensity x as Phi(ln(x/median)/beta) ([Baker2015]_ eq. (1)).

    Parameters
    ----------
    median : float, in `unit` of the intensity
        Intensity of probability one half.
    beta : float, 1
        Standard deviation of the logarithm of the capacity.

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
        """Return the probability at given intensities, of their shape; zero at and below zero."""
        from scipy.special import ndtr

        x = checks.float_array("the intensities", intensity)
        # ln 0 is minus infinity, and the probability zero
        with np.errstate(divide="ignore"):
            return np.asarray(ndtr(np.log(np.maximum(x, 0.0) / self.median) / self.beta))

    def quantile(self, probability: float) -> float:
        """Return the intensity of a probability between 0 and 1."""
        from scipy.special import ndtri

        share = checks.in_interval("the probability", probability, "(0, 1)")
        return self.median * math.exp(self.beta * float(ndtri(share)))


def fit_fragility(levels: ArrayLike, exceeding: ArrayLike, runs: ArrayLike) -> Lognormal:
    """Return the maximum-likelihood lognormal curve of counts at some levels ([Baker2015]_ eq. (11)).

    Parameters
    ----------
    levels : (n,) array, in `unit`
        Positive intensities; the median has the same unit.
    exceeding, runs : (n,) arrays, 1
        Exceedances and runs at each level; one number of runs may serve all levels.

    Returns
    -------
    Lognormal

    Raises
    ------
    ParameterError
        If the numbers are inconsistent, or no curve follows; the message names levels that would help.

    Notes
    -----
    The counts are binomial with Phi(ln(x/median)/beta), which is probit regression on ln x: Phi(a + b ln x) with b = 1/beta and
    median = exp(-a/b) ([Baker2015]_ eq. (11)).

    Examples
    --------
    >>> from seisblock.fragility import fit_fragility
    >>> curve = fit_fragility([1.0, 2.0, 4.0, 8.0], [0, 3, 7, 10], 10)
    >>> round(curve.median, 3), round(curve.beta, 3)
    (2.828, 0.477)
    """
    # texts, lists and arrays are accepted alike; errors name the argument
    x, y, n = (checks.float_array(name, values) for name, values in _labelled_inputs(levels, exceeding, runs))
    if x.ndim != 1 or x.size < 2 or y.shape != x.shape or n.size not in (1, x.size):
        raise ParameterError(
            "a fragility requires at least two levels and as many counts; found {levels} levels and {counts} counts",
            levels=x.size,
            counts=y.size,
        )
    n = np.broadcast_to(n, x.shape)
    if not (np.isfinite(x).all() and (x > 0.0).all()):
        raise ParameterError("the levels of a fragility must be positive numbers")
    if not ((y >= 0.0) & (y <= n) & (n > 0.0) & np.isfinite(n)).all():
        raise ParameterError("counts of a fragility must lie between 0 and the number of runs, which must be positive")
    # complete separation has no finite maximum of the likelihood: the message names levels that would give one
    reason = no_curve_reason(x, y, n)
    if reason:
        raise ParameterError("{why}", why=reason)
    medians, betas = fit_lognormals(x, y[None], n[None])
    # a falling trend has a negative slope, for which no lognormal curve exists
    if not math.isfinite(float(medians[0])):
        raise ParameterError("{why}", why=NOT_INCREASING)
    return Lognormal(float(medians[0]), float(betas[0]))


def _labelled_inputs(levels: ArrayLike, exceeding: ArrayLike, runs: ArrayLike) -> tuple[tuple[str, ArrayLike], ...]:
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
    """Return the reason against a curve from counts, with levels that would help; None if there is a curve.

    Parameters
    ----------
    levels, exceeding, runs : (n,) arrays
    display_unit : (float, str)
        Display unit of the levels, in their own, and its name.
    is_scaled : bool
        True for scaled motions, for which other levels may be chosen.
    first : bool
        True for levels of first exceedance of each motion: two different ones are enough.
    """
    # a curve needs exceedances as well as survivors
    has_exceedance, has_survivor = exceeding > 0.0, exceeding < runs
    size, unit = display_unit
    ends = {"low": levels.min(), "top": levels.max()}
    if has_exceedance.any() and has_survivor.any():
        ends |= {"held": levels[has_survivor].max(), "passed": levels[has_exceedance].min()}
    level_texts = {name: f"{value / size:.4g} {unit}".strip() for name, value in ends.items()}
    if not has_exceedance.any():
        if not is_scaled:
            return lazy_gettext(
                "limit not exceeded by any motion up to {top}; add stronger motions, or scale them (stripes)", **level_texts
            )
        return lazy_gettext("limit not exceeded at any level up to {top}; use higher levels", **level_texts)
    if not has_survivor.any():
        if not is_scaled:
            return lazy_gettext("limit exceeded by all motions from {low}; add weaker motions, or scale them (stripes)", **level_texts)
        return lazy_gettext("limit exceeded by all runs at all levels from {low}; use lower levels", **level_texts)
    if not is_separated(np.log(levels), exceeding[None], runs[None])[0] or (first and ends["held"] >= ends["passed"]):
        return None
    if not is_scaled:
        return lazy_gettext(
            "limit not exceeded by any motion up to {held}, exceeded by all from {passed}; add motions between them", **level_texts
        )
    if level_texts["held"] == level_texts["passed"]:
        return lazy_gettext(
            "limit never exceeded below {held}, always exceeded above; add levels just below and just above this value", **level_texts
        )
    return lazy_gettext("limit never exceeded up to {held}, always exceeded from {passed}; add levels between them", **level_texts)


def fit_lognormals(levels: FloatArray, exceeding: FloatArray, runs: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return medians and betas of samples of counts at the same levels, NaN without a curve ([Baker2015]_ eq. (11)).

    Parameters
    ----------
    levels : (n,) array
    exceeding, runs : (b, n) arrays
    """
    x = np.log(levels)
    y, n = np.broadcast_arrays(exceeding, runs)
    medians, betas = np.full(len(y), np.nan), np.full(len(y), np.nan)
    # separated counts have no finite maximum
    good = ~is_separated(x, y, n)
    if good.any():
        # probit a + b ln x: median exp(-a/b), beta 1/b
        b, a = fit_probit(np.column_stack([x, np.ones_like(x)]), y[good], n[good]).coefficients.T
        medians[good], betas[good] = _medians_from_logs(-a / b), 1.0 / b
    return medians, betas


def fit_lognormals_shared_beta(levels: FloatArray, exceeding: FloatArray, runs: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return medians, (b, k), and the common beta, (b,), of k limits fitted together, so that their curves do not cross.

    Counts of a limit that implies the one before are never larger, and with one slope the medians then rise from limit to limit. The
    likelihood treats the limits as independent: the estimate is consistent, and its interval is that of the bootstrap.

    Parameters
    ----------
    levels : (n,) array
    exceeding : (b, k, n) array
        Exceedances of each limit.
    runs : (b, n) array
    """
    samples, limits, _ = exceeding.shape
    x = np.log(levels)
    limit_columns = np.repeat(np.eye(limits), x.size, axis=0)
    columns = np.column_stack([np.tile(x, limits), limit_columns])
    y, n = exceeding.reshape(samples, -1), np.tile(runs, (1, limits))
    # one unseparated limit determines the slope
    all_separated = np.stack([is_separated(x, exceeding[:, k], runs) for k in range(limits)]).all(axis=0)
    # a limit never or always exceeded has no median, whatever the common slope
    empty = ((exceeding.sum(axis=2) == 0.0) | (exceeding == runs[:, None]).all(axis=2)).any(axis=1)
    good = ~(all_separated | empty)
    medians, betas = np.full((samples, limits), np.nan), np.full(samples, np.nan)
    if good.any():
        coefficients = fit_probit(columns, y[good], n[good], constants=limits).coefficients
        medians[good], betas[good] = _medians_from_logs(-coefficients[:, 1:] / coefficients[:, :1]), 1.0 / coefficients[:, 0]
    return medians, betas


def _medians_from_logs(logs: FloatArray) -> FloatArray:
    """Return medians from their logarithms; NaN beyond ``MAX_LOG_MEDIAN``, where the slope is near zero."""
    return np.asarray(np.exp(np.where(np.abs(logs) < MAX_LOG_MEDIAN, logs, np.nan)))
