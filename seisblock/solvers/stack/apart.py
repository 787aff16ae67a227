"""Along which axis two boxes with sharp edges are furthest apart, and where they would meet along it.

Convex bodies stay apart as long as they stay apart along one axis: a normal of a face of either, or a perpendicular to an edge of each
([Gottschalk1996]_ section 5). The one along which the gap is widest is taken, anew in each step. Where it changes, the gap along the new
one is no narrower, so that stones which were apart need never be pushed out of each other; that would be energy from nowhere. All their
points share the one normal, and can not jam each other.

They meet where the face that shows most against the axis lies over the face whose normal it is, or where one edge crosses the other.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import MATRIX, VECTOR
from seisblock.solvers.stack.contact import REL_D

_t = types()

KIND = 3
"""Where an axis, whose first three numbers are the normal out of the partner, keeps its kind."""

CARRIERS, EDGES = 14, 28
"""The first kind that is a face of the carrier, those of the partner standing before; and the first that is an edge of the partner and
one of the carrier."""

FACE = 4
"""Where the axis of the widest gap along a normal of a face stands behind the axis of the widest of all."""

FAVOUR = 1e-5
"""How much wider, m, a gap must be along the carrier's normals than along the partner's, and across edges than along either. Of edges the
widest is taken: the others do not cross."""

PARALLEL = 1e-8
"""Square of the sine of the angle below which edges are parallel."""

OVERHANG = 1e-5
"""How far, m, beyond the border of a face, or the end of an edge, a point may lie and count as on it."""

MOST_POINTS = 9


@kernel(_t.float64(_t.float64, _t.float64, _t.float64, VECTOR), inline=True)
def _reach(x, y, z, half):
    """Return how far a box reaches along a direction in its own axes."""
    return abs(x) * half[0] + abs(y) * half[1] + abs(z) * half[2]


@kernel(_t.void(_t.float64, _t.float64, _t.float64, _t.int64, VECTOR), inline=True)
def _take(x, y, z, kind, axis):
    axis[0] = x
    axis[1] = y
    axis[2] = z
    axis[KIND] = kind


@kernel(_t.float64(VECTOR, VECTOR, VECTOR, _t.float64, VECTOR))
def furthest(rel, own, half, enough, axis):
    """Return the widest gap between two boxes, m, negative where they overlap, and write its axis.

    Parameters
    ----------
    rel : (18,) array
        The carrier as the partner sees it.
    own, half : (3,) arrays, m
        Half sizes of the carrier, and of the partner.
    enough : float, m
        A gap along a face's normal beyond which edges need not be looked at.
    axis : (8,) array
        Normal out of the partner, in its axes, and the kind; and the same of faces alone.
    """
    d0, d1, d2 = rel[REL_D], rel[REL_D + 1], rel[REL_D + 2]
    widest = -math.inf
    for i in range(3):
        d = rel[REL_D + i]
        side = 1.0 if d > 0.0 else -1.0
        gap = side * d - half[i] - _reach(rel[3 * i], rel[3 * i + 1], rel[3 * i + 2], own)
        if gap > widest:
            widest = gap
            _take(side if i == 0 else 0.0, side if i == 1 else 0.0, side if i == 2 else 0.0, i, axis)
    for j in range(3):
        x, y, z = rel[j], rel[3 + j], rel[6 + j]
        d = x * d0 + y * d1 + z * d2
        side = 1.0 if d > 0.0 else -1.0
        gap = side * d - own[j] - _reach(x, y, z, half)
        if gap > widest + FAVOUR:
            widest = gap
            _take(side * x, side * y, side * z, CARRIERS + j, axis)
    for k in range(KIND + 1):
        axis[FACE + k] = axis[k]
    if widest > enough:
        return widest
    least = widest + FAVOUR
    for i in range(3):
        for j in range(3):
            x, y, z = rel[j], rel[3 + j], rel[6 + j]
            if i == 0:
                x, y, z = 0.0, -z, y
            elif i == 1:
                x, y, z = z, 0.0, -x
            else:
                x, y, z = -y, x, 0.0
            square = x * x + y * y + z * z
            if square < PARALLEL:
                continue
            d = x * d0 + y * d1 + z * d2
            scale = (1.0 if d > 0.0 else -1.0) / math.sqrt(square)
            x, y, z = scale * x, scale * y, scale * z
            a = x * rel[0] + y * rel[3] + z * rel[6]
            b = x * rel[1] + y * rel[4] + z * rel[7]
            c = x * rel[2] + y * rel[5] + z * rel[8]
            gap = scale * d - _reach(x, y, z, half) - _reach(a, b, c, own)
            if gap > least:
                widest = least = gap
                _take(x, y, z, EDGES + 3 * i + j, axis)
    return widest


@kernel(_t.boolean(VECTOR, VECTOR, VECTOR, VECTOR, VECTOR))
def cross(rel, own, half, axis, y):
    """Write the point of the carrier's edge nearest to the partner's, in the partner's axes; return whether the edges cross there."""
    i, j = (int(axis[KIND]) - EDGES) // 3, (int(axis[KIND]) - EDGES) % 3
    a0, a1, a2 = rel[REL_D], rel[REL_D + 1], rel[REL_D + 2]
    for k in range(3):
        if k != j:
            along = axis[0] * rel[k] + axis[1] * rel[3 + k] + axis[2] * rel[6 + k]
            side = -own[k] if along > 0.0 else own[k]
            a0 += side * rel[k]
            a1 += side * rel[3 + k]
            a2 += side * rel[6 + k]
    b0 = 0.0 if i == 0 else half[0] if axis[0] > 0.0 else -half[0]
    b1 = 0.0 if i == 1 else half[1] if axis[1] > 0.0 else -half[1]
    b2 = 0.0 if i == 2 else half[2] if axis[2] > 0.0 else -half[2]
    x, z, t = rel[j], rel[6 + j], rel[3 + j]
    r0, r1, r2 = a0 - b0, a1 - b1, a2 - b2
    cosine = rel[3 * i + j]
    along_partner = r0 if i == 0 else r1 if i == 1 else r2
    along_carrier = r0 * x + r1 * t + r2 * z
    rest = 1.0 / (1.0 - cosine * cosine)
    place = (cosine * along_partner - along_carrier) * rest
    other = along_partner + place * cosine
    y[0] = a0 + place * x
    y[1] = a1 + place * t
    y[2] = a2 + place * z
    return abs(place) < own[j] + OVERHANG and abs(other) < half[i] + OVERHANG


