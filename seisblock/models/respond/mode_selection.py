"""Selection of the next contact mode: the first one consistent with unilateral contact and Coulomb friction.

Order
    rest, rocking about the right and the left corner, sliding to +x and -x, slide-rocking right +, left +, right -, left -, flight; only
    modes admissible for the corners in contact and the slip velocity are tested.
Consistency
    Compressive force at closed corners, friction inside the cone where sticking, slip that accelerates in its own direction, and
    non-negative normal acceleration at opening corners. Each condition is a slack in m/s^2, so that one tolerance applies to all.
Uniqueness
    For a sticking corner with compressive force N* and friction demand rho = abs(T*)/N*, slip has an acceleration proportional to
    N* (rho - mu_k)/P and a force -b/P, where b is the free normal acceleration: for rho > mu_s exactly one of slip (b < 0) and flight
    (b > 0) follows. A compressed slip with P <= 0 has no consistent force: Painleve's paradox, resolved by an impact without collision
    ("jam", [GenotBrogliato1999]_). Derived here.
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.models.respond.constants import (
    ARM_LEFT,
    ARM_RIGHT,
    DT,
    FLIGHT,
    GRAVITY,
    GYRATION,
    HEIGHT,
    MIN_CONE,
    MU,
    MU_KINETIC,
    NO_MODE,
    REST,
    ROCK_LEFT,
    ROCK_RIGHT,
    SLIDE_MINUS,
    SLIDE_PLUS,
    SLIDE_ROCK_RIGHT_PLUS,
    corner_position,
    is_right,
    slip_sign,
)

_t = types()

ALONG, ACROSS, UP = range(3)

TOLERANCE, FLAT_TOLERANCE = 1e-10, 1e-13
"""Negative slack over gravity that still satisfies a condition, in rotation and on the flat base.

It covers a threshold located an instant ago; on the flat base forces follow from the input alone and are known better."""

LOOKAHEAD, LOOKAHEAD_GROWTH = 1e-6, 1e3
"""Delay, over the sampling interval, at which flat modes are tested, and its growth while a slack stays within the tolerance.

Forces of flat modes depend on the input alone; at a tie the slope of the input decides, up to one interval later."""

CONE_ROUND_OFF = 1e-6
"""Round-off of Painleve's denominator over its lower limit (a sum of terms of order 1, each known to 1e-14)."""

INFEASIBLE = -1e300
"""Slack of an inadmissible mode."""


@kernel(_t.UniTuple(_t.float64, 2)(_t.float64, MATRIX, VECTOR), inline=True)
def ground_loads(delay, f, p):
    """Return the horizontal ground acceleration and G = g + a_y, m/s^2, after `delay` seconds (derived here)."""
    push = f[ALONG, 0] + f[ACROSS, 0] + delay * (f[ALONG, 1] + f[ACROSS, 1])
    return push, p[GRAVITY] + f[UP, 0] + delay * f[UP, 1]


@kernel(_t.UniTuple(_t.float64, 3)(_t.float64, _t.float64, _t.float64, _t.float64, _t.float64, VECTOR), inline=True)
def sticking_forces(rx, ry, spin, push, weight, p):
    """Return theta'', N and T for rocking about a sticking corner; `spin` is theta'^2 ([Shenton1996]_)."""
    turn = (ry * push - rx * weight) / (p[GYRATION] + rx * rx + ry * ry)
    return turn, weight + rx * turn + ry * spin, push - ry * turn + rx * spin


@kernel(_t.UniTuple(_t.float64, 3)(_t.float64, _t.float64, _t.float64, _t.float64, _t.float64, _t.float64, VECTOR), inline=True)
def sliding_forces(rx, ry, spin, push, weight, friction, p):
    """Return theta'', Painleve's P and the slip acceleration for T = -`friction` N ([GenotBrogliato1999]_)."""
    lever = rx + friction * ry
    cone = 1.0 + rx * lever / p[GYRATION]
    normal = (weight + ry * spin) / cone
    turn = -lever * normal / p[GYRATION]
    return turn, cone, -push - friction * normal + ry * turn - rx * spin


