"""``seisblock measure`` prints the measures of a record in a table, a document, a file and a figure."""

import contextlib
import csv
import json
import math
import sys

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.cli import main
from seisblock.core.units import STANDARD_GRAVITY

pytestmark = pytest.mark.usefixtures("computed_once")

CHOZUSHA_CENTROID = (1303.7 * (1.84 + 1.06 / 2) + 160.0 * 1.84 / 2) / 1463.7


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Return a function that runs the command in an empty directory."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")
    return lambda *words: CliRunner().invoke(main, ["measure", *map(str, words)])


@pytest.fixture(scope="module")
def sines(tmp_path_factory):
    """A plain CSV: 1 Hz, 200 gal north; 2 Hz, 100 gal east; 5 Hz, 50 gal up; from rest, 60 s."""
    t = np.arange(12001) * 0.005
    rows = np.column_stack([t, *(a * np.sin(2 * math.pi * f * t) for a, f in ((200, 1), (100, 2), (50, 5)))])
    path = tmp_path_factory.mktemp("sines") / "sines.csv"
    np.savetxt(path, rows, delimiter=",", header="time,NS (gal),EW (gal),UD (gal)", comments="", fmt="%.17g")
    return path


def test_measure_document_has_keys_in_si(run, sines):
    """The keys everyone relies on, SI, with the numbers of three sines."""
    output = json.loads(run(sines, "--json").stdout)
    assert output["schema"] == "seisblock/measure/1"
    assert [r["component"] for r in output["results"]] == ["NS", "EW", "UD"]
    for result, (amplitude, f) in zip(output["results"], ((2.0, 1.0), (1.0, 2.0), (0.5, 5.0)), strict=True):
        omega = 2 * math.pi * f
        assert result["pga_m_s2"] == pytest.approx(amplitude, rel=1e-9)
        assert result["pgv_m_s"] == pytest.approx(amplitude / omega, rel=5e-3)
        # a sine that starts at once has an edge, of which the 0.05 Hz high-pass makes displacement
        assert result["pgd_m"] == pytest.approx(amplitude / omega**2, rel=0.016 * f)
        # straight lines between samples of a sine hold (2 + cos w dt)/3 of its energy
        lines = (2 + math.cos(omega * 0.005)) / 3
        assert result["arias_m_s"] == pytest.approx(math.pi / (2 * STANDARD_GRAVITY) * amplitude**2 * 30 * lines, rel=1e-9)
        assert result["significant_duration_s"] == pytest.approx(54.0, rel=0.02)
        for value in result["equivalent_frequency_hz"].values():
            assert value == pytest.approx(f, rel=5e-3)
        assert result["jma_intensity"] == output["jma_intensity"]
        assert result["duration"]["threshold_m_s2"] == pytest.approx(0.980665)
    assert output["results"][0]["duration"]["count"] == 120
    assert output["results"][2]["duration"] == {"threshold_m_s2": 0.980665, "total_s": 0.0, "longest_s": 0.0, "count": 0}
    assert output["jma_class"] == "6-"
    assert output["parameters"]["velocity_highpass_hz"] == 0.05
    assert "Furukawa2009" in output["citations"]


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["--threshold", "150gal"], 1.5),
        (["--threshold", "1.5 m/s2"], 1.5),
        (["--threshold", "0.15g"], 0.15 * STANDARD_GRAVITY),
        (["--width", "24cm", "--height", "96cm"], STANDARD_GRAVITY / 4),
        (["--block", "chozusha"], STANDARD_GRAVITY * 1.04 / CHOZUSHA_CENTROID),
        (["--block", "chozusha", "--side", "long", "--gravity", "9.8"], 9.8 * 1.25 / CHOZUSHA_CENTROID),
        (["--width", "8sun", "--height", "0.9696", "--gravity", "9.8"], 9.8 / 4),
    ],
)
def test_measure_threshold_accepts_units_sizes_and_bodies(run, sines, words, expected):
    """Gal, m/s^2, g, the sizes of a block, or a bundled one."""
    duration = json.loads(run(sines, "--json", *words).stdout)["results"][0]["duration"]
    assert duration["threshold_m_s2"] == pytest.approx(expected, rel=1e-12)
    inside = 2 / math.pi * math.acos(expected / 2) if expected < 2 else 0
    assert duration["total_s"] == pytest.approx(60 * inside, abs=5e-3)


def test_measure_one_sided_durations_are_half(run, sines):
    """Half the stretches of a sine are positive."""
    assert json.loads(run(sines, "--json", "--direction", "+").stdout)["results"][0]["duration"]["count"] == 60


def test_measure_component_keeps_intensity_of_record(run, sines):
    """One component or an azimuth asked for, JMA intensity still of all three."""
    full = json.loads(run(sines, "--json").stdout)
    part = json.loads(run(sines, "--json", "--component", "UD,45").stdout)
    assert [r["component"] for r in part["results"]] == ["UD", "45"]
    assert part["jma_intensity"] == full["jma_intensity"]


