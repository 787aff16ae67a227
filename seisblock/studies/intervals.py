"""Binomial confidence intervals of a share.

Quantiles are those of :mod:`scipy.special`: `scipy.stats`, which has both intervals, takes half a second to load and a thousand times as
long per call.
"""

from __future__ import annotations

import math

from seisblock.core import checks
from seisblock.core.errors import ParameterError

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
    from scipy.special import betaincinv

    tail = (1.0 - _check_counts(count, runs, confidence)) / 2.0
    low = float(betaincinv(count, runs - count + 1, tail)) if count else 0.0
    high = float(betaincinv(count + 1, runs - count, 1.0 - tail)) if count < runs else 1.0
    return low, high


def wilson_interval(count: int, runs: int, confidence: float = CONFIDENCE) -> tuple[float, float]:
    """Return Wilson's score interval of a share; parameters and errors as for :func:`clopper_pearson`.

    Examples
    --------
    >>> low, high = wilson_interval(35, 100)
    >>> round(low, 4), round(high, 4)
    (0.2636, 0.4475)
    """
    from scipy.special import ndtri

    z = float(ndtri(0.5 + _check_counts(count, runs, confidence) / 2))
    share = count / runs
    middle = (share + z * z / (2 * runs)) / (1 + z * z / runs)
    half = z / (1 + z * z / runs) * math.sqrt(share * (1 - share) / runs + z * z / (4 * runs * runs))
    # exact ends for counts of zero and of all, free of round-off
    return max(middle - half, 0.0) if count else 0.0, min(middle + half, 1.0) if count < runs else 1.0


def _check_counts(count: int, runs: int, confidence: float) -> float:
    """Return the confidence level after a check of counts and level."""
    if not (0 <= count <= runs and runs > 0):
        raise ParameterError(
            "an interval requires 0 <= `count` <= `runs` and at least one run, found {count} of {runs}", count=count, runs=runs
        )
    return checks.in_interval("the confidence", confidence, "(0, 1)")
