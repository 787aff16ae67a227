"""Many runs at once are the single runs, bit by bit, whatever the threads."""

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import to_block_array
from seisblock.core.errors import ParameterError
from seisblock.models.respond import respond_many, respond_params, solve_respond
from seisblock.models.respond.constants import NEAR_JAM
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.params import RespondBatchParams
from seisblock.records import Motion
from tests.models.respond.cases import shaking

MOTION = shaking(9, 9.0, seconds=8.0)
SHORT = Motion(MOTION.acceleration[:, :500], MOTION.dt)

SCALARS = ("final_displacement_m", "max_displacement_m", "max_rotation_rad", "max_rotation_ratio", "slip_path_m", "impacts", "end_s")


def versions(n=40):
    """Return versions of a block that do all sorts of things."""
    rng = np.random.default_rng(3)
    blocks = [Block(0.35 * a, 0.9 * b, centroid_offset=0.05 * c) for a, b, c in rng.uniform(0.7, 1.3, (n, 3))]
    numbers = zip(blocks, rng.uniform(0.1, 0.9, n), rng.choice([0.0, 0.3], n), strict=True)
    return [(block, {"mu": mu, "restitution": e}) for block, mu, e in numbers]


@pytest.mark.parametrize(("motion", "settle_s"), [(MOTION, 60.0), (SHORT, 0.0), (SHORT, 0.4)], ids=["to rest", "no time", "little time"])
def test_respond_many_rows_equal_single_runs(motion, settle_s):
    """Verdict, displacements, leans, paths, impacts and times are equal to the last bit, also of runs that end in motion."""
    rows = versions()
    batch = respond_many([respond_params(block, RespondOptions(**options)) for block, options in rows], motion, settle_s=settle_s)
    assert 0 < batch.overturned.sum() < len(rows)
    assert batch.settled[~batch.overturned].all() == (motion is MOTION)
    for row, (block, options) in enumerate(rows):
        response = solve_respond(block, motion, sensitivity=False, settle_s=settle_s, **options)
        first = response.outcome
        assert batch.overturned[row] == first.overturned
        assert batch.settled[row] == first.settled
        assert batch.direction[row] == {"+x": 1, "-x": -1, None: 0}[first.overturned_towards]
        for name in SCALARS:
            assert getattr(batch, name)[row] == getattr(first, name), name
        assert batch.time_in_mode_s[row] == pytest.approx(list(first.time_in_mode_s.values()), abs=1e-9)
        flights = [phase.duration_s for phase in response.phases if phase.name == "flight"]
        assert batch.longest_flight_s[row] <= max(flights, default=0.0) + 1e-12


