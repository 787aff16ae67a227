from .batch import RespondBatchResult, respond_many
from .outcome import ModeChange, RespondOutcome
from .params import RespondParams
from .solve import respond_params, solve_respond

__all__ = ["RespondBatchResult", "respond_params", "ModeChange", "respond_many", "RespondOutcome", "RespondParams", "solve_respond"]
