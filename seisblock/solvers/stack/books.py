"""What is kept of a pile's run: rows where something has moved, fates, the books of energy and momentum; and when a sample is over.

A row is kept at a sample where some stone has moved noticeably since the last row, and at the latest after so many samples. Work done by
the ground, energy held and energy lost are booked at each sample: what contacts and friction have taken may only grow.
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import MATRIX, READ_ONLY_MATRIX, VECTOR
from seisblock.dynamics.status import PAUSED, RECORD_ENDED, STOPPED
from seisblock.solvers.stack.arguments import (
    BASE,
    CURSOR,
    FELL,
    KEPT,
    KEPT_ROWS,
    MEMORY,
    SAMPLE,
    SETTINGS,
    SINCE,
    STEP,
    STEPS_LEFT,
)
from seisblock.solvers.stack.frames import MASS, R, V, W, X

_t = types()

STILL = 1e-3
"""Speed, m/s, and spin, rad/s, below which a stone is still."""

LEAST_COSINE, FALL_TIME, FALL_X, FALL_Y, LEAN, FLOOR = range(6)
FATE = 6
"""A body's row: least cosine of its tilt, time of its fall (s, negative: none), direction of its upward axis at the fall; and when it has
fallen: the cosine of its tilt, or the height of its centre, below which it counts as such."""

WORK, LOST, MOST_LOST, CREATED, IMPULSE, START, SOLVED, UNSETTLED = 0, 1, 2, 3, 4, 7, 8, 9
BOOKS = 10
"""Work of the ground, J; energy lost; its largest value; largest fall below that, which only an error makes; the impulse (3), N s,
of the ground's contact and of the frame; the energy held at the start, J; and of steps of rigid stones, how many were solved, and in how
many of them sweeps did not come to rest."""


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
def watch(n, bodies, time, fates):
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
def work_of(n, bodies, inert, a0, a1, a2, dt):
    """Return the work against the stones' inertia at their present velocities over `dt`, J."""
    work = 0.0
    for i in range(n):
        work += inert[i, MASS] * (bodies[i, V] * a0 + bodies[i, V + 1] * a1 + bodies[i, V + 2] * a2)
    return work * dt


@kernel(_t.float64(_t.int64, MATRIX, MATRIX, _t.float64, _t.float64), inline=True)
def rise_of(n, bodies, inert, gravity, dt):
    """Return by how much the stones' potential energy will have grown after `dt`, J."""
    rise = 0.0
    for i in range(n):
        rise += inert[i, MASS] * bodies[i, V + 2]
    return gravity * rise * dt


@kernel(_t.void(VECTOR, _t.float64), inline=True)
def balance(books, held):
    """Book the energy held now; what is lost may only grow."""
    books[LOST] = books[WORK] - held
    books[MOST_LOST] = max(books[MOST_LOST], books[LOST])
    books[CREATED] = max(books[CREATED], books[MOST_LOST] - books[LOST])


@kernel(_t.UniTuple(_t.float64, 3)(READ_ONLY_MATRIX, _t.int64, _t.float64), inline=True)
def ground_at(motion, sample, part):
    """Return the ground acceleration along, across and up, a part of the interval after a sample."""
    right = min(sample + 1, motion.shape[1] - 1)
    a0 = motion[0, sample] + part * (motion[0, right] - motion[0, sample])
    a1 = motion[1, sample] + part * (motion[1, right] - motion[1, sample])
    a2 = motion[2, sample] + part * (motion[2, right] - motion[2, sample])
    return a0, a1, a2


@kernel(_t.void(_t.int64, _t.int64, _t.boolean, SETTINGS, MEMORY, CURSOR, KEPT))
def keep_sample(sample, n, last, settings, memory, cursor, kept):
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


@kernel(_t.int64(READ_ONLY_MATRIX, SETTINGS, CURSOR))
def steps_ahead(motion, settings, cursor):
    """Return how many steps of this sample are to be taken now: none where the motion that is given ends, or the loop shall pause."""
    place, _ = cursor
    s = place[SAMPLE]
    if s < settings.last and s - place[BASE] + 1 >= motion.shape[1]:
        return 0
    steps = min((settings.steps if s < settings.last else 1) - place[STEP], place[STEPS_LEFT])
    place[STEPS_LEFT] -= steps
    return steps


@kernel(_t.int64(SETTINGS, CURSOR))
def end_sample(settings, cursor):
    """Go on to the next sample if all steps of this one are taken; return how the run ends, PAUSED while it does not."""
    place, bodies = cursor
    s = place[SAMPLE]
    if place[STEP] < (settings.steps if s < settings.last else 1):
        return PAUSED
    if place[FELL] == 1:
        return STOPPED
    if s == settings.last or (s >= settings.quiet and _still(bodies.shape[0] - 1, bodies)):
        return RECORD_ENDED
    place[STEP] = 0
    place[SAMPLE] = s + 1
    return PAUSED
