"""``seisblock rock`` reports overturning and its margin in a table, a document, a file and a figure."""

import csv
import json
import math
import re

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.cli import main

KEYS = {
    "component",
    "rocks",
    "rocking_start_s",
    "max_rotation_rad",
    "max_rotation_ratio",
    "impacts",
    "overturned",
    "overturning_time_s",
    "alpha_passed_s",
    "decided_after_record",
    "slenderness_rad",
    "frequency_parameter_rad_s",
    "restitution",
    "threshold_m_s2",
    "max_friction_demand",
    "max_friction_demand_s",
    "contact_lost",
    "contact_lost_s",
    "verdict_flips_within_2_percent",
    "flips_at_factor",
}


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Return a function that runs the command in an empty directory."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "100")
    return lambda *words: CliRunner().invoke(main, ["rock", *map(str, words)])


@pytest.fixture
def pulse(tmp_path):
    """A half sine of 500 gal and 1 s to the north, nothing to the east, 20 s."""
    t = np.arange(2001) * 0.01
    north = np.where(t <= 1, 500 * np.sin(np.pi * t), 0.0)
    path = tmp_path / "pulse.csv"
    rows = np.column_stack([t, north, 0 * t, 0 * t])
    np.savetxt(path, rows, delimiter=",", header="time,NS (gal),EW (gal),UD (gal)", comments="", fmt="%.17g")
    return path


def test_rock_document_has_result_per_component(run, pulse):
    """One result per component with the keys everyone relies on; north overturns to -x, east stands still."""
    output = json.loads(run(pulse, "--width", "24cm", "--height", "80cm", "--json").stdout)
    assert output["schema"] == "seisblock/rock/1"
    north, east = output["results"]
    assert set(north) >= KEYS
    assert (north["component"], east["component"]) == ("NS", "EW")
    assert north["overturned"] is True
    assert north["overturned_towards"] == "-x"
    start = math.asin(980.665 * 0.3 / 500) / math.pi
    assert north["rocking_start_s"] == pytest.approx(start, abs=2e-5)
    assert north["rocking_start_s"] < north["alpha_passed_s"] < north["overturning_time_s"] < 2
    assert north["max_rotation_rad"] == pytest.approx(math.pi / 2)
    assert north["restitution"] == pytest.approx(1 - 1.5 * math.sin(math.atan(0.3)) ** 2)
    assert east["rocks"] is east["overturned"] is False
    assert east["rocking_start_s"] is east["overturning_time_s"] is None
    assert east["impacts"] == 0
    assert "Housner1963" in output["citations"]


def test_rock_sizes_in_sun_equal_bundled_gravestone(run, pulse):
    """8 sun by 20.8 sun, edges worn by a twentieth per side: the bundled gravestone, but for the tolerance of the given inset."""
    sizes = json.loads(run(pulse, "--width", "8sun", "--height", "20.8sun", "--inset", "5%", "--json").stdout)
    output = json.loads(run(pulse, "--block", "gravestone", "--json").stdout)
    for one, other in zip(sizes["results"], output["results"], strict=True):
        assert {**one, "assessment": None} == {**other, "assessment": None}
    assert output["parameters"]["block"]["width_m"] == pytest.approx(0.2424)


def test_rock_kind_sets_edge_wear(run, pulse):
    """A gravestone by its sizes equals the bundled one; furniture is sharp; an inset precedes the kind, and a file its own values."""
    sizes = ("--width", "8sun", "--height", "20.8sun", "--perturb", "4", "--json")
    output = json.loads(run(pulse, "--block", "gravestone", "--perturb", "4", "--json").stdout)
    assert json.loads(run(pulse, *sizes, "--kind", "gravestone").stdout)["results"] == output["results"]
    insets = [
        json.loads(run(pulse, *sizes, *extra).stdout)["parameters"]["block"]["inset_m"]
        for extra in ((), ("--kind", "furniture"), ("--kind", "gravestone", "--inset", "1cm"))
    ]
    assert insets == pytest.approx([0.0, 0.0, 0.01])
    refused = run(pulse, "--block", "gravestone", "--kind", "statue")
    assert refused.exit_code == 3 and "--kind has no effect with --block" in refused.stderr


