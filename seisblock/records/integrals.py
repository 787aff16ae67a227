"""Exact velocity and displacement of a piecewise linear acceleration, chunk by chunk."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from seisblock.core.limits import CHUNK_SIZE
from seisblock.core.typing import FloatArray


def integrate(acceleration: FloatArray, dt: float) -> FloatArray:
    """Return the velocity at the samples, starting from rest; exact for a piecewise linear acceleration.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Samples, linear in between.
    dt : float, s
        Sampling interval.

    Returns
    -------
    (n,) array, m/s
        Zero at the first sample; the trapezoidal sum.
    """
    velocity = np.zeros(acceleration.size)
    for begin, piece in velocities(acceleration, dt):
        velocity[begin : begin + piece.size] = piece
    return velocity


def velocities(acceleration: FloatArray, dt: float, initial_velocity: float = 0.0) -> Iterator[tuple[int, FloatArray]]:
    """Yield chunks of :func:`integrate` as (index of the first sample, velocity); chunks overlap by one sample.

    Parameters
    ----------
    acceleration, dt
        As in :func:`integrate`.
    initial_velocity : float, m/s
        Added to every velocity.
    """
    carry = 0.0
    for begin, end in _blocks(acceleration.size):
        # the last sample of a chunk is the first of the next
        velocity = _velocity_block(acceleration[begin : end + 1], dt, carry)
        carry = float(velocity[-1])
        # added after the carry is stored, so that it enters once
        velocity += initial_velocity
        yield begin, velocity


def integrate_twice(acceleration: FloatArray, dt: float, initial_velocity: float = 0.0) -> FloatArray:
    """Return the displacement at the samples, exact for a piecewise linear acceleration (a cubic in each interval).

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Samples, linear in between.
    dt : float, s
        Sampling interval.
    initial_velocity : float, m/s
        Velocity at the first sample.

    Returns
    -------
    (n,) array, m
        Zero at the first sample.
    """
    displacement = np.zeros(acceleration.size)
    for begin, piece in displacements(acceleration, dt, initial_velocity):
        displacement[begin : begin + piece.size] = piece
    return displacement


def displacements(acceleration: FloatArray, dt: float, initial_velocity: float = 0.0) -> Iterator[tuple[int, FloatArray]]:
    """Yield chunks of :func:`integrate_twice` from the second sample on, as (index of the first sample, displacement).

    Parameters
    ----------
    acceleration, dt, initial_velocity
        As in :func:`integrate_twice`.
    """
    carry = 0.0
    for begin, velocity in velocities(acceleration, dt, initial_velocity):
        a = acceleration[begin : begin + velocity.size]
        # exact double integral of a linear acceleration over each interval
        steps = dt * velocity[:-1] + dt**2 / 6.0 * (2.0 * a[:-1] + a[1:])
        steps[0] += carry
        np.cumsum(steps, out=steps)
        carry = float(steps[-1])
        yield begin + 1, steps


def _velocity_block(acceleration: FloatArray, dt: float, initial: float) -> FloatArray:
    """Return the velocity at consecutive samples from the velocity `initial` at the first."""
    velocity = np.empty(acceleration.size)
    velocity[0] = initial
    steps = 0.5 * dt * (acceleration[1:] + acceleration[:-1])
    # the carry enters the cumulative sum, so the result does not depend on the chunk size
    steps[0] += initial
    np.cumsum(steps, out=velocity[1:])
    return velocity


def _blocks(samples: int) -> Iterator[tuple[int, int]]:
    """Yield first and last sample of chunks that share their end samples."""
    for begin in range(0, samples - 1, CHUNK_SIZE):
        yield begin, min(begin + CHUNK_SIZE, samples - 1)
