"""Limits of the model with a single mode: `slide`, `rock`, and a thrown stone."""

import numpy as np
import pytest

from seisblock import solve_rock, solve_slide
from seisblock.bodies.block import Block
from seisblock.bodies.sliding_base import sliding_base
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.models.respond import solve_respond
from seisblock.records import Motion
from tests.models.respond.cases import SLENDER, sequence, shaking, still_ground


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("kappa", [1.0, 0.7])
def test_broad_block_slides_like_solve_slide(seed, kappa):
    """With mu below b/h nothing rocks: displacement, path and times of `slide`, with vertical motion, to round-off."""
    motion = shaking(seed, 5.0)
    computed = solve_respond(Block(1.0, 0.8), motion, mu=0.2, mu_kinetic=0.2 * kappa)
    slide = solve_slide(sliding_base(0.2, kappa=kappa), motion, vertical=True)
    assert set(sequence(computed.outcome)) <= {"rest", "slide +", "slide -"}
    assert computed.outcome.final_displacement_m == pytest.approx(slide.outcome.final_slip_m, abs=1e-13)
    assert computed.outcome.max_displacement_m == pytest.approx(slide.outcome.max_slip_m, abs=1e-13)
    assert computed.outcome.slip_path_m == pytest.approx(slide.outcome.path_m, abs=1e-5)
    during = [event["time_s"] for event in computed.outcome.events[1:] if event["time_s"] <= motion.time[-1]]
    np.testing.assert_allclose(during, [event.time_s for event in slide.events], rtol=0.0, atol=1e-12)
    at = np.searchsorted(computed.time, motion.time)
    np.testing.assert_allclose(
        computed["displacement"][at], slide["displacement"][np.searchsorted(slide.time, motion.time)], rtol=0.0, atol=1e-13
    )


@pytest.mark.parametrize("seed", range(4))
def test_rough_block_rocks_like_solve_rock(seed):
    """With friction enough and plastic impacts the lean is that of `rock`, whose restitution is the angular momentum's."""
    motion = shaking(seed, 4.0, vertical=0.3)
    computed = solve_respond(SLENDER, motion, mu=50.0)
    rock = solve_rock(motion=motion, block=SLENDER, vertical=True)
    assert not rock.outcome.contact_lost
    assert computed.outcome.overturned == rock.outcome.overturned
    assert computed.outcome.time_in_mode_s["slide"] == computed.outcome.time_in_mode_s["slide_rock"] == 0.0
    if not rock.outcome.overturned:
        theirs = rock["rotation"][np.searchsorted(rock.time, motion.time)]
        np.testing.assert_allclose(computed["rotation"][np.searchsorted(computed.time, motion.time)], theirs, rtol=0.0, atol=1e-9)
        assert computed.outcome.max_rotation_rad == pytest.approx(rock.outcome.max_rotation_rad, rel=1e-9)


def test_random_motions_include_rocking_without_overturning():
    """Of the motions above some rock through many impacts without falling."""
    outcomes = [solve_respond(SLENDER, shaking(seed, 4.0, vertical=0.3), mu=50.0).outcome for seed in range(4)]
    assert sum(outcome.impacts > 20 and not outcome.overturned for outcome in outcomes) >= 2


def test_asymmetric_block_rocks_like_solve_rock():
    """Two different corners: both factors of the angular momentum."""
    block = Block(0.4, 1.0, centroid_offset=0.05, centroid_height=0.6, centroid_inertia=40.0, mass=300.0)
    motion = shaking(3, 5.0, vertical=0.0)
    computed = solve_respond(block, motion, mu=50.0)
    rock = solve_rock(motion=motion, block=block)
    assert computed.outcome.impacts > 20
    theirs = rock["rotation"][np.searchsorted(rock.time, motion.time)]
    np.testing.assert_allclose(computed["rotation"][np.searchsorted(computed.time, motion.time)], theirs, rtol=0.0, atol=1e-10)


def test_flight_over_still_ground_is_a_parabola():
    """In flight over still ground the centre follows a parabola and the spin is constant."""
    block = Block(0.4, 0.9)
    start = (0.1, 3.0, 0.2, 1.5, 2.0, -0.4)
    response = solve_respond(block, still_ground(0.6), mu=0.5, initial=start)
    t = np.arange(61) * 0.01
    at = np.searchsorted(response.time, t)
    np.testing.assert_allclose(response["displacement"][at], 0.1 + 1.5 * t, rtol=0.0, atol=1e-13)
    np.testing.assert_allclose(response["height"][at], 3.0 + 2.0 * t - 0.5 * G * t**2, rtol=0.0, atol=1e-13)
    np.testing.assert_allclose(response["rotation"][at], 0.2 - 0.4 * t, rtol=0.0, atol=1e-14)


def test_flight_over_moving_ground_subtracts_ground_displacement():
    """Relative to ground that shakes both ways it moves by minus the ground's displacement, to the next landing."""
    t = np.arange(101) * 0.01
    motion = Motion.from_arrays(3.0 + 2.0 * t, 0.01, vertical=1.0 - 4.0 * t)
    response = solve_respond(Block(0.4, 0.9), motion, mu=0.5, initial=(0.0, 8.0, 0.0, 0.0, 0.0, 0.0))
    at = np.searchsorted(response.time, t)
    np.testing.assert_allclose(response["displacement"][at], -(1.5 * t**2 + t**3 / 3), rtol=0.0, atol=1e-13)
    np.testing.assert_allclose(response["height"][at], 8.0 - 0.5 * (G + 1.0) * t**2 + 4.0 * t**3 / 6, rtol=0.0, atol=1e-12)
    assert sequence(response.outcome)[0] == "flight"


def test_flat_drop_lands_at_free_fall_time():
    """A flat fall from 10 cm takes sqrt(2 s/g), and ends there without restitution."""
    block = Block(0.5, 0.5)
    outcome = solve_respond(block, still_ground(1.0), mu=0.5, initial=(0.0, 0.35, 0.0, 0.0, 0.0, 0.0)).outcome
    assert sequence(outcome) == ["flight", "rest"]
    assert outcome.events[1]["time_s"] == pytest.approx((0.2 / G) ** 0.5, abs=1e-13)
    assert outcome.energy_impacts_j == pytest.approx(block.total_mass * G * 0.1, rel=1e-12)
