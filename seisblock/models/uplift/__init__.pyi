from .batch import uplift_many
from .batch_results import UpliftBatchResult
from .harmonic import uplift_thresholds
from .minima import UpliftMinimum, uplift_minima
from .modes import Modes, natural_modes
from .outcome import CornerOutcome, UpliftOutcome
from .solve import solve_uplift

__all__ = [
    "CornerOutcome",
    "Modes",
    "UpliftBatchResult",
    "UpliftMinimum",
    "UpliftOutcome",
    "natural_modes",
    "solve_uplift",
    "uplift_many",
    "uplift_minima",
    "uplift_thresholds",
]
