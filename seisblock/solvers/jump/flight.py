"""Flight of the two-layer block, its landing on a lower corner, and the motion about that corner ([Sugimoto2017]_ 3.8-3.11).

Assumptions
    Landing keeps tilt and angular velocity, and the corner that touches starts with zero slip. Whether it slips is decided once, at
    landing, by static friction; a corner that slips stays under kinetic friction, and is held where kinetic friction can
    hold it when its slip comes to rest. The chain ends when the tilt returns to zero, or at pi/2 (overturned).
State
    theta (counter-clockwise) and omega; x, vx: displacement of the centroid and its rate in flight, of the foot that touches
    afterwards, both relative to the ground; y, vy: rise of the centroid above its height at rest, and its rate, in flight.
Modes
    FLIGHT; then for each corner STICK (no slip), HOLD (slip at rest under kinetic friction), BACK and FORTH (slip to -x, +x).
Symbols
    psi = beta + tau with beta = pi/2 - alpha, and tau the tilt towards the corner that touches: the centroid is at
    (-R cos psi, R sin psi) from the right corner. Motion about the left corner is its mirror image.
"""

from __future__ import annotations

import numpy as np

from seisblock._jit import kernel, types
from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.dynamics.arrays import MATRIX, VECTOR
from seisblock.dynamics.contract import OFF, RESET, SERIES
from seisblock.dynamics.model import Model
from seisblock.dynamics.series import product, quotient, sine_cosine
from seisblock.typing import FloatArray, IntArray

THETA, OMEGA, X, VX, Y, VY = range(6)
PSI, SIN, COS, TAU1, TAU2, SPEED2, SINK, WEIGHT, INERTIA, NORMAL = range(6, 16)
LEFT, RIGHT = 0, 1
FLIGHT = 0
STICK, HOLD, BACK, FORTH = range(4)
JAMMED, OVERTURNED, END = range(-3, 0)
ALPHA, RADIUS, HALF_WIDTH, HEIGHT, MASS, CENTROID_INERTIA, GRAVITY, MU, MU_KINETIC, DROP, DT = range(11)
TOUCH, TOPPLE, LIFT, FRICTION, FRICTION_TOO = range(5)

_t = types()


@kernel(_t.int64(_t.int64, _t.int64), inline=True)
def landed(corner, kind):
    """Return the mode of a kind of motion about a corner ([Sugimoto2017]_)."""
    return 1 + 2 * kind + corner


@kernel(_t.int64(_t.int64), inline=True)
def corner_of(mode):
    """Return the corner that touches ([Sugimoto2017]_)."""
    return (mode - 1) % 2


@kernel(_t.int64(_t.int64), inline=True)
def kind_of(mode):
    """Return the kind of motion about the corner ([Sugimoto2017]_)."""
    return (mode - 1) // 2


@kernel(_t.int64(VECTOR, MATRIX, VECTOR, _t.int64, MATRIX, MATRIX), inline=True)
def _flight_series(y, f, p, order, c, g):
    """Write eqs. (9), which are cubics, and the heights of both lower corners above the ground as guards (eq. (11))."""
    c[THETA, 0], c[THETA, 1], c[THETA, 2], c[THETA, 3] = y[THETA], y[OMEGA], 0.0, 0.0
    c[OMEGA, 0], c[OMEGA, 1], c[OMEGA, 2], c[OMEGA, 3] = y[OMEGA], 0.0, 0.0, 0.0
    c[X, 0], c[X, 1], c[X, 2], c[X, 3] = y[X], y[VX], -f[0, 0] / 2, -f[0, 1] / 6
    c[VX, 0], c[VX, 1], c[VX, 2], c[VX, 3] = y[VX], -f[0, 0], -f[0, 1] / 2, 0.0
    c[Y, 0], c[Y, 1], c[Y, 2], c[Y, 3] = y[Y], y[VY], -p[GRAVITY] / 2, 0.0
    c[VY, 0], c[VY, 1], c[VY, 2], c[VY, 3] = y[VY], -p[GRAVITY], 0.0, 0.0
    g[LIFT, 0] = g[FRICTION, 0] = g[FRICTION_TOO, 0] = OFF
    dt = p[DT]
    lowest = min(y[Y], y[Y] + dt * (y[VY] - dt * p[GRAVITY] / 2)) + p[DROP]
    if lowest > p[HALF_WIDTH] * (abs(y[THETA]) + abs(y[OMEGA]) * dt):
        # too high for a corner to reach the ground within a sample, whatever the tilt
        g[LEFT, 0] = g[RIGHT, 0] = OFF
        return 3
    c[SIN, 0], c[COS, 0] = np.sin(y[THETA]), np.cos(y[THETA])
    for k in range(1, order + 1):
        c[SIN, k] = y[OMEGA] * c[COS, k - 1] / k
        c[COS, k] = -y[OMEGA] * c[SIN, k - 1] / k
    for k in range(order + 1):
        if k > 3:
            for i in range(6):
                c[i, k] = 0.0
        centre = c[Y, k] - p[HEIGHT] * c[COS, k]
        g[LEFT, k] = centre - p[HALF_WIDTH] * c[SIN, k]
        g[RIGHT, k] = centre + p[HALF_WIDTH] * c[SIN, k]
    g[LEFT, 0] += p[HEIGHT] + p[DROP]
    g[RIGHT, 0] += p[HEIGHT] + p[DROP]
    return order


