"""A pile through one ground motion: fixed steps, what is kept of them, and the books of energy and momentum.

The step divides the sampling interval; between samples the acceleration is linear. A row is kept at a sample where some stone has moved
noticeably since the last row, and at the latest after so many samples. Work done by the ground, energy held and energy lost are booked
at each sample: what contacts and friction have taken may only grow.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.solvers.stack.contact import MATRIX, VECTOR
from seisblock.solvers.stack.frames import MASS, F, R, V, W, X
from seisblock.solvers.stack.step import MEMORY, PILE, drift, energy_of, kick, press_all

_t = types()
READ_ONLY = _t.Array(_t.float64, 2, "C", readonly=True)

RECORD_ENDED, STOPPED, NOT_FINITE = 0, 1, 4
"""Statuses, as in :class:`seisblock.results.Status`."""

GRAVITY, DT, STEPS, STOP_AT_FALL, MOVED, LONGEST, QUIET = range(7)
"""Settings: gravity; sampling interval, s; steps in it; whether to stop at the first fall; movement, m or rad, that makes a row; most
samples between rows; sample from which the run ends as soon as every stone is still."""
SETTINGS = 7

LOOK_EVERY = 1e-3
"""How often, s, boxes are looked at for being near each other; a corner at 10 m/s does not outrun their margin."""

STILL = 1e-3
"""Speed, m/s, and spin, rad/s, below which a stone is still."""

LEAST_COSINE, FALL_TIME, FALL_X, FALL_Y, LEAN, FLOOR = range(6)
FATE = 6
"""A body's row: least cosine of its tilt, time of its fall (s, negative: none), direction of its upward axis at the fall; and when it has
fallen: the cosine of its tilt, or the height of its centre, below which it counts as such."""

WORK, LOST, MOST_LOST, CREATED, IMPULSE = 0, 1, 2, 3, 4
BOOKS = 7
"""Work of the ground, J; energy lost; its largest value; largest fall below that, which only an error makes; and the impulse (3), N s,
of the ground's contact and of the frame."""


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


@kernel(_t.void(VECTOR, _t.float64), inline=True)
def _balance(books, held):
    """Book the energy held now; what is lost may only grow."""
    books[LOST] = books[WORK] - held
    books[MOST_LOST] = max(books[MOST_LOST], books[LOST])
    books[CREATED] = max(books[CREATED], books[MOST_LOST] - books[LOST])


@kernel(_t.int64(READ_ONLY, VECTOR, MATRIX, PILE, MEMORY, MATRIX, MATRIX, MATRIX, VECTOR, _t.Array(_t.int64, 1, "C")))
def run(motion, settings, bodies, pile, memory, fates, rows, last_touch, books, info):
    """Follow a pile through a motion ([Furukawa2009]_); return a status.

    Parameters
    ----------
    motion : (3, n) array, m/s^2
        Ground acceleration along, across, up.
    settings : (7,) array
    bodies : (m + 1, 31) array
        State, the ground last; changed in place.
    pile, memory : tuples of arrays
        See ``PILE`` and ``MEMORY`` of ``stack_step``.
    fates, rows : (m, 6), (samples, 1 + 7 m) arrays
    last_touch : (m + 1, m + 1) array, s
        When two bodies last touched; negative: never.
    books : (7,) array
    info : (2,) array of int
        Rows kept, last sample.
    """
    inert = pile[10]
    touched = memory[4]
    n = bodies.shape[0] - 1
    samples = motion.shape[1]
    steps = int(settings[STEPS])
    g = settings[GRAVITY]
    dt = settings[DT] / steps
    look = max(int(LOOK_EVERY / dt), 1)
    total_mass = 0.0
    for i in range(n):
        total_mass += inert[i, MASS]
    kept, since = 0, 0
    start = 0.0
    status = RECORD_ENDED
    for s in range(samples):
        inner = steps if s < samples - 1 else 1
        for k in range(inner):
            part = k / steps
            right = min(s + 1, samples - 1)
            a0 = motion[0, s] + part * (motion[0, right] - motion[0, s])
            a1 = motion[1, s] + part * (motion[1, right] - motion[1, s])
            a2 = motion[2, s] + part * (motion[2, right] - motion[2, s])
            springs = press_all(bodies, dt, k % look == 0, pile, memory)
            books[IMPULSE] -= dt * (bodies[n, F] + total_mass * a0)
            books[IMPULSE + 1] -= dt * (bodies[n, F + 1] + total_mass * a1)
            books[IMPULSE + 2] -= dt * (bodies[n, F + 2] + total_mass * (a2 + g))
            work = _work(n, bodies, inert, a0, a1, a2, 0.5 * dt)
            if k == 0:
                kick(n, bodies, inert, a0, a1, a2 + g, 0.5 * dt)
                held = energy_of(n, bodies, inert, g) + springs
                start = held if s == 0 else start
                books[WORK] -= work
                _balance(books, held - start)
                books[WORK] += work
                if not math.isfinite(held):
                    info[0] = kept
                    info[1] = s
                    return NOT_FINITE
                kick(n, bodies, inert, a0, a1, a2 + g, 0.5 * dt)
            else:
                kick(n, bodies, inert, a0, a1, a2 + g, dt)
            books[WORK] -= work + _work(n, bodies, inert, a0, a1, a2, 0.5 * dt)
            if k == 0:
                time = s * settings[DT]
                if s == 0 or since >= settings[LONGEST] or s == samples - 1 or _moved(n, bodies, rows[max(kept - 1, 0)], settings[MOVED]):
                    _keep(n, bodies, time, rows[kept])
                    kept += 1
                    since = 0
                since += 1
                for i in range(n + 1):
                    for j in range(n + 1):
                        if touched[i, j] > 0.0:
                            last_touch[i, j] = time
                            touched[i, j] = 0.0
            if s < samples - 1:
                drift(n, bodies, inert, dt)
            if _watch(n, bodies, (s + part) * settings[DT], fates) and settings[STOP_AT_FALL] > 0.0:
                status = STOPPED
        if status == STOPPED or (s >= settings[QUIET] and _still(n, bodies)):
            info[0] = kept
            info[1] = s
            return status
    info[0] = kept
    info[1] = samples - 1
    return status
