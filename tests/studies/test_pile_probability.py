"""In what share of its plausible versions a pile falls, stone by stone, and to which side."""

from dataclasses import replace

import numpy as np
import pytest

from seisblock.bodies.edge_wear import EdgeWear
from seisblock.bodies.pile.edge_wear import widest_wear, worn_to
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.core.errors import BodyError, ParameterError, SolverError
from seisblock.models.stack.options import StackOptions
from seisblock.models.stack.solve import solve_stack
from seisblock.readers import read
from seisblock.records import Motion, motion_of
from seisblock.studies.intervals import clopper_pearson
from seisblock.studies.respond.pile_probability import stack_probability
from seisblock.studies.sampling import (
    AMPLITUDE,
    AZIMUTH,
    HEIGHT,
    INSET,
    STONES,
    WIDTH,
    ParameterVariation,
    sample_motion,
    sample_pile,
)

PILE = Pile("two", (PileStone("lower", 0.5, 0.5, 0.2, mu=0.6), PileStone("upper", 0.2, 0.2, 0.7, offset=(0.02, 0.0), on="lower")), mu=0.5)
PULSE = Motion.from_arrays(3.3 * np.sin(np.linspace(0.0, 2 * np.pi, 101)), 0.01, name="20")
NOTHING_VARIES = ParameterVariation(size=0.0, inset=0.0, mu=0.0, restitution=0.0, amplitude=0.0, azimuth_deg=0.0)


def drawn(**columns):
    """Return one row of draws for two stones: zeros but for the named columns."""
    row = np.zeros(STONES + 2)
    for name, value in columns.items():
        row[{"wide": WIDTH, "tall": HEIGHT, "worn": INSET, "amplitude": AMPLITUDE, "azimuth": AZIMUTH}[name]] = value
    return row


@pytest.fixture(scope="module")
def probability():
    """The answer of sixteen versions, of which some fall and some do not."""
    return stack_probability(PILE, PULSE, runs=16, seed=3, workers=1)


@pytest.mark.parametrize("factor", [0.6, 2.0])
def test_pile_probability_without_variation_equals_outcome(factor):
    """With nothing varied every share is that of the single run, 0 or 1, and the mean fall is its fall."""
    motion = Motion.from_arrays(factor * PULSE.horizontal, PULSE.dt, name="20")
    outcome = solve_stack(PILE, motion).outcome
    answer = stack_probability(PILE, motion, runs=2, versions=NOTHING_VARIES, moved_m=0.002)
    assert answer.overturned == float(outcome.overturned_any)
    for chance, fate in zip(answer.stones, outcome.stones, strict=True):
        assert (chance.name, chance.overturned) == (fate.name, float(fate.state == "fallen"))
        assert chance.moved == float(fate.state == "fallen" or fate.residual_slip_m > 0.002)
        if fate.fell_azimuth_deg is None:
            assert chance.fell_alike_ratio is chance.fell_azimuth_deg is chance.fell_towards_deg is None
        else:
            assert chance.fell_azimuth_deg == pytest.approx(fate.fell_azimuth_deg)
            assert chance.fell_alike_ratio == pytest.approx(1.0)


def test_pile_probability_is_independent_of_thread_count(probability):
    """Versions are drawn before they are handed out; another seed draws others."""
    assert stack_probability(PILE, PULSE, runs=16, seed=3, workers=3) == probability
    assert replace(stack_probability(PILE, PULSE, runs=16, seed=4), seed=3) != probability


def test_pile_shares_are_counts_with_clopper_pearson_interval(probability):
    """The share of any stone is at least that of each, and its interval Clopper and Pearson's."""
    count = round(probability.overturned * probability.runs)
    assert 0 < count < probability.runs
    assert probability.interval == clopper_pearson(count, probability.runs)
    assert probability.overturned >= max(stone.overturned for stone in probability.stones)
    assert probability.moved >= max(stone.moved for stone in probability.stones)
    upper = probability.stones[-1]
    assert upper.interval == clopper_pearson(round(upper.overturned * probability.runs), probability.runs)
    assert upper.overturned > 0.0 and 0.0 < upper.fell_alike_ratio <= 1.0


