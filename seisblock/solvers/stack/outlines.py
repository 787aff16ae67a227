"""Where the faces of two stones lie over each other, one of them round, or both.

They touch at the points of either's rim, or its corners, within the other, where the normal is the other's; and where the two outlines
cross, along the common normal of both. What lies is seen from the face on which it lies, the one that shows most.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import MATRIX, VECTOR
from seisblock.solvers.stack.apart import FAVOUR, OVERHANG
from seisblock.solvers.stack.arguments import LAYOUT
from seisblock.solvers.stack.contact import REL_D
from seisblock.solvers.stack.round import RADIUS, lowest

_t = types()

PARALLEL = 1e-9
"""Length of a common normal of two directions that have none."""

TOGETHER = 1e-3
"""Points closer than this, m, are one."""

MOST_FOUND = 16
LOWEST, ALONG = 4, 5
"""Where a point that was found says, behind x, y, z and the gap, whether it is the lowest of a rim, and along which normal."""

ARCS, CLOSER = 16, 4
"""Arcs of a rim that are looked at for a crossing, and how often the place of one is made better."""


@kernel(_t.void(_t.int64, _t.int64, LAYOUT, VECTOR), inline=True)
def _outline(box, side, pile, plan):
    """Write the outline of a stone's face: its radius, or zero and the half sides; and its height."""
    plan[0] = pile.rims[box, side, RADIUS]
    plan[1] = pile.corners[box, 4 * side + 2, 0]
    plan[2] = pile.corners[box, 4 * side + 2, 1]
    plan[3] = pile.boxes[box, 2] if side == 1 else -pile.boxes[box, 2]


@kernel(_t.boolean(_t.float64, _t.float64, VECTOR), inline=True)
def _within(x, y, plan):
    """Whether a point lies within an outline, or hardly beyond it."""
    if plan[0] > 0.0:
        return x * x + y * y < (plan[0] + OVERHANG) ** 2
    return abs(x) < plan[1] + OVERHANG and abs(y) < plan[2] + OVERHANG


@kernel(_t.int64(_t.int64, _t.float64, VECTOR, VECTOR, _t.float64, MATRIX))
def _keep(count, rise, y, normal, is_lowest, found):
    """Keep a point that is so far above a face, along a normal of any length, unless there is one; return how many there are then."""
    size = math.sqrt(normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2)
    if count >= MOST_FOUND or size < PARALLEL:
        return count
    for i in range(count):
        if (found[i, 0] - y[0]) ** 2 + (found[i, 1] - y[1]) ** 2 + (found[i, 2] - y[2]) ** 2 < TOGETHER**2:
            return count
    for k in range(3):
        found[count, k] = y[k]
        found[count, ALONG + k] = normal[k] / size
    found[count, 3] = rise * abs(found[count, ALONG + 2])
    found[count, LOWEST] = is_lowest
    return count + 1


@kernel(_t.void(_t.float64, VECTOR, VECTOR, VECTOR), inline=True)
def _common(side, one, other, normal):
    """Write the common normal of two directions, on the side of the face that lies below."""
    normal[0] = one[1] * other[2] - one[2] * other[1]
    normal[1] = one[2] * other[0] - one[0] * other[2]
    normal[2] = one[0] * other[1] - one[1] * other[0]
    if side * normal[2] < 0.0:
        for k in range(3):
            normal[k] = -normal[k]


@kernel(_t.float64(_t.float64, _t.float64, VECTOR, _t.float64), inline=True)
def _lifted(x, y, view, height):
    """Return the height at which the plane of the face that lies on another is over a point of this one."""
    d0, d1 = x - view[REL_D], y - view[REL_D + 1]
    return view[REL_D + 2] + (height - view[2] * d0 - view[5] * d1) / view[8]


@kernel(_t.float64(_t.float64, VECTOR, VECTOR, VECTOR))
def _apart(side, view, under, upon):
    """Return the gap between a face and the lowest of the outline that lies on it."""
    across = upon[0] * math.sqrt(view[6] ** 2 + view[7] ** 2) if upon[0] > 0.0 else abs(view[6]) * upon[1] + abs(view[7]) * upon[2]
    return side * (view[REL_D + 2] + view[8] * upon[3] - under[3]) - across


@kernel(_t.void(_t.int64, _t.float64, VECTOR, VECTOR, VECTOR, VECTOR), inline=True)
def _corner(q, z, y, plan, view, seen):
    """Write one of the four corners of a rectangular face, in its own axes and as the other face sees it."""
    y[0] = plan[1] if q == 0 or q == 3 else -plan[1]
    y[1] = plan[2] if q < 2 else -plan[2]
    for i in range(3):
        seen[i] = view[REL_D + i] + view[3 * i] * y[0] + view[3 * i + 1] * y[1] + view[3 * i + 2] * z


