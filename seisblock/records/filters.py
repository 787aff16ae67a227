"""High-pass filters with baseline removal: zero-phase, and causal."""

from __future__ import annotations

import math

import numpy as np

from seisblock._jit import kernel
from seisblock.core.errors import ParameterError
from seisblock.core.limits import CHUNK_SIZE
from seisblock.core.typing import FloatArray

N_SECTIONS = 2
"""Second-order sections of the filter."""


def highpass_sections(dt: float, hz: float) -> FloatArray:
    """Return gain and denominator coefficients a1, a2 of the second-order sections, (2, 3).

    The poles of the analogue filter lie on a circle; the bilinear transform, prewarped to keep the corner frequency, maps each pair to a
    section with a double zero at frequency zero. The first section carries the gain of both, as in scipy.

    Parameters
    ----------
    dt : float, s
        Sampling interval.
    hz : float, Hz
        Corner frequency, below half the sampling rate.
    """
    # the bilinear transform compresses frequencies and would lower the corner, hence the tangent
    prewarped = math.tan(math.pi * hz * dt)
    # Butterworth pole pairs: damping ratios cos of the pole angles
    damping = np.cos(np.pi * (np.arange(N_SECTIONS) + 0.5) / (2 * N_SECTIONS))
    scale = 1.0 + 2.0 * damping * prewarped + prewarped**2
    a1, a2 = 2.0 * (prewarped**2 - 1.0) / scale, (1.0 - 2.0 * damping * prewarped + prewarped**2) / scale
    gain = np.ones(N_SECTIONS)
    # the whole gain in the first section, as scipy.signal.butter(output="sos") has it
    gain[0] = 1.0 / scale.prod()
    return np.column_stack((gain, a1, a2))


def run_sections(sections: FloatArray, row: FloatArray, *, steady_state: bool, backwards: bool = False) -> None:
    """Filter a row of samples in place.

    Parameters
    ----------
    sections : (2, 3) array
        Result of :func:`highpass_sections`.
    row : (n,) array, m/s^2
        Samples, modified in place.
    steady_state : bool
        True: start from the steady state of the first sample met (a constant gives zero output); False: start from rest.
    backwards : bool
        Filter from the last sample to the first.
    """
    memory = np.zeros((N_SECTIONS, 2))
    if steady_state and row.size:
        # steady state of the first section for a constant input; its output is zero, so the second starts at rest
        # an output of zero for the constant input x needs the memory (-x, x)
        initial = sections[0, 0] * row[-1 if backwards else 0]
        memory[0] = -initial, initial
    starts = range(0, row.size, CHUNK_SIZE)
    for begin in reversed(starts) if backwards else starts:
        # in chunks: an interrupt is handled between two kernel calls
        _run(sections, row[begin : begin + CHUNK_SIZE], memory, backwards)


@kernel("void(float64[:, ::1], float64[::1], float64[:, ::1], boolean)")
def _run(sections, row, memory, backwards):
    """Filter samples with two direct form II transposed sections; update the filter state `memory`, (2, 2)."""
    gain, a1, a2 = sections[0, 0], sections[0, 1], sections[0, 2]
    gain_2, c1, c2 = sections[1, 0], sections[1, 1], sections[1, 2]
    m0, m1, n0, n1 = memory[0, 0], memory[0, 1], memory[1, 0], memory[1, 1]
    for count in range(row.size):
        i = row.size - 1 - count if backwards else count
        x = gain * row[i]
        y = x + m0
        # numerator 1, -2, 1: double zero at frequency zero
        m0 = -2.0 * x - a1 * y + m1
        m1 = x - a2 * y
        x = gain_2 * y
        y = x + n0
        n0 = -2.0 * x - c1 * y + n1
        n1 = x - c2 * y
        row[i] = y
    memory[0, 0], memory[0, 1], memory[1, 0], memory[1, 1] = m0, m1, n0, n1


HIGHPASS_ORDER = 2 * N_SECTIONS
"""Order of the Butterworth high-pass; run forwards and backwards, the effective order is twice that, with zero phase."""

PADDING_PERIODS = 5.0
"""Length of the padding at each end, in corner periods: the slowest transient of the filter has decayed to 1e-5 by then."""

MAX_PADDING = 2**22
"""Longest padding at either end, samples; a corner that requires more raises `ParameterError`."""

BASELINE_PERIODS = 0.5
"""Length of the windows at both ends that determine the baseline, in corner periods."""


def highpass_samples(acceleration: FloatArray, dt: float, hz: float) -> FloatArray:
    """Return samples high-passed with zero phase.

    Butterworth filter of order 4, forwards and backwards. The :func:`end_line` is removed first, so that an offset or a drift leaves
    nothing; then the record is extended at both ends by five corner periods of its mirror image with reversed sign, so that the
    *velocity* is continuous even for a motion that starts in mid-swing. (An odd extension about the end sample, scipy's default, adds a
    step there: the PGV of a sine cut in mid-swing comes out up to 40 times too large.)

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Samples.
    dt : float, s
        Sampling interval.
    hz : float, Hz
        Corner frequency (half amplitude), between 0 and half the sampling rate.

    Returns
    -------
    (n,) array, m/s^2

    Raises
    ------
    ParameterError
        If the corner lies outside that range, or the padding would exceed ``MAX_PADDING`` samples.
    """
    sections, pad = _design(dt, hz)
    row = _pad(acceleration, dt, hz, pad, pad)
    # the phase shifts of both directions cancel
    # forwards and backwards the amplitude at the corner is 1/sqrt(2) squared, one half
    for backwards in (False, True):
        run_sections(sections, row, steady_state=True, backwards=backwards)
    return row[pad : pad + acceleration.size]


