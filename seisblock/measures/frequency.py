"""The frequency of the sine that a record is taken for: three definitions of the equivalent frequency."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.core.errors import ParameterError
from seisblock.core.limits import CHUNK_SIZE
from seisblock.core.typing import FloatArray
from seisblock.measures.peaks import peak_acceleration
from seisblock.measures.spectra import SMOOTHING_HZ, fourier_amplitude

FOURIER_BAND_HZ = (0.1, 25.0)
"""Default band in which the dominant Fourier frequency is looked for, Hz; cut at half the sampling rate."""


@dataclass(frozen=True)
class EquivalentFrequency:
    """The three equivalent frequencies of one component ([Furukawa2009]_ section 3(5)e), Hz; None where one is not defined.

    Parameters
    ----------
    pga_pgv : float or None
        Method 1, the paper's choice: PGA / (2 pi PGV).
    fourier : float or None
        Method 2: where the smoothed Fourier amplitude is largest.
    pulse_width : float or None
        Method 3: 1 / T, with T/2 the width of the pulse that holds the PGA.
    """

    pga_pgv: float | None
    fourier: float | None
    pulse_width: float | None


@dataclass(frozen=True)
class Pulse:
    """The pulse that holds the PGA, between the zero crossings before and after it.

    Parameters
    ----------
    frequency_hz : float, Hz
        One over twice its width.
    start_s, end_s : float, s
        Its ends, from the first sample.
    ambiguous : bool
        The record begins or ends within the pulse: the frequency is an upper bound.
    """

    frequency_hz: float
    start_s: float
    end_s: float
    ambiguous: bool


def pga_pgv_frequency(pga: float, pgv: float) -> float | None:
    """Return PGA / (2 pi PGV), the equivalent frequency by method 1 of [Furukawa2009]_ section 3(5)e.

    Exact for a sine; 1.16582 f0 for a Ricker wavelet. It depends on the component and on the filter behind the PGV: take
    both from one component, and state the filter.

    Parameters
    ----------
    pga, pgv : float, m/s^2 and m/s
        Peaks of one component.

    Returns
    -------
    float or None, Hz
        None when either is zero.
    """
    return pga / (2.0 * math.pi * pgv) if pga > 0 and pgv > 0 else None


def dominant_frequency(
    acceleration: FloatArray, dt: float, *, band_hz: tuple[float, float] = FOURIER_BAND_HZ, smoothing_hz: float = SMOOTHING_HZ
) -> float | None:
    """Return where the smoothed Fourier amplitude is largest, method 2 of [Furukawa2009]_ section 3(5)e.

    The paper states neither smoothing nor band. Here: mean removed, energy smoothed by a Parzen window of 0.2 Hz, band 0.1
    to 25 Hz, the maximum interpolated by a parabola.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration.
    dt : float, s
        Sampling interval.
    band_hz : two floats, Hz
        Where to look; cut at half the sampling rate.
    smoothing_hz : float, Hz
        Bandwidth of the Parzen window.

    Returns
    -------
    float or None, Hz
        None when the amplitude is largest at an edge of the band: no frequency inside dominates.

    Raises
    ------
    ParameterError
        If the band is empty.
    """
    low, high = band_hz[0], min(band_hz[1], 0.5 / dt)
    if not 0 <= low < high:
        raise ParameterError(
            "the band {low:g}-{high:g} Hz is empty below {nyquist:g} Hz, half the sampling rate",
            low=band_hz[0],
            high=band_hz[1],
            nyquist=0.5 / dt,
        )
    frequency, amplitude = fourier_amplitude(acceleration, dt, smoothing_hz=smoothing_hz)
    in_band = np.flatnonzero((frequency >= low) & (frequency <= high))
    if in_band.size == 0:
        return None
    top = int(in_band[amplitude[in_band].argmax()])
    if amplitude[top] == 0.0 or top in (0, frequency.size - 1):
        return None
    left_value, peak_value, right_value = amplitude[top - 1 : top + 2]
    if left_value > peak_value or right_value > peak_value:
        return None  # still climbing across the edge of the band
    curvature = left_value - 2.0 * peak_value + right_value
    shift = 0.5 * (left_value - right_value) / curvature if curvature < 0 else 0.0
    return float(frequency[top] + shift * frequency[1])


def peak_pulse(acceleration: FloatArray, dt: float) -> Pulse | None:
    """Return the pulse that holds the PGA, method 3 of [Furukawa2009]_ section 3(5)e: its width is half a period.

    Zero crossings are interpolated. Exact for a sine; pi / (2 sqrt 2) f0 = 1.11072 f0 for a Ricker wavelet. Where the record
    begins or ends inside the pulse its end is taken instead, and the pulse is marked ambiguous.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration.
    dt : float, s
        Sampling interval.

    Returns
    -------
    Pulse or None
        None for a record that is zero throughout.
    """
    peak, top = peak_acceleration(acceleration)
    if peak == 0.0:
        return None
    samples_before, samples_after = _first_zero_crossing(acceleration[top::-1]), _first_zero_crossing(acceleration[top:])
    start = 0.0 if samples_before is None else top - samples_before
    end = float(acceleration.size - 1) if samples_after is None else top + samples_after
    return Pulse(1.0 / (2.0 * dt * (end - start)), dt * start, dt * end, samples_before is None or samples_after is None)


def _first_zero_crossing(row: FloatArray) -> float | None:
    """Return where a row that begins with its peak first comes to zero, in samples and on straight lines between; None: nowhere."""
    for begin in range(0, row.size, CHUNK_SIZE):
        crossings = np.flatnonzero(row[begin : begin + CHUNK_SIZE] * np.sign(row[0]) <= 0)
        if crossings.size:
            i = begin + int(crossings[0])
            return i - float(row[i] / (row[i] - row[i - 1]))
    return None
