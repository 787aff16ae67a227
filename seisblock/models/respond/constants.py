"""Indices of modes, states, guards and parameters of the five-mode model.

Modes are numbered in the order in which they are tried when a mode ends (:mod:`seisblock.models.respond.mode_selection`).
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import VECTOR

_t = types()

(
    REST, ROCK_RIGHT, ROCK_LEFT, SLIDE_PLUS, SLIDE_MINUS, SLIDE_ROCK_RIGHT_PLUS, SLIDE_ROCK_LEFT_PLUS, SLIDE_ROCK_RIGHT_MINUS,
    SLIDE_ROCK_LEFT_MINUS, FLIGHT, START,
) = range(11)  # fmt: skip
"""Modes. SLIDE_ROCK_*: rocking about a sliding corner; START: initial state, before the first mode is selected."""

SLIP_FORWARD = SLIDE_PLUS, SLIDE_ROCK_RIGHT_PLUS, SLIDE_ROCK_LEFT_PLUS
"""Modes with a slip to +x."""

TENON_OFFSET = 11
"""Offset of a mode while the feet are engaged in tenons."""

GAVE_UP, SETTLED, OVERTURNED = range(-3, 0)
"""Terminal modes: too many impacts, at rest after the record, overturned."""

MODES = (
    "rest", "rock", "rock", "slide", "slide", "slide-rock", "slide-rock", "slide-rock", "slide-rock", "flight", "start",
) * 2 + ("given up", "rest", "overturned")  # fmt: skip

(
    THETA, X, OMEGA, SPEED, GAP_LEFT, RATE_LEFT, GAP_RIGHT, RATE_RIGHT, PATH, WORK, FRICTION, LOSS, IMPACTS, JAMS, RATIO_LOWERED,
) = range(15)  # fmt: skip
"""States.

THETA, OMEGA: tilt, rad, positive to +x, and its rate; X: displacement of the centre of gravity relative to the ground, m.
SPEED: slip velocity of the contact, m/s; in flight the velocity of the centre of gravity.
GAP_*, RATE_*: height of a lower corner above the ground, m, and its rate; integrated in flight, exactly zero in contact, so that
rebounds of 1e-20 m are resolved.
PATH: length of the slip path, m. WORK, FRICTION, LOSS: work of the ground, energy dissipated by friction and by impacts, J/kg.
IMPACTS, JAMS, RATIO_LOWERED: number of impacts, of jams above Painleve's limit, and of rocking impacts whose prescribed ratio was
reduced because it would have created energy."""

STATES = (
    "rotation", "displacement", "angular velocity", "speed", "left gap", "left rate", "right gap", "right rate", "path", "work", "friction",
    "loss", "impacts", "jams", "lowered",
)  # fmt: skip

LAND_LEFT, LAND_RIGHT, DOWN, SLIP, LEFT, RIGHT, LIFT, FORWARD, BACKWARD, CONE, RELEASE, END = range(12)
"""Guards.

LAND_LEFT, LAND_RIGHT: gap of a corner in flight; DOWN: tilt towards the corner in contact; SLIP: slip speed. These four are states, reset
to exact values. LEFT, RIGHT: force under a corner at rest; LIFT: normal force (gravity in sliding); FORWARD, BACKWARD: reserve of static
friction; CONE: Painleve's denominator; RELEASE: remaining engagement of the tenon; END: tilt remaining to pi/2, followed by one row per
further point."""

N_STATE_GUARDS = 4
"""Number of guards that are states."""

GUARDS = (
    "left corner lands", "right corner lands", "other corner", "slip", "left force", "right force", "normal force", "friction forward",
    "friction backward", "friction cone", "tenon", "quarter turn",
)  # fmt: skip

(
    GRAVITY, DT, MU, MU_KINETIC, RESTITUTION, ROCKING_RESTITUTION, ARM_RIGHT, ARM_LEFT, HEIGHT, GYRATION, TENON, NEAR_JAM,
    GROUND_AT_REST, SMALL_RATE, FLAT_RATE,
    MAX_IMPACTS, POINTS,
) = range(17)  # fmt: skip
"""Parameters, SI.

ROCKING_RESTITUTION: prescribed ratio of angular velocities in a rocking impact; -1: impact law; between -1 and 0: minus the share of
Housner's ratio. ARM_*: horizontal distances b2 and b1 from the lower corners to the centre of gravity, whose height is HEIGHT;
GYRATION: squared radius of gyration; TENON: depth; NEAR_JAM: 1 where kinetic friction is near Painleve's limit; GROUND_AT_REST: 1 after
the end of the record; SMALL_RATE: v_z, the rebound velocity below which bouncing ends; FLAT_RATE: velocity of both
corners below which a body that would rest or slide is set flat, 0 unless a run is repeated; then xi, eta of each further point."""

HALF_PI = 0.5 * math.pi
NO_MODE = -1
"""No consistent mode; no prescribed ratio."""

MIN_CONE = 1e-8
"""Painleve's denominator below which sliding has no consistent contact force."""


@kernel(_t.boolean(_t.int64), inline=True)
def is_right(kind):
    """Return whether a rocking or slide-rocking mode turns about the right corner."""
    return kind % 2 == 1


@kernel(_t.float64(_t.int64), inline=True)
def slip_sign(kind):
    """Return the sign of the slip of a sliding or slide-rocking mode."""
    return 1.0 if kind in SLIP_FORWARD else -1.0


@kernel(_t.float64(_t.boolean, VECTOR), inline=True)
def corner_offset(right, p):
    """Return xi, the offset of a lower corner from the centre of gravity along +x in the upright body, m."""
    return p[ARM_RIGHT] if right else -p[ARM_LEFT]


@kernel(_t.UniTuple(_t.float64, 2)(_t.boolean, _t.float64, VECTOR), inline=True)
def corner_position(right, theta, p):
    """Return the vector (r_x, r_y) from the centre of gravity to a lower corner, m."""
    xi = corner_offset(right, p)
    if theta == 0.0:
        return xi, -p[HEIGHT]
    s = math.sin(theta)
    c = math.cos(theta)
    return xi * c - p[HEIGHT] * s, -xi * s - p[HEIGHT] * c
