"""The compiled loop returns to Python regularly, without an effect on the result."""

import numpy as np
import pytest

from seisblock._jit import ENABLED
from seisblock.core.errors import SolverError
from seisblock.dynamics import Instant, integrate, integrate_many, integration
from seisblock.records import Motion
from tests.dynamics.toy_models import BALL, SLED

pytestmark = pytest.mark.kernel

NOISE = Motion.from_arrays(np.random.default_rng(7).normal(size=400), 0.02)


@pytest.fixture(params=[1, 2, 7])
def short_slices(request, monkeypatch):
    """Slices of so many steps instead of many thousands."""

    def cut():
        monkeypatch.setattr(integration, "STEPS_PER_SLICE", request.param)
        monkeypatch.setattr("seisblock.dynamics.ensemble.STEPS_PER_SLICE", request.param)

    return cut


TOYS = pytest.mark.parametrize(
    ("model", "motion", "p", "start"),
    [(BALL, Motion.from_arrays(np.zeros(301), 0.01), [9.8, 0.7, 1e-6], [1.0, 0.0]), (SLED, NOISE, [1.5], [0.0, 0.0])],
    ids=["ball", "sled"],
)


@pytest.fixture(params=[1, 2, 7, 100])
def short_stretches(request, monkeypatch):
    """Motions that count as long from ten samples on, and stretches of so many."""

    def cut():
        monkeypatch.setattr("seisblock.records.motion.LONG_MOTION_SAMPLES", 10)
        monkeypatch.setattr("seisblock.records.motion.SEGMENT_SAMPLES", request.param)

    return cut


@TOYS
@pytest.mark.parametrize("begins", [Instant(), Instant(3, 0.004), Instant(29, 0.0)], ids=["at first", "inside", "late"])
def test_long_motion_in_chunks_equals_whole_motion(model, motion, p, start, begins, short_stretches):
    """The trajectory, and the path that is followed again when it is asked for, are those of a motion that is held whole."""
    full = integrate(model, motion, p, start, 0, start=begins)
    table, ground = full.table(), full.interpolate(motion.horizontal)
    short_stretches()
    parts = integrate(model, motion, p, start, 0, start=begins)
    assert sum(1 for _ in parts.iter_paths()) > 1
    for single, second in zip((*table, ground), (*parts.table(), parts.interpolate(motion.horizontal)), strict=True):
        np.testing.assert_array_equal(second, single)
    for field in ("extrema", "final"):
        np.testing.assert_array_equal(getattr(parts, field), getattr(full, field))
    assert (parts.end, parts.status, parts.n_events, parts.final_mode) == (full.end, full.status, full.n_events, full.final_mode)
    for path in parts.iter_paths():
        assert all(path.first - 1 <= change.at.sample for change in path.events)


def test_ensemble_in_chunks_equals_whole_motion(short_stretches):
    """Many trajectories, those that end early among them, are those through a motion that is held whole."""
    limits, gains = np.array([[0.3], [1.5], [99.0], [2.0]]), np.array([[1.0, 0.0, 0.0]])
    full = integrate_many(SLED, NOISE, limits, [0.0, 0.0], 0, gains=gains)
    short_stretches()
    parts = integrate_many(SLED, NOISE, limits, [0.0, 0.0], 0, gains=gains)
    for field in ("final", "final_mode", "n_events", "end_time", "first_event_time", "extrema", "transition_counts", "dwell_times"):
        np.testing.assert_array_equal(getattr(parts, field), getattr(full, field))


@TOYS
def test_slicing_a_trajectory_changes_no_bit(model, motion, p, start, short_slices):
    """Path, modes, events, extrema and end of a trajectory in slices of a few steps are those of one in a single slice."""
    full = integrate(model, motion, p, start, 0)
    short_slices()
    parts = integrate(model, motion, p, start, 0)
    for field in ("states", "modes", "extrema", "final"):
        np.testing.assert_array_equal(getattr(parts, field)[: full.end.sample], getattr(full, field)[: full.end.sample])
    assert (parts.end, parts.status, parts.n_events) == (full.end, full.status, full.n_events)
    assert [c[:5] for c in parts.events] == [c[:5] for c in full.events]


def test_slicing_an_ensemble_changes_no_bit(short_slices):
    """Many trajectories in slices that end inside a row are those in a single slice."""
    limits, gains = np.array([[0.3], [1.5], [99.0], [2.0]]), np.array([[1.0, 0.0, 0.0]])
    full = integrate_many(SLED, NOISE, limits, [0.0, 0.0], 0, gains=gains)
    short_slices()
    parts = integrate_many(SLED, NOISE, limits, [0.0, 0.0], 0, gains=gains)
    for field in ("final", "final_mode", "n_events", "end_time", "first_event_time", "extrema", "transition_counts"):
        np.testing.assert_array_equal(getattr(parts, field), getattr(full, field))


@pytest.mark.skipif(not ENABLED, reason="a quarter of a million steps in plain Python")
def test_infinite_events_within_one_sample_raise():
    """A ball that hardly loses speed bounces for ever within one long sample: an error with its time, whether events are kept or not."""
    one_sample = Motion.from_arrays(np.zeros(2), 1e7)
    with pytest.raises(SolverError, match="too many mode changes"):
        integrate(BALL, one_sample, [9.8, 1.0, 0.0], [1e-3, 0.0], 0, keep_path=False, keep_events=False)
