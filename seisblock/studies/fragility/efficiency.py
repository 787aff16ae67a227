"""Which measure of intensity tells best when it happens: the smaller scatter, and nothing left that another property explains."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from seisblock.core.typing import FloatArray
from seisblock.studies.fragility.intensity import IntensityMeasure
from seisblock.studies.fragility.lognormal import fit_lognormals
from seisblock.studies.fragility.probit import fit_probit
from seisblock.studies.fragility.results import Efficiency, Sufficiency

MIN_MOTIONS = 5
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
    observed = np.isfinite(log_factors)
    if observed.sum() < 2:
        return None
    logs = np.log(values)[:, None] + measure.power * np.where(observed, log_factors, np.nan)
    log_capacities = logs[observed]
    mean, beta = float(log_capacities.mean()), float(log_capacities.std(ddof=1))
    residuals = np.array([row[np.isfinite(row)].mean() if np.isfinite(row).any() else np.nan for row in logs]) - mean
    slopes = [slope for name, property_values in properties if (slope := _residual_slope(name, property_values, residuals)) is not None]
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
    medians, betas = fit_lognormals(values, happened[None], np.full((1, values.size), runs))
    if not math.isfinite(float(medians[0])):
        return None
    slopes = [
        slope for name, property_values in properties if (slope := _added_slope(name, property_values, values, happened, runs)) is not None
    ]
    return Efficiency(measure.name, measure.unit, float(medians[0]), float(betas[0]), tuple(slopes))


def _centred_property(property_values: FloatArray, residuals: FloatArray) -> FloatArray | None:
    """Return a property less its mean, NaN where nothing is known; None where it does not vary enough for a slope."""
    finite = np.isfinite(property_values) & np.isfinite(residuals)
    if finite.sum() < MIN_MOTIONS or np.unique(property_values[finite]).size < 3:
        return None
    return np.where(finite, property_values - property_values[finite].mean(), np.nan)


def _residual_slope(name: str, property_values: FloatArray, residuals: FloatArray) -> Sufficiency | None:
    """Return the slope of residuals against a property, and how probable as steep a one is by chance."""
    from scipy.special import stdtr

    x = _centred_property(property_values, residuals)
    if x is None:
        return None
    finite = np.isfinite(x)
    x, y = x[finite], residuals[finite] - residuals[finite].mean()
    slope = float(x @ y / (x @ x))
    free = x.size - 2
    error = math.sqrt(float(((y - slope * x) ** 2).sum()) / free / float(x @ x))
    chance = 2.0 * float(stdtr(free, -abs(slope) / error)) if error > 0.0 else 0.0
    return Sufficiency(name, slope, chance)


def _added_slope(name: str, property_values: FloatArray, values: FloatArray, happened: FloatArray, runs: float) -> Sufficiency | None:
    """Return what a property adds to a measure in a probit regression, as a change of the logarithm of the median."""
    from scipy.special import chdtrc

    x = _centred_property(property_values, values)
    if x is None:
        return None
    finite = np.isfinite(x)
    logs, y = np.log(values[finite]), happened[finite][None]
    n = np.full_like(y, runs)
    base_fit = fit_probit(np.column_stack([logs, np.ones_like(logs)]), y, n)
    full_fit = fit_probit(np.column_stack([logs, np.ones_like(logs), x[finite]]), y, n)
    b, _, c = full_fit.coefficients[0]
    ratio = 2.0 * float(full_fit.log_likelihood[0] - base_fit.log_likelihood[0])
    return Sufficiency(name, float(-c / b), float(chdtrc(1, max(ratio, 0.0)))) if math.isfinite(ratio) else None
