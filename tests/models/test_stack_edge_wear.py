"""Stones with worn edges fall on, off and over each other, and gain no energy from their bevels."""

import math
from dataclasses import replace

import numpy as np
import pytest

from seisblock.bodies.edge_wear import EdgeWear
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.core.errors import SolverError
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.models.stack.solve import solve_stack
from seisblock.records import Motion
from tests.models.shaken_piles import random_case
from tests.models.test_stack_long_shaking import noise

SHARES = (0.05, 0.1, 0.2, 0.3)


def worn_pile(pile, share):
    """Return a pile all of whose stones are worn by a share of their widths."""
    return replace(pile, stones=tuple(replace(stone, inset=EdgeWear(share=share)) for stone in pile.stones))


def created_energy(pile, outcome):
    """Return the energy that came from nowhere, over the weight of a pile times its height."""
    free = [stone for stone in pile.stones if stone.name not in pile.fixed]
    return outcome.created_j / (sum(stone.mass for stone in free) * G * sum(stone.height for stone in free))


@pytest.mark.parametrize("seed", [47, 103, 119, 152])
def test_bevel_on_edge_contact_creates_no_energy(seed):
    """Runs that were refused while the normals and edges of bevels were none along which stones stay apart."""
    pile, shaking = random_case(seed)
    pile = worn_pile(pile, SHARES[seed % 4])
    outcome = solve_stack(pile, shaking, law="rigid").outcome
    assert outcome.overturned_any
    assert created_energy(pile, outcome) < 1e-4


@pytest.mark.slow
def test_random_worn_piles_create_no_energy():
    """At most 1e-4 of its weight times its height in any of them, most of which fall."""
    fell = []
    for seed in range(200):
        pile, shaking = random_case(seed)
        pile = worn_pile(pile, SHARES[seed % 4])
        outcome = solve_stack(pile, shaking, law="rigid").outcome
        assert created_energy(pile, outcome) < 1e-4
        fell.append(outcome.overturned_any)
    assert 120 < sum(fell) < 170


@pytest.mark.parametrize("seed", [1, 6, 26, 35, 45, 53])
def test_stone_on_contact_grid_leans_on_its_bevel(seed):
    """Its grid alone held it until it leaned by 45 degrees; its border, which had come in by then, was pushed out with its load: 5e-4."""
    pile, shaking = random_case(seed)
    outcome = solve_stack(pile, shaking, law="rigid", points=5).outcome
    assert created_energy(pile, outcome) < 2e-5


@pytest.mark.parametrize("push", [38.0, 42.0, 45.0])
def test_slab_rocking_on_bevels_lands_on_all_corners(push):
    """Pushed along its diagonal it leans on the edge between two bevels, and comes down on both of them and on its base at once."""
    time = np.arange(0.0, 3.0, 0.005)
    along = np.where(time < 0.25, push * np.sin(2.0 * np.pi * time / 0.25), 0.0)
    stones = PileStone("base", 1.5, 1.5, 0.3), PileStone("slab", 0.6, 0.6, 0.12, on="base", inset=EdgeWear(share=0.3))
    pile = Pile("slab on a base", stones, mu=3.0, fixed=("base",))
    outcome = solve_stack(pile, Motion(np.array([along, along, 0.0 * along]), 0.005), law="rigid").outcome
    assert outcome.max_tilt_rad["slab"] > 0.14
    assert created_energy(pile, outcome) < 1e-4


@pytest.mark.slow
@pytest.mark.parametrize("shape", ["round", "rectangular"])
def test_worn_stones_leaning_on_drums_gain_no_energy(shape):
    """Worn faces alone were met, also where outer rims and edges lie lower: 1 in 4 drums gained up to 1.7 %, and 3 in 4 squares 3.9 %.

    One run in a hundred is refused, as it gains a little more than 0.1 %.
    """
    inset, gained, leans = EdgeWear(share=0.25), [], []
    low = PileStone("low", 0.315, 0.315, 0.077, shape="round", inset=inset)
    high = PileStone("high", 0.294, 0.294, 0.171, on="low", shape=shape, inset=inset)
    pile = Pile("two", (low, high), mu=1.2)
    for seed in range(21):
        try:
            outcome = solve_stack(pile, noise(seed, 1.3, 30.0), step=1e-3).outcome
        except SolverError:
            gained.append(math.inf)
            continue
        gained.append(created_energy(pile, outcome))
        leans.append(outcome.max_tilt_rad["high"])
    # quantiles 0.95 and 0.75
    second, sixth = np.sort(gained)[[-2, -6]]
    assert second < 1e-3
    assert sixth < 2e-4
    assert np.quantile(leans, 0.75) > 0.7


@pytest.mark.parametrize("seed", [32, 74])
def test_worn_drum_landing_flat_does_not_rebound(seed):
    """One rim's point was to lift what fell on the other side of it; or forces of a few nanoseconds were gone on with: .9 and 1.8 %."""
    inset = EdgeWear(share=0.25)
    low = PileStone("low", 0.315, 0.315, 0.077, shape="round", inset=inset)
    high = PileStone("high", 0.294, 0.294, 0.171, on="low", shape="round", inset=inset)
    pile = Pile("two", (low, high), mu=1.2)
    assert created_energy(pile, solve_stack(pile, noise(seed, 1.3, 30.0), step=1e-3).outcome) < 1e-3
