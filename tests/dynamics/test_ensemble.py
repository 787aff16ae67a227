"""Many trajectories at once are the trajectories one by one."""

import numpy as np
import pytest

from seisblock.bodies.sliding_base import sliding_base
from seisblock.core.errors import ParameterError, SolverError
from seisblock.dynamics import integrate, integrate_many
from seisblock.models.slide import model as slide
from seisblock.records import Motion
from tests.dynamics.toy_models import BALL, FLIP, SLED

pytestmark = pytest.mark.kernel


def test_ensemble_rows_equal_single_trajectories():
    """Each row's end, extrema, first event and number of events are those of the trajectory followed alone."""
    rng = np.random.default_rng(5)
    motion = Motion.from_arrays(rng.normal(size=60), 0.02)
    limits = np.array([[0.3], [1.5], [99.0]])
    gains = np.array([[1.0, 0.0, 0.0], [-2.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    rows = integrate_many(SLED, motion, limits, [0.0, 0.0], 0, gains=gains)
    for row in range(3):
        single = integrate(SLED, motion, limits[row], [0.0, 0.0], 0, gains=gains[row])
        np.testing.assert_array_equal(rows.final[row], single.final)
        np.testing.assert_array_equal(rows.extrema[row], single.extrema)
        assert rows.n_events[row] == single.n_events
        assert rows.end_time[row] == single.end_time
        assert rows.final_mode[row] == single.final_mode
        first = single.events[0].time if single.events else np.nan
        np.testing.assert_equal(rows.first_event_time[row], first)
    assert rows.n_events.tolist() == [1, 1, 0]


def test_inactive_forcing_row_is_zero_in_every_trajectory():
    """Rows share their room: the vertical motion of the first must not act on the second, for which its factor is zero."""
    motion = Motion.from_arrays(np.sin(np.arange(40.0)), 0.02, vertical=np.full(40, -9.0))
    base = slide.parameters(sliding_base(0.3), 9.8)
    gains = np.array([[8.0, 0.0, 1.0], [8.0, 0.0, 0.0]])
    rows = integrate_many(slide.SLIDE, motion, [base, base], np.zeros(4), slide.STICK, gains=gains)
    single = integrate(slide.SLIDE, motion, base, np.zeros(4), slide.STICK, gains=gains[1])
    assert single.n_events > 0
    assert rows.first_event_time[1] == single.events[0].time
    np.testing.assert_array_equal(rows.final[1], single.final)


def test_tally_counts_guards_by_the_mode_they_lead_to():
    """A ball that bounces k times and rests has k entries of flight and one of rest, the mode that ends it."""
    motion = Motion.from_arrays(np.zeros(301), 0.01)
    rows = integrate_many(BALL, motion, [[9.8, 0.5, 0.1]], [1.0, 0.0], 0, gains=[1.0, 0.0, 0.0])
    assert rows.transition_counts[0].tolist() == [[rows.n_events[0] - 1, 1]]


def test_mode_durations_are_times_between_events():
    """The stays in each mode add up to the whole time; the longest is that between two events, or to the end."""
    motion = Motion.from_arrays(np.zeros(41), 0.01)
    rows = integrate_many(BALL, motion, [[9.8, 0.9, 1e-9]], [0.05, 0.0], 0, gains=[1.0, 0.0, 0.0])
    single = integrate(BALL, motion, [9.8, 0.9, 1e-9], [0.05, 0.0], 0, gains=[1.0, 0.0, 0.0])
    times = np.array([0.0, *(change.time for change in single.events), single.end_time])
    assert single.n_events >= 2
    total, longest = rows.dwell_times[0, 0]
    assert total == pytest.approx(0.4, abs=1e-15)
    assert longest == pytest.approx(np.diff(times).max(), abs=1e-15)


def test_failure_names_its_row():
    """A row that fails raises an error with its number."""
    with pytest.raises(SolverError, match="row 0"):
        integrate_many(FLIP, Motion.from_arrays(np.zeros(3), 0.01), [[0.0]], [0.0], 0, gains=[1.0, 0.0, 0.0])


def test_one_dimensional_parameters_are_rejected():
    """Parameters without the axis of rows are an error, not one trajectory per number."""
    with pytest.raises(ParameterError, match="one row"):
        integrate_many(SLED, Motion.from_arrays(np.zeros(3), 0.01), [0.3], [0.0, 0.0], 0, gains=[1.0, 0.0, 0.0])


def test_follow_many_marks_failed_rows_where_failures_are_allowed():
    """A ball that bounces without end is marked; the other row is what it is alone."""
    motion = Motion.from_arrays(np.zeros(60), 0.02)
    parameters = np.array([[9.81, 0.5, 1e-3], [9.81, 0.5, -1.0]])
    start = [0.1, 0.0]
    with pytest.raises(SolverError, match="row 1: integration stopped"):
        integrate_many(BALL, motion, parameters, start, 0, gains=(1.0, 0.0, 0.0))
    rows = integrate_many(BALL, motion, parameters, start, 0, gains=(1.0, 0.0, 0.0), allow_failures=True)
    assert rows.failed.tolist() == [False, True]
    np.testing.assert_array_equal(rows.final[0], integrate(BALL, motion, parameters[0], start, 0).final)
