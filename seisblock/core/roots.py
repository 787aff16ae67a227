"""Root of a function of one variable between two points."""

from __future__ import annotations

import math
from collections.abc import Callable


def bracketed_root(function: Callable[[float], float], low: float, high: float, tolerance: float) -> float:
    """Return the root of a function that changes its sign between `low` and `high`, by Chandrupatla's method.

    Inverse quadratic interpolation, bisection where that does not converge. SciPy's solvers need 0.3 s to be imported, more than most
    commands take.

    Parameters
    ----------
    function : callable
        Continuous function of one number.
    low, high : float
        Ends of the bracket.
    tolerance : float
        Largest width of the final bracket, in the unit of `low`; twice the round-off at least.

    References
    ----------
    T. R. Chandrupatla (1997), Advances in Engineering Software 28(3), 145-149.

    Examples
    --------
    >>> round(bracketed_root(lambda x: x * x - 2.0, 0.0, 2.0, 1e-15), 12)
    1.414213562373
    """
    (a, f_a), (b, f_b) = (low, function(low)), (high, function(high))
    share = 0.5
    while True:
        x = a + share * (b - a)
        f_x = function(x)
        # c is the end that x replaces; x and b bracket the root
        if (f_x > 0.0) == (f_a > 0.0):
            c, f_c = a, f_a
        else:
            c, f_c, b, f_b = b, f_b, a, f_a
        a, f_a = x, f_x
        best = a if abs(f_a) < abs(f_b) else b
        width, smallest = abs(b - a), max(tolerance, 4e-16 * abs(best))
        if f_a == 0.0 or width <= smallest:
            return best
        xi, phi = (a - b) / (c - b), (f_a - f_b) / (f_c - f_b)
        share = 0.5
        if 1.0 - math.sqrt(1.0 - xi) < phi < math.sqrt(xi):
            share = f_a / (f_a - f_b) * f_c / (f_c - f_b) - (c - a) / (b - a) * f_a / (f_c - f_a) * f_b / (f_b - f_c)
        margin = 0.5 * smallest / width
        share = min(max(share, margin), 1.0 - margin)
