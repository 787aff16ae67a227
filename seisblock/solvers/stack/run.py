"""A pile through one ground motion: fixed steps, what is kept of them, and the books of energy and momentum.

The step divides the sampling interval; between samples the acceleration is linear. A row is kept at a sample where some stone has moved
noticeably since the last row, and at the latest after so many samples. Work done by the ground, energy held and energy lost are booked
at each sample: what contacts and friction have taken may only grow. The loop pauses after so many steps and goes on from there, so
that Python may be interrupted; the answer does not depend on where.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import MATRIX, READ_ONLY_MATRIX, VECTOR
from seisblock.dynamics.status import NOT_FINITE, PAUSED, RECORD_ENDED, STOPPED
from seisblock.solvers.stack.arguments import (
    BASE,
    CURSOR,
    FELL,
    KEPT,
    KEPT_ROWS,
    LAYOUT,
    MEMORY,
    SAMPLE,
    SETTINGS,
    SINCE,
    STEP,
    STEPS_LEFT,
)
from seisblock.solvers.stack.frames import MASS, F, R, V, W, X
from seisblock.solvers.stack.rigid import hold
from seisblock.solvers.stack.row import BEFORE
from seisblock.solvers.stack.step import drift, energy_of, kick, press_all

_t = types()

LOOK_EVERY = 1e-3
"""How often, s, boxes are looked at for being near each other; a corner at 10 m/s does not outrun their margin."""

STILL = 1e-3
"""Speed, m/s, and spin, rad/s, below which a stone is still."""

LEAST_COSINE, FALL_TIME, FALL_X, FALL_Y, LEAN, FLOOR = range(6)
FATE = 6
"""A body's row: least cosine of its tilt, time of its fall (s, negative: none), direction of its upward axis at the fall; and when it has
fallen: the cosine of its tilt, or the height of its centre, below which it counts as such."""

WORK, LOST, MOST_LOST, CREATED, IMPULSE, START = 0, 1, 2, 3, 4, 7
BOOKS = 8
"""Work of the ground, J; energy lost; its largest value; largest fall below that, which only an error makes; the impulse (3), N s,
of the ground's contact and of the frame; and the energy held at the start, J."""


@kernel(_t.boolean(_t.int64, MATRIX, VECTOR, _t.float64), inline=True)
def _moved(n, bodies, row, tolerance):
    """Whether some stone has moved or turned by more than a tolerance since a row was kept."""
    for i in range(n):
        for k in range(7):
            if abs(bodies[i, X + k] - row[1 + 7 * i + k]) > tolerance:
                return True
    return False


@kernel(_t.void(_t.int64, MATRIX, _t.float64, VECTOR), inline=True)
def _keep(n, bodies, time, row):
    """Keep time, centres and quaternions."""
    row[0] = time
    for i in range(n):
        for k in range(7):
            row[1 + 7 * i + k] = bodies[i, X + k]


@kernel(_t.boolean(_t.int64, MATRIX))
def _still(n, bodies):
    """Whether every stone is still."""
    for i in range(n):
        for k in range(3):
            if abs(bodies[i, V + k]) > STILL or abs(bodies[i, W + k]) > STILL:
                return False
    return True


@kernel(_t.boolean(_t.int64, MATRIX, _t.float64, MATRIX))
def _watch(n, bodies, time, fates):
    """Follow the tilts; note the first time a stone leans too far or sinks; return whether one has just fallen."""
    fell = False
    for i in range(n):
        up = bodies[i, R + 8]
        fates[i, LEAST_COSINE] = min(fates[i, LEAST_COSINE], up)
        if fates[i, FALL_TIME] < 0.0 and (up < fates[i, LEAN] or bodies[i, X + 2] < fates[i, FLOOR]):
            fates[i, FALL_TIME] = time
            fates[i, FALL_X] = bodies[i, R + 2]
            fates[i, FALL_Y] = bodies[i, R + 5]
            fell = True
    return fell


