"""Ranges of a kind of body: read from its file, and plausible versions lie within them, up to their ends."""

import json
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.bodies.block import Block
from seisblock.bodies.blocks import versions_within
from seisblock.bodies.library import load_block
from seisblock.bodies.ranges import Ranges
from seisblock.cli import main
from seisblock.errors import BodyError
from seisblock.records import Motion
from seisblock.solvers.rock.verdicts import rock_verdict
from seisblock.studies.fragility.run import run_fragility
from seisblock.studies.rocking.perturb import Spread, draws_of, perturb
from seisblock.studies.standing.probability import Versions, changed_settings, respond_probability

PULSE = Motion.from_arrays(4.0 * np.sin(np.linspace(0.0, 2 * np.pi, 201)), 0.01)
FRIDGE = Ranges(width_m=(0.6, 0.75), height_m=(1.6, 1.9), inset_m=(0.02, 0.06), mu=(0.15, 0.5))
FILE = 'kind = "block"\nname = "thing"\nwidth = "60cm"\nheight = "1.8m"\nmu = 0.3\n[ranges]\n'


def test_a_bundled_body_tells_its_ranges():
    """In metres, whatever the unit of its file; a stone tells none."""
    assert load_block("refrigerator").ranges == FRIDGE
    case = load_block("bookcase").ranges
    assert case.height_m == pytest.approx((29 * 0.0254, 81.25 * 0.0254)) and case.mu == (0.2, 0.7)
    assert case.width_m is None and case.inset_m is None
    assert load_block("gravestone").ranges is None


def test_versions_lie_within_the_ranges_and_reach_their_ends():
    """Width, height and edges each for themselves; what has no range differs by the usual share."""
    body = load_block("refrigerator")
    ends = np.array([-1.0, -1.0, 1.0, 1.0])
    some = versions_within(body, body.ranges, tall=ends, wide=-ends, worn=ends, size=0.05, inset=np.zeros(4))
    np.testing.assert_allclose(2 * some.centre, [1.6, 1.6, 1.9, 1.9])
    np.testing.assert_allclose(some.right, [0.375 - 0.02, 0.375 - 0.02, 0.3 - 0.06, 0.3 - 0.06])
    np.testing.assert_allclose(some.gyration_squared, (np.array([0.75, 0.75, 0.6, 0.6]) ** 2 + (2 * some.centre) ** 2) / 12)
    narrow = versions_within(body, Ranges(height_m=(1.6, 1.9)), tall=ends, wide=ends, worn=ends, size=0.05, inset=np.full(4, 0.1))
    np.testing.assert_allclose(narrow.right, 0.65 * np.array([0.95, 0.95, 1.05, 1.05]) * (0.5 - 0.1))


def test_versions_of_respond_lie_within_the_ranges():
    """Friction too; width and height are drawn independently of each other."""
    body = load_block("refrigerator")
    draws = draws_of(400, 1)
    some = changed_settings(body, Versions(), draws, mu=0.3)
    heights = 2 * some.blocks.centre
    widths = np.sqrt(12 * some.blocks.gyration_squared - heights**2)
    for found, (low, high) in ((heights, FRIDGE.height_m), (widths, FRIDGE.width_m), (some.mu, FRIDGE.mu)):
        assert low <= found.min() < low + 0.05 * (high - low) and high - 0.05 * (high - low) < found.max() <= high
    assert abs(np.corrcoef(heights, widths)[0, 1]) < 0.15


def test_ranges_of_one_point_are_the_body_itself():
    """Nothing else varied, all versions do what it does: `rock` and `respond`."""
    block = Block(0.24, 0.8)
    same = replace(block, ranges=Ranges(width_m=(0.24, 0.24), height_m=(0.8, 0.8), inset_m=(0.0, 0.0), mu=(0.5, 0.5)))
    for size in (0.8, 1.0, 1.5):
        motion = Motion.from_arrays(size * PULSE.horizontal, 0.01)
        still = Spread(restitution=0.0, amplitude=0.0, azimuth_deg=0.0)
        found = perturb(same, motion, 5, spread=still)
        assert found.overturned == 5 * rock_verdict(block, motion).overturned
        one = respond_probability(same, motion, mu=0.5, runs=3, versions=Versions(restitution=0.0, amplitude=0.0, azimuth_deg=0.0))
        assert one.overturned in (0.0, 1.0) and one.ranges == same.ranges


