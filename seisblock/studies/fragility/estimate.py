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
from seisblock.studies.fragility.intensity import IntensityMeasure, factors_for
from seisblock.studies.fragility.lognormal import NOT_INCREASING, Lognormal, fit_lognormals, fit_lognormals_shared_beta, no_curve_reason
from seisblock.studies.fragility.probit import fit_probit
from seisblock.studies.fragility.results import Dispersion, Efficiency, Fragility, FragilityLevel, Goodness, Sufficiency
from seisblock.studies.fragility.suite import Suite

SAMPLE_COUNT = 400
"""Samples of the fitted curve."""

SIGNIFICANCE = 0.05
"""Significance level of a misfit."""

KS, CUMULATED = "ks", "cumulated residuals"


def goodness_of_stripes(
    curve: Lognormal, levels: FloatArray, exceeding: FloatArray, runs: float, motions: int, rng: np.random.Generator
) -> Goodness:
    """Return the goodness of fit of a curve to shares at levels of the same scaled motions ([Lilliefors1967]_ method).

    Each sample consists of as many motions with random capacities; it is counted at the levels, fitted, and compared with its own
    curve. Motions count as independent.

    Parameters
    ----------
    curve : Lognormal
    levels, exceeding : (n,) arrays
    runs : float
        At each level.
    motions : int
        Capacities in a sample.
    rng : numpy.random.Generator
    """
    samples = curve.median * np.exp(curve.beta * rng.standard_normal((SAMPLE_COUNT, motions)))
    # one capacity decides a motion at all levels: counts at the levels are dependent, as in the data
    counts = (samples[:, :, None] <= levels).sum(axis=1).astype(np.float64)
    medians, betas = fit_lognormals(levels, counts, np.full((1, levels.size), float(motions)))
    good = np.isfinite(medians)
    sample_distances = _ks_distances(counts[good] / motions, levels, medians[good], betas[good])
    distance = float(_ks_distances(exceeding[None] / runs, levels, np.array([curve.median]), np.array([curve.beta]))[0])
    return _make_goodness(KS, distance, sample_distances, _deviance(curve.probability(levels), exceeding, np.full(levels.size, runs)))


def goodness_of_capacities(curve: Lognormal, log_capacities: FloatArray, top: float, rng: np.random.Generator) -> Goodness:
    """Return the goodness of fit of a curve to IDA capacities up to a highest level ([Lilliefors1967]_ method).

    Parameters
    ----------
    curve : Lognormal
    log_capacities : (m,) array
        Infinite without exceedance.
    top : float
        Logarithm of the highest level.
    rng : numpy.random.Generator
    """
    samples = np.log(curve.median) + curve.beta * rng.standard_normal((SAMPLE_COUNT, log_capacities.size))
    # censored at the highest level, as the data are
    samples = np.where(samples <= top, samples, np.inf)
    sample_distances = []
    for sample in samples:
        medians, betas = moments(sample, np.ones((1, sample.size)), top)
        if np.isfinite(medians[0]):
            sample_distances.append(_ks_distance(sample, float(medians[0]), float(betas[0])))
    distance = _ks_distance(log_capacities, curve.median, curve.beta)
    return _make_goodness(KS, distance, np.array(sample_distances), None)


def goodness_of_cloud(curve: Lognormal, intensities: FloatArray, exceeding: FloatArray, runs: float, rng: np.random.Generator) -> Goodness:
    """Return the goodness of fit of a curve to unscaled motions ([SuWei1991]_ method: cumulated residuals).

    Parameters
    ----------
    curve : Lognormal
    intensities, exceeding : (m,) arrays
    runs : float
        Of each motion.
    rng : numpy.random.Generator
    """
    order = np.argsort(intensities)
    x, y = intensities[order], exceeding[order]
    expected = curve.probability(x)
    samples = rng.binomial(int(runs), expected, (SAMPLE_COUNT, x.size)).astype(np.float64)
    medians, betas = fit_lognormals(x, samples, np.full((1, x.size), runs))
    good = np.isfinite(medians)
    sample_distances = _max_cumulative_residual(samples[good], x, medians[good], betas[good], runs)
    distance = float(_max_cumulative_residual(y[None], x, np.array([curve.median]), np.array([curve.beta]), runs)[0])
    return _make_goodness(CUMULATED, distance, sample_distances, _deviance(expected, y, np.full(x.size, runs)))


