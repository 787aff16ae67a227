"""``seisblock stack`` answers on every kind of input, and refuses bad input in one sentence."""

from __future__ import annotations

import csv
import json
import re

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from seisblock.cli import main
from seisblock.cli.stack import MAX_SAMPLED_WORK, SPRINGS_WORK

KEYS = {"component", "overturned", "overturned_any", "time_s", "max_tilt_rad", "residual_slip_m", "stones"}


def run(*arguments):
    return CliRunner().invoke(main, ["stack", *map(str, arguments)])


def answer(*arguments):
    result = run(*arguments, "--json")
    assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout)


@pytest.fixture
def pulse(tmp_path):
    """A file with 3 s of a 1 Hz sine of 500 gal along NS, at 100 Hz."""
    time = np.arange(0.0, 3.0, 0.01)
    path = tmp_path / "pulse.csv"
    rows = "\n".join(f"{t:.2f},{500 * np.sin(2 * np.pi * t):.6f}" for t in time)
    path.write_text(f"time,NS (gal)\n{rows}\n", encoding="utf-8")
    return path


def test_stack_without_record_uses_sample():
    """Without RECORD the bundled sample is used, as the first line states; one run has all components."""
    result = run("--window", "24:30")
    assert result.exit_code == 0
    assert result.stdout.startswith("Record: synthetic_jma.csv (bundled, synthetic); none given.\n")
    assert re.search(r"sao falls to azimuth \d+ \([NESW]+\) at 2\d\.\d\d s, onto", " ".join(result.stdout.split()))
    assert "gedai" in result.stdout


def test_stack_document_has_falls_tilt_and_slip(pulse):
    """The JSON document has the fallen stones with times, and tilt and slip of every stone."""
    document = answer(pulse, "--stones", "wagata.toml")
    assert document["schema"] == "seisblock/stack/3"
    assert document["citations"] == [
        "Furukawa2009",
        "AlartCurnier1991",
        "Gottschalk1996",
        "Jean1999",
        "Moreau1988",
        "Silcowitz2010",
        "TasoraAnitescu2011",
    ]
    (result,) = document["results"]
    assert set(result) >= KEYS
    assert result["overturned"] == ["sao"]
    assert result["overturned_any"] is True
    assert 0.3 < result["time_s"] < 2.0
    (sao,) = (stone for stone in result["stones"] if stone["name"] == "sao")
    assert (sao["fell_azimuth_deg"] + sao["fell_towards_deg"]) % 360.0 == pytest.approx(0.0, abs=1e-9)  # +x is north
    assert set(result["max_tilt_rad"]) == set(result["residual_slip_m"]) == {"gedai", "mizubachi", "chudai", "jodai", "sao"}
    assert result["max_tilt_rad"]["sao"] > 1.0
    assert document["parameters"]["mu"] == 0.438
    assert document["parameters"]["points"] == 2


def test_stack_dowel_keeps_sao_standing(pulse):
    """A motion that overturns the plain gravestone leaves the dowelled one standing."""
    (result,) = answer(pulse, "--reinforced")["results"]
    assert result["overturned"] == []
    assert result["time_s"] is None


def test_stack_states_models_of_top_stone(pulse):
    """Beside the pile's verdict stands what blocks and criteria say of its sao, with the criterion of its kind (N15)."""
    few = pulse, "--runs", "2"  # the samples are not looked at
    (result,) = answer(*few)["results"]
    models = {opinion["model"]: opinion["falls"] for opinion in result["agreement"]["opinions"]}
    assert models["pile of stones"] is True
    assert result["agreement"]["models"] == 6
    output = " ".join(run(*few, "--details").stdout.split())
    assert "sao, NS: overturns in" in output
    assert "pile of stones" in output
    dowelled = answer(*few, "--reinforced")["results"][0]["agreement"]
    factors = {opinion["model"]: opinion["factor"] for opinion in dowelled["opinions"]}
    plain = {opinion["model"]: opinion["factor"] for opinion in result["agreement"]["opinions"]}
    assert factors["gravestone criterion"] > 1.3 * plain["gravestone criterion"]


def test_stack_runs_each_requested_component():
    """--component gives one entry for each, in the order asked."""
    results = answer("--window", "25:26", "--component", "EW,NS", "--runs", "0")["results"]
    assert [entry["component"] for entry in results] == ["EW", "NS"]


