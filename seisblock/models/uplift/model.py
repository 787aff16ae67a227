"""Hybrid model of a rigid block on unilateral corner springs.

Assumptions ([Okumura1987]_ section 2, extended to records)
    Vertical springs and dashpots of the corners act only in compression, u < 0; horizontal ones stay attached. Small rotations, no P-delta
    effect; torsion about the vertical is not excited and is omitted. The dashpot acts as long as u < 0, so that its force can be tensile
    for an instant before uplift.
Modes
    One bit per corner, set in contact: 15 is full contact, 0 free flight on the horizontal springs. 31 is the linear system with the base
    bonded to the springs, without guards, for the scale factor to uplift.
State
    Vertical displacement u of each corner from the spring's natural length, m, positive upwards; upward force of each corner over the
    mass, m/s^2; b theta_x and b theta_y, m; displacement of the centre of gravity along x and y, m; the rates of u, x and y. All relative
    to the ground. The four u of a rigid base satisfy u1 - u2 - u3 + u4 = 0, an invariant of the equations. Counted at resets: number of
    uplifts and landings of corners, and the corners that lifted first, one bit each.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from seisblock._jit import kernel
from seisblock.bodies.spring_block import CORNER_SIGNS, SpringBlock
from seisblock.core.typing import FloatArray
from seisblock.dynamics.model import Model
from seisblock.dynamics.model_api import OFF, RESET, SERIES

ALL_CORNERS, GLUED = 15, 31
"""All four corners in contact; linear system without uplift."""

ORDER = 20
"""Order of the series. The highest rocking frequency requires more than the engine's default of 12: for a vertical frequency of 10 Hz and a
sampling interval of 0.01 s, order 20 takes 1.4 us per sample, 12 takes 2.2 us and 28 takes 2.0 us. An exact matrix exponential per contact
state takes 0.1 us where no corner can open or close, but 14 % of the samples (91 % at 50 Hz) need the series for their interior."""

U, F, TURN_X, TURN_Y, X, Y, W, VX, VY, CHANGES, FIRST = 0, 4, 8, 9, 10, 11, 12, 16, 17, 18, 19
"""First of four corner displacements, first of four forces, b theta_x, b theta_y, x, y, first of four rates, rates of x and y, counts."""

N_STATES, TRACKED = 20, 10

CROSSING_TOLERANCE = 1e-12
"""Distance of a corner from its spring over the static settlement below which corners open or close together."""

ALPHA, GAMMA, KX, KY, KZ, CX, CY, CZ, JX, JY, GRAVITY = range(11)
"""Ratios H/b and a/b; 4 kx/m, 4 ky/m, kz/m, 1/s^2; the dashpots likewise, 1/s; moments of inertia over m b^2; gravity, m/s^2."""


@kernel(SERIES)
def _series(mode, y, f, p, order, c, g):
    """Write the series of corners and centre of gravity, [Okumura1987]_ eq. (1) with the springs in contact; return the degree."""
    alpha = p[ALPHA]
    gamma = p[GAMMA]
    for i in range(4):
        c[U + i, 0] = y[U + i]
        c[W + i, 0] = y[W + i]
    c[X, 0] = y[X]
    c[Y, 0] = y[Y]
    c[VX, 0] = y[VX]
    c[VY, 0] = y[VY]
    c[CHANGES, 1] = c[FIRST, 1] = OFF
    for k in range(order + 1):
        for i in range(4):
            # unilateral in the vertical direction only: an open corner keeps its horizontal spring
            c[F + i, k] = -(p[KZ] * c[U + i, k] + p[CZ] * c[W + i, k]) if (mode >> i) & 1 else 0.0
        # b theta_x, b theta_y and their rates from the corners (+,+), (+,-), (-,+), (-,-), as sums of differences, which are
        # exactly zero for equal corner motions
        turn_x = 0.5 * ((c[U, k] - c[U + 1, k]) + (c[U + 2, k] - c[U + 3, k]))
        turn_y = -0.5 * ((c[U, k] - c[U + 2, k]) + (c[U + 1, k] - c[U + 3, k])) / gamma
        c[TURN_X, k] = turn_x
        c[TURN_Y, k] = turn_y
        if k == order:
            break
        rate_x = 0.5 * ((c[W, k] - c[W + 1, k]) + (c[W + 2, k] - c[W + 3, k]))
        rate_y = -0.5 * ((c[W, k] - c[W + 2, k]) + (c[W + 1, k] - c[W + 3, k])) / gamma
        # the springs attach at the base, half a height below the centre of gravity: [Okumura1987]_ eq. (1), its
        # second line corrected to y + (H/2) theta_x
        push_x = -p[KX] * (c[X, k] - 0.5 * alpha * turn_y) - p[CX] * (c[VX, k] - 0.5 * alpha * rate_y)
        push_y = -p[KY] * (c[Y, k] + 0.5 * alpha * turn_x) - p[CY] * (c[VY, k] + 0.5 * alpha * rate_x)
        lift = c[F, k] + c[F + 1, k] + c[F + 2, k] + c[F + 3, k]
        moment_x = 0.5 * ((c[F, k] - c[F + 1, k]) + (c[F + 2, k] - c[F + 3, k])) + 0.5 * alpha * push_y
        moment_y = -0.5 * gamma * ((c[F, k] - c[F + 2, k]) + (c[F + 1, k] - c[F + 3, k])) - 0.5 * alpha * push_x
        # constants enter the series at order 0, the linear ground motion at orders 0 and 1
        if k == 0:
            lift -= p[GRAVITY]
        step = 1.0 / (k + 1)
        c[X, k + 1] = c[VX, k] * step
        c[Y, k + 1] = c[VY, k] * step
        c[VX, k + 1] = (push_x - f[0, k] if k < 2 else push_x) * step
        c[VY, k + 1] = (push_y - f[1, k] if k < 2 else push_y) * step
        if k < 2:
            lift -= f[2, k]
        lean_x = 0.5 * moment_x / p[JX]
        lean_y = 0.5 * gamma * moment_y / p[JY]
        for i in range(4):
            c[U + i, k + 1] = c[W + i, k] * step
        # each corner follows from the rigid motion of the base; the four stay compatible at every order
        c[W, k + 1] = (lift + lean_x - lean_y) * step
        c[W + 1, k + 1] = (lift - lean_x - lean_y) * step
        c[W + 2, k + 1] = (lift + lean_x + lean_y) * step
        c[W + 3, k + 1] = (lift - lean_x + lean_y) * step
    # bonded base: the linear run has no event, and its extrema scale with the motion
    if mode == GLUED:
        for i in range(4):
            g[i, 0] = OFF
        return order
    for i in range(4):
        # a closed corner fires as u rises above zero, an open one as it falls below
        sign = -1.0 if (mode >> i) & 1 else 1.0
        for k in range(order + 1):
            g[i, k] = sign * c[U + i, k]
    return order


@kernel(RESET)
def _reset(mode, guard, y, f, p):
    """Open or close corner `guard` and those that cross with it: positions and rates are continuous, dashpot forces jump."""
    target_mode = mode
    for i in range(4):
        # round-off of a crossing must neither cause a crossing back nor separate corners with equal motion
        if i == guard or abs(y[U + i]) < CROSSING_TOLERANCE * p[GRAVITY] / (4.0 * p[KZ]):
            in_contact = (mode >> i) & 1
            y[U + i] = 0.0
            if i == guard or (in_contact and y[W + i] > 0.0) or (not in_contact and y[W + i] < 0.0):
                target_mode ^= 1 << i
                y[F + i] = 0.0 if in_contact else -p[CZ] * y[W + i]
                y[CHANGES] += 1.0
    # only the first event counts: later uplifts follow from a response that is no longer linear
    if y[FIRST] == 0.0:
        y[FIRST] = mode & ~target_mode
    return target_mode


def contact_name(mode: int) -> str:
    """Return the name of a contact state."""
    corners = [str(i + 1) for i in range(4) if mode >> i & 1]
    return {4: "on all corners", 0: "in the air"}.get(len(corners), f"on corner{'s' if len(corners) > 1 else ''} {' '.join(corners)}")


UPLIFT = Model(
    "uplift",
    _series,
    _reset,
    (
        *(f"u{i}" for i in (1, 2, 3, 4)),
        *(f"f{i}" for i in (1, 2, 3, 4)),
        "b theta_x",
        "b theta_y",
        "x",
        "y",
        *(f"w{i}" for i in (1, 2, 3, 4)),
        "vx",
        "vy",
        "changes",
        "first",
    ),
    tuple(f"corner {i}" for i in (1, 2, 3, 4)),
    (*(contact_name(mode) for mode in range(ALL_CORNERS + 1)), *("",) * (GLUED - ALL_CORNERS - 1), "glued"),
    tracked=TRACKED,
    order=ORDER,
    has_floors=True,
)


UPLIFT_REPEAT = replace(UPLIFT, order=ORDER - 3)
"""Same model with different round-off, to detect results that round-off decides."""


def parameters(body: SpringBlock, gravity: float) -> FloatArray:
    """Return the parameter vector of the model ([Okumura1987]_); corner dashpots c = 2 zeta k / omega by direction (derived here).

    Appended are the minimum magnitudes ("floors") of the states in the convergence test, from the static settlement.
    """
    wx, wy, wz = body.omega
    two_zeta = 2.0 * body.damping
    # vibrations decay to round-off beside the static settlement; without floors their series would demand ever
    # smaller steps
    floors = np.full(N_STATES, body.static_settlement(gravity))
    floors[F : F + 4] = gravity / 4.0
    floors[W : VY + 1] *= wz
    return np.array(
        [
            body.alpha,
            body.gamma,
            wx * wx,
            wy * wy,
            wz * wz / 4.0,
            two_zeta * wx,
            two_zeta * wy,
            two_zeta * wz / 4.0,
            body.inertia[0],
            body.inertia[1],
            gravity,
            *floors,
        ]
    )


def static_state(body: SpringBlock, gravity: float) -> FloatArray:
    """Return the state of static equilibrium, (20,)."""
    state = np.zeros(N_STATES)
    state[U : U + 4] = -body.static_settlement(gravity)
    state[F : F + 4] = gravity / 4.0
    return state


def rotations(states: FloatArray, body: SpringBlock) -> tuple[FloatArray, FloatArray]:
    """Return theta_x and theta_y, right-handed, rad, from rows of states."""
    corner = states[:, U : U + 4]
    sx, sy = np.array(CORNER_SIGNS, dtype=np.float64).T
    return 0.5 * corner @ sy / body.depth, -0.5 * corner @ sx / body.width