def test_pile_samples_stay_within_half_widths():
    """Plan and heights change by a factor each, edges by one share, each joint's friction by its own; the pile stands as it did."""
    draws = np.random.default_rng(1).uniform(-1.0, 1.0, (50, STONES + 2))
    changed = [sample_pile(PILE, ParameterVariation(), draw) for draw in draws]
    sizes = np.array([[stone.size for stone in pile.stones] for pile in changed]) / [stone.size for stone in PILE.stones]
    plan, tall = sizes[:, :, :2].reshape(len(changed), -1), sizes[:, :, 2]
    for factors in (plan, tall):
        assert np.ptp(factors, axis=1) == pytest.approx(0.0, abs=1e-12)
        assert np.abs(factors - 1.0).max() <= 0.05 + 1e-12 < np.abs(factors - 1.0).max() + 0.01
    assert abs(np.corrcoef(plan[:, 0], tall[:, 0])[0, 1]) < 0.5
    assert [pile.stones[1].offset[0] for pile in changed] == pytest.approx(0.02 * plan[:, 0])
    rough = np.array([[stone.mu for stone in pile.stones] for pile in changed]) / [0.6, 0.5]
    assert np.abs(rough - 1.0).max() <= 0.2 + 1e-12 < np.abs(rough - 1.0).max() + 0.02
    assert abs(np.corrcoef(rough.T)[0, 1]) < 0.5
    assert all(stone.inset == EdgeWear() for pile in changed for stone in pile.stones)
    worn = PILE.with_wear(0.1)
    wear = np.array([[stone.inset.share for stone in sample_pile(worn, ParameterVariation(), draw).stones] for draw in draws])
    assert (wear[:, 0] == wear[:, 1]).all()
    assert 0.09 <= wear.min() < 0.091 and 0.109 < wear.max() <= 0.11 and np.median(wear) == pytest.approx(0.1, abs=0.003)
    assert all(len(pile.joints()) == len(PILE.joints()) for pile in changed)


def test_sampled_shaking_is_scaled_and_rotated():
    """A version of the shaking is the record's along an azimuth next to it, times a factor; one horizontal alone is never turned."""
    record = read("synthetic_jma.csv")
    draw = drawn(amplitude=0.5, azimuth=0.7)
    rotated = sample_motion(motion_of(record, "30"), ParameterVariation(), draw)
    second = motion_of(record, "37")
    assert np.abs(rotated.acceleration - 1.05 * second.acceleration).max() < 1e-9
    assert rotated.name == "30"
    single = sample_motion(PULSE, ParameterVariation(), draw)
    assert single.horizontal == pytest.approx(1.05 * PULSE.horizontal, rel=1e-12) and not single.transverse.any()


@pytest.mark.parametrize(
    ("invalid", "says"),
    [({"runs": 0}, "number of runs"), ({"runs": 2, "moved_m": 0.0}, "counts as moved must be positive"), ({"runs": 2, "seed": -1}, "seed")],
)
def test_pile_probability_rejects_invalid_options(invalid, says):
    """No runs, no distance, no seed."""
    with pytest.raises(ParameterError, match=says):
        stack_probability(PILE, PULSE, **invalid)


def test_samples_of_a_pile_vary_about_the_inset_of_each_stone():
    """A length grows with the stone and stays a length; sharp stones stay sharp, and something of each base is left."""
    worn = replace(PILE, stones=(PILE.stones[0], replace(PILE.stones[1], inset=EdgeWear(length_m=0.04))))
    for draw in (-1.0, 0.0, 1.0):
        lower, upper = sample_pile(worn, ParameterVariation(size=0.1), drawn(wide=1.0, tall=1.0, worn=draw)).stones
        assert upper.inset.share == 0.0
        assert upper.insets()[0] / upper.width == pytest.approx(0.2 + 0.02 * draw)
        assert lower.insets() == (0.0, 0.0)
    single = Pile("one", (PILE.stones[0],)).with_wear(0.48)
    assert worn_to(single, 0.1, 1.0).stones[0].inset.share == pytest.approx(0.496)
    remaining = sample_pile(worn, replace(NOTHING_VARIES, size=0.1), drawn(wide=1.0, tall=1.0, worn=1.0))
    assert remaining.stones[1].insets()[0] == pytest.approx(1.1 * 0.04)


