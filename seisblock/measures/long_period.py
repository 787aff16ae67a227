"""Long-period ground motion as JMA classes it: how fast the upper storeys of tall buildings move, as oscillators over the record."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock._jit import kernel
from seisblock.core import checks
from seisblock.core.limits import CHUNK_SIZE
from seisblock.core.typing import FloatArray
from seisblock.core.units import KINE
from seisblock.measures.intensity import orthogonal_components
from seisblock.records.oscillator import exact_step
from seisblock.records.record import Record

PERIODS = tuple(round(1.6 + 0.2 * k, 1) for k in range(32))
"""Of the oscillators, 1.6 to 7.8 s ([JMA2016]_ method)."""

DAMPING = 0.05
"""Of the oscillators, a ratio to critical."""

CLASS_BOUNDS = (5 * KINE, 15 * KINE, 50 * KINE, 100 * KINE)
"""From each of these floor velocities on the class is one more, m/s."""

_A1, _A2, _RATE = -1.995438545842, 0.995448925627, 100.0
"""Coefficients of the memory of JMA's high-pass of 20 s, and the sampling rate that they are for, Hz ([JMA2016]_ p. 13)."""

MAX_SAMPLING_INTERVAL = 0.1
"""Sampling interval beyond which an oscillator of 1.6 s is not told by its samples, s."""


@dataclass(frozen=True)
class LongPeriodMotion:
    """How fast the upper storeys of tall buildings move, and JMA's class of that.

    Parameters
    ----------
    long_period_class : str
        ``0`` (none) to ``4``.
    floor_velocity_m_s : float, m/s
        The largest absolute velocity of the oscillators, of the horizontal vector.
    period_s : float, s
        Of the oscillator that has it.
    """

    long_period_class: str
    floor_velocity_m_s: float
    period_s: float


def long_period_motion(record: Record) -> LongPeriodMotion | None:
    """Return the class of long-period ground motion of the Japan Meteorological Agency, and the floor velocity that it rests on.

    Parameters
    ----------
    record : Record
        Of the ground; two horizontals, at 10 Hz or more.

    Returns
    -------
    LongPeriodMotion or None
        None where there are not two horizontals, or they are told too seldom.

    Notes
    -----
    Both horizontals go through a high-pass of the second order at 20 s; the absolute velocity of an oscillator is its velocity relative to
    the ground, exact for straight lines from sample to sample, plus the integral of the ground's; the two are added as vectors, and the
    largest of samples and of the periods from 1.6 to 7.8 s in steps of 0.2 s, damping 5 %, is classed: 1 from 5, 2 from 15, 3 from 50 and 4
    from 100 cm/s on ([JMA2016]_ method). JMA tells its filter for 100 Hz; at other rates its poles are the same in time. Differs: what
    the first sample has is taken to have lasted, so that nothing is left of an offset; a record that begins at rest is as JMA's.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> found = long_period_motion(read("synthetic_jma.csv"))
    >>> found.long_period_class, round(found.floor_velocity_m_s, 3), found.period_s
    ('4', 4.341, 1.8)
    """
    checks.instance(record, Record)
    if len(record.horizontals) != 2 or record.dt > MAX_SAMPLING_INTERVAL:
        return None
    first, second = (_highpass(row, record.dt) for row in orthogonal_components(record)[:2])
    steps = np.stack([exact_step(record.dt, 2.0 * math.pi / period, DAMPING)[:2] for period in PERIODS])
    states, largest = np.zeros((len(PERIODS), 6)), np.zeros(len(PERIODS))
    for begin in range(0, first.size - 1, CHUNK_SIZE):
        # a piece at a time: Ctrl-C is heard between two
        _update_peaks(steps, first[begin : begin + CHUNK_SIZE + 1], second[begin : begin + CHUNK_SIZE + 1], record.dt, states, largest)
    velocity = np.sqrt(largest)
    worst = int(velocity.argmax())
    return LongPeriodMotion(long_period_class(float(velocity[worst])), float(velocity[worst]), PERIODS[worst])


def long_period_class(floor_velocity: float) -> str:
    """Return JMA's class of long-period ground motion, ``0`` to ``4``, of a floor velocity, m/s ([JMA2016]_ method).

    Examples
    --------
    >>> [long_period_class(v) for v in (0.049, 0.05, 0.2, 0.999, 1.0)]
    ['0', '1', '2', '3', '4']
    """
    checks.non_negative("the floor velocity", floor_velocity, "m/s")
    return str(sum(floor_velocity >= bound for bound in CLASS_BOUNDS))


def _highpass(row: FloatArray, dt: float) -> FloatArray:
    """Return samples after JMA's high-pass, (n,), m/s^2."""
    rate_ratio = _RATE * dt
    decay, angle = -0.5 * math.log(_A2) * rate_ratio, math.acos(-_A1 / (2.0 * math.sqrt(_A2))) * rate_ratio
    a1, a2 = -2.0 * math.exp(-decay) * math.cos(angle), math.exp(-2.0 * decay)
    gain = 0.25 * (1.0 - a1 + a2)  # one at half the sampling rate, as JMA's
    out = np.zeros(row.size)
    memory = np.array([row[0], row[0], 0.0, 0.0])
    for begin in range(0, row.size, CHUNK_SIZE):
        part = slice(begin, begin + CHUNK_SIZE)
        _filter(row[part], a1, a2, gain, memory, out[part])
    return out


@kernel("void(Array(float64, 1, 'C', readonly=True), float64, float64, float64, float64[::1], float64[::1])")
def _filter(row, a1, a2, gain, memory, out):
    """Run a filter with a double zero at frequency zero over some samples, from what it remembers of those before."""
    x_1, x_2, y_1, y_2 = memory[0], memory[1], memory[2], memory[3]
    for k in range(row.size):
        x = row[k]
        y = x - 2.0 * x_1 + x_2 - a1 * y_1 - a2 * y_2
        out[k] = gain * y
        x_2, x_1, y_2, y_1 = x_1, x, y_1, y
    memory[0], memory[1], memory[2], memory[3] = x_1, x_2, y_1, y_2


@kernel("void(float64[:, :, ::1], float64[::1], float64[::1], float64, float64[:, ::1], float64[::1])")
def _update_peaks(steps, first, second, dt, states, largest):
    """Follow oscillators under two components over some samples, and keep the largest square of their absolute velocities."""
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
            ground += 0.5 * dt * (a + b)
            ground_2 += 0.5 * dt * (c + d)
            top = max(top, (v + ground) ** 2 + (v_2 + ground_2) ** 2)
        states[m, 0], states[m, 1], states[m, 2], states[m, 3], states[m, 4], states[m, 5] = u, v, ground, u_2, v_2, ground_2
        largest[m] = top
