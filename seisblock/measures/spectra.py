"""Spectra: response of oscillators, exact for the piecewise linear record, and smoothed Fourier amplitude."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np

from seisblock import checks
from seisblock.errors import KindError, ParameterError
from seisblock.records import Motion, Record
from seisblock.showing import Drawn
from seisblock.typing import ArrayLike, FloatArray

DAMPING = 0.05
"""Default damping ratio of response spectra."""

SMOOTHING_HZ = 0.2
"""Default bandwidth of the Parzen window, Hz."""

_POINTS_PER_PERIOD = 20
"""Least points per period of the oscillator; a maximum of the cubics through values and slopes is then right to 1e-4."""

LONG = 2**20
"""Samples (three hours at 100 Hz) beyond which a Fourier amplitude is made piece by piece."""

_PARZEN_LAG = 280.0 / 151.0
"""Largest lag of a Parzen window times its bandwidth: 1 / bandwidth is the integral of the squared spectral window."""


@dataclass(frozen=True, eq=False)
class ResponseSpectrum(Drawn):
    """Largest responses of damped oscillators to one component.

    Parameters
    ----------
    period_s : (m,) array, s
        Undamped natural periods.
    sa_m_s2, sv_m_s, sd_m : (m,) arrays, m/s^2, m/s, m
        Absolute acceleration, velocity and displacement relative to the ground.
    damping : float
        Ratio to critical.
    """

    period_s: FloatArray
    sa_m_s2: FloatArray
    sv_m_s: FloatArray
    sd_m: FloatArray
    damping: float


def default_periods() -> FloatArray:
    """Return the 100 periods from 0.05 to 10 s, evenly spaced in logarithm, at which spectra are drawn ([NigamJennings1969]_)."""
    return np.geomspace(0.05, 10.0, 100)


def response_spectrum(
    acceleration: FloatArray, dt: float, periods: ArrayLike | None = None, *, damping: float = DAMPING
) -> ResponseSpectrum:
    """Return the response spectrum by the exact solution for piecewise linear ground acceleration ([NigamJennings1969]_ method).

    u'' + 2 h w u' + w^2 u = -a(t) from rest. The exact step from sample to sample is linear in the state and the two samples,
    hence a second-order recursive filter of the record. Where the record is coarse against the period it is evaluated at
    more points of the same straight lines, 20 per period; between points the maxima are those of the cubics through values and slopes.
    After the last sample the ground is still and the oscillator swings on: the largest swing of that free motion counts, too.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration.
    dt : float, s
        Sampling interval.
    periods : (m,) array, s, optional
        Positive; :func:`default_periods` when left out.
    damping : float
        Ratio to critical, 0 <= damping < 1.

    Returns
    -------
    ResponseSpectrum

    Raises
    ------
    ParameterError
        If a period is not positive or the damping outside its range.

    Examples
    --------
    >>> import numpy as np
    >>> pulse = 4.0 * np.sin(np.linspace(0.0, np.pi, 101))
    >>> response_spectrum(pulse, 0.01, [1.0]).sa_m_s2.round(3)
    array([6.495])
    """
    if isinstance(acceleration, (Motion, Record)):
        found = type(acceleration).__name__
        raise KindError("accelerations are needed, found a {found}: give motion.horizontal and motion.dt", found=found)
    acceleration = checks.numbers("the accelerations", acceleration)
    checks.positive("the sampling interval", dt, "s")
    wanted = default_periods() if periods is None else np.atleast_1d(checks.numbers("the periods", periods))
    if not (np.isfinite(wanted).all() and (wanted > 0).all()):
        raise ParameterError("the periods of a response spectrum must be positive")
    checks.within("the damping ratio", damping, "[0, 1)")
    refined: dict[int, FloatArray] = {1: acceleration}
    peaks = np.empty((3, wanted.size))
    for column, period in enumerate(wanted):
        parts = max(1, math.ceil(_POINTS_PER_PERIOD * dt / period))
        if parts not in refined:
            n = acceleration.size
            refined[parts] = np.interp(np.arange((n - 1) * parts + 1) / parts, np.arange(n), acceleration)
        peaks[:, column] = _oscillator_peaks(refined[parts], dt / parts, 2.0 * math.pi / period, damping)
    return ResponseSpectrum(wanted, peaks[0], peaks[1], peaks[2], damping)


def fourier_amplitude(acceleration: FloatArray, dt: float, *, smoothing_hz: float = SMOOTHING_HZ) -> tuple[FloatArray, FloatArray]:
    """Return the Fourier amplitude smoothed by a Parzen window ([Parzen1961]_), the mean of the record removed first.

    The *energy* |X(f)|^2 is smoothed, by weighing the autocorrelation with the lag window (which is the same, and exact),
    and its root is returned.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration.
    dt : float, s
        Sampling interval.
    smoothing_hz : float, Hz
        Bandwidth of the window; its standard deviation is 0.3 of it.

    Returns
    -------
    frequency : (m,) array, Hz
        From 0 to half the sampling rate, at least 14 points per bandwidth.
    amplitude : (m,) array, m/s

    Raises
    ------
    ParameterError
        If the bandwidth is not positive.
    """
    checks.positive("the smoothing bandwidth", smoothing_hz, "Hz")
    n = acceleration.size
    longest_lag = _PARZEN_LAG / smoothing_hz
    size = 1 << math.ceil(math.log2(max(2 * min(n, LONG), 8.0 * longest_lag / dt)))
    if n <= LONG:
        energy = np.abs(np.fft.rfft(acceleration - acceleration.mean(), size)) ** 2 * dt**2
        autocorrelation = np.fft.irfft(energy, size)
    else:
        autocorrelation = _autocorrelation(acceleration, size, math.ceil(longest_lag / dt)) * dt**2
    lag = np.minimum(np.arange(size), size - np.arange(size)) * dt / longest_lag
    window = np.where(lag < 0.5, 1.0 - 6.0 * lag**2 * (1.0 - lag), 2.0 * np.clip(1.0 - lag, 0.0, None) ** 3)
    smoothed = np.fft.rfft(autocorrelation * window).real
    frequency = np.asarray(np.fft.rfftfreq(size, dt), dtype=np.float64)
    return frequency, np.sqrt(np.clip(smoothed, 0.0, None))


def _autocorrelation(acceleration: FloatArray, size: int, most: int) -> FloatArray:
    """Return the autocorrelation of a long row less its mean, circular, (size,), up to a lag of so many samples and zero beyond.

    The lag window ends there, so that pieces of the row with as much of what follows give all of it, in the memory of a piece.
    """
    mean = float(acceleration.mean())
    piece = size - most
    lags = np.zeros(most + 1)
    for begin in range(0, acceleration.size, piece):
        longer = np.fft.rfft(acceleration[begin : begin + size] - mean, size)
        shorter = np.fft.rfft(acceleration[begin : begin + piece] - mean, size)
        lags += np.fft.irfft(longer * shorter.conj(), size)[: most + 1]
    circular = np.zeros(size)
    circular[: most + 1] = lags
    circular[size - most :] = lags[:0:-1]
    return circular


def _oscillator_peaks(ground: FloatArray, dt: float, omega: float, damping: float) -> tuple[float, float, float]:
    """Return the peak absolute acceleration, relative velocity and relative displacement of one oscillator, from rest to rest."""
    from scipy.signal import lfilter

    # state (u, v, a, a') over one step: a straight line of ground acceleration is part of the linear system
    system = np.zeros((4, 4))
    system[0, 1] = system[2, 3] = 1.0
    system[1, :3] = -(omega**2), -2.0 * damping * omega, -1.0
    step = _exponential(system * dt)
    transition = step[:2, :2]
    at_end = step[:2, 3] / dt
    at_start = step[:2, 2] - at_end
    # x[k+1] = T x[k] + s a[k] + e a[k+1], eliminated to one recursion per row by Cayley-Hamilton
    denominator = np.array([1.0, -np.trace(transition), transition[0, 0] * transition[1, 1] - transition[0, 1] * transition[1, 0]])
    adjugate = np.array([[transition[1, 1], -transition[0, 1]], [-transition[1, 0], transition[0, 0]]])
    middle = at_start - adjugate @ at_end
    last = -adjugate @ at_start
    first = float(ground[0])
    rows = []
    for i in range(2):
        # the filter's memory that makes the first output zero (rest at the first sample) and the second exact
        memory = np.array([-at_end[i] * first, (at_start[i] - middle[i]) * first])
        rows.append(lfilter([at_end[i], middle[i], last[i]], denominator, ground, zi=memory)[0])
    displacement, velocity = rows
    absolute = -(2.0 * damping * omega * velocity + omega**2 * displacement)
    relative = absolute - ground
    jerk = -(2.0 * damping * omega * relative + omega**2 * velocity)
    during = (_peak_between(value, slope, dt) for value, slope in ((absolute, jerk), (velocity, relative), (displacement, velocity)))
    # on still ground the absolute acceleration is the relative one
    u, v, a = float(displacement[-1]), float(velocity[-1]), float(absolute[-1])
    after = (_free_peak(x, rate, omega, damping) for x, rate in ((a, -(2.0 * damping * omega * a + omega**2 * v)), (v, a), (u, v)))
    acceleration, speed, distance = map(max, during, after)
    return acceleration, speed, distance


def _exponential(matrix: FloatArray) -> FloatArray:
    """Return the exponential of a small matrix, by its series and by squaring; scipy's asks a threaded library, a hundred times slower."""
    halvings = max(math.ceil(math.log2(max(float(np.abs(matrix).sum(axis=0).max()), 1.0))), 0)
    small = matrix / 2.0**halvings
    total = term = np.eye(matrix.shape[0])
    for k in range(1, 20):
        term = term @ small / k
        total = total + term
    for _ in range(halvings):
        total = total @ total
    return total


