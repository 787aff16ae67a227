"""A rocking spectrum in pictures: a heat map with the overturning region."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, ListedColormap
from matplotlib.figure import Figure

from seisblock.present.figures import canvas
from seisblock.present.text.spectrum import Spectra
from seisblock.typing import FloatArray
from seisblock.words import tell


def figure(spectra: Spectra, kind: str, gravity: float) -> Figure:
    """Return the figure: per component a map of size against slenderness, shaded by the lean, the overturning region in full colour."""
    made, axes = canvas.new_figure(1, columns=len(spectra), width=1.6 + 4.4 * len(spectra), height=4.6, sharey=True)
    grey = LinearSegmentedColormap.from_list("lean", ["white", "#c9d6e6", "#5d7fa6"])
    full = ListedColormap([canvas.ACCENT])
    shaded = None
    for axis, (motion, found) in zip(axes, spectra, strict=True):
        x, y = edges(np.degrees(found.slenderness_rad)), log_edges(found.size_m)
        lean = np.where(found.overturned, np.nan, found.max_rotation_ratio)
        if kind == "rocking":
            shaded = axis.pcolormesh(x, y, lean, cmap=grey, vmin=0.0, vmax=1.0, rasterized=True)
        axis.pcolormesh(x, y, np.where(found.overturned, 1.0, np.nan), cmap=full, rasterized=True)
        log_ticks(axis, y)
        still = math.degrees(math.atan(float(np.abs(motion.horizontal).max()) / gravity))
        if x.min() < still < x.max():
            axis.axvline(still, color=canvas.THRESHOLD, linewidth=0.8, linestyle=(0, (6, 2, 1, 2)), label="PGA = g tan α")
            canvas.legend(axis, loc="lower right", bbox_to_anchor=(1.0, 0.0))
        axis.set_title(tell("{name}: red overturns", name=motion.name), fontsize=9, loc="left")
        axis.grid(False)
        canvas.label(axis, tell("α (degrees)"), "2R (m)" if axis is axes[0] else "")
        top = axis.secondary_xaxis("top", functions=(_height_over_width, _degrees))
        top.set_xlabel(tell("H/B"), fontsize=8)
        top.set_xticks([k for k in (1.5, 2, 3, 4, 6, 10) if _degrees(k) >= x.min() and _degrees(k) <= x.max()])
        top.tick_params(labelsize=7)
    if shaded is not None:
        bar = made.colorbar(shaded, ax=axes, shrink=0.85, pad=0.02)
        bar.set_label(tell("largest lean over α (white: stands still)"), fontsize=8)
        bar.ax.tick_params(labelsize=7)
    return made


def log_ticks(axis: Axes, y: FloatArray) -> None:
    """Let the vertical axis be one of sizes, m, evenly in their logarithm, with plain numbers."""
    axis.set_yscale("log")
    sizes = [size for size in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20) if y.min() <= size <= y.max()]
    axis.set_yticks(sizes, [f"{size:g}" for size in sizes])
    axis.set_yticks([], minor=True)


def _height_over_width(degrees: Any) -> Any:
    """Return H/B of a slenderness in degrees."""
    return 1 / np.tan(np.radians(np.clip(degrees, 1e-3, 89.999)))


def _degrees(ratio: Any) -> Any:
    """Return the slenderness in degrees of an H/B."""
    return np.degrees(np.arctan(1 / np.clip(ratio, 1e-6, None)))


def edges(values: FloatArray) -> FloatArray:
    """Return the edges of cells with these middles, in the order of the middles."""
    if values.size == 1:
        return np.array([0.95 * values[0], 1.05 * values[0]])
    middle = (values[1:] + values[:-1]) / 2
    return np.concatenate([[2 * values[0] - middle[0]], middle, [2 * values[-1] - middle[-1]]])


def log_edges(values: FloatArray) -> FloatArray:
    """Return the edges of cells whose middles are even in their logarithm."""
    return np.exp(edges(np.log(values))) if values.size > 1 else edges(values)
