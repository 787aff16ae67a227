"""Numba types of the arrays passed to kernels: C-contiguous, 64 bit."""

from __future__ import annotations

from seisblock._jit import types

_t = types()

VECTOR = _t.Array(_t.float64, 1, "C")
MATRIX = _t.Array(_t.float64, 2, "C")
BLOCK = _t.Array(_t.float64, 3, "C")
ARRAY_4D = _t.Array(_t.float64, 4, "C")
READ_ONLY_MATRIX = _t.Array(_t.float64, 2, "C", readonly=True)
INTEGERS = _t.Array(_t.int64, 1, "C")
INTEGER_TABLE = _t.Array(_t.int64, 2, "C")
INTEGER_BLOCK = _t.Array(_t.int64, 3, "C")
