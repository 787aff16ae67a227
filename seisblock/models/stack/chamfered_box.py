"""Separating-axis test of two boxes of which one or both have worn (chamfered) faces.

A worn face joins the sides by four bevels (:mod:`seisblock.models.stack.mesh_topology`). Candidate axes are the face normals of either
box, bevels included, and the cross products of an edge of each, edges of bevels included ([Gottschalk1996]_ section 5). Without the
bevels the widest gap would come out too narrow, and stones that do not touch would be pushed apart.

Only those cross products count that are face normals of the Minkowski difference: the arc between the normals of the two faces at one
edge crosses the arc between the opposite normals at the other edge (Gauss-map test, derived here).
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.models.stack.box_box import CARRIER_FACES, EDGE_EDGE, FACE_AXIS, KIND, PARALLEL_TOLERANCE
from seisblock.models.stack.buffers import EDGE_EDGE_KERNEL, SEPARATING_AXIS_KERNEL
from seisblock.models.stack.mesh_topology import MAX_EDGES, OFFSET, PLANE, RING_SIZE, edge_topology, plane_distance, to_partner_axes
from seisblock.models.stack.spring_contact import REL_D

_t = types()

EDGE_DIRECTION, FACE_MASK, EDGE_CODE = 7, 13, 15
"""Columns of the carrier's hull in the partner's axes, behind a corner and a plane: directions of two edges, mask of partner faces that
face each, and the code of each edge (corner and two faces)."""

NIBBLE = 15
"""Bit mask of four bits: index of a corner or of a face."""


@kernel(_t.void(VECTOR, MATRIX, _t.int64, MATRIX), inline=True)
def _transform_hull(rel, corners, count, carrier_hull):
    """Write the carrier's corners and face planes in the partner's axes."""
    for i in range(count):
        to_partner_axes(rel, corners[i], carrier_hull[i])
    for i in range(count - 2):
        plane, row = corners[i, PLANE:], carrier_hull[i, PLANE:]
        for k in range(3):
            row[k] = rel[3 * k] * plane[0] + rel[3 * k + 1] * plane[1] + rel[3 * k + 2] * plane[2]
        row[OFFSET] = plane[OFFSET] + row[0] * rel[REL_D] + row[1] * rel[REL_D + 1] + row[2] * rel[REL_D + 2]


@kernel(_t.float64(VECTOR, MATRIX, _t.int64, _t.float64), inline=True)
def _min_distance(plane, corners, count, cutoff):
    """Return the distance of the nearest corner beyond a plane, m, or of the first one found below `cutoff`."""
    min_height = math.inf
    for i in range(count):
        min_height = min(min_height, plane_distance(plane, corners[i]))
        # only the widest gap counts: a face below the best one needs no exact value
        if min_height <= cutoff:
            break
    return min_height


@kernel(_t.boolean(_t.int64, _t.float64, MATRIX, _t.int64, MATRIX, _t.int64), inline=True)
def _projects_onto_face(face, max_distance, hull, n_hull, corners, count):
    """Return whether a corner nearest to a face, within a distance, projects onto it: no other axis then has a wider gap."""
    plane = hull[face, PLANE:]
    for i in range(count):
        corner = corners[i]
        distance = plane_distance(plane, corner)
        if distance > max_distance:
            continue
        is_over = True
        for f in range(n_hull - 2):
            side = hull[f, PLANE:]
            alignment = side[0] * plane[0] + side[1] * plane[1] + side[2] * plane[2]
            # the projection, corner - distance * normal, lies on the inner side of every other face
            is_over = is_over and (f == face or plane_distance(side, corner) <= distance * alignment)
        if is_over:
            return True
    return False


@kernel(_t.int64(_t.float64, _t.float64, _t.float64, MATRIX, _t.int64), inline=True)
def _facing_mask(x, y, z, hull, count):
    """Return the faces of a box whose normals point along a direction, as a bit mask."""
    mask = 0
    for f in range(count - 2):
        if hull[f, PLANE] * x + hull[f, PLANE + 1] * y + hull[f, PLANE + 2] * z > 0.0:
            mask |= 1 << f
    return mask


@kernel(_t.void(_t.int64, MATRIX, _t.int64, MATRIX), inline=True)
def _transform_edges(count, partner_hull, n_partner, carrier_hull):
    """Write the carrier's edges in the partner's axes, and for each the mask of partner faces that face along it."""
    for j in range(2 * count - RING_SIZE):
        # c corners: c edges in the rings and c - 4 posts between them
        start, end, face_a, face_b = edge_topology(j, count)
        row, k = carrier_hull[j // 2], EDGE_DIRECTION + 3 * (j % 2)
        row[k], row[k + 1], row[k + 2] = (
            carrier_hull[end, 0] - carrier_hull[start, 0],
            carrier_hull[end, 1] - carrier_hull[start, 1],
            carrier_hull[end, 2] - carrier_hull[start, 2],
        )
        row[FACE_MASK + j % 2] = _facing_mask(row[k], row[k + 1], row[k + 2], partner_hull, n_partner)
        row[EDGE_CODE + j % 2] = start | face_a << 4 | face_b << 8


@kernel(SEPARATING_AXIS_KERNEL)
def separating_axis_chamfered(rel, c, p, cutoff, margin, corners, counts, carrier_hull, axis):
    """Return the widest gap between two boxes, m, negative where they overlap, and write the separating axis.

    Parameters
    ----------
    rel : (18,) array
        State of the carrier in the partner's axes.
    c, p : int
        Carrier and partner.
    cutoff : float, m
        Gap along a face normal beyond which no other axis needs a test.
    margin : float, m
    corners, counts : (b, 16, 7), (b,) arrays
        Of all boxes, see :class:`seisblock.models.stack.buffers.PileLayout`.
    carrier_hull : (16, 18) array
        Scratch.
    axis : (8,) array
        Result: normal out of the partner, in its axes, and kind; then the same for the best face axis.
    """
    partner_hull, count, n_partner = corners[p], counts[c], counts[p]
    _transform_hull(rel, corners[c], count, carrier_hull)
    max_gap = -math.inf
    # a box with c corners has c - 2 faces, all quadrilaterals (Euler's formula)
    for f in range(n_partner - 2):
        gap = _min_distance(partner_hull[f, PLANE:], carrier_hull, count, max_gap)
        if gap > max_gap:
            max_gap = gap
            for k in range(3):
                axis[k] = partner_hull[f, PLANE + k]
            axis[KIND] = f
    if max_gap > cutoff:
        return max_gap
    # the carrier's faces must win by a margin, so that the choice does not alternate between steps
    for f in range(count - 2):
        gap = _min_distance(carrier_hull[f, PLANE:], partner_hull, n_partner, max_gap + margin)
        if gap > max_gap + margin:
            max_gap = gap
            for k in range(3):
                axis[k] = -carrier_hull[f, PLANE + k]
            axis[KIND] = CARRIER_FACES + f
    for k in range(KIND + 1):
        axis[FACE_AXIS + k] = axis[k]
    if max_gap > cutoff:
        return max_gap
    face, nearest = int(axis[KIND]), max_gap + margin
    if nearest > 0.0 and (
        _projects_onto_face(face - CARRIER_FACES, nearest, carrier_hull, count, partner_hull, n_partner)
        if face >= CARRIER_FACES
        else _projects_onto_face(face, nearest, partner_hull, n_partner, carrier_hull, count)
    ):
        return max_gap
    # no corner projects onto the best face: the widest gap may be along an edge-edge axis
    _transform_edges(count, partner_hull, n_partner, carrier_hull)
    threshold = max_gap + margin
    for i in range(2 * n_partner - RING_SIZE):
        start_index, end_index, face_left, face_right = edge_topology(i, n_partner)
        start, a, b = partner_hull[start_index], partner_hull[face_left], partner_hull[face_right]
        e0, e1, e2 = partner_hull[end_index, 0] - start[0], partner_hull[end_index, 1] - start[1], partner_hull[end_index, 2] - start[2]
        mask = _facing_mask(e0, e1, e2, carrier_hull, count)
        for j in range(2 * count - RING_SIZE):
            row, odd = carrier_hull[j // 2], j % 2
            code, edge_mask = int(row[EDGE_CODE + odd]), int(row[FACE_MASK + odd])
            face_a, face_b = code >> 4 & NIBBLE, code >> 8
            # Gauss-map test: an edge faces the other's edge only if the latter's two faces lie on different sides of it
            if ((mask >> face_a) ^ (mask >> face_b)) & ((edge_mask >> face_left) ^ (edge_mask >> face_right)) & 1 == 0:
                continue
            g0, g1, g2 = row[EDGE_DIRECTION + 3 * odd], row[EDGE_DIRECTION + 3 * odd + 1], row[EDGE_DIRECTION + 3 * odd + 2]
            x, y, z = e1 * g2 - e2 * g1, e2 * g0 - e0 * g2, e0 * g1 - e1 * g0
            square = x * x + y * y + z * z
            if square < PARALLEL_TOLERANCE * (e0 * e0 + e1 * e1 + e2 * e2) * (g0 * g0 + g1 * g1 + g2 * g2):
                continue
            s, t, corner = carrier_hull[face_a], carrier_hull[face_b], carrier_hull[code & NIBBLE]
            # the axis must point out of both edges: the sums of the adjacent normals give the outer sides
            out = x * (a[3] + b[3]) + y * (a[4] + b[4]) + z * (a[5] + b[5])
            if out * (x * (s[3] + t[3]) + y * (s[4] + t[4]) + z * (s[5] + t[5])) > 0.0:
                continue
            scale = (1.0 if out > 0.0 else -1.0) / math.sqrt(square)
            gap = scale * (x * (corner[0] - start[0]) + y * (corner[1] - start[1]) + z * (corner[2] - start[2]))
            if gap > threshold:
                max_gap = threshold = gap
                axis[0] = scale * x
                axis[1] = scale * y
                axis[2] = scale * z
                axis[KIND] = EDGE_EDGE + MAX_EDGES * i + j
    return max_gap


@kernel(EDGE_EDGE_KERNEL)
def edge_edge_chamfered(rel, c, p, margin, corners, counts, axis, ends, y):
    """Write the point of the carrier's edge nearest to the partner's, in the partner's axes; return whether the edges cross."""
    edge = int(axis[KIND]) - EDGE_EDGE
    p_start, p_end, _, _ = edge_topology(edge // MAX_EDGES, counts[p])
    c_start, c_end, _, _ = edge_topology(edge % MAX_EDGES, counts[c])
    to_partner_axes(rel, corners[c, c_start], ends[0])
    to_partner_axes(rel, corners[c, c_end], ends[1])
    ee, eg, gg, re, rg = 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(3):
        e, g = corners[p, p_end, k] - corners[p, p_start, k], ends[1, k] - ends[0, k]
        r = ends[0, k] - corners[p, p_start, k]
        ee += e * e
        eg += e * g
        gg += g * g
        re += r * e
        rg += r * g
    # closest points of two lines, as parameters along the edges
    carrier_t = (eg * re - ee * rg) / (ee * gg - eg * eg)
    partner_t = (re + carrier_t * eg) / ee
    for k in range(3):
        y[k] = ends[0, k] + carrier_t * (ends[1, k] - ends[0, k])
    carrier_margin, partner_margin = margin / math.sqrt(gg), margin / math.sqrt(ee)
    return -carrier_margin < carrier_t < 1.0 + carrier_margin and -partner_margin < partner_t < 1.0 + partner_margin
