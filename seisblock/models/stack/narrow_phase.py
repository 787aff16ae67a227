"""Narrow phase: contact points of the pairs that the broad phase reports, as constraint rows.

A pair in its original position touches at the points of its joint. Every other pair goes through the separating-axis test (boxes) or the
face overlap (cylinders); its contact manifold is matched to that of the last step, which gives the warm start.
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.models.stack.box_box import EDGE_EDGE, FACE_AXIS, KIND, smaller_half_length
from seisblock.models.stack.broad_phase import aabbs_overlap, max_corner_speed, update_aabbs
from seisblock.models.stack.buffers import LAYOUT, MEMORY
from seisblock.models.stack.constraint_assembly import (
    FROM_JOINT,
    FROM_PAIR,
    MAX_SPEED,
    SUPPORT_POINTS,
    add_contact,
    max_approach,
    register_slot,
)
from seisblock.models.stack.constraint_row import GAP, IMPACT_SPEED, IMPULSE, IS_STANDING, NORMAL, RESTITUTION_RATIO
from seisblock.models.stack.cylinder import HEIGHT, RADIUS, RIMS, faces_opposed, load_directions, lowest_rim_point, set_rim_contact
from seisblock.models.stack.face_overlap import IS_LOWEST, MAX_SHARED_POINTS, POINT_NORMAL
from seisblock.models.stack.frames import relative_state
from seisblock.models.stack.hull_pairs import bevel_touches, edges_cross, face_supports, faces_overlap, gap_between, max_contact_points
from seisblock.models.stack.spring_contact import ACTIVE, CLAMP_TO_EDGE, OUTSIDE, POSITION, REL_D, RESTITUTION, SLOT
from seisblock.models.stack.step import CARRIER, LEVEL, MIN_FACING_COSINE, ORBITS, PAIR, PARTNER, POINT, SIGMA, clear_pair, is_joint_engaged
from seisblock.models.stack.warm_start import (
    MAX_SHIFT_RATIO,
    distribute_load,
    has_lost_loaded_point,
    match_point,
    match_radius,
    project_to_plane,
    save_slots,
    store_point,
    sum_joint_load,
)

_t = types()

GRID_PAIR, FACE_PAIR, BOX_PAIR = -3, -2, -1
"""Kind of the last manifold of a pair: face on face with a cylinder, box on box, or hulls after a grid of points."""

MAX_DEPTH_RATIO = 2.5e-4
"""Largest overlap of two faces at which a pair may change from box-on-box to face-on-face contact, over half the length of the smaller
stone."""

TOUCH_RATIO = 2.5e-6
"""Gap below which the points of a flat joint are in contact, over half the length of the smaller stone."""

FLAT_TOLERANCE, UNLOADED_FACTOR, LOADED_FACTOR = 1e-6, 0.04, 8.0
"""Flat contact: 1 - cos(lean) below the first value. Factors on the impact reference speed of contacts that carried no force, and of
those that did: in rocking, gravity returns the stone so slowly that a point striking at low speed has been open for steps; an uneven
load of the last step, on the other hand, must not be taken for an impact."""


@kernel(_t.int64(_t.int64, _t.int64, VECTOR, MATRIX, _t.float64, LAYOUT, MEMORY))
def _contacts_joint_points(count, j, rel, bodies, dt, pile, memory):
    """Add rows for the points of a joint; count in the scratch those outside the partner's face."""
    joint, k = pile.joints[j], pile.constants[j]
    c, p, sigma = joint[CARRIER], joint[PARTNER], k[SIGMA]
    half, total, max_gap = pile.boxes[p], memory.scratch[1], max_approach(dt, memory)
    for o in range(joint[ORBITS]):
        for q in range(4):
            point, slot = pile.grids[j, o, q], memory.joint_slots[j, o, q]
            if point[2] == 0.0:
                continue
            x, y, z = point[0], point[1], k[LEVEL]
            s0 = rel[9] + rel[0] * x + rel[1] * y + rel[2] * z
            s1 = rel[10] + rel[3] * x + rel[4] * y + rel[5] * z
            # no face of the partner lies under the point: the test of the hulls finds what touches there
            if abs(s0) > half[0] or abs(s1) > half[1]:
                total[OUTSIDE] += 1.0
                slot[ACTIVE] = 0.0
                continue
            s2 = rel[11] + rel[6] * x + rel[7] * y + rel[8] * z
            # overlap with the partner's face
            depth = half[2] + sigma * s2
            slot[POSITION] = s0
            slot[POSITION + 1] = s1
            slot[POSITION + 2] = s2
            slot[POSITION + 3] = 0.0
            slot[POSITION + 4] = 0.0
            slot[POSITION + 5] = -sigma
            count = register_slot(
                count,
                add_contact(count, c, p, slot, -depth, max_gap, k[POINT:], bodies, pile, memory),
                FROM_JOINT,
                j,
                o,
                q,
                slot,
                memory.contact_ids,
            )
    return count


