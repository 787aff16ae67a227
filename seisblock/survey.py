"""Surveys after an earthquake: overturning rates of cemeteries, and ground motion estimated from fallen or displaced stones."""

from seisblock.studies.gravestone_criterion import CriterionStudy, criterion_study
from seisblock.studies.survey.assumptions import Assumptions
from seisblock.studies.survey.estimate import ShakingEstimate, estimate_shaking
from seisblock.studies.survey.likelihood import Survey, counted_survey, marked_survey
from seisblock.studies.survey.overturning_rate import OverturningRate, overturning_rate, rate_curve
from seisblock.studies.survey.scale_search import ScaleFactors, jump_displacement, scale_factors, slide_displacement

__all__ = [
    "Assumptions",
    "CriterionStudy",
    "OverturningRate",
    "ScaleFactors",
    "ShakingEstimate",
    "Survey",
    "counted_survey",
    "criterion_study",
    "estimate_shaking",
    "jump_displacement",
    "marked_survey",
    "overturning_rate",
    "rate_curve",
    "scale_factors",
    "slide_displacement",
]
