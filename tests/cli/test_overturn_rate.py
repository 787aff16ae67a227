"""``seisblock overturn-rate``: curve of the rate, rates under a record, and the effect of dowels."""

from __future__ import annotations

import csv
import json
import math
import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.cli import main
from seisblock.criteria.gravestones import DOWELLED, overturning_ratio
from seisblock.samples import sample_path
from seisblock.studies.intervals import clopper_pearson

pytestmark = pytest.mark.usefixtures("computed_once")

AOYAMA = read_cemetery("aoyama.csv")
KEYS = {"pga_m_s2", "equivalent_frequency_hz", "threshold_ratio", "rate", "rate_interval"}


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Return a function that runs the command in an empty directory."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")
    return lambda *words: CliRunner().invoke(main, ["overturn-rate", *map(str, words)])


@pytest.fixture
def document(run):
    """Return a function that runs the command and returns its JSON document."""
    return lambda *words: json.loads(run(*words, "--json").stdout)


@pytest.fixture
def sines(tmp_path):
    """A plain CSV: 1 Hz, 300 gal north; 2 Hz, 400 gal east; 60 s."""
    t = np.arange(12001) * 0.005
    rows = np.column_stack([t, 300 * np.sin(2 * math.pi * t), 400 * np.sin(4 * math.pi * t)])
    np.savetxt(tmp_path / "sines.csv", rows, delimiter=",", header="time,NS (gal),EW (gal)", comments="", fmt="%.17g")
    return "sines.csv"


@pytest.mark.parametrize("words", [["aoyama.csv"], ["aoyama"]])
def test_overturn_rate_uses_bundled_cemetery(run, words):
    """``seisblock overturn-rate --cemetery aoyama.csv`` prints the curve where there is no such file."""
    result = run("--cemetery", *words)
    assert result.exit_code == 0
    assert "aoyama: 100 stones" in result.stdout
    assert "RECONSTRUCTED" in result.stderr
    assert "0.5 Hz" in result.stdout


def test_overturn_rate_prefers_local_file(run, tmp_path):
    """The same line from a directory that holds a file of that name takes that file."""
    (tmp_path / "aoyama.csv").write_text("height_over_width\n2.0\n3.0\n", encoding="utf-8")
    assert "aoyama: 2 stones" in run("--cemetery", "aoyama.csv").stdout
    shutil.copy(sample_path("aoyama.csv"), tmp_path / "aoyama.csv")
    assert "aoyama: 100 stones" in run("--cemetery", "aoyama.csv").stdout


def test_overturn_rate_document_has_curve(document):
    """Without a record the one result holds the curve, which stands at the top level, too; each point is the share above (9)."""
    answer = document("--cemetery", "aoyama.csv")
    assert answer["schema"] == "seisblock/overturn-rate/2"
    assert answer["results"] == [{"curve": answer["curve"]}]
    assert answer["record"] is None
    assert {point["frequency_hz"] for point in answer["curve"]} == {0.5, 1.0, 1.5, 2.0, 2.5, 3.0}
    for point in answer["curve"]:
        assert point["rate"] == AOYAMA.share_above(float(overturning_ratio(point["pga_m_s2"], point["frequency_hz"])))
    assert answer["citations"] == ["Furukawa2009"]
    assert answer["parameters"]["fit"] == {"p_m_s2": 8.268, "q_hz": 1.92, "r": 4.6, "name": "plain"}


def test_overturn_rate_of_record_has_result_per_horizontal(document, sines):
    """One result per horizontal and one for the larger of them, with PGA, equivalent frequency, threshold, rate and interval."""
    answer = document("--cemetery", "aoyama.csv", sines, "--criterion", "furukawa")
    assert [item["component"] for item in answer["results"]] == ["NS", "EW", "larger"]
    for result, (pga, f) in zip(answer["results"], ((3.0, 1.0), (4.0, 2.0)), strict=False):
        assert set(result) >= KEYS
        assert result["pga_m_s2"] == pytest.approx(pga, rel=1e-9)
        assert result["equivalent_frequency_hz"] == pytest.approx(f, rel=5e-3)
        assert result["threshold_ratio"] == pytest.approx(float(overturning_ratio(result["pga_m_s2"], result["equivalent_frequency_hz"])))
        assert result["rate"] == AOYAMA.share_above(result["threshold_ratio"])
        assert result["rate_interval"] == pytest.approx(clopper_pearson(result["fallen"], 100))
        assert any(point["frequency_hz"] == result["equivalent_frequency_hz"] for point in result["curve"])
    ns, _, larger = answer["results"]
    assert larger["of"] == "NS"
    assert {**larger, "component": "NS", "of": None} == ns
    assert answer["parameters"]["velocity_highpass_hz"] == 0.05
    assert answer["record"]["sha256"]


