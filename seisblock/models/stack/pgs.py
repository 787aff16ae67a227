"""Solver of the impulses of one step (non-smooth contact dynamics, [Jean1999]_, [Moreau1988]_).

The impulse P of a contact obeys Signorini's condition on velocities, 0 <= P_n, u_n >= b, P_n (u_n - b) = 0, and Coulomb's cone,
|P_t| <= mu P_n, with P_t against u_t while sliding ([Jean1999]_ section 3). The bound b is -gap / dt for an open gap, so that it may just
close, and a small separation speed for an overlap. A sweep solves each contact in turn, exactly, with the others fixed. Sweeps are
warm-started from the forces of the last steps and accelerated by nonlinear conjugate gradients ([Silcowitz2010]_). An impulse passes one
joint a sweep, so that their number grows with the pile: beyond a few contacts :mod:`seisblock.models.stack.newton` solves the same laws,
and the sweeps serve where it fails.

The sweeps need not converge, and a solution need not exist: with high friction a contact may lift what it should hold (Painleve) and
contacts amplify each other. Such a step is solved again with the cone complementarity condition u_n - b >= mu |u_t|: the impulses then
minimise the energy in cones about the normals, by projected gradients from zero, which never add energy ([TasoraAnitescu2011]_). A
contact that slides in such a step separates at mu times its slip speed.

Restitution. Impacts are plastic at the striking points; leaving points are free. A block on its edges then keeps the angular momentum
about the striking edge, which is Housner's restitution. For a joint with a given restitution the previous pivot leaves with that
fraction of the striking velocity: Newton's law across the joint. If this creates energy together with friction, the impact is plastic.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import INTEGER_TABLE, MATRIX, VECTOR
from seisblock.models.stack.buffers import LAYOUT, MEMORY
from seisblock.models.stack.constraint_row import (
    BILATERAL,
    CONE_CENTRE,
    IMPULSE,
    MIN_NORMAL_VELOCITY,
    MU,
    NORMAL,
    ROTATION_BIAS,
    SEARCH_DIRECTION,
    WI,
    W,
    apply_impulse,
    apply_impulses,
    relative_velocity,
)
from seisblock.models.stack.newton import save_state, solve_newton

_t = types()

MAX_SWEEPS = 1000
TOLERANCE = 5e-4
"""Largest number of sweeps; and velocity change in a sweep, over the speed of a free fall of a step, at which they have converged."""

MIN_NEWTON_CONTACTS = 8
"""Number of contacts above which Newton's method is faster than the sweeps: two flat joints, and one stone on the ground."""

FINE_RATIO, FINE_SWEEPS = 1e-2, 100
"""Tolerance of few contacts over :data:`TOLERANCE`, and number of sweeps for which it holds."""

UNCONVERGED_RATIO, DIVERGENCE_RATIO = 10.0, 1e6
"""Velocity change in the last sweep over the tolerance above which a step counts as unconverged; and velocity change in a sweep over that
in the first one above which the sweeps diverge."""

DIRECTION_ITERATIONS = 3
"""Fixed-point iterations of the slip direction of one contact within a sweep."""

MIN_NORMAL_RATIO = 0.05
"""Lower bound of the normal response, over its frictionless value, where friction increases the normal impulse (Painleve)."""


