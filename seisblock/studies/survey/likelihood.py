"""Likelihood of a survey of fallen stones over PGA and equivalent frequency.

A stone falls if ln PGA - b + e + s exceeds the logarithm of its limit by [Furukawa2009]_ eq. (9), or (10) with a dowel. The bias b and
the normal error e are common to a cemetery (criterion, ground, record); the normal error s is independent for each stone.
The prior is flat in ln PGA.

Both were measured against a generator independent of the criterion: three-dimensional rigid contact (``stack`` of one stone, friction
0.6), stones of 8 sun proportioned like Aoyama's with edges worn by 0 to 0.1 of the width, under two horizontal components and the
vertical one of recorded and synthetic motions of 0.5 to 3 Hz (PGA and frequency: larger horizontal). Eq. (9), fitted to sines along one
axis, requires less PGA than records do: b = 0.37 in 5 recorded and 0.43 in 21 synthetic motions, with a scatter from record to record of
0.10 and 0.15, and of 0.17 from stone to stone. Thirteen more recorded motions have one component only; planar blocks under them have
b = 0.36 with a scatter of 0.26, and a second component lowers b by 0.05 to 0.08. Sharp stones need 0.16 more, stones worn by 0.1
throughout 0.17 less. Between these, b = 0.35 and e = 0.24 were chosen such that five of the six PGAs of table 6 lie in the interval
(b = 0.37 and e = 0.22 miss Nichinan by 4 %); that check is therefore no independent one. The 90 % interval covers the true PGA of 95 % of
surveys of cemeteries from sharp to worn by 0.1, and of 97 % if all have the wear of the prior.

The JMA intensity at which a stone falls depends on its H/B and hardly on the frequency: I = c - 2 log10(H/B), with a scatter from record
to record of 0.09 at 0.5 to 3 Hz and 0.16 over all frequencies. The constant is that of the surveyors' rule (40 % of a cemetery at the
intensity 6.0, 90 % at 6.5, with the stones of Aoyama): c = 6.97. The generator has 6.78; the error of 0.2 includes the difference.
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
from seisblock.core._display import DisplayMixin
from seisblock.core.errors import BodyError, ParameterError
from seisblock.core.typing import FloatArray, IntArray
from seisblock.studies.survey.limits import Limits, fitted_limits

COMMON_ERROR = 0.24
"""Default standard deviation of the error common to a cemetery, in ln PGA."""

STONE_ERROR = 0.2
"""Default standard deviation of the error of each stone, in ln PGA."""

BIAS = 0.35
"""Default bias of eqs. (9), (10) of [Furukawa2009]_, in ln PGA: records require this much more than sines to overturn a stone."""

SHARP_BIAS, WEAR_BIAS_SLOPE, KNOWN_WEAR_ERROR = 0.51, -3.2, 0.22
"""Bias of sharp edges, its slope with the relative edge wear, and the common error for known edge wear."""

INTENSITY_CONSTANT, INTENSITY_ERROR = 6.97, 0.2
"""JMA intensity at which a stone of H/B = 1 falls, and the standard deviation of that of a cemetery."""

INTENSITY_PER_LN = 2.0 / math.log(10.0)
"""JMA intensity per unit of the logarithm of the amplitude ([JMA1996]_)."""

MIN_ERROR = 0.01
"""Lower limit of both errors: at 0 the likelihood would be a step."""

GRID_SIGMAS = 7.0
"""Standard deviations by which the grid of ln PGA extends beyond the limits of all stones."""

POINTS_PER_ERROR = 16
"""Grid points per standard deviation; integrals of smooth functions are then accurate to 1e-10."""


@dataclass(frozen=True, eq=False, repr=False)
class Survey(DisplayMixin):
    """Counts of fallen and standing stones.

    Parameters
    ----------
    cemetery : Cemetery
        The stones: marked one by one, or the population of which others were counted.
    fallen, standing : (rows,) array of int
        Fallen and standing stones of each row of the cemetery; zero if only a rate is known.
    counts : two ints or None
        Fallen stones and all stones of a count; None for marked stones.
    """

    cemetery: Cemetery
    fallen: IntArray
    standing: IntArray
    counts: tuple[int, int] | None = None

    @functools.cached_property
    def rows(self) -> Cemetery:
        """The cemetery with each row as one stone."""
        return self.cemetery.rows()

    @property
    def fell(self) -> int:
        """Number of fallen stones."""
        return self.counts[0] if self.counts else int(np.sum(self.fallen))

    @property
    def stone_count(self) -> int:
        """Number of surveyed stones."""
        return self.counts[1] if self.counts else self.fell + int(np.sum(self.standing))


def marked_survey(cemetery: Cemetery) -> Survey:
    """Return the survey of a cemetery with stones marked fallen or standing, without unmarked stones.

    Parameters
    ----------
    cemetery : Cemetery

    Returns
    -------
    Survey

    Raises
    ------
    BodyError
        If no stone is marked.

    Examples
    --------
    >>> from seisblock.survey import marked_survey
    >>> from seisblock.bodies.cemetery.cemetery import Cemetery, Stone
    >>> survey = marked_survey(Cemetery((Stone(2.5, fallen=False), Stone(3.0, fallen=True), Stone(3.5, fallen=True), Stone(4.0))))
    >>> survey.fell, survey.stone_count
    (2, 3)
    """
    checks.instance(cemetery, Cemetery)
    if not cemetery.has_survey:
        raise BodyError(
            "{source}: no stone is marked overturned or standing; add a column fallen (0 or 1), or give a rate such as 35/100",
            source=cemetery.source or cemetery.name,
        )
    marked_stones = cemetery.select(lambda stone: stone.fallen is not None)
    counts = np.array([stone.count for stone in marked_stones.stones], dtype=np.int64)
    fell = np.array([bool(stone.fallen) for stone in marked_stones.stones])
    return Survey(marked_stones, np.where(fell, counts, 0), np.where(fell, 0, counts))


def counted_survey(cemetery: Cemetery, fallen: int, stones: int) -> Survey:
    """Return a survey that counted fallen stones, in a place whose stones are proportioned like those of a cemetery.

    Parameters
    ----------
    cemetery : Cemetery
        The proportions of the stones.
    fallen, stones : int
        Fallen stones, and all stones of the count.

    Returns
    -------
    Survey

    Raises
    ------
    ParameterError
        If the counts are not whole numbers with 0 <= fallen <= stones and at least one stone.

    Examples
    --------
    >>> from seisblock.survey import counted_survey
    >>> from seisblock.bodies.cemetery.table import read_cemetery
    >>> survey = counted_survey(read_cemetery("aoyama.csv"), 35, 100)
    >>> survey.fell, survey.stone_count
    (35, 100)
    """
    checks.instance(cemetery, Cemetery)
    is_integer = isinstance(fallen, Integral) and isinstance(stones, Integral)
    # the interval depends on the number of stones, so that a rate alone is not enough
    if not (is_integer and 0 <= fallen <= stones and stones > 0):
        raise ParameterError(
            "a rate requires whole numbers with 0 <= fallen <= stones and at least one stone, found {fallen}/{stones}",
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
        If the text is not two whole numbers: the interval depends on the number of stones.

    Examples
    --------
    >>> parse_rate("35/100")
    (35, 100)
    """
    match = re.fullmatch(r"\s*(\d+)\s*/\s*(\d+)\s*", text)
    if match is None:
        raise ParameterError("the rate {text!r} is not of the form FALLEN/STONES; give both numbers, for example 35/100", text=text)
    return int(match[1]), int(match[2])


