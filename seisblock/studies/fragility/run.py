"""Fragilities of some bodies over a suite of records: every record, at every level, with every body."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from seisblock.bodies.body_name import body_name
from seisblock.bodies.factory import block_for_motion
from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.limits import check_limit
from seisblock.core.typing import ArrayLike, BoolArray, FloatArray, Progress
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.readers.source import Location
from seisblock.records import Preparation, Record
from seisblock.studies.azimuths import STEP_DEG, sweep_azimuths
from seisblock.studies.batch.models import SolverBody, batch_model
from seisblock.studies.batch.run import NO_PROCESSING, Bodies, named_bodies
from seisblock.studies.batch.task import RejectedBody, build_solver_bodies
from seisblock.studies.batch.worst_azimuth import check_all_azimuths
from seisblock.studies.fragility.damage_states import LimitState, describe_limit, limit_states
from seisblock.studies.fragility.estimate import CLOUD, METHODS, STRIPES, Exceedances, FitOptions, estimate_curves
from seisblock.studies.fragility.intensity import IntensityMeasure, factors_for, intensity_measure
from seisblock.studies.fragility.levels import DEFAULT_STEPS, check_levels, find_levels
from seisblock.studies.fragility.results import FragilityStudy
from seisblock.studies.fragility.runners import RUNNERS, SOLVERS_WITH_VERSIONS, Draws, version_draws
from seisblock.studies.fragility.suite import Suite, make_suite, read_suite
from seisblock.studies.fragility.warnings import fragility_warnings, unanswered, version_range_notes
from seisblock.studies.intervals import CONFIDENCE

ALL_AZIMUTHS_NOTE = N_(
    "each record counts once: it passes a limit where it does so in any direction, in steps of {step:g} degrees; intensities are the "
    "largest of all directions"
)

BOOTSTRAP = 1000
"""Samples of records behind the intervals, unless another number is asked for."""


@dataclass(frozen=True, eq=False)
class StudyPlan:
    """What is run: bodies and limits under the motions of a suite.

    Parameters
    ----------
    solver : str
    bodies : tuple of Placed
    limits : tuple of LimitState
    suite : Suite
    values : sequence of sequences of (m,) arrays
        For each body, the intensities of the motions as they are, in each measure.
    draws : (v, 6) array or None
    """

    solver: str
    bodies: tuple[SolverBody, ...]
    limits: tuple[LimitState, ...]
    suite: Suite
    values: Sequence[Sequence[FloatArray]]
    draws: Draws

    def exceeded(self, body: int, motion: int, factors: FloatArray, draws: Draws) -> tuple[BoolArray, BoolArray]:
        """Return which limits a body passes under a motion times some factors, (n, v, k), and which runs have an answer, (n, v).

        A limit is passed where it is in any direction. One direction without an answer leaves the run without one, unless the last limit
        is passed in another.
        """
        versions, solver_body = 1 if draws is None else len(draws), self.bodies[body]
        result = np.zeros((factors.size, versions, len(self.limits)), dtype=np.bool_)
        gave_up = np.zeros((factors.size, versions), dtype=np.bool_)
        for shaking in self.suite.directions(motion, solver_body.body):
            ends = RUNNERS[self.solver](replace(solver_body, body=block_for_motion(solver_body.body, shaking)), shaking, factors, draws)
            passed = np.stack([limit.exceeded(ends).reshape(factors.size, versions) for limit in self.limits], axis=-1)
            if ends.gave_up is not None:
                without = ends.gave_up.reshape(factors.size, versions)
                passed &= ~without[..., None]
                gave_up |= without
            result |= passed
        answered = ~gave_up | result[..., -1]
        return result & answered[..., None], answered


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
    """Return how likely some bodies are to pass a limit, against the intensity of the shaking: lognormal curves with their intervals.

    Parameters
    ----------
    records : path or Record, or several
        Files, folders, patterns, ``@list.txt`` and bundles, see :func:`~seisblock.readers.discover.iter_records`; or records as they
        were read.
    bodies : path, bodies, or mapping of names to bodies
        As of :func:`~seisblock.studies.batch.run.run_batch`.
    solver : str
        ``respond``, ``rock``, ``slide`` or ``stack``.
    limits : str, or several
        ``overturn``, ``rock``, ``slip=5cm``, ``lean=0.5``; several are states one beyond the other, and share one beta.
    im : str, or several
        ``pga``, ``pgv``, ``pgd``, ``sa=0.5``, ``arias``, ``p*pgv``: of the component solved, of the ground also where the preparation has
        a floor. The curve is drawn over the first; the
        others are compared with it.
    method : str
        ``stripes``: every record at every level, maximum likelihood; ``ida``: the level at which each record does it first; ``cloud``:
        records as they are, probit regression.
    levels : array, in `unit`
        That of the measure, SI; chosen between where hardly anything and where nearly all happens when left out.
    steps : int
        How many are chosen.
    perturb : int
        Versions of each body, 0 for the body as it is.
    components, preparation
        As of :func:`~seisblock.studies.batch.run.run_batch`. With ``all-azimuths`` each record counts once: it passes a limit where it does
        so in any direction, and its intensity is the largest of all directions.
    confidence : float, 1
        Level of the intervals.
    bootstrap, seed : int
        Samples of records behind them, and the seed of all dice.
    progress : callable
        Told the number of runs done and the number in all.
    options
        Of the solver: ``mu``, ``vertical``, ``restitution``, ``gravity``, ...

    Raises
    ------
    ParameterError
        If nothing can be asked so, there are fewer than two records, or no curve follows from any of the runs.
    BodyError, RecordError
        If a body or a record cannot be read.

    Notes
    -----
    The counts z_i of n_i runs at level x_i are binomial with p_i = Phi(ln(x_i/median)/beta), whose likelihood is made largest
    ([Baker2015]_ eq. (11)). Records are scaled whole: their shape stays as it is, whatever the level.

    Examples
    --------
    >>> from seisblock.bodies.block import Block
    >>> study = run_fragility(
    ...     ["synthetic_jma.csv", "elcentro_1940_ns.csv"], Block(0.3, 1.2, name="shelf"), "rock", im="pgv", steps=12, bootstrap=20
    ... )
    >>> [(curve.body, curve.limit, curve.motions) for curve in study.curves]
    [('shelf', 'overturn', 3)]
    """
    if solver not in RUNNERS:
        raise ParameterError("there is no solver {name!r} for a fragility; there are {known}", name=str(solver)[:100], known=list(RUNNERS))
    if method not in METHODS:
        raise ParameterError("there is no method {name!r}; there are {known}", name=str(method)[:100], known=list(METHODS))
    if method == CLOUD and levels is not None:
        raise ParameterError("a cloud takes the records as they are, at no levels: leave `levels` out, or take stripes")
    checks.instance(preparation, Preparation)
    checks.in_interval("the confidence", confidence, "(0, 1)")
    checks.integer("the samples of the bootstrap", bootstrap, minimum=2)
    checks.integer("the number of versions", perturb, minimum=0)
    check_limit(N_("samples of the bootstrap"), bootstrap, "SEISBLOCK_RUNS")
    if perturb and solver not in SOLVERS_WITH_VERSIONS:
        raise ParameterError("{solver} has no versions of a body: leave `perturb` out", solver=solver)
    states = limit_states(limits, solver)
    requested = [im] if isinstance(im, (str, IntensityMeasure)) else list(im)
    measures = tuple(dict.fromkeys(intensity_measure(item) for item in requested))
    if not measures:
        raise ParameterError("no intensity measure is given: say pga, pgv, pgd, sa=0.5, arias or p*pgv")
    names = (components,) if isinstance(components, str) else tuple(components)
    check_all_azimuths(solver, names, options)
    solver_bodies = prepare_bodies(bodies, solver, options)
    loaded_records, left_out = read_suite(records)
    suite = make_suite(loaded_records, names, preparation)
    intensities = [suite.intensities(measure) for measure in measures]
    gravity = float(options.get("gravity", STANDARD_GRAVITY))
    values = [[item * m.share(body.body, gravity) for item, m in zip(intensities, measures, strict=True)] for body in solver_bodies]
    study = StudyPlan(solver, solver_bodies, states, suite, values, version_draws(perturb, checks.seed(seed)))
    fit_options = FitOptions(method, measures, confidence, bootstrap, seed)
    grids = _grids(study, fit_options, levels, steps)
    body_runs = _run_all(study, fit_options, grids, progress)
    curves, bands = zip(*(item for exceedances in body_runs for item in estimate_curves(exceedances, suite, fit_options)), strict=True)
    if all(curve.median is None for curve in curves):
        first = curves[0]
        raise ParameterError("{body}, {limit}: {why}", body=body_name(first.body), limit=describe_limit(first.limit), why=first.problem)
    factors = [factors_for(grid, value[0][:, None], measures[0]) for grid, value in zip(grids, values, strict=True)]
    factor_range = (min(float(f.min()) for f in factors), max(float(f.max()) for f in factors)) if method != CLOUD else (1.0, 1.0)
    directions = (lazy_gettext(ALL_AZIMUTHS_NOTE, step=STEP_DEG),) if suite.all_azimuths else ()
    ranges = version_range_notes(solver_bodies, solver) if perturb else []
    floor_notes = (
        (lazy_gettext("the bodies stand on a storey; the intensities are those of the ground under it"),) if preparation.floor else ()
    )
    notes = (
        *left_out,
        *directions,
        *floor_notes,
        *unanswered(body_runs, suite, measures[0]),
        *fragility_warnings(curves, [value[0] for value in values], fit_options),
        *ranges,
    )
    return FragilityStudy(curves, measures[0], solver, method, confidence, bands, factor_range, suite.records, notes, preparation.floor)


def prepare_bodies(bodies: Bodies, solver: str, options: Mapping[str, Any]) -> tuple[SolverBody, ...]:
    """Return bodies as a solver takes them, or refuse the first that it cannot take.

    Parameters
    ----------
    bodies, solver
        As of :func:`run_fragility`.
    options : mapping
        Of the solver, for every body that says nothing else.
    """
    model = batch_model(solver)
    model.check_options(options)
    result: list[SolverBody] = []
    for body in build_solver_bodies(model, named_bodies(bodies, model), options):
        if isinstance(body, RejectedBody):
            raise ParameterError("{name}: {reason}", name=body.name, reason=body.reason)
        result.append(body)
    return tuple(result)


def _grids(study: StudyPlan, fit_options: FitOptions, levels: ArrayLike | None, steps: int) -> list[FloatArray]:
    """Return the intensities of the runs of each body, (m, n): levels, or those of the motions as they are."""
    motions = len(study.suite.motions)
    if fit_options.method == CLOUD:
        return [values[0][:, None] for values in study.values]
    if levels is None:

        def shares_at(level: float) -> FloatArray:
            """Return in which share of the motions that have an answer each body passes each limit."""
            runs = [
                study.exceeded(b, m, factors_for(np.array([level]), values[0][m], fit_options.measures[0]), None)
                for b, values in enumerate(study.values)
                for m in range(motions)
            ]
            exceeded = np.reshape([each[0, 0] for each, _ in runs], (len(study.bodies), motions, -1))
            answers = np.reshape([each[0, 0] for _, each in runs], (len(study.bodies), motions)).sum(axis=1)
            return np.asarray(exceeded.sum(axis=1) / np.maximum(answers, 1)[:, None])

        grid = find_levels(shares_at, math.exp(float(np.mean([np.log(values[0]).mean() for values in study.values]))), steps)
    else:
        grid = check_levels(levels)
    return [np.tile(grid, (motions, 1))] * len(study.bodies)


def _run_all(study: StudyPlan, fit_options: FitOptions, grids: list[FloatArray], progress: Progress | None) -> list[Exceedances]:
    """Return the runs of each body."""
    versions = 1 if study.draws is None else len(study.draws)
    runs_per_motion = grids[0].shape[1] * versions
    total = runs_per_motion * len(study.suite.motions) * len(study.bodies)
    directions = max(sweep_azimuths(body.body).size for body in study.bodies) if study.suite.all_azimuths else 1
    check_limit(N_("runs"), total * directions, "SEISBLOCK_CELLS")
    results, count = [], 0
    for b, (body, grid, values) in enumerate(zip(study.bodies, grids, study.values, strict=True)):
        runs = []
        for m in range(len(study.suite.motions)):
            runs.append(study.exceeded(b, m, factors_for(grid[m], values[0][m], fit_options.measures[0]), study.draws))
            count += runs_per_motion
            if progress is not None:
                progress(count, total)
        exceeded, answered = (np.stack(column) for column in zip(*runs, strict=True))
        results.append(Exceedances(body.name, study.limits, exceeded, grid, values, answered))
    return results
