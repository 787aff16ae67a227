"""Pulses that just overturn a slender block, exactly: half sine, one sine, rectangle.

All follow from the linear equation theta'' = p^2 (theta - alpha + a/g): a pulse overturns, without an impact before, when the growing part
of what it leaves behind, alpha - theta - theta'/p, is negative ([Housner1963]_; derived again, and checked against the solver). Sizes
enter through X = a/(alpha g) and W = omega/p, so that each criterion is one curve.
"""

from __future__ import annotations

import math

from seisblock import checks


def half_sine_ratio(w: float) -> float:
    """Return the least X = a/(alpha g) of a half-sine pulse that overturns.

    The root of sqrt(X^2 - 1) + X exp(-(pi - asin(1/X))/W) = W. It is what [Furukawa2009]_ eq. (5) is meant to give and eq. (6) does not:
    1.3224, 1.8007, 3.2891 at W = 1, 2, 5, where (6) gives 1.414, 2.236, 5.099.

    Parameters
    ----------
    w : float
        W = omega/p, positive: circular frequency of the sine over the frequency parameter of the block.

    Returns
    -------
    float
        X, above 1.

    Raises
    ------
    ParameterError
        If W is not positive.

    References
    ----------
    [Housner1963]_, [Zhang2001]_

    Examples
    --------
    >>> [round(half_sine_ratio(w), 4) for w in (1, 2, 5)]
    [1.3224, 1.8007, 3.2891]
    """
    return _root(checks.positive("W = omega/p", w), math.pi, 1.0)


def one_sine_ratio(w: float) -> float:
    """Return the X of a full sine pulse above which the block overturns without any impact ([Zhang2001]_ mode 2).

    The root of sqrt(X^2 - 1) - X exp(-(2 pi - asin(1/X))/W) = W. Below it, after one impact, there may be another window of overturning
    that no closed form bounds.

    Parameters
    ----------
    w : float
        W = omega/p, positive.

    Raises
    ------
    ParameterError
        If W is not positive.

    Examples
    --------
    >>> round(one_sine_ratio(5), 5)
    7.16813
    """
    return _root(checks.positive("W = omega/p", w), 2 * math.pi, -1.0)


def rectangular_ratio(duration: float, frequency_parameter: float) -> float:
    """Return the X = a/(alpha g) of a rectangular pulse that just overturns, 1/(1 - exp(-p t)) ([Housner1963]_).

    Parameters
    ----------
    duration : float, s
        t, positive.
    frequency_parameter : float, rad/s
        p, positive.

    Raises
    ------
    ParameterError
        If one is not positive.

    Examples
    --------
    >>> round(rectangular_ratio(0.5, 2.0), 6)
    1.581977
    """
    p_t = checks.positive("the duration", duration) * checks.positive("the frequency parameter", frequency_parameter)
    return -1.0 / math.expm1(-p_t)


def _root(w: float, end: float, sign: float) -> float:
    """Return the root X of sqrt(X^2 - 1) + sign X exp(-(end - asin(1/X))/W) = W."""
    from scipy.optimize import brentq

    def surplus(x: float) -> float:
        return math.sqrt(x * x - 1.0) + sign * x * math.exp(-(end - math.asin(1.0 / x)) / w) - w

    low = 1.0
    high = math.hypot(1.0, w)
    while surplus(high) <= 0.0:
        low, high = high, 2.0 * high
    return float(brentq(surplus, low, high, xtol=1e-14, rtol=1e-14))
