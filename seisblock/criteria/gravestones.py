"""Gravestone overturning criterion of [Furukawa2009]_, fitted to discrete-element analyses, and its inverse forms.

A gravestone (the upper stone, sao, of a Japanese grave, square in plan, 8 sun wide) overturns if its height-to-width ratio exceeds
a(f)/PGA. For a record, f is the equivalent frequency PGA/(2 pi PGV). Fitted for 0.5 to 3 Hz, H/B 1.25 to 6.5, 100 to 1300 gal.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.typing import ArrayLike, BoolArray, FloatArray
from seisblock.core.units import GAL

FITTED_RATIO = (1.25, 6.5)
"""Range of H/B of the fit ([Furukawa2009]_ table 1)."""

FITTED_PGA = (1.0, 13.0)
"""Range of the sine amplitudes of the fit, m/s^2 ([Furukawa2009]_ section 3(3)a)."""

FITTED_FREQUENCY = (0.5, 3.0)
"""Range of the sine frequencies of the fit, Hz ([Furukawa2009]_ section 3(3)a)."""

BORDERLINE_TOLERANCE = 0.1
"""Maximum difference of H/B and threshold at which a stone counts as on the line ([Furukawa2009]_ table 5)."""

ROUND_OFF = 1e-9
"""Relative tolerance at the ends of these ranges, because 2.6 - 2.5 differs from 0.1 by round-off."""

DOWELLED_NOTE = lazy_gettext(
    "reinforced stones: eq. (10) as printed (p = 1162.9 gal); two results in table 5 of the paper require 1342 to 1409 gal, "
    "so the overturning rate may be overestimated"
)
"""Warning attached to results of eq. (10)."""

Prediction = Literal["stands", "on the line", "overturns"]


@dataclass(frozen=True, repr=False)
class GravestoneFit(DisplayMixin):
    """Parameters p, q, r of a(f) = p sqrt(1 + (f/q)^r) ([Furukawa2009]_ eq. (8)).

    Parameters
    ----------
    p_m_s2 : float, m/s^2
        a(0).
    q_hz : float, Hz
        Frequency at which a(f) is sqrt(2) a(0).
    r : float
        Exponent, a ratio of logarithms.
    name : str

    Raises
    ------
    ParameterError
        If a parameter is not positive.
    """

    p_m_s2: float
    q_hz: float
    r: float
    name: str = "as given"

    def __post_init__(self) -> None:
        for key in ("p_m_s2", "q_hz", "r"):
            checks.positive("{key} of the gravestone criterion", getattr(self, key), key=key)


PLAIN = GravestoneFit(8.268, 1.92, 4.6, "plain")
"""Stones without dowels ([Furukawa2009]_ eq. (9))."""

DOWELLED = GravestoneFit(11.629, 1.84, 4.5, "dowelled")
"""Upper stone joined to its base by a loose dowel; H/B is that of the upper stone ([Furukawa2009]_ eq. (10)).

