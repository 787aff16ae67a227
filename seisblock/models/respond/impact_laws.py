"""Impact laws of a rigid body: Routh's path for one corner, Moreau's plastic law for two simultaneous corners.

Impulses are per unit mass: P normal, T tangential. With r from the centre of gravity to the struck corner, its normal velocity u changes
by nn P + tn T and its slip velocity v by tn P + tt T, where nn = 1 + r_x^2/k^2, tt = 1 + r_y^2/k^2, tn = -r_x r_y/k^2; the velocity of
the centre of gravity changes by (T, P) and the angular velocity by (r_y T - r_x P)/k^2 (derived here).
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import VECTOR
from seisblock.models.respond.constants import ARM_LEFT, ARM_RIGHT, GYRATION, HEIGHT, MU_KINETIC, corner_offset, corner_position

_t = types()

UNREACHED = 1e300
"""Target impulse before the end of compression is known."""

ROUND_OFF = 1e-13
"""Tolerance, over the sum of moments, for a resultant at the edge of the base."""

MAX_SEGMENTS = 8
"""Upper bound of the segments of Routh's path: slip, stick or reverse slip, split at maximum compression."""


@kernel(_t.UniTuple(_t.float64, 4)(_t.float64, _t.float64, _t.float64, _t.float64, _t.float64, _t.float64, _t.float64, _t.boolean))
def routh(u, v, nn, tt, tn, mu, restitution, has_tenon):
    """Return P, T, u and v after the impact of one corner: Routh's path with Poisson's restitution ([WangMason1992]_).

    Parameters
    ----------
    u, v : float, m/s
        Normal velocity, not positive, and slip velocity before the impact.
    nn, tt, tn : float
        Mobilities per unit mass.
    mu, restitution : float
    has_tenon : bool
        True where a tenon holds the corner: unlimited friction, which stops the slip before the normal impulse (extension).
    """
    normal = 0.0
    tangential = 0.0
    if has_tenon:
        # the tenon stops the slip first; through tn this changes u, which may end the approach before any normal
        # impulse acts
        tangential = -v / tt
        u -= tn / tt * v
        v = 0.0
        if u >= 0.0:
            return normal, tangential, u, v
    target = UNREACHED
    compresses = True
    # s: direction of slip, 0 in stick. Friction opposes it along the path, not only at its ends: Routh's path handles
    # a slip that stops or reverses within the impact.
    s = 1.0 if v > 0.0 else -1.0 if v < 0.0 else 0.0
    for _ in range(MAX_SEGMENTS):
        # dT/dP of the segment: slip at the friction limit, or the ratio that keeps v = 0 if friction allows
        ratio = -s * mu
        if s == 0.0:
            ratio = -tn / tt
            # stick needs an impulse ratio inside the friction cone; otherwise the slip resumes in the direction in
            # which tn P drives v
            if not has_tenon and abs(tn) > mu * tt:
                s = 1.0 if tn > 0.0 else -1.0
                ratio = -s * mu
        du = nn + tn * ratio
        dv = tn + tt * ratio
        step = target - normal
        stops = False
        if v != 0.0 and v * dv < 0.0:
            to_stop = -v / dv
            if to_stop <= step:
                step = to_stop
                stops = True
        # maximum compression, u = 0. Where du <= 0 the slip still compresses the contact (above Painleve's limit) and
        # only the stick that follows can turn it.
        turns = compresses and du > 0.0 and -u / du < step
        if turns:
            step = -u / du
            stops = False
        normal += step
        tangential += ratio * step
        u += du * step
        # exactly zero in stick, so that the round-off of tn + tt ratio cannot restart a slip
        v = 0.0 if stops or s == 0.0 else v + dv * step
        if stops:
            s = 0.0
        elif turns:
            # Poisson: the impulse of restitution is e times that of compression, whatever the path. Newton's ratio of
            # velocities could create energy here.
            u = 0.0
            target = (1.0 + restitution) * normal
            compresses = False
            if restitution == 0.0:
                break
        else:
            break
    return normal, tangential, u, v


@kernel(_t.UniTuple(_t.float64, 4)(_t.boolean, _t.float64, _t.float64, _t.float64, _t.float64, _t.float64, VECTOR, _t.boolean))
def corner_impact(right, theta, omega, u, v, restitution, p, has_tenon):
    """Return theta', u, v after an impact at one corner, and the energy loss, J/kg ([WangMason1992]_).

    The loss is the work of the impulses on the mean of the velocities before and after, which is exact for a rigid body.
    """
    rx, ry = corner_position(right, theta, p)
    k = p[GYRATION]
    normal, tangential, u_after, v_after = routh(
        u, v, 1.0 + rx * rx / k, 1.0 + ry * ry / k, -rx * ry / k, p[MU_KINETIC], restitution, has_tenon
    )
    loss = -0.5 * (normal * (u + u_after) + tangential * (v + v_after))
    return omega + (ry * tangential - rx * normal) / k, u_after, v_after, loss


