"""Three-dimensional scene in orthographic projection: cuboids and cylinders on the ground or on corner springs."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from seisblock.core.quaternions import rotate_vectors
from seisblock.core.typing import BoolArray, FloatArray
from seisblock.measures import ground_history
from seisblock.records import Motion

AZIMUTH, ELEVATION = math.radians(-60.0), math.radians(16.0)
"""Direction to the viewer: azimuth from +x towards +y, and elevation, rad."""

STONE, LIGHT = np.array([0.80, 0.77, 0.72]), np.array([0.25, -0.55, 0.80])
"""Base colour (RGB) of a lit face, and direction to the light."""

FRAMES_PER_RAD = 100.0
"""Frames per second of an HTML page; every frame has seven numbers per solid."""

FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
CORNERS = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])

BORDER = 0.5
"""Margin of the ground around a solid over the smallest dimension of the solid."""

SIDES = 20
"""Sides of the prism that represents a cylinder."""

_RIM_ANGLES = 2.0 * math.pi * np.arange(SIDES) / SIDES
RIMS = np.array([(0.5 * math.cos(a), 0.5 * math.sin(a), z) for z in (-0.5, 0.5) for a in _RIM_ANGLES])
MANTLE = tuple((i, (i + 1) % SIDES, SIDES + (i + 1) % SIDES, SIDES + i) for i in range(SIDES))
CAPS = (tuple(reversed(range(SIDES))), tuple(range(SIDES, 2 * SIDES)))


@dataclass(frozen=True, eq=False)
class Solid:
    """A cuboid, an upright cylinder or a convex hull.

    Parameters
    ----------
    size : (float, float, float), m
        The first two are the diameter of a cylinder.
    centre : (n, 3) array, m
        Relative to the ground.
    turn : (n, 4) array
        Quaternions w, x, y, z.
    fell_s : float, s
        Time of overturning, from which the edges are highlighted; infinite if it does not overturn.
    is_round : bool
        True for a cylinder.
    hull : (k, 3) array or None, m
        Vertices of a convex hull about the centre; `size` holds its extents.
    """

    size: tuple[float, float, float]
    centre: FloatArray
    turn: FloatArray
    fell_s: float = math.inf
    is_round: bool = False
    hull: FloatArray | None = None

    def corners_at(self, index: int) -> FloatArray:
        """Return the corners in frame `index`, (8, 3), (40, 3) on the rims of a cylinder, or (k, 3) of a hull, m relative to the ground."""
        corners = (RIMS if self.is_round else CORNERS) * np.array(self.size) if self.hull is None else self.hull
        return self.centre[index] + rotate_vectors(self.turn[index], corners)

    @cached_property
    def sides(self) -> tuple[tuple[int, ...], ...]:
        """Corner indices of the faces, counter-clockwise seen from outside."""
        if self.hull is not None:
            return _hull_faces(self.hull)
        return (*MANTLE, *CAPS) if self.is_round else FACES


def _hull_faces(points: FloatArray) -> tuple[tuple[int, ...], ...]:
    """Return the corner indices of the plane faces of a convex hull, counter-clockwise seen from outside."""
    from scipy.spatial import ConvexHull

    hull = ConvexHull(points)
    groups: dict[tuple[float, ...], set[int]] = {}
    for plane, triangle in zip(hull.equations.round(9).tolist(), hull.simplices.tolist(), strict=True):
        groups.setdefault(tuple(value + 0.0 for value in plane), set()).update(triangle)
    faces = []
    for plane, corners in groups.items():
        indices, normal = sorted(corners), np.array(plane[:3])
        arms = points[indices] - points[indices].mean(axis=0)
        first = arms[0] / np.linalg.norm(arms[0])
        angles = np.arctan2(arms @ np.cross(normal, first), arms @ first)
        faces.append(tuple(indices[k] for k in np.argsort(angles)))
    return tuple(faces)


@dataclass(frozen=True, eq=False)
class Spring:
    """Spring between the ground and a corner.

    Parameters
    ----------
    foot : (3,) array, m
        Position on the ground.
    top : (n, 3) array, m
        Position of the corner.
    free : float, m
        Free height, above which the corner separates from the spring.
    """

    foot: FloatArray
    top: FloatArray
    free: float

    @property
    def lifted(self) -> BoolArray:
        """Frames in which the corner is uplifted, (n,)."""
        return self.top[:, 2] > self.free


@dataclass(frozen=True, eq=False)
class Scene3D:
    """Solids and springs on a moving patch of ground.

    Parameters
    ----------
    ground_displacement : (n, 3) array, m
        Displacement of the ground.
    solids, springs : tuples
    half : float, m
        Half side of the patch of ground around the initial position; extended to the final positions of the solids in sight.
    """

    ground_displacement: FloatArray
    solids: tuple[Solid, ...]
    half: float
    springs: tuple[Spring, ...] = ()

    def extent(self, azimuth: float = AZIMUTH, elevation: float = ELEVATION) -> tuple[float, float, float, float]:
        """Return the bounding box in the picture of ground and solids at all times, without stones that roll far away, m."""
        right, up, _ = view_axes(azimuth, elevation)
        tall = max(float(solid.centre[0, 2]) + 0.5 * solid.size[2] for solid in self.solids)
        reach = 0.6 * max(math.hypot(*solid.size) for solid in self.solids)
        centres = np.concatenate([solid.centre + self.ground_displacement for solid in self.solids])
        across, high = centres @ right, centres @ up
        ground, beside = self.patch + self.ground_displacement[:, np.newaxis], 0.05 * self.half
        aside, rise = ground @ right, ground @ up
        # solids count only up to the visible radius, those that end within it as a whole, and the ground always
        ends = [solid.centre[-1] + self.ground_displacement[-1] for solid in self.solids if self.ends_in_sight(solid)]
        limit = max(self.visible_radius, *(float(np.abs((end @ right, end @ up)).max()) + reach for end in ends), 0.0)
        left = min(max(float(across.min()) - reach, -limit), float(aside.min()) - beside)
        end = max(min(float(across.max()) + reach, limit), float(aside.max()) + beside)
        low = min(max(float(high.min()) - reach, -limit), float(rise.min()) - beside)
        ceiling = 1.5 * tall + max(float((self.ground_displacement @ up).max()), 0.0)
        return left, end, low, max(min(float(high.max()) + reach, ceiling), float(rise.max()) + beside)

    @property
    def visible_radius(self) -> float:
        """Largest distance from the initial position that is shown, m."""
        return 1.2 * max(float(solid.centre[0, 2]) + 0.5 * solid.size[2] for solid in self.solids) + self.half

    def ends_in_sight(self, solid: Solid) -> bool:
        """Return whether the centre of a solid ends within the visible radius."""
        return bool(np.abs(project(solid.centre[-1])).max() < self.visible_radius)

    @cached_property
    def patch(self) -> FloatArray:
        """Corners of the patch of ground, (4, 3), m, below all final positions in sight, with a margin."""
        low, high = np.full(2, -self.half), np.full(2, self.half)
        for solid in self.solids:
            corners, margin = solid.corners_at(-1), BORDER * min(solid.size)
            if self.ends_in_sight(solid):
                low, high = np.minimum(low, corners[:, :2].min(axis=0) - margin), np.maximum(high, corners[:, :2].max(axis=0) + margin)
        (left, front), (right, back) = low, high
        return np.array([(left, front, 0.0), (right, front, 0.0), (right, back, 0.0), (left, back, 0.0)])

    def floor(self, index: int) -> FloatArray:
        """Return the patch of ground in frame `index`, (4, 3), m."""
        return self.patch + self.ground_displacement[index]

    def faces(self, index: int, time: float) -> Iterator[tuple[FloatArray, FloatArray, bool]]:
        """Yield the visible faces, farthest first: corners (k, 3), m, colour (3,), and overturned flag of the solid."""
        view_direction = view_axes()[2]
        visible = []
        for solid in self.solids:
            corners = solid.corners_at(index) + self.ground_displacement[index]
            for corner_indices in solid.sides:
                points = corners[list(corner_indices)]
                normal = np.cross(points[1] - points[0], points[2] - points[1])
                normal = normal / np.linalg.norm(normal)
                # back-face culling; edge-on faces are skipped by the tolerance
                if normal @ view_direction > 1e-9:
                    shade = np.clip(STONE * (0.72 + 0.32 * float(normal @ LIGHT)), 0.0, 1.0)
                    visible.append((float(points.mean(axis=0) @ view_direction), points, shade, time >= solid.fell_s))
        # painter's algorithm: sorted by distance of the face centre
        for _, points, shade, has_fallen in sorted(visible, key=lambda entry: entry[0]):
            yield points, shade, has_fallen


def view_axes(azimuth: float = AZIMUTH, elevation: float = ELEVATION) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the unit vectors to the right and upwards in the picture, and towards the viewer."""
    c, s, ce, se = math.cos(azimuth), math.sin(azimuth), math.cos(elevation), math.sin(elevation)
    return np.array([-s, c, 0.0]), np.array([-c * se, -s * se, ce]), np.array([c * ce, s * ce, se])


def project(points: FloatArray) -> FloatArray:
    """Project points (..., 3) to the picture, (..., 2)."""
    right, up, _ = view_axes()
    return np.stack([points @ right, points @ up], axis=-1)


def ground_path(motion: Motion, acts: tuple[bool, bool, bool], times: FloatArray) -> FloatArray:
    """Return the ground displacement along, across and up, (n, 3), m, with the baseline of PGD; zero in inactive rows."""
    zeros = np.zeros(motion.samples)
    rows = zip(acts, motion.acceleration, strict=True)
    displacements = [ground_history(row, motion.dt).displacement if act and row.any() else zeros for act, row in rows]
    return np.array([np.interp(times, motion.time, row) for row in displacements]).T
