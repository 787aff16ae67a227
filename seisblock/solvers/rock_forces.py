"""Contact forces of a rocking block: when pure rocking is the wrong model, because it would slip or leave the ground.

Between the rows of a trajectory the lean is the quintic that has its angle, angular velocity and angular acceleration at both ends,
which is closer than 1e-9 of the lean at 100 Hz; so forces are known between samples, too.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.block import LEFT, RIGHT, Block
from seisblock.dynamics import Trajectory
from seisblock.records import Motion
from seisblock.solvers.rock_model import BEYOND_LEFT, REST, TO_LEFT
from seisblock.typing import FloatArray

INNER = np.linspace(0.0, 1.0, 9)
"""Where forces are looked at between two rows, as shares of the interval; both ends are among them."""


@dataclass(frozen=True)
class Demand:
    """What the ground must do for the block to rock and nothing else.

    Parameters
    ----------
    friction : float
        Largest abs(H/N); infinite when contact is lost.
    friction_s : float or None
        When.
    contact_lost_s : float or None
        First time at which N <= 0.
    """

    friction: float
    friction_s: float | None
    contact_lost_s: float | None


def demand(
    block: Block, motion: Motion, trajectory: Trajectory, *, gravity: float, linear: bool, gains: FloatArray, until_s: float
) -> Demand:
    """Return the largest friction demand, and the loss of contact, before `until_s` (s after sample 0); impacts excepted.

    The block's acceleration relative to the ground is that of a point at R from the corner in contact ([Ishiyama1982]_): with
    psi = s alpha - theta, H/m = a + R (theta'' cos(psi) + theta'^2 sin(psi)), N/m = g + a_v + R (theta'' sin(psi) - theta'^2 cos(psi)).
    """
    time, states, modes = trajectory.table()
    clock = trajectory.dt * np.arange(motion.samples)
    push = np.interp(time, clock, gains[0] * motion.horizontal)
    weight = gravity + np.interp(time, clock, gains[2] * motion.vertical)
    keep = (modes[:-1] == modes[1:]) & (np.diff(time) > 0) & (time[1:] <= until_s) & (modes[:-1] >= REST)
    at = np.flatnonzero(keep)
    if at.size == 0:
        return Demand(0.0, None, None)
    step = (time[at + 1] - time[at])[:, None]
    u = INNER[None, :]
    a = push[at, None] * (1 - u) + push[at + 1, None] * u
    w = weight[at, None] * (1 - u) + weight[at + 1, None] * u
    mode = modes[at, None]
    left = (mode == TO_LEFT) | (mode == BEYOND_LEFT)
    lean = np.where(left, -block.slendernesses[LEFT], block.slendernesses[RIGHT])
    lever = np.where(left, block.lever_ratios[LEFT], block.lever_ratios[RIGHT])
    radius = np.where(left, block.radii[LEFT], block.radii[RIGHT])

    def angular(theta: FloatArray, push: FloatArray, weight: FloatArray) -> FloatArray:
        psi = lean - theta
        return -lever * (weight * (psi if linear else np.sin(psi)) + push * (1.0 if linear else np.cos(psi)))

    first, last = states[at], states[at + 1]
    start, end = (
        (y[:, :1], y[:, 1:] * step, angular(y[:, :1], a[:, [i]], w[:, [i]]) * step**2) for y, i in ((first, 0), (last, -1))
    )  # fmt: skip
    theta, omega = _quintic(start, end, u)
    omega = omega / step
    alpha = angular(theta, a, w)
    psi = lean - theta
    along = a + radius * (alpha * np.cos(psi) + omega**2 * np.sin(psi))
    normal = w + radius * (alpha * np.sin(psi) - omega**2 * np.cos(psi))
    at_rest = mode == REST
    along, normal = np.where(at_rest, a, along), np.where(at_rest, w, normal)
    moments = time[at, None] + u * step
    lost = np.flatnonzero((normal <= 0.0).ravel())
    if lost.size:
        row, column = divmod(int(lost[0]), INNER.size)
        moment = moments[row, column]
        if column > 0:
            high, low = normal[row, column - 1], normal[row, column]
            moment -= step[row, 0] * (INNER[column] - INNER[column - 1]) * low / (low - high)
        return Demand(math.inf, float(moment), float(moment))
    ratio = np.abs(along) / normal
    row, column = divmod(int(np.argmax(ratio)), INNER.size)
    return _polished(ratio[row], moments[row], column)


def _quintic(
    first: tuple[FloatArray, FloatArray, FloatArray], last: tuple[FloatArray, FloatArray, FloatArray], u: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return value and derivative at `u` of the quintic with value, first and second derivative given at 0 and 1."""
    y0, v0, a0 = first
    y1, v1, a1 = last
    rise = y1 - y0 - v0 - a0 / 2
    speed = v1 - v0 - a0
    bend = a1 - a0
    c3 = 10 * rise - 4 * speed + bend / 2
    c4 = -15 * rise + 7 * speed - bend
    c5 = 6 * rise - 3 * speed + bend / 2
    value = y0 + u * (v0 + u * (a0 / 2 + u * (c3 + u * (c4 + u * c5))))
    slope = v0 + u * (a0 + u * (3 * c3 + u * (4 * c4 + u * 5 * c5)))
    return value, slope


def _polished(ratio: FloatArray, moments: FloatArray, column: int) -> Demand:
    """Return the maximum of a curve from its largest value and the parabola through its neighbours."""
    best, when = float(ratio[column]), float(moments[column])
    if 0 < column < ratio.size - 1:
        before, here, after = ratio[column - 1 : column + 2]
        bend = before - 2 * here + after
        if bend < 0.0:
            offset = 0.5 * (before - after) / bend
            best = float(here - 0.125 * (before - after) ** 2 / bend)
            when += offset * float(moments[1] - moments[0])
    return Demand(best, when, None)
