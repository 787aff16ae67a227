"""``seisblock criteria`` puts every closed form beside the simulated outcome."""

import csv
import json

import pytest
from click.testing import CliRunner

from seisblock.cli import main


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Return a function that runs the command in an empty directory."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "130")
    return lambda *words: CliRunner().invoke(main, ["criteria", *map(str, words)])


def test_criteria_document_has_rows_and_simulated_outcome(run):
    """Each row has threshold, demand, verdict and its formula's place; the simulated outcome is that of rock, without its samples."""
    output = json.loads(run("--width", "24cm", "--height", "72cm", "--json").stdout)
    rocked = json.loads(CliRunner().invoke(main, ["rock", "--width", "24cm", "--height", "72cm", "--json"]).stdout)
    assert output["schema"] == "seisblock/criteria/1"
    for result, simulated in zip(output["results"], rocked["results"], strict=True):
        assert result["component"] == simulated.pop("component")
        assert result["shaking"] == simulated.pop("shaking")
        assert "class" in simulated.pop("assessment")
        assert result["simulated"] == simulated
        for row in result["criteria"]:
            assert row["overturns"] == (row["demand"] > row["threshold"])
            assert row["where"].startswith("[")
            assert row["demand"] in (result["pga_m_s2"], result["pgv_m_s"])
        names = {row["criterion"] for row in result["criteria"]}
        assert len(names) == 14
        frequencies = {row["frequency"] for row in result["criteria"]} - {None}
        assert frequencies == {"pga_pgv", "fourier", "pulse_width"}


def test_criteria_equal_hand_calculation(run):
    """West 9.80665/3, Ishiyama 24/sqrt(0.72) cm/s, Furukawa (9) at the record's own frequency."""
    result = json.loads(run("--width", "24cm", "--height", "72cm", "--component", "NS", "--json").stdout)["results"][0]
    rows = {(row["criterion"], row["frequency"]): row["threshold"] for row in result["criteria"]}
    f = result["equivalent_frequency_hz"]["pga_pgv"]
    assert rows["West, static", None] == pytest.approx(9.80665 / 3, rel=1e-12)
    assert rows["Ishiyama, velocity", None] == pytest.approx(0.24 / 0.72**0.5, rel=1e-12)
    assert rows["gravestone", "pga_pgv"] == pytest.approx(8.268 * (1 + (f / 1.92) ** 4.6) ** 0.5 / 3, rel=1e-12)


def test_criteria_writes_table_csv_and_figure(run, tmp_path):
    """The table ends with the simulated outcome; the files hold all rows and the figure."""
    answer = run("--block", "gravestone", "--component", "EW", "--csv", "card.csv", "--plot", "card.png", "--scale", 0.3, "--details")
    assert answer.exit_code == 0, answer.output
    assert "EW, simulation:" in answer.stdout
    assert "of 14 criteria agree" in " ".join(answer.stdout.split())
    assert "largest over smallest" in " ".join(answer.stdout.split())
    assert "half sine, nonlinear" in answer.stdout
    rows = list(csv.DictReader((tmp_path / "card.csv").open()))
    assert len(rows) == 30
    assert {row["unit"] for row in rows} == {"m/s^2", "m/s"}
    assert (tmp_path / "card.png").stat().st_size > 10_000


@pytest.mark.parametrize("words", [[], ["--width", "-1", "--height", "1"], ["--width", "1", "--height", "1", "--restitution", "2"]])
def test_criteria_reports_bad_input_in_one_sentence(run, words):
    """No traceback for what a user can get wrong."""
    answer = run(*words)
    assert answer.exit_code in (2, 3)
    assert answer.stdout == ""
    assert "Traceback" not in answer.output


def test_criteria_states_full_response_of_body():
    """In one sentence and in the document: with the friction given, the body's own, or that of feet that hold."""
    result = CliRunner().invoke(main, ["criteria", "elcentro_1940_ns", "--width", "24cm", "--height", "72cm", "--mu", "0.2", "--quiet"])
    assert "NS, full response (respond, friction 0.2): slides" in " ".join(result.stdout.split())
    for words, mu, expected in ((("--block", "gravestone"), 0.438, True), (("--width", "24cm", "--height", "72cm"), 0.8 * 4 / 3, False)):
        output = json.loads(CliRunner().invoke(main, ["criteria", "elcentro_1940_ns", *words, "--json"]).stdout)["results"][0]["respond"]
        assert output["mu"] == pytest.approx(mu) and output["friction_known"] is expected
        single = CliRunner().invoke(main, ["respond", "elcentro_1940_ns", *words, "--mu", repr(output["mu"]), "--runs", "0", "--json"])
        outcome = json.loads(single.stdout)["results"][0]
        assert {key: output[key] for key in ("overturned", "slip_path_m")} == {key: outcome[key] for key in ("overturned", "slip_path_m")}
