"""Spring contacts of two overlapping boxes: corner-face, edge-edge and edge-face.

Contacts are the corners of each box inside the other, and the points where an edge of one passes through a face of the other. A corner
keeps its entry face until it leaves. An edge that cuts off an edge of the partner (enters by one face, leaves by a neighbour) is pushed
along the common normal of the two edges; an edge that lies across a face is pushed out of that face at both ends of its inner part.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import INTEGER_TABLE, MATRIX, VECTOR
from seisblock.models.stack.spring_contact import ALIVE, FACE, REL_D, add_point_force

_t = types()
INFINITE_DEPTH = 1e30


@kernel(_t.boolean(VECTOR, VECTOR, VECTOR))
def boxes_overlap(rel, carrier, partner):
    """Return whether no face normal separates two boxes (narrow-phase pre-test without edges)."""
    for i in range(3):
        reach = abs(rel[3 * i]) * carrier[0] + abs(rel[3 * i + 1]) * carrier[1] + abs(rel[3 * i + 2]) * carrier[2]
        if abs(rel[REL_D + i]) > partner[i] + reach:
            return False
    for j in range(3):
        distance = rel[j] * rel[9] + rel[3 + j] * rel[10] + rel[6 + j] * rel[11]
        reach = abs(rel[j]) * partner[0] + abs(rel[3 + j]) * partner[1] + abs(rel[6 + j]) * partner[2]
        if abs(distance) > carrier[j] + reach:
            return False
    return True


@kernel(_t.void(VECTOR, VECTOR, VECTOR), inline=True)
def _to_partner_axes(rel, r, y):
    """Write a point of the carrier in the partner's axes."""
    for i in range(3):
        y[i] = rel[REL_D + i] + rel[3 * i] * r[0] + rel[3 * i + 1] * r[1] + rel[3 * i + 2] * r[2]


@kernel(_t.int64(VECTOR, VECTOR), inline=True)
def _nearest_face(y, half):
    """Return the axis (0, 1, 2) of the face nearest to an inner point."""
    d0, d1, d2 = half[0] - abs(y[0]), half[1] - abs(y[1]), half[2] - abs(y[2])
    if d0 < min(d1, d2):
        return 0
    return 1 if d1 < d2 else 2


@kernel(_t.void(_t.int64, VECTOR, MATRIX, VECTOR, VECTOR, _t.float64, MATRIX, VECTOR, VECTOR, VECTOR))
def add_corner_forces(n, rel, corners, half, k, dt, slots, y, normal, total):
    """Add the forces at the carrier's corners inside the partner."""
    for c in range(n):
        _to_partner_axes(rel, corners[c], y)
        d0, d1, d2 = half[0] - abs(y[0]), half[1] - abs(y[1]), half[2] - abs(y[2])
        slot = slots[c]
        if d0 <= 0.0 or d1 <= 0.0 or d2 <= 0.0:
            slot[ALIVE] = 0.0
            continue
        # the entry face is kept: the nearest face may change while the corner is inside, and the force would jump
        if slot[ALIVE] == 0.0:
            axis = _nearest_face(y, half)
            slot[FACE] = 2.0 * axis + (1.0 if y[axis] > 0.0 else 0.0)
        axis = int(slot[FACE]) // 2
        side = 1.0 if int(slot[FACE]) % 2 == 1 else -1.0
        normal[0] = 0.0
        normal[1] = 0.0
        normal[2] = 0.0
        normal[axis] = side
        add_point_force(rel, y, half[axis] - side * y[axis], normal, k, dt, slot, total)


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
def _add_edge_edge_force(rel, a, e, t_enter, t_leave, axis_in, axis_out, half, k, dt, slot, y, normal, total):
    """Add the force along the common normal of two edges, at the point nearest to the partner's edge."""
    axis = 3 - axis_in - axis_out
    side_in = -1.0 if e[axis_in] > 0.0 else 1.0
    side_out = 1.0 if e[axis_out] > 0.0 else -1.0
    # parameter of the point nearest to the partner's edge, limited to the part inside the partner
    t = (side_in * half[axis_in] - a[axis_in]) * e[axis_in] + (side_out * half[axis_out] - a[axis_out]) * e[axis_out]
    t = min(max(t / (e[axis_in] ** 2 + e[axis_out] ** 2), t_enter), t_leave)
    for i in range(3):
        y[i] = a[i] + t * e[i]
    # the partner's edge runs along `axis`; the normal is perpendicular to it and to e, and points out of the partner
    normal[axis] = 0.0
    normal[axis_in] = abs(e[axis_out]) * side_in
    normal[axis_out] = abs(e[axis_in]) * side_out
    size = math.sqrt(normal[axis_in] ** 2 + normal[axis_out] ** 2)
    if size == 0.0:
        slot[ALIVE] = 0.0
        return
    normal[axis_in] /= size
    normal[axis_out] /= size
    depth = (half[axis_in] - side_in * y[axis_in]) * abs(normal[axis_in]) + (half[axis_out] - side_out * y[axis_out]) * abs(
        normal[axis_out]
    )
    add_point_force(rel, y, depth, normal, k, dt, slot, total)


