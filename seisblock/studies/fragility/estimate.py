"""From runs to curves: counts, fits, intervals over records, and where the scatter comes from."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from seisblock.studies.fragility.answer import Dispersion, Efficiency, Fragility, FragilityLevel, Goodness
from seisblock.studies.fragility.capacities import Capacities, capacities, moments
from seisblock.studies.fragility.comparison import efficiency_of_capacities, efficiency_of_cloud
from seisblock.studies.fragility.goodness import goodness_of_capacities, goodness_of_cloud, goodness_of_stripes
from seisblock.studies.fragility.intensity import IntensityMeasure, factors_for
from seisblock.studies.fragility.limits import LimitState, at_least
from seisblock.studies.fragility.lognormal import FALLS, Lognormal, curves, curves_together, no_curve
from seisblock.studies.fragility.suite import Suite
from seisblock.typing import BoolArray, FloatArray
from seisblock.words import Said, said

STRIPES, IDA, CLOUD = "stripes", "ida", "cloud"
METHODS = (STRIPES, IDA, CLOUD)

BEYOND = 1000.0
"""Factor on half of the records at the median beyond which there is no curve: of records of 1 gal those of 1 g."""


@dataclass(frozen=True, eq=False)
class Passed:
    """The runs of one body.

    Parameters
    ----------
    body : str
    limits : tuple of LimitState
    passed : (m, n, v, k) array of bool
        Motions, levels, versions, limits.
    levels : (m, n) array
        Intensities; the same for all motions unless nothing was scaled.
    values : sequence of (m,) arrays
        Intensity of each motion as it is, in each of the measures compared, the curve's own first.
    answers : (m, n, v) array of bool or None
        Runs that have an answer; the others passed nothing and are left out. None: all have one.
    """

    body: str
    limits: tuple[LimitState, ...]
    passed: BoolArray
    levels: FloatArray
    values: Sequence[FloatArray]
    answers: BoolArray | None = None

    @property
    def answered(self) -> BoolArray:
        """Runs that have an answer, (m, n, v)."""
        return np.ones(self.passed.shape[:3], dtype=np.bool_) if self.answers is None else self.answers


@dataclass(frozen=True)
class Rules:
    """How curves are fitted.

    Parameters
    ----------
    method : str
    measures : tuple of IntensityMeasure
    confidence : float, 1
    bootstrap : int
        Samples of records behind the intervals.
    seed : int
    """

    method: str
    measures: tuple[IntensityMeasure, ...]
    confidence: float
    bootstrap: int
    seed: int


Band = tuple[tuple[float, float, float], ...] | None


def estimate(runs: Passed, suite: Suite, rules: Rules) -> list[tuple[Fragility, Band]]:
    """Return the curves of one body, and the bands of their intervals.

    Several limits are fitted with one beta, so that their curves do not cross; a run that passed a later limit is past those before it.

    Parameters
    ----------
    runs : Passed
    suite : Suite
    rules : Rules
    """
    states, answered = at_least(runs.passed), runs.answered
    dice = np.random.default_rng(rules.seed)
    weights = np.vstack([np.ones(len(suite.motions)), suite.weights(rules.bootstrap, dice)])
    shown = rules.measures[0].shown()
    problems = [_problem(rules.method, runs.levels, states[..., k], answered, shown) for k in range(len(runs.limits))]
    good = [k for k, problem in enumerate(problems) if problem is None]
    alone = [_fitted(rules.method, runs.levels, states[..., [k]], answered, weights) for k in good]
    together = _fitted(rules.method, runs.levels, states[..., good], answered, weights) if len(good) > 1 else None
    found: list[tuple[Fragility, Band]] = []
    for k, problem in enumerate(problems):
        firsts = _firsts(states[..., k], answered, runs.levels)
        counted = _counted_curve(runs, suite, rules, states[..., k], k, firsts)
        if problem is not None:
            found.append((replace(counted, problem=problem), None))
            continue
        own = alone[good.index(k)][:, :, 0]
        both = own if together is None else together[:, :, good.index(k)]
        fitted, band = _with_curve(counted, both, runs.levels, rules.confidence)
        if fitted.median is not None and rules.method != CLOUD and (why := _beyond(fitted.median, runs.values[0], rules.measures[0])):
            found.append((replace(counted, problem=why), None))
            continue
        if fitted.curve is not None:
            fitted = replace(
                fitted,
                median_alone=None if together is None else float(own[0, 0]),
                beta_alone=None if together is None else float(own[1, 0]),
                dispersion=_dispersion(rules.method, runs.levels, states[..., k], answered),
                goodness=_goodness(rules.method, fitted.curve, runs.levels, states[..., k], answered, firsts, dice),
                measures=tuple(_efficiencies(runs, suite, rules, states[..., k], firsts)),
            )
        found.append((fitted, band))
    return found


def _counted_curve(runs: Passed, suite: Suite, rules: Rules, passed: BoolArray, limit: int, firsts: Capacities) -> Fragility:
    """Return what is known of one limit before a curve is fitted."""
    # of versions, most
    jumps = (~firsts.monotone).reshape(passed.shape[0], passed.shape[2]).mean(axis=1) > 0.5
    return Fragility(
        body=runs.body,
        limit=runs.limits[limit].name,
        im=rules.measures[0].name,
        unit=rules.measures[0].unit,
        method=rules.method,
        records=len(suite.records),
        motions=len(suite.motions),
        non_monotone_records=np.unique(suite.owner[jumps]).size,
        non_monotone_motions=int(jumps.sum()),
        censored_motions=int((~passed.any(axis=(1, 2)) & runs.answered.any(axis=(1, 2))).sum()),
        levels=tuple(_counted(rules.method, runs.levels, passed, runs.answered)),
        no_answer=int((~runs.answered).sum()),
    )


def _with_curve(counted: Fragility, samples: FloatArray, levels: FloatArray, confidence: float) -> tuple[Fragility, Band]:
    """Return a limit with its curve, the first of some samples, and its intervals, those of the others."""
    (median, *medians), (beta, *betas) = samples
    if not math.isfinite(median):
        return replace(counted, problem=FALLS), None
    kept = np.isfinite(medians)
    ends = [(1.0 - confidence) / 2.0, (1.0 + confidence) / 2.0]
    found = replace(counted, median=float(median), beta=float(beta), bootstrap_lost_count=int((~kept).sum()))
    if kept.sum() < 2:
        return found, None
    some = np.array([medians, betas])[:, kept]
    (low, high), (least, most) = np.quantile(some, ends, axis=1).T.tolist()
    return replace(found, median_interval=(low, high), beta_interval=(least, most)), _band(some[0], some[1], levels, ends)


def _beyond(median: float, values: FloatArray, measure: IntensityMeasure) -> Said | None:
    """Return why a curve whose median lies beyond any shaking is none: it goes through what a few versions did there."""
    factor = float(np.median(factors_for(np.full(values.size, median), values, measure)))
    if factor <= BEYOND:
        return None
    return said(
        "half of the runs do it only where the records are scaled by {factor:.2g} and more: to this body it hardly happens", factor=factor
    )


def _rows(passed: BoolArray) -> BoolArray:
    """Return runs with a row for each motion and version, and a column for each level."""
    motions, levels, versions = passed.shape
    return np.asarray(passed.transpose(0, 2, 1).reshape(motions * versions, levels))


def _firsts(passed: BoolArray, answered: BoolArray, levels: FloatArray) -> Capacities:
    """Return when it happened first, as the logarithm of the intensity, for each motion and version."""
    return capacities(_rows(passed), np.log(np.repeat(levels, passed.shape[2], axis=0)), _rows(answered))


def _problem(method: str, levels: FloatArray, passed: BoolArray, answered: BoolArray, shown: tuple[float, str]) -> Said | None:
    """Return why no curve follows from the runs of one limit, in the user's unit; None where one does."""
    flat = levels[0] if method != CLOUD else levels[:, 0]
    over = (0, 2) if method != CLOUD else (1, 2)
    counts, sizes = (each.sum(axis=over).astype(np.float64) for each in (passed, answered))
    known = sizes > 0.0
    if not known.any():
        return said("no run has an answer: all were given up")
    return no_curve(flat[known], counts[known], sizes[known], shown, scaled=method != CLOUD, first=method == IDA)


