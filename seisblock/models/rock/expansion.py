"""Taylor coefficients of the rocking equation over one sample, unrolled term by term.

With psi = s alpha - theta the equation theta'' = -lever [(g + a_v) sin(psi) + a cos(psi)] ([Housner1963]_, see ``model``) gives the
coefficients of omega = theta' from those of sin(psi) and cos(psi), and these from (sin psi)' = -omega cos(psi) and
(cos psi)' = omega sin(psi) (derived here). Without loops the coefficients stay in scalar or SIMD registers.
"""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX

_t = types()

THETA, OMEGA, SINE, COSINE = range(4)
"""Rows of the coefficients: the two states, then scratch."""

TERM_TOLERANCE, PREVIOUS_TERM_TOLERANCE = 3e-17, 1e-12
"""Truncation of a series: a term below the first value and the previous term below the second, relative to the state."""

LAST_TERM_TOLERANCE = 3e-15
"""Last unrolled term over the state below which the remainder is round-off (terms decrease by about 100 each)."""

TERMS = 10
"""Unrolled terms of omega: at 100 Hz further terms are below round-off for blocks of 0.1 m and more."""

QUARTER_PI, HALF_PI, HALF_PI_RESIDUAL = 0.7853981633974483, 1.5707963267948966, 6.123233995736766e-17
"""pi/4, pi/2, and pi/2 minus its double-precision value."""

S3, S5, S7, S9, S11, S13, S15 = -1 / 6, 1 / 120, -1 / 5040, 1 / 362880, -1 / 39916800, 1 / 6227020800, -1 / 1307674368000
C4, C6, C8, C10, C12, C14, C16 = 1 / 24, -1 / 720, 1 / 40320, -1 / 3628800, 1 / 479001600, -1 / 87178291200, 1 / 20922789888000


@kernel(_t.UniTuple(_t.float64, 2)(_t.float64), inline=True)
def sine_cosine(x):
    """Return sine and cosine of an angle in [-pi/2, pi/2] to one ulp, by Taylor series up to pi/4."""
    size = abs(x)
    is_steep = size > QUARTER_PI
    # sine and cosine exchange roles at pi/2 - x; the residual of pi/2 keeps the difference exact next to pi/2
    r = (HALF_PI - size) + HALF_PI_RESIDUAL if is_steep else size
    z = r * r
    zz = z * z
    # sums in independent pairs (Estrin's scheme) shorten the dependency chain
    odd = (S3 + z * S5) + zz * ((S7 + z * S9) + zz * ((S11 + z * S13) + zz * S15))
    even = (C4 + z * C6) + zz * ((C8 + z * C10) + zz * ((C12 + z * C14) + zz * C16))
    odd = r + r * z * odd
    even = 1.0 - (0.5 * z - zz * even)
    sine, cosine = (even, odd) if is_steep else (odd, even)
    return (sine if x >= 0.0 else -sine), cosine


THIRD, FIFTH, SIXTH, SEVENTH, NINTH = 1.0 / 3.0, 1.0 / 5.0, 1.0 / 6.0, 1.0 / 7.0, 1.0 / 9.0


