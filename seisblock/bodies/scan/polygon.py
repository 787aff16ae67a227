"""Convex polygons in the plane: hull, support function, offset and width."""

from __future__ import annotations

import math

import numpy as np

from seisblock.core.typing import ArrayLike, FloatArray, IntArray

CHUNK_SIZE = 2**13
"""Points per chunk."""

PREFILTER_POINTS, PREFILTER_DIRECTIONS = 5000, 64
"""Number of points from which interior points are filtered first, and number of filter directions."""

COLLINEAR_TOLERANCE = 1e-6
"""Smallest distance of a corner from the line between its neighbours, a share of the polygon's size."""


def convex_hull(points: ArrayLike) -> FloatArray:
    """Return the corners of the convex hull, (n, 2), m, counter-clockwise; two points where it is degenerate.

    Corners within a millionth of the polygon's size of the line between their neighbours are dropped.

    Parameters
    ----------
    points : (m, 2) array, m

    Examples
    --------
    >>> convex_hull([(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0), (1.0, 0.5)]).tolist()
    [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]
    """
    from scipy.spatial import ConvexHull, QhullError

    points_array = np.atleast_2d(np.asarray(points, dtype=np.float64))
    if len(points_array) > PREFILTER_POINTS:
        extreme_points = points_array[_extreme_points(points_array)]
        points_array = np.concatenate([extreme_points, _points_outside(points_array, extreme_points)])
    try:
        corners = points_array[ConvexHull(points_array).vertices]
    except QhullError:  # collinear or too few points
        return points_array[:2]
    return _drop_collinear(corners)


def _drop_collinear(corners: FloatArray) -> FloatArray:
    """Return a polygon without nearly collinear corners."""
    min_height = COLLINEAR_TOLERANCE * float(np.ptp(corners, axis=0).max())
    while len(corners) > 3:
        previous_corners, next_corners = np.roll(corners, 1, axis=0), np.roll(corners, -1, axis=0)
        chord, arm = next_corners - previous_corners, corners - previous_corners
        height = np.abs(chord[:, 0] * arm[:, 1] - chord[:, 1] * arm[:, 0]) / np.linalg.norm(chord, axis=1)
        flat = height < min_height
        # never drop two neighbours at once: even indices first
        even_flat = flat & (np.arange(len(corners)) % 2 == 0)
        flat = even_flat if even_flat.any() else flat
        if not flat.any() or len(corners) - int(flat.sum()) < 3:
            break
        corners = corners[~flat]
    return corners


def _extreme_points(points: FloatArray) -> IntArray:
    """Return the indices of the extreme points in directions all around, counter-clockwise, without duplicates."""
    turn = 2.0 * math.pi / PREFILTER_DIRECTIONS * np.arange(PREFILTER_DIRECTIONS)
    unit_vectors = np.stack([np.cos(turn), np.sin(turn)])
    best, indices = np.full(turn.size, -np.inf), np.zeros(turn.size, dtype=np.int64)
    for begin in range(0, len(points), CHUNK_SIZE):
        projections = points[begin : begin + CHUNK_SIZE] @ unit_vectors
        best_rows = projections.argmax(axis=0)
        best_projections = projections[best_rows, np.arange(turn.size)]
        indices, best = np.where(best_projections > best, begin + best_rows, indices), np.maximum(best_projections, best)
    return indices[indices != np.roll(indices, 1)]


