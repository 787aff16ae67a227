"""Rigid contacts: the impulses of one step at all points at once, by non-smooth Gauss-Seidel ([Jean1999]_, [Moreau1988]_).

At a contact the impulse P obeys Signorini's condition on velocities, 0 <= P_n, u_n >= b, P_n (u_n - b) = 0, and Coulomb's cone,
|P_t| <= mu P_n, with P_t against u_t where it slides ([Jean1999]_ section 3). b is what the gap leaves: -gap / dt while it is open, so
that it closes and no more; a slow push where it is closed too far. Each point in turn is solved exactly against what the others do; the
sweeps start from the forces of the steps before, and a conjugate gradient carries what they change on from one to the next
([Silcowitz2010]_).

Nothing says that such sweeps end, nor that there is an end: where friction is large it lifts what it should hold (Painleve), and one point
makes more of what the next one made. Where they do not, the step is solved again with cones that ask for a velocity in the dual cone,
u_n - b >= mu |u_t|: the impulses are then those of the least energy that cones about the normals allow, found from none on by steps that
never add any ([TasoraAnitescu2011]_). What slides in such a step is pushed away by mu times as much.

Restitution. An impact is plastic at the points that strike; those that leave are free. One block on its edges then turns about the far
edge with what angular momentum about it leaves, Housner's ratio. Where a joint is given a ratio of its own, the place where it pressed
leaves with that part of the velocity with which what strikes comes in: Newton's law across the joint. Where that and friction together
would give energy, the impact is plastic.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import INTEGER_TABLE, MATRIX, VECTOR
from seisblock.solvers.stack.impulse import (
    BEGAN,
    FLOOR,
    HEADING,
    HELD,
    IMPULSE,
    MU,
    NORMAL,
    SET_OUT,
    SHIFT,
    SWERVE,
    WI,
    W,
    parting,
    press,
    push,
)

_t = types()

SWEEPS = 1000
PRECISION = 5e-4
"""Most sweeps of a step; and the change of a velocity in a sweep, over that of a free fall in a step, at which they end."""

UNSETTLED, RUNAWAY = 10.0, 1e6
"""Change of a velocity in the last sweep, over that at which they end, from which they have not come to rest; and in any sweep, over that
in the first one, from which they never will."""

AIMS = 3
"""How often the direction of sliding is corrected at a point before the next one's turn."""

LEAST_SHARE = 0.05
"""Part of the normal term that is left at least where friction helps the normal impulse along (Painleve)."""


@kernel(_t.UniTuple(_t.float64, 3)(VECTOR, _t.float64, _t.float64, _t.float64), inline=True)
def _slide(row, c0, c1, c2):
    """Return the impulse at a point that slides, whose velocity without it is c."""
    n0, n1, n2 = row[NORMAL], row[NORMAL + 1], row[NORMAL + 2]
    q0, q1, q2, mu = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2], row[MU]
    s0, s1, s2 = row[SHIFT], row[SHIFT + 1], row[SHIFT + 2]
    wn0 = row[W] * n0 + row[W + 1] * n1 + row[W + 2] * n2
    wn1 = row[W + 3] * n0 + row[W + 4] * n1 + row[W + 5] * n2
    wn2 = row[W + 6] * n0 + row[W + 7] * n1 + row[W + 8] * n2
    normal = n0 * wn0 + n1 * wn1 + n2 * wn2
    wanted = row[FLOOR] - (c0 * n0 + c1 * n1 + c2 * n2)
    # the largest answer to a tangential impulse is no more than the trace
    gain = 1.0 / (row[W] + row[W + 4] + row[W + 8] - normal)
    shifted = normal + s0 * wn0 + s1 * wn1 + s2 * wn2
    p = q0 * n0 + q1 * n1 + q2 * n2
    d0, d1, d2 = 0.0, 0.0, 0.0
    for _ in range(AIMS):
        u0 = c0 + row[W] * q0 + row[W + 1] * q1 + row[W + 2] * q2
        u1 = c1 + row[W + 3] * q0 + row[W + 4] * q1 + row[W + 5] * q2
        u2 = c2 + row[W + 6] * q0 + row[W + 7] * q1 + row[W + 8] * q2
        u0, u1, u2 = q0 - p * s0 - gain * u0, q1 - p * s1 - gain * u1, q2 - p * s2 - gain * u2
        along = u0 * n0 + u1 * n1 + u2 * n2
        u0 -= along * n0
        u1 -= along * n1
        u2 -= along * n2
        size = math.sqrt(u0 * u0 + u1 * u1 + u2 * u2)
        if size > 0.0:
            d0, d1, d2 = u0 / size, u1 / size, u2 / size
        helped = shifted + mu * (d0 * wn0 + d1 * wn1 + d2 * wn2)
        p = wanted / max(helped, LEAST_SHARE * normal)
        held = min(mu * p, size) if p > 0.0 else 0.0
        q0, q1, q2 = p * (n0 + s0) + held * d0, p * (n1 + s1) + held * d1, p * (n2 + s2) + held * d2
    return q0, q1, q2


