"""``seisblock infer`` reads shaking back from fallen stones and displaced objects."""

from __future__ import annotations

import csv
import json
import math
import re
from functools import partial
from pathlib import Path

import pytest
from click.testing import CliRunner

from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.cli import main
from seisblock.criteria.gravestones import overturning_level
from seisblock.studies.survey import estimate

ESTIMATE = {
    "jma_class_by_rule",
    "each_stone",
    "contingency",
    "stones",
    "fallen",
    "standing",
    "frequency_hz",
    "bound",
    "pga_m_s2",
    "pga_interval_m_s2",
    "pgv_m_s",
    "pgv_interval_m_s",
    "threshold_ratio",
    "threshold_ratio_interval",
    "jma_intensity",
    "jma_intensity_interval",
    "jma_classes",
}


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Return a function that runs the command in an empty directory."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")
    return lambda *words: CliRunner().invoke(main, ["infer", *map(str, words)])


@pytest.fixture
def document(run):
    """Return a function that runs the command and returns its JSON document."""
    return lambda *words: json.loads(run(*words, "--json").stdout)


@pytest.fixture
def no_contour(monkeypatch):
    """Compute the contour at one frequency: the test looks at the estimates beside it."""
    monkeypatch.setattr(estimate, "frequency_contour", partial(estimate.frequency_contour, frequencies=[2.0]))


@pytest.fixture
def survey(tmp_path):
    """A survey in Shift-JIS: the stones of Aoyama above H/B 2.84 fell, every tenth is reinforced, one is of unknown fate."""
    rows = ["高さ幅比,転倒,補強", "3.0,,0"]
    for i, ratio in enumerate(read_cemetery("aoyama.csv").ratios):
        rows.append(f"{ratio},{'転倒' if ratio > 2.84 else '残存'},{int(i % 10 == 0)}")
    (tmp_path / "survey.csv").write_bytes("\r\n".join(rows).encode("cp932"))
    return "survey.csv"


def test_infer_from_counts_gives_pga_and_pgv(document):
    """35 of 100 stones like Aoyama's: PGA and PGV for a frequency, near Kofu's 725 gal, the contour beside it; the bias adds to it."""
    bare = ("--bias", 0, "--stone-error", 0.1, "--frequency-error", 0)
    answer = document("--rate", "35/100", "--cemetery", "aoyama.csv", "--frequency", 2.75, *bare)
    (biased,) = document("--rate", "35/100", "--cemetery", "aoyama.csv", "--frequency", 2.75, *bare[2:])["results"]
    assert biased["pga_m_s2"] == pytest.approx(math.exp(0.35) * answer["results"][0]["pga_m_s2"], rel=1e-6)
    assert answer["schema"] == "seisblock/infer/2"
    (result,) = answer["results"]
    assert set(result) == ESTIMATE
    low, high = result["pga_interval_m_s2"]
    assert low < 7.25 < high
    assert result["pga_m_s2"] == pytest.approx(7.25, rel=0.05)
    assert result["pgv_m_s"] == pytest.approx(result["pga_m_s2"] / (2 * math.pi * 2.75))
    assert (result["fallen"], result["standing"], result["stones"]) == (35, 65, "not reinforced")
    assert [point["frequency_hz"] for point in answer["contour"]][::25] == [0.5, 3.0]
    assert answer["parameters"]["common_error_ln_pga"] == 0.24
    assert answer["citations"] == ["Furukawa2009"]


def test_infer_without_frequency_averages_band(document):
    """The band is averaged first, then come the paper's six frequencies."""
    results = document("--rate", "35/100", "--cemetery", "aoyama.csv")["results"]
    assert [item["frequency_hz"] for item in results] == [None, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0]


