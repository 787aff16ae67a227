"""Impact events: landing, rocking impact, tripping, jam, and termination of decreasing rebounds (Zeno behaviour).

Landing
    At one corner: Routh's path, the other corner ignored. Flat on the base (theta = theta' = 0): one body with friction
    rho = min(mu, value that stops the slip) and the resultant at s rho h; where that lies outside the base, the body trips over the
    corner towards which it slides.
Rocking impact
    Routh's path at the corner that comes down, accepted if the other corner rises; else a plastic impact of both corners. With a
    prescribed ratio r theta' is multiplied by r and the slip follows from friction; r is reduced where energy would grow.
Rebounds
    Below SMALL_RATE = 1e-12 sqrt(g R) a rebound is suppressed where contact would persist, and a rocking body is set flat where it would
    rest or slide, or where its slip is of that order, too. Lifts of 1e-21 R are neglected, and rest is reached early by less than
    1e-8 sqrt(R/g).
    Where one corner's rebound is suppressed and the other's, just above SMALL_RATE, is kept up by friction, the impacts never end. Such a
    run is repeated with FLAT_RATE = 1e-10 sqrt(g R): where an impact leaves both corners slower, a body that would stay flat is set flat.
    A rebound shorter than the resolution of time (1e-14 of the sampling interval) starts and ends in the same state, with a gap or tilt of
    exactly zero: its contact is closed. Round-off produces such rebounds where two limits coincide, for example at mu = b/h.
Clattering
    A plastic landing after which the other corner follows within 1e-16 sqrt(R/g) is treated as an impact of both corners: without a load a
    compact body would clatter infinitely often at one instant, and the simultaneous impact has the momentum of that limit.
Jam
    A compressed slip without a consistent force ends at once, by an impact that begins with u = 0 ([GenotBrogliato1999]_).

Derived here. Without restitution and with sufficient friction the rocking impact is Housner's: theta' is multiplied by
(k^2 + h^2 - b1 b2)/(k^2 + h^2 + b_B^2) ([Housner1963]_).
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.models.respond.constants import (
    ARM_LEFT,
    ARM_RIGHT,
    FLAT_RATE,
    FLIGHT,
    GAP_LEFT,
    GAP_RIGHT,
    GRAVITY,
    GYRATION,
    HEIGHT,
    IMPACTS,
    JAMS,
    LOSS,
    MU_KINETIC,
    NO_MODE,
    OMEGA,
    RATE_LEFT,
    RATE_RIGHT,
    RATIO_LOWERED,
    REST,
    RESTITUTION,
    ROCKING_RESTITUTION,
    SLIDE_MINUS,
    SLIDE_PLUS,
    SMALL_RATE,
    SPEED,
    THETA,
    corner_offset,
    corner_position,
)
from seisblock.models.respond.impact_laws import (
    CLOSED_BOTH,
    CLOSED_LEFT,
    CLOSED_NONE,
    CLOSED_RIGHT,
    both_corners_impact,
    corner_impact,
    resolve_jam,
)
from seisblock.models.respond.mode_selection import next_mode

_t = types()

BISECTIONS = 60
"""Bisection steps for the largest energy-conserving ratio of a rocking impact."""

SIMULTANEITY = 1e-4
"""Time between impacts of the two corners, over SMALL_RATE/g, below which they are simultaneous: 1e-16 sqrt(R/g)."""

ROUND_OFF = 1e-12
"""Relative growth of energy attributed to round-off."""

MAX_JAMS = 4
"""Upper bound of successive jams at one instant."""

_CONTINUE_SIGNATURE = _t.int64(_t.boolean, _t.boolean, _t.int64, VECTOR, MATRIX, VECTOR, _t.boolean)
_IMPACT_SIGNATURE = _t.int64(_t.boolean, VECTOR, MATRIX, VECTOR, _t.boolean)


@kernel(_t.int64(_t.boolean, _t.float64, VECTOR, VECTOR))
def lift_off(right, rate, y, p):
    """Convert the state about a corner that rises at `rate`, m/s, into a flight state."""
    theta = y[THETA]
    omega = y[OMEGA]
    base_width = corner_offset(right, p) - corner_offset(not right, p)
    # SPEED changes its meaning: slip velocity of the corner in contact, velocity of the centre of gravity in flight
    y[SPEED] -= corner_position(right, theta, p)[1] * omega
    # height of the other corner above this one; the signs of `base_width` and of the tilt agree for either corner
    gap = base_width * math.sin(theta)
    other_rate = rate + base_width * math.cos(theta) * omega
    y[GAP_RIGHT], y[RATE_RIGHT] = (0.0, rate) if right else (gap, other_rate)
    y[GAP_LEFT], y[RATE_LEFT] = (gap, other_rate) if right else (0.0, rate)
    return FLIGHT


@kernel(_t.int64(_t.float64, VECTOR, VECTOR, _t.boolean))
def impact_both_corners(rise, y, p, has_tenon):
    """Apply the plastic impact of both corners to an upright body with y' = `rise`; return the closed corners ([Moreau1988]_)."""
    # SPEED is the slip velocity of the pivot, whose arm in the upright body is r_y = -h
    speed = y[SPEED] + p[HEIGHT] * y[OMEGA]
    closed_corners, y[OMEGA], y[SPEED], loss = both_corners_impact(y[OMEGA], rise, speed, p, has_tenon)
    y[LOSS] += loss
    return closed_corners


