"""Newton's method for the impulses of one step: an iteration costs about 1 us per stone of a tower.

The laws are those of :mod:`seisblock.models.stack.pgs`. First Newton's method is applied to the laws of all contacts and the balance of
momentum at once ([AlartCurnier1991]_): each step decides from a trial impulse whether a contact is open, sticks or slides, and linearises
that law, with the dependence of friction on the normal impulse and on the direction of the slip. Near the solution the number of steps
hardly depends on that of the stones. A step that increases the sum of squared errors is halved, and makes the next one more compliant:
the laws of few contacts would otherwise change to and fro. A small compliance against the change of the impulses in a step selects, of the
distributions of a load over the points of a face, one near that of the last step; it vanishes in the solution. The matrix is not
symmetric: block factors L U within the envelope of the contact graph (band of one block for a tower).

In a pile that collapses, the laws that act may change to and fro without end. Then the friction limits are held: the velocities after the
step minimise a convex function, kinetic energy of the change plus a quadratic penalty of each contact law about a centre impulse (the
augmented Lagrangian), by Newton steps with the same factorisation, shortened by a line search, so that the active contacts cannot cycle.
Friction limits follow from the last iterate; when they have settled, the centres move to the impulses, which removes the error of the
penalty.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock._jit.vectors import subtract_product, subtract_row
from seisblock.dynamics.array_types import BLOCK, INTEGER_TABLE, MATRIX, VECTOR
from seisblock.models.stack.constraint_row import (
    ARM_A,
    ARM_B,
    BILATERAL,
    CONE_CENTRE,
    FORCE_SLOPE,
    IMPULSE,
    LAW_CHANGE,
    LAW_STEP,
    MIN_NORMAL_VELOCITY,
    MU,
    NORMAL,
    PENALTY,
    PENALTY_CENTRE,
    PRESSURE,
    PROJECTED,
    ROTATION_BIAS,
    SLIDING_DIRECTION,
    SLIP_CHANGE,
    SLIP_SLOPE,
    START_IMPULSE,
    START_VELOCITY,
    TRIAL_SLIP,
    W,
    apply_impulse,
    apply_impulses,
    relative_velocity,
)

_t = types()

MAX_ITERATIONS, MAX_GROWTH = 600, 1e6
"""Newton steps after which the sweeps take over; and error of the impulses over the first one (at least the tolerance) from which they
diverge: high friction may let them grow without bound (Painleve)."""

ACCURACY, FINE_ACCURACY, MAX_REFINEMENTS = 0.7, 0.03, 10
"""Error of the velocities, over the tolerance, at which the iterations end; error that they go on to while the contact laws converge, since
errors of many joints add up to a slip that friction should prevent; and number of steps after which they end without it."""

FIRST_COMPLIANCE, COMPLIANCE_FACTOR, MIN_COMPLIANCE = 3e-2, 0.5, 1e-5
"""Compliance of a contact over its Delassus block: at first, ratio of successive ones, and smallest."""

STALLED_ITERATIONS, SOFTENING, MAX_COMPLIANCE, EASY_ITERATIONS = 8, 10.0, 0.3, 3
"""Iterations without a move of the centres after which the compliance rises, by which factor, and up to which value: the active set of many
sliding contacts settles sooner when they are soft. The compliance then falls only after a move within so few iterations."""

MOVE_RATIO, LAW_RATIO = 10.0, 3.0
"""Error of the impulses over that of the penalty at which the centres move, or over that of all laws at which their compliance falls for
the first time; and at which it falls again: a stiff law that is not the one of the solution moves the impulses far away."""

SLOPE_RATIO, MAX_EXTENSION, MAX_TRIALS = 0.3, 16.0, 12
"""Line search: slope over the first one at which it ends, largest step, and number of trials."""

MAX_LAW_ITERATIONS, TRIAL_FACTOR = 30, 3.0
"""Newton steps on all laws at once after which the convex function is minimised; and impulse of the trial that decides which law acts, over
velocity and Delassus block."""

FIRST_PROXIMITY, MIN_PROXIMITY, MAX_PROXIMITY, PROXIMITY_FACTOR = 1e-2, 1e-4, 0.1, 0.1
"""Compliance against a change of the impulse in one step, over the Delassus block: at first, smallest, largest, and ratio of successive
ones."""

MAX_ERROR_RATIO, MIN_LENGTH, SHORT_LENGTH = 2.0, 0.1, 0.3
"""Ratio of successive squared errors above which a step is halved, length to which it is, and length below which the next step becomes more
compliant."""

STEP, FREE_VELOCITY, GRADIENT, INERTIA, FIRST_NEIGHBOUR = 0, 6, 12, 18, 27
WORK_COLUMNS = 28
"""A body's step of velocity and spin (6), velocity without impulses (6), gradient (6), inertia matrix in the ground's axes (9), and the
first body of its row in the factor."""


@kernel(_t.void(VECTOR, _t.int64, _t.int64, _t.int64), inline=True)
def _copy(row, source, target, count):
    for k in range(count):
        row[target + k] = row[source + k]


@kernel(_t.void(_t.int64, _t.int64, MATRIX, MATRIX, _t.boolean), inline=True)
def save_state(n, bodies, rows, velocities, restore):
    """Store velocities and impulses before a solution, or restore them."""
    for i in range(bodies):
        _copy(velocities[i], START_VELOCITY if restore else 0, 0 if restore else START_VELOCITY, 6)
    for i in range(n):
        _copy(rows[i], START_IMPULSE if restore else IMPULSE, IMPULSE if restore else START_IMPULSE, 3)


@kernel(_t.UniTuple(_t.float64, 5)(VECTOR, _t.float64, _t.float64, _t.float64, _t.boolean), inline=True)
def _penalty_impulse(row, u0, u1, u2, is_limit_held):
    """Return the impulse of a contact at a relative velocity, its normal part, and the ratio of friction to its trial value (1: sticks)."""
    n0, n1, n2, k, bound = row[NORMAL], row[NORMAL + 1], row[NORMAL + 2], row[PENALTY], row[MIN_NORMAL_VELOCITY]
    # a contact without a bound does not act in this step
    if bound == -math.inf:
        return 0.0, 0.0, 0.0, 0.0, 0.0
    y0, y1, y2 = (
        row[PENALTY_CENTRE] - k * (u0 - bound * n0),
        row[PENALTY_CENTRE + 1] - k * (u1 - bound * n1),
        row[PENALTY_CENTRE + 2] - k * (u2 - bound * n2),
    )
    normal = y0 * n0 + y1 * n1 + y2 * n2
    # a bilateral row may pull, and has no friction
    if row[BILATERAL] > 0.0:
        return normal * n0, normal * n1, normal * n2, normal, 0.0
    y0, y1, y2 = y0 - normal * n0, y1 - normal * n1, y2 - normal * n2
    normal = max(normal, 0.0)
    # with held limits the impulses have a potential; friction that follows the normal impulse has none, and no line
    # search would apply
    pressure = row[PRESSURE] if is_limit_held else normal
    s0, s1, s2 = pressure * row[CONE_CENTRE], pressure * row[CONE_CENTRE + 1], pressure * row[CONE_CENTRE + 2]
    y0, y1, y2 = y0 - s0, y1 - s1, y2 - s2
    size, limit = math.sqrt(y0 * y0 + y1 * y1 + y2 * y2), row[MU] * pressure
    # projection onto the disc of friction: the trial impulse is kept inside, and shortened outside
    ratio = limit / size if size > limit else 1.0 if pressure > 0.0 else 0.0
    return normal * n0 + s0 + ratio * y0, normal * n1 + s1 + ratio * y1, normal * n2 + s2 + ratio * y2, normal, ratio


@kernel(_t.void(_t.int64, _t.int64, _t.int64, VECTOR, _t.float64, _t.float64, _t.float64, MATRIX), inline=True)
def _subtract_impulse(a, b, ground, row, p0, p1, p2, work):
    """Subtract an impulse and its moments from the gradients of both bodies."""
    if a != ground:
        g, x, y, z = work[a], row[ARM_A], row[ARM_A + 1], row[ARM_A + 2]
        g[GRADIENT] -= p0
        g[GRADIENT + 1] -= p1
        g[GRADIENT + 2] -= p2
        g[GRADIENT + 3] -= y * p2 - z * p1
        g[GRADIENT + 4] -= z * p0 - x * p2
        g[GRADIENT + 5] -= x * p1 - y * p0
    if b != ground:
        g, x, y, z = work[b], row[ARM_B], row[ARM_B + 1], row[ARM_B + 2]
        g[GRADIENT] += p0
        g[GRADIENT + 1] += p1
        g[GRADIENT + 2] += p2
        g[GRADIENT + 3] += y * p2 - z * p1
        g[GRADIENT + 4] += z * p0 - x * p2
        g[GRADIENT + 5] += x * p1 - y * p0


@kernel(_t.void(_t.int64, MATRIX, MATRIX, MATRIX), inline=True)
def _momentum_gradient(bodies, inertias, velocities, work):
    """Start the gradient with the change of momentum since the velocities without impulses."""
    for i in range(bodies):
        g, v = work[i], velocities[i]
        for k in range(3):
            g[GRADIENT + k] = inertias[i, 0] * (v[k] - g[FREE_VELOCITY + k])
        w0, w1, w2 = v[3] - g[FREE_VELOCITY + 3], v[4] - g[FREE_VELOCITY + 4], v[5] - g[FREE_VELOCITY + 5]
        for k in range(3):
            g[GRADIENT + 3 + k] = g[INERTIA + 3 * k] * w0 + g[INERTIA + 3 * k + 1] * w1 + g[INERTIA + 3 * k + 2] * w2


@kernel(_t.void(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, MATRIX, MATRIX, MATRIX), inline=True)
def _begin(n, contact_ids, rows, ground, inertias, inverses, velocities, work):
    """Write free velocities, inertias and the envelope of the factor; the centres of the penalties are the impulses of the warm start."""
    # velocities without the impulses of the warm start
    apply_impulses(n, contact_ids, rows, ground, inertias, -1.0, velocities)
    for i in range(ground):
        g, j = work[i], inverses[i]
        for k in range(6):
            g[FREE_VELOCITY + k] = velocities[i, k]
        g[FIRST_NEIGHBOUR] = i
        # inverse of a symmetric matrix by cofactors
        c00, c01, c02 = j[4] * j[8] - j[5] * j[7], j[2] * j[7] - j[1] * j[8], j[1] * j[5] - j[2] * j[4]
        d = 1.0 / (j[0] * c00 + j[3] * c01 + j[6] * c02)
        g[INERTIA] = c00 * d
        g[INERTIA + 1] = c01 * d
        g[INERTIA + 2] = c02 * d
        g[INERTIA + 3] = c01 * d
        g[INERTIA + 4] = (j[0] * j[8] - j[2] * j[6]) * d
        g[INERTIA + 5] = (j[2] * j[3] - j[0] * j[5]) * d
        g[INERTIA + 6] = c02 * d
        g[INERTIA + 7] = g[INERTIA + 5]
        g[INERTIA + 8] = (j[0] * j[4] - j[1] * j[3]) * d
    apply_impulses(n, contact_ids, rows, ground, inertias, 1.0, velocities)
    for i in range(n):
        row, a, b = rows[i], contact_ids[i, 0], contact_ids[i, 1]
        for k in range(3):
            row[PENALTY_CENTRE + k] = row[IMPULSE + k]
        # the trace over 3 is the mean response of the contact to an impulse: the compliance is relative to it
        row[PENALTY] = 3.0 / (FIRST_COMPLIANCE * (row[W] + row[W + 4] + row[W + 8]))
        # a contact between two stones couples their rows; the factor fills the envelope from the first of these
        # columns on
        if a != ground and b != ground:
            last = max(a, b)
            work[last, FIRST_NEIGHBOUR] = min(work[last, FIRST_NEIGHBOUR], min(a, b))


@kernel(_t.UniTuple(_t.float64, 2)(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, MATRIX, MATRIX, MATRIX), inline=True)
def _errors(n, contact_ids, rows, ground, inertias, inverses, velocities, work):
    """Write the impulses of the velocities, and the change of the velocities by them as step; return both errors of the laws, m/s.

    The first is that change at the contacts, with friction limits that follow the normal impulses; the second is the velocity that the
    penalty leaves where a contact presses or sticks, or the approach of an open one.
    """
    _momentum_gradient(ground, inertias, velocities, work)
    penalty_error, change = 0.0, 0.0
    for i in range(n):
        row, a, b = rows[i], contact_ids[i, 0], contact_ids[i, 1]
        u0, u1, u2 = relative_velocity(a, b, row, velocities)
        u0, u1, u2 = u0 + row[ROTATION_BIAS], u1 + row[ROTATION_BIAS + 1], u2 + row[ROTATION_BIAS + 2]
        # here the limits follow the normal impulses: these are the laws that the solution must obey
        p0, p1, p2, normal, ratio = _penalty_impulse(row, u0, u1, u2, False)
        row[TRIAL_SLIP] = u0
        row[TRIAL_SLIP + 1] = u1
        row[TRIAL_SLIP + 2] = u2
        row[IMPULSE] = p0
        row[IMPULSE + 1] = p1
        row[IMPULSE + 2] = p2
        row[PRESSURE] = max(normal, 0.0)
        _subtract_impulse(a, b, ground, row, p0, p1, p2, work)
        bound = row[MIN_NORMAL_VELOCITY]
        if bound == -math.inf:
            continue
        normal_speed = u0 * row[NORMAL] + u1 * row[NORMAL + 1] + u2 * row[NORMAL + 2]
        # where a contact presses, the penalty leaves a velocity against the law; where it sticks, a slip
        if normal != 0.0:
            penalty_error = max(penalty_error, abs(normal_speed - bound))
            if ratio == 1.0:
                penalty_error = max(penalty_error, math.sqrt(max(u0 * u0 + u1 * u1 + u2 * u2 - normal_speed * normal_speed, 0.0)))
        else:
            penalty_error = max(penalty_error, bound - normal_speed)
    # the change of the velocities by the impulses, less what they have changed already: zero in the solution
    for i in range(ground):
        g, j = work[i], inverses[i]
        for k in range(3):
            g[STEP + k] = -g[GRADIENT + k] / inertias[i, 0]
            g[STEP + 3 + k] = -(j[3 * k] * g[GRADIENT + 3] + j[3 * k + 1] * g[GRADIENT + 4] + j[3 * k + 2] * g[GRADIENT + 5])
    for i in range(n):
        u0, u1, u2 = relative_velocity(contact_ids[i, 0], contact_ids[i, 1], rows[i], work)
        change = max(change, max(abs(u0), max(abs(u1), abs(u2))))
    return change, penalty_error


@kernel(_t.void(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, MATRIX, MATRIX))
def _linearise_penalties(n, contact_ids, rows, ground, inertias, velocities, work):
    """Write the gradient of the convex function at the velocities, and the slopes of the impulses, with the friction limits held."""
    _momentum_gradient(ground, inertias, velocities, work)
    for i in range(n):
        row = rows[i]
        p0, p1, p2, normal, ratio = _penalty_impulse(row, row[TRIAL_SLIP], row[TRIAL_SLIP + 1], row[TRIAL_SLIP + 2], True)
        _subtract_impulse(contact_ids[i, 0], contact_ids[i, 1], ground, row, p0, p1, p2, work)
        stiffness = row[PENALTY] if normal != 0.0 else 0.0
        for k in range(3):
            row[FORCE_SLOPE + k] = stiffness * row[NORMAL + k]
            row[SLIDING_DIRECTION + k] = 0.0
        row[SLIP_SLOPE] = ratio * row[PENALTY]
        # across the slip, friction turns with it; along it, the impulse is at its limit and does not change
        if 0.0 < ratio < 1.0:
            pressure = row[PRESSURE]
            d0, d1, d2 = (
                p0 - normal * row[NORMAL] - pressure * row[CONE_CENTRE],
                p1 - normal * row[NORMAL + 1] - pressure * row[CONE_CENTRE + 1],
                p2 - normal * row[NORMAL + 2] - pressure * row[CONE_CENTRE + 2],
            )
            size = math.sqrt(d0 * d0 + d1 * d1 + d2 * d2)
            row[SLIDING_DIRECTION] = d0 / size
            row[SLIDING_DIRECTION + 1] = d1 / size
            row[SLIDING_DIRECTION + 2] = d2 / size


@kernel(_t.float64(_t.float64, _t.int64, MATRIX), inline=True)
def _contact_slope(length, n, rows):
    """Return the part of the slope along the step that the contacts contribute."""
    slope = 0.0
    for i in range(n):
        row = rows[i]
        d0, d1, d2 = row[SLIP_CHANGE], row[SLIP_CHANGE + 1], row[SLIP_CHANGE + 2]
        p0, p1, p2, _, _ = _penalty_impulse(
            row, row[TRIAL_SLIP] + length * d0, row[TRIAL_SLIP + 1] + length * d1, row[TRIAL_SLIP + 2] + length * d2, True
        )
        slope -= p0 * d0 + p1 * d1 + p2 * d2
    return slope


@kernel(_t.float64(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, MATRIX, MATRIX))
def _step_length(n, contact_ids, rows, ground, inertias, velocities, work):
    """Return the length of the step at which the convex function has nearly stopped to fall."""
    constant, linear, first_slope = 0.0, 0.0, 0.0
    # the part of the inertia is linear in the length of the step; only that of the contacts bends
    for i in range(ground):
        g, v = work[i], velocities[i]
        for k in range(3):
            first_slope += g[GRADIENT + k] * g[STEP + k] + g[GRADIENT + 3 + k] * g[STEP + 3 + k]
            constant += inertias[i, 0] * g[STEP + k] * (v[k] - g[FREE_VELOCITY + k])
            linear += inertias[i, 0] * g[STEP + k] ** 2
            for m in range(3):
                x = g[INERTIA + 3 * k + m] * g[STEP + 3 + k]
                constant += x * (v[3 + m] - g[FREE_VELOCITY + 3 + m])
                linear += x * g[STEP + 3 + m]
    for i in range(n):
        row = rows[i]
        row[SLIP_CHANGE], row[SLIP_CHANGE + 1], row[SLIP_CHANGE + 2] = relative_velocity(contact_ids[i, 0], contact_ids[i, 1], row, work)
    low, high, low_slope = 0.0, 1.0, first_slope
    high_slope = constant + linear + _contact_slope(1.0, n, rows)
    # usually the active contacts have settled, and the full step is exact
    if abs(high_slope) <= SLOPE_RATIO * abs(first_slope):
        return 1.0
    # the slope rises along the step, as the function is convex: extend until it is positive, then bisect by false position
    while high_slope < 0.0:
        if high >= MAX_EXTENSION:
            return high
        low, low_slope, high = high, high_slope, 2.0 * high
        high_slope = constant + high * linear + _contact_slope(high, n, rows)
    length = high
    for _ in range(MAX_TRIALS):
        length = low + (high - low) * low_slope / (low_slope - high_slope)
        # kept off both ends: false position alone may stall at one of them
        length = min(max(length, low + 0.1 * (high - low)), high - 0.1 * (high - low))
        slope = constant + length * linear + _contact_slope(length, n, rows)
        if abs(slope) <= SLOPE_RATIO * abs(first_slope):
            break
        if slope < 0.0:
            low, low_slope = length, slope
        else:
            high, high_slope = length, slope
    return length


@kernel(_t.float64(VECTOR, _t.float64, _t.float64, _t.float64, _t.float64))
def _linearise(row, proximity, u0, u1, u2):
    """Write the projected impulse and the linearised law of a contact with a relative velocity; return the error of the law, m/s.

    A change dP of the impulse follows from the change du of the velocity, dP = R - (F n + s (1 - n n - d d)) du, where F is
    :data:`FORCE_SLOPE`, s :data:`SLIP_SLOPE`, R :data:`LAW_CHANGE`, and d the direction of the slip (derived here).
    The error is the velocity where the contact presses or sticks, or the approach of an open one.
    """
    n0, n1, n2, p0, p1, p2 = row[NORMAL], row[NORMAL + 1], row[NORMAL + 2], row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2]
    for m in range(3):
        row[FORCE_SLOPE + m] = 0.0
        row[SLIDING_DIRECTION + m] = 0.0
        row[PROJECTED + m] = 0.0
    row[SLIP_SLOPE] = 0.0
    row[LAW_CHANGE], row[LAW_CHANGE + 1], row[LAW_CHANGE + 2] = -p0, -p1, -p2
    bound, response = row[MIN_NORMAL_VELOCITY], (row[W] + row[W + 4] + row[W + 8]) / 3.0
    # a contact without a bound does not act in this step
    if bound == -math.inf:
        return 0.0
    u0, u1, u2 = u0 - bound * n0, u1 - bound * n1, u2 - bound * n2
    # the trial impulse decides which law acts: any positive factor has the same solution
    k, stiffness = TRIAL_FACTOR / response, 1.0 / (proximity * response)
    y0, y1, y2, speed, old_normal = p0 - k * u0, p1 - k * u1, p2 - k * u2, u0 * n0 + u1 * n1 + u2 * n2, p0 * n0 + p1 * n1 + p2 * n2
    normal, new_normal = old_normal - k * speed, old_normal - stiffness * speed
    if row[BILATERAL] > 0.0:
        for m in range(3):
            row[PROJECTED + m] = normal * row[NORMAL + m]
            row[FORCE_SLOPE + m] = stiffness * row[NORMAL + m]
            row[LAW_CHANGE + m] += new_normal * row[NORMAL + m]
        return abs(speed)
    if normal <= 0.0:
        return -speed
    s0, s1, s2 = n0 + row[CONE_CENTRE], n1 + row[CONE_CENTRE + 1], n2 + row[CONE_CENTRE + 2]
    y0, y1, y2, slip0, slip1, slip2 = (
        y0 - normal * s0,
        y1 - normal * s1,
        y2 - normal * s2,
        u0 - speed * n0,
        u1 - speed * n1,
        u2 - speed * n2,
    )
    size, limit = math.sqrt(y0 * y0 + y1 * y1 + y2 * y2), row[MU] * normal
    if size < limit:
        row[PROJECTED], row[PROJECTED + 1], row[PROJECTED + 2] = y0 + normal * s0, y1 + normal * s1, y2 + normal * s2
        row[LAW_CHANGE], row[LAW_CHANGE + 1], row[LAW_CHANGE + 2] = -stiffness * u0, -stiffness * u1, -stiffness * u2
        row[SLIP_SLOPE] = stiffness
        for m in range(3):
            row[FORCE_SLOPE + m] = stiffness * row[NORMAL + m]
        return max(abs(speed), math.sqrt(slip0 * slip0 + slip1 * slip1 + slip2 * slip2))
    if size > 0.0:
        y0, y1, y2 = y0 / size, y1 / size, y2 / size
    # friction turns with the slip, the more the slower that is: limit k / (size - limit) is the friction over the slip in the solution
    slope = 0.0 if limit == 0.0 else min(limit * k, stiffness * (size - limit)) / (size - limit) if size > limit else stiffness
    f0, f1, f2 = s0 + row[MU] * y0, s1 + row[MU] * y1, s2 + row[MU] * y2
    # across a slip that hardly exists, the friction changes from its last value, as where the point sticks
    kept = 1.0 if slope == stiffness else 0.0
    t0, t1, t2 = (
        kept * (p0 - old_normal * s0) - slope * slip0,
        kept * (p1 - old_normal * s1) - slope * slip1,
        kept * (p2 - old_normal * s2) - slope * slip2,
    )
    along = t0 * y0 + t1 * y1 + t2 * y2
    row[PROJECTED], row[PROJECTED + 1], row[PROJECTED + 2] = normal * f0, normal * f1, normal * f2
    row[FORCE_SLOPE], row[FORCE_SLOPE + 1], row[FORCE_SLOPE + 2] = stiffness * f0, stiffness * f1, stiffness * f2
    row[SLIDING_DIRECTION], row[SLIDING_DIRECTION + 1], row[SLIDING_DIRECTION + 2] = y0, y1, y2
    row[SLIP_SLOPE] = slope
    row[LAW_CHANGE] += new_normal * f0 + t0 - along * y0
    row[LAW_CHANGE + 1] += new_normal * f1 + t1 - along * y1
    row[LAW_CHANGE + 2] += new_normal * f2 + t2 - along * y2
    return abs(speed)


@kernel(_t.UniTuple(_t.float64, 3)(VECTOR, _t.float64, _t.float64, _t.float64), inline=True)
def _law_slope(row, u0, u1, u2):
    """Return the change of a contact's impulse, with the opposite sign, by a change of the relative velocity."""
    s, normal = row[SLIP_SLOPE], u0 * row[NORMAL] + u1 * row[NORMAL + 1] + u2 * row[NORMAL + 2]
    along = u0 * row[SLIDING_DIRECTION] + u1 * row[SLIDING_DIRECTION + 1] + u2 * row[SLIDING_DIRECTION + 2]
    return (
        row[FORCE_SLOPE] * normal + s * (u0 - normal * row[NORMAL] - along * row[SLIDING_DIRECTION]),
        row[FORCE_SLOPE + 1] * normal + s * (u1 - normal * row[NORMAL + 1] - along * row[SLIDING_DIRECTION + 1]),
        row[FORCE_SLOPE + 2] * normal + s * (u2 - normal * row[NORMAL + 2] - along * row[SLIDING_DIRECTION + 2]),
    )


