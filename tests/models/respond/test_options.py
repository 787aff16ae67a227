"""Valid and invalid options: initial states, end of analysis, tenons, further points, two-layer blocks, bad input."""

import math

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.core.errors import BodyError, ComponentError, KindError, ParameterError
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.models.respond import solve_respond
from seisblock.models.respond.outcome import PERTURBATIONS
from seisblock.records import Motion
from seisblock.records.record import Component, Record
from tests.models.respond.cases import SLENDER, at_lean, sequence, shaking, still_ground

BLOCK = Block(0.4, 1.0)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"mu": -0.1}, "friction coefficient mu"),
        ({"mu": math.nan}, "friction coefficient mu"),
        ({"mu": math.inf}, "friction"),
        ({"mu": 0.3, "mu_kinetic": 0.4}, "must not exceed"),
        ({"mu": 0.3, "mu_kinetic": -0.1}, "kinetic"),
        ({"mu": 0.3, "restitution": 1.0}, r"\[0, 1\)"),
        ({"mu": 0.3, "restitution": -0.1}, r"\[0, 1\)"),
        ({"mu": 0.3, "restitution": math.nan}, r"\[0, 1\)"),
        ({"mu": 0.3, "rocking_restitution": 1.1}, r"\[0, 1\]"),
        ({"mu": 0.3, "gravity": 0.0}, "gravity"),
        ({"mu": 0.3, "tenon": -0.01}, "tenon"),
        ({"mu": 0.3, "settle_s": -1.0}, "settling time"),
        ({"mu": 0.3, "initial": (0.0, 0.5, 0.0)}, "six finite numbers"),
        ({"mu": 0.3, "initial": (0, 0.4, 0, 0, 0, 0)}, "below the ground"),
        ({"mu": 0.3, "initial": (0, 2.0, 1.6, 0, 0, 0)}, "pi/2"),
        ({"mu": 0.3, "further_points": [(0.1, -0.6)]}, "above the base"),
        ({"mu": 0.3, "further_points": [(0.1, math.nan)]}, "two lengths"),
    ],
)
def test_solve_respond_rejects_invalid_numbers(options, message):
    """Each message names the quantity, the expected and the found value."""
    with pytest.raises(ParameterError, match=message) as error:
        solve_respond(BLOCK, still_ground(), **options)
    assert "\n" not in str(error.value)


def test_solve_respond_rejects_centre_outside_base():
    """The body refuses it, and so does the solver for what has other effective corners."""
    with pytest.raises(BodyError, match="above the base"):
        Block(0.4, 1.0, centroid_offset=0.3)

    class Worn(Block):
        """A block with its right corner beyond the centre is rejected."""

        @property
        def arms(self):
            return -0.01, 0.2

    with pytest.raises(BodyError, match="above the base"):
        solve_respond(Worn(0.4, 1.0), still_ground(), mu=0.5)


def test_solve_respond_rejects_wrong_types():
    """With the sentence that helps."""
    with pytest.raises(KindError, match="found str"):
        solve_respond("a stone", still_ground(), mu=0.5)
    with pytest.raises(KindError, match="expected the body first"):
        solve_respond(still_ground(), BLOCK, mu=0.5)


def test_vertical_true_requires_a_vertical_component():
    """Asked for it is refused; left open it is left out."""
    samples = np.zeros(50)
    record = Record(components=(Component("NS", samples, 0.0),), dt=0.01)
    motion = Motion(np.zeros((3, 50)), 0.01, record=record)
    with pytest.raises(ComponentError, match="no vertical component"):
        solve_respond(BLOCK, motion, mu=0.5, vertical=True)
    assert solve_respond(BLOCK, motion, mu=0.5).outcome.outcome == "rests"


def test_vertical_false_omits_vertical_motion():
    """The same motion with and without it."""
    motion = shaking(2, 6.0)
    flat = Motion.from_arrays(motion.horizontal, motion.dt)
    without = solve_respond(BLOCK, motion, mu=0.3, vertical=False).outcome
    assert without == solve_respond(BLOCK, flat, mu=0.3).outcome
    assert without.final_displacement_m != solve_respond(BLOCK, motion, mu=0.3).outcome.final_displacement_m


