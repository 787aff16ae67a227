"""Rigid contacts: the impulses of one step at all points at once, by non-smooth Gauss-Seidel ([Jean1999]_, [Moreau1988]_).

At a contact the impulse P obeys Signorini's condition on velocities, 0 <= P_n, u_n >= b, P_n (u_n - b) = 0, and Coulomb's cone,
|P_t| <= mu P_n, with P_t against u_t where it slides ([Jean1999]_ section 3). b is what the gap leaves: -gap / dt while it is open, so
that it closes and no more; a slow push where it is closed too far. Each point in turn is solved exactly against what the others do; the
sweeps start from the forces of the steps before, and a conjugate gradient carries what they change on from one to the next
([Silcowitz2010]_).

Restitution. An impact is plastic at the points that strike; those that leave are free. One block on its edges then turns about the far
edge with what angular momentum about it leaves, Housner's ratio. Where a joint is given a ratio of its own, its points that leave do so
with that part of the velocity with which the points opposite them strike: Newton's law across the joint.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import INTEGER_TABLE, MATRIX, VECTOR

_t = types()

ARM_A, ARM_B, NORMAL, W, WI, SPIN_A, SPIN_B, IMPULSE, FLOOR, MU, SWERVE, HEADING, HELD = 0, 3, 6, 9, 18, 27, 36, 45, 48, 49, 50, 53, 59
GAP, RATE, BOUNCE, GIVEN, ROLL = 60, 61, 62, 63, 66
SHIFT, STATIC, KINETIC, SLID, OLD, PACED, TURN, HEED, STANDS = 69, 72, 73, 74, 75, 78, 79, 80, 81
ROW = 82
"""A contact's row: its arms from the centres of both bodies, its normal, out of the second; the velocity that a unit impulse gives (9)
and the inverse (9); the spins that it gives (9, 9); the impulse on the first body; the least normal velocity; friction; how its velocity
changes by turning in half a step (3); the impulse before a sweep, and the way that the sweeps take it (3, 3); whether the floor holds from
both sides, along the normal alone; the gap, m, and how fast it opens at the step, m/s; the restitution, negative where an impact is
plastic; the impulse that was given before the last one was looked for (3); the acceleration of a point that wanders round a rim (3); and of
friction, the middle of its cone over what presses (3), its two coefficients, whether the point slid, in what direction (3) and how fast,
m/s, and what it does in the step; the speed, m/s, of which parts are heeded where it strikes; and
whether it is one of a stone that stands."""

SPEED, TURNING, VEERING = 0, 3, 6
SPEEDS = 9
"""A body's velocity, its spin, and how that changes as the body turns on with the same angular momentum, rad/s^2."""

SWEEPS = 200
PRECISION = 1e-3
"""Most sweeps of a step; and the change of a velocity in a sweep, over that of a free fall in a step, at which they end."""

AIMS = 3
"""How often the direction of sliding is corrected at a point before the next one's turn."""

LEAST_SHARE = 0.05
"""Part of the normal term that is left at least where friction helps the normal impulse along (Painleve)."""


@kernel(_t.void(_t.int64, VECTOR, MATRIX, MATRIX, _t.int64, _t.float64, VECTOR), inline=True)
def _answer(body, arm, inert, inverses, spins, sign, row):
    """Add to a row what a unit impulse at `arm` does to a body: velocity there, and spin."""
    x, y, z = arm[0], arm[1], arm[2]
    j = inverses[body]
    m = 1.0 / inert[body, 0]
    for i in range(3):
        a, b, c = j[3 * i], j[3 * i + 1], j[3 * i + 2]
        row[spins + 3 * i] = b * z - c * y
        row[spins + 3 * i + 1] = c * x - a * z
        row[spins + 3 * i + 2] = a * y - b * x
    for k in range(3):
        s0, s1, s2 = row[spins + k], row[spins + 3 + k], row[spins + 6 + k]
        row[W + k] += s1 * z - s2 * y
        row[W + 3 + k] += s2 * x - s0 * z
        row[W + 6 + k] += s0 * y - s1 * x
        row[W + 4 * k] += m


