"""When a block that nothing shakes any more passes alpha and overturns: the legs of its free rocking, timed by quadrature."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.block import LEFT, RIGHT
from seisblock.errors import SolverError
from seisblock.solvers.rock.free import ENDLESS, STANDS, rise, rock_freely
from seisblock.solvers.rock.model import parameters
from seisblock.solvers.rock.rocker import Rocker

USUAL_LEGS = 64
"""Room for so many legs suffices but for a restitution near 1."""


@dataclass(frozen=True)
class Fate:
    """How free rocking ends.

    Parameters
    ----------
    overturns : bool
    towards : int
        +1 or -1 when it overturns, else 0.
    largest : (float, float), rad
        Largest lean to +x and to -x from now on, both positive; pi/2 when it overturns.
    passes_alpha_s, overturns_s : float or None
        Seconds from now; `passes_alpha_s` is 0 when alpha is passed already, and stays so.
    """

    overturns: bool
    towards: int
    largest: tuple[float, float]
    passes_alpha_s: float | None = None
    overturns_s: float | None = None


def fate(block: Rocker, theta: float, omega: float) -> Fate:
    """Return the fate of a block that rocks freely from a lean and an angular velocity ([Housner1963]_).

    Parameters
    ----------
    block : Rocker
    theta, omega : float, rad, rad/s
        Positive to +x.

    Raises
    ------
    SolverError
        If a restitution of 1 makes it rock on for ever.
    """
    p, largest, legs = parameters(block, 0.0), np.empty(2), np.empty((USUAL_LEGS, 4))
    end, count = rock_freely(p, theta, omega, largest, legs)
    refuse_endless(end == ENDLESS)
    leans = float(largest[RIGHT]), float(largest[LEFT])
    if end == STANDS:
        return Fate(False, 0, leans)
    if count > USUAL_LEGS:
        legs = np.empty((count, 4))
        rock_freely(p, theta, omega, largest, legs)
    times = [_duration(block, *leg) for leg in legs[:count].tolist()]
    # what begins at alpha or beyond it does not come back
    swings = sum(first < block.alphas[int(corner)] for corner, first, _, _ in legs[:count].tolist())
    return Fate(True, int(end), leans, sum(times[:swings]), sum(times))


def refuse_endless(endless: bool) -> None:
    """Refuse a block whose free rocking has no end."""
    if endless:
        raise SolverError("the block rocks on without end between two unequal corners: give a restitution below 1")


def _duration(block: Rocker, corner: float, first: float, last: float, speed: float) -> float:
    """Return how long a leg takes: from one lean to another without turning, s; `first` may be a turning point."""
    if first == last:
        return 0.0
    from scipy.integrate import quad

    alpha, p_squared = block.alphas[int(corner)], block.gravity * block.levers[int(corner)]
    span = last - first

    def slowness(u: float) -> float:
        return 2 * abs(span) * u / math.sqrt(max(speed**2 - 2 * rise(alpha, p_squared, block.linear, first, span * u * u), 1e-300))

    share = (alpha - first) / span
    breaks = [math.sqrt(share)] if 0.0 < share < 1.0 else None
    # full_output: at the very edge of the barrier the last digits are round-off, which quad would warn of
    return float(quad(slowness, 0.0, 1.0, epsabs=0.0, epsrel=1e-12, limit=400, points=breaks, full_output=1)[0])
