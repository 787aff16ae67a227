"""At which intensities to look, where nobody says: so far down that hardly anything happens, so far up that nearly all does."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from seisblock import checks
from seisblock.errors import ParameterError
from seisblock.typing import ArrayLike, BoolArray, FloatArray

STEPS = 60
"""Levels, unless another number is asked for."""

FARTHEST = 12
"""Doublings and halvings of the motions as they are, at most, in the search for the range."""

FEW, MOST = 0.02, 0.95
"""Shares of the runs in which it happens at the ends of the range."""


def levels_of(given: ArrayLike) -> FloatArray:
    """Return levels that were given, rising, each once.

    Raises
    ------
    ParameterError
        If there are fewer than two, or one is not positive.
    """
    found = np.unique(checks.numbers("the levels", given))
    if found.size < 2:
        raise ParameterError("a fragility needs two levels or more, found {count}", count=found.size)
    if not (np.isfinite(found).all() and (found > 0.0).all()):
        raise ParameterError("the levels of a fragility must be positive numbers")
    return found


def chosen_levels(shares_at: Callable[[float], FloatArray], middle: float, steps: int = STEPS) -> FloatArray:
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
    checks.whole("the number of levels", steps, least=2)
    first = shares_at(middle)
    low, high = _until(shares_at, middle, 0.5, first, lambda s: s <= FEW), _until(shares_at, middle, 2.0, first, lambda s: s >= MOST)
    return np.geomspace(low, high, steps)


def _until(
    shares_at: Callable[[float], FloatArray], level: float, factor: float, shares: FloatArray, done: Callable[[FloatArray], BoolArray]
) -> float:
    """Return the first of a row of levels at which something is so for all shares; the last one where it never is."""
    for _ in range(FARTHEST):
        if done(shares).all():
            break
        level *= factor
        shares = shares_at(level)
    return level
