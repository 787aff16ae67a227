"""Shaking read back from fallen stones: what was put in is found, as often as is claimed ([Furukawa2009]_ eqs. (9), (10) backwards)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import norm

from seisblock.bodies.cemetery.cemetery import Cemetery, Stone
from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.core.errors import BodyError, ParameterError
from seisblock.criteria.gravestones import overturning_level
from seisblock.criteria.intensity import intensity_from_velocity
from seisblock.measures import jma_class
from seisblock.studies.survey.assumptions import FREQUENCY_ERROR, Assumptions, make_assumptions
from seisblock.studies.survey.estimate import (
    ALL_STONES,
    DOWELLED_STONES,
    PLAIN_STONES,
    estimate_shaking,
    fitted_stones,
    frequency_contour,
    stone_groups,
)
from seisblock.studies.survey.likelihood import (
    BIAS,
    COMMON_ERROR,
    STONE_ERROR,
    counted_survey,
    likelihood,
    log_likelihood,
    marked_survey,
    parse_rate,
)
from seisblock.studies.survey.limits import fitted_limits, rigid_limits
from seisblock.studies.survey.stones import count_agreement
from tests.lengths import all_but_slow

AOYAMA = read_cemetery("aoyama.csv")
SHARP = Assumptions(stone_error=0.02, bias=0.0, frequency_error=0.0)
PLAIN_FREQUENCY = Assumptions(frequency_error=0.0)
PLAIN = Assumptions(bias=0.0, frequency_error=0.0)
"""The criterion as printed, at a frequency that is known."""


def mark_stones(cemetery: Cemetery, falls) -> Cemetery:
    """Return a cemetery whose stones are marked."""
    return replace(cemetery, stones=tuple(replace(s, fallen=bool(f)) for s, f in zip(cemetery.stones, falls, strict=True)))


def simulate_falls(rng, cemetery: Cemetery, pga: float, frequency: float) -> np.ndarray:
    """Return which stones fall when the errors of the model are drawn at random."""
    common = rng.normal(0.0, COMMON_ERROR)
    body_value = rng.normal(0.0, STONE_ERROR, cemetery.size)
    return np.log(pga) - BIAS + common + body_value > np.log(fitted_limits(cemetery, frequency))


def contains(estimate, truth: float) -> bool:
    """Return whether the interval, or the bound, holds the truth."""
    low, high = estimate.pga_interval_m_s2
    return (low is None or low <= truth) and (high is None or truth <= high)


def coverage_of_200(form: str, seed: int) -> float:
    """Return the share of 200 simulated surveys whose 90 % interval holds the PGA behind them, which overturns 5 to 90 % on average."""
    rng, holding = np.random.default_rng(seed), 0
    for _ in range(200):
        frequency = float(rng.uniform(0.5, 3.0))
        truth = float(np.exp(BIAS + rng.uniform(np.log(0.25), np.log(0.45))) * overturning_level(frequency))
        text = frequency * float(np.exp(rng.normal(0.0, FREQUENCY_ERROR)))
        if form == "counted":
            place = Cemetery(tuple(AOYAMA.stones[i] for i in rng.integers(0, 100, 60)))
            survey = counted_survey(AOYAMA, int(simulate_falls(rng, place, truth, frequency).sum()), 60)
        else:
            survey = marked_survey(mark_stones(AOYAMA, simulate_falls(rng, AOYAMA, truth, frequency)))
        holding += contains(estimate_shaking(survey, text), truth)
    return holding / 200


@pytest.mark.parametrize("form", all_but_slow(["stone by stone", "counted"], {"stone by stone"}))
def test_shaking_interval_has_nominal_coverage(form):
    """Of 200 simulated surveys the 90 % interval holds the truth in 85 to 95 %; where none or all fell the bound counts."""
    assert 0.85 <= coverage_of_200(form, 20001006) <= 0.95


def test_exact_survey_recovers_threshold():
    """Stones that fall above one H/B and stand below give the PGA of that H/B, and its PGV, when stones have little error of their own."""
    falls = AOYAMA.ratios > 2.84
    estimate = estimate_shaking(marked_survey(mark_stones(AOYAMA, falls)), 2.75, SHARP)
    assert estimate.threshold_ratio == pytest.approx(2.84, rel=0.02)
    assert estimate.pga_m_s2 == pytest.approx(float(overturning_level(2.75)) / 2.84, rel=0.02)
    assert estimate.pgv_m_s == pytest.approx(estimate.pga_m_s2 / (2 * np.pi * 2.75))
    assert (estimate.fallen, estimate.standing, estimate.bound) == (35, 65, None)


def test_interval_includes_common_error():
    """However many stones are counted, the interval stays as wide as the error common to the cemetery: 1.645 times 0.3 in ln PGA."""
    low, high = estimate_shaking(counted_survey(AOYAMA, 35_000, 100_000), 2.0, PLAIN).pga_interval_m_s2
    assert np.log(high / low) == pytest.approx(2 * 1.6449 * COMMON_ERROR, rel=2e-3)
    wider = estimate_shaking(counted_survey(AOYAMA, 7, 20), 2.0, PLAIN).pga_interval_m_s2
    assert wider[1] / wider[0] > high / low


def test_pga_contour_follows_eq_8():
    """A survey pins PGA/a(f): along the contour PGA follows eq. (8), and the threshold H/B stays."""
    estimate = frequency_contour(counted_survey(AOYAMA, 35, 100), PLAIN)
    level = [e.pga_m_s2 / float(overturning_level(e.frequency_hz)) for e in estimate]
    np.testing.assert_allclose(level, level[0], rtol=1e-6)
    np.testing.assert_allclose([e.threshold_ratio for e in estimate], estimate[0].threshold_ratio, rtol=1e-6)


def test_estimate_without_frequency_averages_band():
    """The interval over 0.5 to 3 Hz is wider than at any frequency in it, and reaches neither beyond its lowest nor its highest."""
    survey = counted_survey(AOYAMA, 35, 100)
    full, ends = estimate_shaking(survey).pga_interval_m_s2, [e.pga_interval_m_s2 for e in frequency_contour(survey, PLAIN_FREQUENCY)]
    assert full[0] > min(low for low, _ in ends)
    assert full[1] < max(high for _, high in ends)
    assert full[1] / full[0] > max(high / low for low, high in ends)
    assert estimate_shaking(survey).threshold_ratio is None


def test_none_or_all_fallen_gives_bound():
    """Without a fallen stone there is an upper bound with the probability of one tail; with all fallen a lower one."""
    survey = marked_survey(mark_stones(AOYAMA, np.zeros(100)))
    none = estimate_shaking(survey, 2.0, PLAIN_FREQUENCY)
    assert none.bound == "upper"
    assert none.pga_m_s2 is None
    assert none.pga_interval_m_s2[0] is None
    rng, bound = np.random.default_rng(1), none.pga_interval_m_s2[1]
    values = np.mean([not simulate_falls(rng, AOYAMA, bound, 2.0).any() for _ in range(4000)])
    assert values == pytest.approx(0.05, abs=0.015)
    all_cases = estimate_shaking(marked_survey(mark_stones(AOYAMA, np.ones(100))), 2.0)
    assert all_cases.bound == "lower"
    assert all_cases.pga_interval_m_s2[1] is None
    assert all_cases.pga_interval_m_s2[0] > bound
    assert all_cases.jma_classes[1] is None


def test_reinforced_stones_are_estimated_separately():
    """Stones of each kind are judged by their own criterion, apart and together."""
    f, pga = 1.5, 4.5
    mixed = Cemetery(tuple(replace(s, reinforced=i % 2 == 0) for i, s in enumerate(AOYAMA.stones)))
    survey = marked_survey(mark_stones(mixed, pga > fitted_limits(mixed, f)))
    estimate = {name: estimate_shaking(part, f, SHARP, stones=name) for name, part in stone_groups(survey)}
    assert list(estimate) == [PLAIN_STONES, DOWELLED_STONES, ALL_STONES]
    assert [estimate[name].fallen + estimate[name].standing for name in estimate] == [50, 50, 100]
    for item in estimate.values():
        assert item.pga_m_s2 == pytest.approx(pga, rel=0.05)
    assert estimate[DOWELLED_STONES].threshold_ratio > 1.3 * estimate[PLAIN_STONES].threshold_ratio


def test_unmarked_stones_are_ignored():
    """A stone of unknown fate changes nothing; rows that stand for several count as often."""
    expected = Cemetery((Stone(3.0, fallen=True, count=3), Stone(2.0, fallen=False)))
    spread = Cemetery((*([Stone(3.0, fallen=True)] * 3), Stone(2.0, fallen=False), Stone(5.0)))
    first, second = estimate_shaking(marked_survey(expected), 1.0), estimate_shaking(marked_survey(spread), 1.0)
    assert first.pga_interval_m_s2 == pytest.approx(second.pga_interval_m_s2, rel=1e-9)
    assert (second.fallen, second.standing) == (3, 1)


@pytest.mark.parametrize("limits", all_but_slow([fitted_limits, rigid_limits], {fitted_limits}))
def test_likelihood_equals_quadrature_over_common_error(limits):
    """The convolution agrees with adaptive quadrature, at whatever frequency it was asked for before."""
    from scipy.integrate import quad

    survey = marked_survey(mark_stones(AOYAMA, AOYAMA.ratios > 2.84))
    likelihood(survey, 0.6, bias=0.0, limits=limits)
    result = likelihood(survey, 2.0, bias=0.0, limits=limits)
    around = np.log([4.2, 4.8] if limits is fitted_limits else [6.3, 7.2])
    probe = result.log_pga[np.searchsorted(result.log_pga, around)]

    def integrand(error: float, at: float) -> float:
        weight = np.exp(-0.5 * (error / COMMON_ERROR) ** 2) / (COMMON_ERROR * np.sqrt(2 * np.pi))
        return float(weight * np.exp(log_likelihood(survey, np.array([at + error]), 2.0, STONE_ERROR, limits)[0] + 10.0))

    direct = [quad(integrand, -1.5, 1.5, args=(at,), points=[0.0], limit=400, epsabs=0.0, epsrel=1e-8)[0] for at in probe]
    ratio = result.interpolate(probe)
    assert ratio[1] / ratio[0] == pytest.approx(direct[1] / direct[0], rel=1e-8)


def test_jma_intensity_of_rigid_criterion_follows_pgv():
    """The JMA intensity is that of the median PGV; its interval is wider than the PGV's alone, its classes are those of its ends."""
    estimate = estimate_shaking(counted_survey(AOYAMA, 35, 100), 1.0, make_assumptions(None, limits=rigid_limits, bias=0.0))
    low, high = estimate.jma_intensity_interval
    assert estimate.jma_intensity == pytest.approx(intensity_from_velocity(estimate.pgv_m_s))
    assert low < intensity_from_velocity(estimate.pgv_interval_m_s[0])
    assert high > intensity_from_velocity(estimate.pgv_interval_m_s[1])
    assert estimate.jma_classes == (jma_class(low), jma_class(high))


