"""Single facts about the rocking solver: forces, rest, unequal corners, what follows the record, and what it refuses."""

import math
from itertools import pairwise

import numpy as np
import pytest

from seisblock import solve_rock
from seisblock.bodies.block import Block, from_slenderness
from seisblock.core.errors import BodyError, ParameterError, SolverError
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.dynamics import integrate, integration
from seisblock.models.rock import model as rock_model
from seisblock.models.rock.free_rocking import free_rocking_outcome
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.params import rock_params
from seisblock.readers import read
from seisblock.records import Motion, motion_of

T = np.arange(1201) * 0.005
SHAKING = 3.4 * np.sin(2 * np.pi * 1.6 * T) * np.sin(np.pi * T / 6) ** 2
UP = 1.5 * np.sin(2 * np.pi * 3.1 * T)


def test_friction_demand_equals_second_differences_of_centre():
    """H/N from second differences of the centre's coordinates, on a record sampled so densely that they are exact enough."""
    block = Block(0.3, 1.0)
    fine = np.arange(120001) * 5e-5
    a, up = np.interp(fine, T, SHAKING), np.interp(fine, T, UP)
    motion = Motion.from_arrays(a, 5e-5, vertical=up)
    response = solve_rock(block, motion, vertical=True)
    trajectory = integrate(rock_model.ROCKING, motion, rock_model.parameters(rock_params(block, motion), 5e-5), (0, 0), 0, gains=(1, 0, 1))
    theta, modes = trajectory.states[:, 0], trajectory.modes
    half, centre = np.where(theta >= 0, block.width / 2, -block.width / 2), block.centre
    x = half - half * np.cos(theta) + centre * np.sin(theta)
    z = half * np.sin(theta) + centre * np.cos(theta)
    along = a[1:-1] + np.diff(x, 2) / 5e-5**2
    normal = G + up[1:-1] + np.diff(z, 2) / 5e-5**2
    steady = (modes[:-2] == modes[2:]) & (modes[1:-1] == modes[2:])
    ratio = np.where(steady, np.abs(along / normal), 0.0)
    assert response.outcome.max_friction_demand == pytest.approx(ratio.max(), rel=2e-3)
    coarse = solve_rock(block, Motion.from_arrays(SHAKING, 0.005, vertical=UP), vertical=True).outcome
    assert coarse.max_friction_demand == pytest.approx(response.outcome.max_friction_demand, rel=1e-4)
    assert coarse.max_friction_demand_s == pytest.approx(response.outcome.max_friction_demand_s, abs=2e-3)


def test_contact_loss_is_reported_at_exact_time():
    """At rest N vanishes where the ground falls faster than g, at the exact time, which is reported."""
    down = np.linspace(0.0, -2.0 * G, 41)
    response = solve_rock(Block(0.4, 1.0), Motion.from_arrays(np.zeros(41), 0.1, vertical=down), vertical=True)
    assert response.outcome.contact_lost
    assert response.outcome.contact_lost_s == pytest.approx(2.0, abs=1e-6)
    assert response.outcome.max_friction_demand is None
    assert any("contact" in text for text in response.warnings)
    assert not solve_rock(Block(0.4, 1.0), Motion.from_arrays(np.zeros(41), 0.1, vertical=down), vertical=False).outcome.contact_lost


def test_rocking_ends_in_rest_and_restarts_at_threshold():
    """Impacts crowd until the rest, from which the next crossing of the threshold starts anew."""
    block = Block(0.5, 1.2)
    pulse = 6.0 * np.sin(np.pi * np.arange(41) / 40)
    a = np.concatenate([pulse, np.zeros(800), -pulse, np.zeros(400)])
    response = solve_rock(block, Motion.from_arrays(a, 0.005))
    names = [event.name for event in response.events]
    assert names.count("rocking starts") == names.count("comes to rest") >= 2
    starts = [event.time_s for event in response.events if event.name == "rocking starts"]
    assert starts[-1] - starts[0] == pytest.approx(841 * 0.005, abs=1e-12)
    first = next(i for i, name in enumerate(names) if name == "comes to rest")
    hops = np.diff([event.time_s for event in response.events[:first]])
    assert hops[-1] < 2e-8
    np.testing.assert_allclose(hops[-8:-1] / hops[-9:-2], block.restitution, rtol=1e-3)
    assert response.outcome.decided_after_record is False


