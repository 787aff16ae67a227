"""Which measure of intensity tells best when it happens: the smaller scatter, and nothing left that another property explains."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from seisblock.studies.fragility.answer import Efficiency, Sufficiency
from seisblock.studies.fragility.intensity import IntensityMeasure
from seisblock.studies.fragility.lognormal import curves
from seisblock.studies.fragility.probit import probits
from seisblock.typing import FloatArray

FEWEST = 5
"""Motions behind a slope, at least."""

SHAPE, MAGNITUDE = "ln(pgv/pga)", "magnitude"


def efficiency_of_capacities(
    measure: IntensityMeasure, values: FloatArray, log_factors: FloatArray, properties: Sequence[tuple[str, FloatArray]]
) -> Efficiency | None:
    """Return how much a measure scatters at the factors at which it happens first ([LucoCornell2007]_ sections on efficiency, sufficiency).

    Motions in which it never happened have no part. The slope is that of the residuals of the logarithm against a property of the
    motions, by least squares, and its probability that of Student's t.

    Parameters
    ----------
    measure : IntensityMeasure
    values : (m,) array
        Of the motions as they are.
    log_factors : (m, v) array
        At which it happens first, for each version of the body; infinite where it does not.
    properties : sequence of (str, (m,) array)
        What may be left; NaN where it is unknown.
    """
    seen = np.isfinite(log_factors)
    if seen.sum() < 2:
        return None
    logs = np.log(values)[:, None] + measure.power * np.where(seen, log_factors, np.nan)
    found = logs[seen]
    mean, beta = float(found.mean()), float(found.std(ddof=1))
    left = np.array([row[np.isfinite(row)].mean() if np.isfinite(row).any() else np.nan for row in logs]) - mean
    slopes = [each for name, given in properties if (each := _slope(name, given, left)) is not None]
    return Efficiency(measure.name, measure.unit, math.exp(mean), beta, tuple(slopes))


def efficiency_of_cloud(
    measure: IntensityMeasure, values: FloatArray, happened: FloatArray, runs: float, properties: Sequence[tuple[str, FloatArray]]
) -> Efficiency | None:
    """Return how much a measure scatters by probit regression, and what a property adds ([LucoCornell2007]_ section on sufficiency).

    The probability is that of the ratio of the likelihoods with and without the property, a chi-square of one degree of freedom.

    Parameters
    ----------
    measure, values, properties
        As of :func:`efficiency_of_capacities`.
    happened : (m,) array
    runs : float
        Of each motion.
    """
    medians, betas = curves(values, happened[None], np.full((1, values.size), runs))
    if not math.isfinite(float(medians[0])):
        return None
    slopes = [each for name, given in properties if (each := _more(name, given, values, happened, runs)) is not None]
    return Efficiency(measure.name, measure.unit, float(medians[0]), float(betas[0]), tuple(slopes))


def _known(given: FloatArray, left: FloatArray) -> FloatArray | None:
    """Return a property less its mean, NaN where nothing is known; None where it does not vary enough for a slope."""
    known = np.isfinite(given) & np.isfinite(left)
    if known.sum() < FEWEST or np.unique(given[known]).size < 3:
        return None
    return np.where(known, given - given[known].mean(), np.nan)


def _slope(name: str, given: FloatArray, left: FloatArray) -> Sufficiency | None:
    """Return the slope of residuals against a property, and how probable as steep a one is by chance."""
    from scipy.special import stdtr

    x = _known(given, left)
    if x is None:
        return None
    known = np.isfinite(x)
    x, y = x[known], left[known] - left[known].mean()
    slope = float(x @ y / (x @ x))
    free = x.size - 2
    error = math.sqrt(float(((y - slope * x) ** 2).sum()) / free / float(x @ x))
    chance = 2.0 * float(stdtr(free, -abs(slope) / error)) if error > 0.0 else 0.0
    return Sufficiency(name, slope, chance)


def _more(name: str, given: FloatArray, values: FloatArray, happened: FloatArray, runs: float) -> Sufficiency | None:
    """Return what a property adds to a measure in a probit regression, as a change of the logarithm of the median."""
    from scipy.special import chdtrc

    x = _known(given, values)
    if x is None:
        return None
    known = np.isfinite(x)
    logs, y = np.log(values[known]), happened[known][None]
    n = np.full_like(y, runs)
    alone = probits(np.column_stack([logs, np.ones_like(logs)]), y, n)
    both = probits(np.column_stack([logs, np.ones_like(logs), x[known]]), y, n)
    b, _, c = both.coefficients[0]
    ratio = 2.0 * float(both.log_likelihood[0] - alone.log_likelihood[0])
    return Sufficiency(name, float(-c / b), float(chdtrc(1, max(ratio, 0.0)))) if math.isfinite(ratio) else None
