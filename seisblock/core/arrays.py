"""Arrays that cannot be changed by accident."""

from __future__ import annotations

import numpy as np

from seisblock.core.typing import ArrayLike, FloatArray


def as_readonly(values: ArrayLike) -> FloatArray:
    """Return `values` as a read-only, C-contiguous float64 array, copied only when it must be."""
    array = np.ascontiguousarray(values, dtype=np.float64)
    if array.flags.writeable:
        # a view protects a fresh conversion; an array of the caller is copied before it is locked
        array = array.view() if array is not values else array.copy()
        array.flags.writeable = False
    return array


def readonly(array: FloatArray) -> FloatArray:
    """Mark an array as read-only and return it; the caller must hold the only reference."""
    array.flags.writeable = False
    return array


def readonly_view(array: FloatArray) -> FloatArray:
    """Return a read-only, C-contiguous view of an array, a copy of a column of a table."""
    return readonly(np.ascontiguousarray(array).view())
