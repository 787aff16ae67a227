from .batch.run import run_batch
from .batch.table import BatchTable
from .fit.dataset import Observation
from .fit.fit import BlockFit, fit_block
from .fit.outcome_table import OutcomeTable, read_outcomes
from .map.station_response import StationBody, StationCemetery
from .map.stations import StationReport, Stations, survey_stations
from .respond.azimuths import RespondAzimuth, respond_directions
from .respond.mode_map import ModeMap, mode_map
from .rocking.azimuths import RockAzimuth, rock_directions
from .rocking.margin import FactorRange, Margin, find_margin
from .rocking.spectrum import RockingSpectrum, rocking_spectrum, rocking_spectrum_all_azimuths
from .sliding import SlidePoint, slide_study

__all__ = [
    "BatchTable",
    "BlockFit",
    "FactorRange",
    "find_margin",
    "fit_block",
    "Margin",
    "mode_map",
    "ModeMap",
    "Observation",
    "OutcomeTable",
    "read_outcomes",
    "respond_directions",
    "RespondAzimuth",
    "rock_directions",
    "RockAzimuth",
    "rocking_spectrum",
    "rocking_spectrum_all_azimuths",
    "RockingSpectrum",
    "run_batch",
    "slide_study",
    "SlidePoint",
    "StationBody",
    "StationCemetery",
    "StationReport",
    "Stations",
    "survey_stations",
]
