"""Exact propagation of a block on corner springs from sample to sample while no corner opens or closes.

In one contact state the block is a linear system under a piecewise linear ground motion, M q'' + C q' + K q = -M (f + t s) with the
coordinates q = (z, b theta_y, b theta_x, x, y) ([Okumura1987]_ eq. (1)). Its solution over a step is a matrix product (derived here: part
of the exponential of the system augmented by load and slope). The interior of a step is bounded (derived here): r = q'' satisfies the
homogeneous damped equation, so that e^2 = r'^T M r' + r^T K r never grows, and abs(q''') <= e / sqrt(M) in each coordinate. A quantity u
leaves the chord between two samples by at most h^2/8 max abs(u''), with abs(u'') <= max(abs(u''_0), abs(u''_1)) + h/2 max abs(u''').
Steps in which a corner could cross, or a new extremum could lie inside, are left to the power series.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from seisblock._jit import kernel, types
from seisblock.bodies.spring_block import CORNER_SIGNS, SpringBlock
from seisblock.core.typing import FloatArray
from seisblock.dynamics.array_types import MATRIX, READ_ONLY_MATRIX, VECTOR
from seisblock.dynamics.extrema import HIGHEST, LOWEST, update_extrema
from seisblock.dynamics.model_api import SKIP
from seisblock.models.uplift.constants import (
    ALL_CORNERS,
    ALPHA,
    CX,
    CY,
    CZ,
    GAMMA,
    GLUED,
    GRAVITY,
    JX,
    JY,
    KX,
    KY,
    KZ,
    PROPAGATORS,
    STEP,
    SUBSTEPS,
    TURN_X,
    TURN_Y,
    VX,
    VY,
    F,
    U,
    W,
    X,
    Y,
)

_t = types()

MAX_PHASE, MAX_SUBSTEPS = 1.0, 64
"""Largest phase of the highest mode per step, rad: longer steps leave most samples undecided. Most steps per sample."""

N_COORDINATES, N_COLUMNS = 5, 16
"""Coordinates q; columns of a propagator: q, q', three loads, three slopes."""

SIZE = 2 * N_COORDINATES * N_COLUMNS


@kernel(_t.UniTuple(_t.float64, 10)(VECTOR, VECTOR), inline=True)
def coordinates(y, p):
    """Return the coordinates z, b theta_y, b theta_x, x, y of a state and their rates."""
    # sums of differences are exactly zero for equal corner motions
    return (
        0.25 * ((y[U] + y[U + 1]) + (y[U + 2] + y[U + 3])),
        -0.5 * ((y[U] - y[U + 2]) + (y[U + 1] - y[U + 3])) / p[GAMMA],
        0.5 * ((y[U] - y[U + 1]) + (y[U + 2] - y[U + 3])),
        y[X],
        y[Y],
        0.25 * ((y[W] + y[W + 1]) + (y[W + 2] + y[W + 3])),
        -0.5 * ((y[W] - y[W + 2]) + (y[W + 1] - y[W + 3])) / p[GAMMA],
        0.5 * ((y[W] - y[W + 1]) + (y[W + 2] - y[W + 3])),
        y[VX],
        y[VY],
    )


@kernel(_t.float64(VECTOR, _t.int64, _t.int64, _t.float64, _t.float64), inline=True)
def _force(p, closed, i, u, w):
    """Return the force of corner `i` over the mass: an open corner keeps its horizontal spring only."""
    return -(p[KZ] * u + p[CZ] * w) if (closed >> i) & 1 else 0.0


@kernel(_t.UniTuple(_t.float64, 5)(VECTOR, _t.float64, _t.float64, _t.int64, *(10 * (_t.float64,))), inline=True)
def restoring(p, per_jx, per_jy, closed, z, b, a, x, y, z_rate, b_rate, a_rate, x_rate, y_rate):
    """Return -M^-1 (K q + C q'), the accelerations from springs and dashpots of a contact state."""
    half_alpha, half_gamma = 0.5 * p[ALPHA], 0.5 * p[GAMMA]
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
    return (forces[0] + forces[1]) + (forces[2] + forces[3]), moment_y * per_jy, moment_x * per_jx, push_x, push_y


