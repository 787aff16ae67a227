"""Fates of many are those of single answers, to the last bit: blocks on springs and two-layer blocks, random ones under random shaking."""

import dataclasses

import numpy as np
import pytest

from seisblock.bodies.spring_block import SpringBlock
from seisblock.bodies.two_layer import Contact, TwoLayerBlock
from seisblock.core.errors import SolverError
from seisblock.models.jump import jump_many, solve_jump
from seisblock.models.jump.segments import chain_warnings
from seisblock.models.uplift import solve_uplift, uplift_many
from seisblock.models.uplift.model import parameters
from seisblock.models.uplift.outcome import warnings
from seisblock.records import Motion
from tests.models.uplift_motions import shaking


def springs(count):
    """Return blocks on springs, squat and slender, soft and stiff."""
    numbers = np.random.default_rng(5).uniform([0.4, 0.4, 0.6, 5.0, 0.5, 0.02], [1.2, 1.2, 2.0, 15.0, 1.5, 0.3], (count, 6))
    return [SpringBlock.from_frequency(a, b, h, frequency_vertical=f, beta=beta, damping=z) for a, b, h, f, beta, z in numbers]


def test_uplift_many_rows_equal_solve_uplift():
    """Every scalar of the outcome, and every warning."""
    motion = shaking(6.0, 0.01)
    motion = dataclasses.replace(motion, start_s=2.5)
    bodies = springs(6)
    result = uplift_many(bodies, motion)
    assert result.uplifts.sum() > 1 and (result.contact_changes > 50).any()
    for row, body in enumerate(bodies):
        first = solve_uplift(body, motion)
        for key, value in result.row_dict(row, motion.start_s).items():
            assert value == getattr(first.outcome, key), key
        assert warnings(motion, result, row) == first.warnings
        assert tuple(np.flatnonzero(result.first_corners[row]) + 1) == first.outcome.first_corners
        np.testing.assert_array_equal(
            result.time_on_corners_s[row] / result.time_on_corners_s[row].sum(), list(first.outcome.share_on_corners.values())
        )


def test_uplift_parameters_do_not_depend_on_the_other_bodies():
    """Propagators beside stiffer, softer, wider and narrower bodies: bit by bit those of the body alone."""
    bodies = [*springs(20), SpringBlock.from_frequency(2.5, 0.2, 0.1, frequency_vertical=30.0, beta=2.0, damping=0.5)]
    for dt in (0.005, 0.02):
        together = parameters(bodies, 9.80665, dt)
        np.testing.assert_array_equal(together, np.vstack([parameters([body], 9.80665, dt) for body in bodies]))


def test_uplift_many_lifts_above_uplift_scale_only():
    """A block uplifts above the reported scale factor and not below; a factor of two is exact."""
    (body,), motion = springs(1), shaking(6.0, 0.01)
    scale = solve_uplift(body, motion).outcome.uplift_scale
    factors = np.array([0.999, 1.001]) * scale
    result = uplift_many([body], motion, gains=np.outer([*factors, 2.0], [1.0, 1.0, 1.0]))
    assert result.uplifts.tolist() == [False, True, True]
    twice = solve_uplift(body, Motion(2.0 * motion.acceleration, motion.dt)).outcome
    assert result.row_dict(2, 0.0) == {key: getattr(twice, key) for key in result.row_dict(2, 0.0)}


def layered_blocks(count, seed=5):
    """Return narrow and wide two-layer blocks with smooth and rough contacts."""
    rng = np.random.default_rng(seed)
    sizes = rng.uniform([0.4, 0.6, 0.8, 300.0], [2.4, 1.1, 1.9, 1500.0], (count, 4))
    blocks = [TwoLayerBlock(w, 2.3, h, below, mass, 160.0) for w, h, below, mass in sizes]
    on = rng.uniform([0.1, 0.6, 0.5, 0.6], [4.0, 1.0, 1.0, 0.95], (count, 4))
    return blocks, [Contact(mu, mu * kinetic, ex, ey) for mu, kinetic, ex, ey in on]


def push_and_noise(samples):
    """Return a long push, and the shaking that follows it."""
    noise = shaking(10.0, 0.01, peaks=(9.0, 5.0, 3.0), seed=11).acceleration
    push = 5.0 * np.sin(np.pi * np.arange(120) / 120.0)
    return Motion(np.hstack([[push, 0.0 * push, 0.0 * push], noise])[:, :samples], 0.01, start_s=1.5)


@pytest.mark.parametrize(
    ("options", "samples", "fates"),
    [
        ({}, 1121, {2, 3}),
        ({}, 90, {0, 2, 3}),
        ({"landing": "friction"}, 1121, {2, 3}),
        ({"drop": 0.3, "direction": "-"}, 517, {0, 2}),
        ({"first": True, "spin": "ratio=0.75"}, 1121, {1, 2, 3}),
    ],
)
def test_jump_many_rows_equal_solve_jump(options, samples, fates):
    """Every scalar of the outcome, and every warning; of records that end in the middle of a chain, too, and of feet that jam."""
    blocks, contacts = layered_blocks(12)
    motion = push_and_noise(samples)
    result = jump_many(blocks, motion, contacts=contacts, **options)
    assert set(result.outcome_code.tolist()) == fates
    for row, (block, contact) in enumerate(zip(blocks, contacts, strict=True)):
        if result.jammed[row]:
            with pytest.raises(SolverError, match="jams"):
                solve_jump(block, motion, contact=contact, **options)
            continue
        first = solve_jump(block, motion, contact=contact, **options)
        for key, value in result.row_dict(row).items():
            assert value == getattr(first.outcome, key), key
        assert chain_warnings(motion, result.row_chains(row, motion.start_s), contact.mu) == first.warnings


def test_jump_many_rocks_above_threshold_factor_only():
    """It rocks above its threshold, and not below; a factor of two is exact."""
    (block,), (contact,) = layered_blocks(1)
    motion = shaking(10.0, 0.01, peaks=(9.0, 5.0, 3.0), seed=11)
    single = solve_jump(block, motion, contact=contact).outcome
    limit = single.rocking_threshold_m_s2 / np.abs(motion.horizontal).max()
    result = jump_many([block], motion, contacts=[contact], factors=[0.999 * limit, 1.001 * limit, 1.0, 2.0])
    assert (result.outcome_code > 0).tolist() == [False, True, True, True]
    twice = solve_jump(block, Motion(2.0 * motion.acceleration, motion.dt), contact=contact).outcome
    for row, first in ((2, single), (3, twice)):
        assert result.row_dict(row) == {key: getattr(first, key) for key in result.row_dict(row)}
