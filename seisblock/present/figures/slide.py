"""The three panels of [Fujino1978]_ figs. 8, 11 and 12."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from seisblock.present.figures import canvas
from seisblock.present.text.slide import Slides, setting
from seisblock.results import Response
from seisblock.solvers.slide.solve import SLIDING, SlideOutcome
from seisblock.typing import FloatArray
from seisblock.words import tell

COLOURS = {SLIDING[0]: "#f4d9c6", SLIDING[1]: "#d5dcef", "flight": "#cfe3d4"}


def figure(responses: Slides) -> Figure:
    """Return the figure: a column per direction; acceleration with the friction band, both velocities, relative displacement."""
    columns = len(responses)
    made, axes = canvas.new_figure(3, columns=columns, width=4.5 + 4.0 * columns, sharex="col", height=7.0)
    for index, response in enumerate(responses):
        _column([axes[row * columns + index] for row in range(3)], response)
    return made


def _column(panels: Sequence[Any], response: Response[SlideOutcome]) -> None:
    """Draw one direction's three panels."""
    time, phases = response.time, response.phases
    top, middle, bottom = panels
    lower, upper = response["lower_limit"], response["upper_limit"]
    canvas.curve(top, time, response["ground_acceleration"], color=canvas.INPUT)
    for index, limit in enumerate((lower, upper)):
        name = None if index else tell("limits of static friction")
        canvas.curve(top, time, limit, color=canvas.THRESHOLD, linestyle=(0, (6, 2, 1, 2)), label=name)
    block = response["ground_velocity"] + response["velocity"]
    canvas.curve(middle, time, response["ground_velocity"], color=canvas.INPUT, label=tell("base"))
    canvas.curve(middle, time, block, color=canvas.ACCENT, label=tell("object"))
    canvas.curve(bottom, time, response["displacement"] * 1e3, color=canvas.ACCENT)
    canvas.shade(middle, phases, COLOURS, names=True)
    canvas.shade(bottom, phases, COLOURS)
    bottom.axhline(0.0, color=canvas.INPUT, linewidth=0.6)
    for panel, text in zip(panels, map(tell, ("z'' (m/s²)", "velocity (m/s)", "x − z (mm)")), strict=True):
        canvas.label(panel, y=text)
        canvas.legend(panel)
    canvas.label(bottom, x=tell("t (s)"))
    top.set_title(f"{response.motion.name}: {setting(response)}", fontsize=9, loc="left")
    moving = _moving(time, phases)
    if moving is not None:
        bottom.set_xlim(*moving)


def _moving(time: FloatArray, phases: Sequence[Any]) -> tuple[float, float] | None:
    """Return the stretch of time that holds all sliding, with a margin, or None when nothing slides."""
    sliding = [phase for phase in phases if phase.name in COLOURS]
    if not sliding:
        return None
    first, last = sliding[0].start_s, sliding[-1].end_s
    margin = max(0.1 * (last - first), 0.5)
    return float(np.maximum(first - margin, time[0])), float(np.minimum(last + margin, time[-1]))
