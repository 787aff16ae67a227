"""Impacts within a step: when the next one comes, and what it leaves.

Velocities are changed by the forces of half the step before and half the step after. A step ends where a point strikes; there the forces
of before act for their half step, then the impact, without time, then what presses from then on. What presses before and what presses
after share no impulse: a block that rocks would else carry its weight on the edge that strikes for up to a whole step too long, and
lose p^2 alpha dt of its turning at each impact (derived here).
"""

from __future__ import annotations

import math

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import VECTOR
from seisblock.solvers.stack.arguments import LAYOUT, MEMORY
from seisblock.solvers.stack.impulse import (
    ARM_A,
    AT_ONCE,
    BORE,
    BOUNCE,
    DEALT,
    FLOOR,
    GAP,
    GIVEN,
    HEADING,
    HEED,
    HELD,
    IMPULSE,
    NORMAL,
    PART,
    RATE,
    SWERVE,
    answers,
    parting,
    press,
)
from seisblock.solvers.stack.row import BRIEF, FALL, FIRST, WHOLE

_t = types()

SPLITS = 0.25
"""Approach, over what a gap's own acceleration changes it by in a step, from which an impact ends a step: half a step passes then until
it is back. Of what presses it is that of a free fall."""


@kernel(_t.float64(_t.int64, _t.int64, VECTOR, MEMORY), inline=True)
def _rate(a, b, row, memory):
    """Return how fast the gap of a contact opens."""
    u0, u1, u2 = parting(a, b, row, memory.speeds)
    return u0 * row[NORMAL] + u1 * row[NORMAL + 1] + u2 * row[NORMAL + 2]


@kernel(_t.boolean(_t.int64, MEMORY))
def strikes(count, memory):
    """Note how fast the gaps open at the step; return whether a point strikes there, and write the floors of the impact if so."""
    pace, table = memory.pace, memory.table
    found = False
    for i in range(count):
        row = table[i]
        row[RATE] = _rate(memory.who[i, 0], memory.who[i, 1], row, memory)
        row[FLOOR] = 0.0 if row[GAP] <= row[AT_ONCE] * pace[WHOLE] * max(-row[RATE], row[HEED]) else -math.inf
        if row[FLOOR] == 0.0 and row[RATE] < -SPLITS * row[HEED]:
            found = True
    return found


@kernel(_t.float64(VECTOR, _t.int64), inline=True)
def _along(row, k):
    """Return how much of an impulse in a row is along its normal."""
    return row[k] * row[NORMAL] + row[k + 1] * row[NORMAL + 1] + row[k + 2] * row[NORMAL + 2]


@kernel(_t.boolean(VECTOR), inline=True)
def _hits(row):
    """Whether a point strikes, as against one that touches."""
    return row[FLOOR] == 0.0 and row[RATE] < -SPLITS * row[HEED]


@kernel(_t.boolean(_t.int64, _t.int64, MEMORY), inline=True)
def _alike(i, j, memory):
    """Whether two points are of the same two bodies."""
    return memory.who[i, FIRST] == memory.who[j, FIRST] and memory.who[i, FIRST + 1] == memory.who[j, FIRST + 1]


@kernel(_t.void(_t.int64, _t.float64, MEMORY))
def until_impact(count, before, memory):
    """Let what does not strike press until the impact, from the forces in the rows on."""
    for i in range(count):
        row = memory.table[i]
        row[HELD] = 0.0
        row[BORE] = max(_along(row, IMPULSE), 0.0)
        if row[RATE] < -SPLITS * row[HEED]:
            row[FLOOR] = -math.inf
        for k in range(3):
            row[IMPULSE + k] *= before
            row[SWERVE + k] = 0.0


@kernel(_t.boolean(_t.int64, _t.int64, _t.int64, _t.int64, LAYOUT, MEMORY))
def _hold(i, count, at, n, pile, memory):
    """Write a row for where the joint that is struck at a point pressed before, to leave as a given ratio says; return whether it pressed.

    Its points touched, or struck, with velocities u; afterwards the place where it pressed leaves with e (u - min u): in a plane that is
    the ratio e of spins (derived here). The points that pressed are left to this row. Which of them bore how much before goes over from one
    corner to the next as the stone turns, so that nothing hangs on their order: it is told by the forces of the step before, as the time
    until the impact may be none.
    """
    table, row = memory.table, memory.table[at]
    fastest, bore, load, touching, rate = 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(count):
        if _alike(i, j, memory) and table[j, FLOOR] == 0.0:
            fastest = min(fastest, table[j, RATE])
            if not _hits(table[j]):
                touching += 1.0
                bore += table[j, BORE]
                load += max(_along(table[j], GIVEN), 0.0)
    if touching == 0.0 or at >= table.shape[0]:
        return False
    for k in range(ARM_A, NORMAL + 3):
        row[k] = 0.0
    for j in range(count):
        point = table[j]
        if _alike(i, j, memory) and point[FLOOR] == 0.0 and not _hits(point):
            given = max(_along(point, GIVEN), 0.0)
            point[PART] = point[BORE] / bore if bore > 0.0 else given / load if load > 0.0 else 1.0 / touching
            for k in range(ARM_A, NORMAL + 3):
                row[k] += point[PART] * point[k]
            rate += point[PART] * point[RATE]
    for j in range(count):
        if table[j, PART] > 0.0 and _alike(i, j, memory):
            table[j, FLOOR] = -math.inf
    for k in range(3):
        row[IMPULSE + k] = 0.0
        row[SWERVE + k] = 0.0
    for k in range(memory.who.shape[1]):
        memory.who[at, k] = memory.who[i, k]
    answers(memory.who[at, 0], memory.who[at, 1], n, pile.inert, memory.inverses, row)
    row[FLOOR] = table[i, BOUNCE] * (rate - fastest)
    row[HELD] = 1.0
    return True


