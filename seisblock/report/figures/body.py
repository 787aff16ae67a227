"""Figure of a scanned body: plan of its base, and alpha and p over azimuth."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes

from seisblock.bodies.scan.azimuths import scan_azimuths
from seisblock.bodies.scan.body import ScannedBody
from seisblock.bodies.scan.scan import Scan
from seisblock.core.i18n import gettext
from seisblock.core.typing import FloatArray
from seisblock.output.figures import style
from seisblock.output.figures.rose import style_rose

STEP_DEG = 1.0
"""Step of azimuth, degrees."""

OUTLINE, BASE, CONTACT_AREA = "0.94", "#9cc3dc", "#2f5f8c"
"""Colours of outline, base polygon and support polygon, distinct in greyscale."""


@style.narrow_too
def figure(scan: Scan, *, narrow: bool = False) -> style.StyledFigure:
    """Return the figure of a scan: plan with north up, and alpha and p over azimuth.

    Panels side by side, or stacked if `narrow`.
    """
    body = scan.body
    title = gettext("{name}: {mass:.4g} kg, height {height:.3g} m", name=body.name, mass=body.mass, height=body.height)
    fig = style.titled_figure(title, width=4.6 if narrow else 11.6, height=12.0 if narrow else 4.6)
    rows, columns = (3, 1) if narrow else (1, 3)
    _plan(fig.add_subplot(rows, columns, 1), scan)
    results = scan_azimuths(body, step_deg=STEP_DEG)
    azimuths = np.radians([result.azimuth_deg for result in results])
    for place, values, text in (
        (2, [math.degrees(result.slenderness_rad) for result in results], gettext("α (deg)")),
        (3, [result.frequency_parameter_rad_s for result in results], gettext("p (rad/s)")),
    ):
        panel = fig.add_subplot(rows, columns, place, projection="polar")
        style_rose(panel, text, max(values))
        panel.plot(np.append(azimuths, azimuths[0]), [*values, values[0]], color=style.ACCENT, linewidth=1.3)
    return fig


def _plan(panel: Axes, scan: Scan) -> None:
    """Draw the plan: outline, base polygon, support polygon and centre of gravity."""
    style.style_axes(panel)
    body = scan.body
    parts = [(np.array(scan.outline), OUTLINE, "0.6", gettext("outline")), (body.corners, BASE, "0.3", gettext("base polygon"))]
    if body.inset_m:
        parts.append((body.support_polygon, CONTACT_AREA, "0.1", gettext("support polygon (edge wear)")))
    for corners, colour, edge, name in parts:
        east, north = _to_east_north(body, corners)
        panel.fill(east, north, facecolor=colour, edgecolor=edge, linewidth=0.8, label=name)
    east, north = _to_east_north(body, np.array([body.centre[:2]]))
    panel.plot(east, north, "+", color=style.ACCENT, markersize=9, markeredgewidth=1.6, label=gettext("centre of gravity"))
    panel.set_aspect("equal", adjustable="datalim")
    style.label_axes(panel, x=gettext("east (m)"), y=gettext("north (m)"))
    style.add_legend(panel, ncols=2)


def _to_east_north(body: ScannedBody, points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the east and north coordinates of points of the body from its axis, m."""
    turn = math.radians(body.facing)
    x, y = points.T
    return x * math.sin(turn) - y * math.cos(turn), x * math.cos(turn) + y * math.sin(turn)
