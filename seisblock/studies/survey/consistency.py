"""Whether a survey can be what it says: stones that fell and stood as the criterion would have it, or quite otherwise."""

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
"""Below this probability a survey is not what the criterion could bring about."""

DRAWS = 4000
SEED = 1978


@dataclass(frozen=True)
class Consistency:
    """How a survey fits the criterion at the PGA that suits it best.

    Parameters
    ----------
    deviance : float
        -2 ln likelihood of the stones, each by itself.
    probability : float
        Share of surveys drawn from the criterion, fitted again, whose deviance is as large.
    """

    deviance: float
    probability: float

    @property
    def is_inconsistent(self) -> bool:
        """Whether the criterion could not bring it about."""
        return self.probability < MIN_PROBABILITY


def check_consistency(survey: Survey, assumptions: Assumptions | None = None, *, seed: int = SEED) -> Consistency | None:
    """Return how well a survey of marked stones fits the criterion, by the predictive distribution of its deviance.

    The limits of all stones change alike with frequency ([Furukawa2009]_ eqs. (8), (9)), so one frequency serves. None where
    stones were only counted, or none or all fell: any such survey can be.
    """
    settings = assumptions or Assumptions()
    if survey.counts is not None or survey.fell in (0, survey.stone_count):
        return None
    limits = np.log(settings.limits(survey.rows, math.sqrt(FREQUENCY_BAND[0] * FREQUENCY_BAND[1])))
    fallen, standing = survey.fallen.astype(np.float64), survey.standing.astype(np.float64)
    levels = np.linspace(limits.min() - 3.0, limits.max() + 3.0, 601)
    falls, stands = _log_probabilities(levels, limits, settings.stone_error)
    observed = float(-2.0 * (falls @ fallen + stands @ standing).max())
    best = int(np.argmax(falls @ fallen + stands @ standing))
    count = (survey.fallen + survey.standing).astype(np.int64)
    samples = np.random.default_rng(checks.seed(seed)).binomial(count, np.exp(falls[best]), (DRAWS, count.size))
    deviances = -2.0 * (falls @ samples.T + stands @ (count - samples).T).max(axis=0)
    return Consistency(observed, float(np.mean(deviances >= observed)))


def _log_probabilities(levels: FloatArray, limits: FloatArray, stone_error: float) -> tuple[FloatArray, FloatArray]:
    """Return the logarithms of each stone's chance to fall and to stand at each level, (levels, stones)."""
    from scipy.special import log_ndtr

    x = (levels[:, None] - limits[None, :]) / stone_error
    return log_ndtr(x), log_ndtr(-x)


def consistency_warning(name: str, survey: Survey, assumptions: Assumptions | None = None) -> Message | None:
    """Return a sentence that names a survey which the criterion could not bring about, else None."""
    result = check_consistency(survey, assumptions)
    if result is None or not result.is_inconsistent:
        return None
    ratios = survey.cemetery.ratios
    fell, stood = float(np.median(ratios[survey.fallen > 0])), float(np.median(ratios[survey.standing > 0]))
    return lazy_gettext(
        "{name}: no shaking of the ground explains this survey (probability below {chance:g}): the stones that fell have a median H/B of "
        "{fell:.2f}, those that stand of {stood:.2f}; are the marks exchanged, or was it not the shaking?",
        name=name,
        chance=MIN_PROBABILITY,
        fell=fell,
        stood=stood,
    )
