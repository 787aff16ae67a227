"""A large text is taken piece by piece from its bytes; its lines, and the record in them, are those of a text that is held whole."""

from __future__ import annotations

import hashlib
from dataclasses import astuple

import numpy as np
import pytest

from seisblock.core.errors import RecordError, RecordFormatError
from seisblock.readers import lines as pieces
from seisblock.readers import read, source
from seisblock.readers.limits import ReadBudget
from seisblock.readers.lines import LazyLines, map_lines, read_lines
from seisblock.readers.source import FileBytes, RawFile, decode_text, open_source, sha256_digest
from seisblock.samples import sample_path

TEXTS = {
    "no end": "a\nb\nc",
    "an end": "a\nb\nc\n",
    "windows": "a,1\r\nb,2\r\n\r\n",
    "empty lines": "\n\n\na\n\n",
    "as many as a piece": "1\n2\n3\n",
    "Japanese": "最大,加速度\n観測点\n1,2\n3,4\n",
}


@pytest.fixture(params=[1, 3, 7])
def small_pieces(request, monkeypatch):
    """Let every text count as large, and a piece be so many lines."""
    monkeypatch.setattr(source, "LARGE_FILE_BYTES", 4)
    monkeypatch.setattr(pieces, "CHUNK_LINES", request.param)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp932"])
@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS)
def test_chunked_lines_equal_whole_text(text, encoding, small_pieces):
    """All of them, one by one, from both ends, in slices of slices, and changed."""
    blob = RawFile("x", text.encode(encoding))
    full, result = decode_text(blob).split("\n"), read_lines(blob)
    assert isinstance(result, LazyLines) and len(result) == len(full) and list(result) == full
    assert [result[i] for i in range(-len(full), len(full))] == full * 2
    for begin in range(len(full)):
        assert list(result[begin:]) == full[begin:]
        assert list(result[begin : len(full) - 1][1:]) == full[begin : len(full) - 1][1:]
    assert list(map_lines(map_lines(result, str.strip), lambda line: line + "!")) == [line.strip() + "!" for line in full]
    with pytest.raises(IndexError):
        result[len(full)]


def test_binary_content_is_rejected(small_pieces):
    """A byte that neither encoding knows, however late it comes."""
    with pytest.raises(RecordFormatError, match="not a text file"):
        read_lines(RawFile("x", b"1,2\n" * 20 + b"\x81 \n"))


@pytest.mark.parametrize(
    "text",
    [
        "time,NS (gal),EW (gal)\n" + "".join(f"{0.01 * k:.2f},{k % 7}.5,{-k % 5}.25\n" for k in range(60)),
        "# comment\nNS;EW\n" + "".join(f"{k % 7},5;{-k % 5},25\n" for k in range(60)),
        "NS EW\n" + "".join(f" {k % 7}.5  {-k % 5}.25\n" for k in range(60)) + "# end\n\n",
        "NS (gal)\n" + "".join(f"{k % 7}.5\n" if k != 40 else "\n" for k in range(60)),
        "NS,UD\n" + "".join(f'"{k % 7}.5","{k}"\n' for k in range(60)),
        "NS,UD\n" + "".join(f"{k % 7}.5,{'12' if k == 30 else '1.50'}\n" for k in range(60)),
    ],
    ids=["clock", "decimal comma", "blanks", "an empty line", "quotes", "a point lost"],
)
def test_chunked_table_gives_same_record(text, tmp_path, monkeypatch):
    """Samples, interval, history and doubts."""
    path = tmp_path / "record.csv"
    path.write_text(text, encoding="utf-8")
    options = {} if "gal" in text else {"units": "gal"}
    options |= {} if "time" in text else {"dt": 0.01}
    full = read(path, **options)
    monkeypatch.setattr(source, "LARGE_FILE_BYTES", 4)
    monkeypatch.setattr(pieces, "CHUNK_LINES", 7)
    same(read(path, **options), full)


