"""Motions of a scenario: records scaled to a JMA intensity, a PGA, a PGA with a PGV, or a spectral acceleration."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import Message, lazy_gettext
from seisblock.core.jma_scale import parse_jma_intensity
from seisblock.core.limits import MAX_VALUES
from seisblock.core.units import GAL, KINE
from seisblock.measures.intensity import jma_class
from seisblock.measures.spectra import response_spectrum
from seisblock.measures.summary import conventions_of, motion_peaks
from seisblock.records.motion import Motion, motion_of
from seisblock.records.process import crop, require_horizontals, scale, scale_to_jma
from seisblock.records.record import Record
from seisblock.records.synthetic.suite import synthetic_suite

EARTHQUAKES = ((6.0, 10.0), (6.5, 15.0), (7.0, 20.0), (7.5, 30.0))
"""Magnitude and distance, km, of the synthetic records of a scenario, in equal numbers."""

WIDE_EARTHQUAKES = ((5.0, 8.0), (5.5, 10.0), *EARTHQUAKES, (8.0, 40.0), (8.0, 100.0))
"""The same where the ratio of PGV to PGA is given: the records nearest to it are used."""

RECORDINGS = ("hanmer_springs_2016", "shafter_1989")
"""Bundled recordings with three components."""

STRONG_BEFORE_S, STRONG_AFTER_S = 20.0, 40.0
"""Part of a recording that is used, s before and after its largest acceleration."""

DEFAULT_RECORDS = 40
"""Default number of records of a scenario."""

MAX_STRETCH = 2.0
"""Change of the duration of a record above which the scenario has no suitable records."""

MAX_DURATION_FACTOR = 5.0
"""Change of the duration of a record above which PGA and PGV cannot belong to one earthquake."""

STRETCH_TOLERANCE = 1e-9
"""Relative error of the ratio of PGV to PGA at which the stretching of a record ends."""


@dataclass(frozen=True)
class ScenarioTarget:
    """Intensity of a scenario.

    Parameters
    ----------
    jma : float or None, 1
        JMA intensity of the whole record; texts such as ``6+`` are understood.
    pga_m_s2, pgv_m_s : float or None
        Peaks of the larger horizontal component. Both together also fix the frequency content.
    sa_m_s2, period_s : float or None
        Spectral acceleration (5 % damping) of the larger horizontal component, and its period.

    Raises
    ------
    ParameterError
        If none or several intensities are given, or a number is out of range.
    """

    jma: float | None = None
    pga_m_s2: float | None = None
    pgv_m_s: float | None = None
    sa_m_s2: float | None = None
    period_s: float | None = None

    def __post_init__(self) -> None:
        if self.jma is not None:
            object.__setattr__(self, "jma", parse_jma_intensity(self.jma))
        for name, value, unit in (
            ("PGA", self.pga_m_s2, "m/s^2"),
            ("PGV", self.pgv_m_s, "m/s"),
            ("Sa", self.sa_m_s2, "m/s^2"),
            ("T", self.period_s, "s"),
        ):
            if value is not None:
                checks.positive(name, value, unit)
        if (self.sa_m_s2 is None) != (self.period_s is None):
            raise ParameterError("a spectral acceleration requires a period, and a period a spectral acceleration")
        kinds = sum(value is not None for value in (self.jma, self.sa_m_s2)) + (self.pga_m_s2 is not None or self.pgv_m_s is not None)
        if kinds != 1:
            raise ParameterError("a scenario requires one intensity: a JMA intensity, a PGA (with or without a PGV), a PGV, or an Sa")

    @property
    def label(self) -> Message:
        """The intensity as text."""
        if self.jma is not None:
            return lazy_gettext("JMA intensity {value:.3g} (class {name})", value=self.jma, name=lazy_gettext(jma_class(self.jma)))
        if self.sa_m_s2 is not None:
            return lazy_gettext("Sa({period:g} s) {value:.4g} gal", period=self.period_s, value=self.sa_m_s2 / GAL)
        pga = None if self.pga_m_s2 is None else lazy_gettext("PGA {value:.4g} gal", value=self.pga_m_s2 / GAL)
        pgv = None if self.pgv_m_s is None else lazy_gettext("PGV {value:.4g} kine", value=self.pgv_m_s / KINE)
        return lazy_gettext("{parts}", parts=[part for part in (pga, pgv) if part is not None])


def scenario_suite(target: ScenarioTarget, count: int = DEFAULT_RECORDS, *, seed: int = 0) -> tuple[list[Record], tuple[Message, ...]]:
    """Return the records of a scenario without records of its own, scaled to it, and notes on their origin.

    Synthetic records of four earthquakes ([Boore2003]_ method, :func:`~seisblock.records.synthetic.suite.synthetic_suite`) and the
    bundled recordings. With PGA and PGV, the records of a wider set whose ratio PGV/PGA is nearest to the given one.

    Parameters
    ----------
    target : ScenarioTarget
    count : int
        Number of records, at least 10.
    seed : int
    """
    checks.integer("the number of records", count, minimum=10)
    if count > MAX_VALUES:
        raise ParameterError("the number of records must not exceed {limit}, found {count}", limit=MAX_VALUES, count=count)
    if target.pga_m_s2 is None or target.pgv_m_s is None:
        pool = unscaled_suite(count, seed=seed)
        return [scale_to_target(record, target) for record in pool], (_suite_note(pool, target),)
    # three times as many records as needed, of more earthquakes: those with the nearest ratio change least
    pool = [*_recordings(), *_synthetic_records(WIDE_EARTHQUAKES, 3 * count, seed)]
    ratio = target.pgv_m_s / target.pga_m_s2
    distances = {id(record): abs(math.log(pgv / _nonzero(record, pga) / ratio)) for record in pool for pga, pgv in [_peaks(record)]}
    pool = sorted(pool, key=lambda record: distances[id(record)])[:count]
    percent = 100.0 * (math.exp(max(distances[id(record)] for record in pool)) - 1.0)
    notes = [lazy_gettext("{suite}; durations changed by up to {percent:.0f} %", suite=_suite_note(pool, target), percent=percent)]
    if percent > 100.0 * (MAX_STRETCH - 1.0):
        notes.append(lazy_gettext("PGV/PGA of {ratio:.2g} s is unusual for earthquakes: check both values", ratio=ratio))
    return [scale_to_target(record, target) for record in pool], tuple(notes)


def unscaled_suite(count: int, *, seed: int = 0) -> list[Record]:
    """Return bundled recordings and synthetic records of several earthquakes, as they are.

    Parameters
    ----------
    count : int
        Number of records, more than the bundled ones.
    seed : int
    """
    recordings = _recordings()
    return [*recordings, *_synthetic_records(EARTHQUAKES, count - len(recordings), seed)]


def _recordings() -> list[Record]:
    from seisblock.readers import read  # readers are slow to import

    return [_strong_part(read(name)) for name in RECORDINGS]


def _strong_part(record: Record) -> Record:
    """Return the part of a record around its largest acceleration: minutes of weak motion would only take time."""
    largest = max(record.horizontals, key=lambda component: float(abs(component.acceleration).max()))
    peak_s = float(abs(largest.acceleration).argmax()) * record.dt
    return crop(record, max(peak_s - STRONG_BEFORE_S, 0.0), min(peak_s + STRONG_AFTER_S, record.duration_s))


def _synthetic_records(earthquakes: Sequence[tuple[float, float]], count: int, seed: int) -> list[Record]:
    """Return synthetic records of several earthquakes, in equal numbers; those of one do not depend on the count."""
    sizes = [len(range(first, count, len(earthquakes))) for first in range(len(earthquakes))]
    suites = [
        synthetic_suite(*source, size, seed=seed + i) for i, (source, size) in enumerate(zip(earthquakes, sizes, strict=True)) if size
    ]
    return [record for suite in suites for record in suite]


def _suite_note(records: Sequence[Record], target: ScenarioTarget) -> Message:
    synthetic = sum(record.format == "synthetic" for record in records)
    return lazy_gettext(
        "{count} records: {synthetic} synthetic, {recorded} recorded; scaled to {target}",
        count=len(records),
        synthetic=synthetic,
        recorded=len(records) - synthetic,
        target=target.label,
    )


def scale_to_target(record: Record, target: ScenarioTarget) -> Record:
    """Return a record scaled to an intensity, all components by the same factor; with PGA and PGV also stretched in time.

    A record whose time is stretched by a factor keeps its accelerations, and its velocities grow by that factor.
    """
    if target.jma is not None:
        return scale_to_jma(record, target.jma)
    if target.sa_m_s2 is not None:
        values = [
            float(response_spectrum(c.acceleration, record.dt, [target.period_s or 0.0]).sa_m_s2[0]) for c in require_horizontals(record)
        ]
        return scale(record, target.sa_m_s2 / _nonzero(record, max(values)))
    if target.pga_m_s2 is None:
        return scale(record, (target.pgv_m_s or 0.0) / _nonzero(record, _peaks(record)[1]))
    if target.pgv_m_s is not None:
        factor = _stretch(record, target)
        entry = lazy_gettext("time stretched by {factor:.6g}", factor=factor)
        record = replace(record, dt=record.dt * factor, history=(*record.history, entry))
    return scale(record, target.pga_m_s2 / _nonzero(record, _peaks(record)[0]))


def motion_pairs(records: Sequence[Record]) -> list[tuple[Motion, Motion]]:
    """Return the motions of the two horizontals of each record.

    Raises
    ------
    ComponentError
        If a record has other than two horizontals.
    """
    pairs = []
    for record in records:
        codes = [component.code for component in require_horizontals(record)]
        pairs.append((motion_of(record, codes[0]), motion_of(record, codes[-1])))
    return pairs


def _peaks(record: Record) -> tuple[float, float]:
    """Return PGA, m/s^2, and PGV, m/s, each of the horizontal component where it is larger."""
    peaks = [motion_peaks(c.acceleration, record.dt, conventions_of(record)) for c in require_horizontals(record)]
    return max(peak.pga_m_s2 for peak in peaks), max(peak.pgv_m_s for peak in peaks)


def _stretch(record: Record, target: ScenarioTarget) -> float:
    """Return the factor on the time of a record that gives it the ratio PGV/PGA of a target."""
    ratio, factor = (target.pgv_m_s or 0.0) / (target.pga_m_s2 or 1.0), 1.0
    # the ratio grows almost in proportion; only the high-pass of the velocity does not stretch with the record
    for _ in range(30):
        pga, pgv = _peaks(replace(record, dt=record.dt * factor))
        error = ratio * _nonzero(record, pga) / pgv
        factor *= error
        if not 1.0 / MAX_DURATION_FACTOR <= factor <= MAX_DURATION_FACTOR:
            raise ParameterError(
                "no record has PGV/PGA of {ratio:.2g} s (earthquakes: about 0.03 to 0.3 s): check both values and their units", ratio=ratio
            )
        if abs(error - 1.0) < STRETCH_TOLERANCE:
            break
    return factor


def _nonzero(record: Record, value: float) -> float:
    if not value > 0.0:
        raise ParameterError("{source}: the motion is zero and cannot be scaled", source=record.source or lazy_gettext("record"))
    return value
