"""Figure of an item of a paper: its panels, or the figure of the study behind it."""

from __future__ import annotations

import math
from itertools import cycle
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seisblock.core.i18n import gettext
from seisblock.output.figures import style
from seisblock.paper import Answer, Item, Paper
from seisblock.paper.item import Panel, Series
from seisblock.report.figures.uplift_harmonic import harmonic_figure

LINES: dict[str, Any] = {"line": "-", "dashed": (0, (5, 1.5)), "dotted": (0, (1.2, 1.2))}
LEVEL_DASHES = ((6, 2, 1, 2), (2, 2))
"""Dashes of the horizontal lines of a panel, in turn."""

MARKERS = "os^Dvx*P"
FILLED_MARKERS = MARKERS.replace("x", "")
MAX_COLUMNS = 3
COLUMNS = {1: 1, 2: 2, 3: 1, 4: 2}
"""Columns by the number of panels, where fewer than the maximum."""

WIDTHS = {1: 7.0, 2: 8.0, 3: 10.0}
"""Width of a figure by its columns, inches."""


def figure(paper: Paper, item: Item, answer: Answer) -> Figure:
    """Return the figure of an item."""
    title = gettext("{paper} {item}: {title}", paper=paper.key, item=item.label, title=gettext(item.title))
    if answer.drawing is not None:
        regions, number = answer.drawing
        return harmonic_figure(regions, number, title=title)
    count = len(answer.panels)
    columns = COLUMNS.get(count, MAX_COLUMNS)
    rows = math.ceil(count / columns)
    height = 3.6 if columns < MAX_COLUMNS and rows < MAX_COLUMNS else 2.4
    fig, axes = style.new_figure(rows, columns=columns, width=WIDTHS[columns], height=0.8 + height * rows, title=title, sharex=False)
    for axis, panel in zip(axes, answer.panels, strict=False):
        _draw(axis, panel)
    for axis in axes[count:]:
        axis.set_axis_off()
    return fig


def _draw(axis: Axes, panel: Panel) -> None:
    """Draw one panel."""
    kinds = [series.kind for series in panel.series]
    bars = [series for series in panel.series if series.kind == "bars"]
    groups = [kind == "points" for kind in kinds]
    for index, series in enumerate(panel.series):
        # curves and points each have the whole range of colours: neighbouring curves stay distinguishable beside points
        rank, count = groups[:index].count(groups[index]), groups.count(groups[index])
        accented = len(kinds) == 1 or (bars and series.kind == "points")
        colour = style.ACCENT if accented else colormaps["plasma"](0.85 * rank / max(count - 1, 1))
        _draw_series(axis, series, colour, MARKERS[rank % len(MARKERS)], _bar_width(bars))
    for (level, text), dashes in zip(panel.levels, cycle(LEVEL_DASHES)):
        axis.axhline(level, color=style.THRESHOLD, linewidth=0.8, linestyle=(0, dashes), label=gettext(text) or None)
    if panel.x_range:
        axis.set_xlim(*panel.x_range)
    if panel.y_range:
        axis.set_ylim(*panel.y_range)
    if panel.equal:
        axis.set_aspect("equal", adjustable="box" if panel.x_range else "datalim")
    if panel.ticks:
        axis.set_xticks([x for x, _ in panel.ticks], [gettext(text) for _, text in panel.ticks], rotation=30 if len(panel.ticks) > 6 else 0)
    style.label_axes(axis, x=gettext(panel.x_label), y=gettext(panel.y_label))
    if panel.title:
        style.set_panel_title(axis, gettext(panel.title))
    style.add_legend(axis, loc="best", bbox_to_anchor=None, borderaxespad=0.5, ncols=1 if len(kinds) < 9 else 2)


def _bar_width(bars: list[Series]) -> float:
    """Return the width of bars: the smallest distance of any two."""
    positions = np.unique(np.concatenate([np.asarray(series.x, dtype=np.float64) for series in bars])) if bars else np.empty(0)
    return 0.9 * float(np.diff(positions).min()) if positions.size > 1 else 0.8


def _draw_series(axis: Axes, series: Series, colour: Any, marker: str, width: float) -> None:
    """Draw one series."""
    label = gettext(series.label) or None
    if series.kind == "bars":
        axis.bar(series.x, series.y, width=width, color=colour, label=label)
    elif series.kind == "points":
        rim: dict[str, Any] = {"markeredgecolor": "0.2", "markeredgewidth": 0.5} if marker in FILLED_MARKERS else {}
        axis.plot(series.x, series.y, marker, color=colour, markersize=5.0, label=label, zorder=3, **rim)
    elif series.kind == "steps":
        axis.step(series.x, series.y, where="post", color=colour, linewidth=1.2, label=label)
    else:
        axis.plot(series.x, series.y, color=colour, linewidth=1.2, linestyle=LINES[series.kind], label=label)
