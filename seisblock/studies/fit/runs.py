"""The runs behind a fit: for each shaking and each block which share of the block's versions falls, or moves."""

from __future__ import annotations

from collections.abc import Generator
from contextlib import closing

import numpy as np

from seisblock.solvers.rock.verdicts import rock_verdicts
from seisblock.studies.fit.blocks import CHANGES, Family, spread_evenly
from seisblock.studies.fit.experiment import FELL, Experiment
from seisblock.studies.runs import in_threads
from seisblock.typing import FloatArray, IntArray, Progress

LEVELS = 64
"""Shares are kept in so many parts: no block has more versions under one shaking, and the number of them divides it."""

AT_ONCE = 2**21
"""Samples times runs that are followed at a time."""


def shares_of(
    experiment: Experiment,
    family: Family,
    places: FloatArray,
    runs: IntArray,
    seed: tuple[int, ...],
    *,
    progress: Progress | None = None,
) -> IntArray:
    """Return how often the versions of each block fall, or move, under each shaking, in 64ths, (shakings, blocks).

    The versions of a block fill the range of changes evenly, from another begin for each shaking and each block: what is by chance in one
    share is not in another.

    Parameters
    ----------
    experiment : Experiment
    family : Family
    places : (n, d) array, 1
        The blocks, as points of the unit cube.
    runs : (shakings,) array of int
        Versions of each block under each shaking: 1, 2, 4 ... 64.
    seed : tuple of int
    progress : callable
        Told the number of shakings done and the number in all.
    """

    def work(k: int) -> IntArray:
        shaking, many = experiment.shakings[k], int(runs[k])
        begins = np.random.default_rng((*seed, k)).random((len(places), 1, CHANGES))
        shifts = 2.0 * ((begins + spread_evenly(many, CHANGES)) % 1.0) - 1.0
        happened = np.zeros(len(places), dtype=np.int64)
        size = max(1, AT_ONCE // (shaking.motion.samples * many))
        for first in range(0, len(places), size):
            part = slice(first, first + size)
            some, gains = family.versions(
                np.repeat(places[part], many, axis=0), shifts[part].reshape(-1, CHANGES), shaking.motion, shaking.scale
            )
            found = rock_verdicts(some, shaking.motion, gains).answered()
            seen = found.overturned if experiment.kind == FELL else found.max_rotation_ratio > 0.0
            happened[part] = seen.reshape(-1, many).sum(axis=1)
        return happened * (LEVELS // many)

    answers: Generator[IntArray, None, None] = in_threads(work, range(len(experiment.shakings)))
    rows = []
    with closing(answers):
        for done, row in enumerate(answers, start=1):
            rows.append(row.astype(np.uint8))
            if progress is not None:
                progress(done, len(experiment.shakings))
    return np.array(rows)
