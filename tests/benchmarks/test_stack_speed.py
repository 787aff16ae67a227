"""How fast the pile is followed."""

from __future__ import annotations

import numpy as np
import pytest

from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.bodies.pile.toml import load_pile
from seisblock.records import Motion
from seisblock.solvers.stack.solve import solve_stack

WIDTH = 0.2424
SECONDS = 10.0
SHAKING = Motion.from_arrays(3.0 * np.sin(2.0 * np.pi * 2.0 * np.arange(0.0, SECONDS, 0.01)), 0.01)


def test_one_block_on_four_points(benchmark):
    """One block on 4 points, on contacts that rock within 2 % of Housner: 300 simulated seconds per second."""
    block = Pile("block", (PileStone("block", WIDTH, WIDTH, 4 * WIDTH),), mu=5.0)
    response = benchmark(solve_stack, block, SHAKING, points=2, contact=PileContact(stiffness=1e9, damping_ratio=3.0))
    assert response.outcome.max_tilt_rad["block"] > 0.01
    assert benchmark.stats is None or response.time[-1] / benchmark.stats.stats.min > 300.0


def test_five_stones_on_25_points_each(benchmark):
    """The paper's pile of five stones on 5 x 5 points each: 40 simulated seconds per second."""
    response = benchmark(solve_stack, load_pile("wagata"), SHAKING)
    assert response.outcome.max_tilt_rad["sao"] > 0.005
    assert benchmark.stats is None or response.time[-1] / benchmark.stats.stats.min > 40.0


@pytest.mark.parametrize("solver", ["seisblock", "mujoco"])
def test_side_by_side_with_mujoco(benchmark, solver):
    """The pile of four stones on corner points in both solvers, for the record: MuJoCo at 1 ms, seisblock at its own step.

    Both steps leave the threshold amplitude within 1 % of the solver's own limit. MuJoCo's contacts are implicit: 2 to 5 ms would still
    do for its threshold, not for its free rocking.
    """
    pytest.importorskip("mujoco", reason="an extra: pip install seisblock[mujoco]")
    from tests.crosscheck.mujoco_pile import falls

    pile = load_pile("wagata", mu=0.8).without("mizubachi")
    if solver == "seisblock":
        response = benchmark(solve_stack, pile, SHAKING, points=2)
        assert not response.outcome.overturned_any
    else:
        assert not benchmark(falls, pile, SHAKING, timestep=1e-3)
