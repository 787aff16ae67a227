"""Likelihood of blocks given observed outcomes.

Let y be 1 if the block fell (or moved) and 0 if not, and q(theta) the share of the samples of the block theta that fall under that
shaking. With the probability lambda (lapse rate) an outcome follows no model and is a coin toss. Then (derived here)::

    P(y = 1 | theta, lambda) = lambda/2 + (1 - lambda) q(theta)
    L(theta, lambda) = prod P^(w y) (1 - P)^(w (1 - y))

with w the outcome's weight. q is a share of few runs. P is linear in q, and the errors of q are independent between the factors: the
expectation of the product is the product at the expectation, so that averages over many noisy L converge to those of exact ones, only
more slowly ([AndrieuRoberts2009]_ section 1). This does not hold for a logarithm of q, or for a smoothed share.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from seisblock.core.typing import FloatArray, IntArray
from seisblock.studies.fit.dataset import Experiment
from seisblock.studies.fit.simulate import SHARE_DENOMINATOR

LAPSE_STEPS = 24
"""Number of values of lambda, equally likely."""

LAPSE_SHAPE = 9
"""Prior density of lambda: 9 (1 - lambda)^8, with a mean of 0.1."""

MIN_LAPSE_RATE = 1e-6
"""Lower limit of lambda: at 0 an outcome without any agreeing sample would be impossible."""


@dataclass(frozen=True, eq=False)
class LapseRate:
    """Equally likely values of lambda.

    Parameters
    ----------
    values : (l,) array, 1
    """

    values: FloatArray

    @property
    def outcome_probability(self) -> FloatArray:
        """Probability of the event, (l, 65), for 0, 1 ... 64 positive samples of 64."""
        share = np.arange(SHARE_DENOMINATOR + 1) / SHARE_DENOMINATOR
        return 0.5 * self.values[:, None] + (1.0 - self.values[:, None]) * share


def make_lapse_rate(fixed: float | None) -> LapseRate:
    """Return the values of lambda: midpoints of equally likely parts of its prior, or the fixed value."""
    if fixed is not None:
        return LapseRate(np.array([max(fixed, MIN_LAPSE_RATE)]))
    # midpoints of equally likely parts: an average over them is one over the prior
    shares = (np.arange(LAPSE_STEPS) + 0.5) / LAPSE_STEPS
    return LapseRate(1.0 - (1.0 - shares) ** (1.0 / LAPSE_SHAPE))


def log_likelihood(shares: IntArray, positive: FloatArray, negative: FloatArray, lapse: LapseRate) -> FloatArray:
    """Return ln L of each lambda and each block, (l, n) (derived here).

    Parameters
    ----------
    shares : (m, n) array of int
        Positive samples of 64 of each block under each shaking.
    positive, negative : (m,) arrays, 1
        Weights of the outcomes with and without the event, under each shaking.
    lapse : LapseRate
    """
    probability = lapse.outcome_probability
    total: FloatArray = np.log(probability) @ _share_weights(shares, positive)
    total += np.log1p(-probability) @ _share_weights(shares, negative)
    return total


def _share_weights(shares: IntArray, weights: FloatArray) -> FloatArray:
    """Return the weight of each share in each column, (65, n): few distinct shares represent many shakings."""
    count = shares.shape[1]
    totals = np.zeros((SHARE_DENOMINATOR + 1, count))
    columns = np.arange(count)
    # logarithms are taken of 65 shares only, then weighted by the counts
    for k in np.flatnonzero(weights):
        totals[shares[k], columns] += weights[k]
    return totals


def log_likelihoods_held_out(
    shares: IntArray, experiment: Experiment, parts: IntArray, lapse: LapseRate
) -> Iterator[tuple[IntArray, FloatArray]]:
    """Yield, for each part of the outcomes, their rows, and ln L of all others, (l, n) (derived here).

    Parameters
    ----------
    shares : (m, n) array of int
    experiment : Experiment
    parts : (outcomes,) array of int
        Part of each outcome.
    lapse : LapseRate
    """
    total = log_likelihood(shares, *experiment.outcome_counts(), lapse)
    for part in range(int(parts.max()) + 1):
        rows = np.flatnonzero(parts == part)
        # the log likelihood is additive: held-out outcomes are subtracted
        yield rows, total - log_likelihood(shares, *experiment.outcome_counts(rows), lapse)
