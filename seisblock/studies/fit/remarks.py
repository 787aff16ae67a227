"""What is to be known before a fit is believed."""

from __future__ import annotations

import math
from collections.abc import Iterator

from seisblock.studies.fit.axes import LAPSE, SCATTER
from seisblock.studies.fit.experiment import MOVED, Experiment, kinds_in
from seisblock.studies.fit.held_out import HeldOut
from seisblock.studies.fit.posterior import ENOUGH
from seisblock.studies.fit.summary import BOUND_TOGETHER, WORDS, Correlation, Marginal
from seisblock.words import said

FEW = 20.0
"""Blocks that are too few for what a part of the records, held out, is foretold by."""

MOST_LAPSES = 0.25
"""Where more outcomes than this follow no model, no block explains them."""


def remarks_on(
    experiment: Experiment, known: tuple[Marginal, ...], together: tuple[Correlation, ...], held: HeldOut | None, effective: float
) -> Iterator[str]:
    """Yield what is to be known before a fit is believed, a sentence each."""
    happened, stood = kinds_in(experiment)
    if not happened:
        yield said("it never fell: the outcomes bound the block on one side only, and what was thought before decides the other")
    if not stood:
        yield said("it always fell: the outcomes bound the block on one side only, and what was thought before decides the other")
    if experiment.records == 1:
        yield said("all outcomes are of one record: nothing can be held out, and how well the block foretells others is not known")
    if experiment.kind == MOVED:
        yield said("that a block rocked tells how slender it is, nothing of its size and its impacts")
    dim = [said(WORDS[each.name]) for each in known if not each.identified and each.name not in (SCATTER, LAPSE)]
    if dim:
        yield said("hardly told by these outcomes, and left to what was thought before: {names}", names=dim)
    for pair in together:
        if abs(pair.coefficient) > BOUND_TOGETHER:
            text = "{first} and {second} cannot be told apart: they go together with a correlation of {coefficient:.2f}"
            yield said(text, first=said(WORDS[pair.first]), second=said(WORDS[pair.second]), coefficient=pair.coefficient)
    lapse = next((each.median for each in known if each.name == LAPSE), 0.0)
    if lapse > MOST_LAPSES:
        yield said("no block explains these outcomes: {share:.0%} of them are taken for chance", share=lapse)
    if effective < 0.5 * ENOUGH or (held is not None and held.effective_blocks < FEW):
        few = min(effective, math.inf if held is None else held.effective_blocks)
        yield said("the intervals rest on {count:.0f} blocks only: ask for more `runs`", count=few)
