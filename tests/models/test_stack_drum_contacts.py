"""Contacts between the sides of lying cylinders."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.models.stack.arrays import PLASTIC_RESTITUTION, pile_arrays
from seisblock.models.stack.frames import Q, R, V, X
from seisblock.models.stack.options import EDGES
from seisblock.models.stack.recorder import CREATED, DISSIPATED
from seisblock.models.stack.simulation import Simulation
from seisblock.validation.stack_round import tilted_axes
from tests.models.test_stack_rigid import still_ground

RADIUS, LONG, SHORT, SPEED = 0.25, 0.7, 0.3, 1.0
SIDE_BY_SIDE = 2.0 * RADIUS * math.sqrt(0.5)
"""Distance of the axes of two that touch as the square prisms inside them."""


def roll_against(along, rotated, restitution):
    """Slide a short drum against a long one, both along x; return the position of its centre and its rotation."""
    stones = (
        PileStone("low", 2.0 * RADIUS, 2.0 * RADIUS, LONG, shape="round"),
        PileStone("high", 2.0 * RADIUS, 2.0 * RADIUS, SHORT, on="low", shape="round"),
    )
    pile = pile_arrays(Pile("two", stones, mu=0.5), None, EDGES, restitution)
    places = [((0.0, 0.0, RADIUS), 0.0), ((along, 2.4 * RADIUS, RADIUS), rotated)]
    for body, (centre, turn) in zip(pile.bodies[:2], places, strict=True):
        lies = Rotation.from_rotvec([0.0, 0.0, turn]) * Rotation.from_matrix(tilted_axes(math.pi / 2.0))
        body[X : X + 3], body[V : V + 6] = centre, 0.0
        body[Q : Q + 4], body[R : R + 9] = np.roll(lies.as_quat(), 1), lies.as_matrix().ravel()
    pile.bodies[1, V + 1] = -SPEED
    return Simulation(pile, still_ground(1.5), (1.0, 1.0), G, 1, True, False, {}).run(), stones[1].mass


@pytest.mark.parametrize("restitution", [PLASTIC_RESTITUTION, 0.1, 0.9])
@pytest.mark.parametrize(("along", "rotated"), [(0.42, 0.0), (0.45, 0.0), (0.49, 0.0), (0.42, 0.1), (0.44, -0.1)])
def test_drum_sliding_past_end_of_lying_drum_contacts_its_side(along, rotated, restitution):
    """As long as its centre was beyond the other's end it was met only face on face: it sank into its side, and was pushed out of it."""
    end, mass = roll_against(along, rotated, restitution)
    low, high = end.track.centres[:, 0], end.track.centres[:, 1]
    assert (high - low)[:, 1].min() > SIDE_BY_SIDE
    assert low[-1, 1] < -RADIUS
    assert end.output.energy_ledger[CREATED] < 2e-5 * mass * SPEED**2
    assert end.output.energy_ledger[DISSIPATED] > 0.3 * mass * SPEED**2
