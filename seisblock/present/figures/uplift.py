"""Uplift under a record in pictures: motion, corners and plan."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure
from matplotlib.patches import Rectangle

from seisblock.bodies.spring_block import CORNERS
from seisblock.present.figures import canvas
from seisblock.present.figures.bars import bars
from seisblock.present.figures.curves import curve
from seisblock.present.figures.heading import heading_of, names_of
from seisblock.present.figures.histories import Stretch, columns_of, strong_stretch
from seisblock.present.scales import Unit, acceleration_unit, length_unit, told_length
from seisblock.results import Phase, Response
from seisblock.words import noted, tell

if TYPE_CHECKING:
    from seisblock.solvers.uplift.outcome import UpliftOutcome

Uplifts = Sequence[Response["UpliftOutcome"]]

COLOURS = (canvas.ACCENT, canvas.SECOND, "#2e7d4f", "#8a6d1f", "#6b4c8a", "0.25")
LIFTED = canvas.BANDS[0]
IN_AIR = noted("in the air")
SUBSCRIPTS = "₁₂₃₄"


def record_figure(responses: Uplifts, *, gal: bool = True) -> Figure:
    """Return ground motion, four corner displacements with uplift shaded, and a plan of which corner lifted when."""
    made = _drawn(responses, gal=gal)
    made.stacked = lambda: _drawn(responses, gal=gal, stacked=True)
    return made


def _drawn(responses: Uplifts, *, gal: bool, stacked: bool = False) -> canvas.Sheet:
    """Return the figure, its columns beside or below each other, each over its plan."""
    motions = [response.motion for response in responses]
    wide, down = (1, len(responses)) if stacked else (len(responses), 1)
    made = canvas.titled(heading_of(motions), width=3.0 + 5.0 * wide, height=11.6 * down)
    blocks = made.subfigures(2 * down, 1, height_ratios=(5.3, 2.6) * down, squeeze=False)[:, 0]
    far = length_unit((corner.max_uplift_m for response in responses for corner in response.outcome.corners), gal=gal)
    names = names_of(motions)
    for row in range(down):
        part = slice(row * wide, (row + 1) * wide)
        _columns(blocks[2 * row], blocks[2 * row + 1], responses[part], names[part], far, gal=gal)
    return made


def _columns(above: SubFigure, below: SubFigure, responses: Uplifts, names: Sequence[str], far: Unit, *, gal: bool) -> None:
    """Draw columns beside each other: histories above, plans below."""
    spans = [stretch(response) for response in responses]
    plans = below.subplots(1, len(responses), squeeze=False)[0]
    histories = columns_of(above, [response.motion for response in responses], spans, 5, heights=(1.3, 1, 1, 1, 1))
    for panels, plan, name, response, span in zip(histories, plans, names, responses, spans, strict=True):
        _motion(panels[0], name, response, gal=gal)
        for i, panel in enumerate(panels[1:]):
            if i:
                panel.sharey(panels[1])
            _corner(panel, response, i, far)
        canvas.dress(plan)
        _plan(plan, response, *span)


def stretch(response: Response[UpliftOutcome]) -> Stretch:
    """Return the stretch of time worth drawing: the uplifts, with a margin, the record's strong part where none is."""
    if not response.events:
        return strong_stretch(response.motion)
    start, end = float(response.motion.time[0]), float(response.motion.time[-1])
    first, last = response.events[0].time_s, response.events[-1].time_s
    margin = max(0.1 * (last - first), 1.0)
    return max(start, first - margin), min(end, last + margin)


def _motion(panel: Axes, called: str, response: Response[UpliftOutcome], *, gal: bool) -> None:
    """Draw the three components of the ground motion."""
    unit, unit_name = acceleration_unit(gal=gal)
    motion = response.motion
    names = tell("along {name}", name=motion.name or "x"), tell("across"), tell("up")
    for values, name, style in zip(motion.acceleration, names, ("0.2", "0.55", canvas.SECOND), strict=True):
        if np.any(values):
            curve(panel, motion.time, values / unit, color=style, label=name, linewidth=0.7)
    canvas.label(panel, y=tell("a ({unit})", unit=unit_name))
    canvas.legend(panel)
    canvas.panel_title(panel, f"+x = {called or 'x'}: {_size(response)}")


