"""What two stones do to each other at one point, and at the n x n points of the joint between them.

A pair of boxes is seen from the *partner*: its axes, its centre. The other box, the *carrier*, brings the contact points.
A point that has gone a depth delta into the partner is pushed out by a spring and a dashpot, f = k (delta - delta_0) + c delta', and never
pulled; along the face it drags a spring beside a dashpot, in series with a slider that gives way at mu f ([Furukawa2009]_ section 3(1),
table 2). The slider's law is solved implicitly over the step, so that friction never creates energy. delta_0 is zero in a joint; where
stones meet anew it is the depth at the first step, so that a contact is born without a force.

A point that leaves the partner's face lets go, and edges and corners take over. Points at the very corners of a joint would do so at
every slip of stones that lie flush, and come back deeper than they went, with energy from nowhere; they cling to the face's border
instead, as the corners of what two faces share do, while the faces share anything. There the border presses on the carrier's face, along
its normal: the depth is measured along it, or a tilted stone would gain energy as it slides.

Points of a joint come in orbits of four mirror images, whose forces are added in pairs: a mirrored pile moves in exact mirror image.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import BLOCK, MATRIX, VECTOR

_t = types()

REL_S, REL_D, REL_V, REL_W = 0, 9, 12, 15
"""Where a relative state keeps the carrier's axes (row-major), its centre, its velocity there, and its relative spin."""

RELATIVE = 18
NORMAL_SPRING, NORMAL_DASHPOT, SHEAR_SPRING, SHEAR_DASHPOT, FRICTION, CLINGS, KINETIC, REBOUND = range(8)
FORCE, TORQUE, ENERGY, TOUCHING, OUTSIDE = 0, 3, 6, 7, 8
SUM = 9
"""A sum over contact points: force (3) and torque (3) on the carrier, spring energy, points in touch, points beyond the face."""

STRETCH, BIRTH, ALIVE, FACE, LAST = 0, 3, 4, 5, 6
"""What a wandering contact remembers: stretch of its shear spring (3), depth at birth, whether it lives, the face it is on, last depth."""

PUSH, SLIDES, ENTERED, PLACE, EARLIER = 0, 3, 7, 8, 14
SLOT = 17
"""What a rigid one does instead: the last force (3), whether it slid, whether it was solved; place and normal in the partner's axes;
and the force before (3)."""

ROUNDING = 1e-6
"""How much, m, a depth may change in a step beyond what the velocities explain."""


@kernel(_t.boolean(VECTOR, VECTOR, VECTOR), inline=True)
def share(rel, own, half):
    """Whether two faces still lie over each other."""
    x, y = abs(rel[0]) * own[0] + abs(rel[1]) * own[1], abs(rel[3]) * own[0] + abs(rel[4]) * own[1]
    return abs(rel[REL_D]) < half[0] + x and abs(rel[REL_D + 1]) < half[1] + y


