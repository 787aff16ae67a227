"""Shaking read back from fallen stones: the likelihood of a survey over PGA and equivalent frequency.

A stone falls when ln PGA - b + e + s exceeds the logarithm of its limit by [Furukawa2009]_ eq. (9), or (10) with a dowel. The bias b and
the error e, normal, are common to a cemetery (the criterion, the ground, the record); the error s, normal, is each stone's own.
The prior is flat in ln PGA.

What they are was measured against another generator than the criterion: rigid blocks, 8 sun wide and proportioned as Aoyama's stones, under
21 recorded accelerograms of 0.5 to 3 Hz, 0.35 to 1.6 times the median limit. Eq. (9), fitted to sines, takes less PGA than
records do: by a factor of 1.68 for sharp blocks and of 1.25 for blocks worn by 0.1 of their width per side, with a scatter of 0.28 and 0.27
in ln PGA from record to record. Between the two edges b = 0.33 and e = 0.3, with f known to a tenth, hold the truth of 87 to 95 % of such
surveys in an interval of 90 %. The half sine on a rigid block of the same edges has no bias (0.0, -0.04) and a scatter of 0.24.
A stone's own limit scatters by 0.2.
Of the six surveyed rates of table 6, taken as of 100 stones each, the interval holds five recorded PGAs.
"""

from __future__ import annotations

import functools
import math
import re
from dataclasses import dataclass
from numbers import Integral

import numpy as np

from seisblock.bodies.cemetery.cemetery import Cemetery
from seisblock.core import checks
from seisblock.core.errors import BodyError, ParameterError
from seisblock.core.typing import FloatArray, IntArray
from seisblock.studies.survey.limits import Limits, fitted_limits

COMMON_ERROR = 0.3
"""Default standard deviation of what is common to a cemetery, in ln PGA."""

STONE_ERROR = 0.2
"""Default standard deviation of what is each stone's own, in ln PGA."""

BIAS = 0.33
"""Default bias of eqs. (9), (10) of [Furukawa2009]_, in ln PGA: records need this much more than sines to fell a block."""

SHARP_BIAS, WEAR_BIAS_SLOPE, KNOWN_WEAR_ERROR = 0.52, -2.9, 0.29
"""Bias for sharp edges, its change with the share of the width by which each edge is worn, and the common error where that is known."""

MIN_ERROR = 0.01
"""Neither error may be smaller: the likelihood would be a step."""

GRID_SIGMAS = 7.0
"""The grid of ln PGA reaches so many standard deviations beyond the limits of all stones."""

POINTS_PER_ERROR = 16
"""Points of the grid per standard deviation; the integrals of smooth functions are then good to 1e-10."""


@dataclass(frozen=True, eq=False)
class Survey:
    """How many of which stones fell.

    Parameters
    ----------
    cemetery : Cemetery
        The stones: those judged one by one, or the population of which others were counted.
    fallen, standing : (rows,) array of int
        Stones of each row of the cemetery that fell and that stand; zero where only a rate is known.
    counts : two ints or None
        Fallen and all of a count of stones as these are; None where the stones themselves are marked.
    """

    cemetery: Cemetery
    fallen: IntArray
    standing: IntArray
    counts: tuple[int, int] | None = None

    @functools.cached_property
    def rows(self) -> Cemetery:
        """The cemetery with each row taken for one stone."""
        return self.cemetery.rows()

    @property
    def fell(self) -> int:
        """Number of fallen stones."""
        return self.counts[0] if self.counts else int(np.sum(self.fallen))

    @property
    def stone_count(self) -> int:
        """Number of stones of which it is known."""
        return self.counts[1] if self.counts else self.fell + int(np.sum(self.standing))


