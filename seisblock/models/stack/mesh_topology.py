"""Corners, faces and edges of a box by index, sharp or chamfered: two to four rings of four corners each.

Corners are ordered: lower face, upper face, then the rings where bevels end on the sides, from below.
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import VECTOR
from seisblock.models.stack.spring_contact import REL_D

_t = types()

RING_SIZE = 4
"""Corners of a ring; also the number of faces, and of posts, between two rings."""

MAX_EDGES = 28
"""Edges of a box with two worn faces."""

PLANE, OFFSET = 3, 3
"""Column of a face's plane behind a corner, and column of the offset behind a plane's normal."""


@kernel(_t.int64(_t.int64, _t.int64, _t.int64), inline=True)
def ring_corner(level, q, count):
    """Return the index of corner `q` of a ring, counted from below, of a box with `count` corners."""
    # the rings of the two faces come first in the order of corners, so a level is not a multiple of RING_SIZE
    first = 0 if level == 0 else RING_SIZE if level == count // RING_SIZE - 1 else RING_SIZE * (level + 1)
    return first + q % RING_SIZE


@kernel(_t.int64(_t.int64, _t.int64, _t.int64), inline=True)
def face_corner(face, q, count):
    """Return the index of corner `q` of a face; faces between the rings come first, from below, then the lower and the upper face."""
    if face >= count - RING_SIZE:
        return ring_corner(0 if face == count - RING_SIZE else count // RING_SIZE - 1, q, count)
    return ring_corner(face // RING_SIZE + (0 if q < 2 else 1), face % RING_SIZE + (1 if q == 1 or q == 2 else 0), count)


@kernel(_t.UniTuple(_t.int64, 4)(_t.int64, _t.int64), inline=True)
def edge_topology(edge, count):
    """Return two corners and two adjacent faces of an edge; edges of the rings come first, from below, then the posts."""
    level, q = edge // RING_SIZE, edge % RING_SIZE
    if edge < count:
        lower_face = RING_SIZE * (level - 1) + q if level > 0 else count - RING_SIZE
        upper_face = RING_SIZE * level + q if level < count // RING_SIZE - 1 else count - RING_SIZE + 1
        return ring_corner(level, q, count), ring_corner(level, q + 1, count), lower_face, upper_face
    level -= count // RING_SIZE
    return (
        ring_corner(level, q, count),
        ring_corner(level + 1, q, count),
        RING_SIZE * level + q,
        RING_SIZE * level + (q + RING_SIZE - 1) % RING_SIZE,
    )


@kernel(_t.void(VECTOR, VECTOR, VECTOR), inline=True)
def to_partner_axes(rel, r, y):
    """Write a point of the carrier in the partner's axes."""
    for i in range(3):
        y[i] = rel[REL_D + i] + rel[3 * i] * r[0] + rel[3 * i + 1] * r[1] + rel[3 * i + 2] * r[2]


@kernel(_t.float64(VECTOR, VECTOR), inline=True)
def plane_distance(plane, y):
    """Return the distance of a point beyond a plane, m."""
    return plane[0] * y[0] + plane[1] * y[1] + plane[2] * y[2] - plane[OFFSET]