def _make_goodness(statistic: str, distance: float, sample_distances: FloatArray, deviance: float | None) -> Goodness:
    """Return the rank of a distance among those of the samples; +1 counts the data as one of them."""
    share = float((np.sum(sample_distances >= distance) + 1.0) / (sample_distances.size + 1.0))
    return Goodness(statistic, distance, share, deviance, share >= SIGNIFICANCE)


def _probabilities(levels: FloatArray, medians: FloatArray, betas: FloatArray) -> FloatArray:
    """Return the probabilities of several curves at given levels, (b, n)."""
    from scipy.special import ndtr

    return np.asarray(ndtr((np.log(levels) - np.log(medians)[:, None]) / betas[:, None]))


def _ks_distances(shares: FloatArray, levels: FloatArray, medians: FloatArray, betas: FloatArray) -> FloatArray:
    """Return the largest distance of shares at levels from each curve, (b,)."""
    return np.asarray(np.abs(shares - _probabilities(levels, medians, betas)).max(axis=1))


def _max_cumulative_residual(exceeding: FloatArray, x: FloatArray, medians: FloatArray, betas: FloatArray, runs: float) -> FloatArray:
    """Return the largest cumulated residual along x over the root of the number of runs, (b,)."""
    residuals = exceeding - runs * _probabilities(x, medians, betas)
    return np.asarray(np.abs(np.cumsum(residuals, axis=1)).max(axis=1) / np.sqrt(runs * x.size))


def _ks_distance(log_capacities: FloatArray, median: float, beta: float) -> float:
    """Return the Kolmogorov-Smirnov distance of a sample, censored at the top, from a curve."""
    from scipy.special import ndtr

    sorted_logs = np.sort(log_capacities)
    observed = np.isfinite(sorted_logs)
    expected = ndtr((sorted_logs[observed] - np.log(median)) / beta)
    steps = np.arange(1, int(observed.sum()) + 1) / sorted_logs.size
    # the empirical distribution jumps at each value: both sides of the step count
    return float(np.max([np.abs(steps - expected), np.abs(steps - 1.0 / sorted_logs.size - expected)], initial=0.0))


def _deviance(expected: FloatArray, exceeding: FloatArray, runs: FloatArray) -> float:
    """Return the deviance over the degrees of freedom: twice the log-likelihood deficit against the shares themselves."""
    from scipy.special import xlogy

    shortfall = xlogy(exceeding, exceeding / np.maximum(runs * expected, 1e-300))
    shortfall += xlogy(runs - exceeding, (runs - exceeding) / np.maximum(runs * (1.0 - expected), 1e-300))
    return float(2.0 * shortfall.sum() / max(expected.size - 2, 1))


MIN_MOTIONS = 5
"""Smallest number of motions for a slope."""

SHAPE, MAGNITUDE = "ln(pgv/pga)", "magnitude"


def efficiency_of_capacities(
    measure: IntensityMeasure, values: FloatArray, log_factors: FloatArray, properties: Sequence[tuple[str, FloatArray]]
) -> Efficiency | None:
    """Return the efficiency of a measure from IDA capacities ([LucoCornell2007]_ sections on efficiency, sufficiency).

    Motions without exceedance are left out. The slope is the least-squares slope of the logarithmic residuals against a property of
    the motions, its probability that of Student's t.

    Parameters
    ----------
    measure : IntensityMeasure
    values : (m,) array
        Of the unscaled motions.
    log_factors : (m, v) array
        Logarithms of the factors of first exceedance, for each sample of the body; infinite without exceedance.
    properties : sequence of (str, (m,) array)
        Properties for the sufficiency; NaN if unknown.
    """
    observed = np.isfinite(log_factors)
    if observed.sum() < 2:
        return None
    logs = measure.log_scaled(values[:, None], np.where(observed, log_factors, np.nan))
    log_capacities = logs[observed]
    mean, beta = float(log_capacities.mean()), float(log_capacities.std(ddof=1))
    # one residual per motion: samples of the body share its properties
    residuals = np.array([row[np.isfinite(row)].mean() if np.isfinite(row).any() else np.nan for row in logs]) - mean
    slopes = [slope for name, property_values in properties if (slope := _residual_slope(name, property_values, residuals)) is not None]
    return Efficiency(measure.name, measure.unit, math.exp(mean), beta, tuple(slopes))


