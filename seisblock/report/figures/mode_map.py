"""Figure of mode maps: governing mode over friction and slenderness or size, with initiation limits."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke

from seisblock.core.i18n import N_, gettext
from seisblock.core.typing import FloatArray
from seisblock.criteria.initiation import Mode
from seisblock.output.figures import style
from seisblock.output.figures.heading import motions_heading, panel_labels
from seisblock.report.figures.spectrum import cell_edges, log_cell_edges, style_size_axis
from seisblock.report.text.mode_map import Maps, rows_are_sizes
from seisblock.studies.respond.mode_map import MODES_BY_SEVERITY, NO_ANSWER, ModeMap

COLOURS = {
    Mode.REST: "#f6f6f2",
    Mode.SLIDE: "#b9d6e8",
    Mode.ROCK: "#dd9d2c",
    Mode.SLIDE_ROCK: "#a270a0",
    Mode.FLIGHT: "#176a64",
    Mode.OVERTURNED: "#6b1f23",
    NO_ANSWER: "#ffffff",
}
"""Colours from light (rest) to dark (overturning), distinct in greyscale and for colour-blind readers."""

NAMES = {
    Mode.REST: N_("rest"), Mode.SLIDE: N_("sliding"), Mode.ROCK: N_("rocking"), Mode.SLIDE_ROCK: N_("slide-rocking"),
    Mode.FLIGHT: N_("flight"), Mode.OVERTURNED: N_("overturning"), NO_ANSWER: N_("no result"),
}  # fmt: skip
"""Labels of the modes."""

LABEL_LIMIT = 0.88
"""Fraction of an axis up to which a limit line is labelled."""

MIN_LABEL_ROOM = 0.07
"""Smallest distance of a label from the border of its region, fraction of width and height of the map."""

HALO = [withStroke(linewidth=2.5, foreground="white")]
LIMIT: dict[str, Any] = {"color": "black", "linewidth": 1.3}
JUMP: dict[str, Any] = {"color": "black", "linewidth": 1.1, "linestyle": (0, (4, 2)), "path_effects": HALO}


def figure(maps: Maps) -> Figure:
    """Return the figure: per component a map of the governing mode, with closed-form initiation limits."""
    motions = [motion for motion, _ in maps]
    fig, axes = style.new_figure(1, columns=len(maps), width=1.2 + 4.6 * len(maps), height=5.2, sharey=True, title=motions_heading(motions))
    modes = sorted({int(index) for _, mode_map in maps for index in np.unique(mode_map.governing)})
    for axis, name, (_, mode_map) in zip(axes, panel_labels(motions), maps, strict=True):
        sizes = rows_are_sizes(mode_map)
        x, y = cell_edges(mode_map.mu), log_cell_edges(mode_map.size_m) if sizes else cell_edges(mode_map.b_over_h)
        colours = ListedColormap([COLOURS[mode] for mode in MODES_BY_SEVERITY])
        axis.pcolormesh(x, y, mode_map.governing, cmap=colours, vmin=-0.5, vmax=len(MODES_BY_SEVERITY) - 0.5, rasterized=True)
        axis.set_xlim(max(x[0], 0.0), x[-1])
        axis.set_ylim(y[0] if sizes else max(y[0], 0.0), y[-1])
        axis.grid(False)
        if sizes:
            style_size_axis(axis, y)
            _draw_size_limits(axis, mode_map)
        else:
            _draw_shape_limits(axis, mode_map)
        _label_regions(axis, mode_map, x, y)
        shape = (
            gettext("2R = {size:.3g} m", size=mode_map.size_m[0]) if not sizes else gettext("b/h = {ratio:.3g}", ratio=mode_map.b_over_h[0])
        )
        push = gettext("A = {ratio:.2f} at {time:.1f} s", ratio=mode_map.loading, time=mode_map.loading_time_s)
        axis.set_title(f"{name}, {shape}; {push}", fontsize=9, loc="left", parse_math=False)
        style.label_axes(axis, gettext("friction coefficient μ (1)"), ("2R (m)" if sizes else "b/h") if axis is axes[0] else "")
    handles: list[Any] = [
        Patch(facecolor=COLOURS[MODES_BY_SEVERITY[i]], edgecolor="0.6", linewidth=0.5, label=gettext(NAMES[MODES_BY_SEVERITY[i]]))
        for i in modes
    ]
    for line_kwargs, text in (
        (LIMIT, gettext("initiation of motion; A: peak horizontal force / weight")),
        (JUMP, gettext("no slip at the corner to the right, for A as a step")),
    ):
        handles += axes[0].plot([], [], label=text, **line_kwargs)
    style.add_figure_legend(fig, handles, loc="outside lower center", ncols=min(2 * len(maps), 4))
    return fig


def _draw_shape_limits(axis: Axes, mode_map: ModeMap) -> None:
    """Draw the initiation limits over friction and b/h: four regions that meet at (A, A)."""
    push = min(mode_map.loading, 2.0 * max(axis.get_xlim()[1], axis.get_ylim()[1]))
    axis.plot([0.0, push], [0.0, push], **LIMIT)
    axis.plot([push, push], [push, 1e3], **LIMIT)
    axis.plot([push, 1e3], [push, push], **LIMIT)
    rocks = ~np.isnan(mode_map.friction_to_rock)
    if rocks.any():
        order = np.argsort(mode_map.b_over_h[rocks])
        friction, ratio = mode_map.friction_to_rock[rocks][order], mode_map.b_over_h[rocks][order]
        axis.plot([*friction, mode_map.loading], [*ratio, mode_map.loading], **JUMP)
    right, top = axis.get_xlim()[1], axis.get_ylim()[1]
    corner = 0.93 * min(push, right, top)
    _annotate_limit(axis, corner, corner, "μ = b/h", ha="right", va="bottom")
    if push < LABEL_LIMIT * top and push < right:
        _annotate_limit(axis, push, 0.98 * top, "μ = A", ha="right", va="top", rotation=90)
    if push < LABEL_LIMIT * right and push < top:
        _annotate_limit(axis, 0.98 * right, push, "b/h = A", ha="right", va="bottom")


def _draw_size_limits(axis: Axes, mode_map: ModeMap) -> None:
    """Draw the initiation limits over friction and size, which do not depend on size."""
    ratio = float(mode_map.b_over_h[0])
    initiation = min(ratio, mode_map.loading)
    axis.axvline(initiation, **LIMIT)
    right, top = axis.get_xlim()[1], axis.get_ylim()[1]
    if initiation < right:
        _annotate_limit(axis, initiation, 0.9 * top, "μ = b/h" if ratio < mode_map.loading else "μ = A", ha="right", va="top", rotation=90)
    friction = float(mode_map.friction_to_rock[0])
    if not math.isnan(friction):
        axis.axvline(friction, **JUMP)


def _annotate_limit(axis: Axes, x: float, y: float, text: str, **style: Any) -> None:
    """Label a limit line, with a halo."""
    away = (-3, 0) if "rotation" in style else (0, 3)
    axis.annotate(text, (x, y), away, textcoords="offset points", fontsize=8, path_effects=HALO, annotation_clip=True, **style)


def _label_regions(axis: Axes, mode_map: ModeMap, x: FloatArray, y: FloatArray) -> None:
    """Label each mode in the middle of its widest region if the label fits."""
    from scipy.ndimage import distance_transform_edt

    rows, columns = mode_map.governing.shape
    for index in np.unique(mode_map.governing):
        inside = np.pad(mode_map.governing == index, 1)
        room = distance_transform_edt(inside, sampling=(1.0 / rows, 1.0 / columns))[1:-1, 1:-1]
        i, j = np.unravel_index(int(np.argmax(room)), room.shape)
        if room[i, j] >= MIN_LABEL_ROOM:
            dark = MODES_BY_SEVERITY[index] in (Mode.FLIGHT, Mode.OVERTURNED)
            middle = math.sqrt(y[i] * y[i + 1]) if rows_are_sizes(mode_map) else 0.5 * (y[i] + y[i + 1])
            axis.text(
                0.5 * (x[j] + x[j + 1]),
                middle,
                gettext(NAMES[MODES_BY_SEVERITY[index]]),
                color="white" if dark else "0.1",
                fontsize=9,
                path_effects=[] if dark else HALO,
                ha="center",
                va="center",
                clip_on=True,
            )
