"""Round stones roll, spin, wobble and rock as cylinders do, and worn ones turn about their insets."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from seisblock.bodies.block import Block
from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.bodies.pile.toml import load_pile
from seisblock.core.errors import ParameterError
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.models.respond.solve import solve_respond
from seisblock.models.stack.arrays import pile_arrays
from seisblock.models.stack.cylinder import load_directions
from seisblock.models.stack.joint_geometry import effective_base
from seisblock.models.stack.recorder import CREATED, DISSIPATED
from seisblock.models.stack.solve import solve_stack
from seisblock.models.stack.spring_contact import SLOT
from seisblock.records import Motion
from seisblock.validation.stack_round import (
    RADIUS,
    RIM_CASES,
    SPEED,
    release,
    rim_rate,
    rock_and_roll,
    roll_down_slope,
    roll_on_level,
    roll_on_rim,
    tilted_axes,
)
from tests.models.test_stack_rigid import lean_of, restitution_at_impact, sine_cycle, still_ground

R = RADIUS


def drum(height, diameter=2.0 * R, name="block", **extra):
    return PileStone(name, diameter, diameter, height, shape="round", **extra)


def slab(height, side=2.0 * R, name="block", **extra):
    return PileStone(name, side, side, height, **extra)


@pytest.mark.parametrize(("height", "lean"), RIM_CASES)
def test_spinning_stone_keeps_lean_and_energy(height, lean):
    """Five turns of a disk, of drums and of a column, whose rates are cases of ``validate``: lean within 0.2 %, no energy from nowhere."""
    _, axis, end = roll_on_rim(drum(height), lean)
    np.testing.assert_allclose(np.arccos(axis[:, 2]), lean, rtol=2e-3)
    assert end.output.energy_ledger[CREATED] < 1e-5 * drum(height).mass * G * R


def test_thin_spinning_disk_follows_moffatt():
    """Of a thin disk the closed form is that of the paper, 4 g/(R sin)."""
    assert rim_rate(drum(1e-6), 0.1) == pytest.approx(math.sqrt(4.0 * G / (R * math.sin(0.1))), rel=1e-6)


def test_drum_rolling_through_upright_conserves_energy():
    """It leans as far on the other side, which is a case of ``validate``: a drum as high as wide turns by 230 degrees, no half turn."""
    rotated, leans, _ = rock_and_roll(drum(2.0 * R))
    assert rotated == pytest.approx(math.radians(230.0), abs=0.02)
    assert leans == pytest.approx(1.0, abs=5e-3)


@pytest.mark.parametrize("step", [1e-3, 2.5e-3])
def test_drum_rolling_through_upright_is_independent_of_step(step):
    """It rolls across within a tenth of a step: steps end where the lowest point of its rim has wandered far."""
    rotated, leans, _ = rock_and_roll(drum(2.0 * R), 4e-3, step)
    assert 2.0 * math.pi - rotated == pytest.approx(math.radians(230.9), abs=0.05)  # seen half way, it turned the short way round
    assert leans == pytest.approx(1.0, abs=0.03)


def test_wobbling_drum_gains_no_energy():
    """Eight drums let go with any lean and spin, for ten seconds at the default step: the energy held grows by at most 0.1 %."""
    rng = np.random.default_rng(5)
    for height in R * rng.uniform(0.3, 6.0, 8):
        stone, lean = drum(height), rng.uniform(0.1, 0.6) * math.atan(2.0 * R / height)
        axes = tilted_axes(lean)
        foot, spin = R * axes[:, 0] - 0.5 * height * axes[:, 2], rng.normal(size=3) * lean * 0.7 * math.sqrt(G / R)
        end = release(stone, axes, -foot[2], -np.cross(spin, foot), spin, still_ground(10.0, 2.5e-3))
        swing = 0.5 * np.sum(np.cross(spin, foot) ** 2) + 0.5 * (axes.T @ spin) ** 2 @ stone.gyration_squared
        assert end.output.energy_ledger[CREATED] < 1e-3 * stone.mass * (swing + G * (-foot[2] - 0.5 * height))


def test_drum_rolling_downhill_conserves_energy():
    """A drum that rolls downhill conserves energy; its acceleration is a case of ``validate``."""
    _, end = roll_down_slope()
    assert end.output.energy_ledger[DISSIPATED] < 1e-6 * end.output.energy_ledger[0]


def test_upright_coin_rolls_straight():
    """Upright, at 2 m/s, it neither slows down nor turns aside."""
    time, centres = roll_on_level(1e-3)
    np.testing.assert_allclose(centres[:, 0], SPEED * time, rtol=1e-6, atol=1e-9)
    assert np.abs(centres[:, 1]).max() < 1e-4


def test_ground_is_unbounded_for_rolling_drum():
    """The ground has no edge within a record's reach."""
    _, centres = roll_on_level(0.4, 80.0)
    assert centres[-1, 0] > 75.0
    np.testing.assert_allclose(centres[:, 2], R, rtol=1e-3)


