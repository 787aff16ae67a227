"""Stones that lie still are ground to those that move, as long as what they lie on can carry what is asked of it.

Where a stone has lain still for some steps on one other that lies still, or on the ground, its points are no longer solved for: what the
shaking, its weight and the stones above ask of its joint follows by adding up, from above. The normal forces that carry it are spread
over the points as an elastic bed would, friction in proportion to them and to the way of each about their centre. Where none of them
pulls and none leaves Coulomb's cone, they solve the contact laws with the stone at rest (derived here). Where one does, all stones are
solved for, in that step and the next ones.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import MATRIX, VECTOR
from seisblock.solvers.stack.arguments import LAYOUT, MEMORY
from seisblock.solvers.stack.contact import EARLIER, PUSH
from seisblock.solvers.stack.frames import INERTIA, MASS, F, L, T, V, X
from seisblock.solvers.stack.impulse import ARM_A, ARM_B, GAP, IMPULSE, NORMAL, STATIC
from seisblock.solvers.stack.row import FALL, FIRST, JOINTS, KICKED, POINTS, PRESSED, SUPPORT, WAIT, WHOLE

_t = types()

CALM = 5e-3
"""Speed, over that of a free fall of a step, below which a stone is still."""

PATIENCE = 20
"""Steps for which a stone is still before it counts as lying, and twice as many after it was roused."""

CLOSE = 0.01
"""Gap, over the way of a free fall of a step, below which a point carries."""

WIDE = 1e-3
"""Least square of the width of a bed over that of its length."""

MIDDLE, UP, SPREAD = 0, 3, 6
"""A bed's first row: its middle from the stone's centre (3), m; its normal, into the stone (3); the inverse of its second moments (6)."""

AWAY, SHARE, ROUGH, OF, SIDE, PRESS, FREE, WAS = 0, 3, 6, 7, 11, 12, 13, 14
BED = 17
"""A point's row: from the middle of the bed (3), m; the force on the stone (3), N; friction; the slot that remembers its force (4); whether
the stone is the first or, -1, the second of that slot; what presses, N, as long as it is not known whether the bed carries; its part in
what four points do against each other without anybody feeling it; and the force of the step before (3), N."""


@kernel(_t.boolean(_t.int64, _t.int64, _t.int64, MEMORY))
def _gather(i, n, count, memory):
    """Write the points on which a stone lies into its bed; return whether they are those of one stone that lies, or of the ground."""
    bed, lying, pace = memory.beds[i], memory.lying[i], memory.pace
    pressed = pace[PRESSED]
    points, support = 0, -1
    for k in range(count):
        row, who = memory.table[k], memory.who[k]
        a, b = who[FIRST], who[FIRST + 1]
        if (a != i and b != i) or row[GAP] > CLOSE * pace[WHOLE] * pace[FALL]:
            continue
        side, other, arm = (1.0, b, ARM_A) if a == i else (-1.0, a, ARM_B)
        if memory.lying[other, POINTS] == 0:
            continue
        if (support >= 0 and other != support) or (other > i and other != n) or points + 1 >= bed.shape[0]:
            return False
        support = other
        points += 1
        point, along = bed[points], 0.0
        for m in range(3):
            if points == 1:
                bed[0, UP + m] = side * row[NORMAL + m]
            along += bed[0, UP + m] * side * row[NORMAL + m]
            point[AWAY + m] = row[arm + m]
            point[SHARE + m] = side * row[IMPULSE + m] / pressed
        if along < 1.0 - 1e-9:
            return False
        point[ROUGH] = row[STATIC]
        point[SIDE] = side
        for m in range(4):
            point[OF + m] = who[2 + m]
    if points < 3:
        return False
    lying[SUPPORT] = support
    lying[POINTS] = points
    return True


@kernel(_t.float64(VECTOR, VECTOR, VECTOR, VECTOR), inline=True)
def _triangle(a, b, c, head):
    """Return twice the area of a triangle, positive where its corners go round the normal of a bed."""
    x, y, z = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    p, q, r = c[0] - a[0], c[1] - a[1], c[2] - a[2]
    return head[UP] * (y * r - z * q) + head[UP + 1] * (z * p - x * r) + head[UP + 2] * (x * q - y * p)


@kernel(_t.boolean(_t.int64, MATRIX), inline=True)
def _press_evenly(points, bed):
    """Shift normal forces between four points as far as keeps them from pulling; return whether none pulls."""
    low, high = -math.inf, math.inf
    for k in range(1, points + 1):
        press, free = bed[k, PRESS], bed[k, FREE]
        if free > 0.0:
            low = max(low, -press / free)
        elif free < 0.0:
            high = min(high, -press / free)
        elif press < 0.0:
            return False
    if low > high:
        return False
    shift = min(max(0.0, low), high)
    for k in range(1, points + 1):
        bed[k, PRESS] = max(bed[k, PRESS] + shift * bed[k, FREE], 0.0)
    return True


@kernel(_t.boolean(_t.int64, MATRIX))
def _measure(points, bed):
    """Write the middle of a bed and the inverse of its second moments; return whether it is wide enough to lie on."""
    head = bed[0]
    for m in range(3):
        head[MIDDLE + m] = 0.0
        for k in range(1, points + 1):
            head[MIDDLE + m] += bed[k, AWAY + m] / points
    a, b, c, d, e, f = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(1, points + 1):
        point = bed[k]
        x, y, z = point[AWAY] - head[MIDDLE], point[AWAY + 1] - head[MIDDLE + 1], point[AWAY + 2] - head[MIDDLE + 2]
        point[AWAY] = x
        point[AWAY + 1] = y
        point[AWAY + 2] = z
        a, b, c, d, e, f = a + x * x, b + x * y, c + x * z, d + y * y, e + y * z, f + z * z
    for k in range(points):
        bed[1 + k, FREE] = _triangle(bed[1 + (k + 1) % 4], bed[1 + (k + 2) % 4], bed[1 + (k + 3) % 4], head) if points == 4 else 0.0
        if k % 2 == 1:
            bed[1 + k, FREE] *= -1.0
    size = a + d + f
    x, y, z = head[UP], head[UP + 1], head[UP + 2]
    a, b, c, d, e, f = a + size * x * x, b + size * x * y, c + size * x * z, d + size * y * y, e + size * y * z, f + size * z * z
    p, q, r = d * f - e * e, c * e - b * f, b * e - c * d
    whole = a * p + b * q + c * r
    if whole <= WIDE * size**3:
        return False
    head[SPREAD] = p / whole
    head[SPREAD + 1] = q / whole
    head[SPREAD + 2] = r / whole
    head[SPREAD + 3] = (a * f - c * c) / whole
    head[SPREAD + 4] = (b * c - a * e) / whole
    head[SPREAD + 5] = (a * d - b * b) / whole
    return True


@kernel(_t.boolean(_t.int64, _t.float64, _t.float64, _t.float64, _t.float64, _t.float64, _t.float64, MATRIX))
def _spread(points, f0, f1, f2, t0, t1, t2, bed):
    """Spread a force and a torque about the stone's centre over a bed; return whether every point presses within its cone."""
    head = bed[0]
    x, y, z = head[MIDDLE], head[MIDDLE + 1], head[MIDDLE + 2]
    n0, n1, n2 = head[UP], head[UP + 1], head[UP + 2]
    m0, m1, m2 = t0 - (y * f2 - z * f1), t1 - (z * f0 - x * f2), t2 - (x * f1 - y * f0)
    weight, twist = f0 * n0 + f1 * n1 + f2 * n2, m0 * n0 + m1 * n1 + m2 * n2
    if weight <= 0.0:
        return False
    e0, e1, e2 = n1 * m2 - n2 * m1, n2 * m0 - n0 * m2, n0 * m1 - n1 * m0
    s = SPREAD
    q0 = head[s] * e0 + head[s + 1] * e1 + head[s + 2] * e2
    q1 = head[s + 1] * e0 + head[s + 3] * e1 + head[s + 4] * e2
    q2 = head[s + 2] * e0 + head[s + 4] * e1 + head[s + 5] * e2
    # the centre of the normal forces from the middle, and their polar moment
    c0, c1, c2, polar = 0.0, 0.0, 0.0, 0.0
    for k in range(1, points + 1):
        d = bed[k]
        d[PRESS] = weight / points + q0 * d[0] + q1 * d[1] + q2 * d[2]
    if not _press_evenly(points, bed):
        return False
    for k in range(1, points + 1):
        d, press = bed[k], bed[k, PRESS]
        c0, c1, c2 = c0 + press * d[0], c1 + press * d[1], c2 + press * d[2]
        polar += press * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2])
    c0, c1, c2 = c0 / weight, c1 / weight, c2 / weight
    polar -= weight * (c0 * c0 + c1 * c1 + c2 * c2)
    g0, g1, g2 = (f0 - weight * n0) / weight, (f1 - weight * n1) / weight, (f2 - weight * n2) / weight
    twist -= weight * (n0 * (c1 * g2 - c2 * g1) + n1 * (c2 * g0 - c0 * g2) + n2 * (c0 * g1 - c1 * g0))
    turn = twist / polar if polar > 0.0 else 0.0
    for k in range(1, points + 1):
        d, press = bed[k], bed[k, PRESS]
        x, y, z = d[0] - c0, d[1] - c1, d[2] - c2
        r0, r1, r2 = g0 + turn * (n1 * z - n2 * y), g1 + turn * (n2 * x - n0 * z), g2 + turn * (n0 * y - n1 * x)
        if press > 0.0 and r0 * r0 + r1 * r1 + r2 * r2 > d[ROUGH] ** 2:
            return False
    for k in range(1, points + 1):
        d, press = bed[k], bed[k, PRESS]
        x, y, z = d[0] - c0, d[1] - c1, d[2] - c2
        r0, r1, r2 = g0 + turn * (n1 * z - n2 * y), g1 + turn * (n2 * x - n0 * z), g2 + turn * (n0 * y - n1 * x)
        d[SHARE] = press * (n0 + r0)
        d[SHARE + 1] = press * (n1 + r1)
        d[SHARE + 2] = press * (n2 + r2)
    return True