@kernel(_t.int64(_t.int64, _t.int64, VECTOR, _t.float64, MATRIX, LAYOUT, MEMORY))
def _contacts_box_ground(count, pair, rel, max_gap, bodies, pile, memory):
    """Add rows for the corners of a box that may reach the ground; return the number of rows."""
    c, p = pile.pairs[pair, 0], pile.pairs[pair, 1]
    slots, axis = memory.corner_slots[pair, 0], memory.scratch[22]
    for i in range(3):
        axis[i] = 1.0 if i == 2 else 0.0
    # the ground is a plane: corners are tested without a separating axis
    for i in range(pile.counts[c]):
        r = pile.corners[c, i]
        y2 = rel[11] + rel[6] * r[0] + rel[7] * r[1] + rel[8] * r[2]
        gap = y2 - pile.boxes[p, 2]
        if gap > max_gap:
            slots[i, ACTIVE] = 0.0
            continue
        y0 = rel[9] + rel[0] * r[0] + rel[1] * r[1] + rel[2] * r[2]
        y1 = rel[10] + rel[3] * r[0] + rel[4] * r[1] + rel[5] * r[2]
        store_point(slots[i], y0, y1, y2, axis)
        new_count = add_contact(count, c, p, slots[i], gap, max_gap, pile.pair_constants[pair], bodies, pile, memory)
        count = register_slot(count, new_count, FROM_PAIR, pair, 0, i, slots[i], memory.contact_ids)
    return count


@kernel(_t.int64(_t.int64, _t.int64, VECTOR, _t.float64, MATRIX, LAYOUT, MEMORY))
def _contacts_box_box(count, pair, rel, max_gap, bodies, pile, memory):
    """Add rows for the contact manifold of two boxes; return the number of rows."""
    c, p, k, scratch = pile.pairs[pair, 1], pile.pairs[pair, 0], pile.pair_constants[pair], memory.scratch
    slots, old_slots, axis, candidates = memory.corner_slots[pair, 0], memory.corner_slots[pair, 1], scratch[29], scratch[4:20]
    first_slot, max_points, reach = 0, max_contact_points(c, p, pile), match_radius(c, p, pile.boxes)
    # the manifold may change between steps: its points are matched to the old ones by position
    save_slots(max_points, slots, old_slots)
    gap = gap_between(rel, c, p, max_gap, pile, scratch, axis)
    if gap > max_gap:
        return count
    if axis[KIND] >= EDGE_EDGE:
        if edges_cross(rel, c, p, pile, axis, scratch, candidates[0]):
            store_point(slots[0], candidates[0, 0], candidates[0, 1], candidates[0, 2], axis)
            match_point(slots[0], old_slots, max_points, reach)
            new_count = add_contact(count, c, p, slots[0], gap, max_gap, k, bodies, pile, memory)
            count = register_slot(count, new_count, FROM_PAIR, pair, 0, 0, slots[0], memory.contact_ids)
        # the first slot belongs to the crossing of the edges
        first_slot = 1
    points = faces_overlap(rel, c, p, pile, axis, scratch, max_gap, candidates, scratch[20:29])
    for i in range(points):
        if first_slot == 1 and candidates[i, 3] < min(
            gap, 0.0
        ):  # where edges cross, a face says only what comes to lie on it, and has come no deeper
            continue
        slot = slots[first_slot + i]
        store_point(slot, candidates[i, 0], candidates[i, 1], candidates[i, 2], axis[FACE_AXIS:])
        match_point(slot, old_slots, max_points, reach)
        new_count = add_contact(count, c, p, slot, candidates[i, 3], max_gap, k, bodies, pile, memory)
        count = register_slot(count, new_count, FROM_PAIR, pair, 0, first_slot + i, slot, memory.contact_ids)
    return count


