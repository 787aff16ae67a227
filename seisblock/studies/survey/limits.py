"""Overturning PGA of each stone of a cemetery by criteria in closed form."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.cemetery.cemetery import Cemetery
from seisblock.bodies.edge_wear import DEFAULT_WEAR, EdgeWear
from seisblock.bodies.table import PAPER_WIDTH
from seisblock.core.errors import ParameterError
from seisblock.core.typing import FloatArray
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.criteria.gravestones import DOWELLED, PLAIN, GravestoneFit, overturning_level
from seisblock.criteria.pulses import half_sine_ratio

Limits = Callable[[Cemetery, float], FloatArray]
"""Criterion: from a cemetery and a frequency (Hz) to the overturning PGA (m/s^2) of each stone, (size,)."""


def fitted_limits(cemetery: Cemetery, frequency: float, *, fits: tuple[GravestoneFit, GravestoneFit] = (PLAIN, DOWELLED)) -> FloatArray:
    """Return the overturning PGA of each stone by the gravestone criterion of its kind ([Furukawa2009]_ eqs. (9), (10)).

    Parameters
    ----------
    cemetery : Cemetery
    frequency : float, Hz
        Frequency of a sine, or equivalent frequency; zero or more.
    fits : two GravestoneFit
        Criteria of stones without and with a dowel.

    Returns
    -------
    (size,) array, m/s^2
    """
    plain, dowelled = (float(overturning_level(frequency, fit)) for fit in fits)
    limits: FloatArray = np.where(cemetery.reinforced, dowelled, plain) / cemetery.ratios
    return limits


def rigid_limits(
    cemetery: Cemetery, frequency: float, *, inset: EdgeWear = DEFAULT_WEAR, width: float = PAPER_WIDTH, gravity: float = STANDARD_GRAVITY
) -> FloatArray:
    """Return the overturning PGA of each stone as one rigid block under a half-sine pulse ([Housner1963]_).

    It is alpha g X, X the exact factor of a slender block, and at least the rocking threshold g B/H ([Furukawa2009]_ eq. (2)).

    Parameters
    ----------
    cemetery : Cemetery
        Stones without dowels: a dowelled pile is not a rigid block.
    frequency : float, Hz
        As for :func:`fitted_limits`.
    inset : EdgeWear
        Edge wear of stones without their own: a length, or a share of the width, per side.
    width : float, m
        Width of stones of unknown width.
    gravity : float, m/s^2

    Returns
    -------
    (size,) array, m/s^2

    Raises
    ------
    ParameterError
        If a stone is reinforced, or the inset leaves nothing of a base.
    """
    require_undowelled(cemetery)
    if not frequency >= 0.0:
        raise ParameterError("`frequency` must be zero or positive, found {frequency} Hz", frequency=frequency)
    # equal stones share one limit: cemeteries have many of one size
    limits: dict[Block, float] = {}
    values = []
    for stone in cemetery.stones:
        b = width if stone.width is None else stone.width
        block = Block(b, b * stone.height_over_width).with_wear(inset if stone.inset is None else stone.inset)
        if block not in limits:
            limits[block] = _rigid_limit(block, frequency, gravity)
        values.append(limits[block])
    return np.repeat(np.array(values), [stone.count for stone in cemetery.stones])


def _rigid_limit(stone: Block, frequency: float, gravity: float) -> float:
    """Return the amplitude of the overturning half sine of one stone, m/s^2 ([Housner1963]_; at least [Furukawa2009]_ eq. (2))."""
    w = 2.0 * np.pi * frequency / stone.frequency_parameter(gravity)
    factor = half_sine_ratio(w) if w > 0.0 else 1.0
    return max(stone.rocking_threshold(gravity), gravity * stone.slenderness * factor)


def require_undowelled(cemetery: Cemetery) -> None:
    """Raise ParameterError for reinforced stones: a rigid block does not represent [Furukawa2009]_ eq. (10)."""
    if cemetery.reinforced.any():
        raise ParameterError(
            "{source}: some stones are reinforced, and a rigid block does not model dowels; use the criterion furukawa",
            source=cemetery.source or cemetery.name,
        )
