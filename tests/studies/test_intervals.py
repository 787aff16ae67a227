"""Intervals of a share against scipy.stats, which the program does not wait for."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import binom, binomtest

from seisblock.core.errors import ParameterError
from seisblock.studies.intervals import clopper_pearson


@given(st.integers(1, 400).flatmap(lambda runs: st.tuples(st.integers(0, runs), st.just(runs))), st.sampled_from([0.5, 0.9, 0.95, 0.999]))
def test_intervals_equal_scipy(counted, confidence):
    """Any count, any level; none and all included."""
    test = binomtest(*counted)
    assert clopper_pearson(*counted, confidence) == pytest.approx(tuple(test.proportion_ci(confidence)), rel=1e-8, abs=1e-12)


def test_clopper_pearson_ends_have_binomial_tails():
    """Each bound is a binomial tail of half the excluded probability; none and all have one-sided closed forms."""
    low, high = clopper_pearson(35, 100)
    assert binom.sf(34, 100, low) == pytest.approx(0.025, rel=1e-9)
    assert binom.cdf(35, 100, high) == pytest.approx(0.025, rel=1e-9)
    assert clopper_pearson(0, 50) == (0.0, pytest.approx(1.0 - 0.025**0.02))
    assert clopper_pearson(50, 50) == (pytest.approx(0.025**0.02), 1.0)


@pytest.mark.parametrize(("count", "runs", "level"), [(3, 2, 0.9), (-1, 2, 0.9), (0, 0, 0.9), (1, 2, 1.0)])
def test_intervals_reject_invalid_counts(count, runs, level):
    """Counts that make no share, and a level outside (0, 1), are one sentence."""
    with pytest.raises(ParameterError, match=r"an interval requires|the confidence must"):
        clopper_pearson(count, runs, level)
