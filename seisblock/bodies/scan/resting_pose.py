"""Resting pose of a scanned body: support plane and support polygon."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.scan.polygon import convex_hull, interior_distance
from seisblock.core.errors import BodyError
from seisblock.core.typing import FloatArray

MAX_TILT = math.radians(10.0)
"""Largest levelling rotation of a scan, rad."""

MAX_ITERATIONS = 60
"""Largest number of trial planes; each improves on the one before."""

PLANE_TOLERANCE = 1e-9
"""Largest distance of a point on a plane, a share of the body's size."""


@dataclass(frozen=True, eq=False)
class RestingPose:
    """Body on level ground.

    Parameters
    ----------
    rotation : (3, 3) array
        Rotation that levels the scan.
    tilt : float, rad
        Angle of the rotation.
    ground_height : float, m
        Height of the ground, along the scan's z after the rotation.
    base : (n, 2) array, m
        Corners of the support polygon, counter-clockwise.
    touching : int
        Vertices within the tolerance of the ground.
    """

    rotation: FloatArray
    tilt: float
    ground_height: float
    base: FloatArray
    touching: int


def find_resting_pose(vertices: FloatArray, centre: FloatArray, *, tolerance: float, source: str) -> RestingPose:
    """Return the resting pose of a body on level ground nearest to its scanned position.

    The support plane is the plane below all points whose intersection with the vertical through the centre of gravity is highest: the
    face of the convex hull below the centre (derived here). The support points are those within the tolerance of that plane.

    Parameters
    ----------
    vertices : (n, 3) array, m
        z upwards.
    centre : (3,) array, m
        Centre of gravity.
    tolerance : float, m
        Largest height above the ground of a support point.
    source : str
        Name for messages.

    Raises
    ------
    BodyError
        If the body rests on a point or an edge, or its centre of gravity does not lie above its support polygon.

    Examples
    --------
    >>> corners = np.array([(x, y, z) for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 2.0)])
    >>> found = find_resting_pose(corners, corners.mean(axis=0), tolerance=0.01, source="a box")
    >>> found.tilt, found.touching
    (0.0, 4)
    """
    turn, tilt = _levelling_rotation(_support_plane_slopes(vertices, centre))
    height = vertices @ turn[2]
    floor = float(height.min())
    in_contact = height - floor <= tolerance
    base = convex_hull((vertices[in_contact] @ turn.T)[:, :2])
    if not interior_distance(base, (turn @ centre)[:2]) > 0.0:
        raise BodyError(
            "{source} has no stable base: {count} point(s) within {tolerance:.3g} m of the ground do not surround the centre of "
            "gravity; change `up`, increase `tolerance`, or cut the base level",
            source=source,
            count=int(in_contact.sum()),
            tolerance=tolerance,
        )
    return RestingPose(turn, tilt, floor, base, int(in_contact.sum()))


def _support_plane_slopes(vertices: FloatArray, centre: FloatArray) -> FloatArray:
    """Return the slopes along x and y of the support plane, within the largest rotation.

    The plane t + p x + q y below all points, highest at the centre, solves a linear programme with one constraint per point, few of which
    are active: constraints violated by the last plane are added until none is (constraint generation).
    """
    from scipy.optimize import linprog

    size = float(np.ptp(vertices, axis=0).max())
    points = (vertices - centre) / size
    max_slope = math.tan(MAX_TILT)
    active_rows = {int(np.argmin(points @ (p, q, 1.0))) for p in (-max_slope, 0.0, max_slope) for q in (-max_slope, 0.0, max_slope)}
    bounds = [(-max_slope, max_slope), (-max_slope, max_slope), (None, None)]
    solution = np.zeros(3)
    for _ in range(MAX_ITERATIONS):
        rows = points[sorted(active_rows)]
        conditions = np.column_stack([rows[:, :2], np.ones(len(rows))])
        solution = linprog((0.0, 0.0, -1.0), A_ub=conditions, b_ub=rows[:, 2], bounds=bounds, method="highs").x
        clearance = points[:, 2] - points[:, :2] @ solution[:2] - solution[2]
        lowest = np.argpartition(clearance, min(8, clearance.size - 1))[:8]
        violated_rows = {int(index) for index in lowest if clearance[index] < -PLANE_TOLERANCE} - active_rows
        if not violated_rows:
            break
        active_rows |= violated_rows
    return solution[:2]


def _levelling_rotation(slopes: FloatArray) -> tuple[FloatArray, float]:
    """Return the smallest rotation that levels a plane of these slopes, and its angle, rad."""
    normal_vector = np.array([-slopes[0], -slopes[1], 1.0])
    normal = normal_vector / np.linalg.norm(normal_vector)
    tilt = math.atan2(math.hypot(normal[0], normal[1]), normal[2])
    if tilt < PLANE_TOLERANCE:
        return np.eye(3), 0.0
    from scipy.spatial.transform import Rotation

    axis = np.cross(normal, (0.0, 0.0, 1.0))
    return Rotation.from_rotvec(tilt * axis / np.linalg.norm(axis)).as_matrix(), tilt
