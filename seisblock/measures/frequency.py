"""Equivalent frequency of a record: PGA/(2 pi PGV), dominant Fourier frequency, width of the peak pulse."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.limits import CHUNK_SIZE
from seisblock.core.typing import FloatArray
from seisblock.measures.peaks import peak_acceleration
from seisblock.measures.spectra import SMOOTHING_HZ, fourier_amplitude

FOURIER_BAND_HZ = (0.1, 25.0)
"""Default band of the dominant Fourier frequency, Hz; cut at the Nyquist frequency."""


@dataclass(frozen=True, repr=False)
class EquivalentFrequency(DisplayMixin):
    """Equivalent frequencies of one component ([Furukawa2009]_ section 3(5)e), Hz; None if undefined.

    Parameters
    ----------
    pga_pgv : float or None, Hz
        Method 1, the paper's choice: PGA / (2 pi PGV).
    fourier : float or None, Hz
        Method 2: frequency of the largest smoothed Fourier amplitude.
    pulse_width : float or None, Hz
        Method 3: 1 / T, with T/2 the width of the pulse that contains the PGA.
    """

    pga_pgv: float | None
    fourier: float | None
    pulse_width: float | None


@dataclass(frozen=True, repr=False)
class Pulse(DisplayMixin):
    """Pulse that contains the PGA, between the zero crossings before and after it.

    Parameters
    ----------
    frequency_hz : float, Hz
        Inverse of twice the width.
    start_s, end_s : float, s
        Start and end of the pulse after the first sample.
    ambiguous : bool
        True if the record begins or ends within the pulse: the frequency is an upper bound.
    """

    frequency_hz: float
    start_s: float
    end_s: float
    ambiguous: bool


def pga_pgv_frequency(pga: float, pgv: float) -> float | None:
    """Return the equivalent frequency PGA / (2 pi PGV), method 1 of [Furukawa2009]_ section 3(5)e.

    Exact for a sine; 1.16582 f0 for a Ricker wavelet. The value depends on the high-pass filter used for PGV, which is to be
    stated; both peaks must be from the same component.

    Parameters
    ----------
    pga, pgv : float, m/s^2 and m/s
        Peaks of one component.

    Returns
    -------
    float or None, Hz
        None if a peak is zero.

    Examples
    --------
    >>> from seisblock.measures import pga_pgv_frequency
    >>> round(pga_pgv_frequency(3.0, 0.3), 3)
    1.592
    """
    return pga / (2.0 * math.pi * pgv) if pga > 0 and pgv > 0 else None


def dominant_frequency(
    acceleration: FloatArray, dt: float, *, band_hz: tuple[float, float] = FOURIER_BAND_HZ, smoothing_hz: float = SMOOTHING_HZ
) -> float | None:
    """Return the frequency of the largest smoothed Fourier amplitude, method 2 of [Furukawa2009]_ section 3(5)e.

    The paper states neither smoothing nor band. Here the mean is removed, the energy smoothed by a Parzen window of 0.2 Hz, the
    band is 0.1 to 25 Hz, and the maximum is interpolated by a parabola.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration.
    dt : float, s
        Sampling interval.
    band_hz : two floats, Hz
        Frequency band; cut at the Nyquist frequency.
    smoothing_hz : float, Hz
        Bandwidth of the Parzen window.

    Returns
    -------
    float or None, Hz
        None if the amplitude is largest at an edge of the band, that is, if no frequency inside it dominates.

    Raises
    ------
    ParameterError
        If the band is empty.

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.measures import dominant_frequency
    >>> sine = np.sin(2.0 * np.pi * np.arange(1001) * 0.01)
    >>> round(dominant_frequency(sine, 0.01), 2)
    1.0
    """
    low, high = band_hz[0], min(band_hz[1], 0.5 / dt)
    if not 0 <= low < high:
        raise ParameterError(
            "the band {low:g}-{high:g} Hz contains no frequency below the Nyquist frequency of {nyquist:g} Hz",
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
        # the amplitude still rises beyond the edge of the band
        return None
    # vertex of the parabola through the maximum and its neighbours
    curvature = left_value - 2.0 * peak_value + right_value
    shift = 0.5 * (left_value - right_value) / curvature if curvature < 0 else 0.0
    return float(frequency[top] + shift * frequency[1])


def peak_pulse(acceleration: FloatArray, dt: float) -> Pulse | None:
    """Return the pulse that contains the PGA, method 3 of [Furukawa2009]_ section 3(5)e: its width is half a period.

    Zero crossings are interpolated. Exact for a sine; pi / (2 sqrt 2) f0 = 1.11072 f0 for a Ricker wavelet. If the record
    begins or ends within the pulse, its first or last sample is used, and the pulse is marked ambiguous.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration.
    dt : float, s
        Sampling interval.

    Returns
    -------
    Pulse or None
        None if all samples are zero.

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.measures import peak_pulse
    >>> sine = np.sin(2.0 * np.pi * np.arange(1001) * 0.01)
    >>> pulse = peak_pulse(sine, 0.01)
    >>> round(pulse.frequency_hz, 3)
    1.0
    """
    peak, top = peak_acceleration(acceleration)
    if peak == 0.0:
        return None
    # both rows begin at the peak; the first one runs backwards in time
    samples_before, samples_after = _first_zero_crossing(acceleration[top::-1]), _first_zero_crossing(acceleration[top:])
    start = 0.0 if samples_before is None else top - samples_before
    end = float(acceleration.size - 1) if samples_after is None else top + samples_after
    return Pulse(1.0 / (2.0 * dt * (end - start)), dt * start, dt * end, samples_before is None or samples_after is None)


def _first_zero_crossing(row: FloatArray) -> float | None:
    """Return the first zero crossing of a row that begins with its peak, in samples, interpolated linearly; None without one."""
    for begin in range(0, row.size, CHUNK_SIZE):
        crossings = np.flatnonzero(row[begin : begin + CHUNK_SIZE] * np.sign(row[0]) <= 0)
        if crossings.size:
            i = begin + int(crossings[0])
            return i - float(row[i] / (row[i] - row[i - 1]))
    return None
