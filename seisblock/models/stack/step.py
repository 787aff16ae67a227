"""One step of a pile: every contact force, then every stone on by one step.

Positions and axes stand at the step, velocities and angular momenta half a step before (leapfrog); dashpots feel those. Each contact
adds one force and its opposite, so momentum is kept exactly. In the ground's axes each stone also feels -(a_ground + g).
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import INTEGERS, MATRIX, VECTOR
from seisblock.models.stack.box_contacts_spring import add_corner_forces, add_edge_forces, boxes_overlap
from seisblock.models.stack.buffers import LAYOUT, MEMORY
from seisblock.models.stack.frames import (
    BOX_CENTRE,
    MASS,
    F,
    L,
    Q,
    R,
    T,
    V,
    W,
    X,
    apply_contact_force,
    relative_state,
    rotate,
    update_rotation_matrix,
    update_spin,
)
from seisblock.models.stack.spring_contact import ACTIVE, ALIVE, ENERGY, OUTSIDE, SUM, TOUCHING, add_joint_forces

_t = types()

CARRIER, PARTNER, ORBITS, PAIR = range(4)
"""A joint's integers: its boxes, the number of its orbits of points, and the pair of boxes it belongs to."""

SIGMA, LEVEL, POINT = 0, 1, 2
JOINT = 10
"""A joint's constants: which face of the carrier (-1 lower, +1 upper), z of that face, and the eight of one point."""

MIN_FACING_COSINE = 0.7071067811865476
"""Two stones whose upward axes are within 45 degrees meet at their joint's points; beyond, at corners and edges."""

MIN_JOINT_HEIGHT_RATIO = 0.4
"""The joint acts while the carrier's centre is above the partner's face by this part of its half height."""

FACE_EDGES = 4
BOX_EDGES = 12
SCRATCH_ROWS = 36
"""Rows of scratch."""

BROAD_PHASE_INTERVAL = 1e-3
"""How often, s, boxes are looked at for being near each other, or at every step that is longer."""

AABB_MARGIN, SPEED_FACTOR = 0.01, 2.0
"""How much, m, the bounds of boxes are widened for what they may move until they are looked at again, and how many times more what the
fastest corner of any moves: what a stone strikes may turn it the other way round, or be driven on."""

SLOW_SPIN = 1e-6
"""Square of the spin, rad^2/s^2, below which a body's axes count as still during a step."""


@kernel(_t.int64(_t.float64, VECTOR, VECTOR, VECTOR))
def is_joint_engaged(sigma, rel, carrier, partner):
    """Whether two boxes still face each other with the faces of their joint: 1 or 0."""
    height = -sigma * rel[11]
    return 1 if rel[8] > MIN_FACING_COSINE and height > partner[2] + MIN_JOINT_HEIGHT_RATIO * carrier[2] else 0


@kernel(_t.void(_t.int64, MEMORY))
def clear_pair(pair, memory):
    """Let the contacts of a pair die."""
    for role in range(2):
        for i in range(memory.corner_slots.shape[2]):
            memory.corner_slots[pair, role, i, ALIVE] = 0.0
            memory.corner_slots[pair, role, i, ACTIVE] = 0.0
        for i in range(memory.edge_slots.shape[2]):
            memory.edge_slots[pair, role, i, ALIVE] = 0.0
            memory.edge_slots[pair, role, i, ACTIVE] = 0.0


@kernel(_t.void(INTEGERS, MATRIX, _t.int64, _t.int64, VECTOR), inline=True)
def _mark_touching(owner, contact_matrix, c, p, total):
    """Note that two bodies touch."""
    if total[TOUCHING] > 0.0:
        contact_matrix[owner[c], owner[p]] = 1.0
        contact_matrix[owner[p], owner[c]] = 1.0


