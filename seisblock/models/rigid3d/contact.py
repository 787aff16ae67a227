"""Impulses of Coulomb contacts between one rigid body and the ground: a semismooth Newton method in the six velocities.

Each contact obeys Signorini's condition on the velocity, 0 <= c _|_ p_n >= 0, where c is the normal velocity u_n plus a shift (gap over
step, or restitution times the approach velocity), and Coulomb's law: p_t lies in the disc of radius mu p_n, opposite to u_t where it
slips. As projections ([AlartCurnier1991]_) p_n is that of p_n - rho c on the positive numbers, and p_t that of p_t - rho u_t on the
disc. The Newton equations eliminate the impulses, so that one 6 x 6 system remains for any number of contacts. Contacts that share a load
share it evenly: the iteration starts without impulses, and its increments are proportional to velocities of the contacts, which have no
self-equilibrated part.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR

_t = types()

MAX_NEWTON, FIRST_SWEEPS, MAX_UPDATES = 15, 8, 8192
"""Largest number of Newton iterations, and Gauss-Seidel sweeps after them: doubled until the next Newton iterations converge, up to a
number of contacts times sweeps."""

REDUCTIONS = 4
"""Steps in which friction is reduced to none where the iterations do not converge."""

STAGNATION = 20.0
"""Factor of the tolerance at the last Newton iteration."""

PENALTY = 1e5
"""Penalty rho over the mass that resists a contact; it decides the speed of convergence, not the solution."""


@kernel(_t.boolean(MATRIX, VECTOR))
def solve_6x6(a, x):
    """Solve a 6 x 6 system in place, by elimination with partial pivoting of the (6, 7) matrix `a`; return whether it is regular."""
    for k in range(6):
        pivot, largest = k, abs(a[k, k])
        for i in range(k + 1, 6):
            if abs(a[i, k]) > largest:
                pivot, largest = i, abs(a[i, k])
        # singular, or not finite: the comparison is false for NaN as well
        if not largest > 0.0:
            return False
        if pivot != k:
            for j in range(k, 7):
                a[k, j], a[pivot, j] = a[pivot, j], a[k, j]
        inverse = 1.0 / a[k, k]
        for i in range(k + 1, 6):
            factor = a[i, k] * inverse
            if factor != 0.0:
                for j in range(k + 1, 7):
                    a[i, j] -= factor * a[k, j]
    for k in range(5, -1, -1):
        total = a[k, 6]
        for j in range(k + 1, 6):
            total -= a[k, j] * x[j]
        x[k] = total / a[k, k]
    return True


@kernel(_t.boolean(_t.int64, _t.float64, VECTOR, VECTOR, MATRIX, MATRIX, _t.float64, _t.float64, VECTOR, MATRIX, VECTOR))
def _newton(count, mass, inertia, momentum, contacts, impulses, mu, tolerance, velocity, system, change):
    """Iterate from the given velocity and impulses; return whether the residual velocities fell below the tolerance."""
    # `turning` converts an angular momentum left over into a velocity, so that one tolerance serves all residuals
    rho, turning = PENALTY * mass, math.sqrt(abs(inertia[0]) * mass)
    for c in range(count):
        impulses[c, 3], impulses[c, 13] = 0.0, 0.0
    for iteration in range(MAX_NEWTON):
        v0, v1, v2, w0, w1, w2 = velocity[0], velocity[1], velocity[2], velocity[3], velocity[4], velocity[5]
        # residual with the impulses of the last iteration: rho times the round-off of a velocity would hide it otherwise
        r0, r1, r2 = momentum[0] - mass * v0, momentum[1] - mass * v1, momentum[2] - mass * v2
        r3 = momentum[3] - (inertia[0] * w0 + inertia[1] * w1 + inertia[2] * w2)
        r4 = momentum[4] - (inertia[3] * w0 + inertia[4] * w1 + inertia[5] * w2)
        r5 = momentum[5] - (inertia[6] * w0 + inertia[7] * w1 + inertia[8] * w2)
        f0, f1, f2, f3, f4, f5 = r0, r1, r2, r3, r4, r5
        error, guessed = 0.0, False
        for c in range(count):
            x, y, z, shift = contacts[c, 0], contacts[c, 1], contacts[c, 2], contacts[c, 3]
            u0, u1, u2 = v0 + w1 * z - w2 * y, v1 + w2 * x - w0 * z, v2 + w0 * y - w1 * x
            old0, old1, old2 = impulses[c, 0], impulses[c, 1], impulses[c, 2]
            # the contact law decides with the parameter of the projections, the linear system has the far larger penalty
            p0, p1, p2, tangential, cosine, sine, status = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
            # the sign of this argument of the projection decides whether the contact presses
            pressure = old2 - mass * (u2 + shift)
            presses = 1.0 if pressure > 0.0 else 0.0
            p2 = presses * (old2 - rho * (u2 + shift))
            limit = mu * presses * pressure + contacts[c, 4]
            if limit > 0.0 or presses > 0.0:
                t0, t1 = old0 - mass * u0, old1 - mass * u1
                length = math.sqrt(t0 * t0 + t1 * t1)
                # a slip whose direction turned round stopped in between
                turned = impulses[c, 3] == 2.0 and t0 * impulses[c, 4] + t1 * impulses[c, 5] < 0.0
                inside = length <= limit
                pulled = impulses[c, 13] == 1.0 and length > 0.0
                # an iteration against the projection leads on, but is no solution
                guessed = guessed or (turned and not inside) or (pulled and inside and not turned)
                if turned or (inside and not pulled):
                    status, p0, p1 = 1.0, old0 - rho * u0, old1 - rho * u1
                else:
                    status, cosine, sine = 2.0, t0 / length, t1 / length
                    # across the direction of slip, friction changes as with a viscosity: the derivative of mu p_n u/|u|
                    tangential = min(mass * limit / (length - limit), rho) if length > limit else 0.0
                    along = cosine * u0 + sine * u1
                    p0 = (mu * p2 + contacts[c, 4]) * cosine - tangential * (u0 - along * cosine)
                    p1 = (mu * p2 + contacts[c, 4]) * sine - tangential * (u1 - along * sine)
            impulses[c, 3], impulses[c, 14] = status, presses
            impulses[c, 4], impulses[c, 5], impulses[c, 6] = cosine, sine, tangential
            impulses[c, 7], impulses[c, 8], impulses[c, 9] = p0, p1, p2
            error = max(error, abs(p0 - old0), abs(p1 - old1), abs(p2 - old2))
            f0, f1, f2 = f0 + old0, f1 + old1, f2 + old2
            f3, f4, f5 = f3 + (y * old2 - z * old1), f4 + (z * old0 - x * old2), f5 + (x * old1 - y * old0)
        error = max(error / rho, abs(f0) / mass, abs(f1) / mass, abs(f2) / mass)
        # contacts of one face can ask for velocities that differ by round-off: their impulses drift, the velocities stay
        accepted = tolerance if iteration < MAX_NEWTON - 1 else STAGNATION * tolerance
        # without contacts the system is linear: one solution leaves round-off, a residual below the tolerance would add up in flight
        settled = not guessed and (count > 0 or iteration > 0)
        if settled and max(error, abs(f3) / turning, abs(f4) / turning, abs(f5) / turning) <= accepted:
            return True
        # linear system of the Newton step
        for i in range(6):
            for j in range(6):
                system[i, j] = 0.0
        for i in range(3):
            system[i, i] = mass
            for j in range(3):
                system[3 + i, 3 + j] = inertia[3 * i + j]
        for c in range(count):
            x, y, z = contacts[c, 0], contacts[c, 1], contacts[c, 2]
            p0, p1, p2 = impulses[c, 7], impulses[c, 8], impulses[c, 9]
            r0, r1, r2 = r0 + p0, r1 + p1, r2 + p2
            r3, r4, r5 = r3 + (y * p2 - z * p1), r4 + (z * p0 - x * p2), r5 + (x * p1 - y * p0)
            status = impulses[c, 3]
            normal = rho * impulses[c, 14]
            if status == 0.0 and normal == 0.0:
                continue
            # D = -dp/du of this contact, 3 x 3; its contribution to the system is J' D J with J = [1, -[x]]
            d00, d01, d11, d02, d12 = rho, 0.0, rho, 0.0, 0.0
            if status == 2.0:
                cosine, sine, tangential = impulses[c, 4], impulses[c, 5], impulses[c, 6]
                d00, d11 = tangential * (1.0 - cosine * cosine), tangential * (1.0 - sine * sine)
                d01 = -tangential * cosine * sine
                d02, d12 = normal * mu * cosine, normal * mu * sine
            for j in range(6):
                # column j of D J
                q0, q1, q2 = d00, d01, 0.0
                if j == 1:
                    q0, q1 = d01, d11
                elif j == 2:
                    q0, q1, q2 = d02, d12, normal
                elif j == 3:
                    q0, q1, q2 = d02 * y - d01 * z, d12 * y - d11 * z, normal * y
                elif j == 4:
                    q0, q1, q2 = d00 * z - d02 * x, d01 * z - d12 * x, -normal * x
                elif j == 5:
                    q0, q1 = d01 * x - d00 * y, d11 * x - d01 * y
                system[0, j] += q0
                system[1, j] += q1
                system[2, j] += q2
                system[3, j] += y * q2 - z * q1
                system[4, j] += z * q0 - x * q2
                system[5, j] += x * q1 - y * q0
        system[0, 6], system[1, 6], system[2, 6], system[3, 6], system[4, 6], system[5, 6] = r0, r1, r2, r3, r4, r5
        # singular, or overflowed: the sweeps take over
        if not solve_6x6(system, change):
            return False
        for i in range(6):
            velocity[i] += change[i]
        for c in range(count):
            status = impulses[c, 3]
            presses = impulses[c, 14]
            if status == 0.0 and presses == 0.0:
                impulses[c, 0], impulses[c, 1], impulses[c, 2] = 0.0, 0.0, 0.0
                continue
            x, y, z = contacts[c, 0], contacts[c, 1], contacts[c, 2]
            u0 = change[0] + change[4] * z - change[5] * y
            u1 = change[1] + change[5] * x - change[3] * z
            u2 = change[2] + change[3] * y - change[4] * x
            # impulses of the linear model at the end of the Newton step
            impulses[c, 2] = impulses[c, 9] - rho * presses * u2
            if status == 1.0:
                # sticking that pulls: with much friction the contact slips although its free velocity lies in the cone
                impulses[c, 13] = 1.0 if impulses[c, 2] < 0.0 else 0.0
                impulses[c, 0], impulses[c, 1] = impulses[c, 7] - rho * u0, impulses[c, 8] - rho * u1
            else:
                impulses[c, 13] = 0.0
                cosine, sine, tangential = impulses[c, 4], impulses[c, 5], impulses[c, 6]
                along = cosine * u0 + sine * u1
                impulses[c, 0] = impulses[c, 7] - tangential * (u0 - along * cosine) - rho * presses * mu * cosine * u2
                impulses[c, 1] = impulses[c, 8] - tangential * (u1 - along * sine) - rho * presses * mu * sine * u2
    return False


@kernel(_t.void(VECTOR, VECTOR, MATRIX, VECTOR))
def _invert(inertia, out, scratch, change):
    """Write the inverse of a 3 x 3 matrix as nine numbers."""
    for k in range(3):
        for i in range(6):
            for j in range(7):
                scratch[i, j] = 1.0 if i == j else 0.0
        for i in range(3):
            for j in range(3):
                scratch[i, j] = inertia[3 * i + j]
        scratch[k, 6] = 1.0
        solve_6x6(scratch, change)
        for i in range(3):
            out[3 * i + k] = change[i]


@kernel(_t.boolean(_t.int64, _t.int64, _t.float64, VECTOR, MATRIX, MATRIX, _t.float64, _t.float64, VECTOR, VECTOR))
def _sweep(sweeps, count, mass, momentum, contacts, impulses, mu, tolerance, velocity, inverse):
    """Projected Gauss-Seidel from the given impulses, forwards and backwards in turn; return whether it converged ([Jean1999]_)."""
    # start from the velocities that belong to the given impulses
    t0, t1, t2 = momentum[3], momentum[4], momentum[5]
    for i in range(3):
        velocity[i] = momentum[i]
    for c in range(count):
        x, y, z = contacts[c, 0], contacts[c, 1], contacts[c, 2]
        p0, p1, p2 = impulses[c, 0], impulses[c, 1], impulses[c, 2]
        velocity[0] += p0
        velocity[1] += p1
        velocity[2] += p2
        t0, t1, t2 = t0 + (y * p2 - z * p1), t1 + (z * p0 - x * p2), t2 + (x * p1 - y * p0)
    for i in range(3):
        velocity[i] /= mass
        velocity[3 + i] = inverse[3 * i] * t0 + inverse[3 * i + 1] * t1 + inverse[3 * i + 2] * t2
    for sweep in range(sweeps):
        largest = 0.0
        for k in range(count):
            # forwards and backwards in turn: no contact is always the last to be satisfied
            c = k if sweep % 2 == 0 else count - 1 - k
            x, y, z = contacts[c, 0], contacts[c, 1], contacts[c, 2]
            for axis in range(3):
                # normal first, then both tangents with the friction that the normal allows
                j0, j1, j2, t0, t1, t2 = 0.0, 0.0, 1.0, y, -x, 0.0
                if axis == 1:
                    j0, j2, t0, t1, t2 = 1.0, 0.0, 0.0, z, -y
                elif axis == 2:
                    j1, j2, t0, t1, t2 = 1.0, 0.0, -z, 0.0, x
                r0 = inverse[0] * t0 + inverse[1] * t1 + inverse[2] * t2
                r1 = inverse[3] * t0 + inverse[4] * t1 + inverse[5] * t2
                r2 = inverse[6] * t0 + inverse[7] * t1 + inverse[8] * t2
                weight = 1.0 / mass + t0 * r0 + t1 * r1 + t2 * r2
                u = j0 * velocity[0] + j1 * velocity[1] + j2 * velocity[2] + t0 * velocity[3] + t1 * velocity[4] + t2 * velocity[5]
                place = 2 if axis == 0 else axis - 1
                old = impulses[c, place]
                if axis == 0:
                    new = max(0.0, old - (u + contacts[c, 3]) / weight)
                else:
                    other = impulses[c, 1 if axis == 1 else 0]
                    friction = mu * impulses[c, 2] + contacts[c, 4]
                    # friction lies in a disc: one tangent is limited to what the other leaves of it
                    limit = math.sqrt(max(friction * friction - other * other, 0.0))
                    new = min(max(old - u / weight, -limit), limit)
                difference = new - old
                impulses[c, place] = new
                velocity[0] += difference * j0 / mass
                velocity[1] += difference * j1 / mass
                velocity[2] += difference * j2 / mass
                velocity[3] += difference * r0
                velocity[4] += difference * r1
                velocity[5] += difference * r2
                largest = max(largest, abs(difference) * weight)
        if largest <= tolerance:
            return True
    return False


@kernel(_t.boolean(_t.int64, _t.float64, VECTOR, VECTOR, MATRIX, MATRIX, _t.float64, _t.float64, VECTOR, MATRIX, VECTOR, VECTOR))
def _solve(count, mass, inertia, momentum, contacts, impulses, mu, tolerance, velocity, system, change, inverse):
    """Solve the contacts with one coefficient of friction: Newton's method, with sweeps where it cycles."""
    if _newton(count, mass, inertia, momentum, contacts, impulses, mu, tolerance, velocity, system, change):
        return True
    # sweeps find which contacts act and slip, where Newton's method cycles; it converges fast from there
    _invert(inertia, inverse, system, change)
    for c in range(count):
        impulses[c, 10], impulses[c, 11], impulses[c, 12] = 0.0, 0.0, 0.0
    sweeps = FIRST_SWEEPS
    while sweeps * count <= MAX_UPDATES:
        # Newton's iterations overwrite the impulses; the sweeps continue from their own
        for c in range(count):
            impulses[c, 0], impulses[c, 1], impulses[c, 2] = impulses[c, 10], impulses[c, 11], impulses[c, 12]
        if _sweep(sweeps, count, mass, momentum, contacts, impulses, mu, tolerance, velocity, inverse):
            return True
        for c in range(count):
            impulses[c, 10], impulses[c, 11], impulses[c, 12] = impulses[c, 0], impulses[c, 1], impulses[c, 2]
        if _newton(count, mass, inertia, momentum, contacts, impulses, mu, tolerance, velocity, system, change):
            return True
        sweeps *= 2
    # not converged: impulses of the last sweeps, with the velocity that belongs to them
    for c in range(count):
        impulses[c, 0], impulses[c, 1], impulses[c, 2] = impulses[c, 10], impulses[c, 11], impulses[c, 12]
    return _sweep(1, count, mass, momentum, contacts, impulses, mu, tolerance, velocity, inverse)