@kernel(_t.UniTuple(_t.float64, 2)(READ_ONLY_MATRIX, VECTOR, _t.int64, _t.int64, _t.float64), inline=True)
def _load(acceleration, gains, row, sample, dt):
    """Return the ground acceleration at a sample and its slope; rows with a zero factor are not read."""
    if gains[row] == 0.0:
        return 0.0, 0.0
    first = gains[row] * acceleration[row, sample]
    return first, (gains[row] * acceleration[row, sample + 1] - first) / dt


@kernel(_t.boolean(MATRIX, _t.int64, _t.float64, _t.float64, _t.float64), inline=True)
def _is_inside(extrema, i, first, last, excess):
    """Return True if state `i` has no new extremum inside a step, at whose ends it has these values."""
    return max(first, last) + excess <= extrema[i, HIGHEST] and min(first, last) - excess >= extrema[i, LOWEST]


@kernel(SKIP)
def propagate(mode, acceleration, gains, sample, p, y, extrema, c, start_time):
    """Advance the state to the next sample if no corner opens or closes before it and no extremum lies inside; return its number."""
    closed, gamma, h = mode & ALL_CORNERS, p[GAMMA], p[STEP]
    substeps, kz, cz, jx, jy, alpha, kx, ky = int(p[SUBSTEPS]), p[KZ], p[CZ], p[JX], p[JY], p[ALPHA], p[KX], p[KY]
    if substeps == 0:
        return sample
    # with all corners in contact the coordinates count from static equilibrium, where rest is exactly zero
    settlement, weight = (p[GRAVITY] / (4.0 * kz), 0.0) if closed == ALL_CORNERS else (0.0, p[GRAVITY])
    z0, b0, a0, x0, y0, z0_rate, b0_rate, a0_rate, x0_rate, y0_rate = coordinates(y, p)
    z0 += settlement
    load_x, slope_x = _load(acceleration, gains, 0, sample, h * substeps)
    load_y, slope_y = _load(acceleration, gains, 1, sample, h * substeps)
    load_z, slope_z = _load(acceleration, gains, 2, sample, h * substeps)
    load_z += weight
    matrix, bow = PROPAGATORS + closed * SIZE, 0.125 * h * h
    corner_lever = np.sqrt(1.0 + 0.25 * gamma * gamma / jy + 0.25 / jx)
    for part in range(substeps):
        # second and third derivatives at the start, and the energy of the former, which bounds the latter over the step
        z2, b2, a2, x2, y2 = restoring(p, 1.0 / jx, 1.0 / jy, closed, z0, b0, a0, x0, y0, z0_rate, b0_rate, a0_rate, x0_rate, y0_rate)
        z2, x2, y2 = z2 - load_z, x2 - load_x, y2 - load_y
        z3, b3, a3, x3, y3 = restoring(p, 1.0 / jx, 1.0 / jy, closed, z0_rate, b0_rate, a0_rate, x0_rate, y0_rate, z2, b2, a2, x2, y2)
        z3, x3, y3 = z3 - slope_z, x3 - slope_x, y3 - slope_y
        energy = z3 * z3 + jy * b3 * b3 + jx * a3 * a3 + x3 * x3 + y3 * y3
        energy += kx * (x2 - 0.5 * alpha * b2) ** 2 + ky * (y2 + 0.5 * alpha * a2) ** 2
        for i in range(4):
            sx, sy = 0.5 * gamma if i < 2 else -0.5 * gamma, 0.5 if i % 2 == 0 else -0.5
            energy += kz * (z2 - sx * b2 + sy * a2) ** 2 if (closed >> i) & 1 else 0.0
        jerk = np.sqrt(energy)
        c[0, 0], c[0, 1], c[0, 2], c[0, 3], c[0, 4] = z0, b0, a0, x0, y0
        c[0, 5], c[0, 6], c[0, 7], c[0, 8], c[0, 9] = z0_rate, b0_rate, a0_rate, x0_rate, y0_rate
        c[0, 10], c[0, 11], c[0, 12], c[0, 13], c[0, 14], c[0, 15] = load_z, load_x, load_y, slope_z, slope_x, slope_y
        z1 = b1 = a1 = x1 = y1 = z1_rate = b1_rate = a1_rate = x1_rate = y1_rate = 0.0
        for k in range(N_COLUMNS):
            v, column = c[0, k], matrix + 10 * k
            z1 += p[column] * v
            b1 += p[column + 1] * v
            a1 += p[column + 2] * v
            x1 += p[column + 3] * v
            y1 += p[column + 4] * v
            z1_rate += p[column + 5] * v
            b1_rate += p[column + 6] * v
            a1_rate += p[column + 7] * v
            x1_rate += p[column + 8] * v
            y1_rate += p[column + 9] * v
        load_z, load_x, load_y = load_z + slope_z * h, load_x + slope_x * h, load_y + slope_y * h
        z4, b4, a4, x4, y4 = restoring(p, 1.0 / jx, 1.0 / jy, closed, z1, b1, a1, x1, y1, z1_rate, b1_rate, a1_rate, x1_rate, y1_rate)
        z4, x4, y4 = z4 - load_z, x4 - load_x, y4 - load_y
        time = start_time + (part + 1) * h
        passes = True
        third = jerk * corner_lever
        for i in range(4):
            sx, sy = 0.5 * gamma if i < 2 else -0.5 * gamma, 0.5 if i % 2 == 0 else -0.5
            u0, u1 = z0 - sx * b0 + sy * a0 - settlement, z1 - sx * b1 + sy * a1 - settlement
            w0, w1 = z0_rate - sx * b0_rate + sy * a0_rate, z1_rate - sx * b1_rate + sy * a1_rate
            second = max(abs(z2 - sx * b2 + sy * a2), abs(z4 - sx * b4 + sy * a4)) + 0.5 * h * third
            # a rate that stays on one side of zero leaves the values between those at the ends
            is_monotone = w0 * w1 > 0.0 and min(abs(w0), abs(w1)) > bow * third
            excess = 0.0 if is_monotone else bow * second
            # of the linear system only the largest rise is used
            if mode == GLUED:
                passes &= is_monotone or max(u0, u1) + excess <= extrema[U + i, HIGHEST]
                continue
            passes &= is_monotone or _is_inside(extrema, U + i, u0, u1, excess)
            if (closed >> i) & 1:
                passes &= max(u0, u1) + excess < 0.0
                passes &= _is_inside(extrema, F + i, -(kz * u0 + cz * w0), -(kz * u1 + cz * w1), bow * (kz * second + cz * third))
            else:
                passes &= min(u0, u1) - excess > 0.0
        # a rotation that does not move at all, as under shaking along one axis, has no bow
        third = jerk / np.sqrt(jy) if b2 != 0.0 or b3 != 0.0 or b4 != 0.0 else 0.0
        passes &= (
            mode == GLUED
            or (b0_rate * b1_rate > 0.0 and min(abs(b0_rate), abs(b1_rate)) > bow * third)
            or _is_inside(extrema, TURN_Y, b0, b1, bow * (max(abs(b2), abs(b4)) + 0.5 * h * third))
        )
        third = jerk / np.sqrt(jx) if a2 != 0.0 or a3 != 0.0 or a4 != 0.0 else 0.0
        passes &= (
            mode == GLUED
            or (a0_rate * a1_rate > 0.0 and min(abs(a0_rate), abs(a1_rate)) > bow * third)
            or _is_inside(extrema, TURN_X, a0, a1, bow * (max(abs(a2), abs(a4)) + 0.5 * h * third))
        )
        if not passes:
            return sample
        z0, b0, a0, x0, y0, z0_rate, b0_rate, a0_rate, x0_rate, y0_rate = z1, b1, a1, x1, y1, z1_rate, b1_rate, a1_rate, x1_rate, y1_rate
        for i in range(4):
            sx, sy = 0.5 * gamma if i < 2 else -0.5 * gamma, 0.5 if i % 2 == 0 else -0.5
            u, w = z0 - sx * b0 + sy * a0 - settlement, z0_rate - sx * b0_rate + sy * a0_rate
            update_extrema(extrema, U + i, u, time)
            if part == substeps - 1:
                y[U + i], y[W + i], y[F + i] = u, w, -(kz * u + cz * w) if (closed >> i) & 1 else 0.0
        update_extrema(extrema, TURN_Y, b0, time)
        update_extrema(extrema, TURN_X, a0, time)
    y[TURN_Y], y[TURN_X], y[X], y[Y], y[VX], y[VY] = b0, a0, x0, y0, x0_rate, y0_rate
    return sample + 1


