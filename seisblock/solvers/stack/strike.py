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
from seisblock.solvers.stack.arguments import MEMORY
from seisblock.solvers.stack.impulse import (
    ARM_A,
    ARM_B,
    AT_ONCE,
    BOUNCE,
    FLOOR,
    GAP,
    GIVEN,
    HEADING,
    HEED,
    HELD,
    IMPULSE,
    NORMAL,
    RATE,
    RIM,
    SWERVE,
    VEERING,
    parting,
)
from seisblock.solvers.stack.round import roll
from seisblock.solvers.stack.row import BRIEF, FALL, FIRST, WHOLE

_t = types()

SPLITS = 0.25
"""Approach, over what a gap's own acceleration changes it by in a step, from which an impact ends a step: half a step passes then until
it is back. Of what presses it is that of a free fall."""

SHORTEST = 0.00390625
"""Of a whole step: the least that one has that ends since a rim's lowest point has wandered far."""

MENDED, GENTLY = 0.2, 0.05
"""Part of a gap closed too far that a step makes good, and the speed, m/s, that it may take for it."""


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


@kernel(_t.int64(_t.int64, _t.int64, MEMORY), inline=True)
def _opposite(i, count, memory):
    """Return the row of the point of the same bodies that is farthest from one."""
    found, most = i, 0.0
    x, y, z = memory.table[i, ARM_B], memory.table[i, ARM_B + 1], memory.table[i, ARM_B + 2]
    for j in range(count):
        if memory.who[j, FIRST] != memory.who[i, FIRST] or memory.who[j, FIRST + 1] != memory.who[i, FIRST + 1]:
            continue
        row = memory.table[j]
        away = (row[ARM_B] - x) ** 2 + (row[ARM_B + 1] - y) ** 2 + (row[ARM_B + 2] - z) ** 2
        if away > most:
            found, most = j, away
    return found


@kernel(_t.void(_t.int64, _t.float64, MEMORY))
def until_impact(count, before, memory):
    """Let what does not strike press until the impact, from the forces in the rows on."""
    for i in range(count):
        row = memory.table[i]
        row[HELD] = 0.0
        if row[RATE] < -SPLITS * row[HEED]:
            row[FLOOR] = -math.inf
        for k in range(3):
            row[IMPULSE + k] *= before
            row[SWERVE + k] = 0.0


@kernel(_t.boolean(_t.int64, MEMORY))
def at_impact(count, memory):
    """Note what was given until the impact, and let what stands opposite of what strikes leave with its part; return whether any does."""
    held = False
    strikes(count, memory)
    for i in range(count):
        row = memory.table[i]
        for k in range(3):
            row[GIVEN + k] = row[IMPULSE + k]
            row[IMPULSE + k] = 0.0
    for i in range(count):
        row = memory.table[i]
        if row[BOUNCE] >= 0.0 and row[FLOOR] == 0.0 and row[RATE] < -SPLITS * row[HEED]:
            other = memory.table[_opposite(i, count, memory)]
            # what has left already is held by nobody
            if other[FLOOR] > -math.inf:
                other[FLOOR] = -row[BOUNCE] * row[RATE]
                other[HELD] = 1.0
                held = True
    return held


@kernel(_t.void(_t.int64, MEMORY))
def let_go(count, memory):
    """Let no point be held, so that the impact is plastic."""
    for i in range(count):
        row = memory.table[i]
        if row[HELD] > 0.0:
            row[HELD] = 0.0
            row[FLOOR] = 0.0


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


@kernel(_t.void(VECTOR, VECTOR, _t.float64, VECTOR), inline=True)
def _swerve(speeds, arm, half, swerve):
    """Add how a body's point at `arm` changes its velocity by the body's turning in a time: w x (w x r) + w' x r."""
    x, y, z = speeds[3], speeds[4], speeds[5]
    along = x * arm[0] + y * arm[1] + z * arm[2]
    square = x * x + y * y + z * z
    swerve[0] += half * (x * along - square * arm[0])
    swerve[1] += half * (y * along - square * arm[1])
    swerve[2] += half * (z * along - square * arm[2])
    x, y, z = speeds[VEERING], speeds[VEERING + 1], speeds[VEERING + 2]
    swerve[0] += half * (y * arm[2] - z * arm[1])
    swerve[1] += half * (z * arm[0] - x * arm[2])
    swerve[2] += half * (x * arm[1] - y * arm[0])


@kernel(_t.float64(_t.int64, _t.int64, _t.float64, VECTOR, VECTOR, MEMORY), inline=True)
def _roll(a, b, dt, row, swerve, memory):
    """Add what :func:`seisblock.solvers.stack.round.roll` does with the spins of two bodies, and return what it returns."""
    u, v = memory.speeds[a], memory.speeds[b]
    return roll(row, u[3] - v[3], u[4] - v[4], u[5] - v[5], dt, swerve)


@kernel(_t.float64(_t.int64, _t.float64, MEMORY))
def far_round(count, left, memory):
    """Return when the lowest point of a rim will have wandered far round it, s, at the latest what is left of the step."""
    swerve, first = memory.work[0], left
    for i in range(count):
        if memory.table[i, RIM] != 0.0:
            first = min(first, _roll(memory.who[i, 0], memory.who[i, 1], left, memory.table[i], swerve, memory))
    return min(left, max(first, SHORTEST * memory.pace[WHOLE]))


@kernel(_t.void(_t.int64, _t.float64, MEMORY), inline=True)
def lay_floors(count, dt, memory):
    """Write the least normal velocities of a step: an open gap may close and no more, one closed too far opens slowly."""
    for i in range(count):
        row, gap, a, b = memory.table[i], memory.table[i, GAP], memory.who[i, 0], memory.who[i, 1]
        row[HELD] = 0.0
        if row[FLOOR] == 0.0:
            row[FLOOR] = -gap / dt if gap > 0.0 else min(-MENDED * gap / memory.pace[WHOLE], GENTLY)
        for k in range(3):
            row[SWERVE + k] = 0.0
        if row[RIM] != 0.0:
            _roll(a, b, dt, row, row[SWERVE:], memory)
        _swerve(memory.speeds[a], row[ARM_A:], 0.5 * dt, row[SWERVE:])
        _swerve(memory.speeds[b], row[ARM_B:], -0.5 * dt, row[SWERVE:])
