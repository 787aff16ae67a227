"""Figure of sliding: acceleration, velocities and displacement ([Fujino1978]_ figs. 8, 11 and 12)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from seisblock.core.i18n import gettext
from seisblock.core.results import Response
from seisblock.models.slide.describe import SlideResponses, describe_base
from seisblock.models.slide.model import SlidePhase
from seisblock.models.slide.solve import SlideOutcome
from seisblock.output.figures import style
from seisblock.output.figures.curves import draw_curve
from seisblock.output.figures.heading import motions_heading, panel_labels
from seisblock.output.figures.time_histories import Interval, history_columns, strong_motion_interval
from seisblock.output.units_display import Unit, acceleration_unit, length_unit, velocity_unit

COLOURS: dict[str, str] = {SlidePhase.FORWARD: "#f6dfcf", SlidePhase.BACKWARD: "#a6b6dc", SlidePhase.FLIGHT: "#6f9f7e"}
"""Colours of the phases, light enough for curves on top, distinct in greyscale."""


@style.narrow_too
def figure(responses: SlideResponses, *, gal: bool = True, narrow: bool = False) -> style.StyledFigure:
    """Return the figure: per direction acceleration with sliding thresholds and, with sliding, velocities and displacement.

    Columns side by side, or stacked if `narrow`.
    """
    motions = [response.motion for response in responses]
    rows = [3 if response.outcome.slips else 1 for response in responses]
    wide, high = (8.5, 1.0 + 2.0 * sum(rows)) if narrow else (4.5 + 4.0 * len(responses), 1.0 + 2.0 * max(rows))
    fig = style.titled_figure(motions_heading(motions), width=wide, height=high)
    columns = history_columns(fig, motions, [motion_interval(r) for r in responses], rows, narrow=narrow)
    disp_unit = length_unit((response.outcome.max_slip_m for response in responses), gal=gal)
    for panels, name, response in zip(columns, panel_labels(motions), responses, strict=True):
        _draw_column(panels, name, response, disp_unit, gal=gal)
    return fig


def _draw_column(panels: Sequence[Any], panel_name: str, response: Response[SlideOutcome], disp_unit: Unit, *, gal: bool) -> None:
    """Draw the panels of one direction, only the first without sliding."""
    unit, name = acceleration_unit(gal=gal)
    speed = velocity_unit(gal=gal)
    time, phases = response.time, response.phases
    top, *lower_panels = panels
    lower, upper = response["lower_limit"], response["upper_limit"]
    draw_curve(top, time, response["ground_acceleration"] / unit, color=style.INPUT)
    peak = float(np.abs(response["ground_acceleration"]).max()) / unit
    levels = [(float(np.median(lower)) / unit, float(np.median(upper)) / unit, gettext("sliding threshold"))]
    (limits_visible,) = style.fit_ylim(top, peak, levels, name)
    for index, limit in enumerate((lower, upper) if limits_visible else ()):
        text = None if index else gettext("sliding threshold")
        draw_curve(top, time, limit / unit, color=style.THRESHOLD, linestyle=(0, (6, 2, 1, 2)), label=text)
    if lower_panels:
        middle, bottom = lower_panels
        block = (response["ground_velocity"] + response["velocity"]) / speed.size
        draw_curve(middle, time, response["ground_velocity"] / speed.size, color="0.62", linewidth=1.6, label=gettext("ground"))
        draw_curve(middle, time, block, color=style.ACCENT, label=gettext("object"))
        draw_curve(bottom, time, response["displacement"] / disp_unit.size, color=style.ACCENT)
        style.shade_phases(middle, phases, COLOURS, names=True, direction=response.motion.name)
        style.shade_phases(bottom, phases, COLOURS)
        bottom.axhline(0.0, color=style.INPUT, linewidth=0.6)
    labels = (
        gettext("z'' ({unit})", unit=name),
        gettext("v ({unit})", unit=speed.name),
        gettext("x − z ({unit})", unit=disp_unit.name),
    )
    for panel, text in zip(panels, labels, strict=False):
        style.label_axes(panel, y=text)
        style.add_legend(panel)
    style.set_panel_title(top, gettext("{name}: {what}", name=panel_name, what=describe_base(response, in_figure=True)))


def motion_interval(response: Response[SlideOutcome]) -> Interval:
    """Return the interval of sliding with a margin, or the strong motion without sliding."""
    sliding = [phase for phase in response.phases if phase.name in COLOURS]
    if not sliding:
        return strong_motion_interval(response.motion)
    first, last = sliding[0].start_s, sliding[-1].end_s
    margin = max(0.1 * (last - first), 0.5)
    return max(first - margin, float(response.time[0])), min(last + margin, float(response.time[-1]))
