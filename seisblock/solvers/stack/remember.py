"""What a point remembers: the force of the one that was where it is, or its part of what all of them bore.

Points are not the same from step to step: those of a round face go round with the push, and where two faces lie over each other corners
come and go. The velocities of a step are changed by the forces of half the step before. Forces that no point went on with would be missing
for as long; where there are such, the new points share what all the old ones bore: force, moment and twist of a flat joint remain.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import MATRIX, VECTOR
from seisblock.solvers.stack.contact import EARLIER, ENTERED, PLACE, PUSH, SLIDES, SLOT
from seisblock.solvers.stack.frames import R
from seisblock.solvers.stack.impulse import ARM_B, GAP, IMPULSE, NORMAL

_t = types()

NEARBY = 0.02
"""How far, m, a point of a meeting is sought of which another remembers the force."""

TURNED = 1e-3
"""How far, over the size of a stone, the points of a flat face may be laid anew and go on with the forces that they had."""

THIN = 1e-9
"""Twice the area, m^2, of a triangle that is none."""

PULL = 0.1
"""Part of a load with which a point may pull that takes over from others: as much as to keep its moment where it lies just beyond."""

FORCE, SIDE, TWIST, PRESS, SLIPS = 0, 3, 5, 6, 7
LOAD = 8
"""What a flat joint bears, in the partner's axes: force (3), where it presses (2), its twist about there, and what presses; and behind it
whether a point slid."""


@kernel(_t.void(VECTOR, _t.float64, _t.float64, _t.float64, VECTOR), inline=True)
def put(slot, y0, y1, y2, axis):
    """Note a point and its normal in a slot."""
    slot[PLACE] = y0
    slot[PLACE + 1] = y1
    slot[PLACE + 2] = y2
    for i in range(3):
        slot[PLACE + 3 + i] = axis[i]


@kernel(_t.void(_t.int64, MATRIX, MATRIX), inline=True)
def keep(most, slots, before):
    """Keep what points remember, and let them be found anew."""
    for i in range(most):
        for j in range(SLOT):
            before[i, j] = slots[i, j]
        slots[i, ENTERED] = 0.0


@kernel(_t.void(VECTOR, MATRIX, _t.int64), inline=True)
def recall(slot, before, most):
    """Let a point remember the force of the one that was nearest to it."""
    found, least = -1, NEARBY**2
    for i in range(most):
        old = before[i]
        if old[ENTERED] > 0.0:
            away = (old[PLACE] - slot[PLACE]) ** 2 + (old[PLACE + 1] - slot[PLACE + 1]) ** 2 + (old[PLACE + 2] - slot[PLACE + 2]) ** 2
            if away < least:
                found, least = i, away
    slot[ENTERED] = 0.0
    if found >= 0:
        old = before[found]
        slot[ENTERED] = 1.0
        slot[SLIDES] = old[SLIDES]
        for i in range(3):
            slot[PUSH + i] = old[PUSH + i]
            slot[EARLIER + i] = old[EARLIER + i]
        old[ENTERED] = 0.0


@kernel(_t.UniTuple(_t.float64, 3)(VECTOR, VECTOR), inline=True)
def _seen(force, frame):
    """Return a force in a body's axes."""
    x, y, z, r = force[0], force[1], force[2], R
    return (
        frame[r] * x + frame[r + 3] * y + frame[r + 6] * z,
        frame[r + 1] * x + frame[r + 4] * y + frame[r + 7] * z,
        frame[r + 2] * x + frame[r + 5] * y + frame[r + 8] * z,
    )


@kernel(_t.void(_t.int64, MATRIX, VECTOR, VECTOR), inline=True)
def _add_up(field, slots, frame, load):
    """Add up the forces that the points of a flat joint remember in a field."""
    for k in range(LOAD):
        load[k] = 0.0
    for i in range(slots.shape[0]):
        slot = slots[i]
        if slot[ENTERED] > 0.0:
            f0, f1, f2 = _seen(slot[field:], frame)
            x, y = slot[PLACE], slot[PLACE + 1]
            load[FORCE] += f0
            load[FORCE + 1] += f1
            load[FORCE + 2] += f2
            load[SIDE] += f2 * x
            load[SIDE + 1] += f2 * y
            load[TWIST] += x * f1 - y * f0
            load[PRESS] += f2
    if load[PRESS] != 0.0:
        load[SIDE] /= load[PRESS]
        load[SIDE + 1] /= load[PRESS]
        load[TWIST] -= load[SIDE] * load[FORCE + 1] - load[SIDE + 1] * load[FORCE]


