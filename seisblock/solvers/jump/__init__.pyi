from .chain import Chain
from .fates import JumpFates
from .many import jump_many
from .solve import JumpOutcome, solve_jump

__all__ = ["Chain", "JumpFates", "JumpOutcome", "jump_many", "solve_jump"]
