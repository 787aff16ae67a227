from .chain import Chain
from .solve import JumpOutcome, solve_jump

__all__ = ["Chain", "JumpOutcome", "solve_jump"]