@kernel(_t.UniTuple(_t.float64, 3)(_t.boolean, _t.float64, _t.float64, _t.float64, _t.float64, VECTOR))
def resolve_jam(right, theta, omega, v, restitution, p):
    """Return theta', u and the energy loss, J/kg, of a jam: an impact without collision ([GenotBrogliato1999]_).

    Routh's path starts at u = 0, goes to u < 0 while the corner slips, and returns to u = 0 after it sticks. The impulses at maximum
    compression are therefore those that stop both u and v, independent of the path; restitution follows in stick.
    """
    rx, ry = corner_position(right, theta, p)
    k = p[GYRATION]
    nn, tt, tn = 1.0 + rx * rx / k, 1.0 + ry * ry / k, -rx * ry / k
    # v = 0 gives T = -(v + tn P)/tt; inserted in u = nn P + tn T = 0, this yields P at maximum compression
    mobility = nn - tn * tn / tt
    compression = tn * v / (tt * mobility)
    normal = (1.0 + restitution) * compression
    tangential = -(v + tn * normal) / tt
    u = mobility * restitution * compression
    return omega + (ry * tangential - rx * normal) / k, u, -0.5 * (normal * u + tangential * v)


CLOSED_NONE, CLOSED_LEFT, CLOSED_RIGHT, CLOSED_BOTH = range(4)
"""Corners that remain in contact after a plastic impact of both."""


@kernel(_t.Tuple((_t.int64, _t.float64, _t.float64, _t.float64))(_t.float64, _t.float64, _t.float64, VECTOR, _t.boolean))
def both_corners_impact(omega, rise, speed, p, has_tenon):
    """Return closed corners, theta', slip velocity and energy loss, J/kg, of a plastic impact of both corners ([Moreau1988]_).

    Parameters
    ----------
    omega, rise, speed : float, rad/s, m/s
        theta', y' and x' of the upright body before the impact.
    p : array
    has_tenon : bool
        True while tenons hold the feet.

    Notes
    -----
    The first consistent case is taken: both corners closed, sticking or slipping; the right corner alone, sticking or slipping in either
    direction; the left corner likewise; none. Closed: u = 0, P >= 0; open: u >= 0; abs(T) <= mu P in stick, T = -sign(v) mu P in slip.
    """
    k = p[GYRATION]
    h = p[HEIGHT]
    mu = p[MU_KINETIC]
    # both closed: theta' = y' = 0, the resultant between the corners
    normal = -rise
    if normal >= 0.0:
        s = 1.0 if speed > 0.0 else -1.0
        sticks = has_tenon or abs(speed) <= mu * normal
        tangential = -speed if sticks else -s * mu * normal
        # moment balance for theta' = 0 after the impact: the resultant acts at (k^2 theta' - h T)/P, which must lie
        # on the base. Both sides are multiplied by P, so that P = 0 needs no division.
        moment = k * omega - h * tangential
        # a resultant exactly at a corner satisfies this case and that of the corner alone, with the same impulses;
        # round-off must not reject both
        edge = ROUND_OFF * (abs(k * omega) + abs(h * tangential))
        if -p[ARM_LEFT] * normal - edge <= moment <= p[ARM_RIGHT] * normal + edge:
            slip_after = 0.0 if sticks else speed + tangential
            return CLOSED_BOTH, 0.0, slip_after, 0.5 * (rise * rise + k * omega * omega + speed * speed - slip_after * slip_after)
    v = speed - h * omega
    ry = -h
    for side in range(2):
        right = side == 0
        rx = corner_offset(right, p)
        # sense of rotation that lifts the other corner
        opening = 1.0 if right else -1.0
        u = rise - rx * omega
        nn, tt, tn = 1.0 + rx * rx / k, 1.0 + ry * ry / k, -rx * ry / k
        for case in range(3):
            if case == 0:
                determinant = nn * tt - tn * tn
                normal = (tn * v - tt * u) / determinant
                tangential = (tn * u - nn * v) / determinant
                slip_after = 0.0
                fits = has_tenon or abs(tangential) <= mu * normal
            else:
                s = 1.0 if case == 1 else -1.0
                normal = -u / (nn - s * mu * tn)
                tangential = -s * mu * normal
                slip_after = v + tn * normal + tt * tangential
                # the slip must keep its direction, and the normal mobility along the cone be positive: with a
                # negative one, a separating corner would be given an impulse
                fits = not has_tenon and s * slip_after > 0.0 and nn - s * mu * tn > 0.0
            omega_after = omega + (ry * tangential - rx * normal) / k
            if fits and normal >= 0.0 and opening * omega_after >= 0.0:
                loss = -0.5 * (normal * u + tangential * (v + slip_after))
                return CLOSED_RIGHT if right else CLOSED_LEFT, omega_after, slip_after, loss
    return CLOSED_NONE, omega, v, 0.0
