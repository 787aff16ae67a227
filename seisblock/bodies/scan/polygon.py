"""Convex polygons in the plane: the hull of points, how far it reaches in a direction, and what is left within worn edges."""

from __future__ import annotations

import math

import numpy as np

from seisblock.typing import ArrayLike, FloatArray, IntArray

AT_A_TIME = 2**13
"""Points that are looked at at a time."""

MANY, COARSE = 5000, 64
"""Of more points than the first, those that lie inside the hull of the furthest in so many directions are left out at once."""

FLAT = 1e-6
"""Share of a polygon's size by which a corner of it stands out from the line between its neighbours at least."""


def hull(points: ArrayLike) -> FloatArray:
    """Return the corners of the convex hull of some points, (n, 2), m, counter-clockwise; two points where it has no inside.

    Corners that stand out by less than a millionth of its size are left out.

    Parameters
    ----------
    points : (m, 2) array, m

    Examples
    --------
    >>> hull([(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0), (1.0, 0.5)]).tolist()
    [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]
    """
    from scipy.spatial import ConvexHull, QhullError

    given = np.atleast_2d(np.asarray(points, dtype=np.float64))
    if len(given) > MANY:
        coarse = given[_furthest(given, COARSE)]
        given = np.concatenate([coarse, _outside(given, coarse)])
    try:
        corners = given[ConvexHull(given).vertices]
    except QhullError:  # all on a line, or too few
        return given[:2]
    return _without_flat(corners)


def _without_flat(corners: FloatArray) -> FloatArray:
    """Return a polygon without the corners that hardly stand out from the line between their neighbours."""
    least = FLAT * float(np.ptp(corners, axis=0).max())
    while len(corners) > 3:
        before, after = np.roll(corners, 1, axis=0), np.roll(corners, -1, axis=0)
        chord, arm = after - before, corners - before
        height = np.abs(chord[:, 0] * arm[:, 1] - chord[:, 1] * arm[:, 0]) / np.linalg.norm(chord, axis=1)
        flat = height < least
        # of two neighbours one at a time: those with an even number first
        even = flat & (np.arange(len(corners)) % 2 == 0)
        flat = even if even.any() else flat
        if not flat.any() or len(corners) - int(flat.sum()) < 3:
            break
        corners = corners[~flat]
    return corners


def _furthest(points: FloatArray, directions: int) -> IntArray:
    """Return which points reach furthest in directions all around, counter-clockwise, each once."""
    turn = 2.0 * math.pi / directions * np.arange(directions)
    towards = np.stack([np.cos(turn), np.sin(turn)])
    best, chosen = np.full(directions, -np.inf), np.zeros(directions, dtype=np.int64)
    for begin in range(0, len(points), AT_A_TIME):
        far = points[begin : begin + AT_A_TIME] @ towards
        at = far.argmax(axis=0)
        found = far[at, np.arange(directions)]
        chosen, best = np.where(found > best, begin + at, chosen), np.maximum(found, best)
    return chosen[chosen != np.roll(chosen, 1)]


