"""Columns of bodies, inertias and boxes; rotation and relative state of two boxes.

Stones are rigid bodies of one or more boxes (stones joined by dowels are one body); the ground is one more body that never moves. The
axes are those of the ground, which shakes without rotation: positions and velocities are relative to it.
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import INTEGERS, MATRIX, VECTOR

_t = types()

X, Q, V, L, W, R, F, T = 0, 3, 7, 10, 13, 16, 25, 28
BODY = 31
"""A body's row: centre (3), quaternion (4), velocity (3), angular momentum (3), spin (3), rotation matrix (9), force (3), torque (3)."""

MASS, INERTIA, INVERSE = 0, 1, 10
INERTIA_COLUMNS = 19
"""A body's constants: mass, inertia matrix (9) and its inverse (9), in its own axes about its centre."""

HALF, BOX_CENTRE = 0, 3
BOX = 6
"""A box's constants: half sizes (3), centre in its body's axes (3)."""


@kernel(_t.void(VECTOR), inline=True)
def update_rotation_matrix(b):
    """Write a body's rotation matrix from its quaternion (w, x, y, z)."""
    w, x, y, z = b[Q], b[Q + 1], b[Q + 2], b[Q + 3]
    b[R] = 1.0 - 2.0 * (y * y + z * z)
    b[R + 1] = 2.0 * (x * y - w * z)
    b[R + 2] = 2.0 * (x * z + w * y)
    b[R + 3] = 2.0 * (x * y + w * z)
    b[R + 4] = 1.0 - 2.0 * (x * x + z * z)
    b[R + 5] = 2.0 * (y * z - w * x)
    b[R + 6] = 2.0 * (x * z - w * y)
    b[R + 7] = 2.0 * (y * z + w * x)
    b[R + 8] = 1.0 - 2.0 * (x * x + y * y)


@kernel(_t.void(VECTOR, VECTOR), inline=True)
def update_spin(b, inertia):
    """Write a body's spin from its angular momentum and its rotation matrix."""
    # into the body's axes, where the inverse inertia is constant, and back
    l0 = b[R] * b[L] + b[R + 3] * b[L + 1] + b[R + 6] * b[L + 2]
    l1 = b[R + 1] * b[L] + b[R + 4] * b[L + 1] + b[R + 7] * b[L + 2]
    l2 = b[R + 2] * b[L] + b[R + 5] * b[L + 1] + b[R + 8] * b[L + 2]
    j = INVERSE
    w0 = inertia[j] * l0 + inertia[j + 1] * l1 + inertia[j + 2] * l2
    w1 = inertia[j + 3] * l0 + inertia[j + 4] * l1 + inertia[j + 5] * l2
    w2 = inertia[j + 6] * l0 + inertia[j + 7] * l1 + inertia[j + 8] * l2
    b[W] = b[R] * w0 + b[R + 1] * w1 + b[R + 2] * w2
    b[W + 1] = b[R + 3] * w0 + b[R + 4] * w1 + b[R + 5] * w2
    b[W + 2] = b[R + 6] * w0 + b[R + 7] * w1 + b[R + 8] * w2


@kernel(_t.void(VECTOR, _t.float64), inline=True)
def rotate(b, dt):
    """Rotate a body's quaternion by its spin over a step (Cayley's form, normalised)."""
    w, x, y, z = b[Q], b[Q + 1], b[Q + 2], b[Q + 3]
    h = 0.5 * dt
    p0, p1, p2 = h * b[W], h * b[W + 1], h * b[W + 2]
    # (1 + w dt / 2) q: a rotation by 2 atan(|w| dt / 2) once normalised
    b[Q] = w - (p0 * x + p1 * y + p2 * z)
    b[Q + 1] = x + (p0 * w + (p1 * z - p2 * y))
    b[Q + 2] = y + (p1 * w + (p2 * x - p0 * z))
    b[Q + 3] = z + (p2 * w + (p0 * y - p1 * x))
    size = (b[Q] * b[Q] + b[Q + 1] * b[Q + 1] + b[Q + 2] * b[Q + 2] + b[Q + 3] * b[Q + 3]) ** 0.5
    for i in range(Q, Q + 4):
        b[i] /= size


