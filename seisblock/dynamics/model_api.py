"""What a model gives the engine: three pure functions, as compiled function pointers, and the values that mean something special."""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import INTEGERS, MATRIX, READ_ONLY_MATRIX, VECTOR
from seisblock.dynamics.buffers import BATCH_FORCING, BATCH_STATE

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
def no_skip(mode, acceleration, gains, sample, p):
    """Skip nothing: the model has no rest, or none worth a short cut."""
    return sample


STRIDE = _t.int64(BATCH_FORCING, MATRIX, BATCH_STATE, INTEGERS, INTEGERS, VECTOR, _t.int64)
"""stride(grounds, parameters, rows, chosen, waits, lanes, most) -> samples passed, by all lanes together.

Moves the trajectories ``chosen`` (numbers of rows, -1 for none) on from the samples at which they stand, side by side, until one of them
cannot go on so, or for ``most`` samples: by the operations of ``series`` and of the engine's step, in their order. A lane is marked in
``waits`` where it is new, on the way in, and where it waits for the engine, on the way out: then place and state are written back.
``lanes`` is room that is kept between the calls, ``FIELDS`` numbers a lane."""

N_LANES, LANE_FIELDS = 16, 24
"""Trajectories side by side: two vectors of a processor with registers of 512 bits, four of one with 256."""

OFF = float("inf")
"""Value of a guard that is not watched in this mode."""
