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
from seisblock.dynamics.array_types import INTEGER_TABLE, MATRIX, VECTOR
from seisblock.models.stack.constraint_row import (
    BILATERAL,
    CONE_CENTRE,
    IMPULSE,
    MIN_NORMAL_VELOCITY,
    MU,
    NORMAL,
    ROTATION_BIAS,
    SEARCH_DIRECTION,
    START_IMPULSE,
    START_VELOCITY,
    WI,
    W,
    apply_impulse,
    apply_impulses,
    relative_velocity,
)

_t = types()

MAX_SWEEPS = 1000
TOLERANCE = 5e-4
"""Most sweeps of a step; and the change of a velocity in a sweep, over that of a free fall in a step, at which they end."""

UNCONVERGED_RATIO, DIVERGENCE_RATIO = 10.0, 1e6
"""Change of a velocity in the last sweep, over that at which they end, from which they have not come to rest; and in any sweep, over that
in the first one, from which they never will."""

DIRECTION_ITERATIONS = 3
"""How often the direction of sliding is corrected at a point before the next one's turn."""

MIN_NORMAL_RATIO = 0.05
"""Part of the normal term that is left at least where friction helps the normal impulse along (Painleve)."""


@kernel(_t.UniTuple(_t.float64, 3)(VECTOR, _t.float64, _t.float64, _t.float64), inline=True)
def _solve_sliding(row, c0, c1, c2):
    """Return the impulse at a point that slides, whose velocity without it is c."""
    n0, n1, n2 = row[NORMAL], row[NORMAL + 1], row[NORMAL + 2]
    q0, q1, q2, mu = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2], row[MU]
    s0, s1, s2 = row[CONE_CENTRE], row[CONE_CENTRE + 1], row[CONE_CENTRE + 2]
    wn0 = row[W] * n0 + row[W + 1] * n1 + row[W + 2] * n2
    wn1 = row[W + 3] * n0 + row[W + 4] * n1 + row[W + 5] * n2
    wn2 = row[W + 6] * n0 + row[W + 7] * n1 + row[W + 8] * n2
    normal = n0 * wn0 + n1 * wn1 + n2 * wn2
    target = row[MIN_NORMAL_VELOCITY] - (c0 * n0 + c1 * n1 + c2 * n2)
    # the largest answer to a tangential impulse is no more than the trace
    gain = 1.0 / (row[W] + row[W + 4] + row[W + 8] - normal)
    cone_response = normal + s0 * wn0 + s1 * wn1 + s2 * wn2
    p = q0 * n0 + q1 * n1 + q2 * n2
    d0, d1, d2 = 0.0, 0.0, 0.0
    for _ in range(DIRECTION_ITERATIONS):
        u0 = c0 + row[W] * q0 + row[W + 1] * q1 + row[W + 2] * q2
        u1 = c1 + row[W + 3] * q0 + row[W + 4] * q1 + row[W + 5] * q2
        u2 = c2 + row[W + 6] * q0 + row[W + 7] * q1 + row[W + 8] * q2
        u0, u1, u2 = q0 - p * s0 - gain * u0, q1 - p * s1 - gain * u1, q2 - p * s2 - gain * u2
        normal_part = u0 * n0 + u1 * n1 + u2 * n2
        u0 -= normal_part * n0
        u1 -= normal_part * n1
        u2 -= normal_part * n2
        size = math.sqrt(u0 * u0 + u1 * u1 + u2 * u2)
        if size > 0.0:
            d0, d1, d2 = u0 / size, u1 / size, u2 / size
        response = cone_response + mu * (d0 * wn0 + d1 * wn1 + d2 * wn2)
        p = target / max(response, MIN_NORMAL_RATIO * normal)
        friction = min(mu * p, size) if p > 0.0 else 0.0
        q0, q1, q2 = p * (n0 + s0) + friction * d0, p * (n1 + s1) + friction * d1, p * (n2 + s2) + friction * d2
    return q0, q1, q2