def test_rock_two_layer_body_is_one_rigid_block(run, pulse):
    """The Chozu-sha as one rigid block rocks above g x_G/y_G."""
    centroid = (1303.7 * (1.84 + 0.53) + 160.0 * 0.92) / 1463.7
    output = json.loads(run(pulse, "--block", "chozusha", "--component", "NS", "--json").stdout)
    assert output["results"][0]["threshold_m_s2"] == pytest.approx(9.80665 * 1.04 / centroid, rel=1e-12)


def test_rock_reads_body_file(run, pulse, tmp_path):
    """A TOML body gives sizes with units, an offset centre and its restitution."""
    (tmp_path / "statue.toml").write_text(
        'kind = "block"\nname = "statue"\nwidth = "40cm"\nheight = 1.6\n'
        'centroid_height = "70cm"\ncentroid_offset = 0.05\nrestitution = 0.7\n'
    )
    result = json.loads(run(pulse, "--block", "statue.toml", "--component", "NS", "--json").stdout)["results"][0]
    assert result["restitution"] == 0.7
    assert result["threshold_m_s2"] == pytest.approx(9.80665 * 0.15 / 0.7)


def test_rock_azimuth_180_mirrors_azimuth_0(run, pulse):
    """--azimuth 0 is north; 180 is its mirror image."""
    results = json.loads(run(pulse, "--width", 0.24, "--height", 0.8, "--azimuth", "0,180", "--json").stdout)["results"]
    assert [r["component"] for r in results] == ["0", "180"]
    assert [r["overturned_towards"] for r in results] == ["-x", "+x"]
    assert results[0]["overturning_time_s"] == pytest.approx(results[1]["overturning_time_s"], abs=1e-12)


def test_rock_margin_and_probability_of_pulse(run, pulse):
    """One pulse: stable below one factor, overturning above; the probability is inside its interval."""
    answer = run(pulse, "--width", 0.24, "--height", 0.8, "--component", "NS", "--margin", "--perturb", 50, "--json")
    result = json.loads(answer.stdout)["results"][0]
    first = result["margin"]["windows"][0]
    assert first == {"first": 0.0, "last": result["margin"]["flips"][0], "overturned": False}
    assert result["margin"]["nearest_flip"] < 1
    low, high = result["perturbation"]["probability_interval"]
    assert low <= result["perturbation"]["probability"] <= high
    assert result["perturbation"]["runs"] == 50
    assert result["margin"]["first_fall"] == result["margin"]["flips"][0]
    assert result["perturbation"]["interval_of"] == "parameter variation only"


def test_rock_margin_states_first_overturning_factor(run):
    """It falls from some factor on, the first one found; the share of versions stands beside it, with what was varied (N11, N12)."""
    output = " ".join(
        run("elcentro_1940_ns.csv", "--width", "8sun", "--height", "80cm", "--kind", "gravestone", "--margin", "--details").stdout.split()
    )
    assert "scale factor to overturning 1.13 (smallest of the factors up to 3 in steps of 0.002)" in output
    assert output.index("overturning 1.13") < output.index("overturning at scale factors") < output.index("overturning probability")
    assert ", parameter variation only)." in output
    assert "samples with width and height ±5 %" in output


def test_rock_states_meaning_of_zero_share(run):
    """None of 60 samples overturns: the interval of the headline, one per document, and the meaning for real rocks (N12)."""
    words = ("elcentro_1940_ns.csv", "--width", "40cm", "--height", "80cm", "--perturb", 60)
    output = " ".join(run(*words).stdout.split())
    assert (
        "overturning probability 0 % (0 of 60 samples; 95 % CI 0-6 %, parameter variation only). On shaking tables, 3 % overturned "
        "where no computed sample did." in output
    )
    result = json.loads(run(*words, "--json").stdout)["results"][0]
    assert result["perturbation"]["probability"] == 0.0
    assert result["perturbation"]["probability_interval"] == result["assessment"]["interval"]


