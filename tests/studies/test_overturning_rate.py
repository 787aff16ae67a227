"""The share of a cemetery that falls ([Furukawa2009]_ section 4): rates, intervals, curves, dowels."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from seisblock.bodies.cemetery.cemetery import Cemetery, Stone
from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.bodies.edge_wear import SHARP_EDGES
from seisblock.core.errors import ParameterError
from seisblock.criteria.gravestones import DOWELLED, PLAIN, overturning_ratio
from seisblock.studies.survey.limits import rigid_limits
from seisblock.studies.survey.overturning_rate import (
    overturned_stones,
    overturning_rate,
    rate_curve,
    rate_warnings,
    stones_saved,
    threshold_ratio,
)

AOYAMA = read_cemetery("aoyama.csv")


def test_overturning_rate_is_share_above_threshold():
    """The rate counts the stones whose H/B exceeds (9), and (10) when they are reinforced."""
    for pga, f in ((7.25, 2.75), (2.8, 1.65), (9.27, 1.31)):
        assert overturning_rate(AOYAMA, pga, f).rate == AOYAMA.share_above(float(overturning_ratio(pga, f)))
        dowelled = overturning_rate(AOYAMA.with_dowels(), pga, f)
        assert dowelled.rate == AOYAMA.share_above(float(overturning_ratio(pga, f, DOWELLED)))


def test_threshold_ratio_separates_fallen_and_standing():
    """The threshold H/B of either criterion divides the stones that fall from those that stand."""
    for reinforced, fit in ((False, PLAIN), (True, DOWELLED)):
        result = threshold_ratio(7.25, 2.75, reinforced=reinforced)
        assert result == pytest.approx(float(overturning_ratio(7.25, 2.75, fit)), rel=1e-12)
    rigid = threshold_ratio(7.25, 1.0, limits=rigid_limits)
    alike = Cemetery(tuple(Stone(rigid * factor) for factor in (0.999, 1.001)))
    assert overturned_stones(alike, 7.25, 1.0, limits=rigid_limits).tolist() == [False, True]


def test_rigid_block_threshold_at_low_frequency_is_west():
    """Under a slow pulse a rigid block falls beyond g B/H ([Furukawa2009]_ eq. (2)), and needs more the faster the pulse."""
    assert threshold_ratio(5.0, 0.0, limits=partial(rigid_limits, inset=SHARP_EDGES)) == pytest.approx(9.80665 / 5.0, rel=1e-12)
    assert threshold_ratio(5.0, 0.0, limits=rigid_limits) == pytest.approx(0.9 * 9.80665 / 5.0, rel=1e-12)
    rates = [overturning_rate(AOYAMA, 5.0, f, limits=rigid_limits).rate for f in (0.0, 0.5, 1.0, 2.0)]
    assert rates == sorted(rates, reverse=True)
    with pytest.raises(ParameterError, match="does not model dowels"):
        overturning_rate(AOYAMA.with_dowels(), 5.0, 1.0, limits=rigid_limits)


def test_reinforced_stones_use_eq_10():
    """A dowel keeps up the stone that falls without it."""
    pair = Cemetery((Stone(3.0), Stone(3.0, reinforced=True, count=2)))
    between = 0.5 * (PLAIN.p_m_s2 + DOWELLED.p_m_s2) / 3.0
    assert overturned_stones(pair, between, 0.0).tolist() == [True, False, False]


def test_rate_curve_equals_single_rates():
    """Each point of a curve is the rate at its PGA and frequency."""
    for point in rate_curve(AOYAMA, [1.0, 4.0, 7.25, 13.0], [0.5, 2.75]):
        assert point.rate == overturning_rate(AOYAMA, point.pga_m_s2, point.frequency_hz).rate


@settings(max_examples=50, deadline=None)
@given(st.floats(0.5, 20.0), st.floats(0.0, 5.0), st.floats(1.0, 2.0))
def test_rates_are_monotone_in_pga_frequency_and_dowels(pga, f, factor):
    """More acceleration never saves a stone; a higher frequency or a dowel never overturns one."""
    rate = overturning_rate(AOYAMA, pga, f).rate
    assert overturning_rate(AOYAMA, pga * factor, f).rate >= rate
    assert overturning_rate(AOYAMA, pga, f * factor).rate <= rate
    assert overturning_rate(AOYAMA.with_dowels(), pga, f).rate <= rate


def test_most_fragile_stones_are_reinforced_first():
    """Reinforcing k stones takes the most slender first, splits rows that stand for several, and skips those that have a dowel."""
    mixed = Cemetery((Stone(2.0, count=3), Stone(4.0, count=2), Stone(5.0, reinforced=True)))
    after = mixed.with_dowels(3)
    assert after.size == 6
    assert sorted(after.ratios[after.reinforced]) == [2.0, 4.0, 4.0, 5.0]
    assert stones_saved(mixed, 2.5, 1.0, most_fragile=1) == 1
    assert stones_saved(mixed, 2.5, 1.0) == 2
    assert stones_saved(AOYAMA, 7.25, 2.75) == 35 - 8
    np.testing.assert_array_equal(AOYAMA.with_dowels(0).ratios, AOYAMA.ratios)


def test_overturning_rate_warns_of_unit_and_range():
    """A PGA in m/s^2 where check the unit, and a frequency outside the fit."""
    assert "check the unit" in rate_warnings(AOYAMA, 0.055, 2.0)[0]
    assert "4.5 Hz" in rate_warnings(AOYAMA, 5.0, 4.5)[0]
    assert rate_warnings(AOYAMA, 5.0, 2.0) == ()
