"""What a fit is worth: each record foretold by blocks that were found without it, and compared with what it did."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seisblock.studies.fit.experiment import Experiment
from seisblock.studies.fit.likelihood import Lapses, log_likelihood, log_likelihoods_without
from seisblock.studies.fit.posterior import Sampled, amounts_to
from seisblock.studies.intervals import wilson_interval
from seisblock.typing import BoolArray, FloatArray, IntArray

STEPS = (0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0)
"""Ends of the ranges of probability in which what was foretold is compared with what happened."""


@dataclass(frozen=True)
class CalibrationStep:
    """What happened where a probability within a range was foretold.

    Parameters
    ----------
    low, high : float, 1
        Ends of the range of probability.
    outcomes : int
    mean_probability : float, 1
        Of those that were foretold.
    share : float, 1
        Of the outcomes in which it happened.
    share_interval : (float, float), 1
        Wilson's at 95 %.
    """

    low: float
    high: float
    outcomes: int
    mean_probability: float
    share: float
    share_interval: tuple[float, float]


@dataclass(frozen=True)
class HeldOut:
    """How well outcomes are foretold by blocks that were found without their record.

    Parameters
    ----------
    folds : int
        Parts into which the records are dealt, each of which is held out once.
    accuracy : float, 1
        Share of the outcomes that a probability on the right side of one half foretold; a weight counts as so many.
    accuracy_interval : (float, float), 1
        Wilson's at 95 %.
    brier : float, 1
        Mean square of the probability less the outcome ([Brier1950]_ eq. (2)); 0 at best.
    log_score : float, 1
        Mean of minus the natural logarithm of the probability of what happened; 0 at best.
    rate_accuracy, rate_brier : float, 1
        The same where the share of the others that fell is foretold for each.
    threshold_accuracy : float, 1
        The same where it falls above the peak velocity of the ground, whichever is right most often among the others.
    effective_blocks : float
        How many equally good blocks the fewest of the parts rest on.
    calibration : tuple of CalibrationStep
        Ranges in which nothing was foretold are left out.
    """

    folds: int
    accuracy: float
    accuracy_interval: tuple[float, float]
    brier: float
    log_score: float
    rate_accuracy: float
    rate_brier: float
    threshold_accuracy: float
    effective_blocks: float
    calibration: tuple[CalibrationStep, ...]


def foretold(experiment: Experiment, sampled: Sampled, lapse: Lapses) -> FloatArray:
    """Return the probability of each outcome by all of them, (n,)."""
    logs = log_likelihood(sampled.shares, *experiment.counted(), lapse)
    return _chance(sampled, lapse, sampled.log_weights(logs), experiment.shaking)


def foretold_without(experiment: Experiment, sampled: Sampled, lapse: Lapses, folds: IntArray) -> tuple[FloatArray, float]:
    """Return the probability of each outcome by those of other folds, (n,), and the fewest blocks that any part of it rests on.

    Parameters
    ----------
    experiment, sampled, lapse
    folds : (records,) array of int
        Which fold each record is in.
    """
    found, fewest = np.empty(len(experiment.outcomes)), np.inf
    for held, logs in log_likelihoods_without(sampled.shares, experiment, folds[experiment.record], lapse):
        weights = sampled.log_weights(logs)
        fewest = min(fewest, amounts_to(np.exp(weights).sum(axis=0)))
        found[held] = _chance(sampled, lapse, weights, experiment.shaking[held])
    return found, float(fewest)


def _chance(sampled: Sampled, lapse: Lapses, log_weights: FloatArray, shakings: IntArray) -> FloatArray:
    """Return the probability that some shakings make it happen, over all blocks and lambdas by their weights."""
    weights = np.exp(log_weights)
    weights /= weights.sum()
    different, places = np.unique(shakings, return_inverse=True)
    by_chance = lapse.of_a_share
    found = np.array([(weights * by_chance[:, sampled.shares[k]]).sum() for k in different])
    return found[places]


def scores(experiment: Experiment, probability: FloatArray, velocities: FloatArray, folds: IntArray, effective_blocks: float) -> HeldOut:
    """Return how good probabilities of outcomes are ([Brier1950]_ eq. (2)).

    Parameters
    ----------
    experiment : Experiment
    probability : (n,) array, 1
        Of each outcome, without its record.
    velocities : (n,) array, m/s
        Peak velocity of the ground.
    folds : (records,) array of int
        Which fold each record is in.
    effective_blocks : float
    """
    happened, weights = experiment.happened, experiment.weights
    share = weights / weights.sum()
    parts = folds[experiment.record]
    rate, above = np.empty(happened.size), np.empty(happened.size, dtype=np.bool_)
    for part in range(int(parts.max()) + 1):
        held, others = parts == part, parts != part
        known = weights[others].sum()
        rate[held] = weights[others] @ happened[others] / known if known else 0.5
        above[held] = velocities[held] >= _threshold(velocities[others], happened[others], weights[others])
    right = (probability > 0.5) == (happened > 0.5)
    accuracy = float(share @ right)
    count = max(round(float(weights.sum())), 1)
    likely = np.where(happened > 0.5, probability, 1.0 - probability)
    return HeldOut(
        int(folds.max()) + 1,
        accuracy,
        wilson_interval(round(accuracy * count), count),
        float(share @ (probability - happened) ** 2),
        float(-share @ np.log(likely)),
        float(share @ ((rate > 0.5) == (happened > 0.5))),
        float(share @ (rate - happened) ** 2),
        float(share @ (above == (happened > 0.5))),
        effective_blocks,
        calibration(probability, happened, weights),
    )


def _threshold(values: FloatArray, happened: FloatArray, weights: FloatArray) -> float:
    """Return the value from which on it happens that is right most often, in the middle between two."""
    if not values.size:
        return np.inf
    order = np.argsort(values)
    ordered, gain = values[order], (weights * (2.0 * happened - 1.0))[order]
    # right where it happens from row k on and does not before
    right = np.concatenate([[0.0], np.cumsum(-gain)]) + np.concatenate([np.cumsum(gain[::-1])[::-1], [0.0]])
    ends = np.concatenate([[-np.inf], 0.5 * (ordered[:-1] + ordered[1:]), [np.inf]])
    return float(ends[int(right.argmax())])


def calibration(probability: FloatArray, happened: FloatArray, weights: FloatArray) -> tuple[CalibrationStep, ...]:
    """Return what happened where probabilities within each range were foretold; (n,) arrays, 1."""
    found = []
    place = np.clip(np.searchsorted(STEPS, probability, side="right") - 1, 0, len(STEPS) - 2)
    for k in range(len(STEPS) - 1):
        chosen: BoolArray = place == k
        weight = float(weights[chosen].sum())
        if weight == 0.0:
            continue
        share = float(weights[chosen] @ happened[chosen]) / weight
        count = max(round(weight), 1)
        interval = wilson_interval(round(share * count), count)
        mean = float(weights[chosen] @ probability[chosen]) / weight
        found.append(CalibrationStep(STEPS[k], STEPS[k + 1], int(chosen.sum()), mean, share, interval))
    return tuple(found)