@kernel(_t.UniTuple(_t.float64, 3)(VECTOR, _t.float64, _t.float64, _t.float64), inline=True)
def _projected_gradient_step(row, c0, c1, c2):
    """Return the impulse at a point after a step down its energy, back into the cone; c is its velocity without any."""
    n0, n1, n2, floor, mu = row[NORMAL], row[NORMAL + 1], row[NORMAL + 2], row[MIN_NORMAL_VELOCITY], row[MU]
    q0, q1, q2 = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2]
    gain = 1.0 / (row[W] + row[W + 4] + row[W + 8])
    u0 = c0 - floor * n0 + row[W] * q0 + row[W + 1] * q1 + row[W + 2] * q2
    u1 = c1 - floor * n1 + row[W + 3] * q0 + row[W + 4] * q1 + row[W + 5] * q2
    u2 = c2 - floor * n2 + row[W + 6] * q0 + row[W + 7] * q1 + row[W + 8] * q2
    q0, q1, q2 = q0 - gain * u0, q1 - gain * u1, q2 - gain * u2
    normal_impulse = q0 * n0 + q1 * n1 + q2 * n2
    t0, t1, t2 = q0 - normal_impulse * n0, q1 - normal_impulse * n1, q2 - normal_impulse * n2
    size = math.sqrt(t0 * t0 + t1 * t1 + t2 * t2)
    if size <= mu * normal_impulse:
        return q0, q1, q2
    normal_impulse = (normal_impulse + mu * size) / (1.0 + mu * mu)
    if normal_impulse <= 0.0:
        return 0.0, 0.0, 0.0
    scale = mu * normal_impulse / size
    return normal_impulse * n0 + scale * t0, normal_impulse * n1 + scale * t1, normal_impulse * n2 + scale * t2


@kernel(_t.UniTuple(_t.float64, 3)(VECTOR, _t.float64, _t.float64, _t.float64), inline=True)
def _solve_bilateral(row, c0, c1, c2):
    """Return the impulse along the normal that gives a point its floor's velocity, be it a pull."""
    n0, n1, n2 = row[NORMAL], row[NORMAL + 1], row[NORMAL + 2]
    response = n0 * (row[W] * n0 + 2.0 * (row[W + 1] * n1 + row[W + 2] * n2)) + n1 * (row[W + 4] * n1 + 2.0 * row[W + 5] * n2)
    p = (row[MIN_NORMAL_VELOCITY] - (c0 * n0 + c1 * n1 + c2 * n2)) / (response + row[W + 8] * n2 * n2)
    return p * n0, p * n1, p * n2


@kernel(_t.float64(_t.int64, _t.int64, _t.int64, MATRIX, VECTOR, _t.boolean, MATRIX))
def _relax_contact(a, b, ground, inertias, row, minimise_energy, velocities):
    """Solve one point against what the others do, or let it make their energy the `minimise_energy`.

    Return how much its velocity changes by it.
    """
    u0, u1, u2 = relative_velocity(a, b, row, velocities)
    p0, p1, p2 = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2]
    c0 = u0 + row[ROTATION_BIAS] - (row[W] * p0 + row[W + 1] * p1 + row[W + 2] * p2)
    c1 = u1 + row[ROTATION_BIAS + 1] - (row[W + 3] * p0 + row[W + 4] * p1 + row[W + 5] * p2)
    c2 = u2 + row[ROTATION_BIAS + 2] - (row[W + 6] * p0 + row[W + 7] * p1 + row[W + 8] * p2)
    n0, n1, n2, floor = row[NORMAL], row[NORMAL + 1], row[NORMAL + 2], row[MIN_NORMAL_VELOCITY]
    q0, q1, q2 = 0.0, 0.0, 0.0
    if row[BILATERAL] > 0.0:
        q0, q1, q2 = _solve_bilateral(row, c0, c1, c2)
    elif (minimise_energy and floor > -math.inf) or c0 * n0 + c1 * n1 + c2 * n2 < floor:
        e0, e1, e2 = floor * n0 - c0, floor * n1 - c1, floor * n2 - c2
        q0 = row[WI] * e0 + row[WI + 1] * e1 + row[WI + 2] * e2
        q1 = row[WI + 3] * e0 + row[WI + 4] * e1 + row[WI + 5] * e2
        q2 = row[WI + 6] * e0 + row[WI + 7] * e1 + row[WI + 8] * e2
        normal_impulse = q0 * n0 + q1 * n1 + q2 * n2
        t0, t1, t2 = (
            q0 - normal_impulse * (n0 + row[CONE_CENTRE]),
            q1 - normal_impulse * (n1 + row[CONE_CENTRE + 1]),
            q2 - normal_impulse * (n2 + row[CONE_CENTRE + 2]),
        )
        if normal_impulse <= 0.0 or t0 * t0 + t1 * t1 + t2 * t2 > (row[MU] * normal_impulse) ** 2:
            q0, q1, q2 = _projected_gradient_step(row, c0, c1, c2) if minimise_energy else _solve_sliding(row, c0, c1, c2)
    row[IMPULSE] = q0
    row[IMPULSE + 1] = q1
    row[IMPULSE + 2] = q2
    q0 -= p0
    q1 -= p1
    q2 -= p2
    if q0 != 0.0 or q1 != 0.0 or q2 != 0.0:
        apply_impulse(a, b, ground, inertias, row, q0, q1, q2, velocities)
    return (abs(q0) + abs(q1) + abs(q2)) * max(row[W], max(row[W + 4], row[W + 8]))


