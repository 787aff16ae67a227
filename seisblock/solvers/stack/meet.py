"""Where rigid stones meet: a row for each point that may touch another stone in the step, with its gap and what it remembers."""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import INTEGER_TABLE, MATRIX, VECTOR
from seisblock.solvers.stack.arguments import LAYOUT, MEMORY
from seisblock.solvers.stack.contact import (
    ALIVE,
    CLINGS,
    DEPTH,
    EARLIER,
    ENTERED,
    FRICTION,
    KINETIC,
    OUTSIDE,
    PLACE,
    PUSH,
    REBOUND,
    SLIDES,
    SUM,
    share,
)
from seisblock.solvers.stack.frames import AT, R, X, relative
from seisblock.solvers.stack.impulse import ARM_A, ARM_B, FLOOR, HELD, IMPULSE, MU, NORMAL, SWERVE, answers, parting
from seisblock.solvers.stack.solid import boxes_meet, press_corners, press_edges
from seisblock.solvers.stack.step import (
    ALL_EDGES,
    CARRIER,
    LEVEL,
    ON_FACE,
    ORBITS,
    PAIR,
    PARTNER,
    POINT,
    SIGMA,
    bound,
    forget,
    near,
    seated,
)

_t = types()

REACH = 1e-3
"""How far, m, outside a stone a corner or an edge is looked at."""

SWIFT, SLOW = 2.0, 0.5
"""A point is left out while it cannot close its gap in the step at so many times its speed, and this speed, m/s, more."""

MENDED, GENTLY = 0.2, 0.05
"""Part of a gap closed too far that a step makes good, and the speed, m/s, that it may take for it."""

SPLITS = 2.0
"""Approach, over the speed of a free fall of a step, from which an impact splits the step."""

BEFORE, SOONEST, FALL, WHOLE, KICKED, AHEAD, SWEPT = range(7)
PACE = 7
"""The length of the last step, s; the time to the soonest impact, s; the speed of a free fall of a whole step, m/s, and its length, s;
the time over which velocities last changed, s; how far ahead of the last forces the next are looked for; how many sweeps that took."""

OPPOSITE = 3
"""Points of an orbit whose numbers add up to this stand opposite each other."""

JOINTS, CORNERS, EDGES = range(3)
"""What a contact is made of."""


@kernel(_t.void(VECTOR, VECTOR, _t.float64, VECTOR), inline=True)
def _swerve(speeds, arm, half, swerve):
    """Add how a body's point at `arm` changes its velocity by the body's turning in a time: w x (w x r)."""
    x, y, z = speeds[3], speeds[4], speeds[5]
    along = x * arm[0] + y * arm[1] + z * arm[2]
    square = x * x + y * y + z * z
    swerve[0] += half * (x * along - square * arm[0])
    swerve[1] += half * (y * along - square * arm[1])
    swerve[2] += half * (z * along - square * arm[2])


@kernel(_t.int64(_t.int64, _t.int64, _t.int64, VECTOR, _t.float64, VECTOR, MATRIX, _t.float64, LAYOUT, MEMORY))
def _enter(count, c, p, slot, gap, k, bodies, dt, pile, memory):
    """Make a row of a contact noted in a slot; return how many there are then."""
    if count >= memory.table.shape[0]:
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
    if gap > dt * (SWIFT * abs(approach) + SLOW):
        return count
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
def _note(before, now, kind, i, j, k, slot, who):
    """Remember which slot a row was made of; return how many rows there are."""
    slot[ENTERED] = 0.0
    if now > before:
        slot[ENTERED] = 1.0
        who[before, 2] = kind
        who[before, 3] = i
        who[before, 4] = j
        who[before, 5] = k
    return now


@kernel(_t.int64(_t.int64, _t.int64, _t.int64, VECTOR, VECTOR, MATRIX, _t.float64, LAYOUT, MEMORY), inline=True)
def _enter_noted(count, c, p, slot, k, bodies, dt, pile, memory):
    """Make a row of a corner's or an edge's contact, if there is one."""
    if slot[ALIVE] == 0.0:
        return count
    reach = REACH * (abs(slot[PLACE + 3]) + abs(slot[PLACE + 4]) + abs(slot[PLACE + 5]))
    return _enter(count, c, p, slot, reach - slot[DEPTH], k, bodies, dt, pile, memory)


