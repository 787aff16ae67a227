"""Stone of a pile (cuboid or cylinder) and joint between two stones."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.edge_wear import SHARP_EDGES, EdgeWear
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import BodyError, ParameterError
from seisblock.core.typing import FloatArray
from seisblock.core.units import warn_large_lengths

GROUND = "ground"
"""Name of the support of the lowest stones."""
GRANITE_DENSITY = 2650.0
"""Density of granite, kg/m^3; without effect on the motion of a single stone."""
CONTACT_TOLERANCE = 1e-6
"""Largest gap between touching surfaces, m."""
RECTANGULAR, ROUND = "rectangular", "round"
"""Shapes in plan."""


@dataclass(frozen=True, repr=False)
class PileStone(DisplayMixin):
    """One stone of a pile: a cuboid or an upright cylinder.

    Parameters
    ----------
    name : str
    width, depth, height : float, m
        Sizes along x, y and z; the first two are the diameter of a cylinder.
    offset : (float, float), m
        Position of the centre relative to the centre of the supporting stone (or the origin of the ground), along x and y.
    on : str
        Name of the supporting stone, or ``ground``.
    density : float, kg/m^3
    mu, mu_kinetic : float or None, 1
        Static and kinetic friction of the joint under the stone; None: that of the pile.
    bottom : float or None, m
        Height of the base above the ground; None: top of the supporting stone.
    shape : str
        ``rectangular`` or ``round`` in plan.
    inset : EdgeWear
        Distance of the worn pivot edges from the sides of the base; mass and inertia are unchanged.

    Raises
    ------
    BodyError
        If a size or the density is not positive, or the friction negative; if width and depth of a cylinder differ, the shape is unknown,
        or the inset leaves no base.

    Warns
    -----
    UserWarning
        If a length exceeds 20 m, which was probably meant in cm or mm.

    Examples
    --------
    >>> drum = PileStone("drum", 1.0, 1.0, 0.5, shape="round")
    >>> round(drum.mass / (drum.density * 0.5), 4), drum.gyration_squared.round(4).tolist()
    (0.7854, [0.0833, 0.0833, 0.125])
    """

    name: str
    width: float
    depth: float
    height: float
    offset: tuple[float, float] = (0.0, 0.0)
    on: str = GROUND
    density: float = GRANITE_DENSITY
    mu: float | None = None
    bottom: float | None = None
    shape: str = RECTANGULAR
    inset: EdgeWear = SHARP_EDGES
    mu_kinetic: float | None = None

    def __post_init__(self) -> None:
        checks.positive("width of the stone {name}", self.width, "m", error=BodyError, name=self.name)
        checks.positive("depth of the stone {name}", self.depth, "m", error=BodyError, name=self.name)
        checks.positive("height of the stone {name}", self.height, "m", error=BodyError, name=self.name)
        checks.positive("density of the stone {name}", self.density, "kg/m^3", error=BodyError, name=self.name)
        warn_large_lengths(self.name, width=self.width, depth=self.depth, height=self.height)
        if self.mu is not None:
            checks.non_negative("friction under the stone {name}", self.mu, error=BodyError, name=self.name)
        if self.mu_kinetic is not None:
            checks.non_negative("kinetic friction under the stone {name}", self.mu_kinetic, error=BodyError, name=self.name)
        if len(self.offset) != 2 or not all(math.isfinite(part) for part in self.offset):
            raise BodyError(
                "offset of the stone {name} requires two lengths, along x and y; found {found}", name=self.name, found=str(self.offset)
            )
        if self.shape not in (RECTANGULAR, ROUND):
            raise BodyError(
                "the shape of the stone {name} must be {one!r} or {other!r}, found {found!r}",
                name=self.name,
                one=RECTANGULAR,
                other=ROUND,
                found=self.shape,
            )
        if self.is_round and self.width != self.depth:
            raise BodyError(
                "the cylinder {name} must have equal width and depth: found {width:g} m and {depth:g} m",
                name=self.name,
                width=self.width,
                depth=self.depth,
            )
        try:
            self.insets()
        except ParameterError as error:
            raise BodyError("the stone {name}: {why}", name=self.name, why=error.message) from None

    @property
    def size(self) -> tuple[float, float, float]:
        """Width, depth and height, m."""
        return self.width, self.depth, self.height

    @property
    def is_round(self) -> bool:
        """True for a cylinder."""
        return self.shape == ROUND

    @property
    def mass(self) -> float:
        """Mass, kg."""
        return self.density * self.width * self.depth * self.height * (0.25 * math.pi if self.is_round else 1.0)

    @property
    def gyration_squared(self) -> FloatArray:
        """Squared radii of gyration about x, y and z through the centre, (3,), m^2 (homogeneous)."""
        w, d, h = (side * side for side in self.size)
        return np.array([d / 16 + h / 12, w / 16 + h / 12, w / 8]) if self.is_round else np.array([d + h, w + h, w + d]) / 12.0

    def insets(self) -> tuple[float, float]:
        """Return the insets of the worn edges along x and along y, m."""
        return self.inset.inset(self.width), self.inset.inset(self.depth)


@dataclass(frozen=True)
class Joint:
    """Contact area of two stones, or of a stone and the ground.

    Parameters
    ----------
    upper, lower : int
        Indices of the stones; ``lower`` is -1 for the ground.
    x, y : (float, float), m
        Ends of the contact rectangle.
    height : float, m
        Height above the ground.
    """

    upper: int
    lower: int
    x: tuple[float, float]
    y: tuple[float, float]
    height: float


def bearing_rectangle(
    joint: Joint, stones: Sequence[PileStone], centres: Sequence[tuple[float, float, float]]
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the load-bearing rectangle of a joint within worn edges: its ends along x and along y, m.

    Examples
    --------
    >>> slabs = PileStone("lower", 0.5, 0.5, 0.2), PileStone("upper", 0.2, 0.2, 0.7, offset=(0.2, 0.0), on="lower",
    ... inset=EdgeWear(share=0.1))
    >>> joint, centres = Joint(1, 0, (0.1, 0.25), (-0.1, 0.1), 0.2), [(0.0, 0.0, 0.1), (0.2, 0.0, 0.55)]
    >>> [[round(end, 3) for end in side] for side in bearing_rectangle(joint, slabs, centres)]
    [[0.12, 0.25], [-0.08, 0.08]]
    """
    upper_stone = stones[joint.upper]
    lower_stone = upper_stone if joint.lower < 0 else stones[joint.lower]
    smaller_stone, index = (
        (upper_stone, joint.upper)
        if upper_stone.width * upper_stone.depth <= lower_stone.width * lower_stone.depth
        else (lower_stone, joint.lower)
    )
    depths = upper_stone.inset.inset(smaller_stone.width), upper_stone.inset.inset(smaller_stone.depth)
    x, y = (span(centres[index][k], smaller_stone.size[k] - 2.0 * depths[k]) for k in (0, 1))
    return (max(x[0], joint.x[0]), min(x[1], joint.x[1])), (max(y[0], joint.y[0]), min(y[1], joint.y[1]))