@kernel(_t.void(VECTOR, _t.int64, _t.int64, _t.int64), inline=True)
def _copy(row, source, target, count):
    """Copy numbers of a row from one place to another."""
    for k in range(count):
        row[target + k] = row[source + k]


@kernel(_t.void(_t.int64, _t.int64, MATRIX, MATRIX, _t.boolean), inline=True)
def _save_state(n, bodies, rows, velocities, restore):
    """Keep velocities and impulses as they are before the sweeps, or give them `restore`."""
    for i in range(bodies):
        _copy(velocities[i], START_VELOCITY if restore else 0, 0 if restore else START_VELOCITY, 6)
    for i in range(n):
        _copy(rows[i], START_IMPULSE if restore else IMPULSE, IMPULSE if restore else START_IMPULSE, 3)


@kernel(_t.int64(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, _t.float64, MATRIX))
def solve_pgs(n, contact_ids, rows, ground, inertias, tolerance, velocities):
    """Find the impulses of `n` contacts; return how many sweeps it took, or none, and leave all as it was, where they do not come to rest.

    Parameters
    ----------
    contact_ids : (k, 2) array of int
        The bodies of each contact.
    rows : (k, 92) array
        Contacts, with the impulses to start from.
    tolerance : float, m/s
    velocities : (m + 1, 15) array
        Velocities and spins with the impulses to start from; on return, with those that were found.
    """
    last_size, max_change, divergence_limit = 0.0, 0.0, math.inf
    _save_state(n, ground, rows, velocities, False)
    for sweep in range(MAX_SWEEPS):
        max_change = 0.0
        for i in range(n):
            row = rows[i]
            for k in range(3):
                row[SEARCH_DIRECTION + k] = row[IMPULSE + k]
            max_change = max(max_change, _relax_contact(contact_ids[i, 0], contact_ids[i, 1], ground, inertias, row, False, velocities))
        if max_change < tolerance:
            return sweep + 1
        if sweep == 0:
            divergence_limit = DIVERGENCE_RATIO * max_change
        elif max_change > divergence_limit:
            break
        size = 0.0
        for i in range(n):
            row = rows[i]
            for k in range(3):
                row[SEARCH_DIRECTION + k] = row[IMPULSE + k] - row[SEARCH_DIRECTION + k]
                size += row[SEARCH_DIRECTION + k] ** 2
        beta = size / last_size if last_size > 0.0 else 2.0
        last_size = size
        for i in range(n):
            row = rows[i]
            if beta > 1.0:
                for k in range(3):
                    row[SEARCH_DIRECTION + 3 + k] = row[SEARCH_DIRECTION + k]
                continue
            p0, p1, p2 = beta * row[SEARCH_DIRECTION + 3], beta * row[SEARCH_DIRECTION + 4], beta * row[SEARCH_DIRECTION + 5]
            row[SEARCH_DIRECTION + 3] = p0 + row[SEARCH_DIRECTION]
            row[SEARCH_DIRECTION + 4] = p1 + row[SEARCH_DIRECTION + 1]
            row[SEARCH_DIRECTION + 5] = p2 + row[SEARCH_DIRECTION + 2]
            row[IMPULSE] += p0
            row[IMPULSE + 1] += p1
            row[IMPULSE + 2] += p2
            apply_impulse(contact_ids[i, 0], contact_ids[i, 1], ground, inertias, row, p0, p1, p2, velocities)
    if max_change < UNCONVERGED_RATIO * tolerance:
        return MAX_SWEEPS
    _save_state(n, ground, rows, velocities, True)
    return 0


