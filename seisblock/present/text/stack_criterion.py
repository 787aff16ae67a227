"""How the criterion study of gravestones is told: thresholds and levels beside the published fits."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from seisblock.criteria.gravestones import GravestoneFit, overturning_level, overturning_ratio, published
from seisblock.present.files import write_table
from seisblock.present.scales import acceleration_unit
from seisblock.present.text.tables import acceleration, line, number, table, told_acceleration
from seisblock.studies.gravestone_criterion import CriterionStudy, Threshold, frequencies_of
from seisblock.words import tell

Scaled = dict[str, tuple[Threshold, ...]]
"""Thresholds of scaled records, by their names."""


def tables(study: CriterionStudy, rigid: dict[float, float], scaled: Scaled, *, reinforced: bool, gal: bool = True) -> Iterator[Any]:
    """Yield the fit, thresholds and levels."""
    fit, equation = published(reinforced)
    unit = acceleration_unit(gal=gal).name
    yield line(_sentence(study, fit, equation, gal=gal))
    frequencies = frequencies_of(study)
    found = {(t.frequency_hz, t.pga_m_s2): t.ratio for t in study.thresholds}
    pgas = sorted({t.pga_m_s2 for t in study.thresholds})
    rows = ([acceleration(a, gal=gal), *(number(found.get((f, a)), 4) for f in frequencies)] for a in pgas)
    yield table(tell("H/B of the most squat top stone that falls"), [f"PGA ({unit})", *(f"{f:g} Hz" for f in frequencies)], rows)
    for name, thresholds in scaled.items():
        title = tell("{name}, scaled; equivalent frequency {f:.2f} Hz", name=name, f=thresholds[0].frequency_hz)
        beside = ((t, float(overturning_ratio(t.pga_m_s2, t.frequency_hz, fit))) for t in thresholds)
        lines = ([acceleration(t.pga_m_s2, gal=gal), number(t.ratio, 4), number(ratio, 4)] for t, ratio in beside)
        yield table(title, [f"PGA ({unit})", tell("H/B that falls"), tell("published, eq. {equation}", equation=equation)], lines)
    of_each = ((f, (study.levels.get(f), rigid.get(f), float(overturning_level(f, fit)))) for f in frequencies)
    levels = ([f"{f:g}", *(acceleration(a, gal=gal) for a in row)] for f, row in of_each)
    heads = [
        "f (Hz)",
        tell("pile, eq. (7)"),
        tell("rigid block on the outermost points"),
        tell("published, eq. {equation}", equation=equation),
    ]
    yield table(f"a(f) = PGA H/B ({unit})", heads, levels)


def _sentence(study: CriterionStudy, fit: GravestoneFit, equation: str, *, gal: bool) -> str:
    """Return the fit in words."""
    if study.fit is None:
        return tell("Too few frequencies at which anything fell: no fit of eq. (8).")
    ours, others = (f"p = {told_acceleration(f.p_m_s2, gal=gal)}, q = {f.q_hz:.2f} Hz, r = {f.r:.2f}" for f in (study.fit, fit))
    return tell("Least squares of eq. (8): {ours}; published {equation}: {others}.", ours=ours, equation=equation, others=others)


def write(study: CriterionStudy, scaled: Scaled, path: Path) -> None:
    """Write the thresholds as CSV, SI; with scaled records, a first column says of what motion each is."""
    header = ["frequency_hz", "pga_m_s2", "height_over_width", "fallen"]
    if not scaled:
        write_table(path, header, map(_written, study.thresholds))
        return
    every = {"sine": study.thresholds, **scaled}
    write_table(path, ["motion", *header], ([name, *_written(each)] for name, found in every.items() for each in found))


def _written(found: Threshold) -> list[str | float]:
    """Return a threshold as it stands in CSV."""
    return [found.frequency_hz, found.pga_m_s2, "" if found.ratio is None else found.ratio, " ".join(found.fallen)]
