"""[Housner1963]_ and what the literature makes of it: free rocking, impacts, and pulses that just overturn."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from seisblock.bodies.block import Block, from_slenderness
from seisblock.core.errors import ParameterError
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.criteria.pulses import half_sine_ratio, one_sine_ratio, rectangular_ratio
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.solve import solve_rock
from seisblock.models.rock.verdicts import rock_verdict
from seisblock.records import Motion
from seisblock.validation.housner import CASES

STILL = Motion.from_arrays(np.zeros(2001), 0.01)
ALPHA, P = 0.25, 2.14


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.key)
def test_cases(case):
    """Every statement has the verdict it claims."""
    assert case.run().verdict == case.status


def impact_times(block, initial, **options):
    """Return the times of the impacts of free rocking."""
    response = solve_rock(block, STILL, initial=initial, **options)
    return [event.time_s for event in response.events if event.name == "impact"], response


@pytest.mark.parametrize("share", [0.05, 0.4, 0.9])
def test_linear_free_rocking_period(share):
    """T = 4/p acosh(1/(1 - theta0/alpha)) between alternate impacts without loss."""
    times, _ = impact_times(from_slenderness(ALPHA, P), (share * ALPHA, 0.0), restitution=1.0, linear=True)
    period = 4 / P * math.acosh(1 / (1 - share))
    assert times[0] == pytest.approx(period / 4, abs=1e-12)
    np.testing.assert_allclose(np.diff(times[:8]), period / 2, rtol=0, atol=1e-11)


@pytest.mark.parametrize("share", [0.05, 0.4, 0.9])
def test_exact_free_rocking_period(share):
    """The quarter period is the quadrature of dphi/sqrt(2 p^2 (cos(alpha - phi0) - cos(alpha - phi)))."""
    times, _ = impact_times(from_slenderness(ALPHA, P), (share * ALPHA, 0.0), restitution=1.0)
    top = share * ALPHA

    def slowness(u):
        phi = top * (1 - u * u)
        return 2 * top * u / math.sqrt(2 * P**2 * 2 * math.sin(ALPHA - (phi + top) / 2) * math.sin((top - phi) / 2))

    quarter, _ = quad(slowness, 0, 1, epsabs=0, epsrel=1e-12)
    assert times[0] == pytest.approx(quarter, rel=1e-10)
    np.testing.assert_allclose(np.diff(times[:8]), 2 * quarter, rtol=1e-10)


def test_amplitudes_after_impacts():
    """1 - u_n = sqrt(1 - e^(2n) (1 - (1 - u_0)^2)), u = theta/alpha (linear): the energy falls by e^2 per impact."""
    e, share = 0.9, 0.7
    response = solve_rock(from_slenderness(ALPHA, P), STILL, initial=(share * ALPHA, 0.0), restitution=e, linear=True)
    theta = np.abs(response["rotation"])
    times = [event.time_s for event in response.events if event.name == "impact"]
    for n in range(1, 7):
        inside = (response.time > times[n - 1]) & (response.time < times[n])
        top = ALPHA * (1 - math.sqrt(1 - e ** (2 * n) * (1 - (1 - share) ** 2)))
        rate = [event for event in response.events if event.name == "impact"][n - 1].after[1]
        assert abs(rate) == pytest.approx(e**n * P * ALPHA * math.sqrt(1 - (1 - share) ** 2), rel=1e-10)
        # samples miss the top by at most p^2 alpha dt^2/8
        assert theta[inside].max() == pytest.approx(top, abs=P**2 * ALPHA * 0.01**2 / 8)
        assert theta[inside].max() <= top * (1 + 1e-12)


@pytest.mark.parametrize("block", [Block(0.3, 1.0), Block(0.4, 1.0, centroid_offset=0.06, centroid_height=0.7)])
def test_angular_momentum_about_the_new_corner_is_kept(block):
    """I_G w + m (r x v) about the corner that is struck is the same on both sides of the impact."""
    response = solve_rock(block, STILL, initial=(0.1, 0.0))
    right, left = block.arms
    mass, inertia = block.total_mass, block.gyration_squared * block.total_mass
    for event in [event for event in response.events if event.name == "impact"][:6]:
        before, after = event.before[1], event.after[1]
        to_left = before < 0
        old, new = (right, left) if to_left else (left, right)
        # velocity of the centre before the impact, and the moment of momentum about the new corner
        momentum = inertia * before + mass * before * (block.centre**2 - old * new)
        assert (inertia + mass * (block.centre**2 + new**2)) * after == pytest.approx(momentum, rel=1e-13)


def test_restitution_of_a_rectangle():
    """The restitution is 1 - 1.5 sin^2(alpha); Housner's r is its square."""
    block = Block(0.5, 1.5)
    assert block.restitution == pytest.approx(1 - 1.5 * math.sin(block.slenderness) ** 2, rel=1e-14)
    assert solve_rock(block, STILL).outcome.restitution == block.restitution


def sine(x, w, cycles, samples=2000):
    """Return a pulse of so many half cycles whose amplitude is x alpha g, ending in zeros."""
    step = math.pi / (w * P) / samples
    k = np.arange(cycles * samples + 2)
    return Motion.from_arrays(x * G * ALPHA * np.where(k < cycles * samples, np.sin(np.pi * k / samples), 0.0), step)