@kernel(_t.float64(_t.int64, _t.int64, _t.int64, _t.int64, _t.int64, _t.int64, MATRIX, _t.float64, LAYOUT, MEMORY))
def _add_pair_forces(pair, role, n_corners, first_edge, n_edges, check, bodies, dt, pile, memory):
    """Add the forces of one box's corners and edges on the other; return the energy in their springs, or -1 if the boxes are apart."""
    corners, boxes, owner, work = pile.corners, pile.boxes, pile.owner, memory.scratch
    c, p = pile.pairs[pair, role], pile.pairs[pair, 1 - role]
    k = pile.pair_constants[pair]
    rel, total, arms, scratch = work[0], work[1], work[2:4], work[8:13]
    relative_state(c, p, bodies, boxes, owner, arms, rel)
    if check == 1 and not boxes_overlap(rel, boxes[c], boxes[p]):
        return -1.0
    for i in range(SUM):
        total[i] = 0.0
    if n_corners > 0:
        add_corner_forces(n_corners, rel, corners[c], boxes[p], k, dt, memory.corner_slots[pair, role], scratch[0], scratch[1], total)
    if n_edges > 0:
        add_edge_forces(
            n_edges,
            rel,
            corners[c],
            pile.edges[c, first_edge:],
            boxes[p],
            k,
            dt,
            memory.edge_slots[pair, role, 2 * first_edge :],
            scratch,
            total,
        )
    _mark_touching(owner, memory.contact_matrix, c, p, total)
    apply_contact_force(bodies[owner[c]], bodies[owner[p]], arms, total)
    return total[ENERGY]


@kernel(_t.float64(_t.int64, MATRIX, _t.float64, LAYOUT, MEMORY), inline=True)
def _add_joint_and_overhang(j, bodies, dt, pile, memory):
    """Add the forces of a joint, and of what hangs over its border; return the energy in its springs."""
    boxes, owner, pair_states, work = pile.boxes, pile.owner, memory.pair_states, memory.scratch
    joint, k = pile.joints[j], pile.constants[j]
    c, p, pair = joint[CARRIER], joint[PARTNER], joint[PAIR]
    rel, total, arms, orbit = work[0], work[1], work[2:4], work[4:8]
    relative_state(c, p, bodies, boxes, owner, arms, rel)
    is_engaged = is_joint_engaged(k[SIGMA], rel, boxes[c], boxes[p])
    for i in range(SUM):
        total[i] = 0.0
    grid, stretch = pile.grids[j], memory.stretches[j]
    add_joint_forces(joint[ORBITS], rel, grid, k[SIGMA], boxes[c], boxes[p], k[LEVEL], k[POINT:], is_engaged, dt, stretch, orbit, total)
    _mark_touching(owner, memory.contact_matrix, c, p, total)
    apply_contact_force(bodies[owner[c]], bodies[owner[p]], arms, total)
    energy = total[ENERGY]
    role = 0 if pile.pairs[pair, 0] == c else 1
    if is_engaged == 1 and total[OUTSIDE] > 0.0:
        energy += _add_pair_forces(pair, role, 0, FACE_EDGES if k[SIGMA] > 0.0 else 0, FACE_EDGES, 0, bodies, dt, pile, memory)
        energy += _add_pair_forces(pair, 1 - role, pile.counts[p], 0, 0, 0, bodies, dt, pile, memory)
        pair_states[pair] = 2
    else:
        if pair_states[pair] == 2 and is_engaged == 1:
            clear_pair(pair, memory)
        pair_states[pair] = is_engaged
    return energy


@kernel(_t.float64(MATRIX, MATRIX, INTEGERS))
def max_corner_speed(bodies, boxes, owner):
    """Return a speed, m/s, that no corner of any box exceeds."""
    max_speed = 0.0
    for i in range(boxes.shape[0]):
        b, box = bodies[owner[i]], boxes[i]
        reach = (box[0] ** 2 + box[1] ** 2 + box[2] ** 2) ** 0.5 + (
            box[BOX_CENTRE] ** 2 + box[BOX_CENTRE + 1] ** 2 + box[BOX_CENTRE + 2] ** 2
        ) ** 0.5
        spin_speed = (b[W] ** 2 + b[W + 1] ** 2 + b[W + 2] ** 2) ** 0.5
        max_speed = max(max_speed, (b[V] ** 2 + b[V + 1] ** 2 + b[V + 2] ** 2) ** 0.5 + spin_speed * reach)
    return max_speed


@kernel(_t.void(MATRIX, MATRIX, INTEGERS, _t.float64, MATRIX))
def update_aabbs(bodies, boxes, owner, dt, bounds):
    """Write the centres of the boxes and how far they reach along the ground's axes until they are looked at again."""
    margin = AABB_MARGIN + SPEED_FACTOR * max(dt, BROAD_PHASE_INTERVAL) * max_corner_speed(bodies, boxes, owner)
    for i in range(boxes.shape[0]):
        b = bodies[owner[i]]
        box = boxes[i]
        for k in range(3):
            r = R + 3 * k
            bounds[i, k] = b[X + k] + b[r] * box[BOX_CENTRE] + b[r + 1] * box[BOX_CENTRE + 1] + b[r + 2] * box[BOX_CENTRE + 2]
            bounds[i, 3 + k] = abs(b[r]) * box[0] + abs(b[r + 1]) * box[1] + abs(b[r + 2]) * box[2] + margin


