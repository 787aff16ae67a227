"""Points that are laid anew bear together what the old ones bore."""

import math

import numpy as np
import pytest

from seisblock.solvers.stack.contact import EARLIER, ENTERED, PLACE, PUSH, SLIDES, SLOT
from seisblock.solvers.stack.frames import BODY, Q, orient
from seisblock.solvers.stack.remember import gather, left, share_out


def faced(dice):
    """Return a body that has turned."""
    body = np.zeros(BODY)
    body[Q : Q + 4] = dice.normal(size=4)
    body[Q : Q + 4] /= np.linalg.norm(body[Q : Q + 4])
    orient(body)
    return body, body[16:25].reshape(3, 3)


def ring(count, radius, turn):
    """Return points on a rim, that remember nothing."""
    slots = np.zeros((16, SLOT))
    angles = turn + 2.0 * math.pi * np.arange(count) / count
    slots[:count, PLACE] = radius * np.cos(angles)
    slots[:count, PLACE + 1] = radius * np.sin(angles)
    return slots


def sums(slots, axes, field):
    """Return force and moment about the middle, in the partner's axes, of what points remember."""
    force = slots[:, field : field + 3] @ axes
    return force.sum(axis=0), np.cross(slots[:, PLACE : PLACE + 3], force).sum(axis=0)


@pytest.mark.parametrize("seed", range(20))
def test_force_moment_and_twist_remain(seed):
    """Of forces of both steps, whichever points there are, wherever a load presses among them."""
    dice = np.random.default_rng(seed)
    body, axes = faced(dice)
    old, new = ring(4, 0.3, dice.uniform(0.0, 6.28)), ring(int(dice.integers(4, 9)), 0.3, dice.uniform(0.0, 6.28))
    points = int(np.count_nonzero(np.hypot(new[:, PLACE], new[:, PLACE + 1])))
    old[:4, ENTERED] = 1.0
    old[2, SLIDES] = 1.0
    for field in (PUSH, EARLIER):
        force = np.column_stack([dice.normal(size=(4, 2)), dice.uniform(5.0, 10.0, 4)])
        old[:4, field : field + 3] = force @ axes.T
    loads = np.zeros((2, 18))
    assert gather(old, body, loads)
    assert share_out(points, new, loads, body)
    for field in (PUSH, EARLIER):
        for before, after in zip(sums(old, axes, field), sums(new, axes, field), strict=True):
            assert after == pytest.approx(before, abs=1e-12)
    assert np.all(new[:points, SLIDES] == 1.0) and np.all(new[:points, ENTERED] == 1.0)


def test_points_that_stay_keep_their_forces():
    """Only where one that bore something is left without one near it are forces shared out."""
    old, stays, turned = ring(4, 0.3, 0.0), ring(4, 0.3, 1e-4), ring(4, 0.3, 0.1)
    old[:4, ENTERED] = 1.0
    old[1, PUSH + 2] = 1.0
    assert not left(4, stays, old, 3e-4)
    assert left(4, turned, old, 3e-4)
    old[1, PUSH + 2] = 0.0
    assert not left(4, turned, old, 3e-4)


def test_two_points_cannot_share():
    """They, and points on one line, bear no moment across it; points on a rim that bore nothing have nothing to share."""
    body, _ = faced(np.random.default_rng(1))
    slots, loads = ring(2, 0.3, 0.0), np.zeros((2, 18))
    loads[0, 2] = loads[0, 6] = 1.0
    assert not share_out(2, slots, loads, body)
    assert not gather(slots, body, loads)
