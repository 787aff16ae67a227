"""Free rocking, compiled: the energy of a swing decides whether a block that nothing shakes any more stands or falls.

Without shaking the lean phi >= 0 on either side obeys phi'' = -V'(phi) with V = p^2 (cos(alpha - phi) - cos(alpha)), or
p^2 (alpha phi - phi^2/2) in the linear option; the barrier stands at phi = alpha (derived here). Impacts multiply phi' by the
restitution, so that the fate is known after a few swings.
"""

from __future__ import annotations

import math

import numpy as np

from seisblock._jit import kernel, types
from seisblock.bodies.block import LEFT, RIGHT
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
)

_t = types()

MAX_SWINGS = 10_000
MAX_LEGS = 2 * MAX_SWINGS + 2

STANDS, TO_THE_RIGHT, TO_THE_LEFT, ENDLESS = 0, 1, -1, 2
"""How free rocking ends."""

CORNER, FIRST, LAST, SPEED = range(4)
"""A leg of it, in which the block does not turn: about which corner, from which lean to which, rad, and how fast it starts, rad/s."""


@kernel(_t.float64(_t.float64, _t.float64, _t.boolean, _t.float64, _t.float64), inline=True)
def potential_rise(alpha, p_squared, linear, low, step):
    """Return V(low + by) - V(low), 1/s^2, written so that a small step loses no digits."""
    middle = alpha - low - step / 2
    if linear:
        return p_squared * middle * step
    return 2 * p_squared * math.sin(middle) * math.sin(step / 2)


@kernel(_t.float64(_t.float64, _t.float64, _t.boolean, _t.float64), inline=True)
def _turning_point(alpha, p_squared, linear, energy):
    """Return the largest lean below alpha of a swing that starts upright with this kinetic energy, rad."""
    share = min(energy, potential_rise(alpha, p_squared, linear, 0.0, alpha)) / p_squared
    if linear:
        return share * 2 / (alpha + math.sqrt(max(alpha * alpha - 2 * share, 0.0)))
    return alpha - math.acos(min(math.cos(alpha) + share, 1.0))


@kernel(_t.float64(_t.float64, _t.float64, _t.boolean, _t.float64, _t.float64), inline=True)
def _returning_point(alpha, p_squared, linear, phi, speed):
    """Return the least lean of a block that leans beyond alpha and moves back too slowly to pass it, rad."""
    if linear:
        return alpha + math.sqrt(max((phi - alpha) * (phi - alpha) - speed * speed / p_squared, 0.0))
    return alpha + math.acos(min(math.cos(alpha - phi) + 0.5 * speed * speed / p_squared, 1.0))


@kernel(_t.int64(MATRIX, _t.int64, _t.int64, _t.float64, _t.float64, _t.float64), inline=True)
def _add_leg(legs, count, k, first, last, speed):
    """Keep a leg where there is room; return how many there are."""
    if count < legs.shape[0]:
        legs[count, CORNER] = k
        legs[count, FIRST] = first
        legs[count, LAST] = last
        legs[count, SPEED] = speed
    return count + 1


