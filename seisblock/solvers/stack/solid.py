"""Where two boxes meet once they have tilted or moved off their joint: corners on faces, edges across edges and faces.

The meeting of two convex boxes is held by its own corners: the corners of each inside the other, and the points where an edge of one
passes through a face of the other. A corner keeps the face by which it came in until it leaves. An edge that cuts a corner of the
partner (in by one face, out by a neighbour) is pushed along the common normal of the two edges; an edge that lies across a face is pushed
out of that face, at both ends of the stretch inside.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import INTEGER_TABLE, MATRIX, VECTOR
from seisblock.solvers.stack.contact import ALIVE, FACE, REL_D, touch

_t = types()
APART = 1e30


@kernel(_t.boolean(VECTOR, VECTOR, VECTOR))
def boxes_meet(rel, carrier, partner):
    """Whether two boxes may meet: no face of either separates them."""
    for i in range(3):
        reach = abs(rel[3 * i]) * carrier[0] + abs(rel[3 * i + 1]) * carrier[1] + abs(rel[3 * i + 2]) * carrier[2]
        if abs(rel[REL_D + i]) > partner[i] + reach:
            return False
    for j in range(3):
        away = rel[j] * rel[9] + rel[3 + j] * rel[10] + rel[6 + j] * rel[11]
        reach = abs(rel[j]) * partner[0] + abs(rel[3 + j]) * partner[1] + abs(rel[6 + j]) * partner[2]
        if abs(away) > carrier[j] + reach:
            return False
    return True


@kernel(_t.void(VECTOR, VECTOR, VECTOR), inline=True)
def _seen(rel, r, y):
    """Write where a point of the carrier is in the partner's axes."""
    for i in range(3):
        y[i] = rel[REL_D + i] + rel[3 * i] * r[0] + rel[3 * i + 1] * r[1] + rel[3 * i + 2] * r[2]


@kernel(_t.int64(VECTOR, VECTOR), inline=True)
def _nearest(y, half):
    """Return the axis of the face nearest to a point inside."""
    d0, d1, d2 = half[0] - abs(y[0]), half[1] - abs(y[1]), half[2] - abs(y[2])
    if d0 < min(d1, d2):
        return 0
    return 1 if d1 < d2 else 2


@kernel(_t.void(_t.int64, VECTOR, MATRIX, VECTOR, VECTOR, _t.float64, MATRIX, VECTOR, VECTOR, VECTOR))
def press_corners(n, rel, corners, half, k, dt, slots, y, normal, total):
    """Sum the forces at the carrier's corners inside the partner."""
    for c in range(n):
        _seen(rel, corners[c], y)
        d0, d1, d2 = half[0] - abs(y[0]), half[1] - abs(y[1]), half[2] - abs(y[2])
        slot = slots[c]
        if d0 <= 0.0 or d1 <= 0.0 or d2 <= 0.0:
            slot[ALIVE] = 0.0
            continue
        if slot[ALIVE] == 0.0:
            axis = _nearest(y, half)
            slot[FACE] = 2.0 * axis + (1.0 if y[axis] > 0.0 else 0.0)
        axis = int(slot[FACE]) // 2
        side = 1.0 if int(slot[FACE]) % 2 == 1 else -1.0
        normal[0] = 0.0
        normal[1] = 0.0
        normal[2] = 0.0
        normal[axis] = side
        touch(rel, y, half[axis] - side * y[axis], normal, k, dt, slot, total)


