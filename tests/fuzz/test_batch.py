"""Batches of spoilt records and spoilt lists of bodies: a row for each record, or one sentence; never a traceback, never a lost record."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from seisblock.cli import main
from tests.fuzz.accidents import spoil
from tests.fuzz.command_lines import SAMPLES, STRANGE
from tests.fuzz.formats import WRITERS
from tests.fuzz.test_command_lines import CODES, complaint, in_time

pytestmark = pytest.mark.slow

VALUES = 12
RECORDS = ("jma", "knet-csv", "comma", "blank", "at2", "one column")
"""Formats whose files may be spoilt in their text."""

SHORT = [np.round(300 * np.sin(0.2 * f * np.arange(SAMPLES)) * np.hanning(SAMPLES), 3) for f in (1.0, 1.7, 2.9)]
"""Three components, gal, as long as the files of the command lines."""

LIST = """name,width (cm),height,mu,inset,restitution
slender,20,1.0,0.6,,0.9
squat,80cm,1.2,0.25,5%,
vase,12,40cm,0.4,,
灯籠,3尺,2m,0.5,1cm,0
"""
SOLVERS = ("rock", "slide", "respond", "jump", "uplift")
"""A pile takes seconds a row."""
OPTIONS = {
    "--component": ("NS", "all", "37", "UD", "400"),
    "--scale": ("3", "-1", "0"),
    "--target-pga": ("400",),
    "--window": ("0.2:1", "5:9"),
    "--highpass": ("0.5", "51"),
    "--units": ("gal", "g"),
    "--dt": ("0.01", "-1"),
    "--mu": ("0.3", "-1"),
    "--runs": ("2", "-1"),
    "--workers": ("1", "0"),
    "--gravity": ("9.8", "1e-320"),
    "--out": ("out.csv", "out.xyz", "r0", "bodies.csv", "nowhere/out.csv"),
}
FLAGS = ("--strict", "--demean", "--vertical", "--no-vertical", "--resume", "--force", "--json")


def write_batch(folder: Path, rng: np.random.Generator) -> list[str]:
    """Write records and a list of bodies, some of them spoilt; return the names of the records."""
    names = []
    for number in range(int(rng.integers(1, 4))):
        data = WRITERS[str(rng.choice(RECORDS))]([np.resize(row, 600) for row in SHORT])
        names.append(f"r{number}")
        (folder / names[-1]).write_bytes(spoil(data, rng) if rng.random() < 0.6 else data)
    bodies = LIST.encode()
    (folder / "bodies.csv").write_bytes(spoil(bodies, rng) if rng.random() < 0.4 else bodies)
    return names


def batch_line(names: list[str], rng: np.random.Generator) -> list[str]:
    """Return the words of a batch."""
    words = ["batch", *names, "--solver", str(rng.choice(SOLVERS)), "--bodies", "bodies.csv", "--out", "out.csv", "--dt", "0.01"]
    for option in rng.choice(list(OPTIONS), size=int(rng.integers(0, 3))):
        words += [str(option), str(rng.choice(list(OPTIONS[str(option)]))) if rng.random() < 0.8 else str(rng.choice(STRANGE))]
    return [*words, *map(str, rng.choice(FLAGS, size=int(rng.integers(0, 2))))]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A directory in which the batches stand."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_random_batch_gives_table_or_one_error(seeds, folder):
    """Each named record has a row with a result or a reason, unless a sentence explains its absence."""
    for solver in SOLVERS:  # kernels may have to be compiled first
        CliRunner().invoke(main, ["batch", "--bodies", "gravestone", "--solver", solver, "--out", f"{solver}.csv"])
    met = {"answered": 0, "failed": 0, "refused": 0}
    for seed in seeds(VALUES):
        rng = np.random.default_rng((seed, 3))
        for old in folder.iterdir():
            old.unlink()
        names = write_batch(folder, rng)
        read = {path: path.read_bytes() for path in folder.iterdir()}
        words = batch_line(names, rng)
        with in_time("batch"):
            result = CliRunner().invoke(main, words)
        assert complaint(words, result) == "" and result.exit_code in CODES, (seed, words, result.output[-500:])
        assert {path: path.read_bytes() for path in read} == read, (seed, words)
        assert {path.name for path in folder.iterdir()} <= {path.name for path in read} | {"out.csv", "out.csv.journal"}, (seed, words)
        if not (folder / "out.csv").exists():
            assert result.exit_code in (2, 3), (seed, words)
            met["refused"] += 1
            continue
        with (folder / "out.csv").open(encoding="utf-8", newline="") as stream:
            rows = list(csv.DictReader(stream))
        assert {row["record"] for row in rows} == set(names), (seed, words)
        assert all(row["failure"] or (row["component"] and row["body"]) for row in rows), (seed, words)
        answers = sum(not row["failure"] for row in rows)
        assert (result.exit_code == 0) == (answers > 0), (seed, words, result.stderr)
        met["answered"] += answers
        met["failed"] += len(rows) - answers
    assert all(met.values()), met