@kernel(_t.void(VECTOR, _t.int64, VECTOR), inline=True)
def _add_law(row, arm, joint):
    """Add G^T A G to the block of a joint, for the velocity G = [1, -r x] of a point of one body and the slope A of its law."""
    x, y, z = row[arm], row[arm + 1], row[arm + 2]
    for j in range(6):
        # column j of G
        g0, g1, g2 = (
            1.0 if j == 0 else z if j == 4 else -y if j == 5 else 0.0,
            1.0 if j == 1 else -z if j == 3 else x if j == 5 else 0.0,
            1.0 if j == 2 else y if j == 3 else -x if j == 4 else 0.0,
        )
        a0, a1, a2 = _law_slope(row, g0, g1, g2)
        joint[j] += a0
        joint[6 + j] += a1
        joint[12 + j] += a2
        joint[18 + j] += y * a2 - z * a1
        joint[24 + j] += z * a0 - x * a2
        joint[30 + j] += x * a1 - y * a0


@kernel(_t.void(_t.int64, _t.int64, _t.int64, VECTOR, VECTOR, BLOCK))
def _add_joint(a, b, ground, row, joint, blocks):
    """Add the block K of the contacts of two bodies to the matrix, and clear it; K belongs to the second body, to the first on the ground.

    The arms of both bodies differ by the distance d of their centres, so that [1, -r_a x] = [1, -r_b x] T with T = [1, -d x; 0, 1].
    """
    awake = a if b == ground else b
    for k in range(36):
        blocks[awake, awake, k] += joint[k]
    if a != ground and b != ground:
        x, y, z = row[ARM_A] - row[ARM_B], row[ARM_A + 1] - row[ARM_B + 1], row[ARM_A + 2] - row[ARM_B + 2]
        low, high = min(a, b), max(a, b)
        # blocks below the diagonal are stored transposed; T^T K is the block of row a and column b
        for j in range(6):
            k0, k1, k2 = joint[j], joint[6 + j], joint[12 + j]
            for i in range(6):
                element = joint[6 * i + j] + (
                    y * k2 - z * k1 if i == 3 else z * k0 - x * k2 if i == 4 else x * k1 - y * k0 if i == 5 else 0.0
                )
                if a == low:
                    blocks[low, high, 6 * i + j] -= element
                else:
                    blocks[high, low, 6 * j + i] -= element
        # K T is that of row b and column a
        for i in range(6):
            k0, k1, k2 = joint[6 * i], joint[6 * i + 1], joint[6 * i + 2]
            joint[6 * i + 3] += k2 * y - k1 * z
            joint[6 * i + 4] += k0 * z - k2 * x
            joint[6 * i + 5] += k1 * x - k0 * y
            for j in range(6):
                if b == low:
                    blocks[low, high, 6 * i + j] -= joint[6 * i + j]
                else:
                    blocks[high, low, 6 * j + i] -= joint[6 * i + j]
        # T^T K T is that of the first body
        for j in range(6):
            k0, k1, k2 = joint[j], joint[6 + j], joint[12 + j]
            joint[18 + j] += y * k2 - z * k1
            joint[24 + j] += z * k0 - x * k2
            joint[30 + j] += x * k1 - y * k0
        for k in range(36):
            blocks[a, a, k] += joint[k]
    for k in range(36):
        joint[k] = 0.0


