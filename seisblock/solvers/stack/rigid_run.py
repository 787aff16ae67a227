"""A pile of rigid stones through one ground motion: fixed steps, each in as many parts as impacts make of it."""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import READ_ONLY_MATRIX
from seisblock.dynamics.status import NOT_FINITE, PAUSED
from seisblock.solvers.stack.arguments import BASE, CURSOR, FELL, KEPT, LAYOUT, MEMORY, SAMPLE, SETTINGS, STEP
from seisblock.solvers.stack.books import (
    IMPULSE,
    SOLVED,
    START,
    UNSETTLED,
    WORK,
    balance,
    end_sample,
    ground_at,
    keep_sample,
    rise_of,
    steps_ahead,
    watch,
    work_of,
)
from seisblock.solvers.stack.frames import MASS, F
from seisblock.solvers.stack.rigid import hold
from seisblock.solvers.stack.row import BEFORE, ROWS, SWEPT
from seisblock.solvers.stack.step import LOOK_EVERY, drift, energy_of, kick
from seisblock.solvers.stack.sweeps import SWEEPS

_t = types()


@kernel(_t.boolean(READ_ONLY_MATRIX, _t.int64, _t.boolean, _t.float64, SETTINGS, LAYOUT, MEMORY, CURSOR, KEPT), inline=True)
def _stride(motion, k, look, total_mass, settings, pile, memory, cursor, kept):
    """Take one step of rigid contacts, in as many parts as impacts make of it; return whether all is finite.

    Energy is that of the new velocities at the middle of the part: gravity then does there exactly what it does to the velocities.
    """
    place, bodies = cursor
    inert, books, g, s = pile.inert, kept.books, settings.gravity, place[SAMPLE]
    n = bodies.shape[0] - 1
    whole = settings.dt / settings.steps
    left = whole
    while left > 0.0:
        part = (k + (whole - left) / whole) / settings.steps
        a0, a1, a2 = ground_at(motion, s - place[BASE], part)
        step = hold(bodies, a0, a1, a2 + g, whole, left, look and left == whole, pile, memory)
        if memory.pace[ROWS] > 0.0:
            books[SOLVED] += 1.0
            books[UNSETTLED] += 1.0 if memory.pace[SWEPT] >= SWEEPS else 0.0
        kicked = 0.5 * (memory.pace[BEFORE] + step)
        memory.pace[BEFORE] = step
        books[IMPULSE] -= kicked * (bodies[n, F] + total_mass * a0)
        books[IMPULSE + 1] -= kicked * (bodies[n, F + 1] + total_mass * a1)
        books[IMPULSE + 2] -= kicked * (bodies[n, F + 2] + total_mass * (a2 + g))
        books[WORK] -= work_of(n, bodies, inert, a0, a1, a2, 0.5 * kicked)
        kick(n, bodies, inert, a0, a1, a2 + g, kicked)
        books[WORK] -= work_of(n, bodies, inert, a0, a1, a2, 0.5 * kicked)
        if k == 0 and left == whole:
            held = energy_of(n, bodies, inert, g) + rise_of(n, bodies, inert, g, 0.5 * step)
            if s == 0:
                books[START] = held
            balance(books, held - books[START])
            if not math.isfinite(held):
                return False
            keep_sample(s, n, s == settings.last, settings, memory, cursor, kept)
        if s == settings.last:
            return True
        drift(n, bodies, inert, step)
        left = left - step if step < left else 0.0
        if watch(n, bodies, (s + part) * settings.dt, kept.fates) and settings.stop_at_fall:
            place[FELL] = 1
            balance(books, energy_of(n, bodies, inert, g) - rise_of(n, bodies, inert, g, 0.5 * step) - books[START])
    return True


@kernel(_t.int64(READ_ONLY_MATRIX, SETTINGS, LAYOUT, MEMORY, CURSOR, KEPT))
def run_rigid(motion, settings, pile, memory, cursor, kept):
    """Follow a pile of rigid stones through a motion ([Jean1999]_) on from its cursor; return a status.

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
