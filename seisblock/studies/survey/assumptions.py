"""Assumptions of a shaking estimate: criterion, bias, scatter, error of the frequency, and level of the intervals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from seisblock.bodies.cemetery.cemetery import PAPER_WIDTH
from seisblock.bodies.edge_wear import EdgeWear
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
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
"""Equivalent frequencies, Hz, averaged for a survey without a frequency: the range of the fit ([Furukawa2009]_)."""

BAND_STEPS = 26
"""Frequencies in that band, evenly spaced in ln f."""

FREQUENCY_ERROR = 0.1
"""Default standard deviation of a given equivalent frequency, in ln f: the difference between filters and definitions."""

FREQUENCY_SIGMAS, FREQUENCY_STEPS = 2.5, 11
"""Standard deviations to each side, and steps, of the average over a given frequency."""


@dataclass(frozen=True, repr=False)
class Assumptions(DisplayMixin):
    """Assumptions of a shaking estimate.

    Parameters
    ----------
    common_error, stone_error : float
        Standard deviations in ln PGA, of a cemetery and of each stone.
    level : float
        Level of the intervals, between 0 and 1.
    limits : callable
        The criterion.
    bias : float
        Excess of the PGA of the ground over that of the criterion, in ln PGA; see :mod:`seisblock.studies.survey.likelihood`.
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
        checks.non_negative("`frequency_error`, in ln f,", self.frequency_error)

    def frequency_band(self, frequency: float | None) -> tuple[list[float], FloatArray]:
        """Return the frequencies, Hz, that represent a given one, or the whole band, and their weights, (n,)."""
        if frequency is None:
            return np.geomspace(*FREQUENCY_BAND, BAND_STEPS).tolist(), np.full(BAND_STEPS, 1.0 / BAND_STEPS)
        if self.frequency_error == 0.0:
            return [frequency], np.ones(1)
        steps = np.linspace(-FREQUENCY_SIGMAS, FREQUENCY_SIGMAS, FREQUENCY_STEPS)
        # normal weights over ln f
        weights = np.exp(-0.5 * steps**2)
        return (frequency * np.exp(self.frequency_error * steps)).tolist(), weights / weights.sum()

    def likelihoods(self, survey: Survey, frequencies: Sequence[float]) -> list[Likelihood]:
        """Return the likelihood of a survey at each frequency."""
        return [
            likelihood(survey, f, common_error=self.common_error, stone_error=self.stone_error, bias=self.bias, limits=self.limits)
            for f in frequencies
        ]


def make_assumptions(edges: EdgeWear | None, **overrides: Any) -> Assumptions:
    """Return the assumptions for stones of known edge wear: their bias, and a smaller scatter ([Furukawa2009]_ eq. (9)).

    Parameters
    ----------
    edges : EdgeWear or None
        Edge wear per side; None: anything from sharp to 0.1 of the width.
    overrides
        Fields of :class:`Assumptions`; None for the default.
    """
    values = {name: value for name, value in overrides.items() if value is not None}
    if edges is not None:
        share = edges.inset(PAPER_WIDTH) / PAPER_WIDTH
        values = {"bias": SHARP_BIAS + WEAR_BIAS_SLOPE * share, "common_error": KNOWN_WEAR_ERROR, **values}
    return Assumptions(**values)
