"""Shaking of a motion for one body: closed forms, brute force, symmetry, and thresholds at which the models really start to move."""

import json
import math

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.bodies.block import Block
from seisblock.bodies.pile.pile import Pile
from seisblock.bodies.pile.stone import PileStone
from seisblock.bodies.pile.toml import load_pile
from seisblock.bodies.sliding_base import SlidingBase
from seisblock.bodies.spring_block import SpringBlock
from seisblock.bodies.toml import read_body_toml
from seisblock.bodies.two_layer import Contact, two_layer_from_table
from seisblock.cli import main
from seisblock.core.registry import get_solver, solver_names
from seisblock.measures import duration_above, measure
from seisblock.measures.shaking import Thresholds, body_thresholds, response_shaking, shaking_of, shakings_of, transverse_shaking
from seisblock.models.jump.options import JumpOptions
from seisblock.models.respond.options import RespondOptions
from seisblock.models.rigid3d.options import Rigid3dOptions
from seisblock.models.rock.options import RockOptions
from seisblock.models.rock.solve import solve_rock
from seisblock.models.slide.options import SlideOptions
from seisblock.models.stack.options import StackOptions
from seisblock.models.uplift.options import UpliftOptions
from seisblock.readers import read
from seisblock.records import Motion, motion_of

GRAVITY = 9.80665
KEYS = ("pga_m_s2", "pgv_m_s", "equivalent_frequency_hz", "threshold_m_s2", "time_above_threshold_s", "longest_above_threshold_s")

LOPSIDED = Block(0.4, 1.2, centroid_offset=0.05, centroid_height=0.55)
"""Block whose thresholds differ: its right corner is nearer to the centre of gravity."""


def _sine(amplitude, frequency, periods, per_period=4000):
    time = np.arange(periods * per_period + 1) / (per_period * frequency)
    return Motion.from_arrays(amplitude * np.sin(2.0 * np.pi * frequency * time), time[1])


def _brute_force(motion, thresholds, parts=2000):
    """Return total time and longest interval from samples of the interpolated record, `parts` per interval."""
    time = np.arange(motion.samples - 1)[:, np.newaxis] + (np.arange(parts) + 0.5) / parts
    a = np.interp(time.ravel(), np.arange(motion.samples), motion.horizontal)
    step, total, longest = motion.dt / parts, 0.0, 0.0
    for is_above in (-a >= thresholds[0], a >= thresholds[1]):
        edges = np.flatnonzero(np.diff(np.concatenate(([False], is_above, [False])).astype(int)))
        lengths = (edges[1::2] - edges[::2]) * step
        total, longest = total + lengths.sum(), max(longest, lengths.max(initial=0.0))
    return total, longest


@pytest.mark.parametrize("share", (0.1, 0.5, 0.9, 0.99))
def test_time_above_threshold_of_sine_is_arc_cosine(share):
    """A sine exceeds the share s of its amplitude for (2/pi) acos(s) of the time, in two equal intervals per cycle."""
    shaking = shaking_of(_sine(3.0, 1.5, 6), (3.0 * share, 3.0 * share))
    fraction = 2.0 / math.pi * math.acos(share)
    assert shaking.time_above_threshold_s == pytest.approx(fraction * 6 / 1.5, rel=2e-5)
    assert shaking.longest_above_threshold_s == pytest.approx(fraction / 2 / 1.5, rel=2e-5)
    assert shaking.threshold_m_s2 == 3.0 * share


def test_time_above_asymmetric_thresholds_adds_one_side_each():
    motion = _sine(3.0, 2.0, 4)
    right, left = shaking_of(motion, (1.0, math.inf)), shaking_of(motion, (math.inf, 2.0))
    shaking = shaking_of(motion, (1.0, 2.0))
    assert shaking.time_above_threshold_s == pytest.approx(right.time_above_threshold_s + left.time_above_threshold_s, abs=1e-12)
    assert shaking.longest_above_threshold_s == right.longest_above_threshold_s > left.longest_above_threshold_s
    assert (right.threshold_m_s2, left.threshold_m_s2, shaking.threshold_m_s2) == (1.0, 2.0, 1.0)


def test_motion_to_right_belongs_to_ground_acceleration_to_left():
    push = Motion.from_arrays([0.0, 2.0, 2.0, 0.0], 0.1)
    assert shaking_of(push, Thresholds(right=1.0, left=3.0)).time_above_threshold_s == 0.0
    assert shaking_of(push, Thresholds(right=3.0, left=1.0)).time_above_threshold_s == pytest.approx(0.2)