@kernel(_t.float64(_t.int64, _t.boolean, _t.boolean, _t.float64, _t.float64, _t.float64, _t.float64, _t.float64, VECTOR, _t.boolean))
def mode_slack(kind, left, right, theta, omega, slip, push, weight, p, has_tenon):
    """Return the smallest slack of a mode's conditions, m/s^2; negative: inconsistent ([Shenton1996]_, [GenotBrogliato1999]_)."""
    on_both = left and right
    base = p[ARM_LEFT] + p[ARM_RIGHT]
    spin = omega * omega
    if kind == FLIGHT:
        # free normal acceleration of each corner in contact; flight requires that neither is pressed into the ground
        margin = -INFEASIBLE
        if left:
            margin = -weight - corner_position(False, theta, p)[1] * spin
        if right:
            margin = min(margin, -weight - corner_position(True, theta, p)[1] * spin)
        return margin
    if kind == REST:
        if not on_both or slip != 0.0:
            return INFEASIBLE
        # forces under the two corners of the body at rest, over its mass
        margin = min(p[ARM_LEFT] * weight - p[HEIGHT] * push, p[ARM_RIGHT] * weight + p[HEIGHT] * push) / base
        return margin if has_tenon else min(margin, p[MU] * weight - abs(push))
    if kind in (SLIDE_PLUS, SLIDE_MINUS):
        s = slip_sign(kind)
        if not on_both or has_tenon or s * slip < 0.0:
            return INFEASIBLE
        reach = s * p[MU_KINETIC] * p[HEIGHT]
        margin = weight
        tips = p[GRAVITY] * min(p[ARM_RIGHT] - reach, p[ARM_LEFT] + reach) / base
        if tips < -FLAT_TOLERANCE * p[GRAVITY]:
            # the centre of pressure is independent of the input, so that no lookahead is needed
            margin = min(tips, weight)
        # from rest the slip must accelerate in its own direction; a slip in progress needs only a compressive force
        return margin if slip != 0.0 else min(margin, -s * push - p[MU_KINETIC] * weight)
    pivot_right = is_right(kind)
    if not (right if pivot_right else left):
        return INFEASIBLE
    rx, ry = corner_position(pivot_right, theta, p)
    opening = base if pivot_right else -base
    if kind in (ROCK_RIGHT, ROCK_LEFT):
        if slip != 0.0:
            return INFEASIBLE
        turn, normal, tangential = sticking_forces(rx, ry, spin, push, weight, p)
        # a tenon under lateral load holds the foot down as long as the released foot would not rise
        margin = max(normal, weight + ry * spin) if has_tenon else min(normal, p[MU] * normal - abs(tangential))
        # normal acceleration of the other corner over its distance: positive when it leaves the ground
        return min(margin, opening * turn) if on_both else margin
    s = slip_sign(kind)
    if has_tenon or s * slip < 0.0:
        return INFEASIBLE
    turn, cone, sliding = sliding_forces(rx, ry, spin, push, weight, s * p[MU_KINETIC], p)
    if not cone > MIN_CONE:
        return INFEASIBLE
    # N = (G + r_y theta'^2)/P with P > 0 here, so that the numerator has the sign of N
    margin = weight + ry * spin
    if on_both:
        margin = min(margin, opening * turn)
    return margin if slip != 0.0 else min(margin, s * sliding)


@kernel(_t.int64(_t.boolean, _t.boolean, _t.int64, _t.float64, _t.float64, _t.float64, MATRIX, VECTOR, _t.boolean))
def next_mode(left, right, ended_mode, theta, omega, slip, f, p, has_tenon):
    """Return the next mode, or ``NO_MODE`` where a slip jams ([Shenton1996]_, [GenotBrogliato1999]_).

    Parameters
    ----------
    left, right : bool
        True for a corner in persistent contact (zero gap and gap rate).
    ended_mode : int
        Mode that has reached its limit and is excluded, or ``NO_MODE``.
    theta, omega, slip : float, rad, rad/s, m/s
    f, p : arrays
        Ground motion and parameters in the engine's layout.
    has_tenon : bool
        True while tenons hold the feet.
    """
    if not left and not right:
        return FLIGHT
    is_flat = left and right
    tolerance = (FLAT_TOLERANCE if is_flat else TOLERANCE) * p[GRAVITY]
    lookahead = LOOKAHEAD * p[DT] if is_flat else 0.0
    best_kind = NO_MODE
    best_margin = INFEASIBLE
    ended_holds = False
    for kind in range(REST, FLIGHT + 1):
        delay = lookahead
        push, weight = ground_loads(delay, f, p)
        margin = mode_slack(kind, left, right, theta, omega, slip, push, weight, p, has_tenon)
        # a tie at this instant: look further ahead, until the slope of the input decides
        while abs(margin) <= tolerance and 0.0 < delay < 0.5 * p[DT]:
            delay *= LOOKAHEAD_GROWTH
            push, weight = ground_loads(delay, f, p)
            margin = mode_slack(kind, left, right, theta, omega, slip, push, weight, p, has_tenon)
        # the ended mode is accepted only if no other holds; otherwise a guard at zero would return the body to it
        # endlessly
        if kind == ended_mode:
            ended_holds = margin >= -tolerance
            continue
        if margin >= -tolerance:
            return kind
        # kept for the end: with two limits at one instant, round-off may violate every mode slightly
        if margin > best_margin:
            best_kind = kind
            best_margin = margin
    if slip != 0.0 and not has_tenon:
        # compressed slip without a consistent force: jam
        pivot_right = slip > 0.0 if left and right else right
        rx, ry = corner_position(pivot_right, theta, p)
        friction = p[MU_KINETIC] if slip > 0.0 else -p[MU_KINETIC]
        # a slip that has just reached the limit is located there only up to round-off
        least_cone = MIN_CONE * (1.0 + CONE_ROUND_OFF) if ended_mode >= SLIDE_ROCK_RIGHT_PLUS else MIN_CONE
        if 1.0 + rx * (rx + friction * ry) / p[GYRATION] <= least_cone:
            return NO_MODE
    # reached by round-off only: a limit that was touched without being crossed, or the mode with the smallest violation
    return ended_mode if ended_holds else best_kind


__all__ = [
    "ACROSS",
    "ALONG",
    "FLAT_TOLERANCE",
    "ROCK_LEFT",
    "ROCK_RIGHT",
    "SLIDE_ROCK_RIGHT_PLUS",
    "TOLERANCE",
    "UP",
    "next_mode",
    "ground_loads",
    "sliding_forces",
    "mode_slack",
    "sticking_forces",
]
