"""Efficiency and sufficiency of intensity measures: the scatter of the capacity, and what another property explains of it."""

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
"""Smallest number of motions for a slope."""

SHAPE, MAGNITUDE = "ln(pgv/pga)", "magnitude"


def efficiency_of_capacities(
    measure: IntensityMeasure, values: FloatArray, log_factors: FloatArray, properties: Sequence[tuple[str, FloatArray]]
) -> Efficiency | None:
    """Return the efficiency of a measure from IDA capacities ([LucoCornell2007]_ sections on efficiency, sufficiency).

    Motions without exceedance are left out. The slope is the least-squares slope of the logarithmic residuals against a property of
    the motions, its probability that of Student's t.

    Parameters
    ----------
    measure : IntensityMeasure
    values : (m,) array
        Of the unscaled motions.
    log_factors : (m, v) array
        Logarithms of the factors of first exceedance, for each sample of the body; infinite without exceedance.
    properties : sequence of (str, (m,) array)
        Properties for the sufficiency; NaN if unknown.
    """
    observed = np.isfinite(log_factors)
    if observed.sum() < 2:
        return None
    logs = np.log(values)[:, None] + measure.power * np.where(observed, log_factors, np.nan)
    log_capacities = logs[observed]
    mean, beta = float(log_capacities.mean()), float(log_capacities.std(ddof=1))
    # one residual per motion: samples of the body share its properties
    residuals = np.array([row[np.isfinite(row)].mean() if np.isfinite(row).any() else np.nan for row in logs]) - mean
    slopes = [slope for name, property_values in properties if (slope := _residual_slope(name, property_values, residuals)) is not None]
    return Efficiency(measure.name, measure.unit, math.exp(mean), beta, tuple(slopes))


def efficiency_of_cloud(
    measure: IntensityMeasure, values: FloatArray, exceeding: FloatArray, runs: float, properties: Sequence[tuple[str, FloatArray]]
) -> Efficiency | None:
    """Return the efficiency of a measure by probit regression, and its sufficiency ([LucoCornell2007]_ section on sufficiency).

    The probability is that of the likelihood ratio with and without the property, chi-squared with one degree of freedom.

    Parameters
    ----------
    measure, values, properties
        As in :func:`efficiency_of_capacities`.
    exceeding : (m,) array
        Exceedances of each motion.
    runs : float
        Runs of each motion.
    """
    medians, betas = fit_lognormals(values, exceeding[None], np.full((1, values.size), runs))
    if not math.isfinite(float(medians[0])):
        return None
    slopes = [
        slope for name, property_values in properties if (slope := _added_slope(name, property_values, values, exceeding, runs)) is not None
    ]
    return Efficiency(measure.name, measure.unit, float(medians[0]), float(betas[0]), tuple(slopes))


def _centred_property(property_values: FloatArray, residuals: FloatArray) -> FloatArray | None:
    """Return a property minus its mean, NaN if unknown; None if it varies too little for a slope."""
    finite = np.isfinite(property_values) & np.isfinite(residuals)
    if finite.sum() < MIN_MOTIONS or np.unique(property_values[finite]).size < 3:
        return None
    return np.where(finite, property_values - property_values[finite].mean(), np.nan)


def _residual_slope(name: str, property_values: FloatArray, residuals: FloatArray) -> Sufficiency | None:
    """Return the slope of residuals against a property, and the probability of a slope as steep by chance."""
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


def _added_slope(name: str, property_values: FloatArray, values: FloatArray, exceeding: FloatArray, runs: float) -> Sufficiency | None:
    """Return the effect of a property in a probit regression, as a change of the logarithm of the median."""
    from scipy.special import chdtrc

    x = _centred_property(property_values, values)
    if x is None:
        return None
    finite = np.isfinite(x)
    logs, y = np.log(values[finite]), exceeding[finite][None]
    n = np.full_like(y, runs)
    base_fit = fit_probit(np.column_stack([logs, np.ones_like(logs)]), y, n)
    full_fit = fit_probit(np.column_stack([logs, np.ones_like(logs), x[finite]]), y, n)
    b, _, c = full_fit.coefficients[0]
    ratio = 2.0 * float(full_fit.log_likelihood[0] - base_fit.log_likelihood[0])
    # median = exp(-(a + c x)/b), so d ln(median)/dx = -c/b
    return Sufficiency(name, float(-c / b), float(chdtrc(1, max(ratio, 0.0)))) if math.isfinite(ratio) else None
