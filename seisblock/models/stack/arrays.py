"""Arrays of a pile for the kernels: bodies, boxes, joints and their contact points, hulls, contact memory."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seisblock.bodies.edge_wear import SHARP_EDGES
from seisblock.bodies.pile.contact import PileContact
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import Joint, bearing_rectangle
from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_
from seisblock.core.limits import MAX_JOINT_POINTS, check_limit
from seisblock.core.typing import FloatArray, IntArray
from seisblock.models.stack.buffers import PileLayout, PileMemory
from seisblock.models.stack.constraint_assembly import CONTACT_ID_COLUMNS, STEP_INFO_COLUMNS
from seisblock.models.stack.constraint_row import ROW_COLUMNS, VELOCITY_COLUMNS
from seisblock.models.stack.frames import BODY, BOX, BOX_CENTRE, INERTIA, INERTIA_COLUMNS, INVERSE, MASS, Q, R, X
from seisblock.models.stack.hull_pairs import SHARP_CORNERS
from seisblock.models.stack.hulls import MAX_CORNERS, WearDepths, build_hulls, shape_kernels
from seisblock.models.stack.newton import WORK_COLUMNS
from seisblock.models.stack.sleeping import SUPPORT_COLUMNS
from seisblock.models.stack.spring_contact import FRICTION, KINETIC, SLOT
from seisblock.models.stack.step import BOX_EDGES, CARRIER, JOINT, LEVEL, ORBITS, PAIR, PARTNER, POINT, SCRATCH_ROWS, SIGMA
from seisblock.records.motion import UP

GROUND_HALF, GROUND_DEPTH = 1e5, 50.0
"""Half width and half depth of the box that represents the ground over the longest side of a stone: wide enough for a drum that rolls
far."""

PLASTIC_RESTITUTION = -1.0
"""Restitution of joints without a given value: negative marks a plastic impact."""

CORNER_POINTS = 2
"""Points along each side of a joint for which the points stand at its corners."""

NO_SPRINGS = (0.0, 0.0, 0.0, 0.0)
MAX_FREE_CONTACTS = 80
"""Capacity for rigid contacts other than those of joints, per body."""


@dataclass(frozen=True, eq=False)
class PileArrays:
    """Arrays of a pile in its initial position, before it settles on its contact springs.

    Parameters
    ----------
    body : Pile
    points : int
        Contact points along each side of a joint.
    bodies : (m + 1, 31) array
        State; the ground last.
    inertias : (m, 19) array
        Masses, inertia matrices and their inverses.
    boxes, owner : (b + 1, 6), (b + 1,) arrays
        Half sizes and centres of the boxes, m, and the body each belongs to; the ground last.
    cores, rims : (b + 1, 3), (b + 1, 4, 2) arrays
        Half sizes of the box used for contacts of a stone that has tilted off its joint, and the bounding circles of a cylinder.
    joints, constants, grids : arrays
        Joints; columns in :mod:`seisblock.models.stack.step`.
    pairs, pair_constants : (p, 2), (p, 7) arrays
        Pairs of boxes that may touch, and the contact constants of one of their corners.
    corners, counts, edges : arrays
        Corners of each box, their number, and the pairs of corners that make its edges.
    members : tuple of tuples of int
        Stones of each body.
    """

    body: Pile
    points: int
    bodies: FloatArray
    inertias: FloatArray
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
        """Constant arrays, in the order in which the kernels take them, and kernels for the shapes of the stones."""
        shapes = shape_kernels(has_worn=bool((self.counts > SHARP_CORNERS).any()), has_round=bool(self.rims.any()))
        return PileLayout(**{name: getattr(self, name) for name in PileLayout._fields if name != "shapes"}, shapes=shapes)

    def memory(self) -> PileMemory:
        """Return zeroed contact memory of the right shapes."""
        n, p, bodies = self.joints.shape[0], self.pairs.shape[0], self.bodies.shape[0]
        max_contacts = n * self.points**2 + MAX_FREE_CONTACTS * bodies
        return PileMemory(
            np.zeros((n, self.grids.shape[1], 4, 2)),
            np.zeros((n, self.grids.shape[1], 4, SLOT)),
            np.zeros((p, 2, MAX_CORNERS, SLOT)),
            np.zeros((p, 2, 2 * BOX_EDGES, SLOT)),
            np.zeros(p, dtype=np.int64),
            np.zeros((bodies, bodies)),
            np.zeros((self.boxes.shape[0], BOX)),
            np.zeros((SCRATCH_ROWS, 18)),
            np.zeros((max_contacts, CONTACT_ID_COLUMNS), dtype=np.int64),
            np.zeros((max_contacts, ROW_COLUMNS)),
            np.zeros((bodies, 9)),
            np.zeros((bodies, VELOCITY_COLUMNS)),
            np.zeros(STEP_INFO_COLUMNS),
            np.zeros((bodies, bodies, 36)),
            np.zeros((bodies, WORK_COLUMNS)),
            # the ground counts as a sleeping body with one support point, so that stones can fall asleep on it
            np.repeat([[0, 0, 0], [1, 0, 0]], [bodies - 1, 1], axis=0),
            np.zeros((bodies, 1 + MAX_CORNERS, SUPPORT_COLUMNS)),
        )


def pile_arrays(body: Pile, contact: PileContact | None, points: int, restitution: float = PLASTIC_RESTITUTION) -> PileArrays:
    """Return the arrays of a pile ([Furukawa2009]_ section 3(1)).

    Parameters
    ----------
    body : Pile
    contact : PileContact or None
        Springs and dashpots; None: rigid contact.
    points : int
        Contact points along each side of a joint: 2 stand at the corners of the shared area and follow it as stones slide; 3 or more stand
        at the centres of as many segments (5 in [Furukawa2009]_, which puts the pivots at 0.8 of the half width).
    restitution : float, 1
        Of the joints, a ratio of velocities; negative: plastic impact.

    Raises
    ------
    ParameterError
        If `points` is no integer, less than 2 or above the limit; if cylinders are combined with springs or a grid of points, or stones
        with edge wear with a grid.
    """
    checks.integer("the number of points along each side of a joint", points, minimum=2)
    check_limit(N_("points along each side of a joint"), points, MAX_JOINT_POINTS)
    _check_bases(body, contact, points)
    centres = np.array(body.centres())
    # along the longest extent: touching bodies then have close indices, and the factor of the Newton solver is narrow
    axis = int(np.ptp(centres, axis=0).argmax())
    members = tuple(sorted(body.bodies(), key=lambda group: centres[list(group), axis].mean()) if axis != UP else body.bodies())
    bodies, inertias, owner = _bodies(body, members, centres)
    # stones joined by a dowel share a body, and fixed stones belong to the ground: their joints carry no contacts
    joints = [joint for joint in body.joints() if joint.lower < 0 or owner[joint.upper] != owner[joint.lower]]
    joints = [joint for joint in joints if owner[joint.upper] != len(members) or (joint.lower >= 0 and owner[joint.lower] != len(members))]
    boxes = np.zeros((len(body.stones) + 1, BOX))
    for i, stone in enumerate(body.stones):
        boxes[i, :3] = 0.5 * np.array(stone.size)
        boxes[i, BOX_CENTRE:] = centres[i] - bodies[owner[i], X : X + 3]
    # the ground's upper face is the plane z = 0
    length = 2.0 * float(boxes[:-1, :3].max())
    half, depth = GROUND_HALF * length, GROUND_DEPTH * length
    boxes[-1] = (half, half, depth, 0.0, 0.0, -depth)
    pairs = np.array([(i, j) for i in range(len(boxes)) for j in range(i + 1, len(boxes)) if owner[i] != owner[j]], dtype=np.int64)
    integers, constants, grids, wear = _joint_arrays(body, contact, points, restitution, joints, boxes, owner, inertias, pairs)
    corners, counts, edges, cores, rims = build_hulls(body, boxes, wear)
    return PileArrays(
        body,
        points,
        bodies,
        inertias,
        boxes,
        owner,
        cores,
        rims,
        integers,
        constants,
        grids,
        pairs,
        _pair_constants(body, contact, points, pairs, boxes, owner, inertias, integers, constants),
        corners,
        counts,
        edges,
        members,
    )


def _check_bases(body: Pile, contact: PileContact | None, points: int) -> None:
    """Raise ParameterError for bases that the contact model does not support."""
    for stone in body.stones:
        if stone.is_round and (contact is not None or points != CORNER_POINTS):
            raise ParameterError(
                "the stone {name} is a cylinder, which requires rigid contact at the edges: omit `contact` and `points`",
                name=stone.name,
            )
        if points != CORNER_POINTS and stone.inset != SHARP_EDGES:
            raise ParameterError(
                "edge wear requires contact at the edges: omit `points` ({points} along each side of a joint)",
                points=points,
            )


def _bodies(body: Pile, members: tuple[tuple[int, ...], ...], centres: FloatArray) -> tuple[FloatArray, FloatArray, IntArray]:
    """Return state and inertia of the bodies, and the body of each box; fixed stones belong to the ground."""
    bodies = np.zeros((len(members) + 1, BODY))
    bodies[:, Q] = 1.0
    bodies[:, R : R + 9] = np.eye(3).ravel()
    inertias = np.zeros((len(members), INERTIA_COLUMNS))
    owner = np.full(len(body.stones) + 1, len(members), dtype=np.int64)
    for b, group in enumerate(members):
        masses = np.array([body.stones[i].mass for i in group])
        centroid = masses @ centres[list(group)] / masses.sum()
        tensor = np.zeros((3, 3))
        for i, mass in zip(group, masses, strict=True):
            stone, arm = body.stones[i], centres[i] - centroid
            size = np.array(stone.size)
            # box with sides a, b, c: (b^2 + c^2)/12 about the first axis
            moments = stone.gyration_squared if stone.is_round else (size @ size - size**2) / 12.0
            # parallel-axis theorem
            tensor += mass * (np.diag(moments) + (arm @ arm) * np.eye(3) - np.outer(arm, arm))
            owner[i] = b
        bodies[b, X : X + 3] = centroid
        inertias[b, MASS] = masses.sum()
        inertias[b, INERTIA:INVERSE] = tensor.ravel()
        inertias[b, INVERSE:] = np.linalg.inv(tensor).ravel()
    return bodies, inertias, owner


def _joint_arrays(
    body: Pile,
    contact: PileContact | None,
    points: int,
    restitution: float,
    joints: list[Joint],
    boxes: FloatArray,
    owner: IntArray,
    inertias: FloatArray,
    pairs: IntArray,
) -> tuple[IntArray, FloatArray, FloatArray, WearDepths]:
    """Return integers, constants and points of the joints, and the wear depth of the bearing faces along x and y, m."""
    half_orbits = (points + 1) // 2
    integers = np.zeros((len(joints), 4), dtype=np.int64)
    constants = np.zeros((len(joints), JOINT))
    grids = np.zeros((len(joints), half_orbits**2, 4, 3))
    wear: WearDepths = {}
    centres = body.centres()
    pair_index = {tuple(pair): p for p, pair in enumerate(pairs.tolist())}
    for j, joint in enumerate(joints):
        upper, lower = joint.upper, joint.lower if joint.lower >= 0 else len(boxes) - 1
        # the smaller face carries the points: all of them then lie on the larger face while the joint is flush
        upper_is_smaller = boxes[upper, 0] * boxes[upper, 1] <= boxes[lower, 0] * boxes[lower, 1]
        carrier, partner = (upper, lower) if upper_is_smaller else (lower, upper)
        sigma = -1.0 if upper_is_smaller else 1.0
        integers[j, [CARRIER, PARTNER, ORBITS]] = carrier, partner, half_orbits**2
        integers[j, PAIR] = pair_index[min(carrier, partner), max(carrier, partner)]
        stone = body.stones[upper]
        sides = (joint.x[1] - joint.x[0], joint.y[1] - joint.y[0])
        total_height = stone.height if lower == len(boxes) - 1 else stone.height + body.stones[lower].height
        mass = inertias[owner[upper], MASS] if owner[upper] < len(inertias) else inertias[owner[lower], MASS]
        spring_constants = (
            NO_SPRINGS if contact is None else contact.point_coefficients(float(mass), sides[0] * sides[1], 0.5 * total_height, points**2)
        )
        constants[j, [SIGMA, LEVEL]] = sigma, sigma * boxes[carrier, 2]
        mu_static, mu_kinetic = body.friction(stone)
        # points at the very corners are clamped to the border of the face, see spring_contact
        constants[j, POINT:] = (*spring_constants, mu_static, float(points == CORNER_POINTS), mu_kinetic, restitution)
        hx, hy = boxes[carrier, :2].tolist()
        # a grid of points acts like a worn edge: its outermost row stands half a segment inside the face
        inset = (hx / points, hy / points) if points > CORNER_POINTS else (stone.inset.inset(2.0 * hx), stone.inset.inset(2.0 * hy))
        contact_area = bearing_rectangle(joint, body.stones, centres) if points == CORNER_POINTS else (joint.x, joint.y)
        grids[j] = _joint_points(points, *contact_area, np.array(centres[carrier]))
        if min(inset) > 0.0:
            wear[carrier, 1 if sigma > 0.0 else 0] = inset
    return integers, constants, grids, wear


def _joint_points(points: int, x: tuple[float, float], y: tuple[float, float], centre: FloatArray) -> FloatArray:
    """Return the points of a joint on the carrier's face, (orbits, 4, 3): x, y, m, and 1 where a point exists.

    The four entries of an orbit are mirror images of each other.
    """
    # centres of equal segments: the outermost ones stand half a segment inside
    ends = 1.0 if points == CORNER_POINTS else 1.0 - 1.0 / points
    ticks = np.linspace(-ends, ends, points)[(points // 2) :] if points > 1 else np.zeros(1)
    middle = (0.5 * (x[0] + x[1]) - centre[0], 0.5 * (y[0] + y[1]) - centre[1])
    half = 0.5 * (x[1] - x[0]), 0.5 * (y[1] - y[0])
    grid = np.zeros((ticks.size**2, 4, 3))
    for o, (u, v) in enumerate((u, v) for u in ticks for v in ticks):
        # a point on an axis of symmetry has two images, a central one has one
        u, v = (0.0 if abs(w) < 1e-12 else w for w in (u, v))
        for q, (su, sv) in enumerate(((1, 1), (-1, 1), (1, -1), (-1, -1))):
            exists = (u > 0.0 or su > 0) and (v > 0.0 or sv > 0)
            grid[o, q] = middle[0] + su * u * half[0], middle[1] + sv * v * half[1], float(exists)
    return grid


def _pair_constants(
    body: Pile,
    contact: PileContact | None,
    points: int,
    pairs: IntArray,
    boxes: FloatArray,
    owner: IntArray,
    inertias: FloatArray,
    joints: IntArray,
    constants: FloatArray,
) -> FloatArray:
    """Return the contact constants of one corner of each pair of boxes.

    Four corners get the rotational stiffness of a whole joint, whose points stand at a third of the squared distance (derived here). They
    are no stiffer than the joint, so that a stable step of the joints is stable for them too.
    """
    rows = np.zeros((pairs.shape[0], JOINT - POINT))
    heights = [stone.height for stone in body.stones]
    for p, (a, b) in enumerate(pairs.tolist()):
        mass = min(inertias[owner[i], MASS] for i in (a, b) if owner[i] < len(inertias))
        sizes = [(4.0 * boxes[i, 0] * boxes[i, 1], i) for i in (a, b) if i < len(heights)]
        length = 0.5 * sum(heights[i] for _, i in sizes)
        # n^2 points at a mean square distance of 1/3 of the corners', shared by four corners: n^2/12
        if contact is not None:
            rows[p, :FRICTION] = np.array(contact.point_coefficients(float(mass), min(sizes)[0], length, points**2)) * points**2 / 12.0
        rows[p, [FRICTION, KINETIC]] = body.friction()
    # a pair that shares a joint has the friction of that joint
    for j in range(joints.shape[0]):
        rows[joints[j, PAIR]] = constants[j, POINT:]
        rows[joints[j, PAIR], :FRICTION] *= points**2 / 12.0
    return rows
