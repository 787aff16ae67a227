"""The three panels of [Fujino1978]_ figs. 8, 11 and 12."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from seisblock.present.figures import canvas
from seisblock.present.figures.curves import curve
from seisblock.present.figures.heading import heading_of, names_of
from seisblock.present.figures.histories import Stretch, columns_of, strong_stretch
from seisblock.present.scales import Unit, acceleration_unit, length_unit, velocity_unit
from seisblock.present.text.slide import Slides, setting
from seisblock.results import Response
from seisblock.solvers.slide.solve import SLIDING, SlideOutcome
from seisblock.words import tell

COLOURS = {SLIDING[0]: "#f6dfcf", SLIDING[1]: "#a6b6dc", "flight": "#6f9f7e"}
"""Apart in grey, too: as light as curves over them want, and no lighter."""


def figure(responses: Slides, *, gal: bool = True) -> Figure:
    """Return the figure: a column per direction; acceleration with the friction band and, where it slides, velocities and displacement."""
    made = _drawn(responses, gal=gal)
    made.stacked = lambda: _drawn(responses, gal=gal, stacked=True)
    return made


def _drawn(responses: Slides, *, gal: bool, stacked: bool = False) -> canvas.Sheet:
    """Return the figure, its columns beside or below each other."""
    motions = [response.motion for response in responses]
    rows = [3 if response.outcome.slips else 1 for response in responses]
    wide, high = (8.5, 1.0 + 2.0 * sum(rows)) if stacked else (4.5 + 4.0 * len(responses), 1.0 + 2.0 * max(rows))
    made = canvas.titled(heading_of(motions), width=wide, height=high)
    columns = columns_of(made, motions, [stretch(r) for r in responses], rows, stacked=stacked)
    far = length_unit((response.outcome.max_slip_m for response in responses), gal=gal)
    for panels, name, response in zip(columns, names_of(motions), responses, strict=True):
        _column(panels, name, response, far, gal=gal)
    return made


def _column(panels: Sequence[Any], called: str, response: Response[SlideOutcome], far: Unit, *, gal: bool) -> None:
    """Draw one direction's panels: the first alone where nothing slides."""
    unit, name = acceleration_unit(gal=gal)
    speed = velocity_unit(gal=gal)
    time, phases = response.time, response.phases
    top, *below = panels
    lower, upper = response["lower_limit"], response["upper_limit"]
    curve(top, time, response["ground_acceleration"] / unit, color=canvas.INPUT)
    peak = float(np.abs(response["ground_acceleration"]).max()) / unit
    levels = [(float(np.median(lower)) / unit, float(np.median(upper)) / unit, tell("limits of static friction"))]
    (near,) = canvas.within_reach(top, peak, levels, name)
    for index, limit in enumerate((lower, upper) if near else ()):
        text = None if index else tell("limits of static friction")
        curve(top, time, limit / unit, color=canvas.THRESHOLD, linestyle=(0, (6, 2, 1, 2)), label=text)
    if below:
        middle, bottom = below
        block = (response["ground_velocity"] + response["velocity"]) / speed.size
        curve(middle, time, response["ground_velocity"] / speed.size, color="0.62", linewidth=1.6, label=tell("ground"))
        curve(middle, time, block, color=canvas.ACCENT, label=tell("object"))
        curve(bottom, time, response["displacement"] / far.size, color=canvas.ACCENT)
        canvas.shade(middle, phases, COLOURS, names=True, direction=response.motion.name)
        canvas.shade(bottom, phases, COLOURS)
        bottom.axhline(0.0, color=canvas.INPUT, linewidth=0.6)
    labels = tell("z'' ({unit})", unit=name), tell("velocity ({unit})", unit=speed.name), tell("x − z ({unit})", unit=far.name)
    for panel, text in zip(panels, labels, strict=False):
        canvas.label(panel, y=text)
        canvas.legend(panel)
    canvas.panel_title(top, tell("{name}: {what}", name=called, what=setting(response)))


def stretch(response: Response[SlideOutcome]) -> Stretch:
    """Return the stretch of time that holds all sliding, with a margin, or the strong part of the record when nothing slides."""
    sliding = [phase for phase in response.phases if phase.name in COLOURS]
    if not sliding:
        return strong_stretch(response.motion)
    first, last = sliding[0].start_s, sliding[-1].end_s
    margin = max(0.1 * (last - first), 0.5)
    return max(first - margin, float(response.time[0])), min(last + margin, float(response.time[-1]))
