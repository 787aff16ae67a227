"""Verdicts of many runs at once are those of one run after another (H11)."""

import math

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import to_block_array
from seisblock.core.errors import ComponentError, KindError, ParameterError
from seisblock.dynamics import integrate_many
from seisblock.models.rock import rock_params, rock_verdict, rock_verdicts, solve_rock
from seisblock.models.rock.model import REST, parameters
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.params import RockBatchParams, rock_batch_params
from seisblock.models.rock.simd import ROCKING_SIMD_MODEL
from seisblock.models.rock.verdicts import rock_overturned
from seisblock.records import Component, Motion, Record, motion_of
from seisblock.studies.rocking.verdicts import overturns_at, parallel_verdicts

RNG = np.random.default_rng(5)
T = np.arange(1200) * 0.01
ROWS = [
    np.convolve(RNG.normal(size=T.size), np.hanning(40), "same") * 0.5 * size * np.exp(-(((T - 5.0) / 2.5) ** 2))
    for size in (1.0, 0.8, 0.4)
]
RECORD = Record(tuple(Component(code, row) for code, row in zip(("NS", "EW", "UD"), ROWS, strict=True)), 0.01)
MOTION = motion_of(RECORD, "NS")
BLOCKS = [Block(w, h, centroid_offset=0.1 * w * k) for w, h in ((0.2, 0.5), (0.24, 0.72), (0.3, 1.2)) for k in (-1, 0, 1)]
SCALES = (0.2, 0.8, 1.0, 1.3)
OPTIONS = [{}, {"vertical": 0.7}, {"linear": True, "restitution": 0.9}, {"gravity": 9.0, "restitution": (0.8, 0.95)}]


@pytest.mark.parametrize("options", OPTIONS, ids=str)
def test_rock_many_rows_equal_single_runs(options):
    """Several blocks under one gain, one block under several, and both: bit by bit the results of solve_rock."""
    rockers = [rock_params(block, MOTION, RockOptions(**options)) for block in BLOCKS]
    single = [solve_rock(block, MOTION, **options).outcome for block in BLOCKS]
    assert {outcome.overturned for outcome in single} == {False, True}
    together = rock_verdicts(rockers, MOTION, rockers[0].gains())
    assert together.overturned.tolist() == [outcome.overturned for outcome in single]
    np.testing.assert_array_equal(together.max_rotation_ratio, [outcome.max_rotation_ratio for outcome in single])
    first = rockers[4]
    scaled = rock_verdicts([first], MOTION, [first.gains(scale) for scale in SCALES])
    for scale, overturned, ratio in zip(SCALES, scaled.overturned, scaled.max_rotation_ratio, strict=True):
        result = rock_verdict(first.block, MOTION, scale=scale, options=RockOptions(**options))
        assert (result.overturned, result.max_rotation_ratio) == (overturned, ratio)
    np.testing.assert_array_equal(scaled.overturned, overturns_at(first, MOTION, SCALES))


def test_rock_many_with_block_array_equals_blocks():
    """Blocks that were never objects have the verdicts of those that were, on a record that ends while some of them still rock."""
    motion = motion_of(Record(tuple(Component(c.code, c.acceleration[:530]) for c in RECORD.components), 0.01), "NS")
    arrays = rock_batch_params(to_block_array(BLOCKS), motion, options=RockOptions(vertical=True))
    result = rock_verdicts(arrays, motion, arrays.gains(1.2))
    scaled = Motion(1.2 * motion.acceleration, 0.01)
    single = [solve_rock(block, scaled, vertical=True).outcome for block in BLOCKS]
    assert any(outcome.decided_after_record for outcome in single)
    assert result.overturned.tolist() == [outcome.overturned for outcome in single]
    np.testing.assert_allclose(result.max_rotation_ratio, [outcome.max_rotation_ratio for outcome in single], rtol=1e-9)
    verdicts = [rock_verdict(block, motion, scale=1.2, options=RockOptions(vertical=True)) for block in BLOCKS]
    assert [verdict.overturned for verdict in verdicts] == result.overturned.tolist()
    assert [verdict.max_rotation_ratio for verdict in verdicts] == result.max_rotation_ratio.tolist()


def test_rock_verdict_needs_no_loop_over_rows(monkeypatch):
    """The first run of `respond` would compile that loop for its comparison of models alone."""
    monkeypatch.setattr("seisblock.dynamics.ensemble.integrate_rows", None)
    assert not rock_verdict(BLOCKS[0], MOTION, scale=0.1).overturned


def test_rock_many_in_threads_keeps_order():
    """More runs than a thread takes at once come back as they were asked for, and progress reaches the end."""
    collected = []
    rockers = [rock_params(BLOCKS[i % len(BLOCKS)], MOTION) for i in range(100)]
    result = parallel_verdicts(rockers, MOTION, rockers[0].gains(), progress=lambda completed, runs: collected.append((completed, runs)))
    first = rock_verdicts(rockers[: len(BLOCKS)], MOTION, rockers[0].gains())
    for i in range(100):
        assert result.max_rotation_ratio[i] == first.max_rotation_ratio[i % len(BLOCKS)]
    assert collected[-1] == (100, 100) and [done for done, _ in collected] == sorted(done for done, _ in collected)


