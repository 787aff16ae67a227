"""Fits of a known block, and of outcomes with little information."""

from dataclasses import replace

import numpy as np
import pytest

from seisblock import Block
from seisblock.bodies import from_slenderness
from seisblock.bodies.edge_wear import EdgeWear
from seisblock.errors import KindError, ParameterError
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.verdicts import rock_verdict
from seisblock.studies import Observation, fit_block
from seisblock.studies.fit.block_family import BlockFamily
from seisblock.studies.fit.cross_validation import _threshold, calibration, score_predictions
from seisblock.studies.fit.dataset import assign_folds, make_experiment, trim_zeros
from seisblock.studies.fit.importance_sampling import make_proposal
from seisblock.studies.fit.likelihood import log_likelihood, make_lapse_rate
from seisblock.studies.fit.priors import DEFAULT_PRIORS, make_priors
from seisblock.studies.fit.simulate import SHARE_DENOMINATOR, outcome_shares
from tests.studies.fit.conftest import KNOWN, TRUTH, pulse, shaken


def family(*free, bounds=None, block=None, scatter=0.0, **how):
    """Return the blocks among which a test looks."""
    axes = make_priors(free, bounds or {}, scatter=scatter, block=block)
    return BlockFamily(axes, block, how.get("restitution"), how.get("inset", 0.0), scatter, False, 9.80665)


def test_fit_interval_contains_true_slenderness(slender):
    """Alpha to a few per cent from forty outcomes, most of which are foretold without their record."""
    result = slender["alpha"]
    assert result.interval[0] < TRUTH.slenderness < result.interval[1]
    assert result.narrowed < 0.08 and result.identified
    assert slender.held_out.accuracy > 0.85 and slender.held_out.brier < 0.1
    assert slender.held_out.rate_brier > 2 * slender.held_out.brier
    assert slender.block.slenderness == pytest.approx(result.median, rel=1e-9)
    assert slender.block.frequency_parameter() == pytest.approx(4.0)


@pytest.mark.slow
def test_fit_of_four_parameters_contains_truth():
    """Slenderness, size, restitution and scatter, from sixty outcomes: each in its interval of 98 %."""
    observations = fit_block(shaken(60, 11), runs=8, level=0.98)
    truth = {"alpha": 0.25, "p": 4.0, "restitution": TRUTH.restitution, "scatter": 0.05}
    assert [name for name, value in truth.items() if not observations[name].interval[0] <= value <= observations[name].interval[1]] == []
    assert [axis.name for axis in observations.axes] == list(truth)
    assert observations.effective_blocks > 200 and observations.held_out.effective_blocks > 20
    assert {name: draws.shape for name, draws in observations.draws.items()} == dict.fromkeys(truth, (2000,))


def test_fit_recovers_edge_wear():
    """A drawing that is too wide by a third: the inset that makes it as slender as what fell (scans gave 1.4 to 2.5 times the angle)."""
    drawing = Block(TRUTH.width / (1 - 2 * 0.15), TRUTH.height)
    observations = shaken(40, 5)
    fit = fit_block(observations, free=["inset"], **{**KNOWN, "block": drawing}, restitution=TRUTH.restitution)
    low, high = fit["inset"].interval
    assert low < 0.15 < high and high - low < 0.08
    low, high = fit["turning_alpha"].interval
    assert low < 0.25 < high
    assert fit.block.width == pytest.approx(drawing.width)
    assert fit.block.inset / drawing.width == pytest.approx(fit["inset"].median, abs=1e-3)


@pytest.mark.slow
def test_fit_is_reproducible_by_seed(experiment, slender):
    """Bit by bit, on any number of threads; another seed gives another sample of the same answer."""
    repeat, second = (fit_block(experiment, free=["alpha"], **KNOWN, seed=seed) for seed in (0, 1))
    assert repeat.marginals == slender.marginals and (repeat.probability == slender.probability).all()
    assert second["alpha"] != slender["alpha"]
    assert second["alpha"].median == pytest.approx(slender["alpha"].median, abs=0.3 * np.diff(slender["alpha"].interval)[0])


@pytest.mark.slow
def test_fit_weight_equals_repeated_outcomes(experiment):
    """Each twice over, or with a weight of two, is the same evidence; with a weight of zero it is none."""
    experiment = experiment[:24]
    twice = fit_block([*experiment, *experiment], free=["alpha"], **KNOWN, folds=4)
    double = fit_block([replace(observation, weight=2.0) for observation in experiment], free=["alpha"], **KNOWN, folds=4)
    assert double["alpha"].interval == twice["alpha"].interval
    assert double.held_out.accuracy == pytest.approx(twice.held_out.accuracy)
    lone = [replace(observation, weight=float(k < 20)) for k, observation in enumerate(experiment)]
    half = fit_block(experiment[:20], free=["alpha"], **KNOWN)
    assert fit_block(lone, free=["alpha"], **KNOWN)["alpha"].median == pytest.approx(half["alpha"].median, rel=0.02)


