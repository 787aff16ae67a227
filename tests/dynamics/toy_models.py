"""Models with known answers, to prove the engine on."""

from __future__ import annotations

import numpy as np

from seisblock._jit import kernel
from seisblock.dynamics.model import Model
from seisblock.dynamics.model_api import CONSTANT, OFF, RESET, SERIES
from seisblock.dynamics.series import sine_cosine


@kernel(SERIES)
def ball_series(mode, y, f, p, order, c, g):
    """Free fall: height is a parabola; the guard is the height itself."""
    c[0, 0], c[0, 1], c[0, 2] = y[0], y[1], -0.5 * p[0]
    c[1, 0], c[1, 1], c[1, 2] = y[1], -p[0], 0.0
    g[0, 0], g[0, 1], g[0, 2] = y[0], y[1], -0.5 * p[0]
    return 2


@kernel(RESET)
def ball_reset(mode, guard, y, f, p):
    """Bounce with restitution p[1]; stop below p[2]."""
    y[0] = 0.0
    y[1] = -p[1] * y[1]
    return 0 if y[1] > p[2] else -1


BALL = Model("bouncing ball", ball_series, ball_reset, ("height", "speed"), ("floor",), ("flight", "rest"), tracked=1)


@kernel(SERIES)
def pendulum_series(mode, y, f, p, order, c, g):
    """Pendulum theta'' = -p0 sin(theta): a series that does not end; guard: the angular velocity, p1 above it."""
    c[0, 0] = y[0]
    c[1, 0] = y[1]
    c[2, 0] = np.sin(y[0])
    c[3, 0] = np.cos(y[0])
    for k in range(order):
        c[0, k + 1] = c[1, k] / (k + 1)
        c[1, k + 1] = -p[0] * c[2, k] / (k + 1)
        sine_cosine(c[0], c[2], c[3], k + 1)
    g[0, 0] = OFF
    return order


@kernel(RESET)
def no_reset(mode, guard, y, f, p):
    """Nothing changes."""
    return mode


PENDULUM = Model("pendulum", pendulum_series, no_reset, ("angle", "rate"), ("none",), ("swing",), scratch=2, tracked=1)

STICK, SLIP = range(2)


@kernel(SERIES)
def sled_series(mode, y, f, p, order, c, g):
    """A sled that holds up to |a| = p0 and slides without friction: states are relative to the ground."""
    if mode == STICK:
        g[0, 0], g[0, 1] = p[0] - f[0, 0], -f[0, 1]
        g[1, 0], g[1, 1] = p[0] + f[0, 0], f[0, 1]
        return CONSTANT
    c[0, 0], c[1, 0] = y[0], y[1]
    c[0, 1], c[0, 2], c[0, 3] = y[1], -f[0, 0] / 2, -f[0, 1] / 6
    c[1, 1], c[1, 2], c[1, 3] = -f[0, 0], -f[0, 1] / 2, 0.0
    g[0, 0] = g[1, 0] = OFF
    return 3


@kernel(RESET)
def sled_reset(mode, guard, y, f, p):
    """Once loose, always loose."""
    return SLIP


SLED = Model("sled", sled_series, sled_reset, ("slip", "speed"), ("pushed back", "pushed on"), ("stick", "slip"), tracked=1)


@kernel(SERIES)
def flip_series(mode, y, f, p, order, c, g):
    """Both modes are inadmissible at once."""
    g[0, 0], g[0, 1] = -1.0, 0.0
    return CONSTANT


@kernel(RESET)
def flip_reset(mode, guard, y, f, p):
    """The other mode."""
    return 1 - mode


FLIP = Model("flip", flip_series, flip_reset, ("nothing",), ("always",), ("heads", "tails"), tracked=0)


@kernel(SERIES)
def race_series(mode, y, f, p, order, c, g):
    """A point that moves at speed 1 towards two gates, at p[0] and p[1]; and through both at once where they are one."""
    c[0, 0], c[0, 1] = y[0], 1.0
    for k in range(2):
        g[k, 0], g[k, 1] = p[k] - y[0], -1.0
    return 1


@kernel(RESET)
def race_reset(mode, guard, y, f, p):
    """The gate passed decides where it ends."""
    return -1 - guard


RACE = Model("race", race_series, race_reset, ("place",), ("first gate", "second gate"), ("on its way", "by the second", "by the first"))


@kernel(SERIES)
def counted_series(mode, y, f, p, order, c, g):
    """One state moves, the other only counts: it does not move between events, and its row holds nothing."""
    c[0, 0], c[0, 1] = y[0], 1.0
    c[1, 0] = np.nan
    c[1, 1] = OFF
    g[0, 0] = OFF
    return 1


COUNTED = Model("counted", counted_series, no_reset, ("clock", "count"), ("none",), ("runs",), tracked=0)
