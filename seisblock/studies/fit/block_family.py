"""Family of blocks over the unit cube of free parameters, and their run-to-run perturbations."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from seisblock.bodies.block import Block, from_slenderness, scale_block
from seisblock.bodies.block_array import BlockArray, block_variants
from seisblock.core.typing import FloatArray
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.params import RockBatchParams, rock_batch_params
from seisblock.records import Motion
from seisblock.records._validation import Gain
from seisblock.studies.fit.priors import ALPHA, INSET, RESTITUTION, SCATTER, Prior
from seisblock.studies.fit.priors import P as FREQUENCY

PERTURBATION_COUNT = 5
"""Perturbed quantities: size, slenderness, restitution, amplitude and azimuth."""

PRIMES = (2, 3, 5, 7, 11)
"""At least as many as dimensions of a cube of blocks or of perturbations."""

AZIMUTH_DEG = 100.0
"""Half width of the azimuth, degrees, per relative half width of the others: 5 degrees beside 5 per cent, as in `rock`."""

MAX_RESTITUTION = 0.9999
"""Upper limit of a sampled restitution: at 1 a block would rock for ever."""

_BASE_BLOCK = from_slenderness(0.3, 5.0)
"""Rectangle scaled to alpha and p if no block is given; its own size is irrelevant."""


@dataclass(frozen=True)
class BlockFamily:
    """Blocks that differ in the free parameters only.

    Parameters
    ----------
    axes : tuple of Prior
        Free parameters.
    block : Block or None
        Nominal block; None: a homogeneous rectangle with free alpha and p.
    restitution : float or None
        Of every impact; None: conservation of angular momentum.
    inset : float, 1
        Edge wear, a share of the width per side, unless free.
    scatter : float, 1
        Relative half width of the run-to-run changes, unless free.
    vertical : bool, float or None
        True or a factor to apply the vertical component; None: where the record has one.
    gravity : float, m/s^2
    """

    axes: tuple[Prior, ...]
    block: Block | None
    restitution: float | None
    inset: float
    scatter: float
    vertical: Gain | None
    gravity: float

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the free parameters."""
        return tuple(axis.name for axis in self.axes)

    @property
    def is_worn(self) -> bool:
        """True if blocks rock about worn edges."""
        return INSET in self.names or self.inset > 0.0

    @property
    def sharp_block(self) -> Block:
        """Block with sharp edges, base of the family."""
        return replace(self.block or _BASE_BLOCK, inset=0.0)

    def values(self, unit_points: FloatArray) -> dict[str, FloatArray]:
        """Return the values of each free parameter at points of the unit cube, (n, d), by name."""
        return {axis.name: axis.value(unit_points[:, k]) for k, axis in enumerate(self.axes)}

    def blocks(self, unit_points: FloatArray, *, size: FloatArray | float = 1.0, slenderness: FloatArray | float = 1.0) -> BlockArray:
        """Return the blocks at some points, (n, d), with factors on their sizes and slendernesses.

        The nominal base is widened to the required tan(alpha), then the block is scaled to the required p, which is inversely
        proportional to the root of the size ([Furukawa2009]_ eq. (3)); both refer to sharp edges.
        """
        values = self.values(unit_points)
        zeros = np.zeros(len(unit_points))
        width_factor, size_factor = np.ones(len(unit_points)), np.ones(len(unit_points))
        base = self.sharp_block
        if ALPHA in values:
            width_factor = np.tan(values[ALPHA]) / np.tan(base.slenderness)
        if ALPHA in values or FREQUENCY in values:
            # alpha and p refer to the side of the smaller alpha
            weaker_side = base.slendernesses.index(base.slenderness)
            sharp_blocks = block_variants(base, size=np.ones(len(unit_points)), slenderness=width_factor, inset_share=zeros)
            target_p = values.get(FREQUENCY, base.frequency_parameter(self.gravity))
            size_factor = self.gravity * sharp_blocks.lever_ratios[:, weaker_side] / target_p**2
        inset_share = values.get(INSET, zeros + self.inset)
        return block_variants(base, size=size_factor * size, slenderness=width_factor * slenderness, inset_share=inset_share)

    def rocking_parameters(self, unit_points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return alpha, rad, and p, rad/s, of the worn blocks, on the side of the smaller alpha."""
        blocks = self.blocks(unit_points)
        weaker_side = blocks.slendernesses.argmin(axis=1)
        rows = np.arange(len(blocks))
        return blocks.slendernesses[rows, weaker_side], np.sqrt(self.gravity * blocks.lever_ratios[rows, weaker_side])

    def block_at(self, unit_point: FloatArray) -> Block:
        """Return the block at one point, (1, d), with its nominal sizes and inset."""
        base = self.sharp_block
        sharp_family = replace(self, axes=tuple(axis for axis in self.axes if axis.name != INSET), inset=0.0)
        sharp_blocks = sharp_family.blocks(unit_point[:, [k for k, name in enumerate(self.names) if name != INSET]])
        width_factor = (float(sharp_blocks.right[0]) / float(sharp_blocks.centre[0])) / (base.arms[0] / base.centre)
        block = scale_block(base, size=float(sharp_blocks.centre[0]) / base.centre, slenderness=width_factor)
        return block.with_wear(float(self.values(unit_point)[INSET][0]) if INSET in self.names else self.inset)

    def versions(self, unit_points: FloatArray, shifts: FloatArray, motion: Motion, scale: float) -> tuple[RockBatchParams, FloatArray]:
        """Return samples of blocks as rocking parameters under a motion, and the gains on its rows, (n, 3).

        Parameters
        ----------
        unit_points : (n, d) array, 1
            Points of the unit cube.
        shifts : (n, 5) array, 1
            Relative perturbations, -1 to 1.
        motion : Motion
        scale : float
            Factor on the ground acceleration.
        """
        values = self.values(unit_points)
        width = values.get(SCATTER, np.full(len(unit_points), self.scatter))
        size, slenderness, restitution_shift, amplitude, azimuth_shift = (width[:, None] * shifts).T
        params = rock_batch_params(
            self.blocks(unit_points, size=1.0 + size, slenderness=1.0 + slenderness),
            motion,
            options=RockOptions(vertical=self.vertical, gravity=self.gravity),
        )
        restitutions = params.restitutions
        if RESTITUTION in values:
            restitutions = np.repeat(values[RESTITUTION][:, None], 2, axis=1)
        elif self.restitution is not None:
            restitutions = np.full(restitutions.shape, self.restitution)
        params = replace(params, restitutions=np.minimum(restitutions * (1.0 + restitution_shift[:, None]), MAX_RESTITUTION))
        angle = np.radians(AZIMUTH_DEG * azimuth_shift) * bool(motion.transverse.any())
        factor = scale * (1.0 + amplitude)
        # +x rotated clockwise, seen from above
        return params, np.column_stack([factor * np.cos(angle), -factor * np.sin(angle), factor * params.vertical])


def quasi_random_points(count: int, dimensions: int) -> FloatArray:
    """Return low-discrepancy points of a unit cube, (count, dimensions): fractions of multiples of roots ([Richtmyer1951]_ method)."""
    roots = np.sqrt(np.array(PRIMES[:dimensions], dtype=np.float64))
    return np.arange(count, dtype=np.float64)[:, None] * roots % 1.0


def fixed_values(family: BlockFamily) -> Mapping[str, float | None]:
    """Return the values of the fixed parameters; a restitution of None is that of angular momentum."""
    sharp_block = family.sharp_block
    fixed = {
        ALPHA: sharp_block.slenderness,
        FREQUENCY: sharp_block.frequency_parameter(family.gravity),
        RESTITUTION: family.restitution,
        INSET: family.inset,
        SCATTER: family.scatter,
    }
    return {name: value for name, value in fixed.items() if name not in family.names}
