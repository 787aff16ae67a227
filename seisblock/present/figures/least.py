"""The least size that will do, found in few tries and told in the unit of the user."""

from __future__ import annotations

import math
from collections.abc import Callable

from seisblock.present.figures.canvas import INCH
from seisblock.units import LENGTH_UNITS

LARGEST = 3.0
"""A size that would do is looked for up to so many times that of the figure by itself, then not."""

FINE = 0.04
"""How near the least size is told, of the size."""


def least_that(fits: Callable[[float], bool], too_small: float, usual: float, unit: str) -> float | None:
    """Return the least size above one that is too small, inch, by halving: one that can be told; None where the largest does not do.

    A try lays the whole figure out, up to a second: the usual size, which mostly does, comes before the largest.

    Parameters
    ----------
    fits : callable
        Tries a size, inch.
    too_small : float, inch
        What has been tried.
    usual : float, inch
        That of the figure by itself.
    unit : str
        In which it is told.

    Examples
    --------
    >>> tried = []
    >>> least = least_that(lambda size: tried.append(size) or size > 5.0, 2.0, 8.0, "mm")
    >>> told(least, "mm"), len(tried)
    ('128 mm', 7)
    """
    for enough in (up(usual, unit), up(LARGEST * max(usual, too_small), unit)):
        if enough <= too_small:
            continue
        if fits(enough):
            break
        too_small = enough
    else:
        return None
    while enough / too_small > 1.0 + FINE:
        middle = up(math.sqrt(too_small * enough), unit)
        if middle >= enough:
            break
        if fits(middle):
            enough = middle
        else:
            too_small = middle
    return enough


def step_of(unit: str) -> float:
    """Return the digit to which a size is told in a unit, inch.

    Parameters
    ----------
    unit : str

    Examples
    --------
    >>> round(step_of("mm"), 5)
    0.03937
    """
    return {"mm": 1.0, "cm": 0.1}.get(unit, 0.01) * LENGTH_UNITS[unit] / INCH


def up(inches: float, unit: str) -> float:
    """Return the next larger length that can be told in a unit, inch.

    Parameters
    ----------
    inches : float
    unit : str

    Examples
    --------
    >>> told(up(1.0, "mm"), "mm")
    '26 mm'
    """
    return math.ceil(inches / step_of(unit) - 1e-6) * step_of(unit)


def told(inches: float, unit: str) -> str:
    """Return a length in the unit of the user.

    Parameters
    ----------
    inches : float
    unit : str

    Examples
    --------
    >>> told(1.0, "cm")
    '2.54 cm'
    """
    return f"{inches * INCH / LENGTH_UNITS[unit]:.4g} {unit}"
