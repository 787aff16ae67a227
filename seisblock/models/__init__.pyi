from .jump.batch import JumpBatchResult, jump_many
from .jump.options import JumpOptions
from .jump.solve import JumpOutcome, solve_jump
from .respond.batch import RespondBatchResult, respond_many
from .respond.options import RespondOptions
from .respond.outcome import RespondOutcome
from .respond.params import RespondParams
from .respond.solve import respond_params, solve_respond
from .rigid3d.options import Rigid3dOptions
from .rigid3d.outcome import Rigid3dOutcome
from .rigid3d.solve import solve_rigid3d
from .rock.options import RockOptions
from .rock.outcome import RockOutcome
from .rock.solve import solve_rock
from .rock.verdicts import Verdict, rock_verdict
from .slide.options import SlideOptions
from .slide.solve import SlideOutcome, solve_slide
from .stack.options import StackOptions
from .stack.outcome import StackOutcome
from .stack.solve import solve_stack
from .uplift.batch import uplift_many
from .uplift.batch_results import UpliftBatchResult
from .uplift.harmonic import uplift_thresholds
from .uplift.minima import UpliftMinimum, uplift_minima
from .uplift.modes import natural_modes
from .uplift.options import UpliftOptions
from .uplift.outcome import UpliftOutcome
from .uplift.solve import solve_uplift

__all__ = [
    "jump_many",
    "JumpBatchResult",
    "JumpOptions",
    "JumpOutcome",
    "natural_modes",
    "respond_many",
    "respond_params",
    "RespondBatchResult",
    "RespondOptions",
    "RespondOutcome",
    "RespondParams",
    "rock_verdict",
    "Rigid3dOptions",
    "Rigid3dOutcome",
    "RockOptions",
    "RockOutcome",
    "SlideOptions",
    "SlideOutcome",
    "solve_jump",
    "solve_respond",
    "solve_rigid3d",
    "solve_rock",
    "solve_slide",
    "solve_stack",
    "solve_uplift",
    "StackOptions",
    "StackOutcome",
    "uplift_many",
    "uplift_minima",
    "uplift_thresholds",
    "UpliftBatchResult",
    "UpliftMinimum",
    "UpliftOptions",
    "UpliftOutcome",
    "Verdict",
]
