"""The criteria card as a figure: demand over threshold."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.figure import Figure
from matplotlib.patches import Patch

from seisblock.core.i18n import gettext
from seisblock.criteria.compare import CriterionResult
from seisblock.report.figures import style
from seisblock.report.figures.heading import panel_label, records_heading
from seisblock.report.text.criteria import DEFINITIONS
from seisblock.studies.criteria_comparison import CriteriaComparison

COLOURS = {False: "#a9bccf", True: style.ACCENT}
"""Of a criterion, by whether it says that the block falls; light and dark, so that they differ in grey."""


def figure(cards: Sequence[CriteriaComparison], *, gal: bool = True) -> Figure:
    """Return the figure: demand over threshold of every criterion; right of one it says that the block falls."""
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
        names = [_criterion_label(row) for row in card.rows]
        ratios = [row.demand / row.threshold for row in card.rows]
        outcomes |= {ratio > 1.0 for ratio in ratios}
        axis.barh(names, ratios, color=[COLOURS[ratio > 1.0] for ratio in ratios], height=0.65)
        axis.axvline(1.0, color=style.THRESHOLD, linewidth=1.0)
        axis.tick_params(axis="y", labelsize=7)
        axis.set_ylim(-0.6, len(names) - 0.4)
        verdict = gettext("overturns") if card.outcome.overturned else gettext("stands")
        style.set_panel_title(
            axis, gettext("{name}, simulated: {outcome}", name=panel_label(card.record, card.component, records), outcome=verdict)
        )
        style.label_axes(axis, gettext("demand over threshold"))
    axes[0].invert_yaxis()
    labels = {False: gettext("says that it stands"), True: gettext("says that it overturns")}
    handles = [Patch(color=COLOURS[falls], label=labels[falls]) for falls in sorted(outcomes)]
    style.add_figure_legend(fig, handles, loc="outside lower right", ncols=2)
    return fig


def _block_label(cards: Sequence[CriteriaComparison]) -> str:
    """Return which block this is; of a body that is another one in each direction its name alone."""
    block = cards[0].block
    name = gettext(block.name)
    return f"{name} {block.width:.3g} × {block.height:.3g} m" if all(card.block == block for card in cards) else name


def _criterion_label(row: CriterionResult) -> str:
    """Return what a criterion is called, with the frequency that it was given."""
    definition = gettext(DEFINITIONS.get(row.frequency, row.frequency)) if row.frequency else ""
    return f"{gettext(row.criterion)} ({definition})" if definition else gettext(row.criterion)
