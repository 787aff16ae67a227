"""Ground velocity and displacement by integration, with one baseline for PGV, PGD, figures and files."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from seisblock.core._display import DisplayMixin
from seisblock.core.typing import FloatArray
from seisblock.records.filters import highpass_samples
from seisblock.records.integrals import displacements, integrate, integrate_twice

HIGHPASS_HZ = 0.05
"""Default corner of the high-pass before integration, Hz: it passes near-fault pulses of up to 10 s and removes drift."""


@dataclass(frozen=True, eq=False, repr=False)
class GroundHistory(DisplayMixin):
    """Velocity and displacement of the ground, and the acceleration from which they are integrated.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration after the high-pass.
    dt : float, s
        Sampling interval.
    initial_velocity : float, m/s
        Velocity at the first sample.
    """

    acceleration: FloatArray
    dt: float
    initial_velocity: float

    @cached_property
    def velocity(self) -> FloatArray:
        """Exact integral of the acceleration minus its mean over the record, (n,), m/s."""
        velocity = integrate(self.acceleration, self.dt)
        velocity += self.initial_velocity
        return velocity

    @cached_property
    def displacement(self) -> FloatArray:
        """Exact integral of the velocity, (n,), m; zero at both ends."""
        return integrate_twice(self.acceleration, self.dt, self.initial_velocity)


def centred_history(acceleration: FloatArray, dt: float) -> GroundHistory:
    """Return the history of an analytic motion: unfiltered, with the middle of the range of its velocity at zero (derived here).

    The velocity of a sine that starts from rest is (A/w)(1 - cos wt) between 0 and 2 A/w: without its mean, PGV is A/w for any
    duration from half a period on, whole cycles or not, and the displacement is (A/w^2) sin wt.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
    dt : float, s

    Examples
    --------
    >>> import numpy as np
    >>> history = centred_history(np.sin(np.linspace(0.0, 3.3 * np.pi, 6601)), np.pi / 2000)
    >>> round(float(np.abs(history.velocity).max()), 6), round(float(np.abs(history.displacement).max()), 6)
    (1.0, 1.0)
    """
    velocity = integrate(acceleration, dt)
    return GroundHistory(acceleration, dt, -0.5 * float(velocity.max() + velocity.min()))


def ground_history(acceleration: FloatArray, dt: float, *, highpass_hz: float | None = HIGHPASS_HZ) -> GroundHistory:
    """Integrate a ground acceleration to velocity and displacement on the baseline used by all measures.

    The acceleration is high-passed (:func:`seisblock.records.filters.highpass_samples`, which removes any offset) and integrated exactly
    as a piecewise linear function; the mean velocity over the record is removed. The velocity of a sine that starts from rest is
    (A/w)(1 - cos wt): with its mean, PGA/(2 pi PGV) would be half the frequency ([Furukawa2009]_ section 3(5)e, method 1).

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration, linear between samples.
    dt : float, s
        Sampling interval.
    highpass_hz : float or None, Hz
        Corner of the high-pass; None or 0 for no filter.

    Returns
    -------
    GroundHistory
        Filtered acceleration (m/s^2), velocity (m/s), displacement (m).

    Raises
    ------
    ParameterError
        If the corner is negative or above the Nyquist frequency.

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.measures import ground_history
    >>> sine = np.sin(2.0 * np.pi * np.arange(1001) * 0.01)
    >>> history = ground_history(sine, 0.01, highpass_hz=None)
    >>> round(float(abs(history.velocity).max()), 3)
    0.159
    """
    filtered_acceleration = highpass_samples(acceleration, dt, highpass_hz) if highpass_hz else acceleration
    return ground_history_of(filtered_acceleration, dt)


def ground_history_of(acceleration: FloatArray, dt: float) -> GroundHistory:
    """Return the history of unfiltered samples: :func:`ground_history` without the high-pass ([Furukawa2009]_ section 3(5)e)."""
    # the exact mean of the piecewise quadratic velocity: the displacement then ends at zero
    end = 0.0
    for _, piece in displacements(acceleration, dt):
        end = float(piece[-1])
    drift = end / ((acceleration.size - 1) * dt)
    return GroundHistory(acceleration, dt, -drift)
