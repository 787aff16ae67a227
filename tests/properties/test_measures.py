"""Properties of measures: scaling, mirror image, shift in time, refinement of the straight lines."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from seisblock.measures import Conventions, arias_intensity, duration_above, measure, peak_pulse, significant_duration
from seisblock.records import Component, Record

DT = 0.01
VALUES = st.floats(-10, 10, allow_nan=False).map(lambda x: round(x, 3))
WAVES = arrays(np.float64, st.integers(40, 120), elements=VALUES).filter(lambda a: np.abs(a).max() > 0.1)
PLAIN = Conventions(velocity_highpass_hz=0.5)


def three(wave):
    """Return a record of three different components made of one row."""
    return Record((Component("NS", wave), Component("EW", np.roll(wave, 7)), Component("UD", 0.5 * wave[::-1])), DT)


def numbers(answer):
    """Return what scales with the motion, and what does not."""
    m = answer.components[0]
    f = m.equivalent_frequency_hz
    return np.array([m.pga_m_s2, m.pgv_m_s, m.pgd_m]), np.array([f.pga_pgv, f.pulse_width, m.significant_duration_s]), m.duration


@settings(max_examples=25, deadline=None)
@given(WAVES, st.sampled_from([0.25, 2.0, 8.0]))
def test_measures_scale_with_motion(wave, factor):
    """Peaks scale, frequencies and durations over a scaled threshold do not, Arias goes with the square, JMA with 2 log10."""
    first = measure(three(wave), threshold=1.0, conventions=PLAIN)
    second = measure(three(wave * factor), threshold=factor, conventions=PLAIN)
    (peaks, fixed, duration), (peaks_2, fixed_2, duration_2) = numbers(first), numbers(second)
    np.testing.assert_allclose(peaks_2, factor * peaks, rtol=1e-9)
    np.testing.assert_allclose(fixed_2, fixed, rtol=1e-9)
    assert (duration_2.total_s, duration_2.count) == (pytest.approx(duration.total_s, abs=1e-12), duration.count)
    assert second.components[0].arias_m_s == pytest.approx(factor**2 * first.components[0].arias_m_s, rel=1e-9)
    assert second.jma_intensity == pytest.approx(first.jma_intensity + 2 * np.log10(factor), abs=1e-9)


@settings(max_examples=25, deadline=None)
@given(WAVES)
def test_measures_ignore_sign(wave):
    """Turning the sign of the ground changes nothing: two-sided thresholds, absolute peaks."""
    first, second = (measure(three(w), threshold=1.0, conventions=PLAIN) for w in (wave, -wave))
    assert first.components[0] == second.components[0]
    assert first.horizontal.pga_m_s2 == second.horizontal.pga_m_s2


@settings(max_examples=25, deadline=None)
@given(WAVES)
def test_measures_of_reversed_record_are_equal(wave):
    """A record played backwards has the same Arias intensity, significant duration, durations and peak horizontal vector."""
    back = wave[::-1].copy()
    assert arias_intensity(back, DT) == pytest.approx(arias_intensity(wave, DT), rel=1e-12)
    assert significant_duration(back, DT) == pytest.approx(significant_duration(wave, DT), abs=1e-9)
    first, second = duration_above(wave, DT, 1.0), duration_above(back, DT, 1.0)
    assert (second.total_s, second.longest_s, second.count) == (pytest.approx(first.total_s), pytest.approx(first.longest_s), first.count)


@settings(max_examples=25, deadline=None)
@given(WAVES, st.integers(1, 300))
def test_leading_rest_only_delays_measures(wave, late):
    """Rest before a motion that starts from rest delays it and changes nothing else."""
    wave = np.concatenate(([0.0], wave, [0.0]))
    shifted = np.concatenate((np.zeros(late), wave))
    assert arias_intensity(shifted, DT) == pytest.approx(arias_intensity(wave, DT), rel=1e-12)
    assert significant_duration(shifted, DT) == pytest.approx(significant_duration(wave, DT), abs=1e-10)
    assert duration_above(shifted, DT, 1.0).total_s == pytest.approx(duration_above(wave, DT, 1.0).total_s, abs=1e-12)
    first, second = peak_pulse(wave, DT), peak_pulse(shifted, DT)
    assert second.start_s - first.start_s == pytest.approx(late * DT, abs=1e-10)
    assert second.frequency_hz == pytest.approx(first.frequency_hz, rel=1e-9)


@settings(max_examples=25, deadline=None)
@given(WAVES, st.integers(2, 5))
def test_measures_of_refined_record_are_equal(wave, parts):
    """Samples inserted on the straight lines are the same motion."""
    n = wave.size
    fine = np.interp(np.arange((n - 1) * parts + 1) / parts, np.arange(n), wave)
    step = DT / parts
    assert arias_intensity(fine, step) == pytest.approx(arias_intensity(wave, DT), rel=1e-9)
    assert significant_duration(fine, step) == pytest.approx(significant_duration(wave, DT), abs=1e-7)
    assert duration_above(fine, step, 1.0005).total_s == pytest.approx(duration_above(wave, DT, 1.0005).total_s, abs=1e-9)
    assert peak_pulse(fine, step).frequency_hz == pytest.approx(peak_pulse(wave, DT).frequency_hz, rel=1e-9)


@settings(max_examples=25, deadline=None)
@given(WAVES, st.floats(0.1, 5), st.floats(0.1, 5))
def test_duration_decreases_with_threshold(wave, a, b):
    """Total and longest fall as the threshold rises."""
    low, high = (duration_above(wave, DT, level) for level in sorted((a, b)))
    assert high.total_s <= low.total_s + 1e-12
    assert high.longest_s <= low.longest_s + 1e-12
