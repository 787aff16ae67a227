"""MuJoCo, with its own contacts, topples stones at the same amplitudes as rigid stones on their edges, and moves them as far."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.bodies.pile.toml import load_pile
from seisblock.models.stack.solve import solve_stack
from seisblock.records import Motion

WIDTH, DT = 0.2424, 0.01
BLOCK = Pile("block", (PileStone("block", WIDTH, WIDTH, 3 * WIDTH),), mu=1.0)
THREE = Pile(
    "three",
    (
        PileStone("foot", 0.5, 0.5, 0.25),
        PileStone("middle", 0.36, 0.36, 0.25, on="foot"),
        PileStone("head", WIDTH, WIDTH, 3 * WIDTH, on="middle"),
    ),
    mu=0.8,
)


def cycle(pga, hertz):
    """Return one cycle of a sine and 1.5 s of rest."""
    time = np.arange(0.0, 1.0 / hertz + 0.5 * DT, DT)
    return Motion.from_arrays(np.append(pga * np.sin(2.0 * np.pi * hertz * time), np.zeros(150)), DT)


def least_amplitude(topples, low=2.0, high=8.0):
    """Return the least amplitude that topples, to 0.05 m/s^2."""
    while high - low > 0.05:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if topples(middle) else (middle, high)
    return high


def seisblock_threshold(body, hertz):
    return least_amplitude(lambda pga: solve_stack(body, cycle(pga, hertz), stop_at_fall=True).outcome.overturned_any)


def mujoco_threshold(body, hertz):
    from tests.crosscheck.mujoco_pile import any_stone_falls

    return least_amplitude(lambda pga: any_stone_falls(body, cycle(pga, hertz)))


@pytest.mark.parametrize("hertz", [1.0, 1.5, 2.0])
def test_stack_threshold_of_one_block_equals_mujoco(hertz):
    """Threshold amplitudes of one block agree within 1 %, half of which is how closely they are sought."""
    assert seisblock_threshold(BLOCK, hertz) == pytest.approx(mujoco_threshold(BLOCK, hertz), rel=0.01)


@pytest.mark.parametrize(("mu", "hertz"), [(0.438, 1.0), (0.8, 1.0), (0.8, 1.5), (0.8, 2.0)])
def test_stack_threshold_of_pile_equals_mujoco(mu, hertz):
    """Threshold amplitudes of the pile agree within 2 %, where friction carries what shaking asks for.

    With the paper's 0.438 the stones slide at 1.5 and 2 Hz, and MuJoCo's softened friction has not converged: its own threshold goes
    from 9.9 to 6.4 m/s^2 when its step is halved.
    """
    pile = load_pile("wagata", mu=mu).without("mizubachi")
    assert seisblock_threshold(pile, hertz) == pytest.approx(mujoco_threshold(pile, hertz), rel=0.02)


def three_axis_cycles(pga, hertz):
    """Return one cycle of a sine along each axis, each faster and weaker than the one before, and a second of rest."""
    time = np.arange(0.0, 1.0 / hertz + 1.0, DT)
    cycles = [(1.0, 1.0), (0.6, 1.3), (0.4, 2.5)]
    rows = [part * pga * np.sin(2.0 * np.pi * times * hertz * time) * (time * hertz * times < 1.0) for part, times in cycles]
    return Motion(np.array(rows), DT)


def seisblock_first_falls(body, motion, step=None):
    """Return the stones that have fallen first, and how far the centre of the last one has come from its place, m."""
    result = solve_stack(body, motion, stop_at_fall=True, step=step)
    way = np.array([result[f"{body.names[-1]}_{axis}"] for axis in "xyz"])
    return list(result.outcome.overturned), float(np.linalg.norm(way - way[:, :1], axis=0).max())


@pytest.mark.slow
@pytest.mark.parametrize("pga", [4.2, 5.2])
@pytest.mark.parametrize("hertz", [1.5, 2.0, 2.5, 3.0])
@pytest.mark.parametrize("body", [replace(BLOCK, mu=0.8), THREE], ids=["one", "three"])
def test_stack_falls_and_displacements_equal_mujoco(body, hertz, pga):
    """The same stone falls, or none; then the greatest displacement is within 4 % at the default step, and 3 % at one of 0.2 ms."""
    from tests.crosscheck.mujoco_pile import first_falls

    motion = three_axis_cycles(pga, hertz)
    fallen, away = first_falls(body, motion)
    for step, closely in ((None, 0.04), (2e-4, 0.03)):
        result, ours = seisblock_first_falls(body, motion, step)
        assert result == fallen
        assert fallen or ours == pytest.approx(away, rel=closely)