@kernel(_t.void(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, BLOCK, MATRIX))
def _assemble(n, contact_ids, rows, ground, inertias, blocks, work):
    """Write the matrix of the equations of momentum with the slopes of the impulses."""
    for i in range(ground):
        for j in range(int(work[i, FIRST_NEIGHBOUR]), i + 1):
            for k in range(36):
                blocks[j, i, k] = 0.0
                blocks[i, j, k] = 0.0
        for k in range(3):
            blocks[i, i, 7 * k] = inertias[i, 0]
            for m in range(3):
                blocks[i, i, 6 * (3 + k) + 3 + m] = work[i, INERTIA + 3 * k + m]
    # the block of the ground is not needed: it collects the contacts of two bodies
    joint, first, is_loaded = blocks[ground, ground], 0, False
    for k in range(36):
        joint[k] = 0.0
    for i in range(n):
        row, a, b = rows[i], contact_ids[i, 0], contact_ids[i, 1]
        if a != contact_ids[first, 0] or b != contact_ids[first, 1]:
            if is_loaded:
                _add_joint(contact_ids[first, 0], contact_ids[first, 1], ground, rows[first], joint, blocks)
            first, is_loaded = i, False
        if row[SLIP_SLOPE] != 0.0 or row[FORCE_SLOPE] != 0.0 or row[FORCE_SLOPE + 1] != 0.0 or row[FORCE_SLOPE + 2] != 0.0:
            _add_law(row, ARM_A if b == ground else ARM_B, joint)
            is_loaded = True
    if is_loaded:
        _add_joint(contact_ids[first, 0], contact_ids[first, 1], ground, rows[first], joint, blocks)