def test_infer_from_observed_stones_separates_reinforced(run, document, survey, no_contour):
    """Marked stones are judged one by one, reinforced ones apart, unknown ones left out."""
    answer = document("--cemetery", survey, "--frequency", 2)
    assert [result["stones"] for result in answer["results"]] == ["not reinforced", "reinforced", "all"]
    assert [result["fallen"] + result["standing"] for result in answer["results"]] == [90, 10, 100]
    assert answer["parameters"]["unknown_stones"] == 1
    plain = document("--cemetery", survey, "--frequency", 2, "--bias", 0, "--stone-error", 0.05)["results"][0]
    assert plain["pga_m_s2"] == pytest.approx(float(overturning_level(2.0)) / 2.84, rel=0.05)
    result = run("--cemetery", survey, "--frequency", 2)
    output = result.stdout
    assert "1 of 101 stones omitted: overturning unknown" in result.stderr
    assert "survey, stones not reinforced: 32 of 90 overturned" in output
    assert "JMA intensity" in output


def test_infer_none_or_all_fallen_gives_bound(run, document):
    """None fallen is an upper bound, all fallen a lower one, and both are stated."""
    (none,) = document("--rate", "0/50", "--cemetery", "aoyama.csv", "--frequency", 1)["results"]
    assert none["bound"] == "upper"
    assert none["pga_m_s2"] is None
    assert none["pga_interval_m_s2"][0] is None
    assert none["jma_classes"][0] is None
    result = run("--rate", "50/50", "--cemetery", "aoyama.csv", "--frequency", 1)
    assert "lower bound only (all overturned)" in result.stderr
    assert "at least" in result.stdout


def test_infer_from_sliding_lists_factors(run, document):
    """Each component of each candidate has its factors, or its largest displacement where none suffices."""
    answer = document("--slid", "0.35m", "--mu", 0.3, "synthetic_jma.csv", "elcentro_1940_ns.csv", "--steps", 60)
    assert [(item["record_index"], item["component"]) for item in answer["results"]] == [(0, "NS"), (0, "EW"), (1, "NS")]
    for result in answer["results"][:2]:
        assert result["observed_m"] == 0.35
        assert result["scale_factors"]
        for factor in result["scale_factors"]:
            assert factor["displacement_m"] == pytest.approx(0.35, rel=1e-6)
            assert factor["pga_m_s2"] == pytest.approx(factor["scale"] * result["pga_m_s2"])
    assert answer["results"][2]["scale_factors"] == []
    assert answer["citations"] == ["Fujino1978"]
    output = run("--slid", "35cm", "--mu", 0.3, "elcentro_1940_ns.csv", "--steps", 60).stdout
    assert "not reached by scale factors up to 3" in " ".join(output.split())
    output = run("--slid", "5cm", "--mu", 0.2, "--component", "NS", "--steps", 60).stdout
    japanese = run("--slid", "5cm", "--mu", 0.1, "--component", "10", "hanmer_springs_2016", "--lang", "ja").stdout.partition("HSES")[0]
    assert japanese.count("（") >= 3 and "gal)" not in japanese
    assert "NS: slip of 5.0 cm at a scale factor of 0.635 (593.2 gal); unscaled record: 43.2 cm." in " ".join(output.split())
    output = run("--slid", "43.4cm", "--mu", 0.2, "--component", "NS", "--steps", 60).stdout
    assert "at a scale factor of 1.002 (935.5 gal)" in " ".join(output.split())
    output = run("--slid", "5cm", "--mu", 0.2, "--component", "NS", "--steps", 60, "--no-vertical").stdout
    assert "NS: slip of 5.0 cm at a scale factor of 0.612 (571.5 gal); unscaled record: 44.8 cm." in " ".join(output.split())


def test_infer_from_jump_uses_bundled_block(document):
    """The bundled Chozu-sha is used by name, with the displacement under the unscaled record."""
    (answer,) = document("--jumped", "0.04m", "--block", "chozusha", "--drop", 0, "--component", "EW", "--steps", 60, "--limit", 1.5)[
        "results"
    ]
    assert answer["displacement_at_1_m"] == pytest.approx(0.2154, abs=1e-3)
    assert answer["scale_factors"]
    (first,) = document(
        "--jumped", "4cm", "--block", "chozusha", "--drop", 0, "--component", "EW", "--steps", 60, "--limit", 1.5, "--first"
    )["results"]
    assert first["displacement_at_1_m"] == pytest.approx(0.0461, abs=1e-3)
    assert any(0.8 < factor["scale"] < 1.0 and not factor["leaps"] for factor in first["scale_factors"])


