"""Static equilibrium of a pile on its contact springs, and admissible time steps."""

from __future__ import annotations

import math

import numpy as np

from seisblock.core import checks
from seisblock.core.errors import BodyError, ParameterError
from seisblock.core.typing import FloatArray
from seisblock.models.stack.arrays import PileArrays
from seisblock.models.stack.frames import INERTIA, INVERSE, MASS, Q, X, update_rotation_matrix
from seisblock.models.stack.step import CARRIER, PARTNER, POINT, SIGMA

STABILITY_LIMIT = 4.0
"""Leapfrog with lagged dashpots is stable while the largest eigenvalue of dt^2 M^-1 K + 2 dt M^-1 C is below this (derived here)."""

SAFETY_FACTOR = 0.7
"""Default step over the stability limit."""

MIN_STEP_RATIO = 1e-3
"""Smallest admissible step over the stability limit: the error falls with the square of the step and is negligible there."""

RIGID_STEP_RATIO, RIGID_MIN_STEP_RATIO, RIGID_MAX_STEP_RATIO = 0.018, 1e-5, 0.1
"""Steps for rigid contacts over the swing time of the smallest stone: default, finest and coarsest."""

RIGID_MAX_STEP = 1.0 / 300.0
"""Longest default step for rigid contacts, s: the sliding of large stones follows the ground motion, not their own swing."""

_AXES = np.eye(3)


def contact_jacobian(pile: PileArrays) -> tuple[FloatArray, FloatArray]:
    """Return the Jacobian of the contact points of the joints for small motions of the bodies.

    Returns
    -------
    rows : (points, 3, 6 m) array
        Displacement of the upper side relative to the lower one along x, y and z, per unit displacement (3) and rotation (3) of each body.
    index : (points, 3) array
        Joint, orbit and image of each point.
    """
    m = pile.inertias.shape[0]
    rows, index = [], []
    for j, (joint, k) in enumerate(zip(pile.joints, pile.constants, strict=True)):
        for o, q in zip(*np.nonzero(pile.grids[j, :, :, 2] > 0.0), strict=True):
            carrier, partner = (int(pile.owner[joint[i]]) for i in (CARRIER, PARTNER))
            box = pile.boxes[joint[CARRIER]]
            position = pile.bodies[carrier, X : X + 3] + box[3:] + [*pile.grids[j, o, q, :2], k[SIGMA] * box[2]]
            row = np.zeros((3, 6 * (m + 1)))
            # displacement of the upper stone relative to the lower one; the carrier is the upper stone if sigma is -1
            for body, sign in ((carrier, -k[SIGMA]), (partner, k[SIGMA])):
                arm = position - pile.bodies[body, X : X + 3]
                row[:, 6 * body : 6 * body + 3] += sign * _AXES
                row[:, 6 * body + 3 : 6 * body + 6] += sign * np.cross(_AXES, arm).T
            rows.append(row[:, : 6 * m])
            index.append((j, o, q))
    return np.array(rows), np.array(index)


def stable_step(pile: PileArrays) -> float:
    """Return the largest stable step, s, of the linear pile with all points in contact and no sliding.

    The step keeps the eigenvalues of M^-1 (dt^2 K + 2 dt C) below 4 (derived here); spring and dashpot of a point are those of
    [Furukawa2009]_ table 2 or of the stones themselves.
    """
    from scipy.linalg import eigh

    rows, index = contact_jacobian(pile)
    k = pile.constants[index[:, 0]][:, POINT : POINT + 4]
    stiffness = np.einsum("pdi,pd,pdj->ij", rows, k[:, [2, 2, 0]], rows)
    damping = np.einsum("pdi,pd,pdj->ij", rows, k[:, [3, 3, 1]], rows)
    mass = _mass_matrix(pile)

    def max_eigenvalue(step: float) -> float:
        values = eigh(step**2 * stiffness + 2.0 * step * damping, mass, eigvals_only=True, subset_by_index=[len(mass) - 1, len(mass) - 1])
        return float(values[0])

    low, high = 0.0, 1.0
    while high - low > 1e-4 * high:
        # bisection, preceded by decades: the limit may be any power of ten below 1 s
        midpoint = 0.5 * (low + high) if low > 0.0 else 0.1 * high
        low, high = (midpoint, high) if max_eigenvalue(midpoint) < STABILITY_LIMIT else (low, midpoint)
    return low


