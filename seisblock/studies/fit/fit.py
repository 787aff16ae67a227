"""Bayesian fit of a block to outcomes: parameters with credible intervals, and cross-validated predictions."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.edge_wear import EdgeWear
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.limits import MAX_RUNS, check_limit
from seisblock.core.typing import FloatArray, Progress
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.records._validation import Gain
from seisblock.studies.fit.block_family import BlockFamily, fixed_values
from seisblock.studies.fit.cross_validation import HeldOutScores, predict, predict_held_out, score_predictions
from seisblock.studies.fit.dataset import (
    FELL,
    MOVED,
    Experiment,
    Observation,
    assign_folds,
    check_folds,
    ground_peaks,
    make_experiment,
    outcome_weights,
)
from seisblock.studies.fit.importance_sampling import TARGET_EFFECTIVE, sample_posterior
from seisblock.studies.fit.likelihood import log_likelihood, make_lapse_rate
from seisblock.studies.fit.posterior_summary import (
    HIGH_CORRELATION,
    PARAMETER_LABELS,
    Correlation,
    Marginal,
    correlations,
    marginals,
    medians,
)
from seisblock.studies.fit.priors import ALPHA, FREE_PARAMETERS, INSET, LAPSE, RESTITUTION, SCATTER, Bounds, Prior, make_priors
from seisblock.studies.fit.priors import P as FREQUENCY
from seisblock.studies.fit.simulate import SHARE_DENOMINATOR

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


DEFAULT_LEVEL = 0.9
"""Default level of the intervals."""

RUNS = 16
"""Default number of samples of each block under each shaking."""

FOLDS = 5
"""Default number of folds of the records, at most one per record."""

POSTERIOR_DRAWS = 2000
"""Equally weighted posterior draws for figures and further use."""


@dataclass(frozen=True, eq=False, repr=False)
class BlockFit(DisplayMixin):
    """Posterior of a block fitted to outcomes.

    Parameters
    ----------
    experiment : Experiment
    axes : tuple of Prior
        Free parameters with their bounds.
    fixed : mapping of str to float or None
        Fixed parameters: alpha in rad, p in rad/s, else shares; a restitution of None is that of angular momentum.
    level : float, 1
        Level of the intervals.
    marginals : tuple of Marginal
        Marginal posterior of each parameter, of alpha and p of the worn block, and of the lapse rate.
    correlations : tuple of Correlation
        Of each pair of parameters.
    block : Block
        Block of the posterior medians.
    restitution : float or None, 1
        Of that block; None: that of angular momentum.
    probability : (n,) array, 1
        Predictive probability of each outcome.
    probability_held_out : (n,) array or None, 1
        The same from the outcomes of other folds; None with a single record.
    held_out : HeldOutScores or None
    pga_m_s2, pgv_m_s : (n,) arrays, m/s^2 and m/s
        Peaks of each shaking, the velocity's on the baseline of `measure`.
    draws : mapping of str to (k,) arrays
        Equally weighted posterior draws of the parameters, in rad, rad/s or shares.
    blocks : int
        Number of blocks of the sample.
    effective_blocks : float, 1
        Effective sample size.
    runs : int
        Samples of each block under each shaking.
    seed : int
    warnings : tuple of str
    """

    experiment: Experiment
    axes: tuple[Prior, ...]
    fixed: dict[str, float | None]
    level: float
    marginals: tuple[Marginal, ...]
    correlations: tuple[Correlation, ...]
    block: Block
    restitution: float | None
    probability: FloatArray
    probability_held_out: FloatArray | None
    held_out: HeldOutScores | None
    pga_m_s2: FloatArray
    pgv_m_s: FloatArray
    draws: dict[str, FloatArray]
    blocks: int
    effective_blocks: float
    runs: int
    seed: int
    warnings: tuple[str, ...]

    def __getitem__(self, name: str) -> Marginal:
        """Return the marginal posterior of a parameter."""
        for marginal in self.marginals:
            if marginal.name == name:
                return marginal
        raise ParameterError("{name!r} is not a fitted parameter; fitted: {known}", name=str(name)[:100], known=self.parameter_names)

    @property
    def parameter_names(self) -> list[str]:
        """Names of the fitted parameters."""
        return [marginal.name for marginal in self.marginals]


def fit_block(
    outcomes: Iterable[Observation],
    *,
    kind: str = FELL,
    free: Sequence[str] | None = None,
    block: Block | None = None,
    restitution: float | None = None,
    inset: float | EdgeWear | None = None,
    bounds: Bounds | None = None,
    scatter: float | None = None,
    lapse: float | None = None,
    vertical: Gain | None = None,
    gravity: float = STANDARD_GRAVITY,
    folds: int | None = None,
    level: float = DEFAULT_LEVEL,
    runs: int = RUNS,
    seed: int = 0,
    progress: Progress | None = None,
) -> BlockFit:
    """Return the posterior of the blocks consistent with observed falls and survivals ([Housner1963]_ block; likelihood derived here).

    A planar block that rocks about two edges, with run-to-run changes of size, slenderness, restitution, amplitude and azimuth of a
    common unknown half width; a share of outcomes (lapse rate) follows no model. See :mod:`seisblock.studies.fit.likelihood`.

    Parameters
    ----------
    outcomes : sequence of Observation
    kind : "fell" or "moved"
        Observed event; a block has moved if it rocked, which determines alpha and the inset alone.
    free : sequence of str
        Free parameters, of ``alpha``, ``p``, ``restitution`` and ``inset``. Default: those not given, alpha and p without a block,
        the inset with one, and the restitution. alpha and p are those of sharp edges; without an inset, of the worn block.
    block : Block
        Nominal block; required unless alpha and p are both free.
    restitution : float, 1
        Of every impact, [0, 1]; default if not free: conservation of angular momentum.
    inset : float or EdgeWear
        Edge wear per side, a share of the width or with its length; default: that of the block.
    bounds : mapping of str to (float, float)
        Bounds of free parameters; alpha in rad, p in rad/s, else shares. The prior is uniform in between (p: in its logarithm).
    scatter : float, 1
        Relative half width of the run-to-run changes, and 100 times as many degrees; default: free, between 0.01 and 0.2.
    lapse : float, 1
        Share of outcomes that follow no model; default: free, with a prior mean of 0.1.
    vertical : bool, float or None
        True or a factor to apply the vertical component; None: where the record has one.
    gravity : float, m/s^2
    folds : int
        Folds of the records, each predicted from the others; default: 5, at most one per record.
    level : float, 1
        Level of the intervals, between 0 and 1.
    runs : int
        Samples of each block under each shaking, 1, 2, 4 ... 64, or as precise: fewer where blocks agree, more where they do not.
    seed : int
    progress : callable
        Called with the number of simulated samples and an estimate of the total.

    Returns
    -------
    BlockFit

    Raises
    ------
    KindError, ParameterError
        If there is no outcome, a parameter is unknown, neither free nor given, or a number is out of range.

    Examples
    --------
    >>> from seisblock.studies import Observation, fit_block
    >>> import numpy as np
    >>> from seisblock import Motion
    >>> time = np.linspace(0.0, 1.0, 101)
    >>> pulses = [Motion.from_arrays(peak * np.sin(2.0 * np.pi * time), 0.01) for peak in (2.0, 3.0, 4.0, 5.0, 6.0, 7.0)]
    >>> outcomes = [Observation(pulse, fell) for pulse, fell in zip(pulses, [False, False, False, True, True, True])]
    >>> fit = fit_block(outcomes, block=Block(0.24, 0.8), free=["inset"], folds=3)
    >>> fit["inset"].interval[0] < 0.2, fit.held_out.folds
    (True, 3)
    """
    experiment = make_experiment(outcomes, kind)
    base_block = None if block is None else checks.instance(block, Block)
    if inset is not None and base_block is not None:
        base_block = base_block.with_wear(inset)
    share = _wear_share(base_block, inset)
    family = _family(free, base_block, share, restitution, inset is not None, bounds or {}, scatter, vertical, gravity)
    checks.in_interval("the level of the intervals", level, "[0.001, 1)")
    if lapse is not None:
        checks.in_interval("the lapse rate", lapse, "[0, 1)")
    _check_runs(runs)
    parts = min(FOLDS, experiment.records) if folds is None else check_folds(folds, experiment)
    lapse_rate = make_lapse_rate(lapse)
    record_folds = assign_folds(experiment.records, parts, checks.seed(seed))
    sample, effective = sample_posterior(
        experiment, family, lapse_rate, record_folds[experiment.record], runs=runs, seed=seed, progress=progress
    )
    # importance weights of each lapse rate (row) with each block (column)
    weights = np.exp(sample.log_weights(log_likelihood(sample.shares, *experiment.outcome_counts(), lapse_rate)))
    weights /= weights.sum()
    # marginal over the lapse rate
    block_weights = weights.sum(axis=0)
    pga, pgv = ground_peaks(experiment)
    held_out_scores, held_out_probability = None, None
    if parts > 1:
        held_out_probability, min_effective = predict_held_out(experiment, sample, lapse_rate, record_folds)
        held_out_scores = score_predictions(experiment, held_out_probability, pgv, record_folds, min_effective)
    parameters = marginals(family, sample.unit_points, weights, lapse_rate, level)
    parameter_correlations = correlations(family, sample.unit_points, block_weights)
    median_point = medians(sample.unit_points, block_weights)[None, :]
    # a stream of its own: the draws do not depend on random numbers used before
    draw_rows = np.random.default_rng([seed, 2]).choice(len(block_weights), POSTERIOR_DRAWS, p=block_weights)
    return BlockFit(
        experiment,
        family.axes,
        dict(fixed_values(family)),
        level,
        parameters,
        parameter_correlations,
        family.block_at(median_point),
        float(family.values(median_point)[RESTITUTION][0]) if RESTITUTION in family.names else restitution,
        predict(experiment, sample, lapse_rate),
        held_out_probability,
        held_out_scores,
        pga,
        pgv,
        family.values(sample.unit_points[draw_rows]),
        len(np.unique(sample.origin)),
        effective,
        runs,
        seed,
        tuple(fit_warnings(experiment, parameters, parameter_correlations, held_out_scores, effective)),
    )


def _wear_share(block: Block | None, inset: float | EdgeWear | None) -> float:
    """Return the edge wear as a share of the width per side."""
    if block is not None:
        return block.inset / block.width
    wear = inset if isinstance(inset, EdgeWear) else EdgeWear(share=0.0 if inset is None else inset)
    if wear.length_m:
        raise ParameterError("`inset` as a length requires a `block` with a width; give a share of the width, such as 0.1")
    wear.inset(1.0)
    return wear.share


def _family(
    free: Sequence[str] | None,
    block: Block | None,
    inset: float,
    restitution: float | None,
    is_wear_given: bool,
    bounds: Bounds,
    scatter: float | None,
    vertical: Gain | None,
    gravity: float,
) -> BlockFamily:
    """Return the family of blocks of the fit after a check of its parameters."""
    if free is None:
        unknown = {
            ALPHA: block is None,
            FREQUENCY: block is None,
            RESTITUTION: restitution is None,
            INSET: block is not None and not is_wear_given,
        }
        free = [name for name in FREE_PARAMETERS if unknown[name]]
    names = [free] if isinstance(free, str) else list(free)
    axes = make_priors(names, bounds, scatter=scatter, block=block)
    if not axes:
        raise ParameterError("no free parameter; give at least one of {known} in `free`", known=list(FREE_PARAMETERS))
    if block is None and not {ALPHA, FREQUENCY} <= set(names):
        missing = [name for name in (ALPHA, FREQUENCY) if name not in names]
        raise ParameterError("{missing} must be free or known; add to `free`, or give the `width` and `height` of a block", missing=missing)
    for name, is_given in ((RESTITUTION, restitution is not None), (INSET, is_wear_given)):
        if name in names and is_given:
            raise ParameterError("{name} is both in `free` and given: omit one of them", name=name)
    if restitution is not None:
        checks.fraction("the restitution (ratio of angular velocities)", restitution)
    if scatter is not None:
        checks.in_interval("the relative scatter", scatter, "[0, 1)")
    return BlockFamily(axes, block, restitution, inset, scatter or 0.0, vertical, checks.gravity(gravity))


def _check_runs(runs: int) -> None:
    """Check the number of samples per block: a power of two that divides ``SHARE_DENOMINATOR``."""
    count = checks.integer("the number of runs", runs, minimum=1)
    if count > SHARE_DENOMINATOR or count & (count - 1):
        raise ParameterError("`runs` must be one of 1, 2, 4, 8, 16, 32, 64; found {found}", found=count)
    check_limit(N_("Monte Carlo samples"), count, MAX_RUNS)
