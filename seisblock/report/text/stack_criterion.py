"""Text report of the gravestone criterion study: thresholds and levels beside the published fits."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from seisblock.core.i18n import gettext
from seisblock.criteria.gravestones import GravestoneFit, furukawa_fit, overturning_level, overturning_ratio
from seisblock.output.io.history_csv import CsvTable
from seisblock.output.text.tables import acceleration_cell, format_acceleration, format_number, styled_line, table
from seisblock.output.units_display import acceleration_unit
from seisblock.studies.gravestone_criterion import CriterionStudy, Threshold, study_frequencies

ScaledRecords = dict[str, tuple[Threshold, ...]]
"""Thresholds of scaled records by record name."""


def tables(
    study: CriterionStudy, rigid: dict[float, float], scaled_records: ScaledRecords, *, reinforced: bool, gal: bool = True
) -> Iterator[Any]:
    """Yield the fit, the thresholds and the levels."""
    fit, equation = furukawa_fit(reinforced)
    unit = acceleration_unit(gal=gal).name
    yield styled_line(_fit_sentence(study, fit, equation, gal=gal))
    frequencies = study_frequencies(study)
    ratios = {(t.frequency_hz, t.pga_m_s2): t.ratio for t in study.thresholds}
    pgas = sorted({t.pga_m_s2 for t in study.thresholds})
    rows = ([acceleration_cell(a, gal=gal), *(format_number(ratios.get((f, a)), 4) for f in frequencies)] for a in pgas)
    yield table(gettext("smallest H/B of the top stone that overturns"), [f"PGA ({unit})", *(f"{f:g} Hz" for f in frequencies)], rows)
    for name, thresholds in scaled_records.items():
        title = gettext("{name}, scaled; equivalent frequency {f:.2f} Hz", name=name, f=thresholds[0].frequency_hz)
        pairs = ((t, float(overturning_ratio(t.pga_m_s2, t.frequency_hz, fit))) for t in thresholds)
        lines = ([acceleration_cell(t.pga_m_s2, gal=gal), format_number(t.ratio, 4), format_number(ratio, 4)] for t, ratio in pairs)
        yield table(title, [f"PGA ({unit})", gettext("H/B overturning"), gettext("published, eq. {equation}", equation=equation)], lines)
    level_rows = ((f, (study.levels.get(f), rigid.get(f), float(overturning_level(f, fit)))) for f in frequencies)
    levels = ([f"{f:g}", *(acceleration_cell(a, gal=gal) for a in row)] for f, row in level_rows)
    header = [
        "f (Hz)",
        gettext("pile, eq. (7)"),
        gettext("rigid block on the outermost points"),
        gettext("published, eq. {equation}", equation=equation),
    ]
    yield table(f"a(f) = PGA H/B ({unit})", header, levels)


def _fit_sentence(study: CriterionStudy, fit: GravestoneFit, equation: str, *, gal: bool) -> str:
    if study.fit is None:
        return gettext("Eq. (8) not fitted: too few frequencies with overturning.")
    own_fit, published_fit = (f"p = {format_acceleration(f.p_m_s2, gal=gal)}, q = {f.q_hz:.2f} Hz, r = {f.r:.2f}" for f in (study.fit, fit))
    return gettext(
        "Least-squares fit of eq. (8): {ours}; published {equation}: {others}.", ours=own_fit, equation=equation, others=published_fit
    )


def csv_columns(study: CriterionStudy, scaled_records: ScaledRecords) -> CsvTable:
    """Return the thresholds, SI; with scaled records the first column is the motion."""
    header = ["frequency_hz", "pga_m_s2", "height_over_width", "fallen"]
    if not scaled_records:
        return header, map(_csv_row, study.thresholds)
    groups = {"sine": study.thresholds, **scaled_records}
    return ["motion", *header], ([name, *_csv_row(threshold)] for name, thresholds in groups.items() for threshold in thresholds)


def _csv_row(threshold: Threshold) -> list[str | float]:
    return [threshold.frequency_hz, threshold.pga_m_s2, "" if threshold.ratio is None else threshold.ratio, " ".join(threshold.fallen)]
