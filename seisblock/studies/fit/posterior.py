"""Which blocks explain what was seen, and how well each: blocks with their weights, found where they are and not on a grid.

Blocks are points of a unit cube, in which everything is equally likely before (:mod:`seisblock.studies.fit.axes`). Points are drawn from
clouds, each around those that explained most before it; the weight of a point is its likelihood over the density of all clouds together at
that point ([Cornuet2012]_ section 3), so that it does not matter how good a cloud was. While the points are few, likelihoods are taken
to a power below one, as large as leaves enough points with a weight.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from seisblock.studies.fit.blocks import Family, spread_evenly
from seisblock.studies.fit.experiment import Experiment
from seisblock.studies.fit.likelihood import Lapses, log_likelihood, log_likelihoods_without
from seisblock.studies.fit.proposal import Cloud, cloud_around
from seisblock.studies.fit.runs import LEVELS, shares_of
from seisblock.typing import FloatArray, IntArray, Progress

FIRST_BLOCKS = 64
"""Blocks that are looked at first, all over the cube, times two for each of its directions."""

SEARCHED, BLOCKS = 128, 256
"""Blocks of each later search, and of each look."""

FEW_RUNS = 4
"""Versions of each while blocks are only looked for."""

LEAST, ENOUGH, LEAST_WITHOUT = 50.0, 200.0, 30.0
"""Blocks that weights must amount to: to draw others around them, to be what is answered, and where outcomes are left out."""

WIDER = 0.8
"""Power of the likelihood for which blocks are drawn that are looked at: wide enough for what fewer outcomes would leave open, too."""

MOST_SEARCHES, MOST_LOOKS = 12, 12
"""Looks for the blocks, and at them."""


@dataclass(frozen=True, eq=False)
class Sampled:
    """Blocks, how often their versions fell, and how densely they lie.

    Parameters
    ----------
    places : (n, d) array, 1
        Points of the unit cube.
    shares : (shakings, n) array of int
        Of 64 versions, those that fell.
    log_density : (n,) array
        Logarithm of the density from which they were drawn.
    """

    places: FloatArray
    shares: IntArray
    log_density: FloatArray

    def log_weights(self, log_likelihoods: FloatArray) -> FloatArray:
        """Return logarithms of the weights of each lambda and each block, (l, n), their largest zero."""
        found = log_likelihoods - self.log_density
        shifted: FloatArray = found - found.max()
        return shifted


def amounts_to(weights: FloatArray) -> float:
    """Return how many equal ones some weights are worth."""
    return float(weights.sum() ** 2 / (weights**2).sum())


def fewest_without(sampled: Sampled, experiment: Experiment, parts: IntArray, lapse: Lapses) -> float:
    """Return how many blocks the weights amount to, at the fewest, when one of the parts of the outcomes is left out."""
    if not parts.any():
        return np.inf
    found = log_likelihoods_without(sampled.shares, experiment, parts, lapse)
    return min(amounts_to(np.exp(sampled.log_weights(logs)).sum(axis=0)) for _, logs in found)


def explore(
    experiment: Experiment, family: Family, lapse: Lapses, parts: IntArray, *, runs: int, seed: int, progress: Progress | None = None
) -> tuple[Sampled, float]:
    """Return blocks that explain an experiment, and how many equally good ones they amount to.

    Parameters
    ----------
    experiment, family, lapse
    parts : (outcomes,) array of int
        Which outcomes are left out together: enough blocks are looked at for what the others say alone, too.
    runs : int
        Versions of each block under each shaking, a power of two.
    seed : int
    progress : callable
        Told the number of shakings followed and the number in all, as far as that can be known.
    """
    search = _Search(experiment, family, lapse, seed, progress)
    sampled = search.first()
    for _ in range(MOST_SEARCHES):
        power, weights = search.tempered(sampled, WIDER)
        cloud = cloud_around(sampled.places, weights, BLOCKS if power == WIDER else SEARCHED, search.dice)
        if power == WIDER:
            break
        sampled = search.added(sampled, cloud, np.full(len(experiment.shakings), FEW_RUNS))
    found, clouds = None, []
    for look in range(MOST_LOOKS):
        clouds.append(cloud)
        many = search.worth(sampled if found is None else found, runs)
        found = search.looked_at(found, clouds, many)
        weights = np.exp(found.log_weights(search.log_likelihoods(found))).sum(axis=0)
        if look and amounts_to(weights) >= ENOUGH and fewest_without(found, experiment, parts, lapse) >= LEAST_WITHOUT:
            break
        cloud = cloud_around(found.places, search.tempered(found, WIDER)[1], BLOCKS, search.dice)
    assert found is not None
    return found, amounts_to(weights)


@dataclass(eq=False)
class _Search:
    """What all looks have in common, and how far they are."""

    experiment: Experiment
    family: Family
    lapse: Lapses
    seed: int
    progress: Progress | None
    looks: int = 0

    def __post_init__(self) -> None:
        self.dice = np.random.default_rng([self.seed, 1])
        self.clouds: list[Cloud] = []
        self.even = FIRST_BLOCKS * 2 ** len(self.family.axes)

    def log_likelihoods(self, sampled: Sampled) -> FloatArray:
        """Return ln L of each lambda and each block."""
        return log_likelihood(sampled.shares, *self.experiment.counted(), self.lapse)

    def first(self) -> Sampled:
        """Return blocks all over the cube."""
        d = len(self.family.axes)
        places = (self.dice.random(d) + spread_evenly(self.even, d)) % 1.0
        shares = self._followed(places, np.full(len(self.experiment.shakings), FEW_RUNS))
        return Sampled(places, shares, np.zeros(self.even))

    def added(self, sampled: Sampled, cloud: Cloud, runs: IntArray) -> Sampled:
        """Return blocks with those of another cloud."""
        self.clouds.append(cloud)
        places = np.concatenate([sampled.places, cloud.points])
        shares = np.concatenate([sampled.shares, self._followed(cloud.points, runs)], axis=1)
        return Sampled(places, shares, _log_mixture(places, self.clouds, self.even))

    def looked_at(self, found: Sampled | None, clouds: list[Cloud], runs: IntArray) -> Sampled:
        """Return blocks of some clouds, the last of which are new."""
        places, shares = clouds[-1].points, self._followed(clouds[-1].points, runs)
        if found is not None:
            places, shares = np.concatenate([found.places, places]), np.concatenate([found.shares, shares], axis=1)
        return Sampled(places, shares, _log_mixture(places, clouds, 0))

    def tempered(self, sampled: Sampled, most: float = 1.0) -> tuple[float, FloatArray]:
        """Return the largest power of the likelihood, up to `most`, that leaves enough blocks with a weight, and the weights."""
        likelihoods = self.log_likelihoods(sampled)

        def weights(power: float) -> FloatArray:
            found = Sampled.log_weights(replace(sampled), power * likelihoods)
            return np.exp(found).sum(axis=0)

        if amounts_to(weights(most)) >= LEAST:
            return most, weights(most)
        low, high = 0.0, most
        for _ in range(30):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if amounts_to(weights(middle)) >= LEAST else (low, middle)
        return low, weights(low)

    def worth(self, sampled: Sampled, runs: int) -> IntArray:
        """Return how many versions of each block a shaking is worth: few where all blocks that count agree, more where it is repeated."""
        weights = self.tempered(sampled)[1]
        chosen = sampled.shares[:, weights > 1e-4 * weights.max()]
        agreed = (chosen == 0).all(axis=1) | (chosen == LEVELS).all(axis=1)
        often = np.maximum(sum(self.experiment.counted()), 1.0)
        many = np.where(agreed, FEW_RUNS, runs) * 2 ** np.ceil(np.log2(often)).astype(np.int64)
        return np.minimum(many, LEVELS)

    def _followed(self, places: FloatArray, runs: IntArray) -> IntArray:
        """Return how often the versions of some blocks fall under each shaking."""
        many, look = len(self.experiment.shakings), self.looks
        self.looks += 1
        # nobody knows how many looks are to come: half of what there may be, at least one
        total = many * (self.looks + max((MOST_SEARCHES + MOST_LOOKS) // 2 - self.looks, 1))

        def told(done: int, _: int) -> None:
            if self.progress is not None:
                self.progress(many * look + done, total)

        return shares_of(self.experiment, self.family, places, runs, (self.seed, look), progress=told)


def _log_mixture(places: FloatArray, clouds: list[Cloud], even: int) -> FloatArray:
    """Return the logarithm of the density of all clouds together, as many points as each has, and of points all over the cube."""
    counts = np.array([len(cloud.points) for cloud in clouds], dtype=np.float64)
    logs = [np.log(n) + cloud.log_density(places) for n, cloud in zip(counts, clouds, strict=True)]
    if even:
        logs.append(np.full(len(places), np.log(even)))
    mixed: FloatArray = np.logaddexp.reduce(logs, axis=0) - np.log(counts.sum() + even)
    return mixed
