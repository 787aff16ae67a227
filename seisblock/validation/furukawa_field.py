"""Validation against a field survey: six overturning rates after the 2000 western Tottori earthquake, for each model of a stone.

Table 6 of [Furukawa2009]_ gives PGA and frequency of each station and the rate surveyed around it. Neither the records nor the stones are
available: a sine of 20 s with that PGA and frequency replaces each record, as in the paper's own study, and the stones of Aoyama,
reconstructed from the same table, replace those of each place. Verdicts under sines are chaotic: steps of 5 ms instead of 200 per period,
or 9.8 instead of 9.80665 m/s^2, change the rms of a model by up to 0.018 and its bias by up to 0.02.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial

import numpy as np

from seisblock.bodies.cemetery.cemetery import Cemetery
from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.bodies.edge_wear import SHARP_EDGES, EdgeWear
from seisblock.core.typing import FloatArray
from seisblock.studies.survey.limits import rigid_limits
from seisblock.studies.survey.overturning_rate import overturning_rate
from seisblock.studies.survey.simulation import simulated_overturns, sine_motion
from seisblock.validation.case import Case
from seisblock.validation.furukawa import SURVEYS, SurveyedRate

CHAOS_TOLERANCE = 0.02
"""Change of rms or bias with another step or another g."""

ROUNDING_TOLERANCE = 0.006
"""Rounding of the expected values, given to two digits."""

SURVEYED_RATES = np.array([survey.rate for survey in SURVEYS])
"""Surveyed rates in the order of the table, (6,)."""


@cache
def stones() -> Cemetery:
    """Return the stones that replace those of each place."""
    return read_cemetery("aoyama.csv")


def rate_by_fit(survey: SurveyedRate) -> float:
    """Return the rate by [Furukawa2009]_ eq. (9)."""
    return overturning_rate(stones(), survey.pga, survey.printed_frequency_hz).rate


def rate_by_pulse(survey: SurveyedRate) -> float:
    """Return the rate of rigid blocks with sharp edges under a half-sine pulse ([Housner1963]_)."""
    limits = partial(rigid_limits, inset=SHARP_EDGES)
    return overturning_rate(stones(), survey.pga, survey.printed_frequency_hz, limits=limits).rate


def rate_by_rocking(inset: EdgeWear, survey: SurveyedRate) -> float:
    """Return the rate of rigid blocks that rock under the sine ([Housner1963]_)."""
    return float(simulated_overturns(stones(), sine_motion(survey.pga, survey.printed_frequency_hz), inset=inset).mean())


@dataclass(frozen=True)
class FieldModel:
    """Model of a stone and its agreement with the survey.

    Parameters
    ----------
    key, name : str
    rate : callable
        Overturning rate of the model for a survey.
    rms, bias : float
        Of the rates minus the surveyed ones.
    tolerance : float
    quick : bool
        Whether the model takes only a moment.
    """

    key: str
    name: str
    rate: Callable[[SurveyedRate], float]
    rms: float
    bias: float
    tolerance: float
    quick: bool


MODELS = (
    FieldModel("eq-9", "criterion, eq. (9)", rate_by_fit, 0.143, -0.04, ROUNDING_TOLERANCE, True),
    FieldModel("worn", "rocking blocks with edges worn by 0.1 B per side (0.8 B)", partial(rate_by_rocking, EdgeWear(share=0.1)), 0.145, -0.01, CHAOS_TOLERANCE, False),
    FieldModel("sharp", "rocking blocks with sharp edges", partial(rate_by_rocking, SHARP_EDGES), 0.195, -0.11, CHAOS_TOLERANCE, False),
    FieldModel("half-sine", "blocks with sharp edges under a half-sine pulse", rate_by_pulse, 0.206, -0.13, ROUNDING_TOLERANCE, True),
    FieldModel("worn-more", "rocking blocks with edges worn by 0.15 B per side (0.7 B)", partial(rate_by_rocking, EdgeWear(share=0.15)), 0.267, 0.18,
               CHAOS_TOLERANCE, False),
)  # fmt: skip
"""Models, the closest to the survey first."""


@cache
def rates(key: str) -> FloatArray:
    """Return the rates of a model at the six stations, (6,)."""
    model = next(model for model in MODELS if model.key == key)
    return np.array([model.rate(survey) for survey in SURVEYS])


def rms(key: str) -> float:
    """Return the root mean square of a model's rates minus the surveyed ones."""
    return float(np.sqrt(np.mean((rates(key) - SURVEYED_RATES) ** 2)))


def bias(key: str) -> float:
    """Return the mean of a model's rates minus the surveyed ones."""
    return float(np.mean(rates(key) - SURVEYED_RATES))


def _cases(model: FieldModel) -> list[Case]:
    """Return rms and bias of a model against the survey."""
    note = "stones of Aoyama and sines instead of the stones and records of each place; 0 means perfect agreement"
    return [
        Case(
            f"furukawa-field-{model.key}-{name}",
            "[Furukawa2009]_ table 6",
            f"{name} of six overturning rates, Tottori 2000, minus surveyed ones: {model.name}",
            "1",
            expected,
            model.tolerance,
            partial(compute, model.key),
            kind="rebuilt",
            note=note,
            quick=model.quick,
        )
        for name, expected, compute in (("rms", model.rms, rms), ("bias", model.bias, bias))
    ]


CASES = tuple(case for model in MODELS for case in _cases(model))
"""All models against the survey."""
