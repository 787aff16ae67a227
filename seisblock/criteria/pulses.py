"""Minimum overturning acceleration of half-sine, full-sine and rectangular pulses.

Half sine, full sine and rectangle by the linear equation, half sine also by the nonlinear one.
The ratios follow from the linear equation of slender blocks, theta'' = p^2 (theta - alpha + a/g): a pulse overturns the block without a
previous impact if the coefficient of the growing exponential after the pulse, alpha - theta - theta'/p, is negative (as in
[Housner1963]_; derived here, and verified with the solver). Size enters through X = a/(alpha g) and W = omega/p, so that each criterion
is one curve. The nonlinear equation has no closed form; its half-sine threshold is 4 to 5 % higher for a stone of 0.24 x 0.63 m.
"""

from __future__ import annotations

import math
import operator

from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.roots import bracketed_root
from seisblock.core.units import STANDARD_GRAVITY

SERIES_ORDER = 20
"""Terms of the Taylor series of a block under a half sine."""


def half_sine_ratio(w: float) -> float:
    """Return the minimum X = a/(alpha g) of a half-sine pulse that overturns a slender block (linear equation).

    Root of sqrt(X^2 - 1) + X exp(-(pi - asin(1/X))/W) = W, the exact solution of the problem of [Furukawa2009]_ eqs. (5) and (6):
    1.3224, 1.8007, 3.2891 at W = 1, 2, 5, where eq. (6) gives 1.414, 2.236, 5.099.

    Parameters
    ----------
    w : float
        W = omega/p, positive: ratio of the circular frequency of the sine to the frequency parameter.

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
    >>> from seisblock.criteria import half_sine_ratio
    >>> [round(half_sine_ratio(w), 4) for w in (1, 2, 5)]
    [1.3224, 1.8007, 3.2891]
    """
    return _root(checks.positive("W = omega/p", w), math.pi, 1.0)


def half_sine_acceleration(slenderness: float, frequency_parameter: float, frequency: float, gravity: float = STANDARD_GRAVITY) -> float:
    """Return the minimum amplitude, m/s^2, of a half-sine pulse that overturns a block (nonlinear equation).

    Nonlinear form of :func:`half_sine_ratio`: theta'' = p^2 (a/g cos(alpha - theta) - sin(alpha - theta)), starting at
    a = g tan(alpha). The block overturns if its energy after the pulse reaches the barrier, theta'^2/2 + p^2 cos(alpha - theta) = p^2
    (derived here).

    Parameters
    ----------
    slenderness : float, rad
        alpha, below pi/2.
    frequency_parameter : float, rad/s
        p.
    frequency : float, Hz
        Frequency of the sine.
    gravity : float, m/s^2

    Raises
    ------
    ParameterError
        If a parameter is not positive, or alpha is not below pi/2.

    References
    ----------
    [Housner1963]_

    Examples
    --------
    >>> slender = half_sine_acceleration(0.001, 2.0, 1.0, 9.8)
    >>> round(slender / (9.8 * 0.001 * half_sine_ratio(math.pi)), 5)
    1.0
    """
    alpha, p = checks.positive("the slenderness", slenderness), checks.positive("the frequency parameter", frequency_parameter)
    omega, g = 2 * math.pi * checks.positive("the frequency", frequency), checks.gravity(gravity)
    if alpha >= math.pi / 2:
        raise ParameterError("the slenderness must be below pi/2 rad, found {value}", value=alpha)

    def surplus(x: float) -> float:
        theta, speed = _end_of_half_sine(alpha, p, omega, x)
        if theta < 0.0:
            # back on its base: the equation holds for one corner, and its solution runs away to the other side
            return -2 * p * math.sin(alpha / 2)
        # same sign as the energy surplus while the angle increases, and smooth at the root; beyond half a turn it has long fallen
        return speed - 2 * p * math.sin((alpha - min(theta, alpha + math.pi)) / 2)

    # a pulse far longer than the block's time overturns it as soon as it rocks: no bracket is left above the threshold
    low = 1.0 + 1e-12
    if surplus(low) >= 0.0:
        return float(g * math.tan(alpha))
    # Housner's linear estimate as the upper end of the bracket, enlarged until the block overturns
    high = max(math.hypot(1.0, omega / p), 1.0 + 1e-9)
    while surplus(high) <= 0.0:
        high *= 1.5
    return g * math.tan(alpha) * bracketed_root(surplus, low, high, 1e-12 * high)


