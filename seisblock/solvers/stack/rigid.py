"""One step of a pile of rigid contacts: where the stones meet, and the impulses there.

The leapfrog of :mod:`seisblock.solvers.stack.step` goes on as it is: positions at the step, velocities half a step before. Impulses act at
the places of the step, which keeps the energy; that a point comes to rest is asked of its velocity half a step later, when the body has
turned, so that a stone that turns about a point leaves it there to the third order of the step. What is left of a gap is made good in the
next step and does not grow ([Moreau1988]_).
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import MATRIX
from seisblock.solvers.stack.arguments import LAYOUT, MEMORY
from seisblock.solvers.stack.contact import EARLIER, PUSH, SLIDES
from seisblock.solvers.stack.floors import far_round, lay_floors
from seisblock.solvers.stack.frames import INVERSE, F, L, R, T, V
from seisblock.solvers.stack.friction import NOTICED, along_face, far_turned, lay_cones, look_back, settle_slips
from seisblock.solvers.stack.impulse import ARM_A, ARM_B, DEALT, GAP, GIVEN, IMPULSE, VEERING, press
from seisblock.solvers.stack.lying import carried, lie_down, rouse
from seisblock.solvers.stack.meet import find
from seisblock.solvers.stack.row import (
    AHEAD,
    BEFORE,
    FALL,
    FIRST,
    JOINTS,
    KICKED,
    PRESSED,
    ROWS,
    STRUCK,
    SWEPT,
    WHOLE,
    force_of,
)
from seisblock.solvers.stack.strike import (
    at_impact,
    begin_impacts,
    end_impact,
    let_go,
    share,
    soonest,
    strikes,
    until_impact,
)
from seisblock.solvers.stack.sweeps import PRECISION, UNSETTLED, settle_surely, work_done

_t = types()

IMPACTS = 16
"""How often points strike in one instant at most, each time what the last impact drove together."""

FORESIGHT = 0.9
"""Of a whole step: what points that share a load do against each other then fades."""


@kernel(_t.void(_t.int64, MATRIX, MATRIX, MEMORY), inline=True)
def _prepare(n, bodies, inert, memory):
    """Write the inverse inertia of the bodies as they lie, their velocities, and how their spins change by turning."""
    for i in range(n):
        b, v, j = bodies[i], memory.speeds[i], memory.inverses[i]
        for p in range(3):
            r0, r1, r2 = b[R + 3 * p], b[R + 3 * p + 1], b[R + 3 * p + 2]
            c = INVERSE
            s0 = r0 * inert[i, c] + r1 * inert[i, c + 3] + r2 * inert[i, c + 6]
            s1 = r0 * inert[i, c + 1] + r1 * inert[i, c + 4] + r2 * inert[i, c + 7]
            s2 = r0 * inert[i, c + 2] + r1 * inert[i, c + 5] + r2 * inert[i, c + 8]
            for q in range(3):
                j[3 * p + q] = s0 * b[R + 3 * q] + s1 * b[R + 3 * q + 1] + s2 * b[R + 3 * q + 2]
        v[0], v[1], v[2] = b[V], b[V + 1], b[V + 2]
        for p in range(3):
            v[3 + p] = j[3 * p] * b[L] + j[3 * p + 1] * b[L + 1] + j[3 * p + 2] * b[L + 2]
        # a body that turns on with the same angular momentum: w' = -J (w x L)
        g0, g1, g2 = v[4] * b[L + 2] - v[5] * b[L + 1], v[5] * b[L] - v[3] * b[L + 2], v[3] * b[L + 1] - v[4] * b[L]
        for p in range(3):
            v[VEERING + p] = -(j[3 * p] * g0 + j[3 * p + 1] * g1 + j[3 * p + 2] * g2)


@kernel(_t.void(MEMORY))
def _remember(memory):
    """Keep where the next step finds them the forces that pressed, and what slid."""
    pressed, least = memory.pace[PRESSED], NOTICED * memory.pace[FALL]
    for i in range(int(memory.pace[ROWS])):
        who, row = memory.who[i], memory.table[i]
        a, b = who[FIRST], who[FIRST + 1]
        slot = memory.joint_slots[who[3], who[4], who[5]] if who[2] == JOINTS else memory.corner_slots[who[3], who[4], who[5]]
        for k in range(3):
            slot[EARLIER + k] = slot[PUSH + k]
            slot[PUSH + k] = force_of(row[IMPULSE + k], pressed, 0.0 if memory.pace[STRUCK] > 0.0 else slot[PUSH + k], memory)
        slot[SLIDES] = 0.0
        if row[IMPULSE] == 0.0 and row[IMPULSE + 1] == 0.0 and row[IMPULSE + 2] == 0.0 and row[GAP] > 0.0:
            continue
        u0, u1, u2 = along_face(who[0], who[1], row, memory)
        slot[SLIDES] = 1.0 if u0 * u0 + u1 * u1 + u2 * u2 > least**2 else 0.0
        if row[IMPULSE] == 0.0 and row[IMPULSE + 1] == 0.0 and row[IMPULSE + 2] == 0.0:
            continue
        memory.touched[a, b] = 1.0
        memory.touched[b, a] = 1.0


@kernel(_t.void(_t.int64, MATRIX, _t.boolean, MEMORY))
def _leave(count, bodies, struck, memory):
    """Add the impulses to the bodies as forces over the step."""
    dt = memory.pace[KICKED]
    for i in range(count):
        row, a, b = memory.table[i], memory.who[i, FIRST], memory.who[i, FIRST + 1]
        p0, p1, p2 = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2]
        if struck:
            p0, p1, p2 = p0 + row[GIVEN], p1 + row[GIVEN + 1], p2 + row[GIVEN + 2]
        first, second = bodies[a], bodies[b]
        p0, p1, p2 = p0 / dt, p1 / dt, p2 / dt
        x, y, z = row[ARM_A], row[ARM_A + 1], row[ARM_A + 2]
        r, s, t = row[ARM_B], row[ARM_B + 1], row[ARM_B + 2]
        first[F] += p0
        first[F + 1] += p1
        first[F + 2] += p2
        first[T] += y * p2 - z * p1
        first[T + 1] += z * p0 - x * p2
        first[T + 2] += x * p1 - y * p0
        second[F] -= p0
        second[F + 1] -= p1
        second[F + 2] -= p2
        second[T] -= s * p2 - t * p1
        second[T + 1] -= t * p0 - r * p2
        second[T + 2] -= r * p1 - s * p0


@kernel(_t.void(_t.int64, _t.int64, _t.float64, _t.float64, _t.float64, _t.float64, LAYOUT, MEMORY), inline=True)
def _go_on(count, n, time, a0, a1, a2, pile, memory):
    """Let the velocities go on for a time in axes that accelerate, under the forces that stand in the rows."""
    for i in range(n):
        memory.speeds[i, 0] -= time * a0
        memory.speeds[i, 1] -= time * a1
        memory.speeds[i, 2] -= time * a2
    press(count, memory.who, memory.table, n, pile.inert, time, memory.speeds)


@kernel(_t.void(_t.int64, _t.int64, _t.float64, LAYOUT, MEMORY))
def _strike(count, n, before, pile, memory):
    """Let points strike: what the forces gave until then and what the impacts give becomes the impulse given.

    A given ratio of velocities across a joint and friction may together give energy; such an impact is plastic. What is so near that an
    impact lets it strike in the same instant does so in another one.
    """
    table, tolerance = memory.table, PRECISION * memory.pace[FALL]
    until_impact(count, before, memory)
    settle_surely(count, memory.who, table, n, pile.inert, tolerance, memory.speeds)
    begin_impacts(count, memory)
    for _ in range(IMPACTS):
        if not strikes(count, memory):
            break
        rows = at_impact(count, n, pile, memory)
        settle_surely(rows, memory.who, table, n, pile.inert, tolerance, memory.speeds)
        if rows > count and work_done(rows, memory.who, table, n, pile.inert, UNSETTLED * tolerance, memory.speeds) > 0.0:
            let_go(count, rows, n, pile, memory)
            settle_surely(count, memory.who, table, n, pile.inert, tolerance, memory.speeds)
        else:
            share(count, rows, memory)
        end_impact(count, rows, memory)
    look_back(count, True, memory)
    for i in range(count):
        for k in range(3):
            table[i, IMPULSE + k] = force_of(table[i, GIVEN + k], before, 0.0, memory)
            table[i, GIVEN + k] += table[i, DEALT + k]


@kernel(_t.float64(MATRIX, _t.float64, _t.float64, _t.float64, _t.float64, _t.boolean, LAYOUT, MEMORY), inline=True)
def _try(bodies, a0, a1, a2, left, look, pile, memory):
    """Add the forces at the points of what does not lie still; return the length of the step."""
    n, pace, table = bodies.shape[0] - 1, memory.pace, memory.table
    before = 0.5 * pace[BEFORE]
    _prepare(n, bodies, pile.inert, memory)
    count = find(bodies, left, look, pile, memory)
    look_back(count, False, memory)
    _go_on(count, n, before, a0, a1, a2, pile, memory)
    struck = strikes(count, memory)
    if struck:
        _strike(count, n, before, pile, memory)
        strikes(count, memory)
    _go_on(count, n, 0.5 * left, a0, a1, a2, pile, memory)
    since, until = (0.5 * left, 0.0) if struck else (before + 0.5 * left, before)
    far = min(far_round(count, left, memory), far_turned(count, since, until, left, memory))
    step = soonest(count, 0.5 * left, far, memory)
    if step < left:
        _go_on(count, n, 0.5 * (step - left), a0, a1, a2, pile, memory)
    pace[KICKED] = before + 0.5 * step
    pressed = 0.5 * step if struck else pace[KICKED]
    for i in range(count):
        for j in range(IMPULSE, IMPULSE + 3):
            table[i, j] *= pressed
    lay_floors(count, step, memory)
    lay_cones(count, memory)
    pace[SWEPT] = settle_slips(count, n, struck, pile, memory)
    _leave(count, bodies, struck, memory)
    pace[STRUCK] = 1.0 if struck else 0.0
    pace[ROWS] = count
    pace[PRESSED] = pressed
    return step


@kernel(_t.float64(MATRIX, _t.float64, _t.float64, _t.float64, _t.float64, _t.float64, _t.boolean, LAYOUT, MEMORY), inline=True)
def hold(bodies, a0, a1, a2, whole, left, look, pile, memory):
    """Add the forces that rigid contacts exert over a step, in axes that accelerate by (a0, a1, a2), gravity among it; return its length.

    The step ends where a point strikes. The next one then begins with the impact.

    Parameters
    ----------
    whole, left : float, s
        A whole step, and what is left of it.
    look : bool
        Whether to find anew which boxes are near each other, with a margin for what they may move until the next time.
    """
    n, pace = bodies.shape[0] - 1, memory.pace
    pace[WHOLE] = whole
    pace[FALL] = whole * (a0 * a0 + a1 * a1 + a2 * a2) ** 0.5
    pace[AHEAD] = FORESIGHT if pace[STRUCK] == 0.0 and pace[KICKED] == whole and 0.5 * (pace[BEFORE] + left) == whole else 0.0
    while True:
        step = _try(bodies, a0, a1, a2, left, look, pile, memory)
        if carried(n, bodies, a0, a1, a2, pile, memory):
            break
        rouse(n, bodies, memory)
        pace[AHEAD], look = 0.0, False
    _remember(memory)
    lie_down(int(pace[ROWS]), n, pile, memory)
    return step
