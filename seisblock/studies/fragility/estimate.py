"""Fragility curves from runs: counts, fits, bootstrap intervals over records, and decomposition of the dispersion."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from seisblock.core.i18n import Message, lazy_gettext
from seisblock.core.typing import BoolArray, FloatArray
from seisblock.studies.fragility.capacities import Capacities, capacities, moments
from seisblock.studies.fragility.damage_states import LimitState, cumulative_exceedance
from seisblock.studies.fragility.efficiency import efficiency_of_capacities, efficiency_of_cloud
from seisblock.studies.fragility.goodness_of_fit import goodness_of_capacities, goodness_of_cloud, goodness_of_stripes
from seisblock.studies.fragility.intensity import IntensityMeasure, factors_for
from seisblock.studies.fragility.lognormal import NOT_INCREASING, Lognormal, fit_lognormals, fit_lognormals_shared_beta, no_curve_reason
from seisblock.studies.fragility.results import Dispersion, Efficiency, Fragility, FragilityLevel, Goodness
from seisblock.studies.fragility.suite import Suite

STRIPES, IDA, CLOUD = "stripes", "ida", "cloud"
METHODS = (STRIPES, IDA, CLOUD)

MAX_MEDIAN_FACTOR = 1000.0
"""Factor on half of the records at the median above which there is no curve: records of 1 gal scaled to 1 g."""


@dataclass(frozen=True, eq=False)
class Exceedances:
    """Exceedances of the limit states of one body.

    Parameters
    ----------
    body : str
    limits : tuple of LimitState
    exceeded : (m, n, v, k) array of bool
        Motions, levels, samples of the body, limits.
    levels : (m, n) array
        Intensities; the same for all motions unless unscaled.
    values : sequence of (m,) arrays
        Intensity of each unscaled motion in each measure, that of the curve first.
    answers : (m, n, v) array of bool or None
        Runs with a result; the others exceed nothing and are left out. None: all runs.
    """

    body: str
    limits: tuple[LimitState, ...]
    exceeded: BoolArray
    levels: FloatArray
    values: Sequence[FloatArray]
    answers: BoolArray | None = None

    @property
    def completed(self) -> BoolArray:
        """Runs with a result, (m, n, v)."""
        return np.ones(self.exceeded.shape[:3], dtype=np.bool_) if self.answers is None else self.answers


@dataclass(frozen=True)
class FitOptions:
    """Options of a fit.

    Parameters
    ----------
    method : str
    measures : tuple of IntensityMeasure
    confidence : float, 1
    bootstrap : int
        Bootstrap samples of records for the intervals.
    seed : int
    """

    method: str
    measures: tuple[IntensityMeasure, ...]
    confidence: float
    bootstrap: int
    seed: int


Band = tuple[tuple[float, float, float], ...] | None


def estimate_curves(exceedances: Exceedances, suite: Suite, options: FitOptions) -> list[tuple[Fragility, Band]]:
    """Return the curves of one body, and the bands of their intervals.

    Several limits share one beta, so that their curves do not cross; exceedance of a limit implies that of milder ones.

    Parameters
    ----------
    exceedances : Exceedances
    suite : Suite
    options : FitOptions
    """
    states, completed = cumulative_exceedance(exceedances.exceeded), exceedances.completed
    rng = np.random.default_rng(options.seed)
    # row 0: the data; further rows: bootstrap samples of whole records, as components of one record are dependent
    weights = np.vstack([np.ones(len(suite.motions)), suite.weights(options.bootstrap, rng)])
    display_unit = options.measures[0].display_unit()
    problems = [
        _problem(options.method, exceedances.levels, states[..., k], completed, display_unit) for k in range(len(exceedances.limits))
    ]
    good = [k for k, problem in enumerate(problems) if problem is None]
    # fits by limit, beside the joint fit with one beta
    single_fits = [_fit_samples(options.method, exceedances.levels, states[..., [k]], completed, weights) for k in good]
    joint_fits = _fit_samples(options.method, exceedances.levels, states[..., good], completed, weights) if len(good) > 1 else None
    results: list[tuple[Fragility, Band]] = []
    for k, problem in enumerate(problems):
        # capacities also serve the counts and the comparison of measures of the other methods
        capacities_by_run = _first_exceedances(states[..., k], completed, exceedances.levels)
        counts_only = _curve_without_fit(exceedances, suite, options, states[..., k], k, capacities_by_run)
        if problem is not None:
            results.append((replace(counts_only, problem=problem), None))
            continue
        single_fit = single_fits[good.index(k)][:, :, 0]
        curve_fit = single_fit if joint_fits is None else joint_fits[:, :, good.index(k)]
        with_curve, band = _add_fit(counts_only, curve_fit, exceedances.levels, options.confidence)
        if (
            with_curve.median is not None
            and options.method != CLOUD
            and (reason := _median_problem(with_curve.median, exceedances.values[0], options.measures[0]))
        ):
            results.append((replace(counts_only, problem=reason), None))
            continue
        if with_curve.curve is not None:
            with_curve = replace(
                with_curve,
                median_alone=None if joint_fits is None else float(single_fit[0, 0]),
                beta_alone=None if joint_fits is None else float(single_fit[1, 0]),
                dispersion=_dispersion(options.method, exceedances.levels, states[..., k], completed),
                goodness=_goodness(options.method, with_curve.curve, exceedances.levels, states[..., k], completed, capacities_by_run, rng),
                measures=tuple(_efficiencies(exceedances, suite, options, states[..., k], capacities_by_run)),
            )
        results.append((with_curve, band))
    return results


def _curve_without_fit(
    exceedances: Exceedances, suite: Suite, options: FitOptions, exceeded: BoolArray, limit: int, capacities_by_run: Capacities
) -> Fragility:
    """Return the counts of one limit before a curve is fitted."""
    # non-monotone: for most samples of the body
    non_monotone = (~capacities_by_run.monotone).reshape(exceeded.shape[0], exceeded.shape[2]).mean(axis=1) > 0.5
    return Fragility(
        body=exceedances.body,
        limit=exceedances.limits[limit].name,
        im=options.measures[0].name,
        unit=options.measures[0].unit,
        method=options.method,
        records=len(suite.records),
        motions=len(suite.motions),
        non_monotone_records=np.unique(suite.owner[non_monotone]).size,
        non_monotone_motions=int(non_monotone.sum()),
        censored_motions=int((~exceeded.any(axis=(1, 2)) & exceedances.completed.any(axis=(1, 2))).sum()),
        levels=tuple(_level_counts(options.method, exceedances.levels, exceeded, exceedances.completed)),
        no_answer=int((~exceedances.completed).sum()),
    )


def _add_fit(counts_only: Fragility, samples: FloatArray, levels: FloatArray, confidence: float) -> tuple[Fragility, Band]:
    """Return a limit with its curve, the first of some samples, and its intervals, from the others."""
    (median, *medians), (beta, *betas) = samples
    if not math.isfinite(median):
        return replace(counts_only, problem=NOT_INCREASING), None
    finite = np.isfinite(medians)
    ends = [(1.0 - confidence) / 2.0, (1.0 + confidence) / 2.0]
    result = replace(counts_only, median=float(median), beta=float(beta), bootstrap_lost_count=int((~finite).sum()))
    if finite.sum() < 2:
        return result, None
    # bootstrap samples without a curve are counted, not replaced
    finite_samples = np.array([medians, betas])[:, finite]
    (low, high), (beta_low, beta_high) = np.quantile(finite_samples, ends, axis=1).T.tolist()
    return replace(result, median_interval=(low, high), beta_interval=(beta_low, beta_high)), _band(
        finite_samples[0], finite_samples[1], levels, ends
    )


def _median_problem(median: float, values: FloatArray, measure: IntensityMeasure) -> Message | None:
    """Return the reason against a curve with a median beyond any shaking: few samples of the body determine it."""
    factor = float(np.median(factors_for(np.full(values.size, median), values, measure)))
    if factor <= MAX_MEDIAN_FACTOR:
        return None
    return lazy_gettext(
        "the median requires half of the records to be scaled by {factor:.2g} or more: practically no risk for this body", factor=factor
    )


def _stacked_runs(exceeded: BoolArray) -> BoolArray:
    """Return runs with a row per motion and sample, and a column per level."""
    motions, levels, versions = exceeded.shape
    return np.asarray(exceeded.transpose(0, 2, 1).reshape(motions * versions, levels))


def _first_exceedances(exceeded: BoolArray, completed: BoolArray, levels: FloatArray) -> Capacities:
    """Return the first exceedance of each motion and sample, as the logarithm of the intensity."""
    return capacities(_stacked_runs(exceeded), np.log(np.repeat(levels, exceeded.shape[2], axis=0)), _stacked_runs(completed))


def _problem(method: str, levels: FloatArray, exceeded: BoolArray, completed: BoolArray, display_unit: tuple[float, str]) -> Message | None:
    """Return the reason against a curve from the runs of one limit, in the display unit; None if there is a curve."""
    flat = levels[0] if method != CLOUD else levels[:, 0]
    over = (0, 2) if method != CLOUD else (1, 2)
    counts, sizes = (runs.sum(axis=over).astype(np.float64) for runs in (exceeded, completed))
    mask = sizes > 0.0
    if not mask.any():
        return lazy_gettext("all runs stopped without a result")
    return no_curve_reason(flat[mask], counts[mask], sizes[mask], display_unit, is_scaled=method != CLOUD, first=method == IDA)


def _fit_samples(method: str, levels: FloatArray, states: BoolArray, completed: BoolArray, weights: FloatArray) -> FloatArray:
    """Return medians and betas, (2, b, k), of some limits, with one beta for several, fitted to samples of motions."""
    limits = range(states.shape[3])
    if method == IDA:
        top = math.log(float(levels.max()))
        grid = np.log(np.repeat(levels, states.shape[2], axis=0))
        mask = _stacked_runs(completed)
        run_weights = np.repeat(weights, states.shape[2], axis=1) * mask.any(axis=1)
        fits = [moments(capacities(_stacked_runs(states[..., k]), grid, mask).log_factor, run_weights, top) for k in limits]
        medians, betas = (np.stack(column, axis=1) for column in zip(*fits, strict=True))
        if len(fits) > 1:
            # one beta for all limits: the root of the mean square
            betas = np.tile(np.sqrt((betas**2).mean(axis=1, keepdims=True)), (1, len(fits)))
        return np.array([medians, betas])
    if method == CLOUD:
        # each motion is its own level
        counts = np.stack([weights * states[:, 0, :, k].sum(axis=1) for k in limits], axis=1)
        counts_by_level = (levels[:, 0], counts, weights * completed[:, 0].sum(axis=1))
    else:
        counts = np.stack([weights @ states[..., k].sum(axis=2) for k in limits], axis=1)
        counts_by_level = (levels[0], counts, weights @ completed.sum(axis=2))
    if len(limits) == 1:
        medians, betas = fit_lognormals(counts_by_level[0], counts_by_level[1][:, 0], counts_by_level[2])
        return np.array([medians[:, None], betas[:, None]])
    medians, beta = fit_lognormals_shared_beta(*counts_by_level)
    return np.array([medians, np.tile(beta[:, None], (1, len(limits)))])


def _level_counts(method: str, levels: FloatArray, exceeded: BoolArray, completed: BoolArray) -> list[FragilityLevel]:
    """Return the counts at each level; of each unscaled motion in cloud analysis, in the order of their intensities."""
    if method == CLOUD:
        order = np.argsort(levels[:, 0], kind="stable")
        return [FragilityLevel(float(levels[m, 0]), int(completed[m].sum()), int(exceeded[m].sum())) for m in order]
    counts, sizes = exceeded.sum(axis=(0, 2)), completed.sum(axis=(0, 2))
    return [FragilityLevel(float(level), int(size), int(count)) for level, size, count in zip(levels[0], sizes, counts, strict=True)]


def _dispersion(method: str, levels: FloatArray, exceeded: BoolArray, completed: BoolArray) -> Dispersion | None:
    """Return the parts of the dispersion by the law of total variance (derived here).

    Given a sample v of the body, ln(capacity) has the mean mu_v and the standard deviation beta_v over the motions. Over both,
    Var = E[beta_v^2] + Var[mu_v]: record-to-record dispersion, and parameter uncertainty of the body. The same samples meet the same
    motions, so the means differ by the body alone.
    """
    versions = exceeded.shape[2]
    if versions < 2:
        return None
    unit_weights = np.ones((1, len(exceeded)))
    fits = [_fit_samples(method, levels, exceeded[:, :, [v], None], completed[:, :, [v]], unit_weights) for v in range(versions)]
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
    exceeded: BoolArray,
    completed: BoolArray,
    capacities_by_run: Capacities,
    rng: np.random.Generator,
) -> Goodness:
    """Return the goodness of fit of a curve, from the shares of the completed runs."""
    versions = exceeded.shape[2]
    if method == IDA:
        mask: BoolArray = np.asarray(completed.any(axis=1))
        logs = np.where(mask, capacities_by_run.log_factor.reshape(-1, versions), 0.0)
        # one capacity per motion, the mean over the samples of the body: samples of one motion are dependent
        means = (logs.sum(axis=1) / np.maximum(mask.sum(axis=1), 1))[mask.any(axis=1)]
        return goodness_of_capacities(curve, means, math.log(float(levels.max())), rng)
    if method == CLOUD:
        mask, counts = _scaled_counts(exceeded, completed, (1, 2), versions)
        return goodness_of_cloud(curve, levels[mask, 0], counts, float(versions), rng)
    mask, counts = _scaled_counts(exceeded, completed, (0, 2), len(exceeded))
    return goodness_of_stripes(curve, levels[0, mask], counts, float(len(exceeded)), len(exceeded), rng)


def _scaled_counts(exceeded: BoolArray, completed: BoolArray, over: tuple[int, int], runs: int) -> tuple[BoolArray, FloatArray]:
    """Return the mask of levels, or motions, with a result, and their exceedances scaled to `runs` runs."""
    counts, sizes = exceeded.sum(axis=over), completed.sum(axis=over)
    mask = sizes > 0
    return mask, counts[mask] * runs / sizes[mask]


def _efficiencies(
    exceedances: Exceedances, suite: Suite, options: FitOptions, exceeded: BoolArray, capacities_by_run: Capacities
) -> list[Efficiency]:
    """Return the efficiencies of several measures for comparison; empty for one."""
    if len(options.measures) < 2:
        return []
    properties = (("ln(pgv/pga)", suite.shapes), ("magnitude", suite.magnitudes))
    main_measure = options.measures[0]
    factors = (capacities_by_run.log_factor.reshape(len(exceeded), -1) - np.log(exceedances.values[0])[:, None]) / main_measure.power
    mask, exceeding = _scaled_counts(exceeded, exceedances.completed, (1, 2), exceeded.shape[2])
    masked_properties = tuple((name, property_values[mask]) for name, property_values in properties)
    results = []
    for measure, values in zip(options.measures, exceedances.values, strict=True):
        efficiency = (
            efficiency_of_cloud(measure, values[mask], exceeding, float(exceeded.shape[2]), masked_properties)
            if options.method == CLOUD
            else efficiency_of_capacities(measure, values, factors, properties)
        )
        results += [efficiency] if efficiency is not None else []
    return results


def _band(medians: FloatArray, betas: FloatArray, levels: FloatArray, ends: list[float]) -> Band:
    """Return the interval of the probability at intensities across the levels."""
    from scipy.special import ndtr

    if medians.size < 2:
        return None
    # pointwise quantiles of the bootstrap curves
    x = np.geomspace(float(levels.min()), float(levels.max()), 121)
    low, high = np.quantile(ndtr((np.log(x) - np.log(medians)[:, None]) / betas[:, None]), ends, axis=0)
    return tuple(zip(x.tolist(), low.tolist(), high.tolist(), strict=True))