@kernel(_t.int64(_t.int64, VECTOR, BLOCK, _t.float64, VECTOR, VECTOR, _t.float64, VECTOR, _t.float64, _t.float64, BLOCK, MATRIX, VECTOR))
def press_joint(n_orbits, rel, points, sigma, own, half, level, k, load, dt, stretch, four, total):
    """Sum the forces at the points of a joint ([Furukawa2009]_).

    Parameters
    ----------
    rel : (18,) array
        The carrier as the partner sees it.
    points : (orbits, 4, 3) array, m
        x and y of each point on the carrier's face, and 1 where there is a point.
    sigma : float
        -1 where the carrier's lower face stands on the partner's upper one, +1 the other way round.
    own, half, level : (3,) array, (3,) array, float, m
        Half sizes of the carrier and of the partner; z of the carrier's face in its own axes.
    k : (6,) array
        Normal spring, normal dashpot, shear spring, shear dashpot, friction, per point; and 1 where points cling to the face's border.
    load : float
        1, or 0 to forget all stretches (the joint no longer acts).
    stretch : (orbits, 4, 2) array, m
        The memory of the shear springs.
    four : (4, 9) array
        Scratch.
    total : (9,) array
        The sum, on the carrier, in the partner's axes, about the carrier's centre.

    Returns
    -------
    int
        How many points are in touch.
    """
    kn, cn, kt, ct, mu = k[0], k[1], k[2], k[3], k[4]
    soft = kt * dt + ct
    a00, a01, a02 = rel[0], rel[1], rel[2] * level
    a10, a11, a12 = rel[3], rel[4], rel[5] * level
    a20, a21, a22 = rel[6], rel[7], rel[8] * level
    d0, d1, d2 = rel[9], rel[10], rel[11]
    v0, v1, v2 = rel[12], rel[13], rel[14]
    w0, w1, w2 = rel[15], rel[16], rel[17]
    clings = k[CLINGS] > 0.0 and share(rel, own, half)
    for o in range(n_orbits):
        for q in range(4):
            f0 = 0.0
            f1 = 0.0
            f2 = 0.0
            s0 = 0.0
            s1 = 0.0
            s2 = 0.0
            energy = 0.0
            touching = 0.0
            outside = 0.0
            depth = 0.0
            n0 = 0.0
            n1 = 0.0
            n2 = 1.0
            if points[o, q, 2] > 0.0:
                rx, ry = points[o, q, 0], points[o, q, 1]
                s2 = a20 * rx + a21 * ry + a22
                depth = half[2] + sigma * (d2 + s2)
                if load > 0.0:
                    s0 = a00 * rx + a01 * ry + a02
                    s1 = a10 * rx + a11 * ry + a12
                    if clings and (abs(d0 + s0) > half[0] or abs(d1 + s1) > half[1]):
                        over0 = d0 + s0 - min(max(d0 + s0, -half[0]), half[0])
                        over1 = d1 + s1 - min(max(d1 + s1, -half[1]), half[1])
                        rx -= a00 * over0 + a10 * over1
                        ry -= a01 * over0 + a11 * over1
                        s0 = a00 * rx + a01 * ry + a02
                        s1 = a10 * rx + a11 * ry + a12
                        s2 = a20 * rx + a21 * ry + a22
                        n0, n1, n2 = rel[2], rel[5], rel[8]
                        depth = (half[2] + sigma * (d2 + s2)) * n2
                    elif abs(d0 + s0) > half[0] or abs(d1 + s1) > half[1]:
                        outside = 1.0
                    if outside == 0.0 and depth > 0.0:
                        f2 = kn * depth + cn * sigma * n2 * (v2 + w0 * s1 - w1 * s0)
                        if n2 < 1.0:
                            f2 += cn * sigma * (n0 * (v0 + w1 * s2 - w2 * s1) + n1 * (v1 + w2 * s0 - w0 * s2))
                if f2 > 0.0:
                    u0 = v0 + w1 * s2 - w2 * s1
                    u1 = v1 + w2 * s0 - w0 * s2
                    e0, e1 = stretch[o, q, 0], stretch[o, q, 1]
                    f0 = kt * (e0 + u0 * dt) + ct * u0
                    f1 = kt * (e1 + u1 * dt) + ct * u1
                    size = math.sqrt(f0 * f0 + f1 * f1)
                    if size > mu * f2:
                        f0 *= mu * f2 / size
                        f1 *= mu * f2 / size
                        e0 = (f0 * dt + ct * e0) / soft
                        e1 = (f1 * dt + ct * e1) / soft
                    else:
                        e0 += u0 * dt
                        e1 += u1 * dt
                    stretch[o, q, 0] = e0
                    stretch[o, q, 1] = e1
                    energy = 0.5 * (kn * depth * depth + kt * (e0 * e0 + e1 * e1))
                    touching = 1.0
                    f0 = -f0 - sigma * n0 * f2
                    f1 = -f1 - sigma * n1 * f2
                    f2 *= -sigma * n2
                else:
                    f2 = 0.0
                    stretch[o, q, 0] = 0.0
                    stretch[o, q, 1] = 0.0
                    if load > 0.0 and depth > 0.0 and outside == 0.0:
                        energy = 0.5 * kn * depth * depth
            four[q, 0] = f0
            four[q, 1] = f1
            four[q, 2] = f2
            four[q, 3] = s1 * f2 - s2 * f1
            four[q, 4] = s2 * f0 - s0 * f2
            four[q, 5] = s0 * f1 - s1 * f0
            four[q, 6] = energy
            four[q, 7] = touching
            four[q, 8] = outside
        for i in range(SUM):
            total[i] += (four[0, i] + four[1, i]) + (four[2, i] + four[3, i])
    return int(total[TOUCHING])


