"""Rocking in pictures: ground motion, lean over alpha with impacts, and the phase plane."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from seisblock.present.figures import canvas
from seisblock.present.figures.curves import curve, finer
from seisblock.present.figures.heading import heading_of, names_of
from seisblock.present.figures.histories import Stretch, columns_of, strong_stretch
from seisblock.present.scales import acceleration_unit
from seisblock.present.text.rock import Rockings, flip
from seisblock.results import Response
from seisblock.solvers.rock.outcome import RockOutcome
from seisblock.words import tell

LEAST_LEAN = 1e-4
"""Lean over alpha that is drawn: what is less, a hair's breadth in a block of a metre, is no motion that one sees."""

LONGEST_CHORD = 0.02
"""Of the phase plane, a share of its half widths."""

LONGEST_STEP = 0.002
"""From sample to sample, a share of the time shown: in a longer one a chord would be seen."""

COLOURS = {"rocks to +x": "#f6dfcf", "rocks to -x": "#a6b6dc", "beyond +alpha": "#c27c58", "beyond -alpha": "#5262a4"}


def figure(responses: Rockings, *, gal: bool = True) -> Figure:
    """Return the figure: per component acceleration with its band, lean over alpha with impacts and phases, and the phase plane."""
    made = _drawn(responses, gal=gal)
    made.stacked = lambda: _drawn(responses, gal=gal, stacked=True)
    return made


def _drawn(responses: Rockings, *, gal: bool, stacked: bool = False) -> canvas.Sheet:
    """Return the figure, phase planes beside the histories or below them."""
    tall = 6.4 if stacked else 3.6
    heights = [tall if leans(response) else 2.0 for response in responses]
    motions = [response.motion for response in responses]
    made = canvas.titled(heading_of(motions), width=7.5 if stacked else 10.5, height=0.5 + sum(heights))
    rows = made.subfigures(len(responses), 1, squeeze=False, height_ratios=heights)[:, 0]
    for row, name, response in zip(rows, names_of(motions), responses, strict=True):
        if not leans(response):
            ((above,),) = columns_of(row, [response.motion], [strong_stretch(response.motion)], 1)
            draw_ground(above, response, name, gal=gal)
            continue
        left, right = row.subfigures(2, 1, height_ratios=(1.3, 1.0)) if stacked else row.subfigures(1, 2, width_ratios=(2.6, 1.0))
        ((above, below),) = columns_of(left, [response.motion], [stretch(response)], 2)
        plane = right.add_subplot()
        canvas.dress(plane)
        draw_ground(above, response, name, gal=gal)
        draw_lean(below, response)
        _draw_plane(plane, response)
    return made


def leans(response: Response[RockOutcome]) -> bool:
    """Return whether a block leans enough to be seen."""
    return response.outcome.rocking_start_s is not None and response.outcome.max_rotation_ratio >= LEAST_LEAN


def stretch(response: Response[RockOutcome]) -> Stretch:
    """Return the stretch of time worth drawing: all rocking, with a margin, or the strong part of the record when there is none."""
    start = response.outcome.rocking_start_s
    if start is None:
        return strong_stretch(response.motion)
    moving = [phase for phase in response.phases if phase.name != "rest"]
    margin = 0.05 * (moving[-1].end_s - start) + 0.2
    return max(float(response.time[0]), start - margin), min(float(response.time[-1]), moving[-1].end_s + margin)


def draw_ground(axis: Any, response: Response[RockOutcome], called: str, *, gal: bool) -> None:
    """Draw the ground acceleration over the band within which the block rests."""
    unit, name = acceleration_unit(gal=gal)
    outcome, options = response.outcome, response.options
    weight = 1.0 + response["vertical_acceleration"] / options["gravity_m_s2"]
    right, left = (
        arm / response.body.centre if not options["linear"] else alpha
        for arm, alpha in zip(response.body.arms, response.body.slendernesses, strict=True)
    )
    g = options["gravity_m_s2"] / unit
    band = tell("rests within ± {g} tan α", g="(g + a_v)" if options["vertical"] else "g")
    peak = float(np.abs(response["ground_acceleration"]).max()) / unit
    (near,) = canvas.within_reach(axis, peak, [(-g * right, g * left, tell("rocks beyond"))], name)
    if near:
        axis.fill_between(response.time, -g * right * weight, g * left * weight, color="0.92", linewidth=0, label=band)
        if not options["vertical"]:
            canvas.threshold(axis, [-g * right, g * left])
    curve(axis, response.time, response["ground_acceleration"] / unit, color=canvas.INPUT)
    canvas.label(axis, y=tell("a ({unit})", unit=name))
    canvas.legend(axis)
    title = tell(
        "{name}  {body}: {what}; α {alpha:.3f} rad, e {restitution:.3f}",
        name=called,
        body=tell(response.body.name),
        what=tell("overturns") if outcome.overturned else tell("rocks") if outcome.rocks else tell("stands still"),
        alpha=outcome.slenderness_rad,
        restitution=outcome.restitution,
    )
    canvas.panel_title(axis, title + flip(outcome))


