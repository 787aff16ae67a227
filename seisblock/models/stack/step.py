"""One step of a pile: contact forces of springs, then kick and drift of the bodies (leapfrog).

Positions and axes are known at the step, velocities and angular momenta half a step before; dashpots use those. Each contact adds a
force and its opposite, so momentum is conserved exactly. In the ground's axes every stone also feels -(a_ground + g).
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import INTEGERS, MATRIX, VECTOR
from seisblock.models.stack.box_contacts_spring import add_corner_forces, add_edge_forces, boxes_overlap
from seisblock.models.stack.broad_phase import aabbs_overlap, update_aabbs
from seisblock.models.stack.buffers import LAYOUT, MEMORY
from seisblock.models.stack.frames import (
    MASS,
    F,
    L,
    Q,
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
from seisblock.models.stack.spring_contact import ACTIVE, ALIVE, ENERGY, N_IN_CONTACT, OUTSIDE, SUM, add_joint_forces

_t = types()

CARRIER, PARTNER, ORBITS, PAIR = range(4)
"""A joint's integers: carrier, partner, number of orbits of points, and the pair of boxes it belongs to."""

SIGMA, LEVEL, POINT = 0, 1, 2
JOINT = 10
"""A joint's constants: face of the carrier (-1 lower, +1 upper), z of that face, m, and the eight constants of a point."""

MIN_FACING_COSINE = 0.7071067811865476
"""Cosine of the angle (45 degrees) between the axes of two stones up to which a joint acts; beyond it corners and edges do."""

MIN_JOINT_HEIGHT_RATIO = 0.4
"""Smallest height of the carrier's centre above the partner's face, over its half height, at which a joint acts."""

FACE_EDGES = 4
BOX_EDGES = 12
SCRATCH_ROWS = 36
"""Rows of scratch."""

SLOW_ROTATION = 1e-14
"""Squared rotation of a step, rad^2, below which its effect on the spin is neglected."""


@kernel(_t.int64(_t.float64, VECTOR, VECTOR, VECTOR))
def is_joint_engaged(sigma, rel, carrier, partner):
    """Return 1 if the faces of a joint still face each other, else 0."""
    height = -sigma * rel[11]
    # corners and edges take over where the faces no longer face each other, without a gap between the two
    # descriptions
    return 1 if rel[8] > MIN_FACING_COSINE and height > partner[2] + MIN_JOINT_HEIGHT_RATIO * carrier[2] else 0


@kernel(_t.void(_t.int64, MEMORY))
def clear_pair(pair, memory):
    """Reset the contact memory of a pair."""
    for role in range(2):
        for i in range(memory.corner_slots.shape[2]):
            memory.corner_slots[pair, role, i, ALIVE] = 0.0
            memory.corner_slots[pair, role, i, ACTIVE] = 0.0
        for i in range(memory.edge_slots.shape[2]):
            memory.edge_slots[pair, role, i, ALIVE] = 0.0
            memory.edge_slots[pair, role, i, ACTIVE] = 0.0


@kernel(_t.void(INTEGERS, MATRIX, _t.int64, _t.int64, VECTOR), inline=True)
def _mark_touching(owner, contact_matrix, c, p, total):
    """Mark two bodies as touching if any point carries a force."""
    if total[N_IN_CONTACT] > 0.0:
        contact_matrix[owner[c], owner[p]] = 1.0
        contact_matrix[owner[p], owner[c]] = 1.0


@kernel(_t.float64(_t.int64, _t.int64, _t.int64, _t.int64, _t.int64, _t.int64, MATRIX, _t.float64, LAYOUT, MEMORY))
def _add_pair_forces(pair, role, n_corners, first_edge, n_edges, check, bodies, dt, pile, memory):
    """Add the forces of one box's corners and edges on the other; return the energy in their springs, J, or -1 if they are apart."""
    corners, boxes, owner, work = pile.corners, pile.boxes, pile.owner, memory.scratch
    c, p = pile.pairs[pair, role], pile.pairs[pair, 1 - role]
    k = pile.pair_constants[pair]
    rel, total, arms, scratch = work[0], work[1], work[2:4], work[8:13]
    relative_state(c, p, bodies, boxes, owner, arms, rel)
    # separating-axis test, before any force is computed
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
    """Add the forces of a joint and of corners and edges that overhang it; return the energy in its springs, J."""
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
    # the part of the carrier outside the partner's face touches it with edges and corners only
    if is_engaged == 1 and total[OUTSIDE] > 0.0:
        energy += _add_pair_forces(pair, role, 0, FACE_EDGES if k[SIGMA] > 0.0 else 0, FACE_EDGES, 0, bodies, dt, pile, memory)
        energy += _add_pair_forces(pair, 1 - role, pile.counts[p], 0, 0, 0, bodies, dt, pile, memory)
        pair_states[pair] = 2
    else:
        # no overhang any more: the joint alone carries, and free contacts must not keep their stretch
        if pair_states[pair] == 2 and is_engaged == 1:
            clear_pair(pair, memory)
        pair_states[pair] = is_engaged
    return energy


@kernel(_t.float64(MATRIX, _t.float64, _t.boolean, LAYOUT, MEMORY), inline=True)
def add_all_forces(bodies, dt, refresh_bounds, pile, memory):
    """Add every contact force to the bodies; return the energy in the springs, J.

    The broad phase updates its bounding boxes on `refresh_bounds`; their margin covers the motion until the next update.
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
        # negative: the boxes are apart and their contact memory is to be cleared
        stored = -1.0
        if aabbs_overlap(i, j, memory.bounds):
            stored = _add_pair_forces(pair, 0, counts[i], 0, BOX_EDGES, 1, bodies, dt, pile, memory)
        if stored >= 0.0:
            energy += stored + _add_pair_forces(pair, 1, counts[j], 0, 0, 0, bodies, dt, pile, memory)
            pair_states[pair] = -1
        # the boxes have separated since the last step: a later contact starts without a stretch
        elif pair_states[pair] == -1:
            pair_states[pair] = 0
            clear_pair(pair, memory)
    return energy


@kernel(_t.void(_t.int64, MATRIX, MATRIX, _t.float64, _t.float64, _t.float64, _t.float64))
def kick(n, bodies, inertias, a0, a1, a2, dt):
    """Advance the velocities by the forces over `dt`, in a frame accelerated by (a0, a1, a2), gravity included."""
    for i in range(n):
        b = bodies[i]
        m = inertias[i, MASS]
        # weight and inertia of the accelerated frame act at the centre, without a moment
        b[V] += dt * (b[F] / m - a0)
        b[V + 1] += dt * (b[F + 1] / m - a1)
        b[V + 2] += dt * (b[F + 2] / m - a2)
        for k in range(3):
            b[L + k] += dt * b[T + k]
        update_spin(b, inertias[i])


@kernel(_t.void(_t.int64, MATRIX, MATRIX, _t.float64))
def drift(n, bodies, inertias, dt):
    """Advance positions and rotations over `dt` and clear the forces; spins stay at the half step, like velocities."""
    for i in range(n):
        b = bodies[i]
        for k in range(3):
            b[X + k] += dt * b[V + k]
        if dt * dt * (b[W] ** 2 + b[W + 1] ** 2 + b[W + 2] ** 2) > SLOW_ROTATION:
            # midpoint rule: the spin at half the rotation, so that a free body keeps its energy
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
