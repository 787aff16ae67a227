"""Adaptive importance sampling of the posterior of block parameters.

Blocks are points of a unit cube with a uniform prior (:mod:`seisblock.studies.fit.priors`). Points are drawn from proposals, each
around the best points of the previous ones; the weight of a point is its likelihood over the density of the mixture of all
proposals at that point ([Cornuet2012]_ section 3), which is unbiased for any proposal. While the points are few, the likelihood is
tempered: raised to the largest power below one that leaves enough effective points.

A proposal need not be exact: it uses shares that are averages over neighbouring points, so that the search needs one sample of each
block under each shaking. The weights use each point's own samples, in numbers that depend on what they contribute to the error.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

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

SEARCH_BLOCKS, CANDIDATES, PROPOSAL_BLOCKS = 128, 1024, 256
"""Points of each proposal of the search; of the posterior sample, before and after the choice by the shares of neighbours."""

GROUPS = 12
"""Groups of shakings between which likely points are copied and others dropped."""

SEARCH_RUNS = 1
"""Samples of each block during the search."""

NEIGHBOURS = 16
"""Points whose shares are averaged for a proposal."""

MIN_EFFECTIVE, TARGET_EFFECTIVE, MIN_EFFECTIVE_WITHOUT = 50.0, 200.0, 30.0
"""Effective sample sizes: of a proposal, of the posterior sample, and with outcomes held out."""

PROPOSAL_POWER = 0.8
"""Power of the likelihood of a proposal: wide enough for the posterior with outcomes held out."""

MAX_SEARCHES, MAX_PROPOSALS = 12, 24
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
        Logarithm of the density of the points: that of the proposals times the expected number of copies.
    origin : (n,) array of int
        Number of the draw of each point; copies of one draw are not independent.
    """

    unit_points: FloatArray
    shares: IntArray
    log_density: FloatArray
    origin: IntArray

    def log_weights(self, log_likelihoods: FloatArray) -> FloatArray:
        """Return the log weights of each lapse rate and each block, (l, n), with a maximum of zero."""
        logs = log_likelihoods - self.log_density
        # a common shift cancels in normalised weights and prevents an underflow
        shifted: FloatArray = logs - logs.max()
        return shifted

    def effective_size(self, log_weights: FloatArray) -> float:
        """Return the effective number of independent draws for the log weights of each lapse rate and each block, (l, n)."""
        return effective_sample_size(np.bincount(self.origin, np.exp(log_weights).sum(axis=0)).astype(np.float64))


