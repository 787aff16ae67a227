"""Detection of isolated spikes and of isolated jumps (overwritten or missing samples)."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from seisblock.core.typing import BoolArray, FloatArray, IntArray

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
        step = np.diff(piece)
        size = np.abs(step)
        # a deviation is at most twice the largest step
        if 2.0 * size.max() <= MIN_SURPRISE:
            continue
        # candidates near the overlap are found twice; each block reports its own samples only
        block = range(start - offset, min(start + PIECE, acceleration.size) - offset)
        limit = STEEPNESS_RATIO * size
        is_steeper_than_left, is_steeper_than_right = size[1:] > limit[:-1], size[:-1] > limit[1:]
        lone = {s for s in _find_spikes(step, is_steeper_than_left, is_steeper_than_right) if s in block}
        spikes += [s + offset for s in lone]
        # a spike is a jump and a jump back, and reported as a spike only
        isolated_steps = _find_jumps(step, is_steeper_than_left, is_steeper_than_right)
        jumps += [j + offset for j in isolated_steps if j in block and not lone & {j - 2, j - 1, j, j + 1}]
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


def _find_spikes(step: FloatArray, is_steeper_than_left: BoolArray, is_steeper_than_right: BoolArray) -> list[int]:
    """Return indices of isolated samples; step k leads from sample k to k + 1."""
    # the rise is steeper than the step before it, the fall than the step after it; without the second and the last but one sample, which
    # are artefacts of corrected records, whose ends are differentiated or filtered
    i = 1 + np.flatnonzero(is_steeper_than_left[:-2] & is_steeper_than_right[2:])
    before, rise, fall, after = (step[i + k] for k in (-1, 0, 1, 2))
    # a spike is a rise and a fall of similar size, both steeper than the adjacent steps
    smaller = np.minimum(np.abs(rise), np.abs(fall))
    is_similar = (rise * fall < 0.0) & (np.abs(rise + fall) < SPIKE_ASYMMETRY * smaller)
    i = i[is_similar & (smaller > STEEPNESS_RATIO * np.maximum(np.abs(before), np.abs(after)))]
    # half the difference of two successive steps is the distance of a sample from the mean of its neighbours
    return [k + 1 for k in _select_outliers(i, step.size - 1, lambda k: 0.5 * np.abs(step[k + 1] - step[k]))]


def _find_jumps(step: FloatArray, is_steeper_than_left: BoolArray, is_steeper_than_right: BoolArray) -> list[int]:
    """Return indices of the first samples after isolated steps."""
    # an isolated step stands alone; in shaking of high frequency its neighbours are as steep
    i = np.flatnonzero(is_steeper_than_left[:-1] & is_steeper_than_right[1:])
    return [k + 2 for k in _select_outliers(i, step.size - 2, lambda k: np.abs(step[k + 1] - 0.5 * (step[k] + step[k + 2])))]


def _select_outliers(i: IntArray, count: int, deviation: Callable[[IntArray], FloatArray]) -> list[int]:
    """Return the indices at which the deviation is the local maximum and far above the background on both sides."""

    def padded(k: IntArray) -> FloatArray:
        # zeros beyond the ends: the background of the other side decides
        return np.where((k >= 0) & (k < count), deviation(k.clip(0, count - 1)), 0.0)

    i = i[deviation(i) > MIN_SURPRISE]
    for shift in (*range(-EXCLUDED_STEPS, 0), *range(1, EXCLUDED_STEPS + 1)):
        i = i[deviation(i) >= padded(i + shift)]
    windows = padded(i[:, None] + np.arange(-_MARGIN, _MARGIN + 1))
    # prefilter: an isolated deviation is 12 times the mean of its window, one of three is 4 times
    is_isolated = windows[:, _MARGIN] > 3.0 * windows.mean(axis=1)
    i, windows = i[is_isolated], windows[is_isolated]
    # the larger of both sides, so that the onset of shaking is not flagged
    background = np.maximum(_background(windows[:, :NEIGHBOUR_STEPS]), _background(windows[:, -NEIGHBOUR_STEPS:]))
    indices: list[int] = i[windows[:, _MARGIN] > SURPRISE_RATIO * background].tolist()
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
        k = np.flatnonzero(is_negative[:-4] & is_negative[1:-3] & ~is_negative[2:-2] & is_negative[3:-1] & is_negative[4:])
        expected = _cubic_midpoint(*(piece[k + i] for i in (0, 1, 3, 4)))
        residual, flipped_residual = np.abs(piece[k + 2] - expected), np.abs(piece[k + 2] + expected)
        # prefilter: a sample of size x with the wrong sign deviates by 2 x
        is_candidate = (residual > MIN_SURPRISE) & (flipped_residual < 0.2 * residual)
        k, residual, flipped_residual = k[is_candidate], residual[is_candidate], flipped_residual[is_candidate]
        usual = _usual_residuals(piece, k)
        flips = offset + 2 + k[(residual > FLIP_RATIO * usual) & (flipped_residual < FLIP_RESIDUAL * usual)]
        indices += flips[(flips >= start) & (flips < start + PIECE)].tolist()
    return np.array(indices, dtype=np.int64)


def _cubic_midpoint(x0: FloatArray, x1: FloatArray, x3: FloatArray, x4: FloatArray) -> FloatArray:
    """Return the value of the cubic through two samples on each side."""
    return (4.0 * (x1 + x3) - x0 - x4) / 6.0


def _usual_residuals(piece: FloatArray, i: IntArray) -> FloatArray:
    """Return the median deviation from the cubic of the samples around each sample ``i + 2``, (m,)."""
    beside = np.arange(EXCLUDED_STEPS + 1, _MARGIN + 1)
    near = i[:, None] + np.concatenate((-beside[::-1], beside))
    is_inside = (near >= 0) & (near < piece.size - 4)
    at = near.clip(0, piece.size - 5)
    residual = np.abs(piece[at + 2] - _cubic_midpoint(*(piece[at + k] for k in (0, 1, 3, 4))))
    return _background(np.where(is_inside, residual, 0.0))


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
    for start in range(0, acceleration.size, PIECE):
        piece = acceleration[start : start + PIECE + 3]
        if piece.size < 4:
            continue
        is_negative, is_falling = piece < 0.0, piece[1:] < piece[:-1]
        has_one_sign = is_negative[1:] == is_negative[:-1]
        # four samples of one sign, of which the first step leads to zero and the last one away
        has_one_sign = has_one_sign[:-2] & has_one_sign[1:-1] & has_one_sign[2:]
        k = np.flatnonzero(has_one_sign & (is_falling[:-2] != is_negative[:-3]) & (is_falling[2:] == is_negative[:-3]))
        x, y, z, w = (np.abs(piece[k + i]) for i in range(4))
        curvature, turned = x - y - z + w, np.abs(3.0 * (y + z) - x - w)
        is_cusp = (y < x) & (z < w) & (y * z > 0.0) & (curvature > MIN_CURVATURE) & (curvature > CUSP_RATIO * turned)
        cusps += (k[is_cusp] + start + 1).tolist()
        curvatures += curvature[is_cusp].tolist()
    if len(cusps) < MIN_CUSPS:
        return []
    crossings = sum(
        np.count_nonzero(np.diff(acceleration[start : start + PIECE + 1] < 0.0)) for start in range(0, acceleration.size, PIECE)
    )
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
