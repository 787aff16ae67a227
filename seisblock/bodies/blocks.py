"""Many blocks at once, as arrays: what studies vary, without an object for each."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from seisblock.bodies.block import Block, lever_ratio, resized, restitution_onto
from seisblock.bodies.inset import SHARP, Inset
from seisblock.bodies.ranges import Ranges, within
from seisblock.typing import ArrayLike, FloatArray, IntArray

MOST_WORN = 0.8
"""Of the smaller arm of a block whose two sides differ, that its edges may be worn by."""


@dataclass(frozen=True, eq=False)
class Blocks:
    """What the motion of each of many rigid blocks depends on; bit by bit what :class:`~seisblock.bodies.block.Block` says of one.

    Parameters
    ----------
    right, left : (m,) arrays, m
        Horizontal distances from the lower corners, worn as they are, to the centre of gravity.
    centre : (m,) array, m
        Its height.
    gyration_squared : (m,) array, m^2
        Squared radius of gyration about it.
    """

    right: FloatArray
    left: FloatArray
    centre: FloatArray
    gyration_squared: FloatArray

    def __len__(self) -> int:
        return self.centre.size

    @property
    def columns(self) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """The four arrays, in their order."""
        return self.right, self.left, self.centre, self.gyration_squared

    def __getitem__(self, part: slice | IntArray) -> Blocks:
        """Return some of them."""
        return Blocks(*(column[part] for column in self.columns))

    @property
    def radii(self) -> FloatArray:
        """Distances R from the right and the left lower corner to the centre of gravity, (m, 2), m."""
        return np.column_stack([each(math.hypot, arm, self.centre) for arm in (self.right, self.left)])

    @property
    def slendernesses(self) -> FloatArray:
        """Angles alpha between the vertical and R at the right and the left lower corner, (m, 2), rad."""
        return np.column_stack([each(math.atan2, arm, self.centre) for arm in (self.right, self.left)])

    @property
    def lever_ratios(self) -> FloatArray:
        """Mass times R over I_O, at the right and the left corner, (m, 2), 1/m."""
        return lever_ratio(self.radii, self.gyration_squared[:, None])

    @property
    def restitutions(self) -> FloatArray:
        """Angular velocity after an impact over that before, onto the right and onto the left corner, (m, 2)."""
        arms = self.right[:, None], self.left[:, None]
        return restitution_onto(self.radii, self.gyration_squared[:, None], self.centre[:, None], arms)


def each(function: Callable[..., float], *columns: FloatArray) -> FloatArray:
    """Return a function of :mod:`math` of every element: numpy's own differ from it in the last digit, from machine to machine."""
    return np.fromiter(map(function, *(column.ravel().tolist() for column in columns)), np.float64, columns[0].size)


def rectangles(widths: ArrayLike, heights: ArrayLike, inset: Inset = SHARP) -> Blocks:
    """Return homogeneous rectangular blocks of some widths and heights, (m,) each, m, with edges worn alike.

    Raises
    ------
    BodyError, ParameterError
        If a size is not positive, or the inset leaves nothing of a base.

    Examples
    --------
    >>> rectangles([0.24, 0.3], [0.8, 0.9]).right.tolist()
    [0.12, 0.15]
    """
    width, height = (np.asarray(values, dtype=np.float64) for values in (widths, heights))
    depth = inset.length_m + inset.share * width
    for row in np.flatnonzero(~((width > 0.0) & (height > 0.0) & (depth < width / 2) & np.isfinite(width) & np.isfinite(height)))[:1]:
        Block(float(width[row]), float(height[row])).worn(inset)
    half = width / 2 - depth
    return Blocks(half, half, height / 2, (width * width + height * height) / 12)


