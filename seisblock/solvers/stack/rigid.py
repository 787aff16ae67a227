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
from seisblock.solvers.stack.frames import INVERSE, F, L, R, T, V
from seisblock.solvers.stack.impulse import ARM_A, ARM_B, IMPULSE, NORMAL, PRECISION, parting, settle
from seisblock.solvers.stack.meet import JOINTS, find
from seisblock.solvers.stack.row import AHEAD, BEFORE, FALL, KICKED, SOONEST, SWEPT, WHOLE

_t = types()

BRIEF = 0.01
"""Part of a step that is left to pass over an impact."""

FORESIGHT = 0.9
"""Of a whole step: what points that share a load do against each other then fades."""

SLIPS = 1e-4
"""Speed, m/s, beyond which a point slides, and has kinetic friction in the next step."""


@kernel(_t.void(_t.int64, MATRIX, MATRIX, MEMORY))
def _prepare(n, bodies, inert, memory):
    """Write the inverse inertia of the bodies as they lie, and their velocities."""
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


@kernel(_t.void(_t.int64, MATRIX, _t.float64, MEMORY))
def _leave(count, bodies, dt, memory):
    """Add the impulses to the bodies as forces over the step, and remember them where the next step finds them."""
    for i in range(count):
        a, b, row = memory.who[i, 0], memory.who[i, 1], memory.table[i]
        kind, j, k, m = memory.who[i, 2], memory.who[i, 3], memory.who[i, 4], memory.who[i, 5]
        slot = memory.joint_slots[j, k, m] if kind == JOINTS else memory.corner_slots[j, k, m]
        p0, p1, p2 = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2]
        for i in range(3):
            slot[EARLIER + i] = slot[PUSH + i]
            slot[PUSH + i] = row[IMPULSE + i] / dt
        if p0 == 0.0 and p1 == 0.0 and p2 == 0.0:
            continue
        u0, u1, u2 = parting(a, b, row, memory.speeds)
        along = u0 * row[NORMAL] + u1 * row[NORMAL + 1] + u2 * row[NORMAL + 2]
        slot[SLIDES] = 1.0 if u0 * u0 + u1 * u1 + u2 * u2 - along * along > SLIPS**2 else 0.0
        memory.touched[a, b] = 1.0
        memory.touched[b, a] = 1.0
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


@kernel(_t.float64(_t.float64, _t.float64, _t.float64), inline=True)
def _before_impact(soonest, before, brief):
    """Return the length of the next step: up to an impact, a brief one before it, or a brief one that passes over it.

    A velocity is changed by the forces of half the step before and half the step after: both steps at an impact must be brief.
    """
    if soonest > 3.0 * brief:
        return soonest - 2.0 * brief
    return 0.5 * soonest if before > 2.0 * brief else 2.0 * brief


@kernel(_t.float64(MATRIX, _t.float64, _t.float64, _t.float64, _t.float64, _t.float64, _t.boolean, LAYOUT, MEMORY))
def hold(bodies, a0, a1, a2, whole, left, look, pile, memory):
    """Add the forces that rigid contacts exert over a step, in axes that accelerate by (a0, a1, a2), gravity among it; return its length.

    The step ends just before an impact, and brief ones pass over it: what presses before and what presses after share no step.

    Parameters
    ----------
    whole, left : float, s
        A whole step, and what is left of it.
    look : bool
        Whether to find anew which boxes are near each other, with a margin for what they may move until the next time.
    """
    n = bodies.shape[0] - 1
    pace = memory.pace
    pace[WHOLE] = whole
    pace[FALL] = whole * (a0 * a0 + a1 * a1 + a2 * a2) ** 0.5
    step = left
    pace[AHEAD] = FORESIGHT if pace[KICKED] == whole and 0.5 * (pace[BEFORE] + left) == whole else 0.0
    _prepare(n, bodies, pile.inert, memory)
    for attempt in range(2):
        pace[SOONEST] = 2.0 * left
        count = find(bodies, step, look and attempt == 0, pile, memory)
        if attempt == 1 or pace[SOONEST] >= left or pace[SOONEST] < 0.1 * BRIEF * whole:
            break
        step = min(left, _before_impact(pace[SOONEST], pace[BEFORE], BRIEF * whole))
    kicked = 0.5 * (pace[BEFORE] + step)
    pace[KICKED] = kicked
    for i in range(count):
        for j in range(IMPULSE, IMPULSE + 3):
            memory.table[i, j] *= kicked
    for i in range(n):
        memory.speeds[i, 0] -= kicked * a0
        memory.speeds[i, 1] -= kicked * a1
        memory.speeds[i, 2] -= kicked * a2
    pace[SWEPT] = settle(count, memory.who, memory.table, n, pile.inert, PRECISION * pace[FALL], memory.speeds)
    _leave(count, bodies, kicked, memory)
    return step
