"""The exact extrema of a state over one step, from the zeros of its polynomial's derivative."""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import MATRIX, VECTOR
from seisblock.dynamics.polynomial import evaluate_row, first_crossing

_t = types()

HIGHEST, HIGHEST_TIME, LOWEST, LOWEST_TIME = range(4)
"""Columns of a table of extrema, one row a state."""


@kernel(_t.void(MATRIX, _t.int64, VECTOR, _t.float64), inline=True)
def begin(extrema, n_tracked, y, time):
    """Let the extrema of the first states begin at what these are."""
    for i in range(n_tracked):
        extrema[i, HIGHEST] = y[i]
        extrema[i, HIGHEST_TIME] = time
        extrema[i, LOWEST] = y[i]
        extrema[i, LOWEST_TIME] = time


@kernel(_t.void(MATRIX, _t.int64, _t.float64, _t.float64), inline=True)
def keep(extrema, i, value, time):
    """Widen the extrema of state `i` to hold a value."""
    if value > extrema[i, HIGHEST]:
        extrema[i, HIGHEST] = value
        extrema[i, HIGHEST_TIME] = time
    if value < extrema[i, LOWEST]:
        extrema[i, LOWEST] = value
        extrema[i, LOWEST_TIME] = time


@kernel(_t.boolean(MATRIX, _t.int64, _t.int64, _t.float64, MATRIX), inline=True)
def may_turn(c, i, degree, h, extrema):
    """Whether state `i` may reach a new extremum inside a step; False is certain."""
    bend = 0.0
    power = 1.0
    for k in range(2, degree + 1):
        power *= h
        bend += k * abs(c[i, k]) * power
    if bend < abs(c[i, 1]):
        return False
    reach = (abs(c[i, 1]) + bend) * h
    return c[i, 0] + reach > extrema[i, HIGHEST] or c[i, 0] - reach < extrema[i, LOWEST]


@kernel(_t.void(MATRIX, _t.int64, _t.int64, _t.float64, _t.float64, MATRIX, VECTOR, VECTOR, VECTOR))
def keep_turning_points(c, i, degree, h, now, extrema, rate, q, d):
    """Widen the extrema of state `i` by its first maximum and first minimum inside a step."""
    for sign in (1.0, -1.0):
        for k in range(degree):
            rate[k] = sign * (k + 1) * c[i, k + 1]
        at = first_crossing(rate, degree - 1, h, q, d)
        if at > 0.0:
            keep(extrema, i, evaluate_row(c, i, degree, at), now + at)