@kernel(_t.float64(_t.int64, MATRIX, MATRIX, _t.float64, _t.float64, _t.float64, _t.float64))
def _work(n, bodies, inert, a0, a1, a2, dt):
    """Return the work against the stones' inertia at their present velocities over `dt`, J."""
    work = 0.0
    for i in range(n):
        work += inert[i, MASS] * (bodies[i, V] * a0 + bodies[i, V + 1] * a1 + bodies[i, V + 2] * a2)
    return work * dt


@kernel(_t.float64(_t.int64, MATRIX, MATRIX, _t.float64, _t.float64), inline=True)
def _rise(n, bodies, inert, gravity, dt):
    """Return by how much the stones' potential energy will have grown after `dt`, J."""
    rise = 0.0
    for i in range(n):
        rise += inert[i, MASS] * bodies[i, V + 2]
    return gravity * rise * dt


@kernel(_t.void(VECTOR, _t.float64), inline=True)
def _balance(books, held):
    """Book the energy held now; what is lost may only grow."""
    books[LOST] = books[WORK] - held
    books[MOST_LOST] = max(books[MOST_LOST], books[LOST])
    books[CREATED] = max(books[CREATED], books[MOST_LOST] - books[LOST])


@kernel(_t.UniTuple(_t.float64, 3)(READ_ONLY_MATRIX, _t.int64, _t.float64), inline=True)
def _ground(motion, sample, part):
    """Return the ground acceleration along, across and up, a part of the interval after a sample."""
    right = min(sample + 1, motion.shape[1] - 1)
    a0 = motion[0, sample] + part * (motion[0, right] - motion[0, sample])
    a1 = motion[1, sample] + part * (motion[1, right] - motion[1, sample])
    a2 = motion[2, sample] + part * (motion[2, right] - motion[2, sample])
    return a0, a1, a2


@kernel(_t.void(_t.int64, _t.int64, _t.boolean, SETTINGS, MEMORY, CURSOR, KEPT))
def _keep_sample(sample, n, last, settings, memory, cursor, kept):
    """Keep a row at a sample if it is due, and the time of each touch."""
    place, bodies = cursor
    time = sample * settings.dt
    room = kept.rows.shape[0] - 1
    if (
        sample == 0
        or last
        or place[SINCE] >= settings.longest_gap
        or _moved(n, bodies, kept.rows[min(max(place[KEPT_ROWS] - 1, 0), room)], settings.moved)
    ):
        _keep(n, bodies, time, kept.rows[min(place[KEPT_ROWS], room)])
        place[KEPT_ROWS] += 1
        place[SINCE] = 0
    place[SINCE] += 1
    for i in range(n + 1):
        for j in range(n + 1):
            if memory.touched[i, j] > 0.0:
                kept.last_touch[i, j] = time
                memory.touched[i, j] = 0.0


@kernel(_t.boolean(READ_ONLY_MATRIX, _t.int64, _t.boolean, _t.float64, SETTINGS, LAYOUT, MEMORY, CURSOR, KEPT))
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
        a0, a1, a2 = _ground(motion, s - place[BASE], part)
        step = hold(bodies, a0, a1, a2 + g, whole, left, look and left == whole, pile, memory)
        kicked = 0.5 * (memory.pace[BEFORE] + step)
        memory.pace[BEFORE] = step
        books[IMPULSE] -= kicked * (bodies[n, F] + total_mass * a0)
        books[IMPULSE + 1] -= kicked * (bodies[n, F + 1] + total_mass * a1)
        books[IMPULSE + 2] -= kicked * (bodies[n, F + 2] + total_mass * (a2 + g))
        books[WORK] -= _work(n, bodies, inert, a0, a1, a2, 0.5 * kicked)
        kick(n, bodies, inert, a0, a1, a2 + g, kicked)
        books[WORK] -= _work(n, bodies, inert, a0, a1, a2, 0.5 * kicked)
        if k == 0 and left == whole:
            held = energy_of(n, bodies, inert, g) + _rise(n, bodies, inert, g, 0.5 * step)
            if s == 0:
                books[START] = held
            _balance(books, held - books[START])
            if not math.isfinite(held):
                return False
            _keep_sample(s, n, s == settings.last, settings, memory, cursor, kept)
        if s == settings.last:
            return True
        drift(n, bodies, inert, step)
        left = left - step if step < left else 0.0
        if _watch(n, bodies, (s + part) * settings.dt, kept.fates) and settings.stop_at_fall:
            place[FELL] = 1
    return True


