"""One step of a rigid body on the ground: conserving midpoint rule with contact impulses, and impacts.

Relative to the ground, with the ground's acceleration a, impulses p_i of the contacts at x_i from the centre of gravity, and J the inertia,

    m v' = -m (a + g e_z) + sum p_i',    (R J W)' = sum x_i cross p_i',    r' = v,    R' = R [W].

A step h with the mean velocities v_m = (v + v+)/2 and W_m = (W + W+)/2 moves r+ = r + h v_m and turns R+ = R cay(h W_m), with the momenta
m (v+ - v) = -h m (a + g e_z) + sum p_i and R+ J W+ - R J W = sum x_i cross p_i ([SimoWong1991]_). Cayley's map gives
R+ - R = h [R W_m] (R + R+)/2 exactly. With x_i = (R + R+)/2 X_i, therefore (derived here),

1. a vertex moves by exactly h u_i, u_i = v_m + (R W_m) cross x_i, so that a condition on u_i is one on its place: no drift;
2. the kinetic energy changes by exactly sum p_i . u_i less the work of a and g, so that a contact that sticks (u_i = 0) does no work and
   one that slips loses energy: energy is never created, whatever the step.

A mean velocity of zero leaves the end velocity of a contact as the opposite of that at the start; a projection at the end of each step,
with the friction of the step, removes it. It dissipates, as a plastic impact does.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import VECTOR
from seisblock.models.rigid3d.buffers import (
    ALPHA,
    BODY,
    GAP,
    GRAVITY,
    MASS,
    MU,
    NEAR,
    PATH,
    RESTITUTION,
    SCRATCH,
    SPEED,
    STATE_SIZE,
    Q,
    V,
    W,
    X,
)
from seisblock.models.rigid3d.contact import solve_contacts

_t = types()

MAX_PASSES, FREE_PASSES = 40, 15
"""Largest number of passes of the fixed-point iteration for the mean rotation of a step, and number after which the impulses stay."""

PASS_TOLERANCE = 1e-14
"""Change of the rotation of a step, rad, at which that iteration ends."""

CONTACT_TOLERANCE = 2e-3
"""Tolerance of the contact velocities over the speed below which the body rests."""

LEVEL = 1e-3
"""Height over the largest one of a contact, up to which a vertex is on the ground: well above the round-off of heights."""

LARGE_SPEED = 1e6
"""Shift of the normal velocity of a contact that does not act, m/s."""

STICKING = 1e-9
"""Share of the square of the friction limit below which a contact does not stick."""

BOUNCE_RATIO = 1e6
"""Rebound over the speed below which the body rests, from which on the coefficient of restitution acts; slower impacts are plastic."""


@kernel(_t.void(VECTOR, VECTOR))
def rotation_matrix(y, rotation):
    """Write the rotation matrix of a state."""
    a, b, c, d = y[Q], y[Q + 1], y[Q + 2], y[Q + 3]
    rotation[0] = a * a + b * b - c * c - d * d
    rotation[1] = 2.0 * (b * c - a * d)
    rotation[2] = 2.0 * (b * d + a * c)
    rotation[3] = 2.0 * (b * c + a * d)
    rotation[4] = a * a - b * b + c * c - d * d
    rotation[5] = 2.0 * (c * d - a * b)
    rotation[6] = 2.0 * (b * d - a * c)
    rotation[7] = 2.0 * (c * d + a * b)
    rotation[8] = a * a - b * b - c * c + d * d


@kernel(_t.void(BODY, SCRATCH))
def _spatial_inertia(body, scratch):
    """Write R J R' into `spatial`, with the rotation matrix R in `rotation`."""
    r, j, s = scratch.rotation, body.inertia, scratch.spatial
    for p in range(3):
        a0 = r[3 * p] * j[0] + r[3 * p + 1] * j[3] + r[3 * p + 2] * j[6]
        a1 = r[3 * p] * j[1] + r[3 * p + 1] * j[4] + r[3 * p + 2] * j[7]
        a2 = r[3 * p] * j[2] + r[3 * p + 1] * j[5] + r[3 * p + 2] * j[8]
        for q in range(3):
            s[3 * p + q] = a0 * r[3 * q] + a1 * r[3 * q + 1] + a2 * r[3 * q + 2]


