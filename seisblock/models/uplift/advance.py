"""Step loop of a block on corner springs: exact propagation between contact changes, which are located on power series.

In one contact state the block is a linear system under a piecewise linear ground motion, M q'' + C q' + K q = -M (f + t s) with the
coordinates q = (b theta_x, b theta_y, x, y, z) ([Okumura1987]_ eq. (1)). A step from one grid time to the next is a matrix product, see
:mod:`~seisblock.models.uplift.propagator`, and its interior is bounded (derived here): r = q'' satisfies the homogeneous damped equation,
so that e^2 = r'^T M r' + r^T K r never grows, and abs(sqrt(M) r'') <= sqrt(k^2 + c^2) e with the largest eigenvalues k^2 of K and c of C
relative to M. A quantity u leaves the cubic polynomial through its end values and rates by at most h^4/384 max abs(u''''), and that
polynomial lies between its Bezier coefficients. Where the slope changes, e grows by at most the change: this bound is kept from step to
step, and computed anew where it decides nothing.
Where a corner could cross, or a new extremum could lie inside, the step is a power series of the coordinates instead.
"""

from __future__ import annotations

import numpy as np

from seisblock._jit import kernel, types
from seisblock._jit.vectors import multiply_columns
from seisblock.core.status import CHATTERING, NOT_FINITE, PAUSED, RECORD_ENDED, TOO_MANY_EVENTS
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.dynamics.buffers import (
    MODE,
    N_EVENTS,
    N_FLUSHED,
    N_SIMULTANEOUS,
    SAMPLE,
    SCRATCH,
    SEGMENT_START,
    STEPS_LEFT,
    TAU,
)
from seisblock.dynamics.extrema import HIGHEST, HIGHEST_TIME, LOWEST, update_extrema, update_interior_extremum
from seisblock.dynamics.hybrid import (
    ADVANCE,
    MAX_SIMULTANEOUS_EVENTS,
    MAX_STEPS_PER_SAMPLE,
    begin_trajectory,
    count_event,
    end_call,
    store_event,
    store_limit,
    store_sample,
)
from seisblock.dynamics.model_api import OFF
from seisblock.dynamics.polynomial import NO_CROSSING, ROUND_OFF, bracketed_root, first_negative
from seisblock.models.uplift.constants import (
    ALL_CORNERS,
    CHANGES,
    CZ,
    DEGREE,
    FOURTH,
    GLUED,
    HALF_ALPHA,
    HALF_GAMMA,
    JX,
    JY,
    KX,
    KY,
    KZ,
    LEVER,
    PER_ROOT_JX,
    PROPAGATORS,
    SETTLEMENT,
    STEP,
    SUBSTEPS,
    TRACKED,
    TURN_X,
    TURN_Y,
    VA,
    VB,
    VX,
    VY,
    VZ,
    F,
    U,
    X,
    Y,
    Z,
)
from seisblock.models.uplift.propagator import SIZE
from seisblock.models.uplift.series import contact_sums, evaluate, levers, restoring, z_datum

_t = types()

DERIVATIVE_RATIO = 3.08
"""Largest deviation of the rate of a cubic polynomial times the step, over that of its values: 384 sqrt(3)/216."""


BEYOND = 1 << (4 + TRACKED)
"""Bit beside those of :func:`_undecided`."""


@kernel(_t.float64(VECTOR, _t.int64, VECTOR, MATRIX), inline=True)
def _energy_norm(p, closed, y, f):
    """Return e of the homogeneous equation: the bound of the third derivatives over a step."""
    datum, weight = z_datum(p, closed)
    sums = contact_sums(p, closed)
    b_rate, a_rate, x_rate, y_rate, z_rate = y[VB], y[VA], y[VX], y[VY], y[VZ]
    z2, b2, a2, x2, y2 = restoring(p, sums, y[Z] - datum, y[TURN_Y], y[TURN_X], y[X], y[Y], z_rate, b_rate, a_rate, x_rate, y_rate)
    z2, x2, y2 = z2 - f[2, 0] - weight, x2 - f[0, 0], y2 - f[1, 0]
    z3, b3, a3, x3, y3 = restoring(p, sums, z_rate, b_rate, a_rate, x_rate, y_rate, z2, b2, a2, x2, y2)
    z3, x3, y3 = z3 - f[2, 1], x3 - f[0, 1], y3 - f[1, 1]
    energy = z3 * z3 + p[JY] * b3 * b3 + p[JX] * a3 * a3 + x3 * x3 + y3 * y3
    energy += p[KX] * (x2 - p[HALF_ALPHA] * b2) ** 2 + p[KY] * (y2 + p[HALF_ALPHA] * a2) ** 2
    for i in range(4):
        sx, sy = levers(p, i)
        energy += p[KZ] * (z2 - sx * b2 + sy * a2) ** 2 if (closed >> i) & 1 else 0.0
    return np.sqrt(energy)