def _points_outside(points: FloatArray, corners: FloatArray) -> FloatArray:
    """Return the points outside a polygon of hull candidates: only these can be further hull corners."""
    edges = np.roll(corners, -1, axis=0) - corners
    normals = np.stack([edges[:, 1], -edges[:, 0]])
    limits = np.einsum("ij,ji->i", corners, normals)
    masks = [(piece @ normals >= limits).any(axis=1) for piece in np.array_split(points, -(-len(points) // CHUNK_SIZE))]
    return points[np.concatenate(masks)]


def _side_normals(polygon: FloatArray) -> FloatArray:
    """Return the outward unit normal of each side of a counter-clockwise polygon, (n, 2)."""
    edges = np.roll(polygon, -1, axis=0) - polygon
    return np.column_stack([edges[:, 1], -edges[:, 0]]) / np.linalg.norm(edges, axis=1)[:, None]


def support_distance(polygon: FloatArray, direction: ArrayLike) -> float:
    """Return the support function of a polygon for a unit direction, m.

    Examples
    --------
    >>> support_distance(np.array([(1.0, 0.0), (0.0, 2.0), (-1.0, 0.0)]), (0.0, 1.0))
    2.0
    """
    return float((polygon @ np.asarray(direction, dtype=np.float64)).max())


def offset_polygon(polygon: FloatArray, distance: float) -> FloatArray:
    """Return a convex polygon with each side moved inwards, (k, 2), m; (0, 2) where nothing is left.

    The result is the set of points at least `distance` from each side: the polygon clipped by each side's line, shifted along its normal
    (derived here). A corner of angle phi moves by distance/sin(phi/2), more than its sides (derived here).

    Parameters
    ----------
    polygon : (n, 2) array, m
        Counter-clockwise.
    distance : float, m
        Zero or more.

    Examples
    --------
    >>> offset_polygon(convex_hull([(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)]), 0.25).round(9).tolist()
    [[0.25, 0.25], [1.75, 0.25], [1.75, 0.75], [0.25, 0.75]]
    """
    remainder = polygon
    if distance == 0.0:
        return remainder
    for normal, corner in zip(_side_normals(polygon), polygon, strict=True):
        excess = (remainder - corner) @ normal + distance
        if (excess > 0.0).all():
            return np.empty((0, 2))
        if (excess > 0.0).any():
            remainder = _clip_half_plane(remainder, excess)
    return remainder


def _clip_half_plane(polygon: FloatArray, excess: FloatArray) -> FloatArray:
    """Clip a polygon by a half plane, from the excess of each corner beyond the line."""
    next_corners, next_excess = np.roll(polygon, -1, axis=0), np.roll(excess, -1)
    is_crossing = (excess > 0.0) != (next_excess > 0.0)
    share = np.where(is_crossing, excess / np.where(is_crossing, excess - next_excess, 1.0), 0.0)
    # keep inside corners; after each, add the intersection of its side with the line
    candidates = np.stack([polygon, polygon + share[:, None] * (next_corners - polygon)], axis=1).reshape(-1, 2)
    return candidates[np.column_stack([excess <= 0.0, is_crossing]).ravel()]


def interior_distance(polygon: FloatArray, point: ArrayLike) -> float:
    """Return the distance of a point inside a convex polygon to its nearest side, m; negative outside.

    Examples
    --------
    >>> interior_distance(convex_hull([(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)]), (0.25, 0.5))
    0.25
    """
    if len(polygon) < 3:
        return -math.inf
    return float(np.einsum("ij,ij->i", polygon - np.asarray(point, dtype=np.float64), _side_normals(polygon)).min())


def nearest_edge(polygon: FloatArray, point: ArrayLike) -> tuple[float, float]:
    """Return the distance to the nearest side, m, and the direction of that side's normal, rad from x.

    Examples
    --------
    >>> nearest_edge(convex_hull([(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)]), (1.75, 0.5))
    (0.25, 0.0)
    """
    normals = _side_normals(polygon)
    distances = np.einsum("ij,ij->i", polygon - np.asarray(point, dtype=np.float64), normals)
    nearest_index = int(np.argmin(distances))
    return float(distances[nearest_index]), math.atan2(*(normals[nearest_index, ::-1] + 0.0))


def min_width(polygon: FloatArray) -> float:
    """Return the smallest width of a convex polygon, m: the distance of parallel lines, one along a side.

    Examples
    --------
    >>> min_width(convex_hull([(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)]))
    1.0
    """
    normals = _side_normals(polygon)
    return float((np.einsum("ij,ij->i", polygon, normals)[:, None] - np.einsum("kj,ij->ik", polygon, normals)).max(axis=1).min())