def test_what_is_given_is_known():
    """A width of its edges or a friction that the user gives has no range any more; a resized block has none of its drawing."""
    body = load_block("refrigerator")
    assert body.worn(0.05).ranges == Ranges(width_m=FRIDGE.width_m, height_m=FRIDGE.height_m, mu=FRIDGE.mu)
    line = ["respond", "elcentro_1940_ns.csv", "--block", "refrigerator", "--runs", "2", "--json", "--quiet"]
    for more, known in (([], [0.15, 0.5]), (["--mu", "0.4"], None)):
        told = json.loads(CliRunner().invoke(main, [*line, *more]).stdout)["results"][0]["probability"]["ranges"]
        assert told["mu"] == known and told["width_m"] == [0.6, 0.75]


def test_the_terminal_says_where_versions_come_from():
    """`rock` and `respond`: each number once, its range or the usual share, never both; of one stone and of a pile."""
    record = ("synthetic_jma.csv", "--window", "25:28", "--component", "NS", "--block", "refrigerator")
    for words in (("rock", *record, "--perturb", "3"), ("respond", *record, "--runs", "3")):
        said = " ".join(CliRunner().invoke(main, [*words, "--quiet"]).stdout.split())
        assert "width 0.6 to 0.75 m, height 1.6 to 1.9 m, edges 0.02 to 0.06 m in, " in said and "±5 %, edges" not in said
    for words, told in (
        (("rock", *record[:-1], "bookcase", "--perturb", "3"), "varied: width ±5 %, height 0.7366 to 2.064 m, edges worn by 0 to 10 % of"),
        (
            ("respond", *record[:-1], "bookcase", "--runs", "3"),
            "alone: width ±5 %, height 0.7366 to 2.064 m, edges worn by 0 to 10 % of the",
        ),
        (("respond", *record[:-1], "statue", "--runs", "3"), "width 0.4 to 0.6 m, height 1.4 to 2.2 m, edges worn by 0 to 10 % of the"),
    ):
        said = " ".join(CliRunner().invoke(main, [*words, "--quiet"]).stdout.split())
        assert told in said and said.count("friction ±") == 0


def test_wider_ranges_scatter_more():
    """The dispersion that is not known of a bookcase of any height is more than that of sizes known to 5 %."""
    suite = ["synthetic_jma.csv", "elcentro_1940_ns.csv"]
    case = load_block("bookcase")
    bodies = {"any": case, "one": case.known("width_m", "height_m", "inset_m", "mu")}
    study = run_fragility(suite, bodies, "rock", im="pgv", perturb=12, steps=12, bootstrap=2)
    wide, narrow = study.curves
    assert wide.dispersion.beta_parameter > 1.5 * narrow.dispersion.beta_parameter
    (told,) = (note for note in study.notes if note.startswith("any: its versions lie within its own ranges"))
    assert "height 0.7366 to 2.064 m" in told and "mu" not in told
    assert not any("one: its versions" in note for note in study.notes)


@pytest.mark.parametrize(
    ("lines", "says"),
    [
        ('width = ["50cm", "55cm"]', "width is 0.6 in the body, outside its range of 0.5 to 0.55"),
        ('width = ["70cm", "50cm"]', "width is 0.6 in the body, outside its range"),
        ('width = ["60cm"]', "width must be a list of 2 values"),
        ("mu = 0.3", "mu must be a list of 2 numbers"),
        ("weight = [1, 2]", "unknown entries weight"),
        ('inset = ["0cm", "40cm"]\nwidth = ["60cm", "70cm"]', "an inset of 0.4 m leaves nothing of a width of 0.6 m"),
        ("mu = [0.0, 0.5]", "the range of mu must be positive"),
    ],
)
def test_ranges_that_make_no_sense_are_refused(lines, says, tmp_path):
    """One sentence, with the file's name."""
    path = tmp_path / "thing.toml"
    path.write_text(FILE + lines)
    with pytest.raises(BodyError, match=says) as refused:
        load_block(path)
    assert "thing.toml" in str(refused.value)
