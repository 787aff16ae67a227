"""What a jump looks like between the samples of its response: a body in the air follows its parabola, a leaning one its arc, no chord."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from seisblock.core.results import Phase, Response
from seisblock.core.typing import FloatArray, IntArray
from seisblock.models.jump.chain import FLIGHT, ROCKING
from seisblock.models.jump.solve import JumpOutcome

POINTS_PER_PHASE = {FLIGHT: 64, ROCKING: 24}
"""Of a phase at the least: with so many no chord is seen, of a flight not where it is enlarged either."""


def interpolate_phases(
    response: Response[JumpOutcome], phases: Collection[str] = (ROCKING, FLIGHT)
) -> tuple[FloatArray, dict[str, FloatArray]]:
    """Return the time, s, and the rotation, displacement and height of a jump, (n,): its own points and, in phases of some names, more.

    What has landed slips, sticks and slips again between two samples: there its own points stand alone.

    Notes
    -----
    In the air nothing but gravity and the ground's motion acts: y'' = -g, x'' = -z'', which is straight between samples, and the
    rotation is even ([Sugimoto2017]_ section 3.8). Between two points a known acceleration leaves one curve. A rocking block's
    follows from its tilt ([Sugimoto2017]_ eq. (3a)), and its centroid goes round the corner on which it stands.
    """
    time = response.time
    curves = {name: response[name] for name in ("rotation", "displacement", "height")}
    draw = {FLIGHT: _flight_points, ROCKING: _rocking_points}
    places: list[IntArray] = []
    times: list[FloatArray] = []
    insertions: list[dict[str, FloatArray]] = []
    for phase in response.phases:
        if phase.name not in phases or phase.name not in draw:
            continue
        gaps, share = _phase_gaps(time, phase)
        if gaps.size and share.size:
            places.append(np.repeat(gaps + 1, share.size))
            times.append((time[gaps, None] + share * np.diff(time)[gaps, None]).ravel())
            insertions.append({name: values.ravel() for name, values in draw[phase.name](response, gaps, share).items()})
    if not places:
        return time, curves
    positions = np.concatenate(places)
    inserted = {name: np.concatenate([points[name] for points in insertions]) for name in curves}
    return np.insert(time, positions, np.concatenate(times)), {
        name: np.insert(curve, positions, inserted[name]) for name, curve in curves.items()
    }


def _phase_gaps(time: FloatArray, phase: Phase) -> tuple[IntArray, FloatArray]:
    """Return before which gaps of a phase points stand, (m,), and at which shares of each gap more are wanted, (k,): none in a long one."""
    inside = np.flatnonzero((time[:-1] >= phase.start_s) & (time[1:] <= phase.end_s) & (np.diff(time) > 0.0))
    count = -(-POINTS_PER_PHASE[phase.name] // max(inside.size, 1))
    return inside, np.arange(1, count) / count


def _flight_points(response: Response[JumpOutcome], gaps: IntArray, share: FloatArray) -> dict[str, FloatArray]:
    """Return a flight's curves between its points, (m, k) each."""
    gravity = float(response.options["gravity_m_s2"])
    fall, ground = np.full(response.time.size, -gravity), -response["ground_acceleration"]
    even = np.zeros(response.time.size)
    pulls = {"rotation": even, "displacement": ground, "height": fall}
    return {name: _interpolate(response.time, response[name], pull, gaps, share) for name, pull in pulls.items()}


def _rocking_points(response: Response[JumpOutcome], gaps: IntArray, share: FloatArray) -> dict[str, FloatArray]:
    """Return a rocking's curves between its points, (m, k) each."""
    block, gravity, rotation = response.body, float(response.options["gravity_m_s2"]), response["rotation"]
    # z'' > 0 tips it to -x, see the solver: the tilt is positive in the frame in which the chain goes forward
    sign = -1.0 if rotation[gaps].sum() > 0.0 else 1.0
    tilt, push = -sign * rotation, sign * response["ground_acceleration"]
    lean = block.slenderness - tilt
    pull = block.mass * block.radius / block.corner_inertia * (push * np.cos(lean) - gravity * np.sin(lean))
    leans = block.slenderness - _interpolate(response.time, tilt, pull, gaps, share)
    start = lean[gaps, None]
    return {
        "rotation": -sign * (block.slenderness - leans),
        "displacement": response["displacement"][gaps, None] + sign * block.radius * (np.sin(leans) - np.sin(start)),
        "height": response["height"][gaps, None] + block.radius * (np.cos(leans) - np.cos(start)),
    }


def _interpolate(time: FloatArray, values: FloatArray, pull: FloatArray, gaps: IntArray, share: FloatArray) -> FloatArray:
    """Return a curve at shares of some gaps between its points, (m, k), whose second derivative is straight in each."""
    step, start, rise = (array[gaps, None] for array in (np.diff(time), pull, np.diff(values)))
    change = np.diff(pull)[gaps, None]
    bow: FloatArray = -(step**2) * share * (1.0 - share) * (start / 2.0 + change * (1.0 + share) / 6.0)
    return values[gaps, None] + share * rise + bow
