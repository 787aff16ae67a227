"""Polynomials in time: evaluation, Taylor shift, and guaranteed detection of the first zero crossing.

Coefficients are in ascending order, ``c[k]`` multiplies ``t**k``. A guard (a slack, positive while a mode is
admissible) is such a polynomial. Bounds on its coefficients decide whether it stays positive over a step; sampling at
a few instants could miss a crossing.
"""

from __future__ import annotations

import numpy as np

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR

_t = types()

ROUND_OFF = 1e-14
"""Round-off relative to the sum of the absolute terms of a polynomial; smaller values count as zero."""

NEWTON_TOLERANCE = 1e-9
"""Relative Newton step below which the iteration ends; the remaining error is of the order of its square."""

NO_CROSSING = -1.0
"""Return value of :func:`first_crossing` without a crossing."""


@kernel(_t.float64(VECTOR, _t.int64, _t.float64), inline=True)
def evaluate(c, degree, t):
    """Return the value of a polynomial at `t` (Horner)."""
    value = c[degree]
    for k in range(degree - 1, -1, -1):
        value = value * t + c[k]
    return value


@kernel(_t.void(VECTOR, _t.int64, _t.float64), inline=True)
def shift(c, degree, t):
    """Move the origin of a polynomial to `t`, in place (Taylor shift by synthetic division)."""
    for lowest in range(degree):
        for k in range(degree - 1, lowest - 1, -1):
            c[k] += t * c[k + 1]


@kernel(_t.float64(VECTOR, _t.int64, _t.float64), inline=True)
def lower_bound(c, degree, h):
    """Return a lower bound of a polynomial on [0, h]: its first coefficient and all negative terms at `h`."""
    bound, power = c[0], 1.0
    for k in range(1, degree + 1):
        power *= h
        bound += min(c[k], 0.0) * power
    return bound


@kernel(_t.float64(MATRIX, _t.int64, _t.int64, _t.float64), inline=True)
def evaluate_row(c, i, degree, t):
    """Return the value at `t` of the polynomial in row `i`, without a slice ``c[i]``, which would be slower."""
    if degree == 3:
        # sliding and flight: nearly all steps are cubic, so that the unrolled form pays
        return c[i, 0] + t * (c[i, 1] + t * (c[i, 2] + t * c[i, 3]))
    value = c[i, degree]
    for k in range(degree - 1, -1, -1):
        value = value * t + c[i, k]
    return value


@kernel(_t.float64(MATRIX, _t.int64, _t.int64, _t.float64), inline=True)
def lower_bound_of_row(c, i, degree, h):
    """Return :func:`lower_bound` of the polynomial in row `i`."""
    if degree == 3:
        return c[i, 0] + h * (min(c[i, 1], 0.0) + h * (min(c[i, 2], 0.0) + h * min(c[i, 3], 0.0)))
    bound, power = c[i, 0], 1.0
    for k in range(1, degree + 1):
        power *= h
        bound += min(c[i, k], 0.0) * power
    return bound


@kernel(_t.boolean(VECTOR, _t.int64, _t.float64), inline=True)
def _is_concave(c, degree, h):
    """Return True if the second derivative of a polynomial is negative on [0, h], by its first coefficient and all positive terms."""
    bound, power = 2.0 * c[2] if degree > 1 else 0.0, 1.0
    for k in range(3, degree + 1):
        power *= h
        bound += k * (k - 1) * max(c[k], 0.0) * power
    return bound < 0.0


