"""Contact forces of a rocking block: friction demand and loss of contact, the limits of the pure rocking model.

Forces are evaluated at every row of a trajectory, then inside the intervals next to rows of large friction demand or small normal force.
There the tilt is interpolated by the quintic Hermite polynomial of angle, angular velocity and angular acceleration, with an error below
1e-9 of the tilt at 100 Hz.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from seisblock._jit import kernel, types
from seisblock.core.typing import FloatArray
from seisblock.dynamics import Trajectory
from seisblock.dynamics.array_types import BLOCK, INTEGER_TABLE, INTEGERS, MATRIX, VECTOR
from seisblock.dynamics.events import EVENT_FROM, EVENT_SAMPLE, EVENT_TO
from seisblock.models.rock import model
from seisblock.models.rock.expansion import OMEGA, THETA, sine_cosine
from seisblock.models.rock.model import (
    ALPHA_LEFT,
    ALPHA_RIGHT,
    BEYOND_LEFT,
    GRAVITY,
    IS_LINEAR,
    LEVER_LEFT,
    LEVER_RIGHT,
    REST,
    RESTITUTION_LEFT,
    TO_LEFT,
)
from seisblock.models.rock.params import RockParams
from seisblock.records import Motion

_t = types()

INTERVALS = 8
"""Number of parts of an interval between two rows at whose ends the forces are evaluated."""

NEAR_DEMAND, NEAR_NORMAL = 0.75, 0.5
"""An interval is refined if the demand at one end exceeds this share of the largest one so far, or the normal force falls below this share
of the weight: a peak between two rows 0.01 s apart exceeds them by a few per cent."""

RADIUS_RIGHT, RADIUS_LEFT = RESTITUTION_LEFT + 1, RESTITUTION_LEFT + 2
"""Parameters of the forces after those of the model."""

READ_ONLY_VECTOR = _t.Array(_t.float64, 1, "C", readonly=True)

TIME, TILT, SPIN, PUSH, WEIGHT, PHASE, RATIO, NORMAL, LARGEST, LARGEST_TIME, LOST_TIME, BEFORE = range(12)
SEARCH_SIZE = 12
"""State of the search: last row with its demand and normal force; largest demand so far and its time; first loss of contact (inf: none);
end of the search."""


@dataclass(frozen=True)
class FrictionDemand:
    """Friction coefficient required for pure rocking, and loss of contact.

    Parameters
    ----------
    friction : float
        Largest abs(H/N); infinite if contact is lost.
    friction_s : float or None
        Time of the largest demand.
    contact_lost_s : float or None
        First time with N <= 0.
    """

    friction: float
    friction_s: float | None
    contact_lost_s: float | None


@kernel(_t.UniTuple(_t.float64, 3)(VECTOR, _t.int64, *[_t.float64] * 4))
def _forces(p, mode, theta, omega, push, weight):
    """Return theta'', H/m and N/m; at rest the base carries H = a and N = g + a_v between the corners (derived here)."""
    if mode == REST:
        return 0.0, push, weight
    is_left = mode in (TO_LEFT, BEYOND_LEFT)
    psi = -p[ALPHA_LEFT] - theta if is_left else p[ALPHA_RIGHT] - theta
    lever, radius = (p[LEVER_LEFT], p[RADIUS_LEFT]) if is_left else (p[LEVER_RIGHT], p[RADIUS_RIGHT])
    sine, cosine = sine_cosine(psi)
    alpha = -lever * (weight * psi + push if p[IS_LINEAR] != 0.0 else weight * sine + push * cosine)
    return alpha, push + radius * (alpha * cosine + omega * omega * sine), weight + radius * (alpha * sine - omega * omega * cosine)


@kernel(_t.void(VECTOR, VECTOR, *[_t.float64] * 5))
def _refine(p, search, time, theta, omega, push, weight):
    """Search the interval from the last row to this one for a larger demand and for the loss of contact."""
    mode, step = int(search[PHASE]), time - search[TIME]
    first, _, _ = _forces(p, mode, search[TILT], search[SPIN], search[PUSH], search[WEIGHT])
    last, horizontal, end_normal = _forces(p, mode, theta, omega, push, weight)
    # quintic Hermite polynomial: remainders of value, slope and curvature after the quadratic start, in units of the interval
    v0, a0 = search[SPIN] * step, first * step * step
    rise = theta - search[TILT] - v0 - a0 / 2
    speed, bend = omega * step - v0 - a0, last * step * step - a0
    c3, c4, c5 = 10 * rise - 4 * speed + bend / 2, -15 * rise + 7 * speed - bend, 6 * rise - 3 * speed + bend / 2
    before, ratio, normal = math.nan, search[RATIO], search[NORMAL]
    end_ratio = abs(horizontal) / end_normal
    part = step / INTERVALS
    for k in range(1, INTERVALS + 1):
        u = k / INTERVALS
        if k == INTERVALS:
            next_ratio, next_normal = end_ratio, end_normal
        else:
            tilt = search[TILT] + u * (v0 + u * (a0 / 2 + u * (c3 + u * (c4 + u * c5))))
            spin = (v0 + u * (a0 + u * (3 * c3 + u * (4 * c4 + u * 5 * c5)))) / step
            # the record is piecewise linear; only the tilt needs the higher order
            _, horizontal, next_normal = _forces(
                p, mode, tilt, spin, search[PUSH] + u * (push - search[PUSH]), search[WEIGHT] + u * (weight - search[WEIGHT])
            )
            next_ratio = abs(horizontal) / next_normal
        if next_normal <= 0.0:
            # zero of N by linear interpolation
            search[LOST_TIME] = search[TIME] + u * step - part * next_normal / (next_normal - normal)
            return
        # maximum of the parabola through a value and its neighbours
        if k > 1 and ratio > search[LARGEST] and before <= ratio >= next_ratio:
            curvature = before - 2 * ratio + next_ratio
            offset = 0.5 * (before - next_ratio) / curvature if curvature < 0.0 else 0.0
            search[LARGEST] = ratio + 0.25 * (next_ratio - before) * offset
            search[LARGEST_TIME] = search[TIME] + u * step - part + offset * part
        before, ratio, normal = ratio, next_ratio, next_normal


@kernel(_t.boolean(VECTOR, VECTOR, _t.int64, *[_t.float64] * 5))
def _add_row(p, search, mode, time, theta, omega, push, weight):
    """Search up to the next row of a trajectory; return whether the search goes on."""
    if time > search[BEFORE]:
        return False
    _, horizontal, normal = _forces(p, mode, theta, omega, push, weight)
    ratio = abs(horizontal) / normal if normal > 0.0 else math.inf
    # intervals between rows of one mode of rocking; at rest the ratio of linear functions is extreme at a sample
    if mode == search[PHASE] and mode != REST and time > search[TIME]:
        is_large = max(ratio, search[RATIO]) >= NEAR_DEMAND * search[LARGEST]
        if is_large or min(normal, search[NORMAL]) < NEAR_NORMAL * weight:
            _refine(p, search, time, theta, omega, push, weight)
    elif normal <= 0.0:
        # contact lost at a row, for example just after an impact
        search[LOST_TIME] = time
    if search[LOST_TIME] < math.inf:
        return False
    if ratio > search[LARGEST]:
        search[LARGEST], search[LARGEST_TIME] = ratio, time
    search[TIME], search[TILT], search[SPIN], search[PUSH], search[WEIGHT] = time, theta, omega, push, weight
    search[PHASE], search[RATIO], search[NORMAL] = mode, ratio, normal
    return True


PATH = (_t.int64, _t.float64, MATRIX, INTEGERS, READ_ONLY_VECTOR, READ_ONLY_VECTOR, _t.float64, _t.int64, INTEGER_TABLE, VECTOR, BLOCK)
"""Types of a piece of a path: number of its first sample, dt, states, modes, ground motion along and up with the factor on the latter,
number of events, and their table, times and limits."""


@kernel(_t.boolean(VECTOR, VECTOR, *PATH))
def search_path(p, search, first, dt, states, modes, push, up, gain_up, event_count, events, taus, limits):
    """Search one piece of a path, whose samples and both sides of whose events are rows; return whether the search goes on."""
    event = 0
    for k in range(modes.size + 1):
        # an event after sample k stands before sample k + 1
        while event < event_count and (events[event, EVENT_SAMPLE] < first + k or k == modes.size):
            sample, share = events[event, EVENT_SAMPLE], taus[event] / dt
            following = min(sample + 1, push.size - 1)
            time, ground = sample * dt + taus[event], push[sample] + share * (push[following] - push[sample])
            weight = p[GRAVITY] + gain_up * (up[sample] + share * (up[following] - up[sample]))
            for side in range(2):
                mode = events[event, EVENT_TO if side == 1 else EVENT_FROM]
                if not _add_row(p, search, mode, time, limits[event, side, THETA], limits[event, side, OMEGA], ground, weight):
                    return False
            event += 1
        if k < modes.size:
            sample = first + k
            weight = p[GRAVITY] + gain_up * up[sample]
            # most samples are at rest, below the largest demand
            if modes[k] == REST and search[PHASE] == REST and abs(push[sample]) < search[LARGEST] * weight:
                continue
            if not _add_row(p, search, modes[k], sample * dt, states[k, THETA], states[k, OMEGA], push[sample], weight):
                return False
    return True


@kernel(_t.void(VECTOR, _t.float64))
def start_search(search, until_s):
    """Begin a search that ends at a time, s after sample 0."""
    search[PHASE], search[LARGEST], search[LOST_TIME], search[BEFORE] = REST, -1.0, math.inf, until_s


def friction_demand(params: RockParams, motion: Motion, trajectory: Trajectory, *, until_s: float) -> FrictionDemand:
    """Return the largest friction demand and the loss of contact before `until_s` (s after sample 0), impacts excluded.

    The centre of gravity moves relative to the ground as a point at distance R from the corner in contact (derived here): with
    psi = s alpha - theta, H/m = a + R (theta'' cos(psi) + theta'^2 sin(psi)), N/m = g + a_v + R (theta'' sin(psi) - theta'^2 cos(psi)).
    """
    p, search = parameters(params, motion.dt), np.empty(SEARCH_SIZE)
    start_search(search, until_s)
    push = motion.horizontal
    up = motion.vertical if params.vertical != 0.0 else push
    for path in trajectory.iter_paths():
        log = path.events
        piece = path.first, path.dt, path.states, path.modes, push, up, params.vertical, len(log), log.log, log.tau, log.limits
        if not search_path(p, search, *piece):
            break
    return make_demand(search.tolist())


def parameters(params: RockParams, dt: float) -> FloatArray:
    """Return the parameters of the model followed by the radii of the corners, (13,)."""
    return np.append(model.parameters(params, dt), params.radii)


def make_demand(search: Sequence[float]) -> FrictionDemand:
    """Return the result of a search."""
    if search[LOST_TIME] < math.inf:
        return FrictionDemand(math.inf, search[LOST_TIME], search[LOST_TIME])
    return FrictionDemand(search[LARGEST], search[LARGEST_TIME], None) if search[LARGEST] >= 0.0 else FrictionDemand(0.0, None, None)
