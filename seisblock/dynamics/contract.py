"""What a model gives the engine: three pure functions, as compiled function pointers, and the values that mean something special."""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.arrays import MATRIX, READ_ONLY_MATRIX, VECTOR

_t = types()

SERIES = _t.int64(_t.int64, VECTOR, MATRIX, VECTOR, _t.int64, MATRIX, MATRIX)
"""series(mode, y, f, p, order, c, g) -> degree.

Writes, from the state ``y`` and the ground motion ``f[row] = (value, slope)``, the coefficients ``c[i, 0:degree + 1]`` of state i
and ``g[k, 0:degree + 1]`` of guard k (``OFF`` in ``g[k, 0]`` skips a guard, in ``c[i, 1]`` a state that does not move and is not
tracked). Rows of c after the states are scratch. ``CONSTANT`` says that no state moves: c is not read then, and guards are straight
lines, ``g[k, 0:2]``."""

RESET = _t.int64(_t.int64, _t.int64, VECTOR, MATRIX, VECTOR)
"""reset(mode, guard, y, f, p) -> next mode; changes ``y`` in place. A negative mode ends the integration."""

CONSTANT = 0
"""Degree of a state that does not move."""

SKIP = _t.int64(_t.int64, READ_ONLY_MATRIX, VECTOR, _t.int64, VECTOR)
"""skip(mode, acceleration, gains, sample, p) -> a later sample, up to which the state stays as it is and no guard fires."""


@kernel(SKIP)
def stay(mode, acceleration, gains, sample, p):
    """Skip nothing: the model has no rest, or none worth a short cut."""
    return sample


OFF = float("inf")
"""Value of a guard that is not watched in this mode."""