@kernel(_t.UniTuple(_t.int64, 2)(VECTOR, _t.float64, _t.float64, VECTOR, MATRIX))
def trace_free_rocking(p, theta, omega, max_leans, legs):
    """Return how a block ends that rocks freely from a lean and an angular velocity ([Housner1963]_), and in how many legs.

    Parameters
    ----------
    p : (11,) array
        Parameters of :mod:`seisblock.models.rock.model`.
    theta, omega : float, rad, rad/s
        Positive to +x.
    max_leans : (2,) array, rad
        Takes the largest lean to +x and to -x from now on, both positive; pi/2 when it overturns.
    legs : (n, 4) array
        Takes the first n legs of its way, see ``CORNER`` to ``SPEED``; the last one ends at pi/2, or where only hops are left.
    """
    linear = p[IS_LINEAR] != 0.0
    k = RIGHT if theta > 0.0 or (theta == 0.0 and omega >= 0.0) else LEFT
    phi, speed = abs(theta), omega if k == RIGHT else -omega
    max_leans[RIGHT] = max_leans[LEFT] = 0.0
    right, left = p[ALPHA_RIGHT], p[ALPHA_RIGHT + 1]
    energy_threshold = min(
        potential_rise(right, p[GRAVITY] * p[LEVER_RIGHT], linear, 0.0, right),
        potential_rise(left, p[GRAVITY] * p[LEVER_RIGHT + 1], linear, 0.0, left),
    )
    count = 0
    for _ in range(MAX_SWINGS):
        alpha, p_squared = p[ALPHA_RIGHT + k], p[GRAVITY] * p[LEVER_RIGHT + k]
        max_leans[k] = max(max_leans[k], phi)
        surplus = 0.5 * speed * speed - potential_rise(alpha, p_squared, linear, phi, alpha - phi)
        overturns = speed > 0.0 and surplus > 0.0
        if overturns or (phi > alpha and (surplus <= 0.0 or speed >= 0.0)):
            max_leans[k] = HALF_PI
            if phi < alpha:
                count = _add_leg(legs, count, k, phi, alpha, speed)
                count = _add_leg(legs, count, k, alpha, HALF_PI, math.sqrt(2.0 * surplus))
            elif speed < 0.0:
                turning_point = _returning_point(alpha, p_squared, linear, phi, speed)
                count = _add_leg(legs, count, k, turning_point, phi, 0.0)
                count = _add_leg(legs, count, k, turning_point, HALF_PI, 0.0)
            else:
                count = _add_leg(legs, count, k, phi, HALF_PI, speed)
            return TO_THE_RIGHT if k == RIGHT else TO_THE_LEFT, count
        energy = 0.5 * speed * speed + potential_rise(alpha, p_squared, linear, 0.0, phi)
        if speed > 0.0:
            peak_lean = _turning_point(alpha, p_squared, linear, energy)
            max_leans[k] = max(max_leans[k], peak_lean)
            count = _add_leg(legs, count, k, peak_lean, phi, 0.0)
            count = _add_leg(legs, count, k, peak_lean, 0.0, 0.0)
        elif phi > 0.0:
            count = _add_leg(legs, count, k, phi, 0.0, -speed)
        k = 1 - k
        phi, speed = 0.0, p[RESTITUTION_RIGHT + k] * math.sqrt(2 * max(energy, 0.0))
        if 0.5 * speed * speed <= energy_threshold:
            for _ in range(2):
                alpha, p_squared = p[ALPHA_RIGHT + k], p[GRAVITY] * p[LEVER_RIGHT + k]
                max_leans[k] = max(max_leans[k], _turning_point(alpha, p_squared, linear, 0.5 * speed * speed))
                k = 1 - k
                speed *= p[RESTITUTION_RIGHT + k]
            return STANDS, count
    return ENDLESS, count


@kernel(_t.void(MATRIX, MATRIX, INTEGERS, INTEGERS, MATRIX), allocates=True)
def trace_free_rocking_batch(parameters, states, modes, endings, max_leans):
    """Write how each of many blocks ends, and its largest leans from now on, that is at rest, overturned or still rocking.

    Parameters
    ----------
    parameters, states : (m, 11), (m, 2) arrays
    modes : (m,) array of int
        Of :mod:`seisblock.models.rock.model`.
    endings : (m,) array of int
        Takes ``STANDS`` to ``ENDLESS``.
    max_leans : (m, 2) array, rad
        As in :func:`trace_free_rocking`; zero of those that rock no more.
    """
    legs = np.empty((0, 4))
    for row in range(modes.size):
        theta = states[row, THETA]
        if modes[row] == REST:
            endings[row] = STANDS
        elif modes[row] == OVERTURNED:
            endings[row] = TO_THE_RIGHT if theta > 0.0 else TO_THE_LEFT
        else:
            endings[row], _ = trace_free_rocking(parameters[row], theta, states[row, OMEGA], max_leans[row], legs)