def efficiency_of_cloud(
    measure: IntensityMeasure, values: FloatArray, exceeding: FloatArray, runs: float, properties: Sequence[tuple[str, FloatArray]]
) -> Efficiency | None:
    """Return the efficiency of a measure by probit regression, and its sufficiency ([LucoCornell2007]_ section on sufficiency).

    The probability is that of the likelihood ratio with and without the property, chi-squared with one degree of freedom.

    Parameters
    ----------
    measure, values, properties
        As in :func:`efficiency_of_capacities`.
    exceeding : (m,) array
        Exceedances of each motion.
    runs : float
        Runs of each motion.
    """
    medians, betas = fit_lognormals(values, exceeding[None], np.full((1, values.size), runs))
    if not math.isfinite(float(medians[0])):
        return None
    slopes = [
        slope for name, property_values in properties if (slope := _added_slope(name, property_values, values, exceeding, runs)) is not None
    ]
    return Efficiency(measure.name, measure.unit, float(medians[0]), float(betas[0]), tuple(slopes))


def _centred_property(property_values: FloatArray, residuals: FloatArray) -> FloatArray | None:
    """Return a property minus its mean, NaN if unknown; None if it varies too little for a slope."""
    finite = np.isfinite(property_values) & np.isfinite(residuals)
    if finite.sum() < MIN_MOTIONS or np.unique(property_values[finite]).size < 3:
        return None
    return np.where(finite, property_values - property_values[finite].mean(), np.nan)


def _residual_slope(name: str, property_values: FloatArray, residuals: FloatArray) -> Sufficiency | None:
    """Return the slope of residuals against a property, and the probability of a slope as steep by chance."""
    from scipy.special import stdtr

    x = _centred_property(property_values, residuals)
    if x is None:
        return None
    finite = np.isfinite(x)
    x, y = x[finite], residuals[finite] - residuals[finite].mean()
    slope = float(x @ y / (x @ x))
    free = x.size - 2
    error = math.sqrt(float(((y - slope * x) ** 2).sum()) / free / float(x @ x))
    chance = 2.0 * float(stdtr(free, -abs(slope) / error)) if error > 0.0 else 0.0
    return Sufficiency(name, slope, chance)


def _added_slope(name: str, property_values: FloatArray, values: FloatArray, exceeding: FloatArray, runs: float) -> Sufficiency | None:
    """Return the effect of a property in a probit regression, as a change of the logarithm of the median."""
    from scipy.special import chdtrc

    x = _centred_property(property_values, values)
    if x is None:
        return None
    finite = np.isfinite(x)
    logs, y = np.log(values[finite]), exceeding[finite][None]
    n = np.full_like(y, runs)
    base_fit = fit_probit(np.column_stack([logs, np.ones_like(logs)]), y, n)
    full_fit = fit_probit(np.column_stack([logs, np.ones_like(logs), x[finite]]), y, n)
    b, _, c = full_fit.coefficients[0]
    ratio = 2.0 * float(full_fit.log_likelihood[0] - base_fit.log_likelihood[0])
    # median = exp(-(a + c x)/b), so d ln(median)/dx = -c/b
    return Sufficiency(name, float(-c / b), float(chdtrc(1, max(ratio, 0.0)))) if math.isfinite(ratio) else None


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
    factors = main_measure.log_factors(capacities_by_run.log_factor.reshape(len(exceeded), -1), exceedances.values[0][:, None])
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
    if medians.size < 2:
        return None
    # pointwise quantiles of the bootstrap curves
    x = np.geomspace(float(levels.min()), float(levels.max()), 121)
    low, high = np.quantile(_probabilities(x, medians, betas), ends, axis=0)
    return tuple(zip(x.tolist(), low.tolist(), high.tolist(), strict=True))
