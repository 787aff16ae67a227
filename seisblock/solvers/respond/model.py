"""A free-standing rigid block in five modes: rest, slide, rock, slide-rock and flight, and what takes one into another.

Assumptions
    Plane motion; rigid block on rigid ground, touching it with its two lower corners; Coulomb friction with mu_s >= mu_k (kinetic inside
    impacts); Poisson's restitution along Routh's path for one corner, plastic impacts of both at once. No contact stiffness, no
    rounded edges, no twist.
Frame
    Fixed to the ground: x right, y up, theta clockwise, so positive when the block leans to +x. Between samples the ground's
    acceleration is a straight line.
Modes
    Named in ``names``; their motions and limits in ``flat``, ``turning`` and ``skid``; which follows in ``succession``; impacts in
    ``impulse`` and ``impacts``. A mode lives while its guards are positive; when one is reached the mode is excluded and the first
    consistent one of a fixed order follows, so that below Painleve's limit there is exactly one.
Tenon
    Ours: a body held by tenons of a given depth has friction without limit until, in flight, the lower foot has risen by that depth; from
    then on Coulomb's. A tenon pressed aside binds: it holds its foot down, too, as long as the foot, let go, would not rise for good.
    In flight it does nothing; where a foot comes down its slip is stopped before the ground presses. It lets a post rock whose bare
    plinth would only slide, as [Sugimoto2017]_ takes it.
End
    A quarter turn, or a further point that meets the ground. On still ground also rest.
Literature
    [ShentonJones1991]_, [Shenton1996]_, [WangMason1992]_, [Moreau1988]_, [GenotBrogliato1999]_, [Housner1963]_.
"""

from __future__ import annotations

import functools
from dataclasses import replace

from seisblock._jit import kernel, types
from seisblock.dynamics import Model
from seisblock.dynamics.arrays import MATRIX, VECTOR
from seisblock.dynamics.hybrid import CONSTANT, OFF, RESET, SERIES
from seisblock.solvers.respond.flat import flight_series, release_slack, rest_slacks, skip, slide_series
from seisblock.solvers.respond.impacts import come_down, go_on, land
from seisblock.solvers.respond.names import (
    DOWN,
    DT,
    END,
    FLIGHT,
    GAP_LEFT,
    GAP_RIGHT,
    GAVE_UP,
    GRAVITY,
    GUARDS,
    HALF_PI,
    HEIGHT,
    HELD,
    IMPACTS,
    LAND_RIGHT,
    LEFT,
    LIFT,
    MODES,
    MOST_IMPACTS,
    NONE,
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
    SHARP,
    SKID_RIGHT_PLUS,
    SLIP,
    SPEED,
    START,
    STATES,
    STILL,
    TENON,
    THETA,
    corner,
    foot,
    is_right,
    sense,
)
from seisblock.solvers.respond.skid import skid_series
from seisblock.solvers.respond.succession import UP, loads, sticking
from seisblock.solvers.respond.turning import BOUND, RX, rock_series

_t = types()

SCRATCH = 4
"""Rows that the series need: the arms of one or both corners, a force, a velocity."""

SAME = 1e-13
"""Share of its two parts below which a slip velocity is taken as zero when a body is put down."""


