"""Hybrid model of a rigid block rocking about its two lower corners: modes, guards and power series for the engine.

Assumptions
    Plane motion; rigid block and rigid ground; pure rotation about the corner in contact (sufficient friction, no loss of contact); an
    impact multiplies the angular velocity by the restitution.
Sign
    theta is positive for a tilt to +x, about the right corner, with s = +1; s = -1 for a tilt to -x.
Equation
    With psi = s alpha - theta, ground acceleration a (along +x) and a_v (up), and m R/I_O of the corner in contact
    ([Housner1963]_, with the vertical motion added to gravity)::

        theta'' = -(m R/I_O) [(g + a_v) sin(psi) + a cos(psi)]

    The linear (slender) option replaces sin(psi) by psi and cos(psi) by 1 ([Zhang2001]_ eqs. (4), (5)).
Ground motion
    a is the sum of the two horizontal rows, each times its gain: one row along +x, or both for a rotated motion.
Rest
    The block rests while abs(a) < (g + a_v) tan(alpha) (alpha for tan(alpha) in the linear option). After an impact it comes to rest
    if the next impact would follow within ``REST_HOP`` = 1e-8 s, the stated accuracy of all times: the neglected impacts fall within the
    next 1e-8/(1 - e) s, with tilts of at most theta''/8 * (1e-8 s)^2, below 1e-15 rad.
Beyond alpha
    A block beyond alpha may return; overturning is theta = pi/2.
"""

from __future__ import annotations

import math

import numpy as np

from seisblock._jit import kernel, types
from seisblock.core.i18n import N_, Term
from seisblock.core.typing import FloatArray
from seisblock.dynamics import Model
from seisblock.dynamics.array_types import MATRIX
from seisblock.dynamics.model_api import CONSTANT, OFF, RESET, SERIES, SKIP
from seisblock.models.rock.expansion import (
    COSINE,
    FIFTH,
    NINTH,
    OMEGA,
    SEVENTH,
    SINE,
    SIXTH,
    TERMS,
    THETA,
    THIRD,
    expand_series,
    lean_bound,
    omega_coefficients,
    sine_cosine,
)
from seisblock.models.rock.params import RockBatchParams, RockParams

_t = types()

# odd: about the right corner; above TO_LEFT: beyond alpha
REST, TO_RIGHT, TO_LEFT, BEYOND_RIGHT, BEYOND_LEFT = range(5)
OVERTURNED = -1
LOWER_BOUND, UPPER_BOUND = range(2)
ALONG, ACROSS, UPWARD = range(3)
(
    GRAVITY,
    DT,
    IS_LINEAR,
    MIN_HOP,
    ALPHA_RIGHT,
    ALPHA_LEFT,
    THRESHOLD_RIGHT,
    THRESHOLD_LEFT,
    LEVER_RIGHT,
    LEVER_LEFT,
    RESTITUTION_RIGHT,
    RESTITUTION_LEFT,
) = range(12)

REST_HOP = 1e-8
"""Time between two impacts below which rocking ends by default, s."""


class RockPhase(Term):
    """Modes by number, and names of the phases."""

    REST = N_("rest")
    TO_RIGHT = N_("rocks to +x")
    TO_LEFT = N_("rocks to -x")
    BEYOND_RIGHT = N_("beyond +alpha")
    BEYOND_LEFT = N_("beyond -alpha")
    OVERTURNED = N_("overturned")


MODES = tuple(RockPhase)

HALF_PI = math.pi / 2


def parameters(params: RockParams | RockBatchParams, dt: float, min_hop: float = REST_HOP) -> FloatArray:
    """Return the parameter vector of the model, ``GRAVITY`` to ``RESTITUTION_LEFT``: (12,) of one block, (m, 12) of many.

    `min_hop` is the time between two impacts, s, below which rocking ends.
    """
    corners = np.concatenate([params.alphas, params.thresholds, params.levers, params.restitutions], axis=-1)
    common_values = np.broadcast_to([params.gravity, dt, float(params.linear), min_hop], (*corners.shape[:-1], 4))
    return np.concatenate([common_values, corners], axis=-1)


