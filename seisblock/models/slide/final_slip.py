"""How a body that still slides when the record ends comes to rest on ground that has stopped shaking: closed forms."""

from __future__ import annotations

import math
from collections.abc import Sequence

from seisblock.models.slide.model import COSINE, DOWNHILL, FLIGHT, FOOT_POSITION, GRAVITY, KINETIC, LEVEL, SINE, SLIP, STICK

UNBOUNDED_SLIP = math.inf
"""Slip of a body that kinetic friction does not stop."""


def slip_at_rest(state: Sequence[float], mode: int, p: Sequence[float]) -> float:
    """Return the slip, m, at which a body comes to rest when the ground acceleration is zero from now on ([Fujino1978]_).

    Parameters
    ----------
    state, mode, p
        State, mode and parameters of :mod:`seisblock.models.slide.model`.

    Returns
    -------
    float
        Signed; infinite where kinetic friction is less than the slope's pull and there is no foot.
    """
    if mode % LEVEL == STICK:
        return float(state[SLIP])
    u, v, gap, gap_speed = (float(value) for value in state)
    level = LEVEL if mode >= LEVEL else 0
    if mode % LEVEL == FLIGHT:
        u, v = _after_landing(u, v, gap, gap_speed, level, p)
        level = LEVEL if p[DOWNHILL] * u > p[FOOT_POSITION] else 0
    while v != 0.0:
        side = math.copysign(1.0, v)
        pull = _sliding_acceleration(side, level, p)
        foot = p[DOWNHILL] * p[FOOT_POSITION]
        reaches_foot = side * p[DOWNHILL] * (1.0 if level == 0 else -1.0) > 0.0 and math.isfinite(foot)
        stop = v * v / (-2.0 * side * pull) if side * pull < 0.0 else math.inf
        if not reaches_foot or stop <= abs(foot - u):
            return u + side * stop
        v = side * math.sqrt(max(v * v + 2.0 * pull * (foot - u), 0.0))
        u, level = foot, LEVEL - level
    return u


def _sliding_acceleration(side: float, level: int, p: Sequence[float]) -> float:
    """Return the relative acceleration of a body that slides to one side on still ground."""
    sine, cosine = (0.0, 1.0) if level else (p[SINE], p[COSINE])
    return p[GRAVITY] * (sine - side * p[KINETIC] * cosine)


def _after_landing(u: float, v: float, gap: float, gap_speed: float, level: int, p: Sequence[float]) -> tuple[float, float]:
    """Return slip and speed after the flight's end, a plastic landing with a Coulomb impulse."""
    sine, cosine = (0.0, 1.0) if level else (p[SINE], p[COSINE])
    normal, downhill = p[GRAVITY] * cosine, p[GRAVITY] * sine
    impact = math.sqrt(gap_speed * gap_speed + 2.0 * normal * gap)
    t = (gap_speed + impact) / normal
    u, v = u + v * t + 0.5 * downhill * t * t, v + downhill * t
    return u, math.copysign(max(abs(v) - p[KINETIC] * impact, 0.0), v)
