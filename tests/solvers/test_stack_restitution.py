"""A block that rocks freely keeps the ratio that it was given, at every impact."""

import math

import numpy as np
import pytest

from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.records import Motion
from seisblock.solvers.stack.solve import solve_stack
from seisblock.units import STANDARD_GRAVITY as G


@pytest.mark.parametrize("ratio", [0.5, 0.8, 0.95])
def test_each_impact_leaves_the_ratio_that_was_given(ratio):
    """Twenty blocks of any size: a third stopped dead at one impact or other, held by the corners that had left."""
    dice = np.random.default_rng(1)
    for _ in range(20):
        width, slender = dice.uniform(0.1, 1.0), dice.uniform(2.0, 8.0)
        alpha, radius = math.atan2(1.0, slender), 0.5 * math.hypot(width, slender * width)
        let_go = alpha * dice.uniform(0.1, 0.7)
        pile = Pile("one", (PileStone("block", width, width, slender * width),), mu=2.0)
        found = solve_stack(pile, Motion.from_arrays(np.zeros(3001), 1e-3), tilts={"block": let_go}, restitution=ratio)
        tilt = found["block_tilt"]
        peaks = np.flatnonzero((tilt[1:-1] >= tilt[:-2]) & (tilt[1:-1] > tilt[2:])) + 1
        leans = [let_go, *tilt[peaks][tilt[peaks] > 0.02 * alpha]]
        speeds = [math.sqrt(1.5 * G / radius * (math.cos(alpha - lean) - math.cos(alpha))) for lean in leans]
        np.testing.assert_allclose(np.array(speeds[1:]) / speeds[:-1], ratio, atol=0.02)
        rocks_on = tilt[found.time > 2.0].max(initial=0.0) > 0.02 * alpha
        assert rocks_on or leans[-1] * ratio**2 < 0.04 * alpha
