"""Margin and perturbation: factors at which the verdict changes, and its frequency under small changes."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from seisblock.bodies.block import Block, from_slenderness, scale_block
from seisblock.bodies.kinds import of_kind
from seisblock.core.errors import ParameterError
from seisblock.core.units import STANDARD_GRAVITY as G
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.solve import solve_rock
from seisblock.models.rock.verdicts import rock_verdict
from seisblock.records import Motion
from seisblock.studies.parallel import MAX_PENDING, map_threads
from seisblock.studies.rocking.margin import find_margin, flag_near_flip, nearest_flip
from seisblock.studies.rocking.perturb import perturb
from seisblock.studies.sampling import ParameterVariation

ALPHA, P = 0.25, 2.14
BLOCK = from_slenderness(ALPHA, P)


def one_sine(x, samples=400):
    """Return a full sine of amplitude x alpha g and frequency 5 p."""
    k = np.arange(2 * samples + 2)
    shape = np.where(k < 2 * samples, np.sin(np.pi * k / samples), 0.0)
    return Motion.from_arrays(x * G * ALPHA * shape, math.pi / (5 * P) / samples)


def test_margin_finds_every_window_of_one_sine():
    """[Zhang2001]_: safe to 3.019, unsafe to 6.318, safe to 7.168, unsafe above; scaled from X = 4."""
    margin = find_margin(BLOCK, one_sine(4.0), options=RockOptions(restitution=0.9, linear=True))
    assert [window.overturned for window in margin.windows] == [False, True, False, True]
    np.testing.assert_allclose(np.array(margin.flips) * 4, [3.019, 6.318, 7.168], atol=1e-3)
    assert margin.overturned is True
    assert margin.nearest_flip == margin.flips[0]
    assert margin.windows[0].first == 0
    assert margin.windows[-1].last == margin.limit == 3.0
    assert all(single.last == second.first for single, second in pairwise(margin.windows))


def test_outcomes_differ_on_both_sides_of_each_flip():
    """Just below and just above each factor the verdicts differ."""
    motion = one_sine(4.0)
    for flip in find_margin(BLOCK, motion, options=RockOptions(restitution=0.9)).flips:
        below, above = (
            rock_verdict(BLOCK, motion, scale=flip * (1 + e), options=RockOptions(restitution=0.9)).overturned for e in (-1e-5, 1e-5)
        )
        assert below != above


def test_margin_reports_first_fall_and_share_above():
    """The boundary is fractal: the margin names the first fall that it found, and the share of factors above at which it falls (N11)."""
    margin = find_margin(BLOCK, one_sine(4.0), options=RockOptions(restitution=0.9, linear=True))
    assert margin.first_fall == margin.flips[0]
    assert margin.first_fall * 4 == pytest.approx(3.019, abs=1e-3)
    falls = (6.318 - 3.019 + 12.0 - 7.168) / (12.0 - 3.019)
    assert margin.falls_above_first == pytest.approx(falls, abs=2e-3)


def test_margin_of_stable_block_has_one_window():
    """No flip, no nearest flip, no first fall."""
    margin = find_margin(BLOCK, Motion.from_arrays(0.01 * np.ones(50), 0.01))
    assert margin.flips == ()
    assert margin.nearest_flip is margin.first_fall is margin.falls_above_first is None
    assert len(margin.windows) == 1


def test_outcome_within_2_percent_of_flip_is_flagged():
    """Within 2 % of a change of the result the response warns; further away it does not; without a search the field is None."""
    for x, fragile in ((3.019 * 1.015, True), (3.019 * 0.985, True), (3.019 * 1.05, False)):
        motion = one_sine(x)
        response = solve_rock(BLOCK, motion, restitution=0.9, linear=True)
        assert response.outcome.verdict_flips_within_2_percent is None
        message = flag_near_flip(response)
        assert (
            message.outcome.verdict_flips_within_2_percent
            is (nearest_flip(BLOCK, motion, options=RockOptions(restitution=0.9, linear=True)) is not None)
            is fragile
        )
        assert any("sensitive to the amplitude" in text for text in message.warnings) is fragile
        factor = message.outcome.flips_at_factor
        assert (factor is not None) is fragile
        if fragile:
            second = solve_rock(BLOCK, one_sine(x * factor), restitution=0.9, linear=True).outcome
            nearer = solve_rock(BLOCK, one_sine(x * (factor + math.copysign(0.001, 1.0 - factor))), restitution=0.9, linear=True).outcome
            assert second.overturned is not response.outcome.overturned
            assert nearer.overturned is response.outcome.overturned


def test_margin_includes_flips_near_factor_one():
    """However coarse the scan, what a look at 2 % finds is among its windows, and the share is that of the even factors."""
    x = 3.019 * 0.985
    nearby = nearest_flip(BLOCK, one_sine(x), options=RockOptions(restitution=0.9, linear=True))
    margin = find_margin(BLOCK, one_sine(x), step=0.75, limit=1.5, options=RockOptions(restitution=0.9, linear=True))
    assert nearby is not None and any(window.overturned and window.first <= nearby <= window.last for window in margin.windows)
    assert margin.first_fall == pytest.approx(nearby, abs=0.001)
    assert margin.falls_above_first == 1.0


@pytest.mark.parametrize(("limit", "step"), [(0.0, 0.1), (-1.0, 0.1), (1.0, 2.0), (math.inf, 0.1), (math.nan, 0.1)])
def test_margin_rejects_invalid_scan(limit, step):
    """The scan needs 0 < step <= limit."""
    with pytest.raises(ParameterError, match="0 < `step` <= `limit`"):
        find_margin(BLOCK, one_sine(1.0), limit=limit, step=step)


def test_perturb_far_from_flip_is_certain():
    """The interval shows the sampling uncertainty where all or none of the runs overturn."""
    narrow = ParameterVariation(restitution=0.05, amplitude=0.05)
    sure = perturb(BLOCK, one_sine(4.5), 60, options=RockOptions(restitution=0.9), spread=narrow)
    assert (sure.overturned, sure.probability, sure.probability_interval[1]) == (60, 1.0, 1.0)
    assert 0.9 < sure.probability_interval[0] < 1.0
    never = perturb(BLOCK, one_sine(1.5), 60, options=RockOptions(restitution=0.9))
    assert (never.overturned, never.probability_interval[0]) == (0, 0.0)


def test_perturb_at_flip_gives_one_half():
    """With the amplitude alone changing, half of the runs lie on each side of a flip."""
    flip = find_margin(BLOCK, one_sine(3.0), options=RockOptions(restitution=0.9)).flips[0]
    only = ParameterVariation(size=0.0, slenderness=0.0, restitution=0.0, amplitude=0.02, azimuth_deg=0.0, inset=0.0)
    result = perturb(BLOCK, one_sine(3.0 * flip), 400, options=RockOptions(restitution=0.9), spread=only)
    assert result.probability_interval[0] < 0.5 < result.probability_interval[1]


@pytest.mark.parametrize(("above", "share"), [(0.01, 0.25), (-0.01, 0.75), (0.021, 0.0), (-0.021, 1.0)])
def test_perturb_amplitudes_are_uniform(above, share):
    """Amplitudes within 2 % lie evenly: a quarter of them beyond a flip 1 % above the middle, none beyond one at 2.1 %."""
    flip = find_margin(BLOCK, one_sine(3.0), options=RockOptions(restitution=0.9)).flips[0]
    only = ParameterVariation(size=0.0, slenderness=0.0, restitution=0.0, amplitude=0.02, azimuth_deg=0.0, inset=0.0)
    result = perturb(BLOCK, one_sine(3.0 * flip / (1.0 + above)), 2000, options=RockOptions(restitution=0.9), spread=only)
    # 2000 draws scatter by 0.0097 about a quarter; normal ones would leave 0.31 there, and 0.16 beyond the half width
    assert result.probability == pytest.approx(share, abs=0.03 if 0.0 < share < 1.0 else 0.0)


def test_perturb_states_what_its_interval_covers():
    """The share is that of the samples of the model, not the probability of the stone, and is stated as such (N12)."""
    assert perturb(BLOCK, one_sine(3.0), 5).interval_of == "parameter variation only"


def test_perturb_draws_unmeasured_edges_from_the_range_of_the_kind():
    """With nothing else changing, a stone that falls only when it is worn by more than half of that falls in half of the runs."""
    motion, stone = one_sine(2.8), of_kind(BLOCK, "gravestone")
    only = ParameterVariation(size=0.0, slenderness=0.0, restitution=0.0, amplitude=0.0, azimuth_deg=0.0)
    share = next(
        x
        for x in np.linspace(0.0, 0.1, 401)
        if rock_verdict(BLOCK.with_wear(float(x)), motion, options=RockOptions(restitution=0.9)).overturned
    )
    assert 0.01 < share < 0.09
    result = perturb(stone, motion, 400, options=RockOptions(restitution=0.9), spread=only)
    low, high = result.probability_interval
    assert low < 1.0 - share / 0.1 < high and result.ranges == stone.ranges
    exact = replace(only, inset=0.0)
    assert perturb(stone, motion, 5, options=RockOptions(restitution=0.9), spread=exact).overturned == 5 * (share < 0.05)


def test_perturb_varies_a_known_inset_by_a_share_of_itself():
    """Sharp edges stay sharp; an inset just beyond that at which the stone falls falls in half of the runs."""
    motion = one_sine(2.8)
    only = ParameterVariation(size=0.0, slenderness=0.0, restitution=0.0, amplitude=0.0, azimuth_deg=0.0)
    assert perturb(BLOCK, motion, 5, options=RockOptions(restitution=0.9), spread=only).overturned == 0
    share = next(
        x
        for x in np.linspace(0.0, 0.1, 4001)
        if rock_verdict(BLOCK.with_wear(float(x)), motion, options=RockOptions(restitution=0.9)).overturned
    )
    low, high = perturb(BLOCK.with_wear(float(share)), motion, 400, options=RockOptions(restitution=0.9), spread=only).probability_interval
    assert low < 0.5 < high
    assert (
        perturb(
            BLOCK.with_wear(1.11 * share), motion, 50, options=RockOptions(restitution=0.9), spread=replace(only, inset=0.05)
        ).overturned
        == 50
    )


def test_perturb_is_reproducible_by_seed():
    """The seed decides."""
    motion = one_sine(3.0)
    assert perturb(BLOCK, motion, 50, seed=7) == perturb(BLOCK, motion, 50, seed=7)
    assert perturb(BLOCK, motion, 50, seed=7).overturned != perturb(BLOCK, motion, 50, seed=8).overturned


def test_resized_block_keeps_its_shape():
    """Size multiplies all lengths, slenderness those along the motion: alpha and p follow."""
    block = Block(0.4, 1.2, centroid_offset=0.03, centroid_height=0.5, centroid_inertia=40.0, mass=300.0)
    double = scale_block(block, size=2.0)
    assert double.slendernesses == pytest.approx(block.slendernesses)
    assert double.frequency_parameter() == pytest.approx(block.frequency_parameter() / math.sqrt(2))
    wider = scale_block(block, slenderness=1.1)
    assert math.tan(wider.slenderness) == pytest.approx(1.1 * math.tan(block.slenderness))


@pytest.mark.parametrize("spread", [{"size": 1.0}, {"amplitude": -0.1}, {"slenderness": math.nan}, {"azimuth_deg": 200.0}, {"inset": 1.0}])
def test_perturb_rejects_invalid_spreads(spread):
    """Shares lie in [0, 1), degrees in [0, 180]."""
    with pytest.raises(ParameterError, match="spread"):
        ParameterVariation(**spread)


def test_perturb_rejects_zero_runs():
    """At least one."""
    with pytest.raises(ParameterError, match="an integer of at least 1, found 0"):
        perturb(BLOCK, one_sine(1.0), 0)


def test_map_threads_keeps_order_and_raises():
    """Answers come in the order of the items, also of more than are under way at a time, and an error of one run reaches the caller."""
    items = list(range(2 * MAX_PENDING + 7))
    assert list(map_threads(lambda i: i * i, items)) == [i * i for i in items]
    with pytest.raises(ZeroDivisionError):
        list(map_threads(lambda i: 1 // (i - 3), items))