def test_rock_first_line_states_insufficient_friction(run):
    """With --mu the verdict states whether rocking needs more friction; without it there is no statement (DESIGN.md section 11)."""
    words = ("synthetic_jma.csv", "--width", "8sun", "--height", "80cm", "--component", "NS")
    for mu, says in ((0.2, "0.2 < b/h = 0.303 the block slides instead of rocking"), (0.32, "with 0.32 the block slides while rocking")):
        text = " ".join(run(*words, "--mu", mu).stdout.split())
        assert says in text
        assert text.index(says) < text.index("rocking start (s)")
        assert json.loads(run(*words, "--mu", mu, "--json").stdout)["results"][0]["friction_suffices"] is False
    assert "the block slides" not in run(*words, "--mu", 2).stdout
    output = json.loads(run(*words, "--mu", 2, "--json").stdout)
    assert (output["results"][0]["friction_suffices"], output["parameters"]["mu"]) == (True, 2.0)
    assert "friction_suffices" not in json.loads(run(*words, "--json").stdout)["results"][0]
    assert run(*words, "--mu", -1).exit_code == 3


def test_rock_names_disagreeing_models(run):
    """One sentence: in how many models it falls, which, and by what factor they are apart (N15)."""
    answer = run("elcentro_1940_ns.csv", "--width", "8sun", "--height", "80cm", "--details")
    output = " ".join(answer.stdout.split())
    assert "NS: overturns in 2 of 5 models: gravestone criterion (0.90), Ishiyama's limits of acceleration and velocity with " in output
    assert "velocity with sharp edges (0.95); does not overturn in the others:" in output
    assert "(largest over smallest 2.0). The gravestone criterion, derived for such objects, predicts overturning." in output
    (result,) = json.loads(run("elcentro_1940_ns.csv", "--width", "8sun", "--height", "80cm", "--json").stdout)["results"]
    assert (result["agreement"]["falls"], result["agreement"]["models"]) == (2, 5)
    assert result["agreement"]["spread"] == pytest.approx(1.98, abs=0.01)


def test_rock_writes_table_figure_and_history(run, pulse, tmp_path):
    """The table has the verdict in words; the files have the figure and the history in SI."""
    answer = run(pulse, "--width", 0.24, "--height", 0.8, "--plot", "rock.png", "--csv", "rock.csv", "--si")
    assert answer.exit_code == 0, answer.output
    first, second, third, *_ = answer.stdout.splitlines()  # the probability first, the single run after it
    assert first == "object: likely overturns (100 %); worst direction NS"
    assert second == "NS: likely overturns (100 %; factor to overturning 0.50-0.71 by model)"
    assert re.match(r"NS: overturns to -NS at \d+\.\d\d s\.$", third)
    assert "EW: remains at rest; rocking threshold 2.9420 m/s²." in answer.stdout
    assert "m/s²" in answer.stdout
    assert (tmp_path / "rock.png").stat().st_size > 10_000
    rows = list(csv.DictReader((tmp_path / "rock.csv").open()))
    assert not any(cell == "-0.0" for row in rows for cell in row.values())
    assert set(rows[0]) == {
        "component",
        "time_s",
        "rotation_rad",
        "angular_velocity_rad_s",
        "ground_acceleration_m_s2",
        "vertical_acceleration_m_s2",
        "phase",
    }
    assert float(rows[-1]["ground_acceleration_m_s2"]) == 0.0
    north = [row for row in rows if row["component"] == "NS"]
    assert float(north[-1]["rotation_rad"]) == pytest.approx(-math.pi / 2)
    assert north[-1]["phase"] == "beyond -alpha"


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--width", "0", "--height", "1"], "width must be positive"),
        (["--width", "0.2", "--height", "-1"], "height must be positive"),
        (["--width", "nan", "--height", "1"], "not a number"),
        (["--width", "24parsec", "--height", "1"], "unknown unit"),
        (["--width", "0.2"], "--height"),
        ([], "--width, --height missing"),
        (["--block", "gravestone", "--width", "0.2"], "exclude each other"),
        (["--block", "nowhere.toml"], "no body file"),
        (["--width", "0.2", "--height", "1", "--restitution", "1.2"], "[0, 1]"),
        (["--width", "0.2", "--height", "1", "--restitution", "-0.1"], "[0, 1]"),
        (["--width", "0.2", "--height", "1", "--restitution", "nan"], "must be a finite number"),
        (["--width", "0.2", "--height", "1", "--centroid-offset", "0.1"], "above the base"),
        (["--width", "0.2", "--height", "1", "--centroid-height", "1.2"], "exceeds the height"),
        (["--width", "0.2", "--height", "1", "--azimuth", "north"], "degrees"),
        (["--width", "0.2", "--height", "1", "--margin", "--margin-limit", "-1"], "limit"),
        (["--width", "0.2", "--height", "1", "--perturb", "5", "--spread", "1.5"], "relative spread of the size must lie in [0, 1)"),
    ],
)
def test_rock_reports_bad_input_in_one_sentence(run, pulse, words, says):
    """Bad input gives one sentence, exit code 2 or 3, no traceback."""
    answer = run(pulse, *words)
    assert answer.exit_code in (2, 3)
    assert says in " ".join(answer.stderr.split())
    assert "Traceback" not in answer.output
    assert answer.stdout == ""


