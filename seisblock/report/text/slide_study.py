"""Text report of a sliding parameter study: pivot tables."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from rich.text import Text

from seisblock.core.i18n import N_, gettext
from seisblock.output.io.history_csv import CsvTable, concat_tables
from seisblock.output.text.tables import DASH, details, group_answers, styled_line, table
from seisblock.output.units_display import Unit, format_length, length_cell, length_unit
from seisblock.records import Record
from seisblock.report.json.slide import SLIDE_POINT, point_entry
from seisblock.report.text.spectrum import shorten
from seisblock.studies.sliding import SlidePoint

Points = Sequence[SlidePoint]
Panels = list[tuple[str, Points]]
Cell = Callable[[SlidePoint], str]


SYMBOLS = {"mu": "μ", "kappa": "κ", "mu_kinetic": N_("μ kinetic"), "slope_deg": N_("slope θ (deg)"), "vertical": "γ"}


MAX_ROWS, MAX_COLUMNS = 60, 8
MIN_PLANE_SIZE = 8
"""Fewest values of slope and of friction for a contour plot as in fig. 16."""


@dataclass(frozen=True)
class Arrangement:
    """Assignment of the study parameters to the x axis and to curves."""

    x: str
    curves: tuple[str, ...]

    @classmethod
    def of(cls, points: Points) -> Arrangement:
        """Put the parameter with most values on x; among equals the one on x in the figures of the paper."""
        kinetic = "kappa" if len({p.kappa for p in points}) <= len({p.mu_kinetic for p in points}) else "mu_kinetic"
        counts = {name: len({getattr(p, name) for p in points}) for name in ("mu", "slope_deg", "vertical", kinetic)}
        x = max(counts, key=lambda name: counts[name])
        return cls(x, tuple(name for name, count in counts.items() if name != x and count > 1))

    def name(self, point: SlidePoint) -> str:
        """Return the name of the curve of a point."""
        return ", ".join(f"{gettext(SYMBOLS[key]).split(' (')[0]} {getattr(point, key):g}" for key in self.curves)


def azimuth_table(sweep: Points, *, gal: bool = True) -> Iterator[Any]:
    """Yield the table of all azimuths of a sweep."""
    if sweep:
        yield styled_line()
        unit = length_unit((point.max_slip_m for point in sweep), gal=gal)
        rows = [[point.component, length_cell(point.max_slip_m, unit), length_cell(point.residual_slip_m, unit)] for point in sweep]
        headings = N_("azimuth (deg)"), N_("max ({unit})"), N_("residual ({unit})")
        yield details(table(gettext("All azimuths"), [gettext(heading, unit=unit.name) for heading in headings], rows))


def study_csv(records: Sequence[Record], studies: Sequence[Points]) -> CsvTable:
    """Return heading and rows of a CSV file: one row per point with every key."""
    header = [key for key in SLIDE_POINT.__struct_fields__ if key != "record_index"]
    return concat_tables(header, [[[getattr(entry, key) for key in header] for entry in map(point_entry, points)] for points in studies])


def tables(records: Sequence[Record], studies: Sequence[Points], *, gal: bool = True) -> Iterator[Any]:
    """Yield, per record and direction, maximum displacement and, with vertical motion, the ratio beta as in [Fujino1978]_ fig. 9."""
    arranged = [
        (record, arrangement, group_by_direction(points, arrangement))
        for record, points, arrangement in zip(records, studies, map(Arrangement.of, studies), strict=True)
    ]
    for preamble, ((_, arrangement, panels),) in group_answers(
        arranged, lambda entry: entry[0], lambda entry: _verdicts(entry[2], gal=gal)
    ):
        yield from preamble
        pivots = [pivot for title, part in panels for pivot in _pivots(title, part, arrangement, gal=gal)]
        for title, part, cell in pivots:
            count = len({getattr(point, arrangement.x) for point in part})
            yield from shorten(count, MAX_ROWS, len(pivots), partial(_pivot_table, title, part, arrangement, cell))


def _pivots(title: str, points: Points, arrangement: Arrangement, *, gal: bool) -> Iterator[tuple[str, Points, Cell]]:
    """Yield heading, points and cell of the tables of one direction."""
    unit = length_unit((point.max_slip_m for point in points), gal=gal)
    yield gettext("{name}: maximum displacement ({unit})", name=title, unit=unit.name), points, partial(_format_slip, unit=unit)
    if any(point.beta is not None for point in points):
        yield gettext("{name}: beta, ratio of the maximum displacements with and without vertical motion", name=title), points, _format_beta


def _format_slip(point: SlidePoint, unit: Unit) -> str:
    return length_cell(point.max_slip_m, unit)


def _format_beta(point: SlidePoint) -> str:
    return DASH if point.beta is None else f"{point.beta:.3f}"


def _verdicts(panels: Panels, *, gal: bool) -> Iterator[Text]:
    for title, part in panels:
        yield styled_line(verdict(title, part, gal=gal))


def verdict(name: str, points: Points, *, gal: bool = True) -> str:
    """Return the maximum displacement with its parameters, and the number of combinations at rest."""
    solved = [point for point in points if point.max_slip_m is not None]
    rest_count = sum(point.max_slip_m == 0.0 for point in solved)
    if rest_count == len(solved):
        return gettext("{name}: remains at rest in all {count} combinations.", name=name, count=rest_count)
    largest = max(solved, key=lambda point: point.max_slip_m or 0.0)
    parameters = [key for key in SYMBOLS if len({getattr(point, key) for point in points}) > 1]
    # kappa and the kinetic coefficient are redundant
    parameters = [key for key in parameters if key != "mu_kinetic" or "kappa" not in parameters]
    setting = [f"{gettext(SYMBOLS[key]).split(' (')[0]} {getattr(largest, key):g}" for key in parameters]
    text = N_("{name}: slides up to {most} at {where}; {held} of {count} combinations remain at rest.")
    return gettext(
        text, name=name, most=format_length(largest.max_slip_m or 0.0, gal=gal), where=setting, held=rest_count, count=len(solved)
    )


def group_by_direction(points: Points, arrangement: Arrangement) -> Panels:
    """Return the points by direction; the worst directions of a sweep form one group."""
    names = list(dict.fromkeys(point.component for point in points))
    per_direction = len({tuple(getattr(p, key) for key in (arrangement.x, *arrangement.curves)) for p in points})
    if len(points) == per_direction and len(names) > 1:
        return [(gettext("worst azimuth"), points)]
    return [(name, [point for point in points if point.component == name]) for name in names]


def _pivot_table(title: str, points: Points, arrangement: Arrangement, cell: Cell, max_rows: int) -> Iterator[Any]:
    """Yield one table: rows are x values, columns are curves; large tables are thinned."""
    xs = list(dict.fromkeys(getattr(point, arrangement.x) for point in points))
    names = list(dict.fromkeys(arrangement.name(point) for point in points))
    values = {(getattr(point, arrangement.x), arrangement.name(point)): cell(point) for point in points}
    rows, columns = _thin_values(xs, max_rows), _thin_values(names, MAX_COLUMNS)
    left_out = len(rows) < len(xs) or len(columns) < len(names)
    yield table(
        title,
        (gettext(SYMBOLS[arrangement.x]), *(name or gettext("slip") for name in columns)),
        [[f"{x:g}", *(values.get((x, name), DASH) for name in columns)] for x in rows],
        caption=gettext(
            "{rows} of {all_rows} rows, {columns} of {all_columns} columns; all in --csv and --json",
            rows=len(rows),
            all_rows=len(xs),
            columns=len(columns),
            all_columns=len(names),
        )
        if left_out
        else "",
    )


def _thin_values(values: Sequence[Any], max_count: int) -> list[Any]:
    """Return at most `max_count` evenly spaced values including the ends."""
    if len(values) <= max_count:
        return list(values)
    return [values[index] for index in np.unique(np.linspace(0, len(values) - 1, max_count).round().astype(int))]


def plotted_value(point: SlidePoint, ratio: bool) -> float:
    """Return the plotted quantity of a point."""
    value = point.beta if ratio else point.max_slip_m
    return np.nan if value is None else value
