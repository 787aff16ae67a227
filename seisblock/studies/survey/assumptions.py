"""Assumptions of a shaking estimate: criterion, bias, scatter, error of the frequency, and level of the intervals."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from seisblock.bodies.edge_wear import EdgeWear
from seisblock.bodies.table import PAPER_WIDTH
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.typing import FloatArray
from seisblock.criteria.gravestones import overturning_level
from seisblock.studies.survey.likelihood import (
    BIAS,
    COMMON_ERROR,
    INTENSITY_CONSTANT,
    INTENSITY_ERROR,
    INTENSITY_PER_LN,
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
    intensity_constant : float or None, 1
        JMA intensity at which a stone of H/B = 1 falls; None: the intensity follows from PGV ([Midorikawa1999]_).
    intensity_error : float, 1
        Standard deviation of the intensity, of a cemetery.
    """

    common_error: float = COMMON_ERROR
    stone_error: float = STONE_ERROR
    level: float = DEFAULT_LEVEL
    limits: Limits = fitted_limits
    bias: float = BIAS
    frequency_error: float = FREQUENCY_ERROR
    intensity_constant: float | None = INTENSITY_CONSTANT
    intensity_error: float = INTENSITY_ERROR

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

    def intensity_likelihood(self, survey: Survey) -> Likelihood:
        """Return the likelihood of a survey over the logarithm of the amplitude, JMA intensity / :data:`INTENSITY_PER_LN`.

        The frequency cancels: the limits of all stones scale alike with it.
        """
        frequency = math.sqrt(FREQUENCY_BAND[0] * FREQUENCY_BAND[1])
        constant = INTENSITY_CONSTANT if self.intensity_constant is None else self.intensity_constant
        bias = constant / INTENSITY_PER_LN - math.log(float(overturning_level(frequency)))
        error = self.intensity_error / INTENSITY_PER_LN
        return likelihood(survey, frequency, common_error=error, stone_error=self.stone_error, bias=bias, limits=self.limits)

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
    if "limits" in values:
        # the constant belongs to the fitted criterion
        values["intensity_constant"] = None
    if edges is not None:
        share = edges.inset(PAPER_WIDTH) / PAPER_WIDTH
        known_bias = SHARP_BIAS + WEAR_BIAS_SLOPE * share
        constant = INTENSITY_CONSTANT + INTENSITY_PER_LN * (known_bias - BIAS)
        values = {"bias": known_bias, "common_error": KNOWN_WEAR_ERROR, "intensity_constant": constant, **values}
    return Assumptions(**values)