@kernel(_CONTINUE_SIGNATURE)
def continue_in_contact(left, right, ended_mode, y, f, p, has_tenon):
    """Return the next mode with the flagged corners in contact, resolving jams where no mode is consistent ([GenotBrogliato1999]_).

    `ended_mode` is the mode that has reached its limit, or ``NO_MODE``.
    """
    kind = NO_MODE
    for _ in range(MAX_JAMS):
        kind = next_mode(left, right, ended_mode, y[THETA], y[OMEGA], y[SPEED], f, p, has_tenon)
        if kind != NO_MODE:
            break
        # the jam has changed the velocities, so that every mode is admissible again, the one that ended included
        ended_mode = NO_MODE
        y[JAMS] += 1.0
        # on a flat base the corner ahead jams: there friction increases the normal reaction
        pivot_right = y[SPEED] > 0.0 if left and right else right
        y[OMEGA], rate, loss = resolve_jam(pivot_right, y[THETA], y[OMEGA], y[SPEED], p[RESTITUTION], p)
        y[SPEED] = 0.0
        y[LOSS] += loss
        # the rotation after the jam presses the other corner into the ground: both corners collide, plastically
        if left and right and (corner_offset(pivot_right, p) - corner_offset(not pivot_right, p)) * y[OMEGA] < 0.0:
            closed_corners = impact_both_corners(rate + corner_offset(pivot_right, p) * y[OMEGA], y, p, has_tenon)
            left = closed_corners in (CLOSED_LEFT, CLOSED_BOTH)
            right = closed_corners in (CLOSED_RIGHT, CLOSED_BOTH)
        elif rate > 0.0:
            return lift_off(pivot_right, rate, y, p)
        else:
            left = not pivot_right
            right = pivot_right
    if kind in (FLIGHT, NO_MODE):
        return lift_off(right, 0.0, y, p)
    # contact means a gap of exactly zero, not a small one: a later flight starts from these states
    y[GAP_LEFT] = y[RATE_LEFT] = y[GAP_RIGHT] = y[RATE_RIGHT] = 0.0
    return kind


@kernel(_t.int64(_t.boolean, _t.float64, VECTOR, MATRIX, VECTOR, _t.boolean))
def _impact_both_and_continue(right, rise, y, f, p, has_tenon):
    closed_corners = impact_both_corners(rise, y, p, has_tenon)
    if closed_corners == CLOSED_NONE:
        # no impulse is needed: the corner separates at the velocity that it has, never at a negative one due to
        # round-off
        return lift_off(right, max(rise - corner_offset(right, p) * y[OMEGA], 0.0), y, p)
    return continue_in_contact(closed_corners != CLOSED_RIGHT, closed_corners != CLOSED_LEFT, NO_MODE, y, f, p, has_tenon)


@kernel(_t.boolean(_t.float64, MATRIX, VECTOR, _t.boolean))
def stays_flat(slip, f, p, has_tenon):
    """Return whether a body flat on the ground with slip velocity `slip` would rest or slide."""
    flat_slip = 0.0 if abs(slip) < p[SMALL_RATE] else slip
    kind = next_mode(True, True, NO_MODE, 0.0, 0.0, flat_slip, f, p, has_tenon)
    return kind in (REST, SLIDE_PLUS, SLIDE_MINUS)