def _size(response: Response[UpliftOutcome]) -> str:
    """Return the block in words."""
    body = response.body
    size = f"{body.width:.3g} × {body.depth:.3g} × {body.height:.3g} m"
    return tell("{size}, {f:.3g} Hz vertical", size=size, f=body.omega[2] / 2 / np.pi)


def _corner(panel: Axes, response: Response[UpliftOutcome], i: int, far: Unit) -> None:
    """Draw the displacement of one corner, its uplift shaded."""
    corner = response.outcome.corners[i]
    curve(panel, response.time, response[f"uplift_{i + 1}"] / far.size, color=canvas.ACCENT)
    panel.axhline(0.0, color=canvas.THRESHOLD, linewidth=0.6)
    canvas.shade(panel, _in_air(response, i), {IN_AIR: LIFTED}, names=True)
    if i == 0:
        canvas.legend(panel)
    canvas.label(panel, y=f"u{SUBSCRIPTS[i]} ({far.name})")
    sx, sy = ("+" if sign > 0 else "−" for sign in CORNERS[i])
    if corner.uplifts:
        told = tell("first at {time:.3f} s", time=corner.first_uplift_s)
        if response.outcome.within_model:
            told = tell("first at {time:.3f} s, highest {most}", time=corner.first_uplift_s, most=told_length(corner.max_uplift_m, far))
    else:
        told = tell("never lifts")
    title = tell("corner {number} ({place}): {told}", number=i + 1, place=f"{sx}x, {sy}y", told=told)
    panel.set_title(title, fontsize=8, loc="left", pad=2)


def _in_air(response: Response[UpliftOutcome], i: int) -> list[Phase]:
    """Return the stretches in which a corner is in the air."""
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


def _plan(panel: Axes, response: Response[UpliftOutcome], start: float, end: float) -> None:
    """Draw the base from above; at each corner a time line of when it was in the air."""
    body, outcome = response.body, response.outcome
    half_a, half_b = body.width / 2, body.depth / 2
    panel.grid(False)
    panel.set_aspect("equal")
    panel.add_patch(_rectangle((-half_a, -half_b), body.width, body.depth, facecolor="0.96", edgecolor="0.3"))
    length, tall = 1.1 * body.width, 0.11 * body.depth
    for i, (sx, sy) in enumerate(CORNERS):
        corner = outcome.corners[i]
        x, y = sx * half_a, sy * half_b
        first = outcome.corner == i + 1
        panel.plot(
            x,
            y,
            "o",
            markersize=11 if corner.uplifts else 7,
            color=canvas.ACCENT if corner.uplifts else "0.7",
            markeredgecolor="0.1" if first else "none",
            markeredgewidth=1.8,
        )
        panel.annotate(f"{i + 1}", (x - sx * 0.13 * body.width, y - sy * 0.13 * body.depth), ha="center", va="center", fontsize=9)
        left = x + 0.1 * body.width if sx > 0 else x - 0.1 * body.width - length
        panel.add_patch(_rectangle((left, y - tall / 2), length, tall, facecolor="white", edgecolor="0.6", linewidth=0.6))
        scale, least = length / (end - start), 0.002 * length
        begins = [(left + (each.start_s - start) * scale, each.duration_s * scale) for each in _in_air(response, i)]
        spans = [(begin, begin + max(wide, least)) for begin, wide in begins]
        panel.add_patch(bars(spans, y - tall / 2, y + tall / 2, facecolor=canvas.ACCENT, linewidth=0))
        aloft = noted("{time:.2f} s in the air, the first") if first else noted("{time:.2f} s in the air")
        told = tell(aloft, time=corner.uplift_duration_s) if corner.uplifts else tell("never lifts")
        panel.annotate(told, (left, y + tall), fontsize=7, va="bottom")
    reach = half_a + 1.3 * body.width
    panel.set_xlim(-reach, reach)
    panel.set_ylim(-half_b - 0.35 * body.depth, half_b + 0.35 * body.depth)
    lines = [tell("plan: when each corner was in the air, {start:.1f} to {end:.1f} s", start=start, end=end)]
    if not outcome.within_model:
        lines.append(tell("leans beyond what the model holds for: heights are not to be believed"))
    panel.set_title("\n".join(lines), fontsize=8, loc="left", linespacing=1.4)
    canvas.label(panel, x="x (m)", y="y (m)")


def _rectangle(corner: tuple[float, float], width: float, height: float, **style: Any) -> Any:
    """Return a rectangle."""
    return Rectangle(corner, width, height, **style)
