"""Convex rigid body in three dimensions: vertices of its hull, mass, centre of gravity and inertia."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from seisblock.bodies.block import DENSITY, Block
from seisblock.bodies.scan.body import Pair, ScannedBody, Triple, check_inertia
from seisblock.bodies.scan.polygon import convex_hull
from seisblock.bodies.scan.scan import DEFAULT_TOLERANCE_SHARE, Scan
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import BodyError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.limits import MAX_BASE_CORNERS, check_limit
from seisblock.core.typing import ArrayLike, FloatArray

CYLINDER_SIDES = 64
"""Sides of the prism that stands for a cylinder; a multiple of four, so that mirror images agree."""

MERGE_SHARE = 1e-9
"""Distance of vertices that are one, a share of the size of the body."""


@dataclass(frozen=True, repr=False)
class ConvexBody(DisplayMixin):
    """Rigid convex body standing on its lowest vertices.

    Parameters
    ----------
    name : str
    mass : float, kg
    centre : three floats, m
        Centre of gravity in the axes of the vertices, z up.
    inertia : three rows of three floats, kg m^2
        Tensor about the centre of gravity.
    vertices : triples of floats, m
        Vertices of the convex hull.
    base : pairs of floats, m
        Support polygon, counter-clockwise; its edges decide when the body is past overturning. Default: hull of the vertices within 0.002
        of the body's size above the lowest one.

    Raises
    ------
    BodyError
        If mass or inertia is not positive, the vertices enclose no volume, or the centre of gravity does not lie inside them.

    Examples
    --------
    >>> box = ConvexBody.box(0.3, 0.2, 0.8)
    >>> round(box.mass, 1), len(box.vertices)
    (127.2, 8)
    """

    name: str
    mass: float
    centre: Triple
    inertia: tuple[Triple, Triple, Triple]
    vertices: tuple[Triple, ...]
    base: tuple[Pair, ...] = ()

    def __post_init__(self) -> None:
        checks.positive("{name}: {what}", self.mass, "kg", error=BodyError, name=self.name, what=lazy_gettext("mass"))
        check_inertia(self.inertia, self.name)
        points = self.points
        if points.ndim != 2 or points.shape[1:] != (3,) or len(points) < 4 or not np.isfinite(points).all():
            raise BodyError("{name}: the hull needs four vertices or more, each with x, y and z", name=self.name)
        check_limit(N_("vertices of the hull"), len(points), MAX_BASE_CORNERS, source=self.name, error=BodyError)
        planes = hull_planes(points, self.name)
        if not (np.array(self.centre) @ planes[:, :3].T + planes[:, 3]).max() < 0.0:
            raise BodyError("{name}: the centre of gravity does not lie inside the hull", name=self.name)

    @cached_property
    def points(self) -> FloatArray:
        """Vertices, (n, 3), m."""
        return np.array(self.vertices, dtype=np.float64)

    @cached_property
    def support_polygon(self) -> FloatArray:
        """Support polygon, (n, 2), m."""
        if self.base:
            return np.array(self.base, dtype=np.float64)
        points = self.points
        tolerance = DEFAULT_TOLERANCE_SHARE * float(np.ptp(points, axis=0).max())
        return convex_hull(points[points[:, 2] <= points[:, 2].min() + tolerance, :2])

    def turned(self, angle: float) -> ConvexBody:
        """Return the body turned about the vertical through the origin, counter-clockwise seen from above, rad."""
        cosine, sine = math.cos(angle), math.sin(angle)
        rotation = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
        inertia = rotation @ np.array(self.inertia) @ rotation.T
        return replace(
            self,
            centre=_triple(rotation @ np.array(self.centre)),
            inertia=_triples(0.5 * (inertia + inertia.T)),
            vertices=_triples(self.points @ rotation.T),
            base=tuple((x, y) for x, y in (np.array(self.base).reshape(-1, 2) @ rotation[:2, :2].T).tolist()),
        )

    def scaled(self, plan: float, tall: float) -> ConvexBody:
        """Return the body with all lengths along the ground times `plan`, and heights times `tall`.

        Examples
        --------
        >>> ConvexBody.box(0.3, 0.2, 0.8).scaled(2.0, 0.5).vertices[-1]
        (0.3, 0.2, 0.4)
        """
        if plan == tall == 1.0:
            return self
        factors = np.array([plan, plan, tall])
        inertia = np.array(self.inertia)
        # integral of x x^T dm, which scales by its axes
        second = 0.5 * np.trace(inertia) * np.eye(3) - inertia
        second = plan * plan * tall * second * np.outer(factors, factors)
        return replace(
            self,
            mass=plan * plan * tall * self.mass,
            centre=_triple(factors * np.array(self.centre)),
            inertia=_triples(np.trace(second) * np.eye(3) - second),
            vertices=_triples(self.points * factors),
            base=tuple((plan * x, plan * y) for x, y in self.base),
        )

    @classmethod
    def box(
        cls, width: float, depth: float, height: float, *, mass: float | None = None, inset: float = 0.0, name: str = N_("block")
    ) -> ConvexBody:
        """Return a homogeneous box: width along x, depth along y, height along z, m; `inset` bevels the edges of the base."""
        return convex_body(Block(width, height, depth, mass, inset=inset, name=name))

    @classmethod
    def cylinder(
        cls, diameter: float, height: float, *, mass: float | None = None, sides: int = CYLINDER_SIDES, name: str = N_("cylinder")
    ) -> ConvexBody:
        """Return a homogeneous upright cylinder, m; its hull is a prism of `sides` sides on the circle."""
        checks.positive("{name}: {what}", diameter, "m", error=BodyError, name=name, what=lazy_gettext("diameter"))
        checks.positive("{name}: {what}", height, "m", error=BodyError, name=name, what=lazy_gettext("height"))
        if sides < 8 or sides % 4:
            raise BodyError("{name}: the number of sides must be a multiple of four, at least 8; found {sides}", name=name, sides=sides)
        radius = 0.5 * diameter
        weight = DENSITY * math.pi * radius * radius * height if mass is None else mass
        quarter = [math.pi * (2 * k + 1) / sides for k in range(sides // 4)]
        # quadrants are exact mirror images
        first = [(radius * math.cos(angle), radius * math.sin(angle)) for angle in quarter]
        ring = [*first, *((-x, y) for x, y in reversed(first)), *((-x, -y) for x, y in first), *((x, -y) for x, y in reversed(first))]
        across = weight * (3.0 * radius * radius + height * height) / 12.0
        inertia = ((across, 0.0, 0.0), (0.0, across, 0.0), (0.0, 0.0, 0.5 * weight * radius * radius))
        vertices = tuple((x, y, z) for z in (0.0, height) for x, y in ring)
        return cls(name, weight, (0.0, 0.0, 0.5 * height), inertia, vertices)

    @classmethod
    def polyhedron(
        cls,
        points: ArrayLike,
        *,
        mass: float | None = None,
        centre: Sequence[float] | None = None,
        inertia: ArrayLike | None = None,
        name: str = N_("polyhedron"),
    ) -> ConvexBody:
        """Return the convex hull of points, (n, 3), m; mass, centre and inertia default to those of the homogeneous solid."""
        array = np.array(points, dtype=np.float64)
        if array.ndim != 2 or array.shape[1:] != (3,) or len(array) < 4 or not np.isfinite(array).all():
            raise BodyError("{name}: the hull needs four vertices or more, each with x, y and z", name=name)
        vertices, volume, middle, gyration = solid_hull(array, name)
        weight = DENSITY * volume if mass is None else mass
        place = middle if centre is None else np.array(centre, dtype=np.float64)
        if inertia is None and centre is not None:
            raise BodyError("{name}: a given centre of gravity requires the inertia about it", name=name)
        tensor = weight * gyration if inertia is None else np.array(inertia, dtype=np.float64)
        return cls(
            name,
            weight,
            _triple(place),
            _triples(tensor),
            _triples(vertices),
        )


def _triple(vector: FloatArray) -> Triple:
    x, y, z = vector.tolist()
    return x, y, z


def _triples(rows: FloatArray) -> Any:
    return tuple(_triple(row) for row in rows)


def _hull(points: FloatArray, name: str) -> Any:
    """Return Qhull's convex hull of points in space."""
    from scipy.spatial import ConvexHull, QhullError

    try:
        return ConvexHull(points)
    except QhullError:
        raise BodyError("{name}: the vertices lie in one plane and enclose no volume", name=name) from None


