"""Two boxes, sharp or worn: how far they are apart, and where they would meet."""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import MATRIX, VECTOR
from seisblock.solvers.stack.apart import FACE, MOST_POINTS, cross, furthest, overlap
from seisblock.solvers.stack.arguments import LAYOUT
from seisblock.solvers.stack.worn import cross_worn, furthest_worn
from seisblock.solvers.stack.worn_faces import MOST_WORN, overlap_worn

_t = types()

PLAIN = 8
"""Corners of a box whose faces are not worn."""

ALMOST = 0.25
"""Part of its height over the worn face at which the upper border of a bevel is looked at."""

SEEN, VIEW = 4, 30
"""Where scratch begins for what a box sees of another: of all of it, while no points are found; and of an edge or a face."""


@kernel(_t.boolean(_t.int64, _t.int64, LAYOUT), inline=True)
def _sharp(c, p, pile):
    """Whether neither of two boxes is worn."""
    return pile.counts[c] <= PLAIN and pile.counts[p] <= PLAIN


@kernel(_t.int64(_t.int64, _t.int64, LAYOUT), inline=True)
def most_points(c, p, pile):
    """Return at how many points two boxes may touch at most."""
    return MOST_POINTS if _sharp(c, p, pile) else MOST_WORN


@kernel(_t.float64(VECTOR, _t.int64, _t.int64, _t.float64, LAYOUT, MATRIX, VECTOR), inline=True)
def gap_between(rel, c, p, enough, pile, work, axis):
    """Return the widest gap between a carrier and a partner, and write its axis: see :func:`furthest`."""
    if _sharp(c, p, pile):
        return furthest(rel, pile.cores[c], pile.cores[p], enough, axis)
    return furthest_worn(rel, c, p, enough, pile, work[SEEN:], axis)


@kernel(_t.boolean(VECTOR, _t.int64, _t.int64, LAYOUT, VECTOR, MATRIX, VECTOR), inline=True)
def edges_cross(rel, c, p, pile, axis, work, y):
    """Write where edges are nearest to each other, and return whether they cross there: see :func:`cross`."""
    if _sharp(c, p, pile):
        return cross(rel, pile.cores[c], pile.cores[p], axis, y)
    return cross_worn(rel, c, p, pile, axis, work[VIEW:], y)


@kernel(_t.int64(VECTOR, _t.int64, _t.int64, LAYOUT, VECTOR, MATRIX, _t.float64, MATRIX, MATRIX), inline=True)
def faces_overlap(rel, c, p, pile, axis, work, far, found, spare):
    """Write where faces lie over each other, and return at how many points: see :func:`overlap`."""
    if _sharp(c, p, pile):
        return overlap(rel, pile.cores[c], pile.cores[p], axis[FACE:], work[1], found, spare)
    return overlap_worn(rel, c, p, pile, axis[FACE:], work[VIEW:], far, found, spare)


@kernel(_t.boolean(VECTOR, _t.int64, _t.int64, _t.float64, _t.float64, LAYOUT))
def bevel_meets(rel, c, p, sigma, far, pile):
    """Whether a stone leans so far that a bevel of it comes to lie on the face its joint is on: -1, on the upper one, or +1."""
    level = pile.cores[c, 2]
    for i in range(PLAIN, pile.counts[c]):
        r = pile.corners[c, i]
        gap = -sigma * (rel[11] + rel[6] * r[0] + rel[7] * r[1] + rel[8] * r[2]) - pile.cores[p, 2]
        if gap < min(far, ALMOST * (level - sigma * r[2])):
            return True
    return False


@kernel(_t.boolean(MATRIX, _t.int64, _t.float64, _t.float64, _t.float64))
def on_face(corners, count, x, y, z):
    """Whether of the corners of a box one of a face lies furthest along a direction, and none where a bevel ends on the sides."""
    face, bevel = -math.inf, -math.inf
    for i in range(count):
        along = x * corners[i, 0] + y * corners[i, 1] + z * corners[i, 2]
        if i < PLAIN:
            face = max(face, along)
        else:
            bevel = max(bevel, along)
    return face >= bevel
