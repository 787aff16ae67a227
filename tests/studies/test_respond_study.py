"""Probability of the outcome of a free-standing body, and its worst direction."""

import numpy as np
import pytest
from scipy.stats import kstest, uniform

from seisblock.bodies.block import Block
from seisblock.bodies.friction import SURFACES, surface
from seisblock.core.errors import ParameterError
from seisblock.models.respond.batch import respond_many
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.solve import solve_respond
from seisblock.readers import read
from seisblock.records import Motion, motion_of
from seisblock.references import REFERENCES
from seisblock.studies.respond.azimuths import respond_directions
from seisblock.studies.respond.probability import Probability, respond_probability
from seisblock.studies.sampling import ParameterVariation
from seisblock.studies.solvers import respond as respond_studies

PULSE = Motion.from_arrays(6.0 * np.sin(np.linspace(0.0, 2 * np.pi, 201)), 0.005)
DEFAULT_VARIATION = ParameterVariation()
NOTHING_VARIES = ParameterVariation(size=0.0, inset=0.0, mu=0.0, restitution=0.0, amplitude=0.0, azimuth_deg=0.0)


def share(block, motion, *, runs=40, versions=DEFAULT_VARIATION, seed=0, moved_m=0.01, progress=None, **options):
    """Return the probability of 40 samples."""
    study = {"runs": runs, "versions": versions, "seed": seed, "moved_m": moved_m, "progress": progress}
    return respond_probability(block, motion, RespondOptions(**{"settle_s": 20.0, **options}), **study)


@pytest.mark.parametrize(("width", "height", "mu"), [(0.24, 0.8, 0.6), (0.24, 0.8, 0.1), (0.5, 0.5, 0.3)])
def test_respond_probability_without_variation_equals_outcome(width, height, mu):
    """With nothing varied the share is that of the single run, 0 or 1, and every quantile is its displacement."""
    block = Block(width, height)
    outcome = solve_respond(block, PULSE, mu=mu, settle_s=20.0).outcome
    result = share(block, PULSE, mu=mu, versions=NOTHING_VARIES, runs=3)
    assert result.overturned == float(outcome.overturned)
    assert result.moved == float(outcome.overturned or abs(outcome.final_displacement_m) > 0.01)
    if not outcome.overturned:
        assert set(result.final_displacement_m.values()) == {outcome.final_displacement_m}


def test_respond_samples_are_uniform_within_half_widths(monkeypatch):
    """Friction, restitution, amplitude and direction fill their ranges evenly and never leave them; normal ones would do neither."""
    calls = []

    def overheard(settings, motion, **arguments):
        bounce = settings.restitution + settings.rocking - 1.0
        calls.extend(zip(settings.mu, bounce, arguments["gains"], strict=True))
        return respond_many(settings, motion, **arguments)

    monkeypatch.setattr(respond_studies, "respond_many", overheard)
    still = Motion(1e-6 * np.ones((3, 4)), 0.01)
    share(Block(0.24, 0.8), still, mu=0.5, runs=400)
    mu, restitution, gains = (np.array(column) for column in zip(*calls, strict=True))
    along, across, _ = gains.T
    changes = {
        "mu": (mu / 0.5 - 1.0) / 0.2,
        "restitution": restitution / 0.1,
        "amplitude": (np.hypot(along, across) - 1.0) / 0.1,
        "azimuth": np.degrees(np.arctan2(-across, along)) / 10.0,
    }
    for name, change in changes.items():
        assert np.abs(change).max() <= 1.0 + 1e-12, name
        assert kstest(change, uniform(-1.0, 2.0).cdf).pvalue > 0.01, name


def test_respond_probability_is_independent_of_thread_count(monkeypatch):
    """Versions are drawn before they are handed out."""
    answers = []
    for cores in (1, 3):
        monkeypatch.setattr("os.cpu_count", lambda cores=cores: cores)
        answers.append(share(Block(0.24, 0.8), PULSE, mu=0.5, seed=7))
    assert answers[0] == answers[1]
    assert share(Block(0.24, 0.8), PULSE, mu=0.5, seed=8) != answers[0]


