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
from seisblock.dynamics.arrays import MATRIX, VECTOR
from seisblock.solvers.respond.impulse import CLOSED_BOTH, CLOSED_LEFT, CLOSED_NONE, CLOSED_RIGHT, both_struck, jammed, struck
from seisblock.solvers.respond.names import (
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
    LOWERED,
    MU_KINETIC,
    NONE,
    OMEGA,
    RATE_LEFT,
    RATE_RIGHT,
    REST,
    RESTITUTION,
    ROCKING_RESTITUTION,
    SLIDE_MINUS,
    SLIDE_PLUS,
    SMALL_RATE,
    SPEED,
    THETA,
    corner,
    foot,
)
from seisblock.solvers.respond.succession import following

_t = types()

HALVINGS = 60
"""Bisections for the largest ratio of a rocking impact that creates no energy."""

AT_ONCE = 1e-4
"""Time between two corners' impacts, over SMALL_RATE/g, below which they are one: 1e-16 sqrt(R/g)."""

ROUND_OFF = 1e-12
"""Share of the energy by which it may seem to grow."""

JAMS_AT_ONCE = 4
"""More jams than can follow each other at one instant."""

_GO_ON = _t.int64(_t.boolean, _t.boolean, _t.int64, VECTOR, MATRIX, VECTOR, _t.boolean)
_STRIKE = _t.int64(_t.boolean, VECTOR, MATRIX, VECTOR, _t.boolean)


@kernel(_t.int64(_t.boolean, _t.float64, VECTOR, VECTOR))
def lift_off(right, rate, y, p):
    """Turn a state about a corner, which rises at `rate`, into one of flight."""
    theta = y[THETA]
    omega = y[OMEGA]
    apart = foot(right, p) - foot(not right, p)
    y[SPEED] -= corner(right, theta, p)[1] * omega
    gap = apart * math.sin(theta)
    other = rate + apart * math.cos(theta) * omega
    y[GAP_RIGHT], y[RATE_RIGHT] = (0.0, rate) if right else (gap, other)
    y[GAP_LEFT], y[RATE_LEFT] = (gap, other) if right else (0.0, rate)
    return FLIGHT


@kernel(_t.int64(_t.float64, VECTOR, VECTOR, _t.boolean))
def strike_both(rise, y, p, held):
    """Apply the plastic impact of both corners to an upright body that rises at `rise`; return which stay ([Moreau1988]_)."""
    speed = y[SPEED] + p[HEIGHT] * y[OMEGA]
    stays, y[OMEGA], y[SPEED], loss = both_struck(y[OMEGA], rise, speed, p, held)
    y[LOSS] += loss
    return stays


@kernel(_GO_ON)
def go_on(left, right, ended, y, f, p, held):
    """Return the mode of a body whose given corners stay in contact, after a jam where there is no other way ([GenotBrogliato1999]_).

    `ended` is the mode that has just reached its limit, or NONE.
    """
    kind = NONE
    for _ in range(JAMS_AT_ONCE):
        kind = following(left, right, ended, y[THETA], y[OMEGA], y[SPEED], f, p, held)
        if kind != NONE:
            break
        ended = NONE
        y[JAMS] += 1.0
        about = y[SPEED] > 0.0 if left and right else right
        y[OMEGA], rate, loss = jammed(about, y[THETA], y[OMEGA], y[SPEED], p[RESTITUTION], p)
        y[SPEED] = 0.0
        y[LOSS] += loss
        if left and right and (foot(about, p) - foot(not about, p)) * y[OMEGA] < 0.0:
            stays = strike_both(rate + foot(about, p) * y[OMEGA], y, p, held)
            left = stays in (CLOSED_LEFT, CLOSED_BOTH)
            right = stays in (CLOSED_RIGHT, CLOSED_BOTH)
        elif rate > 0.0:
            return lift_off(about, rate, y, p)
        else:
            left = not about
            right = about
    if kind in (FLIGHT, NONE):
        return lift_off(right, 0.0, y, p)
    y[GAP_LEFT] = y[RATE_LEFT] = y[GAP_RIGHT] = y[RATE_RIGHT] = 0.0
    return kind


@kernel(_t.int64(_t.boolean, _t.float64, VECTOR, MATRIX, VECTOR, _t.boolean))
def _both(right, rise, y, f, p, held):
    """Go on after a plastic impact of both corners."""
    stays = strike_both(rise, y, p, held)
    if stays == CLOSED_NONE:
        return lift_off(right, max(rise - foot(right, p) * y[OMEGA], 0.0), y, p)
    return go_on(stays != CLOSED_RIGHT, stays != CLOSED_LEFT, NONE, y, f, p, held)


