from .ensemble import Ensemble, integrate_many
from .events import EventLog, GuardEvent, Instant, Instants
from .integration import integrate
from .model import Model
from .trajectory import Path, Trajectory, concatenate_paths

__all__ = [
    "GuardEvent",
    "EventLog",
    "Ensemble",
    "Instant",
    "Instants",
    "Model",
    "Path",
    "Trajectory",
    "integrate",
    "integrate_many",
    "concatenate_paths",
]
