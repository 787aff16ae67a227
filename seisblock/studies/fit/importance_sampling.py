"""Adaptive importance sampling of the posterior of block parameters.

Blocks are points of a unit cube with a uniform prior (:mod:`seisblock.studies.fit.priors`). Points are drawn from proposals, each
around the best points of the previous ones; the weight of a point is its likelihood over the density of the mixture of all
proposals at that point ([Cornuet2012]_ section 3), which is unbiased for any proposal. While the points are few, the likelihood is
tempered: raised to the largest power below one that leaves enough effective points.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from seisblock.core.typing import FloatArray, IntArray, Progress
from seisblock.studies.fit.block_family import BlockFamily, quasi_random_points
from seisblock.studies.fit.dataset import Experiment
from seisblock.studies.fit.likelihood import LapseRate, log_likelihood, log_likelihoods_held_out
from seisblock.studies.fit.simulate import SHARE_DENOMINATOR, outcome_shares
from seisblock.studies.intervals import effective_sample_size

CENTRE_COUNT = 100
"""Components of the mixture."""

DEGREES_OF_FREEDOM = 4.0
"""Degrees of freedom of Student's t: tails heavy enough for bounded importance weights."""

TRIAL_SIZE = 8192
"""Points drawn at a time, and for the share of the mixture within the bounds."""

MIN_WIDTH = 1e-4
"""Smallest width of the mixture in each direction, relative to the bounds."""


@dataclass(frozen=True, eq=False)
class Proposal:
    """Mixture of Student's t of one shape around several centres, truncated to the unit cube.

    Parameters
    ----------
    centres : (k, d) array, 1
    root : (d, d) array, 1
        Cholesky factor of the shape matrix (lower triangle).
    inside_fraction : float, 1
        Share of the mixture within the cube.
    points : (n, d) array, 1
        Points drawn from the mixture, within the cube.
    """

    centres: FloatArray
    root: FloatArray
    inside_fraction: float
    points: FloatArray

    def log_density(self, unit_points: FloatArray) -> FloatArray:
        """Return the log density within the cube, (n,) (derived here from the density of Student's t)."""
        from scipy.linalg import solve_triangular
        from scipy.special import gammaln, logsumexp

        d = unit_points.shape[1]
        # Mahalanobis distance by a triangular solve: no inverse of the shape matrix is formed
        standardized = solve_triangular(self.root, (unit_points[:, None, :] - self.centres[None, :, :]).reshape(-1, d).T, lower=True)
        distance = (standardized**2).sum(axis=0).reshape(len(unit_points), -1)
        constant = (
            gammaln((DEGREES_OF_FREEDOM + d) / 2) - gammaln(DEGREES_OF_FREEDOM / 2) - 0.5 * d * math.log(DEGREES_OF_FREEDOM * math.pi)
        )
        constant -= float(np.log(np.diag(self.root)).sum()) + math.log(len(self.centres)) + math.log(self.inside_fraction)
        density: FloatArray = constant + logsumexp(-0.5 * (DEGREES_OF_FREEDOM + d) * np.log1p(distance / DEGREES_OF_FREEDOM), axis=1)
        return density


def make_proposal(unit_points: FloatArray, weights: FloatArray, count: int, rng: np.random.Generator) -> Proposal:
    """Return a proposal around weighted points of the unit cube, (n, d), with `count` points drawn from it ([Cornuet2012]_ section 3).

    Its shape is the points' covariance, narrowed like the kernel of a density estimate of the effective sample size.
    """
    d = unit_points.shape[1]
    share = weights / weights.sum()
    # weights that concentrate on few points know as little as that many equal ones
    effective_size = 1.0 / float((share**2).sum())
    middle = share @ unit_points
    spread = (unit_points - middle).T @ (share[:, None] * (unit_points - middle)) * (effective_size / max(effective_size - 1.0, 1.0))
    # Silverman's factor for d dimensions
    bandwidth = (4.0 / ((d + 2.0) * effective_size)) ** (2.0 / (d + 4.0))
    # a minimum width keeps the shape positive definite with few effective points
    shape = bandwidth * spread + MIN_WIDTH**2 * np.eye(d)
    root = np.linalg.cholesky(shape)
    # systematic resampling: one random offset, equal steps; each point is a centre in proportion to its weight
    steps = (rng.random() + np.arange(CENTRE_COUNT)) / CENTRE_COUNT
    centres = unit_points[np.minimum(np.searchsorted(np.cumsum(share), steps), len(unit_points) - 1)]
    batches: list[FloatArray] = []
    trial_count = hits = 0
    # rejection outside the cube; the accepted share normalises the truncated density
    # at least one batch, so that the accepted share has a small error even for few points
    while hits < count or trial_count < TRIAL_SIZE:
        base_points = centres[rng.integers(CENTRE_COUNT, size=TRIAL_SIZE)]
        radial_scale = np.sqrt(DEGREES_OF_FREEDOM / rng.chisquare(DEGREES_OF_FREEDOM, size=TRIAL_SIZE))
        points = base_points + radial_scale[:, None] * (rng.normal(size=(TRIAL_SIZE, d)) @ root.T)
        accepted = points[((points > 0.0) & (points < 1.0)).all(axis=1)]
        batches.append(accepted)
        trial_count, hits = trial_count + TRIAL_SIZE, hits + len(accepted)
    return Proposal(centres, root, hits / trial_count, np.concatenate(batches)[:count])


