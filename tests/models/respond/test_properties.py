"""Properties of every block and motion: energy, mirror symmetry, similarity, contact."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from seisblock.bodies.block import Block
from seisblock.core.errors import SolverError
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.models.respond import constants, solve_respond
from seisblock.models.respond.outcome import motion_modes
from seisblock.models.respond.solve import energy
from seisblock.records import Motion
from tests.models.respond.cases import shaking, solve_case

BLOCKS = st.builds(
    lambda width, height, offset, centre: Block(width, height, centroid_offset=offset * width, centroid_height=centre * height),
    st.floats(0.1, 1.5),
    st.floats(0.1, 1.5),
    st.floats(-0.35, 0.35),
    st.floats(0.25, 0.8),
)
FRICTION = st.fixed_dictionaries({"mu": st.floats(0.0, 1.6), "restitution": st.sampled_from([0.0, 0.0, 0.2, 0.6])})
RATIO = st.sampled_from([None, None, 0.6, 0.95])


@settings(max_examples=60, deadline=None)
@given(block=BLOCKS, friction=FRICTION, kappa=st.floats(0.6, 1.0), ratio=RATIO, seed=st.integers(0, 10**6), peak=st.floats(2.0, 20.0))
def test_energy_balance_holds_at_every_sample_and_event(block, friction, kappa, ratio, seed, peak):
    """Work of the ground less friction less impacts is the change of kinetic and potential energy, to 1e-9, at every sample and event."""
    setting, run = solve_case(
        block, shaking(seed, peak, seconds=6.0), mu_kinetic=kappa * friction["mu"], rocking_restitution=ratio, **friction
    )
    _, states, modes = run.table()
    modes = motion_modes(run, modes)
    have = energy(setting.rigid_body, setting.gravity, states, modes) / setting.rigid_body.mass
    duration = states[:, constants.WORK] - states[:, constants.FRICTION] - states[:, constants.LOSS]
    scale = have.max() + np.abs(states[:, constants.WORK]).max()
    np.testing.assert_allclose(have - have[0], duration, rtol=0.0, atol=1e-9 * scale)
    assert (np.diff(states[:, constants.FRICTION]) >= -1e-12 * scale).all()
    assert (np.diff(states[:, constants.LOSS]) >= -1e-12 * scale).all()
    assert (np.diff(states[:, constants.PATH]) >= -1e-15).all()


@settings(max_examples=30, deadline=None)
@given(block=BLOCKS, friction=FRICTION, seed=st.integers(0, 10**6), peak=st.floats(2.0, 20.0))
def test_contact_constraints_hold_at_every_sample(block, friction, seed, peak):
    """The lowest corner is never under the ground, and friction never more than static friction allows: it does not slip at rest."""
    response = solve_respond(block, shaking(seed, peak, seconds=6.0), sensitivity=False, **friction)
    right, left = block.arms
    theta, height = response["rotation"], response["height"]
    low = height + np.minimum(-right * np.sin(theta), left * np.sin(theta)) - block.centre * np.cos(theta)
    assert low.min() > -1e-11
    assert response["lift"].min() > -1e-11
    np.testing.assert_allclose(low, response["lift"], atol=1e-11)


def until_hops_die(response):
    """Return the time at which a second row of ever smaller hops begins, s: how the first ended is in it, to its last digit."""
    landings = np.array([event.time_s for event in response.events if event.name == "landing"])
    short = np.diff(landings) < 1e-5
    begins = landings[1:][short & ~np.append(False, short[:-1])]
    return float(begins[1]) if begins.size > 1 else np.inf


@settings(max_examples=40, deadline=None)
@given(block=BLOCKS, friction=FRICTION, ratio=RATIO, seed=st.integers(0, 10**6), peak=st.floats(2.0, 20.0))
def test_mirrored_block_and_motion_give_mirrored_events(block, friction, ratio, seed, peak):
    """Ground and block mirrored: the same events with left and right, plus and minus exchanged, at the same times but for round-off."""
    motion = shaking(seed, peak, seconds=6.0)
    mirrored = Motion.from_arrays(-motion.horizontal, motion.dt, vertical=motion.vertical)
    second = Block(block.width, block.height, centroid_offset=-block.centroid_offset, centroid_height=block.centroid_height)
    assume(second.arms == block.arms[::-1])
    run = solve_respond(block, motion, rocking_restitution=ratio, sensitivity=False, **friction)
    computed, clear = run.outcome, until_hops_die(run)
    theirs = solve_respond(second, mirrored, rocking_restitution=ratio, sensitivity=False, **friction).outcome
    exchange = {"left": "right", "right": "left", "+": "-", "-": "+", None: None}
    expected = [{**event, "corner": exchange[event["corner"]], "slip": exchange[event["slip"]]} for event in computed.events]
    # impacts amplify the last digit, and ever smaller hops without bound, so the first events alone are compared
    compared = [event for event in expected[:30] if event["time_s"] <= clear]
    assert compared
    for ours, other_side in zip(compared, theirs.events[: len(compared)], strict=True):
        assert other_side == {**ours, "time_s": pytest.approx(ours["time_s"], abs=1e-8)}
    if len(compared) == len(expected):
        assert theirs.final_displacement_m == pytest.approx(-computed.final_displacement_m, abs=1e-9)


@settings(max_examples=25, deadline=None)
@given(block=BLOCKS, friction=FRICTION, seed=st.integers(0, 10**6), peak=st.floats(2.0, 12.0))
def test_scaled_lengths_and_times_give_similar_response(block, friction, seed, peak):
    """Four times the lengths and twice the times, the same accelerations: the same leans, four times the displacements."""
    motion = shaking(seed, peak, seconds=3.0)
    slow = Motion(motion.acceleration, 2.0 * motion.dt)
    large = Block(4 * block.width, 4 * block.height, centroid_offset=4 * block.centroid_offset, centroid_height=4 * block.centre)
    _, small_run = solve_case(block, motion, **friction)
    _, large_run = solve_case(large, slow, **friction, settle_s=120.0)
    subset = min(len(small_run.record_part.events), len(large_run.record_part.events), 12)
    for computed, theirs in zip(small_run.record_part.events[:subset], large_run.record_part.events[:subset], strict=True):
        assert (computed.source, computed.target) == (theirs.source, theirs.target)
        assert theirs.time == pytest.approx(2.0 * computed.time, rel=1e-7)
        assert theirs.after[constants.THETA] == pytest.approx(computed.after[constants.THETA], rel=1e-5, abs=1e-9)
        assert theirs.after[constants.X] == pytest.approx(4.0 * computed.after[constants.X], rel=1e-5, abs=1e-9)


@settings(max_examples=40, deadline=None)
@given(block=BLOCKS, friction=FRICTION, seed=st.integers(0, 10**6), peak=st.floats(2.0, 20.0), dt=st.sampled_from([0.005, 0.01, 0.02]))
def test_every_motion_ends_in_a_final_state_or_status(block, friction, seed, peak, dt):
    """Every motion ends: at rest, fallen, or with a status and a sentence."""
    try:
        response = solve_respond(block, shaking(seed, peak, seconds=8.0, dt=dt), sensitivity=False, **friction)
    except SolverError as error:
        pytest.fail(str(error))
    outcome = response.outcome
    assert outcome.settled or outcome.overturned or response.warnings
    assert sum(outcome.time_in_mode_s.values()) == pytest.approx(outcome.end_s, abs=1e-9)
    assert outcome.max_displacement_m >= abs(outcome.final_displacement_m) * (1.0 - 1e-12)


def test_resampling_piecewise_linear_motion_changes_nothing():
    """Samples put on the straight lines between samples leave the answer: the steps are exact."""
    motion = shaking(5, 6.0, seconds=6.0)
    fine_time = np.arange(10 * (motion.samples - 1) + 1) / 10
    rows = [np.interp(fine_time, np.arange(motion.samples), row) for row in (motion.horizontal, motion.vertical)]
    fine = Motion.from_arrays(rows[0], motion.dt / 10, vertical=rows[1])
    block = Block(0.3, 0.8)
    coarse, dense = (solve_respond(block, item, mu=0.45, sensitivity=False).outcome for item in (motion, fine))
    assert len(coarse.events) == len(dense.events) > 50
    times = [[event["time_s"] for event in outcome.events] for outcome in (coarse, dense)]
    np.testing.assert_allclose(times[0], times[1], rtol=0.0, atol=1e-7)
    assert dense.final_displacement_m == pytest.approx(coarse.final_displacement_m, abs=1e-9)
    assert G > 0.0
