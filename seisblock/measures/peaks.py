"""Peak ground acceleration, velocity and displacement, and the peak of the horizontal vector over all azimuths."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ComponentError
from seisblock.core.typing import FloatArray
from seisblock.measures.baseline import GroundHistory
from seisblock.records.integrals import displacements, velocities
from seisblock.records.process import component_at_azimuth
from seisblock.records.record import Record


@dataclass(frozen=True, repr=False)
class HorizontalPeak(DisplayMixin):
    """Peak horizontal ground acceleration over all azimuths.

    Parameters
    ----------
    pga_m_s2 : float, m/s^2
        Length of the longest horizontal acceleration vector.
    azimuth_deg : float or None, degrees
        Direction of the vector, clockwise from north, 0 to 360; None if the azimuths of the components are unknown.
    time_s : float, s
        Time of the peak after the record's first sample.
    """

    pga_m_s2: float
    azimuth_deg: float | None
    time_s: float


def peak_acceleration(acceleration: FloatArray) -> tuple[float, int]:
    """Return the peak absolute acceleration (m/s^2) and the index of its first sample ([Furukawa2009]_ table 4(a)).

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
        Ground acceleration, linear between samples, so that the peak lies on a sample.

    Returns
    -------
    peak : float, m/s^2
        Absolute value.
    index : int
        First sample with that value.

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.measures import peak_acceleration
    >>> peak_acceleration(np.array([0.0, 1.0, -2.0, 0.5]))
    (2.0, 2)
    """
    highest, lowest = int(acceleration.argmax()), int(acceleration.argmin())
    maximum, minimum = float(acceleration[highest]), -float(acceleration[lowest])
    index = min(highest, lowest) if maximum == minimum else highest if maximum > minimum else lowest
    return abs(float(acceleration[index])), index


def peak_velocity(history: GroundHistory, dt: float) -> float:
    """Return the peak absolute velocity, also between samples ([Furukawa2009]_ table 4(b)).

    Velocity is quadratic in each interval; its extrema lie at samples and at zero crossings of the acceleration.

    Parameters
    ----------
    history : GroundHistory
        From :func:`seisblock.measures.baseline.ground_history`.
    dt : float, s
        Sampling interval.

    Returns
    -------
    float, m/s

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.measures import ground_history, peak_velocity
    >>> sine = np.sin(2.0 * np.pi * np.arange(1001) * 0.01)
    >>> round(peak_velocity(ground_history(sine, 0.01, highpass_hz=None), 0.01), 3)
    0.159
    """
    largest = 0.0
    for begin, v in velocities(history.acceleration, dt, history.initial_velocity):
        a = history.acceleration[begin : begin + v.size]
        # velocity is extremal where the acceleration crosses zero
        crossing = np.flatnonzero(a[:-1] * a[1:] < 0)
        until_zero = dt * a[crossing] / (a[crossing] - a[crossing + 1])
        # the triangle of acceleration between sample and crossing
        at_crossings = v[crossing] + 0.5 * a[crossing] * until_zero
        largest = max(largest, float(np.abs(v).max()), float(np.abs(at_crossings).max(initial=0.0)))
    return largest


def peak_displacement(history: GroundHistory) -> float:
    """Return the peak absolute displacement at the samples relative to the start, m ([Furukawa2009]_ section 3(5)e).

    Parameters
    ----------
    history : GroundHistory
        From :func:`seisblock.measures.baseline.ground_history`; its displacement is zero at both ends of the record.

    Returns
    -------
    float, m

    Examples
    --------
    >>> import numpy as np
    >>> from seisblock.measures import ground_history, peak_displacement
    >>> sine = np.sin(2.0 * np.pi * np.arange(1001) * 0.01)
    >>> round(peak_displacement(ground_history(sine, 0.01, highpass_hz=None)), 3)
    0.025
    """
    pieces = displacements(history.acceleration, history.dt, history.initial_velocity)
    return max(float(np.abs(piece).max()) for _, piece in pieces)


def peak_horizontal(record: Record) -> HorizontalPeak | None:
    """Return the longest horizontal acceleration vector and its azimuth.

    The peak along an azimuth is the largest projection of the vectors on it; its maximum over all azimuths is the length of the longest
    vector, which lies at a sample because of the linear interpolation. A criterion of one component is most severe in this direction
    ([Furukawa2009]_ section 3(7) treats two components separately).

    Parameters
    ----------
    record : Record
        Record with two horizontals; those of unknown azimuth are assumed to be orthogonal.

    Returns
    -------
    HorizontalPeak or None
        None without two horizontals.

    Examples
    --------
    >>> from seisblock import read
    >>> from seisblock.measures import peak_horizontal
    >>> peak = peak_horizontal(read("synthetic_jma.csv"))
    >>> round(peak.pga_m_s2, 3), round(peak.azimuth_deg, 1)
    (10.412, 314.1)
    """
    if len(record.horizontals) < 2:
        return None
    try:
        north, east = (component_at_azimuth(record, azimuth).acceleration for azimuth in (0.0, 90.0))
        is_oriented = True
    except ComponentError:
        north, east = (c.acceleration for c in record.horizontals[:2])
        is_oriented = False
    length = np.hypot(north, east)
    index = int(length.argmax())
    azimuth = math.degrees(math.atan2(float(east[index]), float(north[index]))) % 360.0 if is_oriented else None
    return HorizontalPeak(float(length[index]), azimuth, record.offset_s + index * record.dt)
