"""Text report of a sliding spectrum: maximum displacement against friction, and CSV."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any

from seisblock.core.i18n import N_, gettext
from seisblock.output.io.history_csv import CsvTable, table_by_record
from seisblock.output.text.tables import group_answers, styled_line, table
from seisblock.output.units_display import format_length, length_cell, length_unit
from seisblock.records import Motion
from seisblock.report.text.spectrum import shorten, thin_indices
from seisblock.studies.sliding import SlidePoint

Curves = Sequence[tuple[Motion, Sequence[SlidePoint]]]


MAX_ROWS = 25


def tables(curves: Curves) -> Iterator[Any]:
    """Yield, per component, a table of at most 25 frictions."""
    for heading, part in group_answers(
        curves, lambda pair: pair[0].record, lambda pair: [styled_line(verdict(pair[0].name or "x", pair[1]))]
    ):
        yield from heading
        for pair in part:
            yield from shorten(len(pair[1]), MAX_ROWS, len(curves), partial(_slip_table, *pair))


def _slip_table(motion: Motion, points: Sequence[SlidePoint], max_rows: int) -> Iterator[Any]:
    indices = thin_indices(len(points), max_rows)
    unit = length_unit((point.max_slip_m for point in points), gal=True)
    rows = [[f"{points[i].mu:.4g}", length_cell(points[i].max_slip_m, unit), length_cell(points[i].residual_slip_m, unit)] for i in indices]
    title = gettext("{name}: sliding against friction", name=motion.name)
    yield table(
        title, ["μ", gettext("max. displacement ({unit})", unit=unit.name), gettext("residual slip ({unit})", unit=unit.name)], rows
    )
    yield styled_line()


def verdict(name: str, points: Sequence[SlidePoint]) -> str:
    """Return the friction without sliding, and the largest displacement below it."""
    by_friction = sorted(points, key=lambda point: point.mu)
    largest = max(by_friction, key=lambda point: point.max_slip_m or 0.0)
    slides = [point.mu for point in by_friction if point.slips]
    if not slides:
        return gettext("{name}: remains at rest for friction of {mu:.4g} and above.", name=name, mu=by_friction[0].mu)
    holds = next((point.mu for point in by_friction if point.mu > slides[-1]), None)
    values = {"name": name, "most": format_length(largest.max_slip_m or 0.0), "at": largest.mu}
    if holds is None:
        return gettext("{name}: slides for friction up to {mu:.4g}, at most {most} (at {at:.4g}).", mu=slides[-1], **values)
    return gettext(
        N_("{name}: remains at rest for friction of {mu:.4g} and above; slides below, at most {most} (at {at:.4g})."), mu=holds, **values
    )


def csv_columns(curves: Curves) -> CsvTable:
    """Return a row for every point, SI; with the record index for several records."""
    header = ["component", "mu", "max_slip_m", "residual_slip_m"]
    return table_by_record(
        header,
        curves,
        lambda pair: pair[0].record,
        lambda pair: ([pair[0].name, p.mu, p.max_slip_m, p.residual_slip_m] for p in pair[1]),
    )
