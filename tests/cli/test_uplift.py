"""``seisblock uplift`` reports which corner uplifts, when and how far, and under which harmonic motion."""

import csv
import json
import math

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.bodies.spring_block import SpringBlock
from seisblock.cli import main
from seisblock.models.uplift.solve import solve_uplift
from seisblock.records.motion import Motion
from tests.models.uplift_motions import shaking

BODY = ("--width", 0.6, "--height", 1.8, "--frequency-vertical", 6)


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Return a function that runs the command in an empty directory."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")
    return lambda *words: CliRunner().invoke(main, ["uplift", *map(str, words)])


@pytest.fixture
def record(tmp_path):
    """A plain CSV of three components, m/s^2: north across, east along, up."""
    motion = shaking(3.0, 0.01)
    rows = np.column_stack([motion.time, motion.transverse, motion.horizontal, motion.vertical])
    path = tmp_path / "record.csv"
    np.savetxt(path, rows, delimiter=",", header="time,NS (m/s2),EW (m/s2),UD (m/s2)", comments="", fmt="%.17g")
    return path


def test_uplift_document_equals_library(run, record):
    """The document of a record is the library's answer, bit for bit, with the keys everyone relies on."""
    output = json.loads(run(record, "--component", "EW", *BODY, "--json").stdout)
    assert output["schema"] == "seisblock/uplift/1"
    result = output["results"][0]
    body = SpringBlock.from_frequency(0.6, 0.6, 1.8, frequency_vertical=6.0, beta=0.707)
    expected = solve_uplift(body, Motion(shaking(3.0, 0.01).acceleration, 0.01)).outcome
    assert result["component"] == "EW"
    assert result["natural_frequencies_hz"] == list(expected.natural_frequencies_hz)
    for key in ("uplifts", "first_uplift_s", "max_uplift_m", "corner", "uplift_duration_s", "max_contact_force_n", "contact_changes"):
        assert result[key] == getattr(expected, key), key
    assert sorted(result["share_on_corners"]) == ["0", "1", "2", "3", "4"]
    assert [corner["corner"] for corner in result["corners"]] == [1, 2, 3, 4]
    assert output["parameters"]["block"]["mass_kg"] == 1000.0
    assert output["citations"] == ["Okumura1987"]


def test_uplift_of_square_block_follows_rotation(run, record):
    """North and east are the same block: corner 4 of one is corner 2 of the other."""
    north, east = json.loads(run(record, *BODY, "--json").stdout)["results"]
    assert (north["component"], east["component"]) == ("NS", "EW")
    # with +x to the north, +y is to the west
    for n, e in ((1, 3), (2, 1), (3, 4), (4, 2)):
        assert north["corners"][n - 1]["max_uplift_m"] == pytest.approx(east["corners"][e - 1]["max_uplift_m"], rel=1e-9)


def test_uplift_stiffness_equals_frequency_input(run, record):
    """Springs given in N/m move the block as the frequencies that they make."""
    k = 800.0 * (2 * math.pi * 6.0) ** 2 / 4
    values = ("--mass", 800, "--stiffness", f"{k * 0.707**2},{k * 0.707**2},{k}")
    first = json.loads(run(record, "--component", "EW", *BODY, "--json").stdout)["results"][0]
    two = json.loads(run(record, "--component", "EW", *BODY[:4], *values, "--json").stdout)["results"][0]
    assert two["max_uplift_m"] == pytest.approx(first["max_uplift_m"], rel=1e-9)
    assert two["max_contact_force_n"] == pytest.approx(0.8 * first["max_contact_force_n"], rel=1e-9)


def test_uplift_harmonic_document_has_curve_and_minimum(run):
    """Without frequencies the curve is the paper's grid; with a list it holds exactly those; the minimum is exact."""
    single = json.loads(run("--harmonic", "--beta", "0.7746", "--json").stdout)["results"][0]
    assert len(single["curve"]) == 600
    assert set(single["curve"][0]) == {"frequency_ratio", "acceleration_ratio"}
    assert single["minimum"]["acceleration_ratio"] == pytest.approx(0.0872857, abs=1e-6)
    assert [m["mode"] for m in single["minima"]] == ["first rocking in x-z", "second rocking in x-z"]
    listed = json.loads(run("--harmonic", "--beta", math.sqrt(0.6), "--frequency-ratio", "2.78225,1", "--json").stdout)["results"][0]
    assert [point["frequency_ratio"] for point in listed["curve"]] == [2.78225, 1.0]
    assert listed["curve"][0]["acceleration_ratio"] == pytest.approx(0.676683, abs=5e-7)
    assert listed["natural_frequencies_hz"][2] == 1.0
    ranged = json.loads(run("--harmonic", "--beta", math.sqrt(0.6), "--frequency-ratio", "2:4:0.01", "--json").stdout)["results"][0]
    assert ranged["minimum"]["frequency_ratio"] == pytest.approx(2.78225, abs=5e-6)
    assert min(point["acceleration_ratio"] for point in ranged["curve"]) == pytest.approx(0.6768, abs=1e-4)


