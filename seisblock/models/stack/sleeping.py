"""Sleeping bodies: stones that lie still become ground for the others while their support can carry the load.

A stone that has been still for some steps on a sleeping stone or on the ground goes to sleep: its contacts are no longer solved. The
load on its joint follows by summing the inertia, weight and load of the stones above, from the top down. Normal forces are distributed
over the support points as on an elastic bed; friction is proportional to them and to the displacement of each point about their centre.
If no point pulls and none leaves Coulomb's cone, these forces solve the contact laws with the stone at rest (derived here). Otherwise all
stones wake, in this step and the following ones.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.models.stack.buffers import LAYOUT, MEMORY
from seisblock.models.stack.constraint_assembly import (
    BODY_IDS,
    FREE_FALL_SPEED,
    FROM_JOINT,
    FULL_STEP,
    KICK_TIME,
    PRESS_TIME,
    STILL_STEPS,
    SUPPORT_BODY,
    SUPPORT_POINTS,
)
from seisblock.models.stack.constraint_row import ARM_A, ARM_B, GAP, IMPULSE, NORMAL, STATIC
from seisblock.models.stack.frames import INERTIA, MASS, F, L, T, V, X
from seisblock.models.stack.spring_contact import CACHED_FORCE, PREVIOUS_FORCE

_t = types()

SLEEP_SPEED_RATIO = 5e-3
"""Speed, over that of a free fall of a step, below which a stone is still."""

SLEEP_DELAY_STEPS = 20
"""Steps for which a stone must be still before it sleeps; twice as many after a wake-up."""

CONTACT_GAP_RATIO = 0.01
"""Gap, over the distance of a free fall of a step, below which a contact is a support point."""

MIN_WIDTH_RATIO = 1e-3
"""Smallest squared ratio of width to length of the support area."""

SUPPORT_CENTRE, SUPPORT_NORMAL, SUPPORT_MOMENTS = 0, 3, 6
"""First row of a support: its centre from the stone's centre (3), m; normal into the stone (3); inverse of its second moments (6)."""

POINT_OFFSET, POINT_FORCE, POINT_FRICTION, POINT_SLOT, POINT_SIDE, POINT_PRESSURE, SELF_STRESS, LAST_FORCE = 0, 3, 6, 7, 11, 12, 13, 14
SUPPORT_COLUMNS = 17
"""A support point's row: offset from the centre (3), m; force on the stone (3), N; friction coefficient; slot that stores its force (4); 1
or -1 if the stone is the first or the second body of that slot; normal force on trial, N; share in the self-equilibrated force of four
points; and force of the last step (3), N."""


@kernel(_t.boolean(_t.int64, _t.int64, _t.int64, MEMORY))
def _find_support(i, n, count, memory):
    """Write the support points of a stone; return whether they belong to a single sleeping stone or to the ground."""
    support_points, sleep_state, step_info = memory.support_points[i], memory.sleep_states[i], memory.step_info
    press_time = step_info[PRESS_TIME]
    points, support = 0, -1
    for k in range(count):
        row, ids = memory.constraint_rows[k], memory.contact_ids[k]
        a, b = ids[BODY_IDS], ids[BODY_IDS + 1]
        if (a != i and b != i) or row[GAP] > CONTACT_GAP_RATIO * step_info[FULL_STEP] * step_info[FREE_FALL_SPEED]:
            continue
        side, neighbour, arm = (1.0, b, ARM_A) if a == i else (-1.0, a, ARM_B)
        if memory.sleep_states[neighbour, SUPPORT_POINTS] == 0:
            continue
        # several supports, a support above, or too many points: the distribution of the load is not known
        if (support >= 0 and neighbour != support) or (neighbour > i and neighbour != n) or points + 1 >= support_points.shape[0]:
            return False
        support = neighbour
        points += 1
        point, alignment = support_points[points], 0.0
        for m in range(3):
            if points == 1:
                support_points[0, SUPPORT_NORMAL + m] = side * row[NORMAL + m]
            alignment += support_points[0, SUPPORT_NORMAL + m] * side * row[NORMAL + m]
            point[POINT_OFFSET + m] = row[arm + m]
            # the first load asleep is that of the last solved step
            point[POINT_FORCE + m] = side * row[IMPULSE + m] / press_time
        # the points must share one normal to form an elastic bed
        if alignment < 1.0 - 1e-9:
            return False
        point[POINT_FRICTION] = row[STATIC]
        point[POINT_SIDE] = side
        for m in range(4):
            point[POINT_SLOT + m] = ids[2 + m]
    # fewer than three points do not support a stone
    if points < 3:
        return False
    sleep_state[SUPPORT_BODY] = support
    sleep_state[SUPPORT_POINTS] = points
    return True


