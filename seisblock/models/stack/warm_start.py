"""Warm start: match contact points between steps and carry over their forces, or redistribute the joint load.

Contact points differ from step to step: those of a round face follow the load, and corners of an overlap appear and vanish. The forces
of the last step act for half a step. A force without a matching point would be missing for that time; the new points then share the
load of all old ones, which preserves force, moment and twist of a flat joint.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.models.stack.box_box import smaller_half_length
from seisblock.models.stack.constraint_row import ARM_B, GAP, IMPULSE, NORMAL
from seisblock.models.stack.frames import R
from seisblock.models.stack.spring_contact import ACTIVE, CACHED_FORCE, CACHED_SLIDING, POSITION, PREVIOUS_FORCE, SLOT

_t = types()

MATCH_RATIO = 0.08
"""Largest distance between an old and a new contact point that are matched, over half the length of the smaller stone."""

MAX_SHIFT_RATIO = 1e-3
"""Largest shift of a point on a flat face, over the stone's size, at which it keeps its force."""

MIN_AREA = 1e-9
"""Twice the area of a degenerate triangle over the sum of the squares of two of its sides, at most."""

MAX_TENSION_RATIO = 0.1
"""Largest tension of a redistributed load, as a share of it: enough to keep the moment of a load just outside the triangle."""

LOAD_FORCE, LOAD_CENTRE, LOAD_TWIST, LOAD_NORMAL, LOAD_SLIDING = 0, 3, 5, 6, 7
LOAD_COLUMNS = 8
"""Load of a flat joint in the partner's axes: force (3), centre of pressure (2), twist about it, normal force; and 1 if a point slid."""


@kernel(_t.void(VECTOR, _t.float64, _t.float64, _t.float64, VECTOR), inline=True)
def store_point(slot, y0, y1, y2, axis):
    """Write a contact point and its normal into a slot."""
    slot[POSITION] = y0
    slot[POSITION + 1] = y1
    slot[POSITION + 2] = y2
    for i in range(3):
        slot[POSITION + 3 + i] = axis[i]


@kernel(_t.void(_t.int64, MATRIX, MATRIX), inline=True)
def save_slots(count, slots, old_slots):
    """Copy the slots of the last step and mark them free."""
    for i in range(count):
        for j in range(SLOT):
            old_slots[i, j] = slots[i, j]
        slots[i, ACTIVE] = 0.0


@kernel(_t.float64(_t.int64, _t.int64, MATRIX), inline=True)
def match_radius(c, p, boxes):
    """Return the largest distance between an old and a new contact point of two stones that are matched, m."""
    return MATCH_RATIO * smaller_half_length(c, p, boxes)


@kernel(_t.void(VECTOR, MATRIX, _t.int64, _t.float64), inline=True)
def match_point(slot, old_slots, count, radius):
    """Warm-start a contact from the nearest unmatched point of the last step within `radius`, m."""
    # a point farther away belongs to another contact: its force would be a worse guess than none
    match, min_distance_squared = -1, radius * radius
    for i in range(count):
        old = old_slots[i]
        if old[ACTIVE] > 0.0:
            distance_squared = (
                (old[POSITION] - slot[POSITION]) ** 2
                + (old[POSITION + 1] - slot[POSITION + 1]) ** 2
                + (old[POSITION + 2] - slot[POSITION + 2]) ** 2
            )
            if distance_squared < min_distance_squared:
                match, min_distance_squared = i, distance_squared
    slot[ACTIVE] = 0.0
    if match >= 0:
        old = old_slots[match]
        slot[ACTIVE] = 1.0
        slot[CACHED_SLIDING] = old[CACHED_SLIDING]
        for i in range(3):
            slot[CACHED_FORCE + i] = old[CACHED_FORCE + i]
            slot[PREVIOUS_FORCE + i] = old[PREVIOUS_FORCE + i]
        # an old point gives its force to one new point only
        old[ACTIVE] = 0.0


