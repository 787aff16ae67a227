from .batch import jump_many
from .batch_results import JumpBatchResult
from .chain import Chain
from .solve import JumpOutcome, solve_jump

__all__ = ["Chain", "JumpBatchResult", "JumpOutcome", "jump_many", "solve_jump"]
