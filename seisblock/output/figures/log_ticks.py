"""Tick labels of logarithmic axes."""

from __future__ import annotations

import math

from matplotlib.axis import Axis
from matplotlib.ticker import MaxNLocator, NullLocator

MAX_TICKS = 7
"""Tick labels per axis, at most."""


def round_ticks(axis: Axis) -> None:
    """Label round numbers on a logarithmic axis: digits 1 to 9, else 1, 2, 3, 5, 7, else 1, 2, 5, else powers of ten."""
    low, high = sorted(axis.get_view_interval())
    decades = [10.0**d for d in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)]
    kinds = [
        [digit * d for d in decades for digit in digits if low <= digit * d <= high]
        for digits in (range(1, 10), (1, 2, 3, 5, 7), (1, 2, 5), (1,))
    ]
    ticks = next((kind for kind in kinds if len(kind) <= MAX_TICKS), kinds[-1])
    if len(ticks) < 2:  # range within one digit
        ticks = [tick for tick in MaxNLocator(5).tick_values(low, high) if low <= tick <= high]
    axis.set_ticks(ticks, labels=[f"{tick:g}" for tick in ticks])
    axis.set_minor_locator(NullLocator())
    axis.set_view_interval(low, high, ignore=True)
