"""The blocks that points of the unit cube stand for, and their versions: what differs from one run of an experiment to the next."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from seisblock.bodies.block import Block, from_slenderness, resized
from seisblock.bodies.blocks import Blocks, versions
from seisblock.records import Motion
from seisblock.records.given import Factor
from seisblock.solvers.rock.rocker import Rockers, rockers
from seisblock.studies.fit.axes import ALPHA, INSET, RESTITUTION, SCATTER, Axis
from seisblock.studies.fit.axes import P as FREQUENCY
from seisblock.typing import FloatArray

CHANGES = 5
"""What changes from run to run: size, slenderness, restitution, amplitude and azimuth."""

PRIMES = (2, 3, 5, 7, 11)
"""As many as there are directions of a cube at most, of blocks and of changes."""

AZIMUTH_DEG = 100.0
"""How far the azimuth turns at most, degrees, over the other changes, shares: 5 degrees beside 5 per cent, as in `rock`."""

BOUNCIEST = 0.9999
"""No version loses less at an impact: it would rock on for ever."""

_BEGIN = from_slenderness(0.3, 5.0)
"""The rectangle that is made wider and larger where no block is given: whichever it is, its versions are the same."""


@dataclass(frozen=True)
class Family:
    """Blocks that differ in what is looked for, all else as given.

    Parameters
    ----------
    axes : tuple of Axis
        What is looked for.
    block : Block or None
        The drawing; None: a homogeneous rectangle, of which alpha and p are looked for.
    restitution : float or None
        Of every impact; None: what angular momentum leaves.
    inset : float, 1
        How far the edges are worn, a share of the width per side, where that is not looked for.
    scatter : float, 1
        Half width of the changes, a share, where that is not looked for.
    vertical : bool or float
        Whether the vertical component acts, or a factor on it.
    gravity : float, m/s^2
    """

    axes: tuple[Axis, ...]
    block: Block | None
    restitution: float | None
    inset: float
    scatter: float
    vertical: Factor
    gravity: float

    @property
    def names(self) -> tuple[str, ...]:
        """Names of what is looked for."""
        return tuple(axis.name for axis in self.axes)

    @property
    def is_worn(self) -> bool:
        """Whether blocks turn about other edges than those of the drawing."""
        return INSET in self.names or self.inset > 0.0

    @property
    def drawing(self) -> Block:
        """The block with sharp edges from which the others are made."""
        return replace(self.block or _BEGIN, inset=0.0)

    def values(self, places: FloatArray) -> dict[str, FloatArray]:
        """Return the values of each parameter that is looked for at points of the unit cube, (n, d), by its name."""
        return {axis.name: axis.value(places[:, k]) for k, axis in enumerate(self.axes)}

    def blocks(self, places: FloatArray, *, size: FloatArray | float = 1.0, slenderness: FloatArray | float = 1.0) -> Blocks:
        """Return the blocks at some points, (n, d), their sizes and slendernesses times some factors.

        The base of the drawing is made wider until tan(alpha) is what is asked for, then all of it larger until p is, which goes as one
        over the root of the size ([Furukawa2009]_ eq. (3)); both are of sharp edges.
        """
        found = self.values(places)
        nothing = np.zeros(len(places))
        wider, larger = np.ones(len(places)), np.ones(len(places))
        drawing = self.drawing
        if ALPHA in found:
            wider = np.tan(found[ALPHA]) / np.tan(drawing.slenderness)
        if ALPHA in found or FREQUENCY in found:
            weaker = drawing.slendernesses.index(drawing.slenderness)
            sharp = versions(drawing, size=np.ones(len(places)), slenderness=wider, inset_share=nothing)
            asked = found.get(FREQUENCY, drawing.frequency_parameter(self.gravity))
            larger = self.gravity * sharp.lever_ratios[:, weaker] / asked**2
        worn = found.get(INSET, nothing + self.inset)
        return versions(drawing, size=larger * size, slenderness=wider * slenderness, inset_share=worn)

    def turning(self, places: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return alpha, rad, and p, rad/s, of the blocks as they turn, edges worn, to the side of the smaller alpha."""
        blocks = self.blocks(places)
        weaker = blocks.slendernesses.argmin(axis=1)
        rows = np.arange(len(blocks))
        return blocks.slendernesses[rows, weaker], np.sqrt(self.gravity * blocks.lever_ratios[rows, weaker])

    def block_at(self, place: FloatArray) -> Block:
        """Return the block at one point, (1, d), as a drawing with its inset."""
        drawing = self.drawing
        sharp = replace(self, axes=tuple(axis for axis in self.axes if axis.name != INSET), inset=0.0)
        bare = sharp.blocks(place[:, [k for k, name in enumerate(self.names) if name != INSET]])
        wider = (float(bare.right[0]) / float(bare.centre[0])) / (drawing.arms[0] / drawing.centre)
        made = resized(drawing, size=float(bare.centre[0]) / drawing.centre, slenderness=wider)
        return made.worn(float(self.values(place)[INSET][0]) if INSET in self.names else self.inset)

    def versions(self, places: FloatArray, shifts: FloatArray, motion: Motion, scale: float) -> tuple[Rockers, FloatArray]:
        """Return versions of blocks as they rock under a motion, and the factors on its rows, (n, 3).

        Parameters
        ----------
        places : (n, d) array, 1
            Points of the unit cube.
        shifts : (n, 5) array, 1
            How far each of the changes goes, -1 to 1.
        motion : Motion
        scale : float
            Factor on the ground acceleration.
        """
        found = self.values(places)
        width = found.get(SCATTER, np.full(len(places), self.scatter))
        size, slenderness, bounce, amplitude, turn = (width[:, None] * shifts).T
        some = rockers(
            self.blocks(places, size=1.0 + size, slenderness=1.0 + slenderness), motion, vertical=self.vertical, gravity=self.gravity
        )
        onto = some.onto
        if RESTITUTION in found:
            onto = np.repeat(found[RESTITUTION][:, None], 2, axis=1)
        elif self.restitution is not None:
            onto = np.full(onto.shape, self.restitution)
        some = replace(some, onto=np.minimum(onto * (1.0 + bounce[:, None]), BOUNCIEST))
        angle = np.radians(AZIMUTH_DEG * turn) * bool(motion.transverse.any())
        factor = scale * (1.0 + amplitude)
        # +x turned clockwise, seen from above
        return some, np.column_stack([factor * np.cos(angle), -factor * np.sin(angle), factor * some.vertical])


def spread_evenly(count: int, dimensions: int) -> FloatArray:
    """Return points that fill a unit cube evenly, (count, dimensions): fractions of multiples of roots ([Richtmyer1951]_ method)."""
    roots = np.sqrt(np.array(PRIMES[:dimensions], dtype=np.float64))
    return np.arange(count, dtype=np.float64)[:, None] * roots % 1.0


def fixed_values(family: Family) -> Mapping[str, float | None]:
    """Return the parameters that are not looked for, as they are; a restitution of None is that of angular momentum."""
    drawing = family.drawing
    fixed = {
        ALPHA: drawing.slenderness,
        FREQUENCY: drawing.frequency_parameter(family.gravity),
        RESTITUTION: family.restitution,
        INSET: family.inset,
        SCATTER: family.scatter,
    }
    return {name: value for name, value in fixed.items() if name not in family.names}
