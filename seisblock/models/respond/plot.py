"""Figure of the full response: ground motion with thresholds, displacement, tilt and uplift, modes shaded."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from seisblock.bodies.body_name import body_name
from seisblock.core.i18n import gettext
from seisblock.core.results import Phase, Response
from seisblock.criteria.initiation import Mode
from seisblock.models.respond.options import effective_friction
from seisblock.models.respond.outcome import RespondOutcome
from seisblock.output.figures import style
from seisblock.output.figures.curves import draw_curve
from seisblock.output.figures.heading import motions_heading, object_label, panel_labels
from seisblock.output.figures.time_histories import Interval, history_columns, strong_motion_interval
from seisblock.output.units_display import Unit, acceleration_unit, length_unit

COLOURS: dict[str, str] = {Mode.SLIDE: "#eef2f9", Mode.ROCK: "#ecc3a6", Mode.SLIDE_ROCK: "#8f77b0", Mode.FLIGHT: "#84ae91"}
MIN_VISIBLE_SHARE = 1 / 2000
"""Shortest drawn phase over the interval shown; decaying impacts produce thousands of shorter ones."""

MIN_LIFT = 1e-4
"""Smallest drawn uplift, m."""

Responses = Sequence[Response[RespondOutcome]]


GROUND, DISPLACEMENT, TILT, LIFT = range(4)
"""Kinds of panels from top to bottom."""


@style.narrow_too
def figure(
    responses: Responses, *, gal: bool = True, probabilities: Sequence[float | None] = (), narrow: bool = False
) -> style.StyledFigure:
    """Return the figure: per component a column of ground acceleration and, if any, displacement, tilt and uplift.

    Columns side by side, or stacked if `narrow`.

    Parameters
    ----------
    responses : sequence of Response
    gal : bool
    probabilities : sequence of float or None
        Overturning probability of each response, where known.
    """
    panel_groups = [panel_kinds(response) for response in responses]
    rows = [len(kinds) for kinds in panel_groups]
    motions, stretches = [response.motion for response in responses], [motion_interval(response) for response in responses]
    width, height = (7.4, 1.2 + 1.75 * sum(rows)) if narrow else (2.0 + 5.4 * len(responses), 1.2 + 1.75 * max(rows))
    fig = style.titled_figure(motions_heading(motions), width=width, height=height)
    disp_unit = length_unit((item.outcome.max_displacement_m for item in responses), gal=gal)
    columns, names = history_columns(fig, motions, stretches, rows, narrow=narrow), panel_labels(motions)
    for index, (panels, name, response, kinds) in enumerate(zip(columns, names, responses, panel_groups, strict=True)):
        first, last = stretches[index]
        block, probability = response.body, probabilities[index] if probabilities else None
        friction = response.options.mu
        label = object_label(block.width, block.height, friction=friction, probability=probability, gal=gal, narrow=narrow)
        for kind, panel in zip(kinds, panels, strict=True):
            _draw_panel(kind, panel, name, response, disp_unit, label, gal=gal)
            style.shade_phases(panel, visible_phases(response.phases, first, last), COLOURS, names=kind == DISPLACEMENT)
            style.add_legend(panel)
    return fig


def panel_kinds(response: Response[RespondOutcome]) -> list[int]:
    """Return the kinds of panels of a response, without those of absent motion."""
    outcome = response.outcome
    has_displacement = outcome.max_displacement_m > 0.0 or outcome.slip_path_m > 0.0
    has_uplift = float(response["lift"].max()) >= MIN_LIFT
    flags = ((GROUND, True), (DISPLACEMENT, has_displacement), (TILT, outcome.max_rotation_rad > 0.0), (LIFT, has_uplift))
    return [kind for kind, is_present in flags if is_present]


def _draw_panel(
    kind: int, panel: Axes, panel_name: str, response: Response[RespondOutcome], disp_unit: Unit, label: str, *, gal: bool
) -> None:
    if kind == GROUND:
        _draw_ground(panel, panel_name, response, label, gal=gal)
    elif kind == DISPLACEMENT:
        _draw_curve(panel, response, response["displacement"] / disp_unit.size, gettext("x ({unit})", unit=disp_unit.name), style.SECOND)
    elif kind == TILT:
        _draw_tilt(panel, response)
    else:
        _draw_curve(
            panel, response, np.maximum(response["lift"], 0.0) / disp_unit.size, gettext("uplift ({unit})", unit=disp_unit.name), "#2e7d4f"
        )


def motion_interval(response: Response[RespondOutcome]) -> Interval:
    """Return the interval of motion with a margin, or the strong motion of the record without motion."""
    moving = [phase for phase in response.phases if phase.name in COLOURS]
    if not moving:
        return strong_motion_interval(response.motion)
    start, end = moving[0].start_s, moving[-1].end_s
    margin = 0.05 * (end - start) + 0.2
    return max(float(response.motion.time[0]), start - margin), min(float(response.time[-1]), end + margin)


def visible_phases(phases: Sequence[Phase], first: float, last: float) -> list[Phase]:
    """Return the phases long enough to be visible."""
    return [phase for phase in phases if phase.duration_s >= MIN_VISIBLE_SHARE * (last - first)]


def _draw_ground(axis: Axes, panel_name: str, response: Response[RespondOutcome], label: str, *, gal: bool) -> None:
    """Draw the ground acceleration with the rocking and sliding thresholds at rest."""
    unit, name = acceleration_unit(gal=gal)
    block, options = response.body, response.options
    right, left = block.arms
    gravity = options.gravity / unit
    draw_curve(axis, response.time, response["ground_acceleration"] / unit, color=style.INPUT)
    peak = float(np.abs(response["ground_acceleration"]).max()) / unit
    friction, dashes = effective_friction(options), ((0, (6, 2)), (0, (1.5, 1.5)))
    levels = [(-right / block.centre * gravity, left / block.centre * gravity, gettext("rocking threshold"))]
    if math.isfinite(friction):
        levels.append((-friction * gravity, friction * gravity, gettext("sliding threshold")))
    visible = style.fit_ylim(axis, peak, levels, name)
    for (low, high, text), dash, is_visible in zip(levels, dashes[: len(levels)], visible, strict=True):
        for level in (low, high) if is_visible else ():
            axis.axhline(level, color=style.THRESHOLD, linewidth=0.8, linestyle=dash, label=text if level == low else None)
    style.label_axes(axis, y=gettext("a ({unit})", unit=name))
    title = f"{panel_name}  " + gettext("{name}: {what}", name=gettext(body_name(block.name)), what=gettext(response.outcome.outcome))
    style.set_panel_title(axis, f"{title}\n{label}")


def _draw_curve(axis: Axes, response: Response[RespondOutcome], values: np.ndarray, text: str, colour: str) -> None:
    """Draw one channel of the response."""
    draw_curve(axis, response.time, values, color=colour, linewidth=1.1)
    style.label_axes(axis, y=text)


def _draw_tilt(axis: Axes, response: Response[RespondOutcome]) -> None:
    """Draw the tilt over alpha, up to 1.5."""
    alpha = min(response.body.slendernesses)
    _draw_curve(axis, response, response["rotation"] / alpha, gettext("θ/α"), style.ACCENT)
    peak = float(np.abs(response["rotation"]).max()) / alpha
    if peak > 0.8:
        style.draw_thresholds(axis, [-1.0, 1.0])
    limit = max(1.15 * min(peak, 1.5), 1e-3)
    axis.set_ylim(-limit, limit)
