"""``seisblock fragility``: what it asks for, what it prints, and what it writes."""

import csv
import json
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock import Block, solve_rock
from seisblock.cli import main
from seisblock.core.i18n import gettext, use_locale
from seisblock.records import Motion
from seisblock.studies.fragility.estimate import IDA, FitOptions
from seisblock.studies.fragility.intensity import intensity_measure
from seisblock.studies.fragility.results import Fragility
from seisblock.studies.fragility.run import fragility_warnings
from tests.motions import synthetic_suite

SHELF = ("--width", "30cm", "--height", "1.2", "--solver", "rock", "--im", "pgv", "--dt", "0.02", "--bootstrap", "20")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with twelve records, and a file that is none."""
    target = tmp_path_factory.mktemp("suite")
    for record in synthetic_suite(12, seconds=15.0):
        lines = "\n".join(repr(float(value)) for value in record.components[0].acceleration)
        (target / f"{record.station}.csv").write_text(f"EW (m/s2)\n{lines}\n")
    return target


def run(*words):
    """Run the command."""
    return CliRunner().invoke(main, ["fragility", *map(str, words)])


def document(*words):
    """Return the JSON document."""
    answer = run(*words, "--json", "--quiet")
    assert answer.exit_code == 0, answer.stderr
    return json.loads(answer.stdout)


def test_fragility_prints_median_then_table(folder):
    """The verdict, the table, and what it rests on; levels and the curve to compare with in kine."""
    answer = run(folder, *SHELF, "--levels", "10:150:10", "--compare", "40,0.4")
    assert answer.exit_code == 0, answer.stderr
    first = answer.stdout.splitlines()[0]
    assert first.startswith("block 0.3 x 1.2 m, overturning: median PGV ") and "kine, beta 0." in first
    assert "12 records, 12 motions" in answer.stdout
    assert "times that of the comparison curve (40.0 kine)" in " ".join(answer.stdout.split())
    content = document(folder, *SHELF, "--levels", "10:150:10", "--compare", "40,0.4")
    assert [level["im"] for level in content["results"][0]["levels"]] == pytest.approx([0.1 * n for n in range(1, 16)])
    assert content["parameters"]["compare"] == {"median": 0.4, "beta": 0.4, "unit": "m/s"}
    assert content["results"][0]["unit"] == "m/s" and content["results"][0]["records"] == 12


def test_fragility_block_equals_bodies_row(folder):
    """--block, --bodies and a table give one curve."""
    listed = document(folder, "--bodies", "gravestone", *SHELF[4:], "--levels", "5:200:15")["results"]
    results = document(folder, "--block", "gravestone", *SHELF[4:], "--levels", "5:200:15")["results"]
    assert listed == results


def test_fragility_writes_csv_figure_pelicun_and_openquake(folder, tmp_path):
    """Counts and curves as a table, the figure, rows for pelicun with what they are, and a model for OpenQuake."""
    names = {
        option: tmp_path / name for option, name in (("--csv", "a.csv"), ("--plot", "b.png"), ("--pelicun", "c.csv"), ("--nrml", "d.xml"))
    }
    answer = run(folder, *SHELF, "--levels", "10:150:10", *(item for pair in names.items() for item in pair))
    assert answer.exit_code == 0, answer.stderr
    with names["--csv"].open() as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == 15 and float(rows[-1]["level"]) == 1.5
    assert float(rows[0]["share"]) == float(rows[0]["exceeding"]) / 12
    assert all(path.stat().st_size > 0 for path in names.values())
    assert set(json.loads((tmp_path / "c.json").read_text())) == {"_GeneralInformation", "block_0_3_x_1_2_m"}


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (("FOLDER/S00.csv", *SHELF), "a fragility requires several records"),
        (("FOLDER", "--solver", "rock"), "body required (--width, --height missing)"),
        (("FOLDER", *SHELF, "--bodies", "gravestone"), "exclude each other"),
        (("FOLDER", *SHELF, "--mu", "0.3"), "rock has no option --mu"),
        (("FOLDER", *SHELF, "--levels", "1,2"), "not exceeded at any level up to 2 kine; use higher levels"),
        (("FOLDER", *SHELF, "--levels", "900,1000"), "from 900 kine; use lower levels"),
        (("FOLDER", *SHELF, "--method", "cloud", "--levels", "1,2"), "omit --levels"),
        (("FOLDER", *SHELF, "--limit", "slip=5cm"), "does not compute the limit 'slip=0.05m'"),
        (("FOLDER", *SHELF, "--pelicun", "a.txt"), "must end in .csv"),
        (("FOLDER", *SHELF, "--pelicun", "a.csv", "--csv", "a.csv"), "are the same file"),
        (("FOLDER", "--width", "1", "--height", "2", "--dt", "0.02"), "friction required: give --mu (static coefficient)"),
    ],
)
def test_fragility_rejects_invalid_requests(words, says, folder):
    """Before anything is computed, or when the runs say nothing: one sentence, and what to change."""
    answer = run(*(word.replace("FOLDER", str(folder)) for word in words))
    assert answer.exit_code in (2, 3)
    assert says in " ".join(answer.stderr.split()), answer.stderr


def test_fragility_skips_and_reports_unreadable_file(folder, tmp_path):
    """The others answer; with --strict it is refused."""
    (tmp_path / "list.txt").write_text("\n".join([*(str(path) for path in sorted(folder.glob("S0*.csv"))), "gone.csv"]))
    answer = run(f"@{tmp_path / 'list.txt'}", *SHELF, "--levels", "10:150:20")
    assert answer.exit_code == 0 and "excluded: " in answer.stderr and "gone.csv" in answer.stderr
    assert run(f"@{tmp_path / 'list.txt'}", *SHELF, "--strict").exit_code == 3


def test_fragility_translates_bodies_and_limits(folder):
    """Names appear in the first line, in warnings and in the table, without control characters."""
    answer = CliRunner().invoke(main, ["--lang", "ja", "fragility", str(folder), *SHELF[4:], "--block", "gravestone", "--quiet"])
    assert answer.exit_code == 0, answer.stderr
    assert answer.stdout.startswith("墓石、転倒：")
    warned = Fragility("gravestone", "slip=0.05m", "pgv", "m/s", IDA, 3, 3, 0, 0, 0, (), problem="none")
    body_value = replace(warned, body="{odd}\x1b[31m", limit="overturn")
    rules = FitOptions(IDA, (intensity_measure("pgv"),), 0.95, 0, 0)
    with use_locale("ja"):
        curves = [gettext(note) for note in fragility_warnings([warned, body_value], [np.ones(3)], rules)]
    assert any(text.startswith("墓石、変位 0.05 m：") for text in curves)
    assert any(text.startswith("{odd}\\x1b[31m、転倒：") for text in curves)


def test_fragility_translates_unnamed_block():
    """Warnings of the solvers name the block as tables do."""
    motion = Motion.from_arrays(np.zeros(10), 0.01)
    with use_locale("ja"):
        assert gettext(solve_rock(Block(1.0, 0.5), motion).warnings[0]).startswith("物体：")


def test_note_states_why_medians_of_measures_differ_from_the_curve():
    """The table of intensity measures printed another median for the same PGA without a reason."""
    result = run("synthetic_jma.csv", "elcentro_1940_ns.csv", *SHELF[:6], "--im", "pga,pgv")
    assert "lowest levels at which motions reach the limit, where the curve counts all levels" in " ".join(result.stdout.split())
