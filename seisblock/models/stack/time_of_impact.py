"""Impacts within a step: when the next one comes, and what it leaves.

Velocities are changed by the forces of half the step before and half the step after. A step ends where a point strikes; there the forces
of before act for their half step, then the impact, without time, then what presses from then on. What presses before and what presses
after share no impulse: a block that rocks would else carry its weight on the edge that strikes for up to a whole step too long, and
lose p^2 alpha dt of its turning at each impact (derived here).
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
"""Approach, over what a gap's own acceleration changes it by in a step, from which an impact ends a step: half a step passes then until
it is back. Of what presses it is that of a free fall."""


@kernel(_t.float64(_t.int64, _t.int64, VECTOR, MEMORY), inline=True)
def _gap_rate(a, b, row, memory):
    """Return how fast the gap of a contact opens."""
    u0, u1, u2 = relative_velocity(a, b, row, memory.body_velocities)
    return u0 * row[NORMAL] + u1 * row[NORMAL + 1] + u2 * row[NORMAL + 2]


@kernel(_t.boolean(_t.int64, MEMORY))
def detect_impacts(count, memory):
    """Note how fast the gaps open at the step; return whether a point strikes there, and write the floors of the impact if so."""
    step_info, table = memory.step_info, memory.constraint_rows
    has_impact = False
    for i in range(count):
        row = table[i]
        row[GAP_RATE] = _gap_rate(memory.contact_ids[i, 0], memory.contact_ids[i, 1], row, memory)
        row[MIN_NORMAL_VELOCITY] = (
            0.0 if row[GAP] <= row[SIMULTANEITY_WINDOW] * step_info[FULL_STEP] * max(-row[GAP_RATE], row[IMPACT_SPEED]) else -math.inf
        )
        if row[MIN_NORMAL_VELOCITY] == 0.0 and row[GAP_RATE] < -IMPACT_SPEED_RATIO * row[IMPACT_SPEED]:
            has_impact = True
    return has_impact


@kernel(_t.float64(VECTOR, _t.int64), inline=True)
def _normal_part(row, k):
    """Return how much of an impulse in a row is along its normal."""
    return row[k] * row[NORMAL] + row[k + 1] * row[NORMAL + 1] + row[k + 2] * row[NORMAL + 2]


@kernel(_t.boolean(VECTOR), inline=True)
def _is_impact(row):
    """Whether a point strikes, as against one that touches."""
    return row[MIN_NORMAL_VELOCITY] == 0.0 and row[GAP_RATE] < -IMPACT_SPEED_RATIO * row[IMPACT_SPEED]


@kernel(_t.boolean(_t.int64, _t.int64, MEMORY), inline=True)
def _same_bodies(i, j, memory):
    """Whether two points are of the same two bodies."""
    return (
        memory.contact_ids[i, BODY_IDS] == memory.contact_ids[j, BODY_IDS]
        and memory.contact_ids[i, BODY_IDS + 1] == memory.contact_ids[j, BODY_IDS + 1]
    )


@kernel(_t.void(_t.int64, _t.float64, MEMORY))
def load_until_impact(count, time_before, memory):
    """Let what does not strike press until the impact, from the forces in the rows on."""
    for i in range(count):
        row = memory.constraint_rows[i]
        row[BILATERAL] = 0.0
        row[PRIOR_NORMAL_FORCE] = max(_normal_part(row, IMPULSE), 0.0)
        if row[GAP_RATE] < -IMPACT_SPEED_RATIO * row[IMPACT_SPEED]:
            row[MIN_NORMAL_VELOCITY] = -math.inf
        for k in range(3):
            row[IMPULSE + k] *= time_before
            row[ROTATION_BIAS + k] = 0.0


@kernel(_t.boolean(_t.int64, _t.int64, _t.int64, _t.int64, LAYOUT, MEMORY))
def _add_restitution_row(i, count, row_index, n, pile, memory):
    """Write a row for where the joint that is struck at a point pressed before, to leave as a given ratio says; return whether it pressed.

    Its points touched, or struck, with velocities u; afterwards the place where it pressed leaves with e (u - min u): in a plane that is
    the ratio e of spins (derived here). The points that pressed are left to this row. Which of them bore how much before goes over from one
    corner to the next as the stone turns, so that nothing hangs on their order: it is told by the forces of the step before, as the time
    until the impact may be none.
    """
    table, row = memory.constraint_rows, memory.constraint_rows[row_index]
    closing_rate, prior_force, load, touch_count, rate = 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(count):
        if _same_bodies(i, j, memory) and table[j, MIN_NORMAL_VELOCITY] == 0.0:
            closing_rate = min(closing_rate, table[j, GAP_RATE])
            if not _is_impact(table[j]):
                touch_count += 1.0
                prior_force += table[j, PRIOR_NORMAL_FORCE]
                load += max(_normal_part(table[j], PRIOR_IMPULSE), 0.0)
    if touch_count == 0.0 or row_index >= table.shape[0]:
        return False
    for k in range(ARM_A, NORMAL + 3):
        row[k] = 0.0
    for j in range(count):
        point = table[j]
        if _same_bodies(i, j, memory) and point[MIN_NORMAL_VELOCITY] == 0.0 and not _is_impact(point):
            prior_impulse = max(_normal_part(point, PRIOR_IMPULSE), 0.0)
            point[LOAD_SHARE] = (
                point[PRIOR_NORMAL_FORCE] / prior_force if prior_force > 0.0 else prior_impulse / load if load > 0.0 else 1.0 / touch_count
            )
            for k in range(ARM_A, NORMAL + 3):
                row[k] += point[LOAD_SHARE] * point[k]
            rate += point[LOAD_SHARE] * point[GAP_RATE]
    for j in range(count):
        if table[j, LOAD_SHARE] > 0.0 and _same_bodies(i, j, memory):
            table[j, MIN_NORMAL_VELOCITY] = -math.inf
    for k in range(3):
        row[IMPULSE + k] = 0.0
        row[ROTATION_BIAS + k] = 0.0
    for k in range(memory.contact_ids.shape[1]):
        memory.contact_ids[row_index, k] = memory.contact_ids[i, k]
    set_delassus_block(memory.contact_ids[row_index, 0], memory.contact_ids[row_index, 1], n, pile.inertias, memory.inverses, row)
    row[MIN_NORMAL_VELOCITY] = table[i, RESTITUTION_RATIO] * (rate - closing_rate)
    row[BILATERAL] = 1.0
    return True


@kernel(_t.void(_t.int64, MEMORY))
def begin_impacts(count, memory):
    """Note what was given until the impacts."""
    for i in range(count):
        row = memory.constraint_rows[i]
        for k in range(3):
            row[PRIOR_IMPULSE + k] = row[IMPULSE + k]
            row[IMPULSE + k] = 0.0
            row[IMPACT_IMPULSE + k] = 0.0


@kernel(_t.int64(_t.int64, _t.int64, LAYOUT, MEMORY))
def add_restitution_rows(count, n, pile, memory):
    """Add a row for each joint that has a ratio and is struck; return how many rows there are."""
    rows = count
    for i in range(count):
        memory.constraint_rows[i, LOAD_SHARE] = 0.0
    for i in range(count):
        is_held = not (memory.constraint_rows[i, RESTITUTION_RATIO] >= 0.0 and _is_impact(memory.constraint_rows[i]))
        for j in range(count, rows):
            is_held = is_held or _same_bodies(i, j, memory)
        if not is_held and _add_restitution_row(i, count, rows, n, pile, memory):
            rows += 1
    return rows


@kernel(_t.void(_t.int64, _t.int64, MEMORY))
def store_impact(count, rows, memory):
    """Note what an impact gave; a joint that left with its ratio does so once in an instant."""
    for i in range(count):
        row = memory.constraint_rows[i]
        for k in range(3):
            row[IMPACT_IMPULSE + k] += row[IMPULSE + k]
            row[IMPULSE + k] = 0.0
        for j in range(count, rows):
            if _same_bodies(i, j, memory):
                row[RESTITUTION_RATIO] = -1.0


@kernel(_t.void(_t.int64, _t.int64, MEMORY))
def distribute_joint_impulse(count, rows, memory):
    """Let the points that pressed bear what holds their joints."""
    for j in range(count, rows):
        for i in range(count):
            row = memory.constraint_rows[i]
            if row[LOAD_SHARE] > 0.0 and _same_bodies(i, j, memory):
                for k in range(3):
                    row[IMPULSE + k] += row[LOAD_SHARE] * memory.constraint_rows[j, IMPULSE + k]


@kernel(_t.void(_t.int64, _t.int64, _t.int64, LAYOUT, MEMORY))
def make_impact_plastic(count, rows, n, pile, memory):
    """Let no joint be held, so that the impact is plastic."""
    apply_impulses(rows - count, memory.contact_ids[count:], memory.constraint_rows[count:], n, pile.inertias, -1.0, memory.body_velocities)
    for i in range(count):
        if memory.constraint_rows[i, LOAD_SHARE] > 0.0:
            memory.constraint_rows[i, MIN_NORMAL_VELOCITY] = 0.0


@kernel(_t.float64(_t.float64, _t.float64, _t.float64), inline=True)
def _closing_time(gap, rate, gain):
    """Return when a gap that opens at a rate, which grows by a gain, will have closed, s."""
    discriminant = rate * rate - 2.0 * gain * gap
    if discriminant < 0.0:
        return math.inf
    denominator = -rate + math.sqrt(discriminant)
    return 2.0 * gap / denominator if denominator > 0.0 else math.inf


@kernel(_t.float64(_t.int64, _t.float64, _t.float64, MEMORY))
def next_impact_time(count, half, time_left, memory):
    """Return when the next impact comes, s, at the latest what is left of the step; mark with no floor what strikes then.

    Parameters
    ----------
    half : float, s
        For how long the velocities have gone on since the step.
    """
    full_step, min_time = memory.step_info[FULL_STEP], time_left
    free_fall_speed = memory.step_info[FREE_FALL_SPEED]
    for i in range(count):
        row = memory.constraint_rows[i]
        row[MIN_NORMAL_VELOCITY] = 0.0
        window = row[SIMULTANEITY_WINDOW] * full_step
        if row[GAP] <= window * max(-row[GAP_RATE], row[IMPACT_SPEED]):
            continue
        gain = (_gap_rate(memory.contact_ids[i, 0], memory.contact_ids[i, 1], row, memory) - row[GAP_RATE]) / half
        time = _closing_time(row[GAP], row[GAP_RATE], gain)
        if time < time_left + window and row[GAP_RATE] + gain * time < -IMPACT_SPEED_RATIO * min(
            free_fall_speed, max(-gain * full_step, row[IMPACT_SPEED])
        ):
            row[MIN_NORMAL_VELOCITY] = -math.inf
            row[SEARCH_DIRECTION] = time
            min_time = min(min_time, time)
    if min_time > time_left - SIMULTANEITY * full_step:
        min_time = time_left
    for i in range(count):
        row = memory.constraint_rows[i]
        if row[MIN_NORMAL_VELOCITY] < 0.0 and row[SEARCH_DIRECTION] > min_time + 2.0 * row[SIMULTANEITY_WINDOW] * full_step:
            row[MIN_NORMAL_VELOCITY] = 0.0
    return min_time
