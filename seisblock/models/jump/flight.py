"""Flight model of the two-layer block, with landing and motion about the landed corner ([Sugimoto2017]_ sections 3.8 to 3.11).

Assumptions
    Landing rules are those of :mod:`seisblock.models.jump.landing`. Static friction is tested once, at the landing: the corner sticks or
    slips. A slipping corner stays under kinetic friction, and stops where kinetic friction can hold it. A chain ends when the tilt returns
    to zero, or at pi/2 (overturned); with landing rule ``friction`` it continues until the flat base has slid to rest.
State
    theta (counter-clockwise) and omega; x, vx: displacement and velocity relative to the ground, of the centroid in flight, of the landed
    foot afterwards; y, vy: rise of the centroid above its height at rest and its rate, in flight. Of the landings: side of the last one,
    -1 or +1, 0 before it; largest friction demand; energy before and after the landing with the largest ratio of the two, J.
Modes
    FLIGHT; for each corner STICK (no slip), HOLD (stopped under kinetic friction), SLIP_BACKWARD and SLIP_FORWARD (to -x, +x);
    FLAT_BACKWARD and FLAT_FORWARD for sliding of the flat base.
Symbols
    psi = beta + tau with beta = pi/2 - alpha and tau the tilt towards the corner in contact: the centroid is at
    (-R cos psi, R sin psi) from the right corner. Motion about the left corner is the mirror image.
"""

from __future__ import annotations

import numpy as np

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.dynamics.model import Model
from seisblock.dynamics.model_api import OFF, RESET, SERIES
from seisblock.dynamics.series import product, quotient, sine_cosine
from seisblock.models.jump.landing import land_flat_by_friction, record_landing, take_off, touch_down, touch_down_by_friction
from seisblock.models.jump.modes import (
    ALPHA,
    CENTROID_INERTIA,
    COS,
    DROP,
    DT,
    END,
    ENERGY_AFTER,
    ENERGY_BEFORE,
    FLAT_BACKWARD,
    FLAT_FORWARD,
    FLIGHT,
    FRICTION,
    FRICTION_BACKWARD,
    FRICTION_NEEDED,
    FRICTION_RULE,
    GRAVITY,
    HALF_WIDTH,
    HEIGHT,
    HOLD,
    INERTIA,
    JAMMED,
    LEFT,
    LIFT,
    MASS,
    MU,
    MU_KINETIC,
    NORMAL,
    OMEGA,
    OVERTURNED,
    PRINTED_RULE,
    PSI,
    RADIUS,
    RIGHT,
    RULE,
    SIDE,
    SIN,
    SINK,
    SLIP_BACKWARD,
    SLIP_FORWARD,
    SPEED2,
    STICK,
    TAU1,
    TAU2,
    THETA,
    TOPPLE,
    TOUCH,
    VX,
    VY,
    WEIGHT,
    X,
    Y,
    contact_corner,
    contact_kind,
    contact_mode,
)

_t = types()


@kernel(_t.int64(VECTOR, MATRIX, VECTOR, _t.int64, MATRIX, MATRIX), inline=True)
def _flight_series(y, f, p, order, c, g):
    """Write the cubic series of [Sugimoto2017]_ eqs. (9), and the heights of both lower corners as guards (eq. (11))."""
    c[THETA, 0], c[THETA, 1], c[THETA, 2], c[THETA, 3] = y[THETA], y[OMEGA], 0.0, 0.0
    c[OMEGA, 0], c[OMEGA, 1], c[OMEGA, 2], c[OMEGA, 3] = y[OMEGA], 0.0, 0.0, 0.0
    # relative to the ground: x'' = -z'' with z'' = f0 + f1 t; y'' = -g
    c[X, 0], c[X, 1], c[X, 2], c[X, 3] = y[X], y[VX], -f[0, 0] / 2, -f[0, 1] / 6
    c[VX, 0], c[VX, 1], c[VX, 2], c[VX, 3] = y[VX], -f[0, 0], -f[0, 1] / 2, 0.0
    c[Y, 0], c[Y, 1], c[Y, 2], c[Y, 3] = y[Y], y[VY], -p[GRAVITY] / 2, 0.0
    c[VY, 0], c[VY, 1], c[VY, 2], c[VY, 3] = y[VY], -p[GRAVITY], 0.0, 0.0
    g[LIFT, 0] = g[FRICTION, 0] = g[FRICTION_BACKWARD, 0] = OFF
    # y is concave, so its least value is at an end of the sample; a corner lies at most B/2 |theta| below it, as H (1 - cos theta) >= 0
    dt = p[DT]
    lowest_height = min(y[Y], y[Y] + dt * (y[VY] - dt * p[GRAVITY] / 2)) + p[DROP]
    if lowest_height > p[HALF_WIDTH] * (abs(y[THETA]) + abs(y[OMEGA]) * dt):
        # no corner can reach the ground within the sample, at any tilt
        g[LEFT, 0] = g[RIGHT, 0] = OFF
        return 3
    # with a constant spin the recurrence of sine and cosine has a single term
    c[SIN, 0], c[COS, 0] = np.sin(y[THETA]), np.cos(y[THETA])
    for k in range(1, order + 1):
        c[SIN, k] = y[OMEGA] * c[COS, k - 1] / k
        c[COS, k] = -y[OMEGA] * c[SIN, k - 1] / k
    for k in range(order + 1):
        # `c` is reused from step to step: above order 3 it may hold coefficients of an earlier mode
        if k > 3:
            for i in range(6):
                c[i, k] = 0.0
        # middle of the base at y + H - H cos theta, corners at -+ B/2 sin theta from it
        centre = c[Y, k] - p[HEIGHT] * c[COS, k]
        g[LEFT, k] = centre - p[HALF_WIDTH] * c[SIN, k]
        g[RIGHT, k] = centre + p[HALF_WIDTH] * c[SIN, k]
    g[LEFT, 0] += p[HEIGHT] + p[DROP]
    g[RIGHT, 0] += p[HEIGHT] + p[DROP]
    return order


