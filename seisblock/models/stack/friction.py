"""Where a point begins to slide, comes to rest or turns within a step: what friction does before, and what it does after.

Velocities change over the step by one impulse. Where a point slid along s (a unit vector) and comes to rest after the part f of the step,
kinetic friction acted against s until then, and the rest of the step obeys Coulomb's law from rest: the impulse lies in the shifted cone

    P_t = -mu_k f s P_n + Q ,   |Q| <= mu (1 - f) P_n ,   mu = mu_s where it stays, mu_k where it slides on   (derived here).

What comes to rest changes what others have to bear: where several points stop in a step, the first ones do, and the others are looked at
again with what these do afterwards. Slabs with the same friction in all joints slide as one; the upper one is at its cone then, and nothing
would brake it that slid on alone where the lower one turns.

Where a point goes on sliding, f = 1/2: half of the friction is against where it went, half against where it goes, which follows a direction
that turns to the second order of the step. It turns most sharply where it is slowest: a step ends where the slip has turned far, under the
forces of before. Where it begins to slide, friction is static up to then; when
that is follows from the forces of the step before and of this one. Friction by the velocity at the end of a step alone would brake what
turns within it, by mu_k g of a step's velocity on average, and hold for a step more what begins to slide.
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
    SLIP_DIRECTION,
    SLIP_SPEED,
    SLIP_STATE,
    STATIC,
    WAS_SLIDING,
    centre_friction_cone,
    relative_velocity,
)
from seisblock.models.stack.pgs import TOLERANCE, creates_energy, impulse_work, solve_contacts, solve_pgs
from seisblock.models.stack.spring_contact import CACHED_FORCE

_t = types()

SLIP_THRESHOLD = 3e-3
"""Speed, over that of a free fall of a step, beyond which a point slides; sweeps end below a sixth of it."""

SATURATION = 1.0 - 1e-6
"""Part of what friction can do that it does where a point slides."""

MAX_TRIES = 16
"""How often the impulses of a step are looked for at most."""

STOP_WINDOW = 0.1
"""Part of a step within which points come to rest together; what would do so later is looked at again with what these do afterwards."""

MAX_SLIP_TURN, MIN_TURN_RATIO, MIN_STEP_RATIO = 0.3, 0.05, 0.0625
"""Tangent of the angle by which a slip may turn until a step ends; what turns it aside, over what brakes it, from which it turns and does
not stop; and the least step that has such an end, over a whole one."""

SLIP_UNCHANGED, SLIP_STOPS, SLIP_REDIRECTS, SLIP_BEGINS, SLIP_DECIDED = range(5)
"""What a point does in a step, as far as is known: what it did; it stops; it stopped, and stays or goes another way; it begins to slide;
and no more is asked."""


@kernel(_t.UniTuple(_t.float64, 3)(_t.int64, _t.int64, VECTOR, MEMORY), inline=True)
def sliding_velocity(a, b, row, memory):
    """Return the velocity with which a point slides at the end of the step."""
    u0, u1, u2 = relative_velocity(a, b, row, memory.body_velocities)
    u0, u1, u2 = u0 + row[ROTATION_BIAS], u1 + row[ROTATION_BIAS + 1], u2 + row[ROTATION_BIAS + 2]
    normal_speed = u0 * row[NORMAL] + u1 * row[NORMAL + 1] + u2 * row[NORMAL + 2]
    return u0 - normal_speed * row[NORMAL], u1 - normal_speed * row[NORMAL + 1], u2 - normal_speed * row[NORMAL + 2]


@kernel(_t.void(_t.int64, _t.boolean, MEMORY))
def record_slip(count, all_contacts, memory):
    """Note how points slide before the step's impulses: those that slid, or, `all_contacts`, all that touch."""
    threshold = SLIP_THRESHOLD * memory.step_info[FREE_FALL_SPEED]
    for i in range(count):
        row = memory.constraint_rows[i]
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
    """Return when what slides will have turned far, s, at the latest what is left of the step.

    Parameters
    ----------
    duration, time_before : float, s
        For how long the velocities have gone on since they were noted, under the forces in the rows; and for how long of it to the step.
    """
    min_time = time_left
    for i in range(count):
        row = memory.constraint_rows[i]
        if row[IS_STANDING] == 0.0 or row[WAS_SLIDING] == 0.0:
            continue
        u0, u1, u2 = relative_velocity(memory.contact_ids[i, 0], memory.contact_ids[i, 1], row, memory.body_velocities)
        normal_speed = u0 * row[NORMAL] + u1 * row[NORMAL + 1] + u2 * row[NORMAL + 2]
        slip_speed = u0 * row[SLIP_DIRECTION] + u1 * row[SLIP_DIRECTION + 1] + u2 * row[SLIP_DIRECTION + 2]
        lateral_rate = math.sqrt(max(u0 * u0 + u1 * u1 + u2 * u2 - normal_speed * normal_speed - slip_speed * slip_speed, 0.0)) / duration
        deceleration = (row[SLIP_SPEED] - slip_speed) / duration
        if lateral_rate > MIN_TURN_RATIO * deceleration and lateral_rate + MAX_SLIP_TURN * deceleration > 0.0:
            min_time = min(min_time, 2.0 * (row[SLIP_SPEED] * MAX_SLIP_TURN / (lateral_rate + MAX_SLIP_TURN * deceleration) - time_before))
    return min(time_left, max(min_time, MIN_STEP_RATIO * memory.step_info[FULL_STEP]))


