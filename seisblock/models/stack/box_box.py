"""Separating-axis test and contact manifold of two boxes with sharp edges.

Two convex bodies are apart if a separating axis exists: a face normal of either, or the cross product of an edge of each
([Gottschalk1996]_ section 5). Every step takes the axis with the widest gap. When it changes, the gap along the new axis is no
narrower, so stones that were apart never have to be pushed out of each other, which would create energy. All points of the
manifold share this one normal and cannot jam each other.

The manifold is the overlap of the reference face with the incident face (face contact), or the point where two edges cross.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.models.stack.spring_contact import REL_D

_t = types()

KIND = 3
"""Index of the kind of an axis, behind its normal out of the partner (3)."""

CARRIER_FACES, EDGE_EDGE = 14, 28
"""First kind of a face of the carrier (the partner's faces come before), and first kind of an edge-edge axis."""

FACE_AXIS = 4
"""Index of the best face axis behind the best axis of all."""

MARGIN_RATIO = 2.5e-5
"""Contact margin of two boxes over half the length of the smaller one: extra gap for which a carrier face is preferred to a partner face,
and an edge-edge axis to either, which keeps the choice stable; and distance beyond the border of a face or the end of an edge within which
a point counts as on it.

Among edge-edge axes the widest gap wins without a bias, as only the edges of that axis cross."""

PARALLEL_TOLERANCE = 1e-8
"""Squared sine of the angle below which two edges count as parallel."""

MAX_POINTS = 9


@kernel(_t.float64(_t.float64, _t.float64, _t.float64, VECTOR), inline=True)
def _support_distance(x, y, z, half):
    """Return the distance from the centre of a box to its support plane along a direction in its own axes."""
    return abs(x) * half[0] + abs(y) * half[1] + abs(z) * half[2]


@kernel(_t.float64(_t.int64, _t.int64, MATRIX), inline=True)
def smaller_half_length(c, p, boxes):
    """Return half the length of the smaller one of two stones, m."""
    return min(max(boxes[c, 0], max(boxes[c, 1], boxes[c, 2])), max(boxes[p, 0], max(boxes[p, 1], boxes[p, 2])))


@kernel(_t.float64(_t.int64, _t.int64, MATRIX), inline=True)
def contact_margin(c, p, boxes):
    """Return the contact margin of two stones, m."""
    return MARGIN_RATIO * smaller_half_length(c, p, boxes)


@kernel(_t.void(_t.float64, _t.float64, _t.float64, _t.int64, VECTOR), inline=True)
def _set_axis(x, y, z, kind, axis):
    axis[0] = x
    axis[1] = y
    axis[2] = z
    axis[KIND] = kind


@kernel(_t.float64(VECTOR, VECTOR, VECTOR, _t.float64, _t.float64, VECTOR))
def separating_axis(rel, carrier_half, partner_half, cutoff, margin, axis):
    """Return the widest gap between two boxes, m, negative where they overlap, and write the separating axis.

    Parameters
    ----------
    rel : (18,) array
        State of the carrier in the partner's axes.
    carrier_half, partner_half : (3,) arrays, m
        Half sizes of the carrier and of the partner.
    cutoff : float, m
        Gap along a face normal beyond which edges need no test.
    margin : float, m
    axis : (8,) array
        Result: normal out of the partner, in its axes, and kind; then the same for the best face axis.
    """
    d0, d1, d2 = rel[REL_D], rel[REL_D + 1], rel[REL_D + 2]
    max_gap = -math.inf
    # normals of the partner: its own axes
    for i in range(3):
        d = rel[REL_D + i]
        # always +1 or -1: between centres at the same level either side will do, but zero is no direction
        side = 1.0 if d > 0.0 else -1.0
        gap = side * d - partner_half[i] - _support_distance(rel[3 * i], rel[3 * i + 1], rel[3 * i + 2], carrier_half)
        if gap > max_gap:
            max_gap = gap
            _set_axis(side if i == 0 else 0.0, side if i == 1 else 0.0, side if i == 2 else 0.0, i, axis)
    # normals of the carrier: columns of its rotation matrix
    for j in range(3):
        x, y, z = rel[j], rel[3 + j], rel[6 + j]
        d = x * d0 + y * d1 + z * d2
        side = 1.0 if d > 0.0 else -1.0
        gap = side * d - carrier_half[j] - _support_distance(x, y, z, partner_half)
        if gap > max_gap + margin:
            max_gap = gap
            _set_axis(side * x, side * y, side * z, CARRIER_FACES + j, axis)
    # the best face axis is kept: an edge-edge contact uses it for the corners that come to rest on the face
    for k in range(KIND + 1):
        axis[FACE_AXIS + k] = axis[k]
    # more axes can only widen the gap: the boxes are out of reach already
    if max_gap > cutoff:
        return max_gap
    threshold = max_gap + margin
    for i in range(3):
        for j in range(3):
            x, y, z = rel[j], rel[3 + j], rel[6 + j]
            # cross product of the partner's axis i, a unit vector, with the carrier's axis j
            if i == 0:
                x, y, z = 0.0, -z, y
            elif i == 1:
                x, y, z = z, 0.0, -x
            else:
                x, y, z = -y, x, 0.0
            square = x * x + y * y + z * z
            # parallel edges give no axis of their own: where it would separate, a face normal does
            if square < PARALLEL_TOLERANCE:
                continue
            d = x * d0 + y * d1 + z * d2
            # the product is as long as the sine of the angle between the edges: gaps along different axes compare
            # only when normalized
            scale = (1.0 if d > 0.0 else -1.0) / math.sqrt(square)
            x, y, z = scale * x, scale * y, scale * z
            # the axis in the carrier's axes
            a = x * rel[0] + y * rel[3] + z * rel[6]
            b = x * rel[1] + y * rel[4] + z * rel[7]
            c = x * rel[2] + y * rel[5] + z * rel[8]
            gap = scale * d - _support_distance(x, y, z, partner_half) - _support_distance(a, b, c, carrier_half)
            if gap > threshold:
                max_gap = threshold = gap
                _set_axis(x, y, z, EDGE_EDGE + 3 * i + j, axis)
    return max_gap


@kernel(_t.boolean(VECTOR, VECTOR, VECTOR, _t.float64, VECTOR, VECTOR))
def edge_edge(rel, carrier_half, partner_half, margin, axis, y):
    """Write the point of the carrier's edge nearest to the partner's, in the partner's axes; return whether the edges cross."""
    i, j = (int(axis[KIND]) - EDGE_EDGE) // 3, (int(axis[KIND]) - EDGE_EDGE) % 3
    # centre of the carrier's edge nearest to the partner along the axis; the partner's edge likewise below
    a0, a1, a2 = rel[REL_D], rel[REL_D + 1], rel[REL_D + 2]
    for k in range(3):
        if k != j:
            # the axis points out of the partner: the carrier's nearest edge lies against it, the partner's along it
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
    # closest points of two lines; parallel edges never get here (PARALLEL_TOLERANCE)
    scale = 1.0 / (1.0 - cosine * cosine)
    carrier_offset = (cosine * partner_dot - carrier_dot) * scale
    partner_offset = partner_dot + carrier_offset * cosine
    y[0] = a0 + carrier_offset * x
    y[1] = a1 + carrier_offset * t
    y[2] = a2 + carrier_offset * z
    # the axis separates the lines of the edges; they touch only where the nearest points lie on both edges
    return abs(carrier_offset) < carrier_half[j] + margin and abs(partner_offset) < partner_half[i] + margin


@kernel(_t.int64(_t.int64, MATRIX, _t.int64, _t.float64, _t.float64, MATRIX))
def _clip_polygon(n, polygon, k, side, limit, result):
    """Clip a polygon to side y_k <= limit (Sutherland-Hodgman); return the number of remaining corners."""
    count = 0
    for i in range(n):
        start, end = polygon[i], polygon[(i + 1) % n]
        # corners on the limit count as inside, so that two faces of one size keep their four corners
        a, b = limit - side * start[k], limit - side * end[k]
        if a >= 0.0:
            for m in range(3):
                result[count, m] = start[m]
            count += 1
        if (a >= 0.0) != (b >= 0.0):
            # the ends lie on different sides of the limit: a - b is not zero
            fraction = a / (a - b)
            for m in range(3):
                result[count, m] = start[m] + fraction * (end[m] - start[m])
            count += 1
    return count


@kernel(_t.int64(VECTOR, VECTOR, VECTOR, _t.float64, VECTOR, VECTOR, MATRIX, MATRIX))
def face_manifold(rel, carrier_half, partner_half, margin, axis, view, points, buffer):
    """Write the contact manifold of two faces and return its number of points.

    Parameters
    ----------
    rel : (18,) array
    carrier_half, partner_half : (3,) arrays, m
    margin : float, m
    axis : (4,) array
        Normal of the reference face, and kind.
    view, points, buffer : (18,), (9, 18), (9, 18) arrays
        Scratch; the result stands in `points`: x, y, z in the partner's axes and the gap, m.
    """
    is_carrier_face = axis[KIND] >= CARRIER_FACES
    i = int(axis[KIND]) - CARRIER_FACES if is_carrier_face else int(axis[KIND])
    reference_half, incident_half = (carrier_half, partner_half) if is_carrier_face else (partner_half, carrier_half)
    # state of the incident box in the axes of the reference box
    for p in range(3):
        for q in range(3):
            view[3 * p + q] = rel[3 * q + p] if is_carrier_face else rel[3 * p + q]
        view[REL_D + p] = -(rel[p] * rel[9] + rel[3 + p] * rel[10] + rel[6 + p] * rel[11]) if is_carrier_face else rel[REL_D + p]
    side = 1.0 if view[REL_D + i] > 0.0 else -1.0
    # incident face: the one whose normal is most opposed to the reference normal
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
    # clip the incident face by the four sides of the reference face
    for k in range(3):
        if k != i:
            count = _clip_polygon(count, points, k, 1.0, reference_half[k] + margin, buffer)
            count = _clip_polygon(count, buffer, k, -1.0, reference_half[k] + margin, points)
    for q in range(count):
        a0, a1, a2 = points[q, 0], points[q, 1], points[q, 2]
        # contact points stay on the incident face; the gap is measured along the reference normal
        points[q, 3] = side * points[q, i] - reference_half[i]
        if is_carrier_face:
            for p in range(3):
                points[q, p] = rel[REL_D + p] + rel[3 * p] * a0 + rel[3 * p + 1] * a1 + rel[3 * p + 2] * a2
    return count
