"""One damped oscillator on a ground that moves in straight lines from sample to sample, and the largest that it reaches."""

from __future__ import annotations

import cmath
import math

import numpy as np

from seisblock._jit import kernel
from seisblock.limits import AT_A_TIME
from seisblock.records.oscillator import exact_step
from seisblock.typing import FloatArray

ACCELERATION, VELOCITY, DISPLACEMENT, AT_DISPLACEMENT, AT_VELOCITY = range(5)
"""What is kept of an oscillator: the largest of three, and the two in which it is now."""

FOUR_OVER_27 = 4.0 / 27.0
"""A cubic rises above its ends by at most so much of the slopes there, times its length."""


def oscillator_peaks(ground: FloatArray, dt: float, omega: float, damping: float) -> tuple[float, float, float]:
    """Return the peak absolute acceleration, relative velocity and relative displacement of an oscillator, from rest to rest.

    The exact step over a straight line of ground acceleration ([NigamJennings1969]_ eq. (2.7)). Between points the maxima are those of the
    cubics through values and slopes; after the last sample the ground is still and the oscillator swings on.

    Parameters
    ----------
    ground : (n,) array, m/s^2
        Ground acceleration.
    dt : float, s
        Sampling interval.
    omega : float, rad/s
        Undamped natural frequency.
    damping : float
        Ratio to critical, 0 <= damping < 1.

    Returns
    -------
    float, float, float : m/s^2, m/s, m
    """
    step = exact_step(dt, omega, damping)
    kept = np.zeros(5)
    for begin in range(0, max(ground.size - 1, 1), AT_A_TIME):
        _follow(step, ground[begin : begin + AT_A_TIME + 1], dt, omega, damping, kept)
    u, v = float(kept[AT_DISPLACEMENT]), float(kept[AT_VELOCITY])
    # on still ground the absolute acceleration is the relative one
    a = -(2.0 * damping * omega * v + omega**2 * u)
    after = (_free_peak(x, rate, omega, damping) for x, rate in ((a, -(2.0 * damping * omega * a + omega**2 * v)), (v, a), (u, v)))
    acceleration, speed, distance = map(max, kept[:3].tolist(), after)
    return acceleration, speed, distance


@kernel("void(float64[:, ::1], Array(float64, 1, 'C', readonly=True), float64, float64, float64, float64[::1])")
def _follow(step, ground, dt, omega, damping, kept):
    """Follow an oscillator over some samples, and keep the largest that it reaches."""
    twice, square = 2.0 * damping * omega, omega**2
    u, v = kept[AT_DISPLACEMENT], kept[AT_VELOCITY]
    absolute = -(twice * v + square * u)
    relative = absolute - ground[0]
    jerk = -(twice * relative + square * v)
    most, fastest, farthest = max(kept[ACCELERATION], abs(absolute)), max(kept[VELOCITY], abs(v)), max(kept[DISPLACEMENT], abs(u))
    for k in range(ground.size - 1):
        before, after = ground[k], ground[k + 1]
        u_2 = step[0, 0] * u + step[0, 1] * v + (step[0, 2] * before + step[0, 3] * after)
        v_2 = step[1, 0] * u + step[1, 1] * v + (step[1, 2] * before + step[1, 3] * after)
        absolute_2 = -(twice * v_2 + square * u_2)
        relative_2 = absolute_2 - after
        jerk_2 = -(twice * relative_2 + square * v_2)
        most = _peak_of_cubic(absolute, absolute_2, jerk, jerk_2, dt, most)
        fastest = _peak_of_cubic(v, v_2, relative, relative_2, dt, fastest)
        farthest = _peak_of_cubic(u, u_2, v, v_2, dt, farthest)
        u, v, absolute, relative, jerk = u_2, v_2, absolute_2, relative_2, jerk_2
    kept[ACCELERATION], kept[VELOCITY], kept[DISPLACEMENT], kept[AT_DISPLACEMENT], kept[AT_VELOCITY] = most, fastest, farthest, u, v


@kernel("float64(float64, float64, float64, float64, float64, float64)", inline=True)
def _peak_of_cubic(first, last, slope, slope_2, dt, top):
    """Return the largest of `top` and the absolute value of the cubic through two values with two slopes, at its ends and between."""
    high = max(abs(first), abs(last))
    if slope * slope_2 < 0.0 and high + FOUR_OVER_27 * dt * abs(slope - slope_2) > top:
        one, two, rise = dt * slope, dt * slope_2, last - first
        square, cube = 3.0 * rise - 2.0 * one - two, one + two - 2.0 * rise
        # the root of the derivative at which the curve turns, in the form that does not cancel
        place = one / (-square + math.copysign(math.sqrt(square**2 - 3.0 * cube * one), one))
        high = max(high, abs(first + place * (one + place * (square + place * cube))))
    return max(top, high)


def _free_peak(value: float, rate: float, omega: float, damping: float) -> float:
    """Return the largest absolute value of a damped free swing that begins with a value and a rate."""
    decay, swing = damping * omega, omega * math.sqrt(1.0 - damping**2)
    # the swing is the real part of amplitude * exp(pole * t); it turns first where that of pole * amplitude * exp(pole * t) is zero
    amplitude, pole = complex(value, -(rate + decay * value) / swing), complex(-decay, swing)
    until = (0.5 * math.pi - cmath.phase(pole * amplitude)) % math.pi / swing
    return max(abs(value), abs((amplitude * cmath.exp(pole * until)).real))
