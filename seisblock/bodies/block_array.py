"""Arrays of rigid blocks for parameter studies."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from seisblock.bodies.block import Block, corner_restitution, lever_ratio, scale_block
from seisblock.bodies.edge_wear import SHARP_EDGES, EdgeWear
from seisblock.bodies.uncertainty import Range
from seisblock.core.typing import ArrayLike, FloatArray, IntArray

MAX_WEAR_SHARE = 0.8
"""Largest edge wear of an asymmetric block, a share of its smaller arm."""


@dataclass(frozen=True, eq=False)
class BlockArray:
    """Parameters of the motion of m rigid blocks; bitwise equal to those of ``Block``.

    Parameters
    ----------
    right, left : (m,) arrays, m
        Horizontal distances from the lower corners (with edge wear) to the centre of gravity.
    centre : (m,) array, m
        Height of the centre of gravity.
    gyration_squared : (m,) array, m^2
        Squared radius of gyration about the centre of gravity.
    """

    right: FloatArray
    left: FloatArray
    centre: FloatArray
    gyration_squared: FloatArray

    def __len__(self) -> int:
        return self.centre.size

    @property
    def columns(self) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """The four arrays in their order."""
        return self.right, self.left, self.centre, self.gyration_squared

    def __getitem__(self, index: slice | IntArray) -> BlockArray:
        """Return the selected blocks."""
        return BlockArray(*(column[index] for column in self.columns))

    @property
    def radii(self) -> FloatArray:
        """Distances R from the right and the left lower corner to the centre of gravity, (m, 2), m."""
        return np.column_stack([elementwise(math.hypot, arm, self.centre) for arm in (self.right, self.left)])

    @property
    def slendernesses(self) -> FloatArray:
        """Angles alpha between the vertical and R at the right and the left lower corner, (m, 2), rad."""
        return np.column_stack([elementwise(math.atan2, arm, self.centre) for arm in (self.right, self.left)])

    @property
    def lever_ratios(self) -> FloatArray:
        """Lever ratio m R/I_O at the right and the left corner, (m, 2), 1/m."""
        return lever_ratio(self.radii, self.gyration_squared[:, None])

    @property
    def restitutions(self) -> FloatArray:
        """Ratios of angular velocities after and before an impact on the right and the left corner, (m, 2)."""
        arms = self.right[:, None], self.left[:, None]
        return corner_restitution(self.radii, self.gyration_squared[:, None], self.centre[:, None], arms)


def elementwise(function: Callable[..., float], *columns: FloatArray) -> FloatArray:
    """Return an elementwise :mod:`math` function: numpy's differ in the last digit between machines."""
    return np.fromiter(map(function, *(column.ravel().tolist() for column in columns)), np.float64, columns[0].size)


def rectangular_blocks(widths: ArrayLike, heights: ArrayLike, inset: EdgeWear = SHARP_EDGES) -> BlockArray:
    """Return homogeneous rectangular blocks of given widths and heights, (m,), m, with the same edge wear.

    Raises
    ------
    BodyError, ParameterError
        If a size is not positive, or the inset leaves nothing of a base.

    Examples
    --------
    >>> rectangular_blocks([0.24, 0.3], [0.8, 0.9]).right.tolist()
    [0.12, 0.15]
    """
    width, height = (np.asarray(values, dtype=np.float64) for values in (widths, heights))
    depth = inset.length_m + inset.share * width
    for row in np.flatnonzero(~((width > 0.0) & (height > 0.0) & (depth < width / 2) & np.isfinite(width) & np.isfinite(height)))[:1]:
        Block(float(width[row]), float(height[row])).with_wear(inset)
    half = width / 2 - depth
    return BlockArray(half, half, height / 2, (width * width + height * height) / 12)


def block_variants(block: Block, *, size: ArrayLike, slenderness: ArrayLike, inset_share: ArrayLike | None = None) -> BlockArray:
    """Return a block scaled by arrays of factors, see :func:`~seisblock.bodies.block.scale_block`.

    Parameters
    ----------
    block : Block
    size, slenderness : (m,) arrays
        Factors on all lengths, and on those along the motion.
    inset_share : (m,) array or None
        Edge wear, a share of the width per side; default the block's own.

    Raises
    ------
    BodyError
        If no base is left below the centre of gravity.

    Examples
    --------
    >>> block_variants(Block(0.24, 0.8), size=[1.0, 2.0], slenderness=[1.0, 1.0]).centre.tolist()
    [0.4, 0.8]
    """
    size_factor, slenderness_factor = np.broadcast_arrays(*(np.asarray(values, dtype=np.float64) for values in (size, slenderness)))
    width, height = block.width * size_factor * slenderness_factor, block.height * size_factor
    offset = block.centroid_offset * size_factor * slenderness_factor
    inset = block.inset * size_factor * slenderness_factor if inset_share is None else np.asarray(inset_share, dtype=np.float64) * width
    centre = height / 2 if block.centroid_height is None else block.centroid_height * size_factor
    gyration = (width * width + height * height) / 12
    if block.centroid_inertia is not None:
        gyration = block.gyration_squared * (size_factor * size_factor)
    half = width / 2 - inset
    right, left = half - offset, half + offset
    for row in np.flatnonzero(~((right > 0.0) & (left > 0.0)))[:1]:
        sharp_block = replace(block, inset=0.0, centroid_offset=0.0)
        depth = float(inset[row]) / float(width[row])
        replace(
            scale_block(sharp_block, size=float(size_factor[row]), slenderness=float(slenderness_factor[row])).with_wear(depth),
            centroid_offset=float(offset[row]),
        )
    return BlockArray(right, left, centre, gyration)


