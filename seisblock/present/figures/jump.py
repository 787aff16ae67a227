"""A jump in pictures: acceleration with the threshold, tilt, rise, displacement."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from seisblock.present.figures import canvas
from seisblock.present.figures.between import with_points_between
from seisblock.present.figures.curves import curve
from seisblock.present.figures.heading import heading_of, names_of
from seisblock.present.figures.histories import Stretch, columns_of, strong_stretch
from seisblock.present.scales import Unit, acceleration_unit, length_unit
from seisblock.present.text.jump import Jumps
from seisblock.results import Response
from seisblock.solvers.jump.chain import FLIGHT, LANDED, ROCKING
from seisblock.solvers.jump.solve import JumpOutcome
from seisblock.words import noted, tell

QUANTITIES = tuple(map(noted, ("θ (deg)", "rise of G ({unit})", "x of G ({unit})")))
COLOURS = {ROCKING: "#f4d9c6", FLIGHT: "#8fb89b", LANDED: "#7183bb"}


def figure(responses: Jumps, *, gal: bool = True) -> Figure:
    """Return the figure: per component the record with its thresholds (fig. 12); where it rocks tilt, rise, displacement (fig. 14)."""
    made = _drawn(responses, gal=gal)
    made.stacked = lambda: _drawn(responses, gal=gal, stacked=True)
    return made


def _drawn(responses: Jumps, *, gal: bool, stacked: bool = False) -> canvas.Sheet:
    """Return the figure, its columns beside or below each other."""
    motions = [response.motion for response in responses]
    rows = [4 if response.outcome.chains else 1 for response in responses]
    wide, high = (8.0, 1.0 + 1.8 * sum(rows)) if stacked else (4.0 + 4.0 * len(responses), 1.0 + 1.8 * max(rows))
    made = canvas.titled(heading_of(motions), width=wide, height=high)
    columns = columns_of(made, motions, [stretch(r) for r in responses], rows, stacked=stacked)
    far = length_unit((float(np.abs(each["displacement"]).max()) for each in responses), gal=gal)
    for panels, name, response in zip(columns, names_of(motions), responses, strict=True):
        _column(panels, name, response, far, gal=gal)
    return made


def stretch(response: Response[JumpOutcome]) -> Stretch:
    """Return the stretch of time that holds all chains of motion, with a margin, or the strong part of the record when there is none."""
    if not response.outcome.chains:
        return strong_stretch(response.motion)
    first = response.outcome.chains[0].rocking_start_s
    last = max(phase.end_s for phase in response.phases if phase.name in COLOURS)
    margin = 0.15 * (last - first) + 0.2
    return max(first - margin, float(response.motion.time[0])), last + margin


def _column(panels: Sequence[Any], called: str, response: Response[JumpOutcome], far: Unit, *, gal: bool) -> None:
    """Draw one component's four panels: the first alone where nothing rocks."""
    motion, outcome = response.motion, response.outcome
    unit, name = acceleration_unit(gal=gal)
    curve(panels[0], motion.time, motion.horizontal / unit, color=canvas.INPUT)
    level = outcome.rocking_threshold_m_s2 / unit
    peak = float(np.abs(motion.horizontal).max()) / unit
    (near,) = canvas.within_reach(panels[0], peak, [(-level, level, tell("rocks beyond"))], name)
    if near:
        canvas.threshold(panels[0], [level, -level], tell("rocks beyond"))
    time, drawn = with_points_between(response)
    # in the air the rotation is even: points on a straight line would only be thinned out again
    leaning, tilt = with_points_between(response, [ROCKING])
    rise = drawn["height"] - response.body.centroid_height
    rows = (leaning, np.degrees(tilt["rotation"])), (time, rise / far.size), (time, drawn["displacement"] / far.size)
    for panel, row in zip(panels[1:], rows, strict=False):
        curve(panel, *row, longest_gap=1.5 * motion.dt, color=canvas.ACCENT)
    for panel in panels:
        canvas.shade(panel, response.phases, COLOURS, names=panel is panels[min(1, len(panels) - 1)])
    for panel in panels[:2]:
        canvas.legend(panel)
    canvas.panel_title(panels[0], tell("{name}: {what}", name=called, what=tell(response.body.name)))
    labels = tell("z'' ({unit})", unit=name), *(tell(text, unit=far.name) for text in QUANTITIES)
    for panel, text in zip(panels, labels, strict=False):
        canvas.label(panel, y=text)
