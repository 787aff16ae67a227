"""Samples that stand apart: lone spikes, and the isolated jumps of overwritten pieces."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from seisblock.core.typing import FloatArray, IntArray

NEIGHBOUR_STEPS, EXCLUDED_STEPS = 10, 2
"""How many steps on either side are the usual, and how many next to the one judged are none of them."""

MIN_SURPRISE = 0.05
"""Smallest surprise that counts, m/s^2."""

SURPRISE_RATIO = 25.0
"""How many times the usual it must be."""

STEEPNESS_RATIO = 4.0
"""How many times steeper than the steps beside it a step must be: the apex of a triangle is no spike, its flank no jump."""

SPIKE_ASYMMETRY = 0.5
"""How far the samples on either side of a spike may lie apart, in its height."""

_MARGIN = NEIGHBOUR_STEPS + EXCLUDED_STEPS
_BLOCK = 2**20


def find_spikes_and_jumps(acceleration: FloatArray) -> tuple[IntArray, IntArray]:
    """Return where a sample, or a step between two, stands out from what is on either side.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        As read.

    Returns
    -------
    spikes, jumps : arrays of int
        Indices of the samples that stand apart alone, and of the first samples after a step that does.

    Notes
    -----
    The surprise of a sample is its distance from the mean of its two neighbours, that of a step its difference from the mean of the
    steps beside it. It stands out where it exceeds 5 gal, 25 times the median surprise of the ten before it and of the ten after it, is
    the largest near by, and leads there (and, for a sample, back) four
    times as steeply as the steps beside it. JMA announced on 2015-12-04 that very short pieces of some published records were overwritten
    by what came 2 s later: an end of such a piece is a jump. In records rich in high frequencies both can hide.
    """
    spikes, jumps = _find_end_spikes(acceleration), []
    # in blocks: a day-long record needs no further memory of its size
    for start in range(0, acceleration.size, _BLOCK):
        offset = max(start - 2 * _MARGIN, 0)
        piece = acceleration[offset : start + _BLOCK + 2 * _MARGIN]
        if piece.size < 2 * _MARGIN + 5:
            continue
        block = range(start - offset, min(start + _BLOCK, acceleration.size) - offset)
        step = np.diff(piece)
        lone = {s for s in _find_spikes(step) if s in block}
        spikes += [s + offset for s in lone]
        jumps += [j + offset for j in _find_jumps(step) if j in block and not lone & {j - 2, j - 1, j, j + 1}]
    return np.array(sorted(spikes), dtype=np.int64), np.array(sorted(jumps), dtype=np.int64)


def _find_end_spikes(acceleration: FloatArray) -> list[int]:
    """Return the first and the last sample where they stand apart from the one neighbour that they have."""
    if acceleration.size < _MARGIN + 2:
        return []
    indices = []
    for index, step in ((0, np.abs(np.diff(acceleration[: _MARGIN + 1]))), (-1, np.abs(np.diff(acceleration[-_MARGIN - 1 :]))[::-1])):
        if step[0] > max(MIN_SURPRISE, SURPRISE_RATIO * float(np.median(step[EXCLUDED_STEPS:])), STEEPNESS_RATIO * float(step[1])):
            indices.append(index % acceleration.size)
    return indices


def _find_spikes(step: FloatArray) -> Iterator[int]:
    """Yield the samples that stand apart alone; step k leads from sample k to k + 1."""
    for i in _find_outliers(0.5 * np.abs(np.diff(step))):
        rise, fall = step[i], step[i + 1]
        adjacent = max(abs(step[i - 1]) if i > 0 else 0.0, abs(step[i + 2]) if i + 2 < step.size else 0.0)
        smaller = min(abs(rise), abs(fall))
        if rise * fall < 0.0 and abs(rise + fall) < SPIKE_ASYMMETRY * smaller and smaller > STEEPNESS_RATIO * adjacent:
            yield i + 1


def _find_jumps(step: FloatArray) -> Iterator[int]:
    """Yield the first samples after a step that stands alone."""
    for i in _find_outliers(np.abs(step[1:-1] - 0.5 * (step[:-2] + step[2:]))):
        k = i + 1
        if abs(step[k]) > STEEPNESS_RATIO * max(abs(step[k - 1]), abs(step[k + 1])):
            yield k + 1


def _find_outliers(surprise: FloatArray) -> list[int]:
    """Return where a surprise is the largest near by and far beyond the usual on both sides."""
    padded = np.pad(surprise, _MARGIN)  # beyond an end there is nothing: the other side decides
    total = np.concatenate(([0.0], np.cumsum(padded)))
    mean = (total[2 * _MARGIN + 1 :] - total[: -2 * _MARGIN - 1]) / (2 * _MARGIN + 1)
    # a sieve: what stands alone is 12 times its window's mean, one of three 4 times
    candidates = np.flatnonzero((surprise > MIN_SURPRISE) & (surprise > 3.0 * mean))
    if not candidates.size:
        return []
    windows = sliding_window_view(padded, 2 * _MARGIN + 1)[candidates]
    largest = windows[:, NEIGHBOUR_STEPS : NEIGHBOUR_STEPS + 2 * EXCLUDED_STEPS + 1].max(axis=1)
    background = np.maximum(np.median(windows[:, :NEIGHBOUR_STEPS], axis=1), np.median(windows[:, -NEIGHBOUR_STEPS:], axis=1))
    indices: list[int] = candidates[(surprise[candidates] >= largest) & (surprise[candidates] > SURPRISE_RATIO * background)].tolist()
    return indices
