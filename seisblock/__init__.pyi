# The public names: what a user's script imports from seisblock, read by type checkers and, at run time, by lazy_loader.

from . import bodies, criteria, errors, measures, readers, records, results, solvers, studies, units, validation
from .bodies.block import Block, from_slenderness
from .bodies.cemetery.cemetery import Cemetery, Stone
from .bodies.cemetery.table import read_cemetery
from .bodies.inset import Inset
from .bodies.library import load_block
from .bodies.pile.contact import PileContact
from .bodies.pile.pile import Pile
from .bodies.pile.stone import PileStone
from .bodies.pile.toml import load_pile
from .bodies.ranges import Ranges
from .bodies.roster import ListedBody, read_bodies
from .bodies.scan.body import ScannedBody
from .bodies.scan.scan import Scanned, scan_body
from .bodies.scan.toml import load_scan
from .bodies.sliding_base import SlidingBase
from .bodies.spring_block import SpringBlock
from .bodies.two_layer import Contact, TwoLayerBlock, load_contact, load_two_layer
from .criteria.card import overturning_card
from .errors import (
    BodyError,
    ComponentError,
    HazardError,
    InputError,
    KindError,
    OutputError,
    ParameterError,
    RecordError,
    RecordFormatError,
    RecordNotFoundError,
    SeisblockError,
    SolverError,
    UnitError,
)
from .measures.intensity import jma_class, jma_intensity
from .measures.spectra import ResponseSpectrum, response_spectrum
from .measures.summary import ComponentMeasures, Conventions, RecordMeasures, measure
from .readers.read import read, read_all
from .records.motion import Motion, motion_of
from .records.preparation import Preparation
from .records.process import crop, demean, highpass, rotate, scale, scale_to_pga, towards
from .records.record import Component, Record
from .records.storey import Storey, on_storey
from .records.synthetic.suite import synthetic_suite
from .results import Channel, Event, Phase, Response, Status
from .samples import Sample, list_samples, sample_path
from .solvers.jump.fates import JumpFates
from .solvers.jump.many import jump_many
from .solvers.jump.solve import JumpOutcome, solve_jump
from .solvers.respond.many import Fates, respond_many
from .solvers.respond.outcome import RespondOutcome
from .solvers.respond.setting import Setting
from .solvers.respond.solve import make_setting, solve_respond
from .solvers.rock.outcome import RockOutcome
from .solvers.rock.rocker import RockOptions
from .solvers.rock.solve import solve_rock
from .solvers.rock.verdicts import Verdict, rock_verdict
from .solvers.slide.solve import SlideOutcome, solve_slide
from .solvers.stack.outcome import StackOutcome
from .solvers.stack.solve import solve_stack
from .solvers.uplift.fates import UpliftFates
from .solvers.uplift.harmonic import uplift_thresholds
from .solvers.uplift.many import uplift_many
from .solvers.uplift.minima import UpliftMinimum, uplift_minima
from .solvers.uplift.modes import natural_modes
from .solvers.uplift.outcome import UpliftOutcome
from .solvers.uplift.solve import solve_uplift
from .studies.batch.run import run_batch
from .studies.batch.table import BatchTable
from .studies.cemetery.rate import Rate, overturning_rate, rate_curve
from .studies.fit.experiment import Observed
from .studies.fit.fit import BlockFit, fit_block
from .studies.fit.table import Outcomes, read_outcomes
from .studies.fragility.answer import Fragility, FragilityStudy
from .studies.fragility.lognormal import Lognormal, fit_fragility
from .studies.fragility.run import run_fragility
from .studies.gravestone_criterion import CriterionStudy, criterion_study
from .studies.hazard.curve import Hazard, HazardCurve
from .studies.hazard.given import GivenFragility, read_fragility
from .studies.hazard.risk import Risk, find_risk
from .studies.hazard.table import read_hazard
from .studies.inverse.assumptions import Assumptions
from .studies.inverse.estimate import ShakingEstimate, estimate_shaking
from .studies.inverse.factors import ScaleFactors, jumped, scale_factors, slid
from .studies.inverse.survey import Survey, counted_survey, marked_survey
from .studies.rocking.azimuths import RockAzimuth, rock_directions
from .studies.rocking.margin import FactorRange, Margin, find_margin
from .studies.rocking.perturb import Perturbation, Spread, perturb
from .studies.rocking.spectra import RockingSpectrum, rocking_spectrum, rocking_spectrum_around
from .studies.sliding import SlidePoint, slide_study
from .studies.standing.azimuths import AzimuthFate, respond_directions
from .studies.standing.mode_map import ModeMap, mode_map
from .studies.standing.pile_probability import PileProbability, PileVersions, StoneChance, stack_probability
from .studies.standing.probability import Probability, Versions, respond_probability
from .studies.stations.effects import StandingBody, StandingStones
from .studies.stations.survey import StationAnswer, Stations, survey_stations

