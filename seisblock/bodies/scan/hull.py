"""Vertices of the convex hull of a scan."""

from __future__ import annotations

import numpy as np

from seisblock.core.typing import FloatArray

MAX_HULL_VERTICES = 2000
"""Number of vertices up to which a hull is kept whole."""

HULL_TOLERANCE_SHARE = 1e-3
"""Largest distance of an omitted vertex from the reduced hull, a share of the body's largest extent: half the support tolerance."""

PLANES_AT_ONCE = 500


def hull_vertices(points: FloatArray) -> tuple[FloatArray, int]:
    """Return the vertices of a convex hull, of a fine one only as many as its tolerance requires, and the number of all.

    Parameters
    ----------
    points : (n, 3) array, m
        Not in one plane.

    Returns
    -------
    (m, 3) array, int

    Examples
    --------
    >>> corners = np.array([(x, y, z) for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 2.0)])
    >>> hull_vertices(np.vstack([corners, [[0.5, 0.5, 1.0]]]))[0].shape
    (8, 3)
    """
    from scipy.spatial import ConvexHull

    corners = points[np.sort(ConvexHull(points).vertices)]
    if len(corners) <= MAX_HULL_VERTICES:
        return corners, len(corners)
    tolerance = HULL_TOLERANCE_SHARE * float(np.ptp(corners, axis=0).max())
    directions = np.stack(np.meshgrid(*3 * [[-1.0, 0.0, 1.0]]), axis=-1).reshape(-1, 3)
    chosen = np.unique(np.argmax(corners @ directions.T, axis=0))
    # as Quickhull does, but of each face's outer vertices only the farthest, until all are within the tolerance
    while (more := _farthest(corners, ConvexHull(corners[chosen]).equations, tolerance)).size:
        chosen = np.union1d(chosen, more)
    return corners[chosen], len(corners)


def _farthest(corners: FloatArray, planes: FloatArray, tolerance: float) -> np.ndarray:
    """Return the numbers of the vertices farthest beyond each plane, of those beyond by more than the tolerance."""
    indices = []
    for first in range(0, len(planes), PLANES_AT_ONCE):
        heights = corners @ planes[first : first + PLANES_AT_ONCE, :3].T + planes[first : first + PLANES_AT_ONCE, 3]
        numbers = np.argmax(heights, axis=0)
        indices.append(numbers[heights[numbers, np.arange(len(numbers))] > tolerance])
    return np.unique(np.concatenate(indices))
