"""Hybrid model of a free-standing rigid block: rest, sliding, rocking, slide-rocking and flight, with their transitions.

Assumptions
    Plane motion; rigid block on rigid ground, touching it with its two lower corners; Coulomb friction with mu_s >= mu_k (kinetic inside
    impacts); Poisson's restitution along Routh's path for one corner, plastic impacts of both at once. No contact stiffness, no
    rounded edges, no twist.
Frame
    Fixed to the ground: x right, y up, theta clockwise, so positive when the block leans to +x. Between samples the ground's
    acceleration is a straight line.
Modes
    Indices in ``constants``; equations of motion and guards in ``polynomial_modes``, ``rocking`` and ``slide_rocking``; selection of the
    next mode in ``mode_selection``; impacts in ``impact_laws`` and ``impacts``. A mode lasts while its guards are positive. At a guard the
    mode is excluded and the first consistent mode of a fixed order follows; below Painleve's limit exactly one is consistent.
Tenon
    Extension of this package: a body with tenons of a given depth has unlimited friction until, in flight, the lower foot has risen by
    that depth, and Coulomb friction afterwards. A tenon under lateral load also holds its foot down as long as the released foot would not
    rise permanently. It has no effect in flight; at a landing it stops the slip of the foot before the normal impulse acts. A post whose
    bare plinth would only slide can therefore rock, as assumed by [Sugimoto2017]_.
End
    Tilt of pi/2, or contact of a further point with the ground; after the record also rest.
Literature
    [ShentonJones1991]_, [Shenton1996]_, [WangMason1992]_, [Moreau1988]_, [GenotBrogliato1999]_, [Housner1963]_.
"""

from __future__ import annotations

import functools
from dataclasses import replace

from seisblock._jit import kernel, types
from seisblock.dynamics import Model
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.dynamics.hybrid import CONSTANT, OFF, RESET, SERIES
from seisblock.models.respond.constants import (
    DOWN,
    DT,
    END,
    FLIGHT,
    GAP_LEFT,
    GAP_RIGHT,
    GAVE_UP,
    GRAVITY,
    GROUND_AT_REST,
    GUARDS,
    HALF_PI,
    HEIGHT,
    IMPACTS,
    LAND_RIGHT,
    LEFT,
    LIFT,
    MAX_IMPACTS,
    MODES,
    N_STATE_GUARDS,
    NO_MODE,
    OMEGA,
    OVERTURNED,
    POINTS,
    RATE_LEFT,
    RATE_RIGHT,
    RELEASE,
    REST,
    ROCK_LEFT,
    ROCK_RIGHT,
    SETTLED,
    SLIDE_ROCK_RIGHT_PLUS,
    SLIP,
    SPEED,
    START,
    STATES,
    TENON,
    TENON_OFFSET,
    THETA,
    corner_offset,
    corner_position,
    is_right,
    slip_sign,
)
from seisblock.models.respond.impacts import continue_in_contact, land, rocking_impact
from seisblock.models.respond.mode_selection import UP, ground_loads, sticking_forces
from seisblock.models.respond.polynomial_modes import flight_series, release_slack, rest_slacks, skip, slide_series
from seisblock.models.respond.rocking import RX, TENON_FORCE_RATIO, rock_series
from seisblock.models.respond.slide_rocking import slide_rock_series

_t = types()

SCRATCH = 4
"""Scratch rows of the series: arms of one or both corners, a force, a velocity."""

SLIP_TOLERANCE = 1e-13
"""Slip velocity of the initial state over the sum of its two parts, below which it is zero."""


