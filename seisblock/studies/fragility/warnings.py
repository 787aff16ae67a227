"""What is to be known before believing a fragility."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from seisblock.bodies.body_name import body_name
from seisblock.core.i18n import Message, join_list, lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.studies.batch.models import SolverBody
from seisblock.studies.fragility.damage_states import describe_limit
from seisblock.studies.fragility.estimate import CLOUD, IDA, Exceedances, FitOptions
from seisblock.studies.fragility.intensity import IntensityMeasure, factors_for
from seisblock.studies.fragility.results import Fragility
from seisblock.studies.fragility.suite import Suite

MAX_SCALE_FACTOR = 10.0
"""Records scaled by more than this are hardly the records any more."""

MIN_RECORDS = 10
"""Records below which an interval over records says little."""

MAX_LOST_SHARE = 0.02
"""Share of the bootstrap's samples that may have no curve before it is told."""


def fragility_warnings(curves: Sequence[Fragility], values: Sequence[FloatArray], options: FitOptions) -> list[Message]:
    """Return a sentence for each thing that is to be known of some curves.

    Parameters
    ----------
    curves : sequence of Fragility
        As many of each body, body by body.
    values : sequence of (m,) arrays
        For each body, the intensity of the motions as they are.
    options : Rules
    """
    curves_per_body, count = len(curves) // len(values), curves[0].records
    record_warnings = (
        [lazy_gettext("{count} records are few: medians, betas and their intervals are rough; ten and more tell", count=count)]
        if count < MIN_RECORDS
        else []
    )
    return record_warnings + [
        note
        for i, curve in enumerate(curves)
        for note in _curve_warnings(curve, values[i // curves_per_body], options, with_body=len(curves) > 1)
    ]


def _curve_warnings(curve: Fragility, values: FloatArray, options: FitOptions, *, with_body: bool) -> Iterator[Message]:
    """Yield what is to be known of one curve."""
    limit = describe_limit(curve.limit)
    label = lazy_gettext("{body}, {limit}", body=body_name(curve.body), limit=limit) if with_body else limit
    if curve.problem is not None:
        yield lazy_gettext("{curve}: no curve: {why}", curve=label, why=curve.problem)
        return
    if curve.goodness is not None and not curve.goodness.fits:
        text = "{curve}: the lognormal does not fit: its own samples rarely lie so far from their curves (p = {chance:.1g})"
        yield lazy_gettext(text, curve=label, chance=curve.goodness.probability)
    if curve.bootstrap_lost_count > MAX_LOST_SHARE * options.bootstrap:
        text = "{curve}: no curve follows from {count} of {all} samples of the records: the intervals are too narrow"
        yield lazy_gettext(text, curve=label, count=curve.bootstrap_lost_count, all=options.bootstrap)
    if options.method == IDA and curve.censored_motions:
        text = "{curve}: {count} of {all} motions do not do it at any level; they count as doing it above the highest"
        yield lazy_gettext(text, curve=label, count=curve.censored_motions, all=curve.motions)
    measure = options.measures[0]
    if options.method != CLOUD and curve.median is not None:
        factor = float(np.median(factors_for(np.full(values.size, curve.median), values, measure)))
        if factor > MAX_SCALE_FACTOR:
            size, unit = measure.display_unit()
            text = "{curve}: at the median, {median}, half of the records are scaled by {factor:.3g} and more: take stronger ones"
            yield lazy_gettext(text, curve=label, median=f"{curve.median / size:.4g} {unit}".strip(), factor=factor)


NAMED = 3
"""Runs without an answer that are named, at most."""


def unanswered(every: Sequence[Exceedances], suite: Suite, measure: IntensityMeasure) -> list[Message]:
    """Return a sentence for each body some of whose runs were given up, with the first of them by name.

    Parameters
    ----------
    every : sequence of Passed
        One for each body.
    suite : Suite
    measure : IntensityMeasure
        Of the levels.
    """
    size, unit = measure.display_unit()
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
        sentences.append(lazy_gettext(text, body=body_name(runs.body), count=len(lost), all=runs.answered.size, names=join_list(names)))
    return sentences


def _where(suite: Suite, motion: int) -> str:
    """Return the file and the component of a motion."""
    return f"{suite.records[suite.owner[motion]].source.rsplit('/', 1)[-1]} {suite.motions[motion].name}".strip()


def version_range_notes(bodies: Sequence[SolverBody], solver: str) -> list[Message]:
    """Return a sentence for each body whose samples are drawn from the ranges of its kind; friction plays no part in rocking."""
    ranges = ((solver_body.name, getattr(solver_body.body, "ranges", None)) for solver_body in bodies)
    left_out = ("width_m", "height_m", *(["mu"] if solver == "rock" else []))
    named_ranges = ((name, body_ranges and body_ranges.without(*left_out)) for name, body_ranges in ranges)
    return [
        lazy_gettext("{body}: its versions lie within its own ranges: {ranges}", body=body_name(name), ranges=body_ranges.description)
        for name, body_ranges in named_ranges
        if body_ranges
    ]