def propagators(bodies: Sequence[SpringBlock], dt: float) -> FloatArray:
    """Return the parameters from ``SUBSTEPS`` on, one row per body: steps per sample, propagators of the 16 contact states."""
    m = len(bodies)
    frequency, two_zeta = np.array([body.omega for body in bodies]), 2.0 * np.array([body.damping for body in bodies])
    geometry = np.array([(0.5 * body.alpha, 0.5 * body.gamma, body.inertia[1], body.inertia[0]) for body in bodies])
    half_alpha, half_gamma, jy, jx = geometry.T
    one, zero = np.ones(m), np.zeros(m)
    mass = np.stack([one, jy, jx, one, one], axis=1)
    corners = np.stack([np.stack([one, -sx * half_gamma, 0.5 * sy * one, zero, zero], axis=1) for sx, sy in CORNER_SIGNS], axis=1)
    base = np.stack([np.stack([zero, -half_alpha, zero, one, zero], axis=1), np.stack([zero, zero, half_alpha, zero, one], axis=1)], axis=1)
    in_contact = np.arange(ALL_CORNERS + 1)[:, None] >> np.arange(4) & 1
    vertical = np.einsum("si,mij,mik->msjk", in_contact, corners, corners)
    sideways = np.einsum("mdj,mdk->mdjk", base, base)
    k_side, k_up = frequency[:, :2] ** 2, frequency[:, 2, None, None, None] ** 2 / 4.0
    stiffness = np.einsum("md,mdjk->mjk", k_side, sideways)[:, None] + k_up * vertical
    damping = np.einsum("md,mdjk->mjk", two_zeta[:, None] * frequency[:, :2], sideways)[:, None]
    damping = damping + (two_zeta * frequency[:, 2] / 4.0)[:, None, None, None] * vertical
    # highest frequency: that of full contact, which has the most springs
    scale = np.sqrt(mass)
    highest = np.sqrt(np.linalg.eigvalsh(stiffness[:, ALL_CORNERS] / (scale[:, :, None] * scale[:, None, :]))[:, -1])
    substeps = np.ceil(highest * dt / MAX_PHASE)
    substeps[substeps > MAX_SUBSTEPS] = 0.0
    step = dt / np.maximum(substeps, 1.0)
    # augmented system in units of the step: q, q' h, load h^2, slope h^3, so that all entries are of order one
    n, h = N_COORDINATES, step[:, None, None, None]
    system = np.zeros((m, ALL_CORNERS + 1, N_COLUMNS, N_COLUMNS))
    system[:, :, :n, n : 2 * n] = np.eye(n)
    system[:, :, n : 2 * n, :n] = -h * h * stiffness / mass[:, None, :, None]
    system[:, :, n : 2 * n, n : 2 * n] = -h * damping / mass[:, None, :, None]
    for k, coordinate in enumerate((0, 3, 4)):
        system[:, :, n + coordinate, 2 * n + k] = -1.0
        system[:, :, 2 * n + k, 2 * n + 3 + k] = 1.0
    exponential = _exponential(system)[:, :, : 2 * n]
    powers = np.repeat([0.0, 1.0, 2.0, 3.0], [n, n, 3, 3])
    units = step[:, None] ** powers
    exponential *= units[:, None, None, :] / units[:, None, : 2 * n, None]
    return np.column_stack([substeps, step, np.swapaxes(exponential, 2, 3).reshape(m, -1)])


def _exponential(matrices: FloatArray) -> FloatArray:
    """Return the exponentials of matrices by scaling and squaring of the power series; unlike scipy's, exact zeros remain zero."""
    norm = np.abs(matrices).sum(axis=-1).max(initial=1e-300)
    squarings = max(int(np.ceil(np.log2(norm / 0.25))), 0)
    scaled = matrices / 2.0**squarings
    identity = np.eye(matrices.shape[-1])
    # 0.25^13 / 13! is below round-off
    result = identity + scaled / 12.0
    for k in range(11, 0, -1):
        result = identity + scaled @ result / k
    for _ in range(squarings):
        result = result @ result
    return result
