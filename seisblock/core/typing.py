"""Type aliases used throughout the package."""

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
"""Progress callback: called with the number of completed runs or frames, and the total."""

TimeWindow: TypeAlias = tuple[float | None, float | None]
"""Start and end of a time window, s after the record's first sample; None stands for the end of the record."""

__all__ = ["ArrayLike", "BoolArray", "ComplexArray", "FloatArray", "IntArray", "Progress", "TimeWindow"]
