from .fates import UpliftFates
from .harmonic import uplift_thresholds
from .many import uplift_many
from .minima import UpliftMinimum, uplift_minima
from .modes import Modes, natural_modes
from .outcome import CornerOutcome, UpliftOutcome
from .solve import solve_uplift

__all__ = [
    "CornerOutcome",
    "Modes",
    "UpliftFates",
    "UpliftMinimum",
    "UpliftOutcome",
    "natural_modes",
    "solve_uplift",
    "uplift_many",
    "uplift_minima",
    "uplift_thresholds",
]
