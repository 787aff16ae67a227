"""How a rocking spectrum is told: a thinned table, and all points as CSV."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from seisblock.present.histories import write_by_record
from seisblock.present.text.tables import answered, line, table
from seisblock.records import Motion
from seisblock.studies.rocking.spectra import RockingSpectrum
from seisblock.typing import IntArray
from seisblock.words import noted, roughly, tell

Spectra = Sequence[tuple[Motion, RockingSpectrum]]


MOST_ROWS, MOST_COLUMNS = 12, 9
FALLS = noted("falls")


def tables(spectra: Spectra, kind: str, worn: str = "") -> Iterator[Any]:
    """Yield, per component, a table of at most 12 sizes and 9 slendernesses, and the share that falls; `worn` tells of the edges."""
    for opening, part in answered(spectra, lambda each: each[0].record, lambda each: [line(verdict(*each))]):
        yield from opening
        yield from (shown for each in part for shown in _shares(*each, kind, worn))


def verdict(motion: Motion, found: RockingSpectrum) -> str:
    """Return how many of the blocks overturn."""
    falls, every = int(found.overturned.sum()), found.overturned.size
    if found.azimuths_deg is not None and found.overturning_rate is not None:
        always = int((found.overturning_rate == 1.0).sum())
        text = noted("{falls} of {all} blocks overturn in one of {count} directions at least, {always} in all of them.")
        return tell(text, falls=falls, all=every, count=found.azimuths_deg.size, always=always)
    return tell("{name}: {falls} of {all} blocks overturn.", name=motion.name, falls=falls, all=every)


def _shares(motion: Motion, found: RockingSpectrum, kind: str, worn: str) -> Iterator[Any]:
    """Yield the table of one component."""
    rows, columns = thinned(found.size_m.size, MOST_ROWS), thinned(found.slenderness_rad.size, MOST_COLUMNS)
    what = tell("overturning") if kind == "overturning" else tell("largest lean over alpha")
    if found.overturning_rate is not None:
        what = tell("directions in which it falls") if kind == "overturning" else tell("largest lean over alpha, worst direction")
    heads = [f"{1 / math.tan(found.slenderness_rad[j]):.2f}" for j in columns]
    cells = [[f"{found.size_m[i]:.3g}", *(_cell(found, i, j, kind) for j in columns)] for i in rows]
    title = tell("{name}: {what}; down 2R (m), across H/B", name=motion.name, what=what) + tell(worn)
    yield table(title, ["2R \\ H/B", *heads], cells)
    if rows.size < found.size_m.size or columns.size < found.slenderness_rad.size:
        shown = {"rows": rows.size, "sizes": found.size_m.size, "columns": columns.size, "shapes": found.slenderness_rad.size}
        yield line(tell("shown: {rows} of {sizes} 2R, {columns} of {shapes} H/B; --csv and --json have all", **shown), "dim")
    yield line()


def _cell(found: RockingSpectrum, i: int, j: int, kind: str) -> str:
    """Return one cell of the table."""
    if found.overturned[i, j] and kind == "overturning" and found.overturning_rate is not None and found.overturning_rate[i, j] < 1.0:
        return roughly(found.overturning_rate[i, j])
    if found.overturned[i, j]:
        return tell(FALLS)
    ratio = found.max_rotation_ratio[i, j]
    return "-" if ratio == 0.0 or kind == "overturning" else f"{ratio:.3f}"


def thinned(count: int, most: int) -> IntArray:
    """Return at most so many indices, evenly, with both ends."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(np.int64))


def write(path: Path, spectra: Spectra) -> None:
    """Write every block as a row of CSV, SI: of all directions with share and worst direction, of several records with their index."""
    around = any(found.azimuths_deg is not None for _, found in spectra)
    header = [
        "component",
        "size_m",
        "frequency_parameter_rad_s",
        "slenderness_rad",
        "height_over_width",
        "max_rotation_ratio",
        "overturned",
        *(["overturning_rate", "worst_azimuth_deg"] if around else []),
    ]
    write_by_record(path, header, spectra, lambda each: each[0].record, lambda each: _rows(*each))


def _rows(motion: Motion, found: RockingSpectrum) -> Iterator[list[Any]]:
    """Yield the row of each block."""
    for i, size in enumerate(found.size_m):
        for j, alpha in enumerate(found.slenderness_rad):
            yield [
                motion.name,
                float(size),
                float(found.frequency_parameter_rad_s[i]),
                float(alpha),
                1 / math.tan(alpha),
                float(found.max_rotation_ratio[i, j]),
                bool(found.overturned[i, j]),
                *(float(each[i, j]) for each in (found.overturning_rate, found.worst_azimuth_deg) if each is not None),
            ]
