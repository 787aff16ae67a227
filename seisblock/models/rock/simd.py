"""SIMD step of rocking blocks: one sample of ``N_LANES`` blocks at a time, while no guard of any of them is in reach.

The operations are those of ``model.series`` and of the engine's step in the same order, so that results agree bit by bit. A branch-free
loop over lanes is vectorised by the compiler; data are stored as a structure of arrays, each field as ``N_LANES`` consecutive numbers.
"""

from __future__ import annotations

from dataclasses import replace

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR
from seisblock.dynamics.buffers import BATCH_FORCING, BATCH_STATE, MODE, N_SIMULTANEOUS, SAMPLE, SEGMENT_START
from seisblock.dynamics.extrema import HIGHEST, HIGHEST_TIME, LOWEST, LOWEST_TIME
from seisblock.dynamics.model_api import N_LANES, OFF, STRIDE
from seisblock.models.rock.expansion import FIFTH, NINTH, OMEGA, SEVENTH, SIXTH, THETA, THIRD, lean_bound, omega_coefficients, sine_cosine
from seisblock.models.rock.model import (
    ACROSS,
    ALONG,
    ALPHA_LEFT,
    ALPHA_RIGHT,
    BEYOND_RIGHT,
    GRAVITY,
    HALF_PI,
    IS_LINEAR,
    LEVER_LEFT,
    LEVER_RIGHT,
    REST,
    ROCKING,
    TO_RIGHT,
    UPWARD,
)

_t = types()

(
    LEAN, SPIN, SIDE, SIGNED_ALPHA, LEVER, LEAN_MIN, LEAN_MAX, HIGH, HIGH_TIME, LOW, LOW_TIME, WEIGHT, LANE_SAMPLE, LANE_BASE, IS_ACTIVE,
    GAIN_ALONG, GAIN_ACROSS, GAIN_UP, PUSH, PUSH_RATE, UP, UP_RATE,
) = (N_LANES * field for field in range(22))  # fmt: skip
"""Offsets of the fields: states; side s of the tilt (+1 or -1) and s alpha; lever; bounds of the tilt within which no guard fires; extrema
of theta with their times; gravity; sample number within the segment and first sample of the segment; active flag; gains; ground motion over
the sample."""

EXTREMUM_MARGIN = 1e-12
"""Relative margin against round-off in the tests for a new extremum and for a reversal of the angular velocity."""


@kernel(_t.int64(VECTOR, _t.float64), inline=True)
def _advance_lanes(lanes, dt):
    """Advance every active lane by one sample where no guard is in reach; return the number of lanes that became inactive."""
    inactive_count = 0
    for lane in range(N_LANES):
        theta, omega = lanes[LEAN + lane], lanes[SPIN + lane]
        lever, push, push_rate = lanes[LEVER + lane], lanes[PUSH + lane], lanes[PUSH_RATE + lane]
        weight, weight_rate = lanes[WEIGHT + lane] + lanes[UP + lane], lanes[UP_RATE + lane]
        sine, cosine = sine_cosine(lanes[SIGNED_ALPHA + lane] - theta)
        rate = -lever * (weight * sine + push * cosine)
        w2, w3, w4, w5, w6, w7, w8, w9, w10 = omega_coefficients(sine, cosine, omega, rate, lever, weight, weight_rate, push, push_rate)
        reach, converged = lean_bound(dt, omega, rate, w2, w3, w4, w5, w6, w7, w8, w9, w10)
        lean = lanes[SIDE + lane] * theta
        is_free = (lean - reach > lanes[LEAN_MIN + lane]) & (lean + reach < lanes[LEAN_MAX + lane])
        highest, lowest = lanes[HIGH + lane], lanes[LOW + lane]
        within_extrema = (theta + reach <= highest - EXTREMUM_MARGIN * abs(highest)) & (
            theta - reach >= lowest + EXTREMUM_MARGIN * abs(lowest)
        )
        # a reversal of the angular velocity inside the sample would hide an extremum
        monotone = reach < (2.0 - EXTREMUM_MARGIN) * dt * abs(omega)
        is_active = (lanes[IS_ACTIVE + lane] != 0.0) & converged & is_free & (within_extrema | monotone)
        high = w4 + dt * (w5 + dt * (w6 + dt * (w7 + dt * (w8 + dt * (w9 + dt * w10)))))
        spin = omega + dt * (rate + dt * (w2 + dt * (w3 + dt * high)))
        high = w5 * SIXTH + dt * (w6 * SEVENTH + dt * (w7 * 0.125 + dt * (w8 * NINTH + dt * (w9 * 0.1))))
        angle = theta + dt * (omega + dt * (rate * 0.5 + dt * (w2 * THIRD + dt * (w3 * 0.25 + dt * (w4 * FIFTH + dt * high)))))
        time = (lanes[LANE_BASE + lane] + lanes[LANE_SAMPLE + lane]) * dt + dt
        higher, lower = is_active & (angle > highest), is_active & (angle < lowest)
        lanes[HIGH + lane] = angle if higher else highest
        lanes[HIGH_TIME + lane] = time if higher else lanes[HIGH_TIME + lane]
        lanes[LOW + lane] = angle if lower else lowest
        lanes[LOW_TIME + lane] = time if lower else lanes[LOW_TIME + lane]
        inactive_count += (lanes[IS_ACTIVE + lane] != 0.0) & (not is_active)
        lanes[LEAN + lane] = angle if is_active else theta
        lanes[SPIN + lane] = spin if is_active else omega
        lanes[LANE_SAMPLE + lane] += 1.0 if is_active else 0.0
        lanes[IS_ACTIVE + lane] = 1.0 if is_active else 0.0
    return inactive_count


