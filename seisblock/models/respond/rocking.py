"""Rocking about a sticking corner, as power series in time.

With r = (r_x, r_y) from the centre of gravity to the corner, r_x' = r_y theta' and r_y' = -r_x theta'. A body in contact has
y' = r_x theta', y'' = (r_x theta')' and, with a sticking corner, x' = -r_y theta', x'' = -(r_y theta')'. The series of the two products
r_x theta' and r_y theta' therefore give the arms, the velocities and, differentiated, the forces per unit mass

    N = G + (r_x theta')',    T = a - (r_y theta')'.

Rocking
    (k^2 + r^2) theta'' = r_y a - r_x G, while mu_s N > abs(T).
Slide-rocking
    k^2 theta'' = -(r_x + s mu r_y) N, x'' = -a - s mu N, while N > 0, s v > 0 and P > 0; see ``slide_rocking``.
Both end when the other corner comes down (theta returns to zero) or at a tilt of pi/2 ([ShentonJones1991]_, [GenotBrogliato1999]_).

The slip velocity v is a separate state; the velocity of the centre of gravity is v - r_y theta'. Derived here.
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.dynamics.hybrid import OFF
from seisblock.models.respond.constants import (
    BACKWARD,
    DOWN,
    DT,
    END,
    FORWARD,
    FRICTION,
    GRAVITY,
    GYRATION,
    HALF_PI,
    HEIGHT,
    LIFT,
    MU,
    OMEGA,
    SPEED,
    THETA,
    WORK,
    X,
    corner_position,
)
from seisblock.models.respond.mode_selection import ACROSS, ALONG, TOLERANCE, UP
from seisblock.models.respond.polynomial_modes import clear_round_off, freeze_states

_t = types()
CORNER_SERIES = _t.int64(_t.boolean, _t.float64, VECTOR, MATRIX, VECTOR, _t.int64, MATRIX, MATRIX)
"""Signature ``series(right, parameter, y, f, p, order, c, g) -> degree`` of a mode about the right or the left corner."""

TERM_TOLERANCE, PREVIOUS_TERM_TOLERANCE = 3e-17, 1e-12
"""Truncation of a series: a term below the first value and the previous term below the second, relative to the state."""

TENON_FORCE_RATIO = 1e-9
"""Normal force over weight below which the tenon holds the foot down."""

RX, RY, NORMAL, TANGENT = range(4)
"""Scratch rows after the states; TANGENT: x' in slide-rocking."""


@kernel(_t.float64(_t.float64, _t.float64, _t.float64, _t.float64, _t.float64, VECTOR), inline=True)
def initial_angular_acceleration(side, theta, omega, turn, rate, p):
    """Return theta'' at the start of a mode, zero where rocking starts at its threshold up to round-off."""
    if theta == 0.0 and omega == 0.0:
        return clear_round_off(side, 0.0, turn * p[HEIGHT], rate * p[HEIGHT], p) / p[HEIGHT]
    return turn


@kernel(_t.void(_t.float64, _t.int64, _t.float64, MATRIX, MATRIX), inline=True)
def rotation_slacks(side, degree, swing, c, g):
    """Write the guards of the impact of the other corner and of the tilt pi/2.

    `swing` bounds the change of the tilt within the step, rad; a guard out of its reach is switched off.
    """
    lean = side * c[THETA, 0]
    g[DOWN, 0] = OFF
    if lean <= swing:
        for k in range(degree + 1):
            g[DOWN, k] = side * c[THETA, k]
    g[END, 0] = OFF
    if HALF_PI - lean <= swing:
        for k in range(degree + 1):
            g[END, k] = -side * c[THETA, k]
        g[END, 0] += HALF_PI


@kernel(_t.void(_t.int64, _t.int64, _t.float64, _t.float64, VECTOR, MATRIX, MATRIX), inline=True)
def _tenon_slacks(ry, degree, weight, weight_rate, p, c, g):
    """Write the guard of a foot held down by a tenon: G + r_y theta'^2, or the lateral load on the tenon (derived here)."""
    if weight + c[ry, 0] * c[OMEGA, 0] ** 2 <= TENON_FORCE_RATIO * p[GRAVITY]:
        # the released foot would not rise permanently, else the mode would have ended: only loss of the lateral load releases it
        side = 1.0 if g[FORWARD, 0] < g[BACKWARD, 0] else -1.0
        for k in range(degree + 1):
            g[LIFT, k] = 0.5 * side * (g[BACKWARD, k] - g[FORWARD, k])
        return
    for k in range(degree + 1):
        slack = 0.0
        for i in range(k + 1):
            for j in range(k + 1 - i):
                slack += c[ry, i] * c[OMEGA, j] * c[OMEGA, k - i - j]
        g[LIFT, k] = slack
    g[LIFT, 0] += weight
    g[LIFT, 1] += weight_rate


