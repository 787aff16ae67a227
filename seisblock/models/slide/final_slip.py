"""Residual slip after the record: closed-form stop of a sliding body on ground at rest."""

from __future__ import annotations

import math
from collections.abc import Sequence

from seisblock.models.slide.model import COSINE, DOWNHILL, FLIGHT, FOOT_POSITION, GRAVITY, KINETIC, LEVEL, SINE, SLIP, STICK


def slip_at_rest(state: Sequence[float], mode: int, p: Sequence[float]) -> float:
    """Return the slip at which a body comes to rest on ground at rest, m ([Fujino1978]_).

    Parameters
    ----------
    state, mode, p
        State, mode and parameters of :mod:`seisblock.models.slide.model`.

    Returns
    -------
    float
        Signed; infinite where kinetic friction is smaller than the downhill force on a slope without a foot.
    """
    if mode % LEVEL == STICK:
        return float(state[SLIP])
    u, v, gap, gap_speed = (float(value) for value in state)
    level = LEVEL if mode >= LEVEL else 0
    if mode % LEVEL == FLIGHT:
        u, v = _after_landing(u, v, gap, gap_speed, level, p)
        level = LEVEL if p[DOWNHILL] * u > p[FOOT_POSITION] else 0
    # one segment of constant acceleration per pass, up to a stop or to the foot of the slope
    while v != 0.0:
        side = math.copysign(1.0, v)
        pull = _sliding_acceleration(side, level, p)
        foot = p[DOWNHILL] * p[FOOT_POSITION]
        # on the slope the foot lies downhill, on the level uphill
        reaches_foot = side * p[DOWNHILL] * (1.0 if level == 0 else -1.0) > 0.0 and math.isfinite(foot)
        # distance to a stop under constant deceleration; none if friction does not brake
        stop = v * v / (-2.0 * side * pull) if side * pull < 0.0 else math.inf
        if not reaches_foot or stop <= abs(foot - u):
            return u + side * stop
        # velocity at the foot, from the work up to there
        v = side * math.sqrt(max(v * v + 2.0 * pull * (foot - u), 0.0))
        u, level = foot, LEVEL - level
    return u


def _sliding_acceleration(side: float, level: int, p: Sequence[float]) -> float:
    """Return the acceleration of a body sliding in direction `side` on ground at rest, m/s^2."""
    sine, cosine = (0.0, 1.0) if level else (p[SINE], p[COSINE])
    return p[GRAVITY] * (sine - side * p[KINETIC] * cosine)


def _after_landing(u: float, v: float, gap: float, gap_speed: float, level: int, p: Sequence[float]) -> tuple[float, float]:
    """Return slip, m, and speed, m/s, after a flight that ends in a plastic landing with a Coulomb impulse."""
    sine, cosine = (0.0, 1.0) if level else (p[SINE], p[COSINE])
    normal, downhill = p[GRAVITY] * cosine, p[GRAVITY] * sine
    # fall of the gap in a constant field, from the energy
    impact = math.sqrt(gap_speed * gap_speed + 2.0 * normal * gap)
    t = (gap_speed + impact) / normal
    u, v = u + v * t + 0.5 * downhill * t * t, v + downhill * t
    return u, math.copysign(max(abs(v) - p[KINETIC] * impact, 0.0), v)
