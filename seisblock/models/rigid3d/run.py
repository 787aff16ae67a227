"""Time integration of a rigid body on the ground: rest, steps split at impacts, and the ledger of energy."""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.core.status import NOT_FINITE, PAUSED, RECORD_ENDED, STOPPED
from seisblock.dynamics.array_types import MATRIX, READ_ONLY_MATRIX
from seisblock.models.rigid3d.buffers import (
    ALPHA,
    AT_REST,
    BASE_HEIGHT,
    BODY,
    CREATED,
    DISSIPATED,
    EDGES,
    GAP,
    GRAVITY,
    IMPACTS,
    LIFT_TIME,
    MASS,
    MAX_DISTANCE,
    MAX_TILT,
    MU,
    NEAR,
    OVERTURNING_TIME,
    PAST_BASE,
    PATH,
    RATE,
    REST_TIME,
    SAMPLE,
    SCRATCH,
    SIZE,
    SPEED,
    START_X,
    STATE_SIZE,
    UNCONVERGED,
    UP_X,
    UP_Y,
    WORK,
    Q,
    V,
    W,
    X,
)
from seisblock.models.rigid3d.step import (
    end_contacts,
    find_contacts,
    list_near,
    mechanical_energy,
    midpoint_step,
    resolve_impact,
    update_heights,
)

_t = types()

MAX_ANGLE = 0.01
"""Largest rotation, and largest phase of rocking, per step, rad. Contacts lift, stick and slip within a step, an error of first order."""

MAX_IMPACTS = 64
"""Impacts per interval of the record after which the rest of the interval is stepped with all near vertices as contacts; ends of slips per
interval at which steps end."""

MAX_ROOT_STEPS = 60

MIN_SHARE = 1e-3
"""Shortest step that is tried where the solution of a step does not converge, a share of it."""

MAX_SLIP_STEPS, SLIP_SHARE = 8, 0.98
"""Attempts to end a step where a slip ends, and share of a step from which on that is its end."""

NEAR_SHARE = 0.02
"""Height up to which vertices are followed while none has moved as far, a share of the size of the body."""


@kernel(_t.boolean(_t.float64, _t.float64, _t.float64, _t.float64, BODY, SCRATCH))
def _stays(a0, a1, a2, z, body, scratch):
    """Return whether a body at rest stays so under an acceleration of the ground (vertical with gravity): friction and pressure centre.

    Both conditions are linear or convex in the acceleration: if they hold at two samples, they hold between them.
    """
    mu = body.constants[MU]
    # sliding, or a ground that falls away from the body
    if not (a2 > 0.0 and a0 * a0 + a1 * a1 <= mu * mu * a2 * a2):
        return False
    for k in range(scratch.counters[EDGES]):
        # the resultant points along -a: it meets the ground at -z a/a2 from the point below the centre
        if -z * (a0 * scratch.support[k, 0] + a1 * scratch.support[k, 1]) > a2 * scratch.support[k, 2]:
            return False
    return True


@kernel(_t.boolean(_t.int64, BODY, SCRATCH))
def _find_support(count, body, scratch):
    """Write the edges of the polygon of the vertices in `ids`, and return whether it contains the centre of gravity.

    An edge joins two vertices with all others on its left.
    """
    r, points, edges = scratch.rotation, scratch.contacts, 0
    for k in range(count):
        i = scratch.ids[k]
        x, y, z = body.vertices[0, i], body.vertices[1, i], body.vertices[2, i]
        points[k, 0] = r[0] * x + r[1] * y + r[2] * z
        points[k, 1] = r[3] * x + r[4] * y + r[5] * z
    tolerance = 1e-9 * body.constants[SIZE]
    for k in range(count):
        best, best_length, is_edge = -1, 0.0, False
        # the neighbour of k in the direction that leaves no vertex on the right
        # few vertices touch at once: the search over pairs needs no sorting
        for j in range(count):
            dx, dy = points[j, 0] - points[k, 0], points[j, 1] - points[k, 1]
            length = math.sqrt(dx * dx + dy * dy)
            if length <= tolerance:
                continue
            is_edge = True
            for i in range(count):
                if dx * (points[i, 1] - points[k, 1]) - dy * (points[i, 0] - points[k, 0]) < -tolerance * length:
                    is_edge = False
                    break
            # of vertices in line with the edge the farthest one ends it
            if is_edge and length > best_length:
                best, best_length = j, length
        if best < 0:
            continue
        dx, dy = points[best, 0] - points[k, 0], points[best, 1] - points[k, 1]
        # outward normal: all vertices lie on the left of the edge
        n0, n1 = dy / best_length, -dx / best_length
        if edges < scratch.support.shape[0]:
            scratch.support[edges, 0], scratch.support[edges, 1] = n0, n1
            scratch.support[edges, 2] = n0 * points[k, 0] + n1 * points[k, 1]
            # distance of the edge from the point below the centre of gravity; not positive where that point lies
            # outside the base
            if not scratch.support[edges, 2] > 0.0:
                return False
            edges += 1
    scratch.counters[EDGES] = edges
    return edges >= 3