@kernel(_t.void(VECTOR, _t.float64, BODY, SCRATCH))
def list_near(y, margin, body, scratch):
    """Write rotation matrix, spatial inertia and heights of all vertices above the ground of a state; list those within a margin.

    Until a vertex has moved by the margin, the others cannot reach the ground.
    """
    # far vertices are not tested in every step, which counts for scans of thousands of vertices
    rotation_matrix(y, scratch.rotation)
    _spatial_inertia(body, scratch)
    r, vertices, heights, level = scratch.rotation, body.vertices, scratch.heights, y[X + 2]
    r0, r1, r2, count = r[6], r[7], r[8], 0
    for i in range(heights.size):
        heights[i] = level + (r0 * vertices[0, i] + r1 * vertices[1, i] + r2 * vertices[2, i])
    for i in range(heights.size):
        if heights[i] <= margin:
            scratch.near[count] = i
            count += 1
    scratch.counters[NEAR] = count
    scratch.ledger[PATH] = 0.0


@kernel(_t.void(VECTOR, BODY, SCRATCH))
def update_heights(y, body, scratch):
    """Write rotation matrix, spatial inertia and heights of the near vertices above the ground of a state."""
    rotation_matrix(y, scratch.rotation)
    _spatial_inertia(body, scratch)
    r, vertices, heights, level = scratch.rotation, body.vertices, scratch.heights, y[X + 2]
    r0, r1, r2 = r[6], r[7], r[8]
    for k in range(scratch.counters[NEAR]):
        i = scratch.near[k]
        heights[i] = level + (r0 * vertices[0, i] + r1 * vertices[1, i] + r2 * vertices[2, i])


@kernel(_t.int64(_t.float64, SCRATCH))
def find_contacts(reach, scratch):
    """List the near vertices within a height above the ground; return their number."""
    count = 0
    for k in range(scratch.counters[NEAR]):
        i = scratch.near[k]
        if scratch.heights[i] <= reach:
            scratch.ids[count] = i
            count += 1
    return count


@kernel(_t.float64(VECTOR, BODY))
def mechanical_energy(y, body):
    """Return kinetic and potential energy relative to the ground, J."""
    j, c = body.inertia, body.constants
    w0, w1, w2 = y[W], y[W + 1], y[W + 2]
    rotational = (
        w0 * (j[0] * w0 + j[1] * w1 + j[2] * w2) + w1 * (j[3] * w0 + j[4] * w1 + j[5] * w2) + w2 * (j[6] * w0 + j[7] * w1 + j[8] * w2)
    )
    squared = y[V] * y[V] + y[V + 1] * y[V + 1] + y[V + 2] * y[V + 2]
    return 0.5 * (c[MASS] * squared + rotational) + c[MASS] * c[GRAVITY] * y[X + 2]


