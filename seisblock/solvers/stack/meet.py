"""Where rigid stones meet: at the points of their joints, or where boxes that stay apart would come together."""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import MATRIX, VECTOR
from seisblock.solvers.stack.apart import EDGES, FACE, KIND
from seisblock.solvers.stack.arguments import LAYOUT, MEMORY
from seisblock.solvers.stack.contact import CLINGS, ENTERED, OUTSIDE, PLACE, REBOUND, REL_D, SLOT
from seisblock.solvers.stack.frames import relative
from seisblock.solvers.stack.hull_pairs import bevel_meets, edges_cross, faces_overlap, gap_between, most_points, on_face
from seisblock.solvers.stack.impulse import BOUNCE, HEED, IMPULSE, NORMAL, STANDS
from seisblock.solvers.stack.outlines import ALONG, LOWEST, MOST_FOUND, shared_points
from seisblock.solvers.stack.remember import TURNED, even_out, gather, keep, left, put, recall, share_out
from seisblock.solvers.stack.round import HEIGHT, RADIUS, RIMS, face_each_other, lowest, note_rim, pressed_sides
from seisblock.solvers.stack.row import FASTEST, JOINTS, MEETINGS, POINTS, enter, far_in, note
from seisblock.solvers.stack.step import CARRIER, COSINE, LEVEL, ORBITS, PAIR, PARTNER, POINT, SIGMA, bound, fastest, forget, near, seated

_t = types()

FACES, BOXES = -2, -1
"""How a pair was met last: face on face where one of them is round, else as boxes."""

DEEP = 1e-4
"""How deep, m, faces may lie in each other where a pair that was met as boxes is to be met face on face."""

NEAR = 1e-6
"""Gap, m, within which the points of a flat joint touch."""

FLAT, FAINT, LOADED = 1e-6, 0.04, 8.0
"""Cosine of a lean, less than 1 by so much, of stones that lie face on face; what of a free fall's speed, over that of the others, is
heeded of points that did not press: a stone that rocks is drawn back by little, so that what strikes slowly has been away for steps; and of
those that did: they touch, and what was pressed unevenly in the step before seems to strike."""


@kernel(_t.int64(_t.int64, _t.int64, VECTOR, MATRIX, _t.float64, LAYOUT, MEMORY))
def _enter_joint(count, j, rel, bodies, dt, pile, memory):
    """Make rows of the points of a joint; count in the scratch those that have left the partner's face."""
    joint, k = pile.joints[j], pile.constants[j]
    c, p, sigma = joint[CARRIER], joint[PARTNER], k[SIGMA]
    half, total, far = pile.boxes[p], memory.work[1], far_in(dt, memory)
    for o in range(joint[ORBITS]):
        for q in range(4):
            point, slot = pile.grids[j, o, q], memory.joint_slots[j, o, q]
            if point[2] == 0.0:
                continue
            x, y, z = point[0], point[1], k[LEVEL]
            s0 = rel[9] + rel[0] * x + rel[1] * y + rel[2] * z
            s1 = rel[10] + rel[3] * x + rel[4] * y + rel[5] * z
            if abs(s0) > half[0] or abs(s1) > half[1]:
                total[OUTSIDE] += 1.0
                slot[ENTERED] = 0.0
                continue
            s2 = rel[11] + rel[6] * x + rel[7] * y + rel[8] * z
            depth = half[2] + sigma * s2
            slot[PLACE] = s0
            slot[PLACE + 1] = s1
            slot[PLACE + 2] = s2
            slot[PLACE + 3] = 0.0
            slot[PLACE + 4] = 0.0
            slot[PLACE + 5] = -sigma
            count = note(
                count, enter(count, c, p, slot, -depth, far, k[POINT:], bodies, dt, pile, memory), JOINTS, j, o, q, slot, memory.who
            )
    return count


