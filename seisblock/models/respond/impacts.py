"""What follows when a corner meets the ground: landings, rocking impacts, trips, jams, and the end of ever smaller hops.

Landing
    One corner by Routh's path, the other ignored; flat on both (theta = theta' = 0): as one body with friction rho = min(mu, what stops
    the slip), whose resultant lies at s rho h and must fall between the corners, else the body trips over the one it slides to.
Rocking impact
    The corner that comes down, by Routh's path; accepted when the other then rises, else both at once, plastically. With a
    ratio r given by the user theta' is multiplied by r, and friction decides what becomes of the slip; r is lowered where
    energy would grow.
Hops
    Below SMALL_RATE = 1e-12 sqrt(g R) a rebound is left out where contact would hold, and a rocking body is put flat where it would
    rest or slide: lifts of 1e-21 R are left out, and the time of rest is early by less than 1e-8 sqrt(R/g).
    A hop that is over within the resolution of time (1e-14 of the sampling interval) begins and ends in the same state, a gap or a lean
    of exactly zero: its contact closes. Round-off leaves such hops where two limits coincide, as those of friction and tilt do at mu = b/h.
Clatter
    A plastic landing that throws the other corner down, within 1e-16 sqrt(R/g), is one of both corners: where nothing presses it to the
    ground a compact body would clatter on, infinitely often at one instant, and the impact of both has the same momentum as the limit.
Jam
    Where a slip that presses on has no consistent force it ends at once, by an impact that begins with u = 0 ([GenotBrogliato1999]_).

Derived here. Without restitution and with friction enough the rocking impact is Housner's, theta' times
(k^2 + h^2 - b1 b2)/(k^2 + h^2 + b_B^2) ([Housner1963]_).
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.models.respond.constants import (
    ARM_LEFT,
    ARM_RIGHT,
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
"""Bisections for the largest ratio of a rocking impact that creates no energy."""

SIMULTANEITY = 1e-4
"""Time between two corners' impacts, over SMALL_RATE/g, below which they are one: 1e-16 sqrt(R/g)."""

ROUND_OFF = 1e-12
"""Share of the energy by which it may seem to grow."""

MAX_JAMS = 4
"""More jams than can follow each other at one instant."""

_CONTINUE_SIGNATURE = _t.int64(_t.boolean, _t.boolean, _t.int64, VECTOR, MATRIX, VECTOR, _t.boolean)
_IMPACT_SIGNATURE = _t.int64(_t.boolean, VECTOR, MATRIX, VECTOR, _t.boolean)


@kernel(_t.int64(_t.boolean, _t.float64, VECTOR, VECTOR))
def lift_off(right, rate, y, p):
    """Turn a state about a corner, which rises at `rate`, into one of flight."""
    theta = y[THETA]
    omega = y[OMEGA]
    base_width = corner_offset(right, p) - corner_offset(not right, p)
    y[SPEED] -= corner_position(right, theta, p)[1] * omega
    gap = base_width * math.sin(theta)
    other_rate = rate + base_width * math.cos(theta) * omega
    y[GAP_RIGHT], y[RATE_RIGHT] = (0.0, rate) if right else (gap, other_rate)
    y[GAP_LEFT], y[RATE_LEFT] = (gap, other_rate) if right else (0.0, rate)
    return FLIGHT


@kernel(_t.int64(_t.float64, VECTOR, VECTOR, _t.boolean))
def impact_both_corners(rise, y, p, has_tenon):
    """Apply the plastic impact of both corners to an upright body that rises at `rise`; return which stay ([Moreau1988]_)."""
    speed = y[SPEED] + p[HEIGHT] * y[OMEGA]
    closed_corners, y[OMEGA], y[SPEED], loss = both_corners_impact(y[OMEGA], rise, speed, p, has_tenon)
    y[LOSS] += loss
    return closed_corners


@kernel(_CONTINUE_SIGNATURE)
def continue_in_contact(left, right, ended_mode, y, f, p, has_tenon):
    """Return the mode of a body whose given corners stay in contact, after a jam where there is no other way ([GenotBrogliato1999]_).

    `ended_mode` is the mode that has just reached its limit, or NONE.
    """
    kind = NO_MODE
    for _ in range(MAX_JAMS):
        kind = next_mode(left, right, ended_mode, y[THETA], y[OMEGA], y[SPEED], f, p, has_tenon)
        if kind != NO_MODE:
            break
        ended_mode = NO_MODE
        y[JAMS] += 1.0
        pivot_right = y[SPEED] > 0.0 if left and right else right
        y[OMEGA], rate, loss = resolve_jam(pivot_right, y[THETA], y[OMEGA], y[SPEED], p[RESTITUTION], p)
        y[SPEED] = 0.0
        y[LOSS] += loss
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
    y[GAP_LEFT] = y[RATE_LEFT] = y[GAP_RIGHT] = y[RATE_RIGHT] = 0.0
    return kind


