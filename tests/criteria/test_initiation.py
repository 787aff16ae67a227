"""Mode that begins from rest: closed forms of Shenton (1996) against the five-mode solver, and their limits."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from seisblock.bodies.block import Block
from seisblock.core.errors import ParameterError
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.criteria import first_mode, friction_to_rock, peak_loading_ratio
from seisblock.models.respond import solve_respond
from seisblock.records import Motion
from tests.models.respond.cases import constant_push


@settings(max_examples=200, deadline=None)
@given(width=st.floats(0.1, 2.0), height=st.floats(0.1, 2.0), mu=st.floats(0.0, 1.2), ratio=st.floats(0.01, 2.5))
def test_initiation_mode_equals_solver(width, height, mu, ratio):
    """Rest, slide, rock and slide-rock under a jump of the ground acceleration, away from the limits themselves."""
    block = Block(width, height)
    required = friction_to_rock(block, ratio) or mu + 1.0
    slender = width / height
    if min(abs(ratio - mu), abs(ratio - slender), abs(mu - slender), abs(mu - required)) > 1e-6 and mu < 1.3:
        outcome = solve_respond(block, constant_push(ratio * G), mu=mu, settle_s=0.0, sensitivity=False).outcome
        assert outcome.events[0]["mode"] == first_mode(block, mu, ratio)


def test_required_friction_rises_from_slenderness_to_limit():
    """At A = b/h it is b/h; under an endless push (k^2 + b^2)/(b h); a worn block turns about its worn edge."""
    block = Block(0.3, 1.0)
    b, h, k2 = 0.15, 0.5, block.gyration_squared
    assert friction_to_rock(block, b / h) is None
    assert friction_to_rock(block, b / h * (1.0 + 1e-12)) == pytest.approx(b / h, rel=1e-11)
    assert friction_to_rock(block, 1e12) == pytest.approx((k2 + b * b) / (b * h), rel=1e-9)
    assert friction_to_rock(block.with_wear(0.1), 0.25) is not None


def test_largest_demand_includes_vertical_motion():
    """The largest abs(a)/(g + a_y) need not be at the peak; ground that falls faster than gravity leaves no weight."""
    motion = Motion.from_arrays([0.0, 3.0, -2.5, 0.0], 0.5, vertical=[0.0, 2.0, -5.0, 0.0])
    assert peak_loading_ratio(motion, gravity=10.0) == (0.5, 1.0)
    assert peak_loading_ratio(motion, vertical=False, gravity=10.0) == (0.3, 0.5)
    assert math.isinf(peak_loading_ratio(Motion.from_arrays([0.0, 1.0], 0.5, vertical=[0.0, -11.0]), gravity=10.0)[0])


def test_initiation_rejects_negative_numbers():
    """A negative friction and a negative push are no numbers of this criterion."""
    with pytest.raises(ParameterError, match="friction"):
        first_mode(Block(0.3, 1.0), -0.1, 0.5)
    with pytest.raises(ParameterError, match="ratio"):
        friction_to_rock(Block(0.3, 1.0), math.nan)