@kernel(_t.boolean(VECTOR, _t.float64, _t.float64, _t.float64, _t.float64, _t.int64, BODY, SCRATCH))
def midpoint_step(y, h, a0, a1, a2, count, body, scratch):
    """Step from a state into `trial` with the contacts in `ids`; return whether all iterations converged.

    Rotation matrix, spatial inertia and heights must be those of the state; `a2` includes gravity.
    """
    c, r, s, left, gyro = body.constants, scratch.rotation, scratch.spatial, scratch.left, scratch.gyroscopic
    contacts, impulses, velocity, momentum = scratch.contacts, scratch.impulses, scratch.velocity, scratch.momentum
    mass, trial, j = c[MASS], scratch.trial, body.inertia
    # the state keeps the spin in the body's axes; the equations of a step are those of the ground's
    s0 = r[0] * y[W] + r[1] * y[W + 1] + r[2] * y[W + 2]
    s1 = r[3] * y[W] + r[4] * y[W + 1] + r[5] * y[W + 2]
    s2 = r[6] * y[W] + r[7] * y[W + 1] + r[8] * y[W + 2]
    # the unknown is the mean velocity, v+ = 2 v_m - v: hence twice the mass, and twice the old momentum
    momentum[0] = mass * (2.0 * y[V] - h * a0)
    momentum[1] = mass * (2.0 * y[V + 1] - h * a1)
    momentum[2] = mass * (2.0 * y[V + 2] - h * a2)
    for i in range(3):
        velocity[i] = momentum[i] / (2.0 * mass)
    # angular momentum
    m0 = j[0] * y[W] + j[1] * y[W + 1] + j[2] * y[W + 2]
    m1 = j[3] * y[W] + j[4] * y[W + 1] + j[5] * y[W + 2]
    m2 = j[6] * y[W] + j[7] * y[W + 1] + j[8] * y[W + 2]
    k0, k1, k2 = r[0] * m0 + r[1] * m1 + r[2] * m2, r[3] * m0 + r[4] * m1 + r[5] * m2, r[6] * m0 + r[7] * m1 + r[8] * m2
    # prediction from the last angular acceleration, for fewer passes
    w0, w1, w2 = s0 + 0.5 * h * y[ALPHA], s1 + 0.5 * h * y[ALPHA + 1], s2 + 0.5 * h * y[ALPHA + 2]
    velocity[3], velocity[4], velocity[5] = w0, w1, w2
    # a start without impulses shares a common load evenly, see ``contact``
    for i in range(count):
        impulses[i, 0], impulses[i, 1], impulses[i, 2] = 0.0, 0.0, 0.0
    converged, frozen, polished = False, False, count > 0
    for turn in range(MAX_PASSES):
        # left = (1 - [h w]/2)^-1: the mean of the rotations at both ends is left R
        e0, e1, e2 = 0.5 * h * w0, 0.5 * h * w1, 0.5 * h * w2
        scale = 1.0 / (1.0 + e0 * e0 + e1 * e1 + e2 * e2)
        left[0], left[1], left[2] = scale * (1.0 + e0 * e0), scale * (e0 * e1 - e2), scale * (e0 * e2 + e1)
        left[3], left[4], left[5] = scale * (e0 * e1 + e2), scale * (1.0 + e1 * e1), scale * (e1 * e2 - e0)
        left[6], left[7], left[8] = scale * (e0 * e2 - e1), scale * (e1 * e2 + e0), scale * (1.0 + e2 * e2)
        # through the body's axes: the matrix R J R' has lost the small moment of a slender body to round-off
        b0, b1, b2 = r[0] * w0 + r[3] * w1 + r[6] * w2, r[1] * w0 + r[4] * w1 + r[7] * w2, r[2] * w0 + r[5] * w1 + r[8] * w2
        m0, m1, m2 = j[0] * b0 + j[1] * b1 + j[2] * b2, j[3] * b0 + j[4] * b1 + j[5] * b2, j[6] * b0 + j[7] * b1 + j[8] * b2
        l0, l1, l2 = r[0] * m0 + r[1] * m1 + r[2] * m2, r[3] * m0 + r[4] * m1 + r[5] * m2, r[6] * m0 + r[7] * m1 + r[8] * m2
        # gyroscopic term h w x J w, linear about the last pass: 2 J + h ([w] J - [J w])
        for q in range(3):
            gyro[q] = 2.0 * s[q] + h * (w1 * s[6 + q] - w2 * s[3 + q])
            gyro[3 + q] = 2.0 * s[3 + q] + h * (w2 * s[q] - w0 * s[6 + q])
            gyro[6 + q] = 2.0 * s[6 + q] + h * (w0 * s[3 + q] - w1 * s[q])
        gyro[1] += h * l2
        gyro[2] -= h * l1
        gyro[3] -= h * l2
        gyro[5] += h * l0
        gyro[6] += h * l1
        gyro[7] -= h * l0
        # residual of the last pass: the linear system is for the change of the spin, which its round-off does not harm
        g0 = 2.0 * (k0 - l0) - h * (w1 * l2 - w2 * l1)
        g1 = 2.0 * (k1 - l1) - h * (w2 * l0 - w0 * l2)
        g2 = 2.0 * (k2 - l2) - h * (w0 * l1 - w1 * l0)
        inertia = scratch.mean_inertia
        for p in range(3):
            for q in range(3):
                inertia[3 * p + q] = left[3 * p] * gyro[q] + left[3 * p + 1] * gyro[3 + q] + left[3 * p + 2] * gyro[6 + q]
            momentum[3 + p] = left[3 * p] * g0 + left[3 * p + 1] * g1 + left[3 * p + 2] * g2
            momentum[3 + p] += inertia[3 * p] * w0 + inertia[3 * p + 1] * w1 + inertia[3 * p + 2] * w2
        for k in range(count):
            i = scratch.ids[k]
            x, y_, z = body.vertices[0, i], body.vertices[1, i], body.vertices[2, i]
            x0, x1, x2 = r[0] * x + r[1] * y_ + r[2] * z, r[3] * x + r[4] * y_ + r[5] * z, r[6] * x + r[7] * y_ + r[8] * z
            contacts[k, 0] = left[0] * x0 + left[1] * x1 + left[2] * x2
            contacts[k, 1] = left[3] * x0 + left[4] * x1 + left[5] * x2
            contacts[k, 2] = left[6] * x0 + left[7] * x1 + left[8] * x2
            # a vertex above the ground may come down to it within the step, not further; round-off of the heights of one face would ask
            # for velocities that no rigid body has
            height = scratch.heights[i] if scratch.heights[i] > LEVEL * c[GAP] else 0.0
            contacts[k, 3], contacts[k, 4] = height / h, 0.0
            if frozen:
                p0, p1, p2 = impulses[k, 0], impulses[k, 1], impulses[k, 2]
                momentum[3] += contacts[k, 1] * p2 - contacts[k, 2] * p1
                momentum[4] += contacts[k, 2] * p0 - contacts[k, 0] * p2
                momentum[5] += contacts[k, 0] * p1 - contacts[k, 1] * p0
        solved = solve_contacts(
            0 if frozen else count,
            2.0 * mass,
            inertia,
            momentum,
            contacts,
            impulses,
            c[MU],
            CONTACT_TOLERANCE * c[SPEED],
            velocity,
            scratch.system,
            scratch.change,
            scratch.inverse,
        )
        # the contacts enter the rotation by their arms, which depend on the mean spin: hence the passes
        difference = h * max(abs(velocity[3] - w0), abs(velocity[4] - w1), abs(velocity[5] - w2))
        w0, w1, w2 = velocity[3], velocity[4], velocity[5]
        if difference > PASS_TOLERANCE and not frozen and (not solved or turn >= FREE_PASSES):
            # impulses that do not converge stay, so that the passes converge and momentum is exact
            frozen = True
            for k in range(count):
                for i in range(3):
                    momentum[i] += impulses[k, i]
        elif difference <= PASS_TOLERANCE:
            if polished:
                converged = not frozen
                break
            # thousands of steps of a flight: one more pass leaves round-off alone of the energy
            polished = True
    for k in range(count):
        # contacts that stick hold with the friction of the step when their velocities are projected
        friction = c[MU] * impulses[k, 2]
        slides = impulses[k, 0] ** 2 + impulses[k, 1] ** 2 >= (1.0 - STICKING) * friction * friction
        contacts[k, 4] = 0.0 if slides else friction
    for i in range(3):
        # the mean velocity moves the body exactly: a contact that holds keeps its place
        trial[X + i] = y[X + i] + h * velocity[i]
        trial[V + i] = 2.0 * velocity[i] - y[V + i]
        trial[W + i] = 2.0 * (r[i] * w0 + r[3 + i] * w1 + r[6 + i] * w2) - y[W + i]
    # kept for the prediction of the next step
    trial[ALPHA], trial[ALPHA + 1], trial[ALPHA + 2] = 2.0 * (w0 - s0) / h, 2.0 * (w1 - s1) / h, 2.0 * (w2 - s2) / h
    # Cayley's map as a quaternion: (1, h w/2), normalised
    b, d, e = 0.5 * h * w0, 0.5 * h * w1, 0.5 * h * w2
    q0, q1, q2, q3 = y[Q], y[Q + 1], y[Q + 2], y[Q + 3]
    t0 = q0 - b * q1 - d * q2 - e * q3
    t1 = q1 + b * q0 + d * q3 - e * q2
    t2 = q2 + d * q0 + e * q1 - b * q3
    t3 = q3 + e * q0 + b * q2 - d * q1
    # the quaternion has the norm sqrt(1 + |h w/2|^2)
    norm = 1.0 / math.sqrt(t0 * t0 + t1 * t1 + t2 * t2 + t3 * t3)
    trial[Q], trial[Q + 1], trial[Q + 2], trial[Q + 3] = t0 * norm, t1 * norm, t2 * norm, t3 * norm
    return converged


