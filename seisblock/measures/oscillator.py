"""Peak responses of a damped oscillator under piecewise linear ground acceleration."""

from __future__ import annotations

import cmath
import math

import numpy as np

from seisblock._jit import kernel
from seisblock.core.limits import CHUNK_SIZE
from seisblock.core.typing import FloatArray
from seisblock.records.oscillator import exact_step

ACCELERATION, VELOCITY, DISPLACEMENT, FINAL_DISPLACEMENT, FINAL_VELOCITY = range(5)
"""Entries of the state array: three peak responses, and the current displacement and velocity."""

FOUR_OVER_27 = 4.0 / 27.0
"""Bound of a cubic above the values at its ends, as a multiple of its length and the difference of its end slopes."""


def oscillator_peaks(ground: FloatArray, dt: float, omega: float, damping: float) -> tuple[float, float, float]:
    """Return the peak absolute acceleration, relative velocity and relative displacement of an oscillator.

    Exact step for linear ground acceleration ([NigamJennings1969]_ eq. (2.7)). Between samples, maxima are those of the
    cubic Hermite interpolants; after the last sample the ground is at rest and the peak of the free vibration counts, too.

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
    peaks = np.zeros(5)
    for begin in range(0, max(ground.size - 1, 1), CHUNK_SIZE):
        _update_peaks(step, ground[begin : begin + CHUNK_SIZE + 1], dt, omega, damping, peaks)
    u, v = float(peaks[FINAL_DISPLACEMENT]), float(peaks[FINAL_VELOCITY])
    # on still ground the absolute acceleration is the relative one
    a = -(2.0 * damping * omega * v + omega**2 * u)
    # each response obeys the equation of free vibration, with its own value and rate at the end of the record
    free_peaks = (_free_peak(x, rate, omega, damping) for x, rate in ((a, -(2.0 * damping * omega * a + omega**2 * v)), (v, a), (u, v)))
    acceleration, speed, distance = map(max, peaks[:3].tolist(), free_peaks)
    return acceleration, speed, distance


@kernel("void(float64[:, ::1], Array(float64, 1, 'C', readonly=True), float64, float64, float64, float64[::1])")
def _update_peaks(step, ground, dt, omega, damping, peaks):
    """Integrate an oscillator over some samples and update its peak responses."""
    damping_term, stiffness = 2.0 * damping * omega, omega**2
    u, v = peaks[FINAL_DISPLACEMENT], peaks[FINAL_VELOCITY]
    absolute = -(damping_term * v + stiffness * u)
    relative = absolute - ground[0]
    # slope of the absolute acceleration, needed by its cubic interpolant
    jerk = -(damping_term * relative + stiffness * v)
    max_acceleration, max_velocity, max_displacement = (
        max(peaks[ACCELERATION], abs(absolute)),
        max(peaks[VELOCITY], abs(v)),
        max(peaks[DISPLACEMENT], abs(u)),
    )
    for k in range(ground.size - 1):
        ground_1, ground_2 = ground[k], ground[k + 1]
        u_2 = step[0, 0] * u + step[0, 1] * v + (step[0, 2] * ground_1 + step[0, 3] * ground_2)
        v_2 = step[1, 0] * u + step[1, 1] * v + (step[1, 2] * ground_1 + step[1, 3] * ground_2)
        absolute_2 = -(damping_term * v_2 + stiffness * u_2)
        relative_2 = absolute_2 - ground_2
        jerk_2 = -(damping_term * relative_2 + stiffness * v_2)
        max_acceleration = _peak_of_cubic(absolute, absolute_2, jerk, jerk_2, dt, max_acceleration)
        max_velocity = _peak_of_cubic(v, v_2, relative, relative_2, dt, max_velocity)
        max_displacement = _peak_of_cubic(u, u_2, v, v_2, dt, max_displacement)
        u, v, absolute, relative, jerk = u_2, v_2, absolute_2, relative_2, jerk_2
    peaks[ACCELERATION], peaks[VELOCITY], peaks[DISPLACEMENT], peaks[FINAL_DISPLACEMENT], peaks[FINAL_VELOCITY] = (
        max_acceleration,
        max_velocity,
        max_displacement,
        u,
        v,
    )


@kernel("float64(float64, float64, float64, float64, float64, float64)", inline=True)
def _peak_of_cubic(first, last, slope, slope_2, dt, top):
    """Return the maximum of `top` and the absolute value of the cubic Hermite interpolant of two values and slopes."""
    high = max(abs(first), abs(last))
    # an interior extremum needs slopes of opposite sign; skip it if the bound cannot exceed the peak so far
    if slope * slope_2 < 0.0 and high + FOUR_OVER_27 * dt * abs(slope - slope_2) > top:
        slope_dt, slope_2_dt, rise = dt * slope, dt * slope_2, last - first
        square, cube = 3.0 * rise - 2.0 * slope_dt - slope_2_dt, slope_dt + slope_2_dt - 2.0 * rise
        # root of the derivative at the extremum, in the form without cancellation
        place = slope_dt / (-square + math.copysign(math.sqrt(square**2 - 3.0 * cube * slope_dt), slope_dt))
        high = max(high, abs(first + place * (slope_dt + place * (square + place * cube))))
    return max(top, high)


def _free_peak(value: float, rate: float, omega: float, damping: float) -> float:
    """Return the maximum absolute value of a damped free vibration with given initial value and rate."""
    decay, swing = damping * omega, omega * math.sqrt(1.0 - damping**2)
    # x = Re(amplitude * exp(pole * t)); first extremum at Re(pole * amplitude * exp(pole * t)) = 0
    amplitude, pole = complex(value, -(rate + decay * value) / swing), complex(-decay, swing)
    turning_time = (0.5 * math.pi - cmath.phase(pole * amplitude)) % math.pi / swing
    return max(abs(value), abs((amplitude * cmath.exp(pole * turning_time)).real))