@kernel(_t.int64(_t.float64, VECTOR, MATRIX, VECTOR, MATRIX, MATRIX), inline=True)
def _flat_sliding_series(slip, y, f, p, c, g):
    """Write the cubic series of flat sliding, x'' = -z'' - mu' g sgn(x') ([Fujino1978]_ eq. (7))."""
    for i in range(6):
        c[i, 0] = y[i]
        c[i, 1] = c[i, 2] = c[i, 3] = 0.0
    # the flat base carries the weight alone: N = m g, without the terms of rotation
    pull = -f[0, 0] - slip * p[MU_KINETIC] * p[GRAVITY]
    c[X, 1], c[X, 2], c[X, 3] = y[VX], pull / 2, -f[0, 1] / 6
    c[VX, 1], c[VX, 2] = pull, -f[0, 1] / 2
    g[TOUCH, 0] = g[TOPPLE, 0] = g[LIFT, 0] = g[FRICTION_BACKWARD, 0] = OFF
    # sliding ends where the velocity changes its sign
    for k in range(4):
        g[FRICTION, k] = slip * c[VX, k]
    return 3


@kernel(SERIES)
def flight_series(mode, y, f, p, order, c, g):
    """Write the series of flight, of motion about the corner in contact, or of flat sliding; return the degree."""
    # the record of the landings is constant: its rows are not advanced
    c[SIDE, 1] = c[FRICTION_NEEDED, 1] = c[ENERGY_BEFORE, 1] = c[ENERGY_AFTER, 1] = OFF
    if mode == FLIGHT:
        return _flight_series(y, f, p, order, c, g)
    side = 2 * contact_corner(mode) - 1
    kind = contact_kind(mode)
    if kind >= FLAT_BACKWARD:
        return _flat_sliding_series(1.0 if kind == FLAT_FORWARD else -1.0, y, f, p, c, g)
    # slip directions are numbered in the component's frame; the equations are those of the right corner, mirrored for
    # the left one
    slip = 0.0
    if kind == SLIP_BACKWARD:
        slip = -side
    elif kind == SLIP_FORWARD:
        slip = side
    slides = slip != 0.0
    r = p[RADIUS]
    friction = slip * p[MU_KINETIC]
    c[THETA, 0], c[OMEGA, 0] = y[THETA], y[OMEGA]
    c[PSI, 0] = 0.5 * np.pi - p[ALPHA] - side * y[THETA]
    c[SIN, 0], c[COS, 0] = np.sin(c[PSI, 0]), np.cos(c[PSI, 0])
    # tau is the tilt towards the corner in contact: -side theta
    c[TAU1, 0] = -side * y[OMEGA]
    c[X, 0], c[VX, 0], c[Y, 0], c[VY, 0] = y[X], y[VX], y[Y], y[VY]
    corner_inertia = p[CENTROID_INERTIA] + p[MASS] * r * r
    is_printed = p[RULE] == PRINTED_RULE
    # the tables of the paper were integrated with half of the accelerations of tilt and slip
    rate = 0.5 if is_printed else 1.0
    # eqs. (12a), (12c) have the wrong sign of z''
    shake_sign = -1.0 if is_printed and not slides else 1.0
    for k in range(order + 1):
        # the left corner is the mirror image: ground motion and velocities along x change their signs
        shake = shake_sign * side * f[0, k] if k < 2 else 0.0
        c[SPEED2, k] = product(c[TAU1], c[TAU1], k)
        # g - R s tau'^2
        c[SINK, k] = -r * product(c[SIN], c[SPEED2], k)
        if k == 0:
            c[SINK, 0] += p[GRAVITY]
        # D = I_G + m R^2 (c^2 - mu' sigma s c)
        c[INERTIA, k] = p[MASS] * r * r * (product(c[COS], c[COS], k) - friction * product(c[SIN], c[COS], k))
        if k == 0:
            c[INERTIA, 0] += p[CENTROID_INERTIA]
        if slides:
            # N = m I_G (g - R s tau'^2)/D and I_G tau'' = N R (mu' sigma s - c): eqs. (13b), (13c) without S''
            c[WEIGHT, k] = p[MASS] * p[CENTROID_INERTIA] * c[SINK, k]
            c[NORMAL, k] = quotient(c[WEIGHT], c[INERTIA], c[NORMAL], k)
            pull = friction * product(c[NORMAL], c[SIN], k) - product(c[NORMAL], c[COS], k)
            c[TAU2, k] = r * pull / p[CENTROID_INERTIA]
        else:
            # eq. (12a) as corrected, and N of eq. (12b)
            shaking_moment = shake_sign * side * (f[0, 0] * c[SIN, k] + (f[0, 1] * c[SIN, k - 1] if k > 0 else 0.0))
            c[TAU2, k] = -p[MASS] * r * (p[GRAVITY] * c[COS, k] + shaking_moment) / corner_inertia
            c[NORMAL, k] = p[MASS] * (c[SINK, k] + r * product(c[COS], c[TAU2], k))
        # tangential force per unit mass needed for a sticking foot; the deficit is the acceleration of the foot
        need = shake + r * (product(c[SIN], c[TAU2], k) + product(c[COS], c[SPEED2], k))
        if slides:
            g[FRICTION, k] = slip * side * c[VX, k]
            g[FRICTION_BACKWARD, k] = 0.0
            foot = side * (-friction * c[NORMAL, k] / p[MASS] - need)
        else:
            g[FRICTION, k] = p[MU_KINETIC] * c[NORMAL, k] / p[MASS] - need
            g[FRICTION_BACKWARD, k] = p[MU_KINETIC] * c[NORMAL, k] / p[MASS] + need
            foot = 0.0
        # the tilt towards the corner returns to zero, or reaches pi/2
        g[TOUCH, k] = -side * c[THETA, k]
        g[TOPPLE, k] = side * c[THETA, k]
        g[LIFT, k] = c[NORMAL, k]
        if k == order:
            break
        c[THETA, k + 1] = c[OMEGA, k] / (k + 1)
        c[OMEGA, k + 1] = -side * rate * c[TAU2, k] / (k + 1)
        c[TAU1, k + 1] = rate * c[TAU2, k] / (k + 1)
        c[PSI, k + 1] = c[TAU1, k] / (k + 1)
        c[X, k + 1] = c[VX, k] / (k + 1)
        c[VX, k + 1] = rate * foot / (k + 1)
        c[Y, k + 1] = c[VY, k + 1] = 0.0
        sine_cosine(c[PSI], c[SIN], c[COS], k + 1)
    g[TOPPLE, 0] += 0.5 * np.pi
    # the guards of kinetic friction would end the stick, which the paper tests once
    if kind == STICK:
        # static friction is tested at the landing only, as in the paper
        g[FRICTION, 0] = g[FRICTION_BACKWARD, 0] = OFF
    elif slides:
        g[FRICTION_BACKWARD, 0] = OFF
    return order