@kernel(_t.float64(VECTOR, VECTOR, VECTOR, VECTOR), inline=True)
def _triangle_area(a, b, c, head):
    """Return twice the signed area of a triangle, positive counter-clockwise about the support normal."""
    x, y, z = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    p, q, r = c[0] - a[0], c[1] - a[1], c[2] - a[2]
    return head[SUPPORT_NORMAL] * (y * r - z * q) + head[SUPPORT_NORMAL + 1] * (z * p - x * r) + head[SUPPORT_NORMAL + 2] * (x * q - y * p)


@kernel(_t.boolean(_t.int64, MATRIX), inline=True)
def _remove_tension(points, support_points):
    """Remove tension by adding a self-equilibrated force of four points; return whether no point pulls."""
    # any multiple of the self-equilibrated force leaves force and moment as they are: interval of multiples without
    # tension
    low, high = -math.inf, math.inf
    for k in range(1, points + 1):
        pressure, self_stress = support_points[k, POINT_PRESSURE], support_points[k, SELF_STRESS]
        if self_stress > 0.0:
            low = max(low, -pressure / self_stress)
        elif self_stress < 0.0:
            high = min(high, -pressure / self_stress)
        elif pressure < 0.0:
            return False
    if low > high:
        return False
    # the smallest change that removes the tension: none if no point pulls
    shift = min(max(0.0, low), high)
    for k in range(1, points + 1):
        support_points[k, POINT_PRESSURE] = max(support_points[k, POINT_PRESSURE] + shift * support_points[k, SELF_STRESS], 0.0)
    return True


@kernel(_t.boolean(_t.int64, MATRIX))
def _support_moments(points, support_points):
    """Write the centre of a support and the inverse of its second moments; return whether it is wide enough."""
    head = support_points[0]
    for m in range(3):
        head[SUPPORT_CENTRE + m] = 0.0
        for k in range(1, points + 1):
            head[SUPPORT_CENTRE + m] += support_points[k, POINT_OFFSET + m] / points
    a, b, c, d, e, f = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(1, points + 1):
        point = support_points[k]
        x, y, z = (
            point[POINT_OFFSET] - head[SUPPORT_CENTRE],
            point[POINT_OFFSET + 1] - head[SUPPORT_CENTRE + 1],
            point[POINT_OFFSET + 2] - head[SUPPORT_CENTRE + 2],
        )
        point[POINT_OFFSET] = x
        point[POINT_OFFSET + 1] = y
        point[POINT_OFFSET + 2] = z
        a, b, c, d, e, f = a + x * x, b + x * y, c + x * z, d + y * y, e + y * z, f + z * z
    # four points are statically indeterminate: the areas of the opposite triangles, with alternating signs, load no stone
    for k in range(points):
        support_points[1 + k, SELF_STRESS] = (
            _triangle_area(support_points[1 + (k + 1) % 4], support_points[1 + (k + 2) % 4], support_points[1 + (k + 3) % 4], head)
            if points == 4
            else 0.0
        )
        if k % 2 == 1:
            support_points[1 + k, SELF_STRESS] *= -1.0
    # the second moments are singular along the normal of a flat bed: fill that direction with the trace
    size = a + d + f
    x, y, z = head[SUPPORT_NORMAL], head[SUPPORT_NORMAL + 1], head[SUPPORT_NORMAL + 2]
    a, b, c, d, e, f = a + size * x * x, b + size * x * y, c + size * x * z, d + size * y * y, e + size * y * z, f + size * z * z
    p, q, r = d * f - e * e, c * e - b * f, b * e - c * d
    determinant = a * p + b * q + c * r
    # points along a line carry no moment about it
    if determinant <= MIN_WIDTH_RATIO * size**3:
        return False
    head[SUPPORT_MOMENTS] = p / determinant
    head[SUPPORT_MOMENTS + 1] = q / determinant
    head[SUPPORT_MOMENTS + 2] = r / determinant
    head[SUPPORT_MOMENTS + 3] = (a * f - c * c) / determinant
    head[SUPPORT_MOMENTS + 4] = (b * c - a * e) / determinant
    head[SUPPORT_MOMENTS + 5] = (a * d - b * b) / determinant
    return True