@kernel(_t.boolean(_t.int64, BLOCK, MATRIX))
def _factorise(bodies, blocks, work):
    """Replace the matrix by its factors L U within its envelope, L with a unit diagonal; return whether they exist.

    Blocks below the diagonal are stored transposed, and the diagonal of U is inverted.
    """
    for i in range(bodies):
        first = int(work[i, FIRST_NEIGHBOUR])
        for k in range(first, i):
            upper, lower, diagonal = blocks[k, i], blocks[i, k], blocks[k, k]
            # blocks before either envelope are zero
            for m in range(max(first, int(work[k, FIRST_NEIGHBOUR])), k):
                subtract_product(blocks[k, m], blocks[m, i], upper)
                subtract_product(blocks[m, k], blocks[i, m], lower)
            for r in range(6):
                for q in range(r):
                    x, y = diagonal[6 * r + q], diagonal[6 * q + r]
                    subtract_row(x, upper, 6 * q, upper, 6 * r)
                    subtract_row(y, lower, 6 * q, lower, 6 * r)
                for j in range(6):
                    lower[6 * r + j] *= diagonal[7 * r]
            subtract_product(lower, upper, blocks[i, i])
        block = blocks[i, i]
        for r in range(6):
            # strong friction may leave negative pivots; zero, or NaN after an overflow, has no inverse
            if not abs(block[7 * r]) > 0.0:
                return False
            block[7 * r] = 1.0 / block[7 * r]
            for q in range(r + 1, 6):
                block[6 * q + r] *= block[7 * r]
                for j in range(r + 1, 6):
                    block[6 * q + j] -= block[6 * q + r] * block[6 * r + j]
    return True