@kernel(_t.boolean(VECTOR, _t.int64, _t.float64, _t.boolean, BODY, SCRATCH))
def _impact(y, count, restitution, holds, body, scratch):
    """Change the velocities of a state by an impact with the vertices in `ids`; return whether the solution converged.

    With `holds`, the vertices are those of the last step, and friction of the step acts on those that stick.
    """
    c, r, s = body.constants, scratch.rotation, scratch.spatial
    contacts, velocity, momentum, mass = scratch.contacts, scratch.velocity, scratch.momentum, c[MASS]
    s0 = r[0] * y[W] + r[1] * y[W + 1] + r[2] * y[W + 2]
    s1 = r[3] * y[W] + r[4] * y[W + 1] + r[5] * y[W + 2]
    s2 = r[6] * y[W] + r[7] * y[W + 1] + r[8] * y[W + 2]
    for i in range(3):
        velocity[i], momentum[i] = y[V + i], mass * y[V + i]
        momentum[3 + i] = s[3 * i] * s0 + s[3 * i + 1] * s1 + s[3 * i + 2] * s2
    velocity[3], velocity[4], velocity[5] = s0, s1, s2
    fastest = 0.0
    for k in range(count):
        i = scratch.ids[k]
        x, y_, z = body.vertices[0, i], body.vertices[1, i], body.vertices[2, i]
        contacts[k, 0] = r[0] * x + r[1] * y_ + r[2] * z
        contacts[k, 1] = r[3] * x + r[4] * y_ + r[5] * z
        contacts[k, 2] = r[6] * x + r[7] * y_ + r[8] * z
        # only an approaching vertex rebounds: a separating one needs no impulse
        approach = max(-(y[V + 2] + s0 * contacts[k, 1] - s1 * contacts[k, 0]), 0.0)
        fastest = max(fastest, approach)
        contacts[k, 3] = -restitution * approach
        if holds:
            # a vertex that has left the ground is free
            contacts[k, 3] = 0.0 if scratch.heights[i] <= c[GAP] else LARGE_SPEED
        else:
            contacts[k, 4] = 0.0
        scratch.impulses[k, 0], scratch.impulses[k, 1], scratch.impulses[k, 2] = 0.0, 0.0, 0.0
    # slow rebounds are plastic: their sequence would not end within the record
    if not holds and restitution * fastest <= BOUNCE_RATIO * c[SPEED]:
        for k in range(count):
            contacts[k, 3] = 0.0
    solved = solve_contacts(
        count,
        mass,
        s,
        momentum,
        contacts,
        scratch.impulses,
        c[MU],
        CONTACT_TOLERANCE * c[SPEED],
        velocity,
        scratch.system,
        scratch.change,
        scratch.inverse,
    )
    # back to the body's axes
    for i in range(3):
        y[V + i] = velocity[i]
        y[W + i] = r[i] * velocity[3] + r[3 + i] * velocity[4] + r[6 + i] * velocity[5]
    return solved


