"""Exact extrema of the states within a step, from the zeros of the derivative of their polynomials."""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.dynamics.polynomial import evaluate_row, first_crossing

_t = types()

HIGHEST, HIGHEST_TIME, LOWEST, LOWEST_TIME = range(4)
"""Columns of the table of extrema, which has one row per state."""


@kernel(_t.void(MATRIX, _t.int64, VECTOR, _t.float64), inline=True)
def init_extrema(extrema, n_tracked, y, time):
    """Initialise the extrema of the tracked states with their current values."""
    for i in range(n_tracked):
        extrema[i, HIGHEST] = y[i]
        extrema[i, HIGHEST_TIME] = time
        extrema[i, LOWEST] = y[i]
        extrema[i, LOWEST_TIME] = time


@kernel(_t.void(MATRIX, _t.int64, _t.float64, _t.float64), inline=True)
def update_extrema(extrema, i, value, time):
    """Update the extrema of state `i` with a value."""
    if value > extrema[i, HIGHEST]:
        extrema[i, HIGHEST] = value
        extrema[i, HIGHEST_TIME] = time
    if value < extrema[i, LOWEST]:
        extrema[i, LOWEST] = value
        extrema[i, LOWEST_TIME] = time


@kernel(_t.boolean(MATRIX, _t.int64, _t.int64, _t.float64, MATRIX), inline=True)
def may_exceed_extrema(c, i, degree, h, extrema):
    """Return False only if state `i` certainly reaches no new extremum inside a step."""
    # bound of the higher terms of the derivative: sum of k |c_k| h^(k - 1)
    curvature = 0.0
    power = 1.0
    for k in range(2, degree + 1):
        power *= h
        curvature += k * abs(c[i, k]) * power
    # the linear term dominates: monotone over the step, and the end value is checked by the caller
    if curvature < abs(c[i, 1]):
        return False
    bound = (abs(c[i, 1]) + curvature) * h
    return c[i, 0] + bound > extrema[i, HIGHEST] or c[i, 0] - bound < extrema[i, LOWEST]


@kernel(_t.void(MATRIX, _t.int64, _t.int64, _t.float64, _t.float64, MATRIX, _t.float64, VECTOR, VECTOR, VECTOR), inline=True)
def update_interior_extremum(c, i, degree, h, start_time, extrema, sign, rate, q, d):
    """Update the extrema of state `i` with its first maximum (`sign` 1) or minimum (-1) inside a step."""
    # derivative with the sign for which it is positive before the extremum
    for k in range(degree):
        rate[k] = sign * (k + 1) * c[i, k + 1]
    # a derivative that starts below zero has no extremum ahead: the crossing is then at zero and is ignored
    offset = first_crossing(rate, degree - 1, h, q, d)
    if offset > 0.0:
        update_extrema(extrema, i, evaluate_row(c, i, degree, offset), start_time + offset)


@kernel(_t.void(MATRIX, _t.int64, _t.int64, _t.float64, _t.float64, MATRIX, VECTOR, VECTOR, VECTOR))
def update_interior_extrema(c, i, degree, h, start_time, extrema, rate, q, d):
    """Update the extrema of state `i` with its first maximum and first minimum inside a step."""
    for sign in (1.0, -1.0):
        update_interior_extremum(c, i, degree, h, start_time, extrema, sign, rate, q, d)
