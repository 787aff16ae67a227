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
    mass, m/s^2; b theta_x and b theta_y, m; displacement of the centre of gravity along x and y, and above static equilibrium, m; the rates
    of the last five. All relative to the ground. Counted at resets: number of uplifts and landings of corners, and the corners that lifted
    first, one bit each. Of displacements and forces only the maxima are tracked.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from seisblock._jit import kernel
from seisblock.bodies.spring_block import CORNER_SIGNS, SpringBlock
from seisblock.core.typing import FloatArray
from seisblock.dynamics.hybrid import allocate_scratch
from seisblock.dynamics.model import Model
from seisblock.dynamics.model_api import RESET
from seisblock.models.uplift.advance import advance, corner_rate
from seisblock.models.uplift.constants import (
    ALL_CORNERS,
    CHANGES,
    CZ,
    FIRST,
    GLUED,
    N_STATES,
    SETTLEMENT,
    TRACKED,
    F,
    U,
)
from seisblock.models.uplift.propagator import MAX_DEGREE, SIZE, fill_propagators, step_parameters
from seisblock.models.uplift.series import taylor

CROSSING_TOLERANCE = 1e-12
"""Distance of a corner from its spring over the static settlement below which corners open or close together."""


@kernel(RESET)
def _reset(mode, guard, y, f, p):
    """Open or close corner `guard` and those that cross with it: positions and rates are continuous, dashpot forces jump."""
    target_mode = mode
    for i in range(4):
        # round-off of a crossing must neither cause a crossing back nor separate corners with equal motion
        if i == guard or abs(y[U + i]) < CROSSING_TOLERANCE * p[SETTLEMENT]:
            in_contact = (mode >> i) & 1
            y[U + i] = 0.0
            rate = corner_rate(p, y, i)
            if i == guard or (in_contact and rate > 0.0) or (not in_contact and rate < 0.0):
                target_mode ^= 1 << i
                y[F + i] = 0.0 if in_contact else -p[CZ] * rate
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
    taylor,
    _reset,
    (
        *(f"u{i}" for i in (1, 2, 3, 4)),
        *(f"f{i}" for i in (1, 2, 3, 4)),
        "b theta_x",
        "b theta_y",
        "x",
        "y",
        "z",
        "b omega_x",
        "b omega_y",
        "vx",
        "vy",
        "vz",
        "changes",
        "first",
    ),
    tuple(f"corner {i}" for i in (1, 2, 3, 4)),
    (*(contact_name(mode) for mode in range(ALL_CORNERS + 1)), *("",) * (GLUED - ALL_CORNERS - 1), "glued"),
    tracked=TRACKED,
    order=MAX_DEGREE,
    advance=advance,
)


def parameters(bodies: Sequence[SpringBlock], gravity: float, dt: float) -> FloatArray:
    """Return the parameters of the model, one row per body ([Okumura1987]_); dashpots c = 2 zeta k / omega by direction (derived here).

    Appended are the propagators for samples `dt` apart.
    """
    rows = []
    for body in bodies:
        wx, wy, wz = body.omega
        two_zeta = 2.0 * body.damping
        damping = two_zeta * wx, two_zeta * wy, two_zeta * wz / 4.0
        jx, jy, _ = body.inertia
        lever = math.sqrt(1.0 + 0.25 * body.gamma**2 / jy + 0.25 / jx)
        stiffness = wx * wx, wy * wy, wz * wz / 4.0
        geometry = jx, jy, 1.0 / jx, 1.0 / jy, jx**-0.5, jy**-0.5, gravity, body.static_settlement(gravity), lever
        rows.append([0.5 * body.alpha, 0.5 * body.gamma, *stiffness, *damping, *geometry])
    p = np.hstack([np.array(rows), step_parameters(bodies, dt), np.empty((len(rows), (ALL_CORNERS + 1) * SIZE))])
    fill_propagators(UPLIFT.pointers[1], p, allocate_scratch(UPLIFT.shape, N_STATES, 3), np.empty(N_STATES), np.empty(N_STATES))
    return p


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
