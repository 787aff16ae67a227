"""A synthetic motion that passes exactly through given stretches: Gaussian simulation conditioned on them.

The prior is a stationary band-limited process times an envelope with a P and an S phase. Conditioning it on the stretches (and on ground
that is at rest in the end) gives the most plausible motion around them: it is continuous, and its velocity returns to zero.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

DT = 0.01
SAMPLES = 6000
ONSET_P, ONSET_S = 20.6, 23.4
REST_FROM = 50.0

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Stretch:
    """Values, m/s^2, that the motion takes from sample `first` on."""

    first: int
    values: Array


def envelope(p: float, s: float, noise: float = 0.004) -> Array:
    """Return the standard deviation of the prior, m/s^2: noise, a P phase of level `p`, an S phase of level `s`, a coda."""
    t = DT * np.arange(SAMPLES)
    rise_p = 1.0 / (1.0 + np.exp(-(t - ONSET_P) / 0.12))
    rise_s = 1.0 / (1.0 + np.exp(-(t - ONSET_S) / 0.45))
    after = np.clip(t - 28.2, 0.0, None)
    coda = 0.72 * np.exp(-after / 2.2) + 0.28 * np.exp(-after / 8.0)
    return noise + (p * rise_p * (1.0 - rise_s) + s * rise_s) * coda


def correlation(low: float, high: float) -> Array:
    """Return the autocorrelation of a process whose spectrum rises as f^2 below `low` Hz and falls as f^-6 above `high` Hz, (SAMPLES,)."""
    n = 16 * SAMPLES
    f = np.fft.rfftfreq(n, DT)
    spectrum = (f**2 / (f**2 + low**2)) / (1.0 + (f / high) ** 6)
    r = np.fft.irfft(spectrum, n)[:SAMPLES]
    return np.asarray(r / r[0])


def conditioned_motion(rng: np.random.Generator, sigma: Array, r: Array, stretches: list[Stretch]) -> Array:
    """Return one motion, m/s^2, that holds the stretches exactly and ends at rest."""
    n = 16 * SAMPLES
    spectrum = np.sqrt(np.maximum(np.fft.rfft(np.concatenate((r, np.zeros(n - 2 * SAMPLES + 1), r[:0:-1]))).real, 0.0))
    prior = sigma * np.fft.irfft(np.fft.rfft(rng.standard_normal(n)) * spectrum, n)[:SAMPLES]
    holding = np.concatenate([s.first + np.arange(s.values.size) for s in stretches] or [np.zeros(0, dtype=int)]).astype(int)
    expected = np.concatenate([s.values for s in stretches] or [np.zeros(0)])
    t = DT * np.arange(SAMPLES)
    moments = np.stack((np.full(SAMPLES, DT), DT * (t[-1] - t)))  # final velocity, final displacement
    lag = np.abs(np.arange(SAMPLES)[:, None] - holding[None, :])
    smoothed = np.fft.irfft(np.fft.rfft(sigma * moments, n) * spectrum**2, n)[:, :SAMPLES]  # r as a circulant matrix, applied
    cross = np.concatenate((sigma[:, None] * r[lag] * sigma[None, holding], (sigma * smoothed).T), axis=1)
    observed = np.concatenate((cross[holding], moments @ cross))
    observed[np.diag_indices_from(observed)] += np.concatenate((np.full(holding.size, 1e-8), (1e-10, 1e-10)))
    residual = np.concatenate((expected, (0.0, 0.0))) - np.concatenate((prior[holding], moments @ prior))
    motion = prior + cross @ np.linalg.solve(observed, residual)
    motion[holding] = expected
    return np.asarray(motion)


def velocity(acceleration: Array) -> Array:
    """Return the velocity, m/s, by the trapezoidal rule."""
    return np.asarray(np.concatenate(([0.0], np.cumsum(0.5 * DT * (acceleration[1:] + acceleration[:-1])))))
