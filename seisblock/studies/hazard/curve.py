"""Site hazard curve: annual exceedance frequency of an intensity, a power law between tabulated levels."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import HazardError
from seisblock.core.typing import ArrayLike, FloatArray


@dataclass(frozen=True, eq=False, repr=False)
class HazardCurve(DisplayMixin):
    """Annual exceedance frequency of an intensity.

    Between two levels the frequency is a power of the intensity, a straight line on two logarithmic axes; beyond the first and the last
    level it is extrapolated with the end slopes ([Cornell2002]_ relation of hazard and intensity, piece by piece).

    Parameters
    ----------
    levels : (n,) array
        Positive, increasing intensities, in units of SI.
    rates : (n,) array, 1/year
        Positive, non-increasing.
    name : str
        Of the branch of a logic tree; empty for a single curve.
    weight : float, 1
        Of the branch.

    Raises
    ------
    HazardError
        If there are fewer than two levels, a number is not positive, levels do not rise, or frequencies do.

    Examples
    --------
    >>> HazardCurve([0.1, 1.0], [1e-2, 1e-4]).rate([0.1, 0.5]).round(8).tolist()
    [0.01, 0.0004]
    """

    levels: ArrayLike
    rates: ArrayLike
    name: str = ""
    weight: float = 1.0

    def __post_init__(self) -> None:
        x = checks.float_array("the intensities of a hazard curve", self.levels)
        rate = checks.float_array("the frequencies of a hazard curve", self.rates)
        if x.ndim != 1 or x.size < 2 or rate.shape != x.shape:
            raise HazardError(
                "a hazard curve needs at least two levels, each with a frequency; found {levels} levels and {rates} frequencies",
                levels=x.size,
                rates=rate.size,
            )
        for row in (x, rate):
            if not (np.isfinite(row).all() and (row > 0.0).all()):
                raise HazardError("the levels and frequencies of a hazard curve must be positive numbers")
        level_drops, rate_rises = np.flatnonzero(np.diff(x) <= 0.0), np.flatnonzero(np.diff(rate) > 0.0)
        if level_drops.size:
            raise HazardError(
                "the levels of a hazard curve must increase: {level:.4g} is duplicated or out of order", level=x[level_drops[0] + 1]
            )
        if rate_rises.size:
            raise HazardError(
                "the frequencies of a hazard curve must not increase with intensity: this one rises from {low:.4g} to {high:.4g}",
                low=x[rate_rises[0]],
                high=x[rate_rises[0] + 1],
            )
        if rate[-1] == rate[-2]:
            raise HazardError("the hazard curve does not decrease at its end; add a higher level or remove the last ones")
        object.__setattr__(self, "levels", x)
        object.__setattr__(self, "rates", rate)
        checks.positive("the weight of a branch", self.weight)

    @property
    def slopes(self) -> FloatArray:
        """Exponents k of rate ~ level^-k, (n + 1,): below the first level, between levels, beyond the last."""
        inner = -np.diff(np.log(self.rates)) / np.diff(np.log(self.levels))
        return np.concatenate([inner[:1], inner, inner[-1:]])

    def rate(self, intensity: ArrayLike) -> FloatArray:
        """Return the annual exceedance frequency, 1/year, of positive intensities, in their shape."""
        u = np.log(checks.float_array("the intensities", intensity))
        logs = np.log(self.levels)
        piece = np.searchsorted(logs, u)
        anchor = np.maximum(piece - 1, 0)
        return np.asarray(np.asarray(self.rates)[anchor] * np.exp(-self.slopes[piece] * (u - logs[anchor])))

    def with_levels(self, levels: FloatArray) -> HazardCurve:
        """Return the same curve with additional levels."""
        union = np.union1d(np.asarray(self.levels), levels)
        is_original = np.isin(union, self.levels)
        rates = self.rate(union)
        rates[is_original] = self.rates
        return HazardCurve(union, np.minimum.accumulate(rates), self.name, self.weight)


@dataclass(frozen=True, eq=False, repr=False)
class Hazard(DisplayMixin):
    """Site hazard in one intensity measure: one curve, or the branches of a logic tree.

    Parameters
    ----------
    im, unit : str
        Measure of intensity (``pga``, ``pgv``, ``pgd``, ``sa=0.5``, ``arias``, ``p*pgv``) and the unit of its levels, SI.
    branches : tuple of HazardCurve
        Their weights sum to 1.
    notes : tuple of str
        Notes on omitted levels.
    table_unit : float
        Factor from the unit of the table's levels to SI.

    Raises
    ------
    HazardError
        If there is no branch, or the weights have another sum.
    """

    im: str
    unit: str
    branches: tuple[HazardCurve, ...]
    notes: tuple[str, ...] = ()
    table_unit: float = 1.0

    def __post_init__(self) -> None:
        total = sum(branch.weight for branch in self.branches)
        if not self.branches or abs(total - 1.0) > WEIGHT_SUM_TOLERANCE:
            raise HazardError("the weights of the hazard branches must sum to 1; found {total:.4g}", total=total)

    def rate(self, intensity: ArrayLike) -> FloatArray:
        """Return the mean annual exceedance frequency, 1/year."""
        return np.asarray(sum(branch.weight * branch.rate(intensity) for branch in self.branches))


WEIGHT_SUM_TOLERANCE = 0.001
"""Tolerance of the sum of rounded weights."""
