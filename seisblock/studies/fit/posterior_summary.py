"""Posterior summaries: medians, credible intervals, narrowing against the prior, and correlations."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from seisblock.core.i18n import N_
from seisblock.core.typing import FloatArray
from seisblock.studies.fit.block_family import BlockFamily
from seisblock.studies.fit.likelihood import LAPSE_STEPS, LapseRate
from seisblock.studies.fit.priors import ALPHA, INSET, LAPSE, RESTITUTION, SCATTER, P

TURNING_ALPHA, TURNING_P = "turning_alpha", "turning_p"
"""alpha and p of the worn block, as against those of sharp edges."""

PARAMETER_LABELS = {
    ALPHA: N_("alpha"),
    P: N_("p"),
    RESTITUTION: N_("restitution"),
    INSET: N_("edge wear"),
    TURNING_ALPHA: N_("alpha (worn)"),
    TURNING_P: N_("p (worn)"),
    SCATTER: N_("scatter"),
    LAPSE: N_("lapse rate"),
}
"""Labels of the parameters in sentences and figures."""

PRIOR_SAMPLES = 20_000
"""Number of samples of the prior."""

IDENTIFIED_RATIO = 0.5
"""Largest ratio of the widths of posterior and prior interval of an identified parameter."""

HIGH_CORRELATION = 0.9
"""Correlation above which two parameters cannot be separated."""


@dataclass(frozen=True)
class Marginal:
    """Marginal posterior of one parameter.

    Parameters
    ----------
    name : str
    median : float
        alpha in rad, p in rad/s, else shares of 1.
    interval, before : (float, float)
        Posterior and prior interval, in the same unit.
    narrowed : float, 1
        Ratio of their widths: near 1 the outcomes give no information.
    """

    name: str
    median: float
    interval: tuple[float, float]
    before: tuple[float, float]
    narrowed: float

    @property
    def identified(self) -> bool:
        """True if the posterior is clearly narrower than the prior."""
        return self.narrowed < IDENTIFIED_RATIO


@dataclass(frozen=True)
class Correlation:
    """Posterior correlation of two parameters.

    Parameters
    ----------
    first, second : str
    coefficient : float, 1
        -1 to 1.
    """

    first: str
    second: str
    coefficient: float


def quantiles(values: FloatArray, weights: FloatArray, shares: FloatArray) -> FloatArray:
    """Return weighted quantiles; (n,), (n,) and (k,) arrays."""
    order = np.argsort(values)
    cumulative = np.cumsum(weights[order])
    # each value stands at the middle of its own weight
    middles = (cumulative - 0.5 * weights[order]) / cumulative[-1]
    return np.interp(shares, middles, values[order])


def medians(unit_points: FloatArray, weights: FloatArray) -> FloatArray:
    """Return the coordinate-wise weighted median, (d,), of points, (n, d)."""
    return np.array([float(quantiles(column, weights, np.array([0.5]))[0]) for column in unit_points.T])


def _marginal(name: str, values: FloatArray, weights: FloatArray, prior_values: FloatArray, level: float, *, logarithmic: bool) -> Marginal:
    """Return the marginal posterior of weighted values, with the prior's interval."""
    tail = 0.5 * (1.0 - level)
    ends = np.array([tail, 0.5, 1.0 - tail])
    low, middle, high = (float(value) for value in quantiles(values, weights, ends))
    first, _, last = (float(value) for value in quantiles(prior_values, np.ones(prior_values.size), ends))
    widths = [np.log(b / a) if logarithmic else b - a for a, b in ((low, high), (first, last))]
    return Marginal(name, middle, (low, high), (first, last), float(widths[0] / widths[1]))


def marginals(family: BlockFamily, unit_points: FloatArray, weights: FloatArray, lapse: LapseRate, level: float) -> tuple[Marginal, ...]:
    """Return the marginal posterior of each free parameter.

    Parameters
    ----------
    family : BlockFamily
    unit_points : (n, d) array, 1
    weights : (l, n) array, 1
        Of each lambda and each block.
    lapse : LapseRate
    level : float, 1
        Level of the intervals.
    """
    block_weights, lapse_weights = weights.sum(axis=0), weights.sum(axis=1)
    prior_points = np.random.default_rng(0).random((PRIOR_SAMPLES, len(family.axes)))
    posterior_values, prior_values = family.values(unit_points), family.values(prior_points)
    result = [
        _marginal(a.name, posterior_values[a.name], block_weights, prior_values[a.name], level, logarithmic=a.logarithmic)
        for a in family.axes
    ]
    if family.is_worn:
        pairs = zip(
            (TURNING_ALPHA, TURNING_P), family.rocking_parameters(unit_points), family.rocking_parameters(prior_points), strict=True
        )
        result += [_marginal(name, a, block_weights, b, level, logarithmic=name == TURNING_P) for name, a, b in pairs]
    if lapse.values.size == LAPSE_STEPS:
        result.append(_marginal(LAPSE, lapse.values, lapse_weights, lapse.values, level, logarithmic=False))
    return tuple(result)


def correlations(family: BlockFamily, unit_points: FloatArray, weights: FloatArray) -> tuple[Correlation, ...]:
    """Return the correlation of each pair of parameters; `weights` of the blocks, (n,), sum up to 1."""
    deviations = unit_points - weights @ unit_points
    spread = deviations.T @ (weights[:, None] * deviations)
    widths = np.sqrt(np.diag(spread))
    pairs = itertools.combinations(range(len(family.axes)), 2)
    return tuple(
        Correlation(family.names[i], family.names[j], float(np.clip(spread[i, j] / (widths[i] * widths[j]), -1.0, 1.0))) for i, j in pairs
    )
