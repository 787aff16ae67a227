"""Detection of isolated spikes and of isolated jumps (overwritten or missing samples)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from seisblock.core.typing import FloatArray, IntArray

NEIGHBOUR_STEPS, EXCLUDED_STEPS = 10, 2
"""Number of steps on each side that define the background, and of the nearest steps excluded from it."""

MIN_SURPRISE = 0.05
"""Smallest deviation that counts, m/s^2."""

SURPRISE_RATIO = 25.0
"""Required ratio of a deviation to the background median."""

STEEPNESS_RATIO = 4.0
"""Required ratio of a step to the adjacent steps; excludes apex and flanks of a triangular peak."""

SPIKE_ASYMMETRY = 0.5
"""Largest difference of the samples on both sides of a spike, as a ratio of its height."""

_MARGIN = NEIGHBOUR_STEPS + EXCLUDED_STEPS

BLOCK, PIECE = 2**20, 2**16
"""Samples checked at a time, for repetitions and here, so that a day-long record needs no temporary arrays of its size; a piece stays in
the cache of the processor."""


def find_spikes_and_jumps(acceleration: FloatArray) -> tuple[IntArray, IntArray]:
    """Return indices of isolated spikes and of samples after isolated jumps.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Samples as read.

    Returns
    -------
    spikes, jumps : arrays of int
        Indices of isolated outlier samples, and of the first samples after isolated steps.

    Notes
    -----
    The deviation of a sample is its distance from the mean of its two neighbours, that of a step its difference from the mean of the two
    adjacent steps. A deviation is flagged if it exceeds 5 gal and 25 times the median deviation of the ten before and of the ten after, is
    the local maximum, and its step (for a sample, both steps) is four times as steep as the adjacent ones. JMA announced on 2015-12-04
    that very short pieces of some published records were overwritten by samples 2 s later; an end of such a piece is a jump. Records rich
    in high frequencies can hide both.
    """
    spikes, jumps = _find_end_spikes(acceleration), []
    for start in range(0, acceleration.size, PIECE):
        offset = max(start - 2 * _MARGIN, 0)
        piece = acceleration[offset : start + PIECE + 2 * _MARGIN]
        if piece.size < 2 * _MARGIN + 5:
            continue
        # candidates near the overlap are found twice; each block reports its own samples only
        block = range(start - offset, min(start + PIECE, acceleration.size) - offset)
        step = np.diff(piece)
        lone = {s for s in _find_spikes(step) if s in block}
        spikes += [s + offset for s in lone]
        # a spike is a jump and a jump back, and reported as a spike only
        jumps += [j + offset for j in _find_jumps(step) if j in block and not lone & {j - 2, j - 1, j, j + 1}]
    return np.array(sorted(spikes), dtype=np.int64), np.array(sorted(jumps), dtype=np.int64)


def _find_end_spikes(acceleration: FloatArray) -> list[int]:
    """Return the first and the last sample if they deviate from their only neighbour."""
    if acceleration.size < _MARGIN + 2:
        return []
    indices = []
    for index, step in ((0, np.abs(np.diff(acceleration[: _MARGIN + 1]))), (-1, np.abs(np.diff(acceleration[-_MARGIN - 1 :]))[::-1])):
        # the first and the last sample have one neighbour only: the step to it must stand out by itself
        if step[0] > max(MIN_SURPRISE, SURPRISE_RATIO * float(np.median(step[EXCLUDED_STEPS:])), STEEPNESS_RATIO * float(step[1])):
            indices.append(index % acceleration.size)
    return indices


def _find_spikes(step: FloatArray) -> Iterator[int]:
    """Yield indices of isolated samples; step k leads from sample k to k + 1."""
    # half the difference of two successive steps is the distance of a sample from the mean of its neighbours
    for i in _find_outliers(0.5 * np.abs(np.diff(step))):
        # a spike is a rise and a fall of similar size, both steeper than the adjacent steps
        rise, fall = step[i], step[i + 1]
        adjacent = max(abs(step[i - 1]) if i > 0 else 0.0, abs(step[i + 2]) if i + 2 < step.size else 0.0)
        smaller = min(abs(rise), abs(fall))
        # the second and the last but one sample: artefacts of corrected records, whose ends are differentiated or filtered
        is_inner = 1 < i + 1 < step.size - 1
        if is_inner and rise * fall < 0.0 and abs(rise + fall) < SPIKE_ASYMMETRY * smaller and smaller > STEEPNESS_RATIO * adjacent:
            yield i + 1


def _find_jumps(step: FloatArray) -> Iterator[int]:
    """Yield indices of the first samples after isolated steps."""
    for i in _find_outliers(np.abs(step[1:-1] - 0.5 * (step[:-2] + step[2:]))):
        k = i + 1
        # an isolated step stands alone; in shaking of high frequency its neighbours are as steep
        if abs(step[k]) > STEEPNESS_RATIO * max(abs(step[k - 1]), abs(step[k + 1])):
            yield k + 1


def _find_outliers(surprise: FloatArray) -> list[int]:
    """Return indices where a deviation is the local maximum and far above the background on both sides."""
    padded = np.pad(surprise, _MARGIN)  # zeros beyond the ends: the background of the other side decides
    total = np.concatenate(([0.0], np.cumsum(padded)))
    mean = (total[2 * _MARGIN + 1 :] - total[: -2 * _MARGIN - 1]) / (2 * _MARGIN + 1)
    # prefilter: an isolated deviation is 12 times the mean of its window, one of three is 4 times
    candidates = np.flatnonzero((surprise > MIN_SURPRISE) & (surprise > 3.0 * mean))
    if not candidates.size:
        return []
    windows = sliding_window_view(padded, 2 * _MARGIN + 1)[candidates]
    largest = windows[:, NEIGHBOUR_STEPS : NEIGHBOUR_STEPS + 2 * EXCLUDED_STEPS + 1].max(axis=1)
    # the larger of both sides, so that the onset of shaking is not flagged
    background = np.maximum(_background(windows[:, :NEIGHBOUR_STEPS]), _background(windows[:, -NEIGHBOUR_STEPS:]))
    indices: list[int] = candidates[(surprise[candidates] >= largest) & (surprise[candidates] > SURPRISE_RATIO * background)].tolist()
    return indices


def _background(deviations: FloatArray) -> FloatArray:
    """Return the median deviation in each row, (m, n), zeros of a flat stretch left out; 0 for rows that are flat throughout."""
    # a coarse instrument rests at one value and then steps to the next: its steps are the background, not its rests
    ordered = np.sort(np.where(deviations > 0.0, deviations, np.inf), axis=1)
    counts = np.count_nonzero(deviations > 0.0, axis=1)
    rows = np.arange(len(ordered))
    middle = 0.5 * (ordered[rows, (counts - 1).clip(0) // 2] + ordered[rows, counts // 2])
    return np.where(counts > 0, middle, 0.0)


FLIP_RATIO, FLIP_RESIDUAL = 25.0, 3.0
"""Deviation from the neighbours as a multiple of the background: of a sample as it is, at least; with the opposite sign, at most."""


def find_flipped_samples(acceleration: FloatArray) -> IntArray:
    """Return indices of samples that fit their neighbours with the opposite sign only.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2

    Notes
    -----
    The expected value of a sample is that of the cubic through its two neighbours on each side; the background is the median of its
    deviations in the ten samples on each side. Single samples only: neighbours must have their signs.
    """
    indices: list[int] = []
    for start in range(0, acceleration.size, PIECE):
        offset = max(start - 2 * _MARGIN, 0)
        piece = acceleration[offset : start + PIECE + 2 * _MARGIN]
        if piece.size < 2 * _MARGIN + 5:
            continue
        # a lost minus is a positive sample between negative ones, and rare
        is_negative = piece < 0.0
        k = np.flatnonzero((piece[2:-2] > 0.0) & is_negative[:-4] & is_negative[1:-3] & is_negative[3:-1] & is_negative[4:])
        expected = _cubic_midpoint(*(piece[k + i] for i in (0, 1, 3, 4)))
        residual, flipped_residual = np.abs(piece[k + 2] - expected), np.abs(piece[k + 2] + expected)
        # prefilter: a sample of size x with the wrong sign deviates by 2 x
        for j in np.flatnonzero((residual > MIN_SURPRISE) & (flipped_residual < 0.2 * residual)):
            i = int(k[j])
            usual = _usual_residual(piece, i)
            is_flipped = residual[j] > FLIP_RATIO * usual and flipped_residual[j] < FLIP_RESIDUAL * usual
            if is_flipped and start <= offset + i + 2 < start + PIECE:
                indices.append(offset + i + 2)
    return np.array(indices, dtype=np.int64)


def _cubic_midpoint(x0: FloatArray, x1: FloatArray, x3: FloatArray, x4: FloatArray) -> FloatArray:
    """Return the value of the cubic through two samples on each side."""
    return (4.0 * (x1 + x3) - x0 - x4) / 6.0


def _usual_residual(piece: FloatArray, i: int) -> float:
    """Return the median deviation from the cubic of the samples around sample ``i + 2``, infinity if there are none."""
    first = max(i - _MARGIN, 0)
    x = piece[first : i + _MARGIN + 5]
    residual = np.abs(x[2:-2] - _cubic_midpoint(x[:-4], x[1:-3], x[3:-1], x[4:]))
    background = np.concatenate((residual[: max(i - first - EXCLUDED_STEPS, 0)], residual[i - first + EXCLUDED_STEPS + 1 :]))
    return float(_background(background[None, :])[0]) if background.size else np.inf


MIN_CUSPS, MIN_CURVATURE, CUSP_RATIO, CUSP_SPACING = 5, 0.02, 4.0, 6.0
"""Least number of consecutive cusps at zero; least curvature, m/s^2, and its least ratio to the third difference with the later samples
turned over and to the mean of the other samples; largest distance of two cusps, in mean intervals between changes of sign.