@kernel(_t.UniTuple(_t.float64, 2)(*(5 * (_t.float64,))), inline=True)
def _bezier_range(first, last, first_rate, last_rate, h):
    """Return the lowest and highest Bezier coefficient of the cubic polynomial with these values and rates at its ends."""
    third = h * (1.0 / 3.0)
    second, third = first + third * first_rate, last - third * last_rate
    return min(min(first, last), min(second, third)), max(max(first, last), max(second, third))


@kernel(_t.boolean(*(6 * (_t.float64,))), inline=True)
def _is_monotone(first, last, first_rate, last_rate, h, excess):
    """Return True if a quantity with these values and rates at its ends only rises or falls; `excess` is that of its values."""
    middle, excess = 3.0 * (last - first) / h - first_rate - last_rate, excess * DERIVATIVE_RATIO / h
    return min(min(first_rate, last_rate), middle) > excess or max(max(first_rate, last_rate), middle) < -excess


CORNERS = _t.UniTuple(_t.float64, 4)
"""Numbers of the four corners."""


@kernel(CORNERS(*(4 * (_t.float64,))), inline=True)
def corner_values(z, b, a, half_gamma):
    """Return the heights, or rates, of the corners of the base."""
    tilt, tilt_across = half_gamma * b, 0.5 * a
    return z - tilt + tilt_across, z - tilt - tilt_across, z + tilt + tilt_across, z + tilt - tilt_across


@kernel(_t.void(VECTOR, _t.int64, VECTOR), inline=True)
def _set_corners(p, closed, y):
    """Set the displacements and forces of the corners from coordinates and rates."""
    kz, cz = p[KZ], p[CZ]
    u1, u2, u3, u4 = corner_values(y[Z] - p[SETTLEMENT], y[TURN_Y], y[TURN_X], p[HALF_GAMMA])
    w1, w2, w3, w4 = corner_values(y[VZ], y[VB], y[VA], p[HALF_GAMMA])
    y[U], y[U + 1], y[U + 2], y[U + 3] = u1, u2, u3, u4
    y[F] = -(kz * u1 + cz * w1) if closed & 1 else 0.0
    y[F + 1] = -(kz * u2 + cz * w2) if closed & 2 else 0.0
    y[F + 2] = -(kz * u3 + cz * w3) if closed & 4 else 0.0
    y[F + 3] = -(kz * u4 + cz * w4) if closed & 8 else 0.0


@kernel(_t.float64(VECTOR, VECTOR, _t.int64), inline=True)
def corner_rate(p, y, i):
    """Return the vertical rate of corner `i`."""
    sx, sy = levers(p, i)
    return y[VZ] - sx * y[VB] + sy * y[VA]


@kernel(CORNERS(*(4 * (CORNERS,)), _t.float64), inline=True)
def _highest(first, last, first_rate, last_rate, third):
    """Return the highest Bezier coefficients of the corners; `third` is a third of the step."""
    return (
        max(max(first[0], last[0]), max(first[0] + third * first_rate[0], last[0] - third * last_rate[0])),
        max(max(first[1], last[1]), max(first[1] + third * first_rate[1], last[1] - third * last_rate[1])),
        max(max(first[2], last[2]), max(first[2] + third * first_rate[2], last[2] - third * last_rate[2])),
        max(max(first[3], last[3]), max(first[3] + third * first_rate[3], last[3] - third * last_rate[3])),
    )


