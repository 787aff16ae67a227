"""Spring, dashpot and slider at one contact point and at the n x n points of a joint ([Furukawa2009]_ section 3(1)).

A pair of boxes is described in the axes of the *partner*, from its centre; the other box, the *carrier*, carries the contact points. A
point at depth delta inside the partner is pushed out by spring and dashpot, f = k (delta - delta_0) + c delta', and never pulled;
along the face a spring and a dashpot in parallel act in series with a slider of strength mu f ([Furukawa2009]_ section 3(1), table 2).
The slider is integrated implicitly, so that friction never creates energy. delta_0 is zero in a joint; for new contacts it is the depth
at the first step, so that the force starts from zero.

A point that leaves the partner's face is released, and contacts of edges and corners take over. Points at the corners of a flush joint
would be released at every slip and return deeper than they left, which creates energy. They are therefore clamped to the face's border,
like the corners of the shared area, while the faces overlap. There the border presses on the carrier's face along the face's normal;
the depth is measured along it, since a tilted stone would otherwise gain energy while it slides.

Points of a joint are grouped in orbits of four mirror images, whose forces are summed in pairs: mirrored piles move as exact mirror images.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import BLOCK, MATRIX, VECTOR

_t = types()

REL_S, REL_D, REL_V, REL_W = 0, 9, 12, 15
"""Columns of a relative state: the carrier's axes (row-major), its centre, its velocity there, and its relative spin."""

RELATIVE = 18
NORMAL_SPRING, NORMAL_DASHPOT, SHEAR_SPRING, SHEAR_DASHPOT, FRICTION, CLAMP_TO_EDGE, KINETIC, RESTITUTION = range(8)
FORCE, TORQUE, ENERGY, N_IN_CONTACT, OUTSIDE = 0, 3, 6, 7, 8
SUM = 9
"""A sum over contact points: force (3) and torque (3) on the carrier, spring energy, points in contact, points beyond the face."""

STRETCH, INITIAL_DEPTH, ALIVE, FACE, LAST_DEPTH = 0, 3, 4, 5, 6
"""Memory of a spring contact: stretch of its shear spring (3), initial depth, 1 while it exists, its face, last depth."""

CACHED_FORCE, CACHED_SLIDING, ACTIVE, POSITION, PREVIOUS_FORCE = 0, 3, 7, 8, 14
SLOT = 17
"""Memory of a rigid contact (warm start): last force (3), 1 if it slid, 1 if it was solved; position and normal in the partner's axes;
force before the last (3)."""

DEPTH_TOLERANCE = 1e-6
"""Change of a depth in a step, m, tolerated beyond that explained by the velocities."""


@kernel(_t.boolean(VECTOR, VECTOR, VECTOR), inline=True)
def joint_faces_overlap(rel, carrier_half, partner_half):
    """Return whether the two faces of a joint still overlap in plan."""
    x, y = abs(rel[0]) * carrier_half[0] + abs(rel[1]) * carrier_half[1], abs(rel[3]) * carrier_half[0] + abs(rel[4]) * carrier_half[1]
    return abs(rel[REL_D]) < partner_half[0] + x and abs(rel[REL_D + 1]) < partner_half[1] + y


