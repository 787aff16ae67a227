"""What becomes of a rocking block once the shaking is over: decided by energy, timed by quadrature.

Without shaking the lean phi >= 0 on either side obeys phi'' = -V'(phi) with V = p^2 (cos(alpha - phi) - cos(alpha)), or
p^2 (alpha phi - phi^2/2) in the linear option; the barrier stands at phi = alpha (derived here). Impacts multiply phi' by the
restitution, so that the fate is known after a few swings.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from seisblock.bodies.block import LEFT, RIGHT
from seisblock.errors import SolverError
from seisblock.solvers.rock.rocker import Rocker

HALF_PI = math.pi / 2
MOST_SWINGS = 10_000


@dataclass(frozen=True)
class Side:
    """One corner of a freely rocking block: alpha, rad, p^2, 1/s^2 ([Furukawa2009]_ eq. (3)), and the restitution of impacts onto it."""

    alpha: float
    p_squared: float
    restitution: float
    linear: bool

    def rise(self, low: float, by: float) -> float:
        """Return V(low + by) - V(low), written so that a small step loses no digits."""
        middle = self.alpha - low - by / 2
        if self.linear:
            return self.p_squared * middle * by
        return 2 * self.p_squared * math.sin(middle) * math.sin(by / 2)

    @property
    def barrier(self) -> float:
        """V(alpha), 1/s^2."""
        return self.rise(0.0, self.alpha)

    def turning_point(self, energy: float) -> float:
        """Return the largest lean below alpha of a swing that starts upright with this kinetic energy, rad."""
        share = min(energy / self.p_squared, self.barrier / self.p_squared)
        if self.linear:
            return share * 2 / (self.alpha + math.sqrt(max(self.alpha**2 - 2 * share, 0.0)))
        return self.alpha - math.acos(min(math.cos(self.alpha) + share, 1.0))

    def returning_point(self, phi: float, speed: float) -> float:
        """Return the least lean of a block that leans beyond alpha and moves back too slowly to pass it, rad."""
        if self.linear:
            return self.alpha + math.sqrt(max((phi - self.alpha) ** 2 - speed**2 / self.p_squared, 0.0))
        return self.alpha + math.acos(min(math.cos(self.alpha - phi) + 0.5 * speed**2 / self.p_squared, 1.0))

    def travel(self, first: float, last: float, speed: float) -> float:
        """Return the time from one lean to another without turning, started with this speed, s; `first` may be a turning point."""
        if first == last:
            return 0.0
        from scipy.integrate import quad

        span = last - first

        def slowness(u: float) -> float:
            return 2 * abs(span) * u / math.sqrt(max(speed**2 - 2 * self.rise(first, span * u * u), 1e-300))

        share = (self.alpha - first) / span
        breaks = [math.sqrt(share)] if 0.0 < share < 1.0 else None
        # full_output: at the very edge of the barrier the last digits are round-off, which quad would warn of
        return float(quad(slowness, 0.0, 1.0, epsabs=0.0, epsrel=1e-12, limit=400, points=breaks, full_output=1)[0])


def sides(block: Rocker) -> tuple[Side, Side]:
    """Return the right and the left corner of a block."""
    right, left = (Side(block.alphas[k], block.gravity * block.levers[k], block.onto[k], block.linear) for k in (RIGHT, LEFT))
    return right, left


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


def fate(pair: tuple[Side, Side], theta: float, omega: float, *, timed: bool = True) -> Fate:
    """Return the fate of a block that rocks freely from a lean and an angular velocity ([Housner1963]_).

    Parameters
    ----------
    pair : (Side, Side)
        From :func:`sides`.
    theta, omega : float, rad, rad/s
        Positive to +x.
    timed : bool
        Whether the times are wanted (quadratures).
    """
    k = RIGHT if theta > 0 or (theta == 0 and omega >= 0) else LEFT
    sign = 1 if k == RIGHT else -1
    phi, speed = abs(theta), sign * omega
    clock = 0.0
    largest = [0.0, 0.0]
    lowest = min(side.barrier for side in pair)

    for _ in range(MOST_SWINGS):
        side = pair[k]
        largest[k] = max(largest[k], phi)
        surplus = 0.5 * speed**2 - side.rise(phi, side.alpha - phi)
        falls_on = speed > 0.0 and surplus > 0.0
        turns_and_falls = phi > side.alpha and not falls_on and surplus <= 0.0
        if falls_on or turns_and_falls or (phi > side.alpha and speed >= 0.0):
            largest[k] = HALF_PI
            return _fall(side, k, phi, speed, clock, largest, timed)
        energy = 0.5 * speed**2 + side.rise(0.0, phi)
        if speed > 0.0:
            top = side.turning_point(energy)
            largest[k] = max(largest[k], top)
            if timed:
                clock += side.travel(top, phi, 0.0) + side.travel(top, 0.0, 0.0)
        elif timed and phi > 0.0:
            clock += side.travel(phi, 0.0, -speed)
        k = 1 - k
        phi, speed = 0.0, pair[k].restitution * math.sqrt(2 * max(energy, 0.0))
        if 0.5 * speed**2 <= lowest:
            for _ in range(2):
                largest[k] = max(largest[k], pair[k].turning_point(0.5 * speed**2))
                k = 1 - k
                speed *= pair[k].restitution
            return Fate(False, 0, (largest[RIGHT], largest[LEFT]))
    raise SolverError("the block rocks on without end between two unequal corners: give a restitution below 1")


def _fall(side: Side, k: int, phi: float, speed: float, clock: float, largest: list[float], timed: bool) -> Fate:
    """Return the fate of a block that overturns without another impact."""
    towards = 1 if k == RIGHT else -1
    both = (largest[RIGHT], largest[LEFT])
    if not timed:
        return Fate(True, towards, both)
    if phi >= side.alpha:
        if speed < 0.0:
            turn = side.returning_point(phi, speed)
            return Fate(True, towards, both, clock, clock + side.travel(turn, phi, 0.0) + side.travel(turn, HALF_PI, 0.0))
        return Fate(True, towards, both, clock, clock + side.travel(phi, HALF_PI, speed))
    to_alpha = side.travel(phi, side.alpha, speed)
    at_alpha = math.sqrt(speed**2 - 2 * side.rise(phi, side.alpha - phi))
    return Fate(True, towards, both, clock + to_alpha, clock + to_alpha + side.travel(side.alpha, HALF_PI, at_alpha))
