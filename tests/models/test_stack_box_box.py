"""Separated boxes have a separating axis; contact points are on both boxes."""

import math

import numpy as np
import pytest
from scipy.optimize import linprog
from scipy.spatial.transform import Rotation

from seisblock.bodies.edge_wear import EdgeWear
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.models.stack.arrays import pile_arrays
from seisblock.models.stack.box_box import CARRIER_FACES, EDGE_EDGE, KIND
from seisblock.models.stack.chamfered_faces import MAX_CHAMFERED_POINTS, _incident_face
from seisblock.models.stack.hull_pairs import edges_cross, faces_overlap, gap_between
from seisblock.models.stack.step import SCRATCH_ROWS

DISTANT = 100.0


def pair(share):
    """Return a stone on a larger one, worn where they stand, as arrays; the upper one is worn on both its faces, as it carries a lid."""
    stones = (
        PileStone("low", 0.6, 0.4, 0.3, inset=EdgeWear(share=share)),
        PileStone("high", 0.3, 0.5, 0.8, on="low", inset=EdgeWear(share=share)),
        PileStone("lid", 0.7, 0.6, 0.1, on="high", inset=EdgeWear(share=share)),
    )
    return pile_arrays(Pile("pair", stones), None, 2)


SHARES = [0.0, 0.05, 0.3]


def relative_pose(turn, centre):
    """Return the upper stone, turned and moved, as the lower one sees it."""
    rel = np.zeros(18)
    rel[:9], rel[9:12] = turn.as_matrix().ravel(), centre
    return rel


def widest(pile, rel):
    axis = np.zeros(8)
    return gap_between(rel, 1, 0, DISTANT, pile.layout, np.zeros((SCRATCH_ROWS, 18)), axis), axis


def contact_points(pile, rel, gap, axis):
    """Return where both stones may touch, and the gaps there."""
    result, spare, work = np.zeros((MAX_CHAMFERED_POINTS, 18)), np.zeros((MAX_CHAMFERED_POINTS, 18)), np.zeros((SCRATCH_ROWS, 18))
    if axis[KIND] >= EDGE_EDGE:
        points = int(edges_cross(rel, 1, 0, pile.layout, axis, work, result[0]))
        return result[:points, :3], np.full(points, gap)
    points = faces_overlap(rel, 1, 0, pile.layout, axis, work, 0.0, result, spare)
    return result[:points, :3], result[:points, 3]


def corners_of(pile, rel):
    """Return the corners of the lower and of the upper stone in the axes of the lower one."""
    return pile.corners[0, : pile.counts[0], :3], pile.corners[1, : pile.counts[1], :3] @ rel[:9].reshape(3, 3).T + rel[9:12]


def random_poses(count, seed):
    """Return how the upper stone may lie: anyhow, from deep inside the lower one to apart."""
    rng = np.random.default_rng(seed)
    turns = Rotation.random(count, rng)
    return [relative_pose(turn, centre) for turn, centre in zip(turns, rng.uniform(-0.8, 0.8, (count, 3)), strict=True)]


def hulls_intersect(first, second):
    """Return whether the hulls of two sets of corners do, as weights of both that give one point."""
    sums = np.vstack(
        [
            np.hstack([first.T, -second.T]),
            np.r_[np.ones(len(first)), np.zeros(len(second))],
            np.r_[np.zeros(len(first)), np.ones(len(second))],
        ]
    )
    return linprog(np.zeros(sums.shape[1]), A_eq=sums, b_eq=[0, 0, 0, 1, 1]).status == 0


def distance_outside(planes, y):
    """Return the distance of a point beyond the outermost of some faces."""
    return (planes[:, :3] @ y - planes[:, 3]).max()


def face_planes(pile, box):
    """Return the faces' planes of a box."""
    return pile.corners[box, : pile.counts[box] - 2, 3:]


@pytest.mark.parametrize("share", SHARES)
def test_box_planes_enclose_all_corners(share):
    """Every corner is on three faces, four at the ends of bevels, and inside all others: the planes enclose the hull of the corners."""
    pile = pair(share)
    assert pile.counts[:3].tolist() == ([8, 8, 8] if share == 0.0 else [12, 16, 8])
    for box in range(2):
        beyond = pile.corners[box, : pile.counts[box], :3] @ face_planes(pile, box)[:, :3].T - face_planes(pile, box)[:, 3]
        assert beyond.max() < 1e-12
        assert np.sum(np.abs(beyond) < 1e-12, axis=1).tolist() == [3] * 8 + [4] * (pile.counts[box] - 8)
        np.testing.assert_allclose(np.linalg.norm(face_planes(pile, box)[:, :3], axis=1), 1.0, atol=1e-12)


@pytest.mark.kernel
@pytest.mark.parametrize("share", SHARES)
def test_gap_equals_corner_projections_along_axis(share):
    """Of boxes with sharp and with worn faces, from inside each other to apart."""
    pile = pair(share)
    for rel in random_poses(20, 1):
        gap, axis = widest(pile, rel)
        low, high = corners_of(pile, rel)
        assert np.linalg.norm(axis[:3]) == pytest.approx(1.0, abs=1e-12)
        assert gap == pytest.approx((high @ axis[:3]).min() - (low @ axis[:3]).max(), abs=1e-12)


@pytest.mark.parametrize("share", SHARES)
def test_separating_axis_sign_matches_linear_programme(share):
    """The sign of the widest gap is what a linear programme finds of common points."""
    pile = pair(share)
    result = [(widest(pile, rel)[0] < 0.0, hulls_intersect(*corners_of(pile, rel))) for rel in random_poses(60, 2)]
    assert all(overlapping == common for overlapping, common in result)
    assert 10 < sum(common for _, common in result) < 50


