"""Figures of a parameter study of sliding ([Fujino1978]_ figs. 7, 9, 10, 15 and 16)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from seisblock.core.i18n import N_, gettext
from seisblock.criteria.sliding import min_friction_to_hold, min_friction_to_stop
from seisblock.output.figures import style
from seisblock.output.figures.heading import panel_label, records_heading
from seisblock.output.units_display import Unit, length_unit
from seisblock.records import Record, motion_of
from seisblock.report.text.slide_study import MIN_PLANE_SIZE, SYMBOLS, Arrangement, Points, group_by_direction, plotted_value

SLIP_LABEL = N_("max. sliding displacement ({unit})")
MIN_SHADE, MAX_SHADE = 1e-4, 10.0
"""Slip, m, at the white and black ends of the grey scale."""

ROUND_DIGITS = 9
"""Decimals to which friction ratios are considered equal."""


def figure(records: Sequence[Record], studies: Sequence[Points], *, slope_length: float | None, gravity: float, gal: bool = True) -> Figure:
    """Return the figure of the study: slip (or beta) over the parameter with most values, a curve per value of the others.

    A study of slope and friction is drawn as a map like [Fujino1978]_ fig. 16, with the criteria (14) and (15).
    """
    panels = [
        (record, title, part)
        for record, points in zip(records, studies, strict=True)
        for name, directed in group_by_direction(points, Arrangement.of(points))
        for title, part in _split_planes(panel_label(record, name, records), directed)
    ]
    directions = [point.component for points in studies for point in points]
    fig, axes = style.new_figure(
        1, columns=len(panels), width=2.0 + 4.5 * len(panels), height=4.6, sharey=True, title=records_heading(records, directions)
    )
    disp_unit = length_unit((point.max_slip_m for points in studies for point in points), gal=gal)
    for axis, (record, title, part) in zip(axes, panels, strict=True):
        if _is_plane(part):
            _draw_plane(axis, part, disp_unit)
            _draw_criteria(axis, part, record, gravity)
        else:
            _draw_curves(axis, part, slope_length, disp_unit)
        style.set_panel_title(axis, title)
    for axis in axes:
        axis.label_outer()
    if axes[0].get_ylabel() == gettext(SLIP_LABEL, unit=disp_unit.name):
        axes[0].set_ylim(bottom=0.0)
    return fig


def _is_plane(points: Points) -> bool:
    """Return True if slope and friction have enough values for a map."""
    return all(len({getattr(point, name) for point in points}) >= MIN_PLANE_SIZE for name in ("mu", "slope_deg"))


def _split_planes(title: str, points: Points) -> list[tuple[str, Points]]:
    """Split the points of a map by the remaining varied parameters, since a cell holds a single slip."""
    if not _is_plane(points):
        return [(title, points)]
    settings = list(dict.fromkeys((round(point.kappa, ROUND_DIGITS), point.vertical) for point in points))
    shared = [(len({values[i] for values in settings}) == 1) for i in (0, 1)]
    parts: list[tuple[str, Points]] = []
    for kappa, vertical in settings:
        labels = [f"κ {kappa:g}"] * (not shared[0]) + [f"γ {vertical:g}"] * (not shared[1])
        part = [point for point in points if (round(point.kappa, ROUND_DIGITS), point.vertical) == (kappa, vertical)]
        parts.append((", ".join([title, *labels]), part))
    return parts


def _draw_curves(axis: Any, points: Points, slope_length: float | None, disp_unit: Unit) -> None:
    """Draw curves like [Fujino1978]_ fig. 7 (slip), figs. 9 and 10 (beta), fig. 15 (slip on a slope)."""
    arrangement = Arrangement.of(points)
    ratio = any(point.beta is not None for point in points)
    names = list(dict.fromkeys(arrangement.name(point) for point in points))
    for index, name in enumerate(names):
        curve_points = sorted(
            (point for point in points if arrangement.name(point) == name), key=lambda point: float(getattr(point, arrangement.x))
        )
        x = [getattr(point, arrangement.x) for point in curve_points]
        y = [plotted_value(point, ratio) / (1.0 if ratio else disp_unit.size) for point in curve_points]
        share = index / max(len(names) - 1, 1)
        colour = style.ACCENT if len(names) == 1 else colormaps["plasma"](0.85 * share)
        marker = "os^Dvx"[index % 6] if len(x) <= 60 else ""
        axis.plot(x, y, color=colour, linewidth=1.1, marker=marker, markersize=3.5, label=name or None)
    if ratio:
        axis.axhline(1.0, color=style.INPUT, linewidth=0.7)
    if slope_length is not None and not ratio:
        axis.axhline(
            slope_length / disp_unit.size,
            color=style.THRESHOLD,
            linewidth=0.8,
            linestyle=(0, (6, 2, 1, 2)),
            label=gettext("foot of the slope"),
        )
    style.label_axes(axis, x=gettext(SYMBOLS[arrangement.x]), y="β (1)" if ratio else gettext(SLIP_LABEL, unit=disp_unit.name))
    style.add_legend(axis, loc="best", bbox_to_anchor=None, borderaxespad=0.5, ncols=1 if len(names) < 6 else 2)


def _draw_plane(axis: Any, points: Points, disp_unit: Unit) -> None:
    """Draw the map of maximum slip over slope and friction."""
    slopes = sorted({point.slope_deg for point in points})
    frictions = sorted({point.mu for point in points})
    slip = np.full((len(frictions), len(slopes)), np.nan)
    for point in points:
        if point.max_slip_m is not None:
            slip[frictions.index(point.mu), slopes.index(point.slope_deg)] = max(point.max_slip_m, MIN_SHADE)
    max_slip = float(np.nanmax(slip))
    norm = LogNorm(MIN_SHADE / disp_unit.size, min(max(max_slip, 100.0 * MIN_SHADE), MAX_SHADE) / disp_unit.size)
    mesh = axis.pcolormesh(slopes, frictions, slip / disp_unit.size, norm=norm, cmap="Greys", shading="nearest")
    axis.grid(False)
    bar = axis.figure.colorbar(mesh, ax=axis, pad=0.02, extend="max" if max_slip > MAX_SHADE else "neither")
    bar.set_label(gettext(SLIP_LABEL, unit=disp_unit.name), fontsize=9)
    bar.ax.tick_params(labelsize=8)


def _draw_criteria(axis: Any, points: Points, record: Record, gravity: float) -> None:
    """Draw the friction for static equilibrium, to stop sliding, eq. (14), and to prevent sliding in this record, eq. (15)."""
    angles = np.array([point.slope_deg for point in points])
    frictions = [point.mu for point in points]
    dense = np.linspace(angles.min(), angles.max(), 100)
    axis.plot(
        dense,
        np.tan(np.radians(np.abs(dense))),
        color=style.INPUT,
        linewidth=0.9,
        linestyle=(0, (1.2, 1.2)),
        label=gettext("static equilibrium: tan θ"),
    )
    for kappa in sorted({round(point.kappa, ROUND_DIGITS) for point in points if point.kappa > 0.0}):
        stops = [min_friction_to_stop(abs(angle), kappa) for angle in dense]
        axis.plot(dense, stops, color=style.ACCENT, linewidth=1.1, label=f"(14): tan θ / κ, κ {kappa:g}")
    motion = motion_of(record, points[0].component)
    for scale in dict.fromkeys(point.vertical for point in points):
        horizontal, vertical = motion.horizontal / gravity, scale * motion.vertical / gravity
        starts = [max(min_friction_to_hold(sign * angle, sign * horizontal, vertical).max() for sign in (1, -1)) for angle in dense]
        text = gettext("(15), this record") + (f", γ {scale:g}" if scale else "")
        axis.plot(dense, starts, color=style.SECOND, linewidth=1.1, linestyle=(0, (5, 1.5)), label=text)
    axis.set_ylim(min(frictions), max(frictions))
    style.label_axes(axis, x=gettext(SYMBOLS["slope_deg"]), y=SYMBOLS["mu"])
    style.add_legend(axis, loc="lower right", bbox_to_anchor=None, borderaxespad=0.5, ncols=1)