def _peak_between(value: FloatArray, slope: FloatArray, dt: float) -> float:
    """Return the largest absolute value of the cubics through values and slopes at even steps, at the points and between them."""
    top = float(np.abs(value).max())
    turns = np.flatnonzero(slope[:-1] * slope[1:] < 0.0)
    # a cubic rises above its ends by 4/27 of their slopes at most: few turns can beat the points
    reach = np.maximum(np.abs(value[turns]), np.abs(value[turns + 1])) + 4.0 / 27.0 * dt * np.abs(slope[turns] - slope[turns + 1])
    turns = turns[reach > top]
    first, last = dt * slope[turns], dt * slope[turns + 1]
    rise = value[turns + 1] - value[turns]
    square, cube = 3.0 * rise - 2.0 * first - last, first + last - 2.0 * rise
    # the root of the derivative at which the curve turns, in the form that does not cancel
    place = first / (-square + np.copysign(np.sqrt(square**2 - 3.0 * cube * first), first))
    between = value[turns] + place * (first + place * (square + place * cube))
    return max(top, float(np.abs(between).max(initial=0.0)))


def _free_peak(value: float, rate: float, omega: float, damping: float) -> float:
    """Return the largest absolute value of a damped free swing that begins with a value and a rate."""
    decay, swing = damping * omega, omega * math.sqrt(1.0 - damping**2)
    # the swing is the real part of amplitude * exp(pole * t); it turns first where that of pole * amplitude * exp(pole * t) is zero
    amplitude, pole = complex(value, -(rate + decay * value) / swing), complex(-decay, swing)
    until = (0.5 * math.pi - cmath.phase(pole * amplitude)) % math.pi / swing
    return max(abs(value), abs((amplitude * cmath.exp(pole * until)).real))
