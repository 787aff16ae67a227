"""Figures 7, 9, 10, 15 and 16 of [Fujino1978]_ from a parameter study of sliding."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from seisblock.criteria.sliding import friction_that_holds, friction_that_stops
from seisblock.present.figures import canvas
from seisblock.present.text.slide_study import PLANE, SYMBOLS, Arrangement, Points, panels_of, value_of
from seisblock.records import Record, motion_of
from seisblock.words import noted, tell

SLIP_LABEL = noted("largest slip (m)")
LEAST_SHADE = 1e-4
"""Slip, m, below which the plane stays white."""


def figure(records: Sequence[Record], studies: Sequence[Points], *, slope_length: float | None, gravity: float) -> Figure:
    """Return the figure of the study: slip (or beta) against the parameter with most values, one curve per value of the others.

    A study of both slope and friction is drawn as the plane of [Fujino1978]_ fig. 16, with the criteria (14) and (15).
    """
    panels = [
        (record, title, part)
        for record, points in zip(records, studies, strict=True)
        for title, part in panels_of(points, Arrangement.of(points))
    ]
    made, axes = canvas.new_figure(1, columns=len(panels), width=2.0 + 4.5 * len(panels), height=4.6, sharey=True)
    for axis, (record, title, part) in zip(axes, panels, strict=True):
        if all(len({getattr(point, name) for point in part}) >= PLANE for name in ("mu", "slope_deg")):
            _plane(axis, part)
            _criteria(axis, part, record, gravity)
        else:
            _curves(axis, part, slope_length)
        axis.set_title(title, fontsize=9, loc="left")
    if axes[0].get_ylabel() == tell(SLIP_LABEL):
        axes[0].set_ylim(bottom=0.0)
    return made


def _curves(axis: Any, points: Points, slope_length: float | None) -> None:
    """Draw curves as in [Fujino1978]_ fig. 7 (slip), figs. 9 and 10 (beta), fig. 15 (slip on a slope)."""
    arrangement = Arrangement.of(points)
    ratio = any(point.beta is not None for point in points)
    names = list(dict.fromkeys(arrangement.name(point) for point in points))
    for index, name in enumerate(names):
        mine = sorted(
            (point for point in points if arrangement.name(point) == name), key=lambda point: float(getattr(point, arrangement.x))
        )
        x = [getattr(point, arrangement.x) for point in mine]
        y = [value_of(point, ratio) for point in mine]
        share = index / max(len(names) - 1, 1)
        colour = canvas.ACCENT if len(names) == 1 else _shade(share)
        marker = "os^Dvx"[index % 6] if len(x) <= 60 else ""
        axis.plot(x, y, color=colour, linewidth=1.1, marker=marker, markersize=3.5, label=name or None)
    if ratio:
        axis.axhline(1.0, color=canvas.INPUT, linewidth=0.7)
    if slope_length is not None and not ratio:
        axis.axhline(slope_length, color=canvas.THRESHOLD, linewidth=0.8, linestyle=(0, (6, 2, 1, 2)), label=tell("foot of the slope"))
    canvas.label(axis, x=tell(SYMBOLS[arrangement.x]), y="β (1)" if ratio else tell(SLIP_LABEL))
    canvas.legend(axis, loc="best", bbox_to_anchor=None, borderaxespad=0.5, ncols=1 if len(names) < 6 else 2)


def _shade(share: float) -> Any:
    """Return a colour between the accents that also differs in grey."""
    return colormaps["plasma"](0.85 * share)


def _plane(axis: Any, points: Points) -> None:
    """Shade the plane of slope and friction by the largest slip."""
    slopes = sorted({point.slope_deg for point in points})
    frictions = sorted({point.mu for point in points})
    slip = np.full((len(frictions), len(slopes)), np.nan)
    for point in points:
        if point.max_slip_m is not None:
            slip[frictions.index(point.mu), slopes.index(point.slope_deg)] = max(point.max_slip_m, LEAST_SHADE)
    norm = LogNorm(LEAST_SHADE, max(float(np.nanmax(slip)), 100.0 * LEAST_SHADE))
    mesh = axis.pcolormesh(slopes, frictions, slip, norm=norm, cmap="Greys", shading="nearest")
    bar = axis.figure.colorbar(mesh, ax=axis, pad=0.02)
    bar.set_label(tell(SLIP_LABEL), fontsize=9)
    bar.ax.tick_params(labelsize=8)


def _criteria(axis: Any, points: Points, record: Record, gravity: float) -> None:
    """Draw what friction holds at rest, what stops a slide, eq. (14), and what starts one in this record, eq. (15)."""
    angles = np.array([point.slope_deg for point in points])
    frictions = [point.mu for point in points]
    dense = np.linspace(angles.min(), angles.max(), 100)
    axis.plot(dense, np.tan(np.radians(np.abs(dense))), color=canvas.INPUT, linewidth=0.9, label=tell("holds at rest: tan θ"))
    for kappa in sorted({point.kappa for point in points if point.kappa > 0.0})[:3]:
        stops = [friction_that_stops(abs(angle), kappa) for angle in dense]
        axis.plot(dense, stops, color=canvas.ACCENT, linewidth=1.1, label=f"(14): tan θ / κ, κ {kappa:g}")
    motion = motion_of(record, points[0].component)
    for scale, style in zip(list(dict.fromkeys(point.vertical for point in points))[:2], ("-", "--"), strict=False):
        starts = [friction_that_holds(angle, motion.horizontal / gravity, scale * motion.vertical / gravity).max() for angle in dense]
        axis.plot(
            dense, starts, style, color=canvas.SECOND, linewidth=1.1, label=tell("(15): this record") + (f", γ {scale:g}" if scale else "")
        )
    axis.set_ylim(min(frictions), max(frictions))
    canvas.label(axis, x=SYMBOLS["slope_deg"], y=SYMBOLS["mu"])
    canvas.legend(axis, ncols=3)