@kernel(CORNERS(*(4 * (CORNERS,)), _t.float64), inline=True)
def _lowest(first, last, first_rate, last_rate, third):
    """Return the lowest Bezier coefficients of the corners; `third` is a third of the step."""
    return (
        min(min(first[0], last[0]), min(first[0] + third * first_rate[0], last[0] - third * last_rate[0])),
        min(min(first[1], last[1]), min(first[1] + third * first_rate[1], last[1] - third * last_rate[1])),
        min(min(first[2], last[2]), min(first[2] + third * first_rate[2], last[2] - third * last_rate[2])),
        min(min(first[3], last[3]), min(first[3] + third * first_rate[3], last[3] - third * last_rate[3])),
    )


@kernel(_t.boolean(_t.int64, VECTOR, VECTOR, VECTOR, _t.float64, _t.float64, MATRIX, VECTOR, VECTOR), inline=True)
def _is_quiet(mode, p, y, end, h, energy, extrema, top, margins):
    """Return True if no corner crosses within a step and no extremum lies beyond the present ones, by bounds that decide most steps.

    `top` holds the highest displacements and forces of the corners; `margins` is work space.
    """
    fourth, kz, cz = energy * p[FOURTH] * ((h * h) * (h * h) * (1.0 / 384.0)), p[KZ], p[CZ]
    excess, rate_excess, third = p[LEVER] * fourth, 0.125 * h * h * p[LEVER] * energy, h * (1.0 / 3.0)
    first, last = (y[U], y[U + 1], y[U + 2], y[U + 3]), (end[U], end[U + 1], end[U + 2], end[U + 3])
    start_rate = corner_values(y[VZ], y[VB], y[VA], p[HALF_GAMMA])
    last_rate = corner_values(end[VZ], end[VB], end[VA], p[HALF_GAMMA])
    high, low = _highest(first, last, start_rate, last_rate, third), _lowest(first, last, start_rate, last_rate, third)
    quiet = True
    # four equal operations each, which LLVM turns into one of a vector
    margins[0], margins[1], margins[2], margins[3] = (
        top[0] - (high[0] + excess),
        top[1] - (high[1] + excess),
        top[2] - (high[2] + excess),
        top[3] - (high[3] + excess),
    )
    margins[4], margins[5], margins[6], margins[7] = (
        top[4] + (kz * (low[0] - excess) + cz * (min(start_rate[0], last_rate[0]) - rate_excess)),
        top[5] + (kz * (low[1] - excess) + cz * (min(start_rate[1], last_rate[1]) - rate_excess)),
        top[6] + (kz * (low[2] - excess) + cz * (min(start_rate[2], last_rate[2]) - rate_excess)),
        top[7] + (kz * (low[3] - excess) + cz * (min(start_rate[3], last_rate[3]) - rate_excess)),
    )
    for i in range(4):
        quiet &= margins[i] >= 0.0
        if mode != GLUED:
            quiet &= margins[4 + i] >= 0.0
            quiet &= high[i] + excess < 0.0 if (mode >> i) & 1 else low[i] - excess > 0.0
    if mode == GLUED:
        return quiet
    for k in range(2):
        i, rate = (TURN_X, VA) if k == 0 else (TURN_Y, VB)
        # a rotation that does not move at all, as under shaking along one axis, stays zero
        is_still = y[i] == 0.0 and end[i] == 0.0 and y[rate] == 0.0 and end[rate] == 0.0
        excess = 0.0 if is_still else fourth * p[PER_ROOT_JX + k]
        lowest, highest = _bezier_range(y[i], end[i], y[rate], end[rate], h)
        quiet &= highest + excess <= extrema[i, HIGHEST] and lowest - excess >= extrema[i, LOWEST]
    return quiet


@kernel(_t.float64(VECTOR, VECTOR, MATRIX, _t.int64, _t.int64, _t.float64), inline=True)
def _force_rate(p, y, f, closed, i, after):
    """Return the rate of the force of corner `i`, a time `after` the loads."""
    datum, weight = z_datum(p, closed)
    sums = contact_sums(p, closed)
    z2, b2, a2, _, _ = restoring(p, sums, y[Z] - datum, y[TURN_Y], y[TURN_X], y[X], y[Y], y[VZ], y[VB], y[VA], y[VX], y[VY])
    sx, sy = levers(p, i)
    second = z2 - (f[2, 0] + f[2, 1] * after + weight) - sx * b2 + sy * a2
    return -(p[KZ] * corner_rate(p, y, i) + p[CZ] * second)