def overlaps_in_plan(
    centre: tuple[float, float, float], stone: PileStone, other_centre: tuple[float, float, float], other_stone: PileStone
) -> bool:
    """Return whether two stones overlap in plan by more than the contact tolerance.

    Examples
    --------
    >>> drum, slab = PileStone("drum", 1.0, 1.0, 0.5, shape="round"), PileStone("slab", 1.0, 1.0, 0.5)
    >>> overlaps_in_plan((0.0, 0.0, 0.0), slab, (0.9, 0.9, 0.0), slab), overlaps_in_plan((0.0, 0.0, 0.0), drum, (0.9, 0.9, 0.0), slab)
    (True, False)
    """
    offsets = [abs(centre[k] - other_centre[k]) for k in (0, 1)]
    if stone.is_round and other_stone.is_round:
        return 0.5 * (stone.width + other_stone.width) - math.hypot(*offsets) > CONTACT_TOLERANCE
    gaps = [offsets[k] - sum(0.5 * body.size[k] for body in (stone, other_stone) if not body.is_round) for k in (0, 1)]
    radius_sum = sum(0.5 * body.width for body in (stone, other_stone) if body.is_round)
    if radius_sum == 0.0:
        return max(gaps) < -CONTACT_TOLERANCE
    return radius_sum - math.hypot(*(max(0.0, gap) for gap in gaps)) > CONTACT_TOLERANCE


def span(centre: float, size: float) -> tuple[float, float]:
    """Return the ends of a side, m."""
    return centre - 0.5 * size, centre + 0.5 * size


def interval_overlap(a: float, size_a: float, b: float, size_b: float) -> tuple[float, float]:
    """Return the common interval of two sides; its ends are reversed where there is none."""
    return max(a - 0.5 * size_a, b - 0.5 * size_b), min(a + 0.5 * size_a, b + 0.5 * size_b)