@kernel(_t.boolean(_t.int64, _t.float64, VECTOR, VECTOR, MATRIX, MATRIX, _t.float64, _t.float64, VECTOR, MATRIX, VECTOR, VECTOR))
def solve_contacts(count, mass, inertia, momentum, contacts, impulses, mu, tolerance, velocity, system, change, inverse):
    """Solve the contacts of one body; return whether the solution converged.

    Parameters
    ----------
    count : int
    mass : float
    inertia, momentum : (9,) and (6,) arrays
        The velocities obey mass v = momentum[:3] + sum p and inertia w = momentum[3:] + sum x cross p.
    contacts : (n, 5) array
        Lever arm x from the centre of gravity, the shift s of the normal velocity, and friction beyond mu p_n.
    impulses : (n, 15) array
        Impulses in the first three columns, on entry a first guess; the others are scratch.
    mu, tolerance : float
    velocity : (6,) array
        On entry a first guess.
    system, change, inverse : (6, 7), (6,) and (9,) arrays
        Workspace.
    """
    if _solve(count, mass, inertia, momentum, contacts, impulses, mu, tolerance, velocity, system, change, inverse):
        return True
    # with much friction there may be no solution that the iterations find: less friction dissipates, too, and without any the
    # problem is convex
    for share in range(REDUCTIONS - 1, -1, -1):
        for c in range(count):
            impulses[c, 0], impulses[c, 1], impulses[c, 2] = 0.0, 0.0, 0.0
        reduced = mu * share / REDUCTIONS
        if _solve(count, mass, inertia, momentum, contacts, impulses, reduced, tolerance, velocity, system, change, inverse):
            return True
    return False