The text before (10) gives q = 1.85, a difference of at most 1.1 %. Differs: the two results of table 5 for the dowelled stone at 6-upper
cannot follow from p = 1162.9 gal; they require 1342 to 1409 gal, for example 1362.9 (one digit). The printed value is used here."""


def furukawa_fit(reinforced: bool) -> tuple[GravestoneFit, str]:
    """Return the fit and the number of its equation ([Furukawa2009]_ eqs. (9), (10))."""
    return (DOWELLED, "(10)") if reinforced else (PLAIN, "(9)")


def overturning_level(frequency: ArrayLike, fit: GravestoneFit = PLAIN) -> FloatArray:
    """Return a(f), m/s^2, the PGA times H/B at which a stone overturns ([Furukawa2009]_ eq. (8)).

    Parameters
    ----------
    frequency : array, Hz
        Frequency of the sine, or equivalent frequency, zero or more.
    fit : GravestoneFit

    Returns
    -------
    array, m/s^2
        In the shape of the frequencies.

    Raises
    ------
    ParameterError
        If a frequency is negative or NaN.

    Examples
    --------
    >>> from seisblock.criteria import overturning_level
    >>> float(overturning_level(2.0).round(4))
    12.2817
    """
    f = _validate(frequency, N_("frequency"), "Hz", allow_zero=True)
    return fit.p_m_s2 * np.sqrt(1.0 + (f / fit.q_hz) ** fit.r)


def overturning_ratio(pga: ArrayLike, frequency: ArrayLike, fit: GravestoneFit = PLAIN) -> FloatArray:
    """Return the minimum H/B of a stone that overturns ([Furukawa2009]_ eqs. (7), (9), (10)).

    Parameters
    ----------
    pga : array, m/s^2
        Peak ground acceleration, positive.
    frequency : array, Hz
    fit : GravestoneFit

    Returns
    -------
    array, 1
        In the broadcast shape of the arguments.

    Examples
    --------
    >>> from seisblock.criteria import overturning_ratio
    >>> round(float(overturning_ratio(4.0, 1.0)), 2)
    2.12
    """
    return overturning_level(frequency, fit) / _validate(pga, N_("PGA"), "m/s^2")


def overturning_pga(ratio: ArrayLike, frequency: ArrayLike, fit: GravestoneFit = PLAIN) -> FloatArray:
    """Return the minimum PGA, m/s^2, that overturns a stone with a given H/B: [Furukawa2009]_ eq. (7) solved for PGA.

    Parameters
    ----------
    ratio : array
        H/B of the stones, positive.
    frequency : array, Hz
    fit : GravestoneFit

    Returns
    -------
    array, m/s^2
        In the broadcast shape of the arguments.

    Examples
    --------
    >>> from seisblock.criteria import overturning_pga
    >>> round(float(overturning_pga(3.0, 1.0)), 2)
    2.82
    """
    return overturning_level(frequency, fit) / _validate(ratio, N_("height over width"), "1")


def overturning_frequency(pga: ArrayLike, ratio: ArrayLike, fit: GravestoneFit = PLAIN) -> FloatArray:
    """Return the maximum frequency, Hz, at which a PGA overturns a stone with a given H/B; NaN if there is none.

    [Furukawa2009]_ eqs. (7), (8) solved for f.

    Parameters
    ----------
    pga : array, m/s^2
        Peak ground acceleration, positive.
    ratio : array
        H/B of the stones.
    fit : GravestoneFit

    Returns
    -------
    array, Hz
        In the broadcast shape of the arguments.

    Examples
    --------
    >>> from seisblock.criteria import overturning_frequency
    >>> round(float(overturning_frequency(4.0, 3.0)), 2)
    1.96
    """
    level = _validate(pga, N_("PGA"), "m/s^2") * _validate(ratio, N_("height over width"), "1")
    # negative surplus: PGA below p/(H/B), too low at any frequency
    surplus = (level / fit.p_m_s2) ** 2 - 1.0
    return np.where(surplus >= 0.0, fit.q_hz * np.maximum(surplus, 0.0) ** (1.0 / fit.r), np.nan)


def predict(ratio: float, threshold: float) -> Prediction:
    """Return the prediction for a stone; on the line within 0.1 of the threshold ([Furukawa2009]_ table 5).

    Parameters
    ----------
    ratio : float
        H/B of the stone.
    threshold : float
        Minimum H/B of a stone that overturns.

    Returns
    -------
    Prediction

    Examples
    --------
    >>> from seisblock.criteria import predict
    >>> predict(2.6, 2.5), predict(2.6, 2.4), predict(2.6, 2.75)
    ('on the line', 'overturns', 'stands')
    """
    if abs(threshold - ratio) <= BORDERLINE_TOLERANCE * (1.0 + ROUND_OFF):
        return "on the line"
    return "overturns" if ratio > threshold else "stands"


def fit_range_warnings(pga: float, frequency: float, ratios: ArrayLike = ()) -> tuple[str, ...]:
    """Return a warning for each quantity outside the range of the fit ([Furukawa2009]_ section 3(3)).

    Parameters
    ----------
    pga : float, m/s^2
    frequency : float, Hz
    ratios : array
        H/B of the stones.

    Returns
    -------
    tuple of str
        Empty inside the range.

    Examples
    --------
    >>> from seisblock.criteria import fit_range_warnings
    >>> fit_range_warnings(3.0, 2.0, [2.5])
    ()
    >>> len(fit_range_warnings(3.0, 9.0, [2.5]))
    1
    """
    messages = []
    (low, high), stones = FITTED_PGA, np.asarray(ratios, dtype=np.float64)
    if _is_outside(pga, FITTED_PGA).any():
        text = "PGA {pga:.4g} gal is outside the range of the fit ({low:g} to {high:g} gal)"
        messages.append(lazy_gettext(text, pga=pga / GAL, low=low / GAL, high=high / GAL))
    if _is_outside(frequency, FITTED_FREQUENCY).any():
        min_frequency, max_frequency = FITTED_FREQUENCY
        messages.append(
            lazy_gettext(
                "frequency {f:.3g} Hz is outside the range of the fit ({slow:g} to {fast:g} Hz)",
                f=frequency,
                slow=min_frequency,
                fast=max_frequency,
            )
        )
    if count := int(np.count_nonzero(_is_outside(stones, FITTED_RATIO))):
        min_ratio, max_ratio = FITTED_RATIO
        text = "H/B of {count} of {stones} stones is outside the range of the fit ({least:g} to {most:g})"
        messages.append(lazy_gettext(text, count=count, stones=stones.size, least=min_ratio, most=max_ratio))
    return tuple(messages)


def _is_outside(values: ArrayLike, interval: tuple[float, float]) -> BoolArray:
    """Return a mask of values outside a range, with the tolerance ``ROUND_OFF`` at its ends."""
    array = np.asarray(values, dtype=np.float64)
    mask: BoolArray = (array < interval[0] * (1.0 - ROUND_OFF)) | (array > interval[1] * (1.0 + ROUND_OFF))
    return mask


def _validate(values: ArrayLike, quantity: str, unit: str, *, allow_zero: bool = False) -> FloatArray:
    """Return an array of positive (or non-negative) numbers."""
    array = np.asarray(values, dtype=np.float64)
    valid = (array >= 0.0 if allow_zero else array > 0.0) & np.isfinite(array)
    if not valid.all():
        raise ParameterError(
            "{what} must be zero or more (in {unit}), found {found}"
            if allow_zero
            else "{what} must be positive (in {unit}), found {found}",
            what=lazy_gettext(quantity),
            unit=unit,
            found=array[~valid].flat[0],
        )
    if array.size:
        checks.finite(quantity, float(array.max()), unit)
    return array
