"""Time, state, modes: the engine that every trajectory but the stone pile's runs on."""

from seisblock.dynamics.model import Change, Instant, Model, Trajectory, follow

__all__ = ["Change", "Instant", "Model", "Trajectory", "follow"]
