"""``seisblock fit`` and tables of outcomes: accepted, omitted and rejected entries."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.cli import main
from seisblock.errors import ParameterError, RecordNotFoundError
from seisblock.models import rock_verdict
from seisblock.samples import sample_path
from seisblock.studies import read_outcomes
from tests import make_shaken_block
from tests.studies.fit.conftest import TRUTH, pulse

QUICK = "--width 227mm --height 891mm --free alpha --scatter 0.05 --lapse 0.02 --runs 1"
STRENGTHS = (1.5, 2.5, 3.0, 4.0, 6.0, 8.0)
FELL = [rock_verdict(TRUTH, pulse(peak, 0.8)).overturned for peak in STRENGTHS]


def run(line):
    """Return what a command line comes to."""
    return CliRunner().invoke(main, line.split())


def write_pulse(path, peak, code="EW"):
    """Write a pulse as a plain table."""
    motion = pulse(peak, 0.8)
    lines = "".join(f"{t:.2f},{a:.6f}\n" for t, a in zip(motion.time, motion.horizontal, strict=True))
    path.write_text(f"time,{code} (m/s2)\n{lines}")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Return a folder with six pulses and a table of what they did, in which the test stands."""
    for k, peak in enumerate(STRENGTHS):
        write_pulse(tmp_path / f"p{k}.csv", peak)
    table(tmp_path, "record,fell", *(f"p{k}.csv,{int(fell)}" for k, fell in enumerate(FELL)))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def table(folder, *lines):
    """Write a table of outcomes."""
    (folder / "seen.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")


def test_fit_writes_document_table_and_figure(folder):
    """Parameters with intervals, held-out scores, each outcome, the table and the figure."""
    answer = run(f"fit seen.csv {QUICK} --folds 3 --json --csv out.csv")
    assert answer.exit_code == 0, answer.stderr
    output = json.loads(answer.stdout)
    assert [result["parameter"] for result in output["results"]] == ["alpha"] and output["results"][0]["unit"] == "rad"
    low, high = output["results"][0]["interval"]
    assert low < TRUTH.slenderness < high and output["held_out"]["folds"] == 3
    assert [outcome["happened"] for outcome in output["outcomes"]] == FELL and 0 < sum(FELL) < 6
    assert output["outcomes"][4]["pga_m_s2"] == pytest.approx(6.0, rel=1e-3)
    fixed = {"alpha_rad": None, "p_rad_s": pytest.approx(4.0, abs=0.01), "restitution": None, "inset": 0.0, "scatter": 0.05}
    assert output["parameters"]["fixed"] == fixed
    rows = Path("out.csv").read_text().splitlines()
    assert rows[0].startswith("line,record,component,scale,weight,fell,probability") and len(rows) == 7
    assert rows[1].startswith("2,p0.csv,EW,1.0,1.0,0,")


def test_outcome_table_accepts_headings_words_and_bundles(folder):
    """Japanese headings, words for outcomes, weights, scales, empty cells, comments, other columns; a record in a bundle."""
    shutil.copy(sample_path("pulses.zip"), folder / "runs.zip")
    table(
        folder,
        "# by hand",
        "記録,転倒,重み,倍率,備考",
        "p0.csv,残存,2,,x",
        "p5.csv,転倒,,0.9,",
        "runs.zip/pulse_03.csv,yes,1,5,",
        "p1.csv,,,,nobody looked",
    )
    observations = read_outcomes(folder / "seen.csv")
    assert [item.happened for item in observations] == [False, True, True] and observations.lines == (3, 4, 5)
    assert [(item.weight, item.scale) for item in observations] == [(2.0, 1.0), (1.0, 0.9), (1.0, 5.0)]
    assert any("1 rows without an outcome" in note for note in observations.notes)
    assert np.abs(observations.observed[2].motion.horizontal).max() == pytest.approx(1.0, rel=1e-2)


def test_fit_skips_and_reports_rows_without_record(folder):
    """Two of eight: the rest is answered; --strict refuses, naming the line; nothing left is an error."""
    lines = [f"p{k}.csv,{int(peak > 3.5)}" for k, peak in enumerate(STRENGTHS)]
    table(folder, "record,fell", *lines, "gone.csv,1", "synthetic_jma.csv,0")
    answer = run(f"fit seen.csv {QUICK}")
    output = " ".join(answer.stderr.split())
    assert answer.exit_code == 0 and "2 of 8 rows excluded" in output
    assert "line 8: gone.csv: no such file" in output and "line 9: synthetic_jma.csv has the horizontal components NS, EW" in output
    strict = run(f"fit seen.csv {QUICK} --strict")
    assert strict.exit_code == 3 and "seen.csv, line 8" in strict.stderr
    assert run(f"fit seen.csv {QUICK} --component EW").stderr.count("excluded") == 1
    table(folder, "record,fell", "gone.csv,1")
    with pytest.raises(ParameterError, match=r"none of its records can be read; line 2: gone\.csv"):
        read_outcomes("seen.csv")