def test_two_layer_block_equals_rigid_composite():
    """Mass, centre and inertia of [Sugimoto2017]'s block, as a Block of the same."""
    two = TwoLayerBlock(0.6, 0.5, 0.8, 0.4, 300.0, 50.0)
    same = Block(0.6, 1.2, mass=350.0, centroid_height=two.centroid_height, centroid_inertia=two.centroid_inertia)
    motion = shaking(4, 7.0)
    assert solve_respond(two, motion, mu=0.5).outcome == solve_respond(same, motion, mu=0.5).outcome


def test_overturning_ends_at_quarter_turn_or_protruding_point():
    """The block falls from beyond its balance; a protruding point reaches the ground earlier."""
    start = at_lean(SLENDER, 0.3)
    response = solve_respond(SLENDER, still_ground(), mu=2.0, initial=start)
    outcome = response.outcome
    assert (outcome.outcome, outcome.overturned, outcome.overturned_towards) == ("overturns", True, "+x")
    assert outcome.max_rotation_rad == pytest.approx(math.pi / 2, abs=1e-12)
    assert outcome.events[-1] == {"time_s": outcome.overturning_time_s, "mode": "overturned", "corner": None, "slip": None}
    assert outcome.max_rotation_ratio == pytest.approx(math.pi / 2 / SLENDER.slenderness, rel=1e-12)
    earlier = solve_respond(SLENDER, still_ground(), mu=2.0, initial=start, further_points=[(-0.1, 0.2), (0.4, 0.3)]).outcome
    lean = earlier.max_rotation_rad
    assert earlier.overturned and earlier.overturning_time_s < outcome.overturning_time_s
    # the point (0.4, 0.3) from the centre meets the ground about the right corner, 0.25 m to its side and 0.9 m below
    assert 0.9 * math.cos(lean) - 0.25 * math.sin(lean) == pytest.approx(0.0, abs=1e-10)
    mirrored = solve_respond(SLENDER, still_ground(), mu=2.0, initial=at_lean(SLENDER, -0.3)).outcome
    assert mirrored.overturned_towards == "-x"


def test_push_back_beyond_alpha_prevents_overturning():
    """A push back brings a block that leans beyond alpha back."""
    block = SLENDER
    lean = block.slenderness + 0.02
    a = np.full(60, 4.0)
    outcome = solve_respond(block, Motion.from_arrays(a, 0.01), mu=2.0, initial=at_lean(block, lean)).outcome
    assert outcome.max_rotation_ratio > 1.0
    assert outcome.impacts > 0


def test_ground_acceleration_is_zero_after_last_sample():
    """Constant acceleration up to the last sample, then none: a jump of the input that ends the rocking's push at once."""
    push = np.full(21, 3.0)
    response = solve_respond(Block(0.6, 0.4), Motion.from_arrays(push, 0.01), mu=0.2)
    v = (3.0 - 0.2 * G) * 0.2
    assert sequence(response.outcome) == ["slide -", "rest"]
    assert response.outcome.end_s == pytest.approx(0.2 + v / (0.2 * G), abs=1e-12)
    assert response.outcome.final_displacement_m == pytest.approx(-0.5 * v * 0.2 - v * v / (0.4 * G), abs=1e-12)
    assert response["ground_acceleration"][-1] == 0.0
    assert solve_respond(Block(0.6, 0.4), Motion.from_arrays(push, 0.01), mu=0.2, settle_s=0.0).outcome.end_s == pytest.approx(0.2)


def test_initial_displacement_is_included_in_results():
    """An initial position appears in the outcome and in the channel."""
    first = solve_respond(BLOCK, shaking(1, 6.0), mu=0.3).outcome
    second = solve_respond(BLOCK, shaking(1, 6.0), mu=0.3, initial=(5.0, 0.5, 0.0, 0.0, 0.0, 0.0)).outcome
    assert second.final_displacement_m == pytest.approx(5.0 + first.final_displacement_m, abs=1e-12)
    assert second.max_displacement_m >= 5.0


def test_tenon_prevents_slip_and_allows_rocking():
    """Bare it slides and never rocks; held by tenons it rocks, without a slip."""
    motion = shaking(7, 9.0, vertical=0.2)
    bare = solve_respond(BLOCK, motion, mu=0.18).outcome
    holding = solve_respond(BLOCK, motion, mu=0.18, tenon=0.02).outcome
    assert bare.time_in_mode_s["rock"] == 0.0 < bare.slip_path_m
    assert holding.time_in_mode_s["rock"] > 0.0
    assert holding.tenon_left_s is None
    assert holding.time_in_mode_s["slide"] == holding.time_in_mode_s["slide_rock"] == holding.slip_path_m == 0.0


