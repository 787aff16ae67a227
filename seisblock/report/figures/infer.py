"""Figures of inferred ground motion: PGA-frequency trade-off, likelihoods, displacement over scale factor."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seisblock.core.i18n import format_percent, gettext
from seisblock.core.typing import FloatArray
from seisblock.output.figures.heading import panel_label, records_heading
from seisblock.output.figures.log_ticks import round_ticks
from seisblock.output.figures.style import (
    ACCENT,
    INPUT,
    SECOND,
    StyledFigure,
    add_legend,
    draw_thresholds,
    label_axes,
    narrow_too,
    new_figure,
    set_panel_title,
)
from seisblock.output.units_display import acceleration_unit, length_unit
from seisblock.records import Record
from seisblock.studies.survey.assumptions import Assumptions
from seisblock.studies.survey.estimate import ShakingEstimate, frequency_contour
from seisblock.studies.survey.likelihood import Survey

if TYPE_CHECKING:
    from seisblock.studies.survey.scale_search import ScaleFactors
from seisblock.studies.survey.twist import TwistEstimate

LEVELS = (0.5, 0.9)
"""Probability content of the bands at each frequency."""

PGA_RANGE = (0.5, 40.0)
"""Range of PGA drawn, m/s^2."""

TICKS = (1.0, 2.0, 5.0, 10.0, 20.0)
"""Labelled values of PGA, m/s^2."""

FEW_TICKS = (1.0, 3.0, 10.0, 30.0)
"""Labelled values of PGA on a horizontal axis, m/s^2."""

FREQUENCIES = tuple(np.geomspace(0.3, 4.0, 31).tolist())
"""Frequencies of the contour, Hz."""


@narrow_too
def estimate_figure(
    name: str, survey: Survey, assumptions: Assumptions, estimates: Sequence[ShakingEstimate], *, gal: bool = True, narrow: bool = False
) -> StyledFigure:
    """Return the figure: bands of PGA over frequency, and the likelihood over PGA at given frequencies.

    Panels stacked if `narrow`.

    Parameters
    ----------
    name : str
    survey, assumptions : Survey, Assumptions
    estimates : sequence of ShakingEstimate
        Estimates with a frequency are drawn as points with intervals.
    gal : bool
        Unit of accelerations, else m/s^2.
    """
    title = gettext("{name}: {fallen} of {all} stones overturned", name=name, fallen=survey.fell, all=survey.stone_count)
    figure, (left, right) = (
        new_figure(2, width=5.0, height=8.0, sharex=False, title=title)
        if narrow
        else new_figure(1, columns=2, width=9.6, height=4.2, title=title)
    )
    unit, _ = acceleration_unit(gal=gal)
    _draw_contour(left, survey, assumptions, gal=gal)
    selection = [estimate for estimate in estimates if estimate.stones == estimates[-1].stones and estimate.frequency_hz is not None]
    for estimate in selection:
        ends = [end / unit for end in estimate.pga_interval_m_s2 if end is not None]
        at = estimate.frequency_hz or math.nan
        left.plot([at] * len(ends), ends, color=ACCENT, linewidth=1.0, marker="_", markersize=6, zorder=3)
        if estimate.pga_m_s2 is not None:
            left.plot([at], [estimate.pga_m_s2 / unit], "o", color=ACCENT, markersize=4, zorder=4)
    _draw_likelihoods(right, survey, assumptions, selection, gal=gal)
    return figure


def _draw_contour(axis: Axes, survey: Survey, assumptions: Assumptions, *, gal: bool) -> None:
    """Draw the bands of PGA over frequency."""
    unit, name = acceleration_unit(gal=gal)
    limits = [pga / unit for pga in PGA_RANGE]
    for level, shade in zip(sorted(LEVELS, reverse=True), ("0.9", "0.72"), strict=True):
        line = frequency_contour(survey, replace(assumptions, level=level), FREQUENCIES)
        low, high = ([math.nan if e.pga_interval_m_s2[i] is None else e.pga_interval_m_s2[i] for e in line] for i in (0, 1))
        lowest, highest = (np.array(end, dtype=np.float64) / unit for end in (low, high))
        _draw_band(axis, lowest, highest, limits, shade, format_percent(level, "g"))
        if level == max(LEVELS) and line[0].pga_m_s2 is not None:
            axis.plot(FREQUENCIES, [(e.pga_m_s2 or math.nan) / unit for e in line], color="0.15", linewidth=1.2, label=gettext("median"))
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xticks([0.5, 1.0, 2.0, 3.0], ["0.5", "1", "2", "3"])
    axis.minorticks_off()
    axis.set_yticks([pga / unit for pga in TICKS], [f"{pga / unit:g}" for pga in TICKS])
    axis.set_xlim(FREQUENCIES[0], FREQUENCIES[-1])
    axis.set_ylim(*limits)
    label_axes(axis, x=gettext("equivalent frequency (Hz)"), y=gettext("PGA ({unit})", unit=name))
    add_legend(axis)


def _draw_band(axis: Axes, low: FloatArray, high: FloatArray, limits: Sequence[float], shade: str, name: str) -> None:
    """Draw a band, or the feasible side of a bound."""
    if np.isnan(low).all():
        low, name = np.full(len(FREQUENCIES), limits[0]), gettext("{level}, upper bound", level=name)
    elif np.isnan(high).all():
        high, name = np.full(len(FREQUENCIES), limits[1]), gettext("{level}, lower bound", level=name)
    axis.fill_between(FREQUENCIES, low, high, color=shade, linewidth=0, label=name)


def _draw_likelihoods(axis: Axes, survey: Survey, assumptions: Assumptions, estimates: Sequence[ShakingEstimate], *, gal: bool) -> None:
    """Draw the likelihood over PGA at the frequencies of the estimates, else at 1, 2 and 3 Hz."""
    unit, name = acceleration_unit(gal=gal)
    frequencies = [item.frequency_hz for item in estimates if item.frequency_hz is not None] or [1.0, 2.0, 3.0]
    for index, f in enumerate(frequencies):
        (likelihood,) = assumptions.likelihoods(survey, [f])
        share = index / max(len(frequencies) - 1, 1)
        colour = ACCENT if len(frequencies) == 1 else str(round(0.15 + 0.55 * share, 2))
        dashes = ("-", (0, (5, 1.5)), (0, (1.5, 1.2)))[index % 3]
        pga, value = np.exp(likelihood.log_pga) / unit, likelihood.value / likelihood.value.max()
        axis.plot(pga, value, color=colour, linestyle=dashes, linewidth=1.2, label=f"{f:.3g} Hz")
    axis.set_xscale("log")
    axis.set_xlim(*(item / unit for item in PGA_RANGE))
    axis.set_xticks([item / unit for item in FEW_TICKS], [f"{item / unit:g}" for item in FEW_TICKS])
    axis.minorticks_off()
    label_axes(axis, x=gettext("PGA ({unit})", unit=name), y=gettext("normalised likelihood (1)"))
    add_legend(axis, ncols=6)


def factor_figure(results: Sequence[tuple[Record, ScaleFactors]], *, gal: bool = True) -> Figure:
    """Return the figure: displacement over scale factor with the observed value and the solutions, a panel per component."""
    records = [record for record, _ in results]
    title = records_heading(records, [result.component for _, result in results])
    figure, axes = new_figure(len(results), height=1.4 + 1.9 * len(results), title=title)
    disp_unit = length_unit((result.observed_m for _, result in results), gal=gal)
    for axis, (record, result) in zip(axes, results, strict=True):
        scales, values = result.curve
        axis.plot(scales, np.array(values) / disp_unit.size, color=SECOND, linewidth=1.0)
        draw_thresholds(axis, [result.observed_m / disp_unit.size], gettext("observed"))
        for marker, leaps, text in (("o", False, gettext("solution")), ("x", True, gettext("discontinuity"))):
            points = [f.scale for f in result.scale_factors if f.leaps == leaps]
            if points:
                axis.plot(points, [result.observed_m / disp_unit.size] * len(points), marker, color=ACCENT, markersize=5, label=text)
        axis.axvline(1.0, color=INPUT, linewidth=0.8, linestyle=(0, (1, 2)), label=gettext("unscaled record"))
        set_panel_title(axis, panel_label(record, result.component, records))
        label_axes(axis, y=gettext("x ({unit})", unit=disp_unit.name))
        add_legend(axis)
    label_axes(axes[-1], x=gettext("scale factor (1)"))
    return figure


def twist_figure(results: Sequence[tuple[Record, TwistEstimate]], *, gal: bool = True) -> Figure:
    """Return the figure: twist of all runs over the scale factor, with the observed twist and the interval, a panel per record."""
    records = [record for record, _ in results]
    title = records_heading(records, [estimate.component for _, estimate in results])
    figure, axes = new_figure(len(results), height=1.4 + 2.3 * len(results), title=title)
    for axis, (record, estimate) in zip(axes, results, strict=True):
        if estimate.scale is not None:
            text = gettext("interval of the factor") + f" {estimate.scale.low:.2f}-{estimate.scale.high:.2f}"
            axis.axvspan(estimate.scale.low, estimate.scale.high, color=ACCENT, alpha=0.15, linewidth=0.0, label=text)
            axis.axvline(estimate.scale.median, color=ACCENT, linewidth=1.0, label=gettext("median"))
        standing = [run for run in estimate.sample if not run.overturned]
        sizes = [5.0 + 35.0 * run.weight for run in standing]
        twists = [abs(run.twist_deg) for run in standing]
        label = gettext("did not overturn (size: agreement)")
        axis.scatter([run.scale for run in standing], twists, s=sizes, color=SECOND, linewidths=0.0, alpha=0.8, label=label)
        top = 1.25 * max(*twists, estimate.twist_deg, 1.0)
        fallen = [run.scale for run in estimate.sample if run.overturned]
        if fallen:
            axis.plot(fallen, [0.97 * top] * len(fallen), "x", color=INPUT, markersize=3.5, label=gettext("overturned"))
        draw_thresholds(axis, [estimate.twist_deg], gettext("observed"))
        axis.set(xscale="log", ylim=(0.0, top))
        round_ticks(axis.xaxis)
        set_panel_title(axis, panel_label(record, estimate.component, records))
        label_axes(axis, y=gettext("twist (deg)"))
        add_legend(axis)
    label_axes(axes[-1], x=gettext("scale factor (1)"))
    return figure
