"""Rigid block on a flat base: geometry, inertia, slenderness, restitution and rocking threshold."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, TypeVar

from seisblock.bodies.edge_wear import EdgeWear
from seisblock.bodies.uncertainty import ParameterRanges
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import BodyError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.units import MAX_UNITLESS_LENGTH, STANDARD_GRAVITY, warn_large_lengths

if TYPE_CHECKING:
    from seisblock.core.typing import FloatArray

DENSITY = 2650.0
"""Density of granite, kg/m^3; without effect on the motion of a rigid block."""

RIGHT, LEFT = range(2)
"""Lower corners: RIGHT towards +x, pivot of a block with positive tilt, and LEFT."""

Length = TypeVar("Length", float, "FloatArray")
"""Scalar or array of lengths."""

_POSITIVE_FIELDS = {
    "width": (lazy_gettext("width"), "m"),
    "height": (lazy_gettext("height"), "m"),
    "depth": (lazy_gettext("depth"), "m"),
    "mass": (lazy_gettext("mass"), "kg"),
    "density": (lazy_gettext("density"), "kg/m^3"),
    "centroid_height": (lazy_gettext("height of the centre of gravity"), "m"),
    "centroid_inertia": (lazy_gettext("moment of inertia"), "kg m^2"),
}


@dataclass(frozen=True, repr=False)
class Block(DisplayMixin):
    """Rigid block with a flat base; rectangular and homogeneous by default.

    Parameters
    ----------
    width : float, m
        Base along the motion, 2b.
    height : float, m
        Overall height, 2h.
    depth : float, m
        Base across the motion, default the width; affects the mass, and the base towards an azimuth.
    mass : float, kg
        Default: volume times density.
    density : float, kg/m^3
    centroid_height : float, m
        Height of the centre of gravity, default half the height.
    centroid_offset : float, m
        Offset of the centre of gravity to +x from the middle of the base.
    centroid_inertia : float, kg m^2
        Moment of inertia about the centre of gravity, default that of the homogeneous rectangle.
    inset : float, m
        Distance of the worn pivot edges from each side of the base, see :meth:`with_wear`; mass, centre and inertia are unchanged.
    name : str
    ranges : ParameterRanges or None
        Ranges of the block's kind; samples are drawn from them instead of varying by shares.
    stone_count : int
        Number of stones that it represents as one rigid block: those of a pile, else 1.

    Raises
    ------
    BodyError
        If a size, the mass or the inertia is not positive, or the centre of gravity does not lie above the base within its worn edges.

    Warns
    -----
    UserWarning
        If a length exceeds 20 m, which was probably meant in cm or mm.

    Examples
    --------
    >>> block = Block(width=0.242, height=0.726)
    >>> round(block.slenderness, 6), round(block.frequency_parameter(), 5)
    (0.321751, 4.38428)
    """

    width: float
    height: float
    depth: float | None = None
    mass: float | None = None
    density: float = DENSITY
    centroid_height: float | None = None
    centroid_offset: float = 0.0
    centroid_inertia: float | None = None
    name: str = N_("block")
    inset: float = 0.0
    ranges: ParameterRanges | None = field(default=None, repr=False)
    stone_count: int = field(default=1, repr=False)

    def __post_init__(self) -> None:
        for key, (label, unit) in _POSITIVE_FIELDS.items():
            value = getattr(self, key)
            if value is not None:
                checks.positive("{name}: {what}", value, unit, error=BodyError, name=self.name, what=label)
        if (
            self.width > MAX_UNITLESS_LENGTH
            or self.height > MAX_UNITLESS_LENGTH
            or (self.depth is not None and self.depth > MAX_UNITLESS_LENGTH)
        ):
            warn_large_lengths(
                self.name, width=self.width, height=self.height, depth=self.depth
            )  # cheap test first: blocks are built in inner loops
        if self.ranges is not None:
            checks.instance(self.ranges, ParameterRanges)
        half = self.width / 2
        if not 0.0 <= self.inset < half:
            text = "{name}: the inset must lie between 0 and half the width, {half:g} m; found {inset} m"
            raise BodyError(text, name=self.name, half=half, inset=self.inset)
        half -= self.inset
        if not abs(self.centroid_offset) < half:
            text = "{name}: the centre of gravity must lie above the base, within {half:g} m of its middle; found an offset of {offset} m"
            raise BodyError(text, name=self.name, half=half, offset=self.centroid_offset)
        if self.centroid_height is not None and self.centroid_height > self.height:
            text = "{name}: the height of the centre of gravity, {centre} m, exceeds the height of the block, {height} m"
            raise BodyError(text, name=self.name, centre=self.centroid_height, height=self.height)

    @property
    def total_mass(self) -> float:
        """Mass, given or from volume and density, kg."""
        if self.mass is not None:
            return self.mass
        return self.density * self.width * self.height * (self.width if self.depth is None else self.depth)

    @property
    def centre(self) -> float:
        """Height of the centre of gravity, given or half the height, m."""
        return self.height / 2 if self.centroid_height is None else self.centroid_height

    @property
    def gyration_squared(self) -> float:
        """Squared radius of gyration about the centre of gravity, m^2."""
        if self.centroid_inertia is not None:
            return self.centroid_inertia / self.total_mass
        return (self.width * self.width + self.height * self.height) / 12

    @property
    def arms(self) -> tuple[float, float]:
        """Horizontal distances from the right and the left lower corner (with edge wear) to the centre of gravity, m."""
        half = self.width / 2 - self.inset
        return half - self.centroid_offset, half + self.centroid_offset

    @property
    def radii(self) -> tuple[float, float]:
        """Distances R from the right and the left lower corner to the centre of gravity, m."""
        right, left = self.arms
        return math.hypot(right, self.centre), math.hypot(left, self.centre)

    @property
    def slendernesses(self) -> tuple[float, float]:
        """Angles alpha between the vertical and R at the right and the left lower corner, rad."""
        right, left = self.arms
        return math.atan2(right, self.centre), math.atan2(left, self.centre)

    @property
    def slenderness(self) -> float:
        """Smaller of the two angles alpha, rad."""
        return min(self.slendernesses)

    @property
    def radius(self) -> float:
        """Smaller of the two radii R, m."""
        return min(self.radii)

    @property
    def corner_inertias(self) -> tuple[float, float]:
        """Moments of inertia I_O about the right and the left lower corner, kg m^2."""
        right, left = (self.total_mass * (self.gyration_squared + radius * radius) for radius in self.radii)
        return right, left

    @property
    def restitutions(self) -> tuple[float, float]:
        """Ratios of angular velocities after and before an impact on the right and the left corner.

        See :func:`corner_restitution`; 1 - 1.5 sin^2(alpha) for a rectangle ([Housner1963]_; derived here).
        """
        onto_right, onto_left = (corner_restitution(radius, self.gyration_squared, self.centre, self.arms) for radius in self.radii)
        return onto_right, onto_left

    @property
    def restitution(self) -> float:
        """Larger of the two coefficients of restitution."""
        return max(self.restitutions)

    @property
    def lever_ratios(self) -> tuple[float, float]:
        """Lever ratio m R/I_O at the right and the left corner, 1/m: p^2 = g m R/I_O ([Furukawa2009]_ eq. (3))."""
        right, left = (lever_ratio(radius, self.gyration_squared) for radius in self.radii)
        return right, left

    def frequency_parameter(self, gravity: float = STANDARD_GRAVITY) -> float:
        """Return p = sqrt(m g R/I_O) of the side with the smaller alpha, rad/s ([Furukawa2009]_ eq. (3))."""
        side = RIGHT if self.slendernesses[RIGHT] <= self.slendernesses[LEFT] else LEFT
        return math.sqrt(gravity * self.lever_ratios[side])

    def with_wear(self, inset: EdgeWear | float) -> Block:
        """Return the block with worn edges: a share of the width per side, or an ``EdgeWear``.

        Examples
        --------
        >>> round(Block(0.24, 0.72).with_wear(0.1).rocking_threshold(9.0), 6)
        2.4
        """
        depth = (inset if isinstance(inset, EdgeWear) else EdgeWear(share=inset)).inset(self.width)
        return replace(self.without_ranges("inset_m"), inset=depth)

    def block_toward(self, azimuth: float) -> Block:
        """Return the equivalent block in the vertical plane at an azimuth from the width of the base.

        The pivots are the horizontal lines across the plane that touch the base, as for a scan: towards a corner the base of a square is
        1.41 times as wide. Out-of-plane rotation is neglected (derived here).

        The centre of gravity lies off the middle to the side of the azimuth: from 90 to 270 degrees the body stands turned round, so
        that the full circle has both of its orientations in every plane.

        Parameters
        ----------
        azimuth : float, degrees

        Returns
        -------
        Block

        Examples
        --------
        >>> round(Block(1.0, 2.0).block_toward(45.0).width, 6), Block(1.0, 2.0, depth=3.0).block_toward(90.0).width
        (1.414214, 3.0)
        """
        turn = math.radians(checks.finite("the azimuth", azimuth, "degrees"))
        # round-off of a quarter turn must not widen the base
        c, s = round(math.cos(turn), 15) + 0.0, round(math.sin(turn), 15) + 0.0
        depth = self.width if self.depth is None else self.depth
        if abs(c) == 1.0:
            return self
        widening = abs(c) + abs(s) * min(1.0, depth / self.width)
        ranges = self.ranges
        if ranges is not None and ranges.inset_m is not None:
            ranges = replace(ranges, width_m=None, inset_m=(widening * ranges.inset_m[0], widening * ranges.inset_m[1]))
        inertia = self.total_mass * (self.gyration_squared + s * s * (depth * depth - self.width * self.width) / 12)
        return replace(
            self,
            width=self.width * abs(c) + depth * abs(s),
            depth=self.width * abs(s) + depth * abs(c),
            mass=self.total_mass,
            centroid_offset=abs(c) * self.centroid_offset,
            centroid_inertia=inertia,
            inset=widening * self.inset,
            ranges=ranges,
        )

    def without_ranges(self, *names: str) -> Block:
        """Return the block without the ranges of the given parameters, whose values are known."""
        return self if self.ranges is None else replace(self, ranges=self.ranges.without(*names))

    def with_friction_range(self, limits: tuple[float, float]) -> Block:
        """Return the block with a range from which samples draw the friction."""
        return replace(self, ranges=replace(self.ranges or ParameterRanges(), mu=limits))

    def rocking_threshold(self, gravity: float = STANDARD_GRAVITY) -> float:
        """Return the ground acceleration at which rocking starts, g b/h, m/s^2 ([Furukawa2009]_ eq. (2))."""
        return gravity * min(self.arms) / self.centre


def lever_ratio(radius: Length, gyration_squared: Length) -> Length:
    """Return m R/I_O of a corner, 1/m ([Furukawa2009]_ eq. (3)), from R, m, and gyration radius squared, m^2."""
    return radius / (gyration_squared + radius * radius)


def corner_restitution(radius: Length, gyration_squared: Length, centre: Length, arms: tuple[Length, Length]) -> Length:
    """Return the ratio of angular velocities after and before an impact on a corner.

    Angular momentum about the struck corner is conserved ([Housner1963]_; derived here). Zero where the block is so wide that rocking
    stops.

    Parameters
    ----------
    radius : float or array, m
        R of the struck corner.
    gyration_squared, centre : float or array, m^2 and m
        Squared radius of gyration about the centre of gravity, and its height.
    arms : two floats or arrays, m
        Horizontal distances from the right and the left corner to the centre of gravity.
    """
    right, left = arms
    momentum = gyration_squared + centre * centre - right * left
    return 0.5 * (momentum + abs(momentum)) / (gyration_squared + radius * radius)


Restitution = float | tuple[float, float] | None
"""One ratio for both corners, (right, left) ratios, or None for conserved angular momentum."""


def resolve_restitutions(block: Block, restitution: Restitution) -> tuple[float, float]:
    """Return the coefficients of restitution of the right and the left corner."""
    if restitution is None:
        return block.restitutions
    return restitution if isinstance(restitution, tuple) else (restitution, restitution)


def from_slenderness(slenderness: float, frequency_parameter: float, gravity: float = STANDARD_GRAVITY) -> Block:
    """Return the homogeneous rectangular block of a given slenderness and frequency parameter ([Housner1963]_).

    Parameters
    ----------
    slenderness : float, rad
        alpha, between 0 and pi/2.
    frequency_parameter : float, rad/s
        p = sqrt(3 g/(4 R)), positive.
    gravity : float, m/s^2

    Returns
    -------
    Block

    Examples
    --------
    >>> from seisblock.bodies import from_slenderness
    >>> round(from_slenderness(0.3, 2.5).height, 3)
    2.248
    """
    checks.positive("the slenderness", slenderness, "rad", error=BodyError)
    checks.positive("the frequency parameter", frequency_parameter, "rad/s", error=BodyError)
    if slenderness >= math.pi / 2:
        raise BodyError("the slenderness must be below pi/2 rad, found {found}", found=slenderness)
    radius = 3 * gravity / (4 * frequency_parameter**2)
    return Block(2 * radius * math.sin(slenderness), 2 * radius * math.cos(slenderness))


def scale_block(block: Block, *, size: float = 1.0, slenderness: float = 1.0) -> Block:
    """Return a block with all lengths times `size`, and those along the motion also times `slenderness`.

    A given mass is unchanged, otherwise it follows from the volume; a given inertia keeps its radius of gyration
    times `size`.
    """

    def times(value: float | None, factor: float) -> float | None:
        return None if value is None else value * factor

    scaled_block = replace(
        block,
        width=block.width * size * slenderness,
        height=block.height * size,
        depth=times(block.depth, size),
        centroid_height=times(block.centroid_height, size),
        centroid_offset=block.centroid_offset * size * slenderness,
        centroid_inertia=None,
        inset=block.inset * size * slenderness,
        ranges=None,
    )
    if block.centroid_inertia is None:
        return scaled_block
    return replace(scaled_block, centroid_inertia=scaled_block.total_mass * (block.gyration_squared * (size * size)))
