"""Polynomials in time: value, shift, and the first crossing that cannot be missed.

Coefficients stand in ascending order, ``c[k]`` multiplies ``t**k``. A guard (a slack, positive while a mode is
admissible) is such a polynomial, so whether it stays positive over a step is decided by bounds on its
coefficients, not by looking at a few instants.
"""

from __future__ import annotations

import numpy as np

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import MATRIX, VECTOR

_t = types()

ROUND_OFF = 1e-14
"""A polynomial is taken as zero where it is below this share of the sum of its terms."""

NEWTON_TOLERANCE = 1e-9
"""A Newton step below this share of the root is followed by none that matters."""

NO_CROSSING = -1.0
"""Answer of :func:`first_crossing` when there is none."""


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
    """Return a lower bound of a polynomial on [0, h]: its chord's lower end less all higher terms."""
    if degree == 0:
        return c[0]
    bound = min(c[0], c[0] + c[1] * h)
    power = h
    for k in range(2, degree + 1):
        power *= h
        bound -= abs(c[k]) * power
    return bound


@kernel(_t.float64(MATRIX, _t.int64, _t.int64, _t.float64), inline=True)
def evaluate_row(c, i, degree, t):
    """Return the value at `t` of the polynomial in row `i`; a slice ``c[i]`` would cost reference counting."""
    if degree == 3:
        # sliding and flight: no loop where nearly all steps are cubics
        return c[i, 0] + t * (c[i, 1] + t * (c[i, 2] + t * c[i, 3]))
    value = c[i, degree]
    for k in range(degree - 1, -1, -1):
        value = value * t + c[i, k]
    return value


@kernel(_t.float64(MATRIX, _t.int64, _t.int64, _t.float64), inline=True)
def lower_bound_of_row(c, i, degree, h):
    """Return :func:`lower_bound` of the polynomial in row `i`."""
    if degree == 0:
        return c[i, 0]
    bound = min(c[i, 0], c[i, 0] + c[i, 1] * h)
    if degree == 3:
        return bound - h * h * (abs(c[i, 2]) + h * abs(c[i, 3]))
    power = h
    for k in range(2, degree + 1):
        power *= h
        bound -= abs(c[i, k]) * power
    return bound


@kernel(_t.float64(VECTOR, _t.int64, _t.float64))
def _bracketed_root(c, degree, high):
    """Return the root in [0, high] of a polynomial that falls from positive to negative there (Newton inside a bracket).

    It begins at the root of the parabola that the first terms are. A step below ``NEAR`` is the last: the error is of its square.
    """
    if c[0] <= 0.0:
        return 0.0
    low = 0.0
    t = high
    if degree > 1:
        discriminant = c[1] * c[1] - 4.0 * c[0] * c[2]
        if discriminant >= 0.0:
            guess = 2.0 * c[0] / (np.sqrt(discriminant) - c[1])
            if 0.0 < guess < high:
                t = guess
    for _ in range(100):
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
        if value == 0.0 or (slope != 0.0 and abs(next_t - t) <= NEWTON_TOLERANCE * t):
            return min(max(next_t, low), high)
        if not (low < next_t < high):
            next_t = 0.5 * (low + high)
            if high - low <= 2.3e-16 * high:
                return next_t
        t = next_t
    return t


@kernel(_t.float64(VECTOR, _t.int64, _t.float64, _t.float64, VECTOR, VECTOR))
def first_negative(g, degree, h, round_off, q, d):
    """Return the first time in [0, h] from which a polynomial is negative, or NEVER.

    A zero that is only touched, or passed by less than `round_off` of the sum of the terms, is no crossing. A guard that a reset has
    just left at zero is therefore judged by where it goes, which is the half-open rule (t0, t0 + h]. Zero is returned when the
    polynomial is negative, or becomes negative, at once.

    Parameters
    ----------
    g : (degree + 1,) array
        Coefficients, left unchanged.
    degree : int
    h : float
        Length of the step, positive.
    round_off : float
        Zero for a polynomial whose every coefficient is meant, however small beside what it grows to within the step.
    q, d : (>= degree + 1,) arrays
        Scratch.
    """
    if lower_bound(g, degree, h) > 0.0:
        return NO_CROSSING
    total = 0.0
    power = 1.0
    for k in range(degree + 1):
        total += abs(g[k]) * power
        power *= h
    if not total < np.inf:
        return NO_CROSSING
    noise = round_off * total
    leading = 0
    power = 1.0
    while leading <= degree and abs(g[leading]) * power <= noise:
        leading += 1
        power *= h
    if leading > degree:
        return NO_CROSSING
    if g[0] < -noise:
        return 0.0
    if g[leading] < 0.0:
        # it may dip by less than round-off and come back, so nothing is divided out
        leading = 0
        power = 1.0
    n = degree - leading
    for k in range(n + 1):
        q[k] = g[leading + k]
    # march over [0, h], halving where the bounds cannot tell
    noise = round_off * total / power
    start = 0.0
    width = h
    smallest = 1e-14 * h
    while start < h:
        if lower_bound(q, n, width) <= -noise:
            for k in range(n):
                d[k] = -(k + 1) * q[k + 1]
            monotone = n > 0 and lower_bound(d, n - 1, width) >= 0.0
            if not monotone and width > smallest:
                width *= 0.5
                continue
            if evaluate(q, n, width) < -noise:
                root = start + _bracketed_root(q, n, width)
                return 0.0 if root < smallest else min(root, h)
        start += width
        if start < h:
            shift(q, n, width)
        width = h - start
    return NO_CROSSING


@kernel(_t.float64(VECTOR, _t.int64, _t.float64, VECTOR, VECTOR), inline=True)
def first_crossing(g, degree, h, q, d):
    """Return :func:`first_negative` of a polynomial whose coefficients carry round-off."""
    return first_negative(g, degree, h, ROUND_OFF, q, d)
