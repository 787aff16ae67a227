from .outcome import RockOutcome
from .rocker import Rocker, RockOptions, rocker
from .solve import solve_rock
from .verdicts import Verdict, Verdicts, rock_verdict, rock_verdicts

__all__ = ["RockOptions", "RockOutcome", "Rocker", "Verdict", "Verdicts", "rock_verdict", "rock_verdicts", "rocker", "solve_rock"]
