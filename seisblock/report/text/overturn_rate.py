"""Text report of overturning rates: table per record, effect of dowels, fragility curve columns and CSV."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from seisblock.bodies.cemetery.cemetery import Cemetery
from seisblock.core.i18n import N_, format_percent, gettext
from seisblock.output.io.history_csv import CsvTable, concat_tables
from seisblock.output.text.tables import (
    DASH,
    Part,
    acceleration_cell,
    format_acceleration,
    format_number,
    format_range,
    group_answers,
    styled_line,
    table,
)
from seisblock.output.units_display import acceleration_unit
from seisblock.records import Record
from seisblock.report.text.measure import filter_range_text
from seisblock.report.text.model_comparison import rates_line
from seisblock.report.text.spectrum import thin_indices
from seisblock.report.text.stones import agreement_text
from seisblock.studies.survey.assessment import EITHER_COMPONENT, CemeteryRate
from seisblock.studies.survey.overturning_rate import CurvePoint

CAPTION = N_(
    "Min. H/B: smallest height over width predicted to overturn. {level:g} %: sampling interval of the rate (Clopper-Pearson) only"
)

SHORT_ROWS = 20
"""Most shakings in the shortened table."""

MAX_VERDICTS = 4
"""Most shakings with a sentence each."""

REFERENCE_HZ = 1.0
"""Frequency of the median PGA sentence, Hz; typical of strong motion."""

RATE_COLUMNS = (
    "component",
    "of",
    "pga_m_s2",
    "equivalent_frequency_hz",
    "threshold_ratio",
    "least_overturned_ratio",
    "fallen",
    "stones",
    "rate",
)
"""Columns of ``--csv`` before the interval limits."""

PGA_STEP = 1.0
"""PGA step of the table rows, m/s^2; --json and --csv contain the whole curve."""


def tables(
    cemetery: Cemetery,
    groups: Sequence[tuple[Record | None, Sequence[CemeteryRate]]],
    curve: Sequence[CurvePoint],
    *,
    gal: bool,
    confidence: float,
) -> Iterator[Any]:
    """Yield the rates of each record or PGA value, or the curve if there are none.

    Parameters
    ----------
    cemetery : Cemetery
    groups : sequence of (Record or None, results)
    curve : sequence of CurvePoint
        Shown where there are no results.
    gal : bool
    confidence : float
        Level of the intervals.
    """
    dowelled = int(cemetery.reinforced.sum())
    title = gettext("{name}: {stones} stones", name=cemetery.name, stones=cemetery.size)
    title += gettext(", {stones} reinforced", stones=dowelled) if dowelled else ""
    for heading, ((_, results),) in group_answers(
        groups, lambda group: group[0], lambda group: map(styled_line, verdicts(cemetery.name, group[1], gal=gal))
    ):
        yield from heading
        sentences = map(
            styled_line,
            (*_expected_lines(results), *_filter_lines(results, gal=gal), *_model_lines(results, gal=gal), *_dowel_lines(results)),
        )
        yield from _rates(title, results, list(sentences), gal=gal, confidence=confidence)
    if not groups:
        yield styled_line(median_pga_text(cemetery.name, curve, gal=gal))
        yield _curve_table(title, curve, gal=gal)


def _rates(title: str, results: Sequence[CemeteryRate], sentences: Sequence[Any], *, gal: bool, confidence: float) -> Iterator[Any]:
    """Yield the rates and their sentences; in short evenly spaced rows of many shakings."""
    full = _rate_table(title, results, gal=gal, confidence=confidence)
    if len(results) <= SHORT_ROWS:
        yield from (full, *sentences)
    else:
        short_rows = [results[i] for i in thin_indices(len(results), SHORT_ROWS)]
        yield Part((full, *sentences), (_rate_table(title, short_rows, gal=gal, confidence=confidence),))


def verdicts(cemetery: str, results: Sequence[CemeteryRate], *, gal: bool) -> Iterator[str]:
    """Yield a sentence on the number of overturned stones per shaking, or one for many shakings."""
    # a simulated stone counts if either component overturns it
    objects = [result for result in results if result.component == EITHER_COMPONENT]
    main_results = objects or [result for result in results if not result.of]
    if len(main_results) > MAX_VERDICTS:
        low, high = (f(result.fallen for result in main_results) for f in (min, max))
        text = N_("{cemetery}: {low} to {high} of {stones} stones overturn, depending on the motion.")
        yield gettext(text, cemetery=cemetery, low=low, high=high, stones=main_results[0].stones)
        return
    for result in main_results:
        shaking = _shaking_label(result, gal=gal)
        text = N_("{name}: {fallen} of {stones} stones overturn ({share:.0%}).")
        name = cemetery if objects else result.component or shaking
        yield gettext(text, name=name, fallen=result.fallen, stones=result.stones, share=result.rate)
        if result.contingency is not None:
            yield agreement_text(result.contingency)


def median_pga_text(cemetery: str, curve: Sequence[CurvePoint], *, gal: bool) -> str:
    """Return the PGA at which half of the stones overturn, at the frequency nearest to 1 Hz."""
    frequency = min((point.frequency_hz for point in curve), key=lambda f: abs(math.log(f / REFERENCE_HZ)))
    points = sorted((point for point in curve if point.frequency_hz == frequency), key=lambda point: point.pga_m_s2)
    median_pga = next((point.pga_m_s2 for point in points if point.rate >= 0.5), None)
    pga = format_acceleration(points[-1].pga_m_s2 if median_pga is None else median_pga, gal=gal)
    values = {"cemetery": cemetery, "pga": pga, "f": frequency}
    if median_pga is None:
        return gettext("{cemetery}: less than half of the stones overturn up to {pga} ({f:g} Hz).", **values)
    return gettext("{cemetery}: half of the stones overturn at {pga} ({f:g} Hz).", **values)


def _rate_table(title: str, results: Sequence[CemeteryRate], *, gal: bool, confidence: float) -> Any:
    unit = acceleration_unit(gal=gal).name
    header = ("", f"PGA ({unit})", "f (Hz)", gettext("min. H/B"), gettext("overturned"), gettext("rate"), format_percent(confidence, "g"))
    rows = [
        (
            _row_label(result),
            acceleration_cell(result.pga_m_s2, gal=gal),
            format_number(result.equivalent_frequency_hz, 3),
            _format_ratio(result),
            gettext("{fallen} of {stones}", fallen=result.fallen, stones=result.stones),
            f"{result.rate:.2f}",
            format_range(*(f"{end:.2f}" for end in result.rate_interval)),
        )
        for result in results
    ]
    return table(title, header, rows, caption=gettext(CAPTION, level=100.0 * confidence))


def _row_label(result: CemeteryRate) -> str:
    if result.component == EITHER_COMPONENT:
        return gettext(EITHER_COMPONENT)
    return f"{gettext(result.component or '')} ({result.of})" if result.of else result.component or ""


def _format_ratio(result: CemeteryRate) -> str:
    """Return the smallest overturning H/B: the threshold of the criterion, or that of the least slender overturned stone."""
    value = result.least_overturned_ratio if result.threshold_ratio is None else result.threshold_ratio
    return DASH if value is None else f"{value:.2f}"


def _expected_lines(results: Sequence[CemeteryRate]) -> Iterator[str]:
    """Yield the rate expected from the probabilities of simulated stones under both components."""
    for result in results:
        if result.component == EITHER_COMPONENT and result.mean_probability is not None:
            text = N_("either: stones that one of the components overturns; expected rate {rate:.2f} (mean probability of the stones)")
            yield gettext(text, rate=result.mean_probability)


def _filter_lines(results: Sequence[CemeteryRate], *, gal: bool) -> Iterator[str]:
    """Yield the range of frequency and rate for the usual high-pass filters, per component."""
    for result in results:
        if result.usual_highpass is not None and result.rate_range is not None and not result.of:
            low, high = result.rate_range
            rate = gettext("rate {low:.2f}", low=low) if low == high else gettext("rate {low:.2f} to {high:.2f}", low=low, high=high)
            yield gettext(
                "{name}: {what}; {rate}", name=result.component, what=filter_range_text(result.usual_highpass, gal=gal), rate=rate
            )


def _shaking_label(result: CemeteryRate, *, gal: bool) -> str:
    """Return PGA and equivalent frequency of a shaking."""
    return f"{format_acceleration(result.pga_m_s2, gal=gal)}, {format_number(result.equivalent_frequency_hz, 3)} Hz"


def _model_lines(results: Sequence[CemeteryRate], *, gal: bool) -> Iterator[str]:
    """Yield the rates by model, per shaking; numbers name one of several shakings without a record."""
    plain = [result for result in results if not result.of]
    for result in plain:
        name = result.component or (_shaking_label(result, gal=gal) if len(plain) > 1 else "")
        if text := rates_line(name, result.models):
            yield text


def _dowel_lines(results: Sequence[CemeteryRate]) -> Iterator[str]:
    """Yield the effect of dowels, per shaking."""
    for result in results:
        dowelled = result.reinforced
        if dowelled is None or result.of:
            continue
        label = result.component or f"{format_number(result.equivalent_frequency_hz, 3)} Hz"
        low, high = dowelled.rate_interval
        yield gettext(
            "{where}: with {reinforced} stones reinforced, {fallen} of {stones} overturn ({saved} fewer); rate "
            "{rate:.2f} ({low:.2f}-{high:.2f})",
            where=label,
            reinforced=dowelled.reinforced_stones,
            fallen=dowelled.fallen,
            stones=result.stones,
            saved=dowelled.stones_saved,
            rate=dowelled.rate,
            low=low,
            high=high,
        )


def _curve_table(title: str, curve: Sequence[CurvePoint], *, gal: bool) -> Any:
    """Return the table of rate against PGA, a column per frequency."""
    frequencies = list(dict.fromkeys(point.frequency_hz for point in curve))
    rate = {(point.pga_m_s2, point.frequency_hz): point.rate for point in curve}
    levels = [pga for pga in dict.fromkeys(point.pga_m_s2 for point in curve) if abs(pga / PGA_STEP - round(pga / PGA_STEP)) < 1e-9]
    rows = [(acceleration_cell(pga, gal=gal), *(f"{rate[pga, f]:.2f}" for f in frequencies)) for pga in levels]
    return table(
        title, (f"PGA ({acceleration_unit(gal=gal).name})", *(f"{f:g} Hz" for f in frequencies)), rows, caption=gettext("overturning rate")
    )


def curve_csv(curve: Sequence[CurvePoint], reinforced: Sequence[CurvePoint] | None) -> tuple[list[str], list[list[float]]]:
    """Return header and rows of ``--csv`` of the curve: PGA (m/s^2), frequency (Hz), rates without and with dowels."""
    header = ["pga_m_s2", "frequency_hz", "rate"] + (["rate_reinforced"] if reinforced else [])
    rows = [[p.pga_m_s2, p.frequency_hz, p.rate] for p in curve]
    if reinforced:
        rows = [[*row, point.rate] for row, point in zip(rows, reinforced, strict=True)]
    return header, rows


def rate_csv(groups: Sequence[tuple[Record | None, Sequence[CemeteryRate]]]) -> CsvTable:
    """Return header and rows of ``--csv`` of given shakings: one row each, SI, with the effect of dowels."""
    header = [*RATE_COLUMNS, "rate_low", "rate_high"]
    has_reinforced = any(result.reinforced is not None for _, results in groups for result in results)
    header += [f"{name}_reinforced" for name in ("fallen", "rate", "rate_low", "rate_high")] if has_reinforced else []
    return concat_tables(header, [map(_csv_row, results) for _, results in groups])


def _csv_row(result: CemeteryRate) -> list[Any]:
    dowelled = result.reinforced
    row = [getattr(result, name) for name in RATE_COLUMNS] + [*result.rate_interval]
    return row if dowelled is None else [*row, dowelled.fallen, dowelled.rate, *dowelled.rate_interval]