def versions(block: Block, *, size: ArrayLike, slenderness: ArrayLike, inset_share: ArrayLike | None = None) -> Blocks:
    """Return a block with its lengths multiplied, as :func:`~seisblock.bodies.block.resized` does, by each of some factors.

    Parameters
    ----------
    block : Block
    size, slenderness : (m,) arrays
        Factors on all lengths, and on those along the motion.
    inset_share : (m,) array or None
        How far the edges are worn, a share of the width per side; as the block's own when left out.

    Raises
    ------
    BodyError
        If nothing is left of a base below the centre of gravity.

    Examples
    --------
    >>> versions(Block(0.24, 0.8), size=[1.0, 2.0], slenderness=[1.0, 1.0]).centre.tolist()
    [0.4, 0.8]
    """
    larger, wider = np.broadcast_arrays(*(np.asarray(values, dtype=np.float64) for values in (size, slenderness)))
    width, height = block.width * larger * wider, block.height * larger
    offset = block.centroid_offset * larger * wider
    inset = block.inset * larger * wider if inset_share is None else np.asarray(inset_share, dtype=np.float64) * width
    centre = height / 2 if block.centroid_height is None else block.centroid_height * larger
    gyration = (width * width + height * height) / 12
    if block.centroid_inertia is not None:
        gyration = block.gyration_squared * (larger * larger)
    half = width / 2 - inset
    right, left = half - offset, half + offset
    for row in np.flatnonzero(~((right > 0.0) & (left > 0.0)))[:1]:
        sharp = replace(block, inset=0.0, centroid_offset=0.0)
        depth = float(inset[row]) / float(width[row])
        replace(resized(sharp, size=float(larger[row]), slenderness=float(wider[row])).worn(depth), centroid_offset=float(offset[row]))
    return Blocks(right, left, centre, gyration)


def versions_within(
    block: Block, known: Ranges, *, tall: FloatArray, wide: FloatArray, worn: FloatArray, size: float, inset: FloatArray
) -> Blocks:
    """Return versions of a block within the ranges of its kind, their width, height and edges drawn independently of each other.

    Parameters
    ----------
    block : Block
    known : Ranges
    tall, wide, worn : (m,) arrays
        In [-1, 1]: the height, the width and the worn edges of each version within their ranges.
    size : float
        How far, a share, a width or height differs for which there is no range.
    inset : (m,) array
        Edges where there is no range for them, a share of the width per side.
    """
    heights = block.height * (1.0 + size * tall) if known.height_m is None else within(known.height_m, tall)
    widths = block.width * (1.0 + size * wide) if known.width_m is None else within(known.width_m, wide)
    larger = heights / block.height
    share = inset if known.inset_m is None else within(known.inset_m, worn) / widths
    return versions(block, size=larger, slenderness=widths / block.width / larger, inset_share=share)


def wear_within(block: Block, share: float) -> float:
    """Return how far versions of a block may be worn, a share of its width per side.

    Less than asked where its two sides differ so much that hardly anything would be left under its centre of gravity: what stands is not
    worn like that.

    Examples
    --------
    >>> wear_within(Block(0.2, 0.6), 0.1), round(wear_within(Block(0.2, 0.6, centroid_offset=0.09), 0.1), 6)
    (0.1, 0.04)
    """
    if block.centroid_offset == 0.0:
        return share
    smaller = 0.5 - abs(block.centroid_offset) / block.width
    return min(share, max(MOST_WORN * smaller, block.inset / block.width))


def deepest_within(block: Block, share: float) -> float:
    """Return the deepest that versions of a block are worn which begin with sharp edges: never less than it is itself, a share.

    Examples
    --------
    >>> deepest_within(Block(0.2, 0.6), 0.1), round(deepest_within(Block(0.2, 0.6).worn(0.3), 0.1), 6)
    (0.1, 0.3)
    """
    return max(wear_within(block, share), block.inset / block.width)


def wear_range(block: Block, share: float) -> tuple[float, float]:
    """Return between which shares of its width per side versions of a block are worn, from sharp edges to `share`.

    A block that is itself worn by more differs from that by half of `share`, and by no more than leaves a fifth of what it stands on.

    Examples
    --------
    >>> [[round(end, 3) for end in wear_range(Block(0.2, 0.6).worn(own), 0.1)] for own in (0.0, 0.1, 0.3, 0.48)]
    [[0.0, 0.1], [0.0, 0.1], [0.25, 0.35], [0.464, 0.496]]
    """
    own = block.inset / block.width
    return range_about(own, wear_within(block, share), 0.5 - abs(block.centroid_offset) / block.width - own)


def range_about(own: float, deepest: float, left: float) -> tuple[float, float]:
    """Return between which shares versions are worn of what is itself worn by one share, and has another one left to stand on.

    Examples
    --------
    >>> [range_about(own, 0.1, 0.5 - own) for own in (0.0, 0.25)]
    [(0.0, 0.1), (0.2, 0.3)]
    """
    if own <= deepest or math.isclose(own, deepest):
        return 0.0, deepest
    half = min(0.5 * deepest, MOST_WORN * left)
    return own - half, own + half


def gathered(blocks: Sequence[Block]) -> Blocks:
    """Return some blocks as arrays."""
    rows = [(*block.arms, block.centre, block.gyration_squared) for block in blocks]
    right, left, centre, gyration = np.array(rows, dtype=np.float64).reshape(-1, 4).T
    return Blocks(right, left, centre, gyration)
