"""How the criterion study of gravestones is told: thresholds and levels beside the published fits."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from seisblock.criteria.gravestones import GravestoneFit, overturning_level, overturning_ratio, published
from seisblock.present.files import write_table
from seisblock.present.text.tables import NOTHING, line, number, table
from seisblock.studies.gravestone_criterion import CriterionStudy, Threshold, frequencies_of
from seisblock.units import GAL
from seisblock.words import tell

Scaled = dict[str, tuple[Threshold, ...]]
"""Thresholds of scaled records, by their names."""


def tables(study: CriterionStudy, rigid: dict[float, float], scaled: Scaled, *, reinforced: bool) -> Iterator[Any]:
    """Yield the fit, thresholds and levels."""
    fit, equation = published(reinforced)
    yield line(_sentence(study, fit, equation))
    frequencies = frequencies_of(study)
    found = {(t.frequency_hz, t.pga_m_s2): t.ratio for t in study.thresholds}
    pgas = sorted({t.pga_m_s2 for t in study.thresholds})
    rows = ([f"{a / GAL:.0f}", *(number(found.get((f, a)), 4) for f in frequencies)] for a in pgas)
    yield table(tell("H/B of the most squat top stone that falls"), ["PGA (gal)", *(f"{f:g} Hz" for f in frequencies)], rows)
    for name, thresholds in scaled.items():
        title = tell("{name}, scaled; equivalent frequency {f:.2f} Hz", name=name, f=thresholds[0].frequency_hz)
        beside = ((t, float(overturning_ratio(t.pga_m_s2, t.frequency_hz, fit))) for t in thresholds)
        lines = ([f"{t.pga_m_s2 / GAL:.0f}", number(t.ratio, 4), number(ratio, 4)] for t, ratio in beside)
        yield table(title, ["PGA (gal)", tell("H/B that falls"), tell("published, eq. {equation}", equation=equation)], lines)
    of_each = ((f, (study.levels.get(f), rigid.get(f), float(overturning_level(f, fit)))) for f in frequencies)
    levels = ([f"{f:g}", *(NOTHING if a is None else f"{a / GAL:.0f}" for a in row)] for f, row in of_each)
    heads = [
        "f (Hz)",
        tell("pile, eq. (7)"),
        tell("rigid block on the outermost points"),
        tell("published, eq. {equation}", equation=equation),
    ]
    yield table("a(f) = PGA H/B (gal)", heads, levels)


def _sentence(study: CriterionStudy, fit: GravestoneFit, equation: str) -> str:
    """Return the fit in words."""
    if study.fit is None:
        return tell("Too few frequencies at which anything fell: no fit of eq. (8).")
    ours, others = (f"p = {f.p_m_s2 / GAL:.1f} gal, q = {f.q_hz:.2f} Hz, r = {f.r:.2f}" for f in (study.fit, fit))
    return tell("Least squares of eq. (8): {ours}; published {equation}: {others}.", ours=ours, equation=equation, others=others)


def write(study: CriterionStudy, path: Path) -> None:
    """Write the thresholds as CSV, SI."""
    header = ["frequency_hz", "pga_m_s2", "height_over_width", "fallen"]
    rows = [[t.frequency_hz, t.pga_m_s2, "" if t.ratio is None else t.ratio, " ".join(t.fallen)] for t in study.thresholds]
    write_table(path, header, rows)