def test_overturn_rate_accepts_pga_and_frequency_pairs(document):
    """--pga in gal and --frequency in Hz give one result per pair; the rate of Kofu in table 6 is 0.35."""
    answer = document("--cemetery", "aoyama.csv", "--pga", "725,280", "--frequency", "2.75,1.65")
    pairs = [(r["pga_m_s2"], r["equivalent_frequency_hz"]) for r in answer["results"]]
    assert pairs == [(7.25, 2.75), (7.25, 1.65), (2.8, 2.75), (2.8, 1.65)]
    assert answer["results"][0]["rate"] == 0.35
    assert answer["results"][3]["rate"] == 0.10
    assert len(document("--cemetery", "aoyama.csv", "--pga", "725")["results"]) == 6


def test_overturn_rate_takes_pairs(document, run):
    """--paired takes the lists side by side, each result equal to that of its pair alone; unequal lists and a record are refused."""
    results = document("--cemetery", "aoyama.csv", "--pga", "725,280", "--frequency", "2.75,1.65", "--paired")["results"]
    assert [(r["pga_m_s2"], r["equivalent_frequency_hz"], r["rate"]) for r in results] == [(7.25, 2.75, 0.35), (2.8, 1.65, 0.10)]
    refused = run("--cemetery", "aoyama.csv", "--pga", "725,280", "--frequency", "2.75", "--paired")
    assert (refused.exit_code, "as many values" in refused.stderr) == (2, True)
    assert run("--cemetery", "aoyama.csv", "synthetic_jma.csv", "--paired").exit_code == 2


def test_overturn_rate_both_without_record_draws_both_curves(run, monkeypatch):
    """The figure of the curve has a panel with dowels, whose rates lie lower; without --both it has none."""
    figures = []
    monkeypatch.setattr("seisblock.cli.write_results._write_figure", lambda figure, *_: figures.append(figure()))
    for words in (("--both",), ()):
        assert run("--cemetery", "aoyama.csv", *words, "--plot", "rate.png").exit_code == 0
    pair, plain = figures
    assert (len(pair.axes), len(plain.axes)) == (3, 2)
    rates, dowelled = (np.asarray(axes.lines[0].get_ydata()) for axes in pair.axes[1:])
    assert (dowelled <= rates).all()
    assert (dowelled < rates).any()


def test_overturn_rate_of_reinforced_stones(run, document):
    """--reinforced applies (10), --both shows the effect of all dowels, --most-fragile that of a few."""
    words = ("--cemetery", "aoyama.csv", "--pga", 725, "--frequency", 2.75)
    (dowelled,) = document(*words, "--reinforced")["results"]
    assert dowelled["threshold_ratio"] == pytest.approx(float(overturning_ratio(7.25, 2.75, DOWELLED)))
    assert dowelled["rate"] == 0.08
    (result,) = document(*words, "--both")["results"]
    assert result["rate"] == 0.35
    assert result["reinforced"]["rate"] == 0.08
    assert result["reinforced"]["stones_saved"] == 27
    (subset,) = document(*words, "--most-fragile", 12)["results"]
    assert subset["reinforced"]["stones_saved"] == 4
    completed = run(*words, "--both")
    assert "27 fewer" in completed.stdout
    assert "require 1342 to 1409 gal" in completed.stderr
    assert "1342" not in run(*words, "--both", "--fit-reinforced", "1362.9,1.84,4.5").stderr
    assert run(*words, "--both", "--reinforced").exit_code == 2