def test_pile_samples_with_more_wear_fall():
    """Of a worn pile shaken near its limit, samples that are worn more fall, and only these."""
    motion, worn = Motion.from_arrays(0.75 * PULSE.horizontal, PULSE.dt), PILE.with_wear(0.15)
    assert not solve_stack(PILE, motion).outcome.overturned
    assert stack_probability(PILE, motion, runs=8, versions=replace(NOTHING_VARIES, inset=0.9)).overturned == 0.0
    assert 0.0 < stack_probability(worn, motion, runs=8, versions=replace(NOTHING_VARIES, inset=0.9)).overturned < 1.0


def test_contact_grid_varies_no_inset():
    """A grid of contact points has no edges: the result states that no inset was varied."""
    probability = stack_probability(PILE, PULSE, runs=4, options=StackOptions(points=5), versions=ParameterVariation(inset=0.3))
    assert probability.versions.inset == 0.0


def test_sampled_wear_keeps_pile_standing():
    """The wear of a stone loaded near an edge varies by less, which the result states; each sample starts at rest."""
    edgy = Pile("edgy", (PILE.stones[0], replace(PILE.stones[1], offset=(0.23, 0.0)))).with_wear(0.25)
    widest = widest_wear(edgy, 0.9)
    assert 0.1 < widest < 0.8
    still = Motion.from_arrays(np.zeros(100), 0.01)
    assert not solve_stack(worn_to(edgy, widest, 1.0), still).outcome.overturned
    with pytest.raises(BodyError, match="unstable at rest"):
        edgy.with_wear(0.25 * (1.0 + 1.25 * widest + 0.002))
    result = stack_probability(edgy, still, runs=3, versions=ParameterVariation(inset=0.9))
    assert (result.versions.inset, result.overturned) == (widest, 0.0)


@pytest.mark.parametrize("width", [("size", 1.0), ("inset", 1.0), ("mu", -0.1), ("amplitude", 1.0), ("azimuth_deg", 200.0)])
def test_pile_probability_rejects_invalid_half_widths(width):
    """Shares lie below 1, azimuths within half a turn."""
    with pytest.raises(ParameterError, match="spread"):
        ParameterVariation(**dict([width]))


def test_pile_samples_that_create_energy_are_excluded(monkeypatch):
    """One failed sample does not fail the others; where all fail the reason is given."""
    calls = iter(range(8))

    def sometimes(body, motion, **options):
        if next(calls) % 4 == 0:
            raise SolverError("created energy")
        return solve_stack(body, motion, **options)

    monkeypatch.setattr("seisblock.studies.solvers.stack.solve_stack", sometimes)
    result = stack_probability(PILE, PULSE, runs=8, seed=3, workers=1)
    assert (result.runs, result.left_out_count) == (6, 2)
    assert result.interval == clopper_pearson(round(6 * result.overturned), 6)
    calls = iter([0, 4])
    with pytest.raises(SolverError, match="created energy"):
        stack_probability(PILE, PULSE, runs=2, workers=1)


def test_sampled_kinetic_friction_keeps_ratio():
    """A joint that clings more slides less easily by as much, whatever its own friction; nothing is refused."""
    draws = np.random.default_rng(5).uniform(-1.0, 1.0, (40, STONES + 2))
    for draw in draws:
        changed = sample_pile(PILE.with_kinetic_friction(0.45), ParameterVariation(), draw)
        for stone, static in zip(changed.stones, (0.6, 0.5), strict=True):
            clings, slides = changed.friction(stone)
            assert slides / clings == pytest.approx(0.45 / static)
    result = stack_probability(PILE, PULSE, runs=4, options=StackOptions(mu_kinetic=0.2))
    assert result == stack_probability(PILE.with_kinetic_friction(0.2), PULSE, runs=4)