@kernel(_t.UniTuple(_t.float64, TERMS - 1)(*[_t.float64] * 9), inline=True)
def omega_coefficients(s0, c0, w0, w1, lever, g0, g1, a0, a1):
    """Return the coefficients of omega of orders 2 to 10.

    Parameters
    ----------
    s0, c0 : float
        sin(psi) and cos(psi) at the start of the sample.
    w0, w1 : float, rad/s and rad/s^2
        Coefficients of orders 0 and 1.
    lever : float, 1/m
    g0, g1, a0, a1 : float, m/s^2 and m/s^3
        Gravity plus vertical acceleration, and horizontal acceleration: value and slope.
    """
    # the factor -lever is common to all terms of the equation
    g0, g1, a0, a1 = -lever * g0, -lever * g1, -lever * a0, -lever * a1
    # the newest terms come last in each sum, so that earlier products do not wait for them
    s1, c1 = -w0 * c0, w0 * s0
    w2 = ((g1 * s0 + a1 * c0) + (g0 * s1 + a0 * c1)) * 0.5
    s2, c2 = -(w0 * c1 + w1 * c0) * 0.5, (w0 * s1 + w1 * s0) * 0.5
    w3 = ((g1 * s1 + a1 * c1) + (g0 * s2 + a0 * c2)) * THIRD
    s3, c3 = -(w1 * c1 + w0 * c2 + w2 * c0) * THIRD, (w1 * s1 + w0 * s2 + w2 * s0) * THIRD
    w4 = ((g1 * s2 + a1 * c2) + (g0 * s3 + a0 * c3)) * 0.25
    s4, c4 = -(w1 * c2 + w2 * c1 + w0 * c3 + w3 * c0) * 0.25, (w1 * s2 + w2 * s1 + w0 * s3 + w3 * s0) * 0.25
    w5 = ((g1 * s3 + a1 * c3) + (g0 * s4 + a0 * c4)) * FIFTH
    s5, c5 = -(w1 * c3 + w2 * c2 + w3 * c1 + w0 * c4 + w4 * c0) * FIFTH, (w1 * s3 + w2 * s2 + w3 * s1 + w0 * s4 + w4 * s0) * FIFTH
    w6 = ((g1 * s4 + a1 * c4) + (g0 * s5 + a0 * c5)) * SIXTH
    s6 = -(w1 * c4 + w2 * c3 + w3 * c2 + w4 * c1 + w0 * c5 + w5 * c0) * SIXTH
    c6 = (w1 * s4 + w2 * s3 + w3 * s2 + w4 * s1 + w0 * s5 + w5 * s0) * SIXTH
    w7 = ((g1 * s5 + a1 * c5) + (g0 * s6 + a0 * c6)) * SEVENTH
    s7 = -(w1 * c5 + w2 * c4 + w3 * c3 + w4 * c2 + w5 * c1 + w0 * c6 + w6 * c0) * SEVENTH
    c7 = (w1 * s5 + w2 * s4 + w3 * s3 + w4 * s2 + w5 * s1 + w0 * s6 + w6 * s0) * SEVENTH
    w8 = ((g1 * s6 + a1 * c6) + (g0 * s7 + a0 * c7)) * 0.125
    s8 = -(w1 * c6 + w2 * c5 + w3 * c4 + w4 * c3 + w5 * c2 + w6 * c1 + w0 * c7 + w7 * c0) * 0.125
    c8 = (w1 * s6 + w2 * s5 + w3 * s4 + w4 * s3 + w5 * s2 + w6 * s1 + w0 * s7 + w7 * s0) * 0.125
    w9 = ((g1 * s7 + a1 * c7) + (g0 * s8 + a0 * c8)) * NINTH
    s9 = -(w1 * c7 + w2 * c6 + w3 * c5 + w4 * c4 + w5 * c3 + w6 * c2 + w7 * c1 + w0 * c8 + w8 * c0) * NINTH
    c9 = (w1 * s7 + w2 * s6 + w3 * s5 + w4 * s4 + w5 * s3 + w6 * s2 + w7 * s1 + w0 * s8 + w8 * s0) * NINTH
    w10 = ((g1 * s8 + a1 * c8) + (g0 * s9 + a0 * c9)) * 0.1
    return w2, w3, w4, w5, w6, w7, w8, w9, w10


@kernel(_t.Tuple((_t.float64, _t.boolean))(*[_t.float64] * 12), inline=True)
def lean_bound(h, w0, w1, w2, w3, w4, w5, w6, w7, w8, w9, w10):
    """Return a bound of the change of tilt within a step, rad, and whether the unrolled terms of omega have converged."""
    hh = h * h
    power = hh * hh * hh * hh
    previous_term, last_term = power * (abs(w9) * h), power * (abs(w10) * hh)
    late_terms = (abs(w5) + h * abs(w6)) + hh * ((abs(w7) + h * abs(w8)) + hh * (abs(w9) + h * abs(w10)))
    # sum of absolute terms, an upper bound of omega over the step
    size = abs(w0) + h * (((abs(w1) + h * abs(w2)) + hh * (abs(w3) + h * abs(w4))) + hh * hh * late_terms)
    return h * size, (last_term <= LAST_TERM_TOLERANCE * size) & (previous_term <= PREVIOUS_TERM_TOLERANCE * size)


@kernel(_t.int64(MATRIX, _t.int64, _t.boolean, *[_t.float64] * 6))
def expand_series(c, order, linear, dt, lever, g0, g1, a0, a1):
    """Write the series of tilt, angular velocity, sine and cosine in a loop up to `order`; return the degree of convergence.

    `c` must hold the first two coefficients of tilt and angular velocity and the first of sine and cosine.
    """
    omega = c[OMEGA, 0]
    power = dt
    term = abs(c[OMEGA, 1]) * dt
    size = abs(omega) + term
    share = 1.0
    for k in range(1, order):
        next_share = 1.0 / (k + 1)
        c[THETA, k + 1] = c[OMEGA, k] * next_share
        # slender option: sin(psi) becomes psi, whose derivative is -theta', and cos(psi) becomes 1
        if linear:
            c[SINE, k] = -c[THETA, k]
            c[COSINE, k] = 0.0
        else:
            sine = omega * c[COSINE, k - 1]
            cosine = omega * c[SINE, k - 1]
            for j in range(1, k):
                sine += c[OMEGA, j] * c[COSINE, k - 1 - j]
                cosine += c[OMEGA, j] * c[SINE, k - 1 - j]
            c[SINE, k] = -sine * share
            c[COSINE, k] = cosine * share
        moment = g0 * c[SINE, k] + g1 * c[SINE, k - 1] + a0 * c[COSINE, k] + a1 * c[COSINE, k - 1]
        c[OMEGA, k + 1] = -lever * moment * next_share
        share = next_share
        power *= dt
        previous_term = term
        term = abs(c[OMEGA, k + 1]) * power
        size += term
        # two successive terms: the series of a symmetric motion has zeros in between
        if term <= TERM_TOLERANCE * size and previous_term <= PREVIOUS_TERM_TOLERANCE * size:
            return k
    return order
