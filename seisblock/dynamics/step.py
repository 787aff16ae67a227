"""Parts of one integration step: ground motion, step length, first guard crossing, state at the end."""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.dynamics.buffers import FORCING, SCRATCH, SHAPE
from seisblock.dynamics.extrema import may_exceed_extrema, update_extrema, update_interior_extrema
from seisblock.dynamics.model_api import OFF
from seisblock.dynamics.polynomial import NO_CROSSING, ROUND_OFF, evaluate_row, first_negative, lower_bound_of_row

_t = types()

TRUNCATION = 1.1e-16
"""Maximum last term of a series of full order, relative to the state."""


@kernel(_t.float64(MATRIX, _t.int64, _t.int64, _t.float64, VECTOR, _t.int64))
def step_length(c, n_states, order, h, p, floors):
    """Return the step length up to `h` at which the series has converged; `floors` is the index of the floors in `p`, or -1."""
    # the last two terms are tested, since the series of an even or odd state has zeros in between
    # h^(order - 1), scales the last two terms
    top = 1.0
    for _ in range(order - 1):
        top *= h
    for i in range(n_states):
        if c[i, 1] == OFF:
            continue
        # size of the state over the step, from its leading terms
        size = abs(c[i, 0]) + h * (abs(c[i, 1]) + h * (abs(c[i, 2]) + h * abs(c[i, 3])))
        if floors >= 0:
            size = max(size, p[floors + i])
        tail = top * max(abs(c[i, order - 1]), abs(c[i, order]) * h)
        if tail > TRUNCATION * size:
            # a state that starts from zero gets its size from the higher terms
            power = h**3
            for k in range(4, order - 1):
                power *= h
                size += abs(c[i, k]) * power
        if tail > TRUNCATION * size:
            # the tail scales with h^(order - 1); factor 0.9 for safety
            reduced_h = 0.9 * h * (TRUNCATION * size / tail) ** (1.0 / (order - 1)) if size > 0.0 else 0.5 * h
            top *= (reduced_h / h) ** (order - 1)
            h = reduced_h
    return h


@kernel(_t.void(FORCING, _t.int64, _t.float64, MATRIX), inline=True)
def read_forcing(forcing, sample, tau, f):
    """Write value and slope of the ground motion `tau` seconds after a sample to `f`."""
    acceleration, gains = forcing.acceleration, forcing.gains
    per_dt = 1.0 / forcing.dt
    for row in range(acceleration.shape[0]):
        if gains[row] != 0.0:
            slope = gains[row] * (acceleration[row, sample + 1] - acceleration[row, sample]) * per_dt
            f[row, 0] = gains[row] * acceleration[row, sample] + slope * tau
            f[row, 1] = slope


@kernel(_t.Tuple((_t.int64, _t.float64))(SCRATCH, SHAPE, _t.int64, _t.float64), inline=True)
def first_guard_crossing(scratch, shape, degree, h):
    """Return the first guard that fires within a step (-1 for none) and its time, which ends the step."""
    g = scratch.g
    guard = -1
    for k in range(shape.guards):
        # a polynomial bounded away from zero needs no root search: this is the usual case
        if g[k, 0] == OFF or lower_bound_of_row(g, k, degree, h) > 0.0:
            continue
        # guards that are states are reset to exact zeros; all others carry the round-off of their sum
        crossing = first_negative(g[k], degree, h, 0.0 if k < shape.sharp else ROUND_OFF, scratch.q, scratch.d)
        # the step is shortened to the earliest crossing; of simultaneous ones the first guard is kept
        if crossing != NO_CROSSING and (guard < 0 or crossing < h):
            guard = k
            h = crossing
            if crossing == 0.0:
                break
    return guard, h


@kernel(_t.boolean(SCRATCH, _t.int64, _t.float64, _t.float64, _t.int64, VECTOR, MATRIX), inline=True)
def advance_state(scratch, degree, h, start_time, n_tracked, y, extrema):
    """Advance the state and its extrema by a step that begins at `start_time`; return True if the state is finite."""
    c = scratch.c
    # extrema inside the step; its end point follows below
    for i in range(n_tracked):
        if may_exceed_extrema(c, i, degree, h, extrema):
            update_interior_extrema(c, i, degree, h, start_time, extrema, scratch.rate, scratch.q, scratch.d)
    size = 0.0
    for i in range(y.size):
        if c[i, 1] == OFF:
            continue
        y[i] = evaluate_row(c, i, degree, h)
        size += abs(y[i])
    for i in range(n_tracked):
        update_extrema(extrema, i, y[i], start_time + h)
    # False for infinite and NaN sums
    return size < OFF
