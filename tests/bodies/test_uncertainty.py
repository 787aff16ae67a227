"""Ranges of a kind of body: read from its file, and plausible versions lie within them, up to their ends."""

import json
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.bodies.block import Block
from seisblock.bodies.block_array import within
from seisblock.bodies.factory import load_block
from seisblock.bodies.kinds import KINDS, kind_to_toml, of_kind
from seisblock.bodies.uncertainty import ParameterRanges
from seisblock.cli import main
from seisblock.core.errors import BodyError
from seisblock.models.respond.options import RespondOptions
from seisblock.models.respond.solve import solve_respond
from seisblock.models.rock.verdicts import rock_verdict
from seisblock.records import Motion
from seisblock.studies.fragility.run import run_fragility
from seisblock.studies.respond.probability import respond_probability
from seisblock.studies.rocking.perturb import perturb
from seisblock.studies.sampling import ParameterVariation, draw_samples, sample_respond_params

PULSE = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, 2 * np.pi, 201)), 0.01)
FRIDGE = ParameterRanges(width_m=(0.6, 0.75), height_m=(1.6, 1.9), inset_m=(0.02, 0.06), mu=(0.15, 0.5))
FILE = 'kind = "block"\nname = "thing"\nwidth = "60cm"\nheight = "1.8m"\nmu = 0.3\n[ranges]\n'


@pytest.mark.parametrize("kind", KINDS)
def test_printed_prior_read_back_gives_same_samples(kind, tmp_path):
    """The file of ``body --kind`` through ``--block``: sizes, median, ranges and each sample of a body equal to the last bit."""
    options, draws = RespondOptions(mu=0.5), draw_samples(20, 0)
    for width, height in ((0.24, 0.72), (0.0303 * 8, 2.0 / 3.0), (0.6018728872087648, 1.3257509453327574)):
        (tmp_path / "body.toml").write_text(kind_to_toml(kind, width, height), encoding="utf-8")
        loaded, expected = load_block(tmp_path / "body.toml"), of_kind(Block(width, height), kind)
        assert (loaded.width, loaded.height, loaded.inset, loaded.ranges) == (width, height, expected.inset, expected.ranges)
        one, other = (sample_respond_params(block, ParameterVariation(), draws, options) for block in (loaded, expected))
        assert np.array_equal(one.blocks.columns, other.blocks.columns)


def test_bundled_body_has_ranges_in_metres():
    """Lengths are in metres for any unit of the file; a lantern has none."""
    assert load_block("refrigerator").ranges == FRIDGE
    case = load_block("bookcase").ranges
    assert case.height_m == pytest.approx((29 * 0.0254, 81.25 * 0.0254)) and case.mu == (0.2, 0.7)
    assert case.width_m is None and case.inset_m is None
    assert load_block("lantern").ranges is None


def test_range_draws_have_nominal_value_as_median():
    """Uniform draws of either half lie evenly between the own value and the end; one outside the range widens it."""
    draws = np.linspace(-1.0, 1.0, 2001)
    for body_value in (0.2, 0.4, 0.7):
        values = within((0.2, 0.7), body_value, draws)
        assert (values.min(), np.median(values), values.max()) == pytest.approx((0.2, body_value, 0.7))
        assert np.ptp(np.diff(values[:1001])) < 1e-12 and np.ptp(np.diff(values[1000:])) < 1e-12
    assert within((0.2, 0.7), 0.9, np.array([-1.0, 0.0, 1.0])).tolist() == pytest.approx([0.2, 0.9, 0.9])


def test_samples_of_respond_draw_edges_and_friction_from_the_ranges_but_not_sizes():
    """Width and height of this body are known, vary by 5 % independently of each other, and are the medians."""
    body = load_block("refrigerator")
    draws = draw_samples(4000, 1)
    subset = sample_respond_params(body, ParameterVariation(), draws, options=RespondOptions(mu=0.3))
    heights = 2 * subset.blocks.centre
    widths = np.sqrt(12 * subset.blocks.gyration_squared - heights**2)
    insets = (widths / 2 - subset.blocks.right) / widths * body.width
    for values, (low, high), body_value in (
        (heights, (0.95 * 1.8, 1.05 * 1.8), 1.8),
        (widths, (0.95 * 0.65, 1.05 * 0.65), 0.65),
        (insets, FRIDGE.inset_m, 0.04),
        (subset.mu, FRIDGE.mu, 0.3),
    ):
        margin = 0.01 * (high - low)
        assert low - 1e-9 <= values.min() < low + margin and high - margin < values.max() <= high + 1e-9
        assert np.median(values) == pytest.approx(body_value, abs=0.02 * (high - low))
    assert abs(np.corrcoef(heights, widths)[0, 1]) < 0.05


def test_zero_tolerance_keeps_body_in_all_samples():
    """Ranges or not, all samples do what the body does: `rock` and `respond`."""
    block = Block(0.24, 0.8)
    same = replace(block, ranges=ParameterRanges(inset_m=(0.0, 0.02), mu=(0.2, 0.9)))
    for size in (0.8, 1.0, 1.5):
        motion = Motion.from_arrays(size * PULSE.horizontal, 0.01)
        still = ParameterVariation(size=0.0, slenderness=0.0, inset=0.0, restitution=0.0, amplitude=0.0, azimuth_deg=0.0)
        result = perturb(same, motion, 5, spread=still)
        assert result.overturned == 5 * rock_verdict(block, motion).overturned
        nothing = ParameterVariation(size=0.0, inset=0.0, mu=0.0, restitution=0.0, amplitude=0.0, azimuth_deg=0.0)
        first = respond_probability(same, motion, options=RespondOptions(mu=0.5), runs=3, versions=nothing)
        assert first.overturned == float(solve_respond(block, motion, mu=0.5).outcome.overturned) and first.ranges == same.ranges


