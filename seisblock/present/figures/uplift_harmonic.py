"""Harmonic uplift in pictures: regions and frequencies."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seisblock.present.figures import canvas
from seisblock.present.figures.uplift import COLOURS, LIFTED
from seisblock.present.text.uplift_harmonic import SYMBOLS, title, varied_names
from seisblock.studies.uplift_regions import UpliftRegion, frequencies_against
from seisblock.words import noted, tell

STYLES = ("-", (0, (5, 1.5)), (0, (1.5, 1.2)), (0, (6, 1.5, 1.5, 1.5)), (0, (3, 1, 1, 1, 1, 1)), (0, (8, 3)))
"""Lines that stay apart in grey."""

GROUPS = (noted("first rocking"), noted("second rocking"), noted("vertical"), noted("torsion"))
"""How the names of modes begin."""


def harmonic_figure(regions: Sequence[UpliftRegion], figure: int | None = None) -> Figure:
    """Return the uplift regions beside the natural frequencies; or one figure of [Okumura1987]_ alone."""
    if figure in (3, 4):
        made, (panel,) = canvas.new_figure(1, width=6.5, height=5.0)
        _frequencies(panel, regions, "beta" if figure == 3 else "alpha")
        panel.set_title(tell("as fig. {number}", number=figure), fontsize=9, loc="left")
        return made
    if figure is not None:
        made, (panel,) = canvas.new_figure(1, width=7.5, height=5.0)
        _regions(panel, regions)
        panel.set_title(tell("as fig. {number}: {what}", number=figure, what=panel.get_title(loc="left")), fontsize=9, loc="left")
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
            region.frequency_ratio,
            np.minimum(region.acceleration_ratio, 1e3),
            color=colour,
            linewidth=1.3,
            linestyle=STYLES[index % len(STYLES)],
            label=title(region, names) if names else None,
        )
        seen = [m for m in region.minima if m.acceleration_ratio > 0.0]
        panel.plot([m.frequency_ratio for m in seen], [m.acceleration_ratio for m in seen], "o", color=colour, markersize=3.5)
    if len(regions) == 1:
        only = regions[0]
        panel.fill_between(only.frequency_ratio, np.minimum(only.acceleration_ratio, 10.0), 10.0, color=LIFTED, alpha=0.6, linewidth=0)
        panel.text(only.minimum.frequency_ratio, 0.8, tell("a corner lifts"), ha="center", fontsize=8)
    panel.set_ylim(0.0, 1.0)
    panel.set_xlim(*_reach(regions))
    canvas.label(panel, x="θ/ω₁", y="A/g")
    fixed = [name for name in SYMBOLS if name not in names]
    rule = tell("least of four corners") if regions[0].corner is None else tell("corner {number}", number=regions[0].corner)
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
    groups = dict(zip(GROUPS, (canvas.ACCENT, "#123a5e", "0.55", "#7cc29a"), strict=True))
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
        panel.plot([], [], color=colour, label=tell(group))
    for _ in range(len(groups), len(chosen)):
        panel.plot([], [], " ", label=" ")  # so that each column of the key holds one kind
    for index, fixed in enumerate(chosen):
        panel.plot([], [], color="0.85", linestyle=STYLES[index % len(STYLES)], label=f"{SYMBOLS[other]} = {fixed:.4g}")
    panel.set_xlim(0.0, 3.0)
    panel.set_ylim(0.0, 5.0)
    canvas.label(panel, x=SYMBOLS[against], y="ωᵢ/ωᵥ")
    canvas.legend(panel, ncols=2 if len(chosen) >= len(groups) else 1, loc="upper left", bbox_to_anchor=None, borderaxespad=0.5)
