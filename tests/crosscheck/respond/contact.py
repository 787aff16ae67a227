"""A block on two corners as a complementarity problem: Jacobians, a mass matrix, and every contact state tried in turn.

Nothing here knows the equations of rocking or of sliding. A corner is open (None), sticks (0) or slips towards +x or -x (+1, -1); a
mode is the pair of the right and the left corner. The coordinates are (x, y, theta) of the centre, theta clockwise, all forces are per
unit of mass, and the mass matrix is diag(1, 1, k2).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

RIGHT, LEFT = range(2)
FLIGHT, REST = (None, None), (0, 0)
ORDER = (REST, (0, None), (None, 0), (1, 1), (-1, -1), (1, None), (None, 1), (-1, None), (None, -1), FLIGHT)
"""The first consistent mode follows."""

TOLERANCE = 1e-10
"""Slack of the inequalities, in g."""

PAINLEVE = 1e-8
"""Least mobility along the normal at which a slipping corner is a mode."""


@dataclass(frozen=True)
class Body:
    """Body and its contact corners: arms to the right and the left corner, height, squared gyration radius."""

    arms: tuple[float, float]
    h: float
    k2: float
    mu: float
    mu_kinetic: float
    restitution: float = 0.0
    rocking_restitution: float | None = None
    gravity: float = 9.80665
    points: tuple[tuple[float, float], ...] = ()

    @property
    def slow(self) -> float:
        """Speed below which a hop is over, m/s."""
        return 1e-12 * math.sqrt(self.gravity * math.hypot(max(self.arms), self.h))


class Push(NamedTuple):
    """Forces per unit mass: ground acceleration along x, and gravity with the vertical ground acceleration."""

    along: float
    weight: float


class Reaction(NamedTuple):
    """Forces of the ground in one mode, the acceleration that follows, and what a corner alone on the ground yields to its force."""

    normal: tuple[float, float]
    tangential: float
    acceleration: tuple[float, float, float]
    mobility: float


def lever(body: Body, corner: int, theta: float) -> tuple[float, float]:
    """Return the vector from the centre to a corner."""
    xi = body.arms[RIGHT] if corner == RIGHT else -body.arms[LEFT]
    s, c = math.sin(theta), math.cos(theta)
    return xi * c - body.h * s, -xi * s - body.h * c


def jacobians(body: Body, theta: float):
    """Return, for each corner, the rows that take the velocities to its normal and its tangential velocity."""
    levers = lever(body, RIGHT, theta), lever(body, LEFT, theta)
    return tuple(((0.0, 1.0, -rx), (1.0, 0.0, ry)) for rx, ry in levers)


def centripetal_acceleration(rows, omega: float) -> tuple[float, float]:
    """Return a corner's normal and tangential acceleration while the centre and the spin keep their velocities."""
    normal, tangent = rows
    return -tangent[2] * omega**2, normal[2] * omega**2


def mobility(body: Body, row, column) -> float:
    """Return the velocity along a row that a unit impulse along a column gives."""
    return row[0] * column[0] + row[1] * column[1] + row[2] * column[2] / body.k2


def component_along(row, motion) -> float:
    """Return the component of a velocity or acceleration along a row."""
    return row[0] * motion[0] + row[1] * motion[1] + row[2] * motion[2]


def velocity_change(body: Body, columns, impulses) -> tuple[float, float, float]:
    """Return the change of velocity (or the acceleration) that impulses (or forces) cause."""
    x = y = turn = 0.0
    for column, p in zip(columns, impulses, strict=True):
        x, y, turn = x + p * column[0], y + p * column[1], turn + p * column[2]
    return x, y, turn / body.k2


def solve_linear(matrix, right) -> list[float]:
    """Return the solution of a few linear equations by elimination with pivoting."""
    if len(right) == 1:
        return [right[0] / matrix[0][0]]
    rows = [[*row, value] for row, value in zip(matrix, right, strict=True)]
    n = len(rows)
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(i + 1, n):
            factor = rows[k][i] / rows[i][i]
            rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i], strict=True)]
    x = [0.0] * n
    for i in reversed(range(n)):
        x[i] = (rows[i][n] - sum(rows[i][k] * x[k] for k in range(i + 1, n))) / rows[i][i]
    return x