@kernel(_t.int64(_t.int64, _t.float64, _t.float64, _t.float64, VECTOR), inline=True)
def _slip_mode(corner, slip, s, c, p):
    """Return the mode of a slipping foot, ``JAMMED`` where [Sugimoto2017]_ eqs. (13) have no solution.

    `slip` is the slip direction in the mirrored frame of `corner`.
    """
    # D is Painleve's denominator: where it is not positive, a slipping foot has no consistent force
    if p[CENTROID_INERTIA] + p[MASS] * p[RADIUS] ** 2 * c * (c - slip * p[MU_KINETIC] * s) <= 0.0:
        return JAMMED
    return contact_mode(corner, SLIP_FORWARD if slip * (2 * corner - 1) > 0.0 else SLIP_BACKWARD)


@kernel(_t.int64(_t.int64, VECTOR, VECTOR), inline=True)
def _current_slip_mode(corner, y, p):
    """Return the mode of a foot with non-zero slip velocity."""
    side = 2 * corner - 1
    psi = 0.5 * np.pi - p[ALPHA] - side * y[THETA]
    return _slip_mode(corner, side * np.sign(y[VX]), np.sin(psi), np.cos(psi), p)


@kernel(_t.int64(_t.int64, VECTOR, MATRIX, VECTOR, _t.float64, _t.int64), inline=True)
def _stick_or_slip_mode(corner, y, f, p, mu, stick_kind):
    """Return the mode after the friction test of [Sugimoto2017]_ eqs. (12b), (12c), (14): `stick_kind` if friction suffices, else slip."""
    side = 2 * corner - 1
    r = p[RADIUS]
    psi = 0.5 * np.pi - p[ALPHA] - side * y[THETA]
    s = np.sin(psi)
    c = np.cos(psi)
    tilting = -side * y[OMEGA]
    # eqs. (12b), (12c) with the sign of z'' as printed, or corrected
    shake = -side * f[0, 0] if p[RULE] == PRINTED_RULE else side * f[0, 0]
    turning = -p[MASS] * r * (p[GRAVITY] * c + shake * s) / (p[CENTROID_INERTIA] + p[MASS] * r * r)
    normal = p[GRAVITY] - r * s * tilting**2 + r * c * turning
    need = shake + r * s * turning + r * c * tilting**2
    # eq. (14), H and N per unit mass
    if abs(need) <= mu * normal:
        return contact_mode(corner, stick_kind)
    # the foot slips against the direction of the force that it lacks
    return _slip_mode(corner, -1.0 if need > 0.0 else 1.0, s, c, p)


