"""Corners, faces and edges of a box, sharp or worn, by number: it is a stack of two to four rings of four corners each.

Of the corners those of the lower face stand first, then those of the upper one, then those where bevels end on the sides, from below.
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import VECTOR
from seisblock.solvers.stack.contact import REL_D

_t = types()

RING = 4
"""Corners of a ring; and faces, and posts, between two of them."""

MOST_EDGES = 28
"""Edges of a box both of whose faces are worn."""

PLANE, OFFSET = 3, 3
"""Where a row keeps, behind a corner, the plane of a face; and a plane, behind its normal, how far out it lies."""


@kernel(_t.int64(_t.int64, _t.int64, _t.int64), inline=True)
def at_ring(level, q, count):
    """Return a corner of a ring, counted from below, of a box with so many: first stand those of its faces, then those of its sides."""
    first = 0 if level == 0 else RING if level == count // RING - 1 else RING * (level + 1)
    return first + q % RING


@kernel(_t.int64(_t.int64, _t.int64, _t.int64), inline=True)
def at_face(face, q, count):
    """Return a corner of a face: first stand those between the rings, from below, then the lower and the upper one."""
    if face >= count - RING:
        return at_ring(0 if face == count - RING else count // RING - 1, q, count)
    return at_ring(face // RING + (0 if q < 2 else 1), face % RING + (1 if q == 1 or q == 2 else 0), count)


@kernel(_t.UniTuple(_t.int64, 4)(_t.int64, _t.int64), inline=True)
def edge_of(edge, count):
    """Return the two corners of an edge, and the two faces that share it: first stand those of the rings, from below, then the posts."""
    level, q = edge // RING, edge % RING
    if edge < count:
        below = RING * (level - 1) + q if level > 0 else count - RING
        above = RING * level + q if level < count // RING - 1 else count - RING + 1
        return at_ring(level, q, count), at_ring(level, q + 1, count), below, above
    level -= count // RING
    return at_ring(level, q, count), at_ring(level + 1, q, count), RING * level + q, RING * level + (q + RING - 1) % RING


@kernel(_t.void(VECTOR, VECTOR, VECTOR), inline=True)
def see(rel, r, y):
    """Write where a point of the carrier is in the partner's axes."""
    for i in range(3):
        y[i] = rel[REL_D + i] + rel[3 * i] * r[0] + rel[3 * i + 1] * r[1] + rel[3 * i + 2] * r[2]


@kernel(_t.float64(VECTOR, VECTOR), inline=True)
def height(plane, y):
    """Return how far out of a plane a point is."""
    return plane[0] * y[0] + plane[1] * y[1] + plane[2] * y[2] - plane[OFFSET]