def test_respond_probability_increases_with_shaking():
    """The share of falls goes from none to all as the pulse grows."""
    shares = [
        share(Block(0.24, 0.8), Motion.from_arrays(factor * PULSE.horizontal, PULSE.dt), mu=0.8).overturned for factor in (0.3, 0.8, 2.0)
    ]
    assert shares[0] == 0.0 and shares[2] == 1.0 and shares == sorted(shares)


def test_respond_samples_with_exact_wear_keep_it():
    """With a tolerance of nothing a worn body stays as worn as it is."""
    block = Block(0.24, 0.8).with_wear(0.2)
    sharp = ParameterVariation(size=0.0, inset=0.0, mu=0.0, restitution=0.0, amplitude=0.0, azimuth_deg=0.0)
    result = solve_respond(block, PULSE, mu=0.6, settle_s=20.0).outcome
    assert share(block, PULSE, mu=0.6, versions=sharp, runs=2).overturned == float(result.overturned)


@pytest.mark.parametrize("width", [("size", 1.0), ("mu", -0.1), ("inset", 1.0), ("azimuth_deg", 200.0)])
def test_respond_probability_rejects_invalid_half_widths(width):
    """Shares lie below 1."""
    with pytest.raises(ParameterError, match="spread"):
        ParameterVariation(**dict([width]))


def test_respond_probability_rejects_zero_runs():
    """A share of nothing is none."""
    with pytest.raises(ParameterError, match="number of runs must be an integer of at least 1"):
        share(Block(0.24, 0.8), PULSE, mu=0.5, runs=0)


def test_probability_interval_is_clopper_pearson():
    """Its ends are the probabilities at which so few, or so many, falls have 2.5 %."""
    from scipy.stats import binom

    result = share(Block(0.24, 0.8), Motion.from_arrays(0.6 * PULSE.horizontal, PULSE.dt), mu=0.8, runs=60)
    count = round(result.overturned * 60)
    assert isinstance(result, Probability) and 0 < count < 60
    assert binom.sf(count - 1, 60, result.interval[0]) == pytest.approx(0.025, rel=1e-6)
    assert binom.cdf(count, 60, result.interval[1]) == pytest.approx(0.025, rel=1e-6)


def test_respond_azimuths_equal_single_runs():
    """Each azimuth is the single run of the square base projected on it, and the worst comes first."""
    record = read("synthetic_jma.csv")
    block, options = Block(0.45, 1.8), {"mu": 0.3, "settle_s": 20.0}
    directions = respond_directions(block, record, RespondOptions(**options), step_deg=45.0)
    assert {entry.azimuth_deg for entry in directions} == {0.0, 45.0, 90.0, 135.0}
    for item in directions:
        turn = np.radians(item.azimuth_deg)
        projected = Block(0.45 * (abs(np.cos(turn)) + abs(np.sin(turn))), 1.8, 0.45, mass=1.0, centroid_inertia=(0.45**2 + 1.8**2) / 12)
        outcome = solve_respond(projected, motion_of(record, f"{item.azimuth_deg:g}"), **options).outcome
        assert item.overturned == outcome.overturned and item.overturned_towards == outcome.overturned_towards
        assert item.max_displacement_m == pytest.approx(outcome.max_displacement_m, rel=1e-6) or outcome.overturned
    assert [entry.overturned for entry in directions] == sorted((entry.overturned for entry in directions), reverse=True)


def test_friction_table_entries_cite_a_source():
    """Each cites a reference with a locator, and kinetic friction is not above static."""
    for name, pair in SURFACES.items():
        key, _, locator = pair.source.strip("[").partition("]_ ")
        assert key in REFERENCES and locator, name
        assert 0.0 < pair.mu_kinetic <= pair.mu
    with pytest.raises(ParameterError, match="granite/granite"):
        surface("butter/toast")
