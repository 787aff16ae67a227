"""Threshold of a monotone condition by bisection."""

from __future__ import annotations

from collections.abc import Callable


def bisect_threshold(claim: Callable[[float], bool], low: float, high: float, *, tolerance: float = 1e-15) -> float:
    """Return the number between two bounds at which a condition changes.

    Parameters
    ----------
    claim : callable
        Condition, evaluated by a run with this number.
    low, high : float
        Bounds with different values of the condition.
    tolerance : float
        Absolute error of the result.
    """
    from scipy.optimize import bisect

    return float(bisect(lambda number: 1.0 if claim(number) else -1.0, low, high, xtol=tolerance))