def test_rock_accepts_and_reports_wide_block(run, pulse):
    """A block wider than tall is solved, and its threshold above 1 g is stated."""
    answer = run(pulse, "--width", 1.0, "--height", 0.5)
    assert answer.exit_code == 0
    assert "rocking threshold 2.00 g" in answer.stderr


def test_rock_vertical_requires_vertical_component(run, tmp_path):
    """--vertical on a record without one is refused in a sentence; without the option it is solved."""
    rows = np.column_stack([np.arange(50) * 0.01, np.ones(50)])
    np.savetxt(tmp_path / "ns.csv", rows, delimiter=",", header="time,NS (gal)", comments="")
    answer = run("ns.csv", "--width", 0.2, "--height", 1, "--vertical")
    assert answer.exit_code == 3
    assert "requires a vertical component" in answer.stderr
    assert run("ns.csv", "--width", 0.2, "--height", 1).exit_code == 0


def test_rock_flags_sensitive_outcome_everywhere(run):
    """A verdict that a 2 % change of the record flips is flagged in table, document and on stderr."""
    words = ("--width", "24cm", "--height", "72cm", "--scale", 0.5, "--component", "EW")
    output, result = run(*words), json.loads(run(*words, "--json").stdout)
    assert result["results"][0]["verdict_flips_within_2_percent"] is True
    assert any("sensitive to the amplitude" in text for text in result["warnings"])
    factor = result["results"][0]["flips_at_factor"]
    would = "does not overturn" if result["results"][0]["overturned"] else "overturns"
    assert f"; {would} at a scale factor of {factor:.3f}" in " ".join(output.stdout.split())
    assert f"sensitive to the amplitude: it changes at {factor:.3f} times the record" in output.stderr


def test_rock_animates_first_component(run, pulse, tmp_path):
    """--animate writes a film; a suffix that is none is refused, and nothing is left behind."""
    words = (pulse, "--width", 0.24, "--height", 0.8, "--component", "NS", "--animate")
    assert run(*words, "rock.html").exit_code == 0
    assert (tmp_path / "rock.html").read_text().startswith("<!doctype html>")
    refused = run(*words, "rock.avi")
    assert refused.exit_code == 3
    assert ".gif, .mp4 or .html" in refused.stderr
    assert not list(tmp_path.glob("*.avi"))


def test_rock_writes_no_animation_of_a_block_at_rest(tmp_path, monkeypatch):
    """The result is printed, and a warning explains the missing file."""
    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(main, ["rock", "sine:20gal@1Hz,2s", "--width", "0.3", "--height", "0.6", "--animate", "film.gif"])
    assert result.exit_code == 0
    assert "remains at rest: no animation written" in result.stderr
    assert not (tmp_path / "film.gif").exists()
