"""How a rocking spectrum is shown: a thinned table, all points as CSV, and a heat map with the overturning region."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.text import Text

from seisblock.present.files import write_table
from seisblock.present.tables import record_line, table
from seisblock.records import Motion
from seisblock.studies.spectra import RockingSpectrum
from seisblock.typing import FloatArray, IntArray

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Spectra = Sequence[tuple[Motion, RockingSpectrum]]

MOST_ROWS, MOST_COLUMNS = 12, 9
FALLS = "falls"


def document(motion: Motion, found: RockingSpectrum) -> dict[str, Any]:
    """Return one result of the JSON document: axes, and matrices with a row per size and a column per slenderness."""
    return {
        "component": motion.name,
        "size_m": found.size_m,
        "frequency_parameter_rad_s": found.frequency_parameter_rad_s,
        "slenderness_rad": found.slenderness_rad,
        "height_over_width": 1 / np.tan(found.slenderness_rad),
        "max_rotation_ratio": found.max_rotation_ratio,
        "overturned": found.overturned,
    }


def tables(spectra: Spectra, kind: str) -> Iterator[Any]:
    """Yield, per component, a table of at most 12 sizes and 9 slendernesses, and the share that falls."""
    last = None
    for motion, found in spectra:
        if motion.record is not None and motion.record is not last:
            last = motion.record
            yield record_line(motion.record)
        rows, columns = _thin(found.size_m.size, MOST_ROWS), _thin(found.slenderness_rad.size, MOST_COLUMNS)
        what = "overturning" if kind == "overturning" else "largest lean over alpha"
        heads = [f"{1 / math.tan(found.slenderness_rad[j]):.2f}" for j in columns]
        cells = [[f"{found.size_m[i]:.3g}", *(_cell(found, i, j, kind) for j in columns)] for i in rows]
        yield table(f"{motion.name}: {what}; down 2R (m), across H/B", ["2R \\ H/B", *heads], cells)
        total = found.overturned.size
        yield Text(f"{motion.name}: {int(found.overturned.sum())} of {total} blocks overturn.")
        yield Text()


def _cell(found: RockingSpectrum, i: int, j: int, kind: str) -> str:
    """Return one cell of the table."""
    if found.overturned[i, j]:
        return FALLS
    ratio = found.max_rotation_ratio[i, j]
    return "-" if ratio == 0.0 or kind == "overturning" else f"{ratio:.3f}"


def _thin(count: int, most: int) -> IntArray:
    """Return at most so many indices, evenly, with both ends."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(np.int64))


def write(path: Path, spectra: Spectra) -> None:
    """Write every block as a row of CSV, SI."""
    header = [
        "component", "size_m", "frequency_parameter_rad_s", "slenderness_rad", "height_over_width", "max_rotation_ratio", "overturned",
    ]  # fmt: skip
    write_table(path, header, (
        [motion.name, float(size), float(found.frequency_parameter_rad_s[i]), float(alpha), 1 / math.tan(alpha),
         float(found.max_rotation_ratio[i, j]), bool(found.overturned[i, j])]
        for motion, found in spectra
        for i, size in enumerate(found.size_m) for j, alpha in enumerate(found.slenderness_rad)
    ))  # fmt: skip


def figure(spectra: Spectra, kind: str, gravity: float) -> Figure:
    """Return the figure: per component a map of size against slenderness, shaded by the lean, the overturning region in full colour."""
    from matplotlib.colors import LinearSegmentedColormap, ListedColormap

    from seisblock.present import canvas

    made, axes = canvas.new_figure(1, columns=len(spectra), width=1.6 + 4.4 * len(spectra), height=4.6, sharey=True)
    grey = LinearSegmentedColormap.from_list("lean", ["white", "#c9d6e6", "#5d7fa6"])
    full = ListedColormap([canvas.ACCENT])
    shaded = None
    for axis, (motion, found) in zip(axes, spectra, strict=True):
        x, y = _edges(np.degrees(found.slenderness_rad)), _log_edges(found.size_m)
        lean = np.where(found.overturned, np.nan, found.max_rotation_ratio)
        if kind == "rocking":
            shaded = axis.pcolormesh(x, y, lean, cmap=grey, vmin=0.0, vmax=1.0, rasterized=True)
        axis.pcolormesh(x, y, np.where(found.overturned, 1.0, np.nan), cmap=full, rasterized=True)
        axis.set_yscale("log")
        sizes = [size for size in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20) if y.min() <= size <= y.max()]
        axis.set_yticks(sizes, [f"{size:g}" for size in sizes])
        axis.set_yticks([], minor=True)
        still = math.degrees(math.atan(float(np.abs(motion.horizontal).max()) / gravity))
        if x.min() < still < x.max():
            axis.axvline(still, color=canvas.THRESHOLD, linewidth=0.8, linestyle=(0, (6, 2, 1, 2)), label="PGA = g tan α")
            canvas.legend(axis, loc="lower right", bbox_to_anchor=(1.0, 0.0))
        axis.set_title(f"{motion.name}: red overturns", fontsize=9, loc="left")
        axis.grid(False)
        canvas.label(axis, "α (degrees)", "2R (m)" if axis is axes[0] else "")
        top = axis.secondary_xaxis("top", functions=(_height_over_width, _degrees))
        top.set_xlabel("H/B", fontsize=8)
        top.set_xticks([k for k in (1.5, 2, 3, 4, 6, 10) if _degrees(k) >= x.min() and _degrees(k) <= x.max()])
        top.tick_params(labelsize=7)
    if shaded is not None:
        bar = made.colorbar(shaded, ax=axes, shrink=0.85, pad=0.02)
        bar.set_label("largest lean over α (white: stands still)", fontsize=8)
        bar.ax.tick_params(labelsize=7)
    return made


def _height_over_width(degrees: Any) -> Any:
    """Return H/B of a slenderness in degrees."""
    return 1 / np.tan(np.radians(np.clip(degrees, 1e-3, 89.999)))


def _degrees(ratio: Any) -> Any:
    """Return the slenderness in degrees of an H/B."""
    return np.degrees(np.arctan(1 / np.clip(ratio, 1e-6, None)))


def _edges(values: FloatArray) -> FloatArray:
    """Return the edges of cells with these middles, in the order of the middles."""
    if values.size == 1:
        return np.array([0.95 * values[0], 1.05 * values[0]])
    middle = (values[1:] + values[:-1]) / 2
    return np.concatenate([[2 * values[0] - middle[0]], middle, [2 * values[-1] - middle[-1]]])


def _log_edges(values: FloatArray) -> FloatArray:
    """Return the edges of cells whose middles are even in their logarithm."""
    return np.exp(_edges(np.log(values))) if values.size > 1 else _edges(values)
