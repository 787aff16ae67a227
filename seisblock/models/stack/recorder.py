"""Output of a run: stored rows, falls, energy and momentum balance, and control of the sample loop.

A row is stored at a sample where a stone has moved noticeably since the last row, and at the latest after a fixed number of samples. The
work of the ground and the mechanical energy are balanced at each sample; the dissipated energy may only grow.
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
    STILL_SAMPLES,
)
from seisblock.models.stack.frames import MASS, R, V, W, X

_t = types()

STILL_SPEED = 1e-3
"""Speed, m/s, and spin, rad/s, below which a stone is still."""

STILL_INTERVALS = 5
"""Row intervals through which all stones are still when a run ends: a stone that turns back, or passes its critical angle, is still for a
moment."""

MIN_COSINE, FALL_TIME, FALL_X, FALL_Y, TILT_LIMIT, HEIGHT_LIMIT = range(6)
FALL_COLUMNS = 6
"""A body's row: smallest cosine of its tilt, time of its fall (s, negative: none), direction of its axis at the fall (2); and the fall
criteria: cosine of the tilt, and height of the centre, m, below which the body has fallen."""

WORK, DISSIPATED, MAX_DISSIPATED, CREATED, IMPULSE, INITIAL_ENERGY, SOLVED, UNCONVERGED = 0, 1, 2, 3, 4, 7, 8, 9
LEDGER_COLUMNS = 10
"""Work of the ground, J; dissipated energy; its largest value; largest drop below that, which only an integration error can cause; impulse
of the ground contact and of the accelerated frame (3), N s; initial energy, J; number of solved steps with rigid contacts, and how many
of them did not converge."""


@kernel(_t.boolean(_t.int64, MATRIX, VECTOR, _t.float64), inline=True)
def _has_moved(n, bodies, row, tolerance):
    """Return whether a stone has moved or rotated by more than a tolerance since the stored row."""
    for i in range(n):
        for k in range(7):
            if abs(bodies[i, X + k] - row[1 + 7 * i + k]) > tolerance:
                return True
    return False


@kernel(_t.void(_t.int64, MATRIX, _t.float64, VECTOR), inline=True)
def _write_row(n, bodies, time, row):
    row[0] = time
    for i in range(n):
        for k in range(7):
            row[1 + 7 * i + k] = bodies[i, X + k]


@kernel(_t.boolean(_t.int64, MATRIX))
def _is_still(n, bodies):
    for i in range(n):
        for k in range(3):
            if abs(bodies[i, V + k]) > STILL_SPEED or abs(bodies[i, W + k]) > STILL_SPEED:
                return False
    return True


@kernel(_t.boolean(_t.int64, MATRIX, _t.float64, MATRIX))
def detect_falls(n, bodies, time, fall_states):
    """Update the largest tilts and the first falls; return whether a stone has just fallen."""
    has_fallen = False
    for i in range(n):
        cosine = bodies[i, R + 8]
        fall_states[i, MIN_COSINE] = min(fall_states[i, MIN_COSINE], cosine)
        if fall_states[i, FALL_TIME] < 0.0 and (cosine < fall_states[i, TILT_LIMIT] or bodies[i, X + 2] < fall_states[i, HEIGHT_LIMIT]):
            fall_states[i, FALL_TIME] = time
            # horizontal part of the stone's axis, the third column of its rotation matrix
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
    """Return the change of the stones' potential energy over `dt` at their present velocities, J."""
    rise = 0.0
    for i in range(n):
        rise += inertias[i, MASS] * bodies[i, V + 2]
    return gravity * rise * dt


@kernel(_t.void(VECTOR, _t.float64), inline=True)
def update_energy_ledger(ledger, energy):
    """Enter the present energy; any decrease of the dissipated energy is an integration error."""
    ledger[DISSIPATED] = ledger[WORK] - energy
    ledger[MAX_DISSIPATED] = max(ledger[MAX_DISSIPATED], ledger[DISSIPATED])
    ledger[CREATED] = max(ledger[CREATED], ledger[MAX_DISSIPATED] - ledger[DISSIPATED])


@kernel(_t.UniTuple(_t.float64, 3)(READ_ONLY_MATRIX, _t.int64, _t.float64), inline=True)
def interpolate_ground(motion, sample, fraction):
    """Return the ground acceleration along, across and up, at a fraction of the interval after a sample."""
    right = min(sample + 1, motion.shape[1] - 1)
    a0 = motion[0, sample] + fraction * (motion[0, right] - motion[0, sample])
    a1 = motion[1, sample] + fraction * (motion[1, right] - motion[1, sample])
    a2 = motion[2, sample] + fraction * (motion[2, right] - motion[2, sample])
    return a0, a1, a2


@kernel(_t.void(_t.int64, _t.int64, _t.boolean, SETTINGS, MEMORY, STATE, OUTPUT))
def record_sample(sample, n, is_last, settings, memory, state, output):
    """Store a row at a sample if it is due, and the time of each contact."""
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
    """Return the number of steps of this sample to take now: 0 at the end of the given motion or when the loop should pause."""
    counters, _ = state
    s = counters[SAMPLE]
    if s < settings.last and s - counters[FIRST_SAMPLE] + 1 >= motion.shape[1]:
        return 0
    # the last sample has a single step, which records the end and does not move the stones
    steps = min((settings.steps if s < settings.last else 1) - counters[STEP], counters[STEPS_REMAINING])
    counters[STEPS_REMAINING] -= steps
    return steps


@kernel(_t.int64(SETTINGS, STATE))
def finish_sample(settings, state):
    """Go on to the next sample once all steps of this one are taken; return the status of the run, PAUSED while it continues."""
    counters, bodies = state
    s = counters[SAMPLE]
    if counters[STEP] < (settings.steps if s < settings.last else 1):
        return PAUSED
    # the sample of the fall is completed, so that the row and the ledger are consistent
    if counters[HAS_FALLEN] == 1:
        return STOPPED
    counters[STILL_SAMPLES] = counters[STILL_SAMPLES] + 1 if _is_still(bodies.shape[0] - 1, bodies) else 0
    if s == settings.last or (s >= settings.record_end and counters[STILL_SAMPLES] > STILL_INTERVALS * settings.max_row_interval):
        return RECORD_ENDED
    counters[STEP] = 0
    counters[SAMPLE] = s + 1
    return PAUSED
