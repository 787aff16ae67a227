"""Which mode follows: the first, in a fixed order, whose forces are consistent with unilateral contact and Coulomb friction.

Order
    rest, rock about the right, the left corner, slide to +x, to -x, skid right +, left +, right -, left -, flight; of these the ones that
    the touching corners and the slip velocity allow.
Consistent
    Pressing forces where closed, friction within its cone where sticking, a slip that starts in its own sense, and corners that open
    not pulled back. Each condition is a slack in m/s^2, so that one tolerance serves all.
Uniqueness
    For a corner that sticks with pressing force N* and needs rho = abs(T*)/N*, a slip has an acceleration proportional to
    N* (rho - mu_k)/P and a force -b/P, b the free normal acceleration: once rho > mu_s exactly one of slip (b < 0) and flight (b > 0)
    follows. With a slip that has no consistent force (P <= 0, pressed on) there is none: Painleve's case, which ends in a jam
    ([GenotBrogliato1999]_). Derived here.
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import MATRIX, VECTOR
from seisblock.solvers.respond.names import (
    ARM_LEFT,
    ARM_RIGHT,
    DT,
    FLIGHT,
    GRAVITY,
    GYRATION,
    HEIGHT,
    LEAST_CONE,
    MU,
    MU_KINETIC,
    NONE,
    REST,
    ROCK_LEFT,
    ROCK_RIGHT,
    SKID_RIGHT_PLUS,
    SLIDE_MINUS,
    SLIDE_PLUS,
    corner,
    is_right,
    sense,
)

_t = types()

ALONG, ACROSS, UP = range(3)

TOLERANCE, FLAT_TOLERANCE = 1e-10, 1e-13
"""Slack, as a share of gravity, below zero at which a condition still counts as met: a threshold that was just located, where a body
turns and where it lies flat, the forces then being those of the input."""

SOON, LATER = 1e-6, 1e3
"""Flat modes, whose forces depend on the input alone, are judged this share of the sampling interval later, and, while a condition is
met or missed by no more than the tolerance, so many times later still, up to one interval: there the slope of the input decides."""

CONE_ROUND_OFF = 1e-6
"""Round-off of Painleve's denominator, a sum of terms of the order of 1 known to 1e-14, as a share of its least value."""

IMPOSSIBLE = -1e300
"""Slack of a mode that does not come into question."""


@kernel(_t.UniTuple(_t.float64, 2)(_t.float64, MATRIX, VECTOR), inline=True)
def loads(later, f, p):
    """Return the ground's horizontal acceleration and G = g + a_y, m/s^2, `later` seconds from now (derived here)."""
    push = f[ALONG, 0] + f[ACROSS, 0] + later * (f[ALONG, 1] + f[ACROSS, 1])
    return push, p[GRAVITY] + f[UP, 0] + later * f[UP, 1]


@kernel(_t.UniTuple(_t.float64, 3)(_t.float64, _t.float64, _t.float64, _t.float64, _t.float64, VECTOR), inline=True)
def sticking(rx, ry, spin, push, weight, p):
    """Return theta'', N and T of a body that turns about a corner at rest; `spin` is theta'^2 ([Shenton1996]_)."""
    turn = (ry * push - rx * weight) / (p[GYRATION] + rx * rx + ry * ry)
    return turn, weight + rx * turn + ry * spin, push - ry * turn + rx * spin


@kernel(_t.UniTuple(_t.float64, 3)(_t.float64, _t.float64, _t.float64, _t.float64, _t.float64, _t.float64, VECTOR), inline=True)
def skidding(rx, ry, spin, push, weight, friction, p):
    """Return theta'', Painleve's P and the slip's acceleration where T = -`friction` N ([GenotBrogliato1999]_)."""
    lever = rx + friction * ry
    cone = 1.0 + rx * lever / p[GYRATION]
    normal = (weight + ry * spin) / cone
    turn = -lever * normal / p[GYRATION]
    return turn, cone, -push - friction * normal + ry * turn - rx * spin


