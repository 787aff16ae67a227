"""What is to be known before a fit is believed."""

from __future__ import annotations

import math
from collections.abc import Iterator

from seisblock.core.i18n import lazy_gettext
from seisblock.studies.fit.cross_validation import HeldOutScores
from seisblock.studies.fit.dataset import MOVED, Experiment, outcome_weights
from seisblock.studies.fit.importance_sampling import TARGET_EFFECTIVE
from seisblock.studies.fit.posterior_summary import HIGH_CORRELATION, PARAMETER_LABELS, Correlation, Marginal
from seisblock.studies.fit.priors import LAPSE, SCATTER

MIN_EFFECTIVE_HELD_OUT = 20.0
"""Blocks that are too few for what a part of the records, held out, is foretold by."""

MAX_LAPSE_RATE = 0.25
"""Where more outcomes than this follow no model, no block explains them."""


def fit_warnings(
    experiment: Experiment,
    marginals: tuple[Marginal, ...],
    correlations: tuple[Correlation, ...],
    held_out: HeldOutScores | None,
    effective: float,
) -> Iterator[str]:
    """Yield what is to be known before a fit is believed, a sentence each."""
    happened, stood = outcome_weights(experiment)
    if not happened:
        yield lazy_gettext("it never fell: the outcomes bound the block on one side only, and what was thought before decides the other")
    if not stood:
        yield lazy_gettext("it always fell: the outcomes bound the block on one side only, and what was thought before decides the other")
    if experiment.records == 1:
        yield lazy_gettext("all outcomes are of one record: nothing can be held out, and how well the block foretells others is not known")
    if experiment.kind == MOVED:
        yield lazy_gettext("that a block rocked tells how slender it is, nothing of its size and its impacts")
    unidentified = [
        lazy_gettext(PARAMETER_LABELS[marginal.name])
        for marginal in marginals
        if not marginal.identified and marginal.name not in (SCATTER, LAPSE)
    ]
    if unidentified:
        yield lazy_gettext("hardly told by these outcomes, and left to what was thought before: {names}", names=unidentified)
    for pair in correlations:
        if abs(pair.coefficient) > HIGH_CORRELATION:
            text = "{first} and {second} cannot be told apart: they go together with a correlation of {coefficient:.2f}"
            yield lazy_gettext(
                text,
                first=lazy_gettext(PARAMETER_LABELS[pair.first]),
                second=lazy_gettext(PARAMETER_LABELS[pair.second]),
                coefficient=pair.coefficient,
            )
    lapse = next((marginal.median for marginal in marginals if marginal.name == LAPSE), 0.0)
    if lapse > MAX_LAPSE_RATE:
        yield lazy_gettext("no block explains these outcomes: {share:.0%} of them are taken for chance", share=lapse)
    if effective < 0.5 * TARGET_EFFECTIVE or (held_out is not None and held_out.effective_blocks < MIN_EFFECTIVE_HELD_OUT):
        effective_blocks = min(effective, math.inf if held_out is None else held_out.effective_blocks)
        yield lazy_gettext("the intervals rest on {count:.0f} blocks only: ask for more `runs`", count=effective_blocks)
