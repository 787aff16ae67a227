"""Assessment of one object: overturning probability, range of the models, predictability and class, the same for every command."""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from seisblock.bodies.block import Block
from seisblock.bodies.factory import block_for_motion
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.scan.body import ScannedBody
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError, SolverError
from seisblock.core.i18n import N_
from seisblock.core.results import Response
from seisblock.core.typing import Progress
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.models.respond.options import RespondOptions
from seisblock.models.stack.options import StackOptions
from seisblock.records import Motion, Record, motion_of
from seisblock.records._validation import Gain
from seisblock.records.process import require_horizontals
from seisblock.studies.model_comparison import ModelComparison, ModelResult
from seisblock.studies.respond.best_estimate import no_slip_friction
from seisblock.studies.sampling import MOVED_M, PILE_RUNS, RUNS, ParameterVariation, Samples, join_directions, sample
from seisblock.studies.solvers import solver_studies

LIKELY, MAY, MOVES, STAYS = N_("likely overturns"), N_("may overturn"), N_("moves"), N_("stays")
"""Classes, the most severe first."""

LIKELY_SHARE, MAY_SHARE = 0.5, 0.05
"""Smallest probabilities of the classes ``likely overturns`` and ``may overturn``; the latter also holds for ``moves``."""

MAX_FACTOR, RUN_STEP, RUN_BISECTIONS, MIN_RUN_FACTOR = 4.0, 1.25, 3, 0.05
"""Largest factor of a search for overturning; ratio of consecutive factors, halvings and smallest factor of one run by run."""


@dataclass(frozen=True, repr=False)
class ModelVerdict(DisplayMixin):
    """Verdict of one model of an object.

    Parameters
    ----------
    name : str
    overturns : bool
        Under the unscaled motion.
    factor_to_overturn : float or None, 1
        Factor on the motion at which it overturns; None where it does not up to 4, or is not computed.
    """

    name: str
    overturns: bool
    factor_to_overturn: float | None


@dataclass(frozen=True, repr=False)
class Assessment(DisplayMixin):
    """Assessment of one object, in one direction or under any horizontal of a record.

    Parameters
    ----------
    overturning_probability : float, 1
        Share of the samples of object and shaking that overturn: parameter variation only, model error not included.
    interval : (float, float), 1
        Its Clopper-Pearson interval at 95 %.
    runs : int
        Samples with a result.
    moved_probability : float, 1
        Share of the samples that overturn or end more than 1 cm (or the given length) from their place.
    models : tuple of ModelVerdict
        Nominal object by each model.
    least_factor, greatest_factor : float or None, 1
        Range of their factors to overturning.
    predictable_until_s : float or None, s
        Time from the record's first sample until which changes of the input by 2e-6 do not alter the run; None: to its end.
    direction : str
        Component or azimuth; of an object under several, the one with the largest probability.
    class_ : str
        ``likely overturns`` (probability at least .5), ``may overturn`` (at least .05), ``moves`` (moved_probability at least .05) or
        ``stays``; the key ``class`` in documents.
    """

    overturning_probability: float
    interval: tuple[float, float]
    runs: int
    moved_probability: float
    models: tuple[ModelVerdict, ...]
    least_factor: float | None
    greatest_factor: float | None
    predictable_until_s: float | None
    direction: str
    class_: str


def classify(overturning_probability: float, moved_probability: float) -> str:
    """Return the class of an object.

    Examples
    --------
    >>> [classify(*pair) for pair in ((0.5, 0.5), (0.49, 0.6), (0.04, 0.05), (0.04, 0.04))]
    ['likely overturns', 'may overturn', 'moves', 'stays']
    """
    if overturning_probability >= LIKELY_SHARE:
        return LIKELY
    if overturning_probability >= MAY_SHARE:
        return MAY
    return MOVES if moved_probability >= MAY_SHARE else STAYS


@dataclass(frozen=True, eq=False)
class DirectionAssessment:
    """Assessment in one direction with the samples behind it.

    Parameters
    ----------
    samples : Samples
    assessment : Assessment
    comparison : ModelComparison or None
        Of the same models, with their remarks; None for a pile whose top stone is fixed.
    moved_m : float, m
        Residual displacement above which the object has moved.
    """

    samples: Samples
    assessment: Assessment
    comparison: ModelComparison | None
    moved_m: float = MOVED_M


