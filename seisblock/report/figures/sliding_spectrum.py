"""Figure of a sliding spectrum: maximum sliding displacement over friction."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from seisblock.core.i18n import gettext
from seisblock.output.figures import style
from seisblock.output.figures.heading import motions_heading, panel_labels
from seisblock.output.figures.log_ticks import round_ticks
from seisblock.output.units_display import length_unit
from seisblock.report.text.sliding_spectrum import Curves


def figure(curves: Curves) -> Figure:
    """Return the figure: maximum sliding displacement over friction, a curve per component."""
    motions = [motion for motion, _ in curves]
    fig, (axis,) = style.new_figure(1, height=4.0, title=motions_heading(motions))
    disp_unit = length_unit((point.max_slip_m for _, points in curves for point in points), gal=True)
    for index, (name, (_, points)) in enumerate(zip(panel_labels(motions), curves, strict=True)):
        line_style = (style.ACCENT, style.SECOND, "0.3")[index % 3], ("-", (0, (5, 1.5)), (0, (1.2, 1.2)))[index % 3]
        slips = [(p.max_slip_m or np.nan) / disp_unit.size for p in points]
        axis.plot([p.mu for p in points], slips, color=line_style[0], linestyle=line_style[1], linewidth=1.2, label=name or "x")
    axis.set_yscale("log")
    round_ticks(axis.yaxis)
    style.label_axes(axis, gettext("friction coefficient μ (1)"), gettext("max. sliding displacement ({unit})", unit=disp_unit.name))
    style.add_legend(axis)
    return fig