@kernel(SERIES)
def flight_series(mode, y, f, p, order, c, g):
    """Write the series of the flight, or of the motion about the corner that touches ([Sugimoto2017]_)."""
    if mode == FLIGHT:
        return _flight_series(y, f, p, order, c, g)
    side = 2 * corner_of(mode) - 1
    kind = kind_of(mode)
    slip = 0.0
    if kind == BACK:
        slip = -side
    elif kind == FORTH:
        slip = side
    slides = slip != 0.0
    r = p[RADIUS]
    friction = slip * p[MU_KINETIC]
    c[THETA, 0], c[OMEGA, 0] = y[THETA], y[OMEGA]
    c[PSI, 0] = 0.5 * np.pi - p[ALPHA] - side * y[THETA]
    c[SIN, 0], c[COS, 0] = np.sin(c[PSI, 0]), np.cos(c[PSI, 0])
    c[TAU1, 0] = -side * y[OMEGA]
    c[X, 0], c[VX, 0], c[Y, 0], c[VY, 0] = y[X], y[VX], y[Y], y[VY]
    corner_inertia = p[CENTROID_INERTIA] + p[MASS] * r * r
    for k in range(order + 1):
        shake = side * f[0, k] if k < 2 else 0.0
        c[SPEED2, k] = product(c[TAU1], c[TAU1], k)
        c[SINK, k] = -r * product(c[SIN], c[SPEED2], k)
        if k == 0:
            c[SINK, 0] += p[GRAVITY]
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
            shaken = side * (f[0, 0] * c[SIN, k] + (f[0, 1] * c[SIN, k - 1] if k > 0 else 0.0))
            c[TAU2, k] = -p[MASS] * r * (p[GRAVITY] * c[COS, k] + shaken) / corner_inertia
            c[NORMAL, k] = p[MASS] * (c[SINK, k] + r * product(c[COS], c[TAU2], k))
        # what the foot must be pushed with to follow the ground, per unit mass; the foot's acceleration is what is missing of it
        need = shake + r * (product(c[SIN], c[TAU2], k) + product(c[COS], c[SPEED2], k))
        if slides:
            g[FRICTION, k] = slip * side * c[VX, k]
            g[FRICTION_TOO, k] = 0.0
            foot = side * (-friction * c[NORMAL, k] / p[MASS] - need)
        else:
            g[FRICTION, k] = p[MU_KINETIC] * c[NORMAL, k] / p[MASS] - need
            g[FRICTION_TOO, k] = p[MU_KINETIC] * c[NORMAL, k] / p[MASS] + need
            foot = 0.0
        g[TOUCH, k] = -side * c[THETA, k]
        g[TOPPLE, k] = side * c[THETA, k]
        g[LIFT, k] = c[NORMAL, k]
        if k == order:
            break
        c[THETA, k + 1] = c[OMEGA, k] / (k + 1)
        c[OMEGA, k + 1] = -side * c[TAU2, k] / (k + 1)
        c[TAU1, k + 1] = c[TAU2, k] / (k + 1)
        c[PSI, k + 1] = c[TAU1, k] / (k + 1)
        c[X, k + 1] = c[VX, k] / (k + 1)
        c[VX, k + 1] = foot / (k + 1)
        c[Y, k + 1] = c[VY, k + 1] = 0.0
        sine_cosine(c[PSI], c[SIN], c[COS], k + 1)
    g[TOPPLE, 0] += 0.5 * np.pi
    if kind == STICK:
        g[FRICTION, 0] = g[FRICTION_TOO, 0] = OFF
    elif slides:
        g[FRICTION_TOO, 0] = OFF
    return order


@kernel(_t.void(_t.int64, VECTOR, VECTOR), inline=True)
def _touch_down(corner, y, p):
    """Turn the state of the flight into that of the corner that touches: where it is, with zero slip."""
    side = 2 * corner - 1
    psi = 0.5 * np.pi - p[ALPHA] - side * y[THETA]
    y[X] += side * (p[RADIUS] * np.cos(psi) - p[HALF_WIDTH])
    y[VX] = 0.0
    y[Y] = 0.0
    y[VY] = 0.0