@kernel(_t.UniTuple(_t.float64, 3)(VECTOR, _t.float64, _t.float64, _t.float64), inline=True)
def _solve_sliding(row, c0, c1, c2):
    """Return the impulse of a sliding contact; c is its velocity without an impulse."""
    n0, n1, n2 = row[NORMAL], row[NORMAL + 1], row[NORMAL + 2]
    q0, q1, q2, mu = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2], row[MU]
    s0, s1, s2 = row[CONE_CENTRE], row[CONE_CENTRE + 1], row[CONE_CENTRE + 2]
    wn0 = row[W] * n0 + row[W + 1] * n1 + row[W + 2] * n2
    wn1 = row[W + 3] * n0 + row[W + 4] * n1 + row[W + 5] * n2
    wn2 = row[W + 6] * n0 + row[W + 7] * n1 + row[W + 8] * n2
    normal = n0 * wn0 + n1 * wn1 + n2 * wn2
    target = row[MIN_NORMAL_VELOCITY] - (c0 * n0 + c1 * n1 + c2 * n2)
    # step length: the trace of the tangential block bounds its largest eigenvalue
    gain = 1.0 / (row[W] + row[W + 4] + row[W + 8] - normal)
    cone_response = normal + s0 * wn0 + s1 * wn1 + s2 * wn2
    p = q0 * n0 + q1 * n1 + q2 * n2
    d0, d1, d2 = 0.0, 0.0, 0.0
    for _ in range(DIRECTION_ITERATIONS):
        u0 = c0 + row[W] * q0 + row[W + 1] * q1 + row[W + 2] * q2
        u1 = c1 + row[W + 3] * q0 + row[W + 4] * q1 + row[W + 5] * q2
        u2 = c2 + row[W + 6] * q0 + row[W + 7] * q1 + row[W + 8] * q2
        # projected-gradient step of the friction about the centre of the cone: its direction is the new slip direction
        u0, u1, u2 = q0 - p * s0 - gain * u0, q1 - p * s1 - gain * u1, q2 - p * s2 - gain * u2
        normal_part = u0 * n0 + u1 * n1 + u2 * n2
        u0 -= normal_part * n0
        u1 -= normal_part * n1
        u2 -= normal_part * n2
        size = math.sqrt(u0 * u0 + u1 * u1 + u2 * u2)
        if size > 0.0:
            d0, d1, d2 = u0 / size, u1 / size, u2 / size
        # normal velocity per unit p of the impulse p (n + s + mu d), as W is symmetric
        response = cone_response + mu * (d0 * wn0 + d1 * wn1 + d2 * wn2)
        # with high friction the response may vanish or change sign (Painleve): the bound keeps the impulse finite
        p = target / max(response, MIN_NORMAL_RATIO * normal)
        # inside the disc of radius mu p the projected friction itself remains
        friction = min(mu * p, size) if p > 0.0 else 0.0
        q0, q1, q2 = p * (n0 + s0) + friction * d0, p * (n1 + s1) + friction * d1, p * (n2 + s2) + friction * d2
    return q0, q1, q2


@kernel(_t.UniTuple(_t.float64, 3)(VECTOR, _t.float64, _t.float64, _t.float64), inline=True)
def _projected_gradient_step(row, c0, c1, c2):
    """Return the impulse of a contact after one projected-gradient step; c is its velocity without an impulse."""
    n0, n1, n2, bound, mu = row[NORMAL], row[NORMAL + 1], row[NORMAL + 2], row[MIN_NORMAL_VELOCITY], row[MU]
    q0, q1, q2 = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2]
    # the trace bounds the largest eigenvalue of W, so the step never increases the energy
    gain = 1.0 / (row[W] + row[W + 4] + row[W + 8])
    u0 = c0 - bound * n0 + row[W] * q0 + row[W + 1] * q1 + row[W + 2] * q2
    u1 = c1 - bound * n1 + row[W + 3] * q0 + row[W + 4] * q1 + row[W + 5] * q2
    u2 = c2 - bound * n2 + row[W + 6] * q0 + row[W + 7] * q1 + row[W + 8] * q2
    q0, q1, q2 = q0 - gain * u0, q1 - gain * u1, q2 - gain * u2
    normal_impulse = q0 * n0 + q1 * n1 + q2 * n2
    t0, t1, t2 = q0 - normal_impulse * n0, q1 - normal_impulse * n1, q2 - normal_impulse * n2
    size = math.sqrt(t0 * t0 + t1 * t1 + t2 * t2)
    if size <= mu * normal_impulse:
        return q0, q1, q2
    # Euclidean projection onto Coulomb's cone
    normal_impulse = (normal_impulse + mu * size) / (1.0 + mu * mu)
    if normal_impulse <= 0.0:
        return 0.0, 0.0, 0.0
    scale = mu * normal_impulse / size
    return normal_impulse * n0 + scale * t0, normal_impulse * n1 + scale * t1, normal_impulse * n2 + scale * t2


@kernel(_t.UniTuple(_t.float64, 3)(VECTOR, _t.float64, _t.float64, _t.float64), inline=True)
def _solve_bilateral(row, c0, c1, c2):
    """Return the impulse along the normal of a bilateral row that gives the required normal velocity; it may pull."""
    n0, n1, n2 = row[NORMAL], row[NORMAL + 1], row[NORMAL + 2]
    # n W n with the symmetric W
    response = n0 * (row[W] * n0 + 2.0 * (row[W + 1] * n1 + row[W + 2] * n2)) + n1 * (row[W + 4] * n1 + 2.0 * row[W + 5] * n2)
    p = (row[MIN_NORMAL_VELOCITY] - (c0 * n0 + c1 * n1 + c2 * n2)) / (response + row[W + 8] * n2 * n2)
    return p * n0, p * n1, p * n2


