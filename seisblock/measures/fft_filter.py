"""A filter without delay over the frequencies of a whole record, whose end goes on into its beginning; long ones in little memory."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np

from seisblock.core.limits import CHUNK_SIZE, MIB
from seisblock.core.typing import FloatArray

LONG_TRANSFORM = 2**20
"""Samples beyond which a transform is made of shorter ones."""

BYTES_PER_FILTERED_SAMPLE = 44
"""Of a sample of a long record: its three components, the spectrum of one, the weights and the sum of squares."""

BYTES_PER_CONVOLVED_SAMPLE = 140
"""Of a sample of a column with a large prime among the divisors of its length, whose transform is a convolution four times as long."""

LARGE_PRIME = 1000
"""A divisor from which on it is."""


def filter_weights(samples: int, dt: float, gain: Callable[[FloatArray], FloatArray]) -> FloatArray:
    """Return the factors of a filter at the frequencies of so many samples, in the order in which :func:`add_filtered_square` meets them.

    Parameters
    ----------
    samples : int
        Of the whole record.
    dt : float, s
        Sampling interval.
    gain : callable
        Factors at an array of frequencies in Hz, none negative.
    """
    width = _table_width(samples)
    height = samples // width
    weights = np.empty((height // 2 + 1, width))
    for lines in _blocks(len(weights), width):
        number = np.arange(len(weights))[lines, None] + height * np.arange(width)
        weights[lines] = gain(np.minimum(number, samples - number) / (samples * dt))
    return weights


def add_filtered_square(total: FloatArray, samples: FloatArray, weights: FloatArray) -> None:
    """Add to a row, in its place, the squares of samples that were weighed frequency by frequency.

    A long row is read as a table, line after line: its transform is made of those of the columns, turned, and those of the lines. The
    weights come in the order in which the frequencies then lie, so that nothing is sorted. Where the number of samples has no divisor
    (or the row is short) the table has one column, whose transform is that of the whole.

    Parameters
    ----------
    total : (n,) array
        Contiguous; changed.
    samples : (n,) array
        To be filtered.
    weights : array
        From :func:`filter_weights`.
    """
    width = weights.shape[1]
    table, sums = samples.reshape(-1, width), total.reshape(-1, width)
    spectrum = np.empty(weights.shape, dtype=np.complex128)
    for columns in _blocks(width, len(table)):
        spectrum[:, columns] = np.fft.rfft(table[:, columns], axis=0)
    for lines in _blocks(len(spectrum), width):
        if width == 1:
            spectrum[lines] *= weights[lines]
            continue
        twiddle = np.exp(-2j * math.pi / samples.size * (np.arange(len(spectrum))[lines, None] * np.arange(width)))
        weighted_block = np.fft.fft(spectrum[lines] * twiddle, axis=1)
        weighted_block *= weights[lines]
        np.multiply(np.fft.ifft(weighted_block, axis=1), np.conj(twiddle, out=twiddle), out=spectrum[lines])
    for columns in _blocks(width, len(table)):
        filtered_block = np.fft.irfft(spectrum[:, columns], len(table), axis=0)
        filtered_block *= filtered_block
        sums[:, columns] += filtered_block


def transform_mib(samples: int) -> int:
    """Return what a long record and its filter take, MiB, where the number of samples has a large prime divisor; else 0: little enough.

    Parameters
    ----------
    samples : int
        Of the whole record.

    Examples
    --------
    >>> transform_mib(17_280_000), transform_mib(17_280_002)
    (0, 1878)
    """
    height = samples // _table_width(samples)
    if samples <= LONG_TRANSFORM or _largest_prime(height) < LARGE_PRIME:
        return 0
    return (BYTES_PER_FILTERED_SAMPLE * samples + BYTES_PER_CONVOLVED_SAMPLE * height) // MIB


def _largest_prime(number: int) -> int:
    """Return the largest prime divisor of a whole number."""
    divisor = 2
    while divisor * divisor <= number:
        if number % divisor == 0:
            number //= divisor
        else:
            divisor += 1
    return number


def _table_width(samples: int) -> int:
    """Return the largest divisor up to the root of a long row's length; 1 of a short one."""
    return next(k for k in range(math.isqrt(samples), 0, -1) if samples % k == 0) if samples > LONG_TRANSFORM else 1


def _blocks(count: int, length: int) -> Iterator[slice]:
    """Yield so many lines or columns of a length that a block of samples is in them."""
    step = max(CHUNK_SIZE // length, 1)
    for begin in range(0, count, step):
        yield slice(begin, begin + step)
