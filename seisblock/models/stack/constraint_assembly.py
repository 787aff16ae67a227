"""A row for a point that may touch another stone in the step: arms, normal, the velocity it may have, and what it remembers."""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import INTEGER_TABLE, MATRIX, VECTOR
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
from seisblock.models.stack.spring_contact import KINETIC as SLICK
from seisblock.models.stack.step import SPEED_FACTOR

_t = types()

SPEED_MARGIN = 0.5
"""A point is left out while its gap is wider than what so many times the greatest speed of any stone (:data:`~.step.SWIFT`), and this
speed, m/s, more, close in a step."""

SIMULTANEITY = 0.01
"""Part of a step within which what strikes together strikes at once."""

MIN_FORCE_TIME_RATIO = 0.0625
"""Part of a step from which on an impulse tells a force: in less time it makes good, too, what the steps before left of velocities."""

LAST_STEP, FREE_FALL_SPEED, FULL_STEP, KICK_TIME, EXTRAPOLATION, SWEEP_COUNT, HAD_IMPACT, CONTACT_COUNT, PRESS_TIME, MAX_SPEED = range(10)
STEP_INFO_COLUMNS = 10
"""The length of the last step, s; the speed of a free fall of a whole step, m/s, and its length, s; the time over which velocities last
changed, s; how far ahead of the last forces the next are looked for; how many sweeps that took; whether something struck; how many contacts
there were; the time over which they pressed, s; and the greatest speed of any stone, m/s."""


SUPPORT_POINTS, SUPPORT_BODY, STILL_STEPS = range(3)
SLEEP_COLUMNS = 3
"""Of a stone that lies: on how many points, none where it is solved for; on which body. Of others: for how many steps they were still."""

BODY_IDS = 6
CONTACT_ID_COLUMNS = 8
"""Where a contact's integers keep its two bodies as they are; before them stand the two as they are solved for, what lies being ground,
and the slot that remembers it (4)."""

FROM_JOINT, FROM_PAIR = range(2)
"""What a contact belongs to."""


@kernel(_t.int64(_t.int64, _t.int64, _t.int64, VECTOR, _t.float64, _t.float64, VECTOR, MATRIX, _t.float64, LAYOUT, MEMORY))
def add_contact(count, c, p, slot, gap, max_gap, k, bodies, dt, pile, memory):
    """Make a row of a contact noted in a slot, unless it is too far to be reached in the step; return how many there are then."""
    if gap > max_gap or count >= memory.constraint_rows.shape[0]:
        return count
    a, b, ground = pile.owner[c], pile.owner[p], bodies.shape[0] - 1
    row, first, second, box = memory.constraint_rows[count], bodies[a], bodies[b], pile.boxes[p]
    y0, y1, y2 = slot[POSITION] + box[BOX_CENTRE], slot[POSITION + 1] + box[BOX_CENTRE + 1], slot[POSITION + 2] + box[BOX_CENTRE + 2]
    for i in range(3):
        r = R + 3 * i
        row[ARM_B + i] = second[r] * y0 + second[r + 1] * y1 + second[r + 2] * y2
        row[ARM_A + i] = row[ARM_B + i] + second[X + i] - first[X + i]
        row[NORMAL + i] = second[r] * slot[POSITION + 3] + second[r + 1] * slot[POSITION + 4] + second[r + 2] * slot[POSITION + 5]
    row[GAP] = gap
    row[RESTITUTION_RATIO] = -1.0
    row[IS_STANDING] = 0.0
    row[RIM_RADIUS] = 0.0
    row[SIMULTANEITY_WINDOW] = SIMULTANEITY
    if slot[ACTIVE] == 0.0:
        for i in range(3):
            slot[CACHED_FORCE + i] = 0.0
            slot[PREVIOUS_FORCE + i] = 0.0
        slot[CACHED_SLIDING] = 0.0
    ids = memory.contact_ids[count]
    ids[BODY_IDS] = a
    ids[BODY_IDS + 1] = b
    ids[0] = a if memory.sleep_states[a, SUPPORT_POINTS] == 0 else ground
    ids[1] = b if memory.sleep_states[b, SUPPORT_POINTS] == 0 else ground
    set_delassus_block(ids[0], ids[1], ground, pile.inertias, memory.inverses, row)
    row[STATIC] = k[FRICTION]
    row[KINETIC] = k[SLICK]
    row[WAS_SLIDING] = slot[CACHED_SLIDING]
    row[IMPACT_SPEED] = memory.step_info[FREE_FALL_SPEED]
    centre_friction_cone(row)
    for i in range(3):
        row[IMPULSE + i] = slot[CACHED_FORCE + i] + memory.step_info[EXTRAPOLATION] * (slot[CACHED_FORCE + i] - slot[PREVIOUS_FORCE + i])
    return count + 1


@kernel(_t.int64(_t.int64, _t.int64, _t.int64, _t.int64, _t.int64, _t.int64, VECTOR, INTEGER_TABLE), inline=True)
def register_slot(old_count, new_count, kind, i, j, k, slot, contact_ids):
    """Remember which slot a row was made of; return how many rows there are."""
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
    """Return how far, m, any stone can come in a step, whatever it strikes or strikes it on the way."""
    return dt * (SPEED_FACTOR * memory.step_info[MAX_SPEED] + SPEED_MARGIN)


@kernel(_t.float64(_t.float64, _t.float64, _t.float64, MEMORY), inline=True)
def mean_force(impulse, time, previous_force, memory):
    """Return the force of an impulse over a time, N.

    In a small part of a step it counts as much as that is, and the one `previous_force` more.
    """
    min_time = MIN_FORCE_TIME_RATIO * memory.step_info[FULL_STEP]
    return impulse / time if time >= min_time else (impulse + (min_time - time) * previous_force) / min_time
