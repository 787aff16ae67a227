"""Bundles of synthetic stations in the layout of K-NET: an earthquake whose shaking decays with distance."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from tests.readers.files import knet, tar

EPICENTRE = (37.288, 138.870)
"""Of the header that :func:`~tests.readers.files.knet` writes, degrees north and east."""


def station_files(number: int, *, samples: int = 1200, place: tuple[float, float] | None = None, **header: str) -> dict[str, bytes]:
    """Return the three files of one station, weaker with distance; `place` is latitude and longitude."""
    rng = np.random.default_rng(number)
    north, east = place or (EPICENTRE[0] + rng.uniform(-1, 1), EPICENTRE[1] + rng.uniform(-1, 1))
    away = np.hypot(111.0 * (north - EPICENTRE[0]), 88.0 * (east - EPICENTRE[1]))
    t = 0.01 * np.arange(samples)
    code = f"SY{chr(65 + number // 1000)}{number % 1000:03d}"
    files = {}
    for direction, name in (("N-S", "NS"), ("E-W", "EW"), ("U-D", "UD")):
        row = np.exp(-(((t - 0.4 * t[-1]) / 2.0) ** 2)) * np.convolve(rng.standard_normal(samples), np.hanning(25), "same")
        row *= (900.0 * np.exp(-away / 35.0) + 5.0) * (0.5 if name == "UD" else 1.0) / np.abs(row).max()
        position = {"Station Lat.": f"{north:.4f}", "Station Long.": f"{east:.4f}"}
        text = knet([int(gal * 1577) + 1000 for gal in row], direction=direction, station=code, **{**position, **header})
        files[f"{code}0410231756.{name}"] = text.encode()
    return files


def bundle(path: Path, count: int, *, damaged: tuple[int, ...] = (), samples: int = 1200) -> Path:
    """Write a bundle of stations, some with truncated files; return its path."""
    files: dict[str, bytes] = {}
    for number in range(count):
        computed = station_files(number, samples=samples)
        files |= {name: data[: len(data) // 2] for name, data in computed.items()} if number in damaged else computed
    path.write_bytes(tar(files, mode="w:gz"))
    return path
