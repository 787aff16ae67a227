"""Items of the papers: each is computed, drawn and documented; its verdict follows from the validation cases."""

from __future__ import annotations

import csv
import importlib.util
import json
import math
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.cli import main
from seisblock.criteria.overturning import tsutsui_velocity
from seisblock.paper import Inputs, find_item, find_paper, papers
from seisblock.paper.item import named_places
from seisblock.report.figures.paper import figure
from seisblock.report.text.paper import VERDICTS
from seisblock.validation import cases

ROOT = Path(__file__).parents[2]

ITEMS = {
    "sugimoto2017": "table1 table2 fig12 fig13",
    "tsutsui": "fig2 fig3 fig4",
    "furukawa2009": "fig5 fig7 fig8 fig10 fig13 fig14 fig15 fig16 fig17 fig18 fig19 fig20 table3 table4 table5 table6",
    "fujino1978": "fig4 fig7 fig8 fig9 fig10 fig11 fig12 fig13 fig14 fig15 fig16 fig17",
    "okumura1987": "fig2 fig3 fig4 fig6 fig7 fig8 fig9 fig10 fig11",
}
"""Figures and tables that must be there."""

EVERY = [pytest.param(paper, item, id=f"{paper.key}-{item.name}") for paper in papers() for item in paper.items]


def run(*arguments):
    return CliRunner().invoke(main, ["paper", *map(str, arguments)])


def answer(*arguments):
    result = run(*arguments, "--json")
    assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout)["results"]


def test_every_required_item_is_registered():
    """The figures and tables of the five papers are items."""
    for key, names in ITEMS.items():
        assert set(names.split()) <= {item.name for item in find_paper(key).items}


@pytest.mark.parametrize(("paper", "item"), EVERY)
def test_item_is_computed_and_drawn(paper, item):
    """On the paper's data it has rows with a cell per column, of which some number is finite, and a figure with data."""
    computed = item.compute(Inputs())
    assert computed.rows
    assert computed.source
    assert all(len(row) == len(computed.columns) for row in computed.rows)
    assert len({column.key for column in computed.columns}) == len(computed.columns)
    numbers = [value for row in computed.rows for value in row if isinstance(value, int | float)]
    assert any(math.isfinite(value) for value in numbers)
    fig = figure(paper, item, computed)
    fig.draw_without_rendering()
    assert any(line.get_xydata().size for axes in fig.axes for line in axes.lines) or any(axes.patches for axes in fig.axes)


def test_list_names_items_and_verdicts():
    """Without ITEM the list has every item, and its verdict is that of the cases on its place."""
    listed = {(entry["paper"].lower(), entry["item"]): entry for entry in answer()}
    assert {(key, name) for key, names in ITEMS.items() for name in names.split()} <= set(listed)
    assert {entry["verdict"] for entry in listed.values()} == set(VERDICTS)
    assert listed["fujino1978", "fig15"]["verdict"] == "holds"
    assert listed["fujino1978", "fig7"]["verdict"] == "holds"
    assert listed["sugimoto2017", "table1"]["verdict"] == "differs"
    assert "fig7    Largest sliding displacement" in run("fujino").stdout


def test_differences_are_those_of_the_cases():
    """`differs` holds each differing case of the place, with the printed value, the value here and the cause."""
    (entry,) = answer("furukawa2009", "table4")
    (difference,) = entry["differs"]
    assert (difference["key"], difference["expected"]) == ("furukawa-table-4c-x-7", 2.2)
    assert difference["computed"] == pytest.approx(1170 / (2 * math.pi * 92), abs=1e-9)
    assert "misprint" in difference["cause"] or "inconsistent" in difference["cause"]
    keys = {case.key for case in cases("sugimoto") if case.status == "differs" and "table 1" in case.where}
    assert {d["key"] for d in answer("sugimoto2017", "table1")[0]["differs"]} == keys


def test_headline_counts_one_statement_in_the_singular():
    """Fig. 4 of Tsutsui has one statement, table 1 six."""
    assert "(1 statement compared)" in " ".join(run("tsutsui", "fig4").stdout.split())
    assert "(6 statements compared)" in " ".join(run("tsutsui", "table1").stdout.split())


def test_japanese_table_names_events_and_kinds_of_values():
    """No English word remains in the events of Fujino fig. 4; the column of Sugimoto's tables has a heading of its own."""
    events, values = (
        CliRunner().invoke(main, ["--lang", "ja", "paper", *item]).stdout for item in (("fujino1978", "fig4"), ("sugimoto2017", "table2"))
    )
    assert "滑動開始" in events
    assert "滑動停止" in events
    assert "slip start" not in events
    assert "値の種類" in values