@kernel(_t.int64(_t.boolean, _t.float64, VECTOR, MATRIX, VECTOR, _t.boolean))
def _impact_both_and_continue(right, rise, y, f, p, has_tenon):
    """Go on after a plastic impact of both corners."""
    closed_corners = impact_both_corners(rise, y, p, has_tenon)
    if closed_corners == CLOSED_NONE:
        return lift_off(right, max(rise - corner_offset(right, p) * y[OMEGA], 0.0), y, p)
    return continue_in_contact(closed_corners != CLOSED_RIGHT, closed_corners != CLOSED_LEFT, NO_MODE, y, f, p, has_tenon)


@kernel(_t.boolean(_t.float64, MATRIX, VECTOR, _t.boolean))
def stays_flat(slip, f, p, has_tenon):
    """Whether a body put flat on the ground with this slip velocity would rest or slide."""
    flat_slip = 0.0 if abs(slip) < p[SMALL_RATE] else slip
    kind = next_mode(True, True, NO_MODE, 0.0, 0.0, flat_slip, f, p, has_tenon)
    return kind in (REST, SLIDE_PLUS, SLIDE_MINUS)


@kernel(_t.int64(_t.float64, _t.float64, VECTOR, MATRIX, VECTOR, _t.boolean))
def _put_flat(omega, slip, y, f, p, held):
    """Return the mode of a body put flat that turned at `omega`, too slowly to matter, and slipped at `slip`."""
    speed = slip + p[HEIGHT] * omega
    y[THETA] = y[OMEGA] = 0.0
    y[SPEED] = 0.0 if abs(slip) < p[SMALL_RATE] or speed * slip <= 0.0 else speed
    return continue_in_contact(True, True, NO_MODE, y, f, p, held)


@kernel(_t.UniTuple(_t.float64, 4)(_t.boolean, _t.float64, _t.float64, VECTOR, MATRIX, VECTOR, _t.boolean))
def _corner_impact_or_rest(right, u, v, y, f, p, has_tenon):
    """Return theta', u, v and loss of one corner's impact; a rebound too small to matter is left out where contact would hold."""
    omega, rate, slip, loss = corner_impact(right, y[THETA], y[OMEGA], u, v, p[RESTITUTION], p, has_tenon)
    if 0.0 < rate < p[SMALL_RATE] and p[RESTITUTION] > 0.0:
        plastic = corner_impact(right, y[THETA], y[OMEGA], u, v, 0.0, p, has_tenon)
        keeps_contact = next_mode(not right, right, NO_MODE, y[THETA], plastic[0], plastic[2], f, p, has_tenon) != FLIGHT
        if plastic[1] < p[SMALL_RATE] and keeps_contact:
            return plastic[0], 0.0, plastic[2], plastic[3]
    return omega, rate, slip, loss


@kernel(_IMPACT_SIGNATURE)
def _land_flat(right, y, f, p, has_tenon):
    """Land on the whole base, or trip over the corner to which it slides."""
    w = -y[RATE_RIGHT]
    speed = y[SPEED]
    s = 1.0 if speed > 0.0 else -1.0
    e = p[RESTITUTION]
    for _ in range(2):
        normal_impulse = (1.0 + e) * w
        friction_impulse = abs(speed) if has_tenon else min(abs(speed), p[MU_KINETIC] * normal_impulse)
        reach = s * friction_impulse * p[HEIGHT]
        if not -p[ARM_LEFT] * normal_impulse <= reach <= p[ARM_RIGHT] * normal_impulse:
            break
        slip_after = speed - s * friction_impulse
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
    if rate + (corner_offset(pivot_right, p) - corner_offset(not pivot_right, p)) * omega <= 0.0:
        return _impact_both_and_continue(pivot_right, -w, y, f, p, has_tenon)
    y[OMEGA] = omega
    y[SPEED] = slip
    y[LOSS] += loss
    if rate > 0.0:
        return lift_off(pivot_right, rate, y, p)
    return continue_in_contact(not pivot_right, pivot_right, NO_MODE, y, f, p, has_tenon)


@kernel(_IMPACT_SIGNATURE)
def _close(right, y, f, p, held):
    """Return the mode after a corner that leaves the ground has met it again within the resolution of time."""
    gap, rate = (GAP_LEFT, RATE_LEFT) if right else (GAP_RIGHT, RATE_RIGHT)
    slip = y[SPEED] + corner_position(right, y[THETA], p)[1] * y[OMEGA]
    if y[gap] == 0.0 and abs(y[rate]) < p[SMALL_RATE] and stays_flat(slip, f, p, held):
        return _put_flat(y[OMEGA], slip, y, f, p, held)
    y[SPEED] = slip
    return continue_in_contact(not right, right, NO_MODE, y, f, p, held)


