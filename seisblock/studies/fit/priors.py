"""Priors of block parameters: bounds, and the map from the unit cube to parameter values."""

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
"""Parameters that may be free; scatter and lapse rate are fitted beside them."""

Bounds: TypeAlias = Mapping[str, tuple[float, float]]


@dataclass(frozen=True)
class Prior:
    """Prior of one parameter: uniform between its bounds, in the value or its logarithm.

    Parameters
    ----------
    name : str
    low, high : float
        Bounds; alpha in rad, p in rad/s, shares of 1.
    logarithmic : bool
        True for a uniform logarithm.
    """

    name: str
    low: float
    high: float
    logarithmic: bool = False

    def value(self, coordinate: FloatArray) -> FloatArray:
        """Return the parameter values at coordinates between 0 and 1."""
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
"""Default bounds: from a pencil to a brick, R from 7.4 m to 12 mm, impacts with small to large losses."""

_VALID_RANGES = {ALPHA: (0.0, math.pi / 2), P: (0.0, math.inf), RESTITUTION: (0.0, 1.0), INSET: (0.0, MAX_SHARE), SCATTER: (0.0, 1.0)}
"""Admissible range of the bounds."""


def make_priors(free: Iterable[str], bounds: Bounds, *, scatter: float | None, block: Block | None) -> tuple[Prior, ...]:
    """Return the priors of the free parameters, the scatter last.

    Parameters
    ----------
    free : iterable of str
    bounds : mapping of str to (float, float)
        Bounds other than the default ones.
    scatter : float or None
        Relative half width of the run-to-run changes; None: free.
    block : Block or None
        Its centre of gravity must stay above the worn base.

    Raises
    ------
    ParameterError
        If a parameter is unknown or duplicate, or its bounds are inadmissible.

    Examples
    --------
    >>> [axis.name for axis in make_priors(["alpha", "p"], {}, scatter=None, block=None)]
    ['alpha', 'p', 'scatter']
    """
    names = list(free)
    for name in names:
        if name not in FREE_PARAMETERS:
            raise ParameterError("{name!r} cannot be fitted; available: {known}", name=str(name)[:100], known=list(FREE_PARAMETERS))
    if len(set(names)) < len(names):
        raise ParameterError("duplicate parameter in `free`: {names}", names=names)
    free_names = [*(name for name in FREE_PARAMETERS if name in names), *([SCATTER] if scatter is None else [])]
    for name in bounds:
        if name not in free_names:
            raise ParameterError("`bounds` contains {name!r}, which is not free; free: {known}", name=str(name)[:100], known=free_names)
    return tuple(_with_bounds(DEFAULT_PRIORS[name], bounds, block) for name in free_names)


def _with_bounds(axis: Prior, bounds: Bounds, block: Block | None) -> Prior:
    """Return a prior with given bounds, or with its own."""
    if axis.name == INSET and block is not None:
        # a millionth of the width of the base must remain beyond the centre of gravity
        axis = replace(axis, high=min(axis.high, MAX_SHARE - abs(block.centroid_offset) / block.width - 1e-6))
    if axis.name not in bounds:
        return axis
    lower_limit, upper_limit = _VALID_RANGES[axis.name]
    low, high = (checks.finite("a bound of {name}", end, name=axis.name) for end in bounds[axis.name])
    is_open = axis.logarithmic or axis.name == ALPHA
    values = {"name": axis.name, "least": lower_limit, "most": upper_limit, "low": low, "high": high}
    if is_open and not lower_limit < low < high < upper_limit:
        raise ParameterError(
            "the bounds of {name} must be increasing, above {least:.4g} and below {most:.4g}; found {low:g} to {high:g}", **values
        )
    if not is_open and not lower_limit <= low < high < upper_limit:
        raise ParameterError(
            "the bounds of {name} must be increasing, at least {least:.4g} and below {most:.4g}; found {low:g} to {high:g}", **values
        )
    return replace(axis, low=low, high=high)