def test_displacement_back_at_its_start_is_shown_as_zero():
    """Fujino fig. 4: the block returns to where it started; the table shows 0, not round-off."""
    assert "e-" not in run("fujino1978", "fig4").stdout


def test_own_data_has_no_verdict():
    """On the user's record the statements of the paper do not apply."""
    (entry,) = answer("fujino1978", "fig7", "sine:300gal@1.5Hz,4s")
    assert (entry["verdict"], entry["differs"], entry["case_count"]) == ("drawn", [], 0)
    assert run("fujino1978", "fig7", "sine:300gal@1.5Hz,4s").stdout.startswith("Fujino1978 fig. 7: Largest sliding displacement")


def test_table_1_has_printed_and_both_computed_rows():
    """Case 16: 616 mm printed, 607 mm by the scheme of the tables, 578 mm corrected; durations of cases 9 to 12 within 2 ms."""
    rows = {(row["case"], row["values"]): row for row in answer("sugimoto2017", "table1")[0]["rows"]}
    assert [round(1e3 * rows["16", kind]["total_displacement_m"]) for kind in ("printed", "paper's scheme", "corrected")] == [
        616,
        607,
        578,
    ]
    for number in ("9", "10", "11", "12"):
        printed, computed = (rows[number, kind]["rock_slide_duration_s"] for kind in ("printed", "paper's scheme"))
        assert computed == pytest.approx(printed, abs=2e-3)
    (prime,) = (r for r in answer("sugimoto2017", "table2")[0]["rows"] if (r["case"], r["values"]) == ("10'", "paper's scheme"))
    assert prime["rock_slide_duration_s"] == pytest.approx(0.099, abs=2e-3)


def test_tsutsui_curves_follow_closed_forms():
    """Velocities of fig. 3 are sqrt(b lambda g); no line of fig. 2 is below lambda g; a body of the user replaces the three."""
    paper = find_paper("tsutsui")
    rows = find_item(paper, "fig3").compute(Inputs()).rows
    np.testing.assert_allclose([row[2] for row in rows], [math.sqrt(b * 9.8 / 4) for b in (1.0, 2.5, 5.0)], rtol=1e-12)
    (panel,) = find_item(paper, "fig. 2").compute(Inputs()).panels
    assert all(np.min(series.y) >= 245.0 - 1e-9 for series in panel.series)
    (content,) = answer("tsutsui", "fig3", "--body", "24cmx72cm")[0]["rows"]
    assert content["velocity_m_s"] == pytest.approx(tsutsui_velocity(0.24, 0.72, 9.8), rel=1e-12)


def test_mode_shapes_solve_the_eigenvalue_problem():
    """Each row of Okumura fig. 2 is a vector with K q = omega^2 M q of the corrected eq. (4), alpha 1, beta 0.707."""
    alpha, beta = 1.0, 0.707
    wx, wz = beta, 1.0
    stiffness = np.diag([wx**2, wx**2, wz**2, *[(wx**2 * alpha**2 + wz**2) / 4] * 2, wx**2 / 2])
    stiffness[0, 4] = stiffness[4, 0] = -alpha / 2 * wx**2
    stiffness[1, 3] = stiffness[3, 1] = alpha / 2 * wx**2
    mass = np.diag([1.0, 1.0, 1.0, (1 + alpha**2) / 12, (1 + alpha**2) / 12, 1 / 6])
    rows = answer("okumura1987", "fig2")[0]["rows"]
    assert len(rows) == 6
    for row in rows:
        shape = np.array([row[key] for key in ("x", "y", "z", "b_theta_x", "b_theta_y", "b_theta_z")])
        np.testing.assert_allclose(stiffness @ shape, row["frequency_ratio"] ** 2 * mass @ shape, atol=1e-12)


STATIONS = "観測点,PGA(gal),PGV(kine),転倒率\n日野,927,113,90%\n境港,213,90,0.36\n"


def test_own_stations_give_fig_20(tmp_path):
    """Stations with PGA and PGV, or a frequency, give the rates of table 6; Japanese headings and per cent are read."""
    path = tmp_path / "観測点.csv"
    path.write_text(STATIONS, encoding="cp932")
    hino, sakaiminato = answer("furukawa2009", "fig20", "--stations", path)[0]["rows"]
    assert hino == {
        "station": "日野",
        "pga_m_s2": pytest.approx(9.27),
        "frequency_hz": pytest.approx(927 / (2 * math.pi * 113)),
        "surveyed": 0.9,
        "plain": 1.0,
        "dowelled": pytest.approx(0.99, abs=0.02),
    }
    assert sakaiminato["plain"] == pytest.approx(0.10, abs=1e-9)
    path.write_text("station,pga,frequency,rate\na,927,1.31,0.9\n", encoding="utf-8")
    assert answer("furukawa2009", "fig18", "--stations", path)[0]["rows"][0]["plain"] == 1.0


