"""Figure of rocking and overturning spectra: map of rest, rocking (peak tilt) and overturning over size and slenderness."""

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
from seisblock.output.figures import style
from seisblock.output.figures.heading import motions_heading, panel_labels
from seisblock.report.text.spectrum import Spectra

DASHES = (0, (6, 2, 1, 2))

REST_COLOUR, ROCKED_COLOUR, OVERTURNED_COLOUR = "#f6f6f2", "#b3d2e6", "#6b1f23"
"""Colours of rest, rocking and overturning as in mode maps, distinct in greyscale and for colour-blind readers."""

TILT_CMAP = LinearSegmentedColormap.from_list("tilt", [ROCKED_COLOUR, "#3d6f9e"])
"""Colour map of peak tilt over alpha, between the colours of rest and overturning."""


OVERTURNED_CMAP = LinearSegmentedColormap.from_list("overturning", ["#e3b9a8", OVERTURNED_COLOUR])
"""Colour map of the fraction of azimuths with overturning."""


def figure(spectra: Spectra, kind: str, gravity: float) -> Figure:
    """Return the figure: per component a map of rest, rocking (peak tilt) and overturning over size and slenderness."""
    motions = [motion for motion, _ in spectra]
    fig, axes = style.new_figure(
        1, columns=len(spectra), width=1.6 + 4.4 * len(spectra), height=5.0, sharey=True, title=motions_heading(motions)
    )
    tilt_mesh, rate_mesh, states, limits = None, None, set(), False
    for axis, name, (motion, spectrum) in zip(axes, panel_labels(motions), spectra, strict=True):
        x, y = cell_edges(np.degrees(spectrum.slenderness_rad)), log_cell_edges(spectrum.size_m)
        rocked = ~spectrum.overturned & (spectrum.max_rotation_ratio > 0.0)
        state = np.where(spectrum.overturned, 2, np.where(rocked, 1, 0))
        states |= set(np.unique(state).tolist())
        axis.pcolormesh(
            x, y, state, cmap=ListedColormap([REST_COLOUR, ROCKED_COLOUR, OVERTURNED_COLOUR]), vmin=-0.5, vmax=2.5, rasterized=True
        )
        if kind == "rocking" and rocked.any():
            tilt = np.where(rocked, spectrum.max_rotation_ratio, np.nan)
            tilt_mesh = axis.pcolormesh(x, y, tilt, cmap=TILT_CMAP, vmin=0.0, vmax=1.0, rasterized=True)
        if kind == "overturning" and spectrum.overturning_rate is not None:
            rates = np.where(spectrum.overturned, spectrum.overturning_rate, np.nan)
            rate_mesh = axis.pcolormesh(x, y, rates, cmap=OVERTURNED_CMAP, vmin=0.0, vmax=1.0, rasterized=True)
        style_size_axis(axis, y)
        rest_limit = math.degrees(math.atan(float(np.abs(motion.horizontal).max()) / gravity))
        if x.min() < rest_limit < x.max():
            axis.axvline(rest_limit, color=style.THRESHOLD, linewidth=0.8, linestyle=DASHES)
            limits = True
        if len(spectra) > 1:
            axis.set_title(name, fontsize=9, loc="left", parse_math=False)
        axis.grid(False)
        style.label_axes(axis, gettext("α (deg)"), "2R (m)" if axis is axes[0] else "")
        top = axis.secondary_xaxis("top", functions=(_height_over_width, _slenderness_degrees))
        top.set_xlabel(gettext("H/B"), fontsize=8)
        ratios = [k for k in (1.5, 2, 3, 4, 6, 10) if x.min() <= _slenderness_degrees(k) <= x.max()]
        top.set_xticks(ratios, [f"{k:g}" for k in ratios])
        top.tick_params(labelsize=7)
    if tilt_mesh is not None:
        bar = fig.colorbar(tilt_mesh, ax=axes, shrink=0.85, pad=0.02)
        bar.set_label(gettext("peak tilt θ/α (1)"), fontsize=8)
        bar.ax.tick_params(labelsize=7)
    if rate_mesh is not None:
        bar = fig.colorbar(rate_mesh, ax=axes, shrink=0.85, pad=0.02)
        bar.set_label(gettext("fraction of azimuths with overturning (1)"), fontsize=8)
        bar.ax.tick_params(labelsize=7)
    names = (gettext("rest"), gettext("rocking"), gettext("overturning"))
    handles: list[Any] = [
        Patch(facecolor=(REST_COLOUR, ROCKED_COLOUR, OVERTURNED_COLOUR)[index], edgecolor="0.6", linewidth=0.5, label=names[index])
        for index in sorted(states)
    ]
    if limits:
        handles += axes[0].plot([], [], color=style.THRESHOLD, linewidth=0.8, linestyle=DASHES, label="PGA = g tan α")
    style.add_figure_legend(fig, handles, loc="outside lower center", ncols=2 * len(spectra))
    return fig


def style_size_axis(axis: Axes, y: FloatArray) -> None:
    """Set a logarithmic vertical axis of sizes, m, with plain numbers."""
    axis.set_yscale("log")
    sizes = [size for size in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20) if y.min() <= size <= y.max()]
    axis.set_yticks(sizes, [f"{size:g}" for size in sizes])
    axis.set_yticks([], minor=True)


def _height_over_width(degrees: Any) -> Any:
    """Return H/B of a slenderness, degrees."""
    return 1 / np.tan(np.radians(np.clip(degrees, 1e-3, 89.999)))


def _slenderness_degrees(ratio: Any) -> Any:
    """Return the slenderness, degrees, of an H/B."""
    return np.degrees(np.arctan(1 / np.clip(ratio, 1e-6, None)))


def cell_edges(values: FloatArray) -> FloatArray:
    """Return the edges, (n + 1,), of cells with given centres, (n,)."""
    if values.size == 1:
        return np.array([0.95 * values[0], 1.05 * values[0]])
    middle = (values[1:] + values[:-1]) / 2
    return np.concatenate([[2 * values[0] - middle[0]], middle, [2 * values[-1] - middle[-1]]])


def log_cell_edges(values: FloatArray) -> FloatArray:
    """Return the edges, (n + 1,), of cells with logarithmically spaced centres, (n,)."""
    return np.exp(cell_edges(np.log(values))) if values.size > 1 else cell_edges(values)