def planar_block(stone):
    """Return the block that a round stone is in the plane of its lean."""
    return Block(stone.width, stone.height, mass=stone.mass, centroid_inertia=stone.mass * float(stone.gyration_squared[1]))


def test_drum_in_plane_rocks_like_planar_block():
    """Let go from 0.6 alpha, each amplitude follows from the last by energy and the restitution of its block, within 1 %."""
    stone = drum(0.96, 0.24)
    block = planar_block(stone)
    alpha, remaining = block.slenderness, block.restitution

    def height(lean):
        return math.cos(alpha - lean) - math.cos(alpha)

    response = solve_stack(Pile("one", (stone,), mu=5.0), still_ground(3.0), tilts={"block": 0.6 * alpha})
    assert restitution_at_impact(response, alpha, 0.6 * alpha) == pytest.approx(remaining, abs=2e-3)
    assert effective_base(response).restitution == pytest.approx(remaining, abs=1e-12)
    lean = lean_of(response)
    crossings = np.flatnonzero(lean[1:] * lean[:-1] < 0.0)[:6]
    amplitudes = [np.abs(lean[a + 1 : b + 1]).max() for a, b in pairwise(crossings)]
    for before, after in pairwise(amplitudes):
        assert height(after) == pytest.approx(remaining**2 * height(before), rel=1e-2)


@pytest.mark.parametrize("worn", [0.0, 0.1])
@pytest.mark.parametrize("make", [drum, slab])
def test_stone_on_exact_base_overturns_at_respond_threshold(make, worn):
    """Round and square, sharp and worn: just below the threshold of its block in the plane it stands, just above it falls."""
    stone = make(0.72, 0.24)
    plane, pile = planar_block(stone).with_wear(worn), Pile("one", (stone,), mu=1.0).with_wear(worn)

    def falls(pga):
        return bool(solve_respond(plane, sine_cycle(pga, 1.5), mu=1.0).outcome.overturned)

    low, high = 2.0, 6.0
    while high - low > 2e-3 * low:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if falls(middle) else (middle, high)
    below, above = (solve_stack(pile, sine_cycle(part * high, 1.5), stop_at_fall=True) for part in (0.98, 1.02))
    assert not below.outcome.overturned_any
    assert above.outcome.overturned_any
    result = effective_base(above)
    assert (result.width_ratio, result.restitution) == (pytest.approx(1.0 - 2.0 * worn), pytest.approx(plane.restitution, abs=1e-12))


@pytest.mark.parametrize("law", ["rigid", "springs"])
def test_worn_stone_pivots_at_overhang_of_wider_stone(law):
    """It turns about its own worn edges and the sharp one of the stone below; on springs it fell to the side that was worn by neither."""
    lower, upper = PileStone("lower", 0.5, 0.5, 0.2), PileStone("upper", 0.2, 0.2, 0.7, offset=(0.2, 0.0), on="lower")
    pile = Pile("over", (lower, upper), mu=2.0).with_wear(0.2)
    result = solve_stack(pile, sine_cycle(1.0, 1.7), law=law)
    assert not result.outcome.overturned_any
    points = pile_arrays(pile, PileContact(), 2).grids[1]
    ends = points[points[:, :, 2] > 0.0][:, 0]
    assert (ends.min(), ends.max()) == (pytest.approx(-0.06), pytest.approx(0.05))  # from the middle of the upper stone


