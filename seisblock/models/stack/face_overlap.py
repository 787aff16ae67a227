"""Contact manifold of two faces of which one or both are round (cylinders).

Contact points are the rim points and corners of either face inside the other, with the other's normal, and the crossings of the two
outlines, with their common normal. Heights are measured from the reference face, the one more nearly opposed to the other stone.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import BLOCK, MATRIX, VECTOR
from seisblock.models.stack.box_box import contact_margin
from seisblock.models.stack.buffers import FACE_OVERLAP_KERNEL
from seisblock.models.stack.cylinder import RADIUS, lowest_rim_point
from seisblock.models.stack.spring_contact import REL_D

_t = types()

MIN_NORMAL_LENGTH = 1e-9
"""Length below which a cross product of two directions counts as zero."""

MERGE_RATIO, MERGE, MARGIN = 2e-3, 4, 5
"""Distance below which two points are merged, over the smallest half side or radius of both faces; and columns of both faces that hold it
and the contact margin, m."""

MAX_SHARED_POINTS = 16
IS_LOWEST, POINT_NORMAL = 4, 5
"""Columns of a contact point behind x, y, z and the gap: 1 for the lowest point of a rim, and the normal."""

ARC_COUNT, REFINEMENTS = 16, 4
"""Number of arcs of a rim that are searched for a crossing, and iterations that refine it."""


@kernel(_t.void(_t.int64, _t.int64, BLOCK, MATRIX, BLOCK, VECTOR), inline=True)
def _outline(box, side, corners, boxes, rims, plan):
    """Write the outline of a stone's face: radius, or zero; half sides; height, m."""
    plan[0] = rims[box, side, RADIUS]
    plan[1] = corners[box, 4 * side + 2, 0]
    plan[2] = corners[box, 4 * side + 2, 1]
    plan[3] = boxes[box, 2] if side == 1 else -boxes[box, 2]


@kernel(_t.float64(VECTOR), inline=True)
def _smallest_half_side(plan):
    return plan[0] if plan[0] > 0.0 else min(plan[1], plan[2])


@kernel(_t.boolean(_t.float64, _t.float64, VECTOR), inline=True)
def _inside_outline(x, y, plan):
    """Return whether a point lies inside an outline, within a margin."""
    # stones in line share outlines: without the margin, rounding would drop their corners
    if plan[0] > 0.0:
        return x * x + y * y < (plan[0] + plan[MARGIN]) ** 2
    return abs(x) < plan[1] + plan[MARGIN] and abs(y) < plan[2] + plan[MARGIN]


@kernel(_t.int64(_t.int64, _t.float64, VECTOR, VECTOR, _t.float64, _t.float64, MATRIX))
def _add_point(count, rise, y, normal, is_lowest, merge_distance, points):
    """Append a point at a height above a face unless it duplicates one; return the number of points."""
    size = math.sqrt(normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2)
    # parallel tangents have no common normal: the outlines touch without crossing
    if count >= MAX_SHARED_POINTS or size < MIN_NORMAL_LENGTH:
        return count
    # two rows for one point would leave the shares of its load undetermined
    for i in range(count):
        if (points[i, 0] - y[0]) ** 2 + (points[i, 1] - y[1]) ** 2 + (points[i, 2] - y[2]) ** 2 < merge_distance**2:
            return count
    for k in range(3):
        points[count, k] = y[k]
        points[count, POINT_NORMAL + k] = normal[k] / size
    # the rise is vertical; the gap is measured along the normal
    points[count, 3] = rise * abs(points[count, POINT_NORMAL + 2])
    points[count, IS_LOWEST] = is_lowest
    return count + 1


@kernel(_t.void(_t.float64, VECTOR, VECTOR, VECTOR), inline=True)
def _common_normal(side, u, v, normal):
    """Write the common normal of two directions, on the outer side of the lower face."""
    normal[0] = u[1] * v[2] - u[2] * v[1]
    normal[1] = u[2] * v[0] - u[0] * v[2]
    normal[2] = u[0] * v[1] - u[1] * v[0]
    if side * normal[2] < 0.0:
        for k in range(3):
            normal[k] = -normal[k]


@kernel(_t.float64(_t.float64, _t.float64, VECTOR, _t.float64), inline=True)
def _plane_height(x, y, view, height):
    """Return the height of the upper face's plane above a point of the lower face, in the lower stone's axes, m."""
    # the point at which the height in the upper stone's axes is that of its face, solved for z
    d0, d1 = x - view[REL_D], y - view[REL_D + 1]
    return view[REL_D + 2] + (height - view[2] * d0 - view[5] * d1) / view[8]


