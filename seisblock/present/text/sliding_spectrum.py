"""How a sliding spectrum is told: largest slip against friction, as a table and CSV."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from seisblock.present.histories import write_by_record
from seisblock.present.scales import length_cell, length_unit, told_length
from seisblock.present.text.tables import answered, line, table
from seisblock.records import Motion
from seisblock.studies.sliding import SlidePoint
from seisblock.words import noted, tell

Curves = Sequence[tuple[Motion, Sequence[SlidePoint]]]


MOST_ROWS = 25


def tables(curves: Curves) -> Iterator[Any]:
    """Yield, per component, a table of at most 25 frictions."""
    for opening, part in answered(curves, lambda each: each[0].record, lambda each: [line(verdict(each[0].name or "x", each[1]))]):
        yield from opening
        yield from (shown for each in part for shown in _slips(*each))


def _slips(motion: Motion, points: Sequence[SlidePoint]) -> Iterator[Any]:
    """Yield the table of one component."""
    chosen = np.unique(np.linspace(0, len(points) - 1, min(len(points), MOST_ROWS)).round().astype(int))
    unit = length_unit((point.max_slip_m for point in points), gal=True)
    rows = [[f"{points[i].mu:.4g}", length_cell(points[i].max_slip_m, unit), length_cell(points[i].residual_slip_m, unit)] for i in chosen]
    title = tell("{name}: sliding against friction", name=motion.name)
    yield table(title, ["μ", tell("largest slip ({unit})", unit=unit.name), tell("residual slip ({unit})", unit=unit.name)], rows)
    yield line()


def verdict(name: str, points: Sequence[SlidePoint]) -> str:
    """Return from which friction on the object holds, and how far it slides below."""
    ordered = sorted(points, key=lambda point: point.mu)
    most = max(ordered, key=lambda point: point.max_slip_m or 0.0)
    slides = [point.mu for point in ordered if point.slips]
    if not slides:
        return tell("{name}: holds at every friction from {mu:.4g} on.", name=name, mu=ordered[0].mu)
    holds = next((point.mu for point in ordered if point.mu > slides[-1]), None)
    values = {"name": name, "most": told_length(most.max_slip_m or 0.0), "at": most.mu}
    if holds is None:
        return tell("{name}: slides at every friction up to {mu:.4g}, at most {most} (at {at:.4g}).", mu=slides[-1], **values)
    return tell(noted("{name}: holds from a friction of {mu:.4g} on; below it slides, at most {most} (at {at:.4g})."), mu=holds, **values)


def write(path: Path, curves: Curves) -> None:
    """Write every point as a row of CSV, SI; of several records with their index."""
    header = ["component", "mu", "max_slip_m", "residual_slip_m"]
    write_by_record(
        path,
        header,
        curves,
        lambda each: each[0].record,
        lambda each: ([each[0].name, p.mu, p.max_slip_m, p.residual_slip_m] for p in each[1]),
    )
