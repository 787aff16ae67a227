"""Interface of a model to the engine: signatures of its compiled functions and special values."""

from __future__ import annotations

from seisblock._jit import kernel, types
from seisblock.dynamics.array_types import INTEGERS, MATRIX, READ_ONLY_MATRIX, VECTOR
from seisblock.dynamics.buffers import BATCH_FORCING, BATCH_STATE, FORCING, OUTPUT, STATE

_t = types()

SERIES = _t.int64(_t.int64, VECTOR, MATRIX, VECTOR, _t.int64, MATRIX, MATRIX)
"""series(mode, y, f, p, order, c, g) -> degree.

Computes from the state ``y`` and the ground motion ``f[row] = (value, slope)`` the coefficients ``c[i, 0:degree + 1]`` of state i
and ``g[k, 0:degree + 1]`` of guard k. ``OFF`` in ``g[k, 0]`` disables a guard, in ``c[i, 1]`` it marks a state that is constant and not
tracked. Rows of c after the states are work space. Degree ``CONSTANT``: all states are constant, c is not read, and guards are linear,
``g[k, 0:2]``."""

RESET = _t.int64(_t.int64, _t.int64, VECTOR, MATRIX, VECTOR)
"""reset(mode, guard, y, f, p) -> next mode; changes ``y`` in place. A negative mode ends the integration."""

CONSTANT = 0
"""Degree of a constant state."""

SKIP = _t.int64(_t.int64, READ_ONLY_MATRIX, VECTOR, _t.int64, VECTOR)
"""skip(mode, acceleration, gains, sample, p) -> later sample up to which the state is constant and no guard fires."""


@kernel(SKIP)
def no_skip(mode, acceleration, gains, sample, p):
    """Return the sample unchanged, for models without a state of rest."""
    return sample


OBSERVE = _t.void(FORCING, VECTOR, STATE, OUTPUT, VECTOR)
"""observe(forcing, p, state, output, observed): writes numbers about a trajectory of a batch from its path and events, which the next one
overwrites.

Called at the end and, without a path, whenever the tables of events are half full: they hold the events after the first ``N_FLUSHED``.
``observed`` is NaN before the first call."""


@kernel(OBSERVE)
def observe_nothing(forcing, p, state, output, observed):
    """Write nothing."""


STRIDE = _t.int64(BATCH_FORCING, MATRIX, BATCH_STATE, INTEGERS, INTEGERS, VECTOR, _t.int64)
"""stride(forcing, parameters, rows, lane_rows, needs_engine, lane_state, max_samples) -> samples passed, summed over the lanes.

Advances the trajectories ``lane_rows`` (row numbers, -1 for none) in parallel from their current samples until one of them needs the
engine, or for ``max_samples`` samples, by the same operations in the same order as ``series`` and the engine's step. On entry,
``needs_engine`` marks lanes with a new trajectory; on return, lanes that need the engine, whose sample and state are then written back.
``lane_state`` is work space kept between calls, ``LANE_FIELDS`` numbers per lane."""

N_LANES, LANE_FIELDS = 16, 24
"""Number of lanes (two vectors of 512 bits or four of 256 bits) and numbers of work space per lane."""

OFF = float("inf")
"""Value of a guard that is disabled in this mode."""
