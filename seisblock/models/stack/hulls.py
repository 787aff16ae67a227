"""Hulls of the stones: corners, edges and face planes of boxes, bounding circles of cylinders, chamfered where worn."""

from __future__ import annotations

import math
from functools import cache
from itertools import pairwise

import numpy as np

from seisblock._jit import function_pointer
from seisblock.bodies.pile.pile import Pile
from seisblock.core.typing import FloatArray, IntArray
from seisblock.models.stack.buffers import (
    EDGE_EDGE_KERNEL,
    FACE_MANIFOLD_KERNEL,
    FACE_OVERLAP_KERNEL,
    SEPARATING_AXIS_KERNEL,
    ShapeKernels,
)
from seisblock.models.stack.chamfered_box import edge_edge_chamfered, separating_axis_chamfered
from seisblock.models.stack.chamfered_faces import face_manifold_chamfered
from seisblock.models.stack.cylinder import RIMS
from seisblock.models.stack.face_overlap import face_overlap_points
from seisblock.models.stack.mesh_topology import PLANE
from seisblock.models.stack.step import BOX_EDGES

MAX_CORNERS = 16

INSCRIBED_SQUARE_RATIO = math.sqrt(0.5)
"""Half side of the square inscribed in a circle over its radius."""

WearDepths = dict[tuple[int, int], tuple[float, float]]
"""Edge wear, m, along x and y, by stone and face (0 lower, 1 upper)."""

_SIGNS = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], dtype=np.float64)
_RINGS = [(i, (i + 1) % 4) for i in range(4)]


def build_hulls(body: Pile, boxes: FloatArray, wear: WearDepths) -> tuple[FloatArray, IntArray, IntArray, FloatArray, FloatArray]:
    """Return corners with face planes, their number, edges, half sizes and bounding circles of the boxes.

    A worn face has its corners moved inwards by the wear, and bevels of 45 degrees lead to the sides. Off its joint, a cylinder touches
    other stones as the inscribed square prism.
    """
    corners = np.zeros((len(boxes), MAX_CORNERS, PLANE + 4))
    counts = np.zeros(len(boxes), dtype=np.int64)
    edges = np.zeros((len(boxes), BOX_EDGES, 2), dtype=np.int64)
    cores = boxes[:, :3].copy()
    rims = np.zeros((len(boxes), RIMS, 2))
    for i, stone in enumerate(body.stones):
        radius, hz = boxes[i, [0, 2]].tolist()
        scale = INSCRIBED_SQUARE_RATIO if stone.is_round else 1.0
        cores[i, :2] *= scale
        hx, hy = cores[i, :2].tolist()
        points: list[tuple[float, float, float]] = []
        posts = []
        for side, up in enumerate((-1.0, 1.0)):
            dx, dy = (scale * inset for inset in wear.get((i, side), (0.0, 0.0)))
            points += [(sx * (hx - dx), sy * (hy - dy), up * hz) for sx, sy in _SIGNS]
            posts.append([4 * side + c for c in range(4)])
            if stone.is_round:
                rims[i, side] = radius - wear.get((i, side), (0.0, 0.0))[0], up * hz
        for side, up in enumerate((-1.0, 1.0)):
            if (i, side) in wear:
                # 45 degrees: as high as the smaller wear is deep, at most a quarter of the stone's height
                bevel = min(*wear[i, side], 0.5 * hz)
                posts[side] = [len(points) + c for c in range(4)]
                points += [(sx * hx, sy * hy, up * (hz - bevel)) for sx, sy in _SIGNS]
                if stone.is_round:
                    rims[i, 2 + side] = radius, up * (hz - bevel)
        corners[i, : len(points), :PLANE] = points
        counts[i] = len(points)
        edges[i] = [*_RINGS, *[(4 + a, 4 + b) for a, b in _RINGS], *zip(*posts, strict=True)]
        corners[i, : len(points) - 2, PLANE:] = _planes(points)
    return corners, counts, edges, cores, rims


@cache
def shape_kernels(*, has_worn: bool, has_round: bool) -> ShapeKernels:
    """Return the contact kernels of worn boxes and of cylinders; those of shapes that a pile does not have are not compiled."""
    return ShapeKernels(
        function_pointer(separating_axis_chamfered, SEPARATING_AXIS_KERNEL, is_called=has_worn),
        function_pointer(edge_edge_chamfered, EDGE_EDGE_KERNEL, is_called=has_worn),
        function_pointer(face_manifold_chamfered, FACE_MANIFOLD_KERNEL, is_called=has_worn),
        function_pointer(face_overlap_points, FACE_OVERLAP_KERNEL, is_called=has_round),
    )


def _planes(points: list[tuple[float, float, float]]) -> list[tuple[float, float, float, float]]:
    """Return normals and offsets of the faces: between rings of four corners, from below, then the lower and the upper face."""
    # of each ring the corner where x and y are greatest
    rings = [points[2], *points[10::4], points[6]]
    planes = []
    for (x, y, z), (x1, y1, z1) in pairwise(rings):
        up, along_x, along_y = z1 - z, math.hypot(z1 - z, x - x1), math.hypot(z1 - z, y - y1)
        out_y = 0.0, up / along_y, (y - y1) / along_y, (up * y + (y - y1) * z) / along_y
        out_x = up / along_x, 0.0, (x - x1) / along_x, (up * x + (x - x1) * z) / along_x
        planes += [(0.0, -out_y[1], *out_y[2:]), out_x, out_y, (-out_x[0], *out_x[1:])]
    return [*planes, (0.0, 0.0, -1.0, -rings[0][2]), (0.0, 0.0, 1.0, rings[-1][2])]