@kernel(_t.void(_t.float64, _t.boolean, _t.int64, BODY, SCRATCH))
def _track(time, has_landed, count, body, scratch):
    """Update the largest tilt and distance, and whether and when the body overturned, from state and rotation matrix."""
    y, r, ledger, c, counters = scratch.state, scratch.rotation, scratch.ledger, body.constants, scratch.counters
    tilt = math.atan2(math.sqrt(r[2] * r[2] + r[5] * r[5]), r[8])
    ledger[MAX_TILT] = max(ledger[MAX_TILT], tilt)
    distance = (y[X] - ledger[START_X]) ** 2 + (y[X + 1] - ledger[START_X + 1]) ** 2
    ledger[MAX_DISTANCE] = max(ledger[MAX_DISTANCE], math.sqrt(distance))
    # point of the base's plane below the centre of gravity, in the body's axes
    past = r[8] <= 0.0
    if not past:
        p0, p1 = -r[6] / r[8] * c[BASE_HEIGHT], -r[7] / r[8] * c[BASE_HEIGHT]
        for k in range(body.base.shape[0]):
            if body.base[k, 0] * p0 + body.base[k, 1] * p1 > body.base[k, 2]:
                past = True
                break
    counters[PAST_BASE] = 1 if past else 0
    # back over its base, the body has not overturned, however far it leant
    if not past:
        ledger[OVERTURNING_TIME] = math.nan
    elif math.isnan(ledger[OVERTURNING_TIME]):
        landed = r[8] <= 0.0
        # overturned when something else than the base touches the ground, or beyond 90 degrees
        if has_landed:
            for k in range(count):
                if not body.is_base[scratch.ids[k]]:
                    landed = True
        if landed:
            ledger[OVERTURNING_TIME] = time
            ledger[UP_X], ledger[UP_Y] = r[2], r[5]


@kernel(_t.float64(BODY, SCRATCH))
def _clearance(body, scratch):
    """Return the smallest height of the vertices of `trial` that are not in contact, above a quarter of the touching gap, m."""
    y, vertices = scratch.trial, body.vertices
    a, b, c, d = y[Q], y[Q + 1], y[Q + 2], y[Q + 3]
    r0, r1, r2 = 2.0 * (b * d - a * c), 2.0 * (c * d + a * b), a * a - b * b - c * c + d * d
    lowest, touching = math.inf, body.constants[GAP]
    for k in range(scratch.counters[NEAR]):
        i = scratch.near[k]
        height = y[X + 2] + (r0 * vertices[0, i] + r1 * vertices[1, i] + r2 * vertices[2, i])
        if height < lowest and scratch.heights[i] > touching:
            lowest = height
    return lowest - 0.25 * touching


@kernel(_t.float64(SCRATCH, BODY))
def _path(scratch, body):
    """Return a bound of the path of any vertex from the state to `trial`, m: translation and chord of the rotation."""
    y, z = scratch.state, scratch.trial
    translation, chord = 0.0, 0.0
    for i in range(3):
        translation += (z[X + i] - y[X + i]) ** 2
    for i in range(4):
        chord += (z[Q + i] - y[Q + i]) ** 2
    # the angle is 4 asin(|dq|/2) <= pi |dq|
    return math.sqrt(translation) + math.pi * math.sqrt(chord) * body.constants[SIZE]


@kernel(_t.float64(READ_ONLY_MATRIX, _t.int64, _t.int64, _t.float64), inline=True)
def _ground(motion, row, s, fraction):
    """Return an acceleration of the ground at a fraction of an interval; the ground is at rest after the record."""
    if s + 1 >= motion.shape[1]:
        return 0.0
    return motion[row, s] + fraction * (motion[row, s + 1] - motion[row, s])


