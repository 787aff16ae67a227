"""Contact points of cylinders: lowest point of the rim, points a quarter turn from it, rolling of the contact point.

A rim has no corners. Its lowest point follows exactly from the lean: u, perpendicular to the stone's axis a and opposite to the normal n,

    u = -(n - (n.a) a) / |n - (n.a) a|   (derived here).

The point moves round the stone as the stone wobbles or rolls, at s = R (u' - w x u) relative to its material (derived here). A rolling
point is required to be at rest half a step later, at its position then, so that rolling and spinning conserve energy. Points a quarter
turn and half a turn away support a stone that stands flat; it never pivots about them, since any lean moves the lowest point. Without a
lean the lowest point is placed on the side of the resultant of the contact forces, towards which the stone will tip.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.models.stack.constraint_row import NORMAL, RIM_AXIS, RIM_RADIUS, SIMULTANEITY_WINDOW
from seisblock.models.stack.frames import R
from seisblock.models.stack.spring_contact import ACTIVE, CACHED_FORCE, POSITION, REL_D
from seisblock.models.stack.step import MIN_FACING_COSINE, MIN_JOINT_HEIGHT_RATIO

_t = types()

RIM_SIMULTANEITY = 1e-4
"""Share of a step within which the points of a leaning rim strike simultaneously."""

RIMS = 4
RADIUS, HEIGHT = 0, 1
"""Columns of a bounding circle of a cylinder: radius and height, m."""

FLAT_SINE_SQUARED = 1e-10
"""Squared sine of the lean below which its direction is undefined and the contact forces decide."""

CENTRED_RATIO = 0.05
"""Eccentricity of the contact forces, over the radius, below which they have no direction."""

MAX_HALF_STEP_ANGLE = 0.5
"""Angle, rad, by which the lowest point may move round the stone in half a step and still be predicted."""

MAX_STEP_ANGLE = 0.125
"""Angle, rad, by which the lowest point may move round the stone in a step: contact is tested at four points of the rim only."""


@kernel(_t.float64(_t.float64, _t.float64, _t.float64, MATRIX), inline=True)
def lowest_rim_point(n0, n1, n2, axes):
    """Write the directions of the lowest point of a rim and of the point a quarter turn from it; return the sine of the lean.

    Parameters
    ----------
    n0, n1, n2 : float
        Upward normal.
    axes : (4, 18) array
        Axis of the stone, fallback direction without a lean, and the two resulting directions.
    """
    a, x, u, w = axes[0], axes[1], axes[2], axes[3]
    projection = n0 * a[0] + n1 * a[1] + n2 * a[2]
    # component of the normal across the axis: as long as the sine of the lean; the lowest point lies opposite to it
    m0, m1, m2 = n0 - projection * a[0], n1 - projection * a[1], n2 - projection * a[2]
    square = m0 * m0 + m1 * m1 + m2 * m2
    sine = math.sqrt(square)
    if square < FLAT_SINE_SQUARED:
        # no lean: use the fallback direction, projected onto the face
        projection = x[0] * a[0] + x[1] * a[1] + x[2] * a[2]
        m0, m1, m2 = x[0] - projection * a[0], x[1] - projection * a[1], x[2] - projection * a[2]
        size = math.sqrt(m0 * m0 + m1 * m1 + m2 * m2)
        u[0], u[1], u[2] = m0 / size, m1 / size, m2 / size
        sine = 0.0
    else:
        u[0], u[1], u[2] = -m0 / sine, -m1 / sine, -m2 / sine
    w[0] = a[1] * u[2] - a[2] * u[1]
    w[1] = a[2] * u[0] - a[0] * u[2]
    w[2] = a[0] * u[1] - a[1] * u[0]
    return sine


@kernel(_t.void(MATRIX, VECTOR, _t.float64, VECTOR))
def load_directions(slots, rel, radius, x):
    """Write the directions of the resultant contact force of the last step, from the carrier's axis and from the partner's.

    A centred force has no direction: the carrier then uses its x axis, and the partner the carrier's direction.
    """
    # centre of pressure of the last step, weighted by the normal forces
    p0, p1, p2, total = 0.0, 0.0, 0.0, 0.0
    for i in range(slots.shape[0]):
        slot = slots[i]
        if slot[ACTIVE] > 0.0:
            normal_force = slot[CACHED_FORCE] * rel[2] + slot[CACHED_FORCE + 1] * rel[5] + slot[CACHED_FORCE + 2] * rel[8]
            total += normal_force
            p0 += normal_force * (slot[POSITION] - rel[REL_D])
            p1 += normal_force * (slot[POSITION + 1] - rel[REL_D + 1])
            p2 += normal_force * (slot[POSITION + 2] - rel[REL_D + 2])
    if total != 0.0:
        p0, p1, p2 = p0 / total, p1 / total, p2 / total
    min_offset_squared = (CENTRED_RATIO * radius) ** 2
    # direction in the partner's face, then in the carrier's face
    x[3], x[4], x[5] = rel[REL_D] + p0, rel[REL_D + 1] + p1, 0.0
    projection = p0 * rel[2] + p1 * rel[5] + p2 * rel[8]
    x[0], x[1], x[2] = p0 - projection * rel[2], p1 - projection * rel[5], p2 - projection * rel[8]
    if x[0] * x[0] + x[1] * x[1] + x[2] * x[2] <= min_offset_squared:
        # rounding would turn the points under a centred load: the x axis is fixed to the stone
        x[0], x[1], x[2] = rel[0], rel[3], rel[6]
    if total == 0.0 or x[3] * x[3] + x[4] * x[4] <= min_offset_squared:
        x[3], x[4], x[5] = x[0], x[1], 0.0


@kernel(_t.void(_t.boolean, _t.float64, _t.float64, MATRIX, VECTOR, VECTOR))
def set_rim_contact(is_deepest, sine, radius, axes, frame, row):
    """Write the simultaneity window of a rim contact into its row, and axis and radius for the lowest point.

    Parameters
    ----------
    is_deepest : bool
        Whether the contact is the lowest point.
    sine, radius : float
        Sine of the lean, and radius of the rim, m, negative if it belongs to the second stone.
    axes : (4, 18) array
        See :func:`lowest_rim_point`.
    frame : (31,) array
        Body in whose axes `axes` is given.
    row : (92,) array
    """
    # a flat stone does not roll on its rim
    if sine == 0.0:
        return
    row[SIMULTANEITY_WINDOW] = RIM_SIMULTANEITY
    # the bias of rolling applies to the lowest point only
    if not is_deepest:
        return
    a = axes[0]
    row[RIM_RADIUS] = radius
    for i in range(3):
        row[RIM_AXIS + i] = frame[R + 3 * i] * a[0] + frame[R + 3 * i + 1] * a[1] + frame[R + 3 * i + 2] * a[2]


@kernel(_t.float64(VECTOR, _t.float64, _t.float64, _t.float64, _t.float64, VECTOR))
def rolling_bias(row, x, y, z, step, bias):
    """Add the velocity change of the lowest rim point over half a step due to rolling; return the time until it has moved far, s.

    The normal component keeps the lowest point on its plane until the end of the step, wherever it then is (derived here). If the stone
    passes through the flat position and the lowest point jumps to the other side, no bias is added: the points there strike.

    Parameters
    ----------
    row : (92,) array
    x, y, z : float, rad/s
        Spin of the first stone relative to the second.
    step : float, s
    bias : (3,) array, m/s
    """
    radius, side = abs(row[RIM_RADIUS]), math.copysign(1.0, row[RIM_RADIUS])
    a0, a1, a2 = row[RIM_AXIS], row[RIM_AXIS + 1], row[RIM_AXIS + 2]
    n0, n1, n2 = side * row[NORMAL], side * row[NORMAL + 1], side * row[NORMAL + 2]
    w0, w1, w2 = side * x, side * y, side * z
    cosine = n0 * a0 + n1 * a1 + n2 * a2
    u0, u1, u2 = cosine * a0 - n0, cosine * a1 - n1, cosine * a2 - n2
    # u is the direction of the lowest point, a' = w x a the rate of the axis
    sine = math.sqrt(u0 * u0 + u1 * u1 + u2 * u2)
    u0, u1, u2 = u0 / sine, u1 / sine, u2 / sine
    d0, d1, d2 = w1 * a2 - w2 * a1, w2 * a0 - w0 * a2, w0 * a1 - w1 * a0
    turning = n0 * d0 + n1 * d1 + n2 * d2
    # m = -(sine u)'; its component along u is the rate of n u = -sine, the height of the lowest point over the radius
    m0, m1, m2 = -turning * a0 - cosine * d0, -turning * a1 - cosine * d1, -turning * a2 - cosine * d2
    sine_rate = u0 * m0 + u1 * m1 + u2 * m2
    # s = u' - w x u: velocity of the contact point relative to the stone, over the radius
    v0, v1, v2 = w1 * u2 - w2 * u1, w2 * u0 - w0 * u2, w0 * u1 - w1 * u0
    s0, s1, s2 = (sine_rate * u0 - m0) / sine - v0, (sine_rate * u1 - m1) / sine - v1, (sine_rate * u2 - m2) / sine - v2
    wander = math.sqrt(s0 * s0 + s1 * s1 + s2 * s2)
    e0, e1, e2 = w1 * s2 - w2 * s1, w2 * s0 - w0 * s2, w0 * s1 - w1 * s0
    # axis at the end of the step by Rodrigues' formula, exact for a constant spin
    spin = math.sqrt(w0 * w0 + w1 * w1 + w2 * w2)
    # without spin the axis stays where it is, and the lowest point with it
    if spin > 0.0:
        c, s = math.cos(spin * step), math.sin(spin * step) / spin
        axial = (1.0 - c) * (w0 * a0 + w1 * a1 + w2 * a2) / (spin * spin)
        b0, b1, b2 = c * a0 + s * d0 + axial * w0, c * a1 + s * d1 + axial * w1, c * a2 + s * d2 + axial * w2
        f0, f1, f2 = n1 * b2 - n2 * b1, n2 * b0 - n0 * b2, n0 * b1 - n1 * b0
        sine_after = math.sqrt(f0 * f0 + f1 * f1 + f2 * f2)
        g0, g1, g2 = w1 * v2 - w2 * v1, w2 * v0 - w0 * v2, w0 * v1 - w1 * v0
        half = 0.5 * step
        up = (sine - sine_after) / step - sine_rate - half * (n0 * g0 + n1 * g1 + n2 * g2)
        # the tangential prediction is linear in the angle and fails for large ones
        if wander * step > 2.0 * MAX_HALF_STEP_ANGLE:
            e0, e1, e2 = 0.0, 0.0, 0.0
        up -= half * (n0 * e0 + n1 * e1 + n2 * e2)
        # negative if the stone passes the flat position: the lowest point is then on the other side
        lead = sine + (n0 * b0 + n1 * b1 + n2 * b2) * (u0 * b0 + u1 * b1 + u2 * b2)
        factor = side * radius if lead > 0.0 else 0.0
        bias[0] += factor * (half * e0 + up * n0)
        bias[1] += factor * (half * e1 + up * n1)
        bias[2] += factor * (half * e2 + up * n2)
    passing_rate = sine * wander * math.cos(MAX_STEP_ANGLE) + sine_rate * math.sin(MAX_STEP_ANGLE)
    return sine * math.sin(MAX_STEP_ANGLE) / passing_rate if passing_rate > 0.0 else math.inf


@kernel(_t.boolean(_t.float64, MATRIX, _t.int64), inline=True)
def _rim_touches(lean, rims, side):
    """Return whether the worn rim touches at a lean, given as its tangent; beyond the slope of the bevel the side touches."""
    worn_rim, full_rim = rims[side], rims[2 + side]
    return full_rim[RADIUS] == 0.0 or lean * (full_rim[RADIUS] - worn_rim[RADIUS]) <= abs(worn_rim[HEIGHT] - full_rim[HEIGHT])


@kernel(_t.boolean(VECTOR, VECTOR, VECTOR, MATRIX, MATRIX))
def faces_opposed(rel, carrier_half, partner_half, rims, partner_rims):
    """Return whether one of two stones stands on the other with a flat face or its worn rim.

    Parameters
    ----------
    rel : (18,) array
        State of the carrier in the partner's axes.
    carrier_half, partner_half : (6,) arrays, m
        Boxes of the carrier and of the partner.
    rims, partner_rims : (4, 2) arrays, m
        Bounding circles of the carrier and of the partner.
    """
    # a stone beside the other or on its side has no face opposed to one of the other
    if abs(rel[8]) <= MIN_FACING_COSINE or abs(rel[REL_D + 2]) <= partner_half[2] + MIN_JOINT_HEIGHT_RATIO * carrier_half[2]:
        return False
    is_above = rel[REL_D + 2] > 0.0
    # tangent of the angle between the axes
    lean = math.sqrt(max(1.0 - rel[8] * rel[8], 0.0)) / abs(rel[8])
    # a stone upside down shows its other face
    lower_down = is_above == (rel[8] > 0.0)
    return _rim_touches(lean, partner_rims, 1 if is_above else 0) and _rim_touches(lean, rims, 0 if lower_down else 1)
