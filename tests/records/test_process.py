"""Processing steps between reading and solving, and their descriptions."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from seisblock.core.errors import ComponentError, ParameterError, RecordError
from seisblock.records import Component, Record
from seisblock.records.integrals import integrate, integrate_twice
from seisblock.records.process import component_at_azimuth, crop, demean, highpass, largest_horizontal, rotate, scale, scale_to_pga

T = np.arange(2001) * 0.01
PARTS = {"NS": np.sin(T) + 0.3, "EW": 2 * np.cos(3 * T), "UD": 5 * np.sin(5 * T)}
RECORD = Record([Component(code, values) for code, values in PARTS.items()], 0.01, station="ABC", source="abc.csv")


def test_demean_removes_the_whole_mean_of_each_component():
    """Means are zero afterwards, the shape is kept, and the means are named."""
    result = demean(RECORD)
    for before, after in zip(RECORD.components, result.components, strict=True):
        assert abs(after.acceleration.mean()) < 1e-15
        np.testing.assert_allclose(np.diff(after.acceleration), np.diff(before.acceleration), atol=1e-15)
    assert f"NS {100 * RECORD.components[0].acceleration.mean():.4g}" in result.history[-1]
    assert RECORD.history == ()


def test_crop_keeps_the_time_axis():
    """A window's samples keep their times, also when cut twice."""
    once = crop(RECORD, 2.0, 10.0)
    twice = crop(once, 3.0, 4.0)
    np.testing.assert_allclose(twice.time, np.arange(300, 401) * 0.01, atol=1e-12)
    np.testing.assert_array_equal(twice.component("EW").acceleration, RECORD.component("EW").acceleration[300:401])


@pytest.mark.parametrize(
    ("start", "end", "first", "last"),
    [(2.0, 3.0, 200, 300), (2.003, 2.997, 201, 299), (2.0099, 3.0001, 201, 300), (1.9999, 2.9999, 200, 299)],
)
def test_crop_keeps_samples_inside_window_only(start, end, first, last):
    """A window that begins or ends between two samples holds the ones inside it; one on a sample holds that sample."""
    part = crop(RECORD, start, end)
    assert part.offset_s == pytest.approx(first * 0.01, abs=1e-12)
    np.testing.assert_array_equal(part.component("NS").acceleration, RECORD.component("NS").acceleration[first : last + 1])


def test_crop_to_whole_record_changes_nothing():
    """The window from the first to the last sample changes nothing."""
    np.testing.assert_array_equal(crop(RECORD, 0.0, RECORD.duration_s).component("NS").acceleration, RECORD.component("NS").acceleration)


def test_crop_accepts_open_ends():
    """None stands for the record's own first and last sample."""
    assert (crop(RECORD, None, 5.0).duration_s, crop(RECORD, 5.0, None).offset_s) == (pytest.approx(5.0), pytest.approx(5.0))
    assert crop(crop(RECORD, 5.0, None), None, None).samples == 1501


@pytest.mark.parametrize(("start", "end"), [(-1, 5), (5, 21), (5, 5), (6, 5), (1.001, 1.004), (np.nan, 3)])
def test_crop_rejects_invalid_window(start, end):
    """A window that is outside, empty or shorter than two samples raises an error that states this."""
    with pytest.raises(RecordError, match="window"):
        crop(RECORD, start, end)


def test_scale_by_one_is_not_reported():
    """No title says "scaled by 1"; by another factor it is said."""
    assert scale(RECORD, 1.0) is RECORD
    assert scale(RECORD, 1.5).history == ("scaled by 1.5",)


def test_scale_to_pga_uses_largest_horizontal():
    """EW (2 m/s^2) reaches the target although UD is larger; ratios are kept."""
    result = scale_to_pga(RECORD, 4.0)
    assert largest_horizontal(RECORD).code == "EW"
    assert np.abs(result.component("EW").acceleration).max() == pytest.approx(4.0, rel=1e-14)
    np.testing.assert_allclose(result.component("UD").acceleration, 2 * RECORD.component("UD").acceleration, rtol=1e-14)
    assert "EW (largest horizontal)" in result.history[-1]


def test_scale_to_pga_of_named_components():
    """The component asked for reaches the target, the largest of several, or an azimuth."""
    assert np.abs(scale_to_pga(RECORD, 1.0, "ud").component("UD").acceleration).max() == pytest.approx(1.0, rel=1e-14)
    assert np.abs(scale_to_pga(RECORD, 1.0, ("NS", "UD")).component("UD").acceleration).max() == pytest.approx(1.0, rel=1e-14)
    assert np.abs(component_at_azimuth(scale_to_pga(RECORD, 1.0, ("30",)), 30.0).acceleration).max() == pytest.approx(1.0, rel=1e-14)


