"""What may be looked for in a block, between which bounds, and how a point of the unit cube stands for it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.edge_wear import MAX_SHARE
from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.typing import FloatArray

ALPHA, P, RESTITUTION, INSET, SCATTER, LAPSE = "alpha", "p", "restitution", "inset", "scatter", "lapse"

FREE_PARAMETERS = (ALPHA, P, RESTITUTION, INSET)
"""Parameters that may be asked for; how far versions scatter and how often an outcome follows no model are found beside them."""

Bounds: TypeAlias = Mapping[str, tuple[float, float]]


@dataclass(frozen=True)
class Prior:
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

    def value(self, coordinate: FloatArray) -> FloatArray:
        """Return the values at places between 0 and 1 along the axis."""
        if self.logarithmic:
            return np.exp(math.log(self.low) + coordinate * math.log(self.high / self.low))
        return self.low + coordinate * (self.high - self.low)


DEFAULT_PRIORS = {
    axis.name: axis
    for axis in (
        Prior(ALPHA, 0.03, 1.0),
        Prior(P, 1.0, 25.0, logarithmic=True),
        Prior(RESTITUTION, 0.3, 0.99),
        Prior(INSET, 0.0, 0.45),
        Prior(SCATTER, 0.01, 0.2, logarithmic=True),
    )
}
"""Bounds unless others are given: a pencil to a brick, 7.4 m to 12 mm of R, impacts that lose a little to most."""

_VALID_RANGES = {ALPHA: (0.0, math.pi / 2), P: (0.0, math.inf), RESTITUTION: (0.0, 1.0), INSET: (0.0, MAX_SHARE), SCATTER: (0.0, 1.0)}
"""What the bounds must lie between."""


def make_priors(free: Iterable[str], bounds: Bounds, *, scatter: float | None, block: Block | None) -> tuple[Prior, ...]:
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
    >>> [axis.name for axis in make_priors(["alpha", "p"], {}, scatter=None, block=None)]
    ['alpha', 'p', 'scatter']
    """
    names = list(free)
    for name in names:
        if name not in FREE_PARAMETERS:
            raise ParameterError("{name!r} cannot be looked for; what can are {known}", name=str(name)[:100], known=list(FREE_PARAMETERS))
    if len(set(names)) < len(names):
        raise ParameterError("a parameter to look for is named twice: {names}", names=names)
    free_names = [*(name for name in FREE_PARAMETERS if name in names), *([SCATTER] if scatter is None else [])]
    for name in bounds:
        if name not in free_names:
            raise ParameterError("bounds of {name!r}, which is not looked for; what is: {known}", name=str(name)[:100], known=free_names)
    return tuple(_with_bounds(DEFAULT_PRIORS[name], bounds, block) for name in free_names)


def _with_bounds(axis: Prior, bounds: Bounds, block: Block | None) -> Prior:
    """Return an axis between the bounds that are given, else its own."""
    if axis.name == INSET and block is not None:
        # a share of a millionth of the width stays under the centre of gravity
        axis = replace(axis, high=min(axis.high, MAX_SHARE - abs(block.centroid_offset) / block.width - 1e-6))
    if axis.name not in bounds:
        return axis
    lower_limit, upper_limit = _VALID_RANGES[axis.name]
    low, high = (checks.finite("a bound of {name}", end, name=axis.name) for end in bounds[axis.name])
    is_open = axis.logarithmic or axis.name == ALPHA
    values = {"name": axis.name, "least": lower_limit, "most": upper_limit, "low": low, "high": high}
    if is_open and not lower_limit < low < high < upper_limit:
        raise ParameterError("the bounds of {name} must rise, above {least:.4g} and below {most:.4g}; found {low:g} to {high:g}", **values)
    if not is_open and not lower_limit <= low < high < upper_limit:
        raise ParameterError("the bounds of {name} must rise, from {least:.4g} and below {most:.4g}; found {low:g} to {high:g}", **values)
    return replace(axis, low=low, high=high)