def test_fit_outcome_column_is_selectable(folder):
    """With both columns ``fell`` is used, with a note, or the other one on request."""
    table(folder, "record,fell,moved", *(f"p{k}.csv,0,1" for k in range(3)))
    observations = read_outcomes("seen.csv")
    assert observations.kind == "fell" and any("column fell used" in note for note in observations.notes)
    assert [outcome.happened for outcome in read_outcomes("seen.csv", kind="moved")] == [True] * 3


INVALID = {
    "no column record": (["file name,fell", "p0.csv,1"], "expected the columns record and fell"),
    "no outcome": (["record,colour", "p0.csv,red"], "expected the columns record and fell or moved"),
    "two columns": (["record,fell,overturned", "p0.csv,1,1"], "two columns mean fell"),
    "a word": (["record,fell", "p0.csv,1", "p1.csv,perhaps", "p2.csv,maybe"], "line 3: fell must be 0, 1, yes, no, true, false"),
    "a weight": (["record,fell,weight", "p0.csv,1,nan"], "line 2: weight must be zero or more, found nan"),
    "a weight in words": (["record,fell,weight", "p0.csv,1,two"], "weight must be a number, found 'two'"),
    "a scale": (["record,fell,scale", "p0.csv,1,inf"], "line 2: scale must be a finite number, found inf"),
    "no record": (["record,fell", ",1"], "outcome without a record"),
    "nothing known": (["record,fell", "p0.csv,"], "no outcome found; every cell"),
    "no row": (["record,fell"], "no outcome found; expected a header line"),
    "too many cells": (["record,fell", "p0.csv,1,2"], "expected 2 cells"),
}


@pytest.mark.parametrize("quantity", INVALID)
def test_fit_rejects_invalid_table_with_line(quantity, folder):
    """In one sentence that names the line."""
    lines, message = INVALID[quantity]
    table(folder, *lines)
    answer = run("fit seen.csv")
    assert answer.exit_code == 3 and message in " ".join(answer.stderr.split()), answer.stderr
    assert answer.stderr.count("\n") == 1


@pytest.mark.parametrize(
    ("options", "code", "message"),
    [
        ("--free mu", 3, "'mu' cannot be fitted"),
        ("--free alpha", 3, "p must be free or known; add to --free, or give the --width and --height"),
        ("--folds 7", 3, "7 folds require at least as many records, found 6; reduce --folds"),
        ("--folds 1", 2, "1 is not in the range x>=2"),
        ("--runs 3", 3, "one of 1, 2, 4, 8"),
        ("--bounds alpha", 2, "is not NAME=LOW:HIGH"),
        ("--bounds p=9:2", 3, "bounds of p must be increasing"),
        ("--width 20cm", 3, "--height missing"),
        ("--component EW --component NS", 3, "the shaking is one component, found EW, NS"),
        ("--window 0:1 --window 1:2", 3, "one --window"),
        ("--csv seen.csv", 3, "seen.csv"),
    ],
)
def test_fit_rejects_conflicting_options(options, code, message, folder):
    """With the names of the options."""
    answer = run(f"fit seen.csv {options}")
    assert answer.exit_code == code and message in " ".join(answer.stderr.split()), answer.stderr
    assert (folder / "seen.csv").read_text().startswith("record,fell")


def test_fit_rejects_missing_table(folder):
    """Nor a directory, nor the name of another sample."""
    for name, message in (("gone.csv", "bundled: shaken_block.csv"), (".", "is a folder"), ("aoyama.csv", "no file of outcomes")):
        assert message in run(f"fit {name}").stderr
    with pytest.raises(RecordNotFoundError):
        sample_path("gone.csv")


def test_bundled_experiment_equals_script_output():
    """The table, byte by byte, and the pulses, which another zlib may pack otherwise."""
    _, created = make_shaken_block.make()
    assert sample_path("shaken_block.csv").read_bytes() == created
    assert len(read_outcomes("shaken_block.csv")) == 60
