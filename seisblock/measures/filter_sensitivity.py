"""Sensitivity of PGV and PGA/(2 pi PGV) to the choice of the high-pass filter."""

from __future__ import annotations

from dataclasses import dataclass

from seisblock.core._display import DisplayMixin
from seisblock.core.typing import FloatArray
from seisblock.measures.baseline import ground_history_of
from seisblock.measures.frequency import pga_pgv_frequency
from seisblock.measures.peaks import peak_velocity
from seisblock.records.filters import causal_highpass_samples, highpass_samples

USUAL_HIGHPASS_HZ = (0.05, 0.1)
"""Corner frequencies commonly used for strong motion, Hz; each applied causally and with zero phase."""

REPORTING_THRESHOLD = 0.05
"""Relative change above which the range is reported."""


@dataclass(frozen=True, repr=False)
class FilterRange(DisplayMixin):
    """Minimum and maximum of PGV and PGA/(2 pi PGV) of one component for common high-pass filters.

    Parameters
    ----------
    highpass_hz : tuple of float, Hz
        Corner frequencies; each with zero phase (forwards and backwards) and causal (forwards only).
    pgv_m_s : two floats, m/s
    pga_pgv_hz : two floats, Hz
        With the PGA of the unfiltered record.
    """

    highpass_hz: tuple[float, ...]
    pgv_m_s: tuple[float, float]
    pga_pgv_hz: tuple[float, float]


def filter_range(acceleration: FloatArray, dt: float, pga: float, pgv: float) -> FilterRange | None:
    """Return the range of PGV and PGA/(2 pi PGV) for common filters, None if within 5 % ([Furukawa2009]_ section 3(5)e).

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration.
    dt : float, s
        Sampling interval.
    pga, pgv : float, m/s^2 and m/s
        Peaks of the component on the baseline of :mod:`seisblock.measures.baseline`.

    Returns
    -------
    FilterRange or None
        None also for a record without motion, or if a corner is above the Nyquist frequency.

    Examples
    --------
    >>> from seisblock import measure, read
    >>> from seisblock.measures import filter_range
    >>> record = read("synthetic_jma.csv")
    >>> peaks = measure(record).components[0]
    >>> limits = filter_range(record.components[0].acceleration, record.dt, peaks.pga_m_s2, peaks.pgv_m_s)
    >>> round(limits.pgv_m_s[0], 2), round(limits.pgv_m_s[1], 2)
    (1.16, 1.3)
    """
    if not (pga > 0.0 and pgv > 0.0 and max(USUAL_HIGHPASS_HZ) * dt < 0.5):
        return None
    filters = (highpass_samples, causal_highpass_samples)
    velocities = [peak_velocity(ground_history_of(f(acceleration, dt, hz), dt), dt) for f in filters for hz in USUAL_HIGHPASS_HZ]
    low, high = min(velocities), max(velocities)
    if low <= 0.0 or (low >= (1.0 - REPORTING_THRESHOLD) * pgv and high <= (1.0 + REPORTING_THRESHOLD) * pgv):
        return None
    # PGA/(2 pi PGV): the largest velocity gives the lowest frequency
    return FilterRange(USUAL_HIGHPASS_HZ, (low, high), (pga_pgv_frequency(pga, high) or 0.0, pga_pgv_frequency(pga, low) or 0.0))