@kernel(_t.int64(_t.int64, _t.int64, VECTOR, _t.float64, MATRIX, LAYOUT, MEMORY))
def _contacts_cylinder_ground(count, pair, rel, max_gap, bodies, pile, memory):
    """Add rows for the rim points of a cylinder that may reach the ground; return the number of rows."""
    c, p, k = pile.pairs[pair, 0], pile.pairs[pair, 1], pile.pair_constants[pair]
    slots, old_slots, ground = memory.corner_slots[pair, 0], memory.corner_slots[pair, 1], bodies[bodies.shape[0] - 1]
    axis, axes, loads = memory.scratch[22], memory.scratch[4:8], memory.scratch[8:10]
    for i in range(3):
        axis[i] = 1.0 if i == 2 else 0.0
        axes[0, i] = rel[3 * i + 2]
    load_directions(slots, rel, pile.boxes[c, 0], axes[1])
    sine, reach = lowest_rim_point(0.0, 0.0, 1.0, axes), match_radius(c, p, pile.boxes)
    for i in range(RIMS):
        radius, height = pile.rims[c, i, RADIUS], pile.rims[c, i, HEIGHT]
        if radius == 0.0:
            continue
        rim, old_rim = slots[4 * i : 4 * i + 4], old_slots[4 * i : 4 * i + 4]
        # on a flat rim the four points turn with the load; if they shift too far, the load is redistributed to the new ones
        is_flat = sine == 0.0 and sum_joint_load(rim, ground, loads)
        for q in range(4):
            for j in range(SLOT):
                old_rim[q, j] = rim[q, j]
            direction, side = axes[2 + q % 2], radius if q < 2 else -radius
            y0 = rel[9] + side * direction[0] + height * rel[2]
            y1 = rel[10] + side * direction[1] + height * rel[5]
            y2 = rel[11] + side * direction[2] + height * rel[8]
            store_point(rim[q], y0, y1, y2, axis)
        if is_flat and not (has_lost_loaded_point(4, rim, old_rim, MAX_SHIFT_RATIO * radius) and distribute_load(4, rim, loads, ground)):
            for q in range(4):
                match_point(rim[q], old_rim, 4, reach)
        for q in range(4):
            slot = rim[q]
            new_count = add_contact(count, c, p, slot, slot[POSITION + 2] - pile.boxes[p, 2], max_gap, k, bodies, pile, memory)
            # a point too far away adds no row
            if new_count > count:
                set_rim_contact(q == 0, sine, radius, axes, ground, memory.constraint_rows[count])
            count = register_slot(count, new_count, FROM_PAIR, pair, 0, 4 * i + q, slot, memory.contact_ids)
    return count


@kernel(_t.int64(_t.int64, _t.int64, VECTOR, _t.float64, MATRIX, LAYOUT, MEMORY))
def _contacts_cylinder_face(count, pair, rel, max_gap, bodies, pile, memory):
    """Add rows for the contact manifold of a cylinder's face and another face; return the number of rows.

    Return -1, which leaves the pair to the box-on-box test, if the outlines do not overlap in plan, or if stones that touched as boxes
    overlap too far.
    """
    c, p, k, scratch = pile.pairs[pair, 1], pile.pairs[pair, 0], pile.pair_constants[pair], memory.scratch
    slots, old_slots, axes, axis, candidates = (
        memory.corner_slots[pair, 0],
        memory.corner_slots[pair, 1],
        scratch[7:11],
        scratch[19],
        scratch[20:],
    )
    load_directions(slots, rel, min(pile.boxes[c, 0], pile.boxes[p, 0]), axis[4:])
    points = pile.shapes.face_overlap(c, p, rel, pile.corners, pile.boxes, pile.rims, axis, scratch[4:19], candidates)
    if points == 0:
        return -1
    if memory.pair_states[pair] == BOX_PAIR:
        for i in range(points):
            # a change of the contact model with an overlap would push the stones apart
            if candidates[i, 3] < -MAX_DEPTH_RATIO * smaller_half_length(c, p, pile.boxes):
                return -1
    save_slots(MAX_SHARED_POINTS, slots, old_slots)
    # the rolling rim belongs to the partner if the carrier's face is the reference face
    box = p if axis[3] > 0.0 else c
    side = 1.0 if rel[REL_D + 2] > 0.0 else -1.0
    for i in range(3):
        axes[0, i] = (1.0 if i == 2 else 0.0) if box == p else rel[3 * i + 2]
        axes[1, i] = axis[4 + i]
    up = -1.0 if box == p else 1.0
    sine = lowest_rim_point(up * axis[0], up * axis[1], up * axis[2], axes)
    face = (1 if side > 0.0 else 0) if box == p else (0 if side * rel[8] > 0.0 else 1)
    radius = pile.rims[box, face, RADIUS]
    frame, loads = bodies[pile.owner[p]], scratch[11:13]
    for i in range(points):
        store_point(slots[i], candidates[i, 0], candidates[i, 1], candidates[i, 2], candidates[i, POINT_NORMAL:])
    is_flat = (
        sine == 0.0
        and has_lost_loaded_point(points, slots, old_slots, MAX_SHIFT_RATIO * radius)
        and sum_joint_load(old_slots[:MAX_SHARED_POINTS], frame, loads)
    )
    is_redistributed, reach = is_flat and distribute_load(points, slots, loads, frame), match_radius(c, p, pile.boxes)
    for i in range(points):
        slot = slots[i]
        if not is_redistributed:
            match_point(slot, old_slots, MAX_SHARED_POINTS, reach)
        new_count = add_contact(count, c, p, slot, candidates[i, 3], max_gap, k, bodies, pile, memory)
        if new_count > count:
            set_rim_contact(candidates[i, IS_LOWEST] > 0.0, sine, up * radius, axes, frame, memory.constraint_rows[count])
        count = register_slot(count, new_count, FROM_PAIR, pair, 0, i, slot, memory.contact_ids)
    return count


