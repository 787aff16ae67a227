"""When a gravestone overturns: the criterion fitted to distinct-element analyses of whole stones ([Furukawa2009]_).

The least ratio H/B of the top stone (sao) that overturns is a(f)/PGA, with a(f) = p sqrt(1 + (f/q)^r). It was fitted to sines of
100 to 1300 gal and 0.5 to 3 Hz and to stones of H/B 1.25 to 6.5 and 8 sun wide; a record enters through its PGA and its equivalent
frequency PGA/(2 pi PGV).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from seisblock.errors import ParameterError
from seisblock.typing import ArrayLike, FloatArray
from seisblock.units import GAL

ON_THE_LINE = 0.1
"""A stone whose H/B is within this of the threshold is judged to stand on the line ([Furukawa2009]_ table 5)."""

FITTED_RATIO = (1.25, 6.5)
"""H/B of the stones behind the fit ([Furukawa2009]_ table 1)."""

FITTED_PGA = (1.0, 13.0)
"""Amplitudes of the sines behind the fit, m/s^2 ([Furukawa2009]_ section 3(3)a)."""

FITTED_FREQUENCY = (0.5, 3.0)
"""Frequencies of the sines behind the fit, Hz ([Furukawa2009]_ section 3(3)a)."""

Judgement = Literal["stands", "on the line", "overturns"]


def _require_positive(value: float, what: str, unit: str) -> None:
    """Refuse what is not a positive finite number."""
    if not (math.isfinite(value) and value > 0.0):
        raise ParameterError(f"{what} must be positive, found {value}{unit}")


@dataclass(frozen=True)
class GravestoneCriterion:
    """The parameters of a(f) = p sqrt(1 + (f/q)^r) ([Furukawa2009]_ eq. (8)).

    Parameters
    ----------
    p : float, m/s^2
        a(f) at zero frequency.
    q : float, Hz
        Frequency beyond which a(f) climbs.
    r : float
        Exponent.
    name : str

    Raises
    ------
    ParameterError
        If a parameter is not positive.
    """

    p: float
    q: float
    r: float
    name: str = ""

    def __post_init__(self) -> None:
        for key, unit in (("p", " m/s^2"), ("q", " Hz"), ("r", "")):
            _require_positive(getattr(self, key), f"{key} of the criterion", unit)


UNREINFORCED = GravestoneCriterion(8.268, 1.92, 4.6, "unreinforced")
"""[Furukawa2009]_ eq. (9), 826.8 gal."""

REINFORCED = GravestoneCriterion(11.629, 1.84, 4.5, "reinforced")
"""[Furukawa2009]_ eq. (10), 1162.9 gal; sao and jodai joined by a loose dowel; H/B is still that of the sao.

