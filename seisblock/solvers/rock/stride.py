"""Many rocking blocks side by side: one sample of each at a time, while none of them does more than rock on.

The operations are those of ``series`` and of the engine's step, in their order, so that the bits are the same. A loop over lanes without a
branch is what a compiler turns into vectors; numbers of a lane lie ``LANES`` apart, for each number the lanes side by side.
"""

from __future__ import annotations

from dataclasses import replace

from seisblock._jit import kernel, types
from seisblock.dynamics.arguments import AT_ONE_INSTANT, BASE, GROUNDS, MODE, ROWS, SAMPLE
from seisblock.dynamics.arrays import MATRIX, VECTOR
from seisblock.dynamics.contract import LANES, OFF, STRIDE
from seisblock.dynamics.extrema import HIGHEST, HIGHEST_TIME, LOWEST, LOWEST_TIME
from seisblock.solvers.rock.expansion import (
    FIFTH,
    NINTH,
    OMEGA,
    SEVENTH,
    SIXTH,
    THETA,
    THIRD,
    rates,
    sine_cosine_of,
    within,
)
from seisblock.solvers.rock.model import (
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
    LEAN, SPIN, SIDE, FOOT, LEVER, DOWN, OVER, HIGH, HIGH_TIME, LOW, LOW_TIME, WEIGHT, AT, FROM, MOVES,
    SHARE_ALONG, SHARE_ACROSS, SHARE_UP, PUSH, PUSH_RATE, UP, UP_RATE,
) = (LANES * field for field in range(22))  # fmt: skip
"""Where the numbers of the lanes begin: the states; the side, +1 or -1, to which a block leans, and s alpha; its lever; the bounds of its
lean within which no guard fires; the extrema of theta; gravity; the sample, counted from that number of the motion; whether the lane moves;
gains; the ground's motion over the sample."""

CLEAR = 1e-12
"""A lean that stays below an extremum by this share of it is no new one, and a rate that stays above zero by it turns not, whatever the
round-off."""


@kernel(_t.int64(VECTOR, _t.float64), inline=True)
def _rock_on(lanes, dt):
    """Move every lane on that may, by one sample; return how many stopped."""
    stopped = 0
    for lane in range(LANES):
        theta, omega = lanes[LEAN + lane], lanes[SPIN + lane]
        lever, push, push_rate = lanes[LEVER + lane], lanes[PUSH + lane], lanes[PUSH_RATE + lane]
        weight, weight_rate = lanes[WEIGHT + lane] + lanes[UP + lane], lanes[UP_RATE + lane]
        sine, cosine = sine_cosine_of(lanes[FOOT + lane] - theta)
        rate = -lever * (weight * sine + push * cosine)
        w2, w3, w4, w5, w6, w7, w8, w9, w10 = rates(sine, cosine, omega, rate, lever, weight, weight_rate, push, push_rate)
        reach, converged = within(dt, omega, rate, w2, w3, w4, w5, w6, w7, w8, w9, w10)
        lean = lanes[SIDE + lane] * theta
        free = (lean - reach > lanes[DOWN + lane]) & (lean + reach < lanes[OVER + lane])
        highest, lowest = lanes[HIGH + lane], lanes[LOW + lane]
        known = (theta + reach <= highest - CLEAR * abs(highest)) & (theta - reach >= lowest + CLEAR * abs(lowest))
        monotone = reach < (2.0 - CLEAR) * dt * abs(omega)
        moves = (lanes[MOVES + lane] != 0.0) & converged & free & (known | monotone)
        high = w4 + dt * (w5 + dt * (w6 + dt * (w7 + dt * (w8 + dt * (w9 + dt * w10)))))
        spin = omega + dt * (rate + dt * (w2 + dt * (w3 + dt * high)))
        high = w5 * SIXTH + dt * (w6 * SEVENTH + dt * (w7 * 0.125 + dt * (w8 * NINTH + dt * (w9 * 0.1))))
        angle = theta + dt * (omega + dt * (rate * 0.5 + dt * (w2 * THIRD + dt * (w3 * 0.25 + dt * (w4 * FIFTH + dt * high)))))
        then = (lanes[FROM + lane] + lanes[AT + lane]) * dt + dt
        higher, lower = moves & (angle > highest), moves & (angle < lowest)
        lanes[HIGH + lane] = angle if higher else highest
        lanes[HIGH_TIME + lane] = then if higher else lanes[HIGH_TIME + lane]
        lanes[LOW + lane] = angle if lower else lowest
        lanes[LOW_TIME + lane] = then if lower else lanes[LOW_TIME + lane]
        stopped += (lanes[MOVES + lane] != 0.0) & (not moves)
        lanes[LEAN + lane] = angle if moves else theta
        lanes[SPIN + lane] = spin if moves else omega
        lanes[AT + lane] += 1.0 if moves else 0.0
        lanes[MOVES + lane] = 1.0 if moves else 0.0
    return stopped


