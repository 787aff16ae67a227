"""``seisblock respond``: what happened, how sure it is, and the contract of its document."""

import json
import re
import shlex

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.bodies.block import Block
from seisblock.cli import main
from seisblock.models.respond import solve_respond
from seisblock.models.respond.describe import describe
from seisblock.models.respond.plot import figure
from seisblock.output.units_display import length_unit
from seisblock.records import Motion
from seisblock.report.text.respond import format_signed, probability_sentence
from seisblock.studies.respond.probability import ParameterVariation, Probability

CABINET = ("--width", "45cm", "--height", "180cm", "--mu", "0.3")
KEYS = {
    "component", "outcome", "overturned", "overturned_towards", "overturning_time_s", "max_rotation_rad", "max_rotation_ratio",
    "final_displacement_m", "max_displacement_m", "slip_path_m", "flights", "impacts", "time_in_mode_s", "energy_friction_j",
    "energy_impacts_j", "sensitive", "events", "probability",
}  # fmt: skip


def run(*words):
    """Run the command."""
    return CliRunner().invoke(main, ["respond", *(str(word) for word in words)])


def answer(*words):
    """Return its document."""
    result = run(*words, "--json")
    assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout)


def test_respond_document_has_contract_keys():
    """Every key of the contract, events from time 0, modes and corners by their names."""
    document = answer(*CABINET, "--runs", "10")
    assert document["schema"].startswith("seisblock/respond/")
    for result in document["results"]:
        assert set(result) >= KEYS
        assert set(result["time_in_mode_s"]) == {"rest", "slide", "rock", "slide_rock", "flight"}
        assert set(result["probability"]) >= {"runs", "overturned", "moved", "interval"}
        assert result["events"][0]["time_s"] == 0.0
        for event in result["events"]:
            assert event["mode"] in {"rest", "slide", "rock", "slide-rock", "flight", "overturned"}
            assert event["corner"] in {"left", "right", None} and event["slip"] in {"+", "-", None}


def test_respond_prints_outcome_then_probability():
    """Class and probability, the single run, the interval of the share, then the table."""
    lines = run("elcentro_1940_ns", *CABINET[:4], "--mu", "0.1", "--runs", "20", "--quiet").stdout.splitlines()
    assert re.match(r"NS: moves \(overturning 0 %; factor to overturning \d\.\d\d-\d\.\d\d by model\)$", lines[0])
    assert lines[1].startswith("NS: slides ") and "no rocking" in lines[1] + lines[2]
    assert any("20 samples" in line for line in lines[2:5])


@pytest.mark.parametrize("words", [("--width", "60cm", "--height", "60cm", "--mu", "1.2"), ("--block", "gravestone")])
def test_respond_of_weak_record_reports_no_motion(words, tmp_path):
    """A weak record: the sentence states no motion, and no displacement is minus zero."""
    output = " ".join(run("elcentro_1940_ns", *words, "--scale", "0.1", "--runs", "5", "--quiet").stdout.split())
    assert (
        re.search("NS: remains at rest; (rocking|sliding) threshold ", output)
        and "Overturning probability 0 % (95 % CI 0-52 %, 5 samples); overturning or residual displacement above" in output
        and "-0.0" not in output
    )


def test_respond_bundled_bodies_have_friction():
    """Block, two-layer block and pile of the samples, each as one rigid body."""
    for name, mu in (("gravestone", 0.438), ("chozusha", 0.18), ("lantern", 0.6)):
        document = answer("elcentro_1940_ns", "--block", name, "--runs", "0")
        assert document["parameters"]["mu"] == mu
        assert "probability" not in document["results"][0]


def test_respond_surface_sets_friction_with_source():
    """--surface takes friction from the table and states the source."""
    result = run("elcentro_1940_ns", "--width", "45cm", "--height", "180cm", "--surface", "wood/stone", "--runs", "0")
    assert "mu 0.18, kinetic 0.17" in result.stderr and "Sugimoto2017" in result.stderr


