"""Simulations of a fit: share of falls, or of rocking, of each block under each shaking."""

from __future__ import annotations

from collections.abc import Generator
from contextlib import closing
from typing import Any

import numpy as np

from seisblock.core.typing import FloatArray, IntArray, Progress
from seisblock.models.rock.verdicts import rock_overturned, rock_verdicts
from seisblock.studies.fit.block_family import PERTURBATION_COUNT, BlockFamily, quasi_random_points
from seisblock.studies.fit.dataset import FELL, Experiment
from seisblock.studies.parallel import map_threads

SHARE_DENOMINATOR = 64
"""Denominator of the shares: the largest number of samples per shaking, and a multiple of every number."""

MIN_HOP = 1e-3
"""Time between two impacts below which rocking ends, s: with p of 25 rad/s it neglects tilts of 1e-4 alpha."""

CHUNK_SIZE = 2**21
"""Samples times runs of one batch."""


def outcome_shares(
    experiment: Experiment,
    family: BlockFamily,
    unit_points: FloatArray,
    runs: IntArray,
    seed: tuple[int, ...],
    *,
    rows: IntArray | None = None,
    progress: Progress | None = None,
) -> IntArray:
    """Return the share of samples of each block that fall, or move, under each shaking, in 64ths, (shakings, blocks).

    The samples of a block fill the range of changes evenly, with another random offset for each shaking and each block, so that the
    errors of the shares are independent.

    Parameters
    ----------
    experiment : Experiment
    family : BlockFamily
    unit_points : (n, d) array, 1
        The blocks, as points of the unit cube.
    runs : (shakings,) array of int
        Samples of each block under each shaking: 1, 2, 4 ... 64.
    seed : tuple of int
    rows : (k,) array of int
        Shakings to simulate; default: all.
    progress : callable
        Called with the number of finished samples and their total.
    """
    rows = np.arange(len(experiment.shakings)) if rows is None else rows
    sizes = {k: max(1, CHUNK_SIZE // (experiment.shakings[k].motion.samples * int(runs[k]))) for k in rows.tolist()}
    chunks = [(i, k, slice(first, first + sizes[k])) for i, k in enumerate(sizes) for first in range(0, len(unit_points), sizes[k])]

    def work(chunk: tuple[int, int, slice]) -> IntArray:
        _, k, part = chunk
        shaking, run_count = experiment.shakings[k], int(runs[k])
        offsets = np.random.default_rng((*seed, k)).random((len(unit_points), 1, PERTURBATION_COUNT))[part]
        shifts = 2.0 * ((offsets + quasi_random_points(run_count, PERTURBATION_COUNT)) % 1.0) - 1.0
        # blocks times samples in one batch; a share is the mean over the samples
        params, gains = family.versions(
            np.repeat(unit_points[part], run_count, axis=0), shifts.reshape(-1, PERTURBATION_COUNT), shaking.motion, shaking.scale
        )
        if experiment.kind == FELL:
            events = rock_overturned(params, shaking.motion, gains, min_hop=MIN_HOP)
        else:
            events = rock_verdicts(params, shaking.motion, gains, min_hop=MIN_HOP).require_complete().max_rotation_ratio > 0.0
        return events.reshape(-1, run_count).sum(axis=1) * (SHARE_DENOMINATOR // run_count)

    shares: Any = np.zeros((len(rows), len(unit_points)), dtype=np.uint8)
    finished, total = 0, len(unit_points) * int(runs[rows].sum())
    results: Generator[IntArray, None, None] = map_threads(work, chunks)
    with closing(results):
        for (i, k, part), share in zip(chunks, results, strict=True):
            shares[i, part] = share
            finished += len(share) * int(runs[k])
            if progress is not None:
                progress(finished, total)
    return shares