def steps_per_sample(pile: PileArrays, dt: float, step: float | None) -> int:
    """Return the number of steps per sampling interval on contact springs.

    Raises
    ------
    ParameterError
        If the given step is unstable for the stiffest contact, or needlessly fine.
    """
    limit = stable_step(pile)
    if step is not None:
        checks.positive("the time step", step, "s")
    if step is not None and not step <= limit:
        raise ParameterError(
            "`step` of {step:g} s exceeds the stability limit of the pile {name}, {limit:.3g} s (stiffest contact): omit it, or "
            "give at most {most:.2g} s",
            step=step,
            name=pile.body.name,
            limit=limit,
            most=SAFETY_FACTOR * limit,
        )
    if step is not None and step < MIN_STEP_RATIO * limit:
        raise ParameterError(
            "`step` of {step:g} s is unnecessarily small: below 1/1000 of the stability limit of the pile {name}, {limit:.3g} s, "
            "the error does not decrease; omit it, or give at least {least:.2g} s",
            step=step,
            name=pile.body.name,
            limit=limit,
            least=MIN_STEP_RATIO * limit,
        )
    # the factor absorbs round-off where the step divides the sampling interval exactly
    return max(1, math.ceil(dt / (SAFETY_FACTOR * limit if step is None else step) * (1.0 - 1e-12)))


def _mass_matrix(pile: PileArrays) -> FloatArray:
    """Return the mass matrix of the free bodies, (6 m, 6 m)."""
    m = pile.inertias.shape[0]
    mass = np.zeros((6 * m, 6 * m))
    for b in range(m):
        mass[6 * b : 6 * b + 3, 6 * b : 6 * b + 3] = pile.inertias[b, MASS] * _AXES
        mass[6 * b + 3 : 6 * b + 6, 6 * b + 3 : 6 * b + 6] = pile.inertias[b, INERTIA:INVERSE].reshape(3, 3)
    return mass


def rigid_steps_per_sample(pile: PileArrays, dt: float, step: float | None, gravity: float) -> int:
    """Return the number of steps per sampling interval with rigid contacts.

    Any step is stable. The default is a share of the swing time of the smallest stone, at which overturning thresholds are within 0.5 % of
    those of much finer steps, and at most 1/300 s.

    Raises
    ------
    ParameterError
        If the given step exceeds a tenth of the swing time of the smallest stone, or is needlessly fine.
    """
    smallest_size = float(np.linalg.norm(pile.boxes[:-1, :3], axis=1).min())
    swing_time = math.sqrt(smallest_size / gravity)
    if step is not None:
        checks.positive("the time step", step, "s")
        if not RIGID_MIN_STEP_RATIO * swing_time <= step <= RIGID_MAX_STEP_RATIO * swing_time:
            raise ParameterError(
                "`step` of {step:g} s is out of range for the pile {name} with rigid contact (rocking time scale of the smallest "
                "stone {swing:.2g} s): omit it, or give {least:.2g} to {most:.2g} s",
                step=step,
                name=pile.body.name,
                swing=swing_time,
                least=RIGID_MIN_STEP_RATIO * swing_time,
                most=RIGID_MAX_STEP_RATIO * swing_time,
            )
    return max(1, math.ceil(dt / (min(RIGID_STEP_RATIO * swing_time, RIGID_MAX_STEP) if step is None else step) * (1.0 - 1e-12)))


def settle_on_springs(pile: PileArrays, gravity: float, bodies: FloatArray, stretches: FloatArray) -> None:
    """Lower the bodies onto their springs until these carry the weight; points in tension are released.

    Raises
    ------
    BodyError
        If no set of points in compression carries the pile.
    """
    rows, index = contact_jacobian(pile)
    k = pile.constants[index[:, 0]][:, POINT : POINT + 4]
    m = pile.inertias.shape[0]
    load = np.zeros(6 * m)
    load[2::6] = -pile.inertias[:, MASS] * gravity
    active_points = np.ones(len(rows), dtype=bool)
    # active set: release points in tension and solve again
    for _ in range(len(rows)):
        weights = k[:, [2, 2, 0]] * active_points[:, None]
        stiffness = np.einsum("pdi,pd,pdj->ij", rows, weights, rows)
        try:
            u = np.linalg.solve(stiffness, load)
        except np.linalg.LinAlgError:
            break
        displacements = rows @ u
        # compressed points: the upper stone has moved down relative to the lower one
        in_contact = displacements[:, 2] < 0.0
        if (in_contact == active_points).all():
            _displace(pile, u, displacements, index, bodies, stretches)
            return
        active_points = in_contact
    raise BodyError("the pile {name} is not in equilibrium on its joints: the load is too close to an edge", name=pile.body.name)


def _displace(
    pile: PileArrays, u: FloatArray, displacements: FloatArray, index: FloatArray, bodies: FloatArray, stretches: FloatArray
) -> None:
    """Write small displacements into the bodies, and the corresponding stretch of the shear springs."""
    for b in range(pile.inertias.shape[0]):
        bodies[b, X : X + 3] += u[6 * b : 6 * b + 3]
        # small rotation in Cayley's form, from the quaternion 1
        bodies[b, Q + 1 : Q + 4] = 0.5 * u[6 * b + 3 : 6 * b + 6]
        bodies[b, Q : Q + 4] /= np.linalg.norm(bodies[b, Q : Q + 4])
        update_rotation_matrix(bodies[b])
    for (j, o, q), shift in zip(index.tolist(), displacements, strict=True):
        # the stretch is the displacement of the carrier relative to its partner
        if shift[2] < 0.0:
            stretches[j, o, q] = -pile.constants[j, SIGMA] * shift[:2]
