"""A sliding spectrum in pictures: largest slip against friction."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from seisblock.present.figures import canvas
from seisblock.present.figures.heading import heading_of, names_of
from seisblock.present.figures.rulers import round_ticks
from seisblock.present.scales import length_unit
from seisblock.present.text.sliding_spectrum import Curves
from seisblock.words import tell


def figure(curves: Curves) -> Figure:
    """Return the figure: largest slip against friction, a curve per component."""
    motions = [motion for motion, _ in curves]
    made, (axis,) = canvas.new_figure(1, height=4.0, title=heading_of(motions))
    far = length_unit((point.max_slip_m for _, points in curves for point in points), gal=True)
    for index, (name, (_, points)) in enumerate(zip(names_of(motions), curves, strict=True)):
        style = (canvas.ACCENT, canvas.SECOND, "0.3")[index % 3], ("-", (0, (5, 1.5)), (0, (1.2, 1.2)))[index % 3]
        slips = [(p.max_slip_m or np.nan) / far.size for p in points]
        axis.plot([p.mu for p in points], slips, color=style[0], linestyle=style[1], linewidth=1.2, label=name or "x")
    axis.set_yscale("log")
    round_ticks(axis.yaxis)
    canvas.label(axis, tell("friction μ"), tell("largest slip ({unit})", unit=far.name))
    canvas.legend(axis)
    return made