def test_fit_with_all_or_no_falls_warns_of_prior():
    """Outcomes bound one side and the prior the other, with a warning."""
    for happened, strength, message in ((False, 1.0, "no overturning among"), (True, 40.0, "only overturning among")):
        observations = [Observation(pulse(strength, f), happened) for f in (0.5, 0.8, 1.2)]
        fit = fit_block(observations, free=["alpha"], **KNOWN)
        assert any(message in text for text in fit.warnings)
        assert fit.held_out.folds == 3


def test_fit_of_one_record_has_no_cross_validation():
    """Nothing can be held out."""
    motion = pulse(1.0, 0.8)
    observations = [Observation(motion, scale > 4.0, scale=scale, record="one") for scale in (2.0, 3.0, 5.0, 6.0)]
    fit = fit_block(observations, free=["alpha"], **KNOWN)
    assert fit.held_out is None and fit.probability_held_out is None
    assert any("outcomes of a single record" in text for text in fit.warnings)
    assert fit.probability[0] < 0.5 < fit.probability[-1]


def test_fit_to_movement_determines_slenderness_only():
    """Rocking starts above g tan(alpha) for any size: alpha is determined, p keeps its prior, with a warning."""
    peaks = np.linspace(1.0, 5.0, 30)
    observations = [Observation(pulse(peak, 1.0), peak > 9.80665 * np.tan(0.25)) for peak in peaks]
    fit = fit_block(observations, kind="moved", free=["alpha", "p"], scatter=0.02, lapse=0.02, runs=4)
    assert fit["alpha"].median == pytest.approx(0.25, rel=0.05)
    assert fit["p"].narrowed > 0.8 and not fit["p"].identified
    assert any("poorly constrained" in text and "p" in text for text in fit.warnings)
    assert any("determine the slenderness only" in text for text in fit.warnings)


@pytest.mark.slow
def test_fit_warns_of_correlated_parameters():
    """A wider base and more worn edges are the same block."""
    observations = fit_block(shaken(30, 2), free=["alpha", "inset"], **KNOWN)
    pair = next(correlation for correlation in observations.correlations if {correlation.first, correlation.second} == {"alpha", "inset"})
    assert pair.coefficient > 0.9
    assert any("cannot be separated" in text for text in observations.warnings)


@pytest.mark.slow
def test_fit_of_random_outcomes_raises_lapse_rate():
    """Coins: no block explains them, the lapses grow, and nothing is foretold better than by the share."""
    rng = np.random.default_rng(0)
    observations = [replace(item, happened=bool(rng.random() < 0.5)) for item in shaken(30, 3)]
    fit = fit_block(observations, free=["alpha"], block=TRUTH, runs=4)
    assert fit["lapse"].median > 0.2
    assert fit.held_out.accuracy < 0.7


INVALID = {
    "no outcome": ({"outcomes": []}, "requires an outcome with a positive weight"),
    "no weight": ({"outcomes": [Observation(pulse(1.0, 1.0), True, weight=0.0)]}, "none with a weight"),
    "a parameter": ({"free": ["mu"]}, "'mu' cannot be fitted; available: alpha, p, restitution, inset"),
    "a parameter twice": ({"free": ["p", "p"]}, "duplicate parameter"),
    "nothing": ({"free": [], "scatter": 0.05, "block": TRUTH}, "no free parameter"),
    "neither free nor given": ({"free": ["alpha"]}, "p must be free or known"),
    "both": ({"free": ["restitution"], "restitution": 0.9, "block": TRUTH}, "both in `free` and given"),
    "bounds": ({"bounds": {"alpha": (0.5, 0.1)}}, "bounds of alpha must be increasing"),
    "bounds of nothing": ({"free": ["alpha"], "block": TRUTH, "bounds": {"p": (1.0, 2.0)}}, "not free; free: alpha"),
    "bounds beyond": ({"bounds": {"alpha": (0.1, 2.0)}}, "below 1.571"),
    "folds": ({"folds": 41}, "41 folds require at least as many records, found 40"),
    "a fold": ({"folds": 1}, "at least 2"),
    "runs": ({"runs": 12}, "one of 1, 2, 4, 8, 16, 32, 64; found 12"),
    "a level": ({"level": 90.0}, r"must lie in \[0.001, 1\)"),
    "a level of nothing": ({"level": 1e-300}, r"must lie in \[0.001, 1\)"),
    "a scatter": ({"scatter": 1.5}, "scatter"),
    "lapses": ({"lapse": -0.1}, "lapse rate"),
    "a restitution": ({"restitution": 1.2}, "restitution"),
    "a kind": ({"kind": "slid"}, "'slid'"),
    "an inset of a length": ({"inset": EdgeWear(length_m=0.01)}, "requires a `block`"),
}


