"""Figure of a jump: acceleration with rocking threshold, tilt, rise, displacement."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from seisblock.core.i18n import N_, gettext
from seisblock.core.results import Response
from seisblock.models.jump.chain import JumpPhase
from seisblock.models.jump.describe import JumpResponses
from seisblock.models.jump.interpolate import interpolate_phases
from seisblock.models.jump.solve import JumpOutcome
from seisblock.output.figures import style
from seisblock.output.figures.curves import draw_curve
from seisblock.output.figures.heading import motions_heading, object_label, panel_labels
from seisblock.output.figures.time_histories import Interval, history_columns, strong_motion_interval
from seisblock.output.units_display import Unit, acceleration_unit, length_unit

QUANTITIES = tuple(map(N_, ("θ (deg)", "rise of G ({unit})", "x of G ({unit})")))
COLOURS: dict[str, str] = {JumpPhase.ROCKING: "#f4d9c6", JumpPhase.FLIGHT: "#8fb89b", JumpPhase.LANDED: "#7183bb"}


@style.narrow_too
def figure(responses: JumpResponses, *, gal: bool = True, narrow: bool = False) -> style.StyledFigure:
    """Return the figure: per component record with thresholds (fig. 12), and tilt, rise, displacement with motion (fig. 14).

    Columns side by side, or stacked if `narrow`.
    """
    motions = [response.motion for response in responses]
    rows = [4 if response.outcome.chains else 1 for response in responses]
    wide, high = (8.0, 1.0 + 1.8 * sum(rows)) if narrow else (4.0 + 4.0 * len(responses), 1.0 + 1.8 * max(rows))
    fig = style.titled_figure(motions_heading(motions), width=wide, height=high)
    columns = history_columns(fig, motions, [motion_interval(r) for r in responses], rows, narrow=narrow)
    disp_unit = length_unit((float(np.abs(item["displacement"]).max()) for item in responses), gal=gal)
    for panels, name, response in zip(columns, panel_labels(motions), responses, strict=True):
        _draw_column(panels, name, response, disp_unit, gal=gal)
    return fig


def motion_interval(response: Response[JumpOutcome]) -> Interval:
    """Return the interval of all rocking-jump sequences with a margin, or the strong motion without any."""
    if not response.outcome.chains:
        return strong_motion_interval(response.motion)
    first = response.outcome.chains[0].rocking_start_s
    last = max(phase.end_s for phase in response.phases if phase.name in COLOURS)
    margin = 0.15 * (last - first) + 0.2
    return max(first - margin, float(response.motion.time[0])), last + margin


def _draw_column(panels: Sequence[Any], panel_name: str, response: Response[JumpOutcome], disp_unit: Unit, *, gal: bool) -> None:
    """Draw the four panels of one component, only the first without rocking."""
    motion, outcome = response.motion, response.outcome
    unit, name = acceleration_unit(gal=gal)
    draw_curve(panels[0], motion.time, motion.horizontal / unit, color=style.INPUT)
    level = outcome.rocking_threshold_m_s2 / unit
    peak = float(np.abs(motion.horizontal).max()) / unit
    (threshold_visible,) = style.fit_ylim(panels[0], peak, [(-level, level, gettext("rocking threshold"))], name)
    if threshold_visible:
        style.draw_thresholds(panels[0], [level, -level], gettext("rocking threshold"))
    time, curves = interpolate_phases(response)
    # uniform rotation in flight needs no extra points
    leaning, tilt = interpolate_phases(response, [JumpPhase.ROCKING])
    rise = curves["height"] - response.body.centroid_height
    rows = (leaning, np.degrees(tilt["rotation"])), (time, rise / disp_unit.size), (time, curves["displacement"] / disp_unit.size)
    for panel, row in zip(panels[1:], rows, strict=False):
        draw_curve(panel, *row, longest_gap=1.5 * motion.dt, color=style.ACCENT)
    for panel in panels:
        style.shade_phases(panel, response.phases, COLOURS, names=panel is panels[min(1, len(panels) - 1)])
    for panel in panels[:2]:
        style.add_legend(panel)
    body = response.body
    label = object_label(body.width, body.height, friction=response.options.contact.mu, gal=gal)
    style.set_panel_title(panels[0], f"{gettext('{name}: {what}', name=panel_name, what=gettext(body.name))}\n{label}")
    labels = gettext("z'' ({unit})", unit=name), *(gettext(text, unit=disp_unit.name) for text in QUANTITIES)
    for panel, text in zip(panels, labels, strict=False):
        style.label_axes(panel, y=text)