@kernel(_t.int64(_t.int64, _t.float64, VECTOR, VECTOR, VECTOR, MATRIX, MATRIX))
def _points(count, side, view, under, upon, work, found):
    """Keep the points of one outline, or the other, that lie within the other one.

    Parameters
    ----------
    work : (7, 18) array
        The four axes of :func:`lowest`, two rows of scratch, and the direction of the first point of the rim below, x and y.
    """
    y, normal = work[4], work[5]
    normal[0], normal[1], normal[2] = 0.0, 0.0, side
    for q in range(4):
        direction, across = work[2 + q % 2], upon[0] if q < 2 else -upon[0]
        if upon[0] > 0.0:
            for i in range(3):
                y[i] = view[REL_D + i] + across * direction[i] + upon[3] * view[3 * i + 2]
        else:
            _corner(q, upon[3], y[3:], upon, view, y)
        if _within(y[0], y[1], under):
            is_lowest = 1.0 if q == 0 and upon[0] > 0.0 else 0.0
            count = _keep(count, side * (y[2] - under[3]), y, normal, is_lowest, found)
    for i in range(3):
        normal[i] = view[3 * i + 2] if side * view[8] > 0.0 else -view[3 * i + 2]
    e0, e1 = work[6, 0], work[6, 1]
    for q in range(4):
        e, f = (1.0 if q == 0 else -1.0 if q == 2 else 0.0), (1.0 if q == 1 else -1.0 if q == 3 else 0.0)
        if under[0] > 0.0:
            y[0], y[1] = under[0] * (e * e0 - f * e1), under[0] * (e * e1 + f * e0)
        else:
            y[0], y[1] = (under[1] if q == 0 or q == 3 else -under[1]), (under[2] if q < 2 else -under[2])
        y[2] = _lifted(y[0], y[1], view, upon[3])
        d0, d1, d2 = y[0] - view[REL_D], y[1] - view[REL_D + 1], y[2] - view[REL_D + 2]
        if _within(view[0] * d0 + view[3] * d1 + view[6] * d2, view[1] * d0 + view[4] * d1 + view[7] * d2, upon):
            count = _keep(count, side * (y[2] - under[3]), y, normal, 0.0, found)
    return count


@kernel(_t.float64(_t.float64, VECTOR, VECTOR, VECTOR, MATRIX), inline=True)
def _beyond(angle, view, under, upon, work):
    """Write the point of a rim at an angle from its lowest, and the direction there; return how far it lies beyond a round face, m^2."""
    u, w, y, along = work[2], work[3], work[4], work[5]
    c, s = math.cos(angle), math.sin(angle)
    for i in range(3):
        y[i] = view[REL_D + i] + upon[0] * (c * u[i] + s * w[i]) + upon[3] * view[3 * i + 2]
        along[i] = c * w[i] - s * u[i]
    return y[0] * y[0] + y[1] * y[1] - under[0] * under[0]


@kernel(_t.int64(_t.int64, _t.float64, VECTOR, VECTOR, VECTOR, MATRIX, MATRIX))
def _cross_rims(count, side, view, under, upon, work, found):
    """Keep the points where the rims of two round faces cross, seen from above: sought on arcs, then by the rule of false position."""
    y, along, tangent, normal = work[4], work[5], work[6], work[7]
    beside = math.sqrt((view[REL_D] + upon[3] * view[2]) ** 2 + (view[REL_D + 1] + upon[3] * view[5]) ** 2)
    if beside < max(OVERHANG, abs(upon[0] - under[0])):  # one lies within the other, or they are one
        return count
    arc = 2.0 * math.pi / ARCS
    first = _beyond(-0.5 * arc, view, under, upon, work)
    for i in range(ARCS):
        low, high, at_low = (i - 0.5) * arc, (i + 0.5) * arc, first
        at_high = _beyond(high, view, under, upon, work)
        first = at_high
        if (at_low > 0.0) == (at_high > 0.0):
            continue
        for _ in range(CLOSER):
            middle = low + (high - low) * at_low / (at_low - at_high)
            at_middle = _beyond(middle, view, under, upon, work)
            if (at_middle > 0.0) == (at_low > 0.0):
                low, at_low, at_high = middle, at_middle, 0.5 * at_high
            else:
                high, at_high, at_low = middle, at_middle, 0.5 * at_low
        tangent[0], tangent[1], tangent[2] = -y[1], y[0], 0.0
        _common(side, tangent, along, normal)
        count = _keep(count, side * (y[2] - under[3]), y, normal, 0.0, found)
    return count


