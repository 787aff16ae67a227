"""Motions that make a block on springs lift."""

from __future__ import annotations

import numpy as np

from seisblock.models.uplift.harmonic import shaking_direction
from seisblock.records.motion import Motion


def shaking(duration: float, dt: float, *, peaks: tuple[float, float, float] = (6.0, 5.0, 3.0), seed: int = 3) -> Motion:
    """Return smooth noise under a bell, with these peaks along, across and up, m/s^2."""
    n = round(duration / dt) + 1
    time = dt * np.arange(n)
    rng = np.random.default_rng(seed)
    rows = np.zeros((3, n))
    for row in rows:
        for frequency in np.linspace(0.6, 5.0, 12):
            row += rng.standard_normal() * np.sin(2 * np.pi * (frequency * time + rng.random()))
    rows *= np.sin(np.pi * time / time[-1])
    rows *= np.array(peaks)[:, None] / np.abs(rows).max(axis=1, keepdims=True)
    return Motion(rows, dt, name="EW")


def harmonic(omega: float, amplitude: float, phi_deg: float, rho_deg: float) -> Motion:
    """Return a sine in a direction, with 30 cycles of smooth ramp and 20 held."""
    ramp, hold, per_cycle = 30, 20, 200
    n = (ramp + hold) * per_cycle + 1
    phase = 2 * np.pi * np.arange(n) / per_cycle
    envelope = 0.5 - 0.5 * np.cos(np.pi * np.minimum(phase / (2 * np.pi * ramp), 1.0))
    return Motion(amplitude * np.outer(shaking_direction(phi_deg, rho_deg), envelope * np.sin(phase)), 2 * np.pi / omega / per_cycle)