@kernel(_t.void(VECTOR, VECTOR, VECTOR), inline=True)
def box_offset(b, box, r):
    """Write the offset of a box's centre from its body's centre, in the ground's axes, m."""
    a0, a1, a2 = box[BOX_CENTRE], box[BOX_CENTRE + 1], box[BOX_CENTRE + 2]
    if a0 == 0.0 and a1 == 0.0 and a2 == 0.0:
        r[0] = 0.0
        r[1] = 0.0
        r[2] = 0.0
        return
    r[0] = b[R] * a0 + b[R + 1] * a1 + b[R + 2] * a2
    r[1] = b[R + 3] * a0 + b[R + 4] * a1 + b[R + 5] * a2
    r[2] = b[R + 6] * a0 + b[R + 7] * a1 + b[R + 8] * a2


@kernel(_t.void(_t.int64, _t.int64, MATRIX, MATRIX, INTEGERS, MATRIX, VECTOR))
def relative_state(carrier, partner, bodies, boxes, owner, arms, rel):
    """Write the state of the carrier in the partner's axes: axes, centre, velocity there and relative spin."""
    c = bodies[owner[carrier]]
    p = bodies[owner[partner]]
    rc, rp = arms[0], arms[1]
    box_offset(c, boxes[carrier], rc)
    box_offset(p, boxes[partner], rp)
    for i in range(3):
        for j in range(3):
            rel[3 * i + j] = p[R + i] * c[R + j] + p[R + 3 + i] * c[R + 3 + j] + p[R + 6 + i] * c[R + 6 + j]
    # from the partner's body to the carrier box, then from the partner box
    e0, e1, e2 = c[X] - p[X] + rc[0], c[X + 1] - p[X + 1] + rc[1], c[X + 2] - p[X + 2] + rc[2]
    d0, d1, d2 = e0 - rp[0], e1 - rp[1], e2 - rp[2]
    # velocity relative to the partner's material at the same place, hence the partner's spin with the arm e
    u0 = c[V] - p[V] + (c[W + 1] * rc[2] - c[W + 2] * rc[1]) - (p[W + 1] * e2 - p[W + 2] * e1)
    u1 = c[V + 1] - p[V + 1] + (c[W + 2] * rc[0] - c[W] * rc[2]) - (p[W + 2] * e0 - p[W] * e2)
    u2 = c[V + 2] - p[V + 2] + (c[W] * rc[1] - c[W + 1] * rc[0]) - (p[W] * e1 - p[W + 1] * e0)
    s0, s1, s2 = c[W] - p[W], c[W + 1] - p[W + 1], c[W + 2] - p[W + 2]
    for i in range(3):
        rel[9 + i] = p[R + i] * d0 + p[R + 3 + i] * d1 + p[R + 6 + i] * d2
        rel[12 + i] = p[R + i] * u0 + p[R + 3 + i] * u1 + p[R + 6 + i] * u2
        rel[15 + i] = p[R + i] * s0 + p[R + 3 + i] * s1 + p[R + 6 + i] * s2


@kernel(_t.void(VECTOR, VECTOR, MATRIX, VECTOR))
def apply_contact_force(c, p, arms, total):
    """Add a sum of contact forces to the carrier's body and its opposite to the partner's; zero the sum."""
    f0 = p[R] * total[0] + p[R + 1] * total[1] + p[R + 2] * total[2]
    f1 = p[R + 3] * total[0] + p[R + 4] * total[1] + p[R + 5] * total[2]
    f2 = p[R + 6] * total[0] + p[R + 7] * total[1] + p[R + 8] * total[2]
    t0 = p[R] * total[3] + p[R + 1] * total[4] + p[R + 2] * total[5]
    t1 = p[R + 3] * total[3] + p[R + 4] * total[4] + p[R + 5] * total[5]
    t2 = p[R + 6] * total[3] + p[R + 7] * total[4] + p[R + 8] * total[5]
    r0, r1, r2 = arms[0, 0], arms[0, 1], arms[0, 2]
    c[F] += f0
    c[F + 1] += f1
    c[F + 2] += f2
    c[T] += t0 + (r1 * f2 - r2 * f1)
    c[T + 1] += t1 + (r2 * f0 - r0 * f2)
    c[T + 2] += t2 + (r0 * f1 - r1 * f0)
    # the opposite force acts at the same point: arm from the partner's centre
    r0 += c[X] - p[X]
    r1 += c[X + 1] - p[X + 1]
    r2 += c[X + 2] - p[X + 2]
    p[F] -= f0
    p[F + 1] -= f1
    p[F + 2] -= f2
    p[T] -= t0 + (r1 * f2 - r2 * f1)
    p[T + 1] -= t1 + (r2 * f0 - r0 * f2)
    p[T + 2] -= t2 + (r0 * f1 - r1 * f0)
    for i in range(6):
        total[i] = 0.0