ELSEWHERE = (
    (("jump", "elcentro_1940_ns", "--tenon", "2cm", "--target-pga", "900"), "with friction and tenons: "),
    (("jump", "--component", "EW", "--width", "2", "--heights", "1,2", "--masses", "900,100", "--mu", "0.3", "--tenon", "1cm"), "tenons: "),
    (("rock", "elcentro_1940_ns", "--width", "24cm", "--height", "80cm", "--mu", "0.2"), "sliding and rocking: "),
    (("rock", "elcentro_1940_ns", "--block", "gravestone", "--mu", "0.2"), "sliding and rocking: "),
)


@pytest.mark.parametrize(("words", "before"), ELSEWHERE, ids=[" ".join(words[:3]) for words, _ in ELSEWHERE])
def test_jump_and_rock_suggest_working_respond_command(words, before, monkeypatch):
    """Jump and rock with too little friction: the line that they print runs, on the same record and the same body."""
    monkeypatch.setenv("COLUMNS", "400")
    output = CliRunner().invoke(main, list(words)).stdout
    typed = shlex.split(output.split(before)[1].splitlines()[0])
    assert typed[:2] == ["seisblock", "respond"]
    document = answer(*typed[2:], "--runs", "0")
    assert [result["component"] for result in document["results"]] == (["EW"] if "EW" in words else ["NS"])


def test_slide_warns_of_slender_bodies(monkeypatch):
    """Below b/h = mu a body rocks; what nothing moves needs no word."""
    monkeypatch.setenv("COLUMNS", "400")
    output = CliRunner().invoke(main, ["slide", "elcentro_1940_ns", "--mu", "0.2"]).stdout
    assert "above 0.2. Other objects: seisblock respond elcentro_1940_ns --width B --height H --mu 0.2" in output
    assert "respond" not in CliRunner().invoke(main, ["slide", "elcentro_1940_ns", "--mu", "0.6"]).stdout


BAD = (
    (("--width", "45cm", "--height", "180cm"), "friction required"),
    ((*CABINET[:4], "--mu", "-0.1"), "mu|friction"),
    ((*CABINET, "--mu-kinetic", "0.5"), "kinetic"),
    ((*CABINET, "--restitution", "1"), "restitution"),
    ((*CABINET, "--rocking-restitution", "1.5"), "restitution"),
    ((*CABINET, "--centroid-offset", "30cm"), "above the base"),
    ((*CABINET, "--surface", "granite/granite"), "exclude each other"),
    (("--width", "45cm", "--height", "180cm", "--surface", "a/b"), "available: "),
    ((*CABINET, "--runs", "-1"), "runs"),
    ((*CABINET, "--moved", "0"), "positive"),
    ((*CABINET, "--vary-size", "2"), "spread"),
    (("elcentro_1940_ns", *CABINET, "--vertical"), "vertical"),
    (("elcentro_1940_ns", *CABINET, "--component", "all-azimuths"), "two horizontal"),
)


@pytest.mark.parametrize(("words", "message"), BAD, ids=[" ".join(words[-2:]) for words, _ in BAD])
def test_respond_reports_bad_input_in_one_sentence(words, message):
    """Exit 2 or 3, one line, no traceback."""
    result = run(*words)
    assert result.exit_code in (2, 3), result.output
    assert re.search(message, result.stderr) and "Traceback" not in result.output


def test_respond_writes_figure_history_and_animation(tmp_path):
    """Figure, history and film are written; the history holds the modes."""
    csv, plot, film = (tmp_path / name for name in ("a.csv", "a.png", "a.html"))
    result = run("elcentro_1940_ns", *CABINET, "--runs", "0", "--csv", csv, "--plot", plot, "--animate", film)
    assert result.exit_code == 0, result.stderr
    header, *rows = csv.read_text().splitlines()
    assert header.split(",")[-1] == "phase" and {row.split(",")[-1] for row in rows} >= {"rest", "rock"}
    assert plot.read_bytes().startswith(b"\x89PNG") and "<html" in film.read_text()


def test_respond_writes_zero_without_sign():
    """A quantile of a quarter of a millimetre is 0, not -0.0 cm."""
    unit = length_unit([0.0123], gal=True)
    assert [format_signed(value, unit) for value in (-2e-4, 4e-4, -6e-4, 0.0123)] == ["0", "0", "-0.1 cm", "+1.2 cm"]


