"""Detection of samples that repeat earlier ones exactly, as in overwritten records."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
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

_BASE, _MIXER = np.uint64(0x9E3779B97F4A7C15), np.uint64(0xBF58476D1CE4E5B9)
_ANCHORS, _ANCHOR_BASE = 9, np.uint32(0x85EBCA6B)
_CHUNK, _TABLE = 2**14, 2**18


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
    Each window of 20 samples is represented by the smallest hash of the nine runs of 12 samples in it, as in winnowing (Schleimer,
    Wilkerson and Aiken, 2003): equal windows have equal representatives. Only windows whose representative occurs elsewhere are hashed
    themselves, and equal hashes verified. JMA announced on 2015-12-04 that very short pieces of some published records were overwritten by
    samples 2 s later.
    """
    repetitions: list[Repetition] = []
    for begin in range(0, max(acceleration.size - WINDOW, 1), qc_spikes.BLOCK):
        piece = acceleration[begin : begin + qc_spikes.BLOCK + WINDOW]
        repetitions += [Repetition(r.first + begin, r.second + begin, r.samples) for r in _find_in_block(piece)]
    return repetitions


def _find_in_block(a: FloatArray) -> list[Repetition]:
    if a.size < 2 * WINDOW:
        return []
    windows = _find_candidates(a)
    if not windows.size:
        return []
    hashes = _hash_windows(a, windows)
    order = np.argsort(hashes, kind="stable")
    windows, hashes = windows[order], hashes[order]
    same = np.flatnonzero(hashes[1:] == hashes[:-1])
    # occurrences of one hash are adjacent and in order of time
    starts, seconds = windows[same], windows[same + 1]
    keep = _is_informative(a, starts)
    starts, seconds = starts[keep], seconds[keep]
    if not starts.size or _is_periodic(hashes, hashes[same[keep]]):
        return []
    by_time = np.argsort(seconds, kind="stable")
    return _merge_windows(a, starts[by_time], seconds[by_time])


def _find_candidates(a: FloatArray) -> IntArray:
    """Return the first samples of the windows whose representative occurs elsewhere, too, in order of time."""
    firsts, representatives = [], []
    for begin in range(0, a.size - WINDOW + 1, qc_spikes.PIECE):
        smallest = _smallest_anchors(a[begin : begin + qc_spikes.PIECE + WINDOW - 1])
        # successive windows with one representative contain the same anchor
        changes = np.append(0, 1 + np.flatnonzero(smallest[1:] != smallest[:-1]))
        firsts.append(changes + begin)
        representatives.append(smallest[changes])
    runs, values = np.concatenate(firsts), np.concatenate(representatives)
    ordered = np.sort(values)
    repeated = ordered[1:][ordered[1:] == ordered[:-1]]
    if not repeated.size:
        return runs[:0]
    # a table of the last bits excludes most others sooner than a search does
    table = np.zeros(_TABLE, dtype=np.bool_)
    table[repeated % _TABLE] = True
    recurring = np.flatnonzero(table[values % _TABLE])
    recurring = recurring[repeated[np.searchsorted(repeated, values[recurring]).clip(max=repeated.size - 1)] == values[recurring]]
    starts, ends = runs[recurring], np.append(runs[1:], a.size - WINDOW + 1)[recurring]
    # windows further inside a run consist of the values of an anchor that overlaps itself: nine at most, too few to be looked at
    is_long = ends - starts > 2 * _ANCHORS
    starts, ends = np.append(starts, ends[is_long] - _ANCHORS), np.append(np.where(is_long, starts + _ANCHORS, ends), ends[is_long])
    lengths = ends - starts
    return np.sort(np.repeat(starts - np.cumsum(lengths) + lengths, lengths) + np.arange(lengths.sum()))


def _smallest_anchors(a: FloatArray) -> NDArray[np.uint32]:
    """Return the smallest hash among the nine anchors of each window, runs of 12 samples, (n - WINDOW + 1,)."""
    with np.errstate(over="ignore"):
        # without the bit of the sign, in which 0.0 and -0.0 differ
        hashes = ((a.view(np.uint64) * _BASE) >> np.uint64(31)).astype(np.uint32)
        two = hashes[:-1] * _ANCHOR_BASE + hashes[1:]
        four = two[:-2] * _ANCHOR_BASE**2 + two[2:]
        eight = four[:-4] * _ANCHOR_BASE**4 + four[4:]
        smallest = eight[:-4] * _ANCHOR_BASE**4 + four[8:]
    for shift in (1, 2, 4, 1):
        smallest = np.minimum(smallest[:-shift], smallest[shift:])
    return smallest


def _hash_windows(a: FloatArray, windows: IntArray) -> NDArray[np.uint64]:
    """Return a hash of each of the windows that begin at the given samples, (m,)."""
    hashes = np.empty(windows.size, dtype=np.uint64)
    with np.errstate(over="ignore"):
        powers = np.cumprod(np.full(WINDOW, _BASE))
        for first in range(0, windows.size, _CHUNK):
            # + 0.0 turns -0.0 into 0.0; the multiplications spread the bits of numbers with few digits
            rows = (sliding_window_view(a, WINDOW)[windows[first : first + _CHUNK]] + 0.0).view(np.uint64)
            rows *= _BASE
            rows ^= rows >> np.uint64(29)
            rows *= _MIXER
            hashes[first : first + _CHUNK] = rows @ powers
    return hashes


def _is_informative(a: FloatArray, starts: IntArray) -> NDArray[np.bool_]:
    """Return whether the samples of each window repeat neither by chance nor by smoothness, (m,)."""
    windows = sliding_window_view(a, WINDOW)
    result = np.zeros(starts.size, dtype=np.bool_)
    for first in range(0, starts.size, _CHUNK):
        # in noise of a few units of the resolution, most equal windows have too few values to be looked at further
        varied = first + np.flatnonzero(_count_unique(windows[starts[first : first + _CHUNK]]) >= MIN_VALUES)
        result[varied] = _is_informative_window(windows[starts[varied]])
    return result


def _is_informative_window(windows: FloatArray) -> NDArray[np.bool_]:
    steps = np.diff(windows, axis=1)
    size = np.abs(steps)
    # steps of whole multiples of a resolution differ by rounding only
    rounded_steps = np.round(steps / np.maximum(size.max(axis=1, keepdims=True), 1e-300), 9)
    is_varied = _count_unique(rounded_steps) >= MIN_STEPS
    third = np.abs(np.diff(windows, 3, axis=1))
    is_smooth: NDArray[np.bool_] = np.median(third, axis=1) < SMOOTHNESS_RATIO * np.median(size, axis=1)
    return is_varied & ~is_smooth


def _count_unique(rows: FloatArray) -> IntArray:
    """Return the number of different values in each row."""
    ordered = np.sort(rows, axis=1)
    return 1 + np.count_nonzero(ordered[:, 1:] != ordered[:, :-1], axis=1)


def _is_periodic(ordered: NDArray[np.uint64], repeated: NDArray[np.uint64]) -> bool:
    """Return whether most repeated windows occur at least three times among the sorted hashes."""
    counts = np.searchsorted(ordered, repeated, "right") - np.searchsorted(ordered, repeated, "left")
    return bool(np.mean(counts > 2) > PERIODIC_SHARE)


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
