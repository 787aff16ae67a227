"""Coulomb friction within a step: onset of sliding, stop of sliding, and turning of the slip direction.

One impulse changes the velocities of a step. If a point slides along s (unit vector) and stops after the fraction f of the step, kinetic
friction acts against s until then, and Coulomb's law from rest holds for the remainder: the impulse lies in the shifted cone

    P_t = -mu_k f s P_n + Q ,   |Q| <= mu (1 - f) P_n ,   mu = mu_s where it stays, mu_k where it slides on   (derived here).

A stopping point changes the load of the others: if several points of a stone stop in a step, the first ones are fixed and the others are
solved again. Slabs with equal friction in all joints slide as one body, the upper joint at its limit; without this order nothing would
brake the upper slab when the lower one turns.

A point that keeps sliding has f = 1/2: half of the friction acts against the old direction, half against the new one, which follows a
turning direction to second order in the step. The direction turns fastest where the slip is slowest, so a step ends where the slip would
turn too far under the previous forces, unless it concerns a small share of the sliding load: of the many points of a wall, some turn in
every step. A point that starts to slide has static friction until then; the instant follows from the forces of the previous and of the
present step. Friction against the velocity at the end of the step alone would oppose a turning slip by mu_k g times the step on average,
and hold a starting slip for one step too long.
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import VECTOR
from seisblock.models.stack.buffers import LAYOUT, MEMORY
from seisblock.models.stack.constraint_assembly import BODY_IDS, FREE_FALL_SPEED, FROM_JOINT, FULL_STEP
from seisblock.models.stack.constraint_row import (
    CONE_CENTRE,
    GAP,
    IMPULSE,
    IS_STANDING,
    KINETIC,
    MU,
    NORMAL,
    ROTATION_BIAS,
    SEARCH_DIRECTION,
    SLIP_DIRECTION,
    SLIP_SPEED,
    SLIP_STATE,
    STATIC,
    WAS_SLIDING,
    centre_friction_cone,
    relative_velocity,
)
from seisblock.models.stack.newton import GRADIENT
from seisblock.models.stack.pgs import TOLERANCE, creates_energy, impulse_work, solve_contacts, solve_impulses
from seisblock.models.stack.spring_contact import CACHED_FORCE

_t = types()

SLIP_THRESHOLD = 3e-3
"""Slip speed, over the speed of a free fall of a step, above which a point slides; the sweeps converge to less than a sixth of it."""

SATURATION = 1.0 - 1e-6
"""Share of the friction limit from which a point counts as sliding."""

MAX_TRIES = 16
"""Largest number of solutions of a step with updated friction cones."""

STOP_WINDOW = 0.1
"""Share of a step within which stops count as simultaneous; later stops are decided again after the first ones."""

MAX_SLIP_TURN, MIN_TURN_RATIO, MIN_STEP_RATIO = 0.3, 0.05, 0.0625
"""Tangent of the angle by which a slip may turn within a step; lateral over braking acceleration above which a slip turns rather than
stops; and shortest step that ends for this reason, over a full step."""

MAX_TURNING_SHARE = 0.05
"""Largest share of the load of the sliding points whose slip may turn by more within a step."""

SLIP_UNCHANGED, SLIP_STOPS, SLIP_REDIRECTS, SLIP_BEGINS, SLIP_DECIDED = range(5)
"""Slip state of a point in a step: as before; stops; has stopped, and stays or leaves in another direction; starts to slide; decided."""


@kernel(_t.UniTuple(_t.float64, 3)(_t.int64, _t.int64, VECTOR, MEMORY), inline=True)
def sliding_velocity(a, b, row, memory):
    """Return the tangential velocity of a contact at the end of the step."""
    u0, u1, u2 = relative_velocity(a, b, row, memory.body_velocities)
    u0, u1, u2 = u0 + row[ROTATION_BIAS], u1 + row[ROTATION_BIAS + 1], u2 + row[ROTATION_BIAS + 2]
    normal_speed = u0 * row[NORMAL] + u1 * row[NORMAL + 1] + u2 * row[NORMAL + 2]
    return u0 - normal_speed * row[NORMAL], u1 - normal_speed * row[NORMAL + 1], u2 - normal_speed * row[NORMAL + 2]


@kernel(_t.void(_t.int64, _t.boolean, MEMORY))
def record_slip(count, all_contacts, memory):
    """Store direction and speed of the slip before the impulses of the step: of the sliding points, or of all closed contacts."""
    threshold = SLIP_THRESHOLD * memory.step_info[FREE_FALL_SPEED]
    for i in range(count):
        row = memory.constraint_rows[i]
        # after an impact every closed contact may have started to slide
        if all_contacts:
            row[WAS_SLIDING] = 1.0 if row[GAP] <= 0.0 else 0.0
        if row[WAS_SLIDING] == 0.0:
            continue
        u0, u1, u2 = relative_velocity(memory.contact_ids[i, 0], memory.contact_ids[i, 1], row, memory.body_velocities)
        normal_speed = u0 * row[NORMAL] + u1 * row[NORMAL + 1] + u2 * row[NORMAL + 2]
        u0, u1, u2 = u0 - normal_speed * row[NORMAL], u1 - normal_speed * row[NORMAL + 1], u2 - normal_speed * row[NORMAL + 2]
        row[SLIP_SPEED] = math.sqrt(u0 * u0 + u1 * u1 + u2 * u2)
        if row[SLIP_SPEED] <= threshold:
            row[WAS_SLIDING] = 0.0
            continue
        row[SLIP_DIRECTION] = u0 / row[SLIP_SPEED]
        row[SLIP_DIRECTION + 1] = u1 / row[SLIP_SPEED]
        row[SLIP_DIRECTION + 2] = u2 / row[SLIP_SPEED]


@kernel(_t.float64(_t.int64, _t.float64, _t.float64, _t.float64, MEMORY))
def max_turn_time(count, duration, time_before, time_left, memory):
    """Return the time until a slip has turned too far, s, at most the remainder of the step.

    Parameters
    ----------
    duration, time_before : float, s
        Time over which the velocities were advanced since the slip was recorded, with the forces in the rows; and its part up to the step.
    """
    sliding_load = 0.0
    for i in range(count):
        row = memory.constraint_rows[i]
        # the load of the last step; a column that the solver overwrites later holds the time until the second pass
        row[SEARCH_DIRECTION] = math.inf
        row[SEARCH_DIRECTION + 1] = max(
            row[IMPULSE] * row[NORMAL] + row[IMPULSE + 1] * row[NORMAL + 1] + row[IMPULSE + 2] * row[NORMAL + 2], 0.0
        )
        if row[IS_STANDING] == 0.0 or row[WAS_SLIDING] == 0.0:
            continue
        sliding_load += row[SEARCH_DIRECTION + 1]
        u0, u1, u2 = relative_velocity(memory.contact_ids[i, 0], memory.contact_ids[i, 1], row, memory.body_velocities)
        normal_speed = u0 * row[NORMAL] + u1 * row[NORMAL + 1] + u2 * row[NORMAL + 2]
        slip_speed = u0 * row[SLIP_DIRECTION] + u1 * row[SLIP_DIRECTION + 1] + u2 * row[SLIP_DIRECTION + 2]
        # change of the slip since it was recorded, across and along its direction
        lateral_rate = math.sqrt(max(u0 * u0 + u1 * u1 + u2 * u2 - normal_speed * normal_speed - slip_speed * slip_speed, 0.0)) / duration
        deceleration = (row[SLIP_SPEED] - slip_speed) / duration
        if lateral_rate > MIN_TURN_RATIO * deceleration and lateral_rate + MAX_SLIP_TURN * deceleration > 0.0:
            # the limit is reached where lateral_rate t = MAX_SLIP_TURN (speed - deceleration t); the velocity is that of the middle of the
            # step, hence twice the time
            row[SEARCH_DIRECTION] = 2.0 * (row[SLIP_SPEED] * MAX_SLIP_TURN / (lateral_rate + MAX_SLIP_TURN * deceleration) - time_before)
    # the first turns are left out while they concern a small share of the load: of many contacts, some turn in every step
    min_time, turning_load = time_left, 0.0
    while True:
        first = 0
        for i in range(1, count):
            if memory.constraint_rows[i, SEARCH_DIRECTION] < memory.constraint_rows[first, SEARCH_DIRECTION]:
                first = i
        if count == 0 or memory.constraint_rows[first, SEARCH_DIRECTION] >= time_left:
            break
        turning_load += memory.constraint_rows[first, SEARCH_DIRECTION + 1]
        if turning_load >= MAX_TURNING_SHARE * sliding_load:
            min_time = memory.constraint_rows[first, SEARCH_DIRECTION]
            break
        memory.constraint_rows[first, SEARCH_DIRECTION] = math.inf
    # a lower bound keeps a slip that nearly stops from cutting the step to nothing
    return min(time_left, max(min_time, MIN_STEP_RATIO * memory.step_info[FULL_STEP]))


@kernel(_t.void(VECTOR, _t.float64, _t.float64), inline=True)
def _set_cone(row, cone_offset, cone_width):
    """Shift the friction cone of a sliding point against its direction, and set the width about the shifted centre."""
    row[MU] = cone_width
    for k in range(3):
        row[CONE_CENTRE + k] = -cone_offset * row[SLIP_DIRECTION + k]


@kernel(_t.void(_t.int64, MEMORY))
def set_friction_cones(count, memory):
    """Set the friction cones at the start of a step: sliding continues, sticking continues.

    Contacts of stones that no longer stand take friction against the velocity at the end of the step: a shifted cone between them may let
    the impulses grow without bound.
    """
    for i in range(count):
        row = memory.constraint_rows[i]
        row[SLIP_STATE] = SLIP_UNCHANGED if row[IS_STANDING] > 0.0 else SLIP_DECIDED
        # f = 1/2: half of the friction against the old direction, half in a cone about it
        if row[IS_STANDING] > 0.0 and row[WAS_SLIDING] > 0.0:
            _set_cone(row, 0.5 * row[KINETIC], 0.5 * row[KINETIC])
        else:
            centre_friction_cone(row)


@kernel(_t.float64(_t.int64, _t.int64, _t.float64, _t.float64, _t.float64, MEMORY))
def _previous_friction_ratio(i, count, x, y, z, memory):
    """Return the friction of two bodies against a direction in the previous step over their normal force; 0 without contact."""
    contact_ids, n, normal_force, friction = memory.contact_ids, memory.constraint_rows[i], 0.0, 0.0
    for j in range(count):
        if contact_ids[j, BODY_IDS] != contact_ids[i, BODY_IDS] or contact_ids[j, BODY_IDS + 1] != contact_ids[i, BODY_IDS + 1]:
            continue
        # the slots still hold the forces of the previous step
        o, p, q = contact_ids[j, 3], contact_ids[j, 4], contact_ids[j, 5]
        slot = memory.joint_slots[o, p, q] if contact_ids[j, 2] == FROM_JOINT else memory.corner_slots[o, p, q]
        normal_force += slot[CACHED_FORCE] * n[NORMAL] + slot[CACHED_FORCE + 1] * n[NORMAL + 1] + slot[CACHED_FORCE + 2] * n[NORMAL + 2]
        friction -= slot[CACHED_FORCE] * x + slot[CACHED_FORCE + 1] * y + slot[CACHED_FORCE + 2] * z
    return friction / normal_force if normal_force > 0.0 else 0.0


@kernel(_t.float64(_t.float64, _t.float64), inline=True)
def _stopping_fraction(start_speed, end_speed):
    """Return the fraction of the step after which a point stops that decelerates between two speeds; 1 if it does not stop."""
    return start_speed / (start_speed - end_speed) if end_speed < 0.0 else 1.0


@kernel(_t.void(_t.int64, _t.int64, MEMORY), inline=True)
def _find_first_stops(count, n, memory):
    """Write the fraction of the step after which the first stopping point of each body stops while all of them are braked."""
    first_stops = memory.newton_bodies
    for i in range(n):
        first_stops[i, GRADIENT] = 1.0
    for i in range(count):
        row, a, b = memory.constraint_rows[i], memory.contact_ids[i, 0], memory.contact_ids[i, 1]
        normal_impulse = row[IMPULSE] * row[NORMAL] + row[IMPULSE + 1] * row[NORMAL + 1] + row[IMPULSE + 2] * row[NORMAL + 2]
        if normal_impulse > 0.0 and row[SLIP_STATE] == SLIP_STOPS:
            u0, u1, u2 = sliding_velocity(a, b, row, memory)
            end_speed = u0 * row[SLIP_DIRECTION] + u1 * row[SLIP_DIRECTION + 1] + u2 * row[SLIP_DIRECTION + 2]
            fraction = _stopping_fraction(row[SLIP_SPEED], end_speed)
            first_stops[a, GRADIENT], first_stops[b, GRADIENT] = (
                min(first_stops[a, GRADIENT], fraction),
                min(first_stops[b, GRADIENT], fraction),
            )
    # the ground transmits no change
    first_stops[n, GRADIENT] = 1.0


@kernel(_t.boolean(_t.int64, _t.int64, _t.boolean, MEMORY), inline=True)
def _update_cones(count, n, has_impact, memory):
    """Update slip states and friction cones from a trial solution; return whether another one is needed."""
    threshold, needs_retry = SLIP_THRESHOLD * memory.step_info[FREE_FALL_SPEED], False
    # the first stops of each body are decided with all later ones still braked
    _find_first_stops(count, n, memory)
    for i in range(count):
        row = memory.constraint_rows[i]
        p0, p1, p2 = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2]
        normal_impulse = p0 * row[NORMAL] + p1 * row[NORMAL + 1] + p2 * row[NORMAL + 2]
        if normal_impulse <= 0.0 or row[SLIP_STATE] == SLIP_DECIDED:
            continue
        u0, u1, u2 = sliding_velocity(memory.contact_ids[i, 0], memory.contact_ids[i, 1], row, memory)
        end_speed = u0 * row[SLIP_DIRECTION] + u1 * row[SLIP_DIRECTION + 1] + u2 * row[SLIP_DIRECTION + 2]
        speed = math.sqrt(u0 * u0 + u1 * u1 + u2 * u2)
        if row[WAS_SLIDING] > 0.0 and row[SLIP_STATE] == SLIP_UNCHANGED:
            if end_speed <= threshold:
                row[SLIP_STATE] = SLIP_STOPS
                _set_cone(row, row[KINETIC], 0.0)
                needs_retry = True
        elif row[SLIP_STATE] == SLIP_STOPS:
            fraction = _stopping_fraction(row[SLIP_SPEED], end_speed)
            first_stop = min(
                memory.newton_bodies[memory.contact_ids[i, 0], GRADIENT], memory.newton_bodies[memory.contact_ids[i, 1], GRADIENT]
            )
            # stops later than the first ones, or not at all: braked as before, and tested again
            if fraction == 1.0 or fraction > first_stop + STOP_WINDOW:
                row[SLIP_STATE] = SLIP_UNCHANGED if fraction > first_stop + STOP_WINDOW else SLIP_DECIDED
                _set_cone(row, 0.5 * row[KINETIC], 0.5 * row[KINETIC])
            else:
                row[SLIP_STATE] = SLIP_REDIRECTS
                _set_cone(row, fraction * row[KINETIC], (1.0 - fraction) * row[STATIC])
            needs_retry = True
        elif row[SLIP_STATE] == SLIP_REDIRECTS:
            if speed > threshold and row[KINETIC] < row[STATIC]:
                # slides on in another direction: the remainder of the cone has the kinetic coefficient
                row[MU] *= row[KINETIC] / row[STATIC]
                needs_retry = True
            row[SLIP_STATE] = SLIP_DECIDED
        elif row[SLIP_STATE] == SLIP_BEGINS:
            row[SLIP_STATE] = SLIP_DECIDED
            gain = speed - row[SLIP_SPEED]
            if not has_impact and gain > 0.0:
                # onset within the step: static friction until then, kinetic afterwards, by linear change of the friction
                excess = (row[STATIC] - row[KINETIC]) * row[SLIP_SPEED] / gain
                rise = row[STATIC] + excess - _previous_friction_ratio(i, count, u0 / speed, u1 / speed, u2 / speed, memory)
                fraction = 0.5 + (min(excess / rise, 1.0) if rise > 0.0 else 1.0)
                row[MU] = max(row[STATIC] - fraction * (row[STATIC] - row[KINETIC]), 0.0)
                needs_retry = True
        elif row[WAS_SLIDING] == 0.0 and row[KINETIC] < row[STATIC] and speed > threshold:
            # slip at the limit of the static cone marks the onset of sliding
            friction_squared = p0 * p0 + p1 * p1 + p2 * p2 - normal_impulse * normal_impulse
            if friction_squared >= (SATURATION * row[MU] * normal_impulse) ** 2:
                row[SLIP_STATE] = SLIP_BEGINS
                row[SLIP_SPEED] = speed
                row[MU] = row[KINETIC]
                needs_retry = True
    return needs_retry


@kernel(_t.boolean(_t.int64, MEMORY), inline=True)
def _has_shifted_cone(count, memory):
    """Return whether any friction cone is shifted."""
    for i in range(count):
        row = memory.constraint_rows[i]
        if row[CONE_CENTRE] != 0.0 or row[CONE_CENTRE + 1] != 0.0 or row[CONE_CENTRE + 2] != 0.0:
            return True
    return False


@kernel(_t.int64(_t.int64, _t.int64, _t.boolean, LAYOUT, MEMORY), inline=True)
def solve_friction(count, n, has_impact, pile, memory):
    """Solve the impulses of a step, repeated while points start or stop sliding; return the sweeps of the last solution.

    Impulses in cones about the normals dissipate energy ([Moreau1988]_). In shifted cones they may create it, or grow without bound where
    friction lifts the point (Painleve). A solution that creates energy is replaced by one with friction against the velocity at the end of
    the step.
    """
    contact_ids, rows, velocities, sweeps, tolerance = (
        memory.contact_ids,
        memory.constraint_rows,
        memory.body_velocities,
        0,
        TOLERANCE * memory.step_info[FREE_FALL_SPEED],
    )
    for attempt in range(MAX_TRIES):
        sweeps = solve_impulses(count, n, tolerance, pile, memory)
        # each try updates the cones at least of one point; MAX_TRIES bounds the cost
        if sweeps == 0 or attempt == MAX_TRIES - 1 or not _update_cones(count, n, has_impact, memory):
            break
    if _has_shifted_cone(count, memory):
        gains_energy = impulse_work(count, contact_ids, rows, n, pile.inertias, 0.0, velocities) > 0.0
    else:
        gains_energy = creates_energy(count, contact_ids, rows, tolerance, velocities)
    if sweeps > 0 and not gains_energy:
        return sweeps
    # fall back to centred cones, whose impulses dissipate
    for i in range(count):
        centre_friction_cone(memory.constraint_rows[i])
    return solve_contacts(count, n, tolerance, pile, memory)