def test_given_values_have_no_range():
    """A width of its edges or a friction that the user gives has no range any more; a resized block has none of its drawing."""
    body = load_block("refrigerator")
    assert body.with_wear(0.05).ranges == ParameterRanges(width_m=FRIDGE.width_m, height_m=FRIDGE.height_m, mu=FRIDGE.mu)
    line = ["respond", "elcentro_1940_ns.csv", "--block", "refrigerator", "--runs", "2", "--json", "--quiet"]
    for extra, inset, mu in (
        ([], [0.02, 0.06], [0.15, 0.5]),
        (["--mu", "0.4"], [0.02, 0.06], None),
        (["--vary-inset", "0.2"], None, [0.15, 0.5]),
    ):
        ranges = json.loads(CliRunner().invoke(main, [*line, *extra]).stdout)["results"][0]["probability"]["ranges"]
        assert (ranges["inset_m"], ranges["mu"], ranges["width_m"], ranges["height_m"]) == (inset, mu, None, None)


def test_percent_inset_range_refers_to_width():
    """The range of the bundled gravestone is 0 to 0.1 of its width, and its own inset the median."""
    stone = load_block("gravestone")
    assert stone.ranges.inset_m == (0.0, pytest.approx(0.1 * stone.width)) and stone.ranges.mu is None
    assert stone.inset == pytest.approx(0.05 * stone.width)


def test_output_states_origin_of_samples():
    """`rock` and `respond`: each number once, its range or the usual share, never both; of one stone and of a pile."""
    record = ("synthetic_jma.csv", "--window", "25:28", "--component", "NS", "--block")
    for words, expected in (
        (
            ("rock", *record, "refrigerator", "--perturb", "3", "--details"),
            "samples with width and height ±5 %, edge wear 3 % to 9 % of the width,",
        ),
        (
            ("respond", *record, "refrigerator", "--runs", "3"),
            "Parameter variation only (model error not included): width and height ±5 %, "
            "edge wear 3 % to 9 % of the width, mu 0.15 to 0.5, restitution ±0.1,",
        ),
        (("rock", *record, "bookcase", "--perturb", "3", "--details"), "width and height ±5 %, sharp edges, restitution ±10 %"),
        (
            ("respond", *record, "bookcase", "--runs", "3"),
            "Parameter variation only (model error not included): width and height ±5 %, sharp edges, mu 0.2 to 0.7,",
        ),
        (
            ("respond", *record, "statue", "--runs", "3"),
            "Parameter variation only (model error not included): width and height ±5 %, sharp edges, mu 0.4 to 0.8,",
        ),
        (("respond", *record, "gravestone", "--runs", "3"), "edge wear 0 to 10 % of the width, friction ±20 %,"),
        (("respond", *record, "gravestone", "--runs", "3", "--inset", "0.1"), "edge wear 9 % to 11 % of the width, friction ±20 %,"),
        (("respond", *record, "bookcase", "--runs", "3", "--vary-mu", "0.1"), "sharp edges, friction ±10 %,"),
    ):
        text = " ".join(CliRunner().invoke(main, [*words, "--quiet"]).stdout.split())
        assert expected in text, (words, text)


def test_unknown_edges_increase_dispersion():
    """The dispersion of a gravestone of unknown edges is more than that of one whose edges were measured."""
    suite = ["synthetic_jma.csv", "elcentro_1940_ns.csv"]
    stone = load_block("gravestone")
    study = run_fragility(
        suite, {"any": stone, "one": stone.without_ranges("inset_m")}, "rock", im="pgv", perturb=12, steps=12, bootstrap=2
    )
    wide, narrow = study.curves
    assert wide.dispersion.beta_parameter > 1.1 * narrow.dispersion.beta_parameter
    (note,) = (note for note in study.notes if note.startswith("any: samples drawn from the ranges of the body"))
    assert "edges worn by 0 to 0.02424 m" in note
    assert not any("one: samples" in note for note in study.notes)


@pytest.mark.parametrize(
    ("lines", "says"),
    [
        ('width = ["50cm", "55cm"]', "width of the body is 0.6, outside its range of 0.5 to 0.55"),
        ('width = ["70cm", "50cm"]', "width of the body is 0.6, outside its range"),
        ('width = ["60cm"]', "width must be a list of 2 values"),
        ("mu = 0.3", "mu must be a list of 2 numbers"),
        ("weight = [1, 2]", "unknown entries weight"),
        ('inset = ["0cm", "40cm"]\nwidth = ["60cm", "70cm"]', "an inset of 0.4 m is too large for a width of 0.6 m"),
        ("mu = [0.0, 0.5]", "the range of mu must be positive"),
    ],
)
def test_ranges_reject_invalid_values(lines, says, tmp_path):
    """One sentence, with the file's name."""
    path = tmp_path / "thing.toml"
    path.write_text(FILE + lines)
    with pytest.raises(BodyError, match=says) as refused:
        load_block(path)
    assert "thing.toml" in str(refused.value)