@kernel(_t.float64(_t.int64, _t.int64, _t.int64, MATRIX, VECTOR, _t.boolean, MATRIX))
def _relax_contact(a, b, ground, inertias, row, minimise_energy, velocities):
    """Update the impulse of one contact with the others fixed; return its velocity change, m/s.

    With `minimise_energy` a projected-gradient step replaces the solution of Coulomb's law for sliding contacts.
    """
    u0, u1, u2 = relative_velocity(a, b, row, velocities)
    p0, p1, p2 = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2]
    # velocity without the present impulse of this contact
    c0 = u0 + row[ROTATION_BIAS] - (row[W] * p0 + row[W + 1] * p1 + row[W + 2] * p2)
    c1 = u1 + row[ROTATION_BIAS + 1] - (row[W + 3] * p0 + row[W + 4] * p1 + row[W + 5] * p2)
    c2 = u2 + row[ROTATION_BIAS + 2] - (row[W + 6] * p0 + row[W + 7] * p1 + row[W + 8] * p2)
    n0, n1, n2, bound = row[NORMAL], row[NORMAL + 1], row[NORMAL + 2], row[MIN_NORMAL_VELOCITY]
    q0, q1, q2 = 0.0, 0.0, 0.0
    if row[BILATERAL] > 0.0:
        q0, q1, q2 = _solve_bilateral(row, c0, c1, c2)
    # an open contact has no impulse; in the cone law a sliding one may press although it opens (u_n - b >= mu |u_t|)
    elif (minimise_energy and bound > -math.inf) or c0 * n0 + c1 * n1 + c2 * n2 < bound:
        # sticking: the impulse that leaves the velocity bound n, without slip
        e0, e1, e2 = bound * n0 - c0, bound * n1 - c1, bound * n2 - c2
        q0 = row[WI] * e0 + row[WI + 1] * e1 + row[WI + 2] * e2
        q1 = row[WI + 3] * e0 + row[WI + 4] * e1 + row[WI + 5] * e2
        q2 = row[WI + 6] * e0 + row[WI + 7] * e1 + row[WI + 8] * e2
        # the sticking impulse is kept if it lies inside the cone
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
    # cheap upper estimate of the velocity change
    return (abs(q0) + abs(q1) + abs(q2)) * max(row[W], max(row[W + 4], row[W + 8]))


@kernel(_t.void(_t.int64, _t.int64, LAYOUT, MEMORY))
def sweep_impact(count, n, pile, memory):
    """Estimate the impulses of an impact by a sweep up and down the contacts: Newton's method would pass it on by one joint a step."""
    if count > MIN_NEWTON_CONTACTS:
        for k in range(2 * count):
            i = k if k < count else 2 * count - 1 - k
            a, b = memory.contact_ids[i, 0], memory.contact_ids[i, 1]
            _relax_contact(a, b, n, pile.inertias, memory.constraint_rows[i], False, memory.body_velocities)


@kernel(_t.int64(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, _t.float64, _t.float64, MATRIX))
def solve_pgs(n, contact_ids, rows, ground, inertias, target, tolerance, velocities):
    """Solve the impulses of `n` contacts by projected Gauss-Seidel sweeps; return their number, or 0 and the initial state if they fail.

    Parameters
    ----------
    contact_ids : (k, 2) array of int
        The bodies of each contact.
    rows : (k, ROW_COLUMNS) array
        Constraint rows, with the initial impulses (warm start).
    target, tolerance : float, m/s
        Velocity change of a sweep at which the first :data:`FINE_SWEEPS` sweeps end, and the later ones.
    velocities : (m + 1, 15) array
        Velocities and spins with the initial impulses; on return, with the solution.
    """
    last_size, max_change, divergence_limit = 0.0, 0.0, math.inf
    save_state(n, ground, rows, velocities, False)
    for sweep in range(MAX_SWEEPS):
        max_change = 0.0
        for i in range(n):
            row = rows[i]
            # impulses before the sweep; below, their change by the sweep
            for k in range(3):
                row[SEARCH_DIRECTION + k] = row[IMPULSE + k]
            max_change = max(max_change, _relax_contact(contact_ids[i, 0], contact_ids[i, 1], ground, inertias, row, False, velocities))
        if max_change < (target if sweep < FINE_SWEEPS else tolerance):
            return sweep + 1
        if sweep == 0:
            divergence_limit = DIVERGENCE_RATIO * max_change
        # growth by orders of magnitude is divergence; waiting for MAX_SWEEPS would overflow
        elif max_change > divergence_limit:
            break
        size = 0.0
        for i in range(n):
            row = rows[i]
            for k in range(3):
                row[SEARCH_DIRECTION + k] = row[IMPULSE + k] - row[SEARCH_DIRECTION + k]
                size += row[SEARCH_DIRECTION + k] ** 2
        # Fletcher-Reeves factor of the sweeps' changes; above 1 they diverge and the direction is reset
        beta = size / last_size if last_size > 0.0 else 2.0
        last_size = size
        for i in range(n):
            row = rows[i]
            if beta > 1.0:
                for k in range(3):
                    row[SEARCH_DIRECTION + 3 + k] = row[SEARCH_DIRECTION + k]
                continue
            # step along the conjugate direction; the velocities follow, since the next sweep reads them
            p0, p1, p2 = beta * row[SEARCH_DIRECTION + 3], beta * row[SEARCH_DIRECTION + 4], beta * row[SEARCH_DIRECTION + 5]
            row[SEARCH_DIRECTION + 3] = p0 + row[SEARCH_DIRECTION]
            row[SEARCH_DIRECTION + 4] = p1 + row[SEARCH_DIRECTION + 1]
            row[SEARCH_DIRECTION + 5] = p2 + row[SEARCH_DIRECTION + 2]
            row[IMPULSE] += p0
            row[IMPULSE + 1] += p1
            row[IMPULSE + 2] += p2
            apply_impulse(contact_ids[i, 0], contact_ids[i, 1], ground, inertias, row, p0, p1, p2, velocities)
    # nearly converged: used, and counted as unconverged by the run
    if max_change < UNCONVERGED_RATIO * tolerance:
        return MAX_SWEEPS
    save_state(n, ground, rows, velocities, True)
    return 0


