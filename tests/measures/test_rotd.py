"""RotD50 and RotD100 against two independent computations, and their properties."""

import numpy as np
import pytest
import scipy.signal

from seisblock import Record
from seisblock.core.errors import ParameterError
from seisblock.measures import default_periods, response_spectrum, rotated_spectrum
from seisblock.readers import read
from seisblock.records import Component
from seisblock.records.process import component_at_azimuth

ANGLES = np.radians(np.arange(180))


def slow_rotated_peaks(first, second, dt, period, damping=0.05):
    """Return the peak pseudo-acceleration in 180 directions: the state-space solution of scipy, oversampled, one direction at a time."""
    omega, parts = 2 * np.pi / period, max(1, int(np.ceil(100 * dt / period)))
    n = first.size
    fine = np.arange((n - 1) * parts + 1) / parts
    rows = [np.append(np.interp(fine, np.arange(n), row), np.zeros(int(period / dt * parts) + 2)) for row in (first, second)]
    # the ground comes to rest at once after the last sample, but scipy's input is linear: a fine step makes the difference small
    system = scipy.signal.StateSpace([[0, 1], [-(omega**2), -2 * damping * omega]], [[0], [-1]], [[1, 0]], [[0]])
    times = dt / parts * np.arange(rows[0].size)
    x, y = (scipy.signal.lsim(system, row, times)[1] for row in rows)
    return omega**2 * np.array([np.abs(x * np.cos(angle) + y * np.sin(angle)).max() for angle in ANGLES])


@pytest.mark.parametrize("name", ["synthetic_jma.csv", "shafter_1989"])
def test_rotated_spectrum_equals_slow_computation(name):
    """180 solutions of scipy: to 0.2 %, what 60 points per period leave of a peak."""
    record = read(name)
    pair = [component_at_azimuth(record, azimuth).acceleration for azimuth in (0.0, 90.0)]
    periods = [0.3, 1.1]
    spectrum = rotated_spectrum(record, periods)
    peaks = [slow_rotated_peaks(*pair, record.dt, period) for period in periods]
    np.testing.assert_allclose(spectrum.rotd50_m_s2, np.median(peaks, axis=1), rtol=2e-3)
    np.testing.assert_allclose(spectrum.rotd100_m_s2, np.max(peaks, axis=1), rtol=2e-3)


def test_rotated_spectrum_equals_pyrotd():
    """An independent program in the frequency domain, with zeros behind the record against its periodicity.

    It interpolates by sines instead of straight lines, which differs at short periods (0.7 % at 0.2 s).
    """
    pyrotd = pytest.importorskip("pyrotd")
    record = read("synthetic_jma.csv")
    periods = np.array([0.5, 1.0, 2.0, 5.0, 10.0])
    padded = [np.append(c.acceleration, np.zeros(30000)) for c in record.horizontals]
    rows = pyrotd.calc_rotated_spec_accels(record.dt, *padded, 1 / periods, 0.05, percentiles=[50, 100])
    spectrum = rotated_spectrum(record, periods)
    for percentile, row in ((50, spectrum.rotd50_m_s2), (100, spectrum.rotd100_m_s2)):
        np.testing.assert_allclose(row, rows[rows.percentile == percentile].spec_accel, rtol=2e-3)


def test_rotated_spectrum_does_not_depend_on_orientation():
    """Of an instrument turned by 37 degrees the result is the same, but for the grid of directions; the largest is at least either."""
    record = read("synthetic_jma.csv")
    rotated = Record(
        [Component(str(a), component_at_azimuth(record, a).acceleration, a) for a in (37.0, 127.0)], record.dt, source="turned"
    )
    spectrum, second = rotated_spectrum(record, [0.3, 2.0]), rotated_spectrum(rotated, [0.3, 2.0])
    np.testing.assert_allclose(second.rotd50_m_s2, spectrum.rotd50_m_s2, rtol=1e-3)
    np.testing.assert_allclose(second.rotd100_m_s2, spectrum.rotd100_m_s2, rtol=1e-3)
    for component in record.horizontals:
        pseudo = response_spectrum(component.acceleration, record.dt, [0.3, 2.0]).sd_m * (2 * np.pi / np.array([0.3, 2.0])) ** 2
        assert (spectrum.rotd100_m_s2 >= pseudo * (1 - 2e-3)).all()


def test_rotated_spectrum_of_linear_motion_is_known():
    """Motion on one line: RotD100 is its spectrum, RotD50 the median of |cos| of it."""
    row = read("elcentro_1940_ns.csv").components[0].acceleration
    record = Record([Component("NS", row), Component("EW", np.zeros_like(row))], 0.02)
    spectrum = rotated_spectrum(record, [0.5, 1.5])
    pseudo = response_spectrum(row, 0.02, [0.5, 1.5]).sd_m * (2 * np.pi / np.array([0.5, 1.5])) ** 2
    np.testing.assert_allclose(spectrum.rotd100_m_s2, pseudo, rtol=2e-3)
    np.testing.assert_allclose(spectrum.rotd50_m_s2, np.median(np.abs(np.cos(ANGLES))) * spectrum.rotd100_m_s2, rtol=1e-12)


def test_rotated_spectrum_requires_two_horizontals_and_positive_periods():
    """One component has no other direction."""
    assert rotated_spectrum(read("synthetic_jma.csv")).period_s.tolist() == default_periods().tolist()
    with pytest.raises(ParameterError, match="require two horizontal components, found NS"):
        rotated_spectrum(read("elcentro_1940_ns.csv"))
    with pytest.raises(ParameterError, match="must be positive"):
        rotated_spectrum(read("synthetic_jma.csv"), [0.0])