@kernel(_t.float64(_t.float64, VECTOR, VECTOR, VECTOR))
def _face_gap(side, view, lower_face, upper_face):
    """Return the gap between the lower face and the lowest point of the upper outline, m."""
    # distance of the lowest point of the outline below its centre
    reach = (
        upper_face[0] * math.sqrt(view[6] ** 2 + view[7] ** 2)
        if upper_face[0] > 0.0
        else abs(view[6]) * upper_face[1] + abs(view[7]) * upper_face[2]
    )
    return side * (view[REL_D + 2] + view[8] * upper_face[3] - lower_face[3]) - reach


@kernel(_t.void(_t.int64, _t.float64, VECTOR, VECTOR, VECTOR, VECTOR), inline=True)
def _corner(q, z, y, plan, view, image):
    """Write one of the four corners of a rectangular face, in its own axes and in those of the other stone."""
    y[0] = plan[1] if q == 0 or q == 3 else -plan[1]
    y[1] = plan[2] if q < 2 else -plan[2]
    for i in range(3):
        image[i] = view[REL_D + i] + view[3 * i] * y[0] + view[3 * i + 1] * y[1] + view[3 * i + 2] * z


@kernel(_t.int64(_t.int64, _t.float64, VECTOR, VECTOR, VECTOR, MATRIX, MATRIX))
def _contained_points(count, side, view, lower_face, upper_face, work, points):
    """Add the points of either outline that lie inside the other one.

    Parameters
    ----------
    work : (7, 18) array
        The four axes of :func:`lowest_rim_point`, two rows of scratch, and the direction of the first point of the lower rim, x and y.
    """
    # points of the upper outline inside the lower one, with the lower normal
    y, normal = work[4], work[5]
    normal[0], normal[1], normal[2] = 0.0, 0.0, side
    for q in range(4):
        direction, offset = work[2 + q % 2], upper_face[0] if q < 2 else -upper_face[0]
        if upper_face[0] > 0.0:
            for i in range(3):
                y[i] = view[REL_D + i] + offset * direction[i] + upper_face[3] * view[3 * i + 2]
        else:
            _corner(q, upper_face[3], y[3:], upper_face, view, y)
        if _inside_outline(y[0], y[1], lower_face):
            # the first point of a rim is its lowest
            is_lowest = 1.0 if q == 0 and upper_face[0] > 0.0 else 0.0
            count = _add_point(count, side * (y[2] - lower_face[3]), y, normal, is_lowest, lower_face[MERGE], points)
    for i in range(3):
        normal[i] = view[3 * i + 2] if side * view[8] > 0.0 else -view[3 * i + 2]
    # points of the lower outline inside the upper one, at quarter turns from its first point
    e0, e1 = work[6, 0], work[6, 1]
    for q in range(4):
        e, f = (1.0 if q == 0 else -1.0 if q == 2 else 0.0), (1.0 if q == 1 else -1.0 if q == 3 else 0.0)
        if lower_face[0] > 0.0:
            y[0], y[1] = lower_face[0] * (e * e0 - f * e1), lower_face[0] * (e * e1 + f * e0)
        else:
            y[0], y[1] = (lower_face[1] if q == 0 or q == 3 else -lower_face[1]), (lower_face[2] if q < 2 else -lower_face[2])
        y[2] = _plane_height(y[0], y[1], view, upper_face[3])
        d0, d1, d2 = y[0] - view[REL_D], y[1] - view[REL_D + 1], y[2] - view[REL_D + 2]
        if _inside_outline(view[0] * d0 + view[3] * d1 + view[6] * d2, view[1] * d0 + view[4] * d1 + view[7] * d2, upper_face):
            count = _add_point(count, side * (y[2] - lower_face[3]), y, normal, 0.0, lower_face[MERGE], points)
    return count


@kernel(_t.float64(_t.float64, VECTOR, VECTOR, VECTOR, MATRIX), inline=True)
def _rim_excess(angle, view, lower_face, upper_face, work):
    """Write a rim point and its tangent at an angle from the lowest point; return x^2 + y^2 - R^2, m^2 (derived here)."""
    u, w, y, direction = work[2], work[3], work[4], work[5]
    c, s = math.cos(angle), math.sin(angle)
    for i in range(3):
        y[i] = view[REL_D + i] + upper_face[0] * (c * u[i] + s * w[i]) + upper_face[3] * view[3 * i + 2]
        direction[i] = c * w[i] - s * u[i]
    return y[0] * y[0] + y[1] * y[1] - lower_face[0] * lower_face[0]