@kernel(_t.void(_t.int64, _t.int64, _t.int64, MATRIX, MATRIX, VECTOR))
def answers(a, b, ground, inert, inverses, row):
    """Write into a row what impulses at its point do to both bodies; the ground does not move."""
    for i in range(W, IMPULSE):
        row[i] = 0.0
    if a != ground:
        _answer(a, row[ARM_A:], inert, inverses, SPIN_A, 1.0, row)
    if b != ground:
        _answer(b, row[ARM_B:], inert, inverses, SPIN_B, 1.0, row)
    w00, w01, w02 = row[W], row[W + 1], row[W + 2]
    w11, w12, w22 = row[W + 4], row[W + 5], row[W + 8]
    c00, c01, c02 = w11 * w22 - w12 * w12, w02 * w12 - w01 * w22, w01 * w12 - w02 * w11
    d = 1.0 / (w00 * c00 + w01 * c01 + w02 * c02)
    row[WI] = c00 * d
    row[WI + 1] = c01 * d
    row[WI + 2] = c02 * d
    row[WI + 3] = c01 * d
    row[WI + 4] = (w00 * w22 - w02 * w02) * d
    row[WI + 5] = (w01 * w02 - w00 * w12) * d
    row[WI + 6] = c02 * d
    row[WI + 7] = row[WI + 5]
    row[WI + 8] = (w00 * w11 - w01 * w01) * d


@kernel(_t.void(_t.int64, _t.int64, _t.int64, MATRIX, VECTOR, _t.float64, _t.float64, _t.float64, MATRIX), inline=True)
def _push(a, b, ground, inert, row, p0, p1, p2, speeds):
    """Let an impulse act on the first body, and its opposite on the second."""
    if a != ground:
        v = speeds[a]
        m = 1.0 / inert[a, 0]
        v[0] += m * p0
        v[1] += m * p1
        v[2] += m * p2
        j = SPIN_A
        v[3] += row[j] * p0 + row[j + 1] * p1 + row[j + 2] * p2
        v[4] += row[j + 3] * p0 + row[j + 4] * p1 + row[j + 5] * p2
        v[5] += row[j + 6] * p0 + row[j + 7] * p1 + row[j + 8] * p2
    if b != ground:
        v = speeds[b]
        m = 1.0 / inert[b, 0]
        v[0] -= m * p0
        v[1] -= m * p1
        v[2] -= m * p2
        j = SPIN_B
        v[3] -= row[j] * p0 + row[j + 1] * p1 + row[j + 2] * p2
        v[4] -= row[j + 3] * p0 + row[j + 4] * p1 + row[j + 5] * p2
        v[5] -= row[j + 6] * p0 + row[j + 7] * p1 + row[j + 8] * p2


@kernel(_t.UniTuple(_t.float64, 3)(_t.int64, _t.int64, VECTOR, MATRIX), inline=True)
def parting(a, b, row, speeds):
    """Return the velocity of the first body's point against the second's."""
    u, v = speeds[a], speeds[b]
    x, y, z = row[ARM_A], row[ARM_A + 1], row[ARM_A + 2]
    r, s, t = row[ARM_B], row[ARM_B + 1], row[ARM_B + 2]
    return (
        u[0] + (u[4] * z - u[5] * y) - v[0] - (v[4] * t - v[5] * s),
        u[1] + (u[5] * x - u[3] * z) - v[1] - (v[5] * r - v[3] * t),
        u[2] + (u[3] * y - u[4] * x) - v[2] - (v[3] * s - v[4] * r),
    )


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
def _hold(row, c0, c1, c2):
    """Return the impulse along the normal that gives a point its floor's velocity, be it a pull."""
    n0, n1, n2 = row[NORMAL], row[NORMAL + 1], row[NORMAL + 2]
    answer = n0 * (row[W] * n0 + 2.0 * (row[W + 1] * n1 + row[W + 2] * n2)) + n1 * (row[W + 4] * n1 + 2.0 * row[W + 5] * n2)
    p = (row[FLOOR] - (c0 * n0 + c1 * n1 + c2 * n2)) / (answer + row[W + 8] * n2 * n2)
    return p * n0, p * n1, p * n2