def _fitted(method: str, levels: FloatArray, states: BoolArray, answered: BoolArray, weights: FloatArray) -> FloatArray:
    """Return medians and betas, (2, b, k), of some limits, with one beta where there are several, fitted to samples of motions."""
    limits = range(states.shape[3])
    if method == IDA:
        top = math.log(float(levels.max()))
        grid = np.log(np.repeat(levels, states.shape[2], axis=0))
        known = _rows(answered)
        every = np.repeat(weights, states.shape[2], axis=1) * known.any(axis=1)
        found = [moments(capacities(_rows(states[..., k]), grid, known).log_factor, every, top) for k in limits]
        medians, betas = (np.stack(column, axis=1) for column in zip(*found, strict=True))
        if len(found) > 1:
            # one beta for all: the root of the mean square
            betas = np.tile(np.sqrt((betas**2).mean(axis=1, keepdims=True)), (1, len(found)))
        return np.array([medians, betas])
    if method == CLOUD:
        # each motion is a level of its own
        counts = np.stack([weights * states[:, 0, :, k].sum(axis=1) for k in limits], axis=1)
        used = (levels[:, 0], counts, weights * answered[:, 0].sum(axis=1))
    else:
        counts = np.stack([weights @ states[..., k].sum(axis=2) for k in limits], axis=1)
        used = (levels[0], counts, weights @ answered.sum(axis=2))
    if len(limits) == 1:
        medians, betas = curves(used[0], used[1][:, 0], used[2])
        return np.array([medians[:, None], betas[:, None]])
    medians, beta = curves_together(*used)
    return np.array([medians, np.tile(beta[:, None], (1, len(limits)))])


