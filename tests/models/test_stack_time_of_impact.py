"""Stones that land fast are met where they land, with all that they drive on in the same instant."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.models.stack.arrays import PLASTIC_RESTITUTION, pile_arrays
from seisblock.models.stack.frames import INERTIA, INVERSE, MASS, L, Q, R, V, W, X
from seisblock.models.stack.recorder import CREATED
from seisblock.models.stack.simulation import Simulation
from seisblock.models.stack.solve import solve_stack
from seisblock.records import Motion
from tests.models.test_stack_rigid import still_ground

WIDTH, HEIGHT = 0.6, 0.25
STEPS = 2
"""Of an interval of 5 ms, as the step that is taken by default."""


def throw_stones(count, places, velocities, *, spins=None, turns=None, restitution=PLASTIC_RESTITUTION, seconds=0.5):
    """Throw equal stones, from centres, with velocities, turns and spins; return how they went."""
    stones = tuple(PileStone(f"s{i}", WIDTH, WIDTH, HEIGHT, on=f"s{i - 1}" if i else "ground") for i in range(count))
    pile = pile_arrays(Pile("thrown", stones, mu=0.5), None, 2, restitution)
    for i, body in enumerate(pile.bodies[:count]):
        lies = Rotation.from_rotvec(np.zeros(3) if turns is None else turns[i])
        inertia = lies.as_matrix() @ pile.inertias[i, INERTIA:INVERSE].reshape(3, 3) @ lies.as_matrix().T
        body[W : W + 3] = np.zeros(3) if spins is None else spins[i]
        body[X : X + 3], body[V : V + 3], body[L : L + 3] = places[i], velocities[i], inertia @ body[W : W + 3]
        body[Q : Q + 4], body[R : R + 9] = np.roll(lies.as_quat(), 1), lies.as_matrix().ravel()
    weight = pile.inertias[:count, MASS].sum() * G * HEIGHT * count
    end = Simulation(pile, still_ground(seconds, 0.005), (1.0, 1.0), G, STEPS, True, False, {}).run()
    return end, end.output.energy_ledger[CREATED] / weight


def greatest_depth(end):
    """Return how deep below ground, m, a corner of any stone ever was."""
    quaternions = end.track.quaternions.reshape(-1, 4)
    up = Rotation.from_quat(np.roll(quaternions, -1, axis=1)).as_matrix()[:, 2]
    reach = np.abs(up) @ (0.5 * np.array([WIDTH, WIDTH, HEIGHT]))
    return float((reach - end.track.centres[..., 2].reshape(-1)).max())


@pytest.mark.parametrize("speed", [10.0, 16.0, 24.0])
def test_fast_landing_does_not_penetrate_ground(speed):
    """A stone that lands at 6 m/s or faster does not penetrate the ground (was: a search radius of a centimetre)."""
    rng = np.random.default_rng(3)
    for _ in range(10):
        places, falls = [[0.0, 0.0, 0.5 + 0.1 * rng.random()]], [[0.0, 0.0, -speed]]
        end, created = throw_stones(1, places, falls, turns=[0.3 * rng.normal(size=3)], spins=[rng.normal(size=3)])
        assert greatest_depth(end) < 1e-4
        assert created < 1e-4


@pytest.mark.parametrize("gap", [0.0, 2e-6, 2e-5, 2e-4, 2e-3, 8e-3])
@pytest.mark.parametrize("restitution", [PLASTIC_RESTITUTION, 0.5])
def test_successive_landings_do_not_penetrate(gap, restitution):
    """One was not looked for that came near in the step in which the other landed; or it was pressed away within a hundredth of a step."""
    rng = np.random.default_rng(3)
    for _ in range(20):
        turn, spin, rise, fall = 0.01 * rng.normal(size=3), rng.normal(size=3), 0.3 + 0.1 * rng.random(), np.array([0.0, 0.0, -4.0])
        arm = (HEIGHT + gap) * Rotation.from_rotvec(turn).as_matrix()[:, 2]
        places, velocities = [[0.0, 0.0, rise], [arm[0], arm[1], rise + arm[2]]], [fall, fall + np.cross(spin, arm)]
        end, _created = throw_stones(2, places, velocities, turns=[turn, turn], spins=[spin, spin], restitution=restitution)
        assert greatest_depth(end) < 1e-4
        assert np.linalg.norm(np.diff(end.track.centres, axis=1), axis=2).min() > HEIGHT - 1e-5


@pytest.mark.parametrize("restitution", [PLASTIC_RESTITUTION, 0.5])
def test_driven_stone_does_not_penetrate_its_neighbour(restitution):
    """Neither of the two had moved, so that nothing seemed to come near within the step."""
    rng, z = np.random.default_rng(3), 0.5 * HEIGHT
    for _ in range(10):
        before, behind = 0.02 + 0.02 * rng.random(), 0.002 + 0.003 * rng.random()
        places = [[-WIDTH - before, 0.0, z], [0.0, 0.0, z], [WIDTH + behind, 0.0, z]]
        end, created = throw_stones(3, places, [[6.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]], restitution=restitution)
        assert np.diff(end.track.centres[..., 0], axis=1).min() > WIDTH - 1e-4
        assert end.track.centres[-1, 2, 0] > places[2][0] + 0.1
        assert created < 1e-4


@pytest.mark.parametrize("seed", [135017, 139531, 212558])
def test_almost_flat_stone_with_high_friction_does_not_rebound(seed):
    """Sweeps had come to rest where friction drives what it should brake: once in forty thousand such states."""
    rng = np.random.default_rng(seed)
    width = rng.uniform(0.3, 1.0)
    depth = width if rng.random() < 0.5 else width * rng.uniform(0.5, 1.5)
    height, mu = width * rng.uniform(0.3, 1.5), float(rng.choice([1.3, 1.6, 2.2, 3.0, 5.0]))
    lies = Rotation.from_rotvec([*(10.0 ** rng.uniform(-7.0, -1.0) * rng.normal(size=2)), 0.0])
    speed, axes = 10.0 ** rng.uniform(-4.0, 0.0), lies.as_matrix()
    pile = pile_arrays(Pile("one", (PileStone("s", width, depth, height),), mu=mu), None, 2, PLASTIC_RESTITUTION)
    body, inertia = pile.bodies[0], axes @ pile.inertias[0, INERTIA:INVERSE].reshape(3, 3) @ axes.T
    body[W : W + 3] = speed * rng.normal(size=3) / width
    body[V : V + 3], body[L : L + 3] = speed * rng.normal(size=3), inertia @ body[W : W + 3]
    body[X + 2] = np.abs(axes[2]) @ [width / 2.0, depth / 2.0, height / 2.0]
    body[Q : Q + 4], body[R : R + 9] = np.roll(lies.as_quat(), 1), axes.ravel()
    end = Simulation(pile, still_ground(4 * 0.0033, 0.0033), (1.0, 1.0), G, 1, True, False, {}).run()
    assert end.output.energy_ledger[CREATED] < 2e-4 * pile.inertias[0, MASS] * G * height


HANGING = [
    ([-0.0213, 0.0002, 0.2929], [0.03067, -0.22069, 0.38227], [0.182, 2.291, 0.248], [-0.054, -0.031, 0.151]),
    ([-0.0271, -0.0036, 0.3717], [0.09424, -0.17387, 0.38361], [0.073, 2.547, 0.32], [-0.201, -0.12, 0.071]),
]


@pytest.mark.parametrize(("turn", "place", "spin", "velocity"), HANGING)
def test_edge_rocking_across_edge_lands_without_penetration(turn, place, spin, velocity):
    """The second end of an edge that crosses another lands without penetration (was: missed for a step)."""
    places, still_one = [[0.0, 0.0, 0.5 * HEIGHT], place], np.zeros(3)
    end, created = throw_stones(2, places, [still_one, velocity], turns=[still_one, turn], spins=[still_one, spin])
    assert created < 2e-6
    assert greatest_depth(end) < 1e-5


def test_joints_that_stay_closed_have_no_restitution():
    """Twenty wide slabs slide on each other and none opens: any restitution, the same places.

    The forces of the last step no longer balance a slab under the others: it seemed to strike, and slips changed by half.
    """
    time = np.arange(0.0, 3.0, 0.01)
    rows = [5.0 * np.sin(4.0 * np.pi * time), 3.0 * np.sin(5.48 * np.pi * time + 0.3), np.sin(9.2 * np.pi * time)]
    slab = PileStone("s0", 2.5, 2.5, 0.08)
    pile = Pile("slabs", (slab, *(replace(slab, name=f"s{i}", on=f"s{i - 1}") for i in range(1, 20))), mu=0.3)
    plastic, elastic = (solve_stack(pile, Motion(np.array(rows), 0.01), restitution=e) for e in (0.1, 0.9))
    assert plastic["s0_slip"].max() > 3e-3
    for name in pile.names:
        np.testing.assert_array_equal(plastic[f"{name}_x"], elastic[f"{name}_x"])
