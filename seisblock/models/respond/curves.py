"""Kinematic time histories from the states of the model: centre of gravity, lift, slip velocity, energy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seisblock.core.typing import FloatArray, IntArray
from seisblock.models.respond import constants
from seisblock.models.respond.params import RigidBody


@dataclass(frozen=True, eq=False)
class Curves:
    """Motion of the body relative to the ground, (n,) arrays, SI.

    Parameters
    ----------
    rotation, angular_velocity : rad, rad/s
    displacement, velocity : m, m/s
        Centre of gravity, along +x.
    height, rise_rate : m, m/s
        Centre of gravity above the ground.
    lift : m
        Height of the lowest corner above the ground.
    slip_velocity : m/s
        Corners in contact; zero in flight.
    """

    rotation: FloatArray
    angular_velocity: FloatArray
    displacement: FloatArray
    velocity: FloatArray
    height: FloatArray
    rise_rate: FloatArray
    lift: FloatArray
    slip_velocity: FloatArray


def curves(body: RigidBody, states: FloatArray, modes: IntArray) -> Curves:
    """Return the kinematics of states (n, n_states) in modes (n,).

    Terminal (negative) modes must be replaced by the mode that they ended, see ``outcome.motion_modes``.
    """
    kind = modes % constants.TENON_OFFSET
    in_flight = (kind == constants.FLIGHT) | (kind == constants.START)
    about_left = np.isin(kind, (constants.ROCK_LEFT, constants.SLIDE_ROCK_LEFT_PLUS, constants.SLIDE_ROCK_LEFT_MINUS))
    xi = np.where(about_left, -body.left, body.right)
    theta, omega = states[:, constants.THETA], states[:, constants.OMEGA]
    rx = xi * np.cos(theta) - body.height * np.sin(theta)
    ry = -xi * np.sin(theta) - body.height * np.cos(theta)
    gap = np.where(in_flight, states[:, constants.GAP_RIGHT], 0.0)
    rate = np.where(in_flight, states[:, constants.RATE_RIGHT], 0.0)
    speed = states[:, constants.SPEED]
    return Curves(
        theta,
        omega,
        states[:, constants.X],
        np.where(in_flight, speed, speed - ry * omega),
        gap - ry,
        rate + rx * omega,
        np.where(in_flight, np.minimum(states[:, constants.GAP_LEFT], states[:, constants.GAP_RIGHT]), 0.0),
        np.where(in_flight, 0.0, speed),
    )


def energy(body: RigidBody, gravity: float, states: FloatArray, modes: IntArray) -> FloatArray:
    """Return the sum of kinetic and potential energy, (n,), J, of states (n, n_states) in modes (n,)."""
    motion = curves(body, states, modes)
    kinetic = 0.5 * (motion.velocity**2 + motion.rise_rate**2 + body.gyration_squared * motion.angular_velocity**2)
    return body.mass * (kinetic + gravity * motion.height)
