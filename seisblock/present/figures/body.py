"""A scanned body in pictures: what it stands on, seen from above, and how easily it turns towards each azimuth."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator

from seisblock.bodies.scan.body import ScannedBody
from seisblock.bodies.scan.directions import scan_azimuths
from seisblock.bodies.scan.scan import Scanned
from seisblock.present.figures import canvas
from seisblock.typing import FloatArray
from seisblock.words import tell

STEP_DEG = 1.0
"""Between the azimuths that are drawn."""

ROUND = 4
"""Rings of a rose."""

OUTLINE, BASE, CARRYING = "0.94", "#9cc3dc", "#2f5f8c"
"""What is seen from above, the sharp base, and what is left of it within worn edges; apart in grey."""


def figure(found: Scanned) -> Figure:
    """Return the figure of a scan: its plan with north up, and alpha and p all around."""
    made = _drawn(found, stacked=False)
    made.stacked = lambda: _drawn(found, stacked=True)
    return made


def _drawn(found: Scanned, *, stacked: bool) -> canvas.Sheet:
    """Return the figure, its panels beside or below each other."""
    body = found.body
    title = tell("{name}: {mass:.4g} kg, {height:.3g} m high", name=body.name, mass=body.mass, height=body.height)
    made = canvas.titled(title, width=4.6 if stacked else 11.6, height=12.0 if stacked else 4.6)
    rows, columns = (3, 1) if stacked else (1, 3)
    _plan(made.add_subplot(rows, columns, 1), found)
    around = scan_azimuths(body, step_deg=STEP_DEG)
    azimuths = np.radians([each.azimuth_deg for each in around])
    for place, values, text in (
        (2, [math.degrees(each.slenderness_rad) for each in around], tell("α (degrees)")),
        (3, [each.frequency_parameter_rad_s for each in around], tell("p (rad/s)")),
    ):
        panel = made.add_subplot(rows, columns, place, projection="polar")
        rose(panel, text, max(values))
        panel.plot(np.append(azimuths, azimuths[0]), [*values, values[0]], color=canvas.ACCENT, linewidth=1.3)
    return made


def rose(panel: Any, title: str, largest: float) -> None:
    """Give a polar panel the common style: north up, azimuths clockwise, rings up to the largest value."""
    panel.set_theta_zero_location("N")
    panel.set_theta_direction(-1)
    panel.set_xticks(np.radians(np.arange(0, 360, 45)), [f"{azimuth}°" for azimuth in range(0, 360, 45)])
    panel.set_rlabel_position(22.5)
    panel.set_yticks([tick for tick in MaxNLocator(ROUND).tick_values(0.0, largest) if 0.0 < tick <= largest])
    panel.set_ylim(0.0, 1.1 * largest)
    panel.grid(True, color="0.88", linewidth=0.6)
    panel.spines["polar"].set_color("0.7")
    panel.tick_params(labelsize=canvas.TICKS - 1)
    for label in panel.get_yticklabels():
        label.set_path_effects([withStroke(linewidth=2.0, foreground="white")])
    canvas.panel_title(panel, title)


def _plan(panel: Axes, found: Scanned) -> None:
    """Draw the body from above: its outline, its base, what of it carries, and the centre of gravity."""
    canvas.dress(panel)
    body = found.body
    parts = [(np.array(found.outline), OUTLINE, "0.6", tell("outline")), (body.corners, BASE, "0.3", tell("base polygon"))]
    if body.inset_m:
        parts.append((body.carrying, CARRYING, "0.1", tell("within worn edges")))
    for corners, face, edge, name in parts:
        east, north = _on_the_map(body, corners)
        panel.fill(east, north, facecolor=face, edgecolor=edge, linewidth=0.8, label=name)
    east, north = _on_the_map(body, np.array([body.centre[:2]]))
    panel.plot(east, north, "+", color=canvas.ACCENT, markersize=9, markeredgewidth=1.6, label=tell("centre of gravity"))
    panel.set_aspect("equal", adjustable="datalim")
    canvas.label(panel, x=tell("east (m)"), y=tell("north (m)"))
    canvas.legend(panel, ncols=2)


def _on_the_map(body: ScannedBody, points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return points of the body to the east and to the north of its axis, m."""
    turn = math.radians(body.facing)
    x, y = points.T
    return x * math.sin(turn) - y * math.cos(turn), x * math.cos(turn) + y * math.sin(turn)
