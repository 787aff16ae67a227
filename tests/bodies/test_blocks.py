"""Many blocks as arrays are, bit by bit, the blocks one by one."""

import numpy as np
import pytest

from seisblock.bodies.block import Block, scale_block
from seisblock.bodies.block_array import BlockArray, block_variants, rectangular_blocks, to_block_array
from seisblock.bodies.edge_wear import EdgeWear
from seisblock.core.errors import BodyError, ParameterError

RNG = np.random.default_rng(11)
STATUE = Block(0.4, 1.6, mass=300.0, centroid_height=0.9, centroid_offset=0.04, centroid_inertia=70.0, inset=0.01)


def assert_same(result: BlockArray, single: list[Block]):
    """Hold every array against the property of the same name of each block."""
    assert len(result) == len(single)
    for name in ("centre", "gyration_squared", "radii", "slendernesses", "lever_ratios", "restitutions"):
        np.testing.assert_array_equal(getattr(result, name), [getattr(block, name) for block in single], err_msg=name)
    np.testing.assert_array_equal(np.column_stack([result.right, result.left]), [block.arms for block in single])


@pytest.mark.parametrize("inset", [EdgeWear(), EdgeWear(share=0.1), EdgeWear(length_m=0.02, share=0.05)], ids=str)
def test_block_array_equals_single_rectangles(inset):
    """Widths and heights drawn at random, some of them wider than tall, where the restitution is zero."""
    widths, heights = RNG.uniform(0.1, 3.0, (2, 200))
    result = rectangular_blocks(widths, heights, inset)
    assert_same(result, [Block(float(w), float(h)).with_wear(inset) for w, h in zip(widths, heights, strict=True)])
    assert (result.restitutions == 0.0).any() and (result.restitutions > 0.9).any()


@pytest.mark.parametrize("block", [Block(0.24, 0.8), STATUE], ids=["rectangle", "statue"])
def test_block_array_equals_resized_and_worn_blocks(block):
    """Lengths by any factors, edges as they are or by a share of the new width; a given inertia keeps its radius of gyration, to an ulp."""
    size, wider, share = RNG.uniform(0.8, 1.2, 100), RNG.uniform(0.8, 1.2, 100), RNG.uniform(0.0, 0.1, 100)
    single = [scale_block(block, size=float(s), slenderness=float(q)) for s, q in zip(size, wider, strict=True)]
    worn = [item.with_wear(float(x)) for item, x in zip(single, share, strict=True)]
    for result, expected in (
        (block_variants(block, size=size, slenderness=wider), single),
        (block_variants(block, size=size, slenderness=wider, inset_share=share), worn),
    ):
        remaining = [item.gyration_squared for item in expected]
        np.testing.assert_allclose(result.gyration_squared, remaining, rtol=3e-16)
        assert_same(BlockArray(result.right, result.left, result.centre, np.array(remaining)), expected)


def test_block_array_from_blocks_keeps_order():
    """Any blocks, in their order."""
    subset = [Block(0.24, 0.8), STATUE, Block(3.0, 0.2)]
    assert_same(to_block_array(subset), subset)


def test_block_array_rejects_invalid_row_like_block():
    """The first invalid row gives the message."""
    with pytest.raises(BodyError, match=r"width must be positive.*-1"):
        rectangular_blocks([0.3, -1.0], [0.9, 0.9])
    with pytest.raises(ParameterError, match=r"is too large for a base 0\.3 m wide"):
        rectangular_blocks([0.9, 0.3], [0.9, 0.9], EdgeWear(length_m=0.2))
    with pytest.raises(BodyError, match="must lie above the base"):
        block_variants(STATUE, size=[1.0, 1.0], slenderness=[1.0, 1.0], inset_share=[0.1, 0.45])