INITIAL_BLOCKS = 64
"""Initial points, uniform over the cube, times two per dimension."""

SEARCH_BLOCKS, PROPOSAL_BLOCKS = 128, 256
"""Points of each proposal of the search, and of the posterior sample."""

SEARCH_RUNS = 4
"""Samples of each block during the search."""

MIN_EFFECTIVE, TARGET_EFFECTIVE, MIN_EFFECTIVE_WITHOUT = 50.0, 200.0, 30.0
"""Effective sample sizes: of a proposal, of the posterior sample, and with outcomes held out."""

PROPOSAL_POWER = 0.8
"""Power of the likelihood of a proposal: wide enough for the posterior with outcomes held out."""

MAX_SEARCHES, MAX_PROPOSALS = 12, 12
"""Largest number of proposals of the search, and of the posterior sample."""


@dataclass(frozen=True, eq=False)
class ImportanceSample:
    """Weighted points of the posterior, with the simulated shares of their samples.

    Parameters
    ----------
    unit_points : (n, d) array, 1
        Points of the unit cube.
    shares : (shakings, n) array of int
        Falls of 64 samples.
    log_density : (n,) array
        Logarithm of the proposal density.
    """

    unit_points: FloatArray
    shares: IntArray
    log_density: FloatArray

    def log_weights(self, log_likelihoods: FloatArray) -> FloatArray:
        """Return the log weights of each lapse rate and each block, (l, n), with a maximum of zero."""
        logs = log_likelihoods - self.log_density
        # a common shift cancels in normalised weights and prevents an underflow
        shifted: FloatArray = logs - logs.max()
        return shifted


def min_effective_without(sample: ImportanceSample, experiment: Experiment, parts: IntArray, lapse: LapseRate) -> float:
    """Return the smallest effective sample size when one of the parts of the outcomes is held out."""
    if not parts.any():
        return np.inf
    held_out_logs = log_likelihoods_held_out(sample.shares, experiment, parts, lapse)
    return min(effective_sample_size(np.exp(sample.log_weights(logs)).sum(axis=0)) for _, logs in held_out_logs)


def sample_posterior(
    experiment: Experiment,
    family: BlockFamily,
    lapse: LapseRate,
    parts: IntArray,
    *,
    runs: int,
    seed: int,
    progress: Progress | None = None,
) -> tuple[ImportanceSample, float]:
    """Return a posterior sample of blocks, and its effective sample size.

    Parameters
    ----------
    experiment, family, lapse
    parts : (outcomes,) array of int
        Outcomes that are held out together: the sample is large enough for the posterior of the others, too.
    runs : int
        Samples of each block under each shaking, a power of two.
    seed : int
    progress : callable
        Called with the number of simulated shakings and an estimate of the total.
    """
    # search: temper until a proposal suits the likelihood at PROPOSAL_POWER
    search = _Sampler(experiment, family, lapse, seed, progress)
    sample = search.first()
    for _ in range(MAX_SEARCHES):
        power, weights = search.temper(sample, PROPOSAL_POWER)
        proposal = make_proposal(sample.unit_points, weights, PROPOSAL_BLOCKS if power == PROPOSAL_POWER else SEARCH_BLOCKS, search.rng)
        if power == PROPOSAL_POWER:
            break
        sample = search.add_proposal(sample, proposal, np.full(len(experiment.shakings), SEARCH_RUNS))
    # posterior: the search's points are dropped, as few samples per block made their shares coarse
    posterior, proposals = None, []
    for iteration in range(MAX_PROPOSALS):
        proposals.append(proposal)
        # runs are spent where likely blocks disagree: elsewhere more of them would change nothing
        run_counts = search.runs_per_shaking(sample if posterior is None else posterior, runs)
        posterior = search.extend_sample(posterior, proposals, run_counts)
        weights = np.exp(posterior.log_weights(search.log_likelihoods(posterior))).sum(axis=0)
        if (
            iteration
            and effective_sample_size(weights) >= TARGET_EFFECTIVE
            and min_effective_without(posterior, experiment, parts, lapse) >= MIN_EFFECTIVE_WITHOUT
        ):
            break
        proposal = make_proposal(posterior.unit_points, search.temper(posterior, PROPOSAL_POWER)[1], PROPOSAL_BLOCKS, search.rng)
    assert posterior is not None
    return posterior, effective_sample_size(weights)


