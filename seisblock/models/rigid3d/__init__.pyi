from .options import Rigid3dOptions
from .outcome import Rigid3dOutcome
from .solve import solve_rigid3d

__all__ = ["Rigid3dOptions", "Rigid3dOutcome", "solve_rigid3d"]
