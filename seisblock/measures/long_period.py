"""JMA class of long-period ground motion, from the absolute velocity response of oscillators."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock._jit import kernel
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.limits import CHUNK_SIZE
from seisblock.core.typing import FloatArray
from seisblock.core.units import KINE
from seisblock.records.oscillator import exact_step
from seisblock.records.record import Record
from seisblock.records.seismic_intensity import orthogonal_components

PERIODS = tuple(round(1.6 + 0.2 * k, 1) for k in range(32))
"""Periods of the oscillators, 1.6 to 7.8 s ([JMA2016]_ method)."""

DAMPING = 0.05
"""Damping ratio of the oscillators."""

CLASS_BOUNDS = (5 * KINE, 15 * KINE, 50 * KINE, 100 * KINE)
"""Lower bounds of the classes 1 to 4, floor velocity, m/s."""

_A1, _A2, _RATE = -1.995438545842, 0.995448925627, 100.0
"""Denominator coefficients of JMA's 20 s high-pass, and their sampling rate, Hz ([JMA2016]_ p. 13)."""

MAX_SAMPLING_INTERVAL = 0.1
"""Maximum sampling interval, s; larger ones do not resolve the oscillator of 1.6 s."""


@dataclass(frozen=True, repr=False)
class LongPeriodMotion(DisplayMixin):
    """Floor velocity in tall buildings and JMA's class of long-period ground motion.

    Parameters
    ----------
    long_period_class : str
        ``0`` (none) to ``4``.
    floor_velocity_m_s : float, m/s
        Maximum absolute velocity of the oscillators, horizontal vector.
    period_s : float, s
        Period of that oscillator.
    """

    long_period_class: str
    floor_velocity_m_s: float
    period_s: float


def long_period_motion(record: Record) -> LongPeriodMotion | None:
    """Return JMA's class of long-period ground motion and the floor velocity.

    Parameters
    ----------
    record : Record
        Ground motion with two horizontals, sampled at 10 Hz or more.

    Returns
    -------
    LongPeriodMotion or None
        None without two horizontals, or if the sampling rate is too low.

    Notes
    -----
    Both horizontals pass a second-order high-pass at 20 s. The absolute velocity of an oscillator is its relative velocity (exact for
    linear interpolation) plus the integral of the ground acceleration; the two directions are combined as a vector. The maximum over
    samples and periods (1.6 to 7.8 s in steps of 0.2 s, damping 5 %) determines the class: 1 from 5, 2 from 15, 3 from 50 and 4
    from 100 cm/s ([JMA2016]_ method). JMA gives the filter for 100 Hz; at other rates the poles are converted to the same time constants.
    Differs: the filter starts as if the first sample had lasted for ever, so that an offset is removed; for a record that begins at
    rest the result is JMA's.

    Examples
    --------
    >>> from seisblock.measures import long_period_motion
    >>> from seisblock.readers import read
    >>> result = long_period_motion(read("synthetic_jma.csv"))
    >>> result.long_period_class, round(result.floor_velocity_m_s, 3), result.period_s
    ('4', 4.341, 1.8)
    """
    checks.instance(record, Record)
    if len(record.horizontals) != 2 or record.dt > MAX_SAMPLING_INTERVAL:
        return None
    first, second = (_highpass(row, record.dt) for row in orthogonal_components(record)[:2])
    steps = np.stack([exact_step(record.dt, 2.0 * math.pi / period, DAMPING)[:2] for period in PERIODS])
    # per period: displacement, velocity and ground velocity of the first, then of the second direction
    states, largest = np.zeros((len(PERIODS), 6)), np.zeros(len(PERIODS))
    for begin in range(0, first.size - 1, CHUNK_SIZE):
        # in pieces, so that Ctrl-C takes effect between two of them
        _update_peaks(steps, first[begin : begin + CHUNK_SIZE + 1], second[begin : begin + CHUNK_SIZE + 1], record.dt, states, largest)
    velocity = np.sqrt(largest)
    worst = int(velocity.argmax())
    return LongPeriodMotion(long_period_class(float(velocity[worst])), float(velocity[worst]), PERIODS[worst])