@kernel(_t.UniTuple(_t.float64, 3)(VECTOR, _t.float64, _t.float64, _t.float64), inline=True)
def _descend(row, c0, c1, c2):
    """Return the impulse at a point after a step down its energy, back into the cone; c is its velocity without any."""
    n0, n1, n2, floor, mu = row[NORMAL], row[NORMAL + 1], row[NORMAL + 2], row[FLOOR], row[MU]
    q0, q1, q2 = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2]
    gain = 1.0 / (row[W] + row[W + 4] + row[W + 8])
    u0 = c0 - floor * n0 + row[W] * q0 + row[W + 1] * q1 + row[W + 2] * q2
    u1 = c1 - floor * n1 + row[W + 3] * q0 + row[W + 4] * q1 + row[W + 5] * q2
    u2 = c2 - floor * n2 + row[W + 6] * q0 + row[W + 7] * q1 + row[W + 8] * q2
    q0, q1, q2 = q0 - gain * u0, q1 - gain * u1, q2 - gain * u2
    press = q0 * n0 + q1 * n1 + q2 * n2
    t0, t1, t2 = q0 - press * n0, q1 - press * n1, q2 - press * n2
    size = math.sqrt(t0 * t0 + t1 * t1 + t2 * t2)
    if size <= mu * press:
        return q0, q1, q2
    press = (press + mu * size) / (1.0 + mu * mu)
    if press <= 0.0:
        return 0.0, 0.0, 0.0
    part = mu * press / size
    return press * n0 + part * t0, press * n1 + part * t1, press * n2 + part * t2


@kernel(_t.UniTuple(_t.float64, 3)(VECTOR, _t.float64, _t.float64, _t.float64), inline=True)
def _hold(row, c0, c1, c2):
    """Return the impulse along the normal that gives a point its floor's velocity, be it a pull."""
    n0, n1, n2 = row[NORMAL], row[NORMAL + 1], row[NORMAL + 2]
    answer = n0 * (row[W] * n0 + 2.0 * (row[W + 1] * n1 + row[W + 2] * n2)) + n1 * (row[W + 4] * n1 + 2.0 * row[W + 5] * n2)
    p = (row[FLOOR] - (c0 * n0 + c1 * n1 + c2 * n2)) / (answer + row[W + 8] * n2 * n2)
    return p * n0, p * n1, p * n2


