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
from seisblock.dynamics.arrays import VECTOR
from seisblock.solvers.stack.arguments import LAYOUT, MEMORY
from seisblock.solvers.stack.contact import PUSH
from seisblock.solvers.stack.impulse import (
    GAP,
    IMPULSE,
    KINETIC,
    MU,
    NORMAL,
    OLD,
    PACED,
    SHIFT,
    SLID,
    STANDS,
    STATIC,
    SWERVE,
    TURN,
    lay_plainly,
    parting,
)
from seisblock.solvers.stack.row import FALL, FIRST, JOINTS, WHOLE
from seisblock.solvers.stack.sweeps import PRECISION, drive, settle, settle_surely, work_done

_t = types()

NOTICED = 3e-3
"""Speed, over that of a free fall of a step, beyond which a point slides; sweeps end below a sixth of it."""

SATURATED = 1.0 - 1e-6
"""Part of what friction can do that it does where a point slides."""

TRIES = 16
"""How often the impulses of a step are looked for at most."""

TOGETHER = 0.1
"""Part of a step within which points come to rest together; what would do so later is looked at again with what these do afterwards."""

TURNING, ASIDE, SHORTEST = 0.3, 0.05, 0.0625
"""Tangent of the angle by which a slip may turn until a step ends; what turns it aside, over what brakes it, from which it turns and does
not stop; and the least step that has such an end, over a whole one."""

STAYS, STOPS, TURNS, BEGINS, GOES = range(5)
"""What a point does in a step, as far as is known: what it did; it stops; it stopped, and stays or goes another way; it begins to slide;
and no more is asked."""


@kernel(_t.UniTuple(_t.float64, 3)(_t.int64, _t.int64, VECTOR, MEMORY), inline=True)
def along_face(a, b, row, memory):
    """Return the velocity with which a point slides at the end of the step."""
    u0, u1, u2 = parting(a, b, row, memory.speeds)
    u0, u1, u2 = u0 + row[SWERVE], u1 + row[SWERVE + 1], u2 + row[SWERVE + 2]
    along = u0 * row[NORMAL] + u1 * row[NORMAL + 1] + u2 * row[NORMAL + 2]
    return u0 - along * row[NORMAL], u1 - along * row[NORMAL + 1], u2 - along * row[NORMAL + 2]


@kernel(_t.void(_t.int64, _t.boolean, MEMORY))
def look_back(count, anew, memory):
    """Note how points slide before the step's impulses: those that slid, or, `anew`, all that touch."""
    least = NOTICED * memory.pace[FALL]
    for i in range(count):
        row = memory.table[i]
        if anew:
            row[SLID] = 1.0 if row[GAP] <= 0.0 else 0.0
        if row[SLID] == 0.0:
            continue
        u0, u1, u2 = parting(memory.who[i, 0], memory.who[i, 1], row, memory.speeds)
        along = u0 * row[NORMAL] + u1 * row[NORMAL + 1] + u2 * row[NORMAL + 2]
        u0, u1, u2 = u0 - along * row[NORMAL], u1 - along * row[NORMAL + 1], u2 - along * row[NORMAL + 2]
        row[PACED] = math.sqrt(u0 * u0 + u1 * u1 + u2 * u2)
        if row[PACED] <= least:
            row[SLID] = 0.0
            continue
        row[OLD] = u0 / row[PACED]
        row[OLD + 1] = u1 / row[PACED]
        row[OLD + 2] = u2 / row[PACED]


