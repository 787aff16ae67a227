"""Text report of a rocking spectrum: thinned table, and CSV of all points."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Any

import numpy as np

from seisblock.core.i18n import N_, format_share, gettext
from seisblock.core.typing import IntArray
from seisblock.output.io.history_csv import CsvTable, table_by_record
from seisblock.output.text.tables import DASH, Part, group_answers, styled_line, table
from seisblock.records import Motion
from seisblock.studies.rocking.spectrum import RockingSpectrum

Spectra = Sequence[tuple[Motion, RockingSpectrum]]


MAX_ROWS, MAX_COLUMNS = 12, 9
"""Most rows and columns of the table; --csv and --json contain all."""

SHORT_ROWS = 14
"""Most rows of all tables of a shortened answer together."""


def tables(spectra: Spectra, kind: str, wear_text: str = "") -> Iterator[Any]:
    """Yield, per component, a table of at most 12 sizes and 9 slendernesses; `wear_text` describes the edge wear."""
    for heading, part in group_answers(spectra, lambda pair: pair[0].record, lambda pair: [styled_line(verdict(*pair))]):
        yield from heading
        for pair in part:
            yield from shorten(pair[1].size_m.size, MAX_ROWS, len(spectra), partial(_spectrum_table, *pair, kind, wear_text))


def shorten(count: int, max_rows: int, tables: int, blocks: Callable[[int], Iterator[Any]]) -> Iterator[Any]:
    """Yield a table of at most `max_rows`, and its shortened form where that has fewer rows.

    Parameters
    ----------
    count : int
        Rows available.
    max_rows : int
        Most rows of the table in full.
    tables : int
        Tables that share the rows of the shortened answer.
    blocks : callable
        Returns title, table and notes for a largest number of rows.
    """
    short_rows = rows_per_table(tables)
    if min(count, max_rows) <= short_rows:
        yield from blocks(max_rows)
    else:
        yield Part(tuple(blocks(max_rows)), tuple(blocks(short_rows)))


def rows_per_table(tables: int) -> int:
    """Return the most rows of each of several tables in a shortened answer."""
    return max(SHORT_ROWS // tables, 2)


def verdict(motion: Motion, spectrum: RockingSpectrum) -> str:
    """Return the number of overturned blocks."""
    falls, block_count = int(spectrum.overturned.sum()), spectrum.overturned.size
    if spectrum.azimuths_deg is not None and spectrum.overturning_rate is not None:
        always_count = int((spectrum.overturning_rate == 1.0).sum())
        text = N_("{falls} of {all} blocks overturn in at least one of {count} azimuths, {always} in all of them.")
        return gettext(text, falls=falls, all=block_count, count=spectrum.azimuths_deg.size, always=always_count)
    return gettext("{name}: {falls} of {all} blocks overturn.", name=motion.name, falls=falls, all=block_count)


def _spectrum_table(motion: Motion, spectrum: RockingSpectrum, kind: str, wear_text: str, max_rows: int) -> Iterator[Any]:
    rows, columns = thin_indices(spectrum.size_m.size, max_rows), thin_indices(spectrum.slenderness_rad.size, MAX_COLUMNS)
    quantity = gettext("overturning") if kind == "overturning" else gettext("peak tilt over alpha (#: overturns)")
    if spectrum.overturning_rate is not None:
        quantity = (
            gettext("share of azimuths with overturning")
            if kind == "overturning"
            else gettext("peak tilt over alpha in the worst azimuth (#: overturns)")
        )
    header = [f"{1 / math.tan(spectrum.slenderness_rad[j]):.2f}" for j in columns]
    cells = [[f"{spectrum.size_m[i]:.3g}", *(_cell(spectrum, i, j, kind) for j in columns)] for i in rows]
    title = gettext("{name}: {what}; 2R (m, rows) against H/B (columns)", name=motion.name, what=quantity) + gettext(wear_text)
    yield table(title, ["2R \\ H/B", *header], cells)
    if rows.size < spectrum.size_m.size or columns.size < spectrum.slenderness_rad.size:
        counts = {"rows": rows.size, "sizes": spectrum.size_m.size, "columns": columns.size, "shapes": spectrum.slenderness_rad.size}
        yield styled_line(gettext("shown: {rows} of {sizes} 2R, {columns} of {shapes} H/B; all in --csv and --json", **counts), "dim")
    yield styled_line()


def _cell(spectrum: RockingSpectrum, i: int, j: int, kind: str) -> str:
    if kind == "overturning":
        if not spectrum.overturned[i, j]:
            return DASH
        return gettext("yes") if spectrum.overturning_rate is None else format_share(spectrum.overturning_rate[i, j])
    if spectrum.overturned[i, j]:
        return "#"
    ratio = spectrum.max_rotation_ratio[i, j]
    return DASH if ratio == 0.0 else f"{ratio:.3f}"


def thin_indices(count: int, max_count: int) -> IntArray:
    """Return at most `max_count` evenly spaced indices including the ends."""
    return np.unique(np.linspace(0, count - 1, min(count, max_count)).round().astype(np.int64))


def csv_columns(spectra: Spectra) -> CsvTable:
    """Return a row for every block, SI; with share and worst azimuth for azimuth sweeps, with the index for several records."""
    has_azimuths = any(spectrum.azimuths_deg is not None for _, spectrum in spectra)
    header = [
        "component",
        "size_m",
        "frequency_parameter_rad_s",
        "slenderness_rad",
        "height_over_width",
        "max_rotation_ratio",
        "overturned",
        *(["overturning_rate", "worst_azimuth_deg"] if has_azimuths else []),
    ]
    return table_by_record(header, spectra, lambda pair: pair[0].record, lambda pair: _rows(*pair))


def _rows(motion: Motion, spectrum: RockingSpectrum) -> Iterator[list[Any]]:
    for i, size in enumerate(spectrum.size_m):
        for j, alpha in enumerate(spectrum.slenderness_rad):
            yield [
                motion.name,
                float(size),
                float(spectrum.frequency_parameter_rad_s[i]),
                float(alpha),
                1 / math.tan(alpha),
                float(spectrum.max_rotation_ratio[i, j]),
                bool(spectrum.overturned[i, j]),
                *(float(array[i, j]) for array in (spectrum.overturning_rate, spectrum.worst_azimuth_deg) if array is not None),
            ]