@kernel(_t.int64(_t.int64, _t.int64, VECTOR, _t.float64, MATRIX, _t.float64, LAYOUT, MEMORY))
def _meet_ground(count, pair, rel, far, bodies, dt, pile, memory):
    """Make rows of a box's corners that may touch the ground; return how many rows there are then."""
    c, p = pile.pairs[pair, 0], pile.pairs[pair, 1]
    slots, axis = memory.corner_slots[pair, 0], memory.work[22]
    for i in range(3):
        axis[i] = 1.0 if i == 2 else 0.0
    for i in range(pile.counts[c]):
        r = pile.corners[c, i]
        y2 = rel[11] + rel[6] * r[0] + rel[7] * r[1] + rel[8] * r[2]
        gap = y2 - pile.boxes[p, 2]
        if gap > far:
            slots[i, ENTERED] = 0.0
            continue
        y0 = rel[9] + rel[0] * r[0] + rel[1] * r[1] + rel[2] * r[2]
        y1 = rel[10] + rel[3] * r[0] + rel[4] * r[1] + rel[5] * r[2]
        put(slots[i], y0, y1, y2, axis)
        entered = enter(count, c, p, slots[i], gap, far, pile.pair_constants[pair], bodies, dt, pile, memory)
        count = note(count, entered, MEETINGS, pair, 0, i, slots[i], memory.who)
    return count


@kernel(_t.int64(_t.int64, _t.int64, VECTOR, _t.float64, MATRIX, _t.float64, LAYOUT, MEMORY))
def _meet_boxes(count, pair, rel, far, bodies, dt, pile, memory):
    """Make rows of the points where two boxes may touch; return how many rows there are then."""
    c, p, k, work = pile.pairs[pair, 1], pile.pairs[pair, 0], pile.pair_constants[pair], memory.work
    slots, before, axis, found = memory.corner_slots[pair, 0], memory.corner_slots[pair, 1], work[29], work[4:20]
    at, most = 0, most_points(c, p, pile)
    keep(most, slots, before)
    gap = gap_between(rel, c, p, far, pile, work, axis)
    if gap > far:
        return count
    if axis[KIND] >= EDGES:
        if edges_cross(rel, c, p, pile, axis, work, found[0]):
            put(slots[0], found[0, 0], found[0, 1], found[0, 2], axis)
            recall(slots[0], before, most)
            entered = enter(count, c, p, slots[0], gap, far, k, bodies, dt, pile, memory)
            count = note(count, entered, MEETINGS, pair, 0, 0, slots[0], memory.who)
        at = 1
    points = faces_overlap(rel, c, p, pile, axis, work, far, found, work[20:29])
    for i in range(points):
        if at == 1 and found[i, 3] < min(gap, 0.0):  # where edges cross, a face says only what comes to lie on it, and has come no deeper
            continue
        slot = slots[at + i]
        put(slot, found[i, 0], found[i, 1], found[i, 2], axis[FACE:])
        recall(slot, before, most)
        entered = enter(count, c, p, slot, found[i, 3], far, k, bodies, dt, pile, memory)
        count = note(count, entered, MEETINGS, pair, 0, at + i, slot, memory.who)
    return count


@kernel(_t.int64(_t.int64, _t.int64, VECTOR, _t.float64, MATRIX, _t.float64, LAYOUT, MEMORY))
def _meet_ground_round(count, pair, rel, far, bodies, dt, pile, memory):
    """Make rows of the points of a round stone's rims that may touch the ground; return how many rows there are then."""
    c, p, k = pile.pairs[pair, 0], pile.pairs[pair, 1], pile.pair_constants[pair]
    slots, before, ground = memory.corner_slots[pair, 0], memory.corner_slots[pair, 1], bodies[bodies.shape[0] - 1]
    axis, axes, loads = memory.work[22], memory.work[4:8], memory.work[8:10]
    for i in range(3):
        axis[i] = 1.0 if i == 2 else 0.0
        axes[0, i] = rel[3 * i + 2]
    pressed_sides(slots, rel, pile.boxes[c, 0], axes[1])
    sine = lowest(0.0, 0.0, 1.0, axes)
    for i in range(RIMS):
        radius, height = pile.rims[c, i, RADIUS], pile.rims[c, i, HEIGHT]
        if radius == 0.0:
            continue
        rim, old = slots[4 * i : 4 * i + 4], before[4 * i : 4 * i + 4]
        flat = sine == 0.0 and gather(rim, ground, loads)
        for q in range(4):
            for j in range(SLOT):
                old[q, j] = rim[q, j]
            direction, side = axes[2 + q % 2], radius if q < 2 else -radius
            y0 = rel[9] + side * direction[0] + height * rel[2]
            y1 = rel[10] + side * direction[1] + height * rel[5]
            y2 = rel[11] + side * direction[2] + height * rel[8]
            put(rim[q], y0, y1, y2, axis)
        if flat and not (left(4, rim, old, TURNED * radius) and share_out(4, rim, loads, ground)):
            for q in range(4):
                recall(rim[q], old, 4)
        for q in range(4):
            slot = rim[q]
            entered = enter(count, c, p, slot, slot[PLACE + 2] - pile.boxes[p, 2], far, k, bodies, dt, pile, memory)
            if entered > count:
                note_rim(q == 0, sine, radius, axes, ground, memory.table[count])
            count = note(count, entered, MEETINGS, pair, 0, 4 * i + q, slot, memory.who)
    return count


