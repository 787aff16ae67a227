"""``seisblock batch``: it refuses what it should, and no interruption loses or doubles a row."""

import csv
import os
import signal
import subprocess
import sys
import time
import tracemalloc
import zipfile
from pathlib import Path

import numpy as np
import pytest

from seisblock.core.io.checkpoint import Checkpoint, lock_checkpoint
from seisblock.samples import sample_directory
from seisblock.studies.batch import cluster
from tests.studies.batch.conftest import document, run, write_record

LINE = "batch records --bodies bodies.csv --solver rock --out t.csv"


def test_batch_refuses_to_overwrite_files(folder):
    """A table that is there, an input, a directory, a suffix that means nothing."""
    (folder / "t.csv").write_text("mine")
    answer = run(LINE)
    assert answer.exit_code == 3 and "--force" in answer.stderr and Path("t.csv").read_text() == "mine"
    assert run(LINE + " --force").exit_code == 0
    full = Path("t.csv").read_bytes()
    assert run(LINE + " --resume").exit_code == 0 and Path("t.csv").read_bytes() == full
    second = run("batch records/r0.csv --bodies bodies.csv --solver rock --out t.csv --resume")
    assert second.exit_code == 3 and "other records" in second.stderr and Path("t.csv").read_bytes() == full
    before = Path("records/r0.csv").read_bytes()
    harmed = run("batch records --bodies bodies.csv --solver rock --out records/r0.csv --force")
    assert harmed.exit_code == 3 and Path("records/r0.csv").read_bytes() == before
    table = run("batch records --bodies bodies.csv --solver rock --out bodies.csv --force")
    assert table.exit_code == 3 and "slender" in Path("bodies.csv").read_text()
    assert not list(folder.rglob("*.journal"))
    assert ".csv or .parquet" in run(LINE.replace("t.csv", "t.xlsx")).stderr
    assert run(LINE + " --force --resume").exit_code == 3
    assert run(LINE.replace("t.csv", "nowhere/t.csv")).exit_code == 3


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ("--bodies none.csv", "none.csv"),
        ("--bodies wrong.csv", "unknown column 'colour'"),
        ("--solver slide --runs 5", "does not support samples"),
        ("--cluster tcp://127.0.0.1:9", "no Dask scheduler responds"),
        ("--cluster local:none", "from 1 to 512"),
        ("--window 0:5 --window 6:7", "one --window"),
        ("--mu 0.3", "rock has no option --mu: omit it"),
        ("--solver jump --mu 0.3 --vertical", "jump has no option --vertical: omit it"),
    ],
)
def test_batch_reports_bad_input_in_one_sentence(folder, change, message, monkeypatch):
    """And leaves nothing behind."""
    monkeypatch.setattr(cluster, "CONNECT_TIMEOUT_S", 0.5)
    (folder / "wrong.csv").write_text("name,width,height,colour\na,1,2,red\n")
    line = LINE if "--bodies" not in change else LINE.replace("--bodies bodies.csv ", "")
    line = line if "--solver" not in change else line.replace("--solver rock ", "")
    answer = run(f"{line} {change}")
    assert answer.exit_code == 3 and message in answer.stderr
    assert [line[:10] for line in answer.stderr.splitlines() if "does not use" not in line] == ["seisblock:"]
    assert not Path("t.csv").exists() and not Path("t.csv.journal").exists()


def test_batch_without_any_answer_writes_no_table(folder):
    """On an error no table is written, the reason is given, and the corrected line runs; an existing table stays."""
    for suffix in ("csv", "parquet"):
        line = f"--bodies bodies.csv --solver rock --out t.{suffix}"
        answer = run(f"batch gone.csv {line}")
        assert answer.exit_code == 3 and "no row has a result" in answer.stderr and "is not written" in answer.stderr
        assert "0 of 0" not in answer.stdout
        assert "gone.csv: no such file" in answer.stdout and "wrote" not in answer.stderr
        assert not list(folder.glob(f"t.{suffix}*"))
        assert run(f"batch records/r0.csv {line}").exit_code == 0
        full = Path(f"t.{suffix}").read_bytes()
        refused = run(f"batch gone.csv {line} --force")
        assert refused.exit_code == 3 and f"t.{suffix} is unchanged" in refused.stderr
        assert Path(f"t.{suffix}").read_bytes() == full and len(list(folder.glob(f"t.{suffix}*"))) == 1


def test_batch_without_table_prints_every_reason(folder):
    """Otherwise the file would hold those that are not printed."""
    answer = run(f"batch {' '.join(f'gone{i}.csv' for i in range(8))} --bodies bodies.csv --solver rock --out t.csv")
    assert all(f"gone{i}.csv" in answer.stdout for i in range(8)) and "in the file" not in answer.stdout


