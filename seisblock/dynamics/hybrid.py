"""Integration loop for hybrid systems with event detection: Taylor series within a mode, guards that end the mode, resets.

Ground acceleration is piecewise linear between samples. Within one sample interval and one mode the state is a power
series in time whose coefficients the model computes by recurrence, together with the series of its guards. The
engine never steps across a sample, checks the guards on the half-open interval (t0, t0 + h], locates the first
zero crossing on the polynomial of the guard, calls the reset of the model, and logs the state before and after.

Order and step
    A series shorter than ``order`` is finite (rest, sliding, flight) and exact over the whole interval. For a series of full
    ``order`` the step is reduced until its last two terms are below ``TRUNCATION`` times the size of the state; at 100 Hz and
    order 12 rocking needs no reduction, so that one interval is one step.
Events
    A guard fires at the first time in (t0, t0 + h] from which it is negative. Grazing zero is not an event; a guard that a reset
    leaves at zero is judged by its first coefficient above round-off. Of guards that cross
    simultaneously, the first in the model's order fires.
Ties
    A guard is a difference of larger numbers. Where the input turns exactly at a threshold, the guard may be negative by the round-off
    of those numbers, which its coefficients do not show, and fires. A reset that applies the tolerance of the model's conditions then
    returns the mode and the state unchanged: the guard grazes zero. This is not an event. Until the next step the guard
    starts from zero, so that its slope decides; otherwise it would fire again from the same state endlessly.
Slices
    Compiled code cannot be interrupted. The loop therefore pauses after a number of steps, between two samples, and continues
    at the next call; the result does not depend on the pauses. A sample interval takes at most ``MAX_STEPS_PER_SAMPLE`` steps.
Segments
    A long motion is passed in segments; the last sample of one is the first sample of the next. The loop pauses at the end of each
    segment but the last; times and sample numbers are those of the whole motion.
Extrema
    Maxima and minima of the tracked states are found at the zeros of the derivative of the polynomial, not at samples only.
"""

from __future__ import annotations

import numpy as np

from seisblock._jit import kernel, types
from seisblock.core.status import CHATTERING, NOT_FINITE, PAUSED, RECORD_ENDED, STEP_TOO_SMALL, STOPPED, TOO_MANY_EVENTS
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.dynamics.buffers import (
    AT_REST,
    FIRST_EVENT_TIME,
    FORCING,
    HAS_STARTED,
    LONGEST,
    MODE,
    MODE_START,
    N_EVENTS,
    N_FLUSHED,
    N_SIMULTANEOUS,
    OUTPUT,
    SAMPLE,
    SAMPLES_AFTER,
    SCRATCH,
    SEGMENT_START,
    SHAPE,
    STATE,
    STEPS_LEFT,
    TAU,
    TOTAL,
    Scratch,
)
from seisblock.dynamics.events import EVENT_FROM, EVENT_GUARD, EVENT_SAMPLE, EVENT_TO
from seisblock.dynamics.extrema import init_extrema, may_exceed_extrema, update_extrema, update_interior_extrema
from seisblock.dynamics.model_api import CONSTANT, OFF, RESET, SERIES, SKIP, no_skip
from seisblock.dynamics.polynomial import NO_CROSSING, ROUND_OFF, evaluate_row, first_negative, lower_bound_of_row

_t = types()

TRUNCATION = 1.1e-16
"""Maximum last term of a series of full order, relative to the state."""


