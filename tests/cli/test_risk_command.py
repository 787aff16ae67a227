"""``seisblock risk``: its document, its files and its refusals."""

import csv
import json
import math

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.cli import main
from seisblock.core.i18n import use_locale
from seisblock.fragility import find_risk, read_hazard
from seisblock.report.json.risk import document
from seisblock.report.text.risk import risk_label
from seisblock.studies.fragility.io import FragilityCurve
from seisblock.studies.fragility.lognormal import Lognormal
from seisblock.studies.hazard.curve import Hazard, HazardCurve

LINE = ("--median", "60cm/s", "--beta", "0.4", "--hazard", "synthetic_hazard.csv")


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Return a function that runs the command in an empty directory."""
    monkeypatch.chdir(tmp_path)
    return lambda *words: CliRunner().invoke(main, ["risk", *map(str, words)])


def test_risk_document_equals_library(run):
    """The keys that others rely on, with what the library finds."""
    document = json.loads(run(*LINE, "--years", 30, "--json").stdout)
    assert document["schema"] == "seisblock/risk/1" and document["record"] is None
    (result,) = document["results"]
    risk = find_risk(Lognormal(0.6, 0.4), read_hazard("synthetic_hazard.csv"), years=30.0)
    assert result["annual_rate"] == risk.annual_rate
    assert result["return_period_years"] == pytest.approx(1.0 / risk.annual_rate)
    assert result["probability"] == {"years": 30.0, "value": pytest.approx(1.0 - math.exp(-30.0 * risk.annual_rate))}
    assert result["fragility"] == {"median": 0.6, "beta": 0.4}
    assert result["branches"][0]["standing"] is None


def test_risk_of_power_law_has_closed_form(run, tmp_path):
    """k0 median^-k exp(k² beta²/2), from files as a user has them, in g."""
    (tmp_path / "h.csv").write_text("pga_g,annual_rate\n0.05,0.04\n0.1,0.01\n0.2,0.0025\n0.4,0.000625\n")
    document = json.loads(run("--median", "0.3g", "--beta", 0.5, "--im", "pga", "--hazard", "h.csv", "--json").stdout)
    assert document["results"][0]["annual_rate"] == pytest.approx(1e-4 * 0.3**-2 * math.exp(0.5 * (2 * 0.5) ** 2), rel=1e-9)


def test_risk_first_line_states_rate_and_probability(run):
    """The first line states the annual rate and the probability in the given years."""
    first = run(*LINE, "--years", 30, "--quiet").stdout.splitlines()[0]
    assert first == "return period 552 years; probability in 30 years 5 %."


def test_risk_of_median_has_no_column_of_limit_states(run):
    """A median on the command line has no name; a dash stood there."""
    assert "limit state" not in run(*LINE).stdout and "\xa0-\xa0" not in run(*LINE).stdout.replace(" ", "\xa0")


def test_risk_writes_figure_and_contributions(run, tmp_path):
    """The figure, and the levels that it comes from; their shares have the sum one."""
    assert run(*LINE, "--plot", "risk.svg", "--csv", "risk.csv").exit_code == 0
    assert (tmp_path / "risk.svg").read_text(encoding="utf-8").startswith("<?xml")
    rows = list(csv.DictReader((tmp_path / "risk.csv").open(encoding="utf-8")))
    assert sum(float(row["share"]) for row in rows) == pytest.approx(1.0)
    assert rows[0]["im_from"] == "" and rows[-1]["im_to"] == ""


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (LINE[:2] + LINE[4:], "exactly one form is required: --fragility FILE, or --median and --beta"),
        ((*LINE, "--fragility", "f.json"), "exactly one form is required: --fragility FILE, or --median and --beta"),
        ((*LINE, "--years", "0"), "must be positive"),
        ((*LINE, "--stood", "-5"), "must be positive"),
        ((*LINE, "--im", "pga"), "synthetic_hazard.csv: the levels are of pgv, but pga is required; give a hazard in pga or"),
        ((*LINE, "--im", "sa"), "sa, rotd50 and rotd100 require a period in s (sa=0.5, rotd50:0.5)"),
        (("--median", "0.6", "--beta", "0", *LINE[4:]), "beta, the dispersion of a fragility, must be positive"),
        ((*LINE[:4], "--hazard", "."), "cannot read"),
        ((*LINE, "--csv", "synthetic_hazard.csv", "--plot", "synthetic_hazard.csv"), "synthetic_hazard.csv"),
    ],
    ids=str,
)
def test_risk_reports_bad_input_in_one_sentence(run, words, text):
    """An exit code, a sentence, no traceback."""
    result = run(*words)
    assert result.exit_code in (2, 3) and text in result.stderr and "Traceback" not in result.output


def test_risk_rejects_fragility_in_other_measure(run, tmp_path):
    """The error names the differing measures (was: a missing column)."""
    curve = {"body": "a", "limit": "overturns", "im": "pgv", "unit": "m/s", "median": 0.6, "beta": 0.4}
    (tmp_path / "f.json").write_text(json.dumps({"schema": "seisblock/fragility/1", "results": [curve]}))
    (tmp_path / "h.csv").write_text("pga_g,annual_rate\n0.1,0.01\n0.4,0.000625\n")
    result = run("--fragility", "f.json", "--hazard", "h.csv")
    assert result.exit_code == 3
    curves = "h.csv: the levels are of pga, but pgv is required; give a hazard in pgv or a fragility in pga"
    assert curves in " ".join(result.stderr.split())


def test_risk_states_and_doubts_unit_of_bare_median(run):
    """60 cm/s written as 60 is 60 m/s: the assumed unit is stated, and the warning is about the median, not the table."""
    words = ("--beta", "0.4", "--im", "pgv", "--hazard", "synthetic_hazard.csv")
    output = " ".join(run("--median", "60", *words).stderr.split())
    assert "median 60 has no unit: read as m/s" in output
    assert "the median 60 m/s is far from all levels of the hazard (0.05 to 2 m/s); check its unit" in output
    assert "; add levels" not in output
    output = " ".join(run("--median", "0.6", *words).stderr.split())
    assert "median 0.6 has no unit: read as m/s" in output and "far from" not in output
    assert "is far from" not in run("--median", "3m/s", *words).stderr and "taken" not in run("--median", "3m/s", *words).stderr
    assert "is far from all levels" in " ".join(run("--median", "0.04cm/s", *words).stderr.split())


def test_risk_refuses_to_overwrite_hazard(run, tmp_path):
    """Neither the table nor the figure is written over the file that is read."""
    before = "pgv_m_s,annual_rate\n0.2,0.01\n0.6,0.001\n"
    (tmp_path / "h.csv").write_text(before)
    result = run(*LINE[:4], "--hazard", "h.csv", "--csv", "h.csv")
    assert result.exit_code == 3 and "would overwrite the input file" in result.stderr
    assert (tmp_path / "h.csv").read_text() == before


def test_risk_warning_names_its_curve():
    """A warning about the hazard is printed once."""
    hazard = Hazard("pga", "m/s2", (HazardCurve(np.array([0.1, 0.2]), np.array([1e-2, 2e-3])),), notes=("passed over",))
    curves = [
        FragilityCurve("shelf", limit, "pga", "m/s2", Lognormal(median, 0.4)) for limit, median in (("overturns", 3.0), ("slides", 2.0))
    ]
    answer = document([(item, find_risk(item.curve, hazard)) for item in curves], hazard, "site.csv")
    about, *doubts = answer.warnings
    assert about == "passed over"
    assert [doubt.partition(": ")[0] for doubt in doubts] == ["shelf, overturns", "shelf, slides"]


def test_risk_joins_names_by_locale():
    """The body and what becomes of it, by their names and with the comma of the language spoken."""
    curves = FragilityCurve("bookcase", "rock", "PGV", "m/s", Lognormal(0.6, 0.4))
    names = {}
    for languages in ("en", "ja"):
        with use_locale(languages):
            names[languages] = risk_label(curves)
    assert names["en"].startswith("bookcase, ") and names["ja"].startswith("書棚、")
