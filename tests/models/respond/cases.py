"""Motions and helpers that the tests of the five-mode model share."""

from __future__ import annotations

import math

import numpy as np

from seisblock.bodies.block import Block
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.models.respond import respond_params
from seisblock.models.respond.run import run
from seisblock.records import Motion


def shaking(seed, peak, *, seconds=12.0, dt=0.01, vertical=0.6):
    """Return band-limited noise under an envelope, with `vertical` of the peak upwards."""
    rng = np.random.default_rng(seed)
    n = round(seconds / dt) + 1
    t = dt * np.arange(n)
    rows = [np.convolve(rng.normal(size=n), np.hanning(width), "same") * np.sin(np.pi * t / seconds) ** 2 for width in (17, 9)]
    along, up = (row / np.abs(row).max() for row in rows)
    return Motion.from_arrays(peak * along, dt, vertical=vertical * peak * up)


def constant_push(push, *, weight=G, seconds=0.05, dt=0.01):
    """Return constant ground acceleration from the first sample, such that g + a_y is `weight`."""
    n = round(seconds / dt) + 1
    return Motion.from_arrays(np.full(n, push), dt, vertical=np.full(n, weight - G))


def still_ground(seconds=1.0, dt=0.01):
    """Return ground that does not move."""
    return Motion.from_arrays(np.zeros(round(seconds / dt) + 1), dt)


def at_lean(block, theta, omega=0.0, *, slip=0.0):
    """Return the six initial numbers of a block that leans about the corner it stands on, whose foot slips."""
    right, left = block.arms
    xi = right if theta > 0.0 or (theta == 0.0 and omega > 0.0) else -left
    rx = xi * math.cos(theta) - block.centre * math.sin(theta)
    ry = -xi * math.sin(theta) - block.centre * math.cos(theta)
    return (0.0, -ry, theta, slip - ry * omega, rx * omega, omega)


def sequence(outcome):
    """Return the modes in their order, with corner and slip in short."""
    return [" ".join(filter(None, (event["mode"], event["corner"], event["slip"]))) for event in outcome.events]


def solve_case(block, motion, *, initial=None, settle_s=60.0, **options):
    """Return the setting and the run behind a response."""
    setting = respond_params(block, **options)
    return setting, run(setting, motion, (1.0, 0.0, 1.0), initial, settle_s)


SQUAT = Block(0.6, 0.7, centroid_height=0.3, centroid_offset=0.05)
SLENDER = Block(0.3, 1.2)
