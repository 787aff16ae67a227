"""Verdicts of many rocking runs on all cores."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import fields

import numpy as np

from seisblock.core.typing import ArrayLike, BoolArray, FloatArray, Progress
from seisblock.models.rock.free_rocking import raise_if_endless
from seisblock.models.rock.params import RockBatchParams, RockParams
from seisblock.models.rock.verdicts import Verdicts, rock_verdicts
from seisblock.records import Motion
from seisblock.studies.parallel import cpu_count, map_batches

CHUNK_SIZE = 4_000_000
"""Samples times runs per thread between two progress reports."""


def parallel_verdicts(
    blocks: RockBatchParams | Sequence[RockParams], motion: Motion, gains: ArrayLike, *, progress: Progress | None = None
) -> Verdicts:
    """Return the verdicts of several blocks, or of one block under several gains.

    Parameters
    ----------
    blocks, motion, gains
        As in :func:`~seisblock.models.rock.verdicts.rock_verdicts`.
    progress : callable
        Called with the number of finished runs and the total.

    Raises
    ------
    SolverError
        If no run has a result; a single run without a result is marked in the verdicts.
    """
    rows = np.atleast_2d(np.asarray(gains, dtype=np.float64))
    runs = max(len(blocks), len(rows))
    # small enough for a progress report and for one part per core
    size = max(1, min(CHUNK_SIZE // motion.samples, math.ceil(runs / cpu_count())))

    def solve_batch(part: slice) -> Verdicts:
        return rock_verdicts(blocks[part] if len(blocks) > 1 else blocks, motion, rows[part] if len(rows) > 1 else rows)

    batches = list(map_batches(solve_batch, runs, size=size, progress=progress))
    verdicts = Verdicts(*(np.concatenate([getattr(part, field.name) for part in batches]) for field in fields(Verdicts)))
    raise_if_endless(bool(verdicts.gave_up.all()))
    return verdicts


def overturns_at(block: RockParams, motion: Motion, factors: ArrayLike, *, progress: Progress | None = None) -> BoolArray:
    """Return True for each factor on a motion at which a block overturns, (m,)."""
    scales: FloatArray = np.asarray(factors, dtype=np.float64)
    return parallel_verdicts([block], motion, scales[:, None] * np.array(block.gains()), progress=progress).require_complete().overturned
