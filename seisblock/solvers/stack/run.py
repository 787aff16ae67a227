"""A pile on springs through one ground motion: fixed steps.

The step divides the sampling interval; between samples the acceleration is linear. The loop pauses after so many steps and goes on from
there, so that Python may be interrupted; the answer does not depend on where.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import READ_ONLY_MATRIX
from seisblock.dynamics.status import NOT_FINITE, PAUSED
from seisblock.solvers.stack.arguments import BASE, CURSOR, FELL, KEPT, LAYOUT, MEMORY, SAMPLE, SETTINGS, STEP
from seisblock.solvers.stack.books import (
    IMPULSE,
    START,
    WORK,
    balance,
    end_sample,
    ground_at,
    keep_sample,
    steps_ahead,
    watch,
    work_of,
)
from seisblock.solvers.stack.frames import MASS, F
from seisblock.solvers.stack.step import LOOK_EVERY, drift, energy_of, kick, press_all

_t = types()


@kernel(_t.boolean(READ_ONLY_MATRIX, _t.int64, _t.boolean, _t.float64, SETTINGS, LAYOUT, MEMORY, CURSOR, KEPT))
def _stride(motion, k, look, total_mass, settings, pile, memory, cursor, kept):
    """Take one step; return whether all is finite."""
    place, bodies = cursor
    inert, books, g, s, last = pile.inert, kept.books, settings.gravity, place[SAMPLE], settings.last
    n = bodies.shape[0] - 1
    dt = settings.dt / settings.steps
    part = k / settings.steps
    a0, a1, a2 = ground_at(motion, s - place[BASE], part)
    springs = press_all(bodies, dt, look, pile, memory)
    books[IMPULSE] -= dt * (bodies[n, F] + total_mass * a0)
    books[IMPULSE + 1] -= dt * (bodies[n, F + 1] + total_mass * a1)
    books[IMPULSE + 2] -= dt * (bodies[n, F + 2] + total_mass * (a2 + g))
    work = work_of(n, bodies, inert, a0, a1, a2, 0.5 * dt)
    if k == 0:
        kick(n, bodies, inert, a0, a1, a2 + g, 0.5 * dt)
        held = energy_of(n, bodies, inert, g) + springs
        if s == 0:
            books[START] = held
        books[WORK] -= work
        balance(books, held - books[START])
        books[WORK] += work
        if not math.isfinite(held):
            return False
        kick(n, bodies, inert, a0, a1, a2 + g, 0.5 * dt)
    else:
        kick(n, bodies, inert, a0, a1, a2 + g, dt)
    books[WORK] -= work + work_of(n, bodies, inert, a0, a1, a2, 0.5 * dt)
    if k == 0:
        keep_sample(s, n, s == last, settings, memory, cursor, kept)
    if s < last:
        drift(n, bodies, inert, dt)
    if watch(n, bodies, (s + part) * settings.dt, kept.fates) and settings.stop_at_fall:
        place[FELL] = 1
    return True


@kernel(_t.int64(READ_ONLY_MATRIX, SETTINGS, LAYOUT, MEMORY, CURSOR, KEPT))
def run_springs(motion, settings, pile, memory, cursor, kept):
    """Follow a pile on springs through a motion ([Furukawa2009]_) on from its cursor; return a status.

    Parameters
    ----------
    motion : (3, k) array, m/s^2
        Ground acceleration along, across, up, from the sample on that the cursor names; at its end the loop pauses.
    settings, pile, memory, cursor, kept : named tuples
        See :mod:`seisblock.solvers.stack.arguments`.
    """
    place, bodies = cursor
    look = max(int(LOOK_EVERY / (settings.dt / settings.steps)), 1)
    total_mass = 0.0
    for i in range(bodies.shape[0] - 1):
        total_mass += pile.inert[i, MASS]
    while True:
        steps = steps_ahead(motion, settings, cursor)
        if steps == 0:
            return PAUSED
        for _ in range(steps):
            k = place[STEP]
            if not _stride(motion, k, k % look == 0, total_mass, settings, pile, memory, cursor, kept):
                return NOT_FINITE
            place[STEP] = k + 1
        status = end_sample(settings, cursor)
        if status != PAUSED:
            return status