def test_uplift_lists_are_combined(run):
    """Two values of alpha and three of damping are six studies."""
    answer = run("--harmonic", "--alpha", "1,2", "--damping", "0.02,0.05,0.1", "--frequency-ratio", 1, "--json")
    results = json.loads(answer.stdout)["results"]
    assert [(r["alpha"], r["damping"]) for r in results] == [(a, h) for a in (1, 2) for h in (0.02, 0.05, 0.1)]


def test_uplift_harmonic_accepts_sizes_and_springs(run):
    """Harmonic shaking of a block given by its sizes and springs, not square and kx != ky."""
    words = ("--width", 1.2, "--depth", 0.8, "--height", 2, "--mass", 500, "--stiffness", "2e4,3e4,5e4", "--frequency-ratio", "0.5,1")
    result = json.loads(run("--harmonic", *words, "--json").stdout)["results"][0]
    assert (result["alpha"], result["gamma"]) == pytest.approx((2.5, 1.5))
    assert 20.0 / (2 * math.pi) == pytest.approx(next(m["frequency_hz"] for m in result["modes"] if m["name"] == "vertical"))


def test_uplift_tables_fit_80_columns(run, record):
    """Tables fit 80 columns and say which corner lifted first, and which modes there are."""
    result = run(record, "--component", "EW", *BODY)
    assert result.exit_code == 0
    assert "first uplift at corner" in " ".join(result.stdout.split())
    harmonic = run("--harmonic", "--phi", 45, "--rho", 45)
    assert "second rocking in x-z" in harmonic.stdout
    assert max(map(len, (result.stdout + harmonic.stdout).splitlines())) <= 80


def test_uplift_beyond_model_has_null_and_flag(run):
    """A block that leans beyond what the model can follow has a first uplift and no height; JSON keeps both, and a flag (N16)."""
    words = ("synthetic_jma.csv", "--width", 0.6, "--height", 1.8, "--frequency-vertical", 10, "--component", "NS")
    output = " ".join(run(*words).stdout.split())
    assert "first uplift at corner 1, at 20.963 s; amount of uplift not available" in output
    assert "mm." not in output.partition("NS: corner")[2].partition("+x =")[0]
    assert "maximum uplift" not in output
    (result,) = json.loads(run(*words, "--json").stdout)["results"]
    assert result["within_model"] is False
    assert result["lean_ratio"] > 1.0
    assert result["max_uplift_m"] > 0.1


def test_uplift_of_weak_record_states_factor(run, record):
    """Without uplift the answer states the scale factor to uplift, and no height of a corner that stays pressed."""
    result = run(record, "--component", "EW", *BODY, "--scale", 0.05)
    (heights,) = [line.partition(")")[2].split() for line in result.stdout.splitlines() if "maximum uplift" in line]
    assert heights == ["-"] * 4
    assert "no uplift; scale factor to uplift" in " ".join(result.stdout.split())


@pytest.mark.parametrize(
    "words", [("--harmonic",), ("--harmonic", "--rho", "60", "--gamma", "1.5"), *(("--figure", n) for n in (3, 4, 6, 7, 8, 9, 10, 11))]
)
def test_uplift_draws_harmonic_figures(run, tmp_path, words):
    """Regions and frequencies, and each figure of the paper, are drawn."""
    assert run(*words, "--frequency-ratio", "0.1:6:0.1", "--plot", "figure.svg").exit_code == 0
    assert (tmp_path / "figure.svg").stat().st_size > 5000