def test_overturn_rate_fit_options_replace_parameters(document):
    """--fit and --fit-reinforced replace p (gal), q (Hz) and r."""
    words = ("--cemetery", "aoyama.csv", "--pga", 894, "--frequency", 2.2)
    (result,) = document(*words, "--fit", "900,2,4", "--fit-reinforced", "1362.9,1.84,4.5")["results"]
    assert result["threshold_ratio"] == pytest.approx(900 * math.sqrt(1 + 1.1**4) / 894)
    assert result["threshold_ratio_reinforced"] == pytest.approx(2.742, abs=5e-4)


@pytest.mark.slow
def test_overturn_rate_criteria_rigid_and_simulated(document, sines):
    """A rigid block needs no fit; simulated stones come close to (9) with inset pivots and say no threshold."""
    words = ("--cemetery", "aoyama.csv", "--pga", 300, "--frequency", 1)
    (rigid,) = document(*words, "--criterion", "rigid", "--inset", 0)["results"]
    assert rigid["rate"] == 0.04
    assert document(*words, "--criterion", "rigid")["results"][0]["rate"] == 0.07
    assert document(*words, "--criterion", "rigid", "--inset", 0.1)["results"][0]["rate"] == 0.1
    (inset,) = document(*words, "--criterion", "simulate", "--inset", 0.1)["results"]
    assert inset["threshold_ratio"] is None
    assert inset["rate"] == pytest.approx(0.35, abs=0.05)
    answer = document("--cemetery", "aoyama.csv", sines, "--window", "0:20", "--criterion", "simulate", "--inset", 0.1)
    assert answer["results"][0]["rate"] == pytest.approx(0.35, abs=0.05)
    assert {point["frequency_hz"] for point in answer["results"][0]["curve"]} == {answer["results"][0]["equivalent_frequency_hz"]}
    assert "Housner1963" in answer["citations"]


def test_overturn_rate_states_rate_by_each_model(document, run):
    """The rate by each model stands in one sentence, and what its interval is of in the caption (N12, N15)."""
    words = ("--cemetery", "aoyama.csv", "elcentro_1940_ns")
    output = " ".join(run(*words).stdout.split())
    assert "NS, overturning rate by model: 32 % (gravestone criterion), 3 % (half-sine pulse of" in output
    assert re.search(r"half-sine pulse of \d\.\d+ Hz with worn edges\), 9 %", output)
    assert "9 % (rigid block with worn edges), 8 % (rigid block with sharp edges)" in output
    assert "sharp edges) (largest over smallest 10.7)" in output
    assert "sampling interval of the rate (Clopper-Pearson) only" in output
    (result,) = document(*words)["results"]
    assert [model["rate"] for model in result["models"]] == [0.32, 0.03, 0.09, 0.08]


def test_overturn_rate_frequency_kind_is_selectable(document, sines):
    """The kind of equivalent frequency can be chosen, or the frequency given."""
    words = ("--cemetery", "aoyama.csv", sines, "--component", "EW")
    for kind in ("fourier", "pulse-width"):
        (result,) = document(*words, "--equivalent", kind)["results"]
        assert result["equivalent_frequency_hz"] == pytest.approx(2.0, rel=1e-2)
    (component_result,) = document(*words, "--frequency", 1.5)["results"]
    assert component_result["equivalent_frequency_hz"] == 1.5


