"""The PGA beyond which each stone of a cemetery falls: the criteria that have a closed form, stone by stone."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.cemetery.cemetery import PAPER_WIDTH, Cemetery
from seisblock.bodies.edge_wear import DEFAULT_WEAR, EdgeWear
from seisblock.core.errors import ParameterError
from seisblock.core.typing import FloatArray
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.criteria.gravestones import DOWELLED, PLAIN, GravestoneFit, overturning_level
from seisblock.criteria.pulses import half_sine_ratio

Limits = Callable[[Cemetery, float], FloatArray]
"""A criterion: from a cemetery and a frequency (Hz) to the PGA (m/s^2) beyond which each stone falls, (size,)."""


def fitted_limits(cemetery: Cemetery, frequency: float, *, fits: tuple[GravestoneFit, GravestoneFit] = (PLAIN, DOWELLED)) -> FloatArray:
    """Return the PGA beyond which each stone falls by the fit of its kind ([Furukawa2009]_ eqs. (9), (10)).

    Parameters
    ----------
    cemetery : Cemetery
    frequency : float, Hz
        Of a sine, or equivalent; zero or more.
    fits : two GravestoneFit
        For stones without and with a dowel.

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
    """Return the PGA beyond which each stone falls as one rigid block under a half-sine pulse ([Housner1963]_).

    It is alpha g X, X the exact factor for a slender block, and at least the g B/H that starts rocking ([Furukawa2009]_ eq. (2)).

    Parameters
    ----------
    cemetery : Cemetery
        Stones that stand loose: a dowelled pile is no such block.
    frequency : float, Hz
        As for :func:`fitted_limits`.
    inset : Inset
        How far the edges are worn; a length or a share of the width, per side.
    width : float, m
        Of stones whose width is not known.
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
        raise ParameterError("the frequency must be zero or positive, in Hz; found {frequency}", frequency=frequency)
    sizes, index = np.unique(np.column_stack([cemetery.ratios, cemetery.widths(width)]), axis=0, return_inverse=True)
    return np.array([_rigid_limit(Block(b, b * ratio).with_wear(inset), frequency, gravity) for ratio, b in sizes.tolist()])[index.ravel()]


def _rigid_limit(stone: Block, frequency: float, gravity: float) -> float:
    """Return the amplitude of the half sine that overturns one stone, m/s^2."""
    w = 2.0 * np.pi * frequency / stone.frequency_parameter(gravity)
    factor = half_sine_ratio(w) if w > 0.0 else 1.0
    return max(stone.rocking_threshold(gravity), gravity * stone.slenderness * factor)


def require_undowelled(cemetery: Cemetery) -> None:
    """Refuse reinforced stones where each is judged as one rigid block: eq. (10) of [Furukawa2009]_ is not that of such a block."""
    if cemetery.reinforced.any():
        raise ParameterError(
            "{source}: a rigid block knows no dowel, but some stones are reinforced; judge them with the criterion furukawa",
            source=cemetery.source or cemetery.name,
        )
