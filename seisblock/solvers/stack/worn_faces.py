"""Where a face of a box lies over a face of another, one of them or both worn: bevels lie on faces, and faces on bevels."""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import MATRIX, VECTOR
from seisblock.solvers.stack.apart import CARRIERS, KIND, OVERHANG
from seisblock.solvers.stack.arguments import LAYOUT
from seisblock.solvers.stack.rings import OFFSET, PLANE, RING, at_face, height, see

_t = types()

MOST_WORN = 16
"""Points at which worn boxes may touch."""


@kernel(_t.void(VECTOR, _t.boolean, VECTOR, VECTOR), inline=True)
def _place(rel, moves, r, y):
    """Write where a corner is in the partner's axes: as it stands, or as seen from there."""
    if moves:
        see(rel, r, y)
    else:
        for k in range(3):
            y[k] = r[k]


@kernel(_t.int64(VECTOR, _t.boolean, VECTOR, MATRIX, _t.int64, VECTOR), inline=True)
def _facing(rel, moves, down, corners, count, y):
    """Return the face of a box that shows most in a direction, of those at the corner furthest along it."""
    deepest, most = 0, -math.inf
    for i in range(count):
        _place(rel, moves, corners[i], y)
        along = down[0] * y[0] + down[1] * y[1] + down[2] * y[2]
        if along > most:
            deepest, most = i, along
    shown, most = 0, -math.inf
    for f in range(count - 2):
        has = False
        for q in range(RING):
            has = has or at_face(f, q, count) == deepest
        if not has:
            continue
        x, v, z = corners[f, PLANE], corners[f, PLANE + 1], corners[f, PLANE + 2]
        if moves:
            n0 = rel[0] * x + rel[1] * v + rel[2] * z
            n1 = rel[3] * x + rel[4] * v + rel[5] * z
            n2 = rel[6] * x + rel[7] * v + rel[8] * z
            x, v, z = n0, n1, n2
        along = down[0] * x + down[1] * v + down[2] * z
        if along > most:
            shown, most = f, along
    return shown


@kernel(_t.int64(_t.int64, MATRIX, VECTOR, MATRIX))
def _clip(n, found, plane, left):
    """Cut a polygon off beyond a plane; return how many corners are left."""
    count = 0
    for i in range(n):
        one, two = found[i], found[(i + 1) % n]
        a, b = -height(plane, one), -height(plane, two)
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


@kernel(_t.void(VECTOR, _t.boolean, _t.int64, _t.int64, LAYOUT, VECTOR, VECTOR, MATRIX), inline=True)
def _fence(rel, mine, bed, face, pile, out, y, borders):
    """Write the four planes, upright on a face, that pass through its sides: normal outwards, and offset, a little beyond."""
    count = pile.counts[bed]
    for q in range(RING):
        border = borders[q // 2, RING * (q % 2) :]
        one, two, third = y, y[3:], y[6:]
        _place(rel, mine, pile.corners[bed, at_face(face, q, count)], one)
        _place(rel, mine, pile.corners[bed, at_face(face, (q + 1) % RING, count)], two)
        _place(rel, mine, pile.corners[bed, at_face(face, (q + 2) % RING, count)], third)
        a0, a1, a2 = two[0] - one[0], two[1] - one[1], two[2] - one[2]
        x, v, z = a1 * out[2] - a2 * out[1], a2 * out[0] - a0 * out[2], a0 * out[1] - a1 * out[0]
        inward = x * (third[0] - one[0]) + v * (third[1] - one[1]) + z * (third[2] - one[2])
        scale = (-1.0 if inward > 0.0 else 1.0) / math.sqrt(x * x + v * v + z * z)
        border[0], border[1], border[2] = scale * x, scale * v, scale * z
        border[OFFSET] = border[0] * one[0] + border[1] * one[1] + border[2] * one[2] + OVERHANG


@kernel(_t.int64(VECTOR, _t.int64, _t.int64, LAYOUT, VECTOR, MATRIX, _t.float64, MATRIX, MATRIX))
def overlap_worn(rel, c, p, pile, axis, work, far, found, spare):
    """Write where two faces lie over each other: x, y, z in the partner's axes, and the gap there; return how many points.

    Bevels may be so flat that the stone lands on the next face within a step: its other corners over the face count, too.

    Parameters
    ----------
    rel : (18,) array
    c, p : int
    axis : (4,) array
        A normal of a face.
    work : (3, 18) array
        Scratch.
    far : float, m
        Gap within which corners of other faces are of interest.
    found, spare : (16, 18), (9, 18) arrays
        Scratch; the points stand in the first.
    """
    mine = axis[KIND] >= CARRIERS
    face = int(axis[KIND]) - CARRIERS if mine else int(axis[KIND])
    bed, lies = (c, p) if mine else (p, c)
    out, down, y, borders = work[0], work[0, 3:], work[0, 6:], work[1:]
    for k in range(3):
        out[k] = -axis[k] if mine else axis[k]
        down[k] = -out[k]
    _fence(rel, mine, bed, face, pile, out, y, borders)
    _place(rel, mine, pile.corners[bed, at_face(face, 0, pile.counts[bed])], y)
    level = out[0] * y[0] + out[1] * y[1] + out[2] * y[2]
    count = pile.counts[lies]
    shown = _facing(rel, not mine, down, pile.corners[lies], count, y)
    for q in range(RING):
        _place(rel, not mine, pile.corners[lies, at_face(shown, q, count)], found[q])
    points = RING
    for q in range(0, RING, 2):
        points = _clip(points, found, borders[q // 2], spare)
        points = _clip(points, spare, borders[q // 2, RING:], found)
    for i in range(count):
        corner = found[points]
        _place(rel, not mine, pile.corners[lies, i], corner)
        if out[0] * corner[0] + out[1] * corner[1] + out[2] * corner[2] - level > far or points == MOST_WORN - 2:
            continue
        over = True
        for q in range(RING):
            over = over and at_face(shown, q, count) != i and height(borders[q // 2, RING * (q % 2) :], corner) <= 0.0
        points += 1 if over else 0
    for q in range(points):
        found[q, 3] = out[0] * found[q, 0] + out[1] * found[q, 1] + out[2] * found[q, 2] - level
    return points
