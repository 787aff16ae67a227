"""Time of impact within a step, and resolution of impacts.

Forces of half the step before and half the step after change the velocities. A step ends at the time of impact of the first striking
contact; there the previous forces act for their half step, then the impact, in no time, then the contact forces that follow. Contacts
before and after the impact share no impulse: a rocking block would otherwise rest its weight on the striking edge for up to a full step
too long and lose p^2 alpha dt of its angular velocity at each impact (derived here).
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import VECTOR
from seisblock.models.stack.buffers import LAYOUT, MEMORY
from seisblock.models.stack.constraint_assembly import BODY_IDS, FREE_FALL_SPEED, FULL_STEP, SIMULTANEITY
from seisblock.models.stack.constraint_row import (
    ARM_A,
    BILATERAL,
    GAP,
    GAP_RATE,
    IMPACT_IMPULSE,
    IMPACT_SPEED,
    IMPULSE,
    LOAD_SHARE,
    MIN_NORMAL_VELOCITY,
    NORMAL,
    PRIOR_IMPULSE,
    PRIOR_NORMAL_FORCE,
    RESTITUTION_RATIO,
    ROTATION_BIAS,
    SEARCH_DIRECTION,
    SIMULTANEITY_WINDOW,
    apply_impulses,
    relative_velocity,
    set_delassus_block,
)

_t = types()

IMPACT_SPEED_RATIO = 0.25
"""Approach speed, over the change of the gap rate within a step, from which an impact ends a step: the contact would otherwise be off by
half a step. For loaded contacts that change is the speed of a free fall."""

RESTING_SPEED_RATIO = 2e-3
"""Approach speed half a step before, over the speed of a free fall of a step, up to which a contact rested: three times what the solver
leaves of it."""


@kernel(_t.float64(_t.int64, _t.int64, VECTOR, MEMORY), inline=True)
def _gap_rate(a, b, row, memory):
    """Return the rate of a contact's gap, m/s, positive while it opens."""
    u0, u1, u2 = relative_velocity(a, b, row, memory.body_velocities)
    return u0 * row[NORMAL] + u1 * row[NORMAL + 1] + u2 * row[NORMAL + 2]


@kernel(_t.void(_t.int64, MEMORY))
def set_gap_rates(count, memory):
    """Write the rates of the gaps."""
    for i in range(count):
        row = memory.constraint_rows[i]
        row[GAP_RATE] = _gap_rate(memory.contact_ids[i, 0], memory.contact_ids[i, 1], row, memory)


@kernel(_t.boolean(_t.int64, _t.boolean, MEMORY))
def detect_impacts(count, is_first, memory):
    """Write the gap rates at the step; return whether a contact strikes, and set the velocity bounds of the impact.

    The first impact of a step comes with the motion before it: only a contact that approached half a step before, at the gap rate in the
    row, may strike. The forces of the last step, which have moved the velocities since then, need not balance each stone: under a high
    pile, a few per cent of the load are the weight of many stones.
    """
    step_info, table = memory.step_info, memory.constraint_rows
    has_impact = False
    for i in range(count):
        row = table[i]
        has_rested = is_first and row[GAP_RATE] >= -RESTING_SPEED_RATIO * step_info[FREE_FALL_SPEED]
        row[GAP_RATE] = _gap_rate(memory.contact_ids[i, 0], memory.contact_ids[i, 1], row, memory)
        # contacts that close within the window strike together; a bound of minus infinity switches the others off for
        # this impact
        row[MIN_NORMAL_VELOCITY] = (
            0.0 if row[GAP] <= row[SIMULTANEITY_WINDOW] * step_info[FULL_STEP] * max(-row[GAP_RATE], row[IMPACT_SPEED]) else -math.inf
        )
        if has_rested and row[MIN_NORMAL_VELOCITY] == 0.0:
            row[GAP_RATE] = max(row[GAP_RATE], 0.0)
        # slower approaches are resting contacts, which the step itself closes
        if row[MIN_NORMAL_VELOCITY] == 0.0 and row[GAP_RATE] < -IMPACT_SPEED_RATIO * row[IMPACT_SPEED]:
            has_impact = True
    return has_impact


@kernel(_t.float64(VECTOR, _t.int64), inline=True)
def _normal_part(row, k):
    """Return the component of an impulse in a row along its normal."""
    return row[k] * row[NORMAL] + row[k + 1] * row[NORMAL + 1] + row[k + 2] * row[NORMAL + 2]


@kernel(_t.boolean(VECTOR), inline=True)
def _is_impact(row):
    """Return whether a closed contact strikes rather than rests."""
    return row[MIN_NORMAL_VELOCITY] == 0.0 and row[GAP_RATE] < -IMPACT_SPEED_RATIO * row[IMPACT_SPEED]


