r"""Annual frequency of a limit state at a site, and update of hazard branches by non-occurrence.

With the fragility :math:`F(x) = \Phi(\ln(x/\theta)/\beta)` and the annual frequency :math:`\lambda(x)` of exceeding the intensity x, the
limit state occurs with the frequency

.. math:: \Lambda = \int_0^\infty F \, |d\lambda| = \int_0^\infty \lambda \, dF ,

the mean of the hazard over the distribution of the capacity. On a piece on which :math:`\lambda = \lambda_a (x/x_a)^{-k}`, with
:math:`u = \ln x`, :math:`\mu = \ln\theta` and :math:`z = (u - \mu)/\beta`, the integral of the second form is (derived here, by completing
the square)

.. math:: \int_{u_1}^{u_2} \lambda \, dF
   = \lambda_a e^{-k(\mu - u_a) + k^2\beta^2/2} \left[ \Phi(z_2 + k\beta) - \Phi(z_1 + k\beta) \right] ,

and :math:`\int F |d\lambda| = F_1\lambda_1 - F_2\lambda_2 + \int \lambda \, dF` there: no quadrature. One piece from zero to infinity is
the closed form :math:`\lambda(\theta) \, e^{k^2\beta^2/2}` ([Cornell2002]_ relation of limit state and hazard). The
probability of no occurrence in T years is :math:`e^{-T\Lambda}` for Poissonian earthquakes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seisblock.core import checks
from seisblock.core._display import DisplayMixin
from seisblock.core.i18n import lazy_gettext
from seisblock.core.typing import FloatArray
from seisblock.studies.fragility.lognormal import Lognormal
from seisblock.studies.hazard.curve import Hazard, HazardCurve

MAX_MEDIAN_RATIO = 10.0
"""Largest ratio of a median to the range of hazard levels without a warning; wrong units (gal, cm/s) give 100."""

MAX_EXTRAPOLATED_SHARE = 0.02
"""Largest share of the frequency from beyond the hazard levels without a warning."""


@dataclass(frozen=True)
class ProbabilityInYears:
    """Probability of at least one occurrence.

    Parameters
    ----------
    years : float, years
    value : float, 1
        1 - exp(-rate x years).
    """

    years: float
    value: float


@dataclass(frozen=True)
class RiskShare:
    """Contribution of an intensity interval.

    Parameters
    ----------
    im_from, im_to : float or None
        In the unit of the hazard; None for zero and for infinity.
    annual_rate : float, 1/year
    share : float, 1
        Of the whole.
    """

    im_from: float | None
    im_to: float | None
    annual_rate: float
    share: float


@dataclass(frozen=True)
class BranchRisk:
    """Risk of one hazard branch.

    Parameters
    ----------
    branch : str
    weight : float, 1
    annual_rate : float, 1/year
    standing : float or None, 1
        Probability of non-occurrence in the observed period; None without one.
    weight_after : float or None, 1
        Posterior weight of the branch.
    """

    branch: str
    weight: float
    annual_rate: float
    standing: float | None
    weight_after: float | None


@dataclass(frozen=True, repr=False)
class Risk(DisplayMixin):
    """Annual frequency of a limit state at a site.

    Parameters
    ----------
    fragility : Lognormal
    hazard : Hazard
    annual_rate : float, 1/year
        The mean over the branches.
    return_period_years : float or None
        Its inverse; None for a rate of zero.
    probability : ProbabilityInYears
        Of the mean over the branches.
    branches : tuple of BranchRisk
    disaggregation : tuple of RiskShare
        Between the levels of the hazard, of all branches together.
    beyond_levels_share : float, 1
        Share of the frequency from extrapolation below the first and beyond the last level.
    stood_years : float or None
    annual_rate_after : float or None, 1/year
        With the posterior weights.
    notes : tuple of str
    """

    fragility: Lognormal
    hazard: Hazard
    annual_rate: float
    return_period_years: float | None
    probability: ProbabilityInYears
    branches: tuple[BranchRisk, ...]
    disaggregation: tuple[RiskShare, ...]
    beyond_levels_share: float
    stood_years: float | None
    annual_rate_after: float | None
    notes: tuple[str, ...]


def find_risk(fragility: Lognormal, hazard: Hazard, *, years: float = 50.0, stood_years: float | None = None) -> Risk:
    """Return the annual frequency at a site with its disaggregation by level and branch.

    Parameters
    ----------
    fragility : Lognormal
        In the unit of the hazard.
    hazard : Hazard
    years : float, years
        Period of the probability.
    stood_years : float or None, years
        Observed period without occurrence; updates the weights of the branches.

    Returns
    -------
    Risk

    Raises
    ------
    ParameterError
        If a number of years is not positive.

    Examples
    --------
    >>> from seisblock.fragility import Hazard, HazardCurve, Lognormal, find_risk
    >>> hazard = Hazard("pgv", "m/s", (HazardCurve([0.1, 1.0], [1e-2, 1e-4]),))
    >>> round(find_risk(Lognormal(0.5, 0.4), hazard).annual_rate, 7)  # 1e-4 x 0.5^-2 x exp(2^2 x 0.4^2 / 2)
    0.0005509
    """
    checks.positive("the number of years", years)
    if stood_years is not None:
        checks.positive("the number of years without occurrence", stood_years)
    # a common set of levels makes the shares of the branches comparable; a power law is unchanged by further levels
    union = np.unique(np.concatenate([np.asarray(branch.levels) for branch in hazard.branches]))
    shares = [_contributions(branch.with_levels(union), fragility) for branch in hazard.branches]
    weights = np.array([branch.weight for branch in hazard.branches])
    weights /= weights.sum()
    rates = np.array([row.sum() for row in shares])
    total = float(weights @ rates)
    # extrapolation beyond the levels of each branch itself, not of all branches together
    outside_rate = float(weights @ [_contributions(branch, fragility)[[0, -1]].sum() for branch in hazard.branches])
    # Poisson process: probability of no event in the observed period
    no_event_probability = None if stood_years is None else np.exp(-rates * stood_years)
    posterior_weights = None if stood_years is None else _posterior_weights(weights, -rates * stood_years)
    return Risk(
        fragility=fragility,
        hazard=hazard,
        annual_rate=total,
        return_period_years=1.0 / total if total > 1.0 / checks.MAX_MAGNITUDE else None,
        # expm1 keeps the digits of small probabilities
        probability=ProbabilityInYears(float(years), -math.expm1(-total * years)),
        branches=tuple(
            BranchRisk(
                branch.name,
                float(weights[i]),
                float(rates[i]),
                None if no_event_probability is None else float(no_event_probability[i]),
                None if posterior_weights is None else float(posterior_weights[i]),
            )
            for i, branch in enumerate(hazard.branches)
        ),
        disaggregation=_disaggregate(union, weights @ np.array(shares), total),
        beyond_levels_share=outside_rate / total if total > 0.0 else 0.0,
        stood_years=None if stood_years is None else float(stood_years),
        annual_rate_after=None if posterior_weights is None else float(posterior_weights @ rates),
        notes=(*hazard.notes, *(_median_warnings(fragility, hazard, union) or _extrapolation_warnings(outside_rate, total))),
    )


def _contributions(curve: HazardCurve, fragility: Lognormal) -> FloatArray:
    """Return the annual frequency, 1/year, below the first level, between levels and beyond the last, (n + 1,)."""
    from scipy.special import ndtr

    u, mu, beta = np.log(np.asarray(curve.levels)), math.log(fragility.median), fragility.beta
    # the slope of an interval starts at its lower level; the first one, below all levels, at the lowest
    k, anchor = curve.slopes, np.maximum(np.arange(u.size + 1) - 1, 0)
    z = np.concatenate([[-np.inf], (u - mu) / beta, [np.inf]])
    # power law times lognormal density: completing the square shifts the argument of Phi by k beta and leaves the
    # factor exp((k beta)^2 / 2)
    logs = np.log(np.asarray(curve.rates))[anchor] - k * (mu - u[anchor]) + 0.5 * (k * beta) ** 2
    inside = np.exp(logs + _log_between(z[:-1] + k * beta, z[1:] + k * beta))
    # integration by parts: the share of an interval of intensity is the integral of lambda dP less the change of P
    # lambda
    edge = np.concatenate([[0.0], ndtr(z[1:-1]) * np.asarray(curve.rates), [0.0]])
    # round-off may leave a tiny negative share
    return np.asarray(np.maximum(inside - np.diff(edge), 0.0))


def _log_between(low: FloatArray, high: FloatArray) -> FloatArray:
    """Return ln(Phi(high) - Phi(low)), accurate in both tails."""
    from scipy.special import log_ndtr

    # differences of Phi near 1 lose all digits: mirror intervals in the upper tail to the lower one
    right = low + high > 0.0
    a, b = np.where(right, -high, low), np.where(right, -low, high)
    top = log_ndtr(b)
    with np.errstate(divide="ignore"):
        return np.asarray(top + np.log1p(-np.exp(log_ndtr(a) - top)))


def _posterior_weights(weights: FloatArray, log_likelihood: FloatArray) -> FloatArray:
    """Return the branch weights updated by the log-likelihoods."""
    # the largest exponent is subtracted, so that long periods do not underflow
    scaled_weights = weights * np.exp(log_likelihood - log_likelihood.max())
    return np.asarray(scaled_weights / scaled_weights.sum())


def _disaggregate(levels: FloatArray, rates: FloatArray, total: float) -> tuple[RiskShare, ...]:
    ends = [None, *(float(level) for level in levels), None]
    return tuple(
        RiskShare(low, high, float(rate), float(rate) / total if total > 0.0 else 0.0)
        for low, high, rate in zip(ends[:-1], ends[1:], rates, strict=True)
    )


def _median_warnings(fragility: Lognormal, hazard: Hazard, levels: FloatArray) -> tuple[str, ...]:
    lowest, highest = float(levels[0]), float(levels[-1])
    if lowest / MAX_MEDIAN_RATIO <= fragility.median <= MAX_MEDIAN_RATIO * highest:
        return ()
    text = "the median {median:.4g} {unit} is far from all levels of the hazard ({least:.4g} to {most:.4g} {unit}); check its unit"
    return (lazy_gettext(text, median=fragility.median, unit=hazard.unit, least=lowest, most=highest),)


def _extrapolation_warnings(outside_rate: float, total: float) -> tuple[str, ...]:
    if outside_rate <= MAX_EXTRAPOLATED_SHARE * total:
        return ()
    return (
        lazy_gettext(
            "{share:.0%} of the frequency comes from beyond the levels of the hazard (extrapolated with the end slopes); add levels",
            share=outside_rate / total,
        ),
    )