@kernel(_t.void(_t.int64, BLOCK, MATRIX))
def _newton_step(bodies, blocks, work):
    """Solve for the step against the gradient by forward and back substitution."""
    for i in range(bodies):
        x, block = work[i], blocks[i, i]
        for k in range(6):
            x[STEP + k] = -x[GRADIENT + k]
        for k in range(int(x[FIRST_NEIGHBOUR]), i):
            lower, y = blocks[i, k], work[k]
            for r in range(6):
                for j in range(6):
                    x[STEP + j] -= lower[6 * r + j] * y[STEP + r]
        for r in range(6):
            for j in range(r):
                x[STEP + r] -= block[6 * r + j] * x[STEP + j]
    for i in range(bodies - 1, -1, -1):
        x, block = work[i], blocks[i, i]
        for r in range(5, -1, -1):
            for j in range(r + 1, 6):
                x[STEP + r] -= block[6 * r + j] * x[STEP + j]
            x[STEP + r] *= block[7 * r]
        for k in range(int(x[FIRST_NEIGHBOUR]), i):
            upper, y = blocks[k, i], work[k]
            for r in range(6):
                for j in range(6):
                    y[STEP + r] -= upper[6 * r + j] * x[STEP + j]


@kernel(_t.int64(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, _t.float64, MATRIX, BLOCK, MATRIX))
def _solve_laws(n, contact_ids, rows, ground, inertias, tolerance, velocities, blocks, work):
    """Solve the contact laws by Newton's method on all of them at once; return the number of steps, or 0 without a solution.

    Without a solution the impulses are those of the last step, if they obey the laws better than the first ones, else the first ones.
    """
    save_state(n, ground, rows, velocities, False)
    proximity, max_change, first_error, last_error, length, iterations = FIRST_PROXIMITY, math.inf, math.inf, math.inf, 1.0, 0
    refinements, target = 0, FINE_ACCURACY * tolerance
    while True:
        law_error, change, error = 0.0, 0.0, 0.0
        for i in range(ground):
            for k in range(6):
                work[i, STEP + k] = 0.0
        for i in range(n):
            row, a, b = rows[i], contact_ids[i, 0], contact_ids[i, 1]
            u0, u1, u2 = relative_velocity(a, b, row, velocities)
            law_error = max(
                law_error, _linearise(row, proximity, u0 + row[ROTATION_BIAS], u1 + row[ROTATION_BIAS + 1], u2 + row[ROTATION_BIAS + 2])
            )
            p0, p1, p2 = row[PROJECTED] - row[IMPULSE], row[PROJECTED + 1] - row[IMPULSE + 1], row[PROJECTED + 2] - row[IMPULSE + 2]
            # an open contact without an impulse
            if p0 != 0.0 or p1 != 0.0 or p2 != 0.0:
                error += (row[W] + row[W + 4] + row[W + 8]) * (p0 * p0 + p1 * p1 + p2 * p2)
                apply_impulse(a, b, ground, inertias, row, p0, p1, p2, work)
        for i in range(n):
            u0, u1, u2 = relative_velocity(contact_ids[i, 0], contact_ids[i, 1], rows[i], work)
            change = max(change, max(abs(u0), max(abs(u1), abs(u2))))
        if max(change, law_error) < ACCURACY * tolerance:
            refinements += 1
        if max(change, law_error) < (target if refinements <= MAX_REFINEMENTS else ACCURACY * tolerance):
            # impulses that obey the cones exactly, with the velocities that belong to them
            for i in range(ground):
                for k in range(6):
                    velocities[i, k] += work[i, STEP + k]
            for i in range(n):
                for k in range(3):
                    rows[i, IMPULSE + k] = rows[i, PROJECTED + k]
            return iterations + 1
        if iterations == 0:
            max_change, first_error = MAX_GROWTH * max(change, tolerance), error
        # growing errors, or NaN
        if not change < max_change:
            last_error = math.inf
            break
        # the error has grown, as laws that act change to and fro: half of the step is taken back
        if error > MAX_ERROR_RATIO * last_error and length > MIN_LENGTH:
            length *= 0.5
            for i in range(n):
                row = rows[i]
                p0, p1, p2 = -length * row[LAW_STEP], -length * row[LAW_STEP + 1], -length * row[LAW_STEP + 2]
                row[IMPULSE] += p0
                row[IMPULSE + 1] += p1
                row[IMPULSE + 2] += p2
                apply_impulse(contact_ids[i, 0], contact_ids[i, 1], ground, inertias, row, p0, p1, p2, velocities)
            continue
        factor, ratio = 1.0, LAW_RATIO if proximity < 0.5 * FIRST_PROXIMITY else MOVE_RATIO
        # the laws that act have settled: what is left is the velocity that the proximity leaves
        if (
            length == 1.0
            and law_error > (target if refinements > 0 else ACCURACY * tolerance)
            and change < ratio * law_error
            and proximity > MIN_PROXIMITY
        ):
            factor = PROXIMITY_FACTOR
        elif length < SHORT_LENGTH and proximity < MAX_PROXIMITY:
            factor = 1.0 / PROXIMITY_FACTOR
        if factor != 1.0:
            proximity *= factor
            for i in range(n):
                row = rows[i]
                u0, u1, u2 = relative_velocity(contact_ids[i, 0], contact_ids[i, 1], row, velocities)
                _linearise(row, proximity, u0 + row[ROTATION_BIAS], u1 + row[ROTATION_BIAS + 1], u2 + row[ROTATION_BIAS + 2])
        last_error, length, iterations = error, 1.0, iterations + 1
        if iterations > MAX_LAW_ITERATIONS:
            break
        for i in range(ground):
            for k in range(6):
                work[i, GRADIENT + k] = 0.0
        for i in range(n):
            p0, p1, p2 = rows[i, LAW_CHANGE], rows[i, LAW_CHANGE + 1], rows[i, LAW_CHANGE + 2]
            _subtract_impulse(contact_ids[i, 0], contact_ids[i, 1], ground, rows[i], p0, p1, p2, work)
        _assemble(n, contact_ids, rows, ground, inertias, blocks, work)
        if not _factorise(ground, blocks, work):
            break
        _newton_step(ground, blocks, work)
        for i in range(n):
            row, a, b = rows[i], contact_ids[i, 0], contact_ids[i, 1]
            u0, u1, u2 = relative_velocity(a, b, row, work)
            u0, u1, u2 = _law_slope(row, u0, u1, u2)
            row[LAW_STEP] = row[LAW_CHANGE] - u0
            row[LAW_STEP + 1] = row[LAW_CHANGE + 1] - u1
            row[LAW_STEP + 2] = row[LAW_CHANGE + 2] - u2
            for k in range(3):
                row[IMPULSE + k] += row[LAW_STEP + k]
            apply_impulse(a, b, ground, inertias, row, row[LAW_STEP], row[LAW_STEP + 1], row[LAW_STEP + 2], velocities)
    if not last_error < first_error:
        save_state(n, ground, rows, velocities, True)
    return 0


