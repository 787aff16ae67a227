"""Sliding obeys the symmetries and balances of its equations, whatever the record."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from seisblock.bodies.sliding_base import sliding_base
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.models.slide.model import SlidePhase
from seisblock.models.slide.solve import solve_slide
from seisblock.records import Motion
from seisblock.studies.sliding import slide_study

QUICK = settings(max_examples=40, deadline=None, derandomize=True)
seeds = st.integers(0, 10_000)
mus = st.floats(0.05, 0.6)
kappas = st.one_of(st.just(1.0), st.floats(0.2, 1.0))


def noise(seed, n=120, dt=0.02, peak=4.0):
    """Return a smooth random motion, horizontal and vertical."""
    rng = np.random.default_rng(seed)
    rows = np.stack([np.convolve(rng.normal(size=n), np.hanning(9), "same") for _ in range(2)])
    rows *= peak / np.abs(rows[0]).max()
    rows[:, :2] = 0.0
    return Motion.from_arrays(rows[0], dt, vertical=rows[1])


@QUICK
@given(seeds, mus, kappas)
def test_mirrored_motion_gives_mirrored_slip(seed, mu, kappa):
    """On a level base the mirrored motion gives the mirrored slip, bit by bit."""
    motion = noise(seed)
    mirrored = Motion(motion.acceleration * [[-1.0], [1.0], [1.0]], motion.dt)
    first, second = (solve_slide(sliding_base(mu, kappa=kappa), m, vertical=1.0) for m in (motion, mirrored))
    np.testing.assert_array_equal(first["displacement"], -second["displacement"])


@QUICK
@given(seeds, mus, kappas, st.floats(2.0, 12.0))
def test_mirrored_slope_and_motion_give_mirrored_slip(seed, mu, kappa, slope):
    """A slope that falls the other way under the mirrored motion gives the mirrored slip."""
    motion = noise(seed)
    mu += np.tan(np.radians(slope))
    mirrored = Motion(motion.acceleration * [[-1.0], [1.0], [1.0]], motion.dt)
    first = solve_slide(sliding_base(mu, kappa=kappa, slope_deg=slope, slope_length=0.01), motion, vertical=1.0).outcome
    second = solve_slide(sliding_base(mu, kappa=kappa, slope_deg=-slope, slope_length=0.01), mirrored, vertical=1.0).outcome
    assert first.residual_slip_m == pytest.approx(-second.residual_slip_m, rel=1e-12, abs=1e-15)
    assert first.fell_off_slope == second.fell_off_slope


@QUICK
@given(seeds, mus, kappas, st.sampled_from([0.25, 2.0, 8.0]))
def test_slip_scales_with_acceleration_and_gravity(seed, mu, kappa, factor):
    """Scaling ground acceleration and gravity together scales the slip."""
    motion = noise(seed)
    first = solve_slide(sliding_base(mu, kappa=kappa), motion, gravity=9.8).outcome
    second = solve_slide(sliding_base(mu, kappa=kappa), Motion(motion.acceleration * factor, motion.dt), gravity=9.8 * factor).outcome
    assert second.max_slip_m == factor * first.max_slip_m
    assert second.slip_start_s == first.slip_start_s


@QUICK
@given(seeds, mus, kappas)
def test_slip_depends_on_product_of_friction_and_gravity(seed, mu, kappa):
    """On a level base without vertical motion only mu g counts: twice the friction with half the gravity changes nothing."""
    motion = noise(seed)
    first = solve_slide(sliding_base(mu, kappa=kappa), motion, vertical=False, gravity=9.8).outcome
    second = solve_slide(sliding_base(2.0 * mu, kappa=kappa), motion, vertical=False, gravity=4.9).outcome
    assert second == first


@QUICK
@given(seeds, mus, kappas)
def test_slip_scales_with_square_of_time(seed, mu, kappa):
    """The same samples at twice the interval give four times the slip."""
    motion = noise(seed)
    first = solve_slide(sliding_base(mu, kappa=kappa), motion).outcome
    second = solve_slide(sliding_base(mu, kappa=kappa), Motion(motion.acceleration, 2.0 * motion.dt)).outcome
    assert second.max_slip_m == pytest.approx(4.0 * first.max_slip_m, rel=1e-12, abs=1e-15)


@QUICK
@given(seeds, mus, kappas, st.floats(0.0, 10.0))
def test_refined_record_gives_same_slip(seed, mu, kappa, slope):
    """Linear interpolation to a third of the interval is the same motion: the same slip but for round-off."""
    motion = noise(seed)
    n = motion.samples
    fine = np.stack([np.interp(np.arange(3 * n - 2) / 3.0, np.arange(n), row) for row in motion.acceleration])
    mu += np.tan(np.radians(slope))
    first = solve_slide(sliding_base(mu, kappa=kappa, slope_deg=slope), motion, vertical=1.0).outcome
    second = solve_slide(sliding_base(mu, kappa=kappa, slope_deg=slope), Motion(fine, motion.dt / 3.0), vertical=1.0).outcome
    assert second.residual_slip_m == pytest.approx(first.residual_slip_m, rel=1e-9, abs=1e-12)
    assert second.max_slip_m == pytest.approx(first.max_slip_m, rel=1e-9, abs=1e-12)


@QUICK
@given(seeds, mus, kappas)
def test_energy_lost_is_friction_work(seed, mu, kappa):
    """Without vertical motion, work of the inertial force less work of friction is the kinetic energy left, relative to the base."""
    motion = noise(seed)
    response = solve_slide(sliding_base(mu, kappa=kappa), motion, vertical=False)
    u, v, a = (response[name] for name in ("displacement", "velocity", "ground_acceleration"))
    h = np.diff(response.time)
    # v is a quadratic and a straight line within each step: Simpson's rule on the cubic a v is exact, with v in mid-step from
    # its ends and its slope there
    slope = response["acceleration"]
    middle = 0.5 * (v[:-1] + v[1:]) + h / 8.0 * (slope[:-1] - slope[1:])
    power = h / 6.0 * (a[:-1] * v[:-1] + 2.0 * (a[:-1] + a[1:]) * middle + a[1:] * v[1:])
    work = -power.sum()
    missing = kappa * mu * 9.80665 * np.abs(np.diff(u)).sum()
    assert work - missing == pytest.approx(0.5 * v[-1] ** 2, abs=1e-12 * max(1.0, missing))


@QUICK
@given(seeds, mus, kappas, st.integers(1, 100))
def test_slip_is_independent_of_ground_velocity(seed, mu, kappa, sample):
    """A start at any instant of rest, with any ground velocity, gives the remaining slip."""
    motion = noise(seed)
    full = solve_slide(sliding_base(mu, kappa=kappa), motion)
    names = np.array([phase.name for phase in full.phases])[full.phase_of_row()]
    resting = [k for k in range(sample, motion.samples - 1) if (names[full.time == k * motion.dt] == "stick").all()]
    if resting:
        before = full["displacement"][full.time == resting[0] * motion.dt][0]
        rest = solve_slide(sliding_base(mu, kappa=kappa), Motion(motion.acceleration[:, resting[0] :], motion.dt)).outcome
        assert rest.residual_slip_m == pytest.approx(full.outcome.residual_slip_m - before, abs=1e-13)


@QUICK
@given(seeds, mus, kappas)
def test_slip_phase_has_one_sign_of_velocity(seed, mu, kappa):
    """Phases named forward have u' >= 0, backward u' <= 0, and sticking ones zero."""
    response = solve_slide(sliding_base(mu, kappa=kappa), noise(seed), vertical=1.0)
    names = np.array([phase.name for phase in response.phases])[response.phase_of_row()]
    v = response["velocity"]
    assert (v[names == SlidePhase.FORWARD] >= -1e-12).all()
    assert (v[names == SlidePhase.BACKWARD] <= 1e-12).all()
    assert (v[names == "stick"] == 0.0).all()


@QUICK
@given(seeds, kappas, st.floats(0.0, 12.0), st.floats(0.0, 6.0))
def test_slide_study_equals_single_runs(seed, kappa, slope, scale):
    """A study's numbers are those of the single solver, also with flights and with a foot of the slope."""
    motion = noise(seed, peak=6.0)
    mu = 0.3
    length = 0.05 if slope else None
    points = slide_study([mu, 0.5], motion, kappa=kappa, slope_deg=slope, slope_length=length, vertical=[scale, 0.5], workers=1)
    for point in points:
        single = solve_slide(
            sliding_base(point.mu, kappa=kappa, slope_deg=slope, slope_length=length), motion, vertical=point.vertical
        ).outcome
        for name in (
            "slips",
            "slip_start_s",
            "max_slip_m",
            "residual_slip_m",
            "final_slip_m",
            "slip_count",
            "fell_off_slope",
            "lifted_off",
            "slides_at_end",
        ):
            assert getattr(point, name) == getattr(single, name), name


@QUICK
@given(seeds, kappas, st.floats(-16.0, 16.0), st.floats(1.0, 1e4))
def test_vertical_motion_on_slope_is_solved_to_the_end(seed, kappa, slope, peak):
    """On a slope shaken up and down only, contact and both limits end at one instant, however hard the shaking: the object flies."""
    up = noise(seed, peak=peak).horizontal
    motion = Motion.from_arrays(np.zeros(up.size), 0.01, vertical=up)
    outcome = solve_slide(sliding_base(0.3, kappa=kappa, slope_deg=slope), motion, vertical=1.0).outcome
    assert outcome.lifted_off == bool((up < -STANDARD_GRAVITY).any())