@kernel(_t.void(_t.int64, _t.int64, _t.float64, MEMORY))
def _rebound(first, last, ratio, memory):
    """Let the points of a joint that stand opposite those that strike leave with a part of their velocity."""
    for i in range(first, last):
        row, who = memory.table[i], memory.who[i]
        u0, u1, u2 = parting(who[0], who[1], row, memory.speeds)
        approach = u0 * row[NORMAL] + u1 * row[NORMAL + 1] + u2 * row[NORMAL + 2]
        if approach > -SPLITS * memory.pace[FALL]:
            continue
        for j in range(first, last):
            if memory.who[j, 4] == who[4] and memory.who[j, 5] == OPPOSITE - who[5]:
                memory.table[j, FLOOR] = -ratio * approach
                memory.table[j, HELD] = 1.0


@kernel(_t.int64(_t.int64, _t.int64, VECTOR, MATRIX, _t.float64, LAYOUT, MEMORY))
def _enter_joint(count, j, rel, bodies, dt, pile, memory):
    """Make rows of the points of a joint; count in the scratch those that have left the partner's face."""
    joint, k = pile.joints[j], pile.constants[j]
    c, p, sigma = joint[CARRIER], joint[PARTNER], k[SIGMA]
    half, total, first = pile.boxes[p], memory.work[1], count
    clings = k[POINT + CLINGS] > 0.0 and share(rel, pile.boxes[c], half)
    for o in range(joint[ORBITS]):
        for q in range(4):
            point, slot = pile.grids[j, o, q], memory.joint_slots[j, o, q]
            if point[2] == 0.0:
                continue
            x, y, z = point[0], point[1], k[LEVEL]
            s0 = rel[9] + rel[0] * x + rel[1] * y + rel[2] * z
            s1 = rel[10] + rel[3] * x + rel[4] * y + rel[5] * z
            n0, n1, n2 = 0.0, 0.0, 1.0
            if abs(s0) > half[0] or abs(s1) > half[1]:
                if not clings:
                    total[OUTSIDE] += 1.0
                    slot[ENTERED] = 0.0
                    continue
                over0 = s0 - min(max(s0, -half[0]), half[0])
                over1 = s1 - min(max(s1, -half[1]), half[1])
                x -= rel[0] * over0 + rel[3] * over1
                y -= rel[1] * over0 + rel[4] * over1
                s0 = rel[9] + rel[0] * x + rel[1] * y + rel[2] * z
                s1 = rel[10] + rel[3] * x + rel[4] * y + rel[5] * z
                n0, n1, n2 = rel[2], rel[5], rel[8]
            s2 = rel[11] + rel[6] * x + rel[7] * y + rel[8] * z
            depth = (half[2] + sigma * s2) * n2
            slot[PLACE] = s0
            slot[PLACE + 1] = s1
            slot[PLACE + 2] = s2
            slot[PLACE + 3] = -sigma * n0
            slot[PLACE + 4] = -sigma * n1
            slot[PLACE + 5] = -sigma * n2
            count = _note(count, _enter(count, c, p, slot, -depth, k[POINT:], bodies, dt, pile, memory), JOINTS, j, o, q, slot, memory.who)
    if k[POINT + REBOUND] >= 0.0:
        _rebound(first, count, k[POINT + REBOUND], memory)
    return count


