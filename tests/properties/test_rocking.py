"""Properties of every rocking block under any shaking."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from seisblock.bodies.block import Block, scale_block
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.solve import solve_rock
from seisblock.models.rock.verdicts import rock_verdict
from seisblock.records import Motion

pytestmark = pytest.mark.kernel

shakings = st.builds(
    lambda seed, amplitude, n: amplitude * np.random.default_rng(seed).normal(size=n).cumsum() / 3,
    st.integers(0, 10**6),
    st.floats(0.3, 3.0),
    st.integers(20, 60),
)
blocks = st.builds(
    lambda height, ratio, offset: Block(height / ratio, height, centroid_offset=offset * height / ratio / 2),
    st.floats(0.3, 3.0),
    st.floats(2.0, 8.0),
    st.sampled_from([0.0, 0.0, -0.3, 0.4]),
)
subset = settings(max_examples=25, deadline=None)


@subset
@given(shakings, blocks, st.booleans())
def test_mirrored_block_and_motion_give_mirrored_rocking(a, block, linear):
    """The mirrored block under the mirrored motion gives the mirrored answer, bit by bit."""
    mirrored = Block(block.width, block.height, centroid_offset=-block.centroid_offset)
    first, second = (solve_rock(b, Motion.from_arrays(x, 0.03), linear=linear) for x, b in ((a, block), (-a, mirrored)))
    np.testing.assert_array_equal(first["rotation"], -second["rotation"])
    assert first.outcome.impacts == second.outcome.impacts
    assert first.outcome.overturning_time_s == second.outcome.overturning_time_s


@subset
@given(shakings, blocks, st.floats(0.2, 9.0))
def test_scaled_block_and_time_give_similar_rocking(a, block, length):
    """Length L and time sqrt(L): the same angles at the same samples, and the same forces per weight."""
    small = solve_rock(block, Motion.from_arrays(a, 0.03))
    large = solve_rock(scale_block(block, size=length), Motion.from_arrays(a, 0.03 * math.sqrt(length)))
    assert small.outcome.overturned == large.outcome.overturned
    assert large.outcome.max_rotation_rad == pytest.approx(small.outcome.max_rotation_rad, rel=1e-7, abs=1e-12)
    if small.outcome.overturned:
        assert large.outcome.overturning_time_s == pytest.approx(small.outcome.overturning_time_s * math.sqrt(length), rel=1e-7)
    if small.outcome.max_friction_demand is not None and large.outcome.max_friction_demand is not None:
        assert large.outcome.max_friction_demand == pytest.approx(small.outcome.max_friction_demand, rel=1e-5)


@subset
@given(blocks, st.floats(0.1, 0.95), st.floats(-1.0, 1.0), st.booleans())
def test_free_rocking_energy_never_grows(block, share, push, linear):
    """Without shaking, m R/I_O-scaled energy is kept between impacts and falls at each of them."""
    alpha = block.slendernesses[0]
    p = math.sqrt(G * block.lever_ratios[0])
    response = solve_rock(block, Motion.from_arrays(np.zeros(60), 0.02), initial=(share * alpha, push * p * alpha * 0.3), linear=linear)
    theta, omega = response["rotation"], response["angular_velocity"]
    energy = np.empty(theta.size)
    for i, (angle, rate) in enumerate(zip(theta, omega, strict=True)):
        # at the instant of an impact the angular velocity tells about which corner it turns, before and after
        rows = (response.time == response.time[i]).nonzero()[0]
        right = ((rate > 0) == (i == rows[-1])) if abs(angle) < 1e-12 else angle > 0
        side = 0 if right else 1
        slender, radius = block.slendernesses[side], block.radii[side]
        lean = abs(angle)
        rise = slender * lean - lean**2 / 2 if linear else math.cos(slender - lean) - math.cos(slender)
        inertia = block.corner_inertias[side] / block.total_mass
        energy[i] = 0.5 * inertia * rate**2 + G * radius * rise
    assert np.all(np.diff(energy) <= 1e-12 * energy[0])


@subset
@given(shakings, blocks)
def test_resampling_changes_no_rocking(a, block):
    """The same straight lines sampled twice as densely give the same answer."""
    fine = np.interp(np.arange(2 * a.size - 1) / 2, np.arange(a.size), a)
    first, second = solve_rock(block, Motion.from_arrays(a, 0.03)), solve_rock(block, Motion.from_arrays(fine, 0.015))
    assert first.outcome.overturned == second.outcome.overturned
    assert second.outcome.max_rotation_rad == pytest.approx(first.outcome.max_rotation_rad, rel=1e-7, abs=1e-13)
    if first.outcome.alpha_passed_s is not None:
        assert second.outcome.alpha_passed_s == pytest.approx(first.outcome.alpha_passed_s, abs=1e-8)


@subset
@given(shakings, blocks, st.floats(0.2, 2.0), st.booleans())
def test_rock_many_equals_single_runs(a, block, scale, vertical):
    """The short way gives the verdict and the ratio of the long one."""
    motion = Motion.from_arrays(a, 0.03, vertical=0.5 * a[::-1])
    scaled = Motion.from_arrays(scale * a, 0.03, vertical=scale * 0.5 * a[::-1])
    short, long = (
        rock_verdict(block, motion, scale=scale, options=RockOptions(vertical=vertical)),
        solve_rock(block, scaled, vertical=vertical).outcome,
    )
    assert short.overturned == long.overturned
    assert short.max_rotation_ratio == pytest.approx(long.max_rotation_ratio, rel=1e-9, abs=1e-15)


@subset
@given(shakings, blocks)
def test_motion_at_threshold_starts_no_rocking(a, block):
    """A motion scaled to the threshold itself does not start rocking: equality rests."""
    peak = float(np.abs(a).max())
    if peak == 0.0:
        return
    outcome = solve_rock(block, Motion.from_arrays(a / peak * block.rocking_threshold() * (1 - 1e-12), 0.03)).outcome
    assert outcome.rocks is outcome.overturned is False
    assert outcome.max_rotation_rad == outcome.impacts == 0
    assert outcome.max_friction_demand == pytest.approx(block.rocking_threshold() / G, rel=1e-9)
