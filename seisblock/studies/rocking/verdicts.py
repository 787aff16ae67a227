"""The verdicts of many rocking runs on all cores."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from seisblock.records import Motion
from seisblock.solvers.rock.rocker import Rocker
from seisblock.solvers.rock.verdicts import Verdicts, rock_verdicts
from seisblock.studies.runs import in_batches
from seisblock.typing import ArrayLike, BoolArray, FloatArray, Progress


def all_verdicts(rockers: Sequence[Rocker], motion: Motion, gains: ArrayLike, *, progress: Progress | None = None) -> Verdicts:
    """Return the verdicts of several blocks, or of one under several gains.

    Parameters
    ----------
    rockers, motion, gains
        As for :func:`~seisblock.solvers.rock.verdicts.rock_verdicts`.
    progress : callable
        Told the number of runs done and the number in all.
    """
    rows = np.atleast_2d(np.asarray(gains, dtype=np.float64))
    runs = max(len(rockers), len(rows))

    def some(part: slice) -> Verdicts:
        return rock_verdicts(rockers[part] if len(rockers) > 1 else rockers, motion, rows[part] if len(rows) > 1 else rows)

    found = list(in_batches(some, runs, progress=progress))
    return Verdicts(*(np.concatenate(column) for column in zip(*((v.overturned, v.max_rotation_ratio) for v in found), strict=True)))


def overturns_at(block: Rocker, motion: Motion, factors: ArrayLike, *, progress: Progress | None = None) -> BoolArray:
    """Return whether a block overturns under a motion times each of some factors, (m,)."""
    scales: FloatArray = np.asarray(factors, dtype=np.float64)
    return all_verdicts([block], motion, scales[:, None] * np.array(block.gains()), progress=progress).overturned
