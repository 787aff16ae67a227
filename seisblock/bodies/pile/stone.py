"""One rectangular stone of a pile, and the joint between two."""

from __future__ import annotations

import math
from dataclasses import dataclass

from seisblock import checks
from seisblock.errors import BodyError

GROUND = "ground"
"""What the lowest stones stand on."""
GRANITE = 2650.0
"""Density of granite, kg/m^3; the motion of a pile of one stone does not depend on it."""
TOUCHING = 1e-6
"""Faces this close, m, touch."""


@dataclass(frozen=True)
class PileStone:
    """One rectangular stone of a pile.

    Parameters
    ----------
    name : str
    width, depth, height : float, m
        Sizes along x, y and z.
    offset : (float, float), m
        Where its centre is seen from the centre of the stone (or the point of the ground) it stands on, along x and y.
    on : str
        The stone it stands on, or ``ground``.
    density : float, kg/m^3
    mu : float or None, 1
        Friction of the joint under it; None: that of the pile.
    bottom : float or None, m
        Height of its lower face above the ground; None: the upper face of the stone it stands on.

    Raises
    ------
    BodyError
        If a size or the density is not positive, or the friction negative.
    """

    name: str
    width: float
    depth: float
    height: float
    offset: tuple[float, float] = (0.0, 0.0)
    on: str = GROUND
    density: float = GRANITE
    mu: float | None = None
    bottom: float | None = None

    def __post_init__(self) -> None:
        checks.positive("width of the stone {name}", self.width, "m", error=BodyError, name=self.name)
        checks.positive("depth of the stone {name}", self.depth, "m", error=BodyError, name=self.name)
        checks.positive("height of the stone {name}", self.height, "m", error=BodyError, name=self.name)
        checks.positive("density of the stone {name}", self.density, "kg/m^3", error=BodyError, name=self.name)
        if self.mu is not None:
            checks.not_negative("friction under the stone {name}", self.mu, error=BodyError, name=self.name)
        if len(self.offset) != 2 or not all(math.isfinite(part) for part in self.offset):
            raise BodyError(
                "offset of the stone {name} takes two lengths, along x and y; found {found}", name=self.name, found=str(self.offset)
            )

    @property
    def size(self) -> tuple[float, float, float]:
        """Width, depth and height, m."""
        return self.width, self.depth, self.height

    @property
    def mass(self) -> float:
        """Mass, kg."""
        return self.density * self.width * self.depth * self.height


@dataclass(frozen=True)
class Joint:
    """Two stones, face on face.

    Parameters
    ----------
    upper, lower : int
        Indices of the stones; ``lower`` is -1 for the ground.
    x, y : (float, float), m
        The rectangle in which they touch.
    height : float, m
        Its height above the ground.
    """

    upper: int
    lower: int
    x: tuple[float, float]
    y: tuple[float, float]
    height: float


def span(centre: float, size: float) -> tuple[float, float]:
    """Return the ends of a side."""
    return centre - 0.5 * size, centre + 0.5 * size


def overlap(a: float, size_a: float, b: float, size_b: float) -> tuple[float, float]:
    """Return the part that two sides share; its ends are in the wrong order where there is none."""
    return max(a - 0.5 * size_a, b - 0.5 * size_b), min(a + 0.5 * size_a, b + 0.5 * size_b)