@kernel(_t.int64(_t.float64, _t.float64, VECTOR, MATRIX, VECTOR, _t.boolean))
def _set_flat(omega, slip, y, f, p, has_tenon):
    """Set a body flat whose angular velocity `omega` is negligible and whose slip velocity is `slip`; return its mode."""
    speed = slip + p[HEIGHT] * omega
    y[THETA] = y[OMEGA] = 0.0
    # a slip that would change its sign by neglecting this rotation is stopped, not reversed
    y[SPEED] = 0.0 if abs(slip) < p[SMALL_RATE] or speed * slip <= 0.0 else speed
    return continue_in_contact(True, True, NO_MODE, y, f, p, has_tenon)


@kernel(_t.boolean(_t.boolean, _t.float64, VECTOR, VECTOR))
def _is_negligible(right, rate, y, p):
    """Return whether both corners are slower than FLAT_RATE, and lower than that velocity takes them, after one of them rises at `rate`."""
    base_width = corner_offset(right, p) - corner_offset(not right, p)
    other_rate = rate + base_width * math.cos(y[THETA]) * y[OMEGA]
    limit = p[FLAT_RATE]
    return max(rate, abs(other_rate)) < limit and p[GRAVITY] * abs(base_width * math.sin(y[THETA])) < limit * limit


@kernel(_t.UniTuple(_t.float64, 4)(_t.boolean, _t.float64, _t.float64, VECTOR, MATRIX, VECTOR, _t.boolean))
def _corner_impact_or_rest(right, u, v, y, f, p, has_tenon):
    """Return theta', u, v and loss of an impact at one corner, without a negligible rebound where contact would persist."""
    omega, rate, slip, loss = corner_impact(right, y[THETA], y[OMEGA], u, v, p[RESTITUTION], p, has_tenon)
    if 0.0 < rate < p[SMALL_RATE] and p[RESTITUTION] > 0.0:
        # persistence is tested in the state after the plastic impact; with the rebound itself the answer would always
        # be flight
        plastic = corner_impact(right, y[THETA], y[OMEGA], u, v, 0.0, p, has_tenon)
        keeps_contact = next_mode(not right, right, NO_MODE, y[THETA], plastic[0], plastic[2], f, p, has_tenon) != FLIGHT
        if plastic[1] < p[SMALL_RATE] and keeps_contact:
            return plastic[0], 0.0, plastic[2], plastic[3]
    return omega, rate, slip, loss


@kernel(_IMPACT_SIGNATURE)
def _land_flat(right, y, f, p, has_tenon):
    """Land flat on the base, or trip over the corner towards which the body slides; return the mode."""
    # upright and without rotation both corners come down at the same rate
    w = -y[RATE_RIGHT]
    speed = y[SPEED]
    s = 1.0 if speed > 0.0 else -1.0
    e = p[RESTITUTION]
    for _ in range(2):
        normal_impulse = (1.0 + e) * w
        # a tenon supplies any friction impulse that stops the slip
        friction_impulse = abs(speed) if has_tenon else min(abs(speed), p[MU_KINETIC] * normal_impulse)
        reach = s * friction_impulse * p[HEIGHT]
        # resultant outside the base: the body cannot land flat and trips over the corner ahead
        if not -p[ARM_LEFT] * normal_impulse <= reach <= p[ARM_RIGHT] * normal_impulse:
            break
        slip_after = speed - s * friction_impulse
        # negligible rebound on a base that would rest or slide: repeat the impact without restitution
        if 0.0 < e * w < p[SMALL_RATE] and stays_flat(slip_after, f, p, has_tenon):
            e = 0.0
            continue
        y[SPEED] = slip_after
        y[LOSS] += 0.5 * (w * w * (1.0 - e * e) + speed * speed - slip_after * slip_after)
        if e > 0.0:
            y[GAP_LEFT] = y[GAP_RIGHT] = 0.0
            y[RATE_LEFT] = y[RATE_RIGHT] = e * w
            return FLIGHT
        return continue_in_contact(True, True, NO_MODE, y, f, p, has_tenon)
    pivot_right = s > 0.0
    omega, rate, slip, loss = _corner_impact_or_rest(pivot_right, -w, speed, y, f, p, has_tenon)
    # the other corner would not rise: an impact of the pivot alone does not describe this landing
    if rate + (corner_offset(pivot_right, p) - corner_offset(not pivot_right, p)) * omega <= 0.0:
        return _impact_both_and_continue(pivot_right, -w, y, f, p, has_tenon)
    y[OMEGA] = omega
    y[SPEED] = slip
    y[LOSS] += loss
    if rate > 0.0:
        return lift_off(pivot_right, rate, y, p)
    return continue_in_contact(not pivot_right, pivot_right, NO_MODE, y, f, p, has_tenon)


