"""Rocking and overturning spectra: one record, rectangular blocks over size and slenderness."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import BlockArray, rectangular_blocks
from seisblock.bodies.edge_wear import SHARP_EDGES, EdgeWear
from seisblock.core import checks
from seisblock.core._display import PlotMixin
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.limits import MAX_CELLS, check_limit
from seisblock.core.typing import ArrayLike, BoolArray, FloatArray, Progress
from seisblock.core.units import STANDARD_GRAVITY
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.params import rock_batch_params
from seisblock.records import Motion, Record
from seisblock.studies.azimuths import make_azimuth_sweep
from seisblock.studies.rocking.verdicts import parallel_verdicts

STEP_DEG = 10.0
"""Default step between the directions of a spectrum, degrees: each direction costs a whole spectrum."""

AFTER_RECORD_S = 1e9
"""Time assigned to an overturning after the record, s."""


@dataclass(frozen=True, eq=False, repr=False)
class RockingSpectrum(PlotMixin):
    """Peak tilt over a grid of rectangular blocks.

    Parameters
    ----------
    size_m : (n,) array, m
        2R, the diagonal of the block.
    frequency_parameter_rad_s : (n,) array, rad/s
        p = sqrt(3 g/(4 R)) of the same blocks.
    slenderness_rad : (m,) array, rad
        alpha = atan(B/H).
    max_rotation_ratio : (n, m) array
        Peak tilt over alpha; pi/2 over alpha for a block that overturns.
    overturned : (n, m) array of bool
    azimuths_deg : (k,) array, degrees, or None
        Directions of an all-azimuth spectrum, clockwise from north: the peak tilt is then that of the worst direction, and a block
        has overturned if it does in any direction.
    overturning_rate : (n, m) array or None
        Share of those directions in which a block overturns.
    worst_azimuth_deg : (n, m) array, degrees, or None
        Direction of the earliest overturning, or else of the peak tilt.
    """

    size_m: FloatArray
    frequency_parameter_rad_s: FloatArray
    slenderness_rad: FloatArray
    max_rotation_ratio: FloatArray
    overturned: BoolArray
    azimuths_deg: FloatArray | None = None
    overturning_rate: FloatArray | None = None
    worst_azimuth_deg: FloatArray | None = None


def rocking_spectrum(
    sizes: ArrayLike,
    slendernesses: ArrayLike,
    motion: Motion,
    *,
    inset: EdgeWear = SHARP_EDGES,
    progress: Progress | None = None,
    options: RockOptions = RockOptions(),
) -> RockingSpectrum:
    """Return the rocking spectrum of a motion: peak tilt over alpha against 2R and alpha ([Housner1963]_, [Zhang2001]_).

    Parameters
    ----------
    sizes : (n,) array, m
        2R, positive.
    slendernesses : (m,) array, rad
        alpha, between 0 and pi/2; of the block with sharp edges, like 2R.
    motion : Motion
    inset : EdgeWear
        Edge wear, per side; tilts are then relative to the alpha of the worn block.
    progress : callable
        Called with the number of finished runs and the total.
    options : RockOptions

    Returns
    -------
    RockingSpectrum

    Raises
    ------
    ParameterError
        If a size, a slenderness or an option is out of range, or there is none.

    Examples
    --------
    >>> from seisblock.studies import rocking_spectrum
    >>> import numpy as np
    >>> pulse = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, np.pi, 101)), 0.01)
    >>> rocking_spectrum([1.0, 2.0], [0.3], pulse).max_rotation_ratio.round(2).tolist()
    [[5.24], [0.43]]
    """
    diagonal, alpha, blocks = _blocks(sizes, slendernesses, inset)
    params = rock_batch_params(blocks, motion, options)
    verdicts = parallel_verdicts(params, motion, params.gains(), progress=progress)
    shape = diagonal.size, alpha.size
    p = np.sqrt(1.5 * params.gravity / diagonal)
    return RockingSpectrum(diagonal, p, alpha, verdicts.max_rotation_ratio.reshape(shape), verdicts.overturned.reshape(shape))


def rocking_spectrum_all_azimuths(
    sizes: ArrayLike,
    slendernesses: ArrayLike,
    record: Record,
    *,
    step_deg: float = STEP_DEG,
    inset: EdgeWear = SHARP_EDGES,
    progress: Progress | None = None,
    options: RockOptions = RockOptions(),
) -> RockingSpectrum:
    """Return the rocking spectrum of a record in the worst direction, and the share of directions in which each block overturns.

    Parameters
    ----------
    sizes, slendernesses : (n,), (m,) arrays, m and rad
        As in :func:`rocking_spectrum`.
    record : Record
        With two horizontal components of known azimuths.
    step_deg : float
        Step between directions, degrees, over half a circle: the blocks are symmetric.
    inset, progress, options
        As in :func:`rocking_spectrum`.

    Returns
    -------
    RockingSpectrum

    Raises
    ------
    ParameterError
        If a size, a slenderness, the step or an option is out of range, or there is none.
    ComponentError
        If the record has no two horizontals of known azimuths.

    Examples
    --------
    >>> from seisblock.studies import rocking_spectrum_all_azimuths
    >>> from seisblock import read
    >>> result = rocking_spectrum_all_azimuths([0.5, 4.0], [0.2], read("synthetic_jma.csv"), step_deg=30.0)
    >>> result.overturned.tolist(), result.overturning_rate.round(2).tolist()
    ([[True], [True]], [[1.0], [0.83]])
    """
    diagonal, alpha, blocks = _blocks(sizes, slendernesses, inset)
    azimuth_sweep = make_azimuth_sweep(Block(1.0, 1.0), record, step_deg=step_deg, vertical=options.vertical)
    count, directions = len(blocks), azimuth_sweep.azimuths.size
    check_limit(N_("cells"), count * directions, MAX_CELLS)
    params = rock_batch_params(blocks, azimuth_sweep.motion, options)
    ratio, worst, falls = np.full(count, -1.0), np.zeros(count), np.zeros(count, dtype=np.int64)
    first = np.full(count, np.inf)
    for row, azimuth in enumerate(azimuth_sweep.azimuths.tolist()):
        advance = None if progress is None else _offset_progress(progress, row * count, directions * count)
        verdicts = parallel_verdicts(params, azimuth_sweep.motion, azimuth_sweep.gains[row], progress=advance)
        # order: overturning during the record, overturning after it, then peak tilt without overturning
        time = np.where(verdicts.overturned, np.nan_to_num(verdicts.overturning_time_s, nan=AFTER_RECORD_S), np.inf)
        # ties in time: no overturning so far, or both after the record; the peak tilt decides
        worse = (time < first) | ((time == first) & (verdicts.max_rotation_ratio > ratio))
        ratio, worst, first = (
            np.where(worse, new, old) for new, old in ((verdicts.max_rotation_ratio, ratio), (azimuth, worst), (time, first))
        )
        falls += verdicts.overturned
    shape = diagonal.size, alpha.size
    return RockingSpectrum(
        diagonal,
        np.sqrt(1.5 * params.gravity / diagonal),
        alpha,
        ratio.reshape(shape),
        (falls > 0).reshape(shape),
        azimuth_sweep.azimuths,
        (falls / directions).reshape(shape),
        worst.reshape(shape),
    )


def _offset_progress(progress: Progress, offset: int, total: int) -> Progress:
    """Return a progress callback that counts one part of a study in its total."""
    return lambda part, _: progress(offset + part, total)


def _blocks(sizes: ArrayLike, slendernesses: ArrayLike, inset: EdgeWear) -> tuple[FloatArray, FloatArray, BlockArray]:
    diagonal = _check_grid(sizes, N_("size 2R"), "m", math.inf)
    alpha = _check_grid(slendernesses, N_("slenderness"), "rad", math.pi / 2)
    check_limit(N_("cells"), diagonal.size * alpha.size, MAX_CELLS)
    return diagonal, alpha, rectangular_blocks(np.outer(diagonal, np.sin(alpha)).ravel(), np.outer(diagonal, np.cos(alpha)).ravel(), inset)


def size_of(frequency_parameter: ArrayLike, gravity: float = STANDARD_GRAVITY) -> FloatArray:
    """Return 2R, m, of rectangular blocks of frequency parameter p, rad/s: 3 g/(2 p^2) (from [Furukawa2009]_ eq. (6))."""
    return 1.5 * gravity / _check_grid(frequency_parameter, N_("frequency parameter"), "rad/s", math.inf) ** 2


def slenderness_of(height_over_width: ArrayLike) -> FloatArray:
    """Return alpha = atan(B/H), rad, of blocks of ratio H/B ([Furukawa2009]_ section 2)."""
    return np.arctan(1.0 / _check_grid(height_over_width, N_("height over width"), "1", math.inf))


def default_sizes(steps: int) -> FloatArray:
    """Return 2R from 0.2 to 8 m, logarithmically spaced: from a vase to a shrine pavilion.

    Examples
    --------
    >>> default_sizes(3).round(3).tolist()
    [0.2, 1.265, 8.0]
    """
    return np.geomspace(0.2, 8.0, steps)


def default_slendernesses(steps: int) -> FloatArray:
    """Return alpha of H/B from 10 to 1.5, evenly spaced in alpha, rad.

    Examples
    --------
    >>> (1.0 / np.tan(default_slendernesses(3))).round(3).tolist()
    [10.0, 2.793, 1.5]
    """
    return np.linspace(math.atan(1 / 10), math.atan(1 / 1.5), steps)


def _check_grid(values: ArrayLike, label: str, unit: str, limit: float) -> FloatArray:
    """Return a grid of positive numbers below a limit; raise ParameterError for any other."""
    array = np.atleast_1d(checks.float_array("sizes and slendernesses", values))
    good = np.isfinite(array) & (array > 0.0) & (array < limit)
    if array.size == 0 or not good.all():
        value_text = lazy_gettext("none") if array.size == 0 else str(array[~good][0])
        text = N_("every {what} must be positive, in {unit}; found {found}")
        bounded = N_("every {what} must be positive and below {limit:.4g}, in {unit}; found {found}")
        raise ParameterError(text if limit == math.inf else bounded, what=lazy_gettext(label), limit=limit, unit=unit, found=value_text)
    for end in (array.min(), array.max()):
        checks.positive(lazy_gettext(label), float(end), unit)
    return array
