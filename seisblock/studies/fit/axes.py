"""What may be looked for in a block, between which bounds, and how a point of the unit cube stands for it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from seisblock import checks
from seisblock.bodies.block import Block
from seisblock.bodies.inset import HALF
from seisblock.errors import ParameterError
from seisblock.typing import FloatArray

ALPHA, P, RESTITUTION, INSET, SCATTER, LAPSE = "alpha", "p", "restitution", "inset", "scatter", "lapse"

FREE = (ALPHA, P, RESTITUTION, INSET)
"""Parameters that may be asked for; how far versions scatter and how often an outcome follows no model are found beside them."""

Bounds: TypeAlias = Mapping[str, tuple[float, float]]


@dataclass(frozen=True)
class Axis:
    """One parameter and what is thought of it before: as likely anywhere between its bounds, itself or its logarithm.

    Parameters
    ----------
    name : str
    low, high : float
        Bounds; alpha in rad, p in rad/s, shares of 1.
    logarithmic : bool
        Whether equal ratios are equally likely, instead of equal steps.
    """

    name: str
    low: float
    high: float
    logarithmic: bool = False

    def value(self, place: FloatArray) -> FloatArray:
        """Return the values at places between 0 and 1 along the axis."""
        if self.logarithmic:
            return np.exp(math.log(self.low) + place * math.log(self.high / self.low))
        return self.low + place * (self.high - self.low)


AXES = {
    axis.name: axis
    for axis in (
        Axis(ALPHA, 0.03, 1.0),
        Axis(P, 1.0, 25.0, logarithmic=True),
        Axis(RESTITUTION, 0.3, 0.99),
        Axis(INSET, 0.0, 0.45),
        Axis(SCATTER, 0.01, 0.2, logarithmic=True),
    )
}
"""Bounds unless others are given: a pencil to a brick, 7.4 m to 12 mm of R, impacts that lose a little to most."""

_REACH = {ALPHA: (0.0, math.pi / 2), P: (0.0, math.inf), RESTITUTION: (0.0, 1.0), INSET: (0.0, HALF), SCATTER: (0.0, 1.0)}
"""What the bounds must lie between."""


def axes_for(free: Iterable[str], bounds: Bounds, *, scatter: float | None, block: Block | None) -> tuple[Axis, ...]:
    """Return the axes of the parameters that are looked for, the scatter last.

    Parameters
    ----------
    free : iterable of str
    bounds : mapping of str to (float, float)
        Where others than the usual ones are known.
    scatter : float or None
        Half width of the changes, a share; None: looked for, too.
    block : Block or None
        Whose centre of gravity must stay above what an inset leaves of its base.

    Raises
    ------
    ParameterError
        If a parameter is unknown, is named twice, or its bounds are none.

    Examples
    --------
    >>> [axis.name for axis in axes_for(["alpha", "p"], {}, scatter=None, block=None)]
    ['alpha', 'p', 'scatter']
    """
    names = list(free)
    for name in names:
        if name not in FREE:
            raise ParameterError("{name!r} cannot be looked for; what can are {known}", name=str(name)[:100], known=list(FREE))
    if len(set(names)) < len(names):
        raise ParameterError("a parameter to look for is named twice: {names}", names=names)
    chosen = [*(name for name in FREE if name in names), *([SCATTER] if scatter is None else [])]
    for name in bounds:
        if name not in chosen:
            raise ParameterError("bounds of {name!r}, which is not looked for; what is: {known}", name=str(name)[:100], known=chosen)
    return tuple(_bounded(AXES[name], bounds, block) for name in chosen)


def _bounded(axis: Axis, bounds: Bounds, block: Block | None) -> Axis:
    """Return an axis between the bounds that are given, else its own."""
    if axis.name == INSET and block is not None:
        # a share of a millionth of the width stays under the centre of gravity
        axis = replace(axis, high=min(axis.high, HALF - abs(block.centroid_offset) / block.width - 1e-6))
    if axis.name not in bounds:
        return axis
    least, most = _REACH[axis.name]
    low, high = (checks.finite("a bound of {name}", end, name=axis.name) for end in bounds[axis.name])
    above = axis.logarithmic or axis.name == ALPHA
    told = {"name": axis.name, "least": least, "most": most, "low": low, "high": high}
    if above and not least < low < high < most:
        raise ParameterError("the bounds of {name} must rise, above {least:.4g} and below {most:.4g}; found {low:g} to {high:g}", **told)
    if not above and not least <= low < high < most:
        raise ParameterError("the bounds of {name} must rise, from {least:.4g} and below {most:.4g}; found {low:g} to {high:g}", **told)
    return replace(axis, low=low, high=high)
