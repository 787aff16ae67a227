"""Scanned body: mass properties and support polygon, with a block for each azimuth."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.edge_wear import MIN_SHARE, SHARP_EDGES, EdgeWear
from seisblock.bodies.scan.polygon import interior_distance, min_width, nearest_edge, offset_polygon, support_distance
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import BodyError, ComponentError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.records import Motion

EAST = 90.0
"""Default azimuth of +x, degrees: x east, y north."""

Triple = tuple[float, float, float]
Pair = tuple[float, float]


@dataclass(frozen=True, repr=False)
class ScannedBody(DisplayMixin):
    """Rigid body of any shape on level ground, with a convex support polygon.

    Parameters
    ----------
    name : str
    mass : float, kg
    height : float, m
        Overall height above the ground.
    centre : three floats, m
        Centre of gravity: x, y, and z above the ground.
    inertia : three rows of three floats, kg m^2
        Tensor about the centre of gravity.
    base : pairs of floats, m
        Corners of the sharp support polygon, convex, counter-clockwise.
    inset : Inset
        Distance of the worn edges from each side of the base; a share refers to the smallest width of the base.
    facing : float, degrees
        Azimuth of +x, clockwise from north.
    hull : triples of floats, m
        Vertices of the convex hull, x, y, and z above the ground; empty where only the base is known.

    Raises
    ------
    BodyError
        If the mass, a size or the inertia is not positive, or the centre of gravity does not lie above the base within its worn edges.

    Examples
    --------
    >>> base = ((0.1, 0.15), (-0.1, 0.15), (-0.1, -0.15), (0.1, -0.15))
    >>> box = ScannedBody("box", 240.0, 0.8, (0.0, 0.0, 0.4), ((16.0, 0.0, 0.0), (0.0, 14.0, 0.0), (0.0, 0.0, 5.0)), base)
    >>> east, north = box.block_toward(90.0), box.block_toward(0.0)
    >>> round(east.width, 12), round(north.width, 12)
    (0.2, 0.3)
    """

    name: str
    mass: float
    height: float
    centre: Triple
    inertia: tuple[Triple, Triple, Triple]
    base: tuple[Pair, ...]
    inset: EdgeWear = SHARP_EDGES
    facing: float = EAST
    hull: tuple[Triple, ...] = field(default=(), repr=False)

    def __post_init__(self) -> None:
        checks.positive("{name}: {what}", self.mass, "kg", error=BodyError, name=self.name, what=lazy_gettext("mass"))
        checks.positive("{name}: {what}", self.height, "m", error=BodyError, name=self.name, what=lazy_gettext("height"))
        checks.finite("{name}: {what}", self.facing, "degrees", error=BodyError, name=self.name, what=lazy_gettext("azimuth of +x"))
        check_inertia(self.inertia, self.name)
        corners = self.corners
        if corners.ndim != 2 or corners.shape[1:] != (2,) or len(corners) < 3 or not np.isfinite(corners).all():
            raise BodyError("{name}: the base must have three corners or more, each with x and y", name=self.name)
        sides = np.roll(corners, -1, axis=0) - corners
        cross_products = sides[:, 0] * np.roll(sides[:, 1], -1) - sides[:, 1] * np.roll(sides[:, 0], -1)
        area = 0.5 * float(np.sum(corners[:, 0] * np.roll(corners[:, 1], -1) - np.roll(corners[:, 0], -1) * corners[:, 1]))
        if not (area > 0.0 and cross_products.min() >= -1e-9 * area):
            raise BodyError("{name}: the corners of the base must form a convex polygon, counter-clockwise", name=self.name)
        if not (len(self.centre) == 3 and 0.0 < self.centre[2] < self.height):
            raise BodyError(
                "{name}: the centre of gravity must lie between the ground and the top, {height:g} m; found {centre}",
                name=self.name,
                height=self.height,
                centre=str(self.centre),
            )
        if not interior_distance(corners, self.centre[:2]) > 0.0:
            raise BodyError("{name}: the centre of gravity does not lie above the base", name=self.name)
        if not interior_distance(self.support_polygon, self.centre[:2]) > 0.0:
            raise BodyError(
                "{name}: an inset of {inset:.4g} m exceeds the distance of the centre of gravity from the edge of the base, {depth:.4g} m",
                name=self.name,
                inset=self.inset_m,
                depth=interior_distance(corners, self.centre[:2]),
            )

    @cached_property
    def corners(self) -> FloatArray:
        """Support polygon with sharp edges, (n, 2), m."""
        return np.array(self.base, dtype=np.float64)

    @cached_property
    def inset_m(self) -> float:
        """Inset of the worn edges from each side of the base, m."""
        if self.inset == SHARP_EDGES:
            return 0.0
        width = min_width(self.corners)
        depth = self.inset.length_m + self.inset.share * width
        return depth if depth >= MIN_SHARE * width else 0.0

    @cached_property
    def support_polygon(self) -> FloatArray:
        """Support polygon within the worn edges, (n, 2), m."""
        return offset_polygon(self.corners, self.inset_m)

    def with_wear(self, inset: EdgeWear | float) -> ScannedBody:
        """Return the body with other edge wear: a share of the smallest base width per side, or an ``EdgeWear``."""
        return replace(self, inset=inset if isinstance(inset, EdgeWear) else EdgeWear(share=inset))

    def block_toward(self, azimuth: float) -> Block:
        """Return the equivalent block in the vertical plane whose +x has an azimuth.

        The pivots are the horizontal lines across the plane that touch the base, and the inertia is that about their direction;
        out-of-plane rotation about the touching corner is neglected (derived here). The two sides differ.

        Parameters
        ----------
        azimuth : float, degrees
            Clockwise from north.

        Returns
        -------
        Block
            The inset is the mean of both sides; the arms are exact.
        """
        turn = math.radians(self.facing - checks.finite("the azimuth", azimuth, "degrees"))
        forward, lateral = np.array([math.cos(turn), math.sin(turn)]), np.array([-math.sin(turn), math.cos(turn)])
        sharp_base, worn_base = self.corners - self.centre[:2], self.support_polygon - self.centre[:2]
        right, left = support_distance(worn_base, forward), support_distance(worn_base, -forward)
        width = support_distance(sharp_base, forward) + support_distance(sharp_base, -forward)
        axis = np.array([*lateral, 0.0])
        return Block(
            width,
            self.height,
            support_distance(sharp_base, lateral) + support_distance(sharp_base, -lateral),
            self.mass,
            centroid_height=self.centre[2],
            centroid_offset=0.5 * (left - right),
            centroid_inertia=float(axis @ np.array(self.inertia) @ axis),
            name=self.name,
            inset=max(0.5 * (width - (right + left)), 0.0),
        )

    def block_for_motion(self, motion: Motion) -> Block:
        """Return the equivalent block for a motion, from the azimuth of its +x.

        Raises
        ------
        ComponentError
            If the azimuth of the motion's +x is unknown.
        """
        azimuth = motion.azimuth_deg
        if azimuth is None:
            raise ComponentError(
                "the dimensions of {name} depend on the azimuth, and the azimuth of {component} is unknown: give a record with azimuths",
                name=self.name,
                component=motion.name or "+x",
            )
        return self.block_toward(azimuth)


def check_inertia(inertia: Sequence[Triple], name: str) -> None:
    """Raise an error for a tensor that no body has.

    Raises
    ------
    BodyError
        If it is not symmetric, or its principal moments break the triangle inequality.
    """
    tensor = np.array(inertia, dtype=np.float64)
    if tensor.shape != (3, 3) or not np.isfinite(tensor).all() or np.abs(tensor - tensor.T).max() > 1e-9 * np.abs(tensor).max():
        raise BodyError("{name}: the inertia must be a symmetric 3 x 3 matrix", name=name)
    moments = np.linalg.eigvalsh(tensor)
    if not (moments[0] > 0.0 and moments[2] <= (moments[0] + moments[1]) * (1.0 + 1e-9)):
        raise BodyError(
            "{name}: principal moments of inertia of {moments} kg m^2 are not physically possible",
            name=name,
            moments=[f"{moment:.4g}" for moment in moments],
        )


def min_slenderness(body: ScannedBody) -> tuple[float, float]:
    """Return the smallest alpha, rad, and its azimuth, degrees: the nearest side of the base (derived here).

    Examples
    --------
    >>> from seisblock.bodies.scan.toml import load_scan
    >>> alpha, azimuth = min_slenderness(load_scan("boulder"))
    >>> round(alpha, 3), round(azimuth)
    (0.183, 226)
    """
    depth, turn = nearest_edge(body.support_polygon, body.centre[:2])
    return math.atan2(depth, body.centre[2]), (body.facing - math.degrees(turn)) % 360.0
