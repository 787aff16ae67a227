"""Hybrid model of a rigid body sliding on a level or sloping base: stick, slip and flight.

Assumptions
    Rigid body, rigid base, Coulomb friction with a static and a kinetic coefficient, no adhesion, no rocking.
    u is the displacement of the body relative to the base, along the base, positive in the component's positive
    direction (downhill on a slope of positive angle); w is the gap normal to the base.
Base
    A plane that descends by the angle th in the positive direction; a slope of finite length is followed by level ground beyond its foot.
    Ground motion is resolved along the base, a = a_h cos th - a_v sin th, and normal to it, b = a_h sin th + a_v cos th.
Modes
    stick       u' = 0               while |g sin th - a| <= mu_s N       [Fujino1978]_ eqs. (5), (9), (10)
    forward     u'' = g sin th - a - mu_d N     while u' > 0              [Fujino1978]_ eqs. (6), (11), in relative terms
    backward    u'' = g sin th - a + mu_d N     while u' < 0
    flight      u'' = g sin th - a,  w'' = -N   while w > 0               extension, not in the paper
    with N = g cos th + b (per unit mass) and contact only while N >= 0.
Events
    At equality the body sticks. At zero relative velocity static friction is tested: stick, or slip in the other direction.
    The relative speed is continuous at the foot; endless crossings of the foot cannot occur, because an acceleration that drives the body
    uphill along the level ground lets it stick on the slope. Landing is plastic, with a Coulomb impulse against the sliding.
    Where drive and normal force vanish together, as on a slope whose base falls at g, the body is in flight. One-way sliding
    ([Newmark1965]_) does not define flight: loss of contact ends it.
All modes are cubic within a sample, so that the trajectory of a piecewise linear record is exact.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.bodies.sliding_base import SlidingBase
from seisblock.core.i18n import N_, Term
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.dynamics.model import Model
from seisblock.dynamics.model_api import CONSTANT, OFF, RESET, SERIES, SKIP
from seisblock.dynamics.polynomial import ROUND_OFF

_t = types()

SLIP, SPEED, GAP, GAP_SPEED = range(4)
"""States: u (m), u' (m/s), w (m), w' (m/s)."""

STICK, FORWARD, BACKWARD, FLIGHT = range(4)
"""Modes on the slope, or on a level base."""

UNDEFINED = -1
"""Terminal mode: loss of contact in one-way sliding."""

LEVEL = 4
"""Offset of a mode on the level ground beyond the foot of the slope."""

LIMIT_FORWARD, LIMIT_BACKWARD, CONTACT, FOOT = range(4)
"""Guards; LIMIT_FORWARD is the speed in slip and the gap in flight."""

STATIC, KINETIC, GRAVITY, SINE, COSINE, FOOT_POSITION, DOWNHILL, ONE_WAY = range(8)
"""Parameters: mu_s, mu_d, g, sin th, cos th, distance to the foot along the slope (inf: none), +1 or -1, 1 or 0."""

ALONG, UP = 0, 2
SIXTH = 1.0 / 6.0


@kernel(_t.UniTuple(_t.float64, 4)(_t.boolean, MATRIX, VECTOR), inline=True)
def _loads(level, f, p):
    """Return the driving acceleration g sin th - a and the normal force N per unit mass, each with its rate ([Fujino1978]_ eq. (5))."""
    weight, horizontal = p[GRAVITY] + f[UP, 0], f[ALONG, 0]
    if level:
        # level ground: a = a_h and N = g + a_v, without the projections
        drive, drive_rate, normal, normal_rate = -horizontal, -f[ALONG, 1], weight, f[UP, 1]
    else:
        s, c = p[SINE], p[COSINE]
        drive, drive_rate = weight * s - horizontal * c, f[UP, 1] * s - f[ALONG, 1] * c
        normal, normal_rate = weight * c + horizontal * s, f[UP, 1] * c + f[ALONG, 1] * s
    # loss of contact is located at N = 0 up to round-off; an exact zero there keeps the sign test well defined
    return drive, drive_rate, normal if abs(normal) > ROUND_OFF * p[GRAVITY] else 0.0, normal_rate


@kernel(_t.float64(_t.float64, _t.float64, _t.float64), inline=True)
def _excess(drive, mu, normal):
    """Return drive - mu N, exactly zero where the two are equal up to round-off: equality sticks ([Fujino1978]_ eq. (5))."""
    friction = mu * normal
    excess = drive - friction
    return excess if abs(excess) > ROUND_OFF * (abs(drive) + abs(friction)) else 0.0


@kernel(SERIES)
def series(mode, y, f, p, order, c, g):
    """Write the cubic series of one mode and its guards; return the degree."""
    drive, drive_rate, normal, normal_rate = _loads(mode >= LEVEL, f, p)
    g[CONTACT, 0] = g[FOOT, 0] = OFF
    phase = mode % LEVEL
    if phase == STICK:
        mu = p[STATIC]
        # reserves of static friction in both directions, linear in time
        g[LIMIT_FORWARD, 0], g[LIMIT_FORWARD, 1] = -_excess(drive, mu, normal), mu * normal_rate - drive_rate
        g[LIMIT_BACKWARD, 0], g[LIMIT_BACKWARD, 1] = _excess(drive, -mu, normal), mu * normal_rate + drive_rate
        if p[ONE_WAY] > 0.0:
            # two-way stick needs no contact guard, since both friction guards sum to 2 mu N; one-way stick does
            g[LIMIT_BACKWARD, 0] = OFF
            g[CONTACT, 0], g[CONTACT, 1] = normal, normal_rate
        return CONSTANT
    for i in range(4):
        c[i, 0] = y[i]
    friction = p[KINETIC]
    if phase == BACKWARD:
        friction = -friction
    # in flight neither friction nor normal force acts, and the gap opens with -N
    elif phase == FLIGHT:
        friction = 0.0
        c[GAP, 1], c[GAP, 2], c[GAP, 3] = y[GAP_SPEED], -0.5 * normal, -SIXTH * normal_rate
        c[GAP_SPEED, 1], c[GAP_SPEED, 2], c[GAP_SPEED, 3] = -normal, -0.5 * normal_rate, 0.0
    pull, pull_rate = _excess(drive, friction, normal), drive_rate - friction * normal_rate
    c[SLIP, 1], c[SLIP, 2], c[SLIP, 3] = y[SPEED], 0.5 * pull, SIXTH * pull_rate
    c[SPEED, 1], c[SPEED, 2], c[SPEED, 3] = pull, 0.5 * pull_rate, 0.0
    g[LIMIT_BACKWARD, 0] = OFF
    if phase == FLIGHT:
        for k in range(4):
            g[LIMIT_FORWARD, k] = c[GAP, k]
        return 3
    side = 1.0 if phase == FORWARD else -1.0
    # scratch of an earlier flight must not move the gap
    for k in range(1, 4):
        c[GAP, k] = c[GAP_SPEED, k] = 0.0
    for k in range(4):
        g[LIMIT_FORWARD, k] = side * c[SPEED, k]
    g[CONTACT, 0], g[CONTACT, 1], g[CONTACT, 2], g[CONTACT, 3] = normal, normal_rate, 0.0, 0.0
    # only motion towards the foot can reach it: downhill on the slope, uphill on the level
    downhill = p[DOWNHILL] * side > 0.0
    if p[FOOT_POSITION] < OFF and downhill == (mode < LEVEL):
        direction = -p[DOWNHILL] if downhill else p[DOWNHILL]
        for k in range(4):
            g[FOOT, k] = direction * c[SLIP, k]
        g[FOOT, 0] += p[FOOT_POSITION] if downhill else -p[FOOT_POSITION]
    return 3


@kernel(_t.boolean(_t.float64, _t.float64), inline=True)
def _loses_contact(normal, normal_rate):
    """Return whether contact ends: normal force negative, or zero and decreasing."""
    # a zero that is about to grow again is a graze: the body stays
    return normal < 0.0 or (normal == 0.0 and normal_rate < 0.0)


@kernel(_t.int64(_t.int64, VECTOR), inline=True)
def _lift_off_mode(level, p):
    """Return the mode after loss of contact."""
    return UNDEFINED if p[ONE_WAY] > 0.0 else level + FLIGHT


@kernel(_t.int64(_t.int64, VECTOR, MATRIX, VECTOR), inline=True)
def _mode_at_zero_speed(level, y, f, p):
    """Return the mode at zero relative velocity: stick, slip in either direction, or flight."""
    drive, _, normal, normal_rate = _loads(level > 0, f, p)
    y[SPEED] = 0.0
    if _loses_contact(normal, normal_rate):
        return _lift_off_mode(level, p)
    if _excess(drive, p[STATIC], normal) > 0.0:
        return level + FORWARD
    if _excess(drive, -p[STATIC], normal) < 0.0 and p[ONE_WAY] == 0.0:
        return level + BACKWARD
    return level + STICK


@kernel(_t.int64(_t.int64, VECTOR, MATRIX, VECTOR), inline=True)
def _landing_mode(level, y, f, p):
    """Return the mode after a plastic landing; the tangential impulse is at most mu_d times the normal impulse."""
    # the flight may have passed the foot in either direction; exactly at the foot the present level stays
    if p[DOWNHILL] * y[SLIP] > p[FOOT_POSITION]:
        level = LEVEL
    elif p[DOWNHILL] * y[SLIP] < p[FOOT_POSITION]:
        level = 0
    # Coulomb's law on impulses: mu_d times the normal impulse, which stops the fall
    impulse = p[KINETIC] * abs(y[GAP_SPEED])
    y[GAP] = y[GAP_SPEED] = 0.0
    if y[SPEED] > impulse:
        y[SPEED] -= impulse
        return level + FORWARD
    if y[SPEED] < -impulse:
        y[SPEED] += impulse
        return level + BACKWARD
    return _mode_at_zero_speed(level, y, f, p)


@kernel(SKIP)
def skip(mode, acceleration, gains, sample, p):
    """Return the last sample up to which a sticking body stays within both limits of static friction."""
    if mode % LEVEL != STICK:
        return sample
    sine, cosine = (0.0, 1.0) if mode >= LEVEL else (p[SINE], p[COSINE])
    gain_along, gain_up, mu, weight = gains[ALONG], gains[UP], p[STATIC], p[GRAVITY]
    one_way = p[ONE_WAY] > 0.0
    samples = acceleration.shape[1]
    k = sample
    while k < samples:
        a = gain_along * acceleration[ALONG, k]
        b = weight + (gain_up * acceleration[UP, k] if gain_up != 0.0 else 0.0)
        # both conditions are linear in the input: holding at two samples, they hold between them
        drive, limit = b * sine - a * cosine, mu * (b * cosine + a * sine)
        if not (drive < limit and (one_way or -drive < limit) and limit > 0.0):
            break
        k += 1
    return max(k - 1, sample)


@kernel(RESET)
def reset(mode, guard, y, f, p):
    """Return the mode after a guard."""
    level = LEVEL if mode >= LEVEL else 0
    phase = mode % LEVEL
    if guard == CONTACT:
        return _lift_off_mode(level, p)
    if guard == FOOT:
        # the exact position of the foot, not that of the root found
        y[SLIP] = p[DOWNHILL] * p[FOOT_POSITION]
        return LEVEL - level + phase
    # the normal force may vanish at the instant at which friction is exceeded
    if phase == STICK:
        _, _, normal, normal_rate = _loads(level > 0, f, p)
        if _loses_contact(normal, normal_rate):
            return _lift_off_mode(level, p)
        return level + (FORWARD if guard == LIMIT_FORWARD else BACKWARD)
    if phase == FLIGHT:
        return _landing_mode(level, y, f, p)
    return _mode_at_zero_speed(level, y, f, p)


class SlidePhase(Term):
    """Names of the phases, in the order of the modes on either level of the base, and the end of one-way sliding.

    Forward is the component's positive direction, downhill on a positive slope.
    """

    STICK = N_("stick")
    FORWARD = N_("slip forward")
    BACKWARD = N_("slip backward")
    FLIGHT = N_("flight")
    CONTACT_LOST = N_("contact lost (one-way)")


SLIDE = Model(
    "slide",
    series,
    reset,
    ("slip", "speed", "gap", "gap speed"),
    ("limit forward", "limit backward", "contact", "foot"),
    (*list(SlidePhase)[:LEVEL] * 2, SlidePhase.CONTACT_LOST),
    tracked=1,
    skip=skip,
)


def parameters(base: SlidingBase, gravity: float) -> tuple[float, ...]:
    """Return the parameter vector of the model, ``STATIC`` to ``ONE_WAY``, (8,)."""
    foot = math.inf if base.slope_length is None else base.slope_length
    downhill = -1.0 if base.slope_deg < 0.0 else 1.0
    return base.mu, base.kinetic, gravity, math.sin(base.angle), math.cos(base.angle), foot, downhill, float(base.one_way)
