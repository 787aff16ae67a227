"""Gap and contact manifold of two boxes, dispatched to the sharp or the chamfered separating-axis test."""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.models.stack.box_box import FACE_AXIS, MAX_POINTS, contact_margin, edge_edge, face_manifold, separating_axis
from seisblock.models.stack.buffers import LAYOUT
from seisblock.models.stack.chamfered_faces import MAX_CHAMFERED_POINTS

_t = types()

SHARP_CORNERS = 8
"""Corners of a box without worn faces."""

BEVEL_REACH_RATIO = 0.25
"""Share of a bevel's height over the worn face below which its upper border is tested for contact."""

HULL_SCRATCH, FACE_SCRATCH = 4, 30
"""First rows of scratch for a transformed hull (while no manifold exists), and for an edge or a face."""


@kernel(_t.boolean(_t.int64, _t.int64, LAYOUT), inline=True)
def _both_sharp(c, p, pile):
    return pile.counts[c] <= SHARP_CORNERS and pile.counts[p] <= SHARP_CORNERS


@kernel(_t.int64(_t.int64, _t.int64, LAYOUT), inline=True)
def max_contact_points(c, p, pile):
    """Return the largest number of contact points of two boxes."""
    return MAX_POINTS if _both_sharp(c, p, pile) else MAX_CHAMFERED_POINTS


@kernel(_t.float64(VECTOR, _t.int64, _t.int64, _t.float64, LAYOUT, MATRIX, VECTOR), inline=True)
def gap_between(rel, c, p, cutoff, pile, work, axis):
    """Return the widest gap between carrier and partner and write its axis: see :func:`separating_axis`."""
    margin = contact_margin(c, p, pile.boxes)
    if _both_sharp(c, p, pile):
        return separating_axis(rel, pile.cores[c], pile.cores[p], cutoff, margin, axis)
    return pile.shapes.separating_axis(rel, c, p, cutoff, margin, pile.corners, pile.counts, work[HULL_SCRATCH:], axis)


@kernel(_t.boolean(VECTOR, _t.int64, _t.int64, LAYOUT, VECTOR, MATRIX, VECTOR), inline=True)
def edges_cross(rel, c, p, pile, axis, work, y):
    """Write the nearest points of the two edges of an edge-edge axis and return whether they cross: see :func:`edge_edge`."""
    margin = contact_margin(c, p, pile.boxes)
    if _both_sharp(c, p, pile):
        return edge_edge(rel, pile.cores[c], pile.cores[p], margin, axis, y)
    return pile.shapes.edge_edge(rel, c, p, margin, pile.corners, pile.counts, axis, work[FACE_SCRATCH:], y)


@kernel(_t.int64(VECTOR, _t.int64, _t.int64, LAYOUT, VECTOR, MATRIX, _t.float64, MATRIX, MATRIX), inline=True)
def faces_overlap(rel, c, p, pile, axis, work, max_gap, points, buffer):
    """Write the contact manifold of two faces and return its number of points: see :func:`face_manifold`."""
    margin = contact_margin(c, p, pile.boxes)
    if _both_sharp(c, p, pile):
        return face_manifold(rel, pile.cores[c], pile.cores[p], margin, axis[FACE_AXIS:], work[1], points, buffer)
    face, scratch = axis[FACE_AXIS:], work[FACE_SCRATCH:]
    return pile.shapes.face_manifold(rel, c, p, margin, pile.corners, pile.counts, face, scratch, max_gap, points, buffer)


@kernel(_t.boolean(VECTOR, _t.int64, _t.int64, _t.float64, _t.float64, LAYOUT))
def bevel_touches(rel, c, p, sigma, max_gap, pile):
    """Return whether a bevel of a leaning stone touches the face its joint lies on; sigma is -1 on the partner's upper face, else +1."""
    level = pile.cores[c, 2]
    for i in range(SHARP_CORNERS, pile.counts[c]):
        r = pile.corners[c, i]
        gap = -sigma * (rel[11] + rel[6] * r[0] + rel[7] * r[1] + rel[8] * r[2]) - pile.cores[p, 2]
        # the upper border of the bevel has come down most of its height
        if gap < min(max_gap, BEVEL_REACH_RATIO * (level - sigma * r[2])):
            return True
    return False


@kernel(_t.boolean(MATRIX, _t.int64, _t.float64, _t.float64, _t.float64))
def face_supports(corners, count, x, y, z):
    """Return whether the support point along a direction is a corner of a face, not the upper end of a bevel."""
    face, bevel = -math.inf, -math.inf
    for i in range(count):
        projection = x * corners[i, 0] + y * corners[i, 1] + z * corners[i, 2]
        if i < SHARP_CORNERS:
            face = max(face, projection)
        else:
            bevel = max(bevel, projection)
    return face >= bevel
