"""Ground motion estimated from a survey of fallen stones: PGA, PGV and JMA intensity with intervals, or bounds."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from seisblock.bodies.cemetery.cemetery import Cemetery
from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.i18n import N_, lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.criteria.gravestones import DOWELLED_NOTE, fit_range_warnings
from seisblock.criteria.intensity import FITTED_INTENSITY, SCATTER, intensity_from_velocity
from seisblock.measures import jma_class
from seisblock.studies.survey.assumptions import FREQUENCY_BAND, Assumptions
from seisblock.studies.survey.likelihood import INTENSITY_PER_LN, Likelihood, Survey, log_likelihood
from seisblock.studies.survey.limits import Limits
from seisblock.studies.survey.overturning_rate import threshold_ratio
from seisblock.studies.survey.stones import StoneResult, stone_results

PLAIN_STONES, DOWELLED_STONES, ALL_STONES = N_("not reinforced"), N_("reinforced"), N_("all")
"""Names of the groups of stones, estimated separately and together."""

RULE = ((0.9, "7"), (0.4, "6+"))
"""Surveyors' rule: smallest overturning rate and JMA class."""

LEVELS = 601
"""Levels of the criterion over which the outcome of each stone is averaged."""

Interval = tuple[float | None, float | None]


@dataclass(frozen=True, repr=False)
class ShakingEstimate(DisplayMixin):
    """Estimate from a group of stones at one frequency; the fields are the keys of one result in the document of ``infer``.

    Parameters
    ----------
    stones : str
        ``not reinforced``, ``reinforced`` or ``all``.
    fallen, standing : int
    frequency_hz : float or None
        Given equivalent frequency; None: averaged over 0.5 to 3 Hz, evenly in ln f.
    bound : str or None
        ``upper`` if none fell, ``lower`` if all did, else None.
    pga_m_s2, pga_interval_m_s2 : float or None, two of them
        Median and interval; with a bound there is no median, and the open end is None.
    pgv_m_s, pgv_interval_m_s
        The same for PGV = PGA/(2 pi f).
    threshold_ratio, threshold_ratio_interval
        Smallest overturning H/B; for all stones, that of stones without a dowel.
    jma_intensity, jma_intensity_interval : float or None, two of them, 1
        From the H/B of the stones; with the criterion rigid from PGV. Their scatter is included.
    jma_classes : two str or None
        JMA classes of that interval's ends.
    jma_class_by_rule : str or None
        Class by the surveyors' rule, see :func:`class_by_rule`; None below 40 %.
    """

    stones: str
    fallen: int
    standing: int
    frequency_hz: float | None
    bound: str | None
    pga_m_s2: float | None
    pga_interval_m_s2: Interval
    pgv_m_s: float | None
    pgv_interval_m_s: Interval
    threshold_ratio: float | None
    threshold_ratio_interval: Interval
    jma_intensity: float | None
    jma_intensity_interval: Interval
    jma_classes: tuple[str | None, str | None]
    jma_class_by_rule: str | None


def estimate_shaking(
    survey: Survey, frequency: float | None = None, assumptions: Assumptions | None = None, *, stones: str = ""
) -> ShakingEstimate:
    """Return the ground motion estimated from a survey ([Furukawa2009]_ eqs. (9), (10) inverted; [Midorikawa1999]_).

    Flat prior in ln PGA; see :mod:`seisblock.studies.survey.likelihood` for the errors. If no stone fell, the upper bound is the PGA
    at which that has the probability of one tail, (1 - level)/2; if all fell, likewise the lower bound.

    Parameters
    ----------
    survey : Survey
    frequency : float or None, Hz
        Equivalent frequency, positive; None averages over 0.5 to 3 Hz.
    assumptions : Assumptions
    stones : str
        Name of the group; by default from the stones themselves.

    Returns
    -------
    ShakingEstimate

    Raises
    ------
    ParameterError
        If the frequency is not positive, or an error of the model is too small.

    Examples
    --------
    >>> from seisblock.survey import estimate_shaking
    >>> from seisblock.bodies.cemetery.table import read_cemetery
    >>> from seisblock.studies.survey.likelihood import counted_survey
    >>> estimate = estimate_shaking(counted_survey(read_cemetery("aoyama.csv"), 35, 100), 2.75)
    >>> round(estimate.pga_m_s2, 1)
    9.7
    """
    checks.instance(survey, Survey)
    settings = assumptions or Assumptions()
    if frequency is not None:
        checks.positive("the equivalent frequency", frequency, "Hz")
    band, weights = settings.frequency_band(frequency)
    parts = settings.likelihoods(survey, band)
    bound = "upper" if survey.fell == 0 else "lower" if survey.fell == survey.stone_count else None
    pga = _summary(*_average_likelihoods(parts, [0.0] * len(parts), weights), bound, settings.level)
    pgv = _summary(*_average_likelihoods(parts, [math.log(2.0 * math.pi * f) for f in band], weights), bound, settings.level)
    name = stones or _kind(survey.cemetery)
    # the threshold H/B is the criterion's own: the bias between records and sines is taken out of the PGA
    bias_factor = math.exp(-settings.bias)
    ratio = (
        (None, None, None)
        if frequency is None
        else tuple(_ratio(None if a is None else a * bias_factor, frequency, name, settings.limits) for a in pga)
    )
    if settings.intensity_constant is None:
        intensity = _intensities(pgv, settings.level)
    else:
        part = settings.intensity_likelihood(survey)
        low, middle, high = (
            None if value is None else INTENSITY_PER_LN * math.log(value)
            for value in _summary(part.log_pga, part.value, bound, settings.level)
        )
        intensity = low, middle, high
    return ShakingEstimate(
        name,
        survey.fell,
        survey.stone_count - survey.fell,
        frequency,
        bound,
        pga[1],
        (pga[0], pga[2]),
        pgv[1],
        (pgv[0], pgv[2]),
        # a higher PGA means a lower threshold H/B: the ends change places
        ratio[1],
        (ratio[2], ratio[0]),
        intensity[1],
        (intensity[0], intensity[2]),
        (_class(intensity[0]), _class(intensity[2])),
        class_by_rule(survey.fell / survey.stone_count),
    )


