"""Arias intensity, significant duration and JMA instrumental seismic intensity."""

from __future__ import annotations

import math

import numpy as np

from seisblock.core import checks
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.limits import CHUNK_SIZE, MEMORY_VARIABLE, memory_limit
from seisblock.core.typing import FloatArray
from seisblock.core.units import GAL, STANDARD_GRAVITY
from seisblock.measures.fft_filter import add_filtered_square, filter_weights, transform_mib
from seisblock.records.motion import motion_of
from seisblock.records.record import Record

JMA_EXCEEDANCE_S = 0.3
"""Total time for which the filtered vector exceeds the amplitude that defines the intensity, s ([JMA1996]_)."""

MIN_INTENSITY = -3.0
"""Minimum intensity, which corresponds to 0.01 gal, the resolution of the seismometers of the scale ([JMA1996]_)."""

SKEW_TOLERANCE = 1e-9
"""Cosine of the angle between two horizontals above which they are orthogonalised first."""

MIN_SINE = 1e-6
"""Sine of that angle below which the horizontals are parallel and cannot be orthogonalised."""

_HALF_CLASSES = ((5.0, N_("5-")), (5.5, N_("5+")), (6.0, N_("6-")), (6.5, N_("6+")))
_CLASSES = ((0.5, "0"), (1.5, "1"), (2.5, "2"), (3.5, "3"), (4.5, "4"), *_HALF_CLASSES)
"""Upper bounds of the classes of [JMA1996]_; the class above the last bound is 7."""

_HIGH_CUT = (1.0, 0.694, 0.241, 0.0557, 0.009664, 0.00134, 0.000155)
"""Coefficients of the high-cut filter of [JMA1996]_ in powers of (f / 10 Hz)^2."""


def arias_intensity(acceleration: FloatArray, dt: float, *, gravity: float = STANDARD_GRAVITY) -> float:
    """Return the Arias intensity, pi / (2 g) times the integral of the squared acceleration ([Arias1970]_).

    Exact for linear interpolation between samples.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration.
    dt : float, s
        Sampling interval.
    gravity : float, m/s^2

    Returns
    -------
    float, m/s

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.measures import arias_intensity
    >>> sine = np.sin(2.0 * np.pi * np.arange(1001) * 0.01)
    >>> round(arias_intensity(sine, 0.01), 3)
    0.8
    """
    return math.pi / (2.0 * gravity) * float(_square_integrals(acceleration, dt).sum())


def significant_duration(acceleration: FloatArray, dt: float, *, fractions: tuple[float, float] = (0.05, 0.95)) -> float:
    """Return the time between two fractions of the Arias intensity, 5 and 95 % by default ([TrifunacBrady1975]_).

    The integral of the squared piecewise linear acceleration is a cubic in time, inverted in closed form: the result does not depend on
    the positions of the samples.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration.
    dt : float, s
        Sampling interval.
    fractions : two floats
        Fractions between 0 and 1.

    Returns
    -------
    float, s
        0 if all samples are zero.

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.measures import significant_duration
    >>> sine = np.sin(2.0 * np.pi * np.arange(1001) * 0.01)
    >>> round(significant_duration(sine, 0.01), 2)
    9.0
    """
    cumulative = np.zeros(acceleration.size)
    cumulative[1:] = _square_integrals(acceleration, dt)
    np.cumsum(cumulative[1:], out=cumulative[1:])
    total = float(cumulative[-1])
    if total == 0.0:
        return 0.0
    start, end = (_time_of_energy(acceleration, dt, cumulative, fraction * total) for fraction in fractions)
    return end - start


def orthogonal_components(record: Record) -> list[FloatArray]:
    """Return the components, with two horizontals of known oblique azimuths orthogonalised."""
    azimuths = [c.azimuth_deg for c in record.horizontals if c.azimuth_deg is not None]
    if len(azimuths) == 2:
        angle = math.radians(azimuths[1] - azimuths[0])
        if abs(math.sin(angle)) > MIN_SINE and abs(math.cos(angle)) > SKEW_TOLERANCE:
            return list(motion_of(record, record.horizontals[0].code).acceleration)
    return [c.acceleration for c in record.components]


def jma_intensity(record: Record) -> float | None:
    """Return the JMA instrumental seismic intensity, not rounded ([JMA1996]_ method).

    The three components are filtered in the frequency domain (period effect f^-1/2, high cut at 10 Hz, low cut at 0.5 Hz,
    zero at zero frequency) and combined as a vector. I = 2 log10 a0 + 0.94, where a0 (gal) is the largest amplitude that is
    exceeded for a total of 0.3 s.

    Parameters
    ----------
    record : Record
        Two horizontals and the vertical. Horizontals at an oblique angle are orthogonalised first if their azimuths are known;
        parallel ones are used unchanged.

    Returns
    -------
    float or None
        None if the intensity is undefined: a component is missing, the record is shorter than 0.3 s, the motion is too weak (intensity
        below -3, 0.01 gal), or the filter exceeds the memory limit. :func:`missing_intensity_reason` returns the cause.

    Examples
    --------
    >>> from seisblock.measures import jma_intensity
    >>> from seisblock.readers import read
    >>> round(jma_intensity(read("synthetic_jma.csv")), 1)
    6.6
    """
    checks.instance(record, Record)
    n_exceeding = _samples_needed(record)
    if record.vertical is None or len(record.horizontals) != 2 or n_exceeding > record.samples:
        return None
    if transform_mib(record.samples) > memory_limit():
        return None
    weights = filter_weights(record.samples, record.dt, _jma_filter)
    vector_squared = np.zeros(record.samples)
    for acceleration in orthogonal_components(record):
        add_filtered_square(vector_squared, acceleration, weights)
    # a0 is the n-th largest amplitude, n = number of samples in 0.3 s
    vector_squared.partition(record.samples - n_exceeding)
    # squares have the same order as amplitudes, and 2 log10 a0 = log10 a0^2: no square root is needed
    a0_squared = float(vector_squared[record.samples - n_exceeding]) / GAL**2
    intensity = math.log10(a0_squared) + 0.94 if a0_squared > 0 else -math.inf
    return intensity if intensity >= MIN_INTENSITY else None