@pytest.mark.parametrize("degrees", [20.0, 45.0])
def test_column_response_is_isotropic(degrees):
    """Shaken along any azimuth, its lean is the one along x, turned."""
    pile, shaking = Pile("one", (drum(0.8, 0.26),), mu=1.0), sine_cycle(4.0, 1.5)
    along = solve_stack(pile, shaking)
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    aside = solve_stack(pile, Motion(np.array([c, s, 0.0])[:, None] * shaking.acceleration[0], shaking.dt))
    assert 0.02 < along.outcome.max_tilt_rad["block"] < 0.3
    assert aside.outcome.max_tilt_rad["block"] == pytest.approx(along.outcome.max_tilt_rad["block"], rel=1e-2)


PILES = {
    "drum on slab": (slab(0.3, 0.6, "low"), drum(0.8, 0.3, on="low")),
    "slab on drum": (drum(0.3, 0.3, "low"), slab(0.2, 0.6, on="low")),
    "drums": (drum(0.4, name="low"), drum(0.4, name="middle", on="low"), drum(0.4, on="middle")),
    "drums aside": (drum(0.4, name="low"), drum(0.4, on="low", offset=(0.1, 0.05))),
    "flush": (slab(0.4, name="low"), drum(0.4, on="low")),
}


@pytest.mark.parametrize("name", PILES)
def test_round_stones_keep_rest_momentum_and_energy(name):
    """At rest they stay; shaken along three axes they keep momentum, and create less than 1e-3 of the energy of a fall."""
    pile = Pile(name, PILES[name], mu=0.6)
    rest = solve_stack(pile, still_ground(2.0)).outcome
    assert not rest.overturned
    assert max(rest.residual_slip_m.values()) < 1e-5
    time = np.arange(0.0, 3.0, 0.005)
    waves = [6.0 * np.sin(4.0 * math.pi * time), 3.0 * np.sin(4.4 * math.pi * time + 0.7), 1.6 * np.sin(6.8 * math.pi * time)]
    shaken = solve_stack(pile, Motion(np.array(waves), 0.005)).outcome
    tall = sum(stone.height for stone in pile.stones)
    assert shaken.created_j < 1e-3 * sum(stone.mass for stone in pile.stones) * G * tall
    assert shaken.momentum_error < 1e-12
    assert max(shaken.max_tilt_rad.values()) > 1e-4 or max(shaken.residual_slip_m.values()) > 1e-4


def test_bundled_column_stands_at_rest_and_reports_fall_direction():
    """The bundled column of drums and a capital stands at rest, and falls to a stated side under strong shaking."""
    column = load_pile("column")
    assert all(stone.is_round for stone in column.stones[:-1])
    assert not solve_stack(column, still_ground(1.0)).outcome.overturned_any
    fallen = [stone for stone in solve_stack(column, sine_cycle(9.0, 0.8), stop_at_fall=True).outcome.stones if stone.state == "fallen"]
    assert fallen
    assert all(stone.fell_towards_deg is not None for stone in fallen)


@pytest.mark.parametrize(
    ("stone", "extra", "message"),
    [
        (drum(0.4), {"law": "springs"}, "is a cylinder, which requires rigid contact"),
        (drum(0.4), {"points": 5}, "is a cylinder, which requires rigid contact"),
        (slab(0.4), {"points": 5, "inset": 0.1}, "edge wear requires contact at the edges"),
    ],
)
def test_solve_stack_rejects_unsupported_options_of_round_and_worn_bases(stone, extra, message):
    pile = Pile("one", (stone,)).with_wear(extra.pop("inset", 0.0))
    with pytest.raises(ParameterError, match=message):
        solve_stack(pile, still_ground(0.1), **extra)


def test_contact_without_a_load_has_directions_fixed_to_the_carrier():
    """They turn with the stone; rounding would turn those of a load in the centre."""
    for turn in Rotation.random(10, np.random.default_rng(8)):
        rel, directions = np.zeros(18), np.full(6, np.nan)
        rel[:9], x_axis = turn.as_matrix().ravel(), turn.apply([1.0, 0.0, 0.0])
        load_directions(np.zeros((4, SLOT)), rel, R, directions)
        np.testing.assert_allclose(directions, [*x_axis, *x_axis[:2], 0.0], rtol=0.0, atol=1e-15)
