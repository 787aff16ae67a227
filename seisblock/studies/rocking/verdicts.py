"""The verdicts of many rocking runs on all cores."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import fields

import numpy as np

from seisblock.records import Motion
from seisblock.solvers.rock.aftermath import refuse_endless
from seisblock.solvers.rock.rocker import Rocker, Rockers
from seisblock.solvers.rock.verdicts import Verdicts, rock_verdicts
from seisblock.studies.runs import cores, in_batches
from seisblock.typing import ArrayLike, BoolArray, FloatArray, Progress

SAMPLES_AT_ONCE = 4_000_000
"""Samples times runs that one thread takes before it says how far it is."""


def all_verdicts(blocks: Rockers | Sequence[Rocker], motion: Motion, gains: ArrayLike, *, progress: Progress | None = None) -> Verdicts:
    """Return the verdicts of several blocks, or of one under several gains.

    Parameters
    ----------
    blocks, motion, gains
        As for :func:`~seisblock.solvers.rock.verdicts.rock_verdicts`.
    progress : callable
        Told the number of runs done and the number in all.

    Raises
    ------
    SolverError
        If no run has an answer; a single one without an answer is marked in the verdicts.
    """
    rows = np.atleast_2d(np.asarray(gains, dtype=np.float64))
    runs = max(len(blocks), len(rows))
    size = max(1, min(SAMPLES_AT_ONCE // motion.samples, math.ceil(runs / cores())))

    def some(part: slice) -> Verdicts:
        return rock_verdicts(blocks[part] if len(blocks) > 1 else blocks, motion, rows[part] if len(rows) > 1 else rows)

    found = list(in_batches(some, runs, size=size, progress=progress))
    verdicts = Verdicts(*(np.concatenate([getattr(part, field.name) for part in found]) for field in fields(Verdicts)))
    refuse_endless(bool(verdicts.gave_up.all()))
    return verdicts


def overturns_at(block: Rocker, motion: Motion, factors: ArrayLike, *, progress: Progress | None = None) -> BoolArray:
    """Return whether a block overturns under a motion times each of some factors, (m,)."""
    scales: FloatArray = np.asarray(factors, dtype=np.float64)
    return all_verdicts([block], motion, scales[:, None] * np.array(block.gains()), progress=progress).answered().overturned
