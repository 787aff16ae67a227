"""The criteria card as a figure: demand over threshold."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.figure import Figure

from seisblock.criteria.card import Row
from seisblock.present.figures import canvas
from seisblock.present.text.criteria import DEFINITIONS
from seisblock.studies.criteria_card import Card
from seisblock.words import tell


def figure(cards: Sequence[Card], *, gal: bool = True) -> Figure:
    """Return the figure: demand over threshold of every criterion; right of one it says that the block falls."""
    made, axes = canvas.new_figure(1, columns=len(cards), width=3.2 + 3.4 * len(cards), height=1.2 + 0.19 * len(cards[0].rows), sharey=True)
    for axis, card in zip(axes, cards, strict=True):
        names = [_name(row) for row in card.rows]
        ratios = [row.demand / row.threshold for row in card.rows]
        colours = [canvas.ACCENT if ratio > 1 else canvas.SECOND for ratio in ratios]
        axis.barh(names, ratios, color=colours, height=0.65)
        axis.axvline(1.0, color=canvas.THRESHOLD, linewidth=1.0)
        axis.tick_params(axis="y", labelsize=7)
        axis.set_ylim(-0.6, len(names) - 0.4)
        verdict = tell("overturns") if card.outcome.overturned else tell("stands")
        axis.set_title(tell("{name}, simulated: {outcome}", name=card.component, outcome=verdict), fontsize=9, loc="left")
        canvas.label(axis, tell("demand over threshold"))
    axes[0].invert_yaxis()
    return made


def _name(row: Row) -> str:
    """Return what a criterion is called, with the frequency that it was given."""
    definition = tell(DEFINITIONS.get(row.frequency, row.frequency)) if row.frequency else ""
    return f"{tell(row.criterion)} ({definition})" if definition else tell(row.criterion)
