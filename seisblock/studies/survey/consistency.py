"""Consistency of a survey with the criterion, by the predictive distribution of its deviance."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.core import checks
from seisblock.core.i18n import Message, lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.studies.survey.assumptions import FREQUENCY_BAND, Assumptions
from seisblock.studies.survey.likelihood import Survey

MIN_PROBABILITY = 0.002
"""A survey of lower probability is inconsistent with the criterion."""

DRAWS = 4000
SEED = 1978


@dataclass(frozen=True)
class Consistency:
    """Fit of a survey to the criterion at the most likely PGA.

    Parameters
    ----------
    deviance : float
        -2 ln likelihood of the marked stones.
    probability : float
        Share of surveys drawn from the criterion and fitted in turn with a deviance at least as large.
    """

    deviance: float
    probability: float

    @property
    def is_inconsistent(self) -> bool:
        """True if the probability is below ``MIN_PROBABILITY``."""
        return self.probability < MIN_PROBABILITY


def check_consistency(survey: Survey, assumptions: Assumptions | None = None, *, seed: int = SEED) -> Consistency | None:
    """Return the fit of a survey of marked stones to the criterion, by the predictive distribution of its deviance.

    The limits of all stones scale alike with frequency ([Furukawa2009]_ eqs. (8), (9)), so one frequency serves. None for a count of
    stones, and if none or all fell: any such survey is consistent.
    """
    settings = assumptions or Assumptions()
    if survey.counts is not None or survey.fell in (0, survey.stone_count):
        return None
    limits = np.log(settings.limits(survey.rows, math.sqrt(FREQUENCY_BAND[0] * FREQUENCY_BAND[1])))
    fell, stood = survey.fallen.astype(np.float64), survey.standing.astype(np.float64)
    levels = np.linspace(limits.min() - 3.0, limits.max() + 3.0, 601)
    falls, stands = _log_probabilities(levels, limits, settings.stone_error)
    log_likelihoods = falls @ fell + stands @ stood
    observed = float(-2.0 * log_likelihoods.max())
    best = int(np.argmax(log_likelihoods))
    count = (survey.fallen + survey.standing).astype(np.int64)
    # posterior predictive: every simulated survey is fitted again, as the observed one was
    samples = np.random.default_rng(checks.seed(seed)).binomial(count, np.exp(falls[best]), (DRAWS, count.size))
    deviances = -2.0 * (falls @ samples.T + stands @ (count - samples).T).max(axis=0)
    return Consistency(observed, float(np.mean(deviances >= observed)))


def _log_probabilities(levels: FloatArray, limits: FloatArray, stone_error: float) -> tuple[FloatArray, FloatArray]:
    """Return the log probabilities of each stone falling and standing at each level, (levels, stones)."""
    from scipy.special import log_ndtr

    x = (levels[:, None] - limits[None, :]) / stone_error
    return log_ndtr(x), log_ndtr(-x)


def consistency_warning(name: str, survey: Survey, assumptions: Assumptions | None = None) -> Message | None:
    """Return a warning about a survey inconsistent with the criterion, else None."""
    result = check_consistency(survey, assumptions)
    if result is None or not result.is_inconsistent:
        return None
    ratios = survey.cemetery.ratios
    fell, stood = float(np.median(ratios[survey.fallen > 0])), float(np.median(ratios[survey.standing > 0]))
    return lazy_gettext(
        "{name}: survey inconsistent with the criterion at any PGA (probability below {chance:g}): median H/B {fell:.2f} of "
        "overturned stones, {stood:.2f} of standing ones; check the entries and other causes of overturning",
        name=name,
        chance=MIN_PROBABILITY,
        fell=fell,
        stood=stood,
    )
