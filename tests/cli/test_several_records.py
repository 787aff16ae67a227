"""Tables of ``--csv`` of several records begin with a column of the record; that of a single record has none."""

import csv
import math

import pytest
from click.testing import CliRunner

from seisblock.cli import main
from seisblock.cli.load_records import MAX_HISTORIES

OF_EVERY_KIND = (
    ["slide", "--mu", "0.05"],
    ["slide", "--mu", "0.05,0.1"],
    ["rock", "--block", "gravestone"],
    ["respond", "--block", "gravestone", "--mu", "0.5"],
    ["jump"],
    ["uplift", "--width", "1m", "--height", "3m", "--frequency-vertical", "8"],
    ["stack", "--stones", "column", "--runs", "0"],
    ["criteria", "--block", "gravestone"],
    ["spectrum", "--sizes", "1", "--height-over-width", "3"],
    ["spectrum", "--kind", "sliding", "--mu", "0.05"],
    ["spectrum", "--kind", "modes", "--mu", "0.2", "--sizes", "1", "--height-over-width", "3"],
)


@pytest.fixture
def two_records(tmp_path, monkeypatch):
    """Two records of one name of component."""
    monkeypatch.chdir(tmp_path)
    for name, gal in (("one.csv", 120.0), ("two.csv", 90.0)):
        rows = (f"{i * 0.02:.2f},{gal * math.sin(2 * math.pi * 2.0 * i * 0.02):.6f}\n" for i in range(51))
        (tmp_path / name).write_text("time (s),NS (gal),UD (gal)\n" + "".join(row.rstrip() + ",0\n" for row in rows))
    return ["one.csv", "two.csv"]


def test_processing_of_many_records_does_not_hide_the_answer(tmp_path, monkeypatch):
    """300 stations printed 300 lines on the removed mean before the answer."""
    monkeypatch.chdir(tmp_path)
    for number in range(MAX_HISTORIES + 2):
        (tmp_path / f"{number}.csv").write_text("time (s),NS (gal)\n" + "".join(f"{i * 0.02:.2f},{i % 7 + number}\n" for i in range(51)))
    names = sorted(path.name for path in tmp_path.iterdir())
    lines = CliRunner().invoke(main, ["slide", "--mu", "0.2", "--demean", *names]).stderr.splitlines()
    assert sum("mean" in line for line in lines) == MAX_HISTORIES
    assert "processing of 2 further records: in --json" in lines
    assert "further" not in CliRunner().invoke(main, ["slide", "--mu", "0.2", "--demean", *names[:MAX_HISTORIES]]).stderr


@pytest.mark.parametrize("words", OF_EVERY_KIND, ids=" ".join)
def test_csv_of_several_records_starts_with_record_index(words, two_records, tmp_path):
    """The rows of each record are those of a table of it alone, with its place in the list before them."""
    tables = {}
    for name, records in (("both", two_records), ("first", two_records[:1]), ("second", two_records[1:])):
        result = CliRunner().invoke(main, [*words, *records, "--component", "NS", "--csv", f"{name}.csv"])
        assert result.exit_code == 0, result.output
        with (tmp_path / f"{name}.csv").open(newline="") as stream:
            tables[name] = list(csv.reader(stream))
    head, *rows = tables["both"]
    assert head == ["record_index", *tables["first"][0]]
    assert [row[1:] for row in rows if row[0] == "0"] == tables["first"][1:]
    assert [row[1:] for row in rows if row[0] == "1"] == tables["second"][1:]
    assert len(rows) == len(tables["first"]) + len(tables["second"]) - 2