@kernel(_t.UniTuple(_t.float64, 3)(VECTOR, VECTOR), inline=True)
def _to_body_axes(force, frame):
    """Return a force in a body's axes."""
    x, y, z, r = force[0], force[1], force[2], R
    return (
        frame[r] * x + frame[r + 3] * y + frame[r + 6] * z,
        frame[r + 1] * x + frame[r + 4] * y + frame[r + 7] * z,
        frame[r + 2] * x + frame[r + 5] * y + frame[r + 8] * z,
    )


@kernel(_t.void(_t.int64, MATRIX, VECTOR, VECTOR), inline=True)
def _sum_forces(field, slots, frame, load):
    """Sum the forces of a flat joint's points stored in one field of their slots."""
    for k in range(LOAD_COLUMNS):
        load[k] = 0.0
    for i in range(slots.shape[0]):
        slot = slots[i]
        if slot[ACTIVE] > 0.0:
            f0, f1, f2 = _to_body_axes(slot[field:], frame)
            x, y = slot[POSITION], slot[POSITION + 1]
            load[LOAD_FORCE] += f0
            load[LOAD_FORCE + 1] += f1
            load[LOAD_FORCE + 2] += f2
            # first moments of the normal forces, divided below by their sum
            load[LOAD_CENTRE] += f2 * x
            load[LOAD_CENTRE + 1] += f2 * y
            load[LOAD_TWIST] += x * f1 - y * f0
            load[LOAD_NORMAL] += f2
    if load[LOAD_NORMAL] != 0.0:
        load[LOAD_CENTRE] /= load[LOAD_NORMAL]
        load[LOAD_CENTRE + 1] /= load[LOAD_NORMAL]
        # from the moment about the origin to that about the centre of pressure
        load[LOAD_TWIST] -= load[LOAD_CENTRE] * load[LOAD_FORCE + 1] - load[LOAD_CENTRE + 1] * load[LOAD_FORCE]


@kernel(_t.boolean(MATRIX, VECTOR, MATRIX), inline=True)
def sum_joint_load(slots, frame, loads):
    """Sum the load of a flat joint's points; return whether it is not zero.

    Parameters
    ----------
    slots : (k, 17) array
    frame : (31,) array
        The partner's body.
    loads : (2, 18) array
        Load in the last step, and in the step before.
    """
    _sum_forces(CACHED_FORCE, slots, frame, loads[0])
    _sum_forces(PREVIOUS_FORCE, slots, frame, loads[1])
    for i in range(slots.shape[0]):
        if slots[i, ACTIVE] > 0.0:
            loads[0, LOAD_SLIDING] = max(loads[0, LOAD_SLIDING], slots[i, CACHED_SLIDING])
    return loads[0, LOAD_NORMAL] != 0.0


@kernel(_t.boolean(_t.int64, MATRIX, MATRIX, _t.float64), inline=True)
def has_lost_loaded_point(points, slots, old_slots, radius):
    """Return whether a loaded point of the last step has no new point within `radius`, m."""
    # forces can be kept point by point only if every loaded point has a successor
    for i in range(old_slots.shape[0]):
        old, is_near = old_slots[i], False
        if old[ACTIVE] == 0.0 or (old[CACHED_FORCE] == 0.0 and old[CACHED_FORCE + 1] == 0.0 and old[CACHED_FORCE + 2] == 0.0):
            continue
        for j in range(points):
            x, y = slots[j, POSITION] - old[POSITION], slots[j, POSITION + 1] - old[POSITION + 1]
            is_near = is_near or x * x + y * y < radius * radius
        if not is_near:
            return True
    return False