@kernel(_t.void(VECTOR, _t.float64, _t.float64), inline=True)
def _set_cone(row, cone_offset, cone_width):
    """Lay the cone of a point that slid: friction against where it went, and the width of the cone about it."""
    row[MU] = cone_width
    for k in range(3):
        row[CONE_CENTRE + k] = -cone_offset * row[SLIP_DIRECTION + k]


@kernel(_t.void(_t.int64, MEMORY))
def set_friction_cones(count, memory):
    """Let what slid go on sliding, and what did not cling.

    Stones that no longer stand have friction by the velocity at the end of the step: among them a shifted cone might press without end.
    """
    for i in range(count):
        row = memory.constraint_rows[i]
        row[SLIP_STATE] = SLIP_UNCHANGED if row[IS_STANDING] > 0.0 else SLIP_DECIDED
        if row[IS_STANDING] > 0.0 and row[WAS_SLIDING] > 0.0:
            _set_cone(row, 0.5 * row[KINETIC], 0.5 * row[KINETIC])
        else:
            centre_friction_cone(row)


@kernel(_t.float64(_t.int64, _t.int64, _t.float64, _t.float64, _t.float64, MEMORY))
def _previous_friction_ratio(i, count, x, y, z, memory):
    """Return what two bodies' friction against a direction was in the step before, over what pressed; nothing where nothing pressed."""
    contact_ids, n, normal_force, friction = memory.contact_ids, memory.constraint_rows[i], 0.0, 0.0
    for j in range(count):
        if contact_ids[j, BODY_IDS] != contact_ids[i, BODY_IDS] or contact_ids[j, BODY_IDS + 1] != contact_ids[i, BODY_IDS + 1]:
            continue
        o, p, q = contact_ids[j, 3], contact_ids[j, 4], contact_ids[j, 5]
        slot = memory.joint_slots[o, p, q] if contact_ids[j, 2] == FROM_JOINT else memory.corner_slots[o, p, q]
        normal_force += slot[CACHED_FORCE] * n[NORMAL] + slot[CACHED_FORCE + 1] * n[NORMAL + 1] + slot[CACHED_FORCE + 2] * n[NORMAL + 2]
        friction -= slot[CACHED_FORCE] * x + slot[CACHED_FORCE + 1] * y + slot[CACHED_FORCE + 2] * z
    return friction / normal_force if normal_force > 0.0 else 0.0


@kernel(_t.float64(_t.float64, _t.float64), inline=True)
def _stopping_fraction(start_speed, end_speed):
    """Return after which part of the step a point comes to rest that is braked from one speed to another; 1 where it does not."""
    return start_speed / (start_speed - end_speed) if end_speed < 0.0 else 1.0


@kernel(_t.float64(_t.int64, MEMORY), inline=True)
def _first_stop(count, memory):
    """Return after which part of the step the first of the points comes to rest that may stop, while all of these are braked."""
    min_time = 1.0
    for i in range(count):
        row = memory.constraint_rows[i]
        normal_impulse = row[IMPULSE] * row[NORMAL] + row[IMPULSE + 1] * row[NORMAL + 1] + row[IMPULSE + 2] * row[NORMAL + 2]
        if normal_impulse > 0.0 and row[SLIP_STATE] == SLIP_STOPS:
            u0, u1, u2 = sliding_velocity(memory.contact_ids[i, 0], memory.contact_ids[i, 1], row, memory)
            min_time = min(
                min_time,
                _stopping_fraction(row[SLIP_SPEED], u0 * row[SLIP_DIRECTION] + u1 * row[SLIP_DIRECTION + 1] + u2 * row[SLIP_DIRECTION + 2]),
            )
    return min_time