def assess(
    body: Block | ScannedBody | Pile,
    record: Record | Motion,
    *,
    mu: float | None = None,
    mu_kinetic: float | None = None,
    components: Sequence[str] = (),
    runs: int | None = None,
    moved_m: float = MOVED_M,
    priors: ParameterVariation = ParameterVariation(),
    seed: int = 0,
    vertical: Gain | None = None,
    gravity: float = STANDARD_GRAVITY,
    progress: Progress | None = None,
) -> Assessment:
    """Assess whether an object overturns, or moves, under a record: full response, or rigid contact in three dimensions for a pile.

    A block or a scan is solved in each horizontal direction; it overturns if it does so in any of them. A pile meets all components at
    once.

    Parameters
    ----------
    body : Block, ScannedBody or Pile
        With the prior of its kind, from which unmeasured edge wear and friction are drawn.
    record : Record or Motion
        All horizontals of a record, or one motion.
    mu, mu_kinetic : float or None, 1
        Friction. None: middle of the prior of the body's kind, else a friction without slip; a pile has its own.
    components : sequence of str
        Codes or azimuths; default: all horizontals.
    runs : int or None
        Samples; default: 200, of a pile 20.
    moved_m : float, m
        Residual displacement above which the object has moved.
    priors : ParameterVariation
        Half widths of what is known.
    seed : int
        The same seed gives the same samples.
    vertical : bool, float or None
        True or a factor to apply the vertical component; None: if the record has one.
    gravity : float, m/s^2
    progress : callable
        Called with the number of finished runs and the total, in each direction anew.

    Returns
    -------
    Assessment

    Raises
    ------
    KindError, ParameterError
        If an argument has the wrong type or lies outside its range.
    ComponentError
        If the record has no such component, or no horizontal.
    SolverError
        If no sample has a result.

    Examples
    --------
    >>> from seisblock import load_block, read
    >>> assessment = assess(load_block("gravestone"), read("synthetic_jma.csv"), mu=0.6, runs=20)
    >>> assessment.class_, assessment.runs
    ('likely overturns', 20)
    """
    checks.instance(record, Motion if isinstance(record, Motion) else Record)
    checks.instance(body, Pile if isinstance(body, Pile) else ScannedBody if isinstance(body, ScannedBody) else Block)
    checks.positive("the residual displacement that counts as moved", moved_m, "m")
    motions = _motions(record, components, several=not isinstance(body, Pile))
    if isinstance(body, Pile):
        if not (mu is None and mu_kinetic is None):
            raise ParameterError("`mu` has no effect on a pile, which has a friction in each joint: omit it")
        solver = "stack"
        bodies: list[Any] = [body] * len(motions)
        options: list[Any] = [StackOptions(vertical=vertical, gravity=gravity)] * len(motions)
    else:
        if mu is None and mu_kinetic is not None:
            raise ParameterError("`mu_kinetic` requires `mu`")
        solver = "respond"
        bodies = [_block(body, motion, mu) for motion in motions]
        frictions = [_friction(block) if mu is None else mu for block in bodies]
        options = [RespondOptions(mu=friction, mu_kinetic=mu_kinetic, vertical=vertical, gravity=gravity) for friction in frictions]
    count = (PILE_RUNS if solver == "stack" else RUNS) if runs is None else runs
    parts = [
        assess_direction(solver, *case, count, priors=priors, seed=seed, moved_m=moved_m, progress=progress)
        for case in zip(bodies, motions, options, strict=True)
    ]
    return parts[0].assessment if len(parts) == 1 else assess_object(parts)


def assess_direction(
    solver: str,
    body: Any,
    motion: Motion,
    options: Any,
    runs: int,
    *,
    priors: ParameterVariation = ParameterVariation(),
    seed: int = 0,
    moved_m: float = MOVED_M,
    progress: Progress | None = None,
) -> DirectionAssessment:
    """Return the assessment of a body in one direction.

    Parameters
    ----------
    solver, body, motion, options, runs, priors, seed, progress
        As in :func:`~seisblock.studies.sampling.sample`.
    moved_m : float, m
    """
    samples = sample(solver, body, motion, options, runs, priors, seed=seed, progress=progress)
    assess_samples = solver_studies(solver).assess
    assert assess_samples is not None
    return assess_samples(body, motion, options, samples, moved_m=moved_m)


def assess_record(solver: str, body: Block | ScannedBody, record: Record, options: Any, runs: int, *, seed: int = 0) -> Assessment:
    """Return the assessment of an object under any horizontal component of a record.

    Parameters
    ----------
    solver, body, record, options, runs, seed
        As in :func:`assess_direction`.
    """
    motions = _motions(record, (), several=True)
    parts = [assess_direction(solver, block_for_motion(body, motion), motion, options, runs, seed=seed) for motion in motions]
    return parts[0].assessment if len(parts) == 1 else assess_object(parts)


