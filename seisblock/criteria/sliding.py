"""Closed forms of sliding: when an object starts to slip, whether it stops again, and how far it goes in two simple motions."""

from __future__ import annotations

import math

import numpy as np

from seisblock.core import checks
from seisblock.core.typing import ArrayLike, FloatArray
from seisblock.core.units import STANDARD_GRAVITY


def slip_acceleration(mu: float, *, vertical: ArrayLike = 0.0, gravity: float = STANDARD_GRAVITY) -> FloatArray:
    """Return the horizontal ground acceleration beyond which an object on a level base slips ([Fujino1978]_ eqs. (1), (5)).

    Parameters
    ----------
    mu : float
        Static friction coefficient.
    vertical : array, m/s^2
        Vertical ground acceleration, upwards positive.
    gravity : float, m/s^2

    Returns
    -------
    array, m/s^2
        mu (g + y''); at equality it still sticks. Zero where the base falls away (y'' < -g).

    References
    ----------
    [Fujino1978]_ eqs. (1), (5); (1) prints <= and (5) <: equality sticks here.

    Examples
    --------
    >>> round(float(slip_acceleration(0.2, gravity=9.8)), 3)
    1.96
    """
    return np.asarray(mu * np.maximum(gravity + np.asarray(vertical, dtype=np.float64), 0.0))


def slip_limits(
    slope_deg: float, mu: float, *, normal: ArrayLike = 0.0, gravity: float = STANDARD_GRAVITY
) -> tuple[FloatArray, FloatArray]:
    """Return the accelerations along a slope between which static friction holds ([Fujino1978]_ eqs. (9), (10)).

    Parameters
    ----------
    slope_deg : float, degrees
        Positive falls towards the positive direction.
    mu : float
        Static friction coefficient.
    normal : array, m/s^2
        Ground acceleration normal to the slope, outwards positive.
    gravity : float, m/s^2

    Returns
    -------
    downhill, uphill : arrays, m/s^2
        Ground acceleration along the slope (downhill positive) below which the object slips downhill, eq. (10), and above which it
        slips uphill, eq. (9).

    References
    ----------
    [Fujino1978]_ eqs. (9), (10)

    Examples
    --------
    >>> downhill, uphill = slip_limits(0.0, 0.2, gravity=9.8)
    >>> round(float(downhill), 3), round(float(uphill), 3)
    (-1.96, 1.96)
    """
    angle = math.radians(slope_deg)
    friction = mu * (gravity * math.cos(angle) + np.asarray(normal, dtype=np.float64))
    pull = gravity * math.sin(angle)
    return pull - friction, pull + friction


def min_friction_to_stop(slope_deg: float, kappa: float) -> float:
    """Return the static friction at or below which an object once in motion slides down a slope for ever ([Fujino1978]_ eq. (14)).

    Parameters
    ----------
    slope_deg : float, degrees
    kappa : float
        Kinetic over static friction, positive.

    Returns
    -------
    float
        tan(th) / kappa; the object holds at rest only where mu >= tan(th).

    References
    ----------
    [Fujino1978]_ eq. (14)

    Examples
    --------
    >>> round(min_friction_to_stop(20.0, 0.5), 4)
    0.7279
    """
    checks.positive("kappa, kinetic over static friction,", kappa)
    return math.tan(math.radians(slope_deg)) / kappa


def min_friction_to_hold(slope_deg: float, horizontal: ArrayLike, vertical: ArrayLike = 0.0) -> FloatArray:
    """Return the static friction below which ground acceleration sets an object in motion down a slope ([Fujino1978]_ eq. (15)).

    Parameters
    ----------
    slope_deg : float, degrees
    horizontal : array
        Horizontal ground acceleration over gravity, the paper's alpha, positive in the direction that points downhill.
    vertical : array
        Vertical ground acceleration over gravity, upwards positive: the paper's alpha times mu.

    Returns
    -------
    array
        tan(th - atan(alpha / (1 + alpha mu))), identical to eq. (15) as printed; the largest value along a record decides.

    References
    ----------
    [Fujino1978]_ eq. (15); the text calls for the smallest left side where it should say the largest right side.

    Examples
    --------
    >>> round(float(min_friction_to_hold(20.0, -0.2)), 4)
    0.6082
    """
    alpha, up = np.asarray(horizontal, dtype=np.float64), np.asarray(vertical, dtype=np.float64)
    return np.asarray(np.tan(math.radians(slope_deg) - np.arctan(alpha / (1.0 + up))))


def pulse_slip(acceleration: float, duration: float, yield_acceleration: float) -> float:
    """Return the one-way slip under a rectangular pulse of ground acceleration ([Newmark1965]_).

    Parameters
    ----------
    acceleration : float, m/s^2
        Height of the pulse, against the direction of slip.
    duration : float, s
    yield_acceleration : float, m/s^2
        Acceleration at which the object slips, mu g on a level base; kinetic equals static friction.

    Returns
    -------
    float, m
        V^2 / (2 a_y) (1 - a_y / a) with V = a T; zero when the pulse does not exceed a_y.

    References
    ----------
    [Newmark1965]_

    Examples
    --------
    >>> round(pulse_slip(4.0, 1.0, 1.96133), 6)
    2.078865
    """
    checks.positive("the yield acceleration", yield_acceleration, "m/s^2")
    checks.non_negative("the duration", duration, "s")
    excess = max(acceleration - yield_acceleration, 0.0)
    return acceleration * excess * duration**2 / (2.0 * yield_acceleration)


def steady_slip(amplitude: float, frequency: float, mu: float, *, kappa: float = 1.0, gravity: float = STANDARD_GRAVITY) -> float | None:
    """Return the slip per half cycle of what slides without rest on a base in harmonic motion ([WestermoUdwadia1983]_ steady sliding).

    Parameters
    ----------
    amplitude : float, m/s^2
        Peak ground acceleration.
    frequency : float, Hz
    mu : float
        Static friction coefficient.
    kappa : float
        Kinetic over static friction.
    gravity : float, m/s^2

    Returns
    -------
    float or None, m
        Distance between the two turning points of the relative displacement, 2 (A/w^2) sqrt(1 - (pi mu_k g / 2 A)^2); None when
        the object sticks in each half cycle: with kappa = 1 that is where mu g / A > (1 + pi^2/4)^(-1/2) = 0.5370.

    Notes
    -----
    In steady sliding the object's velocity is a triangle of slope mu_k g, antisymmetric in half a period. The relative velocity
    vanishes where the ground's acceleration is A sqrt(1 - (pi mu_k g / 2 A)^2); if that exceeds mu g, it turns without a rest.

    References
    ----------
    [WestermoUdwadia1983]_

    Examples
    --------
    >>> round(steady_slip(4.0, 1.0, 0.1), 5)
    0.18701
    >>> steady_slip(4.0, 1.0, 0.25) is None
    True
    """
    checks.positive("the amplitude", amplitude, "m/s^2")
    checks.positive("the frequency", frequency, "Hz")
    remainder = 1.0 - (math.pi * kappa * mu * gravity / (2.0 * amplitude)) ** 2
    if remainder < 0.0 or math.sqrt(remainder) * amplitude < mu * gravity:
        return None
    return 2.0 * amplitude / (2.0 * math.pi * frequency) ** 2 * math.sqrt(remainder)
