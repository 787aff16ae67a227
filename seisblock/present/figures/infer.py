"""Inferred shaking in pictures: the trade-off of PGA and frequency, likelihoods, displacement against the factor on a record."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seisblock.present.figures.canvas import ACCENT, INPUT, SECOND, label, legend, new_figure, threshold
from seisblock.records import Record
from seisblock.studies.inverse.assumptions import Assumptions
from seisblock.studies.inverse.estimate import ShakingEstimate, contour
from seisblock.studies.inverse.survey import Survey
from seisblock.typing import FloatArray
from seisblock.units import GAL
from seisblock.words import tell

if TYPE_CHECKING:
    from seisblock.studies.inverse.factors import ScaleFactors

LEVELS = (0.5, 0.9)
"""Shares of the likelihood's mass at each frequency that the bands hold."""

SHOWN_PGA = (50.0, 4000.0)
"""Range of PGA drawn, gal."""

FINE = tuple(np.geomspace(0.3, 4.0, 31).tolist())
"""Frequencies of the contour, Hz."""


def estimate_figure(name: str, survey: Survey, assumptions: Assumptions, estimates: Sequence[ShakingEstimate]) -> Figure:
    """Return the figure: the trade-off of PGA and frequency with its bands, and the likelihood over PGA at some frequencies.

    Parameters
    ----------
    name : str
    survey, assumptions : Survey, Assumptions
    estimates : sequence of ShakingEstimate
        Those with a frequency are drawn as points with their intervals.
    """
    title = tell("{name}: {fallen} of {all} stones fell", name=name, fallen=survey.fell, all=survey.judged)
    figure, (left, right) = new_figure(1, columns=2, width=9.6, height=4.2, title=title)
    _trade_off(left, survey, assumptions)
    chosen = [each for each in estimates if each.stones == estimates[-1].stones and each.frequency_hz is not None]
    for each in chosen:
        ends = [end / GAL for end in each.pga_interval_m_s2 if end is not None]
        at = each.frequency_hz or math.nan
        left.plot([at] * len(ends), ends, color=ACCENT, linewidth=1.0, marker="_", markersize=6, zorder=3)
        if each.pga_m_s2 is not None:
            left.plot([at], [each.pga_m_s2 / GAL], "o", color=ACCENT, markersize=4, zorder=4)
    _likelihoods(right, survey, assumptions, chosen)
    return figure


def _trade_off(axis: Axes, survey: Survey, assumptions: Assumptions) -> None:
    """Draw the bands of PGA against frequency."""
    for level, shade in zip(sorted(LEVELS, reverse=True), ("0.88", "0.76"), strict=True):
        line = contour(survey, replace(assumptions, level=level), FINE)
        low, high = ([math.nan if e.pga_interval_m_s2[i] is None else e.pga_interval_m_s2[i] for e in line] for i in (0, 1))
        _band(axis, np.array(low, dtype=np.float64) / GAL, np.array(high, dtype=np.float64) / GAL, shade, f"{100 * level:g} %")
        if level == max(LEVELS) and line[0].pga_m_s2 is not None:
            axis.plot(FINE, [(e.pga_m_s2 or math.nan) / GAL for e in line], color="0.15", linewidth=1.2, label=tell("median"))
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xticks([0.5, 1.0, 2.0, 3.0], ["0.5", "1", "2", "3"])
    axis.minorticks_off()
    axis.set_yticks([100, 200, 500, 1000, 2000], ["100", "200", "500", "1000", "2000"])
    axis.set_xlim(FINE[0], FINE[-1])
    axis.set_ylim(*SHOWN_PGA)
    label(axis, x=tell("equivalent frequency (Hz)"), y=tell("PGA (gal)"))
    legend(axis)


def _band(axis: Axes, low: FloatArray, high: FloatArray, shade: str, name: str) -> None:
    """Draw a band, or the side of a bound on which the shaking lies."""
    if np.isnan(low).all():
        low, name = np.full(len(FINE), SHOWN_PGA[0]), tell("{level}, upper bound", level=name)
    elif np.isnan(high).all():
        high, name = np.full(len(FINE), SHOWN_PGA[1]), tell("{level}, lower bound", level=name)
    axis.fill_between(FINE, low, high, color=shade, linewidth=0, label=name)


def _likelihoods(axis: Axes, survey: Survey, assumptions: Assumptions, chosen: Sequence[ShakingEstimate]) -> None:
    """Draw the likelihood over PGA at the frequencies chosen, or at three."""
    frequencies = [each.frequency_hz for each in chosen if each.frequency_hz is not None] or [1.0, 2.0, 3.0]
    for index, f in enumerate(frequencies):
        (found,) = assumptions.likelihoods(survey, [f])
        share = index / max(len(frequencies) - 1, 1)
        colour = ACCENT if len(frequencies) == 1 else str(round(0.15 + 0.55 * share, 2))
        dashes = ("-", (0, (5, 1.5)), (0, (1.5, 1.2)))[index % 3]
        pga, value = np.exp(found.log_pga) / GAL, found.value / found.value.max()
        axis.plot(pga, value, color=colour, linestyle=dashes, linewidth=1.2, label=f"{f:.3g} Hz")
    axis.set_xscale("log")
    axis.set_xlim(*SHOWN_PGA)
    axis.set_xticks([100, 200, 500, 1000, 2000], ["100", "200", "500", "1000", "2000"])
    axis.minorticks_off()
    label(axis, x=tell("PGA (gal)"), y=tell("likelihood (over its largest)"))
    legend(axis, ncols=6)


def factor_figure(found: Sequence[tuple[Record, ScaleFactors]]) -> Figure:
    """Return the figure: displacement against the factor, the observed one and the factors that give it, a panel per component."""
    figure, axes = new_figure(len(found), height=1.0 + 1.9 * len(found))
    for axis, (record, each) in zip(axes, found, strict=True):
        scales, values = each.curve
        axis.plot(scales, np.array(values) * 100.0, color=SECOND, linewidth=1.0)
        threshold(axis, [each.observed_m * 100.0], tell("observed"))
        for marker, leaps, name in (("o", False, tell("solution")), ("x", True, tell("leaps across"))):
            points = [f.scale for f in each.scale_factors if f.leaps == leaps]
            if points:
                axis.plot(points, [each.observed_m * 100.0] * len(points), marker, color=ACCENT, markersize=5, label=name)
        axis.axvline(1.0, color=INPUT, linewidth=0.8, linestyle=(0, (1, 2)))
        axis.set_title(f"{record.station or record.source} {each.component}", fontsize=9, loc="left")
        label(axis, y=tell("displacement (cm)"))
        legend(axis)
    label(axes[-1], x=tell("factor on the record"))
    return figure