def marked_survey(cemetery: Cemetery) -> Survey:
    """Return the survey of a cemetery whose stones are marked fallen or standing; those that are not marked are left out.

    Parameters
    ----------
    cemetery : Cemetery

    Raises
    ------
    BodyError
        If no stone is marked.

    Examples
    --------
    >>> from seisblock.bodies.cemetery.cemetery import Stone
    >>> survey = marked_survey(Cemetery((Stone(2.5, fallen=False), Stone(3.0, fallen=True), Stone(3.5, fallen=True), Stone(4.0))))
    >>> survey.fell, survey.stone_count
    (2, 3)
    """
    checks.instance(cemetery, Cemetery)
    if not cemetery.has_survey:
        raise BodyError(
            "{source}: no stone is marked fallen or standing; add a column fallen (0 or 1), or give a rate such as 35/100",
            source=cemetery.source or cemetery.name,
        )
    marked = cemetery.select(lambda stone: stone.fallen is not None)
    counts = np.array([stone.count for stone in marked.stones], dtype=np.int64)
    fell = np.array([bool(stone.fallen) for stone in marked.stones])
    return Survey(marked, np.where(fell, counts, 0), np.where(fell, 0, counts))


def counted_survey(cemetery: Cemetery, fallen: int, stones: int) -> Survey:
    """Return a survey that counted how many of so many stones fell, in a place whose stones are proportioned as these.

    Parameters
    ----------
    cemetery : Cemetery
        The proportions of the stones.
    fallen, stones : int
        How many fell, of how many that were looked at.

    Raises
    ------
    ParameterError
        If the counts make no sense.

    Examples
    --------
    >>> from seisblock.bodies.cemetery.table import read_cemetery
    >>> survey = counted_survey(read_cemetery("aoyama.csv"), 35, 100)
    >>> survey.fell, survey.stone_count
    (35, 100)
    """
    checks.instance(cemetery, Cemetery)
    is_integer = isinstance(fallen, Integral) and isinstance(stones, Integral)
    if not (is_integer and 0 <= fallen <= stones and stones > 0):
        raise ParameterError(
            "a rate needs whole numbers, 0 <= fallen <= stones, and at least one stone, found {fallen}/{stones}",
            fallen=fallen,
            stones=stones,
        )
    zeros = np.zeros(len(cemetery.stones), dtype=np.int64)
    return Survey(cemetery, zeros, zeros, (fallen, stones))


def parse_rate(text: str) -> tuple[int, int]:
    """Return the counts of a rate such as ``35/100``.

    Raises
    ------
    ParameterError
        If it is not two whole numbers: how many were counted decides how far a rate can be trusted.

    Examples
    --------
    >>> parse_rate("35/100")
    (35, 100)
    """
    match = re.fullmatch(r"\s*(\d+)\s*/\s*(\d+)\s*", text)
    if match is None:
        raise ParameterError("the rate {text!r} is not FALLEN/STONES: write both numbers, for example 35/100", text=text)
    return int(match[1]), int(match[2])


def log_likelihood(survey: Survey, log_pga: FloatArray, frequency: float, stone_error: float, limits: Limits = fitted_limits) -> FloatArray:
    """Return the logarithm of the survey's likelihood without the common error, (n,), up to a constant ([Furukawa2009]_ eqs. (9), (10)).

    Parameters
    ----------
    survey : Survey
    log_pga : (n,) array
        ln of PGA in m/s^2, the common error added.
    frequency : float, Hz
        Equivalent frequency.
    stone_error : float
        Standard deviation of each stone's own error, in ln PGA.
    limits : callable
        The criterion.
    """
    return _log_likelihood(survey, log_pga, np.log(limits(survey.rows, frequency)), stone_error)


