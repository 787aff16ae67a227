"""Samples behind an overturning probability: centred on the body as given, continuous in its inset, in agreement with the verdict."""

from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import wear_range
from seisblock.bodies.factory import load_block
from seisblock.bodies.kinds import KINDS, of_kind
from seisblock.bodies.uncertainty import ParameterRanges
from seisblock.core.errors import BodyError
from seisblock.models.respond.batch import respond_many
from seisblock.models.respond.constants import ROCKING_RESTITUTION
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.params import RespondParams, rigid_body
from seisblock.models.respond.solve import solve_respond
from seisblock.models.rock.solve import solve_rock
from seisblock.models.rock.verdicts import rock_verdict
from seisblock.readers import read
from seisblock.records import Motion, motion_of
from seisblock.studies.respond.probability import respond_probability
from seisblock.studies.rocking.perturb import perturb
from seisblock.studies.sampling import ParameterVariation, draw_samples, sample_gains, sample_respond_params, sample_rock_params

INSETS = (0.0, 0.02, 0.05, 0.1, 0.1001, 0.12)
NOTHING_VARIES = ParameterVariation(size=0.0, inset=0.0, mu=0.0, restitution=0.0, amplitude=0.0, azimuth_deg=0.0)


@cache
def shaking(name, code, factor=1.0):
    """Return a horizontal of a bundled record, all components scaled."""
    motion = motion_of(read(name), code)
    return Motion(factor * motion.acceleration, motion.dt, motion.name, motion.start_s, motion.record)


def test_probability_is_continuous_in_a_given_inset():
    """It rises with the inset, and 1e-4 of the width change the fate of few samples: also at the ends and the median of gravestones."""
    motion = shaking("hanmer_springs_2016", "1", 1.7)
    shares = {
        x: respond_probability(Block(0.2424, 0.72).with_wear(x), motion, options=RespondOptions(mu=0.6)).overturned
        for x in (*INSETS, 0.0001, 0.0501, 0.1201)
    }
    assert shares[0.0] < shares[0.02] < shares[0.05] and 0.1 < shares[0.05] < 0.9 and 0.1 < shares[0.1] < 0.9
    for x in (0.0, 0.05, 0.1, 0.12):
        assert abs(shares[x] - shares[round(x + 1e-4, 4)]) <= 6 / 200
    ordered = [shares[x] for x in INSETS]
    assert all(extra >= less - 6 / 200 for less, extra in pairwise(ordered))
    assert all(extra - less < 0.5 for less, extra in pairwise(ordered[:4]))


@given(share=st.floats(0.0, 0.45), offset=st.floats(-0.03, 0.03), tolerance=st.floats(0.0, 0.9))
def test_wear_range_is_continuous_and_centred_on_a_given_inset(share, offset, tolerance):
    """Its middle is the inset itself, and it moves no faster than that."""
    block = Block(0.24, 0.8, centroid_offset=offset, inset=0.24 * share * (0.5 - abs(offset) / 0.24) / 0.5)
    low, high = wear_range(block, tolerance)
    body_value = block.inset / block.width
    assert 0.0 <= low <= body_value <= high < 0.5 - abs(offset) / 0.24
    assert 0.5 * (low + high) == pytest.approx(body_value, abs=1e-12)
    nearby = wear_range(Block(0.24, 0.8, centroid_offset=offset, inset=block.inset + 1e-6), tolerance)
    assert np.abs(np.subtract(nearby, (low, high))).max() < 1e-5