def test_table_is_read_chunk_by_chunk(tmp_path, monkeypatch):
    """A table is gone through some ten times, from piece to piece, and never line by line from the beginning of a piece."""
    path = tmp_path / "record.csv"
    path.write_text("NS (gal)\n" + "".join(f"{k % 7}.5\n" for k in range(1000)), encoding="utf-8")
    monkeypatch.setattr(source, "LARGE_FILE_BYTES", 4)
    monkeypatch.setattr(pieces, "CHUNK_LINES", 100)
    collected = []
    original = LazyLines._chunk
    monkeypatch.setattr(LazyLines, "_chunk", lambda self, number: collected.append(number) or original(self, number))
    read(path, dt=0.01)
    assert len(collected) < 20 * 11


@pytest.mark.slow
def test_chunked_jma_file_gives_same_record(monkeypatch):
    """Samples, header and doubts."""
    full = read(sample_path("synthetic_jma.csv"))
    monkeypatch.setattr(source, "LARGE_FILE_BYTES", 4)
    monkeypatch.setattr(pieces, "CHUNK_LINES", 999)
    same(read(sample_path("synthetic_jma.csv")), full)


@pytest.mark.parametrize(("line", "cell"), [(33, "1.0,2.0,3.0"), (34, "one,2.0"), (35, "1.0")], ids=["more", "text", "less"])
def test_error_line_number_is_independent_of_chunks(line, cell, tmp_path, small_pieces):
    """The first line that is wrong is named, wherever pieces end."""
    rows = ["NS (gal),EW (gal)", *("1.5,2.5" for _ in range(60))]
    rows[line - 1] = cell
    path = tmp_path / "record.csv"
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")
    with pytest.raises(RecordFormatError, match=f"line {line}"):
        read(path, dt=0.01)


def same(result, expected):
    """Assert that two records are one."""
    assert result.codes == expected.codes and result.dt == expected.dt
    for first, second in zip(result.components, expected.components, strict=True):
        np.testing.assert_array_equal(first.acceleration, second.acceleration)
        assert not first.acceleration.flags.writeable
    assert (result.history, result.metadata, result.start) == (expected.history, expected.metadata, expected.start)
    assert [astuple(doubt) for doubt in result.doubts] == [astuple(doubt) for doubt in expected.doubts]


def test_columns_with_different_units_are_converted(tmp_path):
    """The history of the record states it."""
    path = tmp_path / "record.csv"
    path.write_text("NS (gal),EW (m/s2)\n" + "100,2\n" * 5, encoding="utf-8")
    record = read(path, dt=0.01)
    assert [float(component.acceleration[0]) for component in record.components] == [1.0, 2.0]
    assert record.history == ("columns converted from different units ('NS (gal)': gal, 'EW (m/s2)': m/s2)",)


def test_large_file_is_read_on_demand(tmp_path, monkeypatch):
    """Read where they are looked at: all of them, parts of them, their digest; counted by the budget like any others."""
    monkeypatch.setattr(source, "LARGE_FILE_BYTES", 4)
    path = tmp_path / "x.csv"
    path.write_bytes(bytes(range(32, 59)))
    duration = ReadBudget()
    blob = open_source(path, duration)
    assert isinstance(blob.content, FileBytes) and duration.bytes_read == 27
    assert blob.data == path.read_bytes() and blob.content[3:9] == path.read_bytes()[3:9] and blob.content[-2:] == path.read_bytes()[-2:]
    assert sha256_digest([blob]) == hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.mark.parametrize("spoil", [lambda path: path.write_bytes(b"NS (gal)\n"), lambda path: path.unlink()], ids=["written", "gone"])
def test_file_changing_while_read_is_rejected(spoil, tmp_path, monkeypatch):
    """A download that goes on, another file in its place: no record of two halves."""
    monkeypatch.setattr(source, "LARGE_FILE_BYTES", 4)
    path = tmp_path / "x.csv"
    path.write_text("NS (gal)\n1\n2\n")
    blob = open_source(path, ReadBudget())
    spoil(path)
    with pytest.raises(RecordError, match=r"changed while reading|cannot read"):
        read_lines(blob)


def test_large_blank_file_is_empty(tmp_path, monkeypatch):
    """As a small one is."""
    monkeypatch.setattr(source, "LARGE_FILE_BYTES", 4)
    path = tmp_path / "x.csv"
    path.write_text(" \n" * 20)
    with pytest.raises(RecordError, match="empty file"):
        open_source(path, ReadBudget())