@kernel(_t.int64(_t.int64, _t.float64, VECTOR, VECTOR, VECTOR, MATRIX, MATRIX))
def _cross_sides(count, side, view, under, upon, work, found):
    """Keep the points where the sides of a rectangular face cross the rim of a round one, seen from above along the normal of the lower."""
    y, along, tangent, normal, ends = work[4], work[5], work[6], work[7], work[8:12]
    radius = max(under[0], upon[0])
    for q in range(4):
        end = ends[q]
        if under[0] > 0.0:
            # a corner of the upper face as the lower one sees it: there is the rim
            _corner(q, upon[3], end[6:], upon, view, end[3:])
            end[0], end[1] = end[3], end[4]
        else:
            # a corner of the lower face lifted onto the upper one, and where that is in its axes
            end[3], end[4] = (under[1] if q == 0 or q == 3 else -under[1]), (under[2] if q < 2 else -under[2])
            end[5] = _lifted(end[3], end[4], view, upon[3])
            for i in range(2):
                end[i] = 0.0
                for j in range(3):
                    end[i] += view[3 * j + i] * (end[3 + j] - view[REL_D + j])
    for q in range(4):
        one, two = ends[q], ends[(q + 1) % 4]
        e0, e1 = two[0] - one[0], two[1] - one[1]
        a, b, c = e0 * e0 + e1 * e1, one[0] * e0 + one[1] * e1, one[0] ** 2 + one[1] ** 2 - radius * radius
        root = b * b - a * c
        if root <= 0.0:
            continue
        for k in range(2):
            s = (-b + (math.sqrt(root) if k == 0 else -math.sqrt(root))) / a
            if not 0.0 < s < 1.0:
                continue
            x0, x1 = one[0] + s * e0, one[1] + s * e1
            for i in range(3):
                along[i] = two[3 + i] - one[3 + i]
                y[i] = one[3 + i] + s * along[i]
                tangent[i] = view[3 * i + 1] * x0 - view[3 * i] * x1
            if under[0] > 0.0:
                tangent[0], tangent[1], tangent[2] = -x1, x0, 0.0
            else:
                along[2] = 0.0
            _common(side, tangent, along, normal)
            count = _keep(count, side * (y[2] - under[3]), y, normal, 0.0, found)
    return count


@kernel(_t.int64(_t.int64, _t.int64, VECTOR, LAYOUT, VECTOR, MATRIX, MATRIX))
def shared_points(c, p, rel, pile, axis, work, found):
    """Write where two facing stones, one of them round, lie over each other; return how many points.

    Parameters
    ----------
    c, p : int
        The carrier and the partner.
    rel : (18,) array
    axis : (10,) array
        The normal of the face that shows most, out of the partner, in its axes, and 1 behind it where it is that of the carrier's; and from
        the fifth on the directions to take where there is no lean, of the carrier's rim (3) and of the partner's (3).
    work : (15, 18) array
        Scratch: the view, both outlines, the four axes of :func:`lowest`, and eight rows more.
    found : (16, 18) array
        x, y, z in the partner's axes, the gap, whether the point is the lowest of a rim, and the normal out of the partner.
    """
    view, under, upon, axes = work[0], work[1], work[2], work[3:15]
    side = 1.0 if rel[REL_D + 2] > 0.0 else -1.0
    own = -side if rel[8] > 0.0 else side
    _outline(p, 1 if side > 0.0 else 0, pile, under)
    _outline(c, 1 if own > 0.0 else 0, pile, upon)
    gap = _apart(side, rel, under, upon)
    for i in range(3):
        for j in range(3):
            view[3 * i + j] = rel[3 * j + i]
        view[REL_D + i] = -(rel[i] * rel[9] + rel[3 + i] * rel[10] + rel[6 + i] * rel[11])
    flipped = _apart(own, view, upon, under) > gap + FAVOUR
    if flipped:
        side = own
        for i in range(4):
            under[i], upon[i] = upon[i], under[i]
    else:
        for i in range(REL_D + 3):
            view[i] = rel[i]
    for i in range(3):
        axes[0, i] = view[3 * i + 2]
        axis[i] = -side * rel[3 * i + 2] if flipped else (side if i == 2 else 0.0)
    axis[3] = 1.0 if flipped else 0.0
    above, below, first = (axis[7:], axis[4:], axes[6]) if flipped else (axis[4:], axis[7:], axes[6])
    for i in range(3):
        axes[1, i] = rel[i] * above[0] + rel[3 + i] * above[1] + rel[6 + i] * above[2] if flipped else above[i]
        first[i] = rel[i] * below[0] + rel[3 + i] * below[1] + rel[6 + i] * below[2] if flipped else below[i]
    if lowest(0.0, 0.0, side, axes) > 0.0:
        first[0], first[1] = axes[2, 0], axes[2, 1]
    size = math.sqrt(first[0] * first[0] + first[1] * first[1])
    first[0], first[1] = first[0] / size, first[1] / size
    count = _points(0, side, view, under, upon, axes, found)
    if under[0] > 0.0 and upon[0] > 0.0:
        count = _cross_rims(count, side, view, under, upon, axes, found)
    else:
        count = _cross_sides(count, side, view, under, upon, axes, found)
    if flipped:
        for q in range(count):
            a0, a1, a2 = found[q, 0], found[q, 1], found[q, 2]
            n0, n1, n2 = found[q, ALONG], found[q, ALONG + 1], found[q, ALONG + 2]
            for i in range(3):
                found[q, i] = rel[REL_D + i] + rel[3 * i] * a0 + rel[3 * i + 1] * a1 + rel[3 * i + 2] * a2
                found[q, ALONG + i] = -(rel[3 * i] * n0 + rel[3 * i + 1] * n1 + rel[3 * i + 2] * n2)
    return count
