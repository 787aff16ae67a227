"""Landing rules of the two-layer block, and lift-off from a corner.

Rules
    ``paper``: tilt and angular velocity are continuous and the corner starts without slip ([Sugimoto2017]_ section 3.10; its table 1
    agrees). The horizontal velocity of the foot is removed at any friction demand, and the energy may even increase.
    ``friction``: plastic impulse at the corner along Routh's path with at most kinetic friction: friction opposes the slip, a corner that
    stops sticks or reverses, and the impulse ends when the corner's downward velocity is zero. Sliding continues with the remaining slip
    velocity ([WangMason1992]_). When the tilt returns to zero the base lands plastically on both corners with the same friction and slides
    to rest ([Moreau1988]_; the paper's model ends there).
    ``printed``: ``paper`` with z'' of the opposite sign in [Sugimoto2017]_ eqs. (12a), (12c), as printed, and half of the accelerations of
    tilt and slip, which give the durations of its tables 1 and 2. For comparison with them only.
"""

from __future__ import annotations

import numpy as np

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import VECTOR
from seisblock.models.jump.modes import (
    ALPHA,
    CENTROID_INERTIA,
    DROP,
    ENERGY_AFTER,
    ENERGY_BEFORE,
    FRICTION_NEEDED,
    HALF_WIDTH,
    HEIGHT,
    MASS,
    MU_KINETIC,
    OMEGA,
    RADIUS,
    SIDE,
    THETA,
    VX,
    VY,
    X,
    Y,
)

_t = types()


@kernel(_t.void(_t.int64, VECTOR, VECTOR), inline=True)
def touch_down(corner, y, p):
    """Convert the flight state into that of the landed corner, without slip ([Sugimoto2017]_ section 3.10)."""
    side = 2 * corner - 1
    psi = 0.5 * np.pi - p[ALPHA] - side * y[THETA]
    # displacement of the foot instead of the centroid; the two agree at zero tilt
    y[X] += side * (p[RADIUS] * np.cos(psi) - p[HALF_WIDTH])
    y[VX] = 0.0
    y[Y] = 0.0
    y[VY] = 0.0


@kernel(_t.float64(_t.float64, _t.float64, _t.float64, VECTOR), inline=True)
def _energy(vx, vy, omega, p):
    """Return the kinetic energy relative to the ground, J."""
    return 0.5 * (p[MASS] * (vx * vx + vy * vy) + p[CENTROID_INERTIA] * omega * omega)


@kernel(_t.void(_t.int64, _t.float64, _t.float64, _t.float64, VECTOR, VECTOR), inline=True)
def record_landing(corner, vx, vy, omega, y, p):
    """Record friction demand and energies of a landing in the state, from the flight velocities before it ([Sugimoto2017]_ section 3.10).

    The friction demand is abs(P_x)/P_y of the impulse, infinite for a tensile P_y. Of several landings the largest demand is stored, and
    the energies of the landing with the largest ratio after/before.
    """
    side = 2 * corner - 1
    psi = 0.5 * np.pi - p[ALPHA] - side * y[THETA]
    tilting = -side * y[OMEGA]
    # velocity of the centroid after the landing, from that of the foot and the spin
    horizontal = y[VX] + side * p[RADIUS] * np.sin(psi) * tilting
    vertical = p[RADIUS] * np.cos(psi) * tilting
    push = horizontal - vx
    lift = vertical - vy
    friction = 0.0
    if push != 0.0:
        friction = abs(push) / lift if lift > 0.0 else np.inf
    energy_before = _energy(vx, vy, omega, p)
    energy_after = _energy(horizontal, vertical, y[OMEGA], p)
    energy_ratio = energy_after / energy_before if energy_before > 0.0 else 0.0
    # SIDE is 0 before the first landing
    if y[SIDE] == 0.0 or energy_ratio > (y[ENERGY_AFTER] / y[ENERGY_BEFORE] if y[ENERGY_BEFORE] > 0.0 else 0.0):
        y[ENERGY_BEFORE] = energy_before
        y[ENERGY_AFTER] = energy_after
    y[FRICTION_NEEDED] = max(y[FRICTION_NEEDED], friction)
    y[SIDE] = side


@kernel(_t.void(_t.int64, VECTOR, VECTOR), inline=True)
def take_off(corner, y, p):
    """Convert the state about a corner into a flight state: position and velocity of the centroid."""
    side = 2 * corner - 1
    psi = 0.5 * np.pi - p[ALPHA] - side * y[THETA]
    tilting = -side * y[OMEGA]
    y[X] -= side * (p[RADIUS] * np.cos(psi) - p[HALF_WIDTH])
    y[VX] += side * p[RADIUS] * np.sin(psi) * tilting
    y[Y] = p[RADIUS] * np.sin(psi) - p[HEIGHT] - p[DROP]
    y[VY] = p[RADIUS] * np.cos(psi) * tilting


@kernel(_t.void(_t.int64, VECTOR, VECTOR), inline=True)
def touch_down_by_friction(corner, y, p):
    """Convert the flight state into that of the landed corner, by a plastic impulse within the friction cone.

    Per unit mass, with the corner at (rx, ry) from the centroid and w the clockwise spin, (dx', dy', dw) = (T, P, (ry T - rx P)/k^2);
    u is the corner's upward velocity, v its velocity along the ground (derived here; [WangMason1992]_).
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
    # the state counts the spin counter-clockwise, the impulse equations clockwise
    w = -y[OMEGA]
    u = y[VY] - rx * w
    v = y[VX] + ry * w
    # at most three segments: slip, stop, then stick or reverse slip
    for _ in range(3):
        if v != 0.0:
            friction_ratio = -np.sign(v) * mu
        elif abs(a_tn) <= mu * a_tt:
            # ratio T/P that leaves no slip; it sticks where this lies within the cone
            friction_ratio = -a_tn / a_tt
        else:
            friction_ratio = -np.sign(a_tn) * mu
        rise = a_nn + a_tn * friction_ratio
        gain = a_tn + a_tt * friction_ratio
        # normal impulses at which the corner stops falling, and at which its slip stops
        # where friction presses the corner down (rise <= 0) the impulse cannot end before the slip has stopped
        end_impulse = -u / rise if rise > 0.0 else np.inf
        stop_impulse = -v / gain if v * gain < 0.0 else np.inf
        impulse = max(min(end_impulse, stop_impulse), 0.0)
        w += (ry * friction_ratio - rx) / k2 * impulse
        u += rise * impulse
        if stop_impulse < end_impulse:
            v = 0.0
            continue
        # exact zero for a sticking corner, whose velocity change is round-off
        v = 0.0 if v == 0.0 and abs(a_tn) <= mu * a_tt else v + gain * impulse
        break
    # `touch_down` clears the slip velocity, so that the remaining one is entered after it
    touch_down(corner, y, p)
    y[OMEGA] = -w
    y[VX] = v


@kernel(_t.void(VECTOR, VECTOR), inline=True)
def land_flat_by_friction(y, p):
    """Convert the state about a corner at zero tilt into flat sliding after a plastic impact of the base ([Moreau1988]_)."""
    # the centroid stops from its fall speed about the corner; friction changes its horizontal velocity by at most mu' times that
    fall_speed = p[HALF_WIDTH] * abs(y[OMEGA])
    # the base takes over the horizontal velocity of the centroid, which leads or lags the foot by h omega
    slip_speed = y[VX] - p[HEIGHT] * y[OMEGA]
    y[THETA] = 0.0
    y[OMEGA] = 0.0
    y[VX] = np.sign(slip_speed) * max(abs(slip_speed) - p[MU_KINETIC] * fall_speed, 0.0)
