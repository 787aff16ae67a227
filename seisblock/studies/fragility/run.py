"""Fragility study: every body under every record at every level."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from seisblock.bodies.body_name import body_name
from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, Message, join_list, lazy_gettext
from seisblock.core.limits import MAX_CELLS, MAX_RUNS, check_limit
from seisblock.core.registry import SolverBody, get_solver, solver_names
from seisblock.core.typing import ArrayLike, BoolArray, FloatArray, Progress
from seisblock.readers.source import Location
from seisblock.records import Preparation, Record
from seisblock.studies.azimuths import STEP_DEG, sweep_azimuths
from seisblock.studies.batch.run import NO_PROCESSING, Bodies, named_bodies, narrow_depth_notes
from seisblock.studies.batch.task import RejectedBody, build_solver_bodies
from seisblock.studies.batch.worst_azimuth import check_all_azimuths
from seisblock.studies.fragility.damage_states import LimitState, describe_limit, limit_states
from seisblock.studies.fragility.estimate import CLOUD, IDA, METHODS, STRIPES, Exceedances, FitOptions, estimate_curves
from seisblock.studies.fragility.intensity import IntensityMeasure, factors_for, intensity_measure
from seisblock.studies.fragility.results import Fragility, FragilityStudy
from seisblock.studies.fragility.runners import Draws, version_draws
from seisblock.studies.fragility.suite import Suite, make_suite, read_suite
from seisblock.studies.intervals import CONFIDENCE
from seisblock.studies.solvers import solver_studies, solvers_with

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
        # the samples of one motion at one level count as one place
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


DEFAULT_STEPS = 60
"""Default number of levels."""

MAX_DOUBLINGS = 12
"""Largest number of steps from the unscaled motions in the search for the range."""

LOW_SHARE, HIGH_SHARE = 0.02, 0.95
"""Exceeding shares of the runs at the ends of the range."""


def check_levels(levels: ArrayLike) -> FloatArray:
    """Return given levels, rising, without duplicates.

    Raises
    ------
    ParameterError
        If there are fewer than two, or one is not positive.
    """
    unique_levels = np.unique(checks.float_array("the levels", levels))
    if unique_levels.size < 2:
        raise ParameterError("a fragility requires at least two levels, found {count}", count=unique_levels.size)
    if not (np.isfinite(unique_levels).all() and (unique_levels > 0.0).all()):
        raise ParameterError("the levels of a fragility must be positive numbers")
    return unique_levels


def find_levels(shares_at: Callable[[float], FloatArray], middle: float, steps: int = DEFAULT_STEPS, step: float = 2.0) -> FloatArray:
    """Return levels, logarithmically spaced, between rare and almost sure exceedance.

    Parameters
    ----------
    shares_at : callable
        ``shares_at(level)``: share of the motions that exceed each limit, for each body.
    middle : float
        Start of the search.
    steps : int
        At least 2.
    step : float
        Ratio of successive levels of the search: 2, doubling and halving.
    """
    checks.integer("the number of levels", steps, minimum=2)
    # the shares at the start serve both directions of the search
    first = shares_at(middle)
    low, high = (
        _extend_level(shares_at, middle, 1.0 / step, first, lambda s: s <= LOW_SHARE),
        _extend_level(shares_at, middle, step, first, lambda s: s >= HIGH_SHARE),
    )
    return np.geomspace(low, high, steps)


def _extend_level(
    shares_at: Callable[[float], FloatArray], level: float, factor: float, shares: FloatArray, is_reached: Callable[[FloatArray], BoolArray]
) -> float:
    """Return the first level of a geometric sequence at which a condition holds for all shares; the last if none."""
    # bounded: some limits are never, or always, exceeded
    for _ in range(MAX_DOUBLINGS):
        if is_reached(shares).all():
            break
        level *= factor
        shares = shares_at(level)
    return level


ALL_AZIMUTHS_NOTE = N_(
    "all azimuths in steps of {step:g} degrees: each record counts once, with its worst azimuth and the largest intensity"
)

BOOTSTRAP = 1000
"""Default number of bootstrap samples of records."""


@dataclass(frozen=True, eq=False)
class StudyPlan:
    """Bodies and limit states under the motions of a suite.

    Parameters
    ----------
    solver : str
    bodies : tuple of SolverBody
    limits : tuple of LimitState
    suite : Suite
    values : sequence of sequences of (m,) arrays
        For each body, the intensities of the unscaled motions in each measure.
    draws : (v, 7) array or None
    """

    solver: str
    bodies: tuple[SolverBody, ...]
    limits: tuple[LimitState, ...]
    suite: Suite
    values: Sequence[Sequence[FloatArray]]
    draws: Draws

    def exceeded(self, body: int, motion: int, factors: FloatArray, draws: Draws) -> tuple[BoolArray, BoolArray]:
        """Return the exceedances of a body under a motion times some factors, (n, v, k), and the completed runs, (n, v).

        A limit is exceeded if it is in any direction. A stopped direction leaves the run without a result, unless the most severe limit
        is exceeded in another.
        """
        versions, solver_body = 1 if draws is None else len(draws), self.bodies[body]
        result = np.zeros((factors.size, versions, len(self.limits)), dtype=np.bool_)
        gave_up = np.zeros((factors.size, versions), dtype=np.bool_)
        end_states = solver_studies(self.solver).end_states
        assert end_states is not None
        for aligned_body, shaking in self.suite.cases(motion, solver_body.body, spatial=get_solver(self.solver).spatial):
            ends = end_states(replace(solver_body, body=aligned_body), shaking, factors, draws)
            exceeded = np.stack([limit.exceeded(ends).reshape(factors.size, versions) for limit in self.limits], axis=-1)
            if ends.gave_up is not None:
                # the state of a stopped run is not its result: it counts as no exceedance in this direction
                stopped_mask = ends.gave_up.reshape(factors.size, versions)
                exceeded &= ~stopped_mask[..., None]
                gave_up |= stopped_mask
            result |= exceeded
        # overturning in one direction decides the run, whatever the stopped ones would do
        completed = ~gave_up | result[..., -1]
        return result & completed[..., None], completed


def run_fragility(
    records: Location | Record | Sequence[Location | Record],
    bodies: Bodies,
    solver: str = "respond",
    *,
    limits: str | LimitState | Sequence[str | LimitState] = "overturn",
    im: str | IntensityMeasure | Sequence[str | IntensityMeasure] = "pga",
    method: str = STRIPES,
    levels: ArrayLike | None = None,
    steps: int = DEFAULT_STEPS,
    perturb: int = 0,
    components: str | Sequence[str] = (),
    preparation: Preparation = NO_PROCESSING,
    confidence: float = CONFIDENCE,
    bootstrap: int = BOOTSTRAP,
    seed: int = 0,
    progress: Progress | None = None,
    **options: Any,
) -> FragilityStudy:
    """Return lognormal fragility curves of bodies and limit states, with bootstrap intervals over records.

    Parameters
    ----------
    records : path or Record, or several
        Files, folders, patterns, ``@list.txt`` and bundles, see :func:`~seisblock.readers.discover.iter_records`; or records
        without processing.
    bodies : path, bodies, or mapping of names to bodies
        As in :func:`~seisblock.studies.batch.run.run_batch`.
    solver : str
        ``respond``, ``rock``, ``slide`` or ``stack``.
    limits : str, or several
        ``overturn``, ``rock``, ``slip=5cm``, ``lean=0.5``; several are states of rising severity, and share one beta.
    im : str, or several
        ``pga``, ``pgv``, ``pgd``, ``sa=0.5``, ``arias``, ``cav``, ``p*pgv``: of the solved component, of the ground also for bodies on a
        floor. The first is the abscissa of the curve; the others are compared with it.
    method : str
        ``stripes``: every record at every level, maximum likelihood; ``ida``: level of first exceedance of each record; ``cloud``:
        unscaled records, probit regression.
    levels : array, in `unit`
        In the unit of the measure, SI; default: between rare and almost sure exceedance.
    steps : int
        Number of default levels.
    perturb : int
        Samples of each body, 0 for the nominal body.
    components, preparation
        As in :func:`~seisblock.studies.batch.run.run_batch`. With ``all-azimuths`` each record counts once, with its worst direction
        and its largest intensity.
    confidence : float, 1
        Level of the intervals.
    bootstrap, seed : int
        Bootstrap samples of records, and the seed of all random numbers.
    progress : callable
        Called with the number of finished runs and the total.
    options
        Of the solver: ``mu``, ``vertical``, ``restitution``, ``gravity``, ...

    Returns
    -------
    FragilityStudy

    Raises
    ------
    ParameterError
        If the options are inconsistent, there are fewer than two records, or there is no curve at all.
    BodyError, RecordError
        If a body or a record cannot be read.

    Notes
    -----
    The counts z_i of n_i runs at level x_i are binomial with p_i = Phi(ln(x_i/median)/beta), fitted by maximum likelihood
    ([Baker2015]_ eq. (11)). Records are scaled in amplitude only: their shape is the same at every level.

    Examples
    --------
    >>> from seisblock.fragility import run_fragility
    >>> from seisblock.bodies.block import Block
    >>> study = run_fragility(
    ...     ["synthetic_jma.csv", "elcentro_1940_ns.csv"], Block(0.3, 1.2, name="shelf"), "rock", im="pgv", steps=12, bootstrap=20
    ... )
    >>> [(curve.body, curve.limit, curve.motions) for curve in study.curves]
    [('shelf', 'overturn', 3)]
    """
    if solver not in solver_names() or not solver_studies(solver).limits:
        raise ParameterError(
            "unknown solver {name!r} for a fragility; available: {known}", name=str(solver)[:100], known=solvers_with("limits")
        )
    if method not in METHODS:
        raise ParameterError("unknown method {name!r}; available: {known}", name=str(method)[:100], known=list(METHODS))
    if method == CLOUD and levels is not None:
        raise ParameterError("the method cloud uses unscaled records, and `levels` has no effect: omit `levels`, or use stripes")
    checks.instance(preparation, Preparation)
    checks.in_interval("the confidence", confidence, "(0, 1)")
    checks.integer("the number of bootstrap samples", bootstrap, minimum=2)
    checks.integer("the number of samples of the body", perturb, minimum=0)
    check_limit(N_("bootstrap samples"), bootstrap, MAX_RUNS)
    if perturb and not solver_studies(solver).samples_in_rows:
        raise ParameterError("`perturb` has no effect with {solver}: omit `perturb`", solver=solver)
    states = limit_states(limits, solver, solver_studies(solver).limits)
    requested = [im] if isinstance(im, (str, IntensityMeasure)) else list(im)
    measures = tuple(dict.fromkeys(intensity_measure(item) for item in requested))
    if not measures:
        raise ParameterError("no intensity measure given; expected pga, pgv, pgd, sa:0.5, rotd50:0.5, rotd100:0.5, arias, cav, p*pgv, jma")
    names = (components,) if isinstance(components, str) else tuple(components)
    check_all_azimuths(solver, names, options)
    solver_bodies = prepare_bodies(bodies, solver, options)
    loaded_records, exclusion_notes = read_suite(records)
    suite = make_suite(loaded_records, names, preparation)
    intensities = [suite.intensities(measure) for measure in measures]
    values = [
        [item * m.share(body.body, body.options.gravity) for item, m in zip(intensities, measures, strict=True)] for body in solver_bodies
    ]
    study = StudyPlan(solver, solver_bodies, states, suite, values, version_draws(perturb, checks.seed(seed)))
    fit_options = FitOptions(method, measures, confidence, bootstrap, seed)
    grids = _grids(study, fit_options, levels, steps)
    body_runs = _run_all(study, fit_options, grids, progress)
    curves, bands = zip(*(item for exceedances in body_runs for item in estimate_curves(exceedances, suite, fit_options)), strict=True)
    # one curve is enough for a study
    if all(curve.median is None for curve in curves):
        first = curves[0]
        raise ParameterError("{body}, {limit}: {why}", body=body_name(first.body), limit=describe_limit(first.limit), why=first.problem)
    factors = [factors_for(grid, value[0][:, None], measures[0]) for grid, value in zip(grids, values, strict=True)]
    factor_range = (min(float(f.min()) for f in factors), max(float(f.max()) for f in factors)) if method != CLOUD else (1.0, 1.0)
    directions = (lazy_gettext(ALL_AZIMUTHS_NOTE, step=STEP_DEG),) if suite.all_azimuths else ()
    ranges = version_range_notes(solver_bodies, solver) if perturb else []
    floor_notes = (lazy_gettext("bodies on a floor; intensities of the ground motion"),) if preparation.floor else ()
    notes = (
        *exclusion_notes,
        *narrow_depth_notes(get_solver(solver), solver_bodies, names),
        *directions,
        *floor_notes,
        *stopped_run_notes(body_runs, suite, measures[0]),
        *fragility_warnings(curves, [value[0] for value in values], fit_options),
        *ranges,
    )
    return FragilityStudy(curves, measures[0], solver, method, confidence, bands, factor_range, suite.records, notes, preparation.floor)


def prepare_bodies(bodies: Bodies, solver: str, options: Mapping[str, Any]) -> tuple[SolverBody, ...]:
    """Return the bodies of a solver.

    Parameters
    ----------
    bodies, solver
        As in :func:`run_fragility`.
    options : mapping
        Options of the solver, for every body without its own.

    Raises
    ------
    ParameterError
        If the solver does not take a body.
    """
    model = get_solver(solver)
    model.check_options(options)
    result: list[SolverBody] = []
    for body in build_solver_bodies(model, named_bodies(bodies, model), options):
        if isinstance(body, RejectedBody):
            raise ParameterError("{name}: {reason}", name=body.name, reason=body.reason)
        result.append(body)
    return tuple(result)


def _grids(study: StudyPlan, fit_options: FitOptions, levels: ArrayLike | None, steps: int) -> list[FloatArray]:
    """Return the intensities of the runs of each body, (m, n): levels, or those of the unscaled motions."""
    motions = len(study.suite.motions)
    if fit_options.method == CLOUD:
        return [values[0][:, None] for values in study.values]
    if levels is None:

        def shares_at(level: float) -> FloatArray:
            """Return the share of the completed motions in which each body exceeds each limit."""
            runs = [
                study.exceeded(b, m, factors_for(np.array([level]), values[0][m], fit_options.measures[0]), None)
                for b, values in enumerate(study.values)
                for m in range(motions)
            ]
            exceeded = np.reshape([limits[0, 0] for limits, _ in runs], (len(study.bodies), motions, -1))
            completed_counts = np.reshape([completed[0, 0] for _, completed in runs], (len(study.bodies), motions)).sum(axis=1)
            # without a completed run the share is 0, and the search goes on
            return np.asarray(exceeded.sum(axis=1) / np.maximum(completed_counts, 1)[:, None])

        grid = find_levels(
            shares_at,
            math.exp(float(np.mean([np.log(values[0]).mean() for values in study.values]))),
            steps,
            fit_options.measures[0].search_step,
        )
    else:
        grid = check_levels(levels)
    return [np.tile(grid, (motions, 1))] * len(study.bodies)


def _run_all(study: StudyPlan, fit_options: FitOptions, grids: list[FloatArray], progress: Progress | None) -> list[Exceedances]:
    """Return the exceedances of each body."""
    versions = 1 if study.draws is None else len(study.draws)
    runs_per_motion = grids[0].shape[1] * versions
    total = runs_per_motion * len(study.suite.motions) * len(study.bodies)
    # each run repeats in every azimuth: the limit holds for all of them together
    directions = max(sweep_azimuths(body.body).size for body in study.bodies) if study.suite.all_azimuths else 1
    check_limit(N_("runs"), total * directions, MAX_CELLS)
    results, count = [], 0
    for b, (body, grid, values) in enumerate(zip(study.bodies, grids, study.values, strict=True)):
        runs = []
        for m in range(len(study.suite.motions)):
            runs.append(study.exceeded(b, m, factors_for(grid[m], values[0][m], fit_options.measures[0]), study.draws))
            count += runs_per_motion
            if progress is not None:
                progress(count, total)
        exceeded, completed = (np.stack(column) for column in zip(*runs, strict=True))
        results.append(Exceedances(body.name, study.limits, exceeded, grid, values, completed))
    return results
