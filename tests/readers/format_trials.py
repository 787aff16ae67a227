"""Trials of every format: harmless variants of a file, and damage. ``python -m tests.readers.format_trials`` prints the table of the docs.

A trial is right if samples, interval, start and flags are those of the intact file, flagged if a flag is added, refused if reading raises
an error, and wrong if something else is read without a new flag.
"""

from __future__ import annotations

import bz2
import gzip
import io
import lzma
import re
import tarfile
import tempfile
import zipfile
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import numpy as np

from seisblock.core.errors import InputError
from seisblock.readers import read_all
from seisblock.records import Record
from tests.fuzz.formats import FORMATS

BINARY = ("sac", "mseed", "xlsx", "tar", "tar.gz", "zip")
OUTCOMES = ("right", "flagged", "refused", "wrong")
ROWS = ("variants", "archives", "damage")

Change = Callable[[bytes], bytes]


def _zip(data: bytes, name: str = "record") -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        archive.writestr(name, data)
    return buffer.getvalue()


def _tar(data: bytes, mode: str = "w") -> bytes:
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode=mode) as archive:  # type: ignore[call-overload]
        info = tarfile.TarInfo("record")
        info.size = len(data)
        archive.addfile(info, io.BytesIO(data))
    return buffer.getvalue()


VARIANTS: dict[str, Change] = {
    "CR LF": lambda data: re.sub(rb"\r?\n", b"\r\n", data),
    "CR": lambda data: re.sub(rb"\r?\n", b"\r", data),
    "byte order mark": lambda data: b"\xef\xbb\xbf" + data.removeprefix(b"\xef\xbb\xbf"),
    "UTF-16": lambda data: data.removeprefix(b"\xef\xbb\xbf").decode().encode("utf-16"),
    "DOS end of file": lambda data: data + b"\x1a",
    "blank lines": lambda data: data + b"\n\n\n",
    "no line end": lambda data: data.rstrip(b"\r\n"),
    "blanks at line ends": lambda data: re.sub(rb"(\r?\n)", rb"  \1", data),
    "no blanks at line ends": lambda data: re.sub(rb"[ \t]+(\r?\n)", rb"\1", data),
}
ARCHIVES: dict[str, Change] = {
    "gz": gzip.compress,
    "bz2": bz2.compress,
    "xz": lzma.compress,
    "zip": _zip,
    "tar": _tar,
    "gz in zip": lambda data: _zip(gzip.compress(data), "record.gz"),
    "zip in tar.bz2": lambda data: _tar(_zip(data), "w:bz2"),
    "zip in zip in zip": lambda data: _zip(_zip(_zip(data), "a.zip"), "b.zip"),
}


def _by_lines(change: Callable[[list[bytes], int], list[bytes]]) -> Change:
    """Return a change of lines; its second argument is the middle of the file."""

    def apply(data: bytes) -> bytes:
        lines = data.splitlines(keepends=True)
        return b"".join(change(lines, len(lines) // 2))

    return apply


def _in_line(change: Change) -> Change:
    return _by_lines(lambda lines, k: [*lines[:k], change(lines[k]), *lines[k + 1 :]])


DAMAGE: dict[str, Change] = {
    "last line lost": _by_lines(lambda lines, k: lines[:-1]),
    "a line lost": _by_lines(lambda lines, k: lines[:k] + lines[k + 1 :]),
    "a line twice": _by_lines(lambda lines, k: [*lines[:k], lines[k], *lines[k:]]),
    "two lines exchanged": _by_lines(lambda lines, k: [*lines[:k], lines[k + 1], lines[k], *lines[k + 2 :]]),
    "half of the bytes": lambda data: data[: len(data) // 2],
    "four bytes lost": lambda data: data[:-4],
    "decimal commas in one half": _by_lines(lambda lines, k: lines[:k] + [re.sub(rb"(\d)\.(\d)", rb"\1,\2", x) for x in lines[k:]]),
    "decimal commas": lambda data: re.sub(rb"(\d)\.(\d)", rb"\1,\2", data),
    "exponents with D": lambda data: re.sub(rb"(\d)[eE]([+-]?\d)", rb"\1D\2", data),
    "letter O for a digit": _in_line(lambda line: line.replace(b"1", b"O").replace(b"2", b"O")),
    "field of asterisks": _in_line(lambda line: re.sub(rb"[\d.]{3,}", lambda match: b"*" * len(match[0]), line, count=1)),
    "minus signs of a line lost": _in_line(lambda line: line.replace(b"-", b" ")),
    "file twice": lambda data: data + data,
    "last lines twice": _by_lines(lambda lines, k: lines + lines[-5:]),
    "zero bytes": lambda data: data[: len(data) // 2] + bytes(64) + data[len(data) // 2 + 64 :],
}
_OF_BINARY = ("half of the bytes", "four bytes lost", "file twice", "zero bytes")


def _read(path: Path, data: bytes, options: dict[str, object]) -> list[Record] | None:
    path.write_bytes(data)
    try:
        return read_all([path], station="all", **options)  # type: ignore[arg-type]
    except InputError:
        return None


def _is_equal(records: list[Record], others: list[Record]) -> bool:
    def head(record: Record) -> object:
        return record.codes, round(record.dt, 12), record.samples, record.start

    return [head(record) for record in records] == [head(record) for record in others] and all(
        np.allclose(a.acceleration, b.acceleration, rtol=0.0, atol=1e-9)
        for record, other in zip(records, others, strict=True)
        for a, b in zip(record.components, other.components, strict=True)
    )


def run_trials(kind: str, folder: Path) -> dict[tuple[str, str], str]:
    """Return the outcome of each trial of one format, by group and name."""
    example, path = FORMATS[kind], folder / "record"
    intact = _read(path, example.data, example.options)
    assert intact is not None
    outcomes = {}
    for group, changes in zip(ROWS, (VARIANTS, ARCHIVES, DAMAGE), strict=True):
        for name, change in changes.items():
            if kind in BINARY and group != "archives" and name not in _OF_BINARY:
                continue
            try:
                data = change(example.data)
            except UnicodeDecodeError:
                continue
            if data == example.data:
                continue
            records = _read(path, data, example.options)
            if records is None:
                outcome = "refused"
            elif {flag for record in records for flag in record.doubts} - {flag for record in intact for flag in record.doubts}:
                outcome = "flagged"
            else:
                outcome = "right" if _is_equal(records, intact) else "wrong"
            outcomes[group, name] = outcome
    return outcomes


def table(folder: Path) -> tuple[list[str], dict[str, list[str]]]:
    """Return the lines of the table in Markdown, and the formats of each damage that is read wrongly."""
    lines = ["| format | tried | right | flagged | refused | wrong |", "|---|---|---|---|---|---|"]
    total: Counter[str] = Counter()
    wrong: dict[str, list[str]] = {}
    for kind in FORMATS:
        outcomes = run_trials(kind, folder)
        counts = Counter(outcomes.values())
        total += counts
        lines.append(f"| {kind} | {len(outcomes)} | " + " | ".join(str(counts[outcome]) for outcome in OUTCOMES) + " |")
        for (_, name), outcome in outcomes.items():
            if outcome == "wrong":
                wrong.setdefault(name, []).append(kind)
    return [*lines, f"| all | {sum(total.values())} | " + " | ".join(str(total[outcome]) for outcome in OUTCOMES) + " |"], wrong


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as directory:
        rows, misread = table(Path(directory))
    print("\n".join(rows))
    for damage, kinds in misread.items():
        print(f"{damage}: {', '.join(kinds)}")