@kernel(_t.int64(READ_ONLY_MATRIX, SETTINGS, LAYOUT, MEMORY, CURSOR, KEPT))
def run(motion, settings, pile, memory, cursor, kept):
    """Follow a pile through a motion ([Furukawa2009]_) on from its cursor; return a status.

    Parameters
    ----------
    motion : (3, k) array, m/s^2
        Ground acceleration along, across, up, from the sample on that the cursor names; at its end the loop pauses.
    settings, pile, memory, cursor, kept : named tuples
        See :mod:`seisblock.solvers.stack.arguments`.
    """
    place, bodies = cursor
    inert, books = pile.inert, kept.books
    n = bodies.shape[0] - 1
    last = settings.last
    g = settings.gravity
    dt = settings.dt / settings.steps
    look = max(int(LOOK_EVERY / dt), 1)
    total_mass = 0.0
    for i in range(n):
        total_mass += inert[i, MASS]
    while place[SAMPLE] <= last:
        s = place[SAMPLE]
        given = s - place[BASE]
        if s < last and given + 1 >= motion.shape[1]:
            return PAUSED
        inner = settings.steps if s < last else 1
        while place[STEP] < inner:
            if place[STEPS_LEFT] <= 0:
                return PAUSED
            place[STEPS_LEFT] -= 1
            k = place[STEP]
            part = k / settings.steps
            if settings.rigid:
                if not _stride(motion, k, k % look == 0, total_mass, settings, pile, memory, cursor, kept):
                    return NOT_FINITE
                place[STEP] = k + 1
                continue
            a0, a1, a2 = _ground(motion, given, part)
            springs = press_all(bodies, dt, k % look == 0, pile, memory)
            books[IMPULSE] -= dt * (bodies[n, F] + total_mass * a0)
            books[IMPULSE + 1] -= dt * (bodies[n, F + 1] + total_mass * a1)
            books[IMPULSE + 2] -= dt * (bodies[n, F + 2] + total_mass * (a2 + g))
            work = _work(n, bodies, inert, a0, a1, a2, 0.5 * dt)
            if k == 0:
                kick(n, bodies, inert, a0, a1, a2 + g, 0.5 * dt)
                held = energy_of(n, bodies, inert, g) + springs
                if s == 0:
                    books[START] = held
                books[WORK] -= work
                _balance(books, held - books[START])
                books[WORK] += work
                if not math.isfinite(held):
                    return NOT_FINITE
                kick(n, bodies, inert, a0, a1, a2 + g, 0.5 * dt)
            else:
                kick(n, bodies, inert, a0, a1, a2 + g, dt)
            books[WORK] -= work + _work(n, bodies, inert, a0, a1, a2, 0.5 * dt)
            if k == 0:
                _keep_sample(s, n, s == last, settings, memory, cursor, kept)
            if s < last:
                drift(n, bodies, inert, dt)
            if _watch(n, bodies, (s + part) * settings.dt, kept.fates) and settings.stop_at_fall:
                place[FELL] = 1
            place[STEP] = k + 1
        if place[FELL] == 1:
            return STOPPED
        if s == last or (s >= settings.quiet and _still(n, bodies)):
            return RECORD_ENDED
        place[STEP] = 0
        place[SAMPLE] = s + 1
    return RECORD_ENDED
