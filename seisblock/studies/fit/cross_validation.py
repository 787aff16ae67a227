"""Cross-validation of a fit: each record predicted from the others, with scores and calibration."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seisblock.core.typing import BoolArray, FloatArray, IntArray
from seisblock.studies.fit.dataset import Experiment
from seisblock.studies.fit.importance_sampling import ImportanceSample
from seisblock.studies.fit.likelihood import LapseRate, log_likelihood, log_likelihoods_held_out
from seisblock.studies.intervals import clopper_pearson

CALIBRATION_BINS = (0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0)
"""Edges of the calibration bins, probability."""


@dataclass(frozen=True)
class CalibrationBin:
    """Observed share of outcomes within a bin of predicted probability.

    Parameters
    ----------
    low, high : float, 1
        Ends of the bin.
    outcomes : int
    mean_probability : float, 1
        Mean prediction in the bin.
    share : float, 1
        Observed share of the event.
    share_interval : (float, float), 1
        Clopper-Pearson, 95 %.
    """

    low: float
    high: float
    outcomes: int
    mean_probability: float
    share: float
    share_interval: tuple[float, float]


@dataclass(frozen=True)
class HeldOutScores:
    """Scores of cross-validated predictions.

    Parameters
    ----------
    folds : int
        Folds of the records, each held out once.
    accuracy : float, 1
        Weighted share of the outcomes with a prediction on the right side of one half.
    accuracy_interval : (float, float), 1
        Clopper-Pearson, 95 %.
    brier : float, 1
        Mean square of the probability minus the outcome ([Brier1950]_ eq. (2)); 0 at best.
    log_score : float, 1
        Mean of minus the natural logarithm of the probability of the outcome; 0 at best.
    rate_accuracy, rate_brier : float, 1
        The same for a constant prediction: the share of the event in the other folds.
    threshold_accuracy : float, 1
        The same for a threshold of the peak ground velocity, the best one in the other folds.
    effective_blocks : float
        Smallest effective sample size over the folds.
    calibration : tuple of CalibrationBin
        Without empty bins.
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
    calibration: tuple[CalibrationBin, ...]


def predict(experiment: Experiment, sample: ImportanceSample, lapse: LapseRate) -> FloatArray:
    """Return the predictive probability of each outcome from all of them, (n,)."""
    logs = log_likelihood(sample.shares, *experiment.outcome_counts(), lapse)
    return _predictive_probability(sample, lapse, sample.log_weights(logs), experiment.shaking)


def predict_held_out(experiment: Experiment, sample: ImportanceSample, lapse: LapseRate, folds: IntArray) -> tuple[FloatArray, float]:
    """Return the probability of each outcome from those of other folds, (n,), and the smallest effective sample size.

    Parameters
    ----------
    experiment, sample, lapse
    folds : (records,) array of int
        Fold of each record.
    """
    probability, min_effective = np.empty(len(experiment.outcomes)), np.inf
    # the outcomes of one record are not independent: whole records are held out
    for rows, logs in log_likelihoods_held_out(sample.shares, experiment, folds[experiment.record], lapse):
        weights = sample.log_weights(logs)
        min_effective = min(min_effective, sample.effective_size(weights))
        probability[rows] = _predictive_probability(sample, lapse, weights, experiment.shaking[rows])
    return probability, float(min_effective)


def _predictive_probability(sample: ImportanceSample, lapse: LapseRate, log_weights: FloatArray, shakings: IntArray) -> FloatArray:
    """Return the predictive probability of the event under some shakings, over all blocks and lambdas by weight."""
    weights = np.exp(log_weights)
    weights /= weights.sum()
    unique_shakings, inverse = np.unique(shakings, return_inverse=True)
    outcome_probability = lapse.outcome_probability
    # outcomes under one shaking share their probability
    probabilities = np.array([(weights * outcome_probability[:, sample.shares[k]]).sum() for k in unique_shakings])
    return probabilities[inverse]


def score_predictions(
    experiment: Experiment, probability: FloatArray, velocities: FloatArray, folds: IntArray, effective_blocks: float
) -> HeldOutScores:
    """Return the scores of predicted probabilities ([Brier1950]_ eq. (2)).

    Parameters
    ----------
    experiment : Experiment
    probability : (n,) array, 1
        Prediction of each outcome without its record.
    velocities : (n,) array, m/s
        Peak ground velocity.
    folds : (records,) array of int
        Fold of each record.
    effective_blocks : float
    """
    outcomes, weights = experiment.happened, experiment.weights
    share = weights / weights.sum()
    parts = folds[experiment.record]
    rate, above_threshold = np.empty(outcomes.size), np.empty(outcomes.size, dtype=np.bool_)
    for part in range(int(parts.max()) + 1):
        test, train = parts == part, parts != part
        train_weight = weights[train].sum()
        # baselines: constant rate and best velocity threshold of the training folds
        # without outcomes in the other folds nothing is known: one half
        rate[test] = weights[train] @ outcomes[train] / train_weight if train_weight else 0.5
        above_threshold[test] = velocities[test] >= _threshold(velocities[train], outcomes[train], weights[train])
    correct = (probability > 0.5) == (outcomes > 0.5)
    accuracy = float(share @ correct)
    count = max(round(float(weights.sum())), 1)
    outcome_probability = np.where(outcomes > 0.5, probability, 1.0 - probability)
    return HeldOutScores(
        int(folds.max()) + 1,
        accuracy,
        clopper_pearson(round(accuracy * count), count),
        float(share @ (probability - outcomes) ** 2),
        float(-share @ np.log(outcome_probability)),
        float(share @ ((rate > 0.5) == (outcomes > 0.5))),
        float(share @ (rate - outcomes) ** 2),
        float(share @ (above_threshold == (outcomes > 0.5))),
        effective_blocks,
        calibration(probability, outcomes, weights),
    )


def _threshold(values: FloatArray, outcomes: FloatArray, weights: FloatArray) -> float:
    """Return the threshold with the most correct classifications, midway between two values."""
    if not values.size:
        return np.inf
    order = np.argsort(values)
    sorted_values, gain = values[order], (weights * (2.0 * outcomes - 1.0))[order]
    # correct at threshold k: events from row k on, and non-events before it
    correct_weight = np.concatenate([[0.0], np.cumsum(-gain)]) + np.concatenate([np.cumsum(gain[::-1])[::-1], [0.0]])
    ends = np.concatenate([[-np.inf], 0.5 * (sorted_values[:-1] + sorted_values[1:]), [np.inf]])
    return float(ends[int(correct_weight.argmax())])


def calibration(probability: FloatArray, outcomes: FloatArray, weights: FloatArray) -> tuple[CalibrationBin, ...]:
    """Return the observed shares within bins of predicted probability; (n,) arrays, 1."""
    bins = []
    bin_index = np.clip(np.searchsorted(CALIBRATION_BINS, probability, side="right") - 1, 0, len(CALIBRATION_BINS) - 2)
    for k in range(len(CALIBRATION_BINS) - 1):
        in_bin: BoolArray = bin_index == k
        weight = float(weights[in_bin].sum())
        if weight == 0.0:
            continue
        share = float(weights[in_bin] @ outcomes[in_bin]) / weight
        count = max(round(weight), 1)
        interval = clopper_pearson(round(share * count), count)
        mean = float(weights[in_bin] @ probability[in_bin]) / weight
        bins.append(CalibrationBin(CALIBRATION_BINS[k], CALIBRATION_BINS[k + 1], int(in_bin.sum()), mean, share, interval))
    return tuple(bins)