@kernel(_t.boolean(_t.int64, _t.int64, MATRIX), inline=True)
def aabbs_overlap(i, j, bounds):
    """Whether the bounds of two boxes overlap."""
    return (
        abs(bounds[i, 2] - bounds[j, 2]) <= bounds[i, 5] + bounds[j, 5]
        and abs(bounds[i, 0] - bounds[j, 0]) <= bounds[i, 3] + bounds[j, 3]
        and abs(bounds[i, 1] - bounds[j, 1]) <= bounds[i, 4] + bounds[j, 4]
    )


@kernel(_t.float64(MATRIX, _t.float64, _t.boolean, LAYOUT, MEMORY), inline=True)
def add_all_forces(bodies, dt, refresh_bounds, pile, memory):
    """Add every contact force to the bodies; return the energy in the springs, J.

    Which boxes are near each other is found anew when asked to `refresh_bounds`, with a margin for what they may move until the next time.
    """
    pairs, counts, pair_states = pile.pairs, pile.counts, memory.pair_states
    energy = 0.0
    for j in range(pile.joints.shape[0]):
        energy += _add_joint_and_overhang(j, bodies, dt, pile, memory)
    if refresh_bounds:
        update_aabbs(bodies, pile.boxes, pile.owner, dt, memory.bounds)
    for pair in range(pairs.shape[0]):
        if pair_states[pair] > 0:
            continue
        i, j = pairs[pair, 0], pairs[pair, 1]
        stored = -1.0
        if aabbs_overlap(i, j, memory.bounds):
            stored = _add_pair_forces(pair, 0, counts[i], 0, BOX_EDGES, 1, bodies, dt, pile, memory)
        if stored >= 0.0:
            energy += stored + _add_pair_forces(pair, 1, counts[j], 0, 0, 0, bodies, dt, pile, memory)
            pair_states[pair] = -1
        elif pair_states[pair] == -1:
            pair_states[pair] = 0
            clear_pair(pair, memory)
    return energy


@kernel(_t.void(_t.int64, MATRIX, MATRIX, _t.float64, _t.float64, _t.float64, _t.float64))
def kick(n, bodies, inertias, a0, a1, a2, dt):
    """Change the velocities by the forces, in axes that accelerate by (a0, a1, a2), gravity among it, over `dt`."""
    for i in range(n):
        b = bodies[i]
        m = inertias[i, MASS]
        b[V] += dt * (b[F] / m - a0)
        b[V + 1] += dt * (b[F + 1] / m - a1)
        b[V + 2] += dt * (b[F + 2] / m - a2)
        for k in range(3):
            b[L + k] += dt * b[T + k]
        update_spin(b, inertias[i])


@kernel(_t.void(_t.int64, MATRIX, MATRIX, _t.float64))
def drift(n, bodies, inertias, dt):
    """Move and turn the bodies over `dt`, and clear the forces; spins stay those of the half step, as velocities do."""
    for i in range(n):
        b = bodies[i]
        for k in range(3):
            b[X + k] += dt * b[V + k]
        if b[W] ** 2 + b[W + 1] ** 2 + b[W + 2] ** 2 > SLOW_SPIN:
            # the spin halfway, so that a free body keeps its energy
            w, x, y, z = b[Q], b[Q + 1], b[Q + 2], b[Q + 3]
            rotate(b, 0.5 * dt)
            update_rotation_matrix(b)
            update_spin(b, inertias[i])
            b[Q] = w
            b[Q + 1] = x
            b[Q + 2] = y
            b[Q + 3] = z
        rotate(b, dt)
        update_rotation_matrix(b)
    for i in range(n + 1):
        for k in range(F, T + 3):
            bodies[i, k] = 0.0


@kernel(_t.float64(_t.int64, MATRIX, MATRIX, _t.float64))
def mechanical_energy(n, bodies, inertias, gravity):
    """Return the kinetic and potential energy of the stones, J."""
    energy = 0.0
    for i in range(n):
        b = bodies[i]
        m = inertias[i, MASS]
        energy += m * gravity * b[X + 2]
        energy += 0.5 * m * (b[V] ** 2 + b[V + 1] ** 2 + b[V + 2] ** 2)
        energy += 0.5 * (b[L] * b[W] + b[L + 1] * b[W + 1] + b[L + 2] * b[W + 2])
    return energy
