"""Figure of rocking: ground motion, tilt over alpha with impacts, phase plane."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.ticker import MaxNLocator

from seisblock.core.i18n import gettext
from seisblock.core.results import Response
from seisblock.models.rock.describe import RockResponses, flip_text
from seisblock.models.rock.model import RockPhase
from seisblock.models.rock.outcome import RockEvent, RockOutcome
from seisblock.output.figures import style
from seisblock.output.figures.curves import draw_curve, refine
from seisblock.output.figures.heading import motions_heading, object_label, panel_labels
from seisblock.output.figures.time_histories import Interval, history_columns, strong_motion_interval
from seisblock.output.units_display import acceleration_unit

MIN_TILT = 1e-4
"""Smallest drawn peak tilt over alpha."""

MAX_CHORD = 0.02
"""Longest chord in the phase plane over its half widths."""

MAX_STEP = 0.002
"""Longest time step drawn as a chord, over the interval shown."""

COLOURS: dict[str, str] = {
    RockPhase.TO_RIGHT: "#f6dfcf", RockPhase.TO_LEFT: "#a6b6dc", RockPhase.BEYOND_RIGHT: "#c27c58", RockPhase.BEYOND_LEFT: "#5262a4",
}  # fmt: skip


@style.narrow_too
def figure(
    responses: RockResponses, *, gal: bool = True, probabilities: Sequence[float | None] = (), narrow: bool = False
) -> style.StyledFigure:
    """Return the figure: per component acceleration with threshold band, tilt over alpha with impacts and phases, phase plane.

    Phase planes beside the time histories, or below if `narrow`.

    Parameters
    ----------
    responses : sequence of Response
    gal : bool
    probabilities : sequence of float or None
        Overturning probability of each response, where known.
    """
    tall = 6.4 if narrow else 3.6
    heights = [tall if is_visible(response) else 2.0 for response in responses]
    motions = [response.motion for response in responses]
    fig = style.titled_figure(motions_heading(motions), width=7.5 if narrow else 10.5, height=0.5 + sum(heights))
    rows = fig.subfigures(len(responses), 1, squeeze=False, height_ratios=heights)[:, 0]
    row_probabilities = probabilities or [None] * len(responses)
    for row, name, response, probability in zip(rows, panel_labels(motions), responses, row_probabilities, strict=True):
        block = response.body
        label = object_label(block.width, block.height, friction=None, probability=probability, gal=gal, narrow=narrow)
        if not is_visible(response):
            ((ground_axes,),) = history_columns(row, [response.motion], [strong_motion_interval(response.motion)], 1)
            draw_ground(ground_axes, response, name, label, gal=gal)
            continue
        left, right = row.subfigures(2, 1, height_ratios=(1.5, 1.0)) if narrow else row.subfigures(1, 2, width_ratios=(2.6, 1.0))
        ((ground_axes, tilt_axes),) = history_columns(left, [response.motion], [motion_interval(response)], 2)
        plane = right.add_subplot()
        style.style_axes(plane)
        draw_ground(ground_axes, response, name, label, gal=gal)
        draw_tilt(tilt_axes, response)
        _draw_plane(plane, response)
    return fig


def is_visible(response: Response[RockOutcome]) -> bool:
    """Return True if the peak tilt is large enough to be visible."""
    return response.outcome.rocking_start_s is not None and response.outcome.max_rotation_ratio >= MIN_TILT


def motion_interval(response: Response[RockOutcome]) -> Interval:
    """Return the interval of rocking with a margin, or the strong motion without rocking."""
    start = response.outcome.rocking_start_s
    if start is None:
        return strong_motion_interval(response.motion)
    moving = [phase for phase in response.phases if phase.name != RockPhase.REST]
    margin = 0.05 * (moving[-1].end_s - start) + 0.2
    return max(float(response.time[0]), start - margin), min(float(response.time[-1]), moving[-1].end_s + margin)


def draw_ground(axis: Any, response: Response[RockOutcome], panel_name: str, label: str, *, gal: bool) -> None:
    """Draw the ground acceleration over the band of rest."""
    unit, name = acceleration_unit(gal=gal)
    outcome, options = response.outcome, response.options
    weight = 1.0 + response["vertical_acceleration"] / options.gravity
    right, left = (
        arm / response.body.centre if not options.linear else alpha
        for arm, alpha in zip(response.body.arms, response.body.slendernesses, strict=True)
    )
    g = options.gravity / unit
    band = gettext("rest: |a| < {g} tan α", g="(g + a_v)" if options.vertical else "g")
    peak = float(np.abs(response["ground_acceleration"]).max()) / unit
    (band_visible,) = style.fit_ylim(axis, peak, [(-g * right, g * left, gettext("rocking threshold"))], name)
    if band_visible:
        axis.fill_between(response.time, -g * right * weight, g * left * weight, color="0.92", linewidth=0, label=band)
        if not options.vertical:
            style.draw_thresholds(axis, [-g * right, g * left])
    draw_curve(axis, response.time, response["ground_acceleration"] / unit, color=style.INPUT)
    style.label_axes(axis, y=gettext("a ({unit})", unit=name))
    style.add_legend(axis)
    title = gettext(
        "{name}  {body}: {what}; α {alpha:.3f} rad, e {restitution:.3f}",
        name=panel_name,
        body=gettext(response.body.name),
        what=gettext("overturned") if outcome.overturned else gettext("rocking") if outcome.rocks else gettext("rest"),
        alpha=outcome.slenderness_rad,
        restitution=outcome.restitution,
    )
    style.set_panel_title(axis, f"{title}{flip_text(outcome)}\n{label}")


def draw_tilt(axis: Any, response: Response[RockOutcome]) -> None:
    """Draw the tilt over alpha with phases and impacts."""
    alpha, (first, last) = response.outcome.slenderness_rad, axis.get_xlim()
    ratio = response["rotation"] / alpha
    style.shade_phases(axis, _visible_phases(response, first, last), COLOURS, names=True, direction=response.motion.name)
    inside = (response.time[1:] >= first) & (response.time[:-1] <= last)
    coarse = inside & (np.diff(response.time) > MAX_STEP * (last - first))
    time, refined, _ = refine(response.time, ratio, response["angular_velocity"] / alpha, coarse)
    draw_curve(axis, time, refined, color=style.ACCENT)
    style.draw_thresholds(axis, [-1.0, 1.0])
    peak = float(np.abs(ratio).max())
    limit = 1.6 if peak > 1.6 else max(1.15 * peak, 1e-3) if peak < 0.8 else 1.2
    limit = max(limit, 1.15 * min(peak, 1.4))
    axis.set_ylim(-limit, limit)
    impacts = [event.time_s for event in response.events if event.name == RockEvent.IMPACT]
    if impacts:
        axis.plot(
            impacts, np.full(len(impacts), -0.95 * limit), "|", color="0.2", markersize=5, markeredgewidth=0.6, label=gettext("impact")
        )
    if response.outcome.overturned:
        passing_time = response.outcome.alpha_passed_s
        if passing_time is not None and passing_time <= response.time[-1]:
            axis.axvline(passing_time, color=style.ACCENT, linewidth=0.8, linestyle=":", label=gettext("last passage of α"))
    style.label_axes(axis, y=gettext("θ/α"))
    style.add_legend(axis)


def _visible_phases(response: Response[RockOutcome], first: float, last: float) -> list[Any]:
    """Return the phases long enough to be visible; decaying impacts would produce thousands of bands."""
    return [phase for phase in response.phases if phase.duration_s > (last - first) / 2000]


def _draw_plane(axis: Any, response: Response[RockOutcome]) -> None:
    """Draw the phase plane: angular velocity over p alpha against tilt over alpha, with the separatrices of free rocking."""
    outcome = response.outcome
    alpha, p = outcome.slenderness_rad, outcome.frequency_parameter_rad_s
    lean, rate = response["rotation"] / alpha, response["angular_velocity"] / (p * alpha)
    tilt_limit = min(float(np.abs(lean).max()) * 1.1, 1.8)
    rate_limit = float(np.abs(rate[np.abs(lean) <= tilt_limit]).max()) * 1.1
    u = np.linspace(0.0, 2.0, 201)
    edge = np.abs(1 - u) if response.options.linear else 2 * np.abs(np.sin(alpha * (1 - u) / 2)) / alpha
    if np.any((u <= tilt_limit) & (edge <= rate_limit)):
        for sign in (1, -1):
            inward = np.where(u < 1, edge, -edge)
            label = gettext("separatrix of free rocking") if sign > 0 else None
            axis.plot(sign * u, sign * inward, color="0.3", linewidth=0.8, linestyle=(0, (4, 2)), label=label)
    # refine coarse steps in view, where a chord would be visible
    visible = (np.abs(lean) <= tilt_limit) & (np.abs(rate) <= rate_limit)
    coarse = np.hypot(np.diff(lean) / tilt_limit, np.diff(rate) / rate_limit) > MAX_CHORD
    _, lean, slope = refine(response.time, lean, p * rate, coarse & (visible[1:] | visible[:-1]))
    axis.plot(lean, slope / p, color=style.ACCENT, linewidth=0.7)
    axis.set_xlim(-tilt_limit, tilt_limit)
    axis.set_ylim(-rate_limit, rate_limit)
    axis.xaxis.set_major_locator(MaxNLocator(4))
    style.label_axes(axis, gettext("θ/α"), gettext("θ'/(p α)"))
    style.add_legend(axis)