@kernel(_t.boolean(VECTOR, _t.int64, BODY, SCRATCH))
def end_contacts(y, count, body, scratch):
    """Project the velocities of the contacts of a step at its end; return whether the solution converged."""
    return _impact(y, count, 0.0, True, body, scratch)


@kernel(_t.boolean(VECTOR, _t.int64, BODY, SCRATCH))
def _approaches(y, count, body, scratch):
    """Return whether a vertex in `ids` approaches the ground by more than the tolerance of the contact velocities."""
    r, limit = scratch.rotation, -CONTACT_TOLERANCE * body.constants[SPEED]
    # vertical velocity v_z + (R W x R X)_z = v_z + (row of R) . (W x X)
    for k in range(count):
        i = scratch.ids[k]
        x, y_, z = body.vertices[0, i], body.vertices[1, i], body.vertices[2, i]
        turning = r[6] * (y[W + 1] * z - y[W + 2] * y_) + r[7] * (y[W + 2] * x - y[W] * z) + r[8] * (y[W] * y_ - y[W + 1] * x)
        if y[V + 2] + turning < limit:
            return True
    return False


@kernel(_t.boolean(VECTOR, _t.int64, _t.boolean, BODY, SCRATCH))
def resolve_impact(y, count, struck, body, scratch):
    """Resolve an impact of the vertices in `ids`, plastic unless one `struck`; overwrite `trial`; return whether it converged.

    The energetic condition decides where Newton's law with friction would create energy: the restitution is halved until it does not, and
    the plastic impact never does ([Moreau1988]_).
    """
    if not _approaches(y, count, body, scratch):
        return True
    restitution = body.constants[RESTITUTION] if struck else 0.0
    if restitution == 0.0:
        return _impact(y, count, 0.0, False, body, scratch)
    # `trial` is free between steps and holds the velocities before the impact
    before = scratch.trial
    for i in range(STATE_SIZE):
        before[i] = y[i]
    energy = mechanical_energy(y, body)
    for attempt in range(6):
        solved = _impact(y, count, restitution, False, body, scratch)
        if mechanical_energy(y, body) <= energy or restitution == 0.0:
            break
        for i in range(STATE_SIZE):
            y[i] = before[i]
        restitution = 0.5 * restitution if attempt < 4 else 0.0
    return solved
