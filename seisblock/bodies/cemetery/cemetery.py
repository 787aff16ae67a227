"""Gravestones of a cemetery: proportions of the upper stone (sao) and observed overturning."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from seisblock.bodies.edge_wear import EdgeWear
from seisblock.bodies.table import PAPER_WIDTH
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import BodyError
from seisblock.core.typing import BoolArray, FloatArray, IntArray


@dataclass(frozen=True, repr=False)
class Stone(DisplayMixin):
    """One gravestone, or several of equal proportions.

    Parameters
    ----------
    height_over_width : float
        H/B of the sao, positive.
    width : float or None, m
        B, None if unknown.
    reinforced : bool
        Whether a dowel joins sao and jodai.
    fallen : bool or None
        Whether the stone overturned; None if unknown.
    azimuth_deg : float or None
        Azimuth of the front, degrees clockwise from north.
    count : int
        Number of such stones, positive.
    line : int or None
        Line of the source file.
    name : str
        Name or number of the stone.
    inset : EdgeWear or None
        Measured edge wear; None: the prior of gravestones, or that of a call.

    Raises
    ------
    BodyError
        If the ratio, the width or the count is not positive.
    """

    height_over_width: float
    width: float | None = None
    reinforced: bool = False
    fallen: bool | None = None
    azimuth_deg: float | None = None
    count: int = 1
    line: int | None = None
    name: str = ""
    inset: EdgeWear | None = None

    def __post_init__(self) -> None:
        checks.positive("height over width of a gravestone", self.height_over_width, error=BodyError)
        checks.positive("number of gravestones (count)", self.count, error=BodyError)
        if self.width is not None:
            checks.positive("width of a gravestone", self.width, "m", error=BodyError)
        if self.azimuth_deg is not None:
            checks.finite("azimuth of a gravestone", self.azimuth_deg, "degrees", error=BodyError)

    @property
    def height(self) -> float | None:
        """Height H of the upper stone (sao), m; None without a width."""
        return None if self.width is None else self.width * self.height_over_width


@dataclass(frozen=True, repr=False)
class Cemetery(DisplayMixin):
    """Gravestones of one place.

    Parameters
    ----------
    stones : tuple of Stone
        At least one.
    name : str
        Name for tables and figures.
    source : str
        Source file, empty if created in memory.
    notes : tuple of str
        Comments at the head of the file: origin of the data.

    Raises
    ------
    BodyError
        If there is no stone.

    Examples
    --------
    >>> cemetery = Cemetery((Stone(2.0), Stone(3.0, count=3)))
    >>> cemetery.size, cemetery.share_above(2.5)
    (4, 0.75)
    """

    stones: tuple[Stone, ...]
    name: str = "cemetery"
    source: str = ""
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "stones", tuple(self.stones))
        if not self.stones:
            raise BodyError("{source} contains no gravestones", source=self.source or self.name)

    @property
    def size(self) -> int:
        """Number of stones, counts included."""
        return sum(stone.count for stone in self.stones)

    @property
    def ratios(self) -> FloatArray:
        """H/B of each stone, (size,)."""
        return np.repeat(np.array([stone.height_over_width for stone in self.stones]), self._counts)

    @property
    def reinforced(self) -> BoolArray:
        """Mask of reinforced stones, (size,)."""
        return np.repeat(np.array([stone.reinforced for stone in self.stones]), self._counts)

    def widths(self, default: float = PAPER_WIDTH) -> FloatArray:
        """Width of each stone, (size,), m; `default` where unknown."""
        return np.repeat(np.array([default if stone.width is None else stone.width for stone in self.stones]), self._counts)

    @property
    def has_survey(self) -> bool:
        """True if the outcome of any stone is known."""
        return any(stone.fallen is not None for stone in self.stones)

    def share_above(self, height_over_width: float) -> float:
        """Return the share of stones whose H/B exceeds a value ([Furukawa2009]_ fig. 15)."""
        return float(np.count_nonzero(self.ratios > height_over_width)) / self.size

    def rows(self) -> Cemetery:
        """Return the cemetery with each row as one stone."""
        return replace(self, stones=tuple(replace(stone, count=1) for stone in self.stones))

    def without_outcomes(self) -> Cemetery:
        """Return the cemetery with all outcomes unknown."""
        return replace(self, stones=tuple(replace(stone, fallen=None) for stone in self.stones))

    def select(self, predicate: Callable[[Stone], bool]) -> Cemetery:
        """Return the cemetery of the stones that satisfy a predicate."""
        return replace(self, stones=tuple(stone for stone in self.stones if predicate(stone)))

    def with_dowels(self, most_fragile: int | None = None) -> Cemetery:
        """Return the cemetery with all, or the most slender, stones reinforced.

        Parameters
        ----------
        most_fragile : int or None
            Number of stones to reinforce, in addition to those already reinforced; None for all.

        Returns
        -------
        Cemetery
        """
        if most_fragile is None:
            return replace(self, stones=tuple(replace(stone, reinforced=True) for stone in self.stones))
        remaining, stones = most_fragile, list(self.stones)
        for index in sorted(range(len(stones)), key=lambda i: -stones[i].height_over_width):
            stone = stones[index]
            if stone.reinforced or remaining <= 0:
                continue
            dowelled_count = min(remaining, stone.count)
            remaining -= dowelled_count
            stones[index] = replace(stone, reinforced=True, count=dowelled_count)
            if dowelled_count < stone.count:
                stones.append(replace(stone, count=stone.count - dowelled_count))
        return replace(self, stones=tuple(stones))

    @property
    def _counts(self) -> IntArray:
        """Return the count of each row."""
        return np.array([stone.count for stone in self.stones], dtype=np.int64)
