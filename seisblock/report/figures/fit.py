"""Figure of a fit: posterior of each parameter, calibration, and outcomes over PGA and PGV/PGA."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from seisblock.core.i18n import N_, format_percent, gettext
from seisblock.output.figures import style
from seisblock.output.figures.log_ticks import round_ticks
from seisblock.output.figures.style import ACCENT, INPUT, SECOND, add_figure_legend, add_legend, label_axes, set_panel_title
from seisblock.output.units_display import acceleration_unit
from seisblock.report.text.fit import NAMES
from seisblock.studies.fit.dataset import FELL, MOVED
from seisblock.studies.fit.fit import BlockFit
from seisblock.studies.fit.priors import Prior

BINS = 40
"""Bins of the histogram of a parameter."""

PANELS_WIDE, PANELS_NARROW = 5, 2
"""Panels of parameters per row, normal and narrow."""

_TITLE = {
    FELL: N_("{table}: overturned in {happened} of {outcomes} outcomes, {records} records"),
    MOVED: N_("{table}: moved in {happened} of {outcomes} outcomes, {records} records"),
}
_SHARE = {FELL: N_("fraction overturned (1)"), MOVED: N_("fraction moved (1)")}
_EVENT = {FELL: N_("overturned"), MOVED: N_("moved")}
_NO_EVENT = {FELL: N_("did not overturn"), MOVED: N_("did not move")}


@style.narrow_too
def fit_figure(fit: BlockFit, name: str, *, gal: bool = True, narrow: bool = False) -> style.StyledFigure:
    """Return the figure: a panel per parameter, cross-validated calibration, and outcomes over PGA and PGV/PGA.

    Panels stacked if `narrow`.

    Parameters
    ----------
    fit : BlockFit
    name : str
        Name of the table of outcomes.
    gal : bool
        Unit of accelerations, else m/s^2.
    """
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
    """Draw posterior and prior of one parameter."""
    style.style_axes(panel)
    marginal, values = fit[axis.name], fit.draws[axis.name]
    spread = float(values.max() - values.min()) or 1.0
    low, high = max(axis.low, float(values.min()) - 0.15 * spread), min(axis.high, float(values.max()) + 0.15 * spread)
    edges = np.linspace(low, high, BINS + 1)
    panel.hist(values, bins=edges.tolist(), density=True, color="0.75", label=gettext("posterior"))
    prior = 1.0 / (edges * math.log(axis.high / axis.low)) if axis.logarithmic else np.full(edges.size, 1.0 / (axis.high - axis.low))
    panel.plot(edges, prior, color=SECOND, linewidth=1.0, linestyle=(0, (4, 2)), label=gettext("prior"))
    panel.axvline(marginal.median, color=ACCENT, linewidth=1.3, label=gettext("median"))
    panel.axvspan(*marginal.interval, color=ACCENT, alpha=0.12, linewidth=0, label=format_percent(fit.level, "g"))
    panel.set_xlim(low, high)
    panel.set_yticks([])
    panel.locator_params(axis="x", nbins=4)
    label_axes(panel, x=gettext(NAMES[axis.name]))
    if first:
        label_axes(panel, y=gettext("density"))


def _draw_calibration(panel: Axes, fit: BlockFit) -> None:
    """Draw the observed fraction against the predicted probability, cross-validated."""
    set_panel_title(panel, gettext("calibration (cross-validated by record)"))
    panel.plot([0.0, 1.0], [0.0, 1.0], color=INPUT, linewidth=0.9, linestyle=(0, (4, 2)))
    steps = fit.held_out.calibration if fit.held_out is not None else ()
    for step in steps:
        panel.plot([step.mean_probability] * 2, step.share_interval, color=ACCENT, linewidth=1.0, marker="_", markersize=5)
        panel.plot([step.mean_probability], [step.share], "o", color=ACCENT, markersize=4.5)
        panel.annotate(str(step.outcomes), (step.mean_probability, step.share), xytext=(5, -9), textcoords="offset points", fontsize=7)
    panel.set_xlim(-0.03, 1.06)
    panel.set_ylim(-0.08, 1.05)
    label_axes(panel, x=gettext("predicted probability (1)"), y=gettext(_SHARE[fit.experiment.kind]))


def _draw_outcomes(panel: Axes, fit: BlockFit, *, gal: bool) -> None:
    """Draw the outcomes over PGA and PGV/PGA; mispredicted ones are circled."""
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
        panel.scatter(slow[mispredicted], fit.pga_m_s2[mispredicted] / unit, label=gettext("mispredicted"), **look)
    panel.set_yscale("log")
    panel.set_xscale("log")
    for ruler in (panel.xaxis, panel.yaxis):
        round_ticks(ruler)
    label_axes(panel, x=gettext("PGV/PGA (s)"), y=gettext("PGA ({unit})", unit=name))
    add_legend(panel, ncols=3)