@kernel(_t.boolean(_t.int64, _t.float64, _t.float64, _t.float64, _t.float64, _t.float64, _t.float64, MATRIX))
def _distribute_load(points, f0, f1, f2, t0, t1, t2, support_points):
    """Distribute a force and a torque about the stone's centre over its support; return whether every point is within its cone."""
    head = support_points[0]
    x, y, z = head[SUPPORT_CENTRE], head[SUPPORT_CENTRE + 1], head[SUPPORT_CENTRE + 2]
    n0, n1, n2 = head[SUPPORT_NORMAL], head[SUPPORT_NORMAL + 1], head[SUPPORT_NORMAL + 2]
    m0, m1, m2 = t0 - (y * f2 - z * f1), t1 - (z * f0 - x * f2), t2 - (x * f1 - y * f0)
    weight, twist = f0 * n0 + f1 * n1 + f2 * n2, m0 * n0 + m1 * n1 + m2 * n2
    # the stone would lift off
    if weight <= 0.0:
        return False
    # pressures q d at the points d balance the moment M where n x M = I q, with I the second moments of the points
    e0, e1, e2 = n1 * m2 - n2 * m1, n2 * m0 - n0 * m2, n0 * m1 - n1 * m0
    s = SUPPORT_MOMENTS
    # linear distribution of the normal forces: gradient from the tilting moment
    q0 = head[s] * e0 + head[s + 1] * e1 + head[s + 2] * e2
    q1 = head[s + 1] * e0 + head[s + 3] * e1 + head[s + 4] * e2
    q2 = head[s + 2] * e0 + head[s + 4] * e1 + head[s + 5] * e2
    # centre of pressure relative to the centre of the support, and polar moment of the normal forces
    c0, c1, c2, polar = 0.0, 0.0, 0.0, 0.0
    for k in range(1, points + 1):
        d = support_points[k]
        d[POINT_PRESSURE] = weight / points + q0 * d[0] + q1 * d[1] + q2 * d[2]
    if not _remove_tension(points, support_points):
        return False
    for k in range(1, points + 1):
        d, pressure = support_points[k], support_points[k, POINT_PRESSURE]
        c0, c1, c2 = c0 + pressure * d[0], c1 + pressure * d[1], c2 + pressure * d[2]
        polar += pressure * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2])
    c0, c1, c2 = c0 / weight, c1 / weight, c2 / weight
    # parallel axes: polar moment about the centre of pressure
    polar -= weight * (c0 * c0 + c1 * c1 + c2 * c2)
    g0, g1, g2 = (f0 - weight * n0) / weight, (f1 - weight * n1) / weight, (f2 - weight * n2) / weight
    # friction proportional to the pressure acts in its centre; a rotation about that centre takes the remaining twist
    twist -= weight * (n0 * (c1 * g2 - c2 * g1) + n1 * (c2 * g0 - c0 * g2) + n2 * (c0 * g1 - c1 * g0))
    rotation = twist / polar if polar > 0.0 else 0.0
    for k in range(1, points + 1):
        d, pressure = support_points[k], support_points[k, POINT_PRESSURE]
        x, y, z = d[0] - c0, d[1] - c1, d[2] - c2
        r0, r1, r2 = g0 + rotation * (n1 * z - n2 * y), g1 + rotation * (n2 * x - n0 * z), g2 + rotation * (n0 * y - n1 * x)
        # friction over pressure beyond the static coefficient: the stone would slide or turn
        if pressure > 0.0 and r0 * r0 + r1 * r1 + r2 * r2 > d[POINT_FRICTION] ** 2:
            return False
    for k in range(1, points + 1):
        d, pressure = support_points[k], support_points[k, POINT_PRESSURE]
        x, y, z = d[0] - c0, d[1] - c1, d[2] - c2
        r0, r1, r2 = g0 + rotation * (n1 * z - n2 * y), g1 + rotation * (n2 * x - n0 * z), g2 + rotation * (n0 * y - n1 * x)
        d[POINT_FORCE] = pressure * (n0 + r0)
        d[POINT_FORCE + 1] = pressure * (n1 + r1)
        d[POINT_FORCE + 2] = pressure * (n2 + r2)
    return True


