"""What each landing of a chain took: the impulse, the friction it needs, the energy before and after ([Sugimoto2017]_ 3.10)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from seisblock.bodies.two_layer import TwoLayerBlock
from seisblock.dynamics import Change
from seisblock.solvers.jump.modes import FLIGHT, OMEGA, THETA, VX, VY


@dataclass(frozen=True)
class Touch:
    """One landing.

    Parameters
    ----------
    friction_needed : float
        abs(P_x)/P_y of the impulse that turns the velocities of the flight into those of the corner's motion; infinite where the
        ground would have to pull.
    energy_before_j, energy_after_j : float, J
        Kinetic, relative to the ground.
    """

    friction_needed: float
    energy_before_j: float
    energy_after_j: float


def touch_of(change: Change, block: TwoLayerBlock) -> Touch:
    """Return what a landing took, from the states of :mod:`seisblock.solvers.jump.flight` on both sides of it ([Sugimoto2017]_ 3.10).

    Parameters
    ----------
    change : Change
        From flight, at the guard of the corner that touched.
    block : TwoLayerBlock
    """
    side, before, after = 2 * change.guard - 1, change.before, change.after
    psi = math.pi / 2 - block.slenderness - side * float(before[THETA])
    tilting = -side * float(after[OMEGA])
    along = float(after[VX]) + side * block.radius * math.sin(psi) * tilting
    up = block.radius * math.cos(psi) * tilting
    push, lift = along - float(before[VX]), up - float(before[VY])
    needed = 0.0 if push == 0.0 else abs(push) / lift if lift > 0.0 else math.inf

    def energy(vx: float, vy: float, omega: float) -> float:
        return 0.5 * (block.mass * (vx * vx + vy * vy) + block.centroid_inertia * omega * omega)

    return Touch(needed, energy(float(before[VX]), float(before[VY]), float(before[OMEGA])), energy(along, up, float(after[OMEGA])))


def is_landing(change: Change) -> bool:
    """Return whether an event of the flight's model is a landing ([Sugimoto2017]_ eq. (11))."""
    return change.source == FLIGHT
