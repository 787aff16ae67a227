"""Warnings and notes of a fragility study."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from seisblock.bodies.body_name import body_name
from seisblock.core.i18n import Message, join_list, lazy_gettext
from seisblock.core.registry import SolverBody
from seisblock.core.typing import FloatArray
from seisblock.studies.fragility.damage_states import describe_limit
from seisblock.studies.fragility.estimate import CLOUD, IDA, Exceedances, FitOptions
from seisblock.studies.fragility.intensity import IntensityMeasure, factors_for
from seisblock.studies.fragility.results import Fragility
from seisblock.studies.fragility.suite import Suite

MAX_SCALE_FACTOR = 10.0
"""Scale factor above which a record is hardly representative."""

MIN_RECORDS = 10
"""Number of records below which an interval over records is rough."""

MAX_LOST_SHARE = 0.02
"""Share of bootstrap samples without a curve above which a warning is given."""


def fragility_warnings(curves: Sequence[Fragility], values: Sequence[FloatArray], options: FitOptions) -> list[Message]:
    """Return warnings about some curves, a sentence each.

    Parameters
    ----------
    curves : sequence of Fragility
        Equally many of each body, body by body.
    values : sequence of (m,) arrays
        For each body, the intensity of the unscaled motions.
    options : FitOptions
    """
    curves_per_body, count = len(curves) // len(values), curves[0].records
    record_warnings = (
        [lazy_gettext("only {count} records: medians, betas and their intervals are rough; use at least 10", count=count)]
        if count < MIN_RECORDS
        else []
    )
    return record_warnings + [
        note
        for i, curve in enumerate(curves)
        for note in _curve_warnings(curve, values[i // curves_per_body], options, with_body=len(curves) > 1)
    ]


def _curve_warnings(curve: Fragility, values: FloatArray, options: FitOptions, *, with_body: bool) -> Iterator[Message]:
    limit = describe_limit(curve.limit)
    label = lazy_gettext("{body}, {limit}", body=body_name(curve.body), limit=limit) if with_body else limit
    if curve.problem is not None:
        yield lazy_gettext("{curve}: no curve; {why}", curve=label, why=curve.problem)
        return
    if curve.goodness is not None and not curve.goodness.fits:
        text = "{curve}: lognormal fit rejected (p = {chance:.1g})"
        yield lazy_gettext(text, curve=label, chance=curve.goodness.probability)
    if curve.bootstrap_lost_count > MAX_LOST_SHARE * options.bootstrap:
        text = "{curve}: no curve in {count} of {all} bootstrap samples; the intervals are too narrow"
        yield lazy_gettext(text, curve=label, count=curve.bootstrap_lost_count, all=options.bootstrap)
    if options.method == IDA and curve.censored_motions:
        text = "{curve}: not exceeded at any level by {count} of {all} motions; treated as censored at the highest level"
        yield lazy_gettext(text, curve=label, count=curve.censored_motions, all=curve.motions)
    measure = options.measures[0]
    if options.method != CLOUD and curve.median is not None:
        factor = float(np.median(factors_for(np.full(values.size, curve.median), values, measure)))
        if factor > MAX_SCALE_FACTOR:
            size, unit = measure.display_unit()
            text = "{curve}: at the median, {median}, half of the records are scaled by {factor:.3g} or more; use stronger records"
            yield lazy_gettext(text, curve=label, median=f"{curve.median / size:.4g} {unit}".strip(), factor=factor)


MAX_RUN_NAMES = 3
"""Largest number of stopped runs listed by name."""


def stopped_run_notes(body_runs: Sequence[Exceedances], suite: Suite, measure: IntensityMeasure) -> list[Message]:
    """Return a note for each body with stopped runs, listing the first of them.

    Parameters
    ----------
    body_runs : sequence of Exceedances
        One for each body.
    suite : Suite
    measure : IntensityMeasure
        Of the levels.
    """
    size, unit = measure.display_unit()
    sentences = []
    for runs in body_runs:
        stopped_runs = np.argwhere(~runs.completed)
        if not len(stopped_runs):
            continue
        places = list(dict.fromkeys((int(motion), int(level)) for motion, level, _ in stopped_runs))
        names = [f"{_motion_label(suite, m)} {runs.levels[m, n] / size:.4g} {unit}".strip() for m, n in places[:MAX_RUN_NAMES]]
        text = (
            "{body}: {count} of {all} runs stopped without a result and excluded: {names}"
            if len(places) <= MAX_RUN_NAMES
            else "{body}: {count} of {all} runs stopped without a result and excluded: {names} and others"
        )
        sentences.append(
            lazy_gettext(text, body=body_name(runs.body), count=len(stopped_runs), all=runs.completed.size, names=join_list(names))
        )
    return sentences


def _motion_label(suite: Suite, motion: int) -> str:
    """Return the file and the component of a motion."""
    return f"{suite.records[suite.owner[motion]].source.rsplit('/', 1)[-1]} {suite.motions[motion].name}".strip()


def version_range_notes(bodies: Sequence[SolverBody], solver: str) -> list[Message]:
    """Return a note for each body sampled from the priors of its kind; friction has no effect on rocking."""
    ranges = ((solver_body.name, getattr(solver_body.body, "ranges", None)) for solver_body in bodies)
    left_out = ("width_m", "height_m", *(["mu"] if solver == "rock" else []))
    body_ranges_by_name = ((name, body_ranges and body_ranges.without(*left_out)) for name, body_ranges in ranges)
    return [
        lazy_gettext("{body}: samples drawn from the ranges of the body: {ranges}", body=body_name(name), ranges=body_ranges.description)
        for name, body_ranges in body_ranges_by_name
        if body_ranges
    ]