def long_period_class(floor_velocity: float) -> str:
    """Return JMA's class of long-period ground motion, ``0`` to ``4``, for a floor velocity ([JMA2016]_ method).

    Parameters
    ----------
    floor_velocity : float, m/s
        Largest absolute velocity of the floors.

    Returns
    -------
    str

    Examples
    --------
    >>> from seisblock.measures import long_period_class
    >>> [long_period_class(v) for v in (0.049, 0.05, 0.2, 0.999, 1.0)]
    ['0', '1', '2', '3', '4']
    """
    checks.non_negative("the floor velocity", floor_velocity, "m/s")
    return str(sum(floor_velocity >= bound for bound in CLASS_BOUNDS))


def _highpass(row: FloatArray, dt: float) -> FloatArray:
    """Return samples after JMA's high-pass, (n,), m/s^2."""
    # decay and angle of the poles per sample, scaled from 100 Hz to the sampling rate
    rate_ratio = _RATE * dt
    decay, angle = -0.5 * math.log(_A2) * rate_ratio, math.acos(-_A1 / (2.0 * math.sqrt(_A2))) * rate_ratio
    a1, a2 = -2.0 * math.exp(-decay) * math.cos(angle), math.exp(-2.0 * decay)
    # unit gain at the Nyquist frequency, as JMA's filter
    gain = 0.25 * (1.0 - a1 + a2)
    out = np.zeros(row.size)
    # constant input before the record: an offset gives no transient
    memory = np.array([row[0], row[0], 0.0, 0.0])
    for begin in range(0, row.size, CHUNK_SIZE):
        part = slice(begin, begin + CHUNK_SIZE)
        _filter(row[part], a1, a2, gain, memory, out[part])
    return out


@kernel("void(Array(float64, 1, 'C', readonly=True), float64, float64, float64, float64[::1], float64[::1])")
def _filter(row, a1, a2, gain, memory, out):
    """Apply a second-order filter with a double zero at zero frequency to some samples, continuing from `memory`."""
    x_1, x_2, y_1, y_2 = memory[0], memory[1], memory[2], memory[3]
    for k in range(row.size):
        x = row[k]
        y = x - 2.0 * x_1 + x_2 - a1 * y_1 - a2 * y_2
        out[k] = gain * y
        x_2, x_1, y_2, y_1 = x_1, x, y_1, y
    memory[0], memory[1], memory[2], memory[3] = x_1, x_2, y_1, y_2


@kernel("void(float64[:, :, ::1], float64[::1], float64[::1], float64, float64[:, ::1], float64[::1])")
def _update_peaks(steps, first, second, dt, states, largest):
    """Integrate the oscillators under two components over some samples; update the maxima of the squared absolute velocity."""
    for m in range(steps.shape[0]):
        step = steps[m]
        u, v, ground = states[m, 0], states[m, 1], states[m, 2]
        u_2, v_2, ground_2 = states[m, 3], states[m, 4], states[m, 5]
        top = max(largest[m], (v + ground) ** 2 + (v_2 + ground_2) ** 2)
        for k in range(first.size - 1):
            a, b, c, d = first[k], first[k + 1], second[k], second[k + 1]
            u, v = (
                step[0, 0] * u + step[0, 1] * v + (step[0, 2] * a + step[0, 3] * b),
                step[1, 0] * u + step[1, 1] * v + (step[1, 2] * a + step[1, 3] * b),
            )
            u_2, v_2 = (
                step[0, 0] * u_2 + step[0, 1] * v_2 + (step[0, 2] * c + step[0, 3] * d),
                step[1, 0] * u_2 + step[1, 1] * v_2 + (step[1, 2] * c + step[1, 3] * d),
            )
            # ground velocity by the trapezoidal rule, exact for linear acceleration
            ground += 0.5 * dt * (a + b)
            ground_2 += 0.5 * dt * (c + d)
            top = max(top, (v + ground) ** 2 + (v_2 + ground_2) ** 2)
        states[m, 0], states[m, 1], states[m, 2], states[m, 3], states[m, 4], states[m, 5] = u, v, ground, u_2, v_2, ground_2
        largest[m] = top
