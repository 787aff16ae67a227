"""Figures of harmonic uplift: uplift regions and natural frequencies ([Okumura1987]_)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seisblock.core.i18n import N_, gettext
from seisblock.models.uplift.plot import COLOURS, LIFTED_COLOUR
from seisblock.output.figures import style
from seisblock.report.text.uplift_harmonic import SYMBOLS, region_title, varied_names
from seisblock.studies.uplift_regions import UpliftRegion, modal_frequencies_against

STYLES = ("-", (0, (5, 1.5)), (0, (1.5, 1.2)), (0, (6, 1.5, 1.5, 1.5)), (0, (3, 1, 1, 1, 1, 1)), (0, (8, 3)))
"""Dash patterns, distinct in greyscale."""

GROUPS = (N_("first rocking"), N_("second rocking"), N_("vertical"), N_("torsion"))
"""Prefixes of the names of modes."""


def harmonic_figure(regions: Sequence[UpliftRegion], figure: int | None = None, *, title: str = "") -> Figure:
    """Return the uplift regions and natural frequencies, or a single figure of [Okumura1987]_, by default titled by its number."""
    if figure in (3, 4):
        fig, (panel,) = style.new_figure(1, width=6.5, height=5.0, title=title)
        _draw_frequencies(panel, regions, "beta" if figure == 3 else "alpha")
        if not title:
            panel.set_title(gettext("as fig. {number}", number=figure), fontsize=9, loc="left")
        return fig
    if figure is not None:
        fig, (panel,) = style.new_figure(1, width=7.5, height=5.0, title=title)
        _draw_regions(panel, regions)
        if not title:
            panel.set_title(gettext("as fig. {number}: {what}", number=figure, what=panel.get_title(loc="left")), fontsize=9, loc="left")
        return fig
    fig, panels = style.new_figure(1, columns=3, width=15.0, height=4.8, sharex=False, gridspec_kw={"width_ratios": [1.7, 1, 1]})
    _draw_regions(panels[0], regions)
    _draw_frequencies(panels[1], regions, "beta")
    _draw_frequencies(panels[2], regions, "alpha")
    return fig


def _draw_regions(panel: Axes, regions: Sequence[UpliftRegion]) -> None:
    """Draw the smallest A/g with uplift over theta/omega_1, as [Okumura1987]_ figs. 6 to 11."""
    names = varied_names(regions)
    for index, region in enumerate(regions):
        colour = COLOURS[index % len(COLOURS)]
        panel.plot(
            region.frequency_ratio,
            np.minimum(region.acceleration_ratio, 1e3),
            color=colour,
            linewidth=1.3,
            linestyle=STYLES[index % len(STYLES)],
            label=region_title(region, names) if names else None,
        )
        minima = [m for m in region.minima if m.acceleration_ratio > 0.0]
        panel.plot([m.frequency_ratio for m in minima], [m.acceleration_ratio for m in minima], "o", color=colour, markersize=3.5)
    if len(regions) == 1:
        region_only = regions[0]
        panel.fill_between(
            region_only.frequency_ratio, np.minimum(region_only.acceleration_ratio, 10.0), 10.0, color=LIFTED_COLOUR, alpha=0.6, linewidth=0
        )
        panel.text(region_only.minimum.frequency_ratio, 0.8, gettext("corner uplift"), ha="center", fontsize=8)
    panel.set_ylim(0.0, 1.0)
    panel.set_xlim(*_ratio_range(regions))
    style.label_axes(panel, x="θ/ω₁", y="A/g")
    fixed = [name for name in SYMBOLS if name not in names]
    rule = gettext("minimum of four corners") if regions[0].corner is None else gettext("corner {number}", number=regions[0].corner)
    panel.set_title(f"{region_title(regions[0], fixed)}; {rule}", fontsize=9, loc="left")
    style.add_legend(panel, ncols=1, loc="best", bbox_to_anchor=None, borderaxespad=0.5)


def _ratio_range(regions: Sequence[UpliftRegion]) -> tuple[float, float]:
    """Return the range of theta/omega_1 with uplift at 1 g plus a margin, or the full range."""
    highest = max(float(region.frequency_ratio.max()) for region in regions)
    ratios = [float(r) for region in regions for r in region.frequency_ratio[region.acceleration_ratio <= 1.0]]
    return (0.0, min(highest, 1.15 * max(ratios))) if ratios else (0.0, highest)


def _draw_frequencies(panel: Axes, regions: Sequence[UpliftRegion], against: str) -> None:
    """Draw omega_i / omega_V over beta (fig. 3) or alpha (fig. 4) for the values of the other parameter."""
    parameter = "alpha" if against == "beta" else "beta"
    gamma = regions[0].ratios["gamma"]
    values = np.linspace(0.01, 3.0, 150)
    groups = dict(zip(GROUPS, (style.ACCENT, "#123a5e", "0.55", "#7cc29a"), strict=True))
    fixed_values = sorted({region.ratios[parameter] for region in regions})
    for index, fixed in enumerate(fixed_values):
        curves = modal_frequencies_against(against, values, **{against: 1.0, parameter: fixed}, gamma=gamma)
        for mode, curve in curves.items():
            group = next(name for name in groups if mode.startswith(name))
            # the vertical mode depends on neither parameter, the torsional mode not on alpha
            if index > 0 and (group == "vertical" or (group == "torsion" and against == "beta")):
                continue
            panel.plot(values, curve, color=groups[group], linewidth=1.1, linestyle=STYLES[index % len(STYLES)])
    for group, colour in groups.items():
        panel.plot([], [], color=colour, label=gettext(group))
    for _ in range(len(groups), len(fixed_values)):
        panel.plot([], [], " ", label=" ")  # pads the legend so that each column has one kind of entry
    for index, fixed in enumerate(fixed_values):
        panel.plot([], [], color="0.85", linestyle=STYLES[index % len(STYLES)], label=f"{SYMBOLS[parameter]} = {fixed:.4g}")
    panel.set_xlim(0.0, 3.0)
    panel.set_ylim(0.0, 5.0)
    style.label_axes(panel, x=SYMBOLS[against], y="ωᵢ/ωᵥ")
    style.add_legend(panel, ncols=2 if len(fixed_values) >= len(groups) else 1, loc="upper left", bbox_to_anchor=None, borderaxespad=0.5)
