"""Network of stones in contact, and its dense matrices, as input of tests of the contact solvers."""

import numpy as np

from seisblock.models.stack.constraint_row import (
    ARM_A,
    ARM_B,
    BILATERAL,
    CONE_CENTRE,
    IMPULSE,
    MIN_NORMAL_VELOCITY,
    MU,
    NORMAL,
    ROW_COLUMNS,
    VELOCITY_COLUMNS,
    set_delassus_block,
)


def network(rng, mu=0.4):
    """Return contact bodies, rows, masses, inverse inertias and velocities of five stones that touch in both orders, and the ground.

    Three contacts each, in random directions; one is bilateral, one does not act.
    """
    pairs, count = ((0, 5), (1, 0), (1, 2), (3, 0), (2, 5), (2, 3), (4, 1)), 5
    ids, rows = np.zeros((3 * len(pairs), 8), dtype=np.int64), np.zeros((3 * len(pairs), ROW_COLUMNS))
    masses, inverses = np.zeros((count, 19)), np.zeros((count + 1, 9))
    masses[:, 0] = 100.0 * rng.uniform(0.2, 1.0, count)
    for i in range(count):
        root = rng.normal(size=(3, 3))
        inverses[i] = ((root @ root.T + np.eye(3)) / masses[i, 0]).ravel()
    velocities = np.zeros((count + 1, VELOCITY_COLUMNS))
    velocities[:count, :6] = rng.normal(0.0, 0.3, (count, 6))
    for p, pair in enumerate(pairs):
        distance, normal = rng.normal(size=3), rng.normal(size=3)
        normal /= np.linalg.norm(normal)
        for k in range(3 * p, 3 * p + 3):
            row, ids[k, :2] = rows[k], pair
            row[ARM_B : ARM_B + 3] = rng.normal(size=3)
            row[ARM_A : ARM_A + 3] = row[ARM_B : ARM_B + 3] + distance
            row[NORMAL : NORMAL + 3], row[MU] = normal, mu
            slip = np.cross(normal, rng.normal(size=3))
            row[CONE_CENTRE : CONE_CENTRE + 3] = 0.1 * slip
            row[IMPULSE : IMPULSE + 3] = rng.uniform(1.0, 5.0) * (normal + 0.3 * rng.uniform() * slip)
            set_delassus_block(*pair, count, masses, inverses, row)
    rows[4, BILATERAL], rows[7, MIN_NORMAL_VELOCITY] = 1.0, -np.inf
    return ids, rows, masses, inverses, velocities


def jacobian(ids, row, count):
    """Return the (3, 6 m) matrix that turns the velocities of the bodies into the relative velocity of a contact."""
    result = np.zeros((3, 6 * count))
    for body, arm, sign in ((ids[0], row[ARM_A : ARM_A + 3], 1.0), (ids[1], row[ARM_B : ARM_B + 3], -1.0)):
        if body < count:
            x, y, z = arm
            cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
            result[:, 6 * body : 6 * body + 6] = sign * np.hstack([np.eye(3), -cross])
    return result


def mass_matrix(masses, inverses):
    """Return the (6 m, 6 m) matrix of masses and inertias."""
    result = np.zeros((6 * len(masses), 6 * len(masses)))
    for i, (mass, inverse) in enumerate(zip(masses[:, 0], inverses, strict=False)):
        result[6 * i : 6 * i + 3, 6 * i : 6 * i + 3] = mass * np.eye(3)
        result[6 * i + 3 : 6 * i + 6, 6 * i + 3 : 6 * i + 6] = np.linalg.inv(inverse.reshape(3, 3))
    return result