@kernel(_t.void(_t.int64, MEMORY))
def begin_impacts(count, memory):
    """Note what was given until the impacts."""
    for i in range(count):
        row = memory.table[i]
        for k in range(3):
            row[GIVEN + k] = row[IMPULSE + k]
            row[IMPULSE + k] = 0.0
            row[DEALT + k] = 0.0


@kernel(_t.int64(_t.int64, _t.int64, LAYOUT, MEMORY))
def at_impact(count, n, pile, memory):
    """Add a row for each joint that has a ratio and is struck; return how many rows there are."""
    rows = count
    for i in range(count):
        memory.table[i, PART] = 0.0
    for i in range(count):
        held = not (memory.table[i, BOUNCE] >= 0.0 and _hits(memory.table[i]))
        for j in range(count, rows):
            held = held or _alike(i, j, memory)
        if not held and _hold(i, count, rows, n, pile, memory):
            rows += 1
    return rows


@kernel(_t.void(_t.int64, _t.int64, MEMORY))
def end_impact(count, rows, memory):
    """Note what an impact gave; a joint that left with its ratio does so once in an instant."""
    for i in range(count):
        row = memory.table[i]
        for k in range(3):
            row[DEALT + k] += row[IMPULSE + k]
            row[IMPULSE + k] = 0.0
        for j in range(count, rows):
            if _alike(i, j, memory):
                row[BOUNCE] = -1.0


@kernel(_t.void(_t.int64, _t.int64, MEMORY))
def share(count, rows, memory):
    """Let the points that pressed bear what holds their joints."""
    for j in range(count, rows):
        for i in range(count):
            row = memory.table[i]
            if row[PART] > 0.0 and _alike(i, j, memory):
                for k in range(3):
                    row[IMPULSE + k] += row[PART] * memory.table[j, IMPULSE + k]


@kernel(_t.void(_t.int64, _t.int64, _t.int64, LAYOUT, MEMORY))
def let_go(count, rows, n, pile, memory):
    """Let no joint be held, so that the impact is plastic."""
    press(rows - count, memory.who[count:], memory.table[count:], n, pile.inert, -1.0, memory.speeds)
    for i in range(count):
        if memory.table[i, PART] > 0.0:
            memory.table[i, FLOOR] = 0.0


@kernel(_t.float64(_t.float64, _t.float64, _t.float64), inline=True)
def _closing(gap, rate, gain):
    """Return when a gap that opens at a rate, which grows by a gain, will have closed, s."""
    inside = rate * rate - 2.0 * gain * gap
    if inside < 0.0:
        return math.inf
    low = -rate + math.sqrt(inside)
    return 2.0 * gap / low if low > 0.0 else math.inf


@kernel(_t.float64(_t.int64, _t.float64, _t.float64, MEMORY))
def soonest(count, half, left, memory):
    """Return when the next impact comes, s, at the latest what is left of the step; mark with no floor what strikes then.

    Parameters
    ----------
    half : float, s
        For how long the velocities have gone on since the step.
    """
    whole, first = memory.pace[WHOLE], left
    fall = memory.pace[FALL]
    for i in range(count):
        row = memory.table[i]
        row[FLOOR] = 0.0
        brief = row[AT_ONCE] * whole
        if row[GAP] <= brief * max(-row[RATE], row[HEED]):
            continue
        gain = (_rate(memory.who[i, 0], memory.who[i, 1], row, memory) - row[RATE]) / half
        time = _closing(row[GAP], row[RATE], gain)
        if time < left + brief and row[RATE] + gain * time < -SPLITS * min(fall, max(-gain * whole, row[HEED])):
            row[FLOOR] = -math.inf
            row[HEADING] = time
            first = min(first, time)
    if first > left - BRIEF * whole:
        first = left
    for i in range(count):
        row = memory.table[i]
        if row[FLOOR] < 0.0 and row[HEADING] > first + 2.0 * row[AT_ONCE] * whole:
            row[FLOOR] = 0.0
    return first
