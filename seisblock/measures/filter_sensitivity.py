"""How far PGV, and the frequency that rests on it, move with the high-passes that are usual."""

from __future__ import annotations

from dataclasses import dataclass

from seisblock.core.typing import FloatArray
from seisblock.measures.baseline import ground_history_of
from seisblock.measures.frequency import pga_pgv_frequency
from seisblock.measures.peaks import peak_velocity
from seisblock.records.filters import causal_highpass_samples, highpass_samples

USUAL_HIGHPASS_HZ = (0.05, 0.1)
"""Corners that agencies use for strong motion, Hz; each may act with and without delay."""

REPORTING_THRESHOLD = 0.05
"""Relative change beyond which the choice of the filter is told."""


@dataclass(frozen=True)
class FilterRange:
    """PGV and PGA/(2 pi PGV) of one component under the usual high-passes, the least and the largest of each.

    Parameters
    ----------
    highpass_hz : tuple of float, Hz
        The corners; each with zero phase (forwards and backwards) and causal (forwards only).
    pgv_m_s : two floats, m/s
    pga_pgv_hz : two floats, Hz
        With the PGA of the record as given.
    """

    highpass_hz: tuple[float, ...]
    pgv_m_s: tuple[float, float]
    pga_pgv_hz: tuple[float, float]


def filter_range(acceleration: FloatArray, dt: float, pga: float, pgv: float) -> FilterRange | None:
    """Return how far PGV and f move with the usual filters, None when by no more than 5 % ([Furukawa2009]_ section 3(5)e leaves it open).

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration.
    dt : float, s
        Sampling interval.
    pga, pgv : float, m/s^2 and m/s
        Peaks of the component as stated, on its own baseline.

    Returns
    -------
    FilterRange or None
        None also where there is no motion, or where the corners lie beyond half the sampling rate.
    """
    if not (pga > 0.0 and pgv > 0.0 and max(USUAL_HIGHPASS_HZ) * dt < 0.5):
        return None
    filters = (highpass_samples, causal_highpass_samples)
    velocities = [peak_velocity(ground_history_of(f(acceleration, dt, hz), dt), dt) for f in filters for hz in USUAL_HIGHPASS_HZ]
    low, high = min(velocities), max(velocities)
    if low <= 0.0 or (low >= (1.0 - REPORTING_THRESHOLD) * pgv and high <= (1.0 + REPORTING_THRESHOLD) * pgv):
        return None
    return FilterRange(USUAL_HIGHPASS_HZ, (low, high), (pga_pgv_frequency(pga, high) or 0.0, pga_pgv_frequency(pga, low) or 0.0))
