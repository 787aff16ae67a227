"""The criteria card as a figure: demand over threshold."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.figure import Figure
from matplotlib.patches import Patch

from seisblock.criteria.card import Row
from seisblock.present.figures import canvas
from seisblock.present.figures.heading import called, heading_over
from seisblock.present.text.criteria import DEFINITIONS
from seisblock.studies.criteria_card import Card
from seisblock.words import tell

COLOURS = {False: "#a9bccf", True: canvas.ACCENT}
"""Of a criterion, by whether it says that the block falls; light and dark, so that they differ in grey."""


def figure(cards: Sequence[Card], *, gal: bool = True) -> Figure:
    """Return the figure: demand over threshold of every criterion; right of one it says that the block falls."""
    records = [card.record for card in cards]
    heading = heading_over(records, [card.component for card in cards])
    made, axes = canvas.new_figure(
        1,
        columns=len(cards),
        width=3.2 + 3.4 * len(cards),
        height=1.6 + 0.19 * len(cards[0].rows),
        sharey=True,
        title=canvas.BETWEEN.join(part for part in (heading, _body(cards)) if part),
    )
    seen: set[bool] = set()
    for axis, card in zip(axes, cards, strict=True):
        names = [_name(row) for row in card.rows]
        ratios = [row.demand / row.threshold for row in card.rows]
        seen |= {ratio > 1.0 for ratio in ratios}
        axis.barh(names, ratios, color=[COLOURS[ratio > 1.0] for ratio in ratios], height=0.65)
        axis.axvline(1.0, color=canvas.THRESHOLD, linewidth=1.0)
        axis.tick_params(axis="y", labelsize=7)
        axis.set_ylim(-0.6, len(names) - 0.4)
        verdict = tell("overturns") if card.outcome.overturned else tell("stands")
        canvas.panel_title(axis, tell("{name}, simulated: {outcome}", name=called(card.record, card.component, records), outcome=verdict))
        canvas.label(axis, tell("demand over threshold"))
    axes[0].invert_yaxis()
    says = {False: tell("says that it stands"), True: tell("says that it overturns")}
    handles = [Patch(color=COLOURS[falls], label=says[falls]) for falls in sorted(seen)]
    canvas.legend_outside(made, handles, loc="outside lower right", ncols=2)
    return made


def _body(cards: Sequence[Card]) -> str:
    """Return which block this is; of a body that is another one in each direction its name alone."""
    block = cards[0].block
    name = tell(block.name)
    return f"{name} {block.width:.3g} × {block.height:.3g} m" if all(card.block == block for card in cards) else name


def _name(row: Row) -> str:
    """Return what a criterion is called, with the frequency that it was given."""
    definition = tell(DEFINITIONS.get(row.frequency, row.frequency)) if row.frequency else ""
    return f"{tell(row.criterion)} ({definition})" if definition else tell(row.criterion)