@kernel(_IMPACT_SIGNATURE)
def land(right, y, f, p, has_tenon):
    """Return the mode after a corner of a flying body has met the ground ([WangMason1992]_)."""
    gap, rate = (GAP_RIGHT, RATE_RIGHT) if right else (GAP_LEFT, RATE_LEFT)
    at_once = y[gap] == 0.0
    y[gap] = 0.0
    if y[rate] >= 0.0:
        if at_once and y[rate] < p[SMALL_RATE]:
            return _close(right, y, f, p, has_tenon)
        return FLIGHT
    y[IMPACTS] += 1.0
    if y[THETA] == 0.0 and y[OMEGA] == 0.0:
        return _land_flat(right, y, f, p, has_tenon)
    slip = y[SPEED] + corner_position(right, y[THETA], p)[1] * y[OMEGA]
    y[OMEGA], rate_after, y[SPEED], loss = _corner_impact_or_rest(right, y[rate], slip, y, f, p, has_tenon)
    y[LOSS] += loss
    if rate_after > 0.0:
        return lift_off(right, rate_after, y, p)
    base_width = corner_offset(right, p) - corner_offset(not right, p)
    closing_rate = -base_width * math.cos(y[THETA]) * y[OMEGA]
    if closing_rate > 0.0 and p[GRAVITY] * base_width * math.sin(y[THETA]) < SIMULTANEITY * p[SMALL_RATE] * closing_rate:
        # it clatters: the other corner follows within 1e-16 sqrt(R/g), and so on without end; both at once is the limit
        y[THETA] = 0.0
        y[IMPACTS] += 1.0
        return _impact_both_and_continue(right, corner_offset(right, p) * y[OMEGA], y, f, p, has_tenon)
    return continue_in_contact(not right, right, NO_MODE, y, f, p, has_tenon)


@kernel(_t.Tuple((_t.float64, _t.float64, _t.float64, _t.boolean))(_t.boolean, VECTOR, VECTOR, _t.boolean))
def _impact_with_ratio(onto_right, y, p, has_tenon):
    """Return theta', slip velocity, loss and whether the ratio was lowered, of a rocking impact with a ratio that is given."""
    h = p[HEIGHT]
    mu = p[MU_KINETIC]
    omega = y[OMEGA]
    fall = corner_offset(not onto_right, p) * omega
    speed = y[SPEED] + h * omega
    energy = speed * speed + fall * fall + p[GYRATION] * omega * omega
    low = 0.0
    high = p[ROCKING_RESTITUTION]
    if high < 0.0:
        # less a share of Housner's ratio
        struck_foot = corner_offset(onto_right, p)
        kept = p[GYRATION] + h * h + struck_foot * corner_offset(not onto_right, p)
        high *= -max(kept, 0.0) / (p[GYRATION] + h * h + struck_foot * struck_foot)
    ratio = high
    is_lowered = False
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
    """Return the mode after the other corner of a rocking or skidding body has come down ([Housner1963]_, [WangMason1992]_)."""
    at_once = y[THETA] == 0.0
    y[THETA] = 0.0
    omega = y[OMEGA]
    slip = y[SPEED]
    base_width = corner_offset(onto_right, p) - corner_offset(not onto_right, p)
    if base_width * omega <= 0.0:
        if at_once and 0.0 < abs(base_width * omega) < p[SMALL_RATE] and stays_flat(slip, f, p, has_tenon):
            return _put_flat(omega, slip, y, f, p, has_tenon)
        # it does not press: the last digit of a lean that has just begun, or of none
        return continue_in_contact(onto_right or omega == 0.0, not onto_right or omega == 0.0, NO_MODE, y, f, p, has_tenon)
    y[IMPACTS] += 1.0
    rate = 0.0
    if p[ROCKING_RESTITUTION] > NO_MODE:
        omega_after, slip_after, loss, is_lowered = _impact_with_ratio(onto_right, y, p, has_tenon)
        if is_lowered:
            y[RATIO_LOWERED] += 1.0
    else:
        omega_after, rate, slip_after, loss = _corner_impact_or_rest(onto_right, -base_width * omega, slip, y, f, p, has_tenon)
        if rate + base_width * omega_after <= 0.0:
            return _impact_both_and_continue(onto_right, corner_offset(not onto_right, p) * omega, y, f, p, has_tenon)
    y[OMEGA] = omega_after
    y[SPEED] = slip_after
    y[LOSS] += loss
    if rate > 0.0:
        return lift_off(onto_right, rate, y, p)
    if abs(base_width * omega_after) < p[SMALL_RATE] and stays_flat(slip_after, f, p, has_tenon):
        return _put_flat(omega_after, slip_after, y, f, p, has_tenon)
    if omega_after == 0.0:
        return continue_in_contact(True, True, NO_MODE, y, f, p, has_tenon)
    return continue_in_contact(not onto_right, onto_right, NO_MODE, y, f, p, has_tenon)