@kernel(_t.void(MATRIX, MATRIX, _t.int64, _t.float64, _t.float64, _t.int64, _t.boolean), inline=True)
def _write_guard(c, g, guard, s, bound, degree, is_clear):
    """Write the guard of a lower or upper bound of the tilt s theta; switch the guard off where the bound is out of reach."""
    if is_clear:
        g[guard, 0] = OFF
        return
    sign = s if guard == LOWER_BOUND else -s
    for k in range(degree + 1):
        g[guard, k] = sign * c[THETA, k]
    g[guard, 0] -= bound if guard == LOWER_BOUND else -bound


@kernel(SERIES)
def series(mode, y, f, p, order, c, g):
    """Write the power series of tilt, angular velocity and guards of one mode; return the degree."""
    weight = p[GRAVITY] + f[UPWARD, 0]
    weight_rate = f[UPWARD, 1]
    push = f[ALONG, 0] + f[ACROSS, 0]
    push_rate = f[ALONG, 1] + f[ACROSS, 1]
    if mode == REST:
        # restoring minus driving moment about each corner, over m R cos(alpha): linear in time between samples
        g[0, 0] = weight * p[THRESHOLD_RIGHT] + push
        g[0, 1] = weight_rate * p[THRESHOLD_RIGHT] + push_rate
        g[1, 0] = weight * p[THRESHOLD_LEFT] - push
        g[1, 1] = weight_rate * p[THRESHOLD_LEFT] - push_rate
        return CONSTANT
    if mode % 2 == TO_RIGHT:
        s, alpha, lever, threshold = 1.0, p[ALPHA_RIGHT], p[LEVER_RIGHT], p[THRESHOLD_RIGHT]
    else:
        s, alpha, lever, threshold = -1.0, p[ALPHA_LEFT], p[LEVER_LEFT], p[THRESHOLD_LEFT]
    theta = y[THETA]
    omega = y[OMEGA]
    sine, cosine = (s * alpha - theta, 1.0) if p[IS_LINEAR] != 0.0 else sine_cosine(s * alpha - theta)
    rate = -lever * (weight * sine + push * cosine)
    if theta == 0.0 and omega == 0.0:
        # rocking starts exactly at the threshold, where the moment is zero up to round-off: no start in the wrong direction
        rate = -lever * cosine * (weight * s * threshold + push)
        if rate * s < 0.0:
            rate = 0.0
    c[THETA, 0], c[THETA, 1], c[OMEGA, 0], c[OMEGA, 1], c[SINE, 0], c[COSINE, 0] = theta, omega, omega, rate, sine, cosine
    # the potential barrier splits the swing into two modes, so that the log tells when alpha is passed
    lower_bound, upper_bound = (0.0, alpha) if mode < BEYOND_RIGHT else (alpha, HALF_PI)
    lean = s * theta
    if p[IS_LINEAR] == 0.0:
        w2, w3, w4, w5, w6, w7, w8, w9, w10 = omega_coefficients(sine, cosine, omega, rate, lever, weight, weight_rate, push, push_rate)
        reach, converged = lean_bound(p[DT], omega, rate, w2, w3, w4, w5, w6, w7, w8, w9, w10)
        # the unrolled series serves nearly every step; the loop below takes over for small blocks and coarse records
        if converged:
            c[OMEGA, 2], c[OMEGA, 3], c[OMEGA, 4], c[OMEGA, 5], c[OMEGA, 6] = w2, w3, w4, w5, w6
            c[OMEGA, 7], c[OMEGA, 8], c[OMEGA, 9], c[OMEGA, 10] = w7, w8, w9, w10
            c[THETA, 2], c[THETA, 3], c[THETA, 4] = rate * 0.5, w2 * THIRD, w3 * 0.25
            c[THETA, 5], c[THETA, 6], c[THETA, 7] = w4 * FIFTH, w5 * SIXTH, w6 * SEVENTH
            c[THETA, 8], c[THETA, 9], c[THETA, 10] = w7 * 0.125, w8 * NINTH, w9 * 0.1
            _write_guard(c, g, LOWER_BOUND, s, lower_bound, TERMS, lean - reach > lower_bound)
            _write_guard(c, g, UPPER_BOUND, s, upper_bound, TERMS, lean + reach < upper_bound)
            return TERMS
    degree = expand_series(c, order, p[IS_LINEAR] != 0.0, p[DT], lever, weight, weight_rate, push, push_rate)
    # the loop has no bound of the tilt: both guards stay on
    _write_guard(c, g, LOWER_BOUND, s, lower_bound, degree, False)
    _write_guard(c, g, UPPER_BOUND, s, upper_bound, degree, False)
    return degree