@kernel(_t.float64(VECTOR, VECTOR, _t.float64, VECTOR, VECTOR, _t.float64, VECTOR, VECTOR))
def touch(rel, y, depth, normal, k, dt, slot, total):
    """Add the force at one wandering contact point ([Furukawa2009]_); return the normal force.

    The point is at `y` in the partner's axes, `depth` inside along `normal`, which points out of the partner.
    """
    if depth <= 0.0:
        slot[ALIVE] = 0.0
        return 0.0
    if slot[ALIVE] == 0.0:
        slot[ALIVE] = 1.0
        slot[BIRTH] = depth
        slot[LAST] = depth
        slot[0] = 0.0
        slot[1] = 0.0
        slot[2] = 0.0
    kn, cn, kt, ct, mu = k[0], k[1], k[2], k[3], k[4]
    n0, n1, n2 = normal[0], normal[1], normal[2]
    s0, s1, s2 = y[0] - rel[9], y[1] - rel[10], y[2] - rel[11]
    u0 = rel[12] + rel[16] * s2 - rel[17] * s1
    u1 = rel[13] + rel[17] * s0 - rel[15] * s2
    u2 = rel[14] + rel[15] * s1 - rel[16] * s0
    out = u0 * n0 + u1 * n1 + u2 * n2
    jump = depth - slot[LAST]
    if abs(jump) > dt * math.sqrt(u0 * u0 + u1 * u1 + u2 * u2) + ROUNDING:
        # the contact went over to another face or edge: its squeeze goes on as the velocity says
        slot[BIRTH] += jump + out * dt
    slot[LAST] = depth
    # a contact born deep forgets its birth as the stones part
    slot[BIRTH] = min(slot[BIRTH], depth)
    squeezed = depth - slot[BIRTH]
    press = kn * squeezed - cn * out
    if press <= 0.0:
        slot[0] = 0.0
        slot[1] = 0.0
        slot[2] = 0.0
        total[ENERGY] += 0.5 * kn * squeezed * squeezed
        return 0.0
    u0 -= out * n0
    u1 -= out * n1
    u2 -= out * n2
    along = slot[0] * n0 + slot[1] * n1 + slot[2] * n2
    e0, e1, e2 = slot[0] - along * n0, slot[1] - along * n1, slot[2] - along * n2
    f0 = kt * (e0 + u0 * dt) + ct * u0
    f1 = kt * (e1 + u1 * dt) + ct * u1
    f2 = kt * (e2 + u2 * dt) + ct * u2
    size = math.sqrt(f0 * f0 + f1 * f1 + f2 * f2)
    if size > mu * press:
        ratio = mu * press / size
        f0 *= ratio
        f1 *= ratio
        f2 *= ratio
        soft = kt * dt + ct
        e0 = (f0 * dt + ct * e0) / soft
        e1 = (f1 * dt + ct * e1) / soft
        e2 = (f2 * dt + ct * e2) / soft
    else:
        e0 += u0 * dt
        e1 += u1 * dt
        e2 += u2 * dt
    slot[0] = e0
    slot[1] = e1
    slot[2] = e2
    f0 = press * n0 - f0
    f1 = press * n1 - f1
    f2 = press * n2 - f2
    total[0] += f0
    total[1] += f1
    total[2] += f2
    total[3] += s1 * f2 - s2 * f1
    total[4] += s2 * f0 - s0 * f2
    total[5] += s0 * f1 - s1 * f0
    total[ENERGY] += 0.5 * (kn * squeezed * squeezed + kt * (e0 * e0 + e1 * e1 + e2 * e2))
    total[TOUCHING] += 1.0
    return press