@kernel(_t.int64(_t.int64, _t.int64, VECTOR, _t.float64, MATRIX, _t.float64, LAYOUT, MEMORY))
def _meet_faces_round(count, pair, rel, far, bodies, dt, pile, memory):
    """Make rows of the points where a round stone's face lies on another stone's, or under it; return how many rows there are then.

    Stones whose outlines lie beside each other, and those that came to lie in each other's, met as the boxes inside them, are left to
    these: return -1.
    """
    c, p, k, work = pile.pairs[pair, 1], pile.pairs[pair, 0], pile.pair_constants[pair], memory.work
    slots, before, axes, axis, found = memory.corner_slots[pair, 0], memory.corner_slots[pair, 1], work[7:11], work[19], work[20:]
    pressed_sides(slots, rel, min(pile.boxes[c, 0], pile.boxes[p, 0]), axis[4:])
    points = shared_points(c, p, rel, pile, axis, work[4:19], found)
    if points == 0:
        return -1
    if memory.handled[pair] == BOXES:
        for i in range(points):
            if found[i, 3] < -DEEP:
                return -1
    keep(MOST_FOUND, slots, before)
    # the rim that rolls is the partner's where the carrier's face is the one it rolls on
    box = p if axis[3] > 0.0 else c
    side = 1.0 if rel[REL_D + 2] > 0.0 else -1.0
    for i in range(3):
        axes[0, i] = (1.0 if i == 2 else 0.0) if box == p else rel[3 * i + 2]
        axes[1, i] = axis[4 + i]
    up = -1.0 if box == p else 1.0
    sine = lowest(up * axis[0], up * axis[1], up * axis[2], axes)
    face = (1 if side > 0.0 else 0) if box == p else (0 if side * rel[8] > 0.0 else 1)
    radius = pile.rims[box, face, RADIUS]
    frame, loads = bodies[pile.owner[p]], work[11:13]
    for i in range(points):
        put(slots[i], found[i, 0], found[i, 1], found[i, 2], found[i, ALONG:])
    flat = sine == 0.0 and left(points, slots, before, TURNED * radius) and gather(before[:MOST_FOUND], frame, loads)
    relaid = flat and share_out(points, slots, loads, frame)
    for i in range(points):
        slot = slots[i]
        if not relaid:
            recall(slot, before, MOST_FOUND)
        entered = enter(count, c, p, slot, found[i, 3], far, k, bodies, dt, pile, memory)
        if entered > count:
            note_rim(found[i, LOWEST] > 0.0, sine, up * radius, axes, frame, memory.table[count])
        count = note(count, entered, MEETINGS, pair, 0, i, slot, memory.who)
    return count


@kernel(_t.boolean(VECTOR, _t.int64, _t.int64, LAYOUT))
def _on_faces(rel, c, p, pile):
    """Whether of two stones that face each other those that are not round lean no further than their bevels."""
    up = 1.0 if rel[REL_D + 2] > 0.0 else -1.0
    if pile.rims[c, 0, RADIUS] == 0.0 and not on_face(pile.corners[c], pile.counts[c], -up * rel[6], -up * rel[7], -up * rel[8]):
        return False
    return pile.rims[p, 0, RADIUS] > 0.0 or on_face(pile.corners[p], pile.counts[p], up * rel[2], up * rel[5], up * rel[8])