def missing_intensity_reason(record: Record) -> str:
    """Return the reason why :func:`jma_intensity` is None ([JMA1996]_), as a translatable message."""
    if record.vertical is None or len(record.horizontals) != 2:
        return lazy_gettext("two horizontal components and the vertical (UD) are required; the record has {codes}", codes=record.codes)
    if _samples_needed(record) > record.samples:
        return lazy_gettext("the record is shorter than 0.3 s ({duration:g} s)", duration=record.duration_s)
    if (required_mib := transform_mib(record.samples)) > (max_mib := memory_limit()):
        return lazy_gettext(
            "filtering {samples} samples needs {found} MiB, more than the limit of {most} MiB: shorten the record by one or two samples "
            "or raise {variable}",
            samples=record.samples,
            found=required_mib,
            most=max_mib,
            variable=MEMORY_VARIABLE,
        )
    if not any(np.any(c.acceleration) for c in record.components):
        return lazy_gettext("all samples are zero")
    return lazy_gettext("the motion is too weak: the filtered acceleration does not reach 0.01 gal for 0.3 s")


def _samples_needed(record: Record) -> int:
    """Return the number of samples in 0.3 s."""
    # the tolerance removes the round-off of the division, which could add a sample
    return math.ceil(JMA_EXCEEDANCE_S / record.dt - 1e-6)


def jma_class(intensity: float) -> str:
    """Return the JMA seismic intensity class, ``0`` to ``4``, ``5-``, ``5+``, ``6-``, ``6+`` or ``7`` ([JMA1996]_).

    As JMA does, the intensity is first rounded to two decimals and truncated to one.

    Parameters
    ----------
    intensity : float, 1
        Instrumental intensity.

    Returns
    -------
    str

    Examples
    --------
    >>> from seisblock.measures import jma_class
    >>> [jma_class(i) for i in (-1.0, 4.494, 4.497, 5.1, 7.2)]
    ['0', '4', '5-', '5+', '7']
    """
    checks.finite("the intensity", intensity)
    # the inner rounding to 6 digits removes the round-off of the multiplication before the floor
    reported_intensity = math.floor(round(round(intensity, 2) * 10, 6)) / 10
    return next((name for bound, name in _CLASSES if reported_intensity < bound), "7")


def _jma_filter(frequency: FloatArray) -> FloatArray:
    """Return the product of the three filters of [JMA1996]_ at frequencies in Hz; zero at zero frequency."""
    # placeholder at zero frequency, where the weight is set to zero below
    f = np.where(frequency > 0, frequency, 1.0)
    y2 = (f / 10.0) ** 2
    # expm1 keeps the digits of 1 - exp(-x) at low frequency
    high_cut = 1.0 / np.sqrt(np.polynomial.polynomial.polyval(y2, _HIGH_CUT))
    low_cut = np.sqrt(-np.expm1(-((f / 0.5) ** 3)))
    weight: FloatArray = np.where(frequency > 0, high_cut * low_cut / np.sqrt(f), 0.0)
    return weight


def _square_integrals(acceleration: FloatArray, dt: float) -> FloatArray:
    """Return the integral of the squared linear acceleration over each sample interval, (n - 1,), m^2/s^3."""
    integrals = np.empty(acceleration.size - 1)
    # integral of the squared line from a to b: dt (a^2 + a b + b^2)/3
    for begin in range(0, integrals.size, CHUNK_SIZE):
        a, b = acceleration[begin : begin + CHUNK_SIZE], acceleration[begin + 1 : begin + 1 + CHUNK_SIZE]
        a = a[: b.size]
        integrals[begin : begin + CHUNK_SIZE] = dt / 3.0 * (a * a + a * b + b * b)
    return integrals


def _time_of_energy(acceleration: FloatArray, dt: float, cumulative: FloatArray, energy: float) -> float:
    """Return the time at which the cumulative integral of the square reaches a value, s."""
    interval = min(int(np.searchsorted(cumulative, energy, side="left")), acceleration.size - 1) - 1
    if interval < 0:
        return 0.0
    a, b = float(acceleration[interval]), float(acceleration[interval + 1])
    remaining, interval_energy = energy - float(cumulative[interval]), float(cumulative[interval + 1] - cumulative[interval])
    slope = (b - a) / dt
    # solve ((a + slope t)^3 - a^3) / (3 slope) = remaining; for a nearly constant acceleration the cube root would cancel
    if abs(b - a) <= 1e-6 * max(abs(a), abs(b)):
        return dt * (interval + remaining / interval_energy)
    return dt * interval + (math.cbrt(a**3 + 3.0 * slope * remaining) - a) / slope