def test_respond_figure_omits_invisible_hops():
    """A lift of a thousandth of a millimetre is no curve; one of a centimetre is."""
    motion = Motion.from_arrays(5.0 * np.sin(0.12 * np.arange(300)), 0.01, name="NS")
    low = solve_respond(Block(0.3, 0.9), Motion.from_arrays(0.67 * motion.horizontal, 0.01, name="NS"), mu=0.9, restitution=0.05)
    high = solve_respond(Block(0.3, 0.9), motion, mu=0.9, restitution=0.7)
    assert 0.0 < low["lift"].max() < 1e-4 < high["lift"].max()
    labels = [[axis.get_ylabel() for axis in figure([item]).axes] for item in (low, high)]
    assert ["uplift (cm)" in label for label in labels] == [False, True]


def test_respond_figure_has_panels_of_actual_motion_only():
    """At rest there is the ground alone, a slider has no lean; beside one that rocks each column keeps to its own, with a clock below."""
    motion = Motion.from_arrays(3.0 * np.sin(0.1 * np.arange(700)), 0.01, name="NS")
    rests, slides, rocks = (solve_respond(Block(width, 0.9), motion, mu=mu) for width, mu in ((0.9, 0.9), (0.9, 0.1), (0.2, 0.9)))

    def panels(*responses):
        """Return the panels but the strips above them, and what each shows."""
        axes = [axis for axis in figure(responses).axes if axis.get_ylabel()]
        return axes, [axis.get_ylabel().split()[0] for axis in axes]

    assert [panels(item)[1] for item in (rests, slides, rocks)] == [["a"], ["a", "x"], ["a", "x", "θ/α"]]
    axes, labels = panels(rests, rocks)
    assert labels == ["a", "a", "x", "θ/α"]
    assert [bool(axis.get_xlabel()) for axis in axes] == [True, False, False, True]
    assert axes[0].xaxis.get_tick_params()["labelbottom"]


@pytest.mark.parametrize(
    ("mu", "names"),
    [
        (0.55, ["off scale: rocking threshold 5990 gal", "sliding threshold"]),
        (0.9, ["off scale: rocking threshold 9810 gal, sliding threshold 883 gal"]),
        (9.0, ["off scale: rocking threshold 98100 gal, sliding threshold 8830 gal"]),
    ],
    ids=["within sight", "twice the peak", "far away"],
)
def test_respond_legend_names_visible_lines_only(mu, names):
    """A resting body has its factor to the threshold; thresholds outside the figure are given in words, without a line."""
    motion = Motion.from_arrays(3.0 * np.sin(0.1 * np.arange(700)), 0.01, name="NS")
    (axis,) = figure([solve_respond(Block(10.0 * mu, 0.9), motion, mu=mu)]).axes
    assert axis.get_legend_handles_labels()[1] == names
    assert axis.get_ylim()[1] == pytest.approx(1.15 * max(300.0, 100.0 * 9.80665 * mu if mu < 0.6 else 0.0), rel=1e-3)


def test_respond_all_azimuths_reports_worst(tmp_path):
    """all-azimuths answers for the worst one and lists them all."""
    document = answer("synthetic_jma", "--width", "45cm", "--height", "180cm", "--mu", "0.3", "--component", "all-azimuths", "--runs", "0")
    (result,) = document["results"]
    assert len(result["directions"]) == 36 and float(result["component"]) == result["directions"][0]["azimuth_deg"]


def test_respond_reports_overturning_after_record(tmp_path):
    """A push that ends the record lets the body fall on still ground, at a time that the record does not have."""
    push = tmp_path / "push.csv"
    rows = [f"{0.01 * i:.2f},{4.5 * np.sin(np.pi * (i - 100) / 80) if i >= 100 else 0.0:.6f}" for i in range(160)]
    push.write_text("time,NS (m/s2)\n" + "\n".join(rows) + "\n")
    words = (push, "--width", "30cm", "--height", "100cm", "--mu", "0.6", "--runs", "0", "--quiet")
    assert re.search(r"NS: overturns to -NS at 2\.\d\d s, after the end of the record", run(*words).stdout)
    assert (
        "record"
        not in run("elcentro_1940_ns", *CABINET[:4], "--mu", "0.6", "--scale", "4", "--runs", "0", "--quiet").stdout.splitlines()[0]
    )


