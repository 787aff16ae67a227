"""Time, state, modes: the engine that every trajectory but the stone pile's runs on."""

from seisblock.dynamics.ensemble import Ensemble, follow_many
from seisblock.dynamics.model import Change, Instant, Model, Trajectory, follow

__all__ = ["Change", "Ensemble", "Instant", "Model", "Trajectory", "follow", "follow_many"]