@kernel(_IMPACT_SIGNATURE)
def _close_contact(right, y, f, p, has_tenon):
    """Return the mode after a corner has left and met the ground within the resolution of time."""
    gap, rate = (GAP_LEFT, RATE_LEFT) if right else (GAP_RIGHT, RATE_RIGHT)
    slip = y[SPEED] + corner_position(right, y[THETA], p)[1] * y[OMEGA]
    if y[gap] == 0.0 and abs(y[rate]) < p[SMALL_RATE] and stays_flat(slip, f, p, has_tenon):
        return _set_flat(y[OMEGA], slip, y, f, p, has_tenon)
    y[SPEED] = slip
    return continue_in_contact(not right, right, NO_MODE, y, f, p, has_tenon)


@kernel(_IMPACT_SIGNATURE)
def land(right, y, f, p, has_tenon):
    """Return the mode after a corner lands from flight ([WangMason1992]_)."""
    gap, rate = (GAP_RIGHT, RATE_RIGHT) if right else (GAP_LEFT, RATE_LEFT)
    zero_duration = y[gap] == 0.0
    y[gap] = 0.0
    # not a landing: the corner left the ground at this very instant
    if y[rate] >= 0.0:
        if zero_duration and y[rate] < p[SMALL_RATE]:
            return _close_contact(right, y, f, p, has_tenon)
        return FLIGHT
    y[IMPACTS] += 1.0
    if y[THETA] == 0.0 and y[OMEGA] == 0.0:
        return _land_flat(right, y, f, p, has_tenon)
    slip = y[SPEED] + corner_position(right, y[THETA], p)[1] * y[OMEGA]
    y[OMEGA], rate_after, y[SPEED], loss = _corner_impact_or_rest(right, y[rate], slip, y, f, p, has_tenon)
    y[LOSS] += loss
    if _is_negligible(right, rate_after, y, p) and stays_flat(y[SPEED], f, p, has_tenon):
        return _set_flat(y[OMEGA], y[SPEED], y, f, p, has_tenon)
    if rate_after > 0.0:
        return lift_off(right, rate_after, y, p)
    base_width = corner_offset(right, p) - corner_offset(not right, p)
    # after the plastic impact the struck corner is at rest vertically, so that the other one approaches by rotation
    # alone
    closing_rate = -base_width * math.cos(y[THETA]) * y[OMEGA]
    # time to the second impact, gap over closing rate, compared without a division
    if closing_rate > 0.0 and p[GRAVITY] * base_width * math.sin(y[THETA]) < SIMULTANEITY * p[SMALL_RATE] * closing_rate:
        # clattering: the other corner follows within 1e-16 sqrt(R/g), infinitely often; the limit is one impact of both
        y[THETA] = 0.0
        y[IMPACTS] += 1.0
        return _impact_both_and_continue(right, corner_offset(right, p) * y[OMEGA], y, f, p, has_tenon)
    return continue_in_contact(not right, right, NO_MODE, y, f, p, has_tenon)