@pytest.mark.parametrize("azimuth", [0.0, 37.0, 90.0, 200.0])
def test_gains_rotate_the_motion(azimuth):
    """Cos and -sin on the rows along and across are the record turned clockwise, also while the block is at rest."""
    angle = math.radians(azimuth)
    for options in ({}, {"vertical": True}):
        first = rock_params(BLOCKS[1], MOTION, RockOptions(**options))
        rotated = rock_verdicts([first], MOTION, (math.cos(angle), -math.sin(angle), first.vertical))
        second = solve_rock(first.block, motion_of(RECORD, f"{azimuth:g}"), **options).outcome
        assert rotated.overturned[0] == second.overturned
        assert rotated.max_rotation_ratio[0] == pytest.approx(second.max_rotation_ratio, rel=1e-9)


def test_rock_many_rejects_invalid_input_like_single_run():
    """The same sentences as of a single run."""
    level = Motion(MOTION.acceleration, 0.01, record=Record(RECORD.components[:2], 0.01))
    for call, error in (
        (lambda: rock_params(BLOCKS[0], RECORD), KindError),
        (lambda: rock_params(BLOCKS[0], level, options=RockOptions(vertical=True)), ComponentError),
        (lambda: rock_params(BLOCKS[0], MOTION, options=RockOptions(restitution=1.1)), ParameterError),
        (lambda: rock_params(BLOCKS[0], MOTION, options=RockOptions(gravity=0.0)), ParameterError),
    ):
        with pytest.raises(error):
            call()


def test_rock_verdicts_without_short_hops_are_equal():
    """Most impacts of a weakly shaken block follow each other within 1 ms: without them at least 98 % of the verdicts are the same."""
    blocks = to_block_array([Block(0.2, height) for height in np.linspace(0.6, 1.4, 100)])
    params = rock_batch_params(blocks, MOTION, options=RockOptions(restitution=0.97))
    full, short = (rock_verdicts(params, MOTION, (0.6, 0.0, 0.0), **how) for how in ({}, {"min_hop": 1e-3}))
    assert full.overturned.any() and not full.overturned.all()
    assert (full.overturned == short.overturned).mean() >= 0.98
    np.testing.assert_allclose(np.median(short.max_rotation_ratio), np.median(full.max_rotation_ratio), rtol=1e-3)
    events = [
        integrate_many(ROCKING_SIMD_MODEL, MOTION, parameters(params, MOTION.dt, *hop), np.zeros(2), REST, gains=(0.6, 0.0, 0.0)).n_events
        for hop in ((), (1e-3,))
    ]
    assert events[1].sum() < 0.6 * events[0].sum()


def test_runs_that_end_early_overturn_as_whole_ones():
    """Two unequal corners, three rows of motion, at whose end the shaking is over or strong."""
    rng = np.random.default_rng(11)
    time = 0.01 * np.arange(3000)
    overturned = 0
    for centre, length in ((8.0, 4.0), (20.0, 6.0), (30.0, 10.0)):
        rows = np.array([np.convolve(rng.normal(size=time.size), np.hanning(25), "same") for _ in range(3)])
        rows *= np.exp(-(((time - centre) / length) ** 2)) * np.array([[1.0], [0.7], [0.5]]) * 6.0 / np.abs(rows[0]).max()
        motion = Motion(rows, 0.01)
        alphas = rng.uniform(0.1, 0.35, (300, 1)) * rng.uniform(0.8, 1.2, (300, 2))
        levers = rng.uniform(0.3, 3.0, (300, 1)) * rng.uniform(0.8, 1.2, (300, 2))
        params = RockBatchParams(alphas, levers, 1.0 - 1.2 * np.sin(alphas) ** 2, False, 1.0, 9.80665)
        azimuths = rng.uniform(-0.5, 0.5, 300)
        gains = np.column_stack([np.cos(azimuths), -np.sin(azimuths), np.ones(300)])
        expected = rock_verdicts(params, motion, gains).overturned
        assert np.array_equal(rock_overturned(params, motion, gains), expected)
        overturned += int(expected.sum())
    assert 200 < overturned < 700


def test_runs_that_end_early_overturn_as_whole_ones_near_the_bound():
    """Short strong pulses of either sign, which give a block nearly all of the energy that the bound allows, some of it beyond alpha."""
    rng = np.random.default_rng(12)
    overturned = 0
    for _ in range(20):
        row = np.zeros(1500)
        for start in (200, *range(300, 1400, 60)):
            row[start : start + 5] = rng.choice([-1.0, 1.0]) * rng.uniform(1.0, 3.0) * (6.0 if start == 200 else 1.5)
        motion = Motion.from_arrays(row, 0.01)
        alphas, levers = np.full((300, 2), 0.15), rng.uniform(0.02, 1.0, (300, 1)) ** 2 * 20.0 * np.ones(2)
        params = RockBatchParams(alphas, levers, np.full((300, 2), 0.95), False, 0.0, 9.80665)
        expected = rock_verdicts(params, motion, np.eye(3)[:1]).overturned
        assert np.array_equal(rock_overturned(params, motion, np.tile([1.0, 0.0, 0.0], (300, 1))), expected)
        overturned += int(expected.sum())
    assert 1000 < overturned < 5600
