"""Where between two numbers a claim begins or ceases to hold."""

from __future__ import annotations

from collections.abc import Callable


def bisect_threshold(claim: Callable[[float], bool], low: float, high: float, *, tolerance: float = 1e-15) -> float:
    """Return where between two numbers a claim that holds at one of them only changes, by bisection.

    Parameters
    ----------
    claim : callable
        What a run with this number shows.
    low, high : float
        Numbers at which it shows different things.
    tolerance : float
        How near the answer must be.
    """
    from scipy.optimize import bisect

    return float(bisect(lambda number: 1.0 if claim(number) else -1.0, low, high, xtol=tolerance))
