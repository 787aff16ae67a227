"""How far bodies of a kind differ: ranges of width, height, worn edges and friction that a body's file tells, and what lies in them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from seisblock import checks
from seisblock.bodies.toml import lengths, refuse_unknown, source_of, subtable
from seisblock.errors import BodyError
from seisblock.typing import FloatArray
from seisblock.words import Said, noted, roughly, said

Range = tuple[float, float]
"""Least and largest."""


@dataclass(frozen=True)
class Ranges:
    """Within which limits the bodies of a kind lie; None where nothing is known.

    Parameters
    ----------
    width_m, height_m : (float, float) or None, m
        Along the motion, and overall.
    inset_m : (float, float) or None, m
        How far in from each side they turn.
    mu : (float, float) or None, 1
        Static friction.

    Raises
    ------
    BodyError
        If a range runs backwards, a number lies outside its own range, or an inset leaves nothing of the narrowest base.

    Examples
    --------
    >>> print(Ranges(width_m=(0.6, 0.75), mu=(0.2, 0.5)).says)
    width 0.6 to 0.75 m, mu 0.2 to 0.5
    """

    width_m: Range | None = None
    height_m: Range | None = None
    inset_m: Range | None = None
    mu: Range | None = None

    def __post_init__(self) -> None:
        for key, name in (("width_m", "width"), ("height_m", "height"), ("inset_m", "inset"), ("mu", "mu")):
            given, least = getattr(self, key), checks.not_negative if name == "inset" else checks.positive
            if given is None:
                continue
            low, high = (least("the range of {name}", each, error=BodyError, name=name) for each in given)
            if low > high:
                text = "the range of {name} runs from {low:g} to {high:g}: tell the lesser number first"
                raise BodyError(text, name=name, low=low, high=high)
            object.__setattr__(self, key, (low, high))
        if self.inset_m is not None and self.width_m is not None and self.inset_m[1] >= self.width_m[0] / 2:
            text = "an inset of {inset:g} m leaves nothing of a width of {width:g} m: narrow the ranges"
            raise BodyError(text, inset=self.inset_m[1], width=self.width_m[0])

    @property
    def says(self) -> Said:
        """What is known, in words."""
        return said("{parts}", parts=[part for part in (*self._sizes, self.edges, self.friction) if part is not None])

    @property
    def _sizes(self) -> tuple[Said | None, Said | None]:
        """What is known of width and height, in words."""
        return _told(self.width_m, noted("width {low:.4g} to {high:.4g} m")), _told(
            self.height_m, noted("height {low:.4g} to {high:.4g} m")
        )

    @property
    def edges(self) -> Said | None:
        """What is known of the worn edges, in words."""
        return _told(self.inset_m, noted("edges {low:.4g} to {high:.4g} m in"))

    @property
    def friction(self) -> Said | None:
        """What is known of the friction, in words."""
        return _told(self.mu, noted("mu {low:g} to {high:g}"))

    def sizes(self, share: float) -> Said:
        """Return how far width and height differ, in words: within their ranges, or by a share where they have none.

        Examples
        --------
        >>> print(Ranges(width_m=(0.6, 0.75)).sizes(0.05))
        width 0.6 to 0.75 m, height ±5 %
        """
        width, height = self._sizes
        wide, tall = (said(text, share=roughly(share)) for text in (noted("width ±{share}"), noted("height ±{share}")))
        return said("{parts}", parts=[width or wide, height or tall])

    def without(self, *names: str) -> Ranges | None:
        """Return the ranges but for some, which are known; None where none is left."""
        left = replace(self, **dict.fromkeys(names))
        return left if left != Ranges() else None


def _told(known: Range | None, text: str) -> Said | None:
    """Return a range in words, None where there is none."""
    return None if known is None else said(text, low=known[0], high=known[1])


def within(known: Range, draws: FloatArray) -> FloatArray:
    """Return what lies in a range, for draws in [-1, 1]."""
    low, high = known
    return low + 0.5 * (high - low) * (1.0 + draws)


def ranges_of(table: Mapping[str, Any], held: Mapping[str, float | None]) -> Ranges | None:
    """Return the ranges of a body's file, None where it tells none.

    Parameters
    ----------
    table : mapping
        Of the body; ``[ranges]`` in it holds two numbers for each of ``width``, ``height`` and ``inset`` (m, or with a unit) and ``mu``.
    held : mapping
        What the body itself has of these, which must lie in them.

    Raises
    ------
    BodyError
        If it says something else, or the body lies outside its own ranges.
    """
    if "ranges" not in table:
        return None
    told = subtable(table, "ranges")
    refuse_unknown(told, ("width", "height", "inset", "mu"))
    found = {f"{key}_m": lengths(told, key, 2) for key in ("width", "height", "inset") if key in told}
    if "mu" in told:
        low, high = (checks.finite("{source}: {key}", each, error=BodyError, source=source_of(told), key="mu") for each in _pair(told))
        found["mu"] = (low, high)
    for key, (low, high) in found.items():
        name = key.removesuffix("_m")
        own = held.get(name)
        if own is not None and not low * (1 - 1e-9) <= own <= high * (1 + 1e-9):
            text = "{source}: {key} is {own:g} in the body, outside its range of {low:g} to {high:g}"
            raise BodyError(text, source=source_of(told), key=name, own=own, low=low, high=high)
    try:
        return Ranges(**found)  # type: ignore[arg-type]
    except BodyError as error:
        raise BodyError("{source}: {why}", source=source_of(told), why=error.said) from error


def _pair(told: Mapping[str, Any]) -> list[Any]:
    """Return the two numbers of the friction."""
    value = told["mu"]
    if not isinstance(value, list) or len(value) != 2:
        raise BodyError("{source}: mu must be a list of 2 numbers, found {found}", source=source_of(told), found=repr(value)[:40])
    return value
