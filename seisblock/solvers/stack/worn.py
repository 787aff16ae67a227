"""Along which axis two boxes, one of them or both with worn faces, are furthest apart, and where edges would cross along it.

A worn face leads to the sides by four bevels (:mod:`seisblock.solvers.stack.rings`). Two boxes that are apart are so along a normal of
a face of either, its bevels among them, or along a perpendicular to an edge of each, the edges of the bevels among them
([Gottschalk1996]_ section 5). Without those of the bevels the widest gap found would be too narrow, and stones that do not touch would
be pushed out of each other.

Of the perpendiculars only those count that are normals of faces of the difference of both bodies: where the arc between the normals of
the two faces at one edge crosses the arc between the opposite normals at the other (derived here).
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import MATRIX, VECTOR
from seisblock.solvers.stack.apart import CARRIERS, EDGES, FACE, FAVOUR, KIND, OVERHANG, PARALLEL
from seisblock.solvers.stack.arguments import LAYOUT
from seisblock.solvers.stack.contact import REL_D
from seisblock.solvers.stack.rings import MOST_EDGES, OFFSET, PLANE, RING, edge_of, height, see

_t = types()

ALONG, MASK, CODE = 7, 13, 15
"""Where what the partner sees of the carrier keeps, behind a corner and a plane of it, of two edges the directions, the partner's faces
that look along them, and their corners and faces."""

HEX = 15
"""Four bits: a corner, or a face."""


@kernel(_t.void(VECTOR, MATRIX, _t.int64, MATRIX), inline=True)
def _see_all(rel, corners, count, seen):
    """Write the carrier's corners and planes in the partner's axes."""
    for i in range(count):
        see(rel, corners[i], seen[i])
    for i in range(count - 2):
        plane, row = corners[i, PLANE:], seen[i, PLANE:]
        for k in range(3):
            row[k] = rel[3 * k] * plane[0] + rel[3 * k + 1] * plane[1] + rel[3 * k + 2] * plane[2]
        row[OFFSET] = plane[OFFSET] + row[0] * rel[REL_D] + row[1] * rel[REL_D + 1] + row[2] * rel[REL_D + 2]


@kernel(_t.float64(VECTOR, MATRIX, _t.int64, _t.float64), inline=True)
def _beyond(plane, corners, count, enough):
    """Return how far beyond a plane the nearest of some corners is, m, or of one that is not so far as `enough`."""
    least = math.inf
    for i in range(count):
        least = min(least, height(plane, corners[i]))
        if least <= enough:
            break
    return least


@kernel(_t.boolean(_t.int64, _t.float64, MATRIX, _t.int64, MATRIX, _t.int64), inline=True)
def _lies_over(face, gap, hull, n_hull, corners, count):
    """Whether a corner as near to a face as any lies over it: then no axis has a wider gap."""
    plane = hull[face, PLANE:]
    for i in range(count):
        corner = corners[i]
        up = height(plane, corner)
        if up > gap + FAVOUR:
            continue
        over = True
        for f in range(n_hull - 2):
            side = hull[f, PLANE:]
            along = side[0] * plane[0] + side[1] * plane[1] + side[2] * plane[2]
            over = over and (f == face or height(side, corner) <= up * along)
        if over:
            return True
    return False


@kernel(_t.int64(_t.float64, _t.float64, _t.float64, MATRIX, _t.int64), inline=True)
def _looking(x, y, z, hull, count):
    """Return which faces of a box look along a direction, a bit each."""
    mask = 0
    for f in range(count - 2):
        if hull[f, PLANE] * x + hull[f, PLANE + 1] * y + hull[f, PLANE + 2] * z > 0.0:
            mask |= 1 << f
    return mask


@kernel(_t.void(_t.int64, MATRIX, _t.int64, MATRIX), inline=True)
def _see_edges(count, others, n_others, seen):
    """Write the carrier's edges in the partner's axes, and which of its faces look along each."""
    for j in range(2 * count - RING):
        one, two, under, over = edge_of(j, count)
        row, k = seen[j // 2], ALONG + 3 * (j % 2)
        row[k], row[k + 1], row[k + 2] = seen[two, 0] - seen[one, 0], seen[two, 1] - seen[one, 1], seen[two, 2] - seen[one, 2]
        row[MASK + j % 2] = _looking(row[k], row[k + 1], row[k + 2], others, n_others)
        row[CODE + j % 2] = one | under << 4 | over << 8


@kernel(_t.float64(VECTOR, _t.int64, _t.int64, _t.float64, LAYOUT, MATRIX, VECTOR))
def furthest_worn(rel, c, p, enough, pile, seen, axis):
    """Return the widest gap between two boxes, m, negative where they overlap, and write its axis.

    Parameters
    ----------
    rel : (18,) array
        The carrier as the partner sees it.
    c, p : int
        The carrier and the partner.
    enough : float, m
        A gap along a face's normal beyond which nothing else need be looked at.
    seen : (16, 18) array
        Scratch.
    axis : (8,) array
        Normal out of the partner, in its axes, and the kind; and the same of faces alone.
    """
    others, count, n_others = pile.corners[p], pile.counts[c], pile.counts[p]
    _see_all(rel, pile.corners[c], count, seen)
    widest = -math.inf
    for f in range(n_others - 2):
        gap = _beyond(others[f, PLANE:], seen, count, widest)
        if gap > widest:
            widest = gap
            for k in range(3):
                axis[k] = others[f, PLANE + k]
            axis[KIND] = f
    if widest > enough:
        return widest
    for f in range(count - 2):
        gap = _beyond(seen[f, PLANE:], others, n_others, widest + FAVOUR)
        if gap > widest + FAVOUR:
            widest = gap
            for k in range(3):
                axis[k] = -seen[f, PLANE + k]
            axis[KIND] = CARRIERS + f
    for k in range(KIND + 1):
        axis[FACE + k] = axis[k]
    if widest > enough:
        return widest
    face, mine = int(axis[KIND]), axis[KIND] >= CARRIERS
    if mine and widest > -FAVOUR and _lies_over(face - CARRIERS, widest, seen, count, others, n_others):
        return widest
    if not mine and widest > -FAVOUR and _lies_over(face, widest, others, n_others, seen, count):
        return widest
    _see_edges(count, others, n_others, seen)
    least = widest + FAVOUR
    for i in range(2 * n_others - RING):
        one, two, left, right = edge_of(i, n_others)
        start, a, b = others[one], others[left], others[right]
        e0, e1, e2 = others[two, 0] - start[0], others[two, 1] - start[1], others[two, 2] - start[2]
        mask = _looking(e0, e1, e2, seen, count)
        for j in range(2 * count - RING):
            row, odd = seen[j // 2], j % 2
            code, other = int(row[CODE + odd]), int(row[MASK + odd])
            under, over = code >> 4 & HEX, code >> 8
            if ((mask >> under) ^ (mask >> over)) & ((other >> left) ^ (other >> right)) & 1 == 0:
                continue
            g0, g1, g2 = row[ALONG + 3 * odd], row[ALONG + 3 * odd + 1], row[ALONG + 3 * odd + 2]
            x, y, z = e1 * g2 - e2 * g1, e2 * g0 - e0 * g2, e0 * g1 - e1 * g0
            square = x * x + y * y + z * z
            if square < PARALLEL * (e0 * e0 + e1 * e1 + e2 * e2) * (g0 * g0 + g1 * g1 + g2 * g2):
                continue
            s, t, own = seen[under], seen[over], seen[code & HEX]
            out = x * (a[3] + b[3]) + y * (a[4] + b[4]) + z * (a[5] + b[5])
            if out * (x * (s[3] + t[3]) + y * (s[4] + t[4]) + z * (s[5] + t[5])) > 0.0:
                continue
            scale = (1.0 if out > 0.0 else -1.0) / math.sqrt(square)
            gap = scale * (x * (own[0] - start[0]) + y * (own[1] - start[1]) + z * (own[2] - start[2]))
            if gap > least:
                widest = least = gap
                axis[0] = scale * x
                axis[1] = scale * y
                axis[2] = scale * z
                axis[KIND] = EDGES + MOST_EDGES * i + j
    return widest


@kernel(_t.boolean(VECTOR, _t.int64, _t.int64, LAYOUT, VECTOR, MATRIX, VECTOR))
def cross_worn(rel, c, p, pile, axis, ends, y):
    """Write the point of the carrier's edge nearest to the partner's, in the partner's axes; return whether the edges cross there."""
    edge = int(axis[KIND]) - EDGES
    one, two, _, _ = edge_of(edge // MOST_EDGES, pile.counts[p])
    own, far, _, _ = edge_of(edge % MOST_EDGES, pile.counts[c])
    see(rel, pile.corners[c, own], ends[0])
    see(rel, pile.corners[c, far], ends[1])
    ee, eg, gg, re, rg = 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(3):
        e, g = pile.corners[p, two, k] - pile.corners[p, one, k], ends[1, k] - ends[0, k]
        r = ends[0, k] - pile.corners[p, one, k]
        ee += e * e
        eg += e * g
        gg += g * g
        re += r * e
        rg += r * g
    place = (eg * re - ee * rg) / (ee * gg - eg * eg)
    other = (re + place * eg) / ee
    for k in range(3):
        y[k] = ends[0, k] + place * (ends[1, k] - ends[0, k])
    over_own, over_other = OVERHANG / math.sqrt(gg), OVERHANG / math.sqrt(ee)
    return -over_own < place < 1.0 + over_own and -over_other < other < 1.0 + over_other
