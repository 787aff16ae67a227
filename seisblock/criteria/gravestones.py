"""Overturning of gravestones under a sine, and its inverses: the fits of [Furukawa2009]_ to discrete-element runs.

A gravestone (the upper stone of a Japanese grave, square in plan, 8 sun wide) overturns when its height over width exceeds a(f)/PGA. For a
record, f is its equivalent frequency PGA/(2 pi PGV). Fitted for 0.5 to 3 Hz, H/B 1.25 to 6.5, 100 to 1300 gal.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from seisblock.core import checks
from seisblock.core.errors import ParameterError
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.typing import ArrayLike, BoolArray, FloatArray
from seisblock.core.units import GAL

FITTED_RATIO = (1.25, 6.5)
"""H/B of the stones behind the fit ([Furukawa2009]_ table 1)."""

FITTED_PGA = (1.0, 13.0)
"""Amplitudes of the sines behind the fit, m/s^2 ([Furukawa2009]_ section 3(3)a)."""

FITTED_FREQUENCY = (0.5, 3.0)
"""Frequencies of the sines behind the fit, Hz ([Furukawa2009]_ section 3(3)a)."""

BORDERLINE_TOLERANCE = 0.1
"""A stone whose H/B is within this of the threshold is judged to stand on the line ([Furukawa2009]_ table 5)."""

ROUND_OFF = 1e-9
"""Relative slack at the ends of these ranges: 2.6 - 2.5 is not 0.1 to the last bit."""

DOWELLED_NOTE = lazy_gettext(
    "reinforced stones: (10) as printed, p = 1162.9 gal; two verdicts of the paper's table 5 need 1342 to 1409 gal, so that fewer may fall"
)
"""What to tell a user who relies on (10)."""

Prediction = Literal["stands", "on the line", "overturns"]


@dataclass(frozen=True)
class GravestoneFit:
    """Parameters of a(f) = p sqrt(1 + (f/q)^r) ([Furukawa2009]_ eq. (8)).

    Parameters
    ----------
    p_m_s2 : float, m/s^2
        a(0).
    q_hz : float, Hz
        Frequency at which a has grown by sqrt(2).
    r : float
        Exponent.
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
"""Stones that only stand on each other ([Furukawa2009]_ eq. (9))."""

DOWELLED = GravestoneFit(11.629, 1.84, 4.5, "dowelled")
"""Upper stone and its base joined by a loose dowel; H/B is still that of the upper stone ([Furukawa2009]_ eq. (10)).

The text before (10) gives q = 1.85, at most 1.1 % apart. Differs: the two verdicts of table 5 on the dowelled stone at 6-upper cannot
come from p = 1162.9 gal; they need 1342 to 1409 gal, and 1362.9 (one digit) would do. The printed value stands here."""


def furukawa_fit(reinforced: bool) -> tuple[GravestoneFit, str]:
    """Return the paper's fit, and the number of its equation ([Furukawa2009]_ eqs. (9), (10))."""
    return (DOWELLED, "(10)") if reinforced else (PLAIN, "(9)")


def overturning_level(frequency: ArrayLike, fit: GravestoneFit = PLAIN) -> FloatArray:
    """Return a(f), m/s^2, the PGA times H/B at which a stone overturns ([Furukawa2009]_ eq. (8)).

    Parameters
    ----------
    frequency : array, Hz
        Of the sine, or equivalent; not negative.
    fit : GravestoneFit

    Raises
    ------
    ParameterError
        If a frequency is negative or not a number.

    Examples
    --------
    >>> float(overturning_level(2.0).round(4))
    12.2817
    """
    f = _validate(frequency, N_("frequency"), "Hz", allow_zero=True)
    return fit.p_m_s2 * np.sqrt(1.0 + (f / fit.q_hz) ** fit.r)


def overturning_ratio(pga: ArrayLike, frequency: ArrayLike, fit: GravestoneFit = PLAIN) -> FloatArray:
    """Return the least H/B of a stone that overturns ([Furukawa2009]_ eqs. (7), (9), (10)).

    Parameters
    ----------
    pga : array, m/s^2
        Peak ground acceleration, positive.
    frequency : array, Hz
    fit : GravestoneFit
    """
    return overturning_level(frequency, fit) / _validate(pga, N_("PGA"), "m/s^2")


