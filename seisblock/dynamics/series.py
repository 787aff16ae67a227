"""Recurrences for products, quotients and sine/cosine of power series, one coefficient at a time."""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import VECTOR

_t = types()


@kernel(_t.float64(VECTOR, VECTOR, _t.int64), inline=True)
def product(u, v, k):
    """Return coefficient `k` of the product of two series (Cauchy product)."""
    value = u[0] * v[k]
    for j in range(1, k + 1):
        value += u[j] * v[k - j]
    return value


@kernel(_t.void(VECTOR, VECTOR, VECTOR, _t.int64), inline=True)
def sine_cosine(f, s, c, k):
    """Write coefficient `k` >= 1 of s = sin f and c = cos f, from s' = c f' and c' = -s f'."""
    sine = 0.0
    cosine = 0.0
    for j in range(1, k + 1):
        # f' has the coefficients j f_j: the chain rule gives sine and cosine together, without evaluating either
        rate = j * f[j]
        sine += rate * c[k - j]
        cosine -= rate * s[k - j]
    s[k] = sine / k
    c[k] = cosine / k


@kernel(_t.float64(VECTOR, VECTOR, VECTOR, _t.int64), inline=True)
def quotient(u, v, w, k):
    """Return coefficient `k` of w = u / v from the coefficients of w below `k`."""
    value = u[k]
    for j in range(1, k + 1):
        value -= v[j] * w[k - j]
    return value / v[0]