def test_maximum_tilt_is_found_between_samples():
    """Halving dt does not move the maximum of one swing: it is that of the curve."""
    a = np.concatenate([4.0 * np.sin(np.pi * np.arange(21) / 20), np.zeros(60)])
    coarse = solve_rock(Block(0.3, 1.0), Motion.from_arrays(a, 0.02))
    fine = np.interp(np.arange(801) / 10, np.arange(81), a)
    dense = solve_rock(Block(0.3, 1.0), Motion.from_arrays(fine, 0.002))
    assert coarse.outcome.max_rotation_rad == pytest.approx(dense.outcome.max_rotation_rad, rel=1e-12)
    assert coarse.outcome.max_rotation_s == pytest.approx(dense.outcome.max_rotation_s, abs=1e-8)
    assert np.abs(coarse["rotation"]).max() < coarse.outcome.max_rotation_rad


def test_asymmetric_block_starts_about_nearer_corner():
    """An offset centre: it starts to the side of the shorter arm, with that alpha, and its restitutions differ."""
    block = Block(0.4, 1.0, centroid_offset=0.1)
    outcome = solve_rock(block, Motion.from_arrays(np.array([0.0, -2.5, 0.0]), 0.2)).outcome
    assert outcome.threshold_m_s2 == pytest.approx(G * 0.1 / 0.5)
    assert outcome.rocking_start_s == pytest.approx(0.2 * G * 0.2 / 2.5)
    assert solve_rock(block, Motion.from_arrays(np.array([0.0, 2.5, 0.0]), 0.2)).outcome.rocks is False
    onto_right, onto_left = block.restitutions
    assert onto_right > onto_left
    assert onto_left == pytest.approx((block.gyration_squared + 0.25 - 0.03) / (block.gyration_squared + 0.25 + 0.09))


def test_zero_restitution_is_limit_of_small_restitution():
    """Restitution 0 is allowed: every swing ends at its impact, and the answer is that of 1e-9 (N13)."""
    motion = motion_of(read("synthetic_jma.csv"), "NS")
    for factor in (0.5, 0.7, 1.0):
        scaled = Motion(factor * motion.acceleration, motion.dt)
        none, little = (solve_rock(Block(0.5, 2.0, centroid_offset=0.05), scaled, restitution=e).outcome for e in (0.0, 1e-9))
        assert none.rocks
        assert none.overturned == little.overturned
        assert none.max_rotation_rad == pytest.approx(little.max_rotation_rad, rel=1e-8)
    released = solve_rock(Block(0.3, 1.0), Motion.from_arrays(np.zeros(400), 0.01), restitution=0.0, initial=(0.1, 0.0))
    assert released.outcome.impacts == 1
    assert [phase.name for phase in released.phases] == ["rocks to +x", "rest"]


def test_very_wide_block_stops_at_the_impact():
    """With B/H above sqrt(2) no angular momentum remains: the block is at rest after the first impact."""
    block = Block(1.5, 1.0)
    assert block.restitutions == (0.0, 0.0)
    response = solve_rock(block, Motion.from_arrays(np.zeros(300), 0.01), initial=(0.1, 0.0))
    assert [event.name for event in response.events] == ["comes to rest"]
    assert response.outcome.impacts == 1
    assert "rocking threshold 1.50 g" in response.warnings[0]


def test_lossless_block_below_energy_barrier_does_not_overturn():
    """With a restitution of 1 energy decides, too: below the barrier it stands although it rocks for ever."""
    block = from_slenderness(0.25, 2.14)
    still = Motion.from_arrays(np.zeros(50), 0.01)
    outcome = solve_rock(block, still, restitution=1.0, initial=(0.2, 0.0)).outcome
    assert outcome.overturned is False
    assert outcome.decided_after_record
    assert outcome.max_rotation_rad == pytest.approx(0.2, rel=1e-12)
    speed = 2.14 * math.sqrt(2 * (1 - math.cos(0.25)))
    assert solve_rock(block, still, restitution=1.0, initial=(0.0, speed * (1 + 1e-9))).outcome.overturned
    assert not solve_rock(block, still, restitution=1.0, initial=(0.0, speed * (1 - 1e-9))).outcome.overturned
    assert solve_rock(block, still, linear=True, initial=(0.0, 2.14 * 0.25 * (1 + 1e-9))).outcome.overturned
    assert not solve_rock(block, still, linear=True, initial=(0.0, 2.14 * 0.25 * (1 - 1e-9))).outcome.overturned


@pytest.mark.parametrize("linear", [False, True])
@pytest.mark.parametrize(("theta", "omega"), [(0.3, -0.1), (0.26, 0.0), (0.4, -1.6), (-0.3, 0.12), (0.1, 1.2), (-0.05, -2.0), (0.2, -0.8)])
def test_free_rocking_outcome_equals_integration_over_still_record(theta, omega, linear):
    """Verdict, times and largest lean of free rocking are those of a long still record, starting on either side of alpha."""
    block = from_slenderness(0.25, 2.14)
    result = free_rocking_outcome(
        rock_params(block, Motion.from_arrays(np.zeros(2), 0.01), options=RockOptions(restitution=0.95, linear=linear, gravity=G)),
        theta,
        omega,
    )
    long = solve_rock(block, Motion.from_arrays(np.zeros(4000), 0.005), restitution=0.95, linear=linear, initial=(theta, omega)).outcome
    assert result.overturns == long.overturned
    assert max(result.max_leans) == pytest.approx(long.max_rotation_rad, rel=1e-9)
    if result.overturns:
        assert result.overturns_s == pytest.approx(long.overturning_time_s, abs=1e-9)
        assert {1: "+x", -1: "-x"}[result.direction] == long.overturned_towards