@kernel(_t.void(BATCH_FORCING, VECTOR), inline=True)
def _load_ground(grounds, lanes):
    """Load the ground motion over the current sample of each lane; a lane at the last sample is disabled by its bounds."""
    acceleration = grounds.acceleration
    per_dt = 1.0 / grounds.dt
    last = acceleration.shape[1] - 1
    for lane in range(N_LANES):
        sample = int(lanes[LANE_SAMPLE + lane])
        if sample == last:
            lanes[LEAN_MIN + lane] = OFF
            sample -= 1
        gain_along, gain_across, gain_up = lanes[GAIN_ALONG + lane], lanes[GAIN_ACROSS + lane], lanes[GAIN_UP + lane]
        value, next_value = acceleration[ALONG, sample], acceleration[ALONG, sample + 1]
        push, rate = gain_along * value, gain_along * (next_value - value) * per_dt
        value, next_value = acceleration[ACROSS, sample], acceleration[ACROSS, sample + 1]
        lanes[PUSH + lane] = push + gain_across * value
        lanes[PUSH_RATE + lane] = rate + gain_across * (next_value - value) * per_dt
        value, next_value = acceleration[UPWARD, sample], acceleration[UPWARD, sample + 1]
        lanes[UP + lane] = gain_up * value
        lanes[UP_RATE + lane] = gain_up * (next_value - value) * per_dt


@kernel(_t.void(BATCH_FORCING, MATRIX, BATCH_STATE, _t.int64, _t.int64, VECTOR), inline=True)
def _load_lane(grounds, parameters, rows, row, lane, lanes):
    """Copy the state of a rocking block into a lane."""
    mode = rows.counters[row, MODE]
    right = mode % 2 == TO_RIGHT
    alpha = parameters[row, ALPHA_RIGHT if right else ALPHA_LEFT]
    lanes[LEAN + lane] = rows.states[row, THETA]
    lanes[SPIN + lane] = rows.states[row, OMEGA]
    lanes[SIDE + lane] = 1.0 if right else -1.0
    lanes[SIGNED_ALPHA + lane] = alpha if right else -alpha
    lanes[LEVER + lane] = parameters[row, LEVER_RIGHT if right else LEVER_LEFT]
    lanes[LEAN_MIN + lane] = 0.0 if mode < BEYOND_RIGHT else alpha
    lanes[LEAN_MAX + lane] = alpha if mode < BEYOND_RIGHT else HALF_PI
    lanes[HIGH + lane], lanes[HIGH_TIME + lane] = rows.extrema[row, THETA, HIGHEST], rows.extrema[row, THETA, HIGHEST_TIME]
    lanes[LOW + lane], lanes[LOW_TIME + lane] = rows.extrema[row, THETA, LOWEST], rows.extrema[row, THETA, LOWEST_TIME]
    lanes[WEIGHT + lane] = parameters[row, GRAVITY]
    lanes[LANE_SAMPLE + lane] = rows.counters[row, SAMPLE] - rows.counters[row, SEGMENT_START]
    lanes[LANE_BASE + lane] = rows.counters[row, SEGMENT_START]
    lanes[IS_ACTIVE + lane] = 1.0
    lanes[GAIN_ALONG + lane] = grounds.gains[row, ALONG]
    lanes[GAIN_ACROSS + lane] = grounds.gains[row, ACROSS]
    lanes[GAIN_UP + lane] = grounds.gains[row, UPWARD]


@kernel(_t.void(BATCH_STATE, _t.int64, _t.int64, VECTOR), inline=True)
def _store_lane(rows, row, lane, lanes):
    """Copy the state of a lane back to its row."""
    rows.states[row, THETA], rows.states[row, OMEGA] = lanes[LEAN + lane], lanes[SPIN + lane]
    rows.extrema[row, THETA, HIGHEST], rows.extrema[row, THETA, HIGHEST_TIME] = lanes[HIGH + lane], lanes[HIGH_TIME + lane]
    rows.extrema[row, THETA, LOWEST], rows.extrema[row, THETA, LOWEST_TIME] = lanes[LOW + lane], lanes[LOW_TIME + lane]
    sample = rows.counters[row, SEGMENT_START] + int(lanes[LANE_SAMPLE + lane])
    if sample > rows.counters[row, SAMPLE]:
        rows.counters[row, N_SIMULTANEOUS] = 0
    rows.counters[row, SAMPLE] = sample


@kernel(STRIDE)
def advance_rows(grounds, parameters, rows, row_ids, is_waiting, lanes, max_samples):
    """Advance rocking blocks together, see ``STRIDE``; blocks at rest and the linear option are left to the scalar engine."""
    active_count = 0
    for lane in range(N_LANES):
        row = row_ids[lane]
        if is_waiting[lane] != 0 and row >= 0 and rows.counters[row, MODE] != REST and parameters[row, IS_LINEAR] == 0.0:
            _load_lane(grounds, parameters, rows, row, lane, lanes)
            is_waiting[lane] = 0
        active_count += is_waiting[lane] == 0
    sample_count = 0
    inactive_count = int(active_count == 0)
    while sample_count < max_samples * active_count and inactive_count == 0:
        _load_ground(grounds, lanes)
        inactive_count = _advance_lanes(lanes, grounds.dt)
        sample_count += active_count - inactive_count
    for lane in range(N_LANES):
        if is_waiting[lane] == 0 and lanes[IS_ACTIVE + lane] == 0.0:
            is_waiting[lane] = 1
            _store_lane(rows, row_ids[lane], lane, lanes)
    return sample_count


ROCKING_SIMD_MODEL = replace(ROCKING, stride=advance_rows)
"""Rocking model with the SIMD step, for batches."""
