"""Length of the slip path of a sliding body."""

from __future__ import annotations

import math

import numpy as np

from seisblock.core.typing import FloatArray
from seisblock.dynamics import Trajectory
from seisblock.models.slide.model import FLIGHT, LEVEL, SLIP


def path_length(trajectory: Trajectory) -> float:
    """Return the length of the slip path, m.

    Without flight the slip reverses at events only, so that its values there suffice; with flight all samples are used.
    """
    changes = trajectory.events
    if (changes.target % LEVEL == FLIGHT).any():
        return _length_between_samples(trajectory)
    slip = np.append(changes.before[:, SLIP], trajectory.final[SLIP])
    return math.fsum(np.abs(np.diff(slip, prepend=0.0)).tolist())


def _length_between_samples(trajectory: Trajectory) -> float:
    """Return the length of the path over all samples and events, m; `math.fsum` makes it independent of the chunks of the trajectory."""
    increments, last_slip = list[FloatArray](), np.empty(0)
    for path in trajectory.iter_paths():
        slip = np.concatenate([last_slip, path.values(SLIP)])
        increment, last_slip = np.abs(np.diff(slip)), slip[-1:]
        increments.append(increment[increment > 0.0])
    return math.fsum(distance for part in increments for distance in part.tolist())
