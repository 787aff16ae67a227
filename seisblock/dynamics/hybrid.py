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
Extrema
    Maxima and minima of the tracked states come from the zeros of the derivative's polynomial, not from samples.
"""

from __future__ import annotations

import numpy as np

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import BLOCK, INTEGER_TABLE, INTEGERS, MATRIX, READ_ONLY_MATRIX, VECTOR
from seisblock.dynamics.extrema import HIGHEST, HIGHEST_TIME, LOWEST, LOWEST_TIME, keep, keep_turning_points, may_turn
from seisblock.dynamics.polynomial import NEVER, evaluate_row, first_crossing, lower_bound_of_row

_t = types()

SERIES = _t.int64(_t.int64, VECTOR, MATRIX, VECTOR, _t.int64, MATRIX, MATRIX)
"""series(mode, y, f, p, order, c, g) -> degree.

Writes, from the state ``y`` and the ground motion ``f[row] = (value, slope)``, the coefficients ``c[i, 0:degree + 1]`` of state i
and ``g[k, 0:degree + 1]`` of guard k (``OFF`` in ``g[k, 0]`` skips a guard). Rows of c after the states are scratch. ``CONSTANT``
says that the state does not move: c is not read then, and guards are straight lines, ``g[k, 0:2]``."""

RESET = _t.int64(_t.int64, _t.int64, VECTOR, MATRIX, VECTOR)
"""reset(mode, guard, y, f, p) -> next mode; changes ``y`` in place. A negative mode ends the integration."""

CONSTANT = 0
"""Degree of a state that does not move."""

SKIP = _t.int64(_t.int64, READ_ONLY_MATRIX, VECTOR, _t.int64, VECTOR)
"""skip(mode, acceleration, gains, sample, p) -> a later sample, up to which the state stays as it is and no guard fires."""


@kernel(SKIP)
def stay(mode, acceleration, gains, sample, p):
    """Skip nothing: the model has no rest, or none worth a short cut."""
    return sample


OFF = float("inf")
"""Value of a guard that is not watched in this mode."""

TRUNCATION = 1.1e-16
"""Largest last term of a full series, relative to the state."""

RECORD_ENDED, STOPPED, TOO_MANY_EVENTS, CHATTERING, NOT_FINITE, STEP_TOO_SMALL = range(6)
"""Statuses, as in :class:`seisblock.results.Status`."""

EVENT_SAMPLE, EVENT_GUARD, EVENT_FROM, EVENT_TO = range(4)
INFO_EVENTS, INFO_SAMPLE, INFO_MODE = range(3)
LAST_TAU, FIRST_EVENT = range(2)

NO_TALLY = np.empty((0, 0), dtype=np.int64)
"""Asks for no tally."""

SAME_INSTANT = 16
"""More events than this at one instant are chattering."""


@kernel(_t.float64(MATRIX, _t.int64, _t.int64, _t.float64, VECTOR, _t.int64))
def _step_length(c, n_states, order, h, p, floors):
    """Return the part of `h` over which a full series is converged to round-off; `floors` says where they stand in `p`, or -1."""
    top = 1.0
    for _ in range(order - 1):
        top *= h
    for i in range(n_states):
        size = abs(c[i, 0]) + h * (abs(c[i, 1]) + h * (abs(c[i, 2]) + h * abs(c[i, 3])))
        if floors >= 0:
            size = max(size, p[floors + i])
        tail = top * max(abs(c[i, order - 1]), abs(c[i, order]) * h)
        if tail > TRUNCATION * size:
            # a state that starts from zero has its size in its later terms
            power = h**3
            for k in range(4, order - 1):
                power *= h
                size += abs(c[i, k]) * power
        if tail > TRUNCATION * size:
            cut = 0.9 * h * (TRUNCATION * size / tail) ** (1.0 / (order - 1)) if size > 0.0 else 0.5 * h
            top *= (cut / h) ** (order - 1)
            h = cut
    return h


@kernel(
    _t.int64(
        _t.FunctionType(SERIES),
        _t.FunctionType(RESET),
        _t.FunctionType(SKIP),
        READ_ONLY_MATRIX,
        VECTOR,
        _t.float64,
        _t.int64,
        _t.float64,
        _t.int64,
        VECTOR,
        VECTOR,
        INTEGERS,
        MATRIX,
        INTEGERS,
        INTEGER_TABLE,
        VECTOR,
        BLOCK,
        MATRIX,
        INTEGER_TABLE,
        INTEGERS,
        VECTOR,
    ),
    allocates=True,
)
def integrate(
    series,
    reset,
    skip,
    acceleration,
    gains,
    dt,
    sample,
    tau,
    mode,
    y,
    p,
    sizes,
    path,
    modes,
    event_table,
    event_times,
    event_states,
    extrema,
    tally,
    info,
    end,
):
    """Follow one trajectory to the end of the record or to a mode that stops it; return a status.

    Parameters
    ----------
    series, reset, skip : function pointers
        The model; see ``SERIES``, ``RESET`` and ``SKIP``.
    acceleration : (rows, n) array, m/s^2
        Ground acceleration at the samples.
    gains : (rows,) array
        Factor on each row, so that scaling a record copies nothing; a zero leaves the row unread.
    dt : float, s
    sample, tau : int, float
        Where to start: `tau` seconds after that sample.
    mode : int
    y : (n_states,) array
        Initial state; holds the final one afterwards.
    p : array
        The model's parameters.
    sizes : (5,) array of int
        Number of scratch rows, of guards, of tracked states, the order, and whether the last parameters are floors of the states.
    path, modes : (n, n_states), (n,) arrays, or with no rows
        State and mode at each sample reached.
    event_table, event_times, event_states : (m, 4), (m,), (m, 2, n_states) arrays
        Sample, guard, mode before and after; seconds after that sample; both limits of the state. With no rows events are
        counted and not kept.
    extrema : (n_states, 4) array
        Highest value, its time, lowest value, its time (s after sample 0), of the tracked states.
    tally : (n_guards, n_modes) array of int, or with no rows
        How often each guard led to each mode; negative modes are counted from the end.
    info : (3,) array of int
        Events found, last sample, last mode.
    end : (2,) array, s
        Time after the last sample at which the integration stopped; time of the first event after sample 0, NaN without one.
    """
    rows, n = acceleration.shape
    n_states = y.size
    n_guards = sizes[1]
    n_tracked = sizes[2]
    order = sizes[3]
    floors = p.size - n_states if sizes[4] else -1
    c = np.zeros((n_states + sizes[0], order + 1))
    g = np.zeros((max(n_guards, 1), order + 1))
    f = np.zeros((rows, 2))
    q = np.zeros(order + 1)
    d = np.zeros(order + 1)
    rate = np.zeros(order + 1)
    record = path.shape[0] > 0
    capacity = event_times.size
    end[FIRST_EVENT] = np.nan
    found = 0
    repeated = 0
    status = RECORD_ENDED
    still = True
    per_dt = 1.0 / dt
    for i in range(n_tracked):
        extrema[i, HIGHEST] = y[i]
        extrema[i, LOWEST] = y[i]
        extrema[i, HIGHEST_TIME] = sample * dt + tau
        extrema[i, LOWEST_TIME] = sample * dt + tau
    if record and tau == 0.0:
        path[sample, :] = y
        modes[sample] = mode
    while sample < n - 1 and status == RECORD_ENDED:
        if tau == 0.0 and still:
            ahead = skip(mode, acceleration, gains, sample, p)
            if ahead > sample:
                if record:
                    for row in range(sample + 1, ahead + 1):
                        path[row, :] = y
                        modes[row] = mode
                sample = ahead
                continue
        for row in range(rows):
            if gains[row] != 0.0:
                slope = gains[row] * (acceleration[row, sample + 1] - acceleration[row, sample]) * per_dt
                f[row, 0] = gains[row] * acceleration[row, sample] + slope * tau
                f[row, 1] = slope
        while True:
            degree = series(mode, y, f, p, order, c, g)
            still = degree == CONSTANT
            guard_degree = max(degree, 1)
            left = dt - tau
            h = left
            if degree >= order:
                h = _step_length(c, n_states, order, left, p, floors)
                if h < 1e-12 * dt and left > 1e-12 * dt:
                    status = STEP_TOO_SMALL
                    break
            fired = -1
            for k in range(n_guards):
                if g[k, 0] == OFF or lower_bound_of_row(g, k, guard_degree, h) > 0.0:
                    continue
                at = first_crossing(g[k], guard_degree, h, q, d)
                if at != NEVER and (fired < 0 or at < h):
                    fired = k
                    h = at
                    if at == 0.0:
                        break
            if h > 0.0:
                if degree > CONSTANT:
                    for i in range(n_tracked):
                        if may_turn(c, i, degree, h, extrema):
                            keep_turning_points(c, i, degree, h, sample * dt + tau, extrema, rate, q, d)
                    size = 0.0
                    for i in range(n_states):
                        y[i] = evaluate_row(c, i, degree, h)
                        size += abs(y[i])
                    if not size < OFF:
                        status = NOT_FINITE
                    for i in range(n_tracked):
                        keep(extrema, i, y[i], sample * dt + tau + h)
                if tau + h > tau:
                    repeated = 0
            if status != RECORD_ENDED:
                break
            at_sample = h == left
            tau += h
            if not at_sample or fired >= 0:
                for row in range(rows):
                    f[row, 0] += f[row, 1] * h
            if fired >= 0:
                if capacity == 0:
                    following = reset(mode, fired, y, f, p)
                elif found < capacity:
                    event_states[found, 0, :] = y
                    following = reset(mode, fired, y, f, p)
                    event_table[found, EVENT_SAMPLE] = sample
                    event_table[found, EVENT_GUARD] = fired
                    event_table[found, EVENT_FROM] = mode
                    event_table[found, EVENT_TO] = following
                    event_times[found] = tau
                    event_states[found, 1, :] = y
                else:
                    status = TOO_MANY_EVENTS
                    break
                for i in range(n_tracked):
                    keep(extrema, i, y[i], sample * dt + tau)
                if found == 0:
                    end[FIRST_EVENT] = sample * dt + tau
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
        if status == RECORD_ENDED:
            sample += 1
            tau = 0.0
            if record:
                path[sample, :] = y
                modes[sample] = mode
    info[INFO_EVENTS] = found
    info[INFO_SAMPLE] = sample
    info[INFO_MODE] = mode
    end[LAST_TAU] = tau
    return status