@kernel(_t.void(_t.boolean, _t.int64, _t.int64, VECTOR, MATRIX, MATRIX), inline=True)
def _point_slacks(right, arms, degree, p, c, g):
    """Write the heights of the further points above a corner, from the arms of that corner in two rows of `c`."""
    xi = foot(right, p)
    h = p[HEIGHT]
    per_square = 1.0 / (xi * xi + h * h)
    for point in range((p.size - POINTS) // 2):
        ahead = p[POINTS + 2 * point]
        above = p[POINTS + 2 * point + 1]
        of_x = per_square * (ahead * h + above * xi)
        of_y = per_square * (ahead * xi - above * h) - 1.0
        for k in range(degree + 1):
            g[END + 1 + point, k] = of_x * c[arms, k] + of_y * c[arms + 1, k]


@kernel(SERIES)
def series(mode, y, f, p, order, c, g):
    """Write the motion of one mode and its slacks."""
    held = mode >= HELD
    kind = mode - HELD if held else mode
    for k in range(END):
        g[k, 0] = OFF
    if kind == REST:
        rest_slacks(held, f, p, g)
        for k in range(END, g.shape[0]):
            g[k, 0] = OFF
        return CONSTANT
    if kind == START:
        g[LEFT, 0] = -1.0
        g[LEFT, 1] = 0.0
        for k in range(END, g.shape[0]):
            g[k, 0] = OFF
        return CONSTANT
    if kind == FLIGHT:
        degree = flight_series(y, f, p, order, c, g)
        if held:
            release_slack(y, p, degree, c, g)
        side = 1.0 if y[OMEGA] >= 0.0 else -1.0
        g[END, 0] = OFF
        if side * (y[THETA] + y[OMEGA] * p[DT]) > 1.0:
            for k in range(degree + 1):
                g[END, k] = -side * c[THETA, k]
            g[END, 0] += HALF_PI
        _point_slacks(True, y.size + 2, degree, p, c, g)
        for k in range(degree + 1):
            for point in range(END + 1, g.shape[0]):
                g[point, k] += c[GAP_RIGHT, k]
        return degree
    if kind in (ROCK_RIGHT, ROCK_LEFT):
        degree = rock_series(is_right(kind), 1.0 if held else 0.0, y, f, p, order, c, g)
    elif kind >= SKID_RIGHT_PLUS:
        degree = skid_series(is_right(kind), sense(kind), y, f, p, order, c, g)
    else:
        degree = slide_series(sense(kind), y, f, p, c, g)
        for k in range(END, g.shape[0]):
            g[k, 0] = OFF
        return degree
    _point_slacks(is_right(kind), y.size + RX, degree, p, c, g)
    return degree


@kernel(_t.int64(VECTOR, MATRIX, VECTOR, _t.boolean))
def _put_down(y, f, p, held):
    """Return the mode of a body put down as its gaps and their rates say."""
    left = y[GAP_LEFT] == 0.0
    right = y[GAP_RIGHT] == 0.0
    if not left and not right:
        return FLIGHT
    about = right
    if left and right:
        about = y[RATE_RIGHT] <= y[RATE_LEFT]
    rate = y[RATE_RIGHT] if about else y[RATE_LEFT]
    other = y[RATE_LEFT] if about else y[RATE_RIGHT]
    if rate > 0.0:
        return FLIGHT
    turning = corner(about, y[THETA], p)[1] * y[OMEGA]
    slip = y[SPEED] + turning
    if abs(slip) <= SAME * (abs(y[SPEED]) + abs(turning)):
        slip = 0.0
    if rate < 0.0 and not (left and right and other == 0.0):
        return land(about, y, f, p, held)
    y[SPEED] = slip
    if rate < 0.0:
        return come_down(about, y, f, p, held)
    return go_on(left and (not about or other == 0.0), right and (about or other == 0.0), NONE, y, f, p, held)


@kernel(_t.boolean(_t.boolean, VECTOR, MATRIX, VECTOR), inline=True)
def _rises(right, y, f, p):
    """Whether a foot that a tenon holds down, let go, would rise and go on rising, or is pressed aside no more."""
    rx, ry = corner(right, y[THETA], p)
    spin = y[OMEGA] ** 2
    push, weight = loads(0.0, f, p)
    tangential = sticking(rx, ry, spin, push, weight, p)[2]
    down = weight + ry * spin
    if down > BOUND * p[GRAVITY]:
        return False
    return f[UP, 1] - rx * y[OMEGA] * spin < 0.0 or (down < -BOUND * p[GRAVITY] and abs(tangential) < BOUND * p[GRAVITY])


@kernel(RESET)
def reset(mode, guard, y, f, p):
    """Return the mode that follows a guard: an impact, the end, or the first consistent mode."""
    held = mode >= HELD
    kind = mode - HELD if held else mode
    if guard >= END:
        return OVERTURNED
    if guard == RELEASE:
        return FLIGHT if min(y[GAP_LEFT], y[GAP_RIGHT]) >= p[TENON] * (1.0 - SAME) else mode
    if kind == START:
        following = _put_down(y, f, p, held)
    elif kind == FLIGHT:
        following = land(guard == LAND_RIGHT, y, f, p, held)
    elif guard == DOWN and y[THETA] == 0.0 and y[OMEGA] == 0.0:
        # it would turn the other way from the beginning
        following = go_on(True, True, kind, y, f, p, held)
    elif guard == DOWN:
        following = come_down(not is_right(kind), y, f, p, held)
    else:
        if guard == SLIP:
            y[SPEED] = 0.0
        ended = kind
        if held and guard == LIFT:
            ended = kind if _rises(is_right(kind), y, f, p) else NONE
        # a body that has not yet begun to turn still touches with both corners
        flat = (kind != ROCK_RIGHT and kind != ROCK_LEFT and kind < SKID_RIGHT_PLUS) or (y[THETA] == 0.0 and y[OMEGA] == 0.0)
        following = go_on(flat or not is_right(kind), flat or is_right(kind), ended, y, f, p, held)
    if following == REST and p[STILL] > 0.0:
        return SETTLED
    if y[IMPACTS] > p[MOST_IMPACTS]:
        return GAVE_UP
    return following + HELD if held else following


RESPOND = Model("respond", series, reset, STATES, GUARDS, MODES, scratch=SCRATCH, tracked=2, skip=skip, sharp=SHARP)


@functools.cache
def model_with(points: int) -> Model:
    """Return the model of bodies with so many further points, one guard each."""
    return replace(RESPOND, guards=GUARDS + ("further point",) * points) if points else RESPOND