@kernel(_t.int64(_t.int64, VECTOR, VECTOR, VECTOR, MATRIX, _t.float64, _t.float64, MATRIX))
def _undecided(mode, p, y, end, f, h, energy, extrema):
    """Return the bits of the corners that could cross, 0 to 3, and of the tracked quantities that could have a new extremum inside a step.

    ``BEYOND`` is set if an extremum could lie beyond the present ones.
    """
    closed, kz, cz = mode & ALL_CORNERS, p[KZ], p[CZ]
    fourth = energy * p[FOURTH] * ((h * h) * (h * h) * (1.0 / 384.0))
    excess, rate_excess = p[LEVER] * fourth, 0.125 * h * h * p[LEVER] * energy
    bits = 0
    for i in range(4):
        first, last, first_rate, last_rate = y[U + i], end[U + i], corner_rate(p, y, i), corner_rate(p, end, i)
        lowest, highest = _bezier_range(first, last, first_rate, last_rate, h)
        lowest, highest = lowest - excess, highest + excess
        if highest > extrema[U + i, HIGHEST]:
            bits |= 0 if _is_monotone(first, last, first_rate, last_rate, h, excess) else 1 << (4 + U + i)
            bits |= BEYOND
        # of the linear system only the largest rise is used
        if mode == GLUED:
            continue
        if (closed >> i) & 1 == 0:
            bits |= 0 if lowest > 0.0 else 1 << i
            continue
        bits |= 0 if highest < 0.0 else 1 << i
        if -(kz * lowest + cz * (min(first_rate, last_rate) - rate_excess)) > extrema[F + i, HIGHEST]:
            # the same bound from the rates of the force
            force_excess = excess * (kz + cz * p[FOURTH])
            first, last = -(kz * first + cz * first_rate), end[F + i]
            first_rate, last_rate = _force_rate(p, y, f, closed, i, 0.0), _force_rate(p, end, f, closed, i, h)
            _, highest = _bezier_range(first, last, first_rate, last_rate, h)
            if highest + force_excess > extrema[F + i, HIGHEST]:
                bits |= 0 if _is_monotone(first, last, first_rate, last_rate, h, force_excess) else 1 << (4 + F + i)
                bits |= BEYOND
    for k in range(0 if mode == GLUED else 2):
        i, rate = (TURN_X, VA) if k == 0 else (TURN_Y, VB)
        excess = fourth * p[PER_ROOT_JX + k]
        lowest, highest = _bezier_range(y[i], end[i], y[rate], end[rate], h)
        if highest + excess > extrema[i, HIGHEST] or lowest - excess < extrema[i, LOWEST]:
            is_still = y[i] == 0.0 and end[i] == 0.0 and y[rate] == 0.0 and end[rate] == 0.0
            bits |= 0 if is_still or _is_monotone(y[i], end[i], y[rate], end[rate], h, excess) else 1 << (4 + i)
            bits |= BEYOND
    return bits


@kernel(_t.void(VECTOR, VECTOR, MATRIX, _t.int64, _t.int64, _t.float64, VECTOR), inline=True)
def _corner_series(p, y, c, degree, i, sign, g):
    """Write the power series of the displacement of corner `i`, times a sign, to `g`; a reset leaves corners at exactly zero."""
    sx, sy = levers(p, i)
    g[0] = sign * y[U + i]
    for k in range(1, degree + 1):
        g[k] = sign * (c[Z, k] - sx * c[TURN_Y, k] + sy * c[TURN_X, k])