def test_stack_runs_reports_share_per_stone(pulse):
    """--runs gives the share of samples in which each stone falls, with the keys of respond; 0 gives none."""
    (result,) = answer(pulse, "--scale", "0.9", "--runs", "6", "--seed", "1", "--vary-amplitude", "0.3")["results"]
    chance = result["probability"]
    assert set(chance) == {"runs", "overturned", "moved", "interval", "moved_m", "stones", "versions", "seed", "left_out_count"}
    assert (chance["runs"], chance["seed"], chance["moved_m"], chance["versions"]["amplitude"]) == (6, 1, 0.01, 0.3)
    assert [stone["name"] for stone in chance["stones"]] == ["gedai", "mizubachi", "chudai", "jodai", "sao"]
    assert 0.0 < chance["overturned"] < 1.0
    output = " ".join(run(pulse, "--scale", "0.9", "--runs", "6", "--seed", "1", "--vary-amplitude", "0.3").stdout.split())
    count = round(6 * chance["overturned"])
    assert f"Probability of a fall {round(100 * count / 6)} % (" in output and ", 6 samples)" in output
    assert "6 samples; moves: residual displacement above 1.0 cm, or falls" in output
    assert "size ±5 %, sharp edges, friction of each joint ±20 %" in output
    assert "probability" not in answer(pulse, "--scale", "0.7", "--runs", "0")["results"][0]
    refused = run("--criterion", "--runs", "3")
    assert refused.exit_code == 3 and "--runs has no effect with --criterion" in refused.stderr


def test_stack_default_samples_end_beyond_a_limit_of_work(monkeypatch):
    """Five stones over 1.01 s: samples by default up to 25 times it, a line and none below it, samples there on request."""
    arguments = ["stack", "--stones", "wagata", "--window", "24:25", "--json"]
    runner = CliRunner()
    limits = f"exceeds {MAX_SAMPLED_WORK:.0f}, or {MAX_SAMPLED_WORK / SPRINGS_WORK:.0f} with springs"
    assert limits in " ".join(runner.invoke(main, ["stack", "--help"]).stdout.split())
    for limit, options, runs in ((25.3, [], 20), (25.2, [], None), (25.2, ["--runs", "2"], 2), (150.0, ["--law", "springs"], None)):
        monkeypatch.setattr("seisblock.cli.stack.MAX_SAMPLED_WORK", limit)
        result = runner.invoke(main, [*arguments, *options])
        (row,) = json.loads(result.stdout)["results"]
        assert row.get("assessment", {}).get("runs") == runs
        assert ("no samples by default of 5 stones" in result.stderr) == (runs is None)


def test_stack_states_wear_and_rejects_it_with_grid(pulse):
    """Insets of stones vary by a share of themselves; a grid of points has no wear and rejects the option."""
    group = pulse, "--window", "0:1.2", "--runs", "2"
    assert "edge wear ±10 %" in " ".join(run(*group, "--inset", "0.2").stdout.split())
    assert "not included): size ±5 %, friction" in " ".join(run(*group, "--vary-inset", "0").stdout.split())
    grid = *group, "--contact", "grid=5"
    assert answer(*grid)["results"][0]["probability"]["versions"]["inset"] == 0.0
    refused = run(*grid, "--vary-inset", "0.1")
    assert refused.exit_code == 3 and "--vary-inset has no effect with --contact grid" in refused.stderr


def test_stack_without_and_fix_change_pile(pulse):
    """--without and --fix change the pile."""
    (result,) = answer(pulse, "--without", "mizubachi", "--fix", "gedai", "--contact", "edges", "--mu", "0.6")["results"]
    assert "mizubachi" not in result["max_tilt_rad"]
    assert result["max_tilt_rad"]["gedai"] == 0.0


@pytest.mark.slow
def test_stack_writes_csv_figure_and_animation(pulse, tmp_path):
    """--csv, --plot and --animate write what they say."""
    table, picture, film = (tmp_path / name for name in ("stack.csv", "stack.png", "stack.gif"))
    result = run(pulse, "--window", "0:1.2", "--csv", table, "--plot", picture, "--animate", film)
    assert result.exit_code == 0, result.stderr
    with table.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert {"time_s", "sao_tilt_rad", "sao_slip_m", "gedai_x_m", "sao_qw"} <= set(rows[0])
    assert max(float(row["sao_tilt_rad"]) for row in rows) > 1.0
    with Image.open(picture) as image:
        assert min(image.size) > 300
    with Image.open(film) as image:
        assert image.n_frames > 10


