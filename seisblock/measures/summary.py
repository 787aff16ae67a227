"""Every measure of a record in one call."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from seisblock.core import checks
from seisblock.core._display import HtmlReprMixin
from seisblock.core.i18n import lazy_gettext
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.measures.baseline import HIGHPASS_HZ, ground_history
from seisblock.measures.duration import Duration, Side, duration_above
from seisblock.measures.filter_sensitivity import FilterRange, filter_range
from seisblock.measures.frequency import (
    FOURIER_BAND_HZ,
    EquivalentFrequency,
    dominant_frequency,
    peak_pulse,
    pga_pgv_frequency,
)
from seisblock.measures.intensity import arias_intensity, jma_class, jma_intensity, missing_intensity_reason, significant_duration
from seisblock.measures.long_period import LongPeriodMotion, long_period_motion
from seisblock.measures.peaks import HorizontalPeak, peak_acceleration, peak_displacement, peak_horizontal, peak_velocity
from seisblock.measures.spectra import SMOOTHING_HZ
from seisblock.records.process import select_component
from seisblock.records.record import Component, Record
from seisblock.references import papers

DEFAULT_THRESHOLD = 0.1 * STANDARD_GRAVITY
"""Threshold of durations when none is given, m/s^2: a tenth of g, below which nothing stouter than H/B = 10 rocks, and about
the 100 gal from which the criteria of [Furukawa2009]_ are fitted."""

_ROUND_OFF = 1e-10
"""A velocity below this share of PGA times duration is round-off: what the high-pass leaves of an offset."""

"""What the numbers of :func:`measure` rest on."""


@dataclass(frozen=True)
class ComponentPeaks:
    """What criteria ask of one component: its peaks, and the frequencies that it is taken for.

    Parameters
    ----------
    component : str
        Code, or azimuth in degrees.
    pga_m_s2, time_of_pga_s : float, m/s^2 and s
        Peak absolute acceleration of the record as given, and when, from the record's first sample.
    pgv_m_s, pgd_m : float, m/s and m
        Peak absolute velocity and displacement on the stated baseline.
    equivalent_frequency_hz : EquivalentFrequency
        Three definitions.
    pulse_width_ambiguous : bool
        The record begins or ends inside the pulse that holds the PGA.
    """

    component: str
    pga_m_s2: float
    time_of_pga_s: float
    pgv_m_s: float
    pgd_m: float
    equivalent_frequency_hz: EquivalentFrequency
    pulse_width_ambiguous: bool


@dataclass(frozen=True)
class ComponentMeasures(ComponentPeaks):
    """The measures of one component, its peaks first; the fields are the keys of one result in the document of ``measure``.

    Parameters
    ----------
    duration : Duration
        Above the threshold.
    arias_m_s, significant_duration_s : float, m/s and s
        Arias intensity, and the time between 5 and 95 % of it.
    jma_intensity : float or None, 1
        Of the whole record, repeated here so that nobody misses it.
    usual_highpass : FilterRange or None
        How far PGV and PGA/(2 pi PGV) move with the usual filters; None when by no more than 5 %.
    """

    duration: Duration
    arias_m_s: float
    significant_duration_s: float
    jma_intensity: float | None
    usual_highpass: FilterRange | None = None


@dataclass(frozen=True)
class Conventions:
    """What the numbers depend on besides the record.

    Parameters
    ----------
    velocity_highpass_hz : float or None, Hz
        Corner of the zero-phase high-pass before integration; None for none.
    velocity_baseline : str
        What else was done.
    fourier_smoothing : str
        Window of the Fourier amplitude.
    fourier_smoothing_hz : float, Hz
        Its bandwidth.
    fourier_band_hz : two floats, Hz
        Where the dominant frequency was looked for.
    threshold_side : str
        Whether the threshold is exceeded by both signs or by one.
    gravity_m_s2 : float, m/s^2
        g of the Arias intensity.
    """

    velocity_highpass_hz: float | None = HIGHPASS_HZ
    velocity_baseline: str = "mean of the velocity removed; displacement zero at both ends"
    fourier_smoothing: str = "Parzen window on the energy, mean of the record removed"
    fourier_smoothing_hz: float = SMOOTHING_HZ
    fourier_band_hz: tuple[float, float] = FOURIER_BAND_HZ
    threshold_side: Side = "both"
    gravity_m_s2: float = STANDARD_GRAVITY


@dataclass(frozen=True)
class RecordMeasures(HtmlReprMixin):
    """What a record is, in numbers.

    Parameters
    ----------
    components : tuple of ComponentMeasures
        In the order asked.
    jma_intensity, jma_class : float and str, or None, 1
        Instrumental intensity (not rounded) and its class.
    long_period : LongPeriodMotion or None
        JMA's class of long-period ground motion, and the floor velocity behind it.
    horizontal : HorizontalPeak or None
        The longest horizontal vector and its azimuth.
    conventions : Conventions
        Filters, windows, baseline.
    warnings : tuple of str
        What to know before believing the numbers.
    citations : tuple of str
        Keys of the papers relied on.
    """

    components: tuple[ComponentMeasures, ...]
    jma_intensity: float | None
    jma_class: str | None
    long_period: LongPeriodMotion | None
    horizontal: HorizontalPeak | None
    conventions: Conventions
    warnings: tuple[str, ...] = ()
    citations: tuple[str, ...] = papers("measures")


def measure(
    record: Record,
    components: Sequence[str] | None = None,
    *,
    threshold: float = DEFAULT_THRESHOLD,
    conventions: Conventions | None = None,
) -> RecordMeasures:
    """Measure a record: peaks, equivalent frequencies, durations, intensities ([Furukawa2009]_, [JMA1996]_, [Arias1970]_).

    Parameters
    ----------
    record : Record
        As it shall be judged: remove an offset first (:func:`seisblock.records.process.demean`), the peak acceleration is
        taken as it stands.
    components : sequence of str, optional
        Codes, or azimuths in degrees such as ``37``; all of the record by default.
    threshold : float, m/s^2
        For the durations; a tenth of g by default, or the rocking threshold g B/H of a body.
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
    >>> found = measure(read("synthetic_jma.csv"))
    >>> found.jma_class, found.components[1].component, round(found.components[1].pga_m_s2, 2)
    ('7', 'EW', 9.62)
    """
    checks.instance(record, Record)
    rules = conventions or Conventions()
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
        warnings=(
            *_intensity_warnings(record, intensity),
            *_baseline_warnings(record, rules),
            *(text for m in results for text in _component_warnings(m)),
        ),
    )


def _measure_component(
    component: Component, record: Record, threshold: float, rules: Conventions, intensity: float | None
) -> ComponentMeasures:
    """Return the measures of one component."""
    a, dt = component.acceleration, record.dt
    peaks = component_peaks(component, dt, rules, record.offset_s)
    return ComponentMeasures(
        **vars(peaks),
        duration=duration_above(a, dt, threshold, side=rules.threshold_side),
        arias_m_s=arias_intensity(a, dt, gravity=rules.gravity_m_s2),
        significant_duration_s=significant_duration(a, dt),
        jma_intensity=intensity,
        usual_highpass=filter_range(a, dt, peaks.pga_m_s2, peaks.pgv_m_s),
    )


def component_peaks(component: Component, dt: float, rules: Conventions, start_s: float = 0.0) -> ComponentPeaks:
    """Return the peaks of one component and its equivalent frequencies ([Furukawa2009]_ section 3(5)e).

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
    history = ground_history(a, dt, highpass_hz=rules.velocity_highpass_hz)
    pgv = peak_velocity(history, dt)
    pgv = pgv if pgv > _ROUND_OFF * pga * (a.size - 1) * dt else 0.0
    pgd = peak_displacement(history)
    del history
    pulse = peak_pulse(a, dt)
    return ComponentPeaks(
        component=component.code,
        pga_m_s2=pga,
        time_of_pga_s=start_s + index * dt,
        pgv_m_s=pgv,
        pgd_m=pgd,
        equivalent_frequency_hz=EquivalentFrequency(
            pga_pgv=pga_pgv_frequency(pga, pgv),
            fourier=dominant_frequency(a, dt, band_hz=rules.fourier_band_hz, smoothing_hz=rules.fourier_smoothing_hz),
            pulse_width=None if pulse is None else pulse.frequency_hz,
        ),
        pulse_width_ambiguous=pulse is not None and pulse.ambiguous,
    )


def _intensity_warnings(record: Record, intensity: float | None) -> list[str]:
    """Say why there is no JMA intensity, when there is none."""
    return [] if intensity is not None else [lazy_gettext("no JMA intensity: {reason}", reason=missing_intensity_reason(record))]


def _baseline_warnings(record: Record, rules: Conventions) -> list[str]:
    """Say when the record is too short for the high-pass behind its velocities."""
    corner = rules.velocity_highpass_hz
    if not corner or record.duration_s * corner >= 1.0:
        return []
    return [
        lazy_gettext(
            "the record ({duration:g} s) is shorter than the corner period of the high-pass behind PGV ({period:g} s): "
            "an offset cannot be told from slow motion; where the level is known to be right, choose no high-pass",
            duration=record.duration_s,
            period=1 / corner,
        )
    ]


def _component_warnings(m: ComponentMeasures) -> list[str]:
    """Say what is doubtful about one component."""
    warnings: list[str] = []
    if m.pulse_width_ambiguous:
        text = "{component}: the record begins or ends inside the pulse that holds the PGA; its frequency is an upper bound"
        warnings.append(lazy_gettext(text, component=m.component))
    return warnings