def test_overturn_rate_writes_csv_and_figure(run, sines):
    """--csv writes the curve where no shaking is named, --plot a figure."""
    result = run("--cemetery", "aoyama.csv", "--both", "--csv", "curve.csv", "--plot", "rate.png")
    assert result.exit_code == 0
    rows = list(csv.DictReader(Path("curve.csv").read_text(encoding="utf-8").splitlines()))
    assert list(rows[0]) == ["pga_m_s2", "frequency_hz", "rate", "rate_reinforced"]
    assert len(rows) == 6 * 36
    assert Path("rate.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    "words",
    [
        ["sines.csv", "--window", "0:6"],
        ["sines.csv", "--window", "0:6", "--both"],
        ["--pga", "300,725", "--frequency", "1"],
        ["sines.csv", "elcentro_1940_ns", "--window", "0:6"],
        ["sines.csv", "--window", "0:6", "--criterion", "simulate"],
    ],
    ids=" ".join,
)
def test_overturn_rate_csv_has_row_per_result(document, sines, words):
    """--csv of a record, or of bare numbers, has a row for each of the results that the document holds (it held the curve alone)."""
    words = ["--cemetery", "aoyama.csv", *words]
    results = document(*words, "--csv", "rates.csv")["results"]
    rows = list(csv.DictReader(Path("rates.csv").read_text(encoding="utf-8").splitlines()))
    assert len(rows) == len(results)
    for row, item in zip(rows, results, strict=True):
        after = item["reinforced"] or {}
        mapping = {**item, **{f"{name}_reinforced": value for name, value in after.items()}}
        for key, of in (("rate", item), ("rate_reinforced", after)):
            if of:
                limits = of["rate_interval"]
                mapping |= {key.replace("rate", "rate_low"): limits[0], key.replace("rate", "rate_high"): limits[1]}
        assert row == {name: "" if mapping[name] is None else str(mapping[name]) for name in row}
        assert {"component", "pga_m_s2", "rate", "rate_low", "rate_high"} <= row.keys()
        assert ("rate_reinforced" in row) == bool(after)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--pga", 5.5, "--frequency", 1), "check the unit (gal, not m/s^2)"),
        (("--pga", 1400, "--frequency", 1), "PGA 1400 gal is outside the range of the fit (100 to 1300 gal)"),
        (("--pga", 700, "--frequency", 4.5), "frequency 4.5 Hz is outside the range of the fit (0.5 to 3 Hz)"),
    ],
)
def test_overturn_rate_warns_outside_fit(run, words, message):
    """An implausible PGA and values outside the fit give warnings on stderr and in the document."""
    result = run("--cemetery", "aoyama.csv", *words, "--json")
    assert message in result.stderr
    document = json.loads(result.stdout)
    assert any(message in text for text in document["warnings"])
    assert document["results"][0]["outside_fit"]


@pytest.mark.parametrize(
    ("words", "code", "message"),
    [
        ((), 2, "Missing option '--cemetery'"),
        (("--cemetery", "nothing.csv"), 3, "no cemetery file nothing.csv"),
        (("--cemetery", "bad.csv"), 3, "bad.csv, line 3: height_over_width must be positive, found 0"),
        (("--cemetery", "empty.csv"), 3, "empty.csv contains no gravestones"),
        (("--cemetery", "aoyama.csv", "--pga", -3, "--frequency", 1), 3, "peak ground acceleration must be positive"),
        (("--cemetery", "aoyama.csv", "--pga", 3, "--frequency", -1), 3, "frequency must be zero or more"),
        (("--cemetery", "aoyama.csv", "--pga", 300, "sines.csv"), 2, "RECORD and --pga exclude each other"),
        (("--cemetery", "aoyama.csv", "--frequency", "1,2", "sines.csv"), 2, "--frequency accepts one value"),
        (("--cemetery", "aoyama.csv", "--pga", 300, "--criterion", "rigid", "--both"), 3, "a rigid block does not model dowels"),
        (("--cemetery", "aoyama.csv", "--criterion", "simulate", "--inset", 1.2), 3, "inset"),
        (("--cemetery", "aoyama.csv", "--fit", "826.8,1.92"), 2, "is not P,Q,R"),
        (("--cemetery", "aoyama.csv", "--fit", "0,1,1"), 3, "must be positive"),
        (("--cemetery", "aoyama.csv", "--confidence", 95), 2, "lie in (0, 1)"),
        (("--cemetery", "aoyama.csv", "nothing.csv"), 3, "nothing.csv"),
        (("--cemetery", "aoyama.csv", "zero.csv"), 3, "component NS has no equivalent frequency of kind pga_pgv"),
    ],
)
def test_overturn_rate_reports_bad_input_in_one_sentence(run, sines, tmp_path, words, code, message):
    """Bad input gives one sentence on stderr and an exit code, no traceback."""
    (tmp_path / "bad.csv").write_text("H/B\n2.5\n0\n", encoding="utf-8")
    (tmp_path / "empty.csv").write_text("", encoding="utf-8")
    (tmp_path / "zero.csv").write_text("time,NS (gal)\n0,0\n0.01,0\n0.02,0\n", encoding="utf-8")
    result = run(*words)
    assert result.exit_code == code
    assert message in result.stderr
    assert "Traceback" not in result.stderr
    assert result.stdout == ""
