"""The three equivalent frequencies of Furukawa et al. (2009) on motions whose answer has a closed form."""

import math

import numpy as np
import pytest

from seisblock.core.errors import ParameterError
from seisblock.measures import Conventions, dominant_frequency, measure, peak_pulse
from seisblock.records import Component, Record

DT = 0.005
RICKER_PGA_PGV = math.exp(0.5) / math.sqrt(2)
RICKER_PULSE = math.pi / (2 * math.sqrt(2))


def frequencies(acceleration, dt=DT, **conventions):
    """Return the equivalent frequencies of one row of samples."""
    record = Record((Component("NS", acceleration),), dt)
    return measure(record, conventions=Conventions(**conventions)).components[0].equivalent_frequency_hz


def ricker(f0, length=40.0, dt=DT):
    """Return the second derivative of a Gaussian, peak frequency f0, in the middle of a record."""
    x = (math.pi * f0 * (np.arange(0, length + dt / 2, dt) - length / 2)) ** 2
    return 3.0 * (1 - 2 * x) * np.exp(-x)


def test_ricker_constants_equal_closed_forms():
    """The closed forms are the numbers that everyone quotes."""
    assert pytest.approx(1.16582, abs=5e-6) == RICKER_PGA_PGV
    assert pytest.approx(1.11072, abs=5e-6) == RICKER_PULSE


@pytest.mark.parametrize("f0", [1.0, 2.0, 4.0])
def test_equivalent_frequencies_of_ricker_wavelet(f0):
    """Results are 1.16582, 1 and 1.11072 times f0 within the effect of 5 ms samples, the 0.05 Hz high-pass and the 0.2 Hz window."""
    result = frequencies(ricker(f0))
    assert result.pga_pgv == pytest.approx(RICKER_PGA_PGV * f0, rel=3e-3)
    assert result.fourier == pytest.approx(f0, rel=2e-3)
    assert result.pulse_width == pytest.approx(RICKER_PULSE * f0, rel=1e-3)


def test_equivalent_frequencies_of_fine_ricker_converge():
    """Without high-pass, with a narrow window and fine samples, the three closed forms come out to 1e-4."""
    result = frequencies(ricker(1.0, dt=0.0005), 0.0005, velocity_highpass_hz=None, fourier_smoothing_hz=0.03)
    assert result.pga_pgv == pytest.approx(RICKER_PGA_PGV, rel=1e-4)
    assert result.fourier == pytest.approx(1.0, rel=1e-4)
    assert result.pulse_width == pytest.approx(RICKER_PULSE, rel=1e-5)


@pytest.mark.parametrize("f0", [0.5, 1.0, 3.0])
@pytest.mark.parametrize(("cycles", "highpass"), [(10, None), (40, 0.05)])
def test_equivalent_frequencies_of_sine_from_rest(f0, cycles, highpass):
    """Method 1 returns f, not f/2: the velocity (A/w)(1 - cos) has lost its mean. So do the other two.

    The high-pass takes part where the record is long against its corner period of 20 s or holds many cycles.
    """
    wave = 2.0 * np.sin(2 * math.pi * f0 * np.arange(0, cycles / f0 + DT / 2, DT))
    result = frequencies(wave, velocity_highpass_hz=highpass)
    assert result.pga_pgv == pytest.approx(f0, rel=3e-3)
    assert result.fourier == pytest.approx(f0, rel=6e-3)
    assert result.pulse_width == pytest.approx(f0, rel=1e-3)


@pytest.mark.parametrize("f0", [0.5, 1.0, 3.0])
def test_equivalent_frequencies_of_cosine(f0):
    """A cosine has a velocity without mean; removing the mean alone gives f, the high-pass costs 0.032 Hz / f at the ends."""
    wave = 2.0 * np.cos(2 * math.pi * f0 * np.arange(0, 20 + DT / 2, DT))
    assert frequencies(wave, velocity_highpass_hz=None).pga_pgv == pytest.approx(f0, rel=1e-3)
    assert frequencies(wave).pga_pgv == pytest.approx(f0, rel=0.035 / f0)


@pytest.mark.parametrize("f0", [0.5, 2.0])
def test_equivalent_frequencies_of_half_sine(f0):
    """A record that is one half sine: v = (A/w)(1 - cos), its swing halved by the mean, gives f by methods 1 and 3."""
    n = round(0.5 / f0 / DT)
    result = frequencies(np.sin(math.pi * np.arange(n + 1) / n), velocity_highpass_hz=None)
    assert result.pga_pgv == pytest.approx(f0, rel=2e-3)
    assert result.pulse_width == pytest.approx(f0, rel=1e-9)


def test_equivalent_frequencies_of_half_sine_between_rests():
    """The pulse keeps its width when rest comes before and after, and nothing about it is ambiguous."""
    n = 100
    wave = np.concatenate((np.zeros(500), -np.sin(math.pi * np.arange(n + 1) / n), np.zeros(700)))
    pulse = peak_pulse(wave, DT)
    assert not pulse.ambiguous
    # the round-off of sin(pi) is still positive: the crossing is at the next sample at most
    assert pulse.frequency_hz == pytest.approx(1 / (2 * n * DT), rel=0.011)


def test_zero_crossings_are_interpolated():
    """A triangle through zero between samples is measured by its straight lines."""
    pulse = peak_pulse(np.array([-1.0, 3.0, -2.0]), 1.0)
    assert pulse.start_s == pytest.approx(0.25)
    assert pulse.end_s == pytest.approx(1.6)
    assert pulse.frequency_hz == pytest.approx(1 / 2.7)
    assert not pulse.ambiguous


@pytest.mark.parametrize("values", [[3.0, 1.0, -1.0, 0.0], [0.0, -1.0, 1.0, 3.0], [1.0, 2.0, 1.0]])
def test_pulse_cut_by_record_is_flagged_ambiguous(values):
    """The record's end stands for the crossing, and the flag and a warning say so."""
    assert peak_pulse(np.array(values), 0.01).ambiguous
    answer = measure(Record((Component("NS", np.array(values)),), 0.01), conventions=Conventions(velocity_highpass_hz=None))
    assert answer.components[0].pulse_width_ambiguous
    assert any("upper bound" in text for text in answer.warnings)


def test_zero_record_has_no_equivalent_frequency():
    """Zero throughout: three times None, and no division by zero."""
    result = frequencies(np.zeros(1000))
    assert (result.pga_pgv, result.fourier, result.pulse_width) == (None, None, None)


def test_dominant_frequency_outside_band_is_none():
    """A sine slower than the band leaves None, not the band's edge; the band can be moved."""
    wave = np.sin(2 * math.pi * 1.0 * np.arange(0, 60, DT))
    assert dominant_frequency(wave, DT, band_hz=(1.2, 25.0)) is None
    assert dominant_frequency(wave, DT, band_hz=(0.5, 25.0)) == pytest.approx(1.0, rel=1e-3)


def test_empty_band_is_rejected():
    """A band beyond half the sampling rate holds nothing."""
    with pytest.raises(ParameterError, match="below the Nyquist frequency"):
        dominant_frequency(np.ones(10), 0.1, band_hz=(6.0, 25.0))