def min_effective_without(sample: ImportanceSample, experiment: Experiment, parts: IntArray, lapse: LapseRate) -> float:
    """Return the smallest effective sample size when one of the parts of the outcomes is held out."""
    if not parts.any():
        return np.inf
    held_out_logs = log_likelihoods_held_out(sample.shares, experiment, parts, lapse)
    return min(sample.effective_size(sample.log_weights(logs)) for _, logs in held_out_logs)


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
        Called with the number of simulated samples and an estimate of the total.
    """
    # search: temper until a proposal suits the likelihood at PROPOSAL_POWER
    sampler = _Sampler(experiment, family, lapse, runs, seed, progress)
    sample, proposals = sampler.first(), list[Proposal]()
    for _ in range(MAX_SEARCHES):
        power, weights = sampler.temper(sample)
        if power == PROPOSAL_POWER:
            break
        proposals.append(sampler.make_proposal(sample, weights, SEARCH_BLOCKS))
        sample = sampler.extend_search(sample, proposals)
    # posterior: the search's points are dropped, as few samples per block made their shares coarse
    posterior, proposals, log_copies = None, [], np.empty(0)
    for iteration in range(MAX_PROPOSALS):
        run_counts, order = sampler.runs_per_shaking(sample)
        proposals.append(sampler.make_proposal(sample, weights, CANDIDATES))
        posterior, log_copies = sampler.extend_posterior(posterior, proposals, log_copies, run_counts, order)
        effective = posterior.effective_size(posterior.log_weights(sampler.log_likelihoods(posterior.shares)))
        if (
            iteration
            and effective >= TARGET_EFFECTIVE
            and min_effective_without(posterior, experiment, parts, lapse) >= MIN_EFFECTIVE_WITHOUT
        ):
            break
        sample = posterior
        weights = sampler.temper(sample)[1]
    assert posterior is not None
    return posterior, effective


@dataclass(eq=False)
class _Sampler:
    """State of the sampler: experiment, simulated points, metric of neighbours and progress."""

    experiment: Experiment
    family: BlockFamily
    lapse: LapseRate
    runs: int
    seed: int
    progress: Progress | None

    def __post_init__(self) -> None:
        self.rng = np.random.default_rng([self.seed, 1])
        self.initial_count = INITIAL_BLOCKS * 2 ** len(self.family.axes)
        self.root = np.eye(len(self.family.axes))
        self.simulated: list[tuple[FloatArray, IntArray]] = []
        self.batch_count = self.sample_count = 0

    def log_likelihoods(self, shares: IntArray) -> FloatArray:
        """Return the log likelihood of each lapse rate and each block, (l, n)."""
        return log_likelihood(shares, *self.experiment.outcome_counts(), self.lapse)

    def first(self) -> ImportanceSample:
        """Return quasi-random points over the whole cube."""
        d = len(self.family.axes)
        # random offset of a low-discrepancy sequence: even, and unbiased
        unit_points = (self.rng.random(d) + quasi_random_points(self.initial_count, d)) % 1.0
        return ImportanceSample(unit_points, self._search_shares(unit_points), np.zeros(self.initial_count), np.arange(self.initial_count))

    def make_proposal(self, sample: ImportanceSample, weights: FloatArray, count: int) -> Proposal:
        """Return a proposal around weighted points; its shape is the metric of neighbours from now on."""
        proposal = make_proposal(sample.unit_points, weights, count, self.rng)
        self.root = proposal.root
        return proposal

    def extend_search(self, sample: ImportanceSample, proposals: list[Proposal]) -> ImportanceSample:
        """Return a sample extended by the points of the last of several proposals."""
        unit_points = np.concatenate([sample.unit_points, proposals[-1].points])
        shares = np.concatenate([sample.shares, self._search_shares(proposals[-1].points)], axis=1)
        return ImportanceSample(unit_points, shares, _log_mixture(unit_points, proposals, self.initial_count), np.arange(len(unit_points)))

    def extend_posterior(
        self, sample: ImportanceSample | None, proposals: list[Proposal], log_copies: FloatArray, run_counts: IntArray, order: IntArray
    ) -> tuple[ImportanceSample, FloatArray]:
        """Return a sample extended by the last of several proposals, and the log of the expected number of copies of each point.

        The shakings are simulated in groups. Before a group, points are dropped or copied at random, so that their expected number is
        in proportion to the likelihood of the shakings simulated so far, times that of the others with shares of neighbours. Likely
        points get more samples, and the errors of the groups add up instead of being multiplied. The weight of a point is divided by
        its expected number of copies, which leaves averages unbiased ([DelMoral2006]_ section 3).
        """
        points = proposals[-1].points
        shares, copies = self.neighbour_shares(points), np.zeros(len(points))
        log_density, origin = _log_mixture(points, proposals, 0), np.arange(len(points))
        groups = min(GROUPS, len(order))
        for k in range(groups):
            logs = PROPOSAL_POWER * np.logaddexp.reduce(self.log_likelihoods(shares), axis=0) - log_density - copies
            weights = np.exp(logs - logs.max())
            if k == 0 or effective_sample_size(weights) < 0.5 * len(weights):
                expected = PROPOSAL_BLOCKS * weights / weights.sum()
                # systematic resampling: the number of copies is the expected one, rounded up or down
                steps = np.floor(np.cumsum(expected) + self.rng.random()).astype(np.int64)
                chosen = np.repeat(np.arange(len(points)), np.diff(steps, prepend=0))
                points, shares, log_density, origin = points[chosen], shares[:, chosen], log_density[chosen], origin[chosen]
                copies = copies[chosen] + np.log(expected[chosen])
            group = order[k::groups]
            shares[group] = self._simulate_shares(points, run_counts, group)
        self.simulated.append((points, shares))
        log_copies = np.concatenate([log_copies, copies])
        if sample is not None:
            points = np.concatenate([sample.unit_points, points])
            shares = np.concatenate([sample.shares, shares], axis=1)
            origin = np.concatenate([sample.origin, origin + sample.origin.max() + 1])
        return ImportanceSample(points, shares, _log_mixture(points, proposals, 0) + log_copies, origin), log_copies

    def neighbour_shares(self, unit_points: FloatArray) -> IntArray:
        """Return the shares of some points as means over the nearest simulated points: less noise where it need not be unbiased."""
        from scipy.linalg import solve_triangular
        from scipy.spatial import cKDTree

        known_points = np.concatenate([points for points, _ in self.simulated])
        known_shares = np.concatenate([shares for _, shares in self.simulated], axis=1)
        scaled, scaled_known = (solve_triangular(self.root, points.T, lower=True).T for points in (unit_points, known_points))
        neighbours = cKDTree(scaled_known).query(scaled, NEIGHBOURS)[1]
        total = np.zeros((len(known_shares), len(unit_points)))
        for column in neighbours.T:
            total += known_shares[:, column]
        return np.rint(total / NEIGHBOURS).astype(np.uint8)

    def temper(self, sample: ImportanceSample) -> tuple[float, FloatArray]:
        """Return the largest power of the likelihood, up to PROPOSAL_POWER, with enough effective points, and the weights."""
        likelihoods = self.log_likelihoods(self.neighbour_shares(sample.unit_points))

        def weights(power: float) -> FloatArray:
            return np.exp(sample.log_weights(power * likelihoods)).sum(axis=0)

        # with few effective points a proposal would collapse onto them
        if effective_sample_size(weights(PROPOSAL_POWER)) >= MIN_EFFECTIVE:
            return PROPOSAL_POWER, weights(PROPOSAL_POWER)
        # the effective sample size decreases with the power: bisection
        low, high = 0.0, PROPOSAL_POWER
        for _ in range(30):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if effective_sample_size(weights(middle)) >= MIN_EFFECTIVE else (low, middle)
        return low, weights(low)

    def runs_per_shaking(self, sample: ImportanceSample) -> tuple[IntArray, IntArray]:
        """Return the samples per block of each shaking, and the shakings by decreasing noise.

        A share q of n samples adds v/n to the relative variance of the likelihood, with v from q (1 - q) and the outcomes. The sum of
        v/n is that of `runs` samples everywhere; the sum of n is then smallest with n in proportion to the root of v ([Neyman1934]_).
        """
        shares = self.neighbour_shares(sample.unit_points)
        weights = np.exp(sample.log_weights(self.log_likelihoods(shares)))
        weights /= weights.sum()
        lapse, block_weights = float(weights.sum(axis=1) @ self.lapse.values), weights.sum(axis=0)
        q = shares / SHARE_DENOMINATOR
        # half a sample: none among some blocks is no certainty
        variance_floor = 0.5 / (NEIGHBOURS * effective_sample_size(block_weights))
        probability = 0.5 * lapse + (1.0 - lapse) * (q @ block_weights)
        positive, negative = self.experiment.outcome_counts()
        noise = (positive / probability + negative / (1.0 - probability)) * np.sqrt((q * (1.0 - q)) @ block_weights + variance_floor)
        run_counts = np.clip(self.runs * noise * noise.sum() / (noise @ noise), 1.0, SHARE_DENOMINATOR)
        return (2 ** np.rint(np.log2(run_counts))).astype(np.int64), np.argsort(-noise, kind="stable")

    def _search_shares(self, unit_points: FloatArray) -> IntArray:
        """Return the shares of falls of some blocks under each shaking from `SEARCH_RUNS` samples."""
        shaking_count = len(self.experiment.shakings)
        shares = self._simulate_shares(unit_points, np.full(shaking_count, SEARCH_RUNS), np.arange(shaking_count))
        self.simulated.append((unit_points, shares))
        return shares

    def _simulate_shares(self, unit_points: FloatArray, runs: IntArray, rows: IntArray) -> IntArray:
        """Return the shares of falls of some blocks under some shakings, in 64ths."""
        done, self.batch_count = self.sample_count, self.batch_count + 1
        # the number of proposals is unknown: some for the search, then a few of the posterior sample
        expected = self.initial_count + 4 * SEARCH_BLOCKS + 2 * PROPOSAL_BLOCKS * self.runs

        def report(count: int, total: int) -> None:
            self.sample_count = done + count
            if self.progress is not None:
                self.progress(self.sample_count, max(expected * len(self.experiment.shakings), done + total))

        return outcome_shares(self.experiment, self.family, unit_points, runs, (self.seed, self.batch_count), rows=rows, progress=report)


def _log_mixture(unit_points: FloatArray, proposals: list[Proposal], initial_count: int) -> FloatArray:
    """Return the log density of the mixture of all proposals and the initial points, weighted by their numbers."""
    counts = np.array([len(proposal.points) for proposal in proposals], dtype=np.float64)
    logs = [np.log(n) + proposal.log_density(unit_points) for n, proposal in zip(counts, proposals, strict=True)]
    if initial_count:
        logs.append(np.full(len(unit_points), np.log(initial_count)))
    # deterministic mixture: every point is weighted by all proposals, not by its own
    log_density: FloatArray = np.logaddexp.reduce(logs, axis=0) - np.log(counts.sum() + initial_count)
    return log_density