@kernel(_t.float64(_t.int64, _t.float64, _t.float64, _t.float64, MEMORY))
def far_turned(count, since, before, left, memory):
    """Return when what slides will have turned far, s, at the latest what is left of the step.

    Parameters
    ----------
    since, before : float, s
        For how long the velocities have gone on since they were noted, under the forces in the rows; and for how long of it to the step.
    """
    first = left
    for i in range(count):
        row = memory.table[i]
        if row[STANDS] == 0.0 or row[SLID] == 0.0:
            continue
        u0, u1, u2 = parting(memory.who[i, 0], memory.who[i, 1], row, memory.speeds)
        up = u0 * row[NORMAL] + u1 * row[NORMAL + 1] + u2 * row[NORMAL + 2]
        along = u0 * row[OLD] + u1 * row[OLD + 1] + u2 * row[OLD + 2]
        across = math.sqrt(max(u0 * u0 + u1 * u1 + u2 * u2 - up * up - along * along, 0.0)) / since
        braked = (row[PACED] - along) / since
        if across > ASIDE * braked and across + TURNING * braked > 0.0:
            first = min(first, 2.0 * (row[PACED] * TURNING / (across + TURNING * braked) - before))
    return min(left, max(first, SHORTEST * memory.pace[WHOLE]))


@kernel(_t.void(VECTOR, _t.float64, _t.float64), inline=True)
def _lay(row, before, after):
    """Lay the cone of a point that slid: friction against where it went, and the width of the cone about it."""
    row[MU] = after
    for k in range(3):
        row[SHIFT + k] = -before * row[OLD + k]


@kernel(_t.void(_t.int64, MEMORY))
def lay_cones(count, memory):
    """Let what slid go on sliding, and what did not cling.

    Stones that no longer stand have friction by the velocity at the end of the step: among them a shifted cone might press without end.
    """
    for i in range(count):
        row = memory.table[i]
        row[TURN] = STAYS if row[STANDS] > 0.0 else GOES
        if row[STANDS] > 0.0 and row[SLID] > 0.0:
            _lay(row, 0.5 * row[KINETIC], 0.5 * row[KINETIC])
        else:
            lay_plainly(row)


@kernel(_t.float64(_t.int64, _t.int64, _t.float64, _t.float64, _t.float64, MEMORY))
def _earlier(i, count, x, y, z, memory):
    """Return what two bodies' friction against a direction was in the step before, over what pressed; nothing where nothing pressed."""
    who, n, press, drag = memory.who, memory.table[i], 0.0, 0.0
    for j in range(count):
        if who[j, FIRST] != who[i, FIRST] or who[j, FIRST + 1] != who[i, FIRST + 1]:
            continue
        o, p, q = who[j, 3], who[j, 4], who[j, 5]
        slot = memory.joint_slots[o, p, q] if who[j, 2] == JOINTS else memory.corner_slots[o, p, q]
        press += slot[PUSH] * n[NORMAL] + slot[PUSH + 1] * n[NORMAL + 1] + slot[PUSH + 2] * n[NORMAL + 2]
        drag -= slot[PUSH] * x + slot[PUSH + 1] * y + slot[PUSH + 2] * z
    return drag / press if press > 0.0 else 0.0


@kernel(_t.float64(_t.float64, _t.float64), inline=True)
def _until_rest(paced, along):
    """Return after which part of the step a point comes to rest that is braked from one speed to another; 1 where it does not."""
    return paced / (paced - along) if along < 0.0 else 1.0


@kernel(_t.float64(_t.int64, MEMORY), inline=True)
def _soonest(count, memory):
    """Return after which part of the step the first of the points comes to rest that may stop, while all of these are braked."""
    first = 1.0
    for i in range(count):
        row = memory.table[i]
        press = row[IMPULSE] * row[NORMAL] + row[IMPULSE + 1] * row[NORMAL + 1] + row[IMPULSE + 2] * row[NORMAL + 2]
        if press > 0.0 and row[TURN] == STOPS:
            u0, u1, u2 = along_face(memory.who[i, 0], memory.who[i, 1], row, memory)
            first = min(first, _until_rest(row[PACED], u0 * row[OLD] + u1 * row[OLD + 1] + u2 * row[OLD + 2]))
    return first


