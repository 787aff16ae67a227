"""Maps of what happens: a colour for each mode over friction and slenderness, or size, with the limits of initiation drawn in."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke

from seisblock.present.figures import canvas
from seisblock.present.figures.heading import heading_of, names_of
from seisblock.present.figures.spectrum import edges, log_edges, log_ticks
from seisblock.present.text.mode_map import Maps, by_size
from seisblock.solvers.respond.tale import FLIGHT, OVERTURNED, REST, ROCK, SLIDE, SLIDE_ROCK
from seisblock.studies.standing.mode_map import GOVERNING, NO_ANSWER, ModeMap
from seisblock.typing import FloatArray
from seisblock.words import noted, tell

COLOURS = {
    REST: "#f6f6f2",
    SLIDE: "#b9d6e8",
    ROCK: "#dd9d2c",
    SLIDE_ROCK: "#a270a0",
    FLIGHT: "#176a64",
    OVERTURNED: "#6b1f23",
    NO_ANSWER: "#ffffff",
}
"""Lighter to darker from rest to overturning, so that they differ in grey and to every eye."""

NAMES = {
    REST: noted("stands still"), SLIDE: noted("slides"), ROCK: noted("rocks"), SLIDE_ROCK: noted("slides while it rocks"),
    FLIGHT: noted("leaves the ground"), OVERTURNED: noted("falls"), NO_ANSWER: noted("no answer"),
}  # fmt: skip
"""As a region of the map is called."""

NEAR = 0.88
"""Share of an axis up to which a limit leaves room for its name beyond it."""

ROOMY = 0.07
"""Share of the map's width and height that a region must have around a point to bear its name there."""

HALO = [withStroke(linewidth=2.5, foreground="white")]
LIMIT: dict[str, Any] = {"color": "black", "linewidth": 1.3}
JUMP: dict[str, Any] = {"color": "black", "linewidth": 1.1, "linestyle": (0, (4, 2)), "path_effects": HALO}


def figure(maps: Maps) -> Figure:
    """Return the figure: per component a map, coloured by the mode that governs, with the closed-form limits of initiation."""
    motions = [motion for motion, _ in maps]
    made, axes = canvas.new_figure(1, columns=len(maps), width=1.2 + 4.6 * len(maps), height=5.2, sharey=True, title=heading_of(motions))
    seen = sorted({int(index) for _, found in maps for index in np.unique(found.governing)})
    for axis, name, (_, found) in zip(axes, names_of(motions), maps, strict=True):
        sizes = by_size(found)
        x, y = edges(found.mu), log_edges(found.size_m) if sizes else edges(found.b_over_h)
        colours = ListedColormap([COLOURS[mode] for mode in GOVERNING])
        axis.pcolormesh(x, y, found.governing, cmap=colours, vmin=-0.5, vmax=len(GOVERNING) - 0.5, rasterized=True)
        axis.set_xlim(max(x[0], 0.0), x[-1])
        axis.set_ylim(y[0] if sizes else max(y[0], 0.0), y[-1])
        axis.grid(False)
        if sizes:
            log_ticks(axis, y)
            _limits_of_sizes(axis, found)
        else:
            _limits_of_shapes(axis, found)
        _name_regions(axis, found, x, y)
        what = tell("2R = {size:.3g} m", size=found.size_m[0]) if not sizes else tell("b/h = {ratio:.3g}", ratio=found.b_over_h[0])
        push = tell("A = {ratio:.2f} at {time:.1f} s", ratio=found.loading, time=found.loading_time_s)
        axis.set_title(f"{name}, {what}; {push}", fontsize=9, loc="left", parse_math=False)
        canvas.label(axis, tell("friction μ"), ("2R (m)" if sizes else "b/h") if axis is axes[0] else "")
    handles: list[Any] = [
        Patch(facecolor=COLOURS[GOVERNING[i]], edgecolor="0.6", linewidth=0.5, label=tell(NAMES[GOVERNING[i]])) for i in seen
    ]
    for style, text in (
        (LIMIT, tell("where motion begins; A: largest push over weight")),
        (JUMP, tell("a corner holds to the right of this if A comes as a jump")),
    ):
        handles += axes[0].plot([], [], label=text, **style)
    canvas.legend_outside(made, handles, loc="outside lower center", ncols=min(2 * len(maps), 4))
    return made


def _limits_of_shapes(axis: Axes, found: ModeMap) -> None:
    """Draw the limits over friction and b/h: four regions that meet where both are A."""
    push = min(found.loading, 2.0 * max(axis.get_xlim()[1], axis.get_ylim()[1]))
    axis.plot([0.0, push], [0.0, push], **LIMIT)
    axis.plot([push, push], [push, 1e3], **LIMIT)
    axis.plot([push, 1e3], [push, push], **LIMIT)
    rocks = ~np.isnan(found.friction_to_rock)
    if rocks.any():
        order = np.argsort(found.b_over_h[rocks])
        needed, ratio = found.friction_to_rock[rocks][order], found.b_over_h[rocks][order]
        axis.plot([*needed, found.loading], [*ratio, found.loading], **JUMP)
    right, top = axis.get_xlim()[1], axis.get_ylim()[1]
    corner = 0.93 * min(push, right, top)
    _write(axis, corner, corner, "μ = b/h", ha="right", va="bottom")
    if push < NEAR * top and push < right:
        _write(axis, push, 0.98 * top, "μ = A", ha="right", va="top", rotation=90)
    if push < NEAR * right and push < top:
        _write(axis, 0.98 * right, push, "b/h = A", ha="right", va="bottom")


def _limits_of_sizes(axis: Axes, found: ModeMap) -> None:
    """Draw the limits over friction and size: the same for all sizes of a shape."""
    ratio = float(found.b_over_h[0])
    begins = min(ratio, found.loading)
    axis.axvline(begins, **LIMIT)
    right, top = axis.get_xlim()[1], axis.get_ylim()[1]
    if begins < right:
        _write(axis, begins, 0.9 * top, "μ = b/h" if ratio < found.loading else "μ = A", ha="right", va="top", rotation=90)
    needed = float(found.friction_to_rock[0])
    if not math.isnan(needed):
        axis.axvline(needed, **JUMP)


def _write(axis: Axes, x: float, y: float, text: str, **style: Any) -> None:
    """Write along a limit, readable on every colour."""
    away = (-3, 0) if "rotation" in style else (0, 3)
    axis.annotate(text, (x, y), away, textcoords="offset points", fontsize=8, path_effects=HALO, annotation_clip=True, **style)


def _name_regions(axis: Axes, found: ModeMap, x: FloatArray, y: FloatArray) -> None:
    """Write the name of each mode into the middle of its widest region, where there is room."""
    from scipy.ndimage import distance_transform_edt

    rows, columns = found.governing.shape
    for index in np.unique(found.governing):
        inside = np.pad(found.governing == index, 1)
        room = distance_transform_edt(inside, sampling=(1.0 / rows, 1.0 / columns))[1:-1, 1:-1]
        i, j = np.unravel_index(int(np.argmax(room)), room.shape)
        if room[i, j] >= ROOMY:
            dark = GOVERNING[index] in (FLIGHT, OVERTURNED)
            middle = math.sqrt(y[i] * y[i + 1]) if by_size(found) else 0.5 * (y[i] + y[i + 1])
            axis.text(
                0.5 * (x[j] + x[j + 1]),
                middle,
                tell(NAMES[GOVERNING[index]]),
                color="white" if dark else "0.1",
                fontsize=9,
                path_effects=[] if dark else HALO,
                ha="center",
                va="center",
                clip_on=True,
            )
