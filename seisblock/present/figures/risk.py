"""The risk at a site in pictures: the hazard with its branches, the fragilities, and which shaking the frequency comes from."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seisblock.present.figures.canvas import ACCENT, INPUT, SECOND, label, legend, legend_outside, new_figure
from seisblock.present.figures.rulers import round_ticks
from seisblock.present.text.risk import name_of
from seisblock.present.wrap import columns
from seisblock.studies.fragility.intensity import intensity_measure
from seisblock.studies.hazard.curve import Hazard
from seisblock.studies.hazard.given import GivenFragility
from seisblock.studies.hazard.risk import Risk
from seisblock.words import tell

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
"""Of the fragilities, in their order: nine differ in grey, thirty-six in colour and line together."""

MOST_ABOVE = 64
"""Columns of letters that names over their panel take, lines and all; what takes more stands below the figure, a row each."""

OF_A_LINE = 8
"""Columns that the line before a name takes."""

NAME_ROW = 0.17
"""Height of a row of names, inch."""

POINTS = 241


def figure(found: Sequence[tuple[GivenFragility, Risk]], hazard: Hazard, *, gal: bool = True) -> Figure:
    """Return the figure: hazard, fragility, and the frequency per ratio of intensity, above each other.

    Parameters
    ----------
    found : sequence of (GivenFragility, Risk)
    hazard : Hazard
    gal : bool
        Unit of the intensities: gal, kine and cm, else SI.
    """
    measure = intensity_measure(hazard.im)
    size, unit = measure.shown(gal=gal)
    names = [name_of(given, gal=gal) or tell("fragility") for given, _ in found]
    outside = sum(columns(name) + OF_A_LINE for name in names) > MOST_ABOVE
    what = names[0] if len(found) == 1 else tell("{count} fragilities", count=len(found))
    title = tell("Risk: {what}, hazard in {measure}", what=what, measure=measure.label)
    made, (above, middle, below) = new_figure(3, width=6.4, height=7.4 + (NAME_ROW * len(found) if outside else 0.0), title=title)
    x = _reach(found, hazard)
    _hazard(above, hazard, x, size)
    for index, (given, risk) in enumerate(found):
        colour, dashes = _look(index)
        middle.plot(x / size, given.curve.probability(x), color=colour, linestyle=dashes, linewidth=1.4, label=names[index])
        _density(below, risk, size, look=(colour, dashes), filled=not outside)
    below.set_xscale("log")
    label(above, y=tell("exceeded (1/year)"))
    label(middle, y=tell("probability"))
    label(below, x=f"{measure.label} ({unit})" if unit else measure.label, y=tell("rate per decade (1/year)"))
    middle.set_ylim(-0.02, 1.02)
    below.set_ylim(bottom=0.0)
    round_ticks(below.xaxis)
    legend(above)
    if outside:
        legend_outside(made, middle.get_legend_handles_labels()[0], loc="outside lower left", ncols=1)
    else:
        legend(middle)
    return made


def _look(index: int) -> tuple[str, Any]:
    """Return colour and line of a fragility."""
    return COLOURS[index % len(COLOURS)], DASHES[index % len(DASHES)]


def _reach(found: Sequence[tuple[GivenFragility, Risk]], hazard: Hazard) -> np.ndarray:
    """Return the intensities to draw: the levels of the hazard, and where the fragilities rise."""
    ends = [end for branch in hazard.branches for end in (np.min(branch.levels), np.max(branch.levels))]
    ends += [given.curve.at(share) for given, _ in found for share in (0.01, 0.99)]
    return np.geomspace(min(ends), max(ends), POINTS)


def _hazard(axis: Axes, hazard: Hazard, x: np.ndarray, size: float) -> None:
    """Draw the curves: points where the table has them."""
    axis.set_yscale("log")
    several = len(hazard.branches) > 1
    for index, branch in enumerate(hazard.branches if several else ()):
        text = tell("branches") if index == 0 else None
        axis.plot(x / size, branch.rate(x), color=INPUT, linewidth=0.8, label=text)
    axis.plot(x / size, hazard.rate(x), color="0.1", linewidth=1.4, label=tell("mean") if several else tell("hazard"))
    levels = np.unique(np.concatenate([np.asarray(branch.levels) for branch in hazard.branches]))
    axis.plot(levels / size, hazard.rate(levels), "o", color="0.1", markersize=3)


def _density(axis: Axes, risk: Risk, size: float, *, look: tuple[Any, Any], filled: bool) -> None:
    """Draw where the frequency comes from: what shaking between two levels contributes, per decade."""
    inner = risk.disaggregation[1:-1]
    edges = np.array([inner[0].im_from, *(each.im_to for each in inner)], dtype=np.float64)
    density = np.array([each.annual_rate for each in inner]) / np.diff(np.log10(edges))
    colour, dashes = look
    if filled:
        axis.stairs(density, edges / size, color=colour, alpha=0.14, fill=True)
    axis.stairs(density, edges / size, color=colour, linestyle=dashes, linewidth=1.2)
