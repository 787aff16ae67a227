"""Mode that begins from rest: closed forms of Shenton (1996) against the first mode of the solver."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from seisblock.bodies.block import Block
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.models.respond import solve_respond
from seisblock.records import Motion
from tests.models.respond.cases import constant_push, sequence

pytestmark = pytest.mark.kernel


def start(block, push, *, weight=G, **friction):
    """Return the mode in which a block starts under a constant acceleration of the ground."""
    return sequence(solve_respond(block, constant_push(push, weight=weight), settle_s=0.0, sensitivity=False, **friction).outcome)[0]


def expected(block, push, weight, mu, kinetic):
    """Return the mode that the closed form gives, for acceleration over gravity A, and its distance from the next boundary."""
    ratio = abs(push) / weight
    to_left = push > 0.0
    b = block.arms[1] if to_left else block.arms[0]
    h, k2 = block.centre, block.gyration_squared
    corner, slip = ("left", "-") if to_left else ("right", "+")
    required = ratio
    rocking = (ratio * h - b) / (k2 + h * h + b * b)
    demand = (ratio - h * rocking) / (1.0 + b * rocking)
    margin = min(abs(ratio - mu), abs(ratio - b / h), abs(kinetic * h - b))
    if required <= mu and ratio <= b / h:
        return "rest", margin
    if ratio > b / h:
        margin = min(margin, abs(demand - mu))
        if demand <= mu:
            return f"rock {corner}", margin
    if kinetic * h <= b:
        return f"slide {slip}", margin
    return f"slide-rock {corner} {slip}", margin


@settings(max_examples=300, deadline=None)
@given(
    width=st.floats(0.1, 2.0),
    height=st.floats(0.1, 2.0),
    offset=st.floats(-0.4, 0.4),
    push=st.floats(-25.0, 25.0),
    weight=st.floats(2.0, 20.0),
    mu=st.floats(0.0, 1.2),
    kappa=st.floats(0.5, 1.0),
)
def test_first_mode_from_rest_follows_shenton_criteria(width, height, offset, push, weight, mu, kappa):
    """Rest, slide, rock and slide-rock from rest, at unequal corners, with kinetic friction and vertical motion."""
    block = Block(width, height, centroid_offset=offset * width)
    mode, margin = expected(block, push, weight, mu, kappa * mu)
    if margin > 1e-6 and abs(push) > 1e-6 and mu * kappa < block.gyration_squared / block.radius**2:
        assert start(block, push, weight=weight, mu=mu, mu_kinetic=kappa * mu) == mode


def test_rocking_without_slip_holds_up_to_critical_acceleration():
    """Friction mu > b/h holds up to A* = (mu (k2 + h^2) - h b)/(k2 + b^2 - mu b h); beyond it the body slides while it rocks."""
    block = Block(0.4, 1.0)
    b, h, k2 = 0.2, 0.5, block.gyration_squared
    for mu in (0.45, 0.6, 0.8):
        critical = (mu * (k2 + h * h) - h * b) / (k2 + b * b - mu * b * h)
        assert critical > b / h
        assert start(block, -G * critical * (1.0 - 1e-9), mu=mu) == "rock right"
        assert start(block, -G * critical * (1.0 + 1e-9), mu=mu) == "slide-rock right +"
    assert k2 + b * b - 1.0 * b * h > 0.0 > k2 + b * b - 1.4 * b * h
    assert start(block, -50.0 * G, mu=1.4) == "rock right"


def test_acceleration_ramp_starts_motion_at_exact_threshold_time():
    """A ramp of the ground acceleration starts sliding at mu g, rocking at g b/h, at the exact time."""
    ramp = Motion.from_arrays(np.linspace(0.0, 8.0, 81), 0.01)
    slide = solve_respond(Block(0.6, 1.0), ramp, mu=0.3).outcome
    rock = solve_respond(Block(0.3, 1.0), ramp, mu=0.5).outcome
    assert sequence(slide)[:2] == ["rest", "slide -"]
    assert slide.events[1]["time_s"] == pytest.approx(0.3 * G / 10.0, abs=1e-13)
    assert sequence(rock)[:2] == ["rest", "rock left"]
    assert rock.events[1]["time_s"] == pytest.approx(0.3 * G / 10.0, abs=1e-13)


def test_flight_starts_when_ground_falls_faster_than_gravity():
    """G < 0: from rest and from a slide the block flies, at the time at which G is zero."""
    down = Motion.from_arrays(np.zeros(41), 0.1, vertical=np.linspace(0.0, -2.0 * G, 41))
    outcome = solve_respond(Block(0.4, 1.0), down, mu=0.3).outcome
    assert sequence(outcome)[:2] == ["rest", "flight"]
    assert outcome.events[1]["time_s"] == pytest.approx(2.0, abs=1e-9)
    moving = solve_respond(Block(0.4, 0.3), down, mu=0.3, initial=(0.0, 0.15, 0.0, 20.0, 0.0, 0.0)).outcome
    assert sequence(moving)[:2] == ["slide +", "flight"]
    assert moving.events[1]["time_s"] == pytest.approx(2.0, abs=1e-9)
    assert start(Block(0.4, 1.0), 0.0, weight=-1.0, mu=0.3) == "flight"


def test_first_sample_above_threshold_starts_motion_at_once():
    """The record begins in the middle of the shaking: the first mode is not rest."""
    assert start(Block(0.6, 1.0), 5.0, mu=0.3) == "slide -"
    assert start(Block(0.3, 1.0), -5.0, mu=0.9) == "rock right"


def test_frictionless_block_keeps_its_position_in_space():
    """Without friction: at rest while the ground is, and then the centre stays where it was in space."""
    t = np.arange(201) * 0.01
    a = np.where(t < 0.5, 0.0, np.sin(4.0 * np.pi * (t - 0.5)))
    response = solve_respond(Block(0.5, 0.5), Motion.from_arrays(a, 0.01), mu=0.0)
    velocity = np.concatenate([[0.0], np.cumsum(0.005 * (a[1:] + a[:-1]))])
    moved = np.concatenate([[0.0], np.cumsum(0.01 * velocity[:-1] + 1e-4 * (a[:-1] / 3 + a[1:] / 6))])
    assert response.outcome.events[1]["time_s"] == pytest.approx(0.5, abs=1e-12)
    at = np.searchsorted(response.time, t)
    np.testing.assert_allclose(response["displacement"][at], -moved, rtol=0.0, atol=1e-13)


def test_friction_equal_to_slenderness_leaves_rest_on_time():
    """With mu = b/h exactly both thresholds are met together: the rest ends on time, in one mode or the other."""
    ramp = Motion.from_arrays(np.linspace(0.0, 8.0, 81), 0.01)
    outcome = solve_respond(Block(0.3, 1.0), ramp, mu=0.3).outcome
    assert outcome.events[1]["time_s"] == pytest.approx(0.3 * G / 10.0, abs=1e-12)
    assert outcome.events[1]["mode"] in ("slide", "rock", "slide-rock")
    assert math.isfinite(outcome.final_displacement_m)