def test_tenon_disengages_when_lower_corner_rises_by_its_depth():
    """A throw of 5 cm: tenons of 3 cm are left on the way up, at the exact time, and the body slides after it lands; of 6 cm hold."""
    up = math.sqrt(2.0 * G * 0.05)
    start = (0.0, 0.5, 0.0, 1.0, up, 0.0)
    left = solve_respond(BLOCK, still_ground(), mu=0.05, tenon=0.03, initial=start).outcome
    remaining = solve_respond(BLOCK, still_ground(), mu=0.05, tenon=0.06, initial=start).outcome
    assert left.tenon_left_s == pytest.approx((up - math.sqrt(up * up - 2.0 * G * 0.03)) / G, abs=1e-12)
    assert left.time_in_mode_s["slide"] > 0.0
    assert remaining.tenon_left_s is None
    assert remaining.slip_path_m == 0.0
    assert sequence(remaining)[1].startswith("rock")


def test_tenon_of_tilted_block_disengages_at_lower_corner():
    """The lower corner decides, whichever it is when it has risen."""
    start = (0.0, 0.57, 0.3, 0.0, 1.5, -2.0)
    outcome = solve_respond(BLOCK, still_ground(), mu=0.3, tenon=0.05, initial=start).outcome
    t = outcome.tenon_left_s
    theta = 0.3 - 2.0 * t
    height = 0.57 + 1.5 * t - 0.5 * G * t * t
    low = height - 0.2 * abs(math.sin(theta)) - 0.5 * math.cos(theta)
    assert low == pytest.approx(0.05, abs=1e-10)


def test_outcome_near_overturning_factor_is_flagged_sensitive():
    """Between an overturning and a standing factor 1e-6 apart the result is sensitive; far from it it is not."""
    motion = shaking(11, 8.0, vertical=0.0)

    def falls(factor):
        scaled = Motion.from_arrays(factor * motion.horizontal, motion.dt)
        return solve_respond(SLENDER, scaled, mu=0.9, sensitivity=False).outcome.overturned

    low, high = 0.1, 2.0
    assert not falls(low) and falls(high)
    while high / low > 1.0 + 5e-7:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if falls(middle) else (middle, high)
    edge = Motion.from_arrays(low * motion.horizontal, motion.dt)
    assert solve_respond(SLENDER, edge, mu=0.9).outcome.sensitive is True
    assert solve_respond(SLENDER, Motion.from_arrays(0.1 * motion.horizontal, motion.dt), mu=0.9).outcome.sensitive is False
    assert solve_respond(SLENDER, edge, mu=0.9, sensitivity=False).outcome.sensitive is None


def test_times_of_cropped_record_keep_record_clock():
    """A window of a record keeps its clock."""
    motion = shaking(1, 6.0)
    late = Motion(motion.acceleration, motion.dt, start_s=20.0)
    early, shifted = (solve_respond(BLOCK, item, mu=0.3) for item in (motion, late))
    assert shifted.outcome.events[0]["time_s"] == 20.0
    np.testing.assert_allclose(shifted.time, early.time + 20.0)
    assert shifted.outcome.end_s == pytest.approx(early.outcome.end_s + 20.0)


@pytest.mark.parametrize("seed", range(8))
def test_sensitive_result_is_that_of_all_four_changes(seed):
    """The smaller changes are left out only where they change no verdict: at distances of 1e-7 to 1e-2 from the overturning factor."""
    rng = np.random.default_rng(seed)
    width = rng.uniform(0.2, 1.0)
    block, options = Block(width, width * rng.uniform(1.2, 5.0)), {"mu": rng.uniform(0.3, 1.0), "restitution": rng.choice([0.0, 0.3])}
    motion = shaking(100 + seed, 1.0, seconds=8.0)

    def verdict(factor):
        scaled = Motion(factor * motion.acceleration, motion.dt)
        outcome = solve_respond(block, scaled, sensitivity=False, **options).outcome
        return outcome.overturned_towards

    low, high = 1.0, 64.0
    while high - low > 1e-7 * high:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if verdict(middle) else (middle, high)
    for distance in 10.0 ** rng.uniform(-7.0, -2.0, 4):
        factor = high * (1.0 + rng.choice([-1.0, 1.0]) * distance)
        changes = {verdict(factor * (1.0 + change)) != verdict(factor) for change in PERTURBATIONS}
        assert solve_respond(block, Motion(factor * motion.acceleration, motion.dt), **options).outcome.sensitive is any(changes)
