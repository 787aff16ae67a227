"""From the model's states to what one draws: where the centre of gravity is, how high the lowest point, how fast the foot slips."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seisblock.solvers.respond import names
from seisblock.solvers.respond.setting import Stand
from seisblock.typing import FloatArray, IntArray


@dataclass(frozen=True, eq=False)
class Curves:
    """Motion of the body relative to the ground, (n,) arrays, SI.

    Parameters
    ----------
    rotation, angular_velocity : rad, rad/s
    displacement, velocity : m, m/s
        Of the centre of gravity, along +x.
    height, rise_rate : m, m/s
        Of the centre of gravity above the ground.
    lift : m
        Height of the lowest corner above the ground.
    slip_velocity : m/s
        Of the corners that touch; zero in flight.
    """

    rotation: FloatArray
    angular_velocity: FloatArray
    displacement: FloatArray
    velocity: FloatArray
    height: FloatArray
    rise_rate: FloatArray
    lift: FloatArray
    slip_velocity: FloatArray


def curves(stand: Stand, states: FloatArray, modes: IntArray) -> Curves:
    """Return the motion that states (n, n_states) of the model in some modes (n,) describe.

    Negative modes end a motion: they must have been replaced by those that they ended.
    """
    kind = modes % names.HELD
    flies = (kind == names.FLIGHT) | (kind == names.START)
    about_left = np.isin(kind, (names.ROCK_LEFT, names.SKID_LEFT_PLUS, names.SKID_LEFT_MINUS))
    xi = np.where(about_left, -stand.left, stand.right)
    theta, omega = states[:, names.THETA], states[:, names.OMEGA]
    rx = xi * np.cos(theta) - stand.height * np.sin(theta)
    ry = -xi * np.sin(theta) - stand.height * np.cos(theta)
    gap = np.where(flies, states[:, names.GAP_RIGHT], 0.0)
    rate = np.where(flies, states[:, names.RATE_RIGHT], 0.0)
    speed = states[:, names.SPEED]
    return Curves(
        theta,
        omega,
        states[:, names.X],
        np.where(flies, speed, speed - ry * omega),
        gap - ry,
        rate + rx * omega,
        np.where(flies, np.minimum(states[:, names.GAP_LEFT], states[:, names.GAP_RIGHT]), 0.0),
        np.where(flies, 0.0, speed),
    )


def energy(stand: Stand, gravity: float, states: FloatArray, modes: IntArray) -> FloatArray:
    """Return kinetic and potential energy, (n,), J, of states in some modes."""
    of = curves(stand, states, modes)
    kinetic = 0.5 * (of.velocity**2 + of.rise_rate**2 + stand.gyration_squared * of.angular_velocity**2)
    return stand.mass * (kinetic + gravity * of.height)
