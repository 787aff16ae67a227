"""The least size that will do, found in few tries and told in the unit of the user."""

from __future__ import annotations

import math
from collections.abc import Callable

from seisblock.core.units import LENGTH_UNITS
from seisblock.report.figures.style import INCH

MAX_SCALE = 3.0
"""A size that would do is looked for up to so many times that of the figure by itself, then not."""

RELATIVE_TOLERANCE = 0.04
"""How near the least size is told, of the size."""


def min_size(fits: Callable[[float], bool], too_small: float, default_size: float, unit: str) -> float | None:
    """Return the least size above one that is too small, inch, by halving: one that can be told; None where the largest does not do.

    A try lays the whole figure out, up to a second: the usual size, which mostly does, comes before the largest.

    Parameters
    ----------
    fits : callable
        Tries a size, inch.
    too_small : float, inch
        What has been tried.
    default_size : float, inch
        That of the figure by itself.
    unit : str
        In which it is told.

    Examples
    --------
    >>> tried = []
    >>> least = min_size(lambda size: tried.append(size) or size > 5.0, 2.0, 8.0, "mm")
    >>> format_inches(least, "mm"), len(tried)
    ('128 mm', 7)
    """
    for size in (round_up(default_size, unit), round_up(MAX_SCALE * max(default_size, too_small), unit)):
        if size <= too_small:
            continue
        if fits(size):
            break
        too_small = size
    else:
        return None
    while size / too_small > 1.0 + RELATIVE_TOLERANCE:
        middle = round_up(math.sqrt(too_small * size), unit)
        if middle >= size:
            break
        if fits(middle):
            size = middle
        else:
            too_small = middle
    return size


def unit_step(unit: str) -> float:
    """Return the digit to which a size is told in a unit, inch.

    Parameters
    ----------
    unit : str

    Examples
    --------
    >>> round(unit_step("mm"), 5)
    0.03937
    """
    return {"mm": 1.0, "cm": 0.1}.get(unit, 0.01) * LENGTH_UNITS[unit] / INCH


def round_up(inches: float, unit: str) -> float:
    """Return the next larger length that can be told in a unit, inch.

    Parameters
    ----------
    inches : float
    unit : str

    Examples
    --------
    >>> format_inches(round_up(1.0, "mm"), "mm")
    '26 mm'
    """
    return math.ceil(inches / unit_step(unit) - 1e-6) * unit_step(unit)


def format_inches(inches: float, unit: str) -> str:
    """Return a length in the unit of the user.

    Parameters
    ----------
    inches : float
    unit : str

    Examples
    --------
    >>> format_inches(1.0, "cm")
    '2.54 cm'
    """
    return f"{inches * INCH / LENGTH_UNITS[unit]:.4g} {unit}"
