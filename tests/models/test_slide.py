"""The sliding model holds at its own edges: equal forces, lost contact, zero samples."""

from __future__ import annotations

import contextlib

import numpy as np
import pytest

from seisblock.bodies.sliding_base import sliding_base
from seisblock.core.errors import ComponentError, ParameterError
from seisblock.models.slide.solve import solve_slide
from seisblock.records import Component, Motion, Record, motion_of
from seisblock.studies.sliding import slide_study, worst_directions

G = 9.80665


def shaking(seed=0, samples=4000, dt=0.01, vertical=0.5):
    """Return a smooth random motion of 3 m/s^2, its vertical part a delayed copy, so that forces balance often."""
    rng = np.random.default_rng(seed)
    a = np.convolve(rng.normal(size=samples), np.hanning(20), "same")
    a *= 3.0 / np.abs(a).max()
    return Motion.from_arrays(a, dt, vertical=vertical * np.roll(a, 7))


def test_equal_friction_coefficients_end_without_chatter():
    """With kappa = 1 each slip starts from equal forces: 500 studies' rows with and without flight end without giving up."""
    points = slide_study(np.linspace(0.02, 0.4, 50).tolist(), shaking(), kappa=1.0, vertical=np.linspace(0.0, 10.0, 10).tolist())
    assert len(points) == 500
    assert sum(point.lifted_off for point in points) > 50
    assert all(point.slips for point in points if point.mu < 0.25)


def test_plateau_equal_to_friction_limit_sticks_in_any_unit():
    """A plateau of exactly mu g moves nothing though gal and m/s^2 round it differently; 1e-12 more slides, far with a small kappa."""
    for mu in np.round(np.arange(0.01, 1.0, 0.01), 2):
        plateau = 0.01 * np.full(20, round(mu * 980.665, 6))
        assert not solve_slide(sliding_base(mu, kappa=0.1), Motion.from_arrays(plateau, 0.01), gravity=9.80665).outcome.slips
        assert (
            solve_slide(sliding_base(mu, kappa=0.1), Motion.from_arrays(plateau * (1.0 + 1e-12), 0.01), gravity=9.80665).outcome.max_slip_m
            > 1e-4
        )


def test_base_in_free_fall_keeps_contact():
    """Falling at exactly g, in any unit, is not faster than the object falls."""
    for gal in np.round(np.arange(978.0, 983.0, 0.1), 1):
        motion = Motion.from_arrays(np.zeros(20), 0.01, vertical=-0.01 * np.full(20, gal))
        assert not solve_slide(0.2, motion, vertical=1.0, gravity=round(gal / 100.0, 6)).outcome.lifted_off


@pytest.mark.parametrize("scale", [5.0, 6.4, 6.6, 9.0])
def test_contact_is_lost_when_base_falls_faster_than_gravity(scale):
    """The object lifts off if and only if g + y'' becomes negative, stuck or sliding; one way only, flight is refused there."""
    motion = shaking()
    falls = (G + scale * motion.vertical).min() < 0.0
    for mu in (0.1, 0.9, 5.0):
        assert solve_slide(sliding_base(mu), motion, vertical=scale).outcome.lifted_off == falls
        with pytest.raises(ParameterError, match="one-way sliding is not defined") if falls else contextlib.nullcontext():
            assert not solve_slide(sliding_base(mu, one_way=True), motion, vertical=scale).outcome.lifted_off


def test_one_way_object_at_rest_loses_contact_under_falling_base():
    """Pushed where it cannot slide, a one-way object loses contact when the base falls: refused with the time, in studies too."""
    motion = Motion.from_arrays(np.full(9, 5.0), 0.01, vertical=[0, 0, 0, -4.0, -10.0, -4.0, 0, 0, 0], name="EW")
    at = 0.03 + 0.01 * (G - 4.0) / 6.0
    with pytest.raises(ParameterError, match=f"EW: contact lost at {at:.3f} s"):
        solve_slide(sliding_base(0.5, one_way=True), motion, vertical=1.0)
    with pytest.raises(ParameterError, match=f"EW: contact lost at {at:.3f} s"):
        slide_study([0.4, 0.5], motion, one_way=True, vertical=[0.5, 1.0])


@pytest.mark.parametrize("slope", [10.0, -10.0])
@pytest.mark.parametrize("before", [0.0, -4.0])
def test_flight_starts_when_drive_and_normal_force_vanish_together(slope, before):
    """On a slope shaken up and down only, both are zero as the base begins to fall faster than g, stuck or sliding: it lifts off there."""
    t = np.arange(0.0, 3.0, 0.01)
    motion = Motion.from_arrays(np.where(t < 0.1, np.sign(slope) * before, 0.0), 0.01, vertical=15.0 * np.sin(8.0 * t))
    response = solve_slide(sliding_base(0.3, kappa=0.5, slope_deg=slope), motion, vertical=1.0)
    lifts = [event.time_s for event in response.events if event.name == "lift-off"]
    k = np.flatnonzero(motion.vertical < -G)[0]
    share = (G + motion.vertical[k - 1]) / (motion.vertical[k - 1] - motion.vertical[k])
    assert lifts[0] == pytest.approx((k - 1 + share) * 0.01, abs=1e-12)
    assert len(lifts) == 4
    assert response.outcome.slips and response.outcome.lifted_off


def test_one_way_displacement_never_decreases():
    """Without flight the displacement of a one-way slide never falls."""
    u = solve_slide(sliding_base(0.1, kappa=0.5, one_way=True), shaking())["displacement"]
    assert (np.diff(u) >= -1e-15).all()
    assert u[-1] > 0.1