def test_measure_table_fits_80_columns(run, sines):
    """One row per component, nothing wider than the terminal, no heading broken."""
    out = run(sines).stdout
    assert max(map(len, out.splitlines())) <= 80
    assert sum(line.strip().startswith("NS ") for line in out.splitlines()) == 2
    assert "PGA (gal)" in out
    assert "JMA intensity" in out
    assert "PGA/2πPGV" in out
    assert "m/s²" in run(sines, "--si").stdout


def test_measure_csv_round_trips_acceleration(run, sines, tmp_path):
    """Time, and three columns per component; acceleration round-trips to the last digit."""
    assert run(sines, "--csv", "out.csv", "--quiet").exit_code == 0
    with (tmp_path / "out.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0])[:4] == ["time_s", "NS_acceleration_m_s2", "NS_velocity_m_s", "NS_displacement_m"]
    assert len(rows) == 12001
    t = np.arange(12001) * 0.005
    np.testing.assert_allclose([float(r["NS_acceleration_m_s2"]) for r in rows], 2 * np.sin(2 * math.pi * t), rtol=0, atol=1e-15)
    assert float(rows[-1]["EW_displacement_m"]) == pytest.approx(0.0, abs=1e-12)


def test_measure_indexes_results_of_two_records(run, sines, tmp_path):
    """Results carry the index of their record; the intensity becomes a list; a figure is refused in words."""
    second = tmp_path / "half.csv"
    second.write_text("time,NS (gal)\n" + "".join(f"{i * 0.01:.2f},{math.sin(i * 0.1):.6f}\n" for i in range(500)))
    output = json.loads(run(sines, second, "--json").stdout)
    assert [r["record_index"] for r in output["results"]] == [0, 0, 0, 1]
    assert output["jma_intensity"][1] is None
    refused = run(sines, second, "--plot", "two.png")
    assert refused.exit_code == 3
    assert not (tmp_path / "two.png").exists()


@pytest.mark.parametrize(
    ("words", "exit_code", "message"),
    [
        (["--threshold", "150"], 2, "no unit"),
        (["--threshold", "fast"], 2, "not a number"),
        (["--threshold", "1 furlong"], 2, "unknown unit"),
        (["--threshold", "-5gal"], 3, "must be positive"),
        (["--width", "24cm"], 2, "both --width and --height"),
        (["--width", "24cm", "--height", "0"], 3, "positive"),
        (["--width", "24cm", "--height", "1", "--threshold", "5gal"], 2, "exclude each other"),
        (["--block", "teapot"], 3, "bundled:"),
        (["--velocity-highpass", "-1"], 2, "positive"),
        (["--velocity-highpass", "100"], 3, "half the sampling rate"),
        (["--component", "XX"], 3, "NS, EW, UD"),
        (["--window", "5:70"], 3, "lies outside the record (0 to 60 s)"),
        (["--animate", "a.gif"], 2, "No such option '--animate'"),
    ],
)
def test_measure_reports_bad_input_in_one_sentence(run, sines, words, exit_code, message):
    """Bad input gives a sentence on stderr and its exit code."""
    result = run(sines, *words)
    assert result.exit_code == exit_code
    assert message in " ".join(result.stderr.split())
    assert "Traceback" not in result.output


@pytest.mark.slow
def test_measure_writes_each_figure_format(run, sines, tmp_path):
    """Each of the three formats is written."""
    for suffix, start in (("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF")):
        assert run(sines, "--component", "NS", "--plot", f"record.{suffix}").exit_code == 0
        assert (tmp_path / f"record.{suffix}").read_bytes().startswith(start)


def test_measure_without_record_uses_sample(run):
    """Its name is the first line of the tables, and stands on stderr beside a document."""
    line = "Record: hanmer_springs_2016.V1A.gz (bundled); none given."
    result = run("--json")
    assert json.loads(result.stdout)["record"]["samples"] > 1000
    assert line in result.stderr
    result = run()
    assert result.stdout.splitlines()[0] == line
    assert line not in result.stderr


def test_help_lists_processing_options_in_order(run):
    """The mean is removed before the high-pass; a target PGA applies to the whole record, not to the window."""
    output = json.loads(run("elcentro_1940_ns", "--window", "20:", "--target-pga", "300", "--highpass", "0.1", "--demean", "--json").stdout)
    steps = [next(i for i, did in enumerate(output["record"]["history"]) if word in did) for word in ("mean", "pass", "PGA", "window")]
    assert steps == sorted(steps)
    assert 0.1 < output["results"][0]["pga_m_s2"] < 2.9
    text = " ".join(run("--help-all").stdout.split())
    assert "over the whole record, before --floor and --window" in text
    assert "after --demean, before --scale" in text and "before anything else" not in text


def test_measure_counts_the_records_in_progress(run, sines, monkeypatch):
    """Hundreds of records were measured for minutes without a count."""
    counts = []

    @contextlib.contextmanager
    def count(text):
        yield lambda *numbers: counts.append((text, *numbers))

    monkeypatch.setattr(sys.modules["seisblock.cli.measure"], "progress", count, raising=False)
    assert run(sines, "elcentro_1940_ns").exit_code == 0
    assert counts == [("records", 1, 2), ("records", 2, 2)]