def hull_planes(points: FloatArray, name: str) -> FloatArray:
    """Return outward normals and offsets of the faces of a hull, (n, 4)."""
    planes: FloatArray = _hull(points, name).equations
    return planes


def solid_hull(points: FloatArray, name: str) -> tuple[FloatArray, float, FloatArray, FloatArray]:
    """Return vertices, volume, centre and inertia per mass of the homogeneous convex hull of points."""
    hull = _hull(points, name)
    middle = points[hull.vertices].mean(axis=0)
    corners = points[hull.simplices] - middle
    six_volumes = np.abs(np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])))
    total = corners.sum(axis=1)
    volume = float(six_volumes.sum()) / 6.0
    centre = six_volumes @ total / (24.0 * volume)
    vectors = np.concatenate([corners, total[:, None]], axis=1)
    second = np.einsum("i,ijk,ijl->kl", six_volumes, vectors, vectors) / (120.0 * volume) - np.outer(centre, centre)
    return points[np.sort(hull.vertices)], volume, middle + centre, np.trace(second) * np.eye(3) - second


def _worn_hull(body: ScannedBody) -> tuple[Triple, ...]:
    """Return the vertices of a scan's hull cut by a plane at 45 degrees through each side of its worn base."""
    from scipy.spatial import HalfspaceIntersection

    corners = body.corners
    sides = np.roll(corners, -1, axis=0) - corners
    normals = np.column_stack([sides[:, 1], -sides[:, 0]]) / np.hypot(sides[:, 0], sides[:, 1])[:, None]
    offsets = np.einsum("ij,ij->i", normals, corners) - body.inset_m
    bevels = math.sqrt(0.5) * np.column_stack([normals, np.full(len(normals), -1.0), -offsets])
    planes = np.concatenate([hull_planes(np.array(body.hull), body.name), bevels])
    points = HalfspaceIntersection(planes, np.array(body.centre)).intersections
    # faces that meet in one vertex give it several times, to round-off
    size = float(np.ptp(points, axis=0).max())
    unique_points = points[np.unique(np.round(points / (MERGE_SHARE * size)), axis=0, return_index=True)[1]]
    unique_points[np.abs(unique_points[:, 2]) < MERGE_SHARE * size, 2] = 0.0
    return _triples(solid_hull(unique_points, body.name)[0])  # type: ignore[no-any-return]


