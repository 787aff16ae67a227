"""Rocking and overturning spectra: one record, and rectangular blocks of all sizes and slendernesses."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Unpack

import numpy as np

from seisblock import checks
from seisblock.bodies.blocks import rectangles
from seisblock.bodies.inset import SHARP, Inset
from seisblock.errors import ParameterError
from seisblock.limits import check_budget
from seisblock.records import Motion
from seisblock.showing import Drawn
from seisblock.solvers.rock.rocker import RockOptions, rockers
from seisblock.studies.rocking.verdicts import all_verdicts
from seisblock.typing import ArrayLike, BoolArray, FloatArray, Progress
from seisblock.units import STANDARD_GRAVITY
from seisblock.words import noted, said


@dataclass(frozen=True, eq=False)
class RockingSpectrum(Drawn):
    """The largest lean over a grid of rectangular blocks.

    Parameters
    ----------
    size_m : (n,) array, m
        2R, the diagonal of the block.
    frequency_parameter_rad_s : (n,) array, rad/s
        p = sqrt(3 g/(4 R)) of the same blocks.
    slenderness_rad : (m,) array, rad
        alpha = atan(B/H).
    max_rotation_ratio : (n, m) array
        Largest lean over alpha; pi/2 over alpha where the block overturns.
    overturned : (n, m) array of bool
    """

    size_m: FloatArray
    frequency_parameter_rad_s: FloatArray
    slenderness_rad: FloatArray
    max_rotation_ratio: FloatArray
    overturned: BoolArray


def rocking_spectrum(
    sizes: ArrayLike,
    slendernesses: ArrayLike,
    motion: Motion,
    *,
    inset: Inset = SHARP,
    progress: Progress | None = None,
    **options: Unpack[RockOptions],
) -> RockingSpectrum:
    """Return the rocking spectrum of a motion: peak lean over alpha against 2R and alpha ([Housner1963]_, [Zhang2001]_).

    Parameters
    ----------
    sizes : (n,) array, m
        2R, positive.
    slendernesses : (m,) array, rad
        alpha, between 0 and pi/2; of the block as drawn, as 2R is.
    motion : Motion
    inset : Inset
        How far the edges are worn, per side; leans are then told over the alpha that is left.
    progress : callable
        Told the number of runs done and the number in all.
    options
        ``restitution``, ``linear``, ``vertical``, ``gravity`` of :func:`~seisblock.solvers.rock.solve.solve_rock`.

    Raises
    ------
    ParameterError
        If a size, a slenderness or an option is out of range, or there is none.

    Examples
    --------
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> rocking_spectrum([1.0, 2.0], [0.3], pulse).max_rotation_ratio.round(2).tolist()
    [[5.24], [0.43]]
    """
    diagonal = _grid(sizes, noted("size 2R"), "m", math.inf)
    alpha = _grid(slendernesses, noted("slenderness"), "rad", math.pi / 2)
    check_budget(noted("cells"), diagonal.size * alpha.size, "SEISBLOCK_CELLS")
    blocks = rectangles(np.outer(diagonal, np.sin(alpha)).ravel(), np.outer(diagonal, np.cos(alpha)).ravel(), inset)
    some = rockers(blocks, motion, **options)
    found = all_verdicts(some, motion, some.gains(), progress=progress)
    shape = diagonal.size, alpha.size
    p = np.sqrt(1.5 * some.gravity / diagonal)
    return RockingSpectrum(diagonal, p, alpha, found.max_rotation_ratio.reshape(shape), found.overturned.reshape(shape))


def size_of(frequency_parameter: ArrayLike, gravity: float = STANDARD_GRAVITY) -> FloatArray:
    """Return 2R, m, of rectangular blocks with these p, rad/s: 3 g/(2 p^2) (from [Furukawa2009]_ eq. (6))."""
    return 1.5 * gravity / _grid(frequency_parameter, noted("frequency parameter"), "rad/s", math.inf) ** 2


def slenderness_of(height_over_width: ArrayLike) -> FloatArray:
    """Return alpha = atan(B/H), rad, of blocks with these H/B ([Furukawa2009]_ section 2)."""
    return np.arctan(1.0 / _grid(height_over_width, noted("height over width"), "1", math.inf))


def default_sizes(steps: int) -> FloatArray:
    """Return 2R from 0.2 to 8 m, evenly in their logarithm: from a vase to a shrine's pavilion."""
    return np.geomspace(0.2, 8.0, steps)


def default_slendernesses(steps: int) -> FloatArray:
    """Return alpha of H/B from 10 to 1.5, evenly in alpha, rad."""
    return np.linspace(math.atan(1 / 10), math.atan(1 / 1.5), steps)


def _grid(values: ArrayLike, what: str, unit: str, limit: float) -> FloatArray:
    """Return a grid of positive numbers below a limit, or refuse it."""
    array = np.atleast_1d(checks.numbers("sizes and slendernesses", values))
    good = np.isfinite(array) & (array > 0.0) & (array < limit)
    if array.size == 0 or not good.all():
        found = said("none") if array.size == 0 else str(array[~good][0])
        text = "each {what} must be positive, in {unit}; found {found}"
        bounded = "each {what} must be positive and below {limit:.4g}, in {unit}; found {found}"
        raise ParameterError(text if limit == math.inf else bounded, what=said(what), limit=limit, unit=unit, found=found)
    for end in (array.min(), array.max()):
        checks.positive(said(what), float(end), unit)
    return array