@pytest.mark.parametrize("quantity", INVALID)
def test_fit_rejects_invalid_options(quantity, experiment):
    """In one sentence, before anything is followed."""
    arguments, message = INVALID[quantity]
    with pytest.raises(ParameterError, match=message):
        fit_block(**{"outcomes": experiment, **arguments})


def test_fit_rejects_invalid_outcomes():
    """Objects that are no motions are rejected, too."""
    with pytest.raises(KindError, match="expected Observation, found tuple"):
        fit_block([(pulse(1.0, 1.0), True)])
    with pytest.raises(KindError, match="expected a Motion"):
        Observation("pulse.csv", True)
    with pytest.raises(ParameterError, match="weight of an outcome must be zero or more, found nan"):
        Observation(pulse(1.0, 1.0), True, weight=float("nan"))


def test_fit_points_round_trip_through_blocks():
    """Alpha and p come back from the blocks; a drawing with its centre of gravity elsewhere keeps its shape."""
    odd = Block(0.4, 1.0, centroid_height=0.4, centroid_offset=0.05, centroid_inertia=30.0)
    for drawing in (None, odd):
        fit = family("alpha", "p", block=drawing)
        places = np.random.default_rng(0).random((20, 2))
        expected, blocks = fit.values(places), fit.blocks(places)
        np.testing.assert_allclose(blocks.slendernesses.min(axis=1), expected["alpha"], rtol=1e-12)
        side = blocks.slendernesses.argmin(axis=1)
        np.testing.assert_allclose(np.sqrt(9.80665 * blocks.lever_ratios[np.arange(20), side]), expected["p"], rtol=1e-12)
    ratio = blocks.right / blocks.left
    np.testing.assert_allclose(ratio, odd.arms[0] / odd.arms[1], rtol=1e-12)
    rectangle = from_slenderness(0.3, 5.0)
    same = family("alpha", "p", bounds={"alpha": (0.2, 0.4), "p": (5.0, 5.0001)}).blocks(np.array([[0.5, 0.0]]))
    assert same.right[0] == pytest.approx(rectangle.arms[0]) and same.gyration_squared[0] == pytest.approx(rectangle.gyration_squared)


def test_fit_rows_without_scatter_equal_solve_rock():
    """Rows of a fit are runs of `rock`, worn edges, scale and a given restitution among them."""
    bounds = {"alpha": (0.1, 0.5), "p": (3.0, 6.0)}
    fit = family("alpha", "p", bounds=bounds, inset=0.1, restitution=0.85)
    observations = make_experiment([Observation(pulse(1.0, f), True, scale=scale) for f in (0.7, 1.5) for scale in (3.0, 6.0, 9.0)])
    places = np.random.default_rng(1).random((15, 2))
    shares = outcome_shares(observations, fit, places, np.full(6, 2), (0, 0))
    values = fit.values(places)
    for k, outcome in enumerate(observations.outcomes):
        falls = [
            rock_verdict(
                from_slenderness(a, p).with_wear(0.1), outcome.motion, scale=outcome.scale, options=RockOptions(restitution=0.85)
            ).overturned
            for a, p in zip(values["alpha"], values["p"], strict=True)
        ]
        assert (shares[k] == SHARE_DENOMINATOR * np.array(falls)).all()
    assert 0.1 < (shares > 0).mean() < 0.9


def test_likelihood_equals_product_over_outcomes():
    """Against the formula, written out outcome by outcome."""
    rng = np.random.default_rng(0)
    observations = make_experiment([replace(item, weight=float(w)) for item, w in zip(shaken(12, 1), rng.integers(0, 4, 12), strict=True)])
    shares = rng.integers(0, SHARE_DENOMINATOR + 1, (12, 5))
    subset = make_lapse_rate(None)
    likelihood = log_likelihood(shares, *observations.outcome_counts(), subset)
    for i, value in enumerate(subset.values):
        for j in range(5):
            chance = value / 2 + (1 - value) * shares[:, j] / SHARE_DENOMINATOR
            expected = np.sum(observations.weights * np.log(np.where(observations.happened > 0, chance, 1 - chance)))
            assert likelihood[i, j] == pytest.approx(expected, rel=1e-12)
    # 9 (1 - lambda)^8 in equal parts
    assert np.mean(subset.values) == pytest.approx(0.1, abs=0.002)
    np.testing.assert_allclose(1.0 - (1.0 - subset.values) ** 9, (np.arange(24) + 0.5) / 24, rtol=1e-12)