def _counted(method: str, levels: FloatArray, passed: BoolArray, answered: BoolArray) -> list[FragilityLevel]:
    """Return the counts at each level; of each motion where nothing was scaled, in the order of their intensities."""
    if method == CLOUD:
        order = np.argsort(levels[:, 0], kind="stable")
        return [FragilityLevel(float(levels[m, 0]), int(answered[m].sum()), int(passed[m].sum())) for m in order]
    counts, sizes = passed.sum(axis=(0, 2)), answered.sum(axis=(0, 2))
    return [FragilityLevel(float(level), int(size), int(count)) for level, size, count in zip(levels[0], sizes, counts, strict=True)]


def _dispersion(method: str, levels: FloatArray, passed: BoolArray, answered: BoolArray) -> Dispersion | None:
    """Return the parts of the scatter by the law of total variance (derived here).

    Given a version v of the body, ln(intensity) has the mean mu_v and the standard deviation beta_v over the motions. Over both,
    Var = E[beta_v^2] + Var[mu_v]: what records differ, and what is not known of the body. The same versions meet the same motions, so that
    the means differ by the body alone.
    """
    versions = passed.shape[2]
    if versions < 2:
        return None
    alone = np.ones((1, len(passed)))
    fits = [_fitted(method, levels, passed[:, :, [v], None], answered[:, :, [v]], alone) for v in range(versions)]
    medians, betas = np.array(fits)[:, :, 0, 0].T
    good = np.isfinite(medians)
    if good.sum() < 2:
        return None
    records, parameter = float((betas[good] ** 2).mean()), float(np.log(medians[good]).var(ddof=1))
    total = math.sqrt(records + parameter)
    return Dispersion(math.sqrt(records), math.sqrt(parameter), total, versions, int((~good).sum()))


def _goodness(
    method: str,
    curve: Lognormal,
    levels: FloatArray,
    passed: BoolArray,
    answered: BoolArray,
    firsts: Capacities,
    dice: np.random.Generator,
) -> Goodness:
    """Return how well a curve fits, from the shares of the runs that have an answer."""
    versions = passed.shape[2]
    if method == IDA:
        known: BoolArray = np.asarray(answered.any(axis=1))
        logs = np.where(known, firsts.log_factor.reshape(-1, versions), 0.0)
        means = (logs.sum(axis=1) / np.maximum(known.sum(axis=1), 1))[known.any(axis=1)]
        return goodness_of_capacities(curve, means, math.log(float(levels.max())), dice)
    if method == CLOUD:
        some, counts = _shared(passed, answered, (1, 2), versions)
        return goodness_of_cloud(curve, levels[some, 0], counts, float(versions), dice)
    some, counts = _shared(passed, answered, (0, 2), len(passed))
    return goodness_of_stripes(curve, levels[0, some], counts, float(len(passed)), len(passed), dice)


def _shared(passed: BoolArray, answered: BoolArray, over: tuple[int, int], runs: int) -> tuple[BoolArray, FloatArray]:
    """Return which levels, or motions, have an answer, and of so many runs the share there that passed."""
    counts, sizes = passed.sum(axis=over), answered.sum(axis=over)
    known = sizes > 0
    return known, counts[known] * runs / sizes[known]


def _efficiencies(runs: Passed, suite: Suite, rules: Rules, passed: BoolArray, firsts: Capacities) -> list[Efficiency]:
    """Return the measures side by side, where there are several."""
    if len(rules.measures) < 2:
        return []
    properties = (("ln(pgv/pga)", suite.shapes), ("magnitude", suite.magnitudes))
    own = rules.measures[0]
    factors = (firsts.log_factor.reshape(len(passed), -1) - np.log(runs.values[0])[:, None]) / own.power
    some, happened = _shared(passed, runs.answered, (1, 2), passed.shape[2])
    known = tuple((name, given[some]) for name, given in properties)
    found = []
    for measure, values in zip(rules.measures, runs.values, strict=True):
        each = (
            efficiency_of_cloud(measure, values[some], happened, float(passed.shape[2]), known)
            if rules.method == CLOUD
            else efficiency_of_capacities(measure, values, factors, properties)
        )
        found += [each] if each is not None else []
    return found


def _band(medians: FloatArray, betas: FloatArray, levels: FloatArray, ends: list[float]) -> Band:
    """Return the interval of the probability at intensities across the levels."""
    from scipy.special import ndtr

    if medians.size < 2:
        return None
    x = np.geomspace(float(levels.min()), float(levels.max()), 121)
    low, high = np.quantile(ndtr((np.log(x) - np.log(medians)[:, None]) / betas[:, None]), ends, axis=0)
    return tuple(zip(x.tolist(), low.tolist(), high.tolist(), strict=True))
