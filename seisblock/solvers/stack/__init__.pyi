from .outcome import StackOutcome, StoneFate
from .solve import solve_stack

__all__ = ["StackOutcome", "StoneFate", "solve_stack"]