def test_infer_jump_continues_beyond_window(document):
    """The window limits the start of rocking; the chain that starts in it is solved to its end (N4, N5)."""
    words = ("--jumped", "10cm", "--drop", 0, "--component", "EW", "--steps", 20, "--limit", 1.5)
    (inside,) = document(*words, "--window", "26.1:26.2")["results"]
    assert inside["displacement_at_1_m"] == pytest.approx(0.1743, abs=1e-3)


@pytest.mark.slow
def test_infer_writes_csv_and_figure(run, survey):
    """--csv writes the contour, or the displacement against the factor; --plot the figure."""
    assert run("--cemetery", survey, "--frequency", 2, "--csv", "contour.csv", "--plot", "shaking.png").exit_code == 0
    rows = list(csv.DictReader(Path("contour.csv").read_text(encoding="utf-8").splitlines()))
    assert len(rows) == 26
    assert float(rows[0]["pga_low_m_s2"]) < float(rows[0]["pga_m_s2"]) < float(rows[0]["pga_high_m_s2"])
    words = ("--slid", "0.1", "--mu", 0.3, "--component", "NS", "--steps", 30)
    assert run(*words, "--csv", "factors.csv", "--plot", "factors.png").exit_code == 0
    rows = list(csv.DictReader(Path("factors.csv").read_text(encoding="utf-8").splitlines()))
    assert len(rows) == 31
    assert run("--rate", "0/9", "--cemetery", "aoyama.csv", "--frequency", 2, "--plot", "bound.png").exit_code == 0
    for name in ("shaking.png", "factors.png", "bound.png"):
        assert Path(name).read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("words", "code", "message"),
    [
        ((), 2, "exactly one of --cemetery"),
        (("--cemetery", "aoyama.csv", "--slid", 1), 2, "found --cemetery, --slid"),
        (("--rate", "35/100"), 2, "exactly one of --cemetery"),
        (("--rate", "35/100", "--slid", 1, "--mu", 0.3), 2, "--rate requires --cemetery"),
        (("--cemetery", "aoyama.csv"), 3, "no stone is marked overturned or standing"),
        (("--cemetery", "aoyama.csv", "--rate", "0.35"), 3, "give both numbers, for example 35/100"),
        (("--cemetery", "aoyama.csv", "--rate", "5/4"), 3, "0 <= fallen <= stones"),
        (("--cemetery", "aoyama.csv", "--rate", "5/9", "record.csv"), 2, "has no effect with stones"),
        (("--cemetery", "aoyama.csv", "--rate", "5/9", "--frequency", 0), 3, "frequency must be positive"),
        (("--cemetery", "aoyama.csv", "--rate", "5/9", "--confidence", 90), 3, "lie in (0, 1)"),
        (("--cemetery", "aoyama.csv", "--rate", "5/9", "--common-error", 0), 3, "--common-error, in ln PGA"),
        (("--cemetery", "odd.csv"), 3, "odd.csv, line 3: fallen must be 0, 1, yes, no, 転倒 or 残存, found '半壊'"),
        (("--slid", 0.1), 2, "--slid needs --mu"),
        (("--slid", -0.1, "--mu", 0.3), 3, "observed displacement must be positive"),
        (("--slid", 0.1, "--mu", -0.3), 3, "mu"),
        (("--slid", "0.1furlong", "--mu", 0.3), 2, "furlong"),
        (("--jumped", 0.1, "--block", "nothing"), 3, "no body file nothing"),
        (("--jumped", 0.1, "--limit", 0), 3, "largest factor must be positive"),
    ],
)
def test_infer_reports_bad_input_in_one_sentence(run, tmp_path, words, code, message):
    """Bad input gives one sentence on stderr and an exit code, no traceback."""
    (tmp_path / "odd.csv").write_text("H/B,fallen\n2.5,1\n2.6,半壊\n", encoding="utf-8")
    result = run(*words)
    assert result.exit_code == code
    assert message in " ".join(result.stderr.split())
    assert "Traceback" not in result.stderr
    assert result.stdout == ""


