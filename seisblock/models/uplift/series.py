"""Equations of a block on corner springs in one contact state, and their power series in time.

Coordinates and states: see :mod:`~seisblock.models.uplift.model`.
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.dynamics.model_api import SERIES
from seisblock.models.uplift.constants import (
    ALL_CORNERS,
    CX,
    CY,
    CZ,
    GRAVITY,
    HALF_ALPHA,
    HALF_GAMMA,
    KX,
    KY,
    KZ,
    PER_JX,
    PER_JY,
    SETTLEMENT,
    TURN_X,
    TURN_Y,
    VA,
    VB,
    VX,
    VY,
    VZ,
    X,
    Y,
    Z,
)

_t = types()


@kernel(_t.UniTuple(_t.float64, 2)(VECTOR, _t.int64), inline=True)
def levers(p, i):
    """Return the distances of corner `i` from the axes, over the depth: what its height loses by b theta_y and gains by b theta_x."""
    return p[HALF_GAMMA] if i < 2 else -p[HALF_GAMMA], 0.5 if i % 2 == 0 else -0.5


SUMS = _t.UniTuple(_t.float64, 6)
"""Sums over the corners in contact of 1, s_x, s_y, s_x^2, s_x s_y, s_y^2 with the levers s_x and s_y."""


@kernel(SUMS(VECTOR, _t.int64), inline=True)
def contact_sums(p, closed):
    """Return the sums of levers over the corners in contact; those that cancel are exactly zero."""
    n = x = y = xx = xy = yy = 0.0
    for i in range(4):
        if (closed >> i) & 1:
            sx, sy = levers(p, i)
            n, x, y, xx, xy, yy = n + 1.0, x + sx, y + sy, xx + sx * sx, xy + sx * sy, yy + sy * sy
    return n, x, y, xx, xy, yy


@kernel(_t.UniTuple(_t.float64, 5)(VECTOR, SUMS, *(10 * (_t.float64,))), inline=True)
def restoring(p, sums, z, b, a, x, y, z_rate, b_rate, a_rate, x_rate, y_rate):
    """Return -M^-1 (K q + C q'), the accelerations from springs and dashpots of a contact state."""
    n, sum_x, sum_y, sum_xx, sum_xy, sum_yy = sums
    half_alpha, kz, cz = p[HALF_ALPHA], p[KZ], p[CZ]
    # the springs attach at the base, half a height below the centre of gravity: [Okumura1987]_ eq. (1), its second line corrected
    # to y + (H/2) theta_x
    push_x = -p[KX] * (x - half_alpha * b) - p[CX] * (x_rate - half_alpha * b_rate)
    push_y = -p[KY] * (y + half_alpha * a) - p[CY] * (y_rate + half_alpha * a_rate)
    # an open corner keeps its horizontal spring only
    height, tilt_y, tilt_x = kz * z + cz * z_rate, kz * b + cz * b_rate, kz * a + cz * a_rate
    moment_y = sum_x * height - sum_xx * tilt_y + sum_xy * tilt_x - half_alpha * push_x
    moment_x = sum_xy * tilt_y - sum_y * height - sum_yy * tilt_x + half_alpha * push_y
    return sum_x * tilt_y - n * height - sum_y * tilt_x, moment_y * p[PER_JY], moment_x * p[PER_JX], push_x, push_y


@kernel(_t.UniTuple(_t.float64, 2)(VECTOR, _t.int64), inline=True)
def z_datum(p, closed):
    """Return the height above static equilibrium from which the coordinate z counts, and gravity as a load on it.

    With all corners in contact it counts from static equilibrium, where rest is exactly zero.
    """
    return (0.0, 0.0) if closed == ALL_CORNERS else (p[SETTLEMENT], p[GRAVITY])


@kernel(SERIES)
def taylor(mode, y, f, p, order, c, g):
    """Write the power series of the five coordinates to the rows of these states; return the degree."""
    closed = mode & ALL_CORNERS
    sums = contact_sums(p, closed)
    datum, weight = z_datum(p, closed)
    z, b, a, x, y_k = y[Z] - datum, y[TURN_Y], y[TURN_X], y[X], y[Y]
    z_rate, b_rate, a_rate, x_rate, y_rate = y[VZ], y[VB], y[VA], y[VX], y[VY]
    load_z, load_x, load_y = f[2, 0] + weight, f[0, 0], f[1, 0]
    slope_z, slope_x, slope_y = f[2, 1], f[0, 1], f[1, 1]
    for k in range(order + 1):
        c[TURN_X, k], c[TURN_Y, k], c[X, k], c[Y, k], c[Z, k] = a, b, x, y_k, z
        z_next, b_next, a_next, x_next, y_next = restoring(p, sums, z, b, a, x, y_k, z_rate, b_rate, a_rate, x_rate, y_rate)
        step = 1.0 / (k + 1)
        z, b, a, x, y_k = z_rate * step, b_rate * step, a_rate * step, x_rate * step, y_rate * step
        z_rate, x_rate, y_rate = (z_next - load_z) * step, (x_next - load_x) * step, (y_next - load_y) * step
        b_rate, a_rate = b_next * step, a_next * step
        # the linear ground motion enters at orders 0 and 1
        load_z, load_x, load_y = slope_z, slope_x, slope_y
        slope_z = slope_x = slope_y = 0.0
    c[Z, 0] += datum
    return order


@kernel(_t.void(MATRIX, _t.int64, _t.float64, VECTOR), inline=True)
def evaluate(c, degree, t, end):
    """Write the values and rates of the power series of the coordinates at `t` to `end`."""
    a, b, x, y, z = c[TURN_X, degree], c[TURN_Y, degree], c[X, degree], c[Y, degree], c[Z, degree]
    a_rate = b_rate = x_rate = y_rate = z_rate = 0.0
    for k in range(degree - 1, -1, -1):
        a_rate, b_rate, x_rate, y_rate, z_rate = a_rate * t + a, b_rate * t + b, x_rate * t + x, y_rate * t + y, z_rate * t + z
        a, b, x, y, z = a * t + c[TURN_X, k], b * t + c[TURN_Y, k], x * t + c[X, k], y * t + c[Y, k], z * t + c[Z, k]
    end[Z], end[TURN_Y], end[TURN_X], end[X], end[Y] = z, b, a, x, y
    end[VZ], end[VB], end[VA], end[VX], end[VY] = z_rate, b_rate, a_rate, x_rate, y_rate