@kernel(_t.int64(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, MATRIX, _t.float64, MATRIX, BLOCK, MATRIX))
def solve_newton(n, contact_ids, rows, ground, inertias, inverses, tolerance, velocities, blocks, work):
    """Solve the impulses of `n` contacts; return the number of Newton steps, or 0 without a solution.

    Parameters
    ----------
    contact_ids, rows, velocities : arrays
        As in :func:`~seisblock.models.stack.pgs.solve_pgs`.
    tolerance : float, m/s
    blocks, work : (m + 1, m + 1, 36), (m + 1, 28) arrays
        Scratch: blocks of the matrix, and rows of the bodies.
    """
    _begin(n, contact_ids, rows, ground, inertias, inverses, velocities, work)
    iterations = _solve_laws(n, contact_ids, rows, ground, inertias, tolerance, velocities, blocks, work)
    if iterations > 0:
        return iterations
    _begin(n, contact_ids, rows, ground, inertias, inverses, velocities, work)
    compliance, since_move, has_stalled, max_change = FIRST_COMPLIANCE, 0, False, math.inf
    for iteration in range(MAX_ITERATIONS):
        change, penalty_error = _errors(n, contact_ids, rows, ground, inertias, inverses, velocities, work)
        if max(change, penalty_error) < ACCURACY * tolerance:
            # velocities that belong to the impulses exactly: momentum holds whatever is left of the error
            for i in range(ground):
                for k in range(6):
                    velocities[i, k] += work[i, STEP + k]
            return iteration + 1
        if iteration == 0:
            max_change = MAX_GROWTH * max(change, tolerance)
        # growing errors, or NaN
        if not change < max_change:
            return 0
        # the penalty is what is left: only a move of the centres reduces it
        factor, moves = 1.0, ACCURACY * tolerance < penalty_error and change < MOVE_RATIO * penalty_error
        if moves and (not has_stalled or since_move <= EASY_ITERATIONS):
            factor = max(COMPLIANCE_FACTOR, MIN_COMPLIANCE / compliance)
        elif not moves and since_move >= STALLED_ITERATIONS and compliance < MAX_COMPLIANCE:
            factor, has_stalled = SOFTENING, True
        if moves or factor != 1.0:
            compliance *= factor
            since_move = 0
            for i in range(n):
                row = rows[i]
                if moves:
                    for k in range(3):
                        row[PENALTY_CENTRE + k] = row[IMPULSE + k]
                row[PENALTY] /= factor
                # the centres have moved: the limits of the next iteration follow from them
                _, _, _, normal, _ = _penalty_impulse(row, row[TRIAL_SLIP], row[TRIAL_SLIP + 1], row[TRIAL_SLIP + 2], False)
                row[PRESSURE] = max(normal, 0.0)
        since_move += 1
        _linearise_penalties(n, contact_ids, rows, ground, inertias, velocities, work)
        _assemble(n, contact_ids, rows, ground, inertias, blocks, work)
        if not _factorise(ground, blocks, work):
            return 0
        _newton_step(ground, blocks, work)
        length = _step_length(n, contact_ids, rows, ground, inertias, velocities, work)
        # the step ends where the convex function has nearly its minimum, which excludes a cycle of active sets
        for i in range(ground):
            for k in range(6):
                velocities[i, k] += length * work[i, STEP + k]
    return 0