@kernel(_t.boolean(_t.int64, MATRIX, _t.float64, _t.float64, _t.float64, LAYOUT, MEMORY))
def can_support(n, bodies, a0, a1, a2, pile, memory):
    """Add the support forces of the sleeping bodies; return whether all supports can carry their load."""
    kick_time = memory.step_info[KICK_TIME]
    for i in range(n):
        # kept apart: if a support fails, the stones wake from the forces before this trial
        for k in range(1, memory.sleep_states[i, SUPPORT_POINTS] + 1):
            for m in range(3):
                memory.support_points[i, k, LAST_FORCE + m] = memory.support_points[i, k, POINT_FORCE + m]
    # bodies are numbered from below: the upper stones come first, and their load is passed down
    for i in range(n - 1, -1, -1):
        points, s = memory.sleep_states[i, SUPPORT_POINTS], memory.sleep_states[i, SUPPORT_BODY]
        if points == 0:
            continue
        b, mass = bodies[i], pile.inertias[i, MASS]
        # force and moment that bring the stone to rest within the kick; F and T hold what already acts, from the stones above
        w0, w1, w2 = mass * (a0 - b[V] / kick_time), mass * (a1 - b[V + 1] / kick_time), mass * (a2 - b[V + 2] / kick_time)
        f0, f1, f2 = w0 - b[F], w1 - b[F + 1], w2 - b[F + 2]
        t0, t1, t2 = -b[L] / kick_time - b[T], -b[L + 1] / kick_time - b[T + 1], -b[L + 2] / kick_time - b[T + 2]
        if not _distribute_load(points, f0, f1, f2, t0, t1, t2, memory.support_points[i]):
            return False
        # load from above and support force together now bring the stone to rest
        b[F] = w0
        b[F + 1] = w1
        b[F + 2] = w2
        for k in range(3):
            b[T + k] = -b[L + k] / kick_time
        # reaction on the support, with its moment about the support's centre
        c = bodies[s]
        x, y, z = b[X] - c[X], b[X + 1] - c[X + 1], b[X + 2] - c[X + 2]
        c[F] -= f0
        c[F + 1] -= f1
        c[F + 2] -= f2
        c[T] -= t0 + y * f2 - z * f1
        c[T + 1] -= t1 + z * f0 - x * f2
        c[T + 2] -= t2 + x * f1 - y * f0
        memory.contact_matrix[i, s] = 1.0
        memory.contact_matrix[s, i] = 1.0
    return True


@kernel(_t.void(_t.int64, MATRIX, MEMORY))
def wake(n, bodies, memory):
    """Wake all bodies, warm-started from the forces of their last step asleep; clear the forces added on trial."""
    for i in range(n + 1):
        for k in range(F, T + 3):
            bodies[i, k] = 0.0
    for i in range(n):
        for k in range(1, memory.sleep_states[i, SUPPORT_POINTS] + 1):
            point = memory.support_points[i, k]
            j, o, q = int(point[POINT_SLOT + 1]), int(point[POINT_SLOT + 2]), int(point[POINT_SLOT + 3])
            slot = memory.joint_slots[j, o, q] if point[POINT_SLOT] == FROM_JOINT else memory.corner_slots[j, o, q]
            for m in range(3):
                slot[CACHED_FORCE + m] = point[POINT_SIDE] * point[LAST_FORCE + m]
                slot[PREVIOUS_FORCE + m] = slot[CACHED_FORCE + m]
        memory.sleep_states[i, SUPPORT_POINTS] = 0
        # negative: twice as many steps until it may sleep again
        memory.sleep_states[i, STILL_STEPS] = -SLEEP_DELAY_STEPS


@kernel(_t.void(_t.int64, _t.int64, LAYOUT, MEMORY))
def put_to_sleep(count, n, pile, memory):
    """Put bodies to sleep that have been still for enough steps on a sleeping support."""
    limit = (SLEEP_SPEED_RATIO * memory.step_info[FREE_FALL_SPEED]) ** 2
    for i in range(n):
        if memory.sleep_states[i, SUPPORT_POINTS] > 0:
            continue
        v, inertia, sleep_state = memory.body_velocities[i], pile.inertias[i], memory.sleep_states[i]
        # spins count as speeds at a radius of gyration
        gyration_squared = (inertia[INERTIA] + inertia[INERTIA + 4] + inertia[INERTIA + 8]) / inertia[MASS]
        speed_squared = v[0] ** 2 + v[1] ** 2 + v[2] ** 2 + gyration_squared * (v[3] ** 2 + v[4] ** 2 + v[5] ** 2)
        # a moving stone counts from zero again; the surplus after a wake-up stays
        sleep_state[STILL_STEPS] = sleep_state[STILL_STEPS] + 1 if speed_squared < limit else min(sleep_state[STILL_STEPS], 0)
        if sleep_state[STILL_STEPS] < SLEEP_DELAY_STEPS:
            continue
        # a stone without a support is examined again only after another delay
        sleep_state[STILL_STEPS] = 0
        if _find_support(i, n, count, memory) and not _support_moments(sleep_state[SUPPORT_POINTS], memory.support_points[i]):
            sleep_state[SUPPORT_POINTS] = 0
