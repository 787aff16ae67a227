"""Constraint rows of rigid contacts: columns, Delassus block, impulses and relative velocity."""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import INTEGER_TABLE, MATRIX, VECTOR

_t = types()

ARM_A, ARM_B, NORMAL, W, WI, SPIN_A, SPIN_B, IMPULSE, MIN_NORMAL_VELOCITY, MU, ROTATION_BIAS, SEARCH_DIRECTION, BILATERAL = (
    0,
    3,
    6,
    9,
    18,
    27,
    36,
    45,
    48,
    49,
    50,
    53,
    59,
)
(
    GAP,
    GAP_RATE,
    RESTITUTION_RATIO,
    PRIOR_IMPULSE,
    RIM_AXIS,
    RIM_RADIUS,
    SIMULTANEITY_WINDOW,
    LOAD_SHARE,
    PRIOR_NORMAL_FORCE,
    IMPACT_IMPULSE,
) = 60, 61, 62, 63, 66, 85, 86, 87, 88, 89
CONE_CENTRE, STATIC, KINETIC, WAS_SLIDING, SLIP_DIRECTION, SLIP_SPEED, SLIP_STATE, IMPACT_SPEED, IS_STANDING, START_IMPULSE = (
    69,
    72,
    73,
    74,
    75,
    78,
    79,
    80,
    81,
    82,
)
PENALTY, PRESSURE, TRIAL_SLIP = 92, 93, 94
FORCE_SLOPE, SLIDING_DIRECTION, LAW_CHANGE, PROJECTED, SLIP_SLOPE, LAW_STEP = SEARCH_DIRECTION, SEARCH_DIRECTION + 3, 92, 95, 98, 99
PENALTY_CENTRE, SLIP_CHANGE = LAW_STEP, SLIDING_DIRECTION
ROW_COLUMNS = 102
"""Columns of a constraint row. Arms from the centres of both bodies (3, 3), m; normal out of the second body (3); Delassus block W, the
velocity per unit impulse (9), and its inverse (9); spins per unit impulse (9, 9); impulse on the first body (3), N s; lower bound of the
normal velocity, m/s; friction coefficient in use; change of the relative velocity by rotation over half a step (3); impulse before a
sweep and search direction of the sweeps (3, 3); 1 for a bilateral row, along the normal alone. Gap, m, and its rate at the step, m/s;
restitution, negative for a plastic impact; impulse up to the impact (3); axis of the cylinder round which the contact point moves (3).
Friction: centre of the cone over the normal impulse (3), static and kinetic coefficient, 1 if the point slid, direction (3) and speed,
m/s, of the slip, and slip state in the step. Reference speed of impacts, m/s; 1 for a contact of a standing stone; impulse before the
sweeps (3); radius of the rim, m, negative if it belongs to the second body, 0 if none; share of a step within which impacts are
simultaneous; share of the impulse of a restitution row; normal force before the impact, N; and impulse of the impacts at the step (3).
Newton: slope of the impulse against the normal velocity (3) and direction of the sliding friction (3), in the columns of the search
direction, and slope of the friction across its direction; for the laws, change of the impulse (3), impulse projected on the cone (3), and
step of the impulse (3); for the convex function, in the same columns, penalty of a contact, N s per m/s, normal impulse of the friction
limit, relative velocity (3), centre of the penalty (3), and change of the velocity by the step (3)."""

LINEAR, ANGULAR, GYROSCOPIC, START_VELOCITY = 0, 3, 6, 9
VELOCITY_COLUMNS = 15
"""A body's velocity and spin, change of the spin at constant angular momentum, rad/s^2, and velocity and spin before the sweeps (6)."""


@kernel(_t.void(_t.int64, VECTOR, MATRIX, MATRIX, _t.int64, VECTOR), inline=True)
def _add_body_response(body, arm, inertias, inverses, spins, row):
    """Add the response of a body to a unit impulse at `arm` to a row: velocity of the point, and spin."""
    x, y, z = arm[0], arm[1], arm[2]
    # spin per unit impulse p: J^-1 (arm x p)
    j = inverses[body]
    m = 1.0 / inertias[body, 0]
    for i in range(3):
        a, b, c = j[3 * i], j[3 * i + 1], j[3 * i + 2]
        row[spins + 3 * i] = b * z - c * y
        row[spins + 3 * i + 1] = c * x - a * z
        row[spins + 3 * i + 2] = a * y - b * x
    # W gains arm x (J^-1 (arm x p)) + p / m, column by column
    for k in range(3):
        s0, s1, s2 = row[spins + k], row[spins + 3 + k], row[spins + 6 + k]
        row[W + k] += s1 * z - s2 * y
        row[W + 3 + k] += s2 * x - s0 * z
        row[W + 6 + k] += s0 * y - s1 * x
        row[W + 4 * k] += m


