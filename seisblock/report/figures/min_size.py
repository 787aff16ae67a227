"""Search for the minimum size of a figure, in the unit of the user."""

from __future__ import annotations

import math
from collections.abc import Callable

from seisblock.core.units import LENGTH_UNITS
from seisblock.report.figures.style import INCH

MAX_SCALE = 3.0
"""Upper limit of the search over the default size."""

RELATIVE_TOLERANCE = 0.04
"""Relative tolerance of the minimum size."""


def min_size(fits: Callable[[float], bool], too_small: float, default_size: float, unit: str) -> float | None:
    """Return the minimum size that fits, inch, by bisection on displayable sizes; None if the largest does not fit.

    A trial lays out the figure (up to 1 s), hence the default size, which mostly fits, is tried before the largest.

    Parameters
    ----------
    fits : callable
        Returns True if a size, inch, fits.
    too_small : float, inch
        A size that does not fit.
    default_size : float, inch
        Default size of the figure.
    unit : str
        Display unit.

    Examples
    --------
    >>> trials = []
    >>> size = min_size(lambda size: trials.append(size) or size > 5.0, 2.0, 8.0, "mm")
    >>> format_inches(size, "mm"), len(trials)
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
    # bisection in the logarithm: the tolerance is relative
    while size / too_small > 1.0 + RELATIVE_TOLERANCE:
        middle = round_up(math.sqrt(too_small * size), unit)
        # rounding up may return the upper end
        if middle >= size:
            break
        if fits(middle):
            size = middle
        else:
            too_small = middle
    return size


def unit_step(unit: str) -> float:
    """Return the resolution of displayed sizes in a unit, inch.

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
    """Round a length up to the displayed resolution, inch.

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
    """Return a length, inch, as text in a unit.

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
