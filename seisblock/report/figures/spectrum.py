"""A rocking spectrum in pictures: a map of what stands still, what rocks, and how far, and what falls."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from seisblock.core.i18n import gettext
from seisblock.core.typing import FloatArray
from seisblock.report.figures import style
from seisblock.report.figures.heading import motions_heading, panel_labels
from seisblock.report.text.spectrum import Spectra

DASHES = (0, (6, 2, 1, 2))

REST_COLOUR, ROCKED_COLOUR, OVERTURNED_COLOUR = "#f6f6f2", "#b3d2e6", "#6b1f23"
"""What stands still, what rocks and stands, what falls: as in a map of modes, apart in grey and to every eye."""

LEAN_CMAP = LinearSegmentedColormap.from_list("lean", [ROCKED_COLOUR, "#3d6f9e"])
"""From the first hop to the edge of falling, none of it as light as what stands still or as dark as what falls."""


OVERTURNED_CMAP = LinearSegmentedColormap.from_list("falling", ["#e3b9a8", OVERTURNED_COLOUR])
"""From falling in one direction to falling in all."""


def figure(spectra: Spectra, kind: str, gravity: float) -> Figure:
    """Return the figure: per component a map of size against slenderness of what stands still, rocks (by how far it leans), and falls."""
    motions = [motion for motion, _ in spectra]
    fig, axes = style.new_figure(
        1, columns=len(spectra), width=1.6 + 4.4 * len(spectra), height=5.0, sharey=True, title=motions_heading(motions)
    )
    shaded, shares, states, limits = None, None, set(), False
    for axis, name, (motion, spectrum) in zip(axes, panel_labels(motions), spectra, strict=True):
        x, y = cell_edges(np.degrees(spectrum.slenderness_rad)), log_cell_edges(spectrum.size_m)
        rocked = ~spectrum.overturned & (spectrum.max_rotation_ratio > 0.0)
        state = np.where(spectrum.overturned, 2, np.where(rocked, 1, 0))
        states |= set(np.unique(state).tolist())
        axis.pcolormesh(
            x, y, state, cmap=ListedColormap([REST_COLOUR, ROCKED_COLOUR, OVERTURNED_COLOUR]), vmin=-0.5, vmax=2.5, rasterized=True
        )
        if kind == "rocking" and rocked.any():
            lean = np.where(rocked, spectrum.max_rotation_ratio, np.nan)
            shaded = axis.pcolormesh(x, y, lean, cmap=LEAN_CMAP, vmin=0.0, vmax=1.0, rasterized=True)
        if kind == "overturning" and spectrum.overturning_rate is not None:
            rates = np.where(spectrum.overturned, spectrum.overturning_rate, np.nan)
            shares = axis.pcolormesh(x, y, rates, cmap=OVERTURNED_CMAP, vmin=0.0, vmax=1.0, rasterized=True)
        style_size_axis(axis, y)
        rest_limit = math.degrees(math.atan(float(np.abs(motion.horizontal).max()) / gravity))
        if x.min() < rest_limit < x.max():
            axis.axvline(rest_limit, color=style.THRESHOLD, linewidth=0.8, linestyle=DASHES)
            limits = True
        axis.set_title(name, fontsize=9, loc="left", parse_math=False)
        axis.grid(False)
        style.label_axes(axis, gettext("α (degrees)"), "2R (m)" if axis is axes[0] else "")
        top = axis.secondary_xaxis("top", functions=(_height_over_width, _slenderness_degrees))
        top.set_xlabel(gettext("H/B"), fontsize=8)
        ratios = [k for k in (1.5, 2, 3, 4, 6, 10) if x.min() <= _slenderness_degrees(k) <= x.max()]
        top.set_xticks(ratios, [f"{k:g}" for k in ratios])
        top.tick_params(labelsize=7)
    if shaded is not None:
        bar = fig.colorbar(shaded, ax=axes, shrink=0.85, pad=0.02)
        bar.set_label(gettext("largest lean over α"), fontsize=8)
        bar.ax.tick_params(labelsize=7)
    if shares is not None:
        bar = fig.colorbar(shares, ax=axes, shrink=0.85, pad=0.02)
        bar.set_label(gettext("share of directions in which it falls"), fontsize=8)
        bar.ax.tick_params(labelsize=7)
    names = (gettext("stands still"), gettext("rocks and stands"), gettext("falls"))
    handles: list[Any] = [
        Patch(facecolor=(REST_COLOUR, ROCKED_COLOUR, OVERTURNED_COLOUR)[index], edgecolor="0.6", linewidth=0.5, label=names[index])
        for index in sorted(states)
    ]
    if limits:
        handles += axes[0].plot([], [], color=style.THRESHOLD, linewidth=0.8, linestyle=DASHES, label="PGA = g tan α")
    style.add_figure_legend(fig, handles, loc="outside lower center", ncols=2 * len(spectra))
    return fig


def style_size_axis(axis: Axes, y: FloatArray) -> None:
    """Let the vertical axis be one of sizes, m, evenly in their logarithm, with plain numbers."""
    axis.set_yscale("log")
    sizes = [size for size in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20) if y.min() <= size <= y.max()]
    axis.set_yticks(sizes, [f"{size:g}" for size in sizes])
    axis.set_yticks([], minor=True)


def _height_over_width(degrees: Any) -> Any:
    """Return H/B of a slenderness in degrees."""
    return 1 / np.tan(np.radians(np.clip(degrees, 1e-3, 89.999)))


def _slenderness_degrees(ratio: Any) -> Any:
    """Return the slenderness in degrees of an H/B."""
    return np.degrees(np.arctan(1 / np.clip(ratio, 1e-6, None)))


def cell_edges(values: FloatArray) -> FloatArray:
    """Return the edges of cells with these middles, in the order of the middles."""
    if values.size == 1:
        return np.array([0.95 * values[0], 1.05 * values[0]])
    middle = (values[1:] + values[:-1]) / 2
    return np.concatenate([[2 * values[0] - middle[0]], middle, [2 * values[-1] - middle[-1]]])


def log_cell_edges(values: FloatArray) -> FloatArray:
    """Return the edges of cells whose middles are even in their logarithm."""
    return np.exp(cell_edges(np.log(values))) if values.size > 1 else cell_edges(values)
