"""A third witness: a free-standing block by the time stepping of Moreau and Jean, which knows neither modes nor events.

In every small step the velocities of the corners that have reached the ground satisfy Signorini's and Coulomb's laws with plastic
impacts; modes, impacts and slips come out by themselves. One coefficient of friction; the error is of the order of the step.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from tests.crosscheck.respond.cases import Case

ROUNDS = 200


@njit
def contact_impulses(u, v, p, q, nn, tn, tt, mu):
    """Return the impulses of one corner that end its approach and its slip, when (u, v) belong to the impulses (p, q) so far."""
    det = nn * tt - tn * tn
    free_u, free_v = u - nn * p - tn * q, v - tn * p - tt * q
    if free_u >= 0.0:
        return 0.0, 0.0
    p, q = (-free_u * tt + free_v * tn) / det, (-free_v * nn + free_u * tn) / det
    if p >= 0.0 and abs(q) <= mu * p:
        return p, q
    for sign in (1.0, -1.0):
        yields = nn - sign * mu * tn
        if yields > 0.0:
            p = -free_u / yields
            if sign * (free_v + tn * p - sign * mu * tt * p) >= 0.0:
                return p, -sign * mu * p
    return p, q


@njit
def step_through(arms, h, k2, mu, gravity, along, up, dt, step, start, settle):
    """Return time and the six numbers at the end, the largest |x| and |theta|."""
    x, y, theta, vx, vy, omega = start
    inverse = np.array([1.0, 1.0, 1.0 / k2])
    impulse = np.zeros((2, 2))
    normal, tangent = np.zeros((2, 3)), np.zeros((2, 3))
    normal[:, 1] = 1.0
    tangent[:, 0] = 1.0
    n = along.size
    steps = round(((n - 1) * dt + settle) / step)
    still = 0
    distant = lean = 0.0
    for i in range(steps):
        time = (i + 0.5) * step
        k = int(time / dt)
        ax = ay = 0.0
        if k < n - 1:
            share = time / dt - k
            ax = along[k] + share * (along[k + 1] - along[k])
            ay = up[k] + share * (up[k + 1] - up[k])
        elif still > 2000:
            break
        x, y, theta = x + step / 2 * vx, y + step / 2 * vy, theta + step / 2 * omega
        s, c = math.sin(theta), math.cos(theta)
        velocity = np.array([vx - step * ax, vy - step * (gravity + ay), omega])
        active = [False, False]
        for corner in range(2):
            xi = arms[0] if corner == 0 else -arms[1]
            rx, ry = xi * c - h * s, -xi * s - h * c
            normal[corner, 2], tangent[corner, 2] = -rx, ry
            active[corner] = y + ry <= 0.0
            if not active[corner]:
                impulse[corner] = 0.0
            velocity += inverse * (normal[corner] * impulse[corner, 0] + tangent[corner] * impulse[corner, 1])
        for _ in range(ROUNDS):
            change = 0.0
            for corner in range(2):
                if not active[corner]:
                    continue
                a, b = normal[corner], tangent[corner]
                nn, tn, tt = (a * inverse * a).sum(), (a * inverse * b).sum(), (b * inverse * b).sum()
                p, q = contact_impulses((a * velocity).sum(), (b * velocity).sum(), impulse[corner, 0], impulse[corner, 1], nn, tn, tt, mu)
                dp, dq = p - impulse[corner, 0], q - impulse[corner, 1]
                velocity += inverse * (a * dp + b * dq)
                impulse[corner, 0], impulse[corner, 1] = p, q
                change = max(change, abs(dp), abs(dq))
            if change < 1e-13:
                break
        vx, vy, omega = velocity
        x, y, theta = x + step / 2 * vx, y + step / 2 * vy, theta + step / 2 * omega
        distant, lean = max(distant, abs(x)), max(lean, abs(theta))
        moving = abs(vx) + abs(vy) + abs(omega) > 1e-6
        still = 0 if moving else still + 1
        if lean > math.pi / 2:
            break
    return np.array([time, x, y, theta, vx, vy, omega, distant, lean])


def end_state(case: Case, step: float, settle: float = 10.0) -> np.ndarray:
    """Return the end of a case, (9,): time, the six numbers, the largest displacement and the largest lean."""
    body = case.body
    start = (0.0, body.h, 0.0, 0.0, 0.0, 0.0) if case.initial is None else tuple(map(float, case.initial))
    return step_through(body.arms, body.h, body.k2, body.mu, body.gravity, case.along, case.up, case.dt, step, start, settle)
