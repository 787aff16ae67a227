"""Names for the types that travel through the whole package."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray: TypeAlias = NDArray[np.float64]
ComplexArray: TypeAlias = NDArray[np.complex128]
IntArray: TypeAlias = NDArray[np.int64]
BoolArray: TypeAlias = NDArray[np.bool_]

Progress: TypeAlias = Callable[[int, int], None]
"""Told now and then how many runs, or pictures, are done, and how many there are in all."""

TimeWindow: TypeAlias = tuple[float | None, float | None]
"""A stretch of time, s after the record's first sample; an end left out is that of the record."""

__all__ = ["ArrayLike", "BoolArray", "ComplexArray", "FloatArray", "IntArray", "Progress", "TimeWindow"]