def test_batch_prints_counts_per_body(folder):
    """Counts by body, beside the table; an object slides if it does under any component of a record."""
    content = document("batch records gone.csv --bodies bodies.csv --solver slide --out t.csv")
    assert (content["records_count"], content["unread_count"]) == (5, 1)
    assert [result["answers_count"] for result in content["results"]] == [8, 8, 8]
    answer = " ".join(run("batch records --bodies bodies.csv --solver slide --out u.csv --quiet").stdout.split())
    with Path("u.csv").open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    slid = [(row["record"], row["body"]) for row in rows if row["slips"] == "True"]
    objects = {(row["record"], row["body"]) for row in rows}
    assert (len(rows), len(objects)) == (24, 12) and 0 < len(set(slid)) < len(slid)
    assert answer.startswith(f"slid: {len(set(slid))} of 12 objects under at least one component; slid in {len(slid)} of 24 cases (")


def test_batch_parquet_equals_csv(folder):
    """Cell by cell, with the types kept."""
    pandas = pytest.importorskip("pandas")
    assert run(LINE).exit_code == 0 and run(LINE.replace("t.csv", "t.parquet")).exit_code == 0
    text, remaining = pandas.read_csv("t.csv", float_precision="round_trip"), pandas.read_parquet("t.parquet")
    assert list(text.columns) == list(remaining.columns)
    assert remaining["overturned"].tolist() == text["overturned"].tolist()
    assert remaining["max_rotation_rad"].tolist() == text["max_rotation_rad"].tolist()
    assert run(LINE.replace("t.csv", "t.parquet") + " --resume").exit_code == 0


def test_batch_resume_rejects_other_options(folder):
    """Resuming with another factor, body, component or number of bodies is rejected."""
    assert run(LINE).exit_code == 0
    full = Path("t.csv").read_bytes()
    text = Path("bodies.csv").read_text(encoding="utf-8")
    (folder / "wider.csv").write_text(text.replace("slender,20", "slender,21"), encoding="utf-8")
    (folder / "more.csv").write_text(text + "fourth,30,1.0,0.5,\n", encoding="utf-8")
    for change in ("--scale 1.01", "--component NS", "--gravity 9.7", "--bodies wider.csv", "--bodies more.csv"):
        line = LINE if "--bodies" not in change else LINE.replace("--bodies bodies.csv ", "")
        second = run(f"{line} {change} --resume")
        assert second.exit_code == 3 and "options" in second.stderr, change
        assert Path("t.csv").read_bytes() == full


def test_batch_of_one_station_is_complete(folder):
    """Stations of a bundle that were not asked for have no rows, and none is missed."""
    with zipfile.ZipFile(folder / "event.zip", "w") as archive:
        for station in ("AAA001", "BBB002"):
            for code in ("NS", "EW", "UD"):
                data = (sample_directory() / f"synthetic_knet.{code}").read_bytes()
                archive.writestr(f"{station}1604160125.{code}", data.replace(b"SYN001", station.encode()))
    line = "batch event.zip --bodies bodies.csv --solver slide --out s.csv"
    assert run(line + " --station BBB002").exit_code == 0
    assert run(line + " --station BBB002 --resume").exit_code == 0
    assert run(line + " --station AAA001 --resume").exit_code == 3
    assert run(line + " --resume").exit_code == 3


def test_batch_locks_its_table(folder):
    """A second run on the same file is rejected while the first is active; it would write into the journal of the first."""
    journal = folder / "t.csv.journal"
    with lock_checkpoint(journal):
        Checkpoint.begin(journal, {"of": "another run"})
        holding = journal.read_bytes()
        for how in ("--resume", "--force"):
            answer = run(f"{LINE} {how}")
            assert answer.exit_code == 3 and "in use by another run" in answer.stderr, how
        assert journal.read_bytes() == holding and not Path("t.csv").exists()
    assert run(LINE + " --force").exit_code == 0