@pytest.mark.parametrize("thresholds", ((0.7, 1.3), (1.3, 0.7), (0.2, 2.5)))
def test_time_above_threshold_matches_fine_grid(thresholds):
    motion = Motion.from_arrays(np.random.default_rng(5).normal(size=400), 0.01)
    shaking = shaking_of(motion, thresholds)
    total, longest = _brute_force(motion, thresholds)
    assert shaking.time_above_threshold_s == pytest.approx(total, abs=2e-3)
    assert shaking.longest_above_threshold_s == pytest.approx(longest, abs=2e-5)


def test_mirrored_motion_and_body_have_the_same_shaking():
    motion = motion_of(read("synthetic_jma.csv"), "EW")
    mirrored = Motion.from_arrays(-motion.horizontal, motion.dt)
    assert shaking_of(mirrored, (1.5, 2.5)) == shaking_of(motion, (2.5, 1.5))
    assert shaking_of(mirrored, (1.5, 2.5)) != shaking_of(motion, (1.5, 2.5))


def test_time_above_threshold_of_parts_adds_up():
    motion = motion_of(read("synthetic_jma.csv"), "NS")
    cut = 2463
    parts = [Motion.from_arrays(part, motion.dt) for part in (motion.horizontal[: cut + 1], motion.horizontal[cut:])]
    total = sum(shaking_of(part, (1.2, 2.0)).time_above_threshold_s for part in parts)
    assert total == pytest.approx(shaking_of(motion, (1.2, 2.0)).time_above_threshold_s, abs=1e-12)


def test_peaks_are_those_of_measure():
    record = read("synthetic_jma.csv")
    for component in measure(record, [c.code for c in record.horizontals]).components:
        shaking = shaking_of(motion_of(record, component.component), (1.0, 1.0))
        assert (shaking.pga_m_s2, shaking.pgv_m_s) == (component.pga_m_s2, component.pgv_m_s)
        assert shaking.equivalent_frequency_hz == component.equivalent_frequency_hz.pga_pgv


@pytest.mark.parametrize("thresholds", ((math.inf, math.inf), (0.0, -1.0)))
def test_shaking_without_threshold_has_peaks_only(thresholds):
    shaking = shaking_of(_sine(2.0, 1.0, 2, 400), thresholds)
    assert shaking.pga_m_s2 == pytest.approx(2.0, rel=1e-4)
    assert shaking.threshold_m_s2 is shaking.time_above_threshold_s is shaking.longest_above_threshold_s is None


@pytest.mark.parametrize("linear", [False, True])
@pytest.mark.parametrize("block", [Block(0.27, 0.78), Block(0.5, 0.9, centroid_offset=0.07)])
def test_rocking_threshold_of_shaking_is_that_of_the_outcome(block, linear):
    """Bit by bit, of the linearised equation, too, which starts at g alpha; `batch` has one column for both."""
    response = solve_rock(block, Motion.from_arrays([0.0, 5.0, 0.0], 0.1), linear=linear)
    assert response_shaking(response).threshold_m_s2 == response.outcome.threshold_m_s2


def test_threshold_does_not_depend_on_vertical_motion():
    """The threshold is the nominal one; a vertical motion changes the response, not the shaking."""
    rows = np.random.default_rng(1).normal(size=(2, 300))
    level = solve_rock(LOPSIDED, Motion.from_arrays(rows[0], 0.01))
    lifted = solve_rock(LOPSIDED, Motion.from_arrays(rows[0], 0.01, vertical=2.0 * rows[1]), vertical=True)
    assert lifted.outcome != level.outcome
    assert response_shaking(lifted) == response_shaking(level)


TWO_STONES = Pile("two", (PileStone("base", 1.0, 1.0, 0.3), PileStone("top", 0.3, 0.3, 0.9, on="base", offset=(0.1, 0.0))), mu=0.8)
CASES = {
    "rock": (LOPSIDED, RockOptions(), lambda outcome: outcome.rocks),
    "respond": (LOPSIDED, RespondOptions(mu=0.7), lambda outcome: outcome.outcome != "rests"),
    "respond, slipping": (LOPSIDED, RespondOptions(mu=0.15), lambda outcome: outcome.outcome != "rests"),
    "slide": (SlidingBase(0.3), SlideOptions(), lambda outcome: outcome.slips),
    "slide, slope": (SlidingBase(0.5, slope_deg=12.0), SlideOptions(gravity=9.0), lambda outcome: outcome.slips),
    "slide, uphill": (SlidingBase(0.5, slope_deg=-12.0), SlideOptions(), lambda outcome: outcome.slips),
    "jump": (
        two_layer_from_table(read_body_toml("chozusha"), "short"),
        JumpOptions(contact=Contact(mu=0.6)),
        lambda outcome: bool(outcome.chains),
    ),
    "uplift": (
        SpringBlock.from_frequency(0.8, 0.5, 2.0, frequency_vertical=40.0, beta=0.6),
        UpliftOptions(),
        lambda outcome: outcome.uplifts,
    ),
    "stack": (TWO_STONES, StackOptions(), lambda outcome: outcome.stones[1].max_tilt_rad > 1e-7),
    "rigid3d": (LOPSIDED, Rigid3dOptions(mu=0.7), lambda outcome: outcome.max_tilt_rad > 1e-7),
    "rigid3d, slipping": (LOPSIDED, Rigid3dOptions(mu=0.15), lambda outcome: outcome.max_displacement_m > 1e-7),
}