def test_processing_rejects_invalid_arguments():
    """A zero record, a negative target, a factor that is no number, a corner beyond Nyquist, a missing component."""
    still = Record((Component("NS", np.zeros(9)),), 0.01)
    for attempt in (
        lambda: scale_to_pga(still, 1.0),
        lambda: scale_to_pga(RECORD, -1.0),
        lambda: scale(RECORD, float("nan")),
        lambda: highpass(RECORD, 50.0),
        lambda: highpass(RECORD, 0.0),
    ):
        with pytest.raises(ParameterError):
            attempt()
    for attempt in (
        lambda: rotate(still, 30.0),
        lambda: scale_to_pga(RECORD, 1.0, "XX"),
        lambda: component_at_azimuth(RECORD, float("inf")),
    ):
        with pytest.raises(ComponentError):
            attempt()
    with pytest.raises(ComponentError, match="no horizontal"):
        largest_horizontal(Record((Component("UD", np.ones(3)),), 0.1))


def test_highpass_has_squared_butterworth_gain_and_no_delay():
    """A long sine comes out with gain 1 / (1 + (fc/f)^8) and the same phase."""
    dt, fc = 0.01, 0.1
    time = np.arange(40001) * dt
    for f in (0.05, 0.1, 0.2, 1.0):
        wave = np.sin(2 * np.pi * f * time)
        out = highpass(Record((Component("NS", wave),), dt), fc).component("NS").acceleration
        middle = slice(15000, 25000)
        np.testing.assert_allclose(out[middle], wave[middle] / (1 + (fc / f) ** 8), atol=2e-4)


def test_highpass_is_recorded_in_history():
    """The history names the corner, the filter and the baseline; the offset is gone."""
    result = highpass(RECORD, 0.2)
    assert "high-pass 0.2 Hz (Butterworth order 4 forwards and backwards, line through the ends removed" in result.history[-1]
    lifted = RECORD.with_components([Component(c.code, c.acceleration + 9.0) for c in RECORD.components], "lifted")
    np.testing.assert_allclose(highpass(lifted, 0.2).component("NS").acceleration, result.component("NS").acceleration, atol=1e-9)


@given(st.floats(-720, 720))
def test_rotation_keeps_vector_length(azimuth):
    """The length of the horizontal vector does not change, and the vertical stays bit by bit."""
    rotated = rotate(RECORD, azimuth)
    a, b, up = (c.acceleration for c in rotated.components)
    np.testing.assert_allclose(np.hypot(a, b), np.hypot(*(RECORD.component(c).acceleration for c in ("NS", "EW"))), rtol=1e-12, atol=1e-12)
    np.testing.assert_array_equal(up, RECORD.component("UD").acceleration)


def test_rotation_to_axes_returns_samples():
    """0 and 90 degrees are NS and EW bit by bit; 180 is their opposite."""
    north, east = rotate(RECORD, 0.0).components[:2]
    np.testing.assert_array_equal(north.acceleration, RECORD.component("NS").acceleration)
    np.testing.assert_array_equal(east.acceleration, RECORD.component("EW").acceleration)
    np.testing.assert_allclose(component_at_azimuth(RECORD, 180.0).acceleration, -RECORD.component("NS").acceleration, atol=1e-15)


def test_integration_is_exact_for_straight_lines():
    """For a = 1 + 2t: v = t + t^2, u = t^2/2 + t^3/3, whatever the step."""
    for dt in (0.5, 0.01):
        t = np.arange(0, 5 + dt / 2, dt)
        np.testing.assert_allclose(integrate(1 + 2 * t, dt), t + t**2, rtol=1e-13, atol=1e-13)
        np.testing.assert_allclose(integrate_twice(1 + 2 * t, dt, 3.0), 3 * t + t**2 / 2 + t**3 / 3, rtol=1e-12, atol=1e-13)


def test_integration_agrees_with_a_hundredfold_refinement():
    """Samples inserted on the straight lines change nothing."""
    rng = np.random.default_rng(1)
    a = rng.standard_normal(50)
    fine = np.interp(np.arange(4901) / 100, np.arange(50), a)
    np.testing.assert_allclose(integrate_twice(a, 1.0), integrate_twice(fine, 0.01)[::100], rtol=1e-12, atol=1e-12)
