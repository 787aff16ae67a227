from .batch import JumpBatchResult, jump_many
from .chain import Chain
from .solve import JumpOutcome, solve_jump

__all__ = ["Chain", "JumpBatchResult", "JumpOutcome", "jump_many", "solve_jump"]