@kernel(_t.UniTuple(_t.float64, 3)(VECTOR, VECTOR, VECTOR, _t.float64, _t.float64), inline=True)
def _barycentric(a, b, c, x, y):
    """Return the barycentric coordinates of a position in a triangle of points: negative outside."""
    a0, a1, b0, b1, c0, c1 = (
        a[POSITION] - x,
        a[POSITION + 1] - y,
        b[POSITION] - x,
        b[POSITION + 1] - y,
        c[POSITION] - x,
        c[POSITION + 1] - y,
    )
    area = (b0 - a0) * (c1 - a1) - (b1 - a1) * (c0 - a0)
    if abs(area) <= MIN_AREA * ((b0 - a0) ** 2 + (b1 - a1) ** 2 + (c0 - a0) ** 2 + (c1 - a1) ** 2):
        return -math.inf, -math.inf, -math.inf
    # areas of the partial triangles over that of the whole
    u, v = (b0 * c1 - b1 * c0) / area, (c0 * a1 - c1 * a0) / area
    return u, v, 1.0 - u - v


@kernel(_t.void(_t.int64, VECTOR, VECTOR, VECTOR, VECTOR, VECTOR), inline=True)
def _distribute_to_triangle(field, a, b, c, load, frame):
    """Distribute a load to three points: forces by barycentric coordinates, twist by the distance from the centre of pressure."""
    x, y = load[LOAD_CENTRE], load[LOAD_CENTRE + 1]
    u, v, w = _barycentric(a, b, c, x, y)
    # a load slightly outside the triangle is kept by limited tension, else its moment would be lost
    u, v, w = max(u, -MAX_TENSION_RATIO), max(v, -MAX_TENSION_RATIO), max(w, -MAX_TENSION_RATIO)
    total, polar = u + v + w, 0.0
    # the twist is carried by forces across the arms to the centre of pressure, in proportion to them
    for q in range(3):
        slot, weight = (a if q == 0 else b if q == 1 else c), (u if q == 0 else v if q == 1 else w) / total
        # polar moment about the centre of pressure, per unit load
        polar += weight * ((slot[POSITION] - x) ** 2 + (slot[POSITION + 1] - y) ** 2)
    rotation = load[LOAD_TWIST] / polar if polar > 0.0 else 0.0
    for q in range(3):
        slot, weight = (a if q == 0 else b if q == 1 else c), (u if q == 0 else v if q == 1 else w) / total
        f0, f1, f2 = (
            load[LOAD_FORCE] - rotation * (slot[POSITION + 1] - y),
            load[LOAD_FORCE + 1] + rotation * (slot[POSITION] - x),
            load[LOAD_FORCE + 2],
        )
        for k in range(3):
            slot[field + k] = weight * (frame[R + 3 * k] * f0 + frame[R + 3 * k + 1] * f1 + frame[R + 3 * k + 2] * f2)


@kernel(_t.boolean(_t.int64, MATRIX, MATRIX, VECTOR))
def distribute_load(points, slots, loads, frame):
    """Distribute a load to the triangle of points that carries it most evenly; return whether a triangle exists.

    Parameters
    ----------
    slots : (k, 17) array
        The new points.
    loads : (2, 18) array
        See :func:`sum_joint_load`.
    frame : (31,) array
        The partner's body.
    """
    # the triangle with the largest smallest coordinate carries the load most evenly
    best, first, second, third = -math.inf, 0, 0, 0
    for i in range(points):
        for j in range(i):
            for k in range(j):
                u, v, w = _barycentric(slots[i], slots[j], slots[k], loads[0, LOAD_CENTRE], loads[0, LOAD_CENTRE + 1])
                min_weight = min(u, min(v, w))
                if min_weight > best:
                    best, first, second, third = min_weight, i, j, k
    if best == -math.inf:
        return False
    for i in range(points):
        slots[i, ACTIVE] = 1.0
        slots[i, CACHED_SLIDING] = loads[0, LOAD_SLIDING]
        for k in range(3):
            slots[i, CACHED_FORCE + k] = 0.0
            slots[i, PREVIOUS_FORCE + k] = 0.0
    _distribute_to_triangle(CACHED_FORCE, slots[first], slots[second], slots[third], loads[0], frame)
    _distribute_to_triangle(PREVIOUS_FORCE, slots[first], slots[second], slots[third], loads[1], frame)
    return True