def log_likelihood(survey: Survey, log_pga: FloatArray, frequency: float, stone_error: float, limits: Limits = fitted_limits) -> FloatArray:
    """Return the log likelihood of a survey without the common error, (n,), up to a constant ([Furukawa2009]_ eqs. (9), (10)).

    Parameters
    ----------
    survey : Survey
    log_pga : (n,) array
        ln of PGA in m/s^2, the common error added.
    frequency : float, Hz
        Equivalent frequency.
    stone_error : float
        Standard deviation of the error of each stone, in ln PGA.
    limits : callable
        The criterion.
    """
    return _log_likelihood(survey, log_pga, np.log(limits(survey.rows, frequency)), stone_error)


def _log_likelihood(survey: Survey, log_pga: FloatArray, log_limits: FloatArray, stone_error: float) -> FloatArray:
    """Return the same from the logarithm of each row's limit, (rows,)."""
    from scipy.special import log_ndtr, logsumexp

    # capacity of a stone: the limit of the criterion with a lognormal error
    x = (log_pga[:, None] - log_limits[None, :]) / stone_error
    # logarithms of both tails stay finite far from the limit, where the probabilities underflow
    falls, stands = log_ndtr(x), log_ndtr(-x)
    # marked stones are independent given the PGA: their logarithms add
    if survey.counts is None:
        total: FloatArray = falls @ survey.fallen.astype(np.float64) + stands @ survey.standing.astype(np.float64)
        return total
    # a count: every stone is a draw from the population, whose mean probability is that of the mixture
    weights = np.array([stone.count for stone in survey.cemetery.stones]) / survey.cemetery.size
    fallen, stones = survey.counts
    log_rate, log_rest = (logsumexp(logs, axis=1, b=weights) for logs in (falls, stands))
    result: FloatArray = fallen * log_rate + (stones - fallen) * log_rest
    return result


