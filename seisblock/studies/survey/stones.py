"""Computed outcome of each stone of a cemetery, compared with the observed one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.cemetery.cemetery import Cemetery
from seisblock.bodies.table import PAPER_WIDTH
from seisblock.core.typing import BoolArray, FloatArray


@dataclass(frozen=True)
class StoneResult:
    """Computed and observed outcome of one row of a survey; the fields are the keys of the JSON documents.

    Parameters
    ----------
    id : str
        Name of the stone, or number of its row.
    width_m, height_m : float
        Sizes of the upper stone; of an unknown width the default one.
    threshold_m_s2 : float
        Acceleration above which the stone overturns by a closed-form criterion, or starts to rock if simulated.
    overturns : bool
        Computed outcome.
    probability : float
        Overturning probability.
    observed : bool or None
        Observed outcome; None if unknown.
    agrees : bool or None
        True if both outcomes are equal.
    count : int
        Number of such stones.
    """

    id: str
    width_m: float
    height_m: float
    threshold_m_s2: float
    overturns: bool
    probability: float
    observed: bool | None
    agrees: bool | None
    count: int = 1


@dataclass(frozen=True)
class Contingency:
    """Numbers of surveyed stones by computed and observed overturning; the fields are the keys of the JSON documents.

    Parameters
    ----------
    both, computed_only, observed_only, neither : int
    """

    both: int
    computed_only: int
    observed_only: int
    neither: int

    @property
    def stones(self) -> int:
        """Number of surveyed stones."""
        return self.both + self.computed_only + self.observed_only + self.neither

    @property
    def agreement(self) -> float:
        """Share of the stones whose outcomes agree."""
        return (self.both + self.neither) / self.stones


def stone_results(
    cemetery: Cemetery, thresholds: FloatArray, falls: BoolArray, probabilities: FloatArray, *, width: float = PAPER_WIDTH
) -> tuple[StoneResult, ...]:
    """Return the outcome of each row of a cemetery.

    Parameters
    ----------
    cemetery : Cemetery
    thresholds, falls, probabilities : (rows,) arrays
        m/s^2, bool and 1.
    width : float, m
        Width of stones of unknown width.
    """
    results = []
    rows = zip(cemetery.stones, thresholds.tolist(), falls.tolist(), probabilities.tolist(), strict=True)
    for number, (stone, threshold, overturns, probability) in enumerate(rows, start=1):
        b = width if stone.width is None else stone.width
        agrees = None if stone.fallen is None else stone.fallen == overturns
        height = b * stone.height_over_width
        results.append(
            StoneResult(stone.name or str(number), b, height, threshold, overturns, probability, stone.fallen, agrees, stone.count)
        )
    return tuple(results)


def count_agreement(stones: Sequence[StoneResult]) -> Contingency | None:
    """Return the contingency of computed and observed outcomes; None without an observed one.

    Examples
    --------
    >>> stones = [StoneResult("1", 0.24, 0.72, 3.3, computed, 0.5, observed, None) for computed, observed in ((True, True), (True, False))]
    >>> count_agreement(stones)
    Contingency(both=1, computed_only=1, observed_only=0, neither=0)
    """
    surveyed = [stone for stone in stones if stone.observed is not None]
    if not surveyed:
        return None
    counts = {
        pair: sum(stone.count for stone in surveyed if (stone.overturns, stone.observed) == pair)
        for pair in ((True, True), (True, False), (False, True), (False, False))
    }
    return Contingency(*counts.values())


def either(falls: Sequence[BoolArray]) -> BoolArray:
    """Return the stones, or samples of stones, that overturn under any of several motions."""
    result: BoolArray = np.logical_or.reduce(list(falls))
    return result