@kernel(_t.boolean(READ_ONLY_MATRIX, _t.float64, _t.int64, _t.float64, _t.float64, _t.int64, BODY, SCRATCH))
def _try_step(motion, dt, s, t, size, count, body, scratch):
    """Step from a time within interval `s` into `trial`; return whether the solution converged."""
    # the record is linear between samples, so that the value at the middle is the mean over the step
    fraction = (t + 0.5 * size) / dt
    a0, a1, a2 = _ground(motion, 0, s, fraction), _ground(motion, 1, s, fraction), _ground(motion, 2, s, fraction)
    return midpoint_step(scratch.state, size, a0, a1, a2 + body.constants[GRAVITY], count, body, scratch)


@kernel(_t.float64(_t.int64, BODY, SCRATCH))
def _share_of_slip(count, body, scratch):
    """Return the share of a step after which the first of the slips of its contacts ends, 1 without an end."""
    y, trial, r, vertices = scratch.state, scratch.trial, scratch.rotation, body.vertices
    limit, first = body.constants[SPEED] ** 2, 1.0
    # spins in the ground's axes; the rotation of a step is small
    a0 = r[0] * y[W] + r[1] * y[W + 1] + r[2] * y[W + 2]
    a1 = r[3] * y[W] + r[4] * y[W + 1] + r[5] * y[W + 2]
    a2 = r[6] * y[W] + r[7] * y[W + 1] + r[8] * y[W + 2]
    b0 = r[0] * trial[W] + r[1] * trial[W + 1] + r[2] * trial[W + 2]
    b1 = r[3] * trial[W] + r[4] * trial[W + 1] + r[5] * trial[W + 2]
    b2 = r[6] * trial[W] + r[7] * trial[W + 1] + r[8] * trial[W + 2]
    for k in range(count):
        i = scratch.ids[k]
        x, y_, z = vertices[0, i], vertices[1, i], vertices[2, i]
        x0, x1, x2 = r[0] * x + r[1] * y_ + r[2] * z, r[3] * x + r[4] * y_ + r[5] * z, r[6] * x + r[7] * y_ + r[8] * z
        u0, u1 = y[V] + a1 * x2 - a2 * x1, y[V + 1] + a2 * x0 - a0 * x2
        # the arm of a contact is the mean of those at both ends
        x0, x1, x2 = 2.0 * scratch.contacts[k, 0] - x0, 2.0 * scratch.contacts[k, 1] - x1, 2.0 * scratch.contacts[k, 2] - x2
        product = u0 * (trial[V] + b1 * x2 - b2 * x1) + u1 * (trial[V + 1] + b2 * x0 - b0 * x2)
        squared = u0 * u0 + u1 * u1
        if squared > limit and product < 0.0:
            first = min(first, squared / (squared - product))
    return first