@dataclass(frozen=True, eq=False)
class Likelihood:
    """Likelihood over ln PGA at one frequency, marginalised over the common error.

    Parameters
    ----------
    frequency : float, Hz
    log_pga : (n,) array
        Evenly spaced, ln of m/s^2.
    value : (n,) array
        Up to a constant factor; if none or all fell, the probability of that.
    """

    frequency: float
    log_pga: FloatArray
    value: FloatArray

    def interpolate(self, log_pga: FloatArray) -> FloatArray:
        """Return the likelihood at other values of ln PGA; constant beyond the ends."""
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
        Excess of the PGA of the ground over that of the criterion, in ln PGA.
    limits : callable
        The criterion.

    Raises
    ------
    ParameterError
        If an error is smaller than 0.01, or the bias is not finite.
    """
    if not math.isfinite(bias):
        raise ParameterError("`bias`, in ln PGA, must be a finite number, found {bias}", bias=bias)
    for name, error in (("common", common_error), ("stone", stone_error)):
        if not (math.isfinite(error) and error >= MIN_ERROR):
            raise ParameterError(
                "`{name}_error`, in ln PGA, must be at least {least}, found {error}",
                name=name,
                least=MIN_ERROR,
                error=error,
            )
    # relative to the lowest limit and rounded: frequencies with equal relative limits share a cached curve
    centres = np.log(limits(survey.rows, frequency))
    lowest = float(centres.min())
    grid, value = _likelihood_curve(survey, tuple(np.round(centres - lowest, 12).tolist()), common_error, stone_error)
    return Likelihood(frequency, lowest + grid + bias, value)


@functools.lru_cache(maxsize=8)
def _likelihood_curve(
    survey: Survey, log_limits: tuple[float, ...], common_error: float, stone_error: float
) -> tuple[FloatArray, FloatArray]:
    """Return the likelihood over ln PGA, both relative to the lowest limit.

    The limits of all stones scale alike with frequency ([Furukawa2009]_ eqs. (8), (9)): one cached curve serves every frequency.
    """
    # the step resolves the narrower of both errors
    spread, step = math.hypot(common_error, stone_error), min(common_error, stone_error) / POINTS_PER_ERROR
    reach = math.ceil(GRID_SIGMAS * spread / step)
    # beyond this reach all stones stand, or all fall, and the curve is constant
    grid = step * np.arange(-reach, math.ceil(max(log_limits) / step) + reach + 1, dtype=np.float64)
    stone_log_likelihood = _log_likelihood(survey, grid, np.array(log_limits), stone_error)
    # marginalisation over the normal common error is a convolution on the even grid
    half = math.ceil(GRID_SIGMAS * common_error / step)
    kernel = np.exp(-0.5 * (step * np.arange(-half, half + 1) / common_error) ** 2)
    # the maximum is scaled to 1 against underflow; constant ends where none or all stones fall
    padded = np.pad(np.exp(stone_log_likelihood - stone_log_likelihood.max()), half, mode="edge")
    return grid, np.convolve(padded, kernel / kernel.sum(), mode="valid")