@kernel(_t.boolean(VECTOR, _t.int64, _t.int64, LAYOUT))
def _faces_aligned(rel, c, p, pile):
    """Return whether the stones of two facing ones that are boxes lean less than the slope of their bevels."""
    up = 1.0 if rel[REL_D + 2] > 0.0 else -1.0
    if pile.rims[c, 0, RADIUS] == 0.0 and not face_supports(pile.corners[c], pile.counts[c], -up * rel[6], -up * rel[7], -up * rel[8]):
        return False
    return pile.rims[p, 0, RADIUS] > 0.0 or face_supports(pile.corners[p], pile.counts[p], up * rel[2], up * rel[5], up * rel[8])


@kernel(_t.int64(_t.int64, _t.int64, MATRIX, _t.float64, LAYOUT, MEMORY), inline=True)
def _contacts_pair(count, pair, bodies, dt, pile, memory):
    """Add rows for the contacts of two boxes, or of a box and the ground; return the number of rows."""
    boxes, rel, start, ground, faces = pile.boxes, memory.scratch[0], count, pile.boxes.shape[0] - 1, -1
    on_ground = pile.pairs[pair, 1] == ground
    c, p = pile.pairs[pair, 0 if on_ground else 1], pile.pairs[pair, 1 if on_ground else 0]
    relative_state(c, p, bodies, boxes, pile.owner, memory.scratch[2:4], rel)
    max_gap, is_left_by_grid = max_approach(dt, memory), memory.pair_states[pair] == GRID_PAIR
    if on_ground and pile.rims[c, 0, RADIUS] > 0.0:
        count = _contacts_cylinder_ground(count, pair, rel, max_gap, bodies, pile, memory)
    elif on_ground:
        count = _contacts_box_ground(count, pair, rel, max_gap, bodies, pile, memory)
    else:
        is_round = pile.rims[c, 0, RADIUS] + pile.rims[p, 0, RADIUS] > 0.0
        if is_round and faces_opposed(rel, boxes[c], boxes[p], pile.rims[c], pile.rims[p]) and _faces_aligned(rel, c, p, pile):
            faces = _contacts_cylinder_face(count, pair, rel, max_gap, bodies, pile, memory)
        count = faces if faces >= 0 else _contacts_box_box(count, pair, rel, max_gap, bodies, pile, memory)
    memory.pair_states[pair] = FACE_PAIR if faces >= 0 else BOX_PAIR
    restitution = pile.pair_constants[pair, RESTITUTION]
    if is_left_by_grid:
        # the outer points of the grid stand inside the border, which has come in by then: pushing the stones apart would lift their load
        for i in range(start, count):
            memory.constraint_rows[i, GAP] = max(memory.constraint_rows[i, GAP], 0.0)
    if rel[8] > MIN_FACING_COSINE:
        # one stone stands on the other: restitution of the joint, and thresholds of impact by the load
        for i in range(start, count):
            row = memory.constraint_rows[i]
            row[RESTITUTION_RATIO] = restitution
            row[IS_STANDING] = 1.0
            # the row still holds the extrapolated force of the warm start
            normal_force = row[IMPULSE] * row[NORMAL] + row[IMPULSE + 1] * row[NORMAL + 1] + row[IMPULSE + 2] * row[NORMAL + 2]
            if normal_force > 0.0:
                row[IMPACT_SPEED] *= LOADED_FACTOR
            elif 1.0 - rel[8] < FLAT_TOLERANCE:
                row[IMPACT_SPEED] *= UNLOADED_FACTOR
        if 1.0 - rel[8] < FLAT_TOLERANCE and pile.rims[c, 0, RADIUS] + pile.rims[p, 0, RADIUS] == 0.0:
            # the solver leaves the load of a flat joint in an arbitrary distribution: start from the smoothest one
            project_to_plane(start, count, TOUCH_RATIO * smaller_half_length(c, p, boxes), memory.constraint_rows)
    return count


