"""Interpolation of a jump between samples: parabola in flight, circular arc in rocking."""

from __future__ import annotations

from collections.abc import Callable, Collection

import numpy as np

from seisblock.core.results import Phase, Response
from seisblock.core.typing import FloatArray, IntArray
from seisblock.models.jump.chain import JumpPhase
from seisblock.models.jump.solve import JumpOutcome

POINTS_PER_PHASE: dict[str, int] = {JumpPhase.FLIGHT: 64, JumpPhase.ROCKING: 24}
"""Smallest number of points per phase for a smooth curve, in the close-up as well."""


def interpolate_phases(
    response: Response[JumpOutcome], phases: Collection[str] = (JumpPhase.ROCKING, JumpPhase.FLIGHT)
) -> tuple[FloatArray, dict[str, FloatArray]]:
    """Return time, s, and rotation, displacement and height, (n,), of a jump with points inserted in given phases.

    After landing no points are inserted, since stick-slip between two samples is unknown.

    Notes
    -----
    In flight y'' = -g and x'' = -z'', linear between samples, and the rotation is uniform ([Sugimoto2017]_ section 3.8). Two points and
    the acceleration between them define the curve. In rocking the acceleration follows from the tilt ([Sugimoto2017]_ eq. (3a)), and
    the centroid moves on an arc about the corner in contact.
    """
    time = response.time
    curves = {name: response[name] for name in ("rotation", "displacement", "height")}
    draw: dict[str, Callable[..., dict[str, FloatArray]]] = {JumpPhase.FLIGHT: _flight_points, JumpPhase.ROCKING: _rocking_points}
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
    """Return the steps of a phase, (m,), and the fractions of a step at which points are inserted, (k,), none in a long phase."""
    # both ends of an event have the same time: an interval of length zero has no inner points
    inside = np.flatnonzero((time[:-1] >= phase.start_s) & (time[1:] <= phase.end_s) & (np.diff(time) > 0.0))
    count = -(-POINTS_PER_PHASE[phase.name] // max(inside.size, 1))
    return inside, np.arange(1, count) / count


def _flight_points(response: Response[JumpOutcome], gaps: IntArray, share: FloatArray) -> dict[str, FloatArray]:
    """Return the inserted points of a flight, (m, k) per channel."""
    gravity = float(response.options.gravity)
    fall, ground = np.full(response.time.size, -gravity), -response["ground_acceleration"]
    even = np.zeros(response.time.size)
    pulls = {"rotation": even, "displacement": ground, "height": fall}
    return {name: _interpolate(response.time, response[name], pull, gaps, share) for name, pull in pulls.items()}


def _rocking_points(response: Response[JumpOutcome], gaps: IntArray, share: FloatArray) -> dict[str, FloatArray]:
    """Return the inserted points of rocking, (m, k) per channel."""
    block, gravity, rotation = response.body, float(response.options.gravity), response["rotation"]
    # z'' > 0 tilts the block to -x: the tilt is positive in the forward frame of the solver
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
    """Return a curve at fractions of steps, (m, k), with a second derivative linear in each step."""
    # integral of x'' = start + change s over the step, minus the chord
    step, start, rise = (array[gaps, None] for array in (np.diff(time), pull, np.diff(values)))
    change = np.diff(pull)[gaps, None]
    deviation: FloatArray = -(step**2) * share * (1.0 - share) * (start / 2.0 + change * (1.0 + share) / 6.0)
    return values[gaps, None] + share * rise + deviation
