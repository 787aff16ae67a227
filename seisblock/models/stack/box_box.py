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
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.models.stack.spring_contact import REL_D

_t = types()

KIND = 3
"""Where an axis, whose first three numbers are the normal out of the partner, keeps its kind."""

CARRIER_FACES, EDGE_EDGE = 14, 28
"""The first kind that is a face of the carrier, those of the partner standing before; and the first that is an edge of the partner and
one of the carrier."""

FACE_AXIS = 4
"""Where the axis of the widest gap along a normal of a face stands behind the axis of the widest of all."""

AXIS_BIAS = 1e-5
"""How much wider, m, a gap must be along the carrier's normals than along the partner's, and across edges than along either. Of edges the
widest is taken: the others do not cross."""

PARALLEL_TOLERANCE = 1e-8
"""Square of the sine of the angle below which edges are parallel."""

FACE_MARGIN = 1e-5
"""How far, m, beyond the border of a face, or the end of an edge, a point may lie and count as on it."""

MAX_POINTS = 9


@kernel(_t.float64(_t.float64, _t.float64, _t.float64, VECTOR), inline=True)
def _support_distance(x, y, z, half):
    """Return how far a box reaches along a direction in its own axes."""
    return abs(x) * half[0] + abs(y) * half[1] + abs(z) * half[2]


@kernel(_t.void(_t.float64, _t.float64, _t.float64, _t.int64, VECTOR), inline=True)
def _set_axis(x, y, z, kind, axis):
    axis[0] = x
    axis[1] = y
    axis[2] = z
    axis[KIND] = kind


@kernel(_t.float64(VECTOR, VECTOR, VECTOR, _t.float64, VECTOR))
def separating_axis(rel, carrier_half, partner_half, cutoff, axis):
    """Return the widest gap between two boxes, m, negative where they overlap, and write its axis.

    Parameters
    ----------
    rel : (18,) array
        The carrier as the partner sees it.
    carrier_half, partner_half : (3,) arrays, m
        Half sizes of the carrier, and of the partner.
    cutoff : float, m
        A gap along a face's normal beyond which edges need not be looked at.
    axis : (8,) array
        Normal out of the partner, in its axes, and the kind; and the same of faces alone.
    """
    d0, d1, d2 = rel[REL_D], rel[REL_D + 1], rel[REL_D + 2]
    max_gap = -math.inf
    for i in range(3):
        d = rel[REL_D + i]
        side = 1.0 if d > 0.0 else -1.0
        gap = side * d - partner_half[i] - _support_distance(rel[3 * i], rel[3 * i + 1], rel[3 * i + 2], carrier_half)
        if gap > max_gap:
            max_gap = gap
            _set_axis(side if i == 0 else 0.0, side if i == 1 else 0.0, side if i == 2 else 0.0, i, axis)
    for j in range(3):
        x, y, z = rel[j], rel[3 + j], rel[6 + j]
        d = x * d0 + y * d1 + z * d2
        side = 1.0 if d > 0.0 else -1.0
        gap = side * d - carrier_half[j] - _support_distance(x, y, z, partner_half)
        if gap > max_gap + AXIS_BIAS:
            max_gap = gap
            _set_axis(side * x, side * y, side * z, CARRIER_FACES + j, axis)
    for k in range(KIND + 1):
        axis[FACE_AXIS + k] = axis[k]
    if max_gap > cutoff:
        return max_gap
    threshold = max_gap + AXIS_BIAS
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
            if square < PARALLEL_TOLERANCE:
                continue
            d = x * d0 + y * d1 + z * d2
            scale = (1.0 if d > 0.0 else -1.0) / math.sqrt(square)
            x, y, z = scale * x, scale * y, scale * z
            a = x * rel[0] + y * rel[3] + z * rel[6]
            b = x * rel[1] + y * rel[4] + z * rel[7]
            c = x * rel[2] + y * rel[5] + z * rel[8]
            gap = scale * d - _support_distance(x, y, z, partner_half) - _support_distance(a, b, c, carrier_half)
            if gap > threshold:
                max_gap = threshold = gap
                _set_axis(x, y, z, EDGE_EDGE + 3 * i + j, axis)
    return max_gap


