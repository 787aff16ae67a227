"""A path as a table: both limits of each event stand between the samples around it, wherever the event is."""

import numpy as np
import pytest

from seisblock.dynamics.events import EventLog
from seisblock.dynamics.trajectory import Path

DT, SAMPLES, FIRST = 0.5, 6, 10


@pytest.fixture
def path():
    """Return six samples, with an event before the first, two after one sample, and one after the last."""
    sample, tau = np.array([9, 12, 12, 15]), np.array([0.25, 0.125, 0.375, 0.25])
    log = np.column_stack([sample, [0, 0, 0, 0], [1, 2, 3, 4], [2, 3, 4, 5]])
    limits = np.arange(100.0, 116.0).reshape(4, 2, 2)
    states, modes = np.arange(12.0).reshape(SAMPLES, 2), np.array([2, 2, 2, 4, 4, 4])
    return Path(DT, FIRST, states, modes, EventLog(log, tau, sample * DT + tau, limits))


def test_event_limits_stand_between_their_samples(path):
    """Times rise, modes change at events alone, and each state is that of its sample or its limit."""
    time, states, modes = path.table()
    assert time.tolist() == [4.75, 4.75, 5.0, 5.5, 6.0, 6.125, 6.125, 6.375, 6.375, 6.5, 7.0, 7.5, 7.75, 7.75]
    assert states[:, 0].tolist() == [100, 102, 0, 2, 4, 104, 106, 108, 110, 6, 8, 10, 112, 114]
    assert states[:, 1].tolist() == [101, 103, 1, 3, 5, 105, 107, 109, 111, 7, 9, 11, 113, 115]
    assert modes.tolist() == [1, 2, 2, 2, 2, 2, 3, 3, 4, 4, 4, 4, 4, 5]
    assert path.values(1).tolist() == states[:, 1].tolist()


def test_selected_samples_include_all_events(path):
    """They are rows of the whole table: those of the samples, and both limits of each event."""
    values, numbers = np.array([1, 3, 5]), [0, 1, 3, 5, 6, 7, 8, 9, 11, 12, 13]
    ground = np.random.default_rng(4).normal(size=20)
    for subset, full in zip(path.table(values), path.table(), strict=True):
        assert np.array_equal(subset, full[numbers])
    assert np.array_equal(path.interpolate(ground, values), path.interpolate(ground)[numbers])
