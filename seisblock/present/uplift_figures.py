"""Figures of uplift: motion, corners and plan under a record; regions and frequencies under harmonic shaking."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seisblock.bodies.spring_block import CORNERS
from seisblock.present import canvas
from seisblock.present.uplift_harmonic import SYMBOLS, title, varied_names
from seisblock.results import Phase, Response
from seisblock.studies.uplift_regions import UpliftRegion, frequencies_against

if TYPE_CHECKING:
    from seisblock.solvers.uplift import UpliftOutcome

STYLES = ("-", (0, (5, 1.5)), (0, (1.5, 1.2)), (0, (6, 1.5, 1.5, 1.5)), (0, (3, 1, 1, 1, 1, 1)), (0, (8, 3)))
"""Lines that stay apart in grey."""

COLOURS = (canvas.ACCENT, canvas.SECOND, "#2e7d4f", "#8a6d1f", "#6b4c8a", "0.25")
LIFTED = canvas.BANDS[0]


def record_figure(responses: Sequence[Response[UpliftOutcome]]) -> Figure:
    """Return ground motion, four corner displacements with uplift shaded, and a plan of which corner lifted when."""
    columns = len(responses)
    made, axes = canvas.new_figure(
        6, columns=columns, width=3.0 + 5.0 * columns, height=12.0, sharex=False, gridspec_kw={"height_ratios": [1.3, 1, 1, 1, 1, 2.6]}
    )
    for index, response in enumerate(responses):
        panels = [axes[row * columns + index] for row in range(6)]
        _motion(panels[0], response)
        for i, panel in enumerate(panels[1:5]):
            panel.sharex(panels[0])
            panel.sharey(panels[1])
            _corner(panel, response, i)
        for panel in panels[:4]:
            panel.tick_params(labelbottom=False)
        canvas.label(panels[4], x="t (s)")
        start, end = _span(response)
        panels[0].set_xlim(start, end)
        _plan(panels[5], response, start, end)
    return made


def _span(response: Response[UpliftOutcome]) -> tuple[float, float]:
    """Return the stretch of time worth drawing: all of it, or the uplifts with as much again around them."""
    start, end = float(response.motion.time[0]), float(response.motion.time[-1])
    if not response.events:
        return start, end
    first, last = response.events[0].time_s, response.events[-1].time_s
    margin = max(0.5 * (last - first), 1.0)
    return max(start, first - margin), min(end, last + margin)


def _motion(panel: Axes, response: Response[UpliftOutcome]) -> None:
    """Draw the three components of the ground motion."""
    motion = response.motion
    for values, name, style in zip(motion.acceleration, ("along +x", "across", "up"), ("0.2", "0.55", canvas.SECOND), strict=True):
        if np.any(values):
            canvas.curve(panel, motion.time, values, color=style, label=name, linewidth=0.7)
    canvas.label(panel, y="a (m/s²)")
    canvas.legend(panel)
    panel.set_title(f"+x = {motion.name or 'along'}: {_size(response)}", fontsize=9, loc="left")


def _size(response: Response[UpliftOutcome]) -> str:
    """Return the block in words."""
    body = response.body
    return f"{body.width:g} × {body.depth:g} × {body.height:g} m, {body.omega[2] / 2 / np.pi:.3g} Hz vertical"


def _corner(panel: Axes, response: Response[UpliftOutcome], i: int) -> None:
    """Draw the displacement of one corner, its uplift shaded."""
    corner = response.outcome.corners[i]
    canvas.curve(panel, response.time, response[f"uplift_{i + 1}"] * 1e3, color=canvas.ACCENT)
    panel.axhline(0.0, color=canvas.THRESHOLD, linewidth=0.6)
    canvas.shade(panel, _in_air(response, i), {"in the air": LIFTED})
    canvas.label(panel, y=f"$u_{i + 1}$ (mm)")
    sx, sy = ("+" if sign > 0 else "−" for sign in CORNERS[i])
    told = f"first at {corner.first_uplift_s:.3f} s, highest {corner.max_uplift_m * 1e3:.3g} mm" if corner.uplifts else "never lifts"
    panel.set_title(f"corner {i + 1} ({sx}x, {sy}y): {told}", fontsize=8, loc="left", pad=2)


def _in_air(response: Response[UpliftOutcome], i: int) -> list[Phase]:
    """Return the stretches in which a corner is in the air."""
    stretches: list[Phase] = []
    start = None
    for event in response.events:
        if event.name == f"corner {i + 1} lifts":
            start = event.time_s
        elif event.name == f"corner {i + 1} lands" and start is not None:
            stretches.append(Phase("in the air", start, event.time_s))
            start = None
    if start is not None:
        stretches.append(Phase("in the air", start, float(response.time[-1])))
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
        panel.plot(x, y, "o", markersize=11 if corner.uplifts else 7, color=canvas.ACCENT if corner.uplifts else "0.7",
                   markeredgecolor="0.1" if first else "none", markeredgewidth=1.8)  # fmt: skip
        panel.annotate(f"{i + 1}", (x - sx * 0.13 * body.width, y - sy * 0.13 * body.depth), ha="center", va="center", fontsize=9)
        left = x + 0.1 * body.width if sx > 0 else x - 0.1 * body.width - length
        panel.add_patch(_rectangle((left, y - tall / 2), length, tall, facecolor="white", edgecolor="0.6", linewidth=0.6))
        for stretch in _in_air(response, i):
            wide = max((stretch.end_s - stretch.start_s) / (end - start) * length, 0.002 * length)
            panel.add_patch(_rectangle((left + (stretch.start_s - start) / (end - start) * length, y - tall / 2), wide, tall,
                                       facecolor=canvas.ACCENT, linewidth=0))  # fmt: skip
        told = f"{corner.uplift_duration_s:.2f} s in the air" if corner.uplifts else "never lifts"
        panel.annotate(told + (", the first" if first else ""), (left, y + tall), fontsize=7, va="bottom")
    reach = half_a + 1.3 * body.width
    panel.set_xlim(-reach, reach)
    panel.set_ylim(-half_b - 0.35 * body.depth, half_b + 0.35 * body.depth)
    panel.set_title(f"plan: when each corner was in the air, {start:.4g} to {end:.4g} s", fontsize=8, loc="left")
    canvas.label(panel, x="x (m)", y="y (m)")


def _rectangle(corner: tuple[float, float], width: float, height: float, **style: Any) -> Any:
    """Return a rectangle."""
    from matplotlib.patches import Rectangle

    return Rectangle(corner, width, height, **style)


def harmonic_figure(regions: Sequence[UpliftRegion], figure: int | None = None) -> Figure:
    """Return the uplift regions beside the natural frequencies; or one figure of [Okumura1987]_ alone."""
    if figure in (3, 4):
        made, (panel,) = canvas.new_figure(1, width=6.5, height=5.0)
        _frequencies(panel, regions, "beta" if figure == 3 else "alpha")
        panel.set_title(f"as fig. {figure}", fontsize=9, loc="left")
        return made
    if figure is not None:
        made, (panel,) = canvas.new_figure(1, width=7.5, height=5.0)
        _regions(panel, regions)
        panel.set_title(f"as fig. {figure}: {panel.get_title(loc='left')}", fontsize=9, loc="left")
        return made
    made, panels = canvas.new_figure(1, columns=3, width=15.0, height=4.8, sharex=False, gridspec_kw={"width_ratios": [1.7, 1, 1]})
    _regions(panels[0], regions)
    _frequencies(panels[1], regions, "beta")
    _frequencies(panels[2], regions, "alpha")
    return made


def _regions(panel: Axes, regions: Sequence[UpliftRegion]) -> None:
    """Draw the least A/g that lifts against theta/omega_1, as [Okumura1987]_ figs. 6 to 11."""
    names = varied_names(regions)
    for index, region in enumerate(regions):
        colour = COLOURS[index % len(COLOURS)]
        panel.plot(
            region.frequency_ratio, np.minimum(region.acceleration_ratio, 1e3), color=colour, linewidth=1.3,
            linestyle=STYLES[index % len(STYLES)], label=title(region, names) if names else None,
        )  # fmt: skip
        seen = [m for m in region.minima if m.acceleration_ratio > 0.0]
        panel.plot([m.frequency_ratio for m in seen], [m.acceleration_ratio for m in seen], "o", color=colour, markersize=3.5)
    if len(regions) == 1:
        only = regions[0]
        panel.fill_between(only.frequency_ratio, np.minimum(only.acceleration_ratio, 10.0), 10.0, color=LIFTED, alpha=0.6, linewidth=0)
        panel.text(only.minimum.frequency_ratio, 0.8, "a corner lifts", ha="center", fontsize=8)
    panel.set_ylim(0.0, 1.0)
    panel.set_xlim(*_reach(regions))
    canvas.label(panel, x=r"$\theta/\omega_1$", y="A/g")
    fixed = [name for name in SYMBOLS if name not in names]
    rule = "least of four corners" if regions[0].corner is None else f"corner {regions[0].corner}"
    panel.set_title(f"{title(regions[0], fixed)}; {rule}", fontsize=9, loc="left")
    canvas.legend(panel, ncols=1, loc="best", bbox_to_anchor=None, borderaxespad=0.5)


def _reach(regions: Sequence[UpliftRegion]) -> tuple[float, float]:
    """Return the range of theta/omega_1 in which 1 g is enough, with some room, or all of it."""
    highest = max(float(region.frequency_ratio.max()) for region in regions)
    enough = [float(r) for region in regions for r in region.frequency_ratio[region.acceleration_ratio <= 1.0]]
    return (0.0, min(highest, 1.15 * max(enough))) if enough else (0.0, highest)


def _frequencies(panel: Axes, regions: Sequence[UpliftRegion], against: str) -> None:
    """Draw omega_i / omega_V against beta (fig. 3) or alpha (fig. 4) for the other's values."""
    other = "alpha" if against == "beta" else "beta"
    gamma = regions[0].ratios["gamma"]
    values = np.linspace(0.01, 3.0, 150)
    groups = {"first rocking": canvas.ACCENT, "second rocking": canvas.SECOND, "vertical": "0.35", "torsion": "#2e7d4f"}
    chosen = sorted({region.ratios[other] for region in regions})
    for index, fixed in enumerate(chosen):
        curves = frequencies_against(against, values, **{against: 1.0, other: fixed}, gamma=gamma)
        for mode, curve in curves.items():
            group = next(name for name in groups if mode.startswith(name))
            # vertical: one line for all; torsion: one line against beta, where alpha does not matter
            if index > 0 and (group == "vertical" or (group == "torsion" and against == "beta")):
                continue
            panel.plot(values, curve, color=groups[group], linewidth=1.1, linestyle=STYLES[index % len(STYLES)])
    for group, colour in groups.items():
        panel.plot([], [], color=colour, label=group)
    for index, fixed in enumerate(chosen):
        panel.plot([], [], color="0.2", linestyle=STYLES[index % len(STYLES)], label=f"{SYMBOLS[other]} = {fixed:.4g}")
    panel.set_xlim(0.0, 3.0)
    panel.set_ylim(0.0, 5.0)
    canvas.label(panel, x=SYMBOLS[against], y=r"$\omega_i/\omega_V$")
    canvas.legend(panel, ncols=2, loc="upper left", bbox_to_anchor=None, borderaxespad=0.5)
