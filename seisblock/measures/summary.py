"""All measures of a record in one call."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.measures.baseline import HIGHPASS_HZ, GroundHistory, centred_history, ground_history
from seisblock.measures.duration import Duration, Side, duration_above
from seisblock.measures.filter_sensitivity import FilterRange, filter_range
from seisblock.measures.frequency import (
    FOURIER_BAND_HZ,
    EquivalentFrequency,
    dominant_frequency,
    peak_pulse,
    pga_pgv_frequency,
)
from seisblock.measures.intensity import arias_intensity, cumulative_absolute_velocity, jma_class, significant_duration
from seisblock.measures.long_period import LongPeriodMotion, long_period_motion
from seisblock.measures.peaks import HorizontalPeak, peak_acceleration, peak_displacement, peak_horizontal, peak_velocity
from seisblock.measures.rotd import RotatedSpectrum, rotated_spectrum
from seisblock.measures.spectra import SMOOTHING_HZ
from seisblock.records.analytic import ANALYTIC
from seisblock.records.process import select_component
from seisblock.records.record import Component, Record
from seisblock.records.seismic_intensity import jma_intensity, missing_intensity_reason
from seisblock.references import papers

DEFAULT_THRESHOLD = 0.1 * STANDARD_GRAVITY
"""Default threshold of durations, m/s^2: 0.1 g, the rocking threshold of H/B = 10 and about the lower limit (100 gal) of the fits of
[Furukawa2009]_."""

_ROUND_OFF = 1e-10
"""Velocity relative to PGA times duration below which it is round-off of the filtered offset."""


@dataclass(frozen=True)
class ComponentPeaks:
    """Peaks and equivalent frequencies of one component, the input of the overturning criteria.

    Parameters
    ----------
    component : str
        Code, or azimuth in degrees.
    pga_m_s2, time_of_pga_s : float, m/s^2 and s
        Peak absolute acceleration of the record and its time after the record's first sample.
    pgv_m_s, pgd_m : float, m/s and m
        Peak absolute velocity and displacement, see :class:`Conventions`.
    equivalent_frequency_hz : EquivalentFrequency
        Equivalent frequencies by three definitions.
    pulse_width_ambiguous : bool
        True if the record begins or ends within the pulse that contains the PGA.
    """

    component: str
    pga_m_s2: float
    time_of_pga_s: float
    pgv_m_s: float
    pgd_m: float
    equivalent_frequency_hz: EquivalentFrequency
    pulse_width_ambiguous: bool


@dataclass(frozen=True, repr=False)
class ComponentMeasures(DisplayMixin, ComponentPeaks):
    """Measures of one component; the fields are the keys of a result in the JSON document of ``measure``.

    Parameters
    ----------
    duration : Duration
        Duration above the threshold.
    cav_m_s : float, m/s
        Cumulative absolute velocity, the integral of the absolute acceleration.
    arias_m_s, significant_duration_s : float, m/s and s
        Arias intensity, and the time between 5 and 95 % of it.
    jma_intensity : float or None, 1
        Intensity of the whole record, repeated for each component.
    usual_highpass : FilterRange or None
        Range of PGV and PGA/(2 pi PGV) for common high-pass filters; None if within 5 %.
    """

    duration: Duration
    cav_m_s: float
    arias_m_s: float
    significant_duration_s: float
    jma_intensity: float | None
    usual_highpass: FilterRange | None = None


@dataclass(frozen=True, repr=False)
class Conventions(DisplayMixin):
    """Processing conventions of the measures.

    Parameters
    ----------
    velocity_highpass_hz : float or None, Hz
        Corner of the zero-phase high-pass before integration; None for no filter.
    velocity_baseline : str
        Baseline correction of velocity and displacement.
    fourier_smoothing : str
        Window of the Fourier amplitude.
    fourier_smoothing_hz : float, Hz
        Bandwidth of the window.
    fourier_band_hz : two floats, Hz
        Band of the dominant frequency.
    threshold_side : str
        Sign of the accelerations compared with the threshold.
    gravity_m_s2 : float, m/s^2
        Gravity in the Arias intensity.
    """

    velocity_highpass_hz: float | None = HIGHPASS_HZ
    velocity_baseline: str = "mean of the velocity removed; displacement zero at both ends"
    fourier_smoothing: str = "Parzen window on the energy, mean of the record removed"
    fourier_smoothing_hz: float = SMOOTHING_HZ
    fourier_band_hz: tuple[float, float] = FOURIER_BAND_HZ
    threshold_side: Side = "both"
    gravity_m_s2: float = STANDARD_GRAVITY


CENTRED = "analytic motion: mean of the velocity of the full cycles removed"
"""Baseline of analytic motions, which have no high-pass."""


def conventions_of(record: Record | None, conventions: Conventions | None = None) -> Conventions:
    """Return conventions as applied to a record: an analytic motion is not filtered, and its velocity has no mean."""
    rules = conventions or Conventions()
    is_analytic = record is not None and record.format == ANALYTIC
    return replace(rules, velocity_highpass_hz=None, velocity_baseline=CENTRED) if is_analytic else rules


def velocity_history(acceleration: FloatArray, dt: float, rules: Conventions) -> GroundHistory:
    """Return velocity and displacement of the ground by conventions."""
    if rules.velocity_baseline == CENTRED:
        return centred_history(acceleration, dt)
    return ground_history(acceleration, dt, highpass_hz=rules.velocity_highpass_hz)


@dataclass(frozen=True, repr=False)
class RecordMeasures(DisplayMixin):
    """Measures of a record.

    Parameters
    ----------
    components : tuple of ComponentMeasures
        Measures by component, in the order requested.
    jma_intensity, jma_class : float and str, or None, 1
        Instrumental intensity (not rounded) and its class.
    long_period : LongPeriodMotion or None
        JMA's class of long-period ground motion and the floor velocity.
    horizontal : HorizontalPeak or None
        Longest horizontal vector and its azimuth.
    conventions : Conventions
        Filters, windows, baseline.
    spectra : RotatedSpectrum or None
        RotD50 and RotD100; None without two horizontals.
    warnings : tuple of str
        Limits of validity of the values.
    citations : tuple of str
        Keys of the papers used.
    """

    components: tuple[ComponentMeasures, ...]
    jma_intensity: float | None
    jma_class: str | None
    long_period: LongPeriodMotion | None
    horizontal: HorizontalPeak | None
    conventions: Conventions
    spectra: RotatedSpectrum | None = None
    warnings: tuple[str, ...] = ()
    citations: tuple[str, ...] = papers("measures")


def measure(
    record: Record,
    components: Sequence[str] | None = None,
    *,
    threshold: float = DEFAULT_THRESHOLD,
    conventions: Conventions | None = None,
) -> RecordMeasures:
    """Return peaks, frequencies, durations and intensities of a record ([Furukawa2009]_, [JMA1996]_, [Arias1970]_).

    Parameters
    ----------
    record : Record
        Record. The peak acceleration includes any offset, which is to be removed first by :func:`seisblock.records.process.demean`.
    components : sequence of str, optional
        Codes, or azimuths in degrees such as ``37``; default: all components.
    threshold : float, m/s^2
        Threshold of the durations, 0.1 g by default; for example the rocking threshold g B/H of a body.
    conventions : Conventions, optional
        Filters, windows, baseline.

    Returns
    -------
    RecordMeasures

    Raises
    ------
    ComponentError
        If the record has no such component.
    ParameterError
        If the threshold or a convention is out of range.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> result = measure(read("synthetic_jma.csv"))
    >>> result.jma_class, result.components[1].component, round(result.components[1].pga_m_s2, 2)
    ('7', 'EW', 9.62)
    """
    checks.instance(record, Record)
    rules = conventions_of(record, conventions)
    selected = [select_component(record, name) for name in (record.codes if components is None else components)]
    intensity = jma_intensity(record)
    results = tuple(_measure_component(c, record, threshold, rules, intensity) for c in selected)
    return RecordMeasures(
        components=results,
        jma_intensity=intensity,
        jma_class=None if intensity is None else jma_class(intensity),
        long_period=long_period_motion(record),
        horizontal=peak_horizontal(record),
        conventions=rules,
        spectra=rotated_spectrum(record) if len(record.horizontals) == 2 else None,
        warnings=(
            *_intensity_warnings(record, intensity),
            *_baseline_warnings(record, rules),
            *(text for m in results for text in _component_warnings(m)),
        ),
    )


def _measure_component(
    component: Component, record: Record, threshold: float, rules: Conventions, intensity: float | None
) -> ComponentMeasures:
    a, dt = component.acceleration, record.dt
    peaks = component_peaks(component, dt, rules, record.offset_s)
    return ComponentMeasures(
        **vars(peaks),
        duration=duration_above(a, dt, threshold, side=rules.threshold_side),
        cav_m_s=cumulative_absolute_velocity(a, dt),
        arias_m_s=arias_intensity(a, dt, gravity=rules.gravity_m_s2),
        significant_duration_s=significant_duration(a, dt),
        jma_intensity=intensity,
        usual_highpass=None if rules.velocity_baseline == CENTRED else filter_range(a, dt, peaks.pga_m_s2, peaks.pgv_m_s),
    )


def component_peaks(component: Component, dt: float, rules: Conventions, start_s: float = 0.0) -> ComponentPeaks:
    """Return peaks and equivalent frequencies of one component ([Furukawa2009]_ section 3(5)e).

    Parameters
    ----------
    component : Component
    dt : float, s
        Sampling interval.
    rules : Conventions
    start_s : float, s
        Time of the first sample.

    Examples
    --------
    >>> from seisblock.readers import read
    >>> record = read("synthetic_jma.csv")
    >>> round(component_peaks(record.component("EW"), record.dt, Conventions()).equivalent_frequency_hz.pga_pgv, 2)
    0.65
    """
    a = component.acceleration
    pga, index = peak_acceleration(a)
    history = velocity_history(a, dt, rules)
    peaks = _peaks_of_history(pga, history)
    pgd = peak_displacement(history)
    # release the filtered copy before the Fourier transform of long records
    del history
    pulse = peak_pulse(a, dt)
    return ComponentPeaks(
        component=component.code,
        pga_m_s2=peaks.pga_m_s2,
        time_of_pga_s=start_s + index * dt,
        pgv_m_s=peaks.pgv_m_s,
        pgd_m=pgd,
        equivalent_frequency_hz=EquivalentFrequency(
            pga_pgv=peaks.frequency_hz,
            fourier=dominant_frequency(a, dt, band_hz=rules.fourier_band_hz, smoothing_hz=rules.fourier_smoothing_hz),
            pulse_width=None if pulse is None else pulse.frequency_hz,
        ),
        pulse_width_ambiguous=pulse is not None and pulse.ambiguous,
    )


class MotionPeaks(NamedTuple):
    """PGA, m/s^2, PGV, m/s, and the equivalent frequency PGA/(2 pi PGV), Hz, None if undefined."""

    pga_m_s2: float
    pgv_m_s: float
    frequency_hz: float | None


def motion_peaks(acceleration: FloatArray, dt: float, rules: Conventions) -> MotionPeaks:
    """Return the peaks of one component without the measures of :func:`component_peaks` that take longer; the same numbers.

    Parameters
    ----------
    acceleration : (n,) array, m/s^2
    dt : float, s
    rules : Conventions

    Examples
    --------
    >>> from seisblock.readers import read
    >>> record = read("synthetic_jma.csv")
    >>> east, rules = record.component("EW"), Conventions()
    >>> motion_peaks(east.acceleration, record.dt, rules).pgv_m_s == component_peaks(east, record.dt, rules).pgv_m_s
    True
    """
    pga, _ = peak_acceleration(acceleration)
    return _peaks_of_history(pga, velocity_history(acceleration, dt, rules))


def _peaks_of_history(pga: float, history: GroundHistory) -> MotionPeaks:
    """Return the peaks of a ground history and the PGA of its record."""
    pgv = peak_velocity(history, history.dt)
    # what remains of a constant offset after the filter is round-off, not motion
    pgv = pgv if pgv > _ROUND_OFF * pga * (history.acceleration.size - 1) * history.dt else 0.0
    return MotionPeaks(pga, pgv, pga_pgv_frequency(pga, pgv))


def _intensity_warnings(record: Record, intensity: float | None) -> list[str]:
    """Return a warning with the cause if the JMA intensity is undefined."""
    return [] if intensity is not None else [lazy_gettext("no JMA intensity: {reason}", reason=missing_intensity_reason(record))]


def _baseline_warnings(record: Record, rules: Conventions) -> list[str]:
    """Return a warning if the record is too short for the high-pass."""
    corner = rules.velocity_highpass_hz
    if not corner or record.duration_s * corner >= 1.0:
        return []
    return [
        lazy_gettext(
            "the record ({duration:g} s) is shorter than the corner period of the high-pass for PGV ({period:g} s): a baseline "
            "offset cannot be separated from long-period motion; if the baseline is known to be correct, switch off the high-pass",
            duration=record.duration_s,
            period=1 / corner,
        )
    ]


def _component_warnings(m: ComponentMeasures) -> list[str]:
    warnings: list[str] = []
    if m.pulse_width_ambiguous:
        text = "{component}: the record begins or ends within the pulse of the PGA; the pulse-width frequency is an upper bound"
        warnings.append(lazy_gettext(text, component=m.component))
    return warnings