def test_channels_on_slope_equal_closed_form():
    """Limits of static friction and ground velocity along a slope of 12 degrees under a ramp of both components."""
    rate, rise, angle, mu, gravity = 1.5, 0.8, np.radians(12.0), 0.45, 9.80665
    time = 0.02 * np.arange(101)
    motion = Motion.from_arrays(rate * time, 0.02, vertical=rise * time)
    response = solve_slide(sliding_base(mu, kappa=0.9, slope_deg=12.0), motion, gravity=gravity)
    t = response.time
    normal = (gravity + rise * t) * np.cos(angle) + rate * t * np.sin(angle)
    pull = gravity * np.sin(angle)
    np.testing.assert_allclose(response["lower_limit"], pull - mu * normal, rtol=1e-13)
    np.testing.assert_allclose(response["upper_limit"], pull + mu * normal, rtol=1e-13)
    np.testing.assert_allclose(response["ground_velocity"], 0.5 * t**2 * (rate * np.cos(angle) - rise * np.sin(angle)), atol=1e-14)


def test_still_ground_causes_no_slip():
    """No shaking, no slip, on the steepest slope that friction holds too; every number is there."""
    still = Motion.from_arrays(np.zeros(10), 0.01)
    outcome = solve_slide(sliding_base(np.tan(np.radians(30.0)), slope_deg=30.0), still).outcome
    assert not outcome.slips
    assert outcome.slip_start_s is None
    assert (outcome.max_slip_m, outcome.residual_slip_m, outcome.final_slip_m, outcome.slip_count) == (0.0, 0.0, 0.0, 0)


def test_slope_steeper_than_kinetic_friction_slides_without_end():
    """On an endless slope with mu_k < tan th a sliding object does not stop, which the outcome states."""
    motion = Motion.from_arrays(np.concatenate([np.full(10, -5.0), np.zeros(40)]), 0.02)
    response = solve_slide(sliding_base(0.3, kappa=0.5, slope_deg=12.0), motion)
    assert response.outcome.final_slip_m is None
    assert response.outcome.slides_at_end
    assert any("does not stop" in warning for warning in response.warnings)


def test_times_count_from_first_sample_of_record():
    """A motion that starts 20 s into its record reports times on the record's clock."""
    motion = shaking()
    later = Motion(motion.acceleration, motion.dt, start_s=20.0)
    first, second = solve_slide(0.1, motion), solve_slide(0.1, later)
    assert second.outcome.slip_start_s == pytest.approx(first.outcome.slip_start_s + 20.0, rel=1e-15)
    assert second.outcome.max_slip_time_s == pytest.approx(first.outcome.max_slip_time_s + 20.0, rel=1e-15)
    assert second.time[0] == second.phases[0].start_s == 20.0
    assert slide_study(0.1, later)[0].slip_start_s == second.outcome.slip_start_s


def test_largest_slip_between_samples_is_found():
    """The extremum is that of the cubic, between samples and not at one of them."""
    coarse = solve_slide(0.1, Motion.from_arrays([0.0, 4.0, -4.0, 0.0, 0.0], 0.2))
    dense = solve_slide(0.1, Motion.from_arrays(np.interp(np.arange(4001) / 1000, np.arange(5), [0.0, 4.0, -4.0, 0.0, 0.0]), 0.0002))
    assert coarse.outcome.max_slip_m == pytest.approx(np.abs(dense["displacement"]).max(), rel=1e-9)


def test_worst_direction_is_largest_slip_per_combination():
    """Of two directions the study keeps, for each friction, the one that slides further."""
    weak, strong = shaking(), Motion(1.5 * shaking(1).acceleration, 0.01, name="90")
    points = slide_study([0.05, 0.1], [weak, strong])
    worst = worst_directions(points)
    assert [point.mu for point in worst] == [0.05, 0.1]
    for point in worst:
        assert point.max_slip_m == max(p.max_slip_m for p in points if p.mu == point.mu)


def test_vertical_motion_needs_a_vertical_component():
    """A record without one is refused, by name, in the solver and in the study."""
    motion = motion_of(Record([Component("NS", np.ones(10))], 0.01), "NS")
    for call in (lambda: solve_slide(0.2, motion, vertical=1.0), lambda: slide_study(0.2, motion, vertical=[0.0, 1.0])):
        with pytest.raises(ComponentError, match="no vertical component"):
            call()


@pytest.mark.parametrize("number", [float("nan"), float("inf")])
def test_solve_slide_rejects_non_finite_numbers(number):
    """NaN and infinity are refused for every parameter."""
    motion = shaking()
    for how in (
        {"mu": number},
        {"mu": 0.2, "mu_kinetic": number},
        {"mu": 0.2, "kappa": number},
        {"mu": 0.2, "slope_deg": number},
        {"mu": 0.2, "slope_deg": 5.0, "slope_length": number},
    ):
        with pytest.raises(ParameterError):
            sliding_base(**how)
    for how in ({"vertical": number}, {"gravity": number}):
        with pytest.raises(ParameterError):
            solve_slide(0.2, motion, **how)


def test_flight_over_falling_base_lands_at_closed_form_time():
    """With the base accelerated by -g (2 - 4 t/T) the gap is g t^2/2 - 2 g t^3/(3 T), which closes at 3 T/4."""
    duration, samples = 0.4, 41
    time = np.linspace(0.0, duration, samples)
    motion = Motion.from_arrays(np.zeros(samples), time[1], vertical=-G * (2.0 - 4.0 * time / duration))
    events = solve_slide(sliding_base(0.3), motion, vertical=1.0, gravity=G).events
    (landing,) = [event.time_s for event in events if event.name == "landing"]
    assert landing == pytest.approx(0.75 * duration, rel=1e-9)