@kernel(_t.void(VECTOR, VECTOR, VECTOR, _t.float64, _t.int64, VECTOR, VECTOR, _t.float64, VECTOR, VECTOR, VECTOR, VECTOR))
def _add_edge_face_force(rel, a, e, t, crossed_axis, half, k, dt, slot, y, normal, total):
    """Add the force of an edge across a face of the partner, at the point where the edge crosses the face's border."""
    if crossed_axis < 0:
        slot[ALIVE] = 0.0
        return
    depth = INFINITE_DEPTH
    face = 0
    for i in range(3):
        y[i] = a[i] + t * e[i]
        normal[i] = 0.0
        if i != crossed_axis and half[i] - abs(y[i]) < depth:
            depth = half[i] - abs(y[i])
            face = i
    face_id = 2.0 * face + (1.0 if y[face] > 0.0 else 0.0)
    # a contact with another face starts anew, without the stretch of the old one
    if slot[ALIVE] != 0.0 and slot[FACE] != face_id:
        slot[ALIVE] = 0.0
    slot[FACE] = face_id
    normal[face] = 1.0 if y[face] > 0.0 else -1.0
    add_point_force(rel, y, depth, normal, k, dt, slot, total)


@kernel(_t.void(_t.int64, VECTOR, MATRIX, INTEGER_TABLE, VECTOR, VECTOR, _t.float64, MATRIX, MATRIX, VECTOR))
def add_edge_forces(n, rel, corners, edges, half, k, dt, slots, work, total):
    """Add the forces where the carrier's edges pass through the partner.

    Parameters
    ----------
    corners, edges : (m, 3) array, m, and (n, 2) array of int
        The carrier's corners, and the pairs that make its edges.
    half : (3,) array, m
        Half sizes of the partner.
    slots : (2 n, 7) array
        Contact memory: two contacts per edge.
    work : (5, 3) array
        Scratch.
    """
    a, b, e, y, normal = work[0], work[1], work[2], work[3], work[4]
    for i in range(n):
        first_slot, second_slot = slots[2 * i], slots[2 * i + 1]
        _to_partner_axes(rel, corners[edges[i, 0]], a)
        _to_partner_axes(rel, corners[edges[i, 1]], b)
        t_enter, t_leave = 0.0, 1.0
        axis_in, axis_out = -1, -1
        # clip the edge to the partner, slab by slab
        for axis in range(3):
            e[axis] = b[axis] - a[axis]
            if e[axis] == 0.0:
                # parallel to this pair of faces and outside them: no intersection
                if abs(a[axis]) >= half[axis]:
                    t_enter = 2.0
                continue
            t_near = (-half[axis] - a[axis]) / e[axis]
            t_far = (half[axis] - a[axis]) / e[axis]
            if t_near > t_far:
                t_near, t_far = t_far, t_near
            if t_near > t_enter:
                t_enter, axis_in = t_near, axis
            if t_far < t_leave:
                t_leave, axis_out = t_far, axis
        inner_end = a if axis_in < 0 else b
        if (
            t_enter >= t_leave
            or (axis_in < 0 and axis_out < 0)
            or (min(axis_in, axis_out) < 0 and _nearest_face(inner_end, half) == max(axis_in, axis_out))
        ):
            # no intersection, wholly inside, or entered by the face on which its corner already presses
            first_slot[ALIVE] = 0.0
            second_slot[ALIVE] = 0.0
        elif axis_in >= 0 and axis_out >= 0 and axis_in != axis_out:
            # a contact that lay across the face continues as the edge-edge contact
            first_continues = first_slot[ALIVE] != 0.0 or second_slot[ALIVE] == 0.0
            if first_continues:
                second_slot[ALIVE] = 0.0
            _add_edge_edge_force(
                rel,
                a,
                e,
                t_enter,
                t_leave,
                axis_in,
                axis_out,
                half,
                k,
                dt,
                first_slot if first_continues else second_slot,
                y,
                normal,
                total,
            )
        else:
            _add_edge_face_force(rel, a, e, t_enter, axis_in, half, k, dt, first_slot, y, normal, total)
            _add_edge_face_force(rel, a, e, t_leave, axis_out, half, k, dt, second_slot, y, normal, total)