@kernel(_t.void(GROUNDS, VECTOR), inline=True)
def _look_at_the_ground(grounds, lanes):
    """Read the ground's motion over the sample at which each lane is; there is none after the last, where none moves."""
    acceleration = grounds.acceleration
    per_dt = 1.0 / grounds.dt
    last = acceleration.shape[1] - 1
    for lane in range(LANES):
        sample = int(lanes[AT + lane])
        if sample == last:
            lanes[DOWN + lane] = OFF
            sample -= 1
        along, across, up = lanes[SHARE_ALONG + lane], lanes[SHARE_ACROSS + lane], lanes[SHARE_UP + lane]
        here, there = acceleration[ALONG, sample], acceleration[ALONG, sample + 1]
        push, rate = along * here, along * (there - here) * per_dt
        here, there = acceleration[ACROSS, sample], acceleration[ACROSS, sample + 1]
        lanes[PUSH + lane] = push + across * here
        lanes[PUSH_RATE + lane] = rate + across * (there - here) * per_dt
        here, there = acceleration[UPWARD, sample], acceleration[UPWARD, sample + 1]
        lanes[UP + lane] = up * here
        lanes[UP_RATE + lane] = up * (there - here) * per_dt


@kernel(_t.void(GROUNDS, MATRIX, ROWS, _t.int64, _t.int64, VECTOR), inline=True)
def _enter(grounds, parameters, rows, row, lane, lanes):
    """Put a block that rocks into a lane."""
    mode = rows.places[row, MODE]
    right = mode % 2 == TO_RIGHT
    alpha = parameters[row, ALPHA_RIGHT if right else ALPHA_LEFT]
    lanes[LEAN + lane] = rows.states[row, THETA]
    lanes[SPIN + lane] = rows.states[row, OMEGA]
    lanes[SIDE + lane] = 1.0 if right else -1.0
    lanes[FOOT + lane] = alpha if right else -alpha
    lanes[LEVER + lane] = parameters[row, LEVER_RIGHT if right else LEVER_LEFT]
    lanes[DOWN + lane] = 0.0 if mode < BEYOND_RIGHT else alpha
    lanes[OVER + lane] = alpha if mode < BEYOND_RIGHT else HALF_PI
    lanes[HIGH + lane], lanes[HIGH_TIME + lane] = rows.extrema[row, THETA, HIGHEST], rows.extrema[row, THETA, HIGHEST_TIME]
    lanes[LOW + lane], lanes[LOW_TIME + lane] = rows.extrema[row, THETA, LOWEST], rows.extrema[row, THETA, LOWEST_TIME]
    lanes[WEIGHT + lane] = parameters[row, GRAVITY]
    lanes[AT + lane] = rows.places[row, SAMPLE] - rows.places[row, BASE]
    lanes[FROM + lane] = rows.places[row, BASE]
    lanes[MOVES + lane] = 1.0
    lanes[SHARE_ALONG + lane] = grounds.gains[row, ALONG]
    lanes[SHARE_ACROSS + lane] = grounds.gains[row, ACROSS]
    lanes[SHARE_UP + lane] = grounds.gains[row, UPWARD]


@kernel(_t.void(ROWS, _t.int64, _t.int64, VECTOR), inline=True)
def _leave(rows, row, lane, lanes):
    """Write back where the block in a lane is."""
    rows.states[row, THETA], rows.states[row, OMEGA] = lanes[LEAN + lane], lanes[SPIN + lane]
    rows.extrema[row, THETA, HIGHEST], rows.extrema[row, THETA, HIGHEST_TIME] = lanes[HIGH + lane], lanes[HIGH_TIME + lane]
    rows.extrema[row, THETA, LOWEST], rows.extrema[row, THETA, LOWEST_TIME] = lanes[LOW + lane], lanes[LOW_TIME + lane]
    sample = rows.places[row, BASE] + int(lanes[AT + lane])
    if sample > rows.places[row, SAMPLE]:
        rows.places[row, AT_ONE_INSTANT] = 0
    rows.places[row, SAMPLE] = sample


@kernel(STRIDE)
def stride(grounds, parameters, rows, chosen, waits, lanes, most):
    """Move rocking blocks on together; see ``STRIDE``. The linear option, and what rests, wait for the engine."""
    moving = 0
    for lane in range(LANES):
        row = chosen[lane]
        if waits[lane] != 0:
            lanes[MOVES + lane] = 0.0
            if row >= 0 and rows.places[row, MODE] != REST and parameters[row, IS_LINEAR] == 0.0:
                _enter(grounds, parameters, rows, row, lane, lanes)
                waits[lane] = 0
        moving += waits[lane] == 0
    passed = 0
    stopped = moving == 0
    while passed < most * moving and not stopped:
        _look_at_the_ground(grounds, lanes)
        stopped = _rock_on(lanes, grounds.dt)
        passed += moving - stopped
    for lane in range(LANES):
        if waits[lane] == 0 and lanes[MOVES + lane] == 0.0:
            waits[lane] = 1
            _leave(rows, chosen[lane], lane, lanes)
    return passed


ROCKING_TOGETHER = replace(ROCKING, stride=stride)
"""The rocking block for many runs at once."""
