"""Samples that stand apart: lone spikes, and the isolated jumps of overwritten pieces."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from seisblock.typing import FloatArray, IntArray

REACH, GUARD = 10, 2
"""How many steps on either side are the usual, and how many next to the one judged are none of them."""

FLOOR = 0.05
"""Smallest surprise that counts, m/s^2."""

RATIO = 25.0
"""How many times the usual it must be."""

STEEPER = 4.0
"""How many times steeper than the steps beside it a step must be: the apex of a triangle is no spike, its flank no jump."""

ASTRAY = 0.5
"""How far the samples on either side of a spike may lie apart, in its height."""

_MARGIN = REACH + GUARD
_BLOCK = 2**20


def spikes_and_jumps(acceleration: FloatArray) -> tuple[IntArray, IntArray]:
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
    spikes, jumps = _end_spikes(acceleration), []
    # in blocks: a day-long record needs no further memory of its size
    for start in range(0, acceleration.size, _BLOCK):
        first = max(start - 2 * _MARGIN, 0)
        piece = acceleration[first : start + _BLOCK + 2 * _MARGIN]
        if piece.size < 2 * _MARGIN + 5:
            continue
        own = range(start - first, min(start + _BLOCK, acceleration.size) - first)
        step = np.diff(piece)
        alone = {s for s in _spikes(step) if s in own}
        spikes += [s + first for s in alone]
        jumps += [j + first for j in _jumps(step) if j in own and not alone & {j - 2, j - 1, j, j + 1}]
    return np.array(sorted(spikes), dtype=np.int64), np.array(sorted(jumps), dtype=np.int64)


def _end_spikes(acceleration: FloatArray) -> list[int]:
    """Return the first and the last sample where they stand apart from the one neighbour that they have."""
    if acceleration.size < _MARGIN + 2:
        return []
    found = []
    for index, step in ((0, np.abs(np.diff(acceleration[: _MARGIN + 1]))), (-1, np.abs(np.diff(acceleration[-_MARGIN - 1 :]))[::-1])):
        if step[0] > max(FLOOR, RATIO * float(np.median(step[GUARD:])), STEEPER * float(step[1])):
            found.append(index % acceleration.size)
    return found


def _spikes(step: FloatArray) -> Iterator[int]:
    """Yield the samples that stand apart alone; step k leads from sample k to k + 1."""
    for i in _standing_out(0.5 * np.abs(np.diff(step))):
        there, back = step[i], step[i + 1]
        beside = max(abs(step[i - 1]) if i > 0 else 0.0, abs(step[i + 2]) if i + 2 < step.size else 0.0)
        least = min(abs(there), abs(back))
        if there * back < 0.0 and abs(there + back) < ASTRAY * least and least > STEEPER * beside:
            yield i + 1


def _jumps(step: FloatArray) -> Iterator[int]:
    """Yield the first samples after a step that stands alone."""
    for i in _standing_out(np.abs(step[1:-1] - 0.5 * (step[:-2] + step[2:]))):
        k = i + 1
        if abs(step[k]) > STEEPER * max(abs(step[k - 1]), abs(step[k + 1])):
            yield k + 1


def _standing_out(surprise: FloatArray) -> list[int]:
    """Return where a surprise is the largest near by and far beyond the usual on both sides."""
    padded = np.pad(surprise, _MARGIN)  # beyond an end there is nothing: the other side decides
    total = np.concatenate(([0.0], np.cumsum(padded)))
    mean = (total[2 * _MARGIN + 1 :] - total[: -2 * _MARGIN - 1]) / (2 * _MARGIN + 1)
    # a sieve: what stands alone is 12 times its window's mean, one of three 4 times
    candidates = np.flatnonzero((surprise > FLOOR) & (surprise > 3.0 * mean))
    if not candidates.size:
        return []
    around = sliding_window_view(padded, 2 * _MARGIN + 1)[candidates]
    largest = around[:, REACH : REACH + 2 * GUARD + 1].max(axis=1)
    usual = np.maximum(np.median(around[:, :REACH], axis=1), np.median(around[:, -REACH:], axis=1))
    found: list[int] = candidates[(surprise[candidates] >= largest) & (surprise[candidates] > RATIO * usual)].tolist()
    return found
