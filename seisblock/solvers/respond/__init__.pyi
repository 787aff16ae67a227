from .many import Fates, respond_many
from .outcome import ModeChange, RespondOutcome
from .setting import Setting
from .solve import make_setting, solve_respond

__all__ = ["Fates", "make_setting", "ModeChange", "respond_many", "RespondOutcome", "Setting", "solve_respond"]