The text before (10) says q = 1.85, at most 1.1 % away. Differs: two verdicts of table 5, those of the reinforced stone at 6-upper,
cannot come from p = 1162.9 gal; they need 1342 to 1409 gal, and 1362.9 would do (one digit). The printed value stands here."""


def threshold_ratio(pga: ArrayLike, frequency: ArrayLike, criterion: GravestoneCriterion = UNREINFORCED) -> FloatArray:
    """Return the least height over width of a stone that overturns ([Furukawa2009]_ eqs. (7)-(10)).

    Parameters
    ----------
    pga : array, m/s^2
        Peak ground acceleration, positive.
    frequency : array, Hz
        Frequency of the sine, or equivalent frequency of the record; zero or more.
    criterion : GravestoneCriterion
        ``UNREINFORCED`` (9), ``REINFORCED`` (10) or one's own p, q, r.

    Returns
    -------
    array
        H/B, of the common shape of both.

    Raises
    ------
    ParameterError
        If a PGA is not positive or a frequency is negative.

    Examples
    --------
    >>> round(float(threshold_ratio(5.53, 2.3)), 3)
    2.714
    """
    values = np.asarray(pga, dtype=np.float64)
    if not (np.isfinite(values) & (values > 0.0)).all():
        raise ParameterError(f"the peak ground acceleration must be positive, found {_first_bad(values)} m/s^2")
    ratio: FloatArray = amplitude(frequency, criterion) / values
    return ratio


def overturning_pga(height_over_width: ArrayLike, frequency: ArrayLike, criterion: GravestoneCriterion = UNREINFORCED) -> FloatArray:
    """Return the least peak ground acceleration that overturns a stone, the inverse of [Furukawa2009]_ eqs. (9), (10).

    Parameters
    ----------
    height_over_width : array
        H/B of the sao, positive.
    frequency : array, Hz
        As for :func:`threshold_ratio`.
    criterion : GravestoneCriterion

    Returns
    -------
    array, m/s^2

    Raises
    ------
    ParameterError
        If a ratio is not positive or a frequency is negative.

    Examples
    --------
    >>> round(float(overturning_pga(2.6, 2.3)), 3)
    5.772
    """
    ratios = np.asarray(height_over_width, dtype=np.float64)
    if not (np.isfinite(ratios) & (ratios > 0.0)).all():
        raise ParameterError(f"height over width must be positive, found {_first_bad(ratios)}")
    pga: FloatArray = amplitude(frequency, criterion) / ratios
    return pga


def highest_overturning_frequency(height_over_width: float, pga: float, criterion: GravestoneCriterion = UNREINFORCED) -> float | None:
    """Return the highest frequency at which a stone still overturns, the other inverse of [Furukawa2009]_ eqs. (9), (10).

    Parameters
    ----------
    height_over_width : float
        H/B of the sao, positive.
    pga : float, m/s^2
        Peak ground acceleration, positive.
    criterion : GravestoneCriterion

    Returns
    -------
    float or None, Hz
        None when it overturns at no frequency.

    Raises
    ------
    ParameterError
        If the ratio or the PGA is not positive.
    """
    _require_positive(height_over_width, "height over width", "")
    _require_positive(pga, "the peak ground acceleration", " m/s^2")
    excess = (height_over_width * pga / criterion.p) ** 2 - 1.0
    return None if excess < 0.0 else float(criterion.q * excess ** (1.0 / criterion.r))


def amplitude(frequency: ArrayLike, criterion: GravestoneCriterion = UNREINFORCED) -> FloatArray:
    """Return a(f) = p sqrt(1 + (f/q)^r), the PGA that overturns a stone of H/B = 1 ([Furukawa2009]_ eq. (8)).

    Parameters
    ----------
    frequency : array, Hz
        Zero or more.
    criterion : GravestoneCriterion

    Returns
    -------
    array, m/s^2

    Raises
    ------
    ParameterError
        If a frequency is negative or not finite.
    """
    f = np.asarray(frequency, dtype=np.float64)
    if not (np.isfinite(f) & (f >= 0.0)).all():
        raise ParameterError(f"the frequency must be zero or more, found {_first_bad(f, least=0.0)} Hz")
    a: FloatArray = criterion.p * np.sqrt(1.0 + (f / criterion.q) ** criterion.r)
    return a


def judge(height_over_width: float, threshold: float) -> Judgement:
    """Return the verdict on a stone with the paper's band: on the line when |threshold - H/B| <= 0.1 ([Furukawa2009]_ table 5).

    Examples
    --------
    >>> judge(2.6, 2.5), judge(2.6, 2.4), judge(2.6, 2.75)
    ('on the line', 'overturns', 'stands')
    """
    if abs(threshold - height_over_width) <= ON_THE_LINE * (1.0 + 1e-9):
        return "on the line"
    return "overturns" if height_over_width > threshold else "stands"


def outside_fit(pga: float, frequency: float, ratios: ArrayLike = ()) -> tuple[str, ...]:
    """Return what lies outside the range of the fit, a sentence each, none when all is inside ([Furukawa2009]_ section 3(3)).

    Parameters
    ----------
    pga : float, m/s^2
        Peak ground acceleration.
    frequency : float, Hz
        Frequency, or equivalent frequency.
    ratios : array
        H/B of the stones judged.
    """
    found = []
    low, high = FITTED_PGA
    if not _within(pga, low, high):
        found.append(f"a PGA of {pga / GAL:.4g} gal lies outside the fit, {low / GAL:g} to {high / GAL:g} gal")
    low, high = FITTED_FREQUENCY
    if not _within(frequency, low, high):
        found.append(f"a frequency of {frequency:.3g} Hz lies outside the fit, {low:g} to {high:g} Hz")
    low, high = FITTED_RATIO
    values = np.asarray(ratios, dtype=np.float64)
    outside = int(np.count_nonzero((values < low * (1.0 - 1e-9)) | (values > high * (1.0 + 1e-9))))
    if outside:
        found.append(f"{outside} of {values.size} stones have H/B outside the fit, {low:g} to {high:g}")
    return tuple(found)


def _within(value: float, low: float, high: float) -> bool:
    """Return whether a value lies in a range, round-off at its ends forgiven."""
    return low * (1.0 - 1e-9) <= value <= high * (1.0 + 1e-9)


def _first_bad(values: FloatArray, least: float | None = None) -> float:
    """Return the first value that is not finite, not positive, or below `least`."""
    bad = ~np.isfinite(values) | ((values <= 0.0) if least is None else (values < least))
    return float(values[bad].flat[0])
