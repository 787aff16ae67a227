"""The blocks that points of the unit cube stand for, and their versions: what differs from one run of an experiment to the next."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from seisblock.bodies.block import Block, from_slenderness, scale_block
from seisblock.bodies.block_array import BlockArray, block_variants
from seisblock.core.typing import FloatArray
from seisblock.models.rock.params import RockBatchParams, rock_batch_params
from seisblock.records import Motion
from seisblock.records._validation import Gain
from seisblock.studies.fit.priors import ALPHA, INSET, RESTITUTION, SCATTER, Prior
from seisblock.studies.fit.priors import P as FREQUENCY

PERTURBATION_COUNT = 5
"""What changes from run to run: size, slenderness, restitution, amplitude and azimuth."""

PRIMES = (2, 3, 5, 7, 11)
"""As many as there are directions of a cube at most, of blocks and of changes."""

AZIMUTH_DEG = 100.0
"""How far the azimuth turns at most, degrees, over the other changes, shares: 5 degrees beside 5 per cent, as in `rock`."""

MAX_RESTITUTION = 0.9999
"""No version loses less at an impact: it would rock on for ever."""

_BASE_BLOCK = from_slenderness(0.3, 5.0)
"""The rectangle that is made wider and larger where no block is given: whichever it is, its versions are the same."""


@dataclass(frozen=True)
class BlockFamily:
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

    axes: tuple[Prior, ...]
    block: Block | None
    restitution: float | None
    inset: float
    scatter: float
    vertical: Gain
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
    def sharp_block(self) -> Block:
        """The block with sharp edges from which the others are made."""
        return replace(self.block or _BASE_BLOCK, inset=0.0)

    def values(self, unit_points: FloatArray) -> dict[str, FloatArray]:
        """Return the values of each parameter that is looked for at points of the unit cube, (n, d), by its name."""
        return {axis.name: axis.value(unit_points[:, k]) for k, axis in enumerate(self.axes)}

    def blocks(self, unit_points: FloatArray, *, size: FloatArray | float = 1.0, slenderness: FloatArray | float = 1.0) -> BlockArray:
        """Return the blocks at some points, (n, d), their sizes and slendernesses times some factors.

        The base of the drawing is made wider until tan(alpha) is what is asked for, then all of it larger until p is, which goes as one
        over the root of the size ([Furukawa2009]_ eq. (3)); both are of sharp edges.
        """
        values = self.values(unit_points)
        zeros = np.zeros(len(unit_points))
        width_factor, size_factor = np.ones(len(unit_points)), np.ones(len(unit_points))
        base = self.sharp_block
        if ALPHA in values:
            width_factor = np.tan(values[ALPHA]) / np.tan(base.slenderness)
        if ALPHA in values or FREQUENCY in values:
            weaker_side = base.slendernesses.index(base.slenderness)
            sharp_blocks = block_variants(base, size=np.ones(len(unit_points)), slenderness=width_factor, inset_share=zeros)
            target_p = values.get(FREQUENCY, base.frequency_parameter(self.gravity))
            size_factor = self.gravity * sharp_blocks.lever_ratios[:, weaker_side] / target_p**2
        inset_share = values.get(INSET, zeros + self.inset)
        return block_variants(base, size=size_factor * size, slenderness=width_factor * slenderness, inset_share=inset_share)

    def rocking_parameters(self, unit_points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return alpha, rad, and p, rad/s, of the blocks as they turn, edges worn, to the side of the smaller alpha."""
        blocks = self.blocks(unit_points)
        weaker_side = blocks.slendernesses.argmin(axis=1)
        rows = np.arange(len(blocks))
        return blocks.slendernesses[rows, weaker_side], np.sqrt(self.gravity * blocks.lever_ratios[rows, weaker_side])

    def block_at(self, unit_point: FloatArray) -> Block:
        """Return the block at one point, (1, d), as a drawing with its inset."""
        base = self.sharp_block
        sharp_family = replace(self, axes=tuple(axis for axis in self.axes if axis.name != INSET), inset=0.0)
        sharp_blocks = sharp_family.blocks(unit_point[:, [k for k, name in enumerate(self.names) if name != INSET]])
        width_factor = (float(sharp_blocks.right[0]) / float(sharp_blocks.centre[0])) / (base.arms[0] / base.centre)
        block = scale_block(base, size=float(sharp_blocks.centre[0]) / base.centre, slenderness=width_factor)
        return block.with_wear(float(self.values(unit_point)[INSET][0]) if INSET in self.names else self.inset)

    def versions(self, unit_points: FloatArray, shifts: FloatArray, motion: Motion, scale: float) -> tuple[RockBatchParams, FloatArray]:
        """Return versions of blocks as they rock under a motion, and the factors on its rows, (n, 3).

        Parameters
        ----------
        unit_points : (n, d) array, 1
            Points of the unit cube.
        shifts : (n, 5) array, 1
            How far each of the changes goes, -1 to 1.
        motion : Motion
        scale : float
            Factor on the ground acceleration.
        """
        values = self.values(unit_points)
        width = values.get(SCATTER, np.full(len(unit_points), self.scatter))
        size, slenderness, restitution_shift, amplitude, azimuth_shift = (width[:, None] * shifts).T
        params = rock_batch_params(
            self.blocks(unit_points, size=1.0 + size, slenderness=1.0 + slenderness), motion, vertical=self.vertical, gravity=self.gravity
        )
        onto = params.restitutions
        if RESTITUTION in values:
            onto = np.repeat(values[RESTITUTION][:, None], 2, axis=1)
        elif self.restitution is not None:
            onto = np.full(onto.shape, self.restitution)
        params = replace(params, restitutions=np.minimum(onto * (1.0 + restitution_shift[:, None]), MAX_RESTITUTION))
        angle = np.radians(AZIMUTH_DEG * azimuth_shift) * bool(motion.transverse.any())
        factor = scale * (1.0 + amplitude)
        # +x turned clockwise, seen from above
        return params, np.column_stack([factor * np.cos(angle), -factor * np.sin(angle), factor * params.vertical])


def quasi_random_points(count: int, dimensions: int) -> FloatArray:
    """Return points that fill a unit cube evenly, (count, dimensions): fractions of multiples of roots ([Richtmyer1951]_ method)."""
    roots = np.sqrt(np.array(PRIMES[:dimensions], dtype=np.float64))
    return np.arange(count, dtype=np.float64)[:, None] * roots % 1.0


def fixed_values(family: BlockFamily) -> Mapping[str, float | None]:
    """Return the parameters that are not looked for, as they are; a restitution of None is that of angular momentum."""
    sharp_block = family.sharp_block
    fixed = {
        ALPHA: sharp_block.slenderness,
        FREQUENCY: sharp_block.frequency_parameter(family.gravity),
        RESTITUTION: family.restitution,
        INSET: family.inset,
        SCATTER: family.scatter,
    }
    return {name: value for name, value in fixed.items() if name not in family.names}