@kernel(_t.int64(_t.int64, _t.int64, _t.int64, _t.int64, _t.int64, _t.int64, _t.int64, MATRIX, _t.float64, LAYOUT, MEMORY))
def _enter_meeting(count, pair, role, n_corners, first_edge, n_edges, check, bodies, dt, pile, memory):
    """Make rows of one box's corners and edges on the other; return how many there are then, or -1 if the boxes are apart."""
    corners, boxes, owner, work = pile.corners, pile.boxes, pile.owner, memory.work
    c, p = pile.pairs[pair, role], pile.pairs[pair, 1 - role]
    k = pile.pair_constants[pair]
    rel, total, arms, scratch, wide = work[0], work[1], work[2:4], work[8:13], work[4]
    relative(c, p, bodies, boxes, owner, arms, rel)
    for i in range(3):
        wide[i] = boxes[p, i] + REACH
    if check == 1 and not boxes_meet(rel, boxes[c], wide):
        return -1
    if n_corners > 0:
        slots = memory.corner_slots[pair, role]
        press_corners(n_corners, rel, corners[c], wide, k, dt, slots, scratch[0], scratch[1], total)
        for i in range(n_corners):
            entered = _enter_noted(count, c, p, slots[i], k, bodies, dt, pile, memory)
            count = _note(count, entered, CORNERS, pair, role, i, slots[i], memory.who)
    if n_edges > 0:
        slots = memory.edge_slots[pair, role, 2 * first_edge :]
        press_edges(n_edges, rel, corners[c], pile.edges[c, first_edge:], wide, k, dt, slots, scratch, total)
        for i in range(2 * n_edges):
            entered = _enter_noted(count, c, p, slots[i], k, bodies, dt, pile, memory)
            count = _note(count, entered, EDGES, pair, role, 2 * first_edge + i, slots[i], memory.who)
    return count


@kernel(_t.int64(_t.int64, _t.int64, MATRIX, _t.float64, LAYOUT, MEMORY), inline=True)
def _meet_joint(count, j, bodies, dt, pile, memory):
    """Make rows of a joint, and of what hangs over its border."""
    boxes, handled, work = pile.boxes, memory.handled, memory.work
    joint, k = pile.joints[j], pile.constants[j]
    c, p, pair = joint[CARRIER], joint[PARTNER], joint[PAIR]
    rel, total = work[0], work[1]
    relative(c, p, bodies, boxes, pile.owner, work[2:4], rel)
    for i in range(SUM):
        total[i] = 0.0
    acts = seated(k[SIGMA], rel, boxes[c], boxes[p])
    if acts == 1:
        count = _enter_joint(count, j, rel, bodies, dt, pile, memory)
    role = 0 if pile.pairs[pair, 0] == c else 1
    if acts == 1 and total[OUTSIDE] > 0.0:
        count = _enter_meeting(count, pair, role, 0, ON_FACE if k[SIGMA] > 0.0 else 0, ON_FACE, 0, bodies, dt, pile, memory)
        count = _enter_meeting(count, pair, 1 - role, pile.counts[p], 0, 0, 0, bodies, dt, pile, memory)
        handled[pair] = 2
    else:
        if handled[pair] == 2 and acts == 1:
            forget(pair, memory)
        handled[pair] = acts
    return count


@kernel(_t.int64(MATRIX, _t.float64, _t.boolean, LAYOUT, MEMORY), inline=True)
def find(bodies, dt, look, pile, memory):
    """Make rows of every contact; return how many there are."""
    pairs, counts, handled = pile.pairs, pile.counts, memory.handled
    count = 0
    for j in range(pile.joints.shape[0]):
        count = _meet_joint(count, j, bodies, dt, pile, memory)
    if look:
        bound(bodies, pile.boxes, pile.owner, memory.bounds)
    for pair in range(pairs.shape[0]):
        if handled[pair] > 0:
            continue
        i, j = pairs[pair, 0], pairs[pair, 1]
        found = -1
        if near(i, j, memory.bounds):
            found = _enter_meeting(count, pair, 0, counts[i], 0, ALL_EDGES, 1, bodies, dt, pile, memory)
        if found >= 0:
            count = _enter_meeting(found, pair, 1, counts[j], 0, 0, 0, bodies, dt, pile, memory)
            handled[pair] = -1
        elif handled[pair] == -1:
            handled[pair] = 0
            forget(pair, memory)
    return count
