from .harmonic import uplift_thresholds
from .minima import UpliftMinimum, uplift_minima
from .modes import Modes, natural_modes
from .solve import CornerOutcome, UpliftOutcome, solve_uplift

__all__ = [
    "CornerOutcome",
    "Modes",
    "UpliftMinimum",
    "UpliftOutcome",
    "natural_modes",
    "solve_uplift",
    "uplift_minima",
    "uplift_thresholds",
]