Of 509 components of sound records none has more than four in a row."""


class RectifiedSamples(NamedTuple):
    """Interval in which samples touch zero without crossing it: indices of the first and the last cusp, number of cusps."""

    first: int
    last: int
    cusps: int


def find_rectified_samples(acceleration: FloatArray) -> list[RectifiedSamples]:
    """Return intervals whose samples have lost their signs, between samples of either sign.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Samples about zero.

    Notes
    -----
    The absolute value of a motion has a cusp where the motion crosses zero: four samples of one sign with a large curvature, which are
    smooth if the last two change sign. Single cusps are common in sound records; several in a row without a crossing are not.
    """
    cusps: list[int] = []
    curvatures: list[float] = []
    crossings = 0
    for start in range(0, acceleration.size, PIECE):
        piece = acceleration[start : start + PIECE + 3]
        if piece.size < 4:
            continue
        crossings += int(np.count_nonzero(np.signbit(piece[1:-2]) != np.signbit(piece[:-3])))
        size = np.abs(piece)
        k = np.flatnonzero((size[1:-2] < size[:-3]) & (size[2:-1] < size[3:]))
        k = k[size[k] + size[k + 3] - size[k + 1] - size[k + 2] > MIN_CURVATURE]
        x, y, z, w = (piece[k + i] for i in range(4))
        curvature, turned = np.abs(x - y - z + w), np.abs(3.0 * (y + z) - x - w)
        has_one_sign = (x * y > 0.0) & (y * z > 0.0) & (z * w > 0.0)
        is_cusp = has_one_sign & (curvature > CUSP_RATIO * turned)
        cusps += (k[is_cusp] + start + 1).tolist()
        curvatures += curvature[is_cusp].tolist()
    if len(cusps) < MIN_CUSPS:
        return []
    spacing = CUSP_SPACING * acceleration.size / max(crossings, 1)
    results, first = [], 0
    for i, cusp in enumerate(cusps):
        end = cusps[i + 1] if i + 1 < len(cusps) else acceleration.size
        between = acceleration[cusp : end + 1]
        if end - cusp <= spacing and (between.min() > 0.0 or between.max() < 0.0) and i + 1 < len(cusps):
            continue
        if i + 1 - first >= MIN_CUSPS:
            # about an offset, samples that cross their mean may touch zero only
            inside = acceleration[cusps[first] : cusp]
            mean = (float(acceleration.sum()) - float(inside.sum())) / (acceleration.size - inside.size)
            if CUSP_RATIO * abs(mean) < float(np.median(curvatures[first : i + 1])):
                results.append(RectifiedSamples(cusps[first], cusp, i + 1 - first))
        first = i + 1
    return results
