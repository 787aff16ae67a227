"""What the measures of a record look like: two tables and a sentence, and the histories as columns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from rich.console import Group
from rich.text import Text

from seisblock.limits import check_curves
from seisblock.measures import FilterRange, RecordMeasures, ground_history
from seisblock.present.files import plain
from seisblock.present.histories import BLOCK, of_records
from seisblock.present.scales import acceleration_unit, length_unit, velocity_unit
from seisblock.present.text.tables import acceleration, answered, line, number, seconds, table, told_acceleration
from seisblock.records import Record
from seisblock.records.process import pick
from seisblock.typing import FloatArray
from seisblock.words import tell


def tables(records: Sequence[Record], answers: Sequence[RecordMeasures], *, gal: bool) -> Iterator[Group | Text]:
    """Yield what is printed for each record: how strong it is, which it is, its peaks, its frequencies and durations, its intensity.

    Parameters
    ----------
    records, answers : sequences of Record and RecordMeasures
    gal : bool
        Accelerations in gal and velocities in kine, else SI.
    """
    both = zip(records, answers, strict=True)
    for opening, ((_, answer),) in answered(both, lambda each: each[0], lambda each: [line("\n".join(_sentences(each[1], gal=gal)))]):
        yield from opening
        yield _peaks(answer, gal=gal)
        yield _frequencies_and_durations(answer, gal=gal)
        yield line("\n".join(_remarks(answer, gal=gal)))


def _peaks(answer: RecordMeasures, *, gal: bool) -> Group:
    """Return the table of peaks and energies."""
    a, v = acceleration_unit(gal=gal), velocity_unit(gal=gal)
    d = length_unit((m.pgd_m for m in answer.components), gal=gal)
    corner = answer.conventions.velocity_highpass_hz
    return table(
        tell("Peaks and energy"),
        ("", f"PGA ({a.name})", tell("at (s)"), f"PGV ({v.name})", f"PGD ({d.name})", tell("Arias (m/s)"), "5-95 % (s)"),
        [
            (
                m.component,
                acceleration(m.pga_m_s2, gal=gal),
                seconds(m.time_of_pga_s),
                number(m.pgv_m_s / v.size),
                number(m.pgd_m / d.size),
                number(m.arias_m_s),
                seconds(m.significant_duration_s),
            )
            for m in answer.components
        ],
        caption=tell("PGV, PGD: high-pass {corner:g} Hz, mean velocity removed", corner=corner)
        if corner
        else tell("PGV, PGD: no high-pass, mean velocity removed"),
    )


def _frequencies_and_durations(answer: RecordMeasures, *, gal: bool) -> Group:
    """Return the table of equivalent frequencies and of durations above the threshold."""
    side = {"both": "|a|", "positive": "a", "negative": "-a"}[answer.conventions.threshold_side]
    level = told_acceleration(answer.components[0].duration.threshold_m_s2 if answer.components else None, gal=gal)
    return table(
        tell("Equivalent frequency (Hz), and time with {side} above {level}", side=side, level=level),
        ("", "PGA/2πPGV", "Fourier", tell("pulse"), tell("total (s)"), tell("longest (s)"), tell("times")),
        [
            (
                m.component,
                number(m.equivalent_frequency_hz.pga_pgv),
                number(m.equivalent_frequency_hz.fourier),
                number(m.equivalent_frequency_hz.pulse_width) + ("?" if m.pulse_width_ambiguous else ""),
                seconds(m.duration.total_s),
                seconds(m.duration.longest_s),
                str(m.duration.count),
            )
            for m in answer.components
        ],
        caption=tell("Fourier: Parzen window {width:g} Hz; pulse: the one with the PGA", width=answer.conventions.fourier_smoothing_hz),
    )


def _sentences(answer: RecordMeasures, *, gal: bool) -> Iterator[str]:
    """Yield the intensity and the worst direction in words."""
    if answer.jma_intensity is None:
        yield tell("JMA intensity: none (it needs two horizontals and the vertical)")
    else:
        yield tell("JMA intensity {value:.2f}, class {name}", value=answer.jma_intensity, name=tell(answer.jma_class or ""))
    slow = answer.long_period
    if slow is not None:
        v = velocity_unit(gal=gal)
        yield tell(
            "JMA class of long-period motion {name}: floors of tall buildings at up to {velocity} {unit} (period {period:g} s)",
            name=slow.long_period_class,
            velocity=number(slow.floor_velocity_m_s / v.size),
            unit=v.name,
            period=slow.period_s,
        )
    worst = answer.horizontal
    if worst is not None:
        size = told_acceleration(worst.pga_m_s2, gal=gal)
        told = tell("Largest horizontal vector {size} at {time:.3f} s", size=size, time=worst.time_s)
        if worst.azimuth_deg is not None:
            told += tell(" towards {azimuth:.0f}° (clockwise from north)", azimuth=worst.azimuth_deg)
        yield told


def _remarks(answer: RecordMeasures, *, gal: bool) -> Iterator[str]:
    """Yield how far the numbers move with what one might have chosen otherwise."""
    for m in answer.components:
        if m.usual_highpass is not None:
            yield tell("{name}: {what}", name=m.component, what=usual_filters(m.usual_highpass, gal=gal))


def usual_filters(found: FilterRange, *, gal: bool) -> str:
    """Return how far PGV and f move with the usual filters, in words."""
    speed, unit = velocity_unit(gal=gal)
    low, high = (number(v / speed, 3) for v in found.pgv_m_s)
    slow, fast = (number(f, 3) for f in found.pga_pgv_hz)
    return tell(
        "PGV {low} to {high} {unit} and f {slow} to {fast} Hz with the usual high-passes ({corners} Hz, with or without delay)",
        low=low,
        high=high,
        unit=unit,
        slow=slow,
        fast=fast,
        corners=[f"{hz:g}" for hz in found.highpass_hz],
    )


def history_table(records: Sequence[Record], answers: Sequence[RecordMeasures]) -> tuple[list[str], Iterator[list[Any]]]:
    """Return the heading and the rows of a CSV file: time, then acceleration, velocity and displacement of each component.

    Acceleration is as measured; velocity and displacement stand on the baseline of PGV and PGD. Several records stand one
    below the other with their index in the first column.
    """
    codes = list(dict.fromkeys(m.component for answer in answers for m in answer.components))
    quantities = ("acceleration_m_s2", "velocity_m_s", "displacement_m")
    header = ["time_s", *(f"{code}_{name}" for code in codes for name in quantities)]
    return of_records(header, [_history_rows(record, answer, codes) for record, answer in zip(records, answers, strict=True)])


def _history_rows(record: Record, answer: RecordMeasures, codes: Sequence[str]) -> Iterator[Sequence[Any]]:
    """Yield the rows of one record; a component that it lacks stays empty."""
    present = {m.component for m in answer.components}
    check_curves(record.samples, 1 + 2 * len(present))
    columns: list[FloatArray | None] = [record.time]
    for code in codes:
        if code not in present:
            columns += [None] * 3
            continue
        a = pick(record, code).acceleration
        history = ground_history(a, record.dt, highpass_hz=answer.conventions.velocity_highpass_hz)
        columns += [a, history.velocity, history.displacement]
    for begin in range(0, record.samples, BLOCK):
        part = slice(begin, min(begin + BLOCK, record.samples))
        empty = [""] * (part.stop - begin)
        yield from zip(*(empty if column is None else plain(column[part]) for column in columns), strict=True)
