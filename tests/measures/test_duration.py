"""Durations above a threshold are those of the straight lines between samples."""

import numpy as np
import pytest

from seisblock.core.errors import ParameterError
from seisblock.measures import duration_above, intervals_above


def test_duration_of_triangle():
    """A triangle of height 2 and base 2 s stands above 1 for 1 s, from 0.5 s."""
    np.testing.assert_allclose(intervals_above(np.array([0.0, 2.0, 0.0]), 1.0, 1.0), [[0.5, 1.5]])


def test_duration_counts_both_signs_by_default():
    """Positive and negative stretches count; one side alone can be asked for."""
    wave = np.array([0.0, 2.0, -4.0, 0.0])
    pair, up, down = (duration_above(wave, 1.0, 1.0, side=side) for side in ("both", "positive", "negative"))
    assert (pair.count, up.count, down.count) == (2, 1, 1)
    assert pair.total_s == pytest.approx(up.total_s + down.total_s)
    assert up.total_s == pytest.approx(0.5 + 1 / 6)
    assert down.total_s == pytest.approx(0.5 + 0.75)
    assert pair.longest_s == down.longest_s


def test_duration_of_sine_above_half_amplitude():
    """|sin| exceeds 1/2 for two thirds of the time, in two stretches per cycle."""
    t = np.arange(0, 10 + 5e-4, 1e-3)
    duration = duration_above(3 * np.sin(2 * np.pi * t), 1e-3, 1.5)
    assert duration.count == 20
    assert duration.total_s == pytest.approx(20 / 3, rel=1e-5)
    assert duration.longest_s == pytest.approx(1 / 3, rel=1e-5)


def test_duration_includes_open_ends():
    """Stretches open at the ends reach to the first and last sample."""
    np.testing.assert_allclose(intervals_above(np.array([2.0, 0.0, 0.0, 2.0]), 1.0, 1.0), [[0.0, 0.5], [2.5, 3.0]])
    np.testing.assert_allclose(intervals_above(np.full(5, 2.0), 1.0, 1.0), [[0.0, 4.0]])


def test_touched_threshold_does_not_count():
    """A peak that touches it does not count; a dip that touches it does not part a stretch."""
    assert duration_above(np.array([0.0, 1.0, 0.0]), 1.0, 1.0).count == 0
    dip = duration_above(np.array([0.0, 2.0, 1.0, 2.0, 0.0]), 1.0, 1.0)
    assert (dip.count, dip.total_s) == (1, pytest.approx(3.0))


def test_duration_below_threshold_is_zero():
    """Zeros, not an error."""
    duration = duration_above(np.zeros(5), 1.0, 1.0)
    assert (duration.total_s, duration.longest_s, duration.count) == (0.0, 0.0, 0)


@pytest.mark.parametrize("threshold", [0.0, -1.0, np.nan, np.inf])
def test_duration_rejects_non_positive_threshold(threshold):
    """Anything else is refused in words."""
    with pytest.raises(ParameterError, match="threshold"):
        duration_above(np.zeros(5), 1.0, threshold)


def test_duration_rejects_unknown_side():
    """Three sides there are."""
    with pytest.raises(ParameterError, match="side"):
        duration_above(np.zeros(5), 1.0, 1.0, side="up")
