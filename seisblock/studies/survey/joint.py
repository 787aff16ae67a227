"""Joint estimate of one shaking from several cemeteries, with a test of their agreement."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from seisblock.core.errors import ParameterError
from seisblock.core.i18n import Message, lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.studies.survey.assumptions import Assumptions
from seisblock.studies.survey.estimate import Interval, ShakingEstimate, estimate_shaking, posterior_quantiles
from seisblock.studies.survey.likelihood import Survey

MIN_AGREEMENT = 0.01
"""Cemeteries contradict each other if differences as large have a lower probability under one shaking."""


@dataclass(frozen=True)
class JointEstimate:
    """Estimate of one shaking from several cemeteries with independent errors ([Furukawa2009]_ eqs. (9), (10)).

    Parameters
    ----------
    names : tuple of str
    frequency_hz : float or None
    pga_m_s2, pga_interval_m_s2 : float, two of them
        Joint estimate.
    apart : tuple of ShakingEstimate
        Separate estimates.
    agreement : float
        Probability of differences at least as large under one shaking; 1 for a single cemetery.
    contradicts : tuple of (str, str)
        Pairs with disjoint intervals, if the agreement is below 0.01.
    """

    names: tuple[str, ...]
    frequency_hz: float | None
    pga_m_s2: float
    pga_interval_m_s2: Interval
    apart: tuple[ShakingEstimate, ...]
    agreement: float
    contradicts: tuple[tuple[str, str], ...]


def joint_estimate(
    surveys: Sequence[tuple[str, Survey]], frequency: float | None = None, assumptions: Assumptions | None = None
) -> JointEstimate:
    """Return the estimate of one PGA from several cemeteries: the product of their likelihoods with independent common errors.

    Parameters
    ----------
    surveys : sequence of (name, Survey)
        At least one; at least one stone fell in one of them, and one stood.
    frequency : float or None, Hz
    assumptions : Assumptions

    Raises
    ------
    ParameterError
        If there is no survey, or no stone, or every stone, fell in all of them.
    """
    settings = assumptions or Assumptions()
    if not surveys:
        raise ParameterError("an estimate requires at least one survey")
    fell, stone_count = sum(survey.fell for _, survey in surveys), sum(survey.stone_count for _, survey in surveys)
    if fell in (0, stone_count):
        raise ParameterError(
            "{fell} of {judged} stones overturned in all cemeteries together: no joint estimate, since the shaking is bounded on "
            "one side only; add a cemetery with overturned and standing stones",
            fell=fell,
            judged=stone_count,
        )
    band, weights = settings.frequency_band(frequency)
    grid = np.arange(math.log(0.02), math.log(200.0), settings.common_error / 40.0)
    # errors are independent at one frequency; the frequency is common, so the product is averaged over it
    total, single = np.zeros(grid.size), np.zeros((len(surveys), grid.size))
    for f, weight in zip(band, weights, strict=True):
        # each likelihood is scaled to a maximum of 1, against underflow of the product
        values = np.array([part.interpolate(grid) for _, survey in surveys for part in settings.likelihoods(survey, [f])])
        total += weight * np.prod(values / values.max(axis=1, keepdims=True), axis=0)
        single += weight * values
    low, middle, high = posterior_quantiles(grid, total, settings.level)
    apart = tuple(estimate_shaking(survey, frequency, settings) for _, survey in surveys)
    agreement = _agreement(single / single.max(axis=1, keepdims=True))
    names = [name for name, _ in surveys]
    pairs = [
        (names[i], names[j])
        for i, j in itertools.combinations(range(len(names)), 2)
        if agreement < MIN_AGREEMENT and not _intervals_overlap(apart[i].pga_interval_m_s2, apart[j].pga_interval_m_s2)
    ]
    return JointEstimate(tuple(names), frequency, middle, (low, high), apart, agreement, tuple(pairs))


def _agreement(values: FloatArray) -> float:
    """Return the probability of a likelihood ratio as large: one shaking against one per cemetery (chi-squared, Wilks)."""
    from scipy.special import chdtrc

    if values.shape[0] == 1:
        return 1.0
    with np.errstate(divide="ignore"):
        joint_log_likelihood = np.log(values).sum(axis=0)
    return float(chdtrc(values.shape[0] - 1, -2.0 * float(joint_log_likelihood.max())))


def _intervals_overlap(first: Interval, second: Interval) -> bool:
    """Return True if two intervals, or bounds, overlap."""
    low = max(-math.inf if end is None else end for end in (first[0], second[0]))
    high = min(math.inf if end is None else end for end in (first[1], second[1]))
    return low <= high


def joint_warnings(estimate: JointEstimate) -> list[Message]:
    """Return a warning for each pair of contradicting cemeteries."""
    return [
        lazy_gettext(
            "{first} and {second} contradict each other (probability of such a difference under one shaking {chance:.2g}); check the "
            "ground and the setting of the stones",
            first=first,
            second=second,
            chance=estimate.agreement,
        )
        for first, second in estimate.contradicts
    ]