@kernel(_t.int64(_t.int64, _t.int64, MATRIX, _t.float64, LAYOUT, MEMORY), inline=True)
def _contacts_joint(count, j, bodies, dt, pile, memory):
    """Add rows for the points of a joint; leave the pair to the box test where points overhang the partner's face."""
    joint, k, boxes, scratch = pile.joints[j], pile.constants[j], pile.boxes, memory.scratch
    c, p, rel, total = joint[CARRIER], joint[PARTNER], scratch[0], scratch[1]
    relative_state(c, p, bodies, boxes, pile.owner, scratch[2:4], rel)
    is_engaged = is_joint_engaged(k[SIGMA], rel, boxes[c], boxes[p])
    total[OUTSIDE] = 0.0
    if is_engaged == 1:
        count = _contacts_joint_points(count, j, rel, bodies, dt, pile, memory)
    leans = is_engaged == 1 and bevel_touches(rel, c, p, k[SIGMA], max_approach(dt, memory), pile)
    memory.pair_states[joint[PAIR]] = 1 if is_engaged == 1 and not leans and total[OUTSIDE] == 0.0 else GRID_PAIR
    return count


@kernel(_t.boolean(_t.int64, LAYOUT, MEMORY), inline=True)
def _both_sleeping(pair, pile, memory):
    """Return whether both bodies of a pair sleep: such a pair needs no contacts."""
    a, b = pile.owner[pile.pairs[pair, 0]], pile.owner[pile.pairs[pair, 1]]
    return memory.sleep_states[a, SUPPORT_POINTS] > 0 and memory.sleep_states[b, SUPPORT_POINTS] > 0


@kernel(_t.int64(MATRIX, _t.float64, _t.boolean, LAYOUT, MEMORY), inline=True)
def find_contacts(bodies, dt, refresh_bounds, pile, memory):
    """Run broad and narrow phase: write the constraint rows of all contacts and return their number.

    Joints with points of their own use these while their stones face each other; all other pairs are tested as separate hulls.
    """
    count, memory.step_info[MAX_SPEED] = 0, max_corner_speed(bodies, pile.boxes, pile.owner)
    # joints first: they decide which pairs are left to the test of the hulls
    for j in range(pile.joints.shape[0]):
        pair = pile.joints[j, PAIR]
        if pile.constants[j, POINT + CLAMP_TO_EDGE] == 0.0 and not _both_sleeping(pair, pile, memory):
            count = _contacts_joint(count, j, bodies, dt, pile, memory)
    if refresh_bounds:
        update_aabbs(bodies, pile.boxes, pile.owner, dt, memory.bounds)
    for pair in range(pile.pairs.shape[0]):
        if memory.pair_states[pair] > 0 or _both_sleeping(pair, pile, memory):
            continue
        if aabbs_overlap(pile.pairs[pair, 0], pile.pairs[pair, 1], memory.bounds):
            count = _contacts_pair(count, pair, bodies, dt, pile, memory)
        elif memory.pair_states[pair] < 0:
            memory.pair_states[pair] = 0
            # the pair has just separated: its memory must not warm-start a later contact
            clear_pair(pair, memory)
    return count
