"""Figure of uplift under a record: ground motion, corner displacements, plan."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import SubFigure
from matplotlib.patches import Rectangle

from seisblock.bodies.spring_block import CORNER_SIGNS
from seisblock.core.i18n import N_, gettext
from seisblock.core.results import Phase, Response
from seisblock.output.figures import style
from seisblock.output.figures.curves import draw_curve
from seisblock.output.figures.heading import motions_heading, panel_labels
from seisblock.output.figures.spans import span_patch
from seisblock.output.figures.time_histories import Interval, history_columns, strong_motion_interval
from seisblock.output.units_display import Unit, acceleration_unit, format_length, length_unit

if TYPE_CHECKING:
    from seisblock.models.uplift.outcome import UpliftOutcome

Uplifts = Sequence[Response["UpliftOutcome"]]

COLOURS = (style.ACCENT, style.SECOND, "#2e7d4f", "#8a6d1f", "#6b4c8a", "0.25")
LIFTED_COLOUR = style.BANDS[0]
IN_AIR = N_("uplift")
SUBSCRIPTS = "₁₂₃₄"


@style.narrow_too
def figure(responses: Uplifts, *, gal: bool = True, narrow: bool = False) -> style.StyledFigure:
    """Return the figure: ground motion, four corner displacements with uplift shaded, plan with the times of uplift.

    Columns side by side, or stacked if `narrow`, each above its plan.
    """
    motions = [response.motion for response in responses]
    columns, rows = (1, len(responses)) if narrow else (len(responses), 1)
    fig = style.titled_figure(motions_heading(motions), width=3.0 + 5.0 * columns, height=11.6 * rows)
    blocks = fig.subfigures(2 * rows, 1, height_ratios=(5.3, 2.6) * rows, squeeze=False)[:, 0]
    disp_unit = length_unit((corner.max_uplift_m for response in responses for corner in response.outcome.corners), gal=gal)
    names = panel_labels(motions)
    for row in range(rows):
        part = slice(row * columns, (row + 1) * columns)
        _draw_columns(blocks[2 * row], blocks[2 * row + 1], responses[part], names[part], disp_unit, gal=gal)
    return fig


def _draw_columns(
    history_figure: SubFigure, plan_figure: SubFigure, responses: Uplifts, names: Sequence[str], disp_unit: Unit, *, gal: bool
) -> None:
    """Draw columns side by side: time histories above, plans below."""
    spans = [motion_interval(response) for response in responses]
    plans = plan_figure.subplots(1, len(responses), squeeze=False)[0]
    histories = history_columns(history_figure, [response.motion for response in responses], spans, 5, heights=(1.3, 1, 1, 1, 1))
    for panels, plan, name, response, span in zip(histories, plans, names, responses, spans, strict=True):
        _draw_motion(panels[0], name, response, gal=gal)
        for i, panel in enumerate(panels[1:]):
            if i:
                panel.sharey(panels[1])
            _draw_corner(panel, response, i, disp_unit)
        style.style_axes(plan)
        _draw_plan(plan, response, *span)


def motion_interval(response: Response[UpliftOutcome]) -> Interval:
    """Return the interval of uplift with a margin, or the strong motion without uplift."""
    if not response.events:
        return strong_motion_interval(response.motion)
    start, end = float(response.motion.time[0]), float(response.motion.time[-1])
    first, last = response.events[0].time_s, response.events[-1].time_s
    margin = max(0.1 * (last - first), 1.0)
    return max(start, first - margin), min(end, last + margin)


def _draw_motion(panel: Axes, panel_name: str, response: Response[UpliftOutcome], *, gal: bool) -> None:
    """Draw the three components of the ground motion."""
    unit, unit_name = acceleration_unit(gal=gal)
    motion = response.motion
    names = gettext("along {name}", name=motion.name or "x"), gettext("transverse"), gettext("vertical")
    for values, name, colour in zip(motion.acceleration, names, ("0.2", "0.55", style.SECOND), strict=True):
        if np.any(values):
            draw_curve(panel, motion.time, values / unit, color=colour, label=name, linewidth=0.7)
    style.label_axes(panel, y=gettext("a ({unit})", unit=unit_name))
    style.add_legend(panel)
    style.set_panel_title(panel, gettext("{what}: {note}", what=f"+x = {panel_name or 'x'}", note=_block_label(response)))


def _block_label(response: Response[UpliftOutcome]) -> str:
    """Return size and vertical natural frequency of the block."""
    body = response.body
    size = f"{body.width:.3g} × {body.depth:.3g} × {body.height:.3g} m"
    return gettext("{size}, vertical {f:.3g} Hz", size=size, f=body.omega[2] / 2 / np.pi)


def _draw_corner(panel: Axes, response: Response[UpliftOutcome], i: int, disp_unit: Unit) -> None:
    """Draw the displacement of one corner with uplift shaded."""
    corner = response.outcome.corners[i]
    draw_curve(panel, response.time, response[f"uplift_{i + 1}"] / disp_unit.size, color=style.ACCENT)
    panel.axhline(0.0, color=style.THRESHOLD, linewidth=0.6)
    style.shade_phases(panel, _airborne_phases(response, i), {IN_AIR: LIFTED_COLOUR}, names=True)
    if i == 0:
        style.add_legend(panel)
    style.label_axes(panel, y=f"u{SUBSCRIPTS[i]} ({disp_unit.name})")
    sx, sy = ("+" if sign > 0 else "−" for sign in CORNER_SIGNS[i])
    if corner.uplifts:
        status = gettext("first uplift {time:.3f} s", time=corner.first_uplift_s)
        if response.outcome.within_model:
            status = gettext(
                "first uplift {time:.3f} s, maximum {most}", time=corner.first_uplift_s, most=format_length(corner.max_uplift_m, disp_unit)
            )
    else:
        status = gettext("no uplift")
    title = gettext("corner {number} ({place}): {status}", number=i + 1, place=f"{sx}x, {sy}y", status=status)
    panel.set_title(title, fontsize=8, loc="left", pad=2)


def _airborne_phases(response: Response[UpliftOutcome], i: int) -> list[Phase]:
    """Return the phases of uplift of a corner."""
    stretches: list[Phase] = []
    start = None
    for event in response.events:
        if event.name == f"corner {i + 1} lifts":
            start = event.time_s
        elif event.name == f"corner {i + 1} lands" and start is not None:
            stretches.append(Phase(IN_AIR, start, event.time_s))
            start = None
    if start is not None:
        stretches.append(Phase(IN_AIR, start, float(response.time[-1])))
    return stretches


def _draw_plan(panel: Axes, response: Response[UpliftOutcome], start: float, end: float) -> None:
    """Draw the plan of the base, with a time line of uplift at each corner."""
    body, outcome = response.body, response.outcome
    half_a, half_b = body.width / 2, body.depth / 2
    panel.grid(False)
    panel.set_aspect("equal")
    panel.add_patch(_rectangle((-half_a, -half_b), body.width, body.depth, facecolor="0.96", edgecolor="0.3"))
    length, tall = 1.1 * body.width, 0.11 * body.depth
    for i, (sx, sy) in enumerate(CORNER_SIGNS):
        corner = outcome.corners[i]
        x, y = sx * half_a, sy * half_b
        first = outcome.corner == i + 1
        panel.plot(
            x,
            y,
            "o",
            markersize=11 if corner.uplifts else 7,
            color=style.ACCENT if corner.uplifts else "0.7",
            markeredgecolor="0.1" if first else "none",
            markeredgewidth=1.8,
        )
        panel.annotate(f"{i + 1}", (x - sx * 0.13 * body.width, y - sy * 0.13 * body.depth), ha="center", va="center", fontsize=9)
        left = x + 0.1 * body.width if sx > 0 else x - 0.1 * body.width - length
        panel.add_patch(_rectangle((left, y - tall / 2), length, tall, facecolor="white", edgecolor="0.6", linewidth=0.6))
        scale, min_width = length / (end - start), 0.002 * length
        bars = [(left + (phase.start_s - start) * scale, phase.duration_s * scale) for phase in _airborne_phases(response, i)]
        spans = [(begin, begin + max(width, min_width)) for begin, width in bars]
        panel.add_patch(span_patch(spans, y - tall / 2, y + tall / 2, facecolor=style.ACCENT, linewidth=0))
        template = N_("uplift {time:.2f} s (first)") if first else N_("uplift {time:.2f} s")
        text = gettext(template, time=corner.uplift_duration_s) if corner.uplifts else gettext("no uplift")
        panel.annotate(text, (left, y + tall), fontsize=7, va="bottom")
    limit = half_a + 1.3 * body.width
    panel.set_xlim(-limit, limit)
    panel.set_ylim(-half_b - 0.35 * body.depth, half_b + 0.35 * body.depth)
    lines = [gettext("plan: uplift of each corner, {start:.1f} to {end:.1f} s", start=start, end=end)]
    if not outcome.within_model:
        lines.append(gettext("tilt beyond the range of the model: uplift not reliable"))
    panel.set_title("\n".join(lines), fontsize=8, loc="left", linespacing=1.4)
    style.label_axes(panel, x="x (m)", y="y (m)")


def _rectangle(corner: tuple[float, float], width: float, height: float, **style: Any) -> Any:
    return Rectangle(corner, width, height, **style)
