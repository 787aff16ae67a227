"""The outsides of the stones: corners and edges of the boxes, circles of the round ones, worn where they stand."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from seisblock.bodies.pile.pile import Pile
from seisblock.solvers.stack.rings import PLANE
from seisblock.solvers.stack.round import RIMS
from seisblock.solvers.stack.step import ALL_EDGES
from seisblock.typing import FloatArray, IntArray

MOST_CORNERS = 16

INSIDE = math.sqrt(0.5)
"""Half the side of the square in a circle, over its radius."""

Worn = dict[tuple[int, int], tuple[float, float]]
"""How far in from its sides a stone's lower face, 0, or upper face, 1, is worn, along x and y, m."""

_SIGNS = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], dtype=np.float64)
_RINGS = [(i, (i + 1) % 4) for i in range(4)]


def hulls_of(body: Pile, boxes: FloatArray, worn: Worn) -> tuple[FloatArray, IntArray, IntArray, FloatArray, FloatArray]:
    """Return corners, with planes behind them, and edges of the boxes, how far their flat sides reach, and the circles of the round ones.

    A worn face has its corners that far in, at the outermost points, and a bevel of 45 degrees leads to the sides. Where it has tilted
    off its joint, a round stone meets others as the square prism inside it.
    """
    corners = np.zeros((len(boxes), MOST_CORNERS, PLANE + 4))
    counts = np.zeros(len(boxes), dtype=np.int64)
    edges = np.zeros((len(boxes), ALL_EDGES, 2), dtype=np.int64)
    cores = boxes[:, :3].copy()
    rims = np.zeros((len(boxes), RIMS, 2))
    for i, stone in enumerate(body.stones):
        radius, hz = boxes[i, [0, 2]].tolist()
        share = INSIDE if stone.is_round else 1.0
        cores[i, :2] *= share
        hx, hy = cores[i, :2].tolist()
        found: list[tuple[float, float, float]] = []
        posts = []
        for side, up in enumerate((-1.0, 1.0)):
            dx, dy = (share * inset for inset in worn.get((i, side), (0.0, 0.0)))
            found += [(sx * (hx - dx), sy * (hy - dy), up * hz) for sx, sy in _SIGNS]
            posts.append([4 * side + c for c in range(4)])
            if stone.is_round:
                rims[i, side] = radius - worn.get((i, side), (0.0, 0.0))[0], up * hz
        for side, up in enumerate((-1.0, 1.0)):
            if (i, side) in worn:
                bevel = min(*worn[i, side], 0.5 * hz)
                posts[side] = [len(found) + c for c in range(4)]
                found += [(sx * hx, sy * hy, up * (hz - bevel)) for sx, sy in _SIGNS]
                if stone.is_round:
                    rims[i, 2 + side] = radius, up * (hz - bevel)
        corners[i, : len(found), :PLANE] = found
        counts[i] = len(found)
        edges[i] = [*_RINGS, *[(4 + a, 4 + b) for a, b in _RINGS], *zip(*posts, strict=True)]
        corners[i, : len(found) - 2, PLANE:] = _planes(found)
    return corners, counts, edges, cores, rims


def _planes(found: list[tuple[float, float, float]]) -> list[tuple[float, float, float, float]]:
    """Return normals and offsets of the faces between rings of four corners, counted from below, and of the lower and the upper face."""
    # of each ring the corner where x and y are greatest
    rings = [found[2], *found[10::4], found[6]]
    planes = []
    for (x, y, z), (x1, y1, z1) in pairwise(rings):
        up, along_x, along_y = z1 - z, math.hypot(z1 - z, x - x1), math.hypot(z1 - z, y - y1)
        out_y = 0.0, up / along_y, (y - y1) / along_y, (up * y + (y - y1) * z) / along_y
        out_x = up / along_x, 0.0, (x - x1) / along_x, (up * x + (x - x1) * z) / along_x
        planes += [(0.0, -out_y[1], *out_y[2:]), out_x, out_y, (-out_x[0], *out_x[1:])]
    return [*planes, (0.0, 0.0, -1.0, -rings[0][2]), (0.0, 0.0, 1.0, rings[-1][2])]
