"""Parameter ranges of a kind of body: priors of edge wear and friction, usual sizes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from seisblock.bodies.edge_wear import parse_edge_wear
from seisblock.bodies.toml import check_keys, entries, get_lengths, get_subtable, source_name
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import BodyError
from seisblock.core.i18n import N_, Message, lazy_gettext
from seisblock.core.units import parse_length

Range = tuple[float, float]
"""Smallest and largest value."""


@dataclass(frozen=True, repr=False)
class ParameterRanges(DisplayMixin):
    """Parameter ranges of a kind of body; None where unknown.

    Samples of a body are drawn from the ranges of edge wear and friction, which are unknown for the individual body. Its width and height
    are known and vary by their own tolerance, independent of the sizes of the kind.

    Parameters
    ----------
    width_m, height_m : (float, float) or None, m
        Usual sizes of the kind, along the motion and overall; not used for samples.
    inset_m : (float, float) or None, m
        Distance of the worn edges from each side.
    mu : (float, float) or None, 1
        Static friction.

    Raises
    ------
    BodyError
        If a range is reversed, a number lies outside its valid range, or an inset leaves no base at the smallest width.

    Examples
    --------
    >>> print(ParameterRanges(width_m=(0.6, 0.75), mu=(0.2, 0.5)).description)
    width 0.6 to 0.75 m, mu 0.2 to 0.5
    """

    width_m: Range | None = None
    height_m: Range | None = None
    inset_m: Range | None = None
    mu: Range | None = None

    def __post_init__(self) -> None:
        for key, name in (("width_m", "width"), ("height_m", "height"), ("inset_m", "inset"), ("mu", "mu")):
            limits, check = getattr(self, key), checks.non_negative if name == "inset" else checks.positive
            if limits is None:
                continue
            low, high = (check("the range of {name}", value, error=BodyError, name=name) for value in limits)
            if low > high:
                text = "the range of {name} runs from {low:g} to {high:g}: give the smaller number first"
                raise BodyError(text, name=name, low=low, high=high)
            object.__setattr__(self, key, (low, high))
        if self.inset_m is not None and self.width_m is not None and self.inset_m[1] >= self.width_m[0] / 2:
            text = "an inset of {inset:g} m is too large for a width of {width:g} m: narrow the ranges"
            raise BodyError(text, inset=self.inset_m[1], width=self.width_m[0])

    @property
    def description(self) -> Message:
        """The ranges as text."""
        width = _format_range(self.width_m, N_("width {low:.4g} to {high:.4g} m"))
        height = _format_range(self.height_m, N_("height {low:.4g} to {high:.4g} m"))
        return lazy_gettext("{parts}", parts=[part for part in (width, height, self.edges_text, self.friction_text) if part is not None])

    @property
    def priors(self) -> ParameterRanges | None:
        """The ranges from which samples are drawn (edges and friction); None without them."""
        return self.without("width_m", "height_m")

    @property
    def edges_text(self) -> Message | None:
        """The range of the edge wear as text."""
        return _format_range(self.inset_m, N_("edges worn by {low:.4g} to {high:.4g} m"))

    @property
    def friction_text(self) -> Message | None:
        """The range of the friction as text."""
        return _format_range(self.mu, N_("mu {low:g} to {high:g}"))

    def without(self, *names: str) -> ParameterRanges | None:
        """Return the ranges without those of known parameters; None if none is left."""
        remaining_ranges = replace(self, **dict.fromkeys(names))
        return remaining_ranges if remaining_ranges != ParameterRanges() else None


def _format_range(limits: Range | None, text: str) -> Message | None:
    return None if limits is None else lazy_gettext(text, low=limits[0], high=limits[1])


def parse_ranges(table: Mapping[str, Any], body_values: Mapping[str, float | None]) -> ParameterRanges | None:
    """Return the ranges in a body's table, None without ``[ranges]``.

    Parameters
    ----------
    table : mapping
        Of the body; ``[ranges]`` in it holds two numbers for each of ``width``, ``height`` and ``inset`` (m, or with a unit; an inset also
        in per cent of the width) and ``mu``.
    body_values : mapping
        Values of the body, which must lie in the ranges.

    Raises
    ------
    BodyError
        If the table is invalid, or the body lies outside its ranges.
    """
    if "ranges" not in table:
        return None
    range_table = get_subtable(table, "ranges")
    check_keys(range_table, ("width", "height", "inset", "mu"))
    limits = {f"{key}_m": get_lengths(range_table, key, 2) for key in ("width", "height") if key in range_table}
    if "inset" in range_table:
        low, high = (_inset(range_table, end, body_values.get("width")) for end in entries(range_table, "inset", 2))
        limits["inset_m"] = (low, high)
    if "mu" in range_table:
        low, high = (
            checks.finite("{source}: {key}", value, error=BodyError, source=source_name(range_table), key="mu")
            for value in _parse_pair(range_table)
        )
        limits["mu"] = (low, high)
    for key, (low, high) in limits.items():
        name = key.removesuffix("_m")
        body_value = body_values.get(name)
        if body_value is not None and not low * (1 - 1e-9) <= body_value <= high * (1 + 1e-9):
            text = "{source}: {key} of the body is {own:g}, outside its range of {low:g} to {high:g}"
            raise BodyError(text, source=source_name(range_table), key=name, own=body_value, low=low, high=high)
    try:
        return ParameterRanges(**limits)  # type: ignore[arg-type]
    except BodyError as error:
        raise BodyError("{source}: {why}", source=source_name(range_table), why=error.message) from error


def _inset(table: Mapping[str, Any], end: Any, width: float | None) -> float:
    """Return one end of the inset range, m; percentages refer to the body's width."""
    if width is not None and isinstance(end, str) and "%" in end:
        return parse_edge_wear(end).inset(width)
    return parse_length(end, quantity=lazy_gettext("{source}: {key}", source=source_name(table), key="inset"))


def _parse_pair(range_table: Mapping[str, Any]) -> list[Any]:
    value = range_table["mu"]
    if not isinstance(value, list) or len(value) != 2:
        raise BodyError("{source}: mu must be a list of 2 numbers, found {found}", source=source_name(range_table), found=repr(value)[:40])
    return value
