"""The criterion study of gravestones in pictures: [Furukawa2009]_ figs. 4 to 6 drawn again."""

from __future__ import annotations

from matplotlib.figure import Figure

from seisblock.criteria.gravestones import overturning_level, published
from seisblock.present.figures import canvas
from seisblock.present.scales import acceleration_unit
from seisblock.present.text.stack_criterion import Scaled
from seisblock.studies.gravestone_criterion import CriterionStudy, frequencies_of
from seisblock.words import noted, tell

MARKS = ("o", "s", "^", "D", "v", "P", "X", "*")


def figure(study: CriterionStudy, rigid: dict[float, float], scaled: Scaled, *, reinforced: bool, gal: bool = True) -> Figure:
    """Return figs. 4 (13), 5, 6 and 10 of [Furukawa2009]_ drawn from this study, beside the published fit and the rigid block."""
    import numpy as np

    fit, equation = published(reinforced)
    unit, unit_name = acceleration_unit(gal=gal)
    title = (
        noted("Which gravestones fall, dowelled: thresholds of the pile")
        if reinforced
        else noted("Which gravestones fall: thresholds of the pile")
    )
    made, (left, right) = canvas.new_figure(1, columns=2, width=9.5, height=4.6, title=tell(title))
    fine = np.linspace(1.0, 13.5, 200)
    for index, f in enumerate(frequencies_of(study)):
        shade = str(0.12 + 0.62 * index / max(len(frequencies_of(study)) - 1, 1))
        part = [(t.pga_m_s2 / unit, t.ratio) for t in study.thresholds if t.frequency_hz == f and t.ratio is not None]
        if part:
            left.plot(*zip(*part, strict=True), MARKS[index % len(MARKS)], color=shade, markersize=4, label=f"{f:g} Hz")
        if f in study.levels:
            left.plot(fine / unit, study.levels[f] / fine, color=shade, linewidth=0.8)
    for index, (name, thresholds) in enumerate(scaled.items()):
        part = [(t.pga_m_s2 / unit, t.ratio) for t in thresholds if t.ratio is not None]
        if part:
            text = f"{name}, {thresholds[0].frequency_hz:.1f} Hz"
            left.plot(*zip(*part, strict=True), "-", color=(canvas.ACCENT, canvas.SECOND)[index % 2], linewidth=1.2, label=text)
    left.set_ylim(0.0, 6.8)
    left.set_title(tell("most squat stone that falls, and eq. (7)"), fontsize=9, loc="left")
    canvas.label(left, tell("PGA ({unit})", unit=unit_name), tell("H/B"))
    curve = np.linspace(0.3, 3.2, 200)
    right.plot(
        curve,
        overturning_level(curve, fit) / unit,
        color=canvas.INPUT,
        linewidth=1.2,
        label=tell("published, eq. {equation}", equation=equation),
    )
    if study.fit is not None:
        right.plot(
            curve,
            overturning_level(curve, study.fit) / unit,
            color=canvas.ACCENT,
            linewidth=1.0,
            linestyle=(0, (5, 1.5)),
            label=tell("this study, eq. (8)"),
        )
    right.plot(
        list(study.levels), [a / unit for a in study.levels.values()], "o", color=canvas.ACCENT, markersize=5, label=tell("this study")
    )
    right.plot(
        list(rigid), [a / unit for a in rigid.values()], "x", color="0.1", markersize=5, label=tell("rigid block on the outermost points")
    )
    right.set_ylim(bottom=0.0)
    right.set_title(tell("level"), fontsize=9, loc="left")
    canvas.label(right, tell("f (Hz)"), f"a(f) ({unit_name})")
    for axis, columns in ((left, 2), (right, 1)):
        where = "upper right" if axis is left else "upper left"
        canvas.legend(axis, loc=where, bbox_to_anchor=None, borderaxespad=0.5, ncols=columns)
    return made
