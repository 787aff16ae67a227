"""What a flight looks like between the samples of a response: a body in the air follows its parabola, and no chord of it."""

from __future__ import annotations

import numpy as np

from seisblock.results import Response
from seisblock.solvers.jump.chain import FLIGHT
from seisblock.solvers.jump.solve import JumpOutcome
from seisblock.typing import FloatArray

FLOWN = 64
"""Points of a flight at the least: more than it is wide on a page."""


def with_flights(response: Response[JumpOutcome]) -> tuple[FloatArray, dict[str, FloatArray]]:
    """Return the time, s, and the rotation, displacement and height of a jump, (n,), its own points and, of flights, those between.

    Notes
    -----
    In the air nothing but gravity and the ground's motion acts: y'' = -g, x'' = -z'', which is straight between samples, and the
    rotation is even ([Sugimoto2017]_ section 3.8). Between two points a known acceleration leaves one curve.
    """
    time, names = response.time, ("rotation", "displacement", "height")
    curves = {name: response[name] for name in names}
    gravity = float(response.options["gravity_m_s2"])
    ground = -response["ground_acceleration"]
    places, added = [], []
    for phase in response.phases:
        if phase.name == FLIGHT:
            inside = np.flatnonzero((time[:-1] >= phase.start_s) & (time[1:] <= phase.end_s) & (np.diff(time) > 0.0))
            each = -(-FLOWN // max(inside.size, 1))
            share = np.arange(1, each) / each
            places.append(np.repeat(inside + 1, share.size))
            added.append(np.tile(share, inside.size))
    if not places:
        return time, curves
    after, share = np.concatenate(places), np.concatenate(added)
    before, long = after - 1, np.diff(time)[after - 1]
    pull: dict[str, tuple[FloatArray | float, FloatArray | float]] = {
        "rotation": (0.0, 0.0),
        "displacement": (ground[before], ground[after] - ground[before]),
        "height": (-gravity, 0.0),
    }
    between = {
        name: values[before] + share * (values[after] - values[before]) + _bow(long, share, *pull[name]) for name, values in curves.items()
    }
    when = np.insert(time, after, time[before] + share * long)
    return when, {name: np.insert(values, after, between[name]) for name, values in curves.items()}


def _bow(long: FloatArray, share: FloatArray, start: FloatArray | float, change: FloatArray | float) -> FloatArray:
    """Return how far a curve lies from the chord of a stretch, at a share of its length, s, whose second derivative is even or straight."""
    bow: FloatArray = -(long**2) * share * (1.0 - share) * (start / 2.0 + change * (1.0 + share) / 6.0)
    return bow
