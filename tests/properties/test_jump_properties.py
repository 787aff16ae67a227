"""Properties of every jump."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from seisblock.bodies.two_layer import Contact, TwoLayerBlock
from seisblock.models.jump.chain import ChainOutcome
from seisblock.models.jump.solve import solve_jump
from seisblock.records import Motion
from tests.motions import half_sine

G = 9.8
SHORT = TwoLayerBlock(2.08, 2.50, 1.06, 1.84, 1303.7, 160.0)
CONTACT = Contact(0.18, 0.17, 0.95, 0.85)


def noise(seed: int, peak: float = 9.0, n: int = 600) -> np.ndarray:
    rng = np.random.default_rng(seed)
    smooth = np.convolve(rng.normal(size=n + 20), np.hanning(20), mode="valid")[:n]
    return peak * smooth / np.abs(smooth).max()


@pytest.mark.slow
@given(st.integers(0, 10_000), st.sampled_from([0.0, 0.3]), st.floats(-0.5, 0.5), st.sampled_from(["paper", "friction"]))
@settings(max_examples=40, deadline=None)
def test_mirrored_motion_gives_mirrored_chain(seed, drop, spin, landing):
    """The mirrored motion gives the mirrored chain, bit by bit."""
    a = noise(seed)
    options = {"contact": CONTACT, "drop": drop, "spin": f"ratio={spin}", "landing": landing}
    first = solve_jump(SHORT, Motion.from_arrays(a, 0.01), **options)
    second = solve_jump(SHORT, Motion.from_arrays(-a, 0.01), **options)
    assert [c.outcome for c in first.outcome.chains] == [c.outcome for c in second.outcome.chains]
    np.testing.assert_array_equal(first["displacement"], -second["displacement"])
    np.testing.assert_array_equal(first["rotation"], -second["rotation"])
    np.testing.assert_array_equal(first["height"], second["height"])


@given(st.integers(0, 10_000), st.floats(0.25, 8.0), st.sampled_from(["paper", "friction"]))
@settings(max_examples=30, deadline=None)
def test_scaled_block_gives_similar_chain(seed, size, landing):
    """A block of `size` times the lengths in sqrt(size) times the time tilts by the same angles and goes `size` times as far."""
    a = noise(seed)
    big = TwoLayerBlock(2.08 * size, 2.5 * size, 1.06 * size, 1.84 * size, 1303.7, 160.0)
    options = {"contact": CONTACT, "spin": "ratio=0.19", "landing": landing, "first": True}
    first = solve_jump(SHORT, Motion.from_arrays(a, 0.01), **options).outcome
    second = solve_jump(big, Motion.from_arrays(a, 0.01 * np.sqrt(size)), **options).outcome
    assert first.outcome == second.outcome
    for c, d in zip(first.chains, second.chains, strict=True):
        assert d.max_rotation_rad == pytest.approx(c.max_rotation_rad, rel=1e-8, abs=1e-14)
        if c.total_displacement_m:
            assert d.total_displacement_m == pytest.approx(size * c.total_displacement_m, rel=1e-6, abs=1e-9)


@given(st.integers(0, 10_000))
@settings(max_examples=20, deadline=None)
def test_refining_the_record_changes_nothing(seed):
    """Interpolating the record linearly is the same motion: the same times to round-off."""
    a = noise(seed)
    fine = np.interp(np.arange(4 * a.size - 3) / 4, np.arange(a.size), a)
    first = solve_jump(SHORT, Motion.from_arrays(a, 0.01), contact=CONTACT, spin="ratio=0.19", drop=0.3).outcome
    second = solve_jump(SHORT, Motion.from_arrays(fine, 0.0025), contact=CONTACT, spin="ratio=0.19", drop=0.3).outcome
    assert first.outcome == second.outcome
    for c, d in zip(first.chains, second.chains, strict=True):
        for key in ("rocking_start_s", "impact_s", "landing_s", "end_s", "total_displacement_m"):
            left, right = getattr(c, key), getattr(d, key)
            assert (left is None) == (right is None)
            if left is not None:
                assert right == pytest.approx(left, abs=1e-7)


def test_energy_is_lost_at_the_impact():
    """With restitution at most one, the kinetic energy after the impact is not more than before."""
    response = solve_jump(SHORT, half_sine(6.5, 0.6, 3.0), contact=CONTACT, gravity=G)
    chain = response.outcome.chains[0]
    before = SHORT.corner_inertia * chain.impact_velocity_rad_s**2
    speed = chain.impact_velocity_rad_s
    after = SHORT.mass * ((0.95 * speed * SHORT.centroid_height) ** 2 + (0.85 * speed * SHORT.width / 2) ** 2)
    after += SHORT.centroid_inertia * (response.outcome.spin_ratio * speed) ** 2
    assert after <= before


def test_flight_is_a_parabola():
    """Rise and duration of a flight without spin are those of a thrown stone, and it moves opposite to the ground."""
    still = half_sine(6.5, 0.6, 4.0)
    chain = solve_jump(SHORT, still, contact=CONTACT, spin="ratio=0", gravity=G).outcome.chains[0]
    up = 0.85 * chain.impact_velocity_rad_s * 1.04
    assert chain.max_rise_m == pytest.approx(up**2 / (2 * G), rel=1e-14)
    assert chain.jump_duration_s == pytest.approx(2 * up / G, rel=1e-12)
    assert chain.jump_displacement_m == pytest.approx(0.95 * chain.impact_velocity_rad_s * SHORT.centroid_height * 2 * up / G, rel=1e-12)
    assert chain.rock_slide_duration_s == pytest.approx(0.0, abs=1e-9)


def test_motion_at_threshold_starts_no_rocking():
    """Equality does not rock; a hair above does."""
    threshold = SHORT.rocking_threshold(G)
    plateau = np.concatenate([np.zeros(5), np.full(20, threshold), np.zeros(5)])
    assert solve_jump(SHORT, Motion.from_arrays(plateau, 0.01), contact=CONTACT, gravity=G).outcome.outcome == ChainOutcome.DID_NOT_ROCK
    rocked = solve_jump(SHORT, Motion.from_arrays(plateau * (1 + 1e-9), 0.01), contact=CONTACT, gravity=G).outcome
    assert rocked.outcome != ChainOutcome.DID_NOT_ROCK


def test_first_sample_above_threshold_starts_rocking():
    """The first sample counts, although the next one is below the threshold."""
    a = np.concatenate([[9.0, 1.0], np.zeros(60)])
    assert solve_jump(SHORT, Motion.from_arrays(a, 0.01), contact=CONTACT).outcome.chains[0].rocking_start_s == 0.0


def test_spin_ratio_above_restitution_prevents_jump():
    """A spin ratio above e_y presses a corner into the floor: the chain ends at the impact."""
    motion = half_sine(6.5, 0.6, 3.0)
    assert solve_jump(SHORT, motion, contact=CONTACT, spin="ratio=0.86").outcome.outcome == ChainOutcome.NO_JUMP
    assert solve_jump(SHORT, motion, contact=CONTACT, spin="ratio=0.84").outcome.outcome == ChainOutcome.JUMPED


def test_chains_follow_in_time_and_accumulate():
    """Chains follow each other in time, and displacements add up in the history."""
    response = solve_jump(SHORT, Motion.from_arrays(noise(3, 12.0), 0.01), contact=CONTACT, spin="ratio=0.19")
    chains = response.outcome.chains
    assert len(chains) > 2
    for before, after in itertools.pairwise(chains):
        assert before.end_s <= after.rocking_start_s
    moved = sum(c.total_displacement_m or 0.0 for c in chains)
    if all(c.outcome in (ChainOutcome.JUMPED, ChainOutcome.NO_JUMP) for c in chains):
        assert response["displacement"][-1] == pytest.approx(moved, abs=1e-9)
    assert np.all(np.diff(response.time) >= 0)
    assert all(p.end_s >= p.start_s for p in response.phases)


def test_direction_option_ignores_opposite_push():
    """Direction + ignores an earlier push to the other side."""
    a = np.concatenate([-half_sine(6.5, 0.6, 3.0).horizontal, half_sine(6.5, 0.6, 3.0).horizontal])
    motion = Motion.from_arrays(a, 0.01)
    result = solve_jump(SHORT, motion, contact=CONTACT).outcome.chains[0]
    plus = solve_jump(SHORT, motion, contact=CONTACT, direction="+").outcome.chains[0]
    assert (result.direction, plus.direction) == ("-", "+")
    assert plus.rocking_start_s == pytest.approx(result.rocking_start_s + 3.0, abs=1e-12)
    assert plus.total_displacement_m == pytest.approx(-result.total_displacement_m, rel=1e-9)


def test_strong_push_overturns_block():
    """A long strong push topples the block, while rocking."""
    motion = Motion.from_arrays(np.concatenate([[0.0], np.full(500, 9.0)]), 0.01)
    outcome = solve_jump(SHORT, motion, contact=CONTACT).outcome
    assert outcome.outcome == "overturned while rocking"
    assert outcome.chains[0].max_rotation_rad == pytest.approx(np.pi / 2, rel=1e-12)
