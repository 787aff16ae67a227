"""A fit in pictures: what is known of each parameter, whether probabilities are what they say, and which records were foretold wrongly."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from seisblock.core.i18n import N_, format_percent, gettext
from seisblock.report.figures import style
from seisblock.report.figures.log_ticks import round_ticks
from seisblock.report.figures.style import ACCENT, INPUT, SECOND, add_figure_legend, add_legend, label_axes, set_panel_title
from seisblock.report.text.fit import NAMES
from seisblock.report.units_display import acceleration_unit
from seisblock.studies.fit.dataset import FELL, MOVED
from seisblock.studies.fit.fit import BlockFit
from seisblock.studies.fit.priors import Prior

BINS = 40
"""Of what is known of a parameter, over what its blocks span."""

PANELS_WIDE, PANELS_NARROW = 5, 2
"""Parameters beside each other, and where the figure is narrow."""

_TITLE = {
    FELL: N_("{table}: fell in {happened} of {outcomes} outcomes, {records} records"),
    MOVED: N_("{table}: moved in {happened} of {outcomes} outcomes, {records} records"),
}
_SHARE = {FELL: N_("share that fell"), MOVED: N_("share that moved")}
_EVENT = {FELL: N_("fell"), MOVED: N_("moved")}
_NO_EVENT = {FELL: N_("stood"), MOVED: N_("did not move")}


def fit_figure(fit: BlockFit, name: str, *, gal: bool = True) -> Figure:
    """Return the figure: a panel for each parameter, the calibration of records held out, and the records by PGA and PGV over PGA.

    Parameters
    ----------
    fit : BlockFit
    name : str
        Of the table.
    gal : bool
        Unit of accelerations, else m/s^2.
    """
    fig = _build_figure(fit, name, gal=gal)
    fig.narrow_layout = lambda: _build_figure(fit, name, gal=gal, narrow=True)
    return fig


def _build_figure(fit: BlockFit, name: str, *, gal: bool, narrow: bool = False) -> style.StyledFigure:
    """Return the figure, its panels below each other where it is narrow."""
    experiment = fit.experiment
    counts = {"happened": int(experiment.happened.sum()), "outcomes": len(experiment.outcomes), "records": experiment.records}
    title = gettext(_TITLE[experiment.kind], table=name, **counts)
    panels_per_row = min(PANELS_NARROW if narrow else PANELS_WIDE, len(fit.axes))
    rows = math.ceil(len(fit.axes) / panels_per_row)
    panel_rows = 2 if narrow else 1
    fig = style.titled_figure(title, width=5.0 if narrow else 9.6, height=0.8 + 1.9 * rows + 3.4 * panel_rows)
    grid = fig.add_gridspec(2, 1, height_ratios=(1.9 * rows, 3.4 * panel_rows))
    upper, lower = grid[0].subgridspec(rows, panels_per_row), grid[1].subgridspec(panel_rows, 3 - panel_rows)
    for k, axis in enumerate(fit.axes):
        panel = fig.add_subplot(upper[k // panels_per_row, k % panels_per_row])
        _draw_marginal(panel, fit, axis, first=k == 0)
        if k == 0:
            add_figure_legend(fig, panel.get_legend_handles_labels()[0], loc="outside upper right", ncols=4)
    left, right = (fig.add_subplot(lower[(k, 0) if narrow else (0, k)]) for k in range(2))
    for panel in (left, right):
        style.style_axes(panel)
    _draw_calibration(left, fit)
    _draw_outcomes(right, fit, gal=gal)
    return fig


def _draw_marginal(panel: Axes, fit: BlockFit, axis: Prior, *, first: bool) -> None:
    """Draw what is known of one parameter, and what was thought before."""
    style.style_axes(panel)
    marginal, values = fit[axis.name], fit.draws[axis.name]
    spread = float(values.max() - values.min()) or 1.0
    low, high = max(axis.low, float(values.min()) - 0.15 * spread), min(axis.high, float(values.max()) + 0.15 * spread)
    edges = np.linspace(low, high, BINS + 1)
    panel.hist(values, bins=edges.tolist(), density=True, color="0.75", label=gettext("after"))
    prior = 1.0 / (edges * math.log(axis.high / axis.low)) if axis.logarithmic else np.full(edges.size, 1.0 / (axis.high - axis.low))
    panel.plot(edges, prior, color=SECOND, linewidth=1.0, linestyle=(0, (4, 2)), label=gettext("before"))
    panel.axvline(marginal.median, color=ACCENT, linewidth=1.3, label=gettext("median"))
    panel.axvspan(*marginal.interval, color=ACCENT, alpha=0.12, linewidth=0, label=format_percent(fit.level, "g"))
    panel.set_xlim(low, high)
    panel.set_yticks([])
    panel.locator_params(axis="x", nbins=4)
    label_axes(panel, x=gettext(NAMES[axis.name]))
    if first:
        label_axes(panel, y=gettext("density"))


def _draw_calibration(panel: Axes, fit: BlockFit) -> None:
    """Draw what happened where each probability was foretold."""
    set_panel_title(panel, gettext("calibration, records held out"))
    panel.plot([0.0, 1.0], [0.0, 1.0], color=INPUT, linewidth=0.9, linestyle=(0, (4, 2)))
    steps = fit.held_out.calibration if fit.held_out is not None else ()
    for step in steps:
        panel.plot([step.mean_probability] * 2, step.share_interval, color=ACCENT, linewidth=1.0, marker="_", markersize=5)
        panel.plot([step.mean_probability], [step.share], "o", color=ACCENT, markersize=4.5)
        panel.annotate(str(step.outcomes), (step.mean_probability, step.share), xytext=(5, -9), textcoords="offset points", fontsize=7)
    panel.set_xlim(-0.03, 1.06)
    panel.set_ylim(-0.08, 1.05)
    label_axes(panel, x=gettext("probability foretold"), y=gettext(_SHARE[fit.experiment.kind]))


def _draw_outcomes(panel: Axes, fit: BlockFit, *, gal: bool) -> None:
    """Draw the outcomes by the strength and the slowness of the shaking; those that were foretold wrongly are ringed."""
    unit, name = acceleration_unit(gal=gal)
    kind, occurred = fit.experiment.kind, fit.experiment.happened > 0.5
    strong = fit.pga_m_s2 > 0.0
    slow = fit.pgv_m_s / np.where(strong, fit.pga_m_s2, 1.0)
    for selection, marker, fill, text in ((occurred, "o", ACCENT, _EVENT[kind]), (~occurred, "s", "none", _NO_EVENT[kind])):
        edge = ACCENT if fill != "none" else SECOND
        rows = selection & strong
        look: dict[str, Any] = {"s": 13, "marker": marker, "facecolors": fill, "edgecolors": edge, "linewidths": 0.8}
        panel.scatter(slow[rows], fit.pga_m_s2[rows] / unit, label=gettext(text), **look)
    if fit.probability_held_out is not None:
        mispredicted = (np.abs(fit.probability_held_out - occurred) >= 0.5) & strong
        look = {"s": 70, "facecolors": "none", "edgecolors": "0.1", "linewidths": 0.9}
        panel.scatter(slow[mispredicted], fit.pga_m_s2[mispredicted] / unit, label=gettext("foretold wrongly"), **look)
    panel.set_yscale("log")
    panel.set_xscale("log")
    for ruler in (panel.xaxis, panel.yaxis):
        round_ticks(ruler)
    label_axes(panel, x=gettext("PGV over PGA (s)"), y=gettext("PGA ({unit})", unit=name))
    add_legend(panel, ncols=3)
