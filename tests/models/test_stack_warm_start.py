"""Points that are laid anew bear together what the old ones bore."""

import math

import numpy as np
import pytest

from seisblock.models.stack.constraint_row import ARM_B, GAP, IMPULSE, NORMAL, ROW_COLUMNS
from seisblock.models.stack.frames import BODY, Q, update_rotation_matrix
from seisblock.models.stack.spring_contact import ACTIVE, CACHED_FORCE, CACHED_SLIDING, POSITION, PREVIOUS_FORCE, SLOT
from seisblock.models.stack.warm_start import distribute_load, has_lost_loaded_point, project_to_plane, sum_joint_load


def rotated_body(rng):
    """Return a body that has turned."""
    body = np.zeros(BODY)
    body[Q : Q + 4] = rng.normal(size=4)
    body[Q : Q + 4] /= np.linalg.norm(body[Q : Q + 4])
    update_rotation_matrix(body)
    return body, body[16:25].reshape(3, 3)


def rim_points(count, radius, turn):
    """Return points on a rim, that remember nothing."""
    slots = np.zeros((16, SLOT))
    angles = turn + 2.0 * math.pi * np.arange(count) / count
    slots[:count, POSITION] = radius * np.cos(angles)
    slots[:count, POSITION + 1] = radius * np.sin(angles)
    return slots


def force_and_moment(slots, axes, field):
    """Return force and moment about the middle, in the partner's axes, of what points remember."""
    force = slots[:, field : field + 3] @ axes
    return force.sum(axis=0), np.cross(slots[:, POSITION : POSITION + 3], force).sum(axis=0)


@pytest.mark.parametrize("seed", range(20))
def test_warm_start_preserves_force_moment_and_twist(seed):
    """Of forces of both steps, whichever points there are, wherever a load presses among them."""
    rng = np.random.default_rng(seed)
    body, axes = rotated_body(rng)
    old, new = rim_points(4, 0.3, rng.uniform(0.0, 6.28)), rim_points(int(rng.integers(4, 9)), 0.3, rng.uniform(0.0, 6.28))
    points = int(np.count_nonzero(np.hypot(new[:, POSITION], new[:, POSITION + 1])))
    old[:4, ACTIVE] = 1.0
    old[2, CACHED_SLIDING] = 1.0
    for field in (CACHED_FORCE, PREVIOUS_FORCE):
        force = np.column_stack([rng.normal(size=(4, 2)), rng.uniform(5.0, 10.0, 4)])
        old[:4, field : field + 3] = force @ axes.T
    loads = np.zeros((2, 18))
    assert sum_joint_load(old, body, loads)
    assert distribute_load(points, new, loads, body)
    for field in (CACHED_FORCE, PREVIOUS_FORCE):
        for before, after in zip(force_and_moment(old, axes, field), force_and_moment(new, axes, field), strict=True):
            assert after == pytest.approx(before, abs=1e-12)
    assert np.all(new[:points, CACHED_SLIDING] == 1.0) and np.all(new[:points, ACTIVE] == 1.0)


def test_matched_points_keep_their_forces():
    """Only where one that bore something is left without one near it are forces shared out."""
    old, stays, rotated = rim_points(4, 0.3, 0.0), rim_points(4, 0.3, 1e-4), rim_points(4, 0.3, 0.1)
    old[:4, ACTIVE] = 1.0
    old[1, CACHED_FORCE + 2] = 1.0
    assert not has_lost_loaded_point(4, stays, old, 3e-4)
    assert has_lost_loaded_point(4, rotated, old, 3e-4)
    old[1, CACHED_FORCE + 2] = 0.0
    assert not has_lost_loaded_point(4, rotated, old, 3e-4)


def test_two_or_collinear_points_get_no_distributed_load():
    """They, and points on one line, bear no moment across it; points on a rim that bore nothing have nothing to share."""
    body, _ = rotated_body(np.random.default_rng(1))
    slots, loads = rim_points(2, 0.3, 0.0), np.zeros((2, 18))
    loads[0, 2] = loads[0, 6] = 1.0
    assert not distribute_load(2, slots, loads, body)
    assert not sum_joint_load(slots, body, loads)


@pytest.mark.kernel
def test_normal_impulses_of_a_flat_joint_move_to_a_plane():
    """The plane of least squares where no point pulls, else on the way to it as far as none does; load and friction are unchanged."""
    rng, ends = np.random.default_rng(5), set()
    for _ in range(20):
        _, axes = rotated_body(rng)
        count = int(rng.integers(4, 9))
        points, pressing = rng.normal(size=(count, 2)), rng.uniform(0.0, 1.0, count) ** 3
        friction = 0.1 * rng.normal(size=(count, 2))
        table = np.zeros((count + 1, ROW_COLUMNS))
        table[:, NORMAL : NORMAL + 3] = axes[:, 2]
        table[1:, ARM_B : ARM_B + 3] = np.column_stack([points, np.full(count, 0.3)]) @ axes.T
        table[1:, IMPULSE : IMPULSE + 3] = np.column_stack([friction, pressing]) @ axes.T
        # an open point leaves the distribution alone
        table[count, GAP] = 2.0
        before = table.copy()
        project_to_plane(1, count + 1, 1.0, table)
        np.testing.assert_array_equal(table, before)
        table[count, GAP] = 0.5
        project_to_plane(1, count + 1, 1.0, table)
        after = table[1:, IMPULSE : IMPULSE + 3] @ axes
        basis = np.column_stack([np.ones(count), points])
        plane = basis @ np.linalg.lstsq(basis, pressing, rcond=None)[0]
        np.testing.assert_allclose(after[:, :2], friction, atol=1e-12)
        np.testing.assert_allclose(basis.T @ after[:, 2], basis.T @ pressing, atol=1e-12)
        changes, limits = plane - pressing, np.where(plane < 0.0, pressing / np.maximum(pressing - plane, 1e-300), 1.0)
        np.testing.assert_allclose(after[:, 2], pressing + limits.min() * changes, atol=1e-12)
        ends.add(bool(limits.min() < 1.0))
    assert ends == {False, True}