@kernel(_t.float64(_t.int64, _t.int64, _t.int64, MATRIX, VECTOR, _t.boolean, MATRIX))
def _relax(a, b, ground, inert, row, least, speeds):
    """Solve one point against what the others do, or let it make their energy the `least`; return how much its velocity changes by it."""
    u0, u1, u2 = parting(a, b, row, speeds)
    p0, p1, p2 = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2]
    c0 = u0 + row[SWERVE] - (row[W] * p0 + row[W + 1] * p1 + row[W + 2] * p2)
    c1 = u1 + row[SWERVE + 1] - (row[W + 3] * p0 + row[W + 4] * p1 + row[W + 5] * p2)
    c2 = u2 + row[SWERVE + 2] - (row[W + 6] * p0 + row[W + 7] * p1 + row[W + 8] * p2)
    n0, n1, n2, floor = row[NORMAL], row[NORMAL + 1], row[NORMAL + 2], row[FLOOR]
    q0, q1, q2 = 0.0, 0.0, 0.0
    if row[HELD] > 0.0:
        q0, q1, q2 = _hold(row, c0, c1, c2)
    elif (least and floor > -math.inf) or c0 * n0 + c1 * n1 + c2 * n2 < floor:
        e0, e1, e2 = floor * n0 - c0, floor * n1 - c1, floor * n2 - c2
        q0 = row[WI] * e0 + row[WI + 1] * e1 + row[WI + 2] * e2
        q1 = row[WI + 3] * e0 + row[WI + 4] * e1 + row[WI + 5] * e2
        q2 = row[WI + 6] * e0 + row[WI + 7] * e1 + row[WI + 8] * e2
        press = q0 * n0 + q1 * n1 + q2 * n2
        t0, t1, t2 = q0 - press * (n0 + row[SHIFT]), q1 - press * (n1 + row[SHIFT + 1]), q2 - press * (n2 + row[SHIFT + 2])
        if press <= 0.0 or t0 * t0 + t1 * t1 + t2 * t2 > (row[MU] * press) ** 2:
            q0, q1, q2 = _descend(row, c0, c1, c2) if least else _slide(row, c0, c1, c2)
    row[IMPULSE] = q0
    row[IMPULSE + 1] = q1
    row[IMPULSE + 2] = q2
    q0 -= p0
    q1 -= p1
    q2 -= p2
    if q0 != 0.0 or q1 != 0.0 or q2 != 0.0:
        push(a, b, ground, inert, row, q0, q1, q2, speeds)
    return (abs(q0) + abs(q1) + abs(q2)) * max(row[W], max(row[W + 4], row[W + 8]))


@kernel(_t.void(VECTOR, _t.int64, _t.int64, _t.int64), inline=True)
def _copy(row, source, target, count):
    """Copy numbers of a row from one place to another."""
    for k in range(count):
        row[target + k] = row[source + k]


@kernel(_t.void(_t.int64, _t.int64, MATRIX, MATRIX, _t.boolean), inline=True)
def _keep(n, bodies, table, speeds, back):
    """Keep velocities and impulses as they are before the sweeps, or give them `back`."""
    for i in range(bodies):
        _copy(speeds[i], SET_OUT if back else 0, 0 if back else SET_OUT, 6)
    for i in range(n):
        _copy(table[i], BEGAN if back else IMPULSE, IMPULSE if back else BEGAN, 3)


@kernel(_t.int64(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, _t.float64, MATRIX))
def settle(n, who, table, ground, inert, tolerance, speeds):
    """Find the impulses of `n` contacts; return how many sweeps it took, or none, and leave all as it was, where they do not come to rest.

    Parameters
    ----------
    who : (k, 2) array of int
        The bodies of each contact.
    table : (k, 92) array
        Contacts, with the impulses to start from.
    tolerance : float, m/s
    speeds : (m + 1, 15) array
        Velocities and spins with the impulses to start from; on return, with those that were found.
    """
    before, worst, most = 0.0, 0.0, math.inf
    _keep(n, ground, table, speeds, False)
    for sweep in range(SWEEPS):
        worst = 0.0
        for i in range(n):
            row = table[i]
            for k in range(3):
                row[HEADING + k] = row[IMPULSE + k]
            worst = max(worst, _relax(who[i, 0], who[i, 1], ground, inert, row, False, speeds))
        if worst < tolerance:
            return sweep + 1
        if sweep == 0:
            most = RUNAWAY * worst
        elif worst > most:
            break
        size = 0.0
        for i in range(n):
            row = table[i]
            for k in range(3):
                row[HEADING + k] = row[IMPULSE + k] - row[HEADING + k]
                size += row[HEADING + k] ** 2
        part = size / before if before > 0.0 else 2.0
        before = size
        for i in range(n):
            row = table[i]
            if part > 1.0:
                for k in range(3):
                    row[HEADING + 3 + k] = row[HEADING + k]
                continue
            p0, p1, p2 = part * row[HEADING + 3], part * row[HEADING + 4], part * row[HEADING + 5]
            row[HEADING + 3] = p0 + row[HEADING]
            row[HEADING + 4] = p1 + row[HEADING + 1]
            row[HEADING + 5] = p2 + row[HEADING + 2]
            row[IMPULSE] += p0
            row[IMPULSE + 1] += p1
            row[IMPULSE + 2] += p2
            push(who[i, 0], who[i, 1], ground, inert, row, p0, p1, p2, speeds)
    if worst < UNSETTLED * tolerance:
        return SWEEPS
    _keep(n, ground, table, speeds, True)
    return 0


