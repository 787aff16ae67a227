"""Ties: where the input turns at a threshold to the last digit, the mode stays and no run is given up."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from seisblock.bodies.block import Block
from seisblock.models.respond.batch import respond_many
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.solve import respond_params, solve_respond
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.verdicts import rock_verdict
from seisblock.records import Motion

G = 9.80665
PEAK = [0.0, 1.4557032986287874, 1.4915089727103732, 1.475750313468548, 0.0]
"""A peak that equals the rocking threshold of ``TIED`` to the last digit, m/s^2."""

TIED, MU = Block(0.3420401615159788, 2.2489091324977353), 0.63


def shift_floats(value: float, digits: int) -> float:
    """Return a number that many representable numbers further."""
    for _ in range(abs(digits)):
        value = math.nextafter(value, math.copysign(math.inf, digits))
    return value


def test_peak_equal_to_rocking_threshold_leaves_block_at_rest():
    """The run was given up: the guard fired below its own round-off, and the only consistent mode was excluded."""
    response = solve_respond(TIED, Motion.from_arrays(PEAK, 0.005), mu=MU)
    assert response.outcome.outcome == "rests"
    assert response.outcome.max_displacement_m == 0.0


@settings(max_examples=150, deadline=None)
@given(
    width=st.floats(0.05, 1.0),
    slenderness=st.floats(0.6, 8.0),
    friction=st.sampled_from(("mu", "b/h", "below b/h", "above b/h")),
    kinetic=st.sampled_from((1.0, 0.8)),
    threshold=st.sampled_from(("rock", "slide")),
    seed=st.integers(0, 2**32 - 1),
    digits=st.integers(-2, 2),
    plateau=st.booleans(),
    vertical=st.booleans(),
)
def test_peaks_at_or_near_thresholds_are_solved_to_the_end(
    width, slenderness, friction, kinetic, threshold, seed, digits, plateau, vertical
):
    """Peaks and plateaus at g B/H or mu g, and up to two digits beside them, with mu at and beside B/H, are followed to their end."""
    rng = np.random.default_rng(seed)
    block = Block(width, width * slenderness)
    ratio = block.width / block.height
    mu = {"mu": 0.4, "b/h": ratio, "below b/h": shift_floats(ratio, -1), "above b/h": shift_floats(ratio, 1)}[friction]
    shape = rng.standard_normal(30).cumsum()
    up = 0.3 * G * rng.standard_normal(30) if vertical else np.zeros(30)
    peak = int(np.argmax(np.abs(shape)))
    limit = shift_floats((ratio if threshold == "rock" else mu) * (G + up[peak]), digits)
    push = shape * abs(limit / shape[peak])
    push[peak] = math.copysign(limit, shape[peak])
    if plateau and peak + 1 < push.size:
        push[peak + 1], up[peak + 1] = push[peak], up[peak]
    motion = Motion.from_arrays(push, 0.01, vertical=up)
    setting = respond_params(block, options=RespondOptions(mu=mu, mu_kinetic=kinetic * mu))
    assert not respond_many([setting], motion).gave_up.any()
    assert rock_verdict(block, motion, options=RockOptions(vertical=vertical)).max_rotation_ratio >= 0.0


@pytest.mark.parametrize("digits", range(-3, 4))
def test_energy_balance_holds_with_friction_equal_to_slenderness(digits):
    """With mu = B/H to the last digit what the ground puts in is what friction takes; it was up to five times as much."""
    block = Block(0.5, 1.25)
    rng = np.random.default_rng(4)
    for _ in range(20):
        push = rng.standard_normal(40).cumsum()
        push *= 1.3 * G * 0.4 / np.abs(push).max()
        outcome = solve_respond(block, Motion.from_arrays(push, 0.01), mu=shift_floats(0.4, digits), sensitivity=False).outcome
        assert outcome.settled
        missing = outcome.energy_friction_j + outcome.energy_impacts_j
        assert missing == pytest.approx(outcome.energy_ground_j, rel=1e-9, abs=1e-12)
