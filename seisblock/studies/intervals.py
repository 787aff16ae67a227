"""Binomial confidence intervals of a share, and the effective size of a weighted sample.

Quantiles are those of :mod:`scipy.special`: `scipy.stats`, which has the interval, takes half a second to load and a thousand times as
long per call.
"""

from __future__ import annotations

from collections.abc import Sequence

from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.typing import FloatArray

CONFIDENCE = 0.95
"""Default confidence level."""


def clopper_pearson(count: int, runs: int, confidence: float = CONFIDENCE) -> tuple[float, float]:
    """Return the exact binomial interval of a share.

    Parameters
    ----------
    count, runs : int
        0 <= count <= runs, at least one run.
    confidence : float, 1
        Level, between 0 and 1.

    Raises
    ------
    ParameterError
        If a count or the level is out of range.

    Examples
    --------
    >>> low, high = clopper_pearson(35, 100)
    >>> round(low, 4), round(high, 4)
    (0.2573, 0.4518)
    """
    tail = (1.0 - _check_counts(count, runs, confidence)) / 2.0
    # without an import of 0.2 s in the commonest cases
    if count in (0, runs):
        return (tail ** (1.0 / runs), 1.0) if count else (0.0, 1.0 - tail ** (1.0 / runs))
    from scipy.special import betaincinv

    return float(betaincinv(count, runs - count + 1, tail)), float(betaincinv(count + 1, runs - count, 1.0 - tail))


def clustered_interval(counts: Sequence[int], runs: Sequence[int]) -> tuple[float, float]:
    """Return the binomial interval of a share of runs that come in groups, such as several versions under each record.

    The exact interval for the effective number of runs, the variance of a binomial share over that between the groups
    ([KornGraubard1998]_ method); with shares of 0 and 1 each group counts at most once.

    Parameters
    ----------
    counts, runs : sequences of int
        Of each group; groups without runs are left out.

    Raises
    ------
    ParameterError
        If there is no run.

    Examples
    --------
    >>> low, high = clustered_interval([0, 4, 0, 4, 0, 4, 0, 4, 4, 4], [4] * 10)
    >>> round(low, 3), round(high, 3)
    (0.208, 0.913)
    """
    from scipy.special import betaincinv, stdtrit

    total, groups = sum(runs), sum(run > 0 for run in runs)
    count = sum(counts)
    tail = (1.0 - _check_counts(count, total, CONFIDENCE)) / 2.0
    share = count / total
    # ratio estimator: groups may differ in size when runs were stopped
    squares = sum((k - share * n) ** 2 for k, n in zip(counts, runs, strict=True))
    variance = squares / total**2 * groups / max(groups - 1, 1)
    effective = float(groups)
    if 0 < count < total and variance > 0.0 and groups > 1:
        effective = share * (1.0 - share) / variance
        effective *= (float(stdtrit(total - 1, tail)) / float(stdtrit(groups - 1, tail))) ** 2
    effective = min(max(effective, 1.0), float(total))
    x = share * effective
    low = float(betaincinv(x, effective - x + 1.0, tail)) if count else 0.0
    high = float(betaincinv(x + 1.0, effective - x, 1.0 - tail)) if count < total else 1.0
    return low, high


def _check_counts(count: int, runs: int, confidence: float) -> float:
    """Return the confidence level after a check of counts and level."""
    if not (0 <= count <= runs and runs > 0):
        raise ParameterError(
            "an interval requires 0 <= `count` <= `runs` and at least one run, found {count} of {runs}", count=count, runs=runs
        )
    return checks.in_interval("the confidence", confidence, "(0, 1)")


def effective_sample_size(weights: FloatArray) -> float:
    """Return the effective sample size of some weights (Kish: squared sum over sum of squares); 0 if all are 0."""
    return float(weights.sum() ** 2 / max(float((weights**2).sum()), 1e-300))
