"""High-pass filters leave nothing of a constant or a line, do not know the direction of time, and agree with scipy's and obspy's."""

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st

from seisblock.cli import main
from seisblock.core.errors import ParameterError
from seisblock.measures import ground_history, peak_velocity
from seisblock.readers import read
from seisblock.records.filters import BASELINE_PERIODS, causal_highpass_samples, end_line, highpass_samples

DT = 0.01
FILTERS = (highpass_samples, causal_highpass_samples)
CORNERS = st.sampled_from([0.05, 0.1, 0.5, 2.0])
LENGTHS = st.integers(2, 6000)
LEVELS = st.floats(-50, 50)
EXACT = 1e-11
"""Round-off of a filter of a few thousand samples, relative to what goes in."""


def shaking(n, seed=0):
    """Return a burst of noise that begins and ends at rest, (n,), m/s^2."""
    rng = np.random.default_rng(seed)
    t = np.linspace(0, 1, n)
    return rng.standard_normal(n) * np.exp(-(((t - 0.5) / 0.1) ** 2))


@pytest.mark.parametrize("highpass", FILTERS)
@settings(max_examples=40, deadline=None)
@given(LENGTHS, CORNERS, LEVELS, LEVELS)
def test_highpass_removes_constant_and_line(highpass, n, hz, level, drift):
    """Any offset, any drift, any length: zero from the first sample to the last."""
    line = level + drift * np.arange(n) * DT
    assert np.abs(highpass(line, DT, hz)).max() <= EXACT * max(np.abs(line).max(), 1.0)


@pytest.mark.parametrize("highpass", FILTERS)
@settings(max_examples=25, deadline=None)
@given(st.integers(50, 4000), CORNERS, LEVELS, LEVELS)
def test_highpass_ignores_offset_and_drift(highpass, n, hz, level, drift):
    """The shaking on top of a line is the shaking."""
    wave = shaking(n)
    line = level + drift * np.arange(n) * DT
    np.testing.assert_allclose(highpass(wave + line, DT, hz), highpass(wave, DT, hz), atol=EXACT * max(np.abs(line).max(), 1.0))


@settings(max_examples=25, deadline=None)
@given(st.integers(50, 4000), CORNERS, st.integers(0, 5))
def test_zero_phase_highpass_is_time_symmetric(n, hz, seed):
    """The reversed record gives the reversed answer, but for the 1e-5 to which the padding's transients have died."""
    wave = np.random.default_rng(seed).standard_normal(n)
    first, second = highpass_samples(wave, DT, hz), highpass_samples(wave[::-1], DT, hz)[::-1]
    np.testing.assert_allclose(second, first, atol=3e-5 * np.abs(wave).max())


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 3000), st.integers(0, 3000))
def test_highpass_is_independent_of_rest_before_and_after(before, after):
    """A record of six corner periods that begins and ends at rest may be padded with rest: velocities stay to half a per cent."""
    wave, hz = shaking(6000), 0.1
    longer = np.concatenate((np.zeros(before), wave, np.zeros(after)))
    short, long = (ground_history(a, DT, highpass_hz=hz).velocity for a in (wave, longer))
    np.testing.assert_allclose(long[before : before + wave.size], short, atol=5e-3 * np.abs(short).max())


@pytest.mark.parametrize("f0", [0.5, 1.0, 3.0])
@pytest.mark.parametrize("phase", [0.0, 0.7, np.pi / 2, 2.5])
def test_highpass_of_truncated_sine_keeps_pgv(f0, phase):
    """Whatever the phase at which 40 s of a sine begin, PGV is A/w to 0.032 Hz / f; scipy's odd extension gives up to 40 times that."""
    t = np.arange(0, 40, DT)
    wave = np.sin(2 * np.pi * f0 * t + phase)
    history = ground_history(wave, DT)
    assert peak_velocity(history, DT) == pytest.approx(1 / (2 * np.pi * f0), rel=0.035 / f0)


def test_baseline_is_estimated_from_quiet_ends():
    """A one-sided pulse in the middle of the record does not move the line through the ends, an offset moves it exactly."""
    n, hz = 6000, 0.1
    quiet = int(BASELINE_PERIODS / hz / DT)
    pulse = np.where((np.arange(n) > quiet) & (np.arange(n) < n - quiet), 3.0, 0.0)
    np.testing.assert_allclose(end_line(pulse, DT, hz), 0.0, atol=1e-14)
    np.testing.assert_allclose(end_line(pulse + 0.3, DT, hz), 0.3, atol=1e-13)


def test_zero_phase_highpass_equals_scipy():
    """Away from the ends it is scipy's own Butterworth filter, forwards and backwards."""
    from scipy.signal import butter, sosfiltfilt

    wave = shaking(20000)
    theirs = sosfiltfilt(butter(4, 0.2, "highpass", fs=1 / DT, output="sos"), wave)
    np.testing.assert_allclose(highpass_samples(wave, DT, 0.2)[4000:-4000], theirs[4000:-4000], atol=1e-6)


@pytest.mark.parametrize(("ours", "zerophase"), [(highpass_samples, True), (causal_highpass_samples, False)])
def test_highpass_filters_equal_obspy(ours, zerophase):
    """On a record at rest at both ends ObsPy's highpass of four corners gives the same samples."""
    from obspy.signal.filter import highpass

    wave = shaking(20000)
    theirs = highpass(wave, 0.2, df=1 / DT, corners=4, zerophase=zerophase)
    np.testing.assert_allclose(ours(wave, DT, 0.2), theirs, atol=1e-6)


def test_tiny_corner_frequency_is_rejected():
    """--highpass 1e-6 would take gigabytes: it is refused with the least corner there is."""
    with pytest.raises(ParameterError, match=r"1e-06 Hz requires 5e\+08 samples of padding .* choose a corner of at least 0\.00012 Hz"):
        highpass_samples(np.ones(100), DT, 1e-6)


def test_constant_record_has_zero_pgv(tmp_path):
    """A table that holds nothing but 0.5 m/s^2 has a PGV of zero (it was 103.6 kine)."""
    still = tmp_path / "offset.csv"
    still.write_text("NS (m/s2)\n" + "0.5\n" * 6000)
    wave = read(still, dt=DT).component("NS").acceleration
    assert peak_velocity(ground_history(wave, DT), DT) < 1e-12


def test_constant_record_with_highpass_causes_no_slip(tmp_path):
    """A constant 0.05 g under --highpass 0.1 does not slide a block of friction 0.04 (it slid 24 mm)."""
    still = tmp_path / "offset.csv"
    still.write_text("time (s),EW (m/s2)\n" + "".join(f"{i * DT:.2f},0.5\n" for i in range(6000)))
    result = CliRunner().invoke(main, ["slide", str(still), "--mu", "0.04", "--highpass", "0.1", "--json", "--quiet"])
    assert result.exit_code == 0, result.output
    assert '"slips": false' in result.stdout
