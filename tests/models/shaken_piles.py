"""Random piles of one to five stones, and shakings along three axes that move most of them and bring down half."""

import numpy as np

from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.records import Motion

DT, SAMPLES = 0.01, 800


def pile(rng, count):
    """Return stones, slender and squat, each off the centre of the one below, with a friction of 0.3 to 1."""
    stones = []
    width, depth = rng.uniform(0.2, 0.6, 2)
    for i in range(count):
        offset, on = (0.0, 0.0), "ground"
        if i > 0:
            width, depth = width * rng.uniform(0.6, 1.1), depth * rng.uniform(0.6, 1.1)
        last = i == count - 1
        height = (rng.uniform(0.3, 3.0) if last else rng.uniform(0.15, 1.5)) * min(width, depth)
        if i > 0:
            offset, on = (rng.uniform(-0.08, 0.08) * width, rng.uniform(-0.08, 0.08) * depth), f"s{i - 1}"
        stones.append(PileStone(f"s{i}", width, depth, height, offset=offset, on=on))
    return Pile("random", tuple(stones), mu=rng.uniform(0.3, 1.0))


def shaking(rng):
    """Return some three seconds of noise, up to 14 m/s^2 along, 12 across and 8 up."""
    time, f = DT * np.arange(SAMPLES), np.fft.rfftfreq(SAMPLES, DT)
    rows = []
    for peak, middle in (
        (rng.uniform(6, 14), rng.uniform(0.7, 2.5)),
        (rng.uniform(4, 12), rng.uniform(0.7, 2.5)),
        (rng.uniform(2, 8), 4.0),
    ):
        shape = f**2 / ((f**2 - middle**2) ** 2 + (1.2 * middle * f) ** 2 + 1e-9)
        values = np.fft.irfft(np.fft.rfft(rng.standard_normal(SAMPLES)) * shape, SAMPLES) * np.exp(-(((time - 3.0) / 1.5) ** 2))
        rows.append(values * peak / np.abs(values).max())
    return Motion(np.array(rows), DT)


def random_case(seed):
    """Return a pile and its shaking."""
    rng = np.random.default_rng(seed)
    return pile(rng, 1 + seed % 5), shaking(rng)
