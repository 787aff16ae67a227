"""How logarithmic axes are numbered."""

from __future__ import annotations

import math

from matplotlib.axis import Axis
from matplotlib.ticker import MaxNLocator, NullLocator

MOST_TICKS = 7
"""Names along an axis."""


def round_ticks(ruler: Axis) -> None:
    """Name round numbers along a logarithmic axis, as far as it reaches: as many digits of each decade as there is room for."""
    low, high = sorted(ruler.get_view_interval())
    decades = [10.0**d for d in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)]
    kinds = [[digit * d for d in decades for digit in digits if low <= digit * d <= high] for digits in (range(1, 10), (1, 2, 5), (1,))]
    chosen = next((kind for kind in kinds if len(kind) <= MOST_TICKS), kinds[-1])
    if len(chosen) < 2:  # within a digit
        chosen = [each for each in MaxNLocator(5).tick_values(low, high) if low <= each <= high]
    ruler.set_ticks(chosen, labels=[f"{each:g}" for each in chosen])
    ruler.set_minor_locator(NullLocator())
    ruler.set_view_interval(low, high, ignore=True)
