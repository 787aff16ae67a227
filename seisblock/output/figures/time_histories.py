"""Columns of time histories on a common time axis, limited to an interval, with an overview of the full record above."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure
from matplotlib.gridspec import SubplotSpec

from seisblock.core.i18n import N_, gettext
from seisblock.core.typing import FloatArray
from seisblock.output.figures import style
from seisblock.output.figures.curves import draw_curve
from seisblock.output.figures.heading import panel_labels
from seisblock.records import Motion
from seisblock.records.crop_history import is_cropped

Interval = tuple[float, float]
"""First and last time, s from the first sample of the record."""

PARTIAL_SHARE = 0.7
"""Intervals of at least this fraction of the record have no overview strip."""

OVERVIEW_HEIGHT = 0.3
"""Height of the overview strip over that of a panel."""

ARIAS_RANGE = (0.05, 0.95)
"""Limits of the strong motion in fractions of the Arias intensity."""


def history_columns(
    figure: Figure | SubFigure,
    motions: Sequence[Motion],
    stretches: Sequence[Interval],
    rows: int | Sequence[int],
    *,
    heights: Sequence[float] = (),
    narrow: bool = False,
) -> list[list[Axes]]:
    """Return the panels of each motion from top to bottom, sharing the time axis of its interval.

    Parameters
    ----------
    figure : Figure or SubFigure
    motions : sequence of Motion
        One per column; the overview strip shows the horizontal acceleration.
    stretches : sequence of (float, float)
        Interval of each column, s.
    rows : int, or one per column
        Panels of a column.
    heights : sequence of float
        Relative heights of the rows; equal by default.
    narrow : bool
        Stack the columns.
    """
    names = panel_labels(motions)
    partial = [is_partial(motion.time, stretch) for motion, stretch in zip(motions, stretches, strict=True)]
    counts = [rows] * len(motions) if isinstance(rows, int) else rows
    tall = list(heights) or [1.0] * max(counts)
    low = OVERVIEW_HEIGHT * float(np.mean(tall))
    places = _stacked_layout(figure, counts, partial, tall, low) if narrow else _side_by_side(figure, counts, any(partial), tall, low)
    columns = []
    for index, (motion, stretch) in enumerate(zip(motions, stretches, strict=True)):
        overview, *panel_specs = places[index]
        if partial[index]:
            draw_overview(figure.add_subplot(overview), motion, stretch, names[index])
        panels: list[Axes] = []
        for row, place in enumerate(panel_specs):
            panels.append(figure.add_subplot(place, sharex=panels[0] if panels else None))
            style.style_axes(panels[-1])
            panels[-1].tick_params(labelbottom=row + 1 == counts[index])
        panels[0].set_xlim(*stretch)
        style.label_axes(panels[-1], x=gettext("t (s)"))
        columns.append(panels)
    return columns


def _side_by_side(
    figure: Figure | SubFigure, counts: Sequence[int], strips: bool, tall: Sequence[float], low: float
) -> list[list[SubplotSpec]]:
    """Return the grid cells of strip and panels for columns side by side."""
    lead = [low] if strips else []
    grid = figure.add_gridspec(len(lead) + len(tall), len(counts), height_ratios=[*lead, *tall])
    return [[grid[0, index], *(grid[len(lead) + row, index] for row in range(count))] for index, count in enumerate(counts)]


def _stacked_layout(
    figure: Figure | SubFigure, counts: Sequence[int], partial: Sequence[bool], tall: Sequence[float], low: float
) -> list[list[SubplotSpec]]:
    """Return the grid cells of strip and panels for stacked columns."""
    ratios = [[*([low] if part else []), *tall[:count]] for count, part in zip(counts, partial, strict=True)]
    grid = figure.add_gridspec(sum(map(len, ratios)), 1, height_ratios=[ratio for row_ratios in ratios for ratio in row_ratios])
    firsts = np.cumsum([0, *map(len, ratios)])
    return [
        [grid[first, 0], *(grid[first + part + row, 0] for row in range(count))]
        for first, count, part in zip(firsts[:-1].tolist(), counts, partial, strict=True)
    ]


def is_partial(time: FloatArray, stretch: Interval) -> bool:
    """Return True if an interval omits enough of a record, time (n,), s, for an overview strip."""
    first, last = float(time[0]), float(time[-1])
    return min(stretch[1], last) - max(stretch[0], first) < PARTIAL_SHARE * (last - first)


def strong_motion_interval(motion: Motion) -> Interval:
    """Return the strong motion of a record: 5 to 95 % of the Arias intensity, with a margin."""
    return strong_interval(motion.time, motion.horizontal)


def strong_interval(time: FloatArray, *accelerations: FloatArray) -> Interval:
    """Return the interval of the strong motion of accelerations with a margin, or the full record if they are zero.

    Parameters
    ----------
    time : (n,) array, s
    accelerations : (n,) arrays
    """
    first, last = [], []
    for values in accelerations:
        energy = np.cumsum(np.square(values))
        if energy[-1] > 0.0:
            begin, end = np.searchsorted(energy, np.array(ARIAS_RANGE) * energy[-1])
            first.append(float(time[begin]))
            last.append(float(time[min(end, time.size - 1)]))
    if not first:
        return float(time[0]), float(time[-1])
    # union of the intervals of all components
    start, stop = min(first), max(last)
    margin = 0.15 * (stop - start) + 1.0
    return max(start - margin, float(time[0])), min(stop + margin, float(time[-1]))


def draw_overview(axis: Axes, motion: Motion, stretch: Interval, name: str) -> None:
    """Draw the overview strip: the full motion, with the interval of the panels below shaded.

    Parameters
    ----------
    axis : Axes
    motion : Motion
    stretch : (float, float)
    name : str
        Name of the component.
    """
    axis.spines[["top", "right", "left"]].set_visible(False)
    axis.tick_params(labelsize=6.5, length=2, pad=1, left=False, labelleft=False)
    axis.axvspan(*stretch, facecolor=style.BANDS[3], edgecolor=style.BANDS[3], linewidth=1.0)
    draw_curve(axis, motion.time, motion.horizontal, color=style.INPUT, linewidth=0.5)
    axis.set_xlim(motion.time[0], motion.time[-1])
    cut = motion.record is not None and is_cropped(motion.record)
    text = N_("{name}, cropped record; shaded: shown below") if cut else N_("{name}, full record; shaded: shown below")
    axis.set_title(gettext(text, name=name or gettext("record")), fontsize=7, loc="left", pad=2, parse_math=False)
