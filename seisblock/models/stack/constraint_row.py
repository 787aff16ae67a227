"""The rows of rigid contacts: where they are, what an impulse at each does to both bodies, and how fast its points part."""

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
ROW_COLUMNS = 92
"""A contact's row: its arms from the centres of both bodies, its normal, out of the second; the velocity that a unit impulse gives (9)
and the inverse (9); the spins that it gives (9, 9); the impulse on the first body; the least normal velocity; friction; how its velocity
changes by turning in half a step (3); the impulse before a sweep, and the way that the sweeps take it (3, 3); whether the floor holds from
both sides, along the normal alone; the gap, m, and how fast it opens at the step, m/s; the restitution, negative where an impact is
plastic; the impulse that was given before the last one was looked for (3); the axis of the stone round whose rim the point wanders (3);
and of friction, the middle of its cone over what presses (3), its two coefficients, whether the point slid, in what direction (3) and how
fast, m/s, and what it does in the step; the speed, m/s, of which parts are heeded where it strikes; whether it is one of a stone that
stands; the impulse before the sweeps (3); the radius of that rim, m, negative where it is the second body's, 0 where there is none; the
part of a step within which it strikes at once with others; its part of what holds a joint that is struck; what pressed before, N; and
the impulse of the impacts at the step (3)."""

LINEAR, ANGULAR, GYROSCOPIC, START_VELOCITY = 0, 3, 6, 9
VELOCITY_COLUMNS = 15
"""A body's velocity, its spin, how that changes as the body turns on with the same angular momentum, rad/s^2, and velocity and spin before
the sweeps (6)."""


@kernel(_t.void(_t.int64, VECTOR, MATRIX, MATRIX, _t.int64, _t.float64, VECTOR), inline=True)
def _add_body_response(body, arm, inertias, inverses, spins, sign, row):
    """Add to a row what a unit impulse at `arm` does to a body: velocity there, and spin."""
    x, y, z = arm[0], arm[1], arm[2]
    j = inverses[body]
    m = 1.0 / inertias[body, 0]
    for i in range(3):
        a, b, c = j[3 * i], j[3 * i + 1], j[3 * i + 2]
        row[spins + 3 * i] = b * z - c * y
        row[spins + 3 * i + 1] = c * x - a * z
        row[spins + 3 * i + 2] = a * y - b * x
    for k in range(3):
        s0, s1, s2 = row[spins + k], row[spins + 3 + k], row[spins + 6 + k]
        row[W + k] += s1 * z - s2 * y
        row[W + 3 + k] += s2 * x - s0 * z
        row[W + 6 + k] += s0 * y - s1 * x
        row[W + 4 * k] += m


@kernel(_t.void(_t.int64, _t.int64, _t.int64, MATRIX, MATRIX, VECTOR))
def set_delassus_block(a, b, ground, inertias, inverses, row):
    """Write into a row what impulses at its point do to both bodies; the ground does not move."""
    for i in range(W, IMPULSE):
        row[i] = 0.0
    if a != ground:
        _add_body_response(a, row[ARM_A:], inertias, inverses, SPIN_A, 1.0, row)
    if b != ground:
        _add_body_response(b, row[ARM_B:], inertias, inverses, SPIN_B, 1.0, row)
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
    """Let an impulse act on the first body, and its opposite on the second."""
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
    """Return the velocity of the first body's point against the second's."""
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
    """Lay a point's cone about its normal: kinetic friction where it slid, else static."""
    row[MU] = row[KINETIC] if row[WAS_SLIDING] > 0.0 else row[STATIC]
    for k in range(CONE_CENTRE, CONE_CENTRE + 3):
        row[k] = 0.0


@kernel(_t.void(_t.int64, INTEGER_TABLE, MATRIX, _t.int64, MATRIX, _t.float64, MATRIX))
def apply_impulses(n, contact_ids, rows, ground, inertias, fraction, velocities):
    """Let a part of the impulses of `n` contacts act on the bodies."""
    for i in range(n):
        row = rows[i]
        p0, p1, p2 = fraction * row[IMPULSE], fraction * row[IMPULSE + 1], fraction * row[IMPULSE + 2]
        if p0 != 0.0 or p1 != 0.0 or p2 != 0.0:
            apply_impulse(contact_ids[i, 0], contact_ids[i, 1], ground, inertias, row, p0, p1, p2, velocities)
