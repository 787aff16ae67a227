"""Arias intensity, significant duration and JMA intensity against closed forms."""

import math

import numpy as np
import pytest

from seisblock.measures import (
    arias_intensity,
    cumulative_absolute_velocity,
    jma_class,
    jma_intensity,
    measure,
    significant_duration,
)
from seisblock.records import Component, Record
from seisblock.records.seismic_intensity import _jma_filter

G = 9.80665


def three(acceleration, dt, vertical=None):
    """Return a record with one row as NS, and EW and UD at rest."""
    still = np.zeros_like(acceleration)
    return Record((Component("NS", acceleration), Component("EW", still), Component("UD", still if vertical is None else vertical)), dt)


def test_jma_intensity_of_skew_horizontals_is_invariant():
    """The same ground seen along N10E and N50E has the intensity that NS and EW give."""
    t = np.arange(0.0, 40.0, 0.01)
    north, east, up = (np.sin(w * t) * np.exp(-(((t - 20) / 6) ** 2)) for w in (9.0, 14.0, 21.0))
    ground = Record((Component("NS", 3 * north, 0.0), Component("EW", 2 * east, 90.0), Component("UD", up)), 0.01)
    items = [3 * north * math.cos(math.radians(a)) + 2 * east * math.sin(math.radians(a)) for a in (10.0, 50.0)]
    askew = Record((Component("10", items[0], 10.0), Component("50", items[1], 50.0), Component("UD", up)), 0.01)
    assert jma_intensity(askew) == pytest.approx(jma_intensity(ground), rel=1e-12)


def test_arias_intensity_of_constant_and_ramp():
    """pi/(2g) a^2 T, and a third of it for a ramp, however coarse the samples."""
    assert arias_intensity(np.full(3, 2.0), 5.0) == pytest.approx(math.pi / (2 * G) * 4 * 10, rel=1e-14)
    assert arias_intensity(np.array([0.0, 2.0]), 10.0) == pytest.approx(math.pi / (2 * G) * 4 * 10 / 3, rel=1e-14)
    assert arias_intensity(np.array([-2.0, 2.0]), 10.0, gravity=9.8) == pytest.approx(math.pi / 19.6 * 4 * 10 / 3, rel=1e-14)


def test_significant_duration_of_a_constant_is_nine_tenths():
    """Energy comes evenly."""
    assert significant_duration(np.full(11, 3.0), 1.0) == pytest.approx(9.0, rel=1e-12)


@pytest.mark.parametrize("values", [[0.0, 1.0], [1.0, 0.0], [0.0, 0.5, 1.0]])
def test_significant_duration_of_a_ramp(values):
    """Energy grows with the cube of time: 5 % at the cube root of 0.05, whether one interval or two hold it."""
    dt = 10.0 / (len(values) - 1)
    assert significant_duration(np.array(values), dt) == pytest.approx(10 * (0.95 ** (1 / 3) - 0.05 ** (1 / 3)), rel=1e-12)


def test_significant_duration_through_zero():
    """A line from -1 to 1: the shares lie symmetrically about its zero."""
    assert significant_duration(np.array([-1.0, 1.0]), 2.0) == pytest.approx(2 * 0.9 ** (1 / 3), rel=1e-12)


def test_significant_duration_of_rest_is_zero():
    """No energy, no duration, no division by zero."""
    assert significant_duration(np.zeros(10), 0.1) == 0.0


def test_jma_filter_uses_every_coefficient():
    """[JMA1996]_ at 20 Hz: the squares of y = 2 in 1, 0.694, 0.241, 0.0557, 0.009664, 0.00134, 0.000155 add up to 15.677824, by hand."""
    terms = [1.0, 2.776, 3.856, 3.5648, 2.473984, 1.37216, 0.63488]
    assert sum(terms) == pytest.approx(15.677824, rel=1e-14)
    assert _jma_filter(np.array([0.0, 20.0])).tolist() == [0.0, pytest.approx((20.0 * 15.677824) ** -0.5, rel=1e-14)]


@pytest.mark.parametrize("f", [0.3, 1.0, 2.0, 8.0])
def test_jma_intensity_of_a_sine(f):
    """A long sine of one component: |F(f)| times its amplitude is exceeded for 0.3 s near its peaks."""
    dt, seconds, gal = 0.005, 60, 100.0
    t = np.arange(0, seconds, dt)
    y = f / 10
    high = (1 + 0.694 * y**2 + 0.241 * y**4 + 0.0557 * y**6 + 0.009664 * y**8 + 0.00134 * y**10 + 0.000155 * y**12) ** -0.5
    gain = f**-0.5 * high * (1 - math.exp(-((f / 0.5) ** 3))) ** 0.5
    # 0.3 s of 60 s: the share of time above a0 is 2/pi acos(a0/A)
    a0 = gain * gal * math.cos(math.pi / 2 * 0.3 / seconds)
    assert jma_intensity(three(gal / 100 * np.sin(2 * math.pi * f * t), dt)) == pytest.approx(2 * math.log10(a0) + 0.94, abs=2e-3)


def test_jma_intensity_ignores_offset():
    """The filter has no response at zero frequency."""
    wave = np.sin(2 * np.pi * np.arange(0, 20, 0.01))
    assert jma_intensity(three(wave + 3.0, 0.01)) == pytest.approx(jma_intensity(three(wave, 0.01)), abs=1e-12)


def test_jma_intensity_requires_three_components():
    """The intensity is None, with a warning that names the missing component."""
    single = Record((Component("NS", np.sin(np.arange(1000.0))),), 0.01)
    answer = measure(single)
    assert answer.jma_intensity is None
    assert answer.jma_class is None
    assert any("two horizontal components and the vertical" in text for text in answer.warnings)


def test_jma_intensity_of_short_or_zero_record_is_none():
    """None again, each with its reason."""
    assert "shorter than 0.3 s" in " ".join(measure(three(np.ones(20), 0.01)).warnings)
    assert "all samples are zero" in " ".join(measure(three(np.zeros(200), 0.01)).warnings)


@pytest.mark.parametrize(
    ("intensity", "name"),
    [(-2, "0"), (0.49, "0"), (0.5, "1"), (4.49, "4"), (4.5, "5-"), (4.996, "5+"), (5.49, "5+"), (5.5, "6-"), (6.0, "6+"), (6.5, "7")],
)
def test_jma_class_rounds_then_truncates(intensity, name):
    """Rounded to two decimals, cut to one, classed."""
    assert jma_class(intensity) == name


def test_cumulative_absolute_velocity_is_exact_between_samples():
    """A fine trapezium rule over the same polygon, a sine in closed form, and scaling."""
    row = np.random.default_rng(4).standard_normal(500)
    fine = np.interp(np.arange(0.0, 499.0, 1e-3), np.arange(500), row)
    assert cumulative_absolute_velocity(row, 0.01) == pytest.approx(0.01 * 1e-3 * np.abs(fine).sum(), rel=1e-4)
    sine = np.sin(2 * np.pi * np.arange(100001) * 1e-4)
    # ten cycles of 1 Hz: 2 / pi each second
    assert cumulative_absolute_velocity(sine, 1e-4) == pytest.approx(20.0 / np.pi, rel=1e-6)
    assert cumulative_absolute_velocity(-3.0 * row, 0.01) == pytest.approx(3.0 * cumulative_absolute_velocity(row, 0.01))
