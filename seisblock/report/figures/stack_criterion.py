"""Figure of the gravestone criterion study ([Furukawa2009]_ figs. 4 to 6)."""

from __future__ import annotations

from matplotlib.figure import Figure

from seisblock.core.i18n import N_, gettext
from seisblock.criteria.gravestones import furukawa_fit, overturning_level
from seisblock.output.figures import style
from seisblock.output.units_display import acceleration_unit
from seisblock.report.text.stack_criterion import ScaledRecords
from seisblock.studies.gravestone_criterion import CriterionStudy, study_frequencies

MARKS = ("o", "s", "^", "D", "v", "P", "X", "*")


def figure(
    study: CriterionStudy, rigid: dict[float, float], scaled_records: ScaledRecords, *, reinforced: bool, gal: bool = True
) -> Figure:
    """Return figs. 4 (13), 5, 6 and 10 of [Furukawa2009]_ from this study, with the published fit and the rigid block."""
    import numpy as np

    fit, equation = furukawa_fit(reinforced)
    unit, unit_name = acceleration_unit(gal=gal)
    title = (
        N_("Overturning thresholds of dowelled gravestones (pile model)")
        if reinforced
        else N_("Overturning thresholds of gravestones (pile model)")
    )
    fig, (left, right) = style.new_figure(1, columns=2, width=9.5, height=4.6, title=gettext(title))
    fine = np.linspace(1.0, 13.5, 200)
    for index, f in enumerate(study_frequencies(study)):
        shade = str(0.12 + 0.62 * index / max(len(study_frequencies(study)) - 1, 1))
        part = [(t.pga_m_s2 / unit, t.ratio) for t in study.thresholds if t.frequency_hz == f and t.ratio is not None]
        if part:
            left.plot(*zip(*part, strict=True), MARKS[index % len(MARKS)], color=shade, markersize=4, label=f"{f:g} Hz")
        if f in study.levels:
            left.plot(fine / unit, study.levels[f] / fine, color=shade, linewidth=0.8)
    for index, (name, thresholds) in enumerate(scaled_records.items()):
        part = [(t.pga_m_s2 / unit, t.ratio) for t in thresholds if t.ratio is not None]
        if part:
            text = f"{name}, {thresholds[0].frequency_hz:.1f} Hz"
            left.plot(*zip(*part, strict=True), "-", color=(style.ACCENT, style.SECOND)[index % 2], linewidth=1.2, label=text)
    left.set_ylim(0.0, 6.8)
    left.set_title(gettext("smallest H/B overturned, and eq. (7)"), fontsize=9, loc="left")
    style.label_axes(left, gettext("PGA ({unit})", unit=unit_name), gettext("H/B"))
    curve = np.linspace(0.3, 3.2, 200)
    right.plot(
        curve,
        overturning_level(curve, fit) / unit,
        color=style.INPUT,
        linewidth=1.2,
        label=gettext("published, eq. {equation}", equation=equation),
    )
    if study.fit is not None:
        right.plot(
            curve,
            overturning_level(curve, study.fit) / unit,
            color=style.ACCENT,
            linewidth=1.0,
            linestyle=(0, (5, 1.5)),
            label=gettext("this study, eq. (8)"),
        )
    right.plot(
        list(study.levels), [a / unit for a in study.levels.values()], "o", color=style.ACCENT, markersize=5, label=gettext("this study")
    )
    right.plot(
        list(rigid),
        [a / unit for a in rigid.values()],
        "x",
        color="0.1",
        markersize=5,
        label=gettext("rigid block on the outermost contact points"),
    )
    right.set_ylim(bottom=0.0)
    right.set_title(gettext("overturning level"), fontsize=9, loc="left")
    style.label_axes(right, gettext("f (Hz)"), f"a(f) ({unit_name})")
    for axis, columns in ((left, 2), (right, 1)):
        location = "upper right" if axis is left else "upper left"
        style.add_legend(axis, loc=location, bbox_to_anchor=None, borderaxespad=0.5, ncols=columns)
    return fig
