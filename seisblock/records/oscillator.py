"""Exact time stepping of a damped linear oscillator under piecewise linear ground acceleration."""

from __future__ import annotations

import math

import numpy as np

from seisblock._jit import kernel
from seisblock.core.limits import CHUNK_SIZE
from seisblock.core.typing import FloatArray


def exact_step(dt: float, omega: float, damping: float) -> FloatArray:
    """Return the step matrix for displacement, velocity and the accelerations at both ends, (4, 4), first two rows used.

    u'' + 2 h w u' + w^2 u = -a(t) with a(t) linear is a linear system in (u, u', a, a'); its matrix exponential is the exact step
    ([NigamJennings1969]_ eq. (2.7)).

    Parameters
    ----------
    dt : float, s
        Sampling interval.
    omega : float, rad/s
        Undamped natural frequency.
    damping : float
        Damping ratio, 0 <= damping < 1.
    """
    system = np.zeros((4, 4))
    system[0, 1] = system[2, 3] = 1.0
    # the ground acceleration and its slope are states of the system, so that one matrix exponential holds the forced
    # response as well
    system[1, :3] = -(omega**2), -2.0 * damping * omega, -1.0
    step = _matrix_exponential(system * dt)
    # the fourth variable is the slope (a1 - a0)/dt
    step[:2, 3] /= dt
    step[:2, 2] -= step[:2, 3]  # from (a, a') to the samples at both ends
    return step


def oscillator_path(ground: FloatArray, dt: float, omega: float, damping: float) -> tuple[FloatArray, FloatArray]:
    """Return relative displacement, m, and velocity, m/s, of an oscillator starting from rest, (n,) each.

    Exact for a piecewise linear ground acceleration ([NigamJennings1969]_ eq. (2.7)).

    Parameters
    ----------
    ground : (n,) array, m/s^2
        Acceleration of the ground.
    dt, omega, damping
        As in :func:`exact_step`.
    """
    step = exact_step(dt, omega, damping)
    path = np.zeros((2, ground.size))
    for begin in range(0, max(ground.size - 1, 1), CHUNK_SIZE):
        # in chunks: an interrupt is handled between two kernel calls
        _integrate(
            step, ground[begin : begin + CHUNK_SIZE + 1], path[0, begin : begin + CHUNK_SIZE + 1], path[1, begin : begin + CHUNK_SIZE + 1]
        )
    return path[0], path[1]


@kernel("void(float64[:, ::1], Array(float64, 1, 'C', readonly=True), float64[::1], float64[::1])")
def _integrate(step, ground, u, v):
    """Step an oscillator through the samples from the state at the first."""
    for k in range(ground.size - 1):
        forcing = step[0, 2] * ground[k] + step[0, 3] * ground[k + 1]
        u[k + 1] = step[0, 0] * u[k] + step[0, 1] * v[k] + forcing
        forcing = step[1, 2] * ground[k] + step[1, 3] * ground[k + 1]
        v[k + 1] = step[1, 0] * u[k] + step[1, 1] * v[k] + forcing


def _matrix_exponential(matrix: FloatArray) -> FloatArray:
    """Return the exponential of a small matrix by Taylor series with scaling and squaring."""
    # scipy.linalg.expm calls threaded BLAS and is about 100 times slower for a 4 x 4 matrix
    # scaling and squaring: the series converges to double precision for a norm of at most 1
    halvings = max(math.ceil(math.log2(max(float(np.abs(matrix).sum(axis=0).max()), 1.0))), 0)
    small = matrix / 2.0**halvings
    total = term = np.eye(matrix.shape[0])
    for k in range(1, 20):
        term = term @ small / k
        total = total + term
    for _ in range(halvings):
        total = total @ total
    return total
