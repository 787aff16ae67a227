"""Figure of the risk at a site: hazard with branches, fragility curves, disaggregation by intensity."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seisblock.core.i18n import gettext
from seisblock.output.figures.log_ticks import round_ticks
from seisblock.output.figures.style import ACCENT, INPUT, SECOND, add_figure_legend, add_legend, label_axes, new_figure
from seisblock.output.text.wrap import display_width
from seisblock.report.text.fragility import measure_label
from seisblock.report.text.risk import risk_label
from seisblock.studies.fragility.intensity import intensity_measure
from seisblock.studies.fragility.io import FragilityCurve
from seisblock.studies.hazard.curve import Hazard
from seisblock.studies.hazard.risk import Risk

COLOURS = (ACCENT, SECOND, "0.15", "0.5")
DASHES: tuple[Any, ...] = (
    "-",
    (0, (5, 1.5)),
    (0, (1.5, 1.2)),
    "-.",
    (0, (10, 3)),
    (0, (1, 3)),
    (0, (9, 1.5, 1.5, 1.5)),
    (0, (4, 1, 1, 1, 1, 1)),
    (0, (6, 1, 3, 1)),
)
"""Dashes of the fragility curves: 9 distinct in greyscale, 36 with colours."""

MAX_LEGEND_COLUMNS = 64
"""Width in characters of a legend above the panel, at most; a longer one is placed below the figure, one row per entry."""

LINE_SAMPLE_COLUMNS = 8
"""Width in characters of the line sample of an entry."""

LEGEND_ROW_HEIGHT = 0.17
"""Height of a row of the legend, inch."""

POINTS = 241


def figure(risks: Sequence[tuple[FragilityCurve, Risk]], hazard: Hazard, *, gal: bool = True) -> Figure:
    """Return the figure: hazard, fragility, and annual frequency per decade of intensity.

    Parameters
    ----------
    risks : sequence of (FragilityCurve, Risk)
    hazard : Hazard
    gal : bool
        Unit of the intensities: gal, kine and cm, else SI.
    """
    measure = intensity_measure(hazard.im)
    size = measure.display_unit(gal=gal)[0]
    names = [risk_label(fragility, gal=gal) or gettext("fragility") for fragility, _ in risks]
    outside = sum(display_width(name) + LINE_SAMPLE_COLUMNS for name in names) > MAX_LEGEND_COLUMNS
    name_text = names[0] if len(risks) == 1 else gettext("{count} fragility curves", count=len(risks))
    title = gettext("Risk: {what}; hazard in {measure}", what=name_text, measure=gettext(measure.label))
    fig, (hazard_axes, middle, density_axes) = new_figure(
        3, width=6.4, height=7.4 + (LEGEND_ROW_HEIGHT * len(risks) if outside else 0.0), title=title
    )
    x = _intensity_range(risks, hazard)
    _draw_hazard(hazard_axes, hazard, x, size)
    for index, (fragility, risk) in enumerate(risks):
        colour, dashes = COLOURS[index % len(COLOURS)], DASHES[index % len(DASHES)]
        middle.plot(x / size, fragility.curve.probability(x), color=colour, linestyle=dashes, linewidth=1.4, label=names[index])
        _draw_density(density_axes, risk, size, look=(colour, dashes), fill=not outside)
    density_axes.set_xscale("log")
    label_axes(hazard_axes, y=gettext("exceedance (1/year)"))
    label_axes(middle, y=gettext("probability (1)"))
    label_axes(density_axes, x=measure_label(measure, gal=gal), y=gettext("rate per decade (1/year)"))
    middle.set_ylim(-0.02, 1.02)
    density_axes.set_ylim(bottom=0.0)
    round_ticks(density_axes.xaxis)
    add_legend(hazard_axes)
    if outside:
        add_figure_legend(fig, middle.get_legend_handles_labels()[0], loc="outside lower left", ncols=1)
    else:
        add_legend(middle)
    return fig


def _intensity_range(risks: Sequence[tuple[FragilityCurve, Risk]], hazard: Hazard) -> np.ndarray:
    """Return the intensities drawn: range of the hazard levels and of the 1 to 99 % quantiles of the fragility curves."""
    ends = [end for branch in hazard.branches for end in (np.min(branch.levels), np.max(branch.levels))]
    ends += [fragility.curve.quantile(share) for fragility, _ in risks for share in (0.01, 0.99)]
    return np.geomspace(min(ends), max(ends), POINTS)


def _draw_hazard(axis: Axes, hazard: Hazard, x: np.ndarray, size: float) -> None:
    """Draw the hazard curves, with points at the levels of the table."""
    axis.set_yscale("log")
    has_branches = len(hazard.branches) > 1
    for index, branch in enumerate(hazard.branches if has_branches else ()):
        text = gettext("branches") if index == 0 else None
        axis.plot(x / size, branch.rate(x), color=INPUT, linewidth=0.8, label=text)
    axis.plot(x / size, hazard.rate(x), color="0.1", linewidth=1.4, label=gettext("mean") if has_branches else gettext("hazard"))
    levels = np.unique(np.concatenate([np.asarray(branch.levels) for branch in hazard.branches]))
    axis.plot(levels / size, hazard.rate(levels), "o", color="0.1", markersize=3)


def _draw_density(axis: Axes, risk: Risk, size: float, *, look: tuple[Any, Any], fill: bool) -> None:
    """Draw the disaggregation: contribution to the annual frequency per decade of intensity."""
    inner = risk.disaggregation[1:-1]
    edges = np.array([inner[0].im_from, *(share.im_to for share in inner)], dtype=np.float64)
    density = np.array([share.annual_rate for share in inner]) / np.diff(np.log10(edges))
    colour, dashes = look
    if fill:
        axis.stairs(density, edges / size, color=colour, alpha=0.14, fill=True)
    axis.stairs(density, edges / size, color=colour, linestyle=dashes, linewidth=1.2)
