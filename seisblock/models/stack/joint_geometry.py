"""Effective base of a stone on discrete contact points: pivot distance and restitution.

n x n points at the centres of equal segments put the outermost ones at (1 - 1/n) of the half width b. The stone pivots about those and
overturns at a tilt of (1 - 1/n) b/h, as if it were narrower. The restitution of an impact about them is larger,
1 - 2 m b'^2 / (I + m (h^2 + b'^2)) with b' = (1 - 1/n) b (derived here; [Housner1963]_ for b' = b): 0.87 instead of 0.81 at h/b = 2.6
and n = 5. On springs the inner points strike within the same milliseconds and take part of the impulse nearer to the centre than the
pivot, which raises the restitution further. That share depends on the springs and is found by simulating one rocking cycle.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import CONTACT_TOLERANCE, GROUND, Joint, PileStone, bearing_rectangle
from seisblock.core.results import Response
from seisblock.models.stack.arrays import CORNER_POINTS, pile_arrays
from seisblock.models.stack.outcome import StackOutcome
from seisblock.models.stack.simulation import Simulation
from seisblock.models.stack.static_equilibrium import steps_per_sample
from seisblock.records.motion import Motion

RELEASE_TILT_RATIO = 0.5
"""Tilt of release for the simulated impact, over the overturning angle."""

HIGH_FRICTION = 5.0
"""Friction coefficient that excludes sliding in that simulation."""


@dataclass(frozen=True)
class EffectiveBase:
    """Effective base of a pile's top stone on rigid ground, along x.

    Parameters
    ----------
    stone : str
    width_ratio : float, 1
        Distance between the pivots over the width of the stone.
    restitution : float, 1
        Angular velocity after an impact over that before.
    housner_ratio : float, 1
        Restitution of the same stone on its edges ([Housner1963]_).
    """

    stone: str
    width_ratio: float
    restitution: float
    housner_ratio: float


def pile_thresholds(pile: Pile, points: int, gravity: float, axis: int = 0) -> tuple[float, float]:
    """Return the horizontal accelerations, m/s^2, at which a part of a pile starts to move in +axis and -axis when applied slowly.

    Each stone (or dowelled group) with everything that rests on it tips about the ends of the joints under it, at g times the arm over the
    height of its centre of gravity above them, or slips there at mu g; the least of all parts counts (derived here). Parts that stand on
    several levels (a pillar with a lintel that also rests on another pillar) or hold a fixed stone are not considered; infinite if no part
    is left.

    Parameters
    ----------
    pile : Pile
    points : int
        Contact points along each side of a joint; the outermost ones are the pivots.
    gravity : float, m/s^2
    axis : int
        0 for the directions +x and -x, 1 for +y and -y.

    Examples
    --------
    >>> tall, slab = PileStone("tall", 0.2, 0.2, 0.8, on="slab", offset=(0.1, 0.0)), PileStone("slab", 0.6, 0.6, 0.2)
    >>> [round(value, 3) for value in pile_thresholds(Pile("two", (slab, tall)), 2, 10.0)]
    [2.5, 2.5]
    >>> [round(value, 3) for value in pile_thresholds(Pile("doweled", (slab, tall), dowels=(("slab", "tall"),)), 2, 10.0)]
    [4.38, 4.38]
    """
    centres, joints = pile.centres(), pile.joints()
    right, left = math.inf, math.inf
    for members in pile.bodies():
        part = _part_above(members, joints)
        supports = [joint for joint in joints if joint.upper in part and joint.lower not in part]
        levels = [joint.height for joint in supports]
        if not levels or max(levels) - min(levels) > CONTACT_TOLERANCE or any(pile.names[i] in pile.fixed for i in part):
            continue
        spans = [_pivots(joint, pile, centres, points, axis) for joint in supports]
        mass = sum(pile.stones[i].mass for i in part)
        x, z = (sum(pile.stones[i].mass * centres[i][k] for i in part) / mass for k in (axis, 2))
        rise = z - levels[0]
        mu = min(pile.friction(pile.stones[joint.upper])[0] for joint in supports)
        right = min(right, mu, (max(end for _, end in spans) - x) / rise)
        left = min(left, mu, (x - min(end for end, _ in spans)) / rise)
    return gravity * right, gravity * left


def _part_above(members: tuple[int, ...], joints: Sequence[Joint]) -> set[int]:
    """Return the stones of a body and all that rest on them."""
    part = set(members)
    while grown := {joint.upper for joint in joints if joint.lower in part} - part:
        part |= grown
    return part


def _pivots(joint: Joint, pile: Pile, centres: Sequence[tuple[float, float, float]], points: int, axis: int) -> tuple[float, float]:
    """Return the outermost contact points of a joint along x or y, m."""
    if points == CORNER_POINTS:
        return bearing_rectangle(joint, pile.stones, centres)[axis]
    low, high = (joint.x, joint.y)[axis]
    inset = 0.5 * (high - low) / points
    return low + inset, high - inset


def effective_base(response: Response[StackOutcome]) -> EffectiveBase:
    """Return the effective base of the top stone of a run.

    Examples
    --------
    >>> from seisblock.bodies.pile.toml import load_pile
    >>> from seisblock.models.stack.solve import solve_stack
    >>> still = Motion.from_arrays(np.zeros(3), 0.01)
    >>> base = effective_base(solve_stack(load_pile("wagata"), still, law="springs", points=5))
    >>> base.width_ratio, round(base.restitution, 2), round(base.housner_ratio, 2)
    (0.8, 0.91, 0.81)
    """
    stone = response.body.stones[-1]
    return compute_effective_base(
        stone,
        response.options.points,
        response.options.contact,
        response.options.restitution,
        response.options.gravity,
    )


def compute_effective_base(
    stone: PileStone, points: int, contact: PileContact | None, restitution: float | None, gravity: float
) -> EffectiveBase:
    """Return the effective base of a stone with `points` along each side; `contact` None: rigid contact."""
    width_ratio = 1.0 - 2.0 * stone.insets()[0] / stone.width if points == CORNER_POINTS else 1.0 - 1.0 / points
    sharp_restitution = housner_restitution(stone, 1.0)
    if restitution is not None:
        ratio = restitution
    else:
        ratio = (
            housner_restitution(stone, width_ratio)
            if contact is None
            else _simulate_restitution(stone, points, width_ratio, contact, gravity)
        )
    return EffectiveBase(stone.name, width_ratio, ratio, sharp_restitution)


def housner_restitution(stone: PileStone, width_ratio: float) -> float:
    """Return the restitution of a block that rocks about pivots at a share of its half width ([Housner1963]_).

    For a cylinder, which rocks in the plane of its lean about points of its rim: (k^2 + h^2 - R^2) / (k^2 + h^2 + R^2) (derived here).
    """
    b, h = 0.5 * stone.width * width_ratio, 0.5 * stone.height
    return 1.0 - 2.0 * b * b / (float(stone.gyration_squared[1]) + b * b + h * h)


def _simulate_restitution(stone: PileStone, points: int, width_ratio: float, contact: PileContact, gravity: float) -> float:
    """Return the restitution from the tilts before and after the first impact of a simulated rocking stone."""
    single_stone = Pile("alone", (replace(stone, on=GROUND, offset=(0.0, 0.0), bottom=None, mu=HIGH_FRICTION),))
    alpha = math.atan2(width_ratio * stone.width, stone.height)
    radius = 0.5 * math.hypot(width_ratio * stone.width, stone.height)
    # 4/p: longer than the swing to the impact and the rebound
    duration = 4.0 * math.sqrt(4.0 * radius / (3.0 * gravity))
    zero_motion = Motion.from_arrays(np.zeros(300), duration / 300)
    pile = pile_arrays(single_stone, contact, points)
    steps = steps_per_sample(pile, zero_motion.dt, None)
    result = Simulation(pile, zero_motion, (1.0, 0.0), gravity, steps, False, True, {stone.name: RELEASE_TILT_RATIO * alpha}).run()
    # the stone rotates about y only
    lean = 2.0 * np.arctan2(result.track.quaternions[:, 0, 2], result.track.quaternions[:, 0, 0])
    # first passage through the upright position, then the first maximum on the other side
    crossing = int(np.argmax(lean < 0.0))
    rebound_lean = -lean[crossing : crossing + 1 + int(np.argmax(np.diff(lean[crossing:]) > 0.0))].min()

    def height(lean: float) -> float:
        return math.cos(alpha - lean) - math.cos(alpha)

    # speeds at the impact follow from the heights before and after: v^2 is proportional to the rise of the centre
    return math.sqrt(max(0.0, height(float(rebound_lean))) / height(RELEASE_TILT_RATIO * alpha))