@kernel(_t.boolean(_t.int64, _t.int64, MEMORY), inline=True)
def _same_bodies(i, j, memory):
    """Return whether two contacts belong to the same two bodies."""
    return (
        memory.contact_ids[i, BODY_IDS] == memory.contact_ids[j, BODY_IDS]
        and memory.contact_ids[i, BODY_IDS + 1] == memory.contact_ids[j, BODY_IDS + 1]
    )


@kernel(_t.void(_t.int64, _t.float64, MEMORY))
def load_until_impact(count, time_before, memory):
    """Set the resting contacts to press until the impact, starting from the forces in the rows."""
    for i in range(count):
        row = memory.constraint_rows[i]
        row[BILATERAL] = 0.0
        row[PRIOR_NORMAL_FORCE] = max(_normal_part(row, IMPULSE), 0.0)
        # a striking contact carries nothing before the impact
        if row[GAP_RATE] < -IMPACT_SPEED_RATIO * row[IMPACT_SPEED]:
            # its impulse belongs to the impact, not to the load before it
            row[MIN_NORMAL_VELOCITY] = -math.inf
        for k in range(3):
            row[IMPULSE + k] *= time_before
            row[ROTATION_BIAS + k] = 0.0


@kernel(_t.boolean(_t.int64, _t.int64, _t.int64, _t.int64, LAYOUT, MEMORY))
def _add_restitution_row(i, count, row_index, n, pile, memory):
    """Write a bilateral row for the loaded points of a struck joint, from its restitution; return whether it was loaded.

    With velocities u of its points before the impact, the centre of pressure leaves with e (u - min u): in a plane e is the ratio of the
    spins (derived here). The loaded points are replaced by this row. Their shares come from the forces of the last step, since the time
    until the impact may be zero; as the stone turns, the load moves from corner to corner, so the order of the contacts has no influence.
    """
    table, row = memory.constraint_rows, memory.constraint_rows[row_index]
    closing_rate, prior_force, load, touch_count, rate = 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(count):
        if _same_bodies(i, j, memory) and table[j, MIN_NORMAL_VELOCITY] == 0.0:
            # the fastest approaching point of the joint is the one that strikes
            closing_rate = min(closing_rate, table[j, GAP_RATE])
            if not _is_impact(table[j]):
                touch_count += 1.0
                prior_force += table[j, PRIOR_NORMAL_FORCE]
                load += max(_normal_part(table[j], PRIOR_IMPULSE), 0.0)
    # no loaded point, or the rows are full: the impact stays plastic
    if touch_count == 0.0 or row_index >= table.shape[0]:
        return False
    for k in range(ARM_A, NORMAL + 3):
        row[k] = 0.0
    for j in range(count):
        point = table[j]
        if _same_bodies(i, j, memory) and point[MIN_NORMAL_VELOCITY] == 0.0 and not _is_impact(point):
            # shares by the forces of the last step, else by the impulses until the impact, else equal
            prior_impulse = max(_normal_part(point, PRIOR_IMPULSE), 0.0)
            point[LOAD_SHARE] = (
                point[PRIOR_NORMAL_FORCE] / prior_force if prior_force > 0.0 else prior_impulse / load if load > 0.0 else 1.0 / touch_count
            )
            for k in range(ARM_A, NORMAL + 3):
                row[k] += point[LOAD_SHARE] * point[k]
            rate += point[LOAD_SHARE] * point[GAP_RATE]
    for j in range(count):
        if table[j, LOAD_SHARE] > 0.0 and _same_bodies(i, j, memory):
            # replaced by the restitution row
            table[j, MIN_NORMAL_VELOCITY] = -math.inf
    for k in range(3):
        row[IMPULSE + k] = 0.0
        row[ROTATION_BIAS + k] = 0.0
    for k in range(memory.contact_ids.shape[1]):
        memory.contact_ids[row_index, k] = memory.contact_ids[i, k]
    set_delassus_block(memory.contact_ids[row_index, 0], memory.contact_ids[row_index, 1], n, pile.inertias, memory.inverses, row)
    # separation speed of the centre of pressure relative to the striking points
    row[MIN_NORMAL_VELOCITY] = table[i, RESTITUTION_RATIO] * (rate - closing_rate)
    row[BILATERAL] = 1.0
    return True


@kernel(_t.void(_t.int64, MEMORY))
def begin_impacts(count, memory):
    """Store the impulses up to the impacts."""
    for i in range(count):
        row = memory.constraint_rows[i]
        for k in range(3):
            # prior and impact impulses are kept apart: only the resting forces serve the warm start
            row[PRIOR_IMPULSE + k] = row[IMPULSE + k]
            row[IMPULSE + k] = 0.0
            row[IMPACT_IMPULSE + k] = 0.0