@kernel(_t.int64(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, _t.float64, MATRIX))
def _solve_projected_gradient(n, contact_ids, rows, ground, inertias, tolerance, velocities):
    """Find the impulses of the least energy in cones about the normals; return how many sweeps it took."""
    apply_impulses(n, contact_ids, rows, ground, inertias, -1.0, velocities)
    for i in range(n):
        for k in range(3):
            rows[i, IMPULSE + k] = 0.0
    for sweep in range(MAX_SWEEPS):
        max_change = 0.0
        for i in range(n):
            max_change = max(max_change, _relax_contact(contact_ids[i, 0], contact_ids[i, 1], ground, inertias, rows[i], True, velocities))
        if max_change < tolerance:
            return sweep + 1
    return MAX_SWEEPS


@kernel(_t.float64(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, _t.float64, MATRIX))
def impulse_work(n, contact_ids, rows, ground, inertias, tolerance, velocities):
    """Return the work of the impulses of `n` contacts, J, at least: against the mean of the velocities without and with them.

    Velocities are known to a tolerance, m/s: an impact that keeps its energy does not give any.
    """
    apply_impulses(n, contact_ids, rows, ground, inertias, -0.5, velocities)
    work = 0.0
    for i in range(n):
        row = rows[i]
        u0, u1, u2 = relative_velocity(contact_ids[i, 0], contact_ids[i, 1], row, velocities)
        p0, p1, p2 = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2]
        work += p0 * u0 + p1 * u1 + p2 * u2 - tolerance * math.sqrt(p0 * p0 + p1 * p1 + p2 * p2)
    apply_impulses(n, contact_ids, rows, ground, inertias, 0.5, velocities)
    return work


@kernel(_t.boolean(_t.int64, INTEGER_TABLE, MATRIX, _t.float64, MATRIX))
def creates_energy(n, contact_ids, rows, tolerance, velocities):
    """Whether the impulses of `n` contacts drive the bodies: sweeps then came to rest on no solution.

    No point leaves along what presses it in Signorini's and Coulomb's laws, beyond what floors and turning bodies ask for. Energy is lost
    then: the work of impulses P, against the mean of the velocities without and with them, is P u - P W P / 2.
    """
    power = 0.0
    for i in range(n):
        row = rows[i]
        p0, p1, p2 = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2]
        if row[BILATERAL] > 0.0:
            return False
        if p0 == 0.0 and p1 == 0.0 and p2 == 0.0:
            continue
        u0, u1, u2 = relative_velocity(contact_ids[i, 0], contact_ids[i, 1], row, velocities)
        allowed_speed = max(row[MIN_NORMAL_VELOCITY], 0.0) + math.sqrt(
            row[ROTATION_BIAS] ** 2 + row[ROTATION_BIAS + 1] ** 2 + row[ROTATION_BIAS + 2] ** 2
        )
        power += p0 * u0 + p1 * u1 + p2 * u2 - (allowed_speed + UNCONVERGED_RATIO * tolerance) * math.sqrt(p0 * p0 + p1 * p1 + p2 * p2)
    return power > 0.0


@kernel(_t.int64(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, _t.float64, MATRIX))
def solve_contacts(n, contact_ids, rows, ground, inertias, tolerance, velocities):
    """Find the impulses of `n` contacts as :func:`solve_pgs` does, or, where its sweeps find no solution, those of the least energy."""
    sweeps = solve_pgs(n, contact_ids, rows, ground, inertias, tolerance, velocities)
    if sweeps > 0 and not creates_energy(n, contact_ids, rows, tolerance, velocities):
        return sweeps
    return MAX_SWEEPS + _solve_projected_gradient(n, contact_ids, rows, ground, inertias, tolerance, velocities)