@kernel(_t.boolean(VECTOR, VECTOR, VECTOR, VECTOR, VECTOR))
def edge_edge(rel, carrier_half, partner_half, axis, y):
    """Write the point of the carrier's edge nearest to the partner's, in the partner's axes; return whether the edges cross there."""
    i, j = (int(axis[KIND]) - EDGE_EDGE) // 3, (int(axis[KIND]) - EDGE_EDGE) % 3
    a0, a1, a2 = rel[REL_D], rel[REL_D + 1], rel[REL_D + 2]
    for k in range(3):
        if k != j:
            component = axis[0] * rel[k] + axis[1] * rel[3 + k] + axis[2] * rel[6 + k]
            side = -carrier_half[k] if component > 0.0 else carrier_half[k]
            a0 += side * rel[k]
            a1 += side * rel[3 + k]
            a2 += side * rel[6 + k]
    b0 = 0.0 if i == 0 else partner_half[0] if axis[0] > 0.0 else -partner_half[0]
    b1 = 0.0 if i == 1 else partner_half[1] if axis[1] > 0.0 else -partner_half[1]
    b2 = 0.0 if i == 2 else partner_half[2] if axis[2] > 0.0 else -partner_half[2]
    x, z, t = rel[j], rel[6 + j], rel[3 + j]
    r0, r1, r2 = a0 - b0, a1 - b1, a2 - b2
    cosine = rel[3 * i + j]
    partner_dot = r0 if i == 0 else r1 if i == 1 else r2
    carrier_dot = r0 * x + r1 * t + r2 * z
    scale = 1.0 / (1.0 - cosine * cosine)
    carrier_offset = (cosine * partner_dot - carrier_dot) * scale
    partner_offset = partner_dot + carrier_offset * cosine
    y[0] = a0 + carrier_offset * x
    y[1] = a1 + carrier_offset * t
    y[2] = a2 + carrier_offset * z
    return abs(carrier_offset) < carrier_half[j] + FACE_MARGIN and abs(partner_offset) < partner_half[i] + FACE_MARGIN


@kernel(_t.int64(_t.int64, MATRIX, _t.int64, _t.float64, _t.float64, MATRIX))
def _clip_polygon(n, polygon, k, side, limit, result):
    """Cut a polygon off beyond side y_k = limit; return how many corners are left."""
    count = 0
    for i in range(n):
        start, end = polygon[i], polygon[(i + 1) % n]
        a, b = limit - side * start[k], limit - side * end[k]
        if a >= 0.0:
            for m in range(3):
                result[count, m] = start[m]
            count += 1
        if (a >= 0.0) != (b >= 0.0):
            fraction = a / (a - b)
            for m in range(3):
                result[count, m] = start[m] + fraction * (end[m] - start[m])
            count += 1
    return count


@kernel(_t.int64(VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, MATRIX, MATRIX))
def face_manifold(rel, carrier_half, partner_half, axis, view, points, buffer):
    """Write where two faces lie over each other: x, y, z in the partner's axes, and the gap there; return how many points.

    Parameters
    ----------
    rel : (18,) array
    carrier_half, partner_half : (3,) arrays, m
    axis : (4,) array
        A normal of a face.
    view, points, buffer : (18,), (9, 18), (9, 18) arrays
        Scratch; the points stand in the second.
    """
    is_carrier_face = axis[KIND] >= CARRIER_FACES
    i = int(axis[KIND]) - CARRIER_FACES if is_carrier_face else int(axis[KIND])
    reference_half, incident_half = (carrier_half, partner_half) if is_carrier_face else (partner_half, carrier_half)
    # the box that lies on the face, as the box that has the face sees it
    for p in range(3):
        for q in range(3):
            view[3 * p + q] = rel[3 * q + p] if is_carrier_face else rel[3 * p + q]
        view[REL_D + p] = -(rel[p] * rel[9] + rel[3 + p] * rel[10] + rel[6 + p] * rel[11]) if is_carrier_face else rel[REL_D + p]
    side = 1.0 if view[REL_D + i] > 0.0 else -1.0
    incident_axis = 0
    for k in range(1, 3):
        if abs(view[3 * i + k]) > abs(view[3 * i + incident_axis]):
            incident_axis = k
    incident_sign = -side if view[3 * i + incident_axis] > 0.0 else side
    y, u_axis, v_axis = view[12:], 1 if incident_axis == 0 else 0, 1 if incident_axis == 2 else 2
    winding = 1.0 if incident_axis == 2 else incident_sign if incident_axis == 0 else -incident_sign
    for q in range(4):
        y[incident_axis] = incident_sign * incident_half[incident_axis]
        y[u_axis] = winding * incident_half[u_axis] if q == 1 or q == 2 else -winding * incident_half[u_axis]
        y[v_axis] = incident_half[v_axis] if q > 1 else -incident_half[v_axis]
        for p in range(3):
            points[q, p] = view[REL_D + p] + view[3 * p] * y[0] + view[3 * p + 1] * y[1] + view[3 * p + 2] * y[2]
    count = 4
    for k in range(3):
        if k != i:
            count = _clip_polygon(count, points, k, 1.0, reference_half[k] + FACE_MARGIN, buffer)
            count = _clip_polygon(count, buffer, k, -1.0, reference_half[k] + FACE_MARGIN, points)
    for q in range(count):
        a0, a1, a2 = points[q, 0], points[q, 1], points[q, 2]
        points[q, 3] = side * points[q, i] - reference_half[i]
        if is_carrier_face:
            for p in range(3):
                points[q, p] = rel[REL_D + p] + rel[3 * p] * a0 + rel[3 * p + 1] * a1 + rel[3 * p + 2] * a2
    return count