@pytest.mark.parametrize("up", [0.0, 14.0], ids=["level", "beyond 1 g upwards"])
def test_respond_many_rows_equal_single_runs_at_extreme_parameters(up):
    """Ice and glue, slivers and slabs, no rebound and almost all of it; records that end while they hop, and vertical motion beyond 1 g."""
    full = Motion(MOTION.acceleration * np.array([[1.0], [1.0], [up / np.abs(MOTION.vertical).max()]]), MOTION.dt)
    motion = Motion(full.acceleration[:, : full.samples // 2], full.dt)
    blocks = (Block(0.002, 1.0), Block(0.35, 0.9), Block(3.0, 0.5))
    rows = [(block, {"mu": mu, "restitution": e}) for block in blocks for mu in (0.01, 0.7, 100.0) for e in (0.0, 0.95)]
    batch = respond_many([respond_params(block, RespondOptions(**options)) for block, options in rows], motion, gains=(1.0, 0.0, 1.0))
    assert 0 < batch.overturned.sum() < len(rows)
    for row, (block, options) in enumerate(rows):
        first = solve_respond(block, motion, sensitivity=False, vertical=True, **options).outcome
        assert batch.overturned[row] == first.overturned
        for name in ("settled", *SCALARS):
            assert getattr(batch, name)[row] == getattr(first, name), (name, block.width, options)


@pytest.mark.parametrize("initial", [None, (0.0, 1.2, 0.0, 0.0, 0.0, 0.1)], ids=["upright", "thrown"])
def test_parameters_from_arrays_equal_scalar_parameters(initial):
    """Parameters and fates, jamming frictions and tenons among them, to the last bit."""
    rng, n = np.random.default_rng(8), 60
    blocks = [Block(0.35 * a, 0.9 * b, centroid_offset=0.05 * c) for a, b, c in rng.uniform(0.7, 1.3, (n, 3))]
    mu, kinetic, e = rng.uniform(0.8, 1.6, n), rng.uniform(0.2, 0.8, n), rng.uniform(0.0, 0.5, n)
    kinetic[::3] = mu[::3]
    subset = RespondBatchParams(to_block_array(blocks), mu, kinetic, e, np.ones(n), False, 9.81, 0.01)
    numbers = zip(blocks, mu.tolist(), kinetic.tolist(), e.tolist(), strict=True)
    items = [
        respond_params(block, options=RespondOptions(mu=m, mu_kinetic=k, restitution=r, gravity=9.81, tenon=0.01))
        for block, m, k, r in numbers
    ]
    for still in (False, True):
        table = subset.parameters(0.01, ground_at_rest=still)
        np.testing.assert_array_equal(table, [setting.parameters(0.01, ground_at_rest=still) for setting in items])
    assert 0.0 < table[:, NEAR_JAM].mean() < 1.0
    rows, single = (respond_many(arguments[:12], MOTION, initial=initial) for arguments in (subset, items))
    for name in vars(rows):
        np.testing.assert_array_equal(getattr(rows, name), getattr(single, name))


def test_invalid_row_raises_message_of_single_run():
    """The first invalid row gives the reason."""
    two = to_block_array([Block(0.3, 0.9), Block(0.3, 1.2)])
    for mu, kinetic, e, reason in (
        (-0.1, -0.2, 0.0, "friction coefficient mu"),
        (0.3, 0.4, 0.0, "must not exceed"),
        (0.3, 0.3, 1.0, "restitution"),
    ):
        with pytest.raises(ParameterError, match=reason):
            RespondBatchParams(two, np.array([0.5, mu]), np.array([0.5, kinetic]), np.array([0.0, e]), np.ones(2), False, 9.81, 0.0)


def test_respond_many_is_independent_of_thread_count():
    """One, two or seven threads give the same arrays."""
    settings = [respond_params(block, RespondOptions(**options)) for block, options in versions(15)]
    first, *rest = (respond_many(settings, MOTION, workers=workers) for workers in (1, 2, 7))
    for second in rest:
        for name in vars(first):
            np.testing.assert_array_equal(getattr(first, name), getattr(second, name))


def test_gains_rotate_and_scale_the_motion():
    """Factors on the rows along and across turn the motion by an angle, without a copy of it."""
    rng = np.random.default_rng(1)
    rows = np.array([MOTION.horizontal, np.roll(MOTION.horizontal, 40), MOTION.vertical])
    motion = Motion(rows, MOTION.dt)
    angles = rng.uniform(0.0, 2.0 * np.pi, 6)
    setting = respond_params(Block(0.4, 0.9), options=RespondOptions(mu=0.35))
    batch = respond_many([setting] * 6, motion, gains=np.stack([0.8 * np.cos(angles), 0.8 * np.sin(angles), np.full(6, 0.8)], axis=1))
    for row, angle in enumerate(angles):
        rotated = Motion.from_arrays(0.8 * np.cos(angle) * rows[0] + 0.8 * np.sin(angle) * rows[1], motion.dt, vertical=0.8 * rows[2])
        first = solve_respond(Block(0.4, 0.9), rotated, mu=0.35, sensitivity=False).outcome
        assert batch.overturned[row] == first.overturned
        assert batch.end_s[row] == pytest.approx(first.end_s, abs=1e-6)
        assert batch.final_displacement_m[row] == pytest.approx(first.final_displacement_m, abs=1e-6)


def test_respond_many_rejects_empty_input():
    """No row at all is refused."""
    with pytest.raises(ParameterError, match="one row"):
        respond_many([], MOTION)