@kernel(_t.void(_t.boolean, _t.int64, _t.int64, VECTOR, MATRIX, MATRIX), inline=True)
def _point_slacks(right, arms, degree, p, c, g):
    """Write the heights of the further points above a corner, linear in the arms of that corner in rows `arms`, `arms` + 1 of `c`."""
    xi = corner_offset(right, p)
    h = p[HEIGHT]
    # sin(theta) and cos(theta) are linear in the arms (r_x, r_y) of a corner, so that the height of any point of the
    # body needs no series of its own
    per_square = 1.0 / (xi * xi + h * h)
    for point in range((p.size - POINTS) // 2):
        point_x = p[POINTS + 2 * point]
        point_y = p[POINTS + 2 * point + 1]
        of_x = per_square * (point_x * h + point_y * xi)
        of_y = per_square * (point_x * xi - point_y * h) - 1.0
        for k in range(degree + 1):
            g[END + 1 + point, k] = of_x * c[arms, k] + of_y * c[arms + 1, k]


@kernel(SERIES)
def series(mode, y, f, p, order, c, g):
    """Write the power series of one mode into `c` and its guards into `g`; return the degree."""
    has_tenon = mode >= TENON_OFFSET
    kind = mode - TENON_OFFSET if has_tenon else mode
    for k in range(END):
        g[k, 0] = OFF
    if kind == REST:
        rest_slacks(has_tenon, f, p, g)
        for k in range(END, g.shape[0]):
            g[k, 0] = OFF
        return CONSTANT
    # a guard that is negative at once hands over to `reset`, which finds the first mode
    if kind == START:
        g[LEFT, 0] = -1.0
        g[LEFT, 1] = 0.0
        for k in range(END, g.shape[0]):
            g[k, 0] = OFF
        return CONSTANT
    if kind == FLIGHT:
        degree = flight_series(y, f, p, order, c, g)
        if has_tenon:
            release_slack(y, p, degree, c, g)
        side = 1.0 if y[OMEGA] >= 0.0 else -1.0
        # the guard of the quarter turn costs a root search: only where the tilt can exceed 1 rad within the step
        g[END, 0] = OFF
        if side * (y[THETA] + y[OMEGA] * p[DT]) > 1.0:
            for k in range(degree + 1):
                g[END, k] = -side * c[THETA, k]
            g[END, 0] += HALF_PI
        _point_slacks(True, y.size + 2, degree, p, c, g)
        # in flight the right corner is itself at the height of its gap
        for k in range(degree + 1):
            for point in range(END + 1, g.shape[0]):
                g[point, k] += c[GAP_RIGHT, k]
        return degree
    if kind in (ROCK_RIGHT, ROCK_LEFT):
        degree = rock_series(is_right(kind), 1.0 if has_tenon else 0.0, y, f, p, order, c, g)
    elif kind >= SLIDE_ROCK_RIGHT_PLUS:
        degree = slide_rock_series(is_right(kind), slip_sign(kind), y, f, p, order, c, g)
    else:
        degree = slide_series(slip_sign(kind), y, f, p, c, g)
        for k in range(END, g.shape[0]):
            g[k, 0] = OFF
        return degree
    _point_slacks(is_right(kind), y.size + RX, degree, p, c, g)
    return degree


@kernel(_t.int64(VECTOR, MATRIX, VECTOR, _t.boolean))
def _initial_mode(y, f, p, has_tenon):
    """Return the first mode, from the gaps and gap rates of the initial state."""
    left = y[GAP_LEFT] == 0.0
    right = y[GAP_RIGHT] == 0.0
    if not left and not right:
        return FLIGHT
    pivot_right = right
    if left and right:
        # the corner that approaches the ground faster decides
        pivot_right = y[RATE_RIGHT] <= y[RATE_LEFT]
    rate = y[RATE_RIGHT] if pivot_right else y[RATE_LEFT]
    other_rate = y[RATE_LEFT] if pivot_right else y[RATE_RIGHT]
    if rate > 0.0:
        return FLIGHT
    rotation_speed = corner_position(pivot_right, y[THETA], p)[1] * y[OMEGA]
    slip = y[SPEED] + rotation_speed
    # two large parts that cancel leave round-off, which would select slip where the corner sticks
    if abs(slip) <= SLIP_TOLERANCE * (abs(y[SPEED]) + abs(rotation_speed)):
        slip = 0.0
    # with the other corner already resting this is a rocking impact, below; otherwise a landing
    if rate < 0.0 and not (left and right and other_rate == 0.0):
        return land(pivot_right, y, f, p, has_tenon)
    y[SPEED] = slip
    if rate < 0.0:
        return rocking_impact(pivot_right, y, f, p, has_tenon)
    return continue_in_contact(
        left and (not pivot_right or other_rate == 0.0), right and (pivot_right or other_rate == 0.0), NO_MODE, y, f, p, has_tenon
    )


@kernel(_t.boolean(_t.boolean, VECTOR, MATRIX, VECTOR), inline=True)
def _foot_rises(right, y, f, p):
    """Return whether a foot held down by a tenon would rise permanently if released, or has lost its lateral load."""
    rx, ry = corner_position(right, y[THETA], p)
    spin = y[OMEGA] ** 2
    push, weight = ground_loads(0.0, f, p)
    tangential = sticking_forces(rx, ry, spin, push, weight, p)[2]
    normal_force = weight + ry * spin
    # the normal force of the released foot is positive again: nothing to decide
    if normal_force > TENON_FORCE_RATIO * p[GRAVITY]:
        return False
    # in flight theta'' = 0, hence d/dt (G + r_y theta'^2) = a_y' - r_x theta'^3. Where the force is zero its rate
    # decides whether the foot stays on the ground.
    return f[UP, 1] - rx * y[OMEGA] * spin < 0.0 or (
        normal_force < -TENON_FORCE_RATIO * p[GRAVITY] and abs(tangential) < TENON_FORCE_RATIO * p[GRAVITY]
    )


@kernel(RESET)
def reset(mode, guard, y, f, p):
    """Return the mode after a guard: result of an impact, a terminal mode, or the first consistent mode."""
    has_tenon = mode >= TENON_OFFSET
    kind = mode - TENON_OFFSET if has_tenon else mode
    if guard >= END:
        return OVERTURNED
    # both feet must be out: the root of the guard is known up to round-off only. Without the offset, Coulomb friction
    # acts from here on.
    if guard == RELEASE:
        return FLIGHT if min(y[GAP_LEFT], y[GAP_RIGHT]) >= p[TENON] * (1.0 - SLIP_TOLERANCE) else mode
    if kind == START:
        target_mode = _initial_mode(y, f, p, has_tenon)
    elif kind == FLIGHT:
        target_mode = land(guard == LAND_RIGHT, y, f, p, has_tenon)
    elif guard == DOWN and y[THETA] == 0.0 and y[OMEGA] == 0.0:
        # rotation starts in the opposite sense: no impact, both corners are still in contact
        target_mode = continue_in_contact(True, True, kind, y, f, p, has_tenon)
    elif guard == DOWN:
        target_mode = rocking_impact(not is_right(kind), y, f, p, has_tenon)
    else:
        if guard == SLIP:
            y[SPEED] = 0.0
        ended_mode = kind
        if has_tenon and guard == LIFT:
            ended_mode = kind if _foot_rises(is_right(kind), y, f, p) else NO_MODE
        # without any rotation yet both corners are still in contact
        is_flat = (kind != ROCK_RIGHT and kind != ROCK_LEFT and kind < SLIDE_ROCK_RIGHT_PLUS) or (y[THETA] == 0.0 and y[OMEGA] == 0.0)
        target_mode = continue_in_contact(is_flat or not is_right(kind), is_flat or is_right(kind), ended_mode, y, f, p, has_tenon)
    # after the record no force can end a rest
    if target_mode == REST and p[GROUND_AT_REST] > 0.0:
        return SETTLED
    if y[IMPACTS] > p[MAX_IMPACTS]:
        return GAVE_UP
    return target_mode + TENON_OFFSET if has_tenon else target_mode


RESPOND = Model("respond", series, reset, STATES, GUARDS, MODES, scratch=SCRATCH, tracked=2, skip=skip, sharp=N_STATE_GUARDS)


@functools.cache
def model_with_points(points: int) -> Model:
    """Return the model with one more guard for each of `points` further points."""
    return replace(RESPOND, guards=GUARDS + ("further point",) * points) if points else RESPOND