@kernel(_t.int64(_t.int64, VECTOR, BLOCK, _t.float64, VECTOR, VECTOR, _t.float64, VECTOR, _t.float64, _t.float64, BLOCK, MATRIX, VECTOR))
def add_joint_forces(n_orbits, rel, points, sigma, carrier_half, partner_half, level, k, is_engaged, dt, stretch, orbit, total):
    """Add the forces at the points of a joint; return the number of points in contact ([Furukawa2009]_ section 3(1)).

    Parameters
    ----------
    rel : (18,) array
        State of the carrier in the partner's axes.
    points : (orbits, 4, 3) array, m
        x and y of each point on the carrier's face, and 1 where a point exists.
    sigma : float
        -1 if the carrier's lower face stands on the partner's upper face, +1 for the reverse.
    carrier_half, partner_half, level : (3,) array, (3,) array, float, m
        Half sizes of the carrier and of the partner; z of the carrier's face in its own axes.
    k : (6,) array
        Normal spring, normal dashpot, shear spring, shear dashpot, friction, per point; and 1 if points are clamped to the face's border.
    is_engaged : float
        1, or 0 if the joint no longer acts, which resets all stretches.
    stretch : (orbits, 4, 2) array, m
        Stretch of the shear springs.
    orbit : (4, 9) array
        Scratch.
    total : (9,) array
        Sum on the carrier, in the partner's axes, about the carrier's centre.
    """
    kn, cn, kt, ct, mu = k[0], k[1], k[2], k[3], k[4]
    # force per shear velocity over an implicit step
    shear_impedance = kt * dt + ct
    a00, a01, a02 = rel[0], rel[1], rel[2] * level
    a10, a11, a12 = rel[3], rel[4], rel[5] * level
    a20, a21, a22 = rel[6], rel[7], rel[8] * level
    d0, d1, d2 = rel[9], rel[10], rel[11]
    v0, v1, v2 = rel[12], rel[13], rel[14]
    w0, w1, w2 = rel[15], rel[16], rel[17]
    # a joint whose faces no longer overlap has no border to hold the points
    clamp = k[CLAMP_TO_EDGE] > 0.0 and joint_faces_overlap(rel, carrier_half, partner_half)
    for o in range(n_orbits):
        for q in range(4):
            f0 = 0.0
            f1 = 0.0
            f2 = 0.0
            s0 = 0.0
            s1 = 0.0
            s2 = 0.0
            energy = 0.0
            in_contact = 0.0
            is_outside = 0.0
            depth = 0.0
            n0 = 0.0
            n1 = 0.0
            n2 = 1.0
            if points[o, q, 2] > 0.0:
                rx, ry = points[o, q, 0], points[o, q, 1]
                s2 = a20 * rx + a21 * ry + a22
                # positive inside the partner
                depth = partner_half[2] + sigma * (d2 + s2)
                if is_engaged > 0.0:
                    s0 = a00 * rx + a01 * ry + a02
                    s1 = a10 * rx + a11 * ry + a12
                    if clamp and (abs(d0 + s0) > partner_half[0] or abs(d1 + s1) > partner_half[1]):
                        # move the point back to the border of the partner's face, in the carrier's axes
                        excess0 = d0 + s0 - min(max(d0 + s0, -partner_half[0]), partner_half[0])
                        excess1 = d1 + s1 - min(max(d1 + s1, -partner_half[1]), partner_half[1])
                        rx -= a00 * excess0 + a10 * excess1
                        ry -= a01 * excess0 + a11 * excess1
                        s0 = a00 * rx + a01 * ry + a02
                        s1 = a10 * rx + a11 * ry + a12
                        s2 = a20 * rx + a21 * ry + a22
                        n0, n1, n2 = rel[2], rel[5], rel[8]
                        depth = (partner_half[2] + sigma * (d2 + s2)) * n2
                    elif abs(d0 + s0) > partner_half[0] or abs(d1 + s1) > partner_half[1]:
                        is_outside = 1.0
                    if is_outside == 0.0 and depth > 0.0:
                        # the dashpot acts on the rate of the depth along the normal
                        f2 = kn * depth + cn * sigma * n2 * (v2 + w0 * s1 - w1 * s0)
                        if n2 < 1.0:
                            f2 += cn * sigma * (n0 * (v0 + w1 * s2 - w2 * s1) + n1 * (v1 + w2 * s0 - w0 * s2))
                # no tension: where the dashpot outweighs the spring in a separation, nothing is carried
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
                        # the slider yields: the stretch that remains under the limiting force
                        # from f = kt e' + ct (e' - e)/dt, solved for the stretch e'
                        e0 = (f0 * dt + ct * e0) / shear_impedance
                        e1 = (f1 * dt + ct * e1) / shear_impedance
                    else:
                        e0 += u0 * dt
                        e1 += u1 * dt
                    stretch[o, q, 0] = e0
                    stretch[o, q, 1] = e1
                    energy = 0.5 * (kn * depth * depth + kt * (e0 * e0 + e1 * e1))
                    in_contact = 1.0
                    f0 = -f0 - sigma * n0 * f2
                    f1 = -f1 - sigma * n1 * f2
                    f2 *= -sigma * n2
                else:
                    f2 = 0.0
                    stretch[o, q, 0] = 0.0
                    stretch[o, q, 1] = 0.0
                    if is_engaged > 0.0 and depth > 0.0 and is_outside == 0.0:
                        energy = 0.5 * kn * depth * depth
            orbit[q, 0] = f0
            orbit[q, 1] = f1
            orbit[q, 2] = f2
            orbit[q, 3] = s1 * f2 - s2 * f1
            orbit[q, 4] = s2 * f0 - s0 * f2
            orbit[q, 5] = s0 * f1 - s1 * f0
            orbit[q, 6] = energy
            orbit[q, 7] = in_contact
            orbit[q, 8] = is_outside
        for i in range(SUM):
            # sums in mirrored pairs are bit-identical for mirrored piles; floating-point addition is not associative
            total[i] += (orbit[0, i] + orbit[1, i]) + (orbit[2, i] + orbit[3, i])
    return int(total[N_IN_CONTACT])


