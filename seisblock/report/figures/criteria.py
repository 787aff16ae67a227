"""Figure of overturning criteria: demand over threshold."""

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
        names = [_criterion_label(row) for row in card.rows]
        ratios = [row.demand / row.threshold for row in card.rows]
        outcomes |= {ratio > 1.0 for ratio in ratios}
        axis.barh(names, ratios, color=[COLOURS[ratio > 1.0] for ratio in ratios], height=0.65)
        axis.axvline(1.0, color=style.THRESHOLD, linewidth=1.0)
        axis.tick_params(axis="y", labelsize=7)
        axis.set_ylim(-0.6, len(names) - 0.4)
        verdict = gettext("overturned") if card.outcome.overturned else gettext("did not overturn")
        style.set_panel_title(
            axis, gettext("{name}, simulation: {outcome}", name=panel_label(card.record, card.component, records), outcome=verdict)
        )
        style.label_axes(axis, gettext("demand / threshold (1)"))
    axes[0].invert_yaxis()
    labels = {False: gettext("predicted: no overturning"), True: gettext("predicted: overturning")}
    handles = [Patch(color=COLOURS[falls], label=labels[falls]) for falls in sorted(outcomes)]
    style.add_figure_legend(fig, handles, loc="outside lower right", ncols=2)
    return fig


def _block_label(cards: Sequence[CriteriaComparison]) -> str:
    """Return name and size of the block; the name alone if the size depends on the direction."""
    block = cards[0].block
    name = gettext(block.name)
    return f"{name} {block.width:.3g} × {block.height:.3g} m" if all(card.block == block for card in cards) else name


def _criterion_label(row: CriterionResult) -> str:
    """Return the name of a criterion with the definition of its frequency."""
    definition = gettext(DEFINITIONS.get(row.frequency, row.frequency)) if row.frequency else ""
    return f"{gettext(row.criterion)} ({definition})" if definition else gettext(row.criterion)
