"""Modes with polynomial motion: rest, sliding, and flight with rotation.

Rest
    x' = y' = theta' = 0 while N_R = (b1 G - h a)/(b1 + b2) and N_L = (b2 G + h a)/(b1 + b2) are positive and abs(a) <= mu_s G.
Sliding
    x'' = -a - s mu_k G, centre of pressure at s mu_k h from the projection of the centre of gravity, while s x' > 0 and G > 0.
Flight
    x'' = -a, y'' = -G, theta'' = 0; the gap of a corner has the acceleration -G - r_y theta'^2 and is integrated as a state.
a and a_y are the ground accelerations along +x and up, G = g + a_y (derived here, as in [ShentonJones1991]_).
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.dynamics.hybrid import OFF, SKIP
from seisblock.models.respond.constants import (
    ARM_LEFT,
    ARM_RIGHT,
    BACKWARD,
    DT,
    FORWARD,
    FRICTION,
    GAP_LEFT,
    GAP_RIGHT,
    GRAVITY,
    HEIGHT,
    LAND_LEFT,
    LAND_RIGHT,
    LEFT,
    LIFT,
    MU,
    MU_KINETIC,
    OMEGA,
    PATH,
    RATE_LEFT,
    RATE_RIGHT,
    RELEASE,
    REST,
    RIGHT,
    SLIP,
    SPEED,
    TENON,
    TENON_OFFSET,
    THETA,
    WORK,
    X,
    corner_position,
)
from seisblock.models.respond.mode_selection import ACROSS, ALONG, FLAT_TOLERANCE, LOOKAHEAD, UP

_t = types()
_SERIES = _t.int64(VECTOR, MATRIX, VECTOR, _t.int64, MATRIX, MATRIX)

SERIES_TOLERANCE = 1e-17
"""Truncation of a series: term over a sampling interval, relative to the largest."""

ROUND_OFF = 1e-10
"""Acceleration over gravity below which a wrong sign at a threshold is round-off."""


@kernel(_t.void(MATRIX, _t.int64, _t.int64, _t.float64), inline=True)
def set_constant(c, i, degree, value):
    """Write a constant series of degree `degree` into row `i` of `c`."""
    c[i, 0] = value
    for k in range(1, degree + 1):
        c[i, k] = 0.0


@kernel(_t.void(MATRIX, _t.int64, _t.int64), inline=True)
def freeze_states(c, first, last):
    """Mark states `first` to `last` - 1 as constant."""
    for i in range(first, last):
        c[i, 1] = OFF


@kernel(_t.float64(_t.float64, _t.float64, _t.float64, _t.float64, VECTOR), inline=True)
def clear_round_off(sign, value, acceleration, rate, p):
    """Return `acceleration`, or zero where round-off would reverse a motion that starts from zero with `sign` ([Shenton1996]_).

    `rate` is the rate of the acceleration: a sign that corrects itself within the lookahead of mode selection also counts as round-off.
    """
    projection = sign * acceleration
    if value == 0.0 and projection < 0.0 and (projection > -ROUND_OFF * p[GRAVITY] or projection + LOOKAHEAD * p[DT] * sign * rate >= 0.0):
        return 0.0
    return acceleration


@kernel(_t.void(_t.boolean, MATRIX, VECTOR, MATRIX), inline=True)
def rest_slacks(has_tenon, f, p, g):
    """Write the guards of a body at rest, linear in time ([Shenton1996]_)."""
    base = 1.0 / (p[ARM_LEFT] + p[ARM_RIGHT])
    for k in range(2):
        push = f[ALONG, k] + f[ACROSS, k]
        weight = f[UP, k] + (p[GRAVITY] if k == 0 else 0.0)
        g[LEFT, k] = (p[ARM_RIGHT] * weight + p[HEIGHT] * push) * base
        g[RIGHT, k] = (p[ARM_LEFT] * weight - p[HEIGHT] * push) * base
        g[FORWARD, k] = p[MU] * weight - push
        g[BACKWARD, k] = p[MU] * weight + push
    threshold = -FLAT_TOLERANCE * p[GRAVITY]
    for k in (LEFT, RIGHT, FORWARD, BACKWARD):
        # within the tolerance of mode selection now and one sampling interval later: a tie, the mode persists
        if threshold <= g[k, 0] < 0.0 and g[k, 0] + g[k, 1] * p[DT] >= threshold:
            # otherwise the guard would fire, although mode selection keeps the mode
            g[k, 0] = 0.0
            g[k, 1] = max(g[k, 1], 0.0)
    if has_tenon:
        g[FORWARD, 0] = g[BACKWARD, 0] = OFF


@kernel(_t.int64(_t.float64, VECTOR, MATRIX, VECTOR, MATRIX, MATRIX), inline=True)
def slide_series(s, y, f, p, c, g):
    """Write the series of sliding in direction `s`: cubic displacements, quartic energies."""
    degree = 4
    push = f[ALONG, 0] + f[ACROSS, 0]
    push_rate = f[ALONG, 1] + f[ACROSS, 1]
    weight = p[GRAVITY] + f[UP, 0]
    weight_rate = f[UP, 1]
    mu = p[MU_KINETIC]
    v0 = y[SPEED]
    v2 = 0.5 * (-push_rate - s * mu * weight_rate)
    v1 = clear_round_off(s, v0, -push - s * mu * weight, 2.0 * v2, p)
    freeze_states(c, OMEGA, y.size)
    set_constant(c, THETA, degree, 0.0)
    for i in (X, SPEED, PATH, WORK, FRICTION):
        set_constant(c, i, degree, y[i])
    c[SPEED, 1] = v1
    c[SPEED, 2] = v2
    c[X, 1] = v0
    c[X, 2] = 0.5 * v1
    c[X, 3] = v2 / 3.0
    for k in range(1, 4):
        # the slip keeps its sign within a mode, so that path and displacement differ by a sign only
        c[PATH, k] = s * c[X, k]
    c[WORK, 1] = -push * v0
    c[WORK, 2] = -0.5 * (push * v1 + push_rate * v0)
    c[WORK, 3] = -(push * v2 + push_rate * v1) / 3.0
    c[WORK, 4] = -0.25 * push_rate * v2
    c[FRICTION, 1] = s * mu * weight * v0
    c[FRICTION, 2] = 0.5 * s * mu * (weight * v1 + weight_rate * v0)
    c[FRICTION, 3] = s * mu * (weight * v2 + weight_rate * v1) / 3.0
    c[FRICTION, 4] = 0.25 * s * mu * weight_rate * v2
    for k in range(degree + 1):
        g[SLIP, k] = s * c[SPEED, k]
        g[LIFT, k] = 0.0
    g[LIFT, 0] = weight
    g[LIFT, 1] = weight_rate
    return degree


@kernel(_SERIES)
def flight_series(y, f, p, order, c, g):
    """Write the series of a flight, with the gaps of both lower corners."""
    push = f[ALONG, 0] + f[ACROSS, 0]
    push_rate = f[ALONG, 1] + f[ACROSS, 1]
    up = f[UP, 0]
    up_rate = f[UP, 1]
    weight = p[GRAVITY] + up
    omega = y[OMEGA]
    spin = omega * omega
    arms = y.size
    # corner vectors as series: r_x' = r_y theta', r_y' = -r_x theta'
    for side in range(2):
        c[arms + 2 * side, 0], c[arms + 2 * side + 1, 0] = corner_position(side == 1, y[THETA], p)
    # displacement and work of a translation are of degree 3 and 4; a rotation adds terms (theta' dt)^k/k!, which
    # converge fast
    degree = 4
    if omega != 0.0:
        angle = abs(omega) * p[DT]
        term = angle**3
        while degree < order and term > SERIES_TOLERANCE:
            degree += 1
            term *= angle / degree
    freeze_states(c, OMEGA, y.size)
    for i in (THETA, X, SPEED, GAP_LEFT, RATE_LEFT, GAP_RIGHT, RATE_RIGHT, WORK):
        set_constant(c, i, degree, y[i])
    c[THETA, 1] = omega
    c[SPEED, 1] = -push
    c[SPEED, 2] = -0.5 * push_rate
    c[X, 1] = y[SPEED]
    c[X, 2] = -0.5 * push
    c[X, 3] = -push_rate / 6.0
    # rise of the centre of gravity from that of the right corner
    rise = y[RATE_RIGHT] + c[arms + 2, 0] * omega
    c[WORK, 1] = -push * y[SPEED] - up * rise
    c[WORK, 2] = 0.5 * (push * push - push_rate * y[SPEED] + up * weight - up_rate * rise)
    c[WORK, 3] = (1.5 * push * push_rate + up * 0.5 * up_rate + up_rate * weight) / 3.0
    c[WORK, 4] = 0.125 * (push_rate * push_rate + up_rate * up_rate)
    for side in range(2):
        gap, rate = (GAP_RIGHT, RATE_RIGHT) if side == 1 else (GAP_LEFT, RATE_LEFT)
        rx = arms + 2 * side
        ry = rx + 1
        in_contact = y[gap] == 0.0 and y[rate] == 0.0
        c[gap, 1] = y[rate]
        for k in range(degree):
            share = 1.0 / (k + 1)
            c[rx, k + 1] = omega * c[ry, k] * share
            c[ry, k + 1] = -omega * c[rx, k] * share
            acceleration = -spin * c[ry, k]
            if k == 0:
                acceleration -= weight
                if in_contact:
                    acceleration = clear_round_off(1.0, 0.0, acceleration, -up_rate, p)
            elif k == 1:
                acceleration -= up_rate
            c[rate, k + 1] = acceleration * share
            if k + 2 <= degree:
                c[gap, k + 2] = c[rate, k + 1] / (k + 2)
        row = LAND_RIGHT if side == 1 else LAND_LEFT
        for k in range(degree + 1):
            g[row, k] = c[gap, k]
    return degree


@kernel(_t.void(VECTOR, VECTOR, _t.int64, MATRIX, MATRIX), inline=True)
def release_slack(y, p, degree, c, g):
    """Write the remaining tenon engagement of the lower corner, m (extension; compare [Sugimoto2017]_ fig. 5)."""
    # the lower foot is held longest, and its tenon decides when both are free
    lower_gap = GAP_RIGHT if y[THETA] > 0.0 or (y[THETA] == 0.0 and y[OMEGA] >= 0.0) else GAP_LEFT
    for k in range(degree + 1):
        g[RELEASE, k] = -c[lower_gap, k]
    g[RELEASE, 0] += p[TENON]


@kernel(SKIP)
def skip(mode, acceleration, gains, sample, p):
    """Return the last sample up to which a body at rest stays at rest: the conditions are linear in the input."""
    if mode % TENON_OFFSET != REST:
        return sample
    gain_along = gains[ALONG]
    gain_across = gains[ACROSS]
    gain_up = gains[UP]
    # -lower G < a < upper G, and G > 0
    lower = p[ARM_RIGHT] / p[HEIGHT]
    upper = p[ARM_LEFT] / p[HEIGHT]
    if mode < TENON_OFFSET:
        lower = min(lower, p[MU])
        upper = min(upper, p[MU])
    samples = acceleration.shape[1]
    k = sample
    weight = p[GRAVITY]
    while k < samples:
        push = gain_along * acceleration[ALONG, k]
        if gain_across != 0.0:
            push += gain_across * acceleration[ACROSS, k]
        if gain_up != 0.0:
            weight = p[GRAVITY] + gain_up * acceleration[UP, k]
        if not (-lower * weight < push < upper * weight):
            break
        k += 1
    return max(k - 1, sample)