def causal_highpass_samples(acceleration: FloatArray, dt: float, hz: float) -> FloatArray:
    """Return samples high-passed causally (forwards only), as instruments and many agencies do.

    Filter, baseline and padding (before the record) as in :func:`highpass_samples`, run once: amplitude 0.71 at the corner, phase
    shifted.

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
    # the transient of the start decays within the padding before the record
    run_sections(sections, row, steady_state=False)
    return row[pad:]


def end_line(acceleration: FloatArray, dt: float, hz: float) -> FloatArray:
    """Return the baseline removed before a high-pass: the straight line through both ends of the samples.

    Least squares, weighted by a Hann window of half a corner period at either end (of the whole record if shorter): shaking in the middle
    does not tilt the line, and the tapers average out a cycle cut by the ends. Exact for constants and straight lines.

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
    """Return the baseline at mid-record and its rise from there to the end, m/s^2."""
    n = acceleration.size
    length = int(min(n, max(2.0, np.rint(BASELINE_PERIODS / (hz * dt)))))
    # half-sample offset keeps all weights positive, so that short records stay well-conditioned
    # Hann window at the sample centres
    taper = np.sin(np.pi * (np.arange(length) + 0.5) / length) ** 2
    # the weights are symmetric about the middle, so the normal equations for level and slope decouple
    ends = ((_normalized_positions(n, 0, length), acceleration[:length]), (_normalized_positions(n, n - length, n), acceleration[-length:]))
    level = sum(taper @ a for _, a in ends) / (2.0 * taper.sum())
    slope = sum((taper * x) @ a for x, a in ends) / sum(taper @ x**2 for x, _ in ends)
    return float(level), float(slope)


def _normalized_positions(samples: int, begin: int, end: int) -> FloatArray:
    """Return positions of samples `begin` to `end` on an axis from -1 (first sample of all) to 1 (last)."""
    position = np.arange(begin, end, dtype=np.float64)
    return position * (2.0 / max(samples - 1, 1)) - 1.0


def _pad(acceleration: FloatArray, dt: float, hz: float, pad_before: int, pad_after: int) -> FloatArray:
    """Return samples minus the baseline, extended by mirror images of reversed sign, in one allocation."""
    n = acceleration.size
    level, slope = _level_and_slope(acceleration, dt, hz)
    row = np.empty(pad_before + n + pad_after)
    for begin in range(0, n, CHUNK_SIZE):
        end = min(begin + CHUNK_SIZE, n)
        row[pad_before + begin : pad_before + end] = acceleration[begin:end] - (slope * _normalized_positions(n, begin, end) + level)
    _fill_mirror_image(row, pad_before, n)
    return row


def _design(dt: float, hz: float) -> tuple[FloatArray, int]:
    """Return the filter sections and the padding length, samples, after which transients have decayed."""
    nyquist = 0.5 / dt
    if not (np.isfinite(hz) and 0 < hz < nyquist):
        raise ParameterError(
            "high-pass corner must lie between 0 and {nyquist:g} Hz (half the sampling rate), found {hz:g} Hz", nyquist=nyquist, hz=hz
        )
    # as a float: the ratio may exceed the range of integers
    pad = np.ceil(PADDING_PERIODS / (hz * dt))
    if pad > MAX_PADDING:
        min_corner = PADDING_PERIODS / (MAX_PADDING * dt)
        raise ParameterError(
            "high-pass corner {hz:g} Hz requires {pad:.3g} samples of padding at each end of the record, limit {most}; choose a "
            "corner of at least {least:.2g} Hz",
            hz=hz,
            pad=pad,
            most=MAX_PADDING,
            least=min_corner,
        )
    return highpass_sections(dt, hz), int(pad)


def _fill_mirror_image(row: FloatArray, pad_before: int, samples: int) -> None:
    """Fill both ends of a row with the sign-reversed mirror image of its interior, repeated as needed."""
    interior = row[pad_before : pad_before + samples]
    for end, position in (
        (row[:pad_before], np.arange(-pad_before, 0)),
        (row[pad_before + samples :], np.arange(samples, row.size - pad_before)),
    ):
        # the extension has a period of twice the record; its second half runs backwards with reversed sign
        # the extension reaches beyond the record where the corner period is long, and repeats
        position %= 2 * samples
        is_mirrored = position >= samples
        end[:] = interior[np.where(is_mirrored, 2 * samples - 1 - position, position)]
        end[is_mirrored] *= -1.0
