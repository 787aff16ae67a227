"""Closed forms of sliding: slip threshold, arrest on a slope, slip under a rectangular pulse and under harmonic motion."""

from __future__ import annotations

import math

import numpy as np

from seisblock.core import checks
from seisblock.core.typing import ArrayLike, FloatArray
from seisblock.core.units import STANDARD_GRAVITY


def slip_acceleration(mu: float, *, vertical: ArrayLike = 0.0, gravity: float = STANDARD_GRAVITY) -> FloatArray:
    """Return the sliding threshold of an object on a level base ([Fujino1978]_ eqs. (1), (5)).

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
        Horizontal ground acceleration mu (g + y''); the object sticks at equality. Zero if the base loses contact (y'' < -g).

    References
    ----------
    [Fujino1978]_ eqs. (1), (5); (1) is printed with <= and (5) with <: equality means sticking here.

    Examples
    --------
    >>> from seisblock.criteria import slip_acceleration
    >>> round(float(slip_acceleration(0.2, gravity=9.8)), 3)
    1.96
    """
    return np.asarray(mu * np.maximum(gravity + np.asarray(vertical, dtype=np.float64), 0.0))


def slip_limits(
    slope_deg: float, mu: float, *, normal: ArrayLike = 0.0, gravity: float = STANDARD_GRAVITY
) -> tuple[FloatArray, FloatArray]:
    """Return the sliding thresholds on a slope, downhill and uphill ([Fujino1978]_ eqs. (9), (10)).

    Parameters
    ----------
    slope_deg : float, degrees
        Slope, positive if it descends in the positive direction.
    mu : float
        Static friction coefficient.
    normal : array, m/s^2
        Ground acceleration normal to the slope, outwards positive.
    gravity : float, m/s^2

    Returns
    -------
    downhill, uphill : arrays, m/s^2
        Ground acceleration along the slope (downhill positive): below the first limit the object slips downhill, eq. (10), above the
        second one uphill, eq. (9).

    References
    ----------
    [Fujino1978]_ eqs. (9), (10)

    Examples
    --------
    >>> from seisblock.criteria import slip_limits
    >>> downhill, uphill = slip_limits(0.0, 0.2, gravity=9.8)
    >>> round(float(downhill), 3), round(float(uphill), 3)
    (-1.96, 1.96)
    """
    angle = math.radians(slope_deg)
    friction = mu * (gravity * math.cos(angle) + np.asarray(normal, dtype=np.float64))
    pull = gravity * math.sin(angle)
    return pull - friction, pull + friction


def min_friction_to_stop(slope_deg: float, kappa: float) -> float:
    """Return the static friction at or below which a sliding object does not stop on a slope ([Fujino1978]_ eq. (14)).

    Parameters
    ----------
    slope_deg : float, degrees
    kappa : float
        Ratio of kinetic to static friction, positive.

    Returns
    -------
    float
        tan(th) / kappa; the object can be at rest only for mu >= tan(th).

    References
    ----------
    [Fujino1978]_ eq. (14)

    Examples
    --------
    >>> from seisblock.criteria import min_friction_to_stop
    >>> round(min_friction_to_stop(20.0, 0.5), 4)
    0.7279
    """
    checks.positive("kappa, kinetic over static friction,", kappa)
    return math.tan(math.radians(slope_deg)) / kappa


def min_friction_to_hold(slope_deg: float, horizontal: ArrayLike, vertical: ArrayLike = 0.0) -> FloatArray:
    """Return the static friction below which ground acceleration makes an object slip down a slope ([Fujino1978]_ eq. (15)).

    Parameters
    ----------
    slope_deg : float, degrees
    horizontal : array
        Ratio of horizontal ground acceleration to gravity, alpha in the paper, positive downhill.
    vertical : array
        Ratio of vertical ground acceleration to gravity, upwards positive: alpha times mu in the paper.

    Returns
    -------
    array
        tan(th - atan(alpha / (1 + alpha mu))), identical to eq. (15) as printed; the maximum over a record governs.

    References
    ----------
    [Fujino1978]_ eq. (15); the text asks for the smallest left side instead of the largest right side.

    Examples
    --------
    >>> from seisblock.criteria import min_friction_to_hold
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
        Height of the pulse, opposite to the direction of slip.
    duration : float, s
    yield_acceleration : float, m/s^2
        Sliding threshold, mu g on a level base; kinetic and static friction are equal.

    Returns
    -------
    float, m
        V^2 / (2 a_y) (1 - a_y / a) with V = a T; zero if the pulse does not exceed a_y.

    References
    ----------
    [Newmark1965]_

    Examples
    --------
    >>> from seisblock.criteria import pulse_slip
    >>> round(pulse_slip(4.0, 1.0, 1.96133), 6)
    2.078865
    """
    checks.positive("the yield acceleration", yield_acceleration, "m/s^2")
    checks.non_negative("the duration", duration, "s")
    excess = max(acceleration - yield_acceleration, 0.0)
    return acceleration * excess * duration**2 / (2.0 * yield_acceleration)


def steady_slip(amplitude: float, frequency: float, mu: float, *, kappa: float = 1.0, gravity: float = STANDARD_GRAVITY) -> float | None:
    """Return the slip per half cycle under harmonic motion without sticking ([WestermoUdwadia1983]_ steady sliding).

    Parameters
    ----------
    amplitude : float, m/s^2
        Peak ground acceleration.
    frequency : float, Hz
    mu : float
        Static friction coefficient.
    kappa : float
        Ratio of kinetic to static friction.
    gravity : float, m/s^2

    Returns
    -------
    float or None, m
        Distance of the two extrema of the relative displacement, 2 (A/w^2) sqrt(1 - (pi mu_k g / 2 A)^2); None if
        the object sticks in each half cycle, which for kappa = 1 is the case for mu g / A > (1 + pi^2/4)^(-1/2) = 0.5370.

    Notes
    -----
    In steady sliding the velocity of the object is a triangular wave of slope mu_k g, antisymmetric over half a period. The relative
    velocity vanishes at the ground acceleration A sqrt(1 - (pi mu_k g / 2 A)^2); if that exceeds mu g, the slip reverses without sticking.

    References
    ----------
    [WestermoUdwadia1983]_

    Examples
    --------
    >>> from seisblock.criteria import steady_slip
    >>> round(steady_slip(4.0, 1.0, 0.1), 5)
    0.18701
    >>> steady_slip(4.0, 1.0, 0.25) is None
    True
    """
    checks.positive("the amplitude", amplitude, "m/s^2")
    checks.positive("the frequency", frequency, "Hz")
    remainder = 1.0 - (math.pi * kappa * mu * gravity / (2.0 * amplitude)) ** 2
    # at the reversal the ground acceleration is below the static limit: the object sticks
    if remainder < 0.0 or math.sqrt(remainder) * amplitude < mu * gravity:
        return None
    return 2.0 * amplitude / (2.0 * math.pi * frequency) ** 2 * math.sqrt(remainder)
