"""Figure of overturning criteria: demand over threshold."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from seisblock.bodies.body_name import body_name
from seisblock.core.i18n import format_share, gettext
from seisblock.criteria.compare import CriterionResult
from seisblock.output.figures import style
from seisblock.output.figures.heading import panel_label, records_heading
from seisblock.output.text.shaking import shaking_text
from seisblock.report.text.criteria import DEFINITIONS
from seisblock.report.text.peaks import peaks_text
from seisblock.studies.criteria_comparison import CriteriaComparison
from seisblock.studies.scenario.peaks import PeakAssessment

COLOURS = {False: "#a9bccf", True: style.ACCENT}
"""Colour of a criterion by its prediction of overturning, distinct in greyscale."""


def figure(cards: Sequence[CriteriaComparison], *, gal: bool = True) -> Figure:
    """Return the figure: demand over threshold of every criterion; overturning is predicted above 1."""
    records = [card.record for card in cards]
    heading = records_heading(records, [card.component for card in cards])
    fig, axes = style.new_figure(
        1,
        columns=len(cards),
        width=3.2 + 3.4 * len(cards),
        height=1.6 + 0.19 * len(cards[0].rows),
        sharey=True,
        title=style.SEPARATOR.join(part for part in (heading, _block_label(cards)) if part),
    )
    outcomes: set[bool] = set()
    for axis, card in zip(axes, cards, strict=True):
        outcomes |= _draw_ratios(axis, card.rows)
        verdict = gettext("overturned") if card.outcome.overturned else gettext("did not overturn")
        style.set_panel_title(
            axis, gettext("{name}, simulation: {outcome}", name=panel_label(card.record, card.component, records), outcome=verdict)
        )
    axes[0].invert_yaxis()
    _add_legend(fig, outcomes)
    fig.set_footer([shaking_text(card.component, card.shaking, gal=gal) for card in cards])
    return fig


def peaks_figure(result: PeakAssessment, *, gal: bool = True) -> Figure:
    """Return the figure of the criteria for the peaks of a motion without a record."""
    block = result.block
    size = f"{gettext(body_name(block.name))} {block.width:.3g} × {block.height:.3g} m"
    title = style.SEPARATOR.join((peaks_text(result, gal=gal), size))
    fig, (axis,) = style.new_figure(1, width=6.6, height=1.6 + 0.19 * len(result.rows), title=title)
    outcomes = _draw_ratios(axis, result.rows)
    axis.invert_yaxis()
    if result.suite is not None:
        share = format_share(result.suite.overturning_probability)
        style.set_panel_title(axis, gettext("overturning probability {share}, {count} records", share=share, count=result.suite.records))
    _add_legend(fig, outcomes)
    return fig


def _draw_ratios(axis: Axes, rows: Sequence[CriterionResult]) -> set[bool]:
    """Draw demand over threshold of each criterion and return the predictions that occur."""
    names = [_criterion_label(row) for row in rows]
    ratios = [row.demand / row.threshold for row in rows]
    axis.barh(names, ratios, color=[COLOURS[ratio > 1.0] for ratio in ratios], height=0.65)
    axis.axvline(1.0, color=style.THRESHOLD, linewidth=1.0)
    axis.tick_params(axis="y", labelsize=7)
    axis.set_ylim(-0.6, len(names) - 0.4)
    style.label_axes(axis, gettext("demand / threshold (1)"))
    return {ratio > 1.0 for ratio in ratios}


def _add_legend(fig: Figure, outcomes: set[bool]) -> None:
    labels = {False: gettext("predicted: no overturning"), True: gettext("predicted: overturning")}
    handles = [Patch(color=COLOURS[falls], label=labels[falls]) for falls in sorted(outcomes)]
    style.add_figure_legend(fig, handles, loc="outside lower right", ncols=2)


def _block_label(cards: Sequence[CriteriaComparison]) -> str:
    """Return name and size of the block; the name alone if the size depends on the direction."""
    block = cards[0].block
    name = gettext(body_name(block.name))
    return f"{name} {block.width:.3g} × {block.height:.3g} m" if all(card.block == block for card in cards) else name


def _criterion_label(row: CriterionResult) -> str:
    """Return the name of a criterion with the definition of its frequency."""
    definition = gettext(DEFINITIONS.get(row.frequency, row.frequency)) if row.frequency else ""
    return f"{gettext(row.criterion)} ({definition})" if definition else gettext(row.criterion)
