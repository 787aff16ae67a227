"""Propagators of a block on corner springs: matrices of the exact solution over a step, one for each contact state.

With value and slope of a linear ground motion, a step is a product with part of the exponential of the augmented system (derived here).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from seisblock.bodies.spring_block import CORNER_SIGNS, SpringBlock
from seisblock.core.typing import FloatArray
from seisblock.models.uplift.constants import ALL_CORNERS

MAX_PHASE = 1.0
"""Largest phase of the highest mode per step, rad: longer steps leave most samples undecided, and their power series converge slowly."""

N_COORDINATES, N_COLUMNS = 5, 17
"""Coordinates; columns of a propagator: a constant, coordinates, rates, load and slope along x, y and z."""

MAX_DEGREE = 20
"""Largest degree of the power series of the coordinates."""

SIZE = 2 * N_COORDINATES * N_COLUMNS


def propagators(bodies: Sequence[SpringBlock], gravity: float, dt: float) -> FloatArray:
    """Return the parameters from ``SUBSTEPS`` on, one row per body: steps per sample, bounds, propagators of 16 contact states."""
    m = len(bodies)
    frequency, two_zeta = np.array([body.omega for body in bodies]), 2.0 * np.array([body.damping for body in bodies])
    geometry = np.array([(0.5 * body.alpha, 0.5 * body.gamma, body.inertia[1], body.inertia[0]) for body in bodies])
    half_alpha, half_gamma, jy, jx = geometry.T
    settlement = np.array([body.static_settlement(gravity) for body in bodies])
    one, zero = np.ones(m), np.zeros(m)
    mass = np.stack([jx, jy, one, one, one], axis=1)
    corners = np.stack([np.stack([0.5 * sy * one, -sx * half_gamma, zero, zero, one], axis=1) for sx, sy in CORNER_SIGNS], axis=1)
    base = np.stack([np.stack([zero, -half_alpha, one, zero, zero], axis=1), np.stack([half_alpha, zero, zero, one, zero], axis=1)], axis=1)
    in_contact = np.arange(ALL_CORNERS + 1)[:, None] >> np.arange(4) & 1
    vertical = np.einsum("si,mij,mik->msjk", in_contact, corners, corners)
    sideways = np.einsum("mdj,mdk->mdjk", base, base)
    k_side, k_up = frequency[:, :2] ** 2, frequency[:, 2, None, None, None] ** 2 / 4.0
    stiffness = np.einsum("md,mdjk->mjk", k_side, sideways)[:, None] + k_up * vertical
    damping = np.einsum("md,mdjk->mjk", two_zeta[:, None] * frequency[:, :2], sideways)[:, None]
    damping = damping + (two_zeta * frequency[:, 2] / 4.0)[:, None, None, None] * vertical
    # highest rates: those of full contact, which has the most springs and dashpots
    scale = np.sqrt(mass)
    scale = scale[:, :, None] * scale[:, None, :]
    k_max, c_max = (np.linalg.eigvalsh(matrix[:, ALL_CORNERS] / scale)[:, -1] for matrix in (stiffness, damping))
    substeps = np.maximum(np.ceil(np.maximum(np.sqrt(k_max), c_max) * dt / MAX_PHASE), 1.0)
    step = dt / substeps
    # augmented system in units of the step: q, q' h, load h^2, slope h^3, so that all entries are of order one
    n, h = N_COORDINATES, step[:, None, None, None]
    system = np.zeros((m, ALL_CORNERS + 1, 2 * n + 6, 2 * n + 6))
    system[:, :, :n, n : 2 * n] = np.eye(n)
    system[:, :, n : 2 * n, :n] = -h * h * stiffness / mass[:, None, :, None]
    system[:, :, n : 2 * n, n : 2 * n] = -h * damping / mass[:, None, :, None]
    for k in range(3):
        load = 2 * n + 2 * k
        system[:, :, n + 2 + k, load] = -1.0
        system[:, :, load, load + 1] = 1.0
    exponential = _exponential(system)[:, :, : 2 * n]
    powers = np.array([*n * [0.0], *n * [1.0], *3 * [2.0, 3.0]])
    units = step[:, None] ** powers
    exponential *= units[:, None, None, :] / units[:, None, : 2 * n, None]
    # gravity and the static settlement, which cancel with all corners in contact
    at_natural_length = np.zeros((m, 2 * n))
    at_natural_length[:, n - 1] = settlement
    constant = at_natural_length[:, None] + gravity * exponential[..., 2 * n + 4] - settlement[:, None, None] * exponential[..., n - 1]
    constant[:, ALL_CORNERS] = 0.0
    columns = np.concatenate([constant[..., None], exponential], axis=-1)
    fourth = np.sqrt(k_max + c_max * c_max)
    return np.column_stack([substeps, step, _degrees(fourth * step), fourth, np.swapaxes(columns, 2, 3).reshape(m, -1)])


def _degrees(phase: FloatArray) -> FloatArray:
    """Return the degrees of power series whose remainder, at most phase^(n - 2) 3!/(n + 1)! of the third term, is below round-off."""
    degrees = np.full(len(phase), MAX_DEGREE)
    for n in range(MAX_DEGREE - 1, 7, -1):
        degrees[phase ** (n - 2) * 6.0 / math.factorial(n + 1) < 2.0**-56] = n
    return degrees


def _exponential(matrices: FloatArray) -> FloatArray:
    """Return the exponentials of matrices, a group per body, by scaling and squaring of the power series.

    Unlike scipy's, exact zeros remain zero. Squarings are counted for each body, so that its bits do not depend on the others.
    """
    norm = np.abs(matrices).sum(axis=-1).max(axis=(1, 2))
    squarings = np.maximum(np.ceil(np.log2(norm / 0.25)), 0.0).astype(np.int64)
    scaled = matrices / 2.0 ** squarings[:, None, None, None]
    identity = np.eye(matrices.shape[-1])
    # 0.25^13 / 13! is below round-off
    result = identity + scaled / 12.0
    for k in range(11, 0, -1):
        result = identity + scaled @ result / k
    for n in range(squarings.max()):
        rows = squarings > n
        result[rows] = result[rows] @ result[rows]
    return result