@kernel(RESET)
def reset(mode, guard, y, f, p):
    """Return the mode after the start of rocking, an impact, a crossing of alpha in either direction, or overturning."""
    if mode == REST:
        return TO_RIGHT if guard == 0 else TO_LEFT
    if mode > TO_LEFT:
        s, alpha = (1.0, p[ALPHA_RIGHT]) if mode == BEYOND_RIGHT else (-1.0, p[ALPHA_LEFT])
        if guard == UPPER_BOUND:
            y[THETA] = s * HALF_PI
            return OVERTURNED
        # the bound itself, not the root found: round-off must not leave the block on the wrong side of alpha
        y[THETA] = s * alpha
        return TO_RIGHT if mode == BEYOND_RIGHT else TO_LEFT
    if guard == UPPER_BOUND:
        y[THETA] = p[ALPHA_RIGHT] if mode == TO_RIGHT else -p[ALPHA_LEFT]
        return BEYOND_RIGHT if mode == TO_RIGHT else BEYOND_LEFT
    # impact: the pivot changes to the other corner, the angular velocity keeps its sign
    y[THETA] = 0.0
    weight = p[GRAVITY] + f[UPWARD, 0]
    push = f[ALONG, 0] + f[ACROSS, 0]
    # the restitution is that of the corner which is struck, the next pivot
    if mode == TO_LEFT:
        y[OMEGA] *= p[RESTITUTION_RIGHT]
        slack = weight * p[THRESHOLD_RIGHT] + push
        restoring_acceleration = p[LEVER_RIGHT] * slack * (1.0 if p[IS_LINEAR] != 0.0 else math.cos(p[ALPHA_RIGHT]))
        target_mode = TO_RIGHT
    else:
        y[OMEGA] *= p[RESTITUTION_LEFT]
        slack = weight * p[THRESHOLD_LEFT] - push
        restoring_acceleration = p[LEVER_LEFT] * slack * (1.0 if p[IS_LINEAR] != 0.0 else math.cos(p[ALPHA_LEFT]))
        target_mode = TO_LEFT
    # duration of the next hop, 2 omega/theta''
    if 2.0 * abs(y[OMEGA]) <= p[MIN_HOP] * restoring_acceleration:
        y[OMEGA] = 0.0
        return REST
    return target_mode


@kernel(SKIP)
def skip(mode, acceleration, gains, sample, p):
    """Return the last sample up to which a block at rest stays below the rocking threshold."""
    if mode != REST:
        return sample
    gain_along = gains[ALONG]
    gain_across = gains[ACROSS]
    gain_up = gains[UPWARD]
    last = acceleration.shape[1] - 1
    right = p[THRESHOLD_RIGHT]
    left = p[THRESHOLD_LEFT]
    k = sample
    if gain_up == 0.0 and gain_across == 0.0:
        low = -p[GRAVITY] * right
        high = p[GRAVITY] * left
        # records at rest are long: without vertical motion both limits are constants
        while k <= last and low < gain_along * acceleration[ALONG, k] < high:
            k += 1
    else:
        while k <= last:
            weight = p[GRAVITY] + gain_up * acceleration[UPWARD, k]
            push = gain_along * acceleration[ALONG, k] + gain_across * acceleration[ACROSS, k]
            if not (-weight * right < push < weight * left):
                break
            k += 1
    return max(k - 1, sample)


ROCKING = Model(
    "rocking block", series, reset, ("rotation", "angular velocity"), ("down", "up and over"), MODES, scratch=2, tracked=1, skip=skip
)

__all__ = [
    "BEYOND_LEFT",
    "BEYOND_RIGHT",
    "LOWER_BOUND",
    "OMEGA",
    "OVERTURNED",
    "REST",
    "ROCKING",
    "THETA",
    "TO_LEFT",
    "TO_RIGHT",
    "UPPER_BOUND",
    "parameters",
]