@kernel(_t.boolean(_t.int64, _t.boolean, MEMORY), inline=True)
def _update_cones(count, has_impact, memory):
    """Look at what points do with the impulses that were tried, and lay their cones anew; return whether another try is wanted."""
    threshold, needs_retry = SLIP_THRESHOLD * memory.step_info[FREE_FALL_SPEED], False
    first_stop = _first_stop(count, memory)
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
            if fraction == 1.0 or fraction > first_stop + STOP_WINDOW:
                row[SLIP_STATE] = SLIP_UNCHANGED if fraction > first_stop + STOP_WINDOW else SLIP_DECIDED
                _set_cone(row, 0.5 * row[KINETIC], 0.5 * row[KINETIC])
            else:
                row[SLIP_STATE] = SLIP_REDIRECTS
                _set_cone(row, fraction * row[KINETIC], (1.0 - fraction) * row[STATIC])
            needs_retry = True
        elif row[SLIP_STATE] == SLIP_REDIRECTS:
            if speed > threshold and row[KINETIC] < row[STATIC]:
                row[MU] *= row[KINETIC] / row[STATIC]
                needs_retry = True
            row[SLIP_STATE] = SLIP_DECIDED
        elif row[SLIP_STATE] == SLIP_BEGINS:
            row[SLIP_STATE] = SLIP_DECIDED
            gain = speed - row[SLIP_SPEED]
            if not has_impact and gain > 0.0:
                excess = (row[STATIC] - row[KINETIC]) * row[SLIP_SPEED] / gain
                rise = row[STATIC] + excess - _previous_friction_ratio(i, count, u0 / speed, u1 / speed, u2 / speed, memory)
                fraction = 0.5 + (min(excess / rise, 1.0) if rise > 0.0 else 1.0)
                row[MU] = max(row[STATIC] - fraction * (row[STATIC] - row[KINETIC]), 0.0)
                needs_retry = True
        elif row[WAS_SLIDING] == 0.0 and row[KINETIC] < row[STATIC] and speed > threshold:
            friction_squared = p0 * p0 + p1 * p1 + p2 * p2 - normal_impulse * normal_impulse
            if friction_squared >= (SATURATION * row[MU] * normal_impulse) ** 2:
                row[SLIP_STATE] = SLIP_BEGINS
                row[SLIP_SPEED] = speed
                row[MU] = row[KINETIC]
                needs_retry = True
    return needs_retry


@kernel(_t.boolean(_t.int64, MEMORY), inline=True)
def _has_shifted_cone(count, memory):
    """Whether the cone of a point is shifted."""
    for i in range(count):
        row = memory.constraint_rows[i]
        if row[CONE_CENTRE] != 0.0 or row[CONE_CENTRE + 1] != 0.0 or row[CONE_CENTRE + 2] != 0.0:
            return True
    return False


@kernel(_t.int64(_t.int64, _t.int64, _t.boolean, LAYOUT, MEMORY), inline=True)
def solve_friction(count, n, has_impact, pile, memory):
    """Find the impulses of a step, again where points begin to slide or cease to; return how many sweeps the last try took.

    Impulses in cones about their normals take energy ([Moreau1988]_); in shifted ones they may give it, and press without end where a
    point's friction lifts it (Painleve). What gives energy is not friction: the step then has friction by the velocity at its end.
    """
    contact_ids, rows, velocities, sweeps, tolerance = (
        memory.contact_ids,
        memory.constraint_rows,
        memory.body_velocities,
        0,
        TOLERANCE * memory.step_info[FREE_FALL_SPEED],
    )
    for attempt in range(MAX_TRIES):
        sweeps = solve_pgs(count, contact_ids, rows, n, pile.inertias, tolerance, velocities)
        if sweeps == 0 or attempt == MAX_TRIES - 1 or not _update_cones(count, has_impact, memory):
            break
    if _has_shifted_cone(count, memory):
        gains_energy = impulse_work(count, contact_ids, rows, n, pile.inertias, 0.0, velocities) > 0.0
    else:
        gains_energy = creates_energy(count, contact_ids, rows, tolerance, velocities)
    if sweeps > 0 and not gains_energy:
        return sweeps
    for i in range(count):
        centre_friction_cone(memory.constraint_rows[i])
    return solve_contacts(count, contact_ids, rows, n, pile.inertias, tolerance, velocities)