@kernel(_t.boolean(_t.int64, MATRIX, _t.float64, _t.float64, _t.float64, LAYOUT, MEMORY))
def carried(n, bodies, a0, a1, a2, pile, memory):
    """Add the forces that keep what lies where it is, with what was added before; return whether all beds can carry them."""
    kicked = memory.pace[KICKED]
    for i in range(n):
        for k in range(1, memory.lying[i, POINTS] + 1):
            for m in range(3):
                memory.beds[i, k, WAS + m] = memory.beds[i, k, SHARE + m]
    for i in range(n - 1, -1, -1):
        points, s = memory.lying[i, POINTS], memory.lying[i, SUPPORT]
        if points == 0:
            continue
        b, m = bodies[i], pile.inert[i, MASS]
        w0, w1, w2 = m * (a0 - b[V] / kicked), m * (a1 - b[V + 1] / kicked), m * (a2 - b[V + 2] / kicked)
        f0, f1, f2 = w0 - b[F], w1 - b[F + 1], w2 - b[F + 2]
        t0, t1, t2 = -b[L] / kicked - b[T], -b[L + 1] / kicked - b[T + 1], -b[L + 2] / kicked - b[T + 2]
        if not _spread(points, f0, f1, f2, t0, t1, t2, memory.beds[i]):
            return False
        b[F] = w0
        b[F + 1] = w1
        b[F + 2] = w2
        for k in range(3):
            b[T + k] = -b[L + k] / kicked
        c = bodies[s]
        x, y, z = b[X] - c[X], b[X + 1] - c[X + 1], b[X + 2] - c[X + 2]
        c[F] -= f0
        c[F + 1] -= f1
        c[F + 2] -= f2
        c[T] -= t0 + y * f2 - z * f1
        c[T + 1] -= t1 + z * f0 - x * f2
        c[T + 2] -= t2 + x * f1 - y * f0
        memory.touched[i, s] = 1.0
        memory.touched[s, i] = 1.0
    return True


