"""Ranges of a kind of body: priors of worn edges and friction, and the sizes that are usual."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from seisblock import checks
from seisblock.bodies.inset import parse_inset
from seisblock.bodies.toml import entries, lengths, refuse_unknown, source_of, subtable
from seisblock.errors import BodyError
from seisblock.units import parse_length
from seisblock.words import Said, noted, said

Range = tuple[float, float]
"""Least and largest."""


@dataclass(frozen=True)
class Ranges:
    """Limits of the bodies of a kind; None where they are not known.

    Samples of a body are drawn from the ranges of its edges and its friction, values that nobody has measured on this one. Its width and
    height are known, and vary by their own tolerance, whatever the sizes of its kind are.

    Parameters
    ----------
    width_m, height_m : (float, float) or None, m
        Usual sizes of the kind, along the motion and overall; not drawn from.
    inset_m : (float, float) or None, m
        Distance of the worn edges from each side.
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
        """The ranges in words."""
        width = _told(self.width_m, noted("width {low:.4g} to {high:.4g} m"))
        height = _told(self.height_m, noted("height {low:.4g} to {high:.4g} m"))
        return said("{parts}", parts=[part for part in (width, height, self.edges, self.friction) if part is not None])

    @property
    def priors(self) -> Ranges | None:
        """The ranges that samples are drawn from, edges and friction; None where there is neither."""
        return self.without("width_m", "height_m")

    @property
    def edges(self) -> Said | None:
        """The range of the worn edges, in words."""
        return _told(self.inset_m, noted("edges {low:.4g} to {high:.4g} m in"))

    @property
    def friction(self) -> Said | None:
        """The range of the friction, in words."""
        return _told(self.mu, noted("mu {low:g} to {high:g}"))

    def without(self, *names: str) -> Ranges | None:
        """Return the ranges but for some, which are known; None where none is left."""
        left = replace(self, **dict.fromkeys(names))
        return left if left != Ranges() else None


def _told(known: Range | None, text: str) -> Said | None:
    """Return a range in words, None where there is none."""
    return None if known is None else said(text, low=known[0], high=known[1])


def ranges_of(table: Mapping[str, Any], held: Mapping[str, float | None]) -> Ranges | None:
    """Return the ranges of a body's file, None where it tells none.

    Parameters
    ----------
    table : mapping
        Of the body; ``[ranges]`` in it holds two numbers for each of ``width``, ``height`` and ``inset`` (m, or with a unit; an inset also
        in per cent of the width) and ``mu``.
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
    found = {f"{key}_m": lengths(told, key, 2) for key in ("width", "height") if key in told}
    if "inset" in told:
        low, high = (_inset(told, end, held.get("width")) for end in entries(told, "inset", 2))
        found["inset_m"] = (low, high)
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


def _inset(told: Mapping[str, Any], end: Any, width: float | None) -> float:
    """Return one end of the range of the edges, m: per cent are of the body's width."""
    if width is not None and isinstance(end, str) and "%" in end:
        return parse_inset(end).of(width)
    return parse_length(end, what=said("{source}: {key}", source=source_of(told), key="inset"))


def _pair(told: Mapping[str, Any]) -> list[Any]:
    """Return the two numbers of the friction."""
    value = told["mu"]
    if not isinstance(value, list) or len(value) != 2:
        raise BodyError("{source}: mu must be a list of 2 numbers, found {found}", source=source_of(told), found=repr(value)[:40])
    return value