@kernel(CORNER_SERIES)
def rock_series(right, has_tenon, y, f, p, order, c, g):
    """Write the series of rocking about a sticking corner; `has_tenon` is 1 for unlimited friction, else 0 ([ShentonJones1991]_)."""
    side = 1.0 if right else -1.0
    base = y.size
    rx, ry = base + RX, base + RY
    push = f[ALONG, 0] + f[ACROSS, 0]
    push_rate = f[ALONG, 1] + f[ACROSS, 1]
    up = f[UP, 0]
    up_rate = f[UP, 1]
    weight = p[GRAVITY] + up
    omega = y[OMEGA]
    dt = p[DT]
    c[THETA, 0] = y[THETA]
    c[OMEGA, 0] = omega
    c[X, 0] = y[X]
    c[WORK, 0] = y[WORK]
    c[rx, 0], c[ry, 0] = corner_position(right, y[THETA], p)
    # the arm turns without changing its length: k^2 + r^2 is constant over the step
    inertia = 1.0 / (p[GYRATION] + c[rx, 0] * c[rx, 0] + c[ry, 0] * c[ry, 0])
    limit = p[MU]
    size = abs(omega)
    power = 1.0
    term = size
    degree = order
    last_ry_omega = 0.0
    last_rx_omega = 0.0
    for k in range(order + 1):
        # order k of r_y theta' = -x' and of r_x theta' = y'
        ry_omega = 0.0
        rx_omega = 0.0
        for j in range(k + 1):
            ry_omega += c[ry, j] * c[OMEGA, k - j]
            rx_omega += c[rx, j] * c[OMEGA, k - j]
        # N and T are derivatives, k times coefficient k: they are complete one order later than the states
        if k > 0:
            normal = k * rx_omega
            tangent = -k * ry_omega
            if k == 1:
                normal += weight
                tangent += push
            elif k == 2:
                normal += up_rate
                tangent += push_rate
            g[LIFT, k - 1] = normal
            g[FORWARD, k - 1] = limit * normal - tangent
            g[BACKWARD, k - 1] = limit * normal + tangent
            last_term = term
            term = abs(c[OMEGA, k]) * power
            size += term
            # two successive terms, since the series of an even or odd motion has zeros in between
            if k >= 3 and term <= TERM_TOLERANCE * size and last_term <= PREVIOUS_TERM_TOLERANCE * size:
                degree = k
                break
        if k == order:
            break
        turn = c[ry, k] * push - c[rx, k] * weight
        work = push * ry_omega - up * rx_omega
        if k > 0:
            turn += c[ry, k - 1] * push_rate - c[rx, k - 1] * up_rate
            work += push_rate * last_ry_omega - up_rate * last_rx_omega
        turn *= inertia
        if k == 0:
            turn = initial_angular_acceleration(side, y[THETA], omega, turn, inertia * (c[ry, 0] * push_rate - c[rx, 0] * up_rate), p)
        share = 1.0 / (k + 1)
        c[THETA, k + 1] = c[OMEGA, k] * share
        c[OMEGA, k + 1] = turn * share
        c[rx, k + 1] = ry_omega * share
        c[ry, k + 1] = -rx_omega * share
        # the foot is fixed: x = x_foot - r_x needs no integration
        c[X, k + 1] = -c[rx, k + 1]
        c[WORK, k + 1] = work * share
        last_ry_omega = ry_omega
        last_rx_omega = rx_omega
        power *= dt
    # the top coefficient of N and T would need the next order of the states
    g[LIFT, degree] = g[FORWARD, degree] = g[BACKWARD, degree] = 0.0
    for k in (LIFT, FORWARD, BACKWARD):
        # mode selection accepts this tolerance: a violated limit from which the motion departs does not end the mode
        if -TOLERANCE * p[GRAVITY] <= g[k, 0] < 0.0 and g[k, 1] > 0.0:
            g[k, 0] = 0.0
    if has_tenon > 0.0:
        if g[LIFT, 0] <= TENON_FORCE_RATIO * p[GRAVITY]:
            _tenon_slacks(ry, degree, weight, up_rate, p, c, g)
        g[FORWARD, 0] = g[BACKWARD, 0] = OFF
    else:
        # N > 0 follows from the two friction guards, whose sum is 2 mu_s N
        g[LIFT, 0] = OFF
    freeze_states(c, SPEED, WORK)
    freeze_states(c, FRICTION, y.size)
    # the sum of all absolute terms bounds theta' over the step; 1 % covers the truncated ones
    rotation_slacks(side, degree, 1.01 * size * dt, c, g)
    return degree
