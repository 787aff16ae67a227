"""What "the ground's velocity and displacement" mean here: one stated baseline for PGV, PGD, figures and files."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from seisblock.core.typing import FloatArray
from seisblock.records.filters import highpass_samples
from seisblock.records.integrals import displacements, integrate, integrate_twice

HIGHPASS_HZ = 0.05
"""Default corner of the high-pass behind velocity and displacement, Hz: near-fault pulses of up to 10 s pass, drift does not."""


@dataclass(frozen=True, eq=False)
class GroundHistory:
    """Velocity and displacement of the ground, with the acceleration they were integrated from.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        After the high-pass.
    dt : float, s
        Sampling interval.
    initial_velocity : float, m/s
        At the first sample.
    """

    acceleration: FloatArray
    dt: float
    initial_velocity: float

    @cached_property
    def velocity(self) -> FloatArray:
        """Its exact integral, less its mean over the record, (n,), m/s."""
        velocity = integrate(self.acceleration, self.dt)
        velocity += self.initial_velocity
        return velocity

    @cached_property
    def displacement(self) -> FloatArray:
        """The exact integral of that velocity, (n,), m: zero at both ends."""
        return integrate_twice(self.acceleration, self.dt, self.initial_velocity)


def ground_history(acceleration: FloatArray, dt: float, *, highpass_hz: float | None = HIGHPASS_HZ) -> GroundHistory:
    """Integrate a ground acceleration to velocity and displacement on the baseline that all measures share.

    High-pass (:func:`seisblock.records.filters.highpass_samples`, which leaves nothing of an offset), exact integral of the piecewise
    linear samples, mean of the velocity over the record removed. The mean matters: a sine that starts from rest has velocity
    (A/w)(1 - cos wt), and without removing it PGA/(2 pi PGV) would be half the frequency ([Furukawa2009]_ section 3(5)e, method 1).

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration, linear between samples.
    dt : float, s
        Sampling interval.
    highpass_hz : float or None, Hz
        Corner of the high-pass; None or 0 for none.

    Returns
    -------
    GroundHistory
        Filtered acceleration (m/s^2), velocity (m/s), displacement (m).

    Raises
    ------
    ParameterError
        If the corner is negative or beyond half the sampling rate.
    """
    filtered_acceleration = highpass_samples(acceleration, dt, highpass_hz) if highpass_hz else acceleration
    return ground_history_of(filtered_acceleration, dt)


def ground_history_of(acceleration: FloatArray, dt: float) -> GroundHistory:
    """Return the history of samples that need no filter: :func:`ground_history` without its first step ([Furukawa2009]_ section 3(5)e)."""
    # the trapezoidal mean of a quadratic velocity, plus its correction: the displacement then ends at zero exactly
    end = 0.0
    for _, piece in displacements(acceleration, dt):
        end = float(piece[-1])
    drift = end / ((acceleration.size - 1) * dt)
    return GroundHistory(acceleration, dt, -drift)
