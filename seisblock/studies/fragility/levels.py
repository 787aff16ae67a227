"""Levels of a fragility: validation of given levels, and a search for the range between rare and almost sure exceedance."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.typing import ArrayLike, BoolArray, FloatArray

DEFAULT_STEPS = 60
"""Default number of levels."""

MAX_DOUBLINGS = 12
"""Largest number of doublings and halvings of the unscaled motions in the search for the range."""

LOW_SHARE, HIGH_SHARE = 0.02, 0.95
"""Exceeding shares of the runs at the ends of the range."""


def check_levels(levels: ArrayLike) -> FloatArray:
    """Return given levels, rising, without duplicates.

    Raises
    ------
    ParameterError
        If there are fewer than two, or one is not positive.
    """
    unique_levels = np.unique(checks.float_array("the levels", levels))
    if unique_levels.size < 2:
        raise ParameterError("a fragility requires at least two levels, found {count}", count=unique_levels.size)
    if not (np.isfinite(unique_levels).all() and (unique_levels > 0.0).all()):
        raise ParameterError("the levels of a fragility must be positive numbers")
    return unique_levels


def find_levels(shares_at: Callable[[float], FloatArray], middle: float, steps: int = DEFAULT_STEPS) -> FloatArray:
    """Return levels, logarithmically spaced, between rare and almost sure exceedance.

    Parameters
    ----------
    shares_at : callable
        ``shares_at(level)``: share of the motions that exceed each limit, for each body.
    middle : float
        Start of the search, which proceeds by doubling and halving.
    steps : int
        At least 2.
    """
    checks.integer("the number of levels", steps, minimum=2)
    first = shares_at(middle)
    low, high = (
        _extend_level(shares_at, middle, 0.5, first, lambda s: s <= LOW_SHARE),
        _extend_level(shares_at, middle, 2.0, first, lambda s: s >= HIGH_SHARE),
    )
    return np.geomspace(low, high, steps)


def _extend_level(
    shares_at: Callable[[float], FloatArray], level: float, factor: float, shares: FloatArray, is_reached: Callable[[FloatArray], BoolArray]
) -> float:
    """Return the first level of a geometric sequence at which a condition holds for all shares; the last if none."""
    # bounded: some limits are never, or always, exceeded
    for _ in range(MAX_DOUBLINGS):
        if is_reached(shares).all():
            break
        level *= factor
        shares = shares_at(level)
    return level
