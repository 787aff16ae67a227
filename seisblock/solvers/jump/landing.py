"""How a corner that comes down is stopped, and how it leaves the ground again.

The rules
    ``paper``: tilt and angular velocity stay, and the corner starts with zero slip ([Sugimoto2017]_ 3.10; the table agrees). What the
    foot's horizontal velocity was does not matter, so that the friction this takes has no limit, and energy may even grow.
    ``friction``: a plastic impulse at the corner, tangential to normal at most the kinetic friction, along Routh's path: while the corner
    slips friction opposes it, when it stops it sticks or slips on, and the impulse ends when the corner goes down no more. Slip starts
    with what is left ([WangMason1992]_). When the tilt is back at zero the base lands plastically on both corners, with the same friction,
    and slides to rest ([Moreau1988]_; the paper ends there).
"""

from __future__ import annotations

import numpy as np

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import VECTOR
from seisblock.solvers.jump.modes import (
    AFTER,
    ALPHA,
    BEFORE,
    CENTROID_INERTIA,
    DROP,
    HALF_WIDTH,
    HEIGHT,
    MASS,
    MU_KINETIC,
    NEEDED,
    OMEGA,
    RADIUS,
    SIDE,
    THETA,
    VX,
    VY,
    X,
    Y,
)

RULES = ("paper", "friction")
"""How a corner that lands is stopped."""

_t = types()


@kernel(_t.void(_t.int64, VECTOR, VECTOR), inline=True)
def touch_down(corner, y, p):
    """Turn the state of the flight into that of the corner that touches: where it is, with zero slip ([Sugimoto2017]_ 3.10)."""
    side = 2 * corner - 1
    psi = 0.5 * np.pi - p[ALPHA] - side * y[THETA]
    y[X] += side * (p[RADIUS] * np.cos(psi) - p[HALF_WIDTH])
    y[VX] = 0.0
    y[Y] = 0.0
    y[VY] = 0.0


@kernel(_t.float64(_t.float64, _t.float64, _t.float64, VECTOR), inline=True)
def _energy(vx, vy, omega, p):
    """Return the kinetic energy relative to the ground, J."""
    return 0.5 * (p[MASS] * (vx * vx + vy * vy) + p[CENTROID_INERTIA] * omega * omega)


@kernel(_t.void(_t.int64, _t.float64, _t.float64, _t.float64, VECTOR, VECTOR), inline=True)
def take_account(corner, vx, vy, omega, y, p):
    """Keep what a landing took that turned these velocities of the flight into those of a state about a corner ([Sugimoto2017]_ 3.10).

    The friction it needed is abs(P_x)/P_y of its impulse, infinite where the ground would have to pull. Of several landings the largest is
    kept, and the energies of the one that kept the largest share.
    """
    side = 2 * corner - 1
    psi = 0.5 * np.pi - p[ALPHA] - side * y[THETA]
    tilting = -side * y[OMEGA]
    along = y[VX] + side * p[RADIUS] * np.sin(psi) * tilting
    up = p[RADIUS] * np.cos(psi) * tilting
    push = along - vx
    lift = up - vy
    needed = 0.0
    if push != 0.0:
        needed = abs(push) / lift if lift > 0.0 else np.inf
    before = _energy(vx, vy, omega, p)
    after = _energy(along, up, y[OMEGA], p)
    share = after / before if before > 0.0 else 0.0
    if y[SIDE] == 0.0 or share > (y[AFTER] / y[BEFORE] if y[BEFORE] > 0.0 else 0.0):
        y[BEFORE] = before
        y[AFTER] = after
    y[NEEDED] = max(y[NEEDED], needed)
    y[SIDE] = side


@kernel(_t.void(_t.int64, VECTOR, VECTOR), inline=True)
def take_off(corner, y, p):
    """Turn the state about a corner into that of the flight: position and velocity of the centroid."""
    side = 2 * corner - 1
    psi = 0.5 * np.pi - p[ALPHA] - side * y[THETA]
    tilting = -side * y[OMEGA]
    y[X] -= side * (p[RADIUS] * np.cos(psi) - p[HALF_WIDTH])
    y[VX] += side * p[RADIUS] * np.sin(psi) * tilting
    y[Y] = p[RADIUS] * np.sin(psi) - p[HEIGHT] - p[DROP]
    y[VY] = p[RADIUS] * np.cos(psi) * tilting


@kernel(_t.void(_t.int64, VECTOR, VECTOR), inline=True)
def touch_down_by_friction(corner, y, p):
    """Turn the state of the flight into that of the corner that touches, after a plastic impulse within the cone of friction.

    Per unit mass, with the corner at (rx, ry) from the centroid and w the clockwise spin, (dx', dy', dw) = (T, P, (ry T - rx P)/k^2);
    u is the corner's velocity upwards, v that along the ground (derived here; [WangMason1992]_).
    """
    side = 2 * corner - 1
    psi = 0.5 * np.pi - p[ALPHA] - side * y[THETA]
    rx = side * p[RADIUS] * np.cos(psi)
    ry = -p[RADIUS] * np.sin(psi)
    k2 = p[CENTROID_INERTIA] / p[MASS]
    a_nn = 1.0 + rx * rx / k2
    a_tt = 1.0 + ry * ry / k2
    a_tn = -rx * ry / k2
    mu = p[MU_KINETIC]
    w = -y[OMEGA]
    u = y[VY] - rx * w
    v = y[VX] + ry * w
    # at most: slip, stop, slip on the other way or stick
    for _ in range(3):
        if v != 0.0:
            share = -np.sign(v) * mu
        elif abs(a_tn) <= mu * a_tt:
            share = -a_tn / a_tt
        else:
            share = -np.sign(a_tn) * mu
        rise = a_nn + a_tn * share
        gain = a_tn + a_tt * share
        ending = -u / rise if rise > 0.0 else np.inf
        stopping = -v / gain if v * gain < 0.0 else np.inf
        pushed = max(min(ending, stopping), 0.0)
        w += (ry * share - rx) / k2 * pushed
        u += rise * pushed
        if stopping < ending:
            v = 0.0
            continue
        # a corner that sticks gains nothing but round-off
        v = 0.0 if v == 0.0 and abs(a_tn) <= mu * a_tt else v + gain * pushed
        break
    touch_down(corner, y, p)
    y[OMEGA] = -w
    y[VX] = v


@kernel(_t.void(VECTOR, VECTOR), inline=True)
def lie_down_by_friction(y, p):
    """Turn the state about a corner, its tilt back at zero, into that of a base that slides flat with what is left ([Moreau1988]_)."""
    falling = p[HALF_WIDTH] * abs(y[OMEGA])
    along = y[VX] - p[HEIGHT] * y[OMEGA]
    y[THETA] = 0.0
    y[OMEGA] = 0.0
    y[VX] = np.sign(along) * max(abs(along) - p[MU_KINETIC] * falling, 0.0)
