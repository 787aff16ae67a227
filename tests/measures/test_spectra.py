"""Spectra of oscillators with known solutions, and spectral windows."""

import math

import numpy as np
import pytest

from seisblock.core.errors import ParameterError
from seisblock.measures import fourier_amplitude, response_spectrum


def test_step_response_is_twice_static():
    """An undamped oscillator under a sudden constant a reaches 2 a/w^2, the velocity a/w and the absolute acceleration 2 a.

    The constant ends after whole periods, when the oscillator is back where it began.
    """
    spectrum = response_spectrum(np.full(1001, 3.0), 0.01, [0.25, 1.0, 5.0], damping=0.0)
    omega = 2 * math.pi / spectrum.period_s
    np.testing.assert_allclose(spectrum.sd_m, 6 / omega**2, rtol=3e-3)
    np.testing.assert_allclose(spectrum.sv_m_s, 3 / omega, rtol=3e-3)
    np.testing.assert_allclose(spectrum.sa_m_s2, 6, rtol=3e-3)


def test_resonance_amplification_is_inverse_of_twice_damping():
    """A long sine at the natural period amplifies 1/(2h) in displacement."""
    h, period = 0.05, 0.5
    wave = np.sin(2 * math.pi / period * np.arange(0, 60, 0.01))
    spectrum = response_spectrum(wave, 0.01, [period], damping=h)
    omega = 2 * math.pi / period
    # straight lines between 50 samples per cycle carry (sinc)^2 of the sine
    line = np.sinc(0.01 / period) ** 2
    assert spectrum.sd_m[0] * omega**2 == pytest.approx(line / (2 * h), rel=3e-3)


def test_spectrum_limits_at_short_and_long_periods():
    """A stiff oscillator has the PGA, a slow one the ground's displacement."""
    t = np.arange(0, 10, 0.01)
    a = np.exp(-((t - 5) ** 2)) * np.sin(2 * np.pi * t)
    spectrum = response_spectrum(a, 0.01, [0.01, 200.0])
    assert spectrum.sa_m_s2[0] == pytest.approx(np.abs(a).max(), rel=2e-3)
    ground = np.cumsum(np.cumsum(a)) * 1e-4
    assert spectrum.sd_m[1] == pytest.approx(np.abs(ground).max(), rel=0.05)


@pytest.mark.parametrize("damping", [0.0, 0.05, 0.5])
@pytest.mark.parametrize("period", [0.05, 0.3, 2.0, 10.0])
def test_spectrum_includes_free_vibration_after_record(period, damping):
    """A half sine that ends the record counts as much as one with rest behind it, for every response."""
    pulse = np.sin(math.pi * np.arange(101) / 100)
    cut = response_spectrum(pulse, 0.01, [period], damping=damping)
    full = response_spectrum(np.concatenate((pulse, np.zeros(3000))), 0.01, [period], damping=damping)
    for name in ("sa_m_s2", "sv_m_s", "sd_m"):
        np.testing.assert_allclose(getattr(cut, name), getattr(full, name), rtol=2e-5)


def test_spectrum_at_long_period_after_short_pulse():
    """A half sine of 1 s and 1 m/s^2 gives a 10 s oscillator its largest swing long after the record: 0.98 m, not 0.32 m."""
    pulse = np.sin(math.pi * np.arange(1001) / 1000)
    spectrum = response_spectrum(pulse, 0.001, [10.0], damping=0.0).sd_m[0]
    # free swing after a half sine of duration d: 2 r / (1 - r^2) cos(pi / 2 r) / w^2 with r = T / 2 d
    ratio = 5.0
    expected = 2 * ratio / (ratio**2 - 1) * math.cos(math.pi / (2 * ratio)) * (10 / (2 * math.pi)) ** 2
    assert spectrum == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("period", [0.02, 0.0731, 0.4, 1.0])
def test_spectrum_is_independent_of_interpolated_points(period):
    """Weak shaking of high frequency: 64 times as many points on the same straight lines find nothing that was hidden, to 1e-4."""
    wave = np.random.default_rng(4).standard_normal(400) * np.tile([1.0, -1.0], 200)
    fine = np.interp(np.arange(399 * 64 + 1) / 64, np.arange(400), wave)
    coarse, exact = response_spectrum(wave, 0.01, [period]), response_spectrum(fine, 0.01 / 64, [period])
    for name in ("sa_m_s2", "sv_m_s", "sd_m"):
        np.testing.assert_allclose(getattr(coarse, name), getattr(exact, name), rtol=1e-4)


@pytest.mark.parametrize(("periods", "damping"), [([0.0], 0.05), ([-1.0], 0.05), ([np.nan], 0.05), ([1.0], 1.0), ([1.0], -0.1)])
def test_spectrum_rejects_invalid_period_and_damping(periods, damping):
    """Periods must be positive and damping ratios in [0, 1)."""
    with pytest.raises(ParameterError):
        response_spectrum(np.ones(10), 0.01, periods, damping=damping)


def test_parzen_window_smooths_energy():
    """The energy is that of the record (Parseval), smoothed or not, and a smooth spectrum is left as it is."""
    a = np.zeros(4000)
    a[2000] = 1.0
    a[2001] = -1.0
    frequency, amplitude = fourier_amplitude(a, 0.01, smoothing_hz=0.2)
    df = frequency[1]
    energy = (2 * (amplitude**2).sum() - amplitude[0] ** 2 - amplitude[-1] ** 2) * df
    assert energy == pytest.approx((a**2).sum() * 0.01, rel=1e-9)
    smooth = frequency > 1.0  # nearer to zero the spectrum bends within the window
    np.testing.assert_allclose(amplitude[smooth], 0.02 * np.sin(np.pi * frequency[smooth] * 0.01), rtol=5e-3)


def test_parzen_window_has_its_bandwidth():
    """1 / integral of the squared window is the bandwidth asked for: a spectral line spreads to 3/4 u over it."""
    dt, f0, bandwidth = 0.01, 5.0, 0.4
    wave = np.sin(2 * np.pi * f0 * np.arange(0, 2000, dt))
    frequency, amplitude = fourier_amplitude(wave, dt, smoothing_hz=bandwidth)
    nearby = np.abs(frequency - f0) < 2.0
    window = amplitude[nearby] ** 2
    window /= window.sum() * frequency[1]
    assert 1 / ((window**2).sum() * frequency[1]) == pytest.approx(bandwidth, rel=5e-3)


def test_smoothing_rejects_non_positive_width():
    """A window without width is refused."""
    with pytest.raises(ParameterError):
        fourier_amplitude(np.ones(10), 0.01, smoothing_hz=0.0)