@kernel(_t.int64(_t.int64, MATRIX, _t.int64, _t.float64, _t.float64, MATRIX))
def _clip(n, found, k, side, limit, left):
    """Cut a polygon off beyond side y_k = limit; return how many corners are left."""
    count = 0
    for i in range(n):
        one, two = found[i], found[(i + 1) % n]
        a, b = limit - side * one[k], limit - side * two[k]
        if a >= 0.0:
            for m in range(3):
                left[count, m] = one[m]
            count += 1
        if (a >= 0.0) != (b >= 0.0):
            part = a / (a - b)
            for m in range(3):
                left[count, m] = one[m] + part * (two[m] - one[m])
            count += 1
    return count


@kernel(_t.int64(VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, MATRIX, MATRIX))
def overlap(rel, own, half, axis, view, found, spare):
    """Write where two faces lie over each other: x, y, z in the partner's axes, and the gap there; return how many points.

    Parameters
    ----------
    rel : (18,) array
    own, half : (3,) arrays, m
    axis : (4,) array
        A normal of a face.
    view, found, spare : (18,), (9, 18), (9, 18) arrays
        Scratch; the points stand in the second.
    """
    mine = axis[KIND] >= CARRIERS
    i = int(axis[KIND]) - CARRIERS if mine else int(axis[KIND])
    bed, upon = (own, half) if mine else (half, own)
    # the box that lies on the face, as the box that has the face sees it
    for p in range(3):
        for q in range(3):
            view[3 * p + q] = rel[3 * q + p] if mine else rel[3 * p + q]
        view[REL_D + p] = -(rel[p] * rel[9] + rel[3 + p] * rel[10] + rel[6 + p] * rel[11]) if mine else rel[REL_D + p]
    side = 1.0 if view[REL_D + i] > 0.0 else -1.0
    shown = 0
    for k in range(1, 3):
        if abs(view[3 * i + k]) > abs(view[3 * i + shown]):
            shown = k
    facing = -side if view[3 * i + shown] > 0.0 else side
    y, one, two = view[12:], 1 if shown == 0 else 0, 1 if shown == 2 else 2
    turn = 1.0 if shown == 2 else facing if shown == 0 else -facing
    for q in range(4):
        y[shown] = facing * upon[shown]
        y[one] = turn * upon[one] if q == 1 or q == 2 else -turn * upon[one]
        y[two] = upon[two] if q > 1 else -upon[two]
        for p in range(3):
            found[q, p] = view[REL_D + p] + view[3 * p] * y[0] + view[3 * p + 1] * y[1] + view[3 * p + 2] * y[2]
    count = 4
    for k in range(3):
        if k != i:
            count = _clip(count, found, k, 1.0, bed[k] + OVERHANG, spare)
            count = _clip(count, spare, k, -1.0, bed[k] + OVERHANG, found)
    for q in range(count):
        a0, a1, a2 = found[q, 0], found[q, 1], found[q, 2]
        found[q, 3] = side * found[q, i] - bed[i]
        if mine:
            for p in range(3):
                found[q, p] = rel[REL_D + p] + rel[3 * p] * a0 + rel[3 * p + 1] * a1 + rel[3 * p + 2] * a2
    return count
