"""When a block that nothing shakes any more passes alpha and overturns: the legs of its free rocking, timed by quadrature."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.block import LEFT, RIGHT
from seisblock.core.errors import SolverError
from seisblock.models.rock.free_rocking_kernels import ENDLESS, STANDS, potential_rise, trace_free_rocking
from seisblock.models.rock.model import parameters
from seisblock.models.rock.params import RockParams

INITIAL_LEGS = 64
"""Room for so many legs suffices but for a restitution near 1."""


@dataclass(frozen=True)
class FreeRockingOutcome:
    """How free rocking ends.

    Parameters
    ----------
    overturns : bool
    direction : int
        +1 or -1 when it overturns, else 0.
    max_leans : (float, float), rad
        Largest lean to +x and to -x from now on, both positive; pi/2 when it overturns.
    passes_alpha_s, overturns_s : float or None
        Seconds from now; `passes_alpha_s` is 0 when alpha is passed already, and stays so.
    """

    overturns: bool
    direction: int
    max_leans: tuple[float, float]
    passes_alpha_s: float | None = None
    overturns_s: float | None = None


def free_rocking_outcome(params: RockParams, theta: float, omega: float) -> FreeRockingOutcome:
    """Return the fate of a block that rocks freely from a lean and an angular velocity ([Housner1963]_).

    Parameters
    ----------
    params : Rocker
    theta, omega : float, rad, rad/s
        Positive to +x.

    Raises
    ------
    SolverError
        If a restitution of 1 makes it rock on for ever.
    """
    p, max_leans, legs = parameters(params, 0.0), np.empty(2), np.empty((INITIAL_LEGS, 4))
    ending, count = trace_free_rocking(p, theta, omega, max_leans, legs)
    raise_if_endless(ending == ENDLESS)
    leans = float(max_leans[RIGHT]), float(max_leans[LEFT])
    if ending == STANDS:
        return FreeRockingOutcome(False, 0, leans)
    if count > INITIAL_LEGS:
        legs = np.empty((count, 4))
        trace_free_rocking(p, theta, omega, max_leans, legs)
    times = [_leg_duration(params, *leg) for leg in legs[:count].tolist()]
    # what begins at alpha or beyond it does not come back
    swings = sum(first < params.alphas[int(corner)] for corner, first, _, _ in legs[:count].tolist())
    return FreeRockingOutcome(True, int(ending), leans, sum(times[:swings]), sum(times))


def raise_if_endless(is_endless: bool) -> None:
    """Refuse a block whose free rocking has no end."""
    if is_endless:
        raise SolverError("the block rocks on without end between two unequal corners: give a restitution below 1")


def _leg_duration(params: RockParams, corner: float, first: float, last: float, speed: float) -> float:
    """Return how long a leg takes: from one lean to another without turning, s; `first` may be a turning point."""
    if first == last:
        return 0.0
    from scipy.integrate import quad

    alpha, p_squared = params.alphas[int(corner)], params.gravity * params.levers[int(corner)]
    span = last - first

    def slowness(u: float) -> float:
        return (
            2 * abs(span) * u / math.sqrt(max(speed**2 - 2 * potential_rise(alpha, p_squared, params.linear, first, span * u * u), 1e-300))
        )

    share = (alpha - first) / span
    breaks = [math.sqrt(share)] if 0.0 < share < 1.0 else None
    # full_output: at the very edge of the barrier the last digits are round-off, which quad would warn of
    return float(quad(slowness, 0.0, 1.0, epsabs=0.0, epsrel=1e-12, limit=400, points=breaks, full_output=1)[0])
