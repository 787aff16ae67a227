"""Slide-rocking: rotation about a sliding corner, as power series in time; see :mod:`seisblock.models.respond.rocking`.

N depends on theta'' and theta'' on N. At each order of the series the pair is solved for N, whose factor is Painleve's
P = 1 + r_x (r_x + s mu r_y)/k^2 at the start of the step; neither P nor a quotient is needed as a series (derived here;
[GenotBrogliato1999]_).
"""

from __future__ import annotations

from seisblock._jit import kernel
from seisblock.models.respond.constants import (
    CONE,
    DT,
    FRICTION,
    GAP_LEFT,
    GRAVITY,
    GYRATION,
    LIFT,
    LOSS,
    MIN_CONE,
    MU_KINETIC,
    NEAR_JAM,
    OMEGA,
    PATH,
    SLIP,
    SPEED,
    THETA,
    WORK,
    X,
    corner_position,
)
from seisblock.models.respond.mode_selection import ACROSS, ALONG, UP
from seisblock.models.respond.polynomial_modes import clear_round_off, freeze_states
from seisblock.models.respond.rocking import (
    CORNER_SERIES,
    NORMAL,
    PREVIOUS_TERM_TOLERANCE,
    RX,
    RY,
    TANGENT,
    TERM_TOLERANCE,
    initial_angular_acceleration,
    rotation_slacks,
)


@kernel(CORNER_SERIES)
def slide_rock_series(right, s, y, f, p, order, c, g):
    """Write the series of rocking about a corner that slides in direction `s` ([ShentonJones1991]_, [GenotBrogliato1999]_)."""
    side = 1.0 if right else -1.0
    base = y.size
    rx, ry, force, speed = base + RX, base + RY, base + NORMAL, base + TANGENT
    push = f[ALONG, 0] + f[ACROSS, 0]
    push_rate = f[ALONG, 1] + f[ACROSS, 1]
    up = f[UP, 0]
    up_rate = f[UP, 1]
    weight = p[GRAVITY] + up
    friction = s * p[MU_KINETIC]
    per_inertia = 1.0 / p[GYRATION]
    omega = y[OMEGA]
    dt = p[DT]
    c[THETA, 0] = y[THETA]
    c[OMEGA, 0] = omega
    c[X, 0] = y[X]
    c[SPEED, 0] = y[SPEED]
    c[PATH, 0] = y[PATH]
    c[WORK, 0] = y[WORK]
    c[FRICTION, 0] = y[FRICTION]
    c[rx, 0], c[ry, 0] = corner_position(right, y[THETA], p)
    lever = c[rx, 0] + friction * c[ry, 0]
    cone = 1.0 / (1.0 + c[rx, 0] * lever * per_inertia)
    rx_omega = c[rx, 0] * omega
    last_rx_omega = 0.0
    size = abs(omega)
    power = 1.0
    term = size
    degree = order
    for k in range(order + 1):
        ry_omega = 0.0
        for j in range(k + 1):
            ry_omega += c[ry, j] * c[OMEGA, k - j]
        if k == 0:
            # x' of the centre of gravity: slip velocity of the corner minus the rotation
            c[speed, 0] = y[SPEED] - ry_omega
        else:
            slip = c[speed, k] + ry_omega
            if k == 1:
                # a slip that starts from zero must not start backwards by round-off
                slip = clear_round_off(s, y[SPEED], slip, 0.0, p)
            c[SPEED, k] = slip
            last_term = term
            term = abs(c[OMEGA, k]) * power
            size += term
            if k >= 3 and term <= TERM_TOLERANCE * size and last_term <= PREVIOUS_TERM_TOLERANCE * size:
                degree = k
                break
        if k == order:
            break
        share = 1.0 / (k + 1)
        c[THETA, k + 1] = c[OMEGA, k] * share
        c[rx, k + 1] = ry_omega * share
        c[ry, k + 1] = -rx_omega * share
        # order k of N, from both equations with the known terms of lower order collected
        rising = 0.0
        pressing = 0.0
        for j in range(1, k + 1):
            rising += c[rx, j] * c[OMEGA, k + 1 - j]
            pressing += (c[rx, j] + friction * c[ry, j]) * c[force, k - j]
        rising += c[rx, k + 1] * omega
        normal = (k + 1) * rising - c[rx, 0] * pressing * per_inertia
        if k == 0:
            normal += weight
        elif k == 1:
            normal += up_rate
        normal *= cone
        c[force, k] = normal
        g[LIFT, k] = normal
        # the ground's horizontal acceleration is absent from theta'': it changes the slip velocity only
        turn = -(lever * normal + pressing) * per_inertia
        if k == 0:
            turn = initial_angular_acceleration(side, y[THETA], omega, turn, -lever * cone * up_rate * per_inertia, p)
        c[OMEGA, k + 1] = turn * share
        work = push * c[speed, k] + up * rx_omega
        pull = friction * normal
        friction_product = 0.0
        for j in range(k + 1):
            friction_product += c[force, j] * c[SPEED, k - j]
        if k == 0:
            pull += push
        else:
            work += push_rate * c[speed, k - 1] + up_rate * last_rx_omega
            if k == 1:
                pull += push_rate
        c[X, k + 1] = c[speed, k] * share
        c[PATH, k + 1] = s * c[SPEED, k] * share
        c[FRICTION, k + 1] = friction * friction_product * share
        c[WORK, k + 1] = -work * share
        c[speed, k + 1] = -pull * share
        last_rx_omega = rx_omega
        rx_omega = rising + c[rx, 0] * c[OMEGA, k + 1]
        power *= dt
    g[LIFT, degree] = 0.0
    for k in range(degree + 1):
        g[SLIP, k] = s * c[SPEED, k]
    if p[NEAR_JAM] > 0.0:
        for k in range(degree + 1):
            product = 0.0
            for j in range(k + 1):
                product += c[rx, j] * (c[rx, k - j] + friction * c[ry, k - j])
            g[CONE, k] = product * per_inertia
        g[CONE, 0] += 1.0 - MIN_CONE
    freeze_states(c, GAP_LEFT, PATH)
    freeze_states(c, LOSS, y.size)
    rotation_slacks(side, degree, 1.01 * size * dt, c, g)
    return degree