@kernel(_t.float64(_t.int64, _t.int64, _t.int64, MATRIX, VECTOR, MATRIX))
def _relax(a, b, ground, inert, row, speeds):
    """Solve one point against what the others do; return how much its velocity changes by it."""
    u0, u1, u2 = parting(a, b, row, speeds)
    p0, p1, p2 = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2]
    c0 = u0 + row[SWERVE] - (row[W] * p0 + row[W + 1] * p1 + row[W + 2] * p2)
    c1 = u1 + row[SWERVE + 1] - (row[W + 3] * p0 + row[W + 4] * p1 + row[W + 5] * p2)
    c2 = u2 + row[SWERVE + 2] - (row[W + 6] * p0 + row[W + 7] * p1 + row[W + 8] * p2)
    n0, n1, n2, floor = row[NORMAL], row[NORMAL + 1], row[NORMAL + 2], row[FLOOR]
    q0, q1, q2 = 0.0, 0.0, 0.0
    if row[HELD] > 0.0:
        q0, q1, q2 = _hold(row, c0, c1, c2)
    elif c0 * n0 + c1 * n1 + c2 * n2 < floor:
        e0, e1, e2 = floor * n0 - c0, floor * n1 - c1, floor * n2 - c2
        q0 = row[WI] * e0 + row[WI + 1] * e1 + row[WI + 2] * e2
        q1 = row[WI + 3] * e0 + row[WI + 4] * e1 + row[WI + 5] * e2
        q2 = row[WI + 6] * e0 + row[WI + 7] * e1 + row[WI + 8] * e2
        press = q0 * n0 + q1 * n1 + q2 * n2
        t0, t1, t2 = q0 - press * (n0 + row[SHIFT]), q1 - press * (n1 + row[SHIFT + 1]), q2 - press * (n2 + row[SHIFT + 2])
        if press <= 0.0 or t0 * t0 + t1 * t1 + t2 * t2 > (row[MU] * press) ** 2:
            q0, q1, q2 = _slide(row, c0, c1, c2)
    row[IMPULSE] = q0
    row[IMPULSE + 1] = q1
    row[IMPULSE + 2] = q2
    q0 -= p0
    q1 -= p1
    q2 -= p2
    if q0 != 0.0 or q1 != 0.0 or q2 != 0.0:
        _push(a, b, ground, inert, row, q0, q1, q2, speeds)
    return (abs(q0) + abs(q1) + abs(q2)) * max(row[W], max(row[W + 4], row[W + 8]))


@kernel(_t.void(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, _t.float64, MATRIX))
def press(n, who, table, ground, inert, part, speeds):
    """Let a part of the impulses of `n` contacts act on the bodies."""
    for i in range(n):
        row = table[i]
        p0, p1, p2 = part * row[IMPULSE], part * row[IMPULSE + 1], part * row[IMPULSE + 2]
        if p0 != 0.0 or p1 != 0.0 or p2 != 0.0:
            _push(who[i, 0], who[i, 1], ground, inert, row, p0, p1, p2, speeds)


@kernel(_t.int64(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, _t.float64, MATRIX))
def settle(n, who, table, ground, inert, tolerance, speeds):
    """Find the impulses of `n` contacts; return how many sweeps it took.

    Parameters
    ----------
    who : (k, 2) array of int
        The bodies of each contact.
    table : (k, 82) array
        Contacts, with the impulses to start from.
    tolerance : float, m/s
    speeds : (m + 1, 9) array
        Velocities and spins with the impulses to start from; on return, with those that were found.
    """
    before = 0.0
    for sweep in range(SWEEPS):
        worst = 0.0
        for i in range(n):
            row = table[i]
            for k in range(3):
                row[HEADING + k] = row[IMPULSE + k]
            worst = max(worst, _relax(who[i, 0], who[i, 1], ground, inert, row, speeds))
        if worst < tolerance:
            return sweep + 1
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
            _push(who[i, 0], who[i, 1], ground, inert, row, p0, p1, p2, speeds)
    return SWEEPS