@kernel(_t.int64(_t.int64, _t.float64, VECTOR, VECTOR, VECTOR, MATRIX, MATRIX))
def _rim_rim_points(count, side, view, lower_face, upper_face, work, points):
    """Add the crossings of the rims of two round faces in plan: bracketed on arcs, refined by false position (Illinois)."""
    y, direction, tangent, normal = work[4], work[5], work[6], work[7]
    distance = math.sqrt((view[REL_D] + upper_face[3] * view[2]) ** 2 + (view[REL_D + 1] + upper_face[3] * view[5]) ** 2)
    if distance < max(lower_face[MARGIN], abs(upper_face[0] - lower_face[0])):  # one lies within the other, or they are one
        return count
    arc = 2.0 * math.pi / ARC_COUNT
    # arcs centred on the lowest point, so that none ends there
    first = _rim_excess(-0.5 * arc, view, lower_face, upper_face, work)
    for i in range(ARC_COUNT):
        low, high, at_low = (i - 0.5) * arc, (i + 0.5) * arc, first
        at_high = _rim_excess(high, view, lower_face, upper_face, work)
        first = at_high
        if (at_low > 0.0) == (at_high > 0.0):
            continue
        # Illinois variant of false position: halving the kept end value avoids slow one-sided convergence
        for _ in range(REFINEMENTS):
            middle = low + (high - low) * at_low / (at_low - at_high)
            at_middle = _rim_excess(middle, view, lower_face, upper_face, work)
            if (at_middle > 0.0) == (at_low > 0.0):
                low, at_low, at_high = middle, at_middle, 0.5 * at_high
            else:
                high, at_high, at_low = middle, at_middle, 0.5 * at_low
        tangent[0], tangent[1], tangent[2] = -y[1], y[0], 0.0
        _common_normal(side, tangent, direction, normal)
        count = _add_point(count, side * (y[2] - lower_face[3]), y, normal, 0.0, lower_face[MERGE], points)
    return count


@kernel(_t.int64(_t.int64, _t.float64, VECTOR, VECTOR, VECTOR, MATRIX, MATRIX))
def _side_rim_points(count, side, view, lower_face, upper_face, work, points):
    """Add the crossings of the sides of a rectangular face with the rim of a round one, in plan along the lower normal."""
    y, direction, tangent, normal, ends = work[4], work[5], work[6], work[7], work[8:12]
    radius = max(lower_face[0], upper_face[0])
    for q in range(4):
        end = ends[q]
        if lower_face[0] > 0.0:
            # corner of the upper face in the lower stone's axes, where the rim is
            _corner(q, upper_face[3], end[6:], upper_face, view, end[3:])
            end[0], end[1] = end[3], end[4]
        else:
            # corner of the lower face projected onto the upper one, in the upper stone's axes
            end[3], end[4] = (lower_face[1] if q == 0 or q == 3 else -lower_face[1]), (lower_face[2] if q < 2 else -lower_face[2])
            end[5] = _plane_height(end[3], end[4], view, upper_face[3])
            for i in range(2):
                end[i] = 0.0
                for j in range(3):
                    end[i] += view[3 * j + i] * (end[3 + j] - view[REL_D + j])
    for q in range(4):
        start, finish = ends[q], ends[(q + 1) % 4]
        # crossings are sought in plan, where the rim is a circle; columns 3 to 5 of an end hold the point in the lower stone's axes
        e0, e1 = finish[0] - start[0], finish[1] - start[1]
        a, b, c = e0 * e0 + e1 * e1, start[0] * e0 + start[1] * e1, start[0] ** 2 + start[1] ** 2 - radius * radius
        # side and circle intersect where |start + s e| = radius, a quadratic in s
        root = b * b - a * c
        # a side that misses the circle, or only touches it, does not cross it
        if root <= 0.0:
            continue
        for k in range(2):
            s = (-b + (math.sqrt(root) if k == 0 else -math.sqrt(root))) / a
            # crossings of the line beyond the ends of the side; the ends themselves are corners, added before
            if not 0.0 < s < 1.0:
                continue
            x0, x1 = start[0] + s * e0, start[1] + s * e1
            for i in range(3):
                direction[i] = finish[3 + i] - start[3 + i]
                y[i] = start[3 + i] + s * direction[i]
                tangent[i] = view[3 * i + 1] * x0 - view[3 * i] * x1
            if lower_face[0] > 0.0:
                tangent[0], tangent[1], tangent[2] = -x1, x0, 0.0
            else:
                direction[2] = 0.0
            _common_normal(side, tangent, direction, normal)
            count = _add_point(count, side * (y[2] - lower_face[3]), y, normal, 0.0, lower_face[MERGE], points)
    return count


