"""The first crossing of a guard's polynomial is found, and only a crossing."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from seisblock.dynamics.polynomial import NO_CROSSING, evaluate, first_crossing, first_negative, lower_bound, shift

pytestmark = pytest.mark.kernel


def crossing(coefficients, h=1.0):
    g = np.array(coefficients, dtype=np.float64)
    return first_crossing(g, g.size - 1, h, np.zeros(g.size), np.zeros(g.size))


def from_roots(roots, sign=1.0):
    return sign * np.polynomial.polynomial.polyfromroots(roots)


def test_falling_line_crosses_at_root():
    """A falling line crosses at its root."""
    assert crossing([1.0, -4.0]) == pytest.approx(0.25, rel=1e-15)


def test_dip_between_ends_of_step_is_found():
    """A guard that is positive at both ends of a step but not between them is seen."""
    assert crossing(from_roots([0.5, 0.500001])) == pytest.approx(0.5, abs=1e-9)


def test_touching_is_no_event():
    """A double root touches zero and goes back: no event."""
    assert crossing(from_roots([0.3, 0.3])) == NO_CROSSING


def test_triple_root_is_an_event():
    """A triple root goes through zero, however flat."""
    assert crossing(-from_roots([0.3, 0.3, 0.3])) == pytest.approx(0.3, abs=1e-4)


def test_zero_at_start_is_judged_by_the_next_term():
    """The half-open rule: zero and rising is admissible, zero and falling fires at once."""
    assert crossing([0.0, 1.0, -0.5]) == NO_CROSSING
    assert crossing([-1e-3, 2.0]) == 0.0
    assert crossing([0.0, -1.0]) == pytest.approx(0.0, abs=1e-15)
    assert crossing([0.0, 0.0, 1.0]) == NO_CROSSING
    assert crossing([0.0, 0.0, -1.0]) == pytest.approx(0.0, abs=1e-9)


def test_round_off_at_start_is_zero():
    """A coefficient that is round-off beside the others does not decide."""
    assert crossing([1e-18, -1e-17, 1.0]) == NO_CROSSING
    assert crossing([0.0, 0.0, -2e-16, 2.5], 1e-3) == NO_CROSSING
    assert crossing([0.0, -1e-15, 30.0, -3.0], 1e-2) == NO_CROSSING


def test_crossing_at_the_very_end_is_inside():
    """The step's end belongs to the step, but only what goes below zero fires."""
    assert crossing([1.0, -1.0 - 1e-9]) == pytest.approx(1.0, abs=2e-9)
    assert crossing([1.0, -1.0]) == NO_CROSSING


@pytest.mark.parametrize("velocity", [1e-12, 1e-8, 1e-4, 0.1])
@pytest.mark.parametrize("height", [0.0, 1e-6, 10.0])
def test_end_of_hop_much_shorter_than_step_is_found_to_round_off(velocity, height):
    """A hop rises, falls and ends in a small part of the step; its height at the start is in units of velocity squared."""
    g = np.array([height * velocity**2, velocity, -0.5, 0.0])
    end = first_negative(g, 3, 1.0, 0.0, np.zeros(4), np.zeros(4))
    assert end == pytest.approx(velocity * (1.0 + np.sqrt(1.0 + 2.0 * height)), rel=1e-14)


def test_rising_guard_never_fires():
    """A guard without negative terms stays positive, however small it begins."""
    assert crossing([1e-20, 1.0, 5.0, 3.0]) == NO_CROSSING
    assert lower_bound(np.array([1e-20, 1.0, 5.0, 3.0]), 3, 1.0) > 0.0


def test_zero_polynomial_never_fires():
    """A guard that stays exactly at its limit is admissible."""
    assert crossing([0.0, 0.0, 0.0]) == NO_CROSSING


def test_not_a_number_returns():
    """A guard that is not a number ends the search."""
    assert crossing([np.nan, 1.0]) == NO_CROSSING


@given(st.lists(st.floats(-2.0, 3.0), min_size=1, max_size=6), st.sampled_from([1.0, -1.0]))
@settings(max_examples=300, deadline=None)
def test_agrees_with_the_roots_it_was_made_from(roots, sign):
    """For separated simple roots the answer is the first root with a falling sign."""
    roots = np.sort(np.array(roots))
    if roots.size > 1 and np.min(np.diff(roots)) < 1e-3:
        return
    if np.min(np.abs(np.concatenate([roots, roots - 1.0]))) < 1e-3:
        return
    c = from_roots(roots, sign)
    result = crossing(c)
    if np.polynomial.polynomial.polyval(0.0, c) < 0.0:
        assert result == 0.0
        return
    inside = roots[(roots > 0.0) & (roots <= 1.0)]
    if inside.size:
        assert result == pytest.approx(inside[0], abs=1e-8)
    else:
        assert result == NO_CROSSING


@given(st.lists(st.floats(-5.0, 5.0), min_size=2, max_size=9), st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
@settings(max_examples=100, deadline=None)
def test_shift_keeps_the_polynomial(coefficients, by, at):
    """Moving the origin changes no value."""
    c = np.array(coefficients)
    moved = c.copy()
    shift(moved, c.size - 1, by)
    size = (1 + np.abs(c).sum()) * 2**c.size
    assert evaluate(moved, c.size - 1, at) == pytest.approx(np.polynomial.polynomial.polyval(at + by, c), abs=1e-15 * size)
