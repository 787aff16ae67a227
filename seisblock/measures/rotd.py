"""Orientation-independent response spectra of two horizontals: RotD50 and RotD100."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock._jit import kernel
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ComponentError, ParameterError
from seisblock.core.i18n import lazy_gettext
from seisblock.core.limits import CHUNK_SIZE
from seisblock.core.typing import ArrayLike, FloatArray
from seisblock.measures.spectra import DAMPING, check_periods
from seisblock.records import Record
from seisblock.records.oscillator import exact_step
from seisblock.records.process import component_at_azimuth

DIRECTIONS = 180
"""Number of directions, one per degree over half a turn; the other half has the same peaks."""

POINTS_PER_PERIOD = 60
"""Minimum number of points per period of the oscillator; the largest of them is then at least 0.9986 of a maximum of its sine."""


@dataclass(frozen=True, eq=False, repr=False)
class RotatedSpectrum(DisplayMixin):
    """Median and maximum over all directions of the pseudo-spectral acceleration of two horizontals.

    Parameters
    ----------
    period_s : (m,) array, s
        Undamped natural periods.
    rotd50_m_s2, rotd100_m_s2 : (m,) arrays, m/s^2
        Median and maximum over the directions of the peak displacement times the squared circular frequency.
    damping : float
        Damping ratio.
    """

    period_s: FloatArray
    rotd50_m_s2: FloatArray
    rotd100_m_s2: FloatArray
    damping: float


def rotated_spectrum(record: Record, periods: ArrayLike | None = None, *, damping: float = DAMPING) -> RotatedSpectrum:
    """Return RotD50 and RotD100 of a record ([Boore2010]_ method).

    For each period the displacements of an oscillator under both horizontals are computed, exact for linear interpolation, and projected
    on 180 directions. Per direction the peak counts; of these, RotD50 is the median and RotD100 the maximum. Both are pseudo-spectral
    accelerations, as in models of ground motion. After the last sample the ground is at rest for a period.

    Parameters
    ----------
    record : Record
        Two horizontals; oblique ones of known azimuth are orthogonalised, others are taken as orthogonal.
    periods : (m,) array, s, optional
        Natural periods, positive; default: :func:`~seisblock.measures.default_periods`.
    damping : float
        Damping ratio, 0 <= damping < 1.

    Returns
    -------
    RotatedSpectrum

    Raises
    ------
    ParameterError
        If the record has not two horizontals, a period is not positive, or the damping is out of range.

    Examples
    --------
    >>> from seisblock.measures import rotated_spectrum
    >>> from seisblock.readers import read
    >>> spectrum = rotated_spectrum(read("synthetic_jma.csv"), [0.5, 1.0])
    >>> spectrum.rotd50_m_s2.round(1), spectrum.rotd100_m_s2.round(1)
    (array([16.9, 14.6]), array([21.8, 18.8]))
    """
    checks.instance(record, Record)
    period_s = check_periods(periods, damping)
    if len(record.horizontals) != 2:
        message = "{record}: RotD50 and RotD100 require two horizontal components, found {codes}"
        codes = [component.code for component in record.horizontals] or lazy_gettext("none")
        raise ParameterError(message, record=record.source or record.station or lazy_gettext("record"), codes=codes)
    pair = _orthogonal_horizontals(record)
    angles = np.arange(DIRECTIONS) * (math.pi / DIRECTIONS)
    directions = np.stack([np.cos(angles), np.sin(angles)])
    median, largest = np.empty(period_s.size), np.empty(period_s.size)
    for column, period in enumerate(period_s):
        omega = 2.0 * math.pi / period
        peaks = omega**2 * _peak_displacements(pair, record.dt, omega, damping, directions)
        median[column], largest[column] = np.median(peaks), peaks.max()
    return RotatedSpectrum(period_s, median, largest, damping)


def _orthogonal_horizontals(record: Record) -> tuple[FloatArray, FloatArray]:
    """Return the accelerations to north and east, or the two horizontals of unknown azimuth."""
    try:
        return component_at_azimuth(record, 0.0).acceleration, component_at_azimuth(record, 90.0).acceleration
    except ComponentError:
        return record.horizontals[0].acceleration, record.horizontals[1].acceleration


def _peak_displacements(pair: tuple[FloatArray, FloatArray], dt: float, omega: float, damping: float, directions: FloatArray) -> FloatArray:
    """Return the peak displacement of an oscillator in each direction, m, during the motion and a period of rest after it."""
    subdivisions = max(1, math.ceil(POINTS_PER_PERIOD * dt * omega / (2.0 * math.pi)))
    step = exact_step(dt / subdivisions, omega, damping)
    state, peaks = np.zeros(4), np.zeros(directions.shape[1])
    rest = np.zeros(math.ceil(2.0 * math.pi / (omega * dt)) + 1)
    for first, second in (pair, (rest, rest)):
        # in pieces, so that an interrupt takes effect between two of them
        for begin in range(0, max(first.size - 1, 1), CHUNK_SIZE):
            part = slice(begin, begin + CHUNK_SIZE + 1)
            _update_peaks(step, first[part], second[part], subdivisions, directions, state, peaks)
    return peaks


@kernel("float64(float64[::1])", inline=True)
def _smallest(row):
    """Return the minimum of a row."""
    result = row[0]
    for k in range(1, row.size):
        result = min(result, row[k])
    return result


@kernel(
    "void(float64[:, ::1], Array(float64, 1, 'C', readonly=True), Array(float64, 1, 'C', readonly=True), int64, float64[:, ::1], "
    "float64[::1], float64[::1])"
)
def _update_peaks(step, first, second, subdivisions, directions, state, peaks):
    """Integrate an oscillator under two components over some samples and update its peaks in all directions."""
    x, vx, y, vy = state[0], state[1], state[2], state[3]
    smallest = _smallest(peaks) ** 2
    for k in range(first.size - 1):
        rise_x, rise_y = (first[k + 1] - first[k]) / subdivisions, (second[k + 1] - second[k]) / subdivisions
        for j in range(subdivisions):
            a, b = first[k] + j * rise_x, second[k] + j * rise_y
            x, vx = (
                step[0, 0] * x + step[0, 1] * vx + (step[0, 2] * a + step[0, 3] * (a + rise_x)),
                step[1, 0] * x + step[1, 1] * vx + (step[1, 2] * a + step[1, 3] * (a + rise_x)),
            )
            y, vy = (
                step[0, 0] * y + step[0, 1] * vy + (step[0, 2] * b + step[0, 3] * (b + rise_y)),
                step[1, 0] * y + step[1, 1] * vy + (step[1, 2] * b + step[1, 3] * (b + rise_y)),
            )
            # a vector shorter than all peaks is shorter than each in its direction
            if x * x + y * y > smallest:
                for i in range(peaks.size):
                    peaks[i] = max(peaks[i], abs(x * directions[0, i] + y * directions[1, i]))
                smallest = _smallest(peaks) ** 2
    state[0], state[1], state[2], state[3] = x, vx, y, vy