def _end_of_half_sine(alpha: float, p: float, omega: float, x: float) -> tuple[float, float]:
    """Return angle, rad, and angular velocity of a block at the end of a half sine of amplitude x g tan(alpha), by Taylor series.

    Coefficients of theta, sin(alpha - theta) and cos(alpha - theta) by recurrence from theta'' = p^2 (a/g cos(alpha - theta) -
    sin(alpha - theta)) (derived here).
    """
    # rocking starts where the sine reaches g tan(alpha)
    time, end = math.asin(1.0 / x) / omega, math.pi / omega
    theta, speed = 0.0, 0.0
    while time < end:
        angle, sine, cosine, pulse = [theta, speed], [math.sin(alpha - theta)], [math.cos(alpha - theta)], []
        amplitude = x * math.tan(alpha)
        for k in range(SERIES_ORDER - 1):
            pulse.append(amplitude * math.sin(omega * time + 0.5 * math.pi * k))
            amplitude *= omega / (k + 1)
            angle.append(p * p * (_product(pulse, cosine) - sine[k]) / ((k + 1) * (k + 2)))
            rates = [(j + 1) * angle[j + 1] for j in range(k + 1)]
            sine_next, cosine_next = -_product(rates, cosine) / (k + 1), _product(rates, sine) / (k + 1)
            sine.append(sine_next)
            cosine.append(cosine_next)
        step = end - time
        for k in (SERIES_ORDER - 1, SERIES_ORDER):
            if angle[k]:
                step = min(step, (1e-16 * alpha / abs(angle[k])) ** (1.0 / k))
        theta = speed = 0.0
        for k in range(SERIES_ORDER, -1, -1):
            speed = speed * step + theta
            theta = theta * step + angle[k]
        # a step shorter than the round-off of the time would not end
        time = end if time + step >= end or time + step == time else time + step
    return theta, speed


def _product(first: list[float], second: list[float]) -> float:
    """Return the highest coefficient of the product of two series of equal length."""
    return sum(map(operator.mul, first, reversed(second)))


def one_sine_ratio(w: float) -> float:
    """Return the minimum X of a full-sine pulse that overturns a block without impact ([Zhang2001]_ mode 2).

    Root of sqrt(X^2 - 1) - X exp(-(2 pi - asin(1/X))/W) = W. Below it, overturning after one impact is possible; there is no closed form
    for its range.

    Parameters
    ----------
    w : float
        W = omega/p, positive: ratio of the circular frequency of the sine to the frequency parameter.

    Returns
    -------
    float, 1

    Raises
    ------
    ParameterError
        If W is not positive.

    Examples
    --------
    >>> from seisblock.criteria import one_sine_ratio
    >>> round(one_sine_ratio(5), 5)
    7.16813
    """
    return _root(checks.positive("W = omega/p", w), 2 * math.pi, -1.0)


def rectangular_ratio(duration: float, frequency_parameter: float) -> float:
    """Return the minimum X = a/(alpha g) of a rectangular pulse that overturns a block, 1/(1 - exp(-p t)) (derived here).

    Parameters
    ----------
    duration : float, s
        t, positive.
    frequency_parameter : float, rad/s
        p, positive.

    Returns
    -------
    float, 1

    Raises
    ------
    ParameterError
        If a parameter is not positive.

    Examples
    --------
    >>> from seisblock.criteria import rectangular_ratio
    >>> round(rectangular_ratio(0.5, 2.0), 6)
    1.581977
    """
    p_t = checks.positive("the duration", duration) * checks.positive("the frequency parameter", frequency_parameter)
    # expm1: 1 - exp(-p t) would cancel for short pulses
    return -1.0 / math.expm1(-p_t)


def _root(w: float, end: float, sign: float) -> float:
    """Return the root X of sqrt(X^2 - 1) + sign X exp(-(end - asin(1/X))/W) = W (derived here)."""

    def surplus(x: float) -> float:
        return math.sqrt(x * x - 1.0) + sign * x * math.exp(-(end - math.asin(1.0 / x)) / w) - w

    # X = 1 never overturns; hypot(1, W) is Housner's estimate, an upper bound for the half sine
    low = 1.0
    high = math.hypot(1.0, w)
    while surplus(high) <= 0.0:
        low, high = high, 2.0 * high
    return bracketed_root(surplus, low, high, 1e-14 * high)
