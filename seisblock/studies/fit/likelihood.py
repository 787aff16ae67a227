"""How well blocks explain what was seen.

Let y be 1 where the block fell (or moved) and 0 where it did not, and q(theta) the share of the versions of the block theta that fall under
that shaking. With the probability lambda an outcome follows no model, and is as likely one as the other. Then (derived here)::

    P(y = 1 | theta, lambda) = lambda/2 + (1 - lambda) q(theta)
    L(theta, lambda) = prod P^(w y) (1 - P)^(w (1 - y))

with w the outcome's weight. q is a share of few runs. It enters P linearly, and is by chance in each factor by itself: the
expectation of the product is the product at the expectation, so that what is made of many noisy L is what would be made of exact ones,
only less sharply ([AndrieuRoberts2009]_ section 1). A logarithm of q, or a share that is smoothed first, would not have this.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from seisblock.core.typing import FloatArray, IntArray
from seisblock.studies.fit.dataset import Experiment
from seisblock.studies.fit.simulate import SHARE_DENOMINATOR

LAPSE_STEPS = 24
"""Values of lambda, each as likely as the others."""

LAPSE_SHAPE = 9
"""Before anything is seen lambda has the density 9 (1 - lambda)^8: 0.1 in the mean."""

MIN_LAPSE_RATE = 1e-6
"""No lambda is smaller: an outcome that no version explains would be impossible."""


@dataclass(frozen=True, eq=False)
class LapseRate:
    """Values of lambda that are taken for equally likely.

    Parameters
    ----------
    values : (l,) array, 1
    """

    values: FloatArray

    @property
    def outcome_probability(self) -> FloatArray:
        """Probability that it happens, (l, 65), where 0, 1 ... 64 of 64 versions say so."""
        share = np.arange(SHARE_DENOMINATOR + 1) / SHARE_DENOMINATOR
        return 0.5 * self.values[:, None] + (1.0 - self.values[:, None]) * share


def make_lapse_rate(fixed: float | None) -> LapseRate:
    """Return the values of lambda: those of its density in equal parts, or the one that is given."""
    if fixed is not None:
        return LapseRate(np.array([max(fixed, MIN_LAPSE_RATE)]))
    shares = (np.arange(LAPSE_STEPS) + 0.5) / LAPSE_STEPS
    return LapseRate(1.0 - (1.0 - shares) ** (1.0 / LAPSE_SHAPE))


def log_likelihood(shares: IntArray, happened: FloatArray, not_happened: FloatArray, lapse: LapseRate) -> FloatArray:
    """Return ln L of each lambda and each block, (l, n) (derived here).

    Parameters
    ----------
    shares : (m, n) array of int
        Of 64 versions, under each shaking those of each block that fall.
    happened, not_happened : (m,) arrays, 1
        How often each shaking made it happen, and did not.
    lapse : Lapses
    """
    chance = lapse.outcome_probability
    total: FloatArray = np.log(chance) @ _share_weights(shares, happened)
    total += np.log1p(-chance) @ _share_weights(shares, not_happened)
    return total


def _share_weights(shares: IntArray, weights: FloatArray) -> FloatArray:
    """Return the weight that each share has in each column, (65, n): few shares stand for many shakings."""
    count = shares.shape[1]
    totals = np.zeros((SHARE_DENOMINATOR + 1, count))
    columns = np.arange(count)
    for k in np.flatnonzero(weights):
        totals[shares[k], columns] += weights[k]
    return totals


def log_likelihoods_held_out(
    shares: IntArray, experiment: Experiment, parts: IntArray, lapse: LapseRate
) -> Iterator[tuple[IntArray, FloatArray]]:
    """Yield, for each part of the outcomes, which they are, and ln L of all others, (l, n) (derived here).

    Parameters
    ----------
    shares : (m, n) array of int
    experiment : Experiment
    parts : (outcomes,) array of int
        Which part each outcome is in.
    lapse : Lapses
    """
    total = log_likelihood(shares, *experiment.outcome_counts(), lapse)
    for part in range(int(parts.max()) + 1):
        rows = np.flatnonzero(parts == part)
        yield rows, total - log_likelihood(shares, *experiment.outcome_counts(rows), lapse)