@pytest.mark.parametrize("share", SHARES[1:])
def test_chamfered_boxes_touch_at_widest_gap(share):
    """A tenth of a millimetre apart along the widest gap they have no point in common; a tenth deeper they may."""
    pile, deeper = pair(share), 0
    for rel in random_poses(60, 7):
        gap, axis = widest(pile, rel)
        rel[9:12] -= (gap - 1e-4) * axis[:3]
        assert widest(pile, rel)[0] > 0.0
        assert not hulls_intersect(*corners_of(pile, rel))
        rel[9:12] -= 2e-4 * axis[:3]
        common = hulls_intersect(*corners_of(pile, rel))
        assert common == (widest(pile, rel)[0] < 0.0)
        deeper += common
    assert deeper > 30


@pytest.mark.parametrize("share", SHARES)
def test_touching_boxes_have_contact_points_on_both_surfaces(share):
    """Moved along the axis until the gap is closed, the points of the meeting are on the surfaces of both boxes, inside neither."""
    pile = pair(share)
    kinds, touched = set(), 0
    for rel in random_poses(60, 3):
        gap, axis = widest(pile, rel)
        rel[9:12] -= gap * axis[:3]
        gap, axis = widest(pile, rel)
        kinds.add("edges" if axis[KIND] >= EDGE_EDGE else "carrier" if axis[KIND] >= CARRIER_FACES else "partner")
        points, gaps = contact_points(pile, rel, gap, axis)
        touching = points[np.abs(gaps) < 1e-9]
        touched += len(touching) > 0
        if hulls_intersect(*corners_of(pile, rel)):
            assert len(touching)
        for y in touching:
            body_value = rel[:9].reshape(3, 3).T @ (y - rel[9:12])
            assert (distance_outside(face_planes(pile, 0), y), distance_outside(face_planes(pile, 1), body_value)) == pytest.approx(
                (0.0, 0.0), abs=2e-5
            )
    assert kinds == {"partner", "carrier", "edges"}
    assert touched > 20


@pytest.mark.parametrize(
    ("share", "turn", "centre"),
    [
        (0.0, (-0.247874, 0.0070256, -0.1708199), (-0.4771024, 0.0836632, 0.327774)),
        (0.05, (-1.1059369, -2.6752021, -0.8585151), (0.5690352, 0.4474589, -0.4142759)),
        (0.3, (-0.0316436, -0.0334075, -0.0105271), (0.3155713, 0.3392603, -0.4483164)),
    ],
)
def test_edge_edge_contact_prefers_pair_that_crosses(share, turn, centre):
    """Along two pairs of edges the gaps differed by less than faces are favoured by: the first was taken, and no point found there."""
    pile, rel = pair(share), relative_pose(Rotation.from_rotvec(turn), centre)
    gap, axis = widest(pile, rel)
    assert axis[KIND] >= EDGE_EDGE
    assert gap < -9e-4
    points, _ = contact_points(pile, rel, gap, axis)
    assert len(points) == 1


@pytest.mark.parametrize("share", SHARES)
def test_edges_of_least_overlap_cross(share):
    """The least way out of an overlap is out of a face of the difference of both bodies: there the edges cross (derived)."""
    pile, crossed = pair(share), 0
    for rel in random_poses(1500, 8):
        gap, axis = widest(pile, rel)
        rel[9:12] -= (gap + 2e-3) * axis[:3]
        gap, axis = widest(pile, rel)
        if gap < 0.0 and axis[KIND] >= EDGE_EDGE:
            assert len(contact_points(pile, rel, gap, axis)[0]) == 1
            crossed += 1
    assert crossed > 300


@pytest.mark.parametrize(("yaw", "count"), [(0.0, 4), (math.radians(45.0), 8)])
def test_flat_boxes_have_contacts_at_corners_of_face_overlap(yaw, count):
    """Four contact points for aligned boxes, eight for rotated ones that cut each other's corners."""
    square = Pile("square", (PileStone("low", 0.4, 0.4, 0.2), PileStone("high", 0.4, 0.4, 0.2, on="low")))
    pile = pile_arrays(square, None, 2)
    rel = relative_pose(Rotation.from_rotvec([0.0, 0.0, yaw]), [0.0, 0.0, 0.2])
    gap, axis = widest(pile, rel)
    assert gap == pytest.approx(0.0, abs=1e-12)
    points, _ = contact_points(pile, rel, gap, axis)
    assert len(points) == count
    np.testing.assert_allclose(points[:, 2], 0.1, atol=1e-12)
    distant = 0.2 * math.sqrt(2.0) if count == 4 else 0.2 / math.cos(math.pi / 8)
    np.testing.assert_allclose(np.hypot(points[:, 0], points[:, 1]), distant, atol=2e-5)


@pytest.mark.kernel
@pytest.mark.parametrize("share", SHARES)
def test_incident_face_is_the_most_opposed_face_at_the_deepest_corner(share):
    """Of either stone, in the axes of the lower one."""
    pile = pair(share)
    directions = Rotation.random(20, np.random.default_rng(7)).as_matrix()[:, 0]
    for rel, down in zip(random_poses(20, 6), directions, strict=True):
        turn = rel[:9].reshape(3, 3)
        for box, corners, matrix in zip((0, 1), corners_of(pile, rel), (np.eye(3), turn), strict=True):
            planes = face_planes(pile, box)
            deepest = (corners @ down).argmax()
            is_at_corner = np.abs(planes[:, :3] @ pile.corners[box, deepest, :3] - planes[:, 3]) < 1e-12
            expected = np.where(is_at_corner, (planes[:, :3] @ matrix.T) @ down, -np.inf).argmax()
            assert _incident_face(rel, box == 1, down, pile.corners[box], pile.counts[box], np.zeros(3)) == expected