def test_every_solver_has_a_case():
    assert {name.partition(",")[0] for name in CASES} == set(solver_names())


@pytest.mark.parametrize("sign", (-1.0, 1.0))
@pytest.mark.parametrize("name", CASES)
def test_model_starts_to_move_at_its_threshold(name, sign):
    """A slow ramp that ends 0.5 % below the threshold of its side leaves the body at rest; 0.5 % above, it moves."""
    body, options, moves = CASES[name]
    solver = get_solver(name.partition(",")[0])
    right, left = body_thresholds(solver.name, body, options)
    threshold = right if sign < 0.0 else left
    assert 0.0 < threshold < 20.0
    shape = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, 2001))
    for factor in (0.995, 1.005):
        motion = Motion.from_arrays(sign * factor * threshold * shape, 0.005)
        response = solver.solve(body, motion, **options.keywords())
        assert moves(response.outcome) == (factor > 1.0)
        shaking = response_shaking(response)
        assert (shaking.time_above_threshold_s > 0.0) == (factor > 1.0)
        assert shaking.threshold_m_s2 == pytest.approx(min(right, left), rel=1e-12)


NARROW = {
    "stack": (Pile("narrow", (PileStone("slab", 1.0, 1.0, 0.3), PileStone("top", 0.5, 0.3, 0.9, on="slab")), mu=0.8), StackOptions()),
    "rigid3d": (Block(0.5, 0.9, depth=0.3), Rigid3dOptions(mu=0.8)),
}
"""Bodies that are weaker along y than along +x."""


@pytest.mark.parametrize("name", NARROW)
@pytest.mark.parametrize("factor", (0.995, 1.005))
def test_spatial_model_starts_to_move_at_its_transverse_threshold(name, factor):
    """Motion along +y only, up to 0.5 % below and above g b/h of the depth."""
    body, options = NARROW[name]
    shape = factor * GRAVITY * 0.3 / 0.9 * (0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, 2001)))
    motion = Motion(np.stack([0.0 * shape, shape, 0.0 * shape]), 0.005)
    response = get_solver(name).solve(body, motion, **options.keywords())
    shaking = transverse_shaking(response)
    assert shaking.threshold_m_s2 == pytest.approx(GRAVITY * 0.3 / 0.9)
    assert shaking.pga_m_s2 == pytest.approx(shape.max())
    assert (shaking.time_above_threshold_s > 0.0) == (factor > 1.0)
    tilt = response.outcome.max_tilt_rad if name == "rigid3d" else response.outcome.stones[-1].max_tilt_rad
    assert (tilt > 1e-7) == (factor > 1.0)


def test_transverse_shaking_belongs_to_spatial_models_with_transverse_motion():
    motion = Motion.from_arrays([0.0, 1.0, 0.0, 0.0], 0.1)
    body, options = NARROW["rigid3d"]
    assert transverse_shaking(get_solver("rigid3d").solve(body, motion, **options.keywords())) is None
    across = Motion(np.array([[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]]), 0.1)
    assert transverse_shaking(solve_rock(LOPSIDED, across)) is None


def test_one_way_slide_has_a_threshold_to_one_side_only():
    base = SlidingBase(0.3, one_way=True)
    right, left = body_thresholds("slide", base, SlideOptions())
    assert right == pytest.approx(0.3 * GRAVITY)
    assert left == math.inf


def test_steep_slope_holds_uphill_at_any_acceleration():
    """Uphill slip needs an angle of the resultant of slope plus friction angle, which no acceleration reaches from 90 degrees on."""
    base = SlidingBase(1.5, slope_deg=40.0)
    right, left = body_thresholds("slide", base, SlideOptions())
    assert right == pytest.approx(GRAVITY * math.tan(math.atan(1.5) - math.radians(40.0)))
    assert left == math.inf