@kernel(_t.int64(_t.int64, _t.int64, MATRIX, _t.float64, LAYOUT, MEMORY), inline=True)
def _meet(count, pair, bodies, dt, pile, memory):
    """Make rows of the points where two boxes, or a box and the ground, may touch; return how many rows there are then."""
    boxes, rel, first, ground, faces = pile.boxes, memory.work[0], count, pile.boxes.shape[0] - 1, -1
    on_ground = pile.pairs[pair, 1] == ground
    c, p = pile.pairs[pair, 0 if on_ground else 1], pile.pairs[pair, 1 if on_ground else 0]
    relative(c, p, bodies, boxes, pile.owner, memory.work[2:4], rel)
    far = far_in(dt, memory)
    if on_ground and pile.rims[c, 0, RADIUS] > 0.0:
        count = _meet_ground_round(count, pair, rel, far, bodies, dt, pile, memory)
    elif on_ground:
        count = _meet_ground(count, pair, rel, far, bodies, dt, pile, memory)
    else:
        is_round = pile.rims[c, 0, RADIUS] + pile.rims[p, 0, RADIUS] > 0.0
        if is_round and face_each_other(rel, boxes[c], boxes[p], pile.rims[c], pile.rims[p]) and _on_faces(rel, c, p, pile):
            faces = _meet_faces_round(count, pair, rel, far, bodies, dt, pile, memory)
        count = faces if faces >= 0 else _meet_boxes(count, pair, rel, far, bodies, dt, pile, memory)
    memory.handled[pair] = FACES if faces >= 0 else BOXES
    rebound = pile.pair_constants[pair, REBOUND]
    if rel[8] > COSINE:
        for i in range(first, count):
            row = memory.table[i]
            row[BOUNCE] = rebound
            row[STANDS] = 1.0
            pressed = row[IMPULSE] * row[NORMAL] + row[IMPULSE + 1] * row[NORMAL + 1] + row[IMPULSE + 2] * row[NORMAL + 2]
            if pressed > 0.0:
                row[HEED] *= LOADED
            elif 1.0 - rel[8] < FLAT:
                row[HEED] *= FAINT
        if 1.0 - rel[8] < FLAT and pile.rims[c, 0, RADIUS] + pile.rims[p, 0, RADIUS] == 0.0:
            even_out(first, count, NEAR, memory.table)
    return count


@kernel(_t.int64(_t.int64, _t.int64, MATRIX, _t.float64, LAYOUT, MEMORY), inline=True)
def _meet_joint(count, j, bodies, dt, pile, memory):
    """Make rows of the points of a joint, and of what hangs over its border."""
    joint, k, boxes, work = pile.joints[j], pile.constants[j], pile.boxes, memory.work
    c, p, rel, total = joint[CARRIER], joint[PARTNER], work[0], work[1]
    relative(c, p, bodies, boxes, pile.owner, work[2:4], rel)
    acts = seated(k[SIGMA], rel, boxes[c], boxes[p])
    total[OUTSIDE] = 0.0
    if acts == 1:
        count = _enter_joint(count, j, rel, bodies, dt, pile, memory)
    leans = acts == 1 and bevel_meets(rel, c, p, k[SIGMA], far_in(dt, memory), pile)
    memory.handled[joint[PAIR]] = -1 if leans or total[OUTSIDE] > 0.0 else acts
    return count


@kernel(_t.boolean(_t.int64, LAYOUT, MEMORY), inline=True)
def _both_lie(pair, pile, memory):
    """Whether both stones of a pair lie still, and need not be solved for."""
    a, b = pile.owner[pile.pairs[pair, 0]], pile.owner[pile.pairs[pair, 1]]
    return memory.lying[a, POINTS] > 0 and memory.lying[b, POINTS] > 0


@kernel(_t.int64(MATRIX, _t.float64, _t.boolean, LAYOUT, MEMORY), inline=True)
def find(bodies, dt, look, pile, memory):
    """Make rows of every contact; return how many there are.

    Joints with points of their own are held by these while their stones face each other; all else is met as boxes that stay apart.
    """
    count, memory.pace[FASTEST] = 0, fastest(bodies, pile.boxes, pile.owner)
    for j in range(pile.joints.shape[0]):
        pair = pile.joints[j, PAIR]
        if pile.constants[j, POINT + CLINGS] == 0.0 and not _both_lie(pair, pile, memory):
            count = _meet_joint(count, j, bodies, dt, pile, memory)
    if look:
        bound(bodies, pile.boxes, pile.owner, dt, memory.bounds)
    for pair in range(pile.pairs.shape[0]):
        if memory.handled[pair] > 0 or _both_lie(pair, pile, memory):
            continue
        if near(pile.pairs[pair, 0], pile.pairs[pair, 1], memory.bounds):
            count = _meet(count, pair, bodies, dt, pile, memory)
        elif memory.handled[pair] < 0:
            memory.handled[pair] = 0
            forget(pair, memory)
    return count
