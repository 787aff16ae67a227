"""Processing of a long record in chunks equals that of the whole record."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import butter, sosfilt

from seisblock.measures import frequency, peaks, spectra
from seisblock.measures.baseline import ground_history
from seisblock.records import filters, integrals

DT = 0.01
ROW = np.random.default_rng(5).standard_normal(5000) + 0.2


@pytest.fixture
def small_pieces(monkeypatch):
    """Let a piece be some dozens of samples, which divide no length here."""
    for module in (filters, integrals, frequency):
        monkeypatch.setattr(module, "CHUNK_SIZE", 77)


def test_chunked_integrals_equal_whole_bit_for_bit(small_pieces, monkeypatch):
    """Sums go on from piece to piece in the same order."""
    result = integrals.integrate(ROW, DT), integrals.integrate_twice(ROW, DT, 0.3)
    monkeypatch.setattr(integrals, "CHUNK_SIZE", 10**6)
    at_once = integrals.integrate(ROW, DT), integrals.integrate_twice(ROW, DT, 0.3)
    for first, second in zip(result, at_once, strict=True):
        np.testing.assert_array_equal(first, second)
    velocity = np.concatenate(([0.0], np.cumsum(0.5 * DT * (ROW[1:] + ROW[:-1]))))
    np.testing.assert_array_equal(result[0], velocity)


SAME = 1e-12
"""Round-off of a filter, over the largest sample that goes in: one that contracts its products differs by so much."""


def mirror_extension(row, before, after):
    """Return a row with its mirror images."""
    longer = np.concatenate((np.full(before, np.nan), row, np.full(after, np.nan)))
    filters._fill_mirror_image(longer, before, row.size)
    return longer


@pytest.mark.kernel
@pytest.mark.parametrize("hz", [0.5, 0.02])
def test_chunked_highpass_equals_scipy(small_pieces, hz):
    """Forwards and backwards with the memory carried on from piece to piece; padding shorter and longer than the record."""
    sections, pad = filters._design(DT, hz)
    theirs = np.array([[gain, -2.0 * gain, gain, 1.0, first, second] for gain, first, second in sections])
    np.testing.assert_allclose(theirs, butter(4, hz, "highpass", fs=1.0 / DT, output="sos"), rtol=0.0, atol=1e-15)
    row = mirror_extension(ROW - filters.end_line(ROW, DT, hz), pad, pad)
    rest = theirs[0, 0] * np.array([[-1.0, 1.0], [0.0, 0.0]])  # of a constant nothing is left
    for _ in range(2):
        row = sosfilt(theirs, row, zi=rest * row[0])[0][::-1]
    expected = row[pad : pad + ROW.size]
    np.testing.assert_allclose(filters.highpass_samples(ROW, DT, hz), expected, rtol=0.0, atol=SAME * np.abs(ROW).max())
    forwards = mirror_extension(ROW - filters.end_line(ROW, DT, hz), pad, 0)
    expected = sosfilt(theirs, forwards)[pad:]
    np.testing.assert_allclose(filters.causal_highpass_samples(ROW, DT, hz), expected, rtol=0.0, atol=SAME * np.abs(ROW).max())


@pytest.mark.parametrize("dt", [0.001, 0.005, 0.01, 0.02])
@pytest.mark.parametrize("share", [1e-4, 0.01, 0.3, 0.98])
def test_butterworth_sections_equal_scipy(dt, share):
    """The design by hand is that of scipy, from a corner far below half the sampling rate to one that touches it."""
    hz = share * 0.5 / dt
    result = np.array([[gain, -2.0 * gain, gain, 1.0, *rest] for gain, *rest in filters.highpass_sections(dt, hz)])
    np.testing.assert_allclose(result, butter(4, hz, "highpass", fs=1.0 / dt, output="sos"), rtol=0.0, atol=4e-15)


def test_chunked_padding_equals_whole():
    """Padding within the record, padding longer than it, and none."""
    row = np.arange(1.0, 6.0)
    np.testing.assert_array_equal(mirror_extension(row, 3, 2), [-3, -2, -1, 1, 2, 3, 4, 5, -5, -4])
    np.testing.assert_array_equal(mirror_extension(row, 7, 1)[:8], [4, 5, -5, -4, -3, -2, -1, 1])
    np.testing.assert_array_equal(mirror_extension(row, 0, 0), row)


def test_chunked_peak_between_samples_equals_whole(small_pieces, monkeypatch):
    """Zeros of the acceleration at the seams are met once; the velocity in pieces is the one that is looked at whole."""
    history = ground_history(ROW, DT, highpass_hz=0.5)
    result = peaks.peak_velocity(history, DT)
    monkeypatch.setattr(integrals, "CHUNK_SIZE", 10**6)
    assert result == peaks.peak_velocity(history, DT) > np.abs(history.velocity).max()


@pytest.mark.parametrize("top", [3, 2500, 4998], ids=str)
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_chunked_peak_pulse_equals_whole(top, sign, small_pieces, monkeypatch):
    """Wider than a piece, and cut by an end of the record: its ends are those found at once."""
    place = np.arange(ROW.size)
    row = sign * (np.cos(np.pi * (place - top) / 400.0) * np.exp(-(((place - top) / 900.0) ** 2)))
    result = frequency.peak_pulse(row, DT)
    monkeypatch.setattr(frequency, "CHUNK_SIZE", 10**6)
    assert result == frequency.peak_pulse(row, DT)
    assert result.ambiguous == (top != 2500)
    assert result.start_s == pytest.approx(DT * max(top - 200, 0), abs=1e-12)
    assert result.end_s == pytest.approx(DT * min(top + 200, ROW.size - 1), abs=1e-12)


def test_chunked_smoothed_spectrum_equals_whole(monkeypatch):
    """The lag window ends after nine seconds: pieces with that much of what follows give the same energies, on a coarser grid."""
    fine = spectra.fourier_amplitude(ROW, DT)
    monkeypatch.setattr(spectra, "LONG_TRANSFORM", 1000)
    frequency, amplitude = spectra.fourier_amplitude(ROW, DT)
    assert frequency.size < fine[0].size
    np.testing.assert_allclose(amplitude, np.interp(frequency, *fine), rtol=0.0, atol=1e-12 * fine[1].max())