def threshold(pulse, low, high, e=0.9):
    """Bisect the amplitude at which the verdict of the linear solver changes."""
    block = from_slenderness(ALPHA, P)
    above = rock_verdict(block, pulse(high), options=RockOptions(restitution=e, linear=True)).overturned
    for _ in range(30):
        middle = (low + high) / 2
        if rock_verdict(block, pulse(middle), options=RockOptions(restitution=e, linear=True)).overturned == above:
            high = middle
        else:
            low = middle
    return (low + high) / 2


@pytest.mark.parametrize(("w", "x"), [(1.0, 1.3224), (2.0, 1.8007), (5.0, 3.2891)])
def test_half_sine(w, x):
    """The closed form equals the threshold of the simulation, unlike Housner's (6)."""
    assert half_sine_ratio(w) == pytest.approx(x, abs=5e-5)
    assert threshold(lambda a: sine(a, w, 1), 1.0, 6.0) == pytest.approx(half_sine_ratio(w), rel=1e-5)
    assert abs(half_sine_ratio(w) / math.hypot(1, w) - 1) > 0.06


def test_one_sine_without_impact():
    """X = 7.16813 at W = 5."""
    assert one_sine_ratio(5.0) == pytest.approx(7.16813, abs=5e-6)
    assert threshold(lambda a: sine(a, 5.0, 2), 6.8, 8.0) == pytest.approx(one_sine_ratio(5.0), rel=2e-6)


def test_zhang_and_makris_safe_window():
    """One sine, p = 2.14, alpha = 0.25, e = 0.9, W = 5: overturns from 3.019 to 6.318 and above 7.168, safe between."""
    result = [threshold(lambda a: sine(a, 5.0, 2), low, high) for low, high in ((2, 4), (5, 6.6), (6.8, 8))]
    np.testing.assert_allclose(result, [3.019, 6.318, 7.168], atol=5e-4)
    block = from_slenderness(ALPHA, P)
    verdicts = [
        rock_verdict(block, sine(x, 5.0, 2), options=RockOptions(restitution=0.9, linear=True)).overturned for x in (2.9, 5, 6.7, 7.5)
    ]
    assert verdicts == [False, True, False, True]


@pytest.mark.parametrize("duration", [0.2, 0.5, 1.5])
def test_rectangular_pulse(duration):
    """X = 1/(1 - exp(-p t))."""

    def pulse(x):
        k = np.arange(4003)
        # the falling flank takes one step: half of it counts
        return Motion.from_arrays(x * G * ALPHA * (k <= 4000), duration / 4000.5)

    assert threshold(pulse, 1.001, 9.0) == pytest.approx(rectangular_ratio(duration, P), rel=1e-6)


def test_threshold_of_rocking_is_the_band():
    """Rocking starts above g tan(alpha), at the exact crossing between samples; with vertical motion above (g + a_v) tan(alpha)."""
    block = Block(0.4, 1.2)
    ramp = np.linspace(0.0, 5.0, 11)
    response = solve_rock(block, Motion.from_arrays(ramp, 0.1))
    assert response.outcome.rocking_start_s == pytest.approx(G / 3 / 5.0, rel=1e-14)
    up = solve_rock(block, Motion.from_arrays(ramp, 0.1, vertical=np.full(11, 2.0)), vertical=True)
    assert up.outcome.rocking_start_s == pytest.approx((G + 2) / 3 / 5.0, rel=1e-14)
    assert solve_rock(block, Motion.from_arrays(np.full(50, G / 3), 0.1)).outcome.rocks is False


@pytest.mark.parametrize("function", [half_sine_ratio, one_sine_ratio, lambda w: rectangular_ratio(w, 1.0)])
@pytest.mark.parametrize("value", [0.0, -1.0, math.nan])
def test_pulse_formulas_reject_non_positive_input(function, value):
    """W, t and p must be positive."""
    with pytest.raises(ParameterError, match="positive"):
        function(value)


def test_free_fall_after_the_record_is_timed_exactly():
    """Passing alpha and lying down after the record's end come when a longer, still record brings them."""
    pulse = np.zeros(400)
    pulse[:60] = 5.0 * np.sin(np.pi * np.arange(60) / 60)
    block = Block(0.24, 0.8)
    amplitude = brentq(lambda s: 0.5 - rock_verdict(block, Motion.from_arrays(s * pulse, 0.01)).overturned, 0.1, 3.0, xtol=1e-9) + 1e-3
    for samples in (62, 75, 90):
        cut = solve_rock(block, Motion.from_arrays(amplitude * pulse[:samples], 0.01)).outcome
        full = solve_rock(block, Motion.from_arrays(np.append(amplitude * pulse, np.zeros(2000)), 0.01)).outcome
        assert cut.decided_after_record
        assert not full.decided_after_record
        assert cut.overturned is full.overturned is True
        assert cut.alpha_passed_s == pytest.approx(full.alpha_passed_s, abs=1e-9)
        assert cut.overturning_time_s == pytest.approx(full.overturning_time_s, abs=1e-9)
