from .changes import Change, Changes, Instant, Instants
from .ensemble import Ensemble, follow_many
from .following import follow
from .model import Model
from .status import Status
from .trajectory import Path, Trajectory, joined

__all__ = [
    "Change",
    "Changes",
    "Ensemble",
    "Instant",
    "Instants",
    "Model",
    "Path",
    "Status",
    "Trajectory",
    "follow",
    "follow_many",
    "joined",
]
