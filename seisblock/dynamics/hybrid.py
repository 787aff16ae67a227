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
from seisblock.dynamics.arguments import (
    AT_ONE_INSTANT,
    BASE,
    BEYOND,
    CURSOR,
    FIRST_EVENT,
    FOUND,
    GROUND,
    KEPT,
    LOGGED,
    LONGEST,
    MODE,
    SAMPLE,
    SCRATCH,
    SHAPE,
    SINCE,
    STARTED,
    STEPS_LEFT,
    STILL,
    TAU,
    TOTAL,
    Scratch,
)
from seisblock.dynamics.arrays import MATRIX, VECTOR
from seisblock.dynamics.changes import EVENT_FROM, EVENT_GUARD, EVENT_SAMPLE, EVENT_TO
from seisblock.dynamics.contract import CONSTANT, OFF, RESET, SERIES, SKIP, stay
from seisblock.dynamics.extrema import begin, keep
from seisblock.dynamics.status import CHATTERING, NOT_FINITE, PAUSED, RECORD_ENDED, STEP_TOO_SMALL, STOPPED, TOO_MANY_EVENTS
from seisblock.dynamics.step import first_to_fire, move, read, step_length

_t = types()

SAME_INSTANT = 16
"""More events than this at one instant are chattering."""

MOST_STEPS = 1 << 18
"""More steps than this in one sample lead nowhere."""

SKIPPED = 64
"""So many samples passed over cost about as much as a step."""

POINTERS = _t.FunctionType(SERIES), _t.FunctionType(RESET), _t.FunctionType(SKIP)
"""Types of a model's three functions."""


def make_room(shape, n_states, rows):
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


room = kernel(SCRATCH(SHAPE, _t.int64, _t.int64), inline=True, allocates=True)(make_room)
"""The same for kernels."""


@kernel(_t.void(KEPT, _t.int64, VECTOR, _t.int64), inline=True)
def _keep_sample(kept, sample, y, mode):
    """Keep state and mode at a sample."""
    for i in range(y.size):
        kept.path[sample, i] = y[i]
    kept.modes[sample] = mode


@kernel(_t.void(KEPT, _t.int64, _t.int64, VECTOR), inline=True)
def _keep_limit(kept, event, side, y):
    """Keep the state on one side of an event."""
    for i in range(y.size):
        kept.limits[event, side, i] = y[i]


@kernel(_t.void(KEPT, _t.int64, VECTOR, _t.float64), inline=True)
def _keep_stay(kept, mode, clock, now):
    """Keep how long a stay in a mode was that ends now, and begin the next."""
    if kept.stays.shape[0] > 0:
        stay = now - clock[SINCE]
        kept.stays[mode, TOTAL] += stay
        kept.stays[mode, LONGEST] = max(kept.stays[mode, LONGEST], stay)
    clock[SINCE] = now


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


