"""A jump in pictures: acceleration with the threshold, tilt, rise, displacement."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from matplotlib.figure import Figure

from seisblock.present.figures import canvas
from seisblock.present.text.jump import Jumps
from seisblock.results import Response
from seisblock.solvers.jump.chain import FLIGHT, LANDED, ROCKING
from seisblock.solvers.jump.solve import JumpOutcome
from seisblock.words import tell

COLOURS = {ROCKING: "#f4d9c6", FLIGHT: "#cfe3d4", LANDED: "#d5dcef"}


def figure(responses: Jumps) -> Figure:
    """Return the figure: per component the record with its thresholds (fig. 12), tilt, rise and displacement (fig. 14)."""
    made, axes = canvas.new_figure(4, columns=len(responses), width=4.0 + 4.0 * len(responses), sharex="col")
    columns = len(responses)
    for index, response in enumerate(responses):
        panels = [axes[row * columns + index] for row in range(4)]
        _column(panels, response)
    return made


def _column(panels: Sequence[Any], response: Response[JumpOutcome]) -> None:
    """Draw one component's four panels."""
    import numpy as np

    motion, outcome = response.motion, response.outcome
    canvas.curve(panels[0], motion.time, motion.horizontal, color=canvas.INPUT)
    level = outcome.rocking_threshold_m_s2
    canvas.threshold(panels[0], [level, -level], "g x_G / y_G")
    rise = response["height"] - response.body.centroid_height
    for panel, values in zip(panels[1:], (np.degrees(response["rotation"]), rise * 1e3, response["displacement"] * 1e3), strict=True):
        canvas.curve(panel, response.time, values, longest_gap=1.5 * motion.dt, color=canvas.ACCENT)
    for panel in panels:
        canvas.shade(panel, response.phases, COLOURS, names=panel is panels[0])
    canvas.legend(panels[0])
    panels[0].set_title(f"{motion.name}: {tell(response.body.name)}", fontsize=9, loc="left")
    for panel, text in zip(panels, map(tell, ("z'' (m/s²)", "θ (deg)", "rise of G (mm)", "x of G (mm)")), strict=True):
        canvas.label(panel, y=text)
    canvas.label(panels[3], x=tell("t (s)"))
    if outcome.chains:
        first = outcome.chains[0].rocking_start_s
        last = max(phase.end_s for phase in response.phases if phase.name in COLOURS)
        margin = 0.15 * (last - first) + 0.2
        panels[3].set_xlim(first - margin, last + margin)