@kernel(_t.int64(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, _t.float64, MATRIX))
def _settle_least(n, who, table, ground, inert, tolerance, speeds):
    """Find the impulses of the least energy in cones about the normals; return how many sweeps it took."""
    press(n, who, table, ground, inert, -1.0, speeds)
    for i in range(n):
        for k in range(3):
            table[i, IMPULSE + k] = 0.0
    for sweep in range(SWEEPS):
        worst = 0.0
        for i in range(n):
            worst = max(worst, _relax(who[i, 0], who[i, 1], ground, inert, table[i], True, speeds))
        if worst < tolerance:
            return sweep + 1
    return SWEEPS


@kernel(_t.float64(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, _t.float64, MATRIX))
def work_done(n, who, table, ground, inert, tolerance, speeds):
    """Return the work of the impulses of `n` contacts, J, at least: against the mean of the velocities without and with them.

    Velocities are known to a tolerance, m/s: an impact that keeps its energy does not give any.
    """
    press(n, who, table, ground, inert, -0.5, speeds)
    work = 0.0
    for i in range(n):
        row = table[i]
        u0, u1, u2 = parting(who[i, 0], who[i, 1], row, speeds)
        p0, p1, p2 = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2]
        work += p0 * u0 + p1 * u1 + p2 * u2 - tolerance * math.sqrt(p0 * p0 + p1 * p1 + p2 * p2)
    press(n, who, table, ground, inert, 0.5, speeds)
    return work


@kernel(_t.boolean(_t.int64, INTEGER_TABLE, MATRIX, _t.float64, MATRIX))
def drive(n, who, table, tolerance, speeds):
    """Whether the impulses of `n` contacts drive the bodies: sweeps then came to rest on no solution.

    No point leaves along what presses it in Signorini's and Coulomb's laws, beyond what floors and turning bodies ask for. Energy is lost
    then: the work of impulses P, against the mean of the velocities without and with them, is P u - P W P / 2.
    """
    power = 0.0
    for i in range(n):
        row = table[i]
        p0, p1, p2 = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2]
        if row[HELD] > 0.0:
            return False
        if p0 == 0.0 and p1 == 0.0 and p2 == 0.0:
            continue
        u0, u1, u2 = parting(who[i, 0], who[i, 1], row, speeds)
        asked = max(row[FLOOR], 0.0) + math.sqrt(row[SWERVE] ** 2 + row[SWERVE + 1] ** 2 + row[SWERVE + 2] ** 2)
        power += p0 * u0 + p1 * u1 + p2 * u2 - (asked + UNSETTLED * tolerance) * math.sqrt(p0 * p0 + p1 * p1 + p2 * p2)
    return power > 0.0


@kernel(_t.int64(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, _t.float64, MATRIX))
def settle_surely(n, who, table, ground, inert, tolerance, speeds):
    """Find the impulses of `n` contacts as :func:`settle` does, or, where its sweeps find no solution, those of the least energy."""
    sweeps = settle(n, who, table, ground, inert, tolerance, speeds)
    if sweeps > 0 and not drive(n, who, table, tolerance, speeds):
        return sweeps
    return SWEEPS + _settle_least(n, who, table, ground, inert, tolerance, speeds)
