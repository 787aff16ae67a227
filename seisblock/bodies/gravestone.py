"""A pile of rectangular stones: gravestones, lanterns, pagodas, columns of drums, stacked crates."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

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
    mu : float or None
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
        for what, unit in (("width", "m"), ("depth", "m"), ("height", "m"), ("density", "kg/m^3")):
            value = getattr(self, what)
            if not (value > 0.0 and math.isfinite(value)):
                raise BodyError(f"{what} of the stone {self.name} must be positive, found {value} {unit}")
        if self.mu is not None and not (self.mu >= 0.0 and math.isfinite(self.mu)):
            raise BodyError(f"friction under the stone {self.name} must be zero or more, found {self.mu}")
        if len(self.offset) != 2 or not all(math.isfinite(part) for part in self.offset):
            raise BodyError(f"offset of the stone {self.name} takes two lengths, along x and y; found {self.offset}")

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


@dataclass(frozen=True)
class Gravestone:
    """An ordered pile of stones ([Furukawa2009]_ section 3(2), fig. 3).

    Parameters
    ----------
    name : str
    stones : tuple of PileStone
        From below upwards.
    dowels : tuple of tuples of str
        Names of stones held together as one body ([Furukawa2009]_ section 3(6)).
    fixed : tuple of str
        Stones that move with the ground.
    mu : float
        Friction of the joints that have none of their own; 0.438 is that of [Furukawa2009]_ table 2.

    Raises
    ------
    BodyError
        If stones overlap, float, or do not touch where a dowel holds them; if the pile is unstable at rest.
    """

    name: str
    stones: tuple[PileStone, ...]
    dowels: tuple[tuple[str, ...], ...] = ()
    fixed: tuple[str, ...] = ()
    mu: float = 0.438

    def __post_init__(self) -> None:
        from seisblock.bodies.pile_checks import check_pile

        check_pile(self)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the stones, from below upwards."""
        return tuple(stone.name for stone in self.stones)

    def centres(self) -> list[tuple[float, float, float]]:
        """Return the centres of the stones, m, seen from the ground under the pile."""
        found: dict[str, tuple[float, float, float]] = {}
        for stone in self.stones:
            x, y, top = 0.0, 0.0, 0.0
            if stone.on != GROUND:
                below = self.stones[self.names.index(stone.on)]
                x, y, middle = found[stone.on]
                top = middle + 0.5 * below.height
            bottom = top if stone.bottom is None else stone.bottom
            found[stone.name] = (x + stone.offset[0], y + stone.offset[1], bottom + 0.5 * stone.height)
        return [found[stone.name] for stone in self.stones]

    def joints(self) -> list[Joint]:
        """Return where stones stand on each other and on the ground."""
        centres = self.centres()
        made = []
        for upper, stone in enumerate(self.stones):
            floor = centres[upper][2] - 0.5 * stone.height
            if abs(floor) <= TOUCHING:
                made.append(Joint(upper, -1, _span(centres[upper][0], stone.width), _span(centres[upper][1], stone.depth), floor))
            for lower, below in enumerate(self.stones):
                if lower != upper and abs(centres[lower][2] + 0.5 * below.height - floor) <= TOUCHING:
                    shared = [_shared(centres[upper][k], stone.size[k], centres[lower][k], below.size[k]) for k in (0, 1)]
                    if all(high - low > TOUCHING for low, high in shared):
                        made.append(Joint(upper, lower, shared[0], shared[1], floor))
        return made

    def bodies(self) -> Iterator[tuple[int, ...]]:
        """Yield the stones that move as one, without the fixed ones."""
        index = {name: i for i, name in enumerate(self.names)}
        held = {name: tuple(sorted(index[member] for member in group)) for group in self.dowels for name in group}
        done: set[int] = set()
        for i, name in enumerate(self.names):
            members = held.get(name, (i,))
            if i not in done and not any(self.names[m] in self.fixed for m in members):
                done.update(members)
                yield members

    def without(self, *names: str) -> Gravestone:
        """Return the pile without some of its stones, on which none of the others may stand."""
        kept = tuple(stone for stone in self.stones if stone.name not in names)
        dowels = tuple(group for group in self.dowels if not set(group) & set(names))
        return replace(self, stones=kept, dowels=dowels, fixed=tuple(name for name in self.fixed if name not in names))

    def dowelled(self, *names: str) -> Gravestone:
        """Return the pile with these stones held together."""
        return replace(self, dowels=(*self.dowels, names))


def _span(centre: float, size: float) -> tuple[float, float]:
    """Return the ends of a side."""
    return centre - 0.5 * size, centre + 0.5 * size


def _shared(a: float, size_a: float, b: float, size_b: float) -> tuple[float, float]:
    """Return the part that two sides share; its ends are in the wrong order where there is none."""
    return max(a - 0.5 * size_a, b - 0.5 * size_b), min(a + 0.5 * size_a, b + 0.5 * size_b)