@pytest.mark.parametrize(("fallen", "by_rule", "classes"), [(30, None, ("5+", "6-", "6+")), (52, "6+", ("6+",)), (93, "7", ("7",))])
def test_jma_intensity_of_stones_agrees_with_surveyors_rule(fallen, by_rule, classes):
    """40 % mean 6 upper, 90 % mean 7; the published rates of Koiwagawa, 52 and 93 %, lie in the class published for them."""
    for frequency in (None, 0.5, 1.0, 3.0):
        estimate = estimate_shaking(counted_survey(AOYAMA, fallen, 100), frequency)
        assert estimate.jma_class_by_rule == by_rule
        assert jma_class(estimate.jma_intensity) in classes
        assert 0.5 < estimate.jma_intensity_interval[1] - estimate.jma_intensity_interval[0] < 0.9


def test_jma_intensity_of_stones_equals_direct_posterior():
    """The posterior of the intensity by summation over a grid of intensity and common error, without the program's convolution."""
    estimate = estimate_shaking(counted_survey(AOYAMA, 52, 100))
    k = 2.0 / np.log(10.0)
    intensity, error = np.linspace(4.5, 8.0, 351), np.linspace(-1.0, 1.0, 201)
    levels = (intensity[:, None] + error[None, :] - 6.97) / k
    rate = norm.cdf((levels[:, :, None] + np.log(AOYAMA.ratios)) / 0.2).mean(axis=2)
    posterior = (rate**52 * (1.0 - rate) ** 48 * norm.pdf(error / 0.2)).sum(axis=1)
    shares = np.cumsum(posterior) / posterior.sum()
    low, middle, high = np.interp([0.05, 0.5, 0.95], shares, intensity)
    assert estimate.jma_intensity == pytest.approx(middle, abs=0.01)
    assert estimate.jma_intensity_interval == pytest.approx((low, high), abs=0.01)