@pytest.mark.parametrize("name", ["gravestone", "bookcase", "refrigerator", "display_case", "statue"])
def test_nominal_body_is_the_median_of_its_samples(name):
    """In width, height, inset, friction, restitution, amplitude and direction."""
    body, mu = load_block(name), 0.42
    draws = np.random.default_rng(3).uniform(-1.0, 1.0, (20_001, 8))
    motion = shaking("synthetic_jma.csv", "NS")
    subset = sample_respond_params(body, ParameterVariation(), draws, options=RespondOptions(mu=mu, restitution=0.05))
    gains = sample_gains(motion, ParameterVariation(), draws, None)
    right, left, centre, _ = subset.blocks.columns
    across = 0.5 * (right + left)
    for values, nominal in (
        (across, 0.5 * sum(body.arms)),
        (centre, body.centre),
        (subset.mu, mu),
        (subset.mu_kinetic, mu),
        (subset.restitution, 0.05),
        (subset.rocking, 1.0),
        (np.hypot(gains[:, 0], gains[:, 1]), 1.0),
    ):
        assert np.median(values) == pytest.approx(nominal, rel=0.01)
        assert values.min() < nominal
    assert np.median(np.degrees(np.arctan2(-gains[:, 1], gains[:, 0]))) == pytest.approx(0.0, abs=0.2)
    rock = sample_rock_params(body, motion, ParameterVariation(), draws)
    nominal = sample_rock_params(body, motion, ParameterVariation(), np.zeros((1, 8)))
    for field in ("alphas", "levers", "restitutions"):
        np.testing.assert_allclose(np.median(getattr(rock, field), axis=0), getattr(nominal, field)[0], rtol=0.01)


def test_samples_drawn_at_the_middle_are_the_body_itself():
    """Zero draws give the nominal body, contact and shaking, whatever its ranges."""
    body = load_block("refrigerator")
    first = sample_respond_params(
        body, ParameterVariation(), np.zeros((1, 8)), options=RespondOptions(mu=0.3, mu_kinetic=0.25, rocking_restitution=0.8)
    ).row_params(0)
    assert (first.rigid_body.right, first.rigid_body.left, first.rigid_body.height) == pytest.approx((*body.arms, body.centre), rel=1e-14)
    assert (first.mu, first.mu_kinetic, first.restitution, first.rocking_restitution) == pytest.approx((0.3, 0.25, 0.0, 0.8))


@pytest.mark.parametrize("name", ["gravestone", "refrigerator"])
@pytest.mark.parametrize("factor", [0.5, 2.0, 6.0])
def test_probability_without_variation_equals_outcome(name, factor):
    """0 or 1, also of a body whose kind has ranges; `respond` and `rock`."""
    body, motion = load_block(name), shaking("hanmer_springs_2016", "1", factor)
    falls = solve_respond(body, motion, mu=0.5).outcome.overturned
    assert respond_probability(body, motion, options=RespondOptions(mu=0.5), runs=2, versions=NOTHING_VARIES).overturned == float(falls)
    assert perturb(body, motion, 2, spread=NOTHING_VARIES).overturned == 2 * rock_verdict(body, motion).overturned


def test_hops_of_rocking_samples_end_before_the_record():
    """Pushed over its threshold for a moment, the sample of highest restitution comes to rest; one of restitution 1 would hop on."""
    block, draws = Block(0.2, 1.0), draw_samples(200, 0)
    motion = Motion.from_arrays(9.80665 * 0.2 * np.array([0.0, 1.001, *[0.8] * 60]), 0.01)
    restitutions = sample_rock_params(block, motion, ParameterVariation(), draws).restitutions
    assert solve_rock(block, motion, restitution=float(restitutions.max())).outcome.impacts < 100_000


