"""Figure of a solver without a module of its own: one panel per quantity, over the strong motion."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from matplotlib.figure import Figure

from seisblock.core.i18n import gettext
from seisblock.core.results import Response
from seisblock.report.figures import style
from seisblock.report.figures.curves import draw_curve
from seisblock.report.figures.heading import motions_heading, panel_labels
from seisblock.report.figures.time_histories import history_columns, strong_motion_interval
from seisblock.report.text.solver import describe

MAX_PANELS = 6
"""Most panels of a column; further channels stand in the file of histories."""


def figure(responses: Sequence[Response[Any]], *, gal: bool = True) -> Figure:
    """Return the figure: the channels of each direction, SI, in the order of the solver."""
    fig = _build_figure(responses)
    fig.narrow_layout = lambda: _build_figure(responses, narrow=True)
    return fig


def _build_figure(responses: Sequence[Response[Any]], *, narrow: bool = False) -> style.StyledFigure:
    """Return the figure, columns side by side, or stacked if `narrow`."""
    motions = [response.motion for response in responses]
    rows = min(len(responses[0].channels), MAX_PANELS) or 1
    wide, high = (8.5, 1.0 + 1.6 * rows * len(responses)) if narrow else (4.5 + 4.0 * len(responses), 1.0 + 1.6 * rows)
    fig = style.titled_figure(motions_heading(motions), width=wide, height=high)
    columns = history_columns(fig, motions, [strong_motion_interval(motion) for motion in motions], rows, narrow=narrow)
    for panels, name, response in zip(columns, panel_labels(motions), responses, strict=True):
        for panel, channel in zip(panels, response.channels, strict=False):
            draw_curve(panel, response.time, channel.values, color=style.ACCENT)
            quantity = channel.symbol or gettext(channel.name.replace("_", " "))
            unit = "" if channel.unit == "1" else f" ({channel.unit})"
            style.label_axes(panel, y=f"{quantity}{unit}")
        style.set_panel_title(panels[0], gettext("{name}: {what}", name=name, what=describe(response)))
    return fig