def test_proposal_density_integrates_to_one():
    """The density integrates to one over the square, and points drawn from it follow it."""
    rng = np.random.default_rng(4)
    cloud = make_proposal(rng.normal([0.1, 0.6], [0.1, 0.05], (60, 2)).clip(0.01, 0.99), np.ones(60), 4000, rng)
    middles = (np.arange(150) + 0.5) / 150
    grid = np.stack(np.meshgrid(middles, middles), axis=-1).reshape(-1, 2)
    density = np.exp(cloud.log_density(grid))
    assert density.mean() == pytest.approx(1.0, abs=0.02)
    left = (grid[:, 0] < 0.1) & (grid[:, 1] < 0.6)
    share = density[left].sum() / density.size
    assert ((cloud.points[:, 0] < 0.1) & (cloud.points[:, 1] < 0.6)).mean() == pytest.approx(share, abs=0.03)


def test_folds_are_balanced_and_keep_records_together(experiment):
    """Folds differ by one record at most; outcomes of one record are in one fold."""
    counts = np.bincount(assign_folds(23, 5, 0))
    assert counts.max() - counts.min() == 1 and counts.sum() == 23
    observations = make_experiment([replace(observation, record=f"r{k % 8}") for k, observation in enumerate(experiment)])
    assert observations.records == 8
    folds = assign_folds(8, 4, 0)[observations.record]
    assert all(len(set(folds[np.arange(40) % 8 == k])) == 1 for k in range(8))


def test_scores_equal_hand_calculation(experiment):
    """Accuracy, Brier's score, the share of the others and the best threshold on the peak velocity, by hand."""
    observations = make_experiment(
        [replace(observation, happened=k >= 20, weight=1.0 + (k == 0)) for k, observation in enumerate(experiment)]
    )
    chance = np.where(np.arange(40) >= 20, 0.8, 0.3)
    chance[5] = 0.9
    folds = np.arange(40) % 4
    result = score_predictions(observations, chance, np.arange(40.0), folds, 50.0)
    assert result.accuracy == pytest.approx(40 / 41)
    assert result.brier == pytest.approx((20 * 0.04 + 20 * 0.09 + 0.81) / 41)
    assert result.threshold_accuracy == pytest.approx(40 / 41)  # 19 lies in the middle between its neighbours
    assert result.rate_accuracy < 0.6
    assert [step.outcomes for step in result.calibration] == [19, 20, 1]
    assert result.calibration[0].mean_probability == pytest.approx(0.3) and result.calibration[0].share == 0.0


def test_calibration_bins_include_both_ends():
    """Certainties are in the first and the last range."""
    steps = calibration(np.array([0.0, 0.1, 1.0]), np.array([0.0, 1.0, 1.0]), np.ones(3))
    assert [(step.low, step.high, step.outcomes) for step in steps] == [(0.0, 0.1, 1), (0.1, 0.3, 1), (0.9, 1.0, 1)]


def test_silence_around_pulse_changes_no_outcome():
    """Zeros before and after a pulse make no verdict different, and no run longer."""
    bare, long = pulse(5.0, 1.0), pulse(5.0, 1.0)
    rows = np.concatenate([np.zeros(500), long.horizontal, np.zeros(3000)])
    padded = type(bare).from_arrays(rows, bare.dt)
    short = trim_zeros(padded)
    assert short.samples < bare.samples + 3
    for scale in np.linspace(0.5, 2.0, 40):
        assert rock_verdict(TRUTH, short, scale=scale).overturned == rock_verdict(TRUTH, padded, scale=scale).overturned
    assert trim_zeros(type(bare).from_arrays(np.zeros(50), 0.01)).samples == 2


def test_parameter_axes_are_logarithmic_or_linear():
    """Half way along p is the geometric mean of its bounds, along alpha the arithmetic one."""
    assert DEFAULT_PRIORS["p"].value(np.array([0.5]))[0] == pytest.approx(5.0)
    assert DEFAULT_PRIORS["alpha"].value(np.array([0.5]))[0] == pytest.approx(0.515)


@pytest.mark.parametrize("seed", range(20))
def test_threshold_of_an_intensity_has_the_most_correct_classifications(seed):
    """No threshold between, below or above the values classifies a greater weight of outcomes correctly."""
    rng = np.random.default_rng(seed)
    values, outcomes, weights = rng.normal(size=9), rng.random(9) < rng.random(), rng.uniform(0.2, 1.2, 9)

    def correct(threshold):
        return weights[(values > threshold) == outcomes].sum()

    ends = np.sort(values)
    candidates = [-np.inf, *(0.5 * (ends[:-1] + ends[1:])), np.inf]
    assert correct(_threshold(values, outcomes.astype(float), weights)) == pytest.approx(max(map(correct, candidates)))
