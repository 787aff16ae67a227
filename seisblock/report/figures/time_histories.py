"""Columns of time histories on one clock: opened on the stretch that matters, with the whole record as a strip above it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure
from matplotlib.gridspec import SubplotSpec

from seisblock.core.i18n import N_, gettext
from seisblock.core.typing import FloatArray
from seisblock.records import Motion
from seisblock.records.crop_history import is_cropped
from seisblock.report.figures import style
from seisblock.report.figures.curves import draw_curve
from seisblock.report.figures.heading import panel_labels

Interval = tuple[float, float]
"""First and last time shown, s from the record's first sample."""

PARTIAL_SHARE = 0.7
"""A stretch of at least this share of the record needs no strip that shows the rest."""

OVERVIEW_HEIGHT = 0.3
"""Height of the strip, of a panel's."""

ARIAS_RANGE = (0.05, 0.95)
"""A record opens on the time between these shares of its Arias intensity, with a margin."""


def history_columns(
    figure: Figure | SubFigure,
    motions: Sequence[Motion],
    stretches: Sequence[Interval],
    rows: int | Sequence[int],
    *,
    heights: Sequence[float] = (),
    narrow: bool = False,
) -> list[list[Axes]]:
    """Return the panels of each motion from above downwards, all of a column on one clock that runs over its stretch.

    Parameters
    ----------
    figure : Figure or SubFigure
    motions : sequence of Motion
        One per column; their horizontal acceleration is what the strip shows.
    stretches : sequence of (float, float)
        What each column shows, s.
    rows : int, or one per column
        Panels of a column; a shorter one leaves the places below it empty.
    heights : sequence of float
        Of the rows, relative; alike when left out.
    narrow : bool
        Columns stand below each other, for a figure that is no wider than one.
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
    """Return where the strip and the panels of columns beside each other stand."""
    lead = [low] if strips else []
    grid = figure.add_gridspec(len(lead) + len(tall), len(counts), height_ratios=[*lead, *tall])
    return [[grid[0, index], *(grid[len(lead) + row, index] for row in range(count))] for index, count in enumerate(counts)]


def _stacked_layout(
    figure: Figure | SubFigure, counts: Sequence[int], partial: Sequence[bool], tall: Sequence[float], low: float
) -> list[list[SubplotSpec]]:
    """Return where the strip and the panels of columns below each other stand."""
    ratios = [[*([low] if part else []), *tall[:count]] for count, part in zip(counts, partial, strict=True)]
    grid = figure.add_gridspec(sum(map(len, ratios)), 1, height_ratios=[ratio for row_ratios in ratios for ratio in row_ratios])
    firsts = np.cumsum([0, *map(len, ratios)])
    return [
        [grid[first, 0], *(grid[first + part + row, 0] for row in range(count))]
        for first, count, part in zip(firsts[:-1].tolist(), counts, partial, strict=True)
    ]


def is_partial(time: FloatArray, stretch: Interval) -> bool:
    """Return whether a stretch leaves so much of a record out, (n,) s, that a strip shows the whole of it."""
    first, last = float(time[0]), float(time[-1])
    return min(stretch[1], last) - max(stretch[0], first) < PARTIAL_SHARE * (last - first)


def strong_motion_interval(motion: Motion) -> Interval:
    """Return the strong part of a record: 5 to 95 % of its Arias intensity, with a margin, or all of it where that is most of it."""
    return strong_interval(motion.time, motion.horizontal)


def strong_interval(time: FloatArray, *accelerations: FloatArray) -> Interval:
    """Return the time in which the strong part of some accelerations lies, (n,), with a margin; all of it where they are zero.

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
    start, stop = min(first), max(last)
    margin = 0.15 * (stop - start) + 1.0
    return max(start - margin, float(time[0])), min(stop + margin, float(time[-1]))


def draw_overview(axis: Axes, motion: Motion, stretch: Interval, name: str) -> None:
    """Draw the whole of a motion, a record or what was cut out of one, with what the panels below show of it marked.

    Parameters
    ----------
    axis : Axes
    motion : Motion
    stretch : (float, float)
    name : str
        Of the component.
    """
    axis.spines[["top", "right", "left"]].set_visible(False)
    axis.tick_params(labelsize=6.5, length=2, pad=1, left=False, labelleft=False)
    axis.axvspan(*stretch, facecolor=style.BANDS[3], edgecolor=style.BANDS[3], linewidth=1.0)
    draw_curve(axis, motion.time, motion.horizontal, color=style.INPUT, linewidth=0.5)
    axis.set_xlim(motion.time[0], motion.time[-1])
    cut = motion.record is not None and is_cropped(motion.record)
    text = N_("{name}, all that was cut out; below, what is shaded") if cut else N_("{name}, the whole record; below, what is shaded")
    axis.set_title(gettext(text, name=name or gettext("record")), fontsize=7, loc="left", pad=2, parse_math=False)
