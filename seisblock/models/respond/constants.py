"""What the five-mode model calls its modes, states, guards and parameters, and the few facts that follow from a name.

Modes stand in the order in which they are tried when one ends (:mod:`seisblock.models.respond.mode_selection`).
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
"""A skid is rocking about a corner that slides (slide-rock); START is where a body is put down, before its first mode is known."""

TENON_OFFSET = 11
"""Added to a mode while tenons hold the feet."""

GAVE_UP, SETTLED, OVERTURNED = range(-3, 0)
"""Modes that end the motion: too many impacts, at rest on still ground, fallen."""

MODES = (
    "rest", "rock", "rock", "slide", "slide", "slide-rock", "slide-rock", "slide-rock", "slide-rock", "flight", "start",
) * 2 + ("given up", "rest", "overturned")  # fmt: skip

(
    THETA, X, OMEGA, SPEED, GAP_LEFT, RATE_LEFT, GAP_RIGHT, RATE_RIGHT, PATH, WORK, FRICTION, LOSS, IMPACTS, JAMS, RATIO_LOWERED,
) = range(15)  # fmt: skip
"""States.

THETA, OMEGA: lean, rad, positive to +x, and its rate; X: of the centre of gravity, relative to the ground, m.
SPEED: slip velocity of what touches the ground, m/s; in flight the centre's velocity.
GAP_*, RATE_*: height of a lower corner above the ground and its rate, kept in flight, zero in contact; so hops of 1e-20 m are resolved.
PATH: length slid, m. WORK, FRICTION, LOSS: work of the moving ground, energy lost by friction and in impacts, J/kg.
IMPACTS, JAMS, LOWERED: how many; jams above Painleve's limit, rocking impacts whose given ratio would have created energy."""

STATES = (
    "rotation", "displacement", "angular velocity", "speed", "left gap", "left rate", "right gap", "right rate", "path", "work", "friction",
    "loss", "impacts", "jams", "lowered",
)  # fmt: skip

LAND_LEFT, LAND_RIGHT, DOWN, SLIP, LEFT, RIGHT, LIFT, FORWARD, BACKWARD, CONE, RELEASE, END = range(12)
"""Guards.

LAND_LEFT, LAND_RIGHT: gap of a corner in flight; DOWN: lean towards the corner that touches; SLIP: speed of the slip; these are states,
set to exact values. LEFT, RIGHT: force under a corner at rest; LIFT: normal force (gravity in a slide); FORWARD, BACKWARD: what is left of
static friction; CONE: Painleve's denominator; RELEASE: depth of the tenon not yet left; END: pi/2 not yet reached, then one row per further
point."""

N_STATE_GUARDS = 4
"""Guards that are states."""

GUARDS = (
    "left corner lands", "right corner lands", "other corner", "slip", "left force", "right force", "normal force", "friction forward",
    "friction backward", "friction cone", "tenon", "quarter turn",
)  # fmt: skip

(
    GRAVITY, DT, MU, MU_KINETIC, RESTITUTION, ROCKING_RESTITUTION, ARM_RIGHT, ARM_LEFT, HEIGHT, GYRATION, TENON, NEAR_JAM,
    GROUND_AT_REST, SMALL_RATE,
    MAX_IMPACTS, POINTS,
) = range(16)  # fmt: skip
"""Parameters, SI.

ROCKING_RESTITUTION: ratio of angular velocities that is given, -1 for none, between -1 and 0 less a share of Housner's ratio; ARM_*:
horizontal distances b2 and b1 from the lower corners to the centre, whose height is HEIGHT; GYRATION: squared radius; TENON: depth;
STEEP: 1 where kinetic friction is near Painleve's limit;
STILL: 1 when the record is over; SMALL_RATE: v_z, below which hops are at their end; then xi, eta of each further point."""

HALF_PI = 0.5 * math.pi
NO_MODE = -1
"""No mode; no given ratio."""

MIN_CONE = 1e-8
"""Painleve's denominator below which sliding has no consistent force."""


@kernel(_t.boolean(_t.int64), inline=True)
def is_right(kind):
    """Whether a rocking or skidding mode turns about the right corner."""
    return kind % 2 == 1


@kernel(_t.float64(_t.int64), inline=True)
def slip_sign(kind):
    """Return the sign of the slip of a sliding or skidding mode."""
    return 1.0 if kind in (SLIDE_PLUS, SLIDE_ROCK_RIGHT_PLUS, SLIDE_ROCK_LEFT_PLUS) else -1.0


@kernel(_t.float64(_t.boolean, VECTOR), inline=True)
def corner_offset(right, p):
    """Return xi, how far a lower corner of the upright body lies to +x of the centre, m."""
    return p[ARM_RIGHT] if right else -p[ARM_LEFT]


@kernel(_t.UniTuple(_t.float64, 2)(_t.boolean, _t.float64, VECTOR), inline=True)
def corner_position(right, theta, p):
    """Return where a lower corner is from the centre, (r_x, r_y), m."""
    xi = corner_offset(right, p)
    if theta == 0.0:
        return xi, -p[HEIGHT]
    s = math.sin(theta)
    c = math.cos(theta)
    return xi * c - p[HEIGHT] * s, -xi * s - p[HEIGHT] * c
