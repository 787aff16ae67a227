"""What an estimate of shaking rests on: the criterion, its bias and scatter, the frequency's, and the level of the intervals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from seisblock.bodies.cemetery.cemetery import PAPER_WIDTH
from seisblock.bodies.edge_wear import EdgeWear
from seisblock.core import checks
from seisblock.core.typing import FloatArray
from seisblock.studies.survey.likelihood import (
    BIAS,
    COMMON_ERROR,
    KNOWN_WEAR_ERROR,
    SHARP_BIAS,
    STONE_ERROR,
    WEAR_BIAS_SLOPE,
    Likelihood,
    Survey,
    likelihood,
)
from seisblock.studies.survey.limits import Limits, fitted_limits

DEFAULT_LEVEL = 0.9
"""Default level of the intervals."""

FREQUENCY_BAND = (0.5, 3.0)
"""Equivalent frequencies, Hz, over which a survey is averaged where none is given: the range of the fit ([Furukawa2009]_)."""

BAND_STEPS = 26
"""Frequencies in that band, evenly spaced in ln f."""

FREQUENCY_ERROR = 0.1
"""Default standard deviation of a given equivalent frequency, in ln f: what filters and definitions differ by."""

FREQUENCY_SIGMAS, FREQUENCY_STEPS = 2.5, 11
"""A given frequency is averaged over so many standard deviations to each side, in so many steps."""


@dataclass(frozen=True)
class Assumptions:
    """What an estimate rests on.

    Parameters
    ----------
    common_error, stone_error : float
        Standard deviations in ln PGA, of a cemetery and of each stone.
    level : float
        Of the intervals, between 0 and 1.
    limits : callable
        The criterion.
    bias : float
        How much more PGA than the criterion's the ground must have, in ln PGA; see :mod:`seisblock.studies.survey.likelihood`.
    frequency_error : float
        Standard deviation of a given equivalent frequency, in ln f.
    """

    common_error: float = COMMON_ERROR
    stone_error: float = STONE_ERROR
    level: float = DEFAULT_LEVEL
    limits: Limits = fitted_limits
    bias: float = BIAS
    frequency_error: float = FREQUENCY_ERROR

    def __post_init__(self) -> None:
        checks.in_interval("the level of the intervals", self.level, "(0, 1)")
        checks.non_negative("the error of the frequency, in ln f,", self.frequency_error)

    def frequency_band(self, frequency: float | None) -> tuple[list[float], FloatArray]:
        """Return the frequencies that stand for a given one, or for the whole band, Hz, and the weight of each, (n,)."""
        if frequency is None:
            return np.geomspace(*FREQUENCY_BAND, BAND_STEPS).tolist(), np.full(BAND_STEPS, 1.0 / BAND_STEPS)
        if self.frequency_error == 0.0:
            return [frequency], np.ones(1)
        steps = np.linspace(-FREQUENCY_SIGMAS, FREQUENCY_SIGMAS, FREQUENCY_STEPS)
        weights = np.exp(-0.5 * steps**2)
        return (frequency * np.exp(self.frequency_error * steps)).tolist(), weights / weights.sum()

    def likelihoods(self, survey: Survey, frequencies: Sequence[float]) -> list[Likelihood]:
        """Return the likelihood of a survey at each frequency."""
        return [
            likelihood(survey, f, common_error=self.common_error, stone_error=self.stone_error, bias=self.bias, limits=self.limits)
            for f in frequencies
        ]


def make_assumptions(edges: EdgeWear | None, **overrides: Any) -> Assumptions:
    """Return the assumptions for stones whose worn edges are known: their bias, and less scatter ([Furukawa2009]_ eq. (9)).

    Parameters
    ----------
    edges : Inset or None
        How far in from each side the stones' edges lie; None: anything from sharp to 0.1 of the width.
    overrides
        Fields of :class:`Assumptions`; None where not given.
    """
    values = {name: value for name, value in overrides.items() if value is not None}
    if edges is not None:
        share = edges.inset(PAPER_WIDTH) / PAPER_WIDTH
        values = {"bias": SHARP_BIAS + WEAR_BIAS_SLOPE * share, "common_error": KNOWN_WEAR_ERROR, **values}
    return Assumptions(**values)