def _outside(points: FloatArray, corners: FloatArray) -> FloatArray:
    """Return the points outside a polygon of some of them: no other but its own is a corner of their hull."""
    along = np.roll(corners, -1, axis=0) - corners
    outwards = np.stack([along[:, 1], -along[:, 0]])
    limits = np.einsum("ij,ji->i", corners, outwards)
    kept = [(piece @ outwards >= limits).any(axis=1) for piece in np.array_split(points, -(-len(points) // AT_A_TIME))]
    return points[np.concatenate(kept)]


def reach(polygon: FloatArray, towards: ArrayLike) -> float:
    """Return how far a polygon reaches from the origin in a direction, a unit vector, m.

    Examples
    --------
    >>> reach(np.array([(1.0, 0.0), (0.0, 2.0), (-1.0, 0.0)]), (0.0, 1.0))
    2.0
    """
    return float((polygon @ np.asarray(towards, dtype=np.float64)).max())


def shrunk(polygon: FloatArray, by: float) -> FloatArray:
    """Return what is left of a convex polygon when each of its sides moves inwards, (k, 2), m; nothing, (0, 2), where none is.

    What is left is the set of points that lie at least so far from each side: the polygon cut by each side's line, moved by its normal
    (derived here). A corner of angle phi moves by more than its sides do, by/sin(phi/2) (derived here).

    Parameters
    ----------
    polygon : (n, 2) array, m
        Counter-clockwise.
    by : float, m
        Zero or more.

    Examples
    --------
    >>> shrunk(hull([(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)]), 0.25).round(9).tolist()
    [[0.25, 0.25], [1.75, 0.25], [1.75, 0.75], [0.25, 0.75]]
    """
    left = polygon
    if by == 0.0:
        return left
    along = np.roll(polygon, -1, axis=0) - polygon
    outwards = np.column_stack([along[:, 1], -along[:, 0]]) / np.linalg.norm(along, axis=1)[:, None]
    for normal, corner in zip(outwards, polygon, strict=True):
        beyond = (left - corner) @ normal + by
        if (beyond > 0.0).all():
            return np.empty((0, 2))
        if (beyond > 0.0).any():
            left = _cut(left, beyond)
    return left


def _cut(polygon: FloatArray, beyond: FloatArray) -> FloatArray:
    """Return the part of a polygon on one side of a line, from how far each corner lies beyond it."""
    after, then = np.roll(polygon, -1, axis=0), np.roll(beyond, -1)
    crosses = (beyond > 0.0) != (then > 0.0)
    share = np.where(crosses, beyond / np.where(crosses, beyond - then, 1.0), 0.0)
    # each corner that stays, and behind it where its side crosses the line
    both = np.stack([polygon, polygon + share[:, None] * (after - polygon)], axis=1).reshape(-1, 2)
    return both[np.column_stack([beyond <= 0.0, crosses]).ravel()]


def depth_within(polygon: FloatArray, point: ArrayLike) -> float:
    """Return how far a point lies inside a convex polygon from its nearest side, m; negative outside, -inf where there is no inside.

    Examples
    --------
    >>> depth_within(hull([(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)]), (0.25, 0.5))
    0.25
    """
    if len(polygon) < 3:
        return -math.inf
    along = np.roll(polygon, -1, axis=0) - polygon
    inwards = np.column_stack([-along[:, 1], along[:, 0]]) / np.linalg.norm(along, axis=1)[:, None]
    return float(np.einsum("ij,ij->i", np.asarray(point, dtype=np.float64) - polygon, inwards).min())


def nearest_side(polygon: FloatArray, point: ArrayLike) -> tuple[float, float]:
    """Return how far a point lies inside a convex polygon from its nearest side, m, and the direction in which that looks, rad from x.

    Examples
    --------
    >>> nearest_side(hull([(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)]), (1.75, 0.5))
    (0.25, 0.0)
    """
    along = np.roll(polygon, -1, axis=0) - polygon
    outwards = np.column_stack([along[:, 1], -along[:, 0]]) / np.linalg.norm(along, axis=1)[:, None]
    away = np.einsum("ij,ij->i", polygon - np.asarray(point, dtype=np.float64), outwards)
    least = int(np.argmin(away))
    return float(away[least]), math.atan2(*(outwards[least, ::-1] + 0.0))


def least_width(polygon: FloatArray) -> float:
    """Return the least distance between two parallel lines that hold a convex polygon between them, m: one of them lies along a side.

    Examples
    --------
    >>> least_width(hull([(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)]))
    1.0
    """
    along = np.roll(polygon, -1, axis=0) - polygon
    inwards = np.column_stack([-along[:, 1], along[:, 0]]) / np.linalg.norm(along, axis=1)[:, None]
    return float((np.einsum("kj,ij->ik", polygon, inwards) - np.einsum("ij,ij->i", polygon, inwards)[:, None]).max(axis=1).min())