__version__: str

__all__ = [
    "Assumptions",
    "AzimuthFate",
    "BatchTable",
    "Block",
    "BlockFit",
    "bodies",
    "BodyError",
    "Cemetery",
    "Channel",
    "Component",
    "ComponentError",
    "ComponentMeasures",
    "Contact",
    "Conventions",
    "counted_survey",
    "criteria",
    "criterion_study",
    "CriterionStudy",
    "crop",
    "demean",
    "errors",
    "estimate_shaking",
    "Event",
    "FactorRange",
    "Fates",
    "find_margin",
    "find_risk",
    "fit_fragility",
    "Fragility",
    "FragilityStudy",
    "fit_block",
    "from_slenderness",
    "GivenFragility",
    "Hazard",
    "HazardCurve",
    "HazardError",
    "highpass",
    "InputError",
    "Inset",
    "jma_class",
    "jma_intensity",
    "jump_many",
    "jumped",
    "JumpFates",
    "JumpOutcome",
    "KindError",
    "list_samples",
    "ListedBody",
    "load_block",
    "load_contact",
    "load_pile",
    "load_scan",
    "load_two_layer",
    "Lognormal",
    "make_setting",
    "Margin",
    "marked_survey",
    "measure",
    "measures",
    "Motion",
    "mode_map",
    "ModeMap",
    "motion_of",
    "natural_modes",
    "Observed",
    "on_storey",
    "Outcomes",
    "OutputError",
    "overturning_card",
    "overturning_rate",
    "ParameterError",
    "perturb",
    "Perturbation",
    "Phase",
    "Pile",
    "PileContact",
    "PileProbability",
    "PileStone",
    "PileVersions",
    "Probability",
    "Ranges",
    "Rate",
    "rate_curve",
    "read",
    "read_all",
    "read_bodies",
    "read_cemetery",
    "read_fragility",
    "read_hazard",
    "read_outcomes",
    "readers",
    "Preparation",
    "Record",
    "RecordError",
    "RecordFormatError",
    "RecordMeasures",
    "RecordNotFoundError",
    "records",
    "respond_directions",
    "respond_many",
    "respond_probability",
    "RespondOutcome",
    "Response",
    "response_spectrum",
    "ResponseSpectrum",
    "results",
    "Risk",
    "rock_directions",
    "rock_verdict",
    "RockAzimuth",
    "rocking_spectrum",
    "rocking_spectrum_around",
    "RockingSpectrum",
    "RockOptions",
    "RockOutcome",
    "rotate",
    "run_batch",
    "run_fragility",
    "Sample",
    "sample_path",
    "scale",
    "scale_factors",
    "scale_to_pga",
    "ScaleFactors",
    "scan_body",
    "Scanned",
    "ScannedBody",
    "SeisblockError",
    "Setting",
    "ShakingEstimate",
    "slid",
    "slide_study",
    "SlideOutcome",
    "SlidePoint",
    "SlidingBase",
    "solve_jump",
    "solve_respond",
    "solve_rock",
    "solve_slide",
    "solve_stack",
    "solve_uplift",
    "SolverError",
    "solvers",
    "Spread",
    "SpringBlock",
    "stack_probability",
    "StackOutcome",
    "StandingBody",
    "StandingStones",
    "StationAnswer",
    "Stations",
    "Status",
    "Stone",
    "StoneChance",
    "Storey",
    "studies",
    "Survey",
    "survey_stations",
    "synthetic_suite",
    "towards",
    "TwoLayerBlock",
    "UnitError",
    "units",
    "uplift_many",
    "uplift_minima",
    "uplift_thresholds",
    "UpliftFates",
    "UpliftMinimum",
    "UpliftOutcome",
    "validation",
    "Verdict",
    "Versions",
]
