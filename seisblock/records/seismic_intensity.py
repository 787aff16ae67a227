"""JMA instrumental seismic intensity of a record: one number of its three components.

Belongs to the records, because :class:`~seisblock.records.preparation.Preparation` scales a record to an intensity.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np

from seisblock.core import checks
from seisblock.core.i18n import lazy_gettext
from seisblock.core.limits import CHUNK_SIZE, MEMORY_VARIABLE, MIB, memory_limit
from seisblock.core.typing import FloatArray
from seisblock.core.units import GAL
from seisblock.records.motion import motion_of
from seisblock.records.record import Record

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


JMA_EXCEEDANCE_S = 0.3
"""Total time for which the filtered vector exceeds the amplitude that defines the intensity, s ([JMA1996]_)."""

MIN_INTENSITY = -3.0
"""Minimum intensity, which corresponds to 0.01 gal, the resolution of the seismometers of the scale ([JMA1996]_)."""

SKEW_TOLERANCE = 1e-9
"""Cosine of the angle between two horizontals above which they are orthogonalised first."""

MIN_SINE = 1e-6
"""Sine of that angle below which the horizontals are parallel and cannot be orthogonalised."""

_HIGH_CUT = (1.0, 0.694, 0.241, 0.0557, 0.009664, 0.00134, 0.000155)
"""Coefficients of the high-cut filter of [JMA1996]_ in powers of (f / 10 Hz)^2."""


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
