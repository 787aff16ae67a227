"""Top of a pile as one rigid block."""

from __future__ import annotations

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.pile.pile import Pile


def rigid_top(body: Pile, points: int) -> Block:
    """Return the top stone and those dowelled to it as one rigid block on its outermost contact points.

    Parameters
    ----------
    body : Pile
    points : int
        Contact points along each side of the joint.
    """
    members = next(group for group in body.bodies() if len(body.stones) - 1 in group)
    stones = [body.stones[i] for i in members]
    centres = np.array([body.centres()[i] for i in members])
    masses = np.array([stone.mass for stone in stones])
    floor = float(centres[0, 2]) - 0.5 * stones[0].height
    x, _, z = masses @ centres / masses.sum()
    inertia = sum(
        m * (float(s.gyration_squared[1]) + (c[0] - x) ** 2 + (c[2] - z) ** 2) for m, s, c in zip(masses, stones, centres, strict=True)
    )
    return Block(
        stones[0].width,
        sum(stone.height for stone in stones),
        depth=stones[0].depth,
        mass=float(masses.sum()),
        centroid_height=float(z) - floor,
        centroid_offset=float(x - centres[0, 0]),
        centroid_inertia=float(inertia),
        name=stones[-1].name,
        inset=stones[0].insets()[0] if points == 2 else stones[0].width / (2.0 * points),
    )
