"""Free rocking after the end of the shaking: outcome from the energy of each swing, times by quadrature.

On ground at rest the tilt phi >= 0 about either corner obeys phi'' = -V'(phi) with V = p^2 (cos(alpha - phi) - cos(alpha)), or
p^2 (alpha phi - phi^2/2) in the linear option; the potential barrier lies at phi = alpha (derived here). An impact multiplies phi' by the
restitution, so that a few swings decide between rest and overturning. The duration of a swing, needed only for the time of
overturning, is an integral over the tilt.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock._jit import kernel, types
from seisblock.bodies.block import LEFT, RIGHT
from seisblock.core.errors import SolverError
from seisblock.dynamics.array_types import INTEGERS, MATRIX, VECTOR
from seisblock.models.rock.model import (
    ALPHA_RIGHT,
    GRAVITY,
    HALF_PI,
    IS_LINEAR,
    LEVER_RIGHT,
    OMEGA,
    OVERTURNED,
    REST,
    RESTITUTION_RIGHT,
    THETA,
    parameters,
)
from seisblock.models.rock.params import RockParams

_t = types()

MAX_SWINGS = 10_000
"""Swings after which free rocking counts as endless (restitution of 1)."""

STANDS, TO_THE_RIGHT, TO_THE_LEFT, ENDLESS = 0, 1, -1, 2
"""Ends of free rocking."""

CORNER, FIRST, LAST, SPEED = range(4)
"""Columns of a leg, a monotonic part of a swing: corner, first and last tilt, rad, initial angular velocity, rad/s."""


@kernel(_t.float64(_t.float64, _t.float64, _t.boolean, _t.float64, _t.float64), inline=True)
def potential_rise(alpha, p_squared, linear, low, step):
    """Return V(low + step) - V(low), 1/s^2, in product form, without cancellation for a small step (derived here)."""
    middle = alpha - low - step / 2
    if linear:
        return p_squared * middle * step
    return 2 * p_squared * math.sin(middle) * math.sin(step / 2)


@kernel(_t.float64(_t.float64, _t.float64, _t.boolean, _t.float64), inline=True)
def _turning_point(alpha, p_squared, linear, energy):
    """Return the peak tilt below alpha of a swing that starts upright with kinetic energy `energy`, rad."""
    # clipping at the barrier keeps the argument of acos valid when the energy equals it up to round-off
    share = min(energy, potential_rise(alpha, p_squared, linear, 0.0, alpha)) / p_squared
    if linear:
        # quadratic root in the form without cancellation for a small energy
        return share * 2 / (alpha + math.sqrt(max(alpha * alpha - 2 * share, 0.0)))
    return alpha - math.acos(min(math.cos(alpha) + share, 1.0))


@kernel(_t.float64(_t.float64, _t.float64, _t.boolean, _t.float64, _t.float64), inline=True)
def _returning_point(alpha, p_squared, linear, phi, speed):
    """Return the smallest tilt of a block beyond alpha that moves back too slowly to return, rad."""
    if linear:
        return alpha + math.sqrt(max((phi - alpha) * (phi - alpha) - speed * speed / p_squared, 0.0))
    return alpha + math.acos(min(math.cos(alpha - phi) + 0.5 * speed * speed / p_squared, 1.0))


@kernel(_t.int64(MATRIX, _t.int64, _t.int64, _t.float64, _t.float64, _t.float64), inline=True)
def _add_leg(legs, count, k, first, last, speed):
    """Write a leg if `legs` has space for it; return the new number of legs."""
    if count < legs.shape[0]:
        legs[count, CORNER] = k
        legs[count, FIRST] = first
        legs[count, LAST] = last
        legs[count, SPEED] = speed
    return count + 1


@kernel(_t.UniTuple(_t.int64, 2)(VECTOR, _t.float64, _t.float64, VECTOR, MATRIX))
def trace_free_rocking(p, theta, omega, max_leans, legs):
    """Return the end of free rocking from a tilt and an angular velocity, and the number of legs ([Housner1963]_).

    Parameters
    ----------
    p : (12,) array
        Parameters of :mod:`seisblock.models.rock.model`.
    theta, omega : float, rad, rad/s
        Positive to +x.
    max_leans : (2,) array, rad
        Output: peak tilt to +x and to -x, both positive; pi/2 for overturning.
    legs : (n, 4) array
        Output: the first n legs, columns ``CORNER`` to ``SPEED``; the last one ends at pi/2, or at the last impact with enough energy
        to matter.
    """
    linear = p[IS_LINEAR] != 0.0
    k = RIGHT if theta > 0.0 or (theta == 0.0 and omega >= 0.0) else LEFT
    # tilt and speed are counted positive away from the ground about the corner in contact, so that both corners share
    # one set of equations
    phi, speed = abs(theta), omega if k == RIGHT else -omega
    max_leans[RIGHT] = max_leans[LEFT] = 0.0
    right, left = p[ALPHA_RIGHT], p[ALPHA_RIGHT + 1]
    # below the lower of the two barriers neither corner can be overturned, whatever follows
    energy_threshold = min(
        potential_rise(right, p[GRAVITY] * p[LEVER_RIGHT], linear, 0.0, right),
        potential_rise(left, p[GRAVITY] * p[LEVER_RIGHT + 1], linear, 0.0, left),
    )
    count = 0
    for _ in range(MAX_SWINGS):
        alpha, p_squared = p[ALPHA_RIGHT + k], p[GRAVITY] * p[LEVER_RIGHT + k]
        max_leans[k] = max(max_leans[k], phi)
        # kinetic energy above the barrier at alpha decides
        surplus = 0.5 * speed * speed - potential_rise(alpha, p_squared, linear, phi, alpha - phi)
        overturns = speed > 0.0 and surplus > 0.0
        # beyond alpha gravity drives the block on, unless it moves back with enough energy to pass the barrier
        if overturns or (phi > alpha and (surplus <= 0.0 or speed >= 0.0)):
            max_leans[k] = HALF_PI
            if phi < alpha:
                count = _add_leg(legs, count, k, phi, alpha, speed)
                count = _add_leg(legs, count, k, alpha, HALF_PI, math.sqrt(2.0 * surplus))
            # moving back, but too slowly: it turns before alpha and falls after all
            elif speed < 0.0:
                turning_point = _returning_point(alpha, p_squared, linear, phi, speed)
                count = _add_leg(legs, count, k, turning_point, phi, 0.0)
                count = _add_leg(legs, count, k, turning_point, HALF_PI, 0.0)
            else:
                count = _add_leg(legs, count, k, phi, HALF_PI, speed)
            return TO_THE_RIGHT if k == RIGHT else TO_THE_LEFT, count
        # V(0) = 0: the energy at the impact is all kinetic
        energy = 0.5 * speed * speed + potential_rise(alpha, p_squared, linear, 0.0, phi)
        if speed > 0.0:
            peak_lean = _turning_point(alpha, p_squared, linear, energy)
            max_leans[k] = max(max_leans[k], peak_lean)
            # a turning point is written as the start of both halves: the integrand of the duration is singular there,
            # and the substitution of ``_leg_duration`` removes it at the first tilt only
            count = _add_leg(legs, count, k, peak_lean, phi, 0.0)
            count = _add_leg(legs, count, k, peak_lean, 0.0, 0.0)
        elif phi > 0.0:
            count = _add_leg(legs, count, k, phi, 0.0, -speed)
        k = 1 - k
        # restitution of the corner that is struck, which differs for an asymmetric block
        phi, speed = 0.0, p[RESTITUTION_RIGHT + k] * math.sqrt(2 * max(energy, 0.0))
        if 0.5 * speed * speed <= energy_threshold:
            # below the lower barrier: no overturning any more, only the peaks of the next swing to either side remain
            for _ in range(2):
                alpha, p_squared = p[ALPHA_RIGHT + k], p[GRAVITY] * p[LEVER_RIGHT + k]
                max_leans[k] = max(max_leans[k], _turning_point(alpha, p_squared, linear, 0.5 * speed * speed))
                k = 1 - k
                speed *= p[RESTITUTION_RIGHT + k]
            return STANDS, count
    return ENDLESS, count


@kernel(_t.void(MATRIX, MATRIX, INTEGERS, INTEGERS, MATRIX, MATRIX))
def trace_free_rocking_batch(parameters, states, modes, endings, max_leans, no_legs):
    """Write the ends and peak tilts of many blocks at rest, overturned or rocking.

    Parameters
    ----------
    parameters, states : (m, 12), (m, 2) arrays
    modes : (m,) array of int
        Modes of :mod:`seisblock.models.rock.model`.
    endings : (m,) array of int
        Output: ``STANDS`` to ``ENDLESS``.
    max_leans : (m, 2) array, rad
        Output as of :func:`trace_free_rocking`; unchanged for blocks that do not rock.
    no_legs : (0, 4) array
    """
    for row in range(modes.size):
        theta = states[row, THETA]
        if modes[row] == REST:
            endings[row] = STANDS
        elif modes[row] == OVERTURNED:
            endings[row] = TO_THE_RIGHT if theta > 0.0 else TO_THE_LEFT
        else:
            endings[row], _ = trace_free_rocking(parameters[row], theta, states[row, OMEGA], max_leans[row], no_legs)


INITIAL_LEGS = 64
"""Legs allocated at first; more are needed only for a restitution near 1."""


@dataclass(frozen=True)
class FreeRockingOutcome:
    """Outcome of free rocking.

    Parameters
    ----------
    overturns : bool
    direction : int
        +1 or -1 for overturning to +x or -x, else 0.
    max_leans : (float, float), rad
        Peak tilt to +x and to -x, both positive; pi/2 for overturning.
    passes_alpha_s, overturns_s : float or None
        Times from the start of free rocking at which alpha is exceeded for good and pi/2 is reached; `passes_alpha_s` is 0 if the block
        starts beyond alpha and stays there.
    """

    overturns: bool
    direction: int
    max_leans: tuple[float, float]
    passes_alpha_s: float | None = None
    overturns_s: float | None = None


def free_rocking_outcome(params: RockParams, theta: float, omega: float) -> FreeRockingOutcome:
    """Return the outcome of free rocking from a tilt and an angular velocity ([Housner1963]_).

    Parameters
    ----------
    params : RockParams
    theta, omega : float, rad, rad/s
        Positive to +x.

    Raises
    ------
    SolverError
        If the block rocks without end (restitution of 1).
    """
    p, max_leans, legs = parameters(params, 0.0), np.empty(2), np.empty((INITIAL_LEGS, 4))
    ending, count = trace_free_rocking(p, theta, omega, max_leans, legs)
    raise_if_endless(ending == ENDLESS)
    leans = float(max_leans[RIGHT]), float(max_leans[LEFT])
    if ending == STANDS:
        return FreeRockingOutcome(False, 0, leans)
    # more legs than the table holds: the first pass has counted them
    if count > INITIAL_LEGS:
        legs = np.empty((count, 4))
        trace_free_rocking(p, theta, omega, max_leans, legs)
    times = [_leg_duration(params, *leg) for leg in legs[:count].tolist()]
    # legs that start at alpha or beyond lead to overturning; the legs before them give the time of passing alpha
    swings = sum(first < params.alphas[int(corner)] for corner, first, _, _ in legs[:count].tolist())
    return FreeRockingOutcome(True, int(ending), leans, sum(times[:swings]), sum(times))


def raise_if_endless(is_endless: bool) -> None:
    """Raise SolverError for a block whose free rocking has no end."""
    if is_endless:
        raise SolverError("endless free rocking about two unequal corners: `restitution` below 1 required")


def _leg_duration(params: RockParams, corner: float, first: float, last: float, speed: float) -> float:
    """Return the duration of a leg, s; `first` may be a turning point (derived here).

    The substitution phi = first + span u^2 removes the integrable singularity 1/phi' at a turning point.
    """
    if first == last:
        return 0.0
    from scipy.integrate import quad

    alpha, p_squared = params.alphas[int(corner)], params.gravity * params.levers[int(corner)]
    span = last - first

    # slowness: time per unit of u, d phi/phi' with d phi = 2 span u du
    def slowness(u: float) -> float:
        return (
            2 * abs(span) * u / math.sqrt(max(speed**2 - 2 * potential_rise(alpha, p_squared, params.linear, first, span * u * u), 1e-300))
        )

    # the slowness peaks at the barrier; a break there lets the quadrature resolve it
    share = (alpha - first) / span
    breaks = [math.sqrt(share)] if 0.0 < share < 1.0 else None
    # full_output=1 silences quad's warning: next to the barrier the last digits are round-off
    return float(quad(slowness, 0.0, 1.0, epsabs=0.0, epsrel=1e-12, limit=400, points=breaks, full_output=1)[0])
