"""From a pile of stones to the arrays of its kernels: bodies, boxes, joints with their points, corners, edges, memory."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seisblock import checks
from seisblock.bodies.inset import SHARP
from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import Joint, carrying
from seisblock.errors import ParameterError
from seisblock.limits import check_budget
from seisblock.solvers.stack.arguments import PileLayout, PileMemory
from seisblock.solvers.stack.contact import FRICTION, KINETIC, SLOT
from seisblock.solvers.stack.frames import AT, BODY, BOX, INERT, INERTIA, INVERSE, MASS, Q, R, X
from seisblock.solvers.stack.hulls import MOST_CORNERS, Worn, hulls_of
from seisblock.solvers.stack.impulse import ROW, SPEEDS
from seisblock.solvers.stack.lying import BED
from seisblock.solvers.stack.row import PACE, WHO
from seisblock.solvers.stack.step import ALL_EDGES, CARRIER, JOINT, LEVEL, ORBITS, PAIR, PARTNER, POINT, SCRATCH, SIGMA
from seisblock.typing import FloatArray, IntArray
from seisblock.words import noted

GROUND_HALF, GROUND_DEPTH = 1e5, 50.0
"""Half width and half depth, m, of the box that is the ground: a drum may roll far."""

PLASTIC = -1.0
"""The rebound of joints that are given none."""

SHARP_POINTS = 2
"""Points along each side of a joint that stand at its corners."""

NO_SPRINGS = (0.0, 0.0, 0.0, 0.0)
MOST_MET = 80
"""Rigid contacts beyond those of joints for which there is room, a body."""


@dataclass(frozen=True, eq=False)
class PileArrays:
    """A pile in arrays, at rest before it has sunk into its springs.

    Parameters
    ----------
    body : Pile
    points : int
        Contact points along each side of a joint.
    bodies : (m + 1, 31) array
        State; the ground last.
    inert : (m, 19) array
        Masses, inertia matrices and their inverses.
    boxes, owner : (b + 1, 6), (b + 1,) arrays
        Half sizes and places of the boxes, and the bodies they belong to; the ground last.
    cores, rims : (b + 1, 3), (b + 1, 4, 2) arrays
        What other stones meet of a box that has tilted off its joint, and the circles that bound a round one.
    joints, constants, grids : arrays
        See ``stack_step``.
    pairs, pair_constants : (p, 2), (p, 7) arrays
    corners, counts, edges : arrays
        Corners of each box, how many, and the pairs of corners that make its edges.
    members : tuple of tuples of int
        Stones of each body.
    """

    body: Pile
    points: int
    bodies: FloatArray
    inert: FloatArray
    boxes: FloatArray
    owner: IntArray
    cores: FloatArray
    rims: FloatArray
    joints: IntArray
    constants: FloatArray
    grids: FloatArray
    pairs: IntArray
    pair_constants: FloatArray
    corners: FloatArray
    counts: IntArray
    edges: IntArray
    members: tuple[tuple[int, ...], ...]

    @property
    def layout(self) -> PileLayout:
        """What does not change, as the kernels take it."""
        return PileLayout(*(getattr(self, name) for name in PileLayout._fields))

    def memory(self) -> PileMemory:
        """Return empty memory."""
        n, p, bodies = self.joints.shape[0], self.pairs.shape[0], self.bodies.shape[0]
        most = n * self.points**2 + MOST_MET * bodies
        return PileMemory(
            np.zeros((n, self.grids.shape[1], 4, 2)),
            np.zeros((n, self.grids.shape[1], 4, SLOT)),
            np.zeros((p, 2, MOST_CORNERS, SLOT)),
            np.zeros((p, 2, 2 * ALL_EDGES, SLOT)),
            np.zeros(p, dtype=np.int64),
            np.zeros((bodies, bodies)),
            np.zeros((self.boxes.shape[0], BOX)),
            np.zeros((SCRATCH, 18)),
            np.zeros((most, WHO), dtype=np.int64),
            np.zeros((most, ROW)),
            np.zeros((bodies, 9)),
            np.zeros((bodies, SPEEDS)),
            np.zeros(PACE),
            # the ground lies
            np.repeat([[0, 0, 0], [1, 0, 0]], [bodies - 1, 1], axis=0),
            np.zeros((bodies, 1 + MOST_CORNERS, BED)),
        )


def pile_arrays(body: Pile, contact: PileContact | None, points: int, rebound: float = PLASTIC) -> PileArrays:
    """Return the arrays of a pile ([Furukawa2009]_ section 3(1)).

    Parameters
    ----------
    body : Pile
    contact : PileContact or None
        Of springs; None: rigid.
    points : int
        Contact points along each side of a joint: 2 stand at its corners, and go with the corners of what the faces share as stones
        slide; 3 or more at the centres of so many segments, as 5 do in [Furukawa2009]_, whose pivots so lie at 0.8 of the half width.
    rebound : float, 1
        Of the joints, a ratio of velocities; negative: what angular momentum gives.

    Raises
    ------
    ParameterError
        If `points` is no whole number, less than 2, or more than may be looked at; if round stones are to stand on springs or on a grid,
        or stones with an inset on a grid.
    """
    checks.whole("the number of points along each side of a joint", points, least=2)
    check_budget(noted("points along each side of a joint"), points, "SEISBLOCK_PILE_POINTS")
    _check_bases(body, contact, points)
    members = tuple(body.bodies())
    centres = np.array(body.centres())
    bodies, inert, owner = _bodies(body, members, centres)
    joints = [joint for joint in body.joints() if joint.lower < 0 or owner[joint.upper] != owner[joint.lower]]
    joints = [joint for joint in joints if owner[joint.upper] != len(members) or (joint.lower >= 0 and owner[joint.lower] != len(members))]
    boxes = np.zeros((len(body.stones) + 1, BOX))
    for i, stone in enumerate(body.stones):
        boxes[i, :3] = 0.5 * np.array(stone.size)
        boxes[i, AT:] = centres[i] - bodies[owner[i], X : X + 3]
    boxes[-1] = (GROUND_HALF, GROUND_HALF, GROUND_DEPTH, 0.0, 0.0, -GROUND_DEPTH)
    pairs = np.array([(i, j) for i in range(len(boxes)) for j in range(i + 1, len(boxes)) if owner[i] != owner[j]], dtype=np.int64)
    integers, constants, grids, worn = _joint_arrays(body, contact, points, rebound, joints, boxes, owner, inert, pairs)
    corners, counts, edges, cores, rims = hulls_of(body, boxes, worn)
    return PileArrays(
        body,
        points,
        bodies,
        inert,
        boxes,
        owner,
        cores,
        rims,
        integers,
        constants,
        grids,
        pairs,
        _pair_constants(body, contact, points, pairs, boxes, owner, inert, integers, constants),
        corners,
        counts,
        edges,
        members,
    )


def _check_bases(body: Pile, contact: PileContact | None, points: int) -> None:
    """Refuse bases of which the contacts know nothing."""
    for stone in body.stones:
        if stone.is_round and (contact is not None or points != SHARP_POINTS):
            raise ParameterError(
                "the stone {name} is round: it stands rigid on its rim, and neither on springs nor on a grid of points", name=stone.name
            )
        if points != SHARP_POINTS and stone.inset != SHARP:
            raise ParameterError(
                "an inset is one of stones that stand on their edges: leave out {points} points a side, which stand inside by themselves",
                points=points,
            )


def _bodies(body: Pile, members: tuple[tuple[int, ...], ...], centres: FloatArray) -> tuple[FloatArray, FloatArray, IntArray]:
    """Return state and inertia of the bodies, and the body of each box; fixed stones belong to the ground."""
    bodies = np.zeros((len(members) + 1, BODY))
    bodies[:, Q] = 1.0
    bodies[:, R : R + 9] = np.eye(3).ravel()
    inert = np.zeros((len(members), INERT))
    owner = np.full(len(body.stones) + 1, len(members), dtype=np.int64)
    for b, group in enumerate(members):
        masses = np.array([body.stones[i].mass for i in group])
        middle = masses @ centres[list(group)] / masses.sum()
        tensor = np.zeros((3, 3))
        for i, mass in zip(group, masses, strict=True):
            stone, arm = body.stones[i], centres[i] - middle
            size = np.array(stone.size)
            about = stone.gyration_squared if stone.is_round else (size @ size - size**2) / 12.0
            tensor += mass * (np.diag(about) + (arm @ arm) * np.eye(3) - np.outer(arm, arm))
            owner[i] = b
        bodies[b, X : X + 3] = middle
        inert[b, MASS] = masses.sum()
        inert[b, INERTIA:INVERSE] = tensor.ravel()
        inert[b, INVERSE:] = np.linalg.inv(tensor).ravel()
    return bodies, inert, owner


def _joint_arrays(
    body: Pile,
    contact: PileContact | None,
    points: int,
    rebound: float,
    joints: list[Joint],
    boxes: FloatArray,
    owner: IntArray,
    inert: FloatArray,
    pairs: IntArray,
) -> tuple[IntArray, FloatArray, FloatArray, Worn]:
    """Return integers, constants and points of the joints, and how far the faces that carry points are worn, along x and y, m."""
    half_orbits = (points + 1) // 2
    integers = np.zeros((len(joints), 4), dtype=np.int64)
    constants = np.zeros((len(joints), JOINT))
    grids = np.zeros((len(joints), half_orbits**2, 4, 3))
    worn: Worn = {}
    centres = body.centres()
    number = {tuple(pair): p for p, pair in enumerate(pairs.tolist())}
    for j, joint in enumerate(joints):
        upper, lower = joint.upper, joint.lower if joint.lower >= 0 else len(boxes) - 1
        upper_is_smaller = boxes[upper, 0] * boxes[upper, 1] <= boxes[lower, 0] * boxes[lower, 1]
        carrier, partner = (upper, lower) if upper_is_smaller else (lower, upper)
        sigma = -1.0 if upper_is_smaller else 1.0
        integers[j, [CARRIER, PARTNER, ORBITS]] = carrier, partner, half_orbits**2
        integers[j, PAIR] = number[min(carrier, partner), max(carrier, partner)]
        stone = body.stones[upper]
        sides = (joint.x[1] - joint.x[0], joint.y[1] - joint.y[0])
        above = stone.height if lower == len(boxes) - 1 else stone.height + body.stones[lower].height
        mass = inert[owner[upper], MASS] if owner[upper] < len(inert) else inert[owner[lower], MASS]
        law = NO_SPRINGS if contact is None else contact.of_joint(float(mass), sides[0] * sides[1], 0.5 * above, points**2)
        constants[j, [SIGMA, LEVEL]] = sigma, sigma * boxes[carrier, 2]
        clings, slides = body.friction(stone)
        constants[j, POINT:] = (*law, clings, float(points == SHARP_POINTS), slides, rebound)
        hx, hy = boxes[carrier, :2].tolist()
        inset = (hx / points, hy / points) if points > SHARP_POINTS else (stone.inset.of(2.0 * hx), stone.inset.of(2.0 * hy))
        carried = carrying(joint, body.stones, centres) if points == SHARP_POINTS else (joint.x, joint.y)
        grids[j] = _orbits(points, *carried, np.array(centres[carrier]))
        if min(inset) > 0.0:
            worn[carrier, 1 if sigma > 0.0 else 0] = inset
    return integers, constants, grids, worn


def _orbits(points: int, x: tuple[float, float], y: tuple[float, float], place: FloatArray) -> FloatArray:
    """Return the points of a joint on the carrier's face, (orbits, 4, 3): x, y, and 1 where there is a point, mirror images together."""
    ends = 1.0 if points == SHARP_POINTS else 1.0 - 1.0 / points
    ticks = np.linspace(-ends, ends, points)[(points // 2) :] if points > 1 else np.zeros(1)
    middle = (0.5 * (x[0] + x[1]) - place[0], 0.5 * (y[0] + y[1]) - place[1])
    half = 0.5 * (x[1] - x[0]), 0.5 * (y[1] - y[0])
    grid = np.zeros((ticks.size**2, 4, 3))
    for o, (u, v) in enumerate((u, v) for u in ticks for v in ticks):
        u, v = (0.0 if abs(w) < 1e-12 else w for w in (u, v))
        for q, (su, sv) in enumerate(((1, 1), (-1, 1), (1, -1), (-1, -1))):
            real = (u > 0.0 or su > 0) and (v > 0.0 or sv > 0)
            grid[o, q] = middle[0] + su * u * half[0], middle[1] + sv * v * half[1], float(real)
    return grid


def _pair_constants(
    body: Pile,
    contact: PileContact | None,
    points: int,
    pairs: IntArray,
    boxes: FloatArray,
    owner: IntArray,
    inert: FloatArray,
    joints: IntArray,
    constants: FloatArray,
) -> FloatArray:
    """Return the constants of one corner of each pair.

    Four corners resist turning as much as a whole joint does, whose points stand at a third of their square distance: no stiffer, so
    that the step of the joints serves them too.
    """
    made = np.zeros((pairs.shape[0], JOINT - POINT))
    heights = [stone.height for stone in body.stones]
    for p, (a, b) in enumerate(pairs.tolist()):
        mass = min(inert[owner[i], MASS] for i in (a, b) if owner[i] < len(inert))
        sizes = [(4.0 * boxes[i, 0] * boxes[i, 1], i) for i in (a, b) if i < len(heights)]
        long = 0.5 * sum(heights[i] for _, i in sizes)
        if contact is not None:
            made[p, :FRICTION] = np.array(contact.of_joint(float(mass), min(sizes)[0], long, points**2)) * points**2 / 12.0
        made[p, [FRICTION, KINETIC]] = body.friction()
    for j in range(joints.shape[0]):
        made[joints[j, PAIR]] = constants[j, POINT:]
        made[joints[j, PAIR], :FRICTION] *= points**2 / 12.0
    return made