@kernel(_t.boolean(READ_ONLY_MATRIX, _t.float64, _t.int64, _t.float64, BODY, SCRATCH))
def _advance(motion, dt, s, start, body, scratch):
    """Advance the state from a time within interval `s` to its end; return whether the state is finite."""
    y, trial, c, ledger, counters = scratch.state, scratch.trial, body.constants, scratch.ledger, scratch.counters
    t, impacts, turns, touching, margin = start, 0, 0, c[GAP], NEAR_SHARE * c[SIZE]
    list_near(y, margin, body, scratch)
    while t < dt:
        spin = math.sqrt(y[W] * y[W] + y[W + 1] * y[W + 1] + y[W + 2] * y[W + 2])
        # a step may neither turn the body by much nor exceed a small part of a rocking period
        parts = math.ceil((dt - t) * max(spin, c[RATE]) / MAX_ANGLE)
        h = (dt - t) / max(parts, 1.0)
        capped = impacts >= MAX_IMPACTS
        reach = touching
        # too many impacts within one interval: whatever could reach the ground during the step becomes a contact of
        # it
        if capped:
            reach += h * (abs(y[V + 2]) + (spin + h * c[RATE] * c[RATE]) * c[SIZE] + h * 3.0 * c[GRAVITY])
            list_near(y, math.inf, body, scratch)
        count = find_contacts(reach, scratch)
        energy = mechanical_energy(y, body)
        struck = False
        low, low_value, high, high_value = 0.0, 0.0, h, 0.0
        size = h
        solved = _try_step(motion, dt, s, t, size, count, body, scratch)
        # with much friction the solution can jump between sticking and slipping; shorter steps find one
        while not solved and size > MIN_SHARE * h:
            size *= 0.5
            solved = _try_step(motion, dt, s, t, size, count, body, scratch)
        # a slip that ends or turns within the step has friction of two directions or kinds: the step ends there
        for attempt in range(MAX_SLIP_STEPS if solved and not capped and turns < MAX_IMPACTS else 0):
            share = _share_of_slip(count, body, scratch)
            if share > SLIP_SHARE or size <= MIN_SHARE * h:
                break
            turns += attempt == 0
            shorter = max(share * size, MIN_SHARE * h)
            if not _try_step(motion, dt, s, t, shorter, count, body, scratch):
                solved = _try_step(motion, dt, s, t, size, count, body, scratch)
                break
            size = shorter
        shortened = size < h
        high = size
        for attempt in range(MAX_ROOT_STEPS):
            if attempt > 0:
                solved = _try_step(motion, dt, s, t, size, count, body, scratch)
            if capped:
                break
            if attempt == 0:
                path = _path(scratch, body)
                if ledger[PATH] + path > margin:
                    # vertices that were far away may reach the ground
                    list_near(y, margin if path <= margin else math.inf, body, scratch)
            value = _clearance(body, scratch)
            if attempt == 0:
                # no free vertex has come below the ground
                if value >= -0.25 * touching:
                    break
                struck = True
                high_value = value
                # the root lies between the present heights and those at the end of the step
                low_value = math.inf
                for k in range(scratch.counters[NEAR]):
                    i = scratch.near[k]
                    if scratch.heights[i] > touching:
                        low_value = min(low_value, scratch.heights[i] - 0.25 * touching)
            elif abs(value) <= 0.25 * touching or attempt == MAX_ROOT_STEPS - 1:
                break
            elif value > 0.0:
                # Illinois: halve the value of an end that stays
                if attempt % 2 == 0:
                    high_value *= 0.5
                low, low_value = size, value
            else:
                if attempt % 2 == 0:
                    low_value *= 0.5
                high, high_value = size, value
            size = low + (high - low) * low_value / (low_value - high_value)
            # Illinois' method slows down where the height is far from linear in the step
            if attempt > 20:
                size = 0.5 * (low + high)
            # the height jumps with the length of the step where a contact ceases to stick: end above the ground
            if attempt == MAX_ROOT_STEPS - 2 and low > 0.0:
                size = low
        ledger[PATH] += _path(scratch, body)
        # work of the inertia forces alone; gravity is in the potential energy
        fraction = (t + 0.5 * size) / dt
        a0, a1, a2 = _ground(motion, 0, s, fraction), _ground(motion, 1, s, fraction), _ground(motion, 2, s, fraction)
        work = -c[MASS] * (a0 * (trial[X] - y[X]) + a1 * (trial[X + 1] - y[X + 1]) + a2 * (trial[X + 2] - y[X + 2]))
        for i in range(STATE_SIZE):
            y[i] = trial[i]
        # exactly the end of the interval, without accumulated round-off
        t = t + size if struck or shortened or size < dt - t else dt
        update_heights(y, body, scratch)
        # the mean velocity of a contact vanishes, which leaves its end velocity opposite to that at the start
        if count > 0:
            solved = end_contacts(y, count, body, scratch) and solved
        count = find_contacts(touching, scratch)
        # vertices that touch and still approach are stopped, by a plastic impact unless one has just struck
        if count > 0:
            solved = resolve_impact(y, count, struck, body, scratch) and solved
        change = mechanical_energy(y, body) - energy - work
        ledger[WORK] += work
        # contacts and impacts only dissipate; what they create is an error, which the result reports
        if change > 0.0:
            ledger[CREATED] += change
        else:
            ledger[DISSIPATED] -= change
        if not solved:
            ledger[UNCONVERGED] += 1.0
        if struck:
            impacts += 1
            ledger[IMPACTS] += 1.0
            # the impact has changed the spin: the last angular acceleration predicts nothing
            y[ALPHA], y[ALPHA + 1], y[ALPHA + 2] = 0.0, 0.0, 0.0
        _track(s * dt + t, struck, count, body, scratch)
        if not math.isfinite(y[X + 2] + y[Q] + y[V] + y[W]):
            return False
        # rest needs a polygon of support
        if count >= 3:
            squared = y[V] * y[V] + y[V + 1] * y[V + 1] + y[V + 2] * y[V + 2]
            # the spin counts with the speed of the farthest vertex
            squared += (y[W] * y[W] + y[W + 1] * y[W + 1] + y[W + 2] * y[W + 2]) * c[SIZE] * c[SIZE]
            if squared <= c[SPEED] * c[SPEED] and _find_support(count, body, scratch):
                fraction = t / dt
                a0, a1, a2 = _ground(motion, 0, s, fraction), _ground(motion, 1, s, fraction), _ground(motion, 2, s, fraction)
                if _stays(a0, a1, a2 + c[GRAVITY], y[X + 2], body, scratch):
                    for i in range(3):
                        y[V + i], y[W + i], y[ALPHA + i] = 0.0, 0.0, 0.0
                    counters[AT_REST] = 1
                    ledger[REST_TIME] = s * dt + t
                    # nothing moves a body at rest after the record
                    if s + 1 >= motion.shape[1]:
                        return True
                    t = _rest_until(motion, dt, s, t, body, scratch)
    return True