@kernel(_t.void(_t.int64, MATRIX, MEMORY))
def rouse(n, bodies, memory):
    """Let all stones be solved for, from the forces of the last step in which they lay; clear what was added in vain."""
    for i in range(n + 1):
        for k in range(F, T + 3):
            bodies[i, k] = 0.0
    for i in range(n):
        for k in range(1, memory.lying[i, POINTS] + 1):
            point = memory.beds[i, k]
            j, o, q = int(point[OF + 1]), int(point[OF + 2]), int(point[OF + 3])
            slot = memory.joint_slots[j, o, q] if point[OF] == JOINTS else memory.corner_slots[j, o, q]
            for m in range(3):
                slot[PUSH + m] = point[SIDE] * point[WAS + m]
                slot[EARLIER + m] = slot[PUSH + m]
        memory.lying[i, POINTS] = 0
        memory.lying[i, WAIT] = -PATIENCE


@kernel(_t.void(_t.int64, _t.int64, LAYOUT, MEMORY))
def lie_down(count, n, pile, memory):
    """Let stones lie that have been still for some steps on what lies."""
    limit = (CALM * memory.pace[FALL]) ** 2
    for i in range(n):
        if memory.lying[i, POINTS] > 0:
            continue
        v, inert, lying = memory.speeds[i], pile.inert[i], memory.lying[i]
        radius = (inert[INERTIA] + inert[INERTIA + 4] + inert[INERTIA + 8]) / inert[MASS]
        quick = v[0] ** 2 + v[1] ** 2 + v[2] ** 2 + radius * (v[3] ** 2 + v[4] ** 2 + v[5] ** 2)
        lying[WAIT] = lying[WAIT] + 1 if quick < limit else min(lying[WAIT], 0)
        if lying[WAIT] < PATIENCE:
            continue
        lying[WAIT] = 0
        if _gather(i, n, count, memory) and not _measure(lying[POINTS], memory.beds[i]):
            lying[POINTS] = 0
