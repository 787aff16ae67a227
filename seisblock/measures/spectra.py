"""Response spectra, exact for piecewise linear records, and smoothed Fourier amplitude spectra."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np

from seisblock._jit import kernel
from seisblock.core import checks
from seisblock.core._display import PlotMixin
from seisblock.core.errors import KindError, ParameterError
from seisblock.core.limits import CHUNK_SIZE
from seisblock.core.typing import ArrayLike, FloatArray
from seisblock.records import Motion, Record
from seisblock.records.oscillator import exact_step

ACCELERATION, VELOCITY, DISPLACEMENT, FINAL_DISPLACEMENT, FINAL_VELOCITY = range(5)
"""Entries of the state array: three peak responses, and the current displacement and velocity."""

FOUR_OVER_27 = 4.0 / 27.0
"""Bound of a cubic above the values at its ends, as a multiple of its length and the difference of its end slopes."""


def oscillator_peaks(ground: FloatArray, dt: float, omega: float, damping: float) -> tuple[float, float, float]:
    """Return the peak absolute acceleration, relative velocity and relative displacement of an oscillator.

    Exact step for linear ground acceleration ([NigamJennings1969]_ eq. (2.7)). Between samples, maxima are those of the
    cubic Hermite interpolants; after the last sample the ground is at rest and the peak of the free vibration counts, too.

    Parameters
    ----------
    ground : (n,) array, m/s^2
        Ground acceleration.
    dt : float, s
        Sampling interval.
    omega : float, rad/s
        Undamped natural frequency.
    damping : float
        Ratio to critical, 0 <= damping < 1.

    Returns
    -------
    float, float, float : m/s^2, m/s, m
    """
    step = exact_step(dt, omega, damping)
    peaks = np.zeros(5)
    for begin in range(0, max(ground.size - 1, 1), CHUNK_SIZE):
        _update_peaks(step, ground[begin : begin + CHUNK_SIZE + 1], dt, omega, damping, peaks)
    u, v = float(peaks[FINAL_DISPLACEMENT]), float(peaks[FINAL_VELOCITY])
    # on still ground the absolute acceleration is the relative one
    a = -(2.0 * damping * omega * v + omega**2 * u)
    # each response obeys the equation of free vibration, with its own value and rate at the end of the record
    free_peaks = (_free_peak(x, rate, omega, damping) for x, rate in ((a, -(2.0 * damping * omega * a + omega**2 * v)), (v, a), (u, v)))
    acceleration, speed, distance = map(max, peaks[:3].tolist(), free_peaks)
    return acceleration, speed, distance


@kernel("void(float64[:, ::1], Array(float64, 1, 'C', readonly=True), float64, float64, float64, float64[::1])")
def _update_peaks(step, ground, dt, omega, damping, peaks):
    """Integrate an oscillator over some samples and update its peak responses."""
    damping_term, stiffness = 2.0 * damping * omega, omega**2
    u, v = peaks[FINAL_DISPLACEMENT], peaks[FINAL_VELOCITY]
    absolute = -(damping_term * v + stiffness * u)
    relative = absolute - ground[0]
    # slope of the absolute acceleration, needed by its cubic interpolant
    jerk = -(damping_term * relative + stiffness * v)
    max_acceleration, max_velocity, max_displacement = (
        max(peaks[ACCELERATION], abs(absolute)),
        max(peaks[VELOCITY], abs(v)),
        max(peaks[DISPLACEMENT], abs(u)),
    )
    for k in range(ground.size - 1):
        ground_1, ground_2 = ground[k], ground[k + 1]
        u_2 = step[0, 0] * u + step[0, 1] * v + (step[0, 2] * ground_1 + step[0, 3] * ground_2)
        v_2 = step[1, 0] * u + step[1, 1] * v + (step[1, 2] * ground_1 + step[1, 3] * ground_2)
        absolute_2 = -(damping_term * v_2 + stiffness * u_2)
        relative_2 = absolute_2 - ground_2
        jerk_2 = -(damping_term * relative_2 + stiffness * v_2)
        max_acceleration = _peak_of_cubic(absolute, absolute_2, jerk, jerk_2, dt, max_acceleration)
        max_velocity = _peak_of_cubic(v, v_2, relative, relative_2, dt, max_velocity)
        max_displacement = _peak_of_cubic(u, u_2, v, v_2, dt, max_displacement)
        u, v, absolute, relative, jerk = u_2, v_2, absolute_2, relative_2, jerk_2
    peaks[ACCELERATION], peaks[VELOCITY], peaks[DISPLACEMENT], peaks[FINAL_DISPLACEMENT], peaks[FINAL_VELOCITY] = (
        max_acceleration,
        max_velocity,
        max_displacement,
        u,
        v,
    )


@kernel("float64(float64, float64, float64, float64, float64, float64)", inline=True)
def _peak_of_cubic(first, last, slope, slope_2, dt, top):
    """Return the maximum of `top` and the absolute value of the cubic Hermite interpolant of two values and slopes."""
    high = max(abs(first), abs(last))
    # an interior extremum needs slopes of opposite sign; skip it if the bound cannot exceed the peak so far
    if slope * slope_2 < 0.0 and high + FOUR_OVER_27 * dt * abs(slope - slope_2) > top:
        slope_dt, slope_2_dt, rise = dt * slope, dt * slope_2, last - first
        square, cube = 3.0 * rise - 2.0 * slope_dt - slope_2_dt, slope_dt + slope_2_dt - 2.0 * rise
        # root of the derivative at the extremum, in the form without cancellation
        place = slope_dt / (-square + math.copysign(math.sqrt(square**2 - 3.0 * cube * slope_dt), slope_dt))
        high = max(high, abs(first + place * (slope_dt + place * (square + place * cube))))
    return max(top, high)


def _free_peak(value: float, rate: float, omega: float, damping: float) -> float:
    """Return the maximum absolute value of a damped free vibration with given initial value and rate."""
    decay, swing = damping * omega, omega * math.sqrt(1.0 - damping**2)
    # x = Re(amplitude * exp(pole * t)); first extremum at Re(pole * amplitude * exp(pole * t)) = 0
    amplitude, pole = complex(value, -(rate + decay * value) / swing), complex(-decay, swing)
    turning_time = (0.5 * math.pi - cmath.phase(pole * amplitude)) % math.pi / swing
    return max(abs(value), abs((amplitude * cmath.exp(pole * turning_time)).real))


DAMPING = 0.05
"""Default damping ratio of response spectra."""

SMOOTHING_HZ = 0.2
"""Default bandwidth of the Parzen window, Hz."""

_POINTS_PER_PERIOD = 20
"""Minimum number of points per period of the oscillator; maxima of the cubic interpolants are then accurate to 1e-4."""

LONG_TRANSFORM = 2**20
"""Number of samples (three hours at 100 Hz) above which the Fourier amplitude is computed piecewise."""

_PARZEN_LAG = 280.0 / 151.0
"""Largest lag of a Parzen window times its bandwidth: 1 / bandwidth is the integral of the squared spectral window."""


@dataclass(frozen=True, eq=False, repr=False)
class ResponseSpectrum(PlotMixin):
    """Response spectrum of one component.

    Parameters
    ----------
    period_s : (m,) array, s
        Undamped natural periods.
    sa_m_s2, sv_m_s, sd_m : (m,) arrays, m/s^2, m/s, m
        Peak absolute acceleration, and peak velocity and displacement relative to the ground.
    damping : float
        Damping ratio.
    """

    period_s: FloatArray
    sa_m_s2: FloatArray
    sv_m_s: FloatArray
    sd_m: FloatArray
    damping: float


def default_periods() -> FloatArray:
    """Return 100 logarithmically spaced periods from 0.05 to 10 s for response spectra ([NigamJennings1969]_).

    Examples
    --------
    >>> from seisblock.measures import default_periods
    >>> periods = default_periods()
    >>> periods.size, round(float(periods[0]), 3), round(float(periods[-1]), 3)
    (100, 0.05, 10.0)
    """
    return np.geomspace(0.05, 10.0, 100)


def response_spectrum(
    acceleration: FloatArray, dt: float, periods: ArrayLike | None = None, *, damping: float = DAMPING
) -> ResponseSpectrum:
    """Return the response spectrum, exact for piecewise linear acceleration ([NigamJennings1969]_ method).

    u'' + 2 h w u' + w^2 u = -a(t) from rest. The exact step between samples is linear in the state and the two samples. If
    the sampling is coarse relative to the period, the record is interpolated linearly to 20 points per period; between points, maxima
    are those of the cubic Hermite interpolants. After the last sample the ground is at rest; the peak of the free vibration counts, too.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration.
    dt : float, s
        Sampling interval.
    periods : (m,) array, s, optional
        Natural periods, positive; default: :func:`default_periods`.
    damping : float
        Damping ratio, 0 <= damping < 1.

    Returns
    -------
    ResponseSpectrum

    Raises
    ------
    ParameterError
        If the accelerations are not one-dimensional, a period is not positive, or the damping is out of range.

    Examples
    --------
    >>> from seisblock.measures import response_spectrum
    >>> import numpy as np
    >>> pulse = 4.0 * np.sin(np.linspace(0.0, np.pi, 101))
    >>> response_spectrum(pulse, 0.01, [1.0]).sa_m_s2.round(3)
    array([6.495])
    """
    if isinstance(acceleration, (Motion, Record)):
        kind = type(acceleration).__name__
        raise KindError("expected an array of accelerations, found {found}: pass motion.horizontal and motion.dt", found=kind)
    acceleration = checks.float_vector("the accelerations", acceleration)
    if acceleration.size < 2:
        raise ParameterError("a motion needs at least 2 samples, found {count}", count=acceleration.size)
    checks.positive("the sampling interval", dt, "s")
    period_s = check_periods(periods, damping)
    resampled: dict[int, FloatArray] = {1: np.ascontiguousarray(acceleration)}
    peaks = np.empty((3, period_s.size))
    for column, period in enumerate(period_s):
        # short periods need points between the samples of a coarse record
        subdivisions = max(1, math.ceil(_POINTS_PER_PERIOD * dt / period))
        if subdivisions not in resampled:
            n = acceleration.size
            resampled[subdivisions] = np.interp(np.arange((n - 1) * subdivisions + 1) / subdivisions, np.arange(n), acceleration)
        peaks[:, column] = oscillator_peaks(resampled[subdivisions], dt / subdivisions, 2.0 * math.pi / period, damping)
    return ResponseSpectrum(period_s, peaks[0], peaks[1], peaks[2], damping)


def check_periods(periods: ArrayLike | None, damping: float) -> FloatArray:
    """Return the periods of a response spectrum, (m,), s, those of :func:`default_periods` for None; check periods and damping.

    Raises
    ------
    ParameterError
        If a period is not positive, or the damping is outside [0, 1).
    """
    period_s = default_periods() if periods is None else np.atleast_1d(checks.float_array("the periods", periods))
    if not (np.isfinite(period_s).all() and (period_s > 0).all()):
        raise ParameterError("the periods of a response spectrum must be positive")
    checks.in_interval("the damping ratio", damping, "[0, 1)")
    return period_s


def fourier_amplitude(acceleration: FloatArray, dt: float, *, smoothing_hz: float = SMOOTHING_HZ) -> tuple[FloatArray, FloatArray]:
    """Return the Fourier amplitude spectrum of the record minus its mean, smoothed by a Parzen window ([Parzen1961]_).

    The energy ``|X(f)|^2`` is smoothed by multiplying the autocorrelation by the lag window, which is equivalent and exact;
    its square root is returned.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration.
    dt : float, s
        Sampling interval.
    smoothing_hz : float, Hz
        Bandwidth of the window; the standard deviation is 0.3 times the bandwidth.

    Returns
    -------
    frequency : (m,) array, Hz
        Frequencies from 0 to the Nyquist frequency, at least 14 per bandwidth.
    amplitude : (m,) array, m/s

    Raises
    ------
    ParameterError
        If the bandwidth is not positive.

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.measures import fourier_amplitude
    >>> sine = np.sin(2.0 * np.pi * np.arange(1001) * 0.01)
    >>> frequency, amplitude = fourier_amplitude(sine, 0.01)
    >>> round(float(frequency[amplitude.argmax()]), 2)
    1.0
    """
    checks.positive("the smoothing bandwidth", smoothing_hz, "Hz")
    n = acceleration.size
    longest_lag = _PARZEN_LAG / smoothing_hz
    # zero padding: no circular overlap of the autocorrelation, and enough frequencies per bandwidth
    size = 1 << math.ceil(math.log2(max(2 * min(n, LONG_TRANSFORM), 8.0 * longest_lag / dt)))
    if n <= LONG_TRANSFORM:
        energy = np.abs(np.fft.rfft(acceleration - acceleration.mean(), size)) ** 2 * dt**2
        autocorrelation = np.fft.irfft(energy, size)
    else:
        autocorrelation = _autocorrelation(acceleration, size, math.ceil(longest_lag / dt)) * dt**2
    lag = np.minimum(np.arange(size), size - np.arange(size)) * dt / longest_lag
    # Parzen's lag window: two cubics that meet at half of the longest lag
    window = np.where(lag < 0.5, 1.0 - 6.0 * lag**2 * (1.0 - lag), 2.0 * np.clip(1.0 - lag, 0.0, None) ** 3)
    smoothed_energy = np.fft.rfft(autocorrelation * window).real
    frequency = np.asarray(np.fft.rfftfreq(size, dt), dtype=np.float64)
    # the Parzen spectrum is non-negative; clip the round-off
    return frequency, np.sqrt(np.clip(smoothed_energy, 0.0, None))


def _autocorrelation(acceleration: FloatArray, size: int, max_lag: int) -> FloatArray:
    """Return the circular autocorrelation of a long record minus its mean, (size,), up to `max_lag` samples and zero beyond.

    It is the sum of the correlations of each piece with the piece extended by `max_lag` samples; the lag window vanishes beyond them.
    """
    mean = float(acceleration.mean())
    # a piece and its extension fit into one transform without circular overlap
    piece = size - max_lag
    lags = np.zeros(max_lag + 1)
    for begin in range(0, acceleration.size, piece):
        extended = np.fft.rfft(acceleration[begin : begin + size] - mean, size)
        block = np.fft.rfft(acceleration[begin : begin + piece] - mean, size)
        lags += np.fft.irfft(extended * block.conj(), size)[: max_lag + 1]
    circular = np.zeros(size)
    circular[: max_lag + 1] = lags
    # the autocorrelation is even: negative lags stand at the end
    circular[size - max_lag :] = lags[:0:-1]
    return circular
