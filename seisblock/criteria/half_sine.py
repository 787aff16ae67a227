"""The rigid block under one half-sine pulse: the exact threshold that Housner's formula stands for ([Housner1963]_).

Slender block (linear equation), pulse a sin(omega t) from rest. It overturns when at the pulse's end it moves beyond the separatrix
theta + theta'/p = alpha of free motion.
"""

from __future__ import annotations

import numpy as np

from seisblock.criteria.gravestones import _checked
from seisblock.typing import ArrayLike, FloatArray
from seisblock.units import STANDARD_GRAVITY

BISECTIONS = 60
"""Halvings of the bracket: the last one is below the last bit."""


def half_sine_factor(frequency_ratio: ArrayLike) -> FloatArray:
    """Return X, the least amplitude of a half-sine pulse that overturns over that which starts rocking ([Housner1963]_).

    Parameters
    ----------
    frequency_ratio : array
        W = omega/p, circular frequency of the pulse over the block's frequency parameter; zero or more.

    Returns
    -------
    array
        At least 1.

    Raises
    ------
    ParameterError
        If a ratio is negative.

    Notes
    -----
    Root of sqrt(X^2 - 1) + X exp(-(pi - asin(1/X))/W) = W. Differs from [Furukawa2009]_ eq. (6), sqrt(1 + W^2), which asks that theta
    reaches alpha when the pulse ends, and is a bound from above.

    Examples
    --------
    >>> half_sine_factor([1.0, 2.0, 5.0]).round(4)
    array([1.3224, 1.8007, 3.2891])
    """
    w = _checked(frequency_ratio, "frequency ratio omega/p", "1", zero=True)
    low, high = np.ones_like(w), np.sqrt(1.0 + w * w)
    with np.errstate(divide="ignore"):
        for _ in range(BISECTIONS):
            x = 0.5 * (low + high)
            above = np.sqrt(x * x - 1.0) + x * np.exp(-(np.pi - np.arcsin(1.0 / x)) / w) > w
            low, high = np.where(above, low, x), np.where(above, x, high)
    return 0.5 * (low + high)


def half_sine_pga(ratio: ArrayLike, width: ArrayLike, frequency: ArrayLike, *, gravity: float = STANDARD_GRAVITY) -> FloatArray:
    """Return the least amplitude of a half-sine pulse that overturns a rectangular block, X g B/H ([Housner1963]_).

    At zero frequency it is the static criterion of [Furukawa2009]_ eq. (2).

    Parameters
    ----------
    ratio : array
        H/B, positive.
    width : array, m
        B, positive.
    frequency : array, Hz
        Of the sine to which the half belongs.
    gravity : float, m/s^2

    Returns
    -------
    array, m/s^2

    Raises
    ------
    ParameterError
        If a size is not positive or a frequency negative.

    Examples
    --------
    >>> half_sine_pga(2.6, 0.2424, [0.0, 1.0, 3.0]).round(3)
    array([ 3.772,  5.599, 10.599])
    """
    slender, b = _checked(ratio, "height over width", "1"), _checked(width, "width", "m")
    radius = 0.5 * b * np.sqrt(1.0 + slender**2)
    p = np.sqrt(3.0 * gravity / (4.0 * radius))
    omega = 2.0 * np.pi * _checked(frequency, "frequency", "Hz", zero=True)
    return half_sine_factor(omega / p) * gravity / slender
