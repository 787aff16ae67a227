"""Edge wear: inset of the pivot edges from the sides of a base."""

from __future__ import annotations

import re
from dataclasses import dataclass

from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.units import parse_length, to_halfwidth

MAX_SHARE = 0.5
"""Share of the width per side at which no base is left."""

MIN_SHARE = 1e-9
"""Share of the width per side below which an edge counts as sharp (smaller than an atom)."""

_SHARE_PATTERN = re.compile(r"\s*+([-+]?+(?:\d++(?:\.\d*+)?|\.\d++)(?:[eE][-+]?+\d++)?+)\s*+(%?)\s*+\Z")


@dataclass(frozen=True, repr=False)
class EdgeWear(DisplayMixin):
    """Inset of the worn pivot edges from each side of a base.

    Parameters
    ----------
    length_m : float, m
    share : float
        Share of the width, added to the length; below 0.5.

    Raises
    ------
    ParameterError
        If a value is negative or not a number.

    Examples
    --------
    >>> EdgeWear(share=0.1).inset(0.24)
    0.024
    """

    length_m: float = 0.0
    share: float = 0.0

    def __post_init__(self) -> None:
        for value in (self.length_m, self.share):
            checks.non_negative("the inset of the worn edges", value)

    def inset(self, width: float) -> float:
        """Return the inset per side of a base of the given width (m), m.

        An inset below a billionth of the width is 0. Raises an error where no base is left.
        """
        depth = self.length_m + self.share * width
        if not depth < MAX_SHARE * width:
            raise ParameterError(
                "an inset of {depth:g} m per side is too large for a base {width:g} m wide: it must be below half the width (a "
                "number without a unit is a share of the width, 0.1; a length has a unit, 1cm)",
                depth=depth,
                width=width,
            )
        return depth if depth >= MIN_SHARE * width else 0.0


SHARP_EDGES = EdgeWear()
"""No edge wear."""

DEFAULT_WEAR = EdgeWear(share=0.05)
"""Edge wear of gravestones without measurement: the median of their prior, :data:`WORN_RANGE`."""

WORN_RANGE = (0.0, 0.1)
"""Prior of the worn edges of gravestones, uniform, shares of the width per side.

With this prior, computed rates under records agree with the surveyed rates of [Furukawa2009]_ table 6 and with JMA's rule, if a stone
falls when either horizontal component overturns it. A constant wear of 0.1 agrees only with a single horizontal component.
"""


def parse_edge_wear(text: str | float) -> EdgeWear:
    """Return the edge wear of a text: length with unit (``1cm``), or share of the width (``0.1``, ``10%``).

    Raises
    ------
    ParameterError
        If the text is not a number, or negative.
    UnitError
        If the unit is unknown.

    Examples
    --------
    >>> parse_edge_wear("5%") == parse_edge_wear(0.05) == DEFAULT_WEAR
    True
    >>> parse_edge_wear("1cm").inset(0.24)
    0.01
    """
    match = _SHARE_PATTERN.match(to_halfwidth(text)) if isinstance(text, str) else None
    if match is None and isinstance(text, str):
        return EdgeWear(length_m=parse_length(text, quantity="inset"))
    if match is None:
        return EdgeWear(share=float(text))
    return EdgeWear(share=float(match[1]) / (100.0 if match[2] else 1.0))