def test_uplift_writes_record_figure_and_history(run, record, tmp_path):
    """The figure of a record is drawn, and its time history has a row per sample and two per contact change."""
    words = (record, "--component", "EW", *BODY, "--plot", "figure.png", "--csv", "history.csv", "--json")
    result = json.loads(run(*words).stdout)["results"][0]
    assert (tmp_path / "figure.png").stat().st_size > 20000
    with (tmp_path / "history.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    # corners of a generic motion never cross together
    assert len(rows) == 301 + 2 * result["contact_changes"]
    assert max(float(row["uplift_1_m"]) for row in rows) <= result["corners"][0]["max_uplift_m"]


def test_uplift_writes_harmonic_curves_as_csv(run, tmp_path):
    """The curves of all combinations stand one below the other."""
    assert run("--harmonic", "--damping", "0.02,0.05", "--frequency-ratio", "0.5,1,2", "--csv", "curves.csv").exit_code == 0
    with (tmp_path / "curves.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    assert [(row["damping"], row["frequency_ratio"]) for row in rows[2:4]] == [("0.02", "2.0"), ("0.05", "0.5")]


@pytest.mark.parametrize(
    ("words", "message", "code"),
    [
        (("--height", 2), "--width required", 3),
        (("--body", "gravestone"), 'kind must be "springs"', 3),
        (("--body", "nobody"), "bundled: machine", 3),
        (("--harmonic", "--block", "machine"), "--block has no effect with --harmonic", 2),
        (("--width", 1), "--height required", 3),
        (("--width", 1, "--height", 2), "spring stiffness required", 3),
        (("--width", 0, "--height", 2, "--frequency-vertical", 5), "width of the block must be positive", 3),
        (("--width", 1, "--height", -2, "--frequency-vertical", 5), "height of the block must be positive", 3),
        (("--width", 1, "--height", 2, "--frequency-vertical", 0), "vertical frequency must be positive", 3),
        (("--width", 1, "--height", 2, "--frequency-vertical", 5, "--beta", 0), "must be positive, found 0", 3),
        (("--width", 1, "--height", 2, "--mass", 9, "--stiffness", "1,-1,1"), "stiffness ky of a corner must be positive", 3),
        (("--width", 1, "--height", 2, "--mass", 9, "--stiffness", "1,1"), "requires three numbers", 3),
        (("--width", 1, "--height", 2, "--stiffness", "1,1,1"), "--stiffness requires --mass", 3),
        (("--width", 1, "--height", 2, "--mass", 9, "--stiffness", "1,1,1", "--beta", 1), "excludes --frequency-vertical and --beta", 3),
        (("--width", 1, "--height", 2, "--frequency-vertical", 5, "--damping", 1), "damping ratio must lie in [0, 1)", 3),
        (("--width", 1, "--height", 2, "--frequency-vertical", 5, "--damping", "-0.1"), "damping ratio must lie in [0, 1)", 3),
        (("--width", 1, "--height", 2, "--frequency-vertical", 5, "--damping", "0.1,0.2"), "accepts one number with a record", 3),
        (("--width", 1, "--height", 2, "--frequency-vertical", 5, "--rho", 90), "requires --harmonic", 3),
        (("--harmonic", "--rho", "steep"), "is not a number", 2),
        (("--harmonic", "--phi", "nan"), "must be a finite number", 2),
        (("--harmonic", "--alpha", 0), "alpha, height over depth, must be positive", 3),
        (("--harmonic", "--damping", 1.5), "damping ratio must lie in [0, 1)", 3),
        (("--harmonic", "--alpha", 2, "--width", 1, "--height", 2), "give sizes or ratios, not both", 3),
        (("--harmonic", "--frequency-ratio", "-1"), "finite and zero or more", 3),
        (("--harmonic", "--corner", 5), "5 is not in the range", 2),
        (("no_such_file.csv", "--harmonic"), "RECORD no_such_file.csv has no effect with --harmonic", 3),
    ],
)
def test_uplift_reports_bad_input_in_one_sentence(run, words, message, code):
    """Bad input gives one sentence, no traceback."""
    refused = run(*words)
    assert refused.exit_code == code, refused.output
    assert message in " ".join(refused.stderr.split())
    assert "Traceback" not in refused.output


def test_uplift_without_sizes_uses_bundled_machine(run, record, tmp_path):
    """A record alone is answered with the bundled body, equal to its sizes; options and a file of the user replace its values."""
    sizes = ("--width", 1.6, "--depth", 1.4, "--height", 1.2, "--mass", 1500, "--frequency-vertical", 15, "--beta", 0.7)
    plain, names, typed = (run(record, *words, "--json") for words in ((), ("--body", "machine"), sizes))
    assert "bundled machine" in plain.stderr
    assert plain.stdout == names.stdout == typed.stdout
    assert run(record, "--damping", 0.1, "--json").stdout == run(record, *sizes, "--damping", 0.1, "--json").stdout
    (tmp_path / "台.toml").write_text(
        'kind = "springs"\nwidth = "160cm"\ndepth = 1.4\nheight = 1.2\nmass = 1500\nstiffness = [1e6, 1e6, 2e6]\n', encoding="utf-8"
    )
    output = json.loads(run(record, "--body", "台.toml", "--json").stdout)["parameters"]
    assert output == json.loads(run(record, *sizes[:8], "--stiffness", "1e6,1e6,2e6", "--json").stdout)["parameters"]


def test_uplift_solves_record_without_vertical(run, tmp_path):
    """Without a vertical component the vertical motion is zero, with a warning."""
    motion = shaking(2.0, 0.01)
    rows = np.column_stack([motion.time, motion.transverse, motion.horizontal])
    np.savetxt(tmp_path / "flat.csv", rows, delimiter=",", header="time,NS (m/s2),EW (m/s2)", comments="", fmt="%.17g")
    result = run("flat.csv", *BODY, "--json")
    assert result.exit_code == 0
    assert "no vertical component in the record: vertical motion set to zero" in result.stderr
    assert any("no vertical component" in message for message in json.loads(result.stdout)["warnings"])