def _block(body: Block | ScannedBody, motion: Motion, mu: float | None) -> Block:
    """Return the block of a body for a motion; a given friction replaces the prior of its kind."""
    block = block_for_motion(body, motion)
    assert isinstance(block, Block)
    return block if mu is None else block.without_ranges("mu")


def _motions(record: Record | Motion, components: Sequence[str], *, several: bool) -> list[Motion]:
    """Return the motions of a record that act on an object one by one."""
    if isinstance(record, Motion):
        if components:
            raise ParameterError("`components` requires a record, found a motion: omit it")
        return [record]
    names = list(components) or [component.code for component in require_horizontals(record)]
    # all components act on a pile in every run
    return [motion_of(record, name) for name in (names if several or components else names[:1])]


def _friction(block: Block) -> float:
    """Return the friction of a body of unknown friction: the middle of the prior of its kind, else one without slip."""
    if block.ranges is not None and block.ranges.mu is not None:
        return 0.5 * sum(block.ranges.mu)
    return no_slip_friction(block)


def assess_object(parts: Sequence[DirectionAssessment]) -> Assessment:
    """Return the assessment of an object under any of several directions of one record.

    A sample, and a model, overturns if it does so in any direction; the factor of a model is the smallest of its directions. The
    direction is the one of the largest overturning probability; among equal ones, that of the smallest factor to overturning.

    Parameters
    ----------
    parts : sequence of DirectionAssessment
        Of the same draws.
    """
    results: dict[str, ModelResult] = {}
    for part in parts:
        for model in part.assessment.models:
            previous = results.get(model.name, ModelResult(model.name, False, None))
            factors = [factor for factor in (previous.factor, model.factor_to_overturn) if factor is not None]
            results[model.name] = ModelResult(model.name, previous.falls or model.overturns, min(factors, default=None))
    untils = [part.assessment.predictable_until_s for part in parts if part.assessment.predictable_until_s is not None]
    worst = max(parts, key=lambda part: severity_key(part.assessment))
    samples = join_directions([part.samples for part in parts])
    return make_assessment(samples, list(results.values()), min(untils, default=None), worst.assessment.direction, worst.moved_m)


def severity_key(assessment: Assessment) -> tuple[float, float, float]:
    """Return the key that orders the directions of an object."""
    factor = math.inf if assessment.least_factor is None else assessment.least_factor
    return assessment.overturning_probability, assessment.moved_probability, -factor


def assess_objects(parts: Iterable[tuple[Hashable, DirectionAssessment | None]]) -> list[Assessment | None]:
    """Return the assessment of each object under its record in order, None for one with one direction or without samples.

    Parameters
    ----------
    parts : iterable of (hashable, DirectionAssessment or None)
        Each direction with a key of its object and record.
    """
    groups: dict[Hashable, list[DirectionAssessment]] = {}
    for key, part in parts:
        group = groups.setdefault(key, [])
        if part is not None:
            group.append(part)
    return [assess_object(group) if len(group) > 1 else None for group in groups.values()]


def make_assessment(
    samples: Samples, results: Sequence[ModelResult], predictable_until_s: float | None, direction: str, moved_m: float
) -> Assessment:
    """Return the assessment from samples and the results of the models of the nominal object."""
    factors = [result.factor for result in results if result.factor is not None]
    moved = samples.moved_probability(moved_m)
    return Assessment(
        samples.probability,
        samples.interval,
        samples.completed,
        moved,
        tuple(ModelVerdict(result.model, result.falls, result.factor) for result in results),
        min(factors, default=None),
        max(factors, default=None),
        predictable_until_s,
        direction or "x",
        classify(samples.probability, moved),
    )


def run_factor(
    response: Response[Any], solve: Callable[..., Response[Any]], overturns: Callable[[Any], bool], **keywords: Any
) -> float | None:
    """Return the factor nearest to 1 at which an object begins to fall, to 3 %; None if it stands up to :data:`MAX_FACTOR`."""
    motion, options = response.motion, replace(response.options, **keywords)

    def falls(factor: float) -> bool:
        scaled = Motion(factor * motion.acceleration, motion.dt, motion.name, motion.start_s, motion.record)
        try:
            return overturns(solve(response.body, scaled, **options.keywords()).outcome)
        except SolverError:
            return False

    if not motion.acceleration.any():
        return None
    low = high = 1.0
    if overturns(response.outcome):
        while low > MIN_RUN_FACTOR and falls(low := low / RUN_STEP):
            high = low
    else:
        while not falls(high := high * RUN_STEP):
            low = high
            if high >= MAX_FACTOR:
                return None
    for _ in range(RUN_BISECTIONS):
        middle = math.sqrt(low * high)
        low, high = (low, middle) if falls(middle) else (middle, high)
    return high