def overturning_pga(ratio: ArrayLike, frequency: ArrayLike, fit: GravestoneFit = PLAIN) -> FloatArray:
    """Return the least PGA, m/s^2, that overturns a stone of a given H/B: [Furukawa2009]_ eq. (7) solved for PGA."""
    return overturning_level(frequency, fit) / _validate(ratio, N_("height over width"), "1")


def overturning_frequency(pga: ArrayLike, ratio: ArrayLike, fit: GravestoneFit = PLAIN) -> FloatArray:
    """Return the highest frequency, Hz, at which a PGA overturns a stone of a given H/B; NaN where none does.

    [Furukawa2009]_ eqs. (7), (8) solved for f.
    """
    level = _validate(pga, N_("PGA"), "m/s^2") * _validate(ratio, N_("height over width"), "1")
    surplus = (level / fit.p_m_s2) ** 2 - 1.0
    return np.where(surplus >= 0.0, fit.q_hz * np.maximum(surplus, 0.0) ** (1.0 / fit.r), np.nan)


def predict(ratio: float, threshold: float) -> Prediction:
    """Return the verdict on a stone of a given H/B: on the line within 0.1 of the threshold ([Furukawa2009]_ table 5).

    Examples
    --------
    >>> predict(2.6, 2.5), predict(2.6, 2.4), predict(2.6, 2.75)
    ('on the line', 'overturns', 'stands')
    """
    if abs(threshold - ratio) <= BORDERLINE_TOLERANCE * (1.0 + ROUND_OFF):
        return "on the line"
    return "overturns" if ratio > threshold else "stands"


def fit_range_warnings(pga: float, frequency: float, ratios: ArrayLike = ()) -> tuple[str, ...]:
    """Return what lies outside the range of the fit, a sentence each, none when all is inside ([Furukawa2009]_ section 3(3)).

    Parameters
    ----------
    pga : float, m/s^2
    frequency : float, Hz
    ratios : array
        H/B of the stones judged.
    """
    messages = []
    (low, high), stones = FITTED_PGA, np.asarray(ratios, dtype=np.float64)
    if _is_outside(pga, FITTED_PGA).any():
        text = "a PGA of {pga:.4g} gal lies outside the range of the fit, {low:g} to {high:g} gal"
        messages.append(lazy_gettext(text, pga=pga / GAL, low=low / GAL, high=high / GAL))
    if _is_outside(frequency, FITTED_FREQUENCY).any():
        min_frequency, max_frequency = FITTED_FREQUENCY
        messages.append(
            lazy_gettext(
                "a frequency of {f:.3g} Hz lies outside the range of the fit, {slow:g} to {fast:g} Hz",
                f=frequency,
                slow=min_frequency,
                fast=max_frequency,
            )
        )
    if count := int(np.count_nonzero(_is_outside(stones, FITTED_RATIO))):
        min_ratio, max_ratio = FITTED_RATIO
        text = "{count} of {stones} stones have H/B outside the range of the fit, {least:g} to {most:g}"
        messages.append(lazy_gettext(text, count=count, stones=stones.size, least=min_ratio, most=max_ratio))
    return tuple(messages)


def _is_outside(values: ArrayLike, interval: tuple[float, float]) -> BoolArray:
    """Return which values lie outside a range, round-off at its ends forgiven."""
    array = np.asarray(values, dtype=np.float64)
    mask: BoolArray = (array < interval[0] * (1.0 - ROUND_OFF)) | (array > interval[1] * (1.0 + ROUND_OFF))
    return mask


def _validate(values: ArrayLike, quantity: str, unit: str, *, allow_zero: bool = False) -> FloatArray:
    """Return an array of positive numbers, or of numbers that are not negative."""
    array = np.asarray(values, dtype=np.float64)
    valid = (array >= 0.0 if allow_zero else array > 0.0) & np.isfinite(array)
    if not valid.all():
        raise ParameterError(
            "{what} must be zero or positive, in {unit}; found {found}"
            if allow_zero
            else "{what} must be positive, in {unit}; found {found}",
            what=lazy_gettext(quantity),
            unit=unit,
            found=array[~valid].flat[0],
        )
    if array.size:
        checks.finite(quantity, float(array.max()), unit)
    return array
