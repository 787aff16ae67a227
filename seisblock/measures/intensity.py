"""Arias intensity, significant duration and class of the JMA seismic intensity."""

from __future__ import annotations

import math

import numpy as np

from seisblock.core import checks
from seisblock.core.i18n import N_
from seisblock.core.limits import CHUNK_SIZE
from seisblock.core.typing import FloatArray
from seisblock.core.units import STANDARD_GRAVITY

_HALF_CLASSES = ((5.0, N_("5-")), (5.5, N_("5+")), (6.0, N_("6-")), (6.5, N_("6+")))
_CLASSES = ((0.5, "0"), (1.5, "1"), (2.5, "2"), (3.5, "3"), (4.5, "4"), *_HALF_CLASSES)
"""Upper bounds of the classes of [JMA1996]_; the class above the last bound is 7."""


def cumulative_absolute_velocity(acceleration: FloatArray, dt: float) -> float:
    """Return the cumulative absolute velocity (CAV): the integral of the absolute acceleration.

    Exact for linear interpolation between samples.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration.
    dt : float, s
        Sampling interval.

    Returns
    -------
    float, m/s

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.measures import cumulative_absolute_velocity
    >>> round(cumulative_absolute_velocity(np.array([0.0, 2.0, -2.0, 0.0]), 0.1), 3)
    0.3
    """
    first, second = acceleration[:-1], acceleration[1:]
    sizes = np.abs(first) + np.abs(second)
    # between samples of opposite sign the line crosses zero: two triangles instead of a trapezium
    crosses = first * second < 0.0
    area = 0.5 * sizes
    area[crosses] = 0.5 * (first[crosses] ** 2 + second[crosses] ** 2) / sizes[crosses]
    return float(area.sum() * dt)


def arias_intensity(acceleration: FloatArray, dt: float, *, gravity: float = STANDARD_GRAVITY) -> float:
    """Return the Arias intensity, pi / (2 g) times the integral of the squared acceleration ([Arias1970]_).

    Exact for linear interpolation between samples.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration.
    dt : float, s
        Sampling interval.
    gravity : float, m/s^2

    Returns
    -------
    float, m/s

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.measures import arias_intensity
    >>> sine = np.sin(2.0 * np.pi * np.arange(1001) * 0.01)
    >>> round(arias_intensity(sine, 0.01), 3)
    0.8
    """
    return math.pi / (2.0 * gravity) * float(_square_integrals(acceleration, dt).sum())


def significant_duration(acceleration: FloatArray, dt: float, *, fractions: tuple[float, float] = (0.05, 0.95)) -> float:
    """Return the time between two fractions of the Arias intensity, 5 and 95 % by default ([TrifunacBrady1975]_).

    The integral of the squared piecewise linear acceleration is a cubic in time, inverted in closed form: the result does not depend on
    the positions of the samples.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration.
    dt : float, s
        Sampling interval.
    fractions : two floats
        Fractions between 0 and 1.

    Returns
    -------
    float, s
        0 if all samples are zero.

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.measures import significant_duration
    >>> sine = np.sin(2.0 * np.pi * np.arange(1001) * 0.01)
    >>> round(significant_duration(sine, 0.01), 2)
    9.0
    """
    cumulative = np.zeros(acceleration.size)
    cumulative[1:] = _square_integrals(acceleration, dt)
    np.cumsum(cumulative[1:], out=cumulative[1:])
    total = float(cumulative[-1])
    if total == 0.0:
        return 0.0
    start, end = (_time_of_energy(acceleration, dt, cumulative, fraction * total) for fraction in fractions)
    return end - start


def reported_intensity(intensity: float) -> float:
    """Return the instrumental intensity with the one decimal that JMA reports: rounded to two decimals, truncated to one.

    Examples
    --------
    >>> [reported_intensity(i) for i in (5.46, 5.494, 5.497)]
    [5.4, 5.4, 5.5]
    """
    checks.finite("the intensity", intensity)
    # the inner rounding to 6 digits removes the round-off of the multiplication before the floor
    return math.floor(round(round(intensity, 2) * 10, 6)) / 10


def jma_class(intensity: float) -> str:
    """Return the JMA seismic intensity class, ``0`` to ``4``, ``5-``, ``5+``, ``6-``, ``6+`` or ``7`` ([JMA1996]_).

    It is that of :func:`reported_intensity`.

    Parameters
    ----------
    intensity : float, 1
        Instrumental intensity.

    Returns
    -------
    str

    Examples
    --------
    >>> from seisblock.measures import jma_class
    >>> [jma_class(i) for i in (-1.0, 4.494, 4.497, 5.1, 7.2)]
    ['0', '4', '5-', '5+', '7']
    """
    reported = reported_intensity(intensity)
    return next((name for bound, name in _CLASSES if reported < bound), "7")


def _square_integrals(acceleration: FloatArray, dt: float) -> FloatArray:
    """Return the integral of the squared linear acceleration over each sample interval, (n - 1,), m^2/s^3."""
    integrals = np.empty(acceleration.size - 1)
    # integral of the squared line from a to b: dt (a^2 + a b + b^2)/3
    for begin in range(0, integrals.size, CHUNK_SIZE):
        a, b = acceleration[begin : begin + CHUNK_SIZE], acceleration[begin + 1 : begin + 1 + CHUNK_SIZE]
        a = a[: b.size]
        integrals[begin : begin + CHUNK_SIZE] = dt / 3.0 * (a * a + a * b + b * b)
    return integrals


def _time_of_energy(acceleration: FloatArray, dt: float, cumulative: FloatArray, energy: float) -> float:
    """Return the time at which the cumulative integral of the square reaches a value, s."""
    interval = min(int(np.searchsorted(cumulative, energy, side="left")), acceleration.size - 1) - 1
    if interval < 0:
        return 0.0
    a, b = float(acceleration[interval]), float(acceleration[interval + 1])
    remaining, interval_energy = energy - float(cumulative[interval]), float(cumulative[interval + 1] - cumulative[interval])
    slope = (b - a) / dt
    # solve ((a + slope t)^3 - a^3) / (3 slope) = remaining; for a nearly constant acceleration the cube root would cancel
    if abs(b - a) <= 1e-6 * max(abs(a), abs(b)):
        return dt * (interval + remaining / interval_energy)
    return dt * interval + (math.cbrt(a**3 + 3.0 * slope * remaining) - a) / slope
