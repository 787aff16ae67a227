"""Pulses at the overturning threshold: linear and exact equations, and the table with both."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from seisblock.bodies.block import Block
from seisblock.core.errors import ParameterError
from seisblock.core.roots import bracketed_root
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.criteria.compare import PREFERRED_FREQUENCY, overturning_card, unique_criteria
from seisblock.criteria.pulses import _end_of_half_sine, half_sine_acceleration, half_sine_ratio
from seisblock.models.rock.verdicts import rock_verdict
from seisblock.records import Motion

STONE = Block(0.24, 0.63)
VALUES = 6.278
"""What 0.1.0 called exact for this stone, m/s^2: the linear equation's threshold."""


def frequency_of(linear_threshold):
    """Return the frequency, Hz, at which the linear equation gives a stone this threshold."""
    from scipy.optimize import brentq

    p = STONE.frequency_parameter()
    return brentq(lambda f: G * STONE.slenderness * half_sine_ratio(2 * math.pi * f / p) - linear_threshold, 0.3, 5.0, xtol=1e-12)


def test_nonlinear_threshold_exceeds_linear():
    """The exact threshold of a stone of .24 x .63 m is 6.574 m/s^2, that of the linear equation 6.278 m/s^2 (N13)."""
    result = half_sine_acceleration(STONE.slenderness, STONE.frequency_parameter(), frequency_of(VALUES))
    assert result == pytest.approx(6.574, abs=1e-3)


@pytest.mark.parametrize("frequency", [0.5, 2.0, 3.0])
@pytest.mark.parametrize("block", [STONE, Block(0.4, 1.0, centroid_height=0.7), Block(0.3, 2.0)])
def test_half_sine_threshold_equals_solve_rock(block, frequency):
    """A half sine a hair below stands, a hair above falls, in `rock` itself."""
    samples = 4000
    shape = np.sin(np.pi * np.arange(samples + 1) / samples)
    pulse = Motion.from_arrays(np.concatenate([shape, np.zeros(10)]), 0.5 / frequency / samples)
    level = half_sine_acceleration(block.slenderness, block.frequency_parameter(), frequency)
    assert [rock_verdict(block, pulse, scale=level * share).overturned for share in (1 - 1e-5, 1 + 1e-5)] == [False, True]


@given(st.floats(0.01, 0.6), st.floats(0.3, 8.0), st.floats(0.2, 5.0))
@settings(max_examples=40, deadline=None)
def test_nonlinear_threshold_approaches_linear_for_slender_blocks(alpha, p, frequency):
    """The two differ by the order of alpha^2, and never is the threshold below that of rocking."""
    exact = half_sine_acceleration(alpha, p, frequency)
    linear = G * alpha * half_sine_ratio(2 * math.pi * frequency / p)
    assert G * math.tan(alpha) < exact
    assert abs(exact / linear - 1.0) < 1.2 * alpha**2 + 1e-6


@pytest.mark.parametrize(("alpha", "p", "f"), [(0.0, 1.0, 1.0), (1.6, 1.0, 1.0), (0.3, -1.0, 1.0), (0.3, 1.0, math.nan)])
def test_pulse_criterion_rejects_invalid_input(alpha, p, f):
    """One sentence each."""
    with pytest.raises(ParameterError):
        half_sine_acceleration(alpha, p, f)


def test_criterion_with_several_frequencies_counts_once():
    """Seven criteria take three frequencies each: the card has a row for each, the count has one (N13)."""
    rows = overturning_card(STONE, 5.0, 0.5, {"pga_pgv": 1.6, "fourier": 2.0, "pulse_width": None})
    once = unique_criteria(rows)
    assert len(rows) == 6 + 8 * 2
    assert [row.criterion for row in once] == list(dict.fromkeys(row.criterion for row in rows))
    assert {row.frequency for row in once} == {None, PREFERRED_FREQUENCY}
    assert unique_criteria(rows, "fourier")[-1].frequency == "fourier"
    names = {row.criterion for row in rows}
    assert {"half sine, linear", "half sine, nonlinear"} <= names
    assert not any("half sine, exact" in name for name in names)


def test_half_sine_that_is_long_for_the_block_overturns_little_above_its_threshold():
    """The factor on the threshold grows with the height, from a millimetre on."""
    alpha, heights = math.atan(1.0 / 3.0), (0.001, 0.002, 0.003, 0.005, 0.01, 0.03, 0.1)
    parameters = [math.sqrt(1.5 * G / math.hypot(height, height / 3.0)) for height in heights]
    ratios = [half_sine_acceleration(alpha, p, 1.0, G) / (G * math.tan(alpha)) for p in parameters]
    assert ratios == sorted(ratios) and 1.0 < ratios[0] < 1.002 and 1.1 < ratios[-1] < 1.13


@pytest.mark.parametrize(
    ("function", "low", "high", "root"),
    [
        (lambda x: math.cos(x) - x, 0.0, 1.0, 0.7390851332151607),
        (lambda x: x**9, -1.0, 4.0, 0.0),
        (lambda x: math.tanh(1e6 * (x - 0.3)), 0.0, 1.0, 0.3),
        (lambda x: math.exp(-50.0 * x) - 1e-9, 0.0, 5.0, 0.18 * math.log(10.0)),
        (lambda x: 1.0 if x > 1.0 / 3.0 else -1.0, 0.0, 1.0, 1.0 / 3.0),
        (lambda x: 2.0 - x, 3.0, 2.0, 2.0),
    ],
)
def test_bracketed_root_is_between_a_change_of_sign(function, low, high, root):
    """Of flat, steep, curved and discontinuous functions, in fewer than twice the evaluations of a bisection."""
    calls = []

    def counted(x):
        calls.append(x)
        return function(x)

    assert bracketed_root(counted, low, high, 1e-13) == pytest.approx(root, abs=1.1e-13)
    assert len(calls) < 2 * math.log2(5.0 / 1e-13)


@given(st.floats(0.05, 1.2), st.floats(0.3, 8.0), st.floats(0.2, 5.0), st.floats(1.01, 10.0))
@settings(max_examples=30, deadline=None)
def test_end_of_half_sine_equals_scipy(alpha, p, frequency, x):
    from scipy.integrate import solve_ivp

    omega, a = 2.0 * math.pi * frequency, x * math.tan(alpha)
    start, end = math.asin(1.0 / x) / omega, math.pi / omega
    rate = lambda t, y: (y[1], p * p * (a * math.sin(omega * t) * math.cos(alpha - y[0]) - math.sin(alpha - y[0])))  # noqa: E731
    expected = solve_ivp(rate, (start, end), (0.0, 0.0), method="DOP853", rtol=1e-12, atol=1e-14 * alpha).y[:, -1]
    growth = math.exp(p * (end - start))
    np.testing.assert_allclose(_end_of_half_sine(alpha, p, omega, x), expected, rtol=1e-10, atol=1e-12 * growth)
