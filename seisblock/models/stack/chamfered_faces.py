"""Contact manifold of two faces of boxes with worn (chamfered) faces, bevels included."""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import BLOCK, INTEGERS, MATRIX, VECTOR
from seisblock.models.stack.box_box import CARRIER_FACES, KIND
from seisblock.models.stack.buffers import FACE_MANIFOLD_KERNEL
from seisblock.models.stack.mesh_topology import OFFSET, PLANE, RING_SIZE, face_corner, plane_distance, to_partner_axes

_t = types()

MAX_CHAMFERED_POINTS = 16
"""Largest number of contact points of two worn boxes."""


@kernel(_t.void(VECTOR, _t.boolean, VECTOR, VECTOR), inline=True)
def _corner_position(rel, is_carrier, r, y):
    """Write a corner in the partner's axes; the partner's own corners are copied."""
    if is_carrier:
        to_partner_axes(rel, r, y)
    else:
        for k in range(3):
            y[k] = r[k]


@kernel(_t.int64(VECTOR, _t.boolean, VECTOR, MATRIX, _t.int64, VECTOR), inline=True)
def _incident_face(rel, is_carrier, down, corners, count, y):
    """Return the incident face: among the faces at the support corner, the one most opposed to the reference normal."""
    # support corner in the direction of the reference face
    deepest_corner, max_projection = 0, -math.inf
    for i in range(count):
        _corner_position(rel, is_carrier, corners[i], y)
        projection = down[0] * y[0] + down[1] * y[1] + down[2] * y[2]
        if projection > max_projection:
            deepest_corner, max_projection = i, projection
    # only faces at the support corner can lie on the reference face
    best_face, max_projection = 0, -math.inf
    for f in range(count - 2):
        has_corner = False
        for q in range(RING_SIZE):
            has_corner = has_corner or face_corner(f, q, count) == deepest_corner
        if not has_corner:
            continue
        x, v, z = corners[f, PLANE], corners[f, PLANE + 1], corners[f, PLANE + 2]
        if is_carrier:
            n0 = rel[0] * x + rel[1] * v + rel[2] * z
            n1 = rel[3] * x + rel[4] * v + rel[5] * z
            n2 = rel[6] * x + rel[7] * v + rel[8] * z
            x, v, z = n0, n1, n2
        projection = down[0] * x + down[1] * v + down[2] * z
        if projection > max_projection:
            best_face, max_projection = f, projection
    return best_face


@kernel(_t.int64(_t.int64, MATRIX, VECTOR, MATRIX))
def _clip_polygon(n, polygon, plane, result):
    """Clip a polygon to the inner side of a plane (Sutherland-Hodgman); return the number of remaining corners."""
    count = 0
    for i in range(n):
        start, end = polygon[i], polygon[(i + 1) % n]
        a, b = -plane_distance(plane, start), -plane_distance(plane, end)
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


@kernel(_t.void(VECTOR, _t.boolean, _t.int64, _t.int64, _t.float64, BLOCK, INTEGERS, VECTOR, VECTOR, MATRIX), inline=True)
def _side_planes(rel, is_carrier, reference_box, face, margin, corners, counts, out, y, borders):
    """Write the four clipping planes through the sides of a face, normal to it: outward normal, and offset plus a margin."""
    count = counts[reference_box]
    for q in range(RING_SIZE):
        border = borders[q // 2, RING_SIZE * (q % 2) :]
        p0, p1, p2 = y, y[3:], y[6:]
        _corner_position(rel, is_carrier, corners[reference_box, face_corner(face, q, count)], p0)
        _corner_position(rel, is_carrier, corners[reference_box, face_corner(face, (q + 1) % RING_SIZE, count)], p1)
        _corner_position(rel, is_carrier, corners[reference_box, face_corner(face, (q + 2) % RING_SIZE, count)], p2)
        a0, a1, a2 = p1[0] - p0[0], p1[1] - p0[1], p1[2] - p0[2]
        x, v, z = a1 * out[2] - a2 * out[1], a2 * out[0] - a0 * out[2], a0 * out[1] - a1 * out[0]
        # the third corner of the face decides which way is outwards
        inward = x * (p2[0] - p0[0]) + v * (p2[1] - p0[1]) + z * (p2[2] - p0[2])
        scale = (-1.0 if inward > 0.0 else 1.0) / math.sqrt(x * x + v * v + z * z)
        border[0], border[1], border[2] = scale * x, scale * v, scale * z
        border[OFFSET] = border[0] * p0[0] + border[1] * p0[1] + border[2] * p0[2] + margin


@kernel(FACE_MANIFOLD_KERNEL)
def face_manifold_chamfered(rel, c, p, margin, corners, counts, axis, work, max_gap, vertices, buffer):
    """Write the contact manifold of two faces and return its number of points.

    A bevel may be so flat that the stone lands on the next face within one step; corners of other faces above the reference face are
    therefore added to the manifold.

    Parameters
    ----------
    rel : (18,) array
    c, p : int
    margin : float, m
    corners, counts : (b, 16, 7), (b,) arrays
        Of all boxes, see :class:`seisblock.models.stack.buffers.PileLayout`.
    axis : (4,) array
        Normal of the reference face, and kind.
    work : (3, 18) array
        Scratch.
    max_gap : float, m
        Gap within which corners of other faces are added.
    vertices, buffer : (16, 18), (9, 18) arrays
        Scratch; the result stands in `vertices`: x, y, z in the partner's axes and the gap, m.
    """
    is_carrier_face = axis[KIND] >= CARRIER_FACES
    face = int(axis[KIND]) - CARRIER_FACES if is_carrier_face else int(axis[KIND])
    reference_box, incident_box = (c, p) if is_carrier_face else (p, c)
    out, down, y, borders = work[0], work[0, 3:], work[0, 6:], work[1:]
    for k in range(3):
        out[k] = -axis[k] if is_carrier_face else axis[k]
        down[k] = -out[k]
    _side_planes(rel, is_carrier_face, reference_box, face, margin, corners, counts, out, y, borders)
    _corner_position(rel, is_carrier_face, corners[reference_box, face_corner(face, 0, counts[reference_box])], y)
    level = out[0] * y[0] + out[1] * y[1] + out[2] * y[2]
    count = counts[incident_box]
    incident_face = _incident_face(rel, not is_carrier_face, down, corners[incident_box], count, y)
    for q in range(RING_SIZE):
        _corner_position(rel, not is_carrier_face, corners[incident_box, face_corner(incident_face, q, count)], vertices[q])
    points = RING_SIZE
    # two clips per turn, so that the result ends in `vertices`
    for q in range(0, RING_SIZE, 2):
        points = _clip_polygon(points, vertices, borders[q // 2], buffer)
        points = _clip_polygon(points, buffer, borders[q // 2, RING_SIZE:], vertices)
    # corners of other faces above the reference face: a flat bevel may bring them down within the step
    for i in range(count):
        corner = vertices[points]
        _corner_position(rel, not is_carrier_face, corners[incident_box, i], corner)
        if out[0] * corner[0] + out[1] * corner[1] + out[2] * corner[2] - level > max_gap or points == MAX_CHAMFERED_POINTS - 2:
            continue
        is_over = True
        for q in range(RING_SIZE):
            is_over = (
                is_over
                and face_corner(incident_face, q, count) != i
                and plane_distance(borders[q // 2, RING_SIZE * (q % 2) :], corner) <= 0.0
            )
        points += 1 if is_over else 0
    for q in range(points):
        vertices[q, 3] = out[0] * vertices[q, 0] + out[1] * vertices[q, 1] + out[2] * vertices[q, 2] - level
    return points
