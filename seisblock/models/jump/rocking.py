"""Rocking model of the two-layer block about its lower left corner, from rest to the impact ([Sugimoto2017]_ sections 3.2-3.5).

Assumptions
    A tenon prevents sliding and lift-off of the foot; horizontal ground motion only. Ground acceleration z'' > 0 tilts the block to -x
    about its left corner; z'' < 0 is the exact mirror image and is solved with a negative gain.
State
    Tilt theta, counter-clockwise, and omega = theta'.
Modes
    REST up to abs(z'') = g x_G/y_G; ROCK until theta returns to zero (impact) or reaches pi/2 (overturned).
"""

from __future__ import annotations

import math

import numpy as np

from seisblock._jit import kernel
from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.core.typing import FloatArray
from seisblock.dynamics.model import Model
from seisblock.dynamics.model_api import CONSTANT, RESET, SERIES, SKIP

THETA, OMEGA, SIN, COS = range(4)
REST, ROCK = range(2)
OVERTURNED, IMPACT, ROSE_BACKWARD, ROSE_FORWARD = range(-4, 0)
ALPHA, PUSH, WEIGHT, THRESHOLD_FORWARD, THRESHOLD_BACKWARD = range(5)


@kernel(SERIES)
def rocking_series(mode, y, f, p, order, c, g):
    """Write the series of the tilt: I_O theta'' = m z'' R cos(alpha - theta) - m g R sin(alpha - theta), [Sugimoto2017]_ eq. (3a)."""
    if mode == REST:
        g[0, 0] = p[THRESHOLD_FORWARD] - f[0, 0]
        g[0, 1] = -f[0, 1]
        g[1, 0] = p[THRESHOLD_BACKWARD] + f[0, 0]
        g[1, 1] = f[0, 1]
        return CONSTANT
    c[THETA, 0] = y[THETA]
    c[OMEGA, 0] = y[OMEGA]
    # lean = alpha - theta enters through its sine and cosine: s' = -omega c, c' = omega s
    c[SIN, 0] = np.sin(p[ALPHA] - y[THETA])
    c[COS, 0] = np.cos(p[ALPHA] - y[THETA])
    # z'' is linear between samples, so that only two of its coefficients enter each order
    for k in range(order):
        rate = p[PUSH] * f[0, 0] * c[COS, k] - p[WEIGHT] * c[SIN, k]
        if k > 0:
            rate += p[PUSH] * f[0, 1] * c[COS, k - 1]
        c[THETA, k + 1] = c[OMEGA, k] / (k + 1)
        c[OMEGA, k + 1] = rate / (k + 1)
        sine = 0.0
        cosine = 0.0
        for j in range(k + 1):
            sine -= c[OMEGA, j] * c[COS, k - j]
            cosine += c[OMEGA, j] * c[SIN, k - j]
        c[SIN, k + 1] = sine / (k + 1)
        c[COS, k + 1] = cosine / (k + 1)
    for k in range(order + 1):
        # return to zero tilt, and quarter turn
        g[0, k] = c[THETA, k]
        g[1, k] = -c[THETA, k]
    g[1, 0] += 0.5 * np.pi
    return order


@kernel(SKIP)
def rocking_skip(mode, acceleration, gains, sample, p):
    """Return the last sample up to which a block at rest stays below its rocking threshold."""
    if mode != REST:
        return sample
    index = sample
    while index < acceleration.shape[1] and -p[THRESHOLD_BACKWARD] < gains[0] * acceleration[0, index] < p[THRESHOLD_FORWARD]:
        index += 1
    # the threshold may be crossed before sample `index`: the interval that ends there is not skipped
    return max(index - 1, sample)


@kernel(RESET)
def rocking_reset(mode, guard, y, f, p):
    """Return the terminal mode of the onset search or of rocking."""
    if mode == REST:
        return ROSE_FORWARD if guard == 0 else ROSE_BACKWARD
    if guard == 0:
        y[THETA] = 0.0
        return IMPACT
    return OVERTURNED


ROCKING_MODEL = Model(
    "jump (rocking)",
    rocking_series,
    rocking_reset,
    states=("theta", "omega"),
    guards=("onset or impact", "onset or overturning"),
    modes=("rest", "rocking", "overturned", "impact", "rose backward", "rose forward"),
    scratch=2,
    tracked=1,
    skip=rocking_skip,
)


def rocking_parameters(block: TwoLayerBlock, gravity: float, direction: str) -> FloatArray:
    """Return the parameter vector of the model, (5,); an excluded direction has an infinite threshold."""
    per_inertia = block.mass * block.radius / block.corner_inertia
    threshold = block.rocking_threshold(gravity)
    forward = threshold if direction in ("+", "both") else math.inf
    backward = threshold if direction in ("-", "both") else math.inf
    return np.array([block.slenderness, per_inertia, per_inertia * gravity, forward, backward])
