from .outcome import RockOutcome
from .solve import Verdict, rock_verdict, solve_rock

__all__ = ["RockOutcome", "Verdict", "rock_verdict", "solve_rock"]
