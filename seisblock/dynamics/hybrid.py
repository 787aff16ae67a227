"""The engine: a state that follows a power series inside one mode, and guards that end the mode.

Ground acceleration is piecewise linear between samples. Within one sample and one mode the state is a power
series in time whose coefficients a model writes by recurrence, together with the series of its guards. The
engine never steps across a sample, watches the guards on the half-open interval (t0, t0 + h], locates the first
crossing on the guard's own polynomial, lets the model reset the state, and logs both limits.

Order and step
    A series shorter than ``order`` ends by itself (rest, sliding, flight) and is exact over the whole sample. A series of full
    ``order`` is cut where its last two terms fall below ``TRUNCATION`` of the state's own size; at 100 Hz and
    order 12 rocking never needs a cut, so one sample is one step. A model may name floors, sizes below which a state counts as that
    large: a motion that dies away among larger ones is noise, which has no convergent series.
Events
    A guard fires at the first time in (t0, t0 + h] from which it is negative. Touching zero is no event; a guard that a reset
    leaves at zero is judged by its first coefficient that is more than round-off. Of guards that cross
    together, the first in the model's order fires.
Ties
    A guard is a difference of larger numbers. Where the input turns exactly at a threshold, it may lie below zero by the round-off of
    those numbers, which its own coefficients do not show, and fires. A reset that knows the tolerance of the model's conditions then
    returns the mode and the state that were there: the limit was touched. That is no event, and up to the next step the guard
    starts from zero, so that its slope decides; firing again from the same state would lead to the same answer without end.
Slices
    Compiled code hears no interruption. The loop pauses after so many steps, between two samples, and goes on from there when it is
    called again: the answer does not depend on where it paused. No sample may take more than ``MOST_STEPS``.
Stretches
    A long motion is given stretch by stretch, the last sample of one being the first of the next. The loop pauses at the end of each but
    the last; times and events are those of the whole.
Extrema
    Maxima and minima of the tracked states come from the zeros of the derivative's polynomial, not from samples.
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
from seisblock.dynamics.extrema import init_extrema, update_extrema
from seisblock.dynamics.model_api import CONSTANT, OFF, RESET, SERIES, SKIP, no_skip
from seisblock.dynamics.step import advance_state, first_guard_crossing, read_forcing, step_length

_t = types()

MAX_SIMULTANEOUS_EVENTS = 16
"""More events than this at one instant are chattering."""

MAX_STEPS_PER_SAMPLE = 1 << 18
"""More steps than this in one sample lead nowhere."""

SKIPPED_PER_STEP = 64
"""So many samples passed over cost about as much as a step."""

MODEL_POINTERS = _t.FunctionType(SERIES), _t.FunctionType(RESET), _t.FunctionType(SKIP)
"""Types of a model's three functions."""


def allocate_scratch(shape, n_states, rows):
    """Return room for one step of a model with so many states, under a motion of so many rows."""
    terms = shape.order + 1
    return Scratch(
        np.zeros((n_states + shape.scratch, terms)),
        np.zeros((max(shape.guards, 1), terms)),
        np.zeros((rows, 2)),
        np.zeros(terms),
        np.zeros(terms),
        np.zeros(terms),
    )


allocate_scratch_kernel = kernel(SCRATCH(SHAPE, _t.int64, _t.int64), inline=True, allocates=True)(allocate_scratch)
"""The same for kernels."""


@kernel(_t.void(OUTPUT, _t.int64, VECTOR, _t.int64), inline=True)
def _store_sample(output, sample, y, mode):
    """Keep state and mode at a sample."""
    for i in range(y.size):
        output.path[sample, i] = y[i]
    output.modes[sample] = mode


@kernel(_t.void(OUTPUT, _t.int64, _t.int64, VECTOR), inline=True)
def _store_limit(output, event, side, y):
    """Keep the state on one side of an event."""
    for i in range(y.size):
        output.limits[event, side, i] = y[i]


@kernel(_t.void(OUTPUT, _t.int64, VECTOR, _t.float64), inline=True)
def _store_dwell_time(output, mode, clock, time):
    """Keep how long a stay in a mode was that ends now, and begin the next."""
    if output.dwell_times.shape[0] > 0:
        dwell_time = time - clock[MODE_START]
        output.dwell_times[mode, TOTAL] += dwell_time
        output.dwell_times[mode, LONGEST] = max(output.dwell_times[mode, LONGEST], dwell_time)
    clock[MODE_START] = time


@kernel(_t.void(_t.int64, MATRIX), inline=True)
def _lift_touched(touched, g):
    """Set touched guards, the bits of `touched`, that start below zero to start from zero."""
    for k in range(min(g.shape[0], 63)):
        if (touched >> k) & 1 and g[k, 0] < 0.0:
            g[k, 0] = 0.0


@kernel(_t.boolean(VECTOR, MATRIX), inline=True)
def _is_unchanged(y, c):
    """Return whether a state is that in the first column of `c`."""
    differing = 0
    for i in range(y.size):
        differing += y[i] != c[i, 0]
    return differing == 0