def constraint_impulses(body: Body, jacobian, mode, targets) -> tuple[list, list[float]]:
    """Return columns and strengths of the impulses that give closed corners their normal and sticking ones their tangential velocity.

    `targets` holds, for each corner, what is missing along the normal and along the tangent. With both feet down the two
    tangential rows are one.
    """
    rows, columns, missing = [], [], []
    gripped = False
    for corner, contact in enumerate(mode):
        if contact is None:
            continue
        normal, tangent = jacobian[corner]
        rows.append(normal)
        missing.append(targets[corner][0])
        if contact:
            rub = -contact * body.mu_kinetic
            columns.append((normal[0] + rub * tangent[0], normal[1] + rub * tangent[1], normal[2] + rub * tangent[2]))
            continue
        columns.append(normal)
        if not gripped:
            rows.append(tangent)
            columns.append(tangent)
            missing.append(targets[corner][1])
            gripped = True
    return columns, solve_linear([[mobility(body, row, column) for column in columns] for row in rows], missing)


def split_impulses(body: Body, mode, strengths) -> tuple[tuple[float, float], float]:
    """Return the normal impulse of each corner and the tangential one of both."""
    normal, tangential, rest = [0.0, 0.0], 0.0, list(strengths)
    gripped = False
    for corner, contact in enumerate(mode):
        if contact is None:
            continue
        normal[corner] = rest.pop(0)
        if contact:
            tangential -= contact * body.mu_kinetic * normal[corner]
        elif not gripped:
            tangential += rest.pop(0)
            gripped = True
    return (normal[RIGHT], normal[LEFT]), tangential


def reaction(body: Body, jacobian, omega: float, push: Push, mode) -> Reaction:
    """Return forces and acceleration in one mode, whether or not they are admissible."""
    free = (-push.along, -push.weight, 0.0)
    if mode == FLIGHT:
        return Reaction((0.0, 0.0), 0.0, free, 1.0)
    missing = [[-a for a in corner_acceleration(rows, omega, free)] for rows in jacobian]
    columns, strengths = constraint_impulses(body, jacobian, mode, missing)
    gained = velocity_change(body, columns, strengths)
    acceleration = (free[0] + gained[0], free[1] + gained[1], free[2] + gained[2])
    normal, tangential = split_impulses(body, mode, strengths)
    first = RIGHT if mode[RIGHT] is not None else LEFT
    return Reaction(normal, tangential, acceleration, mobility(body, jacobian[first][0], columns[0]))


def corner_acceleration(rows, omega: float, acceleration) -> tuple[float, float]:
    """Return a corner's normal and tangential acceleration."""
    extra = centripetal_acceleration(rows, omega)
    return component_along(rows[0], acceleration) + extra[0], component_along(rows[1], acceleration) + extra[1]


def is_admissible(body: Body, theta: float, omega: float, slip: float, touching, push: Push, mode) -> bool:
    """Say whether a mode's forces press, hold and move every touching corner the way the mode claims."""
    slack = TOLERANCE * body.gravity
    closed = [corner for corner in touching if mode[corner] is not None]
    jacobian = jacobians(body, theta)
    force = reaction(body, jacobian, omega, push, mode)
    if len(closed) == 1 and mode[closed[0]] and force.mobility <= PAINLEVE:
        return False
    if any(force.normal[corner] < -slack for corner in closed):
        return False
    for corner in touching:
        upwards, sideways = corner_acceleration(jacobian[corner], omega, force.acceleration)
        contact = mode[corner]
        if contact is None:
            if upwards < -slack:
                return False
        elif contact == 0:
            if abs(force.tangential) > body.mu * sum(force.normal) + slack:
                return False
        elif slip == 0.0 and contact * sideways < -slack:
            return False
    return True


def consistent_mode(body: Body, theta: float, omega: float, slip: float, touching, push: Push, exclude=None):
    """Return the first consistent mode of the touching corners, all of which have one slip velocity, or None: a jam."""
    for mode in ORDER:
        if mode == exclude or any(mode[corner] is not None and corner not in touching for corner in (RIGHT, LEFT)):
            continue
        contacts = [contact for contact in mode if contact is not None]
        if slip != 0.0 and any(contact != math.copysign(1, slip) for contact in contacts):
            continue
        if is_admissible(body, theta, omega, slip, touching, push, mode):
            return mode
    return None
