from .ensemble import Ensemble, follow_many
from .following import follow
from .model import Model
from .status import Status
from .trajectory import Change, Instant, Path, Trajectory, joined

__all__ = ["Change", "Ensemble", "Instant", "Model", "Path", "Status", "Trajectory", "follow", "follow_many", "joined"]