def test_fitted_stones_match_a_survey_that_follows_the_criterion():
    """Stones drawn from the criterion with its scatter: their probabilities add up to the falls, and most outcomes are reproduced."""
    rng = np.random.default_rng(7)
    fell = np.log(AOYAMA.ratios / 2.7) + rng.normal(0.0, STONE_ERROR, AOYAMA.size) > 0.0
    marked = replace(AOYAMA, stones=tuple(replace(s, fallen=bool(f)) for s, f in zip(AOYAMA.stones, fell, strict=True)))
    stones = fitted_stones(marked_survey(marked), 1.5)
    counts = count_agreement(stones)
    assert sum(stone.probability for stone in stones) == pytest.approx(fell.sum(), abs=2.0)
    assert counts.stones == 100 and counts.agreement > 0.75
    assert counts.both + counts.observed_only == fell.sum()
    assert all((stone.probability >= 0.5) == stone.overturns for stone in stones)
    assert all(stone.agrees == (stone.overturns == stone.observed) for stone in stones)
    assert count_agreement(fitted_stones(counted_survey(marked, 35, 100), 1.5)) is None


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda: marked_survey(AOYAMA), BodyError, "no stone is marked overturned or standing"),
        (lambda: counted_survey(AOYAMA, 5, 4), ParameterError, "0 <= fallen <= stones"),
        (lambda: counted_survey(AOYAMA, 0, 0), ParameterError, "at least one stone"),
        (lambda: parse_rate("35%"), ParameterError, "give both numbers"),
        (lambda: parse_rate("0.35"), ParameterError, "give both numbers"),
        (lambda: estimate_shaking(counted_survey(AOYAMA, 3, 4), 0.0), ParameterError, "frequency must be positive"),
        (lambda: estimate_shaking(counted_survey(AOYAMA, 3, 4), 1.0, Assumptions(common_error=0.0)), ParameterError, "common_error"),
        (lambda: Assumptions(level=90.0), ParameterError, r"level of the intervals must lie in \(0, 1\)"),
        (lambda: intensity_from_velocity(0.0), ParameterError, "peak velocity must be positive"),
    ],
)
def test_estimate_rejects_invalid_surveys(call, error, message):
    """Surveys that say nothing, counts that make no rate, numbers out of range: one sentence."""
    with pytest.raises(error, match=message):
        call()
