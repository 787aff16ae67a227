"""Peaks are those of the piecewise linear motion, on the stated baseline."""

import math

import numpy as np
import pytest

from seisblock.core.errors import ParameterError
from seisblock.measures import ground_history, peak_acceleration, peak_displacement, peak_horizontal, peak_velocity
from seisblock.records import Component, Record
from seisblock.records.process import component_at_azimuth

T = np.arange(0, 20.0005, 0.001)
OMEGA = 2 * math.pi


def test_peak_acceleration_is_the_first_of_its_size():
    """The absolute value counts, and the first of two equals."""
    assert peak_acceleration(np.array([0.0, -3.0, 3.0])) == (3.0, 1)


def test_pgv_and_pgd_of_sine_from_rest():
    """PGV = A/w and PGD = A/w^2, without the drift that integration from rest gives it."""
    history = ground_history(2 * np.sin(OMEGA * T), 0.001, highpass_hz=None)
    assert peak_velocity(history, 0.001) == pytest.approx(2 / OMEGA, rel=1e-5)
    assert peak_displacement(history) == pytest.approx(2 / OMEGA**2, rel=1e-4)


@pytest.mark.parametrize("highpass", [None, 0.05])
def test_displacement_is_zero_at_both_ends(highpass):
    """The velocity has no mean left, exactly."""
    rng = np.random.default_rng(2)
    history = ground_history(rng.standard_normal(3000), 0.01, highpass_hz=highpass)
    assert history.displacement[0] == 0.0
    assert abs(history.displacement[-1]) < 1e-12


def test_offset_does_not_become_velocity():
    """Ten gal of offset on a 60 s record would integrate to 600 kine; the high-pass leaves nothing of it."""
    t = np.arange(0, 60, 0.01)
    pulse = np.exp(-((t - 30) ** 2)) * np.sin(OMEGA * t)
    clean = peak_velocity(ground_history(pulse, 0.01), 0.01)
    assert peak_velocity(ground_history(pulse + 0.1, 0.01), 0.01) == pytest.approx(clean, abs=1e-12)


def test_velocity_peaks_between_samples():
    """From +1 to -1 in one step, velocity peaks half way: dt/4 above its ends."""
    history = ground_history(np.array([0.0, 1.0, -1.0, 0.0]), 1.0, highpass_hz=None)
    assert peak_velocity(history, 1.0) == pytest.approx(max(abs(history.velocity[1] + 0.25), *abs(history.velocity)), rel=1e-14)


def test_highpass_zero_is_off_and_negative_is_rejected():
    """0 switches the filter off, below it there is nothing."""
    wave = np.sin(OMEGA * T)
    zero, none = (ground_history(wave, 0.001, highpass_hz=hz).velocity for hz in (0, None))
    np.testing.assert_array_equal(zero, none)
    with pytest.raises(ParameterError):
        ground_history(wave, 0.001, highpass_hz=-1.0)


def test_worst_azimuth_has_largest_peak():
    """No azimuth of a fine sweep has a larger peak, and the one named has exactly that peak."""
    rng = np.random.default_rng(3)
    record = Record((Component("NS", rng.standard_normal(500)), Component("EW", rng.standard_normal(500))), 0.01, offset_s=2.0)
    worst = peak_horizontal(record)
    sweep = [np.abs(component_at_azimuth(record, azimuth).acceleration).max() for azimuth in np.arange(0, 180, 0.25)]
    assert max(sweep) <= worst.pga_m_s2 * (1 + 1e-14)
    along = component_at_azimuth(record, worst.azimuth_deg).acceleration
    assert along.max() == pytest.approx(worst.pga_m_s2, rel=1e-13)
    assert worst.time_s == pytest.approx(2.0 + 0.01 * int(along.argmax()))


def test_worst_azimuth_with_oblique_axes():
    """A pulse due 60 degrees is found from components at 0 and 45 degrees."""
    pulse = np.array([0.0, 1.0, 0.0])
    parts = [Component(f"{az}", pulse * math.cos(math.radians(60 - az)), az) for az in (0.0, 45.0)]
    worst = peak_horizontal(Record(parts, 0.1))
    assert worst.azimuth_deg == pytest.approx(60.0)
    assert worst.pga_m_s2 == pytest.approx(1.0)


def test_horizontals_without_azimuth_have_a_vector_but_no_direction():
    """They are taken as orthogonal; one horizontal alone has no vector."""
    pair = Record((Component("H1", np.array([3.0, 0.0])), Component("H2", np.array([4.0, 0.0]))), 0.1)
    assert (peak_horizontal(pair).pga_m_s2, peak_horizontal(pair).azimuth_deg) == (5.0, None)
    assert peak_horizontal(Record((Component("NS", np.ones(2)), Component("UD", np.ones(2))), 0.1)) is None