@kernel(_t.boolean(MATRIX, VECTOR, MATRIX), inline=True)
def gather(slots, frame, loads):
    """Add up what the points of a flat joint bore; return whether they bore anything.

    Parameters
    ----------
    slots : (k, 17) array
    frame : (31,) array
        The partner's body.
    loads : (2, 18) array
        What they bore in the last step, and in the one before.
    """
    _add_up(PUSH, slots, frame, loads[0])
    _add_up(EARLIER, slots, frame, loads[1])
    for i in range(slots.shape[0]):
        if slots[i, ENTERED] > 0.0:
            loads[0, SLIPS] = max(loads[0, SLIPS], slots[i, SLIDES])
    return loads[0, PRESS] != 0.0


@kernel(_t.boolean(_t.int64, MATRIX, MATRIX, _t.float64), inline=True)
def left(points, slots, before, away):
    """Whether a point that bore something has none of the new ones as near as `away`, m."""
    for i in range(before.shape[0]):
        old, near = before[i], False
        if old[ENTERED] == 0.0 or (old[PUSH] == 0.0 and old[PUSH + 1] == 0.0 and old[PUSH + 2] == 0.0):
            continue
        for j in range(points):
            x, y = slots[j, PLACE] - old[PLACE], slots[j, PLACE + 1] - old[PLACE + 1]
            near = near or x * x + y * y < away * away
        if not near:
            return True
    return False


@kernel(_t.UniTuple(_t.float64, 3)(VECTOR, VECTOR, VECTOR, _t.float64, _t.float64), inline=True)
def _parts(a, b, c, x, y):
    """Return the parts in which three points bear what presses at a place: negative where it lies beyond them."""
    a0, a1, b0, b1, c0, c1 = a[PLACE] - x, a[PLACE + 1] - y, b[PLACE] - x, b[PLACE + 1] - y, c[PLACE] - x, c[PLACE + 1] - y
    whole = (b0 - a0) * (c1 - a1) - (b1 - a1) * (c0 - a0)
    if abs(whole) < THIN:
        return -math.inf, -math.inf, -math.inf
    one, two = (b0 * c1 - b1 * c0) / whole, (c0 * a1 - c1 * a0) / whole
    return one, two, 1.0 - one - two


@kernel(_t.void(_t.int64, VECTOR, VECTOR, VECTOR, VECTOR, VECTOR), inline=True)
def _bear(field, a, b, c, load, frame):
    """Let three points bear a load together, each its part of the force, and of the twist by how far it is from where that presses."""
    x, y = load[SIDE], load[SIDE + 1]
    one, two, three = _parts(a, b, c, x, y)
    one, two, three = max(one, -PULL), max(two, -PULL), max(three, -PULL)
    whole, polar = one + two + three, 0.0
    for q in range(3):
        slot, part = (a if q == 0 else b if q == 1 else c), (one if q == 0 else two if q == 1 else three) / whole
        polar += part * ((slot[PLACE] - x) ** 2 + (slot[PLACE + 1] - y) ** 2)
    turn = load[TWIST] / polar if polar > 0.0 else 0.0
    for q in range(3):
        slot, part = (a if q == 0 else b if q == 1 else c), (one if q == 0 else two if q == 1 else three) / whole
        f0, f1, f2 = load[FORCE] - turn * (slot[PLACE + 1] - y), load[FORCE + 1] + turn * (slot[PLACE] - x), load[FORCE + 2]
        for k in range(3):
            slot[field + k] = part * (frame[R + 3 * k] * f0 + frame[R + 3 * k + 1] * f1 + frame[R + 3 * k + 2] * f2)


