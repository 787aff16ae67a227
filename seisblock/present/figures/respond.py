"""What a free-standing object does, in pictures: ground motion with its thresholds, displacement, lean and lift, modes shaded."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seisblock.present.figures import canvas
from seisblock.present.figures.curves import curve
from seisblock.present.figures.heading import heading_of, names_of
from seisblock.present.figures.histories import Stretch, columns_of, strong_stretch
from seisblock.present.scales import Unit, acceleration_unit, length_unit
from seisblock.present.text.onset import grip
from seisblock.results import Phase, Response
from seisblock.solvers.respond.outcome import RespondOutcome
from seisblock.solvers.respond.tale import FLIGHT, ROCK, SLIDE, SLIDE_ROCK
from seisblock.words import tell

COLOURS = {SLIDE: "#eef2f9", ROCK: "#ecc3a6", SLIDE_ROCK: "#8f77b0", FLIGHT: "#84ae91"}
SEEN = 1 / 2000
"""Phases shorter than this share of what is shown are not drawn: dying hops come by the thousand."""

LEAST_LIFT = 1e-4
"""Lift that is drawn, m: hops below a tenth of a millimetre are not to be seen."""

Responds = Sequence[Response[RespondOutcome]]


GROUND, DISPLACEMENT, LEAN, LIFT = range(4)
"""What a panel shows, from above downwards."""


def figure(responses: Responds, *, gal: bool = True) -> Figure:
    """Return the figure: per component a column with ground acceleration and, where it moves, leans, flies, what of this it did."""
    made = _drawn(responses, gal=gal)
    made.stacked = lambda: _drawn(responses, gal=gal, stacked=True)
    return made


def _drawn(responses: Responds, *, gal: bool, stacked: bool = False) -> canvas.Sheet:
    """Return the figure, its columns beside or below each other."""
    shown = [happened(response) for response in responses]
    rows = [len(kinds) for kinds in shown]
    motions, stretches = [response.motion for response in responses], [stretch(response) for response in responses]
    wide, high = (7.4, 1.2 + 1.75 * sum(rows)) if stacked else (2.0 + 5.4 * len(responses), 1.2 + 1.75 * max(rows))
    made = canvas.titled(heading_of(motions), width=wide, height=high)
    far = length_unit((each.outcome.max_displacement_m for each in responses), gal=gal)
    columns, names = columns_of(made, motions, stretches, rows, stacked=stacked), names_of(motions)
    for panels, name, response, kinds, (first, last) in zip(columns, names, responses, shown, stretches, strict=True):
        for kind, panel in zip(kinds, panels, strict=True):
            _draw(kind, panel, name, response, far, gal=gal)
            canvas.shade(panel, seen(response.phases, first, last), COLOURS, names=kind == DISPLACEMENT)
            canvas.legend(panel)
    return made


def happened(response: Response[RespondOutcome]) -> list[int]:
    """Return the panels of a response: what did not happen has none."""
    outcome = response.outcome
    moves = outcome.max_displacement_m > 0.0 or outcome.slip_path_m > 0.0
    flies = float(response["lift"].max()) >= LEAST_LIFT
    there = ((GROUND, True), (DISPLACEMENT, moves), (LEAN, outcome.max_rotation_rad > 0.0), (LIFT, flies))
    return [kind for kind, does in there if does]


def _draw(kind: int, panel: Axes, called: str, response: Response[RespondOutcome], far: Unit, *, gal: bool) -> None:
    """Draw one panel."""
    if kind == GROUND:
        _ground(panel, called, response, gal=gal)
    elif kind == DISPLACEMENT:
        _curve(panel, response, response["displacement"] / far.size, tell("x ({unit})", unit=far.name), canvas.SECOND)
    elif kind == LEAN:
        _lean(panel, response)
    else:
        _curve(panel, response, np.maximum(response["lift"], 0.0) / far.size, tell("lift ({unit})", unit=far.name), "#2e7d4f")


def stretch(response: Response[RespondOutcome]) -> Stretch:
    """Return the stretch of time worth drawing: from before it first moves until it rests, the record's strong part where it never does."""
    moving = [phase for phase in response.phases if phase.name in COLOURS]
    if not moving:
        return strong_stretch(response.motion)
    start, end = moving[0].start_s, moving[-1].end_s
    margin = 0.05 * (end - start) + 0.2
    return max(float(response.motion.time[0]), start - margin), min(float(response.time[-1]), end + margin)


def seen(phases: Sequence[Phase], first: float, last: float) -> list[Phase]:
    """Return the phases that are long enough to be seen."""
    return [phase for phase in phases if phase.duration_s >= SEEN * (last - first)]


def _ground(axis: Axes, called: str, response: Response[RespondOutcome], *, gal: bool) -> None:
    """Draw the ground acceleration with the levels at which it would slide and rock from rest."""
    unit, name = acceleration_unit(gal=gal)
    block, options = response.body, response.options
    right, left = block.arms
    gravity = options["gravity_m_s2"] / unit
    curve(axis, response.time, response["ground_acceleration"] / unit, color=canvas.INPUT)
    peak = float(np.abs(response["ground_acceleration"]).max()) / unit
    held, dashes = grip(options), ((0, (6, 2)), (0, (1.5, 1.5)))
    levels = [(-right / block.centre * gravity, left / block.centre * gravity, tell("rocks: b/h"))]
    if math.isfinite(held):
        levels.append((-held * gravity, held * gravity, tell("slides: μ")))
    near = canvas.within_reach(axis, peak, levels, name)
    for (low, high, text), dash, here in zip(levels, dashes[: len(levels)], near, strict=True):
        for level in (low, high) if here else ():
            axis.axhline(level, color=canvas.THRESHOLD, linewidth=0.8, linestyle=dash, label=text if level == low else None)
    canvas.label(axis, y=tell("a ({unit})", unit=name))
    title = f"{called}  " + tell("{name}: {what}", name=tell(block.name), what=tell(response.outcome.outcome))
    canvas.panel_title(axis, title)


def _curve(axis: Axes, response: Response[RespondOutcome], values: np.ndarray, text: str, colour: str) -> None:
    """Draw one curve of the response."""
    curve(axis, response.time, values, color=colour, linewidth=1.1)
    canvas.label(axis, y=text)


def _lean(axis: Axes, response: Response[RespondOutcome]) -> None:
    """Draw the lean over alpha, up to a little beyond what matters."""
    alpha = min(response.body.slendernesses)
    _curve(axis, response, response["rotation"] / alpha, tell("θ/α"), canvas.ACCENT)
    reach = float(np.abs(response["rotation"]).max()) / alpha
    if reach > 0.8:
        canvas.threshold(axis, [-1.0, 1.0])
    limit = max(1.15 * min(reach, 1.5), 1e-3)
    axis.set_ylim(-limit, limit)
