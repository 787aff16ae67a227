"""What is kept of a pile's run: rows where something has moved, fates, the books of energy and momentum; and when a sample is over.

A row is kept at a sample where some stone has moved noticeably since the last row, and at the latest after so many samples. Work done by
the ground, energy held and energy lost are booked at each sample: what contacts and friction have taken may only grow.
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.core.status import PAUSED, RECORD_ENDED, STOPPED
from seisblock.dynamics.array_types import MATRIX, READ_ONLY_MATRIX, VECTOR
from seisblock.models.stack.buffers import (
    FIRST_SAMPLE,
    HAS_FALLEN,
    MEMORY,
    OUTPUT,
    ROW_COUNT,
    SAMPLE,
    SAMPLES_SINCE_ROW,
    SETTINGS,
    STATE,
    STEP,
    STEPS_REMAINING,
)
from seisblock.models.stack.frames import MASS, R, V, W, X

_t = types()

STILL_SPEED = 1e-3
"""Speed, m/s, and spin, rad/s, below which a stone is still."""

MIN_COSINE, FALL_TIME, FALL_X, FALL_Y, TILT_LIMIT, HEIGHT_LIMIT = range(6)
FALL_COLUMNS = 6
"""A body's row: least cosine of its tilt, time of its fall (s, negative: none), direction of its upward axis at the fall; and when it has
fallen: the cosine of its tilt, or the height of its centre, below which it counts as such."""

WORK, LOST, MAX_LOST, CREATED, IMPULSE, INITIAL_ENERGY, SOLVED, UNCONVERGED = 0, 1, 2, 3, 4, 7, 8, 9
LEDGER_COLUMNS = 10
"""Work of the ground, J; energy lost; its largest value; largest fall below that, which only an error makes; the impulse (3), N s,
of the ground's contact and of the frame; the energy held at the start, J; and of steps of rigid stones, how many were solved, and in how
many of them sweeps did not come to rest."""


@kernel(_t.boolean(_t.int64, MATRIX, VECTOR, _t.float64), inline=True)
def _has_moved(n, bodies, row, tolerance):
    """Whether some stone has moved or turned by more than a tolerance since a row was kept."""
    for i in range(n):
        for k in range(7):
            if abs(bodies[i, X + k] - row[1 + 7 * i + k]) > tolerance:
                return True
    return False


@kernel(_t.void(_t.int64, MATRIX, _t.float64, VECTOR), inline=True)
def _write_row(n, bodies, time, row):
    """Keep time, centres and quaternions."""
    row[0] = time
    for i in range(n):
        for k in range(7):
            row[1 + 7 * i + k] = bodies[i, X + k]


@kernel(_t.boolean(_t.int64, MATRIX))
def _is_still(n, bodies):
    """Whether every stone is still."""
    for i in range(n):
        for k in range(3):
            if abs(bodies[i, V + k]) > STILL_SPEED or abs(bodies[i, W + k]) > STILL_SPEED:
                return False
    return True


@kernel(_t.boolean(_t.int64, MATRIX, _t.float64, MATRIX))
def detect_falls(n, bodies, time, fall_states):
    """Follow the tilts; note the first time a stone leans too far or sinks; return whether one has just fallen."""
    has_fallen = False
    for i in range(n):
        cosine = bodies[i, R + 8]
        fall_states[i, MIN_COSINE] = min(fall_states[i, MIN_COSINE], cosine)
        if fall_states[i, FALL_TIME] < 0.0 and (cosine < fall_states[i, TILT_LIMIT] or bodies[i, X + 2] < fall_states[i, HEIGHT_LIMIT]):
            fall_states[i, FALL_TIME] = time
            fall_states[i, FALL_X] = bodies[i, R + 2]
            fall_states[i, FALL_Y] = bodies[i, R + 5]
            has_fallen = True
    return has_fallen


@kernel(_t.float64(_t.int64, MATRIX, MATRIX, _t.float64, _t.float64, _t.float64, _t.float64))
def inertial_work(n, bodies, inertias, a0, a1, a2, dt):
    """Return the work against the stones' inertia at their present velocities over `dt`, J."""
    work = 0.0
    for i in range(n):
        work += inertias[i, MASS] * (bodies[i, V] * a0 + bodies[i, V + 1] * a1 + bodies[i, V + 2] * a2)
    return work * dt


