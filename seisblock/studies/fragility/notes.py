"""What is to be known before believing a fragility."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from seisblock.bodies.called import said_name
from seisblock.studies.batch.models import Placed
from seisblock.studies.fragility.answer import Fragility
from seisblock.studies.fragility.estimate import CLOUD, IDA, Passed, Rules
from seisblock.studies.fragility.intensity import IntensityMeasure, factors_for
from seisblock.studies.fragility.limits import said_limit
from seisblock.studies.fragility.suite import Suite
from seisblock.typing import FloatArray
from seisblock.words import Said, listed, said

LARGE = 10.0
"""Records scaled by more than this are hardly the records any more."""

FEW = 10
"""Records below which an interval over records says little."""

LOST = 0.02
"""Share of the bootstrap's samples that may have no curve before it is told."""


def notes_on(curves: Sequence[Fragility], values: Sequence[FloatArray], rules: Rules) -> list[Said]:
    """Return a sentence for each thing that is to be known of some curves.

    Parameters
    ----------
    curves : sequence of Fragility
        As many of each body, body by body.
    values : sequence of (m,) arrays
        For each body, the intensity of the motions as they are.
    rules : Rules
    """
    each, count = len(curves) // len(values), curves[0].records
    few = (
        [said("{count} records are few: medians, betas and their intervals are rough; ten and more tell", count=count)]
        if count < FEW
        else []
    )
    return few + [note for i, curve in enumerate(curves) for note in _of(curve, values[i // each], rules, several=len(curves) > 1)]


def _of(curve: Fragility, values: FloatArray, rules: Rules, *, several: bool) -> Iterator[Said]:
    """Yield what is to be known of one curve."""
    limit = said_limit(curve.limit)
    what = said("{body}, {limit}", body=said_name(curve.body), limit=limit) if several else limit
    if curve.problem is not None:
        yield said("{curve}: no curve: {why}", curve=what, why=curve.problem)
        return
    if curve.goodness is not None and not curve.goodness.fits:
        text = "{curve}: the lognormal does not fit: its own samples rarely lie so far from their curves (p = {chance:.1g})"
        yield said(text, curve=what, chance=curve.goodness.probability)
    if curve.bootstrap_lost_count > LOST * rules.bootstrap:
        text = "{curve}: no curve follows from {count} of {all} samples of the records: the intervals are too narrow"
        yield said(text, curve=what, count=curve.bootstrap_lost_count, all=rules.bootstrap)
    if rules.method == IDA and curve.censored_motions:
        text = "{curve}: {count} of {all} motions do not do it at any level; they count as doing it above the highest"
        yield said(text, curve=what, count=curve.censored_motions, all=curve.motions)
    measure = rules.measures[0]
    if rules.method != CLOUD and curve.median is not None:
        factor = float(np.median(factors_for(np.full(values.size, curve.median), values, measure)))
        if factor > LARGE:
            size, unit = measure.shown()
            text = "{curve}: at the median, {median}, half of the records are scaled by {factor:.3g} and more: take stronger ones"
            yield said(text, curve=what, median=f"{curve.median / size:.4g} {unit}".strip(), factor=factor)


NAMED = 3
"""Runs without an answer that are named, at most."""


def unanswered(every: Sequence[Passed], suite: Suite, measure: IntensityMeasure) -> list[Said]:
    """Return a sentence for each body some of whose runs were given up, with the first of them by name.

    Parameters
    ----------
    every : sequence of Passed
        One for each body.
    suite : Suite
    measure : IntensityMeasure
        Of the levels.
    """
    size, unit = measure.shown()
    sentences = []
    for runs in every:
        lost = np.argwhere(~runs.answered)
        if not len(lost):
            continue
        places = list(dict.fromkeys((int(motion), int(level)) for motion, level, _ in lost))
        names = [f"{_where(suite, m)} {runs.levels[m, n] / size:.4g} {unit}".strip() for m, n in places[:NAMED]]
        text = (
            "{body}: {count} of {all} runs were given up and are left out: {names}"
            if len(places) <= NAMED
            else "{body}: {count} of {all} runs were given up and are left out: {names} and others"
        )
        sentences.append(said(text, body=said_name(runs.body), count=len(lost), all=runs.answered.size, names=listed(names)))
    return sentences


def _where(suite: Suite, motion: int) -> str:
    """Return the file and the component of a motion."""
    return f"{suite.records[suite.owner[motion]].source.rsplit('/', 1)[-1]} {suite.motions[motion].name}".strip()


def ranges_noted(bodies: Sequence[Placed], solver: str) -> list[Said]:
    """Return a sentence for each body whose samples are drawn from the ranges of its kind; friction plays no part in rocking."""
    ranges = ((placed.name, getattr(placed.body, "ranges", None)) for placed in bodies)
    left_out = ("width_m", "height_m", *(["mu"] if solver == "rock" else []))
    known = ((name, told and told.without(*left_out)) for name, told in ranges)
    return [
        said("{body}: its versions lie within its own ranges: {ranges}", body=said_name(name), ranges=told.says)
        for name, told in known
        if told
    ]
