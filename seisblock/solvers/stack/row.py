"""A row for a point that may touch another stone in the step: arms, normal, the velocity it may have, and what it remembers."""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import INTEGER_TABLE, MATRIX, VECTOR
from seisblock.solvers.stack.arguments import LAYOUT, MEMORY
from seisblock.solvers.stack.contact import (
    EARLIER,
    ENTERED,
    FRICTION,
    KINETIC,
    PLACE,
    PUSH,
    REBOUND,
    REL_V,
    REL_W,
    SLIDES,
)
from seisblock.solvers.stack.frames import AT, R, X
from seisblock.solvers.stack.impulse import ARM_A, ARM_B, FLOOR, HELD, IMPULSE, MU, NORMAL, SWERVE, answers, parting

_t = types()

SWIFT, SLOW = 2.0, 0.5
"""A point is left out while its gap is wider than what so many times the greatest speed of its stone, and this speed, m/s, more, close in a
step: what a stone strikes may turn it the other way round."""

MENDED, GENTLY = 0.2, 0.05
"""Part of a gap closed too far that a step makes good, and the speed, m/s, that it may take for it."""

SPLITS = 2.0
"""Approach, over the speed of a free fall of a step, from which an impact splits the step."""

BEFORE, SOONEST, FALL, WHOLE, KICKED, AHEAD, SWEPT = range(7)
PACE = 7
"""The length of the last step, s; the time to the soonest impact, s; the speed of a free fall of a whole step, m/s, and its length, s;
the time over which velocities last changed, s; how far ahead of the last forces the next are looked for; how many sweeps that took."""


@kernel(_t.void(VECTOR, VECTOR, _t.float64, VECTOR), inline=True)
def _swerve(speeds, arm, half, swerve):
    """Add how a body's point at `arm` changes its velocity by the body's turning in a time: w x (w x r)."""
    x, y, z = speeds[3], speeds[4], speeds[5]
    along = x * arm[0] + y * arm[1] + z * arm[2]
    square = x * x + y * y + z * z
    swerve[0] += half * (x * along - square * arm[0])
    swerve[1] += half * (y * along - square * arm[1])
    swerve[2] += half * (z * along - square * arm[2])


@kernel(_t.int64(_t.int64, _t.int64, _t.int64, VECTOR, _t.float64, _t.float64, VECTOR, MATRIX, _t.float64, LAYOUT, MEMORY))
def enter(count, c, p, slot, gap, far, k, bodies, dt, pile, memory):
    """Make a row of a contact noted in a slot, unless it is too far to be reached in the step; return how many there are then."""
    if gap > far or count >= memory.table.shape[0]:
        return count
    a, b, ground = pile.owner[c], pile.owner[p], bodies.shape[0] - 1
    row, first, second, box = memory.table[count], bodies[a], bodies[b], pile.boxes[p]
    y0, y1, y2 = slot[PLACE] + box[AT], slot[PLACE + 1] + box[AT + 1], slot[PLACE + 2] + box[AT + 2]
    for i in range(3):
        r = R + 3 * i
        row[ARM_B + i] = second[r] * y0 + second[r + 1] * y1 + second[r + 2] * y2
        row[ARM_A + i] = row[ARM_B + i] + second[X + i] - first[X + i]
        row[NORMAL + i] = second[r] * slot[PLACE + 3] + second[r + 1] * slot[PLACE + 4] + second[r + 2] * slot[PLACE + 5]
    u0, u1, u2 = parting(a, b, row, memory.speeds)
    approach = u0 * row[NORMAL] + u1 * row[NORMAL + 1] + u2 * row[NORMAL + 2]
    if gap > 0.0 and approach < -SPLITS * memory.pace[FALL]:
        memory.pace[SOONEST] = min(memory.pace[SOONEST], -gap / approach)
    if gap > 0.0 and k[REBOUND] >= 0.0 and approach < -SPLITS * memory.pace[FALL]:
        # what is to rebound strikes at once, not a part of it while its gap closes
        return count
    row[HELD] = 0.0
    if slot[ENTERED] == 0.0:
        for i in range(3):
            slot[PUSH + i] = 0.0
            slot[EARLIER + i] = 0.0
        slot[SLIDES] = 0.0
    answers(a, b, ground, pile.inert, memory.inverses, row)
    row[SWERVE] = 0.0
    row[SWERVE + 1] = 0.0
    row[SWERVE + 2] = 0.0
    _swerve(memory.speeds[a], row[ARM_A:], 0.5 * dt, row[SWERVE:])
    _swerve(memory.speeds[b], row[ARM_B:], -0.5 * dt, row[SWERVE:])
    row[FLOOR] = -gap / dt if gap > 0.0 else min(-MENDED * gap / memory.pace[WHOLE], GENTLY)
    row[MU] = k[KINETIC] if slot[SLIDES] > 0.0 else k[FRICTION]
    for i in range(3):
        row[IMPULSE + i] = slot[PUSH + i] + memory.pace[AHEAD] * (slot[PUSH + i] - slot[EARLIER + i])
    memory.who[count, 0] = a
    memory.who[count, 1] = b
    return count + 1


@kernel(_t.int64(_t.int64, _t.int64, _t.int64, _t.int64, _t.int64, _t.int64, VECTOR, INTEGER_TABLE), inline=True)
def note(before, now, kind, i, j, k, slot, who):
    """Remember which slot a row was made of; return how many rows there are."""
    slot[ENTERED] = 0.0
    if now > before:
        slot[ENTERED] = 1.0
        who[before, 2] = kind
        who[before, 3] = i
        who[before, 4] = j
        who[before, 5] = k
    return now


@kernel(_t.int64(_t.int64, _t.int64, _t.int64, MEMORY), inline=True)
def _opposite(i, first, last, memory):
    """Return the row of the point that is farthest from one."""
    found, most = i, 0.0
    x, y, z = memory.table[i, ARM_B], memory.table[i, ARM_B + 1], memory.table[i, ARM_B + 2]
    for j in range(first, last):
        row = memory.table[j]
        away = (row[ARM_B] - x) ** 2 + (row[ARM_B + 1] - y) ** 2 + (row[ARM_B + 2] - z) ** 2
        if away > most:
            found, most = j, away
    return found


@kernel(_t.void(_t.int64, _t.int64, _t.float64, MEMORY))
def rebound_opposite(first, last, ratio, memory):
    """Let the points of a joint that stand opposite those that strike leave with a part of their velocity."""
    for i in range(first, last):
        row, who = memory.table[i], memory.who[i]
        u0, u1, u2 = parting(who[0], who[1], row, memory.speeds)
        approach = u0 * row[NORMAL] + u1 * row[NORMAL + 1] + u2 * row[NORMAL + 2]
        if approach > -SPLITS * memory.pace[FALL]:
            continue
        j = _opposite(i, first, last, memory)
        memory.table[j, FLOOR] = -ratio * approach
        memory.table[j, HELD] = 1.0


@kernel(_t.float64(VECTOR, VECTOR, _t.float64), inline=True)
def far_in(rel, half, dt):
    """Return how far, m, a box can come in a step, whatever it strikes on the way."""
    size = (half[0] ** 2 + half[1] ** 2 + half[2] ** 2) ** 0.5
    speed = (rel[REL_V] ** 2 + rel[REL_V + 1] ** 2 + rel[REL_V + 2] ** 2) ** 0.5
    spin = (rel[REL_W] ** 2 + rel[REL_W + 1] ** 2 + rel[REL_W + 2] ** 2) ** 0.5
    return dt * (SWIFT * (speed + spin * size) + SLOW)