def _log_likelihood(survey: Survey, log_pga: FloatArray, log_limits: FloatArray, stone_error: float) -> FloatArray:
    """Return the same, given the logarithm of each row's limit, (rows,)."""
    from scipy.special import log_ndtr, logsumexp

    x = (log_pga[:, None] - log_limits[None, :]) / stone_error
    falls, stands = log_ndtr(x), log_ndtr(-x)
    if survey.counts is None:
        total: FloatArray = falls @ survey.fallen.astype(np.float64) + stands @ survey.standing.astype(np.float64)
        return total
    weights = np.array([stone.count for stone in survey.cemetery.stones]) / survey.cemetery.size
    fallen, stones = survey.counts
    log_rate, log_rest = (logsumexp(logs, axis=1, b=weights) for logs in (falls, stands))
    result: FloatArray = fallen * log_rate + (stones - fallen) * log_rest
    return result


@dataclass(frozen=True, eq=False)
class Likelihood:
    """The likelihood over ln PGA at one frequency, the common error integrated out.

    Parameters
    ----------
    frequency : float, Hz
    log_pga : (n,) array
        Evenly spaced, ln of m/s^2.
    value : (n,) array
        Up to a constant factor; where none or all fell it is the probability of that.
    """

    frequency: float
    log_pga: FloatArray
    value: FloatArray

    def interpolate(self, log_pga: FloatArray) -> FloatArray:
        """Return the likelihood elsewhere; beyond its ends it stays as it is there."""
        return np.interp(log_pga, self.log_pga, self.value)


def likelihood(
    survey: Survey,
    frequency: float,
    *,
    common_error: float = COMMON_ERROR,
    stone_error: float = STONE_ERROR,
    bias: float = BIAS,
    limits: Limits = fitted_limits,
) -> Likelihood:
    """Return the likelihood of a survey at one equivalent frequency ([Furukawa2009]_ eqs. (9), (10), table 6).

    Parameters
    ----------
    survey : Survey
    frequency : float, Hz
        Zero or more.
    common_error, stone_error : float
        Standard deviations in ln PGA, at least 0.01.
    bias : float
        How much more PGA than the criterion's the ground must have, in ln PGA.
    limits : callable
        The criterion.

    Raises
    ------
    ParameterError
        If an error is smaller than 0.01, or the bias is no number.
    """
    if not math.isfinite(bias):
        raise ParameterError("the bias, in ln PGA, must be a number, found {bias}", bias=bias)
    for name, error in (("common", common_error), ("stone", stone_error)):
        if not (math.isfinite(error) and error >= MIN_ERROR):
            raise ParameterError(
                "the {name} error, in ln PGA, must be at least {least}, found {error}",
                name=name,
                least=MIN_ERROR,
                error=error,
            )
    centres = np.log(limits(survey.rows, frequency))
    lowest = float(centres.min())
    grid, value = _likelihood_curve(survey, tuple(np.round(centres - lowest, 12).tolist()), common_error, stone_error)
    return Likelihood(frequency, lowest + grid + bias, value)


@functools.lru_cache(maxsize=8)
def _likelihood_curve(
    survey: Survey, log_limits: tuple[float, ...], common_error: float, stone_error: float
) -> tuple[FloatArray, FloatArray]:
    """Return the likelihood over ln PGA, both relative to the lowest limit.

    Where the limits of all stones change alike with frequency ([Furukawa2009]_ eqs. (8), (9)), one curve serves for every frequency.
    """
    spread, step = math.hypot(common_error, stone_error), min(common_error, stone_error) / POINTS_PER_ERROR
    reach = math.ceil(GRID_SIGMAS * spread / step)
    grid = step * np.arange(-reach, math.ceil(max(log_limits) / step) + reach + 1, dtype=np.float64)
    stone_log_likelihood = _log_likelihood(survey, grid, np.array(log_limits), stone_error)
    half = math.ceil(GRID_SIGMAS * common_error / step)
    kernel = np.exp(-0.5 * (step * np.arange(-half, half + 1) / common_error) ** 2)
    padded = np.pad(np.exp(stone_log_likelihood - stone_log_likelihood.max()), half, mode="edge")
    return grid, np.convolve(padded, kernel / kernel.sum(), mode="valid")
