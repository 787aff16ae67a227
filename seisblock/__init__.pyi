# Public names of the package, read by type checkers and, at run time, by lazy_loader.

from . import bodies, criteria, measures, models, readers, records, studies, validation
from .bodies.block import Block, from_slenderness
from .bodies.cemetery.cemetery import Cemetery, Stone
from .bodies.cemetery.table import read_cemetery
from .bodies.edge_wear import EdgeWear
from .bodies.factory import load_block
from .bodies.pile.contact import PileContact
from .bodies.pile.pile import Pile
from .bodies.pile.stone import PileStone
from .bodies.pile.toml import load_pile
from .bodies.scan.body import ScannedBody
from .bodies.scan.scan import Scan, scan_body
from .bodies.scan.toml import load_scan
from .bodies.sliding_base import SlidingBase
from .bodies.spring_block import SpringBlock
from .bodies.table import BodySpec, read_bodies
from .bodies.two_layer import Contact, TwoLayerBlock, load_contact, load_two_layer
from .bodies.uncertainty import ParameterRanges
from .core import errors, results, units
from .core.errors import (
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
from .core.results import Channel, Event, Phase, Response, Status
from .criteria.compare import overturning_card
from .measures.intensity import jma_class, jma_intensity
from .measures.spectra import ResponseSpectrum, response_spectrum
from .measures.summary import ComponentMeasures, Conventions, RecordMeasures, measure
from .models.jump.batch import jump_many
from .models.jump.batch_results import JumpBatchResult
from .models.jump.options import JumpOptions
from .models.jump.solve import JumpOutcome, solve_jump
from .models.respond.batch import RespondBatchResult, respond_many
from .models.respond.options import RespondOptions
from .models.respond.outcome import RespondOutcome
from .models.respond.params import RespondParams
from .models.respond.solve import respond_params, solve_respond
from .models.rock.options import RockOptions
from .models.rock.outcome import RockOutcome
from .models.rock.solve import solve_rock
from .models.rock.verdicts import Verdict, rock_verdict
from .models.slide.options import SlideOptions
from .models.slide.solve import SlideOutcome, solve_slide
from .models.stack.options import StackOptions
from .models.stack.outcome import StackOutcome
from .models.stack.solve import solve_stack
from .models.uplift.batch import uplift_many
from .models.uplift.batch_results import UpliftBatchResult
from .models.uplift.harmonic import uplift_thresholds
from .models.uplift.minima import UpliftMinimum, uplift_minima
from .models.uplift.modes import natural_modes
from .models.uplift.options import UpliftOptions
from .models.uplift.outcome import UpliftOutcome
from .models.uplift.solve import solve_uplift
from .readers.read import read, read_all
from .records.analytic import half_sine_motion, pulse_motion, rectangle_motion, sine_motion
from .records.floor_motion import Storey, floor_motion
from .records.motion import Motion, motion_of
from .records.preparation import Preparation
from .records.process import component_at_azimuth, crop, demean, highpass, rotate, scale, scale_to_pga
from .records.record import Component, Record
from .records.synthetic.suite import synthetic_suite
from .samples import Sample, list_samples, sample_path
from .studies.batch.run import run_batch
from .studies.batch.table import BatchTable
from .studies.fit.dataset import Observation
from .studies.fit.fit import BlockFit, fit_block
from .studies.fit.outcome_table import OutcomeTable, read_outcomes
from .studies.fragility.io import FragilityCurve, read_fragility
from .studies.fragility.lognormal import Lognormal, fit_fragility
from .studies.fragility.results import Fragility, FragilityStudy
from .studies.fragility.run import run_fragility
from .studies.gravestone_criterion import CriterionStudy, criterion_study
from .studies.hazard.curve import Hazard, HazardCurve
from .studies.hazard.risk import Risk, find_risk
from .studies.hazard.table import read_hazard
from .studies.map.station_response import StationBody, StationCemetery
from .studies.map.stations import StationReport, Stations, survey_stations
from .studies.respond.azimuths import RespondAzimuth, respond_directions
from .studies.respond.mode_map import ModeMap, mode_map
from .studies.respond.pile_probability import PileProbability, PileVariation, StoneProbability, stack_probability
from .studies.respond.probability import ParameterVariation, Probability, respond_probability
from .studies.rocking.azimuths import RockAzimuth, rock_directions
from .studies.rocking.margin import FactorRange, Margin, find_margin
from .studies.rocking.perturb import Perturbation, Spread, perturb
from .studies.rocking.spectrum import RockingSpectrum, rocking_spectrum, rocking_spectrum_all_azimuths
from .studies.sliding import SlidePoint, slide_study
from .studies.survey.assumptions import Assumptions
from .studies.survey.estimate import ShakingEstimate, estimate_shaking
from .studies.survey.likelihood import Survey, counted_survey, marked_survey
from .studies.survey.overturning_rate import OverturningRate, overturning_rate, rate_curve
from .studies.survey.scale_search import ScaleFactors, jump_displacement, scale_factors, slide_displacement

__version__: str

__all__ = [
    "Assumptions",
    "RespondAzimuth",
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
    "RespondBatchResult",
    "find_margin",
    "find_risk",
    "fit_fragility",
    "Fragility",
    "FragilityStudy",
    "fit_block",
    "from_slenderness",
    "FragilityCurve",
    "Hazard",
    "HazardCurve",
    "HazardError",
    "highpass",
    "InputError",
    "EdgeWear",
    "jma_class",
    "jma_intensity",
    "jump_many",
    "jump_displacement",
    "JumpBatchResult",
    "JumpOutcome",
    "KindError",
    "list_samples",
    "BodySpec",
    "load_block",
    "load_contact",
    "load_pile",
    "load_scan",
    "load_two_layer",
    "Lognormal",
    "respond_params",
    "Margin",
    "marked_survey",
    "half_sine_motion",
    "pulse_motion",
    "rectangle_motion",
    "sine_motion",
    "measure",
    "measures",
    "Motion",
    "mode_map",
    "ModeMap",
    "motion_of",
    "natural_modes",
    "Observation",
    "floor_motion",
    "OutcomeTable",
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
    "PileVariation",
    "Probability",
    "ParameterRanges",
    "OverturningRate",
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
    "rocking_spectrum_all_azimuths",
    "RockingSpectrum",
    "RespondOptions",
    "SlideOptions",
    "JumpOptions",
    "UpliftOptions",
    "StackOptions",
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
    "Scan",
    "ScannedBody",
    "SeisblockError",
    "RespondParams",
    "ShakingEstimate",
    "slide_displacement",
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
    "models",
    "Spread",
    "SpringBlock",
    "stack_probability",
    "StackOutcome",
    "StationBody",
    "StationCemetery",
    "StationReport",
    "Stations",
    "Status",
    "Stone",
    "StoneProbability",
    "Storey",
    "studies",
    "Survey",
    "survey_stations",
    "synthetic_suite",
    "component_at_azimuth",
    "TwoLayerBlock",
    "UnitError",
    "units",
    "uplift_many",
    "uplift_minima",
    "uplift_thresholds",
    "UpliftBatchResult",
    "UpliftMinimum",
    "UpliftOutcome",
    "validation",
    "Verdict",
    "ParameterVariation",
]