@kernel(_t.float64(VECTOR, VECTOR, _t.float64, VECTOR, VECTOR, _t.float64, VECTOR, VECTOR))
def add_point_force(rel, y, depth, normal, k, dt, slot, total):
    """Add the force at one free contact point ([Furukawa2009]_ section 3(1)); return the normal force, N.

    The point is at `y` in the partner's axes, `depth` inside along `normal`, which points out of the partner.
    """
    if depth <= 0.0:
        # separation ends the contact, and with it the stretch of its springs
        slot[ALIVE] = 0.0
        return 0.0
    # the force starts from zero, wherever the step finds the point: a depth given at once would create energy
    if slot[ALIVE] == 0.0:
        slot[ALIVE] = 1.0
        slot[INITIAL_DEPTH] = depth
        slot[LAST_DEPTH] = depth
        slot[0] = 0.0
        slot[1] = 0.0
        slot[2] = 0.0
    kn, cn, kt, ct, mu = k[0], k[1], k[2], k[3], k[4]
    n0, n1, n2 = normal[0], normal[1], normal[2]
    s0, s1, s2 = y[0] - rel[9], y[1] - rel[10], y[2] - rel[11]
    u0 = rel[12] + rel[16] * s2 - rel[17] * s1
    u1 = rel[13] + rel[17] * s0 - rel[15] * s2
    u2 = rel[14] + rel[15] * s1 - rel[16] * s0
    separation_speed = u0 * n0 + u1 * n1 + u2 * n2
    depth_change = depth - slot[LAST_DEPTH]
    if abs(depth_change) > dt * math.sqrt(u0 * u0 + u1 * u1 + u2 * u2) + DEPTH_TOLERANCE:
        # the contact has changed to another face or edge: the compression continues from the velocity
        slot[INITIAL_DEPTH] += depth_change + separation_speed * dt
    slot[LAST_DEPTH] = depth
    # a contact that started deep gives up its offset as the stones separate
    slot[INITIAL_DEPTH] = min(slot[INITIAL_DEPTH], depth)
    compression = depth - slot[INITIAL_DEPTH]
    normal_force = kn * compression - cn * separation_speed
    # no tension, although dashpot and spring together would pull
    if normal_force <= 0.0:
        slot[0] = 0.0
        slot[1] = 0.0
        slot[2] = 0.0
        total[ENERGY] += 0.5 * kn * compression * compression
        return 0.0
    u0 -= separation_speed * n0
    u1 -= separation_speed * n1
    u2 -= separation_speed * n2
    # the normal may have turned since the last step: only the tangential part of the stretch remains
    normal_stretch = slot[0] * n0 + slot[1] * n1 + slot[2] * n2
    e0, e1, e2 = slot[0] - normal_stretch * n0, slot[1] - normal_stretch * n1, slot[2] - normal_stretch * n2
    f0 = kt * (e0 + u0 * dt) + ct * u0
    f1 = kt * (e1 + u1 * dt) + ct * u1
    f2 = kt * (e2 + u2 * dt) + ct * u2
    size = math.sqrt(f0 * f0 + f1 * f1 + f2 * f2)
    if size > mu * normal_force:
        ratio = mu * normal_force / size
        f0 *= ratio
        f1 *= ratio
        f2 *= ratio
        # the slider yields, as in a joint
        shear_impedance = kt * dt + ct
        e0 = (f0 * dt + ct * e0) / shear_impedance
        e1 = (f1 * dt + ct * e1) / shear_impedance
        e2 = (f2 * dt + ct * e2) / shear_impedance
    else:
        e0 += u0 * dt
        e1 += u1 * dt
        e2 += u2 * dt
    slot[0] = e0
    slot[1] = e1
    slot[2] = e2
    f0 = normal_force * n0 - f0
    f1 = normal_force * n1 - f1
    f2 = normal_force * n2 - f2
    total[0] += f0
    total[1] += f1
    total[2] += f2
    total[3] += s1 * f2 - s2 * f1
    total[4] += s2 * f0 - s0 * f2
    total[5] += s0 * f1 - s1 * f0
    total[ENERGY] += 0.5 * (kn * compression * compression + kt * (e0 * e0 + e1 * e1 + e2 * e2))
    total[N_IN_CONTACT] += 1.0
    return normal_force