@kernel(_t.float64(_t.int64, _t.boolean, _t.boolean, _t.float64, _t.float64, _t.float64, _t.float64, _t.float64, VECTOR, _t.boolean))
def slack(kind, left, right, theta, omega, slip, push, weight, p, held):
    """Return the least slack of a mode's conditions, m/s^2; negative: not consistent ([Shenton1996]_, [GenotBrogliato1999]_)."""
    both = left and right
    base = p[ARM_LEFT] + p[ARM_RIGHT]
    spin = omega * omega
    if kind == FLIGHT:
        least = -IMPOSSIBLE
        if left:
            least = -weight - corner(False, theta, p)[1] * spin
        if right:
            least = min(least, -weight - corner(True, theta, p)[1] * spin)
        return least
    if kind == REST:
        if not both or slip != 0.0:
            return IMPOSSIBLE
        least = min(p[ARM_LEFT] * weight - p[HEIGHT] * push, p[ARM_RIGHT] * weight + p[HEIGHT] * push) / base
        return least if held else min(least, p[MU] * weight - abs(push))
    if kind in (SLIDE_PLUS, SLIDE_MINUS):
        s = sense(kind)
        if not both or held or s * slip < 0.0:
            return IMPOSSIBLE
        reach = s * p[MU_KINETIC] * p[HEIGHT]
        least = weight
        tips = p[GRAVITY] * min(p[ARM_RIGHT] - reach, p[ARM_LEFT] + reach) / base
        if tips < -FLAT_TOLERANCE * p[GRAVITY]:
            # no input changes where the resultant is, so that nothing is decided by looking at it later
            least = min(tips, weight)
        return least if slip != 0.0 else min(least, -s * push - p[MU_KINETIC] * weight)
    about_right = is_right(kind)
    if not (right if about_right else left):
        return IMPOSSIBLE
    rx, ry = corner(about_right, theta, p)
    opening = base if about_right else -base
    if kind in (ROCK_RIGHT, ROCK_LEFT):
        if slip != 0.0:
            return IMPOSSIBLE
        turn, normal, tangential = sticking(rx, ry, spin, push, weight, p)
        # a tenon pressed aside binds: it holds the foot as long as that would not rise by itself
        least = max(normal, weight + ry * spin) if held else min(normal, p[MU] * normal - abs(tangential))
        return min(least, opening * turn) if both else least
    s = sense(kind)
    if held or s * slip < 0.0:
        return IMPOSSIBLE
    turn, cone, sliding = skidding(rx, ry, spin, push, weight, s * p[MU_KINETIC], p)
    if not cone > LEAST_CONE:
        return IMPOSSIBLE
    least = weight + ry * spin
    if both:
        least = min(least, opening * turn)
    return least if slip != 0.0 else min(least, s * sliding)


@kernel(_t.int64(_t.boolean, _t.boolean, _t.int64, _t.float64, _t.float64, _t.float64, MATRIX, VECTOR, _t.boolean))
def following(left, right, ended, theta, omega, slip, f, p, held):
    """Return the mode that follows, or NONE where a slip jams ([Shenton1996]_, [GenotBrogliato1999]_).

    Parameters
    ----------
    left, right : bool
        Whether the corner touches the ground and stays on it: gap and its rate are zero.
    ended : int
        Mode that has just reached its limit and is excluded, or NONE.
    theta, omega, slip : float, rad, rad/s, m/s
    f, p : arrays
        Ground motion and parameters, as the engine has them.
    held : bool
        Whether tenons hold the feet.
    """
    if not left and not right:
        return FLIGHT
    flat = left and right
    tolerance = (FLAT_TOLERANCE if flat else TOLERANCE) * p[GRAVITY]
    soon = SOON * p[DT] if flat else 0.0
    nearest = NONE
    missing = IMPOSSIBLE
    touched = False
    for kind in range(REST, FLIGHT + 1):
        later = soon
        push, weight = loads(later, f, p)
        least = slack(kind, left, right, theta, omega, slip, push, weight, p, held)
        while abs(least) <= tolerance and 0.0 < later < 0.5 * p[DT]:
            later *= LATER
            push, weight = loads(later, f, p)
            least = slack(kind, left, right, theta, omega, slip, push, weight, p, held)
        if kind == ended:
            touched = least >= -tolerance
            continue
        if least >= -tolerance:
            return kind
        if least > missing:
            nearest = kind
            missing = least
    if slip != 0.0 and not held:
        # sliding presses on and has no consistent force: a jam
        about_right = slip > 0.0 if left and right else right
        rx, ry = corner(about_right, theta, p)
        friction = p[MU_KINETIC] if slip > 0.0 else -p[MU_KINETIC]
        # the limit was located but for round-off where a slip has just reached it
        least_cone = LEAST_CONE * (1.0 + CONE_ROUND_OFF) if ended >= SKID_RIGHT_PLUS else LEAST_CONE
        if 1.0 + rx * (rx + friction * ry) / p[GYRATION] <= least_cone:
            return NONE
    # round-off alone leads here: a limit that was only touched, or the mode that misses least
    return ended if touched else nearest


__all__ = [
    "ACROSS",
    "ALONG",
    "FLAT_TOLERANCE",
    "ROCK_LEFT",
    "ROCK_RIGHT",
    "SKID_RIGHT_PLUS",
    "TOLERANCE",
    "UP",
    "following",
    "loads",
    "skidding",
    "slack",
    "sticking",
]