def test_passing_alpha_and_returning_is_not_overturning():
    """A block beyond alpha that the ground pushes back stands; the passing is logged, not the overturning."""
    block = from_slenderness(0.2, 3.0)
    a = np.concatenate([[0.0], np.full(60, 4.0), np.full(140, 0.0)])
    response = solve_rock(block, Motion.from_arrays(a, 0.005), initial=(0.21, -0.2))
    names = [event.name for event in response.events]
    assert names[0] == "comes back over alpha"
    assert response.outcome.overturned is False or response.outcome.alpha_passed_s > response.events[0].time_s


def test_phases_cover_the_record_without_gaps():
    """Each phase begins where the one before ends, from the first to the last sample."""
    response = solve_rock(Block(0.3, 1.0), Motion.from_arrays(SHAKING, 0.005, start_s=3.0))
    phases = response.phases
    assert phases[0].start_s == 3.0
    assert phases[-1].end_s == pytest.approx(9.0)
    assert all(first.end_s == second.start_s for first, second in pairwise(phases))


def test_window_does_not_shift_times():
    """A record that starts later gives the same times, from the record's first sample."""
    early, late = (solve_rock(Block(0.3, 1.0), Motion.from_arrays(SHAKING, 0.005, start_s=s)).outcome for s in (0.0, 7.5))
    for key in ("rocking_start_s", "max_rotation_s", "max_friction_demand_s"):
        assert getattr(late, key) == pytest.approx(getattr(early, key) + 7.5, abs=1e-12)


def test_first_sample_above_threshold_starts_rocking_at_once():
    """A record whose first sample exceeds the threshold starts rocking at its first sample."""
    outcome = solve_rock(Block(0.2, 1.0), Motion.from_arrays(np.full(100, -5.0), 0.01)).outcome
    assert outcome.rocking_start_s == 0.0
    assert outcome.overturned_towards == "+x"


@pytest.mark.slow
def test_lossless_impacts_without_end_raise_solver_error(monkeypatch):
    """A restitution of 1 after a hop of microseconds never comes to rest: one error message, no endless loop."""
    monkeypatch.setattr(integration, "_MAX_EVENTS", 2**18)
    threshold = G * 0.2
    a = np.array([0.0, threshold * (1 + 3e-3), 0.0, *np.zeros(400)])
    with pytest.raises(SolverError, match="too many mode changes"):
        solve_rock(Block(0.2, 1.0), Motion.from_arrays(a, 0.05), restitution=1.0)


@pytest.mark.parametrize(
    ("sizes", "says"),
    [
        ({"width": 0.0, "height": 1.0}, "width must be positive"),
        ({"width": 1.0, "height": math.nan}, "height must be positive"),
        ({"width": 1.0, "height": 1.0, "mass": -3.0}, "mass must be positive"),
        ({"width": 1.0, "height": 1.0, "centroid_offset": 0.5}, "above the base"),
        ({"width": 1.0, "height": 1.0, "centroid_offset": math.nan}, "above the base"),
        (
            {"width": 1.0, "height": 1.0, "centroid_height": 1.5},
            "the height of the centre of gravity, 1.5 m, exceeds the height of the block, 1.0 m",
        ),
    ],
)
def test_block_rejects_invalid_dimensions(sizes, says):
    """One sentence each."""
    with pytest.raises(BodyError, match=says):
        Block(**sizes)


@pytest.mark.parametrize(
    "options",
    [
        {"restitution": -0.1},
        {"restitution": 1.1},
        {"restitution": math.nan},
        {"gravity": 0.0},
        {"initial": (2.0, 0.0)},
        {"initial": (0.0, math.inf)},
    ],
)
def test_solve_rock_rejects_invalid_options(options):
    """One sentence each."""
    with pytest.raises(ParameterError):
        solve_rock(Block(0.2, 1.0), Motion.from_arrays(np.zeros(5), 0.1), **options)


@pytest.mark.parametrize(("alpha", "p"), [(0.0, 1.0), (1.6, 1.0), (0.3, -1.0), (math.nan, 1.0)])
def test_solve_rock_rejects_invalid_slenderness(alpha, p):
    """The slenderness must be between 0 and pi/2 and p positive."""
    with pytest.raises(BodyError):
        from_slenderness(alpha, p)
