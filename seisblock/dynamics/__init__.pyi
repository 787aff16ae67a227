from .ensemble import Ensemble, follow_many
from .model import Model, follow
from .status import Status
from .trajectory import Change, Instant, Path, Trajectory, joined

__all__ = ["Change", "Ensemble", "Instant", "Model", "Path", "Status", "Trajectory", "follow", "follow_many", "joined"]
