"""A fit in pictures: what is known of each parameter, whether probabilities are what they say, and which records were foretold wrongly."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seisblock.present.figures import canvas
from seisblock.present.figures.canvas import ACCENT, INPUT, SECOND, label, legend, legend_outside, panel_title
from seisblock.present.figures.rulers import round_ticks
from seisblock.present.scales import acceleration_unit
from seisblock.present.text.fit import NAMES
from seisblock.studies.fit.axes import Axis
from seisblock.studies.fit.experiment import FELL, MOVED
from seisblock.studies.fit.fit import BlockFit
from seisblock.words import noted, percent, tell

BINS = 40
"""Of what is known of a parameter, over what its blocks span."""

BESIDE, ABOVE = 5, 2
"""Parameters beside each other, and where the figure is narrow."""

_TITLE = {
    FELL: noted("{table}: fell in {happened} of {outcomes} outcomes, {records} records"),
    MOVED: noted("{table}: moved in {happened} of {outcomes} outcomes, {records} records"),
}
_SHARE = {FELL: noted("share that fell"), MOVED: noted("share that moved")}
_DID = {FELL: noted("fell"), MOVED: noted("moved")}
_DID_NOT = {FELL: noted("stood"), MOVED: noted("did not move")}


def fit_figure(found: BlockFit, name: str, *, gal: bool = True) -> Figure:
    """Return the figure: a panel for each parameter, the calibration of records held out, and the records by PGA and PGV over PGA.

    Parameters
    ----------
    found : BlockFit
    name : str
        Of the table.
    gal : bool
        Unit of accelerations, else m/s^2.
    """
    made = _drawn(found, name, gal=gal)
    made.stacked = lambda: _drawn(found, name, gal=gal, stacked=True)
    return made


def _drawn(found: BlockFit, name: str, *, gal: bool, stacked: bool = False) -> canvas.Sheet:
    """Return the figure, its panels below each other where it is narrow."""
    experiment = found.experiment
    counts = {"happened": int(experiment.happened.sum()), "outcomes": len(experiment.outcomes), "records": experiment.records}
    title = tell(_TITLE[experiment.kind], table=name, **counts)
    abreast = min(ABOVE if stacked else BESIDE, len(found.axes))
    rows = math.ceil(len(found.axes) / abreast)
    below = 2 if stacked else 1
    made = canvas.titled(title, width=5.0 if stacked else 9.6, height=0.8 + 1.9 * rows + 3.4 * below)
    whole = made.add_gridspec(2, 1, height_ratios=(1.9 * rows, 3.4 * below))
    upper, lower = whole[0].subgridspec(rows, abreast), whole[1].subgridspec(below, 3 - below)
    for k, axis in enumerate(found.axes):
        panel = made.add_subplot(upper[k // abreast, k % abreast])
        _known(panel, found, axis, first=k == 0)
        if k == 0:
            legend_outside(made, panel.get_legend_handles_labels()[0], loc="outside upper right", ncols=4)
    left, right = (made.add_subplot(lower[(k, 0) if stacked else (0, k)]) for k in range(2))
    for panel in (left, right):
        canvas.dress(panel)
    _calibrated(left, found)
    _outcomes(right, found, gal=gal)
    return made


def _known(panel: Axes, found: BlockFit, axis: Axis, *, first: bool) -> None:
    """Draw what is known of one parameter, and what was thought before."""
    canvas.dress(panel)
    known, values = found[axis.name], found.draws[axis.name]
    spread = float(values.max() - values.min()) or 1.0
    low, high = max(axis.low, float(values.min()) - 0.15 * spread), min(axis.high, float(values.max()) + 0.15 * spread)
    edges = np.linspace(low, high, BINS + 1)
    panel.hist(values, bins=edges.tolist(), density=True, color="0.75", label=tell("after"))
    before = 1.0 / (edges * math.log(axis.high / axis.low)) if axis.logarithmic else np.full(edges.size, 1.0 / (axis.high - axis.low))
    panel.plot(edges, before, color=SECOND, linewidth=1.0, linestyle=(0, (4, 2)), label=tell("before"))
    panel.axvline(known.median, color=ACCENT, linewidth=1.3, label=tell("median"))
    panel.axvspan(*known.interval, color=ACCENT, alpha=0.12, linewidth=0, label=percent(found.level, "g"))
    panel.set_xlim(low, high)
    panel.set_yticks([])
    panel.locator_params(axis="x", nbins=4)
    label(panel, x=tell(NAMES[axis.name]))
    if first:
        label(panel, y=tell("density"))


def _calibrated(panel: Axes, found: BlockFit) -> None:
    """Draw what happened where each probability was foretold."""
    panel_title(panel, tell("calibration, records held out"))
    panel.plot([0.0, 1.0], [0.0, 1.0], color=INPUT, linewidth=0.9, linestyle=(0, (4, 2)))
    steps = found.held_out.calibration if found.held_out is not None else ()
    for step in steps:
        panel.plot([step.mean_probability] * 2, step.share_interval, color=ACCENT, linewidth=1.0, marker="_", markersize=5)
        panel.plot([step.mean_probability], [step.share], "o", color=ACCENT, markersize=4.5)
        panel.annotate(str(step.outcomes), (step.mean_probability, step.share), xytext=(5, -9), textcoords="offset points", fontsize=7)
    panel.set_xlim(-0.03, 1.06)
    panel.set_ylim(-0.08, 1.05)
    label(panel, x=tell("probability foretold"), y=tell(_SHARE[found.experiment.kind]))


def _outcomes(panel: Axes, found: BlockFit, *, gal: bool) -> None:
    """Draw the outcomes by the strength and the slowness of the shaking; those that were foretold wrongly are ringed."""
    unit, name = acceleration_unit(gal=gal)
    kind, happened = found.experiment.kind, found.experiment.happened > 0.5
    strong = found.pga_m_s2 > 0.0
    slow = found.pgv_m_s / np.where(strong, found.pga_m_s2, 1.0)
    for chosen, marker, fill, text in ((happened, "o", ACCENT, _DID[kind]), (~happened, "s", "none", _DID_NOT[kind])):
        edge = ACCENT if fill != "none" else SECOND
        rows = chosen & strong
        look: dict[str, Any] = {"s": 13, "marker": marker, "facecolors": fill, "edgecolors": edge, "linewidths": 0.8}
        panel.scatter(slow[rows], found.pga_m_s2[rows] / unit, label=tell(text), **look)
    if found.probability_held_out is not None:
        wrong = (np.abs(found.probability_held_out - happened) >= 0.5) & strong
        look = {"s": 70, "facecolors": "none", "edgecolors": "0.1", "linewidths": 0.9}
        panel.scatter(slow[wrong], found.pga_m_s2[wrong] / unit, label=tell("foretold wrongly"), **look)
    panel.set_yscale("log")
    panel.set_xscale("log")
    for ruler in (panel.xaxis, panel.yaxis):
        round_ticks(ruler)
    label(panel, x=tell("PGV over PGA (s)"), y=tell("PGA ({unit})", unit=name))
    legend(panel, ncols=3)
