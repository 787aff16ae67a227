"""How long the path is that a body slides, forth and back."""

from __future__ import annotations

import math

import numpy as np

from seisblock.core.typing import FloatArray
from seisblock.dynamics import Trajectory
from seisblock.models.slide.model import FLIGHT, LEVEL, SLIP


def path_length(trajectory: Trajectory) -> float:
    """Return the length of the path slid, m: the slip turns at events alone, but in flight, where it is looked at between samples, too."""
    changes = trajectory.events
    if (changes.target % LEVEL == FLIGHT).any():
        return _length_between_samples(trajectory)
    slip = np.append(changes.before[:, SLIP], trajectory.final[SLIP])
    return math.fsum(np.abs(np.diff(slip, prepend=0.0)).tolist())


def _length_between_samples(trajectory: Trajectory) -> float:
    """Return the length of the path, m, from one sample or event to the next. Rounded once, whatever its pieces."""
    increments, last_slip = list[FloatArray](), np.empty(0)
    for path in trajectory.iter_paths():
        slip = np.concatenate([last_slip, path.values(SLIP)])
        increment, last_slip = np.abs(np.diff(slip)), slip[-1:]
        increments.append(increment[increment > 0.0])
    return math.fsum(distance for part in increments for distance in part.tolist())