def class_by_rule(rate: float) -> str | None:
    """Return the JMA class that the surveyors' rule gives for the overturning rate of a cemetery.

    From 40 to below 90 % mean 6 upper, 90 % and more mean 7; the rule has no class below.

    Examples
    --------
    >>> [class_by_rule(rate) for rate in (0.39, 0.4, 0.52, 0.9)]
    [None, '6+', '6+', '7']
    """
    return next((name for lowest, name in RULE if rate >= lowest), None)


def fitted_stones(survey: Survey, frequency: float | None = None, assumptions: Assumptions | None = None) -> tuple[StoneResult, ...]:
    """Return the outcome of each row of a survey at the estimated shaking ([Furukawa2009]_ eqs. (9), (10)).

    The common error and the bias cancel: the level of the criterion follows from the stones alone. The threshold is the PGA at which a
    stone falls, with the bias, at the given frequency or in the middle of the band.
    """
    from scipy.special import ndtr

    settings = assumptions or Assumptions()
    middle = math.sqrt(FREQUENCY_BAND[0] * FREQUENCY_BAND[1]) if frequency is None else frequency
    limits = np.log(settings.limits(survey.rows, middle))
    levels = np.linspace(limits.min() - 3.0, limits.max() + 3.0, LEVELS)
    logs = log_likelihood(survey, levels, middle, settings.stone_error, settings.limits)
    weights = np.exp(logs - logs.max())
    falls = ndtr((levels[:, None] - limits[None, :]) / settings.stone_error)
    probabilities = weights @ falls / weights.sum()
    # the falls of a count are not those of the listed stones
    cemetery = survey.cemetery.without_outcomes() if survey.counts else survey.cemetery
    return stone_results(cemetery, np.exp(limits + settings.bias), probabilities >= 0.5, probabilities)


def stone_groups(survey: Survey) -> Iterator[tuple[str, Survey]]:
    """Yield stones without a dowel, with one, and all together, as far as present ([Furukawa2009]_ eqs. (9), (10)).

    A count of stones of both kinds cannot be separated and stays whole.
    """
    name = _kind(survey.cemetery)
    if name == ALL_STONES and survey.counts is None:
        rows = np.array([stone.reinforced for stone in survey.cemetery.stones])
        for label, mask in ((PLAIN_STONES, ~rows), (DOWELLED_STONES, rows)):
            part = survey.cemetery.select(lambda stone, label=label: stone.reinforced == (label == DOWELLED_STONES))  # type: ignore[misc]
            yield label, replace(survey, cemetery=part, fallen=survey.fallen[mask], standing=survey.standing[mask])
    yield name, survey


def frequency_contour(
    survey: Survey, assumptions: Assumptions | None = None, frequencies: Sequence[float] | None = None
) -> list[ShakingEstimate]:
    """Return estimates along the trade-off of PGA and frequency: PGA grows with f like a(f) ([Furukawa2009]_ eq. (8))."""
    grid = [round(0.1 * i, 1) for i in range(5, 31)] if frequencies is None else frequencies
    return [estimate_shaking(survey, f, assumptions) for f in grid]


