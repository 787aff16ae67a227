"""Uplift by the engine's own loop: power series of all states in every sample, without propagators and bounds."""

from __future__ import annotations

from dataclasses import replace

from seisblock._jit import kernel, types
from seisblock.dynamics import hybrid
from seisblock.dynamics.array_types import VECTOR
from seisblock.dynamics.model_api import OFF, SERIES
from seisblock.models.uplift.constants import (
    ALL_CORNERS,
    CHANGES,
    CX,
    CY,
    CZ,
    FIRST,
    GLUED,
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
    F,
    U,
    X,
    Y,
    Z,
)
from seisblock.models.uplift.model import UPLIFT

_t = types()


@kernel(_t.float64(VECTOR, _t.int64, _t.int64, _t.float64, _t.float64))
def _force(p, closed, i, u, w):
    """Return the force of corner `i` over the mass: an open corner keeps its horizontal spring only."""
    return -(p[KZ] * u + p[CZ] * w) if (closed >> i) & 1 else 0.0


@kernel(_t.UniTuple(_t.float64, 5)(VECTOR, _t.int64, *(10 * (_t.float64,))))
def _restoring(p, closed, z, b, a, x, y, z_rate, b_rate, a_rate, x_rate, y_rate):
    """Return the accelerations from springs and dashpots, from the forces of each corner."""
    half_alpha, half_gamma = p[HALF_ALPHA], p[HALF_GAMMA]
    # the springs attach at the base, half a height below the centre of gravity: [Okumura1987]_ eq. (1), its second line corrected
    # to y + (H/2) theta_x
    push_x = -p[KX] * (x - half_alpha * b) - p[CX] * (x_rate - half_alpha * b_rate)
    push_y = -p[KY] * (y + half_alpha * a) - p[CY] * (y_rate + half_alpha * a_rate)
    forces = (
        _force(p, closed, 0, z - half_gamma * b + 0.5 * a, z_rate - half_gamma * b_rate + 0.5 * a_rate),
        _force(p, closed, 1, z - half_gamma * b - 0.5 * a, z_rate - half_gamma * b_rate - 0.5 * a_rate),
        _force(p, closed, 2, z + half_gamma * b + 0.5 * a, z_rate + half_gamma * b_rate + 0.5 * a_rate),
        _force(p, closed, 3, z + half_gamma * b - 0.5 * a, z_rate + half_gamma * b_rate - 0.5 * a_rate),
    )
    # sums of differences, which are exactly zero for equal corner motions
    moment_x = 0.5 * ((forces[0] - forces[1]) + (forces[2] - forces[3])) + half_alpha * push_y
    moment_y = -half_gamma * ((forces[0] - forces[2]) + (forces[1] - forces[3])) - half_alpha * push_x
    return (forces[0] + forces[1]) + (forces[2] + forces[3]), moment_y * p[PER_JY], moment_x * p[PER_JX], push_x, push_y


@kernel(SERIES)
def _series(mode, y, f, p, order, c, g):
    """Write the series of all states and of the guards; return the degree."""
    closed = mode & ALL_CORNERS
    z, b, a, x, y_k = y[Z] - p[SETTLEMENT], y[TURN_Y], y[TURN_X], y[X], y[Y]
    z_rate, b_rate, a_rate, x_rate, y_rate = y[VZ], y[VB], y[VA], y[VX], y[VY]
    c[CHANGES, 1] = c[FIRST, 1] = OFF
    for k in range(order + 1):
        for i in range(4):
            sx, sy = p[HALF_GAMMA] if i < 2 else -p[HALF_GAMMA], 0.5 if i % 2 == 0 else -0.5
            u, w = z - sx * b + sy * a, z_rate - sx * b_rate + sy * a_rate
            if k == 0:
                # a reset leaves corners at exactly zero
                u = y[U + i]
            c[U + i, k], c[F + i, k] = u, -(p[KZ] * u + p[CZ] * w) if (closed >> i) & 1 else 0.0
            g[i, k] = -u if (mode >> i) & 1 else u
        c[TURN_Y, k], c[TURN_X, k], c[X, k], c[Y, k] = b, a, x, y_k
        c[Z, k] = z + p[SETTLEMENT] if k == 0 else z
        c[VB, k], c[VA, k], c[VX, k], c[VY, k], c[VZ, k] = b_rate, a_rate, x_rate, y_rate, z_rate
        z_next, b_next, a_next, x_next, y_next = _restoring(p, closed, z, b, a, x, y_k, z_rate, b_rate, a_rate, x_rate, y_rate)
        if k == 0:
            z_next -= p[GRAVITY]
        if k < 2:
            z_next, x_next, y_next = z_next - f[2, k], x_next - f[0, k], y_next - f[1, k]
        step = 1.0 / (k + 1)
        z, b, a, x, y_k = z_rate * step, b_rate * step, a_rate * step, x_rate * step, y_rate * step
        z_rate, b_rate, a_rate, x_rate, y_rate = z_next * step, b_next * step, a_next * step, x_next * step, y_next * step
    for i in range(4 if mode == GLUED else 0):
        g[i, 0] = OFF
    return order


UPLIFT_SERIES = replace(UPLIFT, series=_series, advance=hybrid.advance)
