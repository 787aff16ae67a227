"""Zero-phase frequency-domain filter of a whole record (periodic), with bounded memory for long records."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np

from seisblock.core.limits import CHUNK_SIZE, MIB
from seisblock.core.typing import FloatArray

LONG_TRANSFORM = 2**20
"""Number of samples above which the transform is split (two-dimensional FFT)."""

BYTES_PER_FILTERED_SAMPLE = 44
"""Memory per sample of a long record: three components, the spectrum of one, the weights and the sum of squares."""

BYTES_PER_CONVOLVED_SAMPLE = 140
"""Memory per sample of a column whose length has a large prime factor (Bluestein's algorithm, about four times as long)."""

LARGE_PRIME = 1000
"""Smallest prime factor that counts as large."""


def filter_weights(samples: int, dt: float, gain: Callable[[FloatArray], FloatArray]) -> FloatArray:
    """Return the gains of a filter at the FFT frequencies, in the order used by :func:`add_filtered_square`.

    Parameters
    ----------
    samples : int
        Number of samples of the record.
    dt : float, s
        Sampling interval.
    gain : callable
        Gain at an array of non-negative frequencies, Hz.
    """
    width = _table_width(samples)
    height = samples // width
    # half of the rows: the columns are real, so that the others are their complex conjugates
    weights = np.empty((height // 2 + 1, width))
    for lines in _blocks(len(weights), width):
        # frequency index at [row, column] after both transforms; indices above the half are negative frequencies
        number = np.arange(len(weights))[lines, None] + height * np.arange(width)
        # a real signal has conjugate coefficients at frequencies of either sign: one gain serves both
        weights[lines] = gain(np.minimum(number, samples - number) / (samples * dt))
    return weights


def add_filtered_square(total: FloatArray, samples: FloatArray, weights: FloatArray) -> None:
    """Filter samples in the frequency domain and add their squares to an array, in place.

    The samples of a long record are arranged in a table (Cooley-Tukey decomposition): FFT of the columns, multiplication by twiddle
    factors, FFT of the rows. The weights are in the resulting order of frequencies, so that nothing is sorted. The table has one column
    if the record is short or its number of samples is prime.

    Parameters
    ----------
    total : (n,) array
        Sum of squares, contiguous; changed in place.
    samples : (n,) array
        Samples to be filtered.
    weights : array
        Gains from :func:`filter_weights`.
    """
    width = weights.shape[1]
    table, sums = samples.reshape(-1, width), total.reshape(-1, width)
    spectrum = np.empty(weights.shape, dtype=np.complex128)
    for columns in _blocks(width, len(table)):
        spectrum[:, columns] = np.fft.rfft(table[:, columns], axis=0)
    # rows: twiddle, transform, filter and inverse transform while a block is in the cache
    for lines in _blocks(len(spectrum), width):
        if width == 1:
            spectrum[lines] *= weights[lines]
            continue
        # the twiddle factors join the transforms of the columns into one of the whole record (Cooley and Tukey)
        twiddle = np.exp(-2j * math.pi / samples.size * (np.arange(len(spectrum))[lines, None] * np.arange(width)))
        weighted_block = np.fft.fft(spectrum[lines] * twiddle, axis=1)
        weighted_block *= weights[lines]
        np.multiply(np.fft.ifft(weighted_block, axis=1), np.conj(twiddle, out=twiddle), out=spectrum[lines])
    # inverse transform of the columns, block by block, added to the sum of squares
    for columns in _blocks(width, len(table)):
        filtered_block = np.fft.irfft(spectrum[:, columns], len(table), axis=0)
        filtered_block *= filtered_block
        sums[:, columns] += filtered_block


def transform_mib(samples: int) -> int:
    """Return the memory of filtering a long record, MiB, if its length has a large prime factor; else 0 (no limit applies).

    Parameters
    ----------
    samples : int
        Number of samples of the record.

    Examples
    --------
    >>> transform_mib(17_280_000), transform_mib(17_280_002)
    (0, 1878)
    """
    height = samples // _table_width(samples)
    # short records and smooth lengths need little more memory than the record itself
    if samples <= LONG_TRANSFORM or _largest_prime(height) < LARGE_PRIME:
        return 0
    return (BYTES_PER_FILTERED_SAMPLE * samples + BYTES_PER_CONVOLVED_SAMPLE * height) // MIB


def _largest_prime(number: int) -> int:
    """Return the largest prime factor of an integer."""
    divisor = 2
    while divisor * divisor <= number:
        if number % divisor == 0:
            number //= divisor
        else:
            divisor += 1
    return number


def _table_width(samples: int) -> int:
    """Return the largest divisor of `samples` up to its square root; 1 for short records."""
    return next(k for k in range(math.isqrt(samples), 0, -1) if samples % k == 0) if samples > LONG_TRANSFORM else 1


def _blocks(count: int, length: int) -> Iterator[slice]:
    """Yield slices of rows or columns that hold about ``CHUNK_SIZE`` samples."""
    step = max(CHUNK_SIZE // length, 1)
    for begin in range(0, count, step):
        yield slice(begin, begin + step)