@dataclass(eq=False)
class _Sampler:
    """State of the sampler: experiment, proposals so far and progress."""

    experiment: Experiment
    family: BlockFamily
    lapse: LapseRate
    seed: int
    progress: Progress | None
    run_count: int = 0

    def __post_init__(self) -> None:
        self.rng = np.random.default_rng([self.seed, 1])
        self.proposals: list[Proposal] = []
        self.initial_count = INITIAL_BLOCKS * 2 ** len(self.family.axes)

    def log_likelihoods(self, sample: ImportanceSample) -> FloatArray:
        """Return the log likelihood of each lapse rate and each block, (l, n)."""
        return log_likelihood(sample.shares, *self.experiment.outcome_counts(), self.lapse)

    def first(self) -> ImportanceSample:
        """Return quasi-random points over the whole cube."""
        d = len(self.family.axes)
        # random offset of a low-discrepancy sequence: even, and unbiased
        unit_points = (self.rng.random(d) + quasi_random_points(self.initial_count, d)) % 1.0
        shares = self._simulate_shares(unit_points, np.full(len(self.experiment.shakings), SEARCH_RUNS))
        return ImportanceSample(unit_points, shares, np.zeros(self.initial_count))

    def add_proposal(self, sample: ImportanceSample, proposal: Proposal, runs: IntArray) -> ImportanceSample:
        """Return a sample extended by the points of a proposal."""
        self.proposals.append(proposal)
        unit_points = np.concatenate([sample.unit_points, proposal.points])
        shares = np.concatenate([sample.shares, self._simulate_shares(proposal.points, runs)], axis=1)
        return ImportanceSample(unit_points, shares, _log_mixture(unit_points, self.proposals, self.initial_count))

    def extend_sample(self, sample: ImportanceSample | None, proposals: list[Proposal], runs: IntArray) -> ImportanceSample:
        """Return a sample extended by the points of the last of several proposals."""
        unit_points, shares = proposals[-1].points, self._simulate_shares(proposals[-1].points, runs)
        if sample is not None:
            unit_points, shares = np.concatenate([sample.unit_points, unit_points]), np.concatenate([sample.shares, shares], axis=1)
        return ImportanceSample(unit_points, shares, _log_mixture(unit_points, proposals, 0))

    def temper(self, sample: ImportanceSample, max_power: float = 1.0) -> tuple[float, FloatArray]:
        """Return the largest power of the likelihood, up to `max_power`, with enough effective points, and the weights."""
        likelihoods = self.log_likelihoods(sample)

        def weights(power: float) -> FloatArray:
            logs = ImportanceSample.log_weights(replace(sample), power * likelihoods)
            return np.exp(logs).sum(axis=0)

        # with few effective points a proposal would collapse onto them
        if effective_sample_size(weights(max_power)) >= MIN_EFFECTIVE:
            return max_power, weights(max_power)
        # the effective sample size decreases with the power: bisection
        low, high = 0.0, max_power
        for _ in range(30):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if effective_sample_size(weights(middle)) >= MIN_EFFECTIVE else (low, middle)
        return low, weights(low)

    def runs_per_shaking(self, sample: ImportanceSample, runs: int) -> IntArray:
        """Return the samples per block of each shaking: few if all likely blocks agree, more if it is repeated."""
        weights = self.temper(sample)[1]
        shares = sample.shares[:, weights > 1e-4 * weights.max()]
        is_unanimous = (shares == 0).all(axis=1) | (shares == SHARE_DENOMINATOR).all(axis=1)
        repetitions = np.maximum(sum(self.experiment.outcome_counts()), 1.0)
        # the noise of a share matters where likely blocks disagree, and enters once per repetition
        run_counts = np.where(is_unanimous, SEARCH_RUNS, runs) * 2 ** np.ceil(np.log2(repetitions)).astype(np.int64)
        return np.minimum(run_counts, SHARE_DENOMINATOR)

    def _simulate_shares(self, unit_points: FloatArray, runs: IntArray) -> IntArray:
        """Return the shares of falls of some blocks under each shaking, in 64ths."""
        shaking_count, run_index = len(self.experiment.shakings), self.run_count
        self.run_count += 1
        # the number of further proposals is unknown: assume half of the maximum, at least one
        total = shaking_count * (self.run_count + max((MAX_SEARCHES + MAX_PROPOSALS) // 2 - self.run_count, 1))

        def report(count: int, _: int) -> None:
            if self.progress is not None:
                self.progress(shaking_count * run_index + count, total)

        return outcome_shares(self.experiment, self.family, unit_points, runs, (self.seed, run_index), progress=report)


def _log_mixture(unit_points: FloatArray, proposals: list[Proposal], initial_count: int) -> FloatArray:
    """Return the log density of the mixture of all proposals and the initial points, weighted by their numbers."""
    counts = np.array([len(proposal.points) for proposal in proposals], dtype=np.float64)
    logs = [np.log(n) + proposal.log_density(unit_points) for n, proposal in zip(counts, proposals, strict=True)]
    if initial_count:
        logs.append(np.full(len(unit_points), np.log(initial_count)))
    # deterministic mixture: every point is weighted by all proposals, not by its own
    log_density: FloatArray = np.logaddexp.reduce(logs, axis=0) - np.log(counts.sum() + initial_count)
    return log_density