@kernel(_t.boolean(_t.int64, MATRIX, MATRIX, VECTOR))
def share_out(points, slots, loads, frame):
    """Let the points of a flat joint bear what was gathered, by the three among which it presses most evenly; return whether it has three.

    Parameters
    ----------
    slots : (k, 17) array
        The points where they now are.
    loads : (2, 18) array
        See :func:`gather`.
    frame : (31,) array
        The partner's body.
    """
    best, first, second, third = -math.inf, 0, 0, 0
    for i in range(points):
        for j in range(i):
            for k in range(j):
                one, two, three = _parts(slots[i], slots[j], slots[k], loads[0, SIDE], loads[0, SIDE + 1])
                least = min(one, min(two, three))
                if least > best:
                    best, first, second, third = least, i, j, k
    if best == -math.inf:
        return False
    for i in range(points):
        slots[i, ENTERED] = 1.0
        slots[i, SLIDES] = loads[0, SLIPS]
        for k in range(3):
            slots[i, PUSH + k] = 0.0
            slots[i, EARLIER + k] = 0.0
    _bear(PUSH, slots[first], slots[second], slots[third], loads[0], frame)
    _bear(EARLIER, slots[first], slots[second], slots[third], loads[1], frame)
    return True


@kernel(_t.void(_t.int64, _t.int64, _t.float64, MATRIX))
def even_out(first, count, near, table):
    """Let the points of a flat joint, where more than three touch, press as a plane over the joint does, as far as none then pulls.

    Which points bear what they bear together is nowhere told; friction against a twist hangs on it. The plane is the one with the same
    force and moments, of all loads that have these the one whose squares are least (derived here).

    Parameters
    ----------
    first, count : int
        The rows of the joint.
    near : float, m
        The gap within which points touch.
    table : (k, 92) array
    """
    if count - first <= 3:
        return
    n0, n1, n2 = table[first, NORMAL], table[first, NORMAL + 1], table[first, NORMAL + 2]
    c0, c1, c2, whole = 0.0, 0.0, 0.0, 0.0
    for i in range(first, count):
        if table[i, GAP] > near:
            return
        c0 += table[i, ARM_B]
        c1 += table[i, ARM_B + 1]
        c2 += table[i, ARM_B + 2]
        whole += table[i, IMPULSE] * n0 + table[i, IMPULSE + 1] * n1 + table[i, IMPULSE + 2] * n2
    points = count - first
    c0, c1, c2, whole = c0 / points, c1 / points, c2 / points, whole / points
    e0, e1, e2 = table[first, ARM_B] - c0, table[first, ARM_B + 1] - c1, table[first, ARM_B + 2] - c2
    f0, f1, f2 = n1 * e2 - n2 * e1, n2 * e0 - n0 * e2, n0 * e1 - n1 * e0
    xx, xy, yy, mx, my = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(first, count):
        a0, a1, a2 = table[i, ARM_B] - c0, table[i, ARM_B + 1] - c1, table[i, ARM_B + 2] - c2
        x, y = a0 * e0 + a1 * e1 + a2 * e2, a0 * f0 + a1 * f1 + a2 * f2
        press = table[i, IMPULSE] * n0 + table[i, IMPULSE + 1] * n1 + table[i, IMPULSE + 2] * n2
        xx += x * x
        xy += x * y
        yy += y * y
        mx += x * press
        my += y * press
    d = xx * yy - xy * xy
    if d <= THIN * xx * yy:
        return
    gx, gy, part = (mx * yy - my * xy) / d, (my * xx - mx * xy) / d, 1.0
    for turn in range(2):
        for i in range(first, count):
            a0, a1, a2 = table[i, ARM_B] - c0, table[i, ARM_B + 1] - c1, table[i, ARM_B + 2] - c2
            x, y = a0 * e0 + a1 * e1 + a2 * e2, a0 * f0 + a1 * f1 + a2 * f2
            press = table[i, IMPULSE] * n0 + table[i, IMPULSE + 1] * n1 + table[i, IMPULSE + 2] * n2
            more = whole + gx * x + gy * y - press
            if turn == 1:
                table[i, IMPULSE] += part * more * n0
                table[i, IMPULSE + 1] += part * more * n1
                table[i, IMPULSE + 2] += part * more * n2
            elif press + more < 0.0:
                part = min(part, max(press, 0.0) / -more)
