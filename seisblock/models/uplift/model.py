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

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from seisblock._jit import kernel
from seisblock.bodies.spring_block import CORNER_SIGNS, SpringBlock
from seisblock.core.typing import FloatArray
from seisblock.dynamics.model import Model
from seisblock.dynamics.model_api import OFF, RESET, SERIES
from seisblock.models.uplift.constants import (
    ALL_CORNERS,
    CHANGES,
    CZ,
    FIRST,
    GAMMA,
    GLUED,
    GRAVITY,
    JX,
    JY,
    KZ,
    N_STATES,
    TRACKED,
    TURN_X,
    TURN_Y,
    VX,
    VY,
    F,
    U,
    W,
    X,
    Y,
)
from seisblock.models.uplift.propagator import coordinates, propagate, propagators, restoring

ORDER = 20
"""Order of the series. The highest rocking frequency requires more than the engine's default of 12: for a vertical frequency of 10 Hz and a
sampling interval of 0.01 s, order 20 takes two thirds of the time of 12 and of 28."""

CROSSING_TOLERANCE = 1e-12
"""Distance of a corner from its spring over the static settlement below which corners open or close together."""


@kernel(SERIES)
def _series(mode, y, f, p, order, c, g):
    """Write the series of corners and centre of gravity, [Okumura1987]_ eq. (1) with the springs in contact; return the degree."""
    closed, half_gamma, kz, cz = mode & ALL_CORNERS, 0.5 * p[GAMMA], p[KZ], p[CZ]
    z, b, a, x, y_k, z_rate, b_rate, a_rate, x_rate, y_rate = coordinates(y, p)
    per_jx, per_jy = 1.0 / p[JX], 1.0 / p[JY]
    c[CHANGES, 1] = c[FIRST, 1] = OFF
    for k in range(order + 1):
        for i in range(4):
            # each corner follows from the rigid motion of the base; the four stay compatible at every order
            sx, sy = half_gamma if i < 2 else -half_gamma, 0.5 if i % 2 == 0 else -0.5
            u, w = z - sx * b + sy * a, z_rate - sx * b_rate + sy * a_rate
            if k == 0:
                # a reset leaves corners at exactly zero
                u, w = y[U + i], y[W + i]
            # unilateral in the vertical direction only: an open corner keeps its horizontal spring
            c[U + i, k], c[W + i, k], c[F + i, k] = u, w, -(kz * u + cz * w) if (closed >> i) & 1 else 0.0
        c[TURN_Y, k], c[TURN_X, k], c[X, k], c[Y, k], c[VX, k], c[VY, k] = b, a, x, y_k, x_rate, y_rate
        step = 1.0 / (k + 1)
        z_next, b_next, a_next, x_next, y_next = restoring(
            p, per_jx, per_jy, closed, z, b, a, x, y_k, z_rate, b_rate, a_rate, x_rate, y_rate
        )
        z, b, a, x, y_k = z_rate * step, b_rate * step, a_rate * step, x_rate * step, y_rate * step
        # constants enter the series at order 0, the linear ground motion at orders 0 and 1
        if k == 0:
            z_next -= p[GRAVITY]
        if k < 2:
            z_next, x_next, y_next = z_next - f[2, k], x_next - f[0, k], y_next - f[1, k]
        z_rate, b_rate, a_rate, x_rate, y_rate = z_next * step, b_next * step, a_next * step, x_next * step, y_next * step
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
    skip=propagate,
    has_floors=True,
    propagates=True,
)


UPLIFT_REPEAT = replace(UPLIFT, order=ORDER - 3)
"""Same model with different round-off, to detect results that round-off decides."""


def parameters(bodies: Sequence[SpringBlock], gravity: float, dt: float) -> FloatArray:
    """Return the parameters of the model, one row per body ([Okumura1987]_); dashpots c = 2 zeta k / omega by direction (derived here).

    Appended are the propagators for samples `dt` apart, and the minimum magnitudes ("floors") of the states in the convergence test, from
    the static settlement.
    """
    rows = []
    for body in bodies:
        wx, wy, wz = body.omega
        two_zeta = 2.0 * body.damping
        damping = two_zeta * wx, two_zeta * wy, two_zeta * wz / 4.0
        rows.append([body.alpha, body.gamma, wx * wx, wy * wy, wz * wz / 4.0, *damping, body.inertia[0], body.inertia[1], gravity])
    # vibrations decay to round-off beside the static settlement; without floors their series would demand ever
    # smaller steps
    floors = np.repeat(np.array([[body.static_settlement(gravity)] for body in bodies]), N_STATES, axis=1)
    floors[:, F : F + 4] = gravity / 4.0
    floors[:, W : VY + 1] *= np.array([[body.omega[2]] for body in bodies])
    return np.hstack([np.array(rows), propagators(bodies, dt), floors])


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
