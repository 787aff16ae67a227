"""Figure of fragility curves: observed fractions, lognormal fit, confidence band, reference curve."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from seisblock.core.i18n import format_percent, gettext
from seisblock.output.figures.log_ticks import round_ticks
from seisblock.output.figures.style import ACCENT, INPUT, SECOND, StyledFigure, add_legend, label_axes, new_figure, set_panel_title
from seisblock.report.text.fragility import limit_label, measure_label
from seisblock.studies.fragility.estimate import CLOUD
from seisblock.studies.fragility.lognormal import Lognormal
from seisblock.studies.fragility.results import Fragility, FragilityStudy

LINE_STYLES = ((ACCENT, "-", "o"), (SECOND, (0, (5, 1.5)), "s"), ("0.15", (0, (1.5, 1.2)), "^"), ("0.5", "-.", "D"))
"""Colour, dashes and marker of the limit states in order, distinct in greyscale."""

CURVE_POINTS = 241
MIN_GROUP_SIZE = 8
"""Smallest group of unscaled motions (cloud analysis) for an observed fraction."""


def figure(study: FragilityStudy, *, gal: bool = True, compare: Lognormal | None = None, columns: int | None = None) -> StyledFigure:
    """Return the figure: per body the observed fractions at the levels, the curves and their confidence bands.

    Parameters
    ----------
    study : FragilityStudy
    gal : bool
        Unit of the intensities: gal, kine and cm, else SI.
    compare : Lognormal or None
        Reference curve.
    columns : int or None
        Panels per row; by default depends on their number, 1 in the narrow layout.
    """
    bodies = list(dict.fromkeys(curve.body for curve in study.curves))
    columns = columns or (1 if len(bodies) < 3 else 2 if len(bodies) < 7 else 3)
    rows = math.ceil(len(bodies) / columns)
    first = study.curves[0]
    title = gettext("{records} records, {motions} motions", records=first.records, motions=first.motions)
    width = 6.4 if columns == 1 else 4.2 * columns
    fig, axes = new_figure(rows, columns=columns, width=width, height=0.8 + 2.9 * rows, title=title, sharex=False, sharey=True)
    size, name = study.measure.display_unit(gal=gal)[0], measure_label(study.measure, gal=gal)
    for index, axis in enumerate(axes):
        if index >= len(bodies):
            axis.set_visible(False)
            continue
        indices = [i for i, curve in enumerate(study.curves) if curve.body == bodies[index]]
        for position, index_of_curve in enumerate(indices):
            _draw_curve(axis, study, index_of_curve, LINE_STYLES[position % len(LINE_STYLES)], size, gal=gal)
        if compare is not None:
            x = np.geomspace(*axis.get_xlim(), CURVE_POINTS)
            axis.plot(x, compare.probability(x * size), color=INPUT, linewidth=1.0, linestyle=(0, (4, 2)), label=gettext("reference curve"))
        set_panel_title(axis, gettext(bodies[index]))
        label_axes(axis, x=name if index + columns >= len(bodies) else "", y=gettext("probability (1)") if index % columns == 0 else "")
        axis.set_ylim(-0.02, 1.02)
        round_ticks(axis.xaxis)
        add_legend(axis, loc="best", bbox_to_anchor=None, borderaxespad=0.5, ncols=1)
    if columns > 1:
        fig.narrow_layout = partial(figure, study, gal=gal, compare=compare, columns=1)
    return fig


def _draw_curve(axis: Axes, study: FragilityStudy, index: int, look: tuple[str, Any, str], size: float, *, gal: bool) -> None:
    """Draw one curve with its observed fractions and confidence band."""
    curve, band = study.curves[index], study.bands[index]
    colour, dashes, mark = look
    axis.set_xscale("log")
    intensities, shares = _exceedance_shares(curve)
    axis.plot(np.array(intensities) / size, shares, mark, color=colour, markersize=3, markerfacecolor="none", markeredgewidth=0.7)
    low, high = (end / size for end in (min(point.im for point in curve.levels), max(point.im for point in curve.levels)))
    name = limit_label(curve.limit, gal=gal)
    if curve.curve is None:
        axis.plot([], [], mark, color=colour, markersize=3, markerfacecolor="none", label=gettext("{limit}: no curve", limit=name))
        return
    if band is not None:
        x, lower, upper = (np.array(column) for column in zip(*band, strict=True))
        text = (
            gettext("{level} confidence interval", level=format_percent(study.confidence, "g"))
            if axis.get_legend_handles_labels()[0] == []
            else None
        )
        axis.fill_between(x / size, lower, upper, color=colour, alpha=0.16, linewidth=0, label=text)
    x = np.geomspace(low, high, CURVE_POINTS)
    median = f"{curve.curve.median / size:.3g} {study.measure.display_unit(gal=gal)[1]}".rstrip()
    text = gettext("{limit}: {median}, β {beta:.2f}", limit=name, median=median, beta=curve.curve.beta)
    axis.plot(x, curve.curve.probability(x * size), color=colour, linestyle=dashes, linewidth=1.4, label=text)


def _exceedance_shares(curve: Fragility) -> tuple[list[float], list[float]]:
    """Return intensities and observed fractions at the levels, or of groups of similar intensity in a cloud analysis."""
    if curve.method != CLOUD:
        return [point.im for point in curve.levels], [point.exceeding / point.runs for point in curve.levels]
    groups = np.array_split(np.arange(len(curve.levels)), max(len(curve.levels) // MIN_GROUP_SIZE, 1))
    level_groups = [[curve.levels[i] for i in group] for group in groups if group.size]
    middle = [float(np.exp(np.mean([math.log(point.im) for point in group]))) for group in level_groups]
    return middle, [sum(point.exceeding for point in group) / sum(point.runs for point in group) for group in level_groups]
