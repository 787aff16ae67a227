"""A row for a point that may touch another stone in the step: arms, normal, the velocity it may have, and what it remembers."""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import INTEGER_TABLE, MATRIX, VECTOR
from seisblock.solvers.stack.arguments import LAYOUT, MEMORY
from seisblock.solvers.stack.contact import (
    EARLIER,
    ENTERED,
    FRICTION,
    PLACE,
    PUSH,
    SLIDES,
)
from seisblock.solvers.stack.contact import KINETIC as SLICK
from seisblock.solvers.stack.frames import AT, R, X
from seisblock.solvers.stack.impulse import (
    ARM_A,
    ARM_B,
    AT_ONCE,
    BOUNCE,
    GAP,
    HEED,
    IMPULSE,
    KINETIC,
    NORMAL,
    RIM,
    SLID,
    STANDS,
    STATIC,
    answers,
    lay_plainly,
)
from seisblock.solvers.stack.step import SWIFT

_t = types()

SLOW = 0.5
"""A point is left out while its gap is wider than what so many times the greatest speed of any stone (:data:`~.step.SWIFT`), and this
speed, m/s, more, close in a step."""

BRIEF = 0.01
"""Part of a step within which what strikes together strikes at once."""

HASTY = 0.0625
"""Part of a step from which on an impulse tells a force: in less time it makes good, too, what the steps before left of velocities."""

BEFORE, FALL, WHOLE, KICKED, AHEAD, SWEPT, STRUCK, ROWS, PRESSED, FASTEST = range(10)
PACE = 10
"""The length of the last step, s; the speed of a free fall of a whole step, m/s, and its length, s; the time over which velocities last
changed, s; how far ahead of the last forces the next are looked for; how many sweeps that took; whether something struck; how many contacts
there were; the time over which they pressed, s; and the greatest speed of any stone, m/s."""


POINTS, SUPPORT, WAIT = range(3)
LYING = 3
"""Of a stone that lies: on how many points, none where it is solved for; on which body. Of others: for how many steps they were still."""

FIRST = 6
WHO = 8
"""Where a contact's integers keep its two bodies as they are; before them stand the two as they are solved for, what lies being ground,
and the slot that remembers it (4)."""

JOINTS, MEETINGS = range(2)
"""What a contact belongs to."""


@kernel(_t.int64(_t.int64, _t.int64, _t.int64, VECTOR, _t.float64, _t.float64, VECTOR, MATRIX, _t.float64, LAYOUT, MEMORY))
def enter(count, c, p, slot, gap, far, k, bodies, dt, pile, memory):
    """Make a row of a contact noted in a slot, unless it is too far to be reached in the step; return how many there are then."""
    if gap > far or count >= memory.table.shape[0]:
        return count
    a, b, ground = pile.owner[c], pile.owner[p], bodies.shape[0] - 1
    row, first, second, box = memory.table[count], bodies[a], bodies[b], pile.boxes[p]
    y0, y1, y2 = slot[PLACE] + box[AT], slot[PLACE + 1] + box[AT + 1], slot[PLACE + 2] + box[AT + 2]
    for i in range(3):
        r = R + 3 * i
        row[ARM_B + i] = second[r] * y0 + second[r + 1] * y1 + second[r + 2] * y2
        row[ARM_A + i] = row[ARM_B + i] + second[X + i] - first[X + i]
        row[NORMAL + i] = second[r] * slot[PLACE + 3] + second[r + 1] * slot[PLACE + 4] + second[r + 2] * slot[PLACE + 5]
    row[GAP] = gap
    row[BOUNCE] = -1.0
    row[STANDS] = 0.0
    row[RIM] = 0.0
    row[AT_ONCE] = BRIEF
    if slot[ENTERED] == 0.0:
        for i in range(3):
            slot[PUSH + i] = 0.0
            slot[EARLIER + i] = 0.0
        slot[SLIDES] = 0.0
    who = memory.who[count]
    who[FIRST] = a
    who[FIRST + 1] = b
    who[0] = a if memory.lying[a, POINTS] == 0 else ground
    who[1] = b if memory.lying[b, POINTS] == 0 else ground
    answers(who[0], who[1], ground, pile.inert, memory.inverses, row)
    row[STATIC] = k[FRICTION]
    row[KINETIC] = k[SLICK]
    row[SLID] = slot[SLIDES]
    row[HEED] = memory.pace[FALL]
    lay_plainly(row)
    for i in range(3):
        row[IMPULSE + i] = slot[PUSH + i] + memory.pace[AHEAD] * (slot[PUSH + i] - slot[EARLIER + i])
    return count + 1


@kernel(_t.int64(_t.int64, _t.int64, _t.int64, _t.int64, _t.int64, _t.int64, VECTOR, INTEGER_TABLE), inline=True)
def note(before, now, kind, i, j, k, slot, who):
    """Remember which slot a row was made of; return how many rows there are."""
    slot[ENTERED] = 0.0
    if now > before:
        slot[ENTERED] = 1.0
        who[before, 2] = kind
        who[before, 3] = i
        who[before, 4] = j
        who[before, 5] = k
    return now


@kernel(_t.float64(_t.float64, MEMORY), inline=True)
def far_in(dt, memory):
    """Return how far, m, any stone can come in a step, whatever it strikes or strikes it on the way."""
    return dt * (SWIFT * memory.pace[FASTEST] + SLOW)


@kernel(_t.float64(_t.float64, _t.float64, _t.float64, MEMORY), inline=True)
def force_of(impulse, time, before, memory):
    """Return the force of an impulse over a time, N; in a small part of a step it counts as much as that is, and the one `before` more."""
    brief = HASTY * memory.pace[WHOLE]
    return impulse / time if time >= brief else (impulse + (brief - time) * before) / brief
