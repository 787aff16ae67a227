"""High-pass filters that leave nothing of a constant or a straight line: one without delay, one that acts forwards only."""

from __future__ import annotations

import numpy as np

from seisblock.core.errors import ParameterError
from seisblock.core.limits import CHUNK_SIZE
from seisblock.core.typing import FloatArray
from seisblock.records.butterworth import N_SECTIONS, highpass_sections, run_sections

HIGHPASS_ORDER = 2 * N_SECTIONS
"""Order of the Butterworth high-pass; passed forwards and backwards it acts like one of twice that order, without delay."""

PADDING_PERIODS = 5.0
"""Length of the padding at each end, in corner periods: the filter's slowest transient has died to 1e-5 by then."""

MAX_PADDING = 2**22
"""Longest padding at either end, samples: a corner that needs more is refused."""

BASELINE_PERIODS = 0.5
"""Length of the windows at either end on which the baseline is measured, in corner periods."""


def highpass_samples(acceleration: FloatArray, dt: float, hz: float) -> FloatArray:
    """Remove from one row of samples what is slower than a corner frequency, without delay.

    A Butterworth filter of order 4, forwards and backwards. First the :func:`end_line` is taken off, so that an offset or a drift
    leaves nothing; then the record is extended at both ends by five corner periods of its own mirror image with the sign reversed, so
    that the *velocity* goes on evenly: a motion that starts in mid-swing gets no step there. (An odd extension about the end sample,
    scipy's default, would: cut in mid-swing, a sine's PGV comes out up to 40 times too large.)

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Any samples.
    dt : float, s
        Sampling interval.
    hz : float, Hz
        Corner frequency, at which half the amplitude passes, between 0 and half the sampling rate.

    Returns
    -------
    (n,) array, m/s^2

    Raises
    ------
    ParameterError
        If the corner lies outside that range, or is so low that the padding would exceed ``MOST_PADDING`` samples.
    """
    sections, pad = _design(dt, hz)
    row = _pad(acceleration, dt, hz, pad, pad)
    for backwards in (False, True):
        run_sections(sections, row, steady_state=True, backwards=backwards)
    return row[pad : pad + acceleration.size]


def causal_highpass_samples(acceleration: FloatArray, dt: float, hz: float) -> FloatArray:
    """Remove what is slower than a corner frequency as instruments and many agencies do, forwards only: phases are shifted.

    The same filter, baseline and padding (before the record) as :func:`highpass_samples`, run once: at the corner 0.71 of the amplitude
    passes.

    Parameters
    ----------
    acceleration, dt, hz
        As in :func:`highpass_samples`.

    Returns
    -------
    (n,) array, m/s^2

    Raises
    ------
    ParameterError
        As :func:`highpass_samples`.
    """
    sections, pad = _design(dt, hz)
    row = _pad(acceleration, dt, hz, pad, 0)
    run_sections(sections, row, steady_state=False)
    return row[pad:]


def end_line(acceleration: FloatArray, dt: float, hz: float) -> FloatArray:
    """Return the straight line through the two ends of a row of samples, (n,), m/s^2: the baseline that a high-pass takes off first.

    Least squares, weighted by a Hann window of half a corner period at either end (of the whole record when that is shorter): the shaking
    in the middle does not tilt it, and the tapers average out a swing that the ends cut. Exact for constants and lines.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Any samples.
    dt : float, s
        Sampling interval.
    hz : float, Hz
        Corner frequency of the high-pass.

    Returns
    -------
    (n,) array, m/s^2
    """
    level, slope = _level_and_slope(acceleration, dt, hz)
    return slope * _normalized_positions(acceleration.size, 0, acceleration.size) + level


def _level_and_slope(acceleration: FloatArray, dt: float, hz: float) -> tuple[float, float]:
    """Return the baseline in the middle of the samples, and how much higher it is at their end."""
    n = acceleration.size
    length = int(min(n, max(2.0, np.rint(BASELINE_PERIODS / (hz * dt)))))
    taper = np.sin(np.pi * (np.arange(length) + 0.5) / length) ** 2
    # the weights are symmetric: about the middle, level and slope are independent
    ends = ((_normalized_positions(n, 0, length), acceleration[:length]), (_normalized_positions(n, n - length, n), acceleration[-length:]))
    level = sum(taper @ a for _, a in ends) / (2.0 * taper.sum())
    slope = sum((taper * x) @ a for x, a in ends) / sum(taper @ x**2 for x, _ in ends)
    return float(level), float(slope)


def _normalized_positions(samples: int, begin: int, end: int) -> FloatArray:
    """Return where some of the samples lie between the first of all, -1, and the last, 1."""
    position = np.arange(begin, end, dtype=np.float64)
    return position * (2.0 / max(samples - 1, 1)) - 1.0


def _pad(acceleration: FloatArray, dt: float, hz: float, pad_before: int, pad_after: int) -> FloatArray:
    """Return samples less their baseline with their mirror images, made in the memory of what is returned."""
    n = acceleration.size
    level, slope = _level_and_slope(acceleration, dt, hz)
    row = np.empty(pad_before + n + pad_after)
    for begin in range(0, n, CHUNK_SIZE):
        end = min(begin + CHUNK_SIZE, n)
        row[pad_before + begin : pad_before + end] = acceleration[begin:end] - (slope * _normalized_positions(n, begin, end) + level)
    _fill_mirror_image(row, pad_before, n)
    return row


def _design(dt: float, hz: float) -> tuple[FloatArray, int]:
    """Return the sections of the filter, and how many samples its transients need to die."""
    nyquist = 0.5 / dt
    if not (np.isfinite(hz) and 0 < hz < nyquist):
        raise ParameterError(
            "the high-pass corner must lie between 0 and {nyquist:g} Hz, half the sampling rate; found {hz:g} Hz", nyquist=nyquist, hz=hz
        )
    pad = np.ceil(PADDING_PERIODS / (hz * dt))
    if pad > MAX_PADDING:
        min_corner = PADDING_PERIODS / (MAX_PADDING * dt)
        raise ParameterError(
            "a high-pass corner of {hz:g} Hz needs {pad:.3g} samples of padding at either end of the record, more than "
            "{most}: choose a corner of {least:.2g} Hz or more",
            hz=hz,
            pad=pad,
            most=MAX_PADDING,
            least=min_corner,
        )
    return highpass_sections(dt, hz), int(pad)


def _fill_mirror_image(row: FloatArray, pad_before: int, samples: int) -> None:
    """Fill a row, at either end of the samples in it, with their mirror image, sign reversed, mirrored as often as needed."""
    interior = row[pad_before : pad_before + samples]
    for end, position in (
        (row[:pad_before], np.arange(-pad_before, 0)),
        (row[pad_before + samples :], np.arange(samples, row.size - pad_before)),
    ):
        # position in a period of twice the record, of which the second half runs backwards with the sign reversed
        position %= 2 * samples
        is_mirrored = position >= samples
        end[:] = interior[np.where(is_mirrored, 2 * samples - 1 - position, position)]
        end[is_mirrored] *= -1.0