def _start(*extra):
    """Return a batch that runs in a process of its own."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    line = [sys.executable, "-m", "seisblock", *LINE.split(), "--workers", "1", *extra]
    return subprocess.Popen(line, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def _until_lines(path, count, process):
    """Wait until so many records stand in a journal."""
    for _ in range(60_000):
        if path.exists() and path.read_bytes().count(b"\n") > count:
            return
        assert process.poll() is None, process.stderr.read().decode()
        time.sleep(0.005)
    raise AssertionError("nothing was written down")


def _journal_of(folder):
    """Return a journal as an interruption left it, and the table that it becomes."""
    remaining = {}

    def leave(self):
        remaining["journal"] = self.path.read_bytes()
        self.path.unlink()

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("seisblock.core.io.checkpoint.Checkpoint.remove", leave)
        assert run(LINE).exit_code == 0
    full = Path("t.csv").read_bytes()
    Path("t.csv").unlink()
    return remaining["journal"], full


def _flip_byte(lines, rng):
    """Change a byte of a line that holds a record."""
    place = int(rng.integers(len(lines[2]) - 1))
    lines[2] = lines[2][:place] + bytes([lines[2][place] ^ 1 << int(rng.integers(8))]) + lines[2][place + 1 :]


DAMAGES = {
    "a flipped bit": _flip_byte,
    "random bytes": lambda lines, dice: lines.insert(2, dice.bytes(300) + b"\n"),
    "a cut end": lambda lines, dice: lines.append(lines.pop()[: int(dice.integers(1, 200))]),
    "a line twice": lambda lines, dice: lines.insert(1, lines[2]),
    "lines in another order": lambda lines, dice: lines.__setitem__(slice(1, None), lines[:0:-1]),
    "a lost line end": lambda lines, rng: lines.__setitem__(1, lines[1].rstrip(b"\n")),
    "a record of nobody": lambda lines, dice: lines.insert(1, b'{"rows": 1}\n'),
    "nothing but its purpose": lambda lines, dice: lines.__delitem__(slice(1, None)),
}


def test_batch_resume_ignores_damaged_checkpoint_lines(folder):
    """Whatever became of its lines, the table is the same bit by bit; a changed digit is never believed."""
    journal, full = _journal_of(folder)
    for seed, (quantity, damage) in enumerate([*DAMAGES.items(), *[("a flipped bit", _flip_byte)] * 8]):
        lines = journal.splitlines(keepends=True)
        damage(lines, np.random.default_rng(seed))
        Path("t.csv.journal").write_bytes(b"".join(lines))
        gone_on = run(LINE + " --resume")
        assert gone_on.exit_code == 0, (quantity, gone_on.stderr)
        assert Path("t.csv").read_bytes() == full, quantity
        assert ("damaged" in gone_on.stderr) == (quantity in ("a flipped bit", "random bytes", "a lost line end", "a record of nobody")), (
            quantity
        )
        Path("t.csv").unlink()


@pytest.mark.parametrize("first", [b"", b"\xff\x00\n", b"[1]\n", b"{}\n"])
def test_batch_resume_rejects_unidentified_checkpoint(folder, first):
    """And left alone: --force begins anew."""
    Path("t.csv.journal").write_bytes(first)
    answer = run(LINE + " --resume")
    assert answer.exit_code == 3 and "the first line is no header" in answer.stderr
    assert Path("t.csv.journal").read_bytes() == first and not Path("t.csv").exists()


@pytest.mark.parametrize("how", [signal.SIGKILL, pytest.param(signal.SIGINT, marks=pytest.mark.slow)])
def test_batch_resume_after_kill_neither_loses_nor_repeats_records(folder, how):
    """Killed in the middle, and gone on with; also from a line that was cut."""
    for seed in range(4, 24):
        write_record(folder / "records" / f"r{seed:02d}.csv", seed, samples=2000, peak=6.0)
    process = _start("--quiet")
    journal = folder / "t.csv.journal"
    _until_lines(journal, 3, process)
    process.send_signal(how)
    process.communicate()
    assert process.returncode == (130 if how == signal.SIGINT else -signal.SIGKILL)
    assert not (folder / "t.csv").exists()
    assert run(LINE).exit_code == 3  # neither begun anew nor gone on with unless it is said
    with journal.open("ab") as stream:
        stream.write(b'{"path": "records/r20.csv", "stamp": "1@2", "ro')
    second = run(LINE.replace("rock", "slide") + " --resume")
    assert second.exit_code == 3 and "belongs to a run with other bodies" in second.stderr
    finished = journal.read_bytes().count(b"\n") - 1
    gone_on = run(LINE + " --resume")
    assert gone_on.exit_code == 0 and f"{finished} of 24 records are finished" in gone_on.stderr
    assert run(LINE.replace("t.csv", "whole.csv")).exit_code == 0
    assert (folder / "t.csv").read_bytes() == (folder / "whole.csv").read_bytes()
    assert not journal.exists()


@pytest.mark.slow
def test_batch_memory_is_independent_of_record_count(folder):
    """Forty records hold no more than ten, but for what a row takes: each is read when it is its turn."""

    def peak(count):
        tracemalloc.start()
        try:
            assert run(f"batch {' '.join(names[:count])} --bodies bodies.csv --solver slide --force --out t.csv --workers 1").exit_code == 0
            return tracemalloc.get_traced_memory()[1]
        finally:
            tracemalloc.stop()

    names = [f"many/m{number:02d}.csv" for number in range(40)]
    (folder / "many").mkdir()
    for number, name in enumerate(names):
        write_record(folder / name, number, samples=4000)
    peak(2)
    subset, rows = peak(10), peak(40)
    assert rows - subset < 30 * 4000 * 3 * 8 / 10  # a tenth of the samples that thirty records more hold


@pytest.mark.parametrize("name", ["t.csv", "t.csv.journal"])
def test_batch_resume_rejects_pipe(folder, name):
    """Nobody would write into it."""
    os.mkfifo(folder / name)
    answer = run(LINE + " --resume")
    assert answer.exit_code == 3 and answer.stderr.endswith("t.csv is not an interrupted table: omit --resume\n")
