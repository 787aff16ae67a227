"""What the points of a joint make of a stone's base: about which lines it turns, and what an impact leaves of its turning.

n x n points at the centres of equal segments put the outermost ones at (1 - 1/n) of the half width b. A stone turns about those, so that
it leans only to (1 - 1/n) b/h before it falls: it stands as if it were that much narrower. An impact about them leaves more of the turning,
1 - 2 m b'^2 / (I + m (h^2 + b'^2)) with b' = (1 - 1/n) b (derived here; [Housner1963]_ for b' = b): 0.87 for 0.81 at h/b = 2.6 and n = 5.
On springs the inner points, which strike within the same few milliseconds, take a part of the impulse besides, nearer to the middle
than the pivot; that leaves still more, and how much hangs on the springs: it is found by letting the stone rock once.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import GROUND, PileStone
from seisblock.records.motion import Motion
from seisblock.results import Response
from seisblock.solvers.stack.arrays import SHARP_POINTS, pile_arrays
from seisblock.solvers.stack.course import Course
from seisblock.solvers.stack.outcome import StackOutcome
from seisblock.solvers.stack.rest import steps_per_sample

LET_GO = 0.5
"""Lean, over the greatest from which the stone comes back, at which it is let go to see what an impact leaves."""

CLINGING = 5.0
"""Friction with which nothing slides meanwhile."""


@dataclass(frozen=True)
class Base:
    """What the contact points make of the base of a pile's top stone, taken alone on rigid ground, along x.

    Parameters
    ----------
    stone : str
    width_ratio : float, 1
        Distance of the lines about which it turns, over its width.
    restitution : float, 1
        Angular velocity after an impact over that before.
    housner_ratio : float, 1
        The same on its edges ([Housner1963]_).
    """

    stone: str
    width_ratio: float
    restitution: float
    housner_ratio: float


def base_of(response: Response[StackOutcome]) -> Base:
    """Return what the contact points of a run make of the base of the top stone.

    Examples
    --------
    >>> from seisblock.bodies.pile.toml import load_pile
    >>> from seisblock.solvers.stack.solve import solve_stack
    >>> still = Motion.from_arrays(np.zeros(3), 0.01)
    >>> found = base_of(solve_stack(load_pile("wagata"), still, law="springs", points=5))
    >>> found.width_ratio, round(found.restitution, 2), round(found.housner_ratio, 2)
    (0.8, 0.91, 0.81)
    """
    stone = response.body.stones[-1]
    return base(
        stone,
        response.options["points"],
        None if response.options["contact"] is None else PileContact(**response.options["contact"]),
        response.options["restitution"],
        response.options["gravity_m_s2"],
    )


def base(stone: PileStone, points: int, contact: PileContact | None, restitution: float | None, gravity: float) -> Base:
    """Return what `points` along each side make of a stone's base; a contact of None is rigid."""
    share = 1.0 - 2.0 * stone.insets()[0] / stone.width if points == SHARP_POINTS else 1.0 - 1.0 / points
    sharp = housner(stone, 1.0)
    if restitution is not None:
        kept = restitution
    else:
        kept = housner(stone, share) if contact is None else _after_an_impact(stone, points, share, contact, gravity)
    return Base(stone.name, share, kept, sharp)


def housner(stone: PileStone, share: float) -> float:
    """Return what an impact leaves of the turning of a block about lines at a share of its half width ([Housner1963]_).

    A round one turns in the plane of its lean, about points of its rim; k^2 + h^2 - R^2 over k^2 + h^2 + R^2 is left (derived here).
    """
    b, h = 0.5 * stone.width * share, 0.5 * stone.height
    return 1.0 - 2.0 * b * b / (float(stone.gyration_squared[1]) + b * b + h * h)


def _after_an_impact(stone: PileStone, points: int, share: float, contact: PileContact, gravity: float) -> float:
    """Return the ratio of the angular velocities that raise a rocking stone to its leans before and after its first impact."""
    alone = Pile("alone", (replace(stone, on=GROUND, offset=(0.0, 0.0), bottom=None, mu=CLINGING),))
    alpha = math.atan2(share * stone.width, stone.height)
    radius = 0.5 * math.hypot(share * stone.width, stone.height)
    seconds = 4.0 * math.sqrt(4.0 * radius / (3.0 * gravity))
    still = Motion.from_arrays(np.zeros(300), seconds / 300)
    pile = pile_arrays(alone, contact, points)
    steps = steps_per_sample(pile, still.dt, None)
    end = Course(pile, still, (1.0, 0.0), gravity, steps, False, True, {stone.name: LET_GO * alpha}).follow()
    lean = 2.0 * np.arctan2(end.track.quaternions[:, 0, 2], end.track.quaternions[:, 0, 0])
    crossed = int(np.argmax(lean < 0.0))
    beyond = -lean[crossed : crossed + 1 + int(np.argmax(np.diff(lean[crossed:]) > 0.0))].min()

    def height(lean: float) -> float:
        return math.cos(alpha - lean) - math.cos(alpha)

    return math.sqrt(max(0.0, height(float(beyond))) / height(LET_GO * alpha))
