"""Text report of a block under the peaks of a motion: probability under the suite, and the closed forms."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from seisblock.core.i18n import format_share, gettext
from seisblock.criteria.compare import ACCELERATION
from seisblock.output.io.history_csv import CsvTable
from seisblock.output.text.tables import format_number, format_share_interval, styled_line, table
from seisblock.output.units_display import acceleration_unit, velocity_unit
from seisblock.report.text.criteria import format_ratio, formula_text
from seisblock.studies.scenario.peaks import PeakAssessment


def peaks_text(result: PeakAssessment, *, gal: bool) -> str:
    """Return PGA, PGV and equivalent frequency."""
    shaking, speed = acceleration_unit(gal=gal), velocity_unit(gal=gal)
    return gettext(
        "PGA {pga}, PGV {pgv}, equivalent frequency {frequency:.3g} Hz",
        pga=f"{result.pga_m_s2 / shaking.size:.4g} {shaking.name}",
        pgv=f"{result.pgv_m_s / speed.size:.4g} {speed.name}",
        frequency=result.frequency_hz,
    )


def tables(result: PeakAssessment, *, gal: bool) -> Iterator[Any]:
    """Yield the probability under the suite where it was computed, the number of criteria exceeded, and the table of criteria."""
    if result.suite is not None:
        suite = result.suite
        text = gettext(
            "Overturning probability {share} (95 % CI {interval}, {runs} runs under {records} records; model error not included)",
            share=format_share(suite.overturning_probability),
            interval=format_share_interval(suite.interval),
            runs=suite.runs,
            records=suite.records,
        )
        yield styled_line(text, "bold")
    exceeded = sum(row.overturns for row in result.rows)
    summary = gettext("{count} of {all} closed forms predict overturning", count=exceeded, all=len(result.rows))
    yield styled_line(summary, "" if result.suite else "bold")
    yield styled_line(peaks_text(result, gal=gal))
    rows = []
    for row in result.rows:
        unit = acceleration_unit(gal=gal) if row.unit == ACCELERATION else velocity_unit(gal=gal)
        ratio = f"{format_ratio(row)} {gettext('yes') if row.overturns else gettext('no')}"
        rows.append([gettext(row.criterion), formula_text(row), f"{format_number(row.threshold / unit.size)} {unit.name}", ratio])
    caption = gettext("ratio: demand over threshold; yes: overturning predicted")
    yield table("", [gettext("criterion"), gettext("formula"), gettext("threshold"), gettext("ratio")], rows, caption=caption)


def csv_columns(result: PeakAssessment) -> CsvTable:
    """Return all criteria, SI."""
    header = ["criterion", "where", "unit", "frequency_hz", "threshold", "demand", "overturns"]
    return header, ([getattr(row, name) for name in header] for row in result.rows)
