"""Two boxes that are apart are so along an axis; where they meet, their points lie on both."""

import math

import numpy as np
import pytest
from scipy.optimize import linprog
from scipy.spatial.transform import Rotation

from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.solvers.stack.apart import EDGES, FACE, KIND, MOST_POINTS, cross, furthest, overlap
from seisblock.solvers.stack.arrays import pile_arrays

PAIR = Pile("pair", (PileStone("low", 0.6, 0.4, 0.3), PileStone("high", 0.3, 0.5, 0.8, on="low")))
FAR = 100.0


def seen(turn, centre):
    """Return the upper stone, turned and moved, as the lower one sees it."""
    rel = np.zeros(18)
    rel[:9], rel[9:12] = turn.as_matrix().ravel(), centre
    return rel


def widest(pile, rel):
    axis = np.zeros(8)
    gap = furthest(rel, pile.boxes[1], pile.corners[1], pile.counts[1], pile.boxes[0], pile.corners[0], pile.counts[0], FAR, axis)
    return gap, axis


def corners_of(pile, rel):
    """Return the corners of the lower and of the upper stone in the axes of the lower one."""
    return pile.corners[0, : pile.counts[0]], pile.corners[1, : pile.counts[1]] @ rel[:9].reshape(3, 3).T + rel[9:12]


def places(count, seed):
    """Return how the upper stone may lie: anyhow, from deep inside the lower one to apart."""
    rng = np.random.default_rng(seed)
    turns = Rotation.random(count, rng)
    return [seen(turn, centre) for turn, centre in zip(turns, rng.uniform(-0.8, 0.8, (count, 3)), strict=True)]


def have_a_point_in_common(one, other):
    """Return whether the hulls of two sets of corners do, as weights of both that give one point."""
    sums = np.vstack(
        [np.hstack([one.T, -other.T]), np.r_[np.ones(len(one)), np.zeros(len(other))], np.r_[np.zeros(len(one)), np.ones(len(other))]]
    )
    return linprog(np.zeros(sums.shape[1]), A_eq=sums, b_eq=[0, 0, 0, 1, 1]).status == 0


@pytest.mark.kernel
@pytest.mark.parametrize("points", [2, 5])
def test_a_gap_is_that_of_the_corners_along_its_axis(points):
    """Of boxes with sharp and with worn faces, from inside each other to apart."""
    pile = pile_arrays(PAIR, None, points)
    for rel in places(20, 1):
        gap, axis = widest(pile, rel)
        low, high = corners_of(pile, rel)
        assert np.linalg.norm(axis[:3]) == pytest.approx(1.0, abs=1e-12)
        # a worn face is held by the plane of the whole one
        reached = (low @ axis[:3]).max() if axis[KIND] >= 3 or points == 2 else pile.boxes[0, int(axis[KIND])]
        assert gap <= (high @ axis[:3]).min() - reached + 1e-12
        if axis[KIND] < 3 or points == 2:
            assert gap == pytest.approx((high @ axis[:3]).min() - reached, abs=1e-12)


def test_boxes_without_a_gap_overlap_and_others_do_not():
    """The sign of the widest gap is what a linear programme finds of common points."""
    pile = pile_arrays(PAIR, None, 2)
    found = [(widest(pile, rel)[0] < 0.0, have_a_point_in_common(*corners_of(pile, rel))) for rel in places(60, 2)]
    assert all(overlapping == common for overlapping, common in found)
    assert 10 < sum(common for _, common in found) < 50


def test_a_box_that_just_touches_does_so_where_its_points_say():
    """Moved along the axis until the gap is closed, the points of the meeting are on the surfaces of both boxes, inside neither."""
    pile = pile_arrays(PAIR, None, 2)
    kinds, touched = set(), 0
    for rel in places(60, 3):
        gap, axis = widest(pile, rel)
        rel[9:12] -= gap * axis[:3]
        gap, axis = widest(pile, rel)
        kinds.add(min(int(axis[KIND]) // 3, 2))
        found = np.zeros((MOST_POINTS, 18))
        if axis[KIND] >= EDGES:
            points, gaps = (1, np.array([gap])) if cross(rel, pile.boxes[1], pile.boxes[0], axis, found[0]) else (0, np.zeros(0))
        else:
            view, spare = np.zeros(18), np.zeros((MOST_POINTS, 18))
            points = overlap(
                rel,
                pile.boxes[1],
                pile.corners[1],
                pile.edges[1],
                pile.boxes[0],
                pile.corners[0],
                pile.edges[0],
                axis[FACE:],
                view,
                found,
                spare,
            )
            gaps = found[:points, 3]
        touching = found[:points, :3][np.abs(gaps) < 1e-9]
        touched += len(touching) > 0
        if have_a_point_in_common(*corners_of(pile, rel)):
            assert len(touching)
        for y in touching:
            own = rel[:9].reshape(3, 3).T @ (y - rel[9:12])
            outside = (np.abs(y) - pile.boxes[0, :3]).max(), (np.abs(own) - pile.boxes[1, :3]).max()
            assert outside == pytest.approx((0.0, 0.0), abs=2e-5)
    assert kinds == {0, 1, 2}
    assert touched > 20


@pytest.mark.parametrize(("yaw", "count"), [(0.0, 4), (math.radians(45.0), 8)])
def test_a_stone_that_lies_flat_has_the_corners_of_what_both_faces_share(yaw, count):
    """Four where it lies along the other, eight where it is turned and each cuts the other's corners."""
    square = Pile("square", (PileStone("low", 0.4, 0.4, 0.2), PileStone("high", 0.4, 0.4, 0.2, on="low")))
    pile = pile_arrays(square, None, 2)
    rel = seen(Rotation.from_rotvec([0.0, 0.0, yaw]), [0.0, 0.0, 0.2])
    gap, axis = widest(pile, rel)
    assert gap == pytest.approx(0.0, abs=1e-12)
    found, spare, view = np.zeros((MOST_POINTS, 18)), np.zeros((MOST_POINTS, 18)), np.zeros(18)
    points = overlap(
        rel, pile.boxes[1], pile.corners[1], pile.edges[1], pile.boxes[0], pile.corners[0], pile.edges[0], axis[FACE:], view, found, spare
    )
    assert points == count
    np.testing.assert_allclose(found[:points, 2], 0.1, atol=1e-12)
    far = 0.2 * math.sqrt(2.0) if count == 4 else 0.2 / math.cos(math.pi / 8)
    np.testing.assert_allclose(np.hypot(found[:points, 0], found[:points, 1]), far, atol=2e-5)
