"""Velocity bounds of constraint rows (gap closure, Baumgarte correction) and their rotation and rolling bias."""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import VECTOR
from seisblock.models.stack.buffers import MEMORY
from seisblock.models.stack.constraint_assembly import FREE_FALL_SPEED, FULL_STEP, MIN_FORCE_TIME_RATIO
from seisblock.models.stack.constraint_row import ARM_A, ARM_B, BILATERAL, GAP, GYROSCOPIC, MIN_NORMAL_VELOCITY, RIM_RADIUS, ROTATION_BIAS
from seisblock.models.stack.cylinder import rolling_bias
from seisblock.models.stack.pgs import TOLERANCE

_t = types()

MIN_STEP_RATIO = 0.00390625
"""Shortest step that ends because a rim's lowest point has moved too far, over a full step."""

BAUMGARTE_FACTOR, MAX_CORRECTION_RATIO = 0.2, 1.5
"""Share of an overlap corrected per step (Baumgarte stabilisation), and largest speed of the correction over that of a free fall over a
full step."""


@kernel(_t.void(VECTOR, VECTOR, _t.float64, VECTOR), inline=True)
def _add_rotation_bias(velocity, arm, half, bias):
    """Add the change of a body point's velocity by rotation over a time: w x (w x r) + w' x r (derived here)."""
    x, y, z = velocity[3], velocity[4], velocity[5]
    projection = x * arm[0] + y * arm[1] + z * arm[2]
    square = x * x + y * y + z * z
    bias[0] += half * (x * projection - square * arm[0])
    bias[1] += half * (y * projection - square * arm[1])
    bias[2] += half * (z * projection - square * arm[2])
    # above: w x (w x r) = w (w r) - w^2 r; below: w' x r
    x, y, z = velocity[GYROSCOPIC], velocity[GYROSCOPIC + 1], velocity[GYROSCOPIC + 2]
    bias[0] += half * (y * arm[2] - z * arm[1])
    bias[1] += half * (z * arm[0] - x * arm[2])
    bias[2] += half * (x * arm[1] - y * arm[0])


@kernel(_t.float64(_t.int64, _t.int64, _t.float64, VECTOR, VECTOR, MEMORY), inline=True)
def _rolling_bias(a, b, dt, row, bias, memory):
    """Add the rolling bias of a rim contact for the relative spin of two bodies; return the time until it has moved far, s."""
    u, v = memory.body_velocities[a], memory.body_velocities[b]
    return rolling_bias(row, u[3] - v[3], u[4] - v[4], u[5] - v[5], dt, bias)


@kernel(_t.float64(_t.int64, _t.float64, MEMORY))
def max_roll_time(count, time_left, memory):
    """Return the time until the lowest point of a rim has moved too far round it, s, at most the remainder of the step."""
    bias, min_time = memory.scratch[0], time_left
    for i in range(count):
        if memory.constraint_rows[i, RIM_RADIUS] != 0.0:
            min_time = min(
                min_time,
                _rolling_bias(memory.contact_ids[i, 0], memory.contact_ids[i, 1], time_left, memory.constraint_rows[i], bias, memory),
            )
    # a fast rim must not cut the step to nothing
    return min(time_left, max(min_time, MIN_STEP_RATIO * memory.step_info[FULL_STEP]))


@kernel(_t.void(_t.int64, _t.float64, MEMORY), inline=True)
def set_velocity_bounds(count, dt, memory):
    """Write the velocity bounds of a step: an open gap may just close, an overlap opens slowly.

    A gap within the solver tolerance counts as closed: in a short step its contact would otherwise stay inactive and overload the others.
    """
    full_step = memory.step_info[FULL_STEP]
    free_fall_speed = memory.step_info[FREE_FALL_SPEED]
    gap_tolerance, closing_time = TOLERANCE * free_fall_speed * full_step, max(dt, MIN_FORCE_TIME_RATIO * full_step)
    for i in range(count):
        row, gap, a, b = memory.constraint_rows[i], memory.constraint_rows[i, GAP], memory.contact_ids[i, 0], memory.contact_ids[i, 1]
        row[BILATERAL] = 0.0
        # zero marks an active contact; contacts that strike later keep minus infinity
        if row[MIN_NORMAL_VELOCITY] == 0.0:
            # Baumgarte correction: overlaps are reduced by a fixed share per step, with limited speed, so that they add no energy
            row[MIN_NORMAL_VELOCITY] = (
                -gap / (dt if gap > gap_tolerance else closing_time)
                if gap > 0.0
                else min(-BAUMGARTE_FACTOR * gap / full_step, MAX_CORRECTION_RATIO * free_fall_speed)
            )
        for k in range(3):
            row[ROTATION_BIAS + k] = 0.0
        if row[RIM_RADIUS] != 0.0:
            _rolling_bias(a, b, dt, row, row[ROTATION_BIAS:], memory)
        # the velocity bound applies at the middle of the coming step, hence half of it; the signs are those of the
        # relative velocity
        _add_rotation_bias(memory.body_velocities[a], row[ARM_A:], 0.5 * dt, row[ROTATION_BIAS:])
        _add_rotation_bias(memory.body_velocities[b], row[ARM_B:], -0.5 * dt, row[ROTATION_BIAS:])