@kernel(_t.Tuple((_t.int64, _t.float64))(_t.int64, _t.int64, VECTOR, VECTOR, VECTOR, SCRATCH, _t.int64, _t.float64, _t.float64))
def _first_crossing(bits, mode, p, y, end, scratch, degree, h, energy):
    """Return the first corner, of those in `bits`, that opens or closes within a step (-1 for none), and when."""
    guard, step = -1, h
    excess = p[LEVER] * energy * p[FOURTH] * ((h * h) * (h * h) * (1.0 / 384.0))
    for i in range(4):
        if (bits >> i) & 1 == 0:
            continue
        # a closed corner fires as u rises above zero, an open one as it falls below
        sign, g = -1.0 if (mode >> i) & 1 else 1.0, scratch.g[i]
        first, last = sign * y[U + i], sign * end[U + i]
        first_rate, last_rate = sign * corner_rate(p, y, i), sign * corner_rate(p, end, i)
        _corner_series(p, y, scratch.c, degree, i, sign, g)
        if first < 0.0 or not _is_monotone(first, last, first_rate, last_rate, step, excess):
            crossing = first_negative(g, degree, step, ROUND_OFF, scratch.q, scratch.d)
        else:
            crossing = bracketed_root(g, degree, step) if last < 0.0 else NO_CROSSING
        if crossing != NO_CROSSING and (guard < 0 or crossing < h):
            guard, h = i, crossing
    return guard, h


@kernel(_t.void(_t.int64, VECTOR, VECTOR, SCRATCH, _t.int64, _t.float64, _t.float64, MATRIX))
def _update_interior(bits, p, y, scratch, degree, h, time, extrema):
    """Update the extrema of the tracked quantities in `bits` inside a step that begins at `time`."""
    c = scratch.c
    for i in range(TRACKED):
        if (bits >> (4 + i)) & 1 == 0:
            continue
        if i < TURN_X:
            _corner_series(p, y, c, degree, i % 4, 1.0, c[i])
        if F <= i < TURN_X:
            for k in range(degree):
                c[i, k] = -(p[KZ] * c[i, k] + p[CZ] * (k + 1) * c[i, k + 1])
        top = degree - 1 if F <= i < TURN_X else degree
        update_interior_extremum(c, i, top, h, time, extrema, 1.0, scratch.rate, scratch.q, scratch.d)
        if i >= TURN_X:
            update_interior_extremum(c, i, top, h, time, extrema, -1.0, scratch.rate, scratch.q, scratch.d)


@kernel(_t.void(MATRIX, VECTOR, _t.float64, VECTOR), inline=True)
def _update_end(extrema, y, time, top):
    """Update the extrema with a state: of displacements and forces only the maxima, which are used and stand in `top`, too."""
    for i in range(TURN_X):
        if y[i] > extrema[i, HIGHEST]:
            extrema[i, HIGHEST], extrema[i, HIGHEST_TIME] = y[i], time
        top[i] = extrema[i, HIGHEST]
    update_extrema(extrema, TURN_X, y[TURN_X], time)
    update_extrema(extrema, TURN_Y, y[TURN_Y], time)


