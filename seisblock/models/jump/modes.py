"""Indices of states, modes, guards and parameters of flight and landing ([Sugimoto2017]_ sections 3.8-3.11)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seisblock._jit import kernel, types
from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.core.typing import FloatArray, IntArray
from seisblock.models.jump.options import LANDINGS

THETA, OMEGA, X, VX, Y, VY = range(6)
SIDE, FRICTION_NEEDED, ENERGY_BEFORE, ENERGY_AFTER = range(6, 10)
PSI, SIN, COS, TAU1, TAU2, SPEED2, SINK, WEIGHT, INERTIA, NORMAL = range(10, 20)
LEFT, RIGHT = 0, 1
FLIGHT = 0
STICK, HOLD, SLIP_BACKWARD, SLIP_FORWARD, FLAT_BACKWARD, FLAT_FORWARD = range(6)
JAMMED, OVERTURNED, END = range(-3, 0)
ALPHA, RADIUS, HALF_WIDTH, HEIGHT, MASS, CENTROID_INERTIA, GRAVITY, MU, MU_KINETIC, DROP, DT, RULE = range(12)
TOUCH, TOPPLE, LIFT, FRICTION, FRICTION_BACKWARD = range(5)
PAPER_RULE, FRICTION_RULE, PRINTED_RULE = range(3)
"""Codes of the landing rules, the indices of :data:`seisblock.models.jump.options.LANDINGS`."""

_t = types()


@kernel(_t.int64(_t.int64, _t.int64), inline=True)
def contact_mode(corner, kind):
    """Return the mode of motion `kind` about `corner`."""
    return 1 + 2 * kind + corner


@kernel(_t.int64(_t.int64), inline=True)
def contact_corner(mode):
    """Return the corner in contact, ``LEFT`` or ``RIGHT``."""
    return (mode - 1) % 2


@kernel(_t.int64(_t.int64), inline=True)
def contact_kind(mode):
    """Return the kind of motion, ``STICK`` to ``FLAT_FORWARD``."""
    return (mode - 1) // 2


def flight_parameters(
    block: TwoLayerBlock, gravity: float, mu: float, mu_kinetic: float, drop: float, dt: float, rule: str = "paper"
) -> FloatArray:
    """Return the parameter vector of the model, (12,); `dt` is the sampling interval, `rule` the landing rule."""
    return np.array(
        [
            block.slenderness,
            block.radius,
            block.width / 2,
            block.centroid_height,
            block.mass,
            block.centroid_inertia,
            gravity,
            mu,
            mu_kinetic,
            drop,
            dt,
            float(LANDINGS.index(rule)),
        ]
    )


@dataclass(frozen=True, eq=False)
class Sizes:
    """Sizes of many blocks, (m,) arrays: R, m, alpha, rad, B, m, and height of the centroid, m."""

    radius: FloatArray
    slenderness: FloatArray
    width: FloatArray
    centroid_height: FloatArray


def centroid(block: TwoLayerBlock | Sizes, drop: float | FloatArray, modes: IntArray, states: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return displacement x and rise y of the centroid, (n,), m, from states (n, 10) of one block, or of one block per row.

    After a landing X is the slip of the foot; the centroid follows from the tilt about the corner in contact.
    """
    side = np.where(modes == FLIGHT, 0, 2 * ((modes - 1) % 2) - 1)
    psi = np.pi / 2 - block.slenderness - side * states[:, THETA]
    foot_to_centroid = -side * (block.radius * np.cos(psi) - block.width / 2)
    corner_rise = block.radius * np.sin(psi) - block.centroid_height - drop
    in_flight = side == 0
    return states[:, X] + foot_to_centroid, np.where(in_flight, states[:, Y], corner_rise)