@kernel(_t.float64(MATRIX, _t.int64, _t.int64, _t.float64))
def step_length(c, n_states, order, h):
    """Return the step length up to `h` at which the series has converged."""
    # the last two terms are tested, since the series of an even or odd state has zeros in between
    # h^(order - 1), scales the last two terms
    top = 1.0
    for _ in range(order - 1):
        top *= h
    for i in range(n_states):
        if c[i, 1] == OFF:
            continue
        # size of the state over the step, from its leading terms
        size = abs(c[i, 0]) + h * (abs(c[i, 1]) + h * (abs(c[i, 2]) + h * abs(c[i, 3])))
        tail = top * max(abs(c[i, order - 1]), abs(c[i, order]) * h)
        if tail > TRUNCATION * size:
            # a state that starts from zero gets its size from the higher terms
            power = h**3
            for k in range(4, order - 1):
                power *= h
                size += abs(c[i, k]) * power
        if tail > TRUNCATION * size:
            # the tail scales with h^(order - 1); factor 0.9 for safety
            reduced_h = 0.9 * h * (TRUNCATION * size / tail) ** (1.0 / (order - 1)) if size > 0.0 else 0.5 * h
            top *= (reduced_h / h) ** (order - 1)
            h = reduced_h
    return h


@kernel(_t.void(FORCING, _t.int64, _t.float64, MATRIX), inline=True)
def read_forcing(forcing, sample, tau, f):
    """Write value and slope of the ground motion `tau` seconds after a sample to `f`."""
    acceleration, gains = forcing.acceleration, forcing.gains
    per_dt = 1.0 / forcing.dt
    for row in range(acceleration.shape[0]):
        if gains[row] != 0.0:
            slope = gains[row] * (acceleration[row, sample + 1] - acceleration[row, sample]) * per_dt
            f[row, 0] = gains[row] * acceleration[row, sample] + slope * tau
            f[row, 1] = slope


@kernel(_t.Tuple((_t.int64, _t.float64))(SCRATCH, SHAPE, _t.int64, _t.float64), inline=True)
def first_guard_crossing(scratch, shape, degree, h):
    """Return the first guard that fires within a step (-1 for none) and its time, which ends the step."""
    g = scratch.g
    guard = -1
    for k in range(shape.guards):
        # a polynomial bounded away from zero needs no root search: this is the usual case
        if g[k, 0] == OFF or lower_bound_of_row(g, k, degree, h) > 0.0:
            continue
        # guards that are states are reset to exact zeros; all others carry the round-off of their sum
        crossing = first_negative(g[k], degree, h, 0.0 if k < shape.sharp else ROUND_OFF, scratch.q, scratch.d)
        # the step is shortened to the earliest crossing; of simultaneous ones the first guard is kept
        if crossing != NO_CROSSING and (guard < 0 or crossing < h):
            guard = k
            h = crossing
            if crossing == 0.0:
                break
    return guard, h


@kernel(_t.boolean(SCRATCH, _t.int64, _t.float64, _t.float64, _t.int64, VECTOR, MATRIX), inline=True)
def advance_state(scratch, degree, h, start_time, n_tracked, y, extrema):
    """Advance the state and its extrema by a step that begins at `start_time`; return True if the state is finite."""
    c = scratch.c
    # extrema inside the step; its end point follows below
    for i in range(n_tracked):
        if may_exceed_extrema(c, i, degree, h, extrema):
            update_interior_extrema(c, i, degree, h, start_time, extrema, scratch.rate, scratch.q, scratch.d)
    size = 0.0
    for i in range(y.size):
        if c[i, 1] == OFF:
            continue
        y[i] = evaluate_row(c, i, degree, h)
        size += abs(y[i])
    for i in range(n_tracked):
        update_extrema(extrema, i, y[i], start_time + h)
    # False for infinite and NaN sums
    return size < OFF


MAX_SIMULTANEOUS_EVENTS = 16
"""Number of events at one instant above which the status is CHATTERING."""

MAX_STEPS_PER_SAMPLE = 1 << 18
"""Number of steps within one sample interval above which the integration fails."""

SKIPPED_PER_STEP = 64
"""Number of skipped samples that cost about as much as one step."""

MODEL_POINTERS = _t.FunctionType(SERIES), _t.FunctionType(RESET), _t.FunctionType(SKIP)
"""Types of the three functions of a model."""


def allocate_scratch(shape, n_states, rows):
    """Return the work arrays of one step for a model with `n_states` states under a motion with `rows` rows."""
    terms = shape.order + 1
    return Scratch(
        np.zeros((n_states + shape.scratch, terms)),
        np.zeros((max(shape.guards, 1), terms)),
        np.zeros((rows, 2)),
        np.zeros(terms),
        np.zeros(terms),
        np.zeros(terms),
    )