@kernel(_t.void(_t.int64, _t.int64, _t.float64, MATRIX))
def project_to_plane(first, count, max_gap, table):
    """Project the normal impulses of a flat joint with more than three points onto a plane distribution without tension.

    The individual forces are statically indeterminate, but friction against twist depends on them. The plane has the same force and
    moments, and the least sum of squares of all distributions that do (derived here).

    Parameters
    ----------
    first, count : int
        Rows of the joint.
    max_gap : float, m
        Gap below which points are in contact.
    table : (k, 92) array
    """
    if count - first <= 3:
        return
    n0, n1, n2 = table[first, NORMAL], table[first, NORMAL + 1], table[first, NORMAL + 2]
    c0, c1, c2, mean_press = 0.0, 0.0, 0.0, 0.0
    for i in range(first, count):
        # an open point: the joint is not flat, and the distribution is left alone
        if table[i, GAP] > max_gap:
            return
        c0 += table[i, ARM_B]
        c1 += table[i, ARM_B + 1]
        c2 += table[i, ARM_B + 2]
        mean_press += table[i, IMPULSE] * n0 + table[i, IMPULSE + 1] * n1 + table[i, IMPULSE + 2] * n2
    points = count - first
    c0, c1, c2, mean_press = c0 / points, c1 / points, c2 / points, mean_press / points
    # axes of unequal length do no harm: the slopes of the plane scale inversely
    # axes in the plane of the joint, from its centre to its first point and across
    e0, e1, e2 = table[first, ARM_B] - c0, table[first, ARM_B + 1] - c1, table[first, ARM_B + 2] - c2
    f0, f1, f2 = n1 * e2 - n2 * e1, n2 * e0 - n0 * e2, n0 * e1 - n1 * e0
    xx, xy, yy, mx, my = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(first, count):
        a0, a1, a2 = table[i, ARM_B] - c0, table[i, ARM_B + 1] - c1, table[i, ARM_B + 2] - c2
        x, y = a0 * e0 + a1 * e1 + a2 * e2, a0 * f0 + a1 * f1 + a2 * f2
        normal_impulse = table[i, IMPULSE] * n0 + table[i, IMPULSE + 1] * n1 + table[i, IMPULSE + 2] * n2
        xx += x * x
        xy += x * y
        yy += y * y
        mx += x * normal_impulse
        my += y * normal_impulse
    # least-squares plane: mean force and two slopes along axes in the joint's plane
    d = xx * yy - xy * xy
    # the points lie on a line and define no plane
    if d <= MIN_AREA * xx * yy:
        return
    gx, gy, scale = (mx * yy - my * xy) / d, (my * xx - mx * xy) / d, 1.0
    # the first pass limits the change so that no point pulls, the second applies it
    # all forces move to the plane by one common share: the sum of the changes has neither force nor moment, so that
    # the load stays
    for stage in range(2):
        for i in range(first, count):
            a0, a1, a2 = table[i, ARM_B] - c0, table[i, ARM_B + 1] - c1, table[i, ARM_B + 2] - c2
            x, y = a0 * e0 + a1 * e1 + a2 * e2, a0 * f0 + a1 * f1 + a2 * f2
            normal_impulse = table[i, IMPULSE] * n0 + table[i, IMPULSE + 1] * n1 + table[i, IMPULSE + 2] * n2
            change = mean_press + gx * x + gy * y - normal_impulse
            if stage == 1:
                table[i, IMPULSE] += scale * change * n0
                table[i, IMPULSE + 1] += scale * change * n1
                table[i, IMPULSE + 2] += scale * change * n2
            elif normal_impulse + change < 0.0:
                scale = min(scale, max(normal_impulse, 0.0) / -change)