@kernel(_t.float64(READ_ONLY_MATRIX, _t.float64, _t.int64, _t.float64, BODY, SCRATCH))
def _rest_until(motion, dt, s, start, body, scratch):
    """Return the time within interval `s` until which a body at rest stays, `dt` if to its end; clear `AT_REST` if it starts to move."""
    c, z = body.constants, scratch.state[X + 2]
    g = c[GRAVITY]
    # the conditions are convex: holding at both ends, they hold in between
    if _stays(_ground(motion, 0, s, 1.0), _ground(motion, 1, s, 1.0), _ground(motion, 2, s, 1.0) + g, z, body, scratch):
        return dt
    low, high = start / dt, 1.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        if _stays(_ground(motion, 0, s, middle), _ground(motion, 1, s, middle), _ground(motion, 2, s, middle) + g, z, body, scratch):
            low = middle
        else:
            high = middle
    scratch.counters[AT_REST] = 0
    if math.isnan(scratch.ledger[LIFT_TIME]):
        scratch.ledger[LIFT_TIME] = (s + low) * dt
    return low * dt


@kernel(_t.void(BODY, SCRATCH))
def start_run(body, scratch):
    """Prepare a run from the state in `scratch`: contacts, initial impact, rest."""
    y, ledger, c = scratch.state, scratch.ledger, body.constants
    list_near(y, math.inf, body, scratch)
    count = find_contacts(c[GAP], scratch)
    squared = y[V] * y[V] + y[V + 1] * y[V + 1] + y[V + 2] * y[V + 2] + y[W] * y[W] + y[W + 1] * y[W + 1] + y[W + 2] * y[W + 2]
    scratch.counters[AT_REST] = 0
    if squared == 0.0 and count >= 3 and _find_support(count, body, scratch):
        scratch.counters[AT_REST] = 1
        ledger[REST_TIME] = 0.0
    # a body that starts with a velocity into the ground begins with an impact
    elif count > 0 and squared > 0.0:
        energy = mechanical_energy(y, body)
        resolve_impact(y, count, True, body, scratch)
        change = mechanical_energy(y, body) - energy
        if change > 0.0:
            ledger[CREATED] += change
        else:
            ledger[DISSIPATED] -= change
    _track(0.0, False, count, body, scratch)


@kernel(_t.int64(READ_ONLY_MATRIX, _t.float64, _t.int64, _t.int64, BODY, SCRATCH, MATRIX))
def run_rigid3d(motion, dt, last, budget, body, scratch, rows):
    """Integrate a body through a motion and on until it rests; return a status.

    Parameters
    ----------
    motion : (3, n) array, m/s^2
        Ground acceleration along, across, up.
    dt : float, s
    last : int
        Index of the last interval, counted on beyond the record.
    budget : int
        Intervals after which the loop pauses.
    body, scratch : named tuples
    rows : (n, 7) array
        Centre of gravity and quaternion at each sample; an array without rows stores nothing.
    """
    counters, y = scratch.counters, scratch.state
    samples, g = motion.shape[1], body.constants[GRAVITY]
    for _ in range(budget):
        s = counters[SAMPLE]
        if s < rows.shape[0]:
            for i in range(7):
                rows[s, i] = y[i]
        if s >= samples - 1 and counters[AT_REST] == 1:
            # the ground stops, perhaps at once
            if _stays(0.0, 0.0, g, y[X + 2], body, scratch):
                return RECORD_ENDED
            counters[AT_REST] = 0
        # the limit serves bodies that never come to rest, such as a rolling ball
        if s >= last:
            return STOPPED
        start = 0.0
        if counters[AT_REST] == 1:
            a0, a1, a2 = motion[0, s], motion[1, s], motion[2, s] + g
            if _stays(a0, a1, a2, y[X + 2], body, scratch):
                start = _rest_until(motion, dt, s, 0.0, body, scratch)
            else:
                counters[AT_REST] = 0
                if math.isnan(scratch.ledger[LIFT_TIME]):
                    scratch.ledger[LIFT_TIME] = s * dt
        if counters[AT_REST] == 0 and not _advance(motion, dt, s, start, body, scratch):
            return NOT_FINITE
        counters[SAMPLE] = s + 1
    return PAUSED
