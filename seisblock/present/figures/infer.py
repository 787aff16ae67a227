"""Inferred shaking in pictures: the trade-off of PGA and frequency, likelihoods, displacement against the factor on a record."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seisblock.present.figures.canvas import ACCENT, INPUT, SECOND, label, legend, new_figure, panel_title, threshold
from seisblock.present.figures.heading import called, heading_over
from seisblock.present.scales import acceleration_unit, length_unit
from seisblock.records import Record
from seisblock.studies.inverse.assumptions import Assumptions
from seisblock.studies.inverse.estimate import ShakingEstimate, contour
from seisblock.studies.inverse.survey import Survey
from seisblock.typing import FloatArray
from seisblock.words import percent, tell

if TYPE_CHECKING:
    from seisblock.studies.inverse.factors import ScaleFactors

LEVELS = (0.5, 0.9)
"""Shares of the likelihood's mass at each frequency that the bands hold."""

SHOWN_PGA = (0.5, 40.0)
"""Range of PGA drawn, m/s^2."""

TICKS = (1.0, 2.0, 5.0, 10.0, 20.0)
"""Values of PGA that are named, m/s^2."""

FEW_TICKS = (1.0, 3.0, 10.0, 30.0)
"""Those along an axis, where numbers stand side by side."""

FINE = tuple(np.geomspace(0.3, 4.0, 31).tolist())
"""Frequencies of the contour, Hz."""


def estimate_figure(
    name: str, survey: Survey, assumptions: Assumptions, estimates: Sequence[ShakingEstimate], *, gal: bool = True
) -> Figure:
    """Return the figure: the trade-off of PGA and frequency with its bands, and the likelihood over PGA at some frequencies.

    Parameters
    ----------
    name : str
    survey, assumptions : Survey, Assumptions
    estimates : sequence of ShakingEstimate
        Those with a frequency are drawn as points with their intervals.
    gal : bool
        Unit of accelerations, else m/s^2.
    """
    title = tell("{name}: {fallen} of {all} stones fell", name=name, fallen=survey.fell, all=survey.judged)
    figure, (left, right) = new_figure(1, columns=2, width=9.6, height=4.2, title=title)
    unit, _ = acceleration_unit(gal=gal)
    _trade_off(left, survey, assumptions, gal=gal)
    chosen = [each for each in estimates if each.stones == estimates[-1].stones and each.frequency_hz is not None]
    for each in chosen:
        ends = [end / unit for end in each.pga_interval_m_s2 if end is not None]
        at = each.frequency_hz or math.nan
        left.plot([at] * len(ends), ends, color=ACCENT, linewidth=1.0, marker="_", markersize=6, zorder=3)
        if each.pga_m_s2 is not None:
            left.plot([at], [each.pga_m_s2 / unit], "o", color=ACCENT, markersize=4, zorder=4)
    _likelihoods(right, survey, assumptions, chosen, gal=gal)
    return figure


def _trade_off(axis: Axes, survey: Survey, assumptions: Assumptions, *, gal: bool) -> None:
    """Draw the bands of PGA against frequency."""
    unit, name = acceleration_unit(gal=gal)
    shown = [each / unit for each in SHOWN_PGA]
    for level, shade in zip(sorted(LEVELS, reverse=True), ("0.9", "0.72"), strict=True):
        line = contour(survey, replace(assumptions, level=level), FINE)
        low, high = ([math.nan if e.pga_interval_m_s2[i] is None else e.pga_interval_m_s2[i] for e in line] for i in (0, 1))
        lowest, highest = (np.array(end, dtype=np.float64) / unit for end in (low, high))
        _band(axis, lowest, highest, shown, shade, percent(level, "g"))
        if level == max(LEVELS) and line[0].pga_m_s2 is not None:
            axis.plot(FINE, [(e.pga_m_s2 or math.nan) / unit for e in line], color="0.15", linewidth=1.2, label=tell("median"))
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xticks([0.5, 1.0, 2.0, 3.0], ["0.5", "1", "2", "3"])
    axis.minorticks_off()
    axis.set_yticks([each / unit for each in TICKS], [f"{each / unit:g}" for each in TICKS])
    axis.set_xlim(FINE[0], FINE[-1])
    axis.set_ylim(*shown)
    label(axis, x=tell("equivalent frequency (Hz)"), y=tell("PGA ({unit})", unit=name))
    legend(axis)


def _band(axis: Axes, low: FloatArray, high: FloatArray, shown: Sequence[float], shade: str, name: str) -> None:
    """Draw a band, or the side of a bound on which the shaking lies."""
    if np.isnan(low).all():
        low, name = np.full(len(FINE), shown[0]), tell("{level}, upper bound", level=name)
    elif np.isnan(high).all():
        high, name = np.full(len(FINE), shown[1]), tell("{level}, lower bound", level=name)
    axis.fill_between(FINE, low, high, color=shade, linewidth=0, label=name)


def _likelihoods(axis: Axes, survey: Survey, assumptions: Assumptions, chosen: Sequence[ShakingEstimate], *, gal: bool) -> None:
    """Draw the likelihood over PGA at the frequencies chosen, or at three."""
    unit, name = acceleration_unit(gal=gal)
    frequencies = [each.frequency_hz for each in chosen if each.frequency_hz is not None] or [1.0, 2.0, 3.0]
    for index, f in enumerate(frequencies):
        (found,) = assumptions.likelihoods(survey, [f])
        share = index / max(len(frequencies) - 1, 1)
        colour = ACCENT if len(frequencies) == 1 else str(round(0.15 + 0.55 * share, 2))
        dashes = ("-", (0, (5, 1.5)), (0, (1.5, 1.2)))[index % 3]
        pga, value = np.exp(found.log_pga) / unit, found.value / found.value.max()
        axis.plot(pga, value, color=colour, linestyle=dashes, linewidth=1.2, label=f"{f:.3g} Hz")
    axis.set_xscale("log")
    axis.set_xlim(*(each / unit for each in SHOWN_PGA))
    axis.set_xticks([each / unit for each in FEW_TICKS], [f"{each / unit:g}" for each in FEW_TICKS])
    axis.minorticks_off()
    label(axis, x=tell("PGA ({unit})", unit=name), y=tell("likelihood (over its largest)"))
    legend(axis, ncols=6)


def factor_figure(found: Sequence[tuple[Record, ScaleFactors]], *, gal: bool = True) -> Figure:
    """Return the figure: displacement against the factor, the observed one and the factors that give it, a panel per component."""
    records = [record for record, _ in found]
    title = heading_over(records, [each.component for _, each in found])
    figure, axes = new_figure(len(found), height=1.4 + 1.9 * len(found), title=title)
    far = length_unit((each.observed_m for _, each in found), gal=gal)
    for axis, (record, each) in zip(axes, found, strict=True):
        scales, values = each.curve
        axis.plot(scales, np.array(values) / far.size, color=SECOND, linewidth=1.0)
        threshold(axis, [each.observed_m / far.size], tell("observed"))
        for marker, leaps, text in (("o", False, tell("solution")), ("x", True, tell("leaps across"))):
            points = [f.scale for f in each.scale_factors if f.leaps == leaps]
            if points:
                axis.plot(points, [each.observed_m / far.size] * len(points), marker, color=ACCENT, markersize=5, label=text)
        axis.axvline(1.0, color=INPUT, linewidth=0.8, linestyle=(0, (1, 2)), label=tell("as recorded"))
        panel_title(axis, called(record, each.component, records))
        label(axis, y=tell("displacement ({unit})", unit=far.name))
        legend(axis)
    label(axes[-1], x=tell("factor on the record"))
    return figure
