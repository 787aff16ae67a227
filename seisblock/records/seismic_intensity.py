"""JMA instrumental seismic intensity of a record: one number of its three components.

Belongs to the records, because :class:`~seisblock.records.preparation.Preparation` scales a record to an intensity.
"""

from __future__ import annotations

import math

import numpy as np

from seisblock.core import checks
from seisblock.core.i18n import lazy_gettext
from seisblock.core.limits import MEMORY_VARIABLE, memory_limit
from seisblock.core.typing import FloatArray
from seisblock.core.units import GAL
from seisblock.records.fft_filter import add_filtered_square, filter_weights, transform_mib
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