BAD_STATIONS = {
    "empty": ("", "no stations"),
    "no rate": ("station,pga,pgv\na,1,1\n", "missing columns: rate"),
    "no frequency": ("station,pga,rate\na,1,0.1\n", "pgv/frequency"),
    "rate above one": ("station,pga,pgv,rate\na,100,10,35\n", "between 0 and 1"),
    "word": ("station,pga,pgv,rate\na,strong,10,0.3\n", "must be a number"),
    "nan": ("station,pga,pgv,rate\na,nan,10,0.3\n", "must be positive"),
    "negative": ("station,pga,pgv,rate\na,-5,10,0.3\n", "must be positive"),
}


@pytest.mark.parametrize("name", BAD_STATIONS)
def test_bad_stations_are_refused(tmp_path, name):
    """Each bad table gets one sentence and exit code 3."""
    text, says = BAD_STATIONS[name]
    path = tmp_path / "stations.csv"
    path.write_text(text, encoding="utf-8")
    refused = run("furukawa2009", "fig20", "--stations", path)
    assert (refused.exit_code, says in refused.stderr) == (3, True), refused.stderr
    assert len(refused.stderr) < 400


BAD_LINES = {
    "unknown paper": (("newton",), 3, "no paper 'newton'"),
    "unknown item": (("tsutsui", "fig9"), 3, "no item 'fig9'"),
    "no record taken": (("tsutsui", "fig2", "synthetic_jma.csv"), 3, "takes no record"),
    "no body taken": (("fujino1978", "fig7", "--body", "gravestone"), 3, "takes no --body"),
    "no vertical": (("fujino1978", "fig9", "elcentro_1940_ns"), 3, "vertical component"),
    "block for two layers": (("sugimoto2017", "table1", "--body", "gravestone"), 3, 'kind must be "two-layer"'),
    "pile for a block": (("tsutsui", "fig2", "--body", "nobody"), 3, "no bundled body"),
    "body of another kind": (("okumura1987", "fig2", "--body", "gravestone"), 3, "kind must be"),
    "component alone": (("fujino1978", "fig7", "--component", "NS"), 2, "without RECORD"),
    "missing stations": (("furukawa2009", "fig20", "--stations", "nowhere.csv"), 3, "nowhere.csv"),
    "folder": (("furukawa2009", "fig20", "--stations", "."), 3, "folder"),
}


@pytest.mark.parametrize("name", BAD_LINES)
def test_bad_lines_are_refused(name):
    """Unknown items and unsupported options give an error of one sentence."""
    line, code, says = BAD_LINES[name]
    refused = run(*line)
    assert (refused.exit_code, says in refused.stderr) == (code, True), refused.stderr


def test_csv_holds_rows_in_si(tmp_path):
    """--csv has the rows of the document."""
    path = tmp_path / "table.csv"
    assert run("furukawa2009", "table4", "--csv", path).exit_code == 0
    with path.open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    expected = answer("furukawa2009", "table4")[0]["rows"]
    assert [float(row["pga_m_s2"]) for row in rows] == pytest.approx([row["pga_m_s2"] for row in expected])


def test_places_of_lists_are_named():
    """A locator that lists places names each of them."""
    assert named_places("section 5, figs. 10, 11") == ["section 5", "fig 10", "fig 11"]
    assert named_places("eq. (10), fig. 12") == ["eq (10)", "fig 12"]
    assert named_places("eq. (1) against (5)") == ["eq (1)", "eq (5)"]


def test_documentation_lists_every_item():
    """The generated table has the command, the verdict and the causes of each item; the page holds its fence."""
    spec = importlib.util.spec_from_file_location("reference", ROOT / "docs" / "_ext" / "reference.py")
    assert spec is not None
    reference = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(reference)
    table = reference.GENERATORS["papers"]("")
    assert "```{papers}\n```" in (ROOT / "docs" / "reference" / "papers.md").read_text(encoding="utf-8")
    for paper in papers():
        for item in paper.items:
            (line,) = [row for row in table.splitlines() if f"`seisblock paper {paper.key.lower()} {item.name}`" in row]
            differing = [case for case in paper.cases(item) if case.status == "differs"]
            assert ("differs" in line.split("|")[4]) == bool(differing)
            assert all(reference.plain(case.note) in line for case in differing)
