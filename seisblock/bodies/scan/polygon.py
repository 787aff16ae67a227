"""Convex polygons in the plane: the hull of points, how far it reaches in a direction, and what is left within worn edges."""

from __future__ import annotations

import math

import numpy as np

from seisblock.typing import ArrayLike, FloatArray

DIRECTIONS = 1440
"""A hull keeps the corners that reach furthest in one of so many directions: others change its reach by less than 3e-6 of its size."""

AT_A_TIME = 2**15
"""Points that are looked at at a time."""

TINY = 1e-9
"""Share of a polygon's size below which two of its corners are one."""


def hull(points: ArrayLike) -> FloatArray:
    """Return the corners of the convex hull of some points, (n, 2), m, counter-clockwise; fewer than three where it has no inside.

    Parameters
    ----------
    points : (m, 2) array, m

    Examples
    --------
    >>> hull([(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0), (1.0, 0.5)]).tolist()
    [[2.0, 0.0], [2.0, 1.0], [0.0, 1.0], [0.0, 0.0]]
    """
    given = np.atleast_2d(np.asarray(points, dtype=np.float64))
    # between the directions in which sides look that someone drew: no point within a side is taken for a corner
    turn = 2.0 * math.pi / DIRECTIONS * (np.arange(DIRECTIONS) + 0.382) - 0.5 * math.pi
    towards = np.stack([np.cos(turn), np.sin(turn)])
    best, chosen = np.full(DIRECTIONS, -np.inf), np.zeros(DIRECTIONS, dtype=np.int64)
    for begin in range(0, len(given), AT_A_TIME):
        reach = given[begin : begin + AT_A_TIME] @ towards
        at = reach.argmax(axis=0)
        found = reach[at, np.arange(DIRECTIONS)]
        chosen, best = np.where(found > best, begin + at, chosen), np.maximum(found, best)
    corners = given[chosen]
    far = np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=1) > TINY * np.ptp(given, axis=0).max()
    return corners[far]


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
    [[1.75, 0.25], [1.75, 0.75], [0.25, 0.75], [0.25, 0.25]]
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
