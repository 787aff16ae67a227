"""Text report of the intensity measures of a record, and time histories as columns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from rich.console import Group
from rich.text import Text

from seisblock.core.i18n import N_, gettext
from seisblock.core.limits import check_memory
from seisblock.core.typing import FloatArray
from seisblock.measures import FilterRange, RecordMeasures
from seisblock.measures.summary import velocity_history
from seisblock.output.io.atomic import normalize_zeros
from seisblock.output.io.history_csv import CHUNK_ROWS, CsvTable, concat_tables
from seisblock.output.text.tables import (
    acceleration_cell,
    format_acceleration,
    format_number,
    format_seconds,
    group_answers,
    styled_line,
    table,
)
from seisblock.output.units_display import acceleration_unit, length_unit, velocity_unit
from seisblock.records import Record
from seisblock.records.process import select_component

SHOWN_PERIODS = (0.2, 0.5, 1.0, 2.0)
"""Periods of the spectral accelerations in the text report, s; the JSON document has all."""


def tables(records: Sequence[Record], answers: Sequence[RecordMeasures], *, gal: bool) -> Iterator[Group | Text]:
    """Yield, per record, intensity, peaks, equivalent frequencies and durations.

    Parameters
    ----------
    records, answers : sequences of Record and RecordMeasures
    gal : bool
        Accelerations in gal and velocities in kine, else SI.
    """
    pairs = zip(records, answers, strict=True)
    for heading, ((_, answer),) in group_answers(
        pairs, lambda pair: pair[0], lambda pair: [styled_line("\n".join(_sentences(pair[1], gal=gal)))]
    ):
        yield from heading
        yield _peaks(answer, gal=gal)
        yield _frequencies_and_durations(answer, gal=gal)
        yield styled_line("\n".join((*_spectrum_lines(answer, gal=gal), *_sensitivity_lines(answer, gal=gal))))


def _peaks(answer: RecordMeasures, *, gal: bool) -> Group:
    a, v = acceleration_unit(gal=gal), velocity_unit(gal=gal)
    d = length_unit((m.pgd_m for m in answer.components), gal=gal)
    corner = answer.conventions.velocity_highpass_hz
    return table(
        gettext("Peak values and energy"),
        [
            *("", f"PGA ({a.name})", gettext("at (s)"), f"PGV ({v.name})", f"PGD ({d.name})"),
            *(name.replace(" (", "\n(") for name in ("CAV (m/s)", gettext("Arias (m/s)"), gettext("5-95 % (s)"))),
        ],
        [
            (
                m.component,
                acceleration_cell(m.pga_m_s2, gal=gal),
                format_seconds(m.time_of_pga_s),
                format_number(m.pgv_m_s / v.size),
                format_number(m.pgd_m / d.size),
                format_number(m.cav_m_s),
                format_number(m.arias_m_s),
                format_seconds(m.significant_duration_s),
            )
            for m in answer.components
        ],
        caption=gettext("PGV, PGD: high-pass {corner:g} Hz, mean velocity removed", corner=corner)
        if corner
        else gettext("PGV, PGD: no high-pass, mean velocity removed"),
    )


def _frequencies_and_durations(answer: RecordMeasures, *, gal: bool) -> Group:
    side = {"both": "|a|", "positive": "a", "negative": "-a"}[answer.conventions.threshold_side]
    level = format_acceleration(answer.components[0].duration.threshold_m_s2 if answer.components else None, gal=gal)
    return table(
        gettext("Equivalent frequency (Hz); duration of {side} above {level}", side=side, level=level),
        ("", "PGA/2πPGV", gettext("Fourier"), gettext("pulse"), gettext("total (s)"), gettext("longest (s)"), gettext("count")),
        [
            (
                m.component,
                format_number(m.equivalent_frequency_hz.pga_pgv),
                format_number(m.equivalent_frequency_hz.fourier),
                format_number(m.equivalent_frequency_hz.pulse_width) + ("?" if m.pulse_width_ambiguous else ""),
                format_seconds(m.duration.total_s),
                format_seconds(m.duration.longest_s),
                str(m.duration.count),
            )
            for m in answer.components
        ],
        caption=gettext(
            "Fourier: Parzen window {width:g} Hz; pulse: the pulse that contains the PGA", width=answer.conventions.fourier_smoothing_hz
        ),
    )


def _sentences(answer: RecordMeasures, *, gal: bool) -> Iterator[str]:
    """Yield sentences on JMA intensity, long-period class and peak horizontal vector."""
    if answer.jma_intensity is None:
        yield gettext("JMA intensity: not available; the warnings state the reason")
    else:
        yield gettext("JMA intensity {value:.2f}, class {name}", value=answer.jma_intensity, name=gettext(answer.jma_class or ""))
    slow = answer.long_period
    if slow is not None:
        v = velocity_unit(gal=gal)
        yield gettext(
            "JMA class of long-period ground motion {name} (absolute velocity response up to {velocity} {unit} at a period of "
            "{period:g} s)",
            name=slow.long_period_class,
            velocity=format_number(slow.floor_velocity_m_s / v.size),
            unit=v.name,
            period=slow.period_s,
        )
    worst = answer.horizontal
    if worst is not None:
        size = format_acceleration(worst.pga_m_s2, gal=gal)
        sentence = gettext("PGA of the horizontal vector {size} at {time:.3f} s", size=size, time=worst.time_s)
        if worst.azimuth_deg is not None:
            sentence += gettext(" towards azimuth {azimuth:.0f}°", azimuth=worst.azimuth_deg)
        yield sentence


def _spectrum_lines(answer: RecordMeasures, *, gal: bool) -> Iterator[str]:
    """Yield RotD50 and RotD100 at the periods of the usual hazard maps."""
    spectrum = answer.spectra
    if spectrum is None:
        return
    size, unit = acceleration_unit(gal=gal)
    median, largest = (
        " / ".join(format_number(float(np.interp(np.log(t), np.log(spectrum.period_s), row)) / size, 3) for t in SHOWN_PERIODS)
        for row in (spectrum.rotd50_m_s2, spectrum.rotd100_m_s2)
    )
    yield gettext(
        "Sa (5 %) at {periods} s: RotD50 {median}, RotD100 {largest} {unit}",
        periods=" / ".join(f"{t:g}" for t in SHOWN_PERIODS),
        median=median,
        largest=largest,
        unit=unit,
    )


def _sensitivity_lines(answer: RecordMeasures, *, gal: bool) -> Iterator[str]:
    """Yield the range of PGV and f for the usual high-pass filters, per component."""
    for m in answer.components:
        if m.usual_highpass is not None:
            yield gettext("{name}: {what}", name=m.component, what=filter_range_text(m.usual_highpass, gal=gal))


def filter_range_text(filter_range: FilterRange, *, gal: bool) -> str:
    """Return the range of PGV and f for the usual high-pass filters."""
    speed, unit = velocity_unit(gal=gal)
    low, high = (format_number(v / speed, 3) for v in filter_range.pgv_m_s)
    slow, fast = (format_number(f, 3) for f in filter_range.pga_pgv_hz)
    return gettext(
        "PGV {low}-{high} {unit}, f {slow}-{fast} Hz for the usual high-pass filters ({corners} Hz, zero-phase or causal)",
        low=low,
        high=high,
        unit=unit,
        slow=slow,
        fast=fast,
        corners=[f"{hz:g}" for hz in filter_range.highpass_hz],
    )


def history_table(records: Sequence[Record], answers: Sequence[RecordMeasures]) -> CsvTable:
    """Return heading and rows of a CSV file: time, then acceleration, velocity and displacement of each component.

    Acceleration is as measured; velocity and displacement stand on the baseline of PGV and PGD. Several records stand one
    below the other with their index in the first column.
    """
    codes = list(dict.fromkeys(m.component for answer in answers for m in answer.components))
    quantities = ("acceleration_m_s2", "velocity_m_s", "displacement_m")
    header = ["time_s", *(f"{code}_{name}" for code in codes for name in quantities)]
    return concat_tables(header, [_history_rows(record, answer, codes) for record, answer in zip(records, answers, strict=True)])


def _history_rows(record: Record, answer: RecordMeasures, codes: Sequence[str]) -> Iterator[Sequence[Any]]:
    """Yield the rows of one record; missing components are empty."""
    present = {m.component for m in answer.components}
    check_memory(N_("samples of time histories"), record.samples, 8 * (1 + 2 * len(present)))
    columns: list[FloatArray | None] = [record.time]
    for code in codes:
        if code not in present:
            columns += [None] * 3
            continue
        a = select_component(record, code).acceleration
        history = velocity_history(a, record.dt, answer.conventions)
        columns += [a, history.velocity, history.displacement]
    for begin in range(0, record.samples, CHUNK_ROWS):
        part = slice(begin, min(begin + CHUNK_ROWS, record.samples))
        empty = [""] * (part.stop - begin)
        yield from zip(*(empty if column is None else normalize_zeros(column[part]) for column in columns), strict=True)
