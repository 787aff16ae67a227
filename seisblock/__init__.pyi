# Public names of the package, read by type checkers and, at run time, by lazy_loader.

from . import bodies, criteria, errors, fragility, measures, models, readers, records, samples, studies, survey, uncertainty, units
from .bodies.block import Block
from .bodies.cemetery.table import read_cemetery
from .bodies.convex import ConvexBody
from .bodies.factory import load_block
from .bodies.pile.pile import Pile
from .bodies.pile.stone import PileStone
from .bodies.pile.toml import load_pile
from .bodies.scan.toml import load_scan
from .bodies.sliding_base import SlidingBase
from .bodies.spring_block import SpringBlock
from .bodies.two_layer import Contact, TwoLayerBlock, load_contact, load_two_layer
from .core.errors import InputError, SeisblockError, SolverError
from .core.results import Channel, Event, Phase, Response, Status
from .measures.summary import measure
from .models.jump.options import JumpOptions
from .models.jump.solve import solve_jump
from .models.respond.options import RespondOptions
from .models.respond.solve import solve_respond
from .models.rigid3d.solve import solve_rigid3d
from .models.rock.options import RockOptions
from .models.rock.solve import solve_rock
from .models.slide.options import SlideOptions
from .models.slide.solve import solve_slide
from .models.stack.options import StackOptions
from .models.stack.solve import solve_stack
from .models.uplift.options import UpliftOptions
from .models.uplift.solve import solve_uplift
from .readers.read import read
from .records.analytic import half_sine_motion, pulse_motion, rectangle_motion, sine_motion
from .records.motion import Motion, motion_of
from .records.record import Record
from .studies.assessment import Assessment, assess
from .studies.batch.run import run_batch

__version__: str

__all__ = [
    "assess",
    "Assessment",
    "Block",
    "bodies",
    "Channel",
    "Contact",
    "ConvexBody",
    "criteria",
    "errors",
    "Event",
    "fragility",
    "InputError",
    "JumpOptions",
    "load_block",
    "load_contact",
    "load_pile",
    "load_scan",
    "load_two_layer",
    "half_sine_motion",
    "pulse_motion",
    "rectangle_motion",
    "sine_motion",
    "measure",
    "measures",
    "models",
    "Motion",
    "motion_of",
    "Phase",
    "Pile",
    "PileStone",
    "read",
    "read_cemetery",
    "readers",
    "Record",
    "records",
    "RespondOptions",
    "Response",
    "RockOptions",
    "run_batch",
    "samples",
    "SeisblockError",
    "SlideOptions",
    "SlidingBase",
    "solve_jump",
    "solve_respond",
    "solve_rigid3d",
    "solve_rock",
    "solve_slide",
    "solve_stack",
    "solve_uplift",
    "SolverError",
    "SpringBlock",
    "StackOptions",
    "Status",
    "studies",
    "survey",
    "TwoLayerBlock",
    "uncertainty",
    "units",
    "UpliftOptions",
]
