"""Furukawa et al. (2009), eqs. (7)-(10): the criterion of gravestones and its inverses."""

from __future__ import annotations

import math

import numpy as np
import pytest

from seisblock.criteria.gravestones import (
    REINFORCED,
    UNREINFORCED,
    GravestoneCriterion,
    amplitude,
    highest_overturning_frequency,
    judge,
    outside_fit,
    overturning_pga,
    threshold_ratio,
)
from seisblock.errors import ParameterError

FREQUENCIES = np.linspace(0.0, 5.0, 51)


@pytest.mark.parametrize(
    ("criterion", "p_gal", "q", "r"), [(UNREINFORCED, 826.8, 1.92, 4.6), (REINFORCED, 1162.9, 1.84, 4.5)], ids=["eq9", "eq10"]
)
def test_eqs_9_and_10_as_printed(criterion, p_gal, q, r):
    """H/B = p sqrt(1 + (f/q)^r) / PGA with the printed numbers, both in gal."""
    for pga_gal in (100.0, 553.0, 1300.0):
        for f in (0.5, 1.31, 3.0):
            expected = p_gal * math.sqrt(1.0 + (f / q) ** r) / pga_gal
            assert threshold_ratio(pga_gal / 100.0, f, criterion) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("criterion", [UNREINFORCED, REINFORCED, GravestoneCriterion(9.8, 2.0, 3.0)])
def test_the_inverses_invert(criterion):
    """PGA from H/B and frequency from both give back what (9), (10) were given."""
    pga = np.geomspace(1.0, 13.0, 7)[:, None]
    ratio = threshold_ratio(pga, FREQUENCIES, criterion)
    np.testing.assert_allclose(overturning_pga(ratio, FREQUENCIES, criterion), np.broadcast_to(pga, ratio.shape), rtol=1e-13)
    for f in (0.4, 1.0, 3.0):
        found = highest_overturning_frequency(float(threshold_ratio(5.0, f, criterion)), 5.0, criterion)
        assert found == pytest.approx(f, rel=1e-9)


def test_a_stone_too_stout_overturns_at_no_frequency():
    """Below a(0)/PGA there is no frequency at which a stone overturns."""
    assert highest_overturning_frequency(1.0, 8.0) is None
    assert highest_overturning_frequency(8.268 / 4.0, 4.0) == pytest.approx(0.0, abs=1e-3)


def test_more_acceleration_or_a_lower_frequency_overturns_stouter_stones():
    """The threshold falls with PGA and climbs with frequency; a dowel raises it."""
    assert (np.diff(amplitude(FREQUENCIES)) > 0).all()
    assert (amplitude(FREQUENCIES, REINFORCED) > amplitude(FREQUENCIES)).all()
    assert (np.diff(threshold_ratio(np.linspace(1.0, 13.0, 20), 2.0)) < 0).all()


def test_table_5_band_on_the_line_includes_its_ends():
    """|threshold - H/B| <= 0.1 is on the line, to the last bit of 2.6 - 2.5."""
    assert [judge(2.6, t) for t in (2.49, 2.5, 2.6, 2.7, 2.71)] == ["overturns", *["on the line"] * 3, "stands"]


def test_leaving_the_fit_is_said():
    """Each of PGA, frequency and H/B outside its range is one sentence; the ends are inside."""
    assert outside_fit(1.0, 0.5, [1.25, 6.5]) == ()
    assert outside_fit(13.0, 3.0) == ()
    said = outside_fit(14.0, 3.2, [1.0, 2.0, 7.0])
    assert len(said) == 3
    assert "1400 gal" in said[0]
    assert "3.2 Hz" in said[1]
    assert "2 of 3 stones" in said[2]


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: threshold_ratio(0.0, 1.0), "peak ground acceleration must be positive, found 0"),
        (lambda: threshold_ratio([5.0, np.nan], 1.0), "must be positive, found nan"),
        (lambda: threshold_ratio(5.0, -1.0), "frequency must be zero or more, found -1"),
        (lambda: overturning_pga(-2.0, 1.0), "height over width must be positive, found -2"),
        (lambda: highest_overturning_frequency(2.0, 0.0), "must be positive, found 0"),
        (lambda: GravestoneCriterion(8.0, 0.0, 4.6), "q of the criterion must be positive"),
    ],
)
def test_impossible_numbers_are_refused(call, message):
    """A PGA, ratio, frequency or parameter out of range is one sentence."""
    with pytest.raises(ParameterError, match=message):
        call()