@kernel(RESET)
def flight_reset(mode, guard, y, f, p):
    """Return the mode after a landing, a stop or restart of slip, a lift-off, or the end of the chain."""
    if mode == FLIGHT:
        # the landing overwrites these velocities, which its energy balance needs
        flying_x, flying_y, flying_spin = y[VX], y[VY], y[OMEGA]
        if p[RULE] != FRICTION_RULE:
            touch_down(guard, y, p)
        else:
            touch_down_by_friction(guard, y, p)
        record_landing(guard, flying_x, flying_y, flying_spin, y, p)
        # slip that is left after the impulse is kinetic; the static test applies to a foot that has stopped
        if p[RULE] == FRICTION_RULE and y[VX] != 0.0:
            return _current_slip_mode(guard, y, p)
        return _stick_or_slip_mode(guard, y, f, p, p[MU], STICK)
    corner = contact_corner(mode)
    if guard == TOUCH:
        # the model of the paper ends here, without an impact of the base
        if p[RULE] != FRICTION_RULE:
            y[THETA] = 0.0
            return END
        land_flat_by_friction(y, p)
        return END if y[VX] == 0.0 else contact_mode(corner, FLAT_FORWARD if y[VX] > 0.0 else FLAT_BACKWARD)
    if guard == TOPPLE:
        return OVERTURNED
    if guard == LIFT:
        take_off(corner, y, p)
        return FLIGHT
    # guard FRICTION: the slip has come to zero. Kinetic friction may hold the foot, otherwise it slips the other way.
    y[VX] = 0.0
    if contact_kind(mode) >= FLAT_BACKWARD:
        return END
    if contact_kind(mode) == HOLD:
        side = 2 * corner - 1
        # FRICTION fires where the foot lacks force towards +x of the mirrored frame: it slips the other way
        return contact_mode(corner, SLIP_BACKWARD if (guard == FRICTION) == (side > 0) else SLIP_FORWARD)
    return _stick_or_slip_mode(corner, y, f, p, p[MU_KINETIC], HOLD)


FLIGHT_MODEL = Model(
    "jump (flight)",
    flight_series,
    flight_reset,
    states=("theta", "omega", "x", "vx", "y", "vy", "side", "needed", "before", "after"),
    guards=("left lands, or tilt ends", "right lands, or topples", "lift", "friction", "friction backward"),
    modes=(
        "flight",
        *(f"{kind} {side}" for kind in ("stick", "hold", "back", "forth") for side in ("left", "right")),
        *("flat, back", "flat, back", "flat, forth", "flat, forth"),
        "jammed",
        "overturned",
        "end",
    ),
    scratch=10,
    tracked=0,
)