@kernel(_t.int64(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, _t.float64, MATRIX))
def _solve_projected_gradient(n, contact_ids, rows, ground, inertias, tolerance, velocities):
    """Minimise the energy of the impulses in cones about the normals; return the number of sweeps."""
    # start from zero: the warm start of the failed sweeps may hold energy
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
    """Return a lower bound of the work of the impulses of `n` contacts, J, against the mean of the velocities without and with them.

    Velocities are known to a tolerance, m/s: an impact that conserves energy then counts as creating none.
    """
    # the velocity is linear in the impulse: with half of it, it is the mean, whose product with the impulse is the work
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
    """Return whether the impulses of `n` contacts create energy: the sweeps then converged to a wrong solution.

    Under Signorini's and Coulomb's laws no contact leaves along its impulse faster than its velocity bound and rotation bias allow. The
    work of the impulses P against the mean velocity is then P u - P W P / 2, a loss (derived here).
    """
    power = 0.0
    for i in range(n):
        row = rows[i]
        p0, p1, p2 = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2]
        # bilateral rows do work by design; impulse_work checks them
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


@kernel(_t.int64(_t.int64, _t.int64, _t.float64, LAYOUT, MEMORY))
def solve_impulses(count, n, tolerance, pile, memory):
    """Solve the impulses of `count` contacts by Newton's method, or by sweeps; return the number of iterations, 0 without a solution."""
    contact_ids, rows, inertias, velocities = memory.contact_ids, memory.constraint_rows, pile.inertias, memory.body_velocities
    if count > MIN_NEWTON_CONTACTS:
        iterations = solve_newton(
            count, contact_ids, rows, n, inertias, memory.inverses, tolerance, velocities, memory.newton_blocks, memory.newton_bodies
        )
        if iterations > 0:
            return iterations
        save_state(count, n, rows, velocities, True)
        return solve_pgs(count, contact_ids, rows, n, inertias, tolerance, tolerance, velocities)
    # the order of the contacts decides what is left of the error: a finer tolerance keeps mirrored and turned stones alike
    return solve_pgs(count, contact_ids, rows, n, inertias, FINE_RATIO * tolerance, tolerance, velocities)


@kernel(_t.int64(_t.int64, _t.int64, _t.float64, LAYOUT, MEMORY))
def solve_contacts(count, n, tolerance, pile, memory):
    """Solve the impulses of `count` contacts by :func:`solve_impulses`, or by projected gradients where that finds no solution."""
    contact_ids, rows, inertias, velocities = memory.contact_ids, memory.constraint_rows, pile.inertias, memory.body_velocities
    sweeps = solve_impulses(count, n, tolerance, pile, memory)
    if sweeps > 0 and not creates_energy(count, contact_ids, rows, tolerance, velocities):
        return sweeps
    # a number above MAX_SWEEPS, so that the step counts as unconverged
    return MAX_SWEEPS + _solve_projected_gradient(count, contact_ids, rows, n, inertias, tolerance, velocities)
