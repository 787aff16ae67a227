"""A scanned body in pictures: what it stands on, seen from above, and how easily it turns towards each azimuth."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator

from seisblock.bodies.scan.azimuths import scan_azimuths
from seisblock.bodies.scan.body import ScannedBody
from seisblock.bodies.scan.scan import Scan
from seisblock.core.i18n import gettext
from seisblock.core.typing import FloatArray
from seisblock.report.figures import style

STEP_DEG = 1.0
"""Between the azimuths that are drawn."""

ROUND = 4
"""Rings of a rose."""

OUTLINE, BASE, CONTACT_AREA = "0.94", "#9cc3dc", "#2f5f8c"
"""What is seen from above, the sharp base, and what is left of it within worn edges; apart in grey."""


def figure(scan: Scan) -> Figure:
    """Return the figure of a scan: its plan with north up, and alpha and p all around."""
    fig = _build_figure(scan, narrow=False)
    fig.narrow_layout = lambda: _build_figure(scan, narrow=True)
    return fig


def _build_figure(scan: Scan, *, narrow: bool) -> style.StyledFigure:
    """Return the figure, its panels beside or below each other."""
    body = scan.body
    title = gettext("{name}: {mass:.4g} kg, {height:.3g} m high", name=body.name, mass=body.mass, height=body.height)
    fig = style.titled_figure(title, width=4.6 if narrow else 11.6, height=12.0 if narrow else 4.6)
    rows, columns = (3, 1) if narrow else (1, 3)
    _plan(fig.add_subplot(rows, columns, 1), scan)
    results = scan_azimuths(body, step_deg=STEP_DEG)
    azimuths = np.radians([result.azimuth_deg for result in results])
    for place, values, text in (
        (2, [math.degrees(result.slenderness_rad) for result in results], gettext("α (degrees)")),
        (3, [result.frequency_parameter_rad_s for result in results], gettext("p (rad/s)")),
    ):
        panel = fig.add_subplot(rows, columns, place, projection="polar")
        style_rose(panel, text, max(values))
        panel.plot(np.append(azimuths, azimuths[0]), [*values, values[0]], color=style.ACCENT, linewidth=1.3)
    return fig


def style_rose(panel: Any, title: str, largest: float) -> None:
    """Give a polar panel the common style: north up, azimuths clockwise, rings up to the largest value."""
    panel.set_theta_zero_location("N")
    panel.set_theta_direction(-1)
    panel.set_xticks(np.radians(np.arange(0, 360, 45)), [f"{azimuth}°" for azimuth in range(0, 360, 45)])
    panel.set_rlabel_position(22.5)
    panel.set_yticks([tick for tick in MaxNLocator(ROUND).tick_values(0.0, largest) if 0.0 < tick <= largest])
    panel.set_ylim(0.0, 1.1 * largest)
    panel.grid(True, color="0.88", linewidth=0.6)
    panel.spines["polar"].set_color("0.7")
    panel.tick_params(labelsize=style.TICK_LABEL_SIZE - 1)
    for label in panel.get_yticklabels():
        label.set_path_effects([withStroke(linewidth=2.0, foreground="white")])
    style.set_panel_title(panel, title)


def _plan(panel: Axes, scan: Scan) -> None:
    """Draw the body from above: its outline, its base, what of it carries, and the centre of gravity."""
    style.style_axes(panel)
    body = scan.body
    parts = [(np.array(scan.outline), OUTLINE, "0.6", gettext("outline")), (body.corners, BASE, "0.3", gettext("base polygon"))]
    if body.inset_m:
        parts.append((body.support_polygon, CONTACT_AREA, "0.1", gettext("within worn edges")))
    for corners, colour, edge, name in parts:
        east, north = _to_east_north(body, corners)
        panel.fill(east, north, facecolor=colour, edgecolor=edge, linewidth=0.8, label=name)
    east, north = _to_east_north(body, np.array([body.centre[:2]]))
    panel.plot(east, north, "+", color=style.ACCENT, markersize=9, markeredgewidth=1.6, label=gettext("centre of gravity"))
    panel.set_aspect("equal", adjustable="datalim")
    style.label_axes(panel, x=gettext("east (m)"), y=gettext("north (m)"))
    style.add_legend(panel, ncols=2)


def _to_east_north(body: ScannedBody, points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return points of the body to the east and to the north of its axis, m."""
    turn = math.radians(body.facing)
    x, y = points.T
    return x * math.sin(turn) - y * math.cos(turn), x * math.cos(turn) + y * math.sin(turn)