@kernel(
    _t.void(
        VECTOR,
        VECTOR,
        VECTOR,
        _t.float64,
        _t.float64,
        _t.int64,
        _t.int64,
        VECTOR,
        VECTOR,
        _t.float64,
        VECTOR,
        VECTOR,
        VECTOR,
        VECTOR,
    )
)
def _cut(rel, a, e, enter, leave, into, out, half, k, dt, slot, y, normal, total):
    """Push an edge that cuts one edge of the partner along the common normal of both, where it is nearest to that edge."""
    axis = 3 - into - out
    side_in = -1.0 if e[into] > 0.0 else 1.0
    side_out = 1.0 if e[out] > 0.0 else -1.0
    at = (side_in * half[into] - a[into]) * e[into] + (side_out * half[out] - a[out]) * e[out]
    at = min(max(at / (e[into] ** 2 + e[out] ** 2), enter), leave)
    for i in range(3):
        y[i] = a[i] + at * e[i]
    # the partner's edge runs along `axis`; the normal is perpendicular to it and to e, and points out of the partner
    normal[axis] = 0.0
    normal[into] = abs(e[out]) * side_in
    normal[out] = abs(e[into]) * side_out
    size = math.sqrt(normal[into] ** 2 + normal[out] ** 2)
    if size == 0.0:
        slot[ALIVE] = 0.0
        return
    normal[into] /= size
    normal[out] /= size
    depth = (half[into] - side_in * y[into]) * abs(normal[into]) + (half[out] - side_out * y[out]) * abs(normal[out])
    touch(rel, y, depth, normal, k, dt, slot, total)


@kernel(_t.void(VECTOR, VECTOR, VECTOR, _t.float64, _t.int64, VECTOR, VECTOR, _t.float64, VECTOR, VECTOR, VECTOR, VECTOR))
def _lie(rel, a, e, at, through, half, k, dt, slot, y, normal, total):
    """Push an edge that lies across a face of the partner out of that face, where it passes over the face's border."""
    if through < 0:
        slot[ALIVE] = 0.0
        return
    least = APART
    face = 0
    for i in range(3):
        y[i] = a[i] + at * e[i]
        normal[i] = 0.0
        if i != through and half[i] - abs(y[i]) < least:
            least = half[i] - abs(y[i])
            face = i
    name = 2.0 * face + (1.0 if y[face] > 0.0 else 0.0)
    if slot[ALIVE] != 0.0 and slot[FACE] != name:
        slot[ALIVE] = 0.0
    slot[FACE] = name
    normal[face] = 1.0 if y[face] > 0.0 else -1.0
    touch(rel, y, least, normal, k, dt, slot, total)


@kernel(_t.void(_t.int64, VECTOR, MATRIX, INTEGER_TABLE, VECTOR, VECTOR, _t.float64, MATRIX, MATRIX, VECTOR))
def press_edges(n, rel, corners, edges, half, k, dt, slots, work, total):
    """Sum the forces where the carrier's edges pass through the partner.

    Parameters
    ----------
    corners, edges : (m, 3) array, m, and (n, 2) array of int
        The carrier's corners, and the pairs that make its edges.
    half : (3,) array, m
        Half sizes of the partner.
    slots : (2 n, 7) array
        Memory: two contacts per edge.
    work : (5, 3) array
        Scratch.
    """
    a, b, e, y, normal = work[0], work[1], work[2], work[3], work[4]
    for i in range(n):
        one, two = slots[2 * i], slots[2 * i + 1]
        _seen(rel, corners[edges[i, 0]], a)
        _seen(rel, corners[edges[i, 1]], b)
        enter, leave = 0.0, 1.0
        into, out = -1, -1
        for axis in range(3):
            e[axis] = b[axis] - a[axis]
            if e[axis] == 0.0:
                if abs(a[axis]) >= half[axis]:
                    enter = 2.0
                continue
            near = (-half[axis] - a[axis]) / e[axis]
            far = (half[axis] - a[axis]) / e[axis]
            if near > far:
                near, far = far, near
            if near > enter:
                enter, into = near, axis
            if far < leave:
                leave, out = far, axis
        inside = a if into < 0 else b
        if enter >= leave or (into < 0 and out < 0) or (min(into, out) < 0 and _nearest(inside, half) == max(into, out)):
            # missed, wholly inside, or in by the face that its corner presses on already
            one[ALIVE] = 0.0
            two[ALIVE] = 0.0
        elif into >= 0 and out >= 0 and into != out:
            # the contact that lay across the face goes on, if there was one
            one_goes_on = one[ALIVE] != 0.0 or two[ALIVE] == 0.0
            if one_goes_on:
                two[ALIVE] = 0.0
            _cut(rel, a, e, enter, leave, into, out, half, k, dt, one if one_goes_on else two, y, normal, total)
        else:
            _lie(rel, a, e, enter, into, half, k, dt, one, y, normal, total)
            _lie(rel, a, e, leave, out, half, k, dt, two, y, normal, total)