@kernel(_t.float64(_t.int64, MATRIX, MATRIX, _t.float64, _t.float64), inline=True)
def potential_energy_change(n, bodies, inertias, gravity, dt):
    """Return by how much the stones' potential energy will have grown after `dt`, J."""
    rise = 0.0
    for i in range(n):
        rise += inertias[i, MASS] * bodies[i, V + 2]
    return gravity * rise * dt


@kernel(_t.void(VECTOR, _t.float64), inline=True)
def update_energy_ledger(ledger, energy):
    """Book the energy held now; what is lost may only grow."""
    ledger[LOST] = ledger[WORK] - energy
    ledger[MAX_LOST] = max(ledger[MAX_LOST], ledger[LOST])
    ledger[CREATED] = max(ledger[CREATED], ledger[MAX_LOST] - ledger[LOST])


@kernel(_t.UniTuple(_t.float64, 3)(READ_ONLY_MATRIX, _t.int64, _t.float64), inline=True)
def interpolate_ground(motion, sample, fraction):
    """Return the ground acceleration along, across and up, a part of the interval after a sample."""
    right = min(sample + 1, motion.shape[1] - 1)
    a0 = motion[0, sample] + fraction * (motion[0, right] - motion[0, sample])
    a1 = motion[1, sample] + fraction * (motion[1, right] - motion[1, sample])
    a2 = motion[2, sample] + fraction * (motion[2, right] - motion[2, sample])
    return a0, a1, a2


@kernel(_t.void(_t.int64, _t.int64, _t.boolean, SETTINGS, MEMORY, STATE, OUTPUT))
def record_sample(sample, n, is_last, settings, memory, state, output):
    """Keep a row at a sample if it is due, and the time of each touch."""
    counters, bodies = state
    time = sample * settings.dt
    max_row = output.rows.shape[0] - 1
    if (
        sample == 0
        or is_last
        or counters[SAMPLES_SINCE_ROW] >= settings.max_row_interval
        or _has_moved(n, bodies, output.rows[min(max(counters[ROW_COUNT] - 1, 0), max_row)], settings.row_tolerance)
    ):
        _write_row(n, bodies, time, output.rows[min(counters[ROW_COUNT], max_row)])
        counters[ROW_COUNT] += 1
        counters[SAMPLES_SINCE_ROW] = 0
    counters[SAMPLES_SINCE_ROW] += 1
    for i in range(n + 1):
        for j in range(n + 1):
            if memory.contact_matrix[i, j] > 0.0:
                output.last_contact[i, j] = time
                memory.contact_matrix[i, j] = 0.0


@kernel(_t.int64(READ_ONLY_MATRIX, SETTINGS, STATE))
def steps_to_take(motion, settings, state):
    """Return how many steps of this sample are to be taken now: none where the motion that is given ends, or the loop shall pause."""
    counters, _ = state
    s = counters[SAMPLE]
    if s < settings.last and s - counters[FIRST_SAMPLE] + 1 >= motion.shape[1]:
        return 0
    steps = min((settings.steps if s < settings.last else 1) - counters[STEP], counters[STEPS_REMAINING])
    counters[STEPS_REMAINING] -= steps
    return steps


@kernel(_t.int64(SETTINGS, STATE))
def finish_sample(settings, state):
    """Go on to the next sample if all steps of this one are taken; return how the run ends, PAUSED while it does not."""
    counters, bodies = state
    s = counters[SAMPLE]
    if counters[STEP] < (settings.steps if s < settings.last else 1):
        return PAUSED
    if counters[HAS_FALLEN] == 1:
        return STOPPED
    if s == settings.last or (s >= settings.record_end and _is_still(bodies.shape[0] - 1, bodies)):
        return RECORD_ENDED
    counters[STEP] = 0
    counters[SAMPLE] = s + 1
    return PAUSED