@kernel(_t.void(_t.int64, _t.int64, _t.int64, MATRIX, MATRIX, VECTOR))
def set_delassus_block(a, b, ground, inertias, inverses, row):
    """Write the Delassus block W = J M^-1 J^T of a contact, its inverse and the spin responses; the ground does not move (derived here)."""
    for i in range(W, IMPULSE):
        row[i] = 0.0
    if a != ground:
        _add_body_response(a, row[ARM_A:], inertias, inverses, SPIN_A, row)
    if b != ground:
        _add_body_response(b, row[ARM_B:], inertias, inverses, SPIN_B, row)
    # inverse of the symmetric 3 x 3 block by cofactors
    w00, w01, w02 = row[W], row[W + 1], row[W + 2]
    w11, w12, w22 = row[W + 4], row[W + 5], row[W + 8]
    c00, c01, c02 = w11 * w22 - w12 * w12, w02 * w12 - w01 * w22, w01 * w12 - w02 * w11
    d = 1.0 / (w00 * c00 + w01 * c01 + w02 * c02)
    row[WI] = c00 * d
    row[WI + 1] = c01 * d
    row[WI + 2] = c02 * d
    row[WI + 3] = c01 * d
    row[WI + 4] = (w00 * w22 - w02 * w02) * d
    row[WI + 5] = (w01 * w02 - w00 * w12) * d
    row[WI + 6] = c02 * d
    row[WI + 7] = row[WI + 5]
    row[WI + 8] = (w00 * w11 - w01 * w01) * d


@kernel(_t.void(_t.int64, _t.int64, _t.int64, MATRIX, VECTOR, _t.float64, _t.float64, _t.float64, MATRIX), inline=True)
def apply_impulse(a, b, ground, inertias, row, p0, p1, p2, velocities):
    """Apply an impulse to the first body and its opposite to the second."""
    if a != ground:
        v = velocities[a]
        m = 1.0 / inertias[a, 0]
        v[0] += m * p0
        v[1] += m * p1
        v[2] += m * p2
        j = SPIN_A
        v[3] += row[j] * p0 + row[j + 1] * p1 + row[j + 2] * p2
        v[4] += row[j + 3] * p0 + row[j + 4] * p1 + row[j + 5] * p2
        v[5] += row[j + 6] * p0 + row[j + 7] * p1 + row[j + 8] * p2
    if b != ground:
        v = velocities[b]
        m = 1.0 / inertias[b, 0]
        v[0] -= m * p0
        v[1] -= m * p1
        v[2] -= m * p2
        j = SPIN_B
        v[3] -= row[j] * p0 + row[j + 1] * p1 + row[j + 2] * p2
        v[4] -= row[j + 3] * p0 + row[j + 4] * p1 + row[j + 5] * p2
        v[5] -= row[j + 6] * p0 + row[j + 7] * p1 + row[j + 8] * p2


@kernel(_t.UniTuple(_t.float64, 3)(_t.int64, _t.int64, VECTOR, MATRIX), inline=True)
def relative_velocity(a, b, row, velocities):
    """Return the velocity of the contact point of the first body relative to the second."""
    u, v = velocities[a], velocities[b]
    x, y, z = row[ARM_A], row[ARM_A + 1], row[ARM_A + 2]
    r, s, t = row[ARM_B], row[ARM_B + 1], row[ARM_B + 2]
    return (
        u[0] + (u[4] * z - u[5] * y) - v[0] - (v[4] * t - v[5] * s),
        u[1] + (u[5] * x - u[3] * z) - v[1] - (v[5] * r - v[3] * t),
        u[2] + (u[3] * y - u[4] * x) - v[2] - (v[3] * s - v[4] * r),
    )


@kernel(_t.void(VECTOR), inline=True)
def centre_friction_cone(row):
    """Centre the friction cone on the normal, with the kinetic coefficient if the point slid, else the static one."""
    row[MU] = row[KINETIC] if row[WAS_SLIDING] > 0.0 else row[STATIC]
    for k in range(CONE_CENTRE, CONE_CENTRE + 3):
        row[k] = 0.0


@kernel(_t.void(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, _t.float64, MATRIX))
def apply_impulses(n, contact_ids, rows, ground, inertias, fraction, velocities):
    """Apply a fraction of the impulses of `n` contacts to the velocities."""
    for i in range(n):
        row = rows[i]
        p0, p1, p2 = fraction * row[IMPULSE], fraction * row[IMPULSE + 1], fraction * row[IMPULSE + 2]
        if p0 != 0.0 or p1 != 0.0 or p2 != 0.0:
            apply_impulse(contact_ids[i, 0], contact_ids[i, 1], ground, inertias, row, p0, p1, p2, velocities)
