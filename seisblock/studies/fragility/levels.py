"""At which intensities to look, where nobody says: so far down that hardly anything happens, so far up that nearly all does."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.typing import ArrayLike, BoolArray, FloatArray

DEFAULT_STEPS = 60
"""Levels, unless another number is asked for."""

MAX_DOUBLINGS = 12
"""Doublings and halvings of the motions as they are, at most, in the search for the range."""

LOW_SHARE, HIGH_SHARE = 0.02, 0.95
"""Shares of the runs in which it happens at the ends of the range."""


def check_levels(levels: ArrayLike) -> FloatArray:
    """Return levels that were given, rising, each once.

    Raises
    ------
    ParameterError
        If there are fewer than two, or one is not positive.
    """
    unique_levels = np.unique(checks.float_array("the levels", levels))
    if unique_levels.size < 2:
        raise ParameterError("a fragility needs two levels or more, found {count}", count=unique_levels.size)
    if not (np.isfinite(unique_levels).all() and (unique_levels > 0.0).all()):
        raise ParameterError("the levels of a fragility must be positive numbers")
    return unique_levels


def find_levels(shares_at: Callable[[float], FloatArray], middle: float, steps: int = DEFAULT_STEPS) -> FloatArray:
    """Return levels, evenly in their logarithm, between one at which hardly anything happens and one at which nearly all does.

    Parameters
    ----------
    shares_at : callable
        ``shares_at(level)``: in which share of the motions each body passed each limit.
    middle : float
        Where the search begins; it goes on by doubling and halving.
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
    """Return the first of a row of levels at which something is so for all shares; the last one where it never is."""
    for _ in range(MAX_DOUBLINGS):
        if is_reached(shares).all():
            break
        level *= factor
        shares = shares_at(level)
    return level