@kernel(_t.boolean(_t.float64, MATRIX, VECTOR, _t.boolean))
def stays_flat(slip, f, p, held):
    """Whether a body put flat on the ground with this slip velocity would rest or slide."""
    flat_slip = 0.0 if abs(slip) < p[SMALL_RATE] else slip
    kind = following(True, True, NONE, 0.0, 0.0, flat_slip, f, p, held)
    return kind in (REST, SLIDE_PLUS, SLIDE_MINUS)


@kernel(_t.int64(_t.float64, _t.float64, VECTOR, MATRIX, VECTOR, _t.boolean))
def _put_flat(omega, slip, y, f, p, held):
    """Return the mode of a body put flat that turned at `omega`, too slowly to matter, and slipped at `slip`."""
    speed = slip + p[HEIGHT] * omega
    y[THETA] = y[OMEGA] = 0.0
    y[SPEED] = 0.0 if abs(slip) < p[SMALL_RATE] or speed * slip <= 0.0 else speed
    return go_on(True, True, NONE, y, f, p, held)


@kernel(_t.UniTuple(_t.float64, 4)(_t.boolean, _t.float64, _t.float64, VECTOR, MATRIX, VECTOR, _t.boolean))
def _struck_once(right, u, v, y, f, p, held):
    """Return theta', u, v and loss of one corner's impact; a rebound too small to matter is left out where contact would hold."""
    omega, rate, slip, loss = struck(right, y[THETA], y[OMEGA], u, v, p[RESTITUTION], p, held)
    if 0.0 < rate < p[SMALL_RATE] and p[RESTITUTION] > 0.0:
        plastic = struck(right, y[THETA], y[OMEGA], u, v, 0.0, p, held)
        stays = following(not right, right, NONE, y[THETA], plastic[0], plastic[2], f, p, held) != FLIGHT
        if plastic[1] < p[SMALL_RATE] and stays:
            return plastic[0], 0.0, plastic[2], plastic[3]
    return omega, rate, slip, loss


@kernel(_STRIKE)
def _land_flat(right, y, f, p, held):
    """Land on the whole base, or trip over the corner to which it slides."""
    w = -y[RATE_RIGHT]
    speed = y[SPEED]
    s = 1.0 if speed > 0.0 else -1.0
    e = p[RESTITUTION]
    for _ in range(2):
        pressed = (1.0 + e) * w
        rubbed = abs(speed) if held else min(abs(speed), p[MU_KINETIC] * pressed)
        reach = s * rubbed * p[HEIGHT]
        if not -p[ARM_LEFT] * pressed <= reach <= p[ARM_RIGHT] * pressed:
            break
        after = speed - s * rubbed
        if 0.0 < e * w < p[SMALL_RATE] and stays_flat(after, f, p, held):
            e = 0.0
            continue
        y[SPEED] = after
        y[LOSS] += 0.5 * (w * w * (1.0 - e * e) + speed * speed - after * after)
        if e > 0.0:
            y[GAP_LEFT] = y[GAP_RIGHT] = 0.0
            y[RATE_LEFT] = y[RATE_RIGHT] = e * w
            return FLIGHT
        return go_on(True, True, NONE, y, f, p, held)
    about = s > 0.0
    omega, rate, slip, loss = _struck_once(about, -w, speed, y, f, p, held)
    if rate + (foot(about, p) - foot(not about, p)) * omega <= 0.0:
        return _both(about, -w, y, f, p, held)
    y[OMEGA] = omega
    y[SPEED] = slip
    y[LOSS] += loss
    if rate > 0.0:
        return lift_off(about, rate, y, p)
    return go_on(not about, about, NONE, y, f, p, held)


@kernel(_STRIKE)
def _close(right, y, f, p, held):
    """Return the mode after a corner that leaves the ground has met it again within the resolution of time."""
    gap, rate = (GAP_LEFT, RATE_LEFT) if right else (GAP_RIGHT, RATE_RIGHT)
    slip = y[SPEED] + corner(right, y[THETA], p)[1] * y[OMEGA]
    if y[gap] == 0.0 and abs(y[rate]) < p[SMALL_RATE] and stays_flat(slip, f, p, held):
        return _put_flat(y[OMEGA], slip, y, f, p, held)
    y[SPEED] = slip
    return go_on(not right, right, NONE, y, f, p, held)


