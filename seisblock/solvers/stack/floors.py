"""What a step asks of its points: the least velocities they may have at its end, and how these change as their bodies turn and roll."""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import VECTOR
from seisblock.solvers.stack.arguments import MEMORY
from seisblock.solvers.stack.impulse import ARM_A, ARM_B, FLOOR, GAP, HELD, RIM, SWERVE, VEERING
from seisblock.solvers.stack.round import roll
from seisblock.solvers.stack.row import FALL, HASTY, WHOLE
from seisblock.solvers.stack.sweeps import PRECISION

_t = types()

SHORTEST = 0.00390625
"""Of a whole step: the least that one has that ends since a rim's lowest point has wandered far."""

MENDED, GENTLY = 0.2, 0.05
"""Part of a gap closed too far that a step makes good, and the speed, m/s, that it may take for it."""


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
    """Write the least normal velocities of a step: an open gap may close and no more, one closed too far opens slowly.

    A gap that the tolerance of the sweeps left is none: a step that is short would let its point do nothing, and the others bear its part.
    """
    whole = memory.pace[WHOLE]
    left, long = PRECISION * memory.pace[FALL] * whole, max(dt, HASTY * whole)
    for i in range(count):
        row, gap, a, b = memory.table[i], memory.table[i, GAP], memory.who[i, 0], memory.who[i, 1]
        row[HELD] = 0.0
        if row[FLOOR] == 0.0:
            row[FLOOR] = -gap / (dt if gap > left else long) if gap > 0.0 else min(-MENDED * gap / whole, GENTLY)
        for k in range(3):
            row[SWERVE + k] = 0.0
        if row[RIM] != 0.0:
            _roll(a, b, dt, row, row[SWERVE:], memory)
        _swerve(memory.speeds[a], row[ARM_A:], 0.5 * dt, row[SWERVE:])
        _swerve(memory.speeds[b], row[ARM_B:], -0.5 * dt, row[SWERVE:])
