from .outcome import StackOutcome, StoneOutcome
from .solve import solve_stack

__all__ = ["StackOutcome", "StoneOutcome", "solve_stack"]