def convex_body(body: Block | Scan | ScannedBody | ConvexBody) -> ConvexBody:
    """Return a body as a convex one.

    A block without a depth is square. Worn edges bevel the edges of the base, of a scan those of its support polygon, at 45 degrees; mass,
    centre and inertia are unchanged. A given
    moment of inertia is that about y; the others are in proportion to it, as those of the homogeneous box.

    Raises
    ------
    BodyError
        If a scanned body has no hull.

    Examples
    --------
    >>> convex_body(Block(0.3, 0.9)).vertices[0]
    (-0.15, -0.15, 0.0)
    """
    if isinstance(body, ConvexBody):
        return body
    if isinstance(body, Scan):
        body = body.body
    if isinstance(body, ScannedBody):
        if not body.hull:
            raise BodyError(
                "{name} has no hull, which three dimensions require: write its file again from the scan with seisblock body", name=body.name
            )
        corners = tuple((x, y) for x, y in body.support_polygon.tolist())
        hull = body.hull if body.inset_m == 0.0 else _worn_hull(body)
        return ConvexBody(body.name, body.mass, body.centre, body.inertia, hull, corners)
    depth = body.width if body.depth is None else body.depth
    half, across, bevel, mass = 0.5 * body.width, 0.5 * depth, body.inset, body.total_mass
    rings = [(half, across, 0.0), (half, across, body.height)]
    if bevel > 0.0:
        if not bevel < across:
            raise BodyError("{name}: the inset exceeds half the depth, {half:g} m", name=body.name, half=across)
        rings = [(half - bevel, across - bevel, 0.0), (half, across, bevel), (half, across, body.height)]
    vertices = tuple((sx * x, sy * y, z) for x, y, z in rings for sx in (-1.0, 1.0) for sy in (-1.0, 1.0))
    share = mass * body.gyration_squared / (body.width**2 + body.height**2)
    along, up = share * (depth**2 + body.height**2), share * (body.width**2 + depth**2)
    inertia = ((along, 0.0, 0.0), (0.0, mass * body.gyration_squared, 0.0), (0.0, 0.0, up))
    x, y = half - bevel, across - bevel
    return ConvexBody(body.name, mass, (body.centroid_offset, 0.0, body.centre), inertia, vertices, ((-x, -y), (x, -y), (x, y), (-x, y)))