def draw_lean(axis: Any, response: Response[RockOutcome]) -> None:
    """Draw the lean over alpha with its phases and impacts."""
    alpha, (first, last) = response.outcome.slenderness_rad, axis.get_xlim()
    ratio = response["rotation"] / alpha
    canvas.shade(axis, _seen(response, first, last), COLOURS, names=True, direction=response.motion.name)
    inside = (response.time[1:] >= first) & (response.time[:-1] <= last)
    coarse = inside & (np.diff(response.time) > LONGEST_STEP * (last - first))
    time, drawn, _ = finer(response.time, ratio, response["angular_velocity"] / alpha, coarse)
    curve(axis, time, drawn, color=canvas.ACCENT)
    canvas.threshold(axis, [-1.0, 1.0])
    reach = float(np.abs(ratio).max())
    limit = 1.6 if reach > 1.6 else max(1.15 * reach, 1e-3) if reach < 0.8 else 1.2
    limit = max(limit, 1.15 * min(reach, 1.4))
    axis.set_ylim(-limit, limit)
    impacts = [event.time_s for event in response.events if event.name == "impact"]
    if impacts:
        axis.plot(impacts, np.full(len(impacts), -0.95 * limit), "|", color="0.2", markersize=5, markeredgewidth=0.6, label=tell("impact"))
    if response.outcome.overturned:
        when = response.outcome.alpha_passed_s
        if when is not None and when <= response.time[-1]:
            axis.axvline(when, color=canvas.ACCENT, linewidth=0.8, linestyle=":", label=tell("α passed for good"))
    canvas.label(axis, y=tell("θ/α"))
    canvas.legend(axis)


def _seen(response: Response[RockOutcome], first: float, last: float) -> list[Any]:
    """Return the phases long enough to be seen in what is shown, so that dying hops do not become thousands of bands."""
    return [phase for phase in response.phases if phase.duration_s > (last - first) / 2000]


def _draw_plane(axis: Any, response: Response[RockOutcome]) -> None:
    """Draw the phase plane: angular velocity over p against lean over alpha, with the separatrices of free rocking."""
    outcome = response.outcome
    alpha, p = outcome.slenderness_rad, outcome.frequency_parameter_rad_s
    lean, rate = response["rotation"] / alpha, response["angular_velocity"] / (p * alpha)
    reach = min(float(np.abs(lean).max()) * 1.1, 1.8)
    high = float(np.abs(rate[np.abs(lean) <= reach]).max()) * 1.1
    u = np.linspace(0.0, 2.0, 201)
    edge = np.abs(1 - u) if response.options["linear"] else 2 * np.abs(np.sin(alpha * (1 - u) / 2)) / alpha
    if np.any((u <= reach) & (edge <= high)):
        # some of the edge is in sight
        for sign in (1, -1):
            inward = np.where(u < 1, edge, -edge)
            label = tell("edge of falling, unshaken") if sign > 0 else None
            axis.plot(sign * u, sign * inward, color="0.3", linewidth=0.8, linestyle=(0, (4, 2)), label=label)
    # from sample to sample as the state goes, where a chord would be seen
    seen = (np.abs(lean) <= reach) & (np.abs(rate) <= high)
    coarse = np.hypot(np.diff(lean) / reach, np.diff(rate) / high) > LONGEST_CHORD
    _, lean, slope = finer(response.time, lean, p * rate, coarse & (seen[1:] | seen[:-1]))
    axis.plot(lean, slope / p, color=canvas.ACCENT, linewidth=0.7)
    axis.set_xlim(-reach, reach)
    axis.set_ylim(-high, high)
    axis.xaxis.set_major_locator(MaxNLocator(4))
    canvas.label(axis, tell("θ/α"), tell("θ'/(p α)"))
    canvas.legend(axis)