def test_stack_reads_pile_file(pulse, tmp_path):
    """A pile of the user's own, in the user's own file."""
    stones = tmp_path / "crates.toml"
    stones.write_text(
        'kind = "pile"\nmu = 0.5\n[[stone]]\nname = "lower"\nwidth = "60cm"\ndepth = "40cm"\nheight = "30cm"\ndensity = 300\n'
        '[[stone]]\nname = "upper"\nwidth = "60cm"\ndepth = "40cm"\nheight = "30cm"\n',
        encoding="utf-8",
    )
    (result,) = answer(pulse, "--stones", stones, "--joint-stiffness", "1e8", "--runs", "0")["results"]
    assert result["overturned"] == []
    assert set(result["max_tilt_rad"]) == {"lower", "upper"}
    output = " ".join(run(pulse, "--stones", stones, "--runs", "0", "--details").stdout.split())
    assert "upper is too stocky to continue rocking after an impact" in output  # Housner's ratio would be negative


def test_stack_study_scales_records(pulse, tmp_path):
    """With RECORD the study also scales it to each amplitude and states its equivalent frequency (fig. 10); the CSV has both."""
    table = tmp_path / "study.csv"
    (result,) = answer(pulse, "--criterion", "--grid", "14", "--contact", "edges", "--without", "mizubachi", "--csv", table)["results"]
    (scaled,) = result["scaled_records"]
    output = list(csv.DictReader(table.open(encoding="utf-8", newline="")))
    assert [row["motion"] for row in output] == [*["sine"] * len(result["thresholds"]), "NS"]
    assert float(output[-1]["frequency_hz"]) == scaled["thresholds"][0]["frequency_hz"]
    assert len(scaled["thresholds"]) == 1
    assert 0.4 < scaled["thresholds"][0]["frequency_hz"] < 1.2


def test_stack_criterion_study_resumes_and_draws(tmp_path):
    """The study prints thresholds beside (9), redraws its figures, and takes up what was finished."""
    holding, picture, table = tmp_path / "study.jsonl", tmp_path / "study.png", tmp_path / "study.csv"
    arguments = ("--criterion", "--grid", "13", "--contact", "grid=3", "--resume", holding, "--without", "mizubachi")
    document = answer(*arguments, "--csv", table, "--plot", picture)
    (result,) = document["results"]
    lines = holding.read_text(encoding="utf-8").splitlines()
    assert len(lines) - 1 == len(result["thresholds"]) == 6
    assert result["published"]["equation"] == "(9)"
    assert len(table.read_text(encoding="utf-8").splitlines()) == 7
    assert picture.stat().st_size > 10_000
    repeat = run(*arguments)
    assert repeat.exit_code == 0
    assert "a(f) = PGA H/B" in repeat.stdout
    assert holding.read_text(encoding="utf-8").splitlines() == lines


BAD = {
    "no such file": (("--stones", "nothing.toml"), "bundled:"),
    "negative friction": (("--mu", "-0.1"), "friction"),
    "no such stone": (("--without", "nose"), "has no stone 'nose'"),
    "a stone stands on it": (("--without", "jodai"), "stands on 'jodai'"),
    "fixed unknown": (("--fix", "nose"), "'nose'"),
    "too coarse": (("--step", "0.01", "--law", "springs"), "stability limit"),
    "too coarse for rigid stones": (("--step", "0.1"), "out of range"),
    "rigid springs": (("--law", "rigid", "--young", "1e9"), "have no effect with --law rigid"),
    "two stiffnesses": (("--young", "1e9", "--joint-stiffness", "1e9"), "exclude each other"),
    "negative stiffness": (("--young", "-1"), "must be positive"),
    "grid without study": (("--grid", "2"), "require --criterion"),
    "step of the study": (("--criterion", "--step", "0.001"), "--step, --vertical and --across have no effect with --criterion"),
    "components of the study": (("--criterion", "--no-across"), "--step, --vertical and --across have no effect with --criterion"),
    "damping of nothing": (("--damping", "0.1"), "requires --young"),
    "vertical as direction": (("--component", "UD"), "vertical"),
}


@pytest.mark.parametrize("arguments, message", BAD.values(), ids=BAD)
def test_stack_reports_bad_input_in_one_sentence(arguments, message):
    """Nothing a user can cause is a traceback."""
    result = run(*arguments, "--quiet")
    assert result.exit_code == 3, result.output
    assert message in " ".join(result.stderr.split())
    assert "Traceback" not in result.stderr
    assert result.stdout == ""