@kernel(FACE_OVERLAP_KERNEL)
def face_overlap_points(c, p, rel, corners, boxes, rims, axis, work, points):
    """Write the contact manifold of two facing stones, at least one of them round; return its number of points.

    Parameters
    ----------
    c, p : int
        Carrier and partner.
    rel : (18,) array
    corners, boxes, rims : (b, 16, 7), (b, 6), (b, 4, 2) arrays
        Of all stones, see :class:`seisblock.models.stack.buffers.PileLayout`.
    axis : (10,) array
        Normal of the reference face out of the partner, in its axes, and 1 if the reference face is the carrier's; from column 4 on the
        fallback directions without a lean, of the carrier's rim (3) and of the partner's (3).
    work : (15, 18) array
        Scratch: the view, both outlines, the four axes of :func:`lowest_rim_point`, and eight more rows.
    points : (16, 18) array
        Result: x, y, z in the partner's axes, gap, m, 1 for the lowest point of a rim, and the normal out of the partner.
    """
    view, lower_face, upper_face, axes = work[0], work[1], work[2], work[3:15]
    side = 1.0 if rel[REL_D + 2] > 0.0 else -1.0
    upper_side = -side if rel[8] > 0.0 else side
    _outline(p, 1 if side > 0.0 else 0, corners, boxes, rims, lower_face)
    _outline(c, 1 if upper_side > 0.0 else 0, corners, boxes, rims, upper_face)
    lower_face[MERGE] = MERGE_RATIO * min(_smallest_half_side(lower_face), _smallest_half_side(upper_face))
    lower_face[MARGIN] = upper_face[MARGIN] = contact_margin(c, p, boxes)
    gap = _face_gap(side, rel, lower_face, upper_face)
    for i in range(3):
        for j in range(3):
            view[3 * i + j] = rel[3 * j + i]
        view[REL_D + i] = -(rel[i] * rel[9] + rel[3 + i] * rel[10] + rel[6 + i] * rel[11])
    # the face with the wider gap is the reference, as in the separating-axis test
    is_flipped = _face_gap(upper_side, view, upper_face, lower_face) > gap + lower_face[MARGIN]
    if is_flipped:
        # from here on all is in the axes of the reference face; the points return to the partner's at the end
        side = upper_side
        for i in range(4):
            lower_face[i], upper_face[i] = upper_face[i], lower_face[i]
    else:
        for i in range(REL_D + 3):
            view[i] = rel[i]
    for i in range(3):
        axes[0, i] = view[3 * i + 2]
        axis[i] = -side * rel[3 * i + 2] if is_flipped else (side if i == 2 else 0.0)
    axis[3] = 1.0 if is_flipped else 0.0
    upper_axis, lower_axis, first = (axis[7:], axis[4:], axes[6]) if is_flipped else (axis[4:], axis[7:], axes[6])
    for i in range(3):
        axes[1, i] = rel[i] * upper_axis[0] + rel[3 + i] * upper_axis[1] + rel[6 + i] * upper_axis[2] if is_flipped else upper_axis[i]
        first[i] = rel[i] * lower_axis[0] + rel[3 + i] * lower_axis[1] + rel[6 + i] * lower_axis[2] if is_flipped else lower_axis[i]
    # with a lean, the points of the lower rim begin in the direction of the lowest point of the upper one
    if lowest_rim_point(0.0, 0.0, side, axes) > 0.0:
        first[0], first[1] = axes[2, 0], axes[2, 1]
    size = math.sqrt(first[0] * first[0] + first[1] * first[1])
    first[0], first[1] = first[0] / size, first[1] / size
    count = _contained_points(0, side, view, lower_face, upper_face, axes, points)
    if lower_face[0] > 0.0 and upper_face[0] > 0.0:
        count = _rim_rim_points(count, side, view, lower_face, upper_face, axes, points)
    else:
        count = _side_rim_points(count, side, view, lower_face, upper_face, axes, points)
    if is_flipped:
        # back to the partner's axes
        for q in range(count):
            a0, a1, a2 = points[q, 0], points[q, 1], points[q, 2]
            n0, n1, n2 = points[q, POINT_NORMAL], points[q, POINT_NORMAL + 1], points[q, POINT_NORMAL + 2]
            for i in range(3):
                points[q, i] = rel[REL_D + i] + rel[3 * i] * a0 + rel[3 * i + 1] * a1 + rel[3 * i + 2] * a2
                points[q, POINT_NORMAL + i] = -(rel[3 * i] * n0 + rel[3 * i + 1] * n1 + rel[3 * i + 2] * n2)
    return count
