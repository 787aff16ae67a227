"""``seisblock spectrum`` solves a grid of blocks and reports which overturn."""

import csv
import json
import math

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.bodies.block import Block
from seisblock.cli import main
from seisblock.models.rock.solve import solve_rock
from seisblock.records import Motion
from seisblock.studies.rocking import verdicts
from seisblock.studies.rocking.spectrum import rocking_spectrum
from tests.lengths import all_but_slow

GRID = ("--component", "NS", "--scale", 0.6, "--sizes", "30cm,1,3", "--height-over-width", "2,4")


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Return a function that runs the command in an empty directory."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "120")
    return lambda *words: CliRunner().invoke(main, ["spectrum", *map(str, words)])


def test_rocking_spectrum_equals_solve_rock(run):
    """A matrix with a row per size and a column per slenderness, equal to the results of rock."""
    output = json.loads(run(*GRID, "--json").stdout)
    assert output["schema"] == "seisblock/spectrum/1"
    result = output["results"][0]
    assert np.shape(result["max_rotation_ratio"]) == np.shape(result["overturned"]) == (3, 2)
    for i, size in enumerate((0.3, 1.0, 3.0)):
        assert result["frequency_parameter_rad_s"][i] == pytest.approx(math.sqrt(1.5 * 9.80665 / size))
        for j, ratio in enumerate((2.0, 4.0)):
            alpha = math.atan(1 / ratio)
            words = ["rock", "--component", "NS", "--scale", "0.6", "--json", "--width", repr(size * math.sin(alpha))]
            answer = CliRunner().invoke(main, [*words, "--height", repr(size * math.cos(alpha))])
            expected = json.loads(answer.stdout)["results"][0]
            assert result["overturned"][i][j] == expected["overturned"]
            assert result["max_rotation_ratio"][i][j] == pytest.approx(expected["max_rotation_ratio"], rel=1e-9)


def test_spectrum_frequency_parameter_and_slenderness_equal_sizes(run):
    """--frequency-parameter and --slenderness-rad are other words for size and H/B."""
    p = ",".join(repr(math.sqrt(1.5 * 9.80665 / size)) for size in (0.3, 1.0, 3.0))
    alpha = ",".join(repr(math.atan(1 / ratio)) for ratio in (2, 4))
    words = ("--component", "NS", "--scale", 0.6, "--frequency-parameter", p, "--slenderness-rad", alpha, "--json")
    ours, theirs = (json.loads(run(*subset).stdout)["results"][0] for subset in (words, (*GRID, "--json")))
    assert ours["overturned"] == theirs["overturned"]
    np.testing.assert_allclose(ours["max_rotation_ratio"], theirs["max_rotation_ratio"], rtol=1e-6)


@pytest.mark.parametrize("kind", all_but_slow(["rocking", "overturning"], {"overturning"}))
def test_spectrum_writes_table_csv_and_figure(run, tmp_path, kind):
    """The table is thinned, the file holds every block, the figure is drawn."""
    answer = run("--scale", 0.6, "--steps", 14, "--kind", kind, "--csv", "s.csv", "--plot", "s.png")
    assert answer.exit_code == 0, answer.output
    assert "of 196 blocks overturn" in answer.stdout
    # a block that returns from beyond alpha has a ratio above 1, and no mark
    assert ("(#: overturns)" if kind == "rocking" else "yes") in answer.stdout and ">1" not in answer.stdout
    assert kind != "rocking" or " # " in answer.stdout
    rows = list(csv.DictReader((tmp_path / "s.csv").open()))
    assert len(rows) == 2 * 196
    assert {row["overturned"] for row in rows} == {"True", "False"}
    assert (tmp_path / "s.png").stat().st_size > 10_000


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--sizes", "0"], "size 2R must be positive"),
        (["--sizes", "1,-2"], "size 2R must be positive"),
        (["--slenderness-rad", "20"], "below 1.571"),
        (["--height-over-width", "-3"], "height over width must be positive"),
        (["--sizes", "1", "--frequency-parameter", "2"], "exclude each other"),
        (["--sizes", "1:2"], "range"),
        (["--restitution", "2"], "[0, 1]"),
        (["--mu", "0.2"], "has no effect"),
        (["--kind", "sliding", "--sizes", "1"], "has no effect"),
        (["--kind", "sliding", "--restitution", "0"], "has no effect"),
        (["--kind", "sliding", "--mu", "-0.1"], "friction"),
        (["--kind", "modes", "--mu", "-0.1"], "friction"),
        (["--kind", "modes", "--linear"], "has no effect"),
        (["--kind", "modes", "--sizes", "1,2"], "requires one shape"),
        (["--kind", "modes", "--restitution", "1"], "restitution"),
        (["--kind", "modes", "--mu", "0:1:1e-5"], "cells"),
    ],
)
def test_spectrum_reports_bad_input_in_one_sentence(run, words, says):
    """No traceback for what a user can get wrong; degrees cannot pass for radians."""
    answer = run(*words)
    assert answer.exit_code in (2, 3)
    assert says in " ".join(answer.stderr.split())
    assert answer.stdout == ""