def test_infer_combines_several_cemeteries(run, document, survey, no_contour, tmp_path):
    """N10: each by itself, under its own name, and all together; none is dropped, and none counts double."""
    second = tmp_path / "other.csv"
    second.write_bytes(Path(survey).read_bytes())
    answer = document("--cemetery", survey, "--cemetery", second, "--frequency", 2)
    output = run("--cemetery", survey, "--cemetery", second, "--frequency", 2).stdout
    assert "survey, stones not reinforced: 32 of 90 overturned" in output and "other, stones not reinforced: 32 of 90 overturned" in output
    twice = run("--cemetery", survey, "--cemetery", survey, "--frequency", 2)
    assert twice.exit_code == 2 and "give each cemetery only once" in " ".join(twice.stderr.split())
    assert len(answer["results"]) == 6 and len(answer["joint"]) == 1
    assert answer["joint"][0]["contradicts"] == []
    assert answer["parameters"]["stones"] == 2 * 101


def test_infer_names_contradicting_cemeteries(document, tmp_path):
    """N10: the sentence names both."""
    for name, falls in (("one", "転倒"), ("other", "残存")):
        rows = ["H/B,fallen"] + [f"{1.6 + 0.05 * i},{falls if i not in (0, 49) else ('残存' if i == 0 else '転倒')}" for i in range(50)]
        (tmp_path / f"{name}.csv").write_text("\n".join(rows))
    answer = document("--cemetery", tmp_path / "one.csv", "--cemetery", tmp_path / "other.csv", "--frequency", 2)
    assert any("one and other contradict each other" in text for text in answer["warnings"])


def test_infer_notes_eq_10_for_reinforced_stones_only(document, tmp_path):
    """Two places without a dowel hear nothing of equation (10)."""
    for name in ("one", "other"):
        (tmp_path / f"{name}.csv").write_text("\n".join(["H/B,fallen"] + [f"{1.5 + 0.1 * i},{int(i > 12)}" for i in range(30)]))
    answer = document("--cemetery", tmp_path / "one.csv", "--cemetery", tmp_path / "other.csv", "--frequency", 2)
    assert not any("reinforced stones: (10)" in text for text in answer["warnings"])


def test_infer_warns_of_impossible_survey(document, tmp_path):
    """N10: squat stones fell, slender ones stand."""
    rows = ["H/B,fallen"] + [f"{1.3 + 0.03 * i},1" for i in range(30)] + [f"{3.5 + 0.05 * i},0" for i in range(30)]
    (tmp_path / "odd.csv").write_text("\n".join(rows))
    answer = document("--cemetery", tmp_path / "odd.csv", "--frequency", 2)
    assert any("survey inconsistent with the criterion" in text for text in answer["warnings"])


def test_table_of_stones_has_a_line_per_frequency_at_80_columns_in_japanese(run, no_contour):
    """The last column had no room: every row took two lines, the intensity alone in the second."""
    lines = run("--cemetery", "aoyama.csv", "--rate", "35/100", "--lang", "ja").stdout.splitlines()
    first = next(i for i, line in enumerate(lines) if "f (Hz)" in line) + 2
    rows = lines[first : first + 7]
    assert [row.split()[0] for row in rows] == ["0.5～3", "0.5", "1", "1.5", "2", "2.5", "3"]
    assert all(re.search(r"\d \(\d+～\d+\) .*\d \([\d.]+～[\d.]+\) .* [56]. *～?.*\(\d\.\d\)$", row.rstrip()) for row in rows), rows
