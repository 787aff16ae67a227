"""Similarity: all lengths times s, times and steps times sqrt(s), the same accelerations: displacements times s, the same rotations."""

from __future__ import annotations

import math

import numpy as np
import pytest

from seisblock import Motion, Pile, PileStone, solve_stack
from seisblock.bodies.edge_wear import EdgeWear

STONES = {
    "boxes": [(0.6, 0.5, 0.4, "rectangular", 0.0), (0.5, 0.5, 0.5, "rectangular", 0.0), (0.35, 0.4, 0.6, "rectangular", 0.0)],
    "worn": [(0.7, 0.6, 0.4, "rectangular", 0.02), (0.5, 0.5, 0.5, "rectangular", 0.0), (0.4, 0.35, 0.6, "rectangular", 0.015)],
    "drums": [(0.7, 0.7, 0.3, "rectangular", 0.0), (0.6, 0.6, 0.5, "round", 0.0), (0.5, 0.5, 0.5, "round", 0.0)],
}


def shaking():
    """Return four seconds of three components, m/s^2, at 100 Hz."""
    rng, time = np.random.default_rng(8), np.arange(0.0, 4.0, 0.01)
    envelope = np.sin(0.25 * np.pi * time) ** 2
    rows = [
        envelope * sum(rng.normal() * np.sin(2.0 * np.pi * f * time + rng.uniform(0.0, 6.0)) for f in (0.9, 1.7, 2.9)) for _ in range(3)
    ]
    return np.array([[6.3], [3.6], [1.35]]) * np.array(rows) / np.abs(rows).max(axis=1)[:, None]


def final_rows(stones, s):
    """Return place over s and quaternion of each stone at the end, and their largest tilts."""
    pile, below = [], "ground"
    for k, (width, depth, height, shape, inset) in enumerate(stones):
        wear = EdgeWear(s * inset, 0.0)
        pile.append(PileStone(f"s{k}", s * width, s * depth, s * height, on=below, mu=0.8, shape=shape, inset=wear))
        below = f"s{k}"
    pace = math.sqrt(s)
    response = solve_stack(Pile("pile", tuple(pile)), Motion(shaking(), 0.01 * pace), step=2e-3 * pace)
    assert not response.outcome.overturned
    rows = [
        [response[f"{below.name}_{c}"][-1] / (s if c in "xyz" else 1.0) for c in ("x", "y", "z", "qw", "qx", "qy", "qz")] for below in pile
    ]
    return np.column_stack([rows, [np.abs(response[f"{stone.name}_tilt"]).max() for stone in pile]])


@pytest.mark.parametrize("name", list(STONES))
def test_solve_stack_is_similar_from_a_centimetre_to_ten_metres(name):
    """Powers of four scale every number without round-off, so that only a length, time or speed that does not scale can differ."""
    rows = final_rows(STONES[name], 1.0)
    assert np.abs(rows[:, -1]).max() > 1e-3
    for s in (4.0**-3, 4.0**2):
        np.testing.assert_allclose(final_rows(STONES[name], s), rows, rtol=0.0, atol=1e-10)
