"""How the criterion study of gravestones is told: thresholds, levels beside the published fits, and figs. 4 to 6 drawn again."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.text import Text

from seisblock.criteria.gravestones import DOWELLED, PLAIN, GravestoneFit, overturning_level, overturning_ratio
from seisblock.present.files import write_table
from seisblock.present.tables import NOTHING, number, table
from seisblock.studies.gravestone_criterion import CriterionStudy, Threshold
from seisblock.units import GAL

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Scaled = dict[str, tuple[Threshold, ...]]
"""Thresholds of scaled records, by their names."""

MARKS = ("o", "s", "^", "D", "v", "P", "X", "*")


def published(reinforced: bool) -> tuple[GravestoneFit, str]:
    """Return the paper's fit, and the number of its equation."""
    return (DOWELLED, "(10)") if reinforced else (PLAIN, "(9)")


def summary(study: CriterionStudy, rigid: dict[float, float], scaled: Scaled, *, reinforced: bool) -> dict[str, Any]:
    """Return the study as one result of a document."""
    fit, equation = published(reinforced)
    return {
        "thresholds": study.thresholds,
        "levels": [
            {
                "frequency_hz": f,
                "level_m_s2": study.levels.get(f),
                "rigid_block_m_s2": rigid.get(f),
                "published_m_s2": float(overturning_level(f, fit)),
            }
            for f in _frequencies(study)
        ],
        "fit": study.fit,
        "published": {"equation": equation, "fit": fit},
        "scaled_records": [{"record": name, "thresholds": thresholds} for name, thresholds in scaled.items()],
    }


def tables(study: CriterionStudy, rigid: dict[float, float], scaled: Scaled, *, reinforced: bool) -> Iterator[Any]:
    """Yield thresholds, levels and the fit."""
    fit, equation = published(reinforced)
    frequencies = _frequencies(study)
    found = {(t.frequency_hz, t.pga_m_s2): t.ratio for t in study.thresholds}
    pgas = sorted({t.pga_m_s2 for t in study.thresholds})
    rows = ([f"{a / GAL:.0f}", *(number(found.get((f, a)), 4) for f in frequencies)] for a in pgas)
    yield table("H/B of the most squat top stone that falls", ["PGA (gal)", *(f"{f:g} Hz" for f in frequencies)], rows)
    for name, thresholds in scaled.items():
        title = f"{name}, scaled; equivalent frequency {thresholds[0].frequency_hz:.2f} Hz"
        beside = ((t, float(overturning_ratio(t.pga_m_s2, t.frequency_hz, fit))) for t in thresholds)
        lines = ([f"{t.pga_m_s2 / GAL:.0f}", number(t.ratio, 4), number(ratio, 4)] for t, ratio in beside)
        yield table(title, ["PGA (gal)", "H/B that falls", f"published, eq. {equation}"], lines)
    of_each = ((f, (study.levels.get(f), rigid.get(f), float(overturning_level(f, fit)))) for f in frequencies)
    levels = ([f"{f:g}", *(NOTHING if a is None else f"{a / GAL:.0f}" for a in row)] for f, row in of_each)
    yield table(
        "a(f) = PGA H/B (gal)", ["f (Hz)", "pile, eq. (7)", "rigid block on the outermost points", f"published, eq. {equation}"], levels
    )  # fmt: skip
    yield Text(_sentence(study, fit, equation))


def _sentence(study: CriterionStudy, fit: GravestoneFit, equation: str) -> str:
    """Return the fit in words."""
    if study.fit is None:
        return "Too few frequencies at which anything fell: no fit of eq. (8)."
    ours, others = (f"p = {f.p_m_s2 / GAL:.1f} gal, q = {f.q_hz:.2f} Hz, r = {f.r:.2f}" for f in (study.fit, fit))
    return f"Least squares of eq. (8): {ours}; published {equation}: {others}."


def write(study: CriterionStudy, path: Path) -> None:
    """Write the thresholds as CSV, SI."""
    header = ["frequency_hz", "pga_m_s2", "height_over_width", "fallen"]
    rows = [[t.frequency_hz, t.pga_m_s2, "" if t.ratio is None else t.ratio, " ".join(t.fallen)] for t in study.thresholds]
    write_table(path, header, rows)


def figure(study: CriterionStudy, rigid: dict[float, float], scaled: Scaled, *, reinforced: bool) -> Figure:
    """Return figs. 4 (13), 5, 6 and 10 of [Furukawa2009]_ drawn from this study, beside the published fit and the rigid block."""
    import numpy as np

    from seisblock.present import canvas

    fit, equation = published(reinforced)
    made, (left, right) = canvas.new_figure(1, columns=2, width=9.5, height=4.4)
    fine = np.linspace(1.0, 13.5, 200)
    for index, f in enumerate(_frequencies(study)):
        shade = str(0.12 + 0.62 * index / max(len(_frequencies(study)) - 1, 1))
        part = [(t.pga_m_s2 / GAL, t.ratio) for t in study.thresholds if t.frequency_hz == f and t.ratio is not None]
        if part:
            left.plot(*zip(*part, strict=True), MARKS[index % len(MARKS)], color=shade, markersize=4, label=f"{f:g} Hz")
        if f in study.levels:
            left.plot(fine / GAL, study.levels[f] / fine, color=shade, linewidth=0.8)
    for index, (name, thresholds) in enumerate(scaled.items()):
        part = [(t.pga_m_s2 / GAL, t.ratio) for t in thresholds if t.ratio is not None]
        if part:
            text = f"{name}, {thresholds[0].frequency_hz:.1f} Hz"
            left.plot(*zip(*part, strict=True), "-", color=(canvas.ACCENT, canvas.SECOND)[index % 2], linewidth=1.2, label=text)
    left.set_ylim(0.0, 6.8)
    left.set_title("most squat stone that falls, and eq. (7)", fontsize=9, loc="left")
    canvas.label(left, "PGA (gal)", "H/B (1)")
    curve = np.linspace(0.3, 3.2, 200)
    right.plot(curve, overturning_level(curve, fit) / GAL, color=canvas.INPUT, linewidth=1.2, label=f"published {equation}")
    if study.fit is not None:
        right.plot(curve, overturning_level(curve, study.fit) / GAL, color=canvas.ACCENT, linewidth=1.0, label="this study, eq. (8)")
    right.plot(list(study.levels), [a / GAL for a in study.levels.values()], "o", color=canvas.ACCENT, markersize=5, label="this study")
    right.plot(list(rigid), [a / GAL for a in rigid.values()], "x", color="0.1", markersize=5, label="rigid block, outermost points")
    right.set_ylim(bottom=0.0)
    right.set_title("level", fontsize=9, loc="left")
    canvas.label(right, "f (Hz)", "a(f) (gal)")
    for axis, columns in ((left, 2), (right, 1)):
        axis.legend(fontsize=7, frameon=False, ncols=columns, loc="upper right" if axis is left else "upper left")
    return made


def _frequencies(study: CriterionStudy) -> list[float]:
    """Return the frequencies in their order."""
    return list(dict.fromkeys(t.frequency_hz for t in study.thresholds))
