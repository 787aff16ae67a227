"""Fragility curves of bodies, seismic hazard, and annual frequencies of a limit state."""

from seisblock.studies.fragility.io import FragilityCurve, read_fragility
from seisblock.studies.fragility.lognormal import Lognormal, fit_fragility
from seisblock.studies.fragility.results import Fragility, FragilityStudy
from seisblock.studies.fragility.run import run_fragility
from seisblock.studies.hazard.curve import Hazard, HazardCurve
from seisblock.studies.hazard.risk import Risk, find_risk
from seisblock.studies.hazard.table import read_hazard

__all__ = [
    "Fragility",
    "FragilityCurve",
    "FragilityStudy",
    "Hazard",
    "HazardCurve",
    "Lognormal",
    "Risk",
    "find_risk",
    "fit_fragility",
    "read_fragility",
    "read_hazard",
    "run_fragility",
]