@kernel(_t.int64(*POINTERS, GROUND, SHAPE, VECTOR, CURSOR, KEPT, SCRATCH))
def go_on(series, reset, skip, ground, shape, p, cursor, kept, scratch):
    """Follow one trajectory on from its cursor; return a status.

    Parameters
    ----------
    series, reset, skip : function pointers
        The model; see ``SERIES``, ``RESET`` and ``SKIP``.
    ground, shape, cursor, kept, scratch : named tuples
        See :mod:`seisblock.dynamics.arguments`.
    p : array
        The model's parameters.
    """
    acceleration, gains, dt = ground
    place, clock, y = cursor
    events, times, extrema, tally = kept.events, kept.times, kept.extrema, kept.tally
    c, g, f = scratch.c, scratch.g, scratch.f
    base = place[BASE]
    last = acceleration.shape[1] - 1
    order = shape.order
    floors = p.size - y.size if shape.floored else -1
    keeps_path = kept.path.shape[0] > 0
    keeps_events = times.size > 0
    logged = place[LOGGED]
    sample, mode, found, repeated, left = place[SAMPLE] - base, place[MODE], place[FOUND], place[AT_ONE_INSTANT], place[STEPS_LEFT]
    still = place[STILL] != 0
    tau = clock[TAU]
    # a row that is left out stays zero, whatever the trajectory before this one read
    for row in range(f.shape[0]):
        f[row, 0] = f[row, 1] = 0.0
    if place[STARTED] == 0:
        place[STARTED] = 1
        clock[FIRST_EVENT] = np.nan
        clock[SINCE] = (base + sample) * dt + tau
        begin(extrema, shape.tracked, y, (base + sample) * dt + tau)
        if keeps_path and tau == 0.0:
            _keep_sample(kept, sample, y, mode)
    status = RECORD_ENDED
    while sample < last and status == RECORD_ENDED:
        if left <= 0 or (keeps_events and 2 * (found - logged) > times.size):
            status = PAUSED
            break
        if tau == 0.0 and still:
            ahead = skip(mode, acceleration, gains, sample, p)
            if ahead > sample:
                if keeps_path:
                    for row in range(sample + 1, ahead + 1):
                        _keep_sample(kept, row, y, mode)
                left -= 1 + (ahead - sample) // SKIPPED
                sample = ahead
                continue
        read(ground, sample, tau, f)
        least = left - MOST_STEPS
        before = found
        touched = 0
        while True:
            degree = series(mode, y, f, p, order, c, g)
            if touched != 0:
                _lift_touched(touched, g)
            still = degree == CONSTANT
            rest = dt - tau
            h = rest
            if degree >= order:
                h = step_length(c, y.size, order, rest, p, floors)
                if h < 1e-12 * dt and rest > 1e-12 * dt:
                    status = STEP_TOO_SMALL
                    break
            fired, h = first_to_fire(scratch, shape, max(degree, 1), h)
            if h > 0.0:
                if degree > CONSTANT and not move(scratch, degree, h, (base + sample) * dt + tau, shape.tracked, y, extrema):
                    status = NOT_FINITE
                    break
                if tau + h > tau:
                    repeated = 0
                    touched = 0
            at_sample = h == rest
            tau += h
            if not at_sample or fired >= 0:
                for row in range(f.shape[0]):
                    f[row, 0] += f[row, 1] * h
            if fired >= 0:
                if keeps_events:
                    if found - logged >= times.size:
                        status = TOO_MANY_EVENTS
                        break
                    _keep_limit(kept, found - logged, 0, y)
                below = h == 0.0 and g[fired, 0] < 0.0
                if below:
                    # no step was made, so that the series has room for the state
                    for i in range(y.size):
                        c[i, 0] = y[i]
                following = reset(mode, fired, y, f, p)
                if below and following == mode and _is_unchanged(y, c):
                    touched |= 1 << fired
                    repeated += 1
                    if repeated > SAME_INSTANT:
                        status = CHATTERING
                        break
                    continue
                if keeps_events:
                    row = found - logged
                    events[row, EVENT_SAMPLE] = base + sample
                    events[row, EVENT_GUARD] = fired
                    events[row, EVENT_FROM] = mode
                    events[row, EVENT_TO] = following
                    times[row] = tau
                    _keep_limit(kept, row, 1, y)
                for i in range(shape.tracked):
                    keep(extrema, i, y[i], (base + sample) * dt + tau)
                if found == 0:
                    clock[FIRST_EVENT] = (base + sample) * dt + tau
                _keep_stay(kept, mode, clock, (base + sample) * dt + tau)
                if tally.shape[0] > 0:
                    tally[fired, following] += 1
                found += 1
                mode = following
                if mode < 0:
                    status = STOPPED
                    break
                repeated += 1
                if repeated > SAME_INSTANT:
                    status = CHATTERING
                    break
            if at_sample or dt - tau <= 1e-15 * dt:
                break
            left -= 1
            if left < least:
                status = TOO_MANY_EVENTS if found > before else STEP_TOO_SMALL
                break
        if status == RECORD_ENDED:
            left -= 1
            sample += 1
            tau = 0.0
            if keeps_path:
                _keep_sample(kept, sample, y, mode)
    if status == RECORD_ENDED and place[BEYOND] > 0:
        status = PAUSED
    if status == RECORD_ENDED:
        _keep_stay(kept, mode, clock, (base + sample) * dt + tau)
    place[SAMPLE], place[MODE], place[FOUND], place[AT_ONE_INSTANT], place[STEPS_LEFT] = base + sample, mode, found, repeated, left
    place[STILL] = still
    clock[TAU] = tau
    return status


@kernel(_t.int64(*POINTERS, GROUND, SHAPE, VECTOR, CURSOR, KEPT), allocates=True)
def integrate(series, reset, skip, ground, shape, p, cursor, kept):
    """Follow one trajectory on from its cursor, as :func:`go_on` does, in room of its own; return a status."""
    scratch = room(shape, cursor.state.size, ground.acceleration.shape[0])
    return go_on(series, reset, skip, ground, shape, p, cursor, kept, scratch)


__all__ = ["CONSTANT", "OFF", "POINTERS", "RESET", "SERIES", "SKIP", "go_on", "integrate", "make_room", "room", "stay"]