@kernel(_t.float64(VECTOR, _t.int64, _t.float64))
def bracketed_root(c, degree, high):
    """Return the root in [0, high] of a polynomial that changes from positive to negative there.

    Safeguarded Newton iteration. It starts from the root of the quadratic part and ends at a relative step below ``NEWTON_TOLERANCE``.
    """
    # a reset may leave the guard at zero
    if c[0] <= 0.0:
        return 0.0
    # start from the root of the quadratic part, in the form without cancellation
    low = 0.0
    t = high
    if degree > 1:
        # without a real root of the quadratic part, the end of the bracket is the first guess
        discriminant = c[1] * c[1] - 4.0 * c[0] * c[2]
        if discriminant >= 0.0:
            root = np.sqrt(discriminant)
            guess = 2.0 * c[0] / (root - c[1]) if c[1] <= 0.0 else -0.5 * (c[1] + root) / c[2]
            if 0.0 < guess < high:
                t = guess
    for _ in range(100):
        # value and slope in one Horner scheme
        value = c[degree]
        slope = 0.0
        for k in range(degree - 1, -1, -1):
            slope = slope * t + value
            value = value * t + c[k]
        if value > 0.0:
            low = t
        else:
            high = t
        next_t = t - value / slope if slope != 0.0 else t
        # Newton converges quadratically: the error that remains is of the order of the square of this step
        if value == 0.0 or (slope != 0.0 and abs(next_t - t) <= NEWTON_TOLERANCE * t):
            return min(max(next_t, low), high)
        # Newton left the bracket: bisect
        if not (low < next_t < high):
            next_t = 0.5 * (low + high)
            if high - low <= 2.3e-16 * high:
                return next_t
        t = next_t
    return t


@kernel(_t.float64(VECTOR, _t.int64, _t.float64, _t.float64, VECTOR, VECTOR))
def first_negative(g, degree, h, round_off, q, d):
    """Return the first time in [0, h] from which a polynomial is negative, or ``NO_CROSSING``.

    Grazing zero, or passing it by less than `round_off` times the sum of the terms, is not a crossing. A guard that a reset has
    just left at zero is therefore judged by its direction, which is the half-open rule (t0, t0 + h]. Zero is returned if the
    polynomial is negative, or becomes negative, immediately.

    Parameters
    ----------
    g : (degree + 1,) array
        Coefficients, left unchanged.
    degree : int
    h : float
        Length of the step, positive.
    round_off : float
        Relative round-off of the coefficients; zero for a polynomial whose coefficients are exact.
    q, d : (>= degree + 1,) arrays
        Scratch.
    """
    if lower_bound(g, degree, h) > 0.0:
        return NO_CROSSING
    # sum of the absolute terms over the step: the scale of round-off
    total = 0.0
    power = 1.0
    for k in range(degree + 1):
        total += abs(g[k]) * power
        power *= h
    # infinite or NaN: no crossing can be told; the state of the step is tested by the engine
    if not total < np.inf:
        return NO_CROSSING
    noise = round_off * total
    # first coefficient above round-off: it decides the sign just after the start
    leading = 0
    power = 1.0
    while leading <= degree and abs(g[leading]) * power <= noise:
        leading += 1
        power *= h
    if leading > degree:
        return NO_CROSSING
    # negative beyond doubt from the start, for example after a jump of the input
    if g[0] < -noise:
        return 0.0
    if g[leading] < 0.0:
        # it may dip by less than round-off and return: do not divide out the leading power
        leading = 0
        power = 1.0
    n = degree - leading
    for k in range(n + 1):
        q[k] = g[leading + k]
    # march over [0, h], halving the interval while the bounds are inconclusive
    # dividing by t^leading scales the values by h^leading, and the noise with them
    noise = round_off * total / power
    start = 0.0
    width = h
    smallest = 1e-14 * h
    while start < h:
        if lower_bound(q, n, width) <= -noise:
            # falling, or above zero and concave as a hop: at most one root, so that the end value decides
            for k in range(n):
                # minus the derivative: if it is bounded from below by zero, the guard only falls
                d[k] = -(k + 1) * q[k + 1]
            monotone = n > 0 and lower_bound(d, n - 1, width) >= 0.0
            if not monotone and not (q[0] > 0.0 and _is_concave(q, n, width)) and width > smallest:
                width *= 0.5
                continue
            if evaluate(q, n, width) < -noise:
                root = start + bracketed_root(q, n, width)
                # a root closer to the start than the resolution of time belongs to the instant itself
                return 0.0 if root < smallest else min(root, h)
        start += width
        if start < h:
            # the next interval has its origin at its own start, where the bound on the coefficients is sharp
            shift(q, n, width)
        width = h - start
    return NO_CROSSING


@kernel(_t.float64(VECTOR, _t.int64, _t.float64, VECTOR, VECTOR), inline=True)
def first_crossing(g, degree, h, q, d):
    """Return :func:`first_negative` with the tolerance ``ROUND_OFF``."""
    return first_negative(g, degree, h, ROUND_OFF, q, d)