@kernel(_t.void(_t.int64, VECTOR, VECTOR), inline=True)
def _take_off(corner, y, p):
    """Turn the state about a corner into that of the flight: position and velocity of the centroid."""
    side = 2 * corner - 1
    psi = 0.5 * np.pi - p[ALPHA] - side * y[THETA]
    tilting = -side * y[OMEGA]
    y[X] -= side * (p[RADIUS] * np.cos(psi) - p[HALF_WIDTH])
    y[VX] += side * p[RADIUS] * np.sin(psi) * tilting
    y[Y] = p[RADIUS] * np.sin(psi) - p[HEIGHT] - p[DROP]
    y[VY] = p[RADIUS] * np.cos(psi) * tilting


@kernel(_t.int64(_t.int64, VECTOR, MATRIX, VECTOR, _t.float64, _t.int64), inline=True)
def _held_or_slipping(corner, y, f, p, mu, held):
    """Return the mode after a test of friction, eqs. (12b), (12c), (14): `held` where it suffices, else a slip opposing the need."""
    side = 2 * corner - 1
    r = p[RADIUS]
    psi = 0.5 * np.pi - p[ALPHA] - side * y[THETA]
    s = np.sin(psi)
    c = np.cos(psi)
    tilting = -side * y[OMEGA]
    turning = -p[MASS] * r * (p[GRAVITY] * c + side * f[0, 0] * s) / (p[CENTROID_INERTIA] + p[MASS] * r * r)
    normal = p[GRAVITY] - r * s * tilting**2 + r * c * turning
    need = side * f[0, 0] + r * s * turning + r * c * tilting**2
    if abs(need) <= mu * normal:
        return landed(corner, held)
    # a foot that would have to be pushed forward is left behind
    slip = -1.0 if need > 0.0 else 1.0
    if p[CENTROID_INERTIA] + p[MASS] * r * r * c * (c - slip * p[MU_KINETIC] * s) <= 0.0:
        return JAMMED
    return landed(corner, FORTH if slip * side > 0.0 else BACK)


@kernel(RESET)
def flight_reset(mode, guard, y, f, p):
    """Land, stop slipping, slip again, lift off again, or end ([Sugimoto2017]_)."""
    if mode == FLIGHT:
        _touch_down(guard, y, p)
        return _held_or_slipping(guard, y, f, p, p[MU], STICK)
    corner = corner_of(mode)
    if guard == TOUCH:
        y[THETA] = 0.0
        return END
    if guard == TOPPLE:
        return OVERTURNED
    if guard == LIFT:
        _take_off(corner, y, p)
        return FLIGHT
    y[VX] = 0.0
    if kind_of(mode) == HOLD:
        side = 2 * corner - 1
        return landed(corner, BACK if (guard == FRICTION) == (side > 0) else FORTH)
    return _held_or_slipping(corner, y, f, p, p[MU_KINETIC], HOLD)


FLYING = Model(
    "jump (flight)",
    flight_series,
    flight_reset,
    states=("theta", "omega", "x", "vx", "y", "vy"),
    guards=("left lands, or tilt ends", "right lands, or topples", "lift", "friction", "friction backward"),
    modes=(
        "flight",
        "stick left",
        "stick right",
        "hold left",
        "hold right",
        "back left",
        "back right",
        "forth left",
        "forth right",
        "jammed",
        "overturned",
        "end",
    ),
    scratch=10,
    tracked=0,
)


def flight_parameters(block: TwoLayerBlock, gravity: float, mu: float, mu_kinetic: float, drop: float, dt: float) -> FloatArray:
    """Return the parameters of the model ([Sugimoto2017]_); `dt` is the sampling interval, the longest step."""
    return np.array(
        [
            block.slenderness,
            block.radius,
            block.width / 2,
            block.centroid_height,
            block.mass,
            block.centroid_inertia,
            gravity,
            mu,
            mu_kinetic,
            drop,
            dt,
        ]
    )


def centroid(block: TwoLayerBlock, drop: float, modes: IntArray, states: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return displacement x and rise y of the centroid, (n,), m, from states of this model ([Sugimoto2017]_).

    After landing the state holds the foot's slip; the centroid follows from the tilt about the corner that touches.
    """
    side = np.where(modes == FLIGHT, 0, 2 * ((modes - 1) % 2) - 1)
    psi = np.pi / 2 - block.slenderness - side * states[:, THETA]
    foot_to_centroid = -side * (block.radius * np.cos(psi) - block.width / 2)
    risen = block.radius * np.sin(psi) - block.centroid_height - drop
    flying = side == 0
    return states[:, X] + foot_to_centroid, np.where(flying, states[:, Y], risen)