@kernel(ADVANCE)
def advance(series, reset, skip, forcing, shape, p, state, output, scratch):
    """Advance one trajectory from its current state as :func:`seisblock.dynamics.hybrid.advance` does; return a status code."""
    acceleration, gains, dt = forcing
    counters, clock, y = state
    times, extrema = output.times, output.extrema
    c, g, f = scratch.c, scratch.g, scratch.f
    end, top = c[Z + 1], c[Z + 2]
    segment_start, last, n_flushed = counters[SEGMENT_START], acceleration.shape[1] - 1, counters[N_FLUSHED]
    stores_path, stores_events = output.path.shape[0] > 0, times.size > 0
    sample, mode, n_events, n_simultaneous, steps_left = (
        counters[SAMPLE] - segment_start,
        counters[MODE],
        counters[N_EVENTS],
        counters[N_SIMULTANEOUS],
        counters[STEPS_LEFT],
    )
    tau, step, substeps, degree, per_dt = clock[TAU], p[STEP], int(p[SUBSTEPS]), int(p[DEGREE]), 1.0 / dt
    begin_trajectory(state, output, TRACKED, dt)
    # bound of the third derivatives, not known
    energy = -1.0
    for i in range(TURN_X):
        top[i] = extrema[i, HIGHEST]
    for row in range(3):
        f[row, 0] = f[row, 1] = 0.0
    status = RECORD_ENDED
    while sample < last and status == RECORD_ENDED:
        # pause between samples only, so that the result does not depend on the pauses
        if steps_left <= 0 or (stores_events and 2 * (n_events - n_flushed) > times.size):
            status = PAUSED
            break
        steps_left -= substeps
        for row in range(3):
            if gains[row] != 0.0:
                value = gains[row] * acceleration[row, sample]
                slope = (gains[row] * acceleration[row, sample + 1] - value) * per_dt
                # the solution with the old slope and that of the change add up
                energy += abs(slope - f[row, 1]) if energy >= 0.0 else 0.0
                f[row, 0], f[row, 1] = value + slope * tau, slope
        part, n_steps = int(tau / step) if tau > 0.0 else 0, 0
        while part < substeps:
            limit = dt if part == substeps - 1 else (part + 1) * step
            h, on_grid = limit - tau, tau == part * step
            closed, time = mode & ALL_CORNERS, (segment_start + sample) * dt + tau
            # a remainder below round-off counts as nothing
            if h <= 1e-15 * dt:
                tau, part = limit, part + 1
                continue
            if on_grid:
                multiply_columns(p, PROPAGATORS + closed * SIZE, y, TURN_X, f, end)
            else:
                series(mode, y, f, p, degree, c, g)
                evaluate(c, degree, h, end)
            _set_corners(p, closed, end)
            if energy < 0.0 or not _is_quiet(mode, p, y, end, h, energy, extrema, top, scratch.d):
                energy = _energy_norm(p, closed, y, f)
                bits = _undecided(mode, p, y, end, f, h, energy, extrema)
            else:
                bits = 0
            guard = -1
            if bits & (BEYOND - 1) != 0:
                steps_left -= 1
                if on_grid:
                    series(mode, y, f, p, degree, c, g)
                guard, h = _first_crossing(bits, mode, p, y, end, scratch, degree, h, energy)
                if guard >= 0 and h > 0.0:
                    evaluate(c, degree, h, end)
                    _set_corners(p, closed, end)
                    # what holds for the whole step holds for its beginning
                    bits = _undecided(mode, p, y, end, f, h, energy, extrema) if bits & BEYOND != 0 else 0
                if h > 0.0:
                    _update_interior(bits, p, y, scratch, degree, h, time, extrema)
            if h > 0.0:
                for i in range(CHANGES):
                    y[i] = end[i]
                if bits != 0:
                    _update_end(extrema, y, time + h, top)
                    if not abs(y[Z]) + abs(y[X]) + abs(y[Y]) + abs(y[TURN_X]) + abs(y[TURN_Y]) < OFF:
                        status = NOT_FINITE
                        break
                if tau + h > tau:
                    n_simultaneous = 0
            is_end = tau + h >= limit or guard < 0
            tau = limit if is_end else tau + h
            part += 1 if is_end else 0
            for row in range(3 if part < substeps else 0):
                if gains[row] != 0.0:
                    f[row, 0] = gains[row] * acceleration[row, sample] + f[row, 1] * tau
            if guard >= 0:
                event = n_events - n_flushed
                if stores_events:
                    if event >= times.size:
                        # the tables are full within one sample interval; the caller starts again with larger ones
                        status = TOO_MANY_EVENTS
                        break
                    store_limit(output, event, 0, y)
                next_mode = reset(mode, guard, y, f, p)
                if stores_events:
                    store_event(output, event, segment_start + sample, guard, mode, next_mode, tau, y)
                time = (segment_start + sample) * dt + tau
                # a landing sets the force of its dashpot
                _update_end(extrema, y, time, top)
                count_event(output, guard, mode, next_mode, n_events, clock, time)
                mode, energy = next_mode, -1.0
                n_events += 1
                n_simultaneous += 1
                n_steps += 1
                if n_simultaneous > MAX_SIMULTANEOUS_EVENTS:
                    status = CHATTERING
                    break
                if n_steps > MAX_STEPS_PER_SAMPLE:
                    status = TOO_MANY_EVENTS
                    break
        if status == RECORD_ENDED:
            sample += 1
            tau = 0.0
            if stores_path:
                store_sample(output, sample, y, mode)
    return end_call(state, output, status, segment_start + sample, mode, n_events, n_simultaneous, steps_left, tau, dt)