@pytest.mark.slow
def test_outcome_agrees_with_probability_near_threshold():
    """Of 60 cases around the shaking at which half of the samples fall, at least 80 % have the verdict of the majority."""
    bodies = ((load_block("gravestone"), 0.6), (of_kind(Block(0.2424, 0.72), "gravestone"), 0.6), (Block(0.3, 1.2), 0.6))
    records = (("synthetic_jma.csv", "NS"), ("synthetic_jma.csv", "EW"), ("hanmer_springs_2016", "1"), ("shafter_1989", "NS"))
    agree, differences = [], []
    for body, mu in bodies:
        for name, code in records:
            low, high = 0.1, 40.0
            for _ in range(6):
                middle = (low * high) ** 0.5
                falls = respond_probability(body, shaking(name, code, middle), options=RespondOptions(mu=mu), runs=30).overturned >= 0.5
                low, high = (low, middle) if falls else (middle, high)
            for factor in (0.8, 0.9, 1.0, 1.1, 1.25):
                motion = shaking(name, code, high * factor)
                share = respond_probability(body, motion, options=RespondOptions(mu=mu), runs=100).overturned
                falls = solve_respond(body, motion, mu=mu).outcome.overturned
                agree.append((share >= 0.5) == falls)
                differences.append(share - falls)
    assert len(agree) == 60
    assert np.mean(agree) >= 0.8 and abs(np.mean(differences)) < 0.1


def test_restitution_varies_to_both_sides_of_a_plastic_impact():
    """The lossier half keeps a share of Housner's ratio, at least 0.9; a given rocking restitution varies about itself, up to 1."""
    draws = draw_samples(400, 0)
    subset = sample_respond_params(Block(0.24, 0.8), ParameterVariation(), draws, options=RespondOptions(mu=0.5))
    lossy = draws[:, 3] < 0.0
    assert 0.9 < subset.rocking.min() < 0.905 and (subset.rocking[~lossy] == 1.0).all() and (subset.restitution[lossy] == 0.0).all()
    assert 0.095 < subset.restitution.max() <= 0.1
    table = subset.parameters(0.01)
    assert (table[lossy, ROCKING_RESTITUTION] == -subset.rocking[lossy]).all() and (table[~lossy, ROCKING_RESTITUTION] == -1.0).all()
    ratio = sample_respond_params(Block(0.24, 0.8), ParameterVariation(), draws, options=RespondOptions(mu=0.5, rocking_restitution=0.95))
    assert ratio.rocking_given and ratio.rocking.min() < 0.86 and ratio.rocking.max() == 1.0
    assert np.median(ratio.rocking) == pytest.approx(0.95, abs=0.01)


@pytest.mark.parametrize("offset", [0.0, 0.03])
def test_restitution_share_scales_housner_ratio(offset):
    """With feet that hold, a share that is nearly one changes nearly nothing, and one of 0.9 brings the block to rest sooner."""
    pulse = Motion.from_arrays(3.6 * np.sin(np.linspace(0.0, 2 * np.pi, 201)), 0.002)
    body = rigid_body(Block(0.24, 0.8, centroid_offset=offset))
    law, nearly, less = (RespondParams(body, 0.9, 0.9, rocking_share=share) for share in (1.0, 1.0 - 1e-12, 0.9))
    fates = respond_many([law, nearly, less], pulse)
    assert not fates.overturned.any() and fates.max_rotation_rad[0] > 0.01 and fates.impacts[0] > 3
    assert fates.max_rotation_rad[1] == pytest.approx(fates.max_rotation_rad[0], rel=1e-8)
    assert fates.end_s[2] < fates.end_s[0] - 0.05


def test_kind_sets_prior_of_edge_wear():
    """Only gravestones are worn, the others are sharp; an inset that is given replaces the prior, and a wrong kind is refused."""
    block = Block(0.24, 0.72)
    assert [of_kind(block, kind).inset for kind in KINDS] == pytest.approx([0.012, 0.0, 0.0, 0.0])
    stone = of_kind(block, "gravestone")
    assert stone.ranges == ParameterRanges(inset_m=(0.0, 0.024)) and stone.with_wear(0.1).ranges is None
    lopsided = of_kind(Block(0.2, 0.6, centroid_offset=0.096), "gravestone")
    assert 0.0 < lopsided.inset < 0.004 and wear_range(lopsided, 0.1)[1] < 0.02
    with pytest.raises(BodyError, match="unknown kind of body 'tombstone'"):
        of_kind(block, "tombstone")