@kernel(_t.int64(_t.int64, _t.int64, LAYOUT, MEMORY))
def add_restitution_rows(count, n, pile, memory):
    """Add a restitution row for each struck joint with a given restitution; return the number of rows."""
    rows = count
    for i in range(count):
        memory.constraint_rows[i, LOAD_SHARE] = 0.0
    for i in range(count):
        # one row serves all points of a joint
        has_row = not (memory.constraint_rows[i, RESTITUTION_RATIO] >= 0.0 and _is_impact(memory.constraint_rows[i]))
        for j in range(count, rows):
            has_row = has_row or _same_bodies(i, j, memory)
        if not has_row and _add_restitution_row(i, count, rows, n, pile, memory):
            rows += 1
    return rows


@kernel(_t.void(_t.int64, _t.int64, MEMORY))
def store_impact(count, rows, memory):
    """Add the impulses of an impact to the total; a joint applies its restitution once per instant."""
    for i in range(count):
        row = memory.constraint_rows[i]
        for k in range(3):
            row[IMPACT_IMPULSE + k] += row[IMPULSE + k]
            row[IMPULSE + k] = 0.0
        for j in range(count, rows):
            if _same_bodies(i, j, memory):
                # a second impact of the same joint at this instant is plastic: repeated restitution would not end
                row[RESTITUTION_RATIO] = -1.0


@kernel(_t.void(_t.int64, _t.int64, MEMORY))
def distribute_joint_impulse(count, rows, memory):
    """Distribute the impulses of restitution rows to the loaded points."""
    for j in range(count, rows):
        for i in range(count):
            row = memory.constraint_rows[i]
            if row[LOAD_SHARE] > 0.0 and _same_bodies(i, j, memory):
                for k in range(3):
                    row[IMPULSE + k] += row[LOAD_SHARE] * memory.constraint_rows[j, IMPULSE + k]


@kernel(_t.void(_t.int64, _t.int64, _t.int64, LAYOUT, MEMORY))
def make_impact_plastic(count, rows, n, pile, memory):
    """Undo the restitution rows, which makes the impact plastic."""
    apply_impulses(rows - count, memory.contact_ids[count:], memory.constraint_rows[count:], n, pile.inertias, -1.0, memory.body_velocities)
    # the points carry the impact again, as inelastic contacts
    for i in range(count):
        if memory.constraint_rows[i, LOAD_SHARE] > 0.0:
            memory.constraint_rows[i, MIN_NORMAL_VELOCITY] = 0.0


@kernel(_t.float64(_t.float64, _t.float64, _t.float64), inline=True)
def _closing_time(gap, rate, gain):
    """Return the time until a gap closes at a rate that changes linearly, s; infinite if it does not close."""
    # gap + rate t + gain t^2 / 2 = 0
    discriminant = rate * rate - 2.0 * gain * gap
    if discriminant < 0.0:
        return math.inf
    # smaller root in the form without cancellation
    denominator = -rate + math.sqrt(discriminant)
    return 2.0 * gap / denominator if denominator > 0.0 else math.inf


@kernel(_t.float64(_t.int64, _t.float64, _t.float64, MEMORY))
def next_impact_time(count, half, time_left, memory):
    """Return the time of the next impact, s, at most the remainder of the step; striking contacts get no velocity bound.

    Parameters
    ----------
    half : float, s
        Time over which the velocities were advanced since the step.
    """
    full_step, min_time = memory.step_info[FULL_STEP], time_left
    free_fall_speed = memory.step_info[FREE_FALL_SPEED]
    for i in range(count):
        row = memory.constraint_rows[i]
        row[MIN_NORMAL_VELOCITY] = 0.0
        window = row[SIMULTANEITY_WINDOW] * full_step
        # closed already: nothing to wait for
        if row[GAP] <= window * max(-row[GAP_RATE], row[IMPACT_SPEED]):
            continue
        # rate of change of the gap rate under the present forces
        gain = (_gap_rate(memory.contact_ids[i, 0], memory.contact_ids[i, 1], row, memory) - row[GAP_RATE]) / half
        time = _closing_time(row[GAP], row[GAP_RATE], gain)
        # a slow contact closes within the step by its velocity bound, without an impact
        if time < time_left + window and row[GAP_RATE] + gain * time < -IMPACT_SPEED_RATIO * min(
            free_fall_speed, max(-gain * full_step, row[IMPACT_SPEED])
        ):
            row[MIN_NORMAL_VELOCITY] = -math.inf
            # a column that the sweeps overwrite later holds the time until the second pass
            row[SEARCH_DIRECTION] = time
            min_time = min(min_time, time)
    # an impact at the end of the step needs no extra step
    if min_time > time_left - SIMULTANEITY * full_step:
        min_time = time_left
    for i in range(count):
        row = memory.constraint_rows[i]
        if row[MIN_NORMAL_VELOCITY] < 0.0 and row[SEARCH_DIRECTION] > min_time + 2.0 * row[SIMULTANEITY_WINDOW] * full_step:
            # strikes well after the first impact: bounded in this step like a resting contact
            row[MIN_NORMAL_VELOCITY] = 0.0
    return min_time