def test_tenons_leave_rocking_as_the_only_threshold():
    assert body_thresholds("respond", LOPSIDED, RespondOptions(mu=0.1, tenon=0.02)) == pytest.approx(
        [GRAVITY * arm / LOPSIDED.centre for arm in LOPSIDED.arms]
    )


def test_pile_threshold_is_that_of_its_weakest_part():
    lantern = load_pile("lantern")
    right, left = body_thresholds("stack", lantern, StackOptions())
    assert right == pytest.approx(left, rel=1e-9)
    single = min(0.5 * (s.width - 2.0 * s.insets()[0]) / (0.5 * s.height) for s in lantern.stones) * GRAVITY
    assert right < single
    slippery = load_pile("lantern", mu=0.05)
    assert body_thresholds("stack", slippery, StackOptions())[0] == pytest.approx(0.05 * GRAVITY)


def test_points_within_the_joint_lower_the_threshold_of_a_pile():
    """Five points along a side stand at 0.8 of the half width ([Furukawa2009])."""
    pile = Pile("one", (PileStone("stone", 0.3, 0.3, 1.2),), mu=1.0)
    assert body_thresholds("stack", pile, StackOptions(points=2))[0] == pytest.approx(GRAVITY * 0.25)
    assert body_thresholds("stack", pile, StackOptions(points=5))[0] == pytest.approx(GRAVITY * 0.25 * 0.8)


def _document(line):
    result = CliRunner().invoke(main, [*line.split(), "--json"])
    assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout)


@pytest.mark.parametrize(
    "line",
    (
        "slide --mu 0.2",
        "rock --width 24cm --height 72cm",
        "jump",
        "respond --width 45cm --height 180cm --mu 0.3 --runs 0",
        "uplift --width 1.2 --height 3 --frequency-vertical 8",
        "stack --window 24:26.5 --runs 0",
        "criteria --block gravestone",
    ),
)
def test_every_result_has_shaking(line):
    for result in _document(line)["results"]:
        assert tuple(result["shaking"]) == KEYS
        assert result["shaking"]["time_above_threshold_s"] > result["shaking"]["longest_above_threshold_s"] > 0.0


def test_shaking_of_a_command_is_that_of_measure():
    measured = _document("measure --width 24cm --height 72cm synthetic_jma")["results"]
    rocked = _document("rock --width 24cm --height 72cm synthetic_jma")["results"]
    by_name = {result["component"]: result for result in measured}
    for result in rocked:
        shaking, row = result["shaking"], by_name[result["component"]]
        assert shaking["pgv_m_s"] == row["pgv_m_s"]
        assert shaking["threshold_m_s2"] == pytest.approx(row["duration"]["threshold_m_s2"])
        assert shaking["time_above_threshold_s"] == pytest.approx(row["duration"]["total_s"], abs=1e-9)
        assert shaking["longest_above_threshold_s"] == pytest.approx(row["duration"]["longest_s"], abs=1e-9)


@pytest.mark.parametrize("lang,text", (("en", "above the threshold of 196.1 gal for"), ("ja", "開始加速度 196.1 gal の超過時間")))
def test_tables_print_a_line_per_direction(lang, text):
    result = CliRunner().invoke(main, ["slide", "--mu", "0.2", "--lang", lang], env={"COLUMNS": "200"})
    assert result.exit_code == 0
    assert result.stdout.count(text) == 2


def test_shakings_of_many_bodies_equal_those_of_each():
    """Thresholds of both sides, none, equal ones, and ones at and beyond the peak; the motion begins and ends above some of them."""
    rng = np.random.default_rng(5)
    for values in (np.round(3.0 * rng.normal(size=400)), np.convolve(rng.normal(size=3000), np.hanning(21), "same"), np.full(7, 2.0)):
        motion = Motion.from_arrays(values, 0.01)
        peak = float(np.abs(values).max())
        thresholds = [
            (math.inf, math.inf),
            (peak, peak),
            (1.0, 1.0),
            (1.0, 2.0),
            (-1.0, 1.0),
            *(rng.uniform(0.01, 1.1 * peak, (40, 2)).tolist()),
        ]
        shakings = shakings_of(motion, thresholds)
        assert shakings == [shaking_of(motion, pair) for pair in thresholds]
        for (right, left), shaking in zip(thresholds[2:4], shakings[2:4], strict=True):
            sides = duration_above(values, 0.01, right, side="negative"), duration_above(values, 0.01, left, side="positive")
            assert shaking.time_above_threshold_s == pytest.approx(sum(side.total_s for side in sides), abs=1e-12)
            assert shaking.longest_above_threshold_s == max(side.longest_s for side in sides)
