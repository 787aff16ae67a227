"""Overturning rate of a cemetery: a criterion applied to every stone, with a Clopper-Pearson interval."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from seisblock.bodies.cemetery.cemetery import Cemetery, Stone
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import ArrayLike, BoolArray
from seisblock.core.units import GAL
from seisblock.criteria.gravestones import fit_range_warnings
from seisblock.studies.intervals import CONFIDENCE, clopper_pearson
from seisblock.studies.survey.limits import Limits, fitted_limits

FREQUENCIES = (0.5, 1.0, 1.5, 2.0, 2.5, 3.0)
"""Frequencies of the curves of [Furukawa2009]_ figs. 16, 17, Hz."""

CURVE_PGA = tuple(round(0.5 * i, 1) for i in range(1, 37))
"""Accelerations of the curves, m/s^2: 50 to 1800 gal as in [Furukawa2009]_ figs. 16, 17."""

MAX_ITERATIONS = 200
"""Iterations for a threshold H/B; a rigid block under a short pulse requires about fifty."""

MIN_PLAUSIBLE_PGA = 20.0 * GAL
"""A lower PGA, m/s^2, was probably given in another unit than gal: not even H/B = 40 overturns."""


@dataclass(frozen=True, repr=False)
class OverturningRate(DisplayMixin):
    """Overturning rate of a cemetery.

    Parameters
    ----------
    rate : float, 1
        Fallen over all stones.
    rate_interval : two floats, 1
        Clopper-Pearson interval for a cemetery of which these stones are a random sample: sampling interval only, error of the
        criterion not included.
    fallen, stones : int
    confidence : float, 1
        Level of the interval.
    """

    rate: float
    rate_interval: tuple[float, float]
    fallen: int
    stones: int
    confidence: float = CONFIDENCE


@dataclass(frozen=True)
class CurvePoint:
    """Point of a rate curve; the fields are the keys of the JSON document."""

    pga_m_s2: float
    frequency_hz: float
    rate: float


def overturning_rate(
    cemetery: Cemetery, pga: float, frequency: float, *, limits: Limits = fitted_limits, confidence: float = CONFIDENCE
) -> OverturningRate:
    """Return the share of stones that overturn, by default those with an H/B above (9) or (10) ([Furukawa2009]_ section 4(2)).

    Parameters
    ----------
    cemetery : Cemetery
        :meth:`Cemetery.with_dowels` gives the one whose stones are all reinforced.
    pga : float, m/s^2
        Peak ground acceleration, positive.
    frequency : float, Hz
        Frequency of a sine, or equivalent frequency of a record.
    limits : callable
        The criterion, see :mod:`seisblock.studies.survey.limits`.
    confidence : float, 1
        Level of the interval, between 0 and 1.

    Returns
    -------
    OverturningRate

    Raises
    ------
    ParameterError
        If the PGA is not positive, the frequency negative, or the level outside (0, 1).

    References
    ----------
    [Furukawa2009]_

    Examples
    --------
    >>> from seisblock.survey import overturning_rate
    >>> from seisblock.bodies.cemetery.table import read_cemetery
    >>> overturning_rate(read_cemetery("aoyama.csv"), 7.25, 2.75).fallen
    35
    """
    return rate_from_stones(overturned_stones(cemetery, pga, frequency, limits=limits), confidence)


def overturned_stones(cemetery: Cemetery, pga: float, frequency: float, *, limits: Limits = fitted_limits) -> BoolArray:
    """Return the stones that overturn, (size,): those whose limit is below a PGA (m/s^2) ([Furukawa2009]_ eqs. (9), (10))."""
    checks.instance(cemetery, Cemetery)
    checks.positive("the peak ground acceleration", pga, "m/s^2")
    checks.finite("the frequency", frequency, "Hz")
    checks.function("the criterion", limits)
    falls: BoolArray = pga > limits(cemetery, frequency)
    return falls


def threshold_ratio(pga: float, frequency: float, *, reinforced: bool = False, limits: Limits = fitted_limits) -> float:
    """Return the smallest overturning H/B by a criterion, of an 8-sun stone if size matters ([Furukawa2009]_ eqs. (7)-(10)).

    Parameters
    ----------
    pga, frequency : float, m/s^2 and Hz
    reinforced : bool
        True for a stone with a dowel.
    limits : callable
        The criterion.
    """
    ratio = 1.0
    # fixed point; limits decrease with H/B, by (7) exactly as 1/(H/B), where the first step is the last
    for _ in range(MAX_ITERATIONS):
        previous = ratio
        ratio *= float(limits(Cemetery((Stone(ratio, reinforced=reinforced),)), frequency)[0]) / pga
        if abs(ratio - previous) <= 1e-14 * ratio:
            break
    return ratio


def rate_from_stones(falls: BoolArray, confidence: float = CONFIDENCE) -> OverturningRate:
    """Return the overturning rate and its interval from the fallen stones.

    Parameters
    ----------
    falls : (n,) array of bool
        At least one stone.
    confidence : float, 1
        Level of the interval, between 0 and 1.
    """
    fallen, stones = int(np.count_nonzero(falls)), int(falls.size)
    return OverturningRate(fallen / stones, clopper_pearson(fallen, stones, confidence), fallen, stones, confidence)


def rate_curve(
    cemetery: Cemetery,
    pga: ArrayLike = CURVE_PGA,
    frequencies: Sequence[float] = FREQUENCIES,
    *,
    limits: Limits = fitted_limits,
) -> tuple[CurvePoint, ...]:
    """Return the overturning rate against PGA for each frequency ([Furukawa2009]_ figs. 16, 17).

    Parameters
    ----------
    cemetery : Cemetery
    pga : (n,) array, m/s^2
    frequencies : sequence of float, Hz
    limits : callable
        The criterion.

    Returns
    -------
    tuple of CurvePoint
        Frequency by frequency, PGA in the order of `pga`.

    Examples
    --------
    >>> from seisblock.survey import rate_curve
    >>> from seisblock.bodies.cemetery.table import read_cemetery
    >>> [point.rate for point in rate_curve(read_cemetery("aoyama.csv"), [7.25], [2.75])]
    [0.35]
    """
    checks.instance(cemetery, Cemetery)
    checks.function("the criterion", limits)
    grid = np.atleast_1d(checks.float_array("the peak ground accelerations", pga))
    points = []
    for frequency in np.atleast_1d(checks.float_array("the frequencies", frequencies)).tolist():
        # side="left": a stone falls at a PGA above its limit, not at it
        rates = np.searchsorted(np.sort(limits(cemetery, frequency)), grid, side="left") / cemetery.size
        points += [CurvePoint(float(a), float(frequency), float(rate)) for a, rate in zip(grid, rates, strict=True)]
    return tuple(points)


def stones_saved(cemetery: Cemetery, pga: float, frequency: float, *, most_fragile: int | None = None) -> int:
    """Return the number of stones saved by dowels in all, or in the most slender, stones ([Furukawa2009]_ eqs. (9), (10)).

    Parameters
    ----------
    cemetery : Cemetery
        Stones with a dowel keep it.
    pga, frequency : float, m/s^2 and Hz
        The shaking.
    most_fragile : int or None
        Number of reinforced stones, the most slender first; None for all.
    """
    reinforced_cemetery = cemetery.with_dowels(most_fragile)
    return overturning_rate(cemetery, pga, frequency).fallen - overturning_rate(reinforced_cemetery, pga, frequency).fallen


def rate_warnings(cemetery: Cemetery, pga: float, frequency: float, *, uses_fit: bool = True) -> tuple[str, ...]:
    """Return warnings about a rate at this shaking, a sentence each ([Furukawa2009]_ section 3(3)).

    Parameters
    ----------
    cemetery : Cemetery
    pga, frequency : float, m/s^2 and Hz
    uses_fit : bool
        True if the range of the fit applies.
    """
    if pga < MIN_PLAUSIBLE_PGA:
        return (lazy_gettext("PGA {pga:.3g} gal is too low to overturn any stone: check the unit (gal, not m/s^2)", pga=pga / GAL),)
    return fit_range_warnings(pga, frequency, cemetery.ratios) if uses_fit else ()
