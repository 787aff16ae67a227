"""Warnings of a fit."""

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
"""Smallest effective sample size of a cross-validated prediction."""

MAX_LAPSE_RATE = 0.25
"""Lapse rate above which no block explains the outcomes."""


def fit_warnings(
    experiment: Experiment,
    marginals: tuple[Marginal, ...],
    correlations: tuple[Correlation, ...],
    held_out: HeldOutScores | None,
    effective: float,
) -> Iterator[str]:
    """Yield warnings about a fit, a sentence each."""
    fell, stood = outcome_weights(experiment)
    if not fell:
        yield lazy_gettext("no overturning among the outcomes: parameters bounded on one side only, the other bound comes from the prior")
    if not stood:
        yield lazy_gettext("only overturning among the outcomes: parameters bounded on one side only, the other bound comes from the prior")
    if experiment.records == 1:
        yield lazy_gettext("outcomes of a single record: no cross-validation, predictive skill unknown")
    if experiment.kind == MOVED:
        yield lazy_gettext("rocking outcomes determine the slenderness only, not the size and the restitution")
    unidentified = [
        lazy_gettext(PARAMETER_LABELS[marginal.name])
        for marginal in marginals
        if not marginal.identified and marginal.name not in (SCATTER, LAPSE)
    ]
    if unidentified:
        yield lazy_gettext("poorly constrained by the outcomes, determined by the prior: {names}", names=unidentified)
    for pair in correlations:
        if abs(pair.coefficient) > HIGH_CORRELATION:
            text = "{first} and {second} cannot be separated (correlation {coefficient:.2f})"
            yield lazy_gettext(
                text,
                first=lazy_gettext(PARAMETER_LABELS[pair.first]),
                second=lazy_gettext(PARAMETER_LABELS[pair.second]),
                coefficient=pair.coefficient,
            )
    lapse = next((marginal.median for marginal in marginals if marginal.name == LAPSE), 0.0)
    if lapse > MAX_LAPSE_RATE:
        yield lazy_gettext("poor fit: no block model explains {share:.0%} of the outcomes", share=lapse)
    if effective < 0.5 * TARGET_EFFECTIVE or (held_out is not None and held_out.effective_blocks < MIN_EFFECTIVE_HELD_OUT):
        effective_blocks = min(effective, math.inf if held_out is None else held_out.effective_blocks)
        yield lazy_gettext("intervals based on {count:.0f} effective blocks only; increase `runs`", count=effective_blocks)