@kernel(_t.int64(*MODEL_POINTERS, FORCING, SHAPE, VECTOR, STATE, OUTPUT, SCRATCH))
def advance(series, reset, skip, forcing, shape, p, state, output, scratch):
    """Follow one trajectory on from its cursor; return a status.

    Parameters
    ----------
    series, reset, skip : function pointers
        The model; see ``SERIES``, ``RESET`` and ``SKIP``.
    forcing, shape, state, output, scratch : named tuples
        See :mod:`seisblock.dynamics.buffers`.
    p : array
        The model's parameters.
    """
    acceleration, gains, dt = forcing
    counters, clock, y = state
    events, times, extrema, transition_counts = output.events, output.times, output.extrema, output.transition_counts
    c, g, f = scratch.c, scratch.g, scratch.f
    segment_start = counters[SEGMENT_START]
    last = acceleration.shape[1] - 1
    order = shape.order
    floors = p.size - y.size if shape.has_floors else -1
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
    # a row that is left out stays zero, whatever the trajectory before this one read
    for row in range(f.shape[0]):
        f[row, 0] = f[row, 1] = 0.0
    if counters[HAS_STARTED] == 0:
        counters[HAS_STARTED] = 1
        clock[FIRST_EVENT_TIME] = np.nan
        clock[MODE_START] = (segment_start + sample) * dt + tau
        init_extrema(extrema, shape.tracked, y, (segment_start + sample) * dt + tau)
        if stores_path and tau == 0.0:
            _store_sample(output, sample, y, mode)
    status = RECORD_ENDED
    while sample < last and status == RECORD_ENDED:
        if steps_left <= 0 or (stores_events and 2 * (n_events - n_flushed) > times.size):
            status = PAUSED
            break
        if tau == 0.0 and at_rest:
            next_sample = skip(mode, acceleration, gains, sample, p)
            if next_sample > sample:
                if stores_path:
                    for row in range(sample + 1, next_sample + 1):
                        _store_sample(output, row, y, mode)
                steps_left -= 1 + (next_sample - sample) // SKIPPED_PER_STEP
                sample = next_sample
                continue
        read_forcing(forcing, sample, tau, f)
        min_steps_left = steps_left - MAX_STEPS_PER_SAMPLE
        n_events_before = n_events
        touched = 0
        while True:
            degree = series(mode, y, f, p, order, c, g)
            if touched != 0:
                _lift_touched(touched, g)
            at_rest = degree == CONSTANT
            remaining = dt - tau
            h = remaining
            if degree >= order:
                h = step_length(c, y.size, order, remaining, p, floors)
                if h < 1e-12 * dt and remaining > 1e-12 * dt:
                    status = STEP_TOO_SMALL
                    break
            guard, h = first_guard_crossing(scratch, shape, max(degree, 1), h)
            if h > 0.0:
                if degree > CONSTANT and not advance_state(
                    scratch, degree, h, (segment_start + sample) * dt + tau, shape.tracked, y, extrema
                ):
                    status = NOT_FINITE
                    break
                if tau + h > tau:
                    n_simultaneous = 0
                    touched = 0
            at_sample = h == remaining
            tau += h
            if not at_sample or guard >= 0:
                for row in range(f.shape[0]):
                    f[row, 0] += f[row, 1] * h
            if guard >= 0:
                if stores_events:
                    if n_events - n_flushed >= times.size:
                        status = TOO_MANY_EVENTS
                        break
                    _store_limit(output, n_events - n_flushed, 0, y)
                below = h == 0.0 and g[guard, 0] < 0.0
                if below:
                    # no step was made, so that the series has room for the state
                    for i in range(y.size):
                        c[i, 0] = y[i]
                next_mode = reset(mode, guard, y, f, p)
                if below and next_mode == mode and _is_unchanged(y, c):
                    touched |= 1 << guard
                    n_simultaneous += 1
                    if n_simultaneous > MAX_SIMULTANEOUS_EVENTS:
                        status = CHATTERING
                        break
                    continue
                if stores_events:
                    row = n_events - n_flushed
                    events[row, EVENT_SAMPLE] = segment_start + sample
                    events[row, EVENT_GUARD] = guard
                    events[row, EVENT_FROM] = mode
                    events[row, EVENT_TO] = next_mode
                    times[row] = tau
                    _store_limit(output, row, 1, y)
                for i in range(shape.tracked):
                    update_extrema(extrema, i, y[i], (segment_start + sample) * dt + tau)
                if n_events == 0:
                    clock[FIRST_EVENT_TIME] = (segment_start + sample) * dt + tau
                _store_dwell_time(output, mode, clock, (segment_start + sample) * dt + tau)
                if transition_counts.shape[0] > 0:
                    transition_counts[guard, next_mode] += 1
                n_events += 1
                mode = next_mode
                if mode < 0:
                    status = STOPPED
                    break
                n_simultaneous += 1
                if n_simultaneous > MAX_SIMULTANEOUS_EVENTS:
                    status = CHATTERING
                    break
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
                _store_sample(output, sample, y, mode)
    if status == RECORD_ENDED and counters[SAMPLES_AFTER] > 0:
        status = PAUSED
    if status == RECORD_ENDED:
        _store_dwell_time(output, mode, clock, (segment_start + sample) * dt + tau)
    counters[SAMPLE], counters[MODE], counters[N_EVENTS], counters[N_SIMULTANEOUS], counters[STEPS_LEFT] = (
        segment_start + sample,
        mode,
        n_events,
        n_simultaneous,
        steps_left,
    )
    counters[AT_REST] = at_rest
    clock[TAU] = tau
    return status


@kernel(_t.int64(*MODEL_POINTERS, FORCING, SHAPE, VECTOR, STATE, OUTPUT), allocates=True)
def integrate_kernel(series, reset, skip, forcing, shape, p, state, output):
    """Follow one trajectory on from its cursor, as :func:`advance` does, in room of its own; return a status."""
    scratch = allocate_scratch_kernel(shape, state.state.size, forcing.acceleration.shape[0])
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
    "allocate_scratch_kernel",
    "no_skip",
]
