from .ensemble import Ensemble, follow_many
from .model import Change, Instant, Model, Trajectory, follow
from .status import Status

__all__ = ["Change", "Ensemble", "Instant", "Model", "Status", "Trajectory", "follow", "follow_many"]
