from .options import RockOptions
from .outcome import RockOutcome
from .params import RockParams, rock_params
from .solve import solve_rock
from .verdicts import Verdict, Verdicts, rock_verdict, rock_verdicts

__all__ = ["RockOptions", "RockOutcome", "RockParams", "Verdict", "Verdicts", "rock_verdict", "rock_verdicts", "rock_params", "solve_rock"]