def _average_likelihoods(parts: Sequence[Likelihood], shifts: Sequence[float], weights: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the weighted mean of likelihoods over frequency, against ln PGA minus the shift of each."""
    starts = [part.log_pga[0] - shift for part, shift in zip(parts, shifts, strict=True)]
    ends = [part.log_pga[-1] - shift for part, shift in zip(parts, shifts, strict=True)]
    # parts share one step, so a common grid interpolates without loss
    step = float(parts[0].log_pga[1] - parts[0].log_pga[0])
    # the union of the shifted grids
    grid = np.arange(min(starts), max(ends) + step, step)
    total = np.zeros(grid.size)
    for part, shift, weight in zip(parts, shifts, weights, strict=True):
        total += weight * part.interpolate(grid + shift)
    return grid, total


def _summary(grid: FloatArray, value: FloatArray, bound: str | None, level: float) -> tuple[float | None, float | None, float | None]:
    """Return lower end, median and upper end of a quantity; `grid` holds its logarithm."""
    if bound == "upper":
        # with a bound the likelihood is the probability of the survey itself, monotone in ln PGA
        return None, None, float(np.exp(np.interp((level - 1.0) / 2.0, -value, grid)))
    if bound == "lower":
        return float(np.exp(np.interp((1.0 - level) / 2.0, value, grid))), None, None
    return posterior_quantiles(grid, value, level)


def posterior_quantiles(grid: FloatArray, value: FloatArray, level: float) -> tuple[float, float, float]:
    """Return lower end, median and upper end from a likelihood over the logarithm of a quantity with a flat prior (trapezoidal rule)."""
    tail = (1.0 - level) / 2.0
    cumulative = np.concatenate([[0.0], np.cumsum(0.5 * (value[1:] + value[:-1]))])
    low, middle, high = (float(np.exp(np.interp(share * cumulative[-1], cumulative, grid))) for share in (tail, 0.5, 1.0 - tail))
    return low, middle, high


def _ratio(pga: float | None, frequency: float, name: str, limits: Limits) -> float | None:
    return None if pga is None else threshold_ratio(pga, frequency, reinforced=name == DOWELLED_STONES, limits=limits)


def _intensities(pgv: tuple[float | None, float | None, float | None], level: float) -> tuple[float | None, float | None, float | None]:
    """Return lower end, median and upper end of the JMA intensity: variances of ln PGV and of the relation are added."""
    from scipy.special import ndtri

    spread = SCATTER * float(ndtri(0.5 + level / 2.0))
    low, middle, high = (None if v is None else intensity_from_velocity(v) for v in pgv)
    if middle is None:
        return None if low is None else low - spread, None, None if high is None else high + spread
    assert low is not None
    assert high is not None
    return middle - math.hypot(middle - low, spread), middle, middle + math.hypot(high - middle, spread)


def _class(intensity: float | None) -> str | None:
    return None if intensity is None else jma_class(intensity)


def _kind(cemetery: Cemetery) -> str:
    reinforced = cemetery.reinforced
    return DOWELLED_STONES if reinforced.all() else ALL_STONES if reinforced.any() else PLAIN_STONES


def split_stone_label(stones: str) -> tuple[str, str]:
    """Return the place, empty for a single one, and the kind of the stones of an estimate.

    Examples
    --------
    >>> split_stone_label("Hino, north, not reinforced"), split_stone_label("all")
    (('Hino, north', 'not reinforced'), ('', 'all'))
    """
    place, _, kind = stones.rpartition(", ")
    return place, kind


def estimate_warnings(estimate: ShakingEstimate) -> list[str]:
    """Return warnings about an estimate, a sentence each ([Furukawa2009]_, [Midorikawa1999]_)."""
    low, high = FITTED_INTENSITY
    place, kind = split_stone_label(estimate.stones)
    messages: list[str] = [DOWELLED_NOTE] if kind != PLAIN_STONES else []
    stone_label = lazy_gettext("{place}, {kind}", place=place, kind=lazy_gettext(kind)) if place else lazy_gettext(kind)
    if estimate.frequency_hz is not None and estimate.pga_m_s2 is not None:
        messages += fit_range_warnings(estimate.pga_m_s2, estimate.frequency_hz)
    if estimate.bound == "upper":
        messages.append(lazy_gettext("{which} stones: upper bound only (none overturned)", which=stone_label))
    if estimate.bound == "lower":
        messages.append(lazy_gettext("{which} stones: lower bound only (all overturned)", which=stone_label))
    if estimate.jma_intensity is not None and not low <= estimate.jma_intensity <= high:
        text = "JMA intensity {found:.1f} is outside the range of its relation with PGV, {low:g} to {high:g}"
        messages.append(lazy_gettext(text, found=estimate.jma_intensity, low=low, high=high))
    return messages