def within(limits: Range, nominal: float, draws: FloatArray) -> FloatArray:
    """Map uniform draws in [-1, 1] to samples of a range whose median is the body's own value.

    The lower half of the draws maps uniformly to the interval from the smallest to the own value, the upper half to that up to the
    largest.

    Examples
    --------
    >>> within((0.2, 0.7), 0.4, np.array([-1.0, -0.5, 0.0, 0.5, 1.0])).round(2).tolist()
    [0.2, 0.3, 0.4, 0.55, 0.7]
    """
    low, high = min(limits[0], nominal), max(limits[1], nominal)
    return nominal + np.where(draws < 0.0, nominal - low, high - nominal) * draws


def samples(block: Block, tolerance: float, *, wide: FloatArray, tall: FloatArray, worn: FloatArray) -> BlockArray:
    """Return samples of a block: scaled widths and heights, edge wear from its prior or around its own inset.

    Parameters
    ----------
    block : Block
        Median of the samples.
    tolerance : float
        Half width of a known inset, a share of the inset; see :func:`wear_range`.
    wide, tall : (m,) arrays
        Factors on all lengths along the motion, and on all heights.
    worn : (m,) array
        Draws in [-1, 1] for the edge wear of each sample within its range.
    """
    return block_variants(block, size=tall, slenderness=wide / tall, inset_share=wear_shares(block, tolerance, worn))


def wear_shares(block: Block, tolerance: float, worn: FloatArray) -> FloatArray:
    """Return the edge wear of samples of a block, shares of the width per side, (m,); see :func:`samples`."""
    return within(wear_range(block, tolerance), block.inset / block.width, worn)


def wear_within(block: Block, share: float) -> float:
    """Return the default edge wear of a block, a share of its width per side.

    Smaller than the share of the kind for a strongly asymmetric block, whose base would hardly reach below its centre of gravity: a
    standing block cannot be worn so far.

    Examples
    --------
    >>> wear_within(Block(0.2, 0.6), 0.1), round(wear_within(Block(0.2, 0.6, centroid_offset=0.09), 0.1), 6)
    (0.1, 0.04)
    """
    if block.centroid_offset == 0.0:
        return share
    smaller = 0.5 - abs(block.centroid_offset) / block.width
    return min(share, max(MAX_WEAR_SHARE * smaller, block.inset / block.width))


def wear_range(block: Block, tolerance: float) -> Range:
    """Return the smallest and the largest inset of the samples of a block, shares of its width per side.

    A known inset varies by a share of the inset, so that sharp edges stay sharp; an unknown inset has the range of the kind. At least a
    fifth of the base remains. A tolerance of 0 means that the inset is known exactly.

    Examples
    --------
    >>> [[round(end, 3) for end in wear_range(Block(0.2, 0.6).with_wear(own), 0.1)] for own in (0.0, 0.1, 0.48)]
    [[0.0, 0.0], [0.09, 0.11], [0.464, 0.496]]
    >>> from seisblock.bodies.uncertainty import ParameterRanges
    >>> [round(end, 3) for end in wear_range(Block(0.2, 0.6, inset=0.01, ranges=ParameterRanges(inset_m=(0.0, 0.02))), 0.1)]
    [0.0, 0.1]
    """
    nominal = block.inset / block.width
    max_change = MAX_WEAR_SHARE * (0.5 - abs(block.centroid_offset) / block.width - nominal)
    limits = None if block.ranges is None else block.ranges.inset_m
    if limits is None or tolerance == 0.0:
        half = min(tolerance * nominal, max_change)
        return nominal - half, nominal + half
    low, high = (end / block.width for end in limits)
    return min(low, nominal), max(nominal, min(high, nominal + max_change))


def to_block_array(blocks: Sequence[Block]) -> BlockArray:
    """Return the blocks as one array."""
    rows = [(*block.arms, block.centre, block.gyration_squared) for block in blocks]
    right, left, centre, gyration = np.array(rows, dtype=np.float64).reshape(-1, 4).T
    return BlockArray(right, left, centre, gyration)