@kernel(_t.void(OUTPUT, _t.int64, VECTOR, _t.int64), inline=True)
def store_sample(output, sample, y, mode):
    """Store state and mode at a sample."""
    for i in range(y.size):
        output.path[sample, i] = y[i]
    output.modes[sample] = mode


@kernel(_t.void(OUTPUT, _t.int64, _t.int64, VECTOR), inline=True)
def store_limit(output, event, side, y):
    """Store the state before (side 0) or after (side 1) an event."""
    for i in range(y.size):
        output.limits[event, side, i] = y[i]


@kernel(_t.void(OUTPUT, _t.int64, VECTOR, _t.float64), inline=True)
def _store_dwell_time(output, mode, clock, time):
    """Add the time since the last event to the dwell times of a mode and restart the clock."""
    if output.dwell_times.shape[0] > 0:
        dwell_time = time - clock[MODE_START]
        # the longest stay is that between two events: a rebound into the same mode ends it
        output.dwell_times[mode, TOTAL] += dwell_time
        output.dwell_times[mode, LONGEST] = max(output.dwell_times[mode, LONGEST], dwell_time)
    clock[MODE_START] = time


@kernel(_t.void(STATE, OUTPUT, _t.int64, _t.float64), inline=True)
def begin_trajectory(state, output, tracked, dt):
    """Start clocks, extrema and path at the first call for a trajectory; a continuation after a pause keeps them."""
    counters, clock, y = state
    if counters[HAS_STARTED] == 0:
        counters[HAS_STARTED] = 1
        clock[FIRST_EVENT_TIME] = np.nan
        clock[MODE_START] = counters[SAMPLE] * dt + clock[TAU]
        init_extrema(output.extrema, tracked, y, clock[MODE_START])
        if output.path.shape[0] > 0 and clock[TAU] == 0.0:
            store_sample(output, counters[SAMPLE] - counters[SEGMENT_START], y, counters[MODE])


@kernel(_t.void(OUTPUT, *(5 * (_t.int64,)), _t.float64, VECTOR), inline=True)
def store_event(output, event, sample, guard, mode, next_mode, tau, y):
    """Store an event in a row of the tables, with the state after it."""
    row = output.events[event]
    row[EVENT_SAMPLE], row[EVENT_GUARD], row[EVENT_FROM], row[EVENT_TO] = sample, guard, mode, next_mode
    output.times[event] = tau
    store_limit(output, event, 1, y)


@kernel(_t.void(OUTPUT, *(4 * (_t.int64,)), VECTOR, _t.float64), inline=True)
def count_event(output, guard, mode, next_mode, n_events, clock, time):
    """Add an event to the time of the first one, the dwell times and the transition counts; `n_events` came before."""
    if n_events == 0:
        clock[FIRST_EVENT_TIME] = time
    _store_dwell_time(output, mode, clock, time)
    if output.transition_counts.shape[0] > 0:
        output.transition_counts[guard, next_mode] += 1


@kernel(_t.int64(STATE, OUTPUT, *(6 * (_t.int64,)), _t.float64, _t.float64), inline=True)
def end_call(state, output, status, sample, mode, n_events, n_simultaneous, steps_left, tau, dt):
    """Write the state of a pause, from which the next call continues bit by bit; return the status of the call.

    `sample` counts from the start of the motion.
    """
    counters, clock, _ = state
    # end of a segment, not of the motion
    if status == RECORD_ENDED and counters[SAMPLES_AFTER] > 0:
        status = PAUSED
    if status == RECORD_ENDED:
        _store_dwell_time(output, mode, clock, sample * dt + tau)
    counters[SAMPLE], counters[MODE], counters[N_EVENTS], counters[N_SIMULTANEOUS], counters[STEPS_LEFT] = (
        sample,
        mode,
        n_events,
        n_simultaneous,
        steps_left,
    )
    clock[TAU] = tau
    return status