@kernel(_t.Tuple((_t.float64, _t.float64, _t.float64, _t.boolean))(_t.boolean, VECTOR, VECTOR, _t.boolean))
def _impact_with_ratio(onto_right, y, p, has_tenon):
    """Return theta', slip velocity, loss and a flag for a reduced ratio, of a rocking impact with a prescribed ratio."""
    h = p[HEIGHT]
    mu = p[MU_KINETIC]
    omega = y[OMEGA]
    # Housner's kinematics: after the impact the struck corner is at rest vertically, so that y' = xi theta' and P is
    # the change of y'
    fall = corner_offset(not onto_right, p) * omega
    speed = y[SPEED] + h * omega
    energy = speed * speed + fall * fall + p[GYRATION] * omega * omega
    # an impact with ratio 0 never creates energy: lower end of the bracket
    low = 0.0
    high = p[ROCKING_RESTITUTION]
    if high < 0.0:
        # -share of Housner's ratio
        struck_foot = corner_offset(onto_right, p)
        numerator = p[GYRATION] + h * h + struck_foot * corner_offset(not onto_right, p)
        high *= -max(numerator, 0.0) / (p[GYRATION] + h * h + struck_foot * struck_foot)
    ratio = high
    is_lowered = False
    # the prescribed ratio first; bisection between 0 and that ratio only where it would create energy
    for _ in range(BISECTIONS + 1):
        omega_after = ratio * omega
        rise = corner_offset(onto_right, p) * omega_after
        need = h * omega_after - speed
        friction_impulse = mu * (rise - fall)
        sticks = has_tenon or abs(need) <= friction_impulse
        speed_after = h * omega_after if sticks else speed + math.copysign(friction_impulse, need)
        energy_after = speed_after * speed_after + rise * rise + p[GYRATION] * omega_after * omega_after
        if energy_after <= energy * (1.0 + ROUND_OFF):
            if ratio == high:
                break
            low = ratio
        else:
            is_lowered = True
            high = ratio
        ratio = 0.5 * (low + high)
    return omega_after, 0.0 if sticks else speed_after - h * omega_after, 0.5 * (energy - energy_after), is_lowered


@kernel(_IMPACT_SIGNATURE)
def rocking_impact(onto_right, y, f, p, has_tenon):
    """Return the mode after the other corner of a rocking or slide-rocking body comes down ([Housner1963]_, [WangMason1992]_)."""
    zero_duration = y[THETA] == 0.0
    y[THETA] = 0.0
    omega = y[OMEGA]
    slip = y[SPEED]
    base_width = corner_offset(onto_right, p) - corner_offset(not onto_right, p)
    # the tilt has the wrong sign by round-off, or rocking has just begun: nothing approaches the ground
    if base_width * omega <= 0.0:
        if zero_duration and 0.0 < abs(base_width * omega) < p[SMALL_RATE] and stays_flat(slip, f, p, has_tenon):
            return _set_flat(omega, slip, y, f, p, has_tenon)
        # no approach velocity: round-off of a tilt that has just begun, or of none
        return continue_in_contact(onto_right or omega == 0.0, not onto_right or omega == 0.0, NO_MODE, y, f, p, has_tenon)
    y[IMPACTS] += 1.0
    rate = 0.0
    # -1 selects the impact law; other values are a prescribed ratio, or minus a share of Housner's
    if p[ROCKING_RESTITUTION] > NO_MODE:
        omega_after, slip_after, loss, is_lowered = _impact_with_ratio(onto_right, y, p, has_tenon)
        if is_lowered:
            y[RATIO_LOWERED] += 1.0
    else:
        omega_after, rate, slip_after, loss = _corner_impact_or_rest(onto_right, -base_width * omega, slip, y, f, p, has_tenon)
        # the former pivot would be pressed down instead of rising: both corners share the impact
        if rate + base_width * omega_after <= 0.0:
            return _impact_both_and_continue(onto_right, corner_offset(not onto_right, p) * omega, y, f, p, has_tenon)
    y[OMEGA] = omega_after
    y[SPEED] = slip_after
    y[LOSS] += loss
    if _is_negligible(onto_right, rate, y, p) and stays_flat(slip_after, f, p, has_tenon):
        return _set_flat(omega_after, slip_after, y, f, p, has_tenon)
    if rate > 0.0:
        return lift_off(onto_right, rate, y, p)
    # smallest rocking that counts: at rest, or on a base that would rest or slide, the infinite sequence of impacts ends here
    if abs(base_width * omega_after) < p[SMALL_RATE] and (abs(slip_after) < p[SMALL_RATE] or stays_flat(slip_after, f, p, has_tenon)):
        return _set_flat(omega_after, slip_after, y, f, p, has_tenon)
    if omega_after == 0.0:
        return continue_in_contact(True, True, NO_MODE, y, f, p, has_tenon)
    return continue_in_contact(not onto_right, onto_right, NO_MODE, y, f, p, has_tenon)