def test_respond_slides_at_friction_equal_to_slenderness():
    """At mu = b/h the closed form of initiation slides, as do the body and the table."""
    words = ("--width", "50cm", "--height", "100cm", "--mu", "0.5", "--runs", "0", "--quiet", "--component", "NS", "--no-vertical")
    output = run(*words).stdout
    assert "slides first, above 490 gal" in output and "no rocking" in output


def test_respond_with_tenons_rocks_at_any_friction():
    """A body on tenons rocks first at any friction, in verdict, table and figure."""
    motion = Motion.from_arrays(1.8 * np.sin(0.1 * np.arange(700)), 0.01, name="NS")
    holding, free = (solve_respond(Block(0.5, 1.0), motion, mu=0.2, tenon=tenon) for tenon in (0.02, 0.0))
    assert describe(holding) == "NS: remains at rest; rocking threshold 490.3 gal (2.72 times this record's PGA)."
    assert describe(free) == "NS: remains at rest; sliding threshold 196.1 gal (1.09 times this record's PGA)."
    levels = [figure([result]).axes[0].get_legend_handles_labels()[1] for result in (holding, free)]
    assert "sliding threshold" in levels[1] and "sliding threshold" not in "".join(levels[0])
    words = ("--width", "50cm", "--height", "100cm", "--mu", "0.2", "--tenon", "2cm", "--runs", "0", "--quiet", "--component", "NS")
    output = " ".join(run(*words).stdout.split())
    assert "tenons 2.0 cm; out of the mortises: mu 0.2, kinetic 0.2; rocks first, above 490 gal" in output


@pytest.mark.parametrize(
    ("fallen", "begins"),
    [
        (0, "Overturning probability 0 % (95 % CI 0-30 %, 20 samples);"),
        (1, "Overturning probability 5 % (95 % CI 0-30 %, 20 samples);"),
        (2, "Overturning probability 10 % (95 % CI 0-30 %, 20 samples);"),
    ],
)
def test_probability_sentence_begins_with_probability_interval_and_samples(fallen, begins):
    """Result first, then its interval and the number of samples."""
    result = Probability(20, fallen / 20, 0.5, (0.0, 0.3), 0.01, {"q05": 0.0, "q95": 0.0}, ParameterVariation(), 0)
    assert probability_sentence(result).startswith(begins)


@pytest.mark.parametrize(
    ("q05", "q95", "ends"),
    [
        (-0.0004, 0.0002, "no residual displacement in 90 % of the samples without overturning."),
        (-0.02, 0.0002, "of 90 % of the samples without overturning -2.0 cm to 0."),
    ],
)
def test_respond_omits_quantiles_below_half_millimetre(q05, q95, ends):
    """Quantiles of less than half a millimetre are no interval to tell."""
    result = Probability(40, 0.1, 0.5, (0.0, 0.3), 0.01, {"q05": q05, "q95": q95}, ParameterVariation(), 0)
    assert probability_sentence(result).endswith(ends)


@pytest.mark.parametrize(
    ("inset", "worn"),
    [
        ("0", "sharp edges"),
        ("0.3", "edge wear 27 % to 33 % of the width"),
        ("0.48", "edge wear 46 % to 50 % of the width"),
    ],
)
def test_respond_varies_given_inset_about_itself(inset, worn):
    """As far as a fifth of the base is left: a stone worn almost to nothing is no error."""
    result = run("elcentro_1940_ns", *CABINET, "--inset", inset, "--runs", "5", "--quiet")
    assert result.exit_code == 0, result.stderr
    assert f"±5 %, {worn}, friction" in " ".join(result.stdout.split())


@pytest.mark.parametrize("text", [("--seed", "3"), ("--moved", "2cm"), ("--vary-size", "0.1"), ("--vary-azimuth", "5")])
def test_respond_rejects_sampling_options_without_samples(text):
    result = run("elcentro_1940_ns", *CABINET, "--runs", "0", *text)
    assert (result.exit_code, result.stdout) == (3, "")
    assert f"{text[0]} has no effect without samples: give --runs" in result.stderr