@kernel(_t.void(_t.int64, MATRIX), inline=True)
def _clamp_grazing(grazing, g):
    """Set to zero the initial value of negative guards whose bits are set in `grazing`."""
    # one bit of a 64-bit integer per guard, without the sign
    for k in range(min(g.shape[0], 63)):
        if (grazing >> k) & 1 and g[k, 0] < 0.0:
            g[k, 0] = 0.0


@kernel(_t.boolean(VECTOR, MATRIX), inline=True)
def _is_unchanged(y, c):
    """Return True if a state equals the first column of `c`, bit by bit."""
    differing = 0
    for i in range(y.size):
        differing += y[i] != c[i, 0]
    return differing == 0


ADVANCE = _t.int64(*MODEL_POINTERS, FORCING, SHAPE, VECTOR, STATE, OUTPUT, SCRATCH)
"""Signature of :func:`advance`, which the loops call by its pointer: linked into each of them, it would be compiled three times."""

LOOP_POINTERS = _t.FunctionType(ADVANCE), *MODEL_POINTERS
"""Types of the functions of a loop over trajectories."""


@kernel(ADVANCE)
def advance(series, reset, skip, forcing, shape, p, state, output, scratch):
    """Advance one trajectory from its current state; return a status code.

    Parameters
    ----------
    series, reset, skip : function pointers
        Functions of the model; see ``SERIES``, ``RESET`` and ``SKIP``.
    forcing, shape, state, output, scratch : named tuples
        See :mod:`seisblock.dynamics.buffers`.
    p : array
        Parameters of the model.
    """
    acceleration, gains, dt = forcing
    counters, clock, y = state
    times, extrema = output.times, output.extrema
    c, g, f = scratch.c, scratch.g, scratch.f
    segment_start = counters[SEGMENT_START]
    last = acceleration.shape[1] - 1
    order = shape.order
    stores_path = output.path.shape[0] > 0
    stores_events = times.size > 0
    n_flushed = counters[N_FLUSHED]
    sample, mode, n_events, n_simultaneous, steps_left = (
        counters[SAMPLE] - segment_start,
        counters[MODE],
        counters[N_EVENTS],
        counters[N_SIMULTANEOUS],
        counters[STEPS_LEFT],
    )
    at_rest = counters[AT_REST] != 0
    tau = clock[TAU]
    # models read all rows of f, but rows with a zero gain are not written: clear the values of an earlier trajectory
    for row in range(f.shape[0]):
        f[row, 0] = f[row, 1] = 0.0
    begin_trajectory(state, output, shape.tracked, dt)
    status = RECORD_ENDED
    while sample < last and status == RECORD_ENDED:
        # pause between samples only, so that the result does not depend on the pauses
        if steps_left <= 0 or (stores_events and 2 * (n_events - n_flushed) > times.size):
            status = PAUSED
            break
        # at rest: let the model look ahead for the first sample at which the motion can begin
        if tau == 0.0 and at_rest:
            next_sample = skip(mode, acceleration, gains, sample, p)
            if next_sample > sample:
                if stores_path:
                    for row in range(sample + 1, next_sample + 1):
                        store_sample(output, row, y, mode)
                # skipped samples count against the slice, so that a long record at rest can still be interrupted
                steps_left -= 1 + (next_sample - sample) // SKIPPED_PER_STEP
                sample = next_sample
                continue
        read_forcing(forcing, sample, tau, f)
        min_steps_left = steps_left - MAX_STEPS_PER_SAMPLE
        n_events_before = n_events
        grazing = 0
        while True:
            degree = series(mode, y, f, p, order, c, g)
            if grazing != 0:
                _clamp_grazing(grazing, g)
            at_rest = degree == CONSTANT
            remaining = dt - tau
            # only a series of full order is truncated and may need a shorter step
            h = remaining
            if degree >= order:
                h = step_length(c, y.size, order, remaining)
                # a remainder this short is allowed to end the interval; a step this short elsewhere means that the
                # series does not converge
                if h < 1e-12 * dt and remaining > 1e-12 * dt:
                    status = STEP_TOO_SMALL
                    break
            # at rest the states are constant, but guards follow the ground motion and are linear
            guard, h = first_guard_crossing(scratch, shape, max(degree, 1), h)
            if h > 0.0:
                if degree > CONSTANT and not advance_state(
                    scratch, degree, h, (segment_start + sample) * dt + tau, shape.tracked, y, extrema
                ):
                    status = NOT_FINITE
                    break
                # time has advanced: chattering and grazing concern events at one instant only
                if tau + h > tau:
                    n_simultaneous = 0
                    grazing = 0
            # compared before tau changes: h is `remaining` itself if nothing has shortened the step, so that equality
            # is exact
            at_sample = h == remaining
            tau += h
            # resets and the next series need the ground motion at the end of the step
            # a full interval needs no update: `read_forcing` starts anew at the next sample, without accumulated
            # round-off
            if not at_sample or guard >= 0:
                for row in range(f.shape[0]):
                    f[row, 0] += f[row, 1] * h
            if guard >= 0:
                if stores_events:
                    if n_events - n_flushed >= times.size:
                        # the tables are full within one sample interval; the caller starts again with larger ones
                        status = TOO_MANY_EVENTS
                        break
                    store_limit(output, n_events - n_flushed, 0, y)
                # a guard negative without any step is a tie or a violated limit, not a crossing
                below = h == 0.0 and g[guard, 0] < 0.0
                if below:
                    # no step was made: column 0 of the series is free for a copy of the state
                    for i in range(y.size):
                        c[i, 0] = y[i]
                next_mode = reset(mode, guard, y, f, p)
                # grazing: the reset found no violation beyond its tolerance (see "Ties")
                if below and next_mode == mode and _is_unchanged(y, c):
                    grazing |= 1 << guard
                    n_simultaneous += 1
                    if n_simultaneous > MAX_SIMULTANEOUS_EVENTS:
                        status = CHATTERING
                        break
                    continue
                if stores_events:
                    store_event(output, n_events - n_flushed, segment_start + sample, guard, mode, next_mode, tau, y)
                # a reset may set a state beyond the extrema of the step
                for i in range(shape.tracked):
                    update_extrema(extrema, i, y[i], (segment_start + sample) * dt + tau)
                count_event(output, guard, mode, next_mode, n_events, clock, (segment_start + sample) * dt + tau)
                n_events += 1
                mode = next_mode
                # terminal modes are negative
                if mode < 0:
                    status = STOPPED
                    break
                n_simultaneous += 1
                if n_simultaneous > MAX_SIMULTANEOUS_EVENTS:
                    status = CHATTERING
                    break
            # a remainder below round-off counts as the sample, to avoid a step of length zero
            if at_sample or dt - tau <= 1e-15 * dt:
                break
            steps_left -= 1
            if steps_left < min_steps_left:
                status = TOO_MANY_EVENTS if n_events > n_events_before else STEP_TOO_SMALL
                break
        if status == RECORD_ENDED:
            steps_left -= 1
            sample += 1
            tau = 0.0
            if stores_path:
                store_sample(output, sample, y, mode)
    counters[AT_REST] = at_rest
    return end_call(state, output, status, segment_start + sample, mode, n_events, n_simultaneous, steps_left, tau, dt)


@kernel(_t.int64(*LOOP_POINTERS, FORCING, SHAPE, VECTOR, STATE, OUTPUT, SCRATCH))
def integrate_kernel(advance, series, reset, skip, forcing, shape, p, state, output, scratch):
    """Advance one trajectory as :func:`advance` does; return a status code."""
    return advance(series, reset, skip, forcing, shape, p, state, output, scratch)


__all__ = [
    "CONSTANT",
    "OFF",
    "MODEL_POINTERS",
    "RESET",
    "SERIES",
    "SKIP",
    "advance",
    "integrate_kernel",
    "allocate_scratch",
    "no_skip",
]