@kernel(_STRIKE)
def land(right, y, f, p, held):
    """Return the mode after a corner of a flying body has met the ground ([WangMason1992]_)."""
    gap, rate = (GAP_RIGHT, RATE_RIGHT) if right else (GAP_LEFT, RATE_LEFT)
    at_once = y[gap] == 0.0
    y[gap] = 0.0
    if y[rate] >= 0.0:
        if at_once and y[rate] < p[SMALL_RATE]:
            return _close(right, y, f, p, held)
        return FLIGHT
    y[IMPACTS] += 1.0
    if y[THETA] == 0.0 and y[OMEGA] == 0.0:
        return _land_flat(right, y, f, p, held)
    slip = y[SPEED] + corner(right, y[THETA], p)[1] * y[OMEGA]
    y[OMEGA], after, y[SPEED], loss = _struck_once(right, y[rate], slip, y, f, p, held)
    y[LOSS] += loss
    if after > 0.0:
        return lift_off(right, after, y, p)
    apart = foot(right, p) - foot(not right, p)
    falls = -apart * math.cos(y[THETA]) * y[OMEGA]
    if falls > 0.0 and p[GRAVITY] * apart * math.sin(y[THETA]) < AT_ONCE * p[SMALL_RATE] * falls:
        # it clatters: the other corner follows within 1e-16 sqrt(R/g), and so on without end; both at once is the limit
        y[THETA] = 0.0
        y[IMPACTS] += 1.0
        return _both(right, foot(right, p) * y[OMEGA], y, f, p, held)
    return go_on(not right, right, NONE, y, f, p, held)


@kernel(_t.Tuple((_t.float64, _t.float64, _t.float64, _t.boolean))(_t.boolean, VECTOR, VECTOR, _t.boolean))
def _given_ratio(onto_right, y, p, held):
    """Return theta', slip velocity, loss and whether the ratio was lowered, of a rocking impact with a ratio that is given."""
    h = p[HEIGHT]
    mu = p[MU_KINETIC]
    omega = y[OMEGA]
    fall = foot(not onto_right, p) * omega
    speed = y[SPEED] + h * omega
    energy = speed * speed + fall * fall + p[GYRATION] * omega * omega
    low = 0.0
    high = p[ROCKING_RESTITUTION]
    if high < 0.0:
        # less a share of Housner's ratio
        struck_foot = foot(onto_right, p)
        kept = p[GYRATION] + h * h + struck_foot * foot(not onto_right, p)
        high *= -max(kept, 0.0) / (p[GYRATION] + h * h + struck_foot * struck_foot)
    ratio = high
    lowered = False
    for _ in range(HALVINGS + 1):
        turned = ratio * omega
        rise = foot(onto_right, p) * turned
        need = h * turned - speed
        rubbed = mu * (rise - fall)
        sticks = held or abs(need) <= rubbed
        after = h * turned if sticks else speed + math.copysign(rubbed, need)
        left = after * after + rise * rise + p[GYRATION] * turned * turned
        if left <= energy * (1.0 + ROUND_OFF):
            if ratio == high:
                break
            low = ratio
        else:
            lowered = True
            high = ratio
        ratio = 0.5 * (low + high)
    return turned, 0.0 if sticks else after - h * turned, 0.5 * (energy - left), lowered


@kernel(_STRIKE)
def come_down(onto_right, y, f, p, held):
    """Return the mode after the other corner of a rocking or skidding body has come down ([Housner1963]_, [WangMason1992]_)."""
    at_once = y[THETA] == 0.0
    y[THETA] = 0.0
    omega = y[OMEGA]
    slip = y[SPEED]
    apart = foot(onto_right, p) - foot(not onto_right, p)
    if apart * omega <= 0.0:
        if at_once and 0.0 < abs(apart * omega) < p[SMALL_RATE] and stays_flat(slip, f, p, held):
            return _put_flat(omega, slip, y, f, p, held)
        # it does not press: the last digit of a lean that has just begun, or of none
        return go_on(onto_right or omega == 0.0, not onto_right or omega == 0.0, NONE, y, f, p, held)
    y[IMPACTS] += 1.0
    rate = 0.0
    if p[ROCKING_RESTITUTION] > NONE:
        turned, after, loss, lowered = _given_ratio(onto_right, y, p, held)
        if lowered:
            y[LOWERED] += 1.0
    else:
        turned, rate, after, loss = _struck_once(onto_right, -apart * omega, slip, y, f, p, held)
        if rate + apart * turned <= 0.0:
            return _both(onto_right, foot(not onto_right, p) * omega, y, f, p, held)
    y[OMEGA] = turned
    y[SPEED] = after
    y[LOSS] += loss
    if rate > 0.0:
        return lift_off(onto_right, rate, y, p)
    if abs(apart * turned) < p[SMALL_RATE] and stays_flat(after, f, p, held):
        return _put_flat(turned, after, y, f, p, held)
    if turned == 0.0:
        return go_on(True, True, NONE, y, f, p, held)
    return go_on(not onto_right, onto_right, NONE, y, f, p, held)