def test_sliding_spectrum_equals_solve_slide(run, tmp_path):
    """Each point is a run of slide; more friction, in the end, no slip."""
    answer = run("--kind", "sliding", "--mu", "0.1,0.3,2", "--component", "NS", "--json", "--csv", "s.csv", "--plot", "s.png")
    result = json.loads(answer.stdout)["results"][0]
    for mu, slip in zip(result["mu"], result["max_slip_m"], strict=True):
        single = json.loads(CliRunner().invoke(main, ["slide", "--mu", str(mu), "--component", "NS", "--json"]).stdout)["results"][0]
        assert slip == pytest.approx(single["max_slip_m"], rel=1e-9, abs=1e-15)
    assert result["max_slip_m"][0] > 0 == result["max_slip_m"][-1]
    assert len(list(csv.DictReader((tmp_path / "s.csv").open()))) == 3
    assert (tmp_path / "s.png").stat().st_size > 5_000


def test_map_of_few_frictions_separates_the_ends_of_its_axis(run):
    """The first and the last friction coefficient ran into each other: 0.03330.367."""
    text = run("--kind", "modes", "--mu", "0.0333,0.2,0.367", "--height-over-width", "4,1", "--component", "NS").stdout
    assert "0.0333 0.367" in text


def test_mode_map_equals_solve_respond(run, tmp_path):
    """Each cell equals the result of respond; the file holds every cell; figures over shapes and over sizes."""
    answer = run("--kind", "modes", "--mu", "0.3,0.9", "--height-over-width", "4,1", "--component", "NS", "--json", "--csv", "m.csv")
    entry = json.loads(answer.stdout)["results"][0]
    assert np.shape(entry["mode"]) == np.shape(entry["slip_path_m"]) == (2, 2)
    for i, ratio in enumerate((0.25, 1.0)):
        assert entry["b_over_h"][i] == pytest.approx(ratio)
        alpha = math.atan(ratio)
        size = ("--width", repr(math.sin(alpha)), "--height", repr(math.cos(alpha)))
        for j, mu in enumerate(("0.3", "0.9")):
            words = ["respond", "--component", "NS", "--mu", mu, *size, "--runs", "0", "--json"]
            first = json.loads(CliRunner().invoke(main, words).stdout)["results"][0]
            assert (entry["mode"][i][j] == "overturned") == first["overturned"]
            assert entry["slip_path_m"][i][j] == pytest.approx(first["slip_path_m"], rel=1e-9)
    assert entry["initiation"]["acceleration_ratio"] > 1.0
    assert len(list(csv.DictReader((tmp_path / "m.csv").open()))) == 4
    for axis in (("--steps", "12"), ("--sizes", "0.5,1,2", "--height-over-width", "3", "--mu", "0.2,0.5"), ("--mu", "0.3", "--steps", "2")):
        result = run("--kind", "modes", *axis, "--plot", "m.png")
        assert result.exit_code == 0, result.output
        assert "bodies" in result.stdout and "of the effective weight" in result.stdout
        assert (tmp_path / "m.png").stat().st_size > 10_000


def test_mode_map_uses_vertical_motion_if_present(run):
    """As respond does: unless it is refused, and never asked of a record without one."""
    grid = ("--kind", "modes", "--mu", "0.4", "--height-over-width", "2", "--component", "NS", "--json")
    with_it, without = (json.loads(run(*grid, *extra).stdout) for extra in ((), ("--no-vertical",)))
    assert with_it["parameters"]["vertical"] and not without["parameters"]["vertical"]
    ratios = [item["results"][0]["initiation"]["acceleration_ratio"] for item in (with_it, without)]
    assert ratios[0] != ratios[1]
    refused = run("elcentro_1940_ns", "--kind", "modes", "--vertical")
    assert refused.exit_code == 3 and "vertical" in refused.stderr


def test_spectrum_reports_progress_per_chunk(monkeypatch):
    """Progress is reported for every chunk and ends at the number of runs."""
    monkeypatch.setattr(verdicts, "CHUNK_SIZE", 20_000)
    collected = []
    motion = Motion.from_arrays(3 * np.sin(np.arange(400) * 0.1), 0.02)
    rocking_spectrum(
        np.linspace(0.5, 3, 20), np.linspace(0.1, 0.4, 20), motion, progress=lambda result, total: collected.append((result, total))
    )
    assert collected[-1] == (400, 400)
    assert len(collected) == 8


def test_spectrum_obeys_similarity():
    """Length L and time sqrt(L): the same leans over alpha."""
    a = 3 * np.sin(np.arange(400) * 0.12)
    small = rocking_spectrum([0.5, 1.0], [0.15, 0.3], Motion.from_arrays(a, 0.02))
    large = rocking_spectrum([2.0, 4.0], [0.15, 0.3], Motion.from_arrays(a, 0.04))
    np.testing.assert_array_equal(small.overturned, large.overturned)
    np.testing.assert_allclose(small.max_rotation_ratio, large.max_rotation_ratio, rtol=1e-9)
    first = solve_rock(Block(0.5 * math.sin(0.15), 0.5 * math.cos(0.15)), Motion.from_arrays(a, 0.02)).outcome
    assert small.max_rotation_ratio[0, 0] == pytest.approx(first.max_rotation_ratio, rel=1e-12)


@pytest.mark.parametrize("option", ["--height-over-width", "--sizes", "--frequency-parameter"])
def test_spectrum_rejects_overflowing_numbers(option):
    """Their reciprocals and squares leave the finite numbers: one sentence, no warning of numpy."""
    result = CliRunner().invoke(main, ["spectrum", option, "1e-320", "--steps", "2"])
    assert result.exit_code == 3 and "is outside the computable range" in " ".join(result.stderr.split())
