"""How long the path is that a body slides, forth and back."""

from __future__ import annotations

import math

import numpy as np

from seisblock.dynamics import Trajectory
from seisblock.solvers.slide.model import FLIGHT, LEVEL, SLIP
from seisblock.typing import FloatArray


def length_slid(trajectory: Trajectory) -> float:
    """Return the length of the path slid, m: the slip turns at events alone, but in flight, where it is looked at between samples, too."""
    changes = trajectory.changes
    if (changes.target % LEVEL == FLIGHT).any():
        return _length_between_samples(trajectory)
    slip = np.append(changes.before[:, SLIP], trajectory.final[SLIP])
    return math.fsum(np.abs(np.diff(slip, prepend=0.0)).tolist())


def _length_between_samples(trajectory: Trajectory) -> float:
    """Return the length of the path, m, from one sample or event to the next. Rounded once, whatever its pieces."""
    ways, reached = list[FloatArray](), np.empty(0)
    for path in trajectory.walk():
        slip = np.concatenate([reached, path.values(SLIP)])
        way, reached = np.abs(np.diff(slip)), slip[-1:]
        ways.append(way[way > 0.0])
    return math.fsum(each for part in ways for each in part.tolist())
