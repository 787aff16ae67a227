"""Detection of samples that repeat earlier ones exactly, as in overwritten records."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from seisblock.core.typing import FloatArray, IntArray
from seisblock.records import qc_spikes

WINDOW = 20
"""Samples compared at a time; the shortest repetition that is found."""

MIN_VALUES, MIN_STEPS = 12, 10
"""Smallest number of different values, and of different steps between samples, in a window; coarse or quiet samples repeat by chance."""

SMOOTHNESS_RATIO = 0.15
"""Ratio of third to first differences below which samples are those of an analytic wave, which repeats itself."""

PERIODIC_SHARE = 0.5
"""Share of repeated windows that occur at least three times beyond which a motion is periodic."""

_BASE = np.uint64(0x9E3779B97F4A7C15)


class Repetition(NamedTuple):
    """Piece that equals an earlier one: indices of both first samples, and number of samples."""

    first: int
    second: int
    samples: int


def find_repetitions(acceleration: FloatArray) -> list[Repetition]:
    """Return the pieces of a component that repeat an earlier piece sample by sample.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Samples as read.

    Returns
    -------
    list of Repetition
        In the order of their second occurrence; empty for a periodic motion.

    Notes
    -----
    Windows of 20 samples are hashed, and equal hashes verified. JMA announced on 2015-12-04 that very short pieces of some published
    records were overwritten by samples 2 s later.
    """
    repetitions: list[Repetition] = []
    for begin in range(0, max(acceleration.size - WINDOW, 1), qc_spikes.BLOCK):
        piece = acceleration[begin : begin + qc_spikes.BLOCK + WINDOW]
        repetitions += [Repetition(r.first + begin, r.second + begin, r.samples) for r in _find_in_block(piece)]
    return repetitions


def _find_in_block(a: FloatArray) -> list[Repetition]:
    if a.size < 2 * WINDOW:
        return []
    # + 0.0 turns -0.0 into 0.0
    bits = (a + 0.0).view(np.uint64)
    hashes = np.zeros(a.size - WINDOW + 1, dtype=np.uint64)
    with np.errstate(over="ignore"):
        for offset in range(WINDOW):
            hashes *= _BASE
            hashes += bits[offset : offset + hashes.size] >> np.uint64(7)
            hashes ^= bits[offset : offset + hashes.size] << np.uint64(11)
    # stable sorting keeps windows with one hash in order of time
    order = np.argsort(hashes, kind="stable")
    ordered = hashes[order]
    same = np.flatnonzero(ordered[1:] == ordered[:-1])
    if not same.size:
        return []
    # occurrences of one hash are adjacent and in order of time
    starts, seconds = order[same], order[same + 1]
    keep = _is_informative(a, starts)
    starts, seconds = starts[keep], seconds[keep]
    if not starts.size or _is_periodic(hashes, starts):
        return []
    by_time = np.argsort(seconds, kind="stable")
    return _merge_windows(a, starts[by_time], seconds[by_time])


def _is_informative(a: FloatArray, starts: IntArray) -> IntArray:
    """Return the indices of the windows whose samples do not repeat by chance or by smoothness."""
    indices = []
    for index, start in enumerate(starts):
        window = a[start : start + WINDOW]
        steps = np.diff(window)
        # steps of whole multiples of a resolution differ by rounding only
        rounded_steps = np.unique(np.round(steps / max(float(np.abs(steps).max()), 1e-300), 9))
        if np.unique(window).size < MIN_VALUES or rounded_steps.size < MIN_STEPS:
            continue
        if np.median(np.abs(np.diff(window, 3))) < SMOOTHNESS_RATIO * np.median(np.abs(steps)):
            continue
        indices.append(index)
    return np.array(indices, dtype=np.int64)


def _is_periodic(hashes: NDArray[np.uint64], starts: IntArray) -> bool:
    """Return whether most repeated windows occur at least three times."""
    _, inverse, counts = np.unique(hashes, return_inverse=True, return_counts=True)
    return bool(np.mean(counts[inverse[starts]] > 2) > PERIODIC_SHARE)


def _merge_windows(a: FloatArray, starts: IntArray, seconds: IntArray) -> list[Repetition]:
    """Return repetitions of consecutive windows with one lag, verified sample by sample."""
    repetitions: list[Repetition] = []
    # overlapping windows of one repetition have the same lag and follow each other
    for start, second in zip(starts.tolist(), seconds.tolist(), strict=True):
        last = repetitions[-1] if repetitions else None
        lag = second - start
        # uninformative windows in between are part of the piece if they are equal, too
        if (
            last is not None
            and lag == last.second - last.first
            and np.array_equal(a[last.second + last.samples : second], a[last.second + last.samples - lag : start])
        ):
            repetitions[-1] = last._replace(samples=second - last.second + WINDOW)
        elif np.array_equal(a[start : start + WINDOW], a[second : second + WINDOW]):
            repetitions.append(Repetition(start, second, WINDOW))
    return repetitions
