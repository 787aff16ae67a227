"""Assembly of constraint rows: one row per contact that may close within the step, warm-started from its slot."""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import INTEGER_TABLE, MATRIX, VECTOR
from seisblock.models.stack.broad_phase import SPEED_FACTOR
from seisblock.models.stack.buffers import LAYOUT, MEMORY
from seisblock.models.stack.constraint_row import (
    ARM_A,
    ARM_B,
    GAP,
    IMPACT_SPEED,
    IMPULSE,
    IS_STANDING,
    KINETIC,
    NORMAL,
    RESTITUTION_RATIO,
    RIM_RADIUS,
    SIMULTANEITY_WINDOW,
    STATIC,
    WAS_SLIDING,
    centre_friction_cone,
    set_delassus_block,
)
from seisblock.models.stack.frames import BOX_CENTRE, R, X
from seisblock.models.stack.spring_contact import ACTIVE, CACHED_FORCE, CACHED_SLIDING, FRICTION, POSITION, PREVIOUS_FORCE
from seisblock.models.stack.spring_contact import KINETIC as KINETIC_COLUMN

_t = types()

SPEED_MARGIN_RATIO = 15.0
"""Speed over that of a free fall over a full step, added to :data:`~.broad_phase.SPEED_FACTOR` times the largest speed of any stone: a
wider gap cannot close within a step."""

SIMULTANEITY = 0.01
"""Share of a step within which impacts count as simultaneous."""

MIN_FORCE_TIME_RATIO = 0.0625
"""Share of a full step from which an impulse defines a force; shorter steps also correct the velocity errors of earlier ones."""

LAST_STEP, FREE_FALL_SPEED, FULL_STEP, KICK_TIME, EXTRAPOLATION, SWEEP_COUNT, HAD_IMPACT, CONTACT_COUNT, PRESS_TIME, MAX_SPEED = range(10)
STEP_INFO_COLUMNS = 10
"""Scalars of a step: length of the last step, s; speed of a free fall over a full step, m/s, and its length, s; time over which velocities
last changed, s; extrapolation factor of the warm start; sweeps of the solver; impact in the step (0 or 1); number of contacts; time over
which contact forces acted, s; and largest speed of any stone, m/s."""


SUPPORT_POINTS, SUPPORT_BODY, STILL_STEPS = range(3)
SLEEP_COLUMNS = 3
"""Sleep state of a body: number of support points (0 while awake), supporting body, and steps for which it has been still."""

BODY_IDS = 6
CONTACT_ID_COLUMNS = 8
"""Integers of a contact: the two bodies as solved (sleeping bodies replaced by the ground), the slot of its memory (4), and from
`BODY_IDS` on the two real bodies."""

FROM_JOINT, FROM_PAIR = range(2)
"""Kinds of contact memory: a point of a joint, or a point of a pair of boxes."""


@kernel(_t.int64(_t.int64, _t.int64, _t.int64, VECTOR, _t.float64, _t.float64, VECTOR, MATRIX, LAYOUT, MEMORY))
def add_contact(count, c, p, slot, gap, max_gap, k, bodies, pile, memory):
    """Append the constraint row of a contact unless its gap cannot close within the step; return the number of rows."""
    # the gap cannot close within the step, or the rows are full
    if gap > max_gap or count >= memory.constraint_rows.shape[0]:
        return count
    a, b, ground = pile.owner[c], pile.owner[p], bodies.shape[0] - 1
    row, first, second, box = memory.constraint_rows[count], bodies[a], bodies[b], pile.boxes[p]
    y0, y1, y2 = slot[POSITION] + box[BOX_CENTRE], slot[POSITION + 1] + box[BOX_CENTRE + 1], slot[POSITION + 2] + box[BOX_CENTRE + 2]
    for i in range(3):
        # the same point from both centres: rotated from the partner's axes, then shifted by the distance of the centres
        r = R + 3 * i
        row[ARM_B + i] = second[r] * y0 + second[r + 1] * y1 + second[r + 2] * y2
        row[ARM_A + i] = row[ARM_B + i] + second[X + i] - first[X + i]
        row[NORMAL + i] = second[r] * slot[POSITION + 3] + second[r + 1] * slot[POSITION + 4] + second[r + 2] * slot[POSITION + 5]
    row[GAP] = gap
    row[RESTITUTION_RATIO] = -1.0
    row[IS_STANDING] = 0.0
    row[RIM_RADIUS] = 0.0
    row[SIMULTANEITY_WINDOW] = SIMULTANEITY
    # a slot unused in the last step has no force to start from
    if slot[ACTIVE] == 0.0:
        for i in range(3):
            slot[CACHED_FORCE + i] = 0.0
            slot[PREVIOUS_FORCE + i] = 0.0
        slot[CACHED_SLIDING] = 0.0
    ids = memory.contact_ids[count]
    ids[BODY_IDS] = a
    ids[BODY_IDS + 1] = b
    # sleeping bodies take part as ground
    ids[0] = a if memory.sleep_states[a, SUPPORT_POINTS] == 0 else ground
    ids[1] = b if memory.sleep_states[b, SUPPORT_POINTS] == 0 else ground
    set_delassus_block(ids[0], ids[1], ground, pile.inertias, memory.inverses, row)
    row[STATIC] = k[FRICTION]
    row[KINETIC] = k[KINETIC_COLUMN]
    row[WAS_SLIDING] = slot[CACHED_SLIDING]
    row[IMPACT_SPEED] = memory.step_info[FREE_FALL_SPEED]
    centre_friction_cone(row)
    for i in range(3):
        # warm start: linear extrapolation of the forces of the last two steps
        row[IMPULSE + i] = slot[CACHED_FORCE + i] + memory.step_info[EXTRAPOLATION] * (slot[CACHED_FORCE + i] - slot[PREVIOUS_FORCE + i])
    return count + 1


@kernel(_t.int64(_t.int64, _t.int64, _t.int64, _t.int64, _t.int64, _t.int64, VECTOR, INTEGER_TABLE), inline=True)
def register_slot(old_count, new_count, kind, i, j, k, slot, contact_ids):
    """Record the slot of a new row; return the number of rows."""
    slot[ACTIVE] = 0.0
    if new_count > old_count:
        slot[ACTIVE] = 1.0
        contact_ids[old_count, 2] = kind
        contact_ids[old_count, 3] = i
        contact_ids[old_count, 4] = j
        contact_ids[old_count, 5] = k
    return new_count


@kernel(_t.float64(_t.float64, MEMORY), inline=True)
def max_approach(dt, memory):
    """Return the largest distance, m, that any two stones can approach within a step, impacts included."""
    return dt * (SPEED_FACTOR * memory.step_info[MAX_SPEED] + SPEED_MARGIN_RATIO * memory.step_info[FREE_FALL_SPEED])


@kernel(_t.float64(_t.float64, _t.float64, _t.float64, MEMORY), inline=True)
def mean_force(impulse, time, previous_force, memory):
    """Return the mean force of an impulse over a time, N.

    Over less than a minimum time the force is a mean, weighted by time, with `previous_force` filling the rest (derived here).
    """
    min_time = MIN_FORCE_TIME_RATIO * memory.step_info[FULL_STEP]
    return impulse / time if time >= min_time else (impulse + (min_time - time) * previous_force) / min_time
