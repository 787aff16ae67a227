"""A stone that is shaken just beyond what lifts it rocks on from one half cycle to the next, as `respond` follows it event by event."""

import math

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.models.respond.solve import solve_respond
from seisblock.models.stack.solve import solve_stack
from seisblock.records import Motion

WIDTH, MU, DT = 0.24, 5.0, 0.01


def cycles(slender, hertz, beyond):
    """Return three cycles of a sine that is so many times what lifts a stone, and rest."""
    time = np.arange(0.0, 3.0 / hertz + 1.5, DT)
    return Motion.from_arrays(beyond * G / slender * np.sin(2.0 * math.pi * hertz * time) * (time * hertz < 3.0), DT)


@pytest.mark.parametrize(("slender", "hertz"), [(5.0, 2.0), (6.0, 2.0), (6.0, 3.0)])
def test_rocking_just_above_uplift_matches_respond_at_default_step(slender, hertz):
    """Within 5 %: flights of some steps, whose impacts are slow because little draws a slender stone back, had ended all of it."""
    motion = cycles(slender, hertz, 1.1)
    stone = PileStone("stone", WIDTH, WIDTH, slender * WIDTH)
    result = solve_stack(Pile("one", (stone,), mu=MU), motion).outcome
    expected = solve_respond(Block(WIDTH, slender * WIDTH), motion, mu=MU).outcome
    assert expected.max_rotation_ratio > 0.02
    assert result.max_tilt_rad["stone"] == pytest.approx(expected.max_rotation_rad, rel=0.05)