@kernel(_t.boolean(_t.int64, _t.boolean, MEMORY), inline=True)
def _judge(count, struck, memory):
    """Look at what points do with the impulses that were tried, and lay their cones anew; return whether another try is wanted."""
    least, again = NOTICED * memory.pace[FALL], False
    first = _soonest(count, memory)
    for i in range(count):
        row = memory.table[i]
        p0, p1, p2 = row[IMPULSE], row[IMPULSE + 1], row[IMPULSE + 2]
        press = p0 * row[NORMAL] + p1 * row[NORMAL + 1] + p2 * row[NORMAL + 2]
        if press <= 0.0 or row[TURN] == GOES:
            continue
        u0, u1, u2 = along_face(memory.who[i, 0], memory.who[i, 1], row, memory)
        along = u0 * row[OLD] + u1 * row[OLD + 1] + u2 * row[OLD + 2]
        speed = math.sqrt(u0 * u0 + u1 * u1 + u2 * u2)
        if row[SLID] > 0.0 and row[TURN] == STAYS:
            if along <= least:
                row[TURN] = STOPS
                _lay(row, row[KINETIC], 0.0)
                again = True
        elif row[TURN] == STOPS:
            part = _until_rest(row[PACED], along)
            if part == 1.0 or part > first + TOGETHER:
                row[TURN] = STAYS if part > first + TOGETHER else GOES
                _lay(row, 0.5 * row[KINETIC], 0.5 * row[KINETIC])
            else:
                row[TURN] = TURNS
                _lay(row, part * row[KINETIC], (1.0 - part) * row[STATIC])
            again = True
        elif row[TURN] == TURNS:
            if speed > least and row[KINETIC] < row[STATIC]:
                row[MU] *= row[KINETIC] / row[STATIC]
                again = True
            row[TURN] = GOES
        elif row[TURN] == BEGINS:
            row[TURN] = GOES
            gain = speed - row[PACED]
            if not struck and gain > 0.0:
                over = (row[STATIC] - row[KINETIC]) * row[PACED] / gain
                rise = row[STATIC] + over - _earlier(i, count, u0 / speed, u1 / speed, u2 / speed, memory)
                part = 0.5 + (min(over / rise, 1.0) if rise > 0.0 else 1.0)
                row[MU] = max(row[STATIC] - part * (row[STATIC] - row[KINETIC]), 0.0)
                again = True
        elif row[SLID] == 0.0 and row[KINETIC] < row[STATIC] and speed > least:
            drag = p0 * p0 + p1 * p1 + p2 * p2 - press * press
            if drag >= (SATURATED * row[MU] * press) ** 2:
                row[TURN] = BEGINS
                row[PACED] = speed
                row[MU] = row[KINETIC]
                again = True
    return again


@kernel(_t.boolean(_t.int64, MEMORY), inline=True)
def _shifted(count, memory):
    """Whether the cone of a point is shifted."""
    for i in range(count):
        row = memory.table[i]
        if row[SHIFT] != 0.0 or row[SHIFT + 1] != 0.0 or row[SHIFT + 2] != 0.0:
            return True
    return False


@kernel(_t.int64(_t.int64, _t.int64, _t.boolean, LAYOUT, MEMORY), inline=True)
def settle_slips(count, n, struck, pile, memory):
    """Find the impulses of a step, again where points begin to slide or cease to; return how many sweeps the last try took.

    Impulses in cones about their normals take energy ([Moreau1988]_); in shifted ones they may give it, and press without end where a
    point's friction lifts it (Painleve). What gives energy is not friction: the step then has friction by the velocity at its end.
    """
    who, table, speeds, sweeps, tolerance = memory.who, memory.table, memory.speeds, 0, PRECISION * memory.pace[FALL]
    for turn in range(TRIES):
        sweeps = settle(count, who, table, n, pile.inert, tolerance, speeds)
        if sweeps == 0 or turn == TRIES - 1 or not _judge(count, struck, memory):
            break
    if _shifted(count, memory):
        wrong = work_done(count, who, table, n, pile.inert, 0.0, speeds) > 0.0
    else:
        wrong = drive(count, who, table, tolerance, speeds)
    if sweeps > 0 and not wrong:
        return sweeps
    for i in range(count):
        lay_plainly(memory.table[i])
    return settle_surely(count, who, table, n, pile.inert, tolerance, speeds)
